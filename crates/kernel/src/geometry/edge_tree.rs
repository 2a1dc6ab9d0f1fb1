//! An outline for rolling a follower on it: exact edges for the verdict, parry2d to find them fast and to measure
//! the same distances by a second method.
//!
//! Its bounding-volume tree over the exact edges is the broad phase; parry's segments along chords much finer than the tolerance
//! give distances that share no formula with ours. They are needed at a hundred places only, so that a tree over them would cost
//! more than examining the box of every dozen.

use crate::geometry::contour::{Contour, Edge, NearestOnSegment};
use nalgebra::Vector2;
use parry2d_f64::bounding_volume::{Aabb, BoundingVolume as _};
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry2d_f64::query::{PointQuery, PointQueryWithLocation};
use parry2d_f64::shape::{Segment, SegmentPointLocation};

/// Largest number of chords: a tolerance that needs more is compared with coarser chords.
const MOST_CHORDS: f64 = 2e5;

/// How much farther than the nearest edge, as a share of its distance, others are looked for, so that the next search may be skipped.
const ROOM: f64 = 1e-3;

/// Cached knowledge about a place near an outline.
#[derive(Debug, Clone, Copy, Default)]
pub struct NearestCache {
    /// The edge that is nearest there.
    edge: usize,
    /// No edge except this one and its two neighbours is nearer to `point` than `clear`, mm.
    middle: usize,
    point: Vector2<f64>,
    clear: f64,
    /// No edge except `edge` is nearer to `seen` than `alone`, mm.
    seen: Vector2<f64>,
    alone: f64,
    /// Distance of `middle` from `seen`, mm.
    to_middle: f64,
}

impl NearestCache {
    /// The edge that is nearest at the last place.
    #[must_use]
    pub fn edge(&self) -> usize {
        self.edge
    }
}

/// The edges of an outline, prepared for the search of the nearest point.
pub struct EdgeTree {
    edges: Vec<Edge>,
    tree: Bvh,
}

/// Two edges with their nearest points, the nearer one first, of equals the earlier one.
fn nearer(
    earlier: (usize, NearestOnSegment),
    later: (usize, NearestOnSegment),
) -> ((usize, NearestOnSegment), (usize, NearestOnSegment)) {
    if later.1.left.abs() < earlier.1.left.abs() { (later, earlier) } else { (earlier, later) }
}

fn parry(point: Vector2<f64>) -> Vector {
    Vector::new(point.x, point.y)
}

impl EdgeTree {
    /// The outline, counter-clockwise.
    #[must_use]
    pub fn new(contour: &Contour) -> Self {
        Self::along(contour.edges().collect())
    }

