//! Whether the follower stays on the cam: load, preload and the inertia of the follower, all round.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, Verdict};
use camgen_kernel::follower::Element;
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{KeyChange, Remedy, Text, text};

/// The check.
pub const CHECK: Check = Check {
    name: "force_closure",
    on: CheckScope::Cam,
    unit: "N",
    about: "The least force that presses the follower onto the cam: air or spring, preload and inertia together. Where it is not \
            above 0 the follower leaves the cam.",
    explained: CheckExplanation {
        bound: Bound::Above,
        formula: "F = air or spring + preload + c s' + m s'', along the follower's path, s' and s'' by time; for a swinging follower \
                  the moment J ψ'' + c ψ' + k ψ + M0 over its arm, which is that of the roller's centre, or of a face the distance of the contact from \
                  the pivot",
        usual: "above 0",
        change: "a higher `follower.*.preload` or `spring.preload`, a lower `follower.*.mass` or `inertia`, or a slower cam",
    },
};

/// The note on forces without a speed.
pub(super) const WITHOUT_INERTIA: &str = "at rest: without motion.rpm or --rpm the inertia of the follower is left out";

/// Measure of the least force along the follower's path, N, `None` where no force is known; with the preload, as a key of the machine file, that
/// holds the follower.
#[must_use]
pub fn measure(least: Option<Worst>, holding: impl FnOnce() -> Option<KeyChange>, subject: &Subject<'_>) -> Measure {
    let Some(least) = least else { return CHECK.unknown(&missing(subject)) };
    let (force, follower) = (least.value, &subject.machine.follower);
    let kept = force > 0.0;
    let own = || {
        let needed = (follower.preload.unwrap_or(0.0) - force).ceil() + 1.0;
        KeyChange::new(format!("{}.preload", follower.path), format!("{needed} N"))
    };
    let part = match subject.curves.map(|curves| curves.element()) {
        Some(Element::Face) => "face",
        Some(Element::Roller { radius: 0.0 }) => "edge",
        _ => "roller",
    };
    let note = (!kept).then(|| {
        let remedy = Remedy::new([holding().unwrap_or_else(own)]);
        text!("the {} leaves the cam", part).and("; ", text!("{} would hold it", remedy))
    });
    let without_inertia = kept && subject.lacks_inertia();
    let note = note.or_else(|| without_inertia.then(|| Text::from(WITHOUT_INERTIA)));
    let verdict = if without_inertia { Verdict::Info } else { Verdict::of(kept) };
    CHECK.measure(force, Some(0.0)).judged(verdict).noted(note).at(subject, &least)
}

/// What is not given.
fn missing(subject: &Subject<'_>) -> String {
    let path = subject.machine.follower.path;
    let swings = subject.curves.is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
    match (swings, subject.curves.is_some_and(|curves| curves.motion.program().is_some())) {
        (true, _) => "neither the table [spring] nor an inertia of the follower with a speed is given".to_owned(),
        (false, true) => format!("neither {path}.preload, [spring], nor {path}.mass with a speed is given"),
        (false, false) => format!("neither {path}.mass nor {path}.preload is given"),
    }
}
