//! The largest tool that can cut the concave parts.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, Verdict};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Length, Text, text};

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

/// A cutter as wide as a groove fits; its radius was typed.
const ROUNDING: f64 = 1e-12;

/// Measure of the largest cutter that fits, m; `None` where nothing is concave. Of a groove with half its width, m, which no larger cam changes.
#[must_use]
pub fn measure(largest: Option<Worst>, half_width: Option<f64>, subject: &Subject<'_>) -> Measure {
    let limit = subject.machine.limits.cutter_radius;
    let radius = largest.map_or(f64::INFINITY, |largest| largest.value);
    let within = |radius: f64| limit.is_none_or(|limit| limit <= radius * (1.0 + ROUNDING));
    let kept = within(radius);
    let remedy = || match half_width.filter(|half| !within(*half)) {
        Some(half) => Some(text!("the groove is {} wide: no wider cutter fits into it", Length::mm(2e3 * half))),
        None => (subject.remedy)(),
    };
    let verdict = limit.map_or(Verdict::Info, |_| Verdict::of(kept));
    let measure = CHECK.measure(1e3 * radius, limit.map(|limit| 1e3 * limit)).judged(verdict);
    match largest {
        Some(largest) => measure.noted(if kept { None } else { remedy() }).at(subject, &largest),
        None => measure.noted(Text::from("nothing is concave")),
    }
}
