//! The least deviation that a chain with a given number of arcs can have.
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
//! is taken. Where there is none, the dual value, a lower bound once its own conditions are met, shows it before the
//! steps run out; this only saves time.

use super::nodes::CurveSample;
use super::trial::{ArcTrial, ChainArc, ChainStep, JointPlace};
use super::{ArcJoint, FitTarget};
use crate::numeric::blocks::{BlockMatrix, BlockRows, GROUP, PAIR};
use crate::numeric::extremum::larger;
use nalgebra::{Vector2, Vector4};

/// Most steps: all of 1552 existing chains were found within twelve; ten would cost one arc in a thousand.
const MOST_STEPS: u32 = 12;
/// Where a chain exists, the largest deviation exceeds the tolerance by no more than this, in tolerances, after the first step, and falls
/// by such a factor in each further one: of 248 existing chains one came later, and half the work was for those that do not exist.
const SLOWEST: (f64, f64) = (0.9, 0.55);
/// From this step on it counts as stalled where it exceeds the tolerance by this much and by this many times what the last step gained.
const STALLS_FROM: u32 = 5;
const STALLED: (f64, f64) = (0.015, 2.0);
/// The level starts this far above the largest deviation, and is kept this far above it.
const ROOM: (f64, f64) = (2.0, 1.005);
/// Share of the mean product of slack and multiplier that a step aims at.
const CENTRE: f64 = 0.3;
/// Share of the distance to the boundary that a step may take.
const BOUNDARY: f64 = 0.95;
/// A node represents the curve as far as its third order is valid to this share of the tolerance.
const SHOWN: f64 = 0.01;
/// Longest step of a joint along the curve, as a share of its shorter chord.
const LONGEST_STEP: f64 = 0.4;
/// Weight of the three freedoms: between two arcs of equal curvature a joint may lie anywhere.
const STAY: [f64; 3] = [0.1, 1e-9, 1e-9];
/// Weight of the multipliers, which keeps the pivots from zero.
const GIVE: f64 = 1e-9;
/// Capacity for the extrema of the curvature of a piece.
const FEW_TURNS: usize = 8;
/// The freedoms of a joint, followed by the multiplier of the opening of the arc that ends there.
const FREEDOMS: usize = 3;
/// Diagonal entry of a joint at an end, which is fixed: its rows have no other entries.
const HELD: BlockRows = {
    let mut rows = [[0.0; PAIR]; GROUP];
    (rows[0][0], rows[1][1], rows[2][2]) = (1.0, 1.0, 1.0);
    rows
};
/// How much closing may add to the deviation, as a share of the widest opening: above it, closing is not tried.
const CLOSING: f64 = 0.1;
/// The dual value is trusted once the chain is open by less than this: for wider openings it says little about closed chains.
const TELLING: f64 = 2.0;

/// The quantity compared at a node, with its allowed error.
#[derive(Debug, Clone, Copy)]
enum NodeCondition {
    /// The distance.
    Distance(LocalCurve),
    /// The curvature.
    Curvature(f64, f64),
}

/// The curve near a node, as far as the node represents it.
#[derive(Debug, Clone, Copy)]
struct LocalCurve {
    tangent: Vector2<f64>,
    curvature: f64,
    slope: f64,
    /// Half the distances to the nodes before and behind.
    back: f64,
    ahead: f64,
}

impl LocalCurve {
    /// The point at a distance along the curve, to the third order.
    fn point(&self, from: Vector2<f64>, along: f64) -> Vector2<f64> {
        let square = along * along;
        let on = along - self.curvature * self.curvature * square * along / 6.0;
        let left = square * (0.5 * self.curvature + self.slope * along / 6.0);
        from + self.tangent * on + Vector2::new(-self.tangent.y, self.tangent.x) * left
    }

    /// The place along the curve where the distance from an arc is largest, within the range that the node represents; 0 where it is nearest.
    fn way_to_top(&self, link: &ChainArc, [a, b]: [f64; 2], off: f64) -> f64 {
        let arc = &link.arc;
        let (along, across) = (arc.heading.dot(&self.tangent), arc.heading.perp(&self.tangent));
        let rise = across - arc.curvature * (a * along + b * across);
        let bend = self.curvature - arc.curvature;
        if off * bend < 0.0 { (-rise / bend).clamp(-self.back, self.ahead) } else { 0.0 }
    }
}

