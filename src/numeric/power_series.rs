//! Power series to any order: the coefficients of what elementary functions make of a series (A. Griewank, A. Walther, Evaluating
//! Derivatives, 2nd ed., 2008, ch. 13).
//!
//! A series is a slice, the coefficient of t⁰ first. Every function writes as many coefficients as its result has room for; of
//! arguments that are shorter the missing ones are 0.

fn at(series: &[f64], n: usize) -> f64 {
    series.get(n).copied().unwrap_or(0.0)
}

#[expect(clippy::cast_precision_loss, reason = "orders are small")]
fn number(n: usize) -> f64 {
    n as f64
}

/// Writes one coefficient after the other; each is made from those before it.
fn fill(out: &mut [f64], coefficient: impl Fn(usize, &[f64]) -> f64) {
    for n in 0..out.len() {
        let (own, rest) = out.split_at_mut(n);
        if let Some(next) = rest.first_mut() {
            *next = coefficient(n, own);
        }
    }
}

/// Σ k aₖ bₙ₋ₖ over k from 1 to n.
fn chained(a: &[f64], b: &[f64], n: usize) -> f64 {
    (1..=n).map(|k| number(k) * at(a, k) * at(b, n - k)).sum()
}

/// Σ k yₖ bₙ₋ₖ over k from 1 to n − 1: what is known of n yₙ b₀ in a product y' b.
fn known(own: &[f64], b: &[f64], n: usize) -> f64 {
    (1..n).map(|k| number(k) * at(own, k) * at(b, n - k)).sum()
}

/// a b.
pub fn product(a: &[f64], b: &[f64], out: &mut [f64]) {
    fill(out, |n, _| (0..=n).map(|k| at(a, k) * at(b, n - k)).sum());
}

/// a/b.
pub fn quotient(a: &[f64], b: &[f64], out: &mut [f64]) {
    fill(out, |n, own| {
        let rest: f64 = (1..=n).map(|k| at(b, k) * at(own, n - k)).sum();
        (at(a, n) - rest) / at(b, 0)
    });
}

/// e^a.
pub fn exponential(a: &[f64], out: &mut [f64]) {
    fill(out, |n, own| if n == 0 { libm::exp(at(a, 0)) } else { chained(a, own, n) / number(n) });
}

/// ln a.
pub fn logarithm(a: &[f64], out: &mut [f64]) {
    fill(out, |n, own| match n {
        0 => libm::log(at(a, 0)),
        n => (at(a, n) - known(own, a, n) / number(n)) / at(a, 0),
    });
}

/// sin a and cos a.
pub fn sine_cosine(a: &[f64], sine: &mut [f64], cosine: &mut [f64]) {
    for n in 0..sine.len().min(cosine.len()) {
        let (s, c) = match n {
            0 => libm::sincos(at(a, 0)),
            n => (chained(a, cosine, n) / number(n), -chained(a, sine, n) / number(n)),
        };
        if let (Some(sine), Some(cosine)) = (sine.get_mut(n), cosine.get_mut(n)) {
            (*sine, *cosine) = (s, c);
        }
    }
}

/// The function with this value at a₀ whose derivative is a'/b: n yₙ b₀ = n aₙ − Σ k yₖ bₙ₋ₖ.
fn integral(value: f64, a: &[f64], b: &[f64], out: &mut [f64]) {
    fill(out, |n, own| match n {
        0 => value,
        n => (at(a, n) - known(own, b, n) / number(n)) / at(b, 0),
    });
}

/// 1 + sign a².
fn one_and_square(sign: f64, a: &[f64], count: usize) -> Vec<f64> {
    let mut square = vec![0.0; count];
    product(a, a, &mut square);
    for (n, value) in square.iter_mut().enumerate() {
        *value = sign * *value + if n == 0 { 1.0 } else { 0.0 };
    }
    square
}

/// tan a, from (tan a)' = (1 + tan² a) a'.
pub fn tangent(a: &[f64], out: &mut [f64]) {
    fill(out, |n, own| match n {
        0 => libm::tan(at(a, 0)),
        n => chained(a, &one_and_square(1.0, own, n), n) / number(n),
    });
}

/// arcsin a.
pub fn arc_sine(a: &[f64], out: &mut [f64]) {
    let mut root = vec![0.0; out.len()];
    // (1 − a)(1 + a) keeps the digits of 1 − a² beside a = ±1.
    let mut square = one_and_square(-1.0, a, out.len());
    if let Some(first) = square.first_mut() {
        *first = (1.0 - at(a, 0)) * (1.0 + at(a, 0));
    }
    power(&square, 0.5, &mut root);
    integral(libm::asin(at(a, 0)), a, &root, out);
}

