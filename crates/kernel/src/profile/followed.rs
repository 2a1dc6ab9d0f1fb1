//! A follower on a chain of arcs, lines and cubic curves: lift, velocity and acceleration as cut, in closed form.
//!
//! While the contact runs along an arc, the centre of the roller runs on a circle about the centre of the arc; along a line, on
//! a line. Lift, velocity and acceleration follow in turn from the condition that the point C of the follower's curve lies on that
//! circle of radius ρ about M, n the unit vector from M to C:
//!
//! ```text
//! |C − M| = ρ,   n·C' = 0,   n·C'' = −|C'|²/ρ
//! ```
//!
//! C depends on the lift, C' is linear in its first derivative, C'' in its second, for any follower. A flat face touches
//! an arc where its normal N is that of the arc: p = M·N + R is its distance from the shaft, M·T the place q of the contact along
//! it, and R the radius of curvature. Each gives one of lift, velocity and acceleration: in closed form where N is fixed in the
//! frame of the follower; under a face on an arm p is solved by secants, and q and ρ from linear relations for q β' = p' and ρ.

mod errors;

pub use errors::ErrorsOnChain;

use super::Curves;
use crate::follower::Element;
use crate::geometry::contour::{Contour, Edge};
use crate::geometry::{MILLIMETRES, STRAIGHT};
use crate::motion::{Jet, Motion, Quantity, own_pieces};
use crate::numeric::chebyshev::{self, SearchStart};
use crate::numeric::root;
use nalgebra::Vector2;

/// Stretches of the motion shorter than this, rad or m, are the rounding of a joint: the direction of an arc is known to 1e-9.
pub(super) const HAIR: f64 = 1e-8;
/// Steps to the lift: two are usually enough.
const LIFT_STEPS: u32 = 8;
/// A gap of this share of the distance from the shaft leaves less than rounding after one more step of Newton's method.
const SETTLED: f64 = 1e-9;
/// The follower as placed by the motion counts as near the chain within the radius of its roller, but at least within this, m: a chain
/// may be farther from the profile than a small roller is large.
const LEAST_REACH: f64 = 2e-3;
/// A roller touches within this many roundings of a length.
const TOUCHING: f64 = 2.0 * f64::EPSILON;
/// A change of velocity or acceleration, m/rad or rad/rad, with which the slope of a linear relation is measured.
const CHANGE: f64 = 0.1;
/// The curve that the follower's point follows while the contact runs along a segment.
#[derive(Debug, Clone, Copy)]
pub(super) enum Guide {
    /// For the centre of a roller, or the distance of a face from the shaft, a circle: its centre, m, and its radius, m; signed under a
    /// face, where a concave arc has a negative one.
    Circle(Vector2<f64>, f64),
    /// For the centre of a roller a line: a point of it, m, and its unit normal.
    Line(Vector2<f64>, Vector2<f64>),
    /// A cubic curve: at each place its circle of curvature is followed, since that has the same curvature.
    Curve(Edge),
}

impl Guide {
    /// Distance of a point from a circle or line, and the normal there.
    fn distance(self, point: Vector2<f64>) -> (f64, Vector2<f64>) {
        match self {
            Self::Circle(centre, radius) => {
                let away = point - centre;
                let distance = away.norm();
                (distance - radius, away / distance)
            }
            Self::Line(on, normal) => ((point - on).dot(&normal), normal),
            Self::Curve(_) => (f64::NAN, Vector2::zeros()),
        }
    }
}

/// A stretch of the motion over which the contact stays on one segment and the motion on one piece.
#[derive(Debug, Clone, Copy)]
struct ContactStretch {
    from: f64,
    to: f64,
    piece: usize,
    /// Added to the running parameter it gives the parameter of the piece.
    shift: f64,
    guide: Guide,
}

/// A lift of the motion, and its place: a piece, and the parameter in it.
pub type LiftAtPlace = ((usize, f64), Jet);

/// A follower on a chain.
#[derive(Debug)]
pub struct FollowerOnChain<'a> {
    curves: Curves<'a>,
    /// Distance from the chain out to the follower's curve, m; negative where it lies within.
    out: f64,
    stretches: Vec<ContactStretch>,
    /// Whether the end of the chain is its start.
    closed: bool,
}

