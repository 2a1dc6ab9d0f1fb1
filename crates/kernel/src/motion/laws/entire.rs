//! Curves that are one expression from end to end: a formula, a Fourier series; and the motion of a cam whose elastic load moves as a curve.

use super::curve::{CurvePart, LawCurve, PolydyneShape};
use super::expression_shapes::{FormulaShape, HarmonicSeries};
use crate::motion::formula::{Formula, Scan};
use std::sync::Arc;

/// A formula in a unit whose variable runs from 0 to a width, less a number; cut into stretches by what a scan of it found.
#[must_use]
pub fn from_formula(formula: Formula, width: f64, unit: f64, less: f64, scan: &Scan) -> LawCurve {
    let stretches = scan.turns.div_ceil(TURNS_EACH).clamp(1, MOST_STRETCHES);
    LawCurve::cut(&CurvePart::Formula(Arc::new(FormulaShape { formula, width, less, unit })), stretches)
}

/// Extremes of a derivative that are separated in a stretch.
const TURNS_EACH: u32 = 4;

/// The series Σ aₖ cos 2πkx + bₖ sin 2πkx, k from 1, less its value at x = 0, which is returned too.
#[must_use]
pub fn from_harmonics(cosines: &[f64], sines: &[f64]) -> (LawCurve, f64) {
    let count = cosines.len().max(sines.len());
    let amplitudes: Vec<[f64; 2]> =
        (0..count).map(|index| [cosines, sines].map(|list| list.get(index).copied().unwrap_or(0.0))).collect();
    let first = cosines.iter().sum();
    let part = CurvePart::Harmonics(Arc::new(HarmonicSeries { amplitudes, first }));
    // A wave has two extremes, and a few of them are found in a stretch.
    (LawCurve::cut(&part, u32::try_from(count).unwrap_or(1).clamp(LEAST_STRETCHES, MOST_STRETCHES)), first)
}

const LEAST_STRETCHES: u32 = 4;
const MOST_STRETCHES: u32 = 60;

impl LawCurve {
    /// The curve s + first s' + second s''.
    #[must_use]
    pub fn loaded(&self, first: f64, second: f64) -> Self {
        self.with_parts(|part| CurvePart::Polydyne(Arc::new(PolydyneShape { load: part.clone(), first, second })))
    }
}
