//! camgen from Python: the module `camgen._camgen`. Names, units and shapes are documented in `camgen/_camgen.pyi`.

mod analysis;
mod cam;
/// The command line of the program, of the same sources.
#[path = "../../src/cli/mod.rs"]
mod cli;
mod errors;
mod machine;
mod motion;
mod options;
mod study;
mod table;

use pyo3::prelude::*;
use pyo3::types::PyDict;

/// An analysis that needs no machine, or one that is given.
#[pyfunction]
#[pyo3(signature = (name, machine=None, /, **options))]
fn analyse(
    py: Python<'_>,
    name: &str,
    machine: Option<&machine::Machine>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<analysis::Analysis> {
    analysis::of(py, name, machine, options)
}

/// The names of the machine files in the package.
#[pyfunction]
fn machines() -> Vec<&'static str> {
    camgen::catalogue::catalogue().names()
}

/// The names of the analyses.
#[pyfunction]
fn analyses() -> Vec<&'static str> {
    analysis::NAMES.to_vec()
}

/// Runs a command line, the name of the program first, and returns its exit code.
#[pyfunction]
fn command(py: Python<'_>, typed: Vec<Bound<'_, PyAny>>) -> PyResult<u8> {
    let typed = typed.iter().map(|word| options::path("typed", word).map(std::path::PathBuf::into_os_string));
    let typed: Vec<std::ffi::OsString> = typed.collect::<PyResult<_>>()?;
    Ok(py.detach(|| cli::main(typed)))
}

#[pymodule(gil_used = false)]
fn _camgen(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<machine::Machine>()?;
    module.add_class::<cam::Cam>()?;
    module.add_class::<cam::Drawing>()?;
    module.add_class::<cam::Proven>()?;
    module.add_class::<analysis::Analysis>()?;
    module.add_class::<motion::Motion>()?;
    module.add_class::<motion::Law>()?;
    module.add_class::<study::Study>()?;
    module.add_function(wrap_pyfunction!(study::write_shard, module)?)?;
    module.add_function(wrap_pyfunction!(motion::laws, module)?)?;
    module.add_function(wrap_pyfunction!(motion::law, module)?)?;
    module.add_function(wrap_pyfunction!(analyse, module)?)?;
    module.add_function(wrap_pyfunction!(machines, module)?)?;
    module.add_function(wrap_pyfunction!(analyses, module)?)?;
    module.add_function(wrap_pyfunction!(command, module)?)
}
