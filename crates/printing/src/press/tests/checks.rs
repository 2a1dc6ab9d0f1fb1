use crate::press::MachineOfPress;
use crate::press::SpecOfPress;
use crate::press::motion::equation_18::{ExactOn, Solver};
use crate::press::wedge::LAW_TOLERANCE;
use camgen_cams::machine::Machine;
use camgen_cams::pipeline::Spec;
use camgen_cams::report::Finding;
use camgen_cams::report::{Verdict, passed};

fn findings(name: &str, overrides: &[&str]) -> Vec<Finding> {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load(name, &overrides).expect("valid").0;
    let rpm = machine.press().expect("a press").design_rpm;
    let cam = Spec::rotary(machine, rpm).solve().expect("a cam");
    cam.draw(5e-6).expect("drawn").prove().expect("proved").findings().to_vec()
}

fn of<'f>(findings: &'f [Finding], check: &str) -> &'f Finding {
    findings.iter().find(|f| f.check == check).unwrap_or_else(|| panic!("no {check} in {findings:?}"))
}

/// One good and one broken cam for each check.
#[test]
fn each_check_passes_a_good_cam_and_fails_a_broken_one() {
    let good = findings("dpi", &[]);
    assert!(passed(&good), "{good:?}");
    for (check, overrides) in [
        ("pressure_angle", vec!["cam.base_radius=60mm"]),
        ("undercut", vec!["cam.base_radius=30mm", "follower.roller.radius=80mm"]),
        ("min_convex_radius", vec!["cam.base_radius=30mm"]),
        ("cutter_radius", vec!["buffer.column=return", "cam.base_radius=100mm", "limits.cutter_radius=900mm"]),
        ("wall", vec!["cam.base_radius=69mm", "cam.bore_radius=65mm"]),
    ] {
        assert_eq!(of(&good, check).verdict, Verdict::Pass, "{check}");
        let broken = findings("dpi", &overrides);
        assert_eq!(of(&broken, check).verdict, Verdict::Fail, "{check}: {broken:?}");
        assert!(!passed(&broken));
    }
    // Checks that are run when their keys are given.
    let pressed = vec![
        "cam.base_radius=69mm",
        "follower.roller.mass=40kg",
        "follower.roller.preload=1600N",
        "limits.contact_stress=2000MPa",
    ];
    let light = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.balance=40mm .. 85mm"];
    for (check, good, bad) in [
        ("force_closure", pressed.clone(), "follower.roller.preload=1500N"),
        ("contact_stress", pressed, "limits.contact_stress=900MPa"),
        ("balance", light.to_vec(), "cam.balance=80mm .. 81mm"),
    ] {
        assert_eq!(of(&findings("dpi", &good), check).verdict, Verdict::Pass, "{check}");
        let bad = [&good[..], &[bad]].concat();
        assert_eq!(of(&findings("dpi", &bad), check).verdict, Verdict::Fail, "{check}");
    }
    assert_eq!(of(&good, "force_closure").verdict, Verdict::Info);
    assert_eq!(of(&good, "cutter_radius").limit, Some(10.0));
    for check in ["tangency", "outline", "rolling"] {
        assert_eq!(of(&good, check).verdict, Verdict::Pass, "{check}: {good:?}");
    }
}

/// The holes keep clear of bore and keyway, so that the metal left is balanced; a band in which no row of holes does it gives the least that
/// is possible, and a band in which one does, if any.
#[test]
fn holes_balance_the_metal_left() {
    let light = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.keyway.angle=270deg", "cam.keyway.width=40mm"];
    let good = [&light[..], &["cam.keyway.depth=30mm", "cam.balance=40mm .. 85mm"]].concat();
    assert_eq!(of(&findings("dpi", &good), "balance").verdict, Verdict::Pass);
    let narrow = [&light[..], &["cam.keyway.depth=30mm", "cam.balance=80mm .. 81mm"]].concat();
    let refused = findings("dpi", &narrow);
    let note = of(&refused, "balance").note_words();
    assert!(note.contains("at least ") && note.contains(" remain; "), "{note}");
    let band = note.split("cam.balance = \"").nth(1).and_then(|rest| rest.split('"').next()).expect(&note);
    let band = format!("cam.balance={band}");
    let wider = [&light[..], &["cam.keyway.depth=30mm", &band]].concat();
    assert_eq!(of(&findings("dpi", &wider), "balance").verdict, Verdict::Pass, "{band}");
    // The lift of the default cam is as large as its base circle: no row of holes balances that.
    let heavy = findings("dpi", &["cam.balance=40mm .. 85mm"]);
    let note = of(&heavy, "balance").note_words();
    assert!(note.ends_with("no wider band would help"), "{note}");
    // Equal lobes balance each other.
    let lobes = findings("dpi", &["cam.cam_turns_per_crank_turn=0.3333", "cam.balance=40mm .. 85mm"]);
    assert_eq!(of(&lobes, "balance").note_words(), "nothing to balance");
}

