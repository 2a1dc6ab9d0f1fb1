//! Errors of the library as the exceptions of `camgen/_errors.py`, each with its faults.

use camgen::machine::{FileFault, MachineError};
use camgen::pipeline::Error;
use camgen::refusal::Refusal;
use camgen::study::StudyError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// One fault: what is wrong, of which key, where, and what would be right.
pub(crate) struct Fault {
    message: String,
    key: Option<String>,
    place: Option<String>,
    remedy: Option<String>,
}

impl From<&FileFault> for Fault {
    fn from(fault: &FileFault) -> Self {
        let place = fault.place.as_ref();
        Self {
            message: fault.message.clone(),
            key: fault.key.clone(),
            place: place.map(|at| format!("{}:{}:{}", at.source, at.line, at.column)),
            remedy: fault.help.clone(),
        }
    }
}

impl From<&Refusal> for Fault {
    fn from(refusal: &Refusal) -> Self {
        let Refusal { what, place, remedy, .. } = refusal;
        Self {
            message: what.clone(),
            key: None,
            place: place.clone(),
            remedy: remedy.as_ref().map(ToString::to_string),
        }
    }
}

/// An exception of a name, with a text and its faults; without faults, the text is the only one.
fn raised(class: &str, text: String, faults: Vec<Fault>) -> PyErr {
    Python::attach(|py| {
        let made = || -> PyResult<Bound<'_, PyAny>> {
            let errors = py.import("camgen._errors")?;
            let fault = errors.getattr("Fault")?;
            let all = faults.into_iter().map(|one| fault.call1((one.message, one.key, one.place, one.remedy)));
            let all = PyTuple::new(py, all.collect::<PyResult<Vec<_>>>()?)?;
            errors.getattr(class)?.call1((text, all))
        };
        match made() {
            Ok(error) => PyErr::from_value(error),
            Err(other) => other,
        }
    })
}

/// A machine with faults.
pub(crate) fn of_machine(error: &MachineError) -> PyErr {
    raised("MachineError", error.to_string(), error.faults.iter().map(Fault::from).collect())
}

/// A study that is refused, or whose files cannot be written.
pub(crate) fn of_study(error: &StudyError) -> PyErr {
    match error {
        StudyError::Faults(faults) => {
            raised("MachineError", error.to_string(), faults.iter().map(Fault::from).collect())
        }
        StudyError::Refused(refusal) => refused("FilesError", refusal),
    }
}

/// What is refused before there is a cam, by the class of its exception.
pub(crate) fn refused(class: &str, refusal: &Refusal) -> PyErr {
    raised(class, refusal.to_string(), vec![refusal.into()])
}

/// An option of a call that is wrong: the parameter, why, and what would be right.
pub(crate) fn option(parameter: &str, why: impl std::fmt::Display, remedy: Option<String>) -> PyErr {
    let text = format!("{parameter}: {why}");
    let message = why.to_string();
    raised("OptionError", text, vec![Fault { message, key: Some(parameter.to_owned()), place: None, remedy }])
}

/// A text alone, by the class of its exception.
pub(crate) fn told(class: &str, text: impl std::fmt::Display) -> PyErr {
    let message = text.to_string();
    raised(class, message.clone(), vec![Fault { message, key: None, place: None, remedy: None }])
}

/// An error on the way from a machine to its files.
pub(crate) fn of(error: &Error) -> PyErr {
    match error {
        Error::Machine(error) => of_machine(error),
        Error::Motion(refusal) | Error::Solve(refusal) => refused("SolveError", refusal),
        Error::Draw(refusal) | Error::Section(refusal) | Error::Cutter(refusal) => refused("DrawError", refusal),
        Error::Proof(refusal) => refused("ProofError", refusal),
        Error::Read(refusal) => refused("ReadError", refusal),
        Error::Format(refusal) => refused("FilesError", refusal),
        Error::Refused(_) | Error::NoOutline(_) => told("RefusedError", error),
        Error::NoSuchFormat { .. } | Error::Unfit { .. } => option("formats", error, None),
        other => told("FilesError", other),
    }
}

/// A panic of a thread or a result of the library.
pub(crate) fn ok<T>(result: Result<T, Error>) -> PyResult<T> {
    result.map_err(|error| of(&error))
}
