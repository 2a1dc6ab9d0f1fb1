//! The largest tool that can cut the concave parts.

use super::{Check, Evidence, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "cutter_radius",
    on: On::Cam,
    about: "The radius of the largest cutter that fits into the concave parts of the profile.",
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let limit = body.machine().limits.cutter_radius;
    let hollow = body.hollow();
    let radius = hollow.map_or(f64::INFINITY, |hollow| hollow.value);
    let verdict = limit.map_or(Verdict::Info, |limit| Verdict::of(limit <= radius));
    let found = CHECK.found(1e3 * radius, limit.map(|limit| 1e3 * limit), "mm", verdict);
    Some(match hollow {
        Some(hollow) => {
            let remedy = (found.verdict == Verdict::Fail).then(|| body.remedy()).flatten();
            at(body, &hollow, found, remedy)
        }
        None => Finding { note: Some("nothing is concave".into()), ..found },
    })
}
