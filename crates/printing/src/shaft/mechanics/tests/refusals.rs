//! Every refusal, and what its message says would pass.

use super::super::error::{out_of_range, without_mass};
use super::super::exact::{Statics, response};
use super::super::paper::first_critical;
use super::super::unbalance::{self, Unbalance};
use super::*;

/// Ends at 0 and 1 m, nothing on it.
fn made(segments: &[ShaftSegment], supports: Vec<Support>, discs: &[ShaftDisc]) -> Result<Shaft, Refusal> {
    Shaft::new(segments.to_vec(), supports, discs.to_vec(), Beam::Timoshenko)
}

#[track_caller]
fn refused(segment: ShaftSegment, support: Support, disc: ShaftDisc, text: &str) {
    let supports = vec![Support { at: 1.0, stiffness: None }, support];
    let told = made(&[steel(0.5, 0.04), segment], supports, &[disc]).expect_err(text);
    assert_eq!(told.to_string(), text);
}

#[test]
fn segments_out_of_range() {
    let (good, left, light) = (steel(0.5, 0.05), rigid(&[0.0])[0], disc(0.5, 1.0, 1e-3, 2e-3));
    let positive = |name: &str, value: f64| format!("the {name} of segment 2 is {value}; it must be a number above 0");
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(ShaftSegment { length: value, ..good }, left, light, &positive("length", value));
        refused(ShaftSegment { diameter: value, ..good }, left, light, &positive("diameter", value));
        refused(ShaftSegment { modulus: value, ..good }, left, light, &positive("modulus", value));
    }
    let negative =
        |name: &str, value: f64| format!("the {name} of segment 2 is {value}; it must be a number of at least 0");
    for value in [-1e-9, f64::NAN] {
        refused(ShaftSegment { density: value, ..good }, left, light, &negative("density", value));
        refused(ShaftSegment { bore: value, ..good }, left, light, &negative("bore", value));
    }
    let bore = "segment 2 has a bore of 0.05 m in a diameter of 0.05 m; the bore must be smaller";
    refused(ShaftSegment { bore: 0.05, ..good }, left, light, bore);
    for poisson in [-1.0, 0.51, f64::NAN] {
        let text = format!("the Poisson's ratio of segment 2 is {poisson}; it must be above -1 and at most 0.5");
        refused(ShaftSegment { poisson, ..good }, left, light, &text);
    }
    assert_eq!(made(&[], rigid(&[0.0, 1.0]), &[]).expect_err("empty").what, "the shaft has no segment");
}

#[test]
fn supports_out_of_place() {
    let (good, left, light) = (steel(0.5, 0.05), rigid(&[0.0])[0], disc(0.5, 1.0, 1e-3, 2e-3));
    for at in [-1e-9, 1.000_000_1, f64::NAN] {
        let text = format!("support 2 is at {at} m; it must be within 0…1 m, the length of the shaft");
        refused(good, Support { at, stiffness: None }, light, &text);
    }
    for value in [0.0, -5.0, f64::NAN] {
        let text = format!("the stiffness of support 2 is {value}; it must be a number above 0");
        refused(good, Support { stiffness: Some(value), ..left }, light, &text);
    }
    for supports in [rigid(&[]), rigid(&[0.3])] {
        let found = supports.len();
        let told = made(&[good], supports, &[]).expect_err("too few");
        assert_eq!(told.to_string(), format!("the shaft has {found} supports; it needs at least two"));
    }
    let told = made(&[good], rigid(&[0.4, 0.1, 0.1 + 9e-7]), &[]).expect_err("too near");
    assert!(told.what.starts_with("supports 2 and 3 are ") && told.place.as_deref() == Some("0.1 m"), "{told:?}");
    assert_eq!(
        told.remedy.as_ref().map(ToString::to_string).as_deref(),
        Some("they must be more than 0.000001 m apart")
    );
    assert!(made(&[good], rigid(&[0.4, 0.1, 0.1 + 1.1e-6]), &[]).is_ok());
}

