//! `camgen.Machine`: a machine file read once, and what is made of it.

use crate::analysis::{self, Analysis};
use crate::cam::Cam;
use crate::cli::args::parse;
use crate::errors::{of_machine, ok, option, refused};
use crate::motion::Motion;
use crate::options::{overrides, quantity, texts, word};
use camgen::analysis::size::FreeDimension;
use camgen::domains::brake::{BrakeMachine, BrakeOutput};
use camgen::domains::press::bed_motion::End;
use camgen::domains::press::machine::DriveMachine;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::domains::press::wedge::LAW_TOLERANCE;
use camgen::domains::press::{MachineOfPress, SpecOfPress};
use camgen::domains::shaft::machine::ShaftMachine;
use camgen::machine::{MachineSource, valid_rpm};
use camgen::pipeline::Spec;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// What a file is read as, when it is loaded.
const READ_AS: [&str; 4] = ["cam", "drive", "shaft", "brake"];

/// Stations of the paper's solver by default, as on the command line.
const STATIONS: u32 = 1800;

/// Speeds of the main shaft, rpm.
#[derive(Debug, Clone)]
enum Speeds {
    None,
    Several(Vec<f64>),
    Range(f64, f64),
}

impl Speeds {
    fn of(given: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let Some(given) = given.filter(|given| !given.is_none()) else { return Ok(Self::None) };
        let valid = |rpm| valid_rpm(rpm).map_err(|why| option("rpm", why, None));
        if let Ok(text) = given.extract::<String>() {
            return match parse::speed(&text).map_err(|why| option("rpm", why, None))? {
                parse::Speed::One(rpm) => Ok(Self::Several(vec![rpm])),
                parse::Speed::Range(from, to) => Ok(Self::Range(from, to)),
            };
        }
        if let Ok(rpm) = given.extract::<f64>() {
            return Ok(Self::Several(vec![valid(rpm)?]));
        }
        let all: Vec<f64> = given
            .extract()
            .map_err(|_| option("rpm", "must be a number, several numbers, or a range \"20..35\"", None))?;
        all.into_iter().map(valid).collect::<PyResult<_>>().map(Self::Several)
    }

    /// The one speed of a cam that is not a conoid.
    fn one(&self) -> PyResult<Option<f64>> {
        match self {
            Self::None => Ok(None),
            Self::Several(all) if all.len() == 1 => Ok(all.first().copied()),
            _ => Err(option("rpm", "this cam is cut for one speed", Some("give one number".into()))),
        }
    }
}

/// How a cam is solved, as `Machine.cam` takes it.
struct Wanted {
    kind: String,
    speeds: Speeds,
    motion: Option<Arc<dyn camgen::Motion>>,
    solver: Solver,
    balance: ExactOn,
    residual: Option<f64>,
    cutter_radius: Option<f64>,
}

/// A machine file with overrides, every value in range.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug, Clone)]
pub(crate) struct Machine {
    source: Arc<MachineSource>,
    overrides: Vec<String>,
    read_as: String,
    name: String,
    /// Where it is read as that of a cam.
    machine: Option<camgen::Machine>,
}

impl Machine {
    fn read(py: Python<'_>, source: Arc<MachineSource>, overrides: Vec<String>, read_as: &str) -> PyResult<Self> {
        let text = Arc::clone(&source);
        let all = overrides.clone();
        let read = move || match read_as {
            "cam" => camgen::Machine::of_source(&text, &all).map(|machine| (machine.name().to_owned(), Some(machine))),
            "drive" => DriveMachine::of_source(&text, &all).map(|_| (text.stem().to_owned(), None)),
            "shaft" => ShaftMachine::of_source(&text, &all).map(|_| (text.stem().to_owned(), None)),
            _ => BrakeMachine::of_source(&text, &all, BrakeOutput::Figures)
                .map(|machine| (machine.name().to_owned(), None)),
        };
        if !READ_AS.contains(&read_as) {
            return Err(option("read_as", format!("no such word {read_as:?}; one of {}", READ_AS.join(", ")), None));
        }
        let (name, machine) = py.detach(read).map_err(|error| of_machine(&error))?;
        Ok(Self { source, overrides, read_as: read_as.to_owned(), name, machine })
    }

    /// Its text, its overrides and the start of the names of its files.
    pub(crate) fn source(&self) -> (&MachineSource, &[String]) {
        (&self.source, &self.overrides)
    }

    /// The machine of a cam.
    pub(crate) fn of_cam(&self) -> PyResult<&camgen::Machine> {
        self.machine.as_ref().ok_or_else(|| {
            let why = format!("this machine is read as that of a {}, which has no cam of its own", self.read_as);
            option("read_as", why, Some(format!("machine.analyse({:?})", self.read_as)))
        })
    }

