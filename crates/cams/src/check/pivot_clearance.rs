//! Whether the pivot of a swinging follower lies outside of the circle that the cam sweeps over.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, Verdict};
use camgen_kernel::follower::Carrier;
use camgen_kernel::profile::{Worst, extremes};

/// The check.
pub const CHECK: Check = Check {
    name: "pivot_clearance",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The distance from the pivot of a swinging follower to the circle that the turning cam sweeps over. Where it is not above 0 the cam passes over \
            the pivot, and the arm with its bearing must lie outside the plane of the cam. Reported where that is so, or where limits.pivot_clearance is given.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "the distance of the pivot from the shaft less the largest radius of the profile",
        usual: "the radius of the bearing with its housing, `limits.pivot_clearance`",
        change: "a larger `follower.*.pivot_distance` with its arm, a smaller `cam.base_radius`, or an arm outside the plane of the cam",
    },
};

/// Measure of a swinging follower; `None` of others, and where there is no limit and the pivot lies outside.
#[must_use]
pub fn measure(subject: &Subject<'_>) -> Option<Measure> {
    let curves = subject.curves?;
    let Carrier::Arm { pivot } = curves.follower.carrier() else { return None };
    let limit = subject.machine.limits.pivot_clearance;
    let radius = |piece: usize, at: f64| curves.profile(piece, at).point.norm();
    let farthest = extremes::largest_smooth(curves, (&[], 0.0), radius);
    let clearance = pivot.norm() - farthest.value;
    let inside = clearance <= 0.0;
    let kept = limit.is_none_or(|limit| clearance >= limit);
    if limit.is_none() && !inside {
        return None;
    }
    let verdict = if kept && inside { Verdict::Warn } else { Verdict::of(kept) };
    let words = "the cam sweeps over the pivot: the arm and its bearing must lie outside the plane of the cam";
    let measure = CHECK.measure(1e3 * clearance, limit.map(|limit| 1e3 * limit)).judged(verdict);
    let measure = measure.noted(inside.then_some(words));
    Some(measure.at(subject, &Worst { value: farthest.value, at: farthest.at, z: 0.0 }))
}
