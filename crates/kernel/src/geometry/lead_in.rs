//! The path on which a tool comes to the start of an outline: tangent to it there, so that it leaves no mark, and clear of the metal.

use super::contour::Contour;
use super::edge::Edge;
use super::edge_tree::EdgeTree;
use super::left_of;
use super::segment::Segment;
use crate::document::NamedChoice;
use nalgebra::Vector2;
use std::f64::consts::FRAC_PI_8;

/// The form of a lead-in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeadInForm {
    /// A straight line.
    Tangent,
    /// A quarter of a circle.
    Arc,
}

impl NamedChoice for LeadInForm {
    const ALL: &'static [(&'static str, Self)] = &[("tangent", Self::Tangent), ("arc", Self::Arc)];
}

/// A lead-in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeadIn {
    /// Its form.
    pub form: LeadInForm,
    /// Length of a line, or radius of an arc, m.
    pub size: f64,
}

/// Smallest step along a lead-in, over its length.
const LEAST_STEP: f64 = 1e-4;

/// The lead-in of a size in mm to the start of a chain that has the metal on its left; it ends there.
#[must_use]
pub fn segment(contour: &Contour, form: LeadInForm, size: f64) -> Option<Segment> {
    let first = contour.edges().next()?;
    let (end, along) = (first.start(), first.start_tangent());
    let outward = Vector2::new(along.y, -along.x);
    Some(match form {
        LeadInForm::Tangent => Segment { start: end - along * size, end, bulge: 0.0 },
        // About a centre outside of the metal, which it turns round to the right.
        LeadInForm::Arc => Segment { start: end + (outward - along) * size, end, bulge: -libm::tan(FRAC_PI_8) },
    })
}

/// How deep an edge cuts into the metal on the left of a chain, mm, 0 if it stays outside; found to within `fine` (mm).
#[must_use]
pub fn depth(tree: &EdgeTree, edge: &Edge, fine: f64) -> f64 {
    depth_of_disc(tree, edge, 0.0, fine)
}

/// How deep a disc of a radius (mm), whose centre moves along an edge, cuts into the metal on the left of a chain, mm, 0 if it stays outside; found to
/// within `fine` (mm).
#[must_use]
pub fn depth_of_disc(tree: &EdgeTree, edge: &Edge, radius: f64, fine: f64) -> f64 {
    // No point is farther from another than this times the difference of their shares.
    let length = match edge {
        Edge::Segment(segment) => segment.length(),
        Edge::Cubic(cubic) => cubic.legs().iter().map(|leg| 3.0 * leg.norm()).fold(0.0, f64::max),
    };
    let left_of = |point: Vector2<f64>| tree.nearest(point).map_or(f64::NEG_INFINITY, |nearest| nearest.left);
    let mut deepest = left_of(edge.start()).max(-radius);
    let mut along = 0.0;
    // A point is at most the way to it nearer to the metal than another one.
    while along <= length && length > 0.0 {
        let left = left_of(edge.point_and_tangent(along / length).0);
        deepest = deepest.max(left);
        along += (deepest - left).max(fine).max(LEAST_STEP * length);
    }
    radius + deepest
}

/// The path of the centre of a cutter of a radius (mm) along a way in to a profile whose first segment takes up the compensation: it begins on the way
/// and ends beside it, on the left if `side` is 1, on the right if it is −1. The others are parallels.
#[must_use]
pub fn path_of_centre(way: &[Segment], side: f64, radius: f64) -> Vec<Segment> {
    let away = side * radius;
    let Some((first, rest)) = way.split_first() else { return Vec::new() };
    let next = rest.first().map_or_else(|| first.end_tangent(), Segment::start_tangent);
    let mut path = vec![Segment { end: first.end + left_of(next) * away, bulge: 0.0, ..*first }];
    path.extend(rest.iter().map(|segment| Segment {
        start: segment.start + left_of(segment.start_tangent()) * away,
        end: segment.end + left_of(segment.end_tangent()) * away,
        bulge: segment.bulge,
    }));
    path
}

/// A way in the other sense.
#[must_use]
pub fn reversed(way: &[Segment]) -> Vec<Segment> {
    way.iter().rev().map(|segment| Segment { start: segment.end, end: segment.start, bulge: -segment.bulge }).collect()
}

/// How deep a cutter of a radius (mm) cuts into the metal of any of the chains along paths of its centre, mm.
#[must_use]
pub fn depth_along(trees: &[EdgeTree], centre: &[Segment], radius: f64, fine: f64) -> f64 {
    let depths = trees.iter().map(|tree| {
        let depths = centre.iter().map(|segment| depth_of_disc(tree, &Edge::Segment(*segment), radius, fine));
        depths.fold(0.0, f64::max)
    });
    depths.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Vertex;

    fn depth_of(contour: &Contour, lead_in: Segment) -> f64 {
        depth(&EdgeTree::new(contour), &Edge::Segment(lead_in), 1e-4)
    }

    #[test]
    fn both_forms_arrive_in_the_direction_of_the_cut() {
        let circle = Contour::circle(Vector2::new(3.0, -2.0), 20.0);
        for form in [LeadInForm::Tangent, LeadInForm::Arc] {
            let lead_in = segment(&circle, form, 5.0).expect("a chain");
            assert_eq!(lead_in.end, Vector2::new(23.0, -2.0));
            assert!((lead_in.end_tangent() - Vector2::y()).norm() < 1e-12, "{form:?}");
            assert!(depth_of(&circle, lead_in) < 1e-9, "{form:?}");
        }
        let arc = segment(&circle, LeadInForm::Arc, 5.0).expect("a chain");
        assert!((arc.centre() - Vector2::new(28.0, -2.0)).norm() < 1e-12 && (arc.radius() + 5.0).abs() < 1e-12);
        assert!((arc.start - Vector2::new(28.0, -7.0)).norm() < 1e-12);
    }

    /// A line to the foot of a step crosses what stands beside it: 4 mm deep in a block of 10 mm.
    #[test]
    fn a_lead_in_through_the_metal_is_measured() {
        let at = |x: f64, y: f64| Vertex::new(Vector2::new(x, y), 0.0);
        // An L: the start lies in its inner corner, and runs away from the upright part.
        let block = Contour {
            vertices: vec![
                at(0.0, 10.0),
                at(-30.0, 10.0),
                at(-30.0, 0.0),
                at(40.0, 0.0),
                at(40.0, 30.0),
                at(32.0, 30.0),
                at(32.0, 10.0),
            ],
        };
        let short = segment(&block, LeadInForm::Tangent, 30.0).expect("a chain");
        assert!(depth_of(&block, short) < 1e-9);
        let through = segment(&block, LeadInForm::Tangent, 36.0).expect("a chain");
        let found = depth_of(&block, through);
        assert!((found - 4.0).abs() < 2e-3, "{found}");
    }
}
