//! Finds a single value off the curve of its neighbours.
//!
//! A value with an error e adds e times a known weight to the divided difference through it and its neighbours; differences of the neighbours alone
//! do not contain e. The difference of order n of a smooth curve is its nth derivative / n!, so the neighbours show the curve's own contribution,
//! however uneven their spacing. A step in a derivative also shows in every difference of the neighbours across it. Two orders are tried: the
//! fourth finds errors near such steps, the sixth errors in coarse values of smooth curves.

use super::scatter::{OF_MEDIAN, median};
use std::ops::Range;

/// Neighbours on each side of a value: differences of the fourth and the sixth order.
const SIDES: [usize; 2] = [2, 3];
/// Allowed distance / contribution shown by the neighbours, per order: correct values of laws with acceleration steps reach 2.8 and 5.7.
const FINE: [f64; 2] = [3.0, 6.4];
/// The same for few or uneven values and next to a velocity step, which resembles an error: correct values reach 10 and 16.
const COARSE: [f64; 2] = [18.0, 36.0];
/// Fewest values for `FINE`, and for any result.
const MANY: usize = 72;
const FEWEST: usize = 20;
/// Largest spacing / smallest spacing of evenly spaced neighbours.
const EVEN: f64 = 1.2;
/// Factor on the distance that a slope step next to a value explains.
const OF_JUMP: f64 = 3.0;
/// Lines count as straight if their slopes change by less than this share of the step between them.
const STRAIGHT: f64 = 0.15;
/// Samples from the value to the beginning of these lines.
const LINES: [usize; 3] = [1, 2, 3];
/// Allowed distance / rounding step; rounding alone causes at most 1.6 steps.
const OF_ROUNDING: f64 = 3.5;
/// Allowed distance / standard deviation of the scatter, used if that is above this share of a rounding step.
const OF_SCATTER: f64 = 12.0;
const BEYOND_ROUNDING: f64 = 0.6;
/// Differences on each side of a value for the median that gives its scatter, and their least number.
const NEAR: usize = 16;
const FEWEST_NEAR: usize = 8;
/// Shares of the range: least allowed distance, and rounding of sums.
const LEAST: f64 = 1e-7;
const DIGITS: f64 = 1e-12;
/// Samples on each side used by the differences of a value.
pub const AROUND: usize = 7;

/// A value at an argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Argument, increasing from sample to sample.
    pub at: f64,
    /// The value.
    pub value: f64,
    /// The row to be judged; `None` if the sample only continues the curve.
    pub row: Option<usize>,
}

/// The row with the largest distance from its neighbours / allowed distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// The number of its row.
    pub row: usize,
    /// Its value minus the polynomial through its neighbours.
    pub off: f64,
    /// Allowed distance.
    pub allowed: f64,
}

impl Outlier {
    /// Whether the row is farther off than allowed.
    #[must_use]
    pub fn is_wrong(&self) -> bool {
        self.off.abs() > self.allowed
    }

    fn share(&self) -> f64 {
        self.off.abs() / self.allowed
    }
}

/// Samples of a closed curve with a period, continued at both ends; `rests`: whether the curve rests between a row and the next.
#[must_use]
pub fn ring(rows: &[(f64, f64)], rests: &[bool], period: f64) -> Vec<Sample> {
    let own = chain(rows, rests);
    let count = own.len();
    // The last row of a ring is its first.
    let inner = own.get(..count.saturating_sub(1)).unwrap_or_default();
    let before = inner.get(inner.len().saturating_sub(AROUND)..).unwrap_or_default();
    let after = inner.get(..AROUND.min(inner.len())).unwrap_or_default();
    [shifted(before, -period), inner.to_vec(), shifted(after, period)].concat()
}

fn shifted(samples: &[Sample], by: f64) -> Vec<Sample> {
    samples.iter().map(|sample| Sample { at: sample.at + by, row: None, ..*sample }).collect()
}

/// Samples of rows, with more on each rest.
#[must_use]
pub fn chain(rows: &[(f64, f64)], rests: &[bool]) -> Vec<Sample> {
    let mut all = Vec::with_capacity(rows.len());
    let mut widths: Vec<f64> = rows.windows(2).filter_map(|pair| Some(pair.last()?.0 - pair.first()?.0)).collect();
    let spacing = median(&mut widths);
    for (row, (at, value)) in rows.iter().copied().enumerate() {
        all.push(Sample { at, value, row: Some(row) });
        let Some((next, _)) = rows.get(row + 1).copied() else { break };
        if rests.get(row) == Some(&true) {
            all.extend(resting(at, next, value, spacing));
        }
    }
    all
}

