//! Systems of a few linear equations, with as many unknowns or more: Gauss and Jordan's elimination with complete pivoting (Golub, Van
//! Loan, Matrix Computations, §3.4.8).
//!
//! nalgebra's elimination with complete pivoting gives no directions of a wide system, and other last digits, which would change laws.

/// A pivot below this share of its equation's largest coefficient counts as 0 with rounding.
const SMALL: f64 = 1e-12;

/// Every solution of a system.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearSolutions {
    /// One of them.
    pub particular: Vec<f64>,
    /// Vectors that may be added to it in any multiple; none for a square system.
    pub directions: Vec<Vec<f64>>,
}

/// The solutions of coefficients · x = right, given as pairs, for this many unknowns; `None` where the equations depend on each other.
#[must_use]
pub fn solutions(equations: &[(Vec<f64>, f64)], unknowns: usize) -> Option<LinearSolutions> {
    let mut rows: Vec<(Vec<f64>, f64)> = equations.iter().filter_map(scaled).collect();
    if rows.len() != equations.len() {
        return None;
    }
    // The unknown that each row gives, once it has been a pivot.
    let mut given: Vec<Option<usize>> = vec![None; rows.len()];
    for _ in 0..rows.len() {
        let open = rows.iter().zip(&given).enumerate().filter(|(_, (_, given))| given.is_none());
        let entries = open.flat_map(|(row, ((coefficients, _), _))| {
            coefficients.iter().take(unknowns).enumerate().map(move |(column, value)| (row, column, *value))
        });
        let (row, column, pivot) = entries.max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()))?;
        // NaN is not a pivot.
        if !(pivot.abs() > SMALL && pivot.is_finite()) {
            return None;
        }
        eliminate(&mut rows, row, column, pivot);
        *given.get_mut(row)? = Some(column);
    }
    let mut particular = vec![0.0; unknowns];
    for ((_, right), column) in rows.iter().zip(&given) {
        *particular.get_mut((*column)?)? = *right;
    }
    let free = (0..unknowns).filter(|column| !given.contains(&Some(*column)));
    let directions = free.map(|column| {
        let mut direction = vec![0.0; unknowns];
        *direction.get_mut(column)? = 1.0;
        for ((coefficients, _), own) in rows.iter().zip(&given) {
            *direction.get_mut((*own)?)? = -coefficients.get(column).copied()?;
        }
        Some(direction)
    });
    let directions = directions.collect::<Option<_>>()?;
    Some(LinearSolutions { particular, directions })
}

/// An equation divided by its largest coefficient.
fn scaled((coefficients, right): &(Vec<f64>, f64)) -> Option<(Vec<f64>, f64)> {
    let largest = coefficients.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    (largest > 0.0 && largest.is_finite())
        .then(|| (coefficients.iter().map(|value| value / largest).collect(), right / largest))
}

/// Makes a pivot 1, and all other entries of its column 0.
fn eliminate(rows: &mut [(Vec<f64>, f64)], row: usize, column: usize, pivot: f64) {
    let Some((coefficients, right)) = rows.get_mut(row) else { return };
    for value in coefficients.iter_mut() {
        *value /= pivot;
    }
    *right /= pivot;
    let (own, right) = (coefficients.clone(), *right);
    for (_, (others, other)) in rows.iter_mut().enumerate().filter(|(index, _)| *index != row) {
        let factor = others.get(column).copied().unwrap_or(0.0);
        for (value, own) in others.iter_mut().zip(&own) {
            *value -= factor * own;
        }
        *other -= factor * right;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn square_and_wide_systems_are_solved() {
        let square = [(vec![0.0, 2.0, 1.0], 7.0), (vec![1e6, -1e6, 0.0], -1e6), (vec![3.0, 0.0, -1.0], 0.0)];
        let found = solutions(&square, 3).expect("independent");
        for (found, known) in found.particular.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - known).abs() < 1e-14, "{found} {known}");
        }
        assert!(found.directions.is_empty());
        let wide = [(vec![1.0, 4.0, 2.0, -1.0], 3.0), (vec![2.0, 1.0, 0.5, 1.0], -1.0)];
        let found = solutions(&wide, 4).expect("independent");
        let product = |row: &[f64], x: &[f64]| row.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
        assert_eq!(found.directions.len(), 2);
        for (row, right) in &wide {
            assert!((product(row, &found.particular) - right).abs() < 1e-14, "{found:?}");
            assert!(found.directions.iter().all(|way| product(row, way).abs() < 1e-14), "{found:?}");
        }
        assert_eq!(solutions(&[(vec![1.0, 2.0], 1.0), (vec![2.0, 4.0], 3.0)], 2), None);
        assert_eq!(solutions(&[(vec![0.0, 0.0], 1.0)], 2), None);
    }
}
