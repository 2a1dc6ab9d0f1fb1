//! The cams of a press, as specifications.

use super::bed_motion::End;
use super::cams::{CONOID, ROTARY, TRANSLATING};
use super::checks;
use super::compensator::{CompensatorFigures, TorqueAtSpeed};
use super::conoid::{Conoid, between};
use super::machine::{MachineOfPress, exact_on};
use super::motion::equation_18::{ExactOn, Solver};
use super::report::{Compensation, PreloadAtSpeed};
use super::rotary::{disc, rotary};
use super::wedge::{LAW_TOLERANCE, Wedge};
use camgen_cams::body::disc::Disc;
use camgen_cams::body::{Body, curves, torque};
use camgen_cams::check::Measure;
use camgen_cams::domain::{DesignCommand, Makes};
use camgen_cams::machine::Machine;
use camgen_cams::pipeline::{Alternative, AssemblyReport, Proven, SolvedBodies, Spec, WantedCams};
use camgen_cams::report::Section;
use camgen_cams::verify::WrittenOutline;
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::lifts;
use camgen_kernel::refusal::Refusal;

/// The commands that make the cams of a press.
pub(super) const COMMANDS: &[DesignCommand] = &[
    DesignCommand {
        word: ROTARY,
        usual: |machine| machine.motion().is_none(),
        makes: Makes::ForOne(|machine, rpm| speed(&machine, rpm).map(|rpm| Spec::rotary(machine, rpm))),
    },
    DesignCommand { word: CONOID, usual: |_| false, makes: Makes::ForSeveral { beside: ROTARY, spec: conoid_for } },
    DesignCommand { word: TRANSLATING, usual: |_| false, makes: Makes::ForOne(translating_for) },
    DesignCommand {
        word: "compensator",
        usual: |_| false,
        makes: Makes::ForOne(|machine, rpm| speed(&machine, rpm).map(|rpm| Spec::compensator(machine, rpm))),
    },
];

/// The requested speed, or the speed of the machine, rpm.
fn speed(machine: &Machine, rpm: Option<f64>) -> Result<f64, Refusal> {
    rpm.map_or_else(|| machine.press().map(|press| press.design_rpm), Ok)
}

fn conoid_for(machine: Machine, rpm: Vec<f64>) -> Result<Spec, Refusal> {
    let speeds = if rpm.is_empty() { vec![speed(&machine, None)?] } else { rpm };
    Ok(Spec::conoid(machine, speeds, None))
}

fn translating_for(machine: Machine, rpm: Option<f64>) -> Result<Spec, Refusal> {
    let (balance, rpm) = (exact_on(&machine), speed(&machine, rpm)?);
    Ok(Spec::translating(machine, rpm, Solver::Ode { tolerance: LAW_TOLERANCE }, balance))
}

/// The cams of a press as specifications: methods of [`Spec`].
pub trait SpecOfPress: Sized {
    /// The disc cam of a press for a speed of its main shaft, rpm. Its assembly has the compensating cam too, where the machine file describes
    /// one ([`Spec::assemble`]).
    ///
    /// ```
    /// use camgen::{Machine, Spec, SpecOfPress, Writing};
    ///
    /// let (machine, name) = Machine::load("dpi", &[])?;
    /// let proven = Spec::rotary(machine, 35.0).solve()?.draw(5e-6)?.prove()?;
    /// let files = proven.files(&Writing::to("output", name).formats(&["dxf"]))?;
    /// assert!(files.bytes(".dxf").is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    fn rotary(machine: Machine, rpm: f64) -> Self;

    /// The wedge cam of a press (a linear cam, the plate on the bed) for a speed of its main shaft, rpm.
    ///
    /// ```
    /// use camgen::{ExactOn, Machine, Solver, Spec, SpecOfPress};
    ///
    /// let (machine, _) = Machine::load("dpi", &[])?;
    /// let cam = Spec::translating(machine, 35.0, Solver::Ode { tolerance: 1e-9 }, ExactOn::Braking).solve()?;
    /// assert!(cam.draw(20e-6)?.prove()?.passed());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    fn translating(machine: Machine, rpm: f64, solver: Solver, exact_on: ExactOn) -> Self;

    /// The conoid of a press (a three-dimensional cam) for several speeds, rpm, with a limit for the residual force
    /// between them, N.
    ///
    /// ```
    /// use camgen::{Machine, Spec, SpecOfPress};
    ///
    /// let (machine, _) = Machine::load("dpi", &[])?;
    /// let cam = Spec::conoid(machine, vec![25.0, 30.0, 35.0], None).solve()?;
    /// let proven = cam.draw(50e-6)?.prove()?;
    /// // A file for each section; another program may have edited one of them.
    /// assert!(cam.check_section(&proven.cut_files()[0], 25.0, 60e-6)?.passed());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    fn conoid(machine: Machine, speeds: Vec<f64>, residual_limit: Option<f64>) -> Self;

    /// The conoid with the fewest sections between two speeds, rpm, that leaves no more than a residual force between them, N.
    #[must_use]
    fn conoid_within(machine: Machine, speeds: (f64, f64), residual_limit: f64) -> Self;

    /// The compensating cam of a press for a speed of its main shaft, rpm: the disc that takes the torque of the rotary cam, as the
    /// machine file describes it.
    #[must_use]
    fn compensator(machine: Machine, rpm: f64) -> Self;
}

