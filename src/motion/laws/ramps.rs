//! Laws of limited jerk: the acceleration grows and falls along straight lines.

use super::halves::{Half, LEAST};
use super::task::{LawError, Parameters};
use super::{Law, Shape};

fn half(parameters: &Parameters) -> Result<Half, LawError> {
    let ramp = parameters.ramp.unwrap_or(0.25);
    if (LEAST..=0.5).contains(&ramp) {
        return Ok(Half::straight([ramp, 1.0 - 2.0 * ramp, ramp, 0.0]));
    }
    Err(LawError::Parameter { name: "ramp", expected: "at least 0.000001 and at most 0.5", found: ramp.to_string() })
}

pub(super) const S_CURVE: Law = Law {
    name: "s-curve",
    aliases: &[],
    formula: "s'' = A x/a, then A, then falling as it grew",
    continuity: 2,
    shape: Shape::Halves(half),
};

pub(super) const CONSTANT_JERK: Law = Law {
    name: "constant-jerk",
    aliases: &[],
    formula: "s''' = 32, -32, 32",
    continuity: 2,
    shape: Shape::Halves(|_| Ok(Half::straight([0.5, 0.0, 0.5, 0.0]))),
};
