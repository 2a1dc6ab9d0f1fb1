//! What a cam leaves in a press that loses, against a fixed bottom in the same press.

use crate::press::load::USEFUL;
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure};
use camgen_cams::report::{Bound, Verdict, shown};

/// The check.
pub const CHECK: Check = Check {
    name: "losses",
    on: CheckScope::Cam,
    unit: "1",
    about: "What is left with the losses of the machine file, in the worse direction of the bed, over what a fixed bottom leaves with the same losses.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |r| of both ways with expansion, leak, friction, train and play, over that of a fixed bottom with its column by (7) and no train",
        usual: "camgen's own rule: below 1, from where on a press without a cam is better; it warns above ½",
        change: "a stiffer `cam.train_stiffness` or `cam.compensate_train = true`, less `cam.play`, `buffer.balance = \"level\"` against the expansion, less leak or friction",
    },
};

/// The measure of the largest force with the cam and with fixed bottoms, N.
#[must_use]
pub fn measure(cam: f64, fixed: f64) -> Measure {
    let share = cam / fixed;
    let verdict = match share {
        share if !(share < 1.0) => Verdict::Fail,
        share if share > USEFUL => Verdict::Warn,
        _ => Verdict::Pass,
    };
    let note = format!("{} N are left, {} N with a fixed bottom", shown(cam), shown(fixed));
    CHECK.measure(share, Some(1.0)).judged(verdict).noted(note)
}
