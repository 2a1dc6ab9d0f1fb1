use super::{Analysis, ComparisonFit, ComparisonOptions, analysis};
use crate::body::Body;
use crate::machine::Machine;
use crate::pipeline::{Cam, Spec};
use nalgebra::Vector2;
use std::f64::consts::TAU;

fn cam(overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let machine = Machine::load("feeder", &overrides).expect("valid").0;
    Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
}

/// Points at a distance from the exact profile, by the polar angle of their foot, turned and shifted as on a measuring machine.
fn measured(body: &dyn Body, off: impl Fn(f64) -> f64, turn: f64, shift: Vector2<f64>) -> Vec<Vector2<f64>> {
    let curves = crate::body::curves(body).expect("a plane cam");
    let mirrored = body.cuts()[0].mirrored == [true];
    let (sin, cos) = libm::sincos(turn);
    let point = |i: u32| {
        let (piece, angle) = curves.motion.locate(TAU * f64::from(i) / 720.0);
        let frame = curves.profile(piece, angle).scaled(1e3);
        let flip = |v: Vector2<f64>| if mirrored { Vector2::new(v.x, -v.y) } else { v };
        let (foot, outward) = (flip(frame.point), flip(frame.outward()));
        let at = foot + outward * off(libm::atan2(foot.y, foot.x));
        Vector2::new(cos * at.x - sin * at.y, sin * at.x + cos * at.y) + shift
    };
    (0..720).map(point).collect()
}

fn compared(cam: &Cam, points: &[Vector2<f64>], fit: ComparisonFit, ball: f64) -> Analysis {
    let body = cam.body();
    analysis(body, &body.cuts()[0], points, ComparisonOptions { ball, fit }).expect("a comparison")
}

fn figure(found: &Analysis, name: &str) -> f64 {
    found.sections[0].value[name].as_f64().unwrap_or_else(|| panic!("{name}: {}", found.sections[0].value))
}

/// An exact cam, in any position and with a ball, has no deviation.
#[test]
fn an_exact_cam_is_exact_wherever_it_lies() {
    for (overrides, ball) in [(&[][..], 0.0), (&["cam.rotation=ccw"], 3.0)] {
        let cam = cam(overrides);
        let (turn, shift) = (-1.1, Vector2::new(0.2, -0.05));
        let points = measured(cam.body(), |_| ball, turn, shift);
        let found = compared(&cam, &points, ComparisonFit::Centre, 1e-3 * ball);
        assert!(figure(&found, "form_error_mm") < 1e-8, "{}", found.sections[0].value);
        assert!((figure(&found, "turn_deg") + turn.to_degrees()).abs() < 1e-6);
    }
}

/// Known errors come back: waviness of third order, an offset all round, an eccentricity, a turn.
#[test]
fn known_errors_come_back() {
    let cam = cam(&[]);
    let wave = |at: f64| 2e-3 * libm::cos(3.0 * at + 0.4);
    let found = compared(&cam, &measured(cam.body(), wave, 0.7, Vector2::zeros()), ComparisonFit::Angle, 0.0);
    let third = found.sections[0].value["waviness_mm"][2].as_f64().expect("an amplitude");
    assert!((third - 2e-3).abs() < 0.02 * 2e-3, "{third}");
    let shift = Vector2::new(0.006, -0.008);
    let found = compared(&cam, &measured(cam.body(), |_| 0.0, 0.0, shift), ComparisonFit::Centre, 0.0);
    let told = &found.sections[0].value["shift_mm"];
    let told = Vector2::new(told[0].as_f64().expect("x"), told[1].as_f64().expect("y"));
    assert!((told + shift).norm() < 0.02 * shift.norm(), "{told}");
    let found = compared(&cam, &measured(cam.body(), |_| 0.011, 0.0, Vector2::zeros()), ComparisonFit::Angle, 0.0);
    assert!((figure(&found, "mean_mm") - 0.011).abs() < 0.02 * 0.011, "{}", found.sections[0].value);
}

/// The limit is half of the zone of the title block.
#[test]
fn the_verdict_is_that_of_the_profile_tolerance() {
    let cam = cam(&["title.profile_tolerance=0.02 mm"]);
    for (off, kept) in [(0.0095, true), (-0.0105, false)] {
        let found = compared(&cam, &measured(cam.body(), |_| off, 0.3, Vector2::zeros()), ComparisonFit::Angle, 0.0);
        let finding = found.measures[0].finding();
        assert_eq!(finding.verdict == crate::report::Verdict::Pass, kept, "{finding:?}");
    }
}
