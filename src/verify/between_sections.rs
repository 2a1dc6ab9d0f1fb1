//! The residual force of a cam for many speeds at the speeds between its sections.

use super::{Check, Evidence, On};
use crate::report::{Finding, Place, Verdict};

pub(super) const CHECK: Check = Check {
    name: "between_sections",
    on: On::Cam,
    about: "The largest residual force, inertia less air, at any speed between the sections of a conoid.",
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let conoid = evidence.body.spatial()?;
    let (left, limit) = (conoid.left_between(), conoid.residual_limit());
    let verdict = limit.map_or(Verdict::Info, |limit| Verdict::of(left.force <= limit));
    let note = format!("at {:.3} rpm, of {} sections", left.rpm, conoid.section_count());
    let found = CHECK.found(left.force, limit, "N", verdict);
    Some(Finding { place: Place::at_angle(left.angle), note: Some(note), ..found })
}
