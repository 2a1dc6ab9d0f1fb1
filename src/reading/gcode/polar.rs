//! Programs for grinding in polar coordinates: the axis C turns the disc, X moves the wheel, Z sets its depth, and the control goes straight in C
//! and X at once, in the time that each block gives (G93).

use super::dialect::{dialect, moves_the_profile};
use super::iso::{counted, is_known, of, without_comments, words};
use super::machine_state::at_line;
use super::{CutterProgram, FASTEST};
use crate::machine::Controller;
use crate::refusal::Refusal;

/// Once round at a depth.
#[derive(Debug, Clone, PartialEq)]
pub struct PolarPass {
    /// Line of the file in which it begins.
    pub line: usize,
    /// How deep it is, mm below the upper face.
    pub depth: f64,
    /// Angle of C, degrees, and X, mm, from its start to its end.
    pub rows: Vec<[f64; 2]>,
}

/// The state of a control.
#[derive(Debug, Default)]
struct PolarState {
    motion: Option<u32>,
    stated: [bool; 3],
    by_time: bool,
    ended: bool,
    /// X, C and Z.
    at: [Option<f64>; 3],
    feed: Option<f64>,
    program: CutterProgram,
    open: Option<PolarPass>,
}

/// Whether a program moves the axis C.
pub(super) fn is_polar(text: &str) -> bool {
    let blocks = text.lines().filter_map(without_comments);
    blocks.filter_map(|block| words(block.trim())).any(|words| words.iter().any(|(letter, _)| *letter == 'C'))
}

/// Reads a program.
pub(super) fn read(text: &str, design: Option<Controller>) -> Result<CutterProgram, Refusal> {
    let control = dialect(text, design);
    let mut state = PolarState::default();
    for (index, whole) in text.lines().enumerate() {
        let line = index + 1;
        let block = without_comments(whole).ok_or_else(|| at_line(line, "a comment does not end"))?;
        let block = block.trim();
        if state.ended || block.is_empty() || block == "%" {
            continue;
        }
        if let Some(what) = moves_the_profile(block) {
            return Err(at_line(line, format!("the program {what}, and is then not the profile that it says")));
        }
        if control == Some(Controller::Fanuc) {
            counted(line, block)?;
        }
        match words(block) {
            Some(words) if words.iter().all(|word| word.0 == 'C' || *word == ('G', 93.0) || is_known(*word)) => {
                state.run(line, &words)?;
            }
            _ if state.at == [None; 3] => state.program.unknown.push(block.to_owned()),
            _ => return Err(at_line(line, format!("`{block}` is not known, and what it does to the path neither"))),
        }
    }
    match (state.ended, state.open) {
        (false, _) => Err(Refusal::new("the program has no end (M2 or M30)")),
        (true, Some(_)) => Err(Refusal::new("the program ends with the wheel at its depth")),
        (true, None) => Ok(state.program),
    }
}

impl PolarState {
    fn run(&mut self, line: usize, words: &[(char, f64)]) -> Result<(), Refusal> {
        let refused = |what: &str| Err(at_line(line, what));
        for (_, number) in words.iter().filter(|(letter, _)| *letter == 'G') {
            match (10.0 * number).round() {
                0.0 | 10.0 => self.motion = Some(u32::from(*number > 0.5)),
                20.0 | 30.0 => return refused("an arc (G2, G3) has no meaning between C and X"),
                170.0 => self.stated[0] = true,
                210.0 | 710.0 | 7100.0 => self.stated[1] = true,
                900.0 => self.stated[2] = true,
                180.0 | 190.0 => return refused("the plane is not XY"),
                200.0 | 700.0 | 7000.0 => return refused("the unit is the inch"),
                910.0 => return refused("coordinates become incremental (G91)"),
                410.0 | 420.0 => return refused("the control keeps the wheel beside its path (G41, G42)"),
                930.0 => self.by_time = true,
                940.0 | 950.0 => self.by_time = false,
                _ => {}
            }
        }
        self.ended |= words.contains(&('M', 2.0)) || words.contains(&('M', 30.0));
        let feed = of(line, words, 'F')?;
        // A time holds for its block alone.
        self.feed = if self.by_time { feed } else { feed.or(self.feed) };
        if of(line, words, 'Y')?.is_some_and(|y| y != 0.0) {
            return refused("the wheel leaves the line through the axis (Y)");
        }
        let to = ['X', 'C', 'Z'].map(|axis| of(line, words, axis));
        let [x, c, z] = to;
        let to = [x?, c?, z?];
        if to == [None; 3] { Ok(()) } else { self.go(line, to) }
    }

