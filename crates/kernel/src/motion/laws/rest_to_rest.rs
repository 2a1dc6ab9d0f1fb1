//! A polynomial from rest to rest by the Legendre series of its jerk.
//!
//! On t = 2x − 1 every P_n with n ≥ 3 is orthogonal to 1, t and t², so that a jerk 60 P_2 + Σ g_n P_n begins and ends at rest with the
//! travel 1, for any g_n; the g_n of even n make it symmetric. Its integrals are closed, by the ultraspherical polynomials
//! (Abramowitz & Stegun, 22.13.2):
//!
//! ```text
//! ∫ (1 − t²)^(λ − ½) C_n^λ dt = −2λ/(n (n + 2λ)) (1 − t²)^(λ + ½) C_(n−1)^(λ+1),  P_n = C_n^½
//! ```
//!
//! so that near an end every derivative keeps its digits, and nowhere large terms cancel, as powers and Bernstein terms of such a degree do.

use super::bernstein::Values;

/// Coefficient of the jerk of 3-4-5, 60 P_2.
pub(super) const FIRST: f64 = 60.0;

/// The polynomial.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RestToRest {
    /// g_4, g_6, …
    pub(super) jerk: Vec<f64>,
}

/// The derivative of an order of P_n(t) as a term of the jerk, for 0 ≤ x ≤ ½ and n = 2, 4, …; of order 0 and n = 2, which does not
/// vanish at the end, 0.
pub(super) fn terms(x: f64, order: u32) -> impl Iterator<Item = f64> {
    let t = 2.0 * x - 1.0;
    let lambda = f64::from(order.abs_diff(3)) + 0.5;
    // u^k of the integrals, u = 1 − t².
    let ends = (0..3_u32.saturating_sub(order)).fold(1.0, |product, _| product * 4.0 * x * (1.0 - x));
    let (mut index, mut below, mut here) = (0, 0.0, 1.0);
    (2_u32..).step_by(2).map(move |n| {
        let wanted = if order >= 3 { (n + 3).checked_sub(order) } else { (n + order).checked_sub(3) };
        let Some(wanted) = wanted else { return 0.0 };
        // By recursion.
        while index < wanted {
            let m = f64::from(index);
            (below, here) = (here, (2.0 * (m + lambda) * t * here - (m + 2.0 * lambda - 1.0) * below) / (m + 1.0));
            index += 1;
        }
        factor(f64::from(n), order) * ends * here
    })
}

/// The factor of the ultraspherical polynomial of a derivative.
fn factor(n: f64, order: u32) -> f64 {
    match order {
        0 => -15.0 / 8.0 / (n * (n + 1.0) * (n - 1.0) * (n + 2.0) * (n - 2.0) * (n + 3.0)),
        1 => 3.0 / 4.0 / (n * (n + 1.0) * (n - 1.0) * (n + 2.0)),
        2 => -0.5 / (n * (n + 1.0)),
        // dt/dx = 2, and d/dt C_n^λ = 2λ C_(n−1)^(λ+1).
        _ => (3..order).map(|k| 2.0 * (2.0 * f64::from(k - 3) + 1.0)).product(),
    }
}

impl RestToRest {
    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        // Point-symmetric about the middle.
        let late = x > 0.5;
        let near = if late { 1.0 - x } else { x };
        let weights = std::iter::once(&FIRST).chain(&self.jerk);
        let sum: f64 = terms(near, order).zip(weights).map(|(term, weight)| term * weight).sum();
        match order {
            0 => {
                let value = near * near * near * (10.0 - 15.0 * near + 6.0 * near * near) + sum;
                if late { 1.0 - value } else { value }
            }
            _ if late && order.is_multiple_of(2) => -sum,
            _ => sum,
        }
    }

    /// Value and three derivatives.
    pub(super) fn values_at(&self, x: f64) -> Values {
        [0, 1, 2, 3].map(|order| self.derivative(x, order))
    }
}
