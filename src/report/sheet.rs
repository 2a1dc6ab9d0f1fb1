//! The review sheet: what a person looks at before the metal is cut. Millimetres, y upwards, true size.

use super::{Finding, Report};
use crate::geometry::Entity;
use crate::geometry::contour::Extents;
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
}

impl Group {
    /// A group whose style class is its name.
    #[must_use]
    pub fn new(id: &'static str, label: &str, shapes: Vec<Shape>) -> Self {
        Self { id: id.into(), class: id, label: label.into(), colour: None, shapes }
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
    /// The groups, from the back to the front.
    pub groups: Vec<Group>,
}

/// How far the roller's path and the normal reach beyond the roller, in its radii.
pub(crate) const PATH_OVER_RADIUS: f64 = 0.6;
/// Text height and pen over the width of what is drawn.
pub(crate) const TEXT_OVER_WIDTH: f64 = 1.0 / 75.0;
pub(crate) const STROKE_OVER_TEXT: f64 = 0.06;
/// Width of a letter over the text height, on the safe side.
const LETTER_OVER_TEXT: f64 = 0.65;
/// Lines of text per text height.
pub(crate) const LINE_SPACING: f64 = 1.6;

pub(crate) struct Pen {
    /// Height of the small text, mm.
    pub(crate) text: f64,
}

impl Pen {
    pub(crate) fn words(&self, x: f64, y: f64, text: impl Into<String>) -> Shape {
        Shape::Text { at: Vector2::new(x, y), height: self.text, anchor: TextAnchor::Start, text: text.into() }
    }

    pub(crate) fn middle(&self, at: Vector2<f64>, text: impl Into<String>) -> Shape {
        Shape::Text { at, height: self.text, anchor: TextAnchor::Middle, text: text.into() }
    }

    /// A text beside a circle of a radius about a place, on the side where there is more room.
    pub(crate) fn beside(
        &self,
        middle: Vector2<f64>,
        radius: f64,
        beyond: f64,
        drawn: &Extents,
        text: String,
    ) -> Shape {
        let away = radius + 0.8 * self.text;
        #[expect(clippy::cast_precision_loss, reason = "a few words")]
        let length = away + LETTER_OVER_TEXT * self.text * text.chars().count() as f64;
        let outwards = if middle.x < 0.0 { -1.0 } else { 1.0 };
        let room = if middle.x < 0.0 { middle.x - drawn.least.x } else { drawn.largest.x - middle.x };
        let fits = length <= room;
        let (side, reach) = if fits { (outwards, away) } else { (-outwards, away + beyond) };
        let at = middle + Vector2::new(side * reach, -0.4 * self.text);
        let anchor = if side < 0.0 { TextAnchor::End } else { TextAnchor::Start };
        Shape::Text { at, height: self.text, anchor, text }
    }
}

/// The roller with its path and the normal of the cam, mm.
pub(crate) fn roller(centre: Vector2<f64>, drive: Vector2<f64>, outward: Vector2<f64>, radius: f64) -> Vec<Shape> {
    let path = radius * (1.0 + PATH_OVER_RADIUS);
    vec![
        Shape::Entity(Entity::Circle(centre, radius)),
        Shape::Line(centre - drive * path, centre + drive * path),
        Shape::Line(centre - outward * radius, centre + outward * path),
    ]
}

/// Title, figures and checks below a drawing, and what the sheet then covers.
pub(crate) fn with_facts(pen: &Pen, report: &Report, drawn: &Extents, mut groups: Vec<Group>) -> Sheet {
    let title = report.title();
    let (facts, bottom) = facts(pen, &title, &report.figures(), &report.checks, drawn);
    groups.push(Group::new("scale", "scale", scale_bar(pen, drawn)));
    groups.push(Group::new("facts", "facts", facts));
    let margin = 2.0 * pen.text;
    Sheet {
        title,
        extents: Extents {
            least: Vector2::new(drawn.least.x - margin, bottom - margin),
            largest: drawn.largest + Vector2::new(margin, margin),
        },
        stroke: STROKE_OVER_TEXT * pen.text,
        groups,
    }
}

/// A bar of a round length, a fifth of the width at the most.
fn scale_bar(pen: &Pen, drawn: &Extents) -> Vec<Shape> {
    let room = 0.2 * drawn.size().x;
    let decade = libm::pow(10.0, libm::log10(room).floor());
    let length = [5.0, 2.0, 1.0].into_iter().map(|n| n * decade).find(|length| *length <= room).unwrap_or(decade);
    let (left, y) = (drawn.least.x, drawn.least.y);
    let tick = 0.5 * pen.text;
    let mut shapes = vec![Shape::Line(Vector2::new(left, y), Vector2::new(left + length, y))];
    for fifth in 0..=5 {
        let x = left + length * f64::from(fifth) / 5.0;
        shapes.push(Shape::Line(Vector2::new(x, y), Vector2::new(x, y + tick)));
    }
    shapes.push(pen.words(left, y + 1.6 * tick, format!("{} mm", rounded(length))));
    shapes
}

/// Title, figures and checks below the drawing, and how far down they reach.
fn facts(pen: &Pen, title: &str, figures: &[String], checks: &[Finding], drawn: &Extents) -> (Vec<Shape>, f64) {
    let (left, top) = (drawn.least.x, drawn.least.y - 3.0 * pen.text);
    let width = drawn.size().x;
    let line = LINE_SPACING * pen.text;
    let mut shapes = vec![Shape::Text {
        at: Vector2::new(left, top),
        height: 1.5 * pen.text,
        anchor: TextAnchor::Start,
        text: title.into(),
    }];
    let rows = figures.len().max(checks.len());
    let row = |index: usize, x: f64, text: String| {
        #[expect(clippy::cast_precision_loss, reason = "a few rows")]
        let y = top - line * (index + 1) as f64 - 0.4 * pen.text;
        pen.words(x, y, text)
    };
    shapes.extend(figures.iter().enumerate().map(|(index, text)| row(index, left, text.clone())));
    let checks = checks.iter().map(check_words).enumerate();
    shapes.extend(checks.map(|(index, text)| row(index, left + 0.46 * width, text)));
    #[expect(clippy::cast_precision_loss, reason = "a few rows")]
    let bottom = top - line * rows as f64;
    (shapes, bottom)
}

fn check_words(finding: &Finding) -> String {
    let verdict = finding.verdict.word();
    if !finding.value.is_finite() {
        return format!("{verdict}  {}  –", finding.check);
    }
    let limit = finding.limit.map_or(String::new(), |limit| format!(", limit {}", rounded(limit)));
    let unit = if finding.unit == "1" { String::new() } else { format!(" {}", finding.unit) };
    format!("{verdict}  {}  {}{unit}{limit}", finding.check, rounded(finding.value))
}

/// A number for a person: three decimals at the most, no trailing zeros.
pub(crate) fn rounded(value: f64) -> String {
    if !value.is_finite() {
        return "none".into();
    }
    let rounded = (value * 1e3).round() / 1e3;
    if rounded == 0.0 && value != 0.0 { format!("{value:.1e}") } else { rounded.to_string() }
}
