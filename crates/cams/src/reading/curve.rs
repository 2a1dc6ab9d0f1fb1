//! Rational Bézier curves as tangent arcs within a given distance, with a proven bound.
//!
//! A piece is replaced by two arcs that share its ends and its tangents there. Its distance from the circle of an arc is a
//! polynomial in the parameter (over the square of the weight), whose largest size is below that of its Bernstein coefficients;
//! where the bound is too large the piece is halved. The curve is not sampled, so that nothing can be missed between samples.

use super::limits::WorkCount;
use super::not_finite;
use super::record::{EntityFault, fault};
use camgen_kernel::geometry::contour::{Cubic, Edge, Segment};
use nalgebra::Vector2;

/// Highest degree that is read: no program writes a degree above 11.
pub(super) const HIGHEST_DEGREE: usize = 11;
/// Most halvings of a piece: beyond them it is shorter than rounding.
const HALVINGS: u32 = 48;
/// The arcs of a piece turn by less than this from its chord, as a cosine.
const LEAST_COSINE: f64 = 0.8;
/// Segments shorter than this are left out, mm: readers drop them.
const SHORTEST: f64 = 2e-6;
/// A bulge up to this becomes a line, where that deviates by no more than a share of the allowed distance.
const STRAIGHT: f64 = 1e-8;
const STRAIGHT_SHARE: f64 = 0.05;
/// The gap of two tangent circles near the point where they touch, over ½ δ² of the difference of their curvatures: within
/// a fifth of a radius.
const TANGENT_GAP: f64 = 1.1;

/// A rational Bézier curve: its poles in homogeneous coordinates (w x, w y, w), w > 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bezier {
    pub(super) poles: Vec<[f64; 3]>,
}

impl Bezier {
    /// Through poles of weight 1.
    pub(super) fn polynomial(poles: &[Vector2<f64>]) -> Self {
        Self { poles: poles.iter().map(|pole| [pole.x, pole.y, 1.0]).collect() }
    }

    /// The part of an ellipse centre + cos t · a + sin t · b from one t to another, rad, in several curves.
    pub(super) fn ellipse(
        centre: Vector2<f64>,
        (a, b): (Vector2<f64>, Vector2<f64>),
        (from, to): (f64, f64),
    ) -> Vec<Self> {
        let count = ((to - from).abs() / std::f64::consts::FRAC_PI_4).ceil().max(1.0);
        let half = 0.5 * (to - from) / count;
        let weight = libm::cos(half);
        let on = |t: f64| a * libm::cos(t) + b * libm::sin(t);
        let mut found = Vec::new();
        let mut step = 0.0;
        while step < count {
            let start = from + 2.0 * half * step;
            let end = if step + 1.0 < count { start + 2.0 * half } else { to };
            let pole = |p: Vector2<f64>, w: f64| [p.x, p.y, w];
            let (first, last) = (centre + on(start), centre + on(end));
            let corner = centre * weight + on(start + half);
            found.push(Self { poles: vec![pole(first, 1.0), pole(corner, weight), pole(last, 1.0)] });
            step += 1.0;
        }
        found
    }

    /// The curve with its points mapped.
    pub(super) fn mapped(&self, origin: Vector2<f64>, direction: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Self {
        let pole = |[x, y, w]: &[f64; 3]| {
            let p = origin * *w + direction(Vector2::new(*x, *y));
            [p.x, p.y, *w]
        };
        Self { poles: self.poles.iter().map(pole).collect() }
    }

    /// The curve as an edge, where it is a polynomial of degree 3 or less.
    pub(super) fn exact(&self) -> Option<Edge> {
        if !self.poles.iter().all(|[.., w]| *w == 1.0) {
            return None;
        }
        let points: Vec<Vector2<f64>> = self.points().collect();
        match points.as_slice() {
            [start, end] => Some(Edge::Segment(Segment { start: *start, end: *end, bulge: 0.0 })),
            // Raised to degree 3.
            [start, q, end] => {
                let (leaves, arrives) = (start + (q - start) * (2.0 / 3.0), end + (q - end) * (2.0 / 3.0));
                Some(Edge::Cubic(Cubic { points: [*start, leaves, arrives, *end] }))
            }
            [a, b, c, d] => Some(Edge::Cubic(Cubic { points: [*a, *b, *c, *d] })),
            _ => None,
        }
    }

    fn points(&self) -> impl DoubleEndedIterator<Item = Vector2<f64>> + '_ {
        self.poles.iter().map(|[x, y, w]| Vector2::new(*x, *y) / *w)
    }

    pub(super) fn start(&self) -> Vector2<f64> {
        self.points().next().unwrap_or_else(Vector2::zeros)
    }

