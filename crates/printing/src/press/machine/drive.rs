//! A bed that is braked by plain buffers alone, and driven so that its crank carries nothing: no cam.

use super::buffer::{AMBIENT_PRESSURE, COLUMN, POLYTROPIC_EXPONENT};
use super::press::{AirColumn, DRIVE as PATH};
use super::{bed, buffer};
use crate::press::buffer::bottom_law::ColumnRule;
use crate::press::cams::DRIVE;
use camgen_cams::machine::{Catalogue, MachineError, MachineSource, NAME, ROOT};
use camgen_kernel::document::Presence::{Optional, Required};
use camgen_kernel::document::range::{LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{Field, Input, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::{Angle, Inertia, Length, Speed};
use std::f64::consts::PI;

/// Fastest bed, m/s, and largest moment of inertia, kg·m².
const FASTEST: f64 = 1e3;
const LARGEST_INERTIA: f64 = 1e9;

/// `[drive]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveData {
    /// Angle φ_в by which the crank turns before it turns the bed, rad.
    pub lead_angle: f64,
    /// Speed v0 of the bed between its reversals, m/s.
    pub bed_speed: f64,
    /// Turns of the motor for one of the crank.
    pub motor_ratio: Option<f64>,
    /// Moment of inertia of the drive about the crank, kg·m².
    pub inertia: Option<f64>,
    /// Bore of each of the two cylinders, m; where it is absent it is the one with which the machine closes.
    pub bore: Option<f64>,
}

const LEAD_ANGLE: Field<f64> = Field::quantity(
    "lead_angle",
    "crank angle over which the bed still runs with the rim of the crank, 0 to 360 deg",
    Required("60 deg"),
    Angle,
    within(0.0, 2.0 * PI),
);
const BED_SPEED: Field<f64> = Field::quantity(
    "bed_speed",
    "speed of the bed between its reversals",
    Required("1.6 m/s"),
    Speed,
    above(0.0, FASTEST),
);
const MOTOR_RATIO: Field<f64> = Field::number(
    "motor_ratio",
    "turns of the motor for one turn of the crank, for its speed",
    Optional("16.546"),
    above(0.0, LARGEST_NUMBER),
);
const INERTIA: Field<f64> = Field::quantity(
    "inertia",
    "moment of inertia of the drive about the crank, for its torque",
    Optional("20 kg*m2"),
    Inertia,
    above(0.0, LARGEST_INERTIA),
);
const BORE: Field<f64> = Field::quantity(
    "bore",
    "bore of each of the two cylinders; when absent, the one with which the machine closes",
    Optional("145.2 mm"),
    Length,
    above(0.0, LONGEST),
);

/// `[drive]`.
pub(super) const SECTION: KeySection = KeySection {
    path: PATH,
    about: "a bed braked by plain buffers alone, without a cam",
    occurs: Occurrence::Optional,
    cams: &[DRIVE],
    keys: &[LEAD_ANGLE.key, BED_SPEED.key, MOTOR_RATIO.key, INERTIA.key, BORE.key],
};

/// A machine that is driven so: what comes out of `DriveMachine::load` only, every value in range.
#[derive(Debug, Clone)]
pub struct DriveMachine {
    /// What the report calls it.
    pub(crate) name: String,
    /// Mass of the bed, kg.
    pub(crate) mass: f64,
    /// Crank radius, m.
    pub(crate) crank_radius: f64,
    /// Polytropic exponent k.
    pub(crate) exponent: f64,
    /// Ambient pressure, Pa.
    pub(crate) ambient_pressure: f64,
    /// Air column L, m.
    pub(crate) column: f64,
    /// The drive.
    pub(crate) data: DriveData,
    /// Every value, defaults too.
    inputs: Vec<Input>,
}

impl DriveMachine {
    /// Reads an embedded machine by its name, or a file. Returns the machine and the word that names its files.
    ///
    /// # Errors
    /// All faults found; a file that cannot be read is one of them.
    pub fn load(name_or_path: &str, overrides: &[String]) -> Result<(Self, String), MachineError> {
        let source = MachineSource::load(name_or_path)?;
        Ok((Self::of_source(&source, overrides)?, source.stem().to_owned()))
    }

    /// Reads a machine from TOML text; `source` names it in messages, each override is `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its position in the file.
    pub fn from_toml(source: &str, text: &str, overrides: &[String]) -> Result<Self, MachineError> {
        Self::of_source(&MachineSource::from_toml(source, text), overrides)
    }

    /// Reads a machine from a text that was read before, with overrides, each `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its position in the file.
    pub fn of_source(source: &MachineSource, overrides: &[String]) -> Result<Self, MachineError> {
        source.read(overrides, |reader| Self::parts(source.catalogue, reader))
    }

    fn parts(catalogue: &Catalogue, reader: &Reader<'_>) -> Option<Self> {
        let (bed, buffer) = (reader.table(&bed::SECTION), reader.table(&buffer::SECTION));
        let Some(table) = reader.find(&SECTION) else {
            if !reader.is_explained(&SECTION) {
                let help = "add the table [drive] with lead_angle and bed_speed, or take the embedded machine dp";
                reader.fail("the file describes no drive".into(), Some(help.into()));
            }
            return None;
        };
        let column = match buffer.get(&COLUMN)? {
            AirColumn::Of(ColumnRule::Length(length)) => length,
            AirColumn::Of(ColumnRule::Matched | ColumnRule::Return) | AirColumn::LeastTorque => {
                let help = Some("give the length of the air column, e.g. column = \"485 mm\"".into());
                buffer.fail(&COLUMN, "a drive has no cam that a column could match".into(), help);
                return None;
            }
        };
        Some(Self {
            name: reader.table(&ROOT).get(&NAME)?,
            mass: bed.get(&bed::MASS)?,
            crank_radius: bed.get(&bed::CRANK_RADIUS)?,
            exponent: buffer.get(&POLYTROPIC_EXPONENT)?,
            ambient_pressure: buffer.get(&AMBIENT_PRESSURE)?,
            column,
            data: DriveData {
                lead_angle: table.get(&LEAD_ANGLE)?,
                bed_speed: table.get(&BED_SPEED)?,
                motor_ratio: table.get(&MOTOR_RATIO),
                inertia: table.get(&INERTIA),
                bore: table.get(&BORE),
            },
            inputs: catalogue.keys.with_effect(&reader.inputs(), DRIVE),
        })
    }

    /// What reports call it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Every value that has an effect, defaults too.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::MachineOfPress;
    use camgen_cams::machine::Machine;

    #[test]
    fn every_key_of_a_drive_reaches_it() {
        let with = |sets: &[String]| format!("{:?}", DriveMachine::load("dp", sets).expect("valid").0);
        for (key, value) in [
            ("drive.lead_angle", "50 deg"),
            ("drive.bed_speed", "1.5 m/s"),
            ("drive.motor_ratio", "17"),
            ("drive.inertia", "20 kg*m2"),
            ("drive.bore", "145 mm"),
            ("bed.mass", "900 kg"),
            ("bed.crank_radius", "170 mm"),
            ("buffer.polytropic_exponent", "1.4"),
            ("buffer.ambient_pressure", "1.1 at"),
            ("buffer.column", "500 mm"),
        ] {
            assert_ne!(with(&[format!("{key}={value}")]), with(&[]), "{key}");
        }
        let error =
            |name: &str, set: &str| DriveMachine::load(name, &[set.to_owned()]).expect_err("a fault").to_string();
        assert!(error("dp", "buffer.column=matched").contains("no cam that a column could match"));
        assert!(error("dp", "drive.bed_speed=1.6 m").contains("a unit of length, not of speed"));
        assert!(error("dpi", "bed.mass=1 kg").contains("describes no drive"));
        let press = Machine::load("dp", &["follower.roller.radius=30mm".into()]).expect("read");
        assert!(press.0.press().is_err(), "a drive has no end pressure");
    }
}
