//! One smooth piece of an outline: arcs or a spline along it that keep the tolerances of the follower's motion.

use super::{Fit, MOST_EDGES, MotionTolerance, Outline, OutlineError, SegmentKind};
use crate::follower::Element;
use crate::geometry::arcs::{self, ANY_NUMBER};
use crate::geometry::contour::{Bend, Edge, Vertex};
use crate::geometry::{ChainTolerance, CurvePoint, MILLIMETRES, cubics, rotated};
use crate::motion::Motion;
use crate::profile::Curves;
use crate::profile::followed::FollowerOnChain;
use nalgebra::Vector2;
use std::ops::RangeInclusive;

/// Places at which the variation of the acceleration is evaluated, and the least number of arcs that is expected.
const PLACES: u32 = 16;
const FEW: f64 = 4.0;
/// Where twice as many places give more than this many times the variation, still more are evaluated, up to a largest number.
const SETTLED: f64 = 1.1;
const MOST_PLACES: u32 = 1024;
/// With more arcs than a control should be given in any case, a strip of fewer is not looked for.
const MANY: u32 = 1000;
/// How much tighter than by the ratio the tolerance is set where the follower's errors are too large, and how often.
const CLOSER: f64 = 0.99;
const TRIES: u32 = 4;
/// Cosine of the pressure angle below which no motion is transmitted.
const LEAST_COSINE: f64 = 1e-3;

/// Finer distances are tried through so many powers of ten, which are far apart where they differ by more than this share.
const FINER_DECADES: u32 = 6;
const SAME_LENGTH: f64 = 1e-9;
/// Places of a motion and of its repetition that differ by rounding, rad.
const SAME_PLACE: f64 = 1e-12;

/// A piece as it was fitted.
#[derive(Debug, Clone)]
struct Strip {
    /// The start of every edge; the last ends where the piece ends.
    vertices: Vec<Vertex>,
    deviation: f64,
    best_possible: f64,
    best_for: [f64; 2],
}

impl Strip {
    /// Fits a curve in millimetres, which gives the allowed errors of its heading and curvature, within a tolerance in
    /// millimetres, with a number
    /// of arcs in a range.
    fn along(
        target: impl Fn(f64) -> (CurvePoint, ChainTolerance),
        from: f64,
        to: f64,
        tolerance: f64,
        fit: &Fit,
        numbers: RangeInclusive<u32>,
    ) -> Result<Self, OutlineError> {
        if fit.laid == SegmentKind::Splines {
            let fitted = cubics::fit(|at| target(at).0, (from, to), tolerance, &|at, _| target(at).1)?;
            return Ok(Self {
                vertices: fitted
                    .spline
                    .pieces()
                    .into_iter()
                    .map(|[start, leaves, arrives, _]| Vertex { point: start, bend: Bend::Cubic([leaves, arrives]) })
                    .collect(),
                deviation: fitted.deviation,
                best_possible: fitted.by_theory,
                best_for: [0.0; 2],
            });
        }
        let chain = if fit.motion == MotionTolerance::ANY {
            arcs::fit(|at| target(at).0, (from, to), tolerance)?
        } else {
            arcs::fit_with_tolerances(target, (from, to), tolerance, numbers)?
        };
        Ok(Self {
            vertices: chain.joints.iter().map(|joint| Vertex::new(joint.point, joint.bulge)).collect(),
            deviation: chain.deviation,
            best_possible: chain.best_possible,
            best_for: chain.best_for,
        })
    }

    /// Number of its edges.
    fn arcs(&self) -> u32 {
        u32::try_from(self.vertices.len()).unwrap_or(u32::MAX)
    }

    /// Its edges, the last of which ends at a point.
    fn edges(&self, end: Vector2<f64>) -> Vec<Edge> {
        let ends = self.vertices.iter().skip(1).map(|vertex| vertex.point).chain([end]);
        self.vertices.iter().zip(ends).map(|(vertex, end)| vertex.to(end)).collect()
    }

    /// The strip turned about the shaft by an angle, rad.
    fn turned(&self, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        let vertices = self.vertices.iter().map(|vertex| Vertex {
            point: rotated(vertex.point, sin, cos),
            bend: match vertex.bend {
                Bend::Arc(bulge) => Bend::Arc(bulge),
                Bend::Cubic(inner) => Bend::Cubic(inner.map(|point| rotated(point, sin, cos))),
            },
        });
        Self { vertices: vertices.collect(), ..*self }
    }

