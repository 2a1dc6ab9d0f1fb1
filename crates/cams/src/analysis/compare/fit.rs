//! Measured points on the exact profile: their distances along the normal, the turn and the shift with which they agree best, and harmonics.

use crate::body::Cut;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::profile::Curves;
use camgen_kernel::profile::outline::{self, OutlineError};
use nalgebra::{DMatrix, DVector, Matrix3, Vector2, Vector3};
use std::f64::consts::TAU;

/// Tolerance of the outline near which the exact places are searched, m.
const NEAR: f64 = 2e-6;
/// Steps to the exact place, and the distance along the profile at which they end, mm.
const STEPS: usize = 8;
const AT_REST: f64 = 1e-9;
/// A foot that is farther than this from the point along the profile, mm, is not a foot: the point lies at a corner.
const BESIDE: f64 = 1e-6;
/// Angles of the first look all round, points of it, and how many of the best angles are followed.
const ANGLES: u32 = 180;
const LOOKED: usize = 90;
const FOLLOWED: usize = 3;
/// Steps of the fit, and its smallest step, mm or rad.
const FITS: usize = 30;
const SETTLED: f64 = 1e-12;

/// Most orders of the waviness, and points for each order.
const ORDERS: usize = 24;
const POINTS_FOR_ORDER: usize = 4;
/// Points that leave a larger gap, rad, do not go round the turn.
const GAP: f64 = 1.0;
/// Waves that are found with the move, the share of the largest that each has at least, and how often both are found.
const WAVES: usize = 3;
const WORTH: f64 = 0.2;
const JOINT: usize = 12;

/// The exact profile of a cut.
pub(super) struct ExactProfile<'a> {
    curves: Curves<'a>,
    tree: EdgeTree,
    mirrored: bool,
    /// Radius of the ball whose centres the points are, mm.
    ball: f64,
}

/// A measured point on the profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeasuredPlace {
    /// The point as it lies on the drawing, mm.
    pub(super) point: Vector2<f64>,
    /// How much more metal is there than there should be, mm.
    pub(super) deviation: f64,
    /// Normal out of the metal in the drawing.
    pub(super) normal: Vector2<f64>,
    /// The place of the exact profile, mm.
    pub(super) foot: Vector2<f64>,
    /// Cam angle at which the follower is there, rad.
    pub(super) angle: f64,
    /// By how much that lifts the follower, mm: along its path.
    pub(super) lift: f64,
}

/// What may be moved to fit the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComparisonFit {
    /// Nothing: the points lie in the frame of the drawing.
    Nothing,
    /// The angle about the shaft.
    Angle,
    /// The angle and the centre.
    Centre,
}

/// A turn about the shaft, rad, and then a shift, mm, of the measured points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeasuredMove {
    pub(super) turn: f64,
    pub(super) shift: Vector2<f64>,
}

impl MeasuredMove {
    const NONE: Self = Self { turn: 0.0, shift: Vector2::new(0.0, 0.0) };

    pub(super) fn of(&self, point: Vector2<f64>) -> Vector2<f64> {
        let (sin, cos) = libm::sincos(self.turn);
        Vector2::new(cos * point.x - sin * point.y, sin * point.x + cos * point.y) + self.shift
    }
}

impl<'a> ExactProfile<'a> {
    /// The profile of a cut under the ball of a probe of a radius, mm; 0 where the points lie on the profile.
    pub(super) fn new(cut: &Cut<'a>, ball: f64) -> Result<Option<Self>, OutlineError> {
        let Some(curves) = cut.curves.filter(|curves| curves.motion.period().is_some()) else { return Ok(None) };
        let tree = EdgeTree::new(&outline::profile(curves, NEAR)?.contour);
        Ok(Some(Self { curves, tree, mirrored: cut.mirrored == [true], ball }))
    }

    fn flipped(&self, point: Vector2<f64>) -> Vector2<f64> {
        if self.mirrored { Vector2::new(point.x, -point.y) } else { point }
    }

    /// Distance of a point from the profile, mm, as the fine outline has it.
    fn roughly(&self, point: Vector2<f64>) -> f64 {
        let side = self.curves.metal_side();
        let away = self.tree.nearest(self.flipped(point)).map_or(f64::NAN, |nearest| -nearest.left);
        side * away - self.ball
    }

