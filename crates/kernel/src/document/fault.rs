//! Faults of a file: what was wrong, where, and what would be right.

use super::plain::is_plain;
use std::fmt;

/// Why a value does not fit its key, and what would.
#[derive(Debug)]
pub(super) struct Misfit {
    pub(super) message: String,
    pub(super) help: Option<String>,
}

/// One fault: what was wrong, where, and what would be right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileFault {
    /// The dotted path of the key, or of the table, that it is of; `None` where it is of no single one.
    pub key: Option<String>,
    /// What was wrong.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
    /// Where, when there is a place.
    pub place: Option<Excerpt>,
}

/// A place in a text, with its line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// Name of the file, or of the flag.
    pub source: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The line, or the part of a long one about the place.
    pub text: String,
    /// Characters before those to mark.
    pub before: usize,
    /// Characters to mark.
    pub width: usize,
}

/// Longest excerpt of a line, in characters, and how many of them come before the place.
pub(super) const LONGEST_LINE: usize = 160;
const BEFORE: usize = 60;
/// Replaces the part of a line that is cut, and a character that a terminal would obey.
const CUT: &str = "…";
const NOT_PLAIN: char = '\u{fffd}';

impl Excerpt {
    /// From a whole line with a number of marked characters from a column on.
    pub(super) fn new(source: &str, line: usize, whole: &str, (column, marked): (usize, usize)) -> Self {
        let place = column.saturating_sub(1);
        let from = if whole.chars().nth(LONGEST_LINE).is_some() { place.saturating_sub(BEFORE) } else { 0 };
        let mut rest = whole.chars().skip(from);
        // One for one, so that the mark is below its characters.
        let part = rest.by_ref().take(LONGEST_LINE).map(|c| match c {
            '\t' => ' ',
            c if is_plain(c) => c,
            _ => NOT_PLAIN,
        });
        let part: String = part.collect();
        let (head, tail) = (if from > 0 { CUT } else { "" }, if rest.next().is_some() { CUT } else { "" });
        let before = place - from + head.chars().count();
        let width = marked.min((from + part.chars().count()).saturating_sub(place)).max(1);
        Self { source: source.to_owned(), line, column, text: format!("{head}{part}{tail}"), before, width }
    }
}

impl fmt::Display for FileFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)?;
        if let Some(place) = &self.place {
            let margin = " ".repeat(place.line.to_string().len());
            write!(f, "\n{margin}--> {}:{}:{}", place.source, place.line, place.column)?;
            write!(f, "\n{margin} |\n{} | {}", place.line, place.text)?;
            write!(f, "\n{margin} | {}{}", " ".repeat(place.before), "^".repeat(place.width.max(1)))?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

/// Longest path for which a known key is looked for: longer ones are not misspelt keys, and comparing them takes time.
const LONGEST_PATH: usize = 200;

/// A key that a misspelt one may have meant.
#[derive(Debug)]
pub(super) struct KnownKey {
    /// Its path, indices left open.
    pub(super) path: String,
    /// The path under which people look for it: its own, or one with another of its names.
    pub(super) named: String,
    /// Its table is in the file.
    pub(super) in_file: bool,
}

/// How many letters a key of another table must be nearer than one of the same table: of one that is in the file, and of one that is not.
const OF_OTHER_TABLE: usize = 2;
const NOT_IN_FILE: usize = 3;

/// The known keys that a path may be a misspelling of; empty when nothing is near, several where a word of all of them is given.
///
/// The smallest edit distance wins, of the last part or of the path; a name that contains the other as a word is one letter away. A key of the
/// same table is preferred, then one whose table is in the file. A key is near when at most half of its last part, or a third of its path, is
/// wrong.
pub(super) fn nearest<'k>(path: &str, known: &'k [KnownKey]) -> Vec<&'k str> {
    if path.len() > LONGEST_PATH {
        return Vec::new();
    }
    let path = &folded(path);
    let (table, name) = (table_of(path), last(path));
    let distances = known.iter().map(|key| {
        let (whole, other) = (edit_distance(path, &key.named), last(&key.named));
        let by_letters = mistakes(name, other);
        let by_word = by_letters > 1 && (is_word_of(name, other) || is_word_of(other, name));
        let wrong = if by_word { 1 } else { by_letters };
        let elsewhere = match (table_of(&key.named) == table, key.in_file) {
            (true, _) => 0,
            // The table is there under a part of its name.
            (false, _) if last(table_of(&key.named)) == last(table) => 1,
            (false, true) => OF_OTHER_TABLE,
            (false, false) => NOT_IN_FILE,
        };
        (key.path.as_str(), whole, wrong, elsewhere, by_word)
    });
    let distances: Vec<_> = distances.collect();
    let best = distances
        .iter()
        .min_by_key(|(_, whole, wrong, elsewhere, _)| (((wrong + elsewhere) * 2).min(whole * 2 + 1), *whole));
    let Some(&(nearest, whole, wrong, elsewhere, by_word)) = best else { return Vec::new() };
    if wrong * 2 > name.chars().count() && whole * 3 > path.chars().count() {
        return Vec::new();
    }
    if !by_word || elsewhere > 0 {
        return vec![nearest];
    }
    // A word of several names says which of them is meant no better than the others.
    let equal = distances.iter().filter(|(.., other, by_word)| *other == 0 && *by_word).map(|(path, ..)| *path);
    let mut all = vec![nearest];
    for path in equal {
        if !all.contains(&path) && all.len() < MOST_SUGGESTED {
            all.push(path);
        }
    }
    all
}

