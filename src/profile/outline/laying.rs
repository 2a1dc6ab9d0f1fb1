//! One smooth piece of an outline: arcs or a spline along it, so that the follower feels no more than it may.

use super::{Fit, Laid, MotionTolerance, Outline, OutlineError};
use crate::geometry::contour::{Bend, Edge, Vertex};
use crate::geometry::{Allowed, CurvePoint, MILLIMETRES, arcs, cubics};
use crate::motion::Motion;
use crate::profile::Curves;
use crate::profile::followed::Followed;
use nalgebra::Vector2;

/// Places at which the variation of the acceleration is seen, and the least number of arcs that is expected.
const PLACES: u32 = 16;
const FEW: f64 = 4.0;
/// How much closer than by the ratio more is asked for where the follower feels too much, and how often.
const CLOSER: f64 = 0.99;
const TRIES: u32 = 4;
/// Cosine of the pressure angle below which no motion is transmitted.
const LEAST_COSINE: f64 = 1e-3;

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
    /// Along a curve in millimetres that tells what of its heading and curvature may be missed, within a tolerance in
    /// millimetres.
    fn along(
        target: impl Fn(f64) -> (CurvePoint, Allowed),
        range: (f64, f64),
        tolerance: f64,
        fit: &Fit,
    ) -> Result<Self, OutlineError> {
        if fit.laid == Laid::Splines {
            let fitted = cubics::fit(|at| target(at).0, range, tolerance, &|at, _| target(at).1)?;
            let vertex = |[start, leaves, arrives, _]: [Vector2<f64>; 4]| Vertex {
                point: start,
                bend: Bend::Cubic([leaves, arrives]),
            };
            return Ok(Self {
                vertices: fitted.spline.pieces().into_iter().map(vertex).collect(),
                deviation: fitted.deviation,
                best_possible: fitted.by_theory,
                best_for: [0.0; 2],
            });
        }
        let chain = if fit.motion == MotionTolerance::ANY {
            arcs::fit(|at| target(at).0, range, tolerance)?
        } else {
            arcs::fit_allowed(target, range, tolerance)?
        };
        Ok(Self {
            vertices: chain.joints.iter().map(|joint| Vertex::new(joint.point, joint.bulge)).collect(),
            deviation: chain.deviation,
            best_possible: chain.best_possible,
            best_for: chain.best_for,
        })
    }

    /// Its edges, the last of which ends at a point.
    fn edges(&self, end: Vector2<f64>) -> Vec<Edge> {
        let ends = self.vertices.iter().skip(1).map(|vertex| vertex.point).chain([end]);
        self.vertices.iter().zip(ends).map(|(vertex, end)| vertex.to(end)).collect()
    }

    /// The same turned about the shaft by an angle, rad.
    fn turned(&self, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        let place = |p: Vector2<f64>| Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
        let bend = |bend: Bend| match bend {
            Bend::Arc(bulge) => Bend::Arc(bulge),
            Bend::Cubic(inner) => Bend::Cubic(inner.map(place)),
        };
        let vertex = |vertex: &Vertex| Vertex { point: place(vertex.point), bend: bend(vertex.bend) };
        Self { vertices: self.vertices.iter().map(vertex).collect(), ..*self }
    }

    /// The same in the mirror, from its end to its start: the line through the shaft whose direction is half this angle, rad.
    fn in_mirror(&self, end: Vector2<f64>, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        let place = |p: Vector2<f64>| Vector2::new(cos * p.x + sin * p.y, sin * p.x - cos * p.y);
        // What turns left still does: the mirror and the other direction take each other back.
        let bend = |bend: Bend| match bend {
            Bend::Arc(bulge) => Bend::Arc(bulge),
            Bend::Cubic([leaves, arrives]) => Bend::Cubic([place(arrives), place(leaves)]),
        };
        let vertex = |edge: &Edge| Vertex { point: place(edge.end()), bend: bend(edge.bend()) };
        Self { vertices: self.edges(end).iter().rev().map(vertex).collect(), ..*self }
    }
}

/// The strips of an outline along the pieces of its motion, of which later pieces may be repetitions.
#[derive(Debug, Default)]
pub(super) struct Strips(Vec<Done>);

