//! The largest tool that can cut the concave parts.

use super::{Finding, Subject, Verdict, verdict};
use crate::cam::{Place, extremes};

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let curves = subject.cam.curves();
    let smooth = extremes::concave_profile_curvature(&curves);
    let corner = extremes::corners(&curves).into_iter().find(|corner| corner.turn < 0.0);
    // At a concave corner of the pitch curve the profile is an arc of the roller's own radius.
    let (radius, at) = match corner {
        Some(corner) => (curves.follower.roller_radius(), Some(corner.angle)),
        None if smooth.value > 0.0 => (1.0 / smooth.value, Some(smooth.at)),
        None => (f64::INFINITY, None),
    };
    let limit = subject.cam.machine().limits.cutter_radius;
    Some(Finding {
        check: "cutter_radius",
        value: 1e3 * radius,
        limit: limit.map(|limit| 1e3 * limit),
        unit: "mm",
        place: at.map_or_else(Place::default, |at| subject.cam.place(at)),
        verdict: limit.map_or(Verdict::Info, |limit| verdict(limit <= radius)),
        note: at.is_none().then(|| "nothing is concave".into()),
    })
}
