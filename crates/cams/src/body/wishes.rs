//! What the files that machines run are requested to be, as parts of a [`Request`](super::Request).

use crate::machine::Controller;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::points::{PointCoordinates, PointInterpolation, PointStep};

/// A list of places for a measuring machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inspection {
    /// Radius of the ball of the probe, m.
    pub ball_radius: f64,
}

/// A gauge follower, for its lift table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Gauge {
    /// A ball or a roller of a radius, m.
    Round(f64),
    /// A flat face.
    Flat,
}

/// The curve that a table gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointCurve {
    /// The profile.
    Profile,
    /// The path of the roller's centre.
    Centre,
    /// The path of the centre of the cutter, or of the wheel.
    Cutter,
}

impl NamedChoice for PointCurve {
    const ALL: &'static [(&'static str, Self)] =
        &[("profile", Self::Profile), ("centre", Self::Centre), ("cutter", Self::Cutter)];
}

/// A requested table of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Points {
    /// The curve.
    pub curve: PointCurve,
    /// Its coordinates; `None` for polar ones, or x and y of a plate.
    pub form: Option<PointCoordinates>,
    /// Its places; `None` for equal angles, or equal chord error on a plate.
    pub step: Option<PointStep>,
    /// How the control interpolates.
    pub between: PointInterpolation,
}

impl Default for Points {
    fn default() -> Self {
        Self { curve: PointCurve::Profile, form: None, step: None, between: PointInterpolation::Linear }
    }
}

/// A requested program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Milling {
    /// The control, in the place of that of the machine file.
    pub controller: Option<Controller>,
}

/// Formats by their places in the list of all that machines run, of which there are at most 64.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FormatSet(u64);

impl FormatSet {
    /// With the format of a place.
    #[must_use]
    pub(crate) fn with(self, place: usize) -> Self {
        Self(self.0 | 1 << place)
    }

    /// Whether the format of a place is one of them.
    pub(crate) fn contains(self, place: usize) -> bool {
        self.0 & 1 << place != 0
    }
}