    fn go(&mut self, line: usize, to: [Option<f64>; 3]) -> Result<(), Refusal> {
        let refused = |what: &str| Err(at_line(line, what));
        if self.stated != [true; 3] {
            return refused(
                "the wheel is to move before plane, unit and absolute coordinates are stated (G17, G21, G90)",
            );
        }
        let before = self.at;
        for (own, new) in self.at.iter_mut().zip(to) {
            *own = new.or(*own);
        }
        let moves = [0, 1, 2].map(|axis| before[axis] != self.at[axis]);
        let below = |z: Option<f64>| z.is_some_and(|z| z < 0.0);
        let deep = below(before[2]) || below(self.at[2]);
        match self.motion {
            None => return refused("the wheel is to move, and it is not stated how (G0, G1)"),
            Some(0) if !deep => return Ok(()),
            Some(0) if !moves[0] && !moves[1] && self.at[2] > before[2] => return self.close(line),
            Some(0) => return refused("a rapid move goes below the upper face"),
            Some(_) => {}
        }
        if before.contains(&None) {
            return refused("the wheel is to cut from a place that is not known");
        }
        let fastest = if self.by_time { f64::INFINITY } else { FASTEST };
        match self.feed {
            None => return refused("the wheel is to move at a feed, or in a time, that is not given"),
            Some(feed) if !(feed > 0.0 && feed <= fastest) => {
                return Err(at_line(line, format!("the wheel is to move at F{feed}")).remedy("give a feed above 0"));
            }
            Some(_) => {}
        }
        if moves[2] && (moves[0] || moves[1]) {
            return refused("a move changes place and depth at once");
        }
        if moves[1] && !self.by_time {
            return refused("C and X move together at a feed of X alone: it needs the time of each block (G93)");
        }
        let [Some(x), Some(c), Some(z)] = self.at else { return Ok(()) };
        let [Some(from_x), Some(from_c), _] = before else { return Ok(()) };
        if !deep {
            return Ok(());
        }
        if moves[1] {
            let start = || PolarPass { line, depth: -z, rows: vec![[from_c, from_x]] };
            self.open.get_or_insert_with(start).rows.push([c, x]);
            return Ok(());
        }
        if moves[0] && self.open.as_ref().is_some_and(|pass| pass.turned() < 360.0 - SAME) {
            // Straight towards or away from the axis within a pass.
            if let Some(pass) = &mut self.open {
                pass.rows.push([c, x]);
            }
            return Ok(());
        }
        self.close(line)
    }

    /// Ends a pass, where one is open.
    fn close(&mut self, line: usize) -> Result<(), Refusal> {
        let Some(pass) = self.open.take() else { return Ok(()) };
        let ends = pass.rows.first().zip(pass.rows.last());
        let closes = ends.is_some_and(|(first, last)| (first[1] - last[1]).abs() < SAME);
        if !closes || (pass.turned() - 360.0).abs() > SAME {
            return Err(at_line(line, format!("the pass from line {} on does not close round the disc", pass.line)));
        }
        self.program.polar.push(pass);
        Ok(())
    }
}

/// Angles, degrees, and lengths, mm, that differ by less are equal.
const SAME: f64 = 1e-7;

impl PolarPass {
    /// By how much C turns, degrees.
    #[must_use]
    pub fn turned(&self) -> f64 {
        let ends = self.rows.first().zip(self.rows.last());
        ends.map_or(0.0, |(first, last)| (last[0] - first[0]).abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PROGRAM: &str = "G17 G21 G40 G90 G94\nG0 Z5.\nG0 X40. C0.\nG1 Z-2. F100\nG1 X30. F50\nG93\nG1 X31. C-90. F4.\nG1 X32. C-180. F4.\n\
                           G1 X30. C-360. F4.\nG94\nG1 X40. F300\nG0 Z5.\nM30\n";

    #[test]
    fn a_turn_of_the_disc_is_read_as_its_rows() {
        assert!(is_polar(PROGRAM) && !is_polar("G1 X1 (C1)\nCYCLE832(1)\n"));
        let found = read(PROGRAM, None).expect("a program");
        assert_eq!(found.polar.len(), 1);
        assert_eq!(found.polar[0].rows, [[0.0, 30.0], [-90.0, 31.0], [-180.0, 32.0], [-360.0, 30.0]]);
        assert_eq!(found.polar[0].depth, 2.0);
    }

    #[test]
    fn what_would_grind_otherwise_is_refused_with_its_line() {
        for (from, to, why) in [
            ("G93\n", "", "G93"),
            ("C-180. F4.", "C-180.", "not given"),
            ("C-180. F4.", "C-180. F-4.", "F-4"),
            ("X31. C-90.", "X31. C-90. Z-3.", "at once"),
            ("X30. C-360.", "X30. C-350.", "does not close"),
            ("X30. C-360.", "X30.5 C-360.", "does not close"),
            ("G1 Z-2. F100", "G0 Z-2.", "rapid"),
            ("G21", "G20", "inch"),
            ("G90", "G91", "incremental"),
            ("G0 X40. C0.", "G68 X0 Y0 R3\nG0 X40. C0.", "turns the profile"),
            ("G94\nG1 X40. F300\nG0 Z5.\n", "", "depth"),
        ] {
            let found = read(&PROGRAM.replacen(from, to, 1), None);
            assert!(found.as_ref().is_err_and(|found| found.to_string().contains(why)), "{to}: {found:?}");
        }
        let fanuc = read(&PROGRAM.replacen("X31.", "X31", 1), Some(Controller::Fanuc));
        assert!(fanuc.is_err_and(|why| why.to_string().contains("decimal point")));
    }
}
