//! A chain of arcs by the places of its joints, with derivatives.
//!
//! A joint is free in three ways: along the curve, across it, and in its heading. An arc is given by both of its points and
//! the heading at its start; the chain is tangent when its other heading has the same angle with the chord.

use super::nodes::{CurveSample, TangentArc};
use super::{ArcJoint, FitTarget};
use crate::geometry::{ChainTolerance, CurvePoint};
use crate::numeric::banded::BandedMatrix;
use crate::numeric::extremum::larger;
use nalgebra::{Vector2, Vector4};

/// Newton steps that close a chain to rounding: each squares the openings.
const CLOSING_STEPS: u32 = 4;
/// A chain counts as closed when no heading differs by more, rad: half of the accuracy promised for the joints.
const CLOSED: f64 = 5e-10;
/// Additional difference of a heading, in roundings of a coordinate.
const ROUNDINGS: f64 = 4.0;
/// Below this no further step helps, rad.
const ROUNDING: f64 = 1e-13;

/// A joint by its place along the curve, its offset to the left and the tangent of its heading relative to the curve's.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointPlace {
    pub(super) parameter: f64,
    pub(super) offset: f64,
    pub(super) slope: f64,
}

impl JointPlace {
    /// On the curve, with its heading.
    pub(super) fn on_curve(node: &CurveSample) -> Self {
        Self { parameter: node.parameter, offset: 0.0, slope: 0.0 }
    }
}

/// A joint in the plane.
#[derive(Debug)]
struct PlaneJoint {
    place: JointPlace,
    frame: CurvePoint,
    point: Vector2<f64>,
    heading: Vector2<f64>,
    allowed: ChainTolerance,
    /// Half the sum of its two chords, the length in which its freedoms are measured.
    length: f64,
    /// Whether it is at an end of the piece, where it has no freedoms.
    held: bool,
}

impl PlaneJoint {
    fn new(target: &impl FitTarget, place: JointPlace) -> Self {
        let (frame, allowed) = target.point_and_tolerance(place.parameter);
        let left = -frame.outward();
        let heading = (frame.tangent + left * place.slope).normalize();
        Self { place, frame, point: frame.point + left * place.offset, heading, allowed, length: 0.0, held: false }
    }

    /// Change of the point and of the angle of the heading with the three freedoms: along the curve by the length, across
    /// it by the tolerance, in heading by the tolerance over the length; 0 where it is fixed.
    fn freedoms(&self, tolerance: f64) -> [(Vector2<f64>, f64); 3] {
        if self.held {
            return [(Vector2::zeros(), 0.0); 3];
        }
        let shrunk = 1.0 - self.frame.curvature * self.place.offset;
        let turn = tolerance / self.length / (1.0 + self.place.slope * self.place.slope);
        [
            (self.frame.tangent * (self.length * shrunk), self.frame.curvature * self.length),
            (-self.frame.outward() * tolerance, 0.0),
            (Vector2::zeros(), turn),
        ]
    }

    /// The place after a step of the freedoms.
    fn moved(&self, [along, across, turn, _]: [f64; 4], share: f64, tolerance: f64) -> JointPlace {
        let JointPlace { parameter, offset, slope } = self.place;
        JointPlace {
            parameter: parameter + share * along * self.length / self.frame.speed,
            offset: offset + share * across * tolerance,
            slope: slope + share * turn * tolerance / self.length,
        }
    }
}

/// An arc of the chain with its derivatives by the six freedoms of its two joints, 0 by those of a fixed joint.
#[derive(Debug)]
pub(super) struct ChainArc {
    pub(super) arc: TangentArc,
    chord: f64,
    /// Half the difference of the angles of headings and chord, in tolerances over the chord, and its derivatives, both to
    /// first order in the opening.
    pub(super) open: f64,
    pub(super) open_by: [f64; 6],
    /// Derivatives of the deviation, in tolerances, as factors of 1, a, b, a² + b², see [`TangentArc::basis_at`].
    pub(super) off_by: [Vector4<f64>; 6],
}

