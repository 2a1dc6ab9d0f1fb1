//! The shaft that carries the cam: segments, supports and discs.

pub(super) mod limits;

pub use limits::ShaftLimits;

use crate::press::MachineOfPress;
use crate::press::cams::ROTARY;
use crate::press::machine::bed;
use crate::press::raised_disc::CutForShaft;
use crate::shaft::SHAFT;
use crate::shaft::mechanics::exact::Statics;
use crate::shaft::mechanics::{Beam, Shaft, ShaftDisc, ShaftSegment, StepSide, Support};
use camgen_cams::body::ShaftCompliance;
use camgen_cams::machine::{
    CamData, Catalogue, FollowerData, Machine, MachineError, MachineParts, MachineSource, Material, NAME, ROOT,
};
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::cams::MAKE;
use camgen_kernel::document::range::{HEAVIEST, HIGHEST_PRESSURE, LONGEST, STIFFEST};
use camgen_kernel::document::{Field, Input, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::motion::program;
use camgen_kernel::units::Dimension::{Angle, Density, Inertia, Length, Mass, Pressure, Stiffness, Unbalance};
use std::f64::consts::PI;

/// Path of the table.
const PATH: &str = "shaft";
/// Stiffest material, Pa; densest, kg/m³; largest moment of inertia, kg·m², and unbalance, kg·m.
const STIFFEST_MATERIAL: f64 = 1e3 * HIGHEST_PRESSURE;
const DENSEST: f64 = 1e5;
const LARGEST_INERTIA: f64 = 1e9;
const LARGEST_UNBALANCE: f64 = 1e6;
/// Supports nearer to each other than this are one, m.
const SAME_PLACE: f64 = 1e-6;
/// Share by which a bore may differ from the diameter of its shaft: rounding of typed lengths.
const SAME_DIAMETER: f64 = 1e-9;

/// `[shaft]` with its segments, supports and discs.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaftData {
    /// The shaft, without the cam on it.
    pub shaft: Shaft,
    /// Middle of the cam from the left end, m.
    pub cam_at: Option<f64>,
    /// Where the torque comes in, m; without it twist is not modelled.
    pub drive_at: Option<f64>,
    /// The rotary cam is cut so that its follower keeps the law on this shaft.
    pub compensate: bool,
}

const BEAM: Field<Beam> = Field::words(
    "beam",
    "\"timoshenko\" (with shear and the rotary inertia of the sections) or \"euler\"",
    Default("timoshenko"),
    &["timoshenko", "euler"],
    &[Beam::Timoshenko, Beam::Euler],
);
const CAM_AT: Field<f64> = Field::quantity(
    "cam_at",
    "middle of the cam from the left end of the shaft",
    Optional("150 mm"),
    Length,
    within(0.0, LONGEST),
);
const DRIVE_AT: Field<f64> = Field::quantity(
    "drive_at",
    "place where the torque enters, from the left end; without it twist is not modelled",
    Optional("0 mm"),
    Length,
    within(0.0, LONGEST),
);

const COMPENSATE: Field<bool> = Field::boolean(
    "compensate",
    "cut the rotary cam so that its follower keeps the law while the shaft deflects; exact at the design speed",
    Default("false"),
);

/// `[shaft]`.
pub(super) const SECTION: KeySection = KeySection {
    path: PATH,
    about: "the shaft that carries the cam, or a shaft alone: for `camgen shaft`",
    occurs: Occurrence::Optional,
    cams: &[SHAFT, ROTARY],
    keys: &[BEAM.key, CAM_AT.key, DRIVE_AT.key, COMPENSATE.key],
};

const LENGTH: Field<f64> =
    Field::quantity("length", "length of the segment", Required("40 mm"), Length, above(0.0, LONGEST));
const DIAMETER: Field<f64> =
    Field::quantity("diameter", "its outer diameter", Required("45 mm"), Length, above(0.0, LONGEST));
const BORE: Field<f64> =
    Field::quantity("bore", "diameter of its bore, below its diameter", Default("0 mm"), Length, within(0.0, LONGEST));
