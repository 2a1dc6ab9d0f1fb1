//! Whose words a program is written in, and the words that move, turn, mirror or scale the profile.

use super::words::{at_line, unquoted};
use crate::machine::Controller;
use crate::refusal::Refusal;

/// Lines in which a program says for which control it is.
const HEAD: usize = 40;
/// Words that move, turn, mirror or scale what a program says, or that take its coordinates in another way.
const MOVING: [(&str, &str); 32] = [
    ("G10", "writes offsets of the control (G10)"),
    ("G12", "makes the control calculate with a rotary axis (G12)"),
    ("G12.1", "makes the control calculate with a rotary axis (G12.1)"),
    ("G112", "makes the control calculate with a rotary axis (G112)"),
    ("TRANSMIT", "makes the control calculate with a rotary axis (TRANSMIT)"),
    ("TRACYL", "makes the control calculate with a rotary axis (TRACYL)"),
    ("G7", "makes X a diameter (G7)"),
    ("DIAMON", "makes X a diameter (DIAMON)"),
    ("G16", "makes the coordinates polar (G16)"),
    ("G41.1", "keeps the cutter on its left by a radius of its own (G41.1)"),
    ("G42.1", "keeps the cutter on its right by a radius of its own (G42.1)"),
    ("G43.1", "moves the tool by an offset of its own (G43.1)"),
    ("G43.4", "turns the tool (G43.4)"),
    ("G43.5", "turns the tool (G43.5)"),
    ("G51", "scales the profile (G51)"),
    ("G51.1", "mirrors the profile (G51.1)"),
    ("G68", "turns the profile (G68)"),
    ("G68.2", "tilts the plane (G68.2)"),
    ("G92", "moves the datum (G92)"),
    ("G92.3", "moves the datum by what was stored (G92.3)"),
    ("G45", "lengthens moves by an offset (G45)"),
    ("G46", "shortens moves by an offset (G46)"),
    ("G47", "lengthens moves by an offset (G47)"),
    ("G48", "shortens moves by an offset (G48)"),
    ("G291", "goes on in the words of another control (G291)"),
    ("TOROT", "turns the profile with the tool (TOROT)"),
    ("TOROTX", "turns the profile with the tool (TOROTX)"),
    ("TOROTY", "turns the profile with the tool (TOROTY)"),
    ("TOROTZ", "turns the profile with the tool (TOROTZ)"),
    ("TOFRAME", "turns the profile with the tool (TOFRAME)"),
    ("PAROT", "turns the profile with the part (PAROT)"),
    ("TRACON", "makes the control calculate with a rotary axis (TRACON)"),
];
/// Words of SINUMERIK that change the cut by the number that is assigned to them.
const ASSIGNED: [(&str, &str); 8] = [
    ("OFFN", "leaves an allowance on the profile (OFFN)"),
    ("TOFFR", "changes the radius of the tool (TOFFR)"),
    ("TOFFL", "changes the length of the tool (TOFFL)"),
    ("TOFFLR", "changes the length and the radius of the tool (TOFFLR)"),
    ("TOFF", "changes the length of the tool (TOFF)"),
    ("DL", "changes the tool by an offset of its place (DL)"),
    ("TCARR", "turns the tool with its carrier (TCARR)"),
    ("RNDM", "rounds the corners of the profile (RNDM)"),
];
/// The frames of SINUMERIK; alone in a block such a word ends all of them.
const FRAMES: [(&str, &str); 12] = [
    ("TRANS", "moves the profile (TRANS)"),
    ("ATRANS", "moves the profile (ATRANS)"),
    ("ROT", "turns the profile (ROT)"),
    ("AROT", "turns the profile (AROT)"),
    ("ROTS", "turns the profile (ROTS)"),
    ("AROTS", "turns the profile (AROTS)"),
    ("SCALE", "scales the profile (SCALE)"),
    ("ASCALE", "scales the profile (ASCALE)"),
    ("MIRROR", "mirrors the profile (MIRROR)"),
    ("AMIRROR", "mirrors the profile (AMIRROR)"),
    ("CYCLE800", "tilts the plane (CYCLE800)"),
    ("GEOAX", "exchanges axes (GEOAX)"),
];

