//! Every refusal, and what its message says would pass.

use super::super::exact::{Statics, response};
use super::super::paper::first_critical;
use super::super::unbalance::{self, Unbalance};
use super::*;

/// Ends at 0 and 1 m, nothing on it.
fn made(segments: &[Segment], supports: Vec<Support>, discs: &[Disc]) -> Result<Shaft, ShaftError> {
    Shaft::new(segments.to_vec(), supports, discs.to_vec(), Beam::Timoshenko)
}

#[track_caller]
fn refused(segment: Segment, support: Support, disc: Disc, error: &ShaftError, text: &str) {
    let supports = vec![Support { at: 1.0, stiffness: None }, support];
    let told = made(&[steel(0.5, 0.04), segment], supports, &[disc]).expect_err(text);
    // NaN is not itself.
    assert_eq!(format!("{told:?}"), format!("{error:?}"));
    assert!(told.to_string().contains(text), "{told}");
}

#[test]
fn segments_out_of_range() {
    let (good, left, light) = (steel(0.5, 0.05), rigid(&[0.0])[0], disc(0.5, 1.0, 1e-3, 2e-3));
    let positive = |name, value| ShaftError::NotPositive { part: Part::Segment, index: 1, name, value };
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let text = "of segment 2 is";
        refused(Segment { length: value, ..good }, left, light, &positive("length", value), text);
        refused(Segment { diameter: value, ..good }, left, light, &positive("diameter", value), text);
        refused(Segment { modulus: value, ..good }, left, light, &positive("modulus", value), text);
    }
    let negative = |name, value| ShaftError::Negative { part: Part::Segment, index: 1, name, value };
    for value in [-1e-9, f64::NAN] {
        let text = "at least 0";
        refused(Segment { density: value, ..good }, left, light, &negative("density", value), text);
        refused(Segment { bore: value, ..good }, left, light, &negative("bore", value), text);
    }
    let bore = ShaftError::Bore { index: 1, bore: 0.05, diameter: 0.05 };
    refused(Segment { bore: 0.05, ..good }, left, light, &bore, "the bore must be smaller");
    for poisson in [-1.0, 0.51, f64::NAN] {
        let error = ShaftError::Poisson { index: 1, value: poisson };
        refused(Segment { poisson, ..good }, left, light, &error, "at most 0.5");
    }
    assert_eq!(made(&[], rigid(&[0.0, 1.0]), &[]), Err(ShaftError::NoSegments));
}

#[test]
fn supports_out_of_place() {
    let (good, left, light) = (steel(0.5, 0.05), rigid(&[0.0])[0], disc(0.5, 1.0, 1e-3, 2e-3));
    for at in [-1e-9, 1.000_000_1, f64::NAN] {
        let error = ShaftError::Outside { part: Part::Support, index: 1, at, length: 1.0 };
        refused(good, Support { at, stiffness: None }, light, &error, "within 0…1 m");
    }
    for value in [0.0, -5.0, f64::NAN] {
        let error = ShaftError::NotPositive { part: Part::Support, index: 1, name: "stiffness", value };
        refused(good, Support { stiffness: Some(value), ..left }, light, &error, "above 0");
    }
    for supports in [rigid(&[]), rigid(&[0.3])] {
        let found = supports.len();
        let told = made(&[good], supports, &[]).expect_err("too few");
        assert_eq!(told, ShaftError::FewSupports { found });
        assert!(told.to_string().contains("at least two"));
    }
    let told = made(&[good], rigid(&[0.4, 0.1, 0.1 + 9e-7]), &[]).expect_err("too near");
    assert!(matches!(told, ShaftError::SupportsTogether { first: 1, second: 2, at: 0.1, .. }), "{told:?}");
    assert!(told.to_string().contains("more than 0.000001 m apart"), "{told}");
    assert!(made(&[good], rigid(&[0.4, 0.1, 0.1 + 1.1e-6]), &[]).is_ok());
}

