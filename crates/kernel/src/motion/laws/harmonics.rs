//! A Fourier series over a segment.

use std::f64::consts::TAU;

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
        let sum: f64 = (1..)
            .zip(&self.amplitudes)
            .map(|(k, [a, b])| {
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
            })
            .sum();
        if order == 0 { sum - self.first } else { sum }
    }
}
