//! The nodes of a curve through rows, or near them, and the figures of it; of a whole turn and of a segment alike.

use super::{OF_DWELL, RowFigures, RowNoise, RowOutlier, RowShape, RowWishes, Smoothing};
use crate::motion::laws::spline;
use crate::numeric::bounded_jerk::{self, Given, NotMonotonic, STAYS};
use crate::numeric::extremum;
use crate::numeric::least_jerk::{NodeConstraint, NodeInterval, least_jerk};
use crate::numeric::outlier::{self, Sensitivity};
use crate::numeric::scatter::scatter;

/// Cells in which the extremes of a quintic are separated.
const CELLS: u32 = 8;
/// Fewest rows in which rounding is looked for.
const FEWEST_OF_ROUNDED: usize = 24;
/// A step or a scatter above this share of the lift is a choice of numbers, not an error.
const MOST_OF_ROUNDED: f64 = 0.02;
/// Rounding by half a step makes the second difference of rows wrong by up to two steps; below this share of the largest acceleration
/// nothing is compared.
const MATTERS: f64 = 0.05;
/// Scatter is seen above this many steps of the rounding, which itself scatters by 0.29 of them where rows are far apart, by 0.78 of them on a
/// straight line of half a step a row.
const OF_ROUNDING: f64 = 0.8;
/// All but one in two thousand rows are within so many standard deviations.
const OF_SCATTER: f64 = 3.5;
/// Equal rows that scatter are a dwell where they fill more than so many usual spacings: fewer are equal by chance.
const OF_DWELL_THAT_SCATTERS: f64 = 8.0;
/// Rows of the next turn with which those at the end of one have neighbours.
const AROUND: usize = 6;
/// A rise that begins with a continuous acceleration grows with the third power of the angle: it is this many steps high at twice the
/// angle at which it is one.
const CUBED: f64 = 8.0;

/// Rows on shares of a turn or a segment, from 0 to 1.
pub(super) struct RowRun<'a> {
    pub(super) knots: &'a [f64],
    /// Positions, as many as knots.
    pub(super) values: &'a [f64],
    /// Whether an interval rests, one fewer than knots.
    pub(super) dwells: Vec<bool>,
    /// Velocity and acceleration at both ends of a segment, where they are given; `None` of a turn, whose last row is its first.
    pub(super) ends: Option<[NodeConstraint; 2]>,
    /// The usual interval, a share.
    pub(super) spacing: f64,
    /// The step to which the values are rounded; 0 where none is seen.
    pub(super) rounding: f64,
}

/// Value, velocity and acceleration at the nodes, by the share.
#[derive(Debug, Clone)]
pub(super) struct Nodes {
    pub(super) values: Vec<f64>,
    /// As many as values.
    pub(super) states: Vec<[f64; 2]>,
    pub(super) dwells: Vec<bool>,
}

impl Nodes {
    /// Value of a node, and its velocity and acceleration.
    pub(super) fn node(&self, index: usize) -> (f64, [f64; 2]) {
        let state = self.states.get(index).copied().unwrap_or_default();
        (self.values.get(index).copied().unwrap_or(0.0), state)
    }

    pub(super) fn largest_acceleration(&self) -> f64 {
        self.states.iter().map(|state| state[1].abs()).fold(0.0, f64::max)
    }

    /// Value, velocity and acceleration of each.
    pub(super) fn jets(&self) -> Vec<[f64; 3]> {
        self.values.iter().zip(&self.states).map(|(value, [v, a])| [*value, *v, *a]).collect()
    }
}

