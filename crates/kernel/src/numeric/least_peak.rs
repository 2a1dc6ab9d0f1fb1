//! The least peak of a function on an interval that depends linearly on a few weights.
//!
//! A linear program on a set of places bounds the peak from below, the function that it gives bounds it from above; the extremes of that
//! function join the set until both agree (the exchange of E. W. Cheney and A. A. Goldstein, Numerische Mathematik 1 (1959) 253–268). The
//! value is found this way, but where it is flat the weights are not: they have half its digits. Newton's method on the conditions of an
//! optimum, with the places of the extremes among its unknowns, gives the other half (R. Hettich and K. O. Kortanek, "Semi-infinite
//! programming", SIAM Review 35 (1993) 380–429, §7.3). The prices of the extremes then prove that no other weights have a smaller peak.

use super::linear::solutions;
use super::root;
use super::simplex::{self, Inequality};

/// Bounds of the peak that differ by less than this share agree.
const AGREED: f64 = 1e-13;
/// Newton's method is tried from this difference on.
const NEAR: f64 = 1e-3;
/// Rounds of the exchange: it takes five to ten.
const ROUNDS: u32 = 50;
/// Steps of Newton's method: it takes four to six.
const STEPS: u32 = 20;
/// An extreme with a smaller price does not bind.
const PRICED: f64 = 1e-7;

/// The weights of least peak.
#[derive(Debug, Clone, PartialEq)]
pub struct LeastPeak {
    /// Weight of every function but the first.
    pub weights: Vec<f64>,
    /// The largest size of the sum.
    pub peak: f64,
}

/// The sum of a function and weighted others.
pub struct LeastPeakProblem<F> {
    /// The derivative of an order at a place: of the function without weight, then of the others.
    pub functions: F,
    /// Number of the weighted functions.
    pub others: usize,
    /// The interval.
    pub range: (f64, f64),
    /// Number of cells in which its extremes are searched.
    pub cells: u32,
}

/// A place at an end of the interval, or where the slope is 0, with the value there.
#[derive(Debug, Clone, Copy)]
struct LocalExtreme {
    at: f64,
    value: f64,
    inner: bool,
}

/// An extreme that binds.
#[derive(Debug, Clone, Copy)]
struct BindingExtreme {
    at: f64,
    inner: bool,
    sign: f64,
    price: f64,
}

/// Unknowns of Newton's method.
struct NewtonPoint {
    weights: Vec<f64>,
    peak: f64,
    bindings: Vec<BindingExtreme>,
}

impl<F: Fn(f64, u32) -> Vec<f64>> LeastPeakProblem<F> {
    /// The weights of least peak; `None` where there is no solution to rounding.
    pub fn solve(&self) -> Option<LeastPeak> {
        if self.others == 0 {
            return Some(LeastPeak { weights: Vec::new(), peak: largest(&self.tops(&[])) });
        }
        let mut places: Vec<f64> = (0..=self.cells).map(|cell| self.place(cell)).collect();
        for _ in 0..ROUNDS {
            let (weights, bound, prices) = self.program(&places)?;
            let tops = self.tops(&weights);
            let peak = largest(&tops);
            if peak <= bound * (1.0 + NEAR) {
                let bindings = binding(&tops, &places, &prices);
                let polished = self.polished(NewtonPoint { weights: weights.clone(), peak, bindings });
                if polished.is_some() || peak <= bound * (1.0 + AGREED) {
                    return Some(polished.unwrap_or(LeastPeak { weights, peak }));
                }
            }
            places.extend(tops.iter().filter(|top| top.value.abs() > bound).map(|top| top.at));
        }
        None
    }

    fn place(&self, cell: u32) -> f64 {
        let (low, high) = self.range;
        if cell >= self.cells { high } else { low + (high - low) * (f64::from(cell) / f64::from(self.cells)) }
    }

    /// The sum's derivative of an order.
    fn derivative_at(&self, weights: &[f64], place: f64, order: u32) -> f64 {
        let all = (self.functions)(place, order);
        all.iter().zip(std::iter::once(&1.0).chain(weights)).map(|(value, weight)| value * weight).sum()
    }

