//! The same refusal for a motion from a file and from code: the cases of `tests/cases/motions.json`, also read by the tests of the Python
//! package.

use crate::common::program::{Run, camgen_in, finding, report};
use camgen::motion::laws::law;
use camgen::motion::program::rows::RowShape;
use camgen::{Jet, Law, Motion, Piece, Program, Quantity, Refusal, SampleCurve, Smooth, Spec};
use serde_json::Value;
use std::f64::consts::TAU;
use std::fs;

const CASES: &str = include_str!("../cases/motions.json");

fn cases() -> Vec<Value> {
    serde_json::from_str(CASES).expect("cases")
}

/// Angles in degrees and positions in mm: given by a case, or a harmonic at each degree with a wrong row.
fn rows_of(case: &Value) -> Option<Vec<[f64; 2]>> {
    if let Some(wrong) = case["wrong"].as_array() {
        let (at, off) = (wrong[0].as_u64().expect("a row"), wrong[1].as_f64().expect("mm"));
        let row = |degree: u32| {
            let exact = 8.0 * (1.0 - f64::from(degree).to_radians().cos());
            [f64::from(degree), (1e4 * exact).round() / 1e4 + if u64::from(degree) == at { off } else { 0.0 }]
        };
        return Some((0..360).map(row).collect());
    }
    let pair = |row: &Value| [row[0].as_f64().expect("deg"), row[1].as_f64().expect("mm")];
    Some(case["rows"].as_array()?.iter().map(pair).collect())
}

/// The motion of a case as a file.
fn in_file(case: &Value) -> String {
    let mut text = String::from("name = \"case\"\n[motion]\nrpm = 100\nstart = \"0 mm\"\n");
    if let Some(rows) = rows_of(case) {
        let points: Vec<String> = rows.iter().map(|[at, s]| format!("[\"{at} deg\", \"{s} mm\"]")).collect();
        text.push_str(&format!("points = [{}]\n", points.join(", ")));
        for key in ["shape", "smooth", "degree"].into_iter().filter(|key| !case[*key].is_null()) {
            text.push_str(&format!("{key} = {}\n", case[key]));
        }
    }
    for segment in case["segments"].as_array().into_iter().flatten() {
        text.push_str(&format!(
            "[[motion.segment]]\nlaw = {}\nover = \"{} deg\"\nto = \"{} mm\"\n",
            segment[0], segment[1], segment[2]
        ));
    }
    text + "[follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"100 mm\"\n[limits]\nmin_convex_pitch_radius_over_roller = 0\n"
}

fn made(text: &str) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("cam.toml"), text).expect("written");
    camgen_in(directory, &["make", "cam.toml", "--json", "--dry-run"])
}

/// The motion of a case as code.
fn in_code(case: &Value) -> Result<Program, Refusal> {
    if let Some(rows) = rows_of(case) {
        let angles: Vec<f64> = rows.iter().map(|row| row[0].to_radians()).collect();
        let lifts: Vec<f64> = rows.iter().map(|row| 1e-3 * row[1]).collect();
        let um = |text: &str| text.trim_end_matches(" um").parse::<f64>().map(|um| 1e-6 * um).expect("um");
        let curve = SampleCurve {
            shape: if case["shape"] == "monotonic" { RowShape::Monotonic } else { RowShape::Natural },
            degree: u8::try_from(case["degree"].as_u64().unwrap_or(5)).expect("a degree"),
            smooth: case["smooth"].as_str().map(|by| Smooth::By(um(by))),
        };
        return Program::through(Quantity::Length, &angles, &lifts, curve);
    }
    let mut segments: Vec<(Option<&'static Law>, f64, f64)> = Vec::new();
    for segment in case["segments"].as_array().expect("segments") {
        let name = segment[0].as_str().expect("a law");
        let law = if name == "dwell" { None } else { Some(law(name)?) };
        let (over, to) = (segment[1].as_f64().expect("deg"), segment[2].as_f64().expect("mm"));
        segments.push((law, over.to_radians(), 1e-3 * to));
    }
    Program::new(Quantity::Length, 0.0, &segments)
}

/// The failed checks of a cam with a motion from code.
fn failed(motion: Program) -> Vec<String> {
    let spec = Spec::builder("case").roller(0.010).base_radius(0.100).rpm(100.0).motion(motion).expect("a motion");
    let proven = spec.solve().expect("a cam").draw(5e-6).expect("drawn").prove().expect("proved");
    let findings = proven.findings().iter();
    findings
        .filter(|finding| finding.verdict == camgen::Verdict::Fail)
        .map(|finding| finding.check.to_string())
        .collect()
}

#[test]
fn a_motion_from_code_is_refused_as_that_of_a_file() {
    for case in cases() {
        let name = case["name"].as_str().expect("a name");
        let run = made(&in_file(&case));
        if let Some(check) = case["check"].as_str() {
            assert_eq!(run.code, 1, "{name}: {}{}", run.out, run.err);
            assert_eq!(finding(&report(&run), check)["verdict"], "fail", "{name}");
            let failed = failed(in_code(&case).expect(name));
            assert!(failed.iter().any(|failed| failed == check), "{name}: {failed:?}");
            continue;
        }
        assert_eq!(run.code, 2, "{name}: {}{}", run.out, run.err);
        let part = case["part"].as_str().expect("a part");
        let why = in_code(&case).expect_err(name).to_string();
        let rows = |text: &str| text.replace("samples", "rows").replace("sample", "row").replace("points", "rows");
        assert!(rows(&run.err).contains(part) && rows(&why).contains(part), "{name}: {why}\n{}", run.err);
    }
}

/// A user's own motion with a shifted lift or a changed derivative.
#[derive(Debug)]
struct Own(fn(Jet) -> Jet);

impl Motion for Own {
    fn pieces(&self) -> &[Piece] {
        &[Piece { start: 0.0, end: TAU, dwell: false }]
    }

    fn jet(&self, _piece: usize, angle: f64) -> Jet {
        let (sin, cos) = angle.sin_cos();
        (self.0)(Jet { s: 1.0 - cos, ds: sin, dds: cos, ddds: -sin }.scaled(0.010))
    }
}

#[test]
fn a_motion_of_ones_own_that_contradicts_itself_is_refused() {
    let solved =
        |change: fn(Jet) -> Jet| Spec::builder("own").roller(0.01).motion(Own(change)).expect("a machine").solve();
    assert!(solved(|jet| jet).is_ok());
    for (change, part) in [
        ((|jet| Jet { s: jet.s + 0.005, ..jet }) as fn(Jet) -> Jet, "lowest point"),
        (|jet| Jet { ds: -jet.ds, ..jet }, "velocity"),
        (|jet| Jet { dds: 1.05 * jet.dds, ..jet }, "acceleration"),
    ] {
        let why = solved(change).expect_err(part).to_string();
        assert!(why.contains(part), "{part}: {why}");
    }
}
