//! Tables of points for the control of a grinder or an old mill.

mod foreign;
mod head;
mod judge;
mod plan;
mod read;
mod write;

pub use judge::WrittenPoints;
pub use plan::{NotJudged, PointErrors, PointTable, TableError, largest_errors, motion_errors, tables, traced};
pub use read::{ReadPoints, read};
pub use write::write;

use super::section::section;
use super::tool_file::{
    DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, SolvedCam, ToolFile, ToolFileFacts, WrittenFile, best_of_cuts,
};
use crate::body::Request;
use crate::report::PointMeasures;
use crate::verify::Evidence;
use crate::write::endings_of_outlines;
use camgen_kernel::geometry::points::Interpolant;
use camgen_kernel::refusal::Refusal;
use foreign::ForeignTable;

/// The table of every section.
pub const FORMAT: &str = "points";

/// A table of points.
#[derive(Debug)]
pub struct PointFile;

/// What it is called and where it stands.
const FACTS: ToolFileFacts = ToolFileFacts {
    noun: "table of points",
    described: "a table of points",
    formats: &[FORMAT],
    not_planned: "no table of points was requested with the drawing, or the cutter has no path",
    check: &judge::CHECK,
    stands_after: "cutter_path",
};

impl ToolFile for PointFile {
    fn facts(&self) -> &'static ToolFileFacts {
        &FACTS
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        read::is_points(bytes)
    }

    fn read(&self, bytes: &[u8]) -> Result<(), Refusal> {
        read(bytes).map(drop).map_err(Refusal::new)
    }

    fn plan(&self, cam: &DrawnCam<'_>, _named: bool) -> Result<Option<Box<dyn Plan>>, Refusal> {
        let Some(drawn) = cam.drawn.filter(|_| cam.request.points.is_some()) else { return Ok(None) };
        let tables = match tables(cam.body, cam.request, drawn) {
            // The check of the cutter's radius says so, too, and what would pass.
            Err(TableError::Cutter(why)) => Err(why.to_string()),
            Err(TableError::Refused(why)) => return Err(why.context("no table of points")),
            Ok(tables) => Ok(tables),
        };
        Ok(Some(Box::new(PlannedTables(tables))))
    }

    fn judge(&self, cam: &SolvedCam<'_>, file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        let table = ForeignTable::read(bytes, file.cutter.or(cam.request.cutter_radius))?;
        match section(cam.body, file.section)? {
            Some(section) => Ok(table.judge(cam, section.cut, Some(section.rpm))?.into()),
            None => best_of_cuts(cam, file, |cut| Ok(table.judge(cam, cut, None)?.into())),
        }
    }
}

/// The tables of every outline, or why there is none.
#[derive(Debug)]
struct PlannedTables(Result<Vec<PointTable>, String>);

impl Plan for PlannedTables {
    fn write(&self, cam: &DrawnCam<'_>, _mark: &str) -> Vec<WrittenFile> {
        let endings = cam.drawn.map_or_else(Vec::new, |drawn| endings_of_outlines(drawn, "-points.csv"));
        let Ok(tables) = &self.0 else {
            let bytes = Err(Refusal::new(FACTS.not_planned));
            return vec![WrittenFile { format: FORMAT, ending: String::new(), bytes }];
        };
        let named = tables.iter().zip(endings);
        named.map(|(table, ending)| WrittenFile { format: FORMAT, ending, bytes: Ok(write(cam.body, table)) }).collect()
    }

    fn judge(&self, evidence: &Evidence<'_>, request: &Request, files: &[WrittenFile]) -> JudgedFile {
        let tables = match &self.0 {
            Err(why) => return Some(judge::no_table(evidence.tolerance_mm, why.clone())).into(),
            Ok(tables) => tables,
        };
        let mut written = Vec::with_capacity(tables.len());
        for (table, file) in tables.iter().zip(files) {
            let bytes = file.bytes.as_ref().map_err(ToString::to_string);
            let curve = bytes.and_then(|bytes| read(bytes)).and_then(|read| {
                read.goes_round()?;
                Ok(Interpolant::new(&table.turned(&read.rows), read.form, read.between, read.closed))
            });
            written.push(WrittenPoints { table: table.clone(), cutter: request.cutter_radius, curve });
        }
        let measures: Vec<PointMeasures> = tables.iter().map(|table| plan::measures(evidence.body, table)).collect();
        let section = PointMeasures::section(&measures);
        JudgedFile { section, ..judge::judge(evidence, &written).into() }
    }
}
