//! The belt brake of a paper roll: tension over the radius of the roll, with the paper's equations beside it, and with the disc that
//! holds it.

mod braking;
mod curves;
mod design;
mod ends;
mod judged;
mod moving;
mod picture;
#[cfg(test)]
mod tests;
mod told;

use super::{Analysis, Measure};
use crate::body::Kind;
use crate::brake::{Brake, BrakeError, Roll, Rotation, Stand};
use crate::document::{Input, cams};
use crate::geometry::MILLIMETRES;
use crate::machine::{Arrangement, BeltMode, BrakeMachine, BrakeModel};
use crate::motion::{BrakeDisc, Motion};
use crate::report::{Section, Speeds, TensionAsCut};
use crate::table::{Table, Told};
use braking::Braking;
pub use design::Goal;

/// Belt brakes.
pub const KIND: Kind = Kind { command: "brake", noun: "belt brake", keys: cams::BRAKE };

/// The check of the tension over the roll.
pub const TENSION: &str = "tension";
/// Of the friction at which the brake jams.
pub const SELF_LOCKING: &str = "self_locking";
/// Of the belt's speed by the printed equations.
pub const BELT_RANGE: &str = "belt_range";
/// Of a belt that does not slip.
pub const GRIP: &str = "grip";
/// Of the web.
pub const WEB_STRESS: &str = "web_stress";
/// Of the radii that the frame follows.
pub const FRAME_REACH: &str = "frame_reach";

/// Steps of the roll in the table by default, and of the curves on paper.
pub const STEPS: u32 = 110;
const PLACES: u32 = 220;

/// Why there is no such analysis.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BrakeAnalysisError {
    /// Of the frame.
    #[error(transparent)]
    Brake(#[from] BrakeError),
    /// There is no roll whose frame could be designed.
    #[error("--synthesize designs a frame: give [brake.frame] with its pulley radius, and [brake.roll]")]
    NoFrame,
}

/// The disc that holds the tension, and what it does as cut, where it was drawn.
#[derive(Debug, Clone)]
pub struct Held<'a> {
    /// By its law.
    pub disc: &'a BrakeDisc,
    /// On its outline as written.
    pub as_cut: Option<&'a TensionAsCut>,
}

/// What is asked of a brake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Equal steps of the radius in the table.
    pub steps: u32,
    /// A frame to be designed in place of the file's.
    pub goal: Option<Goal>,
    /// Of the random numbers of the design.
    pub seed: u64,
}

impl Default for Asked {
    fn default() -> Self {
        Self { steps: STEPS, goal: None, seed: 1 }
    }
}

/// A radius of the roll.
struct Row {
    stand: Stand,
    tension: f64,
    printed: f64,
    wanted: f64,
    belt: (f64, f64),
    belt_speed: f64,
    sensitivity: f64,
    /// Cam angle, moment on the frame and lift of the law.
    disc: Option<(f64, f64, f64)>,
}

const TOLD: &[Told<Row>] = &[
    ("roll_radius_mm", |row| MILLIMETRES * row.stand.radius),
    ("frame_deg", |row| row.stand.theta.to_degrees()),
    ("wrap_deg", |row| row.stand.wrap.to_degrees()),
    ("k", |row| row.stand.k),
    ("weight_arm_mm", |row| MILLIMETRES * row.stand.h1),
    ("press_arm_mm", |row| MILLIMETRES * row.stand.h2),
    ("tight_arm_mm", |row| MILLIMETRES * row.stand.q_tight),
    ("slack_arm_mm", |row| MILLIMETRES * row.stand.q_slack),
    ("tension_n", |row| row.tension),
    ("tension_printed_n", |row| row.printed),
    ("tension_share", |row| row.tension / row.wanted),
    ("belt_slack_n", |row| row.belt.0),
    ("belt_tight_n", |row| row.belt.1),
    ("belt_speed_ratio", |row| row.belt_speed),
    ("friction_sensitivity", |row| row.sensitivity),
];

/// Behind them, with a disc.
const TOLD_OF_DISC: &[Told<Row>] = &[
    ("cam_deg", |row| row.disc.map_or(f64::NAN, |(angle, ..)| angle.to_degrees())),
    ("cam_moment_nm", |row| row.disc.map_or(f64::NAN, |(_, moment, _)| moment)),
    ("lift_mm", |row| row.disc.map_or(f64::NAN, |(.., lift)| MILLIMETRES * lift)),
];

/// (largest − least)/largest.
fn spread(least: f64, largest: f64) -> f64 {
    (largest - least) / largest
}

/// Cam angle (rad), moment on the frame (N·m) and lift of the law (m) at a radius, m.
fn of_disc(disc: &BrakeDisc, radius: f64) -> Option<(f64, f64, f64)> {
    let holding = disc.holding();
    let (angle, stand) = (holding.angle_at(radius).ok()?, holding.brake().at(radius).ok()?);
    Some((angle, holding.moment(&stand), disc.jet(0, angle).s + disc.origin().unwrap_or(0.0)))
}

