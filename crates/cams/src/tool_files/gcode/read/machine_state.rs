//! Where the cutter is and what holds until it is changed, whatever the words of the control.

use super::cutting_state::{CuttingFeed, CuttingState, Spindle};
use super::path_mode::PathMode;
use super::readiness::{PartMove, Readiness};
use super::words::at_line;
use super::{CutterMove, CutterProgram, CutterSide, FASTEST, MOST_MOVES, MoveKind, NO_MOVE, RADII};
use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Above the upper face the tool may move along Z wherever it is, mm: clamps are not as high.
const CLEAR_HEIGHT: f64 = 50.0;

/// The state of a control.
#[derive(Debug, Default)]
pub(super) struct MachineState {
    /// X, Y and Z, mm, once they are known.
    at: [Option<f64>; 3],
    /// The unit of a program that states it in its first line.
    pub(super) units: Option<LengthUnit>,
    /// Feed, mm/min, once it is given.
    pub(super) feed: Option<f64>,
    /// That of the last call of a tool, mm/min.
    pub(super) called_feed: Option<f64>,
    /// The side of the cutter.
    pub(super) side: CutterSide,
    /// Why the control does not know the radius of the cutter, where it does not.
    pub(super) radius_fault: Option<&'static str>,
    /// How the spindle is to turn.
    pub(super) spindle: Spindle,
    /// With what it cuts.
    pub(super) cutting: CuttingState,
    /// Words stated before the moves.
    pub(super) readiness: Readiness,
    pub(super) path_mode: PathMode,
    /// Whether the control may skip parts of the profile.
    pub(super) leaves_out: bool,
    program: CutterProgram,
}

impl MachineState {
    pub(super) fn of(control: Option<Controller>) -> Self {
        Self { readiness: Readiness::of(control), ..Self::default() }
    }

    /// Millimetres in a length of such a program.
    pub(super) fn scale(&self) -> f64 {
        self.units.unwrap_or_default().millimetres()
    }

    /// Whether the cutter has moved in part coordinates.
    pub(super) fn has_moved(&self) -> bool {
        !self.program.moves.is_empty() || self.at != [None; 3]
    }

    /// Whether the cutter is below the upper face.
    pub(super) fn is_deep(&self) -> bool {
        self.at[2].is_some_and(|z| z < 0.0)
    }

    /// What was read.
    pub(super) fn program(self, control: Option<Controller>) -> Result<CutterProgram, Refusal> {
        if self.is_deep() {
            return Err(Refusal::new("the program ends with the tool below the upper face"));
        }
        let (early, sets_up) = self.readiness.found();
        let (path_tolerances, leaves_out) = (self.path_mode.used(), self.leaves_out);
        let side_at_end = self.side;
        Ok(CutterProgram { side_at_end, control, path_tolerances, early, sets_up, leaves_out, ..self.program })
    }

    /// Whether Z is known in part coordinates.
    pub(super) fn knows_height(&self) -> bool {
        self.at[2].is_some()
    }

    /// A block that is not known: before the first move, with Z retracted to a place of the machine, or above the part one of M functions of the machine.
    pub(super) fn unknown(&mut self, line: usize, block: &str, of_machine: bool) -> Result<(), Refusal> {
        let retracted = self.at[2].is_none();
        if (self.at == [None; 3] && !self.has_moved()) || (!self.is_deep() && (retracted || of_machine)) {
            self.program.unknown.push(block.to_owned());
            return Ok(());
        }
        let shown: String = block.chars().take(40).collect();
        Err(at_line(line, format!("`{shown}` is not known, and what it does to the path neither")))
    }

    /// Leaves for a place of the machine that is not known, along these axes.
    pub(super) fn leave(&mut self, line: usize, axes: [bool; 3]) -> Result<(), Refusal> {
        let upwards = axes == [false, false, true];
        if !upwards && self.at[2].is_some_and(|z| z < 0.0) {
            return Err(at_line(line, "the cutter leaves for a place of the machine from below the upper face"));
        }
        for (own, _) in self.at.iter_mut().zip(axes).filter(|(_, leaves)| *leaves) {
            *own = None;
        }
        Ok(())
    }

    /// Keeps the Z of the machine, mm, to which the tool retracts.
    pub(super) fn retracts_to(&mut self, line: usize, z: f64) {
        self.program.retracts_to(line, z);
    }

    /// Keeps the length with which the tool moves along Z.
    pub(super) fn moves_with_its_length(&mut self, line: usize) {
        self.program.moves_with(line, self.cutting.length);
    }

