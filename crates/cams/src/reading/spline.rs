//! SPLINE and ELLIPSE as rational Bézier curves.

use super::curve::{Bezier, HIGHEST_DEGREE};
use super::record::{EntityFault, EntityRecord, fault};
use camgen_kernel::geometry::nurbs::blossom;
use nalgebra::{Vector2, Vector3};

/// Bits of the flags (70) of a SPLINE.
const CLOSED: i64 = 1;
const PERIODIC: i64 = 2;
/// Ends of two curves count as one where they are nearer than this share of their size: rounding.
const SAME: f64 = 1e-9;
/// Parameters of an ellipse nearer to a full turn than this count as a full turn: they are written with some fifteen digits, rad.
const WHOLE_TURN: f64 = 1e-9;

/// A SPLINE, with the heights of its points: by its control points where it has them, otherwise through its fit points.
pub(super) fn spline(record: &EntityRecord<'_>) -> Result<(Vec<Bezier>, Vec<f64>), EntityFault> {
    let controls = record.points(10)?;
    let points = if controls.is_empty() { record.points(11)? } else { controls.clone() };
    let heights = points.iter().map(|point| point.z).collect();
    let flat: Vec<Vector2<f64>> = points.iter().map(Vector3::xy).collect();
    let curves = if controls.is_empty() { through(record, flat)? } else { by_controls(record, &flat)? };
    let apart = curves.iter().zip(curves.iter().skip(1)).map(|(a, b)| {
        let (end, start) = (a.end(), b.start());
        (start - end).norm() > SAME * (1.0 + start.norm())
    });
    if apart.into_iter().any(|jumps| jumps) { fault("jumps from one place to another") } else { Ok((curves, heights)) }
}

/// The curves between the knots.
fn by_controls(record: &EntityRecord<'_>, points: &[Vector2<f64>]) -> Result<Vec<Bezier>, EntityFault> {
    let degree = usize::try_from(record.whole(71, 3)?).ok().filter(|degree| (1..=HIGHEST_DEGREE).contains(degree));
    let Some(degree) = degree else { return fault(format!("has a degree that is not between 1 and {HIGHEST_DEGREE}")) };
    let (knots, weights) = (record.reals(40)?, record.reals(41)?);
    if points.len() <= degree || knots.len() != points.len() + degree + 1 || !knots.is_sorted() {
        return fault("has knots that do not fit its control points");
    }
    if !(weights.is_empty() || weights.len() == points.len() && weights.iter().all(|weight| *weight > 0.0)) {
        return fault("has weights that do not fit its control points, or that are not above 0");
    }
    let weights = weights.into_iter().chain(std::iter::repeat(1.0));
    let poles: Vec<[f64; 3]> = points.iter().zip(weights).map(|(p, w)| [p.x * w, p.y * w, w]).collect();
    let mut curves = Vec::new();
    for span in degree..points.len() {
        let (Some(&low), Some(&high)) = (knots.get(span), knots.get(span + 1)) else { continue };
        if high > low {
            let poles: Option<Vec<[f64; 3]>> =
                (0..=degree).map(|at_high| blossom(degree, span, &knots, &poles, low, high, at_high)).collect();
            curves.extend(poles.map(|poles| Bezier { poles }));
        }
    }
    if curves.is_empty() { fault("has no length") } else { Ok(curves) }
}

/// The cubic spline through fit points, with continuous second derivative by the length of chord.
///
/// CAD programs draw a SPLINE without control points like this: with the given end tangents (12 and 13), and without curvature at ends
/// that have no tangent; a closed one is smooth all round.
fn through(record: &EntityRecord<'_>, mut points: Vec<Vector2<f64>>) -> Result<Vec<Bezier>, EntityFault> {
    points.dedup();
    let closed = record.whole(70, 0)? & (CLOSED | PERIODIC) != 0;
    if closed
        && let (Some(first), Some(last)) = (points.first().copied(), points.last().copied())
        && first != last
    {
        points.push(first);
    }
    if points.len() < 2 {
        return fault("has neither control points nor fit points");
    }
    let tangent = |code: i32| -> Result<Option<Vector2<f64>>, EntityFault> {
        if record.one(code)?.is_none() {
            return Ok(None);
        }
        let tangent = record.point(code)?.xy();
        Ok((tangent.norm() > 0.0).then(|| tangent.normalize()))
    };
    let (start, end) = (tangent(12)?, tangent(13)?);
    let ends = if closed && points.len() > 3 && start.is_none() && end.is_none() {
        SplineEnds::Periodic
    } else {
        SplineEnds::Open(start, end)
    };
    let slopes = slopes(&points, ends);
    let hermite: Vec<PointAndDerivative> = points.into_iter().zip(slopes).collect();
    let curve = |((p, d), (q, e)): (&PointAndDerivative, &PointAndDerivative)| {
        let third = (q - p).norm() / 3.0;
        Bezier::polynomial(&[*p, p + d * third, q - e * third, *q])
    };
    Ok(hermite.iter().zip(hermite.iter().skip(1)).map(curve).collect())
}

/// A point and the derivative there.
type PointAndDerivative = (Vector2<f64>, Vector2<f64>);

