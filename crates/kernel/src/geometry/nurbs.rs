//! B-spline curves and surfaces of any degree, rational or not, as other programs write them (L. Piegl, W. Tiller, The NURBS
//! Book, 1997, A2.1–A2.3, A4.1).

use nalgebra::{Vector3, Vector4};

/// Highest degree that is evaluated: programs write up to about 9.
pub const HIGHEST_DEGREE: usize = 25;

/// A knot vector with its degree.
#[derive(Debug, Clone, PartialEq)]
pub struct Knots {
    /// Degree of the pieces.
    pub degree: usize,
    /// The knots, each repeated by its multiplicity.
    pub values: Vec<f64>,
}

impl Knots {
    /// Whether they fit this many control points without a gap: enough knots, finite, never falling, with at least one span, and
    /// no multiplicity at which the curve would jump.
    #[must_use]
    pub fn fit_controls(&self, controls: usize) -> bool {
        let rising =
            self.values.windows(2).all(|pair| matches!(pair, [a, b] if a <= b && b.is_finite() && a.is_finite()));
        let (first, last) = self.range();
        let fits = (1..=HIGHEST_DEGREE).contains(&self.degree)
            && controls > self.degree
            && self.values.len() == controls + self.degree + 1
            && rising
            && first < last;
        fits && !self
            .values
            .windows(self.degree + 1)
            .any(|repeated| matches!(repeated, [a, .., b] if a == b && first < *a && *a < last))
    }

    /// First and last value of the parameter.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        (self.knot(self.degree), self.knot(self.values.len().saturating_sub(self.degree + 1)))
    }

    fn knot(&self, index: usize) -> f64 {
        self.values.get(index).copied().unwrap_or(f64::NAN)
    }

    /// The spans, on each of which it is one polynomial.
    #[must_use]
    pub fn spans(&self) -> Vec<(f64, f64)> {
        let (first, last) = self.range();
        let pairs = self.values.iter().zip(self.values.iter().skip(1));
        pairs.filter(|(a, b)| a < b && **a >= first && **b <= last).map(|(a, b)| (*a, *b)).collect()
    }

    /// The functions that do not vanish at `x`, their slopes, and the index of the first.
    fn basis(&self, x: f64) -> (usize, [f64; HIGHEST_DEGREE + 1], [f64; HIGHEST_DEGREE + 1]) {
        let last = self.values.len().saturating_sub(self.degree + 2).max(self.degree);
        let mut span = self.values.partition_point(|knot| *knot <= x).saturating_sub(1).clamp(self.degree, last);
        // The end of the range belongs to the last span with a width above 0.
        while span > self.degree && self.knot(span) == self.knot(span + 1) {
            span -= 1;
        }
        let (mut basis, mut slopes) = ([0.0; HIGHEST_DEGREE + 1], [0.0; HIGHEST_DEGREE + 1]);
        basis[0] = 1.0;
        for degree in 1..=self.degree.min(HIGHEST_DEGREE) {
            let (mut saved, mut lower) = (0.0, 0.0);
            #[expect(clippy::cast_precision_loss, reason = "at most 25")]
            let factor = degree as f64;
            for r in 0..degree {
                let (right, left) = (self.knot(span + r + 1) - x, x - self.knot(span + 1 + r - degree));
                let value = basis.get(r).copied().unwrap_or(0.0) / (right + left);
                if let (Some(function), Some(slope)) = (basis.get_mut(r), slopes.get_mut(r)) {
                    *slope = factor * (lower - value);
                    *function = saved + right * value;
                }
                lower = value;
                saved = left * value;
            }
            if let (Some(function), Some(slope)) = (basis.get_mut(degree), slopes.get_mut(degree)) {
                *slope = factor * lower;
                *function = saved;
            }
        }
        (span - self.degree, basis, slopes)
    }
}

/// Control points times their weights, and the weights.
type HomogeneousPoint = Vector4<f64>;

/// A point with a weight.
#[must_use]
pub fn weighted(point: Vector3<f64>, weight: f64) -> Vector4<f64> {
    Vector4::new(point.x * weight, point.y * weight, point.z * weight, weight)
}

/// Point and derivative from homogeneous ones.
fn projected(sum: HomogeneousPoint, slope: HomogeneousPoint) -> (Vector3<f64>, Vector3<f64>) {
    let point = sum.xyz() / sum.w;
    (point, (slope.xyz() - point * slope.w) / sum.w)
}

