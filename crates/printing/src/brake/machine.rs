//! The belt brake of a paper roll: roll, web, frame or the paper's two ends, and the disc that holds the tension.

mod keys;
pub(super) mod limits;

pub(super) use keys::{CAM, ENDS, FRAME, ROLL, SECTION, WEB};

use super::BRAKE;
use crate::brake::BrakeDisc;
use crate::brake::mechanics::ends::RollEnds;
use crate::brake::mechanics::{
    Brake, BrakeError, BrakeFrame, PaperRoll, Pulley, RollRotation, TensionHolding, Web, turned_too_far,
};
use camgen_cams::machine::{Catalogue, FollowerData, Machine, MachineError, MachineSource, NAME, ROOT};
use camgen_kernel::document::{Input, InputFiles, Reader, TableReader};
use camgen_kernel::refusal::Refusal;
use keys::{
    ACCELERATION, BELT_SPEED_RATIO, CENTRE_OF_GRAVITY, DENSITY, FRICTION, GRIP, LARGEST_RADIUS, LEFT_PULLEY, MODE,
    MODEL, MODULUS, PIVOT, PRELOAD, PRESS_RATIO, PULLEY_RADIUS, RIGHT_PULLEY, ROTATION, SMALLEST_RADIUS, SPEED,
    SPRING_RATE, TENSION, THICKNESS, TURNS, WEB_LENGTH, WEIGHT, WIDTH, WOUND_STRAIN, WRAP,
};
pub use limits::BrakeLimits;
use std::f64::consts::TAU;

/// Least change of the radius of the roll, divided by its largest radius.
const LEAST_RUN: f64 = 1e-6;

/// Whether the belt slips on the roll.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeltMode {
    /// The belt slips on the roll: its grip makes the tension.
    Slip,
    /// The belt runs with the roll: its speed makes the tension, as far as it grips.
    NoSlip,
}

/// Whose equations give the tension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BrakeModel {
    /// Moments about the roll and about the pivot.
    Consistent,
    /// (1)–(15) as they are printed.
    Printed,
}

/// The arrangement that presses the belt onto the roll, as far as the file describes it.
#[derive(Debug, Clone)]
pub enum Arrangement {
    /// A hinged frame that follows the roll.
    Frame(Box<Brake>),
    /// The wraps at both ends of the roll, for (7)–(10).
    Ends(RollEnds),
    /// The roll, its sense and the radius of the pulleys, m, for which a frame is to be designed.
    Roll(PaperRoll, RollRotation, f64),
}

/// The wanted result for a brake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BrakeOutput {
    /// Its figures.
    Figures,
    /// The disc of `[brake.cam]` too.
    Disc,
    /// A frame; overrides the file.
    Frame,
}

/// The disc on the frame's shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrakeCam {
    /// Turns of the disc for one of the frame.
    pub turns_per_frame_turn: f64,
    /// Rate of the spring of its follower, N/m.
    pub spring_rate: f64,
    /// Force of that spring at the lowest lift of its law, N.
    pub preload: f64,
}

/// `[brake]` with its tables.
#[derive(Debug, Clone)]
pub struct BrakeData {
    /// With or without slip.
    pub mode: BeltMode,
    /// Whose equations.
    pub model: BrakeModel,
    /// Wanted web tension, N.
    pub tension: f64,
    /// Friction of belt and roll.
    pub friction: f64,
    /// Weight of the frame with its load, N; `None` is `auto`.
    pub weight: Option<f64>,
    /// Speed of a slipping belt / web speed.
    pub belt_speed_ratio: f64,
    /// Least grip of a belt that does not slip, over the wanted tension.
    pub grip: f64,
    /// Acceleration of the web while the machine speeds up, m/s².
    pub acceleration: f64,
    /// Density of the roll, kg/m³.
    pub density: Option<f64>,
    /// The web.
    pub web: Option<Web>,
    /// Frame or ends.
    pub arrangement: Arrangement,
    /// The disc.
    pub cam: Option<BrakeCam>,
}

