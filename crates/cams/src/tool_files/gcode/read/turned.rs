//! Programs for a cam that is turned under its tool: the axis C turns a disc, or A a barrel, X and Y move the tool, Z sets its depth, and the control goes straight
//! in all at once, in the time that each block gives (G93).

use super::cutting_state::CuttingFeed;
use super::dialect::{dialect, in_common_words, is_nothing, moves_the_profile, not_aborted};
use super::modal::{ModalWords, Situation, are_known, dwells, leaves, passed_over};
use super::path_mode::PathMode;
use super::readiness::{PartMove, Readiness};
use super::words::{Word, at_line, counted, of, with_plain_codes, without_comments, words};
use super::{CutterProgram, FASTEST};
use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;

/// Once round at a depth.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedPass {
    /// Line of the file in which it begins.
    pub line: usize,
    /// The letter of the axis that turns.
    pub axis: char,
    /// How deep it is, mm below the upper face or the outside.
    pub depth: f64,
    /// Angle of the axis, degrees, X and Y, mm, from its start to its end.
    pub rows: Vec<[f64; 3]>,
    /// Of each row after the first its line, and how many such blocks the control would run in a minute.
    pub rates: Vec<(usize, f64)>,
}

/// A straight move below the face while the cam stands still, to a pass or away from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandingMove {
    /// Line of the file.
    pub line: usize,
    /// Angle of the axis that turns, degrees.
    pub angle: f64,
    /// X and Y of its ends, mm.
    pub ends: [[f64; 2]; 2],
}

/// Blocks in a minute that no control reads as fast, where each has its time.
const MOST_BLOCKS_A_MINUTE: f64 = 10_000.0;

/// Where the tool is.
#[derive(Debug, Default)]
struct TurnedState {
    axis: char,
    /// The angle, X, Y and Z.
    at: [Option<f64>; 4],
    has_moved: bool,
    /// Whether Y is stated: of a disc the tool is taken to stay over the axis, and the program must say so.
    beside_is_stated: bool,
    /// Where the tool went down, until a pass begins there.
    plunged: Option<usize>,
    program: CutterProgram,
    open: Option<TurnedPass>,
    /// Words stated before the moves.
    readiness: Readiness,
    path_mode: PathMode,
}

/// The axis that a program turns, C or A; `None` where it turns none.
pub(super) fn axis_of(text: &str) -> Option<char> {
    let blocks = text.lines().filter_map(|line| without_comments(line, None));
    let mut letters = blocks.filter_map(|block| words(block.trim())).flatten().map(|(letter, _)| letter);
    letters.find(|letter| ['A', 'C'].contains(letter))
}

/// Reads a program.
pub(super) fn read(text: &str, axis: char, design: Option<Controller>) -> Result<CutterProgram, Refusal> {
    let control = dialect(text, design);
    // Of a disc the tool stays over the axis.
    let beside = (axis == 'C').then_some(0.0);
    let readiness = Readiness::of(control);
    let mut state = TurnedState { axis, at: [None, None, beside, None], readiness, ..TurnedState::default() };
    state.program.control = control;
    let mut modal = ModalWords::of(control, true);
    for (index, whole) in text.lines().enumerate() {
        let line = index + 1;
        not_aborted(line, whole, control)?;
        let block = without_comments(whole, control).ok_or_else(|| at_line(line, "a comment does not end"))?;
        let plain = with_plain_codes(block.trim());
        let typed = plain.as_str();
        state.path_mode.block(line, typed, control, modal.scale())?;
        state.readiness.path_mode(&state.path_mode);
        let block = in_common_words(typed, control);
        let block = block.as_str();
        if modal.ended || block.is_empty() || block == "%" {
            continue;
        }
        if let Some(what) = moves_the_profile(block, control) {
            return Err(at_line(line, format!("the program {what}, and is then not the profile that it says")));
        }
        if is_nothing(block, control) {
            state.readiness.frames(block);
            continue;
        }
        if control == Some(Controller::Fanuc) {
            counted(line, block, modal.units())?;
        }
        match words(block) {
            Some(words) if are_known(&words, Some(axis)) => state.run(line, &words, &mut modal)?,
            found if !state.has_moved && [0, 1, 3].iter().all(|axis| state.at[*axis].is_none()) => {
                passed_over(line, block, control)?;
                state.program.unknown.push(block.to_owned());
                state.readiness.block(&found.unwrap_or_default());
            }
            _ => return Err(at_line(line, format!("`{block}` is not known, and what it does to the path neither"))),
        }
    }
    match (modal.ended, &state.open) {
        (false, _) => Err(Refusal::new("the program has no end (M2 or M30)")),
        (true, Some(_)) => Err(Refusal::new("the program ends with the tool at its depth")),
        (true, None) => {
            let (early, sets_up) = state.readiness.found();
            Ok(CutterProgram { early, sets_up, path_tolerances: state.path_mode.used(), ..state.program })
        }
    }
}

