//! The quintic spline of least ∫(s''')²: through given values, with continuous derivatives up to the fourth where no other condition is given
//! (I. J. Schoenberg, "Spline functions and the problem of graduation", 1964; C. H. Reinsch, 1967, for the principle).
//!
//! The unknowns are velocity and acceleration at every node. With Hermite's quintics between the nodes the integral is a positive
//! definite quadratic form of them, and its minimum makes third and fourth derivative continuous, or 0 at a free end. The nodes form
//! a ring; in the order 0, n−1, 1, n−2, … its matrix is a band, so that a ring costs no more than a chain.

use super::banded::BandedMatrix;

/// Velocity and acceleration at a node, where they are given.
pub type NodeConstraint = [Option<f64>; 2];

/// From a node to the next: its width and by how much the value grows; `None` where they are not joined.
pub type NodeInterval = Option<(f64, f64)>;

/// Half the bandwidth of two unknowns at nodes that are two places apart, and the diagonal.
const BAND: usize = 6;

/// Velocity and acceleration at every node of a ring; interval k leads from node k to the next, the last to node 0.
#[must_use]
pub fn least_jerk(intervals: &[NodeInterval], given: &[NodeConstraint]) -> Vec<[f64; 2]> {
    let count = given.len().min(intervals.len());
    let mut matrix = BandedMatrix::<BAND>::zero(2 * count);
    let mut right = vec![0.0; 2 * count];
    let mut joined = vec![false; count];
    for (node, interval) in intervals.iter().enumerate().take(count) {
        let Some((width, rise)) = *interval else { continue };
        let next = (node + 1) % count;
        for node in [node, next] {
            if let Some(joined) = joined.get_mut(node) {
                *joined = true;
            }
        }
        let unknowns = [(node, 0), (node, 1), (next, 0), (next, 1)];
        let fixed = unknowns.map(|(node, which)| given.get(node).and_then(|given| given.get(which)).copied().flatten());
        let rows = unknowns.map(|(node, which)| row_of(node, count) + which);
        for (weight, form, constant) in forms(width, rise) {
            let known: f64 = constant + form.iter().zip(fixed).map(|(l, value)| l * value.unwrap_or(0.0)).sum::<f64>();
            for (first, (row, l)) in rows.iter().zip(form).enumerate().filter(|(at, _)| free(&fixed, *at)) {
                add(&mut right, *row, -weight * l * known);
                for (second, (column, m)) in rows.iter().zip(form).enumerate().skip(first) {
                    if free(&fixed, second) {
                        // Two ends of one interval at one node share one entry.
                        let both = if first != second && row == column { 2.0 } else { 1.0 };
                        matrix.add(*row, *column, both * weight * l * m);
                    }
                }
            }
        }
    }
    for (node, (given, joined)) in given.iter().zip(&joined).enumerate() {
        for (which, value) in given.iter().enumerate() {
            if value.is_some() || !joined {
                let row = row_of(node, count) + which;
                matrix.add(row, row, 1.0);
                add(&mut right, row, value.unwrap_or(0.0));
            }
        }
    }
    matrix.factored().solve(&mut right);
    let rows = (0..count).map(|node| row_of(node, count));
    rows.map(|row| [row, row + 1].map(|index| right.get(index).copied().unwrap_or(0.0))).collect()
}

/// The row of the velocity at a node of a ring, in the order 0, n−1, 1, n−2, …; that of its acceleration is the next.
fn row_of(node: usize, count: usize) -> usize {
    if 2 * node < count { 4 * node } else { 2 * (2 * (count - 1 - node) + 1) }
}

fn free(fixed: &[Option<f64>; 4], at: usize) -> bool {
    fixed.get(at).is_some_and(Option::is_none)
}

fn add(list: &mut [f64], index: usize, value: f64) {
    if let Some(slot) = list.get_mut(index) {
        *slot += value;
    }
}

/// ∫(s''')² over an interval as three squares: weight, factors of velocity and acceleration at both ends, and a constant.
///
/// With V = v h, A = a h² and the rise D, s''' h³ is α P₀ + β P₁ + γ P₂ in Legendre's polynomials over the interval, α = A₁ − A₀,
/// β = 6 (V₀ − V₁) + 3 (A₀ + A₁), γ = 60 D − 30 (V₀ + V₁) − 5 (A₀ − A₁), and the integral (α² + β²/3 + γ²/5)/h⁵.
pub(super) fn forms(width: f64, rise: f64) -> [(f64, [f64; 4], f64); 3] {
    let (h, square) = (width, width * width);
    let weight = 1.0 / (square * square * width);
    [
        (weight, [0.0, -1.0, 0.0, 1.0], 0.0),
        (weight / 3.0, [6.0, 3.0, -6.0, 3.0], 0.0),
        (weight / 5.0, [-30.0, -5.0, -30.0, 5.0], 60.0 * rise),
    ]
    .map(|(weight, [v0, a0, v1, a1], constant)| (weight, [v0 * h, a0 * square, v1 * h, a1 * square], constant))
}

