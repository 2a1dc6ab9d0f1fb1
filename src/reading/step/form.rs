//! What a boundary amounts to: a shell that closes, two level end faces with their contours, and upright walls between them; of a
//! conoid, a flank of spline patches.

use super::runs::{Loop, apart, arcs, bent, sweep};
use super::upright::{Level, Upright, WORK, straightened};
use super::{Boundary, Curve, Edge, Face, Surface};
use crate::geometry::contour::{Contour, Vertex};
use crate::geometry::nurbs;
use nalgebra::Vector3;
use std::cell::Cell;
use std::collections::BTreeMap;

/// What a face is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    /// Level, its normal down.
    Under,
    /// Level, its normal up.
    Above,
    /// Upright.
    Wall,
    /// A spline patch.
    Patch,
    /// Nothing that a cam has.
    Strange,
}

/// What spline faces and edges are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flank {
    /// Upright walls, on cubic curves; anything else is strange.
    Upright,
    /// Patches of a flank that is not upright.
    Patches,
}

/// What a boundary amounts to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Form {
    /// Where the shell does not close, or edges leave their vertices and faces, a sentence each.
    pub open: Vec<String>,
    /// Faces that are neither ends nor upright walls nor patches, or are turned inside out, a sentence each.
    pub strange: Vec<String>,
    /// Heights of the end faces below, mm.
    pub low: Vec<f64>,
    /// Heights of the end faces above, mm.
    pub high: Vec<f64>,
    /// Runs round the end faces below.
    pub under: Vec<Loop>,
    /// Runs round the end faces above.
    pub above: Vec<Loop>,
    /// Spline patches, each with whether its normal points out of the metal.
    pub patches: Vec<(nurbs::Surface, bool)>,
    /// How far the walls' contours above and below are apart at most, mm.
    pub apart: f64,
    /// Volume by the walls and the end faces, mm³, of a solid without patches.
    pub volume: f64,
}

/// Sentences of one kind that are told; more say no more.
const MOST_TOLD: usize = 20;
/// Least cosine between the normal of a wall and the outside of its contour: they are one or opposite.
const SAME_SIDE: f64 = 0.9;

struct Former<'a> {
    boundary: &'a Boundary,
    flank: Flank,
    /// Within this, mm, places are one.
    reach: f64,
    /// How far the boundary reaches from the axis and along it, mm.
    size: f64,
    /// Of each spline edge of an upright flank what it is, or why it is no such edge.
    levels: Vec<Option<Result<Level, &'static str>>>,
    /// Of each face that a curve sweeps upwards the surface.
    uprights: Vec<Option<Upright>>,
    /// What may yet be spent on edges of upright walls.
    work: Cell<usize>,
    roles: Vec<Role>,
    /// Who uses each edge: face and sense.
    uses: Vec<Vec<(usize, bool)>>,
    form: Form,
}

/// What a boundary amounts to; places within `reach` (mm) are one.
#[must_use]
pub fn form(boundary: &Boundary, flank: Flank, reach: f64) -> Form {
    let straight = (flank == Flank::Upright).then(|| straightened(boundary, reach));
    let boundary = straight.as_ref().unwrap_or(boundary);
    let size = boundary.vertices.iter().map(Vector3::norm).fold(0.0, f64::max);
    let uses = vec![Vec::new(); boundary.edges.len()];
    let (levels, uprights, roles, form) = (Vec::new(), Vec::new(), Vec::new(), Form::default());
    let work = Cell::new(WORK);
    let mut former = Former { boundary, flank, reach, size, levels, uprights, work, roles, uses, form };
    if flank == Flank::Upright {
        former.levels = boundary.edges.iter().map(|edge| former.level(edge)).collect();
        former.uprights = boundary.faces.iter().map(|face| Upright::of(&face.surface, reach, size)).collect();
    }
    former.roles = (0..boundary.faces.len()).map(|index| former.role(index)).collect();
    former.use_edges();
    former.close();
    former.edges_lie_on_their_vertices();
    former.edges_lie_on_their_faces();
    former.faces();
    former.form.under = former.loops(Role::Under);
    former.form.above = former.loops(Role::Above);
    former.form.apart = apart(&former.form.under, &former.form.above);
    former.form.volume = former.volume();
    former.form.open.truncate(MOST_TOLD);
    former.form.strange.truncate(MOST_TOLD);
    former.form
}

/// Distance of a point from a line along a unit vector.
fn off_line(point: Vector3<f64>, origin: Vector3<f64>, direction: Vector3<f64>) -> f64 {
    (point - origin).cross(&direction).norm()
}