#[test]
fn discs_that_no_body_is() {
    let (good, left, light) = (steel(0.5, 0.05), rigid(&[0.0])[0], disc(0.5, 1.0, 1e-3, 2e-3));
    let outside = "disc 1 is at 1.5 m; it must be within 0…1 m, the length of the shaft";
    refused(good, left, ShaftDisc { at: 1.5, ..light }, outside);
    let negative = |name: &str| format!("the {name} of disc 1 is -1; it must be a number of at least 0");
    refused(good, left, ShaftDisc { mass: -1.0, ..light }, &negative("mass"));
    refused(good, left, ShaftDisc { diametral_inertia: -1.0, ..light }, &negative("diametral inertia"));
    refused(good, left, ShaftDisc { polar_inertia: -1.0, ..light }, &negative("polar inertia"));
    let polar =
        "disc 1 has a polar inertia of 0.0021 kg m², more than twice its diametral one; it can be at most 0.002 kg m²";
    refused(good, left, ShaftDisc { polar_inertia: 2.1e-3, ..light }, polar);
    let unbalance = [0.0, f64::INFINITY];
    refused(good, left, ShaftDisc { unbalance, ..light }, "the unbalance of disc 1 is inf; it must be a number");
}

#[test]
fn too_many_panels() {
    let segments = |count: u32| -> Vec<ShaftSegment> {
        (0..count).map(|k| steel(0.01, if k % 2 == 0 { 0.04 } else { 0.05 })).collect()
    };
    let of = |count: u32| made(&segments(count), rigid(&[0.0, 0.01 * f64::from(count)]), &[]);
    assert!(of(50).is_ok());
    let told = of(51).expect_err("too many");
    assert_eq!(told.what, "the shaft has 51 panels between its steps, supports and discs");
    // Neighbours of one section are one.
    let same: Vec<ShaftSegment> = (0..200).map(|_| steel(0.01, 0.04)).collect();
    assert_eq!(made(&same, rigid(&[0.0, 2.0]), &[]).expect("one panel").segments().len(), 1);
}

#[test]
fn modes_that_there_are_not() {
    let bare = shaft(&[massless(0.6)], rigid(&[0.0, 0.6]), &[], Beam::Timoshenko);
    assert_eq!(modes(&bare, Whirl::Forward, 1, None), Err(without_mass().into()));
    assert_eq!(first_critical(&bare, 18), Err(without_mass()));
    // A mass on a rigid support cannot move.
    let held = bare.with_discs(vec![disc(0.6, 5.0, 0.0, 0.0)]).expect("in order");
    assert_eq!(modes(&held, Whirl::Forward, 1, None), Err(without_mass().into()));
    let one = bare.with_discs(vec![disc(0.3, 5.0, 0.0, 0.0)]).expect("in order");
    let told = modes(&one, Whirl::Planar, 3, None).expect_err("one mass, one mode");
    assert_eq!(told, ShaftError::NoSuchMode { asked: 3, exist: 1 });
    assert_eq!(told.to_string(), "the shaft has 1 critical speed: number 3 does not exist");
    // On springs of 1e-3 N/m the third mode stands at 1e5 times the first.
    let soft = uniform(springs(&[0.0, 1.0], 1e-3), Beam::Euler);
    assert!(modes(&soft, Whirl::Planar, 2, None).is_ok());
    let told = modes(&soft, Whirl::Planar, 3, None).expect_err("lost");
    assert_eq!(told, ShaftError::ModeTooHigh { mode: 3 });
    assert!(told.to_string().contains("ask for 2 at most"), "{told}");
    let beam = uniform(rigid(&[0.0, 1.0]), Beam::Euler);
    let told = modes(&beam, Whirl::Planar, 31, None).expect_err("too many");
    assert_eq!(told.to_string(), "31 modes are asked for; 30 can be found at most");
    assert_eq!(modes(&beam, Whirl::Planar, 0, None).expect("none").modes, []);
    for order in [0, 25] {
        let told = modes(&beam, Whirl::Planar, 1, Some(order)).expect_err("out of range");
        assert_eq!(told.to_string(), format!("the order is {order}; it must be 1…24"));
    }
    // A wrong unit, and numbers that only the matrix cannot hold.
    for diameter in [1e150, 1e-150] {
        assert_eq!(made(&[steel(1.0, diameter)], rigid(&[0.0, 1.0]), &[]), Err(out_of_range()));
    }
    let light = ShaftSegment { density: 1e-300, modulus: 1e300, ..steel(1e-4, 1.0) };
    let far = shaft(&[light], rigid(&[0.0, 1e-4]), &[], Beam::Timoshenko);
    let told = modes(&far, Whirl::Forward, 1, None).expect_err("beyond the arithmetic");
    assert!([out_of_range().into(), without_mass().into()].contains(&told), "{told:?}");
}