const MATERIALS: &[&str] = &["steel", "cast-iron", "bronze", "aluminium"];
const MATERIAL_VALUES: &[Material] = &[Material::Steel, Material::CastIron, Material::Bronze, Material::Aluminium];
const MATERIAL: Field<Material> = Field::words(
    "material",
    "\"steel\", \"cast-iron\", \"bronze\" or \"aluminium\"",
    Default("steel"),
    MATERIALS,
    MATERIAL_VALUES,
);
const MODULUS: Field<f64> = Field::quantity(
    "modulus",
    "modulus of elasticity, that of the material when absent",
    Optional("210 GPa"),
    Pressure,
    above(0.0, STIFFEST_MATERIAL),
);
const DENSITY: Field<f64> = Field::quantity(
    "density",
    "density, that of the material when absent; 0 is a shaft without mass",
    Optional("7850 kg/m3"),
    Density,
    within(0.0, DENSEST),
);
const POISSON: Field<f64> = Field::number(
    "poisson",
    "Poisson's ratio, that of the material when absent; 0 to 0.5",
    Optional("0.3"),
    within(0.0, 0.5),
);

/// `[[shaft.segment]]`.
pub(super) const SEGMENT: KeySection = KeySection {
    path: "shaft.segment",
    about: "a segment of the shaft, from left to right",
    occurs: Occurrence::Repeated,
    cams: &[SHAFT, ROTARY],
    keys: &[LENGTH.key, DIAMETER.key, BORE.key, MATERIAL.key, MODULUS.key, DENSITY.key, POISSON.key],
};

const SUPPORT_AT: Field<f64> =
    Field::quantity("at", "place from the left end", Required("20 mm"), Length, within(0.0, LONGEST));
const STIFFNESS: Field<Option<f64>> = Field::words_or_quantity(
    "stiffness",
    "\"rigid\", or its stiffness; rolling bearings with their housing 1e8 to 1e9 N/m",
    Required("5e8 N/m"),
    (&["rigid"], &[None]),
    (Stiffness, above(0.0, STIFFEST), Some),
);

/// `[[shaft.support]]`.
pub(super) const SUPPORT: KeySection = KeySection {
    path: "shaft.support",
    about: "a support of the shaft, at least two",
    occurs: Occurrence::Repeated,
    cams: &[SHAFT, ROTARY],
    keys: &[SUPPORT_AT.key, STIFFNESS.key],
};

const DISC_AT: Field<f64> =
    Field::quantity("at", "its middle from the left end", Required("290 mm"), Length, within(0.0, LONGEST));
const MASS: Field<f64> =
    Field::quantity("mass", "its mass, or diameter and width", Optional("2 kg"), Mass, above(0.0, HEAVIEST));
const DISC_DIAMETER: Field<f64> =
    Field::quantity("diameter", "outer diameter of a plain disc", Optional("120 mm"), Length, above(0.0, LONGEST));
const DISC_BORE: Field<f64> =
    Field::quantity("bore", "diameter of its bore, below its diameter", Default("0 mm"), Length, within(0.0, LONGEST));
const WIDTH: Field<f64> =
    Field::quantity("width", "width of a plain disc", Optional("20 mm"), Length, above(0.0, LONGEST));
const DISC_MATERIAL: Field<Material> = Field::words(
    "material",
    "material of a plain disc: \"steel\", \"cast-iron\", \"bronze\" or \"aluminium\"",
    Default("steel"),
    MATERIALS,
    MATERIAL_VALUES,
);
const DIAMETRAL: Field<f64> = Field::quantity(
    "diametral_inertia",
    "moment of inertia about a diameter; 0 when absent and a mass is given",
    Optional("0.002 kg*m2"),
    Inertia,
    within(0.0, LARGEST_INERTIA),
);
const POLAR: Field<f64> = Field::quantity(
    "polar_inertia",
    "moment of inertia about the shaft, at most twice that about a diameter; 0 when absent and a mass is given",
    Optional("0.004 kg*m2"),
    Inertia,
    within(0.0, LARGEST_INERTIA),
);
const UNBALANCE: Field<f64> = Field::quantity(
    "unbalance",
    "mass times the distance of its centre from the shaft",
    Default("0 g*mm"),
    Unbalance,
    within(0.0, LARGEST_UNBALANCE),
);
const ANGLE: Field<f64> =
    Field::quantity("angle", "cam angle of the unbalance", Default("0 deg"), Angle, within(-2.0 * PI, 2.0 * PI));

/// `[[shaft.disc]]`.
pub(super) const DISC: KeySection = KeySection {
    path: "shaft.disc",
    about: "a gear, coupling or weight on the shaft; the cam is not one of them",
    occurs: Occurrence::Repeated,
    cams: &[SHAFT, ROTARY],
    keys: &[
        DISC_AT.key,
        MASS.key,
        DISC_DIAMETER.key,
        DISC_BORE.key,
        WIDTH.key,
        DISC_MATERIAL.key,
        DIAMETRAL.key,
        POLAR.key,
        UNBALANCE.key,
        ANGLE.key,
    ],
};

