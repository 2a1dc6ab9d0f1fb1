//! Power series in one variable up to the second power: exact derivatives of composed functions without formulas for
//! each (forward mode of automatic differentiation; Griewank & Walther, Evaluating Derivatives, 2nd ed., 2008, ch. 13).

use std::ops::{Add, Div, Mul, Neg, Sub};

/// c₀ + c₁ t + c₂ t².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Series(pub [f64; 3]);

impl Series {
    /// A number.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self([value, 0.0, 0.0])
    }

    /// √ of a series with positive value.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let [a, b, c] = self.0;
        let root = a.sqrt();
        let first = 0.5 * b / root;
        Self([root, first, 0.5 * (c - first * first) / root])
    }

    /// The angle of the vector (x, self), whose derivative is (x y' − y x')/(x² + y²).
    #[must_use]
    pub fn atan2(self, x: Self) -> Self {
        let slope = (x * self.slope() - self * x.slope()) / (x * x + self * self);
        let [first, second, _] = slope.0;
        Self([libm::atan2(self.0[0], x.0[0]), first, 0.5 * second])
    }

    /// e^self − 1, exact where self is small.
    #[must_use]
    pub fn exp_m1(self) -> Self {
        let [value, first, second] = self.0;
        let less = libm::expm1(value);
        let whole = 1.0 + less;
        Self([less, whole * first, whole * (second + 0.5 * first * first)])
    }

    /// The derivative; its last coefficient is not known and 0.
    #[must_use]
    pub fn slope(self) -> Self {
        Self([self.0[1], 2.0 * self.0[2], 0.0])
    }
}

impl Add for Series {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a + d, b + e, c + f])
    }
}

impl Neg for Series {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|coefficient| -coefficient))
    }
}

impl Sub for Series {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Series {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a * d, a * e + b * d, a * f + b * e + c * d])
    }
}

impl Mul<f64> for Series {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|coefficient| coefficient * factor))
    }
}

impl Div for Series {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        let first = a / d;
        let second = (b - first * e) / d;
        Self([first, second, (c - first * f - second * e) / d])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x = 2 + t, y = 3 − t + t²: quotient, root and angle against their derivatives by hand.
    #[test]
    fn series_are_known_ones() {
        let (x, y) = (Series([2.0, 1.0, 0.0]), Series([3.0, -1.0, 1.0]));
        let close = |got: Series, want: [f64; 3]| {
            assert!(got.0.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-15), "{got:?} {want:?}");
        };
        close((y / x) * x, y.0);
        close(y.sqrt() * y.sqrt(), y.0);
        close(x - x * 1.0, [0.0; 3]);
        // e^t − 1 = t + t²/2 + …, and e^(2x) − 1 = (e^x − 1)(e^x + 1).
        close(Series([0.0, 1.0, 0.0]).exp_m1(), [0.0, 1.0, 0.5]);
        let half = (x * 0.05).exp_m1();
        close((x * 0.1).exp_m1(), (half * (half + Series::constant(2.0))).0);
        // d atan(y/x) = (x y' − y x')/(x² + y²) = −5/13 at t = 0; its slope from the quotient rule is 110/169.
        close(y.atan2(x), [libm::atan2(3.0, 2.0), -5.0 / 13.0, 0.5 * (4.0 * 13.0 - (-5.0) * (-2.0)) / 169.0]);
    }
}
