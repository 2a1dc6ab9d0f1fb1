//! A piece of curve sampled at nodes of equal share of I₃, and the arcs that are compared with them.

use super::{FitError, FitTarget, SAME_HEADING};
use crate::geometry::{ChainTolerance, CurvePoint};
use crate::numeric::extremum::larger;
use nalgebra::{Vector2, Vector4};

/// Nodes per best possible arc: each covers the curve as far as half way to the next.
const NODES_PER_ARC: f64 = 10.0;
/// Nodes for every additional arc that the curvature requires: the distances of short arcs are no limit, and the curvature is kept at the
/// joints.
const NODES_PER_SHORT_ARC: f64 = 5.0;
/// Least nodes of a piece, so that a short or nearly circular piece is sampled at all.
const LEAST_NODES: f64 = 24.0;
/// Cells of equal share where those of the first round are too wide: per best possible arc, and at least.
const CELLS_PER_ARC: f64 = 24.0;
const LEAST_CELLS: f64 = 96.0;
/// Cells in which I₃ is integrated first; the integrand has cusps where κ' changes sign, resolved to 1e-3 of I₃ with 256.
const SHARE_CELLS: u32 = 256;
/// Difference of the two sums of I₃ at which the cells are narrow enough, and how often they are divided again.
const AGREEMENT: f64 = 0.02;
const MOST_ROUNDS: u32 = 5;
/// Share of the nodes that is spread evenly over the piece, so that stretches of constant curvature have nodes.
const EVEN_SHARE: f64 = 0.05;
/// Largest number of nodes: a curve with a wrong κ' would need millions of arcs.
const MOST_NODES: f64 = 4e6;
/// K = 72√3 of the best tangent-continuous chain.
const CHAIN: f64 = 124.707_658_144_958_9;

/// A place where the curve was sampled.
#[derive(Debug, Clone, Copy)]
pub(super) struct CurveSample {
    pub(super) point: Vector2<f64>,
    pub(super) tangent: Vector2<f64>,
    pub(super) curvature: f64,
    /// κ' by the length.
    pub(super) slope: f64,
    pub(super) parameter: f64,
    /// Allowed errors of the chain here, in addition to the distance.
    pub(super) allowed: ChainTolerance,
    /// I₃ up to here over (K tol)^(1/3): position in best possible arcs.
    pub(super) share: f64,
    /// The heading of the best chain relative to the tangent, rad.
    pub(super) best_heading: f64,
    /// I₃ per length, or the density that replaces it where heading or curvature require shorter arcs.
    density: f64,
}

/// Arcs of the best chain per length, over (K tol)^(-1/3) = 1/`size`: |κ'|^(1/3) for the distance; an arc of length h misses the
/// heading by κ'h²/12 at the joints, and the curvature by κ'h/2.
fn density(frame: &CurvePoint, allowed: ChainTolerance, size: f64) -> [f64; 3] {
    let slope = frame.curvature_slope.abs();
    [libm::cbrt(slope), size * (slope / (12.0 * allowed.heading)).sqrt(), size * slope / (2.0 * allowed.curvature)]
}

/// The largest of three densities, or NaN if one of them is NaN.
fn densest([distance, heading, curvature]: [f64; 3]) -> f64 {
    larger(distance, larger(heading, curvature))
}

impl CurveSample {
    /// For the curve at a parameter, for chains with this (K tol)^(1/3).
    fn new((frame, allowed): (CurvePoint, ChainTolerance), parameter: f64, share: f64, size: f64) -> Self {
        let densities = density(&frame, allowed, size);
        let density = densest(densities);
        // −κ' h²/12, h = size/density.
        let best_heading = if allowed == ChainTolerance::ANY {
            let [root, ..] = densities;
            -root.copysign(frame.curvature_slope) * size * size / 12.0
        } else {
            -frame.curvature_slope * size * size / (12.0 * density * density).max(f64::MIN_POSITIVE)
        };
        let CurvePoint { point, tangent, curvature, curvature_slope: slope, .. } = frame;
        Self { point, tangent, curvature, slope, parameter, allowed, share, best_heading, density }
    }
}

/// The largest deviation of the best arcs where heading or curvature limit them: κ'h³/K with κ'h²/12 or κ'h/2 as allowed, h
/// from a node to the node one arc ahead.
pub(super) fn farthest_lobe(nodes: &[CurveSample]) -> f64 {
    let mut ahead = nodes.iter().peekable();
    let mut farthest = 0.0;
    for node in nodes {
        while ahead.peek().is_some_and(|other| other.share < node.share + 1.0) {
            ahead.next();
        }
        let Some(other) = ahead.peek().copied().or(nodes.last()) else { break };
        let length = (other.point - node.point).norm();
        let (by_heading, by_curvature) = (12.0 * node.allowed.heading, 2.0 * node.allowed.curvature * length);
        let lobe = by_heading.min(by_curvature) * length / CHAIN;
        // Where nothing else limits them, the distance does.
        farthest = if lobe.is_finite() { lobe.max(farthest) } else { farthest };
    }
    farthest
}

