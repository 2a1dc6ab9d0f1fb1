//! The machine file: TOML to a [`Machine`] in SI units with every value in range.
//!
//! One of the two doors of the library: what comes out of here is a machine that can be computed. Whatever can be told
//! by line and column is told here; rooms behind this one do not see a negative mass.
//!
//! Each part of the machine has a file with its data, its table of keys and its reading. [`SECTIONS`] gathers the
//! tables; a key is one constant in its table and one line in its reading.

mod bed;
mod buffer;
mod conoid;
mod disc;
mod embedded;
mod limits;
mod roller;
mod transition;
mod translating;

pub use crate::document::{Excerpt, Fault};
pub use conoid::{ConoidData, ConoidMode, Shift};
pub use disc::{CamData, Keyway, Material, Rotation};
pub use embedded::{EMBEDDED, Embedded};
pub use limits::Limits;
pub use roller::{Crown, RollerData};
pub use translating::TranslatingData;

use crate::buffer::balance::Column;
use crate::buffer::{Bed, Cylinder};
use crate::document::Presence::Required;
use crate::document::{self, Field, Occurs, Reader, Section};
use crate::law::Transition;
use std::fmt;
use std::io::Read;
use std::path::Path;

/// The disc cam, as `cams` of a key names it.
pub const ROTARY: &str = "rotary";
/// The plate that rides on the bed.
pub const TRANSLATING: &str = "translating";
/// The cam for many speeds.
pub const CONOID: &str = "conoid";

/// Longest length in a machine file, m: a cam of a kilometre is a slip of the pen, not a cam.
const LONGEST: f64 = 1e3;
/// Heaviest bed, kg.
const HEAVIEST: f64 = 1e7;
/// Highest pressure, Pa.
const HIGHEST_PRESSURE: f64 = 1e9;
/// Largest force, N.
const LARGEST_FORCE: f64 = 1e9;
/// Highest speed, ratio or lever.
const LARGEST_NUMBER: f64 = 1e5;
/// Slowest speed, rpm: slower, the air column is longer than anything on earth.
const LEAST_RPM: f64 = 1e-3;
/// Thinnest disc, m: CAD systems take less than a micrometre for nothing.
const THINNEST: f64 = 1e-6;
/// Largest machine file, bytes.
const LARGEST_FILE: u64 = 1 << 20;

const NAME: Field<String> = Field::text("name", "what the sheet and the report call the machine", Required("my press"));

/// The keys before the first table.
const ROOT: Section = Section { path: "", about: "", occurs: Occurs::Once, cams: &[], keys: &[NAME.key] };

/// Every table of a machine file, in the order of the template.
pub const SECTIONS: &[&Section] = &[
    &ROOT,
    &bed::SECTION,
    &buffer::SECTION,
    &buffer::DESIGN,
    &roller::SECTION,
    &disc::SECTION,
    &disc::KEYWAY,
    &transition::SECTION,
    &translating::SECTION,
    &conoid::SECTION,
    &limits::SECTION,
];

/// A commented machine file with every key, to start from.
#[must_use]
pub fn template() -> String {
    document::template("A machine file of camgen. A quantity is \"number unit\".", SECTIONS)
}

/// The JSON schema of machine files.
#[must_use]
pub fn schema() -> serde_json::Value {
    document::schema("machine file of camgen", SECTIONS)
}

/// Of the keys given, those that have no effect on a kind of cam: [`ROTARY`], [`TRANSLATING`] or [`CONOID`].
#[must_use]
pub fn without_effect(given: &[String], cam: &str) -> Vec<String> {
    document::without_effect(SECTIONS, given, cam)
}

/// All faults of a machine file and its overrides.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct MachineError {
    /// At least one.
    pub faults: Vec<Fault>,
}

impl fmt::Display for MachineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let texts: Vec<String> = self.faults.iter().map(Fault::to_string).collect();
        f.write_str(&texts.join("\n"))
    }
}

/// A speed of the main shaft a machine can be asked for, rpm: at least 0.001, at most 100000.
///
/// # Errors
/// A message with the range.
pub fn valid_rpm(rpm: f64) -> Result<f64, String> {
    if (LEAST_RPM..=LARGEST_NUMBER).contains(&rpm) {
        Ok(rpm)
    } else {
        Err(format!("a speed must be at least {LEAST_RPM} and at most {LARGEST_NUMBER} rpm: {rpm}"))
    }
}

