//! The smallest cam: worked cases of the textbooks, places of the follower that are left open, `camgen size`.

use crate::common::program::{self, camgen, files, number, report};
use serde_json::Value;
use std::fs;

/// 1 in up in 90°, a dwell of 90°, back in 90°, both cycloidal.
const NORTON: &str = r#"name = "worked case"
[motion]
start = "0 in"
[[motion.segment]]
law = "cycloidal"
over = "90 deg"
to = "1 in"
[[motion.segment]]
law = "dwell"
over = "90 deg"
[[motion.segment]]
law = "cycloidal"
over = "90 deg"
to = "0 in"
[[motion.segment]]
law = "dwell"
"#;

const FLAT: &str = "[follower.flat]\n[limits]\nmin_convex_radius = \"0.25 in\"\n";
const ROLLER: &str = "[follower.roller]\nradius = \"0.5 in\"\n[limits]\npressure_angle = \"30 deg\"\n\
                      min_convex_pitch_radius_over_roller = 1\n";

/// 30 mm up in 120° and back in 150°.
const LIFTER: &str = r#"name = "lifter"
[motion]
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "30 mm"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "3-4-5"
over = "150 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "3 mm"
offset = "auto"
"#;

/// `camgen make` of a file, without files.
fn make(text: &str, more: &[&str]) -> program::Run {
    program::make(text, &[&["--dry-run", "--json"], more].concat())
}

/// The report on a cam that passes.
fn of(text: &str, more: &str) -> Value {
    let made = report(&make(&format!("{text}{more}"), &[]));
    assert_eq!(made["checks"].as_array().expect("checks").iter().filter(|check| check["verdict"] == "fail").count(), 0);
    made
}

/// Figures of general-cams.md, which are those of a textbook: 1.8926 in and 2.5465 in.
#[test]
fn a_flat_face_under_a_cycloidal_motion() {
    let made = of(NORTON, FLAT);
    let inches = |value: &Value| number(value) / 25.4;
    assert!((inches(&made["size"]["smallest_base_radius_mm"]) - 1.8926).abs() < 5e-5, "{}", made["size"]);
    let width = made["checks"].as_array().expect("checks").iter().find(|check| check["check"] == "face_width");
    assert!((inches(&width.expect("a width")["value"]) - 2.5465).abs() < 5e-5, "{width:?}");
    assert_eq!(made["size"]["binding"], "min_convex_radius");
}

/// 1.250945 in under a roller of 0.5 in with 30°.
#[test]
fn a_roller_under_the_same_motion() {
    let made = of(NORTON, ROLLER);
    let base = number(&made["size"]["smallest_base_radius_mm"]) / 25.4;
    assert!((base - 1.250_945).abs() < 5e-7, "{base}");
    assert_eq!(made["size"]["binding"], "pressure_angle");
}

/// A simple harmonic motion over half a turn each way makes an eccentric circle under a flat face.
#[test]
fn simple_harmonic_motion_makes_a_circle_of_two_arcs() {
    let harmonic = NORTON
        .replace("law = \"cycloidal\"\nover = \"90 deg\"", "law = \"harmonic\"\nover = \"180 deg\"")
        .replace("[[motion.segment]]\nlaw = \"dwell\"\nover = \"90 deg\"\n", "")
        .replacen("over = \"180 deg\"\nto = \"0 in\"\n[[motion.segment]]\nlaw = \"dwell\"\n", "to = \"0 in\"\n", 1);
    let made = of(&harmonic, "[follower.flat]\n[cam]\nbase_radius = \"30 mm\"\n");
    assert_eq!(made["outline"]["arcs"], 2, "{}", made["outline"]);
    assert!(number(&made["outline"]["deviation_max_mm"]) < 1e-12, "{}", made["outline"]);
}

/// Golden numbers G37 and G38: the best offset before it is rounded.
#[test]
fn the_best_offset_is_that_of_the_convex_region() {
    for (limits, prime_radius, offset) in [
        ("pressure_angle = \"30 deg\"\n", 27.968_068_710_370_43, 1.797_435_224_662_283),
        (
            "pressure_angle = \"30 deg\"\npressure_angle_return = \"45 deg\"\n",
            19.621_874_916_440_54,
            7.425_167_245_611_903,
        ),
    ] {
        let made = of(LIFTER, &format!("[limits]\n{limits}min_convex_pitch_radius_over_roller = 1\n"));
        let best = &made["size"]["best"];
        assert!((number(&best["prime_radius_mm"]) - prime_radius).abs() < 1e-8, "{best}");
        assert!((number(&best["offset_mm"]) - offset).abs() < 1e-8, "{best}");
        let chosen = number(&made["size"]["offset_mm"]);
        assert!((2.0 * chosen).fract() == 0.0 && (chosen - offset).abs() < 0.5, "{chosen}");
        assert!(number(&made["cam"]["base_radius_mm"]).fract().abs() < 1e-9, "{}", made["cam"]);
    }
}

