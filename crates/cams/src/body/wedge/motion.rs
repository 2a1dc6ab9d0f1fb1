//! The motion of a plate: a level run-in, then the motion that it is cut for.

use camgen_kernel::motion::program::Program;
use camgen_kernel::motion::{Jet, Motion, NamedStretch, Piece, Quantity};
use std::sync::Arc;

/// A motion over the travel of a plate, with a rest before it.
#[derive(Debug, Clone)]
pub struct PlateMotion {
    motion: Arc<dyn Motion>,
    pieces: Vec<Piece>,
    /// Lift on the run-in, m.
    level: f64,
}

impl PlateMotion {
    /// A motion behind a run-in of a length, m.
    #[must_use]
    pub fn new(motion: Arc<dyn Motion>, run_in: f64) -> Self {
        let (start, _) = motion.range();
        let level = motion.jet(0, start).s;
        let mut pieces = vec![Piece { start: start - run_in, end: start, dwell: true }];
        pieces.extend_from_slice(motion.pieces());
        Self { motion, pieces, level }
    }

    /// The first and the last place of the motion itself, m.
    #[must_use]
    pub fn stroke(&self) -> (f64, f64) {
        self.motion.range()
    }
}

impl Motion for PlateMotion {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, x: f64) -> Jet {
        match piece.checked_sub(1) {
            Some(piece) => self.motion.jet(piece, x),
            None => Jet { s: self.level, ..Jet::default() },
        }
    }

    fn is_rolled(&self, piece: usize) -> bool {
        piece.checked_sub(1).is_none_or(|piece| self.motion.is_rolled(piece))
    }

    fn quantity(&self) -> Quantity {
        self.motion.quantity()
    }

    fn period(&self) -> Option<f64> {
        None
    }

    fn is_by_travel(&self) -> bool {
        true
    }

    fn origin(&self) -> Option<f64> {
        self.motion.origin()
    }

    fn program(&self) -> Option<&Program> {
        self.motion.program()
    }

    fn named_stretches(&self) -> Vec<NamedStretch> {
        let run_in =
            self.pieces.first().map(|piece| NamedStretch { from: piece.start, to: piece.end, name: "run-in".into() });
        run_in.into_iter().chain(self.motion.named_stretches()).collect()
    }

    fn cells(&self, piece: usize) -> u32 {
        piece.checked_sub(1).map_or(1, |piece| self.motion.cells(piece))
    }
}

/// A motion that takes another length of plate for the same lifts.
#[derive(Debug)]
pub(super) struct Stretched {
    motion: Arc<dyn Motion>,
    factor: f64,
    pieces: Vec<Piece>,
}

impl Stretched {
    /// A motion over so many times its travel.
    pub(super) fn new(motion: Arc<dyn Motion>, factor: f64) -> Self {
        let longer = |piece: &Piece| Piece { start: factor * piece.start, end: factor * piece.end, ..*piece };
        let pieces = motion.pieces().iter().map(longer).collect();
        Self { motion, factor, pieces }
    }
}

impl Motion for Stretched {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, x: f64) -> Jet {
        self.motion.jet(piece, x / self.factor).by_angle_times(self.factor)
    }

    fn is_rolled(&self, piece: usize) -> bool {
        self.motion.is_rolled(piece)
    }

    fn period(&self) -> Option<f64> {
        None
    }

    fn is_by_travel(&self) -> bool {
        true
    }

    fn cells(&self, piece: usize) -> u32 {
        self.motion.cells(piece)
    }
}