/// An arc that leaves a point with a heading.
#[derive(Debug, Clone, Copy)]
pub(super) struct TangentArc {
    pub(super) start: Vector2<f64>,
    pub(super) heading: Vector2<f64>,
    pub(super) curvature: f64,
    pub(super) bulge: f64,
}

impl TangentArc {
    /// The arc to a point and the heading there, the reflection at the chord; `None` past a half circle.
    pub(super) fn to(start: Vector2<f64>, heading: Vector2<f64>, end: Vector2<f64>) -> Option<(Self, Vector2<f64>)> {
        let chord = end - start;
        let length = chord.norm();
        let direction = chord / length;
        let (sine, cosine) = (heading.perp(&direction), heading.dot(&direction));
        // Written so that a NaN is refused too.
        if !(cosine > -SAME_HEADING) {
            return None;
        }
        let arc = Self { start, heading, curvature: 2.0 * sine / length, bulge: sine / (1.0 + cosine) };
        Some((arc, direction * (2.0 * cosine) - heading))
    }

    /// Signed distance of a point from the circle of the arc, for points near it.
    pub(super) fn distance(&self, point: Vector2<f64>) -> f64 {
        self.basis_at(point).1
    }

    /// 1, a, b, a² + b² of a point, a and b its coordinates along and across the heading, and its signed distance.
    ///
    /// The distance is g/(1 + √(1 − κ g)), g = 2 b − κ (a² + b²): no cancellation for large radii, and a straight line is not
    /// a special case. Near the circle it changes by g/2, which is linear in the four.
    pub(super) fn basis_at(&self, point: Vector2<f64>) -> (Vector4<f64>, f64) {
        let d = point - self.start;
        let (along, across, square) = (self.heading.dot(&d), self.heading.perp(&d), d.norm_squared());
        let g = 2.0 * across - self.curvature * square;
        let distance = g / (1.0 + (1.0 - self.curvature * g).max(0.0).sqrt());
        (Vector4::new(1.0, along, across, square), distance)
    }
}

/// The best possible number of arcs for the distance, the heading and the curvature alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BestCounts {
    pub(super) distance: f64,
    pub(super) heading: f64,
    pub(super) curvature: f64,
    /// For all three together.
    pub(super) all: f64,
}

/// Samples the curve at nodes of equal share, this many to an arc within `seen`, and returns N* for the whole tolerance.
///
/// I₃ is integrated in cells, and again along the nodes; where the two disagree, a feature is narrower than the cells,
/// and the next cells are narrower there.
pub(super) fn sample(
    target: &impl FitTarget,
    range: (f64, f64),
    tolerance: f64,
    seen: f64,
) -> Result<(Vec<CurveSample>, BestCounts), FitError> {
    let step = (range.1 - range.0) / f64::from(SHARE_CELLS);
    let inner = (1..SHARE_CELLS).map(|cell| range.0 + step * f64::from(cell));
    let mut bounds: Vec<f64> = std::iter::once(range.0).chain(inner).chain([range.1]).collect();
    let mut round = 0;
    loop {
        let mesh = ArcCountIntegral::new(target, &bounds, seen)?;
        let nodes = mesh.nodes(target, seen).ok_or(FitError::ToleranceTooFine { tolerance })?;
        let pairs = nodes.iter().zip(nodes.iter().skip(1));
        let along: f64 = pairs.map(|(a, b)| 0.5 * (a.density + b.density) * (b.point - a.point).norm()).sum();
        round += 1;
        if round == MOST_ROUNDS || (along - mesh.total).abs() <= AGREEMENT * mesh.total {
            let [distance, heading, curvature] = mesh.each;
            let (size, whole) = (libm::cbrt(CHAIN * seen), libm::cbrt(CHAIN * tolerance));
            let counts = BestCounts {
                distance: distance / whole,
                heading: heading / size,
                curvature: curvature / size,
                all: mesh.total / whole,
            };
            return Ok((nodes, counts));
        }
        bounds.extend(mesh.closer(seen).ok_or(FitError::ToleranceTooFine { tolerance })?);
        bounds.sort_by(f64::total_cmp);
        bounds.dedup();
    }
}

/// Adds nodes at more places, with their shares in between.
pub(super) fn insert(nodes: &mut Vec<CurveSample>, target: &impl FitTarget, parameters: &[f64], seen: f64) {
    let size = libm::cbrt(CHAIN * seen);
    for &parameter in parameters {
        let next = nodes.partition_point(|node| node.parameter < parameter);
        let (Some(before), Some(after)) = (next.checked_sub(1).and_then(|at| nodes.get(at)), nodes.get(next)) else {
            continue;
        };
        if after.parameter == parameter {
            continue;
        }
        let part = (parameter - before.parameter) / (after.parameter - before.parameter);
        let share = before.share + part * (after.share - before.share);
        nodes.insert(next, CurveSample::new(target.point_and_tolerance(parameter), parameter, share, size));
    }
}

/// I₃ along the piece.
struct ArcCountIntegral {
    /// Ends of the cells: parameter and I₃ up to there.
    bounds: Vec<(f64, f64)>,
    total: f64,
    /// The integrals for distance, heading and curvature alone.
    each: [f64; 3],
}

