//! A plane cubic B-spline: points and derivatives, and its pieces as Bézier curves.

use nalgebra::Vector2;

/// Newton steps to the place that a point projects to, and how near to it counts as there, over the size of the curve.
const STEPS: u32 = 12;
const THERE: f64 = 1e-15;

/// Control points that affect one span.
pub(super) const ORDER: usize = 4;

/// A polynomial B-spline of degree 3, twice continuously differentiable, clamped at both ends.
#[derive(Debug, Clone, PartialEq)]
pub struct CubicBSpline {
    /// The knots, the first and the last four times each; the same unit as the curve.
    pub knots: Vec<f64>,
    /// The control points.
    pub controls: Vec<Vector2<f64>>,
}

/// Point and the first three derivatives by the parameter.
pub(super) type SplineDerivatives = [Vector2<f64>; 4];

/// One span as a polynomial in the distance from its first knot.
#[derive(Debug, Clone, Copy)]
pub(super) struct SplineSpan {
    /// Its first and last knot.
    pub(super) from: f64,
    pub(super) to: f64,
    coefficients: SplineDerivatives,
}

impl SplineSpan {
    pub(super) fn derivatives_at(&self, parameter: f64) -> SplineDerivatives {
        let x = parameter - self.from;
        let [a, b, c, d] = self.coefficients;
        [a + (b + (c + d * x) * x) * x, b + (c * 2.0 + d * (3.0 * x)) * x, c * 2.0 + d * (6.0 * x), d * 6.0]
    }
}

impl CubicBSpline {
    /// How many polynomials it consists of.
    #[must_use]
    pub fn spans(&self) -> usize {
        self.controls.len().saturating_sub(ORDER - 1)
    }

    /// Its polynomials as cubic Bézier curves: start, the two inner control points, end.
    #[must_use]
    pub fn pieces(&self) -> Vec<[Vector2<f64>; 4]> {
        let pieces = self.polynomials().into_iter().map(|span| {
            let third = (span.to - span.from) / 3.0;
            let ([start, leaves, ..], [end, arrives, ..]) =
                (span.derivatives_at(span.from), span.derivatives_at(span.to));
            [start, start + leaves * third, end - arrives * third, end]
        });
        let mut pieces: Vec<[Vector2<f64>; 4]> = pieces.collect();
        // Adjacent ones share a point, and at the ends it is the control point itself.
        if let (Some(first), Some(start)) = (pieces.first_mut(), self.controls.first()) {
            first[0] = *start;
        }
        if let (Some(last), Some(end)) = (pieces.last_mut(), self.controls.last()) {
            last[3] = *end;
        }
        let starts: Vec<Vector2<f64>> = pieces.iter().skip(1).map(|piece| piece[0]).collect();
        for (piece, next) in pieces.iter_mut().zip(starts) {
            piece[3] = next;
        }
        pieces
    }

    /// The spline in the opposite sense.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let (first, last) = (self.knots.first().copied().unwrap_or(0.0), self.knots.last().copied().unwrap_or(0.0));
        Self {
            knots: self.knots.iter().rev().map(|knot| first + (last - knot)).collect(),
            controls: self.controls.iter().rev().copied().collect(),
        }
    }

    /// Its spans as polynomials, in order.
    pub(super) fn polynomials(&self) -> Vec<SplineSpan> {
        (0..self.spans()).filter_map(|span| self.polynomial(span)).collect()
    }

    fn polynomial(&self, span: usize) -> Option<SplineSpan> {
        let from = *self.knots.get(span + ORDER - 1)?;
        let to = *self.knots.get(span + ORDER)?;
        let basis = SpanBasis::new(&self.knots, span, from);
        let mut coefficients = [Vector2::zeros(); 4];
        for (index, control) in self.controls.iter().skip(span).take(ORDER).enumerate() {
            for (sum, row) in coefficients.iter_mut().zip(&basis.derivatives) {
                *sum += control * row.get(index).copied().unwrap_or(0.0);
            }
        }
        let [a, b, c, d] = coefficients;
        Some(SplineSpan { from, to, coefficients: [a, b, c / 2.0, d / 6.0] })
    }
}

/// The four functions that are not 0 on a span, at a place, with their first three derivatives.
pub(super) struct SpanBasis {
    /// By order of the derivative, then by control point.
    pub(super) derivatives: [[f64; ORDER]; ORDER],
}

