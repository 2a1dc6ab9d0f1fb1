//! Numbers that carry their slopes by the links, for a synthesis: coefficients of a [`camgen_kernel::numeric::series::PowerSeries`].

use camgen_kernel::numeric::series::SeriesCoefficient;
use std::array;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Links that a synthesis turns: λ1, λ2, λ3 and δ.
pub(super) const LINKS: usize = 4;

/// A value and its slopes by the links.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dual {
    /// The value.
    pub(super) value: f64,
    /// ∂/∂λ1, ∂/∂λ2, ∂/∂λ3, ∂/∂δ.
    pub(super) slope: [f64; LINKS],
}

impl Dual {
    /// A value whose slopes combine the slopes of one or two operands.
    fn with(value: f64, slope: impl FnMut((f64, f64)) -> f64, a: Self, b: Self) -> Self {
        let mut pairs = a.slope.into_iter().zip(b.slope).map(slope);
        Self { value, slope: array::from_fn(|_| pairs.next().unwrap_or(f64::NAN)) }
    }

    /// The slopes by a factor.
    pub(super) fn scaled_slope(self, factor: f64) -> [f64; LINKS] {
        self.slope.map(|slope| factor * slope)
    }
}

impl SeriesCoefficient for Dual {
    fn constant(value: f64) -> Self {
        Self { value, slope: [0.0; LINKS] }
    }

    fn root(self) -> Self {
        let root = self.value.sqrt();
        Self { value: root, slope: self.scaled_slope(0.5 / root) }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::with(self.value + other.value, |(a, b)| a + b, self, other)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::with(self.value - other.value, |(a, b)| a - b, self, other)
    }
}

impl Mul for Dual {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule")]
    fn mul(self, other: Self) -> Self {
        Self::with(self.value * other.value, |(a, b)| a * other.value + self.value * b, self, other)
    }
}

impl Div for Dual {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the quotient rule")]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        Self::with(quotient, |(a, b)| (a - quotient * b) / other.value, self, other)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: self.slope.map(|slope| -slope) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_follow_the_rules() {
        let a = Dual { value: 2.0, slope: [1.0, 0.0, 3.0, 0.0] };
        let b = Dual { value: 5.0, slope: [0.0, 1.0, 1.0, 0.0] };
        assert_eq!((a * b).slope, [5.0, 2.0, 17.0, 0.0]);
        assert_eq!((a + b - b).slope, a.slope);
        let back = (a / b) * b;
        assert!(back.slope.iter().zip(a.slope).all(|(x, y)| (x - y).abs() < 1e-15));
        let back = a.root() * a.root();
        assert!(back.slope.iter().zip(a.slope).all(|(x, y)| (x - y).abs() < 1e-15));
        assert_eq!((-a).slope, a.scaled_slope(-1.0));
    }
}
