//! A follower on the curve that a control makes of a table of points: the errors of its velocity and acceleration.
//!
//! A table gives the profile, the path of the roller's centre, or the path of a cutter. A cutter cuts a parallel of the
//! given curve, and the follower's own curve is a parallel of that: headings are the same, radii of curvature differ by the
//! distance. So each point of the interpolated curve, with its tangent and curvature, gives the place of the follower, and the
//! circle of curvature on which its curve runs there; lift, velocity and acceleration follow as on an arc (`followed`). There is
//! no approximation to first order, and polar splines need not be cubics of x and y.
//!
//! At a row where the curve has a corner the follower turns about it, or jumps to the next interval before the end of this one:
//! in both cases the velocity stays between the values at the ends of the intervals. Where a row occurs twice since the acceleration jumps
//! there, the two splines differ in their headings by no more than their errors, so that the velocity steps by at most twice its
//! error; the jump of the acceleration is early or late by the same amount, and each spline is judged by its own side of it.

use super::Curves;
use super::followed::{Guide, HAIR, PieceRange, jet_on_guide, largest_rates, nearest, parts};
use crate::follower::Element;
use crate::geometry::points::{Interpolant, MotionErrors};
use crate::geometry::{CurvePoint, MILLIMETRES, STRAIGHT};
use crate::motion::Jet;
use crate::numeric::chebyshev::{self, SearchStart};
use crate::numeric::extremum::Extremum;
use crate::numeric::root;

/// Errors are found to this share of those at the ends and in the middle of an interval, but not closer than to this share of the
/// largest velocity and acceleration, which is rounding.
const SHARE: f64 = 1e-5;
const ROUNDING: f64 = 1e-8;
/// A break of the motion this near to the end of an interval, as a share of it, counts as at the end.
const AT_END: f64 = 1e-3;
/// Accuracy of the place of a break of the motion, as a share of the interval.
const ROOT: f64 = 1e-12;
/// Distance from a point of the exact curve at which the motion on both sides of it is evaluated, rad or m.
const ASIDE: f64 = 1e-6;

/// A follower on interpolated curves.
#[derive(Debug)]
pub struct FollowerOnTable<'a> {
    curves: Curves<'a>,
    /// Distance from the given curve out to that of the follower, m; negative where it lies within.
    out: f64,
    /// The largest velocity and acceleration of the motion.
    largest: [f64; 2],
}

/// An interval with the corresponding range of the motion.
struct IntervalRun<'i> {
    curve: &'i Interpolant,
    interval: usize,
    range: (f64, f64),
    /// The motion's parameter at both ends.
    parameters: (f64, f64),
}

impl<'a> FollowerOnTable<'a> {
    /// A follower on curves that represent the parallel of the follower's curve at this distance inwards, m: the radius of the roller
    /// for a profile, 0 for the path of its centre.
    #[must_use]
    pub fn new(curves: Curves<'a>, inwards: f64) -> Self {
        Self { curves, out: inwards, largest: largest_rates(curves.motion) }
    }

    /// The motion's parameter at which the follower touches the point of the profile for a point of the curve, mm.
    fn parameter(&self, point: &CurvePoint) -> f64 {
        let normal = point.outward();
        self.curves.follower.parameter_of(point.point / MILLIMETRES + normal * self.out, normal)
    }

    /// This parameter, moved by whole periods to be as near as possible to another.
    fn parameter_near(&self, point: &CurvePoint, to: f64) -> f64 {
        let parameter = self.parameter(point);
        nearest(parameter, to, self.curves.motion.period())
    }

    /// The guide of the follower's curve at a point; `None` where its parallel turns back.
    fn guide(&self, point: &CurvePoint) -> Option<Guide> {
        let (normal, curvature) = (point.outward(), point.curvature * MILLIMETRES);
        if !(1.0 + curvature * self.out > 0.0) {
            return None;
        }
        let on = point.point / MILLIMETRES;
        if curvature.abs() < STRAIGHT {
            return (self.curves.element() != Element::Face).then(|| Guide::Line(on + normal * self.out, normal));
        }
        let radius = 1.0 / curvature;
        let own = radius + self.out;
        let own = if self.curves.element() == Element::Face { own } else { own.abs() };
        Some(Guide::Circle(on - normal * radius, own))
    }

    /// Errors of velocity and acceleration where a guide is followed, by the angle of the shaft; infinite where it cannot be.
    fn off(&self, part: &PieceRange, parameter: f64, guide: Option<Guide>) -> [f64; 2] {
        let motion = self.curves.motion;
        let Some(piece) = motion.pieces().get(part.piece) else { return [f64::INFINITY; 2] };
        let inside = (parameter + part.shift).clamp(piece.start, piece.end);
        let law = motion.jet(part.piece, inside);
        let Some(cut) = guide.and_then(|guide| jet_on_guide(self.curves, inside, law, guide)) else {
            return [f64::INFINITY; 2];
        };
        let (first, second) = motion.pace(inside);
        let velocity = cut.ds - law.ds;
        [velocity * first, (cut.dds - law.dds) * first * first + velocity * second]
    }

