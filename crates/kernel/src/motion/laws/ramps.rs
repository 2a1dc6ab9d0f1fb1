//! Laws of limited jerk: the acceleration rises and falls along straight lines.

use super::halves::LEAST;
use super::law::{Half, Law, LawFamily};
use super::task::{LawError, Parameters};

fn half(parameters: &Parameters) -> Result<Half, LawError> {
    let ramp = parameters.ramp.unwrap_or(0.25);
    if (LEAST..=0.5).contains(&ramp) {
        return Ok(Half::straight([ramp, 1.0 - 2.0 * ramp, ramp, 0.0]));
    }
    Err(LawError::parameter("ramp", "at least 0.000001 and at most 0.5", ramp))
}

pub(super) const S_CURVE: Law = Law {
    name: "s-curve",
    aliases: &[],
    formula: "s'' = A x/a, then A, then falling as it grew",
    continuity: 2,
    shape: LawFamily::Halves(half),
};

pub(super) const CONSTANT_JERK: Law = Law {
    name: "constant-jerk",
    aliases: &[],
    formula: "s''' = 32, -32, 32",
    continuity: 2,
    shape: LawFamily::Halves(|_| Ok(Half::straight([0.5, 0.0, 0.5, 0.0]))),
};
