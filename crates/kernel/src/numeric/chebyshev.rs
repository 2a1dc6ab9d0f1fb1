//! The largest value of a function that is smooth on an interval, without its derivative: the function is replaced by the
//! polynomial through Chebyshev points that agrees with it to rounding, and the roots of that polynomial's derivative are tried.
//!
//! L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM 2013, chapters 3 (points and coefficients), 8 (they
//! fall geometrically where the function is analytic) and 18 (roots). Where the coefficients of a cell do not fall to
//! `RESOLVED` with the highest degree, the cell is halved, unless nothing in it can exceed the largest value known. So a narrow
//! hump cannot hide between two samples: it is what keeps the coefficients from falling.
//!
//! The result is a value of the function itself, so it never exceeds the largest; it falls short of it by at most twice the
//! distance between polynomial and function.

use super::extremum::Extremum;
use super::root;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Lowest degree of a polynomial, and how many degrees are tried: each is twice the one before, and the samples are reused.
const LEAST_DEGREE: usize = 16;
const DEGREES: usize = 3;
/// How large the last coefficients of a resolved cell may be, as a share of the largest known value.
const RESOLVED: f64 = 1e-11;
/// How large they may be as a share of the largest sampled size: below it is rounding.
const ROUNDING: f64 = 1e-13;
/// This many of the last coefficients must be small: an odd or even function has zeros among them.
const LAST: usize = 4;
/// Most cells that are examined: a function that is not as smooth as its caller states costs no more than this.
const MOST_CELLS: usize = 256;
/// A cell is not halved below this share of the interval.
const LEAST_CELL: f64 = 1e-9;
/// How far a polynomial of half the degree can exceed its samples, over their range: 1/cos(π/4) − 1 on either side of the
/// middle (Ehlich & Zeller 1964).
const BETWEEN_SAMPLES: f64 = 0.21;

/// How far from a place where the slope is rounding its sign is examined, as a share of the distance to the next place.
const ASIDE: f64 = 1.0 / 64.0;

/// The fourth quarter of the coefficients over the third where the rest is known to be smaller than both.
const FALLING: f64 = 0.25;

/// A function on a cell: its values at the Chebyshev points from the upper end to the lower, and its coefficients.
struct ChebyshevCell {
    low: f64,
    high: f64,
    values: Vec<f64>,
    coefficients: Vec<f64>,
}

/// The derivatives of the polynomial of a cell, by t in [−1, 1].
struct CellDerivatives {
    first: Vec<f64>,
    second: Vec<f64>,
    /// A slope below this is rounding.
    rounding: f64,
    /// Bound of the second derivative.
    most_bend: f64,
}

/// A place with slope and second derivative.
#[derive(Clone, Copy)]
struct SlopeAndBend {
    at: f64,
    slope: f64,
    bend: f64,
}

impl CellDerivatives {
    fn new(coefficients: &[f64]) -> Self {
        let first = derivative(coefficients);
        let second = derivative(&first);
        Self { rounding: ROUNDING * size(&first), most_bend: size(&second), first, second }
    }

    fn slope_and_bend(&self, at: f64) -> SlopeAndBend {
        SlopeAndBend { at, slope: series(&self.first, at), bend: series(&self.second, at) }
    }
}

/// How far a function whose second derivative has this bound can depart from its chord over a width.
fn leaves_chord(bend: f64, width: f64) -> f64 {
    0.125 * bend * width * width
}

/// The search: the goal is the quantity that is to be largest, the value or its size.
struct ChebyshevSearch<V, G> {
    value: V,
    goal: G,
    best: Extremum,
    /// Largest size sampled.
    scale: f64,
    /// Values smaller than this need not be resolved.
    negligible: f64,
}

/// What is known when a search begins, and which differences do not matter.
#[derive(Debug, Clone, Copy)]
pub struct SearchStart {
    /// A value that was found elsewhere: smaller ones are not looked for, and it is returned where there is no larger one.
    pub best: Extremum,
    /// Differences below this do not matter.
    pub negligible: f64,
}

impl SearchStart {
    /// For a search without prior knowledge.
    #[must_use]
    pub fn nothing(negligible: f64) -> Self {
        Self { best: Extremum { at: 0.0, value: f64::NEG_INFINITY }, negligible }
    }
}

