//! The drive of a bed without a cam: its speed through the reversal, by energy and by the paper's sections.

use crate::press::buffer::drive::{self, CLOSING, Drive, DriveError, DriveState, NodeSpeed, Phase, SectionEnd};
use crate::press::cams;
use crate::press::checks::air;
use crate::press::machine::{DriveData, DriveMachine};
use crate::press::report::{BUFFERS, CylinderMeasures};
use camgen_cams::analysis::{Analysis, Picture};
use camgen_cams::body::Kind;
use camgen_cams::report::plot::{Plot, PlotCurve, PlotLine, PlotPanel, PlotPoint, figure};
use camgen_cams::report::{Fact, Section, Speeds, Topic, shown};
use camgen_cams::table::{ListedColumn, Table};
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::extremum;
use camgen_kernel::text::{DIGITS, Length, Text, Value, nominal, significant, text};
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI};

/// Drives without a cam.
pub const KIND: Kind = Kind { command: "drive", noun: "drive without a cam", keys: cams::DRIVE };

/// An error of the speed of less than this share is rounding.
const ROUNDING: f64 = 1e-12;

/// Cells of a phase in which its largest torque is searched: it has a hump or two.
const CELLS: u32 = 64;

/// Panels of eight points between two rows for the time.
const PANELS: u32 = 6;

/// Rows between the ends of the phases in the plot.
const PLACES: u32 = 240;

/// How the law is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DriveSolver {
    /// By energy, in closed form.
    Energy,
    /// By the paper's sections.
    Paper,
}

impl NamedChoice for DriveSolver {
    const ALL: &'static [(&'static str, Self)] = &[("energy", Self::Energy), ("paper", Self::Paper)];
}

/// A row of the table; what needs a motor ratio or an inertia that are not given is not a number.
#[derive(Debug, Clone, Copy, PartialEq)]
struct DriveRow {
    crank: f64,
    phase: Phase,
    x: f64,
    force: f64,
    velocity: f64,
    omega: f64,
    motor_rpm: Option<f64>,
    torque: Option<f64>,
    time: f64,
}

/// Degrees without the rounding of the conversion: 60, not 59.99999999999999.
fn degrees(angle: f64) -> f64 {
    const DIGITS: f64 = 1e11;
    (angle.to_degrees() * DIGITS).round() / DIGITS
}

impl DriveRow {
    fn new(state: &DriveState, crank: f64, data: &DriveData) -> Self {
        Self {
            crank,
            phase: state.phase,
            x: state.x,
            force: state.force,
            velocity: state.velocity,
            omega: state.omega,
            motor_rpm: data.motor_ratio.map(|ratio| state.motor_rpm(ratio)),
            torque: data.inertia.map(|inertia| state.torque(inertia)),
            time: f64::NAN,
        }
    }
}

const COLUMNS: &[ListedColumn<DriveRow>] = &[
    ("crank_deg", |row| degrees(row.crank)),
    ("phase", |row| match row.phase {
        Phase::Lead => 1.0,
        Phase::Crank => 2.0,
    }),
    ("x_mm", |row| MILLIMETRES * row.x),
    ("force_n", |row| row.force),
    ("velocity_m_per_s", |row| row.velocity),
    ("omega_rad_per_s", |row| row.omega),
    ("motor_rpm", |row| row.motor_rpm.unwrap_or(f64::NAN)),
    ("torque_nm", |row| row.torque.unwrap_or(f64::NAN)),
    ("time_s", |row| row.time),
];

/// The section `drive`.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct DriveFigures {
    #[serde(flatten)]
    cylinders: CylinderMeasures,
    stroke_mm: f64,
    work_over_energy: f64,
    end_force_n: f64,
    omega_before_rad_per_s: f64,
    /// These and what follows from them of a machine that closes only.
    omega_least_rad_per_s: Option<f64>,
    omega_least_at_phase_deg: Option<f64>,
    omega_end_rad_per_s: Option<f64>,
    speed_drop: Option<f64>,
    lead_time_s: f64,
    crank_time_s: Option<f64>,
    motor_rpm_before: Option<f64>,
    motor_rpm_least: Option<f64>,
    torque_max_nm: Option<f64>,
    energy_swing_j: Option<f64>,
    paper: SectionFigures,
}

