//! Path tolerance of the control: G61 and G64 of LinuxCNC and Mach3, whose G64 has no tolerance; G60, G64, G641 to G645 with CTOL, ADIS or CYCLE832 of SINUMERIK; cycle 32 of HEIDENHAIN.

use super::dialect::{after, has_word};
use super::words::at_line;
use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;

/// How a SINUMERIK control rounds the corners of its path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Smoothing {
    /// G64 and G644: by machine data, which the program does not know.
    Unbounded,
    /// G641: within ADIS.
    Distance,
    /// G642, G643, G645: within CTOL; ADIS as well where machine data say so.
    Contour,
    /// CYCLE832: within its own tolerance.
    Cycle,
}

const SMOOTHING: [(&str, Smoothing); 6] = [
    ("G64", Smoothing::Unbounded),
    ("G641", Smoothing::Distance),
    ("G642", Smoothing::Contour),
    ("G643", Smoothing::Contour),
    ("G644", Smoothing::Unbounded),
    ("G645", Smoothing::Contour),
];
const COMPRESSING: [&str; 4] = ["COMPCAD", "COMPON", "COMPCURV", "COMPSURF"];
/// Kinds of machining by which CYCLE832 ends.
const CYCLE_ENDS: [&str; 2] = ["0", "_OFF"];

/// The path mode stated so far.
#[derive(Debug, Default)]
pub(super) struct PathMode {
    /// Line and path tolerance, mm; infinite if unbounded.
    is: Option<(usize, f64)>,
    /// SINUMERIK: how corners are rounded, whether rows are compressed, and the tolerances stated: CTOL, ADIS and of CYCLE832.
    smooths: Option<Smoothing>,
    compresses: bool,
    contour: Option<f64>,
    distance: Option<f64>,
    cycle: Option<f64>,
    /// Lines and tolerances in effect during moves.
    used: Vec<(usize, f64)>,
}

impl PathMode {
    /// Reads a block; `scale` is millimetres per unit of the program.
    ///
    /// # Errors
    /// [`Refusal`] at two path modes in one block, where LinuxCNC stops.
    pub(super) fn block(
        &mut self,
        line: usize,
        block: &str,
        control: Option<Controller>,
        scale: f64,
    ) -> Result<(), Refusal> {
        let block = block.to_ascii_uppercase();
        match control {
            Some(Controller::Sinumerik) => self.sinumerik(line, &block, scale),
            Some(Controller::Fanuc | Controller::Heidenhain | Controller::Grbl) => {}
            Some(Controller::LinuxCnc | Controller::Mach3) | None => {
                let modes = ["G61", "G61.1", "G64"].iter().filter(|word| has_word(&block, word)).count();
                if modes > 1 {
                    return Err(at_line(line, "two path modes in a block (G61, G61.1, G64)"));
                }
                let exact = ["G61", "G61.1"].iter().any(|word| has_word(&block, word));
                if exact && control.is_some() {
                    self.is = Some((line, 0.0));
                } else if has_word(&block, "G64") {
                    self.is = Self::blended(&block, control).map(|within| (line, scale * within)).or(self.is);
                }
            }
        }
        Ok(())
    }

    /// The tolerance of a G64 of LinuxCNC in its unit: P, and Q, which joins short moves that lie within it. A P of 0 is none.
    fn blended(block: &str, control: Option<Controller>) -> Option<f64> {
        let behind = |letter: char| {
            let mut found = block.split(letter).skip(1);
            let first = number(found.next()?);
            // Given twice it is an error of the control.
            if found.next().is_some() { None } else { first }
        };
        let stated = behind('P').filter(|rounds| *rounds > 0.0).map(|rounds| rounds.max(behind('Q').unwrap_or(0.0)));
        match control {
            // Constant velocity, by its set-up.
            Some(Controller::Mach3) => Some(f64::INFINITY),
            Some(_) => stated.or(Some(f64::INFINITY)),
            None => stated,
        }
    }

    /// Takes a tolerance, mm; without one that of the machine builder, which the program does not know, follows one that was stated.
    pub(super) fn keeps_within(&mut self, line: usize, tolerance: Option<f64>) {
        self.is = tolerance.or(self.is.map(|_| f64::INFINITY)).map(|tolerance| (line, tolerance));
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
        let has = |word: &str| has_word(block, word);
        let words = SMOOTHING.iter().map(|(word, _)| *word).chain(COMPRESSING);
        if !words.chain(["G60", "COMPOF", "CTOL", "ADIS", "CYCLE832"]).any(has) {
            return;
        }
        if let Some(words) = after(block, "CYCLE832") {
            self.cycle832(words, scale);
        }
        // One below 0 takes the tolerance back, and what is no number is not known.
        let stated = |word: &str, own: Option<f64>| match after(block, word) {
            Some(rest) => number(rest).filter(|number| *number >= 0.0).map(|number| scale * number),
            None => own,
        };
        (self.contour, self.distance) = (stated("CTOL", self.contour), stated("ADIS", self.distance));
        let exact = has("G60");
        let smooths = SMOOTHING.iter().find(|(word, _)| has(word)).map(|(_, how)| *how);
        self.smooths = smooths.or(self.smooths.filter(|_| !exact));
        self.compresses = COMPRESSING.into_iter().any(has) || (self.compresses && !has("COMPOF"));
        let is_exact = exact || self.is.is_some_and(|own| own.1 == 0.0);
        self.is = self.within().or(is_exact.then_some(0.0)).map(|within| (line, within));
    }

    /// `CYCLE832(0.01, _FINISH, 1)`: a tolerance and the kind of machining. Without a tolerance the cycle ends, and the control with its
    /// tolerances is as its builder set it.
    fn cycle832(&mut self, words: &str, scale: f64) {
        let within = number(words).filter(|number| *number > 0.0);
        let kind = words.split([',', ')']).nth(1).unwrap_or_default().trim();
        self.cycle = within.filter(|_| !CYCLE_ENDS.contains(&kind)).map(|number| scale * number);
        if self.cycle.is_none() {
            (self.contour, self.distance, self.compresses) = (None, None, false);
        }
        self.smooths = Some(if self.cycle.is_some() { Smoothing::Cycle } else { Smoothing::Unbounded });
    }

    /// By how much the control may leave its path, mm; `None` where it neither rounds nor compresses.
    fn within(&self) -> Option<f64> {
        let contour = self.contour.into_iter().chain(self.distance).reduce(f64::max);
        let rounding = self.smooths.map(|how| match how {
            // The compressor then rounds within its own tolerance.
            Smoothing::Unbounded if self.compresses => self.contour.or(self.cycle),
            Smoothing::Unbounded => None,
            Smoothing::Distance => self.distance,
            Smoothing::Contour => contour,
            Smoothing::Cycle => self.cycle,
        });
        let compressing = self.compresses.then(|| self.contour.or(self.cycle));
        let bounds = rounding.into_iter().chain(compressing);
        bounds.map(|within| within.unwrap_or(f64::INFINITY)).reduce(f64::max)
    }
}

/// The number after a word, in parentheses or after `=`.
fn number(rest: &str) -> Option<f64> {
    let rest = rest.trim_start_matches(['(', '=', ' ']);
    let end = rest.find(|c: char| !(c.is_ascii_digit() || ['.', '+', '-'].contains(&c))).unwrap_or(rest.len());
    let (digits, behind) = rest.split_at_checked(end)?;
    // A formula goes on behind its first number.
    if behind.trim_start().starts_with(['*', '/', '+', '-', '[']) { None } else { digits.parse().ok() }
}