fn read(reader: &Reader<'_>, wanted: BrakeOutput) -> Option<BrakeData> {
    let Some(table) = reader.find(&SECTION) else {
        if !reader.is_explained(&SECTION) {
            let help = "add the table [brake] with [brake.roll] and [brake.frame], or use the embedded machine roll or \
                        roll-level";
            reader.fail("the file describes no brake".into(), Some(help.into()));
        }
        return None;
    };
    let web = reader.find(&WEB).map(|table| read_web(&table));
    let density = reader.find(&ROLL).and_then(|roll| roll.get(&DENSITY));
    let (mode, acceleration) = (table.get(&MODE), table.get(&ACCELERATION));
    if mode == Some(BeltMode::NoSlip) && web.is_none() {
        let help = Some("add the table [brake.web], or use mode = \"slip\"".into());
        table.fail(&MODE, "a belt that does not slip stretches the web: the web must be described".into(), help);
    }
    if acceleration.is_some_and(|rate| rate > 0.0) && (density.is_none() || web.is_none()) {
        let help = Some("add brake.roll.density and the table [brake.web]".into());
        table.fail(&ACCELERATION, "speeding up needs the inertia of the roll".into(), help);
    }
    let arrangement = arrangement(reader, &table, wanted);
    let cam = reader.find(&CAM).filter(|_| wanted == BrakeOutput::Disc).map(|cam| read_cam(&cam, arrangement.as_ref()));
    Some(BrakeData {
        mode: mode?,
        model: table.get(&MODEL)?,
        tension: table.get(&TENSION)?,
        friction: table.get(&FRICTION)?,
        weight: table.get(&WEIGHT)?,
        belt_speed_ratio: table.get(&BELT_SPEED_RATIO)?,
        grip: table.get(&GRIP)?,
        acceleration: acceleration?,
        density,
        web: web.flatten(),
        arrangement: arrangement?,
        cam: cam.flatten(),
    })
}

/// Reports why a brake cannot have a disc.
fn can_have_a_disc(reader: &Reader<'_>) {
    if reader.find(&CAM).is_none() {
        let help =
            "add the table [brake.cam] with turns_per_frame_turn, spring_rate and preload, and [follower.roller]";
        reader.fail("the file describes no disc on the shaft of the frame".into(), Some(help.into()));
    }
    let Some(table) = reader.find(&SECTION) else { return };
    if table.get(&MODE) == Some(BeltMode::NoSlip) {
        let message =
            "a disc holds only the tension of a slipping belt: without slip the belt's speed sets the tension";
        table.fail(&MODE, message.into(), Some(use_or_omit_cam("slip")));
    }
    if table.get(&MODEL) == Some(BrakeModel::Printed) {
        let message = "a disc needs the exact moments: the printed ones omit that of the friction about the pivot";
        table.fail(&MODEL, message.into(), Some(use_or_omit_cam("consistent")));
    }
}

fn use_or_omit_cam(word: &str) -> String {
    format!("use \"{word}\", or omit --cam")
}

fn read_web(table: &TableReader<'_>) -> Option<Web> {
    let web = Web {
        thickness: table.get(&THICKNESS)?,
        width: table.get(&WIDTH)?,
        modulus: table.get(&MODULUS)?,
        speed: table.get(&SPEED)?,
        wound_strain: table.get(&WOUND_STRAIN)?,
        length: table.get(&WEB_LENGTH),
    };
    match web.checked() {
        Ok(web) => Some(web),
        Err(error) => {
            table.fail(&THICKNESS, error.to_string(), None);
            None
        }
    }
}

/// The frame, or the two ends.
fn arrangement(reader: &Reader<'_>, brake: &TableReader<'_>, wanted: BrakeOutput) -> Option<Arrangement> {
    let (frame, ends) = (reader.find(&FRAME), reader.find(&ENDS));
    match (frame, ends) {
        (Some(_), Some(ends)) => {
            let help = Some("remove one of them".into());
            ends.fail(&WRAP, "give [brake.frame] or [brake.ends], not both".into(), help);
            None
        }
        (None, None) => {
            let help =
                Some("add [brake.frame] with [brake.roll], or [brake.ends] for the paper's own equations".into());
            brake.fail(&TENSION, "the brake has neither [brake.frame] nor [brake.ends]".into(), help);
            None
        }
        (None, Some(ends)) => read_ends(&ends, brake).map(Arrangement::Ends),
        (Some(table), None) if wanted == BrakeOutput::Frame => {
            let (roll, pulley) = (read_roll(reader), table.get(&PULLEY_RADIUS));
            Some(Arrangement::Roll(roll?, brake.get(&ROTATION)?, pulley?))
        }
        (Some(table), None) => {
            let (roll, frame) = (read_roll(reader), read_frame(&table));
            let made = Brake::new(frame?, roll?, brake.get(&FRICTION)?, brake.get(&ROTATION)?);
            made.map_err(|wall| report_wall(&table, &wall)).ok().map(|made| Arrangement::Frame(Box::new(made)))
        }
    }
}

