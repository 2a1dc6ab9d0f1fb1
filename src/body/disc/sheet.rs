//! What the review sheet of a disc cam shows.

use super::Disc;
use crate::body::part::{as_turned, point_as_turned};
use crate::body::sheet::{PATH_OVER_RADIUS, axes, bore, lost_motion, overall, places, pressure_angle, roller, turning};
use crate::body::{Body, Drawn};
use crate::follower::Element;
use crate::geometry::contour::{Contour, Edge, Extents, Vertex};
use crate::geometry::{Entity, MILLIMETRES};
use crate::profile::envelope;
use crate::profile::outline::{Outline, OutlineError, pitch};
use crate::report::sheet::{Facts, Group, Mark, Shape, View, rounded};
use nalgebra::Vector2;

/// Half the length at which a flat face is shown, over the base radius.
const FACE_OVER_BASE: f64 = 0.8;
/// Points of a stretch of lost motion.
const LOST_POINTS: u32 = 48;

const NOWHERE: Extents = Extents { least: Vector2::new(0.0, 0.0), largest: Vector2::new(0.0, 0.0) };

/// What the review sheet of a disc cam shows.
///
/// # Errors
/// [`OutlineError`] when the pitch curve cannot be drawn.
pub(super) fn view(disc: &Disc, drawn: &Drawn) -> Result<View, OutlineError> {
    // A flat face and a knife edge have no pitch curve: their curve is the profile, which may be undercut.
    let part = drawn.parts.first();
    let pitch_curve = match disc.roller_radius() {
        Some(radius) => Some(pitch_curve(disc, part.map(|part| &part.outline), MILLIMETRES * radius)?),
        None => None,
    };
    let outline = part.map_or(NOWHERE, |part| part.outline.contour.extents());
    let (prime, base) = (MILLIMETRES * disc.prime_radius(), MILLIMETRES * disc.base_radius());
    let profile = part.map(|part| Shape::Entity(Entity::Polyline(part.outline.contour.clone())));
    let holes = part.map_or_else(Vec::new, |part| part.holes().into_iter().map(Shape::Entity).collect());
    let circle = |radius: f64| vec![Shape::Entity(Entity::Circle(Vector2::zeros(), radius))];
    let group = Group::new;
    let crossed = pitch_curve.as_ref().map_or(outline, |curve| curve.extents().with(&outline));
    let mut groups = vec![
        group("profile", "profile", profile.into_iter().collect()).told(),
        group("bore", "bore", holes),
        group("axis", "axes", axes(&crossed)),
        group("base-circle", &format!("base circle R {}", rounded(base)), circle(base)).told(),
    ];
    if let Some(pitch_curve) = pitch_curve {
        groups.push(group("prime-circle", &format!("prime circle R {}", rounded(prime)), circle(prime)).told());
        let curve = vec![Shape::Entity(Entity::Polyline(pitch_curve))];
        groups.push(group("pitch-curve", "pitch curve", curve).told());
    }
    groups.extend(lost_motion(lost(disc)));
    let (shapes, angle) = worst_place(disc);
    groups.push(group("roller", "follower at its worst pressure angle", shapes).told());
    let zero = if disc.load.is_some() { "θ = 0, φ = 0" } else { "θ = 0" };
    let at_zero = profile_radius_at_zero(part.map(|part| &part.outline.contour), base);
    let marks = [
        overall(&outline),
        bore(&disc.machine, part.and_then(|part| part.balancing.as_ref())),
        turning(&disc.machine, base, at_zero, zero),
        angle,
        farthest(part.map(|part| &part.outline.contour)).into_iter().collect(),
    ];
    Ok(View {
        groups,
        marks: marks.into_iter().flatten().collect(),
        tables: places(disc.curves()),
        facts: Facts::of(&disc.machine, part.and_then(|part| part.weight(&disc.machine).mass_kg)),
        notes: Vec::new(),
        lost: if disc.least_radius().value <= disc.curves().offset() { disc.lost_motion() } else { Vec::new() },
    })
}

/// Largest distance of an outline from the exact one, mm, at which its parallel is shown: a fifth of a thin pen.
const SHOWN: f64 = 0.05;
/// Least radius of an arc of the pitch curve, mm, that is taken from the outline: within it the roller turns about its centre.
const LEAST_RADIUS: f64 = 1e-3;
/// Largest turn of a joint without a corner, rad.
const SMOOTH: f64 = 1e-6;

/// The follower's curve as it lies in the drawing: beside an outline of tangent arcs and lines the same about the same centres, else
/// fitted anew.
fn pitch_curve(disc: &Disc, outline: Option<&Outline>, radius: f64) -> Result<Contour, OutlineError> {
    match outline.filter(|outline| outline.deviation <= SHOWN).and_then(|outline| beside(&outline.contour, radius)) {
        Some(curve) => Ok(curve),
        None => Ok(as_turned(&disc.machine, pitch(disc.curves())?.contour)),
    }
}

