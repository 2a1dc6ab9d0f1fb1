//! The residual force of a cam for many speeds at the speeds between its sections.

use super::{Conoid, between};
use crate::press::MachineOfPress;
use crate::press::motion::Transition;
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure};
use camgen_cams::report::{Bound, Place, Verdict, shown};

/// The check.
pub const CHECK: Check = Check {
    name: "between_sections",
    on: CheckScope::Cam,
    unit: "N",
    about: "The largest residual force, inertia less air, at any speed between the sections of a conoid.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |inertia − air| over the speeds between the sections",
        usual: "--residual, or what straight strips between the sections leave",
        change: "more speeds in --rpm, or `--rpm A..B --residual FORCE`, which chooses them",
    },
};

/// Measure of the largest residual force between two sections.
pub(super) fn measure(conoid: &Conoid) -> Measure {
    let (left, limit) = (conoid.residual_between(), conoid.residual_limit());
    let worse = conoid.is_worse_than_strips();
    let verdict = match limit {
        Some(limit) => Verdict::of(left.force <= limit),
        None if worse => Verdict::Warn,
        None => Verdict::Info,
    };
    let mut note = format!("at {:.3} rpm, of {} sections", left.rpm, conoid.section_count());
    if worse {
        note += &format!("; straight strips would leave {} N", shown(conoid.residual_of_strips().force));
    }
    if matches!(verdict, Verdict::Fail | Verdict::Warn) {
        let wanted = limit.unwrap_or(conoid.residual_of_strips().force);
        note += &if let Some(speeds) = conoid.speeds_within(wanted) {
            let list: Vec<String> = speeds.iter().map(f64::to_string).collect();
            format!("; --rpm {} would leave no more than {} N", list.join(","), shown(wanted))
        } else {
            let most = between::MOST_SECTIONS;
            let blend = matches!(conoid.machine.transition(), Transition::Blend { .. });
            let why = if blend { ": the blend itself leaves a residual force, a run-up leaves none" } else { "" };
            format!("; no {most} sections evenly spaced in speed leave as little as {} N{why}", shown(wanted))
        };
    }
    CHECK.measure(left.force, limit).judged(verdict).noted(note).placed(Place::at_angle(left.angle))
}