/// The figures of the paper's sections.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct SectionFigures {
    step_deg: f64,
    /// Largest error of ω over it, where there is one.
    omega_error_share: f64,
    /// Power of the step with which that error falls, from the step and its half.
    order: Option<f64>,
    /// The failure at the last node.
    failure: Option<String>,
    failure_radicand_per_s2: Option<f64>,
}

/// The drive of a bed by one of the solvers, at steps of the crank angle (rad).
///
/// ```
/// use camgen::Judged;
/// use camgen::domains::press::analysis::drive::{self, DriveSolver};
/// use camgen::domains::press::machine::DriveMachine;
///
/// let (machine, _) = DriveMachine::load("dp", &[])?;
/// let judged = Judged::new(drive::analysis(&machine, DriveSolver::Energy, 10.0_f64.to_radians())?);
/// assert!(judged.report().section("drive").is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`DriveError`] when the column is used up within the stroke. A bed that does not arrive at its end at rest fails the check.
pub fn analysis(machine: &DriveMachine, solver: DriveSolver, step: f64) -> Result<Analysis, DriveError> {
    let data = machine.data;
    let (drive, open) = solved(machine)?;
    let nodes = drive::sections(&drive, step);
    let closes = open.is_none();
    let rows: Vec<DriveRow> = match solver {
        DriveSolver::Energy => {
            let rows = ends(data.lead_angle, step)
                .into_iter()
                .filter_map(|crank| exact_row(&drive, &data, closes, crank))
                .collect();
            if closes { timed(&drive, rows) } else { rows }
        }
        DriveSolver::Paper => by_sections(machine, &drive, &nodes),
    };
    let cranks = (0..=PLACES).map(|i| (data.lead_angle + FRAC_PI_2) * f64::from(i) / f64::from(PLACES));
    let fine: Vec<DriveRow> = cranks.filter_map(|crank| exact_row(&drive, &data, closes, crank)).collect();
    let drive_figures = figures(machine, &drive, closes, step, &nodes);
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs().iter().cloned());
    inputs.extend([Input::word("solver", solver.word()), Input::quantity("step", step, ("deg", PI / 180.0))]);
    let table = Table::listed(COLUMNS, &rows).without_unknown(&["motor_rpm", "torque_nm"]);
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::Any(()),
        inputs,
        sections: vec![
            Section::new(KIND.command, &drive_figures)
                .with_words(describe(&drive_figures))
                .with_facts(facts(&drive_figures)),
        ],
        measures: vec![
            air::CLOSING
                .measure(arrival(machine, drive_figures.work_over_energy), Some(air::ARRIVAL))
                .noted(open.map(|why| why.to_string())),
        ],
        notes: Vec::new(),
        picture: Picture::Curves(plot(machine, &drive_figures, &fine, &nodes)),
        mechanism: None,
        document: None,
        tables: vec![("", table)],
        by: &[],
        along: "crank_deg",
        diagrams: &[],
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