/// The largest value of `value` on `[low, high]`, where it is smooth, or what was known. Infinite where the function is infinite.
pub fn largest(value: impl FnMut(f64) -> f64, range: (f64, f64), known: SearchStart) -> Extremum {
    search(value, |value| value, range.0, range.1, known)
}

/// The largest size |value| on `[low, high]`, where `value`, with its sign, is smooth; as [`largest`].
pub fn largest_size(value: impl FnMut(f64) -> f64, range: (f64, f64), known: SearchStart) -> Extremum {
    search(value, f64::abs, range.0, range.1, known)
}

fn search(
    value: impl FnMut(f64) -> f64,
    goal: impl Fn(f64) -> f64,
    low: f64,
    high: f64,
    SearchStart { best, negligible }: SearchStart,
) -> Extremum {
    let mut search = ChebyshevSearch { value, goal, best, scale: 0.0, negligible };
    let mut cells = vec![(low, high)];
    let mut looked_at = 0;
    search.sample(high);
    while let Some((a, b)) = cells.pop() {
        looked_at += 1;
        let unresolved = search.look_at(a, b);
        if search.best.value == f64::INFINITY {
            break;
        }
        if unresolved && looked_at < MOST_CELLS && b - a > LEAST_CELL * (high - low) {
            let middle = 0.5 * (a + b);
            cells.extend([(a, middle), (middle, b)]);
        }
    }
    search.best
}

impl<V: FnMut(f64) -> f64, G: Fn(f64) -> f64> ChebyshevSearch<V, G> {
    fn sample(&mut self, at: f64) -> f64 {
        let value = (self.value)(at);
        let goal = (self.goal)(value);
        self.scale = self.scale.max(value.abs());
        if goal > self.best.value {
            self.best = Extremum { at, value: goal };
        }
        value
    }

    /// Examines a cell; whether it has to be halved.
    fn look_at(&mut self, low: f64, high: f64) -> bool {
        let mut cell = ChebyshevCell { low, high, values: Vec::new(), coefficients: Vec::new() };
        for ChebyshevPoints { points, cosines, grid } in ChebyshevPoints::of_degrees() {
            let before = std::mem::replace(&mut cell.values, Vec::with_capacity(points.len()));
            for (index, point) in points.iter().enumerate() {
                let known = if index % 2 == 0 { before.get(index / 2).copied() } else { None };
                let at = cell.place(*point);
                cell.values.push(match known {
                    Some(value) => value,
                    None => self.sample(at),
                });
            }
            if !cell.values.iter().all(|value| value.is_finite()) {
                return true;
            }
            cell.coefficients = coefficients(&cell.values, cosines);
            let varies: f64 = cell.coefficients.iter().skip(1).map(|c| c.abs()).sum();
            if varies <= self.negligible || self.cannot_exceed(&cell) {
                return false;
            }
            let last = cell.coefficients.iter().rev().take(LAST).fold(0.0_f64, |most, c| most.max(c.abs()));
            if last <= self.negligible.max(RESOLVED * self.best.value.abs()).max(ROUNDING * self.scale) {
                self.try_stationary_points(&cell, grid);
                return false;
            }
        }
        true
    }

    /// Whether nothing in the cell can exceed the largest value known: by its samples, and by the upper half of its coefficients,
    /// where these fall so that what follows them is smaller still.
    fn cannot_exceed(&self, cell: &ChebyshevCell) -> bool {
        let count = cell.coefficients.len();
        let (half, three_quarters) = (count / 2, 3 * count / 4);
        let third = size(cell.coefficients.get(half..three_quarters).unwrap_or_default());
        let fourth = size(cell.coefficients.get(three_quarters..).unwrap_or_default());
        let falling = fourth <= FALLING * third || fourth <= self.negligible;
        let goals = cell.values.iter().map(|value| (self.goal)(*value));
        let (least, most) = goals.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        falling && most + BETWEEN_SAMPLES * (most - least) + 4.0 * (third + fourth) < self.best.value
    }

