//! Whether a cam is worth its steel in presses that scatter.

use crate::press::load::USEFUL;
use crate::press::scatter::tables::{CAM, FIXED, PercentileRow};
use camgen_cams::check::{Check, CheckExplanation, Measure};
use camgen_cams::report::{Bound, Verdict, shown};

/// The check.
pub const CHECK: Check = Check::on_analysis(
    "scatter",
    "1",
    "What 95 % of all presses stay below after the reset of their screws, over what 95 % of presses with a fixed bottom stay below: what the cam \
     has to beat.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "P95 of the largest residual force of the cam over that of a fixed bottom in the same draws",
        usual: "camgen's own rule: below 1; it warns above ½",
        change: "narrower bands of what is largest in the list (`[scatter]`, --vary), a reset of the screw (--reset end), or no cam",
    },
);

/// The measure of percentiles.
#[must_use]
pub fn measure(percentiles: &[PercentileRow]) -> Measure {
    let [cam, fixed] =
        [CAM, FIXED].map(|body| percentiles.iter().rev().find(|row| row.body == body && row.percentile == 95.0));
    let (Some(cam), Some(fixed)) = (cam, fixed) else {
        return CHECK.unknown("no presses are drawn (--samples 0), or too few: P95 needs 20");
    };
    let share = cam.residual_n / fixed.residual_n;
    let verdict = match share {
        share if !(share < 1.0) => Verdict::Fail,
        share if share > USEFUL => Verdict::Warn,
        _ => Verdict::Pass,
    };
    let note = format!("P95 is {} N, that of a fixed bottom {} N", shown(cam.residual_n), shown(fixed.residual_n));
    CHECK.measure(share, Some(1.0)).judged(verdict).noted(note)
}
