//! Whether a program cuts with what its design says: the tool and the radius that the control takes, the spindle, the feeds, and how exactly the control keeps to
//! its path.

use super::super::read::{CutterProgram, CuttingState, Spindle, ToolLength, TurnedPass};
use super::program::{ProgramFault, WrittenProgram};
use super::safe_start::early_move;
use crate::machine::{Controller, CuttingData};
use crate::report::shown;
use crate::verify::Evidence;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{Length, Text, text};

/// Depths that differ by less are equal, mm: numbers of three decimals, and of four in inches, are off by less.
pub(super) const SAME_DEPTH: f64 = 1.3e-3;
/// Seconds in a minute.
const MINUTE: f64 = 60.0;
/// A feed so many times that of its design is refused, and a speed of the spindle that is so many times higher or lower, but for rounding, mm/min: a shop sets its own, and a time that was taken for a feed is far off.
const FASTER: f64 = 2.0;
const ROUNDED: f64 = 0.03;
/// A tolerance of the path so many times that of the cam is refused. Up to it, as shops give it to all their programs, it is told.
const TOO_FREE: f64 = 10.0;
/// Tolerances that differ by less are equal, as a share.
const SAME: f64 = 1e-6;

/// Refuses a program that cuts with something else.
pub(super) fn as_designed(evidence: &Evidence<'_>, written: &WrittenProgram) -> Result<(), ProgramFault> {
    let Ok(program) = &written.program else { return Ok(()) };
    let design = evidence.body.machine().cutting();
    for (line, tolerance) in &program.path_tolerances {
        if *tolerance > TOO_FREE * evidence.tolerance_mm * (1.0 + SAME) {
            if tolerance.is_infinite() {
                let write = match program.control {
                    Some(Controller::Sinumerik) => "CTOL with a value, or G60",
                    _ => "G64 P with a value, or G61",
                };
                let why = format!("line {line} lets the control leave its path without a bound: write {write}");
                return Err(ProgramFault::new(why));
            }
            let (tolerance, most) = (shown(*tolerance), shown(evidence.tolerance_mm));
            let why = format!("line {line} lets the control leave its path by {tolerance} mm, more than {most} mm");
            return Err(ProgramFault::new(why));
        }
    }
    for (line, state) in &program.states {
        let fault = wrong_tool(&design, program, state)
            .or_else(|| wrong_length(&design, program, state))
            .or_else(|| wrong_spindle(&design, state));
        if let Some(fault) = fault {
            return Err(ProgramFault::new(format!("in line {line} {fault}")));
        }
    }
    if let Some(why) = early_move(program)
        .or_else(|| wrong_length_of_a_move(&design, program))
        .or_else(|| too_low_a_home(&design, program))
    {
        return Err(ProgramFault::new(why));
    }
    feeds(evidence, &design, program)
}

/// No pass may go deeper below the one before on its flank than the design allows.
pub(super) fn not_too_deep_at_once(
    evidence: &Evidence<'_>,
    line: usize,
    (before, depth): (f64, f64),
) -> Result<(), ProgramFault> {
    let most = evidence.body.machine().cutting().depth_per_pass.map_or(f64::INFINITY, |most| MILLIMETRES * most);
    if depth - before <= most + SAME_DEPTH {
        return Ok(());
    }
    let (by, most) = (shown(depth - before), shown(most));
    let what = format!("the pass from line {line} on cuts {by} mm at once, more than cut.depth_per_pass of {most} mm");
    Err(ProgramFault::new(what))
}

/// What is to be known of a program whose control may leave its path by more than the tolerance, for a note.
pub(super) fn leaves_its_path(program: &CutterProgram, tolerance_mm: f64) -> Text {
    let widest =
        program.path_tolerances.iter().copied().reduce(|widest, next| if next.1 > widest.1 { next } else { widest });
    widest.filter(|(_, tolerance)| *tolerance > tolerance_mm * (1.0 + SAME)).map_or_else(
        Text::default,
        |(line, tolerance)| {
            text!(
                "; line {} lets the control leave its path by {}, more than the tolerance",
                line,
                Length::mm(tolerance)
            )
        },
    )
}

/// What is wrong with a tool, or with the number of its radius.
fn wrong_tool(design: &CuttingData, program: &CutterProgram, state: &CuttingState) -> Option<String> {
    let first = program.states.iter().find(|(_, other)| other.compensated).map_or(state, |(_, first)| first);
    // grbl has no tool change: the operator loads the tool.
    let is_changed = program.control != Some(Controller::Grbl);
    let wanted = design.tool.filter(|_| is_changed).or(first.tool.filter(|_| state.compensated));
    if !state.named && state.tool != wanted && ((design.tool.is_some() && is_changed) || state.compensated) {
        let wanted = wanted.map_or_else(|| "the one before".to_owned(), |tool| format!("tool {tool}"));
        return Some(match state.tool {
            None => format!("the cutter cuts, and {wanted} was not changed in"),
            Some(tool) => format!("tool {tool} cuts; it must be {wanted}"),
        });
    }
    if !state.compensated {
        return None;
    }
    // Without a number LinuxCNC takes the tool in the spindle, SINUMERIK its first edge. On FANUC the program numbers its radii as its tools.
    let wanted = match (program.control, design.tool) {
        (Some(Controller::Heidenhain), _) => None,
        (Some(Controller::Sinumerik), Some(_)) => Some(1),
        (_, Some(tool)) => Some(tool),
        (Some(Controller::LinuxCnc), None) => state.tool.or(first.offset),
        (_, None) => first.offset,
    }?;
    let offset = state.offset?;
    (offset != wanted).then(|| format!("the control takes the radius D{offset}; it must be D{wanted}"))
}