fn facts(found: &DriveFigures) -> Vec<Fact> {
    let buffers = text!(
        "{} cylinders, each: bore {}; {} at the end of {} stroke",
        found.cylinders.cylinders,
        Length::mm(found.cylinders.bore_mm).brief(),
        Value::brief(found.end_force_n, "N"),
        Length::mm(found.stroke_mm).brief()
    );
    let crank = found.omega_least_rad_per_s.zip(found.speed_drop).map(|(least, drop)| {
        text!(
            "{} before braking, least {}: {} % less",
            Value::brief(found.omega_before_rad_per_s, "rad/s"),
            Value::brief_number(least),
            significant(100.0 * drop, DIGITS)
        )
    });
    let motor = found.motor_rpm_before.zip(found.motor_rpm_least);
    let motor =
        motor.map(|(before, least)| text!("{}, least {}", Value::brief(before, "rpm"), Value::brief(least, "rpm")));
    let torque = found.torque_max_nm.map(|torque| Text::from(Value::brief(torque, "N·m")));
    let paper = text!(
        "sections of {}° err by up to {} % of the speed",
        nominal(found.paper.step_deg, DIGITS),
        significant(100.0 * found.paper.omega_error_share, DIGITS)
    );
    let facts = [
        Some(Fact::new(BUFFERS, buffers)),
        crank.map(|crank| Fact::new(Topic::new(30, "crank"), crank)),
        motor.map(|motor| Fact::new(Topic::new(40, "motor"), motor)),
        torque.map(|torque| Fact::new(Topic::TORQUE, torque)),
        Some(Fact::new(Topic::new(70, "the paper"), paper)),
    ];
    facts.into_iter().flatten().collect()
}

/// The row at a crank angle, rad; `None` where the bed stands. The row where the crank begins to turn the bed is the last of the first
/// phase; a machine that does not close has no speed at the end of its stroke.
fn exact_row(drive: &Drive, data: &DriveData, closes: bool, crank: f64) -> Option<DriveRow> {
    let lead = data.lead_angle;
    let state = if crank <= lead { drive.at_phase(Phase::Lead, crank) } else { drive.at(crank) };
    let row = DriveRow::new(&state?, crank, data);
    (closes || row.crank < lead + FRAC_PI_2).then_some(row)
}

/// The speed that the bed has left at the end of its stroke, or lacks there, m/s: 0 where the machine closes but for rounding.
fn arrival(machine: &DriveMachine, work_over_energy: f64) -> f64 {
    let open = (work_over_energy - 1.0).abs();
    if open <= CLOSING { 0.0 } else { machine.data.bed_speed * open.sqrt() }
}

/// The drive of a machine, and why it does not close where it does not.
fn solved(machine: &DriveMachine) -> Result<(Drive, Option<DriveError>), DriveError> {
    let data = machine.data;
    let of = drive::BufferedBed {
        bed_mass: machine.mass,
        crank_radius: machine.crank_radius,
        lead_angle: data.lead_angle,
        bed_speed: data.bed_speed,
        column: machine.column,
        ambient_pressure: machine.ambient_pressure,
        exponent: machine.exponent,
    };
    match data.bore {
        Some(bore) => closed_or_open(of, 0.25 * PI * bore * bore),
        None => Ok((Drive::by_closing(of)?, None)),
    }
}

/// The drive with this piston area (m²), and why it does not close where it does not.
fn closed_or_open(of: drive::BufferedBed, area: f64) -> Result<(Drive, Option<DriveError>), DriveError> {
    match Drive::with_area(of, area) {
        Ok(drive) => Ok((drive, None)),
        Err(why @ (DriveError::StopsEarly { .. } | DriveError::ArrivesWithSpeed { .. })) => {
            Ok((Drive::open(of, area)?, Some(why)))
        }
        Err(why) => Err(why),
    }
}

const NOT_MODELLED: &[&str] = &[
    "The motor: the drive is assumed to follow the law; the torque is that of its own inertia.",
    "Friction of bed and pistons, leakage and the flow of heat.",
    "Acceleration after the reversal: it mirrors the braking.",
];

/// The rows with their times, each by the quadrature from the one before: of an open machine they are not worth their digits.
fn timed(drive: &Drive, mut rows: Vec<DriveRow>) -> Vec<DriveRow> {
    let lead = drive.machine.lead_angle;
    let (mut crank, mut time) = (0.0, 0.0);
    for row in &mut rows {
        let before = if row.phase == Phase::Lead { 0.0 } else { lead };
        time += drive.time_between(row.phase, crank - before, row.crank - before, PANELS);
        (crank, row.time) = (row.crank, time);
    }
    rows
}