    /// A point (mm) on the exact profile.
    pub(super) fn place(&self, point: Vector2<f64>) -> Option<MeasuredPlace> {
        let own = self.flipped(point);
        let nearest = self.tree.nearest(own)?;
        let tangent = nearest.tangent;
        let outward = Vector2::new(tangent.y, -tangent.x);
        let centre = nearest.foot / MILLIMETRES + outward * self.curves.offset();
        let mut angle = self.curves.follower.parameter_of(centre, outward);
        let mut foot = None;
        for _ in 0..STEPS {
            let (piece, inside) = self.curves.motion.locate(angle);
            let frame = self.curves.profile(piece, inside).scaled(MILLIMETRES);
            let along = (own - frame.point).dot(&frame.tangent);
            let away = (own - frame.point).dot(&frame.outward());
            foot = Some((frame, along, piece, inside));
            if along.abs() <= AT_REST {
                break;
            }
            angle = inside + along / (frame.speed * (1.0 + frame.curvature * away).max(0.1));
        }
        let (frame, along, piece, inside) = foot?;
        let side = self.curves.metal_side();
        // At a corner no normal leads to the point: the nearest place of the outline is exact there.
        let (place, normal) =
            if along.abs() <= BESIDE { (frame.point, frame.outward()) } else { (nearest.foot, outward) };
        let away = if along.abs() <= BESIDE { (own - place).dot(&normal) } else { -nearest.left };
        let deviation = side * away - self.ball;
        let cosine = libm::cos(self.curves.contact(piece, inside).pressure_angle);
        Some(MeasuredPlace {
            point,
            deviation,
            normal: self.flipped(normal * side),
            foot: self.flipped(place),
            angle: inside,
            lift: side * deviation / cosine,
        })
    }

    /// The middle of the profile, mm.
    fn middle(&self) -> Vector2<f64> {
        middle(self.tree.edges().iter().map(|edge| self.flipped(edge.start())))
    }

    /// The move with which the points agree best with the profile, in the sense of least squares.
    pub(super) fn fitted(&self, points: &[Vector2<f64>], free: ComparisonFit) -> MeasuredMove {
        if free == ComparisonFit::Nothing {
            return MeasuredMove::NONE;
        }
        let every = points.len().div_ceil(LOOKED).max(1);
        let looked: Vec<Vector2<f64>> = points.iter().step_by(every).copied().collect();
        let (measured, own) = (middle(points.iter().copied()), self.middle());
        let at = |i: u32| {
            let turned = MeasuredMove { turn: TAU * f64::from(i) / f64::from(ANGLES), ..MeasuredMove::NONE };
            // The middle of points that go round lies near that of the profile.
            let shift = if free == ComparisonFit::Centre { own - turned.of(measured) } else { Vector2::zeros() };
            let start = MeasuredMove { shift, ..turned };
            let sum: f64 = looked.iter().map(|point| self.roughly(start.of(*point)).powi(2)).sum();
            (sum, start)
        };
        let mut starts: Vec<(f64, MeasuredMove)> = (0..ANGLES).map(at).collect();
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let followed = starts.into_iter().take(FOLLOWED).map(|(_, start)| self.followed(points, start, free));
        let best = followed.reduce(|a, b| if b.0 < a.0 { b } else { a });
        best.map_or(MeasuredMove::NONE, |(_, found)| self.beside_waves(points, found, free))
    }

    /// The move, found together with the mean and the few largest waves of what it leaves: a wave that looks a little like a turn of the cam would otherwise turn it.
    fn beside_waves(&self, points: &[Vector2<f64>], start: MeasuredMove, free: ComparisonFit) -> MeasuredMove {
        let mut found = start;
        for _ in 0..JOINT {
            let places: Vec<MeasuredPlace> = points.iter().filter_map(|point| self.place(found.of(*point))).collect();
            let values: Vec<(f64, f64)> = places.iter().map(|place| (polar(place.foot), place.deviation)).collect();
            if places.len() < POINTS_FOR_ORDER || !covers(&values) {
                return start;
            }
            let mut orders = largest_orders(&values);
            orders.retain(|order| *order > 1 || free == ComparisonFit::Angle);
            let moves = if free == ComparisonFit::Centre { 3 } else { 1 };
            let size = moves + 1 + 2 * orders.len();
            let (mut matrix, mut right) = (DMatrix::<f64>::zeros(size, size), DVector::<f64>::zeros(size));
            for (place, (angle, deviation)) in places.iter().zip(&values) {
                let moved = by_move(place, &found);
                let waves = orders.iter().flat_map(|order| wave(*order, *angle));
                // A deviation is what the move leaves, and the mean and the waves are what it is.
                let model = std::iter::once(-1.0).chain(waves.map(|value| -value));
                let row = DVector::from_iterator(size, moved.iter().take(moves).copied().chain(model));
                matrix.ger(1.0, &row, &row, 1.0);
                right.axpy(-deviation, &row, 1.0);
            }
            let Some(step) = matrix.lu().solve(&right) else { return start };
            let at = |index: usize| {
                step.get(index).copied().filter(|value| value.is_finite() && index < moves).unwrap_or(0.0)
            };
            found = MeasuredMove { turn: found.turn + at(0), shift: found.shift + Vector2::new(at(1), at(2)) };
        }
        found
    }

