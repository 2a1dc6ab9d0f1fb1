//! Largest value of a smooth function on an interval, from its exact derivative.

use super::root;

/// An argument and the value there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremum {
    /// Argument.
    pub at: f64,
    /// Value.
    pub value: f64,
}

/// Halvings of a cell in which an extremum may hide.
const HALVINGS: u32 = 6;
/// A cell hides one when its values differ from what the slopes at its ends make them by more than this share of its width times the
/// larger slope: a parabola makes 0 of it, a cube of the distance from an end a sixth.
const HIDES: f64 = 0.2;

/// A place with value and slope.
#[derive(Debug, Clone, Copy)]
struct Place {
    at: f64,
    value: f64,
    slope: f64,
}

/// Whether more than one stationary place may lie between two: where one of them is stationary itself, or the values do not follow from
/// the slopes.
fn hides(left: Place, right: Place) -> bool {
    let width = right.at - left.at;
    let by_slopes = 0.5 * width * (left.slope + right.slope);
    let size = left.slope.abs().max(right.slope.abs());
    let either = left.slope == 0.0 || right.slope == 0.0;
    (either && size > 0.0) || (right.value - left.value - by_slopes).abs() > HIDES * width * size
}

/// A search of the largest of values given with their slopes.
struct Search<F> {
    both: F,
    best: Extremum,
}

impl<F: FnMut(f64) -> (f64, f64)> Search<F> {
    fn at(&mut self, at: f64) -> Place {
        let found = (self.both)(at);
        self.known(at, found)
    }

    /// A place whose value and slope are known.
    fn known(&mut self, at: f64, (value, slope): (f64, f64)) -> Place {
        if value > self.best.value || self.best.value.is_nan() {
            self.best = Extremum { at, value };
        }
        Place { at, value, slope }
    }

    fn between(&mut self, left: Place, right: Place, halvings: u32) {
        if left.slope > 0.0 && right.slope < 0.0 {
            if let Ok(at) = root::bracketed(|at| (self.both)(at).1, left.at, right.at, 0.0) {
                self.at(at);
            }
        } else if halvings > 0 && hides(left, right) {
            let middle = self.at(0.5 * (left.at + right.at));
            self.between(left, middle, halvings - 1);
            self.between(middle, right, halvings - 1);
        }
    }
}

/// The largest value of `value` on `[low, high]`.
///
/// `slope` is the derivative of `value`. The interval is cut into `cells`; every cell in which the slope falls through zero gives a
/// candidate, solved to rounding by [`root::bracketed`], beside the ends of the cells. A cell in which two stationary places may hide each
/// other, or one beside a stationary end, is halved up to six times. Choose `cells` so that a cell is shorter than most
/// distances between extrema (a cam law has a handful a piece).
pub fn largest(
    mut value: impl FnMut(f64) -> f64,
    mut slope: impl FnMut(f64) -> f64,
    range: (f64, f64),
    cells: u32,
) -> Extremum {
    largest_with_slope(|at| (value(at), slope(at)), range, cells)
}

/// The same of value and slope at once.
pub fn largest_with_slope(both: impl FnMut(f64) -> (f64, f64), (low, high): (f64, f64), cells: u32) -> Extremum {
    let mut search = Search { both, best: Extremum { at: low, value: f64::NAN } };
    let mut left = search.at(low);
    for cell in 1..=cells {
        let end = if cell == cells { high } else { low + (high - low) * (f64::from(cell) / f64::from(cells)) };
        let right = search.at(end);
        search.between(left, right, HALVINGS);
        left = right;
    }
    search.best
}

/// Places between the cells, the ends of the interval with them.
pub fn between_cells((low, high): (f64, f64), cells: u32) -> impl Iterator<Item = f64> {
    (0..=cells).map(move |cell| match cell {
        0 => low,
        cell if cell == cells => high,
        cell => low + (high - low) * (f64::from(cell) / f64::from(cells)),
    })
}

/// The same of a function and of its negative, the places between the cells looked at once for both.
pub fn both_ways_with_slope(mut both: impl FnMut(f64) -> (f64, f64), range: (f64, f64), cells: u32) -> [Extremum; 2] {
    let known: Vec<(f64, (f64, f64))> = between_cells(range, cells).map(|at| (at, both(at))).collect();
    both_ways_from(&known, both)
}

/// The same where value and slope at [`between_cells`] are known.
pub fn both_ways_from(known: &[(f64, (f64, f64))], mut both: impl FnMut(f64) -> (f64, f64)) -> [Extremum; 2] {
    let low = known.first().map_or(f64::NAN, |(at, _)| *at);
    [1.0, -1.0].map(|sign| {
        let signed = |(value, slope): (f64, f64)| (sign * value, sign * slope);
        let mut search = Search { both: |at| signed(both(at)), best: Extremum { at: low, value: f64::NAN } };
        let mut left: Option<Place> = None;
        for (at, found) in known {
            let right = search.known(*at, signed(*found));
            if let Some(left) = left {
                search.between(left, right, HALVINGS);
            }
            left = Some(right);
        }
        search.best
    })
}

