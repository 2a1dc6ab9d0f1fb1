//! How far a written chain G lies from an exact outline C, in both directions, and that it is one simple loop: proved by following C.
//!
//! G is followed from end to end, together with the foot t of its point g on C: g = C(t) + d n(t), n the outward normal. With Δ the
//! angle from the tangent of C to that of G, by the lengths s of G and σ of C,
//!
//! ```text
//! dσ/ds = cos Δ/(1 + κ d),   dd/ds = −sin Δ,   d²d/ds² = −cos Δ (k − κ cos Δ/(1 + κ d)),   k the curvature of G
//! ```
//!
//! The chain is divided where a segment ends, where a stretch of C ends and, if need be, between. In such a cell k is constant, or
//! for a cubic edge within a proven interval, and κ lies between the values at its two ends, so d'' lies in an interval; two parabolas
//! that start from the ends with the exact d and d' then bound d. A cell whose bound stays below the largest |d| found is done;
//! another is divided where d' is 0 to first order. The result is the largest |d| to [`SLACK`].
//!
//! **Why this is sufficient.** Each |d| is the distance of g from a point of C: max over G of dist(·, C) ≤ max |d|. While
//! cos Δ > 0 and 1 + κ d > 0, which is checked in every cell, t grows along G without a jump. When G has closed and t has made
//! exactly one turn, every point of C is the foot of exactly one point of G: max over C of dist(·, G) ≤ max |d|, too. G then is
//! the graph d(t) over C: it does not cross itself as long as 1 + κ d > 0 wherever two feet are near, its tangent stays
//! within a right angle of that of C, so that it turns by 2π like C, and it runs in the sense of C.
//!
//! **Corners.** At a corner K of C the chain is divided at its point nearest to K. On either side the foot stays on its own side of
//! the corner: where it would run beyond K it is K, and the distance is that from K. Where it has not reached K yet, the points of C
//! between them lie no farther from the dividing point than foot and K do, apart from the curvature of so short a stretch, which is added.
//! For a chain that runs across the outline near K, as the end of a plate does behind a flank that deviates a little, the foot is K.

use super::CurvePoint;
use super::boundary::Boundary;
use super::contour::Contour;
use super::edge_path::EdgePath;
use nalgebra::Vector2;

/// The reported largest distance is not more than this below the true one, mm.
pub const SLACK: f64 = 1e-10;
/// A foot is found when the point is this near to its normal, mm: the error of the distance is its square times the curvature.
const ON_NORMAL: f64 = 1e-10;
/// Places along the chain nearer than this count as one, mm.
const NEAR: f64 = 1e-9;
/// After one turn the foot is where it began, mm: a corner too small to count, of 1e-7 rad under a roller of 100 mm, moves it this far.
const CLOSES: f64 = 1e-5;
/// Where the foot is this near to a corner, mm, a chain that turns across the outline, with a cosine below this, has reached it.
const CORNER_REACH: f64 = 0.1;
const ACROSS: f64 = 0.1;
/// A cell is divided where d' is 0 to first order if both parts keep at least this share of it: divided near its end again and again
/// it would not become shorter.
const LEAST_SHARE: f64 = 0.02;
/// Most divisions of a cell, every other one in its middle, and Newton steps to a foot.
const DEEPEST: u32 = 48;
const FOOT_STEPS: u32 = 64;
/// Most cells that are divided, and more for every segment and stretch. A chain near an outline needs a few for each; for a chain along
/// the centres of curvature there is no bound, and the cells would be divided without end.
const MOST_CELLS: usize = 100_000;
const MOST_PER_SEGMENT: usize = 500;
/// How far a cubic overshoots its ends, over its length and the sum of its slopes there: 4/27.
pub(super) const OVERSHOOT: f64 = 4.0 / 27.0;
/// Rounds of the bound, which depends on itself, the ratio at which they end, and the least 1 + κ d for which they are made.
const BOUND_ROUNDS: u32 = 4;
const SETTLED: f64 = 0.8;
const LEAST_SHRINK: f64 = 0.05;

/// A largest distance, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Distance, mm.
    pub distance: f64,
    /// Place on the chain, mm.
    pub at: Vector2<f64>,
}

/// Why a chain does not follow the outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FollowingFault {
    /// It turns back, or across the outline.
    Back,
    /// It leaves the outline, or begins too far from it.
    Away,
    /// It does not go round exactly once.
    Turns,
}

