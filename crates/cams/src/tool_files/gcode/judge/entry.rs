//! Whether the cutter reaches its depth without going straight down into metal: outside the blank, down a ramp, or where it has cut before.

use super::super::blank::Blank;
use super::super::read::{CutterMove, MoveKind};
use super::cutting::SAME_DEPTH;
use super::program::ProgramFault;
use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::text::{Text, text};

/// Steepest ramp: tan 5.1°, the 5° that end mills take in steel, with the rounding of its ends.
const STEEPEST: f64 = 0.0893;
/// Distance from an earlier pass within which a point is cut already, mm.
const SAME_PATH: f64 = 0.02;
/// Rounding of a point on the edge of the blank, mm.
const ROUNDED: f64 = 1e-3;

/// Whether a move is a ramp: straight, down and forward at a feed.
pub(super) fn is_ramp(moved: &CutterMove) -> bool {
    let goes_down = moved.to[2] < moved.from[2] && !moved.is_upright();
    goes_down && moved.kind == MoveKind::Line
}

/// Refuses a ramp that is too steep for a cutter which does not cut at its centre.
pub(super) fn not_too_steep(moved: &CutterMove) -> Result<(), ProgramFault> {
    let (down, along) = (moved.from[2] - moved.to[2], (moved.end() - moved.start()).norm());
    if down <= STEEPEST * along + 2.0 * SAME_DEPTH {
        return Ok(());
    }
    let degrees = libm::atan2(down, along).to_degrees();
    let why = format!("the ramp in line {} goes down by {degrees:.1} deg; at most 5 deg are cut", moved.line);
    Err(ProgramFault::new(why))
}

/// Level stretches that were cut so far: depth in mm, and their edges.
#[derive(Default)]
struct CutSoFar {
    stretches: Vec<(f64, EdgeTree)>,
    open: Vec<Edge>,
    depth: f64,
}

impl CutSoFar {
    fn adds(&mut self, moved: &CutterMove) {
        if self.depth != -moved.to[2] {
            self.closes();
        }
        self.depth = -moved.to[2];
        self.open.extend(moved.segments().into_iter().map(Edge::Segment));
    }

    fn closes(&mut self) {
        if !self.open.is_empty() {
            self.stretches.push((self.depth, EdgeTree::along(std::mem::take(&mut self.open))));
        }
    }

    /// Whether the cutter ran through the upper end of a plunge at its depth or below.
    fn holds(&self, moved: &CutterMove) -> bool {
        let near = |tree: &EdgeTree| {
            tree.nearest(moved.end()).is_some_and(|nearest| (nearest.foot - moved.end()).norm() <= SAME_PATH)
        };
        self.stretches.iter().any(|(depth, tree)| *depth >= -moved.to[2] - SAME_DEPTH && near(tree))
    }
}

/// The first move that goes straight down into the metal of a blank, with a cutter of a radius, mm; without a blank all that was not cut is metal.
pub(super) fn plunge<'m>(moves: &'m [CutterMove], blank: Option<&Blank>, radius: f64) -> Option<&'m CutterMove> {
    let mut cut = CutSoFar::default();
    for moved in moves {
        let cuts = moved.to[2] < -SAME_DEPTH && moved.kind != MoveKind::Rapid;
        if cuts && moved.is_level() && !moved.is_upright() {
            cut.adds(moved);
            continue;
        }
        cut.closes();
        let goes_down = cuts && moved.is_upright() && moved.to[2] < moved.from[2];
        let is_outside = || blank.is_some_and(|blank| blank.outside(moved.end()) >= radius - ROUNDED);
        if goes_down && !is_outside() && !cut.holds(moved) {
            return Some(moved);
        }
    }
    None
}

/// A plunge into metal: a fault where the blank is known, else for a note.
pub(super) fn of_plunge(
    moves: &[CutterMove],
    blank: Option<&Blank>,
    (radius, is_known): (f64, bool),
) -> Result<Text, ProgramFault> {
    let Some(moved) = plunge(moves, blank, radius) else { return Ok(Text::default()) };
    if !is_known {
        let line = moved.line;
        return Ok(text!("; line {} goes straight down into metal, unless the blank ends or is drilled there", line));
    }
    let why = format!(
        "line {} goes straight down into the metal of the blank: come down outside it or on a ramp, or give cut.entry = \"plunge\"",
        moved.line
    );
    Err(ProgramFault { why, value: f64::INFINITY, at: Some(moved.end()) })
}
