//! A smooth curve as a chain of tangent arcs, within a tolerance, with few arcs.
//!
//! # The limit
//!
//! Along an arc the deviation e(s) from the curve obeys e'' = κ_arc − κ(s), so a chain of tangent arcs is, to first
//! order, a C¹ spline of second degree with free knots, and e''' = −κ' on each arc. Where κ' is constant the best such
//! chain repeats itself: e = −κ'/6 · s (s − h/2)(s − h) on each arc of length h, two equal lobes of κ'h³/(72√3). The
//! joints lie on the curve, the heading there differs from the curve's tangent by η* = −κ'h²/12. With K = 72√3 an arc may be
//! h = (K tol/|κ'|)^(1/3) long, so that the count is
//!
//! ```text
//! N* = I₃/(K tol)^(1/3),   I₃ = ∫ |dκ/ds|^(1/3) ds,   η*(s) = −sign(κ') (K tol)^(2/3) |κ'|^(1/3)/12
//! ```
//!
//! # The method
//!
//! The curve is sampled once, at nodes of equal share of I₃ (`nodes`). The number of arcs and the places of their joints
//! are known to first order, including the arcs at an exact tangent and those over an extremum of the curvature (`spacing`).
//! From there joints and headings are moved together until no node deviates by more than the tolerance (`trial`, `minimax`);
//! where that is impossible, one more arc is tried. Tangency is a condition of the same system, and is finally met to rounding.
//!
//! The distance at a node is that of the top of its lobe, as far as half way to the next node, so that the lobes are found to
//! a percent. The finished chain is checked again between the nodes, and fitted again with the places that exceed the
//! tolerance as further nodes.

mod minimax;
mod nodes;
mod spacing;
mod trial;

use crate::geometry::contour::{Edge, Segment};
use crate::geometry::{ChainTolerance, CurvePoint};
use crate::numeric::extremum::larger;
use nalgebra::Vector2;
use nodes::{CurveSample, TangentArc, sample};
use spacing::ArcSpacing;
use std::ops::RangeInclusive;

/// Share of the tolerance that the lobes may take at the nodes; the rest is for deviations between them.
const SEEN: f64 = 0.992;
/// Points per arc at which the finished chain is checked.
const CHECKS_PER_ARC: u32 = 16;
const FEWER_CHECKS: u32 = 4;
/// Most additional nodes; beyond them fewer than required are accepted.
const MANY: usize = 200;
/// Share of the tolerance that may remain undetected between two of them, twice what a lobe leaves, and how often a stretch is
/// halved at most to reach it.
const UNSEEN: f64 = 0.004;
const HALVINGS: u32 = 12;
/// How often a chain is fitted again when the check between the nodes finds more than the tolerance.
const TRIES: u32 = 12;
/// Most arcs that are tried, over the first number: far more than was ever needed.
const MOST_TIMES: u32 = 4;
const MOST_MORE: u32 = 60;
/// Share of the missing arcs, estimated from a deviation, that is added before the next try, and the largest share of all arcs: of 152
/// such leaps among 296 none was too large.
const SURE: f64 = 0.5;
const MOST_AT_ONCE: u32 = 8;
/// A tolerance of the distance this many times that of the best chain for heading and curvature has no effect.
const ROOMY: f64 = 10.0;
/// At least this many roundings of a coordinate.
const LEAST_ROOM: f64 = 1e5;
/// One arc in this many does not matter: a fifth of a percent.
const FEW: u32 = 500;
/// A piece with a smaller share may be a circle, which its headings show; a piece with a feature between them has more.
const CIRCLE: f64 = 0.1;
/// Where the number of arcs is not limited.
pub const ANY_NUMBER: RangeInclusive<u32> = 1..=u32::MAX;
/// An arc that bulges by less than this share of half its chord is a line: a straight curve is sampled with rounding.
const STRAIGHT: f64 = 1e-12;
/// Headings closer than this count as equal, rad: a circle is sampled with rounding.
const SAME_HEADING: f64 = 1e-10;

