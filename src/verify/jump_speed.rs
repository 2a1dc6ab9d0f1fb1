//! Whether the cam runs slower than the speed at which its follower leaves it.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::report::{Finding, Verdict, shown};
use std::f64::consts::TAU;

pub(super) const CHECK: Check = Check {
    name: "jump_speed",
    on: On::Cam,
    about: "The speed of the cam at which the follower first leaves it: where inertia takes away all that presses it on.",
    explained: Explained {
        bound: Bound::AtLeast,
        formula: "ω² = min (k s + F0 + load)/(−m s'') where s'' is negative, by the cam angle; with damping the first speed at which the \
                  least force is 0",
        usual: "the speed of the cam, times `limits.jump_margin`",
        change: "a higher `spring.preload`, a stiffer `spring.rate`, less mass, or a slower cam",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let jump = match body.jump_speed()? {
        Ok(jump) => jump,
        Err(why) => return Some(CHECK.not_run("rpm", &why)),
    };
    let rpm = |speed: f64| 60.0 * speed / TAU;
    let margin = body.machine().limits.jump_margin;
    let limit = body.shaft_speed().map(|speed| margin * rpm(speed));
    let kept = limit.is_none_or(|limit| rpm(jump.value) >= limit);
    let verdict = limit.map_or(Verdict::Info, |_| Verdict::of(kept));
    let note = match (body.shaft_speed(), kept) {
        (_, false) => {
            let held = body.preload_that_holds(margin);
            held.map(|key| format!("{key} would hold it at {} rpm", shown(limit.unwrap_or(f64::NAN))))
        }
        (Some(speed), true) if jump.value.is_finite() => Some(format!("{} times its speed", shown(jump.value / speed))),
        (Some(_), true) => Some("the follower leaves the cam at no speed".into()),
        (None, true) => Some("without motion.rpm or --rpm there is no limit".into()),
    };
    Some(at(body, &jump, CHECK.found(rpm(jump.value), limit, "rpm", verdict), note))
}
