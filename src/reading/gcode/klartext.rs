//! Programs in the dialogue of HEIDENHAIN controls (Klartext): `L`, `CC`, `C`.

use super::machine_state::{MachineState, at_line};
use super::{CutterProgram, CutterSide, MoveKind};
use crate::refusal::Refusal;
use nalgebra::Vector2;

/// Largest feed that counts, mm/min; `FMAX` stands for more.
const FASTEST: f64 = 1e6;

/// Reads a program.
pub(super) fn read(text: &str) -> Result<CutterProgram, Refusal> {
    let (mut state, mut centre, mut ended) = (MachineState::default(), None, false);
    for (index, whole) in text.lines().enumerate() {
        let line = index + 1;
        let block = whole.split(';').next().unwrap_or_default().to_ascii_uppercase();
        let mut words: Vec<&str> = block.split_ascii_whitespace().collect();
        if words.first().is_some_and(|word| word.bytes().all(|byte| byte.is_ascii_digit())) {
            words.remove(0);
        }
        match words.as_slice() {
            _ if ended && !words.is_empty() => {
                return Err(at_line(line, "there is more behind the end of the program"));
            }
            []
            | ["BEGIN", "PGM", _, "MM"]
            | ["TOOL", "CALL", ..]
            | ["STOP" | "M0" | "M1" | "M3" | "M5" | "M6" | "M8" | "M9" | "M30" | "M2"] => {}
            ["BEGIN", "PGM", ..] => return Err(at_line(line, "the unit is not the millimetre")),
            ["END", "PGM", ..] => ended = true,
            ["CC", rest @ ..] => centre = Some(centre_of(line, rest)?),
            ["L", rest @ ..] => straight(line, rest, &mut state)?,
            ["C", rest @ ..] => round(line, rest, centre, &mut state)?,
            _ => state.unknown(line, block.trim())?,
        }
    }
    if ended { Ok(state.program()) } else { Err(Refusal::new("the program has no end (END PGM)")) }
}

fn number(line: usize, word: &str) -> Result<f64, Refusal> {
    word.parse().map_err(|_| at_line(line, format!("`{word}` is no number")))
}

fn centre_of(line: usize, words: &[&str]) -> Result<Vector2<f64>, Refusal> {
    let [x, y] = words else { return Err(at_line(line, "a centre has X and Y")) };
    match (x.strip_prefix('X'), y.strip_prefix('Y')) {
        (Some(x), Some(y)) => Ok(Vector2::new(number(line, x)?, number(line, y)?)),
        _ => Err(at_line(line, "a centre has X and Y")),
    }
}

/// The coordinates of a block, and whether it turns left where it says so; feed and side of the cutter go to the state.
#[expect(clippy::type_complexity, reason = "what a block says")]
fn coordinates(
    line: usize,
    words: &[&str],
    state: &mut MachineState,
) -> Result<([Option<f64>; 3], Option<bool>, bool), Refusal> {
    let (mut to, mut left, mut rapid) = ([None; 3], None, false);
    for word in words {
        let axis = ["X", "Y", "Z"].iter().position(|axis| word.starts_with(axis));
        match (*word, axis) {
            ("R0", _) => state.side = CutterSide::Centre,
            ("RL", _) => state.side = CutterSide::Left,
            ("RR", _) => state.side = CutterSide::Right,
            ("DR+", _) => left = Some(true),
            ("DR-", _) => left = Some(false),
            ("FMAX", _) => rapid = true,
            ("M3" | "M5" | "M8" | "M9" | "M2" | "M30", _) => {}
            (word, Some(axis)) => {
                let value = number(line, word.get(1..).unwrap_or_default())?;
                if let Some(own) = to.get_mut(axis) {
                    *own = Some(value);
                }
            }
            (word, None) => match word.strip_prefix('F') {
                Some(feed) => state.feed = Some(number(line, feed)?).filter(|feed| *feed < FASTEST),
                None => return Err(at_line(line, format!("`{word}` is not known"))),
            },
        }
    }
    Ok((to, left, rapid))
}

fn straight(line: usize, words: &[&str], state: &mut MachineState) -> Result<(), Refusal> {
    let (to, left, rapid) = coordinates(line, words, state)?;
    if left.is_some() {
        return Err(at_line(line, "a straight line does not turn (DR)"));
    }
    state.go(line, if rapid { MoveKind::Rapid } else { MoveKind::Line }, to)
}

fn round(line: usize, words: &[&str], centre: Option<Vector2<f64>>, state: &mut MachineState) -> Result<(), Refusal> {
    let (to, left, rapid) = coordinates(line, words, state)?;
    match (centre, left) {
        (Some(centre), Some(left)) if !rapid => state.go(line, MoveKind::Arc { centre, left }, to),
        (None, _) => Err(at_line(line, "an arc has no centre (CC)")),
        (_, None) => Err(at_line(line, "an arc does not say how it turns (DR+ or DR-)")),
        _ => Err(at_line(line, "an arc is to be run at FMAX")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(body: &str) -> Result<CutterProgram, Refusal> {
        read(&format!(
            "0 BEGIN PGM CAM MM\n1 L Z+5 R0 FMAX\n2 L X+10 Y+0 R0 FMAX\n3 L Z-2 F100\n{body}\n9 END PGM CAM MM\n"
        ))
    }

    #[test]
    fn a_dialogue_is_read_as_a_control_reads_it() {
        let read = program("4 CC X+0 Y+0\n5 C X-10 Y+0 DR+\n6 C X+10 Y+0 DR+ ; back").expect("a program");
        let turned: f64 =
            read.moves[1..].iter().flat_map(super::super::CutterMove::segments).map(|arc| arc.sweep()).sum();
        assert!((turned - std::f64::consts::TAU).abs() < 1e-12, "{read:?}");
        let cases = [
            ("4 C X-10 Y+0 DR+", "no centre"),
            ("4 CC X+0 Y+1\n5 C X-10 Y+0", "DR"),
            ("4 CC X+0 Y+1\n5 C X-10 Y+0.3 DR+", "circle"),
            ("4 L IX+10", "IX+10"),
            ("4 CT X+10 Y+3", "not known"),
        ];
        for (body, expected) in cases {
            assert!(program(body).is_err_and(|why| why.to_string().contains(expected)), "{body}");
        }
        assert!(super::read("0 BEGIN PGM CAM INCH\n1 END PGM CAM INCH\n").is_err());
        assert!(super::read("0 BEGIN PGM CAM MM\n").is_err());
    }
}
