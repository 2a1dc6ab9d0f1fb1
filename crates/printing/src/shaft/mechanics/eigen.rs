//! The largest eigenvalues of a symmetric matrix, and their vectors: few of many.
//!
//! The matrix is made tridiagonal (Householder), its eigenvalues are bisected by Sturm counts, their vectors come by inverse
//! iteration: J. H. Wilkinson, "The Algebraic Eigenvalue Problem", ch. 5. An eigenvalue has the rounding of the largest, ε of
//! it, as by any method for the whole matrix; three of a hundred cost half of all.
//! Householder's step is nalgebra's; its own QR iteration gives other last digits, which tables would show.

use nalgebra::{DMatrix, DVector, SymmetricTridiagonal};

/// Halvings from the sum of all to below ε of the largest.
const HALVINGS: usize = 64;

/// Accuracy that shows how many waves a mode has, and where rounding begins.
const ROUGHLY: f64 = 1e-3;

/// Solutions of an inverse iteration: the first amplifies the vector by 1/ε, the second mends a poor start.
const SOLUTIONS: usize = 3;

/// A symmetric matrix made tridiagonal.
pub(super) struct TridiagonalForm {
    tridiagonal: SymmetricTridiagonal<f64, nalgebra::Dyn>,
    diagonal: Vec<f64>,
    /// Entries next to the diagonal, not negative.
    beside: Vec<f64>,
    /// The number by which the matrix was divided.
    scale: f64,
    /// No eigenvalue of the divided matrix is larger in size (Gershgorin).
    bound: f64,
}

impl TridiagonalForm {
    /// `None` for an empty matrix and one with entries that are not finite or all 0.
    pub(super) fn new(matrix: &DMatrix<f64>) -> Option<Self> {
        if matrix.is_empty() || !matrix.is_square() || !matrix.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        let scale = matrix.amax();
        if scale == 0.0 {
            return None;
        }
        let tridiagonal = SymmetricTridiagonal::new(matrix.unscale(scale));
        let diagonal: Vec<f64> = tridiagonal.diagonal().iter().copied().collect();
        let beside: Vec<f64> = tridiagonal.off_diagonal().iter().copied().collect();
        let before = std::iter::once(0.0).chain(beside.iter().copied());
        let after = beside.iter().copied().chain(std::iter::once(0.0));
        let rows = diagonal.iter().zip(before.zip(after));
        let bound = rows.map(|(d, (before, after))| d.abs() + before + after).fold(0.0, f64::max);
        Some(Self { tridiagonal, diagonal, beside, scale, bound })
    }

    /// Eigenvalues above x: the positive pivots of T − x.
    fn above(&self, x: f64) -> usize {
        // A pivot of 0 counts as one of either sign.
        let least = f64::EPSILON * f64::EPSILON * self.bound;
        let before = std::iter::once(0.0).chain(self.beside.iter().copied());
        let (mut count, mut pivot) = (0, 1.0_f64);
        for (d, e) in self.diagonal.iter().zip(before) {
            pivot = d - x - e * e / pivot;
            if pivot.abs() < least {
                pivot = -least;
            }
            count += usize::from(pivot > 0.0);
        }
        count
    }