/// The parallel so far outside a contour of tangent arcs and lines that has the metal on its left; `None` of any other.
fn beside(contour: &Contour, distance: f64) -> Option<Contour> {
    if contour.tangent_breaks().iter().any(|turn| turn.abs() > SMOOTH) {
        return None;
    }
    let moved = |edge: Edge| {
        let segment = edge.segment()?;
        let left = segment.bulge > 0.0;
        // A line has an infinite radius.
        if !left && segment.radius().abs() < distance + LEAST_RADIUS {
            return None;
        }
        let tangent = segment.start_tangent();
        Some(Vertex::new(segment.start + Vector2::new(tangent.y, -tangent.x) * distance, segment.bulge))
    };
    Some(Contour { vertices: contour.edges().map(moved).collect::<Option<_>>()? })
}

/// Where the outline crosses the positive X axis, mm, to a hundredth of an edge; the base radius where it does not.
fn profile_radius_at_zero(outline: Option<&Contour>, base: f64) -> f64 {
    const STEPS: u32 = 100;
    // Farther from the axis than this, mm, no rounding brings an edge across it.
    const CLEAR: f64 = 1e-3;
    let crossing = |edge: Edge| {
        let extents = edge.extents();
        if extents.least.y > CLEAR || extents.largest.y < -CLEAR || extents.largest.x < -CLEAR {
            return None;
        }
        let points: Vec<Vector2<f64>> = (0..=STEPS).map(|step| edge.at(f64::from(step) / f64::from(STEPS)).0).collect();
        let pairs = points.iter().zip(points.iter().skip(1));
        let across = pairs.filter(|(a, b)| a.x > 0.0 && (a.y <= 0.0) != (b.y <= 0.0));
        across.map(|(a, b)| 0.5 * (a.x + b.x)).reduce(f64::max)
    };
    outline.and_then(|outline| outline.edges().filter_map(crossing).reduce(f64::max)).unwrap_or(base)
}

/// The largest radius of the outline.
fn farthest(outline: Option<&Contour>) -> Option<Mark> {
    let points = outline?.edges().map(|edge| edge.start());
    let to = points.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    Some(Mark::Radius { centre: Vector2::zeros(), to, text: format!("R {}", rounded(to.norm())) })
}

/// Radius of the roller, mm, or half the length at which a flat face is shown.
fn shown_radius(disc: &Disc) -> f64 {
    disc.roller_radius().map_or(FACE_OVER_BASE * MILLIMETRES * disc.base_radius(), |radius| MILLIMETRES * radius)
}

/// The follower where the pressure angle is worst, with its path and the normal of the cam, and the angle between them.
fn worst_place(disc: &Disc) -> (Vec<Shape>, Vec<Mark>) {
    let curves = disc.curves();
    let worst = disc.pressure_angle();
    let (piece, angle) = curves.motion.locate(worst.at);
    let contact = curves.contact(piece, angle);
    let turned = |vector| point_as_turned(&disc.machine, vector);
    let (centre, radius) = (turned(contact.curve.point * MILLIMETRES), shown_radius(disc));
    let degrees = disc.place(worst.at).cam_deg.unwrap_or(0.0);
    let text = format!("α = {:.2}° at θ = {degrees:.2}°", worst.value.to_degrees());
    let (drive, along) = (turned(contact.drive), turned(contact.curve.tangent));
    let outward = turned(contact.curve.outward());
    match curves.element() {
        Element::Roller { radius: 0.0 } => {
            let shapes =
                vec![Shape::Line(centre, centre + drive * radius), Shape::Line(centre, centre + outward * radius)];
            (shapes, pressure_angle(centre, drive, outward, radius / (1.0 + PATH_OVER_RADIUS), text))
        }
        Element::Roller { .. } => {
            (roller(centre, drive, outward, radius), pressure_angle(centre, drive, outward, radius, text))
        }
        Element::Face => {
            let shapes = vec![
                Shape::Line(centre - along * radius, centre + along * radius),
                Shape::Line(centre, centre + drive * radius),
            ];
            let label = Mark::Label { class: "roller", at: centre + drive * radius, towards: drive, text };
            (shapes, vec![label])
        }
    }
}

/// The stretches of the follower's curve on which the follower loses its motion, mm.
fn lost(disc: &Disc) -> Vec<Vec<Vector2<f64>>> {
    let curves = disc.curves();
    if disc.least_radius().value > curves.offset() {
        return Vec::new();
    }
    let losses = envelope::losses(curves).unwrap_or_default();
    let at = |parameter: f64| {
        let (piece, angle) = curves.motion.locate(parameter);
        point_as_turned(&disc.machine, curves.contact(piece, angle).curve.point * MILLIMETRES)
    };
    let stretch = |loss: &envelope::Loss| {
        let share = |step: u32| f64::from(step) / f64::from(LOST_POINTS);
        (0..=LOST_POINTS).map(|step| at(loss.from + (loss.to - loss.from) * share(step))).collect()
    };
    losses.iter().map(stretch).collect()
}