/// Crank angles of the rows: the ends of the sections of both phases.
fn ends(lead: f64, step: f64) -> Vec<f64> {
    let mut ends = vec![0.0];
    for (from, length) in [(0.0, lead), (lead, FRAC_PI_2)] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 0.01 degrees")]
        let count = (length / step - 1e-9).ceil().max(0.0) as u32;
        ends.extend((1..=count).map(|i| if i == count { from + length } else { from + step * f64::from(i) }));
    }
    ends
}

/// The rows of the paper's sections that have a speed; the time by the mean speed of a section, its torque by the difference.
fn by_sections(machine: &DriveMachine, drive: &Drive, nodes: &[SectionEnd]) -> Vec<DriveRow> {
    let (r, lead, data) = (machine.crank_radius, machine.data.lead_angle, machine.data);
    let mut rows: Vec<DriveRow> = Vec::new();
    for node in nodes {
        let Some(omega) = node.speed.omega() else { continue };
        let crank = if node.phase == Phase::Lead { node.angle } else { lead + node.angle };
        let (step, before, since) =
            rows.last().map_or((0.0, omega, 0.0), |last| (crank - last.crank, last.omega, last.time));
        let (sin, cos) = (libm::sin(node.angle), libm::cos(node.angle));
        // (7), and (8) divided by cos φ': ω dω/dφ.
        let by_force = -node.deceleration / r;
        let (lever, product) = match node.phase {
            Phase::Lead => (1.0, by_force),
            Phase::Crank => (cos, (by_force + omega * omega * sin) / cos),
        };
        rows.push(DriveRow {
            crank,
            phase: node.phase,
            x: node.x,
            force: drive.force(node.x),
            velocity: r * omega * lever,
            omega,
            motor_rpm: motor_rpm(&data, omega),
            torque: data.inertia.map(|inertia| inertia * product),
            time: since + step / (0.5 * (omega + before)),
        });
    }
    rows
}

/// Largest error of the speed by sections over it, at the nodes that have one.
fn error(drive: &Drive, nodes: &[SectionEnd], within: f64) -> f64 {
    let lead = drive.machine.lead_angle;
    let errors = nodes.iter().filter_map(|node| {
        let crank = if node.phase == Phase::Lead { node.angle } else { lead + node.angle };
        let exact = drive.at(crank).filter(|_| crank <= within)?.omega;
        Some((node.speed.omega()? / exact - 1.0).abs())
    });
    errors.fold(0.0, f64::max)
}

/// Largest size of the torque that the inertia of the drive needs, N·m: at either side of the seam of the phases, or within one.
fn largest_torque(drive: &Drive, inertia: f64) -> f64 {
    let phases = [(Phase::Lead, drive.machine.lead_angle), (Phase::Crank, FRAC_PI_2)];
    let [lead, crank] = phases.map(|(phase, end)| {
        let found = extremum::largest_without_slope(
            |angle| drive.at_phase(phase, angle).map_or(0.0, |state| state.torque(inertia).abs()),
            (0.0, end),
            CELLS,
            extremum::TO_ROUNDING,
        );
        found.value
    });
    lead.max(crank)
}

