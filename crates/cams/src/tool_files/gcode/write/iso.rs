//! A program in words of a letter and a number, for LinuxCNC, FANUC and SINUMERIK.

use super::super::plan::milling::{MillingPass, MillingProgram};
use super::{by_hand, feed};
use crate::machine::Controller;
use crate::write::number::{plain, short};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::blocks::Block;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Digits of a number of revolutions.
const SPEED_DECIMALS: usize = 1;
/// Digits of a path tolerance.
pub(super) const SMOOTHING_DECIMALS: usize = 6;

/// A program being written.
pub(super) struct IsoText<'p> {
    pub(super) program: &'p MillingProgram,
    pub(super) decimals: usize,
    text: String,
    /// Where the cutter is, mm.
    at: Vector2<f64>,
    /// Whether it has left its home height.
    is_down: bool,
}

/// The text of a program.
pub(super) fn write(program: &MillingProgram, comments: &[String], name: &str) -> String {
    let decimals = usize::try_from(program.decimals).unwrap_or(usize::MAX);
    let mut text = IsoText { program, decimals, text: String::new(), at: Vector2::zeros(), is_down: false };
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

    /// States all words that moves rely on: words of another program may still be active.
    fn begin(&mut self, comments: &[String], name: &str) {
        let cutting = &self.program.cutting;
        if self.program.controller == Controller::Fanuc {
            self.line("%");
            self.line(&format!("O{:04} ({name})", cutting.program));
        }
        for comment in comments {
            self.comment(comment);
        }
        self.state();
        self.home();
        if let Some(tool) = cutting.tool {
            self.line(&format!("T{tool} M6"));
        }
        self.stop();
        self.line("G54");
        if let Some(speed) = cutting.spindle {
            self.line(&format!("S{} M3", short(speed, SPEED_DECIMALS)));
        }
        for line in &cutting.preamble {
            self.line(line);
        }
        if !cutting.preamble.is_empty() {
            // Preamble lines may have set incremental coordinates, as G91 G28 does.
            self.line("G17 G90 G94 G40");
        }
    }

    /// Unit in its own block, plane, coordinates, feed mode, cancelled offsets, and path mode.
    fn state(&mut self) {
        let metric = self.program.units == LengthUnit::Millimetre;
        match self.program.controller {
            // G710 and G700 also set the unit of feeds.
            Controller::Sinumerik => {
                self.line(if metric { "G710" } else { "G700" });
                self.line("G17 G90 G94 G40");
                self.line("TRANS");
                let smoothing = self.program.units.of_mm(MILLIMETRES * self.program.smoothing);
                self.line(&format!("G642 CTOL={}", short(smoothing, SMOOTHING_DECIMALS)));
            }
            Controller::Fanuc => {
                self.line(if metric { "G21" } else { "G20" });
                self.line("G17 G90 G94 G40 G49");
                self.line("G80 G64");
            }
            Controller::LinuxCnc | Controller::Heidenhain => {
                self.line(if metric { "G21" } else { "G20" });
                self.line("G17 G90 G94");
                self.line("G91.1 G40 G49 G80");
                self.line("G92.2");
                self.line("G61");
            }
        }
    }

    /// Retracts in machine coordinates, whatever tool length is active.
    fn home(&mut self) {
        let home = self.program.cutting.home;
        let z = self.number(MILLIMETRES * home.unwrap_or(0.0));
        match self.program.controller {
            Controller::Fanuc if home.is_none() => {
                self.line("G91 G28 Z0.");
                self.line("G90");
            }
            Controller::Sinumerik => self.line(&format!("G0 SUPA Z{z} D0")),
            _ => self.line(&format!("G53 G0 Z{z}")),
        }
    }

    /// Stops for the operator if the machine file lacks tool or spindle speed.
    fn stop(&mut self) {
        let wanted = by_hand(self.program);
        if wanted.is_empty() {
            return;
        }
        for line in wanted {
            // LinuxCNC shows such a comment to the operator.
            let shown = if self.program.controller == Controller::LinuxCnc { format!("MSG, {line}") } else { line };
            self.comment(&shown);
        }
        self.line("M0");
    }

    fn end(&mut self) {
        self.line("M9");
        self.line("M5");
        self.home();
        for line in &self.program.cutting.postamble {
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

    /// Moves to the clearance height.
    pub(super) fn up(&mut self) {
        let clearance = self.number(MILLIMETRES * self.program.cutting.clearance);
        self.line(&format!("G0 Z{clearance}"));
    }

    /// Moves in the plane to the start of a pass; for the first pass then down from home, with the tool length.
    pub(super) fn approach(&mut self, place: &str) {
        self.line(&format!("G0 {place}"));
        if std::mem::replace(&mut self.is_down, true) {
            return;
        }
        let length = match (self.program.controller, self.program.cutting.tool) {
            (Controller::LinuxCnc, Some(tool)) => format!(" G43 H{tool}"),
            // The length of the tool in the spindle.
            (Controller::LinuxCnc, None) => " G43".to_owned(),
            (Controller::Fanuc, Some(tool)) => format!(" G43 H{tool:02}"),
            (Controller::Sinumerik, _) => " D1".to_owned(),
            // Set by the operator at the stop, or by TOOL CALL.
            (Controller::Fanuc, None) | (Controller::Heidenhain, _) => String::new(),
        };
        let clearance = self.number(MILLIMETRES * self.program.cutting.clearance);
        self.line(&format!("G0{length} Z{clearance}"));
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
        let start = pass.compensated.map_or(pass.start, |ends| ends.from);
        self.approach(&format!("X{} Y{}", self.number(start.x), self.number(start.y)));
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
        if let Some(ends) = pass.compensated {
            self.line("G40");
            self.block(&Block::Line { to: ends.to }, None);
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
