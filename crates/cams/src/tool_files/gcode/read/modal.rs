//! What holds in a program of letters and numbers until another word of its group is read, for a cutter that moves about a part and for a cam that is turned
//! under its tool; and the blocks that are passed over because they are the shop's own.

use super::CutterSide;
use super::cutting_state::{CuttingState, Spindle, whole};
use super::dialect::{behind_its_number, has_word};
use super::tool_length::{LengthWords, ToolChange, of_another_kind};
use super::words::{NAMED_TOOL, REFERENCE, Word, at_line, of, unquoted, words};
use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;

/// What holds until another word of the group is read.
#[derive(Debug, Default)]
pub(super) struct ModalWords {
    /// G0 to G3.
    pub(super) motion: Option<u32>,
    /// Where the control keeps the cutter.
    pub(super) side: CutterSide,
    /// Feed as it was read, or by the time of a block, 1/min.
    feed: Option<f64>,
    /// Whether each block has its time (G93).
    pub(super) by_time: bool,
    /// The control, where it is known.
    pub(super) control: Option<Controller>,
    /// Whether a block was read, and whether the last one was.
    pub(super) begun: bool,
    pub(super) ended: bool,
    plane: bool,
    /// The unit of lengths, once it is stated.
    units: Option<LengthUnit>,
    absolute: bool,
    /// Whether the cam is turned under its tool.
    turned: bool,
    /// The tool that was called, whether it was changed in, and the number of the offset with its radius.
    tool: Option<f64>,
    changed: bool,
    offset: Option<f64>,
    /// The tool in the spindle.
    loaded: Option<f64>,
    length: LengthWords,
    spindle: Spindle,
    /// Speed of the spindle, 1/min.
    speed: Option<f64>,
}

/// Where a program is when a block is read.
#[derive(Debug, Clone, Copy)]
pub(super) struct Situation {
    pub(super) has_moved: bool,
    /// Whether the tool is below the upper face.
    pub(super) is_deep: bool,
}

impl ModalWords {
    pub(super) fn of(control: Option<Controller>, turned: bool) -> Self {
        Self { control, turned, length: LengthWords::of(control), ..Self::default() }
    }

    /// Takes what is modal in a block.
    pub(super) fn block(&mut self, line: usize, words: &[Word], at: Situation) -> Result<(), Refusal> {
        let refused = |what: &str| Err(at_line(line, what));
        let ways = words.iter().filter(|(letter, number)| *letter == 'G' && (0.0..=3.0).contains(number));
        if ways.count() > 1 {
            return refused("two ways to move are given (G0 to G3)");
        }
        let kept = self.side != CutterSide::Centre;
        // A block that leaves for a place of the machine may make coordinates incremental for it.
        let leaves = leaves(words);
        self.has_its_codes(line, words)?;
        for (_, number) in words.iter().filter(|(letter, number)| *letter == 'G' && !(leaves && *number == 91.0)) {
            self.set(line, 10.0 * number)?;
        }
        self.absolute &= !words.contains(&('G', 91.0));
        let feed = of(line, words, 'F')?;
        self.feed = if self.by_time { feed } else { feed.or(self.feed) };
        let change = self.tool(line, words, (at.is_deep, kept))?;
        of_another_kind(line, words)?;
        self.length.block((line, words), self.control, (change, self.loaded, at.has_moved))?;
        self.spindle(line, words)?;
        if at.is_deep && words.iter().any(|word| [('M', 4.0), ('M', 5.0), ('G', 43.0), ('G', 49.0)].contains(word)) {
            return refused("the spindle stops or turns back, or the length of the tool changes, below the upper face");
        }
        let datum = |(letter, number): &Word| *letter == 'G' && (54.0..=59.0).contains(number);
        if at.has_moved && words.iter().any(datum) {
            return refused("the datum changes after the first move");
        }
        // On a SINUMERIK these shift the datum by the coordinates that follow.
        let shifts = words.contains(&('G', 58.0)) || words.contains(&('G', 59.0));
        let coordinates = words.iter().any(|(letter, _)| "XYZAC".contains(*letter));
        if self.control == Some(Controller::Sinumerik) && shifts && coordinates {
            return refused("G58 and G59 with coordinates move the datum");
        }
        self.ended |= words.contains(&('M', 2.0)) || words.contains(&('M', 30.0));
        Ok(())
    }

