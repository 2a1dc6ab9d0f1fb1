//! Numbers of twice the precision of an `f64`, as the unevaluated sum of two: 106 bits, for the few places where a result of
//! full accuracy is the small difference of two large terms.
//!
//! T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18 (1971) 224–242; the
//! sum without a condition is D. E. Knuth's, The Art of Computer Programming 2, §4.2.2.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// 2²⁷ + 1, which splits 53 bits in two halves.
const HALVES: f64 = 134_217_729.0;

/// high + low, |low| at most half an ulp of high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble {
    /// The number to the nearest `f64`.
    pub high: f64,
    /// The rest.
    pub low: f64,
}

impl DoubleDouble {
    /// The sum of two numbers, exact.
    #[must_use]
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let back = high - a;
        Self { high, low: (a - (high - back)) + (b - back) }
    }

    /// The product of two numbers, exact while it neither overflows nor underflows.
    #[must_use]
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let ((a1, a2), (b1, b2)) = (split(a), split(b));
        Self { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
    }

    /// Square root of a positive number: one Newton step from the root of the high part.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        Self::sum(root, (self - Self::product(root, root)).high / (2.0 * root))
    }
}

/// A number as two of 26 bits each.
fn split(a: f64) -> (f64, f64) {
    let scaled = HALVES * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let high = Self::sum(high.high, high.low + low.high);
        Self::sum(high.high, high.low + low.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let high = Self::product(self.high, other.high);
        Self::sum(high.high, high.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - Self::from(first) * other;
        let second = rest.high / other.high;
        let last = (rest - Self::from(second) * other).high / other.high;
        Self::sum(first, second) + Self::from(last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_and_a_root_come_back() {
        let three = DoubleDouble::from(3.0);
        let third = DoubleDouble::from(1.0) / three;
        let off = third * three - DoubleDouble::from(1.0);
        assert!((off.high + off.low).abs() < 1e-31, "{off:?}");
        let root = DoubleDouble::from(2.0).sqrt();
        let off = root * root - DoubleDouble::from(2.0);
        assert!((off.high + off.low).abs() < 1e-31, "{off:?}");
        let lost = DoubleDouble::sum(1.0, 1e-25) - DoubleDouble::from(1.0);
        assert!((lost.high - 1e-25).abs() < 1e-40);
    }

    /// Each of the three quotients counts where the quotient is far from both numbers.
    #[test]
    fn quotients_of_any_size_are_right_to_the_same_share() {
        for (a, b) in [(1.0, 7e15), (3.0, 1.1e-20), (-5e18, 0.7), (1e-30, 9e30)] {
            let quotient = DoubleDouble::from(a) / DoubleDouble::from(b);
            let off = quotient * DoubleDouble::from(b) - DoubleDouble::from(a);
            assert!((off.high + off.low).abs() < 1e-30 * f64::abs(a), "{a} / {b}: {off:?}");
        }
    }
}
