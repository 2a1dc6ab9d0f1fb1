//! One expression as the shape of a segment: a formula, a Fourier series.

use super::bernstein::Values;
use crate::motion::formula::Formula;
use std::f64::consts::TAU;

/// s(x) = unit · (f(width · x) less a number).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FormulaShape {
    pub(super) formula: Formula,
    pub(super) width: f64,
    pub(super) less: f64,
    pub(super) unit: f64,
}

impl FormulaShape {
    /// Value and three derivatives.
    pub(super) fn values_at(&self, x: f64) -> Values {
        let (unit, width) = (self.unit, self.width);
        let [value, first, second, third] = self.formula.values_at(width * x);
        [
            unit * (value - self.less),
            unit * width * first,
            unit * width * width * second,
            unit * width * width * width * third,
        ]
    }

    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        let value = self.formula.derivative(self.width * x, order) - if order == 0 { self.less } else { 0.0 };
        (0..order).fold(self.unit * value, |product, _| product * self.width)
    }
}

/// Σ aₖ cos 2πkx + bₖ sin 2πkx, k from 1, less its value at x = 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HarmonicSeries {
    /// aₖ and bₖ.
    pub(super) amplitudes: Vec<[f64; 2]>,
    /// Σ aₖ.
    pub(super) first: f64,
}

impl HarmonicSeries {
    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        let sum = (1..).zip(&self.amplitudes).map(|(k, [a, b])| {
            // Whole turns of a harmonic are taken off before the angle is formed.
            let waves = f64::from(k) * x;
            let (sine, cosine) = libm::sincos(TAU * (waves - waves.floor()));
            let value = match order % 4 {
                0 => a * cosine + b * sine,
                1 => b * cosine - a * sine,
                2 => -a * cosine - b * sine,
                _ => a * sine - b * cosine,
            };
            (0..order).fold(value, |product, _| product * TAU * f64::from(k))
        });
        let sum: f64 = sum.sum();
        if order == 0 { sum - self.first } else { sum }
    }
}
