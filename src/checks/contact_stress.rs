//! Pressure in the line of contact between roller and cam, after Hertz.

use super::{Finding, Subject, Verdict, verdict};
use crate::cam::{Place, extremes};
use crate::machine::Material;
use std::f64::consts::PI;

/// Hertz' line contact: p = √(F E*/(π b R)), 1/E* = Σ (1 − ν²)/E, 1/R = the sum of the curvatures, concave negative.
/// The roller is of steel and as wide as the cam is thick (K. L. Johnson, Contact Mechanics, 1985, §4.2).
pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let (cam, machine, curves) = (subject.cam, subject.cam.machine(), subject.cam.curves());
    let (Some(width), Some(material)) = (machine.cam.thickness, machine.cam.material) else {
        return Some(Finding {
            check: "contact_stress",
            value: f64::NAN,
            limit: None,
            unit: "MPa",
            place: Place::default(),
            verdict: Verdict::Info,
            note: Some("not run: cam.thickness and cam.material are not both given".into()),
        });
    };
    let modulus = 1.0 / (1.0 / Material::Steel.contact_modulus() + 1.0 / material.contact_modulus());
    let radius = curves.follower.roller_radius();
    let square = |piece: usize, angle: f64| {
        let profile = curves.profile(piece, angle);
        // On an edge (undercut) the curvature is beyond sense; there the undercut check has spoken.
        let curvature = (1.0 / radius + profile.curvature).max(0.0);
        cam.contact_force(piece, angle) * modulus * curvature / (PI * width)
    };
    let worst = extremes::largest_without_slope(&curves, square);
    let stress = 1e-6 * worst.value.max(0.0).sqrt();
    let limit = machine.limits.contact_stress.map(|limit| 1e-6 * limit);
    Some(Finding {
        check: "contact_stress",
        value: stress,
        limit,
        unit: "MPa",
        place: cam.place(worst.at),
        verdict: limit.map_or(Verdict::Info, |limit| verdict(stress <= limit)),
        note: None,
    })
}
