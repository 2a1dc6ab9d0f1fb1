//! Motions through rows as people have them: gaps, dwells, units, rounding, and what is wrong with a table.

use crate::common::program::{Run, camgen_in, finding, number, report};
use serde_json::Value;
use std::fs;

const DWELL: &str = include_str!("common/rows/dwell.csv");
const INCH: &str = include_str!("common/rows/inch.csv");
const RADIANS: &str = include_str!("common/rows/radians.csv");
const ROUNDED: &str = include_str!("common/rows/rounded.csv");
const LIST: &str = include_str!("common/rows/lobe.s96");
const SEVEN: &str = include_str!("common/rows/seven.csv");
const SHARES: &str = include_str!("common/rows/shares.csv");

/// A cam of a motion with these keys.
fn design(keys: &str) -> String {
    format!(
        "name = \"rows\"\n[motion]\nrpm = 500\nstart = \"0 mm\"\n{keys}\n[follower.roller]\nradius = \"8 mm\"\n[cam]\nbase_radius = \"auto\"\n"
    )
}

/// A run of `make cam.toml` beside the table it names.
fn run(design: &str, (name, rows): (&str, &str)) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join(name), rows).expect("written");
    fs::write(directory.path().join("cam.toml"), design).expect("written");
    camgen_in(directory, &["make", "cam.toml", "--json", "--dry-run"])
}

fn of_table(keys: &str, rows: &str) -> Run {
    run(&design(&format!("table = \"lift.csv\"\n{keys}")), ("lift.csv", rows))
}

#[track_caller]
fn made(run: &Run) -> Value {
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    report(run)
}

#[track_caller]
fn refused(run: &Run, parts: &[&str]) {
    assert_eq!(run.code, 2, "{}{}", run.out, run.err);
    for part in parts {
        assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
    }
}

/// Lowest and highest position, mm.
fn range(report: &Value) -> (f64, f64) {
    let segments = report["motion"]["segments"].as_array().expect("segments");
    let all = |key: &str| segments.iter().map(|segment| number(&segment[key])).collect::<Vec<f64>>();
    (
        all("lowest").into_iter().fold(f64::INFINITY, f64::min),
        all("highest").into_iter().fold(f64::NEG_INFINITY, f64::max),
    )
}

fn peak(report: &Value) -> f64 {
    let segments = report["motion"]["segments"].as_array().expect("segments");
    segments.iter().map(|segment| number(&segment["peaks"]["acceleration"])).fold(0.0, f64::max)
}

/// Two equal rows far apart are a dwell, and the curve stays at them.
#[test]
fn equal_neighbours_are_a_dwell() {
    let report = made(&of_table("", DWELL));
    let (low, high) = range(&report);
    assert!(low > -0.08 && high < 8.08, "{low} {high}");
    assert_eq!(report["motion"]["rows"]["dwells_deg"], serde_json::json!([[130.0, 360.0]]), "{}", report["motion"]);
    assert_eq!(finding(&report, "overshoot")["verdict"], "pass");
    // Without the second end of the dwell most of the turn is without rows.
    let open = DWELL.replace("360,0.000\n", "");
    refused(&of_table("", &open), &["230 deg of the turn are without rows", "rest = \"dwell\""]);
    let rested = made(&of_table("rest = \"dwell\"", &open));
    assert_eq!(range(&rested), range(&report));
}

/// A gap in which the spline swings is told with its place, and the remedy that is told keeps the limit.
#[test]
fn a_curve_that_leaves_its_rows_fails() {
    let rows = "0,0\n10,2\n20,4\n30,6\n200,6.5\n220,5\n240,4\n260,3\n280,2\n300,1\n320,0\n340,0\n";
    let run = of_table("", rows);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    let told = report(&run);
    let found = finding(&told, "overshoot");
    assert_eq!(found["verdict"], "fail");
    let note = found["note"].as_str().expect("a note");
    assert!(note.contains("the widest gap is from 30 to 200 deg") && note.contains("shape = \"monotonic\""), "{note}");
    let monotonic = report(&of_table("shape = \"monotonic\"", rows));
    let kept = finding(&monotonic, "overshoot");
    assert!(kept["verdict"] == "pass" && number(&kept["value"]) < 1e-9, "{kept}");
    let allowed =
        format!("{}[limits]\novershoot = \"{} mm\"\n", design("table = \"lift.csv\""), 1.01 * number(&found["value"]));
    let allowed = report(&run_of(&allowed, rows));
    assert_eq!(finding(&allowed, "overshoot")["verdict"], "pass");
}

fn run_of(design: &str, rows: &str) -> Run {
    run(design, ("lift.csv", rows))
}

