//! The mechanism of a cam as it moves: rigid parts with their shapes, and the position of each at every sample of the
//! motion. A viewer interpolates between the samples and needs no kinematics of its own.
//!
//! Millimetres and degrees, y upwards, in the frame of the machine: the shaft of a turning cam at the origin.

use super::sheet::SheetShape;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::{Contour, Extents, Vertex};
use nalgebra::Vector2;

/// The mechanism of a cam.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MovingMechanism {
    /// One for each speed that has a section of its own, otherwise one.
    pub views: Vec<MechanismView>,
    /// What the picture leaves out or simplifies, a sentence each.
    pub notes: Vec<String>,
    /// The solid of a cam whose sections differ.
    pub solid: Option<RingSolid>,
}

/// The mechanism at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct MechanismView {
    /// Speed of the main shaft it is for, rpm, where there are several.
    pub rpm: Option<f64>,
    /// Angular speed of the shaft that gives the time, rad/s, where it is known.
    pub shaft_speed: Option<f64>,
    /// Whether the motion runs to its end and back; otherwise it is cyclic.
    pub returns: bool,
    /// The column of the table with the place of a row.
    pub place: &'static str,
    /// The places of the samples, in the unit of that column, growing.
    pub at: Vec<f64>,
    /// Angle of the shaft that gives the time at the samples, degrees, growing.
    pub turn_deg: Vec<f64>,
    /// What the picture covers, mm.
    pub extents: Extents,
    /// The parts, from the back to the front.
    pub parts: Vec<RigidPart>,
}

/// A rigid part.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidPart {
    /// What it is, which gives its style: a word of [`ROLES`].
    pub role: &'static str,
    /// Its name, and where that is written, mm in its own frame; a name does not turn with the part.
    pub name: Option<(String, Vector2<f64>)>,
    /// Its shapes in its own frame.
    pub shapes: Vec<SheetShape>,
    /// The x coordinate of its own origin, mm.
    pub x: CoordinateTrack,
    /// The y coordinate of its own origin, mm.
    pub y: CoordinateTrack,
    /// How far it is turned counter-clockwise, degrees.
    pub turn_deg: CoordinateTrack,
    /// Scale along its own x: only air is not rigid.
    pub stretch: CoordinateTrack,
    /// Scale along its own y: a roll of paper runs down.
    pub height: CoordinateTrack,
    /// Absolute pressure in it, bar, where it is air.
    pub pressure_bar: Option<CoordinateTrack>,
}

/// What a part can be.
pub const ROLES: [&str; 15] = [
    "cam", "mark", "arrow", "roller", "follower", "normal", "ground", "air", "cylinder", "bottom", "bed", "crank",
    "ghost", "spring", "pin",
];

/// A coordinate over the samples.
#[derive(Debug, Clone, PartialEq)]
pub enum CoordinateTrack {
    /// It is constant.
    Still(f64),
    /// Its value at every sample.
    Moving(Vec<f64>),
}

impl CoordinateTrack {
    /// The value at a sample.
    #[must_use]
    pub fn at(&self, sample: usize) -> f64 {
        match self {
            CoordinateTrack::Still(value) => *value,
            CoordinateTrack::Moving(values) => values.get(sample).copied().unwrap_or(f64::NAN),
        }
    }
}

impl From<Vec<f64>> for CoordinateTrack {
    fn from(values: Vec<f64>) -> Self {
        CoordinateTrack::Moving(values)
    }
}

impl From<f64> for CoordinateTrack {
    fn from(value: f64) -> Self {
        CoordinateTrack::Still(value)
    }
}

/// Rings about the axis of a turning cam, each with as many points: its surface.
#[derive(Debug, Clone, PartialEq)]
pub struct RingSolid {
    /// Place along the axis, mm, and the points of the cut there, mm.
    pub rings: Vec<(f64, Vec<Vector2<f64>>)>,
    /// Radius of the bore, mm.
    pub bore: Option<f64>,
    /// Radius of the roller, mm.
    pub roller: f64,
    /// The sections: speed (rpm) and place along the axis (mm).
    pub sections: Vec<(f64, f64)>,
}

impl RigidPart {
    /// A part at rest at the origin.
    #[must_use]
    pub fn new(role: &'static str, shapes: Vec<SheetShape>) -> Self {
        Self {
            role,
            name: None,
            shapes,
            x: CoordinateTrack::Still(0.0),
            y: CoordinateTrack::Still(0.0),
            turn_deg: CoordinateTrack::Still(0.0),
            stretch: CoordinateTrack::Still(1.0),
            height: CoordinateTrack::Still(1.0),
            pressure_bar: None,
        }
    }

    /// With a name at a place of its own frame.
    #[must_use]
    pub fn named(self, name: impl Into<String>, x: f64, y: f64) -> Self {
        Self { name: Some((name.into(), Vector2::new(x, y))), ..self }
    }

    /// With its origin at a place.
    #[must_use]
    pub fn at(self, x: impl Into<CoordinateTrack>, y: impl Into<CoordinateTrack>) -> Self {
        Self { x: x.into(), y: y.into(), ..self }
    }

    /// Turned counter-clockwise.
    #[must_use]
    pub fn turned(self, degrees: impl Into<CoordinateTrack>) -> Self {
        Self { turn_deg: degrees.into(), ..self }
    }
}

/// A rectangle between two corners.
#[must_use]
pub fn rectangle(x: (f64, f64), y: (f64, f64)) -> SheetShape {
    let corners = [(x.0, y.0), (x.1, y.0), (x.1, y.1), (x.0, y.1)];
    let vertices = corners.map(|(x, y)| Vertex::new(Vector2::new(x, y), 0.0)).to_vec();
    SheetShape::Entity(Entity::Polyline(Contour { vertices }))
}

/// A circle about a place.
#[must_use]
pub fn circle(x: f64, y: f64, radius: f64) -> SheetShape {
    SheetShape::Entity(Entity::Circle(Vector2::new(x, y), radius))
}

/// A line between two places.
#[must_use]
pub fn line(from: (f64, f64), to: (f64, f64)) -> SheetShape {
    SheetShape::Line(Vector2::new(from.0, from.1), Vector2::new(to.0, to.1))
}