/// How far towards another node a node represents the curve: half the distance, or as far as its third order is valid.
///
/// Where the curvature there differs by Δκ from the value that its growth here predicts, x on the distance d it differs by about Δκ (x/d)²,
/// and the curve by Δκ x⁴/(12 d²). A circle departs from its third order by κ³ x⁴/24.
fn reach(node: &CurveSample, other: Option<&CurveSample>, tolerance: f64) -> f64 {
    other.map_or(0.0, |other| {
        let square = (other.point - node.point).norm_squared();
        let way = square.sqrt();
        let along = if other.parameter > node.parameter { way } else { -way };
        let off = (other.curvature - node.curvature - node.slope * along).abs();
        let cube = (node.curvature * node.curvature * node.curvature).abs();
        let left = off / (12.0 * square) + cube / 24.0;
        (0.5 * way).min((SHOWN * tolerance / left).sqrt().sqrt())
    })
}

/// A node with the state of the method there.
#[derive(Debug)]
struct NodeSample {
    point: Vector2<f64>,
    parameter: f64,
    kept: NodeCondition,
    /// 1, a, b, a² + b², see [`crate::geometry::arcs::nodes::TangentArc::basis_at`], or their derivatives by the length or for the
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

/// The condition on the curvature, or the heading, at a joint of an arc.
#[derive(Debug, Clone, Copy)]
struct JointCondition {
    /// Index into [`ArcTrial::joint_misses`].
    bend: usize,
    off: f64,
    off_by: [f64; 6],
    sides: [Slack; 2],
}

/// The samples of a piece, the conditions at the joints of every arc, and the tolerance.
struct MinimaxProgram {
    samples: Vec<NodeSample>,
    ends: Vec<Vec<JointCondition>>,
    tolerance: f64,
}

/// The contribution of both conditions of a sample to a step: the force on the sampled quantity, that on the level, and both stiffnesses.
struct BarrierForces {
    force: f64,
    on_level: f64,
    pull: f64,
    stiff: f64,
}

impl BarrierForces {
    fn new(sides: &[Slack; 2], aim: f64) -> Self {
        let [(force, stiff), (back, stiff_back)] =
            sides.map(|side| (aim / side.distance, side.multiplier / side.distance));
        Self { force: force - back, on_level: force + back, pull: stiff - stiff_back, stiff: stiff + stiff_back }
    }
}

/// The contribution of the samples of an arc to the six freedoms of its two joints, and to the level.
struct ArcNormalEquations {
    /// Only the upper triangle.
    stiff: [[f64; 6]; 6],
    push: [f64; 6],
    pull: [f64; 6],
    /// The sums over the samples by their basis: stiffness, its upper triangle, force and pull.
    moments: [[f64; 4]; 4],
    forces: [[f64; 2]; 4],
    corner: f64,
    excess: f64,
}

#[expect(clippy::needless_range_loop, reason = "only the upper triangles")]
impl ArcNormalEquations {
    fn by(samples: &[NodeSample], aim: f64) -> Self {
        let (mut moments, mut forces, mut corner, mut excess) = ([[0.0; 4]; 4], [[0.0; 2]; 4], 0.0, 0.0);
        for sample in samples {
            let push = BarrierForces::new(&sample.sides, aim);
            let [basis] = sample.basis.data.0;
            for row in 0..4 {
                let weighted = push.stiff * basis[row];
                for column in row..4 {
                    moments[row][column] += weighted * basis[column];
                }
                forces[row][0] += push.force * basis[row];
                forces[row][1] += push.pull * basis[row];
            }
            corner += push.stiff;
            excess += push.on_level;
        }
        Self { stiff: [[0.0; 6]; 6], push: [0.0; 6], pull: [0.0; 6], moments, forces, corner, excess }
    }

