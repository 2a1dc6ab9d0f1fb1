//! A TOML text and overrides, read key by key, with every fault told at its place.
//!
//! The file is flattened to dotted paths with their places. Reading a key declares it, with its kind, range and
//! default: there is no second list of keys to keep in step. What was never declared is an unknown key. A fault does
//! not stop the reading; all of them are shown at once.

use super::bounds::Bounds;
use super::fault::{Excerpt, Fault, MachineError, nearest};
use crate::units::{self, Dimension, Quantity, QuantityError};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

#[derive(Debug, Clone)]
enum Scalar {
    Text(String),
    Number(String),
    Other(&'static str),
}

#[derive(Debug, Clone)]
enum Place {
    File { key: Range<usize>, value: Range<usize> },
    Flag,
}

#[derive(Debug, Clone)]
struct Entry {
    value: Scalar,
    place: Place,
    known: bool,
}

pub(crate) struct Reader<'a> {
    source: &'a str,
    text: &'a str,
    entries: BTreeMap<String, Entry>,
    /// Tables that stand in the file: one with nothing declared in it is an unknown key too.
    tables: Vec<(String, Range<usize>)>,
    /// Keys that were read.
    declared: Vec<&'static str>,
    /// The text is no TOML; what follows from that is not worth telling.
    broken: bool,
    faults: Vec<Fault>,
}

impl<'a> Reader<'a> {
    /// Reads a TOML text named `source`, then the overrides, each `key=value`.
    pub(crate) fn new(source: &'a str, text: &'a str, overrides: &[String]) -> Self {
        let mut reader = Self {
            source,
            text,
            entries: BTreeMap::new(),
            tables: Vec::new(),
            declared: Vec::new(),
            broken: false,
            faults: Vec::new(),
        };
        let (table, errors) = DeTable::parse_recoverable(text);
        for error in errors {
            let place = error.span().map(|span| reader.excerpt(&span));
            reader.broken = true;
            reader.faults.push(Fault { message: format!("not TOML: {}", error.message()), help: None, place });
        }
        reader.flatten("", table.get_ref());
        for text in overrides {
            reader.override_with(text);
        }
        reader
    }

    fn flatten(&mut self, prefix: &str, table: &DeTable<'_>) {
        for (key, value) in table {
            let path =
                if prefix.is_empty() { key.get_ref().to_string() } else { format!("{prefix}.{}", key.get_ref()) };
            if key.get_ref().contains('.') {
                // A quoted key with a dot in it is another key than the dotted path it looks like.
                let place = Some(self.excerpt(&key.span()));
                let message = format!("unknown key `\"{}\"`", key.get_ref());
                self.faults.push(Fault { message, help: Some("write the dotted path without quotes".into()), place });
                continue;
            }
            let scalar = match value.get_ref() {
                DeValue::Table(inner) => {
                    self.tables.push((path.clone(), key.span()));
                    self.flatten(&path, inner);
                    continue;
                }
                DeValue::String(text) => Scalar::Text(text.to_string()),
                DeValue::Integer(_) | DeValue::Float(_) => {
                    let written = self.text.get(value.span()).unwrap_or_default();
                    Scalar::Number(written.replace('_', ""))
                }
                other => Scalar::Other(other.type_str()),
            };
            let place = Place::File { key: key.span(), value: value.span() };
            self.entries.insert(path, Entry { value: scalar, place, known: false });
        }
    }

    fn override_with(&mut self, text: &str) {
        let Some((key, value)) = text.split_once('=') else {
            self.faults.push(Fault {
                message: format!("--set {text}: no `=`"),
                help: Some("write --set KEY=VALUE, e.g. --set follower.roller.radius=25mm".into()),
                place: None,
            });
            return;
        };
        let value = value.trim();
        let value = value.strip_prefix('"').and_then(|v| v.strip_suffix('"')).unwrap_or(value).to_owned();
        let entry = Entry { value: Scalar::Text(value), place: Place::Flag, known: false };
        self.entries.insert(key.trim().to_owned(), entry);
    }

    fn excerpt(&self, span: &Range<usize>) -> Excerpt {
        let at = span.start.min(self.text.len());
        let before = self.text.get(..at).unwrap_or_default();
        let line_start = before.rfind('\n').map_or(0, |n| n + 1);
        let line_end = self.text.get(at..).and_then(|rest| rest.find('\n')).map_or(self.text.len(), |n| at + n);
        let width = self.text.get(at..span.end.clamp(at, line_end)).unwrap_or_default().chars().count();
        Excerpt {
            source: self.source.to_owned(),
            line: before.matches('\n').count() + 1,
            column: self.text.get(line_start..at).unwrap_or_default().chars().count() + 1,
            text: self.text.get(line_start..line_end).unwrap_or_default().trim_end().to_owned(),
            width,
        }
    }

