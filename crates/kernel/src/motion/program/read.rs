//! The tables `[motion]` and `[[motion.segment]]`.

use super::context::{
    FaultReported, FollowerMovement, ProgramContext, ProgramSpan, WHOLE_TURN, arc, report_mismatch, value_of,
};
use super::half_turn;
use super::keys::{
    ACCELERATION, AMPLITUDES, AT, BEGINS, BETWEEN_ROWS, BY, DWELL, END, EXPRESSED, EndWord, FRACTIONS, INFLECTION,
    JERK, LAW, LINE, MINIMISE, OVER, OWN_RPM, POLYDYNE, POLYNOMIAL, RAMP, REPEAT, RPM, SECTION, SEGMENT, SPLINE, START,
    STROKE, TABULATED, TO, UNTIL, USUAL, VELOCITY,
};
use super::{EndState, Mover, Program, SegmentSpec};
use super::{forms, optimum, polydyne, rows};
use crate::document::similar;
use crate::document::{Field, LengthOrAngle, Reader, TableReader};
use crate::motion::Quantity;
use crate::motion::laws::{self, Inflection, LAWS, Law, LawError, Parameters};
use crate::refusal::Refusal;
use crate::units;
use std::f64::consts::TAU;

/// Most segments: each of them would be cut in some arcs.
const MOST_SEGMENTS: usize = 2000;
/// Largest distance of the last position from the first, over the largest: rounding of sums.
const SAME_PLACE: f64 = 1e-12;
/// Largest difference of the last position from that of an index, rad: rounding of typed angles, as 51.428571 deg.
const SAME_ANGLE: f64 = 1e-7;

/// The program of a file for its follower, where that has no fault, when there is one without fault; over what it goes is known where the cam
/// has no fault.
pub fn read(reader: &Reader<'_>, follower: Option<FollowerMovement>, span: Option<ProgramSpan>) -> Option<Program> {
    let program = polydyne::read(reader, as_given(reader, follower, span)?)?;
    Some(Program { timed: depends_on_speed(reader), ..program })
}

/// Whether a motion without a fault depends on the speed.
fn depends_on_speed(reader: &Reader<'_>) -> bool {
    if reader.find(&POLYDYNE).is_some_and(|load| !load.has(&OWN_RPM)) {
        return true;
    }
    reader.elements(&SEGMENT).any(|segment| {
        [(1, &VELOCITY), (2, &ACCELERATION), (3, &JERK)].into_iter().any(|(order, key)| {
            let rate = segment.get(key).and_then(|text| units::parse_rate(&text, order).ok());
            rate.is_some_and(|rate| rate.by_time)
        })
    })
}

/// The motion that the file gives.
fn as_given(reader: &Reader<'_>, follower: Option<FollowerMovement>, span: Option<ProgramSpan>) -> Option<Program> {
    let table = reader.find(&SECTION)?;
    let start = table.get(&START);
    let segments: Vec<TableReader<'_>> = reader.elements(&SEGMENT).collect();
    refuse_too_many(&table, segments.len()).ok()?;
    let form = forms::MotionForm::find(reader, &table, !segments.is_empty()).ok()?;
    let stroke = stroke(&table, span);
    if segments.is_empty() && form.is_none() {
        report_no_segments(reader, &table);
        return None;
    }
    let lobes = lobes(&table);
    let arc = arc(&table, follower);
    let (quantity, start) = value_of(start?, arc);
    if let Some(follower) = follower.filter(|follower| follower.quantity != quantity) {
        report_mismatch(&table, quantity, follower, &lengths(&segments, start));
    }
    let rpm = table.get(&RPM);
    let (at, lobes, stroke) = (table.get(&AT)?, lobes?, stroke.ok()?);
    let of_yoke = span == Some(ProgramSpan::HalfTurn);
    if of_yoke {
        half_turn::refuse_even(&table, lobes);
    }
    let fill = stroke.unwrap_or(TAU / f64::from(lobes));
    let halved = of_yoke && half_turn::is_covered(&segments, at, 0.5 * fill);
    let whole = ProgramContext {
        quantity,
        arc,
        arm: follower.and_then(|follower| follower.arm),
        speed: rpm.map(units::rad_per_s),
        has_faulty_speed: rpm.is_none() && table.has(&RPM),
        at,
        fill: if halved { 0.5 * fill } else { fill },
        by_travel: stroke.is_some(),
    };
    let index = index(&table, span, form.is_some(), lobes).ok()?;
    if let Some(form) = form {
        return Some(Program { rpm, ..form.program(&table, whole, start, lobes)? });
    }
    let mut steps = steps(&segments, whole, start)?;
    if halved {
        half_turn::completed(&mut steps, start);
    }
    let made = if let Some(stroke) = stroke {
        Program::of_stroke(start, stroke, &steps)
    } else {
        match index {
            Some(angle) => end_farther(&segments, &mut steps, start, angle)?,
            None => close(&table, &segments, &mut steps, start)?,
        }
        Program::of_steps(quantity, at, start, lobes, &steps)
    };
    match made {
        Ok(program) => Some(Program { rpm, ..program }),
        Err((index, error)) => {
            report_error(segments.get(index % segments.len())?, error);
            None
        }
    }
}

