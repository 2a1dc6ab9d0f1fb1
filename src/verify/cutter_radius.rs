//! The largest tool that can cut the concave parts.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "cutter_radius",
    on: On::Cam,
    about: "The radius of the largest cutter that fits into the concave parts of the profile.",
    explained: Explained {
        bound: Bound::AtLeast,
        formula: "the smallest radius of curvature of the profile where it is concave",
        usual: "the cutter of the shop, `limits.cutter_radius` or --cutter",
        change: "a smaller cutter, or a larger roller: the concave profile has its radius plus that of the pitch curve",
    },
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