    /// Refuses a code that the control does not have, and a pause without its time: it stops there.
    fn has_its_codes(&self, line: usize, words: &[Word]) -> Result<(), Refusal> {
        let (lacking, pause): (&[f64], &[char]) = match self.control {
            Some(Controller::LinuxCnc) => (NOT_OF_LINUXCNC, &['P']),
            Some(Controller::Sinumerik) => (NOT_OF_SINUMERIK, &['F', 'S']),
            Some(Controller::Fanuc) => (NOT_OF_FANUC, &['P', 'X', 'U']),
            Some(Controller::Mach3) => (NOT_OF_MACH3, &['P']),
            Some(Controller::Grbl) => {
                let lacks = |word: &&Word| word.0 == 'G' && !OF_GRBL.contains(&word.1);
                if let Some((_, code)) = words.iter().find(lacks) {
                    return Err(at_line(line, format!("grbl has no G{code} (error 20)")));
                }
                if words.contains(&('M', 6.0)) {
                    let what = "grbl has no tool change (M6, error 20)";
                    return Err(at_line(line, what).remedy("load the tool before the start: one tool a program"));
                }
                (&[], &['P'])
            }
            Some(Controller::Heidenhain) | None => return Ok(()),
        };
        if let Some((_, code)) = words.iter().find(|(letter, code)| *letter == 'G' && lacking.contains(code)) {
            return Err(at_line(line, format!("the control has no G{code}")));
        }
        if dwells(words) && !words.iter().any(|(letter, time)| pause.contains(letter) && *time >= 0.0) {
            return Err(at_line(line, "a pause (G4) without its time"));
        }
        Ok(())
    }

    /// Refuses a move before it is stated how coordinates are meant.
    pub(super) fn is_stated(&self, line: usize) -> Result<(), Refusal> {
        if self.plane && self.units.is_some() && self.absolute {
            return Ok(());
        }
        let unit = if self.control == Some(Controller::Sinumerik) { "G71" } else { "G21" };
        let stated = [(self.plane, "G17"), (self.units.is_some(), unit), (self.absolute, "G90")];
        let missing: Vec<&str> = stated.iter().filter(|(stated, _)| !stated).map(|(_, word)| *word).collect();
        let what = format!(
            "the cutter is to move before plane, unit and absolute coordinates are stated: {} is missing",
            missing.join(", ")
        );
        Err(at_line(line, what))
    }

    /// States the unit, which must stay what it is.
    fn measure(&mut self, line: usize, units: LengthUnit) -> Result<(), Refusal> {
        if self.units.is_some_and(|stated| stated != units) {
            return Err(at_line(line, "the unit changes between millimetres (G21) and inches (G20)"));
        }
        self.units = Some(units);
        Ok(())
    }

    /// The unit, that of the metric system until one is stated.
    pub(super) fn units(&self) -> LengthUnit {
        self.units.unwrap_or_default()
    }

    /// Millimetres in a unit of length of the program.
    pub(super) fn scale(&self) -> f64 {
        self.units().millimetres()
    }

    /// The feed, mm/min, or by the time of a block, 1/min.
    pub(super) fn feed_mm(&self) -> Option<f64> {
        self.feed.map(|feed| if self.by_time { feed } else { self.scale() * feed })
    }

