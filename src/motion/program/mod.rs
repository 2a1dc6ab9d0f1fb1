//! A motion program: segments that follow each other over one turn of the cam, or a lobe of it, each with its law.
//!
//! A segment begins in the state in which the one before ended, the first in that of the last. What its two ends are (VDI 2143: at rest,
//! moving, turning back) follows from these states; its law is solved for them.

mod forms;
mod joined;
pub(crate) mod keys;
mod optimum;
mod polydyne;
pub(crate) mod read;
mod spectrum;
mod told;
mod with_law;

pub use polydyne::Polydyne;
pub use spectrum::{Harmonics, Movement};
pub use told::{Class, Jump, SegmentTold};

use super::laws::optimum::Optimum;
use super::laws::{self, Curve, End, Inflection, Law, LawError, Parameters, Task, polynomial};
use super::{CELLS as CELLS_OF_MOVEMENT, Jet, Motion, Piece, Quantity};
use crate::numeric::extremum;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::OnceLock;

/// Most cells in which the lowest point of a part is searched: it may bulge below its ends when it begins or ends in motion.
const CELLS: u32 = 16;
/// Least cells of a part of a curve in a short piece of a segment.
const LEAST_CELLS: u32 = 8;

/// The lift, the velocity, the acceleration and the jerk are continuous on a piece.
const SMOOTH: u32 = 3;

/// A travel of less than this share of all positions is none: a law has nothing to scale.
const NO_TRAVEL: f64 = 1e-12;

/// A rate of less than this share of its peak is 0 and its rounding.
const ROUNDING: f64 = 1e-9;

/// Rates by the cam angle at the end of a segment: m or rad per rad, per rad² and per rad³.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// Of the position.
    pub velocity: f64,
    /// Free at a turn.
    pub acceleration: f64,
    /// Where it is asked for.
    pub jerk: Option<f64>,
    /// The motion turns back: velocity 0, any acceleration.
    pub turns: bool,
    /// Velocity and acceleration are found: those of least jerk over the polynomials and splines that meet there.
    pub free: [bool; 2],
}

impl State {
    /// Velocity and acceleration 0.
    #[must_use]
    pub fn rests(&self) -> bool {
        self.velocity == 0.0 && self.acceleration == 0.0 && !self.turns
    }

    /// As an end of a law for a segment of a travel and a width (rad); `None` where it is accelerated.
    fn end(&self, travel: f64, width: f64) -> Option<End> {
        if self.turns {
            return Some(End::Turn);
        }
        let end =
            if self.velocity == 0.0 { End::Rest } else { End::Moving { velocity: self.velocity * width / travel } };
        (self.acceleration == 0.0).then_some(end)
    }

    /// As conditions of a polynomial over a width (rad): the derivatives that are not free.
    fn conditions(&self, position: f64, width: f64) -> Vec<f64> {
        let mut all = vec![position, self.velocity * width];
        if !self.turns {
            all.push(self.acceleration * width * width);
            all.extend(self.jerk.map(|jerk| jerk * width * width * width));
        }
        all
    }
}

