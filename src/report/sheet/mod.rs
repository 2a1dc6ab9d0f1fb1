//! The review sheet: what a person looks at before the metal is cut. A body says what is seen ([`View`], true size); [`fn@compose`]
//! chooses paper and scale, and places everything on it.
//!
//! All lengths on a sheet are millimetres of paper, y upwards; the origin is that of the drawing. Every text is measured with the
//! font it is set in, and set where it meets no line, no other text and no frame.

mod block;
mod compose;
pub mod font;
pub(super) mod marks;
mod panels;
pub mod paper;
pub(super) mod placing;
pub(super) mod scheme;
mod view;

pub use compose::{Extras, compose};
pub use view::{Facts, Mark, PlaceTable, View};

use crate::geometry::Entity;
use crate::geometry::contour::{Bend, Contour, Extents, Vertex};
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
pub enum Shape {
    /// Something closed.
    Entity(Entity),
    /// A straight line.
    Line(Vector2<f64>, Vector2<f64>),
    /// An open chain of straight lines.
    Path(Vec<Vector2<f64>>),
    /// An open arc: start, end and bulge.
    Arc(Vector2<f64>, Vector2<f64>, f64),
    /// A filled triangle.
    Triangle([Vector2<f64>; 3]),
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
pub struct Group {
    /// Name for programs, ASCII without spaces.
    pub id: String,
    /// The class that gives its style.
    pub class: &'static str,
    /// Name for people.
    pub label: String,
    /// Colour of its lines, where the colour carries information.
    pub colour: Option<String>,
    /// What is in it.
    pub shapes: Vec<Shape>,
    /// It has a line in the legend.
    pub in_legend: bool,
}

impl Group {
    /// A group whose style class is its name.
    #[must_use]
    pub fn new(id: &'static str, label: &str, shapes: Vec<Shape>) -> Self {
        Self { id: id.into(), class: id, label: label.into(), colour: None, shapes, in_legend: false }
    }

    /// The same, told in the legend by its label.
    #[must_use]
    pub fn told(self) -> Self {
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
    pub groups: Vec<Group>,
}

/// Thickness of a thin line over the size of the lettering of an A4, mm (ISO 128: a thick one is twice as thick).
pub(crate) const STROKE: f64 = 0.25;

impl Shape {
    /// The shape at another scale about the origin.
    #[must_use]
    fn scaled(&self, scale: f64) -> Self {
        match self {
            Shape::Entity(Entity::Circle(centre, radius)) => {
                Shape::Entity(Entity::Circle(centre * scale, radius * scale))
            }
            Shape::Entity(Entity::Polyline(contour)) => Shape::Entity(Entity::Polyline(scaled(contour, scale))),
            Shape::Line(a, b) => Shape::Line(a * scale, b * scale),
            Shape::Path(points) => Shape::Path(points.iter().map(|point| point * scale).collect()),
            Shape::Arc(a, b, bulge) => Shape::Arc(a * scale, b * scale, *bulge),
            Shape::Triangle(corners) => Shape::Triangle(corners.map(|corner| corner * scale)),
            Shape::Text { at, height, anchor, text } => {
                Shape::Text { at: at * scale, height: height * scale, anchor: *anchor, text: text.clone() }
            }
        }
    }

    /// The field that a text takes, with the metrics of its font; `None` of what is no text.
    #[must_use]
    pub fn text_field(&self) -> Option<Extents> {
        let Shape::Text { at, height, anchor, text } = self else { return None };
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

fn scaled(contour: &Contour, scale: f64) -> Contour {
    let vertex = |vertex: &Vertex| {
        let bend = match vertex.bend {
            Bend::Arc(bulge) => Bend::Arc(bulge),
            Bend::Cubic([leaves, arrives]) => Bend::Cubic([leaves * scale, arrives * scale]),
        };
        Vertex { point: vertex.point * scale, bend }
    };
    Contour { vertices: contour.vertices.iter().map(vertex).collect() }
}

/// A text on the sheet.
pub(crate) fn words(at: Vector2<f64>, height: f64, anchor: TextAnchor, text: impl Into<String>) -> Shape {
    Shape::Text { at, height, anchor, text: text.into() }
}

/// A number for a person: three decimals at the most, no trailing zeros.
pub(crate) fn rounded(value: f64) -> String {
    if !value.is_finite() {
        return "none".into();
    }
    let rounded = (value * 1e3).round() / 1e3 + 0.0;
    if rounded == 0.0 && value != 0.0 { format!("{value:.1e}") } else { rounded.to_string() }
}