/// What is wrong with the length of the tool: by another the cutter goes down to another depth.
fn wrong_length(design: &CuttingData, program: &CutterProgram, state: &CuttingState) -> Option<String> {
    let letter = if program.control == Some(Controller::Sinumerik) { 'D' } else { 'H' };
    // That of the tool by its number, of its first edge on SINUMERIK, or else the one of the cuts before.
    let known = match (program.control, design.tool) {
        (Some(Controller::Sinumerik), Some(_)) => Some(1),
        (Some(Controller::LinuxCnc), None) => state.tool,
        (_, tool) => tool,
    };
    let before = program.states.iter().find(|(_, other)| other.tool == state.tool).map(|(_, first)| first.length);
    match (state.length, known.map(ToolLength::Number).or(before)?) {
        (ToolLength::Cancelled, _) => Some(
            "the cutter cuts without the length of its tool (G49, H0, D0, or a change of the tool without G43)"
                .to_owned(),
        ),
        (ToolLength::Number(_), _) if before == Some(ToolLength::Unstated) => {
            Some("the control takes the length of the tool (G43), and did not for the cuts before".to_owned())
        }
        (ToolLength::Number(number), wanted @ ToolLength::Number(other)) if wanted != state.length => {
            Some(format!("the control takes the length {letter}{number} of the tool; it must be {letter}{other}"))
        }
        (ToolLength::Unstated | ToolLength::Number(_), _) => None,
    }
}

/// A move along Z, also above the part, with the length of another tool than that which cuts.
fn wrong_length_of_a_move(design: &CuttingData, program: &CutterProgram) -> Option<String> {
    let cuts = program.states.first().map(|(_, state)| (state.tool, state.length));
    let wanted = match (program.control, design.tool, cuts) {
        (Some(Controller::Sinumerik), Some(_), _) => 1,
        (_, Some(tool), _) | (Some(Controller::LinuxCnc), None, Some((Some(tool), _))) => tool,
        (_, None, Some((_, ToolLength::Number(number)))) => number,
        _ => return None,
    };
    let letter = if program.control == Some(Controller::Sinumerik) { 'D' } else { 'H' };
    program.lengths.iter().find_map(|(line, length)| match length {
        ToolLength::Number(number) if *number != wanted => Some(format!(
            "line {line} moves Z with the length {letter}{number} of the tool; it must be {letter}{wanted}"
        )),
        _ => None,
    })
}

/// A retract below the height that the design states as clear of the part.
fn too_low_a_home(design: &CuttingData, program: &CutterProgram) -> Option<String> {
    let ((line, z), home) = program.lowest_home.zip(design.home.map(|home| MILLIMETRES * home))?;
    (z < home - SAME_DEPTH).then(|| {
        format!("line {line} retracts Z to {} mm of the machine, below cut.home of {} mm", shown(z), shown(home))
    })
}

/// What is wrong with the spindle.
fn wrong_spindle(design: &CuttingData, state: &CuttingState) -> Option<String> {
    if let Some((speed, wanted)) = state.speed.zip(design.spindle).filter(|_| state.spindle == Spindle::Clockwise)
        && !(wanted / FASTER..=wanted * FASTER).contains(&speed)
    {
        let (speed, wanted) = (shown(speed), shown(wanted));
        return Some(format!("the spindle turns at {speed} 1/min, and cut.spindle is {wanted} 1/min"));
    }
    match state.spindle {
        Spindle::Stopped => Some("the cutter cuts with a spindle that stands (M5, S0, or M6 after M3)".to_owned()),
        Spindle::CounterClockwise => {
            Some("the spindle turns counter-clockwise (M4); it must turn clockwise (M3)".to_owned())
        }
        Spindle::Unstated if design.spindle.is_some() => {
            Some("the cutter cuts, and the spindle was not started with a speed (S, M3)".to_owned())
        }
        Spindle::Unstated | Spindle::Clockwise => None,
    }
}

/// No cut may be faster than the feeds of the design.
fn feeds(evidence: &Evidence<'_>, design: &CuttingData, program: &CutterProgram) -> Result<(), ProgramFault> {
    let refused = |line: usize, feed: f64, (most, key): (f64, &str)| {
        let most = MINUTE * MILLIMETRES * most;
        if feed <= FASTER * most + ROUNDED {
            return Ok(());
        }
        let (feed, most) = (shown(feed), shown(most));
        Err(ProgramFault::new(format!(
            "line {line} cuts at {feed} mm/min, more than twice as fast as cut.{key} of {most} mm/min"
        )))
    };
    let along = (design.feed, "feed");
    for cut in &program.feeds {
        refused(cut.line, cut.feed, if cut.plunges { (design.plunge_feed, "plunge_feed") } else { along })?;
    }
    let around = evidence.body.swept().and_then(|swept| swept.turned().ok()).map(|cam| MILLIMETRES * cam.outside());
    for pass in &program.turned {
        for (pair, (line, rate)) in pass.rows.windows(2).zip(&pass.rates) {
            refused(*line, rate * length(pass, pair, around), along)?;
        }
    }
    Ok(())
}

/// The length of a row on the cam, mm: on the outside of a barrel, or on a spiral about the axis of a disc.
fn length(pass: &TurnedPass, pair: &[[f64; 3]], around: Option<f64>) -> f64 {
    let &[from, to] = pair else { return 0.0 };
    let radius = around.filter(|_| pass.axis == 'A').unwrap_or(0.5 * (from[1] + to[1]));
    let turned = radius * (to[0] - from[0]).to_radians();
    libm::hypot(turned, libm::hypot(to[1] - from[1], to[2] - from[2]))
}
