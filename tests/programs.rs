//! Motion programs as a user writes them: laws between moving ends, turns, lobes, and what is wrong with a program.

#![allow(clippy::expect_used, clippy::panic, missing_docs, reason = "a test fails loudly")]

#[path = "common/program.rs"]
mod program;

use program::{Run, camgen, camgen_in, files, report};
use serde_json::Value;
use std::fs;

/// A program over a turn with states at its nodes.
const FEEDER: &str = r#"name = "Feeder lever"
[motion]
rpm = 120
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "30 mm"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "polynomial"
until = "210 deg"
to = "18 mm"
velocity = "-0.3 mm/deg"
acceleration = "0 mm/deg2"
[[motion.segment]]
law = "constant-velocity"
velocity = "-0.3 mm/deg"
to = "12 mm"
[[motion.segment]]
law = "modified-sine"
over = "40 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "15 mm"
offset = "12 mm"
[cam]
base_radius = "55 mm"
"#;

/// Up in 100° to a turn, down in 140° with the same acceleration there, rest.
const TURN: &str = r#"name = "turn"
[motion]
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "100 deg"
to = "30 mm"
end = "turn"
[[motion.segment]]
law = "modified-sine"
over = "140 deg"
to = "0 mm"
inflection = "match"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "10 mm"
"#;

fn run(text: &str, args: &[&str]) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("cam.toml"), text).expect("written");
    camgen_in(directory, &[&["make", "cam.toml"], args].concat())
}

fn told(text: &str) -> Value {
    let run = run(text, &["--dry-run", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    report(&run)
}

fn number(told: &Value) -> f64 {
    told.as_f64().unwrap_or_else(|| panic!("{told}"))
}

fn finding<'a>(report: &'a Value, check: &str) -> &'a Value {
    let checks = report["checks"].as_array().expect("checks");
    checks.iter().find(|found| found["check"] == check).unwrap_or_else(|| panic!("no {check}: {checks:?}"))
}

/// Values of 40-digit arithmetic: the lift and the profile at 250°, and the largest pressure angle.
#[test]
fn a_program_with_states_is_cut_as_known() {
    let made = run(FEEDER, &["--samples", "36"]);
    assert_eq!(made.code, 0, "{}", made.err);
    assert_eq!(
        files(&made.directory.path().join("output")),
        ["csv", "dxf", "svg"].map(|end| format!("cam-make-120rpm.{end}"))
    );
    let csv = fs::read_to_string(made.directory.path().join("output/cam-make-120rpm.csv")).expect("a table");
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().expect("names").split(',').collect();
    let row = lines.find(|line| line.starts_with("250,")).expect("a row");
    let row: Vec<f64> = row.split(',').map(|cell| cell.parse().expect("a number")).collect();
    let at = |name: &str| row[names.iter().position(|other| *other == name).expect("a column")];
    for (name, known) in
        [("lift_mm", 4.704_929_658_551), ("profile_x_mm", -15.452_808_861_177), ("profile_y_mm", -58.408_700_734_571)]
    {
        assert!((at(name) - known).abs() < 1e-11, "{name}: {}", at(name));
    }
    let report = told(FEEDER);
    let angle = number(&finding(&report, "pressure_angle")["value"]);
    assert!((angle - 25.930_887_523_925).abs() < 1e-11, "{angle}");
    let classes: Vec<&str> = report["motion"]["segments"]
        .as_array()
        .expect("segments")
        .iter()
        .map(|segment| segment["class"].as_str().expect("a class"))
        .collect();
    assert_eq!(classes, ["R-R", "R-R", "R-G", "G-G", "G-R", "R-R"]);
    assert_eq!(number(&finding(&report, "continuity")["value"]), 2.0);
}

/// The acceleration at the turn is one, −55.55369314582335 mm/rad², and the return's inflection lies 0.2429… behind it.
#[test]
fn a_turn_is_matched_from_both_sides() {
    let report = told(TURN);
    let segments = &report["motion"]["segments"];
    for index in [0, 1] {
        let peaks = &segments[index]["peaks"];
        assert!((number(&peaks["acceleration"]) - 55.553_693_145_823_35).abs() < 1e-11, "{peaks}");
        assert!((number(&peaks["acceleration_at_deg"]) - 100.0).abs() < 1e-9, "{peaks}");
    }
    assert_eq!((&segments[0]["class"], &segments[1]["class"]), (&Value::from("R-U"), &Value::from("U-R")));
    let inflection = (number(&segments[1]["peaks"]["velocity_at_deg"]) - 100.0) / 140.0;
    assert!((inflection - 0.242_903_536_761_422_9).abs() < 1e-9, "{inflection}");
    // Without the match the acceleration jumps there.
    let jumping = told(&TURN.replace("inflection = \"match\"\n", ""));
    assert_eq!(number(&finding(&jumping, "continuity")["value"]), 1.0);
}

#[test]
fn lobes_repeat_the_program_and_it_may_begin_anywhere() {
    let lobes =
        TURN.replace("[motion]", "[motion]\nrepeat = 2").replace("100 deg", "60 deg").replace("140 deg", "80 deg");
    let report = told(&lobes);
    assert_eq!(
        (number(&report["motion"]["repeat"]), finding(&report, "rolling")["verdict"].as_str()),
        (2.0, Some("pass"))
    );
    let (here, there) = (told(TURN), told(&TURN.replace("[motion]", "[motion]\nat = \"-75 deg\"")));
    let place = |report: &Value| number(&finding(report, "pressure_angle")["cam_deg"]);
    let apart = (place(&here) - place(&there)).rem_euclid(360.0);
    assert!((apart - 75.0).abs() < 1e-6, "{apart}");
    assert_eq!(finding(&here, "pressure_angle")["value"], finding(&there, "pressure_angle")["value"]);
}