impl RowRun<'_> {
    /// The nodes through or near the rows.
    ///
    /// # Errors
    /// The interval on which no monotonic curve has the state that is given at an end.
    pub(super) fn nodes(&self, shape: RowShape, smooth: f64) -> Result<Nodes, NotMonotonic> {
        let (mut values, mut dwells) = (self.values.to_vec(), self.dwells.clone());
        if smooth > 0.0 {
            self.pin(smooth, &mut dwells);
        }
        let ring = self.intervals(&values);
        let mut given = self.given(&dwells);
        let mut states: Vec<[f64; 2]> = if smooth > 0.0 {
            let found = bounded_jerk::smoothed(&ring, &given, smooth);
            for (value, [off, ..]) in values.iter_mut().zip(found.iter().chain(found.first())) {
                *value += off;
            }
            found.iter().map(|[_, v, a]| [*v, *a]).collect()
        } else if shape == RowShape::Natural {
            let given: Vec<NodeConstraint> = given.iter().map(|[_, v, a]| [*v, *a]).collect();
            least_jerk(&ring, &given)
        } else {
            Vec::new()
        };
        if shape == RowShape::Monotonic {
            let ring = self.intervals(&values);
            for given in &mut given {
                given[0] = STAYS;
            }
            states = bounded_jerk::monotonic(&ring, &given)?;
            for (dwell, interval) in dwells.iter_mut().zip(&ring) {
                *dwell |= interval.is_some_and(|(_, rise)| rise == 0.0);
            }
        }
        if self.ends.is_none() {
            states.extend(states.first().copied());
        }
        Ok(Nodes { values, states, dwells })
    }

    /// From node to node of a ring; the last node of a segment is not joined to its first.
    fn intervals(&self, values: &[f64]) -> Vec<NodeInterval> {
        let pairs = self.knots.iter().zip(self.knots.iter().skip(1)).zip(values.iter().zip(values.iter().skip(1)));
        let joined = pairs.map(|((x0, x1), (y0, y1))| Some((x1 - x0, y1 - y0)));
        joined.chain(self.ends.map(|_| None)).collect()
    }

    /// What is given of each node: those at either end of an interval that rests do so, and the ends of a segment stay.
    fn given(&self, dwells: &[bool]) -> Vec<Given> {
        // On a ring the last interval is before the first node.
        let before = if self.ends.is_none() { dwells.last().copied() } else { Some(false) };
        let before = before.into_iter().chain(dwells.iter().copied());
        let after = dwells.iter().copied().chain(self.ends.map(|_| false));
        let given = before.zip(after).map(
            |(before, after)| {
                if before || after { [STAYS, Some(0.0), Some(0.0)] } else { [None; 3] }
            },
        );
        let mut given: Vec<Given> = given.collect();
        let Some([first, last]) = self.ends else { return given };
        let end = given.len().saturating_sub(1);
        for (node, [v, a]) in [(0, first), (end, last)] {
            if let Some(given) = given.get_mut(node) {
                *given = [STAYS, v, a];
            }
        }
        given
    }

    /// Rows of one rounded value rest, but for what rounding hides of the motion at either end.
    ///
    /// What is hidden follows from where the motion has left the value by one step and by eight: as it grows with the third power, it began
    /// as far before the first of these places as the second lies behind it. A segment that begins or ends at rest does so behind its end.
    fn pin(&self, smooth: f64, dwells: &mut [bool]) {
        let (count, closed) = (dwells.len(), self.ends.is_none());
        let size = self.values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let turn = |at: usize| if closed { (at / count, at % count) } else { (0, at) };
        let value = |at: usize| self.values.get(turn(at).1).copied().unwrap_or(0.0);
        let place = |at: usize| {
            let (turns, at) = turn(at);
            self.knots.get(at).copied().unwrap_or(0.0) + f64::from(u32::try_from(turns).unwrap_or(0))
        };
        let flat: Vec<bool> = (0..count).map(|at| (value(at + 1) - value(at)).abs() <= 1e-12 * size).collect();
        let is_flat = |at: usize| flat.get(at % count).copied().unwrap_or(false);
        let first = if closed { (0..count).find(|at| !is_flat(*at)) } else { Some(0) };
        let Some(first) = first else { return };
        let rests = self.ends.map(|ends| ends.map(|end| end == [Some(0.0); 2]));
        let shortest = if self.scatter().is_some() { OF_DWELL_THAT_SCATTERS } else { OF_DWELL };
        let mut at = first;
        while at < first + count {
            if !is_flat(at) {
                at += 1;
                continue;
            }
            let end = (at..first + count).find(|at| !is_flat(*at)).unwrap_or(first + count);
            if place(end) - place(at) < shortest * self.spacing {
                at = end;
                continue;
            }
            // Outwards from either end of the run, how far behind it the motion begins; before it where that is negative.
            let begins = |outward: &dyn Fn(usize) -> Option<usize>, own: f64| {
                let steps = (1..count).map_while(|by| {
                    outward(by).map(|node| ((place(node) - own).abs(), (value(node) - value(at)).abs()))
                });
                hidden(steps, smooth)
            };
            let after = match rests {
                Some([_, rests]) if end == count => rests.then_some(0.0),
                Some(_) => begins(&|by| Some(end + by).filter(|node| *node <= count), place(end)),
                None => begins(&|by| Some(end + by), place(end)),
            };
            let before = match rests {
                Some([rests, _]) if at == 0 => rests.then_some(0.0),
                Some(_) => begins(&|by| at.checked_sub(by), place(at)),
                None => begins(&|by| (at + count).checked_sub(by), place(at + count)),
            };
            if let Some((before, after)) = before.zip(after) {
                let (from, to) = (place(at) + (-before).max(0.0), place(end) - (-after).max(0.0));
                for interval in at..end {
                    if let Some(dwell) = dwells.get_mut(interval % count)
                        && place(interval) >= from - 1e-12
                        && place(interval + 1) <= to + 1e-12
                    {
                        *dwell = true;
                    }
                }
            }
            at = end;
        }
    }

    /// Figures of the curve of some nodes, by the share.
    pub(super) fn figures(&self, found: &Nodes, wishes: RowWishes, told: &[String]) -> RowFigures {
        let count = if self.ends.is_none() { self.dwells.len() } else { self.knots.len() };
        let gaps = self.knots.iter().zip(self.knots.iter().skip(1)).zip(&found.dwells);
        let widest = gaps
            .clone()
            .filter(|(_, dwell)| !**dwell)
            .map(|((from, to), _)| (*from, *to))
            .max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
        let mut dwells: Vec<(f64, f64)> = Vec::new();
        for ((from, to), _) in gaps.filter(|(_, dwell)| **dwell) {
            match dwells.last_mut().filter(|(_, end)| end == from) {
                Some((_, end)) => *end = *to,
                None => dwells.push((*from, *to)),
            }
        }
        let smoothing = wishes.smooth.map(|bound| {
            let off: Vec<f64> =
                found.values.iter().zip(self.values).take(count).map(|(new, old)| (new - old).abs()).collect();
            let squares: f64 = off.iter().map(|off| off * off).sum();
            let rms = (squares / f64::from(u32::try_from(count.max(1)).unwrap_or(u32::MAX))).sqrt();
            Smoothing { bound, largest: off.iter().copied().fold(0.0, f64::max), rms }
        });
        RowFigures {
            segment: None,
            count,
            spacing: self.spacing,
            widest: widest.unwrap_or((0.0, 0.0)),
            dwells,
            overshoot: overshoot(self.knots, found),
            rounding: self.rounding,
            smoothing,
            noise: self.noise(found, wishes),
            outlier: self.outlier(),
            told: told.to_vec(),
        }
    }

    /// The row farthest off its neighbours, by its number among these rows.
    fn outlier(&self) -> Option<RowOutlier> {
        let rows: Vec<(f64, f64)> = self.knots.iter().copied().zip(self.values.iter().copied()).collect();
        let samples = match self.ends {
            None => outlier::ring(&rows, &self.dwells, 1.0),
            Some(ends) => {
                let chain = outlier::chain(&rows, &self.dwells);
                outlier::at_rest(chain, self.spacing, ends.map(|end| end == [Some(0.0); 2]))
            }
        };
        let worst = outlier::worst(&samples, self.rounding, Sensitivity::Fine)?;
        let at = self.knots.get(worst.row).copied().unwrap_or(0.0);
        Some(RowOutlier { row: worst.row + 1, line: None, at, off: worst.off, allowed: worst.allowed })
    }

    /// Largest accelerations as it is and with the errors of the rows smoothed, by the share, where that may matter.
    fn noise(&self, found: &Nodes, wishes: RowWishes) -> Option<RowNoise> {
        let (low, high) =
            self.values.iter().fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(*value), high.max(*value)));
        let largest = found.largest_acceleration();
        let scatter = self.scatter();
        let (error, smooth) =
            scatter.map_or((self.rounding, 0.5 * self.rounding), |sigma| (OF_SCATTER * sigma, OF_SCATTER * sigma));
        let looks = error > 0.0
            && error <= MOST_OF_ROUNDED * (high - low)
            && self.dwells.len() >= FEWEST_OF_ROUNDED
            && 2.0 * error / (self.spacing * self.spacing) > MATTERS * largest;
        // What is asked for may be too little for the scatter.
        let asked = wishes.smooth.is_some_and(|asked| scatter.is_none() || asked > 0.5 * smooth);
        if asked || wishes.cubic || !looks {
            return None;
        }
        let smoothed = self.nodes(wishes.shape, smooth).ok()?.largest_acceleration();
        Some(RowNoise { scatter, smooth, largest, smoothed })
    }

    /// Standard deviation of the scatter of the rows about a smooth curve, where it is more than that of their rounding.
    fn scatter(&self) -> Option<f64> {
        let count = if self.ends.is_none() { self.dwells.len() } else { self.knots.len() };
        let rows: Vec<(f64, f64)> = self.knots.iter().copied().zip(self.values.iter().copied()).take(count).collect();
        // Around the end of a turn once more.
        let again = rows.iter().filter(|_| self.ends.is_none()).take(AROUND).map(|(at, value)| (at + 1.0, *value));
        let around: Vec<(f64, f64)> = rows.iter().copied().chain(again).collect();
        scatter(&around).filter(|sigma| *sigma > OF_ROUNDING * self.rounding)
    }
}

