//! How far an interpolated curve G lies from the exact curve C, both ways: bounded between the rows, not sampled.
//!
//! G is walked from row to row, and with it the foot of its point on C: g = C(t) + d n(t). With Δ the angle from the tangent of C
//! to that of G, k and κ their curvatures and s the length of G,
//!
//! ```text
//! dd/ds = −sin Δ,   d²d/ds² = −cos Δ (k − κ cos Δ/(1 + κ d))
//! ```
//!
//! G is cut where an interval ends, where a stretch of C ends and, if need be, between. In such a cell both curvatures lie between
//! what their values and slopes at the two ends say, so d'' lies in an interval, and two parabolas from the ends with the exact d
//! and d' bound d. Where the bound is not near the largest |d| found, the cell is cut where d' is 0 to first order. While
//! cos Δ > 0 and 1 + κ d > 0, which is checked, the foot goes on without a jump: every point of C from the first row to the last
//! is the foot of one of G, so that the bound holds for the points of C as for those of G (`following` has the same proof for
//! arcs). Corners of C are rows.

use super::path::{Path, Place};
use super::{Interpolant, PointsError};
use crate::geometry::CurvePoint;
use crate::geometry::following::{OVERSHOOT, highest};
use crate::numeric::{quadrature, root};

/// A bound is not more than this share, or this much (mm), above the largest distance.
const SHARE: f64 = 1e-3;
const SLACK: f64 = 1e-10;
/// Places nearer than this are one, mm.
const NEAR: f64 = 1e-9;
/// A foot is found when the point is that near to its normal, mm.
const ON_NORMAL: f64 = 1e-11;
/// Newton steps to a foot, and cuts of a cell.
const FOOT_STEPS: u32 = 50;
const DEEPEST: u32 = 48;
/// Both curves together turn in a cell by no more than this, rad.
const LONGEST_CELL: f64 = 0.5;
/// A cell is cut where d' is 0 if both parts keep this share of it.
const LEAST_SHARE: f64 = 0.02;
/// Least cos Δ and 1 + κ d.
const LEAST_COSINE: f64 = 0.05;
const LEAST_SHRINK: f64 = 0.05;
/// A turn of C between two stretches within an interval beyond this is a corner without a row.
const LEAST_CORNER: f64 = 1e-6;
/// Rounds of the bound, which feeds on itself.
const BOUND_ROUNDS: u32 = 4;

/// Bounds of the distance between the interpolated curve and the exact one, one for each interval, mm, with the places of the
/// rows on the exact curve as lengths from its start. What lies below `negligible` (mm) need not be told closer, and nothing is
/// told of the intervals behind one whose bound is above `limit` (mm).
///
/// # Errors
/// [`PointsError::Astray`] where the one does not follow the other.
pub fn deviations(
    path: &Path<'_>,
    curve: &Interpolant,
    places: &[f64],
    (negligible, limit): (f64, f64),
) -> Result<Vec<f64>, PointsError> {
    let walk = Walk { path, curve, negligible };
    let mut bounds = Vec::with_capacity(places.len());
    for (interval, (from, to)) in places.iter().zip(places.iter().skip(1)).enumerate() {
        let bound = walk.interval(interval, (*from, *to))?;
        bounds.push(bound);
        if !(bound <= limit) {
            break;
        }
    }
    Ok(bounds)
}

/// A point of G with its foot.
#[derive(Debug, Clone, Copy)]
struct Node {
    /// Parameter in the interval.
    at: f64,
    point: CurvePoint,
    /// The foot, and its parameter in its stretch.
    foot: CurvePoint,
    parameter: f64,
    /// d, mm.
    off: f64,
    /// Sine of Δ.
    sine: f64,
}

struct Walk<'p, 'a> {
    path: &'p Path<'a>,
    curve: &'p Interpolant,
    negligible: f64,
}

/// The cells of an interval over one stretch.
struct Cells<'w, 'p, 'a> {
    walk: &'w Walk<'p, 'a>,
    interval: usize,
    part: usize,
    /// Largest |d| found in the interval.
    known: f64,
    /// Largest bound of a cell.
    bound: f64,
}

fn astray(at: &CurvePoint) -> PointsError {
    PointsError::Astray { x: at.point.x, y: at.point.y }
}

const NOWHERE: PointsError = PointsError::Astray { x: f64::NAN, y: f64::NAN };

impl Walk<'_, '_> {
    fn point(&self, interval: usize, at: f64) -> Result<CurvePoint, PointsError> {
        self.curve.at(interval, at).ok_or(NOWHERE)
    }