/// One joint of a chain: the arc that leaves it turns by 4 atan(bulge).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcJoint {
    /// Place.
    pub point: Vector2<f64>,
    /// Parameter of the curve there.
    pub parameter: f64,
    /// tan(sweep/4) of the arc to the next joint.
    pub bulge: f64,
}

/// A fitted piece.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcChain {
    /// Start of every arc; the last ends where the piece ends.
    pub joints: Vec<ArcJoint>,
    /// Largest distance between chain and curve, checked between the nodes, with a bound for the places between.
    pub deviation: f64,
    /// Best possible number of arcs N* for the distance; 0 for a circle.
    pub best_possible: f64,
    /// Best possible numbers of arcs for heading and curvature: ∫ (|κ'|/(12 ε))^(1/2) ds and ∫ |κ'|/(2 ε) ds; 0 where they do not matter.
    pub best_for: [f64; 2],
}

impl ArcChain {
    /// Its arcs, the last of which ends at a point.
    #[must_use]
    pub fn edges(&self, end: Vector2<f64>) -> Vec<Edge> {
        let ends = self.joints.iter().skip(1).map(|joint| joint.point).chain([end]);
        self.joints
            .iter()
            .zip(ends)
            .map(|(joint, end)| Edge::Segment(Segment { start: joint.point, end, bulge: joint.bulge }))
            .collect()
    }
}

/// A curve by its parameter, and the allowed errors of a chain in addition to the distance.
trait FitTarget {
    fn point_and_tolerance(&self, parameter: f64) -> (CurvePoint, ChainTolerance);
}

impl<F: Fn(f64) -> (CurvePoint, ChainTolerance)> FitTarget for F {
    fn point_and_tolerance(&self, parameter: f64) -> (CurvePoint, ChainTolerance) {
        self(parameter)
    }
}

/// Why a piece cannot be fitted.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The curve is not finite or turns back.
    #[error("the curve is not smooth near parameter {parameter}")]
    NotSmooth {
        /// Parameter of the place.
        parameter: f64,
    },
    /// The tolerance requires more arcs than a drawing can hold, or is below the rounding of the coordinates.
    #[error(
        "a tolerance of {tolerance} cannot be kept: it must lie between 64 times the rounding of the coordinates and 1 mm"
    )]
    ToleranceTooFine {
        /// The tolerance, in the unit of the curve.
        tolerance: f64,
    },
}

/// Fits the piece of `curve` over `range`, of growing parameters, which need not be short but must not close on itself. The
/// tolerance is in the unit of the curve.
///
/// # Errors
/// [`FitError`] when the curve is not smooth or the tolerance cannot be kept.
pub fn fit(curve: impl Fn(f64) -> CurvePoint, range: (f64, f64), tolerance: f64) -> Result<ArcChain, FitError> {
    fit_within(&|parameter| (curve(parameter), ChainTolerance::ANY), &curve, range, tolerance, ANY_NUMBER)
}

/// As [`fit`], for a curve that also gives the allowed errors in addition to the distance at a parameter. The curvature is kept at
/// the joints and the extrema of the curve's, between which it is monotonic, the heading at the joints: between two the error of the
/// distance is a cubic, whose slope is largest at its ends. Chains whose number of arcs lies in a range are tried, from the least that
/// may suffice.
///
/// # Errors
/// As [`fit`], and where no chain with such a number is found.
pub fn fit_with_tolerances(
    curve: impl Fn(f64) -> (CurvePoint, ChainTolerance),
    range: (f64, f64),
    tolerance: f64,
    numbers: RangeInclusive<u32>,
) -> Result<ArcChain, FitError> {
    fit_within(&curve, &|parameter| curve(parameter).0, range, tolerance, numbers)
}

