//! Checks that a program states all words before the moves that rely on them: a control keeps words of the previous program.

use super::super::read::{CutterProgram, Unstated};
use crate::machine::{Controller, CuttingData};
use camgen_kernel::text::{Length, Text, text};

/// Lower than this, mm, Z of the machine is not at its top: programs for HEIDENHAIN retract to -1 mm.
const TOP: f64 = -1.01;

/// The first refused move: one that relies on a word not yet stated.
pub(super) fn early_move(program: &CutterProgram) -> Option<String> {
    let (line, what) = program.early.iter().find(|(_, what)| is_refused(program, *what))?;
    Some(format!("line {line} {}", fault(*what, program.control)))
}

/// Settings that the operator must make before the start, for a note.
pub(super) fn assumed(program: &CutterProgram) -> String {
    let wanted: Vec<&str> = program
        .early
        .iter()
        .filter(|(_, what)| !is_refused(program, *what))
        .map(|(_, what)| match what {
            Unstated::Length | Unstated::LengthOfChanged => "tool length",
            Unstated::Datum => "datum",
            Unstated::PathMode => "path mode",
            Unstated::Shift => "no shift of the datum",
            Unstated::Spindle => "spindle",
            _ => "position above the part",
        })
        .collect();
    let skips = if program.leaves_out {
        "; M120 lets the control leave out parts of the profile that its cutter does not fit"
    } else {
        ""
    };
    if wanted.is_empty() {
        skips.to_owned()
    } else {
        format!("; not stated, as set before the program: {}{skips}", wanted.join(", "))
    }
}

/// The height of the machine to which a program retracts, where the design states none and it is not the top; for a note.
pub(super) fn assumed_home(design: &CuttingData, program: &CutterProgram) -> Text {
    match program.lowest_home.filter(|(_, z)| design.home.is_none() && *z < TOP) {
        Some((_, z)) => {
            text!("; Z {} of the machine is taken as clear of the part: cut.home is not given", Length::mm(z))
        }
        None => Text::default(),
    }
}

/// If a program sets up neither tool, datum nor height, the operator has; if it sets up one of them, it must set up all. Only LinuxCNC, SINUMERIK
/// and Mach3 can deviate from the path without a bound.
fn is_refused(program: &CutterProgram, what: Unstated) -> bool {
    match what {
        Unstated::Length | Unstated::Datum | Unstated::Spindle | Unstated::Place => program.sets_up,
        Unstated::PathMode => {
            program.sets_up
                && matches!(program.control, Some(Controller::LinuxCnc | Controller::Sinumerik | Controller::Mach3))
        }
        Unstated::Shift => false,
        _ => true,
    }
}

/// The fault of a move, and its remedy.
fn fault(what: Unstated, control: Option<Controller>) -> &'static str {
    use Controller::{Fanuc, Heidenhain, Sinumerik};
    match (what, control) {
        (Unstated::Compensation, Some(Heidenhain)) => "moves before the radius compensation is stated: write R0",
        (Unstated::Compensation, _) => "moves before the radius compensation is stated: write G40",
        (Unstated::FeedMode, _) => "moves at a feed before the feed mode is stated: write G94",
        (Unstated::Centres, _) => "runs an arc before its centres are stated: write G91.1",
        (Unstated::Length, Some(Heidenhain)) => {
            "moves Z before the tool length is known: write TOOL CALL with its number, or STOP for the operator to call it"
        }
        (Unstated::Length, Some(Sinumerik)) => {
            "moves Z before the tool length is known: write T and M6, then D1, or M0 for the operator to load the tool, then D1"
        }
        (Unstated::Length, _) => {
            "moves Z before the tool length is known: write G43 with its H, or M0 for the operator to set it"
        }
        (Unstated::LengthOfChanged, Some(Sinumerik)) => {
            "moves Z after a tool change without the length of the new tool: write D1"
        }
        (Unstated::LengthOfChanged, Some(Fanuc)) => {
            "moves Z without the tool length, which a tool change (M6), G28, G53 or G49 has ended: write G43 with its H"
        }
        (Unstated::LengthOfChanged, _) => {
            "moves Z after a tool change, or G49, without the length of the tool: write G43 with its H"
        }
        (Unstated::Shift, _) => "moves before shifts of the datum are ended: write G92.2, TRANS or cycle 7",
        (Unstated::Datum, _) => "moves before the datum is stated: write G54",
        (Unstated::PathMode, Some(Sinumerik)) => "cuts before the path mode is stated: write G642 with CTOL, or G60",
        (Unstated::PathMode, _) => "cuts before the path mode is stated: write G61, or G64 P with a tolerance",
        (Unstated::Spindle, _) => {
            "cuts, and the spindle was not started: write S and M3, or M0 for the operator to start it"
        }
        (Unstated::Height, _) => {
            "moves across the part at a height that is not known, or goes down as it does: retract Z in machine coordinates first, then move X and Y, then Z"
        }
        (Unstated::Place, _) => "moves Z before X and Y are known: move X and Y first, at a height of the machine",
        (Unstated::Axes, _) => "goes to the reference point in all axes at once (G28): write G91 G28 Z0",
        (Unstated::WayToReference, _) => {
            "goes to the reference point by coordinates of the part, or down: write G91 G28 Z0"
        }
        (Unstated::Motion, _) => "moves in machine coordinates, and not stated how: write G0 with it",
        (Unstated::Absolute, _) => "moves in machine coordinates, which FANUC leaves out unless in G90: write G90",
        (Unstated::NoLength, _) => {
            "moves Z in machine coordinates with a tool length that is not known: write D0 with it"
        }
    }
}
