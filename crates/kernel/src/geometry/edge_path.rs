//! An edge of a chain by its own length: points, and where a normal of another curve meets it.

use super::cubic_path::CubicPath;
use super::edge::Edge;
use super::segment::Segment;
use super::{left_of, rotated};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// An arc is followed in steps that turn by no more than this, rad; a part of a cubic curve turns by less.
const LONGEST_STEP: f64 = 0.8;

/// An edge with a length above 0, or a part of one, by the length from its start.
#[derive(Debug, Clone, Copy)]
pub(super) enum EdgePath {
    /// An arc or a line.
    Arc(ArcPath),
    /// A part of a cubic curve.
    Cubic(CubicPath),
}

impl EdgePath {
    /// The paths of an edge, in order; none for an edge without length.
    pub(super) fn paths(edge: &Edge) -> Vec<Self> {
        match edge {
            Edge::Segment(segment) => ArcPath::new(segment).map(EdgePath::Arc).into_iter().collect(),
            Edge::Cubic(cubic) => CubicPath::parts(cubic).map(EdgePath::Cubic).collect(),
        }
    }

    /// Start, mm.
    pub(super) fn start(&self) -> Vector2<f64> {
        match self {
            EdgePath::Arc(round) => round.start,
            EdgePath::Cubic(cubic) => cubic.start(),
        }
    }

    /// Length, mm.
    pub(super) fn length(&self) -> f64 {
        match self {
            EdgePath::Arc(round) => round.length,
            EdgePath::Cubic(cubic) => cubic.length,
        }
    }

    /// Point and unit tangent at a length from the start, mm.
    pub(super) fn point_and_tangent(&self, length: f64) -> (Vector2<f64>, Vector2<f64>) {
        match self {
            EdgePath::Arc(round) => round.point_and_tangent(length),
            EdgePath::Cubic(cubic) => cubic.point_and_tangent(length),
        }
    }

    /// The interval in which the curvature lies between two lengths, 1/mm, positive where it turns left.
    pub(super) fn curvature_between(&self, from: f64, to: f64) -> (f64, f64) {
        match self {
            EdgePath::Arc(round) => (round.curvature, round.curvature),
            EdgePath::Cubic(cubic) => cubic.curvature_between(from, to),
        }
    }

    /// Number of steps in which a range of it is followed.
    pub(super) fn steps(&self, from: f64, to: f64) -> f64 {
        match self {
            EdgePath::Arc(round) => ((to - from) * round.curvature.abs() / LONGEST_STEP).ceil().max(1.0),
            EdgePath::Cubic(_) => 1.0,
        }
    }

    /// Where the edge crosses the straight line through a point along a unit vector from its right to its left, seen along the
    /// vector: the distance along it, and the length from the start (beyond 0 and its length where the edge does not reach).
    /// `None` where they do not cross.
    pub(super) fn hit(&self, point: Vector2<f64>, direction: Vector2<f64>) -> Option<(f64, f64)> {
        match self {
            EdgePath::Arc(round) => round.hit(point, direction),
            EdgePath::Cubic(cubic) => cubic.hit(point, direction),
        }
    }

    /// The length from the start to the place nearest to a point, mm.
    pub(super) fn nearest(&self, point: Vector2<f64>) -> f64 {
        match self {
            EdgePath::Arc(round) => round.nearest(point),
            EdgePath::Cubic(cubic) => cubic.nearest(point),
        }
    }

    /// The largest distance from a point between two lengths, mm.
    pub(super) fn farthest_from(&self, point: Vector2<f64>, from: f64, to: f64) -> f64 {
        match self {
            EdgePath::Arc(round) => round.farthest_from(point, from, to),
            EdgePath::Cubic(cubic) => cubic.farthest_from(point, from, to),
        }
    }
}

/// An arc or a line with a length above 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct ArcPath {
    /// Start, mm.
    pub(super) start: Vector2<f64>,
    /// Unit tangent there.
    pub(super) heading: Vector2<f64>,
    /// Signed curvature, 1/mm, positive where it turns left.
    pub(super) curvature: f64,
    /// Length, mm.
    pub(super) length: f64,
}

impl ArcPath {
    /// `None` for a segment without length.
    #[must_use]
    pub(super) fn new(segment: &Segment) -> Option<Self> {
        let chord = (segment.end - segment.start).norm();
        if !(chord > 0.0) {
            return None;
        }
        let b = segment.bulge;
        let curvature = 4.0 * b / (chord * (1.0 + b * b));
        let length = if b == 0.0 { chord } else { (segment.sweep() / curvature).abs() };
        Some(Self { start: segment.start, heading: segment.start_tangent(), curvature, length })
    }

