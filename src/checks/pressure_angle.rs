//! The angle between the roller's path and the normal of the cam.

use super::{Finding, Subject, cam_degrees, passing_radius, verdict};
use crate::cam::extremes;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let worst = extremes::pressure_angle(&subject.rotary.disc);
    let limit = subject.rotary.machine.limits.pressure_angle;
    let kept = worst.value <= limit;
    Some(Finding {
        check: "pressure_angle",
        value: worst.value.to_degrees(),
        // The detour over radians costs an ulp: what was typed as 30 is told as 30.
        limit: Some((limit.to_degrees() * 1e12).round() / 1e12),
        unit: "deg",
        cam_deg: Some(cam_degrees(worst.at)),
        verdict: verdict(kept),
        note: if kept { None } else { passing_radius(subject.rotary) },
    })
}
