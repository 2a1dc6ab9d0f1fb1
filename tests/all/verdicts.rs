//! Verdicts on what is asked for: small designs that were judged wrongly once, each for its whole kind.

use crate::common::program::{Run, close, finding, make, number, number_of, report, run};
use serde_json::Value;

/// The report of a design, which must end with this code.
#[track_caller]
fn judged(code: i32, text: &str, more: &[&str]) -> Value {
    let made = make(text, &[&["--dry-run", "--json"], more].concat());
    assert_eq!(made.code, code, "{}{}", made.out, made.err);
    report(&made)
}

#[track_caller]
fn verdict(report: &Value, check: &str) -> String {
    finding(report, check)["verdict"].as_str().expect("a verdict").to_owned()
}

#[track_caller]
fn note(report: &Value, check: &str) -> String {
    finding(report, check)["note"].as_str().unwrap_or_default().to_owned()
}

/// Up by a half that ends in a turn, then down by another law, rest.
fn behind_a_turn(rise: &str, fall: &str) -> String {
    format!(
        "name = \"turn\"\n[motion]\nrpm = 300\nstart = \"0 mm\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nover = \"100 deg\"\n\
         to = \"20 mm\"\nend = \"turn\"\n{rise}\n[[motion.segment]]\nover = \"120 deg\"\nto = \"0 mm\"\n{fall}\n[[motion.segment]]\nlaw = \"dwell\"\n\
         [follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"auto\"\n"
    )
}

/// What follows a turn begins with the acceleration with which the segment before it ends.
#[test]
fn a_turn_has_one_acceleration() {
    let spline = "law = \"spline\"\npoints = [[\"160 deg\", \"9 mm\"]]";
    for (fall, continuity) in [
        ("law = \"polynomial\"", 2.0),
        (spline, 2.0),
        ("law = \"polynomial\"\nstart = \"free\"", 1.0),
        ("law = \"modified-sine\"", 1.0),
    ] {
        let report = judged(0, &behind_a_turn("", fall), &[]);
        assert_eq!(number(&finding(&report, "continuity")["value"]), continuity, "{fall}");
    }
}

/// A half whose inflection is not given takes the acceleration that a formula has at its turn; a given one stays.
#[test]
fn a_half_matches_a_formula_behind_its_turn() {
    // s'' = 6 where it begins, 0 where it ends, with the travel −20 mm in 120°.
    let fall = "law = \"formula\"\nformula = \"3*x^2+x^3-6*x^4+3*x^5\"";
    let wanted = 20.0 * 6.0 / 120.0_f64.to_radians().powi(2);
    let at_turn = |report: &Value| {
        let peaks = &report["motion"]["segments"][0]["peaks"];
        (number(&peaks["acceleration"]), number(&peaks["acceleration_at_deg"]))
    };
    let matched = judged(0, &behind_a_turn("", fall), &[]);
    // The largest of the rise is elsewhere, or it is that at the turn.
    let (peak, at) = at_turn(&matched);
    assert!(at < 99.0 || (peak - wanted).abs() < 1e-9, "{peak} at {at}, wanted {wanted}");
    assert_eq!(number(&finding(&matched, "continuity")["value"]), 2.0);
    let free = judged(0, &behind_a_turn("inflection = \"smooth\"", fall), &[]);
    assert_eq!(number(&finding(&free, "continuity")["value"]), 1.0);
    assert_eq!(number(&finding(&free, "continuity")["cam_deg"]), 100.0);
}

#[test]
fn start_is_for_polynomials_and_splines() {
    let made = make(&behind_a_turn("", "law = \"cycloidal\"\nstart = \"free\""), &[]);
    assert_eq!(made.code, 2);
    assert!(made.err.contains("`start` applies only to polynomials and splines"), "{}", made.err);
}

