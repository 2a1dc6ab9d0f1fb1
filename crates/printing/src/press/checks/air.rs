//! The air between piston and bottom.

use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::report::Bound;
use camgen_kernel::profile::Worst;

/// The check.
pub const CHECK: Check = Check {
    name: "air",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The least length of the air column between piston and bottom while the bottom moves. Where it is not above 0 the \
            bottom hits the piston.",
    explained: CheckExplanation {
        bound: Bound::Above,
        formula: "L (1 + A x)^(−1/k) where the forces balance; minus the error of the bottom towards the piston",
        usual: "above 0",
        change: "a lower `buffer.end_pressure`, or a longer `buffer.column`",
    },
};

/// Measure of the least length of the air, m.
#[must_use]
pub fn measure(least: &Worst, subject: &Subject<'_>) -> Measure {
    let kept = least.value > 0.0;
    let note = (!kept).then(|| "the bottom hits the piston".to_owned());
    CHECK.measure(1e3 * least.value, Some(0.0)).kept(kept).noted(note).at(subject, least)
}
