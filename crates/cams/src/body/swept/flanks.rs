//! Flanks in space that a cylindrical roller sweeps, as their proof needs them.

use crate::body::Layer;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::solid::CheckedSolid;
use nalgebra::{Vector2, Vector3};

/// A flank of a groove.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlankSide {
    /// Its metal lies above the roller.
    Upper,
    /// Its metal lies below.
    Lower,
}

impl FlankSide {
    pub(crate) const BOTH: [Self; 2] = [Self::Upper, Self::Lower];
}

/// What is drawn of a body with such flanks.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptDrawing {
    /// The solid.
    pub solid: CheckedSolid,
    /// Largest distance of its flanks from the exact ones, between the places that they are made through, mm.
    pub deviation: f64,
    /// The developed view of its outside, mm, where that can be developed.
    pub developed: Vec<(Layer, Entity)>,
    /// The endings of the names of its tables.
    pub tables: &'static [&'static str],
}

/// How a point of a flank lies to the exact one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankMiss {
    /// How far it is from the flank, mm: positive where metal is missing.
    pub value: f64,
    /// The cam angle at which the roller comes nearest to it, rad.
    pub at: f64,
    /// Normal out of the metal there, in the drawing.
    pub outward: Vector3<f64>,
}

/// The round faces and the ends of a body with swept flanks, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct RoundForm {
    /// Its round faces that the flanks bound: outside, floor, conical ends.
    pub faces: Vec<RoundFace>,
    /// Radius of the rim of its ends.
    pub rim: f64,
    /// Heights of the two ends.
    pub ends: (f64, f64),
    /// Volume without holes, mm³.
    pub volume: f64,
}

/// A face that is round about the axis, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RoundFace {
    /// A cylinder with the metal inside.
    Cylinder {
        /// Its radius.
        radius: f64,
    },
    /// A cone with the metal inside, between two places: radius and height.
    Cone {
        /// The places.
        between: [(f64, f64); 2],
    },
    /// The hollow of a torus about z = 0, the metal outside of its tube.
    Torus {
        /// Radius of the circle in the middle of its tube.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
}

/// The flanks.
pub trait SweptFlanks: Sync {
    /// How a point (mm) of a flank lies to the nearest flank: by the roller rolled past it.
    fn miss(&self, point: Vector3<f64>) -> FlankMiss;

    /// Outside, floor and ends.
    fn form(&self) -> RoundForm;

    /// The body as a machine turns it about its axis under a tool.
    ///
    /// # Errors
    /// Why no tool cuts it so.
    fn turned(&self) -> Result<&dyn TurnedCam, &'static str>;

    /// The layers of the developed view of the outside with the ends of the curve on each, mm; none where the outside cannot be developed.
    fn developed(&self) -> Vec<(Layer, [Vector2<f64>; 2])> {
        Vec::new()
    }

    /// Distance of a point (mm) of the developed view from the exact curve of a layer, mm, and the cam angle there, rad.
    fn developed_miss(&self, _layer: Layer, _point: Vector2<f64>) -> (f64, f64) {
        (f64::NAN, 0.0)
    }
}

/// A cam that a machine turns about the axis A under a tool, whose axis stands along Z: X is along A, Y beside it, and Z is 0 on the outside of the cam. A counts as
/// ISO 841 does, as if the tool went about the cam by the right hand along X.
pub trait TurnedCam: Sync {
    /// Radius of a tool as wide as the groove, m.
    fn widest_tool(&self) -> f64;

    /// Depth of the groove, m.
    fn depth(&self) -> f64;

    /// Radius of the outside, m.
    fn outside(&self) -> f64;

    /// The joints of the motion as angles of A, degrees, from 0 on once round.
    fn joints(&self) -> Vec<f64>;

    /// The exact X and Y of the axis of a tool of a radius (m) at an angle of A (degrees) along a flank, in the middle of its depth, or in the middle of the groove; mm.
    fn tool_place(&self, flank: Option<FlankSide>, tool: f64, a_deg: f64) -> [f64; 2];

    /// By how much a tool at an angle of A that is moved by so much in X and Y (mm) cuts higher up along X, across the groove: the largest of floor and outside,
    /// mm.
    fn across(&self, a_deg: f64, moved: [f64; 2]) -> f64;
}
