//! Pressure in the contact of roller and cam, after Hertz.

use super::{Check, Evidence, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "contact_stress",
    on: On::Cam,
    about: "The largest pressure between roller and cam after Hertz: in a line under a straight roller, in an ellipse under the \
            sphere of a three-dimensional cam.",
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let Some(worst) = body.contact_stress() else {
        let cam = &body.machine().cam;
        let needs = match (body.spatial().is_some(), cam.thickness.is_some(), cam.material.is_some()) {
            (true, ..) | (false, true, false) => "cam.material is not given",
            (false, false, true) => "cam.thickness is not given",
            (false, false, false) => "cam.thickness and cam.material are not both given",
            (false, true, true) => "no force on the follower is known",
        };
        return Some(CHECK.not_run("MPa", needs));
    };
    let stress = 1e-6 * worst.value;
    let limit = body.machine().limits.contact_stress.map(|limit| 1e-6 * limit);
    let verdict = limit.map_or(Verdict::Info, |limit| Verdict::of(stress <= limit));
    Some(at(body, &worst, CHECK.found(stress, limit, "MPa", verdict), None))
}
