//! Largest value of a smooth function on an interval, from its exact derivative.

use super::{parallel, root};

/// An argument and the value there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremum {
    /// Argument.
    pub at: f64,
    /// Value.
    pub value: f64,
}

/// Halvings of a cell that may contain an undetected extremum.
const HALVINGS: u32 = 6;
/// A cell may contain one when its values differ from those that follow from the slopes at its ends by more than this share of its width
/// times the larger slope: for a parabola the difference is 0, for a cube of the distance from an end a sixth.
const HIDES: f64 = 0.2;
/// Differences below this share of the values are rounding.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A place with value and slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueAndSlope {
    /// Argument.
    pub at: f64,
    /// Value.
    pub value: f64,
    /// Derivative of the value.
    pub slope: f64,
}

impl ValueAndSlope {
    /// The negative of the function at this place.
    #[must_use]
    pub fn negative(self) -> Self {
        Self { value: -self.value, slope: -self.slope, ..self }
    }
}

/// What may lie between two places.
enum GapContent {
    /// At most one stationary place: the values follow from the slopes.
    Plain,
    /// Another one next to one of them that is itself stationary.
    BesideAnEnd,
    /// Any number: the values do not follow from the slopes.
    Anything,
}

impl GapContent {
    fn between(left: ValueAndSlope, right: ValueAndSlope) -> Self {
        let width = right.at - left.at;
        let by_slopes = 0.5 * width * (left.slope + right.slope);
        let size = left.slope.abs().max(right.slope.abs());
        let rounding = ROUNDING * left.value.abs().max(right.value.abs());
        if (right.value - left.value - by_slopes).abs() > HIDES * width * size + rounding {
            Self::Anything
        } else if (left.slope == 0.0 || right.slope == 0.0) && size > 0.0 {
            Self::BesideAnEnd
        } else {
            Self::Plain
        }
    }
}

/// The largest value between two places whose values follow from the slopes, with a margin for slopes of twice the size.
fn rises_to(left: ValueAndSlope, right: ValueAndSlope) -> f64 {
    let size = left.slope.abs().max(right.slope.abs());
    left.value.max(right.value) + 2.0 * size * (right.at - left.at)
}

/// A search of the largest of values given with their slopes.
struct ExtremumSearch<F> {
    both: F,
    best: Extremum,
}

impl<F: FnMut(f64) -> (f64, f64)> ExtremumSearch<F> {
    fn evaluate(&mut self, at: f64) -> ValueAndSlope {
        let (value, slope) = (self.both)(at);
        let place = ValueAndSlope { at, value, slope };
        self.best = highest(self.best, &[place]);
        place
    }

    fn between(&mut self, left: ValueAndSlope, right: ValueAndSlope, halvings: u32) {
        let between = GapContent::between(left, right);
        if !matches!(between, GapContent::Anything) && rises_to(left, right) < self.best.value {
            return;
        }
        if left.slope > 0.0 && right.slope < 0.0 {
            if let Ok(at) = root::bracketed(|at| (self.both)(at).1, left.at, right.at, 0.0) {
                self.evaluate(at);
            }
        } else if halvings > 0 && !matches!(between, GapContent::Plain) {
            let middle = self.evaluate(0.5 * (left.at + right.at));
            self.between(left, middle, halvings - 1);
            self.between(middle, right, halvings - 1);
        }
    }
}

/// The largest value of `value` on `[low, high]`.
///
/// `slope` is the derivative of `value`. The interval is divided into `cells`; every cell in which the slope falls through zero gives a
/// candidate, solved to rounding by [`root::bracketed`], in addition to the ends of the cells. A cell in which two stationary places may
/// cancel each other, or one may lie next to a stationary end, is halved up to six times. Choose `cells` so that a cell is shorter than most
/// distances between extrema (a cam law has a handful on a piece).
pub fn largest(
    mut value: impl FnMut(f64) -> f64,
    mut slope: impl FnMut(f64) -> f64,
    range: (f64, f64),
    cells: u32,
) -> Extremum {
    largest_with_slope(|at| (value(at), slope(at)), range, cells)
}

/// The largest value where value and slope are computed together.
pub fn largest_with_slope(mut both: impl FnMut(f64) -> (f64, f64), range: (f64, f64), cells: u32) -> Extremum {
    let places = places(&mut both, range, cells);
    let first = Extremum { at: range.0, value: f64::NAN };
    beyond(highest(first, &places), &places, both)
}

/// The places between the cells with value and slope.
pub fn places(mut both: impl FnMut(f64) -> (f64, f64), range: (f64, f64), cells: u32) -> Vec<ValueAndSlope> {
    let places = between_cells(range, cells).map(|at| {
        let (value, slope) = both(at);
        ValueAndSlope { at, value, slope }
    });
    places.collect()
}

/// The highest of places and of what is known; the first of equals.
#[must_use]
pub fn highest(known: Extremum, places: &[ValueAndSlope]) -> Extremum {
    places.iter().fold(known, |best, place| {
        let higher = place.value > best.value || best.value.is_nan();
        if higher { Extremum { at: place.at, value: place.value } } else { best }
    })
}

