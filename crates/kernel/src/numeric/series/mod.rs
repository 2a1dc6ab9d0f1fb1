//! Power series with the operators of numbers: exact derivatives of composed functions without formulas for each (A. Griewank,
//! A. Walther, Evaluating Derivatives, 2nd ed., 2008, ch. 13).
//!
//! A [`PowerSeries`] has a fixed number of coefficients. Where the function is known only at run time, or the series grows by one
//! coefficient a pass, the operations are recorded on a [`tape::Tape`], which has more of them (`functions`); [`taylor`] solves differential
//! equations with it.

mod functions;
pub mod tape;
pub mod taylor;

use std::array;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The operations that a coefficient of a series needs.
pub trait SeriesCoefficient:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A number that does not depend on the variable.
    fn constant(value: f64) -> Self;
    /// √.
    #[must_use]
    fn root(self) -> Self;
}

impl SeriesCoefficient for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn root(self) -> Self {
        self.sqrt()
    }
}

/// Σ aᵢ bₙ₋ᵢ over two slices of one length.
#[inline]
fn convolved<T: SeriesCoefficient>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b.iter().rev()).fold(T::constant(-0.0), |sum, (a, b)| sum + *a * *b)
}

/// The n-th coefficient of a product.
#[inline]
fn product<T: SeriesCoefficient>(a: &[T], b: &[T], n: usize) -> T {
    convolved(a.get(..=n).unwrap_or_default(), b.get(..=n).unwrap_or_default())
}

/// The next coefficient of a root, from that of the radicand and its own before: n > 0 has 2 y₀ yₙ = aₙ − Σ yᵢ yₙ₋ᵢ.
fn root<T: SeriesCoefficient>(a: T, own: &[T]) -> T {
    let Some((first, inner)) = own.split_first() else { return a.root() };
    (a - convolved(inner, inner)) / (*first + *first)
}

#[expect(clippy::cast_precision_loss, reason = "orders are small")]
fn number(n: usize) -> f64 {
    n as f64
}

/// c₀ + c₁ t + … with N coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerSeries<const N: usize, T = f64>(pub [T; N]);

impl<const N: usize, T: SeriesCoefficient> PowerSeries<N, T> {
    /// A number.
    #[must_use]
    pub fn constant(value: T) -> Self {
        Self(array::from_fn(|n| if n == 0 { value } else { T::constant(0.0) }))
    }

    /// cos and sin of angle + t.
    #[must_use]
    pub fn cos_sin(angle: f64) -> (Self, Self) {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        (Self::from_derivatives([cos, -sin, -cos, sin]), Self::from_derivatives([sin, cos, -sin, -cos]))
    }

    /// The series of a function whose derivatives repeat after four orders.
    fn from_derivatives(cycle: [f64; 4]) -> Self {
        let mut factorial = 1.0;
        Self(array::from_fn(|n| {
            factorial *= number(n.max(1));
            T::constant(cycle[n % 4] / factorial)
        }))
    }

    /// Coefficients computed one by one, each from its index and those before it.
    #[inline]
    fn grown(next: impl Fn(usize, &[T]) -> T) -> Self {
        let mut made = [T::constant(0.0); N];
        for n in 0..N {
            let (own, rest) = made.split_at_mut(n);
            if let Some(place) = rest.first_mut() {
                *place = next(n, own);
            }
        }
        Self(made)
    }

    /// √ of a series with positive value.
    #[must_use]
    #[inline]
    pub fn sqrt(self) -> Self {
        Self::grown(|n, own| root(self.0[n], own))
    }

    /// Value and derivatives: the n-th coefficient times n!.
    #[must_use]
    pub fn derivatives(self) -> [T; N] {
        let mut factorial = 1.0;
        array::from_fn(|n| {
            factorial *= number(n.max(1));
            self.0[n] * T::constant(factorial)
        })
    }
}

impl<const N: usize> PowerSeries<N> {
    /// The derivative; its last coefficient is unknown and set to 0.
    #[must_use]
    pub fn slope(self) -> Self {
        Self(array::from_fn(|n| self.0.get(n + 1).map_or(0.0, |next| number(n + 1) * next)))
    }

    /// The angle of the vector (x, self), whose derivative is (x y' − y x')/(x² + y²).
    #[must_use]
    pub fn atan2(self, x: Self) -> Self {
        let slope = (x * self.slope() - self * x.slope()) / (x * x + self * self);
        Self(array::from_fn(|n| match n {
            0 => libm::atan2(self.0[0], x.0[0]),
            n => slope.0[n - 1] / number(n),
        }))
    }
}

impl PowerSeries<3> {
    /// e^self − 1, exact where self is small.
    #[must_use]
    pub fn exp_m1(self) -> Self {
        let [value, first, second] = self.0;
        let less = libm::expm1(value);
        let whole = 1.0 + less;
        Self([less, whole * first, whole * (second + 0.5 * first * first)])
    }
}

impl<const N: usize, T: SeriesCoefficient> Neg for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(self.0.map(|coefficient| -coefficient))
    }
}

impl<const N: usize, T: SeriesCoefficient> Add for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(array::from_fn(|n| self.0[n] + other.0[n]))
    }
}

impl<const N: usize, T: SeriesCoefficient> Sub for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const N: usize, T: SeriesCoefficient> Mul for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(array::from_fn(|n| product(&self.0, &other.0, n)))
    }
}

impl<const N: usize, T: SeriesCoefficient> Div for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        Self::grown(|n, own| {
            let below = other.0.iter().take(n + 1).rev();
            own.iter().zip(below).fold(self.0[n], |rest, (own, below)| rest - *own * *below) / other.0[0]
        })
    }
}

impl<const N: usize, T: SeriesCoefficient> Add<T> for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn add(self, number: T) -> Self {
        self + Self::constant(number)
    }
}

impl<const N: usize, T: SeriesCoefficient> Sub<T> for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn sub(self, number: T) -> Self {
        self - Self::constant(number)
    }
}

impl<const N: usize, T: SeriesCoefficient> Mul<T> for PowerSeries<N, T> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: T) -> Self {
        Self(self.0.map(|coefficient| coefficient * factor))
    }
}

#[cfg(test)]
mod tests;
