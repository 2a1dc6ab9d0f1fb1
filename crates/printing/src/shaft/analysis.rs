//! The shaft under a cam, or alone: critical speeds, deflection, loss of lift by bending and twist, unbalance.

use camgen_kernel::text::{Length, Text, Value, text};
mod along;
mod curves;
mod load;
mod picture;
mod remedy;
mod spectrum;
mod sweep;
#[cfg(test)]
mod tests;
pub mod trade;
mod unbalanced;

use crate::press::MachineOfPress;
use crate::shaft::checks::{CRITICAL_SPEED, LIFT_ERROR, SUPPORT_SLOPE};
use crate::shaft::machine::ShaftMachine;
use crate::shaft::mechanics::exact::Statics;
use crate::shaft::mechanics::{Beam, Shaft, Whirl};
use camgen_cams::analysis::{Analysis, Picture};
use camgen_cams::body::Kind;
use camgen_cams::body::{LoadedFollower, ShaftCompliance};
use camgen_cams::check::Measure;
use camgen_cams::report::{Fact, Section, Speeds, Topic, shown};
use camgen_cams::table::Table;
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::refusal::Refusal;
use load::{CamOnShaft, CamUnderLoad};
use serde::Serialize;
use spectrum::CriticalSpeeds;
use std::f64::consts::PI;
use unbalanced::UnbalanceFigures;

/// A shaft and what is on it.
pub const KIND: Kind = Kind { command: "shaft", noun: "shaft", keys: super::SHAFT };

/// Most modes that are reported: their columns have names of their own.
pub const MOST_MODES: usize = 12;

/// How critical speeds are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CriticalSpeedSolver {
    /// Birger's equation as an eigenproblem of forces, with this order of the load polynomials, or as many as it takes.
    Exact {
        /// The order.
        order: Option<usize>,
    },
    /// The paper's iteration, with this number of stations.
    Paper {
        /// Number of stations.
        stations: usize,
    },
}

/// Options of the analysis of a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaftOptions {
    /// Speeds of the main shaft, or the one of a shaft without a press, rpm; several are the sections of a conoid.
    pub rpm: Vec<f64>,
    /// How many critical speeds, 1 to [`MOST_MODES`]; `None`: three, or as many as there are.
    pub modes: Option<usize>,
    /// How the shaft whirls.
    pub whirl: Whirl,
    /// How they are found.
    pub solver: CriticalSpeedSolver,
    /// Stiffnesses that every elastic support gets in turn, N/m, the first and the last.
    pub sweep: Option<(f64, f64)>,
    /// Equal steps from the one to the other.
    pub steps: u32,
    /// Places along the shaft, and over a turn of the cam.
    pub samples: u32,
}

impl Default for ShaftOptions {
    fn default() -> Self {
        Self {
            rpm: Vec::new(),
            modes: None,
            whirl: Whirl::Forward,
            solver: CriticalSpeedSolver::Exact { order: None },
            sweep: None,
            steps: 10,
            samples: 360,
        }
    }
}

/// The section `shaft`.
#[derive(Debug, Serialize)]
struct ShaftFigures {
    mass_kg: f64,
    speed_rpm: Option<f64>,
    critical_rpm: Vec<f64>,
    whirl: &'static str,
    beam: &'static str,
    solver: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact_rpm: Option<f64>,
    compliance_um_per_kn: Option<f64>,
    twist_compliance_urad_per_nm: Option<f64>,
    lift_error_max_mm: Option<f64>,
    lift_error_cam_deg: Option<f64>,
    bending_mm: Option<f64>,
    twist_mm: Option<f64>,
    residual_max_n: Option<f64>,
    residual_cam_deg: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    sections: Vec<load::SectionLiftError>,
    #[serde(skip_serializing_if = "Option::is_none")]
    without_compensation: Option<RigidShaftFigures>,
    unbalance_g_mm: f64,
    unbalance_deg: f64,
    permissible_g_mm: Option<f64>,
    planes: Vec<unbalanced::Plane>,
    support_force_n: Vec<f64>,
    support_slope_rad: Option<f64>,
    first_harmonic: Option<f64>,
}

/// Figures of a cam that is made for a rigid shaft on this shaft.
#[derive(Debug, Serialize)]
struct RigidShaftFigures {
    lift_error_max_mm: f64,
    residual_max_n: Option<f64>,
}

