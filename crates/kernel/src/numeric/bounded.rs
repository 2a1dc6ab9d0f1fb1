//! The least value of a convex quadratic form under linear bounds, by an interior point: the predictor and corrector of S. Mehrotra, "On the
//! implementation of a primal-dual interior point method", SIAM J. Optim. 2 (1992), as in J. Nocedal, S. J. Wright, Numerical Optimization,
//! 2nd ed. (2006), §16.6.
//!
//! Each bound has unknowns within the band of the form, so that a step costs one banded factorization: the work is linear in the unknowns,
//! and some 10 to 30 steps are needed whatever their number. Every step stays strictly inside of the bounds; a search that begins outside of some
//! reduces what they are missed by with each step.

use super::banded::{BandedFactors, BandedMatrix};

/// A bound: the sum of some unknowns times their factors is at most `most`.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Unknowns and their factors; all unknowns of a bound lie within the band.
    pub terms: Vec<(usize, f64)>,
    /// The largest sum.
    pub most: f64,
}

impl Bound {
    /// The sum over values of the unknowns.
    #[must_use]
    pub fn sum(&self, values: &[f64]) -> f64 {
        self.terms.iter().map(|(index, factor)| factor * values.get(*index).copied().unwrap_or(0.0)).sum()
    }
}

/// ½ xᵀ Q x + cᵀ x + a constant: where the least value is 0 or above, what is left to gain can be compared with it.
#[derive(Debug, Clone)]
pub struct QuadraticForm<const W: usize> {
    /// Q, positive semidefinite.
    pub matrix: BandedMatrix<W>,
    /// c.
    pub linear: Vec<f64>,
    /// The constant.
    pub constant: f64,
}

impl<const W: usize> QuadraticForm<W> {
    /// The form 0 of this many unknowns.
    #[must_use]
    pub fn zero(unknowns: usize) -> Self {
        Self { matrix: BandedMatrix::zero(unknowns), linear: vec![0.0; unknowns], constant: 0.0 }
    }

    /// Adds ½ weight (Σ factor × unknown + constant)².
    pub fn add_square(&mut self, weight: f64, terms: &[(usize, f64)], constant: f64) {
        self.constant += 0.5 * weight * constant * constant;
        for (at, (row, factor)) in terms.iter().enumerate() {
            if let Some(slot) = self.linear.get_mut(*row) {
                *slot += weight * factor * constant;
            }
            for (second, (column, other)) in terms.iter().enumerate().skip(at) {
                // Two terms of one unknown share one entry.
                let both = if row == column && at != second { 2.0 } else { 1.0 };
                self.matrix.add(*row, *column, both * weight * factor * other);
            }
        }
    }

    fn gradient(&self, x: &[f64]) -> Vec<f64> {
        self.matrix.times(x).iter().zip(&self.linear).map(|(own, linear)| own + linear).collect()
    }

    fn value(&self, x: &[f64], gradient: &[f64]) -> f64 {
        0.5 * (product(gradient, x) + product(&self.linear, x)) + self.constant
    }
}

/// Most steps: hard cases take half as many.
const MOST_STEPS: u32 = 80;
/// What may be left to gain, as a share of the value.
const LEFT: f64 = 1e-6;
/// The same share for a search from outside, whose result needs less accuracy.
const LEFT_FROM_OUTSIDE: f64 = 1e-4;
/// With which share of its bound a slack begins that is not there.
const OUTSIDE: f64 = 0.01;
/// Share of its bound by which a slack may be wrong in the end.
const MISSED: f64 = 1e-9;
/// Share of the way to the nearest bound that a step goes.
const INSIDE: f64 = 0.995;

/// The unknowns of the least value, from some that lie strictly inside of every bound. Where rounding ends the search early, the best found,
/// which keeps every bound too.
#[must_use]
pub fn least<const W: usize>(form: &QuadraticForm<W>, bounds: &[Bound], x: Vec<f64>) -> Vec<f64> {
    let slack = bounds.iter().map(|bound| bound.most - bound.sum(&x)).collect();
    search(form, SearchPoint { bounds, x, slack, weights: Vec::new(), missed: Vec::new() }, LEFT)
}

