//! What can be cut where the pitch curve is too sharp: the envelope with its loops removed.
//!
//! Where a convex radius of the pitch curve is below the roller's, or at a convex corner, the parallel curve folds back
//! and crosses itself. The roller cannot follow the motion there: the metal ends in the crossing, a sharp edge, and the
//! roller drops onto that edge. Between the two parameters of the crossing motion is lost.
//!
//! # The crossing
//!
//! A fold lies between two cusps, C₁ where the curve starts to run backwards and C₂ where it runs forwards again; at a corner
//! they are the two ends of the gap, which is a step backwards. Take u along the mean of the tangents at the cusps. Up to C₁ u
//! grows, from C₂ on it grows again, and u(C₁) > u(C₂): both branches pass every u between, at the heights v₁(u) and v₂(u).
//! The tangent turns in one sense throughout, so that the second branch is steeper than the first everywhere, and v₂ − v₁ grows
//! with u; over the fold it is negative at u(C₂) and positive at u(C₁), since the part that runs backwards is less steep than the part
//! that runs forwards over the same u. So a fold, however slight, has one crossing, and a bracket that contains it.
//!
//! A slight fold is small of third order in its width and the lost metal of fourth, far below the rounding of coordinates; its
//! branches are integrated from the exact speed along the curve instead.

mod fold;

use super::Curves;
use super::followed::{Guide, face_lift};
use crate::follower::Element;
use crate::geometry::CurvePoint;
use crate::motion::Quantity;
use crate::numeric::{extremum, quadrature, root};
use fold::{Fold, folds};
use nalgebra::Vector2;

/// How far the branches next to a fold are followed, as a share of the cam, and how often the step is doubled.
const BRANCH_REACH: f64 = 0.25;
const DOUBLINGS: u32 = 64;
/// First step along a branch from a corner, whose fold has no width, as a share of the cam.
const FIRST_STEP: f64 = 1e-12;
/// Folds whose cusps are closer than this share of their distance from the origin are integrated from their speed; the others are
/// large compared with rounding.
const NARROW: f64 = 1e-5;
/// Panels of eight points for this integral: the speed of a narrow fold is nearly a parabola.
const PANELS: u32 = 2;
/// A fold whose cusps are closer than this share of that distance is a point where rounding may leave no crossing: on a cam of
/// 0.1 m with ρ'' = 0.1 m it loses less than 1e-17 m.
const POINT: f64 = 1e-12;
/// Cells in which the largest loss is looked for.
const LOSS_CELLS: u32 = 64;

/// A loop of the parallel curve, and the lift lost at it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UndercutLoss {
    /// Parameter at which the roller arrives at the edge; may lie before the first piece by a turn.
    pub from: f64,
    /// Parameter at which it leaves the edge; above `from`.
    pub to: f64,
    /// Largest loss of lift, m.
    pub lost: f64,
    /// Parameter of the largest loss.
    pub lost_at: f64,
}

/// The loops have no simple envelope: they take up the whole profile.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the profile folds over itself without a crossing that could be cut")]
pub struct NoEnvelope {
    /// Where, as the motion's parameter.
    pub parameter: f64,
}

/// A stretch of a parallel curve that is left out: the curve has the same point at both of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ParallelLoop {
    /// Parameter where it begins; may lie before the first piece by a turn.
    pub(crate) from: f64,
    /// Parameter where it ends, not below `from`.
    pub(crate) to: f64,
}

/// The side from which a break is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum BreakSide {
    Before,
    After,
}

/// The parallel of the follower's curve at a distance inwards, m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parallel<'a> {
    pub(crate) curves: Curves<'a>,
    pub(crate) distance: f64,
}

/// Every loop of the profile, in the order of the motion's parameter.
///
/// # Errors
/// [`NoEnvelope`] when no outline remains.
pub fn losses(curves: Curves<'_>) -> Result<Vec<UndercutLoss>, NoEnvelope> {
    let profile = Parallel { curves, distance: curves.offset() };
    Ok(profile.loops()?.into_iter().map(|found| loss(profile, found)).collect())
}

