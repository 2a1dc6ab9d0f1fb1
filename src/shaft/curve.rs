//! The bent shaft: deflection and slope as a polynomial on every panel.

use super::legendre;
use crate::numeric::extremum;

/// Cells in which a panel is searched for its largest deflection: a panel holds at most 12 rad of a wave, four extrema.
const CELLS: u32 = 24;

/// Golden sections from two cells, a twelfth of a panel, to where a flat top is level to rounding: 0.618³⁰/12 = 5e-8 of it.
const SECTIONS: u32 = 30;

/// Crests up and down that differ by less than this part are equal: those of an antisymmetric mode differ by rounding, which must
/// not give its curve a sign.
const EQUAL: f64 = 1e-9;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece {
    pub(super) at: f64,
    pub(super) length: f64,
    /// Legendre coefficients of y.
    pub(super) deflection: Vec<f64>,
    /// Legendre coefficients of ψ.
    pub(super) slope: Vec<f64>,
}

impl Piece {
    fn xi(&self, x: f64) -> f64 {
        ((x - self.at) / self.length).clamp(0.0, 1.0)
    }
}

/// Deflection and slope along a shaft, both continuous.
///
/// The slope is ψ, by which the sections stand turned and which a bearing feels. On an Euler beam it is dy/dx; on a
/// Timoshenko beam dy/dx = ψ + Q/(κGA), which jumps with the shear force at every support and disc.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    pieces: Vec<Piece>,
}

impl Curve {
    pub(super) fn new(pieces: Vec<Piece>) -> Self {
        Self { pieces }
    }

    /// Deflection and slope at x, m from the left end; of the nearer end outside of the shaft.
    ///
    /// The unit is that of what the curve is: 1 and 1/m of a mode, m/N and rad/N under 1 N, m and rad of a response.
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 2] {
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
        let [end, turn] = self.at(0.0);
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
        let mut best = [(0.0, f64::NEG_INFINITY); 2];
        let signs = [1.0, -1.0];
        for piece in &self.pieces {
            // |P_k| ≤ 1: the coefficients bound the piece.
            let bound: f64 = piece.deflection.iter().map(|c| c.abs()).sum();
            if best.iter().all(|(_, height)| bound <= *height) {
                continue;
            }
            for cell in 0..=CELLS {
                let xi = f64::from(cell) / f64::from(CELLS);
                let y = legendre::value(&piece.deflection, xi);
                for (best, sign) in best.iter_mut().zip(signs) {
                    if sign * y > best.1 {
                        *best = (piece.at + piece.length * xi, sign * y);
                    }
                }
            }
        }
        for (best, sign) in best.iter_mut().zip(signs) {
            *best = self.crest(*best, sign);
        }
        best
    }

    /// The crest beside the best of the cells; on the pieces to both sides where that is an end.
    fn crest(&self, (at, height): (f64, f64), sign: f64) -> (f64, f64) {
        let mut best = (at, height);
        for piece in self.pieces.iter().filter(|piece| piece.at <= at && at <= piece.at + piece.length) {
            let (middle, cell) = (piece.xi(at), 1.0 / f64::from(CELLS));
            let around = ((middle - cell).max(0.0), (middle + cell).min(1.0));
            let y = |xi: f64| sign * legendre::value(&piece.deflection, xi);
            let found = extremum::largest_without_slope(y, around, 2, SECTIONS);
            if found.value > best.1 {
                best = (piece.at + piece.length * found.at, found.value);
            }
        }
        best
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