    /// The strip mirrored, from its end to its start: the line through the shaft whose direction is half this angle, rad.
    fn in_mirror(&self, end: Vector2<f64>, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        let mirrored = |p: Vector2<f64>| Vector2::new(cos * p.x + sin * p.y, sin * p.x - cos * p.y);
        let edges = self.edges(end);
        let vertices = edges.iter().rev().map(|edge| Vertex {
            point: mirrored(edge.end()),
            bend: match edge.bend() {
                // A left turn stays one: mirroring and the reversed direction cancel.
                Bend::Arc(bulge) => Bend::Arc(bulge),
                Bend::Cubic([leaves, arrives]) => Bend::Cubic([mirrored(arrives), mirrored(leaves)]),
            },
        });
        Self { vertices: vertices.collect(), ..*self }
    }
}

/// The strips of an outline along the pieces of its motion, of which later pieces may be repetitions.
#[derive(Debug, Default)]
pub(super) struct OutlineStrips(Vec<PieceStrip>);

/// A fitted strip, with the piece and the range it belongs to.
#[derive(Debug)]
struct PieceStrip {
    piece: usize,
    range: (f64, f64),
    end: Vector2<f64>,
    strip: Strip,
}

impl OutlineStrips {
    /// The strip along a range of a piece, if the piece that this one repeats has a strip along the corresponding range.
    fn repeated(&self, curves: Curves<'_>, piece: usize, from: f64, to: f64) -> Option<Strip> {
        curves.motion.period()?;
        let pieces = curves.motion.pieces();
        let (first, in_mirror) = curves.motion.repeats(piece);
        let span = pieces.get(piece)?;
        self.0.iter().find_map(|done| {
            let (other, other_in_mirror) = curves.motion.repeats(done.piece);
            let own = pieces.get(done.piece).filter(|_| other == first)?;
            let (start, end) = done.range;
            if in_mirror == other_in_mirror {
                let turned =
                    is_same_place(from - span.start, start - own.start) && is_same_place(span.end - to, own.end - end);
                return turned.then(|| done.strip.turned(from - start));
            }
            let mirrored =
                is_same_place(from - span.start, own.end - end) && is_same_place(span.end - to, start - own.start);
            (mirrored && curves.follower.is_symmetric()).then(|| done.strip.in_mirror(done.end, from + end))
        })
    }
}

impl Outline {
    /// Fits arcs or a spline along a curve, given in millimetres over a range of its parameter with the allowed errors of its heading and
    /// curvature, within the tolerance of a fit (m).
    ///
    /// # Errors
    /// [`OutlineError`] when the tolerance cannot be kept.
    pub fn add_piece(
        &mut self,
        target: impl Fn(f64) -> (CurvePoint, ChainTolerance),
        range: (f64, f64),
        fit: &Fit,
    ) -> Result<(), OutlineError> {
        self.add(Strip::along(target, range.0, range.1, fit.tolerance_mm(), fit, ANY_NUMBER)?);
        Ok(())
    }

    /// Fits arcs or a spline along a parallel of the follower's curve (m inwards) that keep the tolerances of the motion on the parallel
    /// that it represents; what repeats one of the strips is copied from it.
    pub(super) fn add_repeatable_piece(
        &mut self,
        strips: &mut OutlineStrips,
        stretch: ParallelStretch<'_>,
        fit: &Fit,
    ) -> Result<(), OutlineError> {
        let ParallelStretch { curves, piece, range, .. } = stretch;
        let strip = match strips.repeated(curves, piece, range.0, range.1) {
            Some(strip) => strip,
            None => stretch.strip(fit)?,
        };
        self.add(strip.clone());
        strips.0.push(PieceStrip { piece, range, end: stretch.end(), strip });
        Ok(())
    }

    fn add(&mut self, strip: Strip) {
        self.contour.vertices.extend(strip.vertices);
        self.deviation = self.deviation.max(strip.deviation);
        self.best_possible += strip.best_possible;
        for (sum, best) in self.best_for.iter_mut().zip(strip.best_for) {
            // The ratio of infinite tolerances is not a number.
            *sum += if best.is_finite() { best } else { 0.0 };
        }
    }
}

/// A parallel of the follower's curve at a distance inwards (m), in millimetres.
pub(super) fn frame(curves: Curves<'_>, piece: usize, at: f64, distance: f64) -> CurvePoint {
    curves.touch(piece, at).curve.offset_inward(distance).scaled(MILLIMETRES)
}

/// A stretch of a parallel of the follower's curve to which a strip is fitted.
#[derive(Debug, Clone, Copy)]
pub(super) struct ParallelStretch<'a> {
    pub(super) curves: Curves<'a>,
    pub(super) piece: usize,
    /// First and last parameter.
    pub(super) range: (f64, f64),
    /// How far inwards the parallel lies, m.
    pub(super) distance: f64,
    /// The same of the parallel that it represents and on which the errors of the motion are measured, m.
    pub(super) stands_for: f64,
}

