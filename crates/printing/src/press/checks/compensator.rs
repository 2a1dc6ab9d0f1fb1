//! The second disc of a press, which takes the torque of the first: its own checks.

use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure};
use camgen_cams::report::{Bound, Finding, failed};

/// The check.
pub const CHECK: Check = Check {
    name: "compensator",
    on: CheckScope::Cam,
    unit: "1",
    about: "How many checks the compensating cam fails: it is cut with the cam, on the same shaft, and judged by the same list.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "the failed checks in `compensator.checks` of the report",
        usual: "0: both discs are cut, or neither",
        change: "the change that each of them names; mostly `compensator.preload`, `compensator.spring_rate` or `compensator.base_radius`",
    },
};

/// The measure of the checks of the compensating cam.
#[must_use]
pub fn measure(findings: &[Finding]) -> Measure {
    let broken = failed(findings);
    #[expect(clippy::cast_precision_loss, reason = "a few checks")]
    let count = broken.len() as f64;
    let note = (!broken.is_empty()).then(|| format!("of the compensating cam: {}", broken.join(", ")));
    CHECK.measure(count, Some(0.0)).noted(note)
}
