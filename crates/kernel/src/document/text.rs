//! A TOML text and its overrides, flattened to dotted paths that know their places.
//!
//! `[bed] mass` becomes `bed.mass`, and the second `[[motion.segment]]`'s `law` becomes `motion.segment[1].law`. The
//! paths are whatever the file contains; the reader decides which of them mean something. Messages about a text are plain and
//! short, whatever it contains.

use super::fault::{Excerpt, FileFault};
use super::key::{KeySection, Occurrence, join};
use super::plain::shown;
use super::syntax::{SyntaxFault, fault_of};
use super::value::Scalar;
use std::collections::BTreeMap;
use std::ops::{Bound, Range};
use std::sync::Arc;
use toml::de::{DeArray, DeTable, DeValue};

/// Deepest nesting of tables that is read, so that hostile files cannot make paths of any length. No section is deeper
/// than three.
const DEEPEST: usize = 16;
/// Longest name of a key, in bytes: with [`DEEPEST`] it bounds the length of a path, of which there is one for each key.
const LONGEST_NAME: usize = 100;
/// Most faults reported: the twentieth helps nobody, and each quotes its line.
pub const MOST_FAULTS: usize = 20;
/// Longest message of a fault, and longest help, in characters.
const LONGEST_MESSAGE: usize = 2000;

/// Where something was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum TextPlace {
    /// In the file, by bytes.
    File(Range<usize>),
    /// In an override: which one, from which character on, how many.
    Flag { index: usize, start: usize, width: usize },
    /// In another file.
    OtherFile(Box<Excerpt>),
}

/// A fault whose line has not been cut out of the text yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PendingFault {
    /// The path of its key, where its place does not tell that.
    pub(super) key: Option<String>,
    pub(super) message: String,
    pub(super) help: Option<String>,
    pub(super) place: Option<TextPlace>,
}

impl PendingFault {
    /// A fault whose key is the one at its place.
    pub(super) fn at(message: String, help: Option<String>, place: Option<TextPlace>) -> Self {
        Self { key: None, message, help, place }
    }

    /// Faults without a place come first, then those of the file, then those of the overrides.
    fn order(&self) -> (u8, usize, usize) {
        match &self.place {
            None => (0, 0, 0),
            Some(TextPlace::File(span)) => (1, span.start, 0),
            Some(TextPlace::Flag { index, start, .. }) => (2, *index, *start),
            Some(TextPlace::OtherFile(excerpt)) => (3, excerpt.line, excerpt.column),
        }
    }
}

/// A value under its path.
#[derive(Debug, Clone)]
pub(super) struct TomlEntry {
    pub(super) value: Scalar,
    pub(super) key: TextPlace,
    pub(super) at: TextPlace,
}

impl TomlEntry {
    /// Whether an override has set it.
    pub(super) fn by_override(&self) -> bool {
        matches!(self.key, TextPlace::Flag { .. })
    }
}

/// A TOML text, flattened: read once for any number of overrides.
#[derive(Debug, Clone)]
pub struct FlatText {
    text: Arc<str>,
    /// Every value.
    entries: BTreeMap<String, TomlEntry>,
    /// Every table, elements of arrays of tables too, by where its name was written.
    tables: Arc<BTreeMap<String, Range<usize>>>,
    /// Every array of tables: where its name comes first, and its length.
    arrays: Arc<BTreeMap<String, (Range<usize>, usize)>>,
    /// The text is not TOML; faults that follow from that are not reported.
    broken: bool,
    /// Faults of the text itself, independent of what its keys mean.
    faults: Vec<PendingFault>,
}

/// A text with its overrides, flattened.
#[derive(Debug)]
pub(super) struct Document<'a> {
    source: &'a str,
    text: Arc<str>,
    /// The overrides as shown in messages, `key=value`.
    flags: Vec<String>,
    /// Every value.
    pub(super) entries: BTreeMap<String, TomlEntry>,
    /// Every table, elements of arrays of tables too, by where its name was written.
    pub(super) tables: Arc<BTreeMap<String, Range<usize>>>,
    /// Every array of tables: where its name comes first, and its length.
    pub(super) arrays: Arc<BTreeMap<String, (Range<usize>, usize)>>,
    /// The text is not TOML; faults that follow from that are not reported.
    pub(super) broken: bool,
    /// Faults of the text itself, independent of what its keys mean.
    pub(super) faults: Vec<PendingFault>,
}

