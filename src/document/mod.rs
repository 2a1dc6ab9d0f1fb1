//! Files a person writes: TOML against a table of keys.
//!
//! What a file may contain is stated once, by constant [`Section`]s of [`Key`]s, each written beside the part it describes.
//! From the same list come the [`Reader`], which reports every fault of a file at once and at its place, the [`template()`]
//! to start a file from, the JSON [`schema()`] for editors, and the keys that have no effect on a kind of cam.

mod bounds;
pub mod cams;
mod columns;
mod fault;
pub mod file;
mod input;
mod key;
mod plain;
pub mod range;
mod reader;
mod schema;
mod template;
mod text;
mod value;

pub use bounds::{Bounds, above, within};
pub use columns::{Columns, Row};
pub use fault::{Excerpt, Fault, similar};
pub use input::Input;
pub use key::{Field, Form, Key, LengthOrAngle, Occurs, Points, Presence, Section};
pub use plain::{is_plain, plain, shown};
pub use reader::{Reader, Table};
pub use schema::schema;
pub use template::{Start, template};

/// Of the keys given, those that have no effect on a kind of cam, in the order given.
#[must_use]
pub fn without_effect(sections: &[&Section], given: &[String], cam: &str) -> Vec<String> {
    given.iter().filter(|path| is_idle(sections, path, cam)).cloned().collect()
}

/// Of the values of a file, those that have an effect on a kind of cam, in the order given.
#[must_use]
pub fn with_effect(sections: &[&Section], inputs: &[Input], cam: &str) -> Vec<Input> {
    inputs.iter().filter(|input| !is_idle(sections, &input.key, cam)).cloned().collect()
}

/// Whether a path is that of a key that has no effect on a kind of cam.
fn is_idle(sections: &[&Section], path: &str, cam: &str) -> bool {
    let (pattern, _) = reader::pattern(path);
    key::key_at(sections, &pattern).is_some_and(|(section, key)| {
        let cams = section.cams_of(key);
        let of_all = cams.is_empty() && !cams::ANALYSES.contains(&cam);
        !of_all && !cams.contains(&cam)
    })
}

#[cfg(test)]
mod tests;
