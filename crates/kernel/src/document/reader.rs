//! Reads a file against its sections and reports every fault at its place.
//!
//! All keys of all sections are read when the reader is made, in one loop over the table. A fault stops nothing; a
//! value with a fault, or one that is absent, is `None` from there on, so that two values are compared only when
//! both are right. Which keys exist is known from the sections alone, never from what was read.

use super::columns::Columns;
use super::fault::{FileFault, KnownKey, Misfit, nearest, similar};
use super::input::Input;
use super::key::{Field, Key, KeyForm, KeySection, KeyValue, Occurrence, Presence, join, key_at};
use super::named::NamedFiles;
use super::text::{Document, FlatText, MOST_FAULTS, PendingFault, TextPlace, TomlEntry};
use super::value::{self, Scalar};
use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A file read against its sections.
#[derive(Debug)]
pub struct Reader<'a> {
    document: Document<'a>,
    /// Where the files are that the file names.
    files: &'a NamedFiles,
    sections: &'a [&'a KeySection],
    /// Every value without a fault, defaults too, by its path.
    values: BTreeMap<String, KeyValue>,
    /// These values as inputs.
    inputs: BTreeMap<String, Input>,
    /// Required keys that are absent, by their paths, until it is known whether a misspelling explains them.
    missing: BTreeMap<String, PendingFault>,
    /// Paths that have the wrong shape: faults inside them are not reported.
    misshapen: BTreeSet<String>,
    /// Keys that are given by twice their value, as a radius by its diameter: their paths, and those of the keys that give them.
    doubled: BTreeMap<String, String>,
    /// Tables that a misspelt key or table may have meant.
    meant: BTreeSet<&'static str>,
    /// Keys that misspelt ones may have meant: that they are absent is explained.
    meant_keys: BTreeSet<String>,
    faults: RefCell<Vec<PendingFault>>,
    /// What is known of the text without overrides; values and inputs are then only those that overrides set.
    known: Option<&'a KnownValues>,
}

/// The values of a text without overrides and without a fault: with an override of one of them the others are as they are.
#[derive(Debug)]
pub struct KnownValues {
    values: BTreeMap<String, KeyValue>,
    inputs: BTreeMap<String, Input>,
    given: Vec<String>,
}

