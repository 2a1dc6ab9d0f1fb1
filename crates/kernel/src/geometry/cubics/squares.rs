//! The control points of a spline on given knots by least squares of its distances from the nodes.

use super::measure::difference;
use super::nodes::{CURVATURE, DISTANCE, HEADING, SplineNode};
use super::spline::{CubicBSpline, ORDER, SpanBasis, SplineSpan, hit};
use crate::numeric::banded::BandedMatrix;
use crate::numeric::extremum::larger;
use nalgebra::Vector2;

/// How often the nodes are projected to the spline again.
const ROUNDS: u32 = 4;
/// Weight of the distances along the curve relative to those along the normals, after the first round.
const ALONG: f64 = 0.02;
/// Least distance between knots, over an even share.
const LEAST_SPAN: f64 = 1e-3;

/// A spline with its errors at the nodes.
#[derive(Debug, Clone)]
pub(super) struct SplineTrial {
    pub(super) spline: CubicBSpline,
    pub(super) polynomials: Vec<SplineSpan>,
    /// Parameter of the spline where the normal of each node meets it.
    pub(super) seen: Vec<f64>,
    /// Largest used share of an allowed error, at the nodes.
    pub(super) worst: f64,
    /// By which factor each node requires more spans.
    required: Vec<f64>,
    /// How many spans are required together.
    pub(super) wanted: f64,
}

/// Knots at equal shares of the densities, for this many spans.
pub(super) fn knots(nodes: &[SplineNode], densities: &[f64], spans: f64) -> Vec<f64> {
    let end = nodes.last().map_or(0.0, |node| node.length);
    let cells = nodes.iter().zip(nodes.iter().skip(1)).zip(densities);
    let total: f64 = cells.clone().map(|((a, b), density)| density * (b.length - a.length)).sum();
    // Where no spans are required, knots are placed evenly.
    let floor = LEAST_SPAN * total.max(1.0) / end;
    let whole = total + floor * end;
    let mut knots = vec![0.0; ORDER];
    let (mut share, mut next) = (0.0, 1.0);
    for ((a, b), density) in cells {
        let own = (density + floor) * (b.length - a.length);
        while next < spans && next * whole / spans <= share + own {
            let part = (next * whole / spans - share) / own;
            knots.push(a.length + part * (b.length - a.length));
            next += 1.0;
        }
        share += own;
    }
    knots.extend([end; ORDER]);
    knots
}

/// Adjusts the densities to the requirements of the nodes of a trial.
pub(super) fn shift(densities: &mut [f64], trial: &SplineTrial, damping: f64) {
    // For each span, the largest requirement in it.
    let mut index = 0;
    let mut most = vec![0.0_f64; trial.polynomials.len()];
    let mut owners = Vec::with_capacity(trial.seen.len());
    for (seen, required) in trial.seen.iter().zip(&trial.required) {
        while trial.polynomials.get(index).is_some_and(|span| *seen > span.to) && index + 1 < most.len() {
            index += 1;
        }
        if let Some(entry) = most.get_mut(index) {
            *entry = entry.max(*required);
        }
        owners.push(index);
    }
    for (density, owner) in densities.iter_mut().zip(owners) {
        let required = most.get(owner).copied().unwrap_or(1.0).clamp(0.3, 3.0);
        *density *= libm::pow(required, damping);
    }
}

/// The freedom of a control point: it is `base` + `ways` · x.
#[derive(Debug, Clone, Copy)]
struct ControlFreedom {
    base: Vector2<f64>,
    ways: [Vector2<f64>; 2],
}

