//! What can be cut where the pitch curve is too sharp: the envelope with its loops removed.
//!
//! Where a convex radius of the pitch curve is below the roller's, or at a convex corner, the parallel curve folds back
//! and crosses itself. The roller cannot follow the motion there: the metal ends in the crossing, a sharp edge, and the
//! roller drops onto that edge. Between the two cam angles of the crossing motion is lost.

use super::{Curves, extremes};
use crate::follower::Element;
use crate::geometry::CurvePoint;
use crate::numeric::extremum;
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::TAU;

/// Points of a piece at which the parallel curve is tested for running backwards.
const SEEDS: u32 = 256;
/// Points of each branch beside a fold, denser near it, and how far the branches are followed, as a share of the cam.
const BRANCH_POINTS: u32 = 500;
const BRANCH_REACH: f64 = 0.25;
/// Newton steps to the crossing.
const CROSSING_STEPS: usize = 20;
/// Cells in which the largest loss is searched.
const LOSS_CELLS: u32 = 64;

/// A loop of the parallel curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loss {
    /// Parameter at which the roller comes onto the edge; may lie before the first piece by a turn.
    pub from: f64,
    /// Parameter at which it leaves it; above `from`.
    pub to: f64,
    /// Largest loss of lift, m.
    pub lost: f64,
    /// Parameter of the largest loss.
    pub lost_at: f64,
}

/// The loops have no simple envelope: they overlap, or take up the whole profile.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the profile folds over itself without a crossing that could be cut")]
pub struct NoEnvelope {
    /// Where, as the motion's parameter.
    pub parameter: f64,
}

/// From which side a break is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Approach {
    Before,
    After,
}

/// The profile at any cam angle, on the given side of a break.
fn profile(curves: Curves<'_>, angle: f64, side: Approach) -> CurvePoint {
    let (piece, inside) = curves.motion.locate(angle);
    let pieces = curves.motion.pieces();
    let at_start = pieces.get(piece).is_some_and(|p| p.start == inside);
    if side == Approach::Before && at_start && (piece > 0 || curves.motion.period().is_some()) {
        let before = (piece + pieces.len() - 1) % pieces.len();
        let end = pieces.get(before).map_or(inside, |p| p.end);
        return curves.profile(before, end);
    }
    curves.profile(piece, inside)
}

/// Stretches of cam angle in which the parallel curve runs backwards, convex corners as stretches without length.
fn folds(curves: Curves<'_>) -> Vec<(f64, f64)> {
    let mut folds: Vec<(f64, f64)> =
        extremes::corners(curves).iter().filter(|c| c.turn > 0.0).map(|c| (c.at, c.at)).collect();
    for (index, piece) in curves.motion.pieces().iter().enumerate() {
        let step = (piece.end - piece.start) / f64::from(SEEDS);
        let backwards = |i: u32| !(curves.profile(index, piece.start + step * f64::from(i)).speed > 0.0);
        let mut from = None;
        for i in 0..=SEEDS {
            let at = piece.start + step * f64::from(i);
            match (backwards(i), from) {
                (true, None) => from = Some(at),
                (false, Some(start)) => {
                    folds.push((start, at));
                    from = None;
                }
                _ => {}
            }
        }
        if let Some(start) = from {
            folds.push((start, piece.end));
        }
    }
    // A fold narrower than the steps shows at its sharpest place.
    let sharpest = extremes::convex_curvature(curves);
    if sharpest.value * curves.offset() >= 1.0 {
        let lobes = curves.motion.lobes();
        let places = (0..lobes).map(|lobe| sharpest.at + TAU * f64::from(lobe) / f64::from(lobes));
        folds.extend(places.map(|at| (at, at)));
    }
    folds.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut merged: Vec<(f64, f64)> = Vec::new();
    for fold in folds {
        match merged.last_mut() {
            Some(last) if fold.0 <= last.1 => last.1 = last.1.max(fold.1),
            _ => merged.push(fold),
        }
    }
    merged
}

