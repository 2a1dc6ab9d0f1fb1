//! The Fourier integral of a curve's acceleration, and the residual vibration of a law.
//!
//! ∫ s'' e^{iwx} dx is exact for each part: waves times waves in closed form, polynomials by
//! [`legendre`](crate::numeric::legendre), any other smooth part by such polynomials to rounding.

use super::curve::{CurvePart, LawCurve};
use super::local::LocalPiece;
use crate::numeric::extremum::{self, Extremum};
use crate::numeric::legendre::{LegendreSeries, sinc};
use nalgebra::Complex;
use std::f64::consts::TAU;
use std::ops::Range;

/// A term of the acceleration on a stretch of a curve.
#[derive(Debug, Clone, PartialEq)]
enum SpectrumTerm {
    Series(LegendreSeries),
    /// sine·sin(pace u) + cosine·cos(pace u) with u from the middle.
    Wave {
        middle: f64,
        half: f64,
        pace: f64,
        sine: f64,
        cosine: f64,
    },
}

impl SpectrumTerm {
    fn transform(&self, w: f64) -> Complex<f64> {
        match self {
            SpectrumTerm::Series(series) => series.transform(w),
            SpectrumTerm::Wave { middle, half, pace, sine, cosine } => {
                let (apart, together) = (sinc((w - pace) * half), sinc((w + pace) * half));
                let about = Complex::new(cosine * (apart + together), sine * (apart - together)) * *half;
                let (sin, cos) = libm::sincos(w * middle);
                about * Complex::new(cos, sin)
            }
        }
    }
}

/// The acceleration of a curve, ready for its Fourier integral at any frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct AccelerationSpectrum {
    terms: Vec<SpectrumTerm>,
}

impl AccelerationSpectrum {
    /// ∫₀¹ s'' e^{iwx} dx.
    #[must_use]
    pub fn transform(&self, w: f64) -> Complex<f64> {
        self.terms.iter().map(|term| term.transform(w)).sum()
    }
}

/// The terms of a piece of waves between two places x, seen from the start, or from the end of the curve where `late`.
fn of_local(local: &LocalPiece, low: f64, high: f64, late: bool, terms: &mut Vec<SpectrumTerm>) {
    if !(low < high) {
        return;
    }
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    // 1 − s by 1 − x: the acceleration changes its sign, and so does the direction.
    let (at, side) = if late { (1.0 - middle, -1.0) } else { (middle, 1.0) };
    let (value, slope) = local.acceleration_line(at);
    if value != 0.0 || slope != 0.0 {
        terms.push(SpectrumTerm::Series(LegendreSeries::line((low, high), side * value, slope)));
    }
    for (pace, sine, cosine) in local.acceleration_waves(at) {
        terms.push(SpectrumTerm::Wave { middle, half, pace, sine, cosine: side * cosine });
    }
}

/// Cells of the first search for residuals over a range of ratios: a fixed number, and more for each natural period, since a residual has a
/// lobe for each.
const CELLS: (f64, f64) = (64.0, 8.0);
const MOST_CELLS: f64 = 4096.0;
/// Lobes that are followed to their tops.
const LOBES: usize = 3;

/// The largest residual over a range of frequencies, with the number of natural periods of the movement.
pub(in crate::motion) fn residual_peak(residual: impl Fn(f64) -> f64, range: (f64, f64), periods: f64) -> Extremum {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a few thousand")]
    let cells = (CELLS.0 + CELLS.1 * periods.abs()).min(MOST_CELLS) as u32;
    extremum::largest_of_hills(residual, range, cells, LOBES, extremum::TO_ROUNDING)
}

impl LawCurve {
    /// Its acceleration, ready for Fourier integrals.
    #[must_use]
    pub fn spectrum(&self) -> AccelerationSpectrum {
        let mut terms = Vec::new();
        for index in 0..self.parts() {
            let (low, high) = self.range_of(index);
            if let Some(CurvePart::Waves { split, early, late }) = self.part(index) {
                let split = split.clamp(low, high);
                of_local(early, low, split, false, &mut terms);
                of_local(late, split, high, true, &mut terms);
            } else {
                let series = LegendreSeries::expand(&|x| self.derivative(index, x, 2), (low, high));
                terms.extend(series.into_iter().map(SpectrumTerm::Series));
            }
        }
        AccelerationSpectrum { terms }
    }

