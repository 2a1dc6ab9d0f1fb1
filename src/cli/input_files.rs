//! What a command reads for its user. The program, not the library, has one record of it.

use super::Failure;
use camgen::Machine;
use camgen::document::InputFiles;
use camgen::machine::{MachineError, MachineSource};
use std::path::PathBuf;
use std::sync::OnceLock;

static FILES: OnceLock<InputFiles> = OnceLock::new();

/// Lets machine files name files in these folders and below them; to be called before anything is read.
pub(super) fn allow(folders: &[PathBuf]) -> Result<(), Failure> {
    let files = InputFiles::allowing(folders).map_err(|why| Failure(format!("--allow-path: {why}")))?;
    FILES.get_or_init(|| files);
    Ok(())
}

/// Reads files, and records them.
pub(super) fn files() -> &'static InputFiles {
    FILES.get_or_init(InputFiles::default)
}

/// The text of an embedded machine, or of a file.
pub(super) fn source(name: &str) -> Result<MachineSource, MachineError> {
    MachineSource::load_with(name, files())
}

/// What is made of the text of an embedded machine, or of a file, with the stem of its files.
pub(super) fn made_of<T>(
    name: &str,
    make: impl FnOnce(&MachineSource) -> Result<T, MachineError>,
) -> Result<(T, String), Failure> {
    let source = source(name).map_err(Failure::new)?;
    Ok((make(&source).map_err(Failure::new)?, source.stem().to_owned()))
}

/// An embedded machine, or that of a file, with the stem of its files.
pub(super) fn machine(name: &str, overrides: &[String]) -> Result<(Machine, String), Failure> {
    made_of(name, |source| Machine::of_source(source, overrides))
}
