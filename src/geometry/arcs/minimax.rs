//! The least deviation that a chain of so many arcs can have.
//!
//! Counted from the curve, the deviations e of a chain are very nearly linear in the freedoms x of its joints, so that the
//! least largest deviation is almost a linear program,
//!
//! ```text
//! min t,   −t ≤ e + J x ≤ t at every node,   c + A x = 0,
//! ```
//!
//! c the openings of the joints, whose matrices are narrow bands along the chain. It is solved by a primal-dual interior
//! point method (Wright, Primal-Dual Interior-Point Methods, 1997, chapters 1 and 5): each step computes deviations and
//! derivatives again, so that it is a step for the curve as well as for the program. The first chain within the tolerance
//! is taken. Where there is none the dual value, a lower bound once its own conditions are met, shows it before the
//! steps run out; it only saves time.

use super::nodes::Node;
use super::trial::{Link, Place, Step, Trial, place_of};
use super::{Joint, Target};
use crate::numeric::banded::Banded;
use crate::numeric::extremum::larger;
use nalgebra::{Matrix4, Vector2, Vector4};

/// Most steps: of 1552 chains that exist all were found within twelve.
const MOST_STEPS: u32 = 14;
/// The level starts so far above the largest deviation, and is kept so far above it.
const ROOM: (f64, f64) = (10.0, 1.02);
/// Share of the mean product of slack and multiplier that a step aims at.
const CENTRE: f64 = 0.2;
/// Share of the way to the boundary that a step may take.
const BOUNDARY: f64 = 0.95;
/// Longest step of a joint along the curve, in the shorter chord beside it.
const LONGEST_STEP: f64 = 0.4;
/// Weight of the three freedoms: between two arcs of one curvature a joint may lie anywhere.
const STAY: [f64; 3] = [0.1, 1e-9, 1e-9];
/// Weight of the multipliers, which keeps the pivots from zero.
const GIVE: f64 = 1e-9;
/// What closing may add to the deviation, as a share of the widest opening: above, it is not tried.
const CLOSING: f64 = 0.1;
/// The dual value is trusted once the chain is open by less: wider, it says little about chains that are closed.
const TELLING: f64 = 2.0;

/// What is compared at a node, with what is allowed of it.
#[derive(Debug, Clone, Copy)]
enum Kept {
    /// The distance.
    Distance,
    /// The heading, with the tangent of the curve, rad.
    Heading(Vector2<f64>, f64),
    /// The curvature.
    Curvature(f64, f64),
}

/// A node with what the method keeps about it.
#[derive(Debug)]
struct Sample {
    point: Vector2<f64>,
    parameter: f64,
    kept: Kept,
    /// 1, a, b, a² + b², see [`crate::geometry::arcs::nodes::Arc::seen_from`], or what these become by the length or in the
    /// curvature.
    basis: Vector4<f64>,
    /// Deviation in tolerances.
    off: f64,
    /// Distances from the level and its negative, and their multipliers.
    sides: [Slack; 2],
}

/// One of the two conditions of a sample.
#[derive(Debug, Clone, Copy)]
struct Slack {
    distance: f64,
    multiplier: f64,
    /// Change of the multiplier in this step.
    change: f64,
}

/// The curvature, or the heading, that is kept at a joint of an arc.
#[derive(Debug, Clone, Copy)]
struct End {
    /// Which of [`Trial::bends`].
    bend: usize,
    off: f64,
    off_by: [f64; 6],
    sides: [Slack; 2],
}

/// The samples of a piece, what is kept at the joints of every arc, and the tolerance.
struct Program {
    samples: Vec<Sample>,
    ends: Vec<Vec<End>>,
    tolerance: f64,
}

/// Newton's system for a step: the band, the right side, the border of the level with its corner, and what the multipliers of the
/// level exceed their sum by.
struct System {
    matrix: Banded<8>,
    right: Vec<f64>,
    border: Vec<f64>,
    corner: f64,
    excess: f64,
}

