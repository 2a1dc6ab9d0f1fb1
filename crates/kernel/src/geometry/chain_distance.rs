//! The largest distance of one closed chain from another, exactly.
//!
//! A piece of one is compared with the segment of the other that is nearest to its middle. Where the piece runs alongside that
//! segment, the distance is largest at an end of the piece or where the two are parallel, in closed form; everywhere else, and
//! for cubic curves, it is bounded by the distance of the middle and half the length, and the piece is halved.

use super::contour::{Contour, Edge, Segment};
use super::edge_tree::EdgeTree;
use nalgebra::Vector2;

/// Steeper than this, as a cosine, a piece does not run alongside a segment.
const ALONGSIDE: f64 = 0.9;
/// Largest sweep of a piece that is compared as a whole, rad.
const WIDEST: f64 = 0.5;
/// The search ends when the bound is this near to the largest distance found.
const NEAR: f64 = 1e-6;
/// Rounding of a distance, over the size of the drawing.
const ROUNDING: f64 = 1e-14;
/// Most pieces that are examined: far more than any chain needs.
const MOST_PIECES: usize = 20_000_000;

/// The place of a chain that is farthest from another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarthestPlace {
    /// Its distance, mm: not below the true one, and above it by less than a millionth or by `fine`.
    pub distance: f64,
    /// The place, mm.
    pub place: Vector2<f64>,
}

/// The place of a chain farthest from another chain; differences below `fine` (mm) are not resolved.
#[must_use]
pub fn farthest_place(chain: &Contour, from: &Contour, fine: f64) -> FarthestPlace {
    let tree = EdgeTree::new(from);
    let beyond = FarthestPlace { distance: f64::INFINITY, place: Vector2::zeros() };
    let extents = chain.extents().with(&from.extents());
    let rounding = ROUNDING * (extents.least.norm() + extents.largest.norm());
    let (mut found, mut bound) = (FarthestPlace { distance: 0.0, ..beyond }, 0.0_f64);
    let mut open: Vec<Edge> =
        chain.edges().filter(|edge| edge.start() != edge.end() || edge.segment().is_none()).collect();
    let mut looked = 0;
    while let Some(piece) = open.pop() {
        let middle = piece.middle();
        let Some((index, nearest)) = tree.nearest_segment(middle) else { return beyond };
        let (distance, Some(segment)) = (nearest.left.abs(), tree.edges().get(index)) else { return beyond };
        if distance > found.distance {
            found = FarthestPlace { distance, place: middle };
        }
        looked += 1;
        if looked > MOST_PIECES {
            return beyond;
        }
        // The middle of the parameter of a cubic curve is not that of its length.
        let half = if piece.segment().is_some() { 0.5 * piece.length() } else { piece.length() };
        let whole =
            piece.segment().zip(segment.segment()).and_then(|(piece, segment)| alongside(&piece, &segment, rounding));
        let most = whole.unwrap_or(f64::INFINITY).min(distance + half);
        if most <= found.distance * (1.0 + NEAR) + fine.max(rounding) {
            bound = bound.max(most);
        } else {
            let (first, last) = piece.halves();
            open.extend([last, first]);
        }
    }
    FarthestPlace { distance: found.distance.max(bound), place: found.place }
}

