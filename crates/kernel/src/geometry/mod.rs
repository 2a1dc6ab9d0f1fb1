//! Plane and solid geometry: points of curves with their curvature, chains of arcs and lines, the fit of arcs, solids.
//!
//! It does not know motions, followers or machines. Curves are functions in any unit of length; contours and solids are in
//! millimetres.

mod allowed;
pub mod arcs;
pub mod biarcs;
pub mod blocks;
pub mod boundary;
pub mod chain_distance;
mod chain_start;
pub mod clearance;
pub mod contour;
mod cubic;
mod cubic_path;
pub mod cubics;
mod curve_point;
mod edge;
mod edge_path;
pub mod edge_tree;
mod entity;
pub mod following;
pub mod lead_in;
pub mod nearest_points;
pub mod nurbs;
pub mod patch_fit;
pub mod points;
pub mod polar;
pub mod registration;
pub mod section;
mod segment;
pub mod solid;
pub mod two_sided_distance;

pub use allowed::ChainTolerance;
pub use curve_point::{CurvePoint, left_of, rotated};
pub use entity::Entity;

/// Millimetres in a metre: geometry leaves SI by this factor.
pub const MILLIMETRES: f64 = 1e3;

/// Curvature below which a curve is straight, 1/m; rounding of a straight cam flank is about 1e-14.
pub const STRAIGHT: f64 = 1e-9;

/// Radius of curvature, mm, with the sign of `curvature`, 1/m; infinite if straight.
#[must_use]
pub fn radius_of_curvature(curvature: f64) -> f64 {
    if curvature.abs() < STRAIGHT { f64::INFINITY } else { MILLIMETRES / curvature }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_curve_has_infinite_radius_of_either_sign() {
        for curvature in [0.0, -0.0, 7e-15, -7e-15] {
            assert_eq!(radius_of_curvature(curvature), f64::INFINITY, "{curvature}");
        }
        assert_eq!([radius_of_curvature(10.0), radius_of_curvature(-10.0)], [100.0, -100.0]);
        assert!(radius_of_curvature(f64::NAN).is_nan());
    }
}
