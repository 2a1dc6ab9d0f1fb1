//! Path tolerance of the control: G61 and G64 of LinuxCNC; G60, G64, G641 to G645 with CTOL, ADIS or CYCLE832 of SINUMERIK; cycle 32 of HEIDENHAIN.

use super::dialect::{after, has_word};
use crate::machine::Controller;

/// SINUMERIK words for smoothing within CTOL, ADIS or CYCLE832; without a tolerance, within machine data unknown to the program.
const SMOOTHING: [&str; 6] = ["G64", "G641", "G642", "G643", "G644", "G645"];
const COMPRESSING: [&str; 4] = ["COMPCAD", "COMPON", "COMPCURV", "COMPSURF"];

/// The path mode stated so far.
#[derive(Debug, Default)]
pub(super) struct PathMode {
    /// Line and path tolerance, mm; infinite if unbounded.
    is: Option<(usize, f64)>,
    /// SINUMERIK: the lines that switch on smoothing and compressing, and the tolerance stated for both.
    smooths: Option<usize>,
    compresses: Option<usize>,
    tolerance: Option<f64>,
    /// Lines and tolerances in effect during moves.
    used: Vec<(usize, f64)>,
}

impl PathMode {
    /// Reads a block; `scale` is millimetres per unit of the program.
    pub(super) fn block(&mut self, line: usize, block: &str, control: Option<Controller>, scale: f64) {
        let block = block.to_ascii_uppercase();
        match control {
            Some(Controller::Sinumerik) => self.sinumerik(line, &block, scale),
            Some(Controller::Fanuc | Controller::Heidenhain) => {}
            Some(Controller::LinuxCnc) if ["G61", "G61.1"].iter().any(|word| has_word(&block, word)) => {
                self.is = Some((line, 0.0));
            }
            Some(Controller::LinuxCnc) | None => {
                let Some(rest) = after(&block, "G64") else { return };
                let stated = rest.split_once('P').and_then(|(_, rest)| number(rest));
                let without = (control == Some(Controller::LinuxCnc)).then_some(f64::INFINITY);
                self.is =
                    stated.map(|number| scale * number).or(without).map(|tolerance| (line, tolerance)).or(self.is);
            }
        }
    }

    /// Takes a tolerance, mm; `None`: the machine builder's own.
    pub(super) fn keeps_within(&mut self, line: usize, tolerance: Option<f64>) {
        self.is = tolerance.map(|tolerance| (line, tolerance));
    }

    /// Whether the path mode is stated.
    pub(super) fn is_stated(&self) -> bool {
        self.is.is_some()
    }

    /// Records a feed move.
    pub(super) fn moves(&mut self) {
        if let Some(own) = self.is.filter(|own| self.used.last() != Some(own)) {
            self.used.push(own);
        }
    }

    /// Lines and tolerances, mm, in effect during feed moves.
    pub(super) fn used(self) -> Vec<(usize, f64)> {
        self.used
    }

    fn sinumerik(&mut self, line: usize, block: &str, scale: f64) {
        if let Some(word) = after(block, "CYCLE832") {
            // Without a number the cycle ends.
            self.tolerance = number(word).filter(|number| *number > 0.0).map(|number| scale * number);
            self.smooths = self.tolerance.map(|_| line).or(self.smooths);
        }
        if let Some(number) = ["CTOL", "ADIS"].iter().find_map(|word| number(after(block, word)?)) {
            self.tolerance = (number >= 0.0).then_some(scale * number);
        }
        let has = |words: &[&str]| words.iter().any(|word| has_word(block, word));
        let exact = has(&["G60"]);
        self.smooths = if has(&SMOOTHING) { Some(line) } else { self.smooths.filter(|_| !exact) };
        self.compresses = if has(&COMPRESSING) { Some(line) } else { self.compresses.filter(|_| !has(&["COMPOF"])) };
        let within = self.tolerance.unwrap_or(f64::INFINITY);
        let freely = self.smooths.or(self.compresses).map(|line| (line, within));
        self.is = freely.or(exact.then_some((line, 0.0))).or(self.is.filter(|own| own.1 == 0.0));
    }
}

/// The number after a word, in parentheses or after `=`.
fn number(rest: &str) -> Option<f64> {
    let rest = rest.trim_start_matches(['(', '=', ' ']);
    let end = rest.find(|c: char| !(c.is_ascii_digit() || ['.', '+', '-'].contains(&c))).unwrap_or(rest.len());
    rest.get(..end)?.parse().ok()
}
