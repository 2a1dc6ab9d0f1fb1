//! How far a written chain G lies from an exact outline C, both ways, and that it is one simple loop: proved by following C.
//!
//! G is walked from end to end, and with it the foot t of its point g on C: g = C(t) + d n(t), n the outward normal. With Δ the
//! angle from the tangent of C to that of G, by the lengths s of G and σ of C,
//!
//! ```text
//! dσ/ds = cos Δ/(1 + κ d),   dd/ds = −sin Δ,   d²d/ds² = −cos Δ (k − κ cos Δ/(1 + κ d)),   k the curvature of G
//! ```
//!
//! The chain is cut where a segment ends, where a stretch of C ends and, if need be, between. In such a cell k is constant, or
//! within an interval that is proved of a cubic edge, and κ lies between what its two ends say, so d'' lies in an interval; two parabolas that start from the ends with the exact d and d'
//! then bound d. A cell whose bound stays below the largest |d| found is done; another is cut where d' is 0 to first order. What
//! is told is the largest |d| to [`SLACK`].
//!
//! **Why this is the whole statement.** Each |d| is the distance of g from a point of C: max over G of dist(·, C) ≤ max |d|. While
//! cos Δ > 0 and 1 + κ d > 0, which is checked in every cell, t grows along G without a jump. When G has closed and t has made
//! exactly one turn, every point of C is the foot of exactly one point of G: max over C of dist(·, G) ≤ max |d|, too. G then is
//! the graph d(t) over C: it does not cross itself as long as 1 + κ d > 0 wherever two feet are near, its tangent stays
//! within a right angle of that of C, so that it turns by 2π like C, and it runs in the sense of C.
//!
//! **Corners.** At a corner K of C the chain is cut where it comes nearest to K. On either side the foot stays on its own side of
//! the corner: where it would run beyond K it is K, and the distance that from K. Where it has not got to K yet, the points of C
//! between them lie no farther from the cut than foot and K do, but for the curvature of so short a stretch, which is added.
//! A chain that runs across the outline near K, as the end of a plate does behind a flank that is a little off, is seen from K.

use super::CurvePoint;
use super::boundary::Boundary;
use super::contour::Contour;
use super::course::Course;
use nalgebra::Vector2;

/// The largest distance that is told is not more than this below the true one, mm.
pub const SLACK: f64 = 1e-10;
/// A foot is found when the point is that near to its normal, mm: the distance then is right to its square times the curvature.
const ON_NORMAL: f64 = 1e-10;
/// Places along the chain nearer than this are one, mm.
const NEAR: f64 = 1e-9;
/// After one turn the foot stands where it began, mm: a corner too small to be one, of 1e-7 rad under a roller of 100 mm, moves it that far.
const CLOSES: f64 = 1e-5;
/// Where the foot is that near to a corner, mm, a chain that turns across the outline, with a cosine below this, has got to it.
const CORNER_REACH: f64 = 0.1;
const ACROSS: f64 = 0.1;
/// A cell is cut where d' is 0 to first order if both parts keep this share of it at the least: cut near its end again and again
/// it would not grow shorter.
const LEAST_SHARE: f64 = 0.02;
/// Cuts of a cell at the most, every other one in its middle, and Newton steps to a foot.
const DEEPEST: u32 = 48;
const FOOT_STEPS: u32 = 64;
/// Cells that are cut at the most, and more for every segment and stretch. A chain near an outline needs a few for each; along the
/// centres of curvature of one there is no bound, and all would be cut to nothing.
const MOST_CELLS: usize = 100_000;
const MOST_PER_SEGMENT: usize = 500;
/// How far a cubic overshoots its ends, over its length and the sum of its slopes there: 4/27.
pub(super) const OVERSHOOT: f64 = 4.0 / 27.0;
/// Rounds of the bound, which feeds on itself, the share of it from which on no further one is made, and the least 1 + κ d it is made for.
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

/// Why a chain cannot be followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Astray {
    /// It turns back, or across the outline.
    Back,
    /// It leaves the outline, or begins too far from it.
    Away,
    /// It does not go round exactly once.
    Turns,
}