    /// Sets what a G word holds until another is read.
    fn set(&mut self, line: usize, tenths: f64) -> Result<(), Refusal> {
        let is = |number: f64| (number - tenths).abs() < 1e-6;
        let refused = |what: &str| Err(at_line(line, what));
        match () {
            () if is(0.0) => self.motion = Some(0),
            () if is(10.0) => self.motion = Some(1),
            () if (is(20.0) || is(30.0)) && self.turned => {
                return refused("an arc (G2, G3) has no meaning on a cam that is turned");
            }
            () if is(20.0) => self.motion = Some(2),
            () if is(30.0) => self.motion = Some(3),
            () if is(170.0) => self.plane = true,
            () if is(180.0) || is(190.0) => return refused("the plane is not XY: arcs of a cam lie in G17"),
            () if is(210.0) || is(710.0) || is(7100.0) => return self.measure(line, LengthUnit::Millimetre),
            () if is(700.0) => return refused("lengths are in inches and feeds are not (G70): write G700"),
            () if is(200.0) || is(7000.0) => return self.measure(line, LengthUnit::Inch),
            () if is(900.0) => self.absolute = true,
            () if is(910.0) => return refused("coordinates become incremental (G91)"),
            () if is(901.0) => return refused("centres become absolute (G90.1)"),
            () if is(930.0) && self.turned => self.by_time = true,
            () if is(940.0) => self.by_time = false,
            () if is(930.0) || is(950.0) => return refused("the feed is not by the minute (G94)"),
            () if is(960.0) => return refused("the speed of the spindle becomes one of a surface (G96): write G97"),
            () if is(400.0) => self.side = CutterSide::Centre,
            () if (is(410.0) || is(420.0)) && self.turned => {
                return refused("the control keeps the tool beside its path (G41, G42)");
            }
            () if is(410.0) => self.side = CutterSide::Left,
            () if is(420.0) => self.side = CutterSide::Right,
            // Datum, accuracy: nothing that changes the path.
            () => {}
        }
        Ok(())
    }

    /// What a block says of the spindle. A change of the tool stops it.
    fn spindle(&mut self, line: usize, words: &[Word]) -> Result<(), Refusal> {
        if !dwells(words) {
            self.speed = of(line, words, 'S')?.or(self.speed);
        }
        if words.contains(&('M', 6.0)) && self.spindle != Spindle::Unstated {
            self.spindle = Spindle::Stopped;
        }
        let mut stated =
            words.iter().filter(|(letter, _)| *letter == 'M').filter_map(|(_, number)| Spindle::of(*number));
        self.spindle = stated.next_back().unwrap_or(self.spindle);
        Ok(())
    }

    /// With what the program cuts; whether beside its path is not said here.
    pub(super) fn cutting(&self) -> CuttingState {
        let (tool, offset) = (self.loaded.and_then(whole), self.offset.and_then(whole));
        let named = self.loaded == Some(NAMED_TOOL);
        let (length, spindle) = (self.length.is, self.spindle.at(self.speed));
        CuttingState { tool, named, offset, compensated: false, length, spindle, speed: self.speed }
    }

    /// What a block says of the tool and of the radius that is taken into account.
    fn tool(&mut self, line: usize, words: &[Word], (is_deep, kept): (bool, bool)) -> Result<ToolChange, Refusal> {
        let changes = |word: &Word| *word == ('M', 6.0) || word.0 == 'T' || word.0 == 'H';
        if is_deep && words.iter().any(changes) {
            return Err(at_line(line, "the tool changes, or its length, while it is below the upper face"));
        }
        numbers_are_whole(line, words, self.control)?;
        let offset = of(line, words, 'D')?;
        // A radius that changes on the way is a step in the cam.
        if kept
            && self.side != CutterSide::Centre
            && offset.is_some_and(|offset| offset != 0.0 && self.offset != Some(offset))
        {
            return Err(at_line(line, "the number of the radius (D) changes while the cutter is kept beside its path"));
        }
        if kept && words.contains(&('M', 6.0)) {
            return Err(at_line(line, "the tool changes while the cutter is kept beside its path"));
        }
        let called = of(line, words, 'T')?;
        if called == Some(NAMED_TOOL) && self.control.is_some_and(|control| control != Controller::Sinumerik) {
            return Err(at_line(line, "the control calls a tool by its number, not by a name (T)"));
        }
        self.tool = called.or(self.tool);
        let mut change = None;
        if words.contains(&('M', 6.0)) {
            change = Some((self.loaded, self.tool));
            self.loaded = self.tool;
            // SINUMERIK then takes the first edge.
            self.offset = self.offset.filter(|_| self.control != Some(Controller::Sinumerik));
        }
        self.changed |= self.tool.is_some_and(|tool| tool > 0.0) && words.contains(&('M', 6.0));
        self.offset = offset.or(self.offset);
        if offset == Some(0.0) && self.side != CutterSide::Centre {
            return Err(at_line(line, "D0 ends the compensation: the cutter would take its radius out of the cam"));
        }
        self.radius_is_known(line, words, kept).map(|()| change)
    }