    /// Transforms the sums by the basis to the freedoms. Those of the later joint change the curvature only, the last of the four.
    fn spread(&mut self, off_by: &[Vector4<f64>; 6]) {
        let m = &self.moments;
        let bends = [off_by[3].w, off_by[4].w, off_by[5].w];
        for row in 0..3 {
            let [[a, b, c, d]] = off_by[row].data.0;
            let weighted = [
                m[0][0] * a + m[0][1] * b + m[0][2] * c + m[0][3] * d,
                m[0][1] * a + m[1][1] * b + m[1][2] * c + m[1][3] * d,
                m[0][2] * a + m[1][2] * b + m[2][2] * c + m[2][3] * d,
                m[0][3] * a + m[1][3] * b + m[2][3] * c + m[3][3] * d,
            ];
            for column in row..3 {
                let [[e, f, g, h]] = off_by[column].data.0;
                self.stiff[row][column] += weighted[0] * e + weighted[1] * f + weighted[2] * g + weighted[3] * h;
            }
            for (column, bend) in (3..).zip(bends) {
                self.stiff[row][column] += weighted[3] * bend;
            }
            for ([push, pull], by) in self.forces.iter().zip([a, b, c, d]) {
                self.push[row] += push * by;
                self.pull[row] += pull * by;
            }
        }
        let [push, pull] = self.forces[3];
        for (row, bend) in (3..).zip(bends) {
            let weighted = m[3][3] * bend;
            for column in row..6 {
                self.stiff[row][column] += weighted * bends[column - 3];
            }
            self.push[row] += push * bend;
            self.pull[row] += pull * bend;
        }
    }

    /// Adds these equations and the opening of the arc to the rows of both joints and their right-hand sides.
    fn add_to(
        &self,
        (rows, side): (&mut BlockRows, &mut [[f64; 2]; GROUP]),
        (next, next_side): (&mut BlockRows, &mut [[f64; 2]; GROUP]),
        link: &ChainArc,
    ) {
        for row in 0..FREEDOMS {
            for column in row..FREEDOMS {
                rows[row][column] += self.stiff[row][column];
                next[row][column] += self.stiff[FREEDOMS + row][FREEDOMS + column];
            }
            for column in 0..FREEDOMS {
                rows[row][GROUP + column] += self.stiff[row][FREEDOMS + column];
            }
            rows[row][GROUP + FREEDOMS] += link.open_by[row];
            next[row][FREEDOMS] += link.open_by[FREEDOMS + row];
            next[row][row] += STAY[row];
            for (joint, row) in [(&mut *side, row), (&mut *next_side, FREEDOMS + row)] {
                let [right, border] = &mut joint[row % FREEDOMS];
                *right -= self.push[row];
                *border -= self.pull[row];
            }
        }
        next[FREEDOMS][FREEDOMS] -= GIVE;
        next_side[FREEDOMS] = [-link.open, 0.0];
    }