/// Turn between two edges that is rounding, rad.
const SMOOTH: f64 = 1e-10;
/// Largest kink between two edges, degrees, that controls and shops treat as smooth. A follower passes it with a step of its velocity; at a
/// larger one it turns about the corner.
pub const LARGEST_SMOOTH_KINK: f64 = 0.05;
const FLAT: f64 = LARGEST_SMOOTH_KINK * std::f64::consts::PI / 180.0;
/// Shortest edge that is followed, mm: the turn of a shorter one moves a follower by less than rounding.
const LEAST_EDGE: f64 = 1e-6;

/// The outward unit normal for a tangent of an outline that runs counter-clockwise.
fn outward(tangent: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(tangent.y, -tangent.x)
}

impl<'a> FollowerOnChain<'a> {
    /// A follower on the edges of a profile in their order (mm), the metal on their left.
    #[must_use]
    pub fn new(curves: Curves<'a>, edges: &[Edge]) -> Self {
        Self::on_parallel(curves, curves.offset(), edges)
    }

    /// A follower on edges that represent a parallel of the follower's curve at a distance inwards, m: the path of a cutter, whose radius
    /// separates it from the profile.
    #[must_use]
    pub fn on_parallel(curves: Curves<'a>, out: f64, edges: &[Edge]) -> Self {
        let reach = MILLIMETRES * out;
        let face = curves.element() == Element::Face;
        // NaN where the follower, placed by the motion, is not near the chain: on the end or the other flank of a plate.
        let nearby = curves.offset().abs().max(LEAST_REACH);
        let parameter = |point: Vector2<f64>, tangent: Vector2<f64>| {
            let normal = outward(tangent);
            let centre = (point + normal * reach) / MILLIMETRES;
            let parameter = curves.follower.parameter_of(centre, normal);
            let (piece, inside) = curves.motion.locate(parameter);
            let touch = curves.touch(piece, inside);
            // A knife edge is on a disc, which has one flank.
            let near = face || curves.offset() == 0.0 || (centre - touch.curve.point).norm() < nearby;
            if near && normal.dot(&touch.drive) > 0.0 { parameter } else { f64::NAN }
        };
        let period = curves.motion.period();
        // Every segment, and between it and the one before, an edge about which the follower turns, where the direction changes.
        let mut ended: Option<(Vector2<f64>, Vector2<f64>, f64)> = None;
        let mut runs: Vec<(f64, f64, Guide)> = Vec::with_capacity(edges.len());
        let mut last: Option<f64> = None;
        let mut first: Option<(f64, Vector2<f64>)> = None;
        // Radius at which the follower turns about an edge.
        let corner_radius = if face { out } else { out.abs() };
        // A shorter segment has an arbitrary direction where its ends were rounded, and is skipped.
        for edge in edges.iter().filter(|edge| edge.length() > LEAST_EDGE) {
            let (start, tangent) = (edge.start(), edge.start_tangent());
            let goes_on = ended.filter(|(end, before, _)| *end == start && turn_is_below(SMOOTH, *before, tangent));
            let flat = ended.is_some_and(|(end, before, _)| end == start && turn_is_below(FLAT, before, tangent));
            let from = goes_on.map_or_else(|| parameter(start, tangent), |(.., at)| at);
            let to = parameter(edge.end(), edge.end_tangent());
            ended = Some((edge.end(), edge.end_tangent(), to));
            let from = last.map_or(from, |last| nearest(from, last, period));
            // An arc of a dwell may go round by more than half a turn.
            let to = nearest(to, from + edge.turning(), period);
            if !(from.is_finite() && to.is_finite()) {
                last = None;
                continue;
            }
            first = first.or(Some((from, edge.start())));
            let from = join(&mut runs, last, from, flat, Guide::Circle(edge.start() / MILLIMETRES, corner_radius));
            if let Some(guide) = guide(edge, out, face).filter(|_| to > from) {
                runs.push((from, to, guide));
            }
            last = Some(last.filter(|last| *last > to).unwrap_or(to));
        }
        let ends = edges.first().zip(edges.last());
        let closed = period.is_some() && ends.is_some_and(|(first, last)| first.start() == last.end());
        if let (true, Some(period), Some(last), Some((start, point))) = (closed, period, last, first) {
            let tangents = ends.map(|(first, last)| (last.end_tangent(), first.start_tangent()));
            let flat = tangents.is_some_and(|(before, after)| turn_is_below(FLAT, before, after));
            join_round(&mut runs, last, start, period, flat, Guide::Circle(point / MILLIMETRES, corner_radius));
        }
        let mut stretches = Vec::with_capacity(runs.len() + curves.motion.pieces().len());
        for run in runs {
            stretches.extend(on_pieces(curves.motion, run.0, run.1, run.2));
        }
        Self { curves, out, stretches, closed }
    }