/// With a given base radius the offset is that of the least pressure angle: no other half millimetre has a smaller one.
#[test]
fn on_a_given_base_radius_the_offset_flattens_the_cam() {
    let angle = |offset: &str| {
        let text = LIFTER.replace("\"auto\"", &format!("\"{offset}\"")) + "[cam]\nbase_radius = \"40 mm\"\n";
        let made = report(&make(&text, &[]));
        let check = made["checks"].as_array().expect("checks").iter().find(|check| check["check"] == "pressure_angle");
        (number(&check.expect("the check")["value"]), made["size"]["offset_mm"].clone())
    };
    let (least, chosen) = angle("auto");
    let chosen = number(&chosen);
    for beside in [-2.0, -1.0, 1.0, 2.0] {
        let (other, _) = angle(&format!("{} mm", chosen + 0.5 * beside));
        assert!(other > least - 1e-9, "{beside}: {other} {least}");
    }
}

#[test]
fn auto_is_refused_where_it_means_nothing() {
    for command in [["rotary", "dpi", "--rpm", "35"], ["conoid", "dpi", "--rpm", "20,35"]] {
        let run = camgen(&[&command[..], &["--set", "follower.roller.offset=auto", "--dry-run"]].concat());
        assert_eq!((run.code, files(run.directory.path())), (2, Vec::new()), "{}", run.out);
        assert!(run.err.contains("follower.roller.offset") && run.err.contains("give a"), "{}", run.err);
    }
}

/// A lever that swings too far for its limit stands nowhere.
#[test]
fn no_place_is_told_with_the_key() {
    let text = LIFTER.replace("30 mm", "100 deg").replace("0 mm\"", "0 deg\"").replace(
        "[follower.roller]\nradius = \"3 mm\"\noffset",
        "[follower.swinging-roller]\nradius = \"3 mm\"\narm = \"60 mm\"\npivot_distance",
    );
    let run = make(&text, &["--set", "limits.pressure_angle=10deg"]);
    assert_eq!(run.code, 2, "{}", run.out);
    assert!(run.err.contains("follower.swinging-roller.pivot_distance"), "{}", run.err);
}

/// The trade of `camgen size` has its least row where the optimum is, and no row below it.
#[test]
fn no_row_of_the_trade_is_below_the_optimum() {
    for (machine, free, column) in [("feeder", "offset", "offset_mm"), ("lever", "pivot-distance", "pivot_distance_mm")]
    {
        let run = camgen(&["size", machine, "--free", free, "--json", "--name", "trade"]);
        assert_eq!(run.code, 0, "{}", run.err);
        let best = number(&report(&run)["size"]["best"]["prime_radius_mm"]);
        let table = fs::read_to_string(run.directory.path().join("output/trade.csv")).expect("a table");
        let mut lines = table.lines();
        assert!(lines.next().is_some_and(|head| head.starts_with(&format!("{column},prime_radius_mm"))), "{table}");
        let radii: Vec<f64> = lines
            .filter_map(|line| line.split(',').nth(1)?.parse().ok())
            .filter(|radius: &f64| radius.is_finite())
            .collect();
        assert!(radii.len() > 20 && radii.iter().all(|radius| *radius >= best * (1.0 - 1e-9)), "{best} {radii:?}");
    }
}

/// Golden number G23: the largest pressure angles of a roller of 15 mm on a prime radius of 70 mm, offset by 12 mm, rising and returning;
/// the check tells that which is nearer to its limit.
#[test]
fn the_largest_pressure_angle_of_each_way() {
    let cam = LIFTER.replace("radius = \"3 mm\"\noffset = \"auto\"", "radius = \"15 mm\"\noffset = \"12 mm\"");
    for (limit, angle, at) in
        [("10 deg", 9.007_502_282_635_796, 56.979_532_266_4), ("30 deg", 22.185_495_994_365_97, 234.836_677_993_9)]
    {
        let limits = format!("[limits]\npressure_angle = \"{limit}\"\npressure_angle_return = \"40 deg\"\n");
        let made = of(&cam, &format!("[cam]\nbase_radius = \"55 mm\"\n{limits}"));
        let checks = made["checks"].as_array().expect("checks");
        let found = checks.iter().find(|found| found["check"] == "pressure_angle").expect("a check");
        assert!((number(&found["value"]) - angle).abs() < 1e-12 * angle, "{found}");
        // An angle is flat at its largest value: half of its digits tell the place.
        assert!((number(&found["cam_deg"]) - at).abs() < 1e-6, "{found}");
    }
}

/// Golden number G43, with the digits that are told: 36.4442366978389° to 56.29049719543127°, 0.2568343694781067 mm at 46.1845532°.
#[test]
fn the_motion_that_an_undercut_loses() {
    let motion = NORTON.replace("90 deg", "60 deg").replace("1 in", "30 mm").replace("0 in", "0 mm");
    let motion = motion.replace("[[motion.segment]]\nlaw = \"dwell\"\nover = \"60 deg\"\n", "");
    let made =
        report(&make(&format!("{motion}[follower.roller]\nradius = \"26 mm\"\n[cam]\nbase_radius = \"16 mm\"\n"), &[]));
    let checks = made["checks"].as_array().expect("checks");
    let undercut = checks.iter().find(|found| found["check"] == "undercut").expect("a check");
    let note = undercut["note"].as_str().expect("a note");
    assert!(note.starts_with("motion is lost from 36.444° to 56.290°, 0.2568 mm at 46.185°; "), "{note}");
}
