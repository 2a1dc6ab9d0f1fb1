//! The machine file: TOML to a [`Machine`] in SI units with every value in range.
//!
//! Whatever can be reported by line and column is reported here: no later module sees a negative mass or a wrong unit.
//!
//! Each part of the machine has a file with its data, its table of keys and its reading. [`sections`] gathers the
//! tables; a key is one constant in its table and one line in its reading.

mod bed;
mod brake;
mod buffer;
mod compensator;
mod conoid;
mod disc;
mod drive;
mod dynamics;
mod embedded;
mod limits;
mod linkage;
mod press;
mod settings;
mod shaft;
mod start;
mod stem;
mod title;
mod transition;
mod translating;

pub use crate::document::{Excerpt, Fault};
pub use crate::follower::{Crown, FollowerData, RollerData};
pub use brake::{
    Arrangement, BeltMode, BrakeCam, BrakeData, BrakeLimits, BrakeMachine, BrakeModel, DiscOfBrakeError, Wanted,
};
pub use compensator::CompensatorData;
pub use conoid::{ConoidData, ConoidMode, Shift};
pub use disc::{CamData, Keyway, Material, Rotation};
pub use drive::{DriveData, DriveMachine};
pub use dynamics::{GuideData, SpringData, VibrationData};
pub use embedded::{EMBEDDED, Embedded};
pub use limits::{Limits, LinkageLimits, Touching, customary_stress};
pub use linkage::LinkageData;
pub use press::{AirColumn, NoPress, NoRoller, Press};
pub use settings::RegimesData;
pub use shaft::{ShaftData, ShaftLimits, ShaftMachine};
pub use start::{followers, template, template_of_program};
pub use stem::fault_of as fault_of_stem;
pub use title::Title;
pub use translating::TranslatingData;

use crate::buffer::Bed;
use crate::document::Presence::Required;
use crate::document::cams;
use crate::document::file;
use crate::document::range::{LARGEST_NUMBER, LEAST_RPM};
use crate::document::{self, Field, Input, Occurs, Reader, Section};
use crate::follower::{self, FOLLOWERS, Place};
use crate::linkage::{End, Linkage, StrokeEnd};
use crate::motion::{Motion, Transition, program};
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// Largest machine file, bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// What is changed of a machine after it was read, as an input.
const OPPOSITE: &str = "follower (opposite offset)";
/// The input that [`Machine::at_end`] changes.
const END: &str = "end";
/// The key that [`Machine::ask_for_cutter`] changes.
const LARGEST_CUTTER: &str = "limits.cutter_radius";

const NAME: Field<String> = Field::text("name", "what the sheet and the report call the machine", Required("my press"));

/// The keys before the first table.
const ROOT: Section = Section { path: "", about: "", occurs: Occurs::Once, cams: &[], keys: &[NAME.key] };

/// The tables of a machine file before those of the followers, in the order of the template.
const MOTION_TABLES: &[&Section] = &[
    &ROOT,
    &bed::SECTION,
    &linkage::SECTION,
    &buffer::SECTION,
    &buffer::DESIGN,
    &program::keys::SECTION,
    &program::keys::FOURIER,
    &program::keys::POLYDYNE,
    &program::keys::SEGMENT,
];

/// The tables after those of the followers.
const BODY_TABLES: &[&Section] = &[
    &dynamics::SPRING,
    &dynamics::GUIDE,
    &dynamics::VIBRATION,
    &dynamics::FLYWHEEL,
    &disc::SECTION,
    &disc::KEYWAY,
    &transition::SECTION,
    &translating::SECTION,
    &conoid::SECTION,
    &compensator::SECTION,
    &shaft::SECTION,
    &shaft::SEGMENT,
    &shaft::SUPPORT,
    &shaft::DISC,
    &brake::SECTION,
    &brake::ROLL,
    &brake::WEB,
    &brake::FRAME,
    &brake::ENDS,
    &brake::CAM,
    &settings::REGIMES_SECTION,
    &settings::SPRING_SECTION,
    &drive::SECTION,
    &limits::SECTION,
    &title::SECTION,
];

