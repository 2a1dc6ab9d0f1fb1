//! A program in the dialogue of HEIDENHAIN controls (Klartext): numbered blocks, centres in absolute coordinates.

use super::feed;
use crate::body::milling::{MillingPass, MillingProgram};
use crate::geometry::MILLIMETRES;
use crate::geometry::blocks::Block;
use crate::units::LengthUnit;
use crate::write::number::{plain, short};
use nalgebra::Vector2;

/// Digits of a number of revolutions.
const SPEED_DECIMALS: usize = 1;
/// Steps of a feed in an inch per minute.
const TENTHS: f64 = 10.0;

/// A program being written.
struct DialogueText<'p> {
    program: &'p MillingProgram,
    decimals: usize,
    blocks: Vec<String>,
}

/// The text of a program.
pub(super) fn write(program: &MillingProgram, comments: &[String], name: &str) -> String {
    let decimals = usize::try_from(program.decimals).unwrap_or(usize::MAX);
    let unit = if program.units == LengthUnit::Inch { "INCH" } else { "MM" };
    let mut text = DialogueText { program, decimals, blocks: vec![format!("BEGIN PGM {name} {unit}")] };
    text.begin(comments);
    for depth in &program.depths {
        for pass in &program.passes {
            text.pass(pass, *depth);
        }
    }
    text.blocks.extend(program.cutting.postamble.iter().cloned());
    text.blocks.push("M30".to_owned());
    text.blocks.push(format!("END PGM {name} {unit}"));
    let numbered = text.blocks.iter().enumerate().map(|(number, block)| format!("{number} {block}\n"));
    numbered.collect()
}

impl DialogueText<'_> {
    fn block(&mut self, words: String) {
        self.blocks.push(words);
    }

    /// A feed: of a program in inches in tenths of an inch per minute, as the dialogue has them.
    fn feed(&self, speed: f64) -> String {
        let tenths = if self.program.units == LengthUnit::Inch { TENTHS } else { 1.0 };
        feed(tenths * speed, self.program.units)
    }

    /// A length, mm, as a number with its sign.
    fn signed(&self, value: f64) -> String {
        let text = plain(self.program.units.of_mm(value), self.decimals);
        if text.starts_with('-') { text } else { format!("+{text}") }
    }

    fn place(&self, to: Vector2<f64>) -> String {
        format!("X{} Y{}", self.signed(to.x), self.signed(to.y))
    }

    fn begin(&mut self, comments: &[String]) {
        let cutting = &self.program.cutting;
        self.blocks.extend(comments.iter().map(|comment| format!("; {comment}")));
        self.blocks.extend(cutting.preamble.iter().cloned());
        let speed = cutting.spindle.map(|speed| format!(" S{}", short(speed, SPEED_DECIMALS))).unwrap_or_default();
        match cutting.tool {
            Some(tool) => self.block(format!("TOOL CALL {tool} Z{speed}")),
            None if cutting.spindle.is_some() => self.block(format!("TOOL CALL Z{speed}")),
            None => {}
        }
        let starts = if cutting.spindle.is_some() { " M3" } else { "" };
        self.up(starts);
    }

    fn up(&mut self, more: &str) {
        let clearance = self.signed(MILLIMETRES * self.program.cutting.clearance);
        self.block(format!("L Z{clearance} R0 FMAX{more}"));
    }

    /// Down at its start, round, and up again.
    fn pass(&mut self, pass: &MillingPass, depth: f64) {
        let cutting = &self.program.cutting;
        let (plunge, along) = (self.feed(cutting.plunge_feed), self.feed(cutting.feed));
        self.block(format!("; {}", pass.words));
        let start = pass.compensated.map_or(pass.start, |[from, _]| from);
        self.block(format!("L {} R0 FMAX", self.place(start)));
        self.block(format!("L Z{} R0 F{plunge}", self.signed(-depth)));
        if pass.compensated.is_some() {
            let side = if pass.cutter_left { "RL" } else { "RR" };
            self.block(format!("L {} {side} F{along}", self.place(pass.start)));
        }
        let mut feed = pass.compensated.is_none().then(|| format!(" F{along}"));
        for block in &pass.blocks {
            let feed = feed.take().unwrap_or_default();
            match block {
                Block::Line { to } => self.block(format!("L {}{feed}", self.place(*to))),
                Block::Arc { to, centre, left } => {
                    self.block(format!("CC {}", self.place(*centre)));
                    self.block(format!("C {} DR{}{feed}", self.place(*to), if *left { '+' } else { '-' }));
                }
            }
        }
        if let Some([_, to]) = pass.compensated {
            self.block(format!("L {} R0", self.place(to)));
        }
        self.up("");
    }
}