impl TurnedState {
    fn run(&mut self, line: usize, words: &[Word], modal: &mut ModalWords) -> Result<(), Refusal> {
        let refused = |what: &str| Err(at_line(line, what));
        let is_deep = self.at[3].is_some_and(|z| z < 0.0);
        let letters = [self.axis, 'X', 'Y', 'Z'];
        let away = leaves(words);
        modal.block(line, words, Situation { has_moved: self.has_moved, is_deep: is_deep && !away })?;
        self.readiness.block(words);
        if away {
            let leaves = letters.map(|axis| words.iter().any(|(letter, _)| *letter == axis));
            let axes = [leaves[0] || leaves[1], leaves[2], leaves[3]];
            self.readiness.leaves_by(line, (axes, words), self.at[3].is_some());
            if let Some(z) = of(line, words, 'Z')?.filter(|_| words.contains(&('G', 53.0))) {
                self.program.retracts_to(line, modal.scale() * z);
            }
            if is_deep && leaves != [false, false, false, true] {
                return refused("the tool leaves for a place of the machine from below the upper face");
            }
            if is_deep {
                self.rise(line)?;
            }
            for (own, _) in self.at.iter_mut().zip(leaves).filter(|(_, leaves)| *leaves) {
                *own = None;
            }
            return Ok(());
        }
        if dwells(words) {
            return Ok(());
        }
        let [angle, x, y, z] = letters.map(|axis| of(line, words, axis));
        let length = |read: Option<f64>| read.map(|number| modal.scale() * number);
        let to = [angle?, length(x?), length(y?), length(z?)];
        if self.axis == 'C' && to[2].is_some_and(|y| y != 0.0) {
            return refused("the tool leaves the line through the axis (Y)");
        }
        self.beside_is_stated |= to[2].is_some();
        if to == [None; 4] { Ok(()) } else { self.go(line, to, modal) }
    }

    fn go(&mut self, line: usize, to: [Option<f64>; 4], modal: &ModalWords) -> Result<(), Refusal> {
        let refused = |what: &str| Err(at_line(line, what));
        modal.is_stated(line)?;
        let before = self.at;
        for (own, new) in self.at.iter_mut().zip(to) {
            *own = new.or(*own);
        }
        let moves = [0, 1, 2, 3].map(|axis| before[axis] != self.at[axis]);
        let [turns, along, down] = [moves[0], moves[1] || moves[2], moves[3]];
        let below = |z: Option<f64>| z.is_some_and(|z| z < 0.0);
        let deep = below(before[3]) || below(self.at[3]);
        self.has_moved = true;
        let rises = !turns && !along && self.at[3] > before[3];
        self.relies(line, before, modal.motion == Some(0));
        if down {
            self.program.moves_with(line, modal.cutting().length);
        }
        match modal.motion {
            None => return refused("the tool is to move, and it is not stated how (G0, G1)"),
            Some(0) if !deep => return Ok(()),
            Some(0) if rises => return self.rise(line),
            Some(0) => return refused("a rapid move goes below the upper face"),
            Some(_) => {}
        }
        if before.contains(&None) {
            return refused("the tool is to cut from a place that is not known");
        }
        let fastest = if modal.by_time { MOST_BLOCKS_A_MINUTE } else { FASTEST };
        match modal.feed_mm() {
            None => return refused("the tool is to move at a feed, or in a time, that is not given"),
            Some(feed) if !(feed > 0.0 && feed <= fastest) => {
                let remedy = format!("give a feed above 0 and at most {fastest}");
                return Err(at_line(line, format!("the tool is to move at F{feed}")).remedy(remedy));
            }
            Some(_) => {}
        }
        if down && (turns || along) {
            return refused("a move changes place and depth at once");
        }
        if turns && !modal.by_time {
            let what = format!("{} moves at a feed of X alone: it needs the time of each block (G93)", self.axis);
            return Err(at_line(line, what));
        }
        if deep && !rises {
            self.cuts(line, before, modal);
        }
        match (deep, down) {
            (false, _) => Ok(()),
            (true, true) if rises => self.rise(line),
            (true, true) => {
                self.close(line)?;
                self.plunged = Some(line);
                Ok(())
            }
            (true, false) => self.cut(line, (before, modal), (turns, along)),
        }
    }

