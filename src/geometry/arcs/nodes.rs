//! A piece of curve sampled at nodes of equal share of I₃, and the arcs that are held against them.

use super::{FitError, SAME_HEADING, Target};
use crate::geometry::{Allowed, CurvePoint};
use crate::numeric::extremum::larger;
use nalgebra::{Vector2, Vector4};

/// Nodes per best possible arc: each sees the top of a lobe as far as half way to the next.
const NODES_PER_ARC: f64 = 10.0;
/// Nodes for every arc more that the curvature asks for: the distances of short arcs are no limit, and the curvature is kept at the
/// joints.
const NODES_PER_SHORT_ARC: f64 = 5.0;
/// Nodes a piece has at the least, so that a short piece or a nearly circular one is seen at all.
const LEAST_NODES: f64 = 24.0;
/// Cells of equal share where those of the first round are too wide: per best possible arc, and at the least.
const CELLS_PER_ARC: f64 = 24.0;
const LEAST_CELLS: f64 = 96.0;
/// Cells in which I₃ is summed up first; the integrand has cusps where κ' changes sign, seen to 1e-3 of I₃ with 256.
const SHARE_CELLS: u32 = 256;
/// Difference of the two sums of I₃ at which the cells are narrow enough, and how often they are divided again.
const AGREEMENT: f64 = 0.02;
const MOST_ROUNDS: u32 = 5;
/// Share of the nodes that is spread evenly over the piece, so that stretches of constant curvature are not empty.
const EVEN_SHARE: f64 = 0.05;
/// Largest number of nodes: a curve with a wrong κ' would need millions of arcs.
const MOST_NODES: f64 = 4e6;
/// K = 72√3 of the best tangent-continuous chain.
const CHAIN: f64 = 124.707_658_144_958_9;

/// A place where the curve was sampled.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) point: Vector2<f64>,
    pub(super) tangent: Vector2<f64>,
    pub(super) curvature: f64,
    /// κ' by the length.
    pub(super) slope: f64,
    pub(super) parameter: f64,
    /// What the chain may miss here beside the distance.
    pub(super) allowed: Allowed,
    /// I₃ up to here over (K tol)^(1/3): position in best possible arcs.
    pub(super) share: f64,
    /// The heading of the best chain against the tangent, rad.
    pub(super) best_heading: f64,
    /// I₃ per length, or what takes its place where heading or curvature asks for shorter arcs.
    density: f64,
}

/// Arcs of the best chain per length, over (K tol)^(-1/3) = 1/`size`: |κ'|^(1/3) of the distance; an arc of length h is off
/// by κ'h²/12 in its heading at the joints, and by κ'h/2 in its curvature.
fn density(frame: &CurvePoint, allowed: Allowed, size: f64) -> [f64; 3] {
    let slope = frame.curvature_slope.abs();
    [libm::cbrt(slope), size * (slope / (12.0 * allowed.heading)).sqrt(), size * slope / (2.0 * allowed.curvature)]
}

/// The largest of three densities, or a NaN among them.
fn densest([distance, heading, curvature]: [f64; 3]) -> f64 {
    larger(distance, larger(heading, curvature))
}

impl Node {
    /// Of the curve at a parameter, for chains of this (K tol)^(1/3).
    fn new((frame, allowed): (CurvePoint, Allowed), parameter: f64, share: f64, size: f64) -> Self {
        let densities = density(&frame, allowed, size);
        let density = densest(densities);
        // −κ' h²/12, h = size/density.
        let best_heading = if allowed == Allowed::ANY {
            let [root, ..] = densities;
            -root.copysign(frame.curvature_slope) * size * size / 12.0
        } else {
            -frame.curvature_slope * size * size / (12.0 * density * density).max(f64::MIN_POSITIVE)
        };
        let CurvePoint { point, tangent, curvature, curvature_slope: slope, .. } = frame;
        Self { point, tangent, curvature, slope, parameter, allowed, share, best_heading, density }
    }
}

/// How far the farthest of the best arcs is off where heading or curvature limit it: κ'h³/K with κ'h²/12 or κ'h/2 as allowed, h
/// from a node to the one that lies an arc ahead.
pub(super) fn farthest_lobe(nodes: &[Node]) -> f64 {
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
        // Where nothing limits them, the distance does.
        farthest = if lobe.is_finite() { lobe.max(farthest) } else { farthest };
    }
    farthest
}

/// An arc that leaves a point with a heading.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) start: Vector2<f64>,
    pub(super) heading: Vector2<f64>,
    pub(super) curvature: f64,
    pub(super) bulge: f64,
}

impl Arc {
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
        self.seen_from(point).1
    }

    /// 1, a, b, a² + b² of a point, a and b its coordinates along and across the heading, and its signed distance.
    ///
    /// The distance is g/(1 + √(1 − κ g)), g = 2 b − κ (a² + b²): no cancellation of large radii, and a straight line is
    /// no special case. Near the circle it changes by g/2, which is linear in the four.
    pub(super) fn seen_from(&self, point: Vector2<f64>) -> (Vector4<f64>, f64) {
        let d = point - self.start;
        let (along, across, square) = (self.heading.dot(&d), self.heading.perp(&d), d.norm_squared());
        let g = 2.0 * across - self.curvature * square;
        let distance = g / (1.0 + (1.0 - self.curvature * g).max(0.0).sqrt());
        (Vector4::new(1.0, along, across, square), distance)
    }
}

