//! Pressure in the line of contact between roller and cam, after Hertz.

use super::{Finding, Subject, Verdict, cam_degrees, verdict};
use crate::cam::extremes;
use crate::follower::Follower;
use crate::machine::Material;
use std::f64::consts::PI;

/// Hertz' line contact: p = √(F E*/(π b R)), 1/E* = Σ (1 − ν²)/E, 1/R = the sum of the curvatures, concave negative.
/// The roller is of steel and as wide as the cam is thick (K. L. Johnson, Contact Mechanics, 1985, §4.2).
pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let rotary = subject.rotary;
    let (Some(width), Some(material)) = (rotary.machine.cam.thickness, rotary.machine.cam.material) else {
        return Some(Finding {
            check: "contact_stress",
            value: f64::NAN,
            limit: None,
            unit: "MPa",
            cam_deg: None,
            verdict: Verdict::Info,
            note: Some("not run: cam.thickness and cam.material are not both given".into()),
        });
    };
    let modulus = 1.0 / (1.0 / Material::Steel.contact_modulus() + 1.0 / material.contact_modulus());
    let radius = rotary.disc.follower.roller_radius();
    let square = |piece: usize, angle: f64| {
        let contact = rotary.disc.contact(piece, angle);
        let profile = contact.pitch.offset_inward(radius);
        let normal_force = rotary.roller_force(piece, angle).max(0.0) / libm::cos(contact.pressure_angle);
        // On an edge (undercut) the curvature is beyond sense; there the undercut check has spoken.
        let curvature = (1.0 / radius + profile.curvature).max(0.0);
        normal_force * modulus * curvature / (PI * width)
    };
    let worst = extremes::largest_without_slope(&rotary.disc, square);
    let stress = 1e-6 * worst.value.max(0.0).sqrt();
    let limit = rotary.machine.limits.contact_stress.map(|limit| 1e-6 * limit);
    Some(Finding {
        check: "contact_stress",
        value: stress,
        limit,
        unit: "MPa",
        cam_deg: Some(cam_degrees(worst.at)),
        verdict: limit.map_or(Verdict::Info, |limit| verdict(stress <= limit)),
        note: None,
    })
}