/// A cubic spline rests too, and what leaves its rows is seen.
#[test]
fn a_cubic_spline_rests_where_its_points_do() {
    let points = "points = [[\"0 deg\",\"0 mm\"],[\"20 deg\",\"1 mm\"],[\"40 deg\",\"4 mm\"],[\"60 deg\",\"7 mm\"],[\"80 deg\",\"8 mm\"],[\"100 deg\",\"7 mm\"],\
                  [\"120 deg\",\"4 mm\"],[\"140 deg\",\"1 mm\"],[\"160 deg\",\"0 mm\"]]\nrest = \"dwell\"";
    let rows = ("lift.csv", "0,0\n");
    let cubic = report(&run(&design(&format!("degree = 3\n{points}")), rows));
    assert_eq!(cubic["motion"]["rows"]["dwells_deg"], serde_json::json!([[160.0, 360.0]]), "{}", cubic["motion"]);
    let quintic = report(&run(&design(points), rows));
    for made in [&cubic, &quintic] {
        let (low, high) = range(made);
        let beyond = number(&finding(made, "overshoot")["value"]);
        assert!(low > -0.1 && high < 8.1 && beyond >= (high - 8.0).max(-low) - 1e-9, "{low} {high} {beyond}");
    }
    refused(
        &run(&design(&format!("degree = 3\nshape = \"monotonic\"\n{points}")), rows),
        &["degree = 3", "remove `degree`"],
    );
}

/// Units of headings count, and contradict no key.
#[test]
fn headings_name_units() {
    let (low, high) = range(&made(&of_table("", INCH)));
    assert!(low.abs() < 0.1 && (high - 8.0).abs() < 0.1, "{low} {high}");
    let radians = made(&of_table("", RADIANS));
    let (low, high) = range(&radians);
    assert!(low.abs() < 0.1 && high < 20.0, "{low} {high}");
    let bare = RADIANS.split_once('\n').expect("a heading").1;
    refused(&of_table("", bare), &["deg of the turn are without rows: are these radians?", "unit = \"rad\""]);
    assert_eq!(range(&made(&of_table("unit = \"rad\"", bare))), (low, high));
    refused(&of_table("unit = \"mm\"", INCH), &["`unit` says mm for the positions", "\"lift (in)\"", "says in"]);
    refused(&of_table("unit = \"deg\"", RADIANS), &["`unit` says deg for the angles", "says rad"]);
    let cam = "cam deg,mm\n0,0\n90,5\n180,8\n270,5\n";
    refused(&of_table("ratio = 2", cam), &["`ratio`", "those of the cam"]);
    let crank = "crank deg,mm\n0,0\n120,3\n240,6\n360,8\n480,6\n600,3\n720,0\n";
    let report = report(&of_table("", crank));
    assert!(report["motion"]["rows"]["read"].to_string().contains("ratio = 2"), "{}", report["motion"]);
    refused(&of_table("", &crank.replace("crank deg", "deg")), &["ratio = 2"]);
    refused(&of_table("", "time (s),mm\n0,0\n1,2\n2,1\n"), &["the angles are in s"]);
}

/// Rows that are told apart by what cannot be guessed are refused with the key that says it.
#[test]
fn refusals_name_the_row_and_the_key() {
    for (keys, rows, parts) in [
        ("", "0\n1\n2\n", &["row 1 is `0`", "step = \"1 deg\""][..]),
        ("", "0,1,2\n90,2,3\n180,3,4\n", &["row 1 has 3 cells", "columns = [1, 2]"]),
        ("", "deg,mm\n0,0\n90,x\n180,3\n", &["row 2 has `x` as position, in column 2", "lift.csv:3:1"]),
        ("columns = [\"angle\", \"lif\"]", "angle,lift 1,lift 2\n0,0,0\n90,1,1\n", &["no single column", "\"lift 1\""]),
        ("columns = [1, 5]", "0,0,0\n90,1,1\n", &["there is no column 5", "columns 1 to 3"]),
        ("", SEVEN, &["\"Lift %\"", "lift = \"8 mm\""]),
        ("lift = \"8 mm\"", "0,0\n90,5\n180,8\n270,5\n", &["row 2 has 5", "shares from 0 to 1"]),
        ("over = \"360 deg\"", "0,0\n90,5\n180,8\n270,5\n", &["row 2 has 90", "remove `over`"]),
        ("", "0,0\n0.2,1\n0.5,3\n0.8,1\n1,0\n", &["shares of the turn?", "over = \"360 deg\""]),
        ("mirror = true", "0,0\n90,5\n180,8\n270,5\n", &["half a lobe, at most 180 deg"]),
        ("", "0,8\n10,7\n20,5\n30,2\n40,0\n", &["320 deg of the turn are without rows", "mirror = true"]),
        ("rest = \"dwell\"", "0,0\n10,7\n20,5\n30,2\n", &["different positions", "330 deg cannot rest"]),
        ("smooth = \"3\"", "0,0\n90,5\n180,8\n270,5\n", &["`smooth`", "\"auto\""]),
        ("scale = 0", "0,0\n90,5\n180,8\n270,5\n", &["`scale` cannot be 0"]),
    ] {
        refused(&of_table(keys, rows), parts);
    }
    let run = run(&design("formula = \"5-5*cos(th)\"\nsmooth = \"auto\""), ("lift.csv", "0,0\n"));
    refused(&run, &["`smooth` applies only to a motion given by a table or points"]);
}

