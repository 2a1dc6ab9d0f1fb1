//! Programs in the dialogue of HEIDENHAIN controls (Klartext): `L`, `CC`, `C`.

use super::cutting_state::{Spindle, ToolLength, whole};
use super::dialect::{does_unseen_in_a_dialogue, moves_the_profile_of_a_dialogue};
use super::machine_state::MachineState;
use super::words::{at_line, unquoted};
use super::{CutterProgram, CutterSide, MoveKind};
use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// The cycles that set a frame, and that of the tolerance.
const KNOWN_CYCLES: [&str; 7] = ["7", "8", "10", "11", "19", "26", "32"];
/// Words by which a move leaves for a place of the machine, or upwards along the tool.
const PLACES: [&str; 3] = ["M91", "M92", "M140"];

/// Cycles of which a definition alone moves nothing: dwell, orientation of the spindle, datum.
const RESTING_CYCLES: [&str; 3] = ["9", "13", "247"];
/// M functions that move, call, or change how the control follows its path.
const M_OF_THE_PATH: [u32; 18] = [89, 90, 91, 92, 94, 97, 98, 99, 104, 112, 114, 118, 124, 128, 130, 134, 136, 138];

/// Reads a program.
pub(super) fn read(text: &str) -> Result<CutterProgram, Refusal> {
    let (mut state, mut centre, mut ended, mut stopped) =
        (MachineState::of(Some(Controller::Heidenhain)), None, false, false);
    for (index, whole) in text.lines().enumerate() {
        let line = index + 1;
        // A name may have blanks; a comma is a decimal point.
        let block = unquoted(whole.split(';').next().unwrap_or_default()).to_ascii_uppercase().replace(',', ".");
        let mut words: Vec<&str> = block.split_ascii_whitespace().collect();
        if words.first().is_some_and(|word| word.bytes().all(|byte| byte.is_ascii_digit())) {
            words.remove(0);
        }
        if let Some(what) = moves_the_profile_of_a_dialogue(&words) {
            return Err(at_line(line, format!("the program {what}, and is then not the profile that it says")));
        }
        if let Some(what) = does_unseen_in_a_dialogue(&words) {
            return Err(at_line(line, format!("the program {what}: what it then does is not seen here")));
        }
        match words.as_slice() {
            _ if ended && !words.is_empty() => {
                return Err(at_line(line, "there is more behind the end of the program"));
            }
            // They end the program for the control.
            ["M30" | "M2"] => stopped = true,
            [word @ ("M3" | "M4" | "M5" | "M13" | "M14")] => turn(line, word, &mut state)?,
            []
            // Without a call a label does nothing.
            | ["LBL", _]
            | ["M7" | "M8" | "M9"]
            // Those of them that move the profile are refused above.
            | ["PLANE" | "FUNCTION", ..] => {}
            [word @ ("STOP" | "M0" | "M1" | "M6")] => stop(line, word, &mut state)?,
            // What would move the profile is refused above.
            ["CYCL", "DEF", cycle, rest @ ..] if KNOWN_CYCLES.contains(&cycle.split('.').next().unwrap_or_default()) => {
                cycle_definition(line, (cycle, rest), &mut state)?;
            }
            ["TRANS", ..] => state.readiness.shift_is_ended(),
            ["TOOL", "CALL", call @ ..] => tool_call(line, call, &mut state)?,
            ["BEGIN", "PGM", _, unit] => state.units = Some(unit_of(line, unit)?),
            ["END", "PGM", _, unit] if Some(unit_of(line, unit)?) != state.units => {
                return Err(at_line(line, "the unit is another one than at the beginning of the program"));
            }
            ["END", "PGM", ..] => ended = true,
            _ if stopped => return Err(at_line(line, "M2 or M30 ends the program, and there is more behind it")),
            _ if state.units.is_none() => return Err(at_line(line, "the program does not begin with its name and unit")),
            ["CC", rest @ ..] => centre = Some(centre_of(line, rest)? * state.scale()),
            ["L", rest @ ..] => straight(line, rest, &mut state)?,
            ["C", rest @ ..] => round(line, rest, centre, &mut state)?,
            _ if is_of_the_shop(&words) => state.unknown(line, block.trim(), false)?,
            _ => {
                let shown: String = block.trim().chars().take(40).collect();
                return Err(at_line(line, format!("`{shown}` is not known, and what it does to the path neither")));
            }
        }
    }
    if ended {
        state.program(Some(Controller::Heidenhain))
    } else {
        Err(Refusal::new("the program has no end (END PGM)"))
    }
}