impl Parallel<'_> {
    /// The curve at a parameter of a piece.
    pub(crate) fn in_piece(&self, piece: usize, parameter: f64) -> CurvePoint {
        self.curves.touch(piece, parameter).curve.offset_inward(self.distance)
    }

    /// The curve at any parameter, on the given side of a break.
    pub(crate) fn point_at(&self, parameter: f64, side: BreakSide) -> CurvePoint {
        let motion = self.curves.motion;
        let (piece, inside) = motion.locate(parameter);
        let pieces = motion.pieces();
        let at_start = pieces.get(piece).is_some_and(|p| p.start == inside);
        if side == BreakSide::Before && at_start && (piece > 0 || motion.period().is_some()) {
            let before = (piece + pieces.len() - 1) % pieces.len();
            let end = pieces.get(before).map_or(inside, |p| p.end);
            return self.in_piece(before, end);
        }
        self.in_piece(piece, inside)
    }

    fn loop_of(&self, fold: Fold) -> Result<ParallelLoop, NoEnvelope> {
        Branches::new(*self, fold).crossing().ok_or(NoEnvelope { parameter: fold.from })
    }

    /// Every loop of the curve, in the order of the parameter.
    pub(crate) fn loops(&self) -> Result<Vec<ParallelLoop>, NoEnvelope> {
        let mut found: Vec<(Fold, ParallelLoop)> = Vec::new();
        for mut fold in folds(*self) {
            if found.last().is_some_and(|(_, last)| fold.to <= last.to) {
                continue;
            }
            let mut next = self.loop_of(fold)?;
            // Loops that overlap become one.
            while let Some((before, _)) = found.pop_if(|(_, last)| next.from < last.to) {
                fold.from = before.from;
                next = self.loop_of(fold)?;
            }
            found.push((fold, next));
        }
        let loops: Vec<ParallelLoop> = found.into_iter().map(|(_, found)| found).collect();
        match (loops.first(), loops.last()) {
            (Some(first), Some(last))
                if self.curves.motion.period().is_some_and(|period| last.to > first.from + period) =>
            {
                Err(NoEnvelope { parameter: last.to })
            }
            _ => Ok(loops),
        }
    }
}

/// The branches of a parallel curve on either side of a fold.
struct Branches<'a> {
    parallel: Parallel<'a>,
    /// The cusps, or twice the corner.
    fold: Fold,
    /// Whether the branches are integrated from their speed.
    narrow: bool,
    /// Where the integrals start: the first cusp, looked at from before.
    origin: Vector2<f64>,
    /// From the first cusp to the second.
    step: Vector2<f64>,
    along: Vector2<f64>,
}

impl<'a> Branches<'a> {
    fn new(parallel: Parallel<'a>, fold: Fold) -> Self {
        let (before, after) =
            (parallel.point_at(fold.from, BreakSide::Before), parallel.point_at(fold.to, BreakSide::After));
        let by_points = after.point - before.point;
        let narrow = by_points.norm() <= NARROW * before.point.norm();
        let step = if narrow { parallel.step(fold) } else { by_points };
        let along = (before.tangent + after.tangent).normalize();
        Self { parallel, fold, narrow, origin: before.point, step, along }
    }

    /// A point of the branch before the fold, relative to the first cusp.
    fn before(&self, parameter: f64) -> Vector2<f64> {
        if self.narrow {
            return -self.parallel.sum(parameter, self.fold.from);
        }
        self.parallel.point_at(parameter, BreakSide::Before).point - self.origin
    }

    /// A point of the branch after it.
    fn after(&self, parameter: f64) -> Vector2<f64> {
        if self.narrow {
            return self.step + self.parallel.sum(self.fold.to, parameter);
        }
        self.parallel.point_at(parameter, BreakSide::After).point - self.origin
    }