    fn foot(&self, part: usize, parameter: f64) -> Result<CurvePoint, PointsError> {
        self.path.point(Place { part, parameter }).ok_or(NOWHERE)
    }

    /// A bound of |d| over an interval between two places of C.
    fn interval(&self, interval: usize, (from, to): (f64, f64)) -> Result<f64, PointsError> {
        let (start, end) = self.curve.range(interval).ok_or(NOWHERE)?;
        if start == end && from == to {
            return Ok(0.0);
        }
        let place = self.path.place(from);
        let mut cells = Cells { walk: self, interval, part: place.part, known: 0.0, bound: 0.0 };
        let mut parameter = place.parameter;
        let last = !self.path.is_closed() && place.part + 1 == self.path.parts();
        if self.path.end_of(place.part) - from <= NEAR && !last {
            cells.part += 1;
            parameter = self.path.range(cells.part).0;
        }
        let mut a = cells.row(start, parameter)?;
        for _ in 0..=2 * self.path.parts() {
            let (_, border) = self.path.range(cells.part);
            let last = !self.path.is_closed() && cells.part + 1 == self.path.parts();
            if self.path.end_of(cells.part) >= to - NEAR || last {
                let there = self.path.place(to);
                let hint = if there.part == cells.part { there.parameter } else { border };
                let b = cells.row(end, hint)?;
                cells.cell(&a, &b, DEEPEST)?;
                return Ok(cells.bound.max(cells.known));
            }
            let foot = self.foot(cells.part, border)?;
            let at = self.over(interval, (a.at, end), &foot);
            let b = cells.node(at, foot, border)?;
            cells.cell(&a, &b, DEEPEST)?;
            cells.part += 1;
            let begin = self.path.range(cells.part).0;
            let next = self.foot(cells.part, begin)?;
            if !(foot.tangent.perp(&next.tangent).abs() <= LEAST_CORNER) {
                return Err(astray(&foot));
            }
            a = cells.node(at, next, begin)?;
        }
        Err(astray(&a.point))
    }

    /// Where the interval crosses the normal of a point of C, between two of its parameters.
    fn over(&self, interval: usize, (from, to): (f64, f64), foot: &CurvePoint) -> f64 {
        let ahead = |at: f64| {
            self.curve.at(interval, at).map_or(f64::NAN, |point| (point.point - foot.point).dot(&foot.tangent))
        };
        if ahead(from) >= 0.0 {
            return from;
        }
        root::bracketed(ahead, from, to, 0.0).unwrap_or(to)
    }
}

