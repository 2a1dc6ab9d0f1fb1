//! Programs for a milling machine in a report.

use super::{Section, shown};
use camgen_kernel::text::{Length, Text, text};
use serde::Serialize;

/// A program for a milling machine.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProgramMeasures {
    /// The control.
    pub controller: &'static str,
    /// Moves.
    pub moves: usize,
    /// Passes.
    pub passes: usize,
    /// How deep it cuts, mm.
    pub depth_mm: f64,
    /// Length of the path at a feed, mm.
    pub length_mm: f64,
    /// Time at the feeds, min, without the moves between the passes.
    pub minutes: f64,
}

impl ProgramMeasures {
    /// The section of a report; `None` where there is no program.
    #[must_use]
    pub fn section(all: &[Self]) -> Option<Section> {
        (!all.is_empty()).then(|| Section::new("programs", &all).with_words(all.iter().map(Self::words).collect()))
    }

    fn words(&self) -> Text {
        let Self { controller, moves, passes, depth_mm, length_mm, minutes } = self;
        let noun = if *passes == 1 { "pass" } else { "passes" };
        text!(
            "for {}: {} moves, {} {} to {}, {} of path in {} min at the feeds",
            controller,
            *moves,
            *passes,
            noun,
            Length::mm(*depth_mm),
            Length::mm(*length_mm),
            shown(*minutes)
        )
    }
}