fn report_no_segments(reader: &Reader<'_>, table: &TableReader<'_>) {
    if !reader.is_explained(&SEGMENT) {
        let help = "add [[motion.segment]] with law, over and to; or formula, points, table or fourier";
        table.fail(&START, "a motion needs segments".into(), Some(help.into()));
    }
}

/// The rows of the lift table of a file for its follower, where there is one without fault.
pub fn table_rows(reader: &Reader<'_>, follower: Option<FollowerMovement>) -> Option<rows::TableRows> {
    let table = reader.find(&SECTION)?;
    let (start, lobes) = (table.get(&START)?, lobes(&table)?);
    let arc = arc(&table, follower);
    let (quantity, start) = value_of(start, arc);
    let follower = follower?;
    if follower.quantity != quantity {
        report_mismatch(&table, quantity, follower, &[start]);
        return None;
    }
    let fill = TAU / f64::from(lobes);
    let whole = ProgramContext {
        quantity,
        arc,
        arm: follower.arm,
        speed: None,
        has_faulty_speed: false,
        at: 0.0,
        fill,
        by_travel: false,
    };
    rows::table_rows(&table, whole)
}

/// Ends the steps of a turn exactly where they start; `None` where they end elsewhere.
fn close(table: &TableReader<'_>, segments: &[TableReader<'_>], steps: &mut [SegmentSpec], start: f64) -> Option<()> {
    let largest = steps.iter().map(|step| step.to.abs()).fold(start.abs(), f64::max);
    let last = steps.last_mut()?;
    if (last.to - start).abs() > SAME_PLACE * largest {
        let message = "the motion does not end where it starts".to_owned();
        let help = Some(format!("the last `to` must be motion.start, {}", table.typed(&START)));
        segments.last()?.fail(&TO, message, help);
        return None;
    }
    last.to = start;
    Some(())
}

fn refuse_too_many(table: &TableReader<'_>, segments: usize) -> Result<(), FaultReported> {
    if segments <= MOST_SEGMENTS {
        return Ok(());
    }
    let message = format!("the motion has {segments} segments; the largest possible number is {MOST_SEGMENTS}");
    table.fail(&START, message, Some("give it as a table of positions, motion.table".into()));
    Err(FaultReported)
}

/// By how much a turn moves a turret on, rad; `None` of another follower. A motion that ends where it begins is refused.
fn index(
    table: &TableReader<'_>,
    span: Option<ProgramSpan>,
    whole: bool,
    lobes: u32,
) -> Result<Option<f64>, FaultReported> {
    let Some(ProgramSpan::Index(angle)) = span else { return Ok(None) };
    if whole {
        let message = "a motion given as a whole ends where it began, and a turret is moved on".to_owned();
        let help = "give segments: a law, over and to for each movement, and the dwells between them";
        table.fail(&START, message, Some(help.into()));
        return Err(FaultReported);
    }
    if lobes > 1 {
        let message = "`repeat` begins each lobe at motion.start, and a turret is moved on".to_owned();
        table.fail(&REPEAT, message, Some("give the segments of the whole turn".into()));
        return Err(FaultReported);
    }
    Ok(Some(angle))
}