/// The largest value between places, or what is known, including these and others, where nothing exceeds it: a cell that cannot exceed it
/// is not examined. Otherwise as [`largest`].
pub fn beyond(known: Extremum, places: &[ValueAndSlope], both: impl FnMut(f64) -> (f64, f64)) -> Extremum {
    let mut search = ExtremumSearch { both, best: known };
    for pair in places.windows(2) {
        if let [left, right] = pair {
            search.between(*left, *right, HALVINGS);
        }
    }
    search.best
}

/// The places between the cells, including the ends of the interval.
pub fn between_cells((low, high): (f64, f64), cells: u32) -> impl Iterator<Item = f64> {
    (0..=cells).map(move |cell| match cell {
        0 => low,
        cell if cell == cells => high,
        cell => low + (high - low) * (f64::from(cell) / f64::from(cells)),
    })
}

/// The largest value of a function and of its negative, given with its slope and the slope's own slope: where the slope turns towards zero and
/// back between two cells, it is examined
/// where it is nearest to zero, so that no pair of close stationary places is missed.
pub fn largest_of_both_signs(mut all: impl FnMut(f64) -> [f64; 3], range: (f64, f64), cells: u32) -> [Extremum; 2] {
    let mut places: Vec<ValueAndSlope> = Vec::new();
    let mut before: Option<(f64, [f64; 3])> = None;
    for at in between_cells(range, cells) {
        let here = (at, all(at));
        if let Some(before) = before.filter(|before| turns_back(before.1, here.1))
            && let Ok(turn) = root::bracketed(|at| all(at)[2], before.0, at, 0.0)
        {
            let [value, slope, _] = all(turn);
            places.push(ValueAndSlope { at: turn, value, slope });
        }
        let [value, slope, _] = here.1;
        places.push(ValueAndSlope { at, value, slope });
        before = Some(here);
    }
    let first = Extremum { at: range.0, value: f64::NAN };
    [1.0, -1.0].map(|sign| {
        let places: Vec<ValueAndSlope> =
            places.iter().map(|place| if sign < 0.0 { place.negative() } else { *place }).collect();
        beyond(highest(first, &places), &places, |at| {
            let [value, slope, _] = all(at);
            (sign * value, sign * slope)
        })
    })
}

/// Whether a slope that has one sign at both ends of a cell, or is 0 at one, may have the other sign between them.
fn turns_back([_, slope, bend]: [f64; 3], [_, end_slope, end_bend]: [f64; 3]) -> bool {
    let sign = if slope == 0.0 { end_slope } else { slope };
    let inwards = |slope: f64, falls: f64| slope == 0.0 || slope * sign > 0.0 && falls < 0.0;
    bend * sign < 0.0 && end_bend * sign > 0.0 && inwards(slope, bend * sign) && inwards(end_slope, -end_bend * sign)
}

/// Golden sections that shrink a bracket to √ε of its width, the width of a flat top: 0.618 each.
pub const TO_ROUNDING: u32 = 38;

/// The largest value of `value` on `[low, high]` when its derivative is not known: the best of `cells` + 1 points, then
/// `sections` golden sections between its neighbours (Kiefer 1953).
pub fn largest_without_slope(value: impl FnMut(f64) -> f64, range: (f64, f64), cells: u32, sections: u32) -> Extremum {
    largest_of_hills(value, range, cells, 1, sections)
}

/// The largest value, refined near each of the `hills` best of these points that are not lower than their neighbours.
pub fn largest_of_hills(
    mut value: impl FnMut(f64) -> f64,
    range: (f64, f64),
    cells: u32,
    hills: usize,
    sections: u32,
) -> Extremum {
    let points: Vec<Extremum> =
        cell_ends(range.0, range.1, cells).into_iter().map(|at| Extremum { at, value: value(at) }).collect();
    let refined: Vec<Extremum> = highest_hills(&points, hills)
        .into_iter()
        .flat_map(|about| golden_sections(&mut value, about.0, about.1, sections))
        .collect();
    highest_of(points.into_iter().chain(refined))
}

/// The same of a value that takes long, on all processors: the points, then the hills.
pub fn largest_of_hills_in_parallel(
    value: impl Fn(f64) -> f64 + Sync,
    range: (f64, f64),
    cells: u32,
    hills: usize,
    sections: u32,
) -> Extremum {
    let points = parallel::map(&cell_ends(range.0, range.1, cells), |at| Extremum { at: *at, value: value(*at) });
    let refined = parallel::map(&highest_hills(&points, hills), |about| {
        golden_sections(&mut |at| value(at), about.0, about.1, sections)
    });
    highest_of(points.into_iter().chain(refined.into_iter().flatten()))
}

fn cell_ends(low: f64, high: f64, cells: u32) -> Vec<f64> {
    (0..=cells).map(|cell| low + (high - low) * (f64::from(cell) / f64::from(cells))).collect()
}

/// Whether a value is higher than another, or that is not a number.
fn is_higher(one: f64, other: f64) -> bool {
    one > other || other.is_nan()
}