    /// The place in the plane.
    pub(super) fn place(&self) -> Option<Vector2<f64>> {
        Some(Vector2::new(self.at[0]?, self.at[1]?))
    }

    /// Keeps with what a move at a feed cuts below the upper face.
    fn cuts(&mut self, moved: &CutterMove) {
        let deep = moved.from[2].min(moved.to[2]) < 0.0;
        let rises = moved.is_upright() && moved.to[2] > moved.from[2];
        if let Some(feed) = self.feed.filter(|_| deep && !rises && moved.kind != MoveKind::Rapid) {
            let plunges = moved.to[2] < moved.from[2];
            let state = CuttingState { compensated: self.side != CutterSide::Centre, ..self.cutting };
            self.program.cuts_with(moved.line, state, CuttingFeed { line: moved.line, feed, plunges });
        }
    }

    /// Records the words that a move relies on.
    fn relies(&mut self, line: usize, kind: MoveKind, before: [Option<f64>; 3]) {
        let is_arc = matches!(kind, MoveKind::Arc { .. });
        let deep = |z: Option<f64>| z.is_some_and(|z| z < 0.0);
        self.readiness.moves(PartMove {
            line,
            rapid: kind == MoveKind::Rapid,
            arc: is_arc,
            knew_place: (before[0].is_some() && before[1].is_some()) || self.at[2].is_some_and(|z| z >= CLEAR_HEIGHT),
            knew_height: before[2].is_some(),
            across: before[..2] != self.at[..2] || is_arc,
            along_z: before[2] != self.at[2],
            down: self.at[2] < before[2],
            cuts: kind != MoveKind::Rapid && (deep(before[2]) || deep(self.at[2])),
        });
    }

    /// A move to the coordinates that are given.
    pub(super) fn go(&mut self, line: usize, kind: MoveKind, to: [Option<f64>; 3]) -> Result<(), Refusal> {
        let before = self.at;
        for (own, new) in self.at.iter_mut().zip(to) {
            *own = new.or(*own);
        }
        self.relies(line, kind, before);
        if before[2] != self.at[2] {
            self.moves_with_its_length(line);
        }
        if kind != MoveKind::Rapid {
            self.path_mode.moves();
            match self.feed {
                None => return Err(at_line(line, "the cutter is to move at a feed that is not given")),
                Some(feed) if !(feed > 0.0 && feed <= FASTEST) => {
                    let what = format!("the cutter is to move at {feed} mm/min");
                    return Err(at_line(line, what).remedy(format!("give a feed above 0 and at most {FASTEST} mm/min")));
                }
                Some(_) => {}
            }
            if before.contains(&None) {
                return Err(at_line(line, "the cutter is to cut from a place that is not known"));
            }
        }
        // Where it comes from is not known: it must not be within the part.
        let below = |z: Option<f64>| z.is_some_and(|z| z < 0.0);
        if kind == MoveKind::Rapid && before.contains(&None) && (below(before[2]) || below(self.at[2])) {
            return Err(at_line(line, "a rapid move goes below the upper face, from a place that is not known"));
        }
        let filled = |of: [Option<f64>; 3], or: [Option<f64>; 3]| {
            let mut all = [0.0; 3];
            for ((value, own), other) in all.iter_mut().zip(of).zip(or) {
                *value = own.or(other)?;
            }
            Some(all)
        };
        // Until all coordinates are known the cutter comes from anywhere.
        let Some(to) = filled(self.at, self.at) else { return Ok(()) };
        let Some(from) = filled(before, self.at) else { return Ok(()) };
        let is_arc = matches!(kind, MoveKind::Arc { .. });
        if !is_arc && from.iter().zip(&to).all(|(a, b)| (a - b).abs() < NO_MOVE) {
            return Ok(());
        }
        let moved = CutterMove { line, kind, from, to, side: self.side };
        if moved.radii_differ() > RADII {
            let (off, most) = (moved.radii_differ(), RADII);
            let what = format!(
                "the end of the arc is off its circle by {off:.4} mm, more than the {most} mm that controls take"
            );
            return Err(at_line(line, what));
        }
        if is_arc && !moved.is_level() {
            return Err(at_line(line, "an arc changes its depth"));
        }
        if self.program.moves.len() == MOST_MOVES {
            return Err(at_line(line, format!("the program has more than {MOST_MOVES} moves")));
        }
        self.program.moves.push(moved);
        self.cuts(&moved);
        Ok(())
    }
}