/// The fifth derivative between two nodes.
fn fifth(width: f64, rise: f64, [v0, a0]: [f64; 2], [v1, a1]: [f64; 2]) -> f64 {
    let (h, square) = (width, width * width);
    (720.0 * rise - 360.0 * h * (v0 + v1) - 60.0 * square * (a0 - a1)) / (square * square * width)
}

/// Velocity and acceleration at knots of an open spline whose fifth derivative is continuous at the two knots next to either end
/// ("not a knot"), so that a polynomial of degree 5 comes back; through six knots or fewer the polynomial itself.
#[must_use]
pub fn not_a_knot(knots: &[f64], values: &[f64]) -> Vec<[f64; 2]> {
    let count = knots.len().min(values.len());
    if count <= 6 {
        return of_polynomial(knots, values);
    }
    let pairs = knots.iter().zip(knots.iter().skip(1)).zip(values.iter().zip(values.iter().skip(1)));
    let intervals: Vec<NodeInterval> =
        pairs.map(|((x0, x1), (y0, y1))| Some((x1 - x0, y1 - y0))).take(count - 1).chain([None]).collect();
    let flat: Vec<NodeInterval> = intervals.iter().map(|interval| interval.map(|(width, _)| (width, 0.0))).collect();
    let length = (knots.last().unwrap_or(&1.0) - knots.first().unwrap_or(&0.0)) / mean(count);
    let (v, a) = (1.0 / length, 1.0 / (length * length));
    let units = [[v, 0.0, 0.0, 0.0], [0.0, a, 0.0, 0.0], [0.0, 0.0, v, 0.0], [0.0, 0.0, 0.0, a]];
    // The spline is linear in the values given at its ends.
    let columns = units.map(|ends| jumps(&flat, &between_ends(&flat, count, ends), count));
    let mut ends = [0.0; 4];
    // The second pass removes the rounding of the first.
    for _ in 0..2 {
        let left = jumps(&intervals, &between_ends(&intervals, count, ends), count);
        let steps = solve_four(&columns, left);
        for (unit, step) in units.into_iter().zip(steps) {
            for (end, unit) in ends.iter_mut().zip(unit) {
                *end -= step * unit;
            }
        }
    }
    between_ends(&intervals, count, ends)
}

/// The spline of least jerk of an open chain with given velocity and acceleration at its first and at its last node.
fn between_ends(intervals: &[NodeInterval], count: usize, [v0, a0, v1, a1]: [f64; 4]) -> Vec<[f64; 2]> {
    let mut given = vec![[None; 2]; count];
    for (end, values) in [(0, [v0, a0]), (count - 1, [v1, a1])] {
        if let Some(given) = given.get_mut(end) {
            *given = values.map(Some);
        }
    }
    least_jerk(intervals, &given)
}

#[expect(clippy::cast_precision_loss, reason = "at most some ten thousand knots")]
fn mean(count: usize) -> f64 {
    (count - 1) as f64
}

/// By how much the fifth derivative jumps at the two knots next to either end, times the widths to the fifth.
fn jumps(intervals: &[NodeInterval], states: &[[f64; 2]], count: usize) -> [f64; 4] {
    [1, 2, count - 3, count - 2].map(|knot| {
        let around = [knot - 1, knot].map(|index| {
            let (interval, from, to) =
                (intervals.get(index).copied().flatten()?, states.get(index)?, states.get(index + 1)?);
            Some((fifth(interval.0, interval.1, *from, *to), interval.0))
        });
        let [Some((before, a)), Some((after, b))] = around else { return 0.0 };
        let width = a.min(b);
        (after - before) * width * width * width * width * width
    })
}

/// x with Σ columnsₖ xₖ = right, by Gauss elimination with pivots.
fn solve_four(columns: &[[f64; 4]; 4], right: [f64; 4]) -> [f64; 4] {
    let [[a0, a1, a2, a3], [b0, b1, b2, b3], [c0, c1, c2, c3], [d0, d1, d2, d3]] = *columns;
    let [r0, r1, r2, r3] = right;
    let mut rows = vec![[a0, b0, c0, d0, r0], [a1, b1, c1, d1, r1], [a2, b2, c2, d2, r2], [a3, b3, c3, d3, r3]];
    let mut done: Vec<[f64; 5]> = Vec::new();
    for column in 0..4 {
        let sizes = rows.iter().map(|row| row[column].abs()).enumerate();
        let Some((pivot, _)) = sizes.max_by(|(_, a), (_, b)| a.total_cmp(b)) else { break };
        let pivot = rows.swap_remove(pivot);
        for row in &mut rows {
            let factor = row[column] / pivot[column];
            for (value, above) in row.iter_mut().zip(pivot) {
                *value -= factor * above;
            }
        }
        done.push(pivot);
    }
    let mut solution = [0.0; 4];
    for (column, row) in done.iter().enumerate().rev() {
        let known: f64 = row.iter().zip(solution).skip(column + 1).map(|(factor, value)| factor * value).sum();
        if let Some(slot) = solution.get_mut(column) {
            *slot = (row[4] - known) / row[column];
        }
    }
    solution
}