/// The control that a program is for: by its name in a comment, by words that only one of them has, by the number (`O0001`, `:0001`) or the name (`<CAM>`) with which a
/// program for FANUC begins, or else that of its design.
pub(super) fn dialect(text: &str, design: Option<Controller>) -> Option<Controller> {
    let mut blocks = behind_its_start(text)
        .lines()
        .map(|line| line.trim().to_ascii_uppercase())
        .filter(|line| !line.is_empty() && line != "%");
    let head: Vec<String> = blocks.by_ref().take(HEAD).collect();
    let has = |words: &[&str]| head.iter().any(|line| words.iter().any(|word| after(line, word).is_some()));
    let numbered = |line: &String| {
        let number = line.strip_prefix(['O', ':']).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
        let subroutine = [" SUB", " CALL"].iter().any(|word| line.ends_with(word));
        (number && !subroutine) || (line.starts_with('<') && line.contains('>'))
    };
    // Their words are those of LinuxCNC: camgen names them in a comment.
    let named = [("CONTROL: GRBL", Controller::Grbl), ("CONTROL: MACH3", Controller::Mach3)];
    if let Some((_, control)) = named.iter().find(|(name, _)| head.iter().any(|line| line.contains(name))) {
        Some(*control)
    } else if has(&["G91.1", "G90.1"]) {
        let alike = design.filter(|design| matches!(design, Controller::Grbl | Controller::Mach3));
        alike.or(Some(Controller::LinuxCnc))
    } else if has(&["G710", "G700", "G71", "G70"]) {
        Some(Controller::Sinumerik)
    } else if head.first().is_some_and(numbered) {
        Some(Controller::Fanuc)
    } else {
        design
    }
}

/// What a block does to the profile, in words of letters and numbers or of SINUMERIK; `None` where it does nothing to it.
pub(super) fn moves_the_profile(block: &str, control: Option<Controller>) -> Option<&'static str> {
    let block = block.to_ascii_uppercase();
    let found = |(word, what): &(&str, &'static str)| Some((*what, after(&block, word)?));
    if let Some((what, _)) = MOVING.iter().find_map(found) {
        return Some(what);
    }
    // Shifts of 0 shift nothing.
    let zero = |shift: &str| {
        shift.split(|c: char| c.is_ascii_alphabetic()).skip(1).all(|number| number.trim().parse() == Ok(0.0))
    };
    if let Some((what, rest)) = FRAMES.iter().find_map(found) {
        let ends = ["", "()"].contains(&rest.trim()) || (what.contains("TRANS") && zero(rest));
        return (!ends).then_some(what);
    }
    let assigns = |(word, what): &(&str, &'static str)| {
        let (_, number) = after(&block, word)?.split_once('=')?;
        (number.split_ascii_whitespace().next()?.parse() != Ok(0.0)).then_some(*what)
    };
    if let Some(what) = ASSIGNED.iter().find_map(assigns) {
        return Some(what);
    }
    if control.is_none_or(|control| control == Controller::LinuxCnc) && has_word(&block, "M61") {
        return Some("takes the data of a tool that it does not change in (M61)");
    }
    if writes_variable(&block, control) {
        return Some("writes a variable of the control, in which its offsets may be");
    }
    let shift = after(&block, "G52")?;
    (!zero(shift)).then_some("moves the datum (G52)")
}

/// Whether a SINUMERIK block has no effect on the path: it shows a message, ends a shift, rotation or scaling of the coordinates, or states by CYCLE832 what the
/// path mode has read.
pub(super) fn is_nothing(block: &str, control: Option<Controller>) -> bool {
    let upper = block.to_ascii_uppercase();
    let block = behind_its_number(&upper).trim_end();
    // Nothing stands behind its parenthesis.
    let states = |word: &&str| block.starts_with(*word) && unquoted(block).find(')') == Some(unquoted(block).len() - 1);
    control == Some(Controller::Sinumerik) && (ends_frames(block) || ["MSG(", "CYCLE832("].iter().any(states))
}

