//! Everything that can go wrong on the way from a machine file to the files of a cam.

use crate::body::{DrawError, SolveError};
use crate::machine::MachineError;
use crate::reading::ReadError;
use crate::write::FormatError;
use crate::write::files::FilesError;
use crate::write::proof::ProofError;

/// Why there is no cam, no drawing, no proof or no file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The machine file has faults; all of them are told.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// No cam can be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The outline or the flank cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The cut file as written does not hold what was drawn: a fault of camgen.
    #[error(transparent)]
    Proof(#[from] ProofError),
    /// A file given to be checked is no DXF file.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// No such format.
    #[error("no such format `{name}`; one of {known}")]
    NoSuchFormat {
        /// What was asked for.
        name: String,
        /// What there is.
        known: String,
    },
    /// The cam cannot have a format that was asked for.
    #[error("no {format} file: {why}; give what is missing, or leave {format} out of the formats")]
    Unfit {
        /// The format.
        format: &'static str,
        /// Why the cam cannot have it.
        why: &'static str,
    },
    /// A check failed, and nobody insisted.
    #[error("a check failed: {0}")]
    Refused(String),
    /// There is no outline to write, whoever insists.
    #[error("{0}; there is no outline that could be written")]
    NoOutline(String),
    /// A format cannot be made.
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
