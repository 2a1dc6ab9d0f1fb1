//! Files a person writes: TOML against a table of keys.
//!
//! What a file may contain is stated once, by constant [`KeySection`]s of [`Key`]s, each written with the part it describes.
//! From the same list come the [`Reader`], which reports all faults of a file at once, each at its place, the [`template()`]
//! to start a file from, the JSON [`schema()`] for editors, and the keys that have no effect on a kind of cam.

mod bounds;
pub mod cams;
mod columns;
mod fault;
pub mod file;
mod heading;
mod input;
mod key;
mod named;
mod plain;
pub mod range;
mod reader;
mod schema;
mod syntax;
mod tables;
mod template;
mod text;
mod value;
mod words;

pub use bounds::{Bounds, above, within};
pub use columns::{Columns, FileRow, parts};
pub use fault::{Excerpt, FileFault, similar};
pub use heading::{HeadingUnit, UnclearHeading, derivative_in, is_diameter, is_lift, is_of_crank, is_radius};
pub use input::Input;
pub use key::{
    Field, Key, KeyForm, KeySection, LengthAngleOrShare, LengthOrAngle, Occurrence, PointList, Presence, Typing,
    ValueRange,
};
pub use named::{InputFiles, NamedFiles, NamedFolder};
pub use plain::{is_plain, plain, shown};
pub use reader::KnownValues;
pub use reader::{Reader, TableReader};
pub use schema::schema;
pub use tables::Tables;
pub use template::{TemplateOptions, template};
pub use text::{FlatText, MOST_FAULTS};
pub use words::NamedChoice;

#[cfg(test)]
mod tests;