impl SpecOfPress for Spec {
    fn rotary(machine: Machine, rpm: f64) -> Self {
        let spec = Self::of_several(machine, move |machine, wanted| {
            let cam = rotary(machine, rpm)?;
            if wanted == WantedCams::Alone || machine.compensator().is_none() {
                return Ok(SolvedBodies::alone(cam.disc));
            }
            let second = cam.compensating_disc()?;
            let by_law = cam.compensated_by(&second)?;
            Ok(SolvedBodies::alone(cam.disc).with(second, by_law))
        });
        spec.for_other_speeds(disc, other_ends).with_inputs(vec![Input::number("rpm", rpm)])
    }

    fn translating(machine: Machine, rpm: f64, solver: Solver, exact_on: ExactOn) -> Self {
        let mut inputs = of_wedge(solver, exact_on);
        inputs.push(Input::number("rpm", rpm));
        Self::new(machine, move |machine| Wedge::solve(machine, rpm, solver, exact_on))
            .for_other_speeds(move |machine, rpm| Wedge::solve(machine, rpm, solver, exact_on), other_ends)
            .with_inputs(inputs)
    }

    fn conoid(machine: Machine, speeds: Vec<f64>, residual_limit: Option<f64>) -> Self {
        let mut inputs = vec![Input::numbers("rpm", &speeds)];
        inputs.extend(residual_limit.map(|limit| Input::quantity("residual", limit, ("N", 1.0))));
        let spec = Self::new(machine, move |machine| {
            Conoid::solve(machine, &speeds).map(|conoid| conoid.with_residual_limit(residual_limit))
        });
        spec.with_inputs(inputs)
    }

    fn conoid_within(machine: Machine, speeds: (f64, f64), residual_limit: f64) -> Self {
        let (from, to) = speeds;
        let inputs =
            vec![Input::word("rpm", format!("{from}..{to}")), Input::quantity("residual", residual_limit, ("N", 1.0))];
        let spec = Self::new(machine, move |machine| {
            let conoid = between::fewest(machine, from, to, residual_limit);
            conoid.map(|conoid| conoid.with_residual_limit(Some(residual_limit)))
        });
        spec.with_inputs(inputs)
    }

    fn compensator(machine: Machine, rpm: f64) -> Self {
        Self::new(machine, move |machine| solve_compensator(machine, rpm))
            .for_other_speeds(solve_compensator, other_ends)
            .with_inputs(vec![Input::number("rpm", rpm)])
    }
}

fn solve_compensator(machine: &Machine, rpm: f64) -> Result<Disc, Refusal> {
    rotary(machine, rpm)?.compensating_disc()
}

/// The cam of the other end of the bed's stroke.
fn other_ends(machine: &Machine) -> Vec<Alternative> {
    let other = machine.end().map(End::other).and_then(|end| Some((machine.clone().at_end(end).ok()?, end)));
    let Some((machine, end)) = other else { return Vec::new() };
    let words = format!("for the {} end of the stroke (--end {})", end.word(), end.word());
    vec![Alternative { cause: "end", words, machine }]
}

/// The inputs of a wedge, except its speed.
fn of_wedge(solver: Solver, exact_on: ExactOn) -> Vec<Input> {
    let solver = match solver {
        Solver::Ode { tolerance } => Input::new("solver", format!("ode {tolerance}"), "ode"),
        Solver::Paper { stations } => Input::word("solver", format!("paper, {stations} stations")),
    };
    vec![solver, Input::word("balance", exact_on.word())]
}

impl AssemblyReport for CompensatorFigures {
    fn measures(&self, _: (&dyn Body, &[WrittenOutline]), others: &[(String, Proven)]) -> Vec<Measure> {
        others.iter().map(|(_, second)| checks::compensator::measure(second.findings())).collect()
    }

    fn sections(&self, first: &Proven, others: &[(String, Proven)]) -> Vec<Section> {
        let second = others.first().and_then(|(_, second)| compensation(first, second, self));
        second.map(|compensation| compensation.section()).into_iter().collect()
    }
}

/// The section on the two discs, with the figures of the second by its law.
fn compensation(first: &Proven, second: &Proven, by_law: &CompensatorFigures) -> Option<Compensation> {
    let (body, machine) = (second.body(), first.body().machine());
    let (curves, data) = (curves(body)?, machine.compensator()?);
    let both = first.outlines().first().zip(second.outlines().first());
    let part = second.drawn().and_then(|drawn| drawn.parts.first());
    let prime_radius_mm = MILLIMETRES * curves.follower.prime_radius()?;
    Some(Compensation {
        lift_max_mm: MILLIMETRES * lifts(curves.motion).1,
        prime_radius_mm,
        base_radius_mm: prime_radius_mm - MILLIMETRES * data.roller_radius,
        roller_radius_mm: MILLIMETRES * data.roller_radius,
        angle_deg: data.angle.to_degrees(),
        work_j: by_law.work,
        spring_force_max_n: by_law.spring_force,
        torque_before_max_nm: by_law.before,
        torque_after_max_nm: by_law.after,
        torque_in_losses_max_nm: by_law.in_losses,
        torque_as_cut_max_nm: both
            .and_then(|(one, two)| torque::remaining_torque((first.body(), &one.contour), (body, &two.contour))),
        preload_by_rpm: by_law.by_speed.iter().map(preload_at).collect(),
        outline: part.map(|part| part.measures(first.tolerance_mm(), |_| false)),
        rolling: second.rolled().cloned(),
        checks: second.findings().to_vec(),
    })
}

fn preload_at(at: &TorqueAtSpeed) -> PreloadAtSpeed {
    PreloadAtSpeed {
        rpm: at.rpm,
        preload_n: at.preload,
        torque_before_max_nm: at.before,
        torque_unchanged_max_nm: at.unchanged,
        torque_after_max_nm: at.after,
    }
}
