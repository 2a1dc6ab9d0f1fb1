//! A surface in space under a sphere, as its checks, its tables of points and its proof need it.

use camgen_kernel::geometry::boundary::Boundary;
use camgen_kernel::geometry::points::MotionErrors;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::Curves;
use nalgebra::{Vector2, Vector3};

/// The sphere on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialContact {
    /// Centre of the sphere, m.
    pub centre: Vector3<f64>,
    /// Unit normal out of the metal.
    pub normal: Vector3<f64>,
    /// Point of contact, m.
    pub point: Vector3<f64>,
    /// Slope of the lift along the axis.
    pub slope: f64,
}

/// A break of the law nearer than this, rad, belongs to the piece on the side that is looked at.
pub const BESIDE: f64 = 1e-6;
/// Errors of velocity and acceleration at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateErrors {
    /// Error of the velocity, m/rad.
    pub velocity: f64,
    /// Error of the acceleration, m/rad².
    pub acceleration: f64,
    /// The cam angle there, rad.
    pub at: f64,
}

/// Place, first and second derivatives of a surface by the cam angle and along the axis, m.
pub type PitchPoint = (Vector3<f64>, [Vector3<f64>; 2], [Vector3<f64>; 3]);

/// A point (m), a tangent and a curvature (1/m).
pub type Heading = (Vector2<f64>, Vector2<f64>, f64);

/// The surface at one cam angle, for places along the axis.
pub trait AtAngle {
    /// Where the sphere at a place along the axis, m, touches.
    fn contact(&self, z: f64) -> SpatialContact;

    /// The sphere that touches the cut at a place along the axis, m, and its own place; `None` where the surface folds along the axis.
    fn of_cut(&self, z: f64) -> Option<SpatialContact>;
}

/// The surface of a cam whose sections differ, of a clockwise cam, under the sphere of a roller.
pub trait Surface: Sync {
    /// Radius of the sphere, and offset of its path from the shaft, m.
    fn sphere(&self) -> [f64; 2];

    /// Lower and upper end of the cam, m.
    fn ends(&self) -> (f64, f64);

    /// Places along the axis at which it is looked at, m.
    fn slices(&self) -> Vec<f64>;

    /// The law in a plane across the axis, m.
    fn law(&self, z: f64) -> Box<dyn Motion + '_>;

    /// Calls `done` with motion and follower in a plane across the axis, m, as if the roller were a disc in it.
    fn in_plane(&self, z: f64, done: &mut dyn FnMut(Curves<'_>));

    /// The surface at a cam angle of a piece, for one place along the axis or a few.
    fn at(&self, piece: usize, angle: f64) -> Box<dyn AtAngle + '_>;

    /// The surface at a cam angle of a piece, for many places along the axis.
    fn at_for_many(&self, piece: usize, angle: f64) -> Box<dyn AtAngle + Send + Sync + '_>;

    /// The place of the sphere's centre and its derivatives.
    fn pitch(&self, piece: usize, angle: f64, z: f64) -> PitchPoint;

    /// Errors of a heading in place of the exact cut at a place along the axis, m; the law is taken this far inwards from its cam angle, rad. `None` where
    /// there is no such place.
    fn rate_errors(&self, z: f64, heading: Heading, inwards: f64) -> Option<RateErrors>;

    /// The exact cut, mm, at a place along the axis, m.
    fn cut_at(&self, z: f64) -> Boundary<'_>;

    /// The exact path of the sphere's centre, mm, with the cam at a place along the axis, m.
    fn centre_at(&self, z: f64) -> Boundary<'_>;

    /// The follower on tables of the cut at a place along the axis, m, or of that path.
    fn motion_errors(&self, z: f64, centre: bool) -> Box<dyn MotionErrors + '_>;
}