#[test]
fn a_refusal_names_what_would_pass() {
    let refused = findings("dpi-paper", &["cam.base_radius=200mm"]);
    let finding = of(&refused, "pressure_angle");
    assert_eq!(finding.verdict, Verdict::Fail);
    assert!(finding.value > 60.0 && finding.limit == Some(30.0), "{finding:?}");
    let note = finding.note_words();
    let base = note.strip_prefix("a base radius of ").and_then(|n| n.strip_suffix(" would pass")).expect(&note);
    let passing = findings("dpi-paper", &[&format!("cam.base_radius={base}")]);
    assert!(passed(&passing), "{base}: {passing:?}");
}

#[test]
fn a_concave_corner_limits_the_cutter_to_the_roller() {
    let corner = findings("dpi", &["buffer.column=return", "transition.kind=none"]);
    assert!((of(&corner, "cutter_radius").value - 30.0).abs() < 1e-9);
    let convex = findings("dpi", &["buffer.column=200mm", "transition.kind=none"]);
    assert_eq!(of(&convex, "undercut").verdict, Verdict::Fail);
}

/// Limits on a three-dimensional cam: the same list is walked, so none of them is skipped.
#[test]
fn a_conoid_keeps_the_same_limits() {
    let of_conoid = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let machine = Machine::load("dpi", &overrides).expect("valid").0;
        let cam = Spec::conoid(machine, vec![20.0, 35.0], None).solve().expect("a conoid");
        cam.draw(5e-6).expect("drawn").prove().expect("proved").findings().to_vec()
    };
    let good = of_conoid(&["limits.contact_stress=100000MPa"]);
    assert!(passed(&good), "{good:?}");
    for (check, overrides) in [
        ("contact_stress", vec!["limits.contact_stress=1MPa"]),
        ("pressure_angle", vec!["cam.base_radius=50mm"]),
        ("wall", vec!["cam.base_radius=69mm", "cam.bore_radius=65mm"]),
        ("force_closure", vec!["follower.roller.mass=40kg"]),
    ] {
        assert_eq!(of(&of_conoid(&overrides), check).verdict, Verdict::Fail, "{check}");
    }
}

fn press(command: &str, name: &str, overrides: &[&str], rpm: f64, tolerance: f64) -> Vec<Finding> {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load(name, &overrides).expect("valid").0;
    let solver = Solver::Ode { tolerance: LAW_TOLERANCE };
    let spec = match command {
        "plate" => Spec::translating(machine, rpm, solver, ExactOn::Braking),
        "mean" => Spec::translating(machine, rpm, solver, ExactOn::Mean),
        "conoid" => Spec::conoid(machine, vec![rpm], None),
        _ => Spec::rotary(machine, rpm),
    };
    let cam = spec.solve().expect("a cam");
    cam.draw(tolerance).expect("drawn").prove().expect("proved").findings().to_vec()
}

/// The text between a mark and the next quotation mark or blank of a note.
fn shown(finding: &Finding, mark: &str) -> String {
    let note = finding.note_words();
    let rest = note.split(mark).nth(1).unwrap_or_else(|| panic!("no `{mark}` in {note}"));
    rest.trim_start_matches('"').split('"').next().expect("a value").to_owned()
}

/// The present defaults are useful cams; the law's share of a blend is tested in closed form elsewhere.
#[test]
fn the_residual_is_judged_by_what_a_fixed_bottom_leaves() {
    for name in ["dpi", "dpi-paper"] {
        let found = findings(name, &[]);
        let residual = of(&found, "residual");
        assert_eq!((residual.verdict, &*residual.unit), (Verdict::Pass, "1"), "{residual:?}");
        assert!(residual.value < 1e-3 && residual.limit.is_some_and(|limit| limit > 0.1), "{residual:?}");
        assert_eq!(of(&found, "air").verdict, Verdict::Pass);
        assert_eq!(of(&found, "run_up").verdict, Verdict::Pass);
    }
    let wide = ["transition.kind=blend", "transition.width=180deg"];
    assert_eq!(of(&findings("dpi", &wide), "residual").verdict, Verdict::Fail);
    // Better than without a cam, but by less than half.
    let less_wide = findings("dpi", &["transition.kind=blend", "transition.width=135deg"]);
    let residual = of(&less_wide, "residual");
    let share = residual.value / residual.limit.expect("a limit");
    assert!(residual.verdict == Verdict::Warn && 0.5 < share && share < 1.0, "{residual:?}");
    // A given limit replaces the default, in either direction.
    let allowed = [&wide[..], &["limits.residual_share=0.5"]].concat();
    assert_eq!(of(&findings("dpi", &allowed), "residual").verdict, Verdict::Pass);
    assert_eq!(of(&findings("dpi", &["limits.residual_share=1e-6"]), "residual").verdict, Verdict::Fail);
}