/// Whether a block that is not known may stand before the first move: the blank, a tool's data, variables, a heading, M functions of the machine, and cycles that
/// move nothing.
fn is_of_the_shop(words: &[&str]) -> bool {
    let variable = |word: &str| {
        let name = word.trim_start_matches('Q').trim_start_matches(['L', 'R', 'S']);
        word.starts_with('Q') && name.starts_with(|c: char| c.is_ascii_digit())
    };
    let function = |word: &&str| {
        let number = word.strip_prefix('M').and_then(|number| number.parse().ok());
        number.is_some_and(|number: u32| !M_OF_THE_PATH.contains(&number))
    };
    match words {
        ["BLK", "FORM", ..] | ["FN", ..] => true,
        // With a length or a radius it is another tool than that of the table.
        ["TOOL", "DEF", rest @ ..] => !rest.iter().any(|word| word.starts_with(['L', 'R'])),
        ["CYCL", "DEF", cycle, ..] => RESTING_CYCLES.contains(&cycle.split('.').next().unwrap_or_default()),
        [first, ..] if variable(first) || first.starts_with("FN") || first.starts_with('*') => true,
        _ => words.iter().all(function),
    }
}

/// The unit of a program.
fn unit_of(line: usize, word: &str) -> Result<LengthUnit, Refusal> {
    match word {
        "MM" => Ok(LengthUnit::Millimetre),
        "INCH" => Ok(LengthUnit::Inch),
        _ => Err(at_line(line, format!("the unit `{word}` is neither MM nor INCH"))),
    }
}

/// The feed of a block, mm/min: of a program in inches it is in tenths of an inch per minute.
fn feed(state: &MachineState, number: f64) -> f64 {
    match state.units {
        Some(LengthUnit::Inch) => 0.1 * LengthUnit::Inch.millimetres() * number,
        _ => number,
    }
}

fn number(line: usize, word: &str) -> Result<f64, Refusal> {
    let read = word.parse().ok().filter(|number: &f64| number.is_finite());
    read.ok_or_else(|| at_line(line, format!("`{word}` is no number")))
}

/// `TOOL CALL 1 Z S3000 F300 DL+0 DR+0`: no change of the tool may move the path or, where the control keeps it beside it, the profile.
fn tool_call(line: usize, words: &[&str], state: &mut MachineState) -> Result<(), Refusal> {
    // Without a number or a name the call changes the speed alone.
    let first = words.first().copied().unwrap_or("Z");
    if first.starts_with(|c: char| c.is_ascii_digit() || c == '"') {
        if state.is_deep() || state.side != CutterSide::Centre {
            return Err(at_line(
                line,
                "the tool changes below the upper face, or while the cutter is kept beside its path",
            ));
        }
        state.cutting.tool = first.parse().ok().and_then(whole).filter(|tool| *tool > 0);
        state.cutting.named = first.starts_with('"');
        state.radius_fault = None;
        state.cutting.length = ToolLength::Unstated;
        state.readiness.tool_changes();
    }
    let of_speed = |word: &str| ["Z", "X", "Y", "U", "V", "W"].contains(&word) || word.starts_with(['S', 'F', 'D']);
    if !first.starts_with(|c: char| c.is_ascii_digit() || c == '"') && !of_speed(first) {
        let what = format!("the tool is called by `{first}`: which one that is, is not seen here");
        return Err(at_line(line, what).remedy("write TOOL CALL with its number"));
    }
    if first == "0" {
        state.cutting.length = ToolLength::Cancelled;
        state.radius_fault = Some("no tool is called (TOOL CALL 0)");
    }
    for word in words {
        let value = |name: &str| word.strip_prefix(name).map(|value| number(line, value));
        if let Some(change) = value("DR2").or(value("DR")) {
            if state.side != CutterSide::Centre {
                return Err(at_line(
                    line,
                    "TOOL CALL changes the radius (DR) while the cutter is kept beside its path",
                ));
            }
            state.radius_fault = (change? != 0.0).then_some("TOOL CALL changes its radius (DR)").or(state.radius_fault);
        } else if let Some(change) = value("DL") {
            if change? != 0.0 {
                return Err(at_line(
                    line,
                    "TOOL CALL moves the tool along its axis (DL): it does not cut to its depth",
                ));
            }
        } else if ["X", "Y", "U", "V", "W"].contains(word) {
            return Err(at_line(line, "the axis of the tool is not Z: arcs of a cam lie in the plane across it"));
        } else if let Some(speed) = word.strip_prefix('S').and_then(|speed| speed.parse().ok()) {
            state.cutting.speed = Some(speed);
            state.cutting.spindle = state.spindle.at(state.cutting.speed);
        } else if let Some(feed) = word.strip_prefix('F').and_then(|feed| feed.parse().ok()) {
            state.called_feed = Some(self::feed(state, feed));
            state.feed = state.called_feed;
        }
    }
    Ok(())
}

