//! Frame and roll to scale for the full and the run-down roll, in millimetres: the roll's axis at the origin.

use super::braking::LoadedBrake;
use crate::brake::mechanics::{FramePose, RollRotation};
use camgen_cams::report::scheme::{self, Scheme, SchemeJoint, Stroke, StrokeKind};
use camgen_cams::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Colours of belt and frame.
const BELT: usize = 0;
const FRAME: usize = 1;
/// Points of a circle.
const POINTS: u32 = 96;

/// The positions of all parts, mm.
pub(super) struct BrakeOutline {
    pub(super) pivot: Vector2<f64>,
    pub(super) right: Vector2<f64>,
    pub(super) left: Vector2<f64>,
    pub(super) centre: Vector2<f64>,
    pub(super) roll: f64,
    pub(super) pulley: f64,
    /// Where the spans leave the right pulley, touch the roll, leave it and reach the left pulley.
    pub(super) spans: [[Vector2<f64>; 2]; 2],
    /// Angles at which the belt touches the roll, rad.
    pub(super) touches: [f64; 2],
}

impl BrakeOutline {
    pub(super) fn new(braking: &LoadedBrake<'_>, pose: &FramePose) -> Self {
        let frame = braking.brake.frame();
        let [right, left, centre] = braking.brake.parts(pose).map(|part| MILLIMETRES * Vector2::from(part));
        let (roll, pulley) = (MILLIMETRES * pose.radius, MILLIMETRES * frame.pulley_radius);
        let first = touching_angle(right, roll + pulley, 1.0);
        let last = touching_angle(left, roll + pulley, -1.0);
        let [first_normal, last_normal] = [first, last].map(|angle| on_circle(Vector2::zeros(), 1.0, angle));
        Self {
            pivot: MILLIMETRES * Vector2::from(frame.pivot),
            right,
            left,
            centre,
            roll,
            pulley,
            spans: [
                [right - first_normal * pulley, first_normal * roll],
                [left - last_normal * pulley, last_normal * roll],
            ],
            touches: [first, last],
        }
    }

    /// The inner run of the belt, from the right pulley to the left.
    pub(super) fn belt(&self) -> Vec<Vector2<f64>> {
        let [[from, _], [to, _]] = self.spans;
        let [first, last] = self.touches;
        let whole = (last - first).rem_euclid(TAU);
        let arc = (0..=POINTS).map(|i| on_circle(Vector2::zeros(), self.roll, first + whole * share(i)));
        std::iter::once(from).chain(arc).chain(std::iter::once(to)).collect()
    }
}

/// The angle at which the inner run touches the roll, from a pulley's centre and the sum of both radii. The run touches roll and pulley
/// from either side, so the normal at both is the one from the roll's axis.
fn touching_angle(pulley: Vector2<f64>, radii: f64, hand: f64) -> f64 {
    let distance = pulley.norm();
    let span = ((distance - radii) * (distance + radii)).max(0.0).sqrt();
    libm::atan2(pulley.y, pulley.x) + hand * libm::atan2(span, radii)
}

fn share(index: u32) -> f64 {
    f64::from(index) / f64::from(POINTS)
}

fn on_circle(centre: Vector2<f64>, radius: f64, angle: f64) -> Vector2<f64> {
    let (sine, cosine) = libm::sincos(angle);
    centre + radius * Vector2::new(cosine, sine)
}

fn circle(name: &'static str, kind: StrokeKind, centre: Vector2<f64>, radius: f64) -> Stroke {
    Stroke { name, kind, points: (0..=POINTS).map(|i| on_circle(centre, radius, TAU * share(i % POINTS))).collect() }
}

/// The brake at both ends of the roll.
pub(super) fn scheme(braking: &LoadedBrake<'_>) -> Scheme {
    let names = ["full roll", "run-down roll"];
    let stands = braking.ends.iter().zip(names).map(|(pose, name)| {
        let text = format!(
            "{name}: {} mm, frame turned by {}°, wrap {}°, {} N",
            shown(MILLIMETRES * pose.radius),
            shown(pose.theta.to_degrees() + 0.0),
            shown(pose.wrap.to_degrees()),
            shown(braking.tension(pose))
        );
        drawn_pose(text, &BrakeOutline::new(braking, pose))
    });
    let tight = if braking.brake.rotation() == RollRotation::Clockwise { "left" } else { "right" };
    let notes = vec![
        "Blue: the inner run of the belt; brown: the frame with pivot O, pulleys and its centre of gravity c.".into(),
        format!("The {tight} span is the tight one."),
    ];
    Scheme { poses: stands.collect(), notes }
}

fn link(name: &'static str, colour: usize, points: &[Vector2<f64>]) -> Stroke {
    Stroke { name, kind: StrokeKind::Link(colour), points: points.to_vec() }
}

fn joint(letter: &'static str, at: Vector2<f64>, fixed: bool, towards: Vector2<f64>) -> SchemeJoint {
    SchemeJoint { letter, at, fixed, towards }
}

fn drawn_pose(name: String, lying: &BrakeOutline) -> scheme::SchemePose {
    let BrakeOutline { pivot, right, left, centre, .. } = *lying;
    let strokes = vec![
        circle("roll", StrokeKind::Body, Vector2::zeros(), lying.roll),
        circle("right pulley", StrokeKind::Body, right, lying.pulley),
        circle("left pulley", StrokeKind::Body, left, lying.pulley),
        link("frame", FRAME, &[left, pivot, right]),
        link("arm of the weight", FRAME, &[pivot, centre]),
        link("belt", BELT, &lying.belt()),
    ];
    let joints = vec![
        joint("p1", right, false, Vector2::new(1.0, 1.0)),
        joint("p2", left, false, Vector2::new(-1.0, 1.0)),
        joint("c", centre, false, Vector2::new(0.0, 1.0)),
        joint("O", pivot, true, Vector2::new(-1.0, -1.0)),
    ];
    scheme::SchemePose { name, strokes, joints }
}
