//! The JSON schema (draft 2020-12) of a file, for editors, written from the sections.

use super::bounds::Bounds;
use super::key::{Key, KeyForm, KeySection, Occurrence, Presence, Typing, continues};
use crate::units::Dimension;
use serde_json::{Value, json};

/// A decimal number, as [`crate::units`] accepts it before a unit.
const NUMBER: &str = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";

/// The schema of files with these sections.
#[must_use]
pub fn schema(title: &str, sections: &[&KeySection]) -> Value {
    let mut root = table("");
    for (index, section) in sections.iter().enumerate() {
        let mut node = &mut root;
        let required = section.occurs == Occurrence::Once
            && section.keys.iter().any(|key| matches!(key.presence, Presence::Required(_)));
        for name in section.path.split('.').filter(|name| !name.is_empty()) {
            if required {
                require(node, name);
            }
            node = within(node, name);
        }
        if continues(sections, index) {
            add_keys(node, section);
        } else {
            describe(node, section);
        }
    }
    if let Some(root) = root.as_object_mut() {
        root.insert("$schema".into(), "https://json-schema.org/draft/2020-12/schema".into());
        root.insert("title".into(), title.into());
    }
    root
}

/// A table that has no keys yet.
fn table(about: &str) -> Value {
    let mut table = json!({ "type": "object", "additionalProperties": false, "properties": {} });
    if !about.is_empty() {
        table["description"] = about.into();
    }
    table
}

/// The schema of a name within a table.
fn within<'t>(table: &'t mut Value, name: &str) -> &'t mut Value {
    let inner = &mut table["properties"][name];
    if inner.is_null() {
        *inner = self::table("");
    }
    inner
}

fn require(table: &mut Value, name: &str) {
    let required = &mut table["required"];
    match required {
        Value::Array(names) if names.iter().any(|other| other == name) => {}
        Value::Array(names) => names.push(name.into()),
        _ => *required = json!([name]),
    }
}

/// A condition in addition to those of the table.
fn require_that(table: &mut Value, condition: Value) {
    match &mut table["allOf"] {
        Value::Array(conditions) => conditions.push(condition),
        none => *none = json!([condition]),
    }
}

fn add_keys(table: &mut Value, section: &KeySection) {
    for key in section.keys {
        table["properties"][key.name] = property(key);
        let doubled = section.keys.iter().find(|other| other.halved == Some(key.name));
        match (doubled, matches!(key.presence, Presence::Required(_))) {
            (None, true) => require(table, key.name),
            (None, false) => {}
            (Some(other), true) => {
                require_that(table, json!({ "oneOf": [{ "required": [key.name] }, { "required": [other.name] }] }));
            }
            (Some(other), false) => require_that(table, json!({ "not": { "required": [key.name, other.name] } })),
        }
    }
}

/// Adds the description of a section to its table.
fn describe(node: &mut Value, section: &KeySection) {
    let mut keys = table(section.about);
    add_keys(&mut keys, section);
    if section.occurs == Occurrence::Repeated {
        *node = json!({ "type": "array", "items": keys });
        return;
    }
    // Tables within may have been described before.
    if let Value::Object(within) = node["properties"].take() {
        for (name, table) in within {
            keys["properties"][name] = table;
        }
    }
    if let Value::Array(names) = node["required"].take() {
        for name in names.iter().filter_map(Value::as_str) {
            require(&mut keys, name);
        }
    }
    if let (Some(word), Some(table)) = (section.keys.iter().find_map(|key| key.for_table), keys.as_object_mut()) {
        table.remove("type");
        table.insert("anyOf".into(), json!([{ "type": "object" }, { "const": word }]));
    }
    *node = keys;
}

/// What a value of a key may be.
fn property(key: &Key) -> Value {
    let mut property = form(key.form);
    property["description"] = key.about.into();
    let text = key.presence.text();
    let value = match key.form.typing() {
        Typing::Bare => serde_json::from_str(text).unwrap_or(text.into()),
        Typing::Quoted | Typing::BareNumber => Value::from(text),
    };
    match key.presence {
        Presence::Default(_) => property["default"] = value,
        Presence::Required(_) | Presence::RequiredUnless(..) | Presence::Optional(_) => {
            property["examples"] = json!([value]);
        }
    }
    property
}

fn form(form: KeyForm) -> Value {
    match form {
        KeyForm::Text | KeyForm::Columns => json!({ "type": "string", "minLength": 1 }),
        KeyForm::TextOrNumber => json!({ "type": ["string", "number"], "minLength": 1 }),
        KeyForm::Boolean => json!({ "type": "boolean" }),
        KeyForm::Number(bounds) => number(bounds),
        KeyForm::Share(bounds) => json!({ "anyOf": [number(bounds), pattern(&format!(r"{NUMBER}\s*%"))] }),
        KeyForm::Numbers(bounds) => json!({ "type": "array", "items": number(bounds) }),
        KeyForm::Texts => json!({ "type": "array", "items": { "type": ["string", "integer"] } }),
        KeyForm::Quantity(dimension, _) => pattern(&quantity(&[dimension])),
        KeyForm::LengthOrAngle(_, _) => pattern(&quantity(&[Dimension::Length, Dimension::Angle])),
        KeyForm::AngleOrLength(_, _) => pattern(&quantity(&[Dimension::Angle, Dimension::Length])),
        KeyForm::LengthAngleOrShare(..) => {
            let size = pattern(&quantity(&[Dimension::Length, Dimension::Angle]));
            json!({ "anyOf": [size, pattern(&format!(r"{NUMBER}\s*%"))] })
        }
        KeyForm::Either((first, _), (second, _)) => pattern(&quantity(&[first, second])),
        KeyForm::Words(words) => json!({ "enum": words }),
        KeyForm::WordsOrQuantity(words, dimension, _) => {
            json!({ "anyOf": [{ "enum": words }, pattern(&quantity(&[dimension]))] })
        }
        KeyForm::Band(dimension, _) => {
            let one = quantity(&[dimension]);
            pattern(&format!(r"{one}\s*\.\.\s*{one}"))
        }
        KeyForm::Pair(dimension, _) => {
            json!({ "type": "array", "items": pattern(&quantity(&[dimension])), "minItems": 2, "maxItems": 2 })
        }
        KeyForm::Points(..) => {
            let at = pattern(&quantity(&[Dimension::Angle, Dimension::Length]));
            let to = pattern(&quantity(&[Dimension::Length, Dimension::Angle]));
            let point = json!({ "type": "array", "prefixItems": [at, to], "minItems": 2, "maxItems": 2 });
            json!({ "type": "array", "items": point })
        }
    }
}

fn number(bounds: Bounds) -> Value {
    let low = if bounds.low_included { "minimum" } else { "exclusiveMinimum" };
    json!({ "type": "number", low: bounds.low, "maximum": bounds.high })
}

/// A text that matches as a whole, blanks around it aside.
fn pattern(inner: &str) -> Value {
    json!({ "type": "string", "pattern": format!(r"^\s*{inner}\s*$") })
}

/// A number and a unit of one of the dimensions.
fn quantity(dimensions: &[Dimension]) -> String {
    let mut units: Vec<String> = Vec::new();
    for dimension in dimensions {
        units.extend(dimension.unit_list().split(", ").map(str::to_owned));
        // The list for messages has one spelling of each alone.
        units.extend(dimension.spellings().map(str::to_owned));
    }
    // A product has a sign that means something else in a pattern.
    format!(r"{NUMBER}\s*({})", units.join("|").replace('*', r"\*"))
}