/// Control points along the curve, with their freedoms: the ends are fixed, and their neighbours move along the end tangents.
fn free(nodes: &[SplineNode], knots: &[f64]) -> Option<Vec<ControlFreedom>> {
    let (first, last) = (nodes.first()?, nodes.last()?);
    let (start, end) = (first.frame, last.frame);
    let count = knots.len() - ORDER;
    let still = Vector2::zeros();
    let controls = (0..count).map(|index| {
        let place = knots.iter().skip(index + 1).take(ORDER - 1).sum::<f64>() / 3.0;
        let (base, ways) = if index == 0 {
            (start.point, [still, still])
        } else if index + 1 == count {
            (end.point, [still, still])
        } else if index == 1 {
            (start.point + start.tangent * place, [start.tangent, still])
        } else if index + 2 == count {
            (end.point - end.tangent * (last.length - place), [end.tangent, still])
        } else {
            (near(nodes, place)?, [Vector2::x(), Vector2::y()])
        };
        Some(ControlFreedom { base, ways })
    });
    controls.collect()
}

/// The spline on these knots; `None` when no spline runs forwards.
pub(super) fn solve(nodes: &[SplineNode], knots: &[f64], tolerance: f64) -> Option<SplineTrial> {
    let mut controls = free(nodes, knots)?;
    let mut seen: Vec<f64> = nodes.iter().map(|node| node.length).collect();
    for round in 0..ROUNDS {
        let along = if round == 0 { 1.0 } else { ALONG };
        step(nodes, knots, &seen, &mut controls, along, tolerance);
        look(nodes, &spline_of(knots, &controls).polynomials(), &mut seen)?;
    }
    let (start, end) = (nodes.first()?.frame.tangent, nodes.last()?.frame.tangent);
    let [first, second, .., before, last] = controls.as_slice() else { return None };
    let forwards = (second.base - first.base).dot(&start) > 0.0 && (last.base - before.base).dot(&end) > 0.0;
    forwards.then(|| judged(nodes, spline_of(knots, &controls), seen, tolerance))?
}

fn spline_of(knots: &[f64], controls: &[ControlFreedom]) -> CubicBSpline {
    CubicBSpline { knots: knots.to_vec(), controls: controls.iter().map(|control| control.base).collect() }
}

/// The errors of a spline at the nodes; `None` where one is not a number.
fn judged(nodes: &[SplineNode], spline: CubicBSpline, seen: Vec<f64>, tolerance: f64) -> Option<SplineTrial> {
    let polynomials = spline.polynomials();
    let (mut worst, mut required) = (0.0_f64, Vec::with_capacity(nodes.len()));
    let (mut index, mut wanted, mut most) = (0, 0.0, 0.0_f64);
    for (node, parameter) in nodes.iter().zip(&seen) {
        let before = index;
        let span = span_at(&polynomials, &mut index, *parameter)?;
        let off = difference(&node.frame, &span.derivatives_at(*parameter))?;
        let shares = [
            off.distance.abs() / tolerance,
            off.heading.abs() / node.allowed.heading,
            off.curvature.abs() / node.allowed.curvature,
        ];
        let [distance, heading, curvature] = shares;
        worst = shares.into_iter().fold(worst, larger);
        let own = distance.sqrt().sqrt().max(libm::cbrt(heading)).max(curvature.sqrt());
        if index != before {
            wanted += most;
            most = 0.0;
        }
        most = most.max(own);
        required.push(own);
    }
    let wanted = wanted + most;
    worst.is_finite().then_some(SplineTrial { spline, polynomials, seen, worst, required, wanted })
}

/// The curve at a length, approximately.
fn near(nodes: &[SplineNode], length: f64) -> Option<Vector2<f64>> {
    let next = nodes.partition_point(|node| node.length < length).clamp(1, nodes.len() - 1);
    let (a, b) = (nodes.get(next - 1)?, nodes.get(next)?);
    let part = (length - a.length) / (b.length - a.length);
    Some(a.frame.point + (b.frame.point - a.frame.point) * part)
}

/// The span of a parameter, searched from the previous one on.
pub(super) fn span_at<'a>(polynomials: &'a [SplineSpan], index: &mut usize, parameter: f64) -> Option<&'a SplineSpan> {
    while *index + 1 < polynomials.len() && polynomials.get(*index).is_some_and(|span| parameter > span.to) {
        *index += 1;
    }
    polynomials.get(*index)
}

