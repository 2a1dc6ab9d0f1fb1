//! A program for a cam that is turned under its tool: C or A turns it, X and Y move the tool, each block with its own time (G93).

use super::super::plan::milling::{TurnedPath, TurnedRound};
use super::MINUTE;
use super::iso::IsoText;
use crate::write::number::{plain, short};
use camgen_kernel::geometry::MILLIMETRES;

/// Decimals of a feed by the time, and the largest of one, 1/min: what every control takes.
const RATE_DECIMALS: usize = 3;
const FASTEST: f64 = 9999.0;

impl IsoText<'_> {
    /// To each round, once round, and away from it.
    pub(super) fn turned(&mut self, path: &TurnedPath, depth: f64) {
        for round in &path.rounds {
            self.round((path.axis, round), depth);
        }
    }

    fn round(&mut self, (axis, round): (char, &TurnedRound), depth: f64) {
        let (cutting, decimals, units) = (&self.program.cutting, self.decimals, self.program.units);
        let both =
            |[x, y]: [f64; 2]| format!("X{} Y{}", plain(units.of_mm(x), decimals), plain(units.of_mm(y), decimals));
        // Of a disc the tool stays over the axis.
        let place = |[x, y]: [f64; 2]| {
            if axis == 'C' { format!("X{}", plain(units.of_mm(x), decimals)) } else { both([x, y]) }
        };
        let Some([first, x, y]) = round.rows.first().copied() else { return };
        let (along, plunge) = (self.feed(cutting.feed), self.feed(cutting.plunge_feed));
        // Beside a disc the wheel goes down in the open.
        let (down, to) = if axis == 'C' { (&along, &plunge) } else { (&plunge, &along) };
        self.comment(&round.words);
        self.approach(&format!("{} {axis}{}", both(round.away), plain(first, decimals)));
        self.line(&format!("G1 Z{} F{down}", self.number(-depth)));
        let goes_to = round.away != [x, y];
        if goes_to {
            self.line(&format!("G1 {} F{to}", place([x, y])));
        }
        self.line("G93");
        let speed = MINUTE * MILLIMETRES * cutting.feed;
        for ([angle, x, y], length) in round.rows.iter().skip(1).zip(&round.lengths) {
            let words = short((speed / length).clamp(0.001, FASTEST), RATE_DECIMALS);
            let words = if words.contains('.') { words } else { words + "." };
            self.line(&format!("G1 {} {axis}{} F{words}", place([*x, *y]), plain(*angle, decimals)));
        }
        self.line("G94");
        if goes_to {
            self.line(&format!("G1 {} F{along}", place(round.away)));
        }
        self.up();
    }
}
