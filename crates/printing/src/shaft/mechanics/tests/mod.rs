//! Golden numbers of closed forms and 40-digit arithmetic, properties of random shafts, extremes, and every refusal.

mod extremes;
mod golden;
mod properties;
mod refusals;

use super::exact::{Modes, modes};
use super::*;

const RPM: f64 = 30.0 / PI;

/// Relative.
#[track_caller]
fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got / want - 1.0).abs() < tolerance, "{got} is not {want}: {:e}", got / want - 1.0);
}

/// Steel, solid.
fn steel(length: f64, diameter: f64) -> ShaftSegment {
    ShaftSegment { length, diameter, bore: 0.0, modulus: 210e9, density: 7850.0, poisson: 0.3 }
}

fn rigid(places: &[f64]) -> Vec<Support> {
    places.iter().map(|at| Support { at: *at, stiffness: None }).collect()
}

fn springs(places: &[f64], stiffness: f64) -> Vec<Support> {
    places.iter().map(|at| Support { at: *at, stiffness: Some(stiffness) }).collect()
}

fn disc(at: f64, mass: f64, diametral_inertia: f64, polar_inertia: f64) -> ShaftDisc {
    ShaftDisc { at, mass, diametral_inertia, polar_inertia, unbalance: [0.0; 2] }
}

#[track_caller]
fn shaft(segments: &[ShaftSegment], supports: Vec<Support>, discs: &[ShaftDisc], beam: Beam) -> Shaft {
    Shaft::new(segments.to_vec(), supports, discs.to_vec(), beam).expect("a shaft in order")
}

#[track_caller]
fn found(shaft: &Shaft, whirl: Whirl, count: usize) -> Modes {
    modes(shaft, whirl, count, None).expect("modes")
}

#[track_caller]
fn speeds(shaft: &Shaft, whirl: Whirl, count: usize) -> Vec<f64> {
    found(shaft, whirl, count).modes.iter().map(|mode| mode.speed).collect()
}

/// Critical speeds in rpm.
#[track_caller]
fn runs(shaft: &Shaft, whirl: Whirl, rpm: &[f64], tolerance: f64) {
    for (got, want) in speeds(shaft, whirl, rpm.len()).iter().zip(rpm) {
        close(got * RPM, *want, tolerance);
    }
}

/// U: ∅50 × 1 m.
fn uniform(supports: Vec<Support>, beam: Beam) -> Shaft {
    shaft(&[steel(1.0, 0.05)], supports, &[], beam)
}

/// The reference cylinder of the two ends' stiffness.
fn cylinder(stiffness: Option<f64>, beam: Beam) -> Shaft {
    let supports = [0.0, 1.367].map(|at| Support { at, stiffness }).to_vec();
    shaft(&[steel(0.255, 0.16), steel(0.857, 0.416), steel(0.255, 0.16)], supports, &[], beam)
}

/// Shaft A with the disc of golden 13.
fn shaft_a(beam: Beam) -> Shaft {
    let segments = [steel(0.04, 0.045), steel(0.22, 0.05), steel(0.04, 0.045)];
    shaft(&segments, springs(&[0.02, 0.28], 5e8), &[disc(0.15, 12.0, 0.05, 0.1)], beam)
}

/// Without mass, ∅40.
fn massless(length: f64) -> ShaftSegment {
    ShaftSegment { density: 0.0, ..steel(length, 0.04) }
}
