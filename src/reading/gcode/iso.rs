//! Programs in words of a letter and a number: LinuxCNC, FANUC, SINUMERIK.

use super::machine_state::{MachineState, at_line};
use super::{CutterProgram, CutterSide, MoveKind};
use crate::refusal::Refusal;
use nalgebra::Vector2;

/// A word: its letter in capitals, and its number.
type Word = (char, f64);

/// What holds until another word of the group is read.
#[derive(Debug, Default)]
struct ModalWords {
    /// G0 to G3.
    motion: Option<u32>,
    plane: bool,
    metric: bool,
    absolute: bool,
    /// Whether a block was read, and whether the last one was.
    begun: bool,
    ended: bool,
}

/// Reads a program.
pub(super) fn read(text: &str) -> Result<CutterProgram, Refusal> {
    let (mut state, mut modal) = (MachineState::default(), ModalWords::default());
    for (index, whole) in text.lines().enumerate() {
        let line = index + 1;
        if modal.ended {
            continue;
        }
        let block = without_comments(whole).ok_or_else(|| at_line(line, "a comment does not end"))?;
        let block = block.trim();
        if block.is_empty() || (block == "%" && !modal.begun) {
            continue;
        }
        if block == "%" {
            return Err(at_line(line, "`%` ends the program for the control, before M2 or M30"));
        }
        modal.begun = true;
        match words(block) {
            Some(words) if words.iter().all(|word| is_known(*word)) => run(line, &words, &mut state, &mut modal)?,
            _ => state.unknown(line, block)?,
        }
    }
    if modal.ended { Ok(state.program()) } else { Err(Refusal::new("the program has no end (M2 or M30)")) }
}

/// A block without what stands in parentheses or behind a semicolon; `None` where a parenthesis is left open.
fn without_comments(block: &str) -> Option<String> {
    let mut depth = 0_u32;
    let mut kept = String::with_capacity(block.len());
    for character in block.chars() {
        match character {
            ';' if depth == 0 => break,
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ if depth == 0 => kept.push(character),
            _ => {}
        }
    }
    (depth == 0).then_some(kept)
}

/// The words of a block; `None` where it has something else.
fn words(block: &str) -> Option<Vec<Word>> {
    let mut words = Vec::new();
    let mut rest = block;
    while let Some(letter) = rest.chars().next() {
        rest = rest.get(letter.len_utf8()..)?;
        if letter.is_ascii_whitespace() {
            continue;
        }
        let number = rest.trim_start();
        let end = number.find(|c: char| !(c.is_ascii_digit() || ['.', '+', '-'].contains(&c))).unwrap_or(number.len());
        let (digits, after) = (number.get(..end)?, number.get(end..)?);
        if !letter.is_ascii_alphabetic() || after.starts_with(['=', '[', '#']) {
            return None;
        }
        words.push((letter.to_ascii_uppercase(), digits.parse().ok()?));
        rest = after;
    }
    Some(words)
}

/// Whether a word is one whose effect on the path is known.
fn is_known((letter, number): Word) -> bool {
    // In tenths: G91.1 is 911.
    let tenths = 10.0 * number;
    let g = [
        0.0, 10.0, 20.0, 30.0, 170.0, 180.0, 190.0, 200.0, 210.0, 400.0, 410.0, 420.0, 700.0, 710.0, 7000.0, 7100.0,
        900.0, 901.0, 910.0, 911.0, 930.0, 940.0, 950.0, 90.0, 540.0, 550.0, 560.0, 570.0, 580.0, 590.0, 600.0, 610.0,
        640.0, 490.0, 800.0,
    ];
    match letter {
        'G' => g.iter().any(|known| (known - tenths).abs() < 1e-6),
        'M' => number.fract() == 0.0 && ((0.0..=9.0).contains(&number) || number == 30.0),
        'N' | 'O' | 'T' | 'D' | 'S' | 'F' | 'X' | 'Y' | 'Z' | 'I' | 'J' | 'H' => true,
        _ => false,
    }
}

/// Does what a block says: first what is modal, then its move.
fn run(line: usize, words: &[Word], state: &mut MachineState, modal: &mut ModalWords) -> Result<(), Refusal> {
    for (_, number) in words.iter().filter(|(letter, _)| *letter == 'G') {
        set(line, 10.0 * number, state, modal)?;
    }
    let of = |letter: char| {
        let mut found = words.iter().filter(|(own, _)| *own == letter);
        match (found.next(), found.next()) {
            (Some(_), Some(_)) => Err(at_line(line, format!("{letter} is given twice"))),
            (found, _) => Ok(found.map(|(_, number)| *number)),
        }
    };
    state.feed = of('F')?.or(state.feed);
    if of('D')? == Some(0.0) && state.side != CutterSide::Centre {
        return Err(at_line(line, "D0 ends the compensation: the cutter would take its radius out of the cam"));
    }
    let datum = |(letter, number): &Word| *letter == 'G' && (54.0..=61.0).contains(number);
    if state.has_moved() && words.iter().any(datum) {
        return Err(at_line(line, "the datum changes after the first move"));
    }
    modal.ended |= words.contains(&('M', 2.0)) || words.contains(&('M', 30.0));
    let to = [of('X')?, of('Y')?, of('Z')?];
    let (i, j) = (of('I')?, of('J')?);
    if to == [None; 3] && i.is_none() && j.is_none() {
        return Ok(());
    }
    if !(modal.plane && modal.metric && modal.absolute) {
        let what = "the cutter is to move before plane, unit and absolute coordinates are stated (G17, G21, G90)";
        return Err(at_line(line, what));
    }
    let kind = match (modal.motion, state.place()) {
        (Some(0), _) => MoveKind::Rapid,
        (Some(1), _) => MoveKind::Line,
        (Some(way @ (2 | 3)), Some(place)) if i.is_some() || j.is_some() => {
            MoveKind::Arc { centre: place + Vector2::new(i.unwrap_or(0.0), j.unwrap_or(0.0)), left: way == 3 }
        }
        (Some(2 | 3), _) => return Err(at_line(line, "an arc has no centre (I, J)")),
        _ => return Err(at_line(line, "the cutter is to move, and it is not stated how (G0 to G3)")),
    };
    if (i.is_some() || j.is_some()) && !matches!(kind, MoveKind::Arc { .. }) {
        return Err(at_line(line, "a straight move has a centre (I, J)"));
    }
    state.go(line, kind, to)
}

