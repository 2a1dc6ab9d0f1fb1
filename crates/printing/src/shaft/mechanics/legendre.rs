//! Polynomials on a panel, as sums Σ c_k P_k(2ξ − 1) of Legendre polynomials, 0 ≤ ξ ≤ 1.
//!
//! On [0, 1] they are orthogonal, ∫ P_k² dξ = 1/(2k + 1): an integral of a product is a sum of products of coefficients.

/// The integral from 0 to ξ: ∫ P_0 = (P_0 + P_1)/2, ∫ P_k = (P_{k+1} − P_{k−1})/(2(2k + 1)).
///
/// One coefficient more than was given. DLMF 18.17.1 with 18.9.
pub(super) fn integral(coefficients: &[f64]) -> Vec<f64> {
    (0..=coefficients.len())
        .map(|k| match k {
            0 => share_of_neighbour(coefficients, 0) - share_of_neighbour(coefficients, 1),
            _ => share_of_neighbour(coefficients, k - 1) - share_of_neighbour(coefficients, k + 1),
        })
        .collect()
}

/// What P_k gives to each of its neighbours.
fn share_of_neighbour(coefficients: &[f64], k: usize) -> f64 {
    coefficients.get(k).map_or(0.0, |c| c / (2.0 * odd(k)))
}

/// 2k + 1.
pub(super) fn odd(k: usize) -> f64 {
    u32::try_from(2 * k + 1).map_or(f64::INFINITY, f64::from)
}

/// The sum at ξ, by the recurrence (k + 1) P_{k+1} = (2k + 1) t P_k − k P_{k−1} in t = 2ξ − 1; stable for |t| ≤ 1.
pub(super) fn value(coefficients: &[f64], xi: f64) -> f64 {
    let t = 2.0 * xi - 1.0;
    let (mut before, mut here, mut sum, mut k) = (0.0, 1.0, 0.0, 0.0);
    for c in coefficients {
        sum += c * here;
        (before, here) = (here, ((2.0 * k + 1.0) * t * here - k * before) / (k + 1.0));
        k += 1.0;
    }
    sum
}

/// The sum at ξ = 1, where every P_k is 1.
pub(super) fn end(coefficients: &[f64]) -> f64 {
    coefficients.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P_3 = (5t³ − 3t)/2; its integral over ξ is half that over t: (5t⁴ − 6t² + 1)/16.
    #[test]
    fn integrates_and_evaluates_closed_forms() {
        let third = [0.0, 0.0, 0.0, 1.0];
        for step in 0..=10 {
            let xi = f64::from(step) / 10.0;
            let t = 2.0 * xi - 1.0;
            assert!((value(&third, xi) - (2.5 * t * t * t - 1.5 * t)).abs() < 4.0 * f64::EPSILON);
            let exact = (5.0 * t.powi(4) - 6.0 * t * t + 1.0) / 16.0;
            assert!((value(&integral(&third), xi) - exact).abs() < 4.0 * f64::EPSILON);
            assert!((value(&integral(&[2.0]), xi) - 2.0 * xi).abs() < 4.0 * f64::EPSILON);
            assert!((value(&integral(&[0.0, 1.0]), xi) - (xi * xi - xi)).abs() < 4.0 * f64::EPSILON);
        }
        assert_eq!(end(&integral(&third)), 0.0);
    }
}