impl ArcCountIntegral {
    fn new(target: &impl FitTarget, parameters: &[f64], seen: f64) -> Result<Self, FitError> {
        let size = libm::cbrt(CHAIN * seen);
        let (mut total, mut each) = (0.0, [0.0; 3]);
        let mut bounds: Vec<(f64, f64)> = parameters.iter().take(1).map(|start| (*start, 0.0)).collect();
        for (start, end) in parameters.iter().zip(parameters.iter().skip(1)) {
            let parameter = 0.5 * (start + end);
            let (frame, allowed) = target.point_and_tolerance(parameter);
            let densities = density(&frame, allowed, size);
            let share = densest(densities) * frame.speed * (end - start);
            // Written so that a NaN is refused too.
            if !(frame.speed > 0.0 && share.is_finite() && frame.point.iter().all(|at| at.is_finite())) {
                return Err(FitError::NotSmooth { parameter });
            }
            total += share;
            for (sum, density) in each.iter_mut().zip(densities) {
                *sum += density * frame.speed * (end - start);
            }
            bounds.push((*end, total));
        }
        Ok(Self { bounds, total, each })
    }

    /// Nodes of equal share, some of them spread evenly; `None` when they are too many.
    fn nodes(&self, target: &impl FitTarget, seen: f64) -> Option<Vec<CurveSample>> {
        let size = libm::cbrt(CHAIN * seen);
        Some(
            self.places(NODES_PER_ARC, NODES_PER_SHORT_ARC, LEAST_NODES, size)?
                .into_iter()
                .map(|(parameter, share)| {
                    CurveSample::new(target.point_and_tolerance(parameter), parameter, share, size)
                })
                .collect(),
        )
    }

    /// The ends of narrower cells.
    fn closer(&self, seen: f64) -> Option<Vec<f64>> {
        let places = self.places(CELLS_PER_ARC, NODES_PER_SHORT_ARC, LEAST_CELLS, libm::cbrt(CHAIN * seen))?;
        Some(places.into_iter().map(|(parameter, _)| parameter).collect())
    }

    /// Places of equal share, given numbers for an arc, for a short arc and in addition, with their shares; `None` when they are too many.
    fn places(&self, per_arc: f64, per_short_arc: f64, least: f64, size: f64) -> Option<Vec<(f64, f64)>> {
        let [for_distance, for_heading, _] = self.each;
        let long = for_distance.max(for_heading);
        let shorter = (self.total - long).max(0.0);
        let count = ((per_arc * long + per_short_arc * shorter) / size).ceil() + least;
        if count > MOST_NODES {
            return None;
        }
        let ((first, _), (last, _)) = (self.bounds.first()?, self.bounds.last()?);
        let even = if self.total > 0.0 { EVEN_SHARE } else { 1.0 };
        let position = |(parameter, share): &(f64, f64)| {
            (1.0 - even) * share / self.total.max(f64::MIN_POSITIVE) + even * (parameter - first) / (last - first)
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "below the largest number of nodes"
        )]
        let mut places = Vec::with_capacity(count as usize + 1);
        let mut cells = self.bounds.as_slice();
        let mut index = 0.0;
        while index <= count {
            let wanted = index / count;
            while let [_, rest @ ..] = cells
                && let [end, _, ..] = rest
                && position(end) < wanted
            {
                cells = rest;
            }
            let [low, high, ..] = cells else { return None };
            let within = ((wanted - position(low)) / (position(high) - position(low))).clamp(0.0, 1.0);
            let parameter = if index == count { *last } else { low.0 + within * (high.0 - low.0) };
            // A circle has I₃ = 0; its nodes count as one arc.
            let share = if self.total > 0.0 { (low.1 + within * (high.1 - low.1)) / size } else { wanted };
            places.push((parameter, share));
            index += 1.0;
        }
        Some(places)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arcs of 1, 2, … 9 mm: the longest one counts, by its heading where that is the less, else by its curvature.
    #[test]
    fn the_farthest_lobe_is_that_of_the_longest_arc() {
        for (heading, curvature, times_k) in [(1e-3, 1.0, 12e-3 * 9.0), (1.0, 1e-4, 2e-4 * 81.0)] {
            let place = |i: u32| Vector2::new(100.0 + 0.5 * f64::from(i * (i + 1)), 7.0);
            let allowed = ChainTolerance::symmetric(heading, curvature);
            let node = |i: u32| {
                let (along, still) = (Vector2::new(1.0, 0.0), Vector2::zeros());
                let point = CurvePoint::from_derivatives(place(i), along, still, still);
                CurveSample { share: f64::from(i), ..CurveSample::new((point, allowed), 0.0, 0.0, libm::cbrt(CHAIN)) }
            };
            let nodes: Vec<CurveSample> = (0..10).map(node).collect();
            let found = CHAIN * farthest_lobe(&nodes);
            assert!((found - times_k).abs() < 1e-12, "{found} {times_k}");
        }
    }
}
