//! The review sheet of a cam plate.

use super::Wedge;
use crate::body::{Body, Drawn};
use crate::geometry::contour::{Extents, Segment};
use crate::geometry::{Entity, MILLIMETRES};
use crate::motion::Motion;
use crate::profile::outline::OutlineError;
use crate::report::Report;
use crate::report::sheet::{
    Group, PATH_OVER_RADIUS, Pen, Shape, Sheet, TEXT_OVER_WIDTH, TextAnchor, roller, with_facts,
};
use nalgebra::Vector2;

/// The review sheet of a plate: both flanks with their pitch curves, the rollers where the pressure angle is worst, the
/// bed's axis and the overrun.
///
/// # Errors
/// [`OutlineError`] when the pitch curve cannot be drawn.
pub(super) fn sheet(plate: &Wedge, drawn: &Drawn, report: &Report) -> Result<Sheet, OutlineError> {
    let radius = MILLIMETRES * plate.data.roller_radius;
    let lower = plate.pitch_curve()?;
    let mirrored = |segment: &Segment| {
        let flip = |point: Vector2<f64>| Vector2::new(point.x, -point.y);
        Segment { start: flip(segment.start), end: flip(segment.end), bulge: -segment.bulge }
    };
    let both: Vec<Segment> = lower.iter().copied().chain(lower.iter().map(mirrored)).collect();
    let reach = Vector2::new(radius, radius) * (1.0 + PATH_OVER_RADIUS);
    let outlines = drawn.parts.iter().map(|part| part.outline.contour.extents());
    let inner = outlines.chain(both.iter().map(Segment::extents)).reduce(|a, b| a.with(&b));
    let inner = inner.unwrap_or(Extents { least: Vector2::zeros(), largest: Vector2::zeros() });
    let profile = drawn.parts.iter().map(|part| Shape::Entity(Entity::Polyline(part.outline.contour.clone())));
    let profile = profile.collect();
    let drawn = Extents { least: inner.least - reach, largest: inner.largest + reach };
    let pen = Pen { text: TEXT_OVER_WIDTH * drawn.size().x };
    let pitch_curve = both.iter().map(|s| Shape::Arc(s.start, s.end, s.bulge)).collect();
    let group = Group::new;
    let groups = vec![
        group("profile", "profile", profile),
        group("axis", "bed's axis", axes(&pen, plate, &drawn)),
        group("pitch-curve", "pitch curves", pitch_curve),
        group("roller", "rollers at their worst pressure angle", rollers(&pen, plate, &drawn)),
    ];
    Ok(with_facts(&pen, report, &drawn, groups))
}

/// The bed's axis, and a mark where the overrun starts and where it ends.
fn axes(pen: &Pen, plate: &Wedge, drawn: &Extents) -> Vec<Shape> {
    let mut shapes = vec![Shape::Line(Vector2::new(drawn.least.x, 0.0), Vector2::new(drawn.largest.x, 0.0))];
    let stroke = MILLIMETRES * plate.stroke();
    for (x, words) in [(0.0, "x = 0".to_owned()), (stroke, format!("x = r = {stroke} mm"))] {
        let (piece, at) = plate.motion.locate(x / MILLIMETRES);
        let centre = plate.curves().contact(piece, at).curve.point * MILLIMETRES;
        shapes.push(Shape::Line(centre, Vector2::new(centre.x, -centre.y)));
        shapes.push(pen.middle(Vector2::new(centre.x, drawn.least.y + 0.3 * pen.text), words));
    }
    shapes
}

/// The rollers of both flanks where the pressure angle is worst, with path and normal.
fn rollers(pen: &Pen, plate: &Wedge, drawn: &Extents) -> Vec<Shape> {
    let curves = plate.curves();
    let worst = plate.pressure_angle();
    let (piece, x) = curves.motion.locate(worst.at);
    let contact = curves.contact(piece, x);
    let drive = contact.drive;
    let radius = MILLIMETRES * plate.data.roller_radius;
    let flip = |v: Vector2<f64>| Vector2::new(v.x, -v.y);
    let centre = contact.curve.point * MILLIMETRES;
    let mut shapes = roller(centre, drive, contact.curve.outward(), radius);
    shapes.extend(roller(flip(centre), flip(drive), flip(contact.curve.outward()), radius));
    let text = format!("pressure angle {:.2}° at x = {:.2} mm", worst.value.to_degrees(), MILLIMETRES * worst.at);
    let corner = Vector2::new(drawn.largest.x, drawn.largest.y - pen.text);
    shapes.push(Shape::Text { at: corner, height: pen.text, anchor: TextAnchor::End, text });
    shapes
}
