//! A function on an interval as a sum of Legendre polynomials, and its Fourier integral.
//!
//! ∫ P_n(t) e^{izt} dt over [−1, 1] is 2 iⁿ j_n(z) with the spherical Bessel functions j_n (Abramowitz & Stegun, 10.1.14), so that the
//! Fourier integral of a polynomial is a sum of n + 1 terms without cancellation at any frequency: integration by parts divides by powers
//! of a small frequency, quadrature fails at a large one.

use nalgebra::Complex;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Points of the Gauss–Legendre rule, and terms of a series: exact for polynomials up to degree 15.
pub const TERMS: usize = 16;

/// A series is resolved where its last two coefficients are below this share of the largest.
const RESOLVED: f64 = 1e-13;
/// Most halvings of an interval: a function that is not smooth costs no more.
const MOST_HALVINGS: u32 = 8;
/// Newton steps to a node: each doubles the digits of the first guess, which has three.
const NEWTON_STEPS: usize = 6;
/// Orders above the argument from which the recursion downwards has all digits (Miller).
const ABOVE: u32 = 24;

/// Nodes with weights times P_n there, n = 0 …
struct GaussRule {
    nodes: Vec<(f64, [f64; TERMS])>,
}

/// P_0(x) … P_n−1(x) by their recursion.
fn polynomials(x: f64) -> [f64; TERMS] {
    let mut all = [1.0; TERMS];
    let (mut before, mut here) = (0.0, 1.0);
    for (n, place) in (0..).map(f64::from).zip(all.iter_mut()) {
        *place = here;
        (before, here) = (here, ((2.0 * n + 1.0) * x * here - n * before) / (n + 1.0));
    }
    all
}

fn rule() -> &'static GaussRule {
    static RULE: OnceLock<GaussRule> = OnceLock::new();
    RULE.get_or_init(|| {
        #[expect(clippy::cast_precision_loss, reason = "sixteen")]
        let count = TERMS as f64;
        let nodes = (0..).map(f64::from).take(TERMS).map(|index| {
            let mut x = libm::cos(PI * (index + 0.75) / (count + 0.5));
            let mut slope = 1.0;
            for _ in 0..NEWTON_STEPS {
                let last = polynomials(x);
                let (high, low) = (last.last().copied().unwrap_or(0.0), last.iter().rev().nth(1).copied());
                // P of the order of the rule, and its derivative.
                let value = ((2.0 * count - 1.0) * x * high - (count - 1.0) * low.unwrap_or(0.0)) / count;
                slope = count * (x * value - high) / (x * x - 1.0);
                x -= value / slope;
            }
            let weight = 2.0 / ((1.0 - x * x) * slope * slope);
            (x, polynomials(x).map(|p| weight * p))
        });
        GaussRule { nodes: nodes.collect() }
    })
}

/// A polynomial on an interval.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendreSeries {
    middle: f64,
    half: f64,
    /// Coefficients of P_0, P_1, …
    coefficients: Vec<f64>,
}

impl LegendreSeries {
    /// A straight line by its value in the middle of an interval and its slope.
    #[must_use]
    pub fn line((low, high): (f64, f64), value: f64, slope: f64) -> Self {
        let half = 0.5 * (high - low);
        Self { middle: 0.5 * (low + high), half, coefficients: vec![value, slope * half] }
    }

    /// Series of a smooth function on an interval, halved until each equals the function to rounding; a polynomial up to degree 13 gives
    /// one series.
    #[must_use]
    pub fn expand(function: &dyn Fn(f64) -> f64, range: (f64, f64)) -> Vec<Self> {
        let mut found = Vec::new();
        let mut waiting = vec![(range, 0)];
        while let Some(((low, high), halvings)) = waiting.pop() {
            let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
            let mut coefficients = vec![0.0; TERMS];
            for (x, row) in &rule().nodes {
                let value = function(middle + half * x);
                for (sum, weighed) in coefficients.iter_mut().zip(row) {
                    *sum += value * weighed;
                }
            }
            for (n, coefficient) in (0..).map(f64::from).zip(&mut coefficients) {
                *coefficient *= n + 0.5;
            }
            let largest = coefficients.iter().fold(0.0_f64, |largest, c| largest.max(c.abs()));
            let last = coefficients.iter().rev().take(2).fold(0.0_f64, |largest, c| largest.max(c.abs()));
            if last <= RESOLVED * largest || halvings == MOST_HALVINGS {
                found.push(Self { middle, half, coefficients });
            } else {
                waiting.extend([((middle, high), halvings + 1), ((low, middle), halvings + 1)]);
            }
        }
        found
    }

    /// ∫ f(x) e^{iwx} dx over the interval.
    #[must_use]
    pub fn transform(&self, w: f64) -> Complex<f64> {
        let turn = [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0), Complex::new(-1.0, 0.0), Complex::new(0.0, -1.0)];
        let bessel = spherical_bessel(w * self.half, self.coefficients.len());
        let terms = self.coefficients.iter().zip(&bessel).zip(turn.iter().cycle());
        let sum: Complex<f64> = terms.map(|((coefficient, j), power)| power * (coefficient * j)).sum();
        let (sin, cos) = libm::sincos(w * self.middle);
        sum * Complex::new(cos, sin) * (2.0 * self.half)
    }
}

