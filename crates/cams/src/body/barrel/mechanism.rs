//! The developed groove as it passes its roller.

use super::{Barrel, BarrelRoller};
use crate::body::Drawn;
use crate::body::picture::Cover;
use crate::report::mechanism::{MechanismView, MovingMechanism, RigidPart, circle, line, rectangle};
use crate::report::sheet::SheetShape;
use crate::table::turned;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use std::f64::consts::TAU;

/// The picture shows this share of the circumference to either side of the roller.
const SHOWN: f64 = 0.5;

/// The mechanism: the developed view runs past the roller, which moves along the axis.
pub(super) fn moving<R: BarrelRoller>(barrel: &Barrel<R>, drawn: &Drawn, samples: u32) -> MovingMechanism {
    let Some(swept) = drawn.swept.as_deref() else { return MovingMechanism::default() };
    let samples = samples.max(1);
    let around = MILLIMETRES * barrel.outer * TAU;
    let sense = barrel.groove.sense();
    let (low, high) = (MILLIMETRES * barrel.ends.0, MILLIMETRES * barrel.ends.1);
    let mut poses = Vec::new();
    for index in 0..=samples {
        let at = turned(index % samples, samples, barrel.groove.motion.lobes());
        let (piece, angle) = barrel.groove.motion.locate(at.angle);
        let roller = barrel.developed_at(None, (piece, angle)).0;
        let cam_deg = if index == samples { 360.0 } else { at.cam_deg };
        let ahead = roller.x - sense * MILLIMETRES * barrel.outer * angle;
        poses.push((cam_deg, -sense * around * cam_deg / 360.0, ahead, roller.y));
    }
    let groove = |shift: f64| -> Vec<SheetShape> {
        let shapes = swept.developed.iter().filter(|(layer, _)| *layer != crate::body::Layer::Blank);
        let moved = shapes.map(|(_, entity)| match entity {
            Entity::Segment(segment) => {
                let by = nalgebra::Vector2::new(shift, 0.0);
                SheetShape::Arc(segment.start + by, segment.end + by, segment.bulge)
            }
            other => SheetShape::Entity(other.clone()),
        });
        moved.collect()
    };
    let x: Vec<f64> = poses.iter().map(|pose| pose.1).collect();
    let mut parts: Vec<RigidPart> =
        vec![RigidPart::new("ground", vec![rectangle((-SHOWN * around, SHOWN * around), (low, high))])];
    // The view of a turn before and after the one that passes.
    for turn in [-1.0, 0.0, 1.0] {
        parts.push(RigidPart::new("cam", groove(turn * around)).at(x.clone(), 0.0));
    }
    let radius = MILLIMETRES * barrel.groove.roller;
    let roller_x: Vec<f64> = poses.iter().map(|pose| pose.2).collect();
    let roller_y: Vec<f64> = poses.iter().map(|pose| pose.3).collect();
    parts.push(
        RigidPart::new("follower", vec![line((0.0, 0.0), (0.0, high - low + 2.0 * radius))])
            .at(roller_x.clone(), roller_y.clone()),
    );
    let roller = vec![circle(0.0, 0.0, radius), circle(0.0, 0.0, 0.12 * radius)];
    parts.push(RigidPart::new("roller", roller).at(roller_x, roller_y));
    let mut cover = Cover::nothing();
    cover.add((-SHOWN * around, SHOWN * around), (low - radius, high + 2.0 * radius));
    let view = MechanismView {
        rpm: None,
        shaft_speed: barrel.groove.speed(),
        returns: false,
        place: "cam_deg",
        at: poses.iter().map(|pose| pose.0).collect(),
        turn_deg: poses.iter().map(|pose| pose.0).collect(),
        extents: cover.with_margin(0.02 * around),
        parts,
    };
    let notes =
        vec!["The outside of the barrel is shown unrolled: it passes the roller, which moves along the axis.".into()];
    MovingMechanism { views: vec![view], notes, solid: None }
}
