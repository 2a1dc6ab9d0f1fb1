//! A motion program: segments that follow each other over one turn of the cam, each with its law.

use super::laws::{self, Curve, End, LAWS, Law, Task};
use super::{Jet, Motion, Piece, Quantity};
use crate::document::Presence::{Optional, Required};
use crate::document::cams::MAKE;
use crate::document::range::{LARGEST_NUMBER, LEAST_RPM, LONGEST};
use crate::document::similar;
use crate::document::{Bounds, Field, LengthOrAngle, Occurs, Reader, Section, Table, above, within};
use crate::numeric::extremum;
use crate::units::Dimension::Angle;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// The law that holds a position.
const DWELL: &str = "dwell";
/// The law of a segment without the key `law`.
const USUAL: &str = "cycloidal";

/// Positions of a lever are counted from any zero: two turns each way hold every one.
const LARGEST_SWING: f64 = 2.0 * TAU;
/// Positions, m or rad.
const POSITION: (Bounds, Bounds) = (within(-LONGEST, LONGEST), within(-LARGEST_SWING, LARGEST_SWING));

const RPM: Field<f64> = Field::number(
    "rpm",
    "speed of the cam, 0.001 to 100000; forces and contact stress need it",
    Optional("120"),
    within(LEAST_RPM, LARGEST_NUMBER),
);
const START: Field<LengthOrAngle> = Field::length_or_angle(
    "start",
    "position at cam angle 0; a length for a translating follower, an angle for a swinging one",
    Required("0 mm"),
    POSITION.0,
    POSITION.1,
);

/// `[motion]`.
pub(crate) const SECTION: Section = Section {
    path: "motion",
    about: "a motion program, instead of a press: for `camgen make`",
    occurs: Occurs::Optional,
    cams: &[MAKE],
    keys: &[RPM.key, START.key],
};

const LAW: Field<String> = Field::text(
    "law",
    "\"dwell\" or a law between two rests, cycloidal when absent; a name that is none is answered with the list",
    Optional(USUAL),
);
const OVER: Field<f64> = Field::quantity(
    "over",
    "cam angle it takes; the last segment may leave it out",
    Optional("90 deg"),
    Angle,
    above(0.0, TAU),
);
const TO: Field<LengthOrAngle> =
    Field::length_or_angle("to", "position at its end; not of a dwell", Optional("20 mm"), POSITION.0, POSITION.1);

/// `[[motion.segment]]`.
pub(crate) const SEGMENT: Section = Section {
    path: "motion.segment",
    about: "a segment of the program",
    occurs: Occurs::Repeated,
    cams: &[MAKE],
    keys: &[LAW.key, OVER.key, TO.key],
};

/// By how much the sum of the segments may differ from a whole turn, rad: rounding of typed angles.
const WHOLE_TURN: f64 = 1e-9 * PI / 180.0;
/// Cells in which the lowest point of a segment is searched: a law between rests has its extremes at its ends.
const CELLS: u32 = 4;

/// The lift, the velocity, the acceleration and the jerk are continuous on a piece.
const SMOOTH: u32 = 3;