/// sin x / x.
#[must_use]
pub fn sinc(x: f64) -> f64 {
    // Below this, the first two terms are 1 to rounding.
    if x.abs() < 1e-8 { 1.0 } else { libm::sin(x) / x }
}

/// This many spherical Bessel functions j_0(z), j_1(z), …: upwards by their recursion where z exceeds every order, otherwise downwards from
/// far above (W. Gautschi, SIAM Review 9, 1967).
#[must_use]
pub fn spherical_bessel(z: f64, count: usize) -> Vec<f64> {
    let orders = u32::try_from(count).unwrap_or(u32::MAX);
    let size = z.abs();
    let odd_sign = if z < 0.0 { -1.0 } else { 1.0 };
    if size > f64::from(orders) {
        let (sin, cos) = libm::sincos(size);
        let (mut here, mut next) = (sin / size, (sin / size - cos) / size);
        let mut all = Vec::with_capacity(count);
        for n in 0..orders {
            all.push(if n.is_multiple_of(2) { here } else { odd_sign * here });
            (here, next) = (next, (2.0 * f64::from(n) + 3.0) / size * next - here);
        }
        return all;
    }
    if size == 0.0 {
        return (0..orders).map(|n| if n == 0 { 1.0 } else { 0.0 }).collect();
    }
    // Ratios j_n/j_n−1 from above: no overflow, however small z is.
    let mut ratios = Vec::with_capacity(count);
    let mut ratio = 0.0;
    for n in (1..orders + ABOVE).rev() {
        ratio = size / (2.0 * f64::from(n) + 1.0 - size * ratio);
        if n < orders {
            ratios.push(ratio);
        }
    }
    // sin z/z is near 0 where j_1 is not: both are then computed from cos z.
    let (sin, cos) = libm::sincos(size);
    let zeroth = if sin.abs() > 0.1 * size.min(1.0) { sin / size } else { -cos / (size * ratio - 1.0) };
    let mut value = zeroth;
    let mut all: Vec<f64> = vec![value];
    for (n, ratio) in (1_u32..).zip(ratios.iter().rev()) {
        value *= ratio;
        all.push(if n.is_multiple_of(2) { value } else { odd_sign * value });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ x^k e^{iwx} with so many Gauss panels that the error vanishes.
    fn brute(function: &dyn Fn(f64) -> f64, range: (f64, f64), w: f64) -> Complex<f64> {
        let part = |f: fn(f64) -> f64| crate::numeric::quadrature::integrate(|x| function(x) * f(w * x), range, 1300);
        Complex::new(part(libm::cos), part(libm::sin))
    }

    #[test]
    fn bessel_functions_are_those_of_the_closed_forms() {
        for z in
            [1e-9, 1e-3, 0.1, 0.7, 1.0, 3.0, std::f64::consts::PI, 4.4934, 6.3, 9.5, 15.9, 16.1, 40.0, 1000.0, -2.0]
        {
            let found = spherical_bessel(z, TERMS);
            assert_eq!(found.len(), TERMS);
            // Σ (2n+1) j_n² = 1 over all orders, and j_0, j_1, j_2 in closed form where they keep their digits.
            if z.abs() < 5.0 {
                let sum: f64 = (0..).map(f64::from).zip(&found).map(|(n, j)| (2.0 * n + 1.0) * j * j).sum();
                assert!((sum - 1.0).abs() < 1e-14, "{z}: {sum}");
            }
            if z.abs() > 0.5 {
                let (s, c) = (libm::sin(z), libm::cos(z));
                let known = [s / z, s / (z * z) - c / z, (3.0 / (z * z) - 1.0) * s / z - 3.0 * c / (z * z)];
                for (n, (j, known)) in found.iter().zip(known).enumerate() {
                    assert!((j - known).abs() < 1e-14, "j_{n}({z}) = {j}, not {known}");
                }
            }
        }
    }

    #[test]
    fn transforms_are_those_of_brute_quadrature() {
        let cases: [(&str, &dyn Fn(f64) -> f64); 3] = [
            ("a polynomial", &|x| ((3.0 * x - 2.0) * x + 1.0) * libm::pow(x - 0.3, 11.0)),
            ("an exponential", &|x| libm::exp(3.0 * x)),
            ("a narrow hump", &|x| 1.0 / (0.01 + (x - 0.4) * (x - 0.4))),
        ];
        for (name, function) in cases {
            for w in [0.0, 1e-6, 0.3, 2.0, 17.0, 130.0, -30.0] {
                let range = (0.1, 1.2);
                let found: Complex<f64> =
                    LegendreSeries::expand(function, range).iter().map(|series| series.transform(w)).sum();
                let known = brute(function, range, w);
                let size = brute(&|x| function(x).abs(), range, 0.0).re;
                assert!((found - known).norm() < 1e-13 * size, "{name} at {w}: {found} {known}");
            }
        }
    }
}
