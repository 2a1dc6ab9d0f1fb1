//! The largest distance between two chains, whatever their shape: for a chain that does not follow the outline.

use super::boundary::Boundary;
use super::contour::{Contour, Vertex};
use super::edge_path::EdgePath;
use super::edge_tree::EdgeTree;
use super::following::Deviation;
use crate::numeric::extremum;
use nalgebra::Vector2;

/// Arcs fitted to a stretch of the exact outline: with eight stretches a piece they lie within a nanometre of it.
const ARCS: u32 = 64;
/// A part of a chain is refined while it may lie farther away than the farthest place found by this share.
const CLOSER: f64 = 0.02;
/// Most parts that are examined.
const MOST_PARTS: usize = 200_000;
/// Parts that may contain the farthest place and are solved, with golden sections.
const SOLVED: usize = 8;
/// Rounding of a distance, mm.
const ROUNDING: f64 = 1e-12;

/// The largest distance between a chain and an exact outline, in both directions.
#[must_use]
pub fn two_sided_distance(contour: &Contour, boundary: &Boundary<'_>) -> Deviation {
    let exact = arcs(boundary);
    let there = farthest(contour, &EdgeTree::new(&exact));
    let back = farthest(&exact, &EdgeTree::new(contour));
    if back.distance > there.distance { back } else { there }
}

/// The exact outline as many short arcs.
fn arcs(boundary: &Boundary<'_>) -> Contour {
    let mut vertices = Vec::new();
    for (index, stretch) in boundary.stretches().iter().enumerate() {
        let places = (0..=ARCS).map(|step| {
            boundary.point_at(index, stretch.from + (stretch.to - stretch.from) * f64::from(step) / f64::from(ARCS))
        });
        let places: Vec<_> = places.collect();
        for pair in places.windows(2) {
            let [Some(a), Some(b)] = pair else { continue };
            let turn = libm::atan2(a.tangent.perp(&b.tangent), a.tangent.dot(&b.tangent));
            vertices.push(Vertex::new(a.point, libm::tan(0.25 * turn)));
        }
    }
    Contour { vertices }
}

/// A part of a segment: its length, and the distances of its ends from the other chain.
struct SegmentPart<'a> {
    path: &'a EdgePath,
    from: (f64, f64),
    to: (f64, f64),
}

impl SegmentPart<'_> {
    /// The largest possible distance of the part from the other chain: a distance changes no faster than the place.
    fn most(&self) -> f64 {
        0.5 * (self.from.1 + self.to.1 + self.to.0 - self.from.0)
    }
}

/// The place of a chain that lies farthest from another.
fn farthest(chain: &Contour, other: &EdgeTree) -> Deviation {
    let paths: Vec<EdgePath> = chain.edges().flat_map(|edge| EdgePath::paths(&edge)).collect();
    let away = |point: Vector2<f64>| other.nearest(point).map_or(f64::INFINITY, |nearest| nearest.left.abs());
    let mut best = Deviation { distance: -1.0, at: Vector2::zeros() };
    let mut parts = Vec::new();
    // Most paths start where the one before ended.
    let mut last = (Vector2::repeat(f64::NAN), f64::NAN);
    for path in &paths {
        let [from, to] = [0.0, path.length()].map(|length| {
            let at = path.point_and_tangent(length).0;
            if at != last.0 {
                last = (at, away(at));
            }
            if last.1 > best.distance {
                best = Deviation { distance: last.1, at };
            }
            (length, last.1)
        });
        parts.push(SegmentPart { path, from, to });
    }
    let mut left = MOST_PARTS;
    let mut highest: Vec<SegmentPart<'_>> = Vec::new();
    while let Some(part) = parts.pop() {
        let middle = 0.5 * (part.from.0 + part.to.0);
        if part.most() <= best.distance * (1.0 + CLOSER) + ROUNDING || left == 0 {
            if part.most() > best.distance {
                highest.push(part);
            }
            continue;
        }
        left -= 1;
        let at = part.path.point_and_tangent(middle).0;
        let distance = away(at);
        if distance > best.distance {
            best = Deviation { distance, at };
        }
        parts.push(SegmentPart { path: part.path, from: part.from, to: (middle, distance) });
        parts.push(SegmentPart { path: part.path, from: (middle, distance), to: part.to });
    }
    highest.sort_by(|a, b| b.from.1.max(b.to.1).total_cmp(&a.from.1.max(a.to.1)));
    for part in highest.iter().take(SOLVED) {
        let range = (part.from.0, part.to.0);
        let top = extremum::largest_without_slope(
            |length| away(part.path.point_and_tangent(length).0),
            range,
            4,
            extremum::TO_ROUNDING,
        );
        if top.value > best.distance {
            best = Deviation { distance: top.value, at: part.path.point_and_tangent(top.at).0 };
        }
    }
    best
}
