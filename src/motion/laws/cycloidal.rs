//! The cycloidal law (inclined sine, Bestehorn): x − sin(2πx)/2π.

use super::{Law, Values};
use std::f64::consts::TAU;

pub(super) const LAW: Law = Law { name: "cycloidal", formula: "x - sin(2 pi x)/(2 pi)", continuity: 2, at };

/// Below this the difference of x and the sine is summed as a series: at 0.1 turns the closed form has lost four bits.
const SERIES_LIMIT: f64 = 0.1;

fn at(x: f64) -> Values {
    // The later half is the earlier one turned round, so that both ends keep their digits.
    let near = if x > 0.5 { 1.0 - x } else { x };
    let (sin, cos) = (libm::sin(TAU * near), libm::cos(TAU * near));
    let half = libm::sin(0.5 * TAU * near);
    let value = if near < SERIES_LIMIT { turn_minus_sine(TAU * near) / TAU } else { near - sin / TAU };
    let (velocity, acceleration, jerk) = (2.0 * half * half, TAU * sin, TAU * TAU * cos);
    if x > 0.5 { [1.0 - value, velocity, -acceleration, jerk] } else { [value, velocity, acceleration, jerk] }
}

/// t − sin t for small t: t³/6 − t⁵/120 + …
fn turn_minus_sine(t: f64) -> f64 {
    let square = t * t;
    let (mut term, mut sum, mut n) = (t * square / 6.0, 0.0, 3.0);
    while term.abs() > f64::EPSILON * f64::abs(sum) {
        sum += term;
        term *= -square / ((n + 1.0) * (n + 2.0));
        n += 2.0;
    }
    sum
}
