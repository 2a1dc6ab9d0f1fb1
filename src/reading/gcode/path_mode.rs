//! How exactly the control keeps to its path: G61 and G64 of LinuxCNC; G60, G64, G641 to G645 with CTOL, ADIS or CYCLE832 of SINUMERIK; cycle 32 of HEIDENHAIN.

use super::dialect::{after, has_word};
use crate::machine::Controller;

/// Words of SINUMERIK by which the control leaves its path, within CTOL, ADIS or CYCLE832; without them within machine data that the program does not know.
const SMOOTHING: [&str; 6] = ["G64", "G641", "G642", "G643", "G644", "G645"];
const COMPRESSING: [&str; 4] = ["COMPCAD", "COMPON", "COMPCURV", "COMPSURF"];

/// What a program has said of it.
#[derive(Debug, Default)]
pub(super) struct PathMode {
    /// By how much the control may leave its path, mm, and the line that says so; infinite where it is without a bound.
    is: Option<(usize, f64)>,
    /// SINUMERIK: the lines that make the control smooth and compress its path, and the tolerance that is stated for both.
    smooths: Option<usize>,
    compresses: Option<usize>,
    tolerance: Option<f64>,
    /// Those by which it has moved.
    used: Vec<(usize, f64)>,
}

impl PathMode {
    /// What a block says, in a program with so many millimetres in its unit.
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

    /// Takes a tolerance, mm; `None` is the one that the builder of the machine has set.
    pub(super) fn keeps_within(&mut self, line: usize, tolerance: Option<f64>) {
        self.is = tolerance.map(|tolerance| (line, tolerance));
    }

    /// Whether the program says how exactly the path is kept.
    pub(super) fn is_stated(&self) -> bool {
        self.is.is_some()
    }

    /// The tool moves at a feed.
    pub(super) fn moves(&mut self) {
        if let Some(own) = self.is.filter(|own| self.used.last() != Some(own)) {
            self.used.push(own);
        }
    }

    /// Those by which it has moved, mm, and the lines that say so.
    pub(super) fn used(self) -> Vec<(usize, f64)> {
        self.used
    }

    fn sinumerik(&mut self, line: usize, block: &str, scale: f64) {
        if let Some(word) = after(block, "CYCLE832") {
            // Without a number it ends.
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

/// The number after a word, in parentheses or behind `=`.
fn number(rest: &str) -> Option<f64> {
    let rest = rest.trim_start_matches(['(', '=', ' ']);
    let end = rest.find(|c: char| !(c.is_ascii_digit() || ['.', '+', '-'].contains(&c))).unwrap_or(rest.len());
    rest.get(..end)?.parse().ok()
}
