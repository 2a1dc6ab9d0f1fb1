//! The width of texts, by the metrics of the font that the sheets are set in.
//!
//! The font is Liberation Sans. Its widths are those of Arial and Helvetica, so a viewer with one of the three shows a
//! sheet as it was laid out; the PDF contains the font itself.

use std::sync::OnceLock;
use ttf_parser::Face;

/// The font file.
pub const FONT: &[u8] = include_bytes!("../../../templates/fonts/LiberationSans-Regular.ttf");
/// Size of the smallest letters of a sheet, mm: capitals of 2.5 mm (ISO 3098-1), which are this share of the size of the font.
pub const SMALLEST: f64 = 2.5 / CAPITAL;
/// Height of a capital over the size of the font.
pub const CAPITAL: f64 = 0.688;
/// Width of a letter that the font does not have, over the size: a full square, as in Chinese.
const UNKNOWN: f64 = 1.0;
/// How far letters reach above and below the base line, over the size.
pub const ASCENT: f64 = 0.75;
/// See [`ASCENT`].
pub const DESCENT: f64 = 0.22;

fn face() -> Option<&'static Face<'static>> {
    static FACE: OnceLock<Option<Face<'static>>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(FONT, 0).ok()).as_ref()
}

/// Width of a letter over the size.
fn advance(letter: char) -> f64 {
    let Some(face) = face() else { return UNKNOWN };
    let glyph = face.glyph_index(letter).and_then(|glyph| face.glyph_hor_advance(glyph));
    glyph.map_or(UNKNOWN, |advance| f64::from(advance) / f64::from(face.units_per_em()))
}

/// Width of a text of a size, in the unit of the size.
#[must_use]
pub fn width(text: &str, size: f64) -> f64 {
    size * text.chars().map(advance).sum::<f64>()
}

/// Letters of a text that the font does not have, each once.
#[must_use]
pub fn missing(text: &str) -> Vec<char> {
    let in_face = |letter: char| face().is_none_or(|face| face.glyph_index(letter).is_some());
    let has = |letter: char| letter.is_whitespace() || in_face(letter);
    let mut missing: Vec<char> = text.chars().filter(|letter| !has(*letter)).collect();
    missing.sort_unstable();
    missing.dedup();
    missing
}

/// A text in lines no wider than `room`, broken between words, and within a word that is wider than a line.
#[must_use]
pub fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let before = line.len();
        line.push_str(if before == 0 { "" } else { " " });
        line.push_str(word);
        if width(&line, size) <= room {
            continue;
        }
        line.truncate(before);
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for letter in word.chars() {
            line.push(letter);
            if width(&line, size) > room && line.chars().count() > 1 {
                line.pop();
                lines.push(std::mem::replace(&mut line, letter.to_string()));
            }
        }
    }
    if !line.is_empty() || lines.is_empty() {
        lines.push(line);
    }
    lines
}

/// Steps in which a text is made smaller until it fits.
const SMALLER: f64 = 0.93;
/// Distance of two base lines over the size.
pub const LEADING: f64 = 1.25;

/// A text in lines that fit into a field, with the size at which they do: as it is given, or smaller.
#[must_use]
pub fn fitted(text: &str, size: f64, room: f64, height: f64) -> (Vec<String>, f64) {
    let mut size = size;
    loop {
        let lines = wrapped(text, size, room);
        #[expect(clippy::cast_precision_loss, reason = "a few lines")]
        let tall = size * (ASCENT + DESCENT + LEADING * (lines.len() - 1) as f64);
        let wide = lines.iter().map(|line| width(line, size)).fold(0.0, f64::max);
        if (tall <= height && wide <= room) || size < 1e-3 {
            return (lines, size);
        }
        size *= SMALLER;
    }
}

/// A text in one line no wider than `room`, with the size at which it is: as it is given, or smaller.
#[must_use]
pub fn fitted_in_one(text: &str, size: f64, room: f64) -> (&str, f64) {
    let wide = width(text, size);
    (text, if wide > room { size * room / wide } else { size })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The advance widths of Arial: 1139 units of 2048 for a digit, 1366 for A, 569 for a space.
    #[test]
    fn widths_are_those_of_arial() {
        assert!((width("0", 2048.0) - 1139.0).abs() < 1e-9);
        assert!((width("A 0", 2048.0) - (1366.0 + 569.0 + 1139.0)).abs() < 1e-9);
        assert!(width("Пресс ДПИ", 3.0) > 0.0 && width("θφα°±⌀µ²", 3.0) < 8.0 * 3.0);
    }

    #[test]
    fn letters_that_the_font_lacks_are_known() {
        assert!(missing("Пресс ДПИ θφα°±²Δ–× Ra 0.8").is_empty());
        assert_eq!(missing("圧 cam 圧"), ['圧']);
    }

    #[test]
    fn a_text_is_wrapped_and_shrunk_but_never_cut() {
        let long = "A printing press of sixty letters or more with an unbreakablenamethatiswiderthanaline in it";
        let (lines, size) = fitted(long, 5.0, 40.0, 12.0);
        assert_eq!(lines.concat().replace(' ', ""), long.replace(' ', ""));
        assert!(size < 5.0 && lines.iter().all(|line| width(line, size) <= 40.0));
    }
}
