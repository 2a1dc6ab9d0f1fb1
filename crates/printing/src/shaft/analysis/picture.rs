//! The shaft to scale, with supports, discs and the cam, in millimetres: the left end at the origin.

use super::ShaftResults;
use crate::press::machine::PressCams;
use camgen_cams::machine::Machine;
use camgen_cams::report::scheme::{Scheme, SchemeJoint, SchemePose, Stroke, StrokeKind};
use camgen_cams::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector2;

/// Letters of the supports.
const LETTERS: [&str; 10] = ["A", "B", "C", "D", "E", "F", "G", "H", "J", "K"];
/// Half the sides of a support over the largest diameter, and of a disc whose size is not known.
const SUPPORT: f64 = 0.18;
const DISC: f64 = 0.8;
/// Colours of cam and discs.
const CAM: usize = 0;
const DISCS: usize = 1;

/// The shaft as it lies.
pub(super) fn scheme(found: &ShaftResults<'_>) -> Scheme {
    let shaft = &found.shaft;
    let largest = MILLIMETRES * shaft.segments().iter().map(|segment| segment.diameter).fold(0.0, f64::max);
    let box_at = |name, kind, (from, to): (f64, f64), half: f64| {
        let points = [[from, -half], [to, -half], [to, half], [from, half], [from, -half]];
        Stroke { name, kind, points: points.map(Vector2::from).to_vec() }
    };
    let mut left = 0.0;
    let mut strokes = Vec::new();
    for segment in shaft.segments() {
        let ends = (MILLIMETRES * left, MILLIMETRES * (left + segment.length));
        strokes.push(box_at("shaft", StrokeKind::Body, ends, 0.5 * MILLIMETRES * segment.diameter));
        if segment.bore > 0.0 {
            strokes.push(box_at("bore", StrokeKind::Path, ends, 0.5 * MILLIMETRES * segment.bore));
        }
        left += segment.length;
    }
    let cam = found.machine.data.cam_at.filter(|_| found.carried.is_some());
    let own = found.machine.data.shaft.discs();
    for disc in own {
        let (half, size) = (0.15 * largest, DISC * largest);
        strokes.push(box_at(
            "disc",
            StrokeKind::Link(DISCS),
            (MILLIMETRES * disc.at - half, MILLIMETRES * disc.at + half),
            size,
        ));
    }
    if let (Some(at), Some(carried)) = (cam, &found.carried) {
        let of_machine = |machine: &Machine| {
            if carried.is_conoid() {
                PressCams::of(machine).conoid.map(|conoid| conoid.axial_travel)
            } else {
                machine.cam.thickness
            }
        };
        let thickness = found.machine.machine().and_then(of_machine).unwrap_or(0.0);
        let half = 0.5 * MILLIMETRES * thickness.max(0.1 * largest / MILLIMETRES);
        let reach = MILLIMETRES * carried.reach();
        strokes.push(box_at("cam", StrokeKind::Link(CAM), (MILLIMETRES * at - half, MILLIMETRES * at + half), reach));
    }
    let length = MILLIMETRES * shaft.length();
    let axis = [Vector2::new(-0.05 * length, 0.0), Vector2::new(1.05 * length, 0.0)];
    strokes.push(Stroke { name: "axis", kind: StrokeKind::Guide, points: axis.to_vec() });
    let mut joints = Vec::new();
    for (support, letter) in shaft.supports().iter().zip(LETTERS) {
        let (x, under) = (
            MILLIMETRES * support.at,
            0.5 * MILLIMETRES * shaft.section_at(support.at, crate::shaft::mechanics::StepSide::Right).0,
        );
        let foot = SUPPORT * largest;
        let points = [[x, -under], [x - foot, -under - 2.0 * foot], [x + foot, -under - 2.0 * foot], [x, -under]];
        strokes.push(Stroke { name: "support", kind: StrokeKind::Body, points: points.map(Vector2::from).to_vec() });
        let at = Vector2::new(x, -under);
        joints.push(SchemeJoint { letter, at, fixed: true, towards: Vector2::new(1.0, -1.0) });
    }
    Scheme { poses: vec![SchemePose { name: "shaft".into(), strokes, joints }], notes: notes(found) }
}

fn notes(found: &ShaftResults<'_>) -> Vec<String> {
    let support = |(support, letter): (&crate::shaft::mechanics::Support, &str)| match support.stiffness {
        None => format!("{letter} rigid"),
        Some(stiffness) => format!("{letter} {} MN/m", shown(1e-6 * stiffness)),
    };
    let all: Vec<String> = found.shaft.supports().iter().zip(LETTERS).map(support).collect();
    let mut notes = vec![format!("Supports: {}.", all.join(", "))];
    if found.carried.is_some() {
        notes.push("Blue: the cam at its largest radius.".into());
    }
    if !found.machine.data.shaft.discs().is_empty() {
        notes.push("Brown: discs, not to scale.".into());
    }
    notes
}