    /// The errors at a parameter of an interval.
    fn off_at(&self, run: &IntervalRun<'_>, part: &PieceRange, at: f64) -> [f64; 2] {
        let Some(point) = run.curve.point_at(run.interval, at) else { return [f64::INFINITY; 2] };
        self.off(part, self.parameter_near(&point, run.near(at)), self.guide(&point))
    }

    /// The largest errors of an interval.
    fn interval(&self, curve: &Interpolant, interval: usize, wanted: [bool; 2]) -> [f64; 2] {
        const NOT_FOLLOWED: [f64; 2] = [f64::INFINITY; 2];
        let Some(range) = curve.range(interval).filter(|(from, to)| from < to) else { return [0.0; 2] };
        let (Some(first), Some(last)) = (curve.point_at(interval, range.0), curve.point_at(interval, range.1)) else {
            return NOT_FOLLOWED;
        };
        if curve.is_straight() && self.curves.element() == Element::Face {
            return self.on_chord(&first, &last);
        }
        let from = self.parameter(&first);
        let turn = libm::atan2(first.point.perp(&last.point), first.point.dot(&last.point));
        let to = self.parameter_near(&last, from + turn);
        let run = IntervalRun { curve, interval, range, parameters: (from, to) };
        if !(to - from > HAIR) {
            // An interval that the follower passes in no time has no errors.
            return if to - from > -HAIR { [0.0; 2] } else { NOT_FOLLOWED };
        }
        let mut worst = [0.0_f64; 2];
        let parts = own_parts(parts(self.curves.motion, (from, to)).collect(), AT_END * (to - from));
        for part in parts.into_iter().filter(|part| self.curves.motion.is_rolled(part.piece)) {
            let range = (run.place(self, part.from), run.place(self, part.to));
            let errors = self.largest_of(&run, &part, range.0, range.1, wanted);
            worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
        }
        worst
    }

    /// The largest errors on a part of an interval, of the kinds that are wanted.
    fn largest_of(&self, run: &IntervalRun<'_>, part: &PieceRange, low: f64, high: f64, wanted: [bool; 2]) -> [f64; 2] {
        let places = [low, 0.5 * (low + high), high];
        let seen = places.map(|at| self.off_at(run, part, at));
        [0, 1].map(|kind: usize| {
            if !wanted[kind] {
                return 0.0;
            }
            let seen = seen.iter().map(|errors| errors[kind].abs()).fold(0.0, f64::max);
            let negligible = (SHARE * seen).max(ROUNDING * self.largest[kind]);
            let known = SearchStart { best: Extremum { at: low, value: seen }, negligible };
            if seen.is_finite() {
                chebyshev::largest_size(|at| self.off_at(run, part, at)[kind], (low, high), known).value
            } else {
                f64::INFINITY
            }
        })
    }

    /// A flat face on a chord touches its ends only: at the heading of the chord the contact moves from one end to the other.
    fn on_chord(&self, first: &CurvePoint, last: &CurvePoint) -> [f64; 2] {
        let errors = [first, last].map(|point| {
            let parameter = self.parameter(point);
            let (piece, inside) = self.curves.motion.locate(parameter);
            if !self.curves.motion.is_rolled(piece) {
                return 0.0;
            }
            let part = PieceRange { from: inside, to: inside, piece, shift: 0.0 };
            let corner = point.point / MILLIMETRES + point.outward() * self.out;
            self.off(&part, inside, Some(Guide::Circle(corner, 0.0)))[0].abs()
        });
        [errors[0].max(errors[1]), f64::INFINITY]
    }
}

impl IntervalRun<'_> {
    /// The approximate parameter of the motion at a parameter of the interval.
    fn near(&self, at: f64) -> f64 {
        let share = (at - self.range.0) / (self.range.1 - self.range.0);
        self.parameters.0 + share * (self.parameters.1 - self.parameters.0)
    }

    /// The parameter of the interval at which the motion's is reached.
    fn place(&self, on: &FollowerOnTable<'_>, parameter: f64) -> f64 {
        if parameter <= self.parameters.0 {
            return self.range.0;
        }
        if parameter >= self.parameters.1 {
            return self.range.1;
        }
        let exactly = ROOT * (self.range.1 - self.range.0);
        root::bracketed(
            |at| {
                let point = self.curve.point_at(self.interval, at);
                point.map_or(f64::NAN, |point| on.parameter_near(&point, self.near(at)) - parameter)
            },
            self.range.0,
            self.range.1,
            exactly,
        )
        .unwrap_or(self.range.1)
    }
}

