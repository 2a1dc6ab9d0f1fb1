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
        let vector = |[x, y]: [f64; 2]| MILLIMETRES * Vector2::new(x, y);
        let [right, left, centre] = braking.brake.parts(pose).map(vector);
        let (roll, pulley) = (MILLIMETRES * pose.radius, MILLIMETRES * frame.pulley_radius);
        // The inner run touches roll and pulley from either side: the normal at both is that from the roll's axis.
        let touch = |at: Vector2<f64>, hand: f64| {
            let (distance, sum) = (at.norm(), roll + pulley);
            let span = ((distance - sum) * (distance + sum)).max(0.0).sqrt();
            libm::atan2(at.y, at.x) + hand * libm::atan2(span, sum)
        };
        let angles = [touch(right, 1.0), touch(left, -1.0)];
        let ends = |at: Vector2<f64>, angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            let normal = Vector2::new(cosine, sine);
            [at - normal * pulley, normal * roll]
        };
        let [first, last] = angles;
        Self {
            pivot: vector(frame.pivot),
            right,
            left,
            centre,
            roll,
            pulley,
            spans: [ends(right, first), ends(left, last)],
            touches: angles,
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
        at(text, &BrakeOutline::new(braking, pose))
    });
    let tight = if braking.brake.rotation() == RollRotation::Clockwise { "left" } else { "right" };
    let notes = vec![
        "Blue: the inner run of the belt; brown: the frame with pivot O, pulleys and its centre of gravity c.".into(),
        format!("The {tight} span is the tight one."),
    ];
    Scheme { poses: stands.collect(), notes }
}

fn at(name: String, lying: &BrakeOutline) -> scheme::SchemePose {
    let link = |name, colour, points: &[Vector2<f64>]| Stroke {
        name,
        kind: StrokeKind::Link(colour),
        points: points.to_vec(),
    };
    let BrakeOutline { pivot, right, left, centre, .. } = *lying;
    let strokes = vec![
        circle("roll", StrokeKind::Body, Vector2::zeros(), lying.roll),
        circle("right pulley", StrokeKind::Body, right, lying.pulley),
        circle("left pulley", StrokeKind::Body, left, lying.pulley),
        link("frame", FRAME, &[left, pivot, right]),
        link("arm of the weight", FRAME, &[pivot, centre]),
        link("belt", BELT, &lying.belt()),
    ];
    let joint =
        |letter, at, fixed, towards: [f64; 2]| SchemeJoint { letter, at, fixed, towards: Vector2::from(towards) };
    let joints = vec![
        joint("p1", right, false, [1.0, 1.0]),
        joint("p2", left, false, [-1.0, 1.0]),
        joint("c", centre, false, [0.0, 1.0]),
        joint("O", pivot, true, [-1.0, -1.0]),
    ];
    scheme::SchemePose { name, strokes, joints }
}
