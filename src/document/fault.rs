//! Faults of a file: what was wrong, where, and what would be right.

use std::fmt;

/// One fault: what was wrong, where, and what would be right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// What was wrong.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
    /// Where, when there is a place.
    pub place: Option<Excerpt>,
}

/// A place in a text, with the line it stands on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// Name of the file, or of the flag.
    pub source: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The whole line.
    pub text: String,
    /// Characters to mark.
    pub width: usize,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)?;
        if let Some(place) = &self.place {
            let margin = " ".repeat(place.line.to_string().len());
            write!(f, "\n{margin}--> {}:{}:{}", place.source, place.line, place.column)?;
            write!(f, "\n{margin} |\n{} | {}", place.line, place.text)?;
            write!(f, "\n{margin} | {}{}", " ".repeat(place.column.saturating_sub(1)), "^".repeat(place.width.max(1)))?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

/// Longest path for which a known key is looked for: longer ones are not misspelt keys, and comparing them takes time.
const LONGEST_PATH: usize = 200;

/// The known key that a path may be a misspelling of; `None` when nothing is near.
///
/// The smallest edit distance wins; a key whose last part fits exactly is nearer than any other, and of two equally near
/// the one whose table fits. A key is near when at most half of its last part, or a third of its path, is wrong.
pub(super) fn nearest<'k>(path: &str, known: &'k [String]) -> Option<&'k str> {
    if path.len() > LONGEST_PATH {
        return None;
    }
    let name = last(path);
    let distances = known.iter().map(|candidate| {
        let (whole, name) = (edit_distance(path, candidate), edit_distance(name, last(candidate)));
        (candidate.as_str(), whole, name)
    });
    let (nearest, whole, wrong) = distances.min_by_key(|(_, whole, name)| ((name * 2).min(whole * 2 + 1), *whole))?;
    let near = wrong * 2 <= name.chars().count() || whole * 3 <= path.chars().count();
    near.then_some(nearest)
}

/// The known word that another may be a misspelling or the beginning of, whatever its case; `None` when nothing is near.
#[must_use]
pub fn similar<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    if word.is_empty() || word.len() > LONGEST_PATH {
        return None;
    }
    let folded = |text: &str| text.to_lowercase().replace('-', "_");
    let wanted = folded(word);
    let length = wanted.chars().count();
    let distances = known.into_iter().map(|candidate| {
        let other = folded(candidate);
        let beginning: String = other.chars().take(length).collect();
        let begun = if length >= SHORTEST_BEGINNING { 1 + mistakes(&wanted, &beginning) } else { usize::MAX };
        (candidate, mistakes(&wanted, &other).min(begun))
    });
    let (nearest, wrong) = distances.min_by_key(|(_, wrong)| *wrong)?;
    (2 * wrong <= length).then_some(nearest)
}

/// Levenshtein's distance; letters in the wrong order are a single mistake.
fn mistakes(a: &str, b: &str) -> usize {
    let letters = |text: &str| {
        let mut letters: Vec<char> = text.chars().collect();
        letters.sort_unstable();
        letters
    };
    let distance = edit_distance(a, b);
    if distance == 2 && letters(a) == letters(b) { 1 } else { distance }
}

/// The shortest beginning that stands for a whole word.
const SHORTEST_BEGINNING: usize = 4;

/// The name at the end of a path.
fn last(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or_default()
}

/// Levenshtein's distance, one row at a time.
fn edit_distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (cell, cb) in row.iter_mut().skip(1).zip(b.chars()) {
            let replaced = diagonal + usize::from(ca != cb);
            diagonal = *cell;
            left = replaced.min(diagonal + 1).min(left + 1);
            *cell = left;
        }
        if let Some(first) = row.first_mut() {
            *first = i + 1;
        }
    }
    row.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distances() {
        for (a, b, distance) in [("", "", 0), ("abc", "", 3), ("kitten", "sitting", 3), ("thicknes", "thickness", 1)] {
            assert_eq!(edit_distance(a, b), distance, "{a} {b}");
            assert_eq!(edit_distance(b, a), distance, "{b} {a}");
        }
    }

    #[test]
    fn words_are_near_whatever_their_case() {
        let known = ["dpi", "dpi-paper", "pressure_angle"];
        for (word, near) in [
            ("DPI", Some("dpi")),
            ("dip", Some("dpi")),
            ("dpi_papr", Some("dpi-paper")),
            ("pressure", Some("pressure_angle")),
            ("presure-angle", Some("pressure_angle")),
            ("presure", Some("pressure_angle")),
            ("pgf", None),
            ("xyz", None),
            ("", None),
            ("q", None),
        ] {
            assert_eq!(similar(word, known), near, "{word}");
        }
    }

    #[test]
    fn a_key_in_the_wrong_table_is_named() {
        let known = ["bed.mass", "cam.thickness", "follower.roller.radius"].map(str::to_owned);
        assert_eq!(nearest("cam.thicknes", &known), Some("cam.thickness"));
        assert_eq!(nearest("bed.thickness", &known), Some("cam.thickness"));
        assert_eq!(nearest("roller.radius", &known), Some("follower.roller.radius"));
        assert_eq!(nearest("bearing.kind", &known), None, "nothing is near");
        assert_eq!(nearest(&"bed.mass".repeat(1000), &known), None);
    }
}
