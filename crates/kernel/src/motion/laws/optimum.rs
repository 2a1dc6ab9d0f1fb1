//! Polynomials from rest to rest that minimise something: the peak of the acceleration or of the jerk, ∫ a², or the peak of the
//! acceleration without residual vibration.
//!
//! All of it is convex and does not change when the motion is reversed, so that a symmetric motion is among the best ones, and an even degree
//! is no better than the odd one below. The unknowns are the Legendre coefficients of the jerk (`RestToRest`), of which everything here is
//! linear:
//!
//! ```text
//! j = 60 P_2 + Σ g_n P_n,  ∫ a sin 2πν(x − ½) dx = (−1)^(n/2) j_n(πν)/(2πν) summed with the weights g_n
//! ```
//!
//! with the spherical Bessel functions j_n (integrated by parts, the acceleration is 0 at the ends).

use super::curve::{CurvePart, LawCurve};
use super::rest_to_rest::{FIRST, RestToRest, terms};
use super::task::LawError;
use crate::numeric::least_peak::LeastPeakProblem;
use crate::numeric::legendre::spherical_bessel;
use crate::numeric::linear::solutions;
use std::f64::consts::PI;
use std::sync::Arc;

/// Degrees of the position that are searched.
pub const LOWEST: u32 = 7;
/// The highest: from 13 on the peak falls by a few percent a degree, and the jerk grows.
pub const HIGHEST: u32 = 15;
/// The least degree with which two conditions of vibration are met.
pub const ROBUST: u32 = 9;
/// A peak acceleration above this, in travel over width squared, is of no use: 4 is the least possible.
const USELESS: f64 = 1000.0;
/// Cells in which extremes are separated: a half of the motion has at most six.
const CELLS: u32 = 48;

/// What is minimised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Objective {
    /// The largest acceleration.
    PeakAcceleration,
    /// The largest jerk.
    PeakJerk,
    /// The root of the mean square of the acceleration.
    RmsAcceleration,
    /// The largest acceleration, without residual vibration.
    Residual {
        /// Natural periods of the load that the motion takes.
        ratio: f64,
        /// Also the derivative of the vibration by the ratio is 0.
        robust: bool,
    },
}

impl Objective {
    /// As a file names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PeakAcceleration => "peak-acceleration",
            Self::PeakJerk => "peak-jerk",
            Self::RmsAcceleration => "rms-acceleration",
            Self::Residual { .. } => "residual",
        }
    }
}

/// A polynomial from rest to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optimum {
    /// Highest degree of the position, 7 to 15.
    pub degree: u32,
    /// What it minimises.
    pub least: Objective,
}

/// Equations between the unknowns: their coefficients, and the right side.
type Equations = Vec<(Vec<f64>, f64)>;

impl Optimum {
    /// The curve.
    ///
    /// # Errors
    /// [`LawError`].
    pub fn solve(&self) -> Result<LawCurve, LawError> {
        let Self { degree, least } = *self;
        if !(LOWEST..=HIGHEST).contains(&degree) {
            let expected = format!("a whole number from {LOWEST} to {HIGHEST}");
            return Err(LawError::parameter("degree", &expected, degree));
        }
        let robust = matches!(least, Objective::Residual { robust: true, .. });
        if robust && degree < ROBUST {
            let what = format!("degree {degree} has too few coefficients for `robust`: it needs {ROBUST} or more");
            return Err(LawError::new("degree", what).remedy("raise `degree`, or remove `robust`"));
        }
        // g_4 to g_(degree − 3).
        let count = usize::try_from((degree - 5) / 2).unwrap_or(0);
        // No test reaches this.
        let not_found = || LawError::new("degree", format!("no optimal polynomial of degree {degree} was found"));
        let jerk = match least {
            Objective::PeakAcceleration => least_peak(2, &[], count).ok_or_else(not_found)?.0,
            Objective::PeakJerk => least_peak(3, &[], count).ok_or_else(not_found)?.0,
            Objective::RmsAcceleration => least_square(count).ok_or_else(not_found)?,
            Objective::Residual { ratio, robust } => {
                let found = least_peak(2, &calm(ratio, robust, count), count);
                let Some((jerk, _)) = found.filter(|(_, peak)| *peak < USELESS) else {
                    let what = format!(
                        "no polynomial of degree {degree} is free of vibration at the ratio {ratio} with a peak \
                         acceleration below \
                         {USELESS} times travel over width squared"
                    );
                    return Err(
                        LawError::new("ratio", what).remedy("raise `degree`, or give the segment a longer angle")
                    );
                };
                jerk
            }
        };
        Ok(LawCurve::smooth(CurvePart::RestToRest(Arc::new(RestToRest { jerk }))))
    }
}

