//! A Fourier series over a segment.

use super::curve::{Curve, Part};
use std::f64::consts::TAU;

/// Σ aₖ cos 2πkx + bₖ sin 2πkx, k from 1, less its value at x = 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Harmonics {
    /// aₖ and bₖ.
    amplitudes: Vec<[f64; 2]>,
    /// Σ aₖ.
    first: f64,
}

impl Harmonics {
    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        let of = |(k, [a, b]): (u32, &[f64; 2])| {
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
        };
        let sum: f64 = (1..).zip(&self.amplitudes).map(of).sum();
        if order == 0 { sum - self.first } else { sum }
    }
}

/// The series Σ aₖ cos 2πkx + bₖ sin 2πkx, k from 1, less its value at x = 0, which is returned too.
#[must_use]
pub fn series(cosines: &[f64], sines: &[f64]) -> (Curve, f64) {
    let count = cosines.len().max(sines.len());
    let at = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(0.0);
    let amplitudes: Vec<[f64; 2]> = (0..count).map(|index| [at(cosines, index), at(sines, index)]).collect();
    let first = cosines.iter().sum();
    let part = Part::Harmonics(std::sync::Arc::new(Harmonics { amplitudes, first }));
    // A wave has two extremes, and a few of them are found in a stretch.
    (Curve::cut(&part, u32::try_from(count).unwrap_or(1).clamp(LEAST_STRETCHES, MOST_STRETCHES)), first)
}

const LEAST_STRETCHES: u32 = 4;
const MOST_STRETCHES: u32 = 60;
