//! The bent shaft: deflection and slope as a polynomial on every panel.

use super::legendre;
use camgen_kernel::numeric::extremum;

/// Cells in which a panel is searched for its largest deflection: a panel holds at most 12 rad of a wave, four extrema.
const CELLS: u32 = 24;

/// Golden sections from two cells, a twelfth of a panel, to where a flat top is level to rounding: 0.618³⁰/12 = 5e-8 of it.
const SECTIONS: u32 = 30;

/// Share of the height of a crest that two samples may hide between them: 1 − cos ¼ = 0.03 of a wave of half a radian in a cell.
const HIDDEN: f64 = 0.1;

/// Crests up and down that differ by less than this part are equal: in an antisymmetric mode they differ by rounding, which must
/// not give its curve a sign.
const EQUAL: f64 = 1e-9;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct CurvePiece {
    pub(super) at: f64,
    pub(super) length: f64,
    /// Legendre coefficients of y.
    pub(super) deflection: Vec<f64>,
    /// Legendre coefficients of ψ.
    pub(super) slope: Vec<f64>,
}

impl CurvePiece {
    /// y at the ends of the cells.
    fn samples(&self) -> Vec<f64> {
        (0..=CELLS).map(|cell| legendre::value(&self.deflection, f64::from(cell) / f64::from(CELLS))).collect()
    }

    /// Where sign · y is highest in the cells next to the end of one, m, and its height.
    fn crest(&self, cell: usize, sign: f64) -> (f64, f64) {
        let width = 1.0 / f64::from(CELLS);
        let middle = width * u32::try_from(cell).map_or(0.0, f64::from);
        let around = ((middle - width).max(0.0), (middle + width).min(1.0));
        let found =
            extremum::largest_without_slope(|xi| sign * legendre::value(&self.deflection, xi), around, 2, SECTIONS);
        (self.at + self.length * found.at, found.value)
    }

    fn xi(&self, x: f64) -> f64 {
        ((x - self.at) / self.length).clamp(0.0, 1.0)
    }
}

/// Deflection and slope along a shaft, both continuous.
///
/// The slope is ψ, by which the sections are turned and which loads a bearing. On an Euler beam it is dy/dx; on a
/// Timoshenko beam dy/dx = ψ + Q/(κGA), which jumps with the shear force at every support and disc.
#[derive(Debug, Clone, PartialEq)]
pub struct DeflectionCurve {
    pieces: Vec<CurvePiece>,
}

impl DeflectionCurve {
    pub(super) fn new(pieces: Vec<CurvePiece>) -> Self {
        Self { pieces }
    }

    /// Deflection and slope at x, m from the left end; of the nearer end outside of the shaft.
    ///
    /// Units: 1 and 1/m of a mode, m/N and rad/N under 1 N, m and rad of a response.
    #[must_use]
    pub fn evaluate(&self, x: f64) -> [f64; 2] {
        let right = self.pieces.partition_point(|piece| piece.at <= x);
        let piece = self.pieces.get(right.saturating_sub(1));
        piece.map_or([0.0; 2], |piece| {
            let xi = piece.xi(x);
            [legendre::value(&piece.deflection, xi), legendre::value(&piece.slope, xi)]
        })
    }

    /// Where |y| is largest, m, and y there; where both sides reach equally far, the side to which the left end goes.
    #[must_use]
    pub fn largest(&self) -> (f64, f64) {
        let [up, down] = self.crests();
        let size = up.1.max(down.1);
        let [end, turn] = self.evaluate(0.0);
        let is_up = if (up.1 - down.1).abs() > EQUAL * size {
            up.1 > down.1
        } else if end.abs() > EQUAL * size {
            end > 0.0
        } else {
            turn >= 0.0
        };
        if is_up { up } else { (down.0, -down.1) }
    }

    /// Where y is highest and where it is lowest, m, with the heights; up and down.
    fn crests(&self) -> [(f64, f64); 2] {
        let samples: Vec<Vec<f64>> = self.pieces.iter().map(CurvePiece::samples).collect();
        [1.0, -1.0].map(|sign| {
            let highest = samples.iter().flatten().fold(f64::NEG_INFINITY, |most, y| most.max(sign * y));
            // A crest between two samples: every one that can reach the highest is refined.
            let least = highest - HIDDEN * highest.abs();
            let mut best = (0.0, f64::NEG_INFINITY);
            for (piece, samples) in self.pieces.iter().zip(&samples) {
                // Nothing lies beyond the ends of a piece.
                let mut heights = vec![f64::NEG_INFINITY];
                heights.extend(samples.iter().map(|y| sign * y));
                heights.push(f64::NEG_INFINITY);
                for (cell, [before, here, after]) in heights.array_windows().enumerate() {
                    if *here >= least && here >= before && here >= after {
                        let found = piece.crest(cell, sign);
                        best = if found.1 > best.1 { found } else { best };
                    }
                }
            }
            best
        })
    }

    /// With the largest |y| at +1.
    pub(super) fn normalized(mut self) -> Self {
        let (_, largest) = self.largest();
        if largest != 0.0 {
            for piece in &mut self.pieces {
                for c in piece.deflection.iter_mut().chain(&mut piece.slope) {
                    *c /= largest;
                }
            }
        }
        self
    }
}