fn fit_within(
    target: &impl FitTarget,
    curve: &impl Fn(f64) -> CurvePoint,
    range: (f64, f64),
    tolerance: f64,
    numbers: RangeInclusive<u32>,
) -> Result<ArcChain, FitError> {
    let (start, end) = (curve(range.0), curve(range.1));
    let size = start.point.norm().max(end.point.norm());
    if !(tolerance > 64.0 * f64::EPSILON * size) {
        return Err(FitError::ToleranceTooFine { tolerance });
    }
    let mut seen = SEEN * tolerance;
    let mut missed = Vec::new();
    for _ in 0..TRIES {
        let (mut nodes, counts) = sample(target, range, tolerance, seen)?;
        let limited = nodes.iter().any(|node| node.allowed != ChainTolerance::ANY);
        if counts.all < CIRCLE
            && let Some(chain) = one_arc(curve, range, tolerance)
        {
            return Ok(chain);
        }
        nodes::insert(&mut nodes, target, &missed, seen);
        // Where heading or curvature require shorter arcs, these miss the curve by less; a tolerance far above that would only
        // make the numbers of the method differ in size.
        let within = if limited {
            let farthest = nodes::farthest_lobe(&nodes);
            seen.min((ROOMY * farthest).max(LEAST_ROOM * f64::EPSILON * size))
        } else {
            seen
        };
        let Some(joints) = fewest(target, &nodes, within, &numbers) else {
            return Err(FitError::ToleranceTooFine { tolerance });
        };
        // Arcs that are shorter than the distance requires have small deviations, which need less effort.
        let checks = if limited { FEWER_CHECKS } else { CHECKS_PER_ARC };
        let (deviation, mut beyond) = check(curve, &joints, (range.1, end.point), tolerance, checks);
        if deviation <= tolerance {
            let best_for = [counts.heading, counts.curvature];
            return Ok(ArcChain { joints: straightened(joints), deviation, best_possible: counts.distance, best_for });
        }
        if beyond.is_empty() || missed.len() > MANY {
            seen *= (tolerance / deviation).clamp(0.5, 0.995);
        }
        missed.append(&mut beyond);
    }
    Err(FitError::ToleranceTooFine { tolerance })
}

/// The first chain that the minimax finds, starting from the least of the numbers of arcs that may be sufficient.
fn fewest(
    target: &impl FitTarget,
    nodes: &[CurveSample],
    seen: f64,
    numbers: &RangeInclusive<u32>,
) -> Option<Vec<ArcJoint>> {
    let mut spacing = ArcSpacing::new(nodes);
    let first = spacing.arcs();
    let most = (MOST_TIMES * first + MOST_MORE).min(*numbers.end());
    while spacing.arcs() < *numbers.start() {
        spacing.add_arc();
    }
    while spacing.arcs() <= most {
        let least = match minimax::relax(target, nodes, seen, spacing.places(nodes)) {
            Ok(joints) => return Some(joints),
            Err(least) => least,
        };
        // One by one where a chain must be near, faster where one among thousands does not matter or the curve differs from
        // the assumptions of the spacing.
        let arcs = spacing.arcs();
        for _ in 0..(1 + arcs / FEW + (arcs - first) / 8).max(missing(arcs, least)) {
            spacing.add_arc();
        }
    }
    None
}

/// The least number of additional arcs, where the present number leaves a deviation, in tolerances, that falls at most with the third
/// power of the number.
fn missing(arcs: u32, deviation: f64) -> u32 {
    let wanted = SURE * f64::from(arcs) * (libm::cbrt(deviation) - 1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "limited to a share of the arcs")]
    let more = wanted.clamp(0.0, f64::from(arcs / MOST_AT_ONCE)) as u32;
    more
}

/// The piece as one arc, when it is a circle to rounding.
fn one_arc(curve: &impl Fn(f64) -> CurvePoint, range: (f64, f64), tolerance: f64) -> Option<ArcChain> {
    let (start, end) = (curve(range.0), curve(range.1));
    let (arc, heading) = TangentArc::to(start.point, start.tangent, end.point)?;
    if (heading - end.tangent).norm() > SAME_HEADING {
        return None;
    }
    let joints = vec![ArcJoint { point: start.point, parameter: range.0, bulge: arc.bulge }];
    let (deviation, _) = check(curve, &joints, (range.1, end.point), tolerance, CHECKS_PER_ARC);
    let chain = ArcChain { joints: straightened(joints), deviation, best_possible: 0.0, best_for: [0.0; 2] };
    (deviation <= tolerance).then_some(chain)
}