/// At 1000 rpm two thousandths of a millimetre of air remain, and an outline may deviate by five: the value in the note is sufficient.
#[test]
fn a_bottom_that_hits_the_piston_fails_and_the_note_gives_what_fits() {
    let found = press("disc", "dpi", &[], 1000.0, 5e-6);
    let residual = of(&found, "residual");
    assert!(residual.verdict == Verdict::Fail && !residual.value.is_finite(), "{residual:?}");
    let note = residual.note_words();
    assert!(note.contains("the bottom hits the piston"), "{note}");
    let number = |after: &str, before: &str| -> f64 {
        let rest = note.split(after).nth(1).expect(&note);
        rest.split(before).next().and_then(|text| text.trim().parse().ok()).expect(&note)
    };
    assert!((0.0015..0.0025).contains(&number("leaves ", " mm of air")), "{note}");
    let (speed, tolerance) = (number("; at ", " rpm"), number("tolerance of ", " um"));
    assert!((50.0..1000.0).contains(&speed) && (0.01..5.0).contains(&tolerance), "{note}");
    for (rpm, tolerance) in [(speed, 5e-6), (1000.0, 1e-6 * tolerance)] {
        let fits = press("disc", "dpi", &[], rpm, tolerance);
        assert_eq!(of(&fits, "residual").verdict, Verdict::Pass, "{rpm} rpm: {:?}", of(&fits, "residual"));
    }
}

/// The default plate leaves 6261 N on the return stroke, where 3186 N remain without a cam.
#[test]
fn a_plate_that_is_worse_on_the_return_stroke_warns_and_gives_a_remedy() {
    let found = press("plate", "dpi", &[], 35.0, 5e-6);
    let residual = of(&found, "residual");
    assert!(residual.verdict == Verdict::Warn && passed(&found), "{residual:?}");
    assert_eq!(found.first(), Some(residual), "a warning is shown first");
    let angle = shown(residual, "translating.friction_angle = ");
    let helped = press("plate", "dpi", &[&format!("translating.friction_angle={angle}")], 35.0, 5e-6);
    assert_eq!(of(&helped, "residual").verdict, Verdict::Pass, "{angle}: {:?}", of(&helped, "residual"));
    let mean = press("mean", "dpi", &[], 35.0, 5e-6);
    assert!(of(&mean, "residual").value > of(&mean, "residual").limit.expect("a limit"));
    assert_eq!(of(&mean, "residual").verdict, Verdict::Fail, "worse than no cam in both directions");
}

/// At 350 rpm the roller is pressed on with 9388 MPa; with the thickness in the note it is 1500 MPa.
#[test]
fn the_customary_stress_holds_where_no_limit_is_given() {
    let found = press("disc", "dpi", &[], 350.0, 5e-6);
    let stress = of(&found, "contact_stress");
    assert!(stress.verdict == Verdict::Fail && (stress.value - 9388.2).abs() < 0.1, "{stress:?}");
    let thickness = shown(stress, "cam.thickness = ");
    let kept = press("disc", "dpi", &[&format!("cam.thickness={thickness}")], 350.0, 5e-6);
    assert_eq!(of(&kept, "contact_stress").verdict, Verdict::Pass, "{thickness}");
    for (material, limit) in [("steel", 1500.0), ("cast-iron", 700.0), ("bronze", 500.0), ("aluminium", 250.0)] {
        let found = findings("dpi", &[&format!("cam.material={material}")]);
        let shown = of(&found, "contact_stress").limit.expect("a limit");
        assert!((shown / limit - 1.0).abs() < 1e-12, "{material}: {shown}");
        assert_eq!(of(&found, "contact_stress").verdict == Verdict::Pass, material == "steel", "{material}");
    }
    let sphere = press("conoid", "dpi", &[], 35.0, 5e-6);
    assert!((of(&sphere, "contact_stress").limit.expect("a limit") / 1500.0 - 1.0).abs() < 1e-12);
    assert_eq!(of(&sphere, "contact_stress").verdict, Verdict::Warn, "below the limit at rest");
}

