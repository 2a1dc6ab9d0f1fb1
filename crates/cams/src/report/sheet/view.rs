//! What a body shows on its sheet, in true size.

use super::{ShapeGroup, SheetShape};
use crate::machine::Title;
use camgen_kernel::geometry::contour::{Extents, Segment};
use camgen_kernel::text::Text;
use nalgebra::Vector2;
use std::sync::Arc;

/// Something that is drawn and named at the size of the lettering, independent of the scale. Places are millimetres of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A text next to a place, with a leader where it is farther away.
    Label {
        /// Style.
        class: &'static str,
        /// The place.
        at: Vector2<f64>,
        /// The preferred side of the text.
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
        /// The direction of the side.
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
    /// The frame of a tolerance of the profile, ISO 1101, with an arrow to one of some places of it.
    Tolerance {
        /// Places of the profile with the directions outwards, unit vectors: the one nearest to free paper is used.
        places: Vec<(Vector2<f64>, Vector2<f64>)>,
        /// Width of the zone, and the letters of the datums.
        cells: Vec<String>,
        /// A word behind the frame, such as that it is a proposal.
        behind: String,
    },
    /// The sign of the roughness of the profile, ISO 21920-1, material removed, with an arrow to one of some places of it.
    Roughness {
        /// Places of the profile with the directions outwards, unit vectors: the one nearest to free paper is used.
        places: Vec<(Vector2<f64>, Vector2<f64>)>,
        /// The largest roughness: "Ra 0.8".
        text: String,
    },
    /// Where the cut starts, with its direction.
    Start {
        /// The place on the profile.
        at: Vector2<f64>,
        /// The direction of the cut, a unit vector.
        along: Vector2<f64>,
        /// The direction away from the metal, a unit vector.
        outward: Vector2<f64>,
    },
    /// A datum, ISO 5459: its letter in a frame, and a triangle at a place.
    Datum {
        /// The place.
        at: Vector2<f64>,
        /// The preferred side of the frame, a unit vector.
        towards: Vector2<f64>,
        /// "A".
        letter: &'static str,
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
    /// Its title.
    pub title: String,
    /// Names of the columns.
    pub heads: Vec<String>,
    /// The rows, which finer and coarser tables share.
    pub rows: Arc<[Vec<String>]>,
    /// Every how many of them it shows.
    pub every: usize,
}

/// The contents of the title block: `[title]` of the machine file and more.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TitleFacts {
    /// As the machine file gives it.
    pub title: Title,
    /// Material, as the machine file names it.
    pub material: Option<String>,
    /// Thickness or length along the axis, mm.
    pub thickness_mm: Option<f64>,
    /// Mass, kg.
    pub mass_kg: Option<f64>,
}

/// The zone in which a manufactured profile must lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileTolerance {
    /// Width of the zone, mm: half of it on either side of the drawn profile.
    pub width_mm: f64,
    /// What it is proposed from; `None` where it is given.
    pub proposed_from: Option<&'static str>,
}

/// What a body shows, from the back to the front.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SheetView {
    /// Lines and areas, mm.
    pub groups: Vec<ShapeGroup>,
    /// What is named and dimensioned.
    pub marks: Vec<Mark>,
    /// Tables of places: the first that fits is shown, the finest first.
    pub tables: Vec<PlaceTable>,
    /// For the title block.
    pub facts: TitleFacts,
    /// Further notes, a sentence each.
    pub notes: Vec<Text>,
    /// Sentences about motion that is lost.
    pub lost: Vec<Text>,
}

/// What groups cover, mm.
#[must_use]
pub fn extents_of(groups: &[ShapeGroup]) -> Extents {
    let mut reached = Extents { least: Vector2::repeat(f64::INFINITY), largest: Vector2::repeat(f64::NEG_INFINITY) };
    for shape in groups.iter().flat_map(|group| &group.shapes) {
        if let Some(extents) = shape.extents() {
            reached = reached.with(&extents);
        }
    }
    reached
}

impl SheetShape {
    /// What a shape covers; `None` of a text.
    pub(super) fn extents(&self) -> Option<Extents> {
        let of = |points: &[Vector2<f64>]| {
            let first = points.first()?;
            let start = Extents { least: *first, largest: *first };
            Some(points.iter().fold(start, |all, p| all.with(&Extents { least: *p, largest: *p })))
        };
        match self {
            SheetShape::Entity(entity) => Some(entity.extents()),
            SheetShape::Line(a, b) => of(&[*a, *b]),
            SheetShape::Path(points) => of(points),
            SheetShape::Arc(start, end, bulge) => {
                let segment = Segment { start: *start, end: *end, bulge: *bulge };
                Some(segment.extents())
            }
            SheetShape::Triangle(corners) => of(corners),
            SheetShape::Area(corners) => of(corners),
            SheetShape::Text { .. } => None,
        }
    }
}
