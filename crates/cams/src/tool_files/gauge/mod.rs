//! The lift table of a gauge follower, as measuring instruments for camshafts compare it.

mod judge;
mod plan;
mod read;
mod write;

pub use plan::{GaugeTable, table};
pub use read::{GaugeRows, read};

use super::tool_file::{DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, SolvedCam, ToolFile, WrittenFile};
use crate::body::{Body, Request};
use crate::check::Check;
use crate::verify::Evidence;
use camgen_kernel::refusal::Refusal;

/// The table.
pub const FORMAT: &str = "gauge";

/// The lift table of a gauge follower.
#[derive(Debug)]
pub struct GaugeFile;

impl ToolFile for GaugeFile {
    fn check(&self) -> &'static Check {
        &judge::CHECK
    }

    fn stands_after(&self) -> &'static str {
        "inspection"
    }

    fn noun(&self) -> &'static str {
        "lift table of a gauge follower"
    }

    fn described(&self) -> &'static str {
        "the lift table of a gauge follower"
    }

    fn formats(&self) -> &'static [&'static str] {
        &[FORMAT]
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

    fn plan(&self, cam: &DrawnCam<'_>) -> Result<Option<Box<dyn Plan>>, Refusal> {
        Ok(table(cam.body, cam.request).map(|table| Box::new(table) as Box<dyn Plan>))
    }

    fn not_planned(&self) -> Refusal {
        Refusal::new("no table for a gauge follower was requested with the drawing")
    }

    fn judge(&self, cam: &SolvedCam<'_>, _file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        let text = String::from_utf8_lossy(bytes);
        let contradicted = |rows: GaugeRows| judge::contradiction(cam.body, &text, &rows).map_or(Ok(rows), Err);
        let rows = read(bytes).and_then(contradicted);
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
