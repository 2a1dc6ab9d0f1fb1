//! Linear programs of a few unknowns: the simplex method on a dense tableau (G. B. Dantzig 1951; against cycling, R. G.
//! Bland's rule, Mathematics of Operations Research 2 (1977) 103–107).

/// Pivots by the steepest cost; then as many again by Bland's rule.
const PIVOTS: usize = 100;

/// Costs and coefficients below this count as zero.
const SMALL: f64 = 1e-11;

/// coefficients · x ≤ right.
#[derive(Debug, Clone, PartialEq)]
pub struct Inequality {
    /// Coefficient of each unknown.
    pub coefficients: Vec<f64>,
    /// The right side.
    pub right: f64,
}

struct Tableau {
    /// Coefficients, those of the slacks, the right side.
    rows: Vec<Vec<f64>>,
    costs: Vec<f64>,
    basis: Vec<usize>,
}

impl Tableau {
    fn new(costs: &[f64], rows: &[Inequality]) -> Self {
        let with_slacks = rows.iter().enumerate().map(|(index, row)| {
            let slacks = (0..rows.len()).map(|other| if other == index { 1.0 } else { 0.0 });
            row.coefficients.iter().copied().chain(slacks).chain([row.right]).collect()
        });
        Self {
            rows: with_slacks.collect(),
            costs: costs.iter().copied().chain(vec![0.0; rows.len() + 1]).collect(),
            basis: (0..rows.len()).map(|row| costs.len() + row).collect(),
        }
    }

    fn pivot(&mut self, row: usize, column: usize) {
        let Some(own) = self.rows.get_mut(row) else { return };
        let factor = 1.0 / own.get(column).copied().unwrap_or(f64::NAN);
        for value in own.iter_mut() {
            *value *= factor;
        }
        let own = own.clone();
        let others = self.rows.iter_mut().enumerate().filter(|(index, _)| *index != row).map(|(_, other)| other);
        for other in others.chain([&mut self.costs]) {
            let factor = other.get(column).copied().unwrap_or(0.0);
            if factor != 0.0 {
                for (value, own) in other.iter_mut().zip(&own) {
                    *value -= factor * own;
                }
            }
        }
        if let Some(basic) = self.basis.get_mut(row) {
            *basic = column;
        }
    }

    /// Makes every right side positive in the rows that contain −1 in a column.
    fn relieve(&mut self, column: usize) {
        let holding = self.rows.iter().enumerate().filter(|(_, row)| row.get(column).is_some_and(|c| *c == -1.0));
        let negative = holding.map(|(index, row)| (index, right_side(row))).filter(|(_, right)| *right < 0.0);
        if let Some((row, _)) = negative.min_by(|(_, a), (_, b)| a.total_cmp(b)) {
            self.pivot(row, column);
        }
    }

    fn entering(&self, steepest: bool) -> Option<usize> {
        let count = self.costs.len().saturating_sub(1);
        let mut falling = self.costs.iter().copied().take(count).enumerate().filter(|(_, cost)| *cost < -SMALL);
        let chosen = if steepest { falling.min_by(|(_, a), (_, b)| a.total_cmp(b)) } else { falling.next() };
        chosen.map(|(column, _)| column)
    }

    fn leaving(&self, column: usize) -> Option<usize> {
        let ratios = self.rows.iter().zip(&self.basis).enumerate().filter_map(|(index, (row, basic))| {
            let coefficient = row.get(column).copied().unwrap_or(0.0);
            (coefficient > SMALL).then(|| (index, right_side(row).max(0.0) / coefficient, *basic))
        });
        ratios.min_by(|a, b| a.1.total_cmp(&b.1).then(a.2.cmp(&b.2))).map(|(index, ..)| index)
    }
}

fn right_side(row: &[f64]) -> f64 {
    row.last().copied().unwrap_or(0.0)
}

/// The optimum of a linear program.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearOptimum {
    /// The unknowns.
    pub unknowns: Vec<f64>,
    /// By how much the least costs fall for each unit by which the right side of a row grows; 0 for a row that does not bind.
    pub prices: Vec<f64>,
}

/// x ≥ 0 with the least costs · x under the rows; `None` where it is unbounded or does not converge.
///
/// A row with a negative right side must contain −1 in exactly one of the `elastic` columns, and no row may contain two of them.
#[must_use]
pub fn least(costs: &[f64], rows: &[Inequality], elastic: &[usize]) -> Option<LinearOptimum> {
    let mut tableau = Tableau::new(costs, rows);
    for column in elastic {
        tableau.relieve(*column);
    }
    for pivot in 0..2 * PIVOTS {
        let Some(column) = tableau.entering(pivot < PIVOTS) else {
            let mut unknowns = vec![0.0; costs.len()];
            for (row, basic) in tableau.rows.iter().zip(&tableau.basis) {
                if let Some(place) = unknowns.get_mut(*basic) {
                    *place = row.last().copied().unwrap_or(f64::NAN);
                }
            }
            let prices = tableau.costs.iter().copied().skip(costs.len()).take(rows.len()).collect();
            return Some(LinearOptimum { unknowns, prices });
        };
        let row = tableau.leaving(column)?;
        tableau.pivot(row, column);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(coefficients: &[f64], right: f64) -> Inequality {
        Inequality { coefficients: coefficients.to_vec(), right }
    }

    #[test]
    fn finds_corners() {
        // Dantzig's book: 3x + 5y largest under x ≤ 4, 2y ≤ 12, 3x + 2y ≤ 18.
        let rows = [row(&[1.0, 0.0], 4.0), row(&[0.0, 2.0], 12.0), row(&[3.0, 2.0], 18.0)];
        let found = least(&[-3.0, -5.0], &rows, &[]).expect("bounded");
        let (at, prices) = (&found.unknowns, &found.prices);
        assert!((at[0] - 2.0).abs() < 1e-14 && (at[1] - 6.0).abs() < 1e-14, "{found:?}");
        // The dual of the book: 0, 3/2 and 1.
        for (price, known) in prices.iter().zip([0.0, 1.5, 1.0]) {
            assert!((price - known).abs() < 1e-14, "{found:?}");
        }
        assert_eq!(least(&[-1.0, 0.0], &rows[1..2], &[]), None);
    }

    #[test]
    fn an_epigraph_begins_below() {
        // The least of max(2 − x, x − 1, 0.2 + x/10) over 0 ≤ x ≤ 3 by t ≥ each: x = 1.5, t = 0.5.
        let rows = [row(&[-1.0, -1.0], -2.0), row(&[1.0, -1.0], 1.0), row(&[0.1, -1.0], -0.2), row(&[1.0, 0.0], 3.0)];
        let found = least(&[0.0, 1.0], &rows, &[1]).expect("bounded").unknowns;
        assert!((found[0] - 1.5).abs() < 1e-14 && (found[1] - 0.5).abs() < 1e-14, "{found:?}");
    }
}
