//! The cycloidal law (inclined sine, Bestehorn): x − sin(2πx)/2π.

use super::{Law, Values, turn_minus_sine};
use std::f64::consts::TAU;

pub(super) const LAW: Law = Law { name: "cycloidal", formula: "x - sin(2 pi x)/(2 pi)", continuity: 2, at };

fn at(x: f64) -> Values {
    // The later half is the earlier one turned round, so that both ends keep their digits.
    let near = if x > 0.5 { 1.0 - x } else { x };
    let (sin, cos) = (libm::sin(TAU * near), libm::cos(TAU * near));
    let half = libm::sin(0.5 * TAU * near);
    let value = turn_minus_sine(TAU * near) / TAU;
    let (velocity, acceleration, jerk) = (2.0 * half * half, TAU * sin, TAU * TAU * cos);
    if x > 0.5 { [1.0 - value, velocity, -acceleration, jerk] } else { [value, velocity, acceleration, jerk] }
}
