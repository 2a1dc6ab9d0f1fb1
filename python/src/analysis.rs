//! `camgen.Analysis`: the analyses of the command line by their names, with its flags as keyword arguments.

use crate::cam::{findings, report, written};
use crate::cli::args::{
    BrakeArgs, CompareArgs, DriveArgs, LawsArgs, LinkageArgs, RegimesArgs, ShaftArgs, SizeArgs, SpringArgs,
};
use crate::cli::{Failure, analyses, brake};
use crate::errors::{of_machine, ok, option, told};
use crate::machine::Machine;
use crate::options::flags;
use crate::table;
use camgen::domains::brake::BrakeMachine;
use camgen::domains::press::machine::DriveMachine;
use camgen::domains::shaft::machine::ShaftMachine;
use camgen::machine::MachineError;
use camgen::pipeline::{Judged, Writing};
use clap::{Args, Command, FromArgMatches};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;

/// The analyses, in the order of the command line.
pub(crate) const NAMES: [&str; 9] =
    ["regimes", "spring", "drive", "linkage", "shaft", "brake", "size", "laws", "compare"];

/// Why there is no analysis.
enum Why {
    Machine(MachineError),
    Failed(Failure),
    Python(PyErr),
}

impl From<Failure> for Why {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

impl From<PyErr> for Why {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

/// Flags that are parameters of `write` here, or have another form.
const NOT_HERE: [&str; 15] = [
    "set",
    "out",
    "name",
    "template",
    "force",
    "overwrite",
    "json",
    "quiet",
    "no-color",
    "dry-run",
    "watch",
    "csv",
    "svg",
    "format",
    "help",
];

/// The arguments of a command with flags, for a file that is loaded already.
fn parsed<T: Args + FromArgMatches>(command: &'static str, files: &[&str], flags: &[String]) -> Result<T, Why> {
    for flag in flags {
        let name = flag.trim_start_matches("--").split('=').next().unwrap_or_default();
        if NOT_HERE.contains(&name) {
            return Err(option(name, format!("is no option of an analysis ({command})"), None).into());
        }
    }
    let arguments = T::augment_args(Command::new(command).no_binary_name(true).disable_help_flag(true));
    let typed = files.iter().map(ToString::to_string).chain(flags.iter().cloned());
    let read = arguments.try_get_matches_from(typed).and_then(|found| T::from_arg_matches(&found));
    read.map_err(|error| {
        let text = error.render().to_string();
        let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned();
        let tip = text.lines().find_map(|line| line.trim().strip_prefix("tip: ")).map(str::to_owned);
        Why::Python(option(command, first, tip))
    })
}

/// An analysis judged, and the word that names its machine in the names of its files.
fn judged(
    name: &str,
    machine: Option<&Machine>,
    flags: &[String],
    measured: Option<String>,
) -> Result<(Judged, String), Why> {
    let file = ["machine"];
    let given = || machine.ok_or_else(|| option("machine", format!("the analysis {name} needs a machine"), None));
    let loaded = || -> Result<_, Why> {
        let machine = given()?;
        Ok((machine.of_cam()?.clone(), machine.source().0.stem().to_owned()))
    };
    let source = || -> Result<_, Why> {
        let (source, overrides) = given()?.source();
        Ok((source, overrides, source.stem().to_owned()))
    };
    let found = match name {
        "regimes" => analyses::regimes_of(&parsed::<RegimesArgs>("regimes", &file, flags)?, loaded()?)?,
        "spring" => analyses::spring_of(&parsed::<SpringArgs>("spring", &file, flags)?, loaded()?)?,
        "drive" => {
            let args = parsed::<DriveArgs>("drive", &file, flags)?;
            let (source, overrides, stem) = source()?;
            let machine = DriveMachine::of_source(source, overrides).map_err(Why::Machine)?;
            analyses::drive_of(&args, (machine, stem))?
        }
        "linkage" => analyses::linkage_of(&parsed::<LinkageArgs>("linkage", &file, flags)?, loaded()?)?,
        "shaft" => {
            let args = parsed::<ShaftArgs>("shaft", &file, flags)?;
            let (source, overrides, stem) = source()?;
            let machine = ShaftMachine::of_source(source, overrides).map_err(Why::Machine)?;
            analyses::shaft_of(&args, (machine, stem))?
        }
        "brake" => {
            let args = parsed::<BrakeArgs>("brake", &file, flags)?;
            let (source, overrides, stem) = source()?;
            let machine = BrakeMachine::of_source(source, overrides, brake::wanted(&args)).map_err(Why::Machine)?;
            return Ok((brake::judged(&args, &machine, |_| ())?, stem));
        }
        "size" => analyses::size_of(&parsed::<SizeArgs>("size", &file, flags)?, loaded()?)?,
        "laws" => {
            let machine = match machine {
                Some(machine) => (Some(machine.of_cam()?.clone()), machine.source().0.stem().to_owned()),
                None => (None, "laws".to_owned()),
            };
            analyses::laws_of(&parsed::<LawsArgs>("laws", &[], flags)?, machine)?
        }
        "compare" => {
            let path = measured.ok_or_else(|| option("measured", "give the file of the measured points", None))?;
            let args = parsed::<CompareArgs>("compare", &[&path, "machine"], flags)?;
            let loaded = loaded()?;
            analyses::compare_of(&args, || Ok(loaded))?
        }
        other => {
            let why = format!("no such analysis {other:?}; one of {}", NAMES.join(", "));
            return Err(option("name", why, None).into());
        }
    };
    Ok((Judged::new(found.0), found.1))
}

/// The analysis of a name.
pub(crate) fn of(
    py: Python<'_>,
    name: &str,
    machine: Option<&Machine>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Analysis> {
    let given = options.map(PyDictMethods::copy).transpose()?;
    let mut measured: Option<String> = None;
    if let Some(options) = &given
        && let Some(path) = options.get_item("measured")?
    {
        measured = Some(py.import("os")?.call_method1("fspath", (path,))?.extract()?);
        options.del_item("measured")?;
    }
    let flags = flags(given.as_ref())?;
    let found = py.detach(|| judged(name, machine, &flags, measured));
    let (judged, machine) = found.map_err(|why| match why {
        Why::Machine(error) => of_machine(&error),
        Why::Failed(failure) => told("SolveError", failure),
        Why::Python(error) => error,
    })?;
    let stem = judged.stem(&machine);
    Ok(Analysis { judged, stem })
}

/// The results of an analysis, judged.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug)]
pub(crate) struct Analysis {
    judged: Judged,
    stem: String,
}

impl Analysis {
    fn writing(&self, directory: PathBuf, formats: Option<Vec<String>>) -> Writing {
        Writing { formats, ..Writing::to(directory, &self.stem) }
    }
}

#[pymethods]
impl Analysis {
    #[getter]
    fn name(&self) -> &str {
        self.judged.analysis().kind.command
    }

    #[getter]
    fn passed(&self) -> bool {
        self.judged.passed()
    }

    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        findings(py, &self.judged.report().checks)
    }

    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        report(py, &py.detach(|| self.judged.report()))
    }