/// All that was found, in SI units.
struct ShaftResults<'a> {
    machine: &'a ShaftMachine,
    asked: &'a ShaftOptions,
    /// The shaft with the cam as a disc on it.
    shaft: Shaft,
    /// The cam under its forces, where the shaft carries one.
    carried: Option<CamOnShaft>,
    /// Angular speed, rad/s.
    speed: Option<f64>,
    spectrum: CriticalSpeeds,
    statics: Option<Statics>,
    under: Option<CamUnderLoad>,
    /// A cam that is made for a rigid shaft under its forces, where this one is cut for its own.
    rigid: Option<CamUnderLoad>,
    unbalanced: UnbalanceFigures,
}

/// Revolutions per minute of an angular speed.
fn rpm(speed: f64) -> f64 {
    30.0 / PI * speed
}

fn word_of_beam(beam: Beam) -> &'static str {
    match beam {
        Beam::Timoshenko => "timoshenko",
        Beam::Euler => "euler",
    }
}

/// A shaft, with its cam where it carries one.
///
/// ```
/// use camgen::Judged;
/// use camgen::domains::shaft::ShaftMachine;
/// use camgen::domains::shaft::analysis::{self, ShaftOptions};
///
/// let (machine, _) = ShaftMachine::load("press-cylinder", &[])?;
/// let judged = Judged::new(analysis::analysis(&machine, &ShaftOptions::default())?);
/// assert!(judged.report().section("shaft").is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when there is no such cam, mode or shaft.
pub fn analysis(machine: &ShaftMachine, asked: &ShaftOptions) -> Result<Analysis, Refusal> {
    let carried = CamOnShaft::solve(machine, &asked.rpm)?;
    if carried.is_none() && asked.rpm.len() > 1 {
        return Err(Refusal::new(
            "several speeds are the sections of a conoid, and this file describes no press, or no [conoid]",
        )
        .remedy("give one --rpm"));
    }
    let own = machine.data.shaft.discs().to_vec();
    let shaft = machine.data.shaft.with_discs(carried.as_ref().map_or(own, |carried| discs(machine, carried)))?;
    let own = asked.rpm.first().map(|rpm| rpm * PI / 30.0);
    let speed = carried.as_ref().map_or(own, |carried| carried.speed);
    let spectrum = CriticalSpeeds::find(&shaft, asked)?;
    let statics = machine.data.cam_at.map(|at| Statics::new(&shaft, at)).transpose()?;
    let under = carried
        .as_ref()
        .zip(statics.as_ref())
        .and_then(|(carried, statics)| CamUnderLoad::new(carried, statics, &machine.data));
    let rigid = match machine.with_rigid_cam() {
        Some(rigid) if carried.as_ref().is_some_and(|carried| !carried.is_conoid()) => {
            let rigid = CamOnShaft::solve(&rigid, &asked.rpm)?;
            let mounted = rigid.as_ref().zip(statics.as_ref());
            mounted.and_then(|(rigid, statics)| CamUnderLoad::new(rigid, statics, &machine.data))
        }
        _ => None,
    };
    let unbalanced = UnbalanceFigures::new(&shaft, speed, machine.limits.balance_grade)?;
    let found = ShaftResults { machine, asked, shaft, carried, speed, spectrum, statics, under, rigid, unbalanced };
    let sweep = asked.sweep.map(|(from, to)| sweep::rows(&found, from, to)).transpose()?;
    let shaft_figures = figures(&found);
    let mut tables = vec![("", along::table(&found))];
    tables.extend(sweep.as_ref().map(|rows| ("-sweep", sweep::table(rows, found.spectrum.speeds.len()))));
    tables.extend(found.under.as_ref().map(|under| ("-lift", under.table(asked.samples))));
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: speed_of(&found),
        inputs: inputs(machine, asked),
        sections: vec![summarised(&found, &shaft_figures)],
        measures: measures(&found)?,
        notes: notes(&found),
        picture: Picture::Curves(curves::plot(&found, sweep.as_deref())),
        mechanism: None,
        document: None,
        tables,
        by: if found.under.as_ref().is_some_and(CamUnderLoad::has_sections) { &["rpm"] } else { &[] },
        along: match (&found.under, asked.sweep) {
            (Some(_), _) => "cam_deg",
            (None, Some(_)) => "stiffness_n_per_m",
            (None, None) => "x_mm",
        },
        diagrams: &[],
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

/// The discs on a shaft, and the cam as the last of them.
fn discs(machine: &ShaftMachine, carried: &CamOnShaft) -> Vec<crate::shaft::mechanics::ShaftDisc> {
    machine.data.shaft.discs().iter().copied().chain(carried.disc).collect()
}

const NOT_MODELLED: &[&str] = &[
    "Damping, keyways, axial load, and bearings that are stiffer in one direction; the stiffness of a support is that of bearing and housing.",
    "Spin other than at the speed of the whirl.",
    "The stiffness that the hub of a cam or a disc adds to the shaft.",
];

/// A cam of a press is reported for the speed of its main shaft.
fn speed_of(found: &ShaftResults<'_>) -> Speeds {
    let own = found.carried.as_ref().map_or(&found.asked.rpm, |carried| &carried.rpm);
    match own.as_slice() {
        [] => Speeds::Any(()),
        [rpm] => Speeds::One(*rpm),
        several => Speeds::Several(several.to_vec()),
    }
}

fn inputs(machine: &ShaftMachine, asked: &ShaftOptions) -> Vec<Input> {
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs().iter().cloned());
    if !asked.rpm.is_empty() {
        inputs.push(Input::numbers("rpm", &asked.rpm));
    }
    inputs.push(Input::word("asked", format!("{:?} {:?} {:?}", asked.whirl, asked.solver, asked.modes)));
    inputs.extend(asked.sweep.map(|(from, to)| Input::numbers("sweep", &[from, to, f64::from(asked.steps)])));
    inputs.push(Input::number("samples", f64::from(asked.samples)));
    inputs
}