/// The conditions of a spline at its ends.
#[derive(Clone, Copy)]
enum SplineEnds {
    /// A derivative by the length of chord; without one the second derivative is 0.
    Open(Option<Vector2<f64>>, Option<Vector2<f64>>),
    /// The last point is the first.
    Periodic,
}

/// Row of a tridiagonal system: the entries below, on and above the diagonal, and the right side.
type TridiagonalRow = (f64, f64, f64, Vector2<f64>);

/// Derivatives by the length of chord at the points of the spline with a continuous second derivative.
fn slopes(points: &[Vector2<f64>], ends: SplineEnds) -> Vec<Vector2<f64>> {
    let sides: Vec<Vector2<f64>> = points.iter().zip(points.iter().skip(1)).map(|(a, b)| b - a).collect();
    // d₋/h₋ + 2 d (1/h₋ + 1/h₊) + d₊/h₊ = 3 (Δ₋/h₋² + Δ₊/h₊²).
    let inner = |before: &Vector2<f64>, after: &Vector2<f64>| -> TridiagonalRow {
        let (g, h) = (1.0 / before.norm(), 1.0 / after.norm());
        (g, 2.0 * (g + h), h, (before * (g * g) + after * (h * h)) * 3.0)
    };
    let between = sides.iter().zip(sides.iter().skip(1)).map(|(before, after)| inner(before, after));
    let (Some(first), Some(last)) = (sides.first(), sides.last()) else { return Vec::new() };
    match ends {
        SplineEnds::Open(start, end) => {
            let at_end = |given: Option<Vector2<f64>>, side: &Vector2<f64>| match given {
                Some(slope) => (0.0, 1.0, 0.0, slope),
                None => (1.0, 2.0, 1.0, side * (3.0 / side.norm())),
            };
            let (a, b) = (at_end(start, first), at_end(end, last));
            let rows: Vec<TridiagonalRow> =
                std::iter::once((0.0, a.1, a.2, a.3)).chain(between).chain([(b.0, b.1, 0.0, b.3)]).collect();
            tridiagonal(&rows)
        }
        SplineEnds::Periodic => {
            // The last point is the first: the cyclic system by Sherman and Morrison.
            let mut rows: Vec<TridiagonalRow> = std::iter::once(inner(last, first)).chain(between).collect();
            let corner = 1.0 / last.norm();
            let gamma = -rows.first().map_or(1.0, |row| row.1);
            let count = rows.len();
            if let Some(row) = rows.first_mut() {
                row.1 -= gamma;
            }
            if let Some(row) = rows.last_mut() {
                row.1 -= corner * corner / gamma;
            }
            let unit = |index: usize| match index {
                0 => Vector2::new(gamma, 0.0),
                index if index + 1 == count => Vector2::new(corner, 0.0),
                _ => Vector2::zeros(),
            };
            let aside: Vec<TridiagonalRow> =
                rows.iter().enumerate().map(|(index, row)| (row.0, row.1, row.2, unit(index))).collect();
            let (found, aside) = (tridiagonal(&rows), tridiagonal(&aside));
            let ends = |list: &[Vector2<f64>]| match (list.first(), list.last()) {
                (Some(first), Some(last)) => first + last * (corner / gamma),
                _ => Vector2::zeros(),
            };
            let factor = ends(&found) / (1.0 + ends(&aside).x);
            let mut slopes: Vec<Vector2<f64>> = found.iter().zip(&aside).map(|(d, z)| d - factor * z.x).collect();
            slopes.extend(slopes.first().copied());
            slopes
        }
    }
}

/// Thomas' algorithm; the rows are dominated by their diagonals.
fn tridiagonal(rows: &[TridiagonalRow]) -> Vec<Vector2<f64>> {
    let (mut above, mut right) = (0.0, Vector2::zeros());
    let forward: Vec<(f64, Vector2<f64>)> = rows
        .iter()
        .map(|(low, middle, high, value)| {
            let pivot = middle - low * above;
            (above, right) = (high / pivot, (value - right * *low) / pivot);
            (above, right)
        })
        .collect();
    let mut next = Vector2::zeros();
    let mut found: Vec<Vector2<f64>> = forward
        .iter()
        .rev()
        .map(|(above, right)| {
            next = right - next * *above;
            next
        })
        .collect();
    found.reverse();
    found
}

/// An ELLIPSE, with the heights of its points.
pub(super) fn ellipse(record: &EntityRecord<'_>) -> Result<(Vec<Bezier>, Vec<f64>), EntityFault> {
    let (centre, major, ratio) = (record.point(10)?, record.point(11)?, record.required_real(40)?);
    let up = if record.is_seen_from_behind()? { -1.0 } else { 1.0 };
    let a = major.xy();
    if a.norm() == 0.0 || ratio == 0.0 {
        return fault("has no axes");
    }
    let b = Vector2::new(-a.y, a.x) * (up * ratio);
    let (from, to) = (record.real(41, 0.0)?, record.real(42, std::f64::consts::TAU)?);
    let swept = (to - from).rem_euclid(std::f64::consts::TAU);
    let whole = swept < WHOLE_TURN || std::f64::consts::TAU - swept < WHOLE_TURN;
    let to = from + if whole { std::f64::consts::TAU } else { swept };
    Ok((Bezier::ellipse(centre.xy(), (a, b), (from, to)), vec![centre.z, centre.z + major.z]))
}
