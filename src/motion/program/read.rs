//! The tables `[motion]` and `[[motion.segment]]`.

use super::keys::{
    ACCELERATION, AMPLITUDES, AT, BY, DWELL, END, EXPRESSED, EndOf, FRACTIONS, INFLECTION, JERK, LAW, LINE, MINIMISE,
    OVER, POLYNOMIAL, RAMP, REPEAT, RPM, SECTION, SEGMENT, SPLINE, START, TABULATED, TO, UNTIL, USUAL, VELOCITY,
};
use super::{Mover, Program, State, Step, StepError};
use super::{forms, optimum, polydyne};
use crate::document::similar;
use crate::document::{Field, LengthOrAngle, Reader, Table};
use crate::motion::Quantity;
use crate::motion::laws::{self, Inflection, LAWS, Law, LawError, Parameters};
use crate::units;
use std::f64::consts::{PI, TAU};

/// By how much the sum of the segments may differ from a whole turn, rad: rounding of typed angles. No segment is as short.
const WHOLE_TURN: f64 = 1e-9 * PI / 180.0;
/// By how much the last position may miss the first, over the largest: rounding of sums.
const SAME_PLACE: f64 = 1e-12;

pub(super) fn value_of(position: LengthOrAngle) -> (Quantity, f64) {
    match position {
        LengthOrAngle::Length(value) => (Quantity::Length, value),
        LengthOrAngle::Angle(value) => (Quantity::Angle, value),
    }
}

/// What holds for the whole program.
#[derive(Clone, Copy)]
pub(super) struct Whole {
    pub(super) quantity: Quantity,
    /// Angular speed of the cam, rad/s.
    speed: Option<f64>,
    /// First cam angle, and the angle the segments fill, rad.
    pub(super) at: f64,
    pub(super) fill: f64,
}

/// The program of a file, when there is one without fault.
pub(crate) fn read(reader: &Reader<'_>) -> Option<Program> {
    polydyne::read(reader, as_given(reader)?)
}

/// The motion that the file gives.
fn as_given(reader: &Reader<'_>) -> Option<Program> {
    let table = reader.find(&SECTION)?;
    let start = table.get(&START);
    let segments: Vec<Table<'_>> = reader.elements(&SEGMENT).collect();
    let form = forms::Form::find(reader, &table, !segments.is_empty()).ok()?;
    if segments.is_empty() && form.is_none() {
        if !reader.is_explained(&SEGMENT) {
            let help =
                Some("add [[motion.segment]] with law, over and to; or formula, points, table or fourier".into());
            table.fail(&START, "a motion needs segments".into(), help);
        }
        return None;
    }
    let lobes = lobes(&table);
    let (quantity, start) = value_of(start?);
    let rpm = table.get(&RPM);
    let (at, lobes) = (table.get(&AT)?, lobes?);
    let whole = Whole { quantity, speed: rpm.map(|rpm| rpm * TAU / 60.0), at, fill: TAU / f64::from(lobes) };
    if let Some(form) = form {
        return Some(Program { rpm, ..form.program(&table, whole, (start, lobes))? });
    }
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
            tell(segments.get(index)?, &error);
            None
        }
    }
}

