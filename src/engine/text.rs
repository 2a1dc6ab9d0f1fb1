//! Changes of the text of a machine file: its comments and its order stay.

use crate::catalogue::catalogue;
use crate::document::{Key, KeyForm};
use crate::refusal::Refusal;
use serde::{Deserialize, Serialize};
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, TableLike, Value};

/// A change of a text. Elements of arrays of tables are counted from 0: `motion.segment[2].law`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TextChange {
    /// A value of a key, as `--set` takes it.
    Set {
        /// The dotted path of the key.
        key: String,
        /// The value.
        to: String,
    },
    /// Without a key, a table, or an element of an array of tables.
    Remove(String),
    /// An empty element of an array of tables, before the one of this number.
    Insert(String),
}

/// A part of a path: a name, and which element of an array of tables it is.
type PathPart<'p> = (&'p str, Option<usize>);

/// The parts of a path; `None` where it is not one.
fn parts(path: &str) -> Option<Vec<PathPart<'_>>> {
    let part = |text: &'_ str| -> Option<(usize, Option<usize>)> {
        match text.split_once('[') {
            None => Some((text.len(), None)),
            Some((name, rest)) => Some((name.len(), Some(rest.strip_suffix(']')?.parse().ok()?))),
        }
    };
    let mut parts: Vec<PathPart<'_>> = Vec::new();
    for text in path.split('.') {
        // `motion.segment.2.law` is `motion.segment[1].law`, as with --set.
        match (text.parse::<usize>(), parts.last_mut()) {
            (Ok(number), Some((_, index @ None))) if number > 0 => *index = Some(number - 1),
            _ => {
                let (length, index) = part(text)?;
                parts.push((text.get(..length).filter(|name| !name.is_empty())?, index));
            }
        }
    }
    Some(parts)
}

/// A text after changes of it.
///
/// # Errors
/// [`Refusal`] where the text is not TOML, or it has no such element.
pub(super) fn changed(text: &str, changes: &[TextChange]) -> Result<String, Refusal> {
    if changes.is_empty() {
        return Ok(text.to_owned());
    }
    let mut document: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| {
        Refusal::new(format!("the text is not TOML: {}", error.message())).remedy("correct it first")
    })?;
    changes.iter().try_for_each(|change| change_of(&mut document, change))?;
    Ok(document.to_string())
}

fn change_of(document: &mut DocumentMut, change: &TextChange) -> Result<(), Refusal> {
    let (TextChange::Set { key, .. } | TextChange::Remove(key) | TextChange::Insert(key)) = change;
    let parts = parts(key).ok_or_else(|| Refusal::new(format!("`{key}` is not the path of a key")))?;
    let Some(((name, index), tables)) = parts.split_last() else { return Ok(()) };
    match (change, index) {
        (TextChange::Set { to, .. }, None) => {
            let table = table_at(document.as_table_mut(), tables)?;
            if let Some(other) = doubled(key) {
                table.remove(other);
            }
            set(table, name, value(key, to));
        }
        (TextChange::Remove(_), None) => {
            table_at(document.as_table_mut(), tables)?.remove(name);
        }
        (TextChange::Remove(_), Some(index)) => {
            let list = list_at(document, tables, name)?;
            if *index >= list.len() {
                return Err(Refusal::new(format!("there is no `{key}`")));
            }
            list.remove(*index);
        }
        (TextChange::Insert(_), Some(index)) => insert(list_at(document, tables, name)?, *index),
        _ => return Err(Refusal::new(format!("`{key}` cannot be changed so"))),
    }
    Ok(())
}

/// The table at a path; it is added where it is missing.
fn table_at<'t>(root: &'t mut Table, path: &[PathPart<'_>]) -> Result<&'t mut dyn TableLike, Refusal> {
    let mut table: &mut dyn TableLike = root;
    for (name, index) in path {
        let missing = || Refusal::new(format!("there is no table `{name}` to change"));
        let item = table.entry(name).or_insert_with(|| Item::Table(implicit()));
        table = match (index, item) {
            (Some(index), Item::ArrayOfTables(list)) => list.get_mut(*index).ok_or_else(missing)?,
            (Some(index), Item::Value(Value::Array(list))) => {
                let element = list.get_mut(*index).ok_or_else(missing)?;
                element.as_inline_table_mut().ok_or_else(missing)?
            }
            (None, item) => {
                // A word in the place of a table gives way to it.
                if !item.is_table_like() {
                    *item = Item::Table(Table::new());
                }
                item.as_table_like_mut().ok_or_else(missing)?
            }
            _ => return Err(missing()),
        };
    }
    Ok(table)
}

/// A table whose header is written only where it has keys of its own.
fn implicit() -> Table {
    let mut table = Table::new();
    table.set_implicit(true);
    table
}

/// The array of tables of a name.
fn list_at<'t>(
    document: &'t mut DocumentMut,
    path: &[PathPart<'_>],
    name: &str,
) -> Result<&'t mut ArrayOfTables, Refusal> {
    let item = table_at(document.as_table_mut(), path)?
        .entry(name)
        .or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    item.as_array_of_tables_mut().ok_or_else(|| Refusal::new(format!("`{name}` is not a list of tables")))
}

/// An element before another, with a blank line before it. The places of the ones after it in the text move on.
fn insert(list: &mut ArrayOfTables, index: usize) {
    let mut all: Vec<Table> = list.iter().cloned().collect();
    let place = all.get(index.saturating_sub(1)).and_then(Table::position);
    let mut table = Table::new();
    table.decor_mut().set_prefix("\n");
    table.set_position(place);
    all.insert(index.min(all.len()), table);
    // Tables are written in the order of their places: those of one list share one, and then keep the order of the list.
    let first = all.iter().filter_map(Table::position).min();
    list.clear();
    for mut table in all {
        table.set_position(first);
        list.push(table);
    }
}