    /// Where the sum can have its peak.
    fn tops(&self, weights: &[f64]) -> Vec<LocalExtreme> {
        let places = (0..=self.cells).map(|cell| self.place(cell));
        let nodes: Vec<(f64, f64)> = places.map(|at| (at, self.derivative_at(weights, at, 1))).collect();
        let cells = nodes.iter().zip(nodes.iter().skip(1)).filter(|(low, high)| low.1 * high.1 <= 0.0);
        let inner = cells.filter_map(|(low, high)| {
            root::bracketed(|at| self.derivative_at(weights, at, 1), low.0, high.0, 0.0).ok()
        });
        let all = inner.map(|at| (at, true)).chain([(self.range.0, false), (self.range.1, false)]);
        all.map(|(at, inner)| LocalExtreme { at, value: self.derivative_at(weights, at, 0), inner }).collect()
    }

    /// The weights of least peak on a set of places, that peak, and the prices of the places: above 0 for a place where the sum is positive,
    /// below where it is negative.
    fn program(&self, places: &[f64]) -> Option<(Vec<f64>, f64, Vec<f64>)> {
        let mut rows = Vec::with_capacity(2 * places.len());
        for (place, sign) in places.iter().flat_map(|place| [(*place, 1.0), (*place, -1.0)]) {
            let all: Vec<f64> = (self.functions)(place, 0).iter().map(|value| sign * value).collect();
            let (own, others) = all.split_first()?;
            // A weight of any sign is the difference of two that are not negative.
            let coefficients = others.iter().copied().chain(others.iter().map(|value| -value)).chain([-1.0]).collect();
            rows.push(Inequality { coefficients, right: -own });
        }
        let bound = 2 * self.others;
        let costs: Vec<f64> = (0..=bound).map(|index| if index == bound { 1.0 } else { 0.0 }).collect();
        let found = simplex::least(&costs, &rows, &[bound])?;
        let (up, down) = found.unknowns.split_at_checked(self.others)?;
        let weights = up.iter().zip(down).map(|(up, down)| up - down).collect();
        let prices = found.prices.chunks_exact(2).map(|pair| pair.iter().fold(0.0, |before, price| price - before));
        Some((weights, *found.unknowns.get(bound)?, prices.map(|price| -price).collect()))
    }

    /// The optimum near a point, where there is one.
    fn polished(&self, mut point: NewtonPoint) -> Option<LeastPeak> {
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let step = self.step(&mut point)?;
            if step <= f64::EPSILON || (step >= before && step < NEAR * NEAR) {
                break;
            }
            before = step;
        }
        let peak = largest(&self.tops(&point.weights));
        let proved = point.bindings.iter().all(|binding| binding.price >= -PRICED);
        (proved && peak <= point.peak * (1.0 + AGREED)).then_some(LeastPeak { weights: point.weights, peak })
    }

    /// A step of Newton's method, and how long it was as a share of the largest weight.
    fn step(&self, point: &mut NewtonPoint) -> Option<f64> {
        let (others, count) = (self.others, point.bindings.len());
        let unknowns = others + 1 + 2 * count;
        let mut equations: Vec<(Vec<f64>, f64)> = vec![(vec![0.0; unknowns], 0.0); others];
        let mut whole = (vec![0.0; unknowns], 1.0);
        for (index, binding) in point.bindings.iter().enumerate() {
            let sign = binding.sign;
            // Columns of the unknowns of this extreme.
            let (place, price) = (others + 1 + index, others + 1 + count + index);
            let [values, slopes] = [0, 1].map(|order| (self.functions)(binding.at, order));
            let [value, slope, bend] = [0, 1, 2].map(|order| self.derivative_at(&point.weights, binding.at, order));
            // The peak is reached there …
            let mut reached = vec![0.0; unknowns];
            // … with the slope 0, except at an end.
            let mut flat = vec![0.0; unknowns];
            for (own, (value, slope)) in values.iter().zip(&slopes).skip(1).enumerate() {
                *reached.get_mut(own)? = sign * value;
                *flat.get_mut(own)? = if binding.inner { *slope } else { 0.0 };
                // The prices admit no direction of descent.
                let (row, right) = equations.get_mut(own)?;
                *row.get_mut(place)? = if binding.inner { binding.price * sign * slope } else { 0.0 };
                *row.get_mut(price)? = sign * value;
                *right -= binding.price * sign * value;
            }
            *reached.get_mut(others)? = -1.0;
            *reached.get_mut(place)? = if binding.inner { sign * slope } else { 0.0 };
            *flat.get_mut(place)? = if binding.inner { bend } else { 1.0 };
            *whole.0.get_mut(price)? = 1.0;
            whole.1 -= binding.price;
            equations.push((reached, point.peak - sign * value));
            equations.push((flat, if binding.inner { -slope } else { 0.0 }));
        }
        equations.push(whole);
        let change = solutions(&equations, unknowns)?.particular;
        let (weights, rest) = change.split_at_checked(others)?;
        let (peak, rest) = rest.split_first()?;
        let (places, prices) = rest.split_at_checked(count)?;
        point.weights.iter_mut().zip(weights).for_each(|(weight, change)| *weight += change);
        point.peak += peak;
        for (binding, (at, price)) in point.bindings.iter_mut().zip(places.iter().zip(prices)) {
            binding.at = (binding.at + at).clamp(self.range.0, self.range.1);
            binding.price += price;
        }
        let [change, size] =
            [weights, &point.weights].map(|all| all.iter().fold(0.0_f64, |largest, value| largest.max(value.abs())));
        Some(change / size)
    }
}