/// The velocity jumps by 180 mm/rad where a lead ends; the change that is named is one with which the check passes.
#[test]
fn an_impact_of_a_press_cam_is_refused() {
    let judged = |code: i32, args: &[&str]| report(&run(code, &[args, &["--dry-run", "--json"]].concat()));
    let lead = judged(1, &["rotary", "--set", "buffer.lead=10mm"]);
    let found = finding(&lead, "continuity");
    assert_eq!((number(&found["value"]), number(&found["limit"])), (0.0, 1.0));
    assert_eq!(number(&found["cam_deg"]) % 180.0, 0.0, "{found}");
    assert!(note(&lead, "continuity").starts_with("the velocity jumps by 180 mm/rad"), "{found}");
    assert!(note(&lead, "continuity").contains("buffer.lead = \"0 mm\" would pass"), "{found}");
    judged(0, &["rotary", "--set", "buffer.lead=10mm", "--set", "limits.continuity=0"]);
    for (command, order) in [("rotary", 1.0), ("conoid", 1.0), ("translating", 1.0)] {
        let report = judged(0, &[command]);
        assert!(number(&finding(&report, "continuity")["value"]) >= order, "{command}");
    }
    // A crowned roller cannot run over the corner of a section at all.
    let conoid = run(2, &["conoid", "--set", "buffer.lead=10mm", "--rpm", "30,35", "--dry-run"]);
    assert!(conoid.err.contains("no buffer.lead"), "{}", conoid.err);
}

/// An air column of 298 m and a cam of 2.4 m fail unless they are asked for.
#[test]
fn absurd_sizes_are_refused() {
    let judged = |code: i32, args: &[&str]| report(&run(code, &[args, &["--dry-run", "--json"]].concat()));
    let slow = judged(1, &["rotary", "--rpm", "1"]);
    let column = finding(&slow, "column");
    close(number(&column["value"]), 297_675.0, 1e-12);
    assert_eq!((number(&column["limit"]), column["verdict"].as_str()), (2000.0, Some("fail")));
    let words = note(&slow, "column");
    let rpm = words.split("at ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a speed");
    assert!(words.starts_with("the customary limit; at "), "{words}");
    assert_eq!(verdict(&judged(0, &["rotary", "--rpm", rpm]), "column"), "pass");
    judged(0, &["rotary", "--rpm", "1", "--set", "limits.column=300 m"]);
    judged(1, &["regimes", "--rpm", "1,35"]);
    let huge = judged(1, &["rotary", "dpi-paper", "--set", "limits.size=2 m"]);
    assert!(number(&finding(&huge, "size")["value"]) > 2300.0 && verdict(&huge, "size") == "fail");
    judged(0, &["rotary", "dpi-paper"]);
    let metres = FLAT.replace("40 mm", "1.9 m").replace("base_radius = \"auto\"", "base_radius = \"9 m\"");
    let report = self::judged(1, &metres, &[]);
    assert!(note(&report, "size").contains("customary"), "{}", finding(&report, "size"));
}

/// A plate that leaves more force than no cam in both directions of the bed has no purpose; in one it warns.
#[test]
fn a_plate_must_be_better_than_none_in_one_direction() {
    let judged = |code: i32, args: &[&str]| report(&run(code, &[args, &["--dry-run", "--json"]].concat()));
    let mean = judged(1, &["translating", "--balance", "mean"]);
    assert_eq!(verdict(&mean, "residual"), "fail");
    assert!(note(&mean, "residual").contains("3389.7"), "{}", note(&mean, "residual"));
    assert_eq!(verdict(&judged(0, &["translating"]), "residual"), "warn");
}

/// A bore that is rounded to a hundredth of a millimetre leaves a few millimetres per second; one that is half a millimetre off does not pass.
#[test]
fn a_drive_closes_by_its_arrival_speed() {
    let judged = |code: i32, args: &[&str]| report(&run(code, &[args, &["--json"]].concat()));
    let own = judged(0, &["drive"]);
    assert_eq!(number(&finding(&own, "closing")["value"]), 0.0);
    let bore = number(&own["drive"]["bore_mm"]);
    let near = judged(0, &["drive", "--set", &format!("drive.bore={bore:.2} mm")]);
    assert!((0.0..0.05).contains(&number(&finding(&near, "closing")["value"])), "{}", finding(&near, "closing"));
    let off = judged(1, &["drive", "--set", &format!("drive.bore={:.2} mm", bore - 5.0)]);
    assert_eq!((verdict(&off, "closing").as_str(), finding(&off, "closing")["unit"].as_str()), ("fail", Some("m/s")));
}

/// The contact of a sphere that runs is judged by the fatigue limit; up to the limit at rest it is a warning.
#[test]
fn running_contact_is_judged_by_its_fatigue_limit() {
    let report = report(&run(0, &["conoid", "--dry-run", "--json"]));
    let found = finding(&report, "contact_stress");
    assert_eq!((number(&found["limit"]), found["verdict"].as_str()), (1500.0, Some("warn")));
    assert!(note(&report, "contact_stress").contains("at rest under a sphere it is 4200 MPa"), "{found}");
}

