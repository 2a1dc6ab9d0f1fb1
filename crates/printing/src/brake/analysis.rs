//! The belt brake of a paper roll: tension over the radius of the roll, compared with the paper's equations, and with the disc that
//! holds it.

mod braking;
mod curves;
mod design;
mod ends;
mod judged;
mod moving;
mod picture;
mod sections;

use super::BRAKE;
use super::tension::TensionAsCut;
use crate::brake::BrakeDisc;
use crate::brake::machine::{Arrangement, BeltMode, BrakeMachine, BrakeModel};
use crate::brake::mechanics::{Brake, BrakeError, FramePose};
use braking::LoadedBrake;
use camgen_cams::analysis::{Analysis, Picture};
use camgen_cams::body::Kind;
use camgen_cams::report::{Section, Speeds};
use camgen_cams::table::{ListedColumn, Table};
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Motion;
use camgen_kernel::refusal::Refusal;
pub use design::FrameGoal;
use design::FrameNeeds;

/// Belt brakes.
pub const KIND: Kind = Kind { command: "brake", noun: "belt brake", keys: BRAKE };

/// Steps of the roll in the table by default, and of the curves on paper.
pub const STEPS: u32 = 110;
const PLACES: u32 = 220;

/// The disc that holds the tension, and the tension with it as cut, where it was drawn.
#[derive(Debug, Clone)]
pub struct TensionDisc<'a> {
    /// The disc by its law.
    pub disc: &'a BrakeDisc,
    /// The tension with its outline as written.
    pub as_cut: Option<&'a TensionAsCut>,
}

/// The options of an analysis of a brake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrakeRequest {
    /// Equal steps of the radius in the table.
    pub steps: u32,
    /// Goal of a frame design; overrides the file.
    pub goal: Option<FrameGoal>,
    /// Seed of the random numbers of the design.
    pub seed: u64,
}

impl Default for BrakeRequest {
    fn default() -> Self {
        Self { steps: STEPS, goal: None, seed: 1 }
    }
}

/// A radius of the roll.
struct RadiusRow {
    pose: FramePose,
    tension: f64,
    printed: f64,
    wanted: f64,
    belt: (f64, f64),
    belt_speed: f64,
    sensitivity: f64,
    /// Cam angle, moment on the frame and lift of the law.
    disc: Option<(f64, f64, f64)>,
}

const COLUMNS: &[ListedColumn<RadiusRow>] = &[
    ("roll_radius_mm", |row| MILLIMETRES * row.pose.radius),
    ("frame_deg", |row| row.pose.theta.to_degrees()),
    ("wrap_deg", |row| row.pose.wrap.to_degrees()),
    ("k", |row| row.pose.k),
    ("weight_arm_mm", |row| MILLIMETRES * row.pose.h1),
    ("press_arm_mm", |row| MILLIMETRES * row.pose.h2),
    ("tight_arm_mm", |row| MILLIMETRES * row.pose.q_tight),
    ("slack_arm_mm", |row| MILLIMETRES * row.pose.q_slack),
    ("tension_n", |row| row.tension),
    ("tension_printed_n", |row| row.printed),
    ("tension_share", |row| row.tension / row.wanted),
    ("belt_slack_n", |row| row.belt.0),
    ("belt_tight_n", |row| row.belt.1),
    ("belt_speed_ratio", |row| row.belt_speed),
    ("friction_sensitivity", |row| row.sensitivity),
];

/// Further columns, with a disc.
const COLUMNS_OF_DISC: &[ListedColumn<RadiusRow>] = &[
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
    let (angle, pose) = (holding.angle_at(radius).ok()?, holding.brake().at(radius).ok()?);
    Some((angle, holding.moment(&pose), disc.jet(0, angle).s + disc.origin().unwrap_or(0.0)))
}

/// A brake, with the disc that holds its tension where there is one.
///
/// ```
/// use camgen::Judged;
/// use camgen::catalogue::catalogue;
/// use camgen::domains::brake::analysis::{self, BrakeRequest};
/// use camgen::domains::brake::{BrakeMachine, BrakeOutput};
///
/// let (machine, _) = BrakeMachine::load(catalogue(), "roll", &[], BrakeOutput::Figures)?;
/// let judged = Judged::new(analysis::analysis(&machine, &BrakeRequest::default(), None)?);
/// assert!(judged.report().section("brake").is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when no frame can be designed.
pub fn analysis(
    machine: &BrakeMachine,
    request: &BrakeRequest,
    held: Option<&TensionDisc<'_>>,
) -> Result<Analysis, Refusal> {
    match (&machine.data.arrangement, request.goal) {
        (Arrangement::Ends(ends), None) => ends::analysis(machine, ends),
        (Arrangement::Frame(brake), None) => of_frame(machine, brake, request, held, None),
        (Arrangement::Ends(_), Some(_)) | (Arrangement::Roll(..), None) => {
            Err(Refusal::new("there is no roll for which --synthesize could design a frame")
                .remedy("give [brake.frame] with its pulley radius, and [brake.roll]"))
        }
        (Arrangement::Frame(brake), Some(goal)) => {
            let pulley_radius = brake.frame().pulley_radius;
            let needs = FrameNeeds { roll: *brake.roll(), rotation: brake.rotation(), pulley_radius };
            of_design(machine, &needs, request, goal)
        }
        (Arrangement::Roll(roll, rotation, pulley), Some(goal)) => {
            let needs = FrameNeeds { roll: *roll, rotation: *rotation, pulley_radius: *pulley };
            of_design(machine, &needs, request, goal)
        }
    }
}

