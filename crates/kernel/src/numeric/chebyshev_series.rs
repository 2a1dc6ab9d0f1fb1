//! A smooth function on an interval as a sum of Chebyshev polynomials, with its derivatives.
//!
//! The function is sampled at the points of Gauss; the derivative of a sum is a sum, by c'_{n−1} = c'_{n+1} + 2 n c_n (J. C. Mason,
//! D. C. Handscomb, Chebyshev Polynomials, 2003, ch. 2.4), and a sum is evaluated by Clenshaw's recurrence.

use std::f64::consts::PI;

/// Σ cₙ Tₙ(t), t = −1 … 1 from one end of the interval to the other.
#[derive(Debug, Clone, PartialEq)]
pub struct ChebyshevSeries {
    range: (f64, f64),
    coefficients: Vec<f64>,
}

impl ChebyshevSeries {
    /// The points at which a sum with this many terms agrees with a function.
    #[must_use]
    pub fn points((low, high): (f64, f64), terms: u32) -> Vec<f64> {
        let middle = 0.5 * (low + high);
        (0..terms).map(|i| middle + 0.5 * (high - low) * libm::cos(angle(i, terms))).collect()
    }

    /// The sum that has these values at its [`ChebyshevSeries::points`]; terms below a share of the largest are rounding and left out.
    #[must_use]
    pub fn through(range: (f64, f64), values: &[f64], rounding: f64) -> Self {
        let count = u32::try_from(values.len()).unwrap_or(u32::MAX);
        let coefficients = (0..count).map(|n| {
            let terms = (0..count).zip(values).map(|(i, value)| value * libm::cos(f64::from(n) * angle(i, count)));
            terms.sum::<f64>() * if n == 0 { 1.0 } else { 2.0 } / f64::from(count.max(1))
        });
        let mut coefficients: Vec<f64> = coefficients.collect();
        let least = rounding * coefficients.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
        while coefficients.last().is_some_and(|last| last.abs() <= least) {
            coefficients.pop();
        }
        Self { range, coefficients }
    }

    /// Its derivative.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let count = self.coefficients.len();
        let (low, high) = self.range;
        let per = 2.0 / (high - low);
        let (mut after, mut here) = (0.0, 0.0);
        let mut slopes = Vec::with_capacity(count);
        #[expect(clippy::cast_precision_loss, reason = "a few hundred terms")]
        for (n, coefficient) in self.coefficients.iter().enumerate().skip(1).rev() {
            let slope = after + 2.0 * n as f64 * coefficient;
            slopes.push(slope);
            (after, here) = (here, slope);
        }
        slopes.reverse();
        if let Some(first) = slopes.first_mut() {
            *first *= 0.5;
        }
        Self { range: self.range, coefficients: slopes.into_iter().map(|slope| slope * per).collect() }
    }

    /// Its integral from the start of the interval on, by C_n = (c_{n−1} − c_{n+1})/(2 n).
    #[must_use]
    pub fn integral(&self) -> Self {
        let (low, high) = self.range;
        let half = 0.5 * (high - low);
        let c = |n: usize| self.coefficients.get(n).copied().unwrap_or(0.0) * if n == 0 { 2.0 } else { 1.0 };
        let mut coefficients = vec![0.0];
        #[expect(clippy::cast_precision_loss, reason = "a few hundred terms")]
        coefficients.extend((1..=self.coefficients.len()).map(|n| half * (c(n - 1) - c(n + 1)) / (2.0 * n as f64)));
        let unshifted = Self { range: self.range, coefficients };
        let start = unshifted.value_at(low);
        let mut coefficients = unshifted.coefficients;
        if let Some(first) = coefficients.first_mut() {
            *first -= start;
        }
        Self { range: self.range, coefficients }
    }

    /// How many terms it has.
    #[must_use]
    pub fn terms(&self) -> usize {
        self.coefficients.len()
    }

    /// Its value at a place of the interval.
    #[must_use]
    pub fn value_at(&self, x: f64) -> f64 {
        let (low, high) = self.range;
        let t = ((x - low) - (high - x)) / (high - low);
        let (mut after, mut here) = (0.0, 0.0);
        for coefficient in self.coefficients.iter().skip(1).rev() {
            (after, here) = (here, 2.0 * t * here - after + coefficient);
        }
        self.coefficients.first().map_or(0.0, |first| t * here - after + first)
    }
}

/// Several series on one interval, evaluated together.
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesGroup<const N: usize> {
    range: (f64, f64),
    coefficients: Vec<[f64; N]>,
}

impl<const N: usize> SeriesGroup<N> {
    /// From series on the interval of the first.
    #[must_use]
    pub fn new(all: [&ChebyshevSeries; N]) -> Self {
        let terms = all.iter().map(|series| series.terms()).max().unwrap_or(0);
        let terms = (0..terms).map(|n| all.map(|series| series.coefficients.get(n).copied().unwrap_or(0.0)));
        let range = all.first().map_or((0.0, 1.0), |series| series.range);
        Self { range, coefficients: terms.collect() }
    }

