//! How far an interpolated curve G lies from the exact curve C, in both directions: bounded between the rows, not sampled.
//!
//! G is followed from row to row, together with the foot of its point on C: g = C(t) + d n(t). With Δ the angle from the tangent of C
//! to that of G, k and κ their curvatures and s the length of G,
//!
//! ```text
//! dd/ds = −sin Δ,   d²d/ds² = −cos Δ (k − κ cos Δ/(1 + κ d))
//! ```
//!
//! G is divided where an interval ends, where a stretch of C ends and, if need be, between. In such a cell both curvatures lie in
//! the range given by their values and slopes at the two ends, so d'' lies in an interval, and two parabolas from the ends with the exact d
//! and d' bound d. Where the bound is not near the largest |d| found, the cell is divided where d' is 0 to first order. While
//! cos Δ > 0 and 1 + κ d > 0, which is checked, the foot advances without a jump: every point of C from the first row to the last
//! is the foot of a point of G, so that the bound holds for the points of C as for those of G (`following` has the corresponding proof for
//! arcs). Corners of C are rows.

use super::Interpolant;
use super::path::{ExactPath, PathPlace};
use crate::geometry::CurvePoint;
use crate::geometry::following::{OVERSHOOT, highest};
use crate::numeric::{quadrature, root};
use crate::refusal::Refusal;

/// A bound is not more than this share, or this much (mm), above the largest distance.
const SHARE: f64 = 1e-3;
const SLACK: f64 = 1e-10;
/// Places nearer than this count as one, mm.
const NEAR: f64 = 1e-9;
/// A foot is found when the point is this near to its normal, mm.
const ON_NORMAL: f64 = 1e-11;
/// Newton steps to a foot, and divisions of a cell.
const FOOT_STEPS: u32 = 50;
const DEEPEST: u32 = 48;
/// Both curves together turn in a cell by no more than this, rad.
const LONGEST_CELL: f64 = 0.5;
/// A cell is divided where d' is 0 if both parts keep this share of it.
const LEAST_SHARE: f64 = 0.02;
/// Least cos Δ and 1 + κ d.
const LEAST_COSINE: f64 = 0.05;
const LEAST_SHRINK: f64 = 0.05;
/// A larger turn of C between two stretches within an interval is a corner without a row.
const LEAST_CORNER: f64 = 1e-6;
/// Rounds of the bound, which depends on itself.
const BOUND_ROUNDS: u32 = 4;

/// Bounds of the distance between the interpolated curve and the exact one, one for each interval, mm, with the places of the
/// rows on the exact curve as lengths from its start. Distances below `negligible` (mm) are not refined, and the intervals after one
/// whose bound is above `limit` (mm) are left out.
///
/// # Errors
/// [`Refusal`] where the one does not follow the other.
pub fn deviations(
    path: &ExactPath<'_>,
    curve: &Interpolant,
    places: &[f64],
    negligible: f64,
    limit: f64,
) -> Result<Vec<f64>, Refusal> {
    let walk = DeviationWalk { path, curve, negligible };
    let mut bounds = Vec::with_capacity(places.len());
    for (interval, (from, to)) in places.iter().zip(places.iter().skip(1)).enumerate() {
        let bound = walk.interval(interval, *from, *to)?;
        bounds.push(bound);
        if !(bound <= limit) {
            break;
        }
    }
    Ok(bounds)
}

/// A point of G with its foot.
#[derive(Debug, Clone, Copy)]
struct InterpolantFoot {
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

struct DeviationWalk<'p, 'a> {
    path: &'p ExactPath<'a>,
    curve: &'p Interpolant,
    negligible: f64,
}

/// The cells of an interval over one stretch.
struct IntervalCells<'w, 'p, 'a> {
    walk: &'w DeviationWalk<'p, 'a>,
    interval: usize,
    part: usize,
    /// Largest |d| found in the interval.
    known: f64,
    /// Largest bound of a cell.
    bound: f64,
}

fn departure(at: &CurvePoint) -> Refusal {
    let (x, y) = (at.point.x, at.point.y);
    Refusal::new("the interpolated curve leaves the exact one").at(format!("x {x:.6} mm, y {y:.6} mm"))
}

fn nowhere() -> Refusal {
    Refusal::new("the interpolated curve has no point where the exact one has one")
}

