//! A true section through a solid of revolution with grooves, along its axis: by the faces and edges of its boundary.

use super::{EdgeCurve, FaceSurface, SplineSurface, TruckBoundary, TruckShell};
use crate::numeric::spline::bspline_basis;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// Parts of a curved edge in which it crosses the plane once at the most, and halvings of a part.
const PARTS: u32 = 64;
const HALVINGS: u32 = 52;
/// Points of a curve on a patch and on a torus between its ends.
const POINTS: u32 = 48;
/// The plane is turned by this, rad, against the wanted one: edges and seams that would lie in it cross it, and no point moves by more than a micrometre on 10 m.
const ASIDE: f64 = 1e-7;

/// A curve of the section, on one face.
#[derive(Debug, Clone, PartialEq)]
pub struct AxialCurve {
    /// Its points: distance from the axis, negative on the far side, and height, mm.
    pub points: Vec<Vector2<f64>>,
    /// Whether a roller runs on the face.
    pub is_flank: bool,
}

/// The curves in which a plane through the axis z, along a direction (a unit vector), cuts the boundary of a solid. They join to closed loops.
#[must_use]
pub fn axial_section(boundary: &TruckBoundary, along: Vector2<f64>) -> Vec<AxialCurve> {
    let (sin, cos) = libm::sincos(ASIDE);
    let along = Vector2::new(along.x * cos - along.y * sin, along.x * sin + along.y * cos);
    let plane = AxialPlane { along, away: Vector2::new(-along.y, along.x) };
    boundary.boundaries.iter().flat_map(|shell| plane.cut(shell)).collect()
}

/// A plane through the axis.
struct AxialPlane {
    along: Vector2<f64>,
    away: Vector2<f64>,
}

impl AxialPlane {
    fn cut(&self, shell: &TruckShell) -> Vec<AxialCurve> {
        let crossings: Vec<Vec<Vector2<f64>>> =
            (0..shell.edges.len()).map(|edge| self.crossings(shell, edge)).collect();
        let mut curves = Vec::new();
        for face in &shell.faces {
            let edges = face.boundaries.iter().flatten();
            let mut points: Vec<Vector2<f64>> =
                edges.filter_map(|used| crossings.get(used.index)).flatten().copied().collect();
            let key = |point: &Vector2<f64>| order_on(&face.surface, *point);
            points.sort_by(|a, b| key(a).0.total_cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)));
            for ends in points.chunks_exact(2) {
                let &[from, to] = ends else { continue };
                let between = self.between(&face.surface, from, to);
                let points = std::iter::once(from).chain(between).chain([to]).collect();
                curves.push(AxialCurve { points, is_flank: matches!(face.surface, FaceSurface::Spline(_)) });
            }
        }
        curves
    }

    fn aside(&self, point: Vector3<f64>) -> f64 {
        self.away.dot(&point.xy())
    }

    fn in_plane(&self, point: Vector3<f64>) -> Vector2<f64> {
        Vector2::new(self.along.dot(&point.xy()), point.z)
    }

    /// The points of an edge in the plane.
    fn crossings(&self, shell: &TruckShell, edge: usize) -> Vec<Vector2<f64>> {
        let Some(edge) = shell.edges.get(edge) else { return Vec::new() };
        let vertex =
            |index: usize| shell.vertices.get(index).map(|vertex| Vector3::new(vertex.0.x, vertex.0.y, vertex.0.z));
        let (Some(start), Some(end)) = (vertex(edge.vertices.0), vertex(edge.vertices.1)) else { return Vec::new() };
        let parts = if matches!(edge.curve, EdgeCurve::Line { .. }) { 1 } else { PARTS };
        let place = |share: f64| point_of_edge(&edge.curve, (start, end), share);
        let mut found = Vec::new();
        for part in 0..parts {
            let [from, to] = [part, part + 1].map(|part| f64::from(part) / f64::from(parts));
            found.extend(self.root((from, to), &place).map(|share| self.in_plane(place(share))));
        }
        found
    }

    /// The parameter between two at which a curve crosses the plane.
    fn root(&self, (mut from, mut to): (f64, f64), place: &impl Fn(f64) -> Vector3<f64>) -> Option<f64> {
        let is_left = self.aside(place(from)) >= 0.0;
        if is_left == (self.aside(place(to)) >= 0.0) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (from + to);
            if (self.aside(place(middle)) >= 0.0) == is_left { from = middle } else { to = middle }
        }
        Some(0.5 * (from + to))
    }

    /// Points of a curve on a face between its ends; none of a straight one.
    fn between(&self, surface: &FaceSurface, from: Vector2<f64>, to: Vector2<f64>) -> Vec<Vector2<f64>> {
        match surface {
            FaceSurface::Plane { .. } | FaceSurface::Cylinder { .. } | FaceSurface::Cone { .. } => Vec::new(),
            FaceSurface::Torus { major, minor } => {
                let centre = Vector2::new(libm::copysign(*major, from.x), 0.0);
                let [start, end] =
                    [from, to].map(|point| libm::atan2(point.y, (centre.x - point.x) * centre.x.signum()));
                let on = |share: f64| {
                    let (sin, cos) = libm::sincos(start + (end - start) * share);
                    centre + Vector2::new(-cos * centre.x.signum(), sin) * *minor
                };
                (1..POINTS).map(|index| on(f64::from(index) / f64::from(POINTS))).collect()
            }
            FaceSurface::Spline(patch) => self.on_patch(patch, from, to),
        }
    }

    /// Points of a patch in the plane, from one end of the curve to the other.
    fn on_patch(&self, patch: &SplineSurface, from: Vector2<f64>, to: Vector2<f64>) -> Vec<Vector2<f64>> {
        let [(first, last), (low, high)] = patch.range();
        let mut found = Vec::new();
        for level in 1..POINTS {
            let v = low + (high - low) * f64::from(level) / f64::from(POINTS);
            let place = |u: f64| patch.point_and_slopes(u, v)[0];
            for part in 0..PARTS {
                let [start, end] =
                    [part, part + 1].map(|part| first + (last - first) * f64::from(part) / f64::from(PARTS));
                let root = self.root((start, end), &place).map(|u| self.in_plane(place(u)));
                found.extend(root.filter(|point| (point.x >= 0.0) == (from.x >= 0.0)));
            }
        }
        let way = to - from;
        found.sort_by(|a, b| way.dot(a).total_cmp(&way.dot(b)));
        found
    }
}