    /// Point and unit tangent at a length from the start, mm.
    #[must_use]
    pub(super) fn point_and_tangent(&self, length: f64) -> (Vector2<f64>, Vector2<f64>) {
        if self.curvature == 0.0 {
            return (self.start + self.heading * length, self.heading);
        }
        // The angle between the chord and the heading at the start is half the sweep of the arc.
        let half = 0.5 * self.curvature * length;
        let (sin, cos) = (libm::sin(half), libm::cos(half));
        let along = rotated(self.heading, sin, cos);
        (self.start + along * (2.0 * sin / self.curvature), rotated(along, sin, cos))
    }

    /// Where the circle or line of the segment crosses the straight line through a point along a unit vector from its right to
    /// its left, seen along the vector: the distance along it, and the length from the segment's start (beyond 0 and its
    /// length where the segment does not reach). `None` where they do not cross.
    ///
    /// With x from the start and the left normal N of its heading, the circle is k x²/2 = N·x, also for a line, k = 0.
    #[must_use]
    pub(super) fn hit(&self, point: Vector2<f64>, direction: Vector2<f64>) -> Option<(f64, f64)> {
        let from = point - self.start;
        let left = Vector2::new(-self.heading.y, self.heading.x);
        let k = self.curvature;
        let (a, b) = (0.5 * k, k * from.dot(&direction) - left.dot(&direction));
        let c = 0.5 * k * from.norm_squared() - left.dot(&from);
        let root = (b * b - 4.0 * a * c).sqrt();
        // Of the two places the one where the segment passes to the left of the vector, b + k away = root: behind the centre of
        // an arc smaller than the distance it is the far one.
        let away = if b < 0.0 { (root - b) / k } else { -2.0 * c / (b + root) };
        if !away.is_finite() {
            return None;
        }
        let x = from + direction * away;
        let (along, across) = (self.heading.dot(&x), self.heading.perp(&x));
        if k == 0.0 {
            return Some((away, along));
        }
        Some((away, self.along(across, along)))
    }

    /// The length from the start to a point of the circle, relative to the start: `across` to the left of the heading and
    /// `along` it. Beyond the middle of the rest of the circle it counts backwards from the start.
    fn along(&self, across: f64, along: f64) -> f64 {
        let bend = self.curvature.abs();
        // The angle between the chord to the point and the heading at the start is half the sweep up to there, and the chord is 2 sin(half)/k
        // long: that near the start, where its direction is rounding.
        let (sine, round) = (0.5 * bend * libm::hypot(across, along), 2.0 * PI / bend);
        let length = if sine > 0.5 {
            2.0 * libm::atan2(across * self.curvature.signum(), along) / bend
        } else if along >= 0.0 {
            2.0 * libm::asin(sine) / bend
        } else {
            let back = 2.0 * libm::asin(sine) / bend;
            return if round - back > 0.5 * (self.length + round) { -back } else { round - back };
        };
        if length > 0.5 * (self.length + round) { length - round } else { length }
    }

    /// The length from the start to the place nearest to a point, mm.
    #[must_use]
    pub(super) fn nearest(&self, point: Vector2<f64>) -> f64 {
        let away = point - self.start;
        let along = if self.curvature == 0.0 {
            self.heading.dot(&away)
        } else {
            let left = Vector2::new(-self.heading.y, self.heading.x);
            // Relative to the centre, over the radius.
            let (across, forth) = (1.0 - self.curvature * left.dot(&away), self.curvature * self.heading.dot(&away));
            let (turn, round) = (libm::atan2(forth, across), 2.0 * PI);
            let turn = turn * self.curvature.signum();
            let turn = if turn < 0.0 { turn + round } else { turn };
            let length = turn / self.curvature.abs();
            if length > 0.5 * (self.length + round / self.curvature.abs()) { 0.0 } else { length }
        };
        along.clamp(0.0, self.length)
    }