/// Whether a SINUMERIK block ends all frames: one of their words alone.
pub(super) fn ends_frames(block: &str) -> bool {
    let upper = block.to_ascii_uppercase();
    let block = behind_its_number(&upper).trim_end();
    let ends =
        |(word, _): &(&str, &str)| block.strip_prefix(word).is_some_and(|rest| ["", "()"].contains(&rest.trim()));
    FRAMES.iter().any(ends)
}

/// A block without its number.
pub(super) fn behind_its_number(block: &str) -> &str {
    let number = block.strip_prefix(['N', 'n']).map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    number.map_or(block, str::trim_start)
}

/// Refuses a comment by which LinuxCNC stops with an error: `(ABORT, text)`.
pub(super) fn not_aborted(line: usize, block: &str, control: Option<Controller>) -> Result<(), Refusal> {
    let mut comments = block.split('(').skip(1).map(|comment| comment.trim_start().to_ascii_uppercase());
    let reads_comments = matches!(control, Some(Controller::LinuxCnc) | None);
    if reads_comments && comments.any(|comment| comment.starts_with("ABORT,")) {
        return Err(at_line(line, "LinuxCNC stops here with an error (ABORT)"));
    }
    Ok(())
}

/// Whether a block writes a variable of the control rather than of the program: `#5221=1`, `$TC_DP6[1,1]=4`.
fn writes_variable(block: &str, control: Option<Controller>) -> bool {
    if block.contains("$P_") {
        return true;
    }
    let Some((written, _)) = block.split_once('=') else { return false };
    // FANUC has them from 1000 on, LinuxCNC from 5000 on.
    let first = if control == Some(Controller::Fanuc) { 1000 } else { 5000 };
    let number = written.rsplit('#').next().unwrap_or_default().trim();
    let system = number.starts_with('[') || number.parse::<u32>().is_ok_and(|number| number >= first);
    written.contains('$') || (written.contains('#') && system)
}

/// A block in which SINUMERIK's words for a place of the machine, for numbers and for the end of a subprogram are those of the other controls:
/// `SUPA` is G53, `X=10` X10, `CR=5` R5, `RET` and `M17` M30.
pub(super) fn in_common_words(block: &str, control: Option<Controller>) -> String {
    if control != Some(Controller::Sinumerik) {
        return block.to_owned();
    }
    let upper = block.to_ascii_uppercase();
    let named = [("SUPA", "G53"), ("G153", "G53"), ("RET", "M30"), ("M17", "M30")]
        .into_iter()
        .find(|(word, _)| has_word(&upper, word));
    let mut plain = named.map_or(upper.clone(), |(word, common)| upper.replacen(word, common, 1));
    for (word, letter) in [("CR", "R"), ("X", "X"), ("Y", "Y"), ("Z", "Z"), ("I", "I"), ("J", "J"), ("F", "F")] {
        let Some(rest) = after(&plain, word).and_then(|rest| rest.trim_start().strip_prefix('=')) else { continue };
        // A formula or a word behind the number stays what it is: not known.
        let number = rest.split_ascii_whitespace().next().unwrap_or_default();
        if number.parse().is_ok_and(|number: f64| number.is_finite()) {
            let before = plain.len() - after(&plain, word).map_or(0, str::len) - word.len();
            let kept = plain.get(..before).unwrap_or_default();
            plain = format!("{kept}{letter}{rest}");
        }
    }
    // The path mode has read these.
    for word in ["CTOL", "ADIS"] {
        let Some(rest) = after(&plain, word).and_then(|rest| rest.trim_start().strip_prefix('=')) else { continue };
        let behind = rest.trim_start().trim_start_matches(|c: char| c.is_ascii_digit() || ".+-".contains(c));
        let before = plain.len() - after(&plain, word).map_or(0, str::len) - word.len();
        plain = format!("{}{behind}", plain.get(..before).unwrap_or_default());
    }
    plain.trim().to_owned()
}

/// What stands behind the first `%` of a program for FANUC, which reads nothing before it.
pub(super) fn behind_its_start(text: &str) -> &str {
    let mut at = 0;
    for whole in text.split_inclusive('\n') {
        at += whole.len();
        let rest = text.get(at..).unwrap_or_default();
        if whole.trim() == "%" {
            let name = rest.trim_start();
            let numbered =
                name.strip_prefix(['O', 'o', ':']).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
            return if numbered || (name.starts_with('<') && name.contains('>')) { rest } else { text };
        }
    }
    text
}