impl SpanBasis {
    /// Cox and de Boor's recursion, and the differences of the lower degrees (Piegl, Tiller, The NURBS Book, (2.5), (2.7)).
    pub(super) fn new(knots: &[f64], span: usize, x: f64) -> Self {
        // Knots t₋₂ … t₃ about the span [t₀, t₁].
        let [a, b, c, d, e, f] =
            [0, 1, 2, 3, 4, 5].map(|offset| knots.get(span + 1 + offset).copied().unwrap_or(f64::NAN));
        let share = |low: f64, high: f64| (x - low) / (high - low);
        // Degree 1, 2 and 3: each function rises over its first part and falls over its last.
        let one = [1.0 - share(c, d), share(c, d)];
        let (p, q) = (share(b, d), share(c, e));
        let two = [one[0] * (1.0 - p), one[0] * p + one[1] * (1.0 - q), one[1] * q];
        let (r, s, u) = (share(a, d), share(b, e), share(c, f));
        let three = [two[0] * (1.0 - r), two[0] * r + two[1] * (1.0 - s), two[1] * s + two[2] * (1.0 - u), two[2] * u];
        // Slope of a function of degree 3: 3 (N₂ before over its support − N₂ after over its own), and so on down.
        let differ = |lower: [f64; 3], widths: [f64; 3], degree: f64| {
            let [x, y, z] = [0, 1, 2].map(|i: usize| degree * lower[i] / widths[i]);
            [-x, x - y, y - z, z]
        };
        let wide = [d - a, e - b, f - c];
        let middle = |lower: [f64; 2]| {
            let (x, y) = (2.0 * lower[0] / (d - b), 2.0 * lower[1] / (e - c));
            [-x, x - y, y]
        };
        let constant = 1.0 / (d - c);
        Self {
            derivatives: [
                three,
                differ(two, wide, 3.0),
                differ(middle(one), wide, 3.0),
                differ(middle([-constant, constant]), wide, 3.0),
            ],
        }
    }
}

/// The parameter at which the spline crosses the normal line at a point, near a first guess.
pub(super) fn hit(polynomials: &[SplineSpan], point: Vector2<f64>, tangent: Vector2<f64>, guess: f64) -> Option<f64> {
    let (first, last) = (polynomials.first()?.from, polynomials.last()?.to);
    let mut parameter = guess.clamp(first, last);
    for _ in 0..STEPS {
        let index = polynomials.partition_point(|span| span.to < parameter).min(polynomials.len() - 1);
        let [place, slope, ..] = polynomials.get(index)?.derivatives_at(parameter);
        let (ahead, speed) = ((place - point).dot(&tangent), slope.dot(&tangent));
        if !(speed > 0.0) {
            return None;
        }
        if ahead.abs() <= THERE * (1.0 + point.norm()) {
            break;
        }
        let next = (parameter - ahead / speed).clamp(first, last);
        if next == parameter {
            break;
        }
        parameter = next;
    }
    Some(parameter)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic has its own Bernstein polynomials; a spline on uneven knots is smooth to the second derivative.
    #[test]
    fn spans_meet_with_two_derivatives_and_pieces_are_the_same_curve() {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.5, 4.0, 5.0, 5.0, 5.0, 5.0];
        let at = |x: f64, y: f64| Vector2::new(x, y);
        let controls =
            vec![at(0.0, 0.0), at(1.0, 2.0), at(2.0, -1.0), at(4.0, 3.0), at(5.0, 1.0), at(7.0, 0.0), at(8.0, 2.0)];
        let spline = CubicBSpline { knots, controls };
        assert_eq!(spline.spans(), 4);
        let spans = spline.polynomials();
        for pair in spans.windows(2) {
            let (a, b) = (pair[0].derivatives_at(pair[0].to), pair[1].derivatives_at(pair[1].from));
            for order in 0..3 {
                assert!((a[order] - b[order]).norm() < 1e-13, "{order}: {} {}", a[order], b[order]);
            }
        }
        assert!((spans[0].derivatives_at(0.0)[0] - at(0.0, 0.0)).norm() < 1e-15);
        assert!((spans[3].derivatives_at(5.0)[0] - at(8.0, 2.0)).norm() < 1e-14);
        assert!((spans[0].derivatives_at(0.0)[1] - at(3.0, 6.0)).norm() < 1e-14);
        for (piece, span) in spline.pieces().iter().zip(&spans) {
            for i in 0..=8 {
                let t = f64::from(i) / 8.0;
                let s = 1.0 - t;
                let point = piece[0] * (s * s * s)
                    + piece[1] * (3.0 * s * s * t)
                    + piece[2] * (3.0 * s * t * t)
                    + piece[3] * (t * t * t);
                assert!((point - span.derivatives_at(span.from + t * (span.to - span.from))[0]).norm() < 1e-13);
            }
        }
        let back = spline.reversed();
        assert!((back.polynomials()[1].derivatives_at(2.0)[0] - spans[2].derivatives_at(3.0)[0]).norm() < 1e-13);
        // The functions add up to 1, their derivatives to 0.
        for x in [1.0, 1.2, 1.5] {
            let basis = SpanBasis::new(&spline.knots, 1, x);
            for (order, row) in basis.derivatives.iter().enumerate() {
                let expected = if order == 0 { 1.0 } else { 0.0 };
                assert!((row.iter().sum::<f64>() - expected).abs() < 1e-13);
            }
        }
    }
}