/// Ends the steps of a turn exactly where the turret stands one index farther; `None` where they end elsewhere.
fn end_farther(segments: &[TableReader<'_>], steps: &mut [SegmentSpec], start: f64, angle: f64) -> Option<()> {
    let last = steps.last_mut()?;
    // What is wrong with the turret is reported elsewhere.
    if angle.is_nan() {
        return None;
    }
    if (last.to - start - angle).abs() > SAME_ANGLE {
        let moved = (last.to - start).to_degrees();
        let message = format!(
            "a turn of the cam moves the turret on by {moved:.6} deg instead of {:.6} deg, cam.advance of its rollers",
            angle.to_degrees()
        );
        // Without the rounding of the conversion.
        let degrees = (1e9 * (start + angle).to_degrees()).round() / 1e9;
        let help = format!("the last `to` must be {degrees} deg");
        segments.last()?.fail(&TO, message, Some(help));
        return None;
    }
    last.to = start + angle;
    Some(())
}

/// The stroke of a plate, m, over which its program goes in the place of a turn; `None` of a cam that turns.
fn stroke(table: &TableReader<'_>, span: Option<ProgramSpan>) -> Result<Option<f64>, FaultReported> {
    if !matches!(span, None | Some(ProgramSpan::Stroke)) && table.has(&STROKE) {
        let help = "give cam.body = \"wedge\", or remove it";
        table.fail(&STROKE, "`stroke` is the travel of a plate, but the cam turns".into(), Some(help.into()));
        return Err(FaultReported);
    }
    if span == Some(ProgramSpan::Stroke) && !table.has(&STROKE) {
        let help = "e.g. stroke = \"100 mm\": its segments then have lengths, over = \"80 mm\"";
        table.fail(&STROKE, "the motion of a plate needs the travel over which it goes".into(), Some(help.into()));
        return Err(FaultReported);
    }
    if !table.has(&STROKE) {
        return Ok(None);
    }
    let turning = [(table.has(&RPM), "rpm"), (table.has(&AT), "at"), (table.has(&REPEAT), "repeat")];
    for (_, name) in turning.into_iter().filter(|(given, _)| *given) {
        let message = format!("`{name}` is for a cam that turns: a plate travels from x = 0 over its stroke");
        let help = Some("remove it".to_owned());
        match name {
            "rpm" => table.fail(&RPM, message, help),
            "at" => table.fail(&AT, message, help),
            _ => table.fail(&REPEAT, message, help),
        }
    }
    table.get(&STROKE).map(Some).ok_or(FaultReported)
}

/// The positions that are given as lengths, m.
fn lengths(segments: &[TableReader<'_>], start: f64) -> Vec<f64> {
    let given = segments.iter().flat_map(|segment| [segment.get(&TO), segment.get(&BY)]);
    std::iter::once(start)
        .chain(
            given
                .flatten()
                .filter_map(|position| if let LengthOrAngle::Length(length) = position { Some(length) } else { None }),
        )
        .collect()
}

/// Reports why a segment cannot be made, at the key that is responsible.
fn report_error(segment: &TableReader<'_>, error: LawError) {
    let Refusal { what, remedy, .. } = error.refusal;
    let remedy = remedy.map(|remedy| remedy.to_string());
    match error.input {
        "inflection" => segment.fail(&INFLECTION, what, remedy),
        "velocity" => segment.fail(&VELOCITY, what, remedy),
        "start" => segment.fail(&BEGINS, what, remedy),
        "jerk" => segment.fail(&JERK, what, remedy),
        "minimise" => segment.fail(&MINIMISE, what, remedy),
        "fractions" => segment.fail(&FRACTIONS, what, remedy),
        "amplitudes" => segment.fail(&AMPLITUDES, what, remedy),
        "line" => segment.fail(&LINE, what, remedy),
        "ramp" => segment.fail(&RAMP, what, remedy),
        "shape" => segment.fail(&BETWEEN_ROWS, what, remedy),
        _ => segment.fail(&LAW, what, remedy),
    }
}

fn lobes(table: &TableReader<'_>) -> Option<u32> {
    let typed = table.get(&REPEAT)?;
    if typed.fract() != 0.0 {
        table.fail(&REPEAT, format!("`repeat` must be a whole number, not {typed}"), None);
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 1 to 100")]
    Some(typed as u32)
}

/// Every segment as a step, one after the other.
fn steps(segments: &[TableReader<'_>], whole: ProgramContext, start: f64) -> Option<Vec<SegmentSpec>> {
    let (mut all, mut position, mut sum) = (Vec::with_capacity(segments.len()), start, 0.0);
    let mut missing = false;
    for (index, segment) in segments.iter().enumerate() {
        let last = index + 1 == segments.len();
        match step(segment, whole, position, sum, last) {
            Some(step) => {
                (position, sum) = (step.to, sum + step.over);
                all.push(step);
            }
            // What follows from an unknown segment is not reported.
            None if segment.has(&OVER) || segment.has(&UNTIL) || last => missing = true,
            None => return None,
        }
    }
    if missing {
        return None;
    }
    if (sum - whole.fill).abs() > WHOLE_TURN {
        let off = whole.fill - sum;
        let by = whole.shown(off.abs());
        let what = if off > 0.0 { format!("{by} are missing") } else { format!("{by} too much") };
        let message = format!("the segments cover {}, {what}", whole.shown(sum));
        let help = format!("omit `over` of the last segment to fill the {}", whole.whole());
        segments.last()?.fail(&OVER, message, Some(help));
        return None;
    }
    Some(all)
}

/// A segment that starts at a position, after segments with a sum of angles, rad.
fn step(segment: &TableReader<'_>, whole: ProgramContext, position: f64, sum: f64, last: bool) -> Option<SegmentSpec> {
    let target = target(segment, whole, position).ok();
    let mover = mover(segment, whole, target.flatten().map(|to| to - position));
    let end = state(segment, whole);
    let (mut mover, mut end, target) = (mover?, end?, target?);
    let free_start = free_start(segment, &mover)?;
    let line = matches!(mover, Mover::Law(law, ..) if law.name == laws::LINE);
    let dwell = matches!(mover, Mover::Dwell);
    if dwell && (target.is_some() || !(end.rests() && end.free == [false; 2])) {
        let key = if segment.has(&BY) { &BY } else { &TO };
        let help = "omit `to`, or give a law that moves";
        segment.fail(key, "a dwell keeps its position and has no `to`".into(), Some(help.into()));
        return None;
    }
    // For a straight line, two of angle, travel and velocity give the third.
    let by_velocity = line && end.velocity != 0.0;
    let over = match (width(segment, whole, sum, last && !by_velocity).ok()?, target) {
        (Some(over), _) => over,
        (None, Some(to)) if by_velocity && (to - position) / end.velocity > 0.0 => (to - position) / end.velocity,
        (None, Some(_)) if by_velocity => {
            segment.fail(&VELOCITY, "the velocity points away from `to`".into(), Some("change its sign".into()));
            return None;
        }
        (None, _) if last && sum < whole.fill - WHOLE_TURN => whole.fill - sum,
        (None, _) => {
            let help = format!("only the last segment may omit it; it then takes the rest of the {}", whole.whole());
            segment.fail(&OVER, "a segment has no `over`".into(), Some(help));
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
        end = line_end(segment, (to - position) / over, by_velocity.then_some(end.velocity))?;
    }
    match &mut mover {
        Mover::Own(_, curve, _) => {
            let (sized, slope) = (own_end(curve), (to - position) / over);
            end = EndState { velocity: sized[0] * slope, acceleration: sized[1] * slope / over, ..EndState::default() };
        }
        Mover::Spline(rows) => forms::measure_from_start(segment, whole, &mut rows.points, whole.at + sum, over)?,
        _ => {}
    }
    Some(SegmentSpec { mover, over, to, end, free_start })
}

/// Whether the acceleration where a segment starts is free; only polynomials and splines can choose.
fn free_start(segment: &TableReader<'_>, mover: &Mover) -> Option<bool> {
    if segment.has(&BEGINS) && !matches!(mover, Mover::Polynomial | Mover::Spline(_)) {
        let message = format!("`start` applies only to polynomials and splines, not to {}", mover.name());
        segment.fail(&BEGINS, message, Some("remove it".into()));
        return None;
    }
    segment.get(&BEGINS)
}

/// The state of a straight line with this velocity, from which a given one must not differ.
fn line_end(segment: &TableReader<'_>, velocity: f64, given: Option<f64>) -> Option<EndState> {
    if given.is_some_and(|given| (velocity - given).abs() > SAME_PLACE.sqrt() * velocity.abs()) {
        let message = "over, to and velocity of a straight line contradict each other".to_owned();
        segment.fail(&VELOCITY, message, Some("two of them determine the third: remove one".into()));
        return None;
    }
    Some(EndState { velocity, ..EndState::default() })
}

/// Velocity and acceleration at the end of a curve, without rounding.
fn own_end(curve: &laws::LawCurve) -> [f64; 2] {
    let (last, peaks) = (curve.values_at(curve.parts().saturating_sub(1), 1.0), curve.peaks());
    let sizes = [(last[1], peaks.velocity.value), (last[2], peaks.acceleration.value)];
    // For a straight line even the peak of the acceleration is rounding.
    sizes.map(|(value, size)| if value.abs() > super::ROUNDING * size.max(1.0) { value } else { 0.0 })
}

/// The cam angle, or the length, of a segment, where it is given.
fn width(segment: &TableReader<'_>, whole: ProgramContext, sum: f64, rest: bool) -> Result<Option<f64>, FaultReported> {
    if segment.has(&OVER) && segment.has(&UNTIL) {
        segment.fail(&UNTIL, "give `over` or `until`, not both".into(), Some("remove one of them".into()));
        return Err(FaultReported);
    }
    if let Some(until) = whole.place(segment, &UNTIL)? {
        let over = until - (whole.at + sum);
        let most = if whole.by_travel { f64::INFINITY } else { TAU };
        if !(over > WHOLE_TURN && over <= most + WHOLE_TURN) {
            let from = whole.shown(whole.at + sum);
            let message = format!("`until` must come after the start of the segment, {from}");
            segment.fail(&UNTIL, message, None);
            return Err(FaultReported);
        }
        return Ok(Some(over));
    }
    if let Some(over) = whole.place(segment, &OVER)? {
        if over <= WHOLE_TURN {
            let least = if whole.by_travel { "0.02 nm" } else { "1e-9 deg" };
            segment.fail(
                &OVER,
                format!("a segment must be longer than {least}"),
                Some("make it longer, or remove it".into()),
            );
            return Err(FaultReported);
        }
        return Ok(Some(over));
    }
    if rest && sum >= whole.fill - WHOLE_TURN {
        let message = format!("the segments before the last already cover {}", whole.shown(sum));
        segment.fail(&OVER, message, Some("make them shorter, or remove the last".into()));
        return Err(FaultReported);
    }
    Ok(None)
}

/// The position at the end of a segment, where it is given.
fn target(segment: &TableReader<'_>, whole: ProgramContext, position: f64) -> Result<Option<f64>, FaultReported> {
    if segment.has(&TO) && segment.has(&BY) {
        segment.fail(&BY, "give `to` or `by`, not both".into(), Some("remove one of them".into()));
        return Err(FaultReported);
    }
    for (key, from, name) in [(&TO, 0.0, "to"), (&BY, position, "by")] {
        if segment.has(key) {
            let (found, value) = whole.value_of(segment.get(key).ok_or(FaultReported)?);
            if found != whole.quantity {
                let message = format!("`{name}` is {}, but motion.start is {}", found.words(), whole.quantity.words());
                segment.fail(key, message, Some(whole.remedy(value)));
                return Err(FaultReported);
            }
            return Ok(Some(from + value));
        }
    }
    Ok(None)
}

/// A rate at the end of a segment per cam angle, where it is given.
fn rate(
    segment: &TableReader<'_>,
    key: &Field<String>,
    order: u32,
    whole: ProgramContext,
) -> Result<Option<f64>, FaultReported> {
    if !segment.has(key) || is_auto(segment, key) {
        return Ok(None);
    }
    let text = segment.get(key).ok_or(FaultReported)?;
    let swings = whole.quantity == Quantity::Angle;
    let fits = match (swings, whole.by_travel) {
        (true, _) => "deg/deg, rad/rad or deg/s",
        (false, false) => "mm/deg, mm/rad, mm/s or m/s",
        (false, true) => "mm/mm or in/in",
    };
    let powers = if order > 1 { format!(", with {order} after the second unit") } else { String::new() };
    let fail = |message: String, help: String| {
        segment.fail(key, message, Some(help));
        Err(FaultReported)
    };
    let name = key.key.name;
    match units::parse_rate(&text, order) {
        Err(error) => fail(format!("`{name}`: {error}"), format!("a number and one of {fits}{powers}")),
        Ok(rate) if rate.swing != swings && (rate.swing || whole.arc.is_none()) => {
            let (found, wanted) = if swings { ("a length", "an angle") } else { ("an angle", "a length") };
            fail(format!("`{name}` is that of {found}, but motion.start is {wanted}"), format!("one of {fits}{powers}"))
        }
        Ok(rate) if rate.by_travel != whole.by_travel => {
            let message = if whole.by_travel {
                format!("`{name}` of a plate is that along its travel: its speed is not known")
            } else {
                format!("`{name}` is that along the travel of a plate, but the cam turns")
            };
            fail(message, format!("one of {fits}{powers}"))
        }
        Ok(rate) => {
            let value = if rate.swing { rate.value } else { rate.value / whole.arc.unwrap_or(1.0) };
            match whole.speed {
                _ if !rate.by_time => Ok(Some(value)),
                Some(speed) => Ok(Some((0..order).fold(value, |value, _| value / speed))),
                None if whole.has_faulty_speed => Err(FaultReported),
                None => fail(
                    format!("`{name}` per second needs motion.rpm"),
                    "add motion.rpm, or give the rate per angle".into(),
                ),
            }
        }
    }
}

/// Whether a rate is "auto".
fn is_auto(segment: &TableReader<'_>, key: &Field<String>) -> bool {
    segment.get(key).is_some_and(|text| text.trim().eq_ignore_ascii_case(AUTO))
}

const AUTO: &str = "auto";

/// The state at the end of a segment.
fn state(segment: &TableReader<'_>, whole: ProgramContext) -> Option<EndState> {
    let said = if segment.has(&END) { Some(segment.get(&END)?) } else { None };
    let velocity = rate(segment, &VELOCITY, 1, whole).ok()?;
    let acceleration = rate(segment, &ACCELERATION, 2, whole).ok()?;
    let jerk = rate(segment, &JERK, 3, whole).ok()?;
    let auto = [&VELOCITY, &ACCELERATION].map(|key| is_auto(segment, key));
    // Where the velocity is found, so is the acceleration that is not given.
    let free = [auto[0], auto[1] || (auto[0] && acceleration.is_none())];
    let moving = velocity.unwrap_or(0.0) != 0.0 || acceleration.unwrap_or(0.0) != 0.0 || free != [false; 2];
    let fault = match said {
        Some(EndWord::Turn) if moving => {
            Some("at a turn the velocity is 0 and the acceleration is free: neither can be given")
        }
        Some(EndWord::Rest) if moving => Some("at rest velocity and acceleration are 0: no others can be given"),
        Some(EndWord::Moving) if velocity.is_none() && acceleration.is_none() && free == [false; 2] => {
            Some("a moving end needs a velocity")
        }
        _ => None,
    };
    if let Some(message) = fault {
        segment.fail(&END, message.into(), Some("remove `end` where a velocity or acceleration is given".into()));
        return None;
    }
    let turns = said == Some(EndWord::Turn);
    let (velocity, acceleration) = (velocity.unwrap_or(0.0), acceleration.unwrap_or(0.0));
    Some(EndState { velocity, acceleration, jerk, turns, turning: None, free })
}

/// How a segment moves, of a travel where that is known.
fn mover(segment: &TableReader<'_>, whole: ProgramContext, travel: Option<f64>) -> Option<Mover> {
    let name = if segment.has(&LAW) { segment.get(&LAW)? } else { USUAL.to_owned() };
    if ![SPLINE, TABULATED].iter().any(|of_rows| name.eq_ignore_ascii_case(of_rows)) {
        rows::segment::refuse_keys(segment, &name)?;
    }
    if optimum::has_goal(segment) {
        return optimum::read(segment, &name);
    }
    optimum::refuse_keys(segment)?;
    if name.eq_ignore_ascii_case(DWELL) {
        return Some(Mover::Dwell);
    }
    if name.eq_ignore_ascii_case(POLYNOMIAL) {
        return Some(Mover::Polynomial);
    }
    if name.eq_ignore_ascii_case(SPLINE) {
        return forms::inner_points(segment, whole).map(Mover::Spline);
    }
    if name.eq_ignore_ascii_case(EXPRESSED) {
        forms::refuse_states(segment, EXPRESSED)?;
        return forms::formula_curve(segment).map(|curve| Mover::Own(EXPRESSED, curve, None));
    }
    if name.eq_ignore_ascii_case(TABULATED) {
        forms::refuse_states(segment, TABULATED)?;
        let (curve, figures) = forms::table_curve(segment, whole, travel)?;
        return Some(Mover::Own(TABULATED, curve, Some(Box::new(figures))));
    }
    let Some(law) = laws::named(&name) else {
        let all = LAWS.iter().map(|law| law.name);
        let known: Vec<&str> = [DWELL, POLYNOMIAL, SPLINE, EXPRESSED, TABULATED].into_iter().chain(all).collect();
        let near = similar(&name, known.iter().copied());
        let near = near.map_or(String::new(), |law| format!("did you mean \"{law}\"? It is "));
        segment.fail(&LAW, format!("there is no law \"{name}\""), Some(format!("{near}one of {}", known.join(", "))));
        return None;
    };
    let parameters = parameters(segment)?;
    inflected(segment, law, parameters)
}

/// A law with the place of its inflection.
fn inflected(segment: &TableReader<'_>, law: &'static Law, parameters: Parameters) -> Option<Mover> {
    if !segment.has(&INFLECTION) {
        return Some(Mover::Law(law, None, parameters));
    }
    let typed = segment.get(&INFLECTION)?;
    match typed.trim() {
        text if text.eq_ignore_ascii_case("smooth") => Some(Mover::Law(law, Some(Inflection::Smooth), parameters)),
        text if text.eq_ignore_ascii_case("match") => Some(Mover::Matching(law, parameters)),
        text => {
            if let Ok(share) = units::parse_bare(text) {
                return Some(Mover::Law(law, Some(Inflection::At(share)), parameters));
            }
            let help = "use \"smooth\", \"match\", or a share of the segment such as \"0.4\"";
            segment.fail(&INFLECTION, format!("`inflection` cannot be \"{text}\""), Some(help.into()));
            None
        }
    }
}

/// The parameters of a law.
fn parameters(segment: &TableReader<'_>) -> Option<Parameters> {
    Some(Parameters {
        fractions: numbers(segment, &FRACTIONS).ok()?,
        amplitudes: numbers(segment, &AMPLITUDES).ok()?,
        line: segment.get(&LINE),
        ramp: segment.get(&RAMP),
    })
}

/// The `N` numbers of a key, if it is given.
fn numbers<const N: usize>(
    segment: &TableReader<'_>,
    key: &Field<Vec<f64>>,
) -> Result<Option<[f64; N]>, FaultReported> {
    let Some(found) = segment.get(key).filter(|_| segment.has(key)) else { return Ok(None) };
    match <[f64; N]>::try_from(found) {
        Ok(numbers) => Ok(Some(numbers)),
        Err(found) => {
            segment.fail(key, format!("`{}` needs {N} numbers, not {}", key.key.name, found.len()), None);
            Err(FaultReported)
        }
    }
}