    /// Amplitude of the residual vibration of a load on an undamped spring after this curve, over its travel, when the curve takes `ratio`
    /// natural periods: |∫ s'' e^{2πinx} dx|/(2πn), with the jumps of the velocity at its ends; the follower rests before and after.
    #[must_use]
    pub fn residual(&self, ratio: f64) -> f64 {
        self.residual_of(&self.spectrum(), ratio)
    }

    fn residual_of(&self, spectrum: &AccelerationSpectrum, ratio: f64) -> f64 {
        let w = TAU * ratio;
        let (sin, cos) = libm::sincos(w);
        let [first, last] =
            [(0, 0.0), (self.parts().saturating_sub(1), 1.0)].map(|(part, x)| self.values_at(part, x)[1]);
        (spectrum.transform(w) + first - Complex::new(cos, sin) * last).norm() / w
    }

    /// The largest residual vibration over a range of ratios, and where.
    #[must_use]
    pub fn largest_residual(&self, ratios: Range<f64>) -> Extremum {
        let spectrum = self.spectrum();
        residual_peak(|ratio| self.residual_of(&spectrum, ratio), (ratios.start, ratios.end), ratios.end)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{LAWS, LawTask, SegmentEnd, named};
    use super::*;
    use crate::numeric::quadrature;

    /// Values of 40-digit arithmetic.
    #[test]
    fn residuals_are_those_known() {
        for (law, at_2_5, at_3_7) in [
            ("modified-sine", 0.029_147_440_745_917_69, 0.006_739_333_176_419_47),
            ("3-4-5", 0.029_455_687_569_152_51, 0.006_106_288_017_877_654),
            ("4-5-6-7", 0.020_226_616_194_241_39, 0.005_362_729_536_543_663),
        ] {
            let curve = named(law).and_then(|law| law.solve(&LawTask::default()).ok()).expect(law);
            for (ratio, known) in [(2.5, at_2_5), (3.7, at_3_7)] {
                let found = curve.residual(ratio);
                assert!((found - known).abs() < 1e-15, "{law} at {ratio}: {found}");
            }
        }
    }

    /// Of the cycloidal law in closed form, at its resonance too: |sin πn|/(πn |n² − 1|), ½ at n = 1.
    #[test]
    fn the_cycloidal_residual_has_a_closed_form() {
        let curve = named("cycloidal").and_then(|law| law.solve(&LawTask::default()).ok()).expect("a law");
        for ratio in [0.01, 0.3, 0.999_999, 1.000_001, 1.5, 2.0, 7.3] {
            let known = (std::f64::consts::PI * ratio).sin().abs()
                / (std::f64::consts::PI * ratio * (ratio * ratio - 1.0).abs());
            assert!((curve.residual(ratio) - known).abs() < 1e-10, "{ratio}: {} {known}", curve.residual(ratio));
        }
        assert!((curve.residual(1.0) - 0.5).abs() < 1e-14);
        let worst = curve.largest_residual(0.8..1.2);
        assert!(worst.value > 0.5 && (0.8..=1.2).contains(&worst.at), "{worst:?}");
    }

    /// Every law between every pair of ends that it serves, against quadrature of its own derivative.
    #[test]
    fn spectra_are_those_of_brute_quadrature() {
        let ends = [
            SegmentEnd::Rest,
            SegmentEnd::Turn,
            SegmentEnd::Moving { velocity: 0.4 },
            SegmentEnd::Moving { velocity: 1.0 },
        ];
        for law in LAWS {
            for (from, to) in ends.iter().flat_map(|from| ends.iter().map(move |to| (*from, *to))) {
                let Ok(curve) = law.solve(&LawTask::between(from, to)) else { continue };
                let spectrum = curve.spectrum();
                for w in [0.0, 0.01, 1.0, TAU, 15.0, 77.0, -3.0] {
                    let part = |f: fn(f64) -> f64| -> f64 {
                        let of = |index: usize| {
                            let product = |x: f64| curve.derivative(index, x, 2) * f(w * x);
                            quadrature::integrate(product, curve.range_of(index), 40)
                        };
                        (0..curve.parts()).map(of).sum()
                    };
                    let known = Complex::new(part(libm::cos), part(libm::sin));
                    let found = spectrum.transform(w);
                    assert!((found - known).norm() < 2e-13, "{} {from}–{to} at {w}: {found} {known}", law.name);
                }
            }
        }
    }
}
