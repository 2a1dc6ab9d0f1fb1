//! Curves that are one expression from end to end: a formula, a Fourier series; and what a cam does for a load to move as a curve.

use super::curve::{Curve, Loaded, Part};
use super::expressed::Expressed;
use super::harmonics::Harmonics;
use crate::motion::formula::{Formula, Scan};
use std::sync::Arc;

/// A formula in a unit whose variable runs from 0 to a width, less a number; cut into stretches by what a scan of it found.
#[must_use]
pub fn expressed(formula: Formula, width: f64, (unit, less): (f64, f64), scan: &Scan) -> Curve {
    let stretches = scan.turns.div_ceil(TURNS_EACH).clamp(1, MOST_STRETCHES);
    Curve::cut(&Part::Expressed(Arc::new(Expressed { formula, width, less, unit })), stretches)
}

/// Extremes of a derivative that are told apart in a stretch.
const TURNS_EACH: u32 = 4;

/// The series Σ aₖ cos 2πkx + bₖ sin 2πkx, k from 1, less its value at x = 0, which is returned too.
#[must_use]
pub fn series(cosines: &[f64], sines: &[f64]) -> (Curve, f64) {
    let count = cosines.len().max(sines.len());
    let at = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(0.0);
    let amplitudes: Vec<[f64; 2]> = (0..count).map(|index| [at(cosines, index), at(sines, index)]).collect();
    let first = cosines.iter().sum();
    let part = Part::Harmonics(Arc::new(Harmonics { amplitudes, first }));
    // A wave has two extremes, and a few of them are found in a stretch.
    (Curve::cut(&part, u32::try_from(count).unwrap_or(1).clamp(LEAST_STRETCHES, MOST_STRETCHES)), first)
}

const LEAST_STRETCHES: u32 = 4;
const MOST_STRETCHES: u32 = 60;

impl Curve {
    /// The curve s + first s' + second s''.
    #[must_use]
    pub fn loaded(&self, first: f64, second: f64) -> Self {
        self.with_parts(|part| Part::Loaded(Arc::new(Loaded { load: part.clone(), first, second })))
    }
}
