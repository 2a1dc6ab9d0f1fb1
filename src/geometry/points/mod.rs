//! Tables of points for a control that interpolates between them: as many as it takes to keep a tolerance, and the proof that
//! they do.
//!
//! A table stands for the curve that the control makes of it ([`Interpolant`]), and that curve is held against the exact one
//! ([`Path`]) over its whole length ([`deviations`]). So the number of points is not estimated: a table is tried, its error bounded,
//! and its places are changed until the fewest are left that keep the tolerance ([`place`]).

mod deviation;
mod interpolant;
mod path;
mod placing;

pub use deviation::deviations;
pub use interpolant::Interpolant;
pub use path::Path;
pub use placing::place;

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
}

/// What a table is to be and to keep. Tolerances of the follower's velocity and acceleration would stand here, beside that of
/// the distance, and be measured with it in `placing::Trial::of`.
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
    /// point again; a corner between cubic splines stands twice.
    pub rows: Vec<[f64; 2]>,
    /// Where each of them lies on the exact curve, as a length from its start, mm.
    pub places: Vec<f64>,
    /// Corners of the curve.
    pub corners: usize,
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
