//! Files a person writes: TOML against a table of keys.
//!
//! What a file may contain is stated once, by constant [`Section`]s of [`Key`]s, each written beside the part it describes.
//! From the same list come the [`Reader`], which reports every fault of a file at once and at its place, the [`template()`]
//! to start a file from, the JSON [`schema()`] for editors, and the keys that have no effect on a kind of cam.

mod bounds;
pub mod cams;
mod fault;
mod key;
pub mod range;
mod reader;
mod schema;
mod template;
mod text;
mod value;

pub use bounds::{Bounds, above, within};
pub use fault::{Excerpt, Fault};
pub use key::{Field, Form, Key, LengthOrAngle, Occurs, Presence, Section};
pub use reader::{Reader, Table};
pub use schema::schema;
pub use template::template;

/// Of the keys given, those that have no effect on a kind of cam, in the order given.
#[must_use]
pub fn without_effect(sections: &[&Section], given: &[String], cam: &str) -> Vec<String> {
    let idle = |path: &str| {
        let (pattern, _) = reader::pattern(path);
        let mut keys = sections.iter().flat_map(|section| section.keys.iter().map(move |key| (section, key)));
        keys.any(|(section, key)| {
            let cams = section.cams_of(key);
            !cams.is_empty() && !cams.contains(&cam) && section.path_of(key) == pattern
        })
    };
    given.iter().filter(|path| idle(path)).cloned().collect()
}

#[cfg(test)]
mod tests;
