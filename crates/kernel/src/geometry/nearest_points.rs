//! Distances between points.

use nalgebra::Vector2;
use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry2d_f64::query::PointQuery;

/// The distance of each point from the nearest other one; infinite for a single point.
#[must_use]
pub fn nearest_distances(points: &[Vector2<f64>]) -> Vec<f64> {
    let boxes: Vec<Aabb> = points.iter().map(|point| Aabb::new(parry(point), parry(point))).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    points.iter().enumerate().map(|(index, point)| distance_to_others(&tree, points, index, point)).collect()
}

fn parry(point: &Vector2<f64>) -> Vector {
    Vector::new(point.x, point.y)
}

fn distance_to_others(tree: &Bvh, points: &[Vector2<f64>], index: usize, point: &Vector2<f64>) -> f64 {
    let nearest = tree.find_best(
        f64::MAX,
        |node, _| node.aabb().distance_to_local_point(parry(point), true),
        |leaf, _| {
            let other = points.get(leaf as usize).filter(|_| leaf as usize != index)?;
            Some((other - point).norm())
        },
    );
    nearest.map_or(f64::INFINITY, |(_, distance)| distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_to_the_nearest_of_all() {
        let at = |i: u32, share: f64| (f64::from(i) * share).fract();
        let mut points: Vec<Vector2<f64>> =
            (0..300).map(|i| Vector2::new(at(i, 0.618_034), at(i, 0.754_878))).collect();
        // Coincident points, and one far away.
        points.extend([Vector2::new(0.5, 0.5); 20]);
        points.push(Vector2::new(90.0, 0.0));
        let found = nearest_distances(&points);
        for (index, point) in points.iter().enumerate() {
            let others = points.iter().enumerate().filter(|(other, _)| *other != index);
            let expected = others.map(|(_, other)| (other - point).norm()).fold(f64::INFINITY, f64::min);
            assert_eq!(found[index], expected, "{index}");
        }
        assert_eq!(nearest_distances(&points[..1]), [f64::INFINITY]);
        assert!(nearest_distances(&[]).is_empty());
    }
}
