//! Everything that can go wrong on the way from a machine file to the files of a cam.

use crate::body::{DrawError, RateError, SolveError};
use crate::machine::MachineError;
use crate::reading::ReadError;
use crate::reading::step::StepError;
use crate::write::FormatError;
use crate::write::files::FilesError;
use crate::write::proof::ProofError;

/// Why there is no cam, no drawing, no proof or no file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The machine file has faults; all of them are reported.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// No cam can be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A tolerance of velocity or acceleration that does not fit the cam.
    #[error(transparent)]
    Rate(#[from] RateError),
    /// The outline or the flank cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The cut file as written does not hold what was drawn: a fault of camgen.
    #[error(transparent)]
    Proof(#[from] ProofError),
    /// A file to be checked is neither a DXF nor a STEP file.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A file to be checked begins as a STEP file and is none.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The section to be checked is not told, or there is no such section.
    #[error("{0}")]
    Section(String),
    /// Unknown format.
    #[error("no such format `{name}`; one of {known}")]
    NoSuchFormat {
        /// The format requested.
        name: String,
        /// The formats there are.
        known: String,
    },
    /// The cam cannot have a format that was requested.
    #[error("no {format} file: {why}; give what is missing, or leave {format} out of the formats")]
    Unfit {
        /// The format.
        format: &'static str,
        /// Why the cam cannot have it.
        why: &'static str,
    },
    /// The point table would have more rows than are written.
    #[error(
        "the point table would have {rows} rows for each of {sections} sections, more than {most} in all; give --samples {} at most",
        most / sections.max(&1)
    )]
    TooManyRows {
        /// Rows of a section.
        rows: u32,
        /// Sections.
        sections: u32,
        /// The most rows of a table.
        most: u32,
    },
    /// A check failed, and `force` was not set.
    #[error("a check failed: {0}")]
    Refused(String),
    /// There is no outline to write, even with `force`.
    #[error("{0}; there is no outline that could be written")]
    NoOutline(String),
    /// A file cannot be made in its format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// Files cannot be written.
    #[error(transparent)]
    Files(#[from] FilesError),
}

macro_rules! from_parts {
    ($($part:ty),*) => {$(
        impl From<$part> for Error {
            fn from(error: $part) -> Self {
                Self::Solve(error.into())
            }
        }
    )*};
}

from_parts!(crate::body::disc::DiscError, crate::body::wedge::WedgeError, crate::body::conoid::ConoidError);