#[test]
fn discs_that_no_body_is() {
    let (good, left, light) = (steel(0.5, 0.05), rigid(&[0.0])[0], disc(0.5, 1.0, 1e-3, 2e-3));
    let outside = ShaftError::Outside { part: Part::Disc, index: 0, at: 1.5, length: 1.0 };
    refused(good, left, Disc { at: 1.5, ..light }, &outside, "disc 1 is at 1.5 m");
    let negative = |name| ShaftError::Negative { part: Part::Disc, index: 0, name, value: -1.0 };
    refused(good, left, Disc { mass: -1.0, ..light }, &negative("mass"), "of disc 1");
    refused(good, left, Disc { diametral_inertia: -1.0, ..light }, &negative("diametral inertia"), "of disc 1");
    refused(good, left, Disc { polar_inertia: -1.0, ..light }, &negative("polar inertia"), "of disc 1");
    let polar = ShaftError::Polar { index: 0, polar: 2.1e-3, most: 2e-3 };
    refused(good, left, Disc { polar_inertia: 2.1e-3, ..light }, &polar, "at most 0.002 kg m²");
    let unbalance = [0.0, f64::INFINITY];
    let error = ShaftError::NotFinite { part: Part::Disc, index: 0, name: "unbalance", value: f64::INFINITY };
    refused(good, left, Disc { unbalance, ..light }, &error, "must be a number");
}

#[test]
fn too_many_panels() {
    let segments = |count: u32| -> Vec<Segment> {
        (0..count).map(|k| steel(0.01, if k % 2 == 0 { 0.04 } else { 0.05 })).collect()
    };
    let of = |count: u32| made(&segments(count), rigid(&[0.0, 0.01 * f64::from(count)]), &[]);
    assert!(of(50).is_ok());
    assert_eq!(of(51), Err(ShaftError::Panels { found: 51 }));
    // Neighbours of one section are one.
    let same: Vec<Segment> = (0..200).map(|_| steel(0.01, 0.04)).collect();
    assert_eq!(made(&same, rigid(&[0.0, 2.0]), &[]).expect("one panel").segments().len(), 1);
}

#[test]
fn modes_that_there_are_not() {
    let bare = shaft(&[massless(0.6)], rigid(&[0.0, 0.6]), &[], Beam::Timoshenko);
    assert_eq!(modes(&bare, Whirl::Forward, 1, None), Err(ShaftError::NoMass));
    assert_eq!(first_critical(&bare, 18), Err(ShaftError::NoMass));
    // A mass on a rigid support cannot move.
    let held = bare.with_discs(vec![disc(0.6, 5.0, 0.0, 0.0)]).expect("in order");
    assert_eq!(modes(&held, Whirl::Forward, 1, None), Err(ShaftError::NoMass));
    let one = bare.with_discs(vec![disc(0.3, 5.0, 0.0, 0.0)]).expect("in order");
    let told = modes(&one, Whirl::Planar, 3, None).expect_err("one mass, one mode");
    assert_eq!(told, ShaftError::NoSuchMode { asked: 3, exist: 1 });
    assert_eq!(told.to_string(), "the shaft has 1 critical speeds: number 3 does not exist");
    // On springs of 1e-3 N/m the third mode stands at 1e5 times the first.
    let soft = uniform(springs(&[0.0, 1.0], 1e-3), Beam::Euler);
    assert!(modes(&soft, Whirl::Planar, 2, None).is_ok());
    let told = modes(&soft, Whirl::Planar, 3, None).expect_err("lost");
    assert_eq!(told, ShaftError::ModeTooHigh { mode: 3 });
    assert!(told.to_string().contains("ask for 2 at most"), "{told}");
    let beam = uniform(rigid(&[0.0, 1.0]), Beam::Euler);
    assert_eq!(modes(&beam, Whirl::Planar, 31, None), Err(ShaftError::Modes { asked: 31 }));
    assert_eq!(modes(&beam, Whirl::Planar, 0, None).expect("none").modes, []);
    for order in [0, 25] {
        assert_eq!(modes(&beam, Whirl::Planar, 1, Some(order)), Err(ShaftError::Order { order }));
    }
    // A wrong unit, and numbers that only the matrix cannot hold.
    for diameter in [1e150, 1e-150] {
        assert_eq!(made(&[steel(1.0, diameter)], rigid(&[0.0, 1.0]), &[]), Err(ShaftError::Range));
    }
    let light = Segment { density: 1e-300, modulus: 1e300, ..steel(1e-4, 1.0) };
    let far = shaft(&[light], rigid(&[0.0, 1e-4]), &[], Beam::Timoshenko);
    let told = modes(&far, Whirl::Forward, 1, None);
    assert!(matches!(told, Err(ShaftError::Range | ShaftError::NoMass)), "{told:?}");
}

