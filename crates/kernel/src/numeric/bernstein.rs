//! Roots of a polynomial on [0, 1], by its Bernstein coefficients.
//!
//! By the rule of Descartes in Bernstein form it has at most as many roots within as its coefficients have changes of sign, and fewer
//! only by an even number; halving by de Casteljau's algorithm separates them (Lane & Riesenfeld, BIT 21, 1981). One change is one
//! root, which lies between ends of different signs.

use super::root;

/// Halvings: beyond them two roots are equal to rounding.
const DEEPEST: u32 = 50;

/// The value at `t`, by de Casteljau's algorithm.
#[must_use]
pub fn value<const N: usize>(coefficients: &[f64; N], t: f64) -> f64 {
    let mut row = *coefficients;
    for level in (1..N).rev() {
        for at in 0..level {
            if let (Some(a), Some(b)) = (row.get(at).copied(), row.get(at + 1).copied())
                && let Some(entry) = row.get_mut(at)
            {
                // At either end this is the coefficient itself.
                *entry = (1.0 - t) * a + t * b;
            }
        }
    }
    row.first().copied().unwrap_or(f64::NAN)
}

/// The roots within [0, 1], in order; a double root may occur once or twice; the polynomial 0 has none.
#[must_use]
pub fn roots<const N: usize>(coefficients: &[f64; N]) -> Vec<f64> {
    let mut found = Vec::new();
    let none = coefficients.iter().all(|value| *value == 0.0);
    if none || !coefficients.iter().all(|value| value.is_finite()) {
        return found;
    }
    if coefficients.first() == Some(&0.0) {
        found.push(0.0);
    }
    search(coefficients, 0.0, 1.0, DEEPEST, &mut found);
    if coefficients.last() == Some(&0.0) {
        found.push(1.0);
    }
    found
}

/// The roots between two places, without the ends.
fn search<const N: usize>(part: &[f64; N], low: f64, high: f64, depth: u32, found: &mut Vec<f64>) {
    let signs = part.iter().filter(|value| **value != 0.0).map(|value| value.is_sign_positive());
    let changes = signs.clone().zip(signs.skip(1)).filter(|(a, b)| a != b).count();
    if changes == 0 {
        return;
    }
    let (first, last) = (part.first().copied().unwrap_or(0.0), part.last().copied().unwrap_or(0.0));
    if changes == 1 && first != 0.0 && last != 0.0 {
        let within = root::bracketed(|t| value(part, t), 0.0, 1.0, 0.0).unwrap_or(0.5);
        found.push(low + within * (high - low));
        return;
    }
    let middle = 0.5 * (low + high);
    if depth == 0 || !(low < middle && middle < high) {
        found.push(middle);
        return;
    }
    let (before, after) = halves(part);
    search(&before, low, middle, depth - 1, found);
    if after.first() == Some(&0.0) {
        found.push(middle);
    }
    search(&after, middle, high, depth - 1, found);
}

/// The coefficients on both halves.
fn halves<const N: usize>(coefficients: &[f64; N]) -> ([f64; N], [f64; N]) {
    let (mut row, mut before, mut after) = (*coefficients, *coefficients, *coefficients);
    for level in 0..N {
        if let (Some(start), Some(slot)) = (row.first(), before.get_mut(level)) {
            *slot = *start;
        }
        let last = N - 1 - level;
        if let (Some(end), Some(slot)) = (row.get(last), after.get_mut(last)) {
            *slot = *end;
        }
        for at in 0..last {
            if let (Some(a), Some(b)) = (row.get(at).copied(), row.get(at + 1).copied())
                && let Some(entry) = row.get_mut(at)
            {
                *entry = 0.5 * (a + b);
            }
        }
    }
    (before, after)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of a product of (t − r), by the values of its blossom.
    fn from_roots<const N: usize>(roots: &[f64]) -> [f64; N] {
        // Power form first, then b_j = Σ_i C(j, i)/C(n, i) a_i.
        let mut power = vec![1.0];
        for root in roots {
            let mut next = vec![0.0; power.len() + 1];
            for (i, a) in power.iter().enumerate() {
                next[i] -= root * a;
                next[i + 1] += a;
            }
            power = next;
        }
        #[expect(clippy::cast_precision_loss, reason = "at most five")]
        let choose = |n: usize, k: usize| (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product::<f64>();
        std::array::from_fn(|j| (0..=j).map(|i| choose(j, i) / choose(N - 1, i) * power.get(i).unwrap_or(&0.0)).sum())
    }

    #[test]
    fn every_root_is_found() {
        for known in
            [vec![0.1, 0.5, 0.7, 0.70001, 0.99], vec![0.3, 2.0, -1.0, 5.0, 0.9], vec![0.0, 1.0, 0.5, -0.1, 1.1]]
        {
            let coefficients: [f64; 6] = from_roots(&known);
            let mut inside: Vec<f64> = known.iter().copied().filter(|r| (0.0..=1.0).contains(r)).collect();
            inside.sort_by(f64::total_cmp);
            let found = roots(&coefficients);
            assert_eq!(found.len(), inside.len(), "{known:?}: {found:?}");
            for (a, b) in found.iter().zip(&inside) {
                assert!((a - b).abs() < 1e-10, "{known:?}: {found:?}");
            }
        }
        // A double root is there at least once; a polynomial without one has none.
        assert!(roots(&from_roots::<6>(&[0.4, 0.4, 3.0, 4.0, 5.0])).iter().any(|r| (r - 0.4).abs() < 1e-6));
        assert!(roots(&[1.0, 0.4, 0.4, 1.0]).is_empty() && roots(&[0.0; 4]).is_empty());
        assert!((value(&from_roots::<6>(&[0.2, 0.3, 0.4, 2.0, 3.0]), 0.2)).abs() < 1e-15);
    }
}