    /// Adds the condition at a joint.
    fn press(&mut self, off_by: &[f64; 6], push: &BarrierForces) {
        for row in 0..6 {
            let weighted = push.stiff * off_by[row];
            for column in row..6 {
                self.stiff[row][column] += weighted * off_by[column];
            }
            self.push[row] += push.force * off_by[row];
            self.pull[row] += push.pull * off_by[row];
        }
        self.corner += push.stiff;
        self.excess += push.on_level;
    }
}

/// Joints of a chain within `tolerance` at the nodes, from a first guess; where none was found, the least deviation reached, in
/// tolerances.
pub(super) fn relax(
    target: &impl FitTarget,
    nodes: &[CurveSample],
    tolerance: f64,
    mut places: Vec<JointPlace>,
) -> Result<Vec<ArcJoint>, f64> {
    let mut program = MinimaxProgram::new(nodes, places.len() - 1, tolerance);
    let (mut level, mut least, mut before) = (None, f64::INFINITY, f64::INFINITY);
    for steps in 0..MOST_STEPS {
        let Some(trial) = ArcTrial::new(target, &places, tolerance) else { break };
        let (worst, open) = (program.measure(&trial), trial.open());
        if !worst.is_finite() {
            break;
        }
        least = worst.min(least);
        if worst + CLOSING * open <= 1.0
            && let Some(closed) = trial.closed(target, tolerance)
        {
            if program.measure(&closed) <= 1.0 {
                return Ok(closed.joints());
            }
            program.measure(&trial);
        }
        if is_too_slow(steps, worst, before) {
            break;
        }
        before = worst;
        let top = level.map_or(ROOM.0 * worst, |level: f64| level.max(ROOM.1 * worst));
        let (gap, aim) = program.slacks(top, trial.links.len());
        if open < TELLING && top - gap > 1.0 {
            break;
        }
        let (step, rise) = program.direction(&trial, aim);
        let (primal, dual) = program.shares(&trial, &step, rise, aim);
        let primal = primal.min(trial.step_share(&step, LONGEST_STEP));
        program.press_on(dual);
        places = trial.moved(&step, primal, tolerance);
        level = Some(top + primal * rise);
    }
    Err(least)
}

/// Whether the largest deviation, in tolerances, falls so slowly that it will not get below one.
fn is_too_slow(steps: u32, worst: f64, before: f64) -> bool {
    let excess = worst - 1.0;
    let allowed =
        steps.checked_sub(1).map_or(f64::INFINITY, |further| SLOWEST.0 * libm::pow(SLOWEST.1, f64::from(further)));
    excess > allowed || (steps >= STALLS_FROM && excess > STALLED.0 && excess > STALLED.1 * (before - worst))
}

impl MinimaxProgram {
    fn new(nodes: &[CurveSample], arcs: usize, tolerance: f64) -> Self {
        let bent = nodes.iter().any(|node| node.allowed.curvature.is_finite());
        let turned = nodes.iter().any(|node| node.allowed.heading.is_finite());
        let sides = [Slack { distance: 0.0, multiplier: 0.0, change: 0.0 }; 2];
        let mut samples = Vec::with_capacity(nodes.len() + FEW_TURNS);
        for (index, node) in nodes.iter().enumerate() {
            let &CurveSample { point, tangent, curvature, slope, parameter, allowed, .. } = node;
            let mut keep =
                |kept| samples.push(NodeSample { point, parameter, kept, basis: Vector4::zeros(), off: 0.0, sides });
            let (before, after) = (index.checked_sub(1).and_then(|index| nodes.get(index)), nodes.get(index + 1));
            let (back, ahead) = (reach(node, before, tolerance), reach(node, after, tolerance));
            keep(NodeCondition::Distance(LocalCurve { tangent, curvature, slope, back, ahead }));
            // Between the joints the error of the curvature is largest where the curvature of the curve has an extremum.
            let before = before.or(after);
            let turns = before.is_some_and(|other| other.best_heading.signum() != node.best_heading.signum());
            if turns && allowed.curvature.is_finite() {
                keep(NodeCondition::Curvature(curvature + allowed.middle, allowed.curvature));
            }
        }
        let kept: Vec<usize> =
            [bent, bent, turned].into_iter().zip(0..).filter_map(|(is, bend)| is.then_some(bend)).collect();
        #[expect(clippy::cast_precision_loss, reason = "below the largest number of nodes")]
        let multiplier = 0.5 * arcs as f64 / (samples.len() + kept.len() * arcs) as f64;
        let sides = sides.map(|side| Slack { multiplier, ..side });
        for sample in &mut samples {
            sample.sides = sides;
        }
        let ends: Vec<JointCondition> =
            kept.into_iter().map(|bend| JointCondition { bend, off: 0.0, off_by: [0.0; 6], sides }).collect();
        let ends = if ends.is_empty() { Vec::new() } else { vec![ends; arcs] };
        Self { samples, ends, tolerance }
    }

    /// Every arc with its samples, up to the foot of its end.
    fn by_arc<'a>(&'a mut self, trial: &'a ArcTrial) -> impl Iterator<Item = (&'a ChainArc, &'a mut [NodeSample])> {
        let mut rest = self.samples.as_mut_slice();
        trial.links.iter().zip(trial.parameters().skip(1)).map(move |(link, end)| {
            let all = std::mem::take(&mut rest);
            // The last joint is the last sample.
            let count = all.partition_point(|sample| sample.parameter <= end);
            let (mine, others) = all.split_at_mut(count);
            rest = others;
            (link, mine)
        })
    }

