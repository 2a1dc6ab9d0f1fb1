//! What a movement leaves behind of vibration in an elastic train.

use super::Disc;
use crate::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, shown};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Text, text};

/// The check.
pub const CHECK: Check = Check {
    name: "vibration",
    on: CheckScope::Cam,
    unit: "1",
    about: "The amplitude with which the load behind an elastic train vibrates after a movement from rest to rest, undamped, over the travel of the movement.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "|∫ s'' e^(2πinx) dx|/(2πn) of a rise in n natural periods, with the jumps of the velocity",
        usual: "`limits.residual`; a few thousandths where the load must be still at once",
        change: "a law for the ratio of periods: any without a jump of the acceleration above 10, modified-sine from 5 to 10, 4-5-6-7 \
                 below; a longer rise, or a stiffer train",
    },
};

/// Ratios of periods up to which a law of their own is advised.
const SLOW: f64 = 10.0;
const QUICK: f64 = 5.0;

/// Measure of the vibration behind the follower; `None` where no elastic train is described.
pub(super) fn measure(disc: &Disc, subject: &Subject<'_>) -> Option<Measure> {
    disc.machine.vibration().filter(|_| disc.is_of_program())?;
    let Some(found) = disc.vibrating() else {
        let why = match disc.speed {
            None => "the period needs a speed: give motion.rpm or --rpm",
            Some(_) => "the motion is not a program of segments",
        };
        return Some(CHECK.unknown(why));
    };
    let Some(largest) = found.largest() else {
        return Some(
            CHECK.unknown("the motion never rests; the section `vibration` gives the vibration over the turn"),
        );
    };
    let limit = disc.machine.limits.residual;
    let kept = limit.is_none_or(|limit| largest.residual <= limit);
    let worst_note = format!(
        "in {} natural periods; {} in {}, the worst within 20 %",
        shown(largest.periods),
        shown(largest.worst),
        shown(largest.worst_periods)
    );
    let law = match largest.periods {
        ratio if ratio > SLOW => "any law without a jump of the acceleration suits",
        ratio if ratio > QUICK => "modified-sine suits",
        _ => "4-5-6-7 suits",
    };
    let remedy =
        (!kept).then(|| text!("at this ratio of periods {}; a longer movement or a stiffer train leaves less", law));
    let note = Text::from(worst_note).and("; ", remedy.unwrap_or_default());
    let (place, _) = (subject.at)(&Worst { value: largest.residual, at: largest.angles.1, z: 0.0 });
    Some(CHECK.measure(largest.residual, limit).noted(note).placed(place))
}
