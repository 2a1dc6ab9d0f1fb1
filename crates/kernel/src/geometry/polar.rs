//! Where a curve crosses a ray from the origin.

use super::contour::{Contour, Edge};
use nalgebra::Vector2;

/// Parts of an edge that are looked at one by one.
const PARTS: u32 = 8;
/// Halvings of a part: below the resolution of its parameter.
const HALVINGS: u32 = 52;

/// The parameter between `a` and `b` at which a curve crosses the ray of a direction (a unit vector), where its two ends lie on either side of
/// the line through that ray.
pub fn crossing(
    point: impl Fn(f64) -> Vector2<f64>,
    [a, b]: [f64; 2],
    [at_a, at_b]: [Vector2<f64>; 2],
    direction: Vector2<f64>,
) -> Option<f64> {
    let starts_left = direction.perp(&at_a) >= 0.0;
    if starts_left == (direction.perp(&at_b) >= 0.0) || direction.dot(&(at_a + at_b)) <= 0.0 {
        return None;
    }
    let (mut from, mut to) = (a, b);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if (direction.perp(&point(middle)) >= 0.0) == starts_left {
            from = middle;
        } else {
            to = middle;
        }
    }
    Some(0.5 * (from + to))
}

/// Distance from the origin, mm, at which a contour is crossed last by the ray of each direction (unit vectors); `None` where it is not.
#[must_use]
pub fn outermost(contour: &Contour, directions: &[Vector2<f64>]) -> Vec<Option<f64>> {
    let edges: Vec<(Edge, f64)> = contour.edges().map(|edge| (edge, edge.length())).collect();
    let distances = directions.iter().map(|direction| {
        // An edge does not reach farther from its start than its length.
        let near = edges.iter().filter(|(edge, length)| direction.perp(&edge.start()).abs() <= *length);
        near.filter_map(|(edge, _)| of_edge(edge, *direction)).reduce(f64::max)
    });
    distances.collect()
}

fn of_edge(edge: &Edge, direction: Vector2<f64>) -> Option<f64> {
    let crossings = (0..PARTS).filter_map(|index| {
        let shares = [index, index + 1].map(|end| f64::from(end) / f64::from(PARTS));
        // The ends of neighbours are the same to the last digit: a ray through a vertex crosses one of them.
        let start = if index == 0 { edge.start() } else { edge.point_and_tangent(shares[0]).0 };
        let end = if index + 1 == PARTS { edge.end() } else { edge.point_and_tangent(shares[1]).0 };
        let share = crossing(|share| edge.point_and_tangent(share).0, shares, [start, end], direction)?;
        Some(direction.dot(&edge.point_and_tangent(share).0))
    });
    crossings.reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle off the origin: R = e cos ψ + √(r² − e² sin² ψ) in closed form; one that does not hold the origin is met only ahead of it.
    #[test]
    fn a_circle_is_crossed_where_the_closed_form_says() {
        let (centre, radius) = (7.0, 30.0);
        let circle = Contour::circle(Vector2::new(centre, 0.0), radius);
        let angles: Vec<f64> = (0..72).map(|index| f64::from(5 * index).to_radians()).collect();
        let rays: Vec<Vector2<f64>> = angles.iter().map(|a| Vector2::new(libm::cos(*a), libm::sin(*a))).collect();
        for (angle, found) in angles.iter().zip(outermost(&circle, &rays)) {
            let (sin, cos) = libm::sincos(*angle);
            let known = centre * cos + (radius * radius - centre * centre * sin * sin).sqrt();
            let found = found.expect("the ray leaves the circle");
            assert!((found - known).abs() < 1e-11, "{angle}: {found} {known}");
        }
        // Through the vertices of a circle of two half arcs.
        let ends = outermost(&Contour::circle(Vector2::zeros(), radius), &[Vector2::x(), -Vector2::x()]);
        assert!(ends.iter().all(|end| (end.expect("through a vertex") - radius).abs() < 1e-11), "{ends:?}");
        let ahead = Contour::circle(Vector2::new(50.0, 0.0), 10.0);
        let found = outermost(&ahead, &[Vector2::x(), -Vector2::x(), Vector2::y()]);
        assert!((found[0].expect("ahead") - 60.0).abs() < 1e-11);
        assert_eq!((found[1], found[2]), (None, None));
    }
}
