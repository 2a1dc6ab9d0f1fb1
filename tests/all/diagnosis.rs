//! What a failed check says of the reason: each planted in a file that is the cam otherwise, and told with its value.

use crate::common::random::Random;
use camgen::body::Layer;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::domains::press::wedge::LAW_TOLERANCE;
use camgen::geometry::Entity;
use camgen::geometry::contour::{Contour, Vertex};
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec};
use camgen::report::Report;
use camgen::tool_files::dxf::{self, Version};
use nalgebra::Vector2;
use serde_json::Value;

/// Tolerance of the files, m: a tenth of a micrometre, so that what is planted is all there is.
const FINE: f64 = 1e-7;
/// Tolerance of the checks, m.
const TOLERANCE: f64 = 5e-6;

fn machine(set: &[&str]) -> Machine {
    let set: Vec<String> = set.iter().map(ToString::to_string).collect();
    Machine::load("dpi", &set).expect("a machine").0
}

/// A cam that is alike in no other place: its roller's path goes past the shaft.
fn rotary(rpm: f64, set: &[&str]) -> Cam {
    Spec::rotary(machine(&[&["follower.roller.offset=12mm", "cam.base_radius=90mm"], set].concat()), rpm)
        .solve()
        .expect("a cam")
}

fn plate(rpm: f64, set: &[&str]) -> Cam {
    let solver = Solver::Ode { tolerance: LAW_TOLERANCE };
    Spec::translating(machine(set), rpm, solver, ExactOn::Braking).solve().expect("a plate")
}

fn contour(cam: &Cam, part: usize) -> Contour {
    let drawing = cam.draw(FINE).expect("a drawing");
    drawing.drawn().expect("an outline").parts[part].outline.contour.clone()
}

fn moved(contour: &Contour, to: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Contour {
    let vertices = contour.vertices.iter().map(|vertex| Vertex { point: to(vertex.point), ..*vertex });
    Contour { vertices: vertices.collect() }
}

fn turned(contour: &Contour, degrees: f64) -> Contour {
    let (sin, cos) = degrees.to_radians().sin_cos();
    moved(contour, |p| Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y))
}

fn file(contour: &Contour) -> Vec<u8> {
    dxf::write(&[(Layer::CamProfile, Entity::Polyline(contour.clone()))], Version::R2000)
}

fn diagnosis(report: &Report) -> Vec<Value> {
    assert!(!report.passed());
    let all = report.section("diagnosis").expect("a diagnosis");
    all.as_array().expect("a list").clone()
}

/// The explanations of a contour that is not this cam; the first must be this cause, with this value, and leave next to nothing.
fn told(cam: &Cam, contour: &Contour, cause: &str, wanted: Option<(f64, f64)>) -> Vec<Value> {
    let report = cam.check(&file(contour), TOLERANCE).expect("a DXF file");
    let all = diagnosis(&report);
    let named = all.iter().find(|found| found["cause"] == cause).unwrap_or_else(|| panic!("{cause}: {all:?}"));
    if let Some((value, within)) = wanted {
        let found = named["value"].as_f64().expect("a value");
        assert!((found - value).abs() <= within, "{cause}: {found}, not {value}: {all:?}");
    }
    let (first, own) = (&all[0]["remaining_mm"], &named["remaining_mm"]);
    let (first, own) = (first.as_f64().expect("a number"), own.as_f64().expect("a number"));
    // Best first; what is left are the tolerances of two drawings, and a speed found to some ten-thousandths.
    assert!(own <= 5e-3 && own <= first.max(5e-3), "{cause}: {all:?}");
    all
}

/// Angles within 1e-3°, factors within 1e-6, lengths within 1 µm: what a machinist could still set.
#[test]
fn a_moved_outline_is_told_with_its_move() {
    let cam = rotary(35.0, &[]);
    let own = contour(&cam, 0);
    for degrees in [30.0, -90.0, 0.1, -137.25] {
        let all = told(&cam, &turned(&own, degrees), "turned", Some((degrees, 1e-3)));
        assert_eq!(all[0]["cause"], "turned", "{all:?}");
    }
    for (x, y) in [(3.0_f64, -2.0), (0.02, 0.0), (150.0, 80.0)] {
        let shifted = moved(&own, |p| p + Vector2::new(x, y));
        let all = told(&cam, &shifted, "shifted", Some((x.hypot(y), 1e-3)));
        let found =
            [&all[0]["changes"][0]["x_mm"], &all[0]["changes"][0]["y_mm"]].map(|v| v.as_f64().expect("a number"));
        assert!((found[0] - x).abs() <= 1e-3 && (found[1] - y).abs() <= 1e-3, "{found:?}");
    }
    for factor in [25.4, 1.0 / 25.4, 1.01, 0.5] {
        let scaled = moved(&own, |p| p * factor);
        let all = told(&cam, &scaled, "scaled", Some((factor, 1e-6 * factor.max(1.0))));
        assert_eq!(all[0]["cause"], "scaled", "{all:?}");
    }
}

