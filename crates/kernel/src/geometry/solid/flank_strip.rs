//! A flank of spline patches in a shell: a run of patches between an edge along the floor and one along the outside, closed all round or open.

use super::{EdgeCurve, FaceSurface, ShellBuilder, SolidVertex, SplineCurve, SplineSurface, backward, forward};
use truck_modeling::{InnerSpace, Point3};
use truck_topology::compress::{CompressedEdge, CompressedEdgeIndex, CompressedFace};

/// A flank in the shell: at the start of each patch k the vertices 2k at the floor and 2k + 1 outside, and the edges 3k along the floor, 3k + 1 along the
/// outside, 3k + 2 outwards at its start. Behind the last patch of an open flank follow two more vertices and the edge between them.
pub(super) struct ShellFlank {
    vertices: usize,
    edges: usize,
    patches: usize,
    closed: bool,
}

impl ShellFlank {
    fn station(&self, patch: usize) -> usize {
        if self.closed { patch % self.patches } else { patch }
    }

    pub(super) fn floor(&self, patch: usize) -> usize {
        self.vertices + 2 * self.station(patch)
    }

    pub(super) fn outer(&self, patch: usize) -> usize {
        self.floor(patch) + 1
    }

    /// The number of its patches, which is the station at its end.
    pub(super) fn last(&self) -> usize {
        self.patches
    }

    /// The edge outwards at a station.
    pub(super) fn outwards(&self, patch: usize) -> usize {
        if !self.closed && patch == self.patches {
            self.edges + 3 * patch
        } else {
            self.edges + 3 * self.station(patch) + 2
        }
    }

    /// Edges of a kind from the start of one patch to the start of another; of a closed flank all round where it is the same.
    fn between(&self, kind: usize, from: usize, to: usize) -> impl DoubleEndedIterator<Item = usize> + '_ {
        let to = if to > from || !self.closed { to } else { to + self.patches };
        (from..to).map(move |patch| self.edges + 3 * self.station(patch) + kind)
    }

    pub(super) fn floor_edges(&self, from: usize, to: usize) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.between(0, from, to)
    }

    pub(super) fn outer_edges(&self, from: usize, to: usize) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.between(1, from, to)
    }

    /// Adds patches whose metal lies above (`side` 1) or below (−1), u along the flank and v outwards.
    pub(super) fn add(walls: &mut ShellBuilder, patches: &[SplineSurface], side: f64, closed: bool) -> Self {
        let flank = Self {
            vertices: walls.shell.vertices.len(),
            edges: walls.shell.edges.len(),
            patches: patches.len().max(1),
            closed,
        };
        for (k, patch) in patches.iter().enumerate() {
            flank.add_patch(walls, k, patch, side);
        }
        if let Some(row) = patches.last().and_then(|patch| patch.controls.last()).filter(|_| !closed) {
            walls.shell.vertices.extend(row.first().into_iter().chain(row.last()).map(|point| SolidVertex(*point)));
            let knots = patches.last().map(|patch| patch.v.clone()).unwrap_or_default();
            let curve = EdgeCurve::Spline(SplineCurve { knots, controls: row.clone() });
            let vertices = (flank.floor(flank.patches), flank.outer(flank.patches));
            walls.shell.edges.push(CompressedEdge { vertices, curve });
        }
        flank
    }

    fn add_patch(&self, walls: &mut ShellBuilder, k: usize, patch: &SplineSurface, side: f64) {
        let first = patch.controls.first().cloned().unwrap_or_default();
        walls.shell.vertices.extend(first.first().into_iter().chain(first.last()).map(|point| SolidVertex(*point)));
        for (vertices, knots, controls) in [
            ((self.floor(k), self.floor(k + 1)), &patch.u, patch.first_column()),
            ((self.outer(k), self.outer(k + 1)), &patch.u, patch.last_column()),
            ((self.floor(k), self.outer(k)), &patch.v, first),
        ] {
            let curve = EdgeCurve::Spline(SplineCurve { knots: knots.clone(), controls });
            walls.shell.edges.push(CompressedEdge { vertices, curve });
        }
        let [floor, outer] = [0, 1].map(|kind| self.edges + 3 * self.station(k) + kind);
        let (start, end) = (self.outwards(k), self.outwards(k + 1));
        // Counter-clockwise about the normal out of the metal: of u by v it points down.
        let (run, surface) = if side > 0.0 {
            (vec![forward(floor), forward(end), backward(outer), backward(start)], patch.clone())
        } else {
            (vec![forward(start), forward(outer), backward(end), backward(floor)], patch.transposed())
        };
        let surface = FaceSurface::Spline(surface);
        walls.shell.faces.push(CompressedFace { boundaries: vec![run], orientation: true, surface });
    }
}

impl ShellBuilder {
    pub(super) fn place(&self, vertex: usize) -> Point3 {
        self.shell.vertices.get(vertex).map_or_else(|| Point3::new(f64::NAN, 0.0, 0.0), |vertex| vertex.0)
    }

    pub(super) fn add_vertex(&mut self, place: Point3) -> usize {
        self.shell.vertices.push(SolidVertex(place));
        self.shell.vertices.len() - 1
    }

    fn add_edge(&mut self, start: usize, end: usize, curve: EdgeCurve) -> usize {
        self.shell.edges.push(CompressedEdge { vertices: (start, end), curve });
        self.shell.edges.len() - 1
    }

    pub(super) fn add_line(&mut self, from: usize, to: usize) -> usize {
        let (a, b) = (self.place(from), self.place(to));
        self.add_edge(from, to, EdgeCurve::Line { origin: a, direction: (b - a).normalize() })
    }

    /// An arc about the axis, counter-clockwise.
    pub(super) fn add_arc(&mut self, vertices: (usize, usize), (radius, z): (f64, f64)) -> usize {
        self.add_edge(
            vertices.0,
            vertices.1,
            EdgeCurve::Circle { centre: Point3::new(0.0, 0.0, z), radius, clockwise: false },
        )
    }

    pub(super) fn add_spline(&mut self, start: usize, end: usize, curve: SplineCurve) -> usize {
        self.add_edge(start, end, EdgeCurve::Spline(curve))
    }

    /// A face whose loop runs counter-clockwise about the normal out of the metal, on a surface whose own normal points out of it or, hollow, into it.
    pub(super) fn add_face(&mut self, run: Vec<CompressedEdgeIndex>, surface: FaceSurface, hollow: bool) {
        let turned =
            |used: &CompressedEdgeIndex| CompressedEdgeIndex { index: used.index, orientation: !used.orientation };
        let run = if hollow { run.iter().rev().map(turned).collect() } else { run };
        self.shell.faces.push(CompressedFace { boundaries: vec![run], orientation: !hollow, surface });
    }
}

impl SplineSurface {
    /// The patch with its parameters exchanged.
    pub(super) fn first_column(&self) -> Vec<Point3> {
        self.controls.iter().filter_map(|row| row.first().copied()).collect()
    }

    pub(super) fn last_column(&self) -> Vec<Point3> {
        self.controls.iter().filter_map(|row| row.last().copied()).collect()
    }

    pub(super) fn transposed(&self) -> Self {
        let columns = self.controls.first().map_or(0, Vec::len);
        Self {
            u: self.v.clone(),
            v: self.u.clone(),
            controls: (0..columns)
                .map(|v| self.controls.iter().filter_map(|row| row.get(v).copied()).collect())
                .collect(),
        }
    }
}
