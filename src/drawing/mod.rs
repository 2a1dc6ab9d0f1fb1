//! Design to drawing: entities in millimetres, tables and the report. The second door of the library.
//!
//! Curves are sampled here, once, to a stated tolerance; writers behind this room only format.

pub mod arcs;
pub mod conoid;
pub mod flank;
pub mod mesh;
pub mod outline;
pub mod report;
pub mod sheet;
pub mod solid;
mod table;

pub use report::{Report, plate_report, report};
pub use sheet::{Group, Shape, Sheet, TextAnchor};
pub use table::{COLUMNS, PLATE_COLUMNS, Table, plate_table, table};

use crate::cam::plate::Plate;
use crate::cam::rotary::Rotary;
use crate::checks::balance::{self, Balancing};
use crate::contour::{Contour, Extents, Vertex};
use crate::machine::{Machine, Rotation};
use nalgebra::Vector2;
use outline::{Fit, MILLIMETRES, Outline, OutlineError};
use std::f64::consts::PI;

/// Layer of a cut file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// The outline of the cam.
    CamProfile,
    /// Bore and holes.
    Bore,
    /// The path of a cutter's centre, in a file of its own.
    CutterPath,
}

impl Layer {
    /// Its name in the file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Layer::CamProfile => "CAM_PROFILE",
            Layer::Bore => "BORE",
            Layer::CutterPath => "CUTTER_PATH",
        }
    }
}

/// What is cut.
#[derive(Debug, Clone, PartialEq)]
pub enum Entity {
    /// A closed chain of arcs and lines.
    Polyline(Contour),
    /// A full circle: centre and radius, mm.
    Circle(Vector2<f64>, f64),
}

impl Entity {
    /// The entity as a contour, a circle counter-clockwise.
    #[must_use]
    pub fn contour(&self) -> Contour {
        match self {
            Entity::Polyline(contour) => contour.clone(),
            Entity::Circle(centre, radius) => Contour::circle(*centre, *radius),
        }
    }

    /// Extents, mm.
    #[must_use]
    pub fn extents(&self) -> Extents {
        match self {
            Entity::Polyline(contour) => contour.extents(),
            Entity::Circle(centre, radius) => {
                let reach = Vector2::new(*radius, *radius);
                Extents { least: centre - reach, largest: centre + reach }
            }
        }
    }
}

/// The cut drawing of a cam.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The outline with its proof, as it lies in the drawing.
    pub outline: Outline,
    /// The bore, a circle or, with a keyway, a contour; counter-clockwise.
    pub bore: Option<Entity>,
    /// Holes that balance the disc, when they were asked for.
    pub balancing: Option<Balancing>,
}

impl Part {
    /// What is cut, layer by layer; holes clockwise.
    #[must_use]
    pub fn entities(&self) -> Vec<(Layer, Entity)> {
        let profile = (Layer::CamProfile, Entity::Polyline(self.outline.contour.clone()));
        let holes = self.holes().into_iter().map(|hole| match hole {
            Entity::Polyline(contour) => (Layer::Bore, Entity::Polyline(contour.reversed())),
            circle @ Entity::Circle(..) => (Layer::Bore, circle),
        });
        std::iter::once(profile).chain(holes).collect()
    }

    /// Bore and balance holes, counter-clockwise.
    #[must_use]
    pub fn holes(&self) -> Vec<Entity> {
        let drilled = self.balancing.iter().flat_map(|balancing| &balancing.holes);
        self.bore.iter().cloned().chain(drilled.map(|(centre, radius)| Entity::Circle(*centre, *radius))).collect()
    }

    /// Area of the metal, mm², and its first moment about the shaft, mm³.
    #[must_use]
    pub fn area_and_moment(&self) -> (f64, Vector2<f64>) {
        let (outline, centroid) = self.outline.contour.area_and_centroid();
        self.holes().iter().fold((outline, centroid * outline), |(area, moment), hole| {
            let (hole, centroid) = hole.contour().area_and_centroid();
            (area - hole, moment - centroid * hole)
        })
    }
}