impl Former<'_> {
    fn place(&self, vertex: usize) -> Vector3<f64> {
        self.boundary.vertices.get(vertex).copied().unwrap_or_else(|| Vector3::repeat(f64::NAN))
    }

    /// First and last place of an edge as it is run.
    fn ends(&self, (edge, forward): (usize, bool)) -> [Vector3<f64>; 2] {
        let Some(edge) = self.boundary.edges.get(edge) else { return [Vector3::repeat(f64::NAN); 2] };
        let (start, end) = (self.place(edge.start), self.place(edge.end));
        if forward { [start, end] } else { [end, start] }
    }

    fn level(&self, edge: &Edge) -> Option<Result<Level, &'static str>> {
        let is_spline = matches!(edge.curve, Curve::Spline(_));
        is_spline.then(|| Level::of(edge, [self.place(edge.start), self.place(edge.end)], self.reach))
    }

    /// The spline edge of an upright flank, where it is one.
    fn level_of(&self, edge: usize) -> Option<&Level> {
        self.levels.get(edge)?.as_ref()?.as_ref().ok()
    }

    /// The surface of a face that a curve sweeps upwards.
    fn upright_of(&self, face: usize) -> Option<&Upright> {
        self.uprights.get(face)?.as_ref()
    }

    fn role(&self, index: usize) -> Role {
        let Some(face) = self.boundary.faces.get(index) else { return Role::Strange };
        // A tilt counts by how far it lifts the rim.
        let level = |tilt: f64| tilt * self.size <= self.reach;
        match &face.surface {
            Surface::Plane { normal, .. } if level(normal.xy().norm()) => {
                if (normal.z > 0.0) == face.same_sense {
                    Role::Above
                } else {
                    Role::Under
                }
            }
            Surface::Plane { normal, .. } if level(normal.z.abs()) => Role::Wall,
            Surface::Cylinder { axis, .. } if level(axis.xy().norm()) => Role::Wall,
            _ if self.upright_of(index).is_some() => Role::Wall,
            Surface::Spline(_) if self.flank == Flank::Patches => Role::Patch,
            _ => Role::Strange,
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
                [_, _] => open.push(format!("the edge of line {} is run twice in one sense", edge.line)),
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
                    open.push(format!("a run of edges round the face of line {} does not close", face.line));
                }
            }
        }
        let pieces = self.pieces();
        if pieces != 1 {
            open.push(format!("the shell is in {pieces} pieces that do not touch"));
        }
        self.form.open.extend(open);
    }

    /// How many sets of faces hang together by their edges.
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
                Curve::Line { origin, direction } => {
                    let off = ends.map(|end| off_line(end, *origin, *direction));
                    (off[0].max(off[1]), (end - start).dot(direction) > 0.0)
                }
                Curve::Circle { centre, axis, radius } => {
                    let off = ends.map(|end| {
                        let (away, height) = (end - centre, (end - centre).dot(axis));
                        ((away - axis * height).norm() - radius).abs().max(height.abs())
                    });
                    (off[0].max(off[1]), true)
                }
                Curve::Spline(_) if self.flank == Flank::Upright => match self.levels.get(index) {
                    Some(Some(Ok(level))) => (level.off, true),
                    Some(Some(Err(why))) => {
                        open.push(format!("the spline edge of line {} is {why}", edge.line));
                        continue;
                    }
                    _ => (f64::INFINITY, true),
                },
                Curve::Spline(curve) => {
                    let (first, last) = curve.knots.range();
                    ((curve.at(first).0 - start).norm().max((curve.at(last).0 - end).norm()), true)
                }
                Curve::Other(what) => {
                    open.push(format!("{what} is no edge that a cam has"));
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
                    None => self.off(edge, &face.surface),
                };
                if !(off <= self.reach) {
                    open.push(format!(
                        "the edge of line {} leaves the face of line {} by {off:.6} mm",
                        edge.line, face.line
                    ));
                }
            }
        }
        self.form.open.extend(open);
    }

    /// How far an edge leaves an upright surface over a spline at most, mm, or a bound for it.
    fn off_upright(&self, (number, edge): (usize, &Edge), upright: &Upright) -> f64 {
        let ends = [self.place(edge.start), self.place(edge.end)];
        match (&edge.curve, self.level_of(number)) {
            (Curve::Line { .. }, _) => upright.off_line(ends),
            (_, Some(level)) => upright.off_level(level, ends, self.reach, &self.work),
            // What a spline is no level edge for, is told elsewhere.
            (Curve::Spline(_) | Curve::Other(_), None) => 0.0,
            (Curve::Circle { .. }, None) => f64::INFINITY,
        }
    }

    /// How far an edge leaves a surface at most, mm, or a bound for it.
    fn off(&self, edge: &Edge, surface: &Surface) -> f64 {
        let ends = [self.place(edge.start), self.place(edge.end)];
        let largest =
            |values: &[f64]| values.iter().copied().fold(0.0, |most, next| if next <= most { most } else { next });
        match (surface, &edge.curve) {
            (Surface::Plane { origin, normal }, Curve::Line { .. }) => {
                largest(&ends.map(|end| (end - origin).dot(normal).abs()))
            }
            (Surface::Plane { origin, normal }, Curve::Circle { centre, axis, radius }) => {
                (centre - origin).dot(normal).abs() + radius * axis.cross(normal).norm()
            }
            // A spline lies within the hull of its control points.
            (Surface::Plane { origin, normal }, Curve::Spline(curve)) => {
                let off = |control: &nalgebra::Vector4<f64>| (control.xyz() / control.w - origin).dot(normal).abs();
                largest(&curve.controls.iter().map(off).collect::<Vec<_>>())
            }
            (Surface::Cylinder { origin, axis, radius }, Curve::Line { .. }) => {
                let off = |place: Vector3<f64>| (off_line(place, *origin, *axis) - radius).abs();
                largest(&[off(ends[0]), off(ends[1]), off((ends[0] + ends[1]) * 0.5)])
            }
            (Surface::Cylinder { origin, axis, radius }, Curve::Circle { centre, axis: own, radius: of_edge }) => {
                off_line(*centre, *origin, *axis) + (of_edge - radius).abs() + of_edge * axis.cross(own).norm()
            }
            (Surface::Spline(patch), Curve::Spline(curve)) if self.flank == Flank::Patches => {
                let along = if edge.forward { curve.clone() } else { curve.reversed() };
                let sides = patch.boundary().into_iter().flatten();
                let off = |side: nurbs::Curve| side.farthest(&along).min(side.farthest(&along.reversed()));
                sides.map(off).fold(f64::INFINITY, f64::min)
            }
            (Surface::Spline(_), _) if self.flank == Flank::Patches => f64::INFINITY,
            // What a face of no known kind is, is told elsewhere.
            (Surface::Other(_) | Surface::Spline(_) | Surface::Swept { .. }, _) | (_, Curve::Other(_)) => 0.0,
            _ => f64::INFINITY,
        }
    }

    /// Heights of the ends, strange faces, walls on the right side.
    fn faces(&mut self) {
        let mut strange = Vec::new();
        for (index, (face, role)) in self.boundary.faces.iter().zip(&self.roles).enumerate() {
            match (role, &face.surface) {
                (Role::Under, Surface::Plane { origin, normal }) => self.form.low.push(origin.dot(normal) / normal.z),
                (Role::Above, Surface::Plane { origin, normal }) => self.form.high.push(origin.dot(normal) / normal.z),
                (Role::Patch, Surface::Spline(patch)) => {
                    if !self.is_whole(face, patch) {
                        strange.push(format!("the patch of line {} is not bounded by its own four edges", face.line));
                    }
                    self.form.patches.push((patch.clone(), face.same_sense));
                }
                (Role::Wall, _) => {
                    if face.loops.iter().flatten().any(|run| !(self.outward(index, *run) >= SAME_SIDE)) {
                        strange.push(format!("the wall of line {} is turned inside out", face.line));
                    }
                }
                (_, Surface::Other(what)) => strange.push(format!("{what} is no face that a cam has")),
                (_, Surface::Spline(_) | Surface::Swept { .. }) => strange.push(format!(
                    "the spline face of line {} is not an upright one over a curve without weights",
                    face.line
                )),
                _ => strange.push(format!("the face of line {} is neither level nor upright", face.line)),
            }
        }
        self.form.strange.extend(strange);
    }

    /// Whether the edges of a patch are its own sides in their order.
    fn is_whole(&self, face: &Face, patch: &nurbs::Surface) -> bool {
        let (Some(sides), [run]) = (patch.boundary(), face.loops.as_slice()) else { return false };
        let side_of = |used: &(usize, bool)| {
            let [start, end] = self.ends(*used);
            let fits = |side: &nurbs::Curve| {
                let (first, last) = side.knots.range();
                let ends = [side.at(first).0, side.at(last).0];
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

    /// The cosine between a wall's normal and the outside of a level edge that it runs: above the edge the metal's skin goes on
    /// downwards, below it upwards. 1 for an upright edge.
    fn outward(&self, face: usize, run: (usize, bool)) -> f64 {
        let Some((_, tangent, normal)) = self.middle(face, run) else { return f64::NAN };
        if tangent.z.abs() > 0.5 {
            return 1.0;
        }
        // The skin lies to the left of its edge, seen from outside.
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
            Curve::Line { .. } => ((start + end) * 0.5, (end - start).normalize()),
            Curve::Circle { centre, axis, radius } => {
                let counter = edge.forward == run.1;
                let (from, to) = (start - centre, end - centre);
                let half = 0.5 * sweep(from, to, if counter { *axis } else { -axis });
                let axis = if counter { *axis } else { -axis };
                let radial = from * libm::cos(half) + axis.cross(&from) * libm::sin(half);
                (centre + radial.normalize() * *radius, axis.cross(&radial).normalize())
            }
            _ => {
                let cubics = self.level_of(run.0)?.run(run.1);
                let (place, tangent) = cubics.get(cubics.len() / 2)?.at(0.5);
                (place.push(start.z), tangent.push(0.0))
            }
        };
        let normal = match &face.surface {
            _ if upright.is_some() => upright?.normal(place.xy())?,
            Surface::Plane { normal, .. } => *normal,
            Surface::Cylinder { origin, axis, .. } => {
                let away = place - origin;
                (away - axis * away.dot(axis)).normalize()
            }
            _ => return None,
        };
        Some((place, tangent, if face.same_sense { normal } else { -normal }))
    }

    /// The runs round all end faces of a role together: edges between two of them are within.
    fn loops(&mut self, role: Role) -> Vec<Loop> {
        let is = |face: usize| self.roles.get(face) == Some(&role);
        let mut next: BTreeMap<usize, Vec<(usize, bool)>> = BTreeMap::new();
        let mut rim = Vec::new();
        for (edge, uses) in self.uses.iter().enumerate() {
            let [mine] = uses.iter().filter(|(face, _)| is(*face)).collect::<Vec<_>>()[..] else { continue };
            // Seen from above an end below is run the other way round.
            let run = (edge, mine.1 == (role == Role::Above));
            next.entry(self.vertices(run).0).or_default().push(run);
            rim.push(run);
        }
        let mut loops = Vec::new();
        let mut broken = false;
        for start in rim {
            let mut run = Vec::new();
            let mut at = self.vertices(start).0;
            while let Some(edge) = next.get_mut(&at).and_then(Vec::pop) {
                // Where two runs touch, which goes on is a guess.
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
            self.form.open.push("the rim of an end face is not one run of edges after another".into());
        }
        loops
    }

    fn vertices(&self, (edge, forward): (usize, bool)) -> (usize, usize) {
        let ends = self.boundary.edges.get(edge).map_or((usize::MAX, usize::MAX), |edge| (edge.start, edge.end));
        if forward { ends } else { (ends.1, ends.0) }
    }

    fn contour(&self, run: &[(usize, bool)]) -> Option<Loop> {
        let mut vertices = Vec::new();
        let mut splines = 0;
        for used in run {
            let [start, end] = self.ends(*used).map(|place| place.xy());
            let edge = self.boundary.edges.get(used.0)?;
            match &edge.curve {
                Curve::Circle { centre, axis, .. } => {
                    let counter = (edge.forward == used.1) == (axis.z > 0.0);
                    arcs(start, end, centre.xy(), counter, edge.start == edge.end, &mut vertices);
                }
                Curve::Spline(_) => match self.level_of(used.0) {
                    Some(level) => vertices.extend(bent(start, &level.run(used.1))),
                    None => splines += 1,
                },
                _ => vertices.push(Vertex::new(start, 0.0)),
            }
        }
        Some(if splines > 0 { Loop::Splines(splines) } else { Loop::Contour(Contour { vertices }) })
    }

    /// Gauss' ∮ (x, y, 0)/2 · n over the walls, mm³: of each its height times the area that its edges sweep about the axis. An
    /// edge above is run against the contour, with the skin to its left.
    fn volume(&self) -> f64 {
        let mut volume = 0.0;
        for (face, role) in self.boundary.faces.iter().zip(&self.roles) {
            for run in face.loops.iter().flatten().filter(|_| *role == Role::Wall) {
                let [start, end] = self.ends(*run);
                let Some(Loop::Contour(piece)) = self.contour(&[*run]) else { continue };
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

/// The face that stands for all that hang together with this one; the way to it is halved.
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