impl ParallelStretch<'_> {
    fn end(&self) -> Vector2<f64> {
        frame(self.curves, self.piece, self.range.1, self.distance).point
    }

    /// A strip that keeps the tolerances of the follower's motion on the parallel that this one represents. Where no follower runs, only
    /// the distance is kept.
    fn strip(&self, fit: &Fit) -> Result<Strip, OutlineError> {
        if fit.motion != MotionTolerance::ANY
            && self.curves.motion.is_rolled(self.piece)
            && let Some((worst, strip)) = self.keeping_motion(fit, ANY_NUMBER)
        {
            return Ok(if is_by_radius(self.curves, fit) { self.fewest(fit, worst, strip) } else { strip });
        }
        let fit = Fit { motion: MotionTolerance::ANY, ..*fit };
        Strip::along(
            |at| (frame(self.curves, self.piece, at, self.distance), ChainTolerance::ANY),
            self.range.0,
            self.range.1,
            fit.tolerance_mm(),
            &fit,
            ANY_NUMBER,
        )
    }

    /// Under a face of the strips within finer and finer distances the one of fewest arcs, so that a coarser request never takes more arcs
    /// than a finer one of the numbers tried: the number depends on the distance also where the acceleration alone decides it.
    fn fewest(&self, fit: &Fit, mut worst: f64, mut best: Strip) -> Strip {
        let for_distance = best.best_possible;
        for tolerance in finer(fit.tolerance) {
            let arcs = best.arcs();
            // Where the request is not kept, a finer distance does not help either.
            if for_distance * libm::cbrt(fit.tolerance / tolerance) >= f64::from(arcs) || arcs > MANY || worst > 1.0 {
                break;
            }
            let found = self.keeping_motion(&Fit { tolerance, ..*fit }, 1..=arcs - 1);
            if let Some(found) = found.filter(|(worst, strip)| *worst <= 1.0 && strip.arcs() < arcs) {
                (worst, best) = found;
            }
        }
        best.best_possible = for_distance;
        best
    }

    /// A strip that keeps the tolerances of the motion, with its largest error over what is allowed; `None` where no number of edges that a
    /// drawing can hold is enough.
    ///
    /// The allowed errors of heading and curvature follow from these to first order; the errors of the motion are then measured on the
    /// chain itself, which is fitted again where they are too large.
    fn keeping_motion(&self, fit: &Fit, numbers: RangeInclusive<u32>) -> Option<(f64, Strip)> {
        let Self { curves, piece, range, distance, stands_for } = *self;
        let motion = fit.motion;
        // The measured errors differ from the first order by about the share of one arc in all arcs.
        let arcs = variation(curves.motion, piece, range.0, range.1, PLACES) / (2.0 * motion.acceleration);
        let first = arcs.max(FEW) / (arcs.max(FEW) + 1.0);
        let mut tightened = MotionTolerance { acceleration: first * motion.acceleration, ..motion };
        let by_radius = is_by_radius(curves, fit);
        let (mut least, most) = numbers.into_inner();
        let mut best: Option<(f64, Strip)> = None;
        for _ in 0..TRIES {
            // The check reports that it is not kept.
            let Ok(mut strip) = Strip::along(
                |at| within(curves, piece, at, distance, tightened, by_radius),
                range.0,
                range.1,
                fit.tolerance_mm(),
                fit,
                least..=most,
            ) else {
                break;
            };
            // Tighter tolerances take no fewer arcs.
            least = strip.arcs();
            // The best possible numbers are those for the given tolerances, not for the tighter ones of this attempt.
            let [velocity, acceleration] = &mut strip.best_for;
            *velocity *= (tightened.velocity / motion.velocity).max(0.0).sqrt();
            *acceleration *= tightened.acceleration / motion.acceleration;
            let edges = strip.edges(self.end());
            let errors = FollowerOnChain::on_parallel(curves, stands_for, &edges).errors();
            let over = [errors.velocity.value / motion.velocity, errors.acceleration.value / motion.acceleration];
            let worst = over.iter().copied().fold(0.0, f64::max);
            if best.as_ref().is_none_or(|(least, _)| worst < *least) {
                best = Some((worst, strip));
            }
            if !(worst > 1.0) {
                break;
            }
            let [velocity, acceleration] = over.map(|over| over.max(1.0) / if over > 1.0 { CLOSER } else { 1.0 });
            tightened = MotionTolerance {
                velocity: tightened.velocity / velocity,
                acceleration: tightened.acceleration / acceleration,
            };
        }
        best
    }
}