impl ChainArc {
    fn new(start: &PlaneJoint, end: &PlaneJoint, tolerance: f64) -> Option<Self> {
        let v = end.point - start.point;
        let (square, chord) = (v.norm_squared(), v.norm());
        let (arc, _) = TangentArc::to(start.point, start.heading, end.point)?;
        let TangentArc { heading, curvature, bulge, .. } = arc;
        let unit = chord / tolerance;
        let arrival = v.perp(&end.heading) / (chord + v.dot(&end.heading));
        let open = unit * (arrival - bulge) / (1.0 + arrival * bulge);
        // Of κ = 2 h × v/v².
        let bend = |dv: Vector2<f64>, turn: f64| {
            2.0 * (heading.perp(&dv) - heading.dot(&v) * turn - curvature * v.dot(&dv)) / square
        };
        let mut link = Self { arc, chord, open, open_by: [0.0; 6], off_by: [Vector4::zeros(); 6] };
        let mut targets = link.open_by.iter_mut().zip(&mut link.off_by);
        for ((step, turn), (open_by, off_by)) in start.freedoms(tolerance).into_iter().zip(&mut targets) {
            let (along, across) = (heading.dot(&step), heading.perp(&step));
            *open_by = unit * (0.5 * turn + v.perp(&step) / square);
            *off_by = Vector4::new(-across, curvature * along - turn, curvature * across, -0.5 * bend(-step, turn))
                / tolerance;
        }
        for ((step, turn), (open_by, off_by)) in end.freedoms(tolerance).into_iter().zip(targets) {
            *open_by = unit * (0.5 * turn - v.perp(&step) / square);
            *off_by = Vector4::new(0.0, 0.0, 0.0, -0.5 * bend(step, 0.0)) / tolerance;
        }
        Some(link)
    }
}

/// By how much an arc misses the curvature, or the heading, of the curve at one of its joints, over the allowed error, and its
/// derivatives by the six freedoms.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointMiss {
    pub(super) off: f64,
    pub(super) off_by: [f64; 6],
}

/// A step of every freedom of a chain: four numbers per joint, its three freedoms and the multiplier of the opening of the arc that ends
/// there.
#[derive(Debug, Clone)]
pub(super) struct ChainStep(pub(super) Vec<[f64; 4]>);

impl ChainStep {
    /// The six freedoms of both joints of an arc.
    pub(super) fn of_arc(&self, index: usize) -> [f64; 6] {
        match self.0.get(index..).unwrap_or_default() {
            [[a, b, c, _], [d, e, f, _], ..] => [*a, *b, *c, *d, *e, *f],
            _ => [0.0; 6],
        }
    }
}

/// A chain with its arcs.
#[derive(Debug)]
pub(super) struct ArcTrial {
    stands: Vec<PlaneJoint>,
    pub(super) links: Vec<ChainArc>,
}

impl ArcTrial {
    /// `None` when the joints are out of order or an arc is longer than half a circle.
    pub(super) fn new(target: &impl FitTarget, places: &[JointPlace], tolerance: f64) -> Option<Self> {
        if !places.is_sorted_by(|a, b| a.parameter < b.parameter) {
            return None;
        }
        let mut stands: Vec<PlaneJoint> = places.iter().map(|place| PlaneJoint::new(target, *place)).collect();
        let pairs = stands.iter().zip(stands.iter().skip(1));
        let chords: Vec<f64> = pairs.map(|(a, b)| (b.point - a.point).norm()).collect();
        let before = chords.iter().take(1).chain(&chords);
        let after = chords.iter().chain(chords.last());
        for ((stand, before), after) in stands.iter_mut().zip(before).zip(after) {
            stand.length = 0.5 * (before + after);
        }
        if let [first, .., last] = stands.as_mut_slice() {
            (first.held, last.held) = (true, true);
        }
        let pairs = stands.iter().zip(stands.iter().skip(1));
        let links =
            pairs.map(|(start, end)| ChainArc::new(start, end, tolerance)).collect::<Option<Vec<ChainArc>>>()?;
        Some(Self { stands, links })
    }

