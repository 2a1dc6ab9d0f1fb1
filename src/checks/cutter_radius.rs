//! The largest tool that can cut the concave parts.

use super::{Finding, Subject, Verdict, cam_degrees, verdict};
use crate::cam::extremes;
use crate::follower::Follower;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let disc = &subject.rotary.disc;
    let smooth = extremes::concave_profile_curvature(disc);
    let corner = extremes::corners(disc).into_iter().find(|corner| corner.turn < 0.0);
    // At a concave corner of the pitch curve the profile is an arc of the roller's own radius.
    let (radius, at) = match corner {
        Some(corner) => (disc.follower.roller_radius(), Some(corner.angle)),
        None if smooth.value > 0.0 => (1.0 / smooth.value, Some(smooth.at)),
        None => (f64::INFINITY, None),
    };
    let limit = subject.rotary.machine.limits.cutter_radius;
    Some(Finding {
        check: "cutter_radius",
        value: 1e3 * radius,
        limit: limit.map(|limit| 1e3 * limit),
        unit: "mm",
        cam_deg: at.map(cam_degrees),
        verdict: limit.map_or(Verdict::Info, |limit| verdict(limit <= radius)),
        note: at.is_none().then(|| "nothing is concave".into()),
    })
}