    /// Tries the function where the derivative of the cell's polynomial vanishes, except where the polynomial stays below the largest
    /// value known.
    fn try_stationary_points(&mut self, cell: &ChebyshevCell, grid: &[f64]) {
        let slopes = CellDerivatives::new(&cell.coefficients);
        let mut before: Option<SlopeAndBend> = None;
        // The grid has a place between two samples, both from the upper end to the lower.
        for (values, places) in cell.values.windows(2).zip(grid.windows(3).step_by(2)).rev() {
            let (&[high, low], &[right, middle, left]) = (values, places) else { continue };
            let most = (self.goal)(high).max((self.goal)(low));
            if most + leaves_chord(slopes.most_bend, right - left) < self.best.value {
                continue;
            }
            let mut from = before.filter(|place| place.at == left).unwrap_or_else(|| slopes.slope_and_bend(left));
            for to in [middle, right].map(|at| slopes.slope_and_bend(at)) {
                self.try_between(cell, &slopes, from, to);
                from = to;
            }
            before = Some(from);
        }
    }

    /// Tries the function where the slope changes its sign between two places.
    fn try_between(&mut self, cell: &ChebyshevCell, slopes: &CellDerivatives, left: SlopeAndBend, right: SlopeAndBend) {
        let from = self.with_certain_sign(cell, slopes, left, right.at);
        let to = self.with_certain_sign(cell, slopes, right, left.at);
        // Two stationary points within a cell of the grid: the slope has an extremum between them.
        let turns = from.slope * to.slope > 0.0 && from.bend * from.slope < 0.0 && to.bend * to.slope > 0.0;
        let split = if turns { root::bracketed(|t| series(&slopes.second, t), from.at, to.at, 0.0).ok() } else { None };
        let Some(split) = split else {
            if from.slope * to.slope < 0.0 {
                self.try_root(cell, slopes, from.at, to.at);
            }
            return;
        };
        if from.slope * series(&slopes.first, split) < 0.0 {
            self.try_root(cell, slopes, from.at, split);
            self.try_root(cell, slopes, split, to.at);
        }
    }

    /// A place; where its slope is rounding, and so its sign uncertain, the function is tried there and the place moved by a little.
    fn with_certain_sign(
        &mut self,
        cell: &ChebyshevCell,
        slopes: &CellDerivatives,
        place: SlopeAndBend,
        other: f64,
    ) -> SlopeAndBend {
        if place.slope.abs() > slopes.rounding {
            return place;
        }
        self.sample(cell.place(place.at));
        slopes.slope_and_bend(place.at + ASIDE * (other - place.at))
    }

    fn try_root(&mut self, cell: &ChebyshevCell, slopes: &CellDerivatives, low: f64, high: f64) {
        if let Ok(t) = root::bracketed(|t| series(&slopes.first, t), low, high, 0.0) {
            self.sample(cell.place(t));
        }
    }
}

impl ChebyshevCell {
    /// The argument at t in [−1, 1].
    fn place(&self, t: f64) -> f64 {
        if t >= 1.0 {
            self.high
        } else if t <= -1.0 {
            self.low
        } else {
            0.5 * ((1.0 - t) * self.low + (1.0 + t) * self.high)
        }
    }
}

/// The Chebyshev points cos(π i/n), i = 0…n; exactly −1, 0 and 1 at the ends and in the middle.
fn points(degree: usize) -> Vec<f64> {
    #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
    let points = (0..=degree).map(|index| {
        let (i, n) = (index as f64, degree as f64);
        libm::sin(0.5 * PI * ((n - 2.0 * i) / n))
    });
    points.collect()
}

/// The points of each degree with their cosines, and the grid on which slopes are examined, made once.
struct ChebyshevPoints {
    points: Vec<f64>,
    cosines: Vec<f64>,
    grid: Vec<f64>,
}

impl ChebyshevPoints {
    /// For every degree, the lowest first.
    fn of_degrees() -> impl Iterator<Item = &'static Self> {
        static ALL: [OnceLock<ChebyshevPoints>; DEGREES] = [const { OnceLock::new() }; DEGREES];
        let degrees = std::iter::successors(Some(LEAST_DEGREE), |degree| Some(2 * degree));
        ALL.iter().zip(degrees).map(|(made, degree)| {
            made.get_or_init(|| {
                let points = points(degree);
                Self { cosines: cosines(&points), points, grid: self::points(2 * degree) }
            })
        })
    }
}