fn figures(machine: &DriveMachine, drive: &Drive, closes: bool, step: f64, nodes: &[SectionEnd]) -> DriveFigures {
    let (of, data) = (&drive.machine, machine.data);
    let least = closes.then(|| drive.least_speed());
    let end = drive.at(data.lead_angle + FRAC_PI_2).filter(|_| closes).map(|state| state.omega);
    // Where the crank begins to turn the bed every step is compared at the same angle.
    let [whole, half] = [1.0, 0.5].map(|share| error(drive, &drive::sections(drive, share * step), data.lead_angle));
    let failed = nodes.iter().find(|node| node.speed.omega().is_none());
    let failure = failed.map(|node| {
        let at = format!(
            "at {} deg of phase {}",
            shown(node.angle.to_degrees()),
            if node.phase == Phase::Lead { 1 } else { 2 }
        );
        match node.speed {
            NodeSpeed::Negative { radicand } => {
                (format!("{at} the radicand of the speed is negative, {radicand:.6} s⁻²: no speed"), radicand)
            }
            NodeSpeed::Unbounded { radicand } | NodeSpeed::Omega(radicand) => {
                (format!("{at} a radicand of {radicand:.6} s⁻² is left over a cosine of 0: no speed"), radicand)
            }
        }
    });
    DriveFigures {
        cylinders: CylinderMeasures::new(drive.piston_area),
        stroke_mm: MILLIMETRES * of.stroke(),
        work_over_energy: drive.work(of.stroke()) / of.energy(),
        end_force_n: drive.force(of.stroke()),
        omega_before_rad_per_s: drive.omega_before(),
        omega_least_rad_per_s: least.map(|least| least.omega),
        omega_least_at_phase_deg: least.map(|least| degrees(least.phase_angle) + 0.0),
        omega_end_rad_per_s: end,
        speed_drop: least.map(|least| least.drop.max(0.0)),
        lead_time_s: drive.time_of(Phase::Lead, data.lead_angle),
        crank_time_s: closes.then(|| drive.time_of(Phase::Crank, FRAC_PI_2)),
        motor_rpm_before: motor_rpm(&data, drive.omega_before()),
        motor_rpm_least: least.and_then(|least| motor_rpm(&data, least.omega)),
        torque_max_nm: data.inertia.filter(|_| closes).map(|inertia| largest_torque(drive, inertia)),
        energy_swing_j: data.inertia.filter(|_| closes).map(|inertia| drive.energy_swing(inertia)),
        paper: SectionFigures {
            step_deg: step.to_degrees(),
            omega_error_share: error(drive, nodes, f64::INFINITY),
            order: (whole > ROUNDING && half > ROUNDING).then(|| libm::log2(whole / half)),
            failure: failure.as_ref().map(|(words, _)| words.clone()),
            failure_radicand_per_s2: failure.map(|(_, radicand)| radicand),
        },
    }
}

/// Speed of the motor at a speed of the crank, rad/s.
fn motor_rpm(data: &DriveData, omega: f64) -> Option<f64> {
    data.motor_ratio.map(|ratio| 30.0 / PI * ratio * omega)
}

/// How slow the crank becomes, where the machine closes.
fn slowest(drive_figures: &DriveFigures) -> String {
    let figures = (
        drive_figures.omega_least_rad_per_s,
        drive_figures.omega_least_at_phase_deg,
        drive_figures.speed_drop,
        drive_figures.omega_end_rad_per_s,
    );
    let (Some(least), Some(at), Some(drop), Some(end)) = figures else { return String::new() };
    format!(", least {least:.5} at {at:.3}° of phase 2 (−{:.3} %), {end:.5} at the end", 100.0 * drop)
}

