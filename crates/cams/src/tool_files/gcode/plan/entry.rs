//! How the cutter reaches the depth of a pass without going straight down into metal: outside the blank, or down a ramp.

use super::super::blank::Blank;
use camgen_kernel::geometry::blocks::Grid;
use camgen_kernel::geometry::contour::Segment;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Slope of a ramp, rad: 3°, in the middle of the 2° to 5° that end mills take in steel.
const SLOPE: f64 = 3.0 * std::f64::consts::PI / 180.0;
/// Height above the metal at which a ramp begins, mm.
const ABOVE: f64 = 0.5;
/// Distance of the cutter's edge from the blank where it goes down, mm.
pub(super) const OFF_THE_BLANK: f64 = 1.0;
/// Directions that are tried for the way from outside the blank.
const DIRECTIONS: u32 = 24;

/// How the cutter reaches the depth of a pass.
#[derive(Debug, Clone, PartialEq)]
pub enum Entry {
    /// Straight down where the pass starts.
    Plunge,
    /// Straight down at this point, outside the blank, and level to the start of the pass.
    Outside(Vector2<f64>),
    /// Down a ramp along this closed chain of lines, mm, which begins and ends at the start of the pass.
    Ramp {
        /// The corners.
        lap: Vec<Vector2<f64>>,
        /// Whether only whole laps are run: the chain is not the path of the pass, which is cut already at the depth before.
        whole: bool,
    },
}

/// The way of the cutter from the clearance height to the start of a pass.
#[derive(Debug, Clone, PartialEq)]
pub struct Descent {
    /// Where it comes down, mm.
    pub at: Vector2<f64>,
    /// Z down to which it goes straight, mm.
    pub z: f64,
    /// The corners of the ramp from there, mm.
    pub ramp: Vec<(Vector2<f64>, f64)>,
    /// Whether it then goes level to the start of the pass.
    pub is_away: bool,
}

impl Entry {
    /// The way to a pass that starts at a point, from a depth that is cut there already to another, mm.
    #[must_use]
    pub fn descent(&self, start: Vector2<f64>, (before, depth): (f64, f64), grid: Grid) -> Descent {
        let straight = |at: Vector2<f64>| Descent { at, z: -depth, ramp: Vec::new(), is_away: at != start };
        match self {
            Self::Plunge => straight(start),
            Self::Outside(from) => straight(*from),
            Self::Ramp { lap, whole } => {
                sloping((lap, *whole), (ABOVE - before, -depth), grid).unwrap_or_else(|| straight(start))
            }
        }
    }
}

/// A ramp between two Z along the end of so many laps of a chain as it needs.
fn sloping((lap, whole): (&[Vector2<f64>], bool), (from, to): (f64, f64), grid: Grid) -> Option<Descent> {
    let wanted = (from - to) / libm::tan(SLOPE);
    let length: f64 = lap.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    if !(length > 0.0 && wanted.is_finite()) {
        return None;
    }
    // From the end backwards, corner by corner; its first is its last.
    let mut corners = vec![(*lap.last()?, 0.0)];
    let mut gone = 0.0;
    while gone < wanted {
        for pair in lap.windows(2).rev() {
            gone += (pair[1] - pair[0]).norm();
            corners.push((pair[0], gone));
            if gone >= wanted && !whole {
                break;
            }
        }
    }
    let z = |left: f64| grid.nearest(to + (from - to) * left / gone);
    let mut ramp: Vec<(Vector2<f64>, f64)> = corners.into_iter().rev().map(|(at, left)| (at, z(left))).collect();
    let (at, z) = ramp.remove(0);
    Some(Descent { at, z, ramp, is_away: false })
}

/// The point outside a blank at which a cutter of a radius goes down: straight back from the start of a way if that is free, else in the nearest direction that
/// is.
pub(super) fn outside(
    blank: &Blank,
    (start, back): (Vector2<f64>, Vector2<f64>),
    radius: f64,
    is_free: impl Fn(&Segment) -> bool,
) -> Option<Vector2<f64>> {
    let turned = (0..DIRECTIONS).map(|index| {
        // 0, 1, −1, 2, −2 … steps.
        let steps = f64::from(index.div_ceil(2)) * if index % 2 == 0 { -1.0 } else { 1.0 };
        let (sin, cos) = libm::sincos(steps * TAU / f64::from(DIRECTIONS));
        Vector2::new(cos * back.x - sin * back.y, sin * back.x + cos * back.y)
    });
    let mut ways = turned.filter_map(|direction| blank.way_out(start, direction, radius + OFF_THE_BLANK));
    ways.find(is_free).map(|way| way.start)
}

/// The corners of a chain of lines within a distance of a chain of edges, mm, on the grid; from its start to its end.
pub(super) fn chords(edges: &[Segment], within: f64, grid: Grid) -> Vec<Vector2<f64>> {
    let mut corners: Vec<Vector2<f64>> = edges.first().map(|edge| grid.point(edge.start)).into_iter().collect();
    for edge in edges {
        // The sagitta R (1 − cos a) of a chord that subtends 2a is `within` at a = 2 asin √(within / 2R).
        let half = 2.0 * libm::asin((0.5 * within / edge.radius().abs()).sqrt().min(1.0));
        let count = if edge.bulge == 0.0 { 1.0 } else { (0.5 * edge.sweep().abs() / half).ceil().max(1.0) };
        let mut step = 1.0;
        while step <= count {
            let at = if step < count { edge.point_and_tangent(step / count).0 } else { edge.end };
            let at = grid.point(at);
            if corners.last() != Some(&at) {
                corners.push(at);
            }
            step += 1.0;
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::geometry::contour::Contour;

    #[test]
    fn ramps_go_down_by_their_slope_and_end_at_the_start() {
        let grid = Grid::of_decimals(4);
        let circle = Contour::circle(Vector2::zeros(), 20.0).segments().expect("arcs");
        let lap = chords(&circle, 1e-3, grid);
        let start = lap[0];
        for (before, depth, whole) in [(0.0, 2.0, false), (0.0, 15.0, false), (4.0, 8.0, true), (8.0, 8.0, false)] {
            let descent = Entry::Ramp { lap: lap.clone(), whole }.descent(start, (before, depth), grid);
            assert!((descent.z - (ABOVE - before)).abs() < 1e-9, "{}", descent.z);
            assert_eq!(descent.ramp.last(), Some(&(start, -depth)));
            assert!(!whole || descent.at == start);
            let mut from = (descent.at, descent.z);
            for to in &descent.ramp {
                let slope = (from.1 - to.1) / (to.0 - from.0).norm();
                assert!(slope <= libm::tan(SLOPE) * 1.01 && slope > 0.0, "{slope}");
                from = *to;
            }
        }
    }

    #[test]
    fn chords_keep_to_their_arc() {
        let circle = Contour::circle(Vector2::zeros(), 20.0).segments().expect("arcs");
        let corners = chords(&circle, 2e-3, Grid::of_decimals(5));
        let off = |pair: &[Vector2<f64>]| 20.0 - (0.5 * (pair[0] + pair[1])).norm();
        let worst = corners.windows(2).map(off).fold(0.0, f64::max);
        assert!((1e-3..2.1e-3).contains(&worst), "{worst} of {}", corners.len());
        assert_eq!(corners.first(), corners.last());
    }
}
