//! Speed against accuracy of the cams of a press.

use crate::press::MachineOfPress;
use crate::press::SpecOfPress;
use crate::press::cams;
use crate::press::conoid::Conoid;
use crate::press::machine::exact_on;
use crate::press::motion::equation_18::{BedDirection, Solver};
use crate::press::scatter::{self, reset::ScrewRule};
use crate::press::wedge::LAW_TOLERANCE;
use crate::press::wedge::Wedge;
use camgen_cams::analysis::Analysis;
use camgen_cams::body::Kind;
use camgen_cams::machine::Machine;
use camgen_cams::pipeline::{Cam, Spec};
use camgen_cams::report::{Speeds, failed, shown};
use camgen_cams::trade::solver::{self, SolverRow, SolverTask};
use camgen_cams::trade::{
    self, ACCELERATION, COMMAND, LeftOver, SettingLadder, TradeLaw, TradeLimits, TradeProduct, TradeRun, TradeSetting,
    TradeTask, flags, ladder, of_disc,
};
use camgen_cams::write::number::shortest;
use camgen_kernel::profile::outline::SegmentKind;
use camgen_kernel::refusal::Refusal;
use std::time::Duration;

/// The disc cam.
pub const ROTARY: Kind = Kind { command: COMMAND, noun: "time and accuracy of a rotary cam", keys: cams::ROTARY };
/// The plate.
pub const TRANSLATING: Kind =
    Kind { command: COMMAND, noun: "time and accuracy of a translating cam", keys: cams::TRANSLATING };

/// The sections of a conoid.
pub const CONOID: Kind =
    Kind { command: COMMAND, noun: "time and accuracy of the sections of a conoid", keys: cams::CONOID };

/// Numbers of sections of a conoid.
const SECTIONS: [usize; 8] = [2, 3, 4, 5, 6, 8, 10, 12];
/// Tolerance of a conoid drawn for its checks, m.
const TOLERANCE: f64 = 5e-6;
/// Largest residual force by default, as a share of the largest inertia.
const SHARE: f64 = 1e-4;
/// Tolerances of the differential equation, by name in mm and in m, and stations of the paper's method.
const ODE: [(&str, f64); 4] = [("1e-3", 1e-6), ("1e-6", 1e-9), ("1e-9", 1e-12), ("1e-12", 1e-15)];
const STATIONS: [u32; 4] = [18, 180, 1800, 18_000];
/// Tolerance of the outline on the ladder of the law, m.
const LAW_LADDER_TOLERANCE: f64 = 1e-6;
/// Places at which two motions are compared.
const PLACES: u32 = 360;

/// Limits that the advice keeps; `None` is the default.
#[derive(Debug, Clone, Copy, Default)]
pub struct PressTradeLimits {
    /// Largest residual force, N; by default a ten-thousandth of the largest inertia.
    pub residual: Option<f64>,
    /// Largest acceleration error / largest acceleration; by default as for `--accuracy standard`.
    pub acceleration: Option<f64>,
}

/// The disc cam of a press for a speed (rpm) over all settings, with the residual forces of other parts of the machine.
///
/// # Errors
/// [`Refusal`] when the machine is no press, or a setting cannot be made.
pub fn rotary(
    machine: &Machine,
    rpm: f64,
    limits: PressTradeLimits,
    others: Vec<LeftOver>,
    run: TradeRun<'_>,
) -> Result<Analysis, Refusal> {
    let others = others.into_iter().chain(left_in_practice(machine, rpm)).collect();
    let own = machine.clone();
    let settings = of_disc(move || Ok(Spec::rotary(own.clone(), rpm)))?;
    of_press(&ROTARY, machine, rpm, limits, settings, others, run)
}

/// The plate of a press for a speed (rpm) over all settings, including the settings of its differential equation.
///
/// # Errors
/// [`Refusal`] when the machine is no press, or a setting cannot be made.
pub fn translating(
    machine: &Machine,
    rpm: f64,
    limits: PressTradeLimits,
    run: TradeRun<'_>,
) -> Result<Analysis, Refusal> {
    let settings = of_plate(machine, rpm)?;
    let plate =
        Wedge::solve(machine, rpm, Solver::Ode { tolerance: LAW_TOLERANCE }, exact_on(machine)).map_err(Refusal::of)?;
    let [braking, back] = [BedDirection::Braking, BedDirection::Return].map(|way| plate.residual_max(way).value);
    let about = format!(
        "equation (18), {} N while the bed is braked and {} N on its return (`camgen translating`)",
        shown(braking),
        shown(back)
    );
    let others = vec![LeftOver::of_force("law", braking.max(back), about)];
    of_press(&TRANSLATING, machine, rpm, limits, settings, others, run)
}

/// What 19 of 20 presses stay below that differ as the file says; `None` where no column balances them, or a linkage moves the bed.
fn left_in_practice(machine: &Machine, rpm: f64) -> Option<LeftOver> {
    let (force, rule) = scatter::analysis::left_in_practice(machine, rpm)?;
    let screw = if rule == ScrewRule::None { "with the screw as it is" } else { "with the screw set for each" };
    Some(LeftOver::of_force(
        "scatter",
        force,
        format!("presses that differ, 19 of 20 of them, {screw} (`camgen scatter`)"),
    ))
}