    /// Computes the deviation at every sample, and returns the largest, in tolerances.
    fn measure(&mut self, trial: &ArcTrial) -> f64 {
        let tolerance = self.tolerance;
        let mut worst = 0.0_f64;
        for (link, samples) in self.by_arc(trial) {
            for sample in samples {
                sample.measure(link, tolerance);
                worst = larger(worst, sample.off.abs());
            }
        }
        for (index, ends) in self.ends.iter_mut().enumerate() {
            let bends = trial.joint_misses(index, tolerance);
            for end in ends {
                if let Some(bend) = bends.as_ref().and_then(|bends| bends.get(end.bend)) {
                    (end.off, end.off_by) = (bend.off, bend.off_by);
                }
                worst = larger(worst, end.off.abs());
            }
        }
        worst
    }

    /// Computes the slacks below a level, and returns the distance of the dual value below it, and the product of slack and
    /// multiplier to aim at.
    fn slacks(&mut self, level: f64, arcs: usize) -> (f64, f64) {
        let mut product = 0.0;
        let samples = self.samples.iter_mut().map(|sample| (sample.off, &mut sample.sides));
        let ends = self.ends.iter_mut().flatten().map(|end| (end.off, &mut end.sides));
        for (off, sides) in samples.chain(ends) {
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
    fn direction(&mut self, trial: &ArcTrial, aim: f64) -> (ChainStep, f64) {
        let arcs = trial.links.len();
        let mut matrix = BlockMatrix::with_capacity(arcs + 1);
        // The right-hand side, and the border of the level.
        let mut right = Vec::with_capacity(arcs + 1);
        #[expect(clippy::cast_precision_loss, reason = "below the largest number of nodes")]
        let (mut corner, mut excess) = (0.0, -(arcs as f64));
        let mut ends = std::mem::take(&mut self.ends);
        let (mut rows, mut side) = (HELD, [[0.0; 2]; GROUP]);
        rows[FREEDOMS][FREEDOMS] = 1.0;
        for (index, (link, samples)) in self.by_arc(trial).enumerate() {
            let mut pressed = ArcNormalEquations::by(samples, aim);
            pressed.spread(&link.off_by);
            for end in ends.get(index).into_iter().flatten() {
                pressed.press(&end.off_by, &BarrierForces::new(&end.sides, aim));
            }
            (corner, excess) = (corner + pressed.corner, excess + pressed.excess);
            let mut next = if index + 1 == arcs { HELD } else { [[0.0; PAIR]; GROUP] };
            let mut next_side = [[0.0; 2]; GROUP];
            pressed.add_to((&mut rows, &mut side), (&mut next, &mut next_side), link);
            matrix.push(rows);
            right.push(side);
            (rows, side) = (next, next_side);
        }
        matrix.push(rows);
        right.push(side);
        std::mem::swap(&mut self.ends, &mut ends);
        let edge: Vec<[f64; GROUP]> = right.iter().map(|joint| joint.map(|[_, border]| border)).collect();
        matrix.solve(&mut right);
        let (mut along, mut across) = (0.0, 0.0);
        for (edge, [solved, border]) in edge.iter().flatten().zip(right.iter().flatten()) {
            along += edge * solved;
            across += edge * border;
        }
        let rise = (excess - along) / (corner - across);
        (ChainStep(right.iter().map(|joint| joint.map(|[r, b]| r - b * rise)).collect()), rise)
    }

    /// Changes the multipliers by a share of the changes stored with the samples.
    fn press_on(&mut self, share: f64) {
        let samples = self.samples.iter_mut().map(|sample| &mut sample.sides);
        let ends = self.ends.iter_mut().flatten().map(|end| &mut end.sides);
        for side in samples.chain(ends).flatten() {
            side.multiplier += share * side.change;
        }
    }

    /// Shares of a step that slacks and multipliers allow; the changes of the multipliers are stored with the samples.
    fn shares(&mut self, trial: &ArcTrial, step: &ChainStep, rise: f64, aim: f64) -> (f64, f64) {
        let (mut primal, mut dual) = (1.0_f64, 1.0_f64);
        let mut allow = |sides: &mut [Slack; 2], off: f64| {
            for (side, moved) in sides.iter_mut().zip([rise - off, rise + off]) {
                side.change = (aim - side.multiplier * moved) / side.distance - side.multiplier;
                if moved < 0.0 {
                    let most = -BOUNDARY * side.distance / moved;
                    primal = if most < primal { most } else { primal };
                }
                if side.change < 0.0 {
                    let most = -BOUNDARY * side.multiplier / side.change;
                    dual = if most < dual { most } else { dual };
                }
            }
        };
        for (index, (_, samples)) in self.by_arc(trial).enumerate() {
            let change = trial.change(index, step);
            for sample in samples {
                allow(&mut sample.sides, sample.basis.dot(&change));
            }
        }
        for (index, ends) in self.ends.iter_mut().enumerate() {
            let step = step.of_arc(index);
            for end in ends {
                allow(&mut end.sides, end.off_by.iter().zip(step).map(|(by, step)| by * step).sum());
            }
        }
        (primal, dual)
    }
}

impl NodeSample {
    /// Computes the error of the sampled quantity over its allowed value, and its basis.
    fn measure(&mut self, link: &ChainArc, tolerance: f64) {
        let (basis, distance) = link.arc.basis_at(self.point);
        (self.basis, self.off) = match &self.kept {
            NodeCondition::Distance(local) => {
                let along = local.way_to_top(link, [basis.y, basis.z], distance);
                let there = if along == 0.0 { self.point } else { local.point(self.point, along) };
                let (basis, distance) = link.arc.basis_at(there);
                (basis, distance / tolerance)
            }
            &NodeCondition::Curvature(curvature, allowed) => {
                (Vector4::new(0.0, 0.0, 0.0, -2.0 * tolerance / allowed), (link.arc.curvature - curvature) / allowed)
            }
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::arcs::nodes::sample;
    use crate::geometry::{ChainTolerance, CurvePoint};

    /// The third order of a node stays close to the curve over its reach, on an ellipse, whose curvature changes by a factor of 3.4,
    /// and over decades of the tolerance. Twice the share: the estimate of what is left leaves out what is smaller by one more order.
    #[test]
    fn a_node_shows_the_curve_as_far_as_it_reaches() {
        let (a, b) = (60.0, 40.0);
        let ellipse = |t: f64| {
            let (sin, cos) = libm::sincos(t);
            let frame = CurvePoint::from_derivatives(
                Vector2::new(a * cos, b * sin),
                Vector2::new(-a * sin, b * cos),
                Vector2::new(-a * cos, -b * sin),
                Vector2::new(a * sin, -b * cos),
            );
            (frame, ChainTolerance::ANY)
        };
        for tolerance in [1e-1, 1e-3, 1e-6] {
            let (nodes, _) = sample(&ellipse, (0.2, 3.0), tolerance, tolerance).expect("nodes");
            let mut farthest = 0.0_f64;
            for pair in nodes.windows(2) {
                for (node, other, side) in [(&pair[0], &pair[1], 1.0), (&pair[1], &pair[0], -1.0)] {
                    let &CurveSample { tangent, curvature, slope, .. } = node;
                    let way = reach(node, Some(other), tolerance);
                    let local = LocalCurve { tangent, curvature, slope, back: way, ahead: way };
                    let point = local.point(node.point, side * way);
                    // To first order the distance from a² and b² of the implicit equation.
                    let (x, y) = (point.x / a, point.y / b);
                    let off = (x * x + y * y - 1.0) / (2.0 * libm::hypot(x / a, y / b));
                    assert!(off.abs() <= 2.0 * SHOWN * tolerance, "{tolerance:e} at {}: {off:e}", node.parameter);
                    farthest = farthest.max(way / (other.point - node.point).norm());
                }
            }
            assert!(farthest > 0.49, "{tolerance:e}: no node reaches half way, at most {farthest}");
        }
    }
}