/// Samples within a rest, about a spacing apart, enough for both of its ends.
fn resting(from: f64, to: f64, value: f64, spacing: f64) -> Vec<Sample> {
    let most = u32::try_from(2 * AROUND).unwrap_or(u32::MAX);
    let parts = (1..=most).take_while(|parts| (to - from) / f64::from(*parts) > 0.75 * spacing).last().unwrap_or(1);
    let step = (to - from) / f64::from(parts);
    (1..parts).map(|part| Sample { at: from + step * f64::from(part), value, row: None }).collect()
}

/// A chain continued at a level before its first sample, or after its last.
#[must_use]
pub fn at_rest(samples: Vec<Sample>, spacing: f64, [before, after]: [bool; 2]) -> Vec<Sample> {
    let mut first = level(samples.first().filter(|_| before), -1.0, spacing);
    first.reverse();
    let last = level(samples.last().filter(|_| after), 1.0, spacing);
    [first, samples, last].concat()
}

/// Samples of the value of one, continued from it forwards (1) or backwards (−1).
fn level(sample: Option<&Sample>, direction: f64, spacing: f64) -> Vec<Sample> {
    let Some(sample) = sample else { return Vec::new() };
    let steps = (1..=u32::try_from(AROUND).unwrap_or(0)).map(f64::from);
    steps.map(|step| Sample { at: sample.at + direction * step * spacing, value: sample.value, row: None }).collect()
}

/// Sensitivity to small errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sensitivity {
    /// As fine as correct values of laws of motion allow.
    Fine,
    /// For values of any origin.
    Coarse,
}

/// The row farthest off, for values rounded to a step; `None` if there are too few rows.
#[must_use]
pub fn worst(samples: &[Sample], rounding: f64, sensitivity: Sensitivity) -> Option<Outlier> {
    let rows = samples.iter().filter(|sample| sample.row.is_some()).count();
    if rows < FEWEST {
        return None;
    }
    let judge = Judge::new(samples, rounding, rows >= MANY && sensitivity == Sensitivity::Fine);
    let all = (0..samples.len()).filter_map(|index| judge.outlier_at(index));
    all.reduce(|a, b| if b.share() > a.share() { b } else { a })
}

/// Samples with their differences.
struct Judge<'a> {
    samples: &'a [Sample],
    /// For each order and each window of consecutive samples: |difference| / its value for unit scatter.
    scatter: [Vec<f64>; 2],
    /// Standard deviation over all of them.
    overall: f64,
    range: f64,
    rounding: f64,
    many: bool,
}

