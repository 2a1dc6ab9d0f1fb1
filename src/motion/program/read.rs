//! The tables `[motion]` and `[[motion.segment]]`.

use super::{Mover, Program, State, Step, StepError};
use crate::document::Presence::{Default, Optional, Required};
use crate::document::cams::MAKE;
use crate::document::range::{LARGEST_NUMBER, LEAST_RPM, LONGEST};
use crate::document::similar;
use crate::document::{Bounds, Field, LengthOrAngle, Occurs, Reader, Section, Table, above, within};
use crate::motion::Quantity;
use crate::motion::laws::{self, Inflection, LAWS, Law, LawError, Parameters};
use crate::units::{self, Dimension::Angle};
use std::f64::consts::{PI, TAU};

/// The law that holds a position.
pub(super) const DWELL: &str = "dwell";
/// The law that is the polynomial of its ends.
pub(super) const POLYNOMIAL: &str = "polynomial";
/// The law of a segment without the key `law`.
const USUAL: &str = "cycloidal";

/// Positions of a lever are counted from any zero: two turns each way hold every one.
const LARGEST_SWING: f64 = 2.0 * TAU;
/// Positions, m or rad.
const POSITION: (Bounds, Bounds) = (within(-LONGEST, LONGEST), within(-LARGEST_SWING, LARGEST_SWING));
/// Most lobes: more would be teeth.
const MOST_LOBES: f64 = 100.0;

const RPM: Field<f64> = Field::number(
    "rpm",
    "speed of the cam, 0.001 to 100000; forces and contact stress need it",
    Optional("120"),
    within(LEAST_RPM, LARGEST_NUMBER),
);
const START: Field<LengthOrAngle> = Field::length_or_angle(
    "start",
    "position at the start; a length for a translating follower, an angle for a swinging one",
    Required("0 mm"),
    POSITION.0,
    POSITION.1,
);
const AT: Field<f64> =
    Field::quantity("at", "cam angle of the first segment", Default("0 deg"), Angle, within(-TAU, TAU));
const REPEAT: Field<f64> = Field::number(
    "repeat",
    "equal lobes, a whole number to 100: the segments fill 360 deg over it",
    Default("1"),
    within(1.0, MOST_LOBES),
);

/// `[motion]`.
pub(crate) const SECTION: Section = Section {
    path: "motion",
    about: "a motion program, instead of a press: for `camgen make`",
    occurs: Occurs::Optional,
    cams: &[MAKE],
    keys: &[RPM.key, START.key, AT.key, REPEAT.key],
};

const LAW: Field<String> = Field::text(
    "law",
    "\"dwell\", \"polynomial\" (by the states at both ends) or a law, cycloidal when absent; a name that is none is answered with the list",
    Optional(USUAL),
);
const OVER: Field<f64> = Field::quantity(
    "over",
    "cam angle it takes; the last segment may leave it out",
    Optional("90 deg"),
    Angle,
    above(0.0, TAU),
);
const UNTIL: Field<f64> = Field::quantity(
    "until",
    "cam angle at which it ends, instead of over",
    Optional("210 deg"),
    Angle,
    within(-TAU, 2.0 * TAU),
);
const TO: Field<LengthOrAngle> =
    Field::length_or_angle("to", "position at its end; not of a dwell", Optional("20 mm"), POSITION.0, POSITION.1);
const BY: Field<LengthOrAngle> = Field::length_or_angle(
    "by",
    "by how much the position grows, instead of to",
    Optional("20 mm"),
    POSITION.0,
    POSITION.1,
);
const VELOCITY: Field<String> = Field::text(
    "velocity",
    "at its end, by angle or time (needs rpm); of constant-velocity its own, in place of over or to",
    Optional("-0.3 mm/deg"),
);
const ACCELERATION: Field<String> =
    Field::text("acceleration", "at its end, 0 when absent; other ones need polynomials", Optional("2 mm/rad2"));