/// M3, M4 and M5, M13 and M14.
fn turn(line: usize, word: &str, state: &mut MachineState) -> Result<(), Refusal> {
    // M13 and M14 are M3 and M4 with the coolant.
    let way = Spindle::of(number(line, word.trim_start_matches('M'))? % 10.0).unwrap_or_default();
    if way != Spindle::Clockwise && state.is_deep() {
        return Err(at_line(line, "the spindle stops or turns back below the upper face"));
    }
    state.spindle = way;
    state.readiness.spindle_turns(way != Spindle::Stopped);
    state.cutting.spindle = state.spindle.at(state.cutting.speed);
    Ok(())
}

/// M0, M1 and M6 stop the spindle as well as the program; STOP halts the program.
fn stop(line: usize, word: &str, state: &mut MachineState) -> Result<(), Refusal> {
    if state.is_deep() {
        return Err(at_line(line, format!("the program stops ({word}) below the upper face")));
    }
    if ["STOP", "M0"].contains(&word) {
        state.readiness.stops();
    }
    if word != "STOP" && state.spindle != Spindle::Unstated {
        state.spindle = Spindle::Stopped;
        state.readiness.spindle_turns(false);
        state.cutting.spindle = state.spindle.at(state.cutting.speed);
    }
    Ok(())
}

/// Cycle 32 with its tolerance, cycle 7 with shifts of 0, and those of frames that end.
fn cycle_definition(line: usize, (cycle, rest): (&str, &[&str]), state: &mut MachineState) -> Result<(), Refusal> {
    match cycle {
        // Its second line states the tolerance; without that line there is none.
        "32.0" => state.path_mode.keeps_within(line, None),
        _ if cycle.starts_with("32.1") => path_tolerance(line, (cycle, rest), state)?,
        _ if cycle.starts_with("7.") => state.readiness.shift_is_ended(),
        _ => {}
    }
    Ok(())
}

/// `CYCL DEF 32.1 T0.01`, also without the blank; 0 is the tolerance of the machine builder, as none is.
fn path_tolerance(line: usize, (cycle, rest): (&str, &[&str]), state: &mut MachineState) -> Result<(), Refusal> {
    let words = cycle.trim_start_matches("32.1").to_owned() + &rest.concat();
    let tolerance = words.strip_prefix('T').map(|tolerance| number(line, tolerance)).transpose()?;
    if tolerance.is_some_and(|tolerance| tolerance < 0.0) {
        return Err(at_line(line, "the tolerance of cycle 32 is below 0"));
    }
    let tolerance = tolerance.filter(|tolerance| *tolerance > 0.0);
    let scale = state.scale();
    state.path_mode.keeps_within(line, tolerance.map(|tolerance| scale * tolerance));
    state.readiness.path_mode(&state.path_mode);
    Ok(())
}

fn centre_of(line: usize, words: &[&str]) -> Result<Vector2<f64>, Refusal> {
    let [x, y] = words else { return Err(at_line(line, "a centre has X and Y")) };
    match (x.strip_prefix('X'), y.strip_prefix('Y')) {
        (Some(x), Some(y)) => Ok(Vector2::new(number(line, x)?, number(line, y)?)),
        _ => Err(at_line(line, "a centre has X and Y")),
    }
}

