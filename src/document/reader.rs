//! Reads a file against its sections and reports every fault at its place.
//!
//! All keys of all sections are read when the reader is made, in one loop over the table. A fault stops nothing; a
//! value with a fault, or one that is absent, is `None` from there on, so that what compares two values is asked only
//! when both are right. Which keys exist is known from the sections alone, never from what was read.

use super::columns::Columns;
use super::fault::{Fault, nearest};
use super::input::Input;
use super::key::{Field, Form, Key, Occurs, Presence, Section, Value, join, key_at};
use super::text::{Document, Entry, Found, MOST_FAULTS, Place};
use super::value::{self, Misfit, Scalar};
use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

/// A file read against its sections.
#[derive(Debug)]
pub struct Reader<'a> {
    document: Document<'a>,
    /// Where the files are that the file names.
    folder: Option<&'a Path>,
    sections: &'a [&'a Section],
    /// Every value without a fault, defaults too, by its path.
    values: BTreeMap<String, Value>,
    /// The same as inputs.
    inputs: BTreeMap<String, Input>,
    /// Required keys that are absent, by their paths, until it is known whether a misspelling explains them.
    missing: BTreeMap<String, Found>,
    /// Paths that have the wrong shape: faults inside them are not reported.
    misshapen: BTreeSet<String>,
    /// Tables that a misspelt key or table may have meant.
    meant: BTreeSet<&'static str>,
    faults: RefCell<Vec<Found>>,
}

