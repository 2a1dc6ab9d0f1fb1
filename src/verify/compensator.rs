//! The second disc of a press, which takes the torque of the first: its own checks, and the torque that both leave as cut.

use super::{Bound, Check, Evidence, Explained, On, WrittenOutline};
use crate::body::Body;
use crate::profile::followed::Followed;
use crate::report::{Finding, Verdict, failed};

/// The check.
pub(super) const CHECK: Check = Check {
    name: "compensator",
    on: On::Cam,
    about: "How many checks the compensating cam fails: it is cut with the cam, on the same shaft, and judged by the same list.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "the failed checks in `compensator.checks` of the report",
        usual: "0",
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

fn followed<'a>((body, outline): (&'a dyn Body, &WrittenOutline)) -> Option<Followed<'a>> {
    Some(Followed::on(body.plane()?, &outline.contour, body.mirrored()))
}

/// Places of a stretch of an outline at which the torque is looked at.
const PLACES: u32 = 8;

/// Largest torque that two discs on one shaft leave together with their followers on the outlines as written, N·m: each force
/// along its follower's path times the slope that the normal where it touches gives. `None` where a force is not known or a
/// follower is not in touch.
#[must_use]
pub fn torque_as_cut(discs: [(&dyn Body, &WrittenOutline); 2]) -> Option<f64> {
    let [first, second] = discs;
    let (one, two) = (followed(first)?, followed(second)?);
    let torque = |body: &dyn Body, followed: &Followed<'_>, angle: f64| {
        let [force, _] = body.force_and_torque(angle)?;
        Some(force * followed.at(angle)?.ds)
    };
    let mut largest: Option<f64> = None;
    for (from, to) in one.ranges().chain(two.ranges()) {
        for place in 0..=PLACES {
            let angle = from + (to - from) * f64::from(place) / f64::from(PLACES);
            let both = torque(first.0, &one, angle)? + torque(second.0, &two, angle)?;
            largest = Some(largest.unwrap_or(0.0).max(both.abs()));
        }
    }
    largest
}
