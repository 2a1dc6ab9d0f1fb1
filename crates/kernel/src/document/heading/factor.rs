//! A factor in a heading: `lift .001in`, `(0,01 mm)`, `1/100mm`, `10µm`, `mm x 0.01`, `*1000`, `e-3 in`, hundredths.
//!
//! A heading is split into words, numbers and signs. A whole number alone may count cams (`valve 2 mm`). A number is a factor if it touches a unit,
//! follows or precedes a sign of multiplication or division, or is a power of ten next to a unit.

use super::HeadingUnit;

/// Beginnings of words for a fraction or a multiple of a unit.
const PARTS: &[&str] = &[
    "tenth",
    "hundredth",
    "thousandth",
    "millionth",
    "zehntel",
    "hundertstel",
    "tausendstel",
    "factor",
    "faktor",
    "scale",
    "multipl",
    "times",
    "double",
    "doppelt",
    "twice",
];

/// Multiples and parts of a unit as a word of their own: `milli-inch`.
const PREFIXES: &[&str] = &[
    "milli", "micro", "mikro", "centi", "zenti", "deci", "dezi", "nano", "kilo", "deca", "deka", "hecto", "hekto",
    "mega",
];

/// Units of instrument steps.
const SMALL: &[&str] = &["um", "µm", "μm", "micron", "microns", "mil", "mils", "thou"];

#[derive(Debug, Clone, PartialEq)]
enum Part {
    Word(String),
    Number(String),
    /// A sign of multiplication, division or power.
    Sign(char),
    /// A space, bracket or other sign.
    Gap,
}

impl Part {
    fn is_unit(&self) -> bool {
        let Self::Word(word) = self else { return false };
        let is_short = word.chars().count() == 1 && word.chars().all(char::is_alphabetic);
        !is_short && HeadingUnit::of_word(word).is_some()
    }

    fn is_number(&self) -> bool {
        matches!(self, Self::Number(_))
    }

    /// Whether it is a number that cannot count cams.
    fn multiplies(&self) -> bool {
        let Self::Number(number) = self else { return false };
        let is_power_of_ten = number.len() > 1 && number.starts_with('1') && number.chars().skip(1).all(|c| c == '0');
        is_power_of_ten || !number.chars().all(|c| c.is_ascii_digit())
    }
}

/// The factor in a heading, as written.
pub(super) fn factor_in(heading: &str) -> Option<String> {
    let lower = plain(heading);
    let mut words = lower.split(|c: char| !c.is_alphanumeric());
    let factor = words
        .find(|word| is_ordinal(word) || PREFIXES.contains(word) || PARTS.iter().any(|part| word.starts_with(part)));
    if let Some(word) = factor {
        return Some(word.to_owned());
    }
    let bracket = super::inside(&lower).map(parts).unwrap_or_default();
    let parts = parts(&lower);
    let is_factor = matches!(close(&bracket).as_slice(), [number, unit] if number.is_number() && unit.is_unit())
        || is_product(&parts)
        || touches_a_unit(&parts)
        || beside_a_unit(&parts)
        || parts.iter().any(is_decimal);
    is_factor.then(|| heading.trim().to_owned())
}

/// Whether a word is the like of `10th` or `1000ths`.
fn is_ordinal(word: &str) -> bool {
    let number = word.trim_end_matches('s').strip_suffix("th");
    number.is_some_and(|number| !number.is_empty() && number.chars().all(|c| c.is_ascii_digit()))
}

/// A heading in lower case with one sign per operation.
fn plain(heading: &str) -> String {
    let mut plain = String::new();
    for letter in heading.to_lowercase().chars() {
        match letter {
            '×' | '·' | '∙' | '⋅' => plain.push('*'),
            '÷' | '∕' | ':' => plain.push('/'),
            '−' | '–' | '⁻' => plain.push('-'),
            '⁰' => plain.push('0'),
            '¹' => plain.push('1'),
            '²' => plain.push('2'),
            '³' => plain.push('3'),
            '⁴'..='⁹' => plain.extend(char::from_digit(letter as u32 - 0x2070, 10)),
            other => plain.push(other),
        }
    }
    plain
}