const KEYWAY: &str = r#"name = "keyway"
[motion]
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "100 deg"
to = "10 mm"
[[motion.segment]]
law = "dwell"
over = "80 deg"
[[motion.segment]]
law = "modified-sine"
over = "100 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "8 mm"
[cam]
base_radius = "22 mm"
bore_radius = "18 mm"
thickness = "8 mm"
[cam.keyway]
width = "8 mm"
depth = "4 mm"
angle = "140 deg"
"#;

/// A keyway under the lobe takes nothing of the wall; on the other side it does. `auto` knows both.
#[test]
fn the_wall_is_measured_where_the_keyway_is() {
    let under = judged(0, KEYWAY, &[]);
    assert!((number(&finding(&under, "wall")["value"]) - 4.0).abs() < 2e-3, "{}", finding(&under, "wall"));
    let opposite = KEYWAY.replace("140 deg", "320 deg");
    let thin = judged(1, &opposite, &[]);
    // The corners of the slot are at √(22² + 4²) mm.
    let corner = 22.0 - libm::hypot(22.0, 4.0);
    assert!((number(&finding(&thin, "wall")["value"]) - corner).abs() < 2e-3, "{}", finding(&thin, "wall"));
    assert_eq!(number(&finding(&thin, "wall")["limit"]), 3.0);
    let auto = |text: &str| {
        let report = judged(0, &text.replace("base_radius = \"22 mm\"", "base_radius = \"auto\"\n"), &[]);
        (number(&report["cam"]["base_radius_mm"]), number(&finding(&report, "wall")["value"]))
    };
    let ((free, _), (grown, wall)) = (auto(KEYWAY), auto(&opposite));
    assert!(free < grown && wall >= 3.0 - 5e-3, "{free} {grown} {wall}");
    // Beside the slot no other keyway matters, whichever way the cam turns.
    let turned = opposite.replace("thickness = \"8 mm\"", "thickness = \"8 mm\"\nrotation = \"ccw\"");
    let (radius, left) = auto(&turned);
    assert!((radius - grown).abs() + (left - wall).abs() < 1e-9, "{radius} {left}");
}

/// Without a limit the customary one holds: Ø30 with a wall of 1 mm is no hub. `auto` leaves 3 mm.
#[test]
fn a_wall_is_left_by_default() {
    let text = |base: &str| {
        KEYWAY.split("[cam.keyway]").next().expect("a cam").replace("22 mm", base).replace("18 mm", "15 mm")
    };
    let thin = judged(1, &text("16 mm"), &[]);
    assert!(note(&thin, "wall").starts_with("the customary limit"), "{}", note(&thin, "wall"));
    judged(
        0,
        &text("16 mm").replace("[cam]", "[limits]\nwall = \"0 mm\"\nmin_convex_pitch_radius_over_roller = 1.0\n[cam]"),
        &[],
    );
    let report = judged(0, &text("auto"), &[]);
    assert!(number(&finding(&report, "wall")["value"]) >= 3.0 - 5e-3);
    // Of a large bore its share is more.
    let large = text("46 mm").replace("15 mm", "40 mm");
    assert_eq!(number(&finding(&judged(0, &large, &[]), "wall")["limit"]), 6.0);
}

/// Within the tolerance the outline lies inside of the exact one, and would cut through the bore.
#[test]
fn a_bore_that_cuts_through_the_written_outline_is_refused() {
    let text = r#"name = "thin2"
[motion]
start = "0 mm"
formula = "3*sin(th)+2*cos(3*th)"
[follower.roller]
radius = "10 mm"
[cam]
base_radius = "30 mm"
bore_radius = "29.99 mm"
thickness = "5 mm"
[limits]
wall = "0 mm"
"#;
    let rough = ["--tolerance", "50um", "--tolerance-acceleration", "none", "--side", "inside"];
    let report = judged(1, text, &rough);
    assert!(number(&finding(&report, "wall")["value"]) < 0.0, "{}", finding(&report, "wall"));
    assert!(note(&report, "wall").contains("finer --tolerance"), "{}", note(&report, "wall"));
    // The exact wall is 0.01 mm, and the outline at a finer tolerance leaves it.
    judged(0, text, &["--tolerance", "5um"]);
}