/// Reports where a frame can go no further, at the key that is most likely responsible.
fn report_wall(frame: &TableReader<'_>, wall: &BrakeError) {
    let key = match wall {
        BrakeError::PulleyMeetsRoll { pulley: Pulley::Left, .. } => &LEFT_PULLEY,
        BrakeError::PulleyMeetsRoll { .. } | BrakeError::BeltLeavesRoll { .. } => &RIGHT_PULLEY,
        BrakeError::WeightLifts { .. } => &CENTRE_OF_GRAVITY,
        _ => &PIVOT,
    };
    frame.fail(key, format!("frame_reach: {wall}"), None);
}

fn read_ends(ends: &TableReader<'_>, brake: &TableReader<'_>) -> Option<RollEnds> {
    let (wraps, ratio) = (ends.get(&WRAP)?, ends.get(&PRESS_RATIO)?);
    match RollEnds::new(wraps, brake.get(&FRICTION)?, ratio) {
        Ok(ends) => Some(ends),
        Err(error) => {
            ends.fail(&WRAP, error.to_string(), None);
            None
        }
    }
}

fn read_roll(reader: &Reader<'_>) -> Option<PaperRoll> {
    let table = reader.find(&ROLL)?;
    let (largest_radius, smallest_radius) = (table.get(&LARGEST_RADIUS)?, table.get(&SMALLEST_RADIUS)?);
    let (smallest, largest) = (table.typed(&SMALLEST_RADIUS), table.typed(&LARGEST_RADIUS));
    let apart = largest_radius - smallest_radius;
    if apart < LEAST_RUN * largest_radius {
        let message = if apart <= 0.0 {
            format!("smallest_radius must be below largest_radius: {smallest} ≥ {largest}")
        } else {
            format!(
                "the radius of the roll hardly changes, from {largest} to {smallest}; it must change by at least a millionth"
            )
        };
        table.fail(&SMALLEST_RADIUS, message, None);
        return None;
    }
    Some(PaperRoll { largest_radius, smallest_radius })
}

fn read_frame(table: &TableReader<'_>) -> Option<BrakeFrame> {
    Some(BrakeFrame {
        pivot: table.get(&PIVOT)?,
        right_pulley: table.get(&RIGHT_PULLEY)?,
        left_pulley: table.get(&LEFT_PULLEY)?,
        centre_of_gravity: table.get(&CENTRE_OF_GRAVITY)?,
        pulley_radius: table.get(&PULLEY_RADIUS)?,
    })
}

fn read_cam(table: &TableReader<'_>, arrangement: Option<&Arrangement>) -> Option<BrakeCam> {
    let turns_per_frame_turn = table.get(&TURNS)?;
    match arrangement {
        Some(Arrangement::Frame(brake)) => {
            let turn = brake.at(brake.roll().smallest_radius).map_or(0.0, |pose| pose.theta.abs());
            if turns_per_frame_turn * turn >= TAU {
                let error = turned_too_far(turns_per_frame_turn, turn);
                table.fail(&TURNS, error.to_string(), None);
                return None;
            }
        }
        Some(Arrangement::Ends(_) | Arrangement::Roll(..)) => {
            let help = Some("add [brake.frame] in place of [brake.ends]".into());
            table.fail(&TURNS, "a disc that holds the tension needs the frame that turns it".into(), help);
            return None;
        }
        None => {}
    }
    Some(BrakeCam { turns_per_frame_turn, spring_rate: table.get(&SPRING_RATE)?, preload: table.get(&PRELOAD)? })
}

/// A belt brake: what comes out of [`BrakeMachine::load`] only, every value in range.
#[derive(Debug, Clone)]
pub struct BrakeMachine {
    /// Its name in reports.
    pub(crate) name: String,
    /// The brake.
    pub(crate) data: BrakeData,
    /// Its limits.
    pub(crate) limits: BrakeLimits,
    /// Roller, disc and limits of the disc that holds the tension, where it was requested.
    pub(crate) machine: Option<Machine>,
    /// Every value that has an effect.
    inputs: Vec<Input>,
}