/// Where a chain cannot be followed any more, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lost {
    /// What it does.
    pub why: Astray,
    /// Where, mm.
    pub at: Vector2<f64>,
}

/// The largest distance between chain and outline, either way, when the chain follows the outline round.
///
/// # Errors
/// [`Lost`] when it does not.
pub fn follow(contour: &Contour, boundary: &Boundary<'_>) -> Result<Deviation, Lost> {
    let courses: Vec<Course> = contour.edges().flat_map(|edge| Course::of(&edge)).collect();
    let origin = courses.first().map_or_else(Vector2::zeros, Course::start);
    let cells = MOST_CELLS + MOST_PER_SEGMENT * (courses.len() + boundary.stretches().len());
    let mut walk = Walk { boundary, index: 0, cells, worst: Deviation { distance: 0.0, at: origin } };
    let count = boundary.stretches().len();
    let corners: Vec<usize> = (0..count).filter(|index| boundary.starts_at_corner(*index)).collect();
    if corners.is_empty() {
        walk.round(&courses)?;
    } else {
        walk.between_corners(&courses, &corners)?;
    }
    Ok(walk.worst)
}

/// A point of the chain with its foot.
#[derive(Debug, Clone, Copy)]
struct Node {
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

/// Where the foot is on a part of the outline between two corners.
#[derive(Clone, Copy)]
enum Side {
    /// On the corner at its start.
    Before,
    On(Node),
    /// On the corner at its end.
    Beyond,
}

struct Walk<'b, 'a> {
    boundary: &'b Boundary<'a>,
    /// The stretch of the foot, counted on round and round.
    index: usize,
    /// Cells that may still be looked at.
    cells: usize,
    worst: Deviation,
}

impl Walk<'_, '_> {
    fn record(&mut self, distance: f64, at: Vector2<f64>) {
        if distance > self.worst.distance {
            self.worst = Deviation { distance, at };
        }
    }

    fn ends(&self, at: Vector2<f64>) -> Result<[CurvePoint; 2], Lost> {
        self.boundary.ends(self.index).copied().ok_or(Lost { why: Astray::Away, at })
    }

    fn parameters(&self) -> (f64, f64) {
        let stretches = self.boundary.stretches();
        stretches.get(self.index % stretches.len().max(1)).map_or((0.0, 0.0), |stretch| (stretch.from, stretch.to))
    }

    /// A point of a segment over a foot.
    fn node(&mut self, course: &Course, length: f64, foot: CurvePoint, parameter: f64) -> Result<Node, Lost> {
        let (point, tangent) = course.at(length);
        let off = (point - foot.point).dot(&foot.outward());
        // A segment that short has any direction where its ends were rounded.
        if !(foot.tangent.dot(&tangent) > 0.0) && course.length() > NEAR {
            return Err(Lost { why: Astray::Back, at: point });
        }
        if !(1.0 + foot.curvature * off > 0.0) {
            return Err(Lost { why: Astray::Away, at: point });
        }
        self.record(off.abs(), point);
        Ok(Node { length, point, foot, parameter, off, sine: foot.tangent.perp(&tangent) })
    }

    /// Where the normal of a foot meets a segment between two lengths.
    fn over(
        &mut self,
        course: &Course,
        (from, to): (f64, f64),
        foot: CurvePoint,
        parameter: f64,
    ) -> Result<Node, Lost> {
        let (_, length) =
            course.hit(foot.point, foot.outward()).ok_or_else(|| Lost { why: Astray::Away, at: course.at(from).0 })?;
        if !(from - NEAR..=to + NEAR).contains(&length) {
            return Err(Lost { why: Astray::Back, at: course.at(from).0 });
        }
        self.node(course, length.clamp(from, to), foot, parameter)
    }