    /// Records the words that a move relies on.
    fn relies(&mut self, line: usize, before: [Option<f64>; 4], rapid: bool) {
        let below = |z: Option<f64>| z.is_some_and(|z| z < 0.0);
        self.readiness.moves(PartMove {
            line,
            rapid,
            arc: false,
            knew_place: before[..3].iter().all(Option::is_some) && self.beside_is_stated,
            knew_height: before[3].is_some(),
            across: before[..3] != self.at[..3],
            along_z: before[3] != self.at[3],
            down: self.at[3] < before[3],
            cuts: !rapid && (below(before[3]) || below(self.at[3])),
        });
        if !rapid {
            self.path_mode.moves();
        }
    }

    /// Keeps with what a move cuts, and how fast where the cam stands still; in G93 its feed is that of its length in its time.
    fn cuts(&mut self, line: usize, before: [Option<f64>; 4], modal: &ModalWords) {
        let by = |axis: usize| self.at[axis].zip(before[axis]).map_or(0.0, |(to, from)| to - from);
        let [turned, x, y, z] = [0, 1, 2, 3].map(by);
        let feed = modal.feed_mm().unwrap_or(0.0);
        let length = libm::hypot(libm::hypot(x, y), z);
        let feed = match (turned == 0.0, modal.by_time) {
            (true, true) => feed * length,
            (true, false) => feed,
            // The rows of a pass keep their own.
            (false, _) => 0.0,
        };
        // A wheel goes down beside its disc, and into it along X.
        let plunges = if self.axis == 'C' { x < 0.0 } else { z < 0.0 };
        self.program.cuts_with(line, modal.cutting(), CuttingFeed { line, feed, plunges: plunges && turned == 0.0 });
    }

    /// A move at a feed below the face.
    fn cut(
        &mut self,
        line: usize,
        (before, modal): ([Option<f64>; 4], &ModalWords),
        (turns, along): (bool, bool),
    ) -> Result<(), Refusal> {
        let [Some(angle), Some(x), Some(y), Some(z)] = self.at else { return Ok(()) };
        let [Some(from), Some(from_x), Some(from_y), _] = before else { return Ok(()) };
        let feed = modal.feed_mm().unwrap_or(0.0);
        let rate = if modal.by_time { feed } else { feed / libm::hypot(x - from_x, y - from_y) };
        if turns {
            self.plunged = None;
            let axis = self.axis;
            let start = || TurnedPass { line, axis, depth: -z, rows: vec![[from, from_x, from_y]], rates: Vec::new() };
            let pass = self.open.get_or_insert_with(start);
            pass.rows.push([angle, x, y]);
            pass.rates.push((line, rate));
            return Ok(());
        }
        if along && self.open.as_ref().is_some_and(|pass| pass.turned() < 360.0 - SAME) {
            // Straight within a pass.
            if let Some(pass) = &mut self.open {
                pass.rows.push([angle, x, y]);
                pass.rates.push((line, rate));
            }
            return Ok(());
        }
        self.close(line)?;
        if along {
            self.program.standing.push(StandingMove { line, angle, ends: [[from_x, from_y], [x, y]] });
        }
        Ok(())
    }

    /// The tool goes up, after a pass.
    fn rise(&mut self, line: usize) -> Result<(), Refusal> {
        if let Some(line) = self.plunged {
            return Err(at_line(line, "the tool goes down, and no pass begins there"));
        }
        self.close(line)
    }

