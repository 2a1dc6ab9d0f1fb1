//! The shaft under a cam, or alone: critical speeds, deflection, what bending and twist take off the lift, unbalance.

mod along;
mod curves;
mod load;
mod picture;
mod remedy;
mod spectrum;
mod sweep;
#[cfg(test)]
mod tests;
mod unbalanced;

use super::{Analysis, Measure};
use crate::body::Kind;
use crate::body::{Lowered, Yielding};
use crate::document::{Input, cams};
use crate::machine::ShaftMachine;
use crate::report::{Section, Speeds, shown};
use crate::shaft::exact::Statics;
use crate::shaft::{Beam, Shaft, ShaftError, Whirl};
use crate::table::Table;
use load::{Carried, Under};
use serde::Serialize;
use spectrum::Spectrum;
use std::f64::consts::PI;
use unbalanced::Unbalanced;

/// A shaft and what is on it.
pub const KIND: Kind = Kind { command: "shaft", noun: "shaft", keys: cams::SHAFT };

/// The checks of a shaft.
pub const CRITICAL_SPEED: &str = "critical_speed";
/// Of the lift under load.
pub const LIFT_ERROR: &str = "lift_error";
/// Of the bearings.
pub const SUPPORT_SLOPE: &str = "support_slope";
/// Of what turns.
pub const UNBALANCE: &str = "unbalance";

/// Most modes that are told: their columns have names of their own.
pub const MOST_MODES: usize = 12;

/// How critical speeds are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solver {
    /// Birger's equation as an eigenproblem of forces, with this order of the load polynomials, or as many as it takes.
    Exact {
        /// The order.
        order: Option<usize>,
    },
    /// The paper's iteration, with so many stations.
    Paper {
        /// Number of stations.
        stations: usize,
    },
}

/// What is asked of a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// Speeds of the main shaft, or the one of the shaft itself where it stands alone, rpm; several are the sections of a conoid.
    pub rpm: Vec<f64>,
    /// How many critical speeds, 1 to [`MOST_MODES`]; `None`: three, or as many as there are.
    pub modes: Option<usize>,
    /// How the shaft whirls.
    pub whirl: Whirl,
    /// How they are found.
    pub solver: Solver,
    /// Stiffnesses that every elastic support gets in turn, N/m, the first and the last.
    pub sweep: Option<(f64, f64)>,
    /// Equal steps from the one to the other.
    pub steps: u32,
    /// Places along the shaft, and over a turn of the cam.
    pub samples: u32,
}

impl Default for Asked {
    fn default() -> Self {
        Self {
            rpm: Vec::new(),
            modes: None,
            whirl: Whirl::Forward,
            solver: Solver::Exact { order: None },
            sweep: None,
            steps: 10,
            samples: 360,
        }
    }
}

/// Why there is no such analysis.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShaftAnalysisError {
    /// Of the shaft.
    #[error(transparent)]
    Shaft(#[from] ShaftError),
    /// Of the cam on it.
    #[error("the cam on the shaft: {0}")]
    Cam(String),
    /// The paper finds one critical speed.
    #[error("--solver paper finds the first critical speed only: leave out --modes, or use --solver exact")]
    OneMode,
    /// A shaft alone turns at one speed.
    #[error("several speeds are the sections of a conoid: this file describes no press, or no [conoid]")]
    OneSpeed,
    /// At one of its stiffnesses.
    #[error("with supports of {stiffness:e} N/m: {why}")]
    Swept {
        /// N/m.
        stiffness: f64,
        /// Why not.
        why: String,
    },
    /// There is nothing to sweep.
    #[error("--sweep gives elastic supports their stiffness, and every support of this shaft is rigid")]
    NoElasticSupport,
}

/// The section `shaft`.
#[derive(Debug, Serialize)]
struct Figures {
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
    sections: Vec<load::Section>,
    #[serde(skip_serializing_if = "Option::is_none")]
    without_compensation: Option<Without>,
    unbalance_g_mm: f64,
    unbalance_deg: f64,
    permissible_g_mm: Option<f64>,
    planes: Vec<unbalanced::Plane>,
    support_force_n: Vec<f64>,
    support_slope_rad: Option<f64>,
    first_harmonic: Option<f64>,
}

/// What a cam that is made for a rigid shaft would do on this one.
#[derive(Debug, Serialize)]
struct Without {
    lift_error_max_mm: f64,
    residual_max_n: Option<f64>,
}

