//! The JSON schema (draft 2020-12) of a file, for editors, written from the sections.

use super::bounds::Bounds;
use super::key::{Form, Key, Occurs, Presence, Section};
use crate::units::Dimension;
use serde_json::{Value, json};

/// A decimal number, as [`crate::units`] takes it before a unit.
const NUMBER: &str = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";

/// The schema of files with these sections.
#[must_use]
pub fn schema(title: &str, sections: &[&Section]) -> Value {
    let mut root = table("");
    for section in sections {
        let mut node = &mut root;
        let required = section.occurs == Occurs::Once
            && section.keys.iter().any(|key| matches!(key.presence, Presence::Required(_)));
        for name in section.path.split('.').filter(|name| !name.is_empty()) {
            if required {
                require(node, name);
            }
            node = within(node, name);
        }
        describe(node, section);
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

/// Puts what a section says into its table.
fn describe(node: &mut Value, section: &Section) {
    let mut keys = table(section.about);
    for key in section.keys {
        keys["properties"][key.name] = property(key);
        if matches!(key.presence, Presence::Required(_)) {
            require(&mut keys, key.name);
        }
    }
    if section.occurs == Occurs::Repeated {
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
    *node = keys;
}

/// What a value of a key may be.
fn property(key: &Key) -> Value {
    let mut property = form(key.form);
    property["description"] = key.about.into();
    let text = key.presence.text();
    let value = match key.form {
        Form::Number(_) | Form::Numbers(_) | Form::Boolean | Form::Pair(..) | Form::Points(..) => {
            serde_json::from_str(text).unwrap_or(text.into())
        }
        _ => Value::from(text),
    };
    match key.presence {
        Presence::Default(_) => property["default"] = value,
        Presence::Required(_) | Presence::RequiredUnless(..) | Presence::Optional(_) => {
            property["examples"] = json!([value]);
        }
    }
    property
}

fn form(form: Form) -> Value {
    match form {
        Form::Text | Form::Columns => json!({ "type": "string", "minLength": 1 }),
        Form::Boolean => json!({ "type": "boolean" }),
        Form::Number(bounds) => number(bounds),
        Form::Numbers(bounds) => json!({ "type": "array", "items": number(bounds) }),
        Form::Quantity(dimension, _) => pattern(&quantity(&[dimension])),
        Form::LengthOrAngle(_, _) => pattern(&quantity(&[Dimension::Length, Dimension::Angle])),
        Form::Either((first, _), (second, _)) => pattern(&quantity(&[first, second])),
        Form::Words(words) => json!({ "enum": words }),
        Form::WordsOrQuantity(words, dimension, _) => {
            json!({ "anyOf": [{ "enum": words }, pattern(&quantity(&[dimension]))] })
        }
        Form::Band(dimension, _) => {
            let one = quantity(&[dimension]);
            pattern(&format!(r"{one}\s*\.\.\s*{one}"))
        }
        Form::Pair(dimension, _) => {
            json!({ "type": "array", "items": pattern(&quantity(&[dimension])), "minItems": 2, "maxItems": 2 })
        }
        Form::Points(dimension, ..) => {
            let (at, to) =
                (pattern(&quantity(&[dimension])), pattern(&quantity(&[Dimension::Length, Dimension::Angle])));
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
        // The list for messages has the spelling in ASCII alone.
        units.extend((*dimension == Dimension::Length).then(|| "µm".to_owned()));
    }
    // A product has a sign that means something else in a pattern.
    format!(r"{NUMBER}\s*({})", units.join("|").replace('*', r"\*"))
}
