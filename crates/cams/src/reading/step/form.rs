//! Recognises a boundary as a cam: a shell that closes, two level end faces with their contours, and upright walls between them; for a
//! conoid, a flank of spline patches.

use super::runs::{FaceLoop, arcs, cubic_vertices, end_difference, sweep};
use super::splines::with_plain_shapes;
use super::upright::{LevelEdge, SweptSurface, WORK, with_lines_for_splines};
use super::{StepBoundary, StepCurve, StepEdge, StepFace, StepSurface};
use camgen_kernel::geometry::contour::{Contour, Vertex};
use camgen_kernel::geometry::nurbs;
use nalgebra::Vector3;
use std::cell::Cell;
use std::collections::BTreeMap;

/// The role of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FaceRole {
    /// Level, its normal down.
    Under,
    /// Level, its normal up.
    Above,
    /// Level, its normal up, below the upper end.
    Floor,
    /// Upright.
    Wall,
    /// A spline patch.
    Patch,
    /// A cone or a torus about the axis.
    Round,
    /// A face that a cam does not have.
    Strange,
}

/// The expected kind of spline faces and edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlankShape {
    /// Upright walls, on cubic curves.
    Upright,
    /// Patches of a flank that is not upright.
    Patches,
    /// Patches of flanks in a round body: upright faces may be bounded by their edges.
    Swept,
}

/// A boundary, recognised as a cam.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SolidForm {
    /// Where the shell does not close, or edges do not lie on their vertices and faces, a sentence each.
    pub open: Vec<String>,
    /// Faces that are not ends, upright walls or patches, or are turned inside out, a sentence each.
    pub strange: Vec<String>,
    /// Heights of the end faces below, mm.
    pub low: Vec<f64>,
    /// Heights of the end faces above, mm.
    pub high: Vec<f64>,
    /// Closed runs of edges of the end faces below.
    pub under: Vec<FaceLoop>,
    /// Closed runs of edges of the end faces above.
    pub above: Vec<FaceLoop>,
    /// Height of the floor of a pocket, mm, where there is one level face up below the upper end.
    pub floor: Option<f64>,
    /// Spline patches, each with whether its normal points out of the metal.
    pub patches: Vec<(nurbs::NurbsSurface, bool)>,
    /// Largest distance between the walls' contours above and below, mm.
    pub end_difference: f64,
    /// How many faces and edges are splines of which camgen does not know the exact shape.
    pub unread_splines: usize,
    /// Volume by the walls and the end faces, mm³, of a solid without patches; `None` where a face or an edge was not read.
    pub volume: Option<f64>,
}

/// Places of a rim at which its distance from a cylinder is taken.
const PLACES: u32 = 24;
/// Most sentences of one kind.
const MOST_REPORTED: usize = 20;
/// Least cosine between the normal of a wall and the outside of its contour: they are equal or opposite.
const SAME_SIDE: f64 = 0.9;

struct FormRecognizer<'a> {
    boundary: &'a StepBoundary,
    flank: FlankShape,
    /// Places nearer than this count as one, mm.
    reach: f64,
    /// How far the boundary reaches from the axis and along it, mm.
    size: f64,
    /// For each spline edge of an upright flank its curve, or why it cannot be such an edge.
    levels: Vec<Option<Result<LevelEdge, &'static str>>>,
    /// The surface of each face that is swept upwards from a curve.
    uprights: Vec<Option<SweptSurface>>,
    /// Remaining work for edges of upright walls.
    work: Cell<usize>,
    roles: Vec<FaceRole>,
    /// The users of each edge: face and sense.
    uses: Vec<Vec<(usize, bool)>>,
    form: SolidForm,
}

