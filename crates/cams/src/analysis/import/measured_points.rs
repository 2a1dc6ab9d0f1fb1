//! The lift of a follower on measured points: each point with the normal there gives a place of the follower.
//!
//! A roller of radius r touches a point P with the outward normal n where its centre is C = P + r n; a face touches it where its normal is n and its
//! distance from the shaft P·n. The path of the centre is the envelope of these circles, so that a small error of n moves C along that path: in the
//! first order only the error of the point itself, along n, comes into the lift. The normals are those of a parabola through neighbours, fitted by
//! least squares.

use super::positions::Positions;
use camgen_kernel::follower::{Element, Follower};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Jet;
use camgen_kernel::numeric::scatter::median;
use camgen_kernel::refusal::Refusal;
use nalgebra::{Matrix3, Vector2, Vector3};
use std::f64::consts::TAU;

/// Fewest points to either side for a normal, and most, as a share of all.
const SIDE: usize = 2;
const OF_ALL: usize = 40;
/// Error of a normal that does not matter: its square, times a radius, is below a hundredth of a micrometre.
const NORMAL: f64 = 3e-4;
/// Steps to the lift of a follower through a place.
const STEPS: usize = 30;
/// Widest gap between points, rad.
const GAP: f64 = 15.0 * TAU / 360.0;
/// Positions nearer than this are one, rad.
const SAME: f64 = 1e-9;

/// A point with the outward normal there, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointNormal {
    pub(super) point: Vector2<f64>,
    pub(super) normal: Vector2<f64>,
    /// Number of the point in its table.
    pub(super) row: usize,
}

/// The points in the order of their polar angle about the shaft, with their normals; they must go round it.
pub(super) fn normals(points: &[Vector2<f64>]) -> Result<Vec<PointNormal>, Refusal> {
    let polar = |point: &Vector2<f64>| libm::atan2(point.y, point.x).rem_euclid(TAU);
    let mut order: Vec<usize> = (0..points.len()).collect();
    let place = |at: &usize| points.get(*at).map_or(0.0, polar);
    order.sort_by(|a, b| place(a).total_cmp(&place(b)));
    order.dedup_by(|a, b| points.get(*a) == points.get(*b));
    let count = order.len();
    let next = |at: usize| order.get((at + 1) % count.max(1)).copied().unwrap_or(0);
    for (at, own) in order.iter().enumerate() {
        let width = (place(&next(at)) - place(own)).rem_euclid(TAU);
        if width > GAP {
            let what = format!(
                "the points leave out {:.1} deg, from {:.1} deg (point {}) to {:.1} deg (point {}) about (0, 0)",
                width.to_degrees(),
                place(own).to_degrees(),
                own + 1,
                place(&next(at)).to_degrees(),
                next(at) + 1
            );
            let remedy = "measure the cam all round, about its shaft; with --fit centre the shaft is found, but it must be within the points";
            return Err(Refusal::new(what).remedy(remedy));
        }
    }
    let sorted: Vec<Vector2<f64>> = order.iter().filter_map(|at| points.get(*at).copied()).collect();
    let side = side(&sorted);
    let normal = |(at, row): (usize, &usize)| {
        let point = sorted.get(at).copied().unwrap_or_default();
        PointNormal { point, normal: normal_at(&sorted, at, side), row: *row }
    };
    Ok(order.iter().enumerate().map(normal).collect())
}

/// Radii (m) of points (mm) by their polar angle.
pub(super) fn radii(points: &[Vector2<f64>]) -> Positions {
    let mut all: Vec<(f64, f64, usize)> = points
        .iter()
        .enumerate()
        .map(|(row, point)| (libm::atan2(point.y, point.x).rem_euclid(TAU), point.norm() / MILLIMETRES, row))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.dedup_by(|a, b| a.0 - b.0 <= SAME);
    Positions {
        quantity: camgen_kernel::motion::Quantity::Length,
        fill: TAU,
        angles: all.iter().map(|found| found.0).collect(),
        values: all.iter().map(|found| found.1).collect(),
        by_shift: Vec::new(),
        rows: all.iter().map(|found| found.2).collect(),
    }
}

