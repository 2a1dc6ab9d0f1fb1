//! The cam to be made: a machine, and how the body is solved from it.

use super::diagnosis::{Alternative, Resolver};
use super::pair::PairReport;
use super::{Assembly, AssemblyReport, Cam, Error, inputs};
use crate::body::{self, Body, ProgramCams, Request};
use crate::machine::Machine;
use crate::report::Inputs;
use camgen_kernel::document::Input;
use camgen_kernel::motion::Motion;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use std::fmt;
use std::sync::Arc;

/// Solves a body and, where they are wanted, those that are made for it.
type Solve = dyn FnOnce(&Machine, WantedCams) -> Result<SolvedBodies, Refusal> + Send;

/// Which cams are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WantedCams {
    /// The cam alone.
    Alone,
    /// And those that are made for it.
    All,
}

/// A solved body, with those that are made for it.
pub struct SolvedBodies {
    body: Arc<dyn Body>,
    /// What the names of its files have after the stem where others are made with it.
    name: &'static str,
    /// Each with what the names of its files have after the stem.
    others: Vec<(String, Arc<dyn Body>)>,
    joint_report: Option<Arc<dyn AssemblyReport>>,
}

impl SolvedBodies {
    /// A body alone.
    pub fn alone(body: impl Body + 'static) -> Self {
        Self { body: Arc::new(body), name: "", others: Vec::new(), joint_report: None }
    }

    /// With another body that is made for it, whose files are named by its command, and the report on both together.
    #[must_use]
    pub fn with(mut self, other: impl Body + 'static, joint_report: impl AssemblyReport + 'static) -> Self {
        self.others.push((other.kind().command.to_owned(), Arc::new(other)));
        Self { joint_report: Some(Arc::new(joint_report)), ..self }
    }
}