fn largest(tops: &[LocalExtreme]) -> f64 {
    tops.iter().fold(0.0_f64, |largest, top| largest.max(top.value.abs()))
}

/// The extremes to which the places with a price belong: each to the nearest of its sign.
fn binding(tops: &[LocalExtreme], places: &[f64], prices: &[f64]) -> Vec<BindingExtreme> {
    let mut all: Vec<BindingExtreme> = tops
        .iter()
        .map(|top| BindingExtreme { at: top.at, inner: top.inner, sign: top.value.signum(), price: 0.0 })
        .collect();
    for (place, price) in places.iter().zip(prices) {
        let own = all.iter_mut().filter(|binding| binding.sign * price > 0.0);
        let nearest = own.min_by(|a, b| (a.at - place).abs().total_cmp(&(b.at - place).abs()));
        if let Some(nearest) = nearest {
            nearest.price += price.abs();
        }
    }
    all.retain(|binding| binding.price > PRICED);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x^n less its best approximation of lower degree on [−1, 1] is the Chebyshev polynomial over 2^(n−1).
    #[test]
    fn the_least_peak_of_a_power_is_that_of_chebyshev() {
        for degree in 1..9_u32 {
            let power = |n: u32, x: f64, order: u32| {
                let factor: f64 = (0..order).map(|k| f64::from(n.saturating_sub(k))).product();
                if order > n { 0.0 } else { factor * x.powi(n.cast_signed() - order.cast_signed()) }
            };
            let functions = |x: f64, order: u32| (0..=degree).rev().map(|n| power(n, x, order)).collect();
            let problem = LeastPeakProblem {
                functions,
                others: usize::try_from(degree).expect("few"),
                range: (-1.0, 1.0),
                cells: 64,
            };
            let found = problem.solve().expect("an optimum");
            let known = 2.0 / f64::from(1 << degree);
            assert!((found.peak / known - 1.0).abs() < 1e-12, "{degree}: {found:?}");
            // T₄ = 8 x⁴ − 8 x² + 1.
            if degree == 4 {
                for (found, known) in found.weights.iter().zip([0.0, -1.0, 0.0, 0.125]) {
                    assert!((found - known).abs() < 1e-14, "{found} {known}");
                }
            }
        }
    }

    /// Where all functions of a family cross, one extreme binds alone: 1 + w x on [−1, 1] is least at w = 0, and flat there.
    #[test]
    fn weights_are_found_where_the_peak_is_flat() {
        // 1 − x² + w x: the peak at w = 0 is 1, and 1 + w²/4 near it.
        let functions = |x: f64, order: u32| match order {
            0 => vec![1.0 - (x - 0.3) * (x - 0.3), x - 0.3],
            1 => vec![-2.0 * (x - 0.3), 1.0],
            _ => vec![-2.0, 0.0],
        };
        let found =
            LeastPeakProblem { functions, others: 1, range: (-1.0, 1.0), cells: 16 }.solve().expect("an optimum");
        assert!(found.weights[0].abs() < 1e-15 && (found.peak - 1.0).abs() < 1e-15, "{found:?}");
    }
}