fn figures(found: &ShaftResults<'_>) -> ShaftFigures {
    let worst = found.under.as_ref();
    let first = found.spectrum.forward;
    ShaftFigures {
        mass_kg: found.shaft.mass(),
        speed_rpm: found.speed.map(rpm),
        critical_rpm: found.spectrum.speeds.iter().copied().map(rpm).collect(),
        whirl: found.asked.whirl.word(),
        beam: match found.asked.solver {
            CriticalSpeedSolver::Exact { .. } => word_of_beam(found.shaft.beam()),
            CriticalSpeedSolver::Paper { .. } => word_of_beam(Beam::Euler),
        },
        solver: match found.asked.solver {
            CriticalSpeedSolver::Exact { .. } => "exact",
            CriticalSpeedSolver::Paper { .. } => "paper",
        },
        exact_rpm: matches!(found.asked.solver, CriticalSpeedSolver::Paper { .. }).then(|| rpm(found.spectrum.forward)),
        compliance_um_per_kn: found.statics.as_ref().map(|statics| 1e9 * statics.own_compliance()),
        twist_compliance_urad_per_nm: found.machine.data.drive_to_cam().map(|twist| 1e6 * twist),
        lift_error_max_mm: worst.map(|under| 1e3 * under.largest.value),
        lift_error_cam_deg: worst.map(|under| under.largest.at.to_degrees()),
        bending_mm: worst.map(|under| 1e3 * under.there.bending),
        twist_mm: worst.filter(|under| under.shaft_twist.is_some()).map(|under| 1e3 * under.there.twist),
        residual_max_n: worst.and_then(|under| under.residual).map(|worst| worst.value),
        residual_cam_deg: worst.and_then(|under| under.residual).map(|worst| worst.at.to_degrees()),
        sections: worst.map_or_else(Vec::new, CamUnderLoad::lift_errors),
        without_compensation: found.rigid.as_ref().map(|rigid| RigidShaftFigures {
            lift_error_max_mm: 1e3 * rigid.largest.value,
            residual_max_n: rigid.residual.map(|worst| worst.value),
        }),
        unbalance_g_mm: found.unbalanced.g_mm,
        unbalance_deg: found.unbalanced.deg,
        permissible_g_mm: found.unbalanced.permissible_g_mm,
        planes: found.unbalanced.planes.clone(),
        support_force_n: worst.map_or_else(Vec::new, |under| under.reactions.clone()),
        support_slope_rad: worst.map(|under| under.slope),
        first_harmonic: found.speed.filter(|speed| *speed > 0.0).map(|speed| (first / speed).ceil()),
    }
}

