//! The simple harmonic law: (1 − cos πx)/2. Its acceleration jumps at a rest.

use super::{Law, Values};
use std::f64::consts::PI;

pub(super) const LAW: Law = Law { name: "harmonic", formula: "(1 - cos(pi x))/2", continuity: 1, at };

fn at(x: f64) -> Values {
    let near = if x > 0.5 { 1.0 - x } else { x };
    let (half, sin, cos) = (libm::sin(0.5 * PI * near), libm::sin(PI * near), libm::cos(PI * near));
    let (value, velocity) = (half * half, 0.5 * PI * sin);
    let (acceleration, jerk) = (0.5 * PI * PI * cos, -0.5 * PI * PI * PI * sin);
    if x > 0.5 { [1.0 - value, velocity, -acceleration, jerk] } else { [value, velocity, acceleration, jerk] }
}