    /// Its tables by what the names of their files end with; the first is "".
    #[getter]
    fn tables<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (name, listed) in &self.judged.analysis().tables {
            all.set_item(name.trim_start_matches('-'), table::of(py, listed)?)?;
        }
        Ok(all)
    }

    /// The bytes of a file by its ending.
    fn bytes<'py>(&self, py: Python<'py>, ending: &str) -> PyResult<Bound<'py, PyBytes>> {
        let format = ending.rsplit('.').next().unwrap_or_default().to_owned();
        let writing = Writing { force: true, ..self.writing(PathBuf::from("output"), Some(vec![format])) };
        let files = ok(py.detach(|| self.judged.files(&writing)))?;
        let bytes =
            files.bytes(ending).ok_or_else(|| option("ending", format!("no file ends with {ending:?}"), None))?;
        Ok(PyBytes::new(py, bytes))
    }

    #[pyo3(signature = (directory, *, formats=None, name=None, force=false, overwrite=false))]
    fn write<'py>(
        &self,
        py: Python<'py>,
        directory: &Bound<'py, PyAny>,
        formats: Option<&Bound<'py, PyAny>>,
        name: Option<String>,
        force: bool,
        overwrite: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let formats = formats.map(|formats| crate::options::texts(Some(formats))).transpose()?;
        let writing = self.writing(crate::options::path("directory", directory)?, formats);
        let writing = Writing { stem: written::stem(name, &self.stem)?, force, overwrite, ..writing };
        let done = ok(py.detach(|| self.judged.files(&writing)?.commit()))?;
        report(py, &done)
    }

    fn __repr__(&self) -> String {
        let verdict = if self.passed() { "passed" } else { "FAILED" };
        format!("<camgen.Analysis {} of {}, {verdict}>", self.name(), self.judged.analysis().machine)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        written::framed(py, self.bytes(py, ".html")?.as_bytes())
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<Option<String>> {
        Ok(self.bytes(py, ".svg").ok().map(|svg| String::from_utf8_lossy(svg.as_bytes()).into_owned()))
    }
}
