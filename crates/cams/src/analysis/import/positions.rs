//! Positions of a follower over a turn or lobe, as they were imported: from a table, rolled on an outline, or from measured points.

use camgen_kernel::motion::Quantity;
use camgen_kernel::numeric::outlier::{self, Sensitivity};
use camgen_kernel::numeric::scatter::{self, OF_MEDIAN, median};
use std::collections::VecDeque;

/// Fewest positions in which a motion is looked for.
pub(super) const FEWEST: usize = 8;
/// Least distance of an outlier from the curve of its neighbours / requested deviation.
const OF_DEVIATION: f64 = 3.0;
/// Equal positions farther apart than this multiple of the usual spacing are a dwell.
const OF_DWELL: f64 = 1.5;
/// What nineteen of twenty stay below, over the standard deviation; and by how much the noise may differ.
const OF_MOST: f64 = 1.96;
const MOST_UNEVEN: f64 = 2.0;

/// Positions by the cam angle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Positions {
    pub(super) quantity: Quantity,
    /// What they fill: a turn or a lobe, rad.
    pub(super) fill: f64,
    /// Cam angles, rad, growing within one filling.
    pub(super) angles: Vec<f64>,
    /// m or rad.
    pub(super) values: Vec<f64>,
    /// By how much each grows where the centre is shifted by 1 m along either axis; empty where the centre is known.
    pub(super) by_shift: Vec<[f64; 2]>,
    /// Number of the row or point of each.
    pub(super) rows: Vec<usize>,
}

impl Positions {
    pub(super) fn len(&self) -> usize {
        self.angles.len()
    }

    /// Cam angle of a position, counted on over any number of fillings.
    pub(super) fn angle(&self, at: usize) -> f64 {
        let count = self.len().max(1);
        #[expect(clippy::cast_precision_loss, reason = "few fillings")]
        let turns = (at / count) as f64;
        self.angles.get(at % count).copied().unwrap_or(0.0) + self.fill * turns
    }

    pub(super) fn value(&self, at: usize) -> f64 {
        self.values.get(at % self.len().max(1)).copied().unwrap_or(0.0)
    }

    /// Lowest and highest.
    pub(super) fn range(&self) -> (f64, f64) {
        self.values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
    }

    /// The usual angle from one to the next.
    pub(super) fn spacing(&self) -> f64 {
        let mut all: Vec<f64> = (0..self.len()).map(|at| self.angle(at + 1) - self.angle(at)).collect();
        median(&mut all)
    }

    /// The widest gap in which the follower moves, as its first and last angle.
    pub(super) fn widest_gap(&self) -> (f64, f64) {
        let gaps = (0..self.len()).map(|at| (self.angle(at), self.angle(at + 1)));
        gaps.fold((0.0, 0.0), |widest, gap| if gap.1 - gap.0 > widest.1 - widest.0 { gap } else { widest })
    }

    /// Standard deviation of the noise of single positions: what a cubic through four neighbours leaves of the one in their middle. Positions that
    /// rest exactly show none.
    pub(super) fn noise(&self) -> f64 {
        let mut all: Vec<f64> =
            (0..self.len()).filter_map(|at| self.off_neighbours(at, &[0, 1, 3, 4], 2)).map(f64::abs).collect();
        all.retain(|off| *off > 0.0);
        let middle = OF_MEDIAN * median(&mut all);
        // Where the noise differs from place to place, as where a follower meets the profile at an angle, the larger one counts.
        middle.max(all.get(all.len() * 19 / 20).map_or(0.0, |off| off / OF_MOST).min(MOST_UNEVEN * middle))
    }

    /// How far a position is from the cubic through four others near it, over what noise of one unit makes of that.
    fn off_neighbours(&self, first: usize, others: &[usize; 4], own: usize) -> Option<f64> {
        let count = self.len();
        if count <= others[3].max(own) {
            return None;
        }
        let place = |at: usize| (self.angle(first + at), self.value(first + at));
        scatter::off_neighbours(place(own), &others.map(place))
    }

    /// The worst outlier, if beyond its neighbours' scatter and the deviation: its index and distance.
    pub(super) fn outlier(&self, deviation: f64, (rounding, sensitivity): (f64, Sensitivity)) -> Option<(usize, f64)> {
        let first = self.angles.iter().copied().zip(self.values.iter().copied());
        let closing = self.angles.first().zip(self.values.first()).map(|(at, value)| (at + self.fill, *value));
        let rows: Vec<(f64, f64)> = first.chain(closing).collect();
        // Dwells given only by their ends.
        let wide = OF_DWELL * self.spacing();
        let rests: Vec<bool> =
            rows.iter().zip(rows.iter().skip(1)).map(|(a, b)| a.1 == b.1 && b.0 - a.0 > wide).collect();
        let worst = outlier::worst(&outlier::ring(&rows, &rests, self.fill), rounding, sensitivity)?;
        (worst.is_wrong() && worst.off.abs() > OF_DEVIATION * deviation).then_some((worst.row, worst.off.abs()))
    }

    /// The longest run from each position on that stays within a band, as its last index; a run is left out where the one before it ends there too.
    pub(super) fn flat_runs(&self, band: f64) -> Vec<(usize, usize)> {
        let count = self.len();
        let (mut low, mut high): (VecDeque<usize>, VecDeque<usize>) = (VecDeque::new(), VecDeque::new());
        let (mut end, mut last, mut found) = (0, 0, Vec::new());
        for first in 0..count {
            while low.front().is_some_and(|at| *at < first) {
                low.pop_front();
            }
            while high.front().is_some_and(|at| *at < first) {
                high.pop_front();
            }
            while end < first + count {
                let next = self.value(end);
                let least = low.front().map_or(next, |at| self.value(*at).min(next));
                let most = high.front().map_or(next, |at| self.value(*at).max(next));
                if most - least > band {
                    break;
                }
                while low.back().is_some_and(|at| self.value(*at) >= next) {
                    low.pop_back();
                }
                while high.back().is_some_and(|at| self.value(*at) <= next) {
                    high.pop_back();
                }
                low.push_back(end);
                high.push_back(end);
                end += 1;
            }
            if end > last && end > first + 1 {
                found.push((first, end - 1));
                last = end;
            }
        }
        found
    }
}