    /// A follower on a whole outline (mm) as it lies in the drawing, on the first of the flanks that it meets, or as `mirrored` says.
    #[must_use]
    pub fn on(curves: Curves<'a>, contour: &Contour, mirrored: &[bool]) -> Self {
        let turned = mirrored.first().copied().unwrap_or(false).then(|| contour.mirrored_about_x());
        let edges: Vec<Edge> = turned.as_ref().unwrap_or(contour).edges().collect();
        Self::new(curves, &edges)
    }

    /// Lift, velocity and acceleration as cut at a place of a stretch; the third derivative is that of the motion.
    fn cut(&self, stretch: &ContactStretch, parameter: f64) -> Option<(Jet, Jet)> {
        self.cut_at_known_lift(stretch, parameter, None)
    }

    /// Lift, velocity and acceleration as cut at a place where the motion may already be known.
    fn cut_at_known_lift(
        &self,
        stretch: &ContactStretch,
        parameter: f64,
        known: Option<LiftAtPlace>,
    ) -> Option<(Jet, Jet)> {
        let piece = self.curves.motion.pieces().get(stretch.piece)?;
        let inside = (parameter + stretch.shift).clamp(piece.start, piece.end);
        let law = match known {
            Some((at, law)) if at == (stretch.piece, inside) => law,
            _ => self.curves.motion.jet(stretch.piece, inside),
        };
        let guide = match &stretch.guide {
            Guide::Curve(edge) => touching(self.curves, self.out, edge, inside)?,
            known => *known,
        };
        jet_on_guide(self.curves, inside, law, guide).map(|cut| (cut, law))
    }

    /// Lift, velocity and acceleration as cut at a value of the motion's parameter, by that parameter; `None` where the chain
    /// is not touched.
    #[must_use]
    pub fn jet_at(&self, parameter: f64) -> Option<Jet> {
        self.at_known_lift(parameter, None)
    }

    /// Lift, velocity and acceleration as cut at a lift of the motion that is already known.
    #[must_use]
    pub fn at_known_lift(&self, parameter: f64, known: Option<LiftAtPlace>) -> Option<Jet> {
        let (first, _) = self.stretches.first().map(|stretch| (stretch.from, stretch.to))?;
        let wanted = match self.curves.motion.period() {
            Some(period) => parameter + period * ((first - parameter) / period).ceil(),
            None => parameter,
        };
        let index = self.stretches.partition_point(|stretch| stretch.to < wanted);
        let stretch = self.stretches.get(index).or(self.stretches.last())?;
        let reached = wanted >= stretch.from - HAIR && wanted <= stretch.to + HAIR;
        self.cut_at_known_lift(stretch, wanted, known).filter(|_| reached).map(|(cut, _)| cut)
    }

    /// Whether the follower runs on a stretch.
    fn is_rolled(&self, stretch: &ContactStretch) -> bool {
        self.curves.motion.is_rolled(stretch.piece)
    }

    /// The stretches on which the follower runs; between their ends lift and velocity as cut are smooth; by the motion's parameter.
    pub fn ranges(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.stretches.iter().filter(|stretch| self.is_rolled(stretch)).map(|stretch| (stretch.from, stretch.to))
    }

    /// The motion and what is cut of it wherever the follower runs on the chain, a list for each stretch: parameter, lift of the motion and
    /// lift as cut, both with two derivatives by the angle of the shaft. The places are no farther apart than a share of the whole motion.
    #[must_use]
    pub fn lifts(&self, share: f64) -> Vec<Vec<(f64, Jet, Jet)>> {
        let (first, last) = self.curves.motion.range();
        let longest = (share * (last - first)).max(HAIR);
        let rolled = self.stretches.iter().filter(|stretch| self.is_rolled(stretch));
        let lifts = rolled.map(|stretch| {
            let length = stretch.to - stretch.from;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a few thousand")]
            let steps = (length / longest).ceil().clamp(1.0, 1e5) as u32;
            let places = (0..=steps).map(|step| stretch.from + length * (f64::from(step) / f64::from(steps)));
            let jets = places.filter_map(|parameter| {
                let (cut, law) = self.cut(stretch, parameter)?;
                let (speed, slowing) = self.curves.motion.pace(parameter + stretch.shift);
                let [law, cut] = [law, cut].map(|jet| Jet {
                    ds: jet.ds * speed,
                    dds: jet.dds * speed * speed + jet.ds * slowing,
                    ..jet
                });
                Some((parameter, law, cut))
            });
            jets.collect()
        });
        lifts.collect()
    }

