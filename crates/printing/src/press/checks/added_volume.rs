//! Whether the volume of equation (15) can be added.

use camgen_cams::check::{Check, CheckExplanation};
use camgen_cams::report::Bound;

/// The check.
pub const CHECK: Check = Check::on_analysis(
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