/// Sets a value; a comment behind the one before it stays.
fn set(table: &mut dyn TableLike, name: &str, mut value: Value) {
    match table.get_mut(name) {
        Some(Item::Value(before)) => {
            *value.decor_mut() = before.decor().clone();
            *before = value;
        }
        _ => {
            table.insert(name, Item::Value(value));
        }
    }
}

/// The key of a path, indices left open, with the other keys of its table.
fn key_of(path: &str) -> Option<(&'static Key, impl Iterator<Item = &'static Key>)> {
    let names: Vec<&str> = path.split('.').map(|part| part.split('[').next().unwrap_or_default()).collect();
    let (name, table) = names.split_last()?;
    let table = table.join(".");
    let keys = || {
        let table = table.clone();
        let sections = catalogue().keys.sections.iter().filter(move |section| section.path == table);
        sections.flat_map(|section| section.keys)
    };
    Some((keys().find(|key| key.name == *name)?, keys()))
}

/// What a value of the key at a path may be.
fn form_of(path: &str) -> Option<KeyForm> {
    key_of(path).map(|(key, _)| key.form)
}

/// The name of the key that gives the same dimension: the radius of a diameter, and the reverse.
fn doubled(path: &str) -> Option<&'static str> {
    let (own, mut others) = key_of(path)?;
    own.halved.or_else(|| others.find(|key| key.halved == Some(own.name)).map(|key| key.name))
}

/// A value as it was typed: text in quotes unless its key takes numbers, truths or lists.
fn value(path: &str, typed: &str) -> Value {
    let typed = typed.trim();
    let unquoted = typed.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(typed);
    let bare = match form_of(path) {
        Some(
            KeyForm::Number(_)
            | KeyForm::Numbers(_)
            | KeyForm::Texts
            | KeyForm::Boolean
            | KeyForm::Pair(..)
            | KeyForm::Points(..),
        ) => true,
        Some(KeyForm::Share(_) | KeyForm::TextOrNumber) => unquoted.parse::<f64>().is_ok(),
        _ => false,
    };
    if bare && let Ok(value) = unquoted.parse::<Value>() {
        return value;
    }
    Value::from(unquoted)
}

/// The paths of the keys that a text has.
pub(super) fn given(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    if let Ok(document) = text.parse::<DocumentMut>() {
        collect("", document.as_table(), &mut found);
    }
    found
}

fn collect(path: &str, table: &dyn TableLike, found: &mut Vec<String>) {
    for (name, item) in table.iter() {
        let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        match item {
            Item::ArrayOfTables(list) => {
                for (index, table) in list.iter().enumerate() {
                    collect(&format!("{path}[{index}]"), table, found);
                }
            }
            item => match item.as_table_like() {
                Some(table) => collect(&path, table, found),
                None => found.push(path),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# head\nname = \"A\"  # name\n\n[motion]\nrpm = 120 # speed\n\n# up\n[[motion.segment]]\nlaw = \"cycloidal\"\nover = \"90 deg\"\n\n[[motion.segment]]\nlaw = \"dwell\"\n\n[cam]\nbore_radius = \"5 mm\"  # bore\n";

    fn set(key: &str, to: &str) -> TextChange {
        TextChange::Set { key: key.to_owned(), to: to.to_owned() }
    }

    #[test]
    fn a_value_changes_and_the_rest_stays() {
        let changes = [set("motion.rpm", "90"), set("cam.thickness", "12 mm"), set("motion.segment[0].over", "80 deg")];
        let text = changed(TEXT, &changes).expect("changed");
        let expected = TEXT
            .replace("120", "90")
            .replace("90 deg", "80 deg")
            .replace("# bore\n", "# bore\nthickness = \"12 mm\"\n");
        assert_eq!(text, expected);
    }

    #[test]
    fn a_diameter_takes_the_place_of_its_radius() {
        let text = changed(TEXT, &[set("cam.bore_diameter", "12 mm")]).expect("changed");
        assert!(text.contains("bore_diameter = \"12 mm\"") && !text.contains("bore_radius"), "{text}");
    }

    #[test]
    fn segments_are_inserted_and_removed_in_their_order() {
        let changes = [TextChange::Insert("motion.segment[1]".to_owned()), set("motion.segment[1].law", "3-4-5")];
        let text = changed(TEXT, &changes).expect("changed");
        let place = |what: &str| text.find(what).expect(what);
        assert!(place("cycloidal") < place("3-4-5") && place("3-4-5") < place("dwell"), "{text}");
        assert!(place("dwell") < place("[cam]") && text.contains("# up\n[[motion.segment]]"), "{text}");
        let back = changed(&text, &[TextChange::Remove("motion.segment[1]".to_owned())]).expect("changed");
        assert_eq!(back, TEXT);
        assert!(changed(TEXT, &[TextChange::Remove("motion.segment[7]".to_owned())]).is_err());
        assert!(changed(TEXT, &[set("motion.segment[7].law", "dwell")]).is_err());
    }

    #[test]
    fn a_table_that_is_missing_is_made() {
        let text = changed(TEXT, &[set("follower.roller.radius", "8 mm")]).expect("changed");
        assert!(text.contains("[follower.roller]\nradius = \"8 mm\"") && !text.contains("[follower]\n"), "{text}");
        assert_eq!(given(&text).last().map(String::as_str), Some("follower.roller.radius"));
    }
}
