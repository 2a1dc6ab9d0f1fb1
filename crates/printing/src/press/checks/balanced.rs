//! The checks of every disc that balances the inertia force of the bed by the air, and the lift that its run-up adds.

use super::{air, column, residual};
use crate::press::load::{ForceBalanced, RunUp};
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Measures, Subject};
use camgen_cams::report::{Bound, Verdict};
use camgen_kernel::text::{KeyChange, Remedy, text};

/// The lift that a run-up adds: it grows with the square of the speed.
pub const RUN_UP: Check = Check {
    name: "run_up",
    on: CheckScope::Cam,
    unit: "mm",
    about: "How far the run-up moves the bottom before the reversal begins. It grows with the square of the speed and of the \
            width; beyond the stroke of the bed the cam is larger than the machine it is for.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "the travel of the bottom in the transition, against the stroke 2r of the bed",
        usual: "camgen's own rule: the stroke of the bed",
        change: "a narrower `transition.width`, `buffer.column = \"matched\"`, or a smaller `buffer.lead`",
    },
};

/// Widths are reported in tenths of a degree, or with two digits where they are smaller.
fn in_degrees(width: f64) -> f64 {
    let degrees = width.to_degrees();
    let digits = if degrees >= 1.0 { 10.0 } else { libm::pow(10.0, 1.0 - libm::log10(degrees).floor()) };
    (degrees * digits).floor() / digits
}

/// The measure of [`RUN_UP`].
fn run_up_lift(run_up: &RunUp) -> Measure {
    let beyond = run_up.travel > run_up.stroke;
    let note = beyond.then(|| {
        let change = KeyChange::new("transition.width", format!("{} deg", in_degrees(run_up.width)));
        text!("run-up lift exceeds the stroke; {} would not", Remedy::new([change]))
    });
    let verdict = if beyond { Verdict::Warn } else { Verdict::Pass };
    RUN_UP.measure(1e3 * run_up.travel, Some(1e3 * run_up.stroke)).judged(verdict).noted(note)
}

/// The measures of every disc that balances the inertia force of the bed by the air.
pub(in crate::press) fn of_balance(balanced: &dyn ForceBalanced, of: &mut Measures<'_>, subject: &Subject<'_>) {
    of.add(&residual::CHECK, |written| residual::measure(balanced, written, subject));
    of.add(&air::AIR, |_| balanced.least_air().map(|least| air::least_length(&least, subject)));
    of.add(&column::CHECK, |_| {
        column::measure(&balanced.columns(), subject.machine, |press, rpm| Some(press.rotary_law(rpm).ok()?.column()))
    });
    of.add(&RUN_UP, |_| balanced.run_up().map(|run_up| run_up_lift(&run_up)));
}
