//! The sharpest convex place: of the profile (undercut) and of the pitch curve (contact stress).

use super::{Finding, Subject, cam_degrees, passing_radius, verdict};
use crate::cam::{envelope, extremes};
use crate::follower::Follower;

/// Smallest convex radius of the pitch curve, m, and its cam angle; 0 at a convex corner.
fn sharpest(subject: &Subject<'_>) -> (f64, f64) {
    let disc = &subject.rotary.disc;
    if let Some(corner) = extremes::corners(disc).iter().find(|corner| corner.turn > 0.0) {
        (0.0, corner.angle)
    } else {
        let smooth = extremes::convex_pitch_curvature(disc);
        (1.0 / smooth.value, smooth.at)
    }
}

/// The profile exists where the convex radius of the pitch curve exceeds the roller's.
pub(super) fn undercut(subject: &Subject<'_>) -> Option<Finding> {
    let (radius, angle) = sharpest(subject);
    let left = radius - subject.rotary.disc.follower.roller_radius();
    let kept = left > 0.0;
    Some(Finding {
        check: "undercut",
        value: 1e3 * left,
        limit: Some(0.0),
        unit: "mm",
        cam_deg: Some(cam_degrees(angle)),
        verdict: verdict(kept),
        note: if kept { None } else { Some(what_is_lost(subject)) },
    })
}

/// Over which angles motion is lost, how much, and what would help.
fn what_is_lost(subject: &Subject<'_>) -> String {
    let mut words: Vec<String> = match envelope::losses(&subject.rotary.disc) {
        Err(error) => vec![error.to_string()],
        Ok(losses) => losses
            .iter()
            .map(|loss| {
                let (from, to) = (cam_degrees(loss.from), cam_degrees(loss.to));
                let (lost, at) = (1e3 * loss.lost, cam_degrees(loss.lost_at));
                format!("motion is lost from {from:.3}° to {to:.3}°, {lost:.4} mm at {at:.3}°")
            })
            .collect(),
    };
    words.extend(passing_radius(subject.rotary));
    words.join("; ")
}

pub(super) fn min_convex_radius(subject: &Subject<'_>) -> Option<Finding> {
    let (radius, angle) = sharpest(subject);
    let limits = subject.rotary.machine.limits;
    let limit = limits.min_convex_pitch_radius_over_roller * subject.rotary.disc.follower.roller_radius();
    let kept = radius >= limit;
    Some(Finding {
        check: "min_convex_radius",
        value: 1e3 * radius,
        limit: Some(1e3 * limit),
        unit: "mm",
        cam_deg: Some(cam_degrees(angle)),
        verdict: verdict(kept),
        note: if kept { None } else { passing_radius(subject.rotary) },
    })
}
