//! Holes of `[[cam.holes]]`: cut, weighed, drawn and proved as the bore is, and refused where there is no metal for them.

use crate::common::program::{Run, close, files, finding, make, number, report};
use std::f64::consts::PI;
use std::fs;

const DISC: &str = r#"name = "disc with holes"
[motion]
start = "0 mm"
[[motion.segment]]
law = "3-4-5"
over = "150 deg"
to = "12 mm"
[[motion.segment]]
law = "3-4-5"
over = "210 deg"
to = "0 mm"
[follower.roller]
radius = "10 mm"
[cam]
base_radius = "45 mm"
thickness = "12 mm"
bore_radius = "10 mm"
material = "steel"
"#;
/// Four bolts and a timing hole.
const HOLES: &str = r#"
[[cam.holes]]
diameter = "6.6 mm"
circle_diameter = "60 mm"
count = 4
[[cam.holes]]
diameter = "5 mm"
circle_diameter = "70 mm"
angle = "45 deg"
fit = "H7"
purpose = "timing"
"#;

fn run(holes: &str, args: &[&str]) -> Run {
    make(&format!("{DISC}{holes}"), &[&["--json"], args].concat())
}

fn written(made: &Run, ending: &str) -> String {
    let directory = made.directory.path().join("output");
    let name = files(&directory)
        .into_iter()
        .find(|name| name.ends_with(ending) && !name.contains("review"))
        .expect("the file");
    fs::read_to_string(directory.join(name)).expect("a text")
}

/// Circles of a DXF file: centre and radius, mm.
fn circles(dxf: &str) -> Vec<[f64; 3]> {
    let lines: Vec<&str> = dxf.lines().map(str::trim).collect();
    let starts = lines.iter().enumerate().filter(|(_, line)| **line == "CIRCLE").map(|(index, _)| index);
    let value = |from: usize, code: &str| {
        let pairs = lines[from + 1..].chunks_exact(2);
        pairs.map(|pair| (pair[0], pair[1])).find(|(found, _)| *found == code).and_then(|(_, value)| value.parse().ok())
    };
    starts.map(|at| ["10", "20", "40"].map(|code| value(at, code).expect("a number"))).collect()
}

#[test]
fn holes_are_cut_weighed_and_proved() {
    let (bare, made) = (run("", &["--dry-run"]), run(HOLES, &["--format", "dxf,step,svg"]));
    assert_eq!((bare.code, made.code), (0, 0), "{}{}", made.out, made.err);
    let (before, after) = (report(&bare), report(&made));
    for name in ["bore", "wall", "outline", "solid"] {
        let found = after["checks"].as_array().expect("checks").iter().find(|check| check["check"] == name);
        assert!(found.is_none_or(|check| check["verdict"] == "pass"), "{name}: {after}");
    }
    assert_eq!(finding(&after, "bore")["verdict"], "pass");
    let area = PI * (4.0 * 3.3 * 3.3 + 2.5 * 2.5);
    close(number(&before["cam"]["area_mm2"]) - number(&after["cam"]["area_mm2"]), area, 1e-6);
    let lighter = number(&before["cam"]["mass_kg"]) - number(&after["cam"]["mass_kg"]);
    close(lighter, 7850.0e-9 * 12.0 * area, 1e-9);
    let mut found = circles(&written(&made, ".dxf"));
    found.sort_by(|a, b| a[2].total_cmp(&b[2]).then(a[0].total_cmp(&b[0])));
    let at = 35.0 * 0.5_f64.sqrt();
    assert_eq!(found.len(), 6, "bore, four bolts, the timing hole");
    for (one, known) in found[0].iter().zip([at, at, 2.5]) {
        close(*one, known, 1e-9);
    }
    assert!(found[1..5].iter().all(|[x, y, r]| (x.hypot(*y) - 30.0).abs() < 1e-9 && *r == 3.3), "{found:?}");
    let drawing = written(&made, ".svg");
    for words in [
        "4 × Ø6.6 through, circle Ø60, ψ 0°, equally spaced",
        "Ø5 H7 +0.012/0 through, timing, circle Ø70, ψ 45° (TED)",
    ] {
        assert!(drawing.contains(words), "{words}");
    }
}

/// Seen from the other side the cam turns the other way, and the holes with it.
#[test]
fn holes_turn_with_the_cam() {
    let made = run(HOLES, &["--set", "cam.rotation=ccw", "--format", "dxf"]);
    assert_eq!(made.code, 0, "{}", made.err);
    let timing = circles(&written(&made, ".dxf")).into_iter().find(|circle| circle[2] == 2.5).expect("the hole");
    assert!(timing[0] > 0.0 && timing[1] < 0.0, "{timing:?}");
}

#[test]
fn a_hole_without_metal_is_refused() {
    for (key, value, words) in [
        (
            "circle_diameter",
            "140 mm",
            "cam.holes[0]: a hole of Ø6.6 mm on the circle Ø140 at 0.0° does not lie in the metal",
        ),
        ("circle_diameter", "22 mm", "overlaps the bore with its keyway by"),
        ("diameter", "45 mm", "overlaps the profile by 7.5 mm"),
        ("count", "2.5", "must be a whole number"),
        ("diameter", "-3 mm", "diameter"),
    ] {
        let set = format!("cam.holes[0].{key}={value}");
        let made = run(HOLES, &["--set", &set]);
        assert_eq!(made.code, 2, "{set}: {}{}", made.out, made.err);
        assert!(made.err.contains(words), "{set}: {}", made.err);
        assert_eq!(files(made.directory.path()), ["cam.toml"], "{set}");
    }
    // Too little metal between two holes is a limit.
    let thin = run(HOLES, &["--set", "cam.holes[1].circle_diameter=60 mm", "--set", "cam.holes[1].angle=11.2 deg"]);
    let found = report(&thin);
    assert_eq!((thin.code, &finding(&found, "wall")["verdict"]), (1, &"fail".into()), "{found}");
}