/// The parts of an interval; a part at its end that is shorter than `least` is joined to its neighbour.
fn own_parts(mut parts: Vec<PieceRange>, least: f64) -> Vec<PieceRange> {
    if parts.len() > 1 && parts.last().is_some_and(|part| part.to - part.from < least) {
        let end = parts.pop().map(|part| part.to);
        if let (Some(part), Some(end)) = (parts.last_mut(), end) {
            part.to = end;
        }
    }
    if parts.len() > 1 && parts.first().is_some_and(|part| part.to - part.from < least) {
        let start = parts.remove(0).from;
        if let Some(part) = parts.first_mut() {
            part.from = start;
        }
    }
    parts
}

/// The errors of this many intervals, up to the first that exceeds a limit.
pub fn up_to(count: usize, limit: [f64; 2], errors: impl Fn(usize) -> [f64; 2]) -> Vec<[f64; 2]> {
    let mut all = Vec::with_capacity(count);
    for interval in 0..count {
        let own = errors(interval);
        all.push(own);
        if !(own[0] <= limit[0] && own[1] <= limit[1]) {
            break;
        }
    }
    all
}

impl MotionErrors for FollowerOnTable<'_> {
    fn errors(&self, curve: &Interpolant, wanted: [bool; 2], limit: [f64; 2]) -> Vec<[f64; 2]> {
        up_to(curve.count(), limit, |interval| self.interval(curve, interval, wanted))
    }

    fn step(&self, at: &CurvePoint) -> f64 {
        let (motion, parameter) = (self.curves.motion, self.parameter(at));
        let [after, before] = [ASIDE, -ASIDE].map(|away| {
            let (piece, inside) = motion.locate(parameter + away);
            let jet: Jet = motion
                .pieces()
                .get(piece)
                .map_or_else(Jet::default, |own| motion.jet(piece, (inside - away).clamp(own.start, own.end)));
            let (first, second) = motion.pace(inside - away);
            jet.dds * first * first + jet.ds * second
        });
        (after - before).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::follower::TranslatingRoller;
    use crate::geometry::points::{PointCoordinates, PointInterpolation};
    use crate::motion::EccentricCircle;
    use nalgebra::Vector2;
    use std::f64::consts::TAU;

    /// A roller of any size on the tables of a circle about (e, 0) of another radius: its centre keeps a circle of radius ρ + δ, on
    /// which s = √(ρ'² − e² sin²θ) + e cos θ − …, and the errors are those of two such lifts.
    #[test]
    fn a_larger_circle_has_the_errors_of_the_closed_form() {
        let (e, rho, grown) = (0.012, 0.06, 1e-3);
        let motion = EccentricCircle::new(e, rho);
        let follower = TranslatingRoller::new(rho - e, 0.0, 0.015);
        let curves = Curves { motion: &motion, follower: &follower };
        let lift = |radius: f64, angle: f64| {
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let root = (radius * radius - e * e * sin * sin).sqrt();
            let slope = -e * e * sin * cos / root;
            let bend = (-e * e * (cos * cos - sin * sin) - slope * slope) / root;
            [slope - e * sin, bend - e * cos]
        };
        let worst = (0..36_000).map(|i| TAU * f64::from(i) / 36e3).fold([0.0_f64; 2], |worst, angle| {
            let (own, cut) = (lift(rho, angle), lift(rho + grown, angle));
            [worst[0].max((cut[0] - own[0]).abs()), worst[1].max((cut[1] - own[1]).abs())]
        });
        for inwards in [0.0, 0.015, 0.005, -0.02] {
            let radius = rho + grown - inwards;
            let row = |i: u32| {
                let angle = TAU * f64::from(i) / 7200.0;
                [1e3 * (e + radius * libm::cos(angle)), 1e3 * radius * libm::sin(angle)]
            };
            let mut rows: Vec<[f64; 2]> = (0..7200).map(row).collect();
            rows.extend(rows.first().copied());
            let curve = Interpolant::new(&rows, PointCoordinates::Plane, PointInterpolation::Cubic, true);
            let errors = FollowerOnTable::new(curves, inwards).errors(&curve, [true; 2], [f64::INFINITY; 2]);
            let found = errors.iter().fold([0.0_f64; 2], |worst, own| [worst[0].max(own[0]), worst[1].max(own[1])]);
            for (found, worst) in found.iter().zip(worst) {
                assert!((found / worst - 1.0).abs() < 1e-3, "{inwards}: {found} {worst}");
            }
        }
    }

    #[test]
    fn the_step_of_a_smooth_motion_is_zero() {
        let motion = EccentricCircle::new(0.012, 0.06);
        let follower = TranslatingRoller::new(0.048, 0.0, 0.015);
        let on = FollowerOnTable::new(Curves { motion: &motion, follower: &follower }, 0.0);
        let at = CurvePoint {
            point: Vector2::new(72.0, 0.0),
            tangent: Vector2::new(0.0, 1.0),
            speed: 1.0,
            curvature: 1.0 / 60.0,
            curvature_slope: 0.0,
        };
        assert!(on.step(&at) < 1e-9);
    }
}