/// Sets what a G word holds until another is read.
fn set(line: usize, tenths: f64, state: &mut MachineState, modal: &mut ModalWords) -> Result<(), Refusal> {
    let is = |number: f64| (number - tenths).abs() < 1e-6;
    let refused = |what: &str| Err(at_line(line, what));
    match () {
        () if is(0.0) => modal.motion = Some(0),
        () if is(10.0) => modal.motion = Some(1),
        () if is(20.0) => modal.motion = Some(2),
        () if is(30.0) => modal.motion = Some(3),
        () if is(170.0) => modal.plane = true,
        () if is(180.0) || is(190.0) => return refused("the plane is not XY: arcs of a cam lie in G17"),
        () if is(210.0) || is(710.0) || is(7100.0) => modal.metric = true,
        () if is(200.0) || is(700.0) || is(7000.0) => {
            return refused("the unit is the inch: camgen writes millimetres (G21)");
        }
        () if is(900.0) => modal.absolute = true,
        () if is(910.0) => return refused("coordinates become incremental (G91)"),
        () if is(901.0) => return refused("centres become absolute (G90.1)"),
        () if is(930.0) || is(950.0) => return refused("the feed is not in mm/min (G94)"),
        () if is(400.0) => state.side = CutterSide::Centre,
        () if is(410.0) => state.side = CutterSide::Left,
        () if is(420.0) => state.side = CutterSide::Right,
        // Datum, accuracy, feed in mm/min: nothing that changes the path.
        () => {}
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "G17 G21 G40 G90\n";

    fn why(body: &str) -> String {
        read(&format!("{HEAD}{body}\nM30\n")).expect_err("refused").to_string()
    }

    #[test]
    fn a_program_is_read_as_a_control_reads_it() {
        let program = format!(
            "%\nO1 (A (NESTED) NAME)\n{HEAD}n10 g0 z5 x10y0 ; a comment\nG1Z-2F100\nG3X-10I-10J0\nX10I10\nM30\nG91 X1\n"
        );
        let read = read(&program).expect("a program");
        assert_eq!(read.moves.len(), 3, "{read:?}");
        assert!(read.moves[0].is_upright() && read.moves[1].is_level());
        let turned: f64 = read.moves[1..].iter().flat_map(CutterMove::segments).map(|arc| arc.sweep()).sum();
        assert!((turned - std::f64::consts::TAU).abs() < 1e-12, "{turned}");
    }

    use super::super::CutterMove;

    #[test]
    fn what_would_move_the_cutter_otherwise_is_refused_with_its_line() {
        let start = "G0 X0 Y0 Z5\nG1 Z-1 F100\n";
        let cases = [
            ("G91\n", "G91"),
            ("G20\n", "inch"),
            ("G18\n", "plane"),
            ("G90.1\n", "absolute"),
            ("G2 X10 I5.1\n", "off its circle"),
            ("G2 X10\n", "no centre"),
            ("G1 X10 I5\n", "straight move has a centre"),
            ("G5 X10 I5\n", "not known"),
            ("G1 X=10\n", "not known"),
            ("G1 X10 X11\n", "twice"),
            ("G2 X10 I5 Z-2\n", "depth"),
        ];
        for (block, expected) in cases {
            let why = why(&format!("{start}{block}"));
            assert!(why.contains(expected) && why.contains("line 4"), "{block}: {why}");
        }
        assert!(why("G0 X0 Y0 Z5\nG1 Z-1").contains("feed"));
        assert!(why("G1 X1 F100").contains("place that is not known"));
        assert!(read("G21 G90\nG0 X1 Y1 Z1\nM30\n").is_err_and(|why| why.to_string().contains("G17")));
        assert!(read(&format!("{HEAD}G0 X1 Y1 Z1\n")).is_err_and(|why| why.to_string().contains("end")));
        let own = read(&format!("CYCLE832(0.01)\nG55\n{HEAD}G0 X1 Y1 Z1\nM30\n")).expect("passed over");
        assert_eq!(own.unknown, ["CYCLE832"]);
    }
}