/// Points to either side for a normal: more where they are noisy and dense.
fn side(points: &[Vector2<f64>]) -> usize {
    let count = points.len();
    let noise = MILLIMETRES * radii(points).noise();
    let mut steps: Vec<f64> = points.iter().zip(points.iter().skip(1)).map(|(a, b)| (b - a).norm()).collect();
    let step = median(&mut steps).max(1e-9);
    #[expect(clippy::cast_precision_loss, reason = "few points")]
    let good = |side: &usize| {
        let m = *side as f64;
        noise / (step * (2.0 * m * m * m / 3.0).sqrt()) <= NORMAL
    };
    (SIDE..(count / OF_ALL).max(SIDE + 1)).find(good).unwrap_or((count / OF_ALL).max(SIDE))
}

/// The outward normal of the parabola through neighbours.
fn normal_at(points: &[Vector2<f64>], at: usize, side: usize) -> Vector2<f64> {
    let count = points.len();
    let point = |by: usize| points.get((at + count + by - side) % count).copied().unwrap_or_default();
    let own = point(side);
    let chord = point(side + 1) - point(side - 1);
    let length = chord.norm();
    if !(length > 0.0) {
        return Vector2::zeros();
    }
    let along = chord / length;
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for by in 0..=2 * side {
        let away = (point(by) - own) / length;
        let u = away.dot(&along);
        let row = Vector3::new(1.0, u, u * u);
        matrix += row * row.transpose();
        right += row * along.perp(&away);
    }
    // Across the chord by the distance along it.
    let slope = matrix.lu().solve(&right).map_or(0.0, |found| found.y);
    let tangent = (along + Vector2::new(-along.y, along.x) * slope).normalize();
    Vector2::new(tangent.y, -tangent.x)
}

/// The positions of a follower on points that are centres of a ball (mm) about a centre (mm).
pub(super) fn positions(points: &[PointNormal], follower: &dyn Follower, ball: f64) -> Result<Positions, Refusal> {
    let element = follower.element();
    let out = match element {
        Element::Roller { radius } => MILLIMETRES * radius - ball,
        Element::Face => -ball,
    };
    let mut all: Vec<(f64, f64, [f64; 2], usize)> = Vec::with_capacity(points.len());
    for point in points {
        let centre = (point.point + point.normal * out) / MILLIMETRES;
        let angle = follower.parameter_of(centre, point.normal);
        let placed = angle.is_finite().then(|| lift_at(follower, angle, centre, point.normal)).flatten();
        let Some((lift, by_shift)) = placed else {
            let what = "the follower cannot touch the cam there";
            return Err(Refusal::new(what)
                .at(format!("point {} ({:.3}, {:.3}) mm", point.row + 1, point.point.x, point.point.y))
                .remedy("give the dimensions of the follower that ran on it, with its pivot and side"));
        };
        all.push((angle.rem_euclid(TAU), lift, by_shift, point.row));
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.dedup_by(|a, b| a.0 - b.0 <= SAME);
    Ok(Positions {
        quantity: follower.quantity(),
        fill: TAU,
        angles: all.iter().map(|found| found.0).collect(),
        values: all.iter().map(|found| found.1).collect(),
        by_shift: all.iter().map(|found| found.2).collect(),
        rows: all.iter().map(|found| found.3).collect(),
    })
}

/// The lift at which a follower has a place, and what a shift of the centre adds to it.
fn lift_at(follower: &dyn Follower, angle: f64, place: Vector2<f64>, normal: Vector2<f64>) -> Option<(f64, [f64; 2])> {
    let face = follower.element() == Element::Face;
    let mut lift = 0.0;
    for _ in 0..STEPS {
        let jet = Jet { s: lift, ..Jet::default() };
        let touch = follower.touch(angle, &jet);
        let step = if face {
            (place.dot(&normal) - touch.curve.point.dot(&touch.curve.outward())) / follower.on_face(&jet)?.along_normal
        } else {
            (place - touch.curve.point).dot(&touch.drive) / follower.leverage(&jet)
        };
        lift += step;
        if step.abs() <= 1e-15 {
            break;
        }
    }
    let jet = Jet { s: lift, ..Jet::default() };
    let rate = if face {
        follower.on_face(&jet)?.along_normal
    } else {
        follower.touch(angle, &jet).drive.dot(&normal) * follower.leverage(&jet)
    };
    (lift.is_finite() && rate > 0.0).then(|| (lift, [-normal.x / rate, -normal.y / rate]))
}