const JERK: Field<String> = Field::text("jerk", "at its end, where polynomials are to keep it", Optional("0 mm/rad3"));
const END: Field<EndOf> = Field::words(
    "end",
    "\"rest\", \"turn\" (velocity 0, any acceleration) or \"moving\" (with a velocity); moving where one is given",
    Optional("turn"),
    &["rest", "turn", "moving"],
    &[EndOf::Rest, EndOf::Turn, EndOf::Moving],
);
const INFLECTION: Field<String> = Field::text(
    "inflection",
    "where the acceleration changes sign: a share of the segment, \"smooth\", or \"match\" (the neighbour's acceleration at a turn)",
    Default("smooth"),
);
const FRACTIONS: Field<Vec<f64>> = Field::numbers(
    "fractions",
    "of scca: shares of a half with the acceleration rising, constant, falling and 0; their sum is 1",
    Optional("[0.25, 0.25, 0.25, 0.25]"),
    within(0.0, 1.0),
);
const LINE: Field<f64> = Field::number(
    "line",
    "of parabola-line and sine-line: share of constant velocity",
    Optional("0.5"),
    within(0.0, 1.0),
);
const AMPLITUDES: Field<Vec<f64>> = Field::numbers(
    "amplitudes",
    "of triple-harmonic: of the acceleration's three waves, scaled together",
    Optional("[7, 0, -2.4]"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);
const RAMP: Field<f64> = Field::number(
    "ramp",
    "of s-curve: share of a half in which the acceleration grows",
    Optional("0.25"),
    within(0.0, 0.5),
);

/// `[[motion.segment]]`.
pub(crate) const SEGMENT: Section = Section {
    path: "motion.segment",
    about: "a segment of the program; states are those at its end",
    occurs: Occurs::Repeated,
    cams: &[MAKE],
    keys: &[
        LAW.key,
        OVER.key,
        UNTIL.key,
        TO.key,
        BY.key,
        VELOCITY.key,
        ACCELERATION.key,
        JERK.key,
        END.key,
        INFLECTION.key,
        FRACTIONS.key,
        LINE.key,
        AMPLITUDES.key,
        RAMP.key,
    ],
};

/// What the end of a segment is said to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum EndOf {
    Rest,
    Turn,
    Moving,
}

/// By how much the sum of the segments may differ from a whole turn, rad: rounding of typed angles.
const WHOLE_TURN: f64 = 1e-9 * PI / 180.0;
/// By how much the last position may miss the first, over the largest: rounding of sums.
const SAME_PLACE: f64 = 1e-12;

fn value_of(position: LengthOrAngle) -> (Quantity, f64) {
    match position {
        LengthOrAngle::Length(value) => (Quantity::Length, value),
        LengthOrAngle::Angle(value) => (Quantity::Angle, value),
    }
}

/// What holds for the whole program.
#[derive(Clone, Copy)]
struct Whole {
    quantity: Quantity,
    /// Angular speed of the cam, rad/s.
    speed: Option<f64>,
    /// First cam angle, and the angle the segments fill, rad.
    at: f64,
    fill: f64,
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
    let lobes = lobes(&table);
    let (quantity, start) = value_of(start?);
    let rpm = table.get(&RPM);
    let (at, lobes) = (table.get(&AT)?, lobes?);
    let whole = Whole { quantity, speed: rpm.map(|rpm| rpm * TAU / 60.0), at, fill: TAU / f64::from(lobes) };
    let mut steps = steps(&segments, whole, start)?;
    let largest = steps.iter().map(|step| step.to.abs()).fold(start.abs(), f64::max);
    let last = steps.last_mut()?;
    if (last.to - start).abs() > SAME_PLACE * largest {
        let message = "the motion does not end where it starts".to_owned();
        let help = Some(format!("the last `to` must be motion.start, {}", table.typed(&START)));
        segments.last()?.fail(&TO, message, help);
        return None;
    }
    last.to = start;
    match Program::of_steps(quantity, (at, start, lobes), &steps) {
        Ok(program) => Some(Program { rpm, ..program }),
        Err((index, error)) => {
            let segment = segments.get(index)?;
            let of_inflection = matches!(
                error,
                StepError::NothingToMatch
                    | StepError::Law(
                        LawError::NoInflection { .. } | LawError::Inflection { .. } | LawError::NoMatch { .. }
                    )
            );
            let of_own = match &error {
                StepError::Law(LawError::Parameter { name, .. }) => Some(*name),
                _ => None,
            };
            match of_own {
                Some("fractions") => segment.fail(&FRACTIONS, error.to_string(), None),
                Some("amplitudes") => segment.fail(&AMPLITUDES, error.to_string(), None),
                Some("line") => segment.fail(&LINE, error.to_string(), None),
                Some("ramp") => segment.fail(&RAMP, error.to_string(), None),
                _ => segment.fail(if of_inflection { &INFLECTION } else { &LAW }, error.to_string(), None),
            }
            None
        }
    }
}

