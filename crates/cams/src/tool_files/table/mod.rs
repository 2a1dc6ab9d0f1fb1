//! A table of numbers of a cam, which somebody may have changed. It is only read: the table that is written is a view.

mod judge;
mod read;

pub use read::{NumberTable, read};

use super::tool_file::{ExpectedFile, FileError, JudgedFile, SolvedCam, ToolFile, ToolFileFacts};
use camgen_kernel::refusal::Refusal;

/// A table of numbers.
#[derive(Debug)]
pub struct TableFile;

/// What it is called and where it stands.
const FACTS: ToolFileFacts = ToolFileFacts {
    noun: "table",
    described: "a table",
    formats: &[],
    not_planned: "",
    check: &judge::CHECK,
    stands_after: "gauge",
};

impl ToolFile for TableFile {
    fn facts(&self) -> &'static ToolFileFacts {
        &FACTS
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
