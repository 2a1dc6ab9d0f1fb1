//! The centre of a measured cam: that about which its dwells are circles.

use super::positions::Positions;
use camgen_kernel::motion::Quantity;
use camgen_kernel::numeric::scatter::median;
use camgen_kernel::refusal::Refusal;
use nalgebra::{DMatrix, DVector, Vector2};
use std::f64::consts::TAU;

/// Windows all round in which an arc is looked for, and their width as a share of the points.
const WINDOWS: usize = 72;
const WIDTH: usize = 16;
/// An arc leaves no more than so much noise, and at least this, mm.
const OF_NOISE: f64 = 3.0;
const LEAST: f64 = 1e-3;
/// Least share of the turn that is a dwell.
const LEAST_DWELL: f64 = 30.0 / 360.0;
/// Steps of the fit of all dwells.
const STEPS: usize = 12;

/// The centre, mm.
pub(super) fn centre(points: &[Vector2<f64>]) -> Result<Vector2<f64>, Refusal> {
    #[expect(clippy::cast_precision_loss, reason = "few points")]
    let middle = points.iter().sum::<Vector2<f64>>() / points.len().max(1) as f64;
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| polar(a - middle).total_cmp(&polar(b - middle)));
    let noise = about(&sorted, middle).noise();
    let band = (OF_NOISE * noise).max(LEAST);
    let best = candidates(&sorted, band).into_iter().map(|centre| (dwelling(&sorted, centre, band), centre));
    let best = best.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(share, _)| *share >= LEAST_DWELL);
    let Some((_, mut found)) = best else {
        let what = "no part of the points is an arc about a common centre: the cam has no dwell from which its shaft could be found";
        return Err(Refusal::new(what).remedy("measure about the shaft and give --fit angle, or --fit none"));
    };
    for _ in 0..STEPS {
        let step = step(&sorted, found, band);
        found += step;
        if step.norm() < 1e-9 {
            break;
        }
    }
    Ok(found)
}

fn polar(point: Vector2<f64>) -> f64 {
    libm::atan2(point.y, point.x).rem_euclid(TAU)
}

/// Radii by the polar angle about a centre.
fn about(points: &[Vector2<f64>], centre: Vector2<f64>) -> Positions {
    let mut all: Vec<(f64, f64, usize)> =
        points.iter().enumerate().map(|(row, point)| (polar(point - centre), (point - centre).norm(), row)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.dedup_by(|a, b| a.0 <= b.0);
    Positions {
        quantity: Quantity::Length,
        fill: TAU,
        angles: all.iter().map(|found| found.0).collect(),
        values: all.iter().map(|found| found.1).collect(),
        by_shift: Vec::new(),
        rows: all.iter().map(|found| found.2).collect(),
    }
}

/// Centres of arcs through windows of the points that are arcs.
fn candidates(points: &[Vector2<f64>], band: f64) -> Vec<Vector2<f64>> {
    let count = points.len();
    let width = (count / WIDTH).max(6);
    let window = |first: usize| (0..width).filter_map(move |by| points.get((first + by) % count.max(1)).copied());
    let starts = (0..WINDOWS).map(|window| window * count / WINDOWS);
    let of = |first: usize| {
        let (centre, radius) = circle(window(first))?;
        let off = window(first).map(|point| ((point - centre).norm() - radius).abs()).fold(0.0, f64::max);
        (off <= 2.0 * band).then_some(centre)
    };
    starts.filter_map(of).collect()
}

/// The circle of least squares of x² + y² = 2ax + 2by + c through points.
fn circle(points: impl Iterator<Item = Vector2<f64>> + Clone) -> Option<(Vector2<f64>, f64)> {
    let first = points.clone().next()?;
    let (mut matrix, mut right) = (DMatrix::<f64>::zeros(3, 3), DVector::<f64>::zeros(3));
    for point in points {
        let point = point - first;
        let row = DVector::from_vec(vec![2.0 * point.x, 2.0 * point.y, 1.0]);
        right.axpy(point.norm_squared(), &row, 1.0);
        matrix.ger(1.0, &row, &row, 1.0);
    }
    let found = matrix.lu().solve(&right)?;
    let (a, b, c) = (*found.get(0)?, *found.get(1)?, *found.get(2)?);
    let radius = (c + a * a + b * b).sqrt();
    radius.is_finite().then(|| (first + Vector2::new(a, b), radius))
}

/// The dwells about a centre: first and last position of each.
fn dwells(radii: &Positions, band: f64) -> Vec<(usize, usize)> {
    let mut runs = radii.flat_runs(2.0 * band);
    let width = |run: &(usize, usize)| radii.angle(run.1) - radii.angle(run.0);
    runs.retain(|run| width(run) >= LEAST_DWELL * TAU);
    runs.sort_by(|a, b| width(b).total_cmp(&width(a)));
    let count = radii.len();
    let mut kept: Vec<(usize, usize)> = Vec::new();
    for (first, last) in runs {
        let apart = |other: &(usize, usize)| {
            let by = (other.0 + count - first) % count.max(1);
            let back = (first + count - other.0) % count.max(1);
            by > last - first && back > other.1 - other.0
        };
        if kept.iter().all(apart) {
            kept.push((first, last));
        }
    }
    kept
}

/// The share of the turn that dwells about a centre.
fn dwelling(points: &[Vector2<f64>], centre: Vector2<f64>, band: f64) -> f64 {
    let radii = about(points, centre);
    dwells(&radii, band).iter().map(|run| radii.angle(run.1) - radii.angle(run.0)).sum::<f64>() / TAU
}

/// A step of Gauss and Newton to the centre of all dwells, each with a radius of its own. The motion hides within the noise at their ends: these are
/// left out.
fn step(points: &[Vector2<f64>], centre: Vector2<f64>, band: f64) -> Vector2<f64> {
    let radii = about(points, centre);
    let runs = dwells(&radii, band);
    let size = 2 + runs.len();
    let (mut matrix, mut right) = (DMatrix::<f64>::zeros(size, size), DVector::<f64>::zeros(size));
    for (number, (first, last)) in runs.iter().enumerate() {
        let margin = (last - first) / 8;
        let mut inner: Vec<f64> = (first + margin..=last - margin).map(|at| radii.value(at)).collect();
        let level = median(&mut inner);
        for at in first + margin..=last - margin {
            let (sin, cos) = libm::sincos(radii.angle(at));
            let mut row = DVector::<f64>::zeros(size);
            for (slot, value) in [(0, -cos), (1, -sin), (2 + number, -1.0)] {
                if let Some(slot) = row.get_mut(slot) {
                    *slot = value;
                }
            }
            matrix.ger(1.0, &row, &row, 1.0);
            right.axpy(-(radii.value(at) - level), &row, 1.0);
        }
    }
    let found = matrix.lu().solve(&right);
    let at = |index: usize| {
        found.as_ref().and_then(|found| found.get(index).copied()).filter(|value| value.is_finite()).unwrap_or(0.0)
    };
    Vector2::new(at(0), at(1))
}
