//! The words of a block: letters with their numbers.

use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;

/// A word: its letter in capitals, and its number.
pub(super) type Word = (char, f64);
/// The words whose numbers FANUC counts in its least increments where they have no decimal point.
const COUNTED: &str = "XYZABCIJKR";
/// The least increment of a FANUC control in its increment system IS-B.
fn increment(units: LengthUnit) -> f64 {
    match units {
        LengthUnit::Millimetre => 1e-3,
        LengthUnit::Inch => 1e-4,
    }
}

/// A refusal at a line.
pub(super) fn at_line(line: usize, what: impl Into<String>) -> Refusal {
    Refusal::new(what).at(format!("line {line}"))
}

/// G28, G30 and G53: to a reference point, or to a place of the machine.
pub(super) const REFERENCE: [f64; 3] = [28.0, 30.0, 53.0];

/// The number of a tool that is called by its name.
pub(super) const NAMED_TOOL: f64 = f64::INFINITY;

/// A block without what stands behind a semicolon or, but on SINUMERIK, in parentheses; `None` where a parenthesis is left open.
pub(super) fn without_comments(block: &str, control: Option<Controller>) -> Option<String> {
    if control == Some(Controller::Sinumerik) {
        return block.split(';').next().map(str::to_owned);
    }
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

/// A block with empty quotes.
pub(super) fn unquoted(block: &str) -> String {
    block.split('"').step_by(2).collect::<Vec<&str>>().join("\"\"")
}

/// A block whose codes are spelled in one way: `G 64`, `g064`, `G64.0` and `G+64` are `G64` for a control. What is in quotes stays.
pub(super) fn with_plain_codes(block: &str) -> String {
    let mut plain = String::with_capacity(block.len());
    let (mut rest, mut before, mut quoted) = (block, ' ', false);
    while let Some(letter) = rest.chars().next() {
        rest = rest.get(letter.len_utf8()..).unwrap_or_default();
        let goes_on = before.is_ascii_alphabetic() || before == '_';
        let begins = !quoted && !goes_on;
        quoted ^= letter == '"';
        before = letter;
        plain.push(if letter == '\t' { ' ' } else { letter });
        if !(begins && matches!(letter, 'G' | 'g' | 'M' | 'm')) {
            continue;
        }
        let number = rest.trim_start().trim_start_matches('+');
        let end = number.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(number.len());
        let Some((digits, behind)) = number.split_at_checked(end) else { continue };
        if let Ok(code) = digits.parse::<f64>() {
            plain.push_str(&code.to_string());
            rest = behind;
            before = '0';
        }
    }
    plain
}

/// The words of a block; `None` where it has something else.
pub(super) fn words(block: &str) -> Option<Vec<Word>> {
    let mut words = Vec::new();
    let mut rest = block;
    while let Some(letter) = rest.chars().next() {
        rest = rest.get(letter.len_utf8()..)?;
        if letter.is_ascii_whitespace() {
            continue;
        }
        let number = rest.trim_start();
        if let Some(name) = number.strip_prefix('=').filter(|_| letter.eq_ignore_ascii_case(&'T')) {
            let (_, behind) = name.trim_start().strip_prefix('"')?.split_once('"')?;
            words.push(('T', NAMED_TOOL));
            rest = behind;
            continue;
        }
        let end = number.find(|c: char| !(c.is_ascii_digit() || ['.', '+', '-'].contains(&c))).unwrap_or(number.len());
        let (digits, after) = (number.get(..end)?, number.get(end..)?);
        if !letter.is_ascii_alphabetic() || after.starts_with(['=', '[', '#']) {
            return None;
        }
        words.push((letter.to_ascii_uppercase(), digits.parse().ok().filter(|number: &f64| number.is_finite())?));
        rest = after;
    }
    Some(words)
}

/// Refuses a number without a decimal point that FANUC reads in its least increments (parameter 3401, DPI = 0, as delivered): `X10` is
/// 0.010 mm for it.
pub(super) fn counted(line: usize, block: &str, units: LengthUnit) -> Result<(), Refusal> {
    let mut rest = block;
    while let Some(at) = rest.find(|c: char| c.is_ascii_alphabetic()) {
        let (letter, after) = rest.split_at(at + 1);
        let letter = letter.chars().last().unwrap_or(' ').to_ascii_uppercase();
        let after = after.trim_start();
        let end = after.find(|c: char| !(c.is_ascii_digit() || ['.', '+', '-'].contains(&c))).unwrap_or(after.len());
        let (number, next) = after.split_at(end);
        // The R of a block without coordinates is no radius: G5.1 Q1 R5.
        let is_length = letter != 'R' || ['X', 'Y', 'x', 'y'].iter().any(|axis| block.contains(*axis));
        if is_length
            && COUNTED.contains(letter)
            && !number.contains('.')
            && number.parse().is_ok_and(|whole: f64| whole != 0.0)
        {
            let read = increment(units) * number.parse().unwrap_or(f64::NAN);
            let what =
                format!("{letter}{number} has no decimal point: a FANUC control reads it as {read} {}", units.symbol());
            return Err(at_line(line, what).remedy(format!("write {letter}{number}. with a point")));
        }
        rest = next;
    }
    Ok(())
}

/// The number behind a letter of a block.
pub(super) fn of(line: usize, words: &[Word], letter: char) -> Result<Option<f64>, Refusal> {
    let mut found = words.iter().filter(|(own, _)| *own == letter);
    match (found.next(), found.next()) {
        (Some(_), Some(_)) => Err(at_line(line, format!("{letter} is given twice"))),
        (found, _) => Ok(found.map(|(_, number)| *number)),
    }
}