/// Why a segment cannot be made, at the key that it has to do with.
fn tell(segment: &Table<'_>, error: &StepError) {
    let told = error.to_string();
    match error {
        StepError::NothingToMatch
        | StepError::Law(LawError::NoInflection { .. } | LawError::Inflection { .. } | LawError::NoMatch { .. }) => {
            segment.fail(&INFLECTION, told, None);
        }
        StepError::NothingToJoin { .. } => segment.fail(&VELOCITY, told, None),
        StepError::JerkOfSpline => segment.fail(&JERK, told, None),
        StepError::OptimumMoves => {
            let help = "take the states away, or `minimise`: a polynomial without it takes the states at its ends";
            segment.fail(&MINIMISE, told, Some(help.into()));
        }
        StepError::Law(LawError::Parameter { name: "fractions", .. }) => segment.fail(&FRACTIONS, told, None),
        StepError::Law(LawError::Parameter { name: "amplitudes", .. }) => segment.fail(&AMPLITUDES, told, None),
        StepError::Law(LawError::Parameter { name: "line", .. }) => segment.fail(&LINE, told, None),
        StepError::Law(LawError::Parameter { name: "ramp", .. }) => segment.fail(&RAMP, told, None),
        _ => segment.fail(&LAW, told, None),
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
    let mover = mover(segment, whole);
    let end = state(segment, whole);
    let target = target(segment, whole.quantity, position).ok();
    let (mut mover, mut end, target) = (mover?, end?, target?);
    let line = matches!(mover, Mover::Law(law, ..) if law.name == laws::LINE);
    let dwell = matches!(mover, Mover::Dwell);
    if dwell && (target.is_some() || !(end.rests() && end.free == [false; 2])) {
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
        (None, _) if last && sum < whole.fill - WHOLE_TURN => whole.fill - sum,
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
    match &mut mover {
        Mover::Own(_, curve) => {
            let (sized, slope) = (own_end(curve), (to - position) / over);
            end = State { velocity: sized[0] * slope, acceleration: sized[1] * slope / over, ..State::default() };
        }
        Mover::Spline(points) => forms::behind(segment, points, (whole.at + sum, over))?,
        _ => {}
    }
    Some(Step { mover, over, to, end })
}

/// Velocity and acceleration at the end of a curve, without rounding.
fn own_end(curve: &laws::Curve) -> [f64; 2] {
    let (last, peaks) = (curve.at(curve.parts().saturating_sub(1), 1.0), curve.peaks());
    let sizes = [(last[1], peaks.velocity.value), (last[2], peaks.acceleration.value)];
    // Of a straight line even the peak of the acceleration is rounding.
    sizes.map(|(value, size)| if value.abs() > super::ROUNDING * size.max(1.0) { value } else { 0.0 })
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
        if !(over > WHOLE_TURN && over <= TAU + WHOLE_TURN) {
            let from = (whole.at + sum).to_degrees();
            let message = format!("`until` must be behind the start of the segment, {from:.6} deg");
            segment.fail(&UNTIL, message, None);
            return Err(Told);
        }
        return Ok(Some(over));
    }
    if segment.has(&OVER) {
        let over = segment.get(&OVER).ok_or(Told)?;
        if over <= WHOLE_TURN {
            let message = "a segment must take more than 1e-9 deg";
            segment.fail(&OVER, message.into(), Some("make it longer, or leave it out".into()));
            return Err(Told);
        }
        return Ok(Some(over));
    }
    if rest && sum >= whole.fill - WHOLE_TURN {
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
    if !segment.has(key) || is_auto(segment, key) {
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

/// Whether a rate is to be found.
fn is_auto(segment: &Table<'_>, key: &Field<String>) -> bool {
    segment.get(key).is_some_and(|text| text.trim().eq_ignore_ascii_case(AUTO))
}

const AUTO: &str = "auto";

/// The state at the end of a segment.
fn state(segment: &Table<'_>, whole: Whole) -> Option<State> {
    let said = if segment.has(&END) { Some(segment.get(&END)?) } else { None };
    let velocity = rate(segment, &VELOCITY, 1, whole).ok()?;
    let acceleration = rate(segment, &ACCELERATION, 2, whole).ok()?;
    let jerk = rate(segment, &JERK, 3, whole).ok()?;
    let auto = [&VELOCITY, &ACCELERATION].map(|key| is_auto(segment, key));
    // Where the velocity is found, so is the acceleration that is not given.
    let free = [auto[0], auto[1] || (auto[0] && acceleration.is_none())];
    let moving = velocity.unwrap_or(0.0) != 0.0 || acceleration.unwrap_or(0.0) != 0.0 || free != [false; 2];
    let fault = match said {
        Some(EndOf::Turn) if moving => Some("a turn has the velocity 0 and any acceleration"),
        Some(EndOf::Rest) if moving => Some("at rest velocity and acceleration are 0"),
        Some(EndOf::Moving) if velocity.is_none() && acceleration.is_none() && free == [false; 2] => {
            Some("a moving end needs a velocity")
        }
        _ => None,
    };
    if let Some(message) = fault {
        segment.fail(&END, message.into(), Some("leave `end` out where a velocity or acceleration is given".into()));
        return None;
    }
    let turns = said == Some(EndOf::Turn);
    Some(State { velocity: velocity.unwrap_or(0.0), acceleration: acceleration.unwrap_or(0.0), jerk, turns, free })
}

/// What moves a segment.
fn mover(segment: &Table<'_>, whole: Whole) -> Option<Mover> {
    let name = if segment.has(&LAW) { segment.get(&LAW)? } else { USUAL.to_owned() };
    if optimum::is_asked(segment) {
        return optimum::read(segment, &name);
    }
    optimum::without(segment)?;
    if name.eq_ignore_ascii_case(DWELL) {
        return Some(Mover::Dwell);
    }
    if name.eq_ignore_ascii_case(POLYNOMIAL) {
        return Some(Mover::Polynomial);
    }
    if name.eq_ignore_ascii_case(SPLINE) {
        return forms::inner(segment, whole.quantity).map(Mover::Spline);
    }
    for (own, curve) in [(EXPRESSED, forms::shape as fn(&Table<'_>) -> _), (TABULATED, forms::shares)] {
        if name.eq_ignore_ascii_case(own) {
            return forms::without_state(segment, own)
                .and_then(|()| curve(segment))
                .map(|curve| Mover::Own(own, curve));
        }
    }
    let Some(law) = laws::named(&name) else {
        let all = LAWS.iter().map(|law| law.name);
        let known: Vec<&str> = [DWELL, POLYNOMIAL, SPLINE, EXPRESSED, TABULATED].into_iter().chain(all).collect();
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
