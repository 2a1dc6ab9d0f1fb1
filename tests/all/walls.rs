//! Programs near the walls of what can be cut: jumps that are nearly none, spikes, edges, extremes that hide beside each other.

use crate::common::program::{Run, camgen, files, finding, make, number, report};
use std::fs;

/// A run of `make cam.toml`.
fn run(text: &str, args: &[&str]) -> Run {
    make(text, &[&["--json"], args].concat())
}

/// Under a flat face whose velocity grows at once the contact moves on along the face, Δs' at one cam angle, and the profile is straight
/// between both places. Where the velocity does not drop again nothing is lost.
#[test]
fn a_face_whose_velocity_grows_leaves_a_straight_edge() {
    let text = r#"name = "straight"
[motion]
start = "0 mm"
[[motion.segment]]
law = "dwell"
over = "90 deg"
[[motion.segment]]
law = "line"
over = "120 deg"
to = "10 mm"
[[motion.segment]]
law = "polynomial"
over = "60 deg"
to = "12 mm"
[[motion.segment]]
to = "0 mm"
[follower.flat]
[cam]
base_radius = "40 mm"
[limits]
continuity = 0
"#;
    let swinging = text
        .replace("start = \"0 mm\"", "start = \"0 deg\"")
        .replace("\"10 mm\"", "\"4 deg\"")
        .replace("\"12 mm\"", "\"4.8 deg\"")
        .replace("to = \"0 mm\"", "to = \"0 deg\"")
        .replace("[follower.flat]", "[follower.swinging-flat]\npivot_distance = \"150 mm\"\nside = \"leading\"");
    for (text, other_laying) in [(text, &[][..]), (text, &["--outline", "spline"]), (&swinging, &[])] {
        let made = run(text, other_laying);
        assert_eq!(made.code, 0, "{}{}", made.out, made.err);
        let report = report(&made);
        assert_eq!(report["outline"]["lines"], 1, "{}", report["outline"]);
        for name in ["outline", "rolling", "tangency", "undercut"] {
            assert_eq!(finding(&report, name)["verdict"], "pass", "{name}: {report}");
        }
    }
    let made = run(text, &["--format", "dxf"]);
    // Of a face on a straight path the contact lies s' beside its path.
    let growth = 10.0 / (120.0_f64).to_radians();
    let name = files(&made.directory.path().join("output")).pop().expect("a file");
    let dxf = fs::read_to_string(made.directory.path().join("output").join(name)).expect("a drawing");
    let lines: Vec<&str> = dxf.lines().map(str::trim).collect();
    let read =
        |code: &str, at: usize| -> Option<f64> { (lines.get(at)? == &code).then(|| lines.get(at + 1)?.parse().ok())? };
    let from = lines.iter().position(|line| *line == "LWPOLYLINE").expect("an outline");
    let places: Vec<[f64; 2]> =
        (from..lines.len()).filter_map(|at| Some([read("10", at)?, read("20", at + 2)?])).collect();
    let apart = |pair: &[[f64; 2]]| match pair {
        [[a, b], [c, d]] => (c - a).hypot(d - b),
        _ => f64::NAN,
    };
    assert!(places.windows(2).any(|pair| (apart(pair) - growth).abs() < 1e-6), "{growth}: {places:?}");
}

/// Begins at rest with an acceleration the other way: it goes a nanometre beyond its start. The figure is that of an independent program.
#[test]
fn a_small_overshoot_beside_a_turn_is_told() {
    let text = r#"name = "dip"
[motion]
rpm = 60
start = "-0.026387465865523582 in"
[[motion.segment]]
law = "parabola-line"
until = "40.24 deg"
to = "0.0001109 m"
velocity = "-0.4011049951497476 mm/rad"
[[motion.segment]]
law = "line"
until = "135.65153531200377 deg"
to = "-0.5570382623603728 mm"
[[motion.segment]]
law = "polynomial"
over = "0.86 rad"
by = "0.0256136 in"
acceleration = "0.3883102391141605 in/s2"
[[motion.segment]]
law = "polynomial"
over = "49.6888 deg"
by = "-0.5762572296537867 mm"
jerk = "0.0 m/s3"
[[motion.segment]]
law = "dwell"
until = "286.36799804819736 deg"
[[motion.segment]]
law = "4-5-6-7"
to = "-0.026387465865523582 in"
[follower.roller]
radius = "14.0129 mm"
[cam]
base_radius = "40 mm"
[limits]
continuity = 0
"#;
    let made = run(text, &["--force"]);
    let overshoot = number(&report(&made)["motion"]["segments"][3]["overshoot"]);
    // The position has 16 digits of a tenth of a millimetre.
    assert!((overshoot - 8.882_888_325_456_584e-7).abs() < 1e-14, "{overshoot:e}");
}

