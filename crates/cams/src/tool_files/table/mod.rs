//! A table of numbers of a cam, which somebody may have changed. It is only read: the table that is written is a view.

mod judge;
mod read;

pub use read::{NumberTable, read};

use super::tool_file::{ExpectedFile, FileError, JudgedFile, SolvedCam, ToolFile};
use crate::check::Check;
use camgen_kernel::refusal::Refusal;

/// A table of numbers.
#[derive(Debug)]
pub struct TableFile;

impl ToolFile for TableFile {
    fn check(&self) -> &'static Check {
        &judge::CHECK
    }

    fn stands_after(&self) -> &'static str {
        "gauge"
    }

    fn noun(&self) -> &'static str {
        "table"
    }

    fn described(&self) -> &'static str {
        "a table"
    }

    fn formats(&self) -> &'static [&'static str] {
        &[]
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        read::is_table(bytes)
    }

    fn read(&self, bytes: &[u8]) -> Result<(), Refusal> {
        read(bytes).map(drop).map_err(Refusal::new)
    }

    fn judge(&self, cam: &SolvedCam<'_>, _file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        Ok(Some(judge::judge(&cam.evidence()?, read(bytes))).into())
    }
}
