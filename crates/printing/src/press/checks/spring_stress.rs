//! Whether a spring under a bottom withstands its force.

use camgen_cams::check::{Check, CheckExplanation};
use camgen_cams::report::Bound;

/// The check.
pub const CHECK: Check = Check::on_analysis(
    "spring_stress",
    "MPa",
    "The largest shear stress in the wire of the springs under the bottoms, at the end of the stroke.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "8 F D K/(π d³), K = (4i − 1)/(4i − 4) + 0.615/i (Wahl), i = D/d, F = P_max/2",
        usual: "`spring_buffer.body.stress`: the allowable stress of the wire is an input",
        change: "a thicker `spring_buffer.body.wire`, a smaller `spring_buffer.body.coil`, or leave both out: `spring_buffer.body.index` finds the wire",
    },
);