/// The torque is least 2° behind the middle of a segment, where it has a saddle. The figure is that of an independent program.
#[test]
fn a_torque_beside_a_saddle_is_the_least() {
    let text = r#"name = "saddle"
[motion]
rpm = 300
start = "0 mm"
[[motion.segment]]
law = "formula"
over = "173 deg"
by = "6.538029158863022 mm"
formula = "x - sin(2*pi*x)*27/28/(2*pi) - sin(6*pi*x)/84/2/pi"
[[motion.segment]]
law = "triple-harmonic"
to = "0 mm"
[follower.flat]
tilt = "-24.0763 deg"
mass = "5.5 lb"
preload = "885 N"
[cam]
base_radius = "0.01264 m"
rotation = "ccw"
[spring]
preload = "3.31 N"
"#;
    let made = run(text, &["--force"]);
    let least = number(&report(&made)["dynamics"]["torque_min_nm"]);
    assert!((least / -3.558_958_167_017_734 - 1.0).abs() < 1e-9, "{least}");
}

/// Steep spikes turn by half a turn within a stretch of the profile: they are followed all the same.
#[test]
fn the_outline_of_a_spike_is_followed() {
    let text = r#"name = "spikes"
[motion]
rpm = 60
start = "0 cm"
at = "35.24 deg"
repeat = 5
[motion.polydyne]
natural_frequency = "5 Hz"
rpm = 72.0
[[motion.segment]]
law = "4-5-6-7"
over = "0.467559 rad"
to = "1.45 mm"
[[motion.segment]]
law = "4-5-6-7"
to = "0 cm"
[follower.knife]
offset = "12.1 mm"
[cam]
base_radius = "13.3194 mm"
"#;
    let made = run(text, &["--tolerance", "5um", "--tolerance-acceleration", "none", "--force"]);
    let report = report(&made);
    for name in ["outline", "rolling"] {
        assert_eq!(finding(&report, name)["verdict"], "pass", "{name}: {}", finding(&report, name));
    }
}

/// A corner of 5e-7 rad, over which a roller turns by nanometres: every row of the table has a number in every column.
#[test]
fn a_corner_of_nanometres_leaves_no_gap_in_the_table() {
    let text = r#"name = "corner"
[motion]
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "30 mm"
[[motion.segment]]
law = "polynomial"
until = "210 deg"
to = "18 mm"
velocity = "-0.3 mm/deg"
[[motion.segment]]
law = "line"
velocity = "-0.2999994 mm/deg"
to = "12 mm"
[[motion.segment]]
law = "modified-sine"
to = "0 mm"
[follower.roller]
radius = "15 mm"
[cam]
base_radius = "55 mm"
[limits]
continuity = 0
"#;
    // The corner at the end of the turn, and within it.
    for at in ["-210 deg", "0 deg"] {
        let text = text.replace("start =", &format!("at = \"{at}\"\nstart ="));
        let text = text.replace("until = \"210 deg\"", "over = \"90 deg\"");
        let made = run(&text, &["--force", "--format", "csv"]);
        let name = files(&made.directory.path().join("output")).pop().expect("a table");
        let table = fs::read_to_string(made.directory.path().join("output").join(name)).expect("a table");
        assert!(!table.contains("NaN"), "{at}: {table}");
    }
}