/// Every table of a machine file: those of the machine, and one for each kind of follower.
#[must_use]
pub fn sections() -> Vec<&'static Section> {
    let followers = FOLLOWERS.iter().map(|kind| kind.section);
    MOTION_TABLES.iter().copied().chain(followers).chain(BODY_TABLES.iter().copied()).collect()
}

/// The JSON schema of machine files.
#[must_use]
pub fn schema() -> serde_json::Value {
    let mut schema = document::schema("machine file of camgen", &sections());
    // A cam has one follower, of any kind.
    for bound in ["minProperties", "maxProperties"] {
        schema["properties"]["follower"][bound] = 1.into();
    }
    if let Some(names) = schema["required"].as_array_mut() {
        names.push("follower".into());
    }
    schema
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

/// Accepts a speed of the main shaft, rpm: at least 0.001, at most 100000.
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

/// A machine in SI units, every value in range: what comes out of [`Machine::from_toml`] or [`Machine::load`] only.
#[derive(Debug, Clone)]
pub struct Machine {
    /// What the sheet and the report call it.
    pub(crate) name: String,
    /// The press, when described.
    press: Option<Press>,
    /// What moves its bed, when described.
    linkage: Option<LinkageData>,
    /// The motion program, when described.
    motion: Option<Arc<program::Program>>,
    /// Follower.
    pub(crate) follower: FollowerData,
    /// Disc.
    pub(crate) cam: CamData,
    /// Transition.
    pub(crate) transition: Transition,
    /// Plate on the bed, when described.
    pub(crate) translating: Option<TranslatingData>,
    /// Conoid, when described.
    pub(crate) conoid: Option<ConoidData>,
    /// Compensating cam, when described.
    compensator: Option<CompensatorData>,
    /// The shaft that carries the cam, when described.
    shaft: Option<Arc<ShaftData>>,
    /// Other speeds.
    regimes: RegimesData,
    /// Stiffness of springs under the bottoms, N/m.
    spring_stiffness: Option<f64>,
    /// Spring on the follower of a motion program, when described.
    spring: Option<SpringData>,
    /// Its guide, when described.
    guide: Option<GuideData>,
    /// Elastic train behind it, when described.
    vibration: Option<VibrationData>,
    /// Coefficient of speed fluctuation of its shaft, when a flywheel is described.
    fluctuation: Option<f64>,
    /// Limits.
    pub(crate) limits: Limits,
    /// Title block.
    pub(crate) title: Title,
    /// Keys the user gave.
    given: Vec<String>,
    /// Those of them that are set by overrides.
    overridden: Vec<String>,
    /// Every value, defaults too.
    inputs: Vec<Input>,
}

impl Machine {
    /// Reads a machine from TOML text; `source` names it in messages, each override is `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its place.
    pub fn from_toml(source: &str, text: &str, overrides: &[String]) -> Result<Self, MachineError> {
        Self::read(&Source::given(source, text), overrides)
    }

    fn read(source: &Source<'_>, overrides: &[String]) -> Result<Self, MachineError> {
        read_as(source, overrides, |reader| Self::parts(reader, source.own))
    }

    fn parts(reader: &Reader<'_>, own: bool) -> Option<Self> {
        // Every part is read before the first `?`, so that each reports what is wrong between its keys.
        let bed = bed::read(reader);
        let linkage = linkage::read(reader, bed.as_ref());
        let stroke_end = linkage.zip(bed).and_then(|(data, bed)| data.stroke_end(&bed, End::Outer));
        let (press, motion) = (buffer::read(reader, bed, stroke_end.as_ref()), program::read::read(reader));
        let (follower, cam) = (follower::read(reader), disc::read(reader));
        let (follower, cam) = (follower?, cam?);
        disc::reached_by(reader, &cam, &follower);
        let radius = follower.roller.map(|roller| roller.radius);
        let (regimes, spring_stiffness) = settings::read(reader);
        let shaft = shaft::read(reader);
        if let Some(shaft) = &shaft {
            shaft::carries(reader, shaft, cam.bore_radius);
        }
        Some(Self {
            name: reader.table(&ROOT).get(&NAME)?,
            press,
            linkage,
            motion: motion.map(Arc::new),
            cam,
            transition: transition::read(reader)?,
            translating: translating::read(reader, radius),
            conoid: conoid::read(reader),
            compensator: compensator::read(reader),
            shaft: shaft.map(Arc::new),
            regimes,
            spring_stiffness,
            spring: dynamics::spring(reader, &follower),
            guide: dynamics::guide(reader, &follower),
            vibration: dynamics::vibration(reader),
            fluctuation: dynamics::fluctuation(reader),
            limits: limits::read(reader, &*follower.shape)?,
            title: title::read(reader),
            given: reader.given(own),
            overridden: reader.given(false),
            inputs: limits::inputs(reader, &*follower.shape),
            follower,
        })
    }

    /// The machine with the path of its roller on the other side of the shaft; `None` where the path goes through the shaft.
    #[must_use]
    pub fn with_opposite_offset(&self) -> Option<Self> {
        let mut machine = Self { follower: self.follower.with_opposite_offset()?, ..self.clone() };
        let before = machine.inputs.len();
        machine.inputs.retain(|input| input.key != OPPOSITE);
        if machine.inputs.len() == before {
            machine.inputs.push(Input::word(OPPOSITE, "true"));
        }
        Some(machine)
    }

    /// The machine with its base radius left open, and of its follower's place what is given here.
    #[must_use]
    pub fn left_open(&self, place: Option<Place>) -> Self {
        let cam = CamData { base_radius: None, ..self.cam };
        Self { cam, follower: FollowerData { place, ..self.follower.clone() }, ..self.clone() }
    }

    /// What reports call it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The press.
    ///
    /// # Errors
    /// [`NoPress`] when the machine file describes none, or one whose linkage no buffer can balance.
    pub fn press(&self) -> Result<&Press, NoPress> {
        let press = self.press.as_ref().ok_or(NoPress::None)?;
        let moved = self.linkage.is_some_and(|data| data.linkage != Linkage::Yoke);
        if moved && press.stroke_end.is_none() { Err(NoPress::Reversals) } else { Ok(press) }
    }

    /// The end of the stroke at which its buffers stand, and the driving crank where the reversal starts there, rad from the line of the
    /// slider; `None` under a yoke.
    #[must_use]
    pub fn stroke_end(&self) -> Option<(StrokeEnd, f64)> {
        let (end, data) = (self.press.as_ref()?.stroke_end?, self.linkage?);
        Some((end, data.to_line(end.start())))
    }

    /// The end of the stroke at which its buffers stand, where a linkage tells them apart.
    #[must_use]
    pub fn end(&self) -> Option<End> {
        Some(self.press.as_ref()?.stroke_end?.end())
    }

    /// The machine with its buffers at an end of the stroke of its linkage, the outer one unless another is chosen.
    ///
    /// # Errors
    /// [`NoPress`] when there is no linkage, or none whose ends can have buffers.
    pub fn at_end(mut self, end: End) -> Result<Self, NoPress> {
        let data = self.linkage.filter(|data| data.linkage != Linkage::Yoke).ok_or(NoPress::NoEnds)?;
        self.press()?;
        if let Some(press) = &mut self.press {
            press.stroke_end = data.stroke_end(&press.bed, end);
        }
        self.inputs.retain(|input| input.key != END);
        self.inputs.push(Input::word(END, end.word()));
        Ok(self)
    }

    /// The bed of the press, whatever moves it.
    #[must_use]
    pub fn bed(&self) -> Option<&Bed> {
        self.press.as_ref().map(|press| &press.bed)
    }

    /// Design speed of the press, rpm, whatever moves its bed.
    #[must_use]
    pub fn design_rpm(&self) -> Option<f64> {
        self.press.as_ref().map(|press| press.design_rpm)
    }

    /// What moves the bed.
    #[must_use]
    pub fn linkage(&self) -> Option<&LinkageData> {
        self.linkage.as_ref()
    }

    /// The limits that a linkage must keep.
    #[must_use]
    pub fn linkage_limits(&self) -> LinkageLimits {
        self.limits.linkage
    }

    /// The other speeds that the file names.
    #[must_use]
    pub fn regimes(&self) -> &RegimesData {
        &self.regimes
    }

    /// The stiffness of springs under the bottoms that the file names, N/m.
    #[must_use]
    pub fn spring_stiffness(&self) -> Option<f64> {
        self.spring_stiffness
    }

    /// The spring on the follower of a motion program, when the file describes one.
    #[must_use]
    pub fn spring(&self) -> Option<SpringData> {
        self.spring
    }

    /// The guide of the follower of a motion program, when the file describes one.
    #[must_use]
    pub fn guide(&self) -> Option<GuideData> {
        self.guide
    }

    /// The elastic train behind the follower of a motion program, when the file describes one.
    #[must_use]
    pub fn vibration(&self) -> Option<VibrationData> {
        self.vibration
    }

    /// The coefficient of speed fluctuation that a flywheel on the shaft of a motion program is to keep, when the file gives one.
    #[must_use]
    pub fn fluctuation(&self) -> Option<f64> {
        self.fluctuation
    }

    /// The motion program of the file, with the speed of the cam where it gives one, rpm.
    #[must_use]
    pub fn motion(&self) -> Option<(Arc<dyn Motion>, Option<f64>)> {
        let program = self.motion.as_ref()?;
        Some((Arc::clone(program) as Arc<dyn Motion>, program.rpm()))
    }

    /// The same as a program.
    #[must_use]
    pub fn program(&self) -> Option<&program::Program> {
        self.motion.as_deref()
    }

    /// The machine with its rotary cam made for a rigid shaft, where the file asks for one that is cut for its own.
    #[must_use]
    pub fn on_a_rigid_shaft(&self) -> Option<Self> {
        let data = self.shaft.as_ref().filter(|data| data.compensate)?;
        let rigid = ShaftData { compensate: false, ..ShaftData::clone(data) };
        Some(Self { shaft: Some(Arc::new(rigid)), ..self.clone() })
    }

    /// The shaft that carries the cam, when the file describes one.
    #[must_use]
    pub fn shaft(&self) -> Option<&ShaftData> {
        self.shaft.as_deref()
    }

    /// The translating roller.
    ///
    /// # Errors
    /// [`NoRoller`] when the follower is another one, or its place is not given.
    pub fn roller(&self) -> Result<&RollerData, NoRoller> {
        if self.follower.place.is_some() {
            return Err(NoRoller::Auto);
        }
        self.follower.roller.as_ref().ok_or(NoRoller::Another)
    }

    /// Requires that a cutter of this radius (m) fits into the concave parts as well.
    pub fn ask_for_cutter(&mut self, radius: f64) {
        let limit = &mut self.limits.cutter_radius;
        let larger = limit.map_or(radius, |other| other.max(radius));
        *limit = Some(larger);
        self.inputs.retain(|input| input.key != LARGEST_CUTTER);
        self.inputs.push(Input::quantity(LARGEST_CUTTER, larger, ("mm", 1e-3)));
    }

    /// Every value that has an effect on a kind of cam as a command names it, defaults too.
    #[must_use]
    pub fn inputs(&self, command: &str) -> Vec<Input> {
        document::with_effect(&sections(), &self.inputs, command)
    }

    /// Of the keys given, those that have no effect on a kind of cam as a command names it.
    #[must_use]
    pub fn without_effect(&self, command: &str) -> Vec<String> {
        // A file may describe what an analysis does not look at.
        let given = if cams::ANALYSES.contains(&command) { &self.overridden } else { &self.given };
        document::without_effect(&sections(), given, command)
    }

    /// A sentence for each key that was given and has no effect on what a command makes, which messages call by its noun.
    #[must_use]
    pub fn idle_keys_told(&self, command: &str, noun: &str) -> Vec<String> {
        let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
        self.without_effect(command).iter().map(|key| format!("`{key}` has no effect on {article} {noun}")).collect()
    }

    /// The keys the user gave, in a file of their own or by overrides, for [`Machine::without_effect`]. Of the tables
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
        load_as(name_or_path, |source| Self::read(source, overrides))
    }
}

