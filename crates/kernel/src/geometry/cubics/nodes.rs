//! A piece of curve sampled once, with a fixed number of nodes per span, and the required density of spans at each.

use super::FitError;
use crate::geometry::{ChainTolerance, CurvePoint};

/// Nodes per span, and the least number in a piece.
const NODES_PER_SPAN: f64 = 16.0;
const LEAST_NODES: f64 = 48.0;
/// Share of the nodes that is spread evenly over the piece, so that straight stretches have nodes.
const EVEN_SHARE: f64 = 0.1;
/// Cells in which the density is integrated first, the required agreement of its sums, and how often cells are divided again.
const FIRST_CELLS: u32 = 96;
const AGREEMENT: f64 = 0.02;
const MOST_ROUNDS: u32 = 5;
/// Most nodes, to limit memory.
const MOST_NODES: f64 = 2e6;
/// For e⁗ = 1 over spans of length 1: largest distance 1/768, heading √3/216 and second derivative 1/12, see the module.
pub(super) const DISTANCE: f64 = 768.0;
pub(super) const HEADING: f64 = 124.707_658_144_958_9;
pub(super) const CURVATURE: f64 = 12.0;

/// A place where the curve was sampled.
#[derive(Debug, Clone, Copy)]
pub(super) struct SplineNode {
    pub(super) frame: CurvePoint,
    pub(super) parameter: f64,
    pub(super) allowed: ChainTolerance,
    /// Length of the curve up to here.
    pub(super) length: f64,
    /// Spans per length of the curve up to the next node.
    pub(super) density: f64,
}

/// A sampled piece.
#[derive(Debug, Clone)]
pub(super) struct SampledPiece {
    pub(super) nodes: Vec<SplineNode>,
    /// Number of spans to first order.
    pub(super) spans: f64,
}

/// Samples the curve.
pub(super) fn sample(
    curve: &impl Fn(f64) -> CurvePoint,
    range: (f64, f64),
    tolerance: f64,
    allowed: &dyn Fn(f64, &CurvePoint) -> ChainTolerance,
) -> Result<SampledPiece, FitError> {
    let step = (range.1 - range.0) / f64::from(FIRST_CELLS);
    let inner = (1..FIRST_CELLS).map(|cell| range.0 + step * f64::from(cell));
    let mut parameters: Vec<f64> = std::iter::once(range.0).chain(inner).chain([range.1]).collect();
    let mut before = f64::NAN;
    let mut round = 0;
    loop {
        let samples = nodes_at(curve, &parameters, tolerance, allowed)?;
        round += 1;
        if round > 1 && ((samples.spans - before).abs() <= AGREEMENT * (1.0 + samples.spans) || round >= MOST_ROUNDS) {
            return Ok(samples);
        }
        before = samples.spans;
        parameters = samples.next(range).ok_or(FitError::ToleranceTooFine { tolerance })?;
    }
}

/// The nodes at these parameters.
fn nodes_at(
    curve: &impl Fn(f64) -> CurvePoint,
    parameters: &[f64],
    tolerance: f64,
    allowed: &dyn Fn(f64, &CurvePoint) -> ChainTolerance,
) -> Result<SampledPiece, FitError> {
    let mut nodes: Vec<SplineNode> = Vec::with_capacity(parameters.len());
    let mut spans = 0.0;
    for &parameter in parameters {
        let frame = curve(parameter);
        // Written so that a NaN is refused too.
        let finite = [frame.point.x, frame.point.y, frame.curvature, frame.curvature_slope];
        if !(frame.speed > 0.0 && finite.iter().all(|value| value.is_finite())) {
            return Err(FitError::NotSmooth { parameter });
        }
        let mut node = SplineNode { frame, parameter, allowed: allowed(parameter, &frame), length: 0.0, density: 0.0 };
        if let Some(last) = nodes.last_mut() {
            let own = length(&last.frame, &frame);
            node.length = last.length + own;
            last.density = density(last, &node, own, tolerance);
            spans += own * last.density;
        }
        nodes.push(node);
    }
    Ok(SampledPiece { nodes, spans })
}

/// Length of the curve between two near points: the chord, plus the excess of an arc of their mean curvature.
fn length(a: &CurvePoint, b: &CurvePoint) -> f64 {
    let chord = (b.point - a.point).norm();
    let turn = 0.5 * (a.curvature + b.curvature) * chord;
    chord * (1.0 + turn * turn / 24.0)
}

/// Spans per length between two nodes. The part of the fourth derivative along the normal, by the length, is κ'' − κ³; the mean
/// of κ'' is the change of κ' over the length.
fn density(a: &SplineNode, b: &SplineNode, length: f64, tolerance: f64) -> f64 {
    let curvature = 0.5 * (a.frame.curvature + b.frame.curvature);
    let fourth = ((b.frame.curvature_slope - a.frame.curvature_slope) / length - curvature.powi(3)).abs();
    if !fourth.is_finite() {
        return 0.0;
    }
    let (heading, bend) = (a.allowed.heading.min(b.allowed.heading), a.allowed.curvature.min(b.allowed.curvature));
    let by_distance = (fourth / (DISTANCE * tolerance)).sqrt().sqrt();
    let by_heading = libm::cbrt(fourth / (HEADING * heading));
    let by_curvature = (fourth / (CURVATURE * bend)).sqrt();
    by_distance.max(by_heading).max(by_curvature)
}

impl SampledPiece {
    /// Parameters of nodes of equal share, some of them spread evenly; `None` when they are too many.
    fn next(&self, range: (f64, f64)) -> Option<Vec<f64>> {
        let count = (NODES_PER_SPAN * self.spans).ceil() + LEAST_NODES;
        if !(count <= MOST_NODES) {
            return None;
        }
        let even = if self.spans > 0.0 { EVEN_SHARE } else { 1.0 };
        let whole = self.nodes.last()?.length;
        let mut parameters = vec![range.0];
        let (mut share, mut next) = (0.0, 1.0);
        for (a, b) in self.nodes.iter().zip(self.nodes.iter().skip(1)) {
            let own = b.length - a.length;
            let dense = (1.0 - even) * own * a.density / self.spans.max(f64::MIN_POSITIVE) + even * own / whole;
            while next < count && next / count <= share + dense {
                let part = (next / count - share) / dense;
                parameters.push(a.parameter + part * (b.parameter - a.parameter));
                next += 1.0;
            }
            share += dense;
        }
        parameters.push(range.1);
        parameters.dedup();
        Some(parameters)
    }
}
