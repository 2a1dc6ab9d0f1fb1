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

/// The largest value of `value` on `[low, high]`.
///
/// `slope` is the derivative of `value`, or anything with the same sign. The interval is cut into `cells`; every cell
/// in which the slope falls through zero gives a candidate, solved to rounding by [`root::bracketed`], beside the ends
/// of the cells. Two stationary points within one cell hide each other: choose `cells` so that a cell is shorter than
/// the distance between extrema (a cam law has a handful a piece).
pub fn largest(
    mut value: impl FnMut(f64) -> f64,
    mut slope: impl FnMut(f64) -> f64,
    (low, high): (f64, f64),
    cells: u32,
) -> Extremum {
    let mut best = Extremum { at: low, value: value(low) };
    let mut consider = |at: f64, v: f64| {
        if v > best.value || best.value.is_nan() {
            best = Extremum { at, value: v };
        }
    };
    let (mut left, mut left_slope) = (low, slope(low));
    for cell in 1..=cells {
        let right = if cell == cells { high } else { low + (high - low) * (f64::from(cell) / f64::from(cells)) };
        let right_slope = slope(right);
        consider(right, value(right));
        if left_slope > 0.0
            && right_slope < 0.0
            && let Ok(at) = root::bracketed(&mut slope, left, right, 0.0)
        {
            consider(at, value(at));
        }
        (left, left_slope) = (right, right_slope);
    }
    best
}

/// Golden sections that shrink a bracket to √ε of its width, where a flat top ends: 0.618 each.
pub const TO_ROUNDING: u32 = 38;

/// The largest value of `value` on `[low, high]` when no derivative is at hand: the best of `cells` + 1 points, then
/// `sections` golden sections between its neighbours (Kiefer 1953).
pub fn largest_without_slope(
    mut value: impl FnMut(f64) -> f64,
    (low, high): (f64, f64),
    cells: u32,
    sections: u32,
) -> Extremum {
    let at = |cell: u32| low + (high - low) * (f64::from(cell.min(cells)) / f64::from(cells));
    let mut best = Extremum { at: low, value: value(low) };
    let mut best_cell = 0;
    for cell in 1..=cells {
        let v = value(at(cell));
        if v > best.value || best.value.is_nan() {
            (best, best_cell) = (Extremum { at: at(cell), value: v }, cell);
        }
    }
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut left, mut right) = (at(best_cell.saturating_sub(1)), at(best_cell + 1));
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
    [inner, outer].into_iter().fold(best, |best, next| if next.value > best.value { next } else { best })
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
}