    /// The foot of a point in the present stretch, from a place before it to the end of the stretch.
    fn foot(&self, mut foot: CurvePoint, mut parameter: f64, point: Vector2<f64>) -> Result<(CurvePoint, f64), Lost> {
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
                // Rounding takes a segment of no length to speak of back.
                return if ahead >= -NEAR { Ok((foot, parameter)) } else { Err(Lost { why: Astray::Back, at: point }) };
            } else {
                high = parameter;
            }
            // On the circle of curvature the foot is there at once.
            let (rise, run) = (foot.curvature * ahead, 1.0 + foot.curvature * off);
            let along =
                if rise.abs() > 1e-3 * run.abs() { libm::atan2(rise, run) / foot.curvature } else { ahead / run };
            let next = parameter + along / foot.speed;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if next == parameter {
                break;
            }
            parameter = next;
            foot = self.boundary.at(self.index, parameter).ok_or(Lost { why: Astray::Away, at: point })?;
        }
        Ok((foot, parameter))
    }

    /// From a point of a segment to one further on; `Err` of the inner result where the foot comes to a corner.
    fn advance(&mut self, course: &Course, mut from: Node, to: f64) -> Result<Result<Node, Node>, Lost> {
        let target = course.at(to).0;
        for _ in 0..=self.boundary.stretches().len() {
            let end = self.ends(target)?[1];
            if (target - end.point).dot(&end.tangent) <= 0.0 {
                let (foot, parameter) = self.foot(from.foot, from.parameter, target)?;
                let there = self.node(course, to, foot, parameter)?;
                self.cell(course, &from, &there, DEEPEST)?;
                return Ok(Ok(there));
            }
            let last = self.parameters().1;
            let border = self.over(course, (from.length, to), end, last)?;
            self.cell(course, &from, &border, DEEPEST)?;
            if self.boundary.starts_at_corner(self.index + 1) {
                return Ok(Err(border));
            }
            self.index += 1;
            let start = self.ends(target)?[0];
            from = self.node(course, border.length, start, self.parameters().0)?;
        }
        Err(Lost { why: Astray::Turns, at: target })
    }

    /// The largest |d| between two points of a segment over one stretch.
    fn cell(&mut self, course: &Course, a: &Node, b: &Node, depth: u32) -> Result<(), Lost> {
        let length = b.length - a.length;
        if length <= NEAR {
            // d' is a sine: it changes by no more than the two curves turn.
            let (least, most) = course.curvature_between(a.length, b.length);
            let sharpest = least.abs().max(most.abs());
            let turn = length * (sharpest + 1.25 * a.foot.curvature.abs().max(b.foot.curvature.abs()));
            let slope = (a.sine.abs().max(b.sine.abs()) + turn).min(1.0);
            self.record(a.off.abs().max(b.off.abs()) + 0.5 * length.max(0.0) * slope, b.point);
            return Ok(());
        }
        if let Some(bend) = bend(course.curvature_between(a.length, b.length), a, b, length)
            && highest((a.off, -a.sine), (b.off, -b.sine), length, bend.1) <= self.worst.distance + SLACK
            && highest((-a.off, a.sine), (-b.off, b.sine), length, -bend.0) <= self.worst.distance + SLACK
        {
            return Ok(());
        }
        // Where d' is 0 if it changes its sign, else the middle; the middle every other time, so that no rounding of d' where
        // the two curves run together takes all cuts to one end.
        let root = a.sine / (a.sine - b.sine);
        let turns = depth.is_multiple_of(2) && (LEAST_SHARE..=1.0 - LEAST_SHARE).contains(&root);
        let share = if turns { root } else { 0.5 };
        let parameter = a.parameter + share * (b.parameter - a.parameter);
        if !(a.parameter < parameter && parameter < b.parameter) {
            return Ok(());
        }
        self.cells = self.cells.saturating_sub(1);
        if depth == 0 || self.cells == 0 {
            return Err(Lost { why: Astray::Away, at: a.point });
        }
        let foot = self.boundary.at(self.index, parameter).ok_or(Lost { why: Astray::Away, at: a.point })?;
        let between = self.over(course, (a.length, b.length), foot, parameter)?;
        self.cell(course, a, &between, depth - 1)?;
        self.cell(course, &between, b, depth - 1)
    }

    /// Once round an outline without corners.
    fn round(&mut self, courses: &[Course]) -> Result<(), Lost> {
        let Some(first) = courses.first() else {
            return Err(Lost { why: Astray::Turns, at: self.worst.at });
        };
        let (foot, parameter) = self.begin(first.start())?;
        let started = self.index;
        let mut place = (foot, parameter);
        for course in courses {
            let mut node = self.node(course, 0.0, place.0, place.1)?;
            for to in steps(course, (0.0, course.length())) {
                node = self.advance(course, node, to)?.unwrap_or_else(|corner| corner);
            }
            place = (node.foot, node.parameter);
        }
        let (passed, count) = (self.index - started, self.boundary.stretches().len());
        let closes = (place.0.point - foot.point).norm() <= CLOSES && (count - 1..=count + 1).contains(&passed);
        if closes { Ok(()) } else { Err(Lost { why: Astray::Turns, at: first.start() }) }
    }

    /// Takes the stretch nearest to a point among those whose normals pass on either side of it, and gives its foot there.
    fn begin(&mut self, point: Vector2<f64>) -> Result<(CurvePoint, f64), Lost> {
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
        let (_, index, place) = nearest.ok_or(Lost { why: Astray::Away, at: point })?;
        self.index = index;
        Ok(place)
    }

    /// From corner to corner.
    fn between_corners(&mut self, courses: &[Course], corners: &[usize]) -> Result<(), Lost> {
        let lost = Lost { why: Astray::Turns, at: self.worst.at };
        let mut cuts: Vec<(usize, f64)> = Vec::new();
        for corner in corners {
            let corner = self.boundary.ends(*corner).ok_or(lost)?[0].point;
            let (distance, cut) = nearest(courses, corner).ok_or(lost)?;
            self.record(distance, corner);
            cuts.push(cut);
        }
        let next = cuts.iter().skip(1).chain(cuts.first());
        // In the order of the corners the cuts go round once.
        if cuts.iter().zip(next.clone()).filter(|(from, to)| from >= to).count() != 1 {
            return Err(lost);
        }
        for ((corner, from), to) in corners.iter().zip(&cuts).zip(next) {
            self.index = *corner;
            self.corner_to_corner(courses, *from, *to)?;
        }
        Ok(())
    }

    /// From the cut at a corner to that at the next.
    fn corner_to_corner(&mut self, courses: &[Course], from: (usize, f64), to: (usize, f64)) -> Result<(), Lost> {
        let parts = parts(courses, from, to);
        let begin = self.worst.at;
        let mut side = Side::Before;
        for (course, (from, to)) in &parts {
            if let Side::On(node) = side {
                side = self.onto(course, *from, &node)?;
            }
            let mut from = *from;
            for to in steps(course, (from, *to)) {
                side = self.step(course, (from, to), side)?;
                from = to;
            }
        }
        let at = courses.get(to.0).map_or(begin, |course| course.at(to.1).0);
        if !self.boundary.starts_at_corner(self.index + 1) {
            return Err(Lost { why: Astray::Away, at });
        }
        match side {
            Side::Before => Err(Lost { why: Astray::Away, at }),
            Side::On(node) => {
                let corner = self.ends(at)?[1].point;
                self.sliver(&node, corner);
                Ok(())
            }
            Side::Beyond => Ok(()),
        }
    }

    /// Along a segment, wherever the foot is.
    fn step(&mut self, course: &Course, (from, to): (f64, f64), side: Side) -> Result<Side, Lost> {
        let target = course.at(to).0;
        let node = match side {
            Side::Before => match self.leaves(course, (from, to))? {
                Some(node) => node,
                None => return Ok(Side::Before),
            },
            Side::On(node) => node,
            Side::Beyond => {
                let corner = self.ends(target)?[1].point;
                self.record(course.farthest_from(corner, (from, to)), target);
                return Ok(Side::Beyond);
            }
        };
        match self.advance(course, node, to)? {
            Ok(node) => Ok(Side::On(node)),
            Err(border) => {
                let corner = self.ends(target)?[1].point;
                self.record(course.farthest_from(corner, (border.length, to)), target);
                Ok(Side::Beyond)
            }
        }
    }

    /// The same foot on the next segment, or the corner behind it where the chain turns across the outline.
    fn onto(&mut self, course: &Course, from: f64, node: &Node) -> Result<Side, Lost> {
        let corner = self.ends(node.point)?[1].point;
        let near = self.boundary.starts_at_corner(self.index + 1) && (node.foot.point - corner).norm() <= CORNER_REACH;
        if near && node.foot.tangent.dot(&course.at(from).1) < ACROSS {
            self.sliver(node, corner);
            return Ok(Side::Beyond);
        }
        Ok(Side::On(self.node(course, from, node.foot, node.parameter)?))
    }

    /// Where the foot leaves the corner at the start of a stretch, if it does on a part of a segment.
    fn leaves(&mut self, course: &Course, (from, to): (f64, f64)) -> Result<Option<Node>, Lost> {
        let (begin, (target, tangent)) = (course.at(from).0, course.at(to));
        let corner = self.ends(target)?[0];
        let ahead = |point: Vector2<f64>| (point - corner.point).dot(&corner.tangent);
        if ahead(target) <= NEAR || tangent.dot(&corner.tangent) < ACROSS {
            self.record(course.farthest_from(corner.point, (from, to)), target);
            return Ok(None);
        }
        let parameter = self.parameters().0;
        if ahead(begin) > 0.0 {
            let (foot, parameter) = self.foot(corner, parameter, begin)?;
            let node = self.node(course, from, foot, parameter)?;
            self.sliver(&node, corner.point);
            return Ok(Some(node));
        }
        let node = self.over(course, (from, to), corner, parameter)?;
        self.record(course.farthest_from(corner.point, (from, node.length)), node.point);
        Ok(Some(node))
    }

    /// The points of the outline between a foot and a corner nearby, seen from the point over the foot.
    fn sliver(&mut self, node: &Node, corner: Vector2<f64>) {
        self.record(farthest_of_sliver(node, corner), node.point);
    }
}

