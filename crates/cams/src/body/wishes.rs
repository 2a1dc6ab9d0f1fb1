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

/// Names of formats, as few as a request can be copied with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FormatNames([&'static str; MOST_NAMES]);

/// Most of them: more than there are formats for machines.
const MOST_NAMES: usize = 32;

impl FormatNames {
    /// Whether a format is one of them.
    #[must_use]
    pub fn contains(&self, name: &str) -> bool {
        !name.is_empty() && self.0.contains(&name)
    }
}

impl FromIterator<&'static str> for FormatNames {
    fn from_iter<T: IntoIterator<Item = &'static str>>(names: T) -> Self {
        let mut all = Self::default();
        all.0.iter_mut().zip(names).for_each(|(place, name)| *place = name);
        all
    }
}
