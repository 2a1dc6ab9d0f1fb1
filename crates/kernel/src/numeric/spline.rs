//! The cubic spline with "not-a-knot" ends (C. de Boor, A Practical Guide to Splines, 1978, ch. IV): third derivatives
//! agree across the second and the last but one knot, so that a cubic is reproduced and no end slope is invented. Two
//! knots give a straight line, three a parabola.

/// A spline through values at increasing knots.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    knots: Vec<f64>,
    /// Per interval: value, slope, half the second and a sixth of the third derivative at its left knot.
    cubics: Vec<[f64; 4]>,
}

impl Spline {
    /// Through `values` at `knots`, both of equal length, knots increasing.
    #[must_use]
    pub fn not_a_knot(knots: &[f64], values: &[f64]) -> Self {
        Self::with_second(knots, values, &second_derivatives(knots, values))
    }

    /// Through `values` at `knots` with the given slopes at either end; two knots or more.
    #[must_use]
    pub fn clamped(knots: &[f64], values: &[f64], ends: (f64, f64)) -> Self {
        let (h, d) = (widths(knots), slopes(knots, values));
        let last = h.len();
        // The first and the last row hold the slopes at the ends.
        let rows = (0..=last).map(|i| match i {
            0 => [0.0, 2.0 * entry(&h, 0), entry(&h, 0), 6.0 * (entry(&d, 0) - ends.0)],
            i if i == last => [entry(&h, i - 1), 2.0 * entry(&h, i - 1), 0.0, 6.0 * (ends.1 - entry(&d, i - 1))],
            i => inner_row(entry(&h, i - 1), entry(&h, i), entry(&d, i) - entry(&d, i - 1)),
        });
        Self::with_second(knots, values, &tridiagonal(rows))
    }

    /// Through `values` at `knots` over one period, the last value that of the first; three intervals or more.
    #[must_use]
    pub fn periodic(knots: &[f64], values: &[f64]) -> Self {
        let (h, d) = (widths(knots), slopes(knots, values));
        let mut second = cyclic(&h, &d);
        second.extend(second.first().copied());
        Self::with_second(knots, values, &second)
    }

    /// Of each interval: value, slope, half the second and a sixth of the third derivative at its left knot.
    #[must_use]
    pub fn cubics(&self) -> &[[f64; 4]] {
        &self.cubics
    }

    /// From the second derivatives at the knots.
    fn with_second(knots: &[f64], values: &[f64], second: &[f64]) -> Self {
        let intervals = knots.iter().zip(knots.iter().skip(1)).zip(values.iter().zip(values.iter().skip(1)));
        let cubics = intervals.zip(second.iter().zip(second.iter().skip(1))).map(|(((x0, x1), (y0, y1)), (m0, m1))| {
            let h = x1 - x0;
            [*y0, (y1 - y0) / h - h * (2.0 * m0 + m1) / 6.0, 0.5 * m0, (m1 - m0) / (6.0 * h)]
        });
        let cubics = cubics.collect();
        Self { knots: knots.to_vec(), cubics }
    }

    /// The control values of the same function as a cubic B-spline on [`bspline_knots`]: the blossom of the cubic of an
    /// interval at three consecutive knots (L. Ramshaw, 1987).
    #[must_use]
    pub fn controls(&self) -> Vec<f64> {
        let full = bspline_knots(&self.knots);
        let count = self.cubics.len() + 3;
        let controls = (0..count).map(|control| {
            // Any interval within the support is suitable; this one contains the middle of the three knots or touches it.
            let interval = control.saturating_sub(1).min(self.cubics.len() - 1);
            let (Some(start), Some([c0, c1, c2, c3])) = (self.knots.get(interval), self.cubics.get(interval)) else {
                return f64::NAN;
            };
            let [a, b, c] = [1, 2, 3].map(|n| full.get(control + n).copied().unwrap_or(f64::NAN) - start);
            c0 + c1 * (a + b + c) / 3.0 + c2 * (a * b + b * c + c * a) / 3.0 + c3 * a * b * c
        });
        controls.collect()
    }

    /// Value and first three derivatives; beyond the ends the outer cubics go on. At a knot the later one counts.
    #[must_use]
    pub fn values_at(&self, x: f64) -> [f64; 4] {
        let index = interval_of(&self.knots, x);
        let (Some(knot), Some(cubic)) = (self.knots.get(index), self.cubics.get(index)) else {
            return [f64::NAN; 4];
        };
        cubic_at(cubic, x - knot)
    }
}

