//! What a movement leaves behind of vibration in an elastic train.

use super::{Bound, Check, Evidence, Explained, On};
use crate::report::{Finding, Verdict, shown};

pub(super) const CHECK: Check = Check {
    name: "vibration",
    on: On::Cam,
    about: "The amplitude by which the load behind an elastic train swings after a movement from rest to rest, undamped, over the travel \
            of the movement.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "|∫ s'' e^(2πinx) dx|/(2πn) of a rise in n natural periods, with the jumps of the velocity",
        usual: "`limits.residual`; some thousandths where the load must stand still at once",
        change: "a law for the ratio of periods: any without a jump of the acceleration above 10, modified-sine from 5 to 10, 4-5-6-7 \
                 below; a longer rise, or a stiffer train",
    },
    run: check,
};

/// Ratios of periods up to which a law of their own is advised.
const SLOW: f64 = 10.0;
const QUICK: f64 = 5.0;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    body.machine().vibration().filter(|_| body.kind().command == crate::document::cams::MAKE)?;
    let Some(found) = body.vibration() else {
        let why = match body.shaft_speed() {
            None => "the period needs a speed: give motion.rpm or --rpm",
            Some(_) => "the motion is no program of segments",
        };
        return Some(CHECK.not_run("1", why));
    };
    let Some(largest) = found.largest() else {
        return Some(
            CHECK.not_run("1", "the motion never rests; the section `vibration` tells what it does all round"),
        );
    };
    let limit = body.machine().limits.residual;
    let kept = limit.is_none_or(|limit| largest.residual <= limit);
    let verdict = limit.map_or(Verdict::Info, |_| Verdict::of(kept));
    let told = format!(
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
        (!kept).then(|| format!("at this ratio of periods {law}; a longer movement or a stiffer train leaves less"));
    let note = std::iter::once(told).chain(remedy).collect::<Vec<_>>().join("; ");
    let finding = CHECK.found(largest.residual, limit, "1", verdict);
    Some(Finding { place: body.place(largest.angles.1), note: Some(note), ..finding })
}
