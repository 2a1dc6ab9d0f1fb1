//! The polynomial laws between rests: 2-3, 3-4-5 and 4-5-6-7.

use super::{Law, Values};

pub(super) const CUBIC: Law =
    Law { name: "cubic", formula: "3 x^2 - 2 x^3", continuity: 1, at: |x| values(x, &[0.0, 0.0, 3.0, -2.0]) };

pub(super) const QUINTIC: Law = Law {
    name: "3-4-5",
    formula: "10 x^3 - 15 x^4 + 6 x^5",
    continuity: 2,
    at: |x| values(x, &[0.0, 0.0, 0.0, 10.0, -15.0, 6.0]),
};

pub(super) const SEPTIC: Law = Law {
    name: "4-5-6-7",
    formula: "35 x^4 - 84 x^5 + 70 x^6 - 20 x^7",
    continuity: 3,
    at: |x| values(x, &[0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0]),
};

/// A polynomial that is symmetric about its middle, and its derivatives: the later half is the earlier one turned round, so
/// that both ends keep their digits.
fn values(x: f64, coefficients: &[f64]) -> Values {
    if x > 0.5 {
        let [value, velocity, acceleration, jerk] = horner(1.0 - x, coefficients);
        [1.0 - value, velocity, -acceleration, jerk]
    } else {
        horner(x, coefficients)
    }
}

/// Value and derivatives by repeated synthetic division.
fn horner(x: f64, coefficients: &[f64]) -> Values {
    let mut sums = [0.0; 4];
    for coefficient in coefficients.iter().rev() {
        let [value, first, second, third] = sums;
        sums = [value * x + coefficient, first * x + value, second * x + first, third * x + second];
    }
    let [value, first, second, third] = sums;
    [value, first, 2.0 * second, 6.0 * third]
}
