//! Where a parallel curve runs backwards.

use super::Parallel;
use crate::follower::Element;
use crate::motion::Piece;
use crate::numeric::root;
use crate::profile::extremes::{self, Corner};

/// Cells of a piece: its sharpness has a handful of extrema.
const CELLS: u32 = 256;
/// Largest κ d at which no fold can be missed next to the sharpest place found.
const CLEARLY: f64 = 0.75;

/// The corners at which the curve steps backwards.
pub(super) fn corners(parallel: Parallel<'_>) -> Vec<Corner> {
    let mut corners = extremes::corners(parallel.curves);
    corners.retain(|corner| corner.turn * parallel.distance > 0.0);
    corners
}

/// A stretch of the parameter in which the curve runs backwards, from cusp to cusp, or a corner at which it steps backwards as a
/// stretch without length.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fold {
    pub(super) from: f64,
    pub(super) to: f64,
}

/// The folds of a curve in order.
pub(super) fn folds(parallel: Parallel<'_>) -> Vec<Fold> {
    let motion = parallel.curves.motion;
    let mut folds: Vec<Fold> = corners(parallel).iter().map(|c| Fold { from: c.at, to: c.at }).collect();
    if !clearly_forward(parallel) {
        for (index, piece) in motion.pieces().iter().enumerate() {
            folds.extend(in_piece(parallel, index, piece));
        }
    }
    folds.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut merged: Vec<Fold> = Vec::new();
    for fold in folds {
        match merged.last_mut() {
            Some(last) if fold.from <= last.to => last.to = last.to.max(fold.to),
            _ => merged.push(fold),
        }
    }
    // A fold that extends over the end of the period is one fold.
    if let (Some(period), [first, .., last]) = (motion.period(), merged.as_mut_slice())
        && (first.from, last.to) == motion.range()
    {
        first.from = last.from - period;
        merged.pop();
    }
    merged
}

/// Whether the sharpest convex place of a roller's curve is so far from the distance that no cell needs to be examined.
fn clearly_forward(parallel: Parallel<'_>) -> bool {
    let of_roller = matches!(parallel.curves.element(), Element::Roller { .. });
    of_roller && parallel.distance >= 0.0 && {
        extremes::convex_curvature(parallel.curves).value * parallel.distance < CLEARLY
    }
}

/// A number with the sign of the curve's speed, and its derivative.
fn forward(parallel: Parallel<'_>, piece: usize, parameter: f64) -> (f64, f64) {
    match parallel.curves.element() {
        // 1 − κ d, and −κ' ℓ d.
        Element::Roller { .. } => {
            let curve = parallel.curves.touch(piece, parameter).curve;
            (1.0 - curve.curvature * parallel.distance, -curve.curvature_slope * curve.speed * parallel.distance)
        }
        // Under a face ρ − d.
        Element::Face => {
            let (radius, slope) = parallel.curves.face_radius(piece, parameter);
            (radius - parallel.distance, slope)
        }
    }
}

/// The folds of a piece, cut off at its ends.
fn in_piece(parallel: Parallel<'_>, index: usize, piece: &Piece) -> Vec<Fold> {
    let at = |parameter: f64| forward(parallel, index, parameter);
    let cusp = |low: f64, high: f64| root::bracketed(|p| at(p).0, low, high, 0.0).unwrap_or(high);
    let cells = if piece.dwell { 1 } else { CELLS };
    let mut folds = Vec::new();
    let (mut left, mut there) = (piece.start, at(piece.start));
    let mut from = is_backwards(there.0).then_some(left);
    for cell in 1..=cells {
        let right = if cell == cells {
            piece.end
        } else {
            piece.start + (piece.end - piece.start) / f64::from(cells) * f64::from(cell)
        };
        let here = at(right);
        match (from, is_backwards(here.0)) {
            (None, true) => from = Some(cusp(left, right)),
            (Some(start), false) => {
                folds.push(Fold { from: start, to: cusp(left, right) });
                from = None;
            }
            // A fold within a cell shows at its sharpest place.
            (None, false) if there.1 < 0.0 && here.1 > 0.0 => {
                if let Ok(sharpest) = root::bracketed(|p| at(p).1, left, right, 0.0)
                    && is_backwards(at(sharpest).0)
                {
                    folds.push(Fold { from: cusp(left, sharpest), to: cusp(sharpest, right) });
                }
            }
            _ => {}
        }
        (left, there) = (right, here);
    }
    folds.extend(from.map(|from| Fold { from, to: piece.end }));
    folds
}

/// Written so that a NaN counts as backwards.
fn is_backwards(speed: f64) -> bool {
    !(speed > 0.0)
}
