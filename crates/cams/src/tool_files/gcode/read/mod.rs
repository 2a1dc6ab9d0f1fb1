//! Reads a program for a milling machine as its control would: what each block makes the cutter do, with everything that is modal.
//!
//! It shares nothing with `write`: words are split, the modal state is kept, and an arc is found from its ends and its centre. A block
//! that it does not know is passed over before the first move, where the shop's own lines stand, and refused after it.

mod cutting_state;
mod dialect;
mod iso;
mod klartext;
mod machine_state;
mod modal;
mod path_mode;
mod readiness;
mod tool_length;
mod turned;
mod words;

pub use cutting_state::{CuttingFeed, CuttingState, Spindle, ToolLength};
pub use readiness::Unstated;
pub use turned::{StandingMove, TurnedPass};

use crate::machine::Controller;
use camgen_kernel::geometry::contour::Segment;
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;
use std::borrow::Cow;
use std::f64::consts::{PI, TAU};

/// Largest program, bytes, and the most moves of one.
pub const LARGEST_PROGRAM: usize = 1 << 26;
const MOST_MOVES: usize = 1_000_000;
/// Radii of an arc to its two ends may differ by so much, mm: LinuxCNC's limit, the least of the controls.
const RADII: f64 = 0.005;
/// Fastest feed, mm/min.
const FASTEST: f64 = 600_000.0;
/// Steps of rounding below which a move is none, mm.
const NO_MOVE: f64 = 1e-9;
/// An arc beyond this is divided in two, rad.
const LONG_ARC: f64 = 1.2 * PI;

/// On which side of its path the control keeps the cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CutterSide {
    /// Its centre is on the path: G40, R0.
    #[default]
    Centre,
    /// On the left: G41, RL.
    Left,
    /// On the right: G42, RR.
    Right,
}

/// How a cutter moves to a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MoveKind {
    /// As fast as it can, on no particular path.
    Rapid,
    /// In a straight line.
    Line,
    /// On an arc about a centre, mm, to the left or to the right.
    Arc {
        /// The centre.
        centre: Vector2<f64>,
        /// Whether it turns left.
        left: bool,
    },
}

/// A move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutterMove {
    /// Line of the file, from 1.
    pub line: usize,
    /// How it moves.
    pub kind: MoveKind,
    /// From here, mm.
    pub from: [f64; 3],
    /// To here, mm.
    pub to: [f64; 3],
    /// The side of the cutter during it.
    pub side: CutterSide,
}

impl CutterMove {
    /// Its start in the plane, mm.
    #[must_use]
    pub fn start(&self) -> Vector2<f64> {
        Vector2::new(self.from[0], self.from[1])
    }

    /// Its end in the plane, mm.
    #[must_use]
    pub fn end(&self) -> Vector2<f64> {
        Vector2::new(self.to[0], self.to[1])
    }

    /// Whether it stays where it is in the plane.
    #[must_use]
    pub fn is_upright(&self) -> bool {
        (self.end() - self.start()).norm() < NO_MOVE && !matches!(self.kind, MoveKind::Arc { .. })
    }

    /// Whether it stays at its depth.
    #[must_use]
    pub fn is_level(&self) -> bool {
        (self.to[2] - self.from[2]).abs() < NO_MOVE
    }

    /// Its path in the plane: an arc through both ends with the angle that it turns about its centre, one of nearly a turn in two.
    #[must_use]
    pub fn segments(&self) -> Vec<Segment> {
        let (start, end) = (self.start(), self.end());
        let MoveKind::Arc { centre, left } = self.kind else { return vec![Segment { start, end, bulge: 0.0 }] };
        let (from, to) = (start - centre, end - centre);
        let turn = libm::atan2(from.perp(&to), from.dot(&to));
        let sweep = match (left, turn) {
            (true, turn) if turn <= 0.0 => turn + TAU,
            (false, turn) if turn >= 0.0 => turn - TAU,
            (_, turn) => turn,
        };
        if sweep.abs() <= LONG_ARC {
            return vec![Segment { start, end, bulge: libm::tan(0.25 * sweep) }];
        }
        let (sin, cos) = libm::sincos(0.5 * sweep);
        let middle = centre + Vector2::new(cos * from.x - sin * from.y, sin * from.x + cos * from.y);
        let bulge = libm::tan(0.125 * sweep);
        vec![Segment { start, end: middle, bulge }, Segment { start: middle, end, bulge }]
    }