fn of_press(
    kind: &'static Kind,
    machine: &Machine,
    rpm: f64,
    limits: PressTradeLimits,
    settings: SettingLadder,
    others: Vec<LeftOver>,
    run: TradeRun<'_>,
) -> Result<Analysis, Refusal> {
    let inertia = machine.press()?.largest_inertia(rpm);
    let limits = TradeLimits {
        residual: Some(limits.residual.unwrap_or(SHARE * inertia)),
        acceleration: Some(limits.acceleration.unwrap_or(ACCELERATION)),
    };
    let cam = kind.keys;
    trade::analysis(
        &TradeTask { kind, cam, machine, rpm: Some(rpm), settings, limits, inputs: machine.inputs(cam), others },
        run,
    )
}

/// Evenly spaced speeds, those between the ends in thousandths.
#[expect(clippy::cast_precision_loss, reason = "sections")]
fn spaced(from: f64, to: f64, count: usize) -> Vec<f64> {
    let inner = 1..count.saturating_sub(1);
    let inner = inner.map(|i| (1e3 * (from + (to - from) * i as f64 / (count - 1) as f64)).round() / 1e3);
    std::iter::once(from).chain(inner).chain([to]).collect()
}

/// The sections of a conoid for speeds from one to another (rpm): what they leave between them.
///
/// # Errors
/// [`Refusal`] when the machine has no conoid, or not for these speeds.
pub fn conoid(
    machine: &Machine,
    from: f64,
    to: f64,
    limits: PressTradeLimits,
    clock: &dyn Fn() -> Duration,
) -> Result<Analysis, Refusal> {
    let limit = limits.residual.unwrap_or(SHARE * machine.press()?.largest_inertia(to));
    let mut rows = Vec::with_capacity(SECTIONS.len());
    for count in SECTIONS {
        let speeds = spaced(from, to, count);
        let typed: Vec<String> = speeds.iter().map(|rpm| shortest(*rpm)).collect();
        let setting = (format!("{count} sections"), format!("--rpm {}", typed.join(",")), count);
        rows.push(SolverRow::measured(setting, clock, || {
            Ok(Conoid::unsized_of(machine, &speeds)?.residual_between().force)
        })?);
    }
    let task = SolverTask {
        kind: &CONOID,
        machine: machine.name(),
        word: "conoid",
        speeds: Speeds::Several(vec![from, to]),
        inputs: machine.inputs(cams::CONOID),
        error: ("residual_n", "N", "largest residual force between the sections of a conoid"),
        limit,
    };
    solver::analysis(task, &rows, |count| {
        let made = Spec::conoid(machine.clone(), spaced(from, to, count), None).solve().map_err(Refusal::of)?;
        let proven = made.draw(TOLERANCE).and_then(camgen_cams::pipeline::Drawing::prove).map_err(Refusal::of)?;
        Ok(failed(proven.findings()).into_iter().map(str::to_owned).collect())
    })
}

/// The plate: all outlines with the finest law, then every law at 1 µm. Every law is solved once a round.
fn of_plate(machine: &Machine, rpm: f64) -> Result<SettingLadder, Refusal> {
    let [.., (_, finest)] = ODE;
    let finest = Solver::Ode { tolerance: finest };
    let truth = Wedge::solve(machine, rpm, finest, exact_on(machine)).map_err(Refusal::of)?;
    let mut laws = vec![law_by(machine, rpm, finest, &truth)?];
    let mut settings = ladder();
    let by_ode = ODE.map(|(name, tolerance)| (format!("ode {name} mm, 1 µm"), Solver::Ode { tolerance }));
    let by_stations = STATIONS.map(|stations| (format!("paper {stations}, 1 µm"), Solver::Paper { stations }));
    for (name, solver) in by_ode.into_iter().chain(by_stations) {
        let is_finest = solver == finest;
        if !is_finest {
            laws.push(law_by(machine, rpm, solver, &truth)?);
        }
        let number = if is_finest { 0 } else { laws.len() - 1 };
        let made = TradeProduct::Outline { laid: SegmentKind::Arcs, share: None };
        // The command integrates to a tolerance of its own.
        let flags = match solver {
            Solver::Paper { stations } => {
                Some(format!("{} --solver paper --stations {stations}", flags(LAW_LADDER_TOLERANCE, None)))
            }
            Solver::Ode { .. } => None,
        };
        settings.push(TradeSetting { name, flags, law: number, tolerance: LAW_LADDER_TOLERANCE, made });
    }
    Ok((laws, settings))
}

/// The plate with its law by a solver, and the error of the law against the true one.
fn law_by(machine: &Machine, rpm: f64, solver: Solver, truth: &Wedge) -> Result<TradeLaw, Refusal> {
    let plate = Wedge::solve(machine, rpm, solver, exact_on(machine)).map_err(Refusal::of)?;
    let again = machine.clone();
    Ok(TradeLaw {
        cam: solve_plate(machine, rpm, solver)?,
        solve: Box::new(move || solve_plate(&again, rpm, solver)),
        error_mm: 1e3 * apart(truth, &plate),
        residual_n: plate.residual_max(BedDirection::Braking).value,
    })
}

fn solve_plate(machine: &Machine, rpm: f64, solver: Solver) -> Result<Cam, Refusal> {
    Spec::translating(machine.clone(), rpm, solver, exact_on(machine)).solve().map_err(Refusal::of)
}

/// Largest distance of two motions over the stroke, m.
fn apart(a: &Wedge, b: &Wedge) -> f64 {
    let (one, other) = (a.motion().motion(), b.motion().motion());
    let overruns = (0..=PLACES).map(|i| a.stroke() * f64::from(i) / f64::from(PLACES));
    overruns.map(|x| (one.at(x, false)[0] - other.at(x, false)[0]).abs()).fold(0.0, f64::max)
}
