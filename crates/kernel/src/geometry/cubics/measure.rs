//! The errors of a spline relative to a curve, at a place and between two.

use super::nodes::SplineNode;
use super::spline::{SplineDerivatives, SplineSpan, hit};
use crate::geometry::{ChainTolerance, CurvePoint};
use crate::numeric::extremum::larger;

/// Share of the allowed errors that may remain undetected between two places, and how often a stretch is halved for it.
const UNSEEN: f64 = 0.004;
const HALVINGS: u32 = 14;

/// A place of a spline relative to the curve, along the curve's normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct SplineDifference {
    /// Distance of the spline to the outside of the curve, e.
    pub(super) distance: f64,
    /// Angle from the tangent of the curve to that of the spline, Δ, rad.
    pub(super) heading: f64,
    /// Curvature of the spline less that of the curve.
    pub(super) curvature: f64,
    /// Derivative of this difference by the length of the curve.
    pub(super) slope: f64,
}

/// From the point and derivatives of the spline on the normal of a point of the curve; `None` where it turns back there or lies
/// beyond the centre of curvature.
pub(super) fn difference(frame: &CurvePoint, spline: &SplineDerivatives) -> Option<SplineDifference> {
    let [point, first, second, third] = *spline;
    let there = CurvePoint::from_derivatives(point, first, second, third);
    let distance = (point - frame.point).dot(&frame.outward());
    let (sine, cosine) = (frame.tangent.perp(&there.tangent), frame.tangent.dot(&there.tangent));
    let shrink = 1.0 + frame.curvature * distance;
    if !(cosine > 0.0 && shrink > 0.0) {
        return None;
    }
    // By the length σ of the curve: ds/dσ = (1 + κ e)/cos Δ.
    let slope = there.curvature_slope * shrink / cosine - frame.curvature_slope;
    Some(SplineDifference {
        distance,
        heading: libm::atan2(sine, cosine),
        curvature: there.curvature - frame.curvature,
        slope,
    })
}

/// Largest differences of a whole spline.
#[derive(Debug, Clone, Copy)]
pub(super) struct LargestDifferences {
    pub(super) distance: f64,
    pub(super) heading: f64,
    pub(super) curvature: f64,
    /// The largest share of any allowed error.
    pub(super) share: f64,
}

impl LargestDifferences {
    fn with(&self, other: &Self) -> Self {
        Self {
            distance: larger(self.distance, other.distance),
            heading: larger(self.heading, other.heading),
            curvature: larger(self.curvature, other.curvature),
            share: larger(self.share, other.share),
        }
    }
}

/// A place where the spline is compared with the curve.
#[derive(Clone, Copy)]
struct SplineComparison {
    parameter: f64,
    frame: CurvePoint,
    allowed: ChainTolerance,
    off: SplineDifference,
    seen: f64,
}

/// The largest differences, including those between the nodes; `None` where the spline turns back.
///
/// The normals of the curve meet the spline at places that advance with them, from its start to its end, so every point of
/// the one is as near to a point of the other: the distance holds in both directions. By the length σ of the curve e' = −(1 + κe) tan Δ
/// and Δ' = (1 + κe) k/cos Δ − κ, which is k − κ to first order. Where (k − κ)' is monotonic from one place to the next, h on,
/// k − κ stays below the tangents at both, so that it exceeds the larger by no more than h/4 |(k − κ)'₁ − (k − κ)'₀|; the
/// heading exceeds the larger by no more than h²/8 of the largest (k − κ)', and the distance by h²/8 of the largest k − κ, by
/// the bound of linear interpolation. Where that is not small against the allowed errors the stretch is halved.
pub(super) fn certify(
    curve: &impl Fn(f64) -> CurvePoint,
    nodes: &[SplineNode],
    polynomials: &[SplineSpan],
    all_seen: &[f64],
    tolerance: f64,
    allowed: &dyn Fn(f64, &CurvePoint) -> ChainTolerance,
) -> Option<LargestDifferences> {
    let checker = SplineChecker { curve, polynomials, tolerance, allowed };
    let mut worst = LargestDifferences { distance: 0.0, heading: 0.0, curvature: 0.0, share: 0.0 };
    let mut before: Option<SplineComparison> = None;
    for (node, seen) in nodes.iter().zip(all_seen) {
        let here = checker.place(node.parameter, node.frame, node.allowed, *seen)?;
        if let Some(before) = before {
            worst = worst.with(&checker.between(&before, &here, HALVINGS)?);
        }
        before = Some(here);
    }
    worst.share.is_finite().then_some(worst)
}