#[test]
fn what_cannot_be_cut_is_told_with_its_place() {
    // A segment that has nothing left of the turn but rounding.
    let rest = r#"name = "rest"
[motion]
start = "0 deg"
at = "169 deg"
[[motion.segment]]
law = "dwell"
over = "108.09 deg"
[[motion.segment]]
law = "harmonic"
until = "529 deg"
to = "0.0798 deg"
[[motion.segment]]
law = "cycloidal"
to = "0 deg"
[follower.swinging-roller]
arm = "100 mm"
pivot_distance = "120 mm"
radius = "10 mm"
[cam]
base_radius = "60 mm"
"#;
    // A spike of 27 m within a tenth of a degree.
    let spike = r#"name = "spike"
[motion]
rpm = 1500
start = "0 mm"
[motion.polydyne]
natural_frequency = "250 Hz"
[[motion.segment]]
law = "dwell"
over = "142 deg"
[[motion.segment]]
law = "poly9"
over = "0.09536297176030673 deg"
by = "0.7961605186688678 mm"
[[motion.segment]]
law = "4-5-6-7"
to = "0 mm"
[follower.knife]
[cam]
base_radius = "22.8 mm"
"#;
    assert!(camgen(&["explain", "outline"]).code == 0, "the check that a spike would fail is explained");
    let short = rest.replace("until = \"529 deg\"", "over = \"1e-10 deg\"");
    for (text, parts) in [
        (rest, &["the segments before the last already cover 360.000000 deg"][..]),
        (&short, &["a segment must be longer than 1e-9 deg", "cam.toml:10:"]),
        (spike, &["no arcs or splines fit the outline between 142.000 and 142.095 deg of the cam", "cam.base_radius"]),
    ] {
        let made = run(text, &["--tolerance-acceleration", "none"]);
        assert_eq!(made.code, 2, "{}{}", made.out, made.err);
        assert!(files(made.directory.path()) == ["cam.toml"], "{:?}", files(made.directory.path()));
        for part in parts {
            assert!(made.err.contains(part), "{part}: {}", made.err);
        }
    }
}

/// Under a knife a velocity that grows leaves a hollow corner at any size: no cam of kilometres is offered for the cutter.
#[test]
fn no_size_hides_a_hollow_corner_from_a_cutter() {
    let text = r#"name = "hollow"
[motion]
start = "0 mm"
[[motion.segment]]
law = "line"
velocity = "4.3 mm/rad"
to = "6.5 mm"
[[motion.segment]]
law = "modified-sine"
over = "100 deg"
to = "7 mm"
[[motion.segment]]
law = "parabola"
to = "0 mm"
velocity = "4.2994 mm/rad"
[follower.knife]
[cam]
base_radius = "auto"
[limits]
pressure_angle = "75 deg"
continuity = 0
cutter_radius = "34 mm"
"#;
    let made = run(text, &["--force"]);
    let report = report(&made);
    assert!(number(&report["cam"]["base_radius_mm"]) < 100.0, "{}", report["cam"]);
    assert_eq!(finding(&report, "cutter_radius")["verdict"], "fail");
}

/// A spline that swings out by 164 m and passes its lowest place with an acceleration of 129 m/rad²: there the path of the roller is hollow,
/// with a radius down to 0.07 mm, over 2.5° of a piece of 279°. The figure is that of the independent program of `tests/independent`.
#[test]
fn a_spike_of_the_curvature_within_a_long_piece_is_found() {
    let text = r#"name = "spike"
[motion]
start = "0 m"
[[motion.segment]]
law = "spline"
over = "359 deg"
to = "0.02133 m"
end = "turn"
points = [["60.9 deg", "3.3969700503249327 mm"], ["79.63 deg", "0.4099 cm"]]
[[motion.segment]]
law = "spline"
to = "0 m"
velocity = "-43.38194197961008 in/rad"
acceleration = "0.8357188320264773 mm/rad2"
points = [["359.7451240601503 deg", "4.93067 mm"]]
[follower.roller]
radius = "0.00931 m"
[cam]
base_radius = "0.0864 m"
[limits]
cutter_radius = "10 mm"
"#;
    let report = report(&run(text, &["--dry-run"]));
    let found = finding(&report, "cutter_radius");
    assert!((number(&found["value"]) / 9.380_530_932_795_192 - 1.0).abs() < 1e-9, "{found}");
    assert_eq!(found["verdict"], "fail");
}

/// Two hundred waves, each with a place where motion is lost: eight of them are told, and how many more there are.
#[test]
fn of_many_places_where_motion_is_lost_some_are_told() {
    let text = "name = \"waves\"\n[motion]\nstart = \"0 mm\"\nformula = \"(2+cos(th))*sin(200*th)\"\n[follower.roller]\nradius = \"10 mm\"\n\
                [cam]\nbase_radius = \"60 mm\"\n";
    let report = report(&run(text, &["--dry-run"]));
    let undercut = finding(&report, "undercut");
    let note = undercut["note"].as_str().expect("a note");
    assert_eq!(note.matches("motion is lost from").count(), 8, "{note}");
    assert!(note.contains("and at 192 other places, at none of them more"), "{note}");
    let lost: Vec<f64> =
        note.split(" mm at ").map(|part| part.rsplit(' ').next().and_then(|n| n.parse().ok()).unwrap_or(0.0)).collect();
    // The waves are highest at 0.
    assert!(lost.iter().take(8).all(|lost| *lost > 5.9), "{note}");
}