/// Where a chain stops following the outline, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FollowingError {
    /// How it departs from the outline.
    pub why: FollowingFault,
    /// Where, mm.
    pub at: Vector2<f64>,
}

/// The largest distance between chain and outline, in both directions, when the chain follows the outline round.
///
/// # Errors
/// [`FollowingError`] when it does not.
pub fn follow(contour: &Contour, boundary: &Boundary<'_>) -> Result<Deviation, FollowingError> {
    let paths: Vec<EdgePath> = contour.edges().flat_map(|edge| EdgePath::paths(&edge)).collect();
    let origin = paths.first().map_or_else(Vector2::zeros, EdgePath::start);
    let cells = MOST_CELLS + MOST_PER_SEGMENT * (paths.len() + boundary.stretches().len());
    let mut walk = ChainWalk { boundary, index: 0, cells, worst: Deviation { distance: 0.0, at: origin } };
    let count = boundary.stretches().len();
    let corners: Vec<usize> = (0..count).filter(|index| boundary.starts_at_corner(*index)).collect();
    if corners.is_empty() {
        walk.round(&paths)?;
    } else {
        walk.between_corners(&paths, &corners)?;
    }
    Ok(walk.worst)
}

/// A point of the chain with its foot.
#[derive(Debug, Clone, Copy)]
struct ChainFoot {
    /// Length along the segment, mm.
    length: f64,
    point: Vector2<f64>,
    /// The foot, and its parameter in its stretch.
    foot: CurvePoint,
    parameter: f64,
    /// d, mm.
    off: f64,
    /// Sine of Δ.
    sine: f64,
}

/// The position of the foot on a part of the outline between two corners.
#[derive(Clone, Copy)]
enum FootPosition {
    /// On the corner at its start.
    Before,
    On(ChainFoot),
    /// On the corner at its end.
    Beyond,
}

struct ChainWalk<'b, 'a> {
    boundary: &'b Boundary<'a>,
    /// The stretch of the foot; the index counts on round the loop.
    index: usize,
    /// Cells that may still be examined.
    cells: usize,
    worst: Deviation,
}

impl ChainWalk<'_, '_> {
    fn record(&mut self, distance: f64, at: Vector2<f64>) {
        if distance > self.worst.distance {
            self.worst = Deviation { distance, at };
        }
    }

    fn ends(&self, at: Vector2<f64>) -> Result<[CurvePoint; 2], FollowingError> {
        self.boundary.ends(self.index).copied().ok_or(FollowingError { why: FollowingFault::Away, at })
    }

    fn parameters(&self) -> (f64, f64) {
        let stretches = self.boundary.stretches();
        stretches.get(self.index % stretches.len().max(1)).map_or((0.0, 0.0), |stretch| (stretch.from, stretch.to))
    }

    /// A point of a segment with its foot.
    fn node(
        &mut self,
        path: &EdgePath,
        length: f64,
        foot: CurvePoint,
        parameter: f64,
    ) -> Result<ChainFoot, FollowingError> {
        let (point, tangent) = path.point_and_tangent(length);
        let off = (point - foot.point).dot(&foot.outward());
        // So short a segment has an arbitrary direction where its ends were rounded.
        if !(foot.tangent.dot(&tangent) > 0.0) && path.length() > NEAR {
            return Err(FollowingError { why: FollowingFault::Back, at: point });
        }
        if !(1.0 + foot.curvature * off > 0.0) {
            return Err(FollowingError { why: FollowingFault::Away, at: point });
        }
        self.record(off.abs(), point);
        Ok(ChainFoot { length, point, foot, parameter, off, sine: foot.tangent.perp(&tangent) })
    }

    /// Where the normal of a foot meets a segment between two lengths.
    fn over(
        &mut self,
        path: &EdgePath,
        from: f64,
        to: f64,
        foot: CurvePoint,
        parameter: f64,
    ) -> Result<ChainFoot, FollowingError> {
        let (_, length) = path
            .hit(foot.point, foot.outward())
            .ok_or_else(|| FollowingError { why: FollowingFault::Away, at: path.point_and_tangent(from).0 })?;
        if !(from - NEAR..=to + NEAR).contains(&length) {
            return Err(FollowingError { why: FollowingFault::Back, at: path.point_and_tangent(from).0 });
        }
        self.node(path, length.clamp(from, to), foot, parameter)
    }

