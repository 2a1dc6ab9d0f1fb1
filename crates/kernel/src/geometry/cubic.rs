//! A cubic Bézier curve, millimetres: everything about it is computed from its polynomials, without sampling.

use super::segment::{Extents, NearestOnSegment};
use crate::numeric::scatter::range;
use crate::numeric::{bernstein, quadrature};
use nalgebra::Vector2;

/// Legs that turn by less than this from one to the next, as the cosine of all, count as one smooth part: about 0.5 rad.
const TAME: f64 = 0.88;
/// Largest ratio of their lengths.
const EVEN: f64 = 1.6;
/// Most halvings to get there: at a cusp there is no end.
const HALVINGS: u32 = 24;
/// Panels of eight points for the length of a tame piece, accurate to 1e-13 of it.
const PANELS: u32 = 2;

/// A cubic curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// Start, the two inner control points, end; mm.
    pub points: [Vector2<f64>; 4],
}

/// The point at a share of the way between two.
#[inline]
fn between(a: Vector2<f64>, b: Vector2<f64>, t: f64) -> Vector2<f64> {
    a + (b - a) * t
}

impl Cubic {
    /// Point, first and second derivative by the parameter, 0 at the start and 1 at the end.
    #[must_use]
    pub fn derivatives(&self, t: f64) -> [Vector2<f64>; 3] {
        let [p, q, r, s] = self.points;
        let u = 1.0 - t;
        let (a, b, c) = (p * u + q * t, q * u + r * t, r * u + s * t);
        let (d, e) = (a * u + b * t, b * u + c * t);
        let second = (p - q * 2.0 + r) * u + (q - r * 2.0 + s) * t;
        [d * u + e * t, (e - d) * 3.0, second * 6.0]
    }

    /// The sides of its control polygon.
    #[must_use]
    pub fn legs(&self) -> [Vector2<f64>; 3] {
        let [p, q, r, s] = self.points;
        [q - p, r - q, s - r]
    }

    /// Point and unit tangent at a parameter.
    #[must_use]
    pub fn point_and_tangent(&self, t: f64) -> (Vector2<f64>, Vector2<f64>) {
        let [point, first, _] = self.derivatives(t);
        // Where an inner control point lies on an end the tangent is that of the next leg.
        let tangent = if first.norm_squared() > 0.0 {
            first.normalize()
        } else if t < 0.5 {
            self.start_tangent()
        } else {
            self.end_tangent()
        };
        (point, tangent)
    }

    /// Curvature at a parameter, 1/mm, positive where it turns left.
    #[must_use]
    pub fn curvature(&self, t: f64) -> f64 {
        let [_, first, second] = self.derivatives(t);
        let speed = first.norm();
        first.perp(&second) / (speed * speed * speed)
    }

    /// Unit tangent at the start.
    #[must_use]
    pub fn start_tangent(&self) -> Vector2<f64> {
        let [p, q, r, s] = self.points;
        let leg = [q - p, r - p, s - p].into_iter().find(|leg| leg.norm_squared() > 0.0);
        leg.unwrap_or_else(Vector2::zeros).normalize()
    }

    /// Unit tangent at the end.
    #[must_use]
    pub fn end_tangent(&self) -> Vector2<f64> {
        -self.reversed().start_tangent()
    }

    /// Both parts, up to a parameter and from there on.
    #[must_use]
    pub fn split(&self, t: f64) -> (Self, Self) {
        let [p, q, r, s] = self.points;
        let (a, b, c) = (between(p, q, t), between(q, r, t), between(r, s, t));
        let (d, e) = (between(a, b, t), between(b, c, t));
        let middle = between(d, e, t);
        (Self { points: [p, a, d, middle] }, Self { points: [middle, e, c, s] })
    }

    /// The part from one parameter to another, reversed where the second is the lower: its control points are blossoms
    /// (L. Ramshaw, 1987).
    #[must_use]
    pub fn part(&self, from: f64, to: f64) -> Self {
        let [p, q, r, s] = self.points;
        let points = [[from; 3], [from, from, to], [from, to, to], [to; 3]].map(|[x, y, z]| {
            let (a, b, c) = (between(p, q, x), between(q, r, x), between(r, s, x));
            between(between(a, b, y), between(b, c, y), z)
        });
        Self { points }
    }

