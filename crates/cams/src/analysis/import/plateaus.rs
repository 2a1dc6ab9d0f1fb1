//! Where a motion rests or turns back: the plateaus between which its segments run.

use super::positions::Positions;

/// Shortest dwell, as a share of the filling: 3 degrees of a turn.
const LEAST_DWELL: f64 = 3.0 / 360.0;
/// Fewest positions of a dwell, unless its positions are farther apart than so many usual ones.
const LEAST_ROWS: usize = 4;
const APART: f64 = 1.5;
/// Plateaus nearer to each other than so many deviations are one, and a motion turns back where it does so by as many.
const SAME: f64 = 6.0;
/// A motion that goes back by less than this share of its lift does not turn.
const LEAST_TURN: f64 = 1e-3;
/// Where the motion turns back, rest and turn are told apart only by their laws up to this share of the filling.
const WIDEST_TURN: f64 = 30.0 / 360.0;

/// A dwell, or a place where the motion turns back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plateau {
    /// First and last position of it, counted on over fillings.
    pub(super) first: usize,
    pub(super) last: usize,
    pub(super) level: f64,
    /// The motion may only turn back there.
    pub(super) turns: bool,
}

impl Plateau {
    /// The position in its middle.
    pub(super) fn middle(&self) -> usize {
        usize::midpoint(self.first, self.last)
    }
}

/// The plateaus of positions that are right within a deviation, in order; the first lies in the first filling.
pub(super) fn plateaus(rows: &Positions, deviation: f64) -> Vec<Plateau> {
    let (low, high) = rows.range();
    let turn = (SAME * deviation).max(LEAST_TURN * (high - low));
    let mut found = merged(rows, dwells(rows, deviation), turn);
    if found.is_empty() {
        let top = (0..rows.len()).max_by(|a, b| rows.value(*a).total_cmp(&rows.value(*b))).unwrap_or(0);
        found.push(Plateau { first: top, last: top, level: rows.value(top), turns: true });
    }
    let mut all = Vec::new();
    for (index, plateau) in found.iter().enumerate() {
        let next =
            found.get(index + 1).copied().unwrap_or_else(|| shifted(found.first().unwrap_or(plateau), rows.len()));
        all.push(*plateau);
        all.extend(turns_between(rows, plateau, &next, turn));
    }
    mark_turns(rows, &mut all);
    all
}

/// A plateau a filling later.
fn shifted(plateau: &Plateau, by: usize) -> Plateau {
    Plateau { first: plateau.first + by, last: plateau.last + by, ..*plateau }
}

/// The dwells: the widest runs within the deviation to either side.
fn dwells(rows: &Positions, deviation: f64) -> Vec<Plateau> {
    let (count, spacing) = (rows.len(), rows.spacing());
    let width = |run: &(usize, usize)| rows.angle(run.1) - rows.angle(run.0);
    let mut runs = rows.flat_runs(2.0 * deviation);
    runs.retain(|run| {
        let few = run.1 - run.0 + 1 < LEAST_ROWS;
        width(run) >= LEAST_DWELL * rows.fill && (!few || width(run) >= APART * spacing)
    });
    runs.sort_by(|a, b| width(b).total_cmp(&width(a)));
    let mut kept: Vec<(usize, usize)> = Vec::new();
    for (first, last) in runs {
        let meets = |other: &(usize, usize)| {
            [0, count].into_iter().any(|by| {
                (first + by <= other.1 && other.0 <= last + by) || (first <= other.1 + by && other.0 + by <= last)
            })
        };
        if !kept.iter().any(meets) {
            kept.push((first, last));
        }
    }
    kept.sort_unstable();
    kept.into_iter()
        .map(|(first, last)| Plateau { first, last, level: level(rows, (first, last)), turns: false })
        .collect()
}

/// The mean of the middle half of a run.
fn level(rows: &Positions, (first, last): (usize, usize)) -> f64 {
    let quarter = (last - first) / 4;
    let (first, last) = (first + quarter, last - quarter);
    #[expect(clippy::cast_precision_loss, reason = "few positions")]
    let count = (last - first + 1) as f64;
    (first..=last).map(|at| rows.value(at)).sum::<f64>() / count
}

/// Neighbours at one level without a motion between them are one plateau.
fn merged(rows: &Positions, found: Vec<Plateau>, turn: f64) -> Vec<Plateau> {
    let mut all: Vec<Plateau> = Vec::new();
    let near = |a: &Plateau, b: &Plateau| {
        (a.last..=b.first).all(|at| (rows.value(at) - a.level).abs() <= turn) && (a.level - b.level).abs() <= turn
    };
    let width = |plateau: &Plateau| rows.angle(plateau.last) - rows.angle(plateau.first);
    for next in found {
        match all.last_mut().filter(|last| near(last, &next)) {
            Some(last) if width(&next) > width(last) => *last = next,
            Some(_) => {}
            None => all.push(next),
        }
    }
    if let (Some(first), Some(last)) = (all.first().copied(), all.last().copied())
        && all.len() > 1
        && near(&last, &shifted(&first, rows.len()))
    {
        if width(&first) > width(&last) {
            all.pop();
        } else {
            all.remove(0);
        }
    }
    all
}

/// Where the motion turns back between two plateaus.
fn turns_between(rows: &Positions, before: &Plateau, after: &Plateau, turn: f64) -> Vec<Plateau> {
    let mut found: Vec<Plateau> = Vec::new();
    // The farthest position in the present direction, 0 while that is not known.
    let (mut way, mut far) = (0.0, (before.last, before.level));
    let pivot = |at: usize| Plateau { first: at, last: at, level: rows.value(at), turns: true };
    for at in before.last..=after.first {
        let value = if at == after.first { after.level } else { rows.value(at) };
        if way == 0.0 {
            if (value - before.level).abs() > turn {
                (way, far) = (f64::signum(value - before.level), (at, value));
            }
        } else if way * (value - far.1) > 0.0 {
            far = (at, value);
        } else if way * (far.1 - value) > turn {
            found.push(pivot(far.0));
            (way, far) = (-way, (at, value));
        }
    }
    found
}

/// Marks the short dwells from which the motion goes back the way it came.
fn mark_turns(rows: &Positions, all: &mut [Plateau]) {
    let levels: Vec<f64> = all.iter().map(|plateau| plateau.level).collect();
    let count = levels.len();
    let level = |at: usize| levels.get(at % count.max(1)).copied().unwrap_or(0.0);
    for (at, plateau) in all.iter_mut().enumerate() {
        let own = level(at);
        let back = (level(at + count - 1) - own) * (level(at + 1) - own) > 0.0;
        let width = rows.angle(plateau.last) - rows.angle(plateau.first);
        plateau.turns |= back && width <= WIDEST_TURN * rows.fill;
    }
}