fn describe(drive_figures: &DriveFigures) -> Vec<Text> {
    let mut lines = vec![
        text!(
            "{}; stroke {}, force of all at its end {} N, work over the bed's energy {}",
            drive_figures.cylinders.describe(),
            Length::mm(drive_figures.stroke_mm),
            shown(drive_figures.end_force_n),
            shown(drive_figures.work_over_energy)
        ),
        text!(
            "crank {} rad/s before braking{}",
            format_args!("{:.5}", drive_figures.omega_before_rad_per_s),
            slowest(drive_figures)
        ),
        text!(
            "time of the first phase {} s{}",
            format_args!("{:.6}", drive_figures.lead_time_s),
            drive_figures.crank_time_s.map(|time| text!(", of the second {} s", format_args!("{time:.6}")))
        ),
    ];
    if let (Some(before), Some(least)) = (drive_figures.motor_rpm_before, drive_figures.motor_rpm_least) {
        lines.push(format!("motor {before:.1} rpm, least {least:.1} rpm").into());
    }
    if let (Some(torque), Some(swing)) = (drive_figures.torque_max_nm, drive_figures.energy_swing_j) {
        lines.push(
            format!("for its own inertia the drive needs {torque:.2} N·m at most, and exchanges {swing:.3} J").into(),
        );
    }
    let paper = &drive_figures.paper;
    let order = paper
        .order
        .map_or(String::new(), |order| format!("; in the first phase the error is of order {order:.2} in the step"));
    lines.push(
        format!(
            "the paper's sections of {}° err by up to {:.4} % of the speed{order}",
            shown(paper.step_deg),
            100.0 * paper.omega_error_share
        )
        .into(),
    );
    lines.extend(paper.failure.clone().map(Text::from));
    lines
}

fn by_crank(rows: &[DriveRow], value: fn(&DriveRow) -> f64) -> Vec<[f64; 2]> {
    rows.iter().map(|row| [row.crank.to_degrees(), value(row)]).collect()
}

/// How far the crank slows down, or that the bed does not come to rest.
fn headline(found: &DriveFigures) -> String {
    match (found.omega_least_rad_per_s, found.speed_drop) {
        (Some(least), Some(drop)) => {
            format!("The crank slows to {} rad/s: {} % below its speed before", figure(least), figure(100.0 * drop))
        }
        _ => format!(
            "The bed does not come to rest: the air takes up {} % of its energy",
            figure(100.0 * found.work_over_energy)
        ),
    }
}

fn plot(machine: &DriveMachine, found: &DriveFigures, fine: &[DriveRow], nodes: &[SectionEnd]) -> Plot {
    let lead = machine.data.lead_angle;
    let by_sections = nodes.iter().filter_map(|node| {
        let crank = if node.phase == Phase::Lead { node.angle } else { lead + node.angle };
        Some([crank.to_degrees(), node.speed.omega()?])
    });
    let engages = |text: &str| vec![PlotLine { at: lead.to_degrees(), text: text.into(), dashed: true }];
    let omega = by_crank(fine, |row| row.omega);
    let least = omega.iter().copied().reduce(|best, next| if next[1] < best[1] { next } else { best });
    let mut panels = vec![
        PlotPanel {
            points: least
                .map(|at| PlotPoint::dot(at, 0, format!("{} at {}°", figure(at[1]), figure(at[0]))))
                .into_iter()
                .collect(),
            lines: engages("the crank begins to move the bed"),
            height: 1.4,
            ..PlotPanel::new(
                "Speed of the crank, rad/s",
                vec![PlotCurve::grey("by sections", by_sections.collect()), PlotCurve::new("by energy", 0, omega)],
            )
        },
        PlotPanel {
            lines: engages(""),
            ..PlotPanel::new("Speed of the bed, m/s", vec![PlotCurve::new("", 0, by_crank(fine, |row| row.velocity))])
        },
        PlotPanel {
            lines: engages(""),
            ..PlotPanel::new("Force of the buffers, N", vec![PlotCurve::new("", 0, by_crank(fine, |row| row.force))])
        },
    ];
    if machine.data.inertia.is_some() {
        let torque = by_crank(fine, |row| row.torque.unwrap_or(f64::NAN));
        panels.push(PlotPanel {
            lines: engages(""),
            ..PlotPanel::new("Torque for the inertia of the drive, N·m", vec![PlotCurve::new("", 0, torque)])
        });
    }
    Plot {
        title: headline(found),
        subtitle: format!("{}: the drive through a reversal of the bed", machine.name()),
        places: "crank angle from the start of braking, degrees".into(),
        panels,
        ..Plot::default()
    }
}