impl BrakeMachine {
    /// Reads an embedded machine by its name, or a file, against a catalogue. Returns the machine and the stem of its files.
    ///
    /// # Errors
    /// All faults found; a file that cannot be read is one of them.
    pub fn load(
        catalogue: &'static Catalogue,
        name_or_path: &str,
        overrides: &[String],
        wanted: BrakeOutput,
    ) -> Result<(Self, String), MachineError> {
        let source = catalogue.source(name_or_path, &InputFiles::default())?;
        Ok((Self::of_source(&source, overrides, wanted)?, source.stem().to_owned()))
    }

    /// Reads a machine from a text that was read before, with overrides, each `key=value`.
    ///
    /// # Errors
    /// All faults found, each with its position in the file.
    pub fn of_source(source: &MachineSource, overrides: &[String], wanted: BrakeOutput) -> Result<Self, MachineError> {
        let mut brake = source.read(overrides, |reader| Self::parts(source.catalogue, reader, wanted))?;
        if wanted == BrakeOutput::Disc {
            brake.machine = Some(Machine::of_source(source, overrides)?);
        }
        Ok(brake)
    }

    fn parts(catalogue: &Catalogue, reader: &Reader<'_>, wanted: BrakeOutput) -> Option<Self> {
        let data = read(reader, wanted);
        if wanted == BrakeOutput::Disc {
            can_have_a_disc(reader);
        }
        Some(Self {
            name: reader.table(&ROOT).get(&NAME)?,
            data: data?,
            limits: limits::read(reader)?,
            machine: None,
            inputs: catalogue.keys.with_effect(&reader.inputs(), BRAKE),
        })
    }

    /// Its name in reports.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The machine file as a cam's, where the disc was requested.
    #[must_use]
    pub fn machine(&self) -> Option<&Machine> {
        self.machine.as_ref()
    }

    /// The brake as the file describes it.
    #[must_use]
    pub fn data(&self) -> &BrakeData {
        &self.data
    }

    /// The machine with another frame.
    #[must_use]
    pub fn with_frame(&self, brake: Brake) -> Self {
        let arrangement = Arrangement::Frame(Box::new(brake));
        Self { data: BrakeData { arrangement, ..self.data.clone() }, ..self.clone() }
    }

    /// Every value that has an effect, defaults too.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// The motion of the disc that holds the tension.
    ///
    /// # Errors
    /// [`Refusal`] when the file does not describe a disc, its frame allows none, or the law has no solution.
    pub fn brake_disc(&self) -> Result<BrakeDisc, Refusal> {
        let (Some(cam), Arrangement::Frame(brake)) = (self.data.cam, &self.data.arrangement) else {
            return Err(Refusal::new("the file describes no disc on the shaft of the frame")
                .remedy("add [brake.cam], [brake.frame] and [follower.roller]"));
        };
        let refused = "there is no disc that holds the tension";
        let holding = brake.at(brake.roll().largest_radius).and_then(|full| {
            let weight = self.data.weight.unwrap_or_else(|| brake.weight_for(self.data.tension, &full));
            TensionHolding::new(Brake::clone(brake), weight, self.data.tension, cam.turns_per_frame_turn)
        });
        let holding = holding.map_err(|error| Refusal::from(error).context(refused))?;
        BrakeDisc::new(holding, cam.spring_rate, cam.preload)
            .map_err(|error| error.context(refused).remedy("see brake.cam.spring_rate and brake.cam.preload"))
    }