const FLAT: &str = r#"name = "flat"
[motion]
rpm = 60
start = "0 mm"
[[motion.segment]]
law = "cycloidal"
over = "60 deg"
to = "40 mm"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "cycloidal"
over = "60 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.flat]
[cam]
base_radius = "auto"
[limits]
min_convex_radius = "0.05 mm"
"#;

#[test]
fn a_given_convex_radius_below_a_millimetre_is_kept_by_auto() {
    let report = judged(0, FLAT, &[]);
    assert_eq!(number(&report["cam"]["base_radius_mm"]), 193.0);
    let usual = judged(0, &FLAT.replace("min_convex_radius = \"0.05 mm\"\n", ""), &[]);
    assert_eq!(number(&usual["cam"]["base_radius_mm"]), 194.0);
}

/// A hand cam with corners that its continuity allows; without that the impact is the cause, and the remedy is one of motion programs.
#[test]
fn a_knife_edge_follows_allowed_corners() {
    let text = r#"name = "hand cam"
[motion]
rpm = 20
start = "0 mm"
[[motion.segment]]
law = "dwell"
over = "180 deg"
[[motion.segment]]
law = "constant-velocity"
until = "267 deg"
to = "10 mm"
[[motion.segment]]
law = "dwell"
over = "6 deg"
[[motion.segment]]
law = "constant-velocity"
to = "0 mm"
[follower.knife]
[cam]
base_radius = "40 mm"
[limits]
continuity = 0
"#;
    let report = judged(0, text, &[]);
    assert_eq!((verdict(&report, "undercut").as_str(), verdict(&report, "tangency").as_str()), ("pass", "pass"));
    let impact = judged(1, &text.replace("continuity = 0\n", ""), &[]);
    assert_eq!(verdict(&impact, "continuity"), "fail");
    let roller = text.replace("[follower.knife]", "[follower.roller]\nradius = \"5 mm\"");
    let words = note(&judged(1, &roller, &["--force"]), "undercut");
    assert!(words.contains("states or laws of the segments") && !words.contains("transition"), "{words}");
}

/// `auto` keeps the customary contact stress, as the check does.
#[test]
fn auto_keeps_the_customary_contact_stress() {
    let text = r#"name = "stress"
[motion]
rpm = 60
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "15 mm"
[[motion.segment]]
law = "dwell"
over = "60 deg"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "10 mm"
mass = "1 kg"
preload = "4500 N"
[cam]
base_radius = "auto"
thickness = "10 mm"
material = "steel"
"#;
    let report = judged(0, text, &[]);
    close(number(&report["cam"]["base_radius_mm"]), 29.0, 1e-12);
    // Where the follower would leave the cam, its force is 0 in the table, too.
    let light = text.replace("4500 N", "0.3 N").replace("rpm = 60", "rpm = 600");
    let made = make(&light, &["--force", "--format", "csv", "--samples", "360"]);
    assert_eq!(made.code, 1, "{}", made.err);
    let csv = std::fs::read_to_string(made.directory.path().join("output/cam-make-600rpm.csv")).expect("a table");
    let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let column =
        lines.next().and_then(|names| names.iter().position(|name| name == "contact_force_n")).expect("a column");
    let forces: Vec<f64> = lines.map(|row| row[column].parse().expect("a number")).collect();
    assert!(forces.iter().all(|force| *force >= 0.0) && forces.contains(&0.0));
}

/// ½ k h² + F₀ h = 8 J: the torque is exactly 0 at half a turn.
#[test]
fn the_work_of_a_symmetric_formula_is_counted() {
    let text = r#"name = "work"
[motion]
rpm = 600
start = "0 mm"
formula = "20*(th*(2*pi-th))^2/pi^4"
[follower.roller]
radius = "10 mm"
mass = "0.2 kg"
[spring]
rate = "10 N/mm"
preload = "300 N"
[flywheel]
fluctuation = 0.02
[cam]
base_radius = "60 mm"
"#;
    let report = judged(0, text, &[]);
    close(number_of(&report["dynamics"], "work_fluctuation_j"), 8.0, 1e-9);
    let speed = 600.0 * std::f64::consts::TAU / 60.0;
    close(number_of(&report["dynamics"], "flywheel_kg_m2"), 8.0 / (0.02 * speed * speed), 1e-9);
}

