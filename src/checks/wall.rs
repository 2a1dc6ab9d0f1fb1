//! The metal left behind the profile: to the bore, keyway included, or to the other flank of a plate.

use super::{Finding, Subject, verdict};
use crate::cam::Place;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    Some(finding(subject.cam.wall()?, subject.cam.machine().limits.wall))
}

/// The verdict on a wall that must keep a limit, m.
pub(super) fn finding(wall: f64, limit: f64) -> Finding {
    // Rounding of a base radius that was sized for this very wall is no breach.
    let kept = wall > 0.0 && wall >= limit * (1.0 - 1e-9);
    Finding {
        check: "wall",
        value: 1e3 * wall,
        limit: Some(1e3 * limit),
        unit: "mm",
        place: Place::default(),
        verdict: verdict(kept),
        note: None,
    }
}