    /// Acceleration of the motion and as cut wherever the follower runs on the chain, by the angle of the shaft: parameter, motion, cut;
    /// two at one place where it jumps. The places are no farther apart than a share of the whole motion.
    #[must_use]
    pub fn accelerations(&self, share: f64) -> Vec<[f64; 3]> {
        let (first, last) = self.curves.motion.range();
        let longest = (share * (last - first)).max(HAIR);
        let mut points = Vec::new();
        for stretch in self.stretches.iter().filter(|stretch| self.is_rolled(stretch)) {
            let length = stretch.to - stretch.from;
            let mut at = 0.0;
            loop {
                let parameter = stretch.from + at;
                let (speed, slowing) = self.curves.motion.pace(parameter + stretch.shift);
                if let Some((cut, law)) = self.cut(stretch, parameter) {
                    let [law, cut] = [law, cut].map(|jet| jet.dds * speed * speed + jet.ds * slowing);
                    points.push([parameter, law, cut]);
                }
                if at >= length {
                    break;
                }
                at = (at + longest).min(length);
            }
        }
        points
    }
}

/// Whether the direction of a chain turns by less than a small angle, rad.
fn turn_is_below(angle: f64, before: Vector2<f64>, after: Vector2<f64>) -> bool {
    before.perp(&after).abs() < angle && before.dot(&after) > 0.0
}

/// Adds the run between the end of the last run and the start of the next, and returns where the next then starts: after a run about the
/// edge between them, or, where they overlap or the kink is flat, at a common end in the middle, at which the contact jumps.
fn join(runs: &mut Vec<(f64, f64, Guide)>, last: Option<f64>, from: f64, flat: bool, corner: Guide) -> f64 {
    let Some(last) = last else { return from };
    let turns = from > last && !(flat && from - last > HAIR);
    if turns {
        runs.push((last, from, corner));
    } else if let Some(run) = runs.last_mut() {
        run.1 = (0.5 * (last + from)).max(run.0);
        return if from > last { run.1 } else { run.1.max(from) };
    }
    from
}

/// Joins the end of the last run to the start of the first, a period later.
fn join_round(runs: &mut Vec<(f64, f64, Guide)>, last: f64, start: f64, period: f64, flat: bool, corner: Guide) {
    let common = join(runs, Some(last), start + period, flat, corner) - period;
    if let Some(run) = runs.first_mut().filter(|run| common < start && common < run.1) {
        run.0 = common;
    }
}

/// A parameter moved by whole periods, if there is one, to be as near as possible to another.
pub(super) fn nearest(parameter: f64, to: f64, period: Option<f64>) -> f64 {
    period.map_or(parameter, |period| parameter + period * ((to - parameter) / period).round())
}

/// The guide along an edge; `None` under a face where no run of the motion belongs to the edge.
fn guide(edge: &Edge, offset: f64, face: bool) -> Option<Guide> {
    let Some(segment) = edge.segment() else { return Some(Guide::Curve(*edge)) };
    if segment.bulge == 0.0 {
        return (!face).then(|| line(segment.start, segment.start_tangent(), offset));
    }
    let radius = segment.radius() / MILLIMETRES;
    let centre = segment.centre() / MILLIMETRES;
    let own = radius + offset;
    Some(Guide::Circle(centre, if face { own } else { own.abs() }))
}

/// The line on which a roller's centre runs along a tangent at a point, mm.
fn line(point: Vector2<f64>, tangent: Vector2<f64>, offset: f64) -> Guide {
    let normal = outward(tangent);
    Guide::Line(point / MILLIMETRES + normal * offset, normal)
}

