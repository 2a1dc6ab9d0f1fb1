//! Finds moves that rely on words not yet stated. A control keeps words of the previous program, so each group of words is unknown until stated.
//! For each group the first move that needs it is recorded; `safe_start` decides which of them are refused and which only reported.

use super::dialect::ends_frames;
use super::path_mode::PathMode;
use super::words::Word;
use crate::machine::Controller;

/// A statement that a move needs and the program has not made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unstated {
    /// Radius compensation: G40, R0.
    Compensation,
    /// Feed per minute: G94.
    FeedMode,
    /// Arc centres relative to the start: G91.1.
    Centres,
    /// The tool length: G43 H, D, TOOL CALL, or a stop for the operator.
    Length,
    /// The length of a tool that the program has changed in or whose length it has cancelled: G43 H, D.
    LengthOfChanged,
    /// The datum: G54.
    Datum,
    /// The path mode: G61, G64, G642.
    PathMode,
    /// No shift of the datum: G92.2, TRANS, cycle 7.
    Shift,
    /// A turning spindle: S, M3.
    Spindle,
    /// The tool height, before a move across the part.
    Height,
    /// X and Y, before the tool goes down.
    Place,
    /// The axes of a move to the reference point (G28): without any, all axes move.
    Axes,
    /// Incremental coordinates (G91) for a move to the reference point, which passes through its programmed point.
    WayToReference,
    /// Rapid motion (G0) for a move in machine coordinates.
    Motion,
    /// Absolute coordinates (G90) for a move in machine coordinates, which FANUC ignores in G91.
    Absolute,
    /// A tool length of zero (D0) for a move in machine coordinates.
    NoLength,
}

/// Statements of a program so far.
#[derive(Debug, Default)]
pub(super) struct Readiness {
    control: Option<Controller>,
    compensation: bool,
    feed_mode: bool,
    centres: bool,
    datum: bool,
    path_mode: bool,
    shift: bool,
    spindle: bool,
    length: bool,
    absolute: Option<bool>,
    rapid: Option<bool>,
    /// Whether the program has changed the tool (`changes`), or stopped for the operator (`stopped`).
    changes: bool,
    stopped: bool,
    /// Whether a tool length was in effect and is cancelled (`lost`), G43 is active (`adds`), SINUMERIK has a D number (`edge`).
    lost: bool,
    adds: bool,
    edge: bool,
    /// Whether the tool is retracted in machine coordinates.
    retracted: bool,
    /// Whether the program sets up tool, datum or height itself.
    sets_up: bool,
    early: Vec<(usize, Unstated)>,
}

/// A move in part coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct PartMove {
    pub(super) line: usize,
    pub(super) rapid: bool,
    pub(super) arc: bool,
    /// Whether X and Y (`knew_place`) and Z (`knew_height`) were known before the move; without X and Y, Z may go down anywhere.
    pub(super) knew_place: bool,
    pub(super) knew_height: bool,
    /// Whether it moves in the plane or rotates the part (`across`), along Z, and downwards.
    pub(super) across: bool,
    pub(super) along_z: bool,
    pub(super) down: bool,
    /// Whether it cuts below the top face.
    pub(super) cuts: bool,
}

impl Readiness {
    pub(super) fn of(control: Option<Controller>) -> Self {
        // Klartext has feed per minute, absolute arc centres, and the datum activated by the operator.
        let dialogue = control == Some(Controller::Heidenhain);
        let centres = !matches!(control, Some(Controller::LinuxCnc | Controller::Mach3));
        // FANUC and others have no word that ends every shift.
        let shift = matches!(control, Some(Controller::Fanuc) | None);
        // grbl keeps its path exactly, and has no tool lengths: Z0 of the datum is that of the tool.
        let grbl = control == Some(Controller::Grbl);
        let (path_mode, length) = (grbl, grbl);
        Self { control, feed_mode: dialogue, centres, datum: dialogue, shift, path_mode, length, ..Self::default() }
    }

    /// The first moves that came too early, and whether the program sets up tool, datum or height itself.
    pub(super) fn found(self) -> (Vec<(usize, Unstated)>, bool) {
        (self.early, self.sets_up)
    }

    /// Records the statements of a block of words, before its move.
    pub(super) fn block(&mut self, words: &[Word]) {
        let sinumerik = self.control == Some(Controller::Sinumerik);
        let value = |letter: char| words.iter().find(|word| word.0 == letter).map(|word| word.1);
        if words.contains(&('M', 6.0)) {
            self.tool_changes();
        }
        if sinumerik && value('T').is_some() {
            (self.changes, self.sets_up) = (true, true);
        }
        self.stopped |= words.contains(&('M', 0.0));
        for (_, code) in words.iter().filter(|word| word.0 == 'G') {
            self.code(*code);
        }
        let edge = value('D').filter(|_| sinumerik);
        self.edge |= edge.is_some();
        // The length is unknown if neither program nor operator chose the tool.
        let named = self.changes || self.stopped;
        let (takes, ends) = (words.contains(&('G', 43.0)), words.contains(&('G', 49.0)));
        let taken = match self.control {
            Some(Controller::Sinumerik) => edge.map(|edge| edge > 0.0 && named),
            // H is modal on FANUC, and so is G43 for another H.
            Some(Controller::Fanuc) => (takes || (self.adds && value('H').is_some())).then(|| value('H') != Some(0.0)),
            _ => takes.then(|| value('H').map_or(named, |number| number > 0.0)),
        };
        self.adds = takes || (self.adds && !ends);
        let stays = self.length && (!ends || self.control == Some(Controller::Grbl));
        self.length = taken.unwrap_or(stays);
        self.sets_up |= taken == Some(true);
        let turns = words.contains(&('M', 3.0)) || words.contains(&('M', 4.0));
        self.spindle = turns || (self.spindle && !words.contains(&('M', 5.0)));
    }

