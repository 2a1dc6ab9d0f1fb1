//! Design to drawing: entities in millimetres, tables and the report. The second door of the library.
//!
//! Curves are sampled here, once, to a stated tolerance; writers behind this room only format.

pub mod arcs;
pub mod outline;
mod report;
mod sheet;
mod table;

pub use report::{Report, report};
pub use sheet::{Group, Shape, Sheet, TextAnchor, sheet};
pub use table::{COLUMNS, Table, table};

use crate::cam::rotary::Rotary;
use crate::checks::balance::{self, Balancing};
use crate::contour::{Contour, Extents};
use crate::machine::Rotation;
use nalgebra::Vector2;
use outline::{MILLIMETRES, Outline, OutlineError};
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

/// The cut drawing of a disc cam.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The outline with its proof, as it lies in the drawing.
    pub outline: Outline,
    /// Radius of the bore, mm.
    pub bore_radius: Option<f64>,
    /// Holes that balance the disc, when they were asked for.
    pub balancing: Option<Balancing>,
}

impl Part {
    /// What is cut, layer by layer.
    #[must_use]
    pub fn entities(&self) -> Vec<(Layer, Entity)> {
        let profile = (Layer::CamProfile, Entity::Polyline(self.outline.contour.clone()));
        let bore = self.bore_radius.map(|radius| (Layer::Bore, Entity::Circle(Vector2::zeros(), radius)));
        let holes = self.holes().iter().map(|(centre, radius)| (Layer::Bore, Entity::Circle(*centre, *radius)));
        std::iter::once(profile).chain(bore).chain(holes).collect()
    }

    /// Holes beside the bore: centre and radius, mm.
    #[must_use]
    pub fn holes(&self) -> &[(Vector2<f64>, f64)] {
        self.balancing.as_ref().map_or(&[], |balancing| &balancing.holes)
    }

    /// Area of the metal, mm², and its first moment about the shaft, mm³.
    #[must_use]
    pub fn area_and_moment(&self) -> (f64, Vector2<f64>) {
        let round = |radius: f64| PI * radius * radius;
        let (outline, centroid) = self.outline.contour.area_and_centroid();
        let bore = self.bore_radius.map_or(0.0, round);
        self.holes().iter().fold((outline - bore, centroid * outline), |(area, moment), (centre, radius)| {
            (area - round(*radius), moment - centre * round(*radius))
        })
    }
}

/// The cut drawing within a tolerance (m) along the normal of the profile.
///
/// # Errors
/// [`OutlineError`] when the profile cannot be drawn.
pub fn part(rotary: &Rotary, tolerance: f64) -> Result<Part, OutlineError> {
    let outline = outline::profile(&rotary.disc, MILLIMETRES * tolerance)?;
    let outline = Outline { contour: as_turned(rotary, outline.contour), ..outline };
    let (bands, wall) = (rotary.machine.cam.balance, MILLIMETRES * rotary.machine.limits.wall);
    let balancing = bands
        .map(|(inner, outer)| balance::balance(&outline.contour, (MILLIMETRES * inner, MILLIMETRES * outer), wall));
    Ok(Part { outline, balancing, bore_radius: rotary.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius) })
}

/// A contour of a clockwise cam as it lies in the drawing of this one.
fn as_turned(rotary: &Rotary, contour: Contour) -> Contour {
    match rotary.machine.cam.rotation {
        Rotation::Clockwise => contour,
        Rotation::CounterClockwise => contour.mirrored_about_x(),
    }
}

/// A point or direction of a clockwise cam as it lies in the drawing of this one.
fn point_as_turned(rotary: &Rotary, point: Vector2<f64>) -> Vector2<f64> {
    match rotary.machine.cam.rotation {
        Rotation::Clockwise => point,
        Rotation::CounterClockwise => Vector2::new(point.x, -point.y),
    }
}

/// The path of the centre of a cutter (radius in m) that cuts the outline from outside, within a tolerance (m).
///
/// # Errors
/// [`OutlineError`] when the profile is undercut (an edge has no path of its own) or the tolerance cannot be kept.
pub fn cutter_path(rotary: &Rotary, cutter_radius: f64, tolerance: f64) -> Result<Outline, OutlineError> {
    let outline = outline::cutter_path(&rotary.disc, cutter_radius, MILLIMETRES * tolerance)?;
    Ok(Outline { contour: as_turned(rotary, outline.contour), ..outline })
}
