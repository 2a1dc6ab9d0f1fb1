//! Whether the cam runs slower than the speed at which its follower leaves it.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, Topic, Verdict, shown};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{KeyChange, Remedy, Text, Value, text};
use camgen_kernel::units;

/// The check.
pub const CHECK: Check = Check {
    name: "jump_speed",
    on: CheckScope::Cam,
    unit: "rpm",
    about: "The lowest speed of the cam at which the follower leaves it: there its inertia cancels the force that presses it on.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "ω² = min (k s + F0 + load)/(−m s'') where s'' is negative, by the cam angle; with damping the first speed at which the \
                  least force is 0",
        usual: "the speed of the cam, times `limits.jump_margin`",
        change: "a higher `spring.preload`, a stiffer `spring.rate`, less mass, or a slower cam",
    },
};

/// Measure of the speed of the cam at which the follower first leaves it, rad/s, infinite where it never does; or why that is not known. With the
/// preload that holds the follower at so many times the speed of the cam.
#[must_use]
pub fn measure(
    jump: Result<Worst, String>,
    holding: impl FnOnce(f64) -> Option<KeyChange>,
    subject: &Subject<'_>,
) -> Measure {
    let jump = match jump {
        Ok(jump) => jump,
        Err(why) => return CHECK.unknown(&why),
    };
    let margin = subject.machine.limits.jump_margin;
    let limit = subject.speed.map(|speed| margin * units::rpm(speed));
    let kept = limit.is_none_or(|limit| units::rpm(jump.value) >= limit);
    let verdict = limit.map_or(Verdict::Info, |_| Verdict::of(kept));
    let note = match (subject.speed, kept) {
        (_, false) => holding(margin)
            .map(|change| text!("{} would hold it at {} rpm", Remedy::new([change]), shown(limit.unwrap_or(f64::NAN)))),
        (Some(speed), true) if jump.value.is_finite() => {
            Some(text!("{} times the speed of the cam", shown(jump.value / speed)))
        }
        (Some(_), true) => Some("the follower does not leave the cam at any speed".into()),
        (None, true) => Some("without motion.rpm or --rpm there is no limit".into()),
    };
    let holds = match subject.speed {
        _ if !jump.value.is_finite() => Text::from("the follower stays on the cam at any speed"),
        Some(speed) => text!(
            "holds up to {}, {} times the speed",
            Value::brief(units::rpm(jump.value), "rpm"),
            Value::brief_number(jump.value / speed)
        ),
        None => text!("holds up to {}", Value::brief(units::rpm(jump.value), "rpm")),
    };
    let measure = CHECK.measure(units::rpm(jump.value), limit).judged(verdict).noted(note).at(subject, &jump);
    measure.with_fact(Topic::SPRING, holds)
}
