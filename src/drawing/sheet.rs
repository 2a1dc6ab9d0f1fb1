//! The review sheet: what a person looks at before the metal is cut. Millimetres, y upwards, true size.

use super::outline::{MILLIMETRES, OutlineError, pitch};
use super::report::Report;
use super::{Entity, Part, as_turned, point_as_turned};
use crate::cam::extremes;
use crate::cam::rotary::Rotary;
use crate::checks::{Finding, Verdict, cam_degrees};
use crate::contour::Extents;
use crate::follower::Follower;
use crate::law::Law;
use crate::machine::Rotation;
use nalgebra::Vector2;

/// Where a text hangs on its place.
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
        /// How it hangs there.
        anchor: TextAnchor,
        /// The words.
        text: String,
    },
}

/// Shapes that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Name for programs, ASCII without spaces; also the class its style goes by.
    pub id: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// What is in it.
    pub shapes: Vec<Shape>,
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

/// The pitch curve is only looked at: a fifth of a thin pen.
const PITCH_TOLERANCE: f64 = 0.05;
/// How far the roller's path and the normal reach beyond the roller, in its radii.
const PATH_OVER_RADIUS: f64 = 0.6;
/// Text height and pen over the width of what is drawn.
const TEXT_OVER_WIDTH: f64 = 1.0 / 75.0;
const STROKE_OVER_TEXT: f64 = 0.06;
/// Width of a letter over the text height, on the safe side.
const LETTER_OVER_TEXT: f64 = 0.65;
/// Lines of text per text height.
const LINE_SPACING: f64 = 1.6;

struct Pen<'a> {
    rotary: &'a Rotary,
    /// Height of the small text, mm.
    text: f64,
}

impl Pen<'_> {
    fn point(&self, metres: Vector2<f64>) -> Vector2<f64> {
        point_as_turned(self.rotary, metres * MILLIMETRES)
    }

    fn words(&self, x: f64, y: f64, text: impl Into<String>) -> Shape {
        Shape::Text { at: Vector2::new(x, y), height: self.text, anchor: TextAnchor::Start, text: text.into() }
    }

    fn middle(&self, at: Vector2<f64>, text: impl Into<String>) -> Shape {
        Shape::Text { at, height: self.text, anchor: TextAnchor::Middle, text: text.into() }
    }
}

/// The review sheet of a cam.
///
/// # Errors
/// [`OutlineError`] when the pitch curve cannot be drawn.
pub fn sheet(rotary: &Rotary, part: &Part, report: &Report) -> Result<Sheet, OutlineError> {
    let pitch_curve = as_turned(rotary, pitch(&rotary.disc, PITCH_TOLERANCE)?.contour);
    let roller = MILLIMETRES * rotary.disc.follower.roller_radius();
    let inner = pitch_curve.extents();
    let reach = Vector2::new(roller, roller) * (1.0 + PATH_OVER_RADIUS);
    let drawn = Extents { least: inner.least - reach, largest: inner.largest + reach };
    let pen = Pen { rotary, text: TEXT_OVER_WIDTH * drawn.size().x };
    let (base, prime) = (report.cam.base_radius_mm, report.cam.prime_radius_mm);
    let group = |id, label, shapes| Group { id, label, shapes };
    let profile = vec![Shape::Entity(Entity::Polyline(part.outline.contour.clone()))];
    let bore = part.holes().into_iter().map(Shape::Entity).collect();
    let (facts, bottom) = facts(&pen, report, &drawn);
    let groups = vec![
        group("profile", "profile", profile),
        group("bore", "bore", bore),
        group("axis", "axes", axes(&pen, &drawn)),
        group("base-circle", "base circle", circle_with_name(&pen, base, 0.4, "base circle")),
        group("prime-circle", "prime circle", circle_with_name(&pen, prime, -1.1, "prime circle")),
        group("pitch-curve", "pitch curve", vec![Shape::Entity(Entity::Polyline(pitch_curve))]),
        group("roller", "roller at its worst pressure angle", worst_roller(&pen, &drawn)),
        group("rotation", "rotation of the cam", rotation_arrow(&pen, base)),
        group("scale", "scale", scale_bar(&pen, &drawn)),
        group("facts", "facts", facts),
    ];
    let margin = 2.0 * pen.text;
    Ok(Sheet {
        title: format!("{}, rotary cam for {} rpm", report.machine, report.rpm),
        extents: Extents {
            least: Vector2::new(drawn.least.x - margin, bottom - margin),
            largest: drawn.largest + Vector2::new(margin, margin),
        },
        stroke: STROKE_OVER_TEXT * pen.text,
        groups,
    })
}