    fn code(&mut self, code: f64) {
        let sinumerik = self.control == Some(Controller::Sinumerik);
        let is = |codes: &[f64]| codes.iter().any(|own| (own - code).abs() < 1e-6);
        self.compensation |= is(&[40.0, 41.0, 42.0]);
        self.feed_mode |= is(&[93.0, 94.0, 95.0]);
        self.centres |= is(&[90.1, 91.1]);
        if is(&[0.0, 1.0, 2.0, 3.0]) {
            self.rapid = Some(is(&[0.0]));
        }
        if is(&[90.0, 91.0]) {
            self.absolute = Some(is(&[90.0]));
        }
        if (54.0..60.0).contains(&code) || (sinumerik && (500.0..600.0).contains(&code)) {
            // G500 switches the datum off.
            (self.datum, self.sets_up) = (code != 500.0, true);
        }
        self.shift |= is(&[92.1, 92.2]);
        self.path_mode |=
            is(&[61.0, 61.1, 62.0, 64.0]) || (sinumerik && (is(&[60.0]) || (641.0..646.0).contains(&code)));
    }

    /// A tool change: M6, TOOL CALL.
    pub(super) fn tool_changes(&mut self) {
        (self.changes, self.sets_up) = (true, true);
        // In Klartext, TOOL CALL activates the tool length.
        self.length = self.control == Some(Controller::Heidenhain);
        (self.spindle, self.stopped, self.lost) = (false, false, false);
    }

    /// The program stops for the operator: M0, STOP.
    pub(super) fn stops(&mut self) {
        self.stopped = true;
    }

    /// R0, RL or RR.
    pub(super) fn side_is_stated(&mut self) {
        self.compensation = true;
    }

    /// The path mode by CYCLE832, CTOL, cycle 32.
    pub(super) fn path_mode(&mut self, mode: &PathMode) {
        self.path_mode |= mode.is_stated();
    }

    /// A block that may end the frames of SINUMERIK.
    pub(super) fn frames(&mut self, block: &str) {
        self.shift |= ends_frames(block);
    }

    /// Cycle 7 of HEIDENHAIN with shifts of 0.
    pub(super) fn shift_is_ended(&mut self) {
        self.shift = true;
    }

    /// M3, M4, M5 in Klartext.
    pub(super) fn spindle_turns(&mut self, turns: bool) {
        self.spindle = turns;
    }

    fn lacks(&mut self, line: usize, unless: bool, what: Unstated) {
        if !unless && !self.early.iter().any(|(_, known)| *known == what) {
            self.early.push((line, what));
        }
    }

    /// A move to a reference point (G28, G30) through its programmed point, or in machine coordinates (G53).
    pub(super) fn leaves_by(&mut self, line: usize, (axes, words): ([bool; 3], &[Word]), knows_height: bool) {
        if words.contains(&('G', 53.0)) {
            self.lacks(line, self.rapid == Some(true), Unstated::Motion);
            let fanuc = self.control == Some(Controller::Fanuc);
            self.lacks(line, !fanuc || self.absolute == Some(true), Unstated::Absolute);
            let sinumerik = self.control == Some(Controller::Sinumerik);
            self.lacks(line, !(sinumerik && axes[2]) || self.edge, Unstated::NoLength);
        } else {
            self.lacks(line, axes != [false; 3], Unstated::Axes);
            let dives = words.iter().any(|(letter, number)| *letter == 'Z' && *number < 0.0);
            self.lacks(line, self.absolute == Some(false) && !dives, Unstated::WayToReference);
        }
        self.leaves(line, axes, knows_height);
    }

    /// A move to a machine position along these axes.
    pub(super) fn leaves(&mut self, line: usize, axes: [bool; 3], knows_height: bool) {
        self.sets_up = true;
        self.lacks(line, !(axes[0] || axes[1]) || knows_height || self.retracted, Unstated::Height);
        if axes[2] {
            self.retracted = true;
            if self.control == Some(Controller::Fanuc) {
                // FANUC still shows G43, but has cancelled the length.
                self.lost |= self.length || self.stopped;
                self.length = false;
            }
        }
    }

    /// A move in part coordinates.
    pub(super) fn moves(&mut self, moved: PartMove) {
        let line = moved.line;
        self.lacks(line, self.compensation, Unstated::Compensation);
        self.lacks(line, moved.rapid || self.feed_mode, Unstated::FeedMode);
        self.lacks(line, !moved.arc || self.centres, Unstated::Centres);
        self.lacks(line, self.datum, Unstated::Datum);
        self.lacks(line, moved.rapid || self.path_mode, Unstated::PathMode);
        let by_hand = self.stopped && !self.changes && !self.lost;
        if moved.along_z && !self.length && !by_hand {
            let own = self.changes || self.lost;
            self.lacks(line, false, if own { Unstated::LengthOfChanged } else { Unstated::Length });
        }
        let level = moved.knew_height || self.retracted;
        let slanted = moved.across && moved.along_z && (self.retracted || !moved.knew_height || moved.down);
        self.lacks(line, !moved.across || (level && !(moved.rapid && slanted)), Unstated::Height);
        self.lacks(line, !moved.along_z || moved.knew_place, Unstated::Place);
        self.lacks(line, !moved.cuts || self.spindle || self.stopped, Unstated::Spindle);
        self.lacks(line, self.shift, Unstated::Shift);
        self.retracted &= !moved.along_z;
    }
}