/// The lengths 1, 2 and 5 times a power of ten below one, in falling order.
fn finer(length: f64) -> impl Iterator<Item = f64> {
    let decade = libm::floor(libm::log10(length));
    let lengths = (0..FINER_DECADES).flat_map(move |below| {
        let power = libm::pow(10.0, decade - f64::from(below));
        [5.0 * power, 2.0 * power, power]
    });
    lengths.filter(move |finer| *finer < length * (1.0 - SAME_LENGTH))
}

/// Whether the motion of a fit is kept by the radius of curvature: a flat face on arcs.
fn is_by_radius(curves: Curves<'_>, fit: &Fit) -> bool {
    curves.element() == Element::Face && fit.laid == SegmentKind::Arcs
}

/// A parallel of the follower's curve at a distance inwards (m), in millimetres, with the allowed errors of its heading and curvature that
/// keep these errors of the motion: to first order δs' = (ℓ/cos α) δheading and δs'' = −(ℓ²/cos α) δκ, ℓ the speed
/// of that parallel, which is the same for all of them. Under a face δs'' is the error of the radius, of any size.
fn within(
    curves: Curves<'_>,
    piece: usize,
    at: f64,
    distance: f64,
    motion: MotionTolerance,
    by_radius: bool,
) -> (CurvePoint, ChainTolerance) {
    let lift = curves.motion.jet(piece, at);
    let touch = curves.follower.touch(at, &lift);
    let frame = touch.curve.offset_inward(distance).scaled(MILLIMETRES);
    let cosine = touch.drive.dot(&touch.curve.outward());
    let pace = curves.motion.pace(at).0;
    let allowed = allowed(&frame, cosine * curves.follower.leverage(&lift), pace, motion);
    let bend = frame.curvature;
    if by_radius && bend > 0.0 && allowed.curvature.is_finite() {
        let error = allowed.curvature / (bend * bend);
        return (frame, ChainTolerance::of_radius(allowed.heading, error, &frame));
    }
    (frame, allowed)
}

/// The allowed errors of heading and curvature of a curve in millimetres, where a unit of lift moves the follower this far along its
/// normal (m), and the parameter has this rate.
#[must_use]
pub fn allowed(frame: &CurvePoint, along_normal: f64, pace: f64, motion: MotionTolerance) -> ChainTolerance {
    if motion == MotionTolerance::ANY {
        return ChainTolerance::ANY;
    }
    let (lift, speed) = (MILLIMETRES * along_normal.max(LEAST_COSINE), frame.speed.abs() * pace);
    ChainTolerance::symmetric(motion.velocity * lift / speed, motion.acceleration * lift / (speed * speed))
}

/// The number of arcs that an allowed error of the acceleration requires, where it is more than an outline may have.
#[must_use]
pub fn too_many_arcs(curves: Curves<'_>, tolerance: MotionTolerance) -> Option<f64> {
    let motion = curves.motion;
    let rolled = motion.pieces().iter().enumerate().filter(|(piece, span)| motion.is_rolled(*piece) && !span.dwell);
    let arcs = rolled.map(|(piece, span)| {
        let arcs =
            |places: u32| variation(motion, piece, span.start, span.end, places) / (2.0 * tolerance.acceleration);
        // A piece may have many waves.
        let mut places = PLACES;
        let (mut before, mut here) = (0.0, arcs(places));
        while here > SETTLED * before && places < MOST_PLACES {
            places *= 2;
            (before, here) = (here, arcs(places));
        }
        here
    });
    Some(arcs.sum()).filter(|arcs| *arcs > f64::from(MOST_EDGES))
}

/// A fit without the tolerances of the motion where they cannot be kept: the check reports that they are not.
pub(super) fn within_reach(curves: Curves<'_>, fit: &Fit) -> Fit {
    let too_many = fit.laid == SegmentKind::Arcs && too_many_arcs(curves, fit.motion).is_some();
    fit.by_distance().filter(|_| too_many).unwrap_or(*fit)
}

/// The total variation of the acceleration over a range of a piece, by the angle of the shaft, estimated from so many places. It varies by
/// twice the allowed error along an arc.
fn variation(motion: &dyn Motion, piece: usize, from: f64, to: f64, places: u32) -> f64 {
    let accelerations = (0..=places).map(|i| {
        let place = from + (to - from) * f64::from(i) / f64::from(places);
        let (jet, (first, second)) = (motion.jet(piece, place), motion.pace(place));
        jet.dds * first * first + jet.ds * second
    });
    let accelerations: Vec<f64> = accelerations.collect();
    accelerations.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum()
}

fn is_same_place(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_PLACE
}