    /// By how much the radii to its ends differ, mm: how far the paths of controls that treat this differently lie apart.
    #[must_use]
    pub fn radii_differ(&self) -> f64 {
        match self.kind {
            MoveKind::Arc { centre, .. } => ((self.start() - centre).norm() - (self.end() - centre).norm()).abs(),
            MoveKind::Rapid | MoveKind::Line => 0.0,
        }
    }
}

/// A program as it was read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CutterProgram {
    /// Its moves.
    pub moves: Vec<CutterMove>,
    /// Blocks before the first move that were passed over.
    pub unknown: Vec<String>,
    /// The side of the cutter where it ends.
    pub side_at_end: CutterSide,
    /// Passes, in the place of moves, of a program that turns the cam under its tool.
    pub turned: Vec<TurnedPass>,
    /// The moves of such a program to its passes and away from them.
    pub standing: Vec<StandingMove>,
    /// The control, where it is known.
    pub control: Option<Controller>,
    /// With what it cuts, from a line on.
    pub states: Vec<(usize, CuttingState)>,
    /// The lengths of the tool with which it moves along Z, from a line on.
    pub lengths: Vec<(usize, ToolLength)>,
    /// The lowest Z of the machine to which it retracts, mm, with its line.
    pub lowest_home: Option<(usize, f64)>,
    /// Its feeds below the upper face, in the order of its moves, but for those of the rows of a pass of `turned`.
    pub feeds: Vec<CuttingFeed>,
    /// Tolerances of the control's path, mm, each after its line.
    pub path_tolerances: Vec<(usize, f64)>,
    /// For each kind of missing statement, the line of the first move that relies on it.
    pub early: Vec<(usize, Unstated)>,
    /// Whether it sets up tool, datum or height itself; if not, the operator has before the start.
    pub sets_up: bool,
    /// Whether the control may skip parts of the profile that its cutter does not fit (M120 of HEIDENHAIN).
    pub leaves_out: bool,
}

/// Whether bytes are a program: a dialogue begins with its name, other programs state in their head how their words are meant.
#[must_use]
pub fn is_program(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(bytes.get(..bytes.len().min(8192)).unwrap_or_default()).to_ascii_uppercase();
    let code = |line: &str| line.split(['(', ';']).next().unwrap_or_default().to_owned();
    let lines: Vec<String> = head.lines().map(code).collect();
    // Words may stand without blanks between them.
    let states = |words: &[&str]| lines.iter().any(|line| words.iter().any(|word| dialect::has_word(line, word)));
    let stated = [&["G17"][..], &["G90"], &["G20", "G21", "G70", "G71", "G700", "G710"], &["G0", "G00", "G1", "G01"]];
    head.contains("BEGIN PGM") || stated.iter().filter(|words| states(words)).count() >= 2
}

/// Reads a program.
///
/// # Errors
/// [`Refusal`] with the line, when a block is unknown, or would move the cutter otherwise than its words say.
pub fn read(bytes: &[u8]) -> Result<CutterProgram, Refusal> {
    read_for(bytes, None)
}

/// As [`read`], for the control of its design where its head does not say for which one it is.
///
/// # Errors
/// As [`read`].
pub fn read_for(bytes: &[u8], design: Option<Controller>) -> Result<CutterProgram, Refusal> {
    if bytes.len() > LARGEST_PROGRAM {
        return Err(Refusal::new(format!("the program has more than {LARGEST_PROGRAM} bytes")));
    }
    // What is not UTF-8 is Latin-1: its letters beyond ASCII may stand in comments.
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) if bytes.contains(&0) => return Err(Refusal::new("the program has characters that no control reads")),
        Err(_) => Cow::Owned(bytes.iter().copied().map(char::from).collect()),
    };
    let text = text.as_ref();
    if text.to_ascii_uppercase().contains("BEGIN PGM") {
        klartext::read(text)
    } else if let Some(axis) = turned::axis_of(text) {
        turned::read(text, axis, design)
    } else {
        iso::read(text, design)
    }
}