/// A frame that is designed.
fn of_design(
    machine: &BrakeMachine,
    needs: &FrameNeeds,
    request: &BrakeRequest,
    goal: FrameGoal,
) -> Result<Analysis, Refusal> {
    let found = design::designed(needs, machine.data.friction, goal, request.seed)?;
    of_frame(machine, &found.brake, request, None, Some(design::section(&found, goal)))
}

fn of_frame(
    machine: &BrakeMachine,
    brake: &Brake,
    request: &BrakeRequest,
    held: Option<&TensionDisc<'_>>,
    design: Option<Section>,
) -> Result<Analysis, Refusal> {
    let disc = held.map(|held| held.disc);
    let braking = LoadedBrake::new(&machine.data, brake, disc)?;
    let tensions = braking.tensions();
    let rows =
        braking.radii(request.steps).map(|radius| row(&braking, radius)).collect::<Result<Vec<RadiusRow>, _>>()?;
    let columns = if disc.is_some() { [COLUMNS, COLUMNS_OF_DISC].concat() } else { COLUMNS.to_vec() };
    let mut sections = vec![sections::brake(&braking, &tensions), sections::frame(&braking)];
    if machine.data.mode == BeltMode::Slip {
        sections.push(sections::printed(&braking));
    }
    sections.extend(sections::web(&machine.data, Some(brake.roll())));
    sections.extend(held.map(|held| sections::disc(&braking, held)));
    let document = design.is_some().then(|| design::lines(brake).join("\n") + "\n");
    sections.extend(design);
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::Any(()),
        inputs: inputs(machine, request),
        sections,
        measures: judged::measures(machine, &braking, &tensions, held.is_some()),
        notes: notes(machine),
        picture: Picture::Curves(curves::plot(machine.name(), machine.limits.tension_spread, &braking, held)),
        mechanism: Some(moving::mechanism(&braking)),
        document: document.or_else(|| Some(design::lines(brake).join("\n") + "\n")),
        tables: vec![("", Table::listed(&columns, &rows))],
        by: &[],
        along: "roll_radius_mm",
        diagrams: curves::DIAGRAMS,
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

fn row(braking: &LoadedBrake<'_>, radius: f64) -> Result<RadiusRow, BrakeError> {
    let pose = braking.brake.at(radius)?;
    let tension = braking.tension(&pose);
    Ok(RadiusRow {
        pose,
        tension,
        printed: braking.brake.tension_printed(braking.printed_weight, &pose),
        wanted: braking.data.tension,
        belt: braking.belt_tensions(&pose),
        belt_speed: braking::belt_speed(braking.data),
        sensitivity: braking.sensitivity(&pose),
        disc: braking.disc.and_then(|disc| of_disc(disc, radius)),
    })
}

fn inputs(machine: &BrakeMachine, request: &BrakeRequest) -> Vec<Input> {
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs().iter().cloned());
    inputs.push(Input::number("samples", f64::from(request.steps)));
    inputs.extend(request.goal.map(|goal| Input::word("synthesize", format!("{} {}", goal.word(), request.seed))));
    inputs
}

fn notes(machine: &BrakeMachine) -> Vec<String> {
    let data = &machine.data;
    let mut notes = Vec::new();
    if data.mode == BeltMode::Slip && data.model == BrakeModel::Consistent && data.belt_speed_ratio > 0.0 {
        notes.push(format!(
            "belt_speed_ratio = {} changes the power of the belt drive and the heat, not the tension: the friction of a slipping belt \
             does not depend on its speed",
            data.belt_speed_ratio
        ));
    }
    if data.mode == BeltMode::NoSlip && data.belt_speed_ratio > 0.0 {
        notes.push(
            "brake.belt_speed_ratio has no effect without slip: the wanted tension determines the belt's speed".into(),
        );
    }
    notes
}

const NOT_MODELLED: &[&str] = &[
    "Bending stiffness and stretch of the belt, friction in the frame's pivot and the pulleys' bearings.",
    "Friction that changes with speed, pressure or wear: the tension must still be measured (dancer roller).",
    "Motion of the frame while the roll runs down: it is slow.",
];
