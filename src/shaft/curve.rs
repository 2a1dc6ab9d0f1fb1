//! The bent shaft: deflection and slope as a polynomial on every panel.

use super::legendre;
use crate::numeric::extremum;

/// Cells in which a panel is searched for its largest deflection: a panel holds at most 12 rad of a wave, four extrema.
const CELLS: u32 = 24;

/// Golden sections from two cells, a twelfth of a panel, to where a flat top is level to rounding: 0.618³⁰/12 = 5e-8 of it.
const SECTIONS: u32 = 30;

/// Two extremes this near in size are equal, and the left one gives the sign: those of an antisymmetric mode differ by
/// rounding only, and the sign of its curve must not.
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

    /// Where |y| is largest, m, and y there: of two extremes that differ by rounding only, the left one.
    #[must_use]
    pub fn largest(&self) -> (f64, f64) {
        let (up, down) = (self.highest(1.0), self.highest(-1.0));
        let nearly = (up.1 - down.1).abs() <= EQUAL * up.1.max(down.1);
        let is_up = if nearly { up.0 <= down.0 } else { up.1 > down.1 };
        if is_up { up } else { (down.0, -down.1) }
    }

    /// Where sign · y is largest, m, and its value there.
    fn highest(&self, sign: f64) -> (f64, f64) {
        let mut best = (0.0, f64::NEG_INFINITY);
        for piece in &self.pieces {
            // |P_k| ≤ 1: the coefficients bound the piece, and most are never searched.
            let bound: f64 = piece.deflection.iter().map(|c| c.abs()).sum();
            if bound > best.1 {
                let height = |xi: f64| sign * legendre::value(&piece.deflection, xi);
                let found = extremum::largest_without_slope(height, (0.0, 1.0), CELLS, SECTIONS);
                if found.value > best.1 {
                    best = (piece.at + piece.length * found.at, found.value);
                }
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
