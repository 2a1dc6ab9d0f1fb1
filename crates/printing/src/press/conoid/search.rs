//! The search for the largest value of something over the surface: on a grid of cam angles and axial positions, then
//! within the cells about every local maximum that could be the largest.
//!
//! The lifts of the sections at an angle depend neither on the axial position nor on the prime radius: they are
//! computed once for each angle of the grid.

use super::{AllStrips, Conoid, Partials, Strips};
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::numeric::parallel;
use camgen_kernel::profile::Worst;

/// Cells a piece of the motion is cut into: what is searched has a hump or two in it.
const CELLS: u32 = 48;
/// Golden sections in either direction about a local maximum: they shrink a cell to 2e-4 of its width, and a smooth maximum
/// is missed by the square of that.
const SECTIONS: u32 = 18;
/// How often the cell is moved when its largest value lies on its edge.
const MOVES: usize = 16;

/// A point of the pitch surface: a possible centre of the roller.
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
    piece: usize,
    slice: usize,
    found: Worst,
    /// Its height above the lowest of its neighbours: a smooth maximum of the cells about it lies less than that above it.
    drop: f64,
}

impl Conoid {
    /// The angles of the grid, piece by piece.
    pub(super) fn nodes(&self) -> Vec<GridAngle> {
        let mut places = Vec::new();
        for (piece, span) in self.pieces().iter().enumerate() {
            places.push((piece, span.start));
            // The lift of a dwell is the same at all its angles.
            if span.dwell {
                continue;
            }
            for i in 1..CELLS {
                places.push((piece, span.start + (span.end - span.start) * (f64::from(i) / f64::from(CELLS))));
            }
            places.push((piece, span.end));
        }
        parallel::map(&places, |&(piece, angle)| GridAngle { piece, angle, lifts: self.all_lifts(piece, angle) })
    }

    /// The largest value of something between the first and the last of these axial positions, rising; where it is
    /// smooth between them, to seven digits.
    pub(super) fn worst_over(&self, slices: &[f64], value: impl Fn(&Self, &SurfacePlace<'_>) -> f64 + Sync) -> Worst {
        let nodes = self.found.nodes.get_or_init(|| self.nodes());
        let values: Vec<Vec<f64>> = parallel::map(slices, |z| {
            let mut row = Vec::with_capacity(nodes.len());
            for GridAngle { piece, angle, lifts } in nodes {
                let partials = self.lift_of(lifts, *z);
                row.push(value(self, &SurfacePlace { piece: *piece, angle: *angle, z: *z, partials, lifts }));
            }
            row
        });
        let peaks = peaks(nodes, slices, &values);
        let best = peaks.iter().map(|peak| peak.found).fold(Worst::NONE, Worst::or_larger);
        // Where the surface folds there is nothing larger.
        if !best.value.is_finite() {
            return best;
        }
        let could_be_largest =
            peaks.iter().filter(|peak| peak.drop > 0.0 && peak.found.value + peak.drop >= best.value);
        let candidates: Vec<&Peak> = could_be_largest.collect();
        let refined = parallel::map(&candidates, |peak| self.refined(peak, slices, &value));
        refined.into_iter().fold(best, Worst::or_larger)
    }

    /// The largest value in the cells about a grid point, which follow it where it lies on their edge.
    fn refined<F: Fn(&Self, &SurfacePlace<'_>) -> f64 + Sync>(&self, peak: &Peak, slices: &[f64], value: &F) -> Worst {
        let Peak { piece, slice, found: from, .. } = *peak;
        let Some(span) = self.pieces().get(piece) else { return from };
        let axis =
            Stretch { low: slices.first().copied().unwrap_or(from.z), high: slices.last().copied().unwrap_or(from.z) };
        let turn = Stretch { low: span.start, high: if span.dwell { span.start } else { span.end } };
        let below = slices.get(slice.saturating_sub(1)).copied().unwrap_or(from.z);
        let above = slices.get(slice + 1).copied().unwrap_or(from.z);
        let (width, height) = ((span.end - span.start) / f64::from(CELLS), (from.z - below).max(above - from.z));
        let mut best = from;
        for _ in 0..MOVES {
            let strip = axis.around(best.z, height);
            let cell = if span.dwell { turn } else { turn.around(best.at, width) };
            let found = extremum::largest_without_slope(
                |angle| self.largest_along_axis(piece, angle, strip, value).value,
                (cell.low, cell.high),
                2,
                if span.dwell { 0 } else { SECTIONS },
            );
            let z = self.largest_along_axis(piece, found.at, strip, value).at;
            let next = Worst { value: found.value, at: found.at, z };
            let moved = next.value > best.value;
            let on_edge = cell.has_on_edge(next.at, turn) || strip.has_on_edge(next.z, axis);
            best = best.or_larger(next);
            if !(moved && on_edge) {
                break;
            }
        }
        best
    }

    /// The largest value in a strip of the axis at a cam angle.
    fn largest_along_axis<F: Fn(&Self, &SurfacePlace<'_>) -> f64 + Sync>(
        &self,
        piece: usize,
        angle: f64,
        strip: Stretch,
        value: &F,
    ) -> Extremum {
        let lifts = self.lifts(piece, angle);
        extremum::largest_without_slope(
            |z| value(self, &SurfacePlace { piece, angle, z, partials: self.lift_of(&lifts, z), lifts: &lifts }),
            (strip.low, strip.high),
            2,
            if strip.low < strip.high { SECTIONS } else { 0 },
        )
    }
}

/// A stretch of cam angles or of the axis.
#[derive(Clone, Copy)]
struct Stretch {
    low: f64,
    high: f64,
}

impl Stretch {
    /// The part within a distance of a point.
    fn around(self, middle: f64, distance: f64) -> Self {
        Self { low: (middle - distance).max(self.low), high: (middle + distance).min(self.high) }
    }

    /// Whether a point is near an edge that is not one of the whole.
    fn has_on_edge(self, at: f64, whole: Self) -> bool {
        let near = 1e-2 * (self.high - self.low);
        (at - self.low < near && self.low > whole.low) || (self.high - at < near && self.high < whole.high)
    }
}

/// The grid points that none of their neighbours exceeds; `values` by slice and node.
fn peaks(nodes: &[GridAngle], slices: &[f64], values: &[Vec<f64>]) -> Vec<Peak> {
    let mut peaks = Vec::new();
    for (slice, (z, row)) in slices.iter().zip(values).enumerate() {
        for (node, (here, &value)) in nodes.iter().zip(row).enumerate() {
            let rows = values.iter().skip(slice.saturating_sub(1)).take(if slice == 0 { 2 } else { 3 });
            let around = rows.flat_map(|row| {
                let columns = row.iter().enumerate().skip(node.saturating_sub(1)).take(if node == 0 { 2 } else { 3 });
                let same_piece = columns.filter(|(index, _)| nodes.get(*index).is_some_and(|n| n.piece == here.piece));
                same_piece.map(|(_, value)| *value)
            });
            let (mut highest, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
            around.for_each(|value| (highest, least) = (highest.max(value), least.min(value)));
            if value >= highest {
                let found = Worst { value, at: here.angle, z: *z };
                peaks.push(Peak { piece: here.piece, slice, found, drop: value - least });
            }
        }
    }
    peaks
}