/// The interval between knots that contains a place: the first or the last one beyond the ends, the later one at a knot.
#[must_use]
#[inline]
pub fn interval_of(knots: &[f64], x: f64) -> usize {
    let last = knots.len().saturating_sub(2);
    knots.partition_point(|knot| *knot <= x).saturating_sub(1).min(last)
}

/// Value and first three derivatives of a cubic at a distance from the left knot of its interval.
#[must_use]
#[inline]
pub fn cubic_at([a, b, c, d]: &[f64; 4], t: f64) -> [f64; 4] {
    [((d * t + c) * t + b) * t + a, (3.0 * d * t + 2.0 * c) * t + b, 6.0 * d * t + 2.0 * c, 6.0 * d]
}

/// The knots of a cubic B-spline with joints at `knots`: either end four times.
#[must_use]
pub fn bspline_knots(knots: &[f64]) -> Vec<f64> {
    let (first, last) = (knots.first().copied().unwrap_or(0.0), knots.last().copied().unwrap_or(0.0));
    let mut full = vec![first; 3];
    full.extend_from_slice(knots);
    full.extend([last; 3]);
    full
}

/// The four cubic B-splines that do not vanish at `x`, their slopes, and the index of the first (The NURBS Book, A2.2,
/// A2.3); `knots` are those of [`bspline_knots`].
#[must_use]
pub fn bspline_basis(knots: &[f64], x: f64) -> (usize, [f64; 4], [f64; 4]) {
    let last = knots.len().saturating_sub(5);
    let span = knots.partition_point(|knot| *knot <= x).saturating_sub(1).clamp(3, last);
    // Three knots to either side of x.
    let near = knots.get(span - 2..).and_then(|knots| knots.first_chunk::<6>()).unwrap_or(&[f64::NAN; 6]);
    let (mut basis, mut slopes) = ([1.0, 0.0, 0.0, 0.0], [0.0; 4]);
    for degree in 1..=3_usize {
        let (mut saved, mut lower) = (0.0, 0.0);
        for r in 0..degree {
            let (right, left) = (near[3 + r] - x, x - near[3 + r - degree]);
            let width = right + left;
            let value = basis[r] / width;
            if degree == 3 {
                // Slope 3 (Nᵢ/(tᵢ₊₃ − tᵢ) − Nᵢ₊₁/(tᵢ₊₄ − tᵢ₊₁)).
                slopes[r] = 3.0 * (lower - value);
                lower = value;
            }
            basis[r] = saved + right * value;
            saved = left * value;
        }
        basis[degree] = saved;
        slopes[3] = 3.0 * lower;
    }
    (span - 3, basis, slopes)
}

fn widths(knots: &[f64]) -> Vec<f64> {
    knots.iter().zip(knots.iter().skip(1)).map(|(a, b)| b - a).collect()
}

/// Slopes of the chords.
fn slopes(knots: &[f64], values: &[f64]) -> Vec<f64> {
    let rises = values.iter().zip(values.iter().skip(1)).map(|(a, b)| b - a);
    rises.zip(widths(knots)).map(|(rise, h)| rise / h).collect()
}

/// Coefficients below, on and above the diagonal and the right side, for the second derivative at a knot between
/// intervals of widths a and b whose chords turn by `bend`.
fn inner_row(a: f64, b: f64, bend: f64) -> [f64; 4] {
    [a, 2.0 * (a + b), b, 6.0 * bend]
}

/// Solves rows of below, diagonal, above and right side, by Thomas' algorithm.
fn tridiagonal(rows: impl Iterator<Item = [f64; 4]>) -> Vec<f64> {
    let mut eliminated: Vec<(f64, f64)> = Vec::new();
    for [below, diagonal, above, right] in rows {
        let (factor, before) = eliminated.last().copied().unwrap_or((0.0, 0.0));
        let pivot = diagonal - below * factor;
        eliminated.push((above / pivot, (right - below * before) / pivot));
    }
    let mut next = 0.0;
    let solution = eliminated.iter().rev().map(|(factor, right)| {
        next = right - factor * next;
        next
    });
    let mut solution: Vec<f64> = solution.collect();
    solution.reverse();
    solution
}

