//! The review sheet of a disc cam.

use super::Disc;
use crate::body::part::{as_turned, point_as_turned};
use crate::body::{Body, Drawn};
use crate::follower::Element;
use crate::geometry::contour::{Contour, Extents};
use crate::geometry::{Entity, MILLIMETRES};
use crate::machine::Rotation;
use crate::profile::outline::{OutlineError, pitch};
use crate::report::Report;
use crate::report::sheet::{Group, PATH_OVER_RADIUS, Pen, Shape, Sheet, TEXT_OVER_WIDTH, roller, rounded, with_facts};
use nalgebra::Vector2;

/// Half the length at which a flat face is shown, over the base radius.
const FACE_OVER_BASE: f64 = 0.8;

const NOWHERE: Extents = Extents { least: Vector2::new(0.0, 0.0), largest: Vector2::new(0.0, 0.0) };

/// The review sheet of a disc cam.
///
/// # Errors
/// [`OutlineError`] when the pitch curve cannot be drawn.
pub(super) fn sheet(disc: &Disc, drawn: &Drawn, report: &Report) -> Result<Sheet, OutlineError> {
    // A flat face has no pitch curve: its curve is the profile, which may be undercut.
    let pitch_curve = match disc.curves().element() {
        Element::Roller { .. } => Some(as_turned(&disc.machine, pitch(disc.curves())?.contour)),
        Element::Face => None,
    };
    let outlines: Vec<Contour> = drawn.parts.iter().map(|part| part.outline.contour.clone()).collect();
    let holes = drawn.parts.iter().flat_map(super::Part::holes).map(Shape::Entity).collect();
    let roller = shown_radius(disc);
    let profile = drawn.parts.first().map(|part| part.outline.contour.extents());
    let inner = pitch_curve.as_ref().map(Contour::extents).or(profile).unwrap_or(NOWHERE);
    let reach = Vector2::new(roller, roller) * (1.0 + PATH_OVER_RADIUS);
    let drawn = Extents { least: inner.least - reach, largest: inner.largest + reach };
    let pen = Pen { text: TEXT_OVER_WIDTH * drawn.size().x };
    let prime = MILLIMETRES * disc.prime_radius();
    let base = MILLIMETRES * disc.base_radius();
    let group = Group::new;
    let profile = outlines.into_iter().map(|contour| Shape::Entity(Entity::Polyline(contour))).collect();
    let mut groups = vec![
        group("profile", "profile", profile),
        group("bore", "bore", holes),
        group("axis", "axes", axes(&pen, disc, &drawn)),
        group("base-circle", "base circle", circle_with_name(&pen, base, 0.4, "base circle")),
    ];
    if let Some(pitch_curve) = pitch_curve {
        groups.push(group("prime-circle", "prime circle", circle_with_name(&pen, prime, -1.1, "prime circle")));
        groups.push(group("pitch-curve", "pitch curve", vec![Shape::Entity(Entity::Polyline(pitch_curve))]));
    }
    groups.push(group("roller", "follower at its worst pressure angle", worst_place(&pen, disc, &drawn)));
    groups.push(group("rotation", "rotation of the cam", rotation_arrow(&pen, disc, base)));
    Ok(with_facts(&pen, report, &drawn, groups))
}

fn axes(pen: &Pen, disc: &Disc, drawn: &Extents) -> Vec<Shape> {
    let zero = Vector2::new(drawn.largest.x - 3.0 * pen.text, 0.4 * pen.text);
    vec![
        Shape::Line(Vector2::new(drawn.least.x, 0.0), Vector2::new(drawn.largest.x, 0.0)),
        Shape::Line(Vector2::new(0.0, drawn.least.y), Vector2::new(0.0, drawn.largest.y)),
        pen.middle(zero, if disc.load.is_some() { "θ = 0, φ = 0" } else { "θ = 0" }),
    ]
}

/// Radius of the roller, mm, or half the length at which a flat face is shown.
fn shown_radius(disc: &Disc) -> f64 {
    disc.roller_radius().map_or(FACE_OVER_BASE * MILLIMETRES * disc.base_radius(), |radius| MILLIMETRES * radius)
}

/// A circle with its name below the shaft, `above` text heights over the line: one inside, one outside never meet.
fn circle_with_name(pen: &Pen, radius: f64, above: f64, name: &str) -> Vec<Shape> {
    let at = Vector2::new(0.0, -radius + above * pen.text);
    vec![
        Shape::Entity(Entity::Circle(Vector2::zeros(), radius)),
        pen.middle(at, format!("{name} R {}", rounded(radius))),
    ]
}

/// The follower where the pressure angle is worst, with its path and the normal of the cam.
fn worst_place(pen: &Pen, disc: &Disc, drawn: &Extents) -> Vec<Shape> {
    let curves = disc.curves();
    let worst = disc.pressure_angle();
    let (piece, angle) = curves.motion.locate(worst.at);
    let contact = curves.contact(piece, angle);
    let turned = |vector| point_as_turned(&disc.machine, vector);
    let (centre, radius) = (turned(contact.curve.point * MILLIMETRES), shown_radius(disc));
    let text =
        format!("α = {:.2}° at θ = {:.2}°", worst.value.to_degrees(), disc.place(worst.at).cam_deg.unwrap_or(0.0));
    let (drive, along) = (turned(contact.drive), turned(contact.curve.tangent));
    let mut shapes = match curves.element() {
        Element::Roller { .. } => roller(centre, drive, turned(contact.curve.outward()), radius),
        Element::Face => vec![
            Shape::Line(centre - along * radius, centre + along * radius),
            Shape::Line(centre, centre + drive * radius),
        ],
    };
    shapes.push(pen.beside(centre, radius, radius * PATH_OVER_RADIUS, drawn, text));
    shapes
}

/// How the cam turns: an open arc about the shaft with a head.
fn rotation_arrow(pen: &Pen, disc: &Disc, base: f64) -> Vec<Shape> {
    let bore = MILLIMETRES * disc.machine.cam.bore_radius.unwrap_or(0.0);
    let radius = 0.5 * (bore + base);
    // Clockwise in the drawing of a clockwise cam, over 75° about the upper half of the vertical.
    let sense = match disc.machine.cam.rotation {
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
