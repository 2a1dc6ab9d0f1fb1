//! The metal left between bore, keyway included, and profile.

use super::{Finding, Subject, verdict};

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let bore = subject.rotary.machine.cam.bore_reach()?;
    let (wall, limit) = (subject.rotary.base_radius() - bore, subject.rotary.machine.limits.wall);
    // Rounding of a base radius that was sized for this very wall is no breach.
    let kept = wall >= limit * (1.0 - 1e-9);
    Some(Finding {
        check: "wall",
        value: 1e3 * wall,
        limit: Some(1e3 * limit),
        unit: "mm",
        cam_deg: None,
        verdict: verdict(kept),
        note: None,
    })
}