    /// Roller, disc and limits of the disc, its follower pressed on by the spring of `[brake.cam]`, of which this is the force (N) where
    /// the lift is 0; `None` where it was not requested.
    #[must_use]
    pub fn of_disc(&self, preload: f64) -> Option<Machine> {
        let (machine, cam) = (self.machine.as_ref()?, self.data.cam?);
        let spring = (Some(preload), cam.spring_rate);
        let follower =
            FollowerData { preload: spring.0, spring_rate: spring.1, mass: None, ..machine.follower.clone() };
        Some(machine.with_follower(follower))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_cams::catalogue::catalogue;

    /// Another value of every key.
    const OTHERS: &[(&str, &str)] = &[
        ("brake.mode", "no-slip"),
        ("brake.model", "printed"),
        ("brake.tension", "310 N"),
        ("brake.friction", "0.26"),
        ("brake.weight", "1000 N"),
        ("brake.rotation", "ccw"),
        ("brake.belt_speed_ratio", "0.5"),
        ("brake.grip", "1.4"),
        ("brake.acceleration", "0.3 m/s2"),
        ("brake.roll.largest_radius", "590 mm"),
        ("brake.roll.largest_diameter", "1180 mm"),
        ("brake.roll.smallest_radius", "60 mm"),
        ("brake.roll.smallest_diameter", "120 mm"),
        ("brake.roll.density", "710 kg/m3"),
        ("brake.web.thickness", "0.08 mm"),
        ("brake.web.width", "850 mm"),
        ("brake.web.modulus", "4400 MPa"),
        ("brake.web.speed", "9 m/s"),
        ("brake.web.wound_strain", "0.0002"),
        ("brake.web.length", "7 m"),
        ("brake.frame.pivot", "[-1110 mm, 550 mm]"),
        ("brake.frame.right_pulley", "[510 mm, 450 mm]"),
        ("brake.frame.left_pulley", "[-560 mm, 450 mm]"),
        ("brake.frame.centre_of_gravity", "[\"110 mm\", \"550 mm\"]"),
        ("brake.frame.pulley_radius", "61 mm"),
        ("brake.frame.pulley_diameter", "122 mm"),
        ("brake.ends.wrap", "[90 deg, 50 deg]"),
        ("brake.ends.press_ratio", "0.9"),
        ("brake.cam.turns_per_frame_turn", "9"),
        ("brake.cam.spring_rate", "21 N/mm"),
        ("brake.cam.preload", "1.1 kN"),
        ("limits.tension_spread", "0.04"),
        ("limits.web_stress", "11 MPa"),
    ];

    #[test]
    fn every_key_of_a_brake_reaches_it() {
        let all = catalogue().keys.sections.iter().filter(|section| section.path.starts_with("brake"));
        let all = all.flat_map(|section| section.keys.iter().map(|key| section.path_of(key)));
        let known = OTHERS.iter().map(|(key, _)| (*key).to_owned()).filter(|key| key.starts_with("brake"));
        assert_eq!(all.collect::<Vec<_>>(), known.collect::<Vec<_>>());
        let roll = include_str!("../../profiles/roll.toml");
        let (head, tail) = roll.split_once("[brake.roll]").expect("a roll");
        let (_, tail) = tail.split_once("[follower.roller]").expect("a follower");
        let ends = format!("{head}[brake.ends]\nwrap = [\"90 deg\", \"45 deg\"]\n[follower.roller]{tail}");
        for (key, value) in OTHERS {
            let of_ends = key.starts_with("brake.ends");
            let (text, wanted) = if of_ends { (&*ends, BrakeOutput::Figures) } else { (roll, BrakeOutput::Disc) };
            // A disc holds the tension of a slipping belt, by the exact moments.
            let wanted = if ["brake.mode", "brake.model"].contains(key) { BrakeOutput::Figures } else { wanted };
            let with = |sets: &[String]| {
                let brake =
                    BrakeMachine::of_source(&MachineSource::of_user(catalogue(), "roll.toml", text), sets, wanted)
                        .expect("valid");
                format!("{:?} {:?}", brake.data, brake.limits)
            };
            assert_ne!(with(&[format!("{key}={value}")]), with(&[]), "{key}");
        }
    }

    #[test]
    fn embedded_brakes_read() {
        for embedded in crate::brake::DOMAIN.embedded {
            let load = BrakeMachine::load(catalogue(), embedded.name, &[], BrakeOutput::Figures);
            let (brake, stem) = load.expect("a brake");
            assert_eq!((stem.as_str(), brake.name()), (embedded.name, embedded.title()));
        }
    }

    #[test]
    fn what_is_not_asked_for_is_in_nobody_s_way() {
        let of = |set: &str, wanted| BrakeMachine::load(catalogue(), "roll", &[set.to_owned()], wanted);
        let turning = "brake.cam.turns_per_frame_turn=14";
        assert!(of(turning, BrakeOutput::Figures).is_ok() && of(turning, BrakeOutput::Disc).is_err());
        // A frame is designed for a roll that the file's own does not reach round.
        let large = "brake.roll.largest_radius=700 mm";
        assert!(of(large, BrakeOutput::Frame).is_ok() && of(large, BrakeOutput::Figures).is_err());
    }
}