impl<'a> Reader<'a> {
    /// Reads a TOML text named `source`, then the overrides, each `key=value`, against the sections.
    #[must_use]
    pub fn new(source: &'a str, text: &'a str, overrides: &[String], sections: &'a [&'a KeySection]) -> Self {
        Self::of_flat((&NamedFiles::Nowhere, source), FlatText::new(text, sections), overrides, sections)
    }

    /// Reads a text that is flattened, with its name and where the files are that it names.
    #[must_use]
    pub fn of_flat(
        (files, source): (&'a NamedFiles, &'a str),
        flat: FlatText,
        overrides: &[String],
        sections: &'a [&'a KeySection],
    ) -> Self {
        let mut document = Document::new(source, flat, overrides);
        let faults = std::mem::take(&mut document.faults);
        let mut reader = Self { faults: RefCell::new(faults), ..Self::unread(document, files, sections) };
        if !reader.document.broken {
            for section in sections {
                reader.section(section, source);
            }
            reader.unknown();
        }
        reader
    }

    /// What it has read, for [`Reader::of_known`]; `None` where there is a fault, or where a value is given by another key or by a word for
    /// its table.
    pub fn known(&self) -> Option<KnownValues> {
        let by_word = |section: &KeySection| section.keys.iter().any(|key| key.for_table.is_some());
        let as_word = |section: &&'a KeySection| {
            by_word(section) && self.document.has(section.path) && !self.document.tables.contains_key(section.path)
        };
        let plain = self.doubled.is_empty() && !self.sections.iter().any(as_word);
        if !self.is_faultless() || !plain {
            return None;
        }
        let given = self.given(true);
        Some(KnownValues { values: self.values.clone(), inputs: self.inputs.clone(), given })
    }

    /// As [`Reader::of_flat`], from what is known of the text without overrides: only what they set is read. `None` where they may change
    /// more than the values that they set, or have a fault; then everything is to be read.
    #[must_use]
    pub fn of_known(
        (files, source): (&'a NamedFiles, &'a str),
        flat: &FlatText,
        overrides: &[String],
        sections: &'a [&'a KeySection],
        known: &'a KnownValues,
    ) -> Option<Self> {
        let document = Document::new(source, flat.clone(), overrides);
        if document.broken || !document.faults.is_empty() {
            return None;
        }
        let (mut values, mut inputs) = (BTreeMap::new(), BTreeMap::new());
        for path in document.overridden() {
            let (pattern, _) = pattern(path);
            let (section, key) = key_at(sections, &pattern)?;
            let twin = section.keys.iter().find(|other| other.halved == Some(key.name));
            let table = path.strip_suffix(key.name)?;
            let by_twin = twin.is_some_and(|twin| flat.has_value(&format!("{table}{}", twin.name)));
            let plain = key.halved.is_none() && key.for_table.is_none() && key.form != KeyForm::Columns;
            if !plain || by_twin || !flat.holds(path) {
                return None;
            }
            let entry = document.entries.get(path)?;
            let value = value::read(key, path, &entry.value).ok()?;
            inputs.insert(path.to_owned(), Input::new(path, value.canonical(key.form), entry.value.shown()));
            values.insert(path.to_owned(), value);
        }
        let unread = Self::unread(document, files, sections);
        Some(Self { values, inputs, known: Some(known), ..unread })
    }

    /// Of a document of which nothing is read.
    fn unread(document: Document<'a>, files: &'a NamedFiles, sections: &'a [&'a KeySection]) -> Self {
        Self {
            document,
            files,
            sections,
            values: BTreeMap::new(),
            inputs: BTreeMap::new(),
            missing: BTreeMap::new(),
            misshapen: BTreeSet::new(),
            doubled: BTreeMap::new(),
            meant: BTreeSet::new(),
            meant_keys: BTreeSet::new(),
            faults: RefCell::new(Vec::new()),
            known: None,
        }
    }

    fn value(&self, path: &str) -> Option<&KeyValue> {
        self.values.get(path).or_else(|| self.known?.values.get(path))
    }

    /// Whether a table and all within it are as in the text, and without a fault there.
    pub fn is_known(&self, section: &KeySection) -> bool {
        let within = |path: &str| path.strip_prefix(section.path).is_some_and(|rest| rest.starts_with(['.', '[']));
        self.known.is_some() && !self.document.overridden().any(within)
    }

    /// A word in the place of a table is that of each of its keys that may have it.
    fn spread_word(&mut self, section: &KeySection) {
        let Some(Scalar::Text(word)) = self.document.entries.get(section.path).map(|entry| &entry.value) else {
            return;
        };
        let keys: Vec<&Key> = section.keys.iter().filter(|key| key.for_table == Some(word.as_str())).collect();
        if keys.is_empty() {
            return;
        }
        if let Some(entry) = self.document.entries.remove(section.path) {
            for key in keys {
                self.document.entries.entry(join(section.path, key.name)).or_insert_with(|| entry.clone());
            }
        }
    }

    fn section(&mut self, section: &KeySection, source: &str) {
        self.spread_word(section);
        if self.has_wrong_shape(section) {
            return;
        }
        match section.occurs {
            Occurrence::Optional if !self.document.has(section.path) => {}
            Occurrence::With(others) if !others.iter().any(|other| self.document.has(other)) => {}
            Occurrence::Once | Occurrence::Optional | Occurrence::With(_) => self.keys(section, section.path, source),
            Occurrence::Repeated => {
                for index in 0..self.count(section) {
                    self.keys(section, &format!("{}[{index}]", section.path), source);
                }
            }
        }
    }

    /// Reports a value where the section, or a table around it, should be, or one table instead of several.
    fn has_wrong_shape(&mut self, section: &KeySection) -> bool {
        let path = section.path;
        let ends = path.match_indices('.').map(|(at, _)| at).chain((!path.is_empty()).then_some(path.len()));
        for end in ends {
            let around = path.get(..end).unwrap_or_default();
            let repeated = around.len() == path.len() && section.occurs == Occurrence::Repeated;
            let place = if let Some(entry) = self.document.entries.get(around) {
                if repeated && matches!(&entry.value, Scalar::List(items) if items.is_empty()) {
                    continue;
                }
                entry.key.clone()
            } else {
                let arrays = || self.document.arrays.get(around).map(|(span, _)| span);
                let other = if repeated { self.document.tables.get(around) } else { arrays() };
                let Some(span) = other else { continue };
                TextPlace::File(span.clone())
            };
            let (shape, brackets) =
                if repeated { ("an array of tables", ["[[", "]]"]) } else { ("a table", ["[", "]"]) };
            let word = section.keys.iter().find_map(|key| key.for_table).filter(|_| around == path);
            let word = word.map_or_else(String::new, |word| format!(", or {around} = \"{word}\""));
            let help = Some(format!("write {}{around}{} above its keys{word}", brackets[0], brackets[1]));
            self.wrong_shape(around, format!("`{around}` must be {shape}"), help, place);
            return true;
        }
        false
    }

    fn wrong_shape(&mut self, path: &str, message: String, help: Option<String>, place: TextPlace) {
        if self.misshapen.insert(path.to_owned()) {
            self.report(message, help, Some(place));
        }
    }

    /// Reads every key of one table.
    fn keys(&mut self, section: &KeySection, table: &str, source: &str) {
        for key in section.keys {
            let path = join(table, key.name);
            if !self.is_chosen(section, key, table) {
                continue;
            }
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
                        let place = self.document.header(table).filter(|_| section.occurs == Occurrence::Repeated);
                        self.missing.insert(path.clone(), missing((section, key), &path, source, place));
                        continue;
                    }
                }
            };
            match read.and_then(|value| self.opened(key, &path, value)) {
                Ok(value) => {
                    let entry = self.document.entries.get(&path);
                    let typed = entry.map_or_else(|| key.presence.text().to_owned(), |entry| entry.value.shown());
                    let (path, value, typed) = match key.halved {
                        None => (path, value, typed),
                        Some(radius) => (join(table, radius), value.halved(), format!("Ø{typed}")),
                    };
                    self.inputs.insert(path.clone(), Input::new(&path, value.canonical(key.form), typed));
                    self.values.insert(path, value);
                }
                Err((Misfit { message, help }, place)) => self.report(message, help, place),
            }
        }
    }

    /// Whether a key of a table is the one to read: of a radius and its diameter the given one, of both the one that an override sets.
    /// Both together are a fault.
    fn is_chosen(&mut self, section: &KeySection, key: &Key, table: &str) -> bool {
        let doubled = |other: &&Key| other.halved == Some(key.name);
        let Some(other) = key.halved.or_else(|| section.keys.iter().find(doubled).map(|other| other.name)) else {
            return true;
        };
        let (own, other) = (join(table, key.name), join(table, other));
        let entries = &self.document.entries;
        match (entries.get(&own), entries.get(&other), key.halved) {
            (None, Some(_), _) => false,
            (Some(_), None, Some(_)) => {
                self.doubled.insert(other, own);
                true
            }
            (Some(entry), Some(against), halved) if entry.by_override() != against.by_override() => {
                if entry.by_override() && halved.is_some() {
                    self.doubled.insert(other, own.clone());
                }
                entry.by_override()
            }
            (None, None, _) | (Some(_), _, None) => true,
            (Some(entry), Some(_), Some(radius)) => {
                let message = format!("give `{radius}` or `{}`, not both", key.name);
                let help = format!("they are the same dimension: remove one, `{other}` or `{own}`");
                self.report(message, Some(help), Some(entry.key.clone()));
                false
            }
        }
    }

    /// The value at a path as it is in the file or set by an override, where the key may be given by twice its value.
    fn entry(&self, path: &str) -> Option<&TomlEntry> {
        self.document.entries.get(self.doubled.get(path).map_or(path, String::as_str))
    }

    /// The file that a value names, where its form is one; any other value as it is.
    fn opened(&self, key: &Key, path: &str, value: KeyValue) -> Result<KeyValue, (Misfit, Option<TextPlace>)> {
        let (KeyForm::Columns, KeyValue::Text(name)) = (key.form, &value) else { return Ok(value) };
        let at = || self.document.entries.get(path).map(|entry| entry.at.clone());
        let by_user = self.document.entries.get(path).is_some_and(TomlEntry::by_override);
        let columns = Columns::read(self.files, name, path, by_user)
            .map_err(|(misfit, place)| (misfit, place.map_or_else(at, |place| Some(TextPlace::OtherFile(place)))))?;
        Ok(KeyValue::Columns(Arc::new(columns)))
    }

    /// The texts of the files that it names, by these names.
    pub fn named_texts(&self) -> BTreeMap<String, String> {
        let text = |(path, value): (&String, &KeyValue)| {
            let KeyValue::Columns(columns) = value else { return None };
            let by_user = self.document.entries.get(path).is_some_and(TomlEntry::by_override);
            Some((columns.name().to_owned(), columns.text(self.files, by_user)?))
        };
        self.values.iter().filter_map(text).collect()
    }

    /// The place of a table or array of tables with a path.
    fn table_at(&self, path: &str) -> Option<TextPlace> {
        let array = || self.document.arrays.get(path).map(|(span, _)| span);
        self.document.tables.get(path).or_else(array).map(|span| TextPlace::File(span.clone()))
    }

    /// Reports every key and table that is in no section.
    fn unknown(&mut self) {
        let (sections, document) = (self.sections, &self.document);
        let known: OnceCell<Vec<KnownKey>> = OnceCell::new();
        let known = || known.get_or_init(|| known_keys(sections, document));
        let mut faults = Vec::new();
        for (path, entry) in &self.document.entries {
            if self.is_inside_misshapen(path) || self.is_empty_list_of_tables(path, entry) {
                continue;
            }
            let (pattern, indices) = pattern(path);
            let (message, help) = if key_at(self.sections, &pattern).is_none() {
                // Faults beyond those reported need no suggestion.
                let near = if faults.len() < MOST_FAULTS { nearest(&pattern, known()) } else { Vec::new() };
                let near: Vec<String> = near.into_iter().map(|near| filled(near, &indices)).collect();
                for near in &near {
                    // The key is there under a wrong name: neither it nor its table is also reported as missing.
                    self.missing.remove(near);
                    self.meant_keys.insert(near.clone());
                    if let Some((table, radius)) = halved_at(sections, near) {
                        self.missing.remove(&join(table, radius));
                    }
                    self.meant.extend(self.sections.iter().map(|section| section.path).filter(|path| {
                        near.rsplit_once('.').is_some_and(|(table, _)| table.split('[').next() == Some(path))
                    }));
                }
                (format!("unknown key `{path}`"), suggestion(sections, path, &near))
            } else if let Some((array, count)) = self.beyond_the_end(path) {
                let help =
                    format!("--set changes only elements that the file has; add one to the file with [[{array}]]");
                (format!("`{path}`: no such element, the file has {count} of [[{array}]], counted from 0"), Some(help))
            } else {
                continue;
            };
            faults.push(PendingFault::at(message, help, Some(entry.key.clone())));
        }
        for (path, span) in self.document.tables.iter() {
            let (pattern, _) = pattern(path);
            let expected = self.sections.iter().any(|section| is_around(&pattern, section));
            if !expected && !self.document.has_inside(path) && !self.is_inside_misshapen(path) {
                let place = Some(TextPlace::File(span.clone()));
                let near = similar(path, sections.iter().map(|section| section.path));
                let help = near.map(|near| format!("did you mean [{near}]?"));
                faults.push(PendingFault::at(format!("unknown table `{path}`"), help, place));
            }
        }
        faults.extend(std::mem::take(&mut self.missing).into_values());
        self.faults.get_mut().extend(faults);
    }

    fn is_inside_misshapen(&self, path: &str) -> bool {
        let ends = path.match_indices(['.', '[']).map(|(at, _)| at).chain([path.len()]);
        ends.into_iter().any(|end| path.get(..end).is_some_and(|around| self.misshapen.contains(around)))
    }

    /// `segment = []` means a list without segments, not a key.
    fn is_empty_list_of_tables(&self, path: &str, entry: &TomlEntry) -> bool {
        matches!(&entry.value, Scalar::List(items) if items.is_empty())
            && self.sections.iter().any(|section| section.occurs == Occurrence::Repeated && section.path == path)
    }

    /// The array of tables in which the index of a path is out of range, with its length.
    fn beyond_the_end(&self, path: &str) -> Option<(String, usize)> {
        let open = path.find('[')?;
        let array = path.get(..open)?;
        let index = path.get(open + 1..)?.split(']').next()?;
        let count = self.document.arrays.get(array).map_or(0, |(_, count)| *count);
        (!index.parse::<usize>().is_ok_and(|index| index < count)).then(|| (array.to_owned(), count))
    }

    fn report(&self, message: String, help: Option<String>, place: Option<TextPlace>) {
        self.faults.borrow_mut().push(PendingFault::at(message, help, place));
    }

    /// Whether a fault that was reported explains why a table is absent: it has the wrong shape, or another name.
    #[must_use]
    pub fn is_explained(&self, section: &KeySection) -> bool {
        self.misshapen.contains(section.path) || self.meant.contains(section.path)
    }

    /// Whether no fault has been found so far.
    #[must_use]
    pub fn is_faultless(&self) -> bool {
        self.faults.borrow().is_empty()
    }

    /// Whether the reported number of faults is reached, so that the search for more can end.
    #[must_use]
    pub fn has_most_faults(&self) -> bool {
        self.faults.borrow().len() >= MOST_FAULTS
    }

    /// Reports a fault of the whole file. What follows from a text that is not TOML is not reported.
    pub fn fail(&self, message: String, help: Option<String>) {
        if !self.document.broken {
            self.report(message, help, None);
        }
    }

    /// A table that occurs once; all its values are `None` when it is absent.
    #[must_use]
    pub fn table(&self, section: &KeySection) -> TableReader<'_> {
        TableReader { reader: self, path: section.path.to_owned() }
    }

    /// An optional table, when it is in the file or an override sets a key of it.
    #[must_use]
    pub fn find(&self, section: &KeySection) -> Option<TableReader<'_>> {
        self.document.has(section.path).then(|| self.table(section))
    }

    /// The elements of a repeated table, in the order of the file.
    pub fn elements(&self, section: &KeySection) -> impl Iterator<Item = TableReader<'_>> {
        let path = section.path;
        (0..self.count(section)).map(move |index| TableReader { reader: self, path: format!("{path}[{index}]") })
    }

    /// How many elements a repeated table has.
    fn count(&self, section: &KeySection) -> usize {
        self.document.arrays.get(section.path).map_or(0, |(_, count)| *count)
    }

    /// The keys the user gave: those set by overrides, and, when `file` says so, those of the file. Of a table that
    /// belongs to one kind of cam only those set by overrides count: a file may describe several kinds.
    #[must_use]
    pub fn given(&self, file: bool) -> Vec<String> {
        if let Some(known) = self.known {
            let mut all: Vec<String> = if file { known.given.clone() } else { Vec::new() };
            all.extend(self.document.overridden().map(str::to_owned));
            all.sort_unstable();
            all.dedup();
            return all;
        }
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
        let Some(known) = self.known else { return self.inputs.values().cloned().collect() };
        let kept = known.inputs.iter().filter(|(path, _)| !self.inputs.contains_key(*path));
        let mut all: Vec<(&String, &Input)> = kept.chain(&self.inputs).collect();
        all.sort_by_key(|(path, _)| *path);
        all.into_iter().map(|(_, input)| input.clone()).collect()
    }

    /// Ends the reading.
    ///
    /// # Errors
    /// All faults, in the order of their places, without duplicates.
    pub fn finish(self) -> Result<(), Vec<FileFault>> {
        let faults = self.document.sorted_faults(self.faults.into_inner());
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }
}

