//! The shaft to scale, with supports, discs and the cam, in millimetres: the left end at the origin.

use super::ShaftResults;
use crate::press::machine::PressCams;
use camgen_cams::report::plot::figure;
use camgen_cams::report::scheme::{Scheme, SchemeDimension, SchemeJoint, SchemeLabel, SchemePose, Stroke, StrokeKind};
use camgen_cams::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector2;

/// Letters of the supports.
pub(super) const LETTERS: [&str; 10] = ["A", "B", "C", "D", "E", "F", "G", "H", "J", "K"];
/// Half the sides of a support over the largest diameter, and of a disc whose size is not known.
const SUPPORT: f64 = 0.18;
const DISC: f64 = 0.8;
/// Colours of cam and discs.
const CAM: usize = 0;
const DISCS: usize = 1;

/// A box along the axis, from one end to the other, with half its height.
fn box_along(name: &'static str, kind: StrokeKind, from: f64, to: f64, half: f64) -> Stroke {
    let points = [[from, -half], [to, -half], [to, half], [from, half], [from, -half]];
    Stroke { name, kind, points: points.map(Vector2::from).to_vec() }
}

/// The shaft as it lies.
pub(super) fn scheme(found: &ShaftResults<'_>) -> Scheme {
    let shaft = &found.shaft;
    let largest = MILLIMETRES * shaft.segments().iter().map(|segment| segment.diameter).fold(0.0, f64::max);
    let mut left = 0.0;
    let mut strokes = Vec::new();
    let mut labels = Vec::new();
    let mut dimensions = Vec::new();
    for segment in shaft.segments() {
        let (from, to) = (MILLIMETRES * left, MILLIMETRES * (left + segment.length));
        strokes.push(box_along("shaft", StrokeKind::Body, from, to, 0.5 * MILLIMETRES * segment.diameter));
        if segment.bore > 0.0 {
            strokes.push(box_along("bore", StrokeKind::Path, from, to, 0.5 * MILLIMETRES * segment.bore));
        }
        let bore = if segment.bore > 0.0 { format!("/{}", figure(MILLIMETRES * segment.bore)) } else { String::new() };
        labels.push(SchemeLabel {
            text: format!("Ø{}{bore}", figure(MILLIMETRES * segment.diameter)),
            at: Vector2::new(0.5 * (from + to), 0.5 * MILLIMETRES * segment.diameter),
            towards: Vector2::new(0.0, 1.0),
        });
        let ends = [from, to].map(|x| Vector2::new(x, -0.5 * MILLIMETRES * segment.diameter));
        dimensions.push(SchemeDimension { ends, lane: 1, text: figure(to - from) });
        left += segment.length;
    }
    let cam = found.machine.data.cam_at.filter(|_| found.carried.is_some());
    let own = found.machine.data.shaft.discs();
    for disc in own {
        let (half, size) = (0.15 * largest, DISC * largest);
        let at = MILLIMETRES * disc.at;
        strokes.push(box_along("disc", StrokeKind::Link(DISCS), at - half, at + half, size));
    }
    if let (Some(at), Some(carried)) = (cam, &found.carried) {
        let machine = found.machine.machine();
        let thickness = if carried.is_conoid() {
            machine.and_then(|machine| PressCams::of(machine).conoid).map(|conoid| conoid.axial_travel)
        } else {
            machine.and_then(|machine| machine.cam.thickness)
        };
        let thickness = thickness.unwrap_or(0.0);
        let half = 0.5 * MILLIMETRES * thickness.max(0.1 * largest / MILLIMETRES);
        let reach = MILLIMETRES * carried.reach();
        let at = MILLIMETRES * at;
        strokes.push(box_along("cam", StrokeKind::Link(CAM), at - half, at + half, reach));
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
    dimensions.extend(positions(found, cam, length));
    Scheme {
        poses: vec![SchemePose { name: "Shaft to scale, sizes in mm".into(), strokes, joints, labels, dimensions }],
        notes: notes(found),
    }
}

/// Distances of the supports and the cam from each other and from the ends, mm, below the lengths of the segments, and the whole length.
fn positions(found: &ShaftResults<'_>, cam: Option<f64>, length: f64) -> Vec<SchemeDimension> {
    let supports = found.shaft.supports().iter().map(|support| MILLIMETRES * support.at);
    let discs = found.machine.data.shaft.discs().iter().map(|disc| MILLIMETRES * disc.at);
    let mut at: Vec<f64> = supports.chain(discs).chain(cam.map(|at| MILLIMETRES * at)).chain([0.0, length]).collect();
    at.sort_by(f64::total_cmp);
    at.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * length);
    let on_axis = |x: f64| Vector2::new(x, 0.0);
    let between = at.iter().zip(at.iter().skip(1)).map(|(a, b)| SchemeDimension {
        ends: [on_axis(*a), on_axis(*b)],
        lane: 2,
        text: figure(b - a),
    });
    let whole = SchemeDimension { ends: [on_axis(0.0), on_axis(length)], lane: 3, text: figure(length) };
    let has_others = at.len() > 2;
    between.chain(has_others.then_some(whole)).collect()
}

fn notes(found: &ShaftResults<'_>) -> Vec<String> {
    let mut all = Vec::new();
    for (support, letter) in found.shaft.supports().iter().zip(LETTERS) {
        all.push(match support.stiffness {
            None => format!("{letter} rigid"),
            Some(stiffness) => format!("{letter} {} MN/m", shown(1e-6 * stiffness)),
        });
    }
    let mut notes = vec![format!("Supports: {}.", all.join(", "))];
    if found.carried.is_some() {
        notes.push("Blue: the cam at its largest radius.".into());
    }
    if !found.machine.data.shaft.discs().is_empty() {
        notes.push("Gold: discs, not to scale.".into());
    }
    notes
}