/// cos(π j k/n) for every j, and for each of these for k up to the middle, in sequence.
fn cosines(points: &[f64]) -> Vec<f64> {
    let turn: Vec<f64> = points.iter().chain(points.iter().rev().skip(1)).copied().collect();
    let (count, whole) = (to_the_middle(points.len()), 2 * points.len().saturating_sub(1).max(1));
    let mut cosines = Vec::with_capacity(points.len() * count);
    for j in 0..points.len() {
        cosines.extend((0..count).map(|k| turn.get(j * k % whole).copied().unwrap_or(0.0)));
    }
    cosines
}

/// The number of coefficients up to the middle one, for an odd number.
fn to_the_middle(count: usize) -> usize {
    count / 2 + 1
}

/// Coefficients of the polynomial through values at the Chebyshev points, an odd number of them, from the upper end to the lower:
/// cₖ = (2/n) Σ″ fⱼ cos(π j k/n), the first and the last halved. With n − k in place of k the terms of odd j change their sign.
fn coefficients(values: &[f64], cosines: &[f64]) -> Vec<f64> {
    let (n, count) = (values.len().saturating_sub(1), to_the_middle(values.len()));
    let mut sums = [vec![0.0; count], vec![0.0; count]];
    for (j, (value, row)) in values.iter().zip(cosines.chunks(count)).enumerate() {
        let value = if j == 0 || j == n { 0.5 * value } else { *value };
        sums[j % 2].iter_mut().zip(row).for_each(|(sum, cosine)| *sum += value * cosine);
    }
    #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
    let share = 2.0 / n as f64;
    let [even, odd] = sums;
    let lower = even.iter().zip(&odd).map(|(even, odd)| even + odd);
    let upper = even.iter().zip(&odd).rev().skip(1).map(|(even, odd)| even - odd);
    let mut coefficients: Vec<f64> = lower.chain(upper).map(|sum| share * sum).collect();
    for end in [0, n] {
        if let Some(coefficient) = coefficients.get_mut(end) {
            *coefficient *= 0.5;
        }
    }
    coefficients
}

/// Coefficients of the derivative: c′ₖ₋₁ = c′ₖ₊₁ + 2 k cₖ, the first halved.
fn derivative(coefficients: &[f64]) -> Vec<f64> {
    let mut slopes = vec![0.0; coefficients.len() + 1];
    for k in (1..coefficients.len()).rev() {
        #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
        let own = 2.0 * k as f64 * coefficients.get(k).copied().unwrap_or(0.0);
        let above = slopes.get(k + 1).copied().unwrap_or(0.0);
        if let Some(slope) = slopes.get_mut(k - 1) {
            *slope = above + own;
        }
    }
    if let Some(first) = slopes.first_mut() {
        *first *= 0.5;
    }
    slopes.truncate(coefficients.len().saturating_sub(1).max(1));
    slopes
}

/// Sum of the sizes of coefficients: no value of their series exceeds it.
fn size(coefficients: &[f64]) -> f64 {
    coefficients.iter().map(|c| c.abs()).sum()
}