/// A brake, with the disc that holds its tension where there is one.
///
/// # Errors
/// [`BrakeAnalysisError`] when no frame can be designed.
pub fn analysis(
    machine: &BrakeMachine,
    asked: &Asked,
    held: Option<&Held<'_>>,
) -> Result<Analysis, BrakeAnalysisError> {
    match (&machine.data.arrangement, asked.goal) {
        (Arrangement::Ends(ends), None) => Ok(ends::analysis(machine, ends)?),
        (Arrangement::Frame(brake), None) => of_frame(machine, brake, asked, held, None),
        (Arrangement::Ends(_), Some(_)) | (Arrangement::Roll(..), None) => Err(BrakeAnalysisError::NoFrame),
        (Arrangement::Frame(brake), Some(goal)) => {
            let of = (*brake.roll(), brake.rotation(), brake.frame().pulley_radius);
            of_design(machine, of, asked, goal)
        }
        (Arrangement::Roll(roll, rotation, pulley), Some(goal)) => {
            of_design(machine, (*roll, *rotation, *pulley), asked, goal)
        }
    }
}

/// A frame designed for a roll, its sense and pulleys of a radius, m.
fn of_design(
    machine: &BrakeMachine,
    of: (Roll, Rotation, f64),
    asked: &Asked,
    goal: Goal,
) -> Result<Analysis, BrakeAnalysisError> {
    let found = design::found(of, machine.data.friction, goal, asked.seed)?;
    of_frame(machine, &found.brake, asked, None, Some(design::section(&found, goal)))
}

fn of_frame(
    machine: &BrakeMachine,
    brake: &Brake,
    asked: &Asked,
    held: Option<&Held<'_>>,
    design: Option<Section>,
) -> Result<Analysis, BrakeAnalysisError> {
    let disc = held.map(|held| held.disc);
    let braking = Braking::new(&machine.data, brake, disc)?;
    let tensions = braking.tensions();
    let rows = braking.radii(asked.steps).map(|radius| row(&braking, radius)).collect::<Result<Vec<Row>, _>>()?;
    let columns = if disc.is_some() { [TOLD, TOLD_OF_DISC].concat() } else { TOLD.to_vec() };
    let mut sections = vec![told::brake(&braking, tensions), told::frame(&braking)];
    if machine.data.mode == BeltMode::Slip {
        sections.push(told::printed(&braking));
    }
    sections.extend(told::web(&machine.data, Some(brake.roll())));
    sections.extend(held.map(|held| told::disc(&braking, held)));
    let document = design.is_some().then(|| design::lines(brake).join("\n") + "\n");
    sections.extend(design);
    Ok(Analysis {
        kind: &KIND,
        machine: machine.name().to_owned(),
        speeds: Speeds::Any(()),
        inputs: inputs(machine, asked),
        sections,
        measures: judged::measures(machine, &braking, (tensions, held.is_some())),
        notes: notes(machine),
        plot: curves::plot(machine.name(), &braking, held),
        mechanism: Some(moving::mechanism(&braking)),
        document: document.or_else(|| Some(design::lines(brake).join("\n") + "\n")),
        tables: vec![("", Table::listed(&columns, &rows))],
        by: &[],
        along: "roll_radius_mm",
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

fn row(braking: &Braking<'_>, radius: f64) -> Result<Row, BrakeError> {
    let stand = braking.brake.at(radius)?;
    let tension = braking.tension(&stand);
    Ok(Row {
        stand,
        tension,
        printed: braking.brake.tension_printed(braking.printed_weight, &stand),
        wanted: braking.data.tension,
        belt: braking.belt_tensions(&stand),
        belt_speed: braking::belt_speed(braking.data),
        sensitivity: braking.sensitivity(&stand),
        disc: braking.disc.and_then(|disc| of_disc(disc, radius)),
    })
}

fn inputs(machine: &BrakeMachine, asked: &Asked) -> Vec<Input> {
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs().iter().cloned());
    inputs.push(Input::number("samples", f64::from(asked.steps)));
    inputs.extend(asked.goal.map(|goal| Input::word("synthesize", format!("{} {}", goal.word(), asked.seed))));
    inputs
}

fn notes(machine: &BrakeMachine) -> Vec<String> {
    let data = &machine.data;
    let mut notes = Vec::new();
    if data.mode == BeltMode::Slip && data.model == BrakeModel::Consistent && data.belt_speed_ratio > 0.0 {
        notes.push(format!(
            "belt_speed_ratio = {} changes what the belt's drive takes and what becomes heat, not the tension: a slipping belt's friction \
             does not depend on its speed",
            data.belt_speed_ratio
        ));
    }
    if data.mode == BeltMode::NoSlip && data.belt_speed_ratio > 0.0 {
        notes.push(
            "brake.belt_speed_ratio has no effect without slip: the wanted tension tells the belt's speed".into(),
        );
    }
    notes
}

const NOT_MODELLED: &[&str] = &[
    "Bending stiffness and stretch of the belt, friction in the frame's pivot and the pulleys' bearings.",
    "Friction that changes with speed, pressure or wear: a measured tension (dancer) stays necessary.",
    "Motion of the frame while the roll runs down: it is slow.",
];
