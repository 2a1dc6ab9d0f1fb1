//! A program in words of a letter and a number, for LinuxCNC, FANUC, SINUMERIK, grbl and Mach3.

use super::super::plan::entry::Descent;
use super::super::plan::milling::{MillingPass, MillingProgram};
use super::{by_hand, feed, home};
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
    if let Some(path) = &program.turned {
        for depth in &program.depths {
            text.turned(path, *depth);
        }
    }
    for (pass, _, descent) in program.level_cuts() {
        text.pass(pass, &descent);
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
            Controller::LinuxCnc | Controller::Heidenhain | Controller::Grbl | Controller::Mach3 => {
                format!("({comment})")
            }
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
        self.own_lines(&cutting.header);
        self.home();
        // grbl has no tool change (error 20): the operator loads the tool before the start.
        if let Some(tool) = cutting.tool.filter(|_| self.program.controller != Controller::Grbl) {
            self.line(&format!("T{tool} M6"));
        }
        self.stop();
        self.own_lines(&cutting.after_tool);
        self.line("G54");
        if let Some(speed) = cutting.spindle {
            self.line(&format!("S{} M3", short(speed, SPEED_DECIMALS)));
        }
        if let Some(word) = cutting.coolant.word() {
            self.line(word);
        }
        self.own_lines(&cutting.preamble);
    }

    /// Lines of the machine file. They may have set incremental coordinates, as G91 G28 does: what moves rely on is written again.
    fn own_lines(&mut self, lines: &[String]) {
        for line in lines {
            self.line(line);
        }
        if !lines.is_empty() {
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
            Controller::LinuxCnc | Controller::Heidenhain | Controller::Grbl | Controller::Mach3 => {
                self.line(if metric { "G21" } else { "G20" });
                self.line("G17 G90 G94");
                self.line("G91.1 G40 G49 G80");
                // grbl has G92.1 alone, and Mach3 clears its offsets with it.
                let one = matches!(self.program.controller, Controller::Grbl | Controller::Mach3);
                self.line(if one { "G92.1" } else { "G92.2" });
                self.line("G61");
            }
        }
    }

    /// Retracts in machine coordinates, whatever tool length is active.
    fn home(&mut self) {
        let z = self.number(MILLIMETRES * home(self.program).unwrap_or(0.0));
        match self.program.controller {
            Controller::Fanuc if self.program.cutting.home.is_none() => {
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
        // M0 of grbl is a feed hold: the spindle turns on and the axes cannot be jogged, so that no tool is changed at it.
        let is_grbl = self.program.controller == Controller::Grbl;
        if wanted.is_empty() || (is_grbl && self.program.cutting.spindle.is_some()) {
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
        for line in &self.program.cutting.footer {
            self.line(line);
        }
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

    /// Rises to the safe height.
    pub(super) fn up(&mut self) {
        let safe = self.number(MILLIMETRES * self.program.cutting.safe_height);
        self.line(&format!("G0 Z{safe}"));
    }

    /// Moves in the plane at home or at the safe height, the first time then down to the safe height with the tool length, and down to the clearance height.
    pub(super) fn approach(&mut self, place: &str) {
        self.line(&format!("G0 {place}"));
        if !std::mem::replace(&mut self.is_down, true) {
            let length = match (self.program.controller, self.program.cutting.tool) {
                (Controller::LinuxCnc | Controller::Mach3, Some(tool)) => format!(" G43 H{tool}"),
                // The length of the tool in the spindle.
                (Controller::LinuxCnc, None) => " G43".to_owned(),
                (Controller::Fanuc, Some(tool)) => format!(" G43 H{tool:02}"),
                (Controller::Sinumerik, _) => " D1".to_owned(),
                // Set by the operator at the stop or before the start, or by TOOL CALL.
                (Controller::Fanuc | Controller::Mach3, None) | (Controller::Heidenhain | Controller::Grbl, _) => {
                    String::new()
                }
            };
            let safe = self.number(MILLIMETRES * self.program.cutting.safe_height);
            self.line(&format!("G0{length} Z{safe}"));
        }
        let (safe, clearance) = (self.program.cutting.safe_height, self.program.cutting.clearance);
        if clearance < safe {
            let clearance = self.number(MILLIMETRES * clearance);
            self.line(&format!("G0 Z{clearance}"));
        }
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

    /// Down to its depth, round, and up again.
    fn pass(&mut self, pass: &MillingPass, descent: &Descent) {
        let cutting = &self.program.cutting;
        let (plunge, along) = (self.feed(cutting.plunge_feed), self.feed(cutting.feed));
        self.comment(&pass.words);
        let start = pass.level_start();
        self.approach(&format!("X{} Y{}", self.number(descent.at.x), self.number(descent.at.y)));
        self.at = descent.at;
        self.line(&format!("G1 Z{} F{plunge}", self.number(descent.z)));
        for (to, z) in &descent.ramp {
            self.line(&format!("G1{} Z{}", self.place(*to), self.number(*z)));
            self.at = *to;
        }
        let mut feed = Some(along);
        if descent.is_away {
            self.block(&Block::Line { to: start }, feed.take().as_deref());
        }
        if pass.compensated.is_some() {
            let side = if pass.cutter_left { "G41" } else { "G42" };
            let tool = match self.program.controller {
                Controller::LinuxCnc | Controller::Mach3 | Controller::Grbl => {
                    format!(" D{}", cutting.tool.unwrap_or(1))
                }
                Controller::Fanuc => format!(" D{:02}", cutting.tool.unwrap_or(1)),
                // The radius is that of the cutting edge.
                Controller::Sinumerik | Controller::Heidenhain => " D1".to_owned(),
            };
            self.line(&format!("{side}{tool}"));
            self.block(&Block::Line { to: pass.start }, feed.take().as_deref());
        }
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
