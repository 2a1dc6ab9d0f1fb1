//! The air between piston and bottom.

use super::{Check, Evidence, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "air",
    on: On::Cam,
    about: "The least length of the air column between piston and bottom while the bottom moves. Where it is not above 0 the \
            bottom hits the piston.",
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let least = evidence.body.least_air()?;
    let kept = least.value > 0.0;
    let note = (!kept).then(|| "the bottom hits the piston".to_owned());
    Some(at(evidence.body, &least, CHECK.found(1e3 * least.value, Some(0.0), "mm", Verdict::of(kept)), note))
}