    /// Errors of the curvature at both joints of an arc, and of the heading at the later one.
    pub(super) fn joint_misses(&self, index: usize, tolerance: f64) -> Option<[JointMiss; 3]> {
        let (link, start, end) = (self.links.get(index)?, self.stands.get(index)?, self.stands.get(index + 1)?);
        let bend = |stand: &PlaneJoint, along: usize| {
            let ChainTolerance { curvature: allowed, middle, slopes: [middle_slope, growth], .. } = stand.allowed;
            let off = (link.arc.curvature - stand.frame.curvature - middle) / allowed;
            let mut off_by = link.off_by.map(|by| -2.0 * tolerance * by.w / allowed);
            // The joint moves along the curve, whose curvature changes, and what is allowed with it.
            if let Some(by) = off_by.get_mut(along).filter(|_| !stand.held) {
                *by -= (stand.frame.curvature_slope + middle_slope) * stand.length / allowed;
                *by -= off * growth * stand.length;
            }
            JointMiss { off, off_by }
        };
        let slope = end.place.slope;
        let by = if end.held { 0.0 } else { tolerance / (end.length * (1.0 + slope * slope) * end.allowed.heading) };
        let turn = JointMiss { off: libm::atan(slope) / end.allowed.heading, off_by: [0.0, 0.0, 0.0, 0.0, 0.0, by] };
        Some([bend(start, 0), bend(end, 3), turn])
    }

    /// Widest opening, in tolerances over the chord.
    pub(super) fn open(&self) -> f64 {
        self.links.iter().map(|link| link.open.abs()).fold(0.0, larger)
    }

    /// Parameters of the joints, from the start of the piece to its end.
    pub(super) fn parameters(&self) -> impl Iterator<Item = f64> {
        self.stands.iter().map(|stand| stand.place.parameter)
    }

    /// The change of the deviation from an arc with a step, as factors of the basis.
    pub(super) fn change(&self, index: usize, step: &ChainStep) -> Vector4<f64> {
        let Some(link) = self.links.get(index) else { return Vector4::zeros() };
        link.off_by.iter().zip(step.of_arc(index)).fold(Vector4::zeros(), |sum, (off_by, by)| sum + off_by * by)
    }

    /// Share of a step that moves no joint along the curve by more than `most` of its shorter chord.
    pub(super) fn step_share(&self, step: &ChainStep, most: f64) -> f64 {
        let pairs = self.links.iter().zip(self.links.iter().skip(1));
        let shares = step.0.iter().skip(1).zip(pairs).map(|([along, ..], (before, after))| {
            most * before.chord.min(after.chord) / (along.abs() * 0.5 * (before.chord + after.chord))
        });
        shares.fold(1.0, f64::min)
    }

    /// The joints after a share of a step.
    pub(super) fn moved(&self, step: &ChainStep, share: f64, tolerance: f64) -> Vec<JointPlace> {
        self.stands.iter().zip(&step.0).map(|(stand, step)| stand.moved(*step, share, tolerance)).collect()
    }

    /// The joints with the bulges of their arcs.
    pub(super) fn joints(&self) -> Vec<ArcJoint> {
        let joints = self.stands.iter().zip(&self.links).map(|(stand, link)| ArcJoint {
            point: stand.point,
            parameter: stand.place.parameter,
            bulge: link.arc.bulge,
        });
        joints.collect()
    }

    /// The chain made tangent by the least change of its freedoms; `None` where that is impossible.
    pub(super) fn closed(&self, target: &impl FitTarget, tolerance: f64) -> Option<Self> {
        let mut closed = self.closer(target, tolerance)?;
        for _ in 1..CLOSING_STEPS {
            if closed.largest_corner(tolerance) <= ROUNDING {
                break;
            }
            closed = closed.closer(target, tolerance)?;
        }
        (closed.largest_corner(tolerance) <= CLOSED).then_some(closed)
    }

    fn closer(&self, target: &impl FitTarget, tolerance: f64) -> Option<Self> {
        Self::new(target, &self.moved(&self.closing_step(), 1.0, tolerance), tolerance)
    }