    /// The series that have these values at [`ChebyshevSeries::points`].
    #[must_use]
    pub fn through(range: (f64, f64), values: &[[f64; N]]) -> Self {
        let count = values.len();
        let terms = u32::try_from(count).unwrap_or(u32::MAX);
        // cos(n (i + ½) π/count) has as many values as there are quarters of a turn over the count.
        let cosines: Vec<f64> = (0..4 * terms).map(|k| libm::cos(0.5 * PI * f64::from(k) / f64::from(terms))).collect();
        let coefficients = (0..count).map(|n| {
            let mut sum = [0.0; N];
            for (i, value) in values.iter().enumerate() {
                let cosine = cosines.get(n * (2 * i + 1) % (4 * count)).copied().unwrap_or(f64::NAN);
                sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += cosine * value);
            }
            let share = if n == 0 { 1.0 } else { 2.0 } / f64::from(terms);
            sum.map(|sum| share * sum)
        });
        Self { range, coefficients: coefficients.collect() }
    }

    /// The largest size of this many last coefficients of each.
    #[must_use]
    pub fn last(&self, count: usize) -> [f64; N] {
        let last = self.coefficients.iter().rev().take(count);
        last.fold([0.0; N], |most, terms| std::array::from_fn(|i| most[i].max(terms[i].abs())))
    }

    /// Without the last terms that are smaller than this in each.
    #[must_use]
    pub fn without_terms_below(mut self, least: [f64; N]) -> Self {
        while self.coefficients.last().is_some_and(|last| last.iter().zip(least).all(|(c, least)| c.abs() <= least)) {
            self.coefficients.pop();
        }
        self
    }

    /// Their values at a place of the interval.
    #[must_use]
    pub fn values_at(&self, x: f64) -> [f64; N] {
        let (low, high) = self.range;
        let t = ((x - low) - (high - x)) / (high - low);
        let (mut after, mut here) = ([0.0; N], [0.0; N]);
        for coefficients in self.coefficients.iter().skip(1).rev() {
            let next: [f64; N] = std::array::from_fn(|i| 2.0 * t * here[i] - after[i] + coefficients[i]);
            (after, here) = (here, next);
        }
        let first = self.coefficients.first().copied().unwrap_or([0.0; N]);
        std::array::from_fn(|i| t * here[i] - after[i] + first[i])
    }
}

/// The angle of the point of Gauss with this number, rad.
fn angle(index: u32, count: u32) -> f64 {
    PI * (f64::from(index) + 0.5) / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Series made together are those made one by one, and terms that are left out are missing by no more than their sum.
    #[test]
    fn series_made_together_are_those_made_alone() {
        let range = (-0.5, 2.0);
        let points = ChebyshevSeries::points(range, 40);
        let both: Vec<[f64; 2]> = points.iter().map(|x| [libm::exp(*x), libm::sin(3.0 * x)]).collect();
        let alone = [0, 1].map(|which| {
            let values: Vec<f64> = both.iter().map(|values| values[which]).collect();
            ChebyshevSeries::through(range, &values, 0.0)
        });
        let together = SeriesGroup::through(range, &both);
        assert!(together.last(3).iter().all(|last| *last < 1e-14), "{:?}", together.last(3));
        let shorter = together.clone().without_terms_below([1e-9; 2]);
        assert!(shorter.coefficients.len() < 25 && shorter.coefficients.len() > 10);
        for i in 0..=50 {
            let x = range.0 + 2.5 * f64::from(i) / 50.0;
            let exact = [libm::exp(x), libm::sin(3.0 * x)];
            for (which, exact) in exact.into_iter().enumerate() {
                // Forty terms of sums up to e².
                assert!((together.values_at(x)[which] - exact).abs() < 5e-14, "{x}");
                assert!((together.values_at(x)[which] - alone[which].value_at(x)).abs() < 5e-14, "{x}");
                assert!((shorter.values_at(x)[which] - exact).abs() < 1e-8, "{x}");
            }
        }
    }

    /// e^x sin 3x and three derivatives, to rounding times the square of the terms for each.
    #[test]
    fn a_sum_has_the_derivatives_of_its_function() {
        let range = (-0.5, 2.0);
        let values: Vec<f64> =
            ChebyshevSeries::points(range, 40).iter().map(|x| libm::exp(*x) * libm::sin(3.0 * x)).collect();
        let sum = ChebyshevSeries::through(range, &values, 1e-16);
        let (first, second) = (sum.derivative(), sum.derivative().derivative());
        let together = SeriesGroup::new([&sum, &first, &second]);
        for i in 0..=50 {
            let x = range.0 + 2.5 * f64::from(i) / 50.0;
            let (e, sin, cos) = (libm::exp(x), libm::sin(3.0 * x), libm::cos(3.0 * x));
            assert!((sum.value_at(x) - e * sin).abs() < 1e-13, "{x}");
            assert!((first.value_at(x) - e * (sin + 3.0 * cos)).abs() < 1e-11, "{x}");
            assert!((second.value_at(x) - e * (6.0 * cos - 8.0 * sin)).abs() < 1e-9, "{x}");
            assert_eq!(together.values_at(x), [sum.value_at(x), first.value_at(x), second.value_at(x)]);
            // ∫ e^x sin 3x dx = e^x (sin 3x − 3 cos 3x)/10.
            let primitive = |x: f64| 0.1 * libm::exp(x) * (libm::sin(3.0 * x) - 3.0 * libm::cos(3.0 * x));
            let integral = primitive(x) - primitive(range.0);
            assert!((sum.integral().value_at(x) - integral).abs() < 1e-13, "{x}");
        }
    }
}