/// Two of angle, travel and velocity make a straight line; rates by the time are those at the speed of the cam.
#[test]
fn a_line_and_rates_by_the_time_mean_the_same() {
    let known = told(FEEDER)["motion"].clone();
    let by_time = FEEDER.replace("velocity = \"-0.3 mm/deg\"\nacceleration", "velocity = \"-216 mm/s\"\nacceleration");
    let by_angle = FEEDER.replace("velocity = \"-0.3 mm/deg\"\nto = \"12 mm\"", "over = \"20 deg\"\nby = \"-6 mm\"");
    let by_travel =
        FEEDER.replace("velocity = \"-0.3 mm/deg\"\nto = \"12 mm\"", "over = \"20 deg\"\nvelocity = \"-0.3 mm/deg\"");
    for text in [by_time, by_angle, by_travel] {
        let other = told(&text)["motion"].clone();
        for (one, other) in
            known["segments"].as_array().expect("all").iter().zip(other["segments"].as_array().expect("all"))
        {
            assert!((number(&one["to"]) - number(&other["to"])).abs() < 1e-12, "{one} {other}");
            let peak = |segment: &Value| number(&segment["peaks"]["velocity"]);
            assert!((peak(one) - peak(other)).abs() < 1e-11, "{one} {other}");
        }
    }
}

#[test]
fn what_is_wrong_with_a_program_is_told_at_its_place() {
    let replaced = |from: &str, to: &str| FEEDER.replacen(from, to, 1);
    for (text, parts) in [
        (replaced("until = \"210 deg\"", "until = \"140 deg\""), &["must be behind the start of the segment, 150"][..]),
        (replaced("until = \"210 deg\"", "until = \"210 deg\"\nover = \"60 deg\""), &["`over` or `until`, not both"]),
        (replaced("to = \"18 mm\"", "to = \"18 mm\"\nby = \"2 mm\""), &["`to` or `by`, not both"]),
        (replaced("-0.3 mm/deg", "-0.3 deg/deg"), &["is of an angle, but motion.start is a length"]),
        (replaced("-0.3 mm/deg", "-0.3 mm"), &["`velocity`", "mm/deg, mm/rad"]),
        (
            replaced("rpm = 120\n", "").replace("-0.3 mm/deg\"\nacc", "-216 mm/s\"\nacc"),
            &["by the time needs motion.rpm"],
        ),
        (replaced("mm/deg2", "mm/deg"), &["`acceleration`", "with 2 behind the second unit"]),
        (
            replaced("law = \"polynomial\"", "law = \"gutman-1-3\""),
            &["gutman-1-3 cannot end at", "laws that can: ", "modified-sine"],
        ),
        (
            replaced("law = \"polynomial\"", "law = \"polynomal\""),
            &["no law \"polynomal\"", "did you mean \"polynomial\""],
        ),
        (replaced("velocity = \"-0.3 mm/deg\"\nto", "velocity = \"0.3 mm/deg\"\nto"), &["leads away from `to`"]),
        (
            replaced("over = \"40 deg\"", "over = \"40 deg\"\ninflection = \"middle\""),
            &["`inflection` cannot be \"middle\""],
        ),
        (
            replaced("over = \"40 deg\"", "over = \"40 deg\"\ninflection = \"match\""),
            &["takes the acceleration at a turn"],
        ),
        (replaced("over = \"40 deg\"", "over = \"40 deg\"\nend = \"moving\""), &["a moving end needs a velocity"]),
        (replaced("start = \"0 mm\"", "start = \"0 mm\"\nrepeat = 1.5"), &["must be a whole number"]),
        (replaced("start = \"0 mm\"", "start = \"0 mm\"\nrepeat = 2"), &["already cover 270"]),
        (TURN.replace("end = \"turn\"\n", "end = \"turn\"\nvelocity = \"1 mm/deg\"\n"), &["a turn has the velocity 0"]),
    ] {
        let run = run(&text, &[]);
        assert_eq!(run.code, 2, "{parts:?}: {}{}", run.out, run.err);
        for part in parts {
            assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
        }
        assert!(run.err.contains("cam.toml:"), "{}", run.err);
        assert!(!run.directory.path().join("output").exists());
    }
}

/// A line between rests is an impact, and refused by its check.
#[test]
fn an_impact_is_refused() {
    let text = TURN.replace("end = \"turn\"\n", "").replace("inflection = \"match\"\n", "");
    let text = text.replace("law = \"modified-sine\"\nover = \"140 deg\"", "law = \"line\"\nover = \"140 deg\"");
    let run = run(&text, &["--json"]);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    let report = report(&run);
    let found = finding(&report, "continuity");
    assert_eq!((found["verdict"].as_str(), number(&found["value"])), (Some("fail"), 0.0));
    assert!(found["note"].as_str().is_some_and(|note| note.contains("the velocity jumps by")), "{found}");
    let explained = camgen(&["explain", "continuity"]);
    assert!(explained.code == 0 && explained.out.contains("an impact"), "{}", explained.out);
}