/// What moves a segment.
#[derive(Debug, Clone)]
pub enum Mover {
    /// Nothing: a dwell.
    Dwell,
    /// A law, with the place of its inflection and its own numbers.
    Law(&'static Law, Inflection, Parameters),
    /// The inflection is where the acceleration at the turn is that of the neighbour.
    Matching(&'static Law, Parameters),
    /// The polynomial of the states at both ends.
    Polynomial,
    /// A spline of least jerk through inner points: angle behind the start of the segment, rad, and position.
    Spline(Vec<[f64; 2]>),
    /// A curve of its own from 0 to 1, and what its law is called.
    Own(&'static str, Curve),
    /// The polynomial from rest to rest that makes something least.
    Optimum(Optimum, Curve),
}

impl Mover {
    /// What its law is called.
    fn name(&self) -> &'static str {
        match self {
            Mover::Dwell => keys::DWELL,
            Mover::Law(law, ..) | Mover::Matching(law, _) => law.name,
            Mover::Polynomial | Mover::Optimum(..) => keys::POLYNOMIAL,
            Mover::Spline(_) => keys::SPLINE,
            Mover::Own(name, _) => name,
        }
    }

    /// What its curve makes least.
    fn optimum(&self) -> Option<Optimum> {
        if let Mover::Optimum(optimum, _) = self { Some(*optimum) } else { None }
    }
}

/// A segment as it is asked for.
#[derive(Debug, Clone)]
pub struct Step {
    /// What moves it.
    pub mover: Mover,
    /// Cam angle it takes, rad; the last takes the rest.
    pub over: f64,
    /// Position at its end, m or rad.
    pub to: f64,
    /// State at its end.
    pub end: State,
}

/// Why a segment cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// The law does not serve its ends.
    #[error(transparent)]
    Law(#[from] LawError),
    /// An end is accelerated.
    #[error(
        "{law} cannot begin or end with an acceleration; law = \"polynomial\" can, or end = \"turn\" with velocity 0"
    )]
    Accelerated {
        /// The law.
        law: &'static str,
    },
    /// Nothing to scale a law by.
    #[error("the segment ends where it begins: {law} needs a travel; law = \"dwell\" or \"polynomial\" does not")]
    NoTravel {
        /// The law.
        law: &'static str,
    },
    /// There is no neighbour to match.
    #[error(
        "inflection = \"match\" takes the acceleration at a turn from the neighbour on its other side, which is solved before"
    )]
    NothingToMatch,
    /// An end is to be found, and there is no spline to find it by.
    #[error(
        "\"auto\" finds the state of least jerk between two polynomials or splines, and {law} is none: give the state"
    )]
    NothingToJoin {
        /// The law beside the end.
        law: &'static str,
    },
    /// A jerk is given where a spline has its own.
    #[error("beside a spline or a state that is \"auto\" the jerk follows: leave `jerk` out")]
    JerkOfSpline,
    /// An end of an optimum moves.
    #[error("an optimum leads from rest to rest; an end of this one has a velocity, an acceleration, a jerk or a turn")]
    OptimumMoves,
}

/// A segment between two positions.
#[derive(Debug, Clone)]
struct Segment {
    /// `None` rests.
    curve: Option<Curve>,
    /// What its law is called.
    name: &'static str,
    /// First angle and width, rad.
    start: f64,
    width: f64,
    from: f64,
    /// By what its curve is multiplied.
    travel: f64,
    /// Where it ends.
    to: f64,
    ends: [State; 2],
    /// It is the whole motion, given in one.
    whole: bool,
    /// What its curve makes least.
    optimum: Option<Optimum>,
}

/// What a piece of the motion is: parts of the curve of a segment.
#[derive(Debug, Clone)]
struct Source {
    segment: usize,
    parts: Range<usize>,
}

/// The curve of a law from rest to rest; of a law that has none, one from rest to a turn or, last, its straight line: the
/// motion then jumps as such a law does.
fn curve(law: &Law) -> Curve {
    let tasks = [Task::default(), Task::between(End::Rest, End::Turn)];
    tasks.iter().find_map(|task| law.solve(task).ok()).unwrap_or_else(Curve::line)
}

/// A motion of segments over one turn, or one lobe of it.
#[derive(Debug, Clone)]
pub struct Program {
    quantity: Quantity,
    rpm: Option<f64>,
    lobes: u32,
    pieces: Vec<Piece>,
    /// Of the pieces of the first lobe.
    sources: Vec<Source>,
    segments: Vec<Segment>,
    lowest: f64,
    /// The load for which it is the motion of the cam.
    load: Option<Polydyne>,
    /// What is told of the segments, once it is asked for.
    told: OnceLock<Vec<SegmentTold>>,
}

