//! What neither cam nor screw can cure: the force that differs between the ways in and back.

use crate::press::load::USEFUL;
use camgen_cams::check::{Check, CheckExplanation, Measure};
use camgen_cams::report::{Bound, Verdict, shown};

/// The check.
pub const CHECK: Check = Check::on_analysis(
    "half_loop",
    "1",
    "Half of the largest difference of the residual forces on the ways in and back, over what a buffer with a fixed bottom leaves with the same losses: expansion of the air, leak \
     and friction leave it whatever the cam is.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |r_back − r_in|/2 at the same overrun, over the largest residual force of a fixed bottom with the same losses",
        usual: "camgen's own rule: below 1; it warns above ½",
        change: "less leak or friction (`buffer.leak`, `buffer.piston_friction`, `bed.friction`); against the loop of the expansion a smaller bore: a higher `buffer.end_pressure`",
    },
);

/// The measure of the largest h and of what a fixed bottom leaves in the same losses, N.
#[must_use]
pub fn measure(half_loop: f64, fixed: f64) -> Measure {
    let share = half_loop.abs() / fixed;
    let verdict = match share {
        share if !(share < 1.0) => Verdict::Fail,
        share if share > USEFUL => Verdict::Warn,
        _ => Verdict::Pass,
    };
    let note = format!(
        "half of the loop is {} N, a fixed bottom with the same losses leaves {} N",
        shown(half_loop.abs()),
        shown(fixed)
    );
    CHECK.measure(share, Some(1.0)).judged(verdict).noted(note)
}
