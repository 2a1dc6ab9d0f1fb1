//! Lists of places for a measuring machine: as a table, as plain lines of numbers and as a DMIS program, with a sheet on which the places are
//! numbered.

mod judge;
mod plan;
mod read;
mod write;

pub(super) use judge::angle_of_place;
pub use read::{ReadPlace, read};

use super::tool_file::{
    DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, SolvedCam, ToolFile, ToolFileFacts, WrittenFile, best_of_cuts,
};
use crate::body::{Body, Request};
use crate::verify::Evidence;
use crate::write::{Rendering, endings_of_outlines};
use camgen_kernel::refusal::Refusal;
use judge::WrittenInspection;
use plan::InspectionList;

/// The lists of every outline, and the sheet of each.
pub const FORMAT: &str = "inspect";

/// Lists of places for a measuring machine.
#[derive(Debug)]
pub struct InspectionFile;

/// What it is called and where it stands.
const FACTS: ToolFileFacts = ToolFileFacts {
    noun: "list of places",
    described: "a list of places for a measuring machine",
    formats: &[FORMAT],
    not_planned: "no list of places was requested with the drawing",
    check: &judge::CHECK,
    stands_after: "servo",
};

impl ToolFile for InspectionFile {
    fn facts(&self) -> &'static ToolFileFacts {
        &FACTS
    }

    fn unfit(&self, body: &dyn Body) -> Option<&'static str> {
        plan::unfit(body)
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        read::is_inspection(bytes)
    }

    fn read(&self, bytes: &[u8]) -> Result<(), Refusal> {
        read(bytes).map(drop).map_err(Refusal::new)
    }

    fn plan(&self, cam: &DrawnCam<'_>, _named: bool) -> Result<Option<Box<dyn Plan>>, Refusal> {
        let lists = plan::lists(cam.body, cam.request);
        Ok((!lists.is_empty()).then(|| Box::new(PlannedLists(lists)) as Box<dyn Plan>))
    }

    fn judge(&self, cam: &SolvedCam<'_>, file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        let text = String::from_utf8_lossy(bytes);
        best_of_cuts(cam, file, |cut| {
            let mut list = WrittenInspection::read(cut, bytes);
            if let (Ok(_), Some(why)) = (&list.places, judge::contradiction(cam.body, &text, list.ball_radius)) {
                list.places = Err(why);
            }
            Ok(judge::judge(&cam.evidence()?, &[list]).into())
        })
    }
}

/// The lists of every cut.
#[derive(Debug)]
struct PlannedLists(Vec<InspectionList>);

impl Plan for PlannedLists {
    fn write(&self, cam: &DrawnCam<'_>, mark: &str) -> Vec<WrittenFile> {
        let lists: Vec<Vec<Vec<u8>>> = self.0.iter().map(|list| write::write(cam.body, list, mark)).collect();
        let mut written = Vec::new();
        for (form, ending) in write::ENDINGS.iter().enumerate() {
            let mut endings = cam.drawn.map_or_else(Vec::new, |drawn| endings_of_outlines(drawn, ending)).into_iter();
            for bytes in lists.iter().filter_map(|files| files.get(form)) {
                let ending = endings.next().unwrap_or_default();
                written.push(WrittenFile { format: FORMAT, ending, bytes: Ok(bytes.clone()) });
            }
        }
        written
    }

    fn judge(&self, evidence: &Evidence<'_>, _request: &Request, files: &[WrittenFile]) -> JudgedFile {
        let mut written = Vec::with_capacity(files.len());
        for (index, list) in self.0.iter().enumerate() {
            let of_list = files.iter().skip(index).step_by(self.0.len()).filter_map(|file| file.bytes.as_ref().ok());
            written.extend(of_list.map(|bytes| WrittenInspection::read(list.cut, bytes)));
        }
        judge::judge(evidence, &written).into()
    }

    fn sheet_endings(&self, cam: &DrawnCam<'_>) -> Vec<String> {
        cam.drawn.map_or_else(Vec::new, |drawn| endings_of_outlines(drawn, write::SHEET))
    }

    fn sheets(&self, cam: &Rendering<'_>) -> Result<Vec<Vec<u8>>, Refusal> {
        self.0.iter().map(|list| write::sheet(cam, list)).collect()
    }
}