fn parts(text: &str) -> Vec<Part> {
    let letters: Vec<char> = text.chars().collect();
    let (mut all, mut at) = (Vec::new(), 0);
    while let Some(letter) = letters.get(at) {
        let rest = letters.get(at..).unwrap_or_default();
        let length = match letter {
            c if c.is_ascii_digit() || is_fraction(rest) || is_exponent(rest, all.last()) => number_length(rest),
            c if is_of_word(*c) => rest.iter().take_while(|c| is_of_word(**c) && !c.is_ascii_digit()).count(),
            _ => 1,
        }
        .max(1);
        let piece: String = rest.iter().take(length).collect();
        all.push(match letter {
            c if c.is_ascii_digit() || (length > 1 && !is_of_word(*c)) || is_exponent(rest, all.last()) => {
                Part::Number(piece)
            }
            // An `x` between numbers and units is a multiplication sign.
            'x' if length == 1 => Part::Sign('x'),
            c if is_of_word(*c) => Part::Word(piece),
            '*' | '/' | '^' => Part::Sign(*letter),
            _ => Part::Gap,
        });
        at += length;
    }
    all.dedup_by(|b, a| *a == Part::Gap && *b == Part::Gap);
    all
}

fn is_of_word(letter: char) -> bool {
    letter.is_alphabetic() || matches!(letter, '°' | '%' | '"' | '\'' | '″' | '”')
}

/// `.001`, `,01`.
fn is_fraction(rest: &[char]) -> bool {
    matches!(rest, ['.' | ',', digit, ..] if digit.is_ascii_digit())
}

/// `e-3` without a number before it.
fn is_exponent(rest: &[char], before: Option<&Part>) -> bool {
    matches!(rest, ['e', '-' | '+', digit, ..] if digit.is_ascii_digit()) && !matches!(before, Some(Part::Word(_)))
}

/// Length of a number with its decimals and exponent.
fn number_length(rest: &[char]) -> usize {
    let digit = |at: usize| rest.get(at).is_some_and(char::is_ascii_digit);
    let mut at = 0;
    while let Some(letter) = rest.get(at) {
        let goes_on = match letter {
            c if c.is_ascii_digit() => true,
            '.' | ',' | '-' | '+' => digit(at + 1),
            'e' | '^' => digit(at + 1) || (matches!(rest.get(at + 1), Some('-' | '+')) && digit(at + 2)),
            _ => false,
        };
        if !goes_on {
            break;
        }
        at += 1;
    }
    at
}

fn is_decimal(part: &Part) -> bool {
    matches!(part, Part::Number(number) if number.chars().any(|c| !c.is_ascii_digit() && c != '-'))
}

/// The parts without the gaps.
fn close(parts: &[Part]) -> Vec<&Part> {
    parts.iter().filter(|part| **part != Part::Gap).collect()
}

/// Whether a number follows or precedes a sign of multiplication or division; `x 2` may be a name, `mm x 2` is not.
fn is_product(parts: &[Part]) -> bool {
    let parts = close(parts);
    (0..parts.len()).any(|at| {
        let (before, after) = (at.checked_sub(1).and_then(|before| parts.get(before)), parts.get(at + 1));
        let [number_before, number_after] = [before, after].map(|part| part.is_some_and(|part| part.is_number()));
        match parts.get(at) {
            Some(Part::Sign('x')) => {
                let named = before.is_none_or(|before| !before.is_unit() && !before.is_number());
                let large = after.is_some_and(|after| after.multiplies());
                number_before || (number_after && (large || !named))
            }
            Some(Part::Sign(_)) => number_after || number_before,
            _ => false,
        }
    })
}

/// Whether a number touches a unit: `10µm`.
fn touches_a_unit(parts: &[Part]) -> bool {
    parts.windows(2).any(|pair| matches!(pair, [Part::Number(_), unit] if unit.is_unit()))
}

/// Whether a power of ten or a fraction is next to a unit.
fn beside_a_unit(parts: &[Part]) -> bool {
    let parts = close(parts);
    parts.windows(2).any(|pair| {
        let is_step =
            matches!(pair, [Part::Number(number), Part::Word(unit)] if number != "1" && SMALL.contains(&unit.as_str()));
        is_step || matches!(pair, [a, b] if (a.multiplies() && b.is_unit()) || (a.is_unit() && b.multiplies()))
    })
}