/// The joints with lines in place of arcs that bulge by rounding.
fn straightened(mut joints: Vec<ArcJoint>) -> Vec<ArcJoint> {
    for joint in joints.iter_mut().filter(|joint| joint.bulge.abs() < STRAIGHT) {
        joint.bulge = 0.0;
    }
    joints
}

/// Largest distance between the chain and the curve, and the parameters where it exceeds the tolerance.
///
/// Each arc, as given by its two points and its bulge, is compared with its stretch of the curve at
/// this many points plus one. Between two of them the distance cannot exceed the larger by more than
/// Δs²/8 · |κ_arc − κ|, the bound of linear interpolation, κ taken at the points. Where that may exceed the largest distance
/// found elsewhere and is not small against the tolerance the stretch is halved. A NaN anywhere is the result.
fn check(
    curve: &impl Fn(f64) -> CurvePoint,
    joints: &[ArcJoint],
    end: (f64, Vector2<f64>),
    tolerance: f64,
    checks: u32,
) -> (f64, Vec<f64>) {
    let mut beyond = Vec::new();
    let mut compared = |arc: &TangentArc, place: f64, frame: &CurvePoint| {
        let distance = arc.distance(frame.point).abs();
        if distance > tolerance {
            beyond.push(place);
        }
        ArcComparison {
            place,
            distance,
            bend: frame.speed * frame.speed / 8.0 * (arc.curvature - frame.curvature).abs(),
        }
    };
    let ends = joints.iter().skip(1).map(|joint| (joint.parameter, joint.point)).chain([end]);
    let mut looks = Vec::with_capacity(joints.len());
    let mut worst = 0.0;
    // A joint belongs to both arcs.
    let mut first = joints.first().map(|joint| curve(joint.parameter));
    for (joint, (parameter, point)) in joints.iter().zip(ends) {
        let arc = arc_of(joint, point);
        let step = (parameter - joint.parameter) / f64::from(checks);
        let last = curve(parameter);
        let mut along = Vec::with_capacity(checks as usize + 1);
        along.extend(first.map(|frame| compared(&arc, joint.parameter, &frame)));
        for check in 1..checks {
            let place = joint.parameter + step * f64::from(check);
            along.push(compared(&arc, place, &curve(place)));
        }
        along.push(compared(&arc, parameter, &last));
        first = Some(last);
        worst = along.iter().map(|checked| checked.distance).fold(worst, larger);
        looks.push((arc, along));
    }
    for (arc, along) in &looks {
        for (before, after) in along.iter().zip(along.iter().skip(1)) {
            let found =
                between(&mut |place| compared(arc, place, &curve(place)), *before, *after, tolerance, worst, HALVINGS);
            worst = larger(worst, found);
        }
    }
    (worst, beyond)
}

/// The arc from a joint to a point, with its bulge.
fn arc_of(joint: &ArcJoint, end: Vector2<f64>) -> TangentArc {
    let segment = Segment { start: joint.point, end, bulge: joint.bulge };
    let curvature = if joint.bulge == 0.0 { 0.0 } else { 1.0 / segment.radius() };
    TangentArc { start: joint.point, heading: segment.start_tangent(), curvature, bulge: joint.bulge }
}

/// A point of the curve that was compared with an arc.
#[derive(Clone, Copy)]
struct ArcComparison {
    place: f64,
    distance: f64,
    /// |κ_arc − κ| ℓ²/8: times the square of a step of the parameter it bounds the undetected deviation.
    bend: f64,
}