/// What the distance from the point over a foot to the points of the outline between the foot and a corner nearby does not exceed.
fn farthest_of_sliver(node: &Node, corner: Vector2<f64>) -> f64 {
    let apart = (node.foot.point - corner).norm();
    let seen = node.off.abs().max((node.point - corner).norm());
    seen + 0.125 * node.foot.curvature.abs() * apart * apart
}

/// The interval in which d'' lies between two points of an edge with curvatures in this interval over one stretch; `None` where they are too
/// far apart to tell, or Δ may reach a right angle.
fn bend((straightest, sharpest): (f64, f64), a: &Node, b: &Node, length: f64) -> Option<(f64, f64)> {
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
        // Not much more is to be had.
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

/// The highest value that a function can have over a length, with these values and slopes at its ends and a second derivative
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

/// The ends of the steps in which a range of a segment is walked.
fn steps(course: &Course, (from, to): (f64, f64)) -> impl Iterator<Item = f64> + use<> {
    let count = course.steps((from, to));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most eight")]
    let steps = count as u32;
    (1..=steps).map(move |step| if step == steps { to } else { from + (to - from) * f64::from(step) / count })
}

/// The segments from one place of the chain round to another, each with its range.
fn parts(courses: &[Course], from: (usize, f64), to: (usize, f64)) -> Vec<(Course, (f64, f64))> {
    let count = courses.len();
    let last = if from < to { to.0 } else { to.0 + count };
    let part = |index: usize| {
        let course = *courses.get(index % count)?;
        let start = if index == from.0 { from.1 } else { 0.0 };
        let end = if index == last { to.1 } else { course.length() };
        Some((course, (start, end)))
    };
    (from.0..=last).filter_map(part).filter(|(_, (from, to))| to - from > NEAR).collect()
}

/// The nearest place of the chain seen from a point: its distance, and the segment with the length along it.
fn nearest(courses: &[Course], point: Vector2<f64>) -> Option<(f64, (usize, f64))> {
    let of = |(index, course): (usize, &Course)| {
        let along = course.nearest(point);
        ((course.at(along).0 - point).norm(), (index, along))
    };
    courses.iter().enumerate().map(of).min_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests;