/// One table of a file that is being read.
#[derive(Debug, Clone)]
pub struct TableReader<'r> {
    reader: &'r Reader<'r>,
    path: String,
}

impl TableReader<'_> {
    fn path_of(&self, key: &Key) -> String {
        join(&self.path, key.name)
    }

    /// The value of a key; `None` when it is absent without a default, or has a fault, which has been reported.
    #[must_use]
    pub fn get<T: Clone>(&self, field: &Field<T>) -> Option<T> {
        self.reader.value(&self.path_of(&field.key)).and_then(|value| field.of(value))
    }

    /// Whether a key is in the file or is set by an override, with a fault or without.
    #[must_use]
    pub fn has<T>(&self, field: &Field<T>) -> bool {
        let path = self.path_of(&field.key);
        self.reader.entry(&path).is_some() || self.reader.table_at(&path).is_some()
    }

    /// The value of a key as it was typed, for messages that compare two keys: of a radius that is given by its diameter `Ø24 mm`.
    #[must_use]
    pub fn typed<T>(&self, field: &Field<T>) -> String {
        let path = self.path_of(&field.key);
        let typed = self.reader.entry(&path).and_then(|entry| entry.value.typed()).unwrap_or("its default");
        if self.reader.doubled.contains_key(&path) { format!("Ø{typed}") } else { typed.to_owned() }
    }

    /// Reports a fault at the value of a key, or at the header of its table when it is absent. What follows from a text that is not
    /// TOML, or from a misspelling of the key, is not reported.
    pub fn fail<T>(&self, field: &Field<T>, message: String, help: Option<String>) {
        let path = self.path_of(&field.key);
        let entry = self.reader.entry(&path);
        if !self.reader.document.broken && (entry.is_some() || !self.reader.meant_keys.contains(&path)) {
            let place = entry.map(|entry| entry.at.clone()).or_else(|| self.reader.document.header(&self.path));
            self.reader.report(message, help, place);
        }
    }

    /// Reports a fault at a character, from 1, of the text of a key.
    pub fn fail_at(&self, field: &Field<String>, character: usize, message: String, help: Option<String>) {
        let entry = self.reader.document.entries.get(&self.path_of(&field.key));
        let Some(entry) = entry.filter(|_| !self.reader.document.broken) else {
            return self.fail(field, message, help);
        };
        let place = self.reader.document.character(entry.at.clone(), character);
        self.reader.report(message, help, Some(place));
    }

    /// Reports a fault at a row, from 0, of the file that a key names.
    pub fn fail_in(&self, field: &Field<Arc<Columns>>, row: usize, message: String, help: Option<String>) {
        match self.get(field).and_then(|columns| columns.excerpt(row)) {
            Some(place) => self.reader.report(message, help, Some(TextPlace::OtherFile(Box::new(place)))),
            None => self.fail(field, message, help),
        }
    }
}