/// The circle of curvature of a curve where the follower touches it at a parameter, or the line where it is straight there.
fn touching(curves: Curves<'_>, out: f64, edge: &Edge, parameter: f64) -> Option<Guide> {
    let (reach, period) = (MILLIMETRES * out, curves.motion.period());
    let ahead = |share: f64| {
        let (point, tangent) = edge.point_and_tangent(share);
        let normal = outward(tangent);
        let here = curves.follower.parameter_of((point + normal * reach) / MILLIMETRES, normal);
        nearest(here, parameter, period) - parameter
    };
    let share = if ahead(0.0) >= 0.0 {
        0.0
    } else if ahead(1.0) <= 0.0 {
        1.0
    } else {
        root::bracketed(ahead, 0.0, 1.0, 0.0).ok()?
    };
    let ((point, tangent), curvature) = (edge.point_and_tangent(share), edge.curvature(share));
    let face = curves.element() == Element::Face;
    if curvature.abs() * MILLIMETRES < STRAIGHT {
        return (!face).then(|| line(point, tangent, out));
    }
    let radius = 1.0 / (curvature * MILLIMETRES);
    let centre = point / MILLIMETRES - outward(tangent) * radius;
    let own = radius + out;
    Some(Guide::Circle(centre, if face { own } else { own.abs() }))
}

/// The parts of a run that lie on the pieces of the motion.
fn on_pieces(motion: &dyn Motion, from: f64, to: f64, guide: Guide) -> impl Iterator<Item = ContactStretch> {
    parts(motion, (from, to)).map(move |PieceRange { from, to, piece, shift }| ContactStretch {
        from,
        to,
        piece,
        shift,
        guide,
    })
}

/// A part of a range of the motion's parameter, on one piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct PieceRange {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) piece: usize,
    /// Added to the running parameter it gives the parameter of the piece.
    pub(super) shift: f64,
}

/// A range of the motion's parameter, over any number of periods, divided at the pieces of the motion.
pub(super) fn parts(motion: &dyn Motion, (from, to): (f64, f64)) -> impl Iterator<Item = PieceRange> {
    let (first, last) = motion.range();
    let (from, to) = if motion.period().is_some() { (from, to) } else { (from.max(first), to.min(last)) };
    let mut at = from;
    std::iter::from_fn(move || {
        if !(to - at > HAIR) {
            return None;
        }
        let (piece, inside) = motion.locate(at + HAIR);
        let end = motion.pieces().get(piece)?.end;
        let shift = inside - (at + HAIR);
        let until = (end - shift).max(at + HAIR);
        // The remainder of a piece, or of a run, may be negligible.
        let until = if to - until > HAIR { until } else { to };
        Some(PieceRange { from: std::mem::replace(&mut at, until), to: until, piece, shift })
    })
}

/// The jet of a follower whose curve follows a guide, at a parameter, starting from the law's.
pub(super) fn jet_on_guide(curves: Curves<'_>, parameter: f64, law: Jet, guide: Guide) -> Option<Jet> {
    match curves.element() {
        Element::Roller { .. } => rolled(curves, parameter, law, guide),
        Element::Face => under_face(curves, parameter, law, guide),
    }
}

/// The jet of a roller whose centre follows a guide.
///
/// By Newton's method: the centre moves by the leverage along the drive for a unit of lift, and C' and C'' change by as much for a
/// unit of its first and second derivative.
fn rolled(curves: Curves<'_>, parameter: f64, law: Jet, guide: Guide) -> Option<Jet> {
    let follower = curves.follower;
    let (sin, cos) = libm::sincos(parameter);
    let (mut jet, (mut point, mut drive)) = (law, follower.point_turned(parameter, sin, cos, &law));
    let size = point.norm();
    let (mut gap, mut normal) = guide.distance(point);
    for _ in 0..LIFT_STEPS {
        let last = gap.abs() <= SETTLED * size;
        jet.s -= gap / (normal.dot(&drive) * follower.leverage(&jet));
        (point, drive) = follower.point_turned(parameter, sin, cos, &jet);
        (gap, normal) = guide.distance(point);
        if last || !(gap.abs() > TOUCHING * size) {
            break;
        }
    }
    let rate = normal.dot(&drive) * follower.leverage(&jet);
    let curve = follower.touch_turned(parameter, sin, cos, &jet).curve;
    jet.ds -= curve.speed * normal.dot(&curve.tangent) / rate;
    // C'' along the normal: κ ℓ² to the left of the tangent.
    let curve = follower.touch_turned(parameter, sin, cos, &jet).curve;
    let square = curve.speed * curve.speed;
    let wanted = match guide {
        Guide::Circle(_, radius) => -square / radius,
        Guide::Line(..) | Guide::Curve(_) => 0.0,
    };
    jet.dds += (wanted + curve.outward().dot(&normal) * curve.curvature * square) / rate;
    (jet.s.is_finite() && jet.ds.is_finite() && jet.dds.is_finite()).then_some(jet)
}

