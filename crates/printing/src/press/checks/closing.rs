//! Whether a bed that is braked by plain buffers alone arrives at the end of its stroke at rest.

use camgen_cams::check::{Check, CheckExplanation};
use camgen_cams::report::Bound;

/// The check.
pub const CHECK: Check = Check::on_analysis(
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
