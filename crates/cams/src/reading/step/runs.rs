//! Runs of edges seen from above, as contours, and the distance between these.

use camgen_kernel::geometry::contour::{Bend, Contour, Cubic, Vertex};
use camgen_kernel::geometry::edge_tree::EdgeTree;
use nalgebra::{Vector2, Vector3};

/// A closed run of edges of an end face, seen from above with the metal on its left.
#[derive(Debug, Clone, PartialEq)]
pub enum FaceLoop {
    /// Of arcs, lines and cubic curves.
    Contour(Contour),
    /// Of the edges of patches: their number.
    Splines(usize),
}

impl FaceLoop {
    /// Seen from below.
    pub(super) fn reversed(&self) -> Self {
        match self {
            FaceLoop::Contour(contour) => FaceLoop::Contour(contour.reversed()),
            splines @ FaceLoop::Splines(_) => splines.clone(),
        }
    }
}

/// The angle from one direction to another about an axis, in (0, 2π].
pub(super) fn sweep(from: Vector3<f64>, to: Vector3<f64>, axis: Vector3<f64>) -> f64 {
    let angle = libm::atan2(from.cross(&to).dot(&axis), from.dot(&to));
    if angle > 0.0 { angle } else { angle + std::f64::consts::TAU }
}

/// Cubic curves as vertices of a contour, from a start; each end is the start of the next.
pub(super) fn cubic_vertices(start: Vector2<f64>, cubics: &[Cubic]) -> impl Iterator<Item = Vertex> + '_ {
    let starts = std::iter::once(start).chain(cubics.iter().skip(1).map(|cubic| cubic.points[0]));
    cubics.iter().zip(starts).map(|(Cubic { points: [_, leaves, arrives, _] }, point)| Vertex {
        point,
        bend: Bend::Cubic([*leaves, *arrives]),
    })
}

/// An arc as vertices of a contour, in two halves where it is long; the end is the start of the next.
pub(super) fn arcs(
    start: Vector2<f64>,
    end: Vector2<f64>,
    centre: Vector2<f64>,
    counter: bool,
    whole: bool,
    to: &mut Vec<Vertex>,
) {
    let side = if counter { 1.0 } else { -1.0 };
    if whole {
        to.push(Vertex::new(start, side));
        to.push(Vertex::new(centre * 2.0 - start, side));
        return;
    }
    // The sweep from the centre's distance from the chord, so that a nearly straight arc keeps its digits.
    let chord = end - start;
    let away = side * ((start + end) * 0.5 - centre).perp(&chord) / chord.norm();
    let turn = 2.0 * libm::atan2(0.5 * chord.norm(), away);
    to.push(Vertex::new(start, side * libm::tan(0.25 * turn)));
}

/// Largest distance between the contours above and below, mm; infinite where their counts differ.
pub(super) fn end_difference(under: &[FaceLoop], above: &[FaceLoop]) -> f64 {
    let contours = |loops: &[FaceLoop]| -> Vec<Contour> {
        let of = |one: &FaceLoop| match one {
            FaceLoop::Contour(contour) => Some(contour.clone()),
            FaceLoop::Splines(_) => None,
        };
        loops.iter().filter_map(of).collect()
    };
    let (under, above) = (contours(under), contours(above));
    if under.len() != above.len() {
        return f64::INFINITY;
    }
    let farthest = |from: &[Contour], to: &[Contour]| {
        let trees: Vec<EdgeTree> = to.iter().map(EdgeTree::new).collect();
        let points = from.iter().flat_map(Contour::edges).flat_map(|edge| [edge.start(), edge.middle()]);
        let nearest = |point: Vector2<f64>| {
            let all = trees.iter().filter_map(|tree| tree.nearest(point)).map(|nearest| nearest.left.abs());
            all.fold(f64::INFINITY, f64::min)
        };
        points.map(nearest).fold(0.0, f64::max)
    };
    farthest(&under, &above).max(farthest(&above, &under))
}
