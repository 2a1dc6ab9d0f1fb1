//! What the sheets of several bodies show alike.

use super::balancing::Balancing;
use super::part::point_as_turned;
use super::torque::{self, Cut};
use crate::follower::Element;
use crate::geometry::contour::Extents;
use crate::geometry::{Entity, MILLIMETRES};
use crate::machine::{Machine, Rotation};
use crate::motion::Quantity;
use crate::numeric::decimal::fixed;
use crate::profile::Curves;
use crate::profile::followed::Followed;
use crate::report::sheet::{Group, Mark, PlaceTable, Shape, rounded};
use crate::report::trace::Trace;
use crate::table::turned;
use nalgebra::Vector2;
use std::sync::Arc;

/// How far the roller's path and the normal reach beyond the roller, in its radii.
pub(super) const PATH_OVER_RADIUS: f64 = 0.6;
/// How far axes reach beyond what is drawn, as a share of it.
const AXIS_BEYOND: f64 = 0.04;
/// Places of the diagram of the acceleration lie no farther apart than this share of the motion.
const TRACE_SHARE: f64 = 1.0 / 180.0;
/// Degrees of cam angle over which the sense of the angle is shown.
const SENSE_DEG: f64 = 24.0;

/// A roller with its path and the normal of the cam, mm.
pub(super) fn roller(centre: Vector2<f64>, drive: Vector2<f64>, outward: Vector2<f64>, radius: f64) -> Vec<Shape> {
    let path = radius * (1.0 + PATH_OVER_RADIUS);
    vec![
        Shape::Entity(Entity::Circle(centre, radius)),
        Shape::Line(centre - drive * path, centre + drive * path),
        Shape::Line(centre - outward * radius, centre + outward * path),
    ]
}

/// The pressure angle between path and normal, with the names of both.
pub(super) fn pressure_angle(
    centre: Vector2<f64>,
    drive: Vector2<f64>,
    outward: Vector2<f64>,
    radius: f64,
    text: String,
) -> Vec<Mark> {
    // Either way along the path: the one on the side of the normal.
    let drive = if drive.dot(&outward) < 0.0 { -drive } else { drive };
    let end = radius * (1.0 + PATH_OVER_RADIUS);
    let label = |along: Vector2<f64>, text: &str| Mark::Label {
        class: "roller",
        at: centre + along * end,
        towards: along,
        text: text.into(),
    };
    let arc = 1.3 * radius;
    vec![
        Mark::Angle { class: "roller", corner: centre, from: outward, to: drive, radius: arc, text },
        label(drive, "path"),
        label(outward, "normal"),
    ]
}

/// Horizontal and vertical axis through the origin, somewhat longer than what they cross.
pub(super) fn axes(crossed: &Extents) -> Vec<Shape> {
    let beyond = AXIS_BEYOND * crossed.size().max();
    vec![
        Shape::Line(Vector2::new(crossed.least.x - beyond, 0.0), Vector2::new(crossed.largest.x + beyond, 0.0)),
        Shape::Line(Vector2::new(0.0, crossed.least.y - beyond), Vector2::new(0.0, crossed.largest.y + beyond)),
    ]
}

/// Length and height of an outline, as dimensions to its left and below.
pub(super) fn overall(outline: &Extents) -> Vec<Mark> {
    let (least, largest) = (outline.least, outline.largest);
    let text = |length: f64| rounded((length * 1e3).round() / 1e3);
    vec![
        Mark::Distance {
            from: least,
            to: Vector2::new(largest.x, least.y),
            away: Vector2::new(0.0, -1.0),
            text: text(largest.x - least.x),
        },
        Mark::Distance {
            from: least,
            to: Vector2::new(least.x, largest.y),
            away: Vector2::new(-1.0, 0.0),
            text: text(largest.y - least.y),
        },
    ]
}

/// Bore with its keyway, which is the datum, and balance holes, by their names.
pub(super) fn bore(machine: &Machine, balancing: Option<&Balancing>) -> Vec<Mark> {
    let mut marks = Vec::new();
    let Some(bore) = machine.cam.bore_radius else { return marks };
    let radius = MILLIMETRES * bore;
    let down_right = Vector2::new(0.6, -0.8);
    marks.push(Mark::Label {
        class: "dimension",
        at: down_right * radius,
        towards: down_right,
        text: format!("Ø{}, datum A", rounded(2.0 * radius)),
    });
    if let Some(keyway) = machine.cam.keyway {
        let along = Vector2::new(libm::cos(keyway.angle), libm::sin(keyway.angle));
        let along = point_as_turned(machine, along);
        let (width, depth) = (MILLIMETRES * keyway.width, MILLIMETRES * keyway.depth);
        marks.push(Mark::Label {
            class: "dimension",
            at: along * (radius + depth),
            towards: along,
            text: format!("keyway {} wide, {} deep", rounded(width), rounded(depth)),
        });
    }
    let holes = balancing.map_or(&[][..], |balancing| balancing.holes.as_slice());
    marks.extend(holes.iter().map(|(centre, radius)| Mark::Label {
        class: "dimension",
        at: centre + Vector2::new(*radius, 0.0),
        towards: Vector2::new(1.0, 0.3),
        text: format!("Ø{}", rounded(2.0 * radius)),
    }));
    marks
}