/// A run-up of 20° at 1000 rpm requires 1558 mm of lift; with the width in the note the stroke is kept.
#[test]
fn a_run_up_longer_than_the_stroke_is_named() {
    let found = press("disc", "dpi", &[], 350.0, 5e-6);
    let run_up = of(&found, "run_up");
    assert!(run_up.verdict == Verdict::Warn && run_up.value > 180.0, "{run_up:?}");
    assert!(run_up.note_words().contains("run-up lift exceeds the stroke"));
    let width = shown(run_up, "transition.width = ");
    let narrower = press("disc", "dpi", &[&format!("transition.width={width}")], 350.0, 5e-6);
    assert_eq!(of(&narrower, "run_up").verdict, Verdict::Pass, "{width}");
}

/// The least air of the exact law is L (1 + A r)^(−1/k): 2 at, matched, 243 mm · 2^(−1/1.35).
#[test]
fn the_least_air_is_that_of_the_law() {
    let air = of(&findings("dpi", &[]), "air").value;
    assert!((air / (243.0 * libm::pow(2.0, -1.0 / 1.35)) - 1.0).abs() < 1e-12, "{air}");
}

/// A lifter, or a lever where the lift is in degrees, under a follower.
fn under(follower: &str, unit: &str) -> Result<Vec<Finding>, String> {
    let segments = format!(
        "name = \"cam\"\n[motion]\nstart = \"0 {unit}\"\n[[motion.segment]]\nlaw = \"3-4-5\"\nover = \"90 deg\"\nto = \"20 {unit}\"\n\
         [[motion.segment]]\nlaw = \"dwell\"\nover = \"60 deg\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nto = \"0 {unit}\"\n{follower}"
    );
    let machine = Machine::from_toml("cam.toml", &segments, &[]).map_err(|error| error.to_string())?;
    let (motion, rpm) = machine.motion().expect("a motion");
    let cam = Spec::of_motion(machine, motion, rpm).solve().map_err(|error| error.to_string())?;
    Ok(cam.draw(5e-6).expect("drawn").prove().expect("proved").findings().to_vec())
}

/// Without a width the least is given, with one it is judged; the value in the refusal then passes.
#[test]
fn a_face_is_as_wide_as_the_contact_wanders() {
    for (table, unit) in [
        ("[follower.flat]\n", "mm"),
        ("[follower.flat]\ntilt = \"-12 deg\"\noffset = \"3 mm\"\n", "mm"),
        ("[follower.swinging-flat]\npivot_distance = \"150 mm\"\nface_offset = \"5 mm\"\n", "deg"),
    ] {
        let face =
            |width: &str| under(&format!("{table}{width}[cam]\nbase_radius = \"60 mm\"\n"), unit).expect("a cam");
        let shown = face("");
        let least = of(&shown, "face_width");
        assert_eq!((least.verdict, least.limit), (Verdict::Info, None), "{least:?}");
        // The width in the note is sufficient, typed as it was shown.
        let widths = [(1e-3, Verdict::Pass), (0.0, Verdict::Pass), (-1e-3, Verdict::Fail)];
        for (width, verdict) in widths.map(|(more, verdict)| (least.value + more, verdict)) {
            let found = face(&format!("width = \"{width} mm\"\n"));
            assert_eq!(of(&found, "face_width").verdict, verdict, "{found:?}");
        }
    }
    // The quickest rise moves the contact farther to one side: an offset of the stem helps.
    let narrow = under("[follower.flat]\nwidth = \"30 mm\"\n", "mm").expect("a cam");
    let note = of(&narrow, "face_width").note_words();
    let (_, offset) = note.split_once("offset = ").expect(&note);
    let (offset, needed) = offset.split_once(" it needs ").expect(&note);
    let needed: f64 = needed.trim_end_matches(" mm").parse().expect(&note);
    let shifted = under(&format!("[follower.flat]\noffset = {offset}\n"), "mm").expect("a cam");
    assert!((of(&shifted, "face_width").value - needed).abs() < 2e-3, "{note}: {shifted:?}");
    assert!(needed < of(&narrow, "face_width").value, "{note}");
    let roller = under("[follower.roller]\nradius = \"10 mm\"\n", "mm").expect("a cam");
    assert!(roller.iter().all(|finding| finding.check != "face_width"), "{roller:?}");
}