/// One motion in every form in which it may be written.
#[test]
fn forms_of_one_table_are_one_motion() {
    let rows: Vec<(f64, f64)> =
        (0..36).map(f64::from).map(|i| (10.0 * i, 4.0 - 4.0 * (10.0 * i).to_radians().cos())).collect();
    let write = |row: &dyn Fn(f64, f64) -> String| rows.iter().map(|(x, y)| row(*x, *y)).collect::<Vec<_>>().join("\n");
    let known = made(&of_table("", &write(&|x, y| format!("{x},{y}"))));
    let comma = |value: f64| format!("{value:.9}").replace('.', ",");
    for (keys, text) in [
        ("", write(&|x, y| format!("{};{}", comma(x), comma(y)))),
        ("", write(&|x, y| format!("{}\t{}", comma(x), comma(y)))),
        ("", write(&|x, y| format!("{}  {}", comma(x), comma(y)))),
        ("columns = [\"lift\", \"pos\"]", format!("no,lift,pos\n{}", write(&|x, y| format!("7,{x},{y}")))),
        ("", format!("lift (mm),angle (deg)\n{}", write(&|x, y| format!("{y},{x}")))),
        ("unit = \"in\"", write(&|x, y| format!("{x},{}", y / 25.4))),
        ("scale = 2", write(&|x, y| format!("{x},{}", y / 2.0))),
        ("ratio = 2", write(&|x, y| format!("{},{y}", 2.0 * x))),
        ("lift = \"8 mm\"", write(&|x, y| format!("{x},{}", y / 8.0))),
        ("lift = \"8 mm\"", format!("deg,Lift %\n{}", write(&|x, y| format!("{x},{}", y / 0.08)))),
        ("lift = \"8 mm\"\nover = \"360 deg\"", write(&|x, y| format!("{},{}", x / 360.0, y / 8.0))),
        ("step = \"10 deg\"", write(&|_, y| format!("{y:.9}"))),
        ("step = \"10 deg\"", write(&|_, y| comma(y))),
        ("", write(&|x, y| format!("{},{y}", if x >= 180.0 { x - 360.0 } else { x }))),
        ("", rows.iter().rev().map(|(x, y)| format!("{x},{y}")).collect::<Vec<_>>().join("\n")),
    ] {
        let found = made(&of_table(keys, &text));
        assert!((peak(&found) / peak(&known) - 1.0).abs() < 1e-5, "{keys}: {} {}", peak(&found), peak(&known));
        let ((a, b), (c, d)) = (range(&found), range(&known));
        assert!((a - c).abs() < 1e-6 && (b - d).abs() < 1e-6, "{keys}: {a} {b}, {c} {d}");
    }
}

/// A list of a cam grinder, with rows beyond the turn that repeat the first.
#[test]
fn a_list_with_a_step_is_a_table() {
    let text = design("table = \"lobe.s96\"").replace("\"0 mm\"", "\"0 in\"");
    let (low, high) = range(&made(&run(&text, ("lobe.s96", LIST))));
    assert!(low.abs() < 0.1 && high > 1.0 && high < 20.0, "{low} {high}");
    let named = text.replace("lobe.s96", "lobe.txt");
    refused(&run(&named, ("lobe.txt", LIST)), &["step = \"1 deg\""]);
    let stepped = named.replace("lobe.txt\"", "lobe.txt\"\nstep = \"1 deg\"");
    assert_eq!(range(&made(&run(&stepped, ("lobe.txt", LIST)))), (low, high));
}

/// More columns than two: the first two by their headings, shares of a lift.
#[test]
fn columns_are_chosen_by_their_headings() {
    let known = range(&made(&of_table("scale = 8", SEVEN)));
    assert!(known.0.abs() < 0.1 && (known.1 - 8.0).abs() < 0.1, "{known:?}");
    assert_eq!(range(&made(&of_table("scale = 8\ncolumns = [\"Crank Angle\", \"Lift %\"]", SEVEN))), known);
    assert_eq!(range(&made(&of_table("lift = \"8 mm\"\ncolumns = [1, 2]", SEVEN))), known);
}