/// Every loop of the profile, in the order of the cam angle.
///
/// # Errors
/// [`NoEnvelope`] when a loop has no crossing or two loops overlap.
pub fn losses(curves: Curves<'_>) -> Result<Vec<Loss>, NoEnvelope> {
    let mut found: Vec<Loss> = Vec::new();
    for fold in folds(curves) {
        if found.iter().any(|loss| loss.from <= fold.0 && fold.1 <= loss.to) {
            continue;
        }
        let none = NoEnvelope { parameter: fold.0 };
        let (from, to) = crossing(curves, fold).ok_or(none)?;
        if found.iter().any(|loss| from < loss.to) {
            return Err(none);
        }
        found.push(loss(curves, from, to));
    }
    match (found.first(), found.last()) {
        (Some(first), Some(last)) if curves.motion.period().is_some_and(|period| last.to > first.from + period) => {
            Err(NoEnvelope { parameter: last.to })
        }
        _ => Ok(found),
    }
}

/// The two cam angles at which the branches on either side of a fold meet first.
fn crossing(curves: Curves<'_>, fold: (f64, f64)) -> Option<(f64, f64)> {
    let (first, last) = curves.motion.range();
    let reach = BRANCH_REACH * (last - first);
    // Denser near the fold, where a small loop closes.
    let away = |i: u32| {
        let share = f64::from(i) / f64::from(BRANCH_POINTS);
        reach * share * share
    };
    let branch = |start: f64, sign: f64, side: Approach| -> Vec<(f64, Vector2<f64>)> {
        (0..=BRANCH_POINTS)
            .map(|i| start + sign * away(i))
            .map(|angle| (angle, profile(curves, angle, side).point))
            .collect()
    };
    let (left, right) = (branch(fold.0, -1.0, Approach::Before), branch(fold.1, 1.0, Approach::After));
    let meets = |a: &[(f64, Vector2<f64>)], b: &[(f64, Vector2<f64>)]| match (a, b) {
        ([a0, a1], [b0, b1]) => {
            let (u, v, w) = (a1.1 - a0.1, b1.1 - b0.1, b0.1 - a0.1);
            let cross = u.perp(&v);
            let (s, t) = (w.perp(&v) / cross, w.perp(&u) / cross);
            ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t))
                .then_some((a0.0 + s * (a1.0 - a0.0), b0.0 + t * (b1.0 - b0.0)))
        }
        _ => None,
    };
    let start = left.windows(2).find_map(|a| right.windows(2).find_map(|b| meets(a, b)))?;
    let (mut from, mut to) = start;
    for _ in 0..CROSSING_STEPS {
        let (a, b) = (profile(curves, from, Approach::Before), profile(curves, to, Approach::After));
        let apart = b.point - a.point;
        let slopes = Matrix2::from_columns(&[a.tangent * a.speed, -b.tangent * b.speed]);
        let step = slopes.try_inverse()? * apart;
        if !(step.norm() < reach) {
            return None;
        }
        (from, to) = (from + step.x, to + step.y);
        if step.norm() < f64::EPSILON {
            break;
        }
    }
    (from <= fold.0 && fold.1 <= to && from < to).then_some((from, to))
}

/// How far the follower drops onto the edge between the two parameters.
fn loss(curves: Curves<'_>, from: f64, to: f64) -> Loss {
    let edge = profile(curves, from, Approach::Before).point;
    let lost = |parameter: f64| {
        let (piece, inside) = curves.motion.locate(parameter);
        let contact = curves.touch(piece, inside);
        let away = contact.curve.point - edge;
        match curves.element() {
            Element::Roller { radius } => {
                let along = away.dot(&contact.drive);
                along - (along * along - away.norm_squared() + radius * radius).max(0.0).sqrt()
            }
            // The face stands at a height over the edge; it drops along its drive.
            Element::Face => {
                let normal = contact.curve.outward();
                away.dot(&normal) / contact.drive.dot(&normal)
            }
        }
    };
    let worst = extremum::largest_without_slope(lost, (from, to), LOSS_CELLS, extremum::TO_ROUNDING);
    Loss { from, to, lost: worst.value.max(0.0), lost_at: worst.at }
}
