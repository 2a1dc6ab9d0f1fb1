//! The coefficients of elementary functions of a series, computed from those before them.

use super::{convolved, number, product, root};

/// A function of one argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ElementaryFunction {
    /// Multiplication by a number.
    Scaled(f64),
    /// √ of a series with positive value.
    Root,
    /// sin.
    Sine,
    /// cos.
    Cosine,
    /// tan.
    Tangent,
    /// arcsin.
    ArcSine,
    /// arccos.
    ArcCosine,
    /// arctan.
    ArcTangent,
    /// e^a.
    Exponential,
    /// ln a.
    Logarithm,
    /// A number a ≥ 0 to a constant power that is not a small whole number.
    ///
    /// Where a = 0 and its first coefficient that is not 0 is that of tᵐ, the power begins with t^(p m): coefficients below it are 0, those
    /// above it are unbounded, except for a whole p m, which is not handled.
    Power(f64),
    /// (1 − a)^(−k) − 1, accurate to all digits for a small a.
    PowerLessOne(f64),
    /// ((1 − x a)^(−k) − 1)/x about x = 0.
    PowerLessOneOverAbscissa(f64),
}

impl ElementaryFunction {
    /// Writes the coefficients of the function of a series from an index on; those before it are left unchanged.
    pub(super) fn extend(self, a: &[f64], out: &mut [f64], from: usize) {
        let first = coefficient(a, 0);
        let mut other = vec![0.0; if matches!(self, Self::Sine | Self::Cosine) { out.len() } else { 0 }];
        match self {
            Self::Scaled(factor) => fill(out, from, |n, _| factor * coefficient(a, n)),
            Self::Root => fill(out, from, |n, own| root(coefficient(a, n), own)),
            Self::Sine => sine_cosine(a, out, &mut other),
            Self::Cosine => sine_cosine(a, &mut other, out),
            // (tan a)' = (1 + tan² a) a'.
            Self::Tangent => fill(out, from, |n, own| match n {
                0 => libm::tan(first),
                n => chained(a, &one_and_square(1.0, own, n), n) / number(n),
            }),
            Self::ArcSine => integral(libm::asin(first), a, 1.0, &root_of_complement(a, out.len()), out, from),
            Self::ArcCosine => integral(libm::acos(first), a, -1.0, &root_of_complement(a, out.len()), out, from),
            Self::ArcTangent => integral(libm::atan(first), a, 1.0, &one_and_square(1.0, a, out.len()), out, from),
            Self::Exponential => fill(out, from, |n, own| match n {
                0 => libm::exp(first),
                n => chained(a, own, n) / number(n),
            }),
            Self::Logarithm => integral(libm::log(first), a, 1.0, a, out, from),
            Self::Power(exponent) => power(a, exponent, out, from),
            Self::PowerLessOne(exponent) => fill(out, from, |n, own| match n {
                0 => libm::expm1(-exponent * libm::log1p(-first)),
                n => power_of_complement(
                    exponent,
                    n,
                    |k| coefficient(a, k),
                    |k| if k == 0 { 1.0 + coefficient(own, 0) } else { coefficient(own, k) },
                ),
            }),
            Self::PowerLessOneOverAbscissa(exponent) => fill(out, from, |n, own| {
                power_of_complement(
                    exponent,
                    n + 1,
                    |k| k.checked_sub(1).map_or(0.0, |k| coefficient(a, k)),
                    |k| k.checked_sub(1).map_or(1.0, |k| coefficient(own, k)),
                )
            }),
        }
    }
}

pub(super) fn coefficient(series: &[f64], n: usize) -> f64 {
    series.get(n).copied().unwrap_or(0.0)
}

/// Writes one coefficient after the other; each is computed from those before it.
pub(super) fn fill(out: &mut [f64], from: usize, coefficient: impl Fn(usize, &[f64]) -> f64) {
    for n in from..out.len() {
        let (own, rest) = out.split_at_mut(n);
        if let Some(next) = rest.first_mut() {
            *next = coefficient(n, own);
        }
    }
}

