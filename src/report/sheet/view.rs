//! What a body shows on its sheet, in true size.

use super::{Group, Shape};
use crate::geometry::contour::{Extents, Segment};
use crate::machine::Title;
use nalgebra::Vector2;
use std::sync::Arc;

/// Something that is drawn and named at the size of the lettering, whatever the scale. Places are millimetres of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A text beside a place, with a leader where it stands farther away.
    Label {
        /// Style.
        class: &'static str,
        /// The place.
        at: Vector2<f64>,
        /// The side on which the text stands where there is room.
        towards: Vector2<f64>,
        /// The words.
        text: String,
    },
    /// A dimension line between two places, moved out of the drawing to a side (a unit vector along an axis).
    Distance {
        /// One end.
        from: Vector2<f64>,
        /// The other end.
        to: Vector2<f64>,
        /// Where to.
        away: Vector2<f64>,
        /// The words.
        text: String,
    },
    /// A radius: a dimension line from the centre to a place.
    Radius {
        /// Centre.
        centre: Vector2<f64>,
        /// The place on the curve.
        to: Vector2<f64>,
        /// The words.
        text: String,
    },
    /// The angle between two directions from a corner.
    Angle {
        /// Style.
        class: &'static str,
        /// The corner.
        corner: Vector2<f64>,
        /// One direction, a unit vector.
        from: Vector2<f64>,
        /// The other one.
        to: Vector2<f64>,
        /// Radius of the arc between, mm of the drawing.
        radius: f64,
        /// The words.
        text: String,
    },
    /// An arrow along a circle.
    Turning {
        /// Style.
        class: &'static str,
        /// Radius about the origin.
        radius: f64,
        /// Where it starts, degrees of the drawing.
        from_deg: f64,
        /// How far it turns, positive counter-clockwise.
        sweep_deg: f64,
        /// The words.
        text: String,
    },
}

/// A table of places: heads, and rows of as many cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlaceTable {
    /// What it tells.
    pub title: String,
    /// Names of the columns.
    pub heads: Vec<String>,
    /// The rows, which finer and coarser tables share.
    pub rows: Arc<[Vec<String>]>,
    /// Every how many of them it shows.
    pub every: usize,
}

/// What the title block tells besides `[title]` of the machine file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts {
    /// As the machine file gives it.
    pub title: Title,
    /// Material, as the machine file names it.
    pub material: Option<String>,
    /// Thickness or length along the axis, mm.
    pub thickness_mm: Option<f64>,
    /// Mass, kg.
    pub mass_kg: Option<f64>,
}

/// What a body shows, from the back to the front.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct View {
    /// Lines and areas, mm.
    pub groups: Vec<Group>,
    /// What is named and dimensioned.
    pub marks: Vec<Mark>,
    /// Tables of places: the first that fits is shown, the finest first.
    pub tables: Vec<PlaceTable>,
    /// For the title block.
    pub facts: Facts,
    /// What else must be said, a sentence each.
    pub notes: Vec<String>,
    /// Sentences about motion that is lost.
    pub lost: Vec<String>,
}

impl View {
    /// What the groups cover, mm.
    #[must_use]
    pub(super) fn extents(&self) -> Extents {
        let mut reached =
            Extents { least: Vector2::repeat(f64::INFINITY), largest: Vector2::repeat(f64::NEG_INFINITY) };
        for shape in self.groups.iter().flat_map(|group| &group.shapes) {
            if let Some(extents) = shape.extents() {
                reached = reached.with(&extents);
            }
        }
        reached
    }
}

impl Shape {
    /// What a shape covers; `None` of a text.
    pub(super) fn extents(&self) -> Option<Extents> {
        let of = |points: &[Vector2<f64>]| {
            let first = points.first()?;
            let start = Extents { least: *first, largest: *first };
            Some(points.iter().fold(start, |all, p| all.with(&Extents { least: *p, largest: *p })))
        };
        match self {
            Shape::Entity(entity) => Some(entity.extents()),
            Shape::Line(a, b) => of(&[*a, *b]),
            Shape::Path(points) => of(points),
            Shape::Arc(start, end, bulge) => {
                let segment = Segment { start: *start, end: *end, bulge: *bulge };
                Some(segment.extents())
            }
            Shape::Triangle(corners) => of(corners),
            Shape::Text { .. } => None,
        }
    }
}