    /// The machine with what is left free to be chosen and at an end of the stroke, and the start of the names of its files.
    fn chosen(&self, free: &[String], end: Option<End>) -> PyResult<(camgen::Machine, String)> {
        let own = self.of_cam()?;
        let table = own.follower_table();
        let place = |free: &String| {
            Ok(match word::<FreeDimension>("free", Some(free))? {
                Some(FreeDimension::Pivot) => format!("{table}.pivot_distance=auto"),
                _ => format!("{table}.offset=auto"),
            })
        };
        let places: Vec<String> = free.iter().map(place).collect::<PyResult<_>>()?;
        let machine = if places.is_empty() {
            own.clone()
        } else {
            let all = self.overrides.iter().cloned().chain(places).chain(["cam.base_radius=auto".to_owned()]);
            camgen::Machine::of_source(&self.source, &all.collect::<Vec<_>>()).map_err(|error| of_machine(&error))?
        };
        let stem = self.source.stem().to_owned();
        let Some(end) = end else { return Ok((machine, stem)) };
        let stem = if end == End::Inner { format!("{stem}-inner") } else { stem };
        Ok((machine.at_end(end).map_err(|why| refused("SolveError", &why))?, stem))
    }

    /// The specification of a cam.
    fn spec(mut machine: camgen::Machine, wanted: Wanted) -> PyResult<Spec> {
        let Wanted { kind, speeds, motion, solver, balance, residual, cutter_radius } = wanted;
        if let Some(radius) = cutter_radius {
            machine.ask_for_cutter(radius);
        }
        let design = |machine: &camgen::Machine| {
            machine.press().map(|press| press.design_rpm).map_err(|why| refused("SolveError", &why))
        };
        let of_press = |machine: &camgen::Machine| match speeds.one()? {
            Some(rpm) => Ok(rpm),
            None => design(machine),
        };
        if let Some(motion) = motion {
            if kind != "make" {
                return Err(option("motion", format!("a {kind} cam has its own motion"), Some("kind=\"make\"".into())));
            }
            return Ok(Spec::of_motion(machine, motion, speeds.one()?));
        }
        match kind.as_str() {
            "make" => Spec::of_program(machine, speeds.one()?).ok_or_else(|| {
                let remedy = "give [motion] and [[motion.segment]], or motion=".to_owned();
                option("kind", "the machine has no motion, which `make` needs", Some(remedy))
            }),
            "rotary" => of_press(&machine).map(|rpm| Spec::rotary(machine, rpm)),
            "compensator" => of_press(&machine).map(|rpm| Spec::compensator(machine, rpm)),
            "translating" => of_press(&machine).map(|rpm| Spec::translating(machine, rpm, solver, balance)),
            "conoid" => match speeds {
                Speeds::Range(from, to) => residual
                    .map(|limit| Spec::conoid_within(machine, (from, to), limit))
                    .ok_or_else(|| option("residual", "a range of speeds needs the largest residual force", None)),
                Speeds::Several(all) => Ok(Spec::conoid(machine, all, residual)),
                Speeds::None => design(&machine).map(|rpm| Spec::conoid(machine, vec![rpm], residual)),
            },
            other => {
                let known = "make, rotary, translating, conoid, compensator";
                Err(option("kind", format!("no such kind {other:?}; one of {known}"), None))
            }
        }
    }
}

#[pymethods]
impl Machine {
    #[staticmethod]
    #[pyo3(signature = (name_or_path, overrides=None, *, read_as="cam"))]
    fn load(
        py: Python<'_>,
        name_or_path: &Bound<'_, PyAny>,
        overrides: Option<&Bound<'_, PyDict>>,
        read_as: &str,
    ) -> PyResult<Self> {
        let path: String = py.import("os")?.call_method1("fspath", (name_or_path,))?.extract()?;
        let source = py.detach(|| MachineSource::load(&path)).map_err(|error| of_machine(&error))?;
        Self::read(py, Arc::new(source), self::overrides(overrides)?, read_as)
    }

    #[staticmethod]
    #[pyo3(signature = (text, overrides=None, *, name="machine", read_as="cam"))]
    fn from_toml(
        py: Python<'_>,
        text: &str,
        overrides: Option<&Bound<'_, PyDict>>,
        name: &str,
        read_as: &str,
    ) -> PyResult<Self> {
        let source = py.detach(|| MachineSource::from_toml(name, text));
        Self::read(py, Arc::new(source), self::overrides(overrides)?, read_as)
    }