    /// Refuses to keep the cutter beside its path by a radius that is not known.
    fn radius_is_known(&self, line: usize, words: &[Word], kept: bool) -> Result<(), Refusal> {
        let begins = words.contains(&('G', 41.0)) || words.contains(&('G', 42.0));
        let linuxcnc = self.control == Some(Controller::LinuxCnc);
        if linuxcnc && !begins && words.iter().any(|(letter, _)| *letter == 'D') {
            return Err(at_line(line, "LinuxCNC stops at D without G41 or G42").remedy("write it in the same block"));
        }
        if begins && kept && linuxcnc {
            let what = "LinuxCNC stops at G41 or G42 while the cutter is kept beside its path already";
            return Err(at_line(line, what).remedy("write G40 before it"));
        }
        if !begins || self.offset.is_some_and(|offset| offset > 0.0 && offset.fract() == 0.0) {
            return Ok(());
        }
        // LinuxCNC takes the radius of the tool in the spindle, SINUMERIK that of the first cutting edge of a tool that was changed in (machine data
        // 20270); FANUC takes D00, a radius of 0.
        let (why, known) = match self.control {
            Some(Controller::Fanuc) => ("FANUC then takes D00, a radius of 0", false),
            Some(Controller::LinuxCnc) => {
                ("LinuxCNC then takes the tool in the spindle, which the program does not change in", self.changed)
            }
            Some(Controller::Sinumerik) => {
                ("SINUMERIK then takes the tool that was changed in, and the program changes none", self.changed)
            }
            Some(Controller::Heidenhain | Controller::Grbl | Controller::Mach3) | None => {
                ("the control does not know the radius", self.changed)
            }
        };
        let zero = self.offset == Some(0.0);
        if known && !zero {
            return Ok(());
        }
        let what =
            format!("the cutter is to be kept beside its path (G41, G42) without a number of its radius (D): {why}");
        Err(at_line(line, what).remedy("write G41 D1 with the number of the offset"))
    }
}

/// Refuses a tool, a length or a radius by a number that is none of a tool: what a control makes of it is not known.
fn numbers_are_whole(line: usize, words: &[Word], control: Option<Controller>) -> Result<(), Refusal> {
    // H is no length on SINUMERIK.
    let letters = if control == Some(Controller::Sinumerik) { "TD" } else { "TDH" };
    let wrong = words.iter().find(|(letter, number)| {
        letters.contains(*letter) && *number != NAMED_TOOL && !(*number >= 0.0 && number.fract() == 0.0)
    });
    match wrong {
        None => Ok(()),
        Some((letter, number)) => {
            let what = format!("{letter}{number} is no number of a tool, of a length or of a radius");
            Err(at_line(line, what).remedy(format!("write {letter} with a whole number")))
        }
    }
}

/// Whether a block leaves for a reference point, or a place of the machine.
pub(super) fn leaves(words: &[Word]) -> bool {
    REFERENCE.iter().any(|code| words.contains(&('G', *code)))
}

/// Whether a block makes the control wait (G4): its X is a time then.
pub(super) fn dwells(words: &[Word]) -> bool {
    words.contains(&('G', 4.0))
}

/// Whether a block does nothing but stop, and switch the coolant.
pub(super) fn is_harmless(words: &[Word]) -> bool {
    words
        .iter()
        .all(|(letter, number)| *letter == 'N' || (*letter == 'M' && [0.0, 1.0, 7.0, 8.0, 9.0].contains(number)))
}

/// Codes of other controls that one of them does not have.
const NOT_OF_LINUXCNC: &[f64] =
    &[9.0, 15.0, 44.0, 50.0, 60.0, 62.0, 69.0, 641.0, 642.0, 643.0, 644.0, 645.0, 700.0, 710.0];
const NOT_OF_SINUMERIK: &[f64] =
    &[15.0, 43.0, 43.2, 44.0, 49.0, 50.0, 50.1, 61.0, 61.1, 69.0, 80.0, 92.1, 92.2, 98.0, 99.0];