/// Velocity and acceleration at each knot of the one polynomial through all, in Newton's form.
fn of_polynomial(knots: &[f64], values: &[f64]) -> Vec<[f64; 2]> {
    let mut row = values.to_vec();
    let mut coefficients: Vec<f64> = row.first().copied().into_iter().collect();
    for order in 1..knots.len() {
        let spans = knots.iter().zip(knots.iter().skip(order)).map(|(a, b)| b - a);
        row = row.iter().zip(row.iter().skip(1)).zip(spans).map(|((a, b), span)| (b - a) / span).collect();
        coefficients.extend(row.first());
    }
    let states = knots.iter().map(|x| {
        let (mut value, mut first, mut second) = (0.0, 0.0, 0.0);
        for (coefficient, knot) in coefficients.iter().zip(knots).rev() {
            let t = x - knot;
            second = second * t + 2.0 * first;
            first = first * t + value;
            value = value * t + coefficient;
        }
        [first, second]
    });
    states.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn near(found: f64, wanted: f64, tolerance: f64) {
        assert!((found - wanted).abs() <= tolerance, "{found} is not {wanted}, by {:e}", (found - wanted).abs());
    }

    /// A polynomial of degree 5 comes back from any number of knots, at any distances.
    #[test]
    fn a_quintic_comes_back() {
        let f = |x: f64| 1.0 - 2.0 * x + x * x - 3.0 * x.powi(3) + 0.5 * x.powi(4) + 2.0 * x.powi(5);
        let first = |x: f64| -2.0 + 2.0 * x - 9.0 * x * x + 2.0 * x.powi(3) + 10.0 * x.powi(4);
        let second = |x: f64| 2.0 - 18.0 * x + 6.0 * x * x + 40.0 * x.powi(3);
        for count in [6, 7, 8, 9, 13, 40, 400] {
            let knots: Vec<f64> = (0..count)
                .map(|index| {
                    let x = f64::from(index) / f64::from(count - 1);
                    x + 0.04 * (12.0 * x).sin() * x * (1.0 - x)
                })
                .collect();
            let values: Vec<f64> = knots.iter().map(|x| f(*x)).collect();
            for (x, [v, a]) in knots.iter().zip(not_a_knot(&knots, &values)) {
                // Rounding of the values is divided by the step to the order.
                let step = f64::from(count);
                near(v, first(*x), 1e-14 * step);
                near(a, second(*x), 1e-13 * step * step);
            }
        }
    }

    /// Where velocity and acceleration are free at both ends, the third and the fourth derivative are 0: here a parabola.
    #[test]
    fn free_ends_bend_as_little_as_possible() {
        let given = [[None; 2]; 4];
        let (knots, f) = ([0.0, 0.3, 0.9, 1.0], |x: f64| 1.0 + x - 2.0 * x * x);
        let mut intervals: Vec<NodeInterval> =
            knots.windows(2).map(|pair| Some((pair[1] - pair[0], f(pair[1]) - f(pair[0])))).collect();
        intervals.push(None);
        for (x, [v, a]) in knots.iter().zip(least_jerk(&intervals, &given)) {
            near(v, 1.0 - 4.0 * x, 1e-12);
            near(a, -4.0, 1e-12);
        }
    }

    /// With 2000 equal steps of a sine the derivatives are those of the sine, and a ring closes.
    #[test]
    fn a_long_ring_is_solved() {
        let count = 2000;
        let step = std::f64::consts::TAU / f64::from(count);
        let values: Vec<f64> = (0..=count).map(|index| (f64::from(index) * step).sin()).collect();
        let intervals: Vec<NodeInterval> = values.windows(2).map(|pair| Some((step, pair[1] - pair[0]))).collect();
        let states = least_jerk(&intervals, &vec![[None; 2]; 2000]);
        for (index, [v, a]) in states.iter().enumerate() {
            let angle = f64::from(u32::try_from(index).expect("small")) * step;
            near(*v, angle.cos(), 1e-12);
            near(*a, -angle.sin(), 1e-8);
        }
    }
}
