//! A motion program: segments that follow each other over one turn of the cam, or a lobe of it, each with its law.
//!
//! A segment begins in the state in which the one before ended, the first in that of the last. The kinds of its two ends (VDI 2143: at rest,
//! moving, turning back) follow from these states; its law is solved for them.

mod context;
mod forms;
mod half_turn;
mod joined;
pub mod keys;
mod optimum;
mod polydyne;
pub mod read;
pub mod rows;
mod solved;
mod spectrum;
mod summary;
mod with_law;

pub use super::jump::Jump;
pub use context::{FollowerMovement, ProgramSpan};
pub use polydyne::Polydyne;
pub use spectrum::{Harmonics, ProgramMovement};
pub use summary::{EndClass, SegmentSummary};

use super::laws::optimum::Optimum;
use super::laws::{Inflection, Law, LawCurve, LawError, LawTask, Parameters, SegmentEnd};
use super::{CELLS as CELLS_OF_MOVEMENT, Jet, Motion, NamedStretch, Piece, Quantity};
use crate::numeric::extremum;
use crate::refusal::Refusal;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::OnceLock;

/// Most cells in which the lowest point of a part is searched: it may bulge below its ends when it begins or ends in motion.
const CELLS: u32 = 16;
/// Least cells of a part of a curve in a short piece of a segment.
const LEAST_CELLS: u32 = 8;

/// The lift, the velocity, the acceleration and the jerk are continuous on a piece.
const SMOOTH: u32 = 3;

/// Positions are equal if they differ by less than this share of the largest: rounding of sums.
const SAME_PLACE: f64 = 1e-9;

/// A rate below this share of its peak is 0 with rounding.
const ROUNDING: f64 = 1e-9;

/// Rates by the cam angle at the end of a segment: m or rad per rad, per rad² and per rad³.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EndState {
    /// Velocity of the position.
    pub velocity: f64,
    /// Free at a turn.
    pub acceleration: f64,
    /// Where it is given.
    pub jerk: Option<f64>,
    /// The motion turns back: velocity 0, any acceleration.
    pub turns: bool,
    /// The acceleration at a turn, once a segment beside it determines it.
    pub turning: Option<f64>,
    /// Velocity and acceleration are to be found: those of least jerk over the polynomials and splines that meet there.
    pub free: [bool; 2],
}

impl EndState {
    /// Velocity and acceleration 0.
    #[must_use]
    pub fn rests(&self) -> bool {
        self.velocity == 0.0 && self.acceleration == 0.0 && !self.turns
    }

    /// Whether velocity or acceleration is to be found.
    fn is_found(&self) -> bool {
        self.free.contains(&true)
    }

    /// The state as an end of a law, for a segment of a travel and a width (rad); `None` where it is accelerated.
    fn end(&self, travel: f64, width: f64) -> Option<SegmentEnd> {
        if self.turns {
            return Some(SegmentEnd::Turn);
        }
        let end = if self.velocity == 0.0 {
            SegmentEnd::Rest
        } else {
            SegmentEnd::Moving { velocity: self.velocity * width / travel }
        };
        (self.acceleration == 0.0).then_some(end)
    }

    /// The state as conditions of a polynomial over a width (rad): the derivatives that are not free.
    fn conditions(&self, position: f64, width: f64) -> Vec<f64> {
        let mut all = vec![position, self.velocity * width];
        if self.turns {
            all.extend(self.turning.map(|acceleration| acceleration * width * width));
        } else {
            all.push(self.acceleration * width * width);
            all.extend(self.jerk.map(|jerk| jerk * width * width * width));
        }
        all
    }

    /// The state without its acceleration, as a segment begins whose acceleration there is free.
    fn without_acceleration(self) -> Self {
        Self { turns: true, turning: None, ..self }
    }
}