/// Half a lobe, mirrored.
#[test]
fn half_a_lobe_is_mirrored() {
    let half = "0,8\n10,7.8\n20,7.2\n30,6.2\n40,4.9\n50,3.3\n60,1.6\n70,0.4\n80,0\n";
    let report = report(&of_table("mirror = true", half));
    assert!(report["motion"]["rows"]["read"].to_string().contains("mirrored at 0 deg"), "{}", report["motion"]);
    assert_eq!(report["motion"]["rows"]["dwells_deg"], serde_json::json!([[80.0, 280.0]]), "{}", report["motion"]);
}

/// Rows rounded to a thousandth of an inch: warned of, and smoothed to the acceleration of the law they were taken from.
#[test]
fn rounded_rows_are_told_and_smoothed() {
    let flat = |keys: &str| {
        design(&format!("table = \"lift.csv\"\n{keys}"))
            .replace("[follower.roller]\nradius = \"8 mm\"", "[follower.flat]")
    };
    let rough = report(&run_of(&flat(""), ROUNDED));
    let noise = finding(&rough, "noise");
    assert_eq!(noise["verdict"], "warn", "{noise}");
    assert!(number(&noise["value"]) > 4.0 && noise["note"].to_string().contains("smooth = \\\"auto\\\""), "{noise}");
    // 3-4-5, 9 mm in 65 deg.
    let known = 9.0 * 10.0 / 3.0_f64.sqrt() / 65.0_f64.to_radians().powi(2);
    let smooth = made(&run_of(&flat("smooth = \"auto\""), ROUNDED));
    assert!((peak(&smooth) / known - 1.0).abs() < 0.05, "{} {known}", peak(&smooth));
    let told = &smooth["motion"]["rows"]["smoothing"];
    assert!(
        (number(&told["bound"]) - 0.0127).abs() < 1e-6 && number(&told["largest"]) <= number(&told["bound"]),
        "{told}"
    );
    assert!(smooth["checks"].as_array().expect("checks").iter().all(|check| check["check"] != "noise"));
    let other = made(&run_of(&flat("smooth = \"20 um\""), ROUNDED));
    assert!((number(&other["motion"]["rows"]["smoothing"]["bound"]) - 0.02).abs() < 1e-9);
}

/// Normally distributed numbers by twelve even ones each, of Lehmer's generator.
fn normal() -> impl FnMut() -> f64 {
    let mut state = 20_261_128_u64;
    move || {
        let mut draw = || {
            state = state * 48_271 % 2_147_483_647;
            f64::from(u32::try_from(state).expect("31 bits")) / 2_147_483_647.0
        };
        (0..12).map(|_| draw()).sum::<f64>() - 6.0
    }
}

/// Rows of each degree, as a measuring machine gives them: 3-4-5 up 10 mm in 120 degrees, a dwell of 60, back in 120, a dwell; with a scatter in
/// mm, rounded to a thousandth.
fn measured_rows(scatter: f64) -> String {
    let law = |angle: i32| match angle {
        0..120 => of_345(f64::from(angle) / 120.0),
        120..180 => 1.0,
        180..300 => 1.0 - of_345(f64::from(angle - 180) / 120.0),
        _ => 0.0,
    };
    let mut noise = normal();
    let rows: Vec<String> =
        (0..360).map(|angle| format!("{angle},{:.3}", 10.0 * law(angle) + scatter * noise())).collect();
    rows.join("\n")
}