    /// The curve in the opposite sense.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let [p, q, r, s] = self.points;
        Self { points: [s, r, q, p] }
    }

    /// Its points mapped.
    #[must_use]
    pub fn mapped(&self, map: impl FnMut(Vector2<f64>) -> Vector2<f64>) -> Self {
        Self { points: self.points.map(map) }
    }

    /// Whether it turns little and runs evenly, so that simple rules are accurate.
    fn tame(&self) -> bool {
        let legs = self.legs();
        let [a, b, c] = legs.map(|leg| leg.norm());
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        let [p, q, r] = legs;
        least > 0.0
            && most <= EVEN * least
            && p.dot(&q) > TAME * a * b
            && q.dot(&r) > TAME * b * c
            && p.dot(&r) > TAME * a * c
    }

    /// Its parts that turn little and run evenly, in order, each with the parameters at which it begins and ends. Near a cusp
    /// they are short.
    #[must_use]
    pub fn smooth_parts(&self) -> Vec<(Self, (f64, f64))> {
        let mut parts = Vec::new();
        let mut open = vec![(*self, (0.0, 1.0), HALVINGS)];
        while let Some((part, (from, to), left)) = open.pop() {
            if left == 0 || part.tame() {
                parts.push((part, (from, to)));
            } else {
                let (first, last) = part.split(0.5);
                let middle = 0.5 * (from + to);
                open.push((last, (middle, to), left - 1));
                open.push((first, (from, middle), left - 1));
            }
        }
        parts
    }

    /// Length up to a parameter of a curve that turns little, mm.
    #[must_use]
    pub fn length_to(&self, t: f64) -> f64 {
        quadrature::integrate(|t| self.derivatives(t)[1].norm(), (0.0, t), PANELS)
    }

    /// Length, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.smooth_parts().iter().map(|(part, _)| part.length_to(1.0)).sum()
    }

    /// By how much it turns left from its start to its end, rad.
    #[must_use]
    pub fn turning(&self) -> f64 {
        let parts = self.smooth_parts();
        let turns = parts.iter().map(|(part, _)| {
            let (a, b) = (part.start_tangent(), part.end_tangent());
            libm::atan2(a.perp(&b), a.dot(&b))
        });
        turns.sum()
    }

    /// Parameters at which it is perpendicular to a direction.
    fn square_to(&self, direction: Vector2<f64>) -> Vec<f64> {
        bernstein::roots(&self.legs().map(|leg| leg.dot(&direction)))
    }

    /// Exact extents.
    #[must_use]
    pub fn extents(&self) -> Extents {
        let [start, .., end] = self.points;
        let tops = self.square_to(Vector2::x()).into_iter().chain(self.square_to(Vector2::y()));
        let around = Extents { least: start.inf(&end), largest: start.sup(&end) };
        tops.map(|t| self.derivatives(t)[0])
            .fold(around, |extents, point| extents.with(&Extents { least: point, largest: point }))
    }

    /// How far it reaches in a direction (a unit vector) from the origin, mm.
    #[must_use]
    pub fn farthest(&self, direction: Vector2<f64>) -> f64 {
        let [start, .., end] = self.points;
        let ends = start.dot(&direction).max(end.dot(&direction));
        // No farther than its control points: roots are looked for only where one may lie beyond the ends.
        if self.points.iter().all(|point| point.dot(&direction) <= ends) {
            return ends;
        }
        self.square_to(direction).into_iter().map(|t| self.derivatives(t)[0].dot(&direction)).fold(ends, f64::max)
    }

    /// Parameters at which its distance from a point is least or largest: the roots of (B − p)·B', of degree 5.
    #[must_use]
    pub fn stationary(&self, point: Vector2<f64>) -> Vec<f64> {
        let [p, q, r, s] = self.points.map(|control| control - point);
        let [a, b, c] = self.legs();
        // The product of two polynomials in Bernstein form, degree 3 by degree 2.
        let coefficients = [
            p.dot(&a),
            (2.0 * p.dot(&b) + 3.0 * q.dot(&a)) / 5.0,
            (p.dot(&c) + 6.0 * q.dot(&b) + 3.0 * r.dot(&a)) / 10.0,
            (3.0 * q.dot(&c) + 6.0 * r.dot(&b) + s.dot(&a)) / 10.0,
            (3.0 * r.dot(&c) + 2.0 * s.dot(&b)) / 5.0,
            s.dot(&c),
        ];
        bernstein::roots(&coefficients)
    }

    /// The parameter of the place nearest to a point.
    #[must_use]
    pub fn nearest_parameter(&self, point: Vector2<f64>) -> f64 {
        let places = [0.0, 1.0].into_iter().chain(self.stationary(point));
        places
            .map(|t| ((self.derivatives(t)[0] - point).norm_squared(), t))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(0.0, |(_, t)| t)
    }

    /// The point nearest to a given one.
    #[must_use]
    pub fn nearest(&self, point: Vector2<f64>) -> NearestOnSegment {
        let t = self.nearest_parameter(point);
        let (mut foot, tangent) = self.point_and_tangent(t);
        let [start, .., end] = self.points;
        if t == 0.0 {
            foot = start;
        } else if t == 1.0 {
            foot = end;
        }
        let away = point - foot;
        NearestOnSegment { left: away.norm().copysign(tangent.perp(&away)), foot, tangent }
    }

    /// The largest distance from a point between two parameters, mm.
    #[must_use]
    pub fn farthest_from(&self, point: Vector2<f64>, from: f64, to: f64) -> f64 {
        let within = self.stationary(point).into_iter().filter(|t| (from..=to).contains(t));
        [from, to].into_iter().chain(within).map(|t| (self.derivatives(t)[0] - point).norm()).fold(0.0, f64::max)
    }

    /// Area between the curve and the origin, mm², and its first moments ∫x dA, ∫y dA, mm³, signed.
    ///
    /// By Green ½∫(x dy − y dx) and ⅓∫(x, y)(x dy − y dx): polynomials of degree 5 and 8, for which eight points are exact.
    #[must_use]
    pub fn area_and_moments(&self) -> (f64, Vector2<f64>) {
        let functions: [fn(Vector2<f64>) -> f64; 3] = [|_| 1.0, |point| point.x, |point| point.y];
        let [area, x, y] = functions.map(|function| {
            quadrature::integrate(
                |t| {
                    let [point, first, _] = self.derivatives(t);
                    function(point) * point.perp(&first)
                },
                (0.0, 1.0),
                1,
            )
        });
        (0.5 * area, Vector2::new(x, y) / 3.0)
    }

    /// The interval of its curvature between two parameters, 1/mm; infinite where its speed may be 0.
    ///
    /// κ = B'×B''/|B'|³: numerator and |B'|² lie between their Bernstein coefficients.
    #[must_use]
    pub fn curvature_between(&self, from: f64, to: f64) -> (f64, f64) {
        let [a, b, c] = self.legs();
        // B'/3 and B''/6 on the range, by their blossoms: without differences of near points.
        let [p, q, r] =
            [(from, from), (from, to), (to, to)].map(|(s, t)| between(between(a, b, s), between(b, c, s), t));
        let [e, f] = [from, to].map(|t| between(b - a, c - b, t));
        let turns =
            [p.perp(&e), (p.perp(&f) + 2.0 * q.perp(&e)) / 3.0, (2.0 * q.perp(&f) + r.perp(&e)) / 3.0, r.perp(&f)];
        let squares =
            [p.norm_squared(), p.dot(&q), (2.0 * q.norm_squared() + p.dot(&r)) / 3.0, q.dot(&r), r.norm_squared()];
        let ((low, high), (slowest, fastest)) = (range(&turns), range(&squares));
        if !(slowest > 0.0 && low.is_finite() && high.is_finite()) {
            return (f64::NEG_INFINITY, f64::INFINITY);
        }
        let all = [(low, slowest), (low, fastest), (high, slowest), (high, fastest)]
            .map(|(turn, square)| 2.0 / 3.0 * turn / (square * square.sqrt()));
        range(&all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curves() -> Vec<Cubic> {
        let at = |x: f64, y: f64| Vector2::new(x, y);
        vec![
            Cubic { points: [at(0.0, 0.0), at(1.0, 2.0), at(3.0, 2.5), at(4.0, 0.5)] },
            // An S, a loop, and one that starts on its inner control point.
            Cubic { points: [at(1.0, 1.0), at(4.0, 5.0), at(2.0, -3.0), at(6.0, 1.0)] },
            Cubic { points: [at(0.0, 0.0), at(6.0, 4.0), at(-2.0, 4.0), at(4.0, 0.0)] },
            Cubic { points: [at(0.0, 0.0), at(0.0, 0.0), at(2.0, 1.0), at(3.0, 0.0)] },
        ]
    }

    fn scan(curve: &Cubic, of: impl Fn(Vector2<f64>) -> f64) -> f64 {
        (0..=20_000).map(|i| of(curve.derivatives(f64::from(i) / 2e4)[0])).fold(f64::NEG_INFINITY, f64::max)
    }

    #[test]
    fn distances_and_extents_are_those_of_many_points() {
        for curve in curves() {
            for (x, y) in [(2.0, 1.0), (-1.0, 0.0), (3.0, 3.0), (9.0, -4.0), (2.0, 0.1), (1.9, 2.2)] {
                let point = Vector2::new(x, y);
                let least = -scan(&curve, |p| -(p - point).norm());
                let nearest = curve.nearest(point);
                assert!((nearest.left.abs() - least).abs() < 1e-6, "{curve:?} {point}: {nearest:?} {least}");
                assert!(nearest.left.abs() <= least + 1e-14);
                let most = scan(&curve, |p| (p - point).norm());
                assert!((curve.farthest_from(point, 0.0, 1.0) - most).abs() < 1e-6);
                let direction = point.normalize();
                assert!((curve.farthest(direction) - scan(&curve, |p| p.dot(&direction))).abs() < 1e-6);
            }
            let extents = curve.extents();
            for (found, many) in [
                (extents.largest.x, scan(&curve, |p| p.x)),
                (extents.largest.y, scan(&curve, |p| p.y)),
                (-extents.least.x, scan(&curve, |p| -p.x)),
                (-extents.least.y, scan(&curve, |p| -p.y)),
            ] {
                assert!((found - many).abs() < 1e-6, "{curve:?}: {found} {many}");
            }
        }
    }

    /// Each of its own points is at distance 0, also near a cusp, where two roots coincide.
    #[test]
    fn a_place_on_the_curve_is_found() {
        let at = |x: f64, y: f64| Vector2::new(x, y);
        let cusp = Cubic { points: [at(60.0, 0.0), at(80.0, 20.0), at(60.0, 20.0), at(80.0, 0.0)] };
        for curve in curves().into_iter().chain([cusp]) {
            for i in 0..=500 {
                let point = curve.derivatives(f64::from(i) / 500.0)[0];
                assert!(curve.nearest(point).left.abs() < 1e-9, "{curve:?} {i}");
            }
        }
    }

    #[test]
    fn measures_are_those_of_many_chords() {
        for curve in curves() {
            let points: Vec<Vector2<f64>> = (0..=40_000).map(|i| curve.derivatives(f64::from(i) / 4e4)[0]).collect();
            let (mut length, mut area, mut moment, mut turning) = (0.0, 0.0, Vector2::zeros(), 0.0);
            for pair in points.windows(2) {
                length += (pair[1] - pair[0]).norm();
                let triangle = 0.5 * pair[0].perp(&pair[1]);
                area += triangle;
                moment += (pair[0] + pair[1]) * (triangle / 3.0);
            }
            for three in points.windows(3) {
                let (a, b) = (three[1] - three[0], three[2] - three[1]);
                turning += libm::atan2(a.perp(&b), a.dot(&b));
            }
            let (found, moments) = curve.area_and_moments();
            assert!((curve.length() - length).abs() < 1e-7, "{curve:?}: {} {length}", curve.length());
            assert!((found - area).abs() < 1e-7 && (moments - moment).norm() < 1e-6, "{curve:?}: {found} {area}");
            assert!((curve.turning() - turning).abs() < 1e-3, "{curve:?}: {} {turning}", curve.turning());
            let back = curve.reversed();
            assert!(
                (back.area_and_moments().0 + found).abs() < 1e-13 && (back.length() - curve.length()).abs() < 1e-12
            );
            let (first, last) = curve.split(0.3);
            assert!((first.length() + last.length() - curve.length()).abs() < 1e-10);
        }
    }

    #[test]
    fn curvature_lies_in_its_interval_and_that_is_narrow() {
        let curve = curves()[0];
        for i in 0..64 {
            let (from, to) = (f64::from(i) / 64.0, f64::from(i + 1) / 64.0);
            let (low, high) = curve.curvature_between(from, to);
            for j in 0..=16 {
                let k = curve.curvature(from + (to - from) * f64::from(j) / 16.0);
                assert!(low - 1e-12 <= k && k <= high + 1e-12, "{from}: {low} {k} {high}");
            }
            assert!(high - low < 0.12, "{from}: {low} {high}");
        }
    }
}