impl<'a> Reader<'a> {
    /// Reads a TOML text named `source`, then the overrides, each `key=value`, against the sections.
    #[must_use]
    pub fn new(source: &'a str, text: &'a str, overrides: &[String], sections: &'a [&'a Section]) -> Self {
        Self::in_folder(None, source, text, overrides, sections)
    }

    /// The same for a text that stands in a folder, in which other files may stand that it names.
    #[must_use]
    pub fn in_folder(
        folder: Option<&'a Path>,
        source: &'a str,
        text: &'a str,
        overrides: &[String],
        sections: &'a [&'a Section],
    ) -> Self {
        let mut document = Document::new(source, text, overrides);
        let faults = RefCell::new(std::mem::take(&mut document.faults));
        let (values, missing, misshapen) = (BTreeMap::new(), BTreeMap::new(), BTreeSet::new());
        let (inputs, meant) = (BTreeMap::new(), BTreeSet::new());
        let mut reader = Self { document, folder, sections, values, inputs, missing, misshapen, meant, faults };
        if !reader.document.broken {
            for section in sections {
                reader.section(section, source);
            }
            reader.unknown();
        }
        reader
    }

    fn section(&mut self, section: &Section, source: &str) {
        if self.has_wrong_shape(section) {
            return;
        }
        match section.occurs {
            Occurs::Optional if !self.document.has(section.path) => {}
            Occurs::With(others) if !others.iter().any(|other| self.document.has(other)) => {}
            Occurs::Once | Occurs::Optional | Occurs::With(_) => self.keys(section, section.path, source),
            Occurs::Repeated => {
                for index in 0..self.count(section) {
                    self.keys(section, &format!("{}[{index}]", section.path), source);
                }
            }
        }
    }

    /// Reports a value where the section, or a table around it, should be, or one table instead of several.
    fn has_wrong_shape(&mut self, section: &Section) -> bool {
        let path = section.path;
        let ends = path.match_indices('.').map(|(at, _)| at).chain((!path.is_empty()).then_some(path.len()));
        for end in ends {
            let around = path.get(..end).unwrap_or_default();
            let repeated = around.len() == path.len() && section.occurs == Occurs::Repeated;
            let place = if let Some(entry) = self.document.entries.get(around) {
                if repeated && matches!(&entry.value, Scalar::List(items) if items.is_empty()) {
                    continue;
                }
                entry.key.clone()
            } else {
                let arrays = || self.document.arrays.get(around).map(|(span, _)| span);
                let other = if repeated { self.document.tables.get(around) } else { arrays() };
                let Some(span) = other else { continue };
                Place::File(span.clone())
            };
            let (shape, brackets) =
                if repeated { ("an array of tables", ["[[", "]]"]) } else { ("a table", ["[", "]"]) };
            let help = Some(format!("write {}{around}{} above its keys", brackets[0], brackets[1]));
            self.wrong_shape(around, format!("`{around}` must be {shape}"), help, place);
            return true;
        }
        false
    }

    fn wrong_shape(&mut self, path: &str, message: String, help: Option<String>, place: Place) {
        if self.misshapen.insert(path.to_owned()) {
            self.told(message, help, Some(place));
        }
    }

    /// Reads every key of one table.
    fn keys(&mut self, section: &Section, table: &str, source: &str) {
        for key in section.keys {
            let path = join(table, key.name);
            let read = if let Some(entry) = self.document.entries.get(&path) {
                value::read(key, &path, &entry.value).map_err(|misfit| (misfit, Some(entry.at.clone())))
            } else if let Some(place) = self.table_at(&path) {
                // Read as a value, a table gives the message of the key's form.
                let misfit = value::read(key, &path, &Scalar::Other("table")).err();
                if let Some(Misfit { message, help }) = misfit {
                    self.wrong_shape(&path, message, help, place);
                }
                continue;
            } else {
                match key.presence {
                    Presence::Optional(_) => continue,
                    Presence::RequiredUnless(other, _) if self.document.has(other) => continue,
                    Presence::Default(text) => {
                        value::read(key, &path, &Scalar::Text(text.into())).map_err(|misfit| (misfit, None))
                    }
                    Presence::Required(_) | Presence::RequiredUnless(..) => {
                        let place = self.document.header(table).filter(|_| section.occurs == Occurs::Repeated);
                        self.missing.insert(path.clone(), missing(key, &path, source, place));
                        continue;
                    }
                }
            };
            match read.and_then(|value| self.opened(key, &path, value)) {
                Ok(value) => {
                    let entry = self.document.entries.get(&path);
                    let typed = entry.map_or_else(|| key.presence.text().to_owned(), |entry| entry.value.shown());
                    self.inputs.insert(path.clone(), Input::new(&path, value.canonical(key.form), typed));
                    self.values.insert(path, value);
                }
                Err((Misfit { message, help }, place)) => self.told(message, help, place),
            }
        }
    }

    /// The file that a value names, where its form is one; any other value as it is.
    fn opened(&self, key: &Key, path: &str, value: Value) -> Result<Value, (Misfit, Option<Place>)> {
        let (Form::Columns, Value::Text(name)) = (key.form, &value) else { return Ok(value) };
        let at = || self.document.entries.get(path).map(|entry| entry.at.clone());
        let columns = Columns::read(self.folder, name, path)
            .map_err(|(misfit, place)| (misfit, place.map_or_else(at, |place| Some(Place::Beside(place)))))?;
        Ok(Value::Columns(Arc::new(columns)))
    }

    /// Where a table or array of tables stands under a path.
    fn table_at(&self, path: &str) -> Option<Place> {
        let array = || self.document.arrays.get(path).map(|(span, _)| span);
        self.document.tables.get(path).or_else(array).map(|span| Place::File(span.clone()))
    }

    /// Reports every key and table that is in no section.
    fn unknown(&mut self) {
        let keys = || self.sections.iter().flat_map(|section| section.keys.iter().map(move |key| (section, key)));
        let known: OnceCell<Vec<String>> = OnceCell::new();
        let known = || known.get_or_init(|| keys().map(|(section, key)| section.path_of(key)).collect());
        let mut faults = Vec::new();
        for (path, entry) in &self.document.entries {
            if self.is_inside_misshapen(path) || self.is_empty_list_of_tables(path, entry) {
                continue;
            }
            let (pattern, indices) = pattern(path);
            let (message, help) = if key_at(self.sections, &pattern).is_none() {
                // Faults beyond those reported need no suggestion.
                let near = if faults.len() < MOST_FAULTS { nearest(&pattern, known()) } else { None };
                let near = near.map(|near| filled(near, &indices));
                if let Some(near) = &near {
                    // The key is there under a wrong name: do not report it, or its table, as missing too.
                    self.missing.remove(near);
                    self.meant.extend(self.sections.iter().map(|section| section.path).filter(|path| {
                        near.rsplit_once('.').is_some_and(|(table, _)| table.split('[').next() == Some(path))
                    }));
                }
                (format!("unknown key `{path}`"), near.map(|near| format!("did you mean `{near}`?")))
            } else if let Some((array, count)) = self.beyond_the_end(path) {
                let help = format!("a file adds elements, one [[{array}]] each; overrides change those it has");
                (format!("`{path}`: the file has {count} of [[{array}]], counted from 0"), Some(help))
            } else {
                continue;
            };
            faults.push(Found { message, help, place: Some(entry.key.clone()) });
        }
        for (path, span) in &self.document.tables {
            let (pattern, _) = pattern(path);
            let expected = self.sections.iter().any(|section| is_around(&pattern, section));
            if !expected && !self.document.has_inside(path) && !self.is_inside_misshapen(path) {
                let place = Some(Place::File(span.clone()));
                faults.push(Found { message: format!("unknown table `{path}`"), help: None, place });
            }
        }
        faults.extend(std::mem::take(&mut self.missing).into_values());
        self.faults.get_mut().extend(faults);
    }

    fn is_inside_misshapen(&self, path: &str) -> bool {
        let ends = path.match_indices(['.', '[']).map(|(at, _)| at).chain([path.len()]);
        ends.into_iter().any(|end| path.get(..end).is_some_and(|around| self.misshapen.contains(around)))
    }

    /// `segment = []` is no segments, not a key.
    fn is_empty_list_of_tables(&self, path: &str, entry: &Entry) -> bool {
        matches!(&entry.value, Scalar::List(items) if items.is_empty())
            && self.sections.iter().any(|section| section.occurs == Occurs::Repeated && section.path == path)
    }

    /// The array of tables in which the index of a path is out of range, with its length.
    fn beyond_the_end(&self, path: &str) -> Option<(String, usize)> {
        let open = path.find('[')?;
        let array = path.get(..open)?;
        let index = path.get(open + 1..)?.split(']').next()?;
        let count = self.document.arrays.get(array).map_or(0, |(_, count)| *count);
        (!index.parse::<usize>().is_ok_and(|index| index < count)).then(|| (array.to_owned(), count))
    }

    fn told(&self, message: String, help: Option<String>, place: Option<Place>) {
        self.faults.borrow_mut().push(Found { message, help, place });
    }

    /// Whether a fault that was reported explains why a table is absent: it has the wrong shape, or another name.
    #[must_use]
    pub fn is_explained(&self, section: &Section) -> bool {
        self.misshapen.contains(section.path) || self.meant.contains(section.path)
    }

    /// Whether no fault has been found so far.
    #[must_use]
    pub fn is_faultless(&self) -> bool {
        self.faults.borrow().is_empty()
    }

    /// Reports a fault of the whole file. What follows from a text that is not TOML is not reported.
    pub fn fail(&self, message: String, help: Option<String>) {
        if !self.document.broken {
            self.told(message, help, None);
        }
    }

    /// A table that stands once, or one whose values are all `None` because it is absent.
    #[must_use]
    pub fn table(&self, section: &Section) -> Table<'_> {
        Table { reader: self, path: section.path.to_owned() }
    }

    /// An optional table, when it is in the file or an override sets a key of it.
    #[must_use]
    pub fn find(&self, section: &Section) -> Option<Table<'_>> {
        self.document.has(section.path).then(|| self.table(section))
    }

    /// The elements of a repeated table, in the order of the file.
    pub fn elements(&self, section: &Section) -> impl Iterator<Item = Table<'_>> {
        let path = section.path;
        (0..self.count(section)).map(move |index| Table { reader: self, path: format!("{path}[{index}]") })
    }

    /// How many elements a repeated table has.
    fn count(&self, section: &Section) -> usize {
        self.document.arrays.get(section.path).map_or(0, |(_, count)| *count)
    }

    /// The keys the user gave: those set by overrides, and, when `file` says so, those of the file. Of a table that
    /// belongs to one kind of cam only those set by overrides count: a file may describe several kinds.
    #[must_use]
    pub fn given(&self, file: bool) -> Vec<String> {
        let of_one_kind = |path: &str| {
            let (pattern, _) = pattern(path);
            key_at(self.sections, &pattern).is_some_and(|(section, _)| !section.cams.is_empty())
        };
        let entries = self.document.entries.iter();
        let given = entries.filter(|(path, entry)| entry.by_override() || (file && !of_one_kind(path)));
        given.map(|(path, _)| path.clone()).collect()
    }

    /// Every value without a fault, defaults too, in the order of their paths.
    #[must_use]
    pub fn inputs(&self) -> Vec<Input> {
        self.inputs.values().cloned().collect()
    }

    /// Ends the reading.
    ///
    /// # Errors
    /// All faults, in the order of their places, none twice.
    pub fn finish(self) -> Result<(), Vec<Fault>> {
        let faults = self.document.told(self.faults.into_inner());
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }
}