    /// How far a branch must be followed until it has passed a place along the tangent; `None` where it never does.
    fn reach(&self, sign: f64, place: f64) -> Option<f64> {
        let (first, last) = self.parallel.curves.motion.range();
        let start = if sign < 0.0 { self.fold.from } else { self.fold.to };
        let side = if sign < 0.0 { BreakSide::Before } else { BreakSide::After };
        let mut step = (self.fold.to - self.fold.from).max(FIRST_STEP * (last - first));
        for _ in 0..DOUBLINGS {
            let within = step.min(BRANCH_REACH * (last - first));
            let parameter = match self.parallel.curves.motion.period() {
                Some(_) => start + sign * within,
                None => (start + sign * within).clamp(first, last),
            };
            if !(self.parallel.point_at(parameter, side).tangent.dot(&self.along) > 0.0) {
                return None;
            }
            let point = if sign < 0.0 { self.before(parameter) } else { self.after(parameter) };
            if sign * (point.dot(&self.along) - place) >= 0.0 {
                return Some(parameter);
            }
            if within < step || parameter == first || parameter == last {
                return None;
            }
            step *= 2.0;
        }
        None
    }

    /// Where the branches cross.
    fn crossing(&self) -> Option<ParallelLoop> {
        let (low, high) = (self.step.dot(&self.along), 0.0);
        let is_point = self.step.norm() <= POINT * self.origin.norm();
        let as_point = is_point.then_some(ParallelLoop { from: self.fold.from, to: self.fold.to });
        if !(low < high) {
            return as_point;
        }
        let (Some(left), Some(right)) = (self.reach(-1.0, low), self.reach(1.0, high)) else { return as_point };
        let start = |place: f64| {
            root::bracketed(|at| self.before(at).dot(&self.along) - place, left, self.fold.from, 0.0)
                .unwrap_or(f64::NAN)
        };
        let end = |place: f64| {
            root::bracketed(|at| self.after(at).dot(&self.along) - place, self.fold.to, right, 0.0).unwrap_or(f64::NAN)
        };
        match root::bracketed(
            |place| self.along.perp(&(self.after(end(place)) - self.before(start(place)))),
            low,
            high,
            0.0,
        ) {
            Ok(place) => Some(ParallelLoop { from: start(place), to: end(place) }),
            Err(_) => as_point,
        }
    }
}

impl Parallel<'_> {
    /// The vector between the curve at two parameters, the earlier one looked at from after a break and the later from before.
    fn sum(&self, from: f64, to: f64) -> Vector2<f64> {
        let motion = self.curves.motion;
        let mut sum = Vector2::zeros();
        for (index, piece) in motion.pieces().iter().enumerate() {
            for turns in [-1.0, 0.0, 1.0] {
                let turn = turns * motion.period().unwrap_or(0.0);
                let (start, end) = (from.max(piece.start + turn), to.min(piece.end + turn));
                if !(start < end) || (turns != 0.0 && turn == 0.0) {
                    continue;
                }
                let velocity = |parameter: f64| {
                    let curve = self.in_piece(index, parameter - turn);
                    curve.tangent * curve.speed
                };
                let range = (start, end);
                sum.x += quadrature::integrate(|at| velocity(at).x, range, PANELS);
                sum.y += quadrature::integrate(|at| velocity(at).y, range, PANELS);
            }
        }
        sum
    }

    /// The vector from the first end of a fold, looked at from before it, to the last, looked at from after it: its corners are
    /// steps.
    fn step(&self, fold: Fold) -> Vector2<f64> {
        let motion = self.curves.motion;
        let period = motion.period().unwrap_or(0.0);
        let corners = fold::corners(*self);
        let inside = corners.iter().filter(|corner| {
            [-period, 0.0, period].iter().any(|turn| fold.from <= corner.at + turn && corner.at + turn <= fold.to)
        });
        let steps = inside.map(|corner| {
            let (before, after) =
                (self.point_at(corner.at, BreakSide::Before), self.point_at(corner.at, BreakSide::After));
            (before.outward() - after.outward()) * self.distance
        });
        self.sum(fold.from, fold.to) + steps.sum::<Vector2<f64>>()
    }
}