/// Joints of a chain within `tolerance` at the nodes, from a first guess; `None` when none was found.
pub(super) fn relax(
    target: &impl Target,
    nodes: &[Node],
    tolerance: f64,
    mut places: Vec<Place>,
) -> Option<Vec<Joint>> {
    let mut program = Program::new(nodes, places.len() - 1, tolerance);
    let mut level = None;
    for _ in 0..MOST_STEPS {
        let trial = Trial::new(target, &places, tolerance)?;
        let (worst, open) = (program.measure(&trial), trial.open());
        if !worst.is_finite() {
            return None;
        }
        if worst + CLOSING * open <= 1.0
            && let Some(closed) = trial.closed(target, tolerance)
        {
            if program.measure(&closed) <= 1.0 {
                return Some(closed.joints());
            }
            program.measure(&trial);
        }
        let top = level.map_or(ROOM.0 * worst, |level: f64| level.max(ROOM.1 * worst));
        let (gap, aim) = program.slacks(top, trial.links.len());
        if open < TELLING && top - gap > 1.0 {
            return None;
        }
        let (step, rise) = program.direction(&trial, aim);
        let (primal, dual) = program.shares(&trial, &step, rise, aim);
        let primal = primal.min(trial.careful(&step, LONGEST_STEP));
        let ends = program.ends.iter_mut().flatten().flat_map(|end| &mut end.sides);
        for side in program.samples.iter_mut().flat_map(|sample| &mut sample.sides).chain(ends) {
            side.multiplier += dual * side.change;
        }
        places = trial.moved(&step, primal, tolerance);
        level = Some(top + primal * rise);
    }
    None
}

impl Program {
    fn new(nodes: &[Node], arcs: usize, tolerance: f64) -> Self {
        let kept = |(index, &node): (usize, &Node)| {
            // Between the joints the curvature is farthest off where that of the curve turns back.
            let other = index.checked_sub(1).and_then(|before| nodes.get(before)).or(nodes.get(index + 1));
            let turns = other.is_some_and(|other| other.best_heading.signum() != node.best_heading.signum());
            let heading = node.allowed.heading.is_finite().then_some(Kept::Heading(node.tangent, node.allowed.heading));
            let curvature = (turns && node.allowed.curvature.is_finite())
                .then_some(Kept::Curvature(node.curvature, node.allowed.curvature));
            let all = [Some(Kept::Distance), heading, curvature];
            all.into_iter().flatten().map(move |kept| (node.point, node.parameter, kept))
        };
        let all: Vec<(Vector2<f64>, f64, Kept)> = nodes.iter().enumerate().flat_map(kept).collect();
        let bent = nodes.iter().any(|node| node.allowed.curvature.is_finite());
        let turned = nodes.iter().any(|node| node.allowed.heading.is_finite());
        let kept: Vec<usize> =
            [bent, bent, turned].into_iter().zip(0..).filter_map(|(is, bend)| is.then_some(bend)).collect();
        #[expect(clippy::cast_precision_loss, reason = "below the largest number of nodes")]
        let multiplier = 0.5 * arcs as f64 / (all.len() + kept.len() * arcs) as f64;
        let sides = [Slack { distance: 0.0, multiplier, change: 0.0 }; 2];
        let sample =
            |(point, parameter, kept)| Sample { point, parameter, kept, basis: Vector4::zeros(), off: 0.0, sides };
        let ends: Vec<End> = kept.into_iter().map(|bend| End { bend, off: 0.0, off_by: [0.0; 6], sides }).collect();
        let ends = if ends.is_empty() { Vec::new() } else { vec![ends; arcs] };
        Self { samples: all.into_iter().map(sample).collect(), ends, tolerance }
    }

