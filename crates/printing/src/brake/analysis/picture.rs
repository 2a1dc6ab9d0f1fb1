//! Frame and roll to scale for the full and the run-down roll, in millimetres: the roll's axis at the origin.

use super::braking::LoadedBrake;
use crate::brake::mechanics::{FramePose, RollRotation};
use camgen_cams::report::plot::figure;
use camgen_cams::report::scheme::{Scheme, SchemeJoint, SchemeLabel, SchemePose, Stroke, StrokeKind};
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
    let names = ["Full roll", "Run-down roll"];
    let stands = braking.ends.iter().zip(names).enumerate().map(|(index, (pose, name))| {
        let text = format!(
            "{name}: frame turned by {}°, wrap {}°, tension {} N",
            figure(pose.theta.to_degrees() + 0.0),
            figure(pose.wrap.to_degrees()),
            figure(braking.tension(pose))
        );
        let outline = BrakeOutline::new(braking, pose);
        let drawn = drawn_pose(text, &outline);
        let mut labels = vec![roll_label(&outline)];
        if index == 0 {
            labels.extend(frame_labels(&outline));
        }
        SchemePose { labels, ..drawn }
    });
    let tight = if braking.brake.rotation() == RollRotation::Clockwise { "left" } else { "right" };
    let frame = braking.brake.frame();
    let [x, y] = frame.pivot.map(|value| figure(MILLIMETRES * value));
    let notes = vec![
        "Blue: the inner run of the belt; gold: the frame with pivot O, pulleys p1 and p2, and its centre of gravity c."
            .into(),
        format!("The {tight} span is the tight one. Sizes in mm; O at {x}, {y} from the roll's axis."),
    ];
    Scheme { poses: stands.collect(), notes }
}

/// The radius of the roll.
fn roll_label(outline: &BrakeOutline) -> SchemeLabel {
    let down = Vector2::new(0.6, -0.8);
    SchemeLabel { text: format!("R{}", figure(outline.roll)), at: outline.roll * down, towards: down }
}

/// The sizes of the frame: its arms and pulleys.
fn frame_labels(outline: &BrakeOutline) -> Vec<SchemeLabel> {
    let BrakeOutline { pivot, right, left, centre, pulley, .. } = *outline;
    let arm = |name: &str, end: Vector2<f64>| SchemeLabel {
        text: format!("O{name} {}", figure((end - pivot).norm())),
        at: 0.5 * (pivot + end),
        towards: Vector2::new((end - pivot).y, (pivot - end).x),
    };
    let diameter = SchemeLabel {
        text: format!("Ø{}", figure(2.0 * pulley)),
        at: right + Vector2::new(pulley, 0.0),
        towards: Vector2::new(1.0, 0.0),
    };
    vec![diameter, arm("p1", right), arm("p2", left), arm("c", centre)]
}

fn link(name: &'static str, colour: usize, points: &[Vector2<f64>]) -> Stroke {
    Stroke { name, kind: StrokeKind::Link(colour), points: points.to_vec() }
}

fn joint(letter: &'static str, at: Vector2<f64>, fixed: bool, towards: Vector2<f64>) -> SchemeJoint {
    SchemeJoint { letter, at, fixed, towards }
}

fn drawn_pose(name: String, lying: &BrakeOutline) -> SchemePose {
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
    SchemePose { name, strokes, joints, ..SchemePose::default() }
}
