//! Motion programs as a user writes them: laws between moving ends, turns, lobes, and what is wrong with a program.

use crate::common::program::{Run, camgen, camgen_in, files, finding, make, number, report};
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

fn told(text: &str) -> Value {
    let run = make(text, &["--dry-run", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    report(&run)
}

/// Values of 40-digit arithmetic: the lift and the profile at 250°, and the largest pressure angle.
#[test]
fn a_program_with_states_is_cut_as_known() {
    let made = make(FEEDER, &["--samples", "36"]);
    assert_eq!(made.code, 0, "{}", made.err);
    assert_eq!(
        files(&made.directory.path().join("output")),
        ["-review.svg", ".csv", ".dxf", ".svg"].map(|end| format!("cam-make-120rpm{end}"))
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
        (
            replaced("until = \"210 deg\"", "until = \"140 deg\""),
            &["must come after the start of the segment, 150"][..],
        ),
        (replaced("until = \"210 deg\"", "until = \"210 deg\"\nover = \"60 deg\""), &["`over` or `until`, not both"]),
        (replaced("to = \"18 mm\"", "to = \"18 mm\"\nby = \"2 mm\""), &["`to` or `by`, not both"]),
        (replaced("-0.3 mm/deg", "-0.3 deg/deg"), &["is that of an angle, but motion.start is a length"]),
        (replaced("-0.3 mm/deg", "-0.3 mm"), &["`velocity`", "mm/deg, mm/rad"]),
        (
            replaced("rpm = 120\n", "").replace("-0.3 mm/deg\"\nacc", "-216 mm/s\"\nacc"),
            &["per second needs motion.rpm"],
        ),
        (replaced("mm/deg2", "mm/deg"), &["`acceleration`", "with 2 after the second unit"]),
        (
            replaced("law = \"polynomial\"", "law = \"gutman-1-3\""),
            &["gutman-1-3 cannot end at", "laws that can: ", "modified-sine"],
        ),
        (
            replaced("law = \"polynomial\"", "law = \"polynomal\""),
            &["no law \"polynomal\"", "did you mean \"polynomial\""],
        ),
        (replaced("velocity = \"-0.3 mm/deg\"\nto", "velocity = \"0.3 mm/deg\"\nto"), &["points away from `to`"]),
        (
            replaced("over = \"40 deg\"", "over = \"40 deg\"\ninflection = \"middle\""),
            &["`inflection` cannot be \"middle\""],
        ),
        (
            replaced("over = \"40 deg\"", "over = \"40 deg\"\ninflection = \"match\""),
            &["takes the acceleration from a neighbour on the other side of a turn"],
        ),
        (replaced("over = \"40 deg\"", "over = \"40 deg\"\nend = \"moving\""), &["a moving end needs a velocity"]),
        (replaced("start = \"0 mm\"", "start = \"0 mm\"\nrepeat = 1.5"), &["must be a whole number"]),
        (replaced("start = \"0 mm\"", "start = \"0 mm\"\nrepeat = 2"), &["already cover 270"]),
        (
            TURN.replace("end = \"turn\"\n", "end = \"turn\"\nvelocity = \"1 mm/deg\"\n"),
            &["at a turn the velocity is 0"],
        ),
    ] {
        let run = make(&text, &[]);
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
    let run = make(&text, &["--json"]);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    let report = report(&run);
    let found = finding(&report, "continuity");
    assert_eq!((found["verdict"].as_str(), number(&found["value"])), (Some("fail"), 0.0));
    assert!(found["note"].as_str().is_some_and(|note| note.contains("the velocity jumps by")), "{found}");
    let explained = camgen(&["explain", "continuity"]);
    assert!(explained.code == 0 && explained.out.contains("an impact"), "{}", explained.out);
}

/// A motion in one, instead of segments.
fn in_one(keys: &str) -> String {
    format!(
        "name = \"in one\"\n[motion]\nstart = \"0 mm\"\n{keys}\n[follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"60 mm\"\n"
    )
}

/// A motion through rows that are so far apart that the curve leaves them by more than a hundredth of the lift.
fn in_rows(keys: &str) -> String {
    format!("{}[limits]\novershoot = \"1 mm\"\n", in_one(keys))
}

/// A run of `make cam.toml` beside other files.
fn run_beside(text: &str, files: &[(&str, &str)], args: &[&str]) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    for (name, text) in files.iter().chain(&[("cam.toml", text)]) {
        fs::write(directory.path().join(name), text).expect("written");
    }
    camgen_in(directory, &[&["make", "cam.toml"], args].concat())
}

/// A row of the table that a run has written: position, velocity, acceleration, jerk, in mm and rad.
fn row(made: &Run, angle: u32) -> [f64; 4] {
    assert_eq!(made.code, 0, "{}{}", made.out, made.err);
    let written = files(&made.directory.path().join("output"));
    let csv = written.iter().find(|name| name.contains(".csv")).expect("a table");
    let csv = fs::read_to_string(made.directory.path().join("output").join(csv)).expect("a table");
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().expect("names").split(',').collect();
    let row = lines.find(|line| line.starts_with(&format!("{angle},"))).expect("a row");
    let row: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
    ["position_mm", "velocity_mm_per_rad", "acceleration_mm_per_rad2", "jerk_mm_per_rad3"].map(|name| {
        row[names.iter().position(|other| *other == name).unwrap_or_else(|| panic!("no {name}: {names:?}"))]
    })
}

#[track_caller]
fn near(found: [f64; 4], known: [f64; 4], tolerance: f64) {
    for (found, known) in found.iter().zip(known) {
        assert!((found - known).abs() < tolerance * (1.0 + known.abs()), "{found} is not {known}");
    }
}

const POINTS: &str = r#"points = [["0 deg", "0 mm"], ["60 deg", "12 mm"], ["130 deg", "25 mm"], ["200 deg", "18 mm"], ["290 deg", "4 mm"]]"#;

/// The spline of 40-digit arithmetic at 100°, by points and by a table with and without the row that closes it.
#[test]
fn points_and_a_table_are_the_known_spline() {
    let known = [21.632_151_819_059_75, 10.504_873_044_522_27, -13.619_313_166_588_42, -14.696_224_865_491_6];
    near(row(&make(&in_rows(POINTS), &["--samples", "36"]), 100), known, 1e-11);
    for rows in [
        "0,0\n60,12\n130,25\n200,18\n290,4\n",
        "\u{feff}deg;mm\r\n0;0\r\n60;12\r\n130;25\r\n200;18 # top\r\n290;4\r\n360;0\r\n",
    ] {
        let made = run_beside(&in_rows("table = \"lift.csv\""), &[("lift.csv", rows)], &["--samples", "36"]);
        near(row(&made, 100), known, 1e-11);
    }
    let cubic = told(&in_rows(&format!("degree = 3\n{POINTS}")));
    assert_eq!(number(&finding(&cubic, "continuity")["value"]), 2.0);
}

/// The unit of a heading is read, or the table is refused: a lift that is a thousand times too small passes every check.
#[test]
fn a_heading_is_read_or_refused() {
    let made = |heading: &str, keys: &str, top: &str| {
        let rows = format!("{heading}\n0,0\n60,{top}\n130,{top}\n200,{top}\n290,0\n");
        let text = in_rows(&format!("table = \"lift.csv\"{keys}")).replace("\"1 mm\"", "\"9 mm\"");
        run_beside(&text, &[("lift.csv", &rows)], &["--samples", "36", "--force"])
    };
    for (heading, top, millimetres) in [
        ("angle (deg),lift (metres)", "0.01", 10.0),
        ("angle in deg,lift in metres", "0.01", 10.0),
        ("angle_deg,lift_m", "0.01", 10.0),
        ("Winkel (Grad),Hub (Zentimeter)", "1", 10.0),
        ("Winkel (Grad),Hub (Zoll)", "0.5", 12.7),
        ("angle deg,lift ('')", "0.5", 12.7),
    ] {
        let run = made(heading, "", top);
        assert_eq!(run.code, 0, "{heading}: {}{}", run.out, run.err);
        let found = row(&run, 60)[0];
        assert!((found - millimetres).abs() < 1e-9, "{heading}: {found}");
    }
    for (heading, keys, says) in [
        ("angle (deg),lift (furlong)", "", "names \"furlong\", which is not a known unit"),
        ("angle (deg),lift in furlongs", "", "names \"furlongs\""),
        ("angle (deg),lift (dm)", "", "in dm"),
        ("angle (deg),lift (feet)", "", "in ft"),
        ("angle deg,lift 1/100 mm", "", "has a factor, \"lift 1/100 mm\""),
        ("angle deg,lift mm x 100", "\nunit = \"mm\"", "has a factor, \"lift mm x 100\""),
        ("angle deg,lift .001in", "", "has a factor, \"lift .001in\""),
        ("angle deg;lift x 0,01", "", "has a factor, \"lift x 0,01\""),
        ("angle deg,lift counts", "", "names \"counts\", whose size is unknown"),
        ("angle,velocity", "", "no position by its heading: velocity"),
    ] {
        let run = made(heading, keys, "10");
        assert!(run.code == 2 && run.err.contains(says), "{heading}: {} {}", run.out, run.err);
    }
    for keys in ["\nunit = \"mm\"", "\nscale = 1"] {
        let run = made("angle (deg),lift (furlong)", keys, "10");
        assert_ne!(run.code, 2, "{}", run.err);
    }
    let run = made("angle deg,lift 1/100 mm", "\nscale = 0.01", "1000");
    assert!(run.code != 2 && (row(&run, 60)[0] - 10.0).abs() < 1e-9, "{}", run.err);
    let run = made("angle,lift", "", "0.5\"");
    assert!(run.code == 2 && run.err.contains("not two numbers"), "{}", run.err);
}

/// One motion as a formula, as a series and as a law; lobes and another first angle turn it.
#[test]
fn a_formula_and_a_series_are_the_motion_they_say() {
    for (keys, angle) in [
        ("formula = \"20*(1-cos(th))/2\"", 70),
        ("formula = \"20*sin(th/2)^2\"\nat = \"-50 deg\"", 20),
        ("fourier = { cos = [-10] }", 70),
        ("repeat = 3\nformula = \"10-10*cos(3*th)\"\nat = \"30 deg\"", 70),
    ] {
        let made = make(&in_one(keys), &["--samples", "36"]);
        let waves = if keys.contains("repeat") { 3.0 } else { 1.0 };
        let turned: f64 = if keys.contains("at =") { if waves > 1.0 { 40.0 } else { 70.0 } } else { 70.0 };
        let (sine, cosine) = (waves * turned.to_radians()).sin_cos();
        let known = [-10.0 * cosine, 10.0 * waves * sine, 10.0 * waves * waves * cosine, -10.0 * waves.powi(3) * sine];
        let base = if keys.contains("fourier") { 0.0 } else { 10.0 };
        near(row(&made, angle), [base + known[0], known[1], known[2], known[3]], 1e-12);
    }
    let text = in_one("formula = \"10*(1-cos(th))\"")
        .replace("\"0 mm\"", "\"0 deg\"")
        .replace("[follower.roller]", "[follower.swinging-roller]\narm = \"100 mm\"\npivot_distance = \"120 mm\"");
    let segment = told(&text)["motion"]["segments"][0].clone();
    assert_eq!(segment["law"], "formula");
    assert!((number(&segment["peaks"]["acceleration"]) - 10.0).abs() < 1e-9, "{segment}");
}

/// A formula and a table that are 3-4-5 are the law 3-4-5; a spline and "auto" are found as the spline of all their points.
#[test]
fn segments_by_formula_table_and_spline() {
    let of = |law: &str| {
        format!(
            "rpm = 120\n[[motion.segment]]\n{law}\nover = \"120 deg\"\nto = \"20 mm\"\n[[motion.segment]]\nlaw = \"dwell\"\nover = \"60 deg\"\n\
             [[motion.segment]]\nto = \"0 mm\""
        )
    };
    let shares: Vec<String> = (0..=24)
        .map(|i| f64::from(i) / 24.0)
        .map(|x| format!("{x},{}", x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)))
        .collect();
    let shares = shares.join("\n");
    let files = [("law.csv", shares.as_str())];
    let made = |law: &str| row(&run_beside(&in_one(&of(law)), &files, &["--samples", "36"]), 50);
    let known = made("law = \"3-4-5\"");
    near(made("law = \"formula\"\nformula = \"x^3*(10-15*x+6*x^2)\""), known, 1e-11);
    near(made("law = \"table\"\ntable = \"law.csv\""), known, 1e-9);
    near(made("law = \"table\"\ntable = \"law.csv\"\nends = \"rest\""), known, 1e-9);
    let rest = "[[motion.segment]]\nlaw = \"dwell\"";
    let spline = "[[motion.segment]]\nlaw = \"spline\"\npoints = [[\"60 deg\", \"12 mm\"], [\"130 deg\", \"25 mm\"], [\"200 deg\", \"18 mm\"]]\n\
                  over = \"290 deg\"\nto = \"0 mm\"\n";
    let node = |until: u32, to: u32| {
        format!(
            "[[motion.segment]]\nlaw = \"polynomial\"\nuntil = \"{until} deg\"\nto = \"{to} mm\"\nvelocity = \"auto\"\n"
        )
    };
    let last = "[[motion.segment]]\nlaw = \"polynomial\"\nuntil = \"290 deg\"\nto = \"0 mm\"\n";
    let auto = [node(60, 12), node(130, 25), node(200, 18), last.into()].concat();
    let at = |keys: &str| row(&make(&in_rows(keys), &["--samples", "36"]), 100);
    near(at(&format!("{auto}{rest}")), at(&format!("{spline}{rest}")), 1e-11);
    // All round the states are those of the closed spline.
    let closed = [node(60, 12), node(130, 25), node(200, 18), node(290, 4), node(360, 0)].concat();
    near(at(&closed), at(POINTS), 1e-11);
}

/// What ends in motion by its own formula hands its velocity and acceleration on: the acceleration jumps where the formula begins alone.
#[test]
fn a_segment_by_formula_hands_its_state_on() {
    let keys = "[[motion.segment]]\nlaw = \"formula\"\nformula = \"x^2\"\nover = \"120 deg\"\nto = \"20 mm\"\n\
                [[motion.segment]]\nlaw = \"polynomial\"\nover = \"60 deg\"\nto = \"30 mm\"\n\
                [[motion.segment]]\nlaw = \"polynomial\"\nto = \"0 mm\"\n";
    let report = told(&in_one(keys));
    let segments = report["motion"]["segments"].as_array().expect("segments");
    assert_eq!(segments.iter().map(|segment| &segment["class"]).collect::<Vec<_>>(), ["R-B", "B-R", "R-R"]);
    let checks = report["checks"].as_array().expect("checks");
    let continuity = checks.iter().find(|check| check["check"] == "continuity").expect("checked");
    // 40 mm over (2π/3)², where the formula begins.
    let at = (&continuity["value"], &continuity["cam_deg"]);
    assert_eq!((at.0.as_f64(), at.1.as_f64()), (Some(1.0), Some(0.0)), "{continuity}");
    assert!(continuity["note"].as_str().is_some_and(|note| note.contains("9.1189 mm/rad²")), "{continuity}");
}

/// Messages for motions in one, each with its line and column.
#[test]
fn what_is_wrong_with_a_motion_in_one_is_told_at_its_place() {
    let text = |keys: &str| in_one(keys);
    for (keys, parts) in [
        ("formula = \"20*(1-cs(th))\"", &["unknown name `cs`", "did you mean `cos`", "cam.toml:4:18"][..]),
        ("formula = \"20*(1-cos(th)\"", &["character 4", "not closed", "cam.toml:4:15"]),
        ("formula = \"20*x\"", &["unknown name `x`", "the variable is `th`"]),
        ("formula = \"log(th)\"", &["th = 0.000000000 rad (0.000000 deg)", "the logarithm of 0 has no value"]),
        ("formula = \"1/(th-1)\"", &["th = 1.000000000 rad (57.295780 deg)", "a division by 0"]),
        ("formula = \"th\"", &["does not end where it begins", "over 360 deg the position grows by 6.283185e0 mm"]),
        ("formula = \"3+0*th\"", &["the position never changes"]),
        ("formula = \"1e9*sin(th)\"", &["the position reaches"]),
        ("formula = \"sin(th)\"\nfourier = { sin = [1] }", &["not by formula and fourier", "remove one of them"]),
        ("degree = 3\nformula = \"sin(th)\"", &["`degree` applies only to a motion given by points"]),
        (
            "degree = 4\npoints = [[\"0 deg\",\"0 mm\"],[\"9 deg\",\"1 mm\"],[\"20 deg\",\"2 mm\"]]",
            &["`degree` cannot be 4"],
        ),
        ("points = [[\"0 deg\",\"0 mm\"],[\"90 deg\",\"1 mm\"]]", &["needs at least 3 points, not 2"]),
        ("points = [[\"0 deg\",\"0 mm\"],[\"90 deg\",\"1 deg\"],[\"99 deg\",\"1 mm\"]]", &["point 2 is an angle"]),
        ("points = [[\"0 deg\",\"0 mm\"],[\"90 deg\",\"1\"]]", &["has no unit, in point 2"]),
        ("points = [[\"0 deg\",\"0 mm\"],[\"90 deg\"]]", &["point 2 has 1"]),
        (
            "points = [[\"0 deg\",\"0 mm\"],[\"90 deg\",\"1 mm\"],[\"90 deg\",\"2 mm\"]]",
            &["point 3 at 90.000000 deg does not come after"],
        ),
        (
            "points = [[\"0 deg\",\"0 mm\"],[\"90 deg\",\"1 mm\"],[\"360 deg\",\"0 mm\"]]",
            &["needs at least 3 points, not 2: point 3", "the spline closes by itself"],
        ),
        ("table = \"none.csv\"", &["cannot read `none.csv`", "cam.toml:4:"]),
        ("table = \".\"", &["it is a directory"]),
        ("table = \"back.csv\"", &["80 does not come after 90", "back.csv:4:1"]),
        ("table = \"open.csv\"", &["does not end where it begins", "open.csv:4:1"]),
        ("table = \"words.csv\"", &["a row of `words.csv` is not two numbers", "words.csv:3:1", "1 | "]),
        ("table = \"late.csv\"", &["185 deg of the turn are without rows", "late.csv:3:1"]),
    ] {
        let files = [
            ("back.csv", "deg,mm\n0,0\n90,4\n80,3\n"),
            ("open.csv", "0 0\n90 4\n180 3\n360 1\n"),
            ("words.csv", "deg,mm\n0,0\n1 | 2\n"),
            ("late.csv", "5,0\n90,4\n180,3\n"),
        ];
        let run = run_beside(&text(keys), &files, &[]);
        assert_eq!(run.code, 2, "{keys}: {}{}", run.out, run.err);
        for part in parts {
            assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
        }
    }
}

#[test]
fn what_is_wrong_with_a_segment_by_formula_table_or_spline_is_told() {
    for (keys, parts) in [
        ("law = \"formula\"", &["law = \"formula\" needs `formula`"][..]),
        ("law = \"formula\"\nformula = \"x^2+0.1\"", &["the formula gives 0.1 at x = 0 instead of 0"]),
        ("law = \"formula\"\nformula = \"sqrt(x)\"", &["x = 0.000000000", "no finite derivative up to the third"]),
        (
            "law = \"formula\"\nformula = \"x\"\nvelocity = \"1 mm/deg\"",
            &["determines velocity and acceleration itself"],
        ),
        ("law = \"table\"\ntable = \"law.csv\"", &["this row should be 1, 1", "law.csv:2:1"]),
        ("law = \"spline\"", &["law = \"spline\" needs `points`"]),
        (
            "law = \"spline\"\npoints = [[\"150 deg\", \"4 mm\"]]",
            &["point 1 at 150.000000 deg is not inside", "120.000000 deg"],
        ),
        ("law = \"polynomial\"\nvelocity = \"auto\"", &["two polynomials or splines, but cycloidal is neither"]),
        ("law = \"spline\"\npoints = [[\"50 deg\", \"4 mm\"]]\njerk = \"1 mm/rad3\"", &["remove `jerk`"]),
    ] {
        let text = in_one(&format!(
            "[[motion.segment]]\n{keys}\nover = \"120 deg\"\nto = \"20 mm\"\n[[motion.segment]]\nto = \"0 mm\""
        ));
        let run = run_beside(&text, &[("law.csv", "0,0\n1,2\n")], &[]);
        assert_eq!(run.code, 2, "{keys}: {}{}", run.out, run.err);
        for part in parts {
            assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
        }
        assert!(run.err.contains("cam.toml:") || run.err.contains("law.csv:"), "{}", run.err);
    }
}

/// The data of a table, not its name or its remarks, are an input.
#[test]
fn the_hash_knows_the_rows_of_a_table() {
    let hash = |name: &str, rows: &str| {
        let text = in_one(&format!("table = \"{name}\""));
        report(&run_beside(&text, &[(name, rows)], &["--dry-run", "--json"]))["inputs"]["hash"].clone()
    };
    let known = hash("a.csv", "0,0\n90,9\n200,3\n");
    assert_eq!(known, hash("b.csv", "# measured\n0;0.0\n90;9e0\n200;3\n"));
    assert_ne!(known, hash("a.csv", "0,0\n90,9.001\n200,3\n"));
}

/// 2000 rows are a spline in no time.
#[test]
fn a_long_table_is_read_at_once() {
    let rows: Vec<String> = (0..2000)
        .map(|i| f64::from(i) * 0.18)
        .map(|angle| format!("{angle},{:.9}", 10.0 - 10.0 * angle.to_radians().cos()))
        .collect();
    let rows = rows.join("\n");
    let begun = std::time::Instant::now();
    let made = run_beside(&in_one("table = \"lift.csv\""), &[("lift.csv", &rows)], &["--dry-run"]);
    assert_eq!(made.code, 0, "{}{}", made.out, made.err);
    assert!(begun.elapsed().as_secs() < 60, "{:?}", begun.elapsed());
}

/// The cam of an elastic load: told with the load, and refused where the load would need an impact.
#[test]
fn a_polydyne_cam_needs_a_smooth_motion() {
    let polydyne = "polydyne = { natural_frequency = \"40 Hz\", damping = 0.05 }";
    let made = told(&in_one(&format!("rpm = 240\nformula = \"10*(1-cos(th))\"\n{polydyne}")));
    // y = s + 2ζq s' + q² s'', q = 0.1.
    let size = 10.0 * (0.99_f64.powi(2) + 0.01_f64.powi(2)).sqrt();
    assert!((number(&made["motion"]["segments"][0]["peaks"]["velocity"]) - size).abs() < 1e-9, "{}", made["motion"]);
    for (keys, part) in [
        (format!("formula = \"10*(1-cos(th))\"\n{polydyne}"), "made for one speed"),
        (
            format!(
                "rpm = 240\n{polydyne}\n[[motion.segment]]\nover = \"90 deg\"\nto = \"9 mm\"\n[[motion.segment]]\nto = \"0 mm\""
            ),
            "the jerk of the load jumps",
        ),
    ] {
        let run = make(&in_one(&keys), &[]);
        assert_eq!(run.code, 2, "{}{}", run.out, run.err);
        assert!(run.err.contains(part) && run.err.contains("cam.toml:"), "{}", run.err);
    }
}

/// A rise by an optimum: the report names it, and its peak is the known one; without vibration at a ratio nothing is left there.
#[test]
fn an_optimum_is_told_with_what_it_makes_least() {
    let of = |keys: &str| {
        let optimum = format!("law = \"polynomial\"\n{keys}");
        told(&in_one(&format!(
            "[[motion.segment]]\n{optimum}\nover = \"120 deg\"\nto = \"20 mm\"\n[[motion.segment]]\nto = \"0 mm\""
        )))
    };
    let report = of("degree = 9\nminimise = \"peak-acceleration\"");
    let rise = &report["motion"]["segments"][0];
    let known = 4.657_472_844_813_795 * 20.0 / (120.0_f64.to_radians() * 120.0_f64.to_radians());
    assert!((number(&rise["peaks"]["acceleration"]) - known).abs() < 1e-12, "{rise}");
    assert_eq!((&rise["law"], &rise["minimise"]), (&Value::from("polynomial"), &Value::from("peak-acceleration")));
    assert_eq!((number(&rise["degree"]), &rise["ratio"]), (9.0, &Value::Null));
    assert_eq!(report["motion"]["segments"][1]["degree"], Value::Null);
    let calm = of("degree = 11\nminimise = \"residual\"\nratio = 2.5\nrobust = true");
    let rise = &calm["motion"]["segments"][0];
    assert_eq!((&rise["minimise"], number(&rise["ratio"])), (&Value::from("residual"), 2.5));
    assert_eq!(rise["robust"], Value::from(true));
}

#[test]
fn what_is_wrong_with_an_optimum_is_told() {
    let least = "minimise = \"peak-jerk\"";
    for (keys, parts) in [
        ("law = \"3-4-5\"\ndegree = 9\nminimise = \"peak-jerk\"".to_owned(), &["not to 3-4-5", "give law"][..]),
        (format!("law = \"polynomial\"\n{least}"), &["`minimise` needs `degree`", "e.g. degree = 9"]),
        (format!("law = \"polynomial\"\ndegree = 6\n{least}"), &["degree", "at least 7"]),
        (format!("law = \"polynomial\"\ndegree = 8.5\n{least}"), &["`degree` cannot be 8.5"]),
        (
            "law = \"polynomial\"\ndegree = 9".into(),
            &["`degree` applies only to a polynomial with `minimise`", "add `minimise`"],
        ),
        (
            format!("law = \"polynomial\"\ndegree = 9\nvelocity = \"1 mm/deg\"\n{least}"),
            &["a polynomial with `minimise` runs from rest to rest", "remove the states"],
        ),
        (
            format!("law = \"polynomial\"\ndegree = 9\nvelocity = \"auto\"\n{least}"),
            &["a polynomial with `minimise` runs from rest to rest"],
        ),
        (
            format!("law = \"polynomial\"\ndegree = 9\nend = \"turn\"\n{least}"),
            &["a polynomial with `minimise` runs from rest to rest"],
        ),
        (
            format!("law = \"polynomial\"\ndegree = 9\nratio = 2\n{least}"),
            &["`ratio` applies only to minimise = \"residual\""],
        ),
        (
            "law = \"polynomial\"\ndegree = 9\nminimise = \"residual\"".into(),
            &["minimise = \"residual\" needs `ratio`", "e.g. ratio = 2.5"],
        ),
        (
            "law = \"polynomial\"\ndegree = 8\nminimise = \"residual\"\nratio = 2\nrobust = true".into(),
            &["degree 8 has too few coefficients for `robust`", "raise `degree`"],
        ),
        (
            "law = \"polynomial\"\ndegree = 7\nminimise = \"residual\"\nratio = 0.1".into(),
            &["free of vibration at the ratio 0.1", "raise `degree`"],
        ),
    ] {
        let text = in_one(&format!(
            "[[motion.segment]]\n{keys}\nover = \"120 deg\"\nto = \"20 mm\"\n[[motion.segment]]\nto = \"0 mm\""
        ));
        let run = make(&text, &[]);
        assert_eq!(run.code, 2, "{keys}: {}{}", run.out, run.err);
        for part in parts {
            assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
        }
        assert!(run.err.contains("cam.toml:"), "{}", run.err);
    }
}

/// The roller was taken not to touch wherever the outline lies farther from the exact one than its radius.
#[test]
fn a_roller_smaller_than_the_tolerance_is_felt_all_round() {
    let text = TURN.replace("radius = \"10 mm\"", "radius = \"0.002 mm\"");
    let made = make(&text, &["--tolerance", "50um", "--format", "csv"]);
    assert_eq!(made.code, 0, "{}", made.err);
    let csv = fs::read_to_string(made.directory.path().join("output/cam-make.csv")).expect("a table");
    let none: Vec<&str> = csv.lines().filter(|line| line.contains("NaN")).collect();
    assert!(csv.starts_with("cam_deg,") && none.is_empty(), "{none:?}");
}
