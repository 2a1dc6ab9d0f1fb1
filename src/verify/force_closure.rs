//! Whether the follower stays on the cam: load, preload and the inertia of the follower, all round.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::follower::Element;
use crate::motion::Quantity;
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "force_closure",
    on: On::Cam,
    about: "The least force that presses the follower onto the cam: air or spring, preload and inertia together. Where it is not \
            above 0 the follower leaves the cam.",
    explained: Explained {
        bound: Bound::Above,
        formula: "F = air or spring + preload + c s' + m s'', along the follower's path, s' and s'' by the time; of a follower that swings \
                  the moment J ψ'' + c ψ' + k ψ + M0 over the distance of its contact from the pivot",
        usual: "above 0",
        change: "a higher `follower.*.preload` or `spring.preload`, a lower `follower.*.mass` or `inertia`, or a slower cam",
    },
    run: check,
};

/// What is told of forces without a speed.
pub(super) const WITHOUT_INERTIA: &str = "at rest: without motion.rpm or --rpm the inertia of the follower is left out";

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let Some(least) = body.least_closing_force() else {
        let follower = &body.machine().follower;
        let swings = body.plane().is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
        let why = match (swings, body.plane().is_some_and(|curves| curves.motion.program().is_some())) {
            (true, _) => "neither the table [spring] nor an inertia of the follower with a speed is given".to_owned(),
            (false, true) => {
                format!("neither {0}.preload, [spring], nor {0}.mass with a speed is given", follower.path)
            }
            (false, false) => format!("neither {0}.mass nor {0}.preload is given", follower.path),
        };
        return Some(CHECK.not_run("N", &why));
    };
    let force = least.value;
    let kept = force > 0.0;
    let own = || {
        let follower = &body.machine().follower;
        let needed = (follower.preload.unwrap_or(0.0) - force).ceil() + 1.0;
        format!("{}.preload = \"{needed} N\"", follower.path)
    };
    let is_face = body.plane().is_some_and(|curves| curves.element() == Element::Face);
    let part = match (body.roller_radius(), is_face) {
        (Some(_), _) => "roller",
        (None, true) => "face",
        (None, false) => "edge",
    };
    let holding = || body.preload_that_holds(1.0).unwrap_or_else(own);
    let note = (!kept).then(|| format!("the {part} leaves the cam; {} would hold it", holding()));
    let standing = kept && body.lacks_inertia();
    let note = note.or_else(|| standing.then(|| WITHOUT_INERTIA.into()));
    let verdict = if standing { Verdict::Info } else { Verdict::of(kept) };
    Some(at(body, &least, CHECK.found(force, Some(0.0), "N", verdict), note))
}
