//! The second disc of a press, which takes the torque of the first: its own checks.

use super::{Bound, Check, Evidence, Explained, On};
use crate::report::{Finding, Verdict, failed};

/// The check.
pub(super) const CHECK: Check = Check {
    name: "compensator",
    on: On::Cam,
    about: "How many checks the compensating cam fails: it is cut with the cam, on the same shaft, and judged by the same list.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "the failed checks in `compensator.checks` of the report",
        usual: "0: both discs are cut, or none",
        change: "what each of them says; mostly `compensator.preload`, `compensator.spring_rate` or `compensator.base_radius`",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let checks = evidence.compensator?;
    let broken = failed(checks);
    #[expect(clippy::cast_precision_loss, reason = "a few checks")]
    let count = broken.len() as f64;
    let note = (!broken.is_empty()).then(|| format!("of the compensating cam: {}", broken.join(", ")));
    Some(Finding { note, ..CHECK.found(count, Some(0.0), "1", Verdict::of(broken.is_empty())) })
}