/// Σ cₖ Tₖ(t) by Clenshaw's recurrence.
fn series(coefficients: &[f64], t: f64) -> f64 {
    let (mut next, mut after) = (0.0, 0.0);
    for coefficient in coefficients.iter().skip(1).rev() {
        (next, after) = (2.0 * t * next - after + coefficient, next);
    }
    t * next - after + coefficients.first().copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places and values in closed form: several humps, a narrow one, one at an end, poles just outside, a corner at zero.
    #[test]
    fn the_largest_is_found_to_rounding() {
        type ExtremumCase = (&'static str, fn(f64) -> f64, (f64, f64), f64);
        let cases: &[ExtremumCase] = &[
            ("humps", |x| libm::sin(40.0 * x) + 1e-3 * libm::sin(0.5 * PI * x), (0.0, 1.0), f64::NAN),
            // A Lorentz line of width 1e-4 whose top is 1.
            ("narrow", |x| 1.0 / (1.0 + ((x - 0.371_828) / 1e-4).powi(2)), (0.0, 1.0), 1.0),
            ("at an end", |x| x * x, (-1.0, 2.0), 4.0),
            // x/(x² + a²) has 1/(2 a) at x = a: the pole is 1e-3 from the end.
            ("pole near the end", |x| x / (x * x + 1e-6), (0.0, 3.0), 500.0),
            ("flat", |_| 7.0, (0.0, 1.0), 7.0),
            // √x is not smooth at 0, where it is small.
            ("root", |x| x.sqrt() * libm::exp(-x), (0.0, 9.0), 0.5_f64.sqrt() * 0.606_530_659_712_633_4),
        ];
        for (name, value, range, expected) in cases {
            let mut calls = 0;
            let counted = |x: f64| {
                calls += 1;
                value(x)
            };
            let found = largest(counted, *range, SearchStart::nothing(0.0));
            let scan = (0..=2_000_000).map(|i| value(range.0 + (range.1 - range.0) * f64::from(i) / 2e6));
            let scan = scan.fold(f64::NEG_INFINITY, f64::max);
            assert!(found.value >= scan * (1.0 - 1e-12), "{name}: {found:?} but {scan}");
            assert!(expected.is_nan() || (found.value / expected - 1.0).abs() < 1e-13, "{name}: {found:?}");
            assert!(calls < 3000, "{name}: {calls} calls");
        }
    }

    #[test]
    fn sizes_and_what_is_infinite_or_undefined() {
        let fall = largest_size(|x| 0.5 - x * x, (0.0, 2.0), SearchStart::nothing(0.0));
        assert_eq!(fall, Extremum { at: 2.0, value: 3.5 });
        let inner = largest_size(|x| x * x * x - 3.0 * x, (-0.5, 1.5), SearchStart::nothing(0.0));
        assert!((inner.at - 1.0).abs() < 1e-7 && (inner.value - 2.0).abs() < 1e-15, "{inner:?}");
        assert_eq!(largest(|x| 1.0 / (x - 0.5).max(0.0), (0.0, 1.0), SearchStart::nothing(0.0)).value, f64::INFINITY);
        // Undefined on one side: the other side still has its largest value.
        let half = largest(|x| if x < 0.3 { f64::NAN } else { 1.0 - x }, (0.0, 1.0), SearchStart::nothing(0.0));
        assert!((half.value - 0.7).abs() < 1e-9, "{half:?}");
    }

    /// Noise of rounding is not resolved, and costs a few samples only.
    #[test]
    fn what_is_negligible_costs_nothing() {
        let mut calls = 0;
        let noise = |x: f64| {
            calls += 1;
            1e-15 * libm::sin(1e9 * x)
        };
        assert!(largest_size(noise, (0.0, 1.0), SearchStart::nothing(1e-12)).value <= 1e-15);
        assert_eq!(calls, LEAST_DEGREE + 2);
    }

    /// A top next to a saddle on a sample, where slope and second derivative are rounding.
    #[test]
    fn a_top_next_to_a_saddle_on_a_sample_is_found() {
        for a in [1e-3, 1e-2, 0.04] {
            // x⁴/4 − a x³/3, downwards: slope x² (a − x).
            let top = |x: f64| 3.0 + a * x * x * x / 3.0 - x * x * x * x / 4.0 + 1e-17 * libm::sin(1e9 * x);
            let found = largest(top, (-1.0, 1.0), SearchStart::nothing(0.0));
            assert!(found.value >= top(a) * (1.0 - 2e-11), "{a}: {found:?} {}", top(a));
        }
    }

    /// A top nearer to an end than any sample.
    #[test]
    fn a_top_next_to_an_end_is_found() {
        for (from_end, low) in [1e-4, 1e-3, 1e-2].into_iter().flat_map(|a| [(a, true), (a, false)]) {
            let top = if low { from_end } else { 1.0 - from_end };
            let found = largest(|x| 1.0 - (x - top) * (x - top), (0.0, 1.0), SearchStart::nothing(0.0));
            assert!((found.at - top).abs() < 1e-7 && (found.value - 1.0).abs() < 1e-14, "{top}: {found:?}");
        }
        // Lowest at a and highest at b, both nearer to the end than any sample: b² (b − 3a)/6 from 0.
        let (a, b) = (2e-4, 2e-3);
        let found = largest(|x| -x * (x * (x / 3.0 - 0.5 * (a + b)) + a * b), (0.0, 1.0), SearchStart::nothing(0.0));
        assert!((found.value / (b * b * (b - 3.0 * a) / 6.0) - 1.0).abs() < 1e-9, "{found:?}");
    }
}
