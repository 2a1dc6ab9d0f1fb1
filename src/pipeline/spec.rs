//! The cam to be made: a machine, and how the body is solved from it.

use super::diagnosis::Again;
use super::{Builder, Cam, Error, inputs};
use crate::body::conoid::{Conoid, between};
use crate::body::disc::Disc;
use crate::body::wedge::Wedge;
use crate::body::{Body, SolveError};
use crate::document::Input;
use crate::machine::{BrakeMachine, Machine};
use crate::motion::equation_18::{ExactOn, Solver};
use crate::motion::{BrakeDisc, Motion};
use std::fmt;
use std::sync::Arc;

type Solve = dyn FnOnce(&Machine) -> Result<Box<dyn Body>, SolveError>;

/// A specification: the cam to be made, every value in range.
pub struct Spec {
    machine: Machine,
    solve: Box<Solve>,
    again: Option<Again>,
    /// The disc that takes its torque is left out, although it is described.
    alone: bool,
    /// How the body is solved; `None` where only `solve` knows.
    inputs: Option<Vec<Input>>,
}

impl fmt::Debug for Spec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Spec").field("machine", &self.machine).finish_non_exhaustive()
    }
}

impl Spec {
    /// Any body: `solve` makes it from the machine.
    ///
    /// What `solve` knows beside the machine is an input that the hash in the report cannot see as such: it is of the machine and
    /// of samples of the solved curves, 65 in each piece of the motion.
    pub fn new<B, E>(machine: Machine, solve: impl FnOnce(&Machine) -> Result<B, E> + 'static) -> Self
    where
        B: Body + 'static,
        E: Into<SolveError>,
    {
        let solve = |machine: &Machine| match solve(machine) {
            Ok(body) => Ok(Box::new(body) as Box<dyn Body>),
            Err(error) => Err(error.into()),
        };
        Self { machine, solve: Box::new(solve), again: None, alone: false, inputs: None }
    }

    /// All that is known of how the body is solved, beside the machine.
    fn with(self, inputs: Vec<Input>) -> Self {
        Self { inputs: Some(inputs), ..self }
    }

    /// How the cam is solved for other speeds: a check that fails tells for which it would be the cam.
    fn for_other_speeds<B, E>(self, solve: impl Fn(&Machine, f64) -> Result<B, E> + Send + Sync + 'static) -> Self
    where
        B: Body + 'static,
    {
        let solve = move |machine: &Machine, rpm| Some(Box::new(solve(machine, rpm).ok()?) as Box<dyn Body>);
        Self { again: Some(Again(Box::new(solve))), ..self }
    }

    /// The disc cam of a press for a speed of its main shaft, rpm.
    #[must_use]
    pub fn rotary(machine: Machine, rpm: f64) -> Self {
        Self::new(machine, move |machine| Disc::solve(machine, rpm))
            .for_other_speeds(Disc::solve)
            .with(vec![Input::number("rpm", rpm)])
    }

    /// The wedge cam of a press (a linear cam, the plate on the bed) for a speed of its main shaft, rpm.
    #[must_use]
    pub fn translating(machine: Machine, rpm: f64, solver: Solver, exact_on: ExactOn) -> Self {
        let solve = move |machine: &Machine, rpm| Wedge::solve(machine, rpm, solver, exact_on);
        let mut inputs = inputs::of_wedge(solver, exact_on);
        inputs.push(Input::number("rpm", rpm));
        Self::new(machine, move |machine| solve(machine, rpm)).for_other_speeds(solve).with(inputs)
    }

    /// The conoid of a press (a three-dimensional cam) for several speeds, rpm, with a limit for the residual force
    /// between them, N.
    #[must_use]
    pub fn conoid(machine: Machine, speeds: Vec<f64>, residual_limit: Option<f64>) -> Self {
        let mut inputs = vec![Input::numbers("rpm", &speeds)];
        inputs.extend(residual_limit.map(|limit| Input::quantity("residual", limit, ("N", 1.0))));
        let solve = move |machine: &Machine| Conoid::solve(machine, &speeds);
        Self::new(machine, move |machine| solve(machine).map(|conoid| conoid.with_residual_limit(residual_limit)))
            .with(inputs)
    }

    /// The conoid with the fewest sections between two speeds, rpm, that leaves no more than a residual force between them, N.
    #[must_use]
    pub fn conoid_within(machine: Machine, speeds: (f64, f64), residual_limit: f64) -> Self {
        let solve = move |machine: &Machine| between::fewest(machine, speeds, residual_limit);
        let (from, to) = speeds;
        let inputs =
            vec![Input::word("rpm", format!("{from}..{to}")), Input::quantity("residual", residual_limit, ("N", 1.0))];
        Self::new(machine, move |machine| solve(machine).map(|conoid| conoid.with_residual_limit(Some(residual_limit))))
            .with(inputs)
    }

    /// The disc cam of the motion program of the machine file; `rpm` is the speed of the cam itself, in place of that of the file.
    /// `None` when the file has no motion.
    #[must_use]
    pub fn of_program(machine: Machine, rpm: Option<f64>) -> Option<Self> {
        let (motion, of_file) = machine.motion()?;
        let rpm = rpm.or(of_file);
        let inputs = rpm.map(|rpm| Input::number("rpm", rpm)).into_iter().collect();
        Some(Self::of_motion(machine, motion, rpm).with(inputs))
    }

    /// The disc cam of any motion; `rpm` is the speed of the cam itself, where it is known. Of the motion the hash in the report
    /// knows samples, as in [`Spec::new`].
    #[must_use]
    pub fn of_motion(machine: Machine, motion: Arc<dyn Motion>, rpm: Option<f64>) -> Self {
        Self::new(machine, move |machine| Disc::of_motion(machine, motion, rpm))
    }

    /// A specification put together in code instead of in a file.
    #[must_use]
    pub fn builder(name: &str) -> Builder {
        Builder::new(name)
    }

    /// The compensating cam of a press for a speed of its main shaft, rpm: the disc that takes the torque of the rotary cam, as the
    /// machine file describes it.
    #[must_use]
    pub fn compensator(machine: Machine, rpm: f64) -> Self {
        let solve = |machine: &Machine, rpm| Disc::solve(machine, rpm)?.compensating_disc();
        Self::new(machine, move |machine| solve(machine, rpm))
            .for_other_speeds(solve)
            .with(vec![Input::number("rpm", rpm)])
    }

    /// The disc that holds the tension of a belt brake, with its motion; `None` of a brake that was read without.
    #[must_use]
    pub fn of_brake(brake: &BrakeMachine, disc: Arc<BrakeDisc>) -> Option<Self> {
        let (machine, brake) = (brake.machine()?.clone(), brake.clone());
        Some(Self::new(machine, move |_| Disc::of_brake(&brake, disc)).with(Vec::new()))
    }

    /// Without the disc that takes its torque.
    #[must_use]
    pub fn alone(self) -> Self {
        Self { alone: true, ..self }
    }

    /// The machine it is for.
    #[must_use]
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Solves the motion and sizes the cam.
    ///
    /// # Errors
    /// [`Error::Solve`] when there is no such cam.
    pub fn solve(self) -> Result<Cam, Error> {
        let body = (self.solve)(&self.machine)?;
        let own = self.inputs.unwrap_or_else(|| inputs::of_own(&*body));
        let of = |body: &dyn Body| {
            let mut all = vec![Input::word("command", body.kind().command)];
            all.extend(self.machine.inputs(body.kind().keys));
            all.extend(own.iter().cloned());
            all
        };
        let second = match body.compensating().filter(|_| !self.alone) {
            Some(second) => {
                let (disc, told) = second.map_err(SolveError::from)?;
                let inputs = of(&disc);
                Some((Box::new(Cam { body: Box::new(disc), again: None, inputs, second: None }), told))
            }
            None => None,
        };
        let inputs = of(&*body);
        Ok(Cam { body, again: self.again, inputs, second })
    }
}
