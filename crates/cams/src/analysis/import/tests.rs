use super::*;
use std::f64::consts::TAU;

/// Positions (m) at each degree.
fn rows(value: impl Fn(f64) -> f64) -> TableRows {
    let angles: Vec<f64> = (0..360).map(|degree| f64::from(degree).to_radians()).collect();
    let positions = angles.iter().map(|angle| value(*angle)).collect();
    TableRows {
        quantity: Quantity::Length,
        fill: TAU,
        angles,
        positions,
        rounding: 0.0,
        has_lifts: true,
        told: Vec::new(),
    }
}

fn imported(rows: TableRows) -> Analysis {
    let options = ImportOptions { name: "old".into(), spline: true, ..ImportOptions::default() };
    analysis(&ImportSource::Table(rows), &options).expect("a design")
}

fn laws_of(found: &Analysis) -> Vec<String> {
    let segments = found.sections[0].value["segments"].as_array().expect("segments");
    segments.iter().map(|segment| segment["law"].as_str().expect("a law").to_owned()).collect()
}

/// The motion of a design at each degree.
fn of_design(text: &str) -> TableRows {
    let machine = Machine::from_toml("test", text, &[]).expect("a design");
    let program = machine.program().expect("a motion").clone();
    rows(move |angle| spline::position(&program, angle))
}

#[test]
fn an_eccentric_is_two_harmonics() {
    let found = imported(rows(|angle| 0.010 - 0.010 * libm::cos(angle - 0.5)));
    assert_eq!(laws_of(&found), ["harmonic", "harmonic"], "{:?}", found.document);
}

/// A feed at constant velocity between two laws comes back with its velocity.
#[test]
fn a_straight_line_between_two_laws_is_found() {
    let design = |before: &str, after: &str| {
        format!(
            "name = \"feed\"\n[motion]\nstart = \"0 mm\"\n[[motion.segment]]\nlaw = \"{before}\"\nover = \"60 deg\"\nto = \"8 mm\"\n\
             velocity = \"0.3 mm/deg\"\n[[motion.segment]]\nlaw = \"line\"\nover = \"40 deg\"\nto = \"20 mm\"\n[[motion.segment]]\n\
             law = \"{after}\"\nover = \"50 deg\"\nto = \"27 mm\"\n[[motion.segment]]\nlaw = \"dwell\"\nover = \"30 deg\"\n[[motion.segment]]\n\
             law = \"3-4-5\"\nover = \"120 deg\"\nto = \"0 mm\"\n[[motion.segment]]\nlaw = \"dwell\"\n[follower.roller]\nradius = \"15 mm\"\n[cam]\n"
        )
    };
    for (before, after) in [("modified-sine", "modified-sine"), ("cycloidal", "3-4-5")] {
        let found = imported(of_design(&design(before, after)));
        assert_eq!(
            laws_of(&found),
            [before, "constant-velocity", after, "dwell", "3-4-5", "dwell"],
            "{:?}",
            found.document
        );
        assert!(found.document.as_ref().expect("a design").contains("velocity = \"0.3"), "{:?}", found.document);
    }
}

#[test]
fn noise_and_outliers_are_seen() {
    let noisy = |at: usize| if at.is_multiple_of(2) { 1e-6 } else { -1e-6 };
    let table = rows(|angle| 0.010 * libm::sin(angle));
    let mut positions = Positions {
        quantity: table.quantity,
        fill: table.fill,
        angles: table.angles,
        values: table.positions.iter().enumerate().map(|(at, value)| value + noisy(at * at / 3)).collect(),
        by_shift: Vec::new(),
        rows: (0..360).collect(),
    };
    let noise = positions.noise();
    assert!((0.5e-6..2.5e-6).contains(&noise), "{noise}");
    assert_eq!(positions.outlier(5e-6, (0.0, Sensitivity::Coarse)), None);
    positions.values[100] += 2e-4;
    assert_eq!(positions.outlier(5e-6, (0.0, Sensitivity::Coarse)).map(|(at, _)| at % 360), Some(100));
}

/// The centre of the dwells, whatever the rise between them.
#[test]
fn the_centre_of_measured_dwells_is_found() {
    let centre = Vector2::new(0.31, -0.12);
    let points: Vec<Vector2<f64>> = (0..720)
        .map(|i| {
            let angle = TAU * f64::from(i) / 720.0;
            let rise = 12.0 * (0.5 - 0.5 * libm::cos((3.0 * angle).clamp(0.0, TAU)));
            centre + Vector2::new(libm::cos(angle), libm::sin(angle)) * (40.0 + rise)
        })
        .collect();
    let found = super::centre::centre(&points).expect("a centre");
    assert!((found - centre).norm() < 1e-3, "{found}");
}