#[test]
fn a_face_that_cannot_follow_is_refused_with_the_reason() {
    let swinging = "[follower.swinging-flat]\npivot_distance = \"200 mm\"\n";
    let quick = under(&format!("{swinging}side = \"leading\"\n[cam]\nbase_radius = \"20 mm\"\n"), "deg");
    assert!(quick.is_ok(), "{quick:?}");
    let steep = "name = \"cam\"\n[motion]\nstart = \"0 deg\"\n[[motion.segment]]\nover = \"20 deg\"\nto = \"15 deg\"\n\
                 [[motion.segment]]\nto = \"0 deg\"\n";
    let solved = |table: &str| {
        let machine = Machine::from_toml("cam.toml", &format!("{steep}{table}"), &[]).expect("valid");
        let (motion, rpm) = machine.motion().expect("a motion");
        Spec::of_motion(machine, motion, rpm).solve().map(|_| ()).map_err(|error| error.to_string())
    };
    let leading = solved(&format!("{swinging}side = \"leading\"\n")).expect_err("too quick");
    assert!(leading.contains("turns back on the cam at 10.000 deg"), "{leading}");
    let wide = "[follower.swinging-flat]\npivot_distance = \"50 mm\"\n[cam]\nbase_radius = \"49 mm\"\n";
    let out_of_reach = under(wide, "deg").expect_err("the face would pass over its pivot");
    assert!(out_of_reach.contains("does not reach every lift"), "{out_of_reach}");
    let straight = under("[follower.swinging-flat]\npivot_distance = \"50 mm\"\n", "mm").expect_err("metres");
    assert!(straight.contains("its positions are angles"), "{straight}");
}

/// A knife edge has no radius to compare with, and no contact stress; a face has no customary pressure angle.
#[test]
fn checks_of_a_radius_leave_a_knife_edge_out() {
    let metal = "[cam]\nthickness = \"10 mm\"\nmaterial = \"steel\"\n";
    let knife = under(&format!("[follower.knife]\npreload = \"100 N\"\n{metal}"), "mm").expect("a cam");
    assert!(passed(&knife) && knife.iter().all(|finding| finding.check != "min_convex_radius"), "{knife:?}");
    assert!(of(&knife, "contact_stress").note_words().contains("knife edge"));
    assert_eq!(of(&knife, "undercut").verdict, Verdict::Pass);
    let face = under("[follower.flat]\ntilt = \"40 deg\"\n", "mm").expect("a cam");
    let angle = of(&face, "pressure_angle");
    assert!(angle.verdict == Verdict::Info && (angle.value - 40.0).abs() < 1e-9, "{angle:?}");
    let limited = under(
        "[follower.flat]\ntilt = \"40 deg\"\n[limits]\npressure_angle = \"30 deg\"\n[cam]\nbase_radius = \"50 mm\"\n",
        "mm",
    );
    assert_eq!(of(&limited.expect("a cam"), "pressure_angle").verdict, Verdict::Fail);
}

/// The motion lost by an undercut face on an arm, by its envelope, is the distance by which the arm really drops onto the written outline.
#[test]
fn the_motion_lost_under_a_swinging_face_is_what_rolling_shows() {
    for (side, base, face_offset) in [("leading", 110, 0), ("leading", 120, -30), ("trailing", 15, 30)] {
        let found = under(
            &format!(
                "[follower.swinging-flat]\npivot_distance = \"150 mm\"\nface_offset = \"{face_offset} mm\"\n\
                 side = \"{side}\"\n[cam]\nbase_radius = \"{base} mm\"\n"
            ),
            "deg",
        )
        .expect("a cam");
        let (undercut, rolling) = (of(&found, "undercut"), of(&found, "rolling"));
        assert_eq!(undercut.verdict, Verdict::Fail, "{found:?}");
        let number = |finding: &Finding, before: &str, after: &str| -> f64 {
            let note = finding.note_words();
            let (_, rest) = note.split_once(before).expect(&note);
            rest.split_once(after).and_then(|(value, _)| value.trim().parse().ok()).expect(&note)
        };
        // A second loop would follow the first.
        let lost = number(undercut, "°, ", " mm at");
        let lifted = 1e-3 * number(rolling, "lift off by ", " µm");
        assert!((lost - lifted).abs() < 5e-3 * lost, "{lost} {lifted}: {found:?}");
    }
}