/// The best possible number of arcs for the distance, the heading and the curvature alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Counts {
    pub(super) distance: f64,
    pub(super) heading: f64,
    pub(super) curvature: f64,
    /// For all together.
    pub(super) all: f64,
}

/// Samples the curve at nodes of equal share, so many to an arc within `seen`, and returns N* for the whole tolerance.
///
/// I₃ is summed up in cells, and again along the nodes; where the two do not agree a feature is narrower than the cells,
/// and the next ones are closer there.
pub(super) fn sample(
    target: &impl Target,
    range: (f64, f64),
    tolerance: f64,
    seen: f64,
) -> Result<(Vec<Node>, Counts), FitError> {
    let step = (range.1 - range.0) / f64::from(SHARE_CELLS);
    let inner = (1..SHARE_CELLS).map(|cell| range.0 + step * f64::from(cell));
    let mut bounds: Vec<f64> = std::iter::once(range.0).chain(inner).chain([range.1]).collect();
    let mut round = 0;
    loop {
        let mesh = Mesh::new(target, &bounds, seen)?;
        let nodes = mesh.nodes(target, seen).ok_or(FitError::ToleranceTooFine { tolerance })?;
        let pairs = nodes.iter().zip(nodes.iter().skip(1));
        let along: f64 = pairs.map(|(a, b)| 0.5 * (a.density + b.density) * (b.point - a.point).norm()).sum();
        round += 1;
        if round == MOST_ROUNDS || (along - mesh.total).abs() <= AGREEMENT * mesh.total {
            let [distance, heading, curvature] = mesh.each;
            let (size, whole) = (libm::cbrt(CHAIN * seen), libm::cbrt(CHAIN * tolerance));
            let counts = Counts {
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
pub(super) fn insert(nodes: &mut Vec<Node>, target: &impl Target, parameters: &[f64], seen: f64) {
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
        nodes.insert(next, Node::new(target.at(parameter), parameter, share, size));
    }
}

/// I₃ along the piece.
struct Mesh {
    /// Ends of the cells: parameter and I₃ up to there.
    bounds: Vec<(f64, f64)>,
    total: f64,
    /// The same for distance, heading and curvature alone.
    each: [f64; 3],
}

impl Mesh {
    fn new(target: &impl Target, parameters: &[f64], seen: f64) -> Result<Self, FitError> {
        let size = libm::cbrt(CHAIN * seen);
        let (mut total, mut each) = (0.0, [0.0; 3]);
        let mut bounds: Vec<(f64, f64)> = parameters.iter().take(1).map(|start| (*start, 0.0)).collect();
        for (start, end) in parameters.iter().zip(parameters.iter().skip(1)) {
            let parameter = 0.5 * (start + end);
            let (frame, allowed) = target.at(parameter);
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

    /// Nodes of equal share, with a little spread evenly; `None` when they are too many.
    fn nodes(&self, target: &impl Target, seen: f64) -> Option<Vec<Node>> {
        let size = libm::cbrt(CHAIN * seen);
        let node = |(parameter, share)| Node::new(target.at(parameter), parameter, share, size);
        Some(self.places((NODES_PER_ARC, NODES_PER_SHORT_ARC, LEAST_NODES), size)?.into_iter().map(node).collect())
    }

    /// The ends of closer cells.
    fn closer(&self, seen: f64) -> Option<Vec<f64>> {
        let places = self.places((CELLS_PER_ARC, NODES_PER_SHORT_ARC, LEAST_CELLS), libm::cbrt(CHAIN * seen))?;
        Some(places.into_iter().map(|(parameter, _)| parameter).collect())
    }

    /// Places of equal share, so many to an arc, to a short one and beside these, with their shares; `None` when they are too many.
    fn places(&self, (per_arc, per_short_arc, least): (f64, f64, f64), size: f64) -> Option<Vec<(f64, f64)>> {
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
            let between = |a: f64, b: f64| a + within * (b - a);
            let parameter = if index == count { *last } else { between(low.0, high.0) };
            // A circle has no I₃; its nodes count as one arc.
            let share = if self.total > 0.0 { between(low.1, high.1) / size } else { wanted };
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
            let allowed = Allowed { heading, curvature };
            let node = |i: u32| {
                let (along, still) = (Vector2::new(1.0, 0.0), Vector2::zeros());
                let point = CurvePoint::from_derivatives(place(i), along, still, still);
                Node { share: f64::from(i), ..Node::new((point, allowed), 0.0, 0.0, libm::cbrt(CHAIN)) }
            };
            let nodes: Vec<Node> = (0..10).map(node).collect();
            let found = CHAIN * farthest_lobe(&nodes);
            assert!((found - times_k).abs() < 1e-12, "{found} {times_k}");
        }
    }
}
