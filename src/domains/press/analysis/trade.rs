//! Speed against accuracy of the cams of a press.

use crate::analysis::Analysis;
use crate::body::Kind;
use crate::domains::press::cams;
use crate::domains::press::motion::equation_18::{BedDirection, BottomMotion, ExactOn, Solver};
use crate::domains::press::wedge::Wedge;
use crate::machine::Machine;
use crate::pipeline::Spec;
use crate::profile::outline::SegmentKind;
use crate::refusal::Refusal;
use crate::trade::{
    self, COMMAND, SettingLadder, TradeLaw, TradeLimits, TradeProduct, TradeRun, TradeSetting, TradeTask, ladder,
    of_disc,
};

/// The disc cam.
pub const ROTARY: Kind = Kind { command: COMMAND, noun: "time and accuracy of a rotary cam", keys: cams::ROTARY };
/// The plate.
pub const TRANSLATING: Kind =
    Kind { command: COMMAND, noun: "time and accuracy of a translating cam", keys: cams::TRANSLATING };

/// Largest residual force by default, as a share of the largest inertia.
const SHARE: f64 = 1e-4;
/// Tolerances of the differential equation, by name in mm and in m, and stations of the paper's method.
const ODE: [(&str, f64); 4] = [("1e-3", 1e-6), ("1e-6", 1e-9), ("1e-9", 1e-12), ("1e-12", 1e-15)];
const STATIONS: [u32; 4] = [18, 180, 1800, 18_000];
/// Tolerance of the outline on the ladder of the law, m.
const LAW_LADDER_TOLERANCE: f64 = 1e-6;
/// Places at which two motions are compared.
const PLACES: u32 = 360;

/// What the advice keeps; what is `None` has a default or no limit.
#[derive(Debug, Clone, Copy, Default)]
pub struct PressTradeLimits {
    /// Largest residual force, N; by default a ten-thousandth of the largest inertia.
    pub residual: Option<f64>,
    /// Largest error of the acceleration over its largest.
    pub acceleration: Option<f64>,
}

/// The disc cam of a press for a speed (rpm) over all settings.
///
/// # Errors
/// [`Refusal`] when the machine is no press, or a setting cannot be made.
pub fn rotary(machine: &Machine, rpm: f64, limits: PressTradeLimits, run: TradeRun<'_>) -> Result<Analysis, Refusal> {
    let own = machine.clone();
    let settings = of_disc(move || Ok(Spec::rotary(own.clone(), rpm)))?;
    of_press(&ROTARY, cams::ROTARY, (machine, rpm), limits, settings, run)
}

/// The plate of a press for a speed (rpm) over all settings, those of its differential equation among them.
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
    of_press(&TRANSLATING, cams::TRANSLATING, (machine, rpm), limits, settings, run)
}

fn of_press(
    kind: &'static Kind,
    cam: &'static str,
    (machine, rpm): (&Machine, f64),
    limits: PressTradeLimits,
    settings: SettingLadder,
    run: TradeRun<'_>,
) -> Result<Analysis, Refusal> {
    let inertia = machine.press()?.largest_inertia(rpm);
    let limits =
        TradeLimits { residual: Some(limits.residual.unwrap_or(SHARE * inertia)), acceleration: limits.acceleration };
    trade::analysis(&TradeTask { kind, cam, machine, rpm: Some(rpm), settings, limits }, run)
}

/// The plate: all outlines with the finest law, then every law at 1 µm. Every law is solved once a round.
fn of_plate(machine: &Machine, rpm: f64) -> Result<SettingLadder, Refusal> {
    let [.., (_, finest)] = ODE;
    let solve = |solver: Solver| Wedge::solve(machine, rpm, solver, ExactOn::Braking).map_err(Refusal::of);
    let truth = solve(Solver::Ode { tolerance: finest })?;
    let law = |solver: Solver| -> Result<TradeLaw, Refusal> {
        let (machine, plate) = (machine.clone(), solve(solver)?);
        let spec = move || Spec::translating(machine.clone(), rpm, solver, ExactOn::Braking);
        let solve = move || spec().solve().map_err(Refusal::of);
        let (error_mm, residual_n) = (1e3 * apart(&truth, &plate), plate.residual_max(BedDirection::Braking).value);
        Ok(TradeLaw { cam: solve()?, solve: Box::new(solve), error_mm, residual_n })
    };
    let ode = |(name, tolerance): &(&str, f64)| (format!("ode {name} mm, 1 µm"), Solver::Ode { tolerance: *tolerance });
    let paper = |stations: &u32| (format!("paper {stations}, 1 µm"), Solver::Paper { stations: *stations });
    let of_law: Vec<(String, Solver)> = ODE.iter().map(ode).chain(STATIONS.iter().map(paper)).collect();
    let mut laws = vec![law(Solver::Ode { tolerance: finest })?];
    let mut settings = ladder();
    for (name, solver) in of_law {
        let is_finest = solver == Solver::Ode { tolerance: finest };
        if !is_finest {
            laws.push(law(solver)?);
        }
        let number = if is_finest { 0 } else { laws.len() - 1 };
        let made = TradeProduct::Outline { laid: SegmentKind::Arcs, share: None };
        settings.push(TradeSetting { name, law: number, tolerance: LAW_LADDER_TOLERANCE, made });
    }
    Ok((laws, settings))
}

/// Largest distance of two motions over the stroke, m.
fn apart(a: &Wedge, b: &Wedge) -> f64 {
    let at = |motion: &BottomMotion, x: f64| motion.at(x, false)[0];
    let off = |i: u32| {
        let x = a.stroke() * f64::from(i) / f64::from(PLACES);
        (at(a.motion().motion(), x) - at(b.motion().motion(), x)).abs()
    };
    (0..=PLACES).map(off).fold(0.0, f64::max)
}