/// How a cam turns, about its bore, and where its angle begins and how it grows, on a profile radius.
pub(super) fn turning(machine: &Machine, base: f64, profile: f64, zero: &str) -> Vec<Mark> {
    let bore = MILLIMETRES * machine.cam.bore_radius.unwrap_or(0.0);
    let (sense, way) = match machine.cam.rotation {
        Rotation::Clockwise => (-1.0, "clockwise"),
        Rotation::CounterClockwise => (1.0, "counter-clockwise"),
    };
    let right = Vector2::new(1.0, 0.0);
    vec![
        Mark::Turning {
            class: "rotation",
            radius: 0.5 * (bore + base),
            from_deg: 135.0 - sense * 35.0,
            sweep_deg: sense * 70.0,
            text: format!("turns {way}"),
        },
        // The angle of the drawing grows against the rotation.
        Mark::Turning {
            class: "axis",
            radius: 0.82 * profile.max(bore),
            from_deg: 0.0,
            sweep_deg: -sense * SENSE_DEG,
            text: "θ".into(),
        },
        Mark::Label { class: "axis", at: right * profile, towards: Vector2::new(1.0, 0.4), text: zero.into() },
    ]
}

/// θ, radius and lift each 5°, and each 10°, of a cam that turns.
pub(super) fn places(curves: Curves<'_>) -> Vec<PlaceTable> {
    const EVERY: [(u32, usize); 2] = [(5, 1), (10, 2)];
    const ROWS: u32 = 72;
    let rolls = matches!(curves.element(), Element::Roller { radius } if radius > 0.0);
    let swings = curves.motion.quantity() == Quantity::Angle;
    let row = |index: u32| {
        let at = turned(index, ROWS, curves.motion.lobes());
        let (piece, angle) = curves.motion.locate(at.angle);
        let lift = curves.motion.jet(piece, angle);
        let curve = curves.follower.touch(angle, &lift).curve;
        let place = if rolls { curve } else { curve.offset_inward(curves.offset()) };
        let lift = if swings { lift.s.to_degrees() } else { MILLIMETRES * lift.s };
        let cell = |value: f64, decimals: usize| fixed(value + 0.0, decimals);
        vec![cell(at.cam_deg, 0), cell((place.point * MILLIMETRES).norm(), 3), cell(lift, 3)]
    };
    let rows: Arc<[Vec<String>]> = (0..ROWS).map(row).collect();
    let what = if rolls { "R of the roller's centre" } else { "R of the point of contact" };
    EVERY
        .iter()
        .map(|(degrees, every)| PlaceTable {
            title: format!("Cam angle θ, {what}, lift, each {degrees}°"),
            heads: vec!["θ, °".into(), "R, mm".into(), if swings { "lift, °".into() } else { "lift, mm".into() }],
            rows: Arc::clone(&rows),
            every: *every,
        })
        .collect()
}

/// What the follower of a plane cam does on its outline: its acceleration beside that of the motion, and the torque of the shaft, with a
/// second disc on it that of both.
#[must_use]
pub fn traces(first: Cut<'_>, second: Option<Cut<'_>>) -> Vec<Trace> {
    let (Some(curves), Some(followed)) = (first.0.plane(), torque::followed(first)) else { return Vec::new() };
    std::iter::once(acceleration(curves, &followed)).chain(torque::trace(first.0, &followed, second)).collect()
}

fn acceleration(curves: Curves<'_>, followed: &Followed<'_>) -> Trace {
    let turns = curves.motion.period().is_some();
    let swings = curves.motion.quantity() == Quantity::Angle;
    let (place, value) = (if turns { 1.0_f64.to_degrees() } else { 1e3 }, if swings { 1.0 } else { 1e3 });
    let points = followed.accelerations(TRACE_SHARE);
    Trace {
        head: format!(
            "Follower's acceleration, {}: motion (thin), as cut (bold)",
            if swings { "rad/rad²" } else { "mm/rad²" }
        ),
        places: if turns { "cam angle, deg" } else { "overrun of the bed, mm" },
        step: if turns { 30.0 } else { 20.0 },
        period: turns.then_some(360.0),
        points: points.into_iter().map(|[at, motion, cut]| [place * at, value * motion, value * cut]).collect(),
    }
}

/// A stretch of a curve that nobody may overlook.
pub(super) fn lost_motion(stretches: Vec<Vec<Vector2<f64>>>) -> Option<Group> {
    let shapes: Vec<Shape> = stretches.into_iter().map(Shape::Path).collect();
    (!shapes.is_empty()).then(|| Group::new("lost-motion", "motion that is lost", shapes).told())
}