/// How a segment moves.
#[derive(Debug, Clone)]
pub enum Mover {
    /// Not at all: a dwell.
    Dwell,
    /// A law, with the place of its inflection, where one is given, and its parameters.
    Law(&'static Law, Option<Inflection>, Parameters),
    /// The inflection is where the acceleration at the turn is that of the neighbour.
    Matching(&'static Law, Parameters),
    /// The polynomial of the states at both ends.
    Polynomial,
    /// A spline of least jerk through inner points, or near them.
    Spline(rows::SplineRows),
    /// A curve of its own from 0 to 1, and the name of its law; where it goes through rows, their figures in shares.
    Own(&'static str, LawCurve, Option<Box<rows::RowFigures>>),
    /// An optimal polynomial from rest to rest.
    Optimum(Optimum, LawCurve),
}

impl Mover {
    /// The name of its law.
    fn name(&self) -> &'static str {
        match self {
            Mover::Dwell => keys::DWELL,
            Mover::Law(law, ..) | Mover::Matching(law, _) => law.name,
            Mover::Polynomial | Mover::Optimum(..) => keys::POLYNOMIAL,
            Mover::Spline(_) => keys::SPLINE,
            Mover::Own(name, ..) => name,
        }
    }

    /// The optimum of its curve, where it has one.
    fn optimum(&self) -> Option<Optimum> {
        if let Mover::Optimum(optimum, _) = self { Some(*optimum) } else { None }
    }
}

/// A segment as it is specified.
#[derive(Debug, Clone)]
pub struct SegmentSpec {
    /// How it moves.
    pub mover: Mover,
    /// Cam angle it takes, rad; the last takes the rest.
    pub over: f64,
    /// Position at its end, m or rad.
    pub to: f64,
    /// State at its end.
    pub end: EndState,
    /// A polynomial or spline does not begin with the acceleration with which the segment before it ends.
    pub free_start: bool,
}

/// A segment between two positions.
#[derive(Debug, Clone)]
struct ProgramSegment {
    /// `None` for a dwell.
    curve: Option<LawCurve>,
    /// The name of its law.
    name: &'static str,
    /// First angle and width, rad.
    start: f64,
    width: f64,
    from: f64,
    /// The factor of its curve.
    travel: f64,
    /// Where it ends.
    to: f64,
    ends: [EndState; 2],
    /// It is the whole motion, given without segments.
    whole: bool,
    /// The optimum of its curve, where it has one.
    optimum: Option<Optimum>,
}

/// Over what a program goes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Span {
    /// A turn from a cam angle on, rad, in a number of equal lobes.
    Turn { at: f64, lobes: u32 },
    /// The travel of a plate, m, from 0 on.
    Stroke(f64),
}

/// The source of a piece of the motion: parts of the curve of a segment.
#[derive(Debug, Clone)]
struct PieceSource {
    segment: usize,
    parts: Range<usize>,
}

/// Refuses an impossible segment given by code: from one position to another over a width (angle or length).
fn possible_segment(number: usize, from: f64, to: f64, width: f64, rests: bool) -> Result<(), Refusal> {
    let refused =
        |what: String, remedy: &'static str| Err(Refusal::new(format!("segment {number}: {what}")).remedy(remedy));
    if ![from, to, width].iter().all(|value| value.is_finite()) {
        return refused("a number is not finite".into(), "give finite numbers");
    }
    if width <= 0.0 {
        let what = "no angle or length remains: earlier segments take the whole turn or stroke".into();
        return refused(what, "give each segment an angle or length above 0");
    }
    if rests && (to - from).abs() > SAME_PLACE * from.abs().max(to.abs()) {
        let what = format!("a dwell keeps its position, but ends at {to} instead of {from}");
        return refused(what, "end it at the position where it begins, or give it a law");
    }
    Ok(())
}

/// The curve of a law from rest to rest; for a law without one, the curve from rest to a turn or, failing that, the straight line: the
/// motion then jumps as such a law does.
fn curve(law: &Law) -> LawCurve {
    let tasks = [LawTask::default(), LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn)];
    tasks.iter().find_map(|task| law.solve(task).ok()).unwrap_or_else(LawCurve::line)
}

/// A motion of segments over one turn, or one lobe of it, or over the travel of a plate, whose places are lengths in metres where those of a turn
/// are angles in radians.
#[derive(Debug, Clone)]
pub struct Program {
    quantity: Quantity,
    rpm: Option<f64>,
    lobes: u32,
    /// The travel of a plate over which it goes once, m, in the place of a turn.
    stroke: Option<f64>,
    pieces: Vec<Piece>,
    /// The sources of the pieces of the first lobe.
    sources: Vec<PieceSource>,
    segments: Vec<ProgramSegment>,
    lowest: f64,
    /// The load for which it is the motion of the cam.
    load: Option<Polydyne>,
    /// Figures of its curves through rows.
    rows: Vec<rows::RowFigures>,
    /// The summaries of the segments, once they are needed.
    summaries: OnceLock<Vec<SegmentSummary>>,
    /// Whether it depends on the speed.
    timed: bool,
}

