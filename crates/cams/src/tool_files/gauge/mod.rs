//! The lift table of a gauge follower, as measuring instruments for camshafts compare it.

mod judge;
mod plan;
mod read;
mod write;

pub use plan::{GaugeTable, table};
pub use read::{GaugeRows, read};

use super::tool_file::{
    DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, SolvedCam, ToolFile, ToolFileFacts, WrittenFile,
};
use crate::body::{Body, Request};
use crate::verify::Evidence;
use camgen_kernel::refusal::Refusal;

/// The table.
pub const FORMAT: &str = "gauge";

/// The lift table of a gauge follower.
#[derive(Debug)]
pub struct GaugeFile;

/// What it is called and where it stands.
const FACTS: ToolFileFacts = ToolFileFacts {
    noun: "lift table of a gauge follower",
    described: "the lift table of a gauge follower",
    formats: &[FORMAT],
    not_planned: "no table for a gauge follower was requested with the drawing",
    check: &judge::CHECK,
    stands_after: "inspection",
};

impl ToolFile for GaugeFile {
    fn facts(&self) -> &'static ToolFileFacts {
        &FACTS
    }

    fn unfit(&self, body: &dyn Body) -> Option<&'static str> {
        plan::unfit(body)
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        read::is_gauge(bytes)
    }

    fn read(&self, bytes: &[u8]) -> Result<(), Refusal> {
        read(bytes).map(drop).map_err(Refusal::new)
    }

    fn plan(&self, cam: &DrawnCam<'_>, _named: bool) -> Result<Option<Box<dyn Plan>>, Refusal> {
        Ok(table(cam.body, cam.request).map(|table| Box::new(table) as Box<dyn Plan>))
    }

    fn judge(&self, cam: &SolvedCam<'_>, _file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        let text = String::from_utf8_lossy(bytes);
        let rows = read(bytes).and_then(|rows| judge::contradiction(cam.body, &text, &rows).map_or(Ok(rows), Err));
        Ok(Some(judge::judge(&cam.evidence()?, &rows)).into())
    }
}

impl Plan for GaugeTable {
    fn write(&self, cam: &DrawnCam<'_>, mark: &str) -> Vec<WrittenFile> {
        let bytes = Ok(write::write(cam.body, self, mark));
        vec![WrittenFile { format: FORMAT, ending: "-gauge.csv".to_owned(), bytes }]
    }

    fn judge(&self, evidence: &Evidence<'_>, _request: &Request, files: &[WrittenFile]) -> JudgedFile {
        let written = files.first().and_then(|file| file.bytes.as_ref().ok());
        written.map(|bytes| judge::judge(evidence, &read(bytes))).into()
    }
}
