//! A program in words of a letter and a number, for LinuxCNC, FANUC and SINUMERIK.

use super::feed;
use crate::body::milling::{MillingPass, MillingProgram};
use crate::geometry::MILLIMETRES;
use crate::geometry::blocks::Block;
use crate::machine::Controller;
use crate::units::LengthUnit;
use crate::write::number::{plain, short};
use nalgebra::Vector2;

/// Digits of a number of revolutions.
const SPEED_DECIMALS: usize = 1;

/// A program being written.
pub(super) struct IsoText<'p> {
    pub(super) program: &'p MillingProgram,
    pub(super) decimals: usize,
    text: String,
    /// Where the cutter is, mm.
    at: Vector2<f64>,
}

/// The text of a program.
pub(super) fn write(program: &MillingProgram, comments: &[String], name: &str) -> String {
    let decimals = usize::try_from(program.decimals).unwrap_or(usize::MAX);
    let mut text = IsoText { program, decimals, text: String::new(), at: Vector2::zeros() };
    text.begin(comments, name);
    for depth in &program.depths {
        if let Some(path) = &program.turned {
            text.turned(path, *depth);
        }
        for pass in &program.passes {
            text.pass(pass, *depth);
        }
    }
    text.end();
    text.text
}

impl IsoText<'_> {
    pub(super) fn line(&mut self, words: &str) {
        self.text.push_str(words);
        self.text.push('\n');
    }

    pub(super) fn comment(&mut self, comment: &str) {
        let comment = match self.program.controller {
            Controller::Fanuc => format!("({})", comment.to_ascii_uppercase()),
            Controller::Sinumerik => format!("; {comment}"),
            Controller::LinuxCnc | Controller::Heidenhain => format!("({comment})"),
        };
        self.line(&comment);
    }

    /// What states unit, plane and coordinates, after the lines of the shop.
    fn begin(&mut self, comments: &[String], name: &str) {
        let cutting = &self.program.cutting;
        if self.program.controller == Controller::Fanuc {
            self.line("%");
            self.line(&format!("O{:04} ({name})", cutting.program));
        }
        for comment in comments {
            self.comment(comment);
        }
        for line in &cutting.preamble {
            self.line(line);
        }
        self.line(match (self.program.controller, self.program.units) {
            (Controller::LinuxCnc | Controller::Heidenhain, LengthUnit::Millimetre) => "G17 G21 G40 G90 G91.1 G94",
            (Controller::LinuxCnc | Controller::Heidenhain, LengthUnit::Inch) => "G17 G20 G40 G90 G91.1 G94",
            (Controller::Fanuc, LengthUnit::Millimetre) => "G17 G21 G40 G90 G94",
            (Controller::Fanuc, LengthUnit::Inch) => "G17 G20 G40 G90 G94",
            // Feeds are in the unit, too.
            (Controller::Sinumerik, LengthUnit::Millimetre) => "G17 G40 G90 G94 G710",
            (Controller::Sinumerik, LengthUnit::Inch) => "G17 G40 G90 G94 G700",
        });
        if let Some(tool) = cutting.tool {
            self.line(&format!("T{tool} M6"));
        }
        if let Some(speed) = cutting.spindle {
            self.line(&format!("S{} M3", short(speed, SPEED_DECIMALS)));
        }
        let length = match (self.program.controller, cutting.tool) {
            (Controller::LinuxCnc, Some(tool)) => format!(" G43 H{tool}"),
            (Controller::Fanuc, Some(tool)) => format!(" G43 H{tool:02}"),
            // SINUMERIK takes the length with the tool.
            _ => String::new(),
        };
        self.rise(&length);
    }

    fn end(&mut self) {
        let cutting = &self.program.cutting;
        if cutting.spindle.is_some() {
            self.line("M5");
        }
        for line in &cutting.postamble {
            self.line(line);
        }
        self.line("M30");
        if self.program.controller == Controller::Fanuc {
            self.line("%");
        }
    }

    /// A length, mm, as a number of the program.
    pub(super) fn number(&self, millimetres: f64) -> String {
        plain(self.program.units.of_mm(millimetres), self.decimals)
    }

    pub(super) fn up(&mut self) {
        self.rise("");
    }

    /// To the clearance height, with more words.
    fn rise(&mut self, words: &str) {
        let clearance = self.number(MILLIMETRES * self.program.cutting.clearance);
        self.line(&format!("G0{words} Z{clearance}"));
    }

    /// The words of a place that differ from where the cutter is.
    fn place(&self, to: Vector2<f64>) -> String {
        let mut words = String::new();
        for (letter, is, was) in [('X', to.x, self.at.x), ('Y', to.y, self.at.y)] {
            if is != was {
                words.push_str(&format!(" {letter}{}", self.number(is)));
            }
        }
        words
    }

    /// A feed; with a decimal point for FANUC, which reads one without as so many of its least increments where a parameter says so.
    pub(super) fn feed(&self, speed: f64) -> String {
        let text = feed(speed, self.program.units);
        if self.program.controller == Controller::Fanuc && !text.contains('.') { text + "." } else { text }
    }

    /// Down at its start, round, and up again.
    fn pass(&mut self, pass: &MillingPass, depth: f64) {
        let cutting = &self.program.cutting;
        let (plunge, along) = (self.feed(cutting.plunge_feed), self.feed(cutting.feed));
        self.comment(&pass.words);
        let start = pass.compensated.map_or(pass.start, |[from, _]| from);
        self.line(&format!("G0 X{} Y{}", self.number(start.x), self.number(start.y)));
        self.at = start;
        self.line(&format!("G1 Z{} F{plunge}", self.number(-depth)));
        if pass.compensated.is_some() {
            let side = if pass.cutter_left { "G41" } else { "G42" };
            let tool = match self.program.controller {
                Controller::LinuxCnc => format!(" D{}", cutting.tool.unwrap_or(1)),
                Controller::Fanuc => format!(" D{:02}", cutting.tool.unwrap_or(1)),
                // The radius is that of the cutting edge.
                Controller::Sinumerik | Controller::Heidenhain => " D1".to_owned(),
            };
            self.line(&format!("{side}{tool}"));
            self.block(&Block::Line { to: pass.start }, Some(&along));
        }
        let mut feed = pass.compensated.is_none().then_some(along);
        for block in &pass.blocks {
            self.block(block, feed.take().as_deref());
        }
        if let Some([_, to]) = pass.compensated {
            self.line("G40");
            self.block(&Block::Line { to }, None);
        }
        self.up();
    }

    fn block(&mut self, block: &Block, feed: Option<&str>) {
        let feed = feed.map_or_else(String::new, |feed| format!(" F{feed}"));
        let words = match block {
            Block::Line { to } => format!("G1{}{feed}", self.place(*to)),
            Block::Arc { to, centre, left } => {
                let (way, from) = (if *left { "G3" } else { "G2" }, *centre - self.at);
                let (i, j) = (self.number(from.x), self.number(from.y));
                format!("{way} X{} Y{} I{i} J{j}{feed}", self.number(to.x), self.number(to.y))
            }
        };
        self.line(&words);
        self.at = block.to();
    }
}