/// Most keys that are suggested for one.
const MOST_SUGGESTED: usize = 4;

/// Whether a name of letters is one of the words of another, `diameter` of `bore_diameter`.
fn is_word_of(word: &str, name: &str) -> bool {
    word.len() >= SHORTEST_BEGINNING && name.split(['_', '-']).any(|part| part == word)
}

/// The path of the table of a key.
fn table_of(path: &str) -> &str {
    path.rsplit_once('.').map_or("", |(table, _)| table)
}

/// The known word that another may be a misspelling or the beginning of, in any case; `None` when nothing is near.
#[must_use]
pub fn similar<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    if word.is_empty() || word.len() > LONGEST_PATH {
        return None;
    }
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

/// Lower case, with `_` between words.
fn folded(text: &str) -> String {
    text.to_lowercase().replace('-', "_")
}

/// Number of mistakes in a name, by letters or by words; an abbreviated word (`bore_diam`) or another order of the words is a single mistake.
fn mistakes(a: &str, b: &str) -> usize {
    let [of_a, of_b] = [a, b].map(|name| name.split('_').collect::<Vec<_>>());
    let by_letters = letter_mistakes(a, b);
    if of_a.len() != of_b.len() || by_letters <= 1 {
        return by_letters;
    }
    let [mut sorted_a, mut sorted_b] = [of_a.clone(), of_b.clone()];
    sorted_a.sort_unstable();
    sorted_b.sort_unstable();
    let by_words =
        if sorted_a == sorted_b { 1 } else { of_a.iter().zip(&of_b).map(|(a, b)| word_mistakes(a, b)).sum() };
    by_letters.min(by_words)
}

fn word_mistakes(a: &str, b: &str) -> usize {
    let by_letters = letter_mistakes(a, b);
    let abbreviates =
        [(a, b), (b, a)].iter().any(|(short, long)| short.len() >= SHORTEST_ABBREVIATION && long.starts_with(short));
    if by_letters > 1 && abbreviates { 1 } else { by_letters }
}

/// Shortest accepted abbreviation of a word.
const SHORTEST_ABBREVIATION: usize = 3;

