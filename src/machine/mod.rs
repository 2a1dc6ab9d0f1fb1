//! The machine file: TOML to a [`Machine`] in SI units with every value in range.
//!
//! One of the two doors of the library: what comes out of here is a machine that can be computed. Whatever can be told
//! by line and column is told here; rooms behind this one do not see a negative mass.

mod bounds;
mod data;
mod embedded;
mod fault;
mod press;
mod reader;

pub use data::{
    CamData, ConoidData, ConoidMode, Crown, FollowerData, Keyway, Limits, Machine, Material, RollerData, Rotation,
    Shift, TranslatingData,
};
pub use embedded::{EMBEDDED, Embedded};
pub use fault::{Excerpt, Fault, MachineError};
pub use press::{NoPress, NoRoller, Press};

use crate::buffer::Bed;
use crate::buffer::bottom_law::Column;
use crate::follower::TranslatingRoller;
use crate::motion::Transition;
use crate::motion::equation_18::EfficiencyModel;
use crate::units::Dimension::{Angle, Force, Length, Mass, Pressure};
use bounds::{above, within};
use reader::Reader;
use std::f64::consts::{FRAC_PI_2, PI};
use std::io::Read;
use std::path::Path;

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

impl Machine {
    /// Reads a machine from TOML text; `source` names it in messages, each override is `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its place.
    pub fn from_toml(source: &str, text: &str, overrides: &[String]) -> Result<Self, MachineError> {
        let mut read = Reader::new(source, text, overrides);
        let name = read.text("name", "my press");
        let bed = read_bed(&mut read);
        let polytropic_exponent = read.number("buffer.polytropic_exponent", Some(1.35), within(1.0, 3.0));
        let pressure = above(0.0, HIGHEST_PRESSURE);
        let ambient_pressure = read.quantity("buffer.ambient_pressure", Pressure, "1 at", pressure);
        let end_pressure = read.quantity("buffer.end_pressure", Pressure, "2 at", pressure);
        if end_pressure <= ambient_pressure {
            let (end, ambient) = (read.typed("buffer.end_pressure"), read.typed("buffer.ambient_pressure"));
            read.fail(
                "buffer.end_pressure",
                format!("end_pressure must be above ambient_pressure: {end} ≤ {ambient}"),
                Some("both are absolute; an end pressure of 1 at gauge is 2 at absolute".into()),
            );
        }
        let column = read.word_or_quantity(
            "buffer.column",
            &[("matched", Column::Matched), ("return", Column::Return)],
            Length,
            above(0.0, LONGEST),
            Column::Length,
        );
        let lead = read.quantity_or("buffer.lead", Length, 0.0, within(0.0, LONGEST));
        let design_rpm = read.number("design.rpm", Some(35.0), within(LEAST_RPM, LARGEST_NUMBER));
        let radius = read.quantity("follower.roller.radius", Length, "30 mm", above(0.0, LONGEST));
        let offset = read.quantity_or("follower.roller.offset", Length, 0.0, within(-LONGEST, LONGEST));
        let mass = read.optional("follower.roller.mass", Mass, above(0.0, HEAVIEST)).map(|q| q.si);
        let preload = read.optional("follower.roller.preload", Force, within(0.0, LARGEST_FORCE)).map(|q| q.si);
        let (crown, width) = read_crown(&mut read);
        let cam = read_cam(&mut read, radius, offset);
        let transition = read_transition(&mut read);
        let translating = read.has("translating").then(|| read_translating(&mut read, radius)).flatten();
        let conoid = read.has("conoid").then(|| read_conoid(&mut read)).flatten();
        let limits = Limits {
            pressure_angle: read.quantity_or("limits.pressure_angle", Angle, PI / 6.0, above(0.0, FRAC_PI_2)),
            min_convex_pitch_radius_over_roller: read.number(
                "limits.min_convex_pitch_radius_over_roller",
                Some(2.0),
                within(0.0, LARGEST_NUMBER),
            ),
            cutter_radius: read.optional("limits.cutter_radius", Length, above(0.0, LONGEST)).map(|q| q.si),
            wall: read.quantity_or("limits.wall", Length, 0.0, within(0.0, LONGEST)),
            contact_stress: read.optional("limits.contact_stress", Pressure, above(0.0, 1e12)).map(|q| q.si),
        };
        read.finish()?;
        // Every `None` above has left a fault, so `finish` has returned before.
        let (Some(column), Some(cam), Some(transition)) = (column, cam, transition) else {
            return Err(MachineError { faults: Vec::new() });
        };
        Ok(Self {
            name,
            press: Some(Press { bed, polytropic_exponent, ambient_pressure, end_pressure, column, lead, design_rpm }),
            follower: FollowerData {
                shape: std::sync::Arc::new(TranslatingRoller::new(1.0, offset, radius)),
                mass,
                preload,
                roller: Some(RollerData { radius, offset, crown, width }),
            },
            cam,
            transition,
            translating,
            conoid,
            limits,
        })
    }

