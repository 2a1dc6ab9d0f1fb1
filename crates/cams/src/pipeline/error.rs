//! Everything that can go wrong from a machine file to the files of a cam.

use crate::machine::MachineError;
use crate::tool_files::FileError;
use crate::write::files::FilesError;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Remedy, Text};

/// Why there is no cam, no drawing, no proof or no file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The machine file has faults; all of them are reported.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// A motion given by code is impossible or contradicts itself.
    #[error(transparent)]
    Motion(#[from] Refusal),
    /// No cam can be solved.
    #[error(transparent)]
    Solve(Refusal),
    /// The outline, the flank or a table of points cannot be drawn, or a tolerance does not fit the cam.
    #[error(transparent)]
    Draw(Refusal),
    /// The cut file as written does not hold what was drawn: a fault of camgen.
    #[error(transparent)]
    Proof(Refusal),
    /// A file to be checked is neither a DXF nor a STEP file, or cannot be read as one.
    #[error(transparent)]
    Read(Refusal),
    /// The section to be checked is not given, or there is no such section.
    #[error(transparent)]
    Section(Refusal),
    /// The radius of the cutter of a path to be checked is not given.
    #[error(transparent)]
    Cutter(Refusal),
    /// Unknown format.
    #[error("no such format `{name}`; one of {known}")]
    NoSuchFormat {
        /// The format requested.
        name: String,
        /// The formats there are.
        known: String,
    },
    /// The cam cannot have a format that was requested.
    #[error("no {format} file: {why}; leave {format} out of the formats")]
    Unfit {
        /// The format.
        format: &'static str,
        /// Why the cam cannot have it.
        why: &'static str,
    },
    /// A check failed, and `force` was not set.
    #[error("a check failed: {0}")]
    Refused(String),
    /// There is no outline to write, even with `force`.
    #[error("{0}; there is no outline that could be written")]
    NoOutline(String),
    /// A file cannot be made in its format, or would be too large.
    #[error(transparent)]
    Format(Refusal),
    /// Files cannot be written.
    #[error(transparent)]
    Files(#[from] FilesError),
}

impl From<FileError> for Error {
    fn from(error: FileError) -> Self {
        match error {
            FileError::Read(why) => Self::Read(why),
            FileError::Section(why) => Self::Section(why),
            FileError::Cutter(why) => Self::Cutter(why),
            FileError::Request(why) => Self::Draw(why),
        }
    }
}

impl Error {
    /// The changes of the machine file in its remedy, which were tried.
    #[must_use]
    pub fn remedies(&self) -> Vec<&Remedy> {
        let (Self::Motion(refusal)
        | Self::Solve(refusal)
        | Self::Draw(refusal)
        | Self::Proof(refusal)
        | Self::Read(refusal)
        | Self::Section(refusal)
        | Self::Cutter(refusal)
        | Self::Format(refusal)) = self
        else {
            return Vec::new();
        };
        refusal.remedy.as_ref().map_or_else(Vec::new, Text::remedies)
    }
}