/// The section with what a summary says of it.
fn summarised(found: &ShaftResults<'_>, shaft_figures: &ShaftFigures) -> Section {
    const NAMED: usize = 3;
    let whirl = if shaft_figures.exact_rpm.is_some() { "planar" } else { shaft_figures.whirl };
    let first = shaft_figures.critical_rpm.first().copied().unwrap_or(f64::NAN);
    let speeds = shaft_figures.critical_rpm.iter().take(NAMED).map(|rpm| Text::from(Value::brief_number(*rpm)));
    let critical = text!("{} rpm, {} whirl", Text::joined(speeds, ", "), whirl);
    let compliance = shaft_figures.compliance_um_per_kn.map(|value| {
        let place = if found.carried.is_some() { "under the cam" } else { "at shaft.cam_at" };
        Fact::new(Topic::new(50, "compliance"), text!("{} {}", Value::brief(value, "µm/kN"), place))
    });
    let mass = Fact::new(Topic::SIZE, text!("{} with all that is on it", Value::brief(shaft_figures.mass_kg, "kg")));
    let low = found.under.as_ref().map(|under| {
        let under = Text::joined(under.describe(), "; ");
        Fact::new(Topic::new(60, "under load"), under)
    });
    let facts = [Some(mass), Some(Fact::new(Topic::new(30, "critical"), critical)), compliance, low];
    let section = Section::new(KIND.command, shaft_figures).with_words(describe(found, shaft_figures));
    let section = section.with_facts(facts.into_iter().flatten());
    // With a speed the checks say how far it is from the first critical one.
    if found.speed.is_some() {
        section
    } else {
        section.with_answer(text!("first critical speed {} rpm", Value::brief_number(first)))
    }
}

fn describe(found: &ShaftResults<'_>, shaft_figures: &ShaftFigures) -> Vec<Text> {
    let speeds: Vec<String> = shaft_figures.critical_rpm.iter().map(|rpm| shown(*rpm)).collect();
    let order = found.spectrum.order.map_or(String::new(), |order| format!(", order {order}"));
    let whirl = if shaft_figures.exact_rpm.is_some() { "planar" } else { shaft_figures.whirl };
    let mut lines = vec![
        text!("mass {} kg with all that is on it", format_args!("{:.3}", shaft_figures.mass_kg)),
        text!(
            "critical at {} rpm, {} whirl, {} beam, solver {}{}",
            speeds.join(", "),
            whirl,
            shaft_figures.beam,
            shaft_figures.solver,
            order
        ),
    ];
    if let Some(exact) = shaft_figures.exact_rpm {
        let error = 100.0 * (shaft_figures.critical_rpm.first().copied().unwrap_or(f64::NAN) / exact - 1.0);
        lines.push(format!(
            "the paper's method leaves out shear, rotary inertia, gyroscopic moments and the inertia of discs about a diameter, \
             whatever the file says; the exact method finds {} rpm, {error:+.3} %",
            shown(exact)
        ).into());
    }
    if let Some(compliance) = shaft_figures.compliance_um_per_kn {
        let place = if found.carried.is_some() { "the cam" } else { "shaft.cam_at" };
        lines.push(format!("compliance at {place} {compliance:.4} µm/kN").into());
    }
    if let Some(under) = &found.under {
        lines.extend(under.describe());
    }
    if let Some(rigid) = &found.rigid {
        let left = rigid.residual.map(|worst| text!(", and {} N would be left", format_args!("{:.2}", worst.value)));
        lines.push(text!(
            "the cam is cut for this shaft (shaft.compensate): a cam for a rigid shaft would leave the follower {} low{}",
            Length::mm(1e3 * rigid.largest.value).decimals(5),
            left
        ));
    }
    if shaft_figures.unbalance_g_mm > 0.0 {
        lines.push(found.unbalanced.describe().into());
    }
    lines
}

