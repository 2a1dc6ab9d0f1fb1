//! Plane and solid geometry: points of curves with their curvature, chains of arcs and lines, the fit of arcs, solids.
//!
//! Knows nothing of motions, followers or machines. Curves are functions in any unit of length; contours and solids are in
//! millimetres.

mod allowed;
pub mod apart;
pub mod arcs;
pub mod boundary;
pub mod contour;
mod course;
mod cubic;
mod cubic_course;
pub mod cubics;
mod curve_point;
mod edge;
mod entity;
pub mod following;
pub mod likeness;
pub mod mismatch;
pub mod nurbs;
pub mod points;
mod segment;
pub mod solid;
pub mod track;

pub use allowed::Allowed;
pub use curve_point::CurvePoint;
pub use entity::Entity;

/// Millimetres in a metre: geometry leaves SI by this factor.
pub const MILLIMETRES: f64 = 1e3;