    /// A chain that need not close: its nearest edge is found by [`Self::nearest_segment`].
    #[must_use]
    pub fn along(edges: Vec<Edge>) -> Self {
        let boxes = edges.iter().map(|edge| {
            let extents = edge.extents();
            Aabb::new(parry(extents.least), parry(extents.largest))
        });
        let boxes: Vec<Aabb> = boxes.collect();
        Self { edges, tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes) }
    }

    /// The edges.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The nearest point of the outline, exact; `None` for a point that is not finite.
    #[must_use]
    pub fn nearest(&self, point: Vector2<f64>) -> Option<NearestOnSegment> {
        let (leaf, nearest) = self.nearest_segment(point)?;
        Some(self.at_vertex(point, leaf, nearest))
    }

    /// The nearest point of the outline, where something is known about a place nearby; `about` is updated for this place.
    #[must_use]
    pub fn nearest_with_cache(&self, point: Vector2<f64>, about: &mut NearestCache) -> Option<NearestOnSegment> {
        let n = self.edges.len();
        let middle = about.edge.min(n.checked_sub(1)?);
        let own = self.edges.get(middle)?.nearest(point);
        if about.edge == middle && (point - about.seen).norm() + own.left.abs() <= about.alone {
            return Some(self.at_vertex(point, middle, own));
        }
        let known = [(middle + n - 1) % n, middle, (middle + 1) % n];
        let before = self.edges.get(known[0])?.nearest(point);
        let after = self.edges.get(known[2])?.nearest(point);
        let ((mut edge, mut nearest), (_, other)) = nearer((known[0], before), (middle, own));
        let ((nearest_edge, of_three), (_, third)) = nearer((edge, nearest), (known[2], after));
        (edge, nearest) = (nearest_edge, of_three);
        let (distance, mut second) = (nearest.left.abs(), other.left.abs().min(third.left.abs()));
        let moved = (point - about.point).norm();
        if about.middle != middle || !(moved + distance <= about.clear) {
            let clear = (1.0 + ROOM) * distance;
            let found = self.nearer_than(point, clear, &known);
            let clear = found.map_or(clear, |(_, other)| other.left.abs());
            (about.middle, about.point, about.clear) = (middle, point, clear);
            // Nothing is known about the neighbours of an edge that was found.
            second = second.min(clear);
            if let Some((leaf, other)) = found.filter(|(_, other)| other.left.abs() < distance) {
                (edge, nearest) = (leaf, other);
            }
        } else {
            second = second.min(about.clear - moved);
        }
        (about.edge, about.seen, about.alone, about.to_middle) = (edge, point, second, own.left.abs());
        nearest.left.is_finite().then(|| self.at_vertex(point, edge, nearest))
    }

    /// The segment nearest to a point, with its own nearest point; `None` for a point that is not finite.
    #[must_use]
    pub fn nearest_segment(&self, point: Vector2<f64>) -> Option<(usize, NearestOnSegment)> {
        self.nearer_than(point, f64::MAX, &[])
    }

    /// The nearest of the edges that are nearer than `most`, except some that are known.
    fn nearer_than(&self, point: Vector2<f64>, most: f64, known: &[usize]) -> Option<(usize, NearestOnSegment)> {
        let from = parry(point);
        let (_, (_, found)) = self.tree.find_best(
            most,
            |node, _| node.aabb().distance_to_local_point(from, true),
            |leaf, _| {
                let index = leaf as usize;
                let nearest = self.edges.get(index).filter(|_| !known.contains(&index))?.nearest(point);
                Some((nearest.left.abs(), (index, nearest)))
            },
        )?;
        Some(found)
    }

    /// The nearest point where it is the common vertex of two segments: on which side the point lies follows from
    /// both together, and the tangent is that of the segment that is more perpendicular to the point.
    fn at_vertex(&self, point: Vector2<f64>, leaf: usize, nearest: NearestOnSegment) -> NearestOnSegment {
        let n = self.edges.len();
        let Some(own) = self.edges.get(leaf) else { return nearest };
        let (before, after) = if nearest.foot == own.start() {
            (self.edges.get((leaf + n - 1) % n), Some(own))
        } else if nearest.foot == own.end() {
            (Some(own), self.edges.get((leaf + 1) % n))
        } else {
            return nearest;
        };
        let (Some(before), Some(after)) = (before, after) else { return nearest };
        let (first, second) = (before.end_tangent(), after.start_tangent());
        let away = point - nearest.foot;
        let left = nearest.left.abs().copysign((first + second).perp(&away));
        let tangent = if first.dot(&away).abs() <= second.dot(&away).abs() { first } else { second };
        NearestOnSegment { left, foot: nearest.foot, tangent }
    }

    /// How far the outline reaches in a direction (a unit vector) from the origin, exact; `None` for an empty outline.
    #[must_use]
    pub fn farthest(&self, direction: Vector2<f64>) -> Option<f64> {
        // No box reaches farther than its corner, and the search skips boxes that cannot win.
        let (_, least) = self.tree.find_best(
            f64::MAX,
            |node, _| {
                let (low, high) = (node.aabb().mins, node.aabb().maxs);
                let x = if direction.x > 0.0 { high.x } else { low.x };
                let y = if direction.y > 0.0 { high.y } else { low.y };
                -(x * direction.x) - y * direction.y
            },
            |leaf, _| Some(-self.edges.get(leaf as usize)?.farthest(direction)),
        )?;
        Some(-least)
    }

    /// Whether the cached knowledge about a point shows that the outline comes within `reach` of it in at most one place.
    #[must_use]
    pub fn is_single_within(about: &NearestCache, point: Vector2<f64>, reach: f64) -> bool {
        let three_alone = (point - about.point).norm() + reach <= about.clear;
        point == about.seen && about.to_middle <= reach && three_alone
    }

    /// In how many separate places the outline comes within `reach` of a point. Neighbouring segments are one place.
    #[must_use]
    pub fn places_within(&self, point: Vector2<f64>, reach: f64) -> usize {
        let from = parry(point);
        let near =
            |leaf: &u32| self.edges.get(*leaf as usize).is_some_and(|edge| edge.nearest(point).left.abs() <= reach);
        let mut touching: Vec<u32> =
            self.tree.leaves(|node| node.aabb().distance_to_local_point(from, true) <= reach).filter(near).collect();
        touching.sort_unstable();
        let gaps = touching.windows(2).filter(|pair| matches!(pair, [a, b] if b - a > 1)).count();
        let closes = match (touching.first(), touching.last()) {
            (Some(0), Some(last)) => *last as usize + 1 == self.edges.len(),
            _ => false,
        };
        match touching.len() {
            0 => 0,
            _ if closes => gaps.max(1),
            _ => gaps + 1,
        }
    }
}