/// A strip that was laid.
#[derive(Debug)]
struct Done {
    piece: usize,
    range: (f64, f64),
    end: Vector2<f64>,
    strip: Strip,
}

impl Strips {
    /// The strip along a range of a piece, where the same range of what this piece repeats has one.
    fn repeated(&self, curves: Curves<'_>, piece: usize, (from, to): (f64, f64)) -> Option<Strip> {
        curves.motion.period()?;
        let pieces = curves.motion.pieces();
        let (first, in_mirror) = curves.motion.repeats(piece);
        let span = pieces.get(piece)?;
        let same = |a: f64, b: f64| (a - b).abs() <= SAME_PLACE;
        self.0.iter().find_map(|done| {
            let (other, other_in_mirror) = curves.motion.repeats(done.piece);
            let own = pieces.get(done.piece).filter(|_| other == first)?;
            let (start, end) = done.range;
            if in_mirror == other_in_mirror {
                let turned = same(from - span.start, start - own.start) && same(span.end - to, own.end - end);
                return turned.then(|| done.strip.turned(from - start));
            }
            let mirrored = same(from - span.start, own.end - end) && same(span.end - to, start - own.start);
            (mirrored && curves.follower.is_symmetric()).then(|| done.strip.in_mirror(done.end, from + end))
        })
    }
}

impl Outline {
    /// Lays arcs or a spline along a curve, given in millimetres over a range of its parameter with what of its heading and
    /// curvature may be missed, within the tolerance of a fit (m).
    pub(crate) fn lay(
        &mut self,
        target: impl Fn(f64) -> (CurvePoint, Allowed),
        range: (f64, f64),
        fit: &Fit,
    ) -> Result<(), OutlineError> {
        self.add(Strip::along(target, range, MILLIMETRES * fit.tolerance, fit)?);
        Ok(())
    }

    /// Lays arcs or a spline along a parallel of the follower's curve (m inwards) so that the follower feels no more than it may of
    /// the parallel that it stands for; what repeats one of the strips is laid as that.
    pub(super) fn lay_felt(
        &mut self,
        strips: &mut Strips,
        curves: Curves<'_>,
        (piece, distance, stands_for): (usize, f64, f64),
        range: (f64, f64),
        fit: &Fit,
    ) -> Result<(), OutlineError> {
        let strip = match strips.repeated(curves, piece, range) {
            Some(strip) => strip,
            None => felt(curves, (piece, distance, stands_for), range, fit)?,
        };
        let end = frame(curves, (piece, range.1), distance).point;
        self.add(strip.clone());
        strips.0.push(Done { piece, range, end, strip });
        Ok(())
    }

    fn add(&mut self, strip: Strip) {
        self.contour.vertices.extend(strip.vertices);
        self.deviation = self.deviation.max(strip.deviation);
        self.best_possible += strip.best_possible;
        for (sum, best) in self.best_for.iter_mut().zip(strip.best_for) {
            // The ratio of what is asked without limit is no number.
            *sum += if best.is_finite() { best } else { 0.0 };
        }
    }
}

/// A parallel of the follower's curve at a distance inwards (m), in millimetres.
fn frame(curves: Curves<'_>, (piece, at): (usize, f64), distance: f64) -> CurvePoint {
    curves.touch(piece, at).curve.offset_inward(distance).scaled(MILLIMETRES)
}