/// Changes of a few tolerances, of a file that itself takes all of its tolerance: what remains is no small share of what was found.
#[test]
fn a_small_change_is_told_of_a_coarse_file() {
    let tolerance = 5e-6;
    let cam = rotary(35.0, &[]);
    let drawing = cam.draw(tolerance).expect("a drawing");
    let own = drawing.drawn().expect("an outline").parts[0].outline.contour.clone();
    let with = |to: &dyn Fn(Vector2<f64>) -> Vector2<f64>| file(&moved(&own, to));
    let (sin, cos) = libm::sincos(0.02_f64.to_radians());
    for (bytes, cause, value, within) in [
        (with(&|p| p + Vector2::new(0.012, 0.0)), "shifted", 0.012, 3e-3),
        (with(&|p| p + Vector2::new(0.0, 0.02)), "shifted", 0.02, 3e-3),
        (with(&|p| p * 1.0003), "scaled", 1.0003, 3e-5),
        (with(&|p| p * 0.9995), "scaled", 0.9995, 3e-5),
        (with(&|p| Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y)), "turned", 0.02, 3e-3),
    ] {
        let all = diagnosis(&cam.check(&bytes, tolerance).expect("a DXF file"));
        let found = all.first().and_then(|first| first["value"].as_f64()).unwrap_or(f64::NAN);
        assert_eq!(all.first().map(|first| &first["cause"]), Some(&Value::from(cause)), "{value}: {all:?}");
        assert!((found - value).abs() <= within, "{cause}: {found}, not {value}: {all:?}");
    }
}

#[test]
fn a_mirrored_outline_is_told_from_a_reversed_motion() {
    let cam = rotary(35.0, &[]);
    let all = told(&cam, &contour(&cam, 0).mirrored_about_x(), "mirrored", None);
    assert_eq!(all[0]["cause"], "mirrored");
    let other = rotary(35.0, &["cam.rotation=ccw"]);
    told(&cam, &contour(&other, 0), "mirrored", None);
    // The lift run backwards on the same path: the mirror image of the cam whose path is on the other side.
    let opposite = rotary(35.0, &["follower.roller.offset=-12mm"]);
    let all = told(&cam, &contour(&opposite, 0).mirrored_about_x(), "reversed", None);
    assert_eq!(all[0]["cause"], "reversed", "{all:?}");
}

#[test]
fn another_roller_and_another_speed_are_told() {
    let cam = rotary(35.0, &[]);
    // The same pitch curve: base radius and roller radius together are 120 mm.
    let thicker = rotary(35.0, &["follower.roller.radius=30.5mm", "cam.base_radius=89.5mm"]);
    let all = told(&cam, &contour(&thicker, 0), "offset", Some((-0.5, 1e-3)));
    assert_eq!(all[0]["cause"], "offset", "{all:?}");
    for rpm in [34.5, 28.0, 47.0] {
        let all = told(&cam, &contour(&rotary(rpm, &[]), 0), "speed", Some((rpm, 0.01)));
        assert_eq!(all[0]["cause"], "speed", "{all:?}");
    }
}

#[test]
fn two_changes_at_once_are_told_together() {
    let cam = rotary(35.0, &[]);
    let own = contour(&cam, 0);
    let both = turned(&own.mirrored_about_x(), 75.0);
    let all = told(&cam, &both, "mirrored and turned", Some((75.0, 1e-3)));
    assert_eq!(all[0]["cause"], "mirrored and turned", "{all:?}");
    let inches = moved(&own, |p| p / 25.4 + Vector2::new(4.0, 1.0));
    let all = told(&cam, &inches, "scaled and shifted", Some((1.0 / 25.4, 1e-6)));
    assert_eq!(all[0]["cause"], "scaled and shifted", "{all:?}");
}

#[test]
fn plates_and_sections_are_diagnosed() {
    let cam = plate(35.0, &[]);
    let own = contour(&cam, 0);
    told(&cam, &moved(&own, |p| p + Vector2::new(0.0, 0.25)), "shifted", Some((0.25, 1e-3)));
    told(&cam, &turned(&own, 180.0), "turned", Some((180.0, 1e-3)));
    told(&cam, &moved(&own, |p| p / 25.4), "scaled", Some((1.0 / 25.4, 1e-6)));
    told(&cam, &contour(&plate(30.0, &[]), 0), "speed", Some((30.0, 0.01)));
    let conoid = Spec::conoid(machine(&[]), vec![20.0, 25.0, 30.0, 35.0], None).solve().expect("a conoid");
    let faulty = turned(&contour(&conoid, 1), 10.0);
    let report = conoid.check_section(&file(&faulty), 25.0, TOLERANCE).expect("a DXF file");
    let all = diagnosis(&report);
    let found = all.first().expect("an explanation");
    assert_eq!(found["cause"], "turned", "{all:?}");
    assert!((found["value"].as_f64().expect("degrees") - 10.0).abs() < 1e-3, "{all:?}");
    let other = conoid.check_section(&file(&contour(&conoid, 2)), 25.0, TOLERANCE).expect("a DXF file");
    let all = diagnosis(&other);
    assert_eq!((&all[0]["cause"], &all[0]["value"]), (&"section".into(), &30.0.into()), "{all:?}");
}

/// Vertices moved at random by up to 0.2 mm: no change of the whole explains it.
#[test]
fn a_deformed_outline_is_explained_by_nothing() {
    let cam = rotary(35.0, &[]);
    let mut random = Random(7);
    let own = contour(&cam, 0);
    let vertices = own.vertices.iter().map(|vertex| {
        let by = Vector2::new(random.between(-0.2, 0.2), random.between(-0.2, 0.2));
        Vertex { point: vertex.point + by, ..*vertex }
    });
    let deformed = Contour { vertices: vertices.collect() };
    let report = cam.check(&file(&deformed), TOLERANCE).expect("a DXF file");
    assert_eq!(diagnosis(&report), Vec::<Value>::new());
}

#[test]
fn a_cam_that_passes_has_no_diagnosis() {
    let cam = rotary(35.0, &[]);
    let drawing = cam.draw(FINE).expect("a drawing");
    let entities = drawing.drawn().expect("an outline").parts[0].entities();
    let report = cam.check(&dxf::write(&entities, Version::R2000), TOLERANCE).expect("a DXF file");
    assert!(report.passed() && report.section("diagnosis").is_none(), "{:?}", report.checks);
}