/// Chords per box, and boxes per larger box.
const TO_A_BOX: usize = 8;

/// The outline as chords, for parry's own distance.
pub struct Chords {
    /// Their starts; each ends where the next one begins, the last where the first does.
    points: Vec<Vector>,
    /// Boxes about every [`TO_A_BOX`] of them, and about as many of these.
    boxes: Vec<Aabb>,
    larger: Vec<Aabb>,
    /// Their number.
    pub count: usize,
    /// Largest distance of a chord from its arc, mm.
    pub sagitta: f64,
}

impl Chords {
    /// Chords within `sagitta` (mm) of the outline.
    #[must_use]
    pub fn new(contour: &Contour, sagitta: f64) -> Self {
        let mut points = Vec::new();
        let mut worst = 0.0_f64;
        #[expect(clippy::cast_precision_loss, reason = "a few thousand segments")]
        let share = MOST_CHORDS / contour.vertices.len().max(1) as f64;
        for edge in contour.edges() {
            points.push(parry(edge.start()));
            // Sagitta of a chord over the angle a: R (1 − cos(a/2)) ≈ R a²/8, from above; of a cubic curve over the share h of
            // its parameter: h²/8 of the largest second derivative, which is at an end.
            let (swept, bow) = match edge {
                Edge::Segment(segment) if segment.bulge == 0.0 => continue,
                Edge::Segment(segment) => (segment.sweep(), segment.radius().abs()),
                Edge::Cubic(cubic) => (1.0, cubic.derivatives(0.0)[2].norm().max(cubic.derivatives(1.0)[2].norm())),
            };
            let wanted = (swept.abs() * (bow / (8.0 * sagitta)).sqrt()).ceil();
            let count = wanted.clamp(1.0, share.max(1.0));
            worst = worst.max(bow * (swept / count) * (swept / count) / 8.0);
            // From the chord, so that a nearly straight arc keeps its digits.
            let places = match &edge {
                Edge::Segment(segment) => Some(segment.places()),
                Edge::Cubic(_) => None,
            };
            let mut step = 1.0;
            while step < count {
                let share = step / count;
                points
                    .push(parry(places.as_ref().map_or_else(|| edge.point_and_tangent(share), |place| place(share)).0));
                step += 1.0;
            }
        }
        let count = points.len();
        let boxes = (0..count).step_by(TO_A_BOX).map(|from| {
            // Including the end of the last of them.
            let ends = (from..=from + TO_A_BOX).filter_map(|index| end_of(&points, index));
            Aabb::from_points(ends)
        });
        let boxes: Vec<Aabb> = boxes.collect();
        let larger = boxes
            .chunks(TO_A_BOX)
            .filter_map(|boxes| boxes.iter().copied().reduce(|about, other| about.merged(&other)))
            .collect();
        Self { boxes, larger, points, count, sagitta: worst }
    }