    /// Ends a pass, where one is open.
    fn close(&mut self, line: usize) -> Result<(), Refusal> {
        let Some(pass) = self.open.take() else { return Ok(()) };
        let ends = pass.rows.first().zip(pass.rows.last());
        let same =
            |(first, last): (&[f64; 3], &[f64; 3])| [1, 2].iter().all(|at| (first[*at] - last[*at]).abs() < SAME);
        if !ends.is_some_and(same) || (pass.turned() - 360.0).abs() > SAME {
            return Err(at_line(line, format!("the pass from line {} on does not close round the cam", pass.line)));
        }
        self.program.turned.push(pass);
        Ok(())
    }
}

/// Angles, degrees, and lengths, mm, that differ by less are equal.
const SAME: f64 = 1e-7;

impl TurnedPass {
    /// By how much the axis turns, degrees.
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
        assert!(axis_of(PROGRAM) == Some('C') && axis_of("G1 X1 (C1)\nCYCLE832(1)\n").is_none());
        let found = read(PROGRAM, 'C', None).expect("a program");
        assert_eq!(found.turned.len(), 1);
        let rows = [[0.0, 30.0, 0.0], [-90.0, 31.0, 0.0], [-180.0, 32.0, 0.0], [-360.0, 30.0, 0.0]];
        assert_eq!(found.turned[0].rows, rows);
        assert_eq!(found.turned[0].depth, 2.0);
        let standing: Vec<_> = found.standing.iter().map(|moved| (moved.angle, moved.ends)).collect();
        assert_eq!(standing, [(0.0, [[40.0, 0.0], [30.0, 0.0]]), (-360.0, [[30.0, 0.0], [40.0, 0.0]])]);
    }

    const OF_A_BARREL: &str = "G17 G21 G40 G90 G94\nG0 Z5.\nG0 X4. Y1. A0.\nG1 Z-2. F100\nG1 X3. Y0.5 F50\nG93\nG1 X2. Y0. A90. F4.\nG1 A180. F4.\n\
                               G1 X3. Y0.5 A360. F4.\nG94\nG1 X4. Y1. F300\nG0 Z5.\nM30\n";

    #[test]
    fn a_turn_of_a_barrel_is_read_as_its_rows() {
        assert_eq!(axis_of(OF_A_BARREL), Some('A'));
        let found = read(OF_A_BARREL, 'A', None).expect("a program");
        let rows = [[0.0, 3.0, 0.5], [90.0, 2.0, 0.0], [180.0, 2.0, 0.0], [360.0, 3.0, 0.5]];
        assert_eq!(found.turned[0].rows, rows);
        assert_eq!(found.standing.len(), 2);
        for (from, to, why) in [
            ("X3. Y0.5 A360.", "X3. Y0.6 A360.", "does not close"),
            ("G0 X4. Y1. A0.", "G0 X4. A0.", "not known"),
            ("G93\n", "", "G93"),
        ] {
            let found = read(&OF_A_BARREL.replacen(from, to, 1), 'A', None);
            assert!(found.as_ref().is_err_and(|found| found.to_string().contains(why)), "{to}: {found:?}");
        }
    }

    #[test]
    fn inches_are_lengths_and_no_angles() {
        let (metric, inch) = (read(PROGRAM, 'C', None), read(&PROGRAM.replacen("G21", "G20", 1), 'C', None));
        let rows = |read: &Result<CutterProgram, Refusal>| read.as_ref().expect("a program").turned[0].rows.clone();
        let scaled: Vec<[f64; 3]> = rows(&metric).iter().map(|[angle, x, y]| [*angle, 25.4 * x, 25.4 * y]).collect();
        assert_eq!(rows(&inch), scaled);
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
            ("G21", "G70", "feeds are not"),
            ("G90", "G91", "incremental"),
            ("G0 X40. C0.", "G68 X0 Y0 R3\nG0 X40. C0.", "turns the profile"),
            ("G94\nG1 X40. F300\nG0 Z5.\n", "", "depth"),
        ] {
            let found = read(&PROGRAM.replacen(from, to, 1), 'C', None);
            assert!(found.as_ref().is_err_and(|found| found.to_string().contains(why)), "{to}: {found:?}");
        }
        let fanuc = read(&PROGRAM.replacen("X31.", "X31", 1), 'C', Some(Controller::Fanuc));
        assert!(fanuc.is_err_and(|why| why.to_string().contains("decimal point")));
    }
}