fn axes(pen: &Pen<'_>, drawn: &Extents) -> Vec<Shape> {
    let zero = Vector2::new(drawn.largest.x - 3.0 * pen.text, 0.4 * pen.text);
    vec![
        Shape::Line(Vector2::new(drawn.least.x, 0.0), Vector2::new(drawn.largest.x, 0.0)),
        Shape::Line(Vector2::new(0.0, drawn.least.y), Vector2::new(0.0, drawn.largest.y)),
        pen.middle(zero, "θ = 0, φ = 0"),
    ]
}

/// A circle with its name below the shaft, `above` text heights over the line: one inside, one outside never meet.
fn circle_with_name(pen: &Pen<'_>, radius: f64, above: f64, name: &str) -> Vec<Shape> {
    let at = Vector2::new(0.0, -radius + above * pen.text);
    vec![Shape::Entity(Entity::Circle(Vector2::zeros(), radius)), pen.middle(at, format!("{name} R {}", shown(radius)))]
}

/// The roller where the pressure angle is worst, with its path and the normal of the cam.
fn worst_roller(pen: &Pen<'_>, drawn: &Extents) -> Vec<Shape> {
    let disc = &pen.rotary.disc;
    let worst = extremes::pressure_angle(disc);
    let (piece, angle) = disc.law.locate(worst.at);
    let contact = disc.contact(piece, angle);
    let drive = disc.follower.pitch(angle, &contact.lift).drive;
    let radius = disc.follower.roller_radius();
    let centre = contact.pitch.point;
    let outward = contact.pitch.outward();
    let degrees = worst.value.to_degrees();
    let text = format!("α = {degrees:.2}° at θ = {:.2}°", cam_degrees(worst.at));
    // Beside the roller, towards the near edge of the sheet, or inwards beyond its path where that is too near.
    let middle = pen.point(centre);
    let away = MILLIMETRES * radius + 0.8 * pen.text;
    #[expect(clippy::cast_precision_loss, reason = "a few words")]
    let length = away + LETTER_OVER_TEXT * pen.text * text.chars().count() as f64;
    let outwards = if middle.x < 0.0 { -1.0 } else { 1.0 };
    let room = if middle.x < 0.0 { middle.x - drawn.least.x } else { drawn.largest.x - middle.x };
    let side = if length <= room { outwards } else { -outwards };
    let beyond = if length <= room { away } else { away + MILLIMETRES * radius * PATH_OVER_RADIUS };
    let label = middle + Vector2::new(side * beyond, -0.4 * pen.text);
    let anchor = if side < 0.0 { TextAnchor::End } else { TextAnchor::Start };
    let path = radius * (1.0 + PATH_OVER_RADIUS);
    vec![
        Shape::Entity(Entity::Circle(pen.point(centre), MILLIMETRES * radius)),
        Shape::Line(pen.point(centre - drive * path), pen.point(centre + drive * path)),
        Shape::Line(pen.point(centre - outward * radius), pen.point(centre + outward * path)),
        Shape::Text { at: label, height: pen.text, anchor, text },
    ]
}