#[test]
fn questions_out_of_range() {
    let beam = uniform(rigid(&[0.0, 1.0]), Beam::Euler);
    let outside = ShaftError::Outside { part: Part::Asked, index: 0, at: 1.1, length: 1.0 };
    assert_eq!(Statics::new(&beam, 1.1), Err(outside));
    assert!(matches!(response(&beam, -1.0), Err(ShaftError::Negative { part: Part::Asked, .. })));
    assert!(matches!(response(&beam, f64::NAN), Err(ShaftError::Negative { part: Part::Asked, .. })));
    assert_eq!(response(&beam, 1e12), Err(ShaftError::TooFast { speed: 1e12 }));
    for stations in [0, MOST_STATIONS + 1] {
        assert_eq!(first_critical(&beam, stations), Err(ShaftError::Stations { stations }));
    }
    let three = uniform(rigid(&[0.0, 0.5, 1.0]), Beam::Euler);
    assert_eq!(first_critical(&three, 18), Err(ShaftError::PaperSupports { found: 3 }));
}

/// A mass of 1 kg above a spring of 1 N/m: I − Ω²B has an exact 0 at 1 rad/s.
#[test]
fn a_resonance_is_named() {
    let unit = Disc { unbalance: [1e-3, 0.0], ..disc(0.0, 1.0, 0.0, 0.0) };
    let supports = vec![Support { at: 0.0, stiffness: Some(1.0) }, rigid(&[1.0])[0]];
    let shaft = shaft(&[massless(1.0)], supports, &[unit], Beam::Euler);
    assert_eq!(response(&shaft, 1.0), Err(ShaftError::Resonance { speed: 1.0 }));
    let beside = response(&shaft, 0.5).expect("away from it");
    close(beside.deflection_at(0.0)[0], 1e-3 * 0.25 / (1.0 - 0.25), 1e-14);
    close(beside.support_forces[0][0], 1e-3 * 0.25 / (1.0 - 0.25), 1e-14);
}

/// Discs that differ by 1e-4 beyond both supports, with a middle so thick that they hardly know each other: λ1/λ2 = 1.0001, and
/// 10 000 rounds leave e⁻² of the other mode.
#[test]
fn two_speeds_too_close_for_the_iteration() {
    let thick = Segment { diameter: 10.0, ..massless(10.0) };
    let discs = [disc(0.0, 1.0, 0.0, 0.0), disc(12.0, 1.000_1, 0.0, 0.0)];
    let shaft = shaft(&[massless(1.0), thick, massless(1.0)], rigid(&[1.0, 11.0]), &discs, Beam::Euler);
    assert_eq!(first_critical(&shaft, 18), Err(ShaftError::CloseSpeeds { rounds: 10_000 }));
    let exact = speeds(&shaft, Whirl::Planar, 2);
    close(exact[1] / exact[0], 1.000_1_f64.sqrt(), 1e-7);
}

#[test]
fn balancing_that_cannot_be() {
    let some = [Unbalance { at: 0.1, vector: [1.0, 0.0] }];
    assert_eq!(unbalance::split(&some, [0.3, 0.3]), Err(ShaftError::PlanesTogether { at: 0.3 }));
    assert_eq!(unbalance::shares(0.1, [0.3, 0.3]), Err(ShaftError::PlanesTogether { at: 0.3 }));
    let light = ShaftError::WeightsTooLight { weight: 0.4, unbalance: 1.0, least: 0.5 };
    assert_eq!(unbalance::correction([0.0, -1.0], 0.4), Err(light));
    assert!(light.to_string().contains("must be 0.5 kg m each"), "{light}");
    assert!(unbalance::correction([0.0, -1.0], 0.5).is_ok());
    assert!(unbalance::correction([0.0, 0.0], 0.0).is_err());
}