/// How far behind the end of a run the motion begins: steps outwards are how far and how much off.
fn hidden(steps: impl Iterator<Item = (f64, f64)>, smooth: f64) -> Option<f64> {
    let mut before = (0.0, 0.0);
    let (mut one, mut eight) = (None, None);
    for (far, off) in steps {
        let [reaches_one, reaches_eight] = [2.0 * smooth, 2.0 * CUBED * smooth].map(|level| {
            (off >= level && off > before.1)
                .then(|| before.0 + (far - before.0) * (level - before.1).max(0.0) / (off - before.1))
        });
        one = one.or(reaches_one);
        eight = eight.or(reaches_eight);
        if eight.is_some() {
            break;
        }
        before = (far, off);
    }
    one.zip(eight).map(|(one, eight)| 2.0 * one - eight)
}

/// By how much the curve leaves the values at both ends of an interval, and at which share of it.
fn beyond(width: f64, from: [f64; 3], to: [f64; 3]) -> (f64, f64) {
    let ([y0, v0, a0], [y1, v1, a1]) = (from, to);
    let (h, square) = (width, width * width);
    let (low, high) = (y0.min(y1), y0.max(y1));
    // The Bernstein coefficients enclose the curve.
    let inner = [
        y0 + v0 * h / 5.0,
        y0 + 0.4 * v0 * h + a0 * square / 20.0,
        y1 - 0.4 * v1 * h + a1 * square / 20.0,
        y1 - v1 * h / 5.0,
    ];
    if inner.iter().all(|value| (low..=high).contains(value)) {
        return (0.0, 0.0);
    }
    let curve = spline::chain(&[0.0, 1.0], &[[y0, v0 * h, a0 * square], [y1, v1 * h, a1 * square]]);
    let [top, bottom] = extremum::largest_of_both_signs(
        |x| {
            let [value, slope, bend, _] = curve.values_at(0, x);
            [value, slope, bend]
        },
        (0.0, 1.0),
        CELLS,
    );
    let (above, below) = (top.value - high, low + bottom.value);
    if above >= below { (above.max(0.0), top.at) } else { (below.max(0.0), bottom.at) }
}

/// The largest of the curve through nodes, and the share where.
fn overshoot(knots: &[f64], nodes: &Nodes) -> (f64, f64) {
    let jets = nodes.values.iter().zip(&nodes.states).map(|(value, [v, a])| [*value, *v, *a]);
    let pairs = knots.iter().zip(knots.iter().skip(1)).zip(jets.clone().zip(jets.skip(1)));
    let all = pairs.map(|((from, to), ends)| {
        let (by, share) = beyond(to - from, ends.0, ends.1);
        (by, from + share * (to - from))
    });
    all.fold((0.0, 0.0), |worst, found| if found.0 > worst.0 { found } else { worst })
}