/// The coordinates of a block, and whether it turns left where it says so; feed and side of the cutter go to the state.
#[expect(clippy::type_complexity, reason = "what a block says")]
fn coordinates(
    line: usize,
    words: &[&str],
    state: &mut MachineState,
) -> Result<([Option<f64>; 3], Option<bool>, bool), Refusal> {
    let (mut to, mut left, mut rapid) = ([None; 3], None, false);
    for word in words {
        let axis = ["X", "Y", "Z"].iter().position(|axis| word.starts_with(axis));
        match (*word, axis) {
            ("R0", _) => {
                state.side = CutterSide::Centre;
                state.readiness.side_is_stated();
            }
            ("RL" | "RR", _) => {
                if let Some(why) = state.radius_fault {
                    return Err(at_line(line, format!("the cutter is to be kept beside its path, and {why}")));
                }
                state.side = if *word == "RL" { CutterSide::Left } else { CutterSide::Right };
                state.readiness.side_is_stated();
            }
            ("DR+", _) => left = Some(true),
            ("DR-", _) => left = Some(false),
            ("FMAX", _) => rapid = true,
            ("F", _) if words.contains(&"MAX") => rapid = true,
            ("MAX", _) if words.contains(&"F") => {}
            ("F", _) if words.contains(&"AUTO") => {}
            ("FAUTO" | "AUTO", _) => {
                let missing = || at_line(line, "F AUTO takes the feed of TOOL CALL, which gives none");
                state.feed = Some(state.called_feed.ok_or_else(missing)?);
            }
            ("M3" | "M4" | "M5" | "M13" | "M14", _) => turn(line, word, state)?,
            ("M7" | "M8" | "M9" | "M2" | "M30", _) => {}
            // M120 may skip parts of the profile that the cutter does not fit; LA is its number of look-ahead blocks.
            ("M120", _) => state.leaves_out = true,
            (word, _) if words.contains(&"M120") && word.starts_with("LA") => {}
            (word, Some(axis)) => {
                let value = state.scale() * number(line, word.get(1..).unwrap_or_default())?;
                if let Some(own) = to.get_mut(axis) {
                    *own = Some(value);
                }
            }
            (word, None) => match word.strip_prefix('F') {
                Some(word) => state.feed = Some(feed(state, number(line, word)?)),
                None => return Err(at_line(line, format!("`{word}` is not known"))),
            },
        }
    }
    Ok((to, left, rapid))
}

/// `L Z-1 R0 FMAX M91` goes to a place of the machine, `L M140 MB MAX` upwards.
fn to_the_machine(line: usize, words: &[&str], state: &mut MachineState) -> Result<(), Refusal> {
    if state.side != CutterSide::Centre {
        return Err(at_line(line, "the cutter leaves for a place of the machine while it is kept beside its path"));
    }
    let other = |word: &&str| !(PLACES.contains(word) || *word == "MAX" || word.starts_with("MB"));
    let words_of_move: Vec<&str> = words.iter().copied().filter(other).collect();
    let (to, left, _) = coordinates(line, &words_of_move, state)?;
    let (axes, upwards) = (to.map(|axis| axis.is_some()), words.contains(&"M140"));
    if upwards && !(words.contains(&"MBMAX") || words.windows(2).any(|pair| pair == ["MB", "MAX"])) {
        let what = "M140 rises by a length from a height that is not known";
        return Err(at_line(line, what).remedy("write L M140 MB MAX"));
    }
    if let Some(z) = to[2].filter(|_| !upwards) {
        state.retracts_to(line, z);
    }
    if left.is_some() || state.side != CutterSide::Centre || (upwards && axes != [false; 3]) {
        return Err(at_line(line, "M91, M92 and M140 stand in a block with more than the place to leave for"));
    }
    let axes = if upwards { [false, false, true] } else { axes };
    let knows_height = state.knows_height();
    state.readiness.leaves(line, axes, knows_height);
    state.leave(line, axes)
}

fn straight(line: usize, words: &[&str], state: &mut MachineState) -> Result<(), Refusal> {
    if words.iter().any(|word| PLACES.contains(word)) {
        return to_the_machine(line, words, state);
    }
    let (to, left, rapid) = coordinates(line, words, state)?;
    if left.is_some() {
        return Err(at_line(line, "a straight line does not turn (DR)"));
    }
    // Such as `L M3`.
    if to == [None; 3] {
        return Ok(());
    }
    state.go(line, if rapid { MoveKind::Rapid } else { MoveKind::Line }, to)
}