/// The bore of a clockwise cam, with its keyway merged into one contour.
fn bore(machine: &Machine) -> Option<Entity> {
    let radius = MILLIMETRES * machine.cam.bore_radius?;
    let Some(keyway) = machine.cam.keyway else {
        return Some(Entity::Circle(Vector2::zeros(), radius));
    };
    let (half, bottom) = (0.5 * MILLIMETRES * keyway.width, radius + MILLIMETRES * keyway.depth);
    let edge = ((radius - half) * (radius + half)).sqrt();
    // The round part from the upper edge of the slot to the lower one, in two arcs.
    let round = libm::tan(0.25 * (PI - libm::asin(half / radius)));
    let (sin, cos) = (libm::sin(keyway.angle), libm::cos(keyway.angle));
    let at = |x: f64, y: f64, bulge: f64| Vertex { point: Vector2::new(cos * x - sin * y, sin * x + cos * y), bulge };
    let vertices = vec![
        at(edge, half, round),
        at(-radius, 0.0, round),
        at(edge, -half, 0.0),
        at(bottom, -half, 0.0),
        at(bottom, half, 0.0),
    ];
    Some(Entity::Polyline(as_turned(machine, Contour { vertices })))
}

/// The cut drawing within a tolerance (m) along the normal of the profile.
///
/// # Errors
/// [`OutlineError`] when the profile cannot be drawn.
pub fn part(rotary: &Rotary, fit: impl Into<Fit>) -> Result<Part, OutlineError> {
    let outline = outline::profile(&rotary.curves, fit)?;
    let outline = Outline { contour: as_turned(&rotary.machine, outline.contour), ..outline };
    let bore = bore(&rotary.machine);
    let (bands, wall) = (rotary.machine.cam.balance, MILLIMETRES * rotary.machine.limits.wall);
    let round = bore.as_ref().map(Entity::contour);
    let balancing = bands.map(|(inner, outer)| {
        balance::balance(&outline.contour, round.as_ref(), (MILLIMETRES * inner, MILLIMETRES * outer), wall)
    });
    Ok(Part { outline, bore, balancing })
}

/// The cut drawing of a plate within a tolerance (m) along the normal of its flanks.
///
/// # Errors
/// [`OutlineError`] when the outline cannot be drawn.
pub fn plate_part(plate: &Plate, fit: impl Into<Fit>) -> Result<Part, OutlineError> {
    Ok(Part { outline: outline::plate(plate, fit)?, bore: None, balancing: None })
}

/// A contour of a clockwise cam as it lies in the drawing of this one.
fn as_turned(machine: &Machine, contour: Contour) -> Contour {
    match machine.cam.rotation {
        Rotation::Clockwise => contour,
        Rotation::CounterClockwise => contour.mirrored_about_x(),
    }
}

/// A point or direction of a clockwise cam as it lies in the drawing of this one.
fn point_as_turned(machine: &Machine, point: Vector2<f64>) -> Vector2<f64> {
    match machine.cam.rotation {
        Rotation::Clockwise => point,
        Rotation::CounterClockwise => Vector2::new(point.x, -point.y),
    }
}

/// The path of the centre of a cutter (radius in m) that cuts the outline from outside, within a tolerance (m).
///
/// # Errors
/// [`OutlineError`] when the profile is undercut (an edge has no path of its own) or the tolerance cannot be kept.
pub fn cutter_path(rotary: &Rotary, cutter_radius: f64, tolerance: f64) -> Result<Outline, OutlineError> {
    let outline = outline::cutter_path(&rotary.curves, cutter_radius, MILLIMETRES * tolerance)?;
    Ok(Outline { contour: as_turned(&rotary.machine, outline.contour), ..outline })
}