impl FlatText {
    /// The text as it was read.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Reads a TOML text; the sections say which tables occur several times.
    #[must_use]
    pub fn new(text: &str, sections: &[&KeySection]) -> Self {
        let repeated =
            |path: &str| sections.iter().any(|section| section.path == path && section.occurs == Occurrence::Repeated);
        let mut flat = Self {
            text: text.into(),
            entries: BTreeMap::new(),
            tables: Arc::default(),
            arrays: Arc::default(),
            broken: false,
            faults: Vec::new(),
        };
        flat.parse(text, repeated);
        flat
    }

    /// Whether an override of a value changes nothing but that value: it is in the file, or the header of its table is.
    pub(super) fn holds(&self, path: &str) -> bool {
        let table = path.rsplit_once('.').map_or("", |(table, _)| table);
        self.entries.contains_key(path) || self.tables.contains_key(table)
    }

    /// Whether there is a value at a path.
    pub(super) fn has_value(&self, path: &str) -> bool {
        self.entries.contains_key(path)
    }

    fn parse(&mut self, text: &str, repeated: impl Fn(&str) -> bool) {
        let (table, errors) = DeTable::parse_recoverable(text);
        // Later faults of the parser are mostly consequences of the first.
        let first = errors.iter().min_by_key(|error| error.span().map(|span| span.start));
        if let Some(error) = first {
            self.not_toml(error.message(), error.span(), repeated);
        }
        self.table("", table.get_ref(), 0);
    }

    fn not_toml(&mut self, why: &str, span: Option<Range<usize>>, repeated: impl Fn(&str) -> bool) {
        self.broken = true;
        let meant = span.as_ref().and_then(|span| fault_of(why, self.line_at(span.start), repeated));
        let place = span.map(TextPlace::File);
        let (message, help) = match meant {
            Some(SyntaxFault { message, help }) => (format!("not TOML: {message}"), Some(help)),
            None => (format!("not TOML: {why}"), None),
        };
        self.faults.push(PendingFault::at(message, help, place));
    }

    /// The line of a place in the text.
    fn line_at(&self, at: usize) -> &str {
        let (before, after) = self.text.split_at_checked(at).unwrap_or((&self.text, ""));
        let start = before.rfind('\n').map_or(0, |last| last + 1);
        let end = after.find('\n').map_or(self.text.len(), |next| before.len() + next);
        self.text.get(start..end).unwrap_or_default()
    }

    fn table(&mut self, prefix: &str, table: &DeTable<'_>, depth: usize) {
        for (key, value) in table {
            if let Some((message, help)) = not_a_name(key.get_ref(), depth) {
                self.faults.push(PendingFault::at(message, help, Some(TextPlace::File(key.span()))));
                continue;
            }
            let path = join(prefix, key.get_ref());
            match value.get_ref() {
                DeValue::Table(inner) => {
                    self.table(&path, inner, depth + 1);
                    Arc::make_mut(&mut self.tables).insert(path, key.span());
                }
                DeValue::Array(items) if is_array_of_tables(items) => {
                    for (index, item) in items.iter().enumerate() {
                        if let DeValue::Table(inner) = item.get_ref() {
                            let path = format!("{path}[{index}]");
                            self.table(&path, inner, depth + 1);
                            Arc::make_mut(&mut self.tables).insert(path, item.span());
                        }
                    }
                    Arc::make_mut(&mut self.arrays).insert(path, (key.span(), items.len()));
                }
                other => {
                    let scalar = self.scalar(other, &value.span());
                    let (key, at) = (TextPlace::File(key.span()), TextPlace::File(value.span()));
                    self.entries.insert(path, TomlEntry { value: scalar, key, at });
                }
            }
        }
    }

    fn scalar(&self, value: &DeValue<'_>, span: &Range<usize>) -> Scalar {
        match value {
            DeValue::String(text) => Scalar::Text(text.to_string()),
            DeValue::Integer(_) | DeValue::Float(_) => {
                Scalar::Number(self.text.get(span.clone()).unwrap_or_default().replace('_', ""))
            }
            DeValue::Boolean(truth) => Scalar::Boolean(*truth),
            DeValue::Datetime(_) => Scalar::Date(self.text.get(span.clone()).unwrap_or_default().to_owned()),
            DeValue::Array(items) => {
                Scalar::List(items.iter().map(|item| self.scalar(item.get_ref(), &item.span())).collect())
            }
            other @ DeValue::Table(_) => Scalar::Other(other.type_str()),
        }
    }
}