    pub(super) fn end(&self) -> Vector2<f64> {
        self.points().next_back().unwrap_or_else(Vector2::zeros)
    }

    /// De Casteljau's halves.
    fn halves(&self) -> (Self, Self) {
        let mut row = self.poles.clone();
        let (mut first, mut last) = (Vec::with_capacity(row.len()), Vec::with_capacity(row.len()));
        while let (Some(start), Some(end)) = (row.first(), row.last()) {
            first.push(*start);
            last.push(*end);
            let middle = |[a, b, c]: [f64; 3], [d, e, f]: [f64; 3]| [0.5 * (a + d), 0.5 * (b + e), 0.5 * (c + f)];
            row = row.iter().zip(row.iter().skip(1)).map(|(a, b)| middle(*a, *b)).collect();
        }
        last.reverse();
        (Self { poles: first }, Self { poles: last })
    }

    /// Largest distance of its points from the circle through a point with a given unit tangent and curvature there.
    fn off_circle(&self, point: Vector2<f64>, tangent: Vector2<f64>, curvature: f64) -> f64 {
        // With d from the point, 2 n·d − κ d² is twice the distance where it is small, see `Segment::nearest`.
        let normal = Vector2::new(-tangent.y, tangent.x);
        let from: Vec<(Vector2<f64>, f64)> =
            self.poles.iter().map(|[x, y, w]| (Vector2::new(*x, *y) - point * *w, *w)).collect();
        let degree = from.len().saturating_sub(1);
        let (own, product) = (binomials(degree), binomials(2 * degree));
        let mut coefficients = vec![0.0; 2 * degree + 1];
        for (i, ((d, w), a)) in from.iter().zip(&own).enumerate() {
            for (((e, v), b), sum) in from.iter().zip(&own).zip(coefficients.iter_mut().skip(i)) {
                let both = normal.dot(d) * v + normal.dot(e) * w - curvature * d.dot(e);
                *sum += a * b * both;
            }
        }
        let largest = coefficients.iter().zip(&product).map(|(c, b)| (c / b).abs()).fold(0.0, f64::max);
        let lightest = from.iter().map(|(_, w)| *w).fold(f64::INFINITY, f64::min);
        let g = largest / (lightest * lightest);
        g / (1.0 + (1.0 - curvature.abs() * g).max(0.0).sqrt())
    }
}

/// The binomial coefficients of a degree.
fn binomials(degree: usize) -> Vec<f64> {
    let mut row = vec![1.0];
    for _ in 0..degree {
        let inner = row.iter().zip(row.iter().skip(1)).map(|(a, b)| a + b);
        row = std::iter::once(1.0).chain(inner).chain([1.0]).collect();
    }
    row
}

/// Edges in a row, each starting where the one before ends.
#[derive(Debug, Default)]
pub(super) struct EdgeRun {
    pub(super) edges: Vec<Edge>,
}

impl EdgeRun {
    fn add(&mut self, from: Vector2<f64>, to: Vector2<f64>, bulge: f64) {
        let start = self.edges.last().map_or(from, Edge::end);
        if (to - start).norm() > SHORTEST {
            self.edges.push(Edge::Segment(Segment { start, end: to, bulge }));
        }
    }

    /// Curves, each starting where the one before ends: polynomials up to degree 3 as they are, others within a distance (mm).
    ///
    /// # Errors
    /// [`EntityFault`] where they cannot be followed, or only with more work than is allowed.
    pub(super) fn follow(&mut self, curves: &[Bezier], within: f64, effort: &mut WorkCount) -> Result<(), EntityFault> {
        for curve in curves {
            if let Some(edge) = curve.exact() {
                if !edge.is_finite() {
                    return Err(EntityFault::File(not_finite()));
                }
                effort.check_room(self.edges.len())?;
                if curve.points().any(|point| (point - edge.start()).norm() > SHORTEST) {
                    self.edges.push(edge);
                }
                continue;
            }
            let mut open = vec![(curve.clone(), HALVINGS)];
            while let Some((piece, left)) = open.pop() {
                if !piece.poles.iter().flatten().all(|number| number.is_finite()) {
                    return Err(EntityFault::File(not_finite()));
                }
                effort.check_room(self.edges.len())?;
                effort.piece(piece.poles.len())?;
                if !self.followed(&piece, within) {
                    if left == 0 {
                        return fault("is a curve that cannot be followed");
                    }
                    let (first, last) = piece.halves();
                    open.push((last, left - 1));
                    open.push((first, left - 1));
                }
            }
        }
        if let (Some(Edge::Segment(last)), Some(curve)) = (self.edges.last_mut(), curves.last()) {
            last.end = curve.end();
        }
        Ok(())
    }