/// Reads the shaft of a file, and its compliance at the cam if the cam is compensated for it.
pub(super) fn read(reader: &Reader<'_>, (cam, _): (Option<&CamData>, Option<&FollowerData>), parts: &mut MachineParts) {
    if let Some(limits) = limits::read(reader) {
        parts.set(limits);
    }
    let Some(data) = shaft(reader) else { return };
    carries(reader, &data, cam.and_then(|cam| cam.bore_radius));
    if let (true, Some(at)) = (data.compensate, data.cam_at) {
        parts.set(CutForShaft(data.yielding_at(at)));
    }
    parts.set(data);
}

impl ShaftData {
    /// Twist from the drive to the cam, rad/(N·m); `None` if one of them is not given.
    pub(super) fn drive_to_cam(&self) -> Option<f64> {
        Some(self.shaft.twist_compliance(self.drive_at?, self.cam_at?))
    }

    /// The compliance of the shaft at its cam, m from its left end; or why it is not known.
    fn yielding_at(&self, at: f64) -> Result<ShaftCompliance, String> {
        let twist = self.drive_at.map_or(0.0, |drive| self.shaft.twist_compliance(drive, at));
        let statics = Statics::new(&self.shaft, at).map_err(|error| error.to_string())?;
        Ok(ShaftCompliance { compliance: statics.own_compliance(), twist })
    }
}

/// What a machine file says of the shaft under its cam: methods of the [`Machine`].
pub trait MachineOfShaft: Sized {
    /// The shaft that carries the cam, when the file describes one.
    #[must_use]
    fn shaft(&self) -> Option<&ShaftData>;

    /// The machine with its rotary cam made for a rigid shaft, where the file requires one that is cut for its own.
    #[must_use]
    fn on_a_rigid_shaft(&self) -> Option<Self>;
}

impl MachineOfShaft for Machine {
    fn shaft(&self) -> Option<&ShaftData> {
        self.part()
    }

    fn on_a_rigid_shaft(&self) -> Option<Self> {
        let data = self.shaft().filter(|data| data.compensate)?;
        let rigid = ShaftData { compensate: false, ..data.clone() };
        Some(self.clone().with_part(Some(rigid)).with_part::<CutForShaft>(None))
    }
}

/// The shaft of a file; `None` when it has none, or one with a fault.
fn shaft(reader: &Reader<'_>) -> Option<ShaftData> {
    let table = reader.find(&SECTION)?;
    let segments: Vec<Option<ShaftSegment>> = reader.elements(&SEGMENT).map(|table| segment(&table)).collect();
    if segments.is_empty() {
        table.fail(&BEAM, "a shaft needs [[shaft.segment]]".into(), Some("add one [[shaft.segment]] each".into()));
        return None;
    }
    let known: Option<Vec<ShaftSegment>> = segments.into_iter().collect();
    let length: Option<f64> = known.as_ref().map(|all| all.iter().map(|segment| segment.length).sum());
    let supports: Option<Vec<Support>> = supports(reader, &table, length);
    let discs: Option<Vec<ShaftDisc>> = reader.elements(&DISC).map(|table| disc(&table, length)).collect();
    for place in [&CAM_AT, &DRIVE_AT] {
        within_length(&table, place, length);
    }
    // A position at the end is on the shaft, although decimal lengths do not add up exactly.
    let end = length.unwrap_or(f64::INFINITY);
    let cam_at = table.get(&CAM_AT).map(|at| at.min(end));
    let drive_at = table.get(&DRIVE_AT).map(|at| at.min(end));
    let beam = table.get(&BEAM)?;
    let supports = supports?.into_iter().map(|support| Support { at: support.at.min(end), ..support }).collect();
    let discs = discs?.into_iter().map(|disc| ShaftDisc { at: disc.at.min(end), ..disc }).collect();
    match Shaft::new(known?, supports, discs, beam) {
        Ok(shaft) => Some(ShaftData { shaft, cam_at, drive_at, compensate: table.get(&COMPENSATE)? }),
        Err(error) => {
            // Faults of the part itself are already reported.
            if reader.is_faultless() {
                table.fail(&BEAM, error.to_string(), None);
            }
            None
        }
    }
}