    fn place(&self, key: &str, of_value: bool) -> Option<Excerpt> {
        let entry = self.entries.get(key)?;
        match &entry.place {
            Place::File { key, value } => Some(self.excerpt(if of_value { value } else { key })),
            Place::Flag => {
                let shown = match &entry.value {
                    Scalar::Text(text) | Scalar::Number(text) => text.as_str(),
                    Scalar::Other(_) => "",
                };
                let column = if of_value { key.chars().count() + 2 } else { 1 };
                let width = if of_value { shown.chars().count() } else { key.chars().count() };
                let text = format!("{key}={shown}");
                Some(Excerpt { source: "--set".into(), line: 1, column, text, width })
            }
        }
    }

    /// Notes a fault at the value of a key; the key's own default or absence has no place.
    pub(crate) fn fail(&mut self, key: &str, message: String, help: Option<String>) {
        let place = self.place(key, true);
        self.faults.push(Fault { message, help, place });
    }

    fn declare(&mut self, key: &'static str) -> Option<Scalar> {
        self.declared.push(key);
        let entry = self.entries.get_mut(key)?;
        entry.known = true;
        Some(entry.value.clone())
    }

    /// Whether a table or key stands in the file or is set by a flag.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.tables.iter().any(|(table, _)| table == path)
            || self
                .entries
                .keys()
                .any(|key| key == path || key.strip_prefix(path).is_some_and(|rest| rest.starts_with('.')))
    }

    fn missing(&mut self, key: &'static str, example: &str) {
        self.faults.push(Fault {
            message: format!("missing key `{key}` in {}", self.source),
            help: Some(format!("add it, e.g. {example}")),
            place: None,
        });
    }

    /// A text, required.
    pub(crate) fn text(&mut self, key: &'static str, example: &str) -> String {
        match self.declare(key) {
            Some(Scalar::Text(text)) if !text.trim().is_empty() && !text.chars().any(char::is_control) => text,
            Some(_) => {
                self.fail(key, format!("`{key}` must be a text"), Some(format!("e.g. \"{example}\"")));
                String::new()
            }
            None => {
                self.missing(key, &format!("\"{example}\""));
                String::new()
            }
        }
    }

    /// One of a few words; the first is the default.
    pub(crate) fn word<T: Copy>(&mut self, key: &'static str, words: &[(&str, T)]) -> Option<T> {
        let list = || words.iter().map(|(word, _)| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
        match self.declare(key) {
            None => words.first().map(|(_, value)| *value),
            Some(Scalar::Text(text)) => {
                let found = words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
                if found.is_none() {
                    self.fail(key, format!("`{key}` cannot be \"{text}\""), Some(format!("one of {}", list())));
                }
                found
            }
            Some(_) => {
                self.fail(key, format!("`{key}` must be a word"), Some(format!("one of {}", list())));
                None
            }
        }
    }

    /// A bare number, or the default.
    pub(crate) fn number(&mut self, key: &'static str, default: Option<f64>, bounds: Bounds) -> f64 {
        let text = match self.declare(key) {
            Some(Scalar::Number(text) | Scalar::Text(text)) => text,
            Some(Scalar::Other(kind)) => {
                self.fail(key, format!("`{key}` must be a number, not {kind}"), None);
                return f64::NAN;
            }
            None => {
                return default.unwrap_or_else(|| {
                    self.missing(key, &format!("{}", bounds.low.max(1.0)));
                    f64::NAN
                });
            }
        };
        match units::parse_bare(&text) {
            Ok(value) if bounds.holds(value) => value,
            Ok(value) => {
                let limit = bounds.broken(value, |v| v.to_string());
                self.fail(key, format!("`{key}` must be {limit}: {value}"), None);
                f64::NAN
            }
            Err(error) => {
                let help = format!("`{key}` is a bare number, without a unit");
                self.fail(key, format!("`{key}`: {error}"), Some(help));
                f64::NAN
            }
        }
    }

    /// A quantity that may be absent. A fault gives `None` too.
    pub(crate) fn optional(&mut self, key: &'static str, dimension: Dimension, bounds: Bounds) -> Option<Quantity> {
        match self.declare(key)? {
            Scalar::Text(text) => self.quantity_text(key, &text, dimension, bounds, ""),
            Scalar::Number(text) => {
                self.not_a_quantity(key, dimension, &QuantityError::MissingUnit { found: text }, "");
                None
            }
            Scalar::Other(kind) => {
                self.fail(key, format!("`{key}` must be a quantity of {dimension}, not {kind}"), None);
                None
            }
        }
    }

    /// A required quantity; NaN after a fault.
    pub(crate) fn quantity(&mut self, key: &'static str, dimension: Dimension, example: &str, bounds: Bounds) -> f64 {
        if !self.entries.contains_key(key) {
            self.declared.push(key);
            self.missing(key, &format!("\"{example}\""));
            return f64::NAN;
        }
        self.optional(key, dimension, bounds).map_or(f64::NAN, |quantity| quantity.si)
    }

    /// A quantity with a default in SI units; NaN after a fault.
    pub(crate) fn quantity_or(&mut self, key: &'static str, dimension: Dimension, default: f64, bounds: Bounds) -> f64 {
        if !self.entries.contains_key(key) {
            self.declared.push(key);
            return default;
        }
        self.optional(key, dimension, bounds).map_or(f64::NAN, |quantity| quantity.si)
    }

    /// A word or a quantity; the first word is the default.
    pub(crate) fn word_or_quantity<T: Copy>(
        &mut self,
        key: &'static str,
        words: &[(&str, T)],
        dimension: Dimension,
        bounds: Bounds,
        from: fn(f64) -> T,
    ) -> Option<T> {
        let or_words: Vec<String> = words.iter().map(|(word, _)| format!(" or \"{word}\"")).collect();
        let or_words = or_words.concat();
        match self.declare(key) {
            None => words.first().map(|(_, value)| *value),
            Some(Scalar::Text(text)) => match words.iter().find(|(word, _)| *word == text) {
                Some((_, value)) => Some(*value),
                None => self.quantity_text(key, &text, dimension, bounds, &or_words).map(|q| from(q.si)),
            },
            Some(Scalar::Number(text)) => {
                self.not_a_quantity(key, dimension, &QuantityError::MissingUnit { found: text }, &or_words);
                None
            }
            Some(Scalar::Other(kind)) => {
                self.fail(key, format!("`{key}` must be a quantity of {dimension}{or_words}, not {kind}"), None);
                None
            }
        }
    }

    /// A band of two quantities, `"35 mm .. 60 mm"`, the first below the second; may be absent.
    pub(crate) fn band(&mut self, key: &'static str, dimension: Dimension, bounds: Bounds) -> Option<(f64, f64)> {
        let text = match self.declare(key)? {
            Scalar::Text(text) => text,
            _ => String::new(),
        };
        let Some((low, high)) = text.split_once("..") else {
            let help = format!("two quantities of {dimension}, e.g. \"35 mm .. 60 mm\"");
            self.fail(key, format!("`{key}` must be a band"), Some(help));
            return None;
        };
        let low = self.quantity_text(key, low, dimension, bounds, "")?.si;
        let high = self.quantity_text(key, high, dimension, bounds, "")?.si;
        if low >= high {
            self.fail(key, format!("`{key}` must go from the smaller to the larger: {text}"), None);
            return None;
        }
        Some((low, high))
    }

    fn quantity_text(
        &mut self,
        key: &'static str,
        text: &str,
        dimension: Dimension,
        bounds: Bounds,
        or_words: &str,
    ) -> Option<Quantity> {
        match units::parse(text, dimension) {
            Ok(quantity) if bounds.holds(quantity.si) => Some(quantity),
            Ok(quantity) => {
                let limit = bounds.broken(quantity.si, |v| quantity.in_same_unit(v));
                self.fail(key, format!("`{key}` must be {limit}: {}", text.trim()), None);
                None
            }
            Err(error) => {
                self.not_a_quantity(key, dimension, &error, or_words);
                None
            }
        }
    }

    fn not_a_quantity(&mut self, key: &'static str, dimension: Dimension, error: &QuantityError, or_words: &str) {
        let units = dimension.unit_list();
        let help = format!("`{key}` is a {dimension}: a number and one of {units}{or_words}");
        self.fail(key, format!("`{key}`: {error}"), Some(help));
    }

    /// The value of a key as it was typed, for messages that compare two keys.
    pub(crate) fn typed(&self, key: &str) -> String {
        match self.entries.get(key).map(|entry| &entry.value) {
            Some(Scalar::Text(text) | Scalar::Number(text)) => text.clone(),
            _ => "its default".into(),
        }
    }

    /// All faults found, unknown keys among them; `Ok` when there are none.
    pub(crate) fn finish(mut self) -> Result<(), MachineError> {
        if self.broken {
            self.faults.retain(|fault| fault.message.starts_with("not TOML"));
            return Err(MachineError { faults: self.faults });
        }
        for (table, span) in std::mem::take(&mut self.tables) {
            let inside = |key: &str| key.strip_prefix(&table).is_some_and(|rest| rest.starts_with('.'));
            if !self.declared.iter().any(|key| inside(key)) && !self.entries.keys().any(|key| inside(key)) {
                let place = Some(self.excerpt(&span));
                self.faults.push(Fault { message: format!("unknown table `{table}`"), help: None, place });
            }
        }
        let unknown: Vec<String> =
            self.entries.iter().filter(|(_, entry)| !entry.known).map(|(key, _)| key.clone()).collect();
        for key in unknown {
            let nearest = nearest(&key, &self.declared);
            self.faults.push(Fault {
                message: format!("unknown key `{key}`"),
                help: nearest.map(|near| format!("did you mean `{near}`?")),
                place: self.place(&key, false),
            });
        }
        if self.faults.is_empty() {
            return Ok(());
        }
        self.faults.sort_by_key(|fault| fault.place.as_ref().map(|place| (place.source.clone(), place.line)));
        Err(MachineError { faults: self.faults })
    }
}