    /// The largest distance from a point between two lengths, mm.
    #[must_use]
    pub(super) fn farthest_from(&self, point: Vector2<f64>, from: f64, to: f64) -> f64 {
        let ends = (self.point_and_tangent(from).0 - point).norm().max((self.point_and_tangent(to).0 - point).norm());
        if self.curvature == 0.0 {
            return ends;
        }
        let centre = self.start + left_of(self.heading) / self.curvature;
        let away = centre - point;
        if !(away.norm() > 0.0) {
            return ends;
        }
        // Beyond the centre, as seen from the point, if the arc extends there.
        let top = centre + away.normalize() / self.curvature.abs();
        let x = top - self.start;
        let there = self.along(self.heading.perp(&x), self.heading.dot(&x));
        if (from..=to).contains(&there) { ends.max((top - point).norm()) } else { ends }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::cubic::Cubic;

    fn paths() -> Vec<EdgePath> {
        let at = |x: f64, y: f64| Vector2::new(x, y);
        let of = |bulge| Edge::Segment(Segment { start: at(1.0, 2.0), end: at(5.0, 3.0), bulge });
        let cubic = Edge::Cubic(Cubic { points: [at(1.0, 2.0), at(2.5, 3.0), at(4.0, 3.2), at(5.0, 2.5)] });
        let arcs = [0.0, 1e-9, 1e-4, 0.3, -0.3, 1.5, -1.5].into_iter().map(of);
        arcs.chain([cubic]).flat_map(|edge| EdgePath::paths(&edge)).collect()
    }

    #[test]
    fn a_normal_of_a_point_next_to_it_finds_the_place_again() {
        for path in paths() {
            for share in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let (point, tangent) = path.point_and_tangent(share * path.length());
                for away in [-0.01, 0.2] {
                    // Off its own normal by 0.3 rad.
                    let normal = Vector2::new(tangent.y, -tangent.x);
                    let slanted = normal * libm::cos(0.3) + tangent * libm::sin(0.3);
                    let (found, along) = path.hit(point - slanted * away, slanted).expect("a place");
                    assert!((found - away).abs() < 1e-13, "{path:?} {share}: {found}");
                    assert!((along - share * path.length()).abs() < 1e-11, "{path:?} {share}: {along}");
                }
            }
        }
    }

    #[test]
    fn the_farthest_place_is_the_farthest_of_many() {
        for path in paths() {
            for point in [Vector2::new(0.0, 0.0), Vector2::new(3.0, 2.6), Vector2::new(3.0, 9.0)] {
                let range = (0.1 * path.length(), 0.9 * path.length());
                let scan = (0..=20_000).map(|i| {
                    let share = f64::from(i) / 2e4;
                    (path.point_and_tangent(range.0 + share * (range.1 - range.0)).0 - point).norm()
                });
                let scan = scan.fold(0.0, f64::max);
                assert!((path.farthest_from(point, range.0, range.1) - scan).abs() < 1e-6, "{path:?} {point:?}");
            }
        }
    }

    /// Points all round lines and arcs short and long, inside and outside: none of many places is nearer.
    #[test]
    fn the_nearest_place_is_the_nearest_of_many() {
        let (start, heading) = (Vector2::new(1.0, 2.0), Vector2::new(0.6, 0.8));
        let arcs = [0.5, -0.05]
            .into_iter()
            .flat_map(|k| [0.01, 0.3, 0.6, 0.95].map(|share| (k, share * 2.0 * PI / f64::abs(k))));
        for (curvature, length) in arcs.chain([(0.0, 3.0)]) {
            let arc = ArcPath { start, heading, curvature, length };
            for i in 0..48 {
                let (sin, cos) = libm::sincos(2.0 * PI * f64::from(i) / 48.0);
                for reach in [0.3, 2.5, 60.0] {
                    let point = start + Vector2::new(reach * cos, reach * sin);
                    let found = (arc.point_and_tangent(arc.nearest(point)).0 - point).norm();
                    let scan =
                        (0..=2000).map(|i| (arc.point_and_tangent(length * f64::from(i) / 2e3).0 - point).norm());
                    let scan = scan.fold(f64::INFINITY, f64::min);
                    assert!(found <= scan + 1e-12, "{arc:?} from {point:?}: {found} {scan}");
                }
            }
        }
    }

    /// Places all round the circle of arcs short and long: ahead up to the middle of what an arc leaves of it, then back.
    #[test]
    fn lengths_to_places_of_the_circle_count_back_behind_the_arc() {
        for (curvature, share) in [0.5, -0.05, 4.0].into_iter().flat_map(|k| [0.01, 0.3, 0.6, 0.95].map(|s| (k, s))) {
            let round = 2.0 * PI / f64::abs(curvature);
            let (start, heading) = (Vector2::zeros(), Vector2::new(1.0, 0.0));
            let arc = ArcPath { start, heading, curvature, length: share * round };
            for i in 1..200 {
                let ahead = round * f64::from(i) / 200.0;
                let beyond = ahead - 0.5 * (arc.length + round);
                if beyond.abs() > 1e-6 * round {
                    let place = arc.point_and_tangent(ahead).0;
                    let off = arc.along(place.y, place.x) - if beyond > 0.0 { ahead - round } else { ahead };
                    assert!(off.abs() < 1e-12 * round, "{curvature} {share} {i}: {off}");
                }
            }
        }
    }
}