impl Program {
    /// Segments of law (`None` rests), cam angle (rad) and end position (m, or rad of a swing), from a position on.
    ///
    /// Each law leads from rest to rest; one that cannot ([`Law::serves_rests`]) leaves a jump where it begins or ends.
    #[must_use]
    pub fn new(quantity: Quantity, start: f64, segments: &[(Option<&'static Law>, f64, f64)]) -> Self {
        let mut program = Self::empty(quantity, 1);
        let (mut angle, mut position) = (0.0, start);
        for (index, (law, over, to)) in segments.iter().enumerate() {
            let end = if index + 1 == segments.len() { TAU } else { angle + over };
            let to = if law.is_some() { *to } else { position };
            let (width, travel, ends) = (end - angle, to - position, [State::default(); 2]);
            let (curve, name) = (law.map(curve), law.map_or(keys::DWELL, |law| law.name));
            let (whole, optimum) = (false, None);
            let segment =
                Segment { curve, name, start: angle, width, from: position, travel, to, ends, whole, optimum };
            program.add(segment, end);
            (angle, position) = (end, to);
        }
        program.finished()
    }

    /// Segments from a position and a cam angle (rad) on, in so many equal lobes.
    ///
    /// # Errors
    /// The first segment that cannot be made, and why.
    pub fn of_steps(
        quantity: Quantity,
        (at, start, lobes): (f64, f64, u32),
        steps: &[Step],
    ) -> Result<Self, (usize, StepError)> {
        let mut program = Self::empty(quantity, lobes.max(1));
        let whole = TAU / f64::from(lobes.max(1));
        optimum::check(steps)?;
        let (steps, joined) = joined::solved(start, steps)?;
        let curves = solved(start, &steps, joined)?;
        let (mut angle, mut position) = (at, start);
        let mut before = steps.last().map_or_else(State::default, |step| step.end);
        for (index, (step, (curve, travel))) in steps.iter().zip(curves).enumerate() {
            let end = if index + 1 == steps.len() { at + whole } else { angle + step.over };
            let ends = [before, step.end];
            let (name, width, to) = (step.mover.name(), end - angle, step.to);
            let (whole, optimum) = (false, step.mover.optimum());
            let segment =
                Segment { curve, name, start: angle, width, from: position, travel, to, ends, whole, optimum };
            program.add(segment, end);
            (angle, position, before) = (end, step.to, step.end);
        }
        program.repeat(whole);
        Ok(program.finished())
    }

    /// One curve over a turn, or over each of so many equal lobes of it, from a cam angle (rad) on: positions above a first one, m or rad,
    /// by the share of the turn or lobe.
    fn of_curve(quantity: Quantity, (at, lobes): (f64, u32), from: f64, (name, curve): (&'static str, Curve)) -> Self {
        let mut program = Self::empty(quantity, lobes.max(1));
        let width = TAU / f64::from(lobes.max(1));
        let ([_, velocity, acceleration, _], peaks) = (curve.at(0, 0.0), curve.peaks());
        let exact = |value: f64, peak: f64| if value.abs() > ROUNDING * peak { value } else { 0.0 };
        let state = State {
            velocity: exact(velocity, peaks.velocity.value) / width,
            acceleration: exact(acceleration, peaks.acceleration.value) / (width * width),
            ..State::default()
        };
        let (curve, ends) = (Some(curve), [state; 2]);
        let (travel, to, whole, optimum) = (1.0, from, true, None);
        let segment = Segment { curve, name, start: at, width, from, travel, to, ends, whole, optimum };
        program.add(segment, at + width);
        program.repeat(width);
        program.finished()
    }

    fn empty(quantity: Quantity, lobes: u32) -> Self {
        let (pieces, sources, segments) = (Vec::new(), Vec::new(), Vec::new());
        Self { quantity, rpm: None, lobes, pieces, sources, segments, lowest: 0.0, load: None, told: OnceLock::new() }
    }

    /// With its lowest place.
    fn finished(mut self) -> Self {
        let least = self.pieces.iter().zip(&self.sources).enumerate().map(|(index, (piece, source))| {
            let all = |at: f64| {
                let position = self.position(index, at);
                [position.s, position.ds, position.dds]
            };
            let curve = self.segments.get(source.segment).and_then(|segment| segment.curve.as_ref());
            let cells = curve.map_or(1, |curve| source.parts.clone().map(|part| curve.cells(part).min(CELLS)).sum());
            -extremum::both_ways_with_bend(all, (piece.start, piece.end), cells)[1].value
        });
        self.lowest = least.fold(f64::INFINITY, f64::min);
        self
    }

    /// The pieces of the other lobes, a lobe (rad) after each other.
    fn repeat(&mut self, whole: f64) {
        let (own, count) = (self.pieces.clone(), self.lobes);
        let first = own.first().map_or(0.0, |piece| piece.start);
        for lobe in 1..count {
            let shift = whole * f64::from(lobe);
            for (index, piece) in own.iter().enumerate() {
                let start = self.pieces.last().map_or(piece.start + shift, |before| before.end);
                let last = lobe + 1 == count && index + 1 == own.len();
                let end = if last { first + TAU } else { piece.end + shift };
                self.pieces.push(Piece { start, end, ..*piece });
            }
        }
    }

    /// Speed of the cam, rpm, when it is given.
    #[must_use]
    pub fn rpm(&self) -> Option<f64> {
        self.rpm
    }

    /// The elastic load for which it is the motion of the cam.
    #[must_use]
    pub fn load(&self) -> Option<Polydyne> {
        self.load
    }

    /// A segment to its last angle, in pieces that end where a derivative up to the jerk jumps.
    fn add(&mut self, segment: Segment, end: f64) {
        let (index, dwell) = (self.segments.len(), segment.curve.is_none());
        let groups =
            segment.curve.as_ref().map_or_else(|| std::iter::once(0..1).collect(), |curve| curve.smooth_to(SMOOTH));
        let mut start = segment.start;
        for parts in groups {
            let joint = segment.curve.as_ref().map(|curve| curve.range_of(parts.end.saturating_sub(1)).1);
            let until = joint.filter(|joint| *joint < 1.0).map_or(end, |joint| segment.start + segment.width * joint);
            // A stretch too short for two angles is none.
            if start < until || parts.start == 0 {
                self.pieces.push(Piece { start, end: until, dwell });
                self.sources.push(Source { segment: index, parts });
                start = until;
            }
        }
        self.segments.push(segment);
        self.told = OnceLock::new();
    }

    /// The position in the program, with its derivatives.
    fn position(&self, piece: usize, angle: f64) -> Jet {
        let own = self.sources.len().max(1);
        let (lobe, piece) = (piece / own, piece % own);
        #[expect(clippy::cast_precision_loss, reason = "at most a hundred lobes")]
        let angle = angle - TAU * (lobe as f64 / f64::from(self.lobes));
        let source = self.sources.get(piece);
        let Some((source, segment)) = source.and_then(|source| Some((source, self.segments.get(source.segment)?)))
        else {
            return Jet::default();
        };
        let Some(curve) = &segment.curve else { return Jet { s: segment.from, ..Jet::default() } };
        let x = ((angle - segment.start) / segment.width).clamp(0.0, 1.0);
        // At a joint between pieces rounding may lead to the neighbour, which has another jerk.
        let part = curve.part_of(x).clamp(source.parts.start, source.parts.end.saturating_sub(1));
        let [s, ds, dds, ddds] = curve.at(part, x);
        let shape = Jet { s, ds, dds, ddds }.by_angle_times(segment.width).scaled(segment.travel);
        Jet { s: segment.from + shape.s, ..shape }
    }
}

/// A curve, none of a dwell, and by what it is multiplied.
type Made = (Option<Curve>, f64);

/// The curve of every segment: those that match a neighbour at a turn after the others.
fn solved(start: f64, steps: &[Step], joined: Vec<Option<Curve>>) -> Result<Vec<Made>, (usize, StepError)> {
    let size = steps.iter().map(|step| step.to.abs()).fold(start.abs(), f64::max);
    let before = |index: usize| if index == 0 { steps.last() } else { steps.get(index - 1) };
    let of = |index: usize, step: &Step, acceleration: Option<[Option<f64>; 2]>| {
        let from = if index == 0 { start } else { before(index).map_or(start, |step| step.to) };
        let begin = before(index).map_or_else(State::default, |step| step.end);
        one(step, (from, begin), size, acceleration)
    };
    let mut all = Vec::with_capacity(steps.len());
    for ((index, step), joined) in steps.iter().enumerate().zip(joined) {
        if joined.is_some() {
            all.push(Some((joined, 1.0)));
            continue;
        }
        let waits = matches!(step.mover, Mover::Matching(..));
        all.push(if waits { None } else { Some(of(index, step, None).map_err(|error| (index, error))?) });
    }
    let known: Vec<Option<[f64; 2]>> = all
        .iter()
        .zip(steps)
        .map(|(made, step)| made.as_ref().map(|(curve, travel)| accelerations(curve.as_ref(), *travel, step.over)))
        .collect();
    let count = steps.len();
    for (index, step) in steps.iter().enumerate() {
        if matches!(step.mover, Mover::Matching(..)) {
            let neighbour = |at: usize| known.get(at % count.max(1)).copied().flatten();
            let (before, after) = (neighbour(index + count - 1), neighbour(index + 1));
            let beside = [before.map(|[_, last]| last), after.map(|[first, _]| first)];
            let made = of(index, step, Some(beside)).map_err(|error| (index, error))?;
            if let Some(place) = all.get_mut(index) {
                *place = Some(made);
            }
        }
    }
    Ok(all.into_iter().flatten().collect())
}

/// Accelerations of a curve at both ends, by the cam angle.
fn accelerations(curve: Option<&Curve>, travel: f64, width: f64) -> [f64; 2] {
    let Some(curve) = curve else { return [0.0; 2] };
    let scale = travel / (width * width);
    [curve.derivative(0, 0.0, 2) * scale, curve.derivative(curve.parts().saturating_sub(1), 1.0, 2) * scale]
}

/// The curve of a segment from a position and a state on, and by what it is multiplied; with the accelerations of the neighbours at its
/// ends where it is to match one.
fn one(
    step: &Step,
    (from, begin): (f64, State),
    size: f64,
    beside: Option<[Option<f64>; 2]>,
) -> Result<Made, StepError> {
    let (travel, width) = (step.to - from, step.over);
    if !matches!(step.mover, Mover::Dwell | Mover::Polynomial | Mover::Spline(_)) && !(travel.abs() > NO_TRAVEL * size)
    {
        let law = if step.mover.optimum().is_some() { "an optimum" } else { step.mover.name() };
        return Err(StepError::NoTravel { law });
    }
    let (law, inflection, parameters) = match &step.mover {
        Mover::Dwell => return Ok((None, 0.0)),
        Mover::Own(_, curve) | Mover::Optimum(_, curve) => return Ok((Some(curve.clone()), travel)),
        Mover::Polynomial | Mover::Spline(_) => {
            let (first, last) = (begin.conditions(0.0, width), step.end.conditions(travel, width));
            return Ok((Some(polynomial::hermite(&first, &last)), 1.0));
        }
        Mover::Law(law, inflection, parameters) => (*law, *inflection, *parameters),
        Mover::Matching(law, parameters) => {
            let [before, after] = beside.unwrap_or_default();
            let wanted = if step.end.turns { after } else { before.filter(|_| begin.turns) };
            let acceleration = wanted.ok_or(StepError::NothingToMatch)? * width * width / travel;
            (*law, Inflection::Match { acceleration }, *parameters)
        }
    };
    if law.name == laws::LINE {
        // Whatever came before: a jump of the velocity is told of the whole program.
        return Ok((Some(Curve::line()), travel));
    }
    let ends = begin.end(travel, width).zip(step.end.end(travel, width));
    let (from, to) = ends.ok_or(StepError::Accelerated { law: law.name })?;
    Ok((Some(law.solve(&Task { from, to, inflection, parameters })?), travel))
}

impl Motion for Program {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, angle: f64) -> Jet {
        let position = self.position(piece, angle);
        Jet { s: position.s - self.lowest, ..position }
    }

    fn quantity(&self) -> Quantity {
        self.quantity
    }

    fn origin(&self) -> Option<f64> {
        Some(self.lowest)
    }

    fn lobes(&self) -> u32 {
        self.lobes
    }

    fn program(&self) -> Option<&Program> {
        Some(self)
    }

    /// Of a segment of several pieces each takes its share of the cells, but some for every part of its curve.
    fn cells(&self, piece: usize) -> u32 {
        let own = self.pieces.get(piece).filter(|piece| !piece.dwell);
        let source = self.sources.get(piece % self.sources.len().max(1));
        let segment = source.and_then(|source| self.segments.get(source.segment));
        let Some((own, segment)) = own.zip(segment) else { return 1 };
        let parts = source.map_or(1, |source| u32::try_from(source.parts.len()).unwrap_or(u32::MAX));
        let least = LEAST_CELLS.saturating_mul(parts).min(CELLS_OF_MOVEMENT);
        let share = f64::from(CELLS_OF_MOVEMENT) * ((own.end - own.start) / segment.width);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between its bounds")]
        let cells = share.ceil().clamp(f64::from(least), f64::from(CELLS_OF_MOVEMENT)) as u32;
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Up by a law in a radian and down by another in two.
    fn program(up: &str, down: &str) -> Program {
        let segments =
            [(laws::named(up), 1.0, 0.02), (None, 0.5, 0.0), (laws::named(down), 2.0, 0.0), (None, 0.0, 0.0)];
        Program::new(Quantity::Length, 0.0, &segments)
    }

    /// Where only the fourth derivative jumps a piece goes on; where a lower one does it ends, and each piece has its own side.
    #[test]
    fn a_piece_ends_where_a_derivative_up_to_the_jerk_jumps() {
        let ends = |motion: &Program| motion.pieces().iter().map(|piece| piece.end).collect::<Vec<_>>();
        assert_eq!(ends(&program("modified-sine", "3-4-5")), [1.0, 1.5, 3.5, TAU]);
        let parts = program("constant-jerk", "parabola");
        assert_eq!(ends(&parts), [0.25, 0.75, 1.0, 1.5, 2.5, 3.5, TAU]);
        let jerk = |piece: usize, angle: f64| parts.jet(piece, angle).ddds / 0.02;
        for (piece, wanted) in [(0, 32.0), (1, -32.0), (2, 32.0)] {
            let Piece { start, end, .. } = parts.pieces()[piece];
            for angle in [start, 0.5 * (start + end), end] {
                assert!((jerk(piece, angle) - wanted).abs() < 1e-12, "{piece} at {angle}: {}", jerk(piece, angle));
            }
        }
        for (piece, wanted) in [(4, -4.0), (5, 4.0)] {
            let Piece { start, end, .. } = parts.pieces()[piece];
            for angle in [start, end] {
                assert!((parts.jet(piece, angle).dds / 0.02 * 4.0 - wanted).abs() < 1e-12, "{piece} at {angle}");
            }
        }
    }

    /// A law without a curve from rest to rest still moves from one position to the other.
    #[test]
    fn laws_that_jump_at_a_rest_reach_their_position() {
        for name in ["constant-velocity", "double-harmonic"] {
            let motion = program(name, "cycloidal");
            assert_eq!((motion.jet(0, 0.0).s, motion.jet(0, 1.0).s), (0.0, 0.02), "{name}");
        }
    }
}
