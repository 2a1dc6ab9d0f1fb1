//! A program in the dialogue of HEIDENHAIN controls (Klartext): numbered blocks, centres in absolute coordinates.

use super::super::plan::entry::Descent;
use super::super::plan::milling::{MillingPass, MillingProgram};
use super::iso::SMOOTHING_DECIMALS;
use super::{by_hand, feed, home};
use crate::write::number::{plain, short};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::blocks::Block;
use camgen_kernel::units::LengthUnit;
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
    /// Whether the cutter has left its home height.
    is_down: bool,
}

/// The text of a program.
pub(super) fn write(program: &MillingProgram, comments: &[String], name: &str) -> String {
    let decimals = usize::try_from(program.decimals).unwrap_or(usize::MAX);
    let unit = if program.units == LengthUnit::Inch { "INCH" } else { "MM" };
    let mut text = DialogueText { program, decimals, blocks: vec![format!("BEGIN PGM {name} {unit}")], is_down: false };
    text.begin(comments);
    let last = program.order.len().saturating_sub(1);
    for (index, (pass, _, descent)) in program.level_cuts().enumerate() {
        text.pass(pass, &descent, index == last);
    }
    text.end();
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

    /// States all words that moves rely on: settings of another program may still be active.
    fn begin(&mut self, comments: &[String]) {
        let cutting = &self.program.cutting;
        self.blocks.extend(comments.iter().map(|comment| format!("; {comment}")));
        for cycle in ["7.0 DATUM SHIFT", "7.1 X+0", "7.2 Y+0", "7.3 Z+0", "10.0 ROTATION", "10.1 ROT+0"] {
            self.block(format!("CYCL DEF {cycle}"));
        }
        self.blocks.extend(cutting.header.iter().cloned());
        self.home("");
        let speed = cutting.spindle.map(|speed| format!(" S{}", short(speed, SPEED_DECIMALS))).unwrap_or_default();
        match cutting.tool {
            Some(tool) => self.block(format!("TOOL CALL {tool} Z{speed}")),
            None if cutting.spindle.is_some() => self.block(format!("TOOL CALL Z{speed}")),
            None => {}
        }
        let wanted = by_hand(self.program);
        if !wanted.is_empty() {
            self.blocks.extend(wanted.iter().map(|line| format!("; {line}")));
            self.block("STOP".to_owned());
        }
        self.blocks.extend(cutting.after_tool.iter().cloned());
        let smoothing = self.program.units.of_mm(MILLIMETRES * self.program.smoothing);
        self.block("CYCL DEF 32.0 TOLERANCE".to_owned());
        self.block(format!("CYCL DEF 32.1 T{}", short(smoothing, SMOOTHING_DECIMALS)));
        self.blocks.extend(cutting.preamble.iter().cloned());
    }

    /// Restores the machine builder's tolerance, retracts, and stops the spindle.
    fn end(&mut self) {
        self.blocks.extend(self.program.cutting.footer.iter().cloned());
        self.block("CYCL DEF 32.0 TOLERANCE".to_owned());
        self.block("CYCL DEF 32.1".to_owned());
        self.home(" M5");
        self.blocks.extend(self.program.cutting.postamble.iter().cloned());
        self.block("M30".to_owned());
    }

    /// Retracts in machine coordinates, which exclude the tool length.
    fn home(&mut self, more: &str) {
        let home = self.signed(MILLIMETRES * home(self.program).unwrap_or(0.0));
        self.block(format!("L Z{home} R0 FMAX M91{more}"));
    }

    /// Moves to a height above the upper face, m.
    fn goes_to(&mut self, height: f64, more: &str) {
        let height = self.signed(MILLIMETRES * height);
        self.block(format!("L Z{height} R0 FMAX{more}"));
    }

    /// Down to its depth, round, and up again.
    fn pass(&mut self, pass: &MillingPass, descent: &Descent, is_last: bool) {
        let cutting = &self.program.cutting;
        let (plunge, along) = (self.feed(cutting.plunge_feed), self.feed(cutting.feed));
        let (safe, clearance) = (cutting.safe_height, cutting.clearance);
        self.block(format!("; {}", pass.words));
        let first = !std::mem::replace(&mut self.is_down, true);
        let starts = if first && cutting.spindle.is_some() { " M3" } else { "" };
        self.block(format!("L {} R0 FMAX{starts}", self.place(descent.at)));
        if first {
            let coolant = cutting.coolant.word().map_or_else(String::new, |word| format!(" {word}"));
            self.goes_to(safe, &coolant);
        }
        if clearance < safe {
            self.goes_to(clearance, "");
        }
        self.block(format!("L Z{} R0 F{plunge}", self.signed(descent.z)));
        for (to, z) in &descent.ramp {
            self.block(format!("L {} Z{} R0", self.place(*to), self.signed(*z)));
        }
        let mut feed = Some(format!(" F{along}"));
        if descent.is_away {
            let feed = feed.take().unwrap_or_default();
            self.block(format!("L {} R0{feed}", self.place(pass.level_start())));
        }
        if pass.compensated.is_some() {
            let side = if pass.cutter_left { "RL" } else { "RR" };
            let feed = feed.take().unwrap_or_default();
            self.block(format!("L {} {side}{feed}", self.place(pass.start)));
        }
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
        if let Some(ends) = pass.compensated {
            self.block(format!("L {} R0", self.place(ends.to)));
        }
        self.goes_to(safe, if is_last { " M9" } else { "" });
    }
}