impl Program {
    /// Segments of law (`None` rests), cam angle (rad) and end position (m, or rad of a swing), from a position on.
    ///
    /// The last segment takes the rest of the turn, whatever its given angle. Each law runs from rest to rest; one that cannot
    /// ([`Law::serves_rests`]) has a step at its beginning or end.
    ///
    /// ```
    /// # use camgen_kernel as camgen;
    /// use camgen::{Motion, Program, Quantity, law};
    /// use std::f64::consts::PI;
    ///
    /// let up = Some(law("modified-sine")?);
    /// let program = Program::new(Quantity::Length, 0.0, &[(up, PI, 0.030), (up, PI, 0.0)])?;
    /// // Half of the travel at half of the angle.
    /// let (piece, angle) = program.locate(PI / 2.0);
    /// assert!((program.jet(piece, angle).s - 0.015).abs() < 1e-12);
    /// // A rest stays where it begins.
    /// assert!(Program::new(Quantity::Length, 0.0, &[(up, PI, 0.030), (None, 1.0, 0.020), (up, 1.0, 0.0)]).is_err());
    /// # Ok::<(), camgen::Refusal>(())
    /// ```
    ///
    /// # Errors
    /// [`Refusal`] if a number is not finite, a segment has no angle, a rest ends at another position, or the turn does not end at its start position.
    pub fn new(quantity: Quantity, start: f64, segments: &[(Option<&'static Law>, f64, f64)]) -> Result<Self, Refusal> {
        let mut program = Self::empty(quantity, 1);
        program.add_laws(start, TAU, segments)?;
        let end = program.segments.last().map_or(start, |last| last.to);
        if (end - start).abs() > SAME_PLACE * program.largest(start) {
            let what = format!("the motion does not end where it starts: at {end} instead of {start}");
            return Err(Refusal::new(what).remedy("end the last segment where the first one starts"));
        }
        Ok(program.with_lowest())
    }

    /// Segments of law (`None` rests), length (m) and end position (m) along a plate that travels from x = 0 on, from a position on; the stroke is
    /// the sum of the lengths. Each law leads from rest to rest, as in [`Program::new`].
    ///
    /// ```
    /// # use camgen_kernel as camgen;
    /// use camgen::{Motion, Program, law};
    ///
    /// // 25 mm over 80 mm of the plate, then a rest of 20 mm.
    /// let program = Program::over_travel(0.0, &[(Some(law("cycloidal")?), 0.080, 0.025), (None, 0.020, 0.025)])?;
    /// assert_eq!((program.range(), program.period()), ((0.0, 0.1), None));
    /// let (piece, x) = program.locate(0.040);
    /// assert!((program.jet(piece, x).s - 0.0125).abs() < 1e-15);
    /// // Twice the mean slope in the middle.
    /// assert!((program.jet(piece, x).ds - 0.625).abs() < 1e-15);
    /// # Ok::<(), camgen::Refusal>(())
    /// ```
    ///
    /// # Errors
    /// [`Refusal`] as in [`Program::new`], except that the plate may end at any position.
    pub fn over_travel(start: f64, segments: &[(Option<&'static Law>, f64, f64)]) -> Result<Self, Refusal> {
        let stroke = segments.iter().map(|(_, over, _)| over).sum();
        let mut program = Self { stroke: Some(stroke), ..Self::empty(Quantity::Length, 1) };
        program.add_laws(start, stroke, segments)?;
        Ok(program.with_lowest())
    }

    /// Adds segments of law, width and end position, from a position on, up to an end of the last one.
    fn add_laws(
        &mut self,
        start: f64,
        last: f64,
        segments: &[(Option<&'static Law>, f64, f64)],
    ) -> Result<(), Refusal> {
        if segments.is_empty() {
            return Err(Refusal::new("a motion needs segments").remedy("give at least two of them"));
        }
        let (mut place, mut position) = (0.0, start);
        for (index, (law, over, to)) in segments.iter().enumerate() {
            let end = if index + 1 == segments.len() { last } else { place + over };
            possible_segment(index + 1, position, *to, end - place, law.is_none())?;
            let to = if law.is_some() { *to } else { position };
            let (width, travel, ends) = (end - place, to - position, [EndState::default(); 2]);
            let (curve, name) = (law.map(curve), law.map_or(keys::DWELL, |law| law.name));
            let (whole, optimum) = (false, None);
            let segment =
                ProgramSegment { curve, name, start: place, width, from: position, travel, to, ends, whole, optimum };
            self.add(segment, end);
            (place, position) = (end, to);
        }
        Ok(())
    }

    /// The largest |position| of its segments, including the start.
    fn largest(&self, start: f64) -> f64 {
        self.segments.iter().map(|segment| segment.to.abs()).fold(start.abs(), f64::max)
    }

    /// Segments from a position (m) and x = 0 on over the stroke of a plate (m), which the follower enters at rest.
    ///
    /// # Errors
    /// The first segment that cannot be made, and why.
    fn of_stroke(start: f64, stroke: f64, steps: &[SegmentSpec]) -> Result<Self, (usize, LawError)> {
        // A rest before the first segment and behind the last one, where the segments of a turn follow each other.
        let rest =
            SegmentSpec { mover: Mover::Dwell, over: stroke, to: start, end: EndState::default(), free_start: false };
        let all: Vec<SegmentSpec> = std::iter::once(rest).chain(steps.iter().cloned()).collect();
        let found = solved::solve(start, &all).map_err(|(index, error)| (index.saturating_sub(1), error))?;
        let mut program = Self { stroke: Some(stroke), ..Self::empty(Quantity::Length, 1) };
        program.add_solved(0.0, start, stroke, found, 1);
        Ok(program.with_lowest())
    }

    /// Segments from a position and a cam angle (rad) on, in a number of equal lobes.
    ///
    /// # Errors
    /// The first segment that cannot be made, and why.
    pub fn of_steps(
        quantity: Quantity,
        at: f64,
        start: f64,
        lobes: u32,
        steps: &[SegmentSpec],
    ) -> Result<Self, (usize, LawError)> {
        let mut program = Self::empty(quantity, lobes.max(1));
        let whole = TAU / f64::from(lobes.max(1));
        let found = solved::solve(start, steps)?;
        program.add_solved(at, start, at + whole, found, 0);
        program.repeat(whole);
        Ok(program.with_lowest())
    }

    /// Adds solved segments but the first few, from a place and a position on, up to an end of the last one.
    fn add_solved(&mut self, at: f64, start: f64, last: f64, found: solved::SolvedSegments, skipped: usize) {
        let solved::SolvedSegments { steps, curves, rows } = found;
        let (mut angle, mut position) = (at, start);
        let first = skipped.checked_sub(1).or(steps.len().checked_sub(1)).and_then(|before| steps.get(before));
        let mut before = first.map_or_else(EndState::default, |step| step.end);
        let (count, solved) = (steps.len(), steps.iter().zip(curves).zip(rows).skip(skipped).enumerate());
        for (index, ((step, (curve, travel)), of_spline)) in solved {
            let end = if index + skipped + 1 == count { last } else { angle + step.over };
            let ends = [before, step.end];
            let (name, width, to) = (step.mover.name(), end - angle, step.to);
            let (whole, optimum) = (false, step.mover.optimum());
            let figures = match &step.mover {
                Mover::Own(_, _, Some(figures)) => Some(rows::RowFigures::clone(figures)),
                _ => of_spline,
            };
            self.rows.extend(figures.map(|figures| figures.of_segment(index, angle, width, travel.abs())));
            let segment =
                ProgramSegment { curve, name, start: angle, width, from: position, travel, to, ends, whole, optimum };
            self.add(segment, end);
            (angle, position, before) = (end, step.to, step.end);
        }
    }

    /// One curve over a turn, each of its equal lobes, or a stroke: positions above a first one, m or rad, by the share of these.
    fn of_curve(quantity: Quantity, span: Span, from: f64, name: &'static str, curve: LawCurve) -> Self {
        let (at, lobes, stroke) = match span {
            Span::Turn { at, lobes } => (at, lobes.max(1), None),
            Span::Stroke(stroke) => (0.0, 1, Some(stroke)),
        };
        let mut program = Self { stroke, ..Self::empty(quantity, lobes) };
        let width = stroke.unwrap_or(TAU / f64::from(lobes));
        let (peaks, last) = (curve.peaks(), curve.values_at(curve.parts().saturating_sub(1), 1.0));
        let [first, end] = [curve.values_at(0, 0.0), last].map(|[_, velocity, acceleration, _]| {
            let [velocity, acceleration] = [(velocity, peaks.velocity.value), (acceleration, peaks.acceleration.value)]
                .map(|(value, peak)| if value.abs() > ROUNDING * peak { value } else { 0.0 });
            EndState { velocity: velocity / width, acceleration: acceleration / (width * width), ..EndState::default() }
        });
        let ends = [first, if stroke.is_some() { end } else { first }];
        let to = stroke.map_or(from, |_| from + last[0]);
        let (curve, travel, whole, optimum) = (Some(curve), 1.0, true, None);
        let segment = ProgramSegment { curve, name, start: at, width, from, travel, to, ends, whole, optimum };
        program.add(segment, at + width);
        program.repeat(width);
        program.with_lowest()
    }

    fn empty(quantity: Quantity, lobes: u32) -> Self {
        let (pieces, sources, segments) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            quantity,
            rpm: None,
            lobes,
            stroke: None,
            pieces,
            sources,
            segments,
            lowest: 0.0,
            load: None,
            rows: Vec::new(),
            summaries: OnceLock::new(),
            timed: false,
        }
    }

    /// The program with its lowest position.
    fn with_lowest(mut self) -> Self {
        let least = self.pieces.iter().zip(&self.sources).enumerate().map(|(index, (piece, source))| {
            let curve = self.segments.get(source.segment).and_then(|segment| segment.curve.as_ref());
            let cells = curve.map_or(1, |curve| source.parts.clone().map(|part| curve.cells(part).min(CELLS)).sum());
            -extremum::largest_of_both_signs(
                |at| {
                    let position = self.position(index, at);
                    [position.s, position.ds, position.dds]
                },
                (piece.start, piece.end),
                cells,
            )[1]
            .value
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

    /// Whether it depends on the speed: by rates per second, or as a polydyne cam.
    #[must_use]
    pub fn is_timed(&self) -> bool {
        self.timed
    }

    /// The elastic load for which it is the motion of the cam.
    #[must_use]
    pub fn load(&self) -> Option<Polydyne> {
        self.load
    }

    /// The travel of a plate over which it goes, m; `None` of a program over a turn.
    #[must_use]
    pub fn stroke(&self) -> Option<f64> {
        self.stroke
    }

    /// Number of its segments.
    #[must_use]
    pub fn segment_count(&self) -> usize {
        self.segments.len()
    }

    /// Figures of its curves through rows: of the whole motion, or of each segment that is such a curve.
    #[must_use]
    pub fn rows(&self) -> &[rows::RowFigures] {
        &self.rows
    }

    /// A segment to its last angle, in pieces that end where a derivative up to the jerk jumps.
    fn add(&mut self, segment: ProgramSegment, end: f64) {
        let (index, dwell) = (self.segments.len(), segment.curve.is_none());
        let groups =
            segment.curve.as_ref().map_or_else(|| std::iter::once(0..1).collect(), |curve| curve.smooth_to(SMOOTH));
        let mut start = segment.start;
        for parts in groups {
            let joint = segment.curve.as_ref().map(|curve| curve.range_of(parts.end.saturating_sub(1)).1);
            let until = joint.filter(|joint| *joint < 1.0).map_or(end, |joint| segment.start + segment.width * joint);
            // A stretch too short for two angles is left out.
            if start < until || parts.start == 0 {
                self.pieces.push(Piece { start, end: until, dwell });
                self.sources.push(PieceSource { segment: index, parts });
                start = until;
            }
        }
        self.segments.push(segment);
        self.summaries = OnceLock::new();
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
        let part = curve.part_within(x, &source.parts);
        let [s, ds, dds, ddds] = curve.values_at(part, x);
        let shape = Jet { s, ds, dds, ddds }.by_angle_times(segment.width).scaled(segment.travel);
        Jet { s: segment.from + shape.s, ..shape }
    }
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

    fn period(&self) -> Option<f64> {
        self.stroke.map_or(Some(TAU), |_| None)
    }

    fn is_by_travel(&self) -> bool {
        self.stroke.is_some()
    }

    /// Its segments, by their laws.
    fn named_stretches(&self) -> Vec<NamedStretch> {
        let own = self.sources.len().max(1);
        let mut stretches: Vec<NamedStretch> = Vec::new();
        let mut last = None;
        for (index, piece) in self.pieces.iter().enumerate() {
            let Some(source) = self.sources.get(index % own) else { continue };
            let segment = (index / own, source.segment);
            if let Some(stretch) = stretches.last_mut().filter(|_| last == Some(segment)) {
                stretch.to = piece.end;
            } else {
                let name = self.segments.get(source.segment).map_or(keys::DWELL, |segment| segment.name);
                stretches.push(NamedStretch { from: piece.start, to: piece.end, name: name.into() });
            }
            last = Some(segment);
        }
        stretches
    }

    fn program(&self) -> Option<&Program> {
        Some(self)
    }

    /// Each piece of a segment takes its share of the cells, but at least a few for every part of its curve.
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
    use crate::motion::laws;

    /// Up by a law in a radian and down by another in two.
    fn program(up: &str, down: &str) -> Program {
        let segments =
            [(laws::named(up), 1.0, 0.02), (None, 0.5, 0.02), (laws::named(down), 2.0, 0.0), (None, 0.0, 0.0)];
        Program::new(Quantity::Length, 0.0, &segments).expect("a program")
    }

    /// A piece continues where only the fourth derivative jumps; it ends where a lower one does, and each piece has its own side.
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