/// A segment between two positions.
#[derive(Debug, Clone)]
struct Segment {
    /// `None` rests.
    curve: Option<Curve>,
    /// First angle and width, rad.
    start: f64,
    width: f64,
    from: f64,
    travel: f64,
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

/// A motion of segments over one turn.
#[derive(Debug, Clone)]
pub struct Program {
    quantity: Quantity,
    rpm: Option<f64>,
    pieces: Vec<Piece>,
    sources: Vec<Source>,
    segments: Vec<Segment>,
    lowest: f64,
}

impl Program {
    /// Segments of law (`None` rests), cam angle (rad) and end position (m, or rad of a swing), from a position on.
    ///
    /// Each law leads from rest to rest; one that cannot ([`Law::serves_rests`]) leaves a jump where it begins or ends.
    #[must_use]
    pub fn new(quantity: Quantity, start: f64, segments: &[(Option<&'static Law>, f64, f64)]) -> Self {
        let (pieces, sources) = (Vec::new(), Vec::new());
        let mut program = Self { quantity, rpm: None, pieces, sources, segments: Vec::new(), lowest: 0.0 };
        let (mut angle, mut position) = (0.0, start);
        for (index, (law, over, to)) in segments.iter().enumerate() {
            let end = if index + 1 == segments.len() { TAU } else { angle + over };
            let to = if law.is_some() { *to } else { position };
            let (curve, width, travel) = (law.map(curve), end - angle, to - position);
            program.add(Segment { curve, start: angle, width, from: position, travel }, end);
            (angle, position) = (end, to);
        }
        let least = program.pieces.iter().enumerate().map(|(index, piece)| {
            let of = |at: f64| program.position(index, at);
            -extremum::largest(|at| -of(at).s, |at| -of(at).ds, (piece.start, piece.end), CELLS).value
        });
        program.lowest = least.fold(f64::INFINITY, f64::min);
        program
    }

    /// Speed of the cam, rpm, when it is given.
    #[must_use]
    pub fn rpm(&self) -> Option<f64> {
        self.rpm
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
    }

    /// The position in the program, with its derivatives.
    fn position(&self, piece: usize, angle: f64) -> Jet {
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
}

fn value_of(position: LengthOrAngle) -> (Quantity, f64) {
    match position {
        LengthOrAngle::Length(value) => (Quantity::Length, value),
        LengthOrAngle::Angle(value) => (Quantity::Angle, value),
    }
}

/// The program of a file, when there is one without fault.
pub(crate) fn read(reader: &Reader<'_>) -> Option<Program> {
    let table = reader.find(&SECTION)?;
    let start = table.get(&START);
    let segments: Vec<Table<'_>> = reader.elements(&SEGMENT).collect();
    if segments.is_empty() {
        if !reader.is_explained(&SEGMENT) {
            let help = Some("add [[motion.segment]] with law, over and to".into());
            table.fail(&START, "a motion needs segments".into(), help);
        }
        return None;
    }
    let angles = widths(&segments);
    let (quantity, start) = value_of(start?);
    let ends: Vec<Option<(Option<&'static Law>, f64)>> =
        segments.iter().map(|segment| read_segment(segment, quantity)).collect();
    let ends = ends.into_iter().collect::<Option<Vec<_>>>()?;
    let all: Vec<(Option<&'static Law>, f64, f64)> =
        ends.iter().zip(angles?).map(|((law, to), over)| (*law, over, *to)).collect();
    let moving = all.iter().rev().find(|(law, ..)| law.is_some());
    if let (Some((_, _, last)), Some(segment)) = (moving, segments.last())
        && *last != start
    {
        let message = "the motion does not end where it starts".to_owned();
        segment.fail(&TO, message, Some(format!("the last `to` must be motion.start, {}", table.typed(&START))));
        return None;
    }
    Some(Program { rpm: table.get(&RPM), ..Program::new(quantity, start, &all) })
}

/// The cam angles of the segments; the last may omit its own and then takes the rest of the turn.
fn widths(segments: &[Table<'_>]) -> Option<Vec<f64>> {
    let mut angles = Vec::new();
    let mut sum = 0.0;
    for (index, segment) in segments.iter().enumerate() {
        let over = match segment.get(&OVER) {
            Some(over) => over,
            None if segment.has(&OVER) => return None,
            None if index + 1 == segments.len() && sum < TAU => TAU - sum,
            None if index + 1 == segments.len() => {
                let message = format!("the segments before the last already cover {:.6} deg", sum.to_degrees());
                segment.fail(&OVER, message, Some("make them shorter, or remove the last".into()));
                return None;
            }
            None => {
                let help = "only the last segment may omit it; it then takes the rest of the turn";
                segment.fail(&OVER, "a segment has no `over`".into(), Some(help.into()));
                return None;
            }
        };
        angles.push(over);
        sum += over;
    }
    if (sum - TAU).abs() > WHOLE_TURN {
        let (covered, off) = (sum.to_degrees(), (TAU - sum).to_degrees());
        let what = if off > 0.0 { format!("{off:.6} deg are missing") } else { format!("{:.6} deg too much", -off) };
        let message = format!("the segments cover {covered:.6} deg, {what}");
        segments.last()?.fail(&OVER, message, Some("omit `over` of the last segment to fill the turn".into()));
        return None;
    }
    Some(angles)
}

/// Law and end of a segment.
fn read_segment(segment: &Table<'_>, quantity: Quantity) -> Option<(Option<&'static Law>, f64)> {
    let name = segment.get(&LAW).unwrap_or_else(|| USUAL.to_owned());
    if name.eq_ignore_ascii_case(DWELL) {
        if segment.has(&TO) {
            let help = "omit `to`, or give a law that moves";
            segment.fail(&TO, "a dwell keeps its position and has no `to`".into(), Some(help.into()));
        }
        return Some((None, 0.0));
    }
    let Some(law) = laws::named(&name) else {
        let known: Vec<&str> = std::iter::once(DWELL).chain(LAWS.iter().map(|law| law.name)).collect();
        let near = similar(&name, known.iter().copied());
        let near = near.map_or(String::new(), |law| format!("did you mean \"{law}\"? It is "));
        segment.fail(&LAW, format!("no law \"{name}\""), Some(format!("{near}one of {}", known.join(", "))));
        return None;
    };
    if !law.serves_rests() {
        let able: Vec<&str> = LAWS.iter().filter(|law| law.serves_rests()).map(|law| law.name).collect();
        let message = format!("{} cannot start and end at rest", law.name);
        segment.fail(&LAW, message, Some(format!("laws that can: {}", able.join(", "))));
        return None;
    }
    let Some(to) = segment.get(&TO) else {
        if !segment.has(&TO) {
            segment.fail(&TO, format!("a segment with the law {name} needs `to`"), Some("e.g. to = \"20 mm\"".into()));
        }
        return None;
    };
    let (found, to) = value_of(to);
    if found != quantity {
        let message = format!("`to` is {}, but motion.start is {}", found.words(), quantity.words());
        segment.fail(&TO, message, Some("give both in the same kind of unit".into()));
        return None;
    }
    Some((Some(law), to))
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