/// The neighbours of each of the `hills` highest points that are not lower than these.
fn highest_hills(points: &[Extremum], hills: usize) -> Vec<(f64, f64)> {
    let tops = points.iter().enumerate().filter_map(|(index, here)| {
        let neighbours = [index.checked_sub(1), Some(index + 1)].map(|index| index.and_then(|index| points.get(index)));
        let is_top = neighbours.iter().flatten().all(|neighbour| !is_higher(neighbour.value, here.value));
        let [before, after] = neighbours.map(|neighbour| neighbour.unwrap_or(here).at);
        is_top.then_some(((before, after), here.value))
    });
    let mut tops: Vec<_> = tops.collect();
    tops.sort_by(|a, b| b.1.total_cmp(&a.1));
    tops.into_iter().take(hills).map(|(about, _)| about).collect()
}

/// The highest of some points, the first of equals.
fn highest_of(points: impl Iterator<Item = Extremum>) -> Extremum {
    points
        .reduce(|best, next| if is_higher(next.value, best.value) { next } else { best })
        .unwrap_or(Extremum { at: 0.0, value: f64::NAN })
}

/// The two inner points of the last golden section.
fn golden_sections(value: &mut impl FnMut(f64) -> f64, mut left: f64, mut right: f64, sections: u32) -> [Extremum; 2] {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut inner = Extremum { at: right - golden * (right - left), value: 0.0 };
    let mut outer = Extremum { at: left + golden * (right - left), value: 0.0 };
    (inner.value, outer.value) = (value(inner.at), value(outer.at));
    for _ in 0..sections {
        if inner.value >= outer.value {
            (right, outer) = (outer.at, inner);
            inner.at = right - golden * (right - left);
            inner.value = value(inner.at);
        } else {
            (left, inner) = (inner.at, outer);
            outer.at = left + golden * (right - left);
            outer.value = value(outer.at);
        }
    }
    [inner, outer]
}

/// The larger of two numbers; NaN where one of them is, so that a maximum never hides a NaN.
#[must_use]
pub fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_highest_of_several_hills_and_of_an_end() {
        let hills = |x: f64| libm::sin(5.0 * x) + 0.1 * x;
        let slope = |x: f64| 5.0 * libm::cos(5.0 * x) + 0.1;
        let top = largest(hills, slope, (0.0, 3.0), 16);
        // cos 5x = −0.02 on the last hill.
        let exact = (2.0 * std::f64::consts::TAU + libm::acos(-0.02)) / 5.0;
        assert!((top.at - exact).abs() < 4e-15, "{top:?}");
        let without = largest_without_slope(hills, (0.0, 3.0), 16, TO_ROUNDING);
        assert!((without.at - exact).abs() < 1e-7 && (without.value - hills(exact)).abs() < 1e-15, "{without:?}");
        let end = largest(|x| x * x, |x| 2.0 * x, (-1.0, 2.0), 4);
        assert_eq!(end, Extremum { at: 2.0, value: 4.0 });
    }

    /// Two stationary places much nearer to each other than the width of a cell, and one next to a stationary end.
    #[test]
    fn finds_what_the_bend_shows() {
        // x³/3 − (a + b) x²/2 + a b x has its top at a and its valley at b.
        for (a, b) in [(0.4, 0.4001), (1e-7, 2e-5), (0.0, 1e-6), (0.999_99, 1.0)] {
            let cubic = |x: f64| [x * (x * (x / 3.0 - 0.5 * (a + b)) + a * b), (x - a) * (x - b), 2.0 * x - a - b];
            let [top, low] = largest_of_both_signs(|x| cubic(x).map(|y| y), (0.0, 1.0), 7);
            let (valley, hill) = (cubic(b)[0], cubic(a)[0]);
            let ends = [cubic(0.0)[0], cubic(1.0)[0]];
            assert_eq!(-low.value, ends[0].min(ends[1]).min(valley), "{a} {b}: {low:?}");
            assert_eq!(top.value, ends[0].max(ends[1]).max(hill), "{a} {b}: {top:?}");
        }
    }

    /// A rise from rest that dips first, and a hill next to a valley within a cell.
    #[test]
    fn finds_what_hides_in_a_cell() {
        // 0.01 x³ − x⁵ has its top at x² = 0.006.
        let dip = largest(|x| 0.01 * x.powi(3) - x.powi(5), |x| 0.03 * x * x - 5.0 * x.powi(4), (0.0, 4.0), 32);
        assert!((dip.at - 0.006_f64.sqrt()).abs() < 1e-12, "{dip:?}");
        // A narrow hill on a slope.
        let width = 8e-3;
        let hill = |x: f64| libm::exp(-(x - 0.49) * (x - 0.49) / (width * width)) - x;
        let slope = |x: f64| -2.0 * (x - 0.49) / (width * width) * (hill(x) + x) - 1.0;
        let top = largest(hill, slope, (0.0, 0.5), 16);
        assert!(top.value > 0.5, "{top:?}");
    }
}