    /// The eigenvalue above which `index` lie, of the divided matrix, between its bounds, to this part of itself.
    fn value(&self, index: usize, most: f64, to: f64) -> f64 {
        let (mut low, mut high) = (-self.bound, most);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high || high - low <= (to * middle.abs()).max(0.5 * f64::EPSILON * self.bound)
            {
                break;
            }
            if self.above(middle) > index {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The largest size of an eigenvalue, of either sign, within a per mille.
    pub(super) fn size(&self) -> f64 {
        let last = self.diagonal.len().saturating_sub(1);
        self.scale * self.value(0, self.bound, ROUGHLY).abs().max(self.value(last, self.bound, ROUGHLY).abs())
    }

    /// The last of the `count` largest eigenvalues above `least`, or of as many as there are, within a per mille.
    pub(super) fn last_of(&self, count: usize, least: f64) -> Option<f64> {
        let index = count.min(self.above(least / self.scale)).checked_sub(1)?;
        Some(self.scale * self.value(index, self.bound, ROUGHLY))
    }

    /// The `count` largest eigenvalues above `least`, or as many as there are, falling.
    pub(super) fn largest(&self, count: usize, least: f64) -> Vec<f64> {
        let mut most = self.bound;
        let mut values = Vec::new();
        for index in 0..count.min(self.above(least / self.scale)) {
            most = self.value(index, most, 0.0);
            values.push(most * self.scale);
        }
        values
    }

    /// Unit vectors of these eigenvalues.
    pub(super) fn vectors(&self, values: &[f64]) -> Vec<DVector<f64>> {
        let turn = self.tridiagonal.q();
        let mut found: Vec<DVector<f64>> = Vec::new();
        for value in values {
            let factors = Factors::new(&self.diagonal, &self.beside, value / self.scale, f64::EPSILON * self.bound);
            // Something of every vector, and not the same again for a double eigenvalue.
            let mut phase = 0.0;
            let mut vector = DVector::from_fn(self.diagonal.len(), |_, _| {
                phase += 1.0;
                1.0 + 0.5 * libm::sin(phase * phase)
            });
            for _ in 0..SOLUTIONS {
                factors.solve(vector.as_mut_slice());
                for other in &found {
                    let share = other.dot(&vector);
                    vector.axpy(-share, other, 1.0);
                }
                let norm = vector.norm();
                if norm > 0.0 && norm.is_finite() {
                    vector.unscale_mut(norm);
                }
            }
            found.push(vector);
        }
        found.iter().map(|vector| &turn * vector).collect()
    }
}

/// T − x in its factors, with row exchanges: row k of U, and what was subtracted of it from the next.
struct Factors {
    upper: Vec<[f64; 3]>,
    lower: Vec<(f64, bool)>,
}

impl Factors {
    /// `least` stands in for a pivot of 0.
    fn new(diagonal: &[f64], beside: &[f64], x: f64, least: f64) -> Self {
        let (mut upper, mut lower) = (Vec::with_capacity(diagonal.len()), Vec::with_capacity(diagonal.len()));
        let mut row = [diagonal.first().copied().unwrap_or(0.0) - x, beside.first().copied().unwrap_or(0.0), 0.0];
        let after = beside.iter().copied().skip(1).chain(std::iter::once(0.0));
        for ((e, d), after) in beside.iter().zip(diagonal.iter().skip(1)).zip(after) {
            let next = [*e, d - x, after];
            let exchange = next[0].abs() > row[0].abs();
            let (pivot, other) = if exchange { (next, row) } else { (row, next) };
            let pivot = [or_least(pivot[0], least), pivot[1], pivot[2]];
            let factor = other[0] / pivot[0];
            upper.push(pivot);
            lower.push((factor, exchange));
            row = [other[1] - factor * pivot[1], other[2] - factor * pivot[2], 0.0];
        }
        upper.push([or_least(row[0], least), 0.0, 0.0]);
        Self { upper, lower }
    }

    fn solve(&self, vector: &mut [f64]) {
        let mut rest = &mut *vector;
        for (factor, exchange) in &self.lower {
            let [here, next, ..] = rest else { break };
            if *exchange {
                std::mem::swap(here, next);
            }
            *next -= factor * *here;
            rest = rest.get_mut(1..).unwrap_or_default();
        }
        let (mut one, mut two) = (0.0, 0.0);
        for (entry, [pivot, first, second]) in vector.iter_mut().zip(&self.upper).rev() {
            *entry = (*entry - first * one - second * two) / pivot;
            (one, two) = (*entry, one);
        }
    }
}

fn or_least(pivot: f64, least: f64) -> f64 {
    if pivot.abs() < least { least } else { pivot }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 cos(πj/(n + 1)) of the path, its vectors sin(πjk/(n + 1)); with a double eigenvalue when it is taken twice.
    #[test]
    fn finds_the_spectrum_of_a_path_and_of_two() {
        let n = 9;
        let path = DMatrix::from_fn(2 * n, 2 * n, |i, j| if i / n == j / n && i.abs_diff(j) == 1 { 3.0 } else { 0.0 });
        let spectrum = TridiagonalForm::new(&path).expect("finite");
        let values = spectrum.largest(8, 0.0);
        assert_eq!(values.len(), 8);
        let exact = |j: u32| 6.0 * libm::cos(std::f64::consts::PI * f64::from(j) / 10.0);
        for (value, j) in values.iter().zip([1, 1, 2, 2, 3, 3, 4, 4]) {
            assert!((value - exact(j)).abs() < 1e-14 * 6.0, "{value} {}", exact(j));
        }
        assert!((spectrum.size() - exact(1)).abs() < ROUGHLY * 6.0);
        assert!((spectrum.last_of(3, 0.0).expect("some") - exact(2)).abs() < ROUGHLY * 6.0);
        assert_eq!(spectrum.last_of(3, 7.0), None);
        let vectors = spectrum.vectors(&values);
        for (k, (value, vector)) in values.iter().zip(&vectors).enumerate() {
            assert!((&path * vector - vector * *value).amax() < 1e-13, "{k}");
            for (other, with) in vectors.iter().enumerate() {
                let product = vector.dot(with);
                assert!((product - if other == k { 1.0 } else { 0.0 }).abs() < 1e-13, "{k} {other} {product}");
            }
        }
        assert!(spectrum.largest(99, 1.0).iter().all(|value| *value > 1.0));
    }

    #[test]
    fn refuses_what_is_no_matrix() {
        assert!(TridiagonalForm::new(&DMatrix::zeros(0, 0)).is_none());
        assert!(TridiagonalForm::new(&DMatrix::zeros(2, 2)).is_none());
        assert!(TridiagonalForm::new(&DMatrix::from_element(2, 2, f64::NAN)).is_none());
        let one = TridiagonalForm::new(&DMatrix::from_element(1, 1, 5.0)).expect("a number");
        assert_eq!((one.largest(3, 0.0), one.vectors(&[5.0])[0][0].abs()), (vec![5.0], 1.0));
    }
}