/// Recognises a boundary; places within `reach` (mm) count as one.
#[must_use]
pub fn form(boundary: &StepBoundary, flank: FlankShape, reach: f64) -> SolidForm {
    let straight =
        (flank == FlankShape::Upright).then(|| with_lines_for_splines(&with_plain_shapes(boundary, reach), reach));
    let boundary = straight.as_ref().unwrap_or(boundary);
    let size = boundary.vertices.iter().map(Vector3::norm).fold(0.0, f64::max);
    let uses = vec![Vec::new(); boundary.edges.len()];
    let (levels, uprights, roles, form) = (Vec::new(), Vec::new(), Vec::new(), SolidForm::default());
    let work = Cell::new(WORK);
    let mut former = FormRecognizer { boundary, flank, reach, size, levels, uprights, work, roles, uses, form };
    if flank == FlankShape::Upright {
        former.levels = boundary.edges.iter().map(|edge| former.level(edge)).collect();
        former.uprights = boundary.faces.iter().map(|face| SweptSurface::of(&face.surface, reach, size)).collect();
    }
    former.roles = (0..boundary.faces.len()).map(|index| former.role(index)).collect();
    former.floor();
    former.use_edges();
    former.close();
    former.edges_lie_on_their_vertices();
    former.edges_lie_on_their_faces();
    former.faces();
    former.form.under = former.loops(FaceRole::Under);
    former.form.above = former.loops(FaceRole::Above);
    let pocket: Vec<FaceLoop> = former.loops(FaceRole::Floor).iter().map(FaceLoop::reversed).collect();
    // The walls of a pocket reach from its floor to the upper end, the others from end to end.
    let below: Vec<FaceLoop> = former.form.under.iter().chain(&pocket).cloned().collect();
    former.form.end_difference = end_difference(&below, &former.form.above);
    let strange = former.roles.contains(&FaceRole::Strange);
    let unread = (0..boundary.edges.len()).any(|edge| former.is_unread(edge));
    let is_spline = |(role, face): (&FaceRole, &StepFace)| {
        let is_curved =
            matches!(face.surface, StepSurface::Spline(_) | StepSurface::Swept { .. } | StepSurface::Other(_));
        *role == FaceRole::Strange && is_curved
    };
    former.form.unread_splines = former.roles.iter().zip(&boundary.faces).filter(|of| is_spline(*of)).count()
        + (0..boundary.edges.len()).filter(|edge| former.is_unread(*edge)).count();
    former.form.volume = (!strange && !unread).then(|| former.volume());
    former.form.open.truncate(MOST_REPORTED);
    former.form.strange.truncate(MOST_REPORTED);
    former.form
}

/// Distance of a point from a line along a unit vector.
fn off_line(point: Vector3<f64>, origin: Vector3<f64>, direction: Vector3<f64>) -> f64 {
    (point - origin).cross(&direction).norm()
}

/// Largest distance of an edge from a cone or a torus about an axis, mm, at a number of places.
fn off_round(
    (surface, origin, axis): (&StepSurface, Vector3<f64>, Vector3<f64>),
    curve: &StepCurve,
    ends: [Vector3<f64>; 2],
) -> f64 {
    let off = |point: Vector3<f64>| {
        let height = (point - origin).dot(&axis);
        let away = (point - origin - axis * height).norm();
        match surface {
            StepSurface::Cone { radius, slope, .. } => {
                (away - radius - slope * height).abs() / libm::hypot(1.0, *slope)
            }
            StepSurface::Torus { major, minor, .. } => (libm::hypot(away - major, height) - minor).abs(),
            _ => f64::INFINITY,
        }
    };
    let at_places = |place: &dyn Fn(f64) -> Vector3<f64>| {
        let all = (0..=PLACES).map(|i| off(place(f64::from(i) / f64::from(PLACES))));
        all.fold(0.0, |most: f64, next| if next <= most { most } else { next })
    };
    match curve {
        StepCurve::Line { .. } => at_places(&|share| ends[0] + (ends[1] - ends[0]) * share),
        // About the axis of the surface.
        StepCurve::Circle { centre, axis: own, radius } => {
            let tilt = off_line(*centre, origin, axis) + radius * axis.cross(own).norm();
            tilt + ends.map(off).into_iter().fold(0.0, f64::max)
        }
        StepCurve::Spline(curve) => {
            let (first, last) = curve.knots.range();
            at_places(&|share| curve.point_and_slope(first + (last - first) * share).0)
        }
        // Reported elsewhere.
        StepCurve::Other(_) => 0.0,
    }
}