/// The order of points along a face: on one side of the axis before the other, then along the curve of the section.
fn order_on(surface: &FaceSurface, point: Vector2<f64>) -> (f64, f64) {
    let side = point.x.signum();
    match surface {
        FaceSurface::Plane { normal, .. } if normal.z.abs() > 0.5 => (0.0, point.x),
        FaceSurface::Cone { .. } => (side, point.x.abs()),
        FaceSurface::Torus { major, .. } => (side, libm::atan2(point.y, major - point.x.abs())),
        FaceSurface::Plane { .. } | FaceSurface::Cylinder { .. } | FaceSurface::Spline(_) => (side, point.y),
    }
}

/// The point of an edge at a share of its way.
fn point_of_edge(curve: &EdgeCurve, (start, end): (Vector3<f64>, Vector3<f64>), share: f64) -> Vector3<f64> {
    match curve {
        EdgeCurve::Line { .. } => start + (end - start) * share,
        EdgeCurve::Circle { centre, radius, clockwise } => {
            let centre = Vector3::new(centre.x, centre.y, centre.z);
            let angle = |point: Vector3<f64>| libm::atan2(point.y - centre.y, point.x - centre.x);
            let turn = (angle(end) - angle(start)).rem_euclid(TAU);
            let turn = if turn == 0.0 { TAU } else { turn };
            let sweep = if *clockwise { turn - TAU } else { turn };
            // A full circle runs clockwise, too.
            let sweep = if sweep == 0.0 { -TAU } else { sweep };
            let (sin, cos) = libm::sincos(angle(start) + share * sweep);
            Vector3::new(centre.x + radius * cos, centre.y + radius * sin, centre.z)
        }
        EdgeCurve::Spline(spline) => {
            let first = spline.knots.first().copied().unwrap_or(0.0);
            let last = spline.knots.last().copied().unwrap_or(1.0);
            let (index, basis, _) = bspline_basis(&spline.knots, first + (last - first) * share);
            let mut point = Vector3::zeros();
            for (control, weight) in spline.controls.iter().skip(index).zip(basis) {
                point += Vector3::new(control.x, control.y, control.z) * weight;
            }
            point
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::stacked::{Wall, stacked};
    use super::*;
    use crate::geometry::contour::Contour;

    /// A ring Ø80/Ø20 × 10 with a hub Ø40 × 15 below: on either side of the axis a closed line of six corners.
    #[test]
    fn a_ring_with_a_hub_is_cut_into_two_closed_lines() {
        let circle = |radius: f64| Contour::circle(Vector2::zeros(), radius);
        let hub = Wall { carries_metal: true, ..Wall::through(circle(20.0), -15.0, 0.0) };
        let bore = Wall::through(circle(10.0).reversed(), -15.0, 10.0);
        let solid = stacked(&[Wall::through(circle(40.0), 0.0, 10.0), hub, bore]).expect("a solid");
        let curves = axial_section(&solid.boundary, Vector2::x());
        let near = |point: Vector2<f64>, [x, z]: [f64; 2]| (point - Vector2::new(x, z)).norm() < 1e-5;
        for side in [1.0, -1.0] {
            let corners = [[10.0, -15.0], [20.0, -15.0], [20.0, 0.0], [40.0, 0.0], [40.0, 10.0], [10.0, 10.0]];
            for corner in corners {
                let ends = curves.iter().flat_map(|curve| [curve.points[0], curve.points[curve.points.len() - 1]]);
                let meet = ends.filter(|end| near(*end, [side * corner[0], corner[1]])).count();
                assert_eq!(meet, 2, "{corner:?}: {curves:?}");
            }
        }
        assert_eq!(curves.len(), 12);
    }
}