/// Measured rows: the report gives their scatter and the `smooth` that removes it; two rows that are equal by chance are not a dwell.
#[test]
fn measured_rows_are_told_and_smoothed() {
    let design = |keys: &str| design(&format!("table = \"lift.csv\"\n{keys}\n[limits]\nlift_error = \"1 mm\""));
    let known = 10.0 * 10.0 / 3.0_f64.sqrt() / 120.0_f64.to_radians().powi(2);
    for (scatter, within) in [(0.003, 0.1), (0.01, 0.15)] {
        let rows = measured_rows(scatter);
        let noise_of = |keys: &str| finding(&report_of(&design(keys), &rows), "noise").clone();
        let rough = noise_of("");
        assert_eq!(rough["verdict"], "warn", "{rough}");
        let note = rough["note"].as_str().expect("a note");
        let number_behind = |words: &str| {
            let (_, rest) = note.split_once(words).unwrap_or_else(|| panic!("{note}"));
            rest.split_whitespace().next().expect("a number").parse::<f64>().expect("a number")
        };
        let told = number_behind("a standard deviation of ");
        assert!((told / scatter - 1.0).abs() < 0.25, "{note}");
        let smooth = number_behind("smooth = \"");
        assert!((3.4..4.0).contains(&(smooth / told)), "{note}");
        let with = format!("smooth = \"{smooth} mm\"");
        let smoothed = report_of(&design(&with), &rows);
        assert!((peak(&smoothed) / known - 1.0).abs() < within, "{} {known}", peak(&smoothed));
        assert!((number_behind("to ") / peak(&smoothed) - 1.0).abs() < 0.05, "{note} {}", peak(&smoothed));
        assert!(smoothed["checks"].as_array().expect("checks").iter().all(|check| check["check"] != "noise"));
        assert_eq!(smoothed["motion"]["rows"]["dwells_deg"], serde_json::json!([]), "{}", smoothed["motion"]);
        // Half the rounding is too little.
        assert_eq!(noise_of("smooth = \"auto\"")["verdict"], "warn");
    }
    // Rows that are only rounded are those of before.
    let rounded = report_of(&design(""), &measured_rows(0.0));
    assert!(finding(&rounded, "noise")["note"].to_string().contains("look rounded to 0.001 mm"), "{rounded}");
}

/// Rounding of shares is no impact: the ends of a table of 3-4-5 rest.
#[test]
fn rounded_shares_are_no_impact() {
    let segments = "[[motion.segment]]\nlaw = \"table\"\ntable = \"lift.csv\"\nover = \"100 deg\"\nto = \"10 mm\"\n[[motion.segment]]\nlaw = \"dwell\"\nover = \"80 deg\"\n[[motion.segment]]\nlaw = \"table\"\ntable = \"lift.csv\"\nover = \"100 deg\"\nto = \"0 mm\"\n[[motion.segment]]\nlaw = \"dwell\"";
    let report = made(&run_of(&design(segments), SHARES));
    assert!(number(&finding(&report, "continuity")["value"]) >= 1.0);
    // A table that really begins with a velocity jumps, and is told what lets it rest.
    let line: Vec<String> = (0..=20).map(|i| format!("{0:.3},{0:.3}", f64::from(i) / 20.0)).collect();
    let line = line.join("\n");
    let run = run_of(&design(segments), &line);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    let told = crate::common::program::report(&run);
    let note = finding(&told, "continuity")["note"].to_string();
    assert!(note.contains("ends = \\\"rest\\\""), "{note}");
    let rested = report_of(&design(&segments.replace("\"lift.csv\"", "\"lift.csv\"\nends = \"rest\"")), &line);
    assert!(number(&finding(&rested, "continuity")["value"]) >= 1.0);
}

fn report_of(design: &str, rows: &str) -> Value {
    report(&run_of(design, rows))
}

fn of_345(x: f64) -> f64 {
    x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)
}

/// A rise of 10 mm in 120 degrees by a law of rows, then a dwell and 3-4-5 down.
fn rise_of_rows(keys: &str) -> String {
    let back =
        "[[motion.segment]]\nlaw = \"dwell\"\nover = \"60 deg\"\n[[motion.segment]]\nlaw = \"3-4-5\"\nto = \"0 mm\"";
    design(&format!("[[motion.segment]]\nover = \"120 deg\"\nto = \"10 mm\"\n{keys}\n{back}"))
}

/// 3-4-5 at each degree, rounded to 0.01 mm.
fn rounded_spline(keys: &str) -> String {
    let points: Vec<String> =
        (1..120).map(|i| format!("[\"{i} deg\", \"{:.2} mm\"]", 10.0 * of_345(f64::from(i) / 120.0))).collect();
    rise_of_rows(&format!("law = \"spline\"\npoints = [{}]\n{keys}", points.join(", ")))
}