/// The jerk of a law whose acceleration does not end at 0 is without bound between rests; the usual triple harmonic is C4.
#[test]
fn laws_report_continuity_and_jerk() {
    let table: Run = run(0, &["laws", "--format", "csv"]);
    let csv = std::fs::read_to_string(table.directory.path().join("output/laws-laws.csv")).expect("a table");
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().expect("names").split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let at = |law: &str, name: &str| {
        let column = names.iter().position(|other| *other == name).expect("a column");
        rows.iter().find(|row| row.contains(&law)).expect("the law")[column].to_owned()
    };
    assert_eq!(at("triple-harmonic", "continuity"), "4");
    let jerk = names.iter().find(|name| name.starts_with("jerk")).expect("a column of the jerk");
    assert_eq!(at("double-harmonic", jerk), "inf");
}

/// With the offset free as well no law needs a larger cam than with the base radius alone.
#[test]
fn laws_choose_what_is_free() {
    let smallest = |words: &[&str]| -> Vec<f64> {
        let table: Run = run(0, &[&["laws", "feeder", "--format", "csv", "--sort", "cv"], words].concat());
        let csv =
            std::fs::read_to_string(table.directory.path().join("output/feeder-laws-120rpm.csv")).expect("a table");
        let column = csv.lines().next().and_then(|names| names.split(',').position(|name| name == "prime_radius_mm"));
        let of = |row: &str| row.split(',').nth(column.expect("the radius")).and_then(|cell| cell.parse().ok());
        csv.lines().skip(1).filter_map(of).filter(|radius: &f64| radius.is_finite()).collect()
    };
    let given = smallest(&["--set", "cam.base_radius=auto"]);
    let free = smallest(&["--free", "offset"]);
    assert!(given.len() > 10 && given.len() == free.len());
    assert!(given.iter().zip(&free).all(|(given, free)| *free <= given * 1.001), "{given:?} {free:?}");
    assert!(given.iter().sum::<f64>() > 1.01 * free.iter().sum::<f64>(), "{given:?} {free:?}");
}

const PIVOT: &str = r#"name = "pivot"
[motion]
start = "0 deg"
[[motion.segment]]
law = "modified-sine"
over = "150 deg"
to = "40 deg"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "modified-sine"
over = "150 deg"
to = "0 deg"
[[motion.segment]]
law = "dwell"
[follower.swinging-roller]
radius = "10 mm"
arm = "100 mm"
pivot_distance = "60 mm"
side = "leading"
[cam]
base_radius = "40 mm"
thickness = "5 mm"
[limits]
pressure_angle = "80 deg"
min_convex_pitch_radius_over_roller = 1.05
"#;

/// A cam that sweeps over the pivot of its follower is told so, and refused where a clearance is asked for.
#[test]
fn a_pivot_within_the_cam_is_told() {
    let report = judged(0, PIVOT, &[]);
    assert_eq!(verdict(&report, "pivot_clearance"), "warn");
    assert!(note(&report, "pivot_clearance").contains("sweeps over the pivot"));
    let refused = judged(1, &format!("{PIVOT}pivot_clearance = \"5 mm\"\n"), &[]);
    assert_eq!(verdict(&refused, "pivot_clearance"), "fail");
    let outside = report_of_lever();
    assert!(outside["checks"].as_array().expect("checks").iter().all(|check| check["check"] != "pivot_clearance"));
}

fn report_of_lever() -> Value {
    report(&run(0, &["make", "lever", "--dry-run", "--json"]))
}

#[test]
fn a_tolerance_above_the_lift_is_refused() {
    let text = FLAT.replace("40 mm", "0.02 mm");
    let made = make(&text, &["--tolerance", "20um"]);
    assert_eq!(made.code, 2, "{}", made.out);
    assert!(made.err.contains("not below the lift of 20 um") && made.err.contains("finer --tolerance"), "{}", made.err);
    judged(0, &text, &["--tolerance", "2um"]);
}

/// A bore that no size in reach of the follower leaves a wall about is the cause that is named, with a bore that passes.
#[test]
fn the_cause_of_no_size_is_the_cause() {
    let refused = run(2, &["make", "lever", "--set", "cam.bore_radius=200mm"]);
    assert!(refused.err.contains("about a bore of radius 200 mm"), "{}", refused.err);
    let bore =
        refused.err.split("cam.bore_radius = \"").nth(1).and_then(|rest| rest.split('"').next()).expect("a bore");
    run(0, &["make", "lever", "--set", &format!("cam.bore_radius={bore}"), "--dry-run"]);
}
