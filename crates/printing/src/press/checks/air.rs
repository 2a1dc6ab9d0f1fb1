//! The air in the cylinders: its least length, the volume that a slower speed needs, and the energy that it takes from the bed.

use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::report::Bound;
use camgen_kernel::profile::Worst;

/// The air between piston and bottom.
pub const AIR: Check = Check {
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

/// Whether the volume of equation (15) can be added.
pub const ADDED_VOLUME: Check = Check::on_analysis(
    "added_volume",
    "mm3",
    "The total volume added to all cylinders at one end for a slower speed; none can be removed for a faster one.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "V = (L_p − L) 2F, equation (15); the least over the speeds",
        usual: "0: the cylinders are open to the air before the reversal",
        change: "the screw of the bottom: the column of (14) for that speed; or cut the cam for the fastest speed",
    },
);

/// Whether a bed that is braked by plain buffers alone arrives at the end of its stroke at rest.
pub const CLOSING: Check = Check::on_analysis(
    "closing",
    "m/s",
    "The speed that the bed has left where its stroke ends, or, where it stops early, the speed that it lacks: the buffers take more or less than \
        the energy of the bed.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "v0 √|1 − W(x_e)/(½ m v0²)|, W the work of the air over the stroke x_e = r (1 + φ_в)",
        usual: "camgen's own rule: 0.05 m/s, half of the 0.1 m/s with which cushioned cylinders arrive",
        change: "leave out `drive.bore`: the bore is then the one with which the machine closes; or the `buffer.column` or `buffer.ambient_pressure` of the \
                 message",
    },
);

/// Largest speed that the bed may have left, m/s.
pub const ARRIVAL: f64 = 0.05;

/// The measure of [`AIR`]: its least length, m.
#[must_use]
pub fn least_length(least: &Worst, subject: &Subject<'_>) -> Measure {
    let kept = least.value > 0.0;
    let note = (!kept).then(|| "the bottom hits the piston".to_owned());
    AIR.measure(1e3 * least.value, Some(0.0)).kept(kept).noted(note).at(subject, least)
}