/// The second derivatives at the knots of a periodic spline, except the last, which equals the first; intervals of widths
/// `h` whose chords have the slopes `d`. The two corners of the cyclic matrix are removed as a product of two vectors
/// (Sherman and Morrison, 1950).
fn cyclic(h: &[f64], d: &[f64]) -> Vec<f64> {
    let (Some(last), Some(first)) = (h.last().copied(), h.first().copied()) else { return Vec::new() };
    let pairs = h.iter().zip(d);
    let before = std::iter::once((&last, d.last().unwrap_or(&0.0))).chain(pairs.clone());
    let (gamma, end) = (-2.0 * (last + first), h.len() - 1);
    let rows = before.zip(pairs).enumerate().map(|(index, ((a, left), (b, right)))| {
        let [below, mut diagonal, above, bend] = inner_row(*a, *b, right - left);
        diagonal -= if index == 0 { gamma } else { 0.0 };
        diagonal -= if index == end { last * last / gamma } else { 0.0 };
        [if index == 0 { 0.0 } else { below }, diagonal, if index == end { 0.0 } else { above }, bend]
    });
    let rows: Vec<[f64; 4]> = rows.collect();
    let solved = tridiagonal(rows.iter().copied());
    let other = tridiagonal(rows.iter().enumerate().map(|(index, [a, b, c, _])| {
        let corner = match index {
            0 => gamma,
            index if index == end => last,
            _ => 0.0,
        };
        [*a, *b, *c, corner]
    }));
    let [along_solved, along_other] = [&solved, &other]
        .map(|list| list.first().copied().unwrap_or(0.0) + last * list.last().copied().unwrap_or(0.0) / gamma);
    let factor = along_solved / (1.0 + along_other);
    solved.iter().zip(&other).map(|(value, other)| value - factor * other).collect()
}

/// The second derivative at an end knot, from those at the two knots next to it and the two widths there.
fn outer_second(second: [Option<&f64>; 2], widths: [Option<&f64>; 2]) -> f64 {
    match (second, widths) {
        ([Some(m1), Some(m2)], [Some(a), Some(b)]) => ((a + b) * m1 - a * m2) / b,
        ([Some(m1), None], _) => *m1,
        _ => 0.0,
    }
}

fn entry(list: &[f64], index: usize) -> f64 {
    list.get(index).copied().unwrap_or(0.0)
}