/// Reports a position beyond the end of the shaft.
fn within_length(table: &TableReader<'_>, place: &Field<f64>, length: Option<f64>) {
    if let (Some(at), Some(length)) = (table.get(place), length)
        && at > length + SAME_PLACE
    {
        let message = format!("the place lies beyond the end of the shaft: {}", table.typed(place));
        table.fail(place, message, Some(format!("its segments are {} mm long together", 1e3 * length)));
    }
}

fn segment(table: &TableReader<'_>) -> Option<ShaftSegment> {
    smaller_bore(table, &DIAMETER, &BORE);
    let material = table.get(&MATERIAL)?;
    let own =
        |field: &Field<f64>, of_material: f64| if table.has(field) { table.get(field) } else { Some(of_material) };
    Some(ShaftSegment {
        length: table.get(&LENGTH)?,
        diameter: table.get(&DIAMETER)?,
        bore: table.get(&BORE)?,
        modulus: own(&MODULUS, material.modulus())?,
        density: own(&DENSITY, material.density())?,
        poisson: own(&POISSON, material.poisson())?,
    })
}

fn smaller_bore(table: &TableReader<'_>, diameter: &Field<f64>, bore: &Field<f64>) {
    if let (Some(outer), Some(inner)) = (table.get(diameter), table.get(bore))
        && inner >= outer
    {
        let message = format!("bore must be below diameter: {} ≥ {}", table.typed(bore), table.typed(diameter));
        table.fail(bore, message, None);
    }
}

fn supports(reader: &Reader<'_>, shaft: &TableReader<'_>, length: Option<f64>) -> Option<Vec<Support>> {
    let tables: Vec<TableReader<'_>> = reader.elements(&SUPPORT).collect();
    if tables.len() < 2 {
        let help = Some("add one [[shaft.support]] each, with at and stiffness".into());
        shaft.fail(&BEAM, format!("a shaft needs two supports at least, and has {}", tables.len()), help);
        return None;
    }
    let mut before: Vec<f64> = Vec::new();
    for table in &tables {
        within_length(table, &SUPPORT_AT, length);
        if let Some(at) = table.get(&SUPPORT_AT) {
            if before.iter().any(|other| (other - at).abs() < SAME_PLACE) {
                let message = format!("two supports are at {}", table.typed(&SUPPORT_AT));
                table.fail(&SUPPORT_AT, message, Some("leave one out, or put it a micrometre away at least".into()));
            }
            before.push(at);
        }
    }
    let read =
        |table: &TableReader<'_>| Some(Support { at: table.get(&SUPPORT_AT)?, stiffness: table.get(&STIFFNESS)? });
    tables.iter().map(read).collect()
}

fn disc(table: &TableReader<'_>, length: Option<f64>) -> Option<ShaftDisc> {
    within_length(table, &DISC_AT, length);
    let (at, unbalance, angle) = (table.get(&DISC_AT)?, table.get(&UNBALANCE)?, table.get(&ANGLE)?);
    let unbalance = [unbalance * libm::cos(angle), unbalance * libm::sin(angle)];
    let plain = [table.has(&DISC_DIAMETER), table.has(&WIDTH)];
    let help = Some("give mass (with its inertias), or diameter and width".to_owned());
    let (mass, diametral_inertia, polar_inertia) = match (table.has(&MASS), plain) {
        (true, [false, false]) => (table.get(&MASS)?, or_nothing(table, &DIAMETRAL)?, or_nothing(table, &POLAR)?),
        (false, [true, true]) => {
            smaller_bore(table, &DISC_DIAMETER, &DISC_BORE);
            for inertia in [&DIAMETRAL, &POLAR] {
                if table.has(inertia) {
                    table.fail(inertia, "a plain disc has the inertias of its size".into(), help.clone());
                }
            }
            plain_disc(table)?
        }
        (true, _) => {
            table.fail(&MASS, "a disc has a mass or a size, not both".into(), help.clone());
            return None;
        }
        (false, _) => {
            table.fail(&DISC_AT, "this disc has neither a mass nor a size".into(), help.clone());
            return None;
        }
    };
    if polar_inertia > 2.0 * diametral_inertia * (1.0 + SAME_DIAMETER) {
        let message = "polar_inertia is more than twice diametral_inertia: no body has that".into();
        table.fail(&POLAR, message, Some("a thin disc has twice, a long one less".into()));
    }
    Some(ShaftDisc { at, mass, diametral_inertia, polar_inertia, unbalance })
}

fn or_nothing(table: &TableReader<'_>, field: &Field<f64>) -> Option<f64> {
    if table.has(field) { table.get(field) } else { Some(0.0) }
}