/// A B-spline curve.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsCurve {
    /// Its knots.
    pub knots: Knots,
    /// Its weighted control points.
    pub controls: Vec<Vector4<f64>>,
}

impl NurbsCurve {
    /// Point and derivative.
    #[must_use]
    pub fn point_and_slope(&self, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (first, basis, slopes) = self.knots.basis(t);
        let mut sums = [HomogeneousPoint::zeros(); 2];
        for (control, (b, d)) in
            self.controls.iter().skip(first).zip(basis.iter().zip(slopes)).take(self.knots.degree + 1)
        {
            let [sum, slope] = &mut sums;
            *sum += control * *b;
            *slope += control * d;
        }
        projected(sums[0], sums[1])
    }

    /// Its polynomials in order as Bézier curves of degree 3: those of a higher degree in parts, no farther from them than `within`
    /// (the unit of the curve). `None` for a rational curve, and one that takes too many parts.
    #[must_use]
    pub fn cubics(&self, within: f64) -> Option<Vec<[Vector3<f64>; 4]>> {
        let (degree, knots) = (self.knots.degree, &self.knots.values);
        let weight = self.controls.first()?.w;
        if self.controls.iter().any(|control| control.w != weight) {
            return None;
        }
        let poles: Vec<[f64; 4]> = self.controls.iter().map(|control| (control / weight).into()).collect();
        let most = PARTS + PARTS_EACH * poles.len();
        let mut found = Vec::new();
        for span in degree..poles.len() {
            let (Some(&low), Some(&high)) = (knots.get(span), knots.get(span + 1)) else { continue };
            if high > low {
                let row = (0..=degree).map(|at_high| {
                    let [x, y, z, _] = blossom(degree, span, knots, &poles, low, high, at_high)?;
                    Some(Vector3::new(x, y, z))
                });
                let row: Option<Vec<_>> = row.collect();
                parted(row?, within, most, &mut found)?;
            }
        }
        Some(found)
    }

    /// The curve in the opposite sense.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let values = self.knots.values.iter().rev().map(|knot| -knot).collect();
        let controls = self.controls.iter().rev().copied().collect();
        Self { knots: Knots { degree: self.knots.degree, values }, controls }
    }

    /// The largest distance from another curve (mm), at equal shares of both ranges: where both have the same
    /// degree, knots and weights, at most that of their control points.
    #[must_use]
    pub fn farthest(&self, other: &Self) -> f64 {
        let (mine, others) = (self.knots.range(), other.knots.range());
        let pairs = self.knots.values.iter().zip(&other.knots.values);
        // Rounding of a knot moves a point by a comparable amount.
        let alike = self.knots.degree == other.knots.degree
            && self.knots.values.len() == other.knots.values.len()
            && pairs.clone().all(|(a, b)| {
                let (a, b) = ((a - mine.0) / (mine.1 - mine.0), (b - others.0) / (others.1 - others.0));
                (a - b).abs() <= SAME_KNOT
            });
        let weights = self.controls.iter().chain(&other.controls).map(|control| control.w);
        let plain = weights.clone().all(|weight| weight == 1.0);
        if alike && plain {
            let apart = self.controls.iter().zip(&other.controls).map(|(a, b)| (a - b).norm());
            return apart.fold(0.0, f64::max);
        }
        let steps =
            SAMPLES * u32::try_from(self.controls.len().max(other.controls.len())).unwrap_or(u32::MAX).min(4096);
        let apart = (0..=steps).map(|i| {
            let share = f64::from(i) / f64::from(steps);
            let (here, there) = (mine.0 + (mine.1 - mine.0) * share, others.0 + (others.1 - others.0) * share);
            (self.point_and_slope(here).0 - other.point_and_slope(there).0).norm()
        });
        apart.fold(0.0, |most, next| if next <= most { most } else { next })
    }
}

/// Knots that differ by less, as shares of the range, count as equal.
const SAME_KNOT: f64 = 1e-9;
/// Samples for each control point where two curves are compared point by point.
const SAMPLES: u32 = 8;

/// Most parts of a curve of a degree above 3: for a curve, and for each of its control points.
const PARTS: usize = 256;
const PARTS_EACH: usize = 4;