/// One table of a file that is being read.
#[derive(Debug, Clone)]
pub struct Table<'r> {
    reader: &'r Reader<'r>,
    path: String,
}

impl Table<'_> {
    fn path_of(&self, key: &Key) -> String {
        join(&self.path, key.name)
    }

    /// The value of a key; `None` when it is absent without a default, or has a fault, which has been reported.
    #[must_use]
    pub fn get<T: Clone>(&self, field: &Field<T>) -> Option<T> {
        self.reader.values.get(&self.path_of(&field.key)).and_then(|value| field.of(value))
    }

    /// Whether a key is in the file or is set by an override, with a fault or without.
    #[must_use]
    pub fn has<T>(&self, field: &Field<T>) -> bool {
        let path = self.path_of(&field.key);
        self.reader.document.entries.contains_key(&path) || self.reader.table_at(&path).is_some()
    }

    /// The value of a key as it was typed, for messages that compare two keys.
    #[must_use]
    pub fn typed<T>(&self, field: &Field<T>) -> String {
        let entry = self.reader.document.entries.get(&self.path_of(&field.key));
        entry.and_then(|entry| entry.value.typed()).unwrap_or("its default").to_owned()
    }

    /// Reports a fault at the value of a key, or at the header of its table when it is absent. What follows from a text that is not
    /// TOML is not reported.
    pub fn fail<T>(&self, field: &Field<T>, message: String, help: Option<String>) {
        if !self.reader.document.broken {
            let entry = self.reader.document.entries.get(&self.path_of(&field.key));
            let place = entry.map(|entry| entry.at.clone()).or_else(|| self.reader.document.header(&self.path));
            self.reader.told(message, help, place);
        }
    }

    /// Reports a fault at a character, from 1, of the text of a key.
    pub fn fail_at(&self, field: &Field<String>, character: usize, message: String, help: Option<String>) {
        let entry = self.reader.document.entries.get(&self.path_of(&field.key));
        let Some(entry) = entry.filter(|_| !self.reader.document.broken) else {
            return self.fail(field, message, help);
        };
        let place = self.reader.document.character(entry.at.clone(), character);
        self.reader.told(message, help, Some(place));
    }

    /// Reports a fault at a row, from 0, of the file that a key names.
    pub fn fail_in(&self, field: &Field<Arc<Columns>>, row: usize, message: String, help: Option<String>) {
        match self.get(field).and_then(|columns| columns.excerpt(row)) {
            Some(place) => self.reader.told(message, help, Some(Place::Beside(Box::new(place)))),
            None => self.fail(field, message, help),
        }
    }
}

