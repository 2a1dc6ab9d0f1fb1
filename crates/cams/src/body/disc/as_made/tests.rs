//! On a circle off its shaft every lift is known in closed form, with errors and without.

use super::*;
use crate::machine::Machine;
use camgen_kernel::motion::EccentricCircle;
use std::sync::Arc;

const ECCENTRICITY: f64 = 0.010;
const PITCH: f64 = 0.050;
/// Errors so small that what is left out of first order is 1e-5 of them.
const SMALL: f64 = 1e-7;

/// A disc of steel, 20 mm thick, under a roller of 12 mm with 3 kg behind it, at 120 rpm.
fn disc(errors: &str) -> Disc {
    let toml = format!(
        "name = \"circle\"\n[follower.roller]\nradius = \"12 mm\"\nmass = \"3 kg\"\npreload = \"400 N\"\n\
         [cam]\nbase_radius = \"28 mm\"\nthickness = \"20 mm\"\nmaterial = \"steel\"\n[as_made]\n{errors}\n"
    );
    let machine = Machine::from_toml("circle", &toml, &[]).expect("a machine");
    let motion = Arc::new(EccentricCircle::new(ECCENTRICITY, PITCH));
    Disc::of_motion(&machine, motion, Some(120.0)).expect("a disc")
}

/// The distance of the roller's centre from the shaft along its path, with first and second derivative: the centre of the circle lies
/// at the distance `e` from the shaft at the angle 0, and the path is `offset` to the side.
fn height(angle: f64, [e, radius, offset]: [f64; 3]) -> Rates {
    let (sine, cosine) = libm::sincos(angle);
    let (across, first, second) = (offset + e * sine, e * cosine, -e * sine);
    let root = (radius * radius - across * across).sqrt();
    let root_first = -across * first / root;
    let root_second = (-first * first - across * second - root_first * root_first) / root;
    [e * cosine + root, -e * sine + root_first, -e * cosine + root_second]
}

/// The largest differences of the errors of the lift and its rates from those in closed form, over the largest error of each.
fn off(errors: &str, changed: [f64; 3], ahead: f64) -> Rates {
    let disc = disc(errors);
    let of = disc.machine.as_made.expect("errors");
    let (mut worst, mut largest) = ([0.0_f64; 3], [0.0_f64; 3]);
    for step in 0..360 {
        let angle = f64::from(step).to_radians();
        let (piece, at) = disc.motion.locate(angle);
        let place = Place { disc: &disc, at: (piece, at), contact: disc.curves().contact(piece, at), lobe: angle - at };
        let (error, _) = place.error(&of, &[]);
        let exact = height(angle + ahead, changed);
        let nominal = height(angle, [ECCENTRICITY, PITCH, 0.0]);
        for (order, found) in [error.s, error.ds, error.dds].into_iter().enumerate() {
            let wanted = exact[order] - nominal[order];
            worst[order] = worst[order].max((found - wanted).abs());
            largest[order] = largest[order].max(wanted.abs());
        }
    }
    [0, 1, 2].map(|order| worst[order] / largest[order])
}

/// First order against the closed form of the circle: the second order is the error over a radius of 50 mm, some 1e-5; subtraction of
/// two heights rounds 1e-7 m to 1e-9 of it.
#[test]
fn errors_of_a_circle_are_those_of_its_closed_form() {
    let mm = 1e3 * SMALL;
    let cases = [
        (format!("roller_radius = \"{mm} mm\""), [ECCENTRICITY, PITCH + SMALL, 0.0], 0.0),
        (format!("wear = \"{mm} mm\""), [ECCENTRICITY, PITCH - SMALL, 0.0], 0.0),
        (format!("eccentricity = \"{mm} mm\""), [ECCENTRICITY + SMALL, PITCH, 0.0], 0.0),
        (format!("offset = \"{mm} mm\""), [ECCENTRICITY, PITCH, SMALL], 0.0),
        ("angle = \"1e-6 rad\"".to_owned(), [ECCENTRICITY, PITCH, 0.0], 1e-6),
    ];
    for (errors, changed, ahead) in cases {
        for (order, off) in off(&errors, changed, ahead).into_iter().enumerate() {
            assert!(off < 3e-5, "{errors}, order {order}: {off}");
        }
    }
}

/// A sum of waves has the root mean square that is given, its rates are those of it, and another draw is another sum.
#[test]
fn waves_have_their_height_and_rates() {
    let disc = disc("waviness = \"2 um\"\nwaves_from = 12\nwaves_to = 30\ndraw = 3");
    let of = disc.machine.as_made.expect("errors");
    let sum = waves(&of);
    assert_eq!(sum.len(), 19);
    let squares: f64 = (0..512).map(|step| waved(&sum, TAU * f64::from(step) / 512.0)[0].powi(2)).sum();
    assert!(((squares / 512.0).sqrt() - 2e-6).abs() < 1e-15);
    let step = 1e-4;
    for place in 0..50 {
        let angle = 0.1 * f64::from(place);
        let [before, here, after] = [-step, 0.0, step].map(|by| waved(&sum, angle + by));
        // Differences of second order: (k h)²/6 of a wave.
        assert!(((after[0] - before[0]) / (2.0 * step) - here[1]).abs() < 2e-6 * 30.0 * 1e-5);
        assert!(((after[1] - before[1]) / (2.0 * step) - here[2]).abs() < 2e-6 * 900.0 * 1e-5);
    }
    let other = waves(&AsMadeData { draw: 4.0, ..of });
    assert!((waved(&other, 1.0)[0] - waved(&sum, 1.0)[0]).abs() > 1e-9);
}

/// Forces and pressure of a cam without errors are those of the cam; errors change them.
#[test]
fn forces_without_errors_are_those_of_the_cam() {
    let number = |disc: &Disc, key: &str| disc.as_made().expect("a section").value[key].as_f64().expect("a number");
    let exact = disc("wear = \"0 mm\"");
    let cam = exact.largest_force(|piece, angle| exact.normal_force(piece, angle).unwrap_or(f64::NAN)).value;
    // The largest of 1440 places misses the largest of all by (π/1440)²/2.
    assert!((number(&exact, "contact_force_max_n") / cam - 1.0).abs() < 3e-6);
    let stress = crate::body::Figures::contact_stress(&exact).expect("a stress").value;
    assert!((1e6 * number(&exact, "contact_stress_max_mpa") / stress - 1.0).abs() < 3e-6);
    assert_eq!(number(&exact, "lift_error_max_mm"), 0.0);
    let wavy = disc("waviness = \"2 um\"");
    assert!(number(&wavy, "contact_force_max_n") > cam);
}
