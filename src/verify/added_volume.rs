//! Whether the volume of equation (15) can be added.

use super::{Check, Explained};
use crate::analysis::regimes::ADDED_VOLUME;
use crate::report::Bound;

/// The check.
pub(super) const CHECK: Check = Check::on_analysis(
    ADDED_VOLUME,
    "The volume that is added to the cylinders for a slower speed; none can be taken away for a faster one.",
    Explained {
        bound: Bound::AtLeast,
        formula: "V = (L_p − L) 2F, equation (15); the least over the speeds",
        usual: "0: the cylinders are open to the air before the reversal",
        change: "the screw of the bottom: the column of (14) for that speed; or cut the cam for the fastest speed",
    },
);
