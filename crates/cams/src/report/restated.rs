//! The words of a report in its unit: its parts write millimetres, and a report in inches has them restated here, in one place. Remedies stay as they are
//! typed: they are to be typed again.

use super::{Finding, Report, Section, Verdict, shown};
use camgen_kernel::units::LengthUnit;
use std::borrow::Cow;

/// What may stand between two numbers of one unit.
const BETWEEN: [&str; 8] = [" to ", " and ", " or ", " × ", ", ", "/", " … ", "…"];
/// Units of length in words: how they are written, in inches, and inches to the power of how many millimetres they have, with their size in mm.
const UNITS: [(&str, &str, i32, f64); 8] = [
    ("mm²", " in²", 2, 1.0),
    ("mm³", " in³", 3, 1.0),
    ("mm2", " in2", 2, 1.0),
    ("mm", " in", 1, 1.0),
    ("µm", " in", 1, 1e-3),
    ("m/s³", " in/s³", 1, 1e3),
    ("m/s²", " in/s²", 1, 1e3),
    ("m/s", " in/s", 1, 1e3),
];

/// The unit that a text begins with: what is left of the text, how it is written in inches, and the inches in it.
fn unit(text: &str) -> Option<(&str, &'static str, f64)> {
    let found = UNITS.iter().find_map(|(unit, inch, power, size)| {
        let rest = text.strip_prefix(unit)?;
        let ends = !rest.starts_with(|c: char| c.is_alphanumeric() || c == '·');
        ends.then(|| (rest, *inch, LengthUnit::Inch.of_mm_to(*size, *power)))
    })?;
    // mm/mm is a ratio, and mm/mm² the inverse of a length.
    match found.0 {
        rest if rest.starts_with("/mm²") => Some((rest.strip_prefix("/mm²")?, " in/in²", 25.4)),
        rest if rest.starts_with("/mm³") => Some((rest.strip_prefix("/mm³")?, " in/in³", 25.4 * 25.4)),
        rest if rest.starts_with("/mm") => Some((rest.strip_prefix("/mm")?, " in/in", 1.0)),
        _ => Some(found),
    }
}

/// Where the number that a text ends with begins.
fn number_at_end(text: &str) -> Option<usize> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
    let start = digits.len();
    let number = text.get(start..)?;
    if number.is_empty()
        || number.starts_with('.')
        || number.ends_with('.')
        || digits.ends_with(|c: char| c.is_alphabetic() && c != 'Ø')
    {
        return None;
    }
    // A sign belongs to it where nothing but a blank or a bracket is before it.
    let signed = digits.strip_suffix(['-', '−']);
    let is_sign = |before: &str| before.is_empty() || before.ends_with([' ', '(', '=']);
    Some(signed.filter(|before| is_sign(before)).map_or(start, str::len))
}

/// A sentence with its lengths in inches.
#[must_use]
pub(in crate::report) fn sentence(text: &str) -> String {
    let (mut done, mut rest) = (String::with_capacity(text.len()), text);
    while let Some(at) = rest.match_indices(['m', 'µ']).map(|(at, _)| at).find(|at| {
        let (before, after) = rest.split_at(*at);
        unit(after).is_some() && number_at_end(before.trim_end_matches([' ', '\u{a0}'])).is_some()
    }) {
        let (before, after) = rest.split_at(at);
        let Some((left, name, inches)) = unit(after) else { break };
        let mut numbers = before.trim_end_matches([' ', '\u{a0}']);
        // From the last number backwards: those before it of the same unit.
        let mut restated = String::new();
        while let Some(start) = number_at_end(numbers) {
            let number: f64 = numbers.get(start..).unwrap_or_default().replace('−', "-").parse().unwrap_or(f64::NAN);
            restated.insert_str(0, &shown(number * inches));
            numbers = numbers.get(..start).unwrap_or_default();
            let joined = BETWEEN
                .iter()
                .find(|joint| numbers.strip_suffix(**joint).is_some_and(|before| number_at_end(before).is_some()));
            let Some(joint) = joined else { break };
            restated.insert_str(0, joint);
            numbers = numbers.strip_suffix(joint).unwrap_or(numbers);
        }
        done.push_str(numbers);
        done.push_str(&restated);
        done.push_str(name);
        rest = left;
    }
    done.push_str(rest);
    done
}

impl Finding {
    /// The finding with its value in inches, and the note where it passed; a remedy stays as it is to be typed.
    #[must_use]
    pub(crate) fn in_inches(&self) -> Self {
        let passed = matches!(self.verdict, Verdict::Pass | Verdict::Info);
        let note = self.note.as_ref().map(|note| if passed { sentence(note) } else { note.clone() });
        let Some((rest, name, inches)) = unit(&self.unit) else { return Self { note, ..self.clone() } };
        let unit = format!("{}{rest}", name.trim_start());
        Self {
            value: self.value * inches,
            limit: self.limit.map(|limit| limit * inches),
            unit: unit.into(),
            note,
            ..self.clone()
        }
    }
}

impl Report {
    /// The report with the words for people in its unit.
    #[must_use]
    pub fn for_people(&self) -> Cow<'_, Self> {
        if self.units == LengthUnit::Millimetre {
            return Cow::Borrowed(self);
        }
        let all = |texts: &[String]| texts.iter().map(|text| sentence(text)).collect();
        let section = |of: &Section| Section { words: all(&of.words), figures: all(&of.figures), ..of.clone() };
        Cow::Owned(Self {
            sections: self.sections.iter().map(section).collect(),
            checks: self.checks.iter().map(Finding::in_inches).collect(),
            ..self.clone()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_restated_with_all_numbers_of_a_unit() {
        for (metric, inch) in [
            (
                "base radius 69 mm, roller Ø60 mm, lift 53.135 mm",
                "base radius 2.7165 in, roller Ø2.3622 in, lift 2.0919 in",
            ),
            ("touches the face from 12.7 to 25.4 mm", "touches the face from 0.5 to 1 in"),
            ("plate 254 × 127 mm", "plate 10 × 5 in"),
            (
                "0.508 µm from the exact curve, tolerance 5.08 µm",
                "0.00002 in from the exact curve, tolerance 0.0002 in",
            ),
            ("area 645.16 mm², 3 rpm", "area 1 in², 3 rpm"),
            ("2.54 mm/rad² at 30°", "0.1 in/rad² at 30°"),
            ("2 mm/mm, 2 mm/mm²", "2 in/in, 50.8 in/in²"),
            ("spring 5 N/mm, unbalance 7 g·mm", "spring 5 N/mm, unbalance 7 g·mm"),
            ("(−25.4, 50.8) mm", "(−25.4, 50.8) mm"),
            ("at x = −25.4 mm", "at x = -1 in"),
            ("for 20, 35 rpm, 25.4 mm", "for 20, 35 rpm, 1 in"),
            ("M12 and A1 mm", "M12 and A1 mm"),
            ("12 minutes in mm", "12 minutes in mm"),
        ] {
            assert_eq!(sentence(metric), inch);
        }
    }
}
