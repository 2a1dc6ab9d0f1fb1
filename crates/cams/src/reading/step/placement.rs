//! Where a solid lies: the placement among the items of its representation, which readers apply to it.
//!
//! ISO 10303-43 leaves open what a placement beside a solid means; OpenCASCADE moves the solid by it, and so do the programs that are built
//! on it. Of a placement that is not the origin of its file the solid is therefore judged where these programs put it.

use super::exchange::{ExchangeData, StepInstance};
use super::shape::{ShapeFault, ShapeReader, references};
use super::{StepBoundary, StepCurve, StepSurface};
use camgen_kernel::geometry::nurbs;
use nalgebra::{Matrix3, Vector3, Vector4};

/// A turn by less than this, and a move by less than this in mm, is none.
const NOTHING: f64 = 1e-12;

/// A smaller turn is not put into words, degrees.
const LEAST_TURN: f64 = 1e-6;

/// A placement that moves or turns a solid.
#[derive(Debug, Clone, PartialEq)]
pub struct StepPlacement {
    /// Where the origin of the solid lies, mm.
    pub origin: Vector3<f64>,
    /// The directions of its axes, in columns.
    pub axes: Matrix3<f64>,
    /// The boundary in its own coordinates, mm.
    pub unplaced: StepBoundary,
}

/// The placement of the representation that holds a solid; `None` where it leaves the solid where it is.
pub(super) fn of_solid(
    exchange: &ExchangeData,
    solid: u64,
    scale: f64,
    faults: &mut Vec<ShapeFault>,
) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let shapes = ShapeReader::new(exchange, scale);
    let items = |instance: &StepInstance| {
        let of = instance.parts.iter().find(|(keyword, _)| keyword.ends_with("SHAPE_REPRESENTATION"));
        of.and_then(|(_, values)| references(values.get(1))).unwrap_or_default()
    };
    let is_placement = |number: &u64| {
        exchange.instances.get(number).is_some_and(|instance| instance.part("AXIS2_PLACEMENT_3D").is_some())
    };
    let moves = |frame: &(Vector3<f64>, Matrix3<f64>)| {
        frame.0.norm() > NOTHING || (frame.1 - Matrix3::identity()).norm() > NOTHING
    };
    let mut own = Vec::new();
    for instance in exchange.instances.values() {
        let items = items(instance);
        for number in items.iter().filter(|number| is_placement(number)) {
            match shapes.frame(*number) {
                Err(fault) => faults.push(fault),
                Ok(frame) if items.contains(&solid) => own.push(frame),
                // Whether it moves the solid depends on how the representations are related.
                Ok(frame) if moves(&frame) => faults.push(instance.fault(
                    "has a placement that is not at the origin: write the solid in its place, without an assembly",
                )),
                Ok(_) => {}
            }
        }
    }
    match own.as_slice() {
        [frame] => Some(*frame).filter(moves),
        [first, rest @ ..] if rest.iter().any(|other| other != first) => {
            faults.push("the representation of the solid has several placements".to_owned());
            None
        }
        [first, ..] => Some(*first).filter(moves),
        [] => None,
    }
}

impl StepPlacement {
    /// The placement of a boundary, and the boundary where it lies.
    pub(super) fn apply((origin, axes): (Vector3<f64>, Matrix3<f64>), unplaced: StepBoundary) -> (Self, StepBoundary) {
        let point = |p: Vector3<f64>| origin + axes * p;
        let control = |c: Vector4<f64>| {
            let placed = axes * c.xyz() + origin * c.w;
            Vector4::new(placed.x, placed.y, placed.z, c.w)
        };
        let spline = |curve: &nurbs::NurbsCurve| nurbs::NurbsCurve {
            knots: curve.knots.clone(),
            controls: curve.controls.iter().copied().map(control).collect(),
        };
        let mut placed = unplaced.clone();
        for vertex in &mut placed.vertices {
            *vertex = point(*vertex);
        }
        for edge in &mut placed.edges {
            match &mut edge.curve {
                StepCurve::Line { origin, direction } => (*origin, *direction) = (point(*origin), axes * *direction),
                StepCurve::Circle { centre, axis, .. } => (*centre, *axis) = (point(*centre), axes * *axis),
                StepCurve::Spline(curve) => *curve = spline(curve),
                StepCurve::Other(_) => {}
            }
        }
        for face in &mut placed.faces {
            match &mut face.surface {
                StepSurface::Plane { origin, normal } => (*origin, *normal) = (point(*origin), axes * *normal),
                StepSurface::Cylinder { origin, axis, .. }
                | StepSurface::Cone { origin, axis, .. }
                | StepSurface::Torus { origin, axis, .. } => (*origin, *axis) = (point(*origin), axes * *axis),
                StepSurface::Spline(patch) => {
                    for row in &mut patch.controls {
                        for value in row {
                            *value = control(*value);
                        }
                    }
                }
                StepSurface::Swept { curve, direction } => (*curve, *direction) = (spline(curve), axes * *direction),
                StepSurface::Other(_) => {}
            }
        }
        (Self { origin, axes, unplaced }, placed)
    }

    /// A boundary as it lies after it is turned and moved.
    #[must_use]
    pub fn moved(boundary: &StepBoundary, origin: Vector3<f64>, axes: Matrix3<f64>) -> StepBoundary {
        Self::apply((origin, axes), boundary.clone()).1
    }

    /// What it does to the solid, in words: `turned over, and moved by (0.000, 0.000, 30.000) mm`.
    #[must_use]
    pub fn words(&self) -> String {
        let mut words = Vec::new();
        let up = self.axes.column(2).z;
        let turn = libm::acos((0.5 * (self.axes.trace() - 1.0)).clamp(-1.0, 1.0)).to_degrees();
        if turn > LEAST_TURN {
            words.push(match up {
                _ if up < -1.0 + NOTHING => "turned over".to_owned(),
                _ if up > 1.0 - NOTHING => format!("turned by {turn:.3}° about its axis"),
                _ => format!("turned by {turn:.3}°, its axis out of the upright"),
            });
        }
        if self.origin.norm() > NOTHING {
            let (x, y, z) = (self.origin.x, self.origin.y, self.origin.z);
            words.push(format!("moved by ({x:.3}, {y:.3}, {z:.3}) mm"));
        }
        words.join(", and ")
    }
}