    /// The foot of a point in the present stretch, from a place before it to the end of the stretch.
    fn foot(
        &self,
        mut foot: CurvePoint,
        mut parameter: f64,
        point: Vector2<f64>,
    ) -> Result<(CurvePoint, f64), FollowingError> {
        let (mut low, mut high) = (parameter, self.parameters().1);
        for step in 0..FOOT_STEPS {
            let away = point - foot.point;
            let (ahead, off) = (away.dot(&foot.tangent), away.dot(&foot.outward()));
            if ahead.abs() <= ON_NORMAL || !(low < high) {
                break;
            }
            if ahead > 0.0 {
                low = parameter;
            } else if step == 0 {
                // Rounding may take a segment of negligible length backwards.
                return if ahead >= -NEAR {
                    Ok((foot, parameter))
                } else {
                    Err(FollowingError { why: FollowingFault::Back, at: point })
                };
            } else {
                high = parameter;
            }
            // On the circle of curvature the foot is found at once.
            let (rise, run) = (foot.curvature * ahead, 1.0 + foot.curvature * off);
            let along =
                if rise.abs() > 1e-3 * run.abs() { libm::atan2(rise, run) / foot.curvature } else { ahead / run };
            let next = parameter + along / foot.speed;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if next == parameter {
                break;
            }
            parameter = next;
            foot = self
                .boundary
                .point_at(self.index, parameter)
                .ok_or(FollowingError { why: FollowingFault::Away, at: point })?;
        }
        Ok((foot, parameter))
    }

    /// From a point of a segment to one further on; the inner result is `Err` where the foot reaches a corner.
    fn advance(
        &mut self,
        path: &EdgePath,
        mut from: ChainFoot,
        to: f64,
    ) -> Result<Result<ChainFoot, ChainFoot>, FollowingError> {
        let target = path.point_and_tangent(to).0;
        for _ in 0..=self.boundary.stretches().len() {
            let end = self.ends(target)?[1];
            if (target - end.point).dot(&end.tangent) <= 0.0 {
                let (foot, parameter) = self.foot(from.foot, from.parameter, target)?;
                let there = self.node(path, to, foot, parameter)?;
                self.cell(path, &from, &there, DEEPEST)?;
                return Ok(Ok(there));
            }
            let last = self.parameters().1;
            let border = self.over(path, from.length, to, end, last)?;
            self.cell(path, &from, &border, DEEPEST)?;
            if self.boundary.starts_at_corner(self.index + 1) {
                return Ok(Err(border));
            }
            self.index += 1;
            let start = self.ends(target)?[0];
            from = self.node(path, border.length, start, self.parameters().0)?;
        }
        Err(FollowingError { why: FollowingFault::Turns, at: target })
    }

    /// The largest |d| between two points of a segment over one stretch.
    fn cell(&mut self, path: &EdgePath, a: &ChainFoot, b: &ChainFoot, depth: u32) -> Result<(), FollowingError> {
        let length = b.length - a.length;
        if length <= NEAR {
            // d' is a sine: it changes by no more than the turn of both curves.
            let (least, most) = path.curvature_between(a.length, b.length);
            let sharpest = least.abs().max(most.abs());
            let turn = length * (sharpest + 1.25 * a.foot.curvature.abs().max(b.foot.curvature.abs()));
            let slope = (a.sine.abs().max(b.sine.abs()) + turn).min(1.0);
            self.record(a.off.abs().max(b.off.abs()) + 0.5 * length.max(0.0) * slope, b.point);
            return Ok(());
        }
        if let Some(bend) = bend(path.curvature_between(a.length, b.length), a, b, length)
            && highest((a.off, -a.sine), (b.off, -b.sine), length, bend.1) <= self.worst.distance + SLACK
            && highest((-a.off, a.sine), (-b.off, b.sine), length, -bend.0) <= self.worst.distance + SLACK
        {
            return Ok(());
        }
        // Where d' is 0 if it changes its sign, otherwise the middle; the middle every other time, so that rounding of d' where
        // the two curves coincide does not move all divisions to one end.
        let root = a.sine / (a.sine - b.sine);
        let turns = depth.is_multiple_of(2) && (LEAST_SHARE..=1.0 - LEAST_SHARE).contains(&root);
        let share = if turns { root } else { 0.5 };
        let parameter = a.parameter + share * (b.parameter - a.parameter);
        if !(a.parameter < parameter && parameter < b.parameter) {
            return Ok(());
        }
        self.cells = self.cells.saturating_sub(1);
        if depth == 0 || self.cells == 0 {
            return Err(FollowingError { why: FollowingFault::Away, at: a.point });
        }
        let foot = self
            .boundary
            .point_at(self.index, parameter)
            .ok_or(FollowingError { why: FollowingFault::Away, at: a.point })?;
        let between = self.over(path, a.length, b.length, foot, parameter)?;
        self.cell(path, a, &between, depth - 1)?;
        self.cell(path, &between, b, depth - 1)
    }