fn missing(key: &Key, path: &str, source: &str, place: Option<Place>) -> Found {
    Found {
        message: format!("missing key `{path}` in {source}"),
        help: Some(format!("add it, e.g. {} = {}", key.name, key.in_toml(key.presence.text()))),
        place,
    }
}

/// Whether a table with this pattern is the section's, or around it.
fn is_around(pattern: &str, section: &Section) -> bool {
    if section.occurs == Occurs::Repeated && pattern.strip_suffix("[]") == Some(section.path) {
        return true;
    }
    let own = |rest: &str| rest.is_empty() && section.occurs != Occurs::Repeated;
    section.path.strip_prefix(pattern).is_some_and(|rest| own(rest) || rest.starts_with('.'))
}

/// A path with its indices left open, and the indices: `motion.segment[1].law` gives `motion.segment[].law` and `1`.
/// Anything but a plain index is kept, so that it matches no key.
pub(super) fn pattern(path: &str) -> (Cow<'_, str>, Vec<&str>) {
    let mut indices = Vec::new();
    if !path.contains('[') {
        return (path.into(), indices);
    }
    let parts: Vec<String> = path
        .split('.')
        .map(|part| {
            let index = part.strip_suffix(']').and_then(|part| part.split_once('['));
            match index {
                Some((name, index)) if index.parse::<usize>().is_ok_and(|number| number.to_string() == index) => {
                    indices.push(index);
                    format!("{name}[]")
                }
                _ => part.to_owned(),
            }
        })
        .collect();
    (parts.join(".").into(), indices)
}

/// A pattern with indices put into it; 0 where none is left.
fn filled(pattern: &str, indices: &[&str]) -> String {
    let mut indices = indices.iter();
    let mut parts = pattern.split("[]");
    let mut path = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        path.push_str(&format!("[{}]{part}", indices.next().unwrap_or(&"0")));
    }
    path
}