/// Every key, under each of its names.
fn known_keys(sections: &[&KeySection], document: &Document<'_>) -> Vec<KnownKey> {
    let keys = sections.iter().flat_map(|section| section.keys.iter().map(move |key| (section, key)));
    let under = |(section, key): (&&KeySection, &Key)| {
        let (path, in_file) = (section.path_of(key), document.has(section.path));
        let table = path.strip_suffix(key.name).unwrap_or_default().to_owned();
        let names = std::iter::once(key.name).chain(key.also.iter().copied());
        let named = names.map(|name| KnownKey { path: path.clone(), named: format!("{table}{name}"), in_file });
        named.collect::<Vec<_>>()
    };
    keys.flat_map(under).collect()
}

/// The keys that were probably meant; a radius and its diameter where the name says neither.
fn suggestion(sections: &[&KeySection], path: &str, near: &[String]) -> Option<String> {
    let last = |path: &str| path.rsplit('.').next().unwrap_or_default().to_owned();
    let name = last(path);
    let mut all: Vec<String> = near.to_vec();
    if let [near] = near {
        let (pattern, _) = pattern(near);
        let twin = key_at(sections, &pattern).and_then(|(section, key)| {
            let of_radius = |other: &&Key| other.halved == Some(key.name);
            key.halved.or_else(|| section.keys.iter().find(of_radius).map(|other| other.name))
        });
        let meant = last(near);
        let says =
            |word: &str| 2 * name.len() > word.len() && (name.contains(word) || similar(&name, [word]).is_some());
        if let Some(twin) = twin.filter(|_| !["radius", "diameter", &meant].iter().any(|word| says(word))) {
            all.push(format!("{}{twin}", near.strip_suffix(meant.as_str()).unwrap_or_default()));
        }
    }
    let all: Vec<String> = all.iter().map(|near| format!("`{near}`")).collect();
    (!all.is_empty()).then(|| format!("did you mean {}?", all.join(" or ")))
}

