//! The air between piston and bottom.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "air",
    on: On::Cam,
    about: "The least length of the air column between piston and bottom while the bottom moves. Where it is not above 0 the \
            bottom hits the piston.",
    explained: Explained {
        bound: Bound::Above,
        formula: "L (1 + A x)^(−1/k) where the forces balance; less by how far the bottom is from its law, towards the piston",
        usual: "above 0",
        change: "a lower `buffer.end_pressure`, or a longer `buffer.column`",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let least = evidence.body.least_air()?;
    let kept = least.value > 0.0;
    let note = (!kept).then(|| "the bottom hits the piston".to_owned());
    Some(at(evidence.body, &least, CHECK.found(1e3 * least.value, Some(0.0), "mm", Verdict::of(kept)), note))
}