/// How the cam turns: an open arc about the shaft with a head.
fn rotation_arrow(pen: &Pen<'_>, base: f64) -> Vec<Shape> {
    let bore = MILLIMETRES * pen.rotary.machine.cam.bore_radius.unwrap_or(0.0);
    let radius = 0.5 * (bore + base);
    // Clockwise in the drawing of a clockwise cam, over 75° about the upper half of the vertical.
    let sense = match pen.rotary.machine.cam.rotation {
        Rotation::Clockwise => -1.0,
        Rotation::CounterClockwise => 1.0,
    };
    let on = |degrees: f64, radius: f64| {
        let angle = degrees.to_radians();
        Vector2::new(radius * libm::cos(angle), radius * libm::sin(angle))
    };
    let (start, sweep) = (90.0 - sense * 37.5, sense * 75.0);
    let end = start + sweep;
    let head = 1.2 * pen.text;
    let ahead = sense * (head / radius).to_degrees();
    vec![
        Shape::Arc(on(start, radius), on(end, radius), libm::tan(0.25 * sweep.to_radians())),
        Shape::Triangle([on(end, radius - 0.35 * head), on(end, radius + 0.35 * head), on(end + ahead, radius)]),
    ]
}

/// A bar of a round length, a fifth of the width at the most.
fn scale_bar(pen: &Pen<'_>, drawn: &Extents) -> Vec<Shape> {
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
    shapes.push(pen.words(left, y + 1.6 * tick, format!("{} mm", shown(length))));
    shapes
}

/// Title, figures and checks below the drawing, and how far down they reach.
fn facts(pen: &Pen<'_>, report: &Report, drawn: &Extents) -> (Vec<Shape>, f64) {
    let (left, top) = (drawn.least.x, drawn.least.y - 3.0 * pen.text);
    let width = drawn.size().x;
    let line = LINE_SPACING * pen.text;
    let title = format!("{}, rotary cam for {} rpm", report.machine, report.rpm);
    let mut shapes = vec![Shape::Text {
        at: Vector2::new(left, top),
        height: 1.5 * pen.text,
        anchor: TextAnchor::Start,
        text: title,
    }];
    let (cam, law, force) = (&report.cam, &report.law, &report.force);
    let mut figures = vec![
        format!("base radius {} mm, roller {} mm", shown(cam.base_radius_mm), shown(cam.roller_radius_mm)),
        format!("lift {:.3} mm, column {:.3} mm", cam.max_lift_mm, law.column_length_mm),
        format!("Δx {:.3} mm at x = {:.2} mm", law.dx_max_mm, law.dx_max_at_x_mm),
        format!("inertia {:.0} N, residual {:.2} N", force.inertia_max_n, force.residual_max_n),
        format!("fixed bottom would leave {:.0} N", force.residual_fixed_bottom_max_n),
    ];
    if let Some(outline) = &report.outline {
        let micrometres = 1e3 * outline.deviation_max_mm;
        figures.push(format!("{} arcs, {micrometres:.3} µm from the exact curve", outline.arcs));
    }
    if let Some(mass) = cam.mass_kg {
        figures.push(format!("mass {mass:.2} kg"));
    }
    let rows = figures.len().max(report.checks.len());
    let row = |index: usize, x: f64, text: String| {
        #[expect(clippy::cast_precision_loss, reason = "a few rows")]
        let y = top - line * (index + 1) as f64 - 0.4 * pen.text;
        pen.words(x, y, text)
    };
    shapes.extend(figures.into_iter().enumerate().map(|(index, text)| row(index, left, text)));
    let checks = report.checks.iter().map(check_words).enumerate();
    shapes.extend(checks.map(|(index, text)| row(index, left + 0.46 * width, text)));
    #[expect(clippy::cast_precision_loss, reason = "a few rows")]
    let bottom = top - line * rows as f64;
    (shapes, bottom)
}

fn check_words(finding: &Finding) -> String {
    let verdict = match finding.verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "FAIL",
        Verdict::Info => "info",
    };
    let limit = finding.limit.map_or(String::new(), |limit| format!(", limit {}", shown(limit)));
    format!("{verdict}  {}  {} {}{limit}", finding.check, shown(finding.value), finding.unit)
}

/// A number for a person: three decimals at the most, no trailing zeros.
fn shown(value: f64) -> String {
    if !value.is_finite() {
        return "none".into();
    }
    let rounded = (value * 1e3).round() / 1e3;
    if rounded == 0.0 && value != 0.0 { format!("{value:.1e}") } else { rounded.to_string() }
}
