//! Tables for a servo drive that moves as the follower would.

mod judge;
mod plan;
mod read;
mod write;

pub use read::{ServoRows, read};

use super::tool_file::{DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, SolvedCam, ToolFile, WrittenFile};
use crate::body::{Body, Request};
use crate::check::Check;
use crate::verify::Evidence;
use camgen_kernel::refusal::Refusal;
use judge::WrittenServo;
use plan::ServoTable;
use write::{CSV, FORMATS, ISG, TWINCAT, XYVA};

/// The names of the formats.
pub const NAMES: [&str; 4] = [CSV, XYVA, TWINCAT, ISG];

/// Tables for a servo drive.
#[derive(Debug)]
pub struct ServoFile;

impl ToolFile for ServoFile {
    fn check(&self) -> &'static Check {
        &judge::CHECK
    }

    fn stands_after(&self) -> &'static str {
        "points"
    }

    fn noun(&self) -> &'static str {
        "table for a servo drive"
    }

    fn described(&self) -> &'static str {
        "a table for a servo drive"
    }

    fn formats(&self) -> &'static [&'static str] {
        &FORMATS
    }

    fn unfit(&self, body: &dyn Body) -> Option<&'static str> {
        plan::unfit(body)
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        read::is_servo(bytes)
    }

    fn read(&self, bytes: &[u8]) -> Result<(), Refusal> {
        read(bytes).map(drop).map_err(Refusal::new)
    }

    fn plan(&self, cam: &DrawnCam<'_>) -> Result<Option<Box<dyn Plan>>, Refusal> {
        if !FORMATS.iter().any(|format| cam.request.formats.contains(format)) {
            return Ok(None);
        }
        let table = plan::table(cam.body, cam.request).map_err(|why| why.context("no table for a servo drive"))?;
        Ok(Some(Box::new(table)))
    }

    fn judge(&self, cam: &SolvedCam<'_>, _file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        let text = String::from_utf8_lossy(bytes);
        let contradicted = |rows: ServoRows| judge::contradiction(cam.body, &text, &rows).map_or(Ok(rows), Err);
        let written = WrittenServo { format: "the table", table: read(bytes).and_then(contradicted) };
        Ok(judge::judge(&cam.evidence()?, &[written]).into())
    }
}

impl Plan for ServoTable {
    fn write(&self, cam: &DrawnCam<'_>, mark: &str) -> Vec<WrittenFile> {
        write::write(cam.body, self, mark)
    }

    fn judge(&self, evidence: &Evidence<'_>, _request: &Request, files: &[WrittenFile]) -> JudgedFile {
        let read = |file: &WrittenFile| {
            let bytes = file.bytes.as_ref().ok()?;
            Some(WrittenServo { format: file.format, table: read(bytes) })
        };
        let written: Vec<WrittenServo> = files.iter().filter_map(read).collect();
        judge::judge(evidence, &written).into()
    }
}