/// Whether a block has a word.
pub(super) fn has_word(block: &str, word: &str) -> bool {
    after(block, word).is_some()
}

/// What follows a word in a block, where the block has it as a word of its own.
pub(super) fn after<'b>(block: &'b str, word: &str) -> Option<&'b str> {
    let is_code = word.starts_with(['G', 'M']) && word.as_bytes().get(1).is_some_and(u8::is_ascii_digit);
    block.match_indices(word).find_map(|(at, _)| {
        let (before, rest) = (block.get(..at)?, block.get(at + word.len()..)?);
        let begins = !before.ends_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        let goes_on =
            |c: char| if is_code { c.is_ascii_digit() || c == '.' } else { c.is_ascii_alphanumeric() || c == '_' };
        (begins && !rest.starts_with(goes_on)).then_some(rest)
    })
}

/// What a block of the dialogue does that is not seen in it: it goes elsewhere, writes data of the control, or makes the feed another.
pub(super) fn does_unseen_in_a_dialogue(words: &[&str]) -> Option<&'static str> {
    let joined = words.concat();
    let function = joined.strip_prefix("FN").and_then(|rest| rest.split(':').next()?.parse::<u32>().ok());
    match (words, function) {
        (_, Some(9..=12)) | (["IF" | "GOTO", ..], _) => Some("jumps to a label (FN 9 to FN 12)"),
        (_, Some(17)) => Some("writes data of the control (FN 17)"),
        (["CALL", ..] | ["CYCL", "CALL", ..] | ["SEL", "PGM" | "CONTOUR" | "PATTERN", ..], _) => {
            Some("calls a program, a label or a cycle")
        }
        (["CYCL", "DEF", cycle, ..], _) if cycle.split('.').next() == Some("12") => {
            Some("calls a program (CYCL DEF 12)")
        }
        _ if words.iter().any(|word| ["M89", "M99"].contains(word)) => Some("calls a cycle (M89, M99)"),
        _ if words.contains(&"M136") => Some("has its feeds by the turn of the spindle (M136)"),
        _ => None,
    }
}