/// The second derivatives at the knots. With the end conditions M₀ = ((a+b) M₁ − a M₂)/b the outer unknowns are folded
/// into the first and the last row.
fn second_derivatives(knots: &[f64], values: &[f64]) -> Vec<f64> {
    let (h, d) = (widths(knots), slopes(knots, values));
    let inner = knots.len().saturating_sub(2);
    let second = tridiagonal((0..inner).map(|i| {
        let (a, b) = (entry(&h, i), entry(&h, i + 1));
        let [mut below, mut diagonal, mut above, right] = inner_row(a, b, entry(&d, i + 1) - entry(&d, i));
        if inner == 1 {
            // Three knots: a parabola, one second derivative.
            return [0.0, 3.0 * (a + b), 0.0, right];
        }
        if i == 0 {
            diagonal += a * (a + b) / b;
            above -= a * a / b;
        }
        if i + 1 == inner {
            diagonal += b * (a + b) / a;
            below -= b * b / a;
        }
        [below, diagonal, above, right]
    }));
    let first = outer_second([second.first(), second.get(1)], [h.first(), h.get(1)]);
    let last = outer_second([second.last(), second.iter().nth_back(1)], [h.last(), h.iter().nth_back(1)]);
    std::iter::once(first).chain(second).chain([last]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_come_back() {
        let knots = [0.0, 0.7, 1.1, 2.5, 3.0];
        for (count, degree) in [(2, 1), (3, 2), (4, 3), (5, 3)] {
            let f = |x: f64| {
                2.0 - x + if degree > 1 { 0.5 * x * x } else { 0.0 } - if degree > 2 { x * x * x } else { 0.0 }
            };
            let knots = &knots[..count];
            let values: Vec<f64> = knots.iter().map(|x| f(*x)).collect();
            let spline = Spline::not_a_knot(knots, &values);
            for i in 0..=20 {
                let x = -0.5 + 0.2 * f64::from(i);
                assert!(
                    (spline.values_at(x)[0] - f(x)).abs() < 1e-13 * (1.0 + f(x).abs()) * 10.0,
                    "{count} knots at {x}"
                );
            }
        }
    }

    #[test]
    fn a_clamped_spline_keeps_its_ends_and_its_controls_are_the_same_function() {
        let knots = [0.0, 0.4, 1.0, 1.3, 2.0];
        let values: Vec<f64> = knots.iter().map(|x| libm::sin(*x)).collect();
        for (spline, ends) in [
            (Spline::clamped(&knots, &values, (1.0, libm::cos(2.0))), true),
            (Spline::not_a_knot(&knots, &values), false),
            (Spline::not_a_knot(&knots[..2], &values[..2]), false),
            (Spline::clamped(&knots[..2], &values[..2], (1.0, libm::cos(0.4))), false),
        ] {
            if ends {
                assert!(
                    (spline.values_at(0.0)[1] - 1.0).abs() < 1e-14
                        && (spline.values_at(2.0)[1] - libm::cos(2.0)).abs() < 1e-14
                );
            }
            let (controls, full) = (spline.controls(), bspline_knots(&spline.knots));
            assert_eq!(controls.len() + 4, full.len());
            let last = spline.knots[spline.knots.len() - 1];
            for i in 0..=40 {
                let x = last * f64::from(i) / 40.0;
                let (first, basis, slopes) = bspline_basis(&full, x);
                let sum =
                    |weights: [f64; 4]| -> f64 { weights.iter().zip(&controls[first..]).map(|(w, c)| w * c).sum() };
                assert!((sum(basis) - spline.values_at(x)[0]).abs() < 1e-14, "{x}");
                let slope = if i == 40 { spline.values_at(x - 1e-12)[1] } else { spline.values_at(x)[1] };
                assert!((sum(slopes) - slope).abs() < 1e-11, "{x}: {} {slope}", sum(slopes));
            }
        }
    }

    #[test]
    fn a_periodic_spline_is_smooth_where_it_closes_and_its_error_falls_with_the_fourth_power() {
        let of = |n: u32| {
            // Uneven knots over one turn.
            let knot = |i: u32| {
                let x = std::f64::consts::TAU * f64::from(i) / f64::from(n);
                x + 0.3 * (libm::cos(x) - 1.0)
            };
            let knots: Vec<f64> = (0..=n).map(knot).collect();
            let values: Vec<f64> = knots.iter().map(|x| libm::sin(*x) + 0.2 * libm::cos(2.0 * x)).collect();
            (Spline::periodic(&knots, &values), knots)
        };
        for n in [3, 4, 20] {
            let (spline, knots) = of(n);
            let last = knots[knots.len() - 1];
            let (start, end) = (spline.values_at(knots[0]), spline.values_at(last - 1e-12));
            for order in 0..3 {
                assert!((start[order] - end[order]).abs() < 1e-10, "{n} order {order}: {start:?} {end:?}");
            }
            for knot in &knots[1..knots.len() - 1] {
                let (left, right) = (spline.values_at(knot - 1e-12), spline.values_at(*knot));
                for order in 0..3 {
                    assert!((left[order] - right[order]).abs() < 1e-10, "{n} order {order} at {knot}");
                }
            }
        }
        let error = |n: u32| {
            let (spline, knots) = of(n);
            let place = |i: u32| knots[0] + std::f64::consts::TAU * f64::from(i) / 999.0;
            let off = |x: f64| (spline.values_at(x)[0] - libm::sin(x) - 0.2 * libm::cos(2.0 * x)).abs();
            (0..1000).map(place).map(off).fold(0.0, f64::max)
        };
        let ratio = error(40) / error(80);
        assert!((13.0..19.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn joints_are_smooth_and_the_error_falls_with_the_fourth_power() {
        let spline = |n: u32| {
            let knots: Vec<f64> = (0..=n).map(|i| 2.0 * f64::from(i) / f64::from(n)).collect();
            let values: Vec<f64> = knots.iter().map(|x| libm::sin(3.0 * x)).collect();
            (Spline::not_a_knot(&knots, &values), knots)
        };
        let error = |n: u32| {
            let (spline, _) = spline(n);
            (0..=999)
                .map(|i| 0.002 * f64::from(i))
                .map(|x| (spline.values_at(x)[0] - libm::sin(3.0 * x)).abs())
                .fold(0.0, f64::max)
        };
        let ratio = error(20) / error(40);
        assert!((12.0..24.0).contains(&ratio), "{ratio}");
        let (spline, knots) = spline(12);
        for knot in &knots[1..12] {
            let (left, right) = (spline.values_at(knot - 1e-12), spline.values_at(*knot));
            for order in 0..3 {
                assert!((left[order] - right[order]).abs() < 1e-9, "order {order} at {knot}");
            }
        }
    }
}