const NOT_OF_MACH3: &[f64] = &[9.0, 44.0, 60.0, 62.0, 641.0, 642.0, 643.0, 644.0, 645.0, 700.0, 710.0];
/// All codes of grbl 1.1 (its README, "Supported G-Codes in v1.1").
const OF_GRBL: &[f64] = &[
    0.0, 1.0, 2.0, 3.0, 4.0, 17.0, 18.0, 19.0, 20.0, 21.0, 28.0, 30.0, 40.0, 49.0, 53.0, 54.0, 55.0, 56.0, 57.0, 58.0,
    59.0, 61.0, 80.0, 90.0, 91.0, 91.1, 92.0, 92.1, 93.0, 94.0,
];
const NOT_OF_FANUC: &[f64] = &[60.0, 92.2, 641.0, 642.0, 643.0, 644.0, 645.0, 700.0, 710.0];

/// Codes in tenths whose effect on the path is known: G91.1 is 911.
const KNOWN: [f64; 55] = [
    0.0, 10.0, 20.0, 30.0, 170.0, 180.0, 190.0, 200.0, 210.0, 400.0, 410.0, 420.0, 700.0, 710.0, 7000.0, 7100.0, 900.0,
    901.0, 910.0, 911.0, 930.0, 940.0, 950.0, 90.0, 540.0, 550.0, 560.0, 570.0, 580.0, 590.0, 600.0, 610.0, 611.0,
    640.0, 430.0, 432.0, 440.0, 490.0, 690.0, 500.0, 501.0, 800.0, 960.0, 970.0, 980.0, 990.0, 150.0, 620.0, 921.0,
    922.0, 6410.0, 6420.0, 6430.0, 6440.0, 6450.0,
];

/// Whether the effect of all words of a block on the path is known; of a cam that is turned about an axis that of its letter, too.
pub(super) fn are_known(words: &[Word], axis: Option<char>) -> bool {
    // G64 P0.01 is how exactly the control follows its path, G4 P1 a pause.
    let exactly = words.iter().any(|word| [('G', 64.0), ('G', 61.1)].contains(word));
    let waits = dwells(words);
    let moves = words.iter().any(|(letter, number)| *letter == 'G' && (0.0..=3.0).contains(number));
    let known = |(letter, number): &Word| match letter {
        // To a reference point, or to a place of the machine.
        'G' if REFERENCE.contains(number) => true,
        'G' if *number == 4.0 => !moves,
        'G' => KNOWN.iter().any(|known| (known - 10.0 * number).abs() < 1e-6),
        'M' => number.fract() == 0.0 && ((0.0..=9.0).contains(number) || *number == 30.0),
        // The radius of an arc.
        'R' => axis.is_none(),
        'P' | 'Q' => exactly || waits,
        'U' => waits,
        'N' | 'O' | 'T' | 'D' | 'S' | 'F' | 'X' | 'Y' | 'Z' | 'I' | 'J' | 'H' => true,
        letter => axis == Some(*letter),
    };
    words.iter().all(known)
}

/// G codes that may stand in a block with unknown words: they neither move nor say how coordinates and feeds are meant. High-speed machining, ends of
/// shifts, mirrors and scaling, datums, stored limits, the path mode, and how a control goes to a profile.
const PASSED: [f64; 45] = [
    4.0, 5.0, 5.1, 8.0, 9.0, 13.1, 15.0, 22.0, 23.0, 25.0, 26.0, 50.0, 50.1, 52.0, 54.0, 54.1, 55.0, 56.0, 57.0, 58.0,
    59.0, 59.1, 59.2, 59.3, 60.0, 61.0, 61.1, 62.0, 64.0, 67.0, 69.0, 80.0, 92.1, 92.2, 97.0, 98.0, 99.0, 113.0, 187.0,
    290.0, 450.0, 451.0, 601.0, 602.0, 603.0,
];

/// Whether a G code may stand in a block with unknown words.
fn is_passed(code: f64) -> bool {
    // Datums and smoothing of SINUMERIK.
    PASSED.contains(&code) || (500.0..600.0).contains(&code) || (641.0..646.0).contains(&code)
}