    #[staticmethod]
    #[pyo3(signature = (data, overrides=None, *, name="machine", read_as="cam"))]
    fn from_dict(
        py: Python<'_>,
        data: &Bound<'_, PyDict>,
        overrides: Option<&Bound<'_, PyDict>>,
        name: &str,
        read_as: &str,
    ) -> PyResult<Self> {
        let text: String = py.import("camgen._toml")?.getattr("written")?.call1((data,))?.extract()?;
        Self::from_toml(py, &text, overrides, name, read_as)
    }

    /// The same file with more overrides; its text is not read again.
    fn with_overrides(&self, py: Python<'_>, overrides: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut all = self.overrides.clone();
        for added in self::overrides(Some(overrides))? {
            let key = added.split_once('=').map(|(key, _)| format!("{key}="));
            all.retain(|other| key.as_ref().is_none_or(|key| !other.starts_with(key.as_str())));
            all.push(added);
        }
        Self::read(py, Arc::clone(&self.source), all, &self.read_as)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn stem(&self) -> &str {
        self.source.stem()
    }

    #[getter]
    fn motion(&self) -> Option<Motion> {
        let (motion, _) = self.machine.as_ref()?.motion()?;
        Some(Motion(motion))
    }

    /// Every value that has an effect on a kind of cam, defaults too, as it was typed.
    #[pyo3(signature = (kind=None))]
    fn values<'py>(&self, py: Python<'py>, kind: Option<&str>) -> PyResult<Bound<'py, PyDict>> {
        let machine = self.of_cam()?;
        let kind = kind.unwrap_or_else(|| own_kind(machine));
        let all = PyDict::new(py);
        for input in machine.inputs(kind) {
            all.set_item(input.key, input.typed)?;
        }
        Ok(all)
    }

    #[pyo3(signature = (kind=None, *, rpm=None, motion=None, end=None, free=None, solver="ode", stations=None, balance="braking",
                        residual=None, cutter_diameter=None, cutter_radius=None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn cam(
        &self,
        py: Python<'_>,
        kind: Option<&str>,
        rpm: Option<&Bound<'_, PyAny>>,
        motion: Option<&Motion>,
        end: Option<&str>,
        free: Option<&Bound<'_, PyAny>>,
        solver: &str,
        stations: Option<u32>,
        balance: &str,
        residual: Option<&Bound<'_, PyAny>>,
        cutter_diameter: Option<&Bound<'_, PyAny>>,
        cutter_radius: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Cam> {
        let solver = match (solver, stations) {
            ("ode", None) => Solver::Ode { tolerance: LAW_TOLERANCE },
            ("ode", Some(_)) => return Err(option("stations", "belongs to solver=\"paper\"", None)),
            ("paper", stations) => Solver::Paper { stations: stations.unwrap_or(STATIONS) },
            (other, _) => return Err(option("solver", format!("no such word {other:?}; one of ode, paper"), None)),
        };
        let diameter = quantity("cutter_diameter", cutter_diameter, "m", parse::cutter_diameter)?;
        let radius = quantity("cutter_radius", cutter_radius, "m", parse::cutter_radius)?;
        if diameter.is_some() && radius.is_some() {
            return Err(option("cutter_radius", "is given twice, by its diameter as well", None));
        }
        let (machine, stem) = self.chosen(&texts(free)?, word("end", end)?)?;
        let kind = kind.unwrap_or_else(|| if motion.is_some() { "make" } else { own_kind(&machine) });
        let speeds = Speeds::of(rpm)?;
        let range = if let Speeds::Range(from, to) = speeds { Some([from, to]) } else { None };
        let cutter_radius = diameter.or(radius);
        let wanted = Wanted {
            kind: kind.to_owned(),
            speeds,
            motion: motion.map(|motion| Arc::clone(&motion.0)),
            solver,
            balance: word("balance", Some(balance))?.unwrap_or(ExactOn::Braking),
            residual: quantity("residual", residual, "N", parse::force)?,
            cutter_radius,
        };
        let spec = Self::spec(machine, wanted)?;
        let assembly = ok(py.detach(|| spec.assemble()))?;
        let stem = assembly.first().stem(&stem, range);
        Ok(Cam { assembly, stem, cutter_radius })
    }

    #[pyo3(signature = (name, /, **options))]
    fn analyse(&self, py: Python<'_>, name: &str, options: Option<&Bound<'_, PyDict>>) -> PyResult<Analysis> {
        analysis::of(py, name, Some(self), options)
    }

    fn __repr__(&self) -> String {
        let overrides = if self.overrides.is_empty() { String::new() } else { format!(" {:?}", self.overrides) };
        format!("<camgen.Machine {:?} from {}{overrides}>", self.name, self.source.stem())
    }
}

/// The kind of cam that a machine is for, as no other is named.
fn own_kind(machine: &camgen::Machine) -> &'static str {
    if machine.motion().is_some() { "make" } else { "rotary" }
}
