//! What a body shows on its sheet, in true size.

use super::{Group, Shape};
use crate::geometry::contour::{Edge, Extents};
use crate::machine::Title;
use nalgebra::Vector2;

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
    /// The rows.
    pub rows: Vec<Vec<String>>,
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
                let segment = crate::geometry::contour::Segment { start: *start, end: *end, bulge: *bulge };
                Some(segment.extents())
            }
            Shape::Triangle(corners) => of(corners),
            Shape::Text { .. } => None,
        }
    }

    /// The lines of a shape as chains of points, so near that none is farther than `step` from the next on a curve.
    #[must_use]
    pub fn chains(&self, step: f64) -> Vec<Vec<Vector2<f64>>> {
        match self {
            Shape::Entity(entity) => {
                let edges: Vec<Edge> = entity.contour().edges().collect();
                edges.iter().map(|edge| chain(edge, step)).collect()
            }
            Shape::Line(a, b) => vec![vec![*a, *b]],
            Shape::Path(points) => vec![points.clone()],
            Shape::Arc(start, end, bulge) => {
                let segment = crate::geometry::contour::Segment { start: *start, end: *end, bulge: *bulge };
                vec![chain(&Edge::Segment(segment), step)]
            }
            Shape::Triangle([a, b, c]) => vec![vec![*a, *b, *c, *a]],
            Shape::Text { .. } => Vec::new(),
        }
    }
}

/// Most points of a chain: a curve far larger than any paper is not followed closer.
const MOST: f64 = 4000.0;

fn chain(edge: &Edge, step: f64) -> Vec<Vector2<f64>> {
    if edge.segment().is_some_and(|segment| segment.bulge == 0.0) {
        return vec![edge.start(), edge.end()];
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a few thousand")]
    let pieces = (edge.length() / step).ceil().clamp(1.0, MOST) as u32;
    let share = 1.0 / f64::from(pieces);
    let Edge::Segment(arc) = edge else {
        return (0..=pieces).map(|index| edge.at(f64::from(index) * share).0).collect();
    };
    // Each chord is the one before, turned by the same angle: rounding adds up to far less than the finest line.
    let (sin, cos) = libm::sincos(arc.sweep() * share);
    let first = (arc.start, arc.at(share).0 - arc.start);
    let next = |(point, chord): &(Vector2<f64>, Vector2<f64>)| {
        let turned = Vector2::new(cos * chord.x - sin * chord.y, sin * chord.x + cos * chord.y);
        Some((point + chord, turned))
    };
    std::iter::successors(Some(first), next).take(pieces as usize).map(|(point, _)| point).chain([arc.end]).collect()
}
