//! Truncated power series in the angle of the driving crank, and numbers that carry their slopes by the links.
//!
//! Sums, products, quotients and roots of series give the exact derivatives of a motion (A. Griewank, A. Walther,
//! Evaluating Derivatives, 2nd ed., 2008, ch. 13). The coefficients are numbers, or [`Dual`]s where a synthesis needs
//! the slopes of those derivatives by the links.

use std::array;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What a coefficient of a series must do.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A number without slopes.
    fn constant(value: f64) -> Self;
    /// √.
    fn root(self) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn root(self) -> Self {
        self.sqrt()
    }
}

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
    /// The value with its slopes made from those of one or two operands.
    fn with(value: f64, slope: impl FnMut((f64, f64)) -> f64, a: Self, b: Self) -> Self {
        let mut pairs = a.slope.into_iter().zip(b.slope).map(slope);
        Self { value, slope: array::from_fn(|_| pairs.next().unwrap_or(f64::NAN)) }
    }

    /// The slopes by a factor.
    pub(super) fn scaled_slope(self, factor: f64) -> [f64; LINKS] {
        self.slope.map(|slope| factor * slope)
    }
}

impl Number for Dual {
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

/// c₀ + c₁ t + … with N coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Power<T, const N: usize>(pub(super) [T; N]);

impl<T: Number, const N: usize> Power<T, N> {
    /// A number.
    pub(super) fn constant(value: T) -> Self {
        Self(array::from_fn(|n| if n == 0 { value } else { T::constant(0.0) }))
    }

    /// cos and sin of angle + t.
    pub(super) fn cos_sin(angle: f64) -> (Self, Self) {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let series = |turns: [f64; 4]| {
            let (mut power, mut factorial) = (0.0, 1.0);
            let mut turns = turns.into_iter().cycle();
            Self(array::from_fn(|_| {
                let coefficient = turns.next().unwrap_or(f64::NAN) / factorial;
                power += 1.0;
                factorial *= power;
                T::constant(coefficient)
            }))
        };
        (series([cos, -sin, -cos, sin]), series([sin, cos, -sin, -cos]))
    }

    /// Every coefficient by a factor.
    pub(super) fn scaled(self, factor: T) -> Self {
        Self(self.0.map(|coefficient| coefficient * factor))
    }

    /// A number added.
    pub(super) fn shifted(self, by: T) -> Self {
        self + Self::constant(by)
    }

    /// Coefficients made one by one, each from its index and those before it.
    fn grown(mut next: impl FnMut(usize, &[T]) -> T) -> Self {
        let mut made = [T::constant(0.0); N];
        for n in 0..N {
            let value = next(n, made.get(..n).unwrap_or_default());
            if let Some(place) = made.get_mut(n) {
                *place = value;
            }
        }
        Self(made)
    }

    /// √ of a series with positive value.
    pub(super) fn root(self) -> Self {
        let mut coefficients = self.0.into_iter();
        Self::grown(|_, made| {
            let own = coefficients.next().unwrap_or(T::constant(f64::NAN));
            let Some(first) = made.first() else { return own.root() };
            let inner = made.get(1..).unwrap_or_default();
            (own - convolved(inner, inner)) / (*first + *first)
        })
    }

    /// Value and derivatives: the n-th coefficient by n!.
    pub(super) fn derivatives(self) -> [T; N] {
        let (mut power, mut factorial) = (0.0, 1.0);
        self.0.map(|coefficient| {
            let derivative = coefficient * T::constant(factorial);
            power += 1.0;
            factorial *= power;
            derivative
        })
    }
}

/// Σ aᵢ bₙ₋ᵢ over two slices of one length.
fn convolved<T: Number>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b.iter().rev()).fold(T::constant(0.0), |sum, (a, b)| sum + *a * *b)
}

impl<T: Number, const N: usize> Add for Power<T, N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let mut pairs = self.0.into_iter().zip(other.0);
        Self(array::from_fn(|_| pairs.next().map_or(T::constant(f64::NAN), |(a, b)| a + b)))
    }
}

impl<T: Number, const N: usize> Sub for Power<T, N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Number, const N: usize> Neg for Power<T, N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|coefficient| -coefficient))
    }
}

impl<T: Number, const N: usize> Mul for Power<T, N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(array::from_fn(|n| convolved(self.0.get(..=n).unwrap_or_default(), other.0.get(..=n).unwrap_or_default())))
    }
}

impl<T: Number, const N: usize> Div for Power<T, N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = other.0.first().copied().unwrap_or(T::constant(f64::NAN));
        let mut coefficients = self.0.into_iter();
        Self::grown(|n, made| {
            let own = coefficients.next().unwrap_or(T::constant(f64::NAN));
            (own - convolved(made, other.0.get(1..=n).unwrap_or_default())) / first
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_undo_each_other() {
        let (cos, sin) = Power::<f64, 6>::cos_sin(0.7);
        let one = cos * cos + sin * sin;
        assert!((one - Power::constant(1.0)).0.iter().all(|c| c.abs() < 1e-16), "{one:?}");
        let a = cos.shifted(2.0);
        let close = |x: Power<f64, 6>, y: Power<f64, 6>| (x - y).0.iter().all(|c| c.abs() < 1e-15);
        assert!(close(a.root() * a.root(), a) && close(sin / a * a, sin) && close(a.scaled(2.0), a + a));
        let [value, first, second, third, ..] = sin.derivatives();
        let (s, c) = (libm::sin(0.7), libm::cos(0.7));
        let want = [(value, s), (first, c), (second, -s), (third, -c)];
        assert!(want.iter().all(|(got, want)| (got - want).abs() < 1e-15));
    }

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
