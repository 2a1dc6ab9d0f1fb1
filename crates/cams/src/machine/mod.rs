//! The machine file: TOML to a [`Machine`] in SI units with every value in range.
//!
//! Whatever can be reported by line and column is reported here: no later module sees a negative mass or a wrong unit.
//!
//! Each part of the machine has a file with its data, its table of keys and its reading. `list` gathers the
//! tables; a key is one constant in its table and one line in its reading.

mod as_made;
mod barrel;
mod bearing;
mod cutting;
mod disc;
mod dynamics;
mod embedded;
pub mod fit;
mod hole_pattern;
mod lift_table;
mod limits;
mod list;
mod material;
mod other_files;
mod output;
pub mod parallel_key;
mod part_features;
mod parts;
mod plate;
mod source;
mod start;
mod stem;
mod title;
mod track;
mod turret;

pub use as_made::AsMadeData;
pub use barrel::BarrelData;
pub use bearing::BearingData;
pub use camgen_kernel::document::{Excerpt, FileFault};
pub use camgen_kernel::follower::{Crown, FollowerData, RollerData};
pub use cutting::{Controller, Coolant, CutterEntry, CuttingData, CuttingForm, MillingDirection, RadiusCompensation};
pub use disc::{CamData, Keyway, Rotation};
pub use dynamics::{DampingAgainst, Dynamics, GuideData, SpringData, VibrationData};
pub use embedded::{EMBEDDED, Embedded};
pub use hole_pattern::HolePattern;
pub(crate) use lift_table::read as read_lift_table;
pub use limits::{Limits, OvershootLimit, customary_stress, customary_stress_of, stress_at_rest};
pub use list::sections;
pub use material::{CamMaterial, Grade, Material};
pub use output::UNITS_KEY;
pub use part_features::{Hub, PartFeatures, TimingMark};
pub use parts::{MachinePart, MachineParts};
pub use plate::PlateData;
pub use source::{Catalogue, MachineSource, ReadParts};
pub use start::{followers, schema, template, template_of_program};
pub use stem::{fault_of as fault_of_stem, fitting as fitting_stem};
pub use title::Title;
pub use track::{CounterData, TrackData};
pub use turret::TurretData;

use camgen_kernel::document::Presence::Required;
use camgen_kernel::document::cams;
use camgen_kernel::document::range::{LARGEST_NUMBER, LEAST_RPM, TURNS_FORWARD};
use camgen_kernel::document::{Field, Input, KeySection, NamedChoice, Occurrence, Reader};
use camgen_kernel::follower::{self, FollowerPlacement};
use camgen_kernel::motion::program::{FollowerMovement, ProgramSpan};
use camgen_kernel::motion::{Motion, Quantity, program};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use std::fmt;
use std::sync::Arc;

/// The input of a machine whose follower was moved to the other side after it was read.
const OPPOSITE: &str = "follower (opposite offset)";
/// The key that [`Machine::ask_for_cutter`] changes.
const LARGEST_CUTTER: &str = "limits.cutter_radius";
/// The key that [`Machine::at_rpm`] sets.
const SPEED: &str = "motion.rpm";

/// What the machine is called.
pub const NAME: Field<String> =
    Field::text("name", "name of the machine on the sheet and in the report", Required("my press"));

/// The keys before the first table.
pub const ROOT: KeySection = KeySection { path: "", about: "", occurs: Occurrence::Once, cams: &[], keys: &[NAME.key] };

/// All faults of a machine file and its overrides.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct MachineError {
    /// At least one.
    pub faults: Vec<FileFault>,
}

impl fmt::Display for MachineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let texts: Vec<String> = self.faults.iter().map(FileFault::to_string).collect();
        f.write_str(&texts.join("\n"))
    }
}

/// Accepts a speed of the main shaft, rpm: at least 0.001, at most 100000.
///
/// # Errors
/// A message with the range.
pub fn valid_rpm(rpm: f64) -> Result<f64, String> {
    if (LEAST_RPM..=LARGEST_NUMBER).contains(&rpm) {
        Ok(rpm)
    } else {
        let hint = if rpm < 0.0 { format!("; {TURNS_FORWARD}") } else { String::new() };
        Err(format!("a speed must be at least {LEAST_RPM} and at most {LARGEST_NUMBER} rpm: {rpm}{hint}"))
    }
}