    /// Every arc with its samples, up to the foot of its end.
    fn by_arc<'a>(&'a mut self, trial: &'a Trial) -> impl Iterator<Item = (&'a Link, &'a mut [Sample])> {
        let mut rest = self.samples.as_mut_slice();
        trial.links.iter().zip(trial.parameters().skip(1)).map(move |(link, end)| {
            let all = std::mem::take(&mut rest);
            // The last joint is the last sample.
            let count = all.iter().take_while(|sample| sample.parameter <= end).count();
            let (mine, others) = all.split_at_mut(count);
            rest = others;
            (link, mine)
        })
    }

    /// Computes the deviation at every sample, and returns the largest, in tolerances.
    fn measure(&mut self, trial: &Trial) -> f64 {
        let tolerance = self.tolerance;
        let mut worst = 0.0_f64;
        for (link, samples) in self.by_arc(trial) {
            for sample in samples {
                sample.measure(link, tolerance);
                worst = larger(worst, sample.off.abs());
            }
        }
        for (index, ends) in self.ends.iter_mut().enumerate() {
            let bends = trial.bends(index, tolerance);
            for end in ends {
                if let Some(bend) = bends.as_ref().and_then(|bends| bends.get(end.bend)) {
                    (end.off, end.off_by) = (bend.off, bend.off_by);
                }
                worst = larger(worst, end.off.abs());
            }
        }
        worst
    }

    /// Computes the slacks below a level, and returns how far the dual value lies below it, and the product of slack and
    /// multiplier to aim at.
    fn slacks(&mut self, level: f64, arcs: usize) -> (f64, f64) {
        let mut product = 0.0;
        let ends = self.ends.iter_mut().flatten().map(|end| (end.off, &mut end.sides));
        for (off, sides) in self.samples.iter_mut().map(|sample| (sample.off, &mut sample.sides)).chain(ends) {
            for (side, distance) in sides.iter_mut().zip([level - off, level + off]) {
                side.distance = distance;
                product += distance * side.multiplier;
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "below the largest number of nodes")]
        let (arcs, count) =
            (arcs as f64, 2.0 * (self.samples.len() + self.ends.iter().map(Vec::len).sum::<usize>()) as f64);
        (product / arcs, CENTRE * product / count)
    }

    /// Newton's step for the freedoms and the multipliers of the openings, and for the level.
    ///
    /// The multipliers of the samples are eliminated; the level is a border of the band.
    fn direction(&mut self, trial: &Trial, aim: f64) -> (Step, f64) {
        let arcs = trial.links.len();
        let mut matrix = Banded::<8>::zero(4 * arcs);
        let mut right = vec![0.0; 4 * arcs];
        let mut border = vec![0.0; 4 * arcs];
        #[expect(clippy::cast_precision_loss, reason = "below the largest number of nodes")]
        let (mut corner, mut excess) = (0.0, -(arcs as f64));
        for (index, (link, samples)) in self.by_arc(trial).enumerate() {
            let mut moments = Matrix4::zeros();
            let (mut push, mut pull) = (Vector4::zeros(), Vector4::zeros());
            for sample in samples {
                let [(force, stiff), (back, stiff_back)] =
                    sample.sides.map(|side| (aim / side.distance, side.multiplier / side.distance));
                moments += sample.basis * (sample.basis * (stiff + stiff_back)).transpose();
                push += sample.basis * (force - back);
                pull += sample.basis * (stiff - stiff_back);
                corner += stiff + stiff_back;
                excess += force + back;
            }
            let multiplier = 4 * index + 3;
            let freedoms = link.freedoms(index, arcs);
            for (row, open_by, off_by) in freedoms.clone() {
                let weighted = moments * off_by;
                for (column, _, other) in freedoms.clone().filter(|(column, ..)| *column >= row) {
                    matrix.add(row, column, weighted.dot(other));
                }
                matrix.add(row, multiplier, open_by);
                for (value, amount) in [(&mut right, push.dot(off_by)), (&mut border, pull.dot(off_by))] {
                    if let Some(value) = value.get_mut(row) {
                        *value -= amount;
                    }
                }
            }
            for (row, stay) in (4 * index..).zip(STAY) {
                // The last joint is fixed; its rows hold nothing else.
                matrix.add(row, row, if index + 1 == arcs { 1.0 } else { stay });
            }
            matrix.add(multiplier, multiplier, -GIVE);
            if let Some(value) = right.get_mut(multiplier) {
                *value = -link.open;
            }
        }
        let mut system = System { matrix, right, border, corner, excess };
        self.press_ends(&mut system, aim, arcs);
        let System { matrix, mut right, mut border, corner, excess } = system;
        let factors = matrix.factored();
        let edge = border.clone();
        factors.solve(&mut right);
        factors.solve(&mut border);
        let dot = |values: &[f64]| edge.iter().zip(values).map(|(a, b)| a * b).sum::<f64>();
        let rise = (excess - dot(&right)) / (corner - dot(&border));
        (Step(right.iter().zip(&border).map(|(r, b)| r - b * rise).collect()), rise)
    }

    /// The part of Newton's step that keeps the curvature at the joints.
    fn press_ends(&self, system: &mut System, aim: f64, arcs: usize) {
        let ends = self.ends.iter().enumerate().flat_map(|(index, ends)| ends.iter().map(move |end| (index, end)));
        for (index, end) in ends {
            let [(force, stiff), (back, stiff_back)] =
                end.sides.map(|side| (aim / side.distance, side.multiplier / side.distance));
            system.corner += stiff + stiff_back;
            system.excess += force + back;
            let freedoms = end.off_by.iter().enumerate();
            let freedoms = freedoms.filter_map(|(freedom, by)| Some((place_of(freedom, index, arcs)?, *by)));
            for (row, by) in freedoms.clone() {
                for (column, other) in freedoms.clone().filter(|(column, _)| *column >= row) {
                    system.matrix.add(row, column, (stiff + stiff_back) * by * other);
                }
                let sums = [(&mut system.right, (force - back) * by), (&mut system.border, (stiff - stiff_back) * by)];
                for (value, amount) in sums {
                    if let Some(value) = value.get_mut(row) {
                        *value -= amount;
                    }
                }
            }
        }
    }

    /// Shares of a step that slacks and multipliers allow; the changes of the multipliers are kept with the samples.
    fn shares(&mut self, trial: &Trial, step: &Step, rise: f64, aim: f64) -> (f64, f64) {
        let (mut primal, mut dual) = (1.0_f64, 1.0_f64);
        let mut allow = |sides: &mut [Slack; 2], off: f64| {
            for (side, moved) in sides.iter_mut().zip([rise - off, rise + off]) {
                side.change = (aim - side.multiplier * moved) / side.distance - side.multiplier;
                if moved < 0.0 {
                    primal = primal.min(-BOUNDARY * side.distance / moved);
                }
                if side.change < 0.0 {
                    dual = dual.min(-BOUNDARY * side.multiplier / side.change);
                }
            }
        };
        for (index, (_, samples)) in self.by_arc(trial).enumerate() {
            let change = trial.change(index, step);
            for sample in samples {
                allow(&mut sample.sides, sample.basis.dot(&change));
            }
        }
        let arcs = trial.links.len();
        for (index, ends) in self.ends.iter_mut().enumerate() {
            for end in ends {
                let by = end.off_by.iter().enumerate();
                let moved = |(freedom, by): (usize, &f64)| Some(by * step.0.get(place_of(freedom, index, arcs)?)?);
                allow(&mut end.sides, by.filter_map(moved).sum());
            }
        }
        (primal, dual)
    }
}

impl Sample {
    /// Computes what is kept, in what is allowed of it, and its basis.
    fn measure(&mut self, link: &Link, tolerance: f64) {
        let (basis, distance) = link.arc.seen_from(self.point);
        (self.basis, self.off) = match self.kept {
            Kept::Distance => (basis, distance / tolerance),
            Kept::Heading(tangent, allowed) => {
                let arc = &link.arc;
                let (along, across) = (arc.heading.dot(&tangent), arc.heading.perp(&tangent));
                let [_, a, b, square] = basis.data.0[0];
                // The gradient of the distance along the curve's tangent is the sine between the two.
                let gradient = (1.0 - arc.curvature * (2.0 * b - arc.curvature * square)).max(f64::MIN_POSITIVE).sqrt();
                let off = (across - arc.curvature * (a * along + b * across)) / gradient;
                let basis = Vector4::new(0.0, along, across, 2.0 * (a * along + b * across)) * (tolerance / allowed);
                (basis, off / allowed)
            }
            Kept::Curvature(curvature, allowed) => {
                (Vector4::new(0.0, 0.0, 0.0, -2.0 * tolerance / allowed), (link.arc.curvature - curvature) / allowed)
            }
        };
    }
}
