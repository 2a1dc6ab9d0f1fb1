//! The size of the part: what can be cut and built in.

use super::{AsWritten, Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, Topic};
use camgen_kernel::text::{Length, text};

/// The check.
pub const CHECK: Check = Check {
    name: "size",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The largest length or width of the cam. A cam of metres is mostly an input in another unit, or a motion that asks for too much.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "the longer side of the upright rectangle about the outline as written; of a groove or a ring the diameter of its blank",
        usual: "2 m: what the machine tools of a shop take; `limits.size` where it is given",
        change: "the motion: a lower lift, a longer rise or a smoother law; in a press a shorter column or run-up; or `limits.size` for a cam that is meant to be so large",
    },
};

/// Measure of the size of what is written, with a blank of a width (mm; 0 without one) about it; `None` where nothing is.
#[must_use]
pub fn measure(written: &AsWritten<'_>, blank: f64, subject: &Subject<'_>) -> Option<Measure> {
    let limits = subject.machine.limits;
    let limit = 1e3 * limits.largest_size();
    let note = limits.size.is_none().then_some("the customary limit");
    let largest = written.size_mm?.max(blank);
    let measure = CHECK.measure(largest, Some(limit)).noted(note);
    Some(measure.with_fact(Topic::SIZE, text!("largest {}", Length::mm(largest).nominal())))
}