/// Mass, diametral and polar inertia of a cylinder with a bore.
fn plain_disc(table: &TableReader<'_>) -> Option<(f64, f64, f64)> {
    let (outer, inner) = (table.get(&DISC_DIAMETER)?, table.get(&DISC_BORE)?);
    let (width, density) = (table.get(&WIDTH)?, table.get(&DISC_MATERIAL)?.density());
    let mass = 0.25 * PI * (outer - inner) * (outer + inner) * width * density;
    let polar = 0.125 * mass * (outer * outer + inner * inner);
    Some((mass, 0.5 * polar + mass * width * width / 12.0, polar))
}

/// A shaft with its cam, or alone: what comes out of `ShaftMachine::load` only, every value in range.
#[derive(Debug, Clone)]
pub struct ShaftMachine {
    /// What the report calls it.
    pub(crate) name: String,
    /// The shaft.
    pub(crate) data: ShaftData,
    /// The limits.
    pub(crate) limits: ShaftLimits,
    /// The machine whose cam it carries.
    pub(crate) machine: Option<Machine>,
    /// Every value that has an effect.
    inputs: Vec<Input>,
}

impl ShaftMachine {
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
        let (mut shaft, carries) = source.read(overrides, |reader| Self::parts(source.catalogue, reader))?;
        if carries {
            let machine = Machine::of_source(source, overrides)?;
            let command = if machine.press().is_ok() { ROTARY } else { MAKE };
            let more = machine
                .inputs(command)
                .into_iter()
                .filter(|input| !shaft.inputs.iter().any(|own| own.key == input.key));
            shaft.inputs.extend(more.collect::<Vec<_>>());
            shaft.machine = Some(machine);
        }
        Ok(shaft)
    }

    /// The shaft of a file, and whether the file describes a cam that it carries.
    fn parts(catalogue: &Catalogue, reader: &Reader<'_>) -> Option<(Self, bool)> {
        let carries = reader.find(&bed::SECTION).is_some() || reader.find(&program::keys::SECTION).is_some();
        let Some(table) = reader.find(&SECTION) else {
            if !reader.is_explained(&SECTION) {
                let help = "add the table [shaft] with [[shaft.segment]] and [[shaft.support]], or take the embedded \
                            machine press-cylinder or dpi-shaft";
                reader.fail("the file describes no shaft".into(), Some(help.into()));
            }
            return None;
        };
        if carries && !table.has(&CAM_AT) {
            let help = Some("add it, e.g. cam_at = \"150 mm\"".into());
            table.fail(&CAM_AT, "missing key `shaft.cam_at`: the place of the cam on its shaft".into(), help);
        }
        let shaft = Self {
            name: reader.table(&ROOT).get(&NAME)?,
            data: shaft(reader)?,
            limits: limits::read(reader)?,
            machine: None,
            inputs: catalogue.keys.with_effect(&reader.inputs(), SHAFT),
        };
        Some((shaft, carries))
    }

    /// What reports call it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The shaft, without the cam on it.
    #[must_use]
    pub fn shaft(&self) -> &Shaft {
        &self.data.shaft
    }

    /// The machine whose cam the shaft carries.
    #[must_use]
    pub fn machine(&self) -> Option<&Machine> {
        self.machine.as_ref()
    }

    /// The machine with a cam that is made for a rigid shaft, where the file requires one that is cut for its own.
    #[must_use]
    pub fn with_rigid_cam(&self) -> Option<Self> {
        let machine = self.machine.as_ref()?.on_a_rigid_shaft()?;
        Some(Self { machine: Some(machine), ..self.clone() })
    }

    /// Every value that has an effect, defaults too.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }
}

/// Reports a bore of the cam that is not as wide as the shaft at the cam.
fn carries(reader: &Reader<'_>, data: &ShaftData, bore_radius: Option<f64>) {
    let (Some(at), Some(bore)) = (data.cam_at, bore_radius.map(|radius| 2.0 * radius)) else { return };
    let (diameter, _) = data.shaft.section_at(at, StepSide::Right);
    if (bore - diameter).abs() > SAME_DIAMETER * diameter {
        let message = format!(
            "the bore of the cam, {} mm, is not the diameter of the shaft at its place, {} mm",
            1e3 * bore,
            1e3 * diameter
        );
        let help = format!("give cam.bore_radius = \"{} mm\", or another place or segment", 500.0 * diameter);
        reader.table(&SECTION).fail(&CAM_AT, message, Some(help));
    }
}