impl<'a> Document<'a> {
    /// A text named `source` with overrides, each `key=value`.
    pub(super) fn new(source: &'a str, flat: FlatText, overrides: &[String]) -> Self {
        let FlatText { text, entries, tables, arrays, broken, faults } = flat;
        let mut document = Self { source, text, flags: Vec::new(), entries, tables, arrays, broken, faults };
        for text in overrides {
            document.override_with(text);
        }
        document
    }

    /// The paths that overrides set, in their order.
    pub(super) fn overridden(&self) -> impl Iterator<Item = &str> {
        self.flags.iter().filter_map(|flag| flag.split_once('=')).map(|(path, _)| path)
    }

    /// A key with the elements of arrays of tables counted from 0, as paths have them; a number between dots counts them from 1,
    /// `shaft.segment.2.diameter` is `shaft.segment[1].diameter`.
    fn indexed(&self, key: &str) -> String {
        let mut path = String::new();
        for part in key.split('.') {
            match part.parse::<usize>() {
                Ok(number) if number > 0 && self.arrays.contains_key(&path) => {
                    path.push_str(&format!("[{}]", number - 1));
                }
                _ => path = join(&path, part),
            }
        }
        path
    }

    fn override_with(&mut self, text: &str) {
        let Some((key, value)) = text.split_once('=') else {
            let message = format!("--set {}: `=` is missing", shown(text, LONGEST_NAME));
            let help = Some("write --set KEY=VALUE, e.g. --set follower.roller.radius=25mm".into());
            self.faults.push(PendingFault::at(message, help, None));
            return;
        };
        let (key, value) = (&self.indexed(key.trim()), value.trim());
        let value = value.strip_prefix('"').and_then(|v| v.strip_suffix('"')).unwrap_or(value).to_owned();
        let (index, length) = (self.flags.len(), key.chars().count());
        let at = TextPlace::Flag { index, start: length + 1, width: value.chars().count() };
        self.flags.push(format!("{key}={value}"));
        let key_place = TextPlace::Flag { index, start: 0, width: length };
        self.entries.insert(key.to_owned(), TomlEntry { value: Scalar::Text(value), key: key_place, at });
    }

    /// Whether a table, an array of tables or anything within is in the file or is set by an override.
    pub(super) fn has(&self, path: &str) -> bool {
        self.tables.contains_key(path) || self.arrays.contains_key(path) || self.has_inside(path)
    }

    /// Whether anything within a path is in the file or is set by an override.
    pub(super) fn has_inside(&self, path: &str) -> bool {
        any_inside(&self.entries, path) || any_inside(&self.tables, path)
    }

    /// Where the table at a path begins, when its header is in the file.
    pub(super) fn header(&self, path: &str) -> Option<TextPlace> {
        self.tables.get(path).map(|span| TextPlace::File(span.clone()))
    }

    /// The faults as reported: in the order of their places, without duplicates.
    pub(super) fn sorted_faults(&self, mut found: Vec<PendingFault>) -> Vec<FileFault> {
        found.sort_by_key(PendingFault::order);
        let mut once: Vec<PendingFault> = Vec::new();
        for fault in found {
            let same_place = once.iter().rev().take_while(|other| other.order() == fault.order());
            if !same_place.into_iter().any(|other| *other == fault) {
                once.push(fault);
            }
        }
        let more = once.len().saturating_sub(MOST_FAULTS);
        once.truncate(MOST_FAULTS);
        let faults = once.into_iter().map(|fault| FileFault {
            key: fault.key.or_else(|| self.key_at(fault.place.as_ref()?)),
            place: fault.place.map(|place| self.excerpt(&place)),
            message: brief(&fault.message),
            help: fault.help.map(|help| brief(&help)),
        });
        let mut faults: Vec<FileFault> = faults.collect();
        if more > 0 {
            faults.push(FileFault {
                key: None,
                message: format!("{more} more faults are reported once these are corrected"),
                help: None,
                place: None,
            });
        }
        faults
    }