/// Appends a Bézier curve of any degree as curves of degree 3, of which there may be only so many.
fn parted(points: Vec<Vector3<f64>>, within: f64, most: usize, found: &mut Vec<[Vector3<f64>; 4]>) -> Option<()> {
    let mut open = vec![points];
    while let Some(part) = open.pop() {
        let cubic = near(&part)?;
        let mut raised = cubic.to_vec();
        while raised.len() < part.len() {
            raised = elevated(&raised);
        }
        // Lower degrees are that cubic.
        let off = raised.iter().zip(&part).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        if part.len() <= 4 || off <= within {
            found.push(cubic);
        } else {
            (found.len() + open.len() < most).then_some(())?;
            let (first, last) = halves(part);
            open.extend([last, first]);
        }
    }
    Some(())
}

/// The cubic Bézier curve with the same ends and derivatives there as one of any degree: up to degree 3 the same curve.
fn near(points: &[Vector3<f64>]) -> Option<[Vector3<f64>; 4]> {
    let (a, b) = (points.first()?, points.last()?);
    let (p, q) = (points.get(1)?, points.iter().rev().nth(1)?);
    #[expect(clippy::cast_precision_loss, reason = "at most 25")]
    let third = (points.len() - 1) as f64 / 3.0;
    Some(if points.len() == 4 { [*a, *p, *q, *b] } else { [*a, a + (p - a) * third, b + (q - b) * third, *b] })
}

/// The Bézier curve by the control points of one degree more.
#[expect(clippy::cast_precision_loss, reason = "at most 25")]
fn elevated(points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let count = points.len() as f64;
    let inner = points.iter().zip(points.iter().skip(1)).enumerate();
    let inner = inner.map(|(i, (before, after))| after + (before - after) * ((i + 1) as f64 / count));
    points.first().copied().into_iter().chain(inner).chain(points.last().copied()).collect()
}

/// De Casteljau's halves.
fn halves(mut row: Vec<Vector3<f64>>) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
    let (mut first, mut last) = (Vec::with_capacity(row.len()), Vec::with_capacity(row.len()));
    while let (Some(start), Some(end)) = (row.first(), row.last()) {
        first.push(*start);
        last.push(*end);
        row = row.iter().zip(row.iter().skip(1)).map(|(a, b)| (a + b) * 0.5).collect();
    }
    last.reverse();
    (first, last)
}

/// The blossom of a span with its high knot a given number of times and its low one otherwise: a pole of its Bézier curve (L. Ramshaw, 1987),
/// by de Boor's algorithm, for poles in any coordinates; `None` where the poles and knots of the span are missing.
#[must_use]
pub fn blossom<const N: usize>(
    degree: usize,
    span: usize,
    knots: &[f64],
    poles: &[[f64; N]],
    low_knot: f64,
    high_knot: f64,
    at_high: usize,
) -> Option<[f64; N]> {
    let mut row = [[0.0; N]; HIGHEST_DEGREE + 1];
    for (place, pole) in row.iter_mut().zip(poles.get(span.checked_sub(degree)?..=span)?) {
        *place = *pole;
    }
    for level in 1..=degree {
        let t = if level <= at_high { high_knot } else { low_knot };
        for j in (level..=degree).rev() {
            let (low, high) = (*knots.get(span - degree + j)?, *knots.get(span + j - level + 1)?);
            let share = (t - low) / (high - low);
            let (before, here) = (*row.get(j - 1)?, *row.get(j)?);
            *row.get_mut(j)? = std::array::from_fn(|k| match (before.get(k), here.get(k)) {
                (Some(a), Some(b)) => a * (1.0 - share) + b * share,
                _ => 0.0,
            });
        }
    }
    row.get(degree).copied()
}

/// A B-spline surface.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsSurface {
    /// Knots of its first parameter.
    pub u: Knots,
    /// Knots of its second parameter.
    pub v: Knots,
    /// Weighted control points, a row for each of the first parameter.
    pub controls: Vec<Vec<Vector4<f64>>>,
}

impl NurbsSurface {
    /// Point and derivatives by both parameters.
    #[must_use]
    pub fn point_and_slopes(&self, u: f64, v: f64) -> [Vector3<f64>; 3] {
        let (first_u, basis_u, slopes_u) = self.u.basis(u);
        let (first_v, basis_v, slopes_v) = self.v.basis(v);
        let mut sums = [HomogeneousPoint::zeros(); 3];
        let rows = self.controls.iter().skip(first_u).zip(basis_u.iter().zip(slopes_u)).take(self.u.degree + 1);
        for (row, (bu, du)) in rows {
            let columns = row.iter().skip(first_v).zip(basis_v.iter().zip(slopes_v)).take(self.v.degree + 1);
            for (p, (bv, dv)) in columns {
                let [point, by_u, by_v] = &mut sums;
                *point += p * (bu * bv);
                *by_u += p * (du * bv);
                *by_v += p * (bu * dv);
            }
        }
        let (point, by_u) = projected(sums[0], sums[1]);
        [point, by_u, projected(sums[0], sums[2]).1]
    }

