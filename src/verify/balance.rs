//! The static unbalance that the holes of a disc leave.

use super::{Check, Evidence, On};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "balance",
    on: On::Cam,
    about: "The static unbalance of a disc that the holes within cam.balance leave.",
    run: check,
};

/// What may be left, over what was there: holes are placed exactly, so only rounding.
const LEFT_OVER: f64 = 1e-9;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let balancing = evidence.drawn?.parts.first()?.balancing.as_ref()?;
    let machine = evidence.body.machine();
    // Grams times millimetres of a disc of this thickness, or of one as thick as a millimetre.
    let thickness = machine.cam.thickness.unwrap_or(1e-3);
    let weight = 1e-3 * machine.cam.density() * thickness;
    let (before, after) = (weight * balancing.before, weight * balancing.after);
    let limit = LEFT_OVER * before;
    let kept = after <= limit;
    let note = match balancing.holes.first() {
        Some((_, radius)) => {
            format!("{} holes of radius {radius:.4} mm cancel {before:.0} g·mm", balancing.holes.len())
        }
        None if kept => "nothing to balance".into(),
        None => "no holes in the band of cam.balance cancel it; widen the band".into(),
    };
    Some(Finding { note: Some(note), ..CHECK.found(after, Some(limit), "g·mm", Verdict::of(kept)) })
}
