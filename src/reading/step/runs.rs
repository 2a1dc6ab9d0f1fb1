//! Runs of edges seen from above, as contours, and how far these are apart.

use crate::geometry::contour::{Bend, Contour, Cubic, Vertex};
use crate::geometry::track::Track;
use nalgebra::{Vector2, Vector3};

/// A closed run of edges of an end face, seen from above with the metal on its left.
#[derive(Debug, Clone, PartialEq)]
pub enum Loop {
    /// Of arcs, lines and cubic curves.
    Contour(Contour),
    /// Of the edges of patches, of which it has so many.
    Splines(usize),
}

/// The angle from one direction to another about an axis, in (0, 2π].
pub(super) fn sweep(from: Vector3<f64>, to: Vector3<f64>, axis: Vector3<f64>) -> f64 {
    let angle = libm::atan2(from.cross(&to).dot(&axis), from.dot(&to));
    if angle > 0.0 { angle } else { angle + std::f64::consts::TAU }
}

/// Cubic curves as vertices of a contour, from a start; the end is the next one's start.
pub(super) fn bent(start: Vector2<f64>, cubics: &[Cubic]) -> impl Iterator<Item = Vertex> + '_ {
    let starts = std::iter::once(start).chain(cubics.iter().skip(1).map(|cubic| cubic.points[0]));
    cubics.iter().zip(starts).map(|(Cubic { points: [_, leaves, arrives, _] }, point)| Vertex {
        point,
        bend: Bend::Cubic([*leaves, *arrives]),
    })
}

/// An arc as vertices of a contour, in two halves where it is long; the end is the next one's start.
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
    // The sweep from the centre's distance of the chord, so that a nearly straight arc keeps its digits.
    let chord = end - start;
    let away = side * ((start + end) * 0.5 - centre).perp(&chord) / chord.norm();
    let turn = 2.0 * libm::atan2(0.5 * chord.norm(), away);
    to.push(Vertex::new(start, side * libm::tan(0.25 * turn)));
}

/// How far the contours above and below are apart at most, mm; infinite where their counts differ.
pub(super) fn apart(under: &[Loop], above: &[Loop]) -> f64 {
    let contours = |loops: &[Loop]| -> Vec<Contour> {
        let of = |one: &Loop| match one {
            Loop::Contour(contour) => Some(contour.clone()),
            Loop::Splines(_) => None,
        };
        loops.iter().filter_map(of).collect()
    };
    let (under, above) = (contours(under), contours(above));
    if under.len() != above.len() {
        return f64::INFINITY;
    }
    let farthest = |from: &[Contour], to: &[Contour]| {
        let tracks: Vec<Track> = to.iter().map(Track::new).collect();
        let points = from.iter().flat_map(Contour::edges).flat_map(|edge| [edge.start(), edge.middle()]);
        let nearest = |point: Vector2<f64>| {
            let all = tracks.iter().filter_map(|track| track.nearest(point)).map(|nearest| nearest.left.abs());
            all.fold(f64::INFINITY, f64::min)
        };
        points.map(nearest).fold(0.0, f64::max)
    };
    farthest(&under, &above).max(farthest(&above, &under))
}