/// A machine in SI units, every value in range: what comes out of `Machine::from_toml` or `Machine::load` only.
///
/// It has what every cam has. What a domain describes, as a press or a shaft, is a part of it ([`Machine::part`]).
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::Machine;
///
/// let (machine, name) = Machine::load("feeder", &["cam.thickness=20 mm".to_owned()])?;
/// assert_eq!((machine.name(), name.as_str()), ("Feeder", "feeder"));
///
/// // Every fault is reported, with its place and what would be right.
/// let error = Machine::load("feeder", &["cam.thikness=20 mm".to_owned(), "cam.bore_radius=-1 mm".to_owned()]).unwrap_err();
/// assert_eq!(error.faults.len(), 2);
/// println!("{error}");
/// # Ok::<(), camgen::MachineError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Machine {
    /// The tables that it was read against.
    catalogue: &'static Catalogue,
    /// What the sheet and the report call it.
    pub(crate) name: String,
    /// The motion program, when described.
    motion: Option<Arc<program::Program>>,
    /// Source of the motion program, if it depends on the speed.
    timed: Option<Arc<TimedMotion>>,
    /// Follower.
    pub follower: FollowerData,
    /// What moves with the follower of a motion program.
    dynamics: Dynamics,
    /// Disc.
    pub cam: CamData,
    /// Hub, timing mark, chamfers and joint of its disc.
    pub features: PartFeatures,
    /// Its holes in addition to the bore.
    pub holes: Vec<HolePattern>,
    /// Errors of the cam and its follower as they are made.
    pub(crate) as_made: Option<AsMadeData>,
    /// The material of the disc as the file calls it.
    pub(crate) material_name: Option<String>,
    /// Limits.
    pub limits: Limits,
    /// Title block.
    pub title: Title,
    /// The unit of its files.
    units: LengthUnit,
    /// How it is milled, where the file says so.
    cutting: Option<CuttingData>,
    /// The parts that domains have read.
    parts: MachineParts,
    /// Keys and values of the file.
    key_values: Arc<KeyValues>,
}

/// Source from which a speed-dependent motion is read again for another speed.
#[derive(Debug)]
struct TimedMotion {
    source: MachineSource,
    overrides: Vec<String>,
}

/// Keys and values of a machine file.
#[derive(Debug, Clone, Default)]
struct KeyValues {
    /// Keys the user gave.
    keys: Vec<String>,
    /// Those of them that are set by overrides.
    overridden: Vec<String>,
    /// Every value, defaults too.
    inputs: Vec<Input>,
}

/// Every value of a machine, for the hash of its inputs.
#[derive(Debug, Clone)]
pub(crate) struct MachineValues {
    catalogue: &'static Catalogue,
    key_values: Arc<KeyValues>,
}

impl MachineValues {
    /// Those that have an effect on a kind of cam as a command names it, defaults too.
    pub(crate) fn inputs(&self, command: &str) -> Vec<Input> {
        dynamics::without_frame(track::without_disc(self.catalogue.keys.with_effect(&self.key_values.inputs, command)))
    }
}

/// That a key has no effect on what is called by a noun.
#[must_use]
pub fn idle_key_note(key: &str, noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("`{key}` has no effect on {article} {noun}")
}

impl Machine {
    /// Reads a machine from a text that was read before, with overrides, each `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its place.
    pub fn of_source(source: &MachineSource, overrides: &[String]) -> Result<Self, MachineError> {
        let machine = source.read(overrides, |reader| Self::from_reader(reader, source))?;
        let is_timed = machine.motion.as_ref().is_some_and(|program| program.is_timed());
        Ok(Self {
            timed: is_timed.then(|| Arc::new(TimedMotion { source: source.clone(), overrides: overrides.to_vec() })),
            ..machine
        })
    }

