//! Flanks in space that a cylindrical roller sweeps, as their proof needs them.

use super::Layer;
use crate::geometry::Entity;
use crate::geometry::solid::CheckedSolid;
use nalgebra::{Vector2, Vector3};

/// What is drawn of a body with such flanks.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptDrawing {
    /// The solid.
    pub solid: CheckedSolid,
    /// Largest distance of its flanks from the exact ones, between the places that they are made through, mm.
    pub deviation: f64,
    /// The developed view of its outside, mm.
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundForm {
    /// Radius of the outside.
    pub outer: f64,
    /// Radius of the floor.
    pub floor: f64,
    /// Heights of the two ends.
    pub ends: (f64, f64),
    /// Volume without holes, mm³.
    pub volume: f64,
}

/// The flanks.
pub trait SweptFlanks: Sync {
    /// How a point (mm) of a flank lies to the nearest flank: by the roller rolled past it.
    fn miss(&self, point: Vector3<f64>) -> FlankMiss;

    /// Outside, floor and ends.
    fn form(&self) -> RoundForm;

    /// The layers of the developed view of the outside with the ends of the curve on each, mm.
    fn developed(&self) -> Vec<(Layer, [Vector2<f64>; 2])>;

    /// Distance of a point (mm) of the developed view from the exact curve of a layer, mm, and the cam angle there, rad.
    fn developed_miss(&self, layer: Layer, point: Vector2<f64>) -> (f64, f64);
}
