//! The least distance between two closed chains that are cut: a hole within an outline, or two holes.
//!
//! Where two chains are nearest to each other, or reach farthest into each other, one of the two places is a vertex, or both lie on their common
//! normal. On an arc that is the line to the centre of the other arc, or across the other line.

use super::contour::{Contour, Edge, Segment};
use super::edge_tree::EdgeTree;
use crate::numeric::extremum;
use nalgebra::Vector2;

/// The least distance of two chains, mm: negative where they overlap, by how far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance {
    /// The distance.
    pub distance: f64,
    /// The place on the first chain, mm.
    pub at: Vector2<f64>,
}

/// Cells of a cubic curve in which its nearest place is searched, and golden sections.
const CELLS: u32 = 8;
const SECTIONS: u32 = 60;

/// On which side of a chain another must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Inside,
    Outside,
}

/// The metal between an outline and a hole within it, both counter-clockwise; `None` where a chain has no edge.
#[must_use]
pub fn around(outline: &Contour, hole: &Contour) -> Option<Clearance> {
    least(outline, Side::Outside, hole, Side::Inside)
}

/// The metal between two holes, both counter-clockwise.
#[must_use]
pub fn between(one: &Contour, other: &Contour) -> Option<Clearance> {
    least(one, Side::Outside, other, Side::Outside)
}

/// Each chain with the side on which it lies of the other one.
fn least(first: &Contour, of_second: Side, second: &Contour, of_first: Side) -> Option<Clearance> {
    let (outer, inner) = (EdgeTree::new(first), EdgeTree::new(second));
    let from_second = |point: Vector2<f64>| distance(&inner, of_second, point);
    let mut found: Vec<Clearance> = Vec::new();
    for vertex in &second.vertices {
        let at = outer.nearest(vertex.point).map_or(vertex.point, |nearest| nearest.foot);
        found.push(Clearance { distance: distance(&outer, of_first, vertex.point), at });
    }
    let mut least = f64::INFINITY;
    for vertex in &first.vertices {
        let distance = from_second(vertex.point);
        least = least.min(distance);
        found.push(Clearance { distance, at: vertex.point });
    }
    for edge in outer.edges() {
        // A distance changes no faster than the place.
        let possible = 0.5 * (from_second(edge.start()) + from_second(edge.end()) - edge.length());
        if possible > least {
            continue;
        }
        for at in places_on(edge, inner.edges(), &from_second) {
            let distance = from_second(at);
            least = least.min(distance);
            found.push(Clearance { distance, at });
        }
    }
    let best = found.into_iter().reduce(|best, next| if next.distance < best.distance { next } else { best });
    best.filter(|best| best.distance.is_finite())
}

/// The distance of a point from a chain, positive on a side of it, mm.
fn distance(tree: &EdgeTree, side: Side, point: Vector2<f64>) -> f64 {
    // To the left of a counter-clockwise chain is its inside.
    let left = tree.nearest(point).map_or(f64::NAN, |nearest| nearest.left);
    if side == Side::Inside { left } else { -left }
}

/// The places between the ends of an edge that may be nearest to other edges.
fn places_on(edge: &Edge, others: &[Edge], distance: &impl Fn(Vector2<f64>) -> f64) -> Vec<Vector2<f64>> {
    let Some(segment) = edge.segment() else {
        let nearest = extremum::largest_without_slope(
            |share| -distance(edge.point_and_tangent(share).0),
            (0.0, 1.0),
            CELLS,
            SECTIONS,
        );
        return vec![edge.point_and_tangent(nearest.at).0];
    };
    others.iter().flat_map(|other| on_common_normals(&segment, other)).collect()
}

/// The places of an arc or a line whose normal is one of another edge, too, or passes through its ends.
fn on_common_normals(segment: &Segment, other: &Edge) -> Vec<Vector2<f64>> {
    let other = other.segment();
    let middle = other.as_ref().and_then(|of| (of.bulge != 0.0).then(|| of.centre()));
    if segment.bulge == 0.0 {
        return middle.map(|middle| segment.nearest(middle).foot).into_iter().collect();
    }
    let (own, radius) = (segment.centre(), segment.radius().abs());
    let direction = match (middle, other) {
        (Some(middle), _) => middle - own,
        (None, Some(line)) => {
            let along = line.end - line.start;
            Vector2::new(-along.y, along.x)
        }
        (None, None) => return Vec::new(),
    };
    if direction.norm_squared() == 0.0 {
        return Vec::new();
    }
    let across = direction.normalize() * radius;
    // An arc lies to the right of its chord when it turns left, and vice versa.
    let on_arc =
        |point: &Vector2<f64>| (segment.end - segment.start).perp(&(point - segment.start)) * segment.bulge <= 0.0;
    [own + across, own - across].into_iter().filter(on_arc).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Vertex;

    fn polygon(points: &[(f64, f64)]) -> Contour {
        Contour { vertices: points.iter().map(|(x, y)| Vertex::new(Vector2::new(*x, *y), 0.0)).collect() }
    }

    #[test]
    fn circles_within_circles_are_as_far_apart_as_known() {
        let outline = Contour::circle(Vector2::zeros(), 20.0);
        for (x, y, radius) in [(0.0, 0.0, 15.0), (3.0, 4.0, 10.0), (-12.0, 5.0, 2.0), (0.0, 18.0, 5.0)] {
            let hole = Contour::circle(Vector2::new(x, y), radius);
            let known = 20.0 - libm::hypot(x, y) - radius;
            let found = around(&outline, &hole).expect("a distance");
            assert!((found.distance - known).abs() < 1e-12, "{found:?} {known}");
            assert!((found.at.norm() - 20.0).abs() < 1e-12);
        }
    }

    /// Of two holes that overlap the farthest place of one within the other counts, with a minus.
    #[test]
    fn holes_beside_each_other_and_in_each_other() {
        let one = Contour::circle(Vector2::zeros(), 3.0);
        for (x, known) in [(8.0, 3.0), (5.0, 0.0), (4.0, -1.0)] {
            let other = Contour::circle(Vector2::new(x, 0.0), 2.0);
            let found = between(&one, &other).expect("a distance").distance;
            assert!((found - known).abs() < 1e-12, "{x}: {found}");
        }
    }

    /// A slot whose corners are nearest, or whose straight bottom is.
    #[test]
    fn corners_and_lines_count() {
        let outline = Contour::circle(Vector2::zeros(), 20.0);
        let slot = polygon(&[(-4.0, -4.0), (12.0, -4.0), (12.0, 4.0), (-4.0, 4.0)]);
        let found = around(&outline, &slot).expect("a distance").distance;
        assert!((found - (20.0 - libm::hypot(12.0, 4.0))).abs() < 1e-12, "{found}");
        let square = polygon(&[(-10.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-10.0, 10.0)]);
        let found = around(&square, &Contour::circle(Vector2::new(2.0, 1.0), 5.0)).expect("a distance").distance;
        assert!((found - 3.0).abs() < 1e-12, "{found}");
        // The edge of a square that cuts into a circle between its corners.
        let cut = around(&square, &Contour::circle(Vector2::new(7.0, 0.0), 5.0)).expect("a distance").distance;
        assert!((cut + 2.0).abs() < 1e-12, "{cut}");
    }
}
