//! A polynomial by its Bernstein coefficients, which conditions at both ends give directly.
//!
//! In Bernstein form a polynomial of given derivatives at both ends needs no system of equations, a rest is a row of zeros, and
//! no power of x cancels another: G. Farin, "Curves and surfaces for CAGD", 5th ed. (2002), chapters 4 and 5.

/// s, s', s'', s''' at x.
pub type Values = [f64; 4];

/// A sum of coefficients times x^k (1 − x)^(n−k).
#[derive(Debug, Clone, PartialEq, Default)]
struct ScaledBernstein {
    /// k = 0 first; the binomials are in them.
    scaled: Vec<f64>,
}

impl ScaledBernstein {
    fn new(coefficients: &[f64]) -> Self {
        let degree = count(coefficients.len().saturating_sub(1));
        let mut binomial = 1.0;
        let mut scaled = Vec::with_capacity(coefficients.len());
        for (k, coefficient) in (0..=degree).zip(coefficients) {
            scaled.push(binomial * coefficient);
            // In this order every step is a whole number.
            binomial = binomial * f64::from(degree - k) / f64::from(k + 1);
        }
        Self { scaled }
    }

    /// At x with y = 1 − x, by Horner's rule in the smaller ratio of the two.
    #[inline]
    fn value_at(&self, x: f64, y: f64) -> f64 {
        let (larger, sum) = if x <= y {
            let ratio = x / y;
            (y, self.scaled.iter().rev().fold(0.0, |sum, scaled| sum * ratio + scaled))
        } else {
            let ratio = y / x;
            (x, self.scaled.iter().fold(0.0, |sum, scaled| sum * ratio + scaled))
        };
        (1..self.scaled.len()).fold(sum, |product, _| product * larger)
    }
}

/// A polynomial on [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bernstein {
    start: f64,
    end: f64,
    /// Coefficients of s − s(0).
    from_start: Vec<f64>,
    above_start: ScaledBernstein,
    below_end: ScaledBernstein,
    derivatives: [ScaledBernstein; 3],
}

/// A length, which is small.
fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}

/// n(n−1)…(n−k+1).
fn falling(n: u32, k: u32) -> f64 {
    (0..k).map(|i| f64::from(n.saturating_sub(i))).product()
}

/// The first differences.
fn differences(row: &[f64]) -> Vec<f64> {
    row.iter().zip(row.iter().skip(1)).map(|(a, b)| b - a).collect()
}

/// The coefficients next to an end, counted from it and less that of the end itself, from the derivatives there, the value first.
fn next_to_end(derivatives: &[f64], degree: u32) -> Vec<f64> {
    // The differences at the end, Δ^k b = s^(k) (n − k)!/n!, are summed up: each row of the triangle is the running sum of
    // the one before.
    let mut row: Vec<f64> = (0..).zip(derivatives).map(|(k, s)| s / falling(degree, k)).collect();
    if let Some(own) = row.first_mut() {
        *own = 0.0;
    }
    let mut coefficients = Vec::with_capacity(row.len());
    for _ in derivatives {
        coefficients.extend(row.first());
        row = row.iter().zip(row.iter().skip(1).chain(std::iter::once(&0.0))).map(|(a, b)| a + b).collect();
    }
    coefficients
}

impl Bernstein {
    /// The polynomial of least degree with these values s, s', s'', … at 0 and at 1.
    pub(super) fn hermite(from: &[f64], to: &[f64]) -> Self {
        let degree = count((from.len() + to.len()).saturating_sub(1));
        let (start, end) = (from.first().copied().unwrap_or(0.0), to.first().copied().unwrap_or(0.0));
        // Seen from the end the odd derivatives change their signs.
        let turned: Vec<f64> = to.iter().enumerate().map(|(k, s)| if k % 2 == 1 { -s } else { *s }).collect();
        let (near_start, near_end) = (next_to_end(from, degree), next_to_end(&turned, degree));
        let travel = end - start;
        let from_start: Vec<f64> =
            near_start.iter().copied().chain(near_end.iter().rev().map(|b| travel + b)).collect();
        let below: Vec<f64> = near_start.iter().map(|b| travel - b).chain(near_end.iter().rev().map(|b| -b)).collect();
        let mut row = from_start.clone();
        let derivatives = [1, 2, 3].map(|order| {
            row = differences(&row);
            let factor = falling(degree, order);
            ScaledBernstein::new(&row.iter().map(|b| factor * b).collect::<Vec<_>>())
        });
        Self {
            start,
            end,
            above_start: ScaledBernstein::new(&from_start),
            below_end: ScaledBernstein::new(&below),
            from_start,
            derivatives,
        }
    }

    /// Value and three derivatives.
    #[inline]
    pub(super) fn values_at(&self, x: f64) -> Values {
        let y = 1.0 - x;
        let [first, second, third] = &self.derivatives;
        [self.value(x, y), first.value_at(x, y), second.value_at(x, y), third.value_at(x, y)]
    }

    #[inline]
    fn value(&self, x: f64, y: f64) -> f64 {
        if x <= y { self.start + self.above_start.value_at(x, y) } else { self.end - self.below_end.value_at(x, y) }
    }

    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        if order == 0 {
            return self.value(x, 1.0 - x);
        }
        let row = (0..order).fold(self.from_start.clone(), |row, _| differences(&row));
        let degree = count(self.from_start.len().saturating_sub(1));
        ScaledBernstein::new(&row).value_at(x, 1.0 - x) * falling(degree, order)
    }
}