fn missing((section, key): (&KeySection, &Key), path: &str, source: &str, place: Option<TextPlace>) -> PendingFault {
    let example = |key: &Key| format!("{} = {}", key.name, key.in_toml(key.presence.text()));
    let doubled = section.keys.iter().find(|other| other.halved == Some(key.name));
    let or = doubled.map_or(String::new(), |other| format!(", or {}", example(other)));
    PendingFault {
        key: Some(path.to_owned()),
        message: format!("missing key `{path}` in {source}"),
        help: Some(format!("add it, e.g. {}{or}", example(key))),
        place,
    }
}

/// The table of a path and the key of it that the key at the path gives by half of its value, where it does.
fn halved_at<'p>(sections: &[&KeySection], path: &'p str) -> Option<(&'p str, &'static str)> {
    let (pattern, _) = pattern(path);
    let (_, key) = key_at(sections, &pattern)?;
    Some((path.rsplit_once('.').map_or("", |(table, _)| table), key.halved?))
}

/// Whether a table with this pattern is the section's, or around it.
fn is_around(pattern: &str, section: &KeySection) -> bool {
    if section.occurs == Occurrence::Repeated && pattern.strip_suffix("[]") == Some(section.path) {
        return true;
    }
    let own = |rest: &str| rest.is_empty() && section.occurs != Occurrence::Repeated;
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

/// A pattern with indices inserted; 0 where no index is left.
fn filled(pattern: &str, indices: &[&str]) -> String {
    let mut indices = indices.iter();
    let mut parts = pattern.split("[]");
    let mut path = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        path.push_str(&format!("[{}]{part}", indices.next().unwrap_or(&"0")));
    }
    path
}
