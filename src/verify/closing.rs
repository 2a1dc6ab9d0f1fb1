//! Whether a bed that is braked by plain buffers alone arrives at the end of its stroke at rest.

use super::{Check, Explained};
use crate::analysis::drive::CLOSING_CHECK;
use crate::report::Bound;

/// The check.
pub(super) const CHECK: Check = Check::on_analysis(
    CLOSING_CHECK,
    "By how much the work of the buffers over the stroke misses the energy of the bed, as a share of it. Where it does, the bed \
     stops early or arrives with speed left, and there is no speed of the crank that carries nothing.",
    Explained {
        bound: Bound::AtMost,
        formula: "|W(x_e)/(½ m v0²) − 1|, W the work of the air over the stroke x_e = r (1 + φ_в)",
        usual: "1e-9: exact but for rounding",
        change: "leave out `drive.bore`, which then is the one that closes; or the `buffer.column` or `buffer.ambient_pressure` of the \
                 message",
    },
);
