//! Symmetric banded systems of linear equations, for which nalgebra has no matrix.

/// A symmetric matrix of half-bandwidth W − 1: row k holds the entries (k, k), (k, k + 1) … (k, k + W − 1).
#[derive(Debug, Clone)]
pub struct BandedMatrix<const W: usize> {
    rows: Vec<[f64; W]>,
}

impl<const W: usize> BandedMatrix<W> {
    /// The zero matrix with this many rows.
    #[must_use]
    pub fn zero(size: usize) -> Self {
        Self { rows: vec![[0.0; W]; size] }
    }

    /// Adds to the entries (row, column) and (column, row). Entries outside of the band or the matrix are ignored.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let (first, last) = (row.min(column), row.max(column));
        if let Some(entry) = self.rows.get_mut(first).and_then(|entries| entries.get_mut(last - first)) {
            *entry += value;
        }
    }

    /// The entries of a row from the diagonal on, to add to.
    pub fn row_mut(&mut self, row: usize) -> Option<&mut [f64; W]> {
        self.rows.get_mut(row)
    }

    /// The product with a vector.
    #[must_use]
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.rows.len()];
        for (index, row) in self.rows.iter().enumerate() {
            let own = vector.get(index).copied().unwrap_or(0.0);
            let ahead = vector.iter().skip(index);
            let sum: f64 = row.iter().zip(ahead).map(|(entry, value)| entry * value).sum();
            for (place, entry) in product.iter_mut().skip(index).zip(row).skip(1) {
                *place += entry * own;
            }
            if let Some(place) = product.get_mut(index) {
                *place += sum;
            }
        }
        product
    }

    /// The factors L D Lᵀ, without pivoting: for positive definite matrices, and for quasi-definite ones in an order in
    /// which every pivot has its sign when it is reached. Golub, Van Loan, Matrix Computations, §4.3.
    #[must_use]
    pub fn factored(mut self) -> BandedFactors<W> {
        let mut rest = self.rows.as_mut_slice();
        while let Some((row, below)) = rest.split_first_mut() {
            let pivot = row.first().copied().unwrap_or(1.0);
            for (ahead, target) in (1..W).zip(below.iter_mut()) {
                let factor = row.get(ahead).copied().unwrap_or(0.0) / pivot;
                for (entry, above) in target.iter_mut().zip(row.iter().skip(ahead)) {
                    *entry -= factor * above;
                }
            }
            for above in row.iter_mut().skip(1) {
                *above /= pivot;
            }
            rest = below;
        }
        BandedFactors { rows: self.rows }
    }
}

/// The factors of a [`BandedMatrix`] matrix.
#[derive(Debug, Clone)]
pub struct BandedFactors<const W: usize> {
    /// D, then the column of L below it.
    rows: Vec<[f64; W]>,
}

impl<const W: usize> BandedFactors<W> {
    /// Solves for one right-hand side, in place.
    pub fn solve(&self, right: &mut [f64]) {
        let (alone, _) = right.as_chunks_mut::<1>();
        self.solve_each(alone);
    }

    /// Solves for several right-hand sides at once, each a column, in place.
    pub fn solve_each<const N: usize>(&self, right: &mut [[f64; N]]) {
        let mut rest = &mut *right;
        for row in &self.rows {
            let Some((values, below)) = rest.split_first_mut() else { break };
            for (factor, targets) in row.iter().skip(1).zip(below.iter_mut()) {
                for (target, value) in targets.iter_mut().zip(&*values) {
                    *target -= factor * value;
                }
            }
            rest = below;
        }
        let size = right.len();
        for (index, row) in self.rows.iter().enumerate().take(size).rev() {
            let Some((values, below)) = right.get_mut(index..).and_then(<[[f64; N]]>::split_first_mut) else { break };
            let mut known = [0.0; N];
            for (factor, solved) in row.iter().skip(1).zip(below.iter()) {
                for (known, value) in known.iter_mut().zip(solved) {
                    *known += factor * value;
                }
            }
            let pivot = row.first().copied().unwrap_or(1.0);
            for (value, known) in values.iter_mut().zip(known) {
                *value = *value / pivot - known;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quasi-definite saddle: two unknowns with one constraint between them, twice, coupled.
    #[test]
    fn a_banded_system_is_solved() {
        let mut matrix = BandedMatrix::<3>::zero(5);
        let entries = [(0, 0, 4.0), (0, 1, 1.0), (1, 1, -2.0), (1, 2, 0.5), (2, 2, 3.0), (1, 3, 1.5), (3, 3, 5.0)];
        let more = [(2, 4, -1.0), (3, 4, 0.25), (4, 4, -1.0), (2, 3, 0.75)];
        let all: Vec<_> = entries.into_iter().chain(more).collect();
        for &(row, column, value) in &all {
            matrix.add(column, row, value);
        }
        let wanted = [1.0, -2.0, 3.0, 0.5, -1.5];
        let mut right = [0.0; 5];
        for &(row, column, value) in &all {
            right[row] += value * wanted[column];
            if row != column {
                right[column] += value * wanted[row];
            }
        }
        matrix.factored().solve(&mut right);
        for (got, wanted) in right.iter().zip(wanted) {
            assert!((got - wanted).abs() < 1e-14, "{right:?}");
        }
    }
}
