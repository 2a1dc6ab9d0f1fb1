//! A smooth curve as a cubic spline, within a tolerance of distance, heading and curvature, with few spans.
//!
//! # How many
//!
//! Measured along the normal, a spline S that runs along a curve C with nearly equal length deviates from it by e(s) with
//! e⁗ = −f, f = κ'' − κ³ the part of C⁗ along the normal; e is twice continuously differentiable, and e''' jumps at the knots.
//! Where f is constant the best such e repeats itself: a Bernoulli polynomial, e = f h⁴/24 (x⁴ − 2x³ + x² − 1/32) over a span of
//! length h, whose
//!
//! ```text
//! distance e  is at most f h⁴/768,   heading e' at most f h³ √3/216,   curvature e'' at most f h²/12 (at the knots)
//! ```
//!
//! so that the density of spans is the largest of (f/(768 tol))^¼, (f √3/(216 ε))^⅓ and (f/(12 δκ))^½, each with its own local
//! tolerance (`nodes`). At an end whose point and tangent are kept e = f h⁴/24 x²(1 − x)², twice as far.
//!
//! # The method
//!
//! The curve is sampled once. For a number of spans knots are laid at equal shares of the density, and the control points found
//! by least squares of the distances from the nodes, along the normals, each over its allowed value; the places on the spline that
//! the nodes project to are then found again, and so on (`squares`). Where the errors are larger than elsewhere the spans become shorter.
//! Along the curve the control points are nearly free, which gives fewer spans than the count above: a spline need not run by the length.
//!
//! The first number of spans with which every tolerance is kept is taken, and certified between the nodes (`measure`).

mod measure;
mod nodes;
mod runs;
mod spline;
mod squares;

pub use super::arcs::FitError;
pub use runs::{CurveRun, runs};
pub use spline::CubicBSpline;

use super::{ChainTolerance, CurvePoint};
use nodes::{SampledPiece, sample};

/// Rounds of placing the knots, and of projecting the nodes to the spline in each.
const KNOT_ROUNDS: u32 = 8;
/// After this many rounds without improvement the search ends.
const PATIENCE: u32 = 3;
/// Exponent with which the knots react to a misfit in a round.
const DAMPING: f64 = 0.7;
/// Share of every allowed error that may be used at the nodes; the rest is for errors between them.
const SEEN: f64 = 0.99;
/// Where the search for the number of spans begins, over the number by theory.
const FIRST_SHARE: f64 = 0.5;
/// Up to this many spans no number is skipped.
const FEW: f64 = 16.0;
/// Most spans that are tried, over the number by theory.
const MOST_TIMES: f64 = 3.0;
const MOST_MORE: f64 = 40.0;

/// A fitted piece.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedSpline {
    /// The spline, from the start of the curve to its end, tangent to it there.
    pub spline: CubicBSpline,
    /// Largest distance of any point of the one from the other, in both directions, with a bound for the places between those
    /// that were checked.
    pub deviation: f64,
    /// Largest angle between the tangents, rad, with such a bound.
    pub heading: f64,
    /// Largest difference of the curvatures, over the unit of the curve, with such a bound.
    pub curvature: f64,
    /// The number of spans by theory, see the module.
    pub by_theory: f64,
}

/// Fits the piece of `curve` over `range`, of growing parameters, as one spline.
///
/// It starts and ends where the curve does, with its tangents; is nowhere farther from it than `tolerance`, in the unit of the
/// curve, nor the curve from it; and nowhere exceeds the errors that `allowed` gives, for a parameter and the point there, in
/// heading (rad) and curvature (over the unit).
///
/// # Errors
/// [`FitError`] when the curve is not smooth or the tolerances cannot be kept.
pub fn fit(
    curve: impl Fn(f64) -> CurvePoint,
    range: (f64, f64),
    tolerance: f64,
    allowed: &dyn Fn(f64, &CurvePoint) -> ChainTolerance,
) -> Result<FittedSpline, FitError> {
    let samples = sample(&curve, range, tolerance, allowed)?;
    let size = samples.nodes.iter().map(|node| node.frame.point.norm()).fold(0.0, f64::max);
    let too_fine = FitError::ToleranceTooFine { tolerance };
    if !(tolerance > 64.0 * f64::EPSILON * size) {
        return Err(too_fine);
    }
    let most = MOST_TIMES * samples.spans + MOST_MORE;
    let mut seen = SEEN;
    let mut spans = (FIRST_SHARE * samples.spans).floor().max(1.0);
    while spans <= most {
        let found = best(&samples, spans, tolerance);
        if let Some(trial) = found.as_ref().filter(|trial| trial.worst <= seen) {
            let certified =
                measure::certify(&curve, &samples.nodes, &trial.polynomials, &trial.seen, tolerance, allowed);
            if let Some(worst) = certified {
                if worst.share <= 1.0 {
                    return Ok(FittedSpline {
                        spline: trial.spline.clone(),
                        deviation: worst.distance,
                        heading: worst.heading,
                        curvature: worst.curvature,
                        by_theory: samples.spans,
                    });
                }
                seen = (seen * (1.0 / worst.share).clamp(0.5, 0.999)).max(0.5 * SEEN);
            }
        }
        // One by one where one matters, otherwise as many as the misfits require, but no large step near the end.
        let wanted = found.map_or(spans * 1.25, |trial| trial.wanted);
        let next = if spans < FEW { spans } else { (spans + 0.5 * (wanted - spans)).floor() };
        spans = next.max(spans + 1.0);
    }
    Err(too_fine)
}

/// The best spline with this many spans.
fn best(samples: &SampledPiece, spans: f64, tolerance: f64) -> Option<squares::SplineTrial> {
    let mut densities: Vec<f64> = samples.nodes.iter().map(|node| node.density).collect();
    let mut found: Option<squares::SplineTrial> = None;
    let mut since = 0;
    for _ in 0..KNOT_ROUNDS {
        let knots = squares::knots(&samples.nodes, &densities, spans);
        let Some(trial) = squares::solve(&samples.nodes, &knots, tolerance) else { break };
        squares::shift(&mut densities, &trial, DAMPING);
        if found.as_ref().is_none_or(|best| trial.worst < best.worst) {
            since = 0;
            found = Some(trial);
        } else {
            since += 1;
        }
        if found.as_ref().is_some_and(|best| best.worst <= SEEN) || since >= PATIENCE {
            break;
        }
    }
    found
}

#[cfg(test)]
mod tests;