/// The text of a machine file.
struct Source<'a> {
    /// What messages call it.
    name: &'a str,
    text: &'a str,
    /// The user wrote it.
    own: bool,
    /// Where it stands.
    folder: Option<&'a Path>,
}

impl<'a> Source<'a> {
    /// A text of the user that stands in no folder.
    fn given(name: &'a str, text: &'a str) -> Self {
        Self { name, text, own: true, folder: None }
    }
}

/// What `parts` makes of a text that is read against the tables of a machine file.
fn read_as<T>(
    source: &Source<'_>,
    overrides: &[String],
    parts: impl FnOnce(&Reader<'_>) -> Option<T>,
) -> Result<T, MachineError> {
    let sections = sections();
    let reader = Reader::in_folder(source.folder, source.name, source.text, overrides, &sections);
    let made = parts(&reader);
    reader.finish().map_err(|faults| MachineError { faults })?;
    // A part is missing only after a fault, so `finish` has returned before.
    made.ok_or(MachineError { faults: Vec::new() })
}

/// What `read` makes of an embedded machine by its name, or of a file, and the word that names its files.
fn load_as<T>(
    name_or_path: &str,
    read: impl FnOnce(&Source<'_>) -> Result<T, MachineError>,
) -> Result<(T, String), MachineError> {
    let path = Path::new(name_or_path);
    let exact = |machine: &&Embedded| machine.name == name_or_path;
    let in_any_case = |machine: &&Embedded| machine.name.eq_ignore_ascii_case(name_or_path) && !path.exists();
    if let Some(embedded) = EMBEDDED.iter().find(exact).or_else(|| EMBEDDED.iter().find(in_any_case)) {
        let name = format!("{} (embedded)", embedded.name);
        let source = Source { name: &name, text: embedded.toml, own: false, folder: None };
        return Ok((read(&source)?, embedded.name.to_owned()));
    }
    let text = file::text_of(path, LARGEST_FILE).map_err(|why| MachineError {
        faults: vec![Fault {
            message: format!("cannot read the machine file `{name_or_path}`: {why}"),
            help: Some(format!(
                "{}give a path to a TOML file or an embedded machine: {}",
                meant(path)
                    .filter(|near| near != name_or_path)
                    .map_or(String::new(), |near| format!("did you mean `{near}`? Else ")),
                embedded::names()
            )),
            place: None,
        }],
    })?;
    let stem = stem::fitting(&path.file_stem().unwrap_or_default().to_string_lossy());
    let source = Source { folder: path.parent(), ..Source::given(name_or_path, &text) };
    Ok((read(&source)?, stem))
}

/// The embedded machine, or the TOML file in the same directory, whose name is nearest to that of a file that cannot be read.
fn meant(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let beside = std::fs::read_dir(parent.unwrap_or(Path::new("."))).into_iter().flatten().flatten();
    let mut files: Vec<String> = beside.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    files.retain(|file| Path::new(file).extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    let embedded = EMBEDDED.iter().map(|machine| machine.name).filter(|_| parent.is_none());
    let near = document::similar(name, embedded.chain(files.iter().map(String::as_str)))?;
    Some(
        parent
            .filter(|_| files.iter().any(|file| file == near))
            .map_or_else(|| near.to_owned(), |parent| parent.join(near).display().to_string()),
    )
}

#[cfg(test)]
mod tests;