/// All that was found, in SI units.
struct Found<'a> {
    machine: &'a ShaftMachine,
    asked: &'a Asked,
    /// The shaft with the cam as a disc on it.
    shaft: Shaft,
    /// The cam under its forces, where the shaft carries one.
    carried: Option<Carried>,
    /// Angular speed, rad/s.
    speed: Option<f64>,
    spectrum: Spectrum,
    statics: Option<Statics>,
    under: Option<Under>,
    /// The same of a cam that is made for a rigid shaft, where this one is cut for its own.
    rigid: Option<Under>,
    unbalanced: Unbalanced,
}

/// Revolutions per minute of an angular speed.
fn rpm(speed: f64) -> f64 {
    30.0 / PI * speed
}

fn word_of(whirl: Whirl) -> &'static str {
    match whirl {
        Whirl::Planar => "planar",
        Whirl::Forward => "forward",
        Whirl::Backward => "backward",
    }
}

fn word_of_beam(beam: Beam) -> &'static str {
    match beam {
        Beam::Timoshenko => "timoshenko",
        Beam::Euler => "euler",
    }
}

/// A shaft, with its cam where it carries one.
///
/// # Errors
/// [`ShaftAnalysisError`] when there is no such cam, mode or shaft.
pub fn analysis(machine: &ShaftMachine, asked: &Asked) -> Result<Analysis, ShaftAnalysisError> {
    let carried = Carried::of(machine, &asked.rpm)?;
    if carried.is_none() && asked.rpm.len() > 1 {
        return Err(ShaftAnalysisError::OneSpeed);
    }
    let own = machine.data.shaft.discs().to_vec();
    let shaft = machine.data.shaft.with_discs(carried.as_ref().map_or(own, |carried| discs(machine, carried)))?;
    let own = asked.rpm.first().map(|rpm| rpm * PI / 30.0);
    let speed = carried.as_ref().map_or(own, |carried| carried.speed);
    let spectrum = Spectrum::of(&shaft, asked)?;
    let statics = machine.data.cam_at.map(|at| Statics::new(&shaft, at)).transpose()?;
    let under = carried.as_ref().zip(statics.as_ref()).and_then(|(carried, statics)| {
        Under::of(carried, statics, machine.data.drive_at.zip(machine.data.cam_at), &machine.data.shaft)
    });
    let rigid = match machine.with_rigid_cam() {
        Some(rigid) if carried.as_ref().is_some_and(|carried| !carried.is_conoid()) => {
            let rigid = Carried::of(&rigid, &asked.rpm)?;
            rigid.as_ref().zip(statics.as_ref()).and_then(|(rigid, statics)| {
                Under::of(rigid, statics, machine.data.drive_at.zip(machine.data.cam_at), &machine.data.shaft)
            })
        }
        _ => None,
    };
    let unbalanced = Unbalanced::of(&shaft, speed, machine.limits.balance_grade)?;
    let found = Found { machine, asked, shaft, carried, speed, spectrum, statics, under, rigid, unbalanced };
    let sweep = asked.sweep.map(|range| sweep::rows(&found, range)).transpose()?;
    let told = figures(&found);
    let mut tables = vec![("", along::table(&found))];
    tables.extend(sweep.as_ref().map(|rows| ("-sweep", sweep::table(rows, found.spectrum.speeds.len()))));
    tables.extend(found.under.as_ref().map(|under| ("-lift", under.table(asked.samples))));
    Ok(Analysis {
        kind: &KIND,
        machine: machine.name().to_owned(),
        speeds: speed_of(&found),
        inputs: inputs(machine, asked),
        sections: vec![Section::new(KIND.command, &told).with_words(words(&found, &told))],
        measures: measures(&found)?,
        notes: notes(&found),
        plot: curves::plot(&found, sweep.as_deref()),
        mechanism: None,
        document: None,
        tables,
        by: if found.under.as_ref().is_some_and(Under::has_sections) { &["rpm"] } else { &[] },
        along: match (&found.under, asked.sweep) {
            (Some(_), _) => "cam_deg",
            (None, Some(_)) => "stiffness_n_per_m",
            (None, None) => "x_mm",
        },
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

/// The discs on a shaft, and the cam as the last of them.
fn discs(machine: &ShaftMachine, carried: &Carried) -> Vec<crate::shaft::Disc> {
    machine.data.shaft.discs().iter().copied().chain(carried.disc).collect()
}

const NOT_MODELLED: &[&str] = &[
    "Damping, keyways, axial load, and bearings that are stiffer in one direction; the stiffness of a support is that of bearing and housing.",
    "Spin other than at the speed of the whirl.",
    "The stiffness that the hub of a cam or a disc adds to the shaft.",
];

/// A cam of a press is told for the speed of its main shaft.
fn speed_of(found: &Found<'_>) -> Speeds {
    let own = found.carried.as_ref().map_or(&found.asked.rpm, |carried| &carried.rpm);
    match own.as_slice() {
        [] => Speeds::Any(()),
        [rpm] => Speeds::One(*rpm),
        several => Speeds::Several(several.to_vec()),
    }
}

fn inputs(machine: &ShaftMachine, asked: &Asked) -> Vec<Input> {
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

fn figures(found: &Found<'_>) -> Figures {
    let worst = found.under.as_ref();
    let first = found.spectrum.forward;
    Figures {
        mass_kg: found.shaft.mass(),
        speed_rpm: found.speed.map(rpm),
        critical_rpm: found.spectrum.speeds.iter().copied().map(rpm).collect(),
        whirl: word_of(found.asked.whirl),
        beam: match found.asked.solver {
            Solver::Exact { .. } => word_of_beam(found.shaft.beam()),
            Solver::Paper { .. } => word_of_beam(Beam::Euler),
        },
        solver: match found.asked.solver {
            Solver::Exact { .. } => "exact",
            Solver::Paper { .. } => "paper",
        },
        exact_rpm: matches!(found.asked.solver, Solver::Paper { .. }).then(|| rpm(found.spectrum.forward)),
        compliance_um_per_kn: found.statics.as_ref().map(|statics| 1e9 * statics.own()),
        twist_compliance_urad_per_nm: drive_to_cam(found).map(|twist| 1e6 * twist),
        lift_error_max_mm: worst.map(|under| 1e3 * under.largest.value),
        lift_error_cam_deg: worst.map(|under| under.largest.at.to_degrees()),
        bending_mm: worst.map(|under| 1e3 * under.there.bending),
        twist_mm: worst.filter(|under| under.shaft_twist.is_some()).map(|under| 1e3 * under.there.twist),
        residual_max_n: worst.and_then(|under| under.residual).map(|worst| worst.value),
        residual_cam_deg: worst.and_then(|under| under.residual).map(|worst| worst.at.to_degrees()),
        sections: worst.map_or_else(Vec::new, Under::told),
        without_compensation: found.rigid.as_ref().map(|rigid| Without {
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

fn words(found: &Found<'_>, told: &Figures) -> Vec<String> {
    let speeds: Vec<String> = told.critical_rpm.iter().map(|rpm| format!("{rpm:.2}")).collect();
    let order = found.spectrum.order.map_or(String::new(), |order| format!(", order {order}"));
    let whirl = if told.exact_rpm.is_some() { "planar" } else { told.whirl };
    let mut lines = vec![
        format!("mass {:.3} kg with all that is on it", told.mass_kg),
        format!(
            "critical at {} rpm, {whirl} whirl, {} beam, solver {}{order}",
            speeds.join(", "),
            told.beam,
            told.solver
        ),
    ];
    if let Some(exact) = told.exact_rpm {
        let error = 100.0 * (told.critical_rpm.first().copied().unwrap_or(f64::NAN) / exact - 1.0);
        lines.push(format!(
            "the paper's method leaves out shear, rotary inertia, gyroscopic moments and the inertia of discs about a diameter, \
             whatever the file says; the exact method finds {exact:.2} rpm, {error:+.3} %"
        ));
    }
    if let Some(compliance) = told.compliance_um_per_kn {
        let place = if found.carried.is_some() { "the cam" } else { "shaft.cam_at" };
        lines.push(format!("compliance at {place} {compliance:.4} µm/kN"));
    }
    if let Some(under) = &found.under {
        lines.extend(under.words());
    }
    if let Some(rigid) = &found.rigid {
        let left = rigid.residual.map_or(String::new(), |worst| format!(", and {:.2} N would be left", worst.value));
        lines.push(format!(
            "the cam is cut for this shaft (shaft.compensate): one for a rigid shaft would let the follower stand {:.5} mm low{left}",
            1e3 * rigid.largest.value
        ));
    }
    if told.unbalance_g_mm > 0.0 {
        lines.push(found.unbalanced.words());
    }
    lines
}

fn notes(found: &Found<'_>) -> Vec<String> {
    let mut notes = Vec::new();
    let carried = found.carried.as_ref();
    if carried.is_some() && found.machine.data.drive_at.is_none() {
        notes.push("twist is not modelled: shaft.drive_at does not tell where the torque comes in".to_owned());
    }
    if carried.is_some_and(|carried| carried.disc.is_none()) {
        let why = if found.carried.as_ref().is_some_and(Carried::is_conoid) {
            "that of a conoid is not taken"
        } else {
            "cam.thickness is not given"
        };
        notes.push(format!("the cam is on the shaft without its mass: {why}"));
    }
    if found.machine.machine().is_some_and(|machine| machine.compensator().is_some()) {
        notes.push("the compensating cam is not on this shaft: neither its mass nor its torque is taken".to_owned());
    }
    let limits = &found.machine.limits;
    if found.under.is_none() && (limits.lift_error.is_some() || limits.support_slope.is_some()) {
        notes.push("limits.lift_error and limits.support_slope judge nothing: no force of a cam is known".to_owned());
    }
    if found.speed.is_none() {
        notes.push("limits.critical_speed_ratio judges nothing: no speed is known (--rpm)".to_owned());
    }
    if carried.is_some() && found.under.is_none() {
        notes.push("no lift error: neither a press nor a preload tells the force on the follower".to_owned());
    }
    notes
}

fn measures(found: &Found<'_>) -> Result<Vec<Measure>, ShaftAnalysisError> {
    let limits = &found.machine.limits;
    let mut all = Vec::new();
    if let Some(speed) = found.speed {
        // Unbalance whirls with the shaft, whatever whirl is asked for.
        let first = found.spectrum.forward;
        let ratio = speed / first;
        let harmonic = (first / speed).ceil();
        let mut note =
            format!("first critical speed {} rpm, reached by harmonic {} of a turn", shown(rpm(first)), harmonic);
        if ratio > limits.critical_speed_ratio {
            let factor = remedy::for_speed(found, speed / limits.critical_speed_ratio);
            let slower = remedy::slower(found).map_or(String::new(), |slower| format!("; --rpm {slower} would pass"));
            note = format!("{note}{slower}{}", thicker(factor));
        }
        let limit = Some(limits.critical_speed_ratio);
        all.push(Measure { check: CRITICAL_SPEED, value: ratio, limit, unit: "1", note: Some(note) });
    }
    if let Some(under) = &found.under {
        let exceeds = limits.lift_error.is_some_and(|limit| under.largest.value > limit);
        let factor = limits.lift_error.filter(|_| exceeds).map(|limit| remedy::for_lift(found, limit));
        let place = format!("at a cam angle of {:.3}°", under.largest.at.to_degrees());
        let note = factor.map_or(place.clone(), |factor| format!("{place}{}", thicker(factor)));
        let (value, limit) = (1e3 * under.largest.value, limits.lift_error.map(|limit| 1e3 * limit));
        all.push(Measure { check: LIFT_ERROR, value, limit, unit: "mm", note: Some(note) });
        let exceeds = limits.support_slope.is_some_and(|limit| under.slope > limit);
        let factor = limits.support_slope.filter(|_| exceeds).map(|limit| remedy::for_slope(found, limit));
        let note = factor.map(|factor| thicker(factor).trim_start_matches("; ").to_owned());
        all.push(Measure { check: SUPPORT_SLOPE, value: under.slope, limit: limits.support_slope, unit: "rad", note });
    }
    all.push(found.unbalanced.measure());
    Ok(all)
}

/// Twist from the drive to the cam, rad/(N·m).
fn drive_to_cam(found: &Found<'_>) -> Option<f64> {
    let data = &found.machine.data;
    Some(data.shaft.twist_compliance(data.drive_at?, data.cam_at?))
}

/// What would pass, in words.
fn thicker(factor: Option<f64>) -> String {
    let none = || "; no thicker shaft on these supports would pass: they are too soft".to_owned();
    factor.map_or_else(none, |factor| format!("; every diameter times {factor:.3} would pass"))
}

/// The cam on a shaft of the machine's, thicker by a factor.
fn yielding(found: &Found<'_>, factor: f64) -> Option<(Yielding, Statics)> {
    let at = found.machine.data.cam_at?;
    let shaft = found.shaft.scaled(factor).ok()?;
    let statics = Statics::new(&shaft, at).ok()?;
    let twist = found.machine.data.drive_at.map_or(0.0, |drive| shaft.twist_compliance(drive, at));
    Some((Yielding { compliance: statics.own(), twist }, statics))
}

/// What is told of a lowered follower, for the largest of it.
fn error_of(lowered: &Lowered) -> f64 {
    lowered.error().abs()
}

/// A table whose columns are named by the list, as many as there are.
fn named(mut columns: Vec<&'static str>, more: &[&'static str], rows: Vec<Vec<f64>>) -> Table {
    columns.extend(more);
    let may_lack = vec![true; columns.len()];
    Table { columns, rows, may_lack, words: None }
}