impl<'a> Judge<'a> {
    fn new(samples: &'a [Sample], rounding: f64, many: bool) -> Self {
        let (low, high) = samples.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), sample| {
            (low.min(sample.value), high.max(sample.value))
        });
        let scatter =
            SIDES.map(|side| samples.windows(2 * side + 1).map(|window| Difference::new(window).scatter()).collect());
        let mut judge = Self { samples, scatter, overall: 0.0, range: high - low, rounding, many };
        judge.overall = judge.scatter_in(SIDES.map(|_| 0..samples.len()));
        judge
    }

    /// Standard deviation of the scatter from the windows of each order whose first samples are in `first`: the smaller of both orders, because the
    /// curve's own contribution differs between them.
    fn scatter_in(&self, first: [Range<usize>; 2]) -> f64 {
        let scatters = self.scatter.iter().zip(first).map(|(all, first)| {
            let windows = all.get(first.start.min(all.len())..first.end.min(all.len())).unwrap_or_default();
            let mut moving: Vec<f64> = windows.iter().copied().filter(|off| *off > DIGITS * self.range).collect();
            if moving.len() < FEWEST_NEAR { 0.0 } else { OF_MEDIAN * median(&mut moving) }
        });
        scatters.fold(f64::INFINITY, f64::min)
    }

    /// Standard deviation of the scatter near a sample, without the sample: the larger of both sides, because a flank may scatter more than a dwell.
    fn scatter_near(&self, index: usize) -> f64 {
        let before = SIDES.map(|side| {
            let end = index.saturating_sub(2 * side);
            end.saturating_sub(NEAR)..end
        });
        let after = SIDES.map(|_| index + 1..index + 1 + NEAR);
        self.scatter_in(before).max(self.scatter_in(after))
    }

    fn outlier_at(&self, index: usize) -> Option<Outlier> {
        let row = self.samples.get(index)?.row?;
        let fine = self.many && self.is_even(index)?;
        let scatter = self.overall.max(self.scatter_near(index));
        let noise = if scatter > BEYOND_ROUNDING * self.rounding { OF_SCATTER * scatter } else { 0.0 };
        let both = (0..SIDES.len()).filter_map(|order| {
            let side = SIDES.get(order)?;
            let (first, last) = (index.checked_sub(2 * side + 1)?, index + 2 * side + 1);
            let around = self.samples.get(first..=last)?;
            let own = Difference::new(self.samples.get(index - side..=index + side)?);
            let weight = own.weight(*side)?;
            let others: Vec<Sample> =
                around.iter().enumerate().filter(|(at, _)| first + at != index).map(|(_, one)| *one).collect();
            let shown =
                others.windows(2 * side + 1).map(|window| Difference::new(window).value.abs()).fold(0.0, f64::max);
            let off = own.value / weight;
            let is_fine = fine && self.jump(index, off).is_some_and(|jump| !(off.abs() <= jump));
            let times = if is_fine { FINE } else { COARSE };
            let allowed = (times.get(order)? * shown / weight.abs())
                .max(noise * own.size / weight.abs())
                .max(OF_ROUNDING * self.rounding)
                .max(LEAST * self.range)
                .max(f64::MIN_POSITIVE);
            Some(Outlier { row, off, allowed })
        });
        both.reduce(|a, b| if b.share() > a.share() { b } else { a })
    }

    /// Whether the samples around one are evenly spaced.
    fn is_even(&self, index: usize) -> Option<bool> {
        let around = self.samples.get(index.checked_sub(AROUND)?..=index + AROUND)?;
        let widths = around.windows(2).filter_map(|pair| Some(pair.last()?.at - pair.first()?.at));
        let (least, most) =
            widths.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), width| (least.min(width), most.max(width)));
        Some(most <= EVEN * least)
    }

    /// Largest distance from its neighbours that a slope step explains: a step at the sample, or the corners of a short stretch between two straight
    /// lines.
    fn jump(&self, index: usize, off: f64) -> Option<f64> {
        let at = self.samples.get(index)?.at;
        let spacing = 0.5 * (self.samples.get(index + 1)?.at - self.samples.get(index.checked_sub(1)?)?.at);
        let [before, after] =
            [self.three(index, 1, false)?, self.three(index, 1, true)?].map(|three| slope_at(three, at));
        // A sample at a corner is on the inner side of the polynomial.
        let one = if (after - before) * off < 0.0 { OF_JUMP * (after - before).abs() * spacing / 3.0 } else { 0.0 };
        let corners = LINES.iter().filter_map(|from| self.corner(index, *from)).map(|jump| jump * spacing);
        Some(corners.fold(one, f64::max))
    }

    /// Slope difference of straight lines on both sides of a sample, beginning `from` samples away; `None` if they are not straight.
    fn corner(&self, index: usize, from: usize) -> Option<f64> {
        let lines = [self.three(index, from, false)?, self.three(index, from, true)?];
        let [left, right] = lines.map(slope_of);
        let jump = (right - left).abs();
        lines.into_iter().all(|line| bend_of(line).abs() <= STRAIGHT * jump).then_some(jump)
    }

    /// Three samples on one side of a sample, beginning `from` samples away.
    fn three(&self, index: usize, from: usize, after: bool) -> Option<[Sample; 3]> {
        let [first, second, third] = [from, from + 1, from + 2].map(|by| {
            let place = if after { index + by } else { index.checked_sub(by)? };
            self.samples.get(place).copied()
        });
        Some([first?, second?, third?])
    }
}

/// The slope from the first to the last of three samples.
fn slope_of([a, _, c]: [Sample; 3]) -> f64 {
    (c.value - a.value) / (c.at - a.at)
}

/// Slope change from the first two to the last two of three samples.
fn bend_of([a, b, c]: [Sample; 3]) -> f64 {
    (c.value - b.value) / (c.at - b.at) - (b.value - a.value) / (b.at - a.at)
}

/// The slope at `at` of the parabola through three samples.
fn slope_at([a, b, c]: [Sample; 3], at: f64) -> f64 {
    let first = (b.value - a.value) / (b.at - a.at);
    let second = ((c.value - b.value) / (c.at - b.at) - first) / (c.at - a.at);
    first + second * (2.0 * at - a.at - b.at)
}

/// A divided difference.
struct Difference {
    value: f64,
    weights: Vec<f64>,
    /// Square root of the sum of the squared weights.
    size: f64,
}

impl Difference {
    fn new(samples: &[Sample]) -> Self {
        let weights = samples.iter().enumerate().map(|(own, sample)| {
            let others = samples.iter().enumerate().filter(|(other, _)| *other != own);
            1.0 / others.map(|(_, other)| sample.at - other.at).product::<f64>()
        });
        let weights: Vec<f64> = weights.collect();
        let value = weights.iter().zip(samples).map(|(weight, sample)| weight * sample.value).sum();
        let size = weights.iter().map(|weight| weight * weight).sum::<f64>().sqrt();
        Self { value, weights, size }
    }

    fn weight(&self, at: usize) -> Option<f64> {
        self.weights.get(at).copied()
    }

    /// |Difference| / its value for unit scatter.
    fn scatter(&self) -> f64 {
        self.value.abs() / self.size
    }
}
