//! Whether the follower stays on the cam: load, preload and the inertia of the follower, all round.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::follower::Element;
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "force_closure",
    on: On::Cam,
    about: "The least force that presses the follower onto the cam: air or spring, preload and inertia together. Where it is not \
            above 0 the follower leaves the cam.",
    explained: Explained {
        bound: Bound::Above,
        formula: "F = air or spring + preload + m s'', along the follower's path; s'' by the time",
        usual: "above 0",
        change: "a higher `follower.*.preload`, a lower `follower.*.mass`, or a slower cam",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let Some(least) = body.least_closing_force() else {
        let follower = &body.machine().follower;
        let why = if follower.has_forces() {
            format!("neither {0}.mass nor {0}.preload is given", follower.path)
        } else {
            "forces on this follower are not computed".into()
        };
        return Some(CHECK.not_run("N", &why));
    };
    let force = least.value;
    let kept = force > 0.0;
    let needed = (body.machine().follower.preload.unwrap_or(0.0) - force).ceil() + 1.0;
    let path = body.machine().follower.path;
    let is_face = body.plane().is_some_and(|curves| curves.element() == Element::Face);
    let part = match (body.roller_radius(), is_face) {
        (Some(_), _) => "roller",
        (None, true) => "face",
        (None, false) => "edge",
    };
    let note = (!kept).then(|| format!("the {part} leaves the cam; {path}.preload = \"{needed} N\" would hold it"));
    Some(at(body, &least, CHECK.found(force, Some(0.0), "N", Verdict::of(kept)), note))
}