/// Largest distance between two points, with the bound for the places between; not refined where it is less than what is known.
fn between(
    at: &mut impl FnMut(f64) -> ArcComparison,
    a: ArcComparison,
    b: ArcComparison,
    tolerance: f64,
    known: f64,
    halvings: u32,
) -> f64 {
    let step = b.place - a.place;
    let unseen = step * step * larger(a.bend, b.bend);
    let seen = larger(a.distance, b.distance);
    // A distance beyond the tolerance already need not be refined. Written so that a NaN is not refined either.
    let refined = seen + unseen > known && unseen > UNSEEN * tolerance && seen <= tolerance;
    if !refined || halvings == 0 {
        return seen + unseen;
    }
    let middle = at(a.place + 0.5 * step);
    let first = between(at, a, middle, tolerance, known, halvings - 1);
    larger(first, between(at, middle, b, tolerance, larger(known, first), halvings - 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// An ellipse by its parameter: κ' changes sign at the ends of the axes.
    fn ellipse(a: f64, b: f64) -> impl Fn(f64) -> CurvePoint {
        move |t| {
            let (sin, cos) = libm::sincos(t);
            CurvePoint::from_derivatives(
                Vector2::new(a * cos, b * sin),
                Vector2::new(-a * sin, b * cos),
                Vector2::new(-a * cos, -b * sin),
                Vector2::new(a * sin, -b * cos),
            )
        }
    }

    fn contour(chain: &ArcChain, end: Vector2<f64>) -> Vec<Segment> {
        let ends = chain.joints.iter().skip(1).map(|joint| joint.point).chain([end]);
        chain.joints.iter().zip(ends).map(|(j, end)| Segment { start: j.point, end, bulge: j.bulge }).collect()
    }

    /// N* of a quarter ellipse against its integral by an independent rule, and the count against N*, over six
    /// decades of the tolerance. An exact tangent at either end costs a third of an arc each.
    #[test]
    fn the_count_stays_near_the_limit() {
        let curve = ellipse(60.0, 40.0);
        for decade in -6..=-1 {
            let tolerance = libm::pow(10.0, f64::from(decade));
            for range in [(0.0, FRAC_PI_2), (0.3, 2.0), (0.0, PI)] {
                let chain = fit(&curve, range, tolerance).expect("a chain");
                let integral = crate::numeric::quadrature::integrate(
                    |t| {
                        let frame = curve(t);
                        libm::cbrt(frame.curvature_slope.abs()) * frame.speed
                    },
                    range,
                    2000,
                );
                let limit = integral / libm::cbrt(72.0 * 3.0_f64.sqrt() * tolerance);
                assert!((chain.best_possible / limit - 1.0).abs() < 2e-3, "{} {limit}", chain.best_possible);
                #[expect(clippy::cast_precision_loss, reason = "small")]
                let count = chain.joints.len() as f64;
                assert!(count <= limit.ceil() + 2.0, "{tolerance:e} {range:?}: {count} arcs, N* {limit:.2}");
                assert!(chain.deviation <= tolerance);
            }
        }
    }

    #[test]
    fn the_chain_is_tangent_and_keeps_the_ends() {
        let curve = ellipse(60.0, 40.0);
        let range = (0.2, 2.9);
        let chain = fit(&curve, range, 1e-4).expect("a chain");
        let (start, end) = (curve(range.0), curve(range.1));
        let segments = contour(&chain, end.point);
        assert_eq!(segments[0].start, start.point);
        for pair in segments.windows(2) {
            assert!((pair[0].end_tangent() - pair[1].start_tangent()).norm() < 1e-12);
        }
        assert!((segments[0].start_tangent() - start.tangent).norm() < 1e-12);
        assert!((segments[segments.len() - 1].end_tangent() - end.tangent).norm() < 1e-9);
    }

    #[test]
    fn a_circle_is_one_arc_and_a_line_one_line() {
        let circle = fit(ellipse(50.0, 50.0), (0.0, PI), 1e-6).expect("a chain");
        assert_eq!(circle.joints.len(), 1);
        assert!((circle.joints[0].bulge - 1.0).abs() < 1e-14 && circle.deviation < 1e-13);
        let line = |t: f64| {
            let zero = Vector2::zeros();
            CurvePoint::from_derivatives(Vector2::new(t, 0.5 * t), Vector2::new(1.0, 0.5), zero, zero)
        };
        let line = fit(line, (0.0, 9.0), 1e-6).expect("a chain");
        assert_eq!(line.joints.len(), 1);
        assert_eq!(line.joints[0].bulge, 0.0);
    }

    /// A long circle has no share at all, a sharp tip hardly one; a chain must not turn by a half circle in one arc.
    #[test]
    fn long_circles_and_sharp_tips_are_fitted() {
        let circle = fit(ellipse(50.0, 50.0), (0.0, 4.0), 1e-6).expect("a chain");
        assert!(circle.joints.len() <= 6 && circle.deviation < 1e-12, "{circle:?}");
        let thin = fit(ellipse(60.0, 2.0), (-1.4, 1.4), 1e-4).expect("a chain");
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let count = thin.joints.len() as f64;
        assert!(count <= thin.best_possible.ceil() + 2.0, "{count} arcs, N* {}", thin.best_possible);
    }

    /// A bump of ten tolerances on a circle, no wider than a hundredth of it, which a chain must not step over.
    #[test]
    fn a_narrow_feature_is_seen() {
        for place in [0.4, 1.0, 1.237] {
            let bumped = |t: f64| {
                let (width, height) = (1e-2, 1e-6);
                let u = (t - place) / width;
                let g = height * libm::exp(-u * u);
                let (g1, g2) = (-2.0 * u * g / width, (4.0 * u * u - 2.0) * g / (width * width));
                let g3 = (12.0 * u - 8.0 * u * u * u) * g / (width * width * width);
                let (sin, cos) = libm::sincos(t);
                let (along, across) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
                let r = 50.0 + g;
                CurvePoint::from_derivatives(
                    along * r,
                    along * g1 + across * r,
                    along * (g2 - r) + across * (2.0 * g1),
                    along * (g3 - 3.0 * g1) + across * (3.0 * g2 - r),
                )
            };
            let chain = fit(bumped, (0.0, 2.0), 1e-7).expect("a chain");
            let ends = chain.joints.iter().skip(1).map(|joint| (joint.parameter, joint.point));
            let ends: Vec<_> = ends.chain([(2.0, bumped(2.0).point)]).collect();
            for (joint, (end, point)) in chain.joints.iter().zip(ends) {
                let segment = Segment { start: joint.point, end: point, bulge: joint.bulge };
                for part in 0..=400 {
                    let exact = bumped(joint.parameter + (end - joint.parameter) * f64::from(part) / 400.0).point;
                    let off = ((exact - segment.centre()).norm() - segment.radius().abs()).abs();
                    assert!(off <= 1.01e-7, "{place}: {off:e}");
                }
            }
        }
    }

    #[test]
    fn nothing_unknown_is_a_chain() {
        let broken = |t: f64| {
            let frame = ellipse(50.0, 50.0)(t);
            let point = if (1.0..1.1).contains(&t) { Vector2::new(f64::NAN, 0.0) } else { frame.point };
            CurvePoint { point, ..frame }
        };
        assert!(fit(broken, (0.0, 3.0), 1e-3).is_err());
    }

    #[test]
    fn what_cannot_be_fitted_is_refused() {
        let curve = ellipse(60.0, 40.0);
        assert!(matches!(fit(&curve, (0.0, 1.0), 1e-14), Err(FitError::ToleranceTooFine { .. })));
        assert!(matches!(fit(&curve, (0.0, 1.0), f64::NAN), Err(FitError::ToleranceTooFine { .. })));
        let folded = |t: f64| curve(t).offset_inward(35.0);
        assert!(matches!(fit(folded, (-0.5, 1.5), 1e-3), Err(FitError::NotSmooth { .. })));
    }
}
