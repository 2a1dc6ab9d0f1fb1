//! The search for the largest value of something over the surface: on a grid of cam angles and places along the axis, then
//! within the cells about every local maximum that could be the largest.
//!
//! The lifts of the sections at an angle depend neither on the place along the axis nor on the prime radius: they are
//! computed once for each angle of the grid.

use super::{AllStrips, Conoid, Partials, Strips};
use camgen_kernel::numeric::{extremum, parallel};
use camgen_kernel::profile::Worst;

/// Cells a piece of the motion is cut into: what is searched has a hump or two in it.
const CELLS: u32 = 48;
/// Golden sections in either direction about a local maximum: they shrink a cell to 2e-4 of its width, and a smooth maximum
/// is missed by the square of that.
const SECTIONS: u32 = 18;
/// How often the cell is moved when its largest value lies on its edge.
const MOVES: usize = 16;

/// A place of the pitch surface: where the centre of the roller may be.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePlace<'a> {
    /// Index of the piece of the motion.
    pub piece: usize,
    /// Cam angle, rad.
    pub angle: f64,
    /// Place along the axis, m.
    pub z: f64,
    /// Lift and its derivatives there.
    pub partials: Partials,
    /// Lifts of the sections at the angle.
    pub(super) lifts: &'a dyn Strips,
}

/// A cam angle of the grid.
#[derive(Debug, Clone)]
pub(super) struct GridAngle {
    piece: usize,
    angle: f64,
    lifts: AllStrips,
}

/// A local maximum of the grid.
struct Peak {
    node: usize,
    slice: usize,
    value: f64,
    /// Its height above the lowest of its neighbours: a smooth maximum of the cells about it lies less than that above it.
    drop: f64,
}

impl Conoid {
    /// The angles of the grid, piece by piece.
    pub(super) fn nodes(&self) -> Vec<GridAngle> {
        let of_piece = |(piece, span): (usize, &camgen_kernel::motion::Piece)| {
            let span = *span;
            // The lift of a dwell is the same at all its angles.
            let cells = if span.dwell { 0 } else { CELLS };
            let angle = move |i: u32| {
                let share = if cells == 0 { 0.0 } else { f64::from(i) / f64::from(cells) };
                if i == cells && cells > 0 { span.end } else { span.start + (span.end - span.start) * share }
            };
            (0..=cells).map(move |i| (piece, angle(i)))
        };
        let places: Vec<(usize, f64)> = self.pieces().iter().enumerate().flat_map(of_piece).collect();
        parallel::map(&places, |&(piece, angle)| GridAngle { piece, angle, lifts: self.all_lifts(piece, angle) })
    }

    /// The largest value of something between the first and the last of these places along the axis, rising; where it is
    /// smooth between them, to seven digits.
    pub(super) fn worst_over(&self, slices: &[f64], value: impl Fn(&Self, &SurfacePlace<'_>) -> f64 + Sync) -> Worst {
        let nodes = self.found.nodes.get_or_init(|| self.nodes());
        let in_slice = |z: &f64| -> Vec<f64> {
            let at = |node: &GridAngle| {
                let partials = self.lift_of(&node.lifts, *z);
                value(self, &SurfacePlace { piece: node.piece, angle: node.angle, z: *z, partials, lifts: &node.lifts })
            };
            nodes.iter().map(at).collect()
        };
        let values: Vec<Vec<f64>> = parallel::map(slices, in_slice);
        let peaks = peaks(nodes, &values);
        let sampled = |peak: &Peak| {
            let (angle, z) = (nodes.get(peak.node).map_or(0.0, |node| node.angle), slices.get(peak.slice).copied());
            Worst { value: peak.value, at: angle, z: z.unwrap_or(0.0) }
        };
        let best = peaks.iter().map(sampled).fold(Worst::NONE, Worst::or_larger);
        // Where the surface folds there is nothing larger.
        if !best.value.is_finite() {
            return best;
        }
        let could_be = |peak: &&Peak| peak.drop > 0.0 && peak.value + peak.drop >= best.value;
        let candidates: Vec<&Peak> = peaks.iter().filter(could_be).collect();
        let refined = parallel::map(&candidates, |peak| {
            let piece = nodes.get(peak.node).map_or(0, |node| node.piece);
            self.refined(piece, sampled(peak), slices, peak.slice, &value)
        });
        refined.into_iter().fold(best, Worst::or_larger)
    }

    /// The largest value in the cells about a place of the grid, which follow it where it lies on their edge.
    fn refined(
        &self,
        piece: usize,
        from: Worst,
        slices: &[f64],
        slice: usize,
        value: &(impl Fn(&Self, &SurfacePlace<'_>) -> f64 + Sync),
    ) -> Worst {
        let Some(span) = self.pieces().get(piece) else { return from };
        let (least, most) = (slices.first().copied().unwrap_or(from.z), slices.last().copied().unwrap_or(from.z));
        let below = slices.get(slice.saturating_sub(1)).copied().unwrap_or(from.z);
        let above = slices.get(slice + 1).copied().unwrap_or(from.z);
        let (width, height) = ((span.end - span.start) / f64::from(CELLS), (from.z - below).max(above - from.z));
        let mut best = from;
        for _ in 0..MOVES {
            let (low, high) = ((best.z - height).max(least), (best.z + height).min(most));
            let along_axis = |angle: f64| {
                let lifts = self.lifts(piece, angle);
                let at = |z: f64| {
                    let partials = self.lift_of(&lifts, z);
                    value(self, &SurfacePlace { piece, angle, z, partials, lifts: &lifts })
                };
                extremum::largest_without_slope(at, (low, high), 2, if low < high { SECTIONS } else { 0 })
            };
            let range = if span.dwell {
                (span.start, span.start)
            } else {
                ((best.at - width).max(span.start), (best.at + width).min(span.end))
            };
            let sections = if span.dwell { 0 } else { SECTIONS };
            let found = extremum::largest_without_slope(|angle| along_axis(angle).value, range, 2, sections);
            let next = Worst { value: found.value, at: found.at, z: along_axis(found.at).at };
            let moved = next.value > best.value;
            let edge = |at: f64, (a, b): (f64, f64), (first, last): (f64, f64)| {
                let near = 1e-2 * (b - a);
                (at - a < near && a > first) || (b - at < near && b < last)
            };
            let on_edge = edge(next.at, range, (span.start, span.end)) || edge(next.z, (low, high), (least, most));
            best = best.or_larger(next);
            if !(moved && on_edge) {
                break;
            }
        }
        best
    }
}

/// The places of the grid that none of their neighbours exceeds; `values` by slice and node.
fn peaks(nodes: &[GridAngle], values: &[Vec<f64>]) -> Vec<Peak> {
    let mut peaks = Vec::new();
    for (slice, row) in values.iter().enumerate() {
        for (node, &value) in row.iter().enumerate() {
            let piece = |index: usize| nodes.get(index).map(|node| node.piece);
            let rows = values.iter().skip(slice.saturating_sub(1)).take(if slice == 0 { 2 } else { 3 });
            let around = rows.flat_map(|row| {
                let columns = row.iter().enumerate().skip(node.saturating_sub(1)).take(if node == 0 { 2 } else { 3 });
                columns.filter(|(index, _)| piece(*index) == piece(node)).map(|(_, value)| *value)
            });
            let (mut highest, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
            around.for_each(|value| (highest, least) = (highest.max(value), least.min(value)));
            if value >= highest {
                peaks.push(Peak { node, slice, value, drop: value - least });
            }
        }
    }
    peaks
}
