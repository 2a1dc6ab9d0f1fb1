//! The angle between the roller's path and the normal of the cam.

use super::{Finding, Subject, verdict};
use crate::cam::extremes;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let worst = extremes::pressure_angle(&subject.cam.curves());
    let limit = subject.cam.machine().limits.pressure_angle;
    let kept = worst.value <= limit;
    Some(Finding {
        check: "pressure_angle",
        value: worst.value.to_degrees(),
        // The detour over radians costs an ulp: what was typed as 30 is told as 30.
        limit: Some((limit.to_degrees() * 1e12).round() / 1e12),
        unit: "deg",
        place: subject.cam.place(worst.at),
        verdict: verdict(kept),
        note: if kept { None } else { subject.cam.remedy() },
    })
}
