//! Symmetric systems of linear equations in groups of four unknowns, each coupled with the next group only; nalgebra has
//! dense matrices only.

/// Unknowns of a group.
pub const GROUP: usize = 4;
/// Unknowns of two groups.
pub const PAIR: usize = 2 * GROUP;

/// The rows of a group from its own first unknown on: the upper triangle among its own unknowns, then all of the next group's.
pub type BlockRows = [[f64; PAIR]; GROUP];

/// A symmetric matrix of such groups.
#[derive(Debug, Clone)]
pub struct BlockMatrix {
    groups: Vec<BlockRows>,
}

impl BlockMatrix {
    /// The matrix without groups, with capacity for this many.
    #[must_use]
    pub fn with_capacity(groups: usize) -> Self {
        Self { groups: Vec::with_capacity(groups) }
    }

    /// Adds the rows of the next group.
    pub fn push(&mut self, rows: BlockRows) {
        self.groups.push(rows);
    }

    /// Solves for several right-hand sides at once, each a column, in place, without pivoting: for positive definite matrices,
    /// and for quasi-definite ones in an order in which every pivot has its sign when it is reached. Golub, Van Loan, Matrix
    /// Computations, §4.3 and §4.5.
    pub fn solve<const N: usize>(mut self, right: &mut [[[f64; N]; GROUP]]) {
        let (mut rows, mut sides) = (self.groups.as_mut_slice(), &mut *right);
        while let ([row, below @ ..], [side, others @ ..]) = (rows, sides) {
            match (below.first_mut(), others.first_mut()) {
                (Some(next), Some(next_side)) => eliminate(row, side, next, next_side),
                _ => eliminate(row, side, &mut [[0.0; PAIR]; GROUP], &mut [[0.0; N]; GROUP]),
            }
            (rows, sides) = (below, others);
        }
        let mut after = [[0.0; N]; GROUP];
        for (group, values) in self.groups.iter().zip(right).rev() {
            for row in (0..GROUP).rev() {
                let mut value = values[row];
                let (own, next) = group[row].split_at(GROUP);
                for (factor, solved) in next.iter().zip(&after) {
                    subtract(&mut value, *factor, solved);
                }
                for ahead in row + 1..GROUP {
                    subtract(&mut value, own[ahead], &values[ahead]);
                }
                values[row] = value;
            }
            after = *values;
        }
    }
}

/// Eliminates the unknowns of a group from the next one; its rows become the factors.
#[inline]
fn eliminate<const N: usize>(
    group: &mut BlockRows,
    values: &mut [[f64; N]; GROUP],
    next: &mut BlockRows,
    others: &mut [[f64; N]; GROUP],
) {
    pivot::<0, N>(&mut *group, &mut *values, &mut *next, &mut *others);
    pivot::<1, N>(&mut *group, &mut *values, &mut *next, &mut *others);
    pivot::<2, N>(&mut *group, &mut *values, &mut *next, &mut *others);
    pivot::<3, N>(group, values, next, others);
}

/// Eliminates one unknown of a group from all that follow. Its position is a constant, so that all loops have a fixed length.
#[inline]
fn pivot<const K: usize, const N: usize>(
    group: &mut BlockRows,
    values: &mut [[f64; N]; GROUP],
    next: &mut BlockRows,
    others: &mut [[f64; N]; GROUP],
) {
    let (row, value) = (group[K], values[K]);
    let inverse = 1.0 / row[K];
    let [.., a, b, c, d] = row;
    let coupled = [a, b, c, d];
    for ahead in K + 1..GROUP {
        let factor = row[ahead] * inverse;
        subtract(&mut group[ahead], factor, &row);
        subtract(&mut values[ahead], factor, &value);
    }
    for (entry, (target, other)) in coupled.iter().zip(next.iter_mut().zip(others)) {
        let factor = entry * inverse;
        if let Some(target) = target.first_chunk_mut::<GROUP>() {
            subtract(target, factor, &coupled);
        }
        subtract(other, factor, &value);
    }
    group[K] = row.map(|entry| entry * inverse);
    values[K] = value.map(|value| value * inverse);
}

/// Subtracts a row times a factor from another.
#[inline]
fn subtract<const N: usize>(target: &mut [f64; N], factor: f64, row: &[f64; N]) {
    for (entry, above) in target.iter_mut().zip(row) {
        *entry -= factor * above;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Quasi-definite groups, two unknowns positive and two negative in each, against a dense factorization.
    #[test]
    fn a_chain_of_groups_is_solved() {
        for groups in 1..6_usize {
            let size = GROUP * groups;
            let mut dense = DMatrix::<f64>::zeros(size, size);
            let mut blocks = BlockMatrix::with_capacity(groups);
            for group in 0..groups {
                let mut rows = [[0.0; PAIR]; GROUP];
                for (row, entries) in rows.iter_mut().enumerate() {
                    for (column, entry) in entries.iter_mut().enumerate().skip(row) {
                        let (at, other) = (GROUP * group + row, GROUP * group + column);
                        if other < size {
                            let seed = f64::from(u32::try_from(17 * at + 5 * other).expect("few"));
                            *entry = libm::sin(seed)
                                + match (row == column, row < 2) {
                                    (false, _) => 0.0,
                                    (true, true) => 9.0,
                                    (true, false) => -9.0,
                                };
                            (dense[(at, other)], dense[(other, at)]) = (*entry, *entry);
                        }
                    }
                }
                blocks.push(rows);
            }
            let wanted: Vec<[f64; 2]> =
                (0..size).zip(0..).map(|(_, i)| [libm::cos(f64::from(i)), 1.0 - 0.3 * f64::from(i)]).collect();
            let side = |of: usize| &dense * DVector::from_iterator(size, wanted.iter().map(|both| both[of]));
            let (first, second) = (side(0), side(1));
            let both: Vec<[f64; 2]> = first.iter().zip(&second).map(|(a, b)| [*a, *b]).collect();
            let (chunks, _) = both.as_chunks::<GROUP>();
            let mut right = chunks.to_vec();
            blocks.solve(&mut right);
            for (found, wanted) in right.iter().flatten().zip(&wanted) {
                assert!((found[0] - wanted[0]).abs() < 1e-12 && (found[1] - wanted[1]).abs() < 1e-12, "{groups}");
            }
        }
    }
}
