//! The residual force of a cam for many speeds at the speeds between its sections.

use super::{Bound, Check, Evidence, Explained, On};
use crate::body::conoid::between;
use crate::motion::Transition;
use crate::report::{Finding, Place, Verdict, shown};

pub(super) const CHECK: Check = Check {
    name: "between_sections",
    on: On::Cam,
    about: "The largest residual force, inertia less air, at any speed between the sections of a conoid.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max |inertia − air| over the speeds between the sections",
        usual: "--residual, or what straight strips between the sections leave",
        change: "more speeds in --rpm, or `--rpm A..B --residual FORCE`, which chooses them",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let conoid = evidence.body.spatial()?;
    let (left, limit) = (conoid.left_between(), conoid.residual_limit());
    let worse = conoid.is_worse_than_strips();
    let verdict = match limit {
        Some(limit) => Verdict::of(left.force <= limit),
        None if worse => Verdict::Warn,
        None => Verdict::Info,
    };
    let mut note = format!("at {:.3} rpm, of {} sections", left.rpm, conoid.section_count());
    if worse {
        note += &format!("; straight strips would leave {} N", shown(conoid.left_by_strips().force));
    }
    if matches!(verdict, Verdict::Fail | Verdict::Warn) {
        let wanted = limit.unwrap_or(conoid.left_by_strips().force);
        note += &if let Some(speeds) = conoid.speeds_within(wanted) {
            let list: Vec<String> = speeds.iter().map(f64::to_string).collect();
            format!("; --rpm {} would leave no more than {} N", list.join(","), shown(wanted))
        } else {
            let most = between::MOST_SECTIONS;
            let blend = matches!(evidence.body.machine().transition, Transition::Blend { .. });
            let why = if blend { ": the blend itself leaves force, a run-up leaves none" } else { "" };
            format!("; no {most} sections evenly spaced in speed leave as little as {} N{why}", shown(wanted))
        };
    }
    let found = CHECK.found(left.force, limit, "N", verdict);
    Some(Finding { place: Place::at_angle(left.angle), note: Some(note), ..found })
}