/// The jet of a flat face on an arc.
fn under_face(curves: Curves<'_>, parameter: f64, law: Jet, guide: Guide) -> Option<Jet> {
    let Guide::Circle(centre, radius) = guide else { return None };
    let along_normal = curves.follower.on_face(&law)?.along_normal;
    let lift = face_lift(curves, parameter, law, guide)?;
    if curves.follower.quantity() == Quantity::Length {
        let curve = curves.follower.touch(parameter, &law).curve;
        let ds = centre.dot(&curve.tangent) / along_normal;
        return Some(Jet { s: lift, ds, dds: -centre.dot(&curve.outward()) / along_normal, ..law });
    }
    let law = Jet { s: lift, ..law };
    // The distance of the contact from its place along the face, times β'; and the difference of the radius from that of the arc.
    let off = |jet: Jet| {
        let (curve, turn) = (curves.follower.touch(parameter, &jet).curve, curves.follower.on_face(&jet)?.turn);
        Some(((curve.point - centre).dot(&curve.tangent) * turn, curve.speed / turn - radius))
    };
    let (place, farther) = (off(law)?.0, off(Jet { ds: law.ds + CHANGE, ..law })?.0);
    let law = Jet { ds: law.ds - CHANGE * place / (farther - place), ..law };
    let (bend, more) = (off(law)?.1, off(Jet { dds: law.dds + CHANGE, ..law })?.1);
    let dds = law.dds - CHANGE * bend / (more - bend);
    (lift.is_finite() && law.ds.is_finite() && dds.is_finite()).then_some(Jet { dds, ..law })
}

/// The lift at which a flat face touches an arc, starting from the law's.
pub(super) fn face_lift(curves: Curves<'_>, parameter: f64, law: Jet, guide: Guide) -> Option<f64> {
    let Guide::Circle(centre, radius) = guide else { return None };
    let along_normal = curves.follower.on_face(&law)?.along_normal;
    let start = curves.follower.touch(parameter, &law).curve;
    let missing = (centre - start.point).dot(&start.outward()) + radius;
    let mut lift = law.s + missing / along_normal;
    if curves.follower.quantity() == Quantity::Length {
        return Some(lift);
    }
    let (mut before, mut gap_before) = (law.s, -missing);
    for _ in 0..LIFT_STEPS {
        let curve = curves.follower.touch(parameter, &Jet { s: lift, ..law }).curve;
        let here = (curve.point - centre).dot(&curve.outward()) - radius;
        let step = here * (lift - before) / (here - gap_before);
        (before, gap_before) = (lift, here);
        if here.abs() <= TOUCHING * start.point.norm() || !step.is_finite() {
            break;
        }
        lift -= step;
    }
    Some(lift)
}

/// The largest sizes of velocity and acceleration of a motion where its follower runs, by the angle of the shaft that gives the time.
#[must_use]
pub fn largest_rates(motion: &dyn Motion) -> [f64; 2] {
    if let Some(program) = motion.program() {
        // The motion knows the peaks of its segments, and its shaft turns evenly.
        let segments = program.segments();
        return [0, 1].map(|order| segments.iter().map(|segment| segment.peaks[order].0).fold(0.0, f64::max));
    }
    let mut known = [SearchStart::nothing(0.0); 2];
    for (index, piece) in own_pieces(motion).filter(|(index, piece)| !piece.dwell && motion.is_rolled(*index)) {
        let range = (piece.start, piece.end);
        let [v, a] = &mut known;
        v.best = chebyshev::largest_size(|at| motion.jet(index, at).ds * motion.pace(at).0, range, *v);
        a.best = chebyshev::largest_size(
            |at| {
                let (jet, (first, second)) = (motion.jet(index, at), motion.pace(at));
                jet.dds * first * first + jet.ds * second
            },
            range,
            *a,
        );
    }
    // A follower that always rests has no peaks.
    known.map(|known| known.best.value.max(0.0))
}

#[cfg(test)]
mod tests;