    /// Its four edges, each with the surface on its left as seen from its normal: along u at the first v, along v at the
    /// last u, against u at the last v, against v at the first u.
    #[must_use]
    pub fn boundary(&self) -> Option<[NurbsCurve; 4]> {
        if !clamped(&self.u) || !clamped(&self.v) {
            return None;
        }
        let column = |end: fn(&[Vector4<f64>]) -> Option<&Vector4<f64>>| NurbsCurve {
            knots: self.u.clone(),
            controls: self.controls.iter().filter_map(|row| end(row).copied()).collect(),
        };
        let row = |controls: Option<&Vec<Vector4<f64>>>| NurbsCurve {
            knots: self.v.clone(),
            controls: controls.cloned().unwrap_or_default(),
        };
        let (low, high) = (column(<[_]>::first), column(<[_]>::last));
        let (first, last) = (row(self.controls.first()), row(self.controls.last()));
        Some([low, last, high.reversed(), first.reversed()])
    }
}

/// Whether the ends are knots of full multiplicity, so that the outer control points are the edge.
fn clamped(knots: &Knots) -> bool {
    let (first, last) = knots.range();
    knots.values.first() == Some(&first) && knots.values.last() == Some(&last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solid::SplineSurface;
    use truck_modeling::Point3;

    /// The same curve for degree 1 to 3, above that within the given distance.
    #[test]
    fn a_curve_of_any_degree_is_cubics() {
        for degree in 1..=9_u32 {
            let count = degree as usize;
            let place = |i: u32| Vector3::new(f64::from(i), f64::from(i * i % 5), f64::from(i * i * i % 7));
            let controls = (0..=degree).map(|i| weighted(place(i), 2.0)).collect();
            let values = [vec![0.0; count + 1], vec![1.0; count + 1]].concat();
            let curve = NurbsCurve { knots: Knots { degree: count, values }, controls };
            assert!(curve.knots.fit_controls(count + 1));
            for within in [1e-2, 1e-4, 1e-6] {
                let cubics = curve.cubics(within).expect("polynomials");
                assert!(degree > 3 || cubics.len() == 1);
                let mut worst = 0.0_f64;
                for [a, b, c, d] in &cubics {
                    let middle = (a + d) * 0.125 + (b + c) * 0.375;
                    let away = |t: f64| (curve.point_and_slope(t).0 - middle).norm();
                    let nearest = (0..=4000).map(|i| f64::from(i) / 4e3).min_by(|a, b| away(*a).total_cmp(&away(*b)));
                    let mut t = nearest.expect("many");
                    for _ in 0..20 {
                        let (point, slope) = curve.point_and_slope(t);
                        t = (t - (point - middle).dot(&slope) / slope.norm_squared()).clamp(0.0, 1.0);
                    }
                    worst = worst.max(away(t));
                }
                assert!(worst <= within + 1e-13, "{degree} {within}: {worst}");
                assert!(degree <= 3 || within > 1e-3 || worst > 1e-3 * within, "{degree} {within}: {worst}");
            }
        }
    }

    /// Against the bicubic surface of our own solids, and against an exact quarter of a cylinder.
    #[test]
    fn surfaces_are_those_of_the_book() {
        let knots = |values: &[f64]| Knots { degree: 3, values: values.to_vec() };
        let (u, v) = ([0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 2.0, 2.0]);
        let place = |i: u32, j: u32| Vector3::new(f64::from(i), f64::from(j * j), f64::from(i * j) - f64::from(i * i));
        let rows: Vec<Vec<Vector3<f64>>> = (0..5).map(|i| (0..4).map(|j| place(i, j)).collect()).collect();
        let plain = |row: &Vec<Vector3<f64>>| row.iter().map(|p| Point3::new(p.x, p.y, p.z)).collect();
        let ours = SplineSurface { u: u.to_vec(), v: v.to_vec(), controls: rows.iter().map(plain).collect() };
        let controls = rows.iter().map(|row| row.iter().map(|p| weighted(*p, 1.0)).collect()).collect();
        let surface = NurbsSurface { u: knots(&u), v: knots(&v), controls };
        assert!(surface.u.fit_controls(5) && surface.v.fit_controls(4) && !surface.v.fit_controls(5));
        assert_eq!(surface.u.spans(), [(0.0, 0.4), (0.4, 1.0)]);
        for i in 0..=10 {
            for j in 0..=10 {
                let (a, b) = (f64::from(i) / 10.0, f64::from(j) / 5.0);
                for (found, expected) in surface.point_and_slopes(a, b).iter().zip(ours.point_and_slopes(a, b)) {
                    // The book's slope at the very end is taken from the left; ours as well.
                    assert!((found - expected).norm() < 1e-12, "{a} {b}: {found} {expected}");
                }
            }
        }
        let [low, last, high, first] = surface.boundary().expect("clamped");
        assert!((low.point_and_slope(0.3).0 - surface.point_and_slopes(0.3, 0.0)[0]).norm() < 1e-12);
        assert!((last.point_and_slope(0.3).0 - surface.point_and_slopes(1.0, 0.3)[0]).norm() < 1e-12);
        assert!((high.point_and_slope(-0.3).0 - surface.point_and_slopes(0.3, 2.0)[0]).norm() < 1e-12);
        assert!((first.point_and_slope(-0.3).0 - surface.point_and_slopes(0.0, 0.3)[0]).norm() < 1e-12);
        assert_eq!(low.farthest(&low), 0.0);
        assert!((low.farthest(&high.reversed()) - 0.0).abs() > 1.0);

        for (index, cubic) in low.cubics(0.0).expect("not rational").iter().enumerate() {
            let (from, to) = [(0.0, 0.4), (0.4, 1.0)][index];
            for i in 0..=10 {
                let t = f64::from(i) / 10.0;
                let u = 1.0 - t;
                let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
                let point = cubic.iter().zip(weights).map(|(p, w)| p * w).sum::<Vector3<f64>>();
                assert!((point - low.point_and_slope(from + (to - from) * t).0).norm() < 1e-13);
            }
        }
        // Three knots within are a corner, four a gap.
        assert!(knots(&[0.0, 0.0, 0.0, 0.0, 0.4, 0.4, 0.4, 1.0, 1.0, 1.0, 1.0]).fit_controls(7));
        assert!(!knots(&[0.0, 0.0, 0.0, 0.0, 0.4, 0.4, 0.4, 0.4, 1.0, 1.0, 1.0, 1.0]).fit_controls(8));

        let half = std::f64::consts::FRAC_1_SQRT_2;
        let quarter = NurbsCurve {
            knots: Knots { degree: 2, values: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0] },
            controls: [(1.0, 0.0, 1.0), (1.0, 1.0, half), (0.0, 1.0, 1.0)]
                .map(|(x, y, w)| weighted(Vector3::new(x, y, 0.0), w))
                .to_vec(),
        };
        for i in 0..=10 {
            let (point, slope) = quarter.point_and_slope(f64::from(i) / 10.0);
            assert!((point.norm() - 1.0).abs() < 1e-15 && point.dot(&slope).abs() < 1e-14, "{point} {slope}");
        }
        assert!(quarter.cubics(1.0).is_none(), "no polynomial");
    }

    #[test]
    fn knots_without_a_span_carry_nothing() {
        for degree in 1..=4 {
            let values = vec![1.0; 2 * (degree + 1)];
            assert!(!Knots { degree, values }.fit_controls(degree + 1), "{degree}");
        }
    }

    /// Two straight lines of different degrees, which have no control points to compare: the distance is that of their far ends.
    #[test]
    fn curves_of_two_degrees_are_as_far_apart_as_their_farthest_points() {
        let line = |degree: u32, end: Vector3<f64>| {
            let count = degree as usize;
            let values = [vec![0.0; count + 1], vec![1.0; count + 1]].concat();
            let place = |i: u32| weighted(end * (f64::from(i) / f64::from(degree)), 1.0);
            NurbsCurve { knots: Knots { degree: count, values }, controls: (0..=degree).map(place).collect() }
        };
        let (one, other) = (line(1, Vector3::new(9.0, 0.0, 0.0)), line(3, Vector3::new(9.0, 4.0, 3.0)));
        assert!((one.farthest(&other) - 5.0).abs() < 1e-12 && (other.farthest(&one) - 5.0).abs() < 1e-12);
        assert!((one.farthest(&other.reversed()) - 106.0_f64.sqrt()).abs() < 1e-12);
        assert!(one.farthest(&line(2, Vector3::new(9.0, 0.0, 0.0))) < 1e-12);
    }
}