/// The conditions on the sum of the first term and these: no vibration.
fn calm(ratio: f64, robust: bool, count: usize) -> Equations {
    let z = PI * ratio;
    let bessel = spherical_bessel(z, 2 * count + 4);
    let at = |n: usize| bessel.get(n).copied().unwrap_or(0.0);
    // j_n' = j_(n−1) − (n + 1)/z j_n.
    let slope = |n: usize| at(n.saturating_sub(1)) - f64::from(u32::try_from(n + 1).unwrap_or(u32::MAX)) / z * at(n);
    let mut all = vec![alternating(count, at)];
    if robust {
        all.push(alternating(count, slope));
    }
    all
}

/// The equation Σ ± term(2 half) gₕ = 0 over the halves of the even orders, with alternating signs.
fn alternating(count: usize, term: impl Fn(usize) -> f64) -> (Vec<f64>, f64) {
    let signed = (1..count + 2).map(|half| if half.is_multiple_of(2) { term(2 * half) } else { -term(2 * half) });
    let signed: Vec<f64> = signed.collect();
    (signed[1..].to_vec(), -FIRST * signed[0])
}

/// The coefficients of least peak of a derivative among those that satisfy equations, and that peak.
fn least_peak(order: u32, equations: &[(Vec<f64>, f64)], count: usize) -> Option<(Vec<f64>, f64)> {
    let family = solutions(equations, count)?;
    let functions = |x: f64, further: u32| {
        let mut terms = terms(x, order + further);
        let first = FIRST * terms.next().unwrap_or(0.0);
        let own: Vec<f64> = terms.take(count).collect();
        let others = family.directions.iter().map(|direction| weighted_sum(&own, direction));
        std::iter::once(first + weighted_sum(&own, &family.particular)).chain(others).collect()
    };
    // The other half of the motion is symmetric.
    let found =
        LeastPeakProblem { functions, others: family.directions.len(), range: (0.0, 0.5), cells: CELLS }.solve()?;
    let jerk = family.particular.iter().enumerate().map(|(index, own)| {
        let directions = family.directions.iter().zip(&found.weights);
        own + directions.map(|(direction, weight)| direction.get(index).copied().unwrap_or(0.0) * weight).sum::<f64>()
    });
    Some((jerk.collect(), found.peak))
}

fn weighted_sum(terms: &[f64], weights: &[f64]) -> f64 {
    terms.iter().zip(weights).map(|(term, weight)| term * weight).sum()
}

/// The coefficients of least ∫ a². The acceleration of P_n is (P_(n+1) − P_(n−1))/(2(2n + 1)), and ∫ P_k² dx = 1/(2k + 1): only
/// neighbours are not orthogonal.
fn least_square(count: usize) -> Option<Vec<f64>> {
    let mut equations: Equations = Vec::with_capacity(count);
    for row in 2..count + 2 {
        let coefficients = (2..count + 2).map(|column| product_of_terms(row, column)).collect();
        equations.push((coefficients, -FIRST * product_of_terms(row, 1)));
    }
    Some(solutions(&equations, count)?.particular)
}