/// A cam, its name among them, those that are made with it by their names, and the report on all of them.
type SolvedCams = (Cam, &'static str, Vec<(String, Cam)>, Option<Arc<dyn AssemblyReport>>);

/// A specification: the cam to be made, every value in range.
pub struct Spec {
    machine: Machine,
    solve: Box<Solve>,
    resolver: Option<Resolver>,
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
    /// What `solve` knows in addition to the machine is an input that the hash in the report cannot see as such: it is of the machine and
    /// of samples of the solved curves, 65 in each piece of the motion.
    pub fn new<B, E>(machine: Machine, solve: impl FnOnce(&Machine) -> Result<B, E> + Send + 'static) -> Self
    where
        B: Body + 'static,
        E: Into<Refusal>,
    {
        Self::of_several(machine, |machine, _| solve(machine).map(SolvedBodies::alone).map_err(E::into))
    }

    /// Any body, with those that are made for it where they are wanted.
    pub fn of_several(
        machine: Machine,
        solve: impl FnOnce(&Machine, WantedCams) -> Result<SolvedBodies, Refusal> + Send + 'static,
    ) -> Self {
        Self { machine, solve: Box::new(solve), resolver: None, inputs: None }
    }

    /// A cam that cannot be made.
    fn refused(machine: Machine, refusal: Refusal) -> Self {
        Self::of_several(machine, move |_, _| Err(refusal))
    }

    /// All inputs of the solution in addition to the machine.
    #[must_use]
    pub fn with_inputs(self, inputs: Vec<Input>) -> Self {
        Self { inputs: Some(inputs), ..self }
    }

    /// How the cam is solved for other speeds, and of which other machines a file may be the cam: a check that fails looks for these.
    #[must_use]
    pub fn for_other_speeds<B, E>(
        self,
        solve: impl Fn(&Machine, f64) -> Result<B, E> + Send + Sync + 'static,
        alternatives: fn(&Machine) -> Vec<Alternative>,
    ) -> Self
    where
        B: Body + 'static,
    {
        let solve = move |machine: &Machine, rpm| Some(Box::new(solve(machine, rpm).ok()?) as Box<dyn Body>);
        Self { resolver: Some(Resolver { solve: Arc::new(solve), alternatives }), ..self }
    }

    /// The cam of the motion program of the machine file, with the body of its `cam.body`; `rpm` is the speed of the cam itself, in place of that of the file.
    /// `None` when the file has no motion.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Machine, Spec};
    ///
    /// let text = r#"
    /// name = "Pusher"
    /// [motion]
    /// start = "0 mm"
    /// [[motion.segment]]
    /// law = "cycloidal"
    /// over = "120 deg"
    /// to = "15 mm"
    /// [[motion.segment]]
    /// law = "cycloidal"
    /// over = "120 deg"
    /// to = "0 mm"
    /// [[motion.segment]]
    /// law = "dwell"
    /// [follower.roller]
    /// radius = "10 mm"
    /// [cam]
    /// [limits]
    /// "#;
    /// let machine = Machine::from_toml("pusher.toml", text, &[])?;
    /// let cam = Spec::of_program(machine, Some(60.0)).ok_or("no motion")?.solve()?;
    /// assert!(cam.draw(10e-6)?.prove()?.passed());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn of_program(machine: Machine, rpm: Option<f64>) -> Option<Self> {
        let machine = match machine.at_rpm(rpm) {
            Ok(machine) => machine,
            Err(refusal) => return Some(Self::refused(machine, refusal)),
        };
        let (motion, of_file) = machine.motion()?;
        let rpm = rpm.or(of_file);
        let inputs = rpm.map(|rpm| Input::number("rpm", rpm)).into_iter().collect();
        Some(Self::of_motion(machine, motion, rpm).with_inputs(inputs))
    }

    /// The cam of any motion, with the body of the machine's `cam.body`; `rpm` is the speed of the cam itself, where it is known. Of the motion the hash in the report
    /// knows samples, as in [`Spec::new`].
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::motion::EccentricCircle;
    /// use camgen::{Machine, Spec};
    /// use std::sync::Arc;
    ///
    /// let machine = Spec::builder("eccentric").roller(0.010).base_radius(0.030).machine()?;
    /// let circle = EccentricCircle::new(0.005, 0.040);
    /// let cam = Spec::of_motion(machine, Arc::new(circle), None).solve()?;
    /// assert!(cam.draw(1e-6)?.prove()?.passed());
    /// # Ok::<(), camgen::Error>(())
    /// ```
    #[must_use]
    pub fn of_motion(machine: Machine, motion: Arc<dyn Motion>, rpm: Option<f64>) -> Self {
        Self::of_several(machine, move |machine, wanted| {
            let ProgramCams { first: (name, body), others } = body::of_motion(machine, &motion, rpm)?;
            let wanted = |_: &(_, _)| wanted == WantedCams::All;
            let others: Vec<(String, Arc<dyn Body>)> =
                others.into_iter().filter(wanted).map(|(name, body)| (name.to_owned(), body)).collect();
            let joint_report = (!others.is_empty()).then(|| Arc::new(PairReport) as Arc<dyn AssemblyReport>);
            Ok(SolvedBodies { body, name, others, joint_report })
        })
    }

    /// The cam of this name that is made with that of the motion program of a machine, alone; `None` when the file has no motion.
    #[must_use]
    pub fn made_with_program(machine: Machine, rpm: Option<f64>, name: &'static str) -> Option<Self> {
        let machine = match machine.at_rpm(rpm) {
            Ok(machine) => machine,
            Err(refusal) => return Some(Self::refused(machine, refusal)),
        };
        let (motion, of_file) = machine.motion()?;
        let rpm = rpm.or(of_file);
        let inputs = rpm.map(|rpm| Input::number("rpm", rpm)).into_iter().collect();
        let solve = move |machine: &Machine, _| {
            let cams = body::of_motion(machine, &motion, rpm)?;
            let found = cams.others.into_iter().find(|(other, _)| *other == name);
            let (_, body) = found.ok_or_else(|| Refusal::new(format!("there is no {name} with this cam")))?;
            Ok(SolvedBodies { body, name: "", others: Vec::new(), joint_report: None })
        };
        Some(Self::of_several(machine, solve).with_inputs(inputs))
    }

    /// The hash of what determines the part, as it is written into files, without solving it; for the command that makes it and the kind
    /// of cam whose keys have an effect on it. `None` where only the solved cam shows it.
    #[must_use]
    pub fn inputs_hash(&self, (command, keys): (&str, &str), request: &Request) -> Option<String> {
        let own = self.inputs.as_ref()?;
        let of_cam = std::iter::once(Input::word("command", command)).chain(self.machine.inputs(keys));
        let all: Vec<Input> = of_cam.chain(own.iter().cloned()).chain(inputs::of_request(request)).collect();
        Some(Inputs::of(&all).hash)
    }

    /// The machine it is for.
    #[must_use]
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// With its files in a unit.
    #[must_use]
    pub fn in_units(self, units: LengthUnit) -> Self {
        Self { machine: self.machine.in_units(units), ..self }
    }

    /// Solves the motion and sizes the cam.
    ///
    /// # Errors
    /// [`Error::Solve`] when there is no such cam.
    pub fn solve(self) -> Result<Cam, Error> {
        Ok(self.solved(WantedCams::Alone)?.0)
    }

    /// Solves the cam and those that the machine file describes to be made with it.
    ///
    /// # Errors
    /// [`Error::Solve`] when there is no such cam, of any of them.
    pub fn assemble(self) -> Result<Assembly, Error> {
        let (cam, name, others, joint_report) = self.solved(WantedCams::All)?;
        let name = if others.is_empty() { "" } else { name };
        let assembly =
            others.into_iter().fold(Assembly::from(cam), |assembly, (name, cam)| assembly.with(name, cam)).called(name);
        Ok(match joint_report {
            Some(joint_report) => assembly.reported(joint_report),
            None => assembly,
        })
    }

    fn solved(self, wanted: WantedCams) -> Result<SolvedCams, Error> {
        let SolvedBodies { body, name, others, joint_report } =
            (self.solve)(&self.machine, wanted).map_err(Error::Solve)?;
        let own = self.inputs.unwrap_or_else(|| inputs::of_own(&*body));
        let values = self.machine.values();
        let cam = |body: Arc<dyn Body>, resolver| Cam { body, resolver, own: own.clone(), values: values.clone() };
        let others = others.into_iter().map(|(name, body)| (name, cam(body, None))).collect();
        Ok((cam(body, self.resolver), name, others, joint_report))
    }
}