#[test]
fn questions_out_of_range() {
    let beam = uniform(rigid(&[0.0, 1.0]), Beam::Euler);
    let outside = Statics::new(&beam, 1.1).expect_err("outside");
    assert_eq!(outside.to_string(), "the load is at 1.1 m; it must be within 0…1 m, the length of the shaft");
    let refused = |speed: f64| response(&beam, speed).expect_err("out of range").to_string();
    assert_eq!(refused(-1.0), "the speed is -1 rad/s; it must be a number of at least 0");
    assert_eq!(refused(f64::NAN), "the speed is NaN rad/s; it must be a number of at least 0");
    assert!(refused(1e12).starts_with("1000000000000 rad/s is so far above every critical speed"));
    for stations in [0, MOST_STATIONS + 1] {
        let told = first_critical(&beam, stations).expect_err("out of range");
        assert_eq!(told.to_string(), format!("{stations} stations; their number must be 1…{MOST_STATIONS}"));
    }
    let three = uniform(rigid(&[0.0, 0.5, 1.0]), Beam::Euler);
    let told = first_critical(&three, 18).expect_err("three supports");
    assert_eq!(told.what, "the shaft has 3 supports, and the paper's method is for two");
}

/// A mass of 1 kg above a spring of 1 N/m: I − Ω²B has an exact 0 at 1 rad/s.
#[test]
fn a_resonance_is_named() {
    let unit = ShaftDisc { unbalance: [1e-3, 0.0], ..disc(0.0, 1.0, 0.0, 0.0) };
    let supports = vec![Support { at: 0.0, stiffness: Some(1.0) }, rigid(&[1.0])[0]];
    let shaft = shaft(&[massless(1.0)], supports, &[unit], Beam::Euler);
    let told = response(&shaft, 1.0).expect_err("a resonance");
    assert_eq!(told.what, "1 rad/s is a critical speed, where the steady response has no bound");
    let beside = response(&shaft, 0.5).expect("away from it");
    close(beside.deflection_at(0.0)[0], 1e-3 * 0.25 / (1.0 - 0.25), 1e-14);
    close(beside.support_forces[0][0], 1e-3 * 0.25 / (1.0 - 0.25), 1e-14);
}

/// Discs that differ by 1e-4 beyond both supports, with a middle so thick that they hardly know each other: λ1/λ2 = 1.0001, and
/// 10 000 rounds leave e⁻² of the other mode.
#[test]
fn two_speeds_too_close_for_the_iteration() {
    let thick = ShaftSegment { diameter: 10.0, ..massless(10.0) };
    let discs = [disc(0.0, 1.0, 0.0, 0.0), disc(12.0, 1.000_1, 0.0, 0.0)];
    let shaft = shaft(&[massless(1.0), thick, massless(1.0)], rigid(&[1.0, 11.0]), &discs, Beam::Euler);
    let told = first_critical(&shaft, 18).expect_err("no end");
    assert!(told.what.starts_with("the iteration has not ended after 10000 rounds"), "{told}");
    let exact = speeds(&shaft, Whirl::Planar, 2);
    close(exact[1] / exact[0], 1.000_1_f64.sqrt(), 1e-7);
}

#[test]
fn balancing_that_cannot_be() {
    let some = [Unbalance { at: 0.1, vector: [1.0, 0.0] }];
    let together = "both correction planes are at 0.3 m; they must be apart";
    assert_eq!(unbalance::split(&some, 0.3, 0.3).expect_err("together").to_string(), together);
    assert_eq!(unbalance::shares(0.1, 0.3, 0.3).expect_err("together").to_string(), together);
    let light = unbalance::correction([0.0, -1.0], 0.4).expect_err("too light").to_string();
    assert_eq!(light, "two weights of 0.4 kg m cannot cancel an unbalance of 1 kg m; they must be 0.5 kg m each");
    assert!(unbalance::correction([0.0, -1.0], 0.5).is_ok());
    assert!(unbalance::correction([0.0, 0.0], 0.0).is_err());
}
