//! The metal left behind the profile: to the bore, keyway included, or to the other flank of a plate.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "wall",
    on: On::Cam,
    about: "The least metal between the profile and the bore with its keyway, or between the two flanks of a plate.",
    explained: Explained {
        bound: Bound::AtLeast,
        formula: "the least distance between the profile and what is cut inside it",
        usual: "camgen's own rule: above 0, and `limits.wall` where it is given; the stress in the hub decides",
        change: "a larger `cam.base_radius`, a smaller `cam.bore_radius`, or a higher `translating.plate_height`",
    },
    run: check,
};

/// Rounding of a base radius that was sized for this wall must not fail.
const ROUNDING: f64 = 1e-9;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let (wall, place) = body.wall()?;
    let limit = body.machine().limits.wall;
    let kept = wall > 0.0 && wall >= limit * (1.0 - ROUNDING);
    let found = CHECK.found(1e3 * wall, Some(1e3 * limit), "mm", Verdict::of(kept));
    let remedy = if kept { None } else { body.remedy() };
    Some(match place {
        Some(worst) => at(body, &worst, found, remedy),
        None => Finding { note: remedy, ..found },
    })
}