/// A machine in SI units, every value in range.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// What the sheet and the report call it.
    pub name: String,
    /// Bed and crank.
    pub bed: Bed,
    /// Polytropic exponent k.
    pub polytropic_exponent: f64,
    /// Ambient pressure, Pa, absolute.
    pub ambient_pressure: f64,
    /// End pressure at the design speed, Pa, absolute.
    pub end_pressure: f64,
    /// Air column.
    pub column: Column,
    /// Lead e, m.
    pub lead: f64,
    /// Design speed of the main shaft, rpm.
    pub design_rpm: f64,
    /// Follower.
    pub roller: RollerData,
    /// Disc.
    pub cam: CamData,
    /// Transition.
    pub transition: Transition,
    /// Plate on the bed, when described.
    pub translating: Option<TranslatingData>,
    /// Conoid, when described.
    pub conoid: Option<ConoidData>,
    /// Limits.
    pub limits: Limits,
    /// Keys the user gave.
    given: Vec<String>,
}

impl Machine {
    /// Reads a machine from TOML text; `source` names it in messages, each override is `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its place.
    pub fn from_toml(source: &str, text: &str, overrides: &[String]) -> Result<Self, MachineError> {
        Self::read(source, text, overrides, true)
    }

    /// `own` tells that the user wrote the text.
    fn read(source: &str, text: &str, overrides: &[String], own: bool) -> Result<Self, MachineError> {
        let reader = Reader::new(source, text, overrides, SECTIONS);
        let machine = Self::parts(&reader, own);
        reader.finish().map_err(|faults| MachineError { faults })?;
        // A part is missing only after a fault, so `finish` has returned before.
        machine.ok_or(MachineError { faults: Vec::new() })
    }

    fn parts(reader: &Reader<'_>, own: bool) -> Option<Self> {
        // Every part is read before the first `?`, so that each tells what is wrong between its keys.
        let (bed, buffer, roller, cam) =
            (bed::read(reader), buffer::read(reader), roller::read(reader), disc::read(reader));
        let (roller, buffer) = (roller?, buffer?);
        Some(Self {
            name: reader.table(&ROOT).get(&NAME)?,
            bed: bed?,
            polytropic_exponent: buffer.polytropic_exponent,
            ambient_pressure: buffer.ambient_pressure,
            end_pressure: buffer.end_pressure,
            column: buffer.column,
            lead: buffer.lead,
            design_rpm: buffer.design_rpm,
            roller,
            cam: cam?,
            transition: transition::read(reader)?,
            translating: translating::read(reader, roller.radius),
            conoid: conoid::read(reader),
            limits: limits::read(reader)?,
            given: reader.given(own),
        })
    }

    /// The keys the user gave, in a file of their own or by overrides, for [`without_effect`]. Of the tables
    /// `[translating]` and `[conoid]` only those given by overrides: a file may describe all kinds of cam.
    #[must_use]
    pub fn given(&self) -> &[String] {
        &self.given
    }

    /// Reads an embedded machine by its name, or a file. Returns the machine and the word that names its files.
    ///
    /// # Errors
    /// All faults found; a file that cannot be read is one of them.
    pub fn load(name_or_path: &str, overrides: &[String]) -> Result<(Self, String), MachineError> {
        if let Some(embedded) = EMBEDDED.iter().find(|machine| machine.name == name_or_path) {
            let machine = Self::read(&format!("{name_or_path} (embedded)"), embedded.toml, overrides, false)?;
            return Ok((machine, name_or_path.to_owned()));
        }
        let path = Path::new(name_or_path);
        let text = read_text(path).map_err(|why| MachineError {
            faults: vec![Fault {
                message: format!("cannot read the machine file `{name_or_path}`: {why}"),
                help: Some(format!("give a path to a TOML file or an embedded machine: {}", embedded::names())),
                place: None,
            }],
        })?;
        let machine = Self::from_toml(name_or_path, &text, overrides)?;
        let stem = path.file_stem().map_or_else(|| "machine".into(), |stem| stem.to_string_lossy().into_owned());
        Ok((machine, stem))
    }

    /// The pair of cylinders, sized at the design speed.
    #[must_use]
    pub fn cylinder(&self) -> Cylinder {
        let (k, p0, end) = (self.polytropic_exponent, self.ambient_pressure, self.end_pressure);
        Cylinder::sized(&self.bed, self.design_rpm, k, p0, end)
    }
}

fn read_text(path: &Path) -> Result<String, String> {
    if path.is_dir() {
        return Err("it is a directory".into());
    }
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(format!("it is larger than {LARGEST_FILE} bytes"));
    }
    String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".into())
}

#[cfg(test)]
mod tests;