    /// Reads an embedded machine by its name, or a file. Returns the machine and the word that names its files.
    ///
    /// # Errors
    /// All faults found; a file that cannot be read is one of them.
    pub fn load(name_or_path: &str, overrides: &[String]) -> Result<(Self, String), MachineError> {
        if let Some(embedded) = EMBEDDED.iter().find(|machine| machine.name == name_or_path) {
            let machine = Self::from_toml(&format!("{name_or_path} (embedded)"), embedded.toml, overrides)?;
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

fn read_bed(read: &mut Reader<'_>) -> Bed {
    Bed {
        mass: read.quantity("bed.mass", Mass, "978.2 kg", above(0.0, HEAVIEST)),
        crank_radius: read.quantity("bed.crank_radius", Length, "180 mm", above(0.0, LONGEST)),
        crank_turns_per_main_shaft_turn: read.number(
            "bed.crank_turns_per_main_shaft_turn",
            Some(3.0),
            above(0.0, LARGEST_NUMBER),
        ),
    }
}

fn read_cam(read: &mut Reader<'_>, roller_radius: f64, offset: f64) -> Option<CamData> {
    let turns_per_crank_turn = read.number("cam.cam_turns_per_crank_turn", Some(1.0), above(0.0, LARGEST_NUMBER));
    let lever = read.number("cam.lever", Some(1.0), above(0.0, LARGEST_NUMBER));
    let base_radius = read.word_or_quantity("cam.base_radius", &[("auto", None)], Length, above(0.0, LONGEST), Some);
    let thickness = read.optional("cam.thickness", Length, within(THINNEST, LONGEST)).map(|q| q.si);
    let bore_radius = read.optional("cam.bore_radius", Length, above(0.0, LONGEST)).map(|q| q.si);
    let materials = [
        ("steel", Some(Material::Steel)),
        ("cast-iron", Some(Material::CastIron)),
        ("bronze", Some(Material::Bronze)),
        ("aluminium", Some(Material::Aluminium)),
    ];
    let material = if read.has("cam.material") { read.word("cam.material", &materials)? } else { None };
    let keyway = if read.has("cam.keyway") { Some(read_keyway(read, bore_radius)) } else { None };
    let balance = read.band("cam.balance", Length, above(0.0, LONGEST));
    let rotation = read.word("cam.rotation", &[("cw", Rotation::Clockwise), ("ccw", Rotation::CounterClockwise)]);
    if let (Some((inner, _)), Some(bore)) = (balance, bore_radius)
        && inner <= bore
    {
        let typed = read.typed("cam.bore_radius");
        read.fail("cam.balance", format!("the band of cam.balance must begin outside the bore of {typed}"), None);
    }
    if let Some(Some(base)) = base_radius {
        if offset.abs() >= base + roller_radius {
            let typed = read.typed("follower.roller.offset");
            read.fail(
                "cam.base_radius",
                format!("base radius and roller radius together must exceed the follower's offset of {typed}"),
                None,
            );
        }
        if bore_radius.is_some_and(|bore| bore >= base) {
            let (base, bore) = (read.typed("cam.base_radius"), read.typed("cam.bore_radius"));
            read.fail("cam.bore_radius", format!("bore_radius must be below base_radius: {bore} ≥ {base}"), None);
        }
    }
    Some(CamData {
        turns_per_crank_turn,
        lever,
        base_radius: base_radius?,
        thickness,
        bore_radius,
        keyway,
        material,
        balance,
        rotation: rotation?,
    })
}

fn read_keyway(read: &mut Reader<'_>, bore_radius: Option<f64>) -> Keyway {
    let length = above(0.0, LONGEST);
    let keyway = Keyway {
        width: read.quantity("cam.keyway.width", Length, "8 mm", length),
        depth: read.quantity("cam.keyway.depth", Length, "3.3 mm", length),
        angle: read.quantity_or("cam.keyway.angle", Angle, 0.0, within(-2.0 * PI, 2.0 * PI)),
    };
    match bore_radius {
        None => read.fail("cam.keyway.width", "a keyway needs a bore".into(), Some("add cam.bore_radius".into())),
        Some(bore) if keyway.width >= 2.0 * bore => {
            let typed = read.typed("cam.bore_radius");
            read.fail("cam.keyway.width", format!("the keyway is wider than the bore of radius {typed}"), None);
        }
        Some(_) => {}
    }
    keyway
}

fn read_crown(read: &mut Reader<'_>) -> (Crown, Option<f64>) {
    let shapes = [("sphere", Crown::Sphere), ("cylinder", Crown::Cylinder)];
    let crown = read.word("follower.roller.crown", &shapes).unwrap_or(Crown::Sphere);
    let width = read.optional("follower.roller.width", Length, above(0.0, LONGEST)).map(|q| q.si);
    if crown == Crown::Cylinder && width.is_none() {
        let remedy = Some("add follower.roller.width".into());
        read.fail("follower.roller.crown", "a cylindrical roller needs a width".into(), remedy);
    }
    (crown, width)
}

fn read_transition(read: &mut Reader<'_>) -> Option<Transition> {
    let width = read.quantity_or("transition.width", Angle, PI / 9.0, above(0.0, PI));
    let from: fn(f64) -> [Transition; 3] =
        |width| [Transition::RunUp { width }, Transition::Blend { width }, Transition::None];
    let [run_up, blend, none] = from(width);
    read.word("transition.kind", &[("run-up", run_up), ("blend", blend), ("none", none)])
}

fn read_translating(read: &mut Reader<'_>, roller_radius: f64) -> Option<TranslatingData> {
    let length = above(0.0, LONGEST);
    let model = [("consistent", EfficiencyModel::Consistent), ("printed", EfficiencyModel::Printed)];
    Some(TranslatingData {
        roller_arm: read.quantity("translating.roller_arm", Length, "300 mm", length),
        bottom_arm: read.quantity("translating.bottom_arm", Length, "300 mm", length),
        delta: read.quantity("translating.delta", Angle, "90 deg", above(0.0, PI)),
        friction_angle: read.quantity_or("translating.friction_angle", Angle, 0.0, within(0.0, FRAC_PI_2)),
        efficiency: read.number("translating.efficiency", Some(1.0), above(0.0, 1.0)),
        efficiency_model: read.word("translating.efficiency_model", &model)?,
        roller_radius: read.quantity_or("translating.roller_radius", Length, roller_radius, length),
        plate_height: read.optional("translating.plate_height", Length, length).map(|q| q.si),
    })
}

fn read_conoid(read: &mut Reader<'_>) -> Option<ConoidData> {
    Some(ConoidData {
        axial_travel: read.quantity("conoid.axial_travel", Length, "120 mm", above(0.0, LONGEST)),
        mode: read.word("conoid.mode", &[("adjusted", ConoidMode::Adjusted), ("fixed", ConoidMode::Fixed)])?,
        shift: read.word("conoid.shift", &[("linear", Shift::Linear), ("square", Shift::Square)])?,
        overhang: read.quantity_or("conoid.overhang", Length, 0.0, within(0.0, LONGEST)),
    })
}

#[cfg(test)]
mod tests;