    /// The path of the value, or of the table, that is written at a place.
    fn key_at(&self, place: &TextPlace) -> Option<String> {
        let holds = |other: &TextPlace| match (place, other) {
            (TextPlace::File(part), TextPlace::File(whole)) => part.start >= whole.start && part.end <= whole.end,
            (TextPlace::Flag { index, .. }, TextPlace::Flag { index: other, .. }) => index == other,
            _ => false,
        };
        let value = self.entries.iter().find(|(_, entry)| holds(&entry.key) || holds(&entry.at)).map(|(path, _)| path);
        let mut tables = self.tables.iter().filter(|(_, span)| *place == TextPlace::File((*span).clone()));
        value.or_else(|| tables.next().map(|(path, _)| path)).cloned()
    }

    /// The place of one character, from 1, of a text at a place, where it is written without escapes.
    pub(super) fn character(&self, place: TextPlace, character: usize) -> TextPlace {
        match &place {
            TextPlace::Flag { index, start, width } if character <= width + 1 => {
                TextPlace::Flag { index: *index, start: start + character - 1, width: 1 }
            }
            TextPlace::File(span) => {
                let written = self.text.get(span.clone()).unwrap_or_default();
                let inner = written.get(1..).unwrap_or_default();
                if !written.starts_with(['"', '\'']) || inner.starts_with(['"', '\'']) || written.contains('\\') {
                    return place;
                }
                let found = inner.char_indices().nth(character - 1).map(|(at, c)| (at, c.len_utf8()));
                let Some((at, length)) = found else { return place };
                TextPlace::File(span.start + 1 + at..span.start + 1 + at + length)
            }
            _ => place,
        }
    }

    fn excerpt(&self, place: &TextPlace) -> Excerpt {
        match place {
            TextPlace::File(span) => self.excerpt_of_file(span),
            TextPlace::OtherFile(excerpt) => (**excerpt).clone(),
            TextPlace::Flag { index, start, width } => {
                Excerpt::new("--set", 1, self.flags.get(*index).map_or("", String::as_str), (start + 1, *width))
            }
        }
    }

    fn excerpt_of_file(&self, span: &Range<usize>) -> Excerpt {
        let at = span.start.min(self.text.len());
        let (before, after) = self.text.as_bytes().split_at(at);
        let line = before.split(|byte| *byte == b'\n').count();
        let start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
        let end = at + after.iter().position(|byte| *byte == b'\n').unwrap_or(after.len());
        let [whole, left, marked] = [start..end, start..at, at..span.end.clamp(at, end.max(at))]
            .map(|range| self.text.get(range).unwrap_or_default());
        let (column, width) = (left.chars().count() + 1, marked.chars().count());
        Excerpt::new(self.source, line, whole.trim_end(), (column, width))
    }
}

/// A message that may quote the file.
fn brief(message: &str) -> String {
    message.lines().map(|line| shown(line, LONGEST_MESSAGE)).collect::<Vec<_>>().join("\n")
}

/// Whether a key of the map is one within a path.
fn any_inside<V>(map: &BTreeMap<String, V>, path: &str) -> bool {
    let from = map.range::<str, _>((Bound::Included(path), Bound::Unbounded));
    from.map_while(|(key, _)| key.strip_prefix(path)).any(|rest| rest.starts_with(['.', '[']))
}

/// Why a name in the file cannot be that of a key, and what would be right.
fn not_a_name(name: &str, depth: usize) -> Option<(String, Option<String>)> {
    if depth >= DEEPEST {
        return Some((format!("tables are nested more than {DEEPEST} deep"), None));
    }
    if name.len() > LONGEST_NAME {
        return Some((format!("unknown key `{}`", shown(name, LONGEST_NAME / 4)), None));
    }
    // A quoted key with a dot or bracket is not the path that it looks like.
    name.contains(['.', '[', ']'])
        .then(|| (format!("unknown key `\"{name}\"`"), Some("write the dotted path without quotes".into())))
}

fn is_array_of_tables(items: &DeArray<'_>) -> bool {
    !items.is_empty() && items.iter().all(|item| matches!(item.get_ref(), DeValue::Table(_)))
}