fn lobes(table: &Table<'_>) -> Option<u32> {
    let typed = table.get(&REPEAT)?;
    if typed.fract() != 0.0 {
        table.fail(&REPEAT, format!("repeat must be a whole number: {typed}"), None);
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 1 to 100")]
    Some(typed as u32)
}

/// Every segment as a step, one after the other.
fn steps(segments: &[Table<'_>], whole: Whole, start: f64) -> Option<Vec<Step>> {
    let (mut all, mut position, mut sum) = (Vec::with_capacity(segments.len()), start, 0.0);
    let mut missing = false;
    for (index, segment) in segments.iter().enumerate() {
        let last = index + 1 == segments.len();
        match step(segment, whole, (position, sum, last)) {
            Some(step) => {
                (position, sum) = (step.to, sum + step.over);
                all.push(step);
            }
            // What follows from a segment that is not known is not told.
            None if segment.has(&OVER) || segment.has(&UNTIL) || last => missing = true,
            None => return None,
        }
    }
    if missing {
        return None;
    }
    if (sum - whole.fill).abs() > WHOLE_TURN {
        let (covered, off) = (sum.to_degrees(), (whole.fill - sum).to_degrees());
        let what = if off > 0.0 { format!("{off:.6} deg are missing") } else { format!("{:.6} deg too much", -off) };
        let message = format!("the segments cover {covered:.6} deg, {what}");
        segments.last()?.fail(&OVER, message, Some("omit `over` of the last segment to fill the turn".into()));
        return None;
    }
    Some(all)
}

/// A segment from a position on, behind segments that take a sum of angles, rad.
fn step(segment: &Table<'_>, whole: Whole, (position, sum, last): (f64, f64, bool)) -> Option<Step> {
    let mover = mover(segment);
    let end = state(segment, whole);
    let target = target(segment, whole.quantity, position).ok();
    let (mover, mut end, target) = (mover?, end?, target?);
    let line = matches!(mover, Mover::Law(law, ..) if law.name == laws::LINE);
    let dwell = matches!(mover, Mover::Dwell);
    if dwell && (target.is_some() || !end.rests()) {
        let key = if segment.has(&BY) { &BY } else { &TO };
        let help = "omit `to`, or give a law that moves";
        segment.fail(key, "a dwell keeps its position and has no `to`".into(), Some(help.into()));
        return None;
    }
    // Of a straight line two of angle, travel and velocity give the third.
    let by_velocity = line && end.velocity != 0.0;
    let over = match (width(segment, whole, sum, last && !by_velocity).ok()?, target) {
        (Some(over), _) => over,
        (None, Some(to)) if by_velocity && (to - position) / end.velocity > 0.0 => (to - position) / end.velocity,
        (None, Some(_)) if by_velocity => {
            segment.fail(&VELOCITY, "the velocity leads away from `to`".into(), Some("turn its sign".into()));
            return None;
        }
        (None, _) if last && sum < whole.fill => whole.fill - sum,
        (None, _) => {
            let help = "only the last segment may omit it; it then takes the rest of the turn";
            segment.fail(&OVER, "a segment has no `over`".into(), Some(help.into()));
            return None;
        }
    };
    let to = match target {
        Some(to) => to,
        None if dwell => position,
        None if by_velocity => position + end.velocity * over,
        None => {
            let name = segment.get(&LAW).unwrap_or_else(|| USUAL.to_owned());
            segment.fail(&TO, format!("a segment with the law {name} needs `to`"), Some("e.g. to = \"20 mm\"".into()));
            return None;
        }
    };
    if line {
        let velocity = (to - position) / over;
        if by_velocity && (velocity - end.velocity).abs() > SAME_PLACE.sqrt() * velocity.abs() {
            let message = "over, to and velocity of a straight line do not fit each other".to_owned();
            segment.fail(&VELOCITY, message, Some("two of them give the third: leave one out".into()));
            return None;
        }
        end = State { velocity, ..State::default() };
    }
    Some(Step { mover, over, to, end })
}

/// A fault that the user has been told.
struct Told;

/// The cam angle of a segment, where it is given.
fn width(segment: &Table<'_>, whole: Whole, sum: f64, rest: bool) -> Result<Option<f64>, Told> {
    if segment.has(&OVER) && segment.has(&UNTIL) {
        segment.fail(&UNTIL, "a segment has `over` or `until`, not both".into(), Some("leave one of them out".into()));
        return Err(Told);
    }
    if segment.has(&UNTIL) {
        let until = segment.get(&UNTIL).ok_or(Told)?;
        let over = until - (whole.at + sum);
        if !(over > 0.0 && over <= TAU + WHOLE_TURN) {
            let from = (whole.at + sum).to_degrees();
            let message = format!("`until` must be behind the start of the segment, {from:.6} deg");
            segment.fail(&UNTIL, message, None);
            return Err(Told);
        }
        return Ok(Some(over));
    }
    if segment.has(&OVER) {
        return segment.get(&OVER).map(Some).ok_or(Told);
    }
    if rest && sum >= whole.fill {
        let message = format!("the segments before the last already cover {:.6} deg", sum.to_degrees());
        segment.fail(&OVER, message, Some("make them shorter, or remove the last".into()));
        return Err(Told);
    }
    Ok(None)
}

/// The position at the end of a segment, where it is given.
fn target(segment: &Table<'_>, quantity: Quantity, position: f64) -> Result<Option<f64>, Told> {
    if segment.has(&TO) && segment.has(&BY) {
        segment.fail(&BY, "a segment has `to` or `by`, not both".into(), Some("leave one of them out".into()));
        return Err(Told);
    }
    for (key, from, name) in [(&TO, 0.0, "to"), (&BY, position, "by")] {
        if segment.has(key) {
            let (found, value) = value_of(segment.get(key).ok_or(Told)?);
            if found != quantity {
                let message = format!("`{name}` is {}, but motion.start is {}", found.words(), quantity.words());
                segment.fail(key, message, Some("give both in the same kind of unit".into()));
                return Err(Told);
            }
            return Ok(Some(from + value));
        }
    }
    Ok(None)
}

/// A rate at the end of a segment by the cam angle, where it is given.
fn rate(segment: &Table<'_>, key: &Field<String>, order: u32, whole: Whole) -> Result<Option<f64>, Told> {
    if !segment.has(key) {
        return Ok(None);
    }
    let text = segment.get(key).ok_or(Told)?;
    let swings = whole.quantity == Quantity::Angle;
    let fits = if swings { "deg/deg, rad/rad or deg/s" } else { "mm/deg, mm/rad, mm/s or m/s" };
    let powers = if order > 1 { format!(", with {order} behind the second unit") } else { String::new() };
    let fail = |message: String, help: String| {
        segment.fail(key, message, Some(help));
        Err(Told)
    };
    let name = key.key.name;
    match units::parse_rate(&text, order) {
        Err(error) => fail(format!("`{name}`: {error}"), format!("a number and one of {fits}{powers}")),
        Ok(rate) if rate.swing != swings => {
            let (found, wanted) = if swings { ("a length", "an angle") } else { ("an angle", "a length") };
            fail(format!("`{name}` is of {found}, but motion.start is {wanted}"), format!("one of {fits}{powers}"))
        }
        Ok(rate) if !rate.by_time => Ok(Some(rate.value)),
        Ok(rate) => match whole.speed {
            Some(speed) => Ok(Some((0..order).fold(rate.value, |value, _| value / speed))),
            None => {
                fail(format!("`{name}` by the time needs motion.rpm"), "add it, or give the rate by the angle".into())
            }
        },
    }
}

/// The state at the end of a segment.
fn state(segment: &Table<'_>, whole: Whole) -> Option<State> {
    let said = if segment.has(&END) { Some(segment.get(&END)?) } else { None };
    let velocity = rate(segment, &VELOCITY, 1, whole).ok()?;
    let acceleration = rate(segment, &ACCELERATION, 2, whole).ok()?;
    let jerk = rate(segment, &JERK, 3, whole).ok()?;
    let moving = velocity.unwrap_or(0.0) != 0.0 || acceleration.unwrap_or(0.0) != 0.0;
    let fault = match said {
        Some(EndOf::Turn) if moving => Some("a turn has the velocity 0 and any acceleration"),
        Some(EndOf::Rest) if moving => Some("at rest velocity and acceleration are 0"),
        Some(EndOf::Moving) if velocity.is_none() && acceleration.is_none() => Some("a moving end needs a velocity"),
        _ => None,
    };
    if let Some(message) = fault {
        segment.fail(&END, message.into(), Some("leave `end` out where a velocity or acceleration is given".into()));
        return None;
    }
    let turns = said == Some(EndOf::Turn);
    Some(State { velocity: velocity.unwrap_or(0.0), acceleration: acceleration.unwrap_or(0.0), jerk, turns })
}

/// What moves a segment.
fn mover(segment: &Table<'_>) -> Option<Mover> {
    let name = if segment.has(&LAW) { segment.get(&LAW)? } else { USUAL.to_owned() };
    if name.eq_ignore_ascii_case(DWELL) {
        return Some(Mover::Dwell);
    }
    if name.eq_ignore_ascii_case(POLYNOMIAL) {
        return Some(Mover::Polynomial);
    }
    let Some(law) = laws::named(&name) else {
        let all = LAWS.iter().map(|law| law.name);
        let known: Vec<&str> = [DWELL, POLYNOMIAL].into_iter().chain(all).collect();
        let near = similar(&name, known.iter().copied());
        let near = near.map_or(String::new(), |law| format!("did you mean \"{law}\"? It is "));
        segment.fail(&LAW, format!("no law \"{name}\""), Some(format!("{near}one of {}", known.join(", "))));
        return None;
    };
    let parameters = parameters(segment)?;
    inflected(segment, law, parameters)
}

/// A law with the place of its inflection.
fn inflected(segment: &Table<'_>, law: &'static Law, parameters: Parameters) -> Option<Mover> {
    let typed = segment.get(&INFLECTION)?;
    match typed.trim() {
        text if text.eq_ignore_ascii_case("smooth") => Some(Mover::Law(law, Inflection::Smooth, parameters)),
        text if text.eq_ignore_ascii_case("match") => Some(Mover::Matching(law, parameters)),
        text => {
            if let Ok(share) = units::parse_bare(text) {
                return Some(Mover::Law(law, Inflection::At(share), parameters));
            }
            let help = "\"smooth\", \"match\", or a share of the segment as \"0.4\"";
            segment.fail(&INFLECTION, format!("`inflection` cannot be \"{text}\""), Some(help.into()));
            None
        }
    }
}

/// The numbers of a law's own.
fn parameters(segment: &Table<'_>) -> Option<Parameters> {
    let list = |key: &Field<Vec<f64>>, count: usize| {
        let found = segment.get(key).filter(|_| segment.has(key));
        if let Some(found) = found.as_ref().filter(|found| found.len() != count) {
            segment.fail(key, format!("`{}` has {count} numbers, not {}", key.key.name, found.len()), None);
            return None;
        }
        Some(found)
    };
    let (fractions, amplitudes) = (list(&FRACTIONS, 4)?, list(&AMPLITUDES, 3)?);
    Some(Parameters {
        fractions: fractions.and_then(|found| found.try_into().ok()),
        amplitudes: amplitudes.and_then(|found| found.try_into().ok()),
        line: segment.get(&LINE),
        ramp: segment.get(&RAMP),
    })
}
