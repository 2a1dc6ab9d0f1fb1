//! Taylor's method for one ordinary differential equation y' = f(x, y), to any order.
//!
//! The right-hand side is a [`Tape`]. The n-th coefficient of every operation follows from the coefficients before it by a recurrence,
//! so the series of the solution grows by one coefficient a pass and all derivatives are exact. Order and step for a tolerance are
//! those of À. Jorba and M. Zou, "A software package for the numerical integration of ODEs by means of high-order Taylor methods",
//! Experimental Mathematics 14 (2005) 99–117. The series is its own dense output.

use super::number;
use super::tape::{SeriesRows, Tape};

/// A power series about `centre`, valid from there to `end`.
#[derive(Debug, Clone, PartialEq)]
pub struct TaylorExpansion {
    /// Where it was expanded.
    pub centre: f64,
    /// Last argument it is used for.
    pub end: f64,
    /// Coefficients of the powers of x − centre.
    pub coefficients: Vec<f64>,
}

impl Tape {
    /// f(x, y).
    #[must_use]
    pub fn value(&self, x: f64, y: f64) -> f64 {
        SeriesRows::new(self, x, 1).next(0, y)
    }

    /// The solution of y' = f(x, y) through (x, y) up to the power `order`.
    #[must_use]
    pub fn expand(&self, x: f64, y: f64, order: usize) -> TaylorExpansion {
        let mut rows = SeriesRows::new(self, x, order);
        let mut next = y;
        let mut coefficients = vec![y];
        for n in 0..order {
            next = rows.next(n, next) / number(n + 1);
            coefficients.push(next);
        }
        TaylorExpansion { centre: x, end: x, coefficients }
    }

    /// The solution y = x w(x) of y' = f(x, w) through the origin, where f depends on w without x as a factor, with the
    /// slope w(0) that solves w(0) = f(0, w(0)). The series returned is y's.
    ///
    /// x w' = f − w, and fₙ is linear in wₙ with one factor ∂f/∂w for all n.
    #[must_use]
    pub fn expand_from_origin(&self, slope: f64, order: usize) -> TaylorExpansion {
        let mut rows = SeriesRows::new(self, 0.0, order);
        rows.next(0, slope);
        let mut coefficients = vec![0.0, slope];
        let mut sensitivity = None;
        for n in 1..order {
            let without = rows.next(n, 0.0);
            let factor = *sensitivity.get_or_insert_with(|| rows.next(n, 1.0) - without);
            let next = without / (number(n + 1) - factor);
            rows.next(n, next);
            coefficients.push(next);
        }
        TaylorExpansion { centre: 0.0, end: 0.0, coefficients }
    }
}

impl TaylorExpansion {
    /// Value and first three derivatives.
    #[must_use]
    pub fn values_at(&self, x: f64) -> [f64; 4] {
        let t = x - self.centre;
        let (mut value, mut first, mut second, mut third) = (0.0, 0.0, 0.0, 0.0);
        for coefficient in self.coefficients.iter().rev() {
            third = third * t + second;
            second = second * t + first;
            first = first * t + value;
            value = value * t + coefficient;
        }
        [value, first, 2.0 * second, 6.0 * third]
    }

    /// The value alone.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        let t = x - self.centre;
        self.coefficients.iter().rev().fold(0.0, |value, coefficient| value * t + coefficient)
    }

    /// The distance from the centre up to which the last three terms, each times its power, stay below `tolerance`: there the error of the
    /// value is about that and the error of its slope that over the step. Infinite for a polynomial of lower degree; NaN when a
    /// coefficient is not a number.
    #[must_use]
    pub fn reach(&self, tolerance: f64) -> f64 {
        if self.coefficients.iter().any(|coefficient| !coefficient.is_finite()) {
            return f64::NAN;
        }
        let steps = self.coefficients.iter().enumerate().skip(1).rev().take(3).map(|(power, coefficient)| {
            let power = number(power);
            libm::pow(tolerance / (power * coefficient.abs()), 1.0 / power)
        });
        steps.fold(f64::INFINITY, f64::min)
    }
}

/// Least order: below it, coarse tolerances need more steps than a higher order costs.
const LEAST_ORDER: f64 = 8.0;
const LARGEST_ORDER: f64 = 30.0;

/// The order with the lowest cost for a tolerance relative to the size of the solution: −ln(tolerance)/2, and four for the
/// factor of the power in [`TaylorExpansion::reach`].
#[must_use]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
pub fn order(tolerance: f64) -> usize {
    (4.0 - 0.5 * libm::log(tolerance)).ceil().clamp(LEAST_ORDER, LARGEST_ORDER) as usize
}