/// a/b.
pub(super) fn quotient(a: &[f64], b: &[f64], out: &mut [f64], from: usize) {
    let (first, inner) = b.split_first().unwrap_or((&0.0, &[]));
    fill(out, from, |n, own| (coefficient(a, n) - convolved(inner.get(..n).unwrap_or_default(), own)) / first);
}

/// Σ k aₖ bₙ₋ₖ over k from 1 to n, or as far as `a` goes.
fn chained(a: &[f64], b: &[f64], n: usize) -> f64 {
    (1..a.len().min(n + 1)).map(|k| number(k) * coefficient(a, k) * coefficient(b, n - k)).sum()
}

/// sin a and cos a.
fn sine_cosine(a: &[f64], sine: &mut [f64], cosine: &mut [f64]) {
    for n in 0..sine.len().min(cosine.len()) {
        let (s, c) = match n {
            0 => libm::sincos(coefficient(a, 0)),
            n => (chained(a, cosine, n) / number(n), -chained(a, sine, n) / number(n)),
        };
        if let (Some(sine), Some(cosine)) = (sine.get_mut(n), cosine.get_mut(n)) {
            (*sine, *cosine) = (s, c);
        }
    }
}

/// The function with this value at a₀ whose derivative is ±a'/b: n yₙ b₀ = ±n aₙ − Σ k yₖ bₙ₋ₖ, k < n.
fn integral(value: f64, a: &[f64], sign: f64, b: &[f64], out: &mut [f64], from: usize) {
    fill(out, from, |n, own| match n {
        0 => value,
        n => (sign * coefficient(a, n) - chained(own, b, n) / number(n)) / coefficient(b, 0),
    });
}

/// 1 + sign a².
fn one_and_square(sign: f64, a: &[f64], count: usize) -> Vec<f64> {
    (0..count).map(|n| sign * product(a, a, n) + if n == 0 { 1.0 } else { 0.0 }).collect()
}

/// √(1 − a²).
fn root_of_complement(a: &[f64], count: usize) -> Vec<f64> {
    let (mut square, mut root) = (one_and_square(-1.0, a, count), vec![0.0; count]);
    // (1 − a)(1 + a) keeps the digits of 1 − a² near a = ±1.
    if let Some(first) = square.first_mut() {
        *first = (1.0 - coefficient(a, 0)) * (1.0 + coefficient(a, 0));
    }
    power(&square, 0.5, &mut root, 0);
    root
}

/// n a₀ yₙ = Σ ((p + 1) k − n) aₖ yₙ₋ₖ.
fn power(a: &[f64], exponent: f64, out: &mut [f64], from: usize) {
    let first = coefficient(a, 0);
    if first == 0.0 {
        let lowest = a.iter().position(|coefficient| *coefficient != 0.0).unwrap_or(a.len());
        let begins = exponent * number(lowest);
        return fill(out, from, |n, _| if number(n) < begins { 0.0 } else { f64::INFINITY });
    }
    fill(out, from, |n, own| match n {
        0 if exponent == 0.5 => first.sqrt(),
        0 => libm::pow(first, exponent),
        n => {
            (1..=n)
                .map(|k| ((exponent + 1.0) * number(k) - number(n)) * coefficient(a, k) * coefficient(own, n - k))
                .sum::<f64>()
                / (number(n) * first)
        }
    });
}

/// The n-th coefficient of E = (1 − a)^(−k): n (1 − a₀) Eₙ = Σ (k j + n − j) aⱼ Eₙ₋ⱼ.
fn power_of_complement(exponent: f64, n: usize, a: impl Fn(usize) -> f64, own: impl Fn(usize) -> f64) -> f64 {
    (1..=n).map(|j| (exponent * number(j) + number(n - j)) * a(j) * own(n - j)).sum::<f64>()
        / (number(n) * (1.0 - a(0)))
}