/// How far the follower drops onto the edge at a loop.
fn loss(profile: Parallel<'_>, ParallelLoop { from, to }: ParallelLoop) -> UndercutLoss {
    let curves = profile.curves;
    let edge = profile.point_at(from, BreakSide::Before).point;
    let drop = |parameter: f64| drop_onto(curves, parameter, edge);
    let worst = extremum::largest_without_slope(drop, (from, to), LOSS_CELLS, extremum::TO_ROUNDING);
    UndercutLoss { from, to, lost: worst.value.max(0.0), lost_at: worst.at }
}

/// How far the follower drops from its motion onto an edge at a parameter, m.
fn drop_onto(curves: Curves<'_>, parameter: f64, edge: Vector2<f64>) -> f64 {
    let (piece, inside) = curves.motion.locate(parameter);
    let law = curves.motion.jet(piece, inside);
    let contact = curves.follower.touch(inside, &law);
    let away = contact.curve.point - edge;
    match curves.element() {
        Element::Roller { radius } => {
            let along = away.dot(&contact.drive);
            along - (along * along - away.norm_squared() + radius * radius).max(0.0).sqrt()
        }
        // A face on an arm swings until it lies on the edge.
        Element::Face if curves.follower.quantity() == Quantity::Angle => {
            let on_edge = face_lift(curves, inside, law, Guide::Circle(edge, 0.0)).unwrap_or(f64::NAN);
            (law.s - on_edge) * curves.follower.leverage(&law)
        }
        // The face is at a height above the edge; it drops along its drive.
        Element::Face => {
            let normal = contact.curve.outward();
            away.dot(&normal) / contact.drive.dot(&normal)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::follower::FlatFace;
    use crate::motion::{Jet, Motion, Piece};
    use crate::profile::outline;

    /// The follower's curve of a flat face is its profile: one that is pressed by a law a little too quick for its base circle.
    #[test]
    fn a_slight_undercut_under_a_face_has_an_outline() {
        /// Lift a (1 − cos 3θ): ρ = R + a + 8 a cos 3θ, least R − 7 a at cos 3θ = −1.
        #[derive(Debug)]
        struct ThreeLobes(f64);
        impl Motion for ThreeLobes {
            fn pieces(&self) -> &[Piece] {
                const WHOLE: [Piece; 1] = [Piece { start: 0.0, end: std::f64::consts::TAU, dwell: false }];
                &WHOLE
            }
            fn jet(&self, _: usize, angle: f64) -> Jet {
                let (sin, cos) = (libm::sin(3.0 * angle), libm::cos(3.0 * angle));
                let a = self.0;
                Jet { s: a * (1.0 - cos), ds: 3.0 * a * sin, dds: 9.0 * a * cos, ddds: -27.0 * a * sin }
            }
        }
        let a = 0.003;
        for below in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3] {
            let curves = Curves { motion: &ThreeLobes(a), follower: &FlatFace::new(7.0 * a - below) };
            let losses = losses(curves).unwrap_or_else(|error| panic!("{below}: {error}"));
            assert_eq!(losses.len(), 3, "{below}: {losses:?}");
            for loss in &losses {
                // Symmetric about the third of a turn, where the face is at the height R + 2 a over the shaft; the edge lies on
                // that line at p cos τ − p' sin τ with p' cos τ + p sin τ = 0: bisected for τ in (0, 60°).
                let support =
                    |t: f64| (7.0 * a - below + a * (1.0 + libm::cos(3.0 * t)), -3.0 * a * libm::sin(3.0 * t));
                let across = |t: f64| support(t).0 * libm::sin(t) + support(t).1 * libm::cos(t);
                let (mut low, mut high) = (1e-3 * below.sqrt() / a.sqrt(), 1.0);
                for _ in 0..200 {
                    let middle = 0.5 * (low + high);
                    if across(middle) < 0.0 { low = middle } else { high = middle }
                }
                let (p, slope) = support(low);
                let lost = 7.0 * a - below + 2.0 * a - (p * libm::cos(low) - slope * libm::sin(low));
                assert!((loss.lost - lost).abs() < 1e-6 * lost + 1e-15, "{below}: {loss:?} {lost:e}");
            }
            let drawn = outline::profile(curves, 5e-6).unwrap_or_else(|error| panic!("{below}: {error}"));
            assert_eq!(drawn.contour.turns(), 1.0);
        }
    }
}
