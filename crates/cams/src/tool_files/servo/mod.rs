//! Tables for a servo drive that moves as the follower would.

mod judge;
mod plan;
mod read;
mod write;

pub use read::{ServoRows, read};

use super::tool_file::{
    DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, SolvedCam, ToolFile, ToolFileFacts, WrittenFile,
};
use crate::body::{Body, Request};
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

/// What it is called and where it stands.
const FACTS: ToolFileFacts = ToolFileFacts {
    noun: "table for a servo drive",
    described: "a table for a servo drive",
    formats: &FORMATS,
    not_planned: "no table for a servo drive was requested with the drawing",
    check: &judge::CHECK,
    stands_after: "points",
};

impl ToolFile for ServoFile {
    fn facts(&self) -> &'static ToolFileFacts {
        &FACTS
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

    fn plan(&self, cam: &DrawnCam<'_>, named: bool) -> Result<Option<Box<dyn Plan>>, Refusal> {
        if !named {
            return Ok(None);
        }
        let table = plan::table(cam.body, cam.request).map_err(|why| why.context("no table for a servo drive"))?;
        Ok(Some(Box::new(table)))
    }

    fn judge(&self, cam: &SolvedCam<'_>, _file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        let text = String::from_utf8_lossy(bytes);
        let table = read(bytes).and_then(|rows| judge::contradiction(cam.body, &text, &rows).map_or(Ok(rows), Err));
        let written = WrittenServo { format: "the table", table };
        Ok(judge::judge(&cam.evidence()?, &[written]).into())
    }
}

impl Plan for ServoTable {
    fn write(&self, cam: &DrawnCam<'_>, mark: &str) -> Vec<WrittenFile> {
        write::write(cam.body, self, mark)
    }

    fn judge(&self, evidence: &Evidence<'_>, _request: &Request, files: &[WrittenFile]) -> JudgedFile {
        let mut written = Vec::with_capacity(files.len());
        for file in files {
            written.extend(file.bytes.iter().map(|bytes| WrittenServo { format: file.format, table: read(bytes) }));
        }
        judge::judge(evidence, &written).into()
    }
}