/// Rows of segments are smoothed, warned of and kept monotonic as those of a whole turn.
#[test]
fn rounded_rows_of_a_segment_are_told_and_smoothed() {
    let share = |i: i32| format!("{:.9},{:.3}", f64::from(i) / 120.0, of_345(f64::from(i) / 120.0));
    let shares = (0..=120).map(share).collect::<Vec<_>>().join("\n");
    let table = |keys: &str| rise_of_rows(&format!("law = \"table\"\ntable = \"lift.csv\"\n{keys}"));
    let known = 10.0 * 10.0 / 3.0_f64.sqrt() / 120.0_f64.to_radians().powi(2);
    for law in [&rounded_spline as &dyn Fn(&str) -> String, &table] {
        let rough = report_of(&law(""), &shares);
        let noise = finding(&rough, "noise");
        assert_eq!(noise["verdict"], "warn", "{noise}");
        let note = noise["note"].as_str().expect("a note");
        assert!(
            number(&noise["value"]) > 4.0 && note.contains("the rows of segment 1 look rounded to 0.01 mm"),
            "{noise}"
        );
        for keys in ["smooth = \"auto\"", "smooth = \"auto\"\nshape = \"monotonic\"", "smooth = \"5 um\""] {
            let smooth = made(&run_of(&law(keys), &shares));
            let rise = &smooth["motion"]["segments"][0];
            let peak = number(&rise["peaks"]["acceleration"]);
            assert!((peak / known - 1.0).abs() < 0.05, "{keys}: {peak} {known}");
            let told = &rise["rows"]["smoothing"];
            assert!((number(&told["bound"]) - 0.005).abs() < 1e-6, "{told}");
            assert!(number(&told["largest"]) <= 0.005 && number(&told["rms"]) > 0.001, "{told}");
            assert_eq!((number(&rise["from"]), number(&rise["to"])), (0.0, 10.0), "the ends stay");
            assert!(smooth["checks"].as_array().expect("checks").iter().all(|check| check["check"] != "noise"));
            assert!(number(&finding(&smooth, "continuity")["value"]) >= 2.0, "{smooth}");
        }
    }
    refused(&run_of(&table("smooth = \"0.1 deg\""), &shares), &["`smooth`", "\"auto\""]);
}

/// A smoothed or monotonic spline begins with position, velocity and acceleration of the segment before it.
#[test]
fn a_segment_of_rows_begins_as_the_one_before_ends() {
    let before = "[[motion.segment]]\nlaw = \"polynomial\"\nover = \"60 deg\"\nto = \"2 mm\"\nvelocity = \"4 mm/rad\"\nacceleration = \"3 mm/rad2\"\n";
    let after = "[[motion.segment]]\nlaw = \"3-4-5\"\nto = \"0 mm\"";
    let spline = |keys: &str| {
        let points = "[[\"80 deg\", \"3.9 mm\"], [\"100 deg\", \"6.3 mm\"], [\"110 deg\", \"7.4 mm\"], [\"130 deg\", \"9.2 mm\"]]";
        design(&format!(
            "{before}[[motion.segment]]\nlaw = \"spline\"\nover = \"90 deg\"\nto = \"10 mm\"\npoints = {points}\n{keys}\n{after}"
        ))
    };
    for keys in ["", "smooth = \"200 um\"", "shape = \"monotonic\"", "smooth = \"200 um\"\nshape = \"monotonic\""] {
        let directory = tempfile::tempdir().expect("a directory");
        fs::write(directory.path().join("cam.toml"), spline(keys)).expect("written");
        let words =
            ["make", "cam.toml", "--samples", "72000", "--format", "csv", "--out", "out", "--name", "cam", "--force"];
        let run = camgen_in(directory, &words);
        assert!(run.code < 2, "{}{}", run.out, run.err);
        let text = fs::read_to_string(run.directory.path().join("out/cam.csv")).expect("a table");
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
        let at = |row: usize, name: &str| {
            let column = rows[0].iter().position(|heading| *heading == name).expect("a column");
            rows[row + 1][column].parse::<f64>().expect("a number")
        };
        // 60 degrees are row 12000.
        for (name, wanted, near) in
            [("position_mm", 2.0, 1e-9), ("velocity_mm_per_rad", 4.0, 1e-9), ("acceleration_mm_per_rad2", 3.0, 1e-6)]
        {
            assert!((at(12000, name) - wanted).abs() < near, "{keys} {name}: {}", at(12000, name));
            let step = (at(12001, name) - at(11999, name)).abs();
            assert!(step < 0.05, "{keys} {name} jumps by {step}");
        }
    }
}