/// What a block of the dialogue does to the profile; `None` where it does nothing to it, or takes such a change back.
pub(super) fn moves_the_profile_of_a_dialogue(words: &[&str]) -> Option<&'static str> {
    // A shift of 0, an angle of 0, a factor of 1.
    let nothing = |neutral: f64, word: &str| {
        let number = word.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let name_of_factor = number.is_empty() && neutral == 1.0;
        name_of_factor || number.parse() == Ok(neutral)
    };
    match words {
        ["CYCL", "DEF", cycle, rest @ ..] => {
            let (number, line) = cycle.split_once('.').unwrap_or((cycle, "1"));
            let (what, neutral) = match number {
                "7" => ("moves the datum (CYCL DEF 7)", 0.0),
                "8" => ("mirrors the profile (CYCL DEF 8)", 0.0),
                "10" => ("turns the profile (CYCL DEF 10)", 0.0),
                "11" | "26" => ("scales the profile (CYCL DEF 11, 26)", 1.0),
                "19" => ("tilts the plane (CYCL DEF 19)", 0.0),
                "27" | "28" | "39" => ("wraps the profile round a cylinder (CYCL DEF 27, 28, 39)", 0.0),
                _ => return None,
            };
            (line != "0" && !rest.iter().all(|word| nothing(neutral, word))).then_some(what)
        }
        ["PLANE", "RESET", rest @ ..] if rest.iter().any(|word| ["TURN", "MOVE"].contains(word)) => {
            Some("turns the axes of the machine (PLANE RESET TURN, MOVE)")
        }
        ["PLANE" | "TRANS", "RESET", ..]
        | ["TRANS", "DATUM", "RESET", ..]
        | ["FUNCTION", "RESET", "TCPM"]
        | ["FUNCTION", "MODE", "MILL"] => None,
        ["PLANE", ..] => Some("tilts the plane (PLANE)"),
        ["TRANS", "DATUM", "AXIS", rest @ ..] if rest.iter().all(|word| nothing(0.0, word)) => None,
        ["TRANS", ..] => Some("moves, mirrors, turns or scales the profile (TRANS)"),
        ["FUNCTION", ..] => Some("changes how the control moves its tool (FUNCTION)"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_the_profile_is_known_and_what_ends_that_is_not_taken_for_it() {
        let moving = [
            "G68 X0 Y0 R1",
            "g51x0y0p2",
            "G51.1 X0",
            "G92 X0 Y0",
            "G52 X1.5 Y0",
            "G10 L2 P1 X1",
            "TRANS X10",
            "AROT Z5",
            "ROT RPL=3",
            "SCALE X2",
            "MIRROR X0",
            "N5 ATRANS Y=3",
            "G17 G16",
            "DIAMON",
            "CYCLE800(1,\"TC\")",
            "G92.3",
            "M61 Q2",
            "m61q2",
            "OFFN=0.3",
            "TOFFR=0.3",
            "TOFFL[1] = -1",
            "DL=1",
            "N10 $TC_DP6[1,1]=4",
            "GEOAX(1,Y,2,X)",
            "TOROT",
            "TCARR=1",
            "N5 #5221=3",
            "#[5220+1]=3",
        ];
        for block in moving {
            assert!(moves_the_profile(block, None).is_some(), "{block}");
        }
        for block in [
            "G69",
            "G50",
            "G50.1",
            "G15",
            "TRANS",
            "ROT",
            "MIRROR",
            "G52 X0 Y0",
            "CYCLE832(0.01)",
            "G680",
            "CYCLE800()",
            "G5.1 Q1",
            "TRANSFER",
            "TRANS X0 Y0 Z0",
            "OFFN=0",
            "TCARR=0",
            "GEOAX()",
            "TOROTOF",
            "R1=$AA_IM[X]",
            "#1=5",
            "#<_depth>=3",
            "#1001=5",
            "M610",
        ] {
            assert_eq!(moves_the_profile(block, None), None, "{block}");
        }
        assert!(moves_the_profile("#1001=5", Some(Controller::Fanuc)).is_some());
        assert_eq!(moves_the_profile("M61", Some(Controller::Fanuc)), None);
        let of_dialogue = |block: &str| {
            let words: Vec<&str> = block.split_ascii_whitespace().collect();
            moves_the_profile_of_a_dialogue(&words)
        };
        for block in [
            "CYCL DEF 7.1 X+60",
            "CYCL DEF 8.1 X",
            "CYCL DEF 10.1 ROT+35",
            "CYCL DEF 11.1 SCL 0.9995",
            "CYCL DEF 11.1 SCL0.9",
            "PLANE SPATIAL SPA+0 SPB+5",
            "TRANS DATUM AXIS X+1",
            "CYCL DEF 26.1 X 0.9",
        ] {
            assert!(of_dialogue(block).is_some(), "{block}");
        }
        for block in [
            "CYCL DEF 7.0 DATUM SHIFT",
            "CYCL DEF 7.1 X+0",
            "CYCL DEF 8.1",
            "CYCL DEF 10.1 ROT+0",
            "CYCL DEF 11.1 SCL 1",
            "CYCL DEF 32.1 T0.01",
            "PLANE RESET STAY",
            "TRANS DATUM RESET",
        ] {
            assert_eq!(of_dialogue(block), None, "{block}");
        }
    }

    #[test]
    fn the_control_is_told_by_the_head_or_by_the_design() {
        use Controller::{Fanuc, LinuxCnc, Sinumerik};
        for (head, design, expected) in [
            ("%\nO0001 (A)\nG21\n", None, Some(Fanuc)),
            (":12\nG21\n", Some(LinuxCnc), Some(Fanuc)),
            ("%\n<CAM>\n", None, Some(Fanuc)),
            ("G17 G21\n", None, None),
            ("G17 G21\n", Some(Fanuc), Some(Fanuc)),
            ("%\nG17 G21G91.1\n", Some(Fanuc), Some(LinuxCnc)),
            ("; A\nG17 G710\n", Some(LinuxCnc), Some(Sinumerik)),
            ("o100 sub\n", None, None),
        ] {
            assert_eq!(dialect(head, design), expected, "{head}");
        }
    }
}