    /// Once round an outline without corners.
    fn round(&mut self, paths: &[EdgePath]) -> Result<(), FollowingError> {
        let Some(first) = paths.first() else {
            return Err(FollowingError { why: FollowingFault::Turns, at: self.worst.at });
        };
        let (foot, parameter) = self.begin(first.start())?;
        let started = self.index;
        let mut place = (foot, parameter);
        for path in paths {
            let mut node = self.node(path, 0.0, place.0, place.1)?;
            for to in steps(path, 0.0, path.length()) {
                node = self.advance(path, node, to)?.unwrap_or_else(|corner| corner);
            }
            place = (node.foot, node.parameter);
        }
        let (passed, count) = (self.index - started, self.boundary.stretches().len());
        let closes = (place.0.point - foot.point).norm() <= CLOSES && (count - 1..=count + 1).contains(&passed);
        if closes { Ok(()) } else { Err(FollowingError { why: FollowingFault::Turns, at: first.start() }) }
    }

    /// Selects the stretch nearest to a point among those whose end normals pass on either side of it, and returns the foot there.
    fn begin(&mut self, point: Vector2<f64>) -> Result<(CurvePoint, f64), FollowingError> {
        let mut nearest: Option<(f64, usize, (CurvePoint, f64))> = None;
        for index in 0..self.boundary.stretches().len() {
            self.index = index;
            let [start, end] = self.ends(point)?;
            let (from, to) = (point - start.point, point - end.point);
            if from.dot(&start.tangent) >= -NEAR && to.dot(&end.tangent) <= NEAR {
                let place = self.foot(start, self.parameters().0, point)?;
                let away = (point - place.0.point).norm();
                if nearest.is_none_or(|(least, ..)| away < least) {
                    nearest = Some((away, index, place));
                }
            }
        }
        let (_, index, place) = nearest.ok_or(FollowingError { why: FollowingFault::Away, at: point })?;
        self.index = index;
        Ok(place)
    }

    /// From corner to corner.
    fn between_corners(&mut self, paths: &[EdgePath], corners: &[usize]) -> Result<(), FollowingError> {
        let lost = FollowingError { why: FollowingFault::Turns, at: self.worst.at };
        let mut cuts: Vec<ChainPlace> = Vec::new();
        for corner in corners {
            let corner = self.boundary.ends(*corner).ok_or(lost)?[0].point;
            let (distance, cut) = nearest(paths, corner).ok_or(lost)?;
            self.record(distance, corner);
            cuts.push(cut);
        }
        let next = cuts.iter().skip(1).chain(cuts.first());
        // In the order of the corners the dividing points go round once.
        if cuts.iter().zip(next.clone()).filter(|(from, to)| from >= to).count() != 1 {
            return Err(lost);
        }
        for ((corner, from), to) in corners.iter().zip(&cuts).zip(next) {
            self.index = *corner;
            self.corner_to_corner(paths, *from, *to)?;
        }
        Ok(())
    }

