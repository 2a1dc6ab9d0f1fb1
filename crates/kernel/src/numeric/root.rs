//! Bracketed root finding: Chandrupatla's method.
//!
//! T. R. Chandrupatla, "A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function
//! without using derivatives", Advances in Engineering Software 28 (1997) 145–149. Inverse quadratic interpolation
//! where his criterion on the three last points shows it to be monotone, bisection otherwise. The bracket always
//! contains a change of sign, so the root returned is certain.

/// Bisection halves the bracket; from the widest bracket of `f64` to neighbouring numbers takes at most 2098 halvings, a bracket
/// within a few powers of two 60. Interpolation ends sooner. Reaching the limit means that the function is not a
/// number somewhere in the bracket.
const MAX_STEPS: usize = 200;

/// Why no root is returned.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RootError {
    /// The function has one sign at both ends.
    #[error("no change of sign between {low} and {high}")]
    NoSignChange {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// The function was not a number inside the bracket.
    #[error("the function is not a number near {at}")]
    NotANumber {
        /// The place.
        at: f64,
    },
}

/// The root of `f` between `low` and `high`, to `tolerance` (absolute) or to neighbouring numbers.
///
/// # Errors
/// [`RootError`] when the ends do not bracket a change of sign, or a value is NaN.
pub fn bracketed(mut f: impl FnMut(f64) -> f64, low: f64, high: f64, tolerance: f64) -> Result<f64, RootError> {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (f(a), f(b));
    if fa.is_nan() || fb.is_nan() {
        return Err(RootError::NotANumber { at: if fa.is_nan() { a } else { b } });
    }
    if fa == 0.0 {
        return Ok(a);
    }
    if fb == 0.0 {
        return Ok(b);
    }
    if fa.is_sign_positive() == fb.is_sign_positive() {
        return Err(RootError::NoSignChange { low, high });
    }
    let mut fraction = 0.5;
    for _ in 0..MAX_STEPS {
        let x = a + fraction * (b - a);
        let fx = f(x);
        if fx.is_nan() {
            return Err(RootError::NotANumber { at: x });
        }
        // (c, fc) is the discarded point; the new bracket is a, b with a the newest.
        let (c, fc);
        if fx.is_sign_positive() == fa.is_sign_positive() {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);
        let best = if fa.abs() < fb.abs() { a } else { b };
        let least_step = 2.0 * f64::EPSILON * best.abs() + 0.5 * tolerance;
        let limit = least_step / (b - a).abs();
        if limit > 0.5 || fa == 0.0 {
            return Ok(best);
        }
        let xi = (a - b) / (c - b);
        let phi = (fa - fb) / (fc - fb);
        let interpolate = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        fraction = if interpolate {
            fa / (fb - fa) * (fc / (fb - fc)) + (c - a) / (b - a) * (fa / (fc - fa)) * (fb / (fc - fb))
        } else {
            0.5
        };
        fraction = fraction.clamp(limit, 1.0 - limit);
    }
    Ok(if fa.abs() < fb.abs() { a } else { b })
}

/// The places of a range where a function changes its sign, at most one in each of a number of cells: where it is 0 at an end of a cell, or over
/// several cells, that place, or the first of them.
pub fn sign_changes(f: impl Fn(f64) -> f64, (low, high): (f64, f64), cells: u32) -> Vec<f64> {
    let mut found = Vec::new();
    let mut last: Option<(f64, f64)> = None;
    let mut zero: Option<f64> = None;
    for cell in 0..=cells {
        let at = if cell == cells { high } else { low + (high - low) * (f64::from(cell) / f64::from(cells)) };
        let value = f(at);
        if value == 0.0 {
            zero = zero.or(Some(at));
        } else if value.is_nan() {
            (last, zero) = (None, None);
        } else {
            if let Some((before, _)) = last.filter(|(_, other)| (*other < 0.0) != (value < 0.0)) {
                found.extend(zero.or_else(|| bracketed(&f, before, at, 0.0).ok()));
            }
            (last, zero) = (Some((at, value)), None);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots in closed form, with what makes each hard.
    #[test]
    fn finds_known_roots_to_rounding_in_few_steps() {
        type RootCase = (&'static str, fn(f64) -> f64, f64, f64, f64);
        let cases: &[RootCase] = &[
            ("smooth", |x| x * x - 2.0, 0.0, 2.0, std::f64::consts::SQRT_2),
            ("flat triple root", |x| (x - 1.0).powi(3), 0.0, 3.0, 1.0),
            ("steep", |x| libm::exp(x) - 1e8, 0.0, 100.0, 18.420_680_743_952_367),
            ("root at an end", |x| x, 0.0, 1.0, 0.0),
            ("tiny", |x| x - 1e-300, -1.0, 1.0, 1e-300),
        ];
        for (name, f, low, high, root) in cases {
            let mut calls = 0;
            let got = bracketed(
                |x| {
                    calls += 1;
                    f(x)
                },
                *low,
                *high,
                0.0,
            )
            .expect(name);
            // The triple root is only defined to the cube root of the smallest change of f.
            let tolerance = if name.contains("triple") { 1e-5 } else { 4.0 * f64::EPSILON * root.abs().max(1e-16) };
            assert!((got - root).abs() <= tolerance, "{name}: {got}");
            assert!(calls <= 120, "{name}: {calls} calls");
        }
    }

    #[test]
    fn names_what_is_wrong() {
        assert_eq!(bracketed(|x| x * x + 1.0, -1.0, 1.0, 0.0), Err(RootError::NoSignChange { low: -1.0, high: 1.0 }));
        assert!(matches!(
            bracketed(|x| if x.abs() < 0.9 { f64::NAN } else { x }, -1.0, 1.0, 0.0),
            Err(RootError::NotANumber { .. })
        ));
    }

    /// A zero on an end of a cell, one between two of them, a stretch of zeros, and a zero without a change.
    #[test]
    fn sign_changes_are_found_wherever_they_lie() {
        let odd = |x: f64| x * (x - 0.3);
        let found = sign_changes(odd, (-1.0, 1.0), 16);
        assert!(found.len() == 2 && found[0] == 0.0 && (found[1] - 0.3).abs() < 1e-15, "{found:?}");
        let flat = |x: f64| if x.abs() < 0.4 { 0.0 } else { x };
        assert_eq!(sign_changes(flat, (-1.0, 1.0), 8), [-0.25]);
        assert_eq!(sign_changes(|x| x * x, (-1.0, 1.0), 8), [0.0; 0]);
        assert_eq!(sign_changes(f64::sin, (0.0, 7.0), 8).len(), 2, "the zero at the beginning is no change");
    }
}