    /// The largest corner between two arcs beyond rounding.
    fn largest_corner(&self, tolerance: f64) -> f64 {
        let corners = self.links.iter().map(|link| {
            // The heading of a chord that is short relative to its coordinates is rounding.
            let rounding = ROUNDINGS * f64::EPSILON * link.arc.start.norm() / link.chord;
            (link.open * tolerance / link.chord).abs() - rounding
        });
        corners.fold(0.0, larger)
    }

    /// The shortest step x with c + A x = 0: x = Aᵀ y, A Aᵀ y = −c, a tridiagonal system.
    fn closing_step(&self) -> ChainStep {
        let arcs = self.links.len();
        let mut matrix = BandedMatrix::<2>::zero(arcs);
        let mut forces: Vec<f64> = self.links.iter().map(|link| -link.open).collect();
        let mut before: Option<&ChainArc> = None;
        for (index, link) in self.links.iter().enumerate() {
            matrix.add(index, index, link.open_by.iter().map(|open_by| open_by * open_by).sum());
            if let (Some(above), Some(before)) = (index.checked_sub(1), before) {
                let shared = before.open_by.iter().skip(3).zip(&link.open_by);
                matrix.add(above, index, shared.map(|(end, start)| end * start).sum());
            }
            before = Some(link);
        }
        matrix.factored().solve(&mut forces);
        let mut step = vec![[0.0; 4]; arcs + 1];
        for ((index, link), force) in self.links.iter().enumerate().zip(&forces) {
            let both = step.iter_mut().skip(index).flat_map(|joint| joint.iter_mut().take(3));
            for (value, open_by) in both.zip(link.open_by) {
                *value += open_by * force;
            }
        }
        ChainStep(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola, so that nothing is constant.
    fn curve(t: f64) -> CurvePoint {
        let zero = Vector2::zeros();
        CurvePoint::from_derivatives(
            Vector2::new(t, 0.02 * t * t),
            Vector2::new(1.0, 0.04 * t),
            Vector2::new(0.0, 0.04),
            zero,
        )
    }

    /// Opening and deviation by every freedom of both joints, against differences of the trial itself.
    #[test]
    fn the_derivatives_are_those_of_the_chain() {
        let tolerance = 1e-3;
        let target = |t: f64| (curve(t), ChainTolerance::ANY);
        let place = |parameter, offset, slope| JointPlace { parameter, offset, slope };
        let places = [place(1.0, 0.0, 0.0), place(3.0, 4e-4, -1e-4), place(4.5, -3e-4, 2e-4), place(7.0, 0.0, 0.0)];
        let open = ArcTrial::new(&target, &places, tolerance).expect("in order");
        let trial = open.closed(&target, tolerance).expect("a chain");
        let point = curve(3.9).point;
        let of = |trial: &ArcTrial| (trial.links[1].open, trial.links[1].arc.basis_at(point).1 / tolerance);
        for freedom in 0..6 {
            let small = 1e-6;
            let mut step = ChainStep(vec![[0.0; 4]; 4]);
            step.0[1 + freedom / 3][freedom % 3] = small;
            let there = ArcTrial::new(&target, &trial.moved(&step, 1.0, tolerance), tolerance).expect("in order");
            let back = ArcTrial::new(&target, &trial.moved(&step, -1.0, tolerance), tolerance).expect("in order");
            let ((open, off), (open_back, off_back)) = (of(&there), of(&back));
            let basis = trial.links[1].arc.basis_at(point).0;
            let (by, wanted) = (trial.links[1].open_by[freedom], (open - open_back) / (2.0 * small));
            assert!((by - wanted).abs() < 1e-2 * (1.0 + wanted.abs()), "opening by {freedom}: {by} {wanted}");
            let (by, wanted) = (trial.change(1, &step).dot(&basis) / small, (off - off_back) / (2.0 * small));
            assert!((by - wanted).abs() < 1e-2 * (1.0 + wanted.abs()), "deviation by {freedom}: {by} {wanted}");
        }
    }
}