/// As the search above, but from any unknowns and less accurate; `None` where no unknowns strictly inside every bound are found. Each
/// bound must be positive.
#[must_use]
pub fn least_from_outside<const W: usize>(form: &QuadraticForm<W>, bounds: &[Bound], x: Vec<f64>) -> Option<Vec<f64>> {
    let slack: Vec<f64> = bounds.iter().map(|bound| (bound.most - bound.sum(&x)).max(OUTSIDE * bound.most)).collect();
    let missed = missed(bounds, &x, &slack);
    let x = search(form, SearchPoint { bounds, x, slack, weights: Vec::new(), missed }, LEFT_FROM_OUTSIDE);
    bounds.iter().all(|bound| bound.sum(&x) < bound.most).then_some(x)
}

/// Where a search is.
struct SearchPoint<'a> {
    bounds: &'a [Bound],
    x: Vec<f64>,
    /// What is left to each bound, and its multiplier; both positive.
    slack: Vec<f64>,
    weights: Vec<f64>,
    /// By how much each slack is more than what is left; empty where the search began inside of every bound.
    missed: Vec<f64>,
}

/// A change of unknowns, slacks and multipliers.
type SearchStep = (Vec<f64>, Vec<f64>, Vec<f64>);

fn missed(bounds: &[Bound], x: &[f64], slack: &[f64]) -> Vec<f64> {
    bounds.iter().zip(slack).map(|(bound, slack)| slack - (bound.most - bound.sum(x))).collect()
}

impl SearchPoint<'_> {
    /// The matrix of a step.
    fn factors<const W: usize>(&self, form: &QuadraticForm<W>) -> BandedFactors<W> {
        let mut matrix = form.matrix.clone();
        for (bound, (slack, weight)) in self.bounds.iter().zip(self.slack.iter().zip(&self.weights)) {
            for (at, (row, factor)) in bound.terms.iter().enumerate() {
                for (column, other) in bound.terms.iter().skip(at) {
                    matrix.add(*row, *column, weight / slack * factor * other);
                }
            }
        }
        matrix.factored()
    }

    /// The step to where slack times multiplier of each bound is `wanted`, which is σμ − Δs Δz; what is missed goes away with a whole step.
    fn step<const W: usize>(&self, factors: &BandedFactors<W>, residual: &[f64], wanted: &[f64]) -> SearchStep {
        let all = self.weights.iter().zip(self.slack.iter().zip(wanted));
        // An infinite chain of zeros where nothing is missed.
        let missed = self.missed.iter().copied().chain(std::iter::repeat(0.0));
        let pull: Vec<f64> =
            all.clone().zip(missed.clone()).map(|((z, (s, w)), missed)| z - w / s - z / s * missed).collect();
        let less: Vec<f64> = residual.iter().map(|value| -value).collect();
        let mut by = with_bounds(&less, self.bounds, &pull);
        factors.solve(&mut by);
        let of_slack: Vec<f64> =
            self.bounds.iter().zip(missed).map(|(bound, missed)| -bound.sum(&by) - missed).collect();
        let of_weights = all.zip(&of_slack).map(|((z, (s, w)), ds)| w / s - z - z / s * ds).collect();
        (by, of_slack, of_weights)
    }

    /// A share of a step further; whether that is possible.
    fn advance(&mut self, (by, ds, dz): &SearchStep, far: f64) -> bool {
        let next = moved(&self.x, by, far);
        let left: Vec<f64> = if self.missed.is_empty() {
            self.bounds.iter().map(|bound| bound.most - bound.sum(&next)).collect()
        } else {
            moved(&self.slack, ds, far)
        };
        if !(far > 1e-12) || !left.iter().all(|left| *left > 0.0) || !next.iter().all(|value| value.is_finite()) {
            return false;
        }
        (self.x, self.slack) = (next, left);
        for (weight, by) in self.weights.iter_mut().zip(dz) {
            *weight += far * by;
        }
        if !self.missed.is_empty() {
            self.missed = missed(self.bounds, &self.x, &self.slack);
        }
        true
    }
}