impl FormRecognizer<'_> {
    fn place(&self, vertex: usize) -> Vector3<f64> {
        self.boundary.vertices.get(vertex).copied().unwrap_or_else(|| Vector3::repeat(f64::NAN))
    }

    /// First and last place of an edge in the sense in which it is run.
    fn ends(&self, (edge, forward): (usize, bool)) -> [Vector3<f64>; 2] {
        let Some(edge) = self.boundary.edges.get(edge) else { return [Vector3::repeat(f64::NAN); 2] };
        let (start, end) = (self.place(edge.start), self.place(edge.end));
        if forward { [start, end] } else { [end, start] }
    }

    fn level(&self, edge: &StepEdge) -> Option<Result<LevelEdge, &'static str>> {
        let is_spline = matches!(edge.curve, StepCurve::Spline(_));
        is_spline.then(|| LevelEdge::of(edge, [self.place(edge.start), self.place(edge.end)], self.reach))
    }

    /// Whether an edge is a rim of a flank in a round body.
    fn is_rim(&self, edge: usize) -> bool {
        let curve = self.boundary.edges.get(edge).map(|edge| &edge.curve);
        self.flank == FlankShape::Swept && matches!(curve, Some(StepCurve::Spline(_)))
    }

    /// The spline edge of an upright flank, where it is one.
    fn level_of(&self, edge: usize) -> Option<&LevelEdge> {
        self.levels.get(edge)?.as_ref()?.as_ref().ok()
    }

    /// Whether it is a spline edge of an upright flank that cannot be one.
    fn is_unread(&self, edge: usize) -> bool {
        matches!(self.levels.get(edge), Some(Some(Err(_))))
    }

    /// The surface of a face that is swept upwards from a curve.
    fn upright_of(&self, face: usize) -> Option<&SweptSurface> {
        self.uprights.get(face)?.as_ref()
    }

    fn role(&self, index: usize) -> FaceRole {
        let Some(face) = self.boundary.faces.get(index) else { return FaceRole::Strange };
        // A tilt counts by how far it lifts the rim.
        let level = |tilt: f64| tilt * self.size <= self.reach;
        match &face.surface {
            StepSurface::Plane { normal, .. } if level(normal.xy().norm()) => {
                if (normal.z > 0.0) == face.same_sense {
                    FaceRole::Above
                } else {
                    FaceRole::Under
                }
            }
            StepSurface::Plane { normal, .. } if level(normal.z.abs()) => FaceRole::Wall,
            StepSurface::Cylinder { axis, .. } if level(axis.xy().norm()) => FaceRole::Wall,
            _ if self.upright_of(index).is_some() => FaceRole::Wall,
            StepSurface::Spline(_) if self.flank != FlankShape::Upright => FaceRole::Patch,
            StepSurface::Cone { axis, .. } | StepSurface::Torus { axis, .. }
                if self.flank == FlankShape::Swept && level(axis.xy().norm()) =>
            {
                FaceRole::Round
            }
            _ => FaceRole::Strange,
        }
    }

    /// Level faces of one height below that of the others are the floor of a pocket.
    fn floor(&mut self) {
        let high = |index: usize| match self.boundary.faces.get(index).map(|face| &face.surface) {
            Some(StepSurface::Plane { origin, normal }) => origin.dot(normal) / normal.z,
            _ => f64::NAN,
        };
        let above: Vec<usize> = self
            .roles
            .iter()
            .enumerate()
            .filter(|(_, role)| **role == FaceRole::Above)
            .map(|(index, _)| index)
            .collect();
        let top = above.iter().map(|index| high(*index)).fold(f64::NEG_INFINITY, f64::max);
        let lower: Vec<usize> = above.into_iter().filter(|index| high(*index) < top - 2.0 * self.reach).collect();
        let Some(floor) = lower.first().map(|index| high(*index)) else { return };
        if lower.iter().all(|index| (high(*index) - floor).abs() <= 2.0 * self.reach) {
            self.form.floor = Some(floor);
            for index in lower {
                if let Some(role) = self.roles.get_mut(index) {
                    *role = FaceRole::Floor;
                }
            }
        }
    }

    fn use_edges(&mut self) {
        for (index, face) in self.boundary.faces.iter().enumerate() {
            for (edge, forward) in face.loops.iter().flatten() {
                if let Some(uses) = self.uses.get_mut(*edge) {
                    uses.push((index, *forward));
                }
            }
        }
    }

    /// Every edge twice in opposite senses, every run closed, one piece.
    fn close(&mut self) {
        let mut open = Vec::new();
        for (edge, uses) in self.boundary.edges.iter().zip(&self.uses) {
            match uses.as_slice() {
                [(_, a), (_, b)] if a != b => {}
                [_, _] => open.push(format!("the edge of line {} is used twice in the same sense", edge.line)),
                other => open.push(format!("the edge of line {} has {} faces, not two", edge.line, other.len())),
            }
        }
        for face in &self.boundary.faces {
            for run in &face.loops {
                let next = run.iter().cycle().skip(1);
                let broken = |(a, b): (&(usize, bool), &(usize, bool))| {
                    let gap = (self.ends(*a)[1] - self.ends(*b)[0]).norm();
                    !(gap <= self.reach)
                };
                if run.is_empty() || run.iter().zip(next).any(broken) {
                    open.push(format!("a bound of the face of line {} is not closed", face.line));
                }
            }
        }
        let pieces = self.pieces();
        if pieces != 1 {
            open.push(format!("the shell is in {pieces} pieces that do not touch"));
        }
        self.form.open.extend(open);
    }

    /// The number of groups of faces that are connected by their edges.
    fn pieces(&self) -> usize {
        let mut parents: Vec<usize> = (0..self.boundary.faces.len()).collect();
        for uses in &self.uses {
            for pair in uses.windows(2) {
                let [(a, _), (b, _)] = pair else { continue };
                let (a, b) = (root(&mut parents, *a), root(&mut parents, *b));
                if let Some(slot) = parents.get_mut(a) {
                    *slot = b;
                }
            }
        }
        parents.iter().enumerate().filter(|(index, parent)| index == *parent).count()
    }

    fn edges_lie_on_their_vertices(&mut self) {
        let mut open = Vec::new();
        for (index, edge) in self.boundary.edges.iter().enumerate() {
            let ends = [self.place(edge.start), self.place(edge.end)];
            let [start, end] = if edge.forward { ends } else { [ends[1], ends[0]] };
            let (off, along) = match &edge.curve {
                StepCurve::Line { origin, direction } => {
                    let off = ends.map(|end| off_line(end, *origin, *direction));
                    (off[0].max(off[1]), (end - start).dot(direction) > 0.0)
                }
                StepCurve::Circle { centre, axis, radius } => {
                    let off = ends.map(|end| {
                        let (away, height) = (end - centre, (end - centre).dot(axis));
                        ((away - axis * height).norm() - radius).abs().max(height.abs())
                    });
                    (off[0].max(off[1]), true)
                }
                StepCurve::Spline(_) if self.flank == FlankShape::Upright => match self.levels.get(index) {
                    Some(Some(Ok(level))) => (level.off, true),
                    Some(Some(Err(why))) => {
                        open.push(format!("the spline edge of line {} is {why}", edge.line));
                        continue;
                    }
                    _ => (f64::INFINITY, true),
                },
                StepCurve::Spline(curve) => {
                    let (first, last) = curve.knots.range();
                    (
                        (curve.point_and_slope(first).0 - start)
                            .norm()
                            .max((curve.point_and_slope(last).0 - end).norm()),
                        true,
                    )
                }
                StepCurve::Other(what) => {
                    open.push(format!("{what} is not a kind of edge that a cam has"));
                    continue;
                }
            };
            if !(off <= self.reach) {
                open.push(format!("the edge of line {} misses its vertices by {off:.6} mm", edge.line));
            } else if !along {
                open.push(format!("the edge of line {} runs against its line", edge.line));
            }
        }
        self.form.open.extend(open);
    }

    fn edges_lie_on_their_faces(&mut self) {
        let mut open = Vec::new();
        for (number, (edge, uses)) in self.boundary.edges.iter().zip(&self.uses).enumerate() {
            for (index, _) in uses {
                let Some(face) = self.boundary.faces.get(*index) else { continue };
                let off = match self.upright_of(*index) {
                    Some(upright) => self.off_upright((number, edge), upright),
                    // Why a spline is not a level edge is reported elsewhere.
                    None if self.is_unread(number) => 0.0,
                    None => self.off(edge, &face.surface),
                };
                if off.is_finite() && off > self.reach {
                    open.push(format!(
                        "the edge of line {} leaves the face of line {} by {off:.6} mm",
                        edge.line, face.line
                    ));
                } else if !(off <= self.reach) {
                    open.push(format!(
                        "the edge of line {} is not of a kind that can lie on the face of line {}",
                        edge.line, face.line
                    ));
                }
            }
        }
        self.form.open.extend(open);
    }

    /// Largest distance of an edge from an upright surface over a spline, mm, or a bound for it.
    fn off_upright(&self, (number, edge): (usize, &StepEdge), upright: &SweptSurface) -> f64 {
        let ends = [self.place(edge.start), self.place(edge.end)];
        match (&edge.curve, self.level_of(number)) {
            (StepCurve::Line { .. }, _) => upright.off_line(ends),
            (_, Some(level)) => upright.off_level(level, ends, self.reach, &self.work),
            // Why a spline is not a level edge is reported elsewhere.
            (StepCurve::Spline(_) | StepCurve::Other(_), None) => 0.0,
            (StepCurve::Circle { .. }, None) => f64::INFINITY,
        }
    }

    /// Largest distance of an edge from a surface, mm, or a bound for it.
    fn off(&self, edge: &StepEdge, surface: &StepSurface) -> f64 {
        let ends = [self.place(edge.start), self.place(edge.end)];
        let largest =
            |values: &[f64]| values.iter().copied().fold(0.0, |most, next| if next <= most { most } else { next });
        match (surface, &edge.curve) {
            (StepSurface::Plane { origin, normal }, StepCurve::Line { .. }) => {
                largest(&ends.map(|end| (end - origin).dot(normal).abs()))
            }
            (StepSurface::Plane { origin, normal }, StepCurve::Circle { centre, axis, radius }) => {
                (centre - origin).dot(normal).abs() + radius * axis.cross(normal).norm()
            }
            // A spline lies within the hull of its control points.
            (StepSurface::Plane { origin, normal }, StepCurve::Spline(curve)) => {
                let off = |control: &nalgebra::Vector4<f64>| (control.xyz() / control.w - origin).dot(normal).abs();
                largest(&curve.controls.iter().map(off).collect::<Vec<_>>())
            }
            (StepSurface::Cylinder { origin, axis, radius }, StepCurve::Line { .. }) => {
                let off = |place: Vector3<f64>| (off_line(place, *origin, *axis) - radius).abs();
                largest(&[off(ends[0]), off(ends[1]), off((ends[0] + ends[1]) * 0.5)])
            }
            (
                StepSurface::Cylinder { origin, axis, radius },
                StepCurve::Circle { centre, axis: own, radius: of_edge },
            ) => off_line(*centre, *origin, *axis) + (of_edge - radius).abs() + of_edge * axis.cross(own).norm(),
            (StepSurface::Cylinder { origin, axis, radius }, StepCurve::Spline(curve))
                if self.flank == FlankShape::Swept =>
            {
                let (first, last) = curve.knots.range();
                let place = |i: u32| curve.point_and_slope(first + (last - first) * f64::from(i) / f64::from(PLACES)).0;
                largest(&(0..=PLACES).map(|i| (off_line(place(i), *origin, *axis) - radius).abs()).collect::<Vec<_>>())
            }
            (StepSurface::Cone { origin, axis, .. } | StepSurface::Torus { origin, axis, .. }, curve)
                if self.flank == FlankShape::Swept =>
            {
                off_round((surface, *origin, *axis), curve, ends)
            }
            (StepSurface::Spline(patch), StepCurve::Spline(curve)) if self.flank != FlankShape::Upright => {
                let along = if edge.forward { curve.clone() } else { curve.reversed() };
                let sides = patch.boundary().into_iter().flatten();
                let off = |side: nurbs::NurbsCurve| side.farthest(&along).min(side.farthest(&along.reversed()));
                sides.map(off).fold(f64::INFINITY, f64::min)
            }
            (StepSurface::Spline(_), _) if self.flank != FlankShape::Upright => f64::INFINITY,
            // A face of an unknown kind is reported elsewhere.
            (StepSurface::Other(_) | StepSurface::Spline(_) | StepSurface::Swept { .. }, _)
            | (_, StepCurve::Other(_)) => 0.0,
            _ => f64::INFINITY,
        }
    }

    /// Heights of the ends, unexpected faces, orientation of the walls.
    fn faces(&mut self) {
        let mut strange = Vec::new();
        for (index, (face, role)) in self.boundary.faces.iter().zip(&self.roles).enumerate() {
            match (role, &face.surface) {
                (FaceRole::Under, StepSurface::Plane { origin, normal }) => {
                    self.form.low.push(origin.dot(normal) / normal.z);
                }
                (FaceRole::Above, StepSurface::Plane { origin, normal }) => {
                    self.form.high.push(origin.dot(normal) / normal.z);
                }
                (FaceRole::Floor | FaceRole::Round, _) => {}
                (FaceRole::Patch, StepSurface::Spline(patch)) => {
                    if !self.is_whole(face, patch) {
                        strange.push(format!("the patch of line {} is not bounded by its own four edges", face.line));
                    }
                    self.form.patches.push((patch.clone(), face.same_sense));
                }
                (FaceRole::Wall, _) => {
                    let mut read =
                        face.loops.iter().flatten().filter(|run| !self.is_unread(run.0) && !self.is_rim(run.0));
                    if read.any(|run| !(self.outward(index, *run) >= SAME_SIDE)) {
                        strange.push(format!("the wall of line {} is turned inside out", face.line));
                    }
                }
                (_, StepSurface::Other(what)) => strange.push(format!("{what} is not a kind of face that a cam has")),
                (_, StepSurface::Spline(_) | StepSurface::Swept { .. }) => strange
                    .push(format!("the spline face of line {} is not upright over a curve without weights", face.line)),
                _ => strange.push(format!("the face of line {} is neither level nor upright", face.line)),
            }
        }
        self.form.strange.extend(strange);
    }

    /// Whether the edges of a patch are its own sides in their order.
    fn is_whole(&self, face: &StepFace, patch: &nurbs::NurbsSurface) -> bool {
        let (Some(sides), [run]) = (patch.boundary(), face.loops.as_slice()) else { return false };
        let side_of = |used: &(usize, bool)| {
            let [start, end] = self.ends(*used);
            let fits = |side: &nurbs::NurbsCurve| {
                let (first, last) = side.knots.range();
                let ends = [side.point_and_slope(first).0, side.point_and_slope(last).0];
                let [a, b] = if face.same_sense { ends } else { [ends[1], ends[0]] };
                (a - start).norm() <= self.reach && (b - end).norm() <= self.reach
            };
            sides.iter().position(fits)
        };
        let found: Option<Vec<usize>> = run.iter().map(side_of).collect();
        let step = if face.same_sense { 1 } else { 3 };
        found.is_some_and(|found| {
            let next = found.iter().cycle().skip(1);
            found.len() == 4 && found.iter().zip(next).all(|(a, b)| (a + step) % 4 == *b)
        })
    }

    /// The cosine between a wall's normal and the outside of one of its level edges: above the edge the skin of the metal goes on
    /// downwards, below it upwards. 1 for an upright edge.
    fn outward(&self, face: usize, run: (usize, bool)) -> f64 {
        let Some((_, tangent, normal)) = self.middle(face, run) else { return f64::NAN };
        if tangent.z.abs() > 0.5 {
            return 1.0;
        }
        // Seen from outside, the skin lies to the left of its edge.
        let inside = normal.cross(&tangent).z;
        let [a, b] = self.ends(run).map(|place| place.z);
        let (low, high) = self.heights();
        let level = 0.5 * (a + b);
        if (level - low).abs() <= self.reach {
            inside
        } else if (level - high).abs() <= self.reach {
            -inside
        } else {
            // Between two parts of one wall.
            1.0
        }
    }

    fn heights(&self) -> (f64, f64) {
        let heights = || self.boundary.vertices.iter().map(|place| place.z);
        (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max))
    }

    /// Middle and direction of an edge as it is run, and the normal of a face out of the metal there.
    fn middle(&self, face: usize, run: (usize, bool)) -> Option<(Vector3<f64>, Vector3<f64>, Vector3<f64>)> {
        let upright = self.upright_of(face);
        let (face, edge) = (self.boundary.faces.get(face)?, self.boundary.edges.get(run.0)?);
        let [start, end] = self.ends(run);
        let (place, tangent) = match &edge.curve {
            StepCurve::Line { .. } => ((start + end) * 0.5, (end - start).normalize()),
            StepCurve::Circle { centre, axis, radius } => {
                let counter = edge.forward == run.1;
                let (from, to) = (start - centre, end - centre);
                let half = 0.5 * sweep(from, to, if counter { *axis } else { -axis });
                let axis = if counter { *axis } else { -axis };
                let radial = from * libm::cos(half) + axis.cross(&from) * libm::sin(half);
                (centre + radial.normalize() * *radius, axis.cross(&radial).normalize())
            }
            _ => {
                let cubics = self.level_of(run.0)?.run(run.1);
                let (place, tangent) = cubics.get(cubics.len() / 2)?.point_and_tangent(0.5);
                (place.push(start.z), tangent.push(0.0))
            }
        };
        let normal = match &face.surface {
            _ if upright.is_some() => upright?.normal(place.xy())?,
            StepSurface::Plane { normal, .. } => *normal,
            StepSurface::Cylinder { origin, axis, .. } => {
                let away = place - origin;
                (away - axis * away.dot(axis)).normalize()
            }
            _ => return None,
        };
        Some((place, tangent, if face.same_sense { normal } else { -normal }))
    }

    /// The closed runs round all end faces of a role together: edges between two of these faces are inner edges.
    fn loops(&mut self, role: FaceRole) -> Vec<FaceLoop> {
        let is = |face: usize| self.roles.get(face) == Some(&role);
        let mut next: BTreeMap<usize, Vec<(usize, bool)>> = BTreeMap::new();
        let mut rim = Vec::new();
        for (edge, uses) in self.uses.iter().enumerate() {
            let [mine] = uses.iter().filter(|(face, _)| is(*face)).collect::<Vec<_>>()[..] else { continue };
            // Seen from above, a lower end is run in the opposite sense.
            let run = (edge, mine.1 == (role != FaceRole::Under));
            next.entry(self.vertices(run).0).or_default().push(run);
            rim.push(run);
        }
        let mut loops = Vec::new();
        let mut broken = false;
        for start in rim {
            let mut run = Vec::new();
            let mut at = self.vertices(start).0;
            while let Some(edge) = next.get_mut(&at).and_then(Vec::pop) {
                // Where two runs touch, it is not known which edge follows.
                broken |= next.get(&at).is_some_and(|others| !others.is_empty());
                run.push(edge);
                at = self.vertices(edge).1;
            }
            if !run.is_empty() {
                broken |= at != self.vertices(run.first().copied().unwrap_or(start)).0;
                loops.extend(self.contour(&run));
            }
        }
        if broken {
            self.form.open.push("the rim of an end face does not consist of closed runs of edges".into());
        }
        loops
    }

    fn vertices(&self, (edge, forward): (usize, bool)) -> (usize, usize) {
        let ends = self.boundary.edges.get(edge).map_or((usize::MAX, usize::MAX), |edge| (edge.start, edge.end));
        if forward { ends } else { (ends.1, ends.0) }
    }

    fn contour(&self, run: &[(usize, bool)]) -> Option<FaceLoop> {
        let mut vertices = Vec::new();
        let mut splines = 0;
        for used in run {
            let [start, end] = self.ends(*used).map(|place| place.xy());
            let edge = self.boundary.edges.get(used.0)?;
            match &edge.curve {
                StepCurve::Circle { centre, axis, .. } => {
                    let counter = (edge.forward == used.1) == (axis.z > 0.0);
                    arcs(start, end, centre.xy(), counter, edge.start == edge.end, &mut vertices);
                }
                StepCurve::Spline(_) => match self.level_of(used.0) {
                    Some(level) => vertices.extend(cubic_vertices(start, &level.run(used.1))),
                    None => splines += 1,
                },
                _ => vertices.push(Vertex::new(start, 0.0)),
            }
        }
        Some(if splines > 0 { FaceLoop::Splines(splines) } else { FaceLoop::Contour(Contour { vertices }) })
    }

    /// Gauss' ∮ (x, y, 0)/2 · n over the walls, mm³: for each wall its height times the area that its edges sweep about the axis. An
    /// upper edge is run against the contour, with the skin to its left.
    fn volume(&self) -> f64 {
        let mut volume = 0.0;
        for (face, role) in self.boundary.faces.iter().zip(&self.roles) {
            for run in face.loops.iter().flatten().filter(|_| *role == FaceRole::Wall) {
                let [start, end] = self.ends(*run);
                let Some(FaceLoop::Contour(piece)) = self.contour(&[*run]) else { continue };
                let ends = piece.vertices.iter().skip(1).map(|vertex| vertex.point).chain([end.xy()]);
                let segments = piece.vertices.iter().zip(ends);
                let swept = segments.map(|(vertex, end)| {
                    let edge = vertex.to(end);
                    if edge.segment().is_some() && edge.start() == edge.end() { 0.0 } else { edge.area_and_moments().0 }
                });
                volume -= 0.5 * (start.z + end.z) * swept.sum::<f64>();
            }
        }
        volume
    }
}

/// The face that represents all faces connected with this one; the chain to it is shortened.
fn root(parents: &mut [usize], mut at: usize) -> usize {
    while let Some(parent) = parents.get(at).copied().filter(|parent| *parent != at) {
        let above = parents.get(parent).copied().unwrap_or(parent);
        if let Some(slot) = parents.get_mut(at) {
            *slot = above;
        }
        at = above;
    }
    at
}