/// Largest distance of a piece from a segment alongside which it runs over its whole length; `None` where it does not.
fn alongside(piece: &Segment, segment: &Segment, rounding: f64) -> Option<f64> {
    let middle = 0.5 * (piece.end - piece.start);
    let direction = middle.normalize();
    if !(piece.sweep().abs() < WIDEST) {
        return None;
    }
    let mut most = 0.0_f64;
    for end in [piece.start, piece.end] {
        let nearest = segment.nearest(end);
        // The foot lies within the segment, so that the nearest point of its whole circle or line is no nearer.
        let square = (end - nearest.foot).dot(&nearest.tangent).abs() <= rounding.max(1e-9 * nearest.left.abs());
        if !square || nearest.tangent.dot(&direction).abs() < ALONGSIDE {
            return None;
        }
        most = most.max(nearest.left.abs());
    }
    if segment.bulge == 0.0 {
        let along = segment.start_tangent();
        let normal = Vector2::new(-along.y, along.x);
        let offset = segment.start.dot(&normal);
        let (high, low) = (piece.farthest(normal) - offset, -piece.farthest(-normal) - offset);
        return Some(most.max(high.abs()).max(low.abs()));
    }
    let (centre, radius) = (segment.centre(), segment.radius().abs());
    if piece.bulge == 0.0 {
        let least = piece.nearest(centre).left.abs();
        return Some(most.max((radius - least).abs()));
    }
    // Two circles are parallel on the line through their centres.
    let between = piece.centre() - centre;
    if between.norm() > rounding {
        let across = between.normalize() * piece.radius().abs();
        for place in [piece.centre() + across, piece.centre() - across] {
            let on_piece = (piece.end - piece.start).perp(&(place - piece.start)) * piece.bulge < 0.0;
            if on_piece {
                most = most.max(((place - centre).norm() - radius).abs());
            }
        }
    }
    Some(most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Vertex;

    fn at(x: f64, y: f64, bulge: f64) -> Vertex {
        Vertex::new(Vector2::new(x, y), bulge)
    }

    fn sampled(chain: &Contour, from: &Contour) -> f64 {
        let places = chain.edges().flat_map(|s| (0..=2_000).map(move |i| s.point_and_tangent(f64::from(i) / 2e3).0));
        let nearest = |p| from.edges().map(|s| s.nearest(p).left.abs()).fold(f64::INFINITY, f64::min);
        places.map(nearest).fold(0.0, f64::max)
    }

    #[test]
    fn distances_are_those_of_many_points() {
        let slot =
            Contour { vertices: vec![at(0.0, -1.0, 0.0), at(4.0, -1.0, 1.0), at(4.0, 1.0, -0.2), at(0.0, 1.0, 1.0)] };
        let square = Contour {
            vertices: vec![at(-1.0, -1.0, 0.0), at(5.0, -1.2, 0.01), at(5.0, 1.0, 0.0), at(-1.0, 1.0, -1e-4)],
        };
        let circle = Contour::circle(Vector2::new(2.0, 0.1), 2.5);
        let moved = Contour::circle(Vector2::new(2.003, 0.1), 2.5);
        for (a, b) in [(&slot, &square), (&square, &slot), (&slot, &circle), (&circle, &slot), (&moved, &circle)] {
            let (exact, many) = (farthest_place(a, b, 1e-9).distance, sampled(a, b));
            // The points lie at most 2e-3 apart, and a distance grows by no more than the travel.
            assert!(exact >= many - 1e-12 && exact <= many + 2e-3, "{exact} {many}");
        }
        let off = farthest_place(&moved, &circle, 1e-12);
        assert!((off.distance - 0.003).abs() < 1e-8, "{off:?}");
        assert!(farthest_place(&circle, &circle, 1e-12).distance < 1e-12);
        // A spike on one side only.
        let spiked =
            Contour { vertices: vec![at(4.5, 0.1, 1.0), at(-0.5, 0.1, 0.99), at(4.49, 0.0, 0.0), at(0.0, 0.05, 0.0)] };
        assert!(
            farthest_place(&circle, &spiked, 1e-9).distance < 0.1
                && farthest_place(&spiked, &circle, 1e-9).distance > 0.4
        );
    }

    /// An arc of radius 9 about (1.05, 0) alongside one of radius 10 about (0, 0) reaches 0.05 beyond it, on the x axis; both moved.
    #[test]
    fn an_arc_is_farthest_from_an_arc_on_the_line_of_their_centres() {
        let arc = |x: f64, radius: f64, half: f64| {
            let end = Vector2::new(radius * libm::cos(half), radius * libm::sin(half));
            let middle = Vector2::new(3.0 + x, -2.0);
            Segment { start: middle + Vector2::new(end.x, -end.y), end: middle + end, bulge: libm::tan(0.5 * half) }
        };
        let turned = |s: Segment| Segment { start: s.end, end: s.start, bulge: -s.bulge };
        for (x, radius, apart) in [(1.05, 9.0, 0.05), (0.95, 9.0, -0.05)] {
            let (piece, along) = (arc(x, radius, 0.2), arc(0.0, 10.0, 0.6));
            let ends = (((piece.end - Vector2::new(3.0, -2.0)).norm() - 10.0).abs()).max(f64::abs(apart));
            for piece in [piece, turned(piece)] {
                let found = alongside(&piece, &along, 1e-9).expect("alongside");
                assert!((found - ends).abs() < 1e-12, "{found} {ends}");
            }
        }
        assert_eq!(alongside(&arc(1.05, 9.0, 0.3), &arc(0.0, 10.0, 0.6), 1e-9), None, "too wide");
    }
}