/// Levenshtein distance; two swapped letters are a single mistake.
fn letter_mistakes(a: &str, b: &str) -> usize {
    let distance = edit_distance(a, b);
    let [letters, others] = [a, b].map(|text| {
        let mut letters: Vec<char> = text.chars().collect();
        letters.sort_unstable();
        letters
    });
    if distance == 2 && letters == others { 1 } else { distance }
}

/// The shortest beginning that is accepted for a whole word.
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
    fn an_excerpt_shows_its_place_and_not_more() {
        let whole = format!("{}here{}", "x".repeat(5000), "y".repeat(5000));
        let shown = Excerpt::new("m.toml", 1, &whole, (5001, 4));
        assert_eq!(shown.text.chars().count(), LONGEST_LINE + 2);
        let marked: String = shown.text.chars().skip(shown.before).take(shown.width).collect();
        assert_eq!((shown.column, marked.as_str()), (5001, "here"));
        let wide = Excerpt::new("m.toml", 1, &whole, (1, 10_000));
        assert_eq!((wide.before, wide.width), (0, LONGEST_LINE));
        let short = Excerpt::new("m.toml", 1, "a\u{1b}[31m\tb\u{202e}", (7, 1));
        assert_eq!((short.text.as_str(), short.before), ("a\u{fffd}[31m b\u{fffd}", 6));
        let end = Excerpt::new("m.toml", 1, "ab", (3, 0));
        assert_eq!((end.before, end.width), (2, 1));
    }

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
        let key = |path: &str, in_file| KnownKey { path: path.to_owned(), named: path.to_owned(), in_file };
        let known = ["bed.mass", "cam.thickness", "follower.roller.radius"].map(|path| key(path, false));
        assert_eq!(nearest("cam.thicknes", &known), ["cam.thickness"]);
        assert_eq!(nearest("bed.thickness", &known), ["cam.thickness"]);
        assert_eq!(nearest("roller.radius", &known), ["follower.roller.radius"]);
        assert!(nearest("bearing.kind", &known).is_empty(), "nothing is near");
        assert!(nearest(&"bed.mass".repeat(1000), &known).is_empty());
    }

    #[test]
    fn a_key_of_the_same_table_is_preferred() {
        let key = |path: &str, in_file| KnownKey { path: path.to_owned(), named: path.to_owned(), in_file };
        let mut known = vec![
            key("cam.base_diameter", true),
            key("cam.bore_diameter", true),
            key("cam.thickness", true),
            key("cam.rotation", true),
            key("shaft.disc[].diameter", false),
            key("follower.roller.mass", true),
            key("follower.knife.mass", false),
            key("motion.segment[].over", true),
        ];
        known.push(KnownKey { named: "motion.segment[].angle".into(), ..key("motion.segment[].over", true) });
        known.push(key("cam.keyway.angle", false));
        known.push(key("cam.bore_fit", true));
        known.push(key("cam.bore_radius", true));
        for (path, near) in [
            ("cam.diameter", &["cam.base_diameter", "cam.bore_diameter"][..]),
            ("cam.bore", &["cam.bore_fit", "cam.bore_diameter", "cam.bore_radius"]),
            ("cam.bore_diam", &["cam.bore_diameter"]),
            ("cam.bore_dia", &["cam.bore_diameter"]),
            ("cam.bore_rad", &["cam.bore_radius"]),
            ("cam.bore_fits", &["cam.bore_fit"]),
            ("cam.diameter_bore", &["cam.bore_diameter"]),
            ("cam.BORE-DIAMETER", &["cam.bore_diameter"]),
            ("cam.boreDiameter", &["cam.bore_diameter"]),
            ("cam.thick", &["cam.thickness"]),
            ("bore_diam", &["cam.bore_diameter"]),
            ("cam.mass", &["follower.roller.mass"]),
            ("cam.thikness", &["cam.thickness"]),
            ("motion.segment[].angle", &["motion.segment[].over"]),
            ("follower.flat.mass", &["follower.roller.mass"]),
        ] {
            assert_eq!(nearest(path, &known), near, "{path}");
        }
    }
}
