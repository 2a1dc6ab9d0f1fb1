use super::*;
use crate::machine::Machine;
use crate::pipeline::Spec;
use crate::report::passed;

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
    for check in ["tangency", "outline", "rolling"] {
        assert_eq!(of(&good, check).verdict, Verdict::Pass, "{check}: {good:?}");
    }
}

/// The holes miss bore and keyway, so that the metal left is balanced; a band in which no row does it is told with the least that
/// is possible, and with a band that does, if any.
#[test]
fn holes_balance_the_metal_left() {
    let light = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.keyway.angle=270deg", "cam.keyway.width=40mm"];
    let good = [&light[..], &["cam.keyway.depth=30mm", "cam.balance=40mm .. 85mm"]].concat();
    assert_eq!(of(&findings("dpi", &good), "balance").verdict, Verdict::Pass);
    let narrow = [&light[..], &["cam.keyway.depth=30mm", "cam.balance=80mm .. 81mm"]].concat();
    let refused = findings("dpi", &narrow);
    let note = of(&refused, "balance").note.clone().expect("a note");
    assert!(note.contains("none leaves less than"), "{note}");
    let band = note.split("cam.balance = \"").nth(1).and_then(|rest| rest.split('"').next()).expect(&note);
    let band = format!("cam.balance={band}");
    let wider = [&light[..], &["cam.keyway.depth=30mm", &band]].concat();
    assert_eq!(of(&findings("dpi", &wider), "balance").verdict, Verdict::Pass, "{band}");
    // The lift of the default cam is as large as its base circle: no row of holes balances that.
    let heavy = findings("dpi", &["cam.balance=40mm .. 85mm"]);
    let note = of(&heavy, "balance").note.as_deref().expect("a note");
    assert!(note.ends_with("no wider band would do"), "{note}");
    // Equal lobes balance each other.
    let lobes = findings("dpi", &["cam.cam_turns_per_crank_turn=0.3333", "cam.balance=40mm .. 85mm"]);
    assert_eq!(of(&lobes, "balance").note.as_deref(), Some("nothing to balance"));
}

#[test]
fn a_refusal_names_what_would_pass() {
    let refused = findings("dpi-paper", &["cam.base_radius=200mm"]);
    let finding = of(&refused, "pressure_angle");
    assert_eq!(finding.verdict, Verdict::Fail);
    assert!(finding.value > 60.0 && finding.limit == Some(30.0), "{finding:?}");
    let note = finding.note.as_deref().expect("a note");
    let base = note.strip_prefix("a base radius of ").and_then(|n| n.strip_suffix(" would pass")).expect(note);
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

/// Limits on a three-dimensional cam: the same list is walked, so none of them is passed over.
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

/// Every check has a name of its own and says what it means; what is found is found by one of them.
#[test]
fn the_list_of_checks_is_the_only_one() {
    let mut names: Vec<&str> = CHECKS.iter().map(|check| check.name).collect();
    for finding in findings("dpi", &["cam.balance=40mm .. 85mm"]) {
        assert!(names.contains(&&*finding.check), "{finding:?}");
    }
    assert!(CHECKS.iter().all(|check| check.about.len() > 20 && check.about.ends_with('.')));
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), CHECKS.len());
}