impl DeviationWalk<'_, '_> {
    fn point(&self, interval: usize, at: f64) -> Result<CurvePoint, Refusal> {
        self.curve.point_at(interval, at).ok_or_else(nowhere)
    }

    fn foot(&self, part: usize, parameter: f64) -> Result<CurvePoint, Refusal> {
        self.path.point(PathPlace { part, parameter }).ok_or_else(nowhere)
    }

    /// A bound of |d| over an interval between two places of C.
    fn interval(&self, interval: usize, from: f64, to: f64) -> Result<f64, Refusal> {
        let (start, end) = self.curve.range(interval).ok_or_else(nowhere)?;
        if start == end && from == to {
            return Ok(0.0);
        }
        let place = self.path.place(from);
        let mut cells = IntervalCells { walk: self, interval, part: place.part, known: 0.0, bound: 0.0 };
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
            let at = self.over(interval, a.at, end, &foot);
            let b = cells.node(at, foot, border)?;
            cells.cell(&a, &b, DEEPEST)?;
            cells.part += 1;
            let begin = self.path.range(cells.part).0;
            let next = self.foot(cells.part, begin)?;
            if !(foot.tangent.perp(&next.tangent).abs() <= LEAST_CORNER) {
                return Err(departure(&foot));
            }
            a = cells.node(at, next, begin)?;
        }
        Err(departure(&a.point))
    }

    /// Where the interval crosses the normal of a point of C, between two of its parameters.
    fn over(&self, interval: usize, from: f64, to: f64, foot: &CurvePoint) -> f64 {
        let ahead = |at: f64| {
            self.curve.point_at(interval, at).map_or(f64::NAN, |point| (point.point - foot.point).dot(&foot.tangent))
        };
        if ahead(from) >= 0.0 {
            return from;
        }
        root::bracketed(ahead, from, to, 0.0).unwrap_or(to)
    }
}

impl IntervalCells<'_, '_, '_> {
    fn node(&mut self, at: f64, foot: CurvePoint, parameter: f64) -> Result<InterpolantFoot, Refusal> {
        let point = self.walk.point(self.interval, at)?;
        let away = point.point - foot.point;
        let off = away.dot(&foot.outward());
        let follows = foot.tangent.dot(&point.tangent) > LEAST_COSINE && 1.0 + foot.curvature * off > LEAST_SHRINK;
        if !follows {
            return Err(departure(&point));
        }
        // A row that was moved along the curve, by rounding or by hand, has the distance of its move.
        let distance = if away.dot(&foot.tangent).abs() > NEAR { away.norm() } else { off.abs() };
        self.known = self.known.max(distance);
        Ok(InterpolantFoot { at, point, foot, parameter, off, sine: foot.tangent.perp(&point.tangent) })
    }

    /// The point of a row, its foot near a parameter.
    fn row(&mut self, at: f64, hint: f64) -> Result<InterpolantFoot, Refusal> {
        let (from, to) = self.walk.path.range(self.part);
        let (foot, parameter) = self.foot_of(at, from, to, hint)?;
        self.node(at, foot, parameter)
    }

    /// The foot of a point of the interval within a range of the stretch.
    fn foot_of(&self, at: f64, mut low: f64, mut high: f64, hint: f64) -> Result<(CurvePoint, f64), Refusal> {
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

    fn cell(&mut self, a: &InterpolantFoot, b: &InterpolantFoot, depth: u32) -> Result<(), Refusal> {
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
            return Err(departure(&a.point));
        }
        let share = (at - a.at) / (b.at - a.at);
        let hint = a.parameter + share * (b.parameter - a.parameter);
        let (foot, parameter) = self.foot_of(at, a.parameter, b.parameter, hint)?;
        let between = self.node(at, foot, parameter)?;
        self.cell(a, &between, depth - 1)?;
        self.cell(&between, b, depth - 1)
    }
}

/// The range of a curvature over a length, from its values and slopes at both ends.
fn curvatures(a: &CurvePoint, b: &CurvePoint, length: f64) -> (f64, f64) {
    let over = OVERSHOOT * length.abs() * (a.curvature_slope.abs() + b.curvature_slope.abs());
    (a.curvature.min(b.curvature) - over, a.curvature.max(b.curvature) + over)
}

/// The interval of d''; `None` where the ends are too far apart for a bound, or Δ may reach a right angle.
fn bend(a: &InterpolantFoot, b: &InterpolantFoot, length: f64) -> Option<(f64, f64)> {
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
