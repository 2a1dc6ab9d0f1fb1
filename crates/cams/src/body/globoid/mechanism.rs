//! The turret as it turns beside the cam, seen along its axis.

use super::Globoid;
use crate::body::picture::Cover;
use crate::report::mechanism::{MechanismView, MovingMechanism, RigidPart, circle, line};
use crate::report::sheet::SheetShape;
use crate::table::turned;
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Places along the hollow outline of the cam.
const PLACES: u32 = 48;

/// The outline of the blank in the plane through the axes, on the side of the turret (1) or away from it (−1), mm.
pub(super) fn outline(globoid: &Globoid, side: f64) -> Vec<Vector2<f64>> {
    let distance = MILLIMETRES * globoid.turret.distance;
    let outside = MILLIMETRES * globoid.outside;
    let (rim, height) = globoid.rim(globoid.floor);
    let (rim, height) = (MILLIMETRES * rim, MILLIMETRES * height);
    let hollow = (0..=PLACES).map(|i| {
        let angle = globoid.end_angle * (2.0 * f64::from(i) / f64::from(PLACES) - 1.0);
        let (sin, cos) = libm::sincos(angle);
        Vector2::new(side * (distance - outside * cos), outside * sin)
    });
    let at = |x: f64, z: f64| Vector2::new(side * x, z);
    let ends = [at(rim, height), at(0.0, height)];
    [at(0.0, -height), at(rim, -height)].into_iter().chain(hollow).chain(ends).collect()
}

/// The mechanism: the cam stands still in its outline, and the rollers move through it.
pub(super) fn moving(globoid: &Globoid, samples: u32) -> MovingMechanism {
    let samples = samples.max(1);
    let [distance, outside, reached, radius] =
        [globoid.turret.distance, globoid.outside, globoid.reached, globoid.groove.roller]
            .map(|length| MILLIMETRES * length);
    let mut cam_deg = Vec::new();
    let mut turret_deg = Vec::new();
    for index in 0..=samples {
        let at = turned(index % samples, samples, 1);
        let whole = index == samples;
        let line = globoid.line_at(if whole { at.angle + TAU } else { at.angle }, 0.0);
        cam_deg.push(if whole { 360.0 } else { at.cam_deg });
        // A growing turret angle moves the rollers up, at the side of the cam.
        turret_deg.push(-line.angle[0].to_degrees());
    }
    let mut parts = vec![RigidPart::new(
        "ground",
        vec![SheetShape::Path(outline(globoid, 1.0)), SheetShape::Path(outline(globoid, -1.0))],
    )];
    let mut rollers = vec![circle(0.0, 0.0, 0.75 * outside), circle(0.0, 0.0, 0.06 * outside)];
    for index in 0..globoid.turret.rollers {
        let angle = TAU * 0.5 - f64::from(index) * globoid.turret.pitch();
        let (sin, cos) = libm::sincos(angle);
        let place = |along: f64, across: f64| (along * cos - across * sin, along * sin + across * cos);
        let corners =
            [(outside, -radius), (reached, -radius), (reached, radius), (outside, radius)].map(|(a, b)| place(a, b));
        let [a, b, c, d] = corners;
        rollers.extend([line(a, b), line(b, c), line(c, d), line(d, a)]);
        rollers.push(line(place(0.75 * outside, 0.0), place(reached, 0.0)));
    }
    parts.push(RigidPart::new("follower", rollers).at(distance, 0.0).turned(turret_deg));
    let mut cover = Cover::nothing();
    let height = MILLIMETRES * globoid.rim(globoid.floor).1;
    let wide = MILLIMETRES * globoid.rim(globoid.outside).0;
    cover.add((-wide, distance + reached), (-height.max(reached), height.max(reached)));
    let view = MechanismView {
        rpm: None,
        shaft_speed: globoid.groove.speed(),
        returns: false,
        place: "cam_deg",
        at: cam_deg.clone(),
        turn_deg: cam_deg,
        extents: cover.with_margin(0.05 * distance),
        parts,
    };
    let notes = vec![
        "Seen along the axis of the turret: the cam, whose outline is shown, turns about its upright axis and moves the turret on.".into(),
    ];
    MovingMechanism { views: vec![view], notes, solid: None }
}
