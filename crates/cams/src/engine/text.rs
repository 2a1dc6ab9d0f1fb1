//! Changes of the text of a machine file: its comments and its order stay.

use crate::catalogue::catalogue;
use camgen_kernel::document::{Key, Typing};
use camgen_kernel::refusal::Refusal;
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
    let mut parts: Vec<PathPart<'_>> = Vec::new();
    for text in path.split('.') {
        // `motion.segment.2.law` is `motion.segment[1].law`, as with --set.
        match (text.parse::<usize>(), parts.last_mut()) {
            (Ok(number), Some((_, index @ None))) if number > 0 => *index = Some(number - 1),
            _ => {
                let (name, index) = match text.split_once('[') {
                    None => (text, None),
                    Some((name, rest)) => (name, Some(rest.strip_suffix(']')?.parse().ok()?)),
                };
                parts.push((Some(name).filter(|name| !name.is_empty())?, index));
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
    for (depth, (name, index)) in path.iter().enumerate() {
        let missing = || Refusal::new(format!("there is no table `{name}` to change"));
        let item = table.entry(name).or_insert_with(|| Item::Table(implicit()));
        table = match (index, item) {
            (Some(index), Item::ArrayOfTables(list)) => list.get_mut(*index).ok_or_else(missing)?,
            (Some(index), Item::Value(Value::Array(list))) => {
                let element = list.get_mut(*index).ok_or_else(missing)?;
                element.as_inline_table_mut().ok_or_else(missing)?
            }
            (None, item) => {
                // A word given instead of a table becomes that table, with the word in the keys for which it stood.
                if !item.is_table_like() {
                    let names: Vec<&str> = path.iter().take(depth + 1).map(|(name, _)| *name).collect();
                    *item = Item::Table(table_for_word(&names.join("."), item));
                }
                item.as_table_like_mut().ok_or_else(missing)?
            }
            _ => return Err(missing()),
        };
    }
    Ok(table)
}

/// The table at a path with the keys for which `word` stood.
fn table_for_word(path: &str, word: &Item) -> Table {
    let mut table = Table::new();
    let word = word.as_str().unwrap_or_default();
    for key in keys_for_word(path, word) {
        table.insert(key.name, Item::Value(Value::from(word)));
    }
    table
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
    // A list of inline tables becomes an array of tables.
    if item.is_array() {
        *item = std::mem::take(item).into_array_of_tables().map_or_else(|other| other, Item::ArrayOfTables);
    }
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

/// The keys of the table of a path, without indices, and the name of the key.
fn keys_about(path: &str) -> (impl Iterator<Item = &'static Key> + use<>, &str) {
    let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
    let names: Vec<&str> = table.split('.').map(|part| part.split('[').next().unwrap_or_default()).collect();
    let table = names.join(".");
    let sections = catalogue().keys.sections.iter().filter(move |section| section.path == table);
    (sections.flat_map(|section| section.keys), name)
}

/// The key of a path.
pub(super) fn key_of(path: &str) -> Option<&'static Key> {
    let (mut keys, name) = keys_about(path);
    keys.find(|key| key.name == name)
}

/// The name of the key that gives the same dimension: the radius of a diameter, and the reverse.
fn doubled(path: &str) -> Option<&'static str> {
    let (mut others, name) = keys_about(path);
    key_of(path)?.halved.or_else(|| others.find(|key| key.halved == Some(name)).map(|key| key.name))
}

/// The path of the key for the same dimension: the diameter of a radius, or the reverse.
pub(super) fn twin_of(path: &str) -> Option<String> {
    let twin = doubled(path)?;
    Some(path.rsplit_once('.').map_or_else(|| twin.to_owned(), |(table, _)| format!("{table}.{twin}")))
}

/// A value as it was typed: text in quotes unless its key takes numbers, truths or lists.
fn value(path: &str, typed: &str) -> Value {
    let typed = typed.trim();
    let unquoted = typed.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(typed);
    let bare = match key_of(path).map(|key| key.form.typing()) {
        Some(Typing::Bare) => true,
        Some(Typing::BareNumber) => unquoted.parse::<f64>().is_ok(),
        Some(Typing::Quoted) | None => false,
    };
    if bare && let Ok(value) = unquoted.parse::<Value>() {
        return value;
    }
    Value::from(unquoted)
}

/// A key given in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct GivenKey {
    /// Its path.
    pub(super) path: String,
    /// Its value as typed into a field.
    pub(super) typed: String,
}

/// The keys given in a text; a word given instead of a table counts as the keys for which it stands.
pub(super) fn given(text: &str) -> Vec<GivenKey> {
    let mut found = Vec::new();
    if let Ok(document) = text.parse::<DocumentMut>() {
        document.iter().for_each(|(name, item)| collect(name, item, &mut found));
    }
    found
}

fn collect(path: &str, item: &Item, found: &mut Vec<GivenKey>) {
    let mut collect_table = |path: &str, table: &dyn TableLike| {
        table.iter().for_each(|(name, item)| collect(&format!("{path}.{name}"), item, found));
    };
    if let Some(table) = item.as_table_like() {
        return collect_table(path, table);
    }
    if let Some(tables) = tables_of(item) {
        return tables.enumerate().for_each(|(index, table)| collect_table(&format!("{path}[{index}]"), table));
    }
    let Some(value) = item.as_value() else { return };
    let typed = typed_of(value);
    let before = found.len();
    found.extend(
        keys_for_word(path, &typed).map(|key| GivenKey { path: format!("{path}.{}", key.name), typed: typed.clone() }),
    );
    if found.len() == before {
        found.push(GivenKey { path: path.to_owned(), typed });
    }
}

/// The elements of an array of tables or of inline tables.
fn tables_of(item: &Item) -> Option<Box<dyn Iterator<Item = &dyn TableLike> + '_>> {
    if let Item::ArrayOfTables(list) = item {
        return Some(Box::new(list.iter().map(|table| table as &dyn TableLike)));
    }
    let list = item.as_array().filter(|list| !list.is_empty() && list.iter().all(Value::is_inline_table))?;
    Some(Box::new(list.iter().filter_map(Value::as_inline_table).map(|table| table as &dyn TableLike)))
}

/// The keys of a table for which this word stands; none for another word or path.
fn keys_for_word<'w>(table: &'w str, word: &'w str) -> impl Iterator<Item = &'static Key> + use<'w> {
    let sections = catalogue().keys.sections.iter().filter(move |section| section.path == table);
    sections.flat_map(|section| section.keys).filter(move |key| key.for_table == Some(word))
}

/// A value as typed: text without quotes, a number without underscores, a list on one line.
fn typed_of(value: &Value) -> String {
    match value {
        Value::String(text) => text.value().clone(),
        Value::Array(items) => format!("[{}]", items.iter().map(item_of_list).collect::<Vec<_>>().join(", ")),
        other => {
            let mut plain = other.clone();
            plain.decor_mut().clear();
            plain.to_string().replace('_', "")
        }
    }
}

fn item_of_list(value: &Value) -> String {
    match value {
        Value::String(text) => Value::from(text.value().as_str()).to_string(),
        other => typed_of(other),
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
        assert_eq!(given(&text).last().map(|key| key.path.as_str()), Some("follower.roller.radius"));
    }
}
