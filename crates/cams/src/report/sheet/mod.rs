//! The review sheet, for a person to check before the metal is cut. A body says what is shown ([`SheetView`], true size); [`fn@compose`]
//! chooses paper and scale, and places everything on it.
//!
//! All lengths on a sheet are millimetres of paper, y upwards; the origin is that of the drawing. Every text is measured with its
//! font, and placed where it touches no line, no other text and no frame.

pub(super) mod block;
use camgen_kernel::text::Text;
mod compose;
mod dimension;
pub mod font;
mod kind;
pub(super) mod marks;
mod panels;
pub mod paper;
pub(super) mod placing;
pub(super) mod scheme;
mod view;

pub(crate) use block::PROPOSED_ROUGHNESS;
pub use compose::{SheetExtras, compose};
pub use dimension::Dimensions;
pub use kind::SheetKind;
pub use view::extents_of;
pub use view::{FeatureFrame, Mark, PlaceRow, PlaceTable, SheetView, TitleFacts, ToleranceSign, TurningArc};

use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Which part of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextAnchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// A thing on the sheet.
#[derive(Debug, Clone, PartialEq)]
pub enum SheetShape {
    /// Something that is cut.
    Entity(Entity),
    /// A straight line.
    Line(Vector2<f64>, Vector2<f64>),
    /// An open chain of straight lines.
    Path(Vec<Vector2<f64>>),
    /// An open arc: start, end and bulge.
    Arc(Vector2<f64>, Vector2<f64>, f64),
    /// A filled triangle.
    Triangle([Vector2<f64>; 3]),
    /// A filled polygon in the colour of its group.
    Area(Vec<Vector2<f64>>),
    /// A text of a height, mm.
    Text {
        /// Its place, on the base line.
        at: Vector2<f64>,
        /// Height, mm.
        height: f64,
        /// Which part of it is there.
        anchor: TextAnchor,
        /// The words.
        text: String,
    },
}

/// Shapes that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeGroup {
    /// Name for programs, ASCII without spaces.
    pub id: String,
    /// The class that gives its style.
    pub class: &'static str,
    /// Name for people.
    pub label: Text,
    /// Colour of its lines, where the colour carries information.
    pub colour: Option<String>,
    /// What is in it.
    pub shapes: Vec<SheetShape>,
    /// Whether it has a line in the legend.
    pub in_legend: bool,
}

impl ShapeGroup {
    /// A group whose style class is its name.
    #[must_use]
    pub fn new(id: &'static str, label: impl Into<Text>, shapes: Vec<SheetShape>) -> Self {
        Self { id: id.into(), class: id, label: label.into(), colour: None, shapes, in_legend: false }
    }

    /// The group with a line of its own in the legend.
    #[must_use]
    pub fn with_legend(self) -> Self {
        Self { in_legend: true, ..self }
    }
}

/// The whole sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Title.
    pub title: String,
    /// What the sheet covers, mm.
    pub extents: Extents,
    /// Thickness of a thin line, mm.
    pub stroke: f64,
    /// Length on the sheet of a millimetre: 1 at true size, 0.5 at 1:2.
    pub scale: f64,
    /// The groups, from the back to the front.
    pub groups: Vec<ShapeGroup>,
}

/// Thickness of a thin line, mm (ISO 128: a thick one is twice as thick, that of the profile four times).
pub(crate) const STROKE: f64 = 0.25;

impl SheetShape {
    /// The shape at another scale about the origin.
    #[must_use]
    fn scaled(&self, scale: f64) -> Self {
        match self {
            SheetShape::Entity(entity) => SheetShape::Entity(entity.scaled(scale)),
            SheetShape::Line(a, b) => SheetShape::Line(a * scale, b * scale),
            SheetShape::Path(points) => SheetShape::Path(points.iter().map(|point| point * scale).collect()),
            SheetShape::Arc(a, b, bulge) => SheetShape::Arc(a * scale, b * scale, *bulge),
            SheetShape::Triangle(corners) => SheetShape::Triangle(corners.map(|corner| corner * scale)),
            SheetShape::Area(corners) => SheetShape::Area(corners.iter().map(|corner| corner * scale).collect()),
            SheetShape::Text { at, height, anchor, text } => {
                SheetShape::Text { at: at * scale, height: height * scale, anchor: *anchor, text: text.clone() }
            }
        }
    }

    /// The field that a text takes, with the metrics of its font; `None` for other shapes.
    #[must_use]
    pub fn text_field(&self) -> Option<Extents> {
        let SheetShape::Text { at, height, anchor, text } = self else { return None };
        let width = font::width(text, *height);
        let left = match anchor {
            TextAnchor::Start => at.x,
            TextAnchor::Middle => at.x - 0.5 * width,
            TextAnchor::End => at.x - width,
        };
        Some(Extents {
            least: Vector2::new(left, at.y - font::DESCENT * height),
            largest: Vector2::new(left + width, at.y + font::ASCENT * height),
        })
    }
}

/// A text on the sheet.
pub(crate) fn words(at: Vector2<f64>, height: f64, anchor: TextAnchor, text: impl Into<String>) -> SheetShape {
    SheetShape::Text { at, height, anchor, text: text.into() }
}

pub use camgen_kernel::text::rounded;