    /// How far the chords reach in a direction (a unit vector) from the origin.
    #[must_use]
    pub fn farthest(&self, direction: Vector2<f64>) -> f64 {
        self.points.iter().map(|point| point.x * direction.x + point.y * direction.y).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Distance of a point from the chords, positive outside.
    #[must_use]
    pub fn distance(&self, point: Vector2<f64>) -> f64 {
        self.distance_when_known(point, f64::INFINITY)
    }

    /// Distance of a point from the chords, where the distance from the outline is known: farther chords are examined only if none is as near.
    #[must_use]
    pub fn distance_when_known(&self, point: Vector2<f64>, known: f64) -> f64 {
        let from = parry(point);
        let found = self.nearer_than(from, known.abs() + 2.0 * self.sagitta);
        match found.or_else(|| self.nearer_than(from, f64::INFINITY)) {
            Some(NearestChord { distance, index, place, away }) if away.dot(self.outward(index, place)) <= 0.0 => {
                -distance
            }
            found => found.map_or(f64::INFINITY, |near| near.distance),
        }
    }

    /// The nearest chord of those that are nearer than `most`.
    fn nearer_than(&self, from: Vector, most: f64) -> Option<NearestChord> {
        let mut nearest: Option<NearestChord> = None;
        for (number, larger) in self.larger.iter().enumerate() {
            let least = nearest.as_ref().map_or(most, |near| near.distance);
            if square_of_distance(larger, from) >= least * least {
                continue;
            }
            let first = TO_A_BOX * number;
            for (number, about) in (first..).zip(self.boxes.iter().skip(first).take(TO_A_BOX)) {
                let least = nearest.as_ref().map_or(most, |near| near.distance);
                if square_of_distance(about, from) >= least * least {
                    continue;
                }
                let first = TO_A_BOX * number;
                for index in first..self.count.min(first + TO_A_BOX) {
                    let Some(chord) = self.segment(index) else { continue };
                    let (projection, place) = chord.project_local_point_and_get_location(from, false);
                    let away = from - projection.point;
                    let distance = away.length();
                    if distance < nearest.as_ref().map_or(most, |near| near.distance) {
                        nearest = Some(NearestChord { distance, index, place, away });
                    }
                }
            }
        }
        nearest
    }

    /// A chord.
    fn segment(&self, index: usize) -> Option<Segment> {
        Some(Segment::new(end_of(&self.points, index)?, end_of(&self.points, index + 1)?))
    }

    /// A vector out of the metal on a chord, or at a joint one between those of its two chords.
    fn outward(&self, index: usize, place: SegmentPointLocation) -> Vector {
        match place {
            SegmentPointLocation::OnEdge(_) => self.normal(index),
            SegmentPointLocation::OnVertex(0) => self.normal(index) + self.normal(index + self.count - 1),
            SegmentPointLocation::OnVertex(_) => self.normal(index) + self.normal(index + 1),
        }
    }

    /// The unit normal of a chord out of the metal.
    fn normal(&self, index: usize) -> Vector {
        let along = self.segment(index % self.count).map(|segment| segment.b - segment.a).unwrap_or_default();
        Vector::new(along.y, -along.x) / along.length()
    }
}

/// The square of the distance of a point from a box; 0 within.
fn square_of_distance(about: &Aabb, from: Vector) -> f64 {
    let x = outside(about.mins.x, about.maxs.x, from.x);
    let y = outside(about.mins.y, about.maxs.y, from.y);
    x * x + y * y
}

/// The distance of a number from an interval; 0 within.
#[inline]
fn outside(low: f64, high: f64, at: f64) -> f64 {
    if at < low {
        low - at
    } else if at > high {
        at - high
    } else {
        0.0
    }
}

/// The nearest chord to a point.
struct NearestChord {
    distance: f64,
    index: usize,
    place: SegmentPointLocation,
    /// From the chord to the point.
    away: Vector,
}

/// The point of a closed chain at an index, the first one after the last.
fn end_of(points: &[Vector], index: usize) -> Option<Vector> {
    points.get(if index < points.len() { index } else { index - points.len() }).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Vertex;
    use std::f64::consts::TAU;

    #[test]
    fn exact_and_chordal_distances_agree_inside_and_outside() {
        let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        let slot = Contour {
            vertices: vec![at(0.0, -10.0, 0.0), at(40.0, -10.0, 1.0), at(40.0, 10.0, -0.1), at(0.0, 10.0, 1.0)],
        };
        let (surface, chords) = (EdgeTree::new(&slot), Chords::new(&slot, 1e-6));
        assert!(chords.sagitta <= 1e-6 && chords.count > 1000, "{}", chords.count);
        for (x, y) in [(20.0, 0.0), (60.0, 0.0), (-30.0, 5.0), (20.0, 30.0), (20.0, -30.0), (55.0, 20.0), (44.0, 1.0)] {
            let point = Vector2::new(x, y);
            let exact = -surface.nearest(point).expect("finite").left;
            assert!((exact - chords.distance(point)).abs() <= 1.1e-6, "({x}, {y}): {exact} {}", chords.distance(point));
        }
        assert!(surface.nearest(Vector2::new(f64::NAN, 0.0)).is_none());
    }

    /// The nearest place to a point from an edge that is known, and steps of all sizes from there, in turn, with what is known of the last.
    fn agrees(tree: &EdgeTree, point: Vector2<f64>, known: usize) {
        let wanted = tree.nearest(point).expect("finite");
        let mut about = NearestCache { edge: known, ..NearestCache::default() };
        let found = tree.nearest_with_cache(point, &mut about).expect("finite");
        assert!(about.edge < tree.edges().len(), "{point} from {known}");
        assert!((found.left.abs() - wanted.left.abs()).abs() < 1e-12, "{point} from {known}");
        assert!((point - found.foot).norm() < wanted.left.abs() + 1e-12, "{point} from {known}");
        for step in 0..24 {
            let (sin, cos) = libm::sincos(f64::from(7 * step));
            let next = point + Vector2::new(cos, sin) * libm::exp2(f64::from(step - 20));
            let wanted = tree.nearest(next).expect("finite");
            let found = tree.nearest_with_cache(next, &mut about).expect("finite");
            assert!((found.left.abs() - wanted.left.abs()).abs() < 1e-12, "{next} after {point} from {known}");
            let reach = 1.000_5 * wanted.left.abs();
            let one = EdgeTree::is_single_within(&about, next, reach);
            assert!(!one || tree.places_within(next, reach) == 1, "{next} after {point} from {known}");
        }
    }

    /// Whatever edge the search begins from, and from an invalid one: the same point is found, also at vertices and where the nearest
    /// edge lies across the outline, of few edges and of many.
    #[test]
    fn the_nearest_place_does_not_depend_on_the_edge_that_is_known() {
        let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        let slot = vec![at(0.0, -10.0, 0.0), at(40.0, -10.0, 1.0), at(40.0, 10.0, -0.1), at(0.0, 10.0, 1.0)];
        let waves = (0..60).map(|i| {
            let (turn, bulge) = (TAU * f64::from(i) / 60.0, if i % 3 == 0 { -0.08 } else { 0.05 });
            let radius = 30.0 + 12.0 * libm::sin(5.0 * turn);
            at(20.0 + radius * libm::cos(turn), radius * libm::sin(turn), bulge)
        });
        for vertices in [slot, waves.collect()] {
            let tree = EdgeTree::new(&Contour { vertices });
            let grid = (0..35)
                .flat_map(|i| (0..25).map(move |j| Vector2::new(f64::from(i) * 3.0 - 30.0, f64::from(j) * 2.0 - 25.0)));
            for point in grid.chain([Vector2::new(40.0, -10.0), Vector2::new(0.0, 10.0), Vector2::new(45.0, 20.0)]) {
                for known in [0, 1, 2, 3, 4, 5, 31, 59, 60] {
                    agrees(&tree, point, known);
                }
            }
            assert!(tree.nearest_with_cache(Vector2::new(f64::NAN, 0.0), &mut NearestCache::default()).is_none());
        }
    }

    #[test]
    fn separate_places_are_counted() {
        let at = |x: f64, y: f64| Vertex::new(Vector2::new(x, y), 0.0);
        let channel = Contour {
            vertices: vec![
                at(0.0, 0.0),
                at(9.0, 0.0),
                at(9.0, 9.0),
                at(6.0, 9.0),
                at(6.0, 3.0),
                at(3.0, 3.0),
                at(3.0, 9.0),
                at(0.0, 9.0),
            ],
        };
        let surface = EdgeTree::new(&channel);
        assert_eq!(surface.places_within(Vector2::new(4.5, 7.0), 1.6), 2, "both walls of the channel");
        assert_eq!(surface.places_within(Vector2::new(4.5, 4.5), 1.6), 1, "walls and floor are neighbours");
        assert_eq!(surface.places_within(Vector2::new(-1.0, -1.0), 2.0), 1, "round the first vertex");
        assert_eq!(surface.places_within(Vector2::new(-9.0, -9.0), 2.0), 0);
    }
}
