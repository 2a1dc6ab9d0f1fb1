//! A hub on a solid: taken off before the solid is compared with a disc, and compared with the hub of the design.

use super::{StepBoundary, StepCurve, StepEdge, StepFace, StepSurface};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// The hub of a design, with the faces of the disc from which it stands out, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HubShape {
    /// Its radius.
    pub radius: f64,
    /// The lower end of the solid with the hub, and the upper end.
    pub ends: [f64; 2],
    /// The faces of the disc.
    pub faces: [f64; 2],
}

impl HubShape {
    /// The boundary of a solid without its hub, and the largest distance of the hub from that of the design, mm: infinite if the solid has none, or if
    /// anything else stands out from the faces of the disc.
    ///
    /// All that stands out from the faces is pushed back into them: the walls of the hub vanish, and its ends lie in the faces of the disc.
    #[must_use]
    pub fn taken_off(&self, boundary: &StepBoundary, reach: f64) -> (StepBoundary, f64) {
        let walls: Vec<usize> = (0..boundary.faces.len()).filter(|face| self.is_wall(boundary, *face, reach)).collect();
        let off = self.difference(boundary, &walls);
        let merged = merged_edges(boundary, &walls);
        let vertices: Vec<Vector3<f64>> = boundary.vertices.iter().map(|vertex| self.pushed(*vertex)).collect();
        let mut faces = Vec::with_capacity(boundary.faces.len());
        for (index, face) in boundary.faces.iter().enumerate() {
            if !walls.contains(&index) {
                faces.push(self.pushed_face(face, &merged));
            }
        }
        // The edges that only the walls had are dropped.
        let used: BTreeSet<usize> =
            faces.iter().flat_map(|face| face.loops.iter().flatten()).map(|run| run.0).collect();
        let places: BTreeMap<usize, usize> = used.iter().enumerate().map(|(place, edge)| (*edge, place)).collect();
        for (edge, _) in faces.iter_mut().flat_map(|face| face.loops.iter_mut().flatten()) {
            *edge = places.get(edge).copied().unwrap_or(usize::MAX);
        }
        let kept = used.iter().filter_map(|edge| boundary.edges.get(*edge));
        let edges = kept.map(|edge| self.pushed_edge(edge)).collect();
        (StepBoundary { vertices, edges, faces }, off)
    }

    fn pushed(&self, point: Vector3<f64>) -> Vector3<f64> {
        let [low, high] = self.faces;
        Vector3::new(point.x, point.y, point.z.clamp(low, high))
    }

    fn pushed_edge(&self, edge: &StepEdge) -> StepEdge {
        let curve = match &edge.curve {
            StepCurve::Circle { centre, axis, radius } => {
                StepCurve::Circle { centre: self.pushed(*centre), axis: *axis, radius: *radius }
            }
            StepCurve::Line { origin, direction } => {
                StepCurve::Line { origin: self.pushed(*origin), direction: *direction }
            }
            other => other.clone(),
        };
        StepEdge { curve, ..edge.clone() }
    }

    fn pushed_face(&self, face: &StepFace, merged: &BTreeMap<usize, MergedEdge>) -> StepFace {
        let surface = match &face.surface {
            StepSurface::Plane { origin, normal } if normal.xy().norm() < normal.z.abs() => {
                StepSurface::Plane { origin: self.pushed(*origin), normal: *normal }
            }
            other => other.clone(),
        };
        let run = |(edge, forward): &(usize, bool)| match merged.get(edge) {
            Some(into) => (into.edge, *forward == into.same_sense),
            None => (*edge, *forward),
        };
        let loops = face.loops.iter().map(|edges| edges.iter().map(run).collect()).collect();
        StepFace { surface, loops, ..face.clone() }
    }

    /// Whether an upright face stands out from a face of the disc, and does not reach into the disc.
    fn is_wall(&self, boundary: &StepBoundary, face: usize, reach: f64) -> bool {
        let Some(face) = boundary.faces.get(face) else { return false };
        let is_level = |normal: &Vector3<f64>| normal.xy().norm() < normal.z.abs();
        if matches!(&face.surface, StepSurface::Plane { normal, .. } if is_level(normal)) {
            return false;
        }
        let heights = || places(boundary, face).map(|place| place.z);
        let [low, high] = self.faces;
        let is_outside = |side: &dyn Fn(f64) -> bool| heights().all(side) && heights().count() > 0;
        is_outside(&|z| z <= low + reach) || is_outside(&|z| z >= high - reach)
    }

    /// The largest distance of the walls and ends of the hub of a solid from those of the design.
    fn difference(&self, boundary: &StepBoundary, walls: &[usize]) -> f64 {
        let heights = || boundary.vertices.iter().map(|vertex| vertex.z);
        let ends = [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)];
        let mut off = (ends[0] - self.ends[0]).abs().max((ends[1] - self.ends[1]).abs());
        if walls.is_empty() {
            return f64::INFINITY;
        }
        for wall in walls.iter().filter_map(|wall| boundary.faces.get(*wall)) {
            let StepSurface::Cylinder { origin, axis, radius } = &wall.surface else { return f64::INFINITY };
            if axis.xy().norm() > 1e-6 || !wall.same_sense {
                return f64::INFINITY;
            }
            off = off.max((radius - self.radius).abs() + origin.xy().norm());
        }
        off
    }
}

/// The edge that takes the place of another, and whether it runs in the same sense.
#[derive(Debug, Clone, Copy)]
struct MergedEdge {
    edge: usize,
    same_sense: bool,
}

/// The vertices of a face.
fn places<'a>(boundary: &'a StepBoundary, face: &'a StepFace) -> impl Iterator<Item = Vector3<f64>> + 'a {
    let edges = face.loops.iter().flatten().filter_map(|(edge, _)| boundary.edges.get(*edge));
    edges.flat_map(|edge| [edge.start, edge.end]).filter_map(|vertex| boundary.vertices.get(vertex).copied())
}

/// For each wall, its upper level edge as its lower one: they coincide once the wall has no height. In the run round a wall the two go in opposite directions.
fn merged_edges(boundary: &StepBoundary, walls: &[usize]) -> BTreeMap<usize, MergedEdge> {
    let mut merged = BTreeMap::new();
    for wall in walls.iter().filter_map(|wall| boundary.faces.get(*wall)) {
        let level: Vec<(usize, bool)> =
            wall.loops.iter().flatten().copied().filter(|run| is_level(boundary, *run)).collect();
        if let [(below, one), (above, other)] = level[..] {
            merged.insert(above, MergedEdge { edge: below, same_sense: one != other });
        }
    }
    merged
}

fn is_level(boundary: &StepBoundary, (edge, _): (usize, bool)) -> bool {
    let Some(edge) = boundary.edges.get(edge) else { return false };
    let height = |vertex: usize| boundary.vertices.get(vertex).map_or(f64::NAN, |vertex| vertex.z);
    match &edge.curve {
        StepCurve::Line { direction, .. } => direction.z.abs() < 0.5,
        _ => (height(edge.start) - height(edge.end)).abs() < 1e-6,
    }
}