struct SplineChecker<'a, C> {
    curve: &'a C,
    polynomials: &'a [SplineSpan],
    tolerance: f64,
    allowed: &'a dyn Fn(f64, &CurvePoint) -> ChainTolerance,
}

impl<C: Fn(f64) -> CurvePoint> SplineChecker<'_, C> {
    fn place(&self, parameter: f64, frame: CurvePoint, allowed: ChainTolerance, seen: f64) -> Option<SplineComparison> {
        let spans = self.polynomials;
        let index = spans.partition_point(|span| span.to < seen).min(spans.len() - 1);
        let off = difference(&frame, &spans.get(index)?.derivatives_at(seen))?;
        Some(SplineComparison { parameter, frame, allowed, off, seen })
    }

    fn between(&self, a: &SplineComparison, b: &SplineComparison, halvings: u32) -> Option<LargestDifferences> {
        let knots = self.polynomials;
        let (first, last) = (knots.partition_point(|span| span.to <= a.seen), knots.partition_point(|s| s.to < b.seen));
        let length = 0.5 * (b.parameter - a.parameter) * (a.frame.speed + b.frame.speed);
        // From the right at the first place, where the third derivative jumps at a knot.
        let mut from = *a;
        if let Some(span) = knots.get(first.min(knots.len() - 1)).filter(|span| span.from == a.seen) {
            from.off = difference(&a.frame, &span.derivatives_at(a.seen))?;
        }
        let (p, q) = (from.off, b.off);
        let whole = first >= last;
        let slope = p.slope.abs().max(q.slope.abs());
        // Over a knot the slope jumps: only its size is known there.
        let beyond = if whole { 0.25 * length * (p.slope - q.slope).abs() } else { length * slope };
        let curvature = p.curvature.abs().max(q.curvature.abs()) + beyond;
        let square = 0.125 * length * length;
        let heading = p.heading.abs().max(q.heading.abs()) + square * slope;
        let distance = p.distance.abs().max(q.distance.abs()) + square * curvature;
        let (heading_limit, curvature_limit) =
            (a.allowed.heading.min(b.allowed.heading), a.allowed.curvature.min(b.allowed.curvature));
        let unseen =
            (square * curvature / self.tolerance).max(square * slope / heading_limit).max(beyond / curvature_limit);
        let share = (distance / self.tolerance).max(heading / heading_limit).max(curvature / curvature_limit);
        if unseen <= UNSEEN || halvings == 0 {
            return Some(LargestDifferences { distance, heading, curvature, share });
        }
        // At a knot first: the third derivative jumps there.
        let middle = self.middle(a, b, knots.get(first).map(|span| span.to).filter(|_| !whole))?;
        let (low, high) = (self.between(a, &middle, halvings - 1)?, self.between(&middle, b, halvings - 1)?);
        Some(low.with(&high))
    }

    /// A place between two, at a knot of the spline where one is given.
    fn middle(&self, a: &SplineComparison, b: &SplineComparison, knot: Option<f64>) -> Option<SplineComparison> {
        let part = knot.map_or(0.5, |knot| ((knot - a.seen) / (b.seen - a.seen)).clamp(0.0, 1.0));
        let parameter = a.parameter + part * (b.parameter - a.parameter);
        let frame = (self.curve)(parameter);
        let allowed = (self.allowed)(parameter, &frame);
        let seen = hit(self.polynomials, frame.point, frame.tangent, a.seen + part * (b.seen - a.seen))?;
        if !(a.seen <= seen && seen <= b.seen) {
            return None;
        }
        self.place(parameter, frame, allowed, seen)
    }
}