/// The same of value, slope and the slope's own slope at once: where the slope turns towards zero and back between two cells it is looked at
/// where it is nearest to it, so that no pair of stationary places beside each other stays unseen.
pub fn both_ways_with_bend(mut all: impl FnMut(f64) -> [f64; 3], range: (f64, f64), cells: u32) -> [Extremum; 2] {
    let mut known: Vec<(f64, (f64, f64))> = Vec::new();
    let mut before: Option<(f64, [f64; 3])> = None;
    for at in between_cells(range, cells) {
        let here = (at, all(at));
        if let Some(before) = before.filter(|before| turns_back(before.1, here.1))
            && let Ok(turn) = root::bracketed(|at| all(at)[2], before.0, at, 0.0)
        {
            let [value, slope, _] = all(turn);
            known.push((turn, (value, slope)));
        }
        known.push((at, (here.1[0], here.1[1])));
        before = Some(here);
    }
    both_ways_from(&known, |at| {
        let [value, slope, _] = all(at);
        (value, slope)
    })
}

/// Whether a slope that has one sign at both ends of a cell, or is 0 at one, may have the other between them.
fn turns_back([_, slope, bend]: [f64; 3], [_, end_slope, end_bend]: [f64; 3]) -> bool {
    let sign = if slope == 0.0 { end_slope } else { slope };
    let inwards = |slope: f64, falls: f64| slope == 0.0 || slope * sign > 0.0 && falls < 0.0;
    bend * sign < 0.0 && end_bend * sign > 0.0 && inwards(slope, bend * sign) && inwards(end_slope, -end_bend * sign)
}

/// Golden sections that shrink a bracket to √ε of its width, where a flat top ends: 0.618 each.
pub const TO_ROUNDING: u32 = 38;

/// The largest value of `value` on `[low, high]` when no derivative is at hand: the best of `cells` + 1 points, then
/// `sections` golden sections between its neighbours (Kiefer 1953).
pub fn largest_without_slope(value: impl FnMut(f64) -> f64, range: (f64, f64), cells: u32, sections: u32) -> Extremum {
    largest_of_hills(value, range, (cells, 1), sections)
}

/// The same about each of the `hills` best of these points that are no lower than their neighbours.
pub fn largest_of_hills(
    mut value: impl FnMut(f64) -> f64,
    (low, high): (f64, f64),
    (cells, hills): (u32, usize),
    sections: u32,
) -> Extremum {
    let at = |cell: u32| low + (high - low) * (f64::from(cell.min(cells)) / f64::from(cells));
    let points: Vec<Extremum> = (0..=cells).map(|cell| Extremum { at: at(cell), value: value(at(cell)) }).collect();
    let height = |cell: Option<u32>| {
        let point = cell.and_then(|cell| points.get(usize::try_from(cell).ok()?));
        point.map_or(f64::NEG_INFINITY, |point| point.value)
    };
    let higher = |one: f64, other: f64| one > other || other.is_nan();
    let is_top = |cell: u32| {
        let here = height(Some(cell));
        !higher(height(cell.checked_sub(1)), here) && !higher(height(Some(cell + 1)), here)
    };
    let mut tops: Vec<(u32, f64)> =
        (0..=cells).filter(|cell| is_top(*cell)).map(|cell| (cell, height(Some(cell)))).collect();
    tops.sort_by(|a, b| b.1.total_cmp(&a.1));
    let first = points.first().copied().unwrap_or(Extremum { at: low, value: f64::NAN });
    let best = |best: Extremum, next: &Extremum| if higher(next.value, best.value) { *next } else { best };
    let mut found = points.iter().fold(first, best);
    for (cell, _) in tops.into_iter().take(hills) {
        let about = (at(cell.saturating_sub(1)), at(cell + 1));
        found = golden_sections(&mut value, about, sections).iter().fold(found, best);
    }
    found
}

/// The two inner points of the last of so many golden sections.
fn golden_sections(
    value: &mut impl FnMut(f64) -> f64,
    (mut left, mut right): (f64, f64),
    sections: u32,
) -> [Extremum; 2] {
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

    /// Two stationary places much nearer to each other than a cell is wide, and one beside a stationary end.
    #[test]
    fn finds_what_the_bend_shows() {
        // x³/3 − (a + b) x²/2 + a b x has its top at a and its valley at b.
        for (a, b) in [(0.4, 0.4001), (1e-7, 2e-5), (0.0, 1e-6), (0.999_99, 1.0)] {
            let cubic = |x: f64| [x * (x * (x / 3.0 - 0.5 * (a + b)) + a * b), (x - a) * (x - b), 2.0 * x - a - b];
            let [top, low] = both_ways_with_bend(|x| cubic(x).map(|y| y), (0.0, 1.0), 7);
            let (valley, hill) = (cubic(b)[0], cubic(a)[0]);
            let ends = [cubic(0.0)[0], cubic(1.0)[0]];
            assert_eq!(-low.value, ends[0].min(ends[1]).min(valley), "{a} {b}: {low:?}");
            assert_eq!(top.value, ends[0].max(ends[1]).max(hill), "{a} {b}: {top:?}");
        }
    }

    /// A rise from rest that dips first, and a hill beside a valley within a cell.
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
