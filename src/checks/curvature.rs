//! The sharpest convex place: of the profile (undercut) and of the pitch curve (contact stress).

use super::{Finding, Subject, verdict};
use crate::cam::{envelope, extremes};

/// Smallest convex radius of the pitch curve, m, and its place; 0 at a convex corner, infinite where nothing is convex.
fn sharpest(subject: &Subject<'_>) -> (f64, f64) {
    let curves = subject.cam.curves();
    if let Some(corner) = extremes::corners(&curves).iter().find(|corner| corner.turn > 0.0) {
        (0.0, corner.angle)
    } else {
        let smooth = extremes::convex_pitch_curvature(&curves);
        (if smooth.value > 0.0 { 1.0 / smooth.value } else { f64::INFINITY }, smooth.at)
    }
}

/// The profile exists where the convex radius of the pitch curve exceeds the roller's.
pub(super) fn undercut(subject: &Subject<'_>) -> Option<Finding> {
    let (radius, angle) = sharpest(subject);
    let left = radius - subject.cam.curves().follower.roller_radius();
    let kept = left > 0.0;
    Some(Finding {
        check: "undercut",
        value: 1e3 * left,
        limit: Some(0.0),
        unit: "mm",
        place: subject.cam.place(angle),
        verdict: verdict(kept),
        note: if kept { None } else { Some(what_is_lost(subject)) },
    })
}

/// Over which angles motion is lost, how much, and what would help.
fn what_is_lost(subject: &Subject<'_>) -> String {
    let mut words: Vec<String> = match envelope::losses(&subject.cam.curves()) {
        Err(error) => vec![format!("{error}, at {}", subject.cam.place(error.parameter))],
        Ok(losses) => losses
            .iter()
            .map(|loss| {
                let [from, to, at] = [loss.from, loss.to, loss.lost_at].map(|place| subject.cam.place(place));
                format!("motion is lost from {from} to {to}, {:.4} mm at {at}", 1e3 * loss.lost)
            })
            .collect(),
    };
    words.extend(subject.cam.remedy());
    words.join("; ")
}

pub(super) fn min_convex_radius(subject: &Subject<'_>) -> Option<Finding> {
    let (radius, angle) = sharpest(subject);
    let limits = subject.cam.machine().limits;
    let limit = limits.min_convex_pitch_radius_over_roller * subject.cam.curves().follower.roller_radius();
    let kept = radius >= limit;
    Some(Finding {
        check: "min_convex_radius",
        value: 1e3 * radius,
        limit: Some(1e3 * limit),
        unit: "mm",
        place: subject.cam.place(angle),
        verdict: verdict(kept),
        note: if kept { None } else { subject.cam.remedy() },
    })
}