    /// From the dividing point at a corner to that at the next.
    fn corner_to_corner(&mut self, paths: &[EdgePath], from: ChainPlace, to: ChainPlace) -> Result<(), FollowingError> {
        let parts = parts(paths, from, to);
        let begin = self.worst.at;
        let mut side = FootPosition::Before;
        for (path, (start, end)) in &parts {
            if let FootPosition::On(node) = side {
                side = self.onto(path, *start, &node)?;
            }
            let mut from = *start;
            for to in steps(path, *start, *end) {
                side = self.step(path, from, to, side)?;
                from = to;
            }
        }
        let at = paths.get(to.segment).map_or(begin, |path| path.point_and_tangent(to.length).0);
        if !self.boundary.starts_at_corner(self.index + 1) {
            return Err(FollowingError { why: FollowingFault::Away, at });
        }
        match side {
            FootPosition::Before => Err(FollowingError { why: FollowingFault::Away, at }),
            FootPosition::On(node) => {
                let corner = self.ends(at)?[1].point;
                self.sliver(&node, corner);
                Ok(())
            }
            FootPosition::Beyond => Ok(()),
        }
    }

    /// Along a segment, wherever the foot is.
    fn step(
        &mut self,
        path: &EdgePath,
        from: f64,
        to: f64,
        side: FootPosition,
    ) -> Result<FootPosition, FollowingError> {
        let target = path.point_and_tangent(to).0;
        let node = match side {
            FootPosition::Before => match self.leaves(path, from, to)? {
                Some(node) => node,
                None => return Ok(FootPosition::Before),
            },
            FootPosition::On(node) => node,
            FootPosition::Beyond => {
                let corner = self.ends(target)?[1].point;
                self.record(path.farthest_from(corner, from, to), target);
                return Ok(FootPosition::Beyond);
            }
        };
        match self.advance(path, node, to)? {
            Ok(node) => Ok(FootPosition::On(node)),
            Err(border) => {
                let corner = self.ends(target)?[1].point;
                self.record(path.farthest_from(corner, border.length, to), target);
                Ok(FootPosition::Beyond)
            }
        }
    }

    /// The foot on the next segment, or the corner behind it where the chain turns across the outline.
    fn onto(&mut self, path: &EdgePath, from: f64, node: &ChainFoot) -> Result<FootPosition, FollowingError> {
        let corner = self.ends(node.point)?[1].point;
        let near = self.boundary.starts_at_corner(self.index + 1) && (node.foot.point - corner).norm() <= CORNER_REACH;
        if near && node.foot.tangent.dot(&path.point_and_tangent(from).1) < ACROSS {
            self.sliver(node, corner);
            return Ok(FootPosition::Beyond);
        }
        Ok(FootPosition::On(self.node(path, from, node.foot, node.parameter)?))
    }

    /// Where the foot leaves the corner at the start of a stretch, if it does so on a part of a segment.
    fn leaves(&mut self, path: &EdgePath, from: f64, to: f64) -> Result<Option<ChainFoot>, FollowingError> {
        let (begin, (target, tangent)) = (path.point_and_tangent(from).0, path.point_and_tangent(to));
        let corner = self.ends(target)?[0];
        if (target - corner.point).dot(&corner.tangent) <= NEAR || tangent.dot(&corner.tangent) < ACROSS {
            self.record(path.farthest_from(corner.point, from, to), target);
            return Ok(None);
        }
        let parameter = self.parameters().0;
        if (begin - corner.point).dot(&corner.tangent) > 0.0 {
            let (foot, parameter) = self.foot(corner, parameter, begin)?;
            let node = self.node(path, from, foot, parameter)?;
            self.sliver(&node, corner.point);
            return Ok(Some(node));
        }
        let node = self.over(path, from, to, corner, parameter)?;
        self.record(path.farthest_from(corner.point, from, node.length), node.point);
        Ok(Some(node))
    }

    /// Accounts for the points of the outline between a foot and a corner nearby, as seen from the point above the foot.
    fn sliver(&mut self, node: &ChainFoot, corner: Vector2<f64>) {
        self.record(farthest_of_sliver(node, corner), node.point);
    }
}

/// A bound for the distance from the point above a foot to the points of the outline between the foot and a corner nearby.
fn farthest_of_sliver(node: &ChainFoot, corner: Vector2<f64>) -> f64 {
    let apart = (node.foot.point - corner).norm();
    let seen = node.off.abs().max((node.point - corner).norm());
    seen + 0.125 * node.foot.curvature.abs() * apart * apart
}

