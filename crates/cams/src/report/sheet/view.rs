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
    /// A size of a view, with a dimension line beside that view (a unit vector along an axis).
    Size {
        /// One end.
        from: Vector2<f64>,
        /// The other end.
        to: Vector2<f64>,
        /// The direction of the side.
        away: Vector2<f64>,
        /// The view that the line stays clear of.
        view: Extents,
        /// Which line from the view it is, 1 for the first.
        line: u32,
        /// The words.
        text: String,
        /// The letter of the datum that the axis or the middle of the size is.
        datum: Option<&'static str>,
        /// Whether only its first end has an arrow: the other edge is cut away, and the line goes on a little beyond the middle.
        is_half: bool,
    },
    /// A numbered place of the profile at which the part is inspected.
    Flag {
        /// The place.
        at: Vector2<f64>,
        /// The direction out of the metal, a unit vector.
        outward: Vector2<f64>,
        /// "P1".
        name: String,
    },
    /// A cutting line: its ends, and the direction of sight on the section.
    CuttingLine {
        /// Its ends.
        ends: [Vector2<f64>; 2],
        /// The direction of sight, a unit vector.
        sight: Vector2<f64>,
        /// The letter at both ends.
        letter: &'static str,
    },
    /// The name of a view, above it.
    Caption {
        /// The view.
        view: Extents,
        /// "A–A".
        text: String,
    },
    /// The frame of a tolerance, ISO 1101.
    Tolerance(FeatureFrame),
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
        /// "start of the cut, climb milling".
        text: String,
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
    /// An arrow along a circle about the origin.
    Turning {
        /// Style.
        class: &'static str,
        /// The arcs that it may follow, the preferred one first: the first on free paper is drawn.
        arcs: Vec<TurningArc>,
        /// The words.
        text: String,
    },
}

/// An arc about the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurningArc {
    /// Radius, mm of the drawing.
    pub radius: f64,
    /// Polar angle of its start, degrees of the drawing.
    pub from_deg: f64,
    /// Angle from its start to its end, degrees, positive counter-clockwise.
    pub sweep_deg: f64,
}

/// The frame of a tolerance, ISO 1101, with an arrow to one of some places of its feature, the size of the feature above and the datum that it is below.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureFrame {
    /// Places of the feature with the directions outwards, unit vectors: the one nearest to free paper is used.
    pub places: Vec<(Vector2<f64>, Vector2<f64>)>,
    /// The size of the feature, with its limits; empty if it has none.
    pub above: String,
    /// What is tolerated; `None` of a size without a frame, which stands on a line.
    pub sign: Option<ToleranceSign>,
    /// Width of the zone, and the letters of the datums.
    pub cells: Vec<String>,
    /// A word behind the frame, such as that it is a proposal.
    pub behind: String,
    /// The letter of the datum that the middle plane or the axis of the feature is (ISO 5459).
    pub datum: Option<&'static str>,
}

/// What a frame of ISO 1101 tolerates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToleranceSign {
    /// The profile of a line, all around the part.
    ProfileAllAround,
    /// The profile of a line.
    Profile,
    /// A face square to an axis.
    Perpendicular,
    /// Two faces that are parallel.
    Parallel,
    /// A middle plane in an axis.
    Symmetry,
    /// An axis at its exact place.
    Position,
    /// The profile of a surface.
    Surface,
}

/// A row of a table of places.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlaceRow {
    /// Its cells, as many as there are heads.
    pub cells: Vec<String>,
    /// Its number among the rows at equal distances; `None` of a row between them, at a change of the motion.
    pub number: Option<usize>,
    /// The name of the place of inspection that it has: "P1".
    pub flag: Option<String>,
    /// Whether a segment of the motion begins there.
    pub is_change: bool,
}

impl PlaceRow {
    /// The row of this number at equal distances.
    #[must_use]
    pub fn regular(number: usize, cells: Vec<String>) -> Self {
        Self { cells, number: Some(number), flag: None, is_change: false }
    }
}

/// A table of places: heads, and rows of as many cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlaceTable {
    /// Its title.
    pub title: String,
    /// Names of the columns.
    pub heads: Vec<String>,
    /// What stands below the title, a line each.
    pub remarks: Vec<String>,
    /// The rows, which finer and coarser tables share.
    pub rows: Arc<[PlaceRow]>,
    /// Every how many of those at equal distances it shows; the others are always shown.
    pub every: usize,
}

impl PlaceTable {
    /// The rows of a table, all of them at equal distances.
    #[must_use]
    pub fn regular_rows(rows: impl IntoIterator<Item = Vec<String>>) -> Arc<[PlaceRow]> {
        rows.into_iter().enumerate().map(|(number, cells)| PlaceRow::regular(number, cells)).collect()
    }

    /// The rows that it shows.
    pub fn shown(&self) -> impl Iterator<Item = &PlaceRow> {
        let every = self.every.max(1);
        self.rows
            .iter()
            .filter(move |row| row.flag.is_some() || row.number.is_none_or(|number| number.is_multiple_of(every)))
    }
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
    /// The treatment that the limit of the contact stress presumes.
    pub presumed_treatment: Option<String>,
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
