//! Segments by optimal polynomials.

use super::keys::{MINIMISE, OF_OPTIMUM, ObjectiveWord, POLYNOMIAL, RATIO, ROBUST};
use super::{Mover, SegmentSpec};
use crate::document::TableReader;
use crate::motion::laws::LawError;
use crate::motion::laws::optimum::{Objective, Optimum};

/// Whether a segment has a goal to minimise.
pub(super) fn has_goal(segment: &TableReader<'_>) -> bool {
    segment.has(&MINIMISE)
}

/// Refuses the keys of an optimum in a segment without one; `None` at a fault.
pub(super) fn refuse_keys(segment: &TableReader<'_>) -> Option<()> {
    if segment.has(&OF_OPTIMUM) {
        let help = "add `minimise`, or remove `degree`: without `minimise` the states at both ends give the polynomial";
        segment.fail(&OF_OPTIMUM, "`degree` applies only to a polynomial with `minimise`".into(), Some(help.into()));
        return None;
    }
    refuse_residual_keys(segment)
}

/// The optimum of a segment; `None` at a fault.
pub(super) fn read(segment: &TableReader<'_>, law: &str) -> Option<Mover> {
    if !law.eq_ignore_ascii_case(POLYNOMIAL) {
        let message = format!("`minimise` applies only to law = \"{POLYNOMIAL}\", not to {law}");
        segment.fail(&MINIMISE, message, Some(format!("give law = \"{POLYNOMIAL}\", or remove `minimise`")));
        return None;
    }
    let goal = segment.get(&MINIMISE)?;
    let least = match goal {
        ObjectiveWord::PeakAcceleration => Objective::PeakAcceleration,
        ObjectiveWord::PeakJerk => Objective::PeakJerk,
        ObjectiveWord::RmsAcceleration => Objective::RmsAcceleration,
        ObjectiveWord::Residual if !segment.has(&RATIO) => {
            let help = "it is the duration of the segment in natural periods of the load, e.g. ratio = 2.5";
            segment.fail(&RATIO, "minimise = \"residual\" needs `ratio`".into(), Some(help.into()));
            return None;
        }
        ObjectiveWord::Residual => Objective::Residual { ratio: segment.get(&RATIO)?, robust: segment.get(&ROBUST)? },
    };
    if goal != ObjectiveWord::Residual {
        refuse_residual_keys(segment)?;
    }
    let optimum = Optimum { degree: degree(segment)?, least };
    match optimum.solve() {
        Ok(curve) => Some(Mover::Optimum(optimum, curve)),
        Err(error) => {
            let key = if error.input == "ratio" { &RATIO } else { &OF_OPTIMUM };
            let remedy = error.refusal.remedy_words();
            segment.fail(key, error.refusal.what, remedy);
            None
        }
    }
}

/// Refuses `ratio` and `robust` where no vibration is to be avoided.
fn refuse_residual_keys(segment: &TableReader<'_>) -> Option<()> {
    let (ratio, robust) = (segment.has(&RATIO), segment.has(&ROBUST));
    let help = Some("remove it, or give minimise = \"residual\"".to_owned());
    if ratio {
        segment.fail(&RATIO, "`ratio` applies only to minimise = \"residual\"".into(), help);
    } else if robust {
        segment.fail(&ROBUST, "`robust` applies only to minimise = \"residual\"".into(), help);
    }
    (!ratio && !robust).then_some(())
}

fn degree(segment: &TableReader<'_>) -> Option<u32> {
    if !segment.has(&OF_OPTIMUM) {
        let help = "a whole number from 7 to 15, e.g. degree = 9";
        segment.fail(&OF_OPTIMUM, "`minimise` needs `degree`".into(), Some(help.into()));
        return None;
    }
    let typed = segment.get(&OF_OPTIMUM)?;
    if typed.fract() != 0.0 {
        let help = "a whole number from 7 to 15";
        segment.fail(&OF_OPTIMUM, format!("`degree` cannot be {typed}"), Some(help.into()));
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 7 to 15")]
    Some(typed as u32)
}

/// An optimum starts and ends at rest.
pub(super) fn check(steps: &[SegmentSpec]) -> Result<(), (usize, LawError)> {
    let before = steps.last().into_iter().chain(steps);
    for (index, (step, before)) in steps.iter().zip(before).enumerate() {
        let at_rest = [before, step].iter().all(|step| step.end.rests() && step.end.free == [false; 2]);
        let moves = !at_rest || step.end.jerk.is_some();
        if moves && matches!(step.mover, Mover::Optimum(..)) {
            let what = "a polynomial with `minimise` runs from rest to rest; an end of this one has a velocity, an \
                        acceleration, a jerk or a turn";
            let remedy = "remove the states, or `minimise`: without it a polynomial takes the states at its ends";
            return Err((index, LawError::new("minimise", what).remedy(remedy)));
        }
    }
    Ok(())
}