    /// Adds a piece if two arcs, or a line, are close enough to it.
    fn followed(&mut self, piece: &Bezier, within: f64) -> bool {
        let (start, end) = (piece.start(), piece.end());
        let size = piece.points().map(|point| (point - start).norm()).fold(0.0, f64::max);
        if size <= 0.5 * within {
            self.add(start, end, 0.0);
            return true;
        }
        let Some(pair) = Biarc::of(piece) else { return false };
        if !(pair.off(piece) <= within) {
            return false;
        }
        let straight = |bulge: f64| bulge.abs() <= STRAIGHT;
        if straight(pair.first_bulge) && straight(pair.second_bulge) && STRAIGHT * size <= STRAIGHT_SHARE * within {
            self.add(start, end, 0.0);
        } else {
            self.add(start, pair.joint, pair.first_bulge);
            self.add(pair.joint, end, pair.second_bulge);
        }
        true
    }
}

/// Two arcs with a common tangent that share the ends of a curve and its tangents there.
struct Biarc {
    start: Vector2<f64>,
    start_tangent: Vector2<f64>,
    joint: Vector2<f64>,
    joint_tangent: Vector2<f64>,
    end: Vector2<f64>,
    end_tangent: Vector2<f64>,
    first_bulge: f64,
    second_bulge: f64,
}

impl Biarc {
    /// `None` where the curve turns back, or turns too far.
    fn of(piece: &Bezier) -> Option<Self> {
        let (start, end) = (piece.start(), piece.end());
        let chord = end - start;
        let points: Vec<Vector2<f64>> = piece.points().collect();
        let legs: Vec<Vector2<f64>> = points.iter().zip(points.iter().skip(1)).map(|(a, b)| b - a).collect();
        // Poles that only go forwards: then the curve does, too (variation diminishing).
        if !legs.iter().all(|leg| leg.dot(&chord) >= 0.0) {
            return None;
        }
        let least = f64::EPSILON * chord.norm();
        let long = |leg: &&Vector2<f64>| leg.norm() > least;
        let start_tangent = legs.iter().find(long)?.normalize();
        let end_tangent = legs.iter().rev().find(long)?.normalize();
        let along = chord.normalize();
        if !(start_tangent.dot(&along) > LEAST_COSINE && end_tangent.dot(&along) > LEAST_COSINE) {
            return None;
        }
        // Equal tangents d on either side of the joint: |chord − d (t0 + t1)| = 2 d.
        let both = start_tangent + end_tangent;
        let turn = 0.5 * (start_tangent - end_tangent).norm_squared();
        let (forward, square) = (chord.dot(&both), chord.norm_squared());
        let d = square / (forward + (forward * forward + 2.0 * turn * square).sqrt());
        let (first_corner, second_corner) = (start + start_tangent * d, end - end_tangent * d);
        let joint = (first_corner + second_corner) * 0.5;
        let joint_tangent = (second_corner - first_corner).normalize();
        let (first, second) = (joint - start, end - joint);
        // tan(sweep/4): half the angle between chord and tangent.
        let first_bulge = start_tangent.perp(&first) / (first.norm() + start_tangent.dot(&first));
        let second_bulge = second.perp(&end_tangent) / (second.norm() + end_tangent.dot(&second));
        let pair = Self { start, start_tangent, joint, joint_tangent, end, end_tangent, first_bulge, second_bulge };
        (first_bulge.is_finite() && second_bulge.is_finite()).then_some(pair)
    }