    /// Gauss and Newton's steps from a start; the sum of squares, and the move.
    fn followed(&self, points: &[Vector2<f64>], start: MeasuredMove, free: ComparisonFit) -> (f64, MeasuredMove) {
        let mut found = start;
        let mut least = (f64::INFINITY, start);
        for _ in 0..FITS {
            let (mut matrix, mut right, mut sum) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
            for place in points.iter().filter_map(|point| self.place(found.of(*point))) {
                let row = by_move(&place, &found);
                matrix += row * row.transpose();
                right -= row * place.deviation;
                sum += place.deviation * place.deviation;
            }
            if sum < least.0 {
                least = (sum, found);
            }
            let step = if free == ComparisonFit::Centre {
                matrix.lu().solve(&right).unwrap_or_else(Vector3::zeros)
            } else {
                Vector3::new(right.x / matrix.m11, 0.0, 0.0)
            };
            // A round cam has no best angle.
            let step = step.map(|value| if value.is_finite() { value } else { 0.0 });
            found = MeasuredMove { turn: found.turn + step.x, shift: found.shift + Vector2::new(step.y, step.z) };
            if step.norm() <= SETTLED {
                break;
            }
        }
        least
    }
}

/// By how much the deviation of a point grows with a turn, and with a shift along either axis.
fn by_move(place: &MeasuredPlace, moved: &MeasuredMove) -> Vector3<f64> {
    let turned = place.point - moved.shift;
    Vector3::new(place.normal.dot(&Vector2::new(-turned.y, turned.x)), place.normal.x, place.normal.y)
}

/// The mean of points by the length of way to the next one, mm: that of points that go round, however dense they are.
fn middle(points: impl Iterator<Item = Vector2<f64>> + Clone) -> Vector2<f64> {
    let after = points.clone().skip(1).chain(points.clone().next());
    let (sum, length) = points.zip(after).fold((Vector2::zeros(), 0.0), |(sum, length), (a, b)| {
        let way: f64 = (b - a).norm();
        (sum + 0.5 * (a + b) * way, length + way)
    });
    if length > 0.0 { sum / length } else { Vector2::zeros() }
}

/// Cosine and sine of an order at an angle.
fn wave(order: usize, angle: f64) -> [f64; 2] {
    #[expect(clippy::cast_precision_loss, reason = "a few dozen orders")]
    let (sin, cos) = libm::sincos(order as f64 * angle);
    [cos, sin]
}

/// The few largest waves of values at angles over a turn.
fn largest_orders(values: &[(f64, f64)]) -> Vec<usize> {
    let order = highest_order(values);
    let Some(found) = harmonics(values, order) else { return Vec::new() };
    let size = |index: usize| found.get(index).map_or(0.0, |[cos, sin]| libm::hypot(*cos, *sin));
    let mut orders: Vec<usize> = (1..=order).collect();
    orders.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
    let largest = orders.first().map_or(0.0, |first| size(*first));
    orders.retain(|order| size(*order) > WORTH * largest);
    orders.truncate(WAVES);
    orders
}

/// Polar angle of a point, 0 to 2π.
pub(super) fn polar(point: Vector2<f64>) -> f64 {
    libm::atan2(point.y, point.x).rem_euclid(TAU)
}

/// The widest gap between places on a turn, rad.
fn widest_gap(values: &[(f64, f64)]) -> f64 {
    let mut angles: Vec<f64> = values.iter().map(|(angle, _)| angle.rem_euclid(TAU)).collect();
    angles.sort_by(f64::total_cmp);
    let after = angles.iter().skip(1).copied().chain(angles.first().map(|first| first + TAU));
    angles.iter().zip(after).map(|(a, b)| b - a).fold(0.0, f64::max)
}

/// Whether places go round the whole turn.
pub(super) fn covers(values: &[(f64, f64)]) -> bool {
    widest_gap(values) <= GAP
}

/// The highest order of a wave that values at these angles can show: with a few points for each, and two within the widest gap.
pub(super) fn highest_order(values: &[(f64, f64)]) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number, or 0")]
    let by_gap = (0.5 * TAU / widest_gap(values)) as usize;
    (values.len() / POINTS_FOR_ORDER).min(ORDERS).min(by_gap)
}

/// The mean and the harmonics of values at angles (rad) over a turn, up to an order, by least squares: cosine and sine of each order.
pub(super) fn harmonics(values: &[(f64, f64)], order: usize) -> Option<Vec<[f64; 2]>> {
    let size = 2 * order + 1;
    let mut matrix = DMatrix::<f64>::zeros(size, size);
    let mut right = DVector::<f64>::zeros(size);
    for (angle, value) in values {
        let waves = (1..=order).flat_map(|order| wave(order, *angle));
        let row = DVector::from_iterator(size, std::iter::once(1.0).chain(waves));
        matrix.ger(1.0, &row, &row, 1.0);
        right.axpy(*value, &row, 1.0);
    }
    let found = matrix.cholesky()?.solve(&right);
    let at = |index: usize| found.get(index).copied().unwrap_or(f64::NAN);
    Some(std::iter::once([at(0), 0.0]).chain((1..=order).map(|k| [at(2 * k - 1), at(2 * k)])).collect())
}
