//! Segments by polynomials that make something least.

use super::keys::{Goal, MINIMISE, OF_OPTIMUM, POLYNOMIAL, RATIO, ROBUST};
use super::{Mover, Step, StepError};
use crate::document::Table;
use crate::motion::laws::optimum::{Least, Optimum, OptimumError};

/// Whether a segment asks for one.
pub(super) fn is_asked(segment: &Table<'_>) -> bool {
    segment.has(&MINIMISE)
}

/// A segment that asks for none has none of its keys; `None` at a fault.
pub(super) fn without(segment: &Table<'_>) -> Option<()> {
    if segment.has(&OF_OPTIMUM) {
        let help = "add minimise, or leave it out: without, the states at both ends give the polynomial";
        segment.fail(&OF_OPTIMUM, "`degree` is of a polynomial with `minimise`".into(), Some(help.into()));
        return None;
    }
    lone(segment)
}

/// The optimum that a segment asks for; `None` at a fault.
pub(super) fn read(segment: &Table<'_>, law: &str) -> Option<Mover> {
    if !law.eq_ignore_ascii_case(POLYNOMIAL) {
        let message = format!("`minimise` is of law = \"{POLYNOMIAL}\", not of {law}");
        segment.fail(&MINIMISE, message, Some(format!("give law = \"{POLYNOMIAL}\", or leave `minimise` out")));
        return None;
    }
    let goal = segment.get(&MINIMISE)?;
    let least = match goal {
        Goal::PeakAcceleration => Least::PeakAcceleration,
        Goal::PeakJerk => Least::PeakJerk,
        Goal::RmsAcceleration => Least::RmsAcceleration,
        Goal::Residual if !segment.has(&RATIO) => {
            let help = "the natural periods of the load that the segment takes, e.g. ratio = 2.5";
            segment.fail(&RATIO, "minimise = \"residual\" needs `ratio`".into(), Some(help.into()));
            return None;
        }
        Goal::Residual => Least::Residual { ratio: segment.get(&RATIO)?, robust: segment.get(&ROBUST)? },
    };
    if goal != Goal::Residual {
        lone(segment)?;
    }
    let optimum = Optimum { degree: degree(segment)?, least };
    match optimum.solve() {
        Ok(curve) => Some(Mover::Optimum(optimum, curve)),
        Err(error) => {
            let told = error.to_string();
            match error {
                OptimumError::TooFew { .. } => {
                    segment.fail(&OF_OPTIMUM, told, Some("raise `degree`, or leave `robust` out".into()));
                }
                OptimumError::Vibrates { .. } => {
                    segment.fail(&RATIO, told, Some("raise `degree`, or give the segment a longer angle".into()));
                }
                _ => segment.fail(&OF_OPTIMUM, told, None),
            }
            None
        }
    }
}

/// Without vibration to avoid there is no ratio.
fn lone(segment: &Table<'_>) -> Option<()> {
    let (ratio, robust) = (segment.has(&RATIO), segment.has(&ROBUST));
    let help = Some("leave it out, or give minimise = \"residual\"".to_owned());
    if ratio {
        segment.fail(&RATIO, "`ratio` is of minimise = \"residual\"".into(), help);
    } else if robust {
        segment.fail(&ROBUST, "`robust` is of minimise = \"residual\"".into(), help);
    }
    (!ratio && !robust).then_some(())
}

fn degree(segment: &Table<'_>) -> Option<u32> {
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

/// An optimum has no end that moves.
pub(super) fn check(steps: &[Step]) -> Result<(), (usize, StepError)> {
    let before = steps.last().into_iter().chain(steps);
    for (index, (step, before)) in steps.iter().zip(before).enumerate() {
        let rests = |step: &Step| step.end.rests() && step.end.free == [false; 2];
        let moves = !rests(before) || !rests(step) || step.end.jerk.is_some();
        if moves && matches!(step.mover, Mover::Optimum(..)) {
            return Err((index, StepError::OptimumMoves));
        }
    }
    Ok(())
}