    /// Largest distance of the curve from the arcs, in both directions.
    fn off(&self, piece: &Bezier) -> f64 {
        let curvature = |start: Vector2<f64>, end: Vector2<f64>, bulge: f64| {
            4.0 * bulge / ((1.0 + bulge * bulge) * (end - start).norm())
        };
        let first = curvature(self.start, self.joint, self.first_bulge);
        let second = curvature(self.joint, self.end, self.second_bulge);
        let (before, after) = piece.halves();
        // The middle of the curve is not the joint: the part between them is measured from the circle of the other arc, which is
        // tangent to its own there.
        let past = (before.end() - self.joint).dot(&self.joint_tangent);
        if !(past.abs() * first.abs().max(second.abs()) < 0.2) {
            return f64::INFINITY;
        }
        let between = 0.5 * TANGENT_GAP * past * past * (first - second).abs();
        let off_first = before.off_circle(self.start, self.start_tangent, first);
        let off_second = after.off_circle(self.end, self.end_tangent, second);
        off_first.max(off_second) + between
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(curve: &Bezier, t: f64) -> Vector2<f64> {
        let mut row = curve.poles.clone();
        while row.len() > 1 {
            row = row.windows(2).map(|p| std::array::from_fn(|k| p[0][k] * (1.0 - t) + p[1][k] * t)).collect();
        }
        Vector2::new(row[0][0], row[0][1]) / row[0][2]
    }

    /// Largest distance of points of the curve from the segments.
    fn farthest(curves: &[Bezier], edges: &[Edge]) -> f64 {
        let points = curves.iter().flat_map(|curve| (0..=500).map(move |i| at(curve, f64::from(i) / 500.0)));
        points
            .map(|p| edges.iter().map(|edge| edge.nearest(p).left.abs()).fold(f64::INFINITY, f64::min))
            .fold(0.0, f64::max)
    }

    fn bumpy() -> Vec<Bezier> {
        let v = Vector2::new;
        vec![
            Bezier::polynomial(&[v(0.0, 0.0), v(10.0, 0.0), v(20.0, 5.0), v(30.0, -5.0)]),
            Bezier { poles: vec![[30.0, -5.0, 1.0], [200.0, -75.0, 5.0], [9.0, -8.0, 0.2], [60.0, 0.0, 1.0]] },
            Bezier::polynomial(&[v(60.0, 0.0), v(80.0, 20.0), v(60.0, 20.0), v(80.0, 0.0)]),
        ]
    }

    #[test]
    fn arcs_are_as_near_as_they_say() {
        for within in [1e-2, 1e-5, 1e-8] {
            let mut strand = EdgeRun::default();
            strand.follow(&bumpy(), within, &mut WorkCount::default()).expect("followed");
            let (curves, edges) = (bumpy(), &strand.edges);
            assert!(farthest(&curves, edges) <= 1.001 * within, "{within}: {}", farthest(&curves, edges));
            assert!(edges.windows(2).all(|pair| pair[0].end() == pair[1].start()));
            assert_eq!(edges.iter().filter(|edge| edge.segment().is_none()).count(), 2, "polynomials as they are");
            // The count grows with the cube root of the accuracy.
            let count = u32::try_from(edges.len()).expect("few");
            assert!(f64::from(count) < 12.0 + 25.0 * within.powf(-1.0 / 3.0), "{within}: {}", edges.len());
        }
    }

    #[test]
    fn tangents_are_kept() {
        let mut strand = EdgeRun::default();
        strand.follow(&bumpy()[1..2], 1e-7, &mut WorkCount::default()).expect("followed");
        for pair in strand.edges.windows(2) {
            assert!(pair[0].end_tangent().perp(&pair[1].start_tangent()).abs() < 1e-7, "{pair:?}");
        }
    }

    #[test]
    fn an_ellipse_is_one() {
        let axes = (Vector2::new(3.0, 4.0), Vector2::new(-0.8, 0.6));
        let curves = Bezier::ellipse(Vector2::new(1.0, 2.0), axes, (0.0, std::f64::consts::TAU));
        let mut strand = EdgeRun::default();
        strand.follow(&curves, 1e-9, &mut WorkCount::default()).expect("followed");
        for edge in &strand.edges {
            let d = edge.middle() - Vector2::new(1.0, 2.0);
            let (u, v) = (d.dot(&axes.0) / 25.0, d.dot(&axes.1));
            assert!((u.hypot(v) - 1.0).abs() < 2e-9);
        }
    }

    /// A cusp, a line that turns back, a point: each of them ends.
    #[test]
    fn awkward_curves_end() {
        let v = Vector2::new;
        for poles in [
            vec![v(0.0, 0.0), v(10.0, 10.0), v(0.0, 10.0), v(10.0, 0.0)],
            vec![v(0.0, 0.0), v(30.0, 0.0), v(-20.0, 0.0), v(10.0, 0.0)],
            vec![v(1.0, 1.0); 4],
            vec![v(0.0, 0.0), v(1e15, -1e15), v(-1e15, 1e15), v(0.0, 0.0)],
            vec![v(0.0, 0.0), v(0.0, 0.0), v(5.0, 0.0), v(5.0, 0.0)],
        ] {
            let _ = EdgeRun::default().follow(&[Bezier::polynomial(&poles)], 1e-6, &mut WorkCount::default());
        }
        let mut there = EdgeRun::default();
        there
            .follow(
                &[Bezier::polynomial(&[v(0.0, 0.0), v(30.0, 0.0), v(-20.0, 0.0), v(10.0, 0.0)])],
                1e-6,
                &mut WorkCount::default(),
            )
            .expect("a line");
        assert!(there.edges.iter().map(Edge::length).sum::<f64>() > 15.0, "it goes there and back");
    }
}