/// A gap in which a spline swings fails like that of a table; the limit may be a share of the lift.
#[test]
fn a_spline_that_leaves_its_points_fails() {
    let points = "law = \"spline\"\npoints = [[\"10 deg\", \"1 mm\"], [\"20 deg\", \"4 mm\"], [\"30 deg\", \"8 mm\"], [\"110 deg\", \"9 mm\"]]\n";
    let rows = "0,0\n";
    let run = run_of(&rise_of_rows(points), rows);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    let swung = report(&run);
    let found = finding(&swung, "overshoot");
    let note = found["note"].as_str().expect("a note");
    assert!(note.contains("in segment 1 at ") && note.contains("the widest gap is from 30 to 110 deg"), "{note}");
    let kept = made(&run_of(&rise_of_rows(&format!("{points}shape = \"monotonic\"")), rows));
    assert!(number(&finding(&kept, "overshoot")["value"]) < 1e-9);
    let lift = number(&swung["cam"]["max_lift_mm"]);
    let limited = |limit: &str| run_of(&format!("{}[limits]\novershoot = {limit}\n", rise_of_rows(points)), rows);
    for (limit, share) in [("\"1 %\"", 0.01), ("\"90%\"", 0.9), ("\"0 %\"", 0.0)] {
        let told = report(&limited(limit));
        let found = finding(&told, "overshoot");
        assert!((number(&found["limit"]) / lift - share).abs() < 1e-9, "{found}");
        assert_eq!(found["verdict"] == "pass", number(&found["value"]) <= share * lift, "{found}");
    }
    refused(&limited("\"-1 %\""), &["`limits.overshoot` must be", "-1 %"]);
    refused(&limited("\"2000 %\""), &["`limits.overshoot` must be", "1000 %"]);
    refused(&limited("\"x %\""), &["`limits.overshoot`", "e.g."]);
    refused(&limited("0.01"), &["`limits.overshoot`", "such as \"1 %\""]);
    refused(&limited("\"1 deg\""), &["is an angle, but the follower moves by a length", "\"1 %\" of the lift"]);
}

/// A state at an end that a monotonic curve cannot have is refused: the neighbour keeps it. Smoothing never contradicts one.
#[test]
fn a_state_that_contradicts_monotonic_is_refused() {
    let spline = |velocity: &str, keys: &str| {
        design(&format!(
            "[[motion.segment]]\nlaw = \"polynomial\"\nover = \"60 deg\"\nto = \"2 mm\"\nvelocity = \"{velocity}\"\n[[motion.segment]]\nlaw = \"spline\"\n\
             over = \"90 deg\"\nto = \"10 mm\"\npoints = [[\"80 deg\", \"4 mm\"], [\"110 deg\", \"7 mm\"]]\n{keys}\n[[motion.segment]]\nlaw = \"3-4-5\"\nto = \"0 mm\""
        ))
    };
    let monotonic = "shape = \"monotonic\"";
    let rows = "0,0\n";
    let leads_out = ["`shape`", "contradicts the state at an end", "begins with a velocity that leads out"];
    refused(&run_of(&spline("-2 mm/rad", monotonic), rows), &leads_out[1..]);
    refused(
        &run_of(&spline("90 mm/rad", monotonic), rows),
        &["contradicts", "15.7080 times the mean velocity", "less than 2.5000"],
    );
    for (velocity, keys) in
        [("3 mm/rad", monotonic), ("-2 mm/rad", "smooth = \"50 um\""), ("90 mm/rad", "smooth = \"50 um\"")]
    {
        let run = run_of(&spline(velocity, keys), rows);
        assert!(run.code < 2, "{velocity} {keys}: {}{}", run.out, run.err);
        let told = report(&run);
        let largest = number(
            &told["motion"]["segments"][1]["rows"].get("smoothing").map_or(Value::from(0.0), |s| s["largest"].clone()),
        );
        assert!(largest <= 0.05, "{largest}");
    }
    let other = design(
        "[[motion.segment]]\nover = \"120 deg\"\nto = \"9 mm\"\nshape = \"monotonic\"\nsmooth = \"auto\"\n[[motion.segment]]\nto = \"0 mm\"",
    );
    let both = ["`shape` applies only to the laws \"spline\" and \"table\"", "`smooth` applies only to the laws"];
    refused(&run_of(&other, rows), &both);
}

/// Points of a lobe only, nothing from 70 to 290 degrees.
#[test]
fn points_of_a_lobe_only_are_refused_or_rest() {
    let points: Vec<String> =
        [0.0, 1.780, 3.471, 4.988, 6.255, 7.208, 7.799, 8.0, 7.799, 7.208, 6.255, 4.988, 3.471, 1.780, 0.0]
            .iter()
            .zip(-7..)
            .map(|(lift, at)| format!("[\"{} deg\",\"{lift:.3} mm\"]", 10 * at))
            .collect();
    let keys = format!("at = \"-70 deg\"\npoints = [{}]", points.join(", "));
    let rows = ("lift.csv", "0,0\n");
    refused(&run(&design(&keys), rows), &["220 deg of the turn are without rows", "rest = \"dwell\""]);
    let rested = report(&run(&design(&format!("{keys}\nrest = \"dwell\"")), rows));
    let (low, high) = range(&rested);
    assert!(low > -0.08 && high < 8.1, "{low} {high}");
}

/// `count` rows of a lobe by 3-4-5 with a dwell, in mm with four decimals; the row in `wrong` is off by its number.
fn lobe(count: u32, wrong: Option<(u32, f64)>) -> String {
    let row = |index: u32| {
        let degree = 360.0 * f64::from(index) / f64::from(count);
        let rise =
            if degree < 100.0 { of_345(degree / 100.0) } else { of_345(((260.0 - degree) / 100.0).clamp(0.0, 1.0)) };
        let off = wrong.filter(|(at, _)| *at == index).map_or(0.0, |(_, off)| off);
        format!("{degree},{:.4}\n", 8.0 * rise + off)
    };
    (0..count).map(row).collect()
}

