//! Tables of points for a control that interpolates between them: as many points as a tolerance requires, and the proof that
//! they keep it.
//!
//! A table represents the curve that the control makes of it ([`Interpolant`]), and that curve is compared with the exact one
//! ([`ExactPath`]) over its whole length ([`deviations`]). So the number of points is not estimated: a table is tried, its error bounded,
//! and its places are changed until the fewest points remain that keep the tolerance ([`place`]). A table may have to keep errors of
//! velocity and acceleration in addition to the distance; these
//! are computed by the caller, who knows the follower ([`MotionErrors`]).

mod deviation;
mod interpolant;
mod path;
mod placing;

pub use deviation::deviations;
pub use interpolant::Interpolant;
pub use path::ExactPath;
pub use placing::place;

use crate::document::NamedChoice;
use crate::geometry::CurvePoint;
use crate::refusal::Refusal;

/// The coordinates of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointCoordinates {
    /// Polar angle and distance from the shaft.
    Polar,
    /// x and y.
    Plane,
}

impl NamedChoice for PointCoordinates {
    const ALL: &'static [(&'static str, Self)] = &[("polar", Self::Polar), ("xy", Self::Plane)];
}

/// How the places of the points are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointStep {
    /// At equal angles about the shaft.
    Angle,
    /// With equal error in every interval.
    Chord,
}

impl NamedChoice for PointStep {
    const ALL: &'static [(&'static str, Self)] = &[("angle", Self::Angle), ("chord", Self::Chord)];
}

/// How the control interpolates between two points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointInterpolation {
    /// By coordinates that are linear in the parameter.
    Linear,
    /// By cubic splines.
    Cubic,
}

impl NamedChoice for PointInterpolation {
    const ALL: &'static [(&'static str, Self)] = &[("linear", Self::Linear), ("cubic", Self::Cubic)];
}

impl PointInterpolation {
    /// The power of the interval with which the distance from a smooth curve grows.
    fn order(self) -> f64 {
        match self {
            PointInterpolation::Linear => 2.0,
            PointInterpolation::Cubic => 4.0,
        }
    }

    /// The power of the interval with which the errors of heading and curvature grow, which are the follower's velocity and acceleration.
    fn orders(self) -> [f64; 2] {
        match self {
            // A chord has no curvature however short it is: no power helps.
            PointInterpolation::Linear => [1.0, 1.0],
            PointInterpolation::Cubic => [3.0, 2.0],
        }
    }
}

/// The errors of a follower's motion on a curve that represents the exact one.
pub trait MotionErrors: std::fmt::Debug + Sync {
    /// The largest sizes of the errors of velocity and acceleration in each interval, m or rad per rad and rad² of the shaft that
    /// gives the time; 0 in an interval without length and where they are not wanted, infinite where the follower cannot follow.
    /// The intervals after one with an error above its `limit` are left out.
    fn errors(&self, curve: &Interpolant, wanted: [bool; 2], limit: [f64; 2]) -> Vec<[f64; 2]>;

    /// The step of the exact acceleration at a point of the exact curve (mm), at least 0, m or rad per rad².
    fn step(&self, at: &CurvePoint) -> f64;
}

/// Largest errors that a follower may have on a table.
#[derive(Debug, Clone, Copy)]
pub struct MotionLimit<'a> {
    /// It computes the errors.
    pub motion: &'a dyn MotionErrors,
    /// Largest errors of velocity and acceleration, m or rad per rad and rad², above 0; infinite where they do not matter.
    pub allowed: [f64; 2],
}

impl MotionLimit<'_> {
    /// Whether an acceleration must be kept.
    fn keeps_acceleration(&self) -> bool {
        self.allowed[1].is_finite()
    }

    /// The errors in each interval; if `brief`, up to the first that is not allowed.
    fn errors(&self, curve: &Interpolant, brief: bool) -> Vec<[f64; 2]> {
        self.motion.errors(curve, self.wanted(), if brief { self.allowed } else { [f64::INFINITY; 2] })
    }

    /// Whether a list of errors is complete and within the limits; errors that are not numbers are not.
    fn keeps(&self, errors: &[[f64; 2]], intervals: usize) -> bool {
        errors.len() == intervals
            && errors.iter().all(|errors| errors.iter().zip(self.allowed).all(|(error, allowed)| *error <= allowed))
    }

    /// Which errors matter.
    fn wanted(&self) -> [bool; 2] {
        self.allowed.map(f64::is_finite)
    }
}

/// The required form of a table, and its tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointTableSpec {
    /// Coordinates.
    pub form: PointCoordinates,
    /// Choice of places.
    pub step: PointStep,
    /// Interpolation.
    pub between: PointInterpolation,
    /// Largest distance between the interpolated curve and the exact one, mm.
    pub tolerance: f64,
}

/// The rows of a table, rounded as they are written.
#[derive(Debug, Clone, PartialEq)]
pub struct PointRows {
    /// Polar angle in degrees and distance from the shaft in mm, or x and y in mm. Those of a closed curve end with the first
    /// point again; where one cubic spline ends and the next begins a row occurs twice.
    pub rows: Vec<[f64; 2]>,
    /// Place of each row on the exact curve, as a length from its start, mm.
    pub places: Vec<f64>,
    /// Corners of the curve.
    pub corners: usize,
    /// Places without a corner at which one cubic spline ends and the next begins, since the acceleration jumps there.
    pub jumps: usize,
    /// Intervals between them, double rows not counted.
    pub intervals: usize,
    /// Bound of the distance between the interpolated curve and the exact one, in both directions, mm.
    pub error: f64,
}

/// Why there is no table.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointsError {
    /// The tolerances of the follower's motion need more points than a table may have.
    #[error(
        "no table of up to {most} points keeps the errors of velocity and acceleration; give a larger --tolerance-velocity or \
         --tolerance-acceleration, or leave them out"
    )]
    TooManyForMotion {
        /// Most points that were tried.
        most: usize,
    },
    /// Of any other cause: the curve does not go round the shaft, or needs more points than a table may have.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl From<PointsError> for Refusal {
    fn from(error: PointsError) -> Self {
        match error {
            PointsError::Refused(refusal) => refusal,
            other => Self::of(other),
        }
    }
}

/// That the curve has no single point at a polar angle (degrees) about the shaft.
fn not_around(polar_deg: f64) -> Refusal {
    Refusal::new(
        "the angle about the shaft does not determine the points of the curve, which turns back as seen from the shaft",
    )
    .at(format!("a polar angle of {polar_deg:.3} deg"))
    .remedy("give x and y by equal chord error (--points-as xy --points-step chord)")
}

/// That the tolerance (mm) needs more points than a table may have.
fn too_many(tolerance_mm: f64, most: usize) -> Refusal {
    Refusal::new(format!("{tolerance_mm} mm would need more than {most} points")).remedy(
        "give a larger --tolerance, equal chord error (--points-step chord) or cubic interpolation \
         (--points-between cubic)",
    )
}

#[cfg(test)]
mod tests;