fn notes(found: &ShaftResults<'_>) -> Vec<String> {
    let mut notes: Vec<String> = found.spectrum.fewer.iter().cloned().collect();
    let carried = found.carried.as_ref();
    if carried.is_some() && found.machine.data.drive_at.is_none() {
        notes.push("twist is not modelled: shaft.drive_at, the place where the torque enters, is not given".to_owned());
    }
    if carried.is_some_and(|carried| carried.disc.is_none()) {
        let why = if found.carried.as_ref().is_some_and(CamOnShaft::is_conoid) {
            "the mass of a conoid is not modelled"
        } else {
            "cam.thickness is not given"
        };
        notes.push(format!("the cam is on the shaft without its mass: {why}"));
    }
    if found.machine.machine().is_some_and(|machine| machine.compensator().is_some()) {
        notes.push(
            "the compensating cam is not on this shaft: its mass and its torque are not taken into account".to_owned(),
        );
    }
    let limits = &found.machine.limits;
    if found.under.is_none() && (limits.lift_error.is_some() || limits.support_slope.is_some()) {
        notes.push("limits.lift_error and limits.support_slope have no effect: no force of a cam is known".to_owned());
    }
    if found.speed.is_none() {
        notes.push("limits.critical_speed_ratio has no effect: no speed is known (--rpm)".to_owned());
    }
    if carried.is_some() && found.under.is_none() {
        notes.push("no lift error: without a press or a preload the force on the follower is not known".to_owned());
    }
    notes
}

fn measures(found: &ShaftResults<'_>) -> Result<Vec<Measure>, Refusal> {
    let limits = &found.machine.limits;
    let mut all = Vec::new();
    if let Some(speed) = found.speed {
        // Unbalance whirls with the shaft, whatever whirl is requested.
        let first = found.spectrum.forward;
        let ratio = speed / first;
        let harmonic = (first / speed).ceil();
        let mut note =
            text!("first critical speed {} rpm, reached by harmonic {} of a turn", shown(rpm(first)), harmonic);
        if ratio > limits.critical_speed_ratio {
            let factor = remedy::for_speed(found, speed / limits.critical_speed_ratio);
            let slower = remedy::slower(found).map(|slower| text!("--rpm {} would pass", slower));
            note = note.and("; ", slower).and("; ", thicker(factor));
        }
        let limit = Some(limits.critical_speed_ratio);
        all.push(CRITICAL_SPEED.measure(ratio, limit).noted(note));
    }
    if let Some(under) = &found.under {
        let exceeds = limits.lift_error.is_some_and(|limit| under.largest.value > limit);
        let factor = limits.lift_error.filter(|_| exceeds).map(|limit| remedy::for_lift(found, limit));
        let place = format!("at a cam angle of {:.3}°", under.largest.at.to_degrees());
        let note = Text::from(place).and("; ", factor.map(thicker));
        let (value, limit) = (1e3 * under.largest.value, limits.lift_error.map(|limit| 1e3 * limit));
        all.push(LIFT_ERROR.measure(value, limit).noted(note));
        let exceeds = limits.support_slope.is_some_and(|limit| under.slope > limit);
        let factor = limits.support_slope.filter(|_| exceeds).map(|limit| remedy::for_slope(found, limit));
        let note = factor.map(thicker);
        all.push(SUPPORT_SLOPE.measure(under.slope, limits.support_slope).noted(note));
    }
    all.push(found.unbalanced.measure());
    Ok(all)
}

/// The factor that would pass, in words.
fn thicker(factor: Option<f64>) -> Text {
    match factor {
        Some(factor) => text!("every diameter times {} would pass", format_args!("{factor:.3}")),
        None => "no thicker shaft on these supports would pass: they are too soft".into(),
    }
}

/// The cam on a shaft of the machine's, thicker by a factor.
fn yielding(found: &ShaftResults<'_>, factor: f64) -> Option<(ShaftCompliance, Statics)> {
    let at = found.machine.data.cam_at?;
    let shaft = found.shaft.scaled(factor).ok()?;
    let statics = Statics::new(&shaft, at).ok()?;
    let twist = found.machine.data.drive_at.map_or(0.0, |drive| shaft.twist_compliance(drive, at));
    Some((ShaftCompliance { compliance: statics.own_compliance(), twist }, statics))
}

/// The figures of a loaded follower, of which the largest are searched.
fn error_of(lowered: &LoadedFollower) -> f64 {
    lowered.error().abs()
}

/// A table whose columns are named by the list, as many as there are.
fn named(mut columns: Vec<&'static str>, more: &[&'static str], rows: Vec<Vec<f64>>) -> Table {
    columns.extend(more);
    let may_lack = vec![true; columns.len()];
    Table { columns, rows, may_lack, words: None, more_words: Vec::new() }
}