/// A row off its neighbours fails with its number and line, however the rows are smoothed; correct rows pass.
#[test]
fn a_wrong_row_fails_with_its_number_and_line() {
    for (count, keys) in [(360, ""), (360, "smooth = \"auto\""), (180, ""), (120, ""), (90, "shape = \"monotonic\"")] {
        let correct = made(&of_table(keys, &lobe(count, None)));
        assert_eq!(finding(&correct, "outlier")["verdict"], "pass", "{count}");
        for (row, off) in [(count / 12, 0.05), (count / 3, -0.05), (count - 3, 0.05)] {
            let run = of_table(keys, &lobe(count, Some((row, off))));
            assert_eq!(run.code, 1, "{count} {row}: {}{}", run.out, run.err);
            let report = report(&run);
            let found = finding(&report, "outlier");
            assert_eq!(found["verdict"], "fail", "{count} {row}");
            let note = found["note"].as_str().expect("a note");
            assert!(note.contains(&format!("row {} (line {} of the file)", row + 1, row + 1)), "{count} {row}: {note}");
        }
    }
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("lift.csv"), lobe(360, Some((31, 0.1)))).expect("written");
    fs::write(directory.path().join("cam.toml"), design("table = \"lift.csv\"")).expect("written");
    let run = camgen_in(directory, &["size", "cam.toml", "--dry-run"]);
    assert!(run.code == 1 && run.out.contains("row 32"), "{}{}", run.out, run.err);
}

#[test]
fn at_moves_rows_and_points() {
    let position = |keys: &str, rows: &str| {
        // Four rows of an uneven motion overshoot, which fails another check.
        let report = report(&run(&design(keys), ("lift.csv", rows)));
        number(&report["motion"]["segments"][0]["from_deg"])
    };
    let rows = "30,0\n90,5\n180,8\n270,5\n";
    let points =
        "points = [[\"30 deg\", \"0 mm\"], [\"90 deg\", \"5 mm\"], [\"180 deg\", \"8 mm\"], [\"270 deg\", \"5 mm\"]]";
    for (keys, rows) in [("table = \"lift.csv\"", rows), (points, "")] {
        assert_eq!(position(keys, rows), 30.0);
        assert_eq!(position(&format!("{keys}\nat = \"50 deg\""), rows), 80.0);
        assert_eq!(position(&format!("{keys}\nat = \"-20 deg\""), rows), 10.0);
    }
}

#[test]
fn headings_with_factors_counts_or_radii_are_refused() {
    let rows = "0;0\n90;5\n180;8\n270;5\n";
    let with = |heading: &str| format!("deg;{heading}\n{rows}");
    for heading in
        ["lift .001in", "lift (0,01mm)", "lift 1/100mm", "lift 10µm", "lift x 0,01", "lift*1000", "lift e-3 in"]
    {
        refused(&of_table("", &with(heading)), &["has a factor", "scale"]);
        let scaled = made(&of_table("scale = 0.01\nunit = \"mm\"", &with(heading)));
        assert!((range(&scaled).1 - 0.08).abs() < 1e-9, "{heading}");
    }
    refused(&of_table("", &with("lift milli-inch")), &["has a factor", "milli"]);
    refused(&of_table("", &with("lift dmm")), &["\"dmm\", which is not a known unit", "unit = \"mm\""]);
    made(&of_table("unit = \"mm\"", &with("lift dmm")));
    refused(&of_table("", &with("lift yards")), &["the positions are in yd"]);
    for heading in ["counts", "pulses", "raw", "ADC", "lift cts", "Hub Inkr."] {
        refused(&of_table("", &with(heading)), &["whose size is unknown", "scale"]);
    }
    refused(&of_table("", &with("radius mm")), &["has radii", "--as pitch"]);
    // In a comma-separated file a decimal comma splits a heading.
    refused(&of_table("", "deg,lift 0,01mm\n0,0\n90,5\n180,8\n270,5\n"), &["has a factor"]);
}

#[test]
fn columns_that_are_not_read_are_named() {
    let report = made(&of_table("", "deg,opening mm,closing mm\n0,0,0\n90,5,4\n180,8,8\n270,5,4\n"));
    let read = report["motion"]["rows"]["read"].to_string();
    assert!(read.contains("column 3 (\\\"closing mm\\\")") && read.contains("not read"), "{read}");
}