/// arccos a.
pub fn arc_cosine(a: &[f64], out: &mut [f64]) {
    arc_sine(a, out);
    for (n, value) in out.iter_mut().enumerate() {
        *value = if n == 0 { libm::acos(at(a, 0)) } else { -*value };
    }
}

/// arctan a.
pub fn arc_tangent(a: &[f64], out: &mut [f64]) {
    let square = one_and_square(1.0, a, out.len());
    integral(libm::atan(at(a, 0)), a, &square, out);
}

/// a to a constant power that is not a small whole number, a ≥ 0: n a₀ yₙ = Σ ((p + 1) k − n) aₖ yₙ₋ₖ.
///
/// Where a = 0 and its first coefficient that is not 0 is that of tᵐ, the power begins with t^(p m): what is below is 0, what is above
/// has no bound, but for a whole p m, which is not looked for.
pub fn power(a: &[f64], exponent: f64, out: &mut [f64]) {
    let first = at(a, 0);
    if first == 0.0 {
        let lowest = a.iter().position(|coefficient| *coefficient != 0.0).unwrap_or(a.len());
        let begins = exponent * number(lowest);
        fill(out, |n, _| if number(n) < begins { 0.0 } else { f64::INFINITY });
        return;
    }
    fill(out, |n, own| match n {
        0 if exponent == 0.5 => first.sqrt(),
        0 => libm::pow(first, exponent),
        n => {
            let term = |k: usize| ((exponent + 1.0) * number(k) - number(n)) * at(a, k) * at(own, n - k);
            (1..=n).map(term).sum::<f64>() / (number(n) * first)
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f64; 7] = [0.3, -0.7, 0.4, 0.2, -0.1, 0.05, 0.3];

    #[track_caller]
    fn near(found: &[f64], wanted: &[f64]) {
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-13 * (1.0 + wanted.abs()), "{found} is not {wanted}");
        }
    }

    fn of(function: fn(&[f64], &mut [f64]), a: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; 7];
        function(a, &mut out);
        out
    }

    /// Each function by its identities with the others.
    #[test]
    fn identities_hold_to_the_sixth_order() {
        let (mut sine, mut cosine, mut other) = (vec![0.0; 7], vec![0.0; 7], vec![0.0; 7]);
        sine_cosine(&A, &mut sine, &mut cosine);
        near(&of(arc_sine, &sine), &A);
        near(&of(arc_cosine, &cosine), &A);
        near(&of(arc_tangent, &of(tangent, &A)), &A);
        quotient(&sine, &cosine, &mut other);
        near(&of(tangent, &A), &other);
        near(&of(logarithm, &of(exponential, &A)), &A);
        power(&A, 2.5, &mut other);
        let exponents: Vec<f64> = of(logarithm, &A).iter().map(|value| 2.5 * value).collect();
        near(&of(exponential, &exponents), &other);
        let mut root = vec![0.0; 7];
        power(&A, 0.5, &mut root);
        product(&root, &root, &mut other);
        near(&other, &A);
    }

    /// e^t, sin t, ln(1 + t), arctan t, √(1 + t) by their textbook series.
    #[test]
    fn series_are_those_of_textbooks() {
        let (t, one) = ([0.0, 1.0], [1.0, 1.0]);
        near(&of(exponential, &t), &[1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0]);
        near(&of(logarithm, &one), &[0.0, 1.0, -0.5, 1.0 / 3.0, -0.25, 0.2, -1.0 / 6.0]);
        near(&of(arc_tangent, &t), &[0.0, 1.0, 0.0, -1.0 / 3.0, 0.0, 0.2, 0.0]);
        near(&of(tangent, &t), &[0.0, 1.0, 0.0, 1.0 / 3.0, 0.0, 2.0 / 15.0, 0.0]);
        near(&of(arc_sine, &t), &[0.0, 1.0, 0.0, 1.0 / 6.0, 0.0, 3.0 / 40.0, 0.0]);
        let mut root = vec![0.0; 5];
        power(&one, 0.5, &mut root);
        near(&root, &[1.0, 0.5, -0.125, 0.0625, -5.0 / 128.0]);
        // t^2.5 is 0 with its first two derivatives, and its third has no bound.
        power(&t, 2.5, &mut root);
        assert_eq!(root, [0.0, 0.0, 0.0, f64::INFINITY, f64::INFINITY]);
    }
}