/// Moves the control points to the least sum of squares, for the present places of the nodes.
fn step(
    nodes: &[SplineNode],
    knots: &[f64],
    seen: &[f64],
    controls: &mut [ControlFreedom],
    along: f64,
    tolerance: f64,
) {
    let size = 2 * controls.len();
    let mut matrix = BandedMatrix::<8>::zero(size);
    let mut right = vec![0.0; size];
    let spans = controls.len() + 1 - ORDER;
    let mut span = 0;
    for (node, parameter) in nodes.iter().zip(seen) {
        while span + 1 < spans && knots.get(span + ORDER).is_some_and(|knot| parameter > knot) {
            span += 1;
        }
        let basis = SpanBasis::new(knots, span, *parameter).derivatives[0];
        let bearing: Vec<(usize, f64, ControlFreedom)> = controls
            .iter()
            .enumerate()
            .skip(span)
            .zip(basis)
            .map(|((index, control), basis)| (index, basis, *control))
            .collect();
        let point: Vector2<f64> = bearing.iter().map(|(_, basis, control)| control.base * *basis).sum();
        let off = point - node.frame.point;
        let weight = weight(node, tolerance);
        for (direction, weight) in [(node.frame.outward(), weight), (node.frame.tangent, along * weight)] {
            let mut row = [0.0; 2 * ORDER];
            for (entries, (_, basis, control)) in row.chunks_mut(2).zip(&bearing) {
                for (entry, column) in entries.iter_mut().zip(&control.ways) {
                    *entry = weight * basis * direction.dot(column);
                }
            }
            let rest = weight * off.dot(&direction);
            for (i, a) in row.iter().enumerate() {
                if *a == 0.0 {
                    continue;
                }
                if let Some(value) = right.get_mut(2 * span + i) {
                    *value -= a * rest;
                }
                for (j, b) in row.iter().enumerate().skip(i) {
                    matrix.add(2 * span + i, 2 * span + j, a * b);
                }
            }
        }
    }
    move_controls(matrix, right, controls);
}

/// Solves the normal equations and moves the control points by the solution.
fn move_controls(mut matrix: BandedMatrix<8>, mut right: Vec<f64>, controls: &mut [ControlFreedom]) {
    // Fixed control points stay.
    for (index, control) in controls.iter().enumerate() {
        for (side, column) in control.ways.iter().enumerate() {
            if *column == Vector2::zeros() {
                matrix.add(2 * index + side, 2 * index + side, 1.0);
            }
        }
    }
    matrix.factored().solve(&mut right);
    for (control, moved) in controls.iter_mut().zip(right.chunks(2)) {
        for (column, share) in control.ways.iter().zip(moved) {
            control.base += column * *share;
        }
    }
}

/// One over the distance that is expected where every tolerance is kept.
fn weight(node: &SplineNode, tolerance: f64) -> f64 {
    let width = 1.0 / node.density;
    let by_heading = HEADING / DISTANCE * node.allowed.heading * width;
    let by_curvature = CURVATURE / DISTANCE * node.allowed.curvature * width * width;
    // A straight stretch has spans of any length.
    let expected = tolerance.min(by_heading).min(by_curvature);
    1.0 / if expected > 0.0 { expected } else { tolerance }
}

/// Finds the places of the spline on the normals of the nodes; `None` when it turns back.
fn look(nodes: &[SplineNode], polynomials: &[SplineSpan], seen: &mut [f64]) -> Option<()> {
    let (first, last) = (polynomials.first()?.from, polynomials.last()?.to);
    let count = nodes.len();
    let mut before = first;
    for (index, (node, parameter)) in nodes.iter().zip(seen.iter_mut()).enumerate() {
        if index == 0 || index + 1 == count {
            *parameter = if index == 0 { first } else { last };
            continue;
        }
        *parameter = hit(polynomials, node.frame.point, node.frame.tangent, *parameter)?;
        if !(*parameter >= before) {
            return None;
        }
        before = *parameter;
    }
    (before <= last).then_some(())
}