impl Cells<'_, '_, '_> {
    fn node(&mut self, at: f64, foot: CurvePoint, parameter: f64) -> Result<Node, PointsError> {
        let point = self.walk.point(self.interval, at)?;
        let away = point.point - foot.point;
        let off = away.dot(&foot.outward());
        let follows = foot.tangent.dot(&point.tangent) > LEAST_COSINE && 1.0 + foot.curvature * off > LEAST_SHRINK;
        if !follows {
            return Err(astray(&point));
        }
        // A row that rounding, or somebody, moved along the curve is as far off as it is.
        let distance = if away.dot(&foot.tangent).abs() > NEAR { away.norm() } else { off.abs() };
        self.known = self.known.max(distance);
        Ok(Node { at, point, foot, parameter, off, sine: foot.tangent.perp(&point.tangent) })
    }

    /// The point of a row, its foot near a parameter.
    fn row(&mut self, at: f64, hint: f64) -> Result<Node, PointsError> {
        let (from, to) = self.walk.path.range(self.part);
        let (foot, parameter) = self.foot_of(at, (from, to), hint)?;
        self.node(at, foot, parameter)
    }

    /// The foot of a point of the interval within a range of the stretch.
    fn foot_of(&self, at: f64, (mut low, mut high): (f64, f64), hint: f64) -> Result<(CurvePoint, f64), PointsError> {
        let point = self.walk.point(self.interval, at)?;
        let mut parameter = hint.clamp(low, high);
        let mut foot = self.walk.foot(self.part, parameter)?;
        for _ in 0..FOOT_STEPS {
            let away = point.point - foot.point;
            let ahead = away.dot(&foot.tangent);
            if ahead.abs() <= ON_NORMAL {
                break;
            }
            if ahead > 0.0 {
                low = parameter;
            } else {
                high = parameter;
            }
            let next = parameter + ahead / (foot.speed * (1.0 + foot.curvature * away.dot(&foot.outward())));
            // At an end of the stretch the end itself is the foot.
            let next = if next >= high && low == parameter && high - low <= (next - parameter).abs() {
                high
            } else if next <= low && high == parameter && high - low <= (next - parameter).abs() {
                low
            } else if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            if next == parameter || !next.is_finite() {
                break;
            }
            parameter = next;
            foot = self.walk.foot(self.part, parameter)?;
        }
        Ok((foot, parameter))
    }

    fn cell(&mut self, a: &Node, b: &Node, depth: u32) -> Result<(), PointsError> {
        let curve = self.walk.curve;
        let length = if curve.is_straight() {
            b.at - a.at
        } else {
            quadrature::integrate(|at| curve.speed(self.interval, at), (a.at, b.at), 1)
        };
        if length <= NEAR {
            // d' is a sine.
            self.bound = self.bound.max(a.off.abs().max(b.off.abs()) + length.max(0.0));
            return Ok(());
        }
        let enough = (self.known * (1.0 + SHARE)).max(self.walk.negligible) + SLACK;
        if let Some((least, most)) = bend(a, b, length) {
            let outside = highest((a.off, -a.sine), (b.off, -b.sine), length, most);
            let inside = highest((-a.off, a.sine), (-b.off, b.sine), length, -least);
            if outside.max(inside) <= enough {
                self.bound = self.bound.max(outside).max(inside);
                return Ok(());
            }
        }
        let root = a.sine / (a.sine - b.sine);
        let turns = depth.is_multiple_of(2) && (LEAST_SHARE..=1.0 - LEAST_SHARE).contains(&root);
        let at = a.at + (if turns { root } else { 0.5 }) * (b.at - a.at);
        if depth == 0 || !(a.at < at && at < b.at) || !(a.parameter < b.parameter) {
            return Err(astray(&a.point));
        }
        let share = (at - a.at) / (b.at - a.at);
        let hint = a.parameter + share * (b.parameter - a.parameter);
        let (foot, parameter) = self.foot_of(at, (a.parameter, b.parameter), hint)?;
        let between = self.node(at, foot, parameter)?;
        self.cell(a, &between, depth - 1)?;
        self.cell(&between, b, depth - 1)
    }
}

/// Between which values a curvature lies over a length, by its values and slopes at both ends.
fn curvatures(a: &CurvePoint, b: &CurvePoint, length: f64) -> (f64, f64) {
    let over = OVERSHOOT * length.abs() * (a.curvature_slope.abs() + b.curvature_slope.abs());
    (a.curvature.min(b.curvature) - over, a.curvature.max(b.curvature) + over)
}

/// The interval in which d'' lies; `None` where the ends are too far apart to tell, or Δ may reach a right angle.
fn bend(a: &Node, b: &Node, length: f64) -> Option<(f64, f64)> {
    let along = 0.5 * (b.parameter - a.parameter) * (a.foot.speed + b.foot.speed);
    let (least, most) = curvatures(&a.foot, &b.foot, along);
    let (first, last) = curvatures(&a.point, &b.point, length);
    let size = first.abs().max(last.abs()) + 1.25 * least.abs().max(most.abs());
    let at_ends = a.sine.abs().max(b.sine.abs());
    let mut sine = (at_ends + length * size).min(1.0);
    if !(length * size <= LONGEST_CELL) {
        return None;
    }
    let (mut low, mut high) = (0.0, 0.0);
    for _ in 0..BOUND_ROUNDS {
        let reach = 0.5 * length * sine;
        let (inner, outer) = (a.off.min(b.off) - reach, a.off.max(b.off) + reach);
        let cosine = ((1.0 - sine) * (1.0 + sine)).max(0.0).sqrt();
        (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (kappa, off) in [(least, inner), (least, outer), (most, inner), (most, outer)] {
            let shrink = 1.0 + kappa * off;
            if !(shrink > LEAST_SHRINK) {
                return None;
            }
            // k − κ cos Δ/(1 + κ d), at both ends of the cosine and of k.
            for turned in [kappa / shrink, kappa * cosine / shrink] {
                (low, high) = (low.min(first - turned), high.max(last - turned));
            }
        }
        sine = sine.min(at_ends + 0.5 * length * low.abs().max(high.abs()));
    }
    if !(sine < 1.0) {
        return None;
    }
    let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
    Some((-(high * cosine).max(high), -(low * cosine).min(low)))
}
