//! How the plate and its follower move over the stroke.

use super::Wedge;
use crate::body::Drawn;
use crate::body::picture::{Cover, range};
use crate::report::mechanism::{MechanismView, MovingMechanism, RigidPart, circle, line, rectangle};
use crate::report::sheet::SheetShape;
use camgen_kernel::follower::Follower;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::{Jet, Motion};
use nalgebra::Vector2;

/// What is not modelled of a plate.
const NOT_MODELLED: &[&str] = &[
    "Speed: that of the plate is not known, so that inertia, damping, vibration and the life of a bearing are not computed.",
    "Elasticity: plate, follower and contact are rigid.",
    "Clearance and wear: bearings, guides and the roller have no play and keep their size.",
    "Friction: between roller and plate, in bearings and in the guides of plate and follower.",
    "Temperature: all sizes are those of the drawing.",
];
const WITHOUT_FORCES: &[&str] = &["Forces: the file gives no preload or spring, so that no force is known."];
const AT_REST: &[&str] = &["Inertia: the contact force is that at rest, of preload, spring and load."];

/// Half of the thickness of the stem over the size of the roller, and lengths over that size.
const STEM: f64 = 0.22;
const GUIDE: f64 = 1.5;
/// A knife edge is shown as large as a roller of this share of the plate's height.
const KNIFE_OVER_HEIGHT: f64 = 0.15;

/// What is not modelled of a plate.
pub(super) fn not_modelled(wedge: &Wedge) -> Vec<&'static str> {
    [NOT_MODELLED, if wedge.pressing(0.0).is_some() { AT_REST } else { WITHOUT_FORCES }].concat()
}

/// The follower at a sample, mm and degrees.
struct FollowerPlace {
    x: f64,
    roller: Vector2<f64>,
    normal_deg: f64,
}

/// The mechanism of a plate as it moves: the plate to the left, the follower along its path.
pub(super) fn of(wedge: &Wedge, drawn: &Drawn, samples: u32) -> MovingMechanism {
    let Some(part) = drawn.parts.first() else { return MovingMechanism::default() };
    let (from, to) = wedge.stroke();
    let steps = samples.max(1);
    let at = |i: u32| place(wedge, if i == steps { to } else { from + (to - from) * f64::from(i) / f64::from(steps) });
    let places: Vec<FollowerPlace> = (0..=steps).map(at).collect();
    let mut cover = Cover::nothing();
    let outline = part.outline.contour.clone();
    let extents = outline.extents();
    let [first, last] = [MILLIMETRES * from, MILLIMETRES * to];
    cover.add((extents.least.x - last, extents.largest.x - first), (extents.least.y, extents.largest.y));
    let back: Vec<f64> = places.iter().map(|at| -at.x).collect();
    let name = (0.5 * (extents.least.x + extents.largest.x), extents.largest.y - 0.3 * MILLIMETRES * wedge.thinnest.0);
    let mut parts = follower(wedge, &places, &mut cover);
    let shape = SheetShape::Entity(Entity::Polyline(outline));
    parts.push(RigidPart::new("cam", vec![shape]).at(back, 0.0).named("plate", name.0, name.1));
    let top = MILLIMETRES * wedge.top;
    parts.push(RigidPart::new("ground", vec![line((extents.least.x - last, top), (extents.largest.x - first, top))]));
    parts.extend(touching(wedge, &places));
    let size = cover.0.largest - cover.0.least;
    let share = |at: &FollowerPlace| 180.0 * (at.x - first) / (last - first);
    let view = MechanismView {
        rpm: None,
        shaft_speed: None,
        returns: true,
        place: "x_mm",
        at: places.iter().map(|at| at.x).collect(),
        turn_deg: places.iter().map(share).collect(),
        extents: cover.with_margin(0.03 * size.x.max(size.y)),
        parts,
    };
    let notes = vec!["The plate moves at constant speed, out and back: its own drive is not known.".into()];
    MovingMechanism { views: vec![view], notes, solid: None }
}

fn place(wedge: &Wedge, x: f64) -> FollowerPlace {
    let (piece, x) = wedge.motion.locate(x);
    let curve = wedge.curves().touch(piece, x).curve;
    let normal = curve.outward();
    FollowerPlace {
        x: MILLIMETRES * x + 0.0,
        roller: (curve.point - Vector2::new(x, 0.0)) * MILLIMETRES,
        normal_deg: libm::atan2(normal.y, normal.x).to_degrees(),
    }
}

/// The radius of the roller, or what a knife edge is shown with, mm.
fn size(wedge: &Wedge) -> f64 {
    let radius = MILLIMETRES * wedge.curves().offset();
    if radius > 0.0 { radius } else { KNIFE_OVER_HEIGHT * MILLIMETRES * wedge.height }
}

/// The stem with its guides, in a frame whose x is the follower's path.
fn follower(wedge: &Wedge, places: &[FollowerPlace], cover: &mut Cover) -> Vec<RigidPart> {
    let size = size(wedge);
    let (_, drive) = wedge.follower.point_turned(0.0, 0.0, 1.0, &Jet::default());
    let turn = libm::atan2(drive.y, drive.x).to_degrees();
    let (low, high) = range(places.iter().map(|at| at.roller.dot(&drive)));
    let half = STEM * size;
    // From below the roller where it is lowest.
    let guide = high + 1.5 * size;
    let length = guide + (GUIDE + 1.0) * size - low;
    let guides = [-1.0, 1.0].map(|side| {
        let (inner, outer) = (side * 1.25 * half, side * (1.25 * half + 0.6 * size));
        rectangle((guide, guide + GUIDE * size), (inner.min(outer), inner.max(outer)))
    });
    let end = drive * (high + length);
    let across = 1.2 * size;
    cover.add((end.x.min(0.0) - across, end.x.max(0.0) + across), (end.y, 0.0));
    let stem = vec![rectangle((0.0, length), (-half, half))];
    let track = |of: fn(&FollowerPlace) -> f64| places.iter().map(of).collect::<Vec<f64>>();
    vec![
        RigidPart::new("ground", guides.to_vec()).turned(turn),
        RigidPart::new("follower", stem).at(track(|at| at.roller.x), track(|at| at.roller.y)).turned(turn),
    ]
}

/// The roller, and the normal where it touches.
fn touching(wedge: &Wedge, places: &[FollowerPlace]) -> Vec<RigidPart> {
    let size = size(wedge);
    let track = |of: fn(&FollowerPlace) -> f64| places.iter().map(of).collect::<Vec<f64>>();
    let (x, y) = (track(|at| at.roller.x), track(|at| at.roller.y));
    let roller = (wedge.curves().offset() > 0.0).then(|| {
        let shapes = vec![circle(0.0, 0.0, size), circle(0.0, 0.0, 0.12 * size)];
        RigidPart::new("roller", shapes).at(x.clone(), y.clone()).named("roller", 1.6 * size, -0.4 * size)
    });
    let normal = RigidPart::new("normal", vec![line((-size, 0.0), (1.9 * size, 0.0))]);
    roller.into_iter().chain([normal.at(x, y).turned(track(|at| at.normal_deg))]).collect()
}