/// The unknowns of the least value from a point on, up to a share of the value.
fn search<const W: usize>(form: &QuadraticForm<W>, mut point: SearchPoint<'_>, least: f64) -> Vec<f64> {
    let bounds = point.bounds;
    let mut gradient = form.gradient(&point.x);
    let steepest = gradient.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
    point.weights = point.slack.iter().map(|_| 0.1 * steepest + f64::MIN_POSITIVE).collect();
    let count = f64::from(u32::try_from(bounds.len().max(1)).unwrap_or(u32::MAX));
    for _ in 0..MOST_STEPS {
        let gap = product(&point.slack, &point.weights);
        let residual: Vec<f64> = with_bounds(&gradient, bounds, &point.weights);
        let off = residual.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
        let inside = point.missed.iter().zip(bounds).all(|(missed, bound)| missed.abs() <= MISSED * bound.most);
        if inside && gap <= least * form.value(&point.x, &gradient).abs() && off <= least * steepest {
            break;
        }
        let factors = point.factors(form);
        let (_, ds, dz) = point.step(&factors, &residual, &vec![0.0; bounds.len()]);
        let far = reach(&point.slack, &ds).min(reach(&point.weights, &dz));
        let then = product(&moved(&point.slack, &ds, far), &moved(&point.weights, &dz, far));
        let centre = (then / gap) * (then / gap) * (then / gap) * gap / count;
        let wanted: Vec<f64> = ds.iter().zip(&dz).map(|(ds, dz)| centre - ds * dz).collect();
        let step = point.step(&factors, &residual, &wanted);
        let far = (INSIDE * reach(&point.slack, &step.1).min(reach(&point.weights, &step.2))).min(1.0);
        if !point.advance(&step, far) {
            break;
        }
        gradient = form.gradient(&point.x);
    }
    point.x
}

/// Some values, a share of a step further.
fn moved(values: &[f64], step: &[f64], share: f64) -> Vec<f64> {
    values.iter().zip(step).map(|(value, step)| value + share * step).collect()
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A gradient with those of the bounds, each times its weight.
fn with_bounds(gradient: &[f64], bounds: &[Bound], weights: &[f64]) -> Vec<f64> {
    let mut sum = gradient.to_vec();
    for (bound, weight) in bounds.iter().zip(weights) {
        for (index, factor) in &bound.terms {
            if let Some(slot) = sum.get_mut(*index) {
                *slot += weight * factor;
            }
        }
    }
    sum
}

/// How far positive values may go by their steps until the first is 0, at most 1.
fn reach(values: &[f64], steps: &[f64]) -> f64 {
    let ways = values.iter().zip(steps).filter(|(_, step)| **step < 0.0).map(|(value, step)| -value / step);
    ways.fold(1.0, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The point of a box and a half plane that is nearest to another one.
    #[test]
    fn the_nearest_point_within_bounds_is_found() {
        let mut form = QuadraticForm::<2>::zero(2);
        form.add_square(1.0, &[(0, 1.0)], -4.0);
        form.add_square(1.0, &[(1, 1.0)], -2.0);
        let bound = |terms: &[(usize, f64)], most: f64| Bound { terms: terms.to_vec(), most };
        let bounds = [bound(&[(0, 1.0)], 1.5), bound(&[(0, 1.0), (1, 1.0)], 2.0), bound(&[(1, -1.0)], 0.0)];
        let found = least(&form, &bounds, vec![0.1, 0.1]);
        // On the line x + y = 2 the nearest is (1.5, 0.5), a corner of the first two bounds.
        assert!((found[0] - 1.5).abs() < 1e-6 && (found[1] - 0.5).abs() < 1e-6, "{found:?}");
        // From outside of both.
        let positive = [bound(&[(0, 1.0)], 1.5), bound(&[(0, 1.0), (1, 1.0)], 2.0), bound(&[(1, -1.0)], 3.0)];
        let found = least_from_outside(&form, &positive, vec![9.0, 7.0]).expect("a point");
        assert!((found[0] - 1.5).abs() < 1e-3 && (found[1] - 0.5).abs() < 1e-3, "{found:?}");
        let free = least(&form, &[bound(&[(0, 1.0)], 10.0)], vec![0.0, 0.0]);
        assert!((free[0] - 4.0).abs() < 1e-5 && (free[1] - 2.0).abs() < 1e-5, "{free:?}");
    }
}