/// Words that call other programs, go elsewhere in this one, or change how the control calculates.
const CALLS: [&str; 18] = [
    "GOTOC", "GOTOS", "CALL", "SUB", "GOTO", "GOTOF", "GOTOB", "IF", "WHILE", "FOR", "REPEAT", "LOOP", "EXTCALL",
    "PCALL", "MCALL", "TRAORI", "CYCLE81", "TRAANG",
];

/// Refuses a block that would be passed over where it has more than a shop's own words: it may do what is then not seen.
pub(super) fn passed_over(line: usize, block: &str, control: Option<Controller>) -> Result<(), Refusal> {
    let block = unquoted(&block.to_ascii_uppercase());
    let block = behind_its_number(&block).to_owned();
    let strange = words(&block).and_then(|words| words.into_iter().find(|word| !are_known(&[*word], None)));
    let strange = strange.map(|(letter, number)| format!("`{letter}{number}`"));
    let refused = |word: &str| {
        let what = match strange.as_ref().filter(|strange| !strange.contains(word)) {
            Some(strange) => format!("`{word}` stands in a block with {strange}, which is not known"),
            None => format!("`{word}` stands in a block with words that are not known"),
        };
        let remedy = "write what moves, calls a program or states coordinates in blocks of their own";
        Err(at_line(line, what).remedy(remedy))
    };
    if block.starts_with('/') {
        return refused("/");
    }
    // One that is not of zeros is refused before.
    if ["TRANS", "ATRANS"].iter().any(|word| has_word(&block, word)) {
        return Ok(());
    }
    let mut names = block.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    // The number of a block may stand behind its word without a blank.
    let calls =
        |name: &str| CALLS.contains(&name) || CALLS.contains(&name.trim_end_matches(|c: char| c.is_ascii_digit()));
    if let Some(name) = names.find(|name| calls(name)) {
        return refused(name);
    }
    if let Some(name) = subprogram(&block).filter(|_| control == Some(Controller::Sinumerik)) {
        return refused(name);
    }
    // Spindle, change of the tool, ends and calls.
    let of_machine: &[f64] = match control {
        Some(Controller::Sinumerik) => &[2.0, 3.0, 4.0, 5.0, 6.0, 17.0, 30.0],
        _ => &[2.0, 3.0, 4.0, 5.0, 6.0, 30.0, 96.0, 97.0, 98.0, 99.0, 198.0],
    };
    let mut rest = block.as_str();
    let mut before = ' ';
    while let Some(letter) = rest.chars().next() {
        rest = rest.get(letter.len_utf8()..).unwrap_or_default();
        let begins = letter.is_ascii_alphabetic() && !(before.is_ascii_alphabetic() || before == '_');
        before = letter;
        // A name rather than a letter with its number.
        if !begins || rest.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            continue;
        }
        let value = value_behind(rest);
        let lost = match letter {
            'G' => !value.is_some_and(is_passed),
            'M' => value.is_none_or(|value| of_machine.contains(&value)),
            // H is no length on SINUMERIK.
            'H' => control != Some(Controller::Sinumerik),
            letter => "XYZABCDTSUVWL".contains(letter),
        };
        if lost {
            return refused(&value.map_or_else(|| letter.to_string(), |value| format!("{letter}{value}")));
        }
    }
    Ok(())
}

/// The number behind a letter; `None` where it is a formula, or is parted by blanks, which some controls leave out and others do not.
fn value_behind(rest: &str) -> Option<f64> {
    let number = rest.trim_start().trim_start_matches('=').trim_start();
    let end = number.find(|c: char| !(c.is_ascii_digit() || ['.', '+', '-'].contains(&c))).unwrap_or(number.len());
    let (digits, behind) = number.split_at_checked(end)?;
    let goes_on = behind
        .trim_start()
        .starts_with(|c: char| c.is_ascii_digit() || ['.', '[', '=', '+', '-', '*', '/'].contains(&c));
    if goes_on { None } else { digits.parse().ok() }
}