/// ∫ of the product of the accelerations of two terms, given by half their orders.
fn product_of_terms(one: usize, other: usize) -> f64 {
    let n = 2.0 * f64::from(u32::try_from(one.min(other)).unwrap_or(u32::MAX));
    match one.abs_diff(other) {
        0 => (1.0 / (2.0 * n + 3.0) + 1.0 / (2.0 * n - 1.0)) / (4.0 * (2.0 * n + 1.0) * (2.0 * n + 1.0)),
        1 => -1.0 / ((2.0 * n + 3.0) * 4.0 * (2.0 * n + 1.0) * (2.0 * n + 5.0)),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::quadrature;

    fn curve(degree: u32, least: Objective) -> LawCurve {
        Optimum { degree, least }.solve().unwrap_or_else(|error| panic!("{degree}: {error}"))
    }

    /// (1 − t²)² times a polynomial of t², lowest first: velocity.
    fn velocity(x: f64, coefficients: &[f64]) -> f64 {
        let t = 2.0 * x - 1.0;
        let sum = coefficients.iter().rev().fold(0.0, |sum, own| sum * t * t + own);
        (1.0 - t * t) * (1.0 - t * t) * sum
    }

    const ALL: [Objective; 4] = [
        Objective::PeakAcceleration,
        Objective::PeakJerk,
        Objective::RmsAcceleration,
        Objective::Residual { ratio: 2.5, robust: false },
    ];

    #[test]
    fn the_least_peaks_of_acceleration_are_those_known() {
        for (degree, coefficients, peak) in [
            (7, &[85.0 / 48.0, 35.0 / 48.0][..], 5.611_317_177_496_947),
            (9, &[1.851_834_132_924_175, -1.058_405_468_403_028, 3.661_699_613_801_406], 4.657_472_844_813_795),
        ] {
            let curve = curve(degree, Objective::PeakAcceleration);
            for i in 0..=100 {
                let x = f64::from(i) / 100.0;
                let (found, known) = (curve.values_at(0, x)[1], velocity(x, coefficients));
                assert!((found - known).abs() < 4e-15, "degree {degree} at {x}: {found} {known}");
            }
            let found = curve.peaks().acceleration.value;
            assert!((found - peak).abs() < 1e-14, "degree {degree}: {found}");
        }
        for (degree, peak) in [(11, 4.6269), (13, 4.3530)] {
            let found = curve(degree, Objective::PeakAcceleration).peaks().acceleration.value;
            assert!((found - peak).abs() < 5e-5, "degree {degree}: {found}");
        }
    }

    #[test]
    fn no_vibration_is_left_where_none_is_wanted() {
        let found = curve(7, Objective::Residual { ratio: 2.5, robust: false });
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let known = velocity(x, &[2.872_381_208_946_259, -6.981_668_462_623_811]);
            assert!((found.values_at(0, x)[1] - known).abs() < 4e-15, "at {x}: {} {known}", found.values_at(0, x)[1]);
        }
        for ratio in [0.8, 1.0, 1.3, 2.0, 2.5, 3.7, 5.0, 8.4, 12.0, 31.0] {
            for degree in LOWEST..=HIGHEST {
                for robust in [false, true] {
                    let Ok(curve) = (Optimum { degree, least: Objective::Residual { ratio, robust } }).solve() else {
                        assert!(degree < 9 || (ratio < 2.0 && degree < 11), "degree {degree} at {ratio}, {robust}");
                        continue;
                    };
                    let size = curve.peaks().acceleration.value;
                    assert!(curve.residual(ratio) < 1e-15 * size, "{degree} at {ratio}: {}", curve.residual(ratio));
                    // Near the ratio the vibration grows by the square.
                    let near = curve.residual(ratio + 1e-4);
                    assert!(!robust || near < 1e-6 * size, "{degree} at {ratio}: {near}");
                }
            }
        }
    }

    /// A family of higher degree holds that of the lower; the bounds of any motion hold.
    #[test]
    fn a_higher_degree_is_no_worse() {
        for least in ALL {
            let mut before = f64::INFINITY;
            for degree in LOWEST..=HIGHEST {
                let peaks = curve(degree, least).peaks();
                let (found, bound) = match least {
                    Objective::PeakJerk => (peaks.jerk.value, 32.0),
                    Objective::RmsAcceleration => (peaks.square, 12.0),
                    _ => (peaks.acceleration.value, 4.0),
                };
                assert!(found <= before * (1.0 + 1e-13) && found > bound, "{least:?} {degree}: {found} {before}");
                before = found;
            }
        }
    }

    /// Other coefficients that satisfy the equations are no better.
    #[test]
    fn no_other_coefficients_are_better() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(seed >> 32).expect("32 bits")) / f64::from(u32::MAX) - 0.5
        };
        for (least, order) in ALL.into_iter().zip([2, 3, 2, 2]) {
            for degree in [7, 9, 11, 13, 15] {
                let best = curve(degree, least);
                let Some(CurvePart::RestToRest(polynomial)) = best.part(0) else { panic!("a polynomial") };
                let measure = |curve: &LawCurve| match (least, order) {
                    (Objective::RmsAcceleration, _) => curve.peaks().square,
                    (_, 3) => curve.peaks().jerk.value,
                    _ => curve.peaks().acceleration.value,
                };
                let known = measure(&best);
                let count = polynomial.jerk.len();
                let equations =
                    if let Objective::Residual { ratio, .. } = least { calm(ratio, false, count) } else { vec![] };
                let directions = solutions(&equations, count).expect("a family").directions;
                for size in [1e-6, 1e-4, 1e-2, 1.0, 30.0] {
                    for _ in 0..20 {
                        let mut jerk = polynomial.jerk.clone();
                        for direction in &directions {
                            let by = size * random();
                            jerk.iter_mut().zip(direction).for_each(|(own, part)| *own += by * part);
                        }
                        let found = measure(&LawCurve::smooth(CurvePart::RestToRest(Arc::new(RestToRest { jerk }))));
                        assert!(found >= known * (1.0 - 4e-15), "{least:?} {degree} {size}: {found} {known}");
                    }
                }
            }
        }
    }

    /// Each derivative is that of the one before, to rounding of the peak by central differences of high order; the ends are at rest, and the
    /// second half is the first turned round.
    #[test]
    fn derivatives_belong_together() {
        for least in ALL {
            let curve = curve(15, least);
            assert_eq!(
                (curve.values_at(0, 0.0)[..3].to_vec(), curve.values_at(0, 1.0)[..3].to_vec()),
                (vec![0.0; 3], vec![1.0, 0.0, 0.0])
            );
            for order in 0..14 {
                let size =
                    (0..=40).map(|i| curve.derivative(0, f64::from(i) / 40.0, order + 1).abs()).fold(0.0, f64::max);
                for i in 0..16 {
                    let (low, high) = (f64::from(i) / 16.0, f64::from(i + 1) / 16.0);
                    let grown = curve.derivative(0, high, order) - curve.derivative(0, low, order);
                    let known = quadrature::integrate(|x| curve.derivative(0, x, order + 1), (low, high), 2);
                    assert!((grown - known).abs() < 1e-14 * size, "{least:?} {order} {low}: {grown} {known}");
                }
            }
            assert_eq!(curve.derivative(0, 0.3, 16), 0.0);
            // From an end on the position keeps its digits.
            let jerk = curve.values_at(0, 0.0)[3];
            let (x, early) = (1e-7, curve.values_at(0, 1e-7)[0]);
            assert!((early / (jerk * x * x * x / 6.0) - 1.0).abs() < 1e-4, "{early}");
        }
    }

    #[test]
    fn what_is_not_found_is_told() {
        let of = |degree, least| Optimum { degree, least }.solve().expect_err("none").to_string();
        assert!(of(6, Objective::PeakJerk).contains("from 7 to 15, not 6"));
        assert!(of(16, Objective::PeakJerk).contains("not 16"));
        assert!(of(8, Objective::Residual { ratio: 2.5, robust: true }).contains("needs 9 or more"));
        assert!(of(7, Objective::Residual { ratio: 0.1, robust: false }).contains("at the ratio 0.1"));
    }
}