    /// The machine with its motion at another cam speed, rpm: rates per second and a polydyne cam depend on it.
    ///
    /// # Errors
    /// [`Refusal`] if the motion is impossible at that speed.
    pub fn at_rpm(&self, rpm: Option<f64>) -> Result<Self, Refusal> {
        let of_file = self.motion.as_ref().and_then(|program| program.rpm());
        let other = rpm.filter(|rpm| Some(*rpm) != of_file);
        let Some((rpm, timed)) = other.zip(self.timed.as_ref()) else { return Ok(self.clone()) };
        let sets_speed = |set: &&String| set.split('=').next().is_some_and(|key| key.trim() == SPEED);
        let others = timed.overrides.iter().filter(|set| !sets_speed(set)).cloned();
        let overrides: Vec<String> = others.chain([format!("{SPEED}={rpm}")]).collect();
        let read = timed.source.read(&overrides, |reader| Self::from_reader(reader, &timed.source));
        let motion = read.map_err(|error| Refusal::new(format!("the motion at {rpm} rpm: {error}")))?.motion;
        Ok(Self { motion, ..self.clone() })
    }

    fn from_reader(reader: &Reader<'_>, source: &MachineSource) -> Option<Self> {
        // Everything is read before the first `?`, so that each part reports what is wrong between its keys.
        let (follower, cam) = (follower::read(reader), disc::read(reader));
        let moves = follower.as_ref().map(|FollowerData { path, shape, arm, .. }| FollowerMovement {
            table: path,
            quantity: turret::quantity(cam.as_ref().map(|cam| cam.track.body), shape.quantity()),
            arm: *arm,
        });
        let quantity = moves.map_or(Quantity::Length, |moves| moves.quantity);
        let turret = cam.as_ref().and_then(|cam| turret::read(reader, cam.track.body, follower.as_ref()));
        let span = cam.as_ref().map(|cam| match cam.track.body {
            cams::YOKE => ProgramSpan::HalfTurn,
            cams::WEDGE => ProgramSpan::Stroke,
            // Of a turret that has a fault it is not known.
            cams::GLOBOID => ProgramSpan::Index(turret.map_or(f64::NAN, |turret| turret.index())),
            _ => ProgramSpan::Turn,
        });
        // A follower that swings is refused on a plate, whatever its motion.
        let moves = moves.filter(|moves| span != Some(ProgramSpan::Stroke) || moves.quantity == Quantity::Length);
        let motion = source.motion(reader, moves, span);
        let mut parts = MachineParts::default();
        for read in &source.catalogue.parts {
            read(reader, (cam.as_ref(), follower.as_ref()), &mut parts);
        }
        let (follower, cam) = (follower?, cam?);
        disc::reached_by(reader, &cam, &follower);
        track::rolled_by(reader, &cam.track, &follower);
        if cam.track.body == cams::WEDGE {
            plate::refuse_turning(reader, &follower);
        }
        let given = (cam.track.body, cam.thickness.is_some());
        let (features, timing_hole) = part_features::read(reader, &reader.table(&disc::SECTION), given);
        let as_made = as_made::read(reader, &follower, cam.track.body);
        let counter = track::read_counter(reader, &follower);
        let barrel = barrel::read(reader, cam.track.groove_depth)?;
        let follower = turret::carried(follower, turret);
        let inputs = limits::inputs(reader, &*follower.shape, quantity);
        let cam = CamData { track: TrackData { counter, barrel, turret, ..cam.track }, ..cam };
        Some(Self {
            catalogue: source.catalogue,
            name: reader.table(&ROOT).get(&NAME)?,
            motion,
            timed: None,
            cam,
            features,
            holes: hole_pattern::read(reader, cam.track.body).into_iter().chain(timing_hole).collect(),
            as_made,
            material_name: disc::material_name(reader),
            dynamics: Dynamics::read(reader, &follower, quantity),
            limits: limits::read(reader, &*follower.shape, quantity)?,
            title: title::read(reader, disc::profile_tolerance(reader)),
            units: output::read(reader),
            cutting: cutting::read(reader),
            parts,
            key_values: Arc::new(KeyValues {
                keys: reader.given(source.by_user),
                overridden: reader.given(false),
                inputs,
            }),
            follower,
        })
    }

    /// What a domain has read of the file.
    #[must_use]
    pub fn part<T: MachinePart>(&self) -> Option<&T> {
        self.parts.get()
    }

    /// The machine with another part of its type, or without one.
    #[must_use]
    pub fn with_part<T: MachinePart>(mut self, part: Option<T>) -> Self {
        match part {
            Some(part) => self.parts.set(part),
            None => self.parts.remove::<T>(),
        }
        self
    }