/// Names with which a block of SINUMERIK may begin that is no call of a subprogram: dynamics, look-ahead, compressor, messages, and such as end frames.
const WORDS_OF_SINUMERIK: &str = " ACC BRISK BRISKA CDOF CDOF2 CDON CFC CFIN CFTCP COMPCAD COMPCURV COMPOF COMPON COMPSURF CUTCONOF CUTCONON CYCLE832 DEF DIAMOF DISPLOF \
    DISPLON DRFOF DRIVE DYNFINISH DYNNORM DYNPOS DYNPREC DYNROUGH DYNSEMIFIN FCUB FFWOF FFWON FIFOCTRL FLIN FNORM GEOAX GROUP_BEGIN GROUP_END KONT \
    KONTC KONTT LIMS MIRROR MSG NORM PROC ROT ROTS RTLIOF RTLION SCALE SETMS SOFT SOFTA STARTFIFO STOPFIFO STOPRE TCOABS TCOFR TOFRAMEOF TOROTOF TRAFOOF TRANS \
    WORKPIECE CYCLE800 AROT ATRANS ASCALE AMIRROR ";

/// The name that a block of SINUMERIK calls as a subprogram: one that is no word of the control, gets no number, and is no label.
fn subprogram(block: &str) -> Option<&str> {
    let mut rest = behind_its_number(block).trim_start();
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let (name, behind) = rest.split_at_checked(end.max(first.len_utf8()))?;
        // Declarations have names of their own behind them.
        if ["DEF", "PROC"].contains(&name) {
            return None;
        }
        let behind = behind.trim_start();
        let is_name = name.len() > 1 && name.bytes().take(2).all(|byte| byte.is_ascii_uppercase() || byte == b'_');
        let assigned = behind.starts_with(['=', '[', ':']);
        if is_name && !assigned && !WORDS_OF_SINUMERIK.contains(&format!(" {name} ")) {
            return Some(name);
        }
        rest = match behind.chars().next() {
            // Its arguments, and what is assigned to it.
            Some('(') => behind.split_once(')').map_or("", |(_, rest)| rest),
            Some('=' | '[') => behind.split_once(' ').map_or("", |(_, rest)| rest),
            _ => behind,
        }
        .trim_start();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_with_unknown_words_hides_nothing() {
        for block in [
            "G91 M13",
            "M13 G91",
            "G18 M13",
            "G41 D1 M13",
            "G93 M13",
            "G43 H2 M13",
            "S2000 M4 M50",
            "D0 M50",
            "G0 X10 M13",
            "/G91",
            "/ G64",
            "M98 P1000",
            "G65 P9000",
            "O<FOO> CALL",
            "G91 G641 ADIS=1",
            "G70 G642",
            "G700 CYCLE832(0.1,1)",
            "TRAORI",
            "G1 X10 Z=IC(-30) F100",
            "g20 g5.1 q1",
            "IF #1 GT 2 GOTO 10",
            "Y=5 A90",
            "Z=AC(-30)",
            "POSA[Z]=3",
            "X=IC(2)",
            "G 9 1",
            "g 9 1",
            "G[90+1]",
            "G[14]=2",
            "G#1",
            "G6.2 P3",
            "G952 F3",
            "T5 M51",
        ] {
            assert!(passed_over(1, block, None).is_err(), "{block}");
        }
        for block in ["CYCLE832", "G641 ADIS=0.1", "G5.1 Q1", "M13", "M88 P3", "SOFT", "FFWON", "G187 P3 E0.01"] {
            assert!(passed_over(1, block, None).is_ok(), "{block}");
        }
        for block in ["GOTO100", "M198 P5", "IF[1EQ1]GOTO5"] {
            assert!(passed_over(1, block, Some(Controller::Fanuc)).is_err(), "{block}");
        }
        for block in [
            "ROUGH",
            "ROUGH_SUB",
            "N20 ROUGH(1,2)",
            "_SUB",
            "RET",
            "M17",
            "L100",
            "GOTOF ENDE",
            "X=5",
            "LAB: ROUGH",
            "M8 ROUGH",
            "STOPRE ROUGH",
            "MSG(\"\") POCKET3(1)",
        ] {
            assert!(passed_over(1, block, Some(Controller::Sinumerik)).is_err(), "{block}");
        }
        for block in
            ["N10 SOFT", "FFWON COMPCAD", "MSG(\"G1 X10\")", "ENDE:", "R1=5", "SPOS=0", "CYCLE832(0.01,_FINISH,1)"]
        {
            assert!(passed_over(1, block, Some(Controller::Sinumerik)).is_ok(), "{block}");
        }
    }
}
