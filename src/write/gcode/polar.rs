//! A program for grinding in polar coordinates: C turns the disc, X moves the wheel, each block with its own time (G93).

use super::MINUTE;
use super::iso::IsoText;
use crate::body::milling::PolarPath;
use crate::geometry::MILLIMETRES;
use crate::write::number::{plain, short};

/// Decimals of a feed by the time, and the largest of one, 1/min: what every control takes.
const RATE_DECIMALS: usize = 3;
const FASTEST: f64 = 9999.0;

impl IsoText<'_> {
    /// To the path, once round, and away from it.
    pub(super) fn polar(&mut self, path: &PolarPath, depth: f64) {
        let (cutting, decimals) = (&self.program.cutting, self.decimals);
        let number = |value: f64| plain(value, decimals);
        let Some(first) = path.rows.first() else { return };
        let along = self.feed(cutting.feed);
        self.comment("profile");
        self.line(&format!("G0 X{} C{}", number(path.away), number(first[0])));
        self.line(&format!("G1 Z{} F{along}", number(-depth)));
        self.line(&format!("G1 X{} F{}", number(first[1]), self.feed(cutting.plunge_feed)));
        self.line("G93");
        let speed = MINUTE * MILLIMETRES * cutting.feed;
        for ([angle, radius], length) in path.rows.iter().skip(1).zip(&path.lengths) {
            let words = short((speed / length).clamp(0.001, FASTEST), RATE_DECIMALS);
            let words = if words.contains('.') { words } else { words + "." };
            self.line(&format!("G1 X{} C{} F{words}", number(*radius), number(*angle)));
        }
        self.line("G94");
        self.line(&format!("G1 X{} F{along}", number(path.away)));
        self.up();
    }
}
