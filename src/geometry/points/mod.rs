//! Tables of points for a control that interpolates between them: as many as it takes to keep a tolerance, and the proof that
//! they do.
//!
//! A table stands for the curve that the control makes of it ([`Interpolant`]), and that curve is held against the exact one
//! ([`Path`]) over its whole length ([`deviations`]). So the number of points is not estimated: a table is tried, its error bounded,
//! and its places are changed until the fewest are left that keep the tolerance ([`place`]). A table may have to keep errors of velocity and acceleration beside the distance;
//! they are told by whoever knows the follower ([`Feel`]).

mod deviation;
mod interpolant;
mod path;
mod placing;

pub use deviation::deviations;
pub use interpolant::Interpolant;
pub use path::Path;
pub use placing::place;

use crate::geometry::CurvePoint;

/// The coordinates of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Polar angle and distance from the shaft.
    Polar,
    /// x and y.
    Plane,
}

/// How the places of the points are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// At equal angles about the shaft.
    Angle,
    /// So that every interval takes the same share of the tolerance.
    Chord,
}

/// How the control interpolates between two points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Between {
    /// By coordinates that are linear in the parameter.
    Linear,
    /// By cubic splines.
    Cubic,
}

impl Between {
    /// The power of the interval with which the distance from a smooth curve grows.
    fn order(self) -> f64 {
        match self {
            Between::Linear => 2.0,
            Between::Cubic => 4.0,
        }
    }

    /// The same for the errors of heading and curvature, which a follower feels as velocity and acceleration.
    fn orders(self) -> [f64; 2] {
        match self {
            // The curvature of a chord is none however short it is: no power helps.
            Between::Linear => [1.0, 1.0],
            Between::Cubic => [3.0, 2.0],
        }
    }
}

/// What a follower feels of a curve that stands for the exact one.
pub trait Feel: std::fmt::Debug + Sync {
    /// The largest sizes of the errors of velocity and acceleration in each interval, m or rad per rad and rad² of the shaft that
    /// gives the time; 0 in an interval without length and where they are not wanted, infinite where the follower cannot follow.
    /// Nothing is told of the intervals behind one with an error above its `limit`.
    fn errors(&self, curve: &Interpolant, wanted: [bool; 2], limit: [f64; 2]) -> Vec<[f64; 2]>;

    /// The step of the exact acceleration at a point of the exact curve (mm), at least 0, m or rad per rad².
    fn step(&self, at: &CurvePoint) -> f64;
}

/// What a follower may feel of a table.
#[derive(Debug, Clone, Copy)]
pub struct Felt<'a> {
    /// It tells what it feels.
    pub feel: &'a dyn Feel,
    /// Largest errors of velocity and acceleration, m or rad per rad and rad², above 0; infinite where they do not matter.
    pub allowed: [f64; 2],
}

impl Felt<'_> {
    /// Whether an acceleration must be kept.
    fn keeps_acceleration(&self) -> bool {
        self.allowed[1].is_finite()
    }

    /// What it feels in each interval; if it is to be `brief`, up to the first that it may not.
    fn errors(&self, curve: &Interpolant, brief: bool) -> Vec<[f64; 2]> {
        self.feel.errors(curve, self.wanted(), if brief { self.allowed } else { [f64::INFINITY; 2] })
    }

    /// Whether a list of errors is whole and within what is allowed; errors that are no numbers are not.
    fn keeps(&self, errors: &[[f64; 2]], intervals: usize) -> bool {
        let within = |errors: &[f64; 2]| errors.iter().zip(self.allowed).all(|(error, allowed)| *error <= allowed);
        errors.len() == intervals && errors.iter().all(within)
    }

    /// Which errors matter.
    fn wanted(&self) -> [bool; 2] {
        self.allowed.map(f64::is_finite)
    }
}

/// What a table is to be, and the distance that it is to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wish {
    /// Coordinates.
    pub form: Form,
    /// Choice of places.
    pub step: Step,
    /// Interpolation.
    pub between: Between,
    /// Largest distance between the interpolated curve and the exact one, mm.
    pub tolerance: f64,
}

/// The rows of a table, rounded as they are written.
#[derive(Debug, Clone, PartialEq)]
pub struct Rows {
    /// Polar angle in degrees and distance from the shaft in mm, or x and y in mm. Those of a closed curve end with the first
    /// point again; where one cubic spline ends and the next begins a row stands twice.
    pub rows: Vec<[f64; 2]>,
    /// Where each of them lies on the exact curve, as a length from its start, mm.
    pub places: Vec<f64>,
    /// Corners of the curve.
    pub corners: usize,
    /// Places without a corner at which one cubic spline ends and the next begins, since the acceleration jumps there.
    pub jumps: usize,
    /// Intervals between them, double rows not counted.
    pub intervals: usize,
    /// Bound of the distance between the interpolated curve and the exact one, either way, mm.
    pub error: f64,
}

/// Why there is no table.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointsError {
    /// The curve has no angle about the shaft as its coordinate.
    #[error(
        "the curve turns back as seen from the shaft at a polar angle of {polar_deg:.3} deg: angles about the shaft do not tell \
         its points apart; give x and y by equal chord error (--points-as xy --points-step chord)"
    )]
    NotAround {
        /// Where, degrees.
        polar_deg: f64,
    },
    /// The tolerance needs more points than a table may have.
    #[error(
        "{tolerance_mm} mm would need more than {most} points; give a larger --tolerance, equal chord error (--points-step chord) \
         or cubic interpolation (--points-between cubic)"
    )]
    TooMany {
        /// The tolerance, mm.
        tolerance_mm: f64,
        /// How many a table may have.
        most: usize,
    },
    /// What the follower may feel needs more points than a table may have.
    #[error(
        "no table of up to {most} points keeps the errors of velocity and acceleration; give a larger --tolerance-velocity or \
         --tolerance-acceleration, or none"
    )]
    Felt {
        /// How many were tried at the most.
        most: usize,
    },
    /// The interpolated curve does not follow the exact one.
    #[error("the interpolated curve leaves the exact one at x {x:.6} mm, y {y:.6} mm")]
    Astray {
        /// Where, mm.
        x: f64,
        /// Where, mm.
        y: f64,
    },
}

#[cfg(test)]
mod tests;