/// The interval of d'' between two points of an edge with curvatures in this interval over one stretch; `None` where they are too
/// far apart for a bound, or Δ may reach a right angle.
fn bend((straightest, sharpest): (f64, f64), a: &ChainFoot, b: &ChainFoot, length: f64) -> Option<(f64, f64)> {
    let (first, last) = (&a.foot, &b.foot);
    let along = 0.5 * (b.parameter - a.parameter) * (first.speed + last.speed);
    let over = OVERSHOOT * along.abs() * (first.curvature_slope.abs() + last.curvature_slope.abs());
    let least = first.curvature.min(last.curvature) - over;
    let most = first.curvature.max(last.curvature) + over;
    let size = least.abs().max(most.abs());
    let at_ends = a.sine.abs().max(b.sine.abs());
    let mut sine = (at_ends + length * (straightest.abs().max(sharpest.abs()) + 1.25 * size)).min(1.0);
    let (mut low, mut high) = (0.0, 0.0);
    for _ in 0..BOUND_ROUNDS {
        let reach = 0.5 * length * sine;
        let (inner, outer) = (a.off.min(b.off) - reach, a.off.max(b.off) + reach);
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (kappa, off) in [(least, inner), (least, outer), (most, inner), (most, outer)] {
            let shrink = 1.0 + kappa * off;
            if !(shrink > LEAST_SHRINK) {
                return None;
            }
            // k − κ cos Δ/(1 + κ d), at both ends of the cosine.
            for turn in [kappa / shrink, kappa * cosine / shrink] {
                (low, high) = (low.min(straightest - turn), high.max(sharpest - turn));
            }
        }
        let before = sine;
        sine = sine.min(at_ends + 0.5 * length * low.abs().max(high.abs()));
        // Further rounds would gain little.
        if sine > SETTLED * before {
            break;
        }
    }
    if !(sine < 1.0) {
        return None;
    }
    let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
    Some((-(high * cosine).max(high), -(low * cosine).min(low)))
}

/// The highest value of a function over a length, with these values and slopes at its ends and a second derivative
/// not above `bend`: that of the lower of two parabolas, which cross once.
pub(super) fn highest((a, rise): (f64, f64), (b, fall): (f64, f64), length: f64, bend: f64) -> f64 {
    let from_a = |x: f64| a + x * (rise + 0.5 * bend * x);
    let from_b = |y: f64| b - y * (fall - 0.5 * bend * y);
    let gain = fall - rise - bend * length;
    let crossing = (a - b + fall * length - 0.5 * bend * length * length) / gain;
    let crossing = if crossing.is_finite() { crossing.clamp(0.0, length) } else { 0.5 * length };
    let mut top = a.max(b).max(from_a(crossing)).max(from_b(length - crossing));
    if bend < 0.0 {
        let (x, y) = (-rise / bend, fall / bend);
        if (0.0..crossing).contains(&x) {
            top = top.max(from_a(x));
        }
        if (0.0..length - crossing).contains(&y) {
            top = top.max(from_b(y));
        }
    }
    top
}

/// A place on the chain, compared in its order.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
struct ChainPlace {
    segment: usize,
    /// From the start of the segment, mm.
    length: f64,
}

/// The ends of the steps in which a range of a segment is followed.
fn steps(path: &EdgePath, from: f64, to: f64) -> impl Iterator<Item = f64> + use<> {
    let count = path.steps(from, to);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most eight")]
    let steps = count as u32;
    (1..=steps).map(move |step| if step == steps { to } else { from + (to - from) * f64::from(step) / count })
}

/// The segments from one place of the chain round to another, each with its range.
fn parts(paths: &[EdgePath], from: ChainPlace, to: ChainPlace) -> Vec<(EdgePath, (f64, f64))> {
    let count = paths.len();
    let last = if from < to { to.segment } else { to.segment + count };
    let parts = (from.segment..=last).filter_map(|index| {
        let path = *paths.get(index % count)?;
        let start = if index == from.segment { from.length } else { 0.0 };
        let end = if index == last { to.length } else { path.length() };
        (end - start > NEAR).then_some((path, (start, end)))
    });
    parts.collect()
}

/// The place of the chain nearest to a point, and its distance, mm.
fn nearest(paths: &[EdgePath], point: Vector2<f64>) -> Option<(f64, ChainPlace)> {
    let places = paths.iter().enumerate().map(|(segment, path)| {
        let length = path.nearest(point);
        ((path.point_and_tangent(length).0 - point).norm(), ChainPlace { segment, length })
    });
    places.min_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests;
