//! The largest tool that can cut the concave parts.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::profile::Worst;
use crate::report::{Bound, Verdict};

/// The check.
pub const CHECK: Check = Check {
    name: "cutter_radius",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The radius of the largest cutter that fits into the concave parts of the profile.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "the smallest radius of curvature of the profile where it is concave",
        usual: "the cutter of the shop, `limits.cutter_radius` or `cutter_diameter`, or --cutter-diameter",
        change: "a smaller cutter, or a larger roller: the concave profile has its radius plus that of the pitch curve",
    },
};

/// Measure of the largest cutter that fits, m; `None` where nothing is concave.
#[must_use]
pub fn measure(largest: Option<Worst>, subject: &Subject<'_>) -> Measure {
    let limit = subject.machine.limits.cutter_radius;
    let radius = largest.map_or(f64::INFINITY, |largest| largest.value);
    let kept = limit.is_none_or(|limit| limit <= radius);
    let verdict = limit.map_or(Verdict::Info, |_| Verdict::of(kept));
    let measure = CHECK.measure(1e3 * radius, limit.map(|limit| 1e3 * limit)).judged(verdict);
    match largest {
        Some(largest) => measure.noted(if kept { None } else { (subject.remedy)() }).at(subject, &largest),
        None => measure.noted("nothing is concave".to_owned()),
    }
}