fn round(line: usize, words: &[&str], centre: Option<Vector2<f64>>, state: &mut MachineState) -> Result<(), Refusal> {
    let (to, left, rapid) = coordinates(line, words, state)?;
    match (centre, left) {
        (Some(centre), Some(left)) if !rapid => state.go(line, MoveKind::Arc { centre, left }, to),
        (None, _) => Err(at_line(line, "an arc has no centre (CC)")),
        (_, None) => Err(at_line(line, "an arc does not say how it turns (DR+ or DR-)")),
        _ => Err(at_line(line, "an arc is to be run at FMAX")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(body: &str) -> Result<CutterProgram, Refusal> {
        read(&format!(
            "0 BEGIN PGM CAM MM\n1 L Z+5 R0 FMAX\n2 L X+10 Y+0 R0 FMAX\n3 L Z-2 F100\n{body}\n9 END PGM CAM MM\n"
        ))
    }

    #[test]
    fn a_dialogue_is_read_as_a_control_reads_it() {
        let read = program("4 CC X+0 Y+0\n5 C X-10 Y+0 DR+\n6 C X+10 Y+0 DR+ ; back\n7 L Z+5 FMAX").expect("a program");
        let turned: f64 =
            read.moves[1..3].iter().flat_map(super::super::CutterMove::segments).map(|arc| arc.sweep()).sum();
        assert!((turned - std::f64::consts::TAU).abs() < 1e-12, "{read:?}");
        let cases = [
            ("4 C X-10 Y+0 DR+", "no centre"),
            ("4 CC X+0 Y+1\n5 C X-10 Y+0", "DR"),
            ("4 CC X+0 Y+1\n5 C X-10 Y+0.3 DR+", "circle"),
            ("4 L IX+10", "IX+10"),
            ("4 CT X+10 Y+3", "not known"),
        ];
        for (body, expected) in cases {
            assert!(program(body).is_err_and(|why| why.to_string().contains(expected)), "{body}");
        }
        for (body, expected) in [
            ("4 L Z+5 FMAX\n5 TOOL CALL 1 Z S3000 DR+0.05\n6 L X+9 RL F9", "(DR)"),
            ("4 L Z+5 FMAX\n5 TOOL CALL 0 Z\n6 L X+9 RR", "TOOL CALL 0"),
            ("4 L Z+5 FMAX\n5 TOOL CALL 1 Z DL+0.2", "(DL)"),
            ("4 L Z+5 FMAX\n5 TOOL CALL 1 X", "axis"),
            ("4 TOOL CALL 5 Z", "tool changes"),
            ("4 L X+9 M5", "spindle"),
            ("4 M30\n5 L X+9", "behind it"),
            ("4 CYCL DEF 10.1 ROT+35", "turns the profile"),
            ("4 L X+9 F0", "at 0 mm/min"),
            ("4 L X+9 F-4", "-4 mm/min"),
            ("4 L X+9 F1e9", "1000000000 mm/min"),
        ] {
            let found = program(body).expect_err(body).to_string();
            assert!(found.contains(expected) && found.contains("line"), "{body}: {found}");
        }
        assert!(program("4 L X+9").is_err_and(|why| why.to_string().contains("ends with the tool")));
        assert!(program("4 L Z+5 FMAX\n5 TOOL CALL 1 Z S3000 F9 DR+0 DL+0\n6 L X+9 RL\n7 L X+12 R0").is_ok());
        // The centre is on the path: its radius is not asked for.
        assert!(
            program("4 L Z+5 FMAX\n4 TOOL CALL 1 Z DR-0.1\n5 CYCL DEF 7.0 DATUM SHIFT\n6 CYCL DEF 7.1 X+0\n7 L X+9")
                .is_ok()
        );
        let inches = super::read(
            "0 BEGIN PGM CAM INCH\n1 L Z+1 R0 FMAX\n2 L X+1 Y+0 R0 FMAX\n3 L Z-0.1 F40\n4 CC X+0 Y+0\n5 C X-1 Y+0 DR+\n6 L Z+1 FMAX\n6 END PGM CAM INCH\n",
        );
        let moves = inches.expect("a program in inches").moves;
        assert_eq!(moves.get(1).map(|moved| (moved.to, moved.from[0])), Some(([-25.4, 0.0, -2.54], 25.4)));
        assert!(super::read("0 BEGIN PGM CAM INCH\n1 END PGM CAM MM\n").is_err());
        assert!(super::read("0 BEGIN PGM CAM ELL\n1 END PGM CAM ELL\n").is_err());
        assert!(super::read("0 BEGIN PGM CAM MM\n").is_err());
    }
}
