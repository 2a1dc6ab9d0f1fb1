//! The settings that are measured: arcs by distance and by acceleration, splines, points; laws of a plate.

use super::{Failure, Law, Made, Setting};
use camgen::body::wedge::Wedge;
use camgen::geometry::points::Between;
use camgen::machine::Machine;
use camgen::motion::equation_18::{BottomMotion, ExactOn, Solver, Way};
use camgen::pipeline::Spec;
use camgen::profile::outline::Laid;

/// Distances of the ladder, m, from coarse to fine.
const TOLERANCES: [(&str, f64); 9] = [
    ("100 µm", 100e-6),
    ("50 µm (draft)", 50e-6),
    ("10 µm", 10e-6),
    ("5 µm", 5e-6),
    ("1 µm", 1e-6),
    ("0.5 µm", 0.5e-6),
    ("0.1 µm", 0.1e-6),
    ("0.05 µm", 0.05e-6),
    ("0.01 µm", 0.01e-6),
];
/// Tolerances of the differential equation, by name in mm and in m, and stations of the paper's method.
const ODE: [(&str, f64); 4] = [("1e-3", 1e-6), ("1e-6", 1e-9), ("1e-9", 1e-12), ("1e-12", 1e-15)];
const STATIONS: [u32; 4] = [18, 180, 1800, 18_000];
/// Tolerance of the outline on the ladder of the law, m.
const LAW_LADDER_TOLERANCE: f64 = 1e-6;
/// Places at which two motions are compared.
const PLACES: u32 = 360;
/// Outlines that also keep the acceleration: name, distance in m, share of the acceleration, and of what they are laid; those of
/// `--accuracy` by their names.
const FELT: [(&str, f64, Option<f64>, Laid); 6] = [
    ("5 µm, 5 % (standard)", 5e-6, Some(0.05), Laid::Arcs),
    ("5 µm, 2 %", 5e-6, Some(0.02), Laid::Arcs),
    ("0.5 µm, 1 % (fine)", 0.5e-6, Some(0.01), Laid::Arcs),
    ("spline, 5 µm", 5e-6, None, Laid::Splines),
    ("spline, 5 µm, 5 %", 5e-6, Some(0.05), Laid::Splines),
    ("spline, 0.5 µm, 1 %", 0.5e-6, Some(0.01), Laid::Splines),
];
/// Points in x and y by equal chord error: name, distance in m, share of the acceleration, and what the control does between them.
const POINTS: [(&str, f64, Option<f64>, Between); 5] = [
    ("points, linear, 5 µm", 5e-6, None, Between::Linear),
    ("points, cubic, 5 µm", 5e-6, None, Between::Cubic),
    ("points, cubic, 5 µm, 5 %", 5e-6, Some(0.05), Between::Cubic),
    ("points, cubic, 0.5 µm", 0.5e-6, None, Between::Cubic),
    ("points, cubic, 0.5 µm, 1 %", 0.5e-6, Some(0.01), Between::Cubic),
];

pub(super) type Ladder = (Vec<Law>, Vec<Setting>);

/// The surface ladder with the first law.
fn ladder() -> Vec<Setting> {
    let arcs = TOLERANCES.iter().map(|(name, tolerance)| (*name, *tolerance, None, Laid::Arcs));
    let all = arcs.chain(FELT);
    all.map(|(name, tolerance, share, laid)| Setting {
        name: name.into(),
        law: 0,
        tolerance,
        made: Made::Outline { laid, share },
    })
    .collect()
}

/// The disc cam of a press over the ladder.
pub(super) fn rotary(machine: &Machine, rpm: f64) -> Result<Ladder, Failure> {
    let machine = machine.clone();
    of_disc(move || Ok(Spec::rotary(machine.clone(), rpm).alone()))
}

/// The disc cam of a motion program over the ladder.
pub(super) fn of_program(machine: &Machine, rpm: Option<f64>) -> Result<Ladder, Failure> {
    let machine = machine.clone();
    let no_motion =
        || Failure("there is no motion: `trade make` needs the tables [motion] and [[motion.segment]]".into());
    of_disc(move || Spec::of_program(machine.clone(), rpm).ok_or_else(no_motion))
}

/// A disc cam over the ladder; its law is a closed form, exact to rounding.
fn of_disc(spec: impl Fn() -> Result<Spec, Failure> + 'static) -> Result<Ladder, Failure> {
    let solve = move || spec()?.solve().map_err(Failure::new);
    let law = Law { cam: solve()?, solve: Box::new(solve), error_mm: 0.0, residual_n: 0.0 };
    let points = POINTS.iter().map(|(name, tolerance, share, between)| Setting {
        name: (*name).into(),
        law: 0,
        tolerance: *tolerance,
        made: Made::Points { between: *between, share: *share },
    });
    Ok((vec![law], ladder().into_iter().chain(points).collect()))
}

/// The plate: the surface ladder with the finest law, then the law's own ladder at 1 µm. Every law is solved once a round.
pub(super) fn translating(machine: &Machine, rpm: f64) -> Result<Ladder, Failure> {
    let [.., (_, finest)] = ODE;
    let solve = |solver: Solver| Wedge::solve(machine, rpm, solver, ExactOn::Braking).map_err(Failure::new);
    let truth = solve(Solver::Ode { tolerance: finest })?;
    let law = |solver: Solver| {
        let (machine, plate) = (machine.clone(), solve(solver)?);
        let spec = move || Spec::translating(machine.clone(), rpm, solver, ExactOn::Braking);
        let solve = move || spec().solve().map_err(Failure::new);
        let (error_mm, residual_n) = (1e3 * apart(&truth, &plate), plate.residual_max(Way::Braking).value);
        Ok(Law { cam: solve()?, solve: Box::new(solve), error_mm, residual_n })
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
        let made = Made::Outline { laid: Laid::Arcs, share: None };
        settings.push(Setting { name, law: number, tolerance: LAW_LADDER_TOLERANCE, made });
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