/// A strip along a parallel of the follower's curve (m inwards) of which the follower feels no more than it may of the parallel
/// that it stands for.
///
/// What heading and curvature may miss follows from that to first order; what the follower feels is then measured on the
/// chain itself, which is laid again where it is more. Where no follower runs the distance alone is kept.
fn felt(
    curves: Curves<'_>,
    (piece, distance, stands_for): (usize, f64, f64),
    range: (f64, f64),
    fit: &Fit,
) -> Result<Strip, OutlineError> {
    let motion = fit.motion;
    let by_distance = || {
        let fit = Fit { motion: MotionTolerance::ANY, ..*fit };
        let target = |at: f64| (frame(curves, (piece, at), distance), Allowed::ANY);
        Strip::along(target, range, MILLIMETRES * fit.tolerance, &fit)
    };
    if motion == MotionTolerance::ANY || !curves.motion.is_rolled(piece) {
        return by_distance();
    }
    // What is felt differs from the first order by as much as one arc is of all.
    let arcs = variation(curves.motion, piece, range) / (2.0 * motion.acceleration);
    let first = arcs.max(FEW) / (arcs.max(FEW) + 1.0);
    let mut asked = MotionTolerance { acceleration: first * motion.acceleration, ..motion };
    let mut best: Option<(f64, Strip)> = None;
    for _ in 0..TRIES {
        let target = |at: f64| within(curves, (piece, at), distance, asked);
        // Where no number of edges that a drawing can hold would do the distance is kept alone, and the check says so.
        let Ok(mut strip) = Strip::along(target, range, MILLIMETRES * fit.tolerance, fit) else { break };
        // The best possible numbers are those for what may be felt, not for what was asked of this try.
        let [velocity, acceleration] = &mut strip.best_for;
        *velocity *= (asked.velocity / motion.velocity).max(0.0).sqrt();
        *acceleration *= asked.acceleration / motion.acceleration;
        let edges = strip.edges(frame(curves, (piece, range.1), distance).point);
        let errors = Followed::beside(curves, stands_for, &edges).errors();
        let over = [errors.velocity.value / motion.velocity, errors.acceleration.value / motion.acceleration];
        let worst = over.iter().copied().fold(0.0, f64::max);
        if best.as_ref().is_none_or(|(least, _)| worst < *least) {
            best = Some((worst, strip));
        }
        if !(worst > 1.0) {
            break;
        }
        let [velocity, acceleration] = over.map(|over| over.max(1.0) / if over > 1.0 { CLOSER } else { 1.0 });
        asked =
            MotionTolerance { velocity: asked.velocity / velocity, acceleration: asked.acceleration / acceleration };
    }
    best.map_or_else(by_distance, |(_, strip)| Ok(strip))
}

/// A parallel of the follower's curve at a distance inwards (m), in millimetres, with what its heading and curvature may miss so
/// that the follower feels no more than this: to first order δs' = (ℓ/cos α) δheading and δs'' = −(ℓ²/cos α) δκ, ℓ the speed
/// of that parallel, which is the same for all of them.
fn within(
    curves: Curves<'_>,
    (piece, at): (usize, f64),
    distance: f64,
    motion: MotionTolerance,
) -> (CurvePoint, Allowed) {
    let lift = curves.motion.jet(piece, at);
    let touch = curves.follower.touch(at, &lift);
    let frame = touch.curve.offset_inward(distance).scaled(MILLIMETRES);
    let cosine = touch.drive.dot(&touch.curve.outward());
    let pace = curves.motion.pace(at).0;
    (frame, allowed(&frame, cosine * curves.follower.leverage(&lift), pace, motion))
}

/// What heading and curvature of a curve in millimetres may miss, where a unit of lift moves the follower so far along its
/// normal (m), and the parameter keeps this pace.
pub(crate) fn allowed(frame: &CurvePoint, along_normal: f64, pace: f64, motion: MotionTolerance) -> Allowed {
    if motion == MotionTolerance::ANY {
        return Allowed::ANY;
    }
    let (lift, speed) = (MILLIMETRES * along_normal.max(LEAST_COSINE), frame.speed.abs() * pace);
    Allowed { heading: motion.velocity * lift / speed, curvature: motion.acceleration * lift / (speed * speed) }
}

/// The total variation of the acceleration over a range of a piece, by the angle of the shaft, as far as a few places show it.
fn variation(motion: &dyn Motion, piece: usize, (from, to): (f64, f64)) -> f64 {
    let at = |i: u32| {
        let place = from + (to - from) * f64::from(i) / f64::from(PLACES);
        let (jet, (first, second)) = (motion.jet(piece, place), motion.pace(place));
        jet.dds * first * first + jet.ds * second
    };
    (0..PLACES).map(|i| (at(i + 1) - at(i)).abs()).sum()
}