    /// The machine with a value that was changed after it was read, for the hash of its inputs.
    #[must_use]
    pub fn with_input(mut self, input: Input) -> Self {
        let inputs = &mut Arc::make_mut(&mut self.key_values).inputs;
        inputs.retain(|other| other.key != input.key);
        inputs.push(input);
        self
    }

    /// Without the keys and values of its file: what is left is compared by tests.
    #[must_use]
    pub fn without_given(self) -> Self {
        Self { key_values: Arc::default(), ..self }
    }

    /// The tables that it was read against.
    #[must_use]
    pub fn catalogue(&self) -> &'static Catalogue {
        self.catalogue
    }

    /// The machine with the path of its roller on the other side of the shaft; `None` where the path goes through the shaft.
    #[must_use]
    pub fn with_opposite_offset(&self) -> Option<Self> {
        let mut machine = Self { follower: self.follower.with_opposite_offset()?, ..self.clone() };
        let inputs = &mut Arc::make_mut(&mut machine.key_values).inputs;
        let before = inputs.len();
        inputs.retain(|input| input.key != OPPOSITE);
        if inputs.len() == before {
            inputs.push(Input::word(OPPOSITE, "true"));
        }
        Some(machine)
    }

    /// The machine without a base radius, and with this part of its follower's position to be chosen.
    #[must_use]
    pub fn left_open(&self, place: Option<FollowerPlacement>) -> Self {
        let cam = CamData { base_radius: None, ..self.cam };
        Self { cam, follower: FollowerData { place, ..self.follower.clone() }, ..self.clone() }
    }

    /// The machine with another base radius, m.
    #[must_use]
    pub(crate) fn with_base_radius(&self, base_radius: f64) -> Self {
        Self { cam: CamData { base_radius: Some(base_radius), ..self.cam }, ..self.clone() }
    }

    /// The machine with another plate of a linear cam.
    #[must_use]
    pub fn with_plate(&self, plate: PlateData) -> Self {
        Self { cam: CamData { plate, ..self.cam }, ..self.clone() }
    }

    /// The machine with another follower.
    #[must_use]
    pub fn with_follower(&self, follower: FollowerData) -> Self {
        Self { follower, ..self.clone() }
    }

    /// The kind of body that is cut for its motion, as keys name it.
    #[must_use]
    pub fn body(&self) -> &'static str {
        self.cam.track.body
    }

    /// How it is milled.
    #[must_use]
    pub fn cutting(&self) -> CuttingData {
        self.cutting.clone().unwrap_or_default()
    }

    /// The unit of the lengths in its files.
    #[must_use]
    pub fn units(&self) -> LengthUnit {
        self.units
    }

    /// The machine with its files in another unit.
    #[must_use]
    pub fn in_units(self, units: LengthUnit) -> Self {
        let mut machine = self.with_input(Input::word(output::UNITS_KEY, units.word()));
        if units == LengthUnit::default() {
            Arc::make_mut(&mut machine.key_values).inputs.retain(|input| input.key != output::UNITS_KEY);
        }
        Self { units, ..machine }
    }

    /// What reports call it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The spring on the follower of a motion program, when the file describes one.
    #[must_use]
    pub fn spring(&self) -> Option<SpringData> {
        self.dynamics.spring
    }

    /// The guide of the follower of a motion program, when the file describes one.
    #[must_use]
    pub fn guide(&self) -> Option<GuideData> {
        self.dynamics.guide
    }

    /// The bearing of the roller of a motion program, when the file describes one.
    #[must_use]
    pub fn bearing(&self) -> Option<BearingData> {
        self.dynamics.bearing
    }

    /// The part against which the damping of the load on that train acts.
    #[must_use]
    pub fn damping_against(&self) -> DampingAgainst {
        self.dynamics.damping_against
    }

    /// The elastic train behind the follower of a motion program, when the file describes one.
    #[must_use]
    pub fn vibration(&self) -> Option<VibrationData> {
        self.dynamics.vibration
    }

    /// The coefficient of speed fluctuation that a flywheel on the shaft of a motion program is to keep, when the file gives one.
    #[must_use]
    pub fn fluctuation(&self) -> Option<f64> {
        self.dynamics.fluctuation
    }

    /// The motion program of the file, with the speed of the cam where it gives one, rpm.
    #[must_use]
    pub fn motion(&self) -> Option<(Arc<dyn Motion>, Option<f64>)> {
        let program = self.motion.as_ref()?;
        Some((Arc::clone(program) as Arc<dyn Motion>, program.rpm()))
    }

    /// The motion program of the file.
    #[must_use]
    pub fn program(&self) -> Option<&program::Program> {
        self.motion.as_deref()
    }

    /// The translating roller.
    ///
    /// # Errors
    /// [`Refusal`] when the follower is another one, or its place is not given.
    pub fn roller(&self) -> Result<&RollerData, Refusal> {
        if self.follower.place.is_some() {
            let what = "follower.roller.offset = \"auto\" is found for the motion of `camgen make` only";
            return Err(Refusal::new(what).remedy("give an offset"));
        }
        self.follower.roller.as_ref().ok_or_else(|| {
            Refusal::new("this cam needs a translating roller").remedy("give the table [follower.roller]")
        })
    }

    /// Requires that a cutter of this radius (m) fits into the concave parts as well.
    pub fn ask_for_cutter(&mut self, radius: f64) {
        let limit = &mut self.limits.cutter_radius;
        let larger = limit.map_or(radius, |other| other.max(radius));
        *limit = Some(larger);
        let inputs = &mut Arc::make_mut(&mut self.key_values).inputs;
        inputs.retain(|input| input.key != LARGEST_CUTTER);
        inputs.push(Input::quantity(LARGEST_CUTTER, larger, ("mm", 1e-3)));
    }

    /// Every value that has an effect on a kind of cam as a command names it, defaults too.
    #[must_use]
    pub fn inputs(&self, command: &str) -> Vec<Input> {
        self.values().inputs(command)
    }

    /// [`Machine::inputs`] with the body also for a disc, which the hash of the inputs leaves out.
    #[must_use]
    #[cfg(feature = "html")]
    pub(crate) fn inputs_with_body(&self, command: &str) -> Vec<Input> {
        self.catalogue.keys.with_effect(&self.key_values.inputs, command)
    }

    /// The limits in effect, given or default, as a person would type them.
    #[must_use]
    #[cfg(feature = "html")]
    pub(crate) fn usual_limits(&self) -> Vec<Input> {
        limits::usual(&self.limits, self.cam.material, self.cam.bore_radius)
    }

    /// Every value of it, shared.
    #[must_use]
    pub(crate) fn values(&self) -> MachineValues {
        MachineValues { catalogue: self.catalogue, key_values: Arc::clone(&self.key_values) }
    }

    /// Of the keys given, those that have no effect on a kind of cam as a command names it.
    #[must_use]
    pub fn without_effect(&self, command: &str) -> Vec<String> {
        // A file may describe what an analysis does not look at.
        let given =
            if self.catalogue.keys.is_analysis(command) { &self.key_values.overridden } else { &self.key_values.keys };
        self.catalogue.keys.without_effect(given, command)
    }

    /// A sentence for each key that was given and has no effect on what a command makes, which messages call by its noun.
    #[must_use]
    pub fn idle_key_notes(&self, command: &str, noun: &str) -> Vec<String> {
        self.without_effect(command).iter().map(|key| idle_key_note(key, noun)).collect()
    }

    /// The path of the table of its follower.
    #[must_use]
    pub fn follower_table(&self) -> &'static str {
        self.follower.path
    }

    /// The material of the cam as the file calls it.
    #[must_use]
    pub fn material_name(&self) -> Option<&str> {
        self.material_name.as_deref()
    }

    /// What the material of the cam was taken for, where it is not one of the classes.
    #[must_use]
    pub fn material_note(&self) -> Option<String> {
        self.cam.material.and_then(|material| material.note(self.material_name()?))
    }

    /// The keys the user gave, in a file of their own or by overrides, for [`Machine::without_effect`]. Of tables that
    /// may be in a file for another kind of cam only those given by overrides.
    #[must_use]
    pub fn given(&self) -> &[String] {
        &self.key_values.keys
    }
}
