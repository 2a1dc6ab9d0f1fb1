//! Programs for a milling machine, also of a wheel that grinds in polar coordinates and of a tool over a cam that a fourth axis turns.

mod blank;
mod judge;
mod plan;
pub mod read;
mod write;

pub use plan::entry::{Descent, Entry};
pub use plan::four_axes;
pub use plan::milling::{self, MillingProgram};
pub use read::{CutterMove, CutterProgram, CutterSide, MoveKind, TurnedPass, read};

use super::tool_file::{
    DrawnCam, ExpectedFile, FileError, JudgedFile, Plan, SolvedCam, ToolFile, ToolFileFacts, WrittenFile,
};
use crate::body::{Body, Cut, Request};
use crate::machine::Controller;
use crate::report::ProgramMeasures;
use crate::verify::Evidence;
use crate::write::{Rendering, endings_of_parts};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;
use judge::WrittenProgram;
use milling::{MillingError, TurnedPath, depth_of, widest_cutter};

/// The programs: one for each part, with all of its flanks.
pub const FORMAT: &str = "gcode";

/// A program for a milling machine.
#[derive(Debug)]
pub struct ProgramFile;

/// What it is called and where it stands.
const FACTS: ToolFileFacts = ToolFileFacts {
    noun: "program",
    described: "a program for a milling machine",
    formats: &[FORMAT],
    not_planned: "no program for a milling machine was requested with the drawing",
    check: &judge::CHECK,
    stands_after: "cutter_path",
};

impl ToolFile for ProgramFile {
    fn facts(&self) -> &'static ToolFileFacts {
        &FACTS
    }

    fn unfit(&self, body: &dyn Body) -> Option<&'static str> {
        milling::unfit(body)
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        read::is_program(bytes)
    }

    /// Words of a program may stand in the comments of other files.
    fn is_certain(&self) -> bool {
        false
    }

    fn read(&self, bytes: &[u8]) -> Result<(), Refusal> {
        read(bytes).map(drop)
    }

    fn plan(&self, cam: &DrawnCam<'_>, _named: bool) -> Result<Option<Box<dyn Plan>>, Refusal> {
        if cam.drawn.is_none() {
            return Ok(None);
        }
        let programs = match plan::programs(cam.body, cam.request) {
            // The check of the cutter's radius says so, too, and what would pass.
            Err(MillingError::Cutter(why)) => Err(why.to_string()),
            Err(MillingError::Refused(why)) => return Err(why.context("no program")),
            Ok(programs) if programs.is_empty() => return Ok(None),
            Ok(programs) => Ok(programs),
        };
        Ok(Some(Box::new(PlannedPrograms(programs))))
    }

    fn judge(&self, cam: &SolvedCam<'_>, file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
        let body = cam.body;
        let program = read::read_for(bytes, Some(body.machine().cutting().controller))
            .map_err(|why| FileError::Read(why.context("not a program that can be checked")))?;
        let kept = judge::keeps_its_cutter(&program);
        let given = file.cutter.or(cam.request.cutter_radius);
        let cutter = match given.or_else(|| widest_cutter(body)) {
            _ if kept => None,
            Some(cutter) => Some(MILLIMETRES * cutter),
            None => {
                let refusal = Refusal::new("the program moves the centre of a cutter and does not give its radius");
                return Err(FileError::Cutter(refusal.remedy("give the radius of the cutter")));
            }
        };
        let cuts = body.cuts();
        let written = WrittenProgram {
            cuts: (0..cuts.len()).collect(),
            cutter,
            kept: given.filter(|_| kept).map(|radius| MILLIMETRES * radius),
            presumed: None,
            knows_blank: body.machine().cutting().blank_margin.is_some(),
            middle: MILLIMETRES * cam.request.fit.band().0,
            depth: depth_of(body),
            program: Ok(program),
        };
        let alone = cuts.len() == 1 && cuts.iter().all(|cut| cut.curves.is_some() && !Cut::is_hollow(cut));
        let finding = judge::judge(&cam.evidence()?, std::slice::from_ref(&written));
        let outline = if alone { judge::left_by(&written) } else { None };
        Ok(JudgedFile { outline, ..finding.into() })
    }
}

/// The programs of all parts, or why the cutter has no path.
#[derive(Debug)]
struct PlannedPrograms(Result<Vec<MillingProgram>, String>);

impl Plan for PlannedPrograms {
    fn write(&self, cam: &DrawnCam<'_>, mark: &str) -> Vec<WrittenFile> {
        let programs = match &self.0 {
            Ok(programs) => programs,
            Err(why) => {
                let bytes = Err(Refusal::new(why.clone()));
                return vec![WrittenFile { format: FORMAT, ending: String::new(), bytes }];
            }
        };
        let ending = programs.first().map_or(Controller::default(), |program| program.controller).ending();
        let endings = match cam.drawn {
            // What a roller sweeps in space is drawn without parts.
            Some(drawn) if drawn.swept.is_none() => endings_of_parts(drawn, ending),
            _ => vec![ending.to_owned()],
        };
        let mut written = Vec::with_capacity(programs.len());
        for (program, ending) in programs.iter().zip(endings) {
            let bytes = Ok(write::write(cam.body, program, &[mark.to_owned()]));
            written.push(WrittenFile { format: FORMAT, ending, bytes });
        }
        written
    }

    fn judge(&self, evidence: &Evidence<'_>, request: &Request, files: &[WrittenFile]) -> JudgedFile {
        let programs = match &self.0 {
            Err(why) => return Some(judge::no_program(evidence, why.clone())).into(),
            Ok(programs) => programs,
        };
        let (mut written, mut measures) = (Vec::new(), Vec::new());
        for (program, file) in programs.iter().zip(files) {
            let bytes = file.bytes.as_ref().map_err(ToString::to_string);
            let read =
                bytes.and_then(|bytes| read::read_for(bytes, Some(program.controller)).map_err(|why| why.to_string()));
            measures.extend(read.as_ref().ok().map(|read| measured(program, read)));
            written.push(WrittenProgram {
                cuts: program.cuts.clone(),
                cutter: program.cutter.map(|radius| MILLIMETRES * radius),
                kept: request.cutter_radius.filter(|_| program.cutter.is_none()).map(|radius| MILLIMETRES * radius),
                presumed: program.largest_kept(),
                knows_blank: true,
                middle: MILLIMETRES * request.fit.band().0,
                depth: depth_of(evidence.body),
                program: read,
            });
        }
        let section = ProgramMeasures::section(&measures);
        JudgedFile { section, ..judge::judge(evidence, &written).into() }
    }

    fn warns(&self) -> bool {
        true
    }

    /// A setup sheet for each program but those that turn the cam under its tool.
    fn sheet_endings(&self, cam: &DrawnCam<'_>) -> Vec<String> {
        let are_milled = self.0.as_ref().is_ok_and(|programs| programs.iter().all(|program| program.turned.is_none()));
        let drawn = cam.drawn.filter(|drawn| are_milled && drawn.swept.is_none());
        drawn.map_or_else(Vec::new, |drawn| endings_of_parts(drawn, write::setup::SHEET))
    }

    fn sheets(&self, cam: &Rendering<'_>) -> Result<Vec<Vec<u8>>, Refusal> {
        let Ok(programs) = &self.0 else { return Ok(Vec::new()) };
        let milled = programs.iter().filter(|program| program.turned.is_none() && cam.drawn.swept.is_none());
        milled.map(|program| write::setup::sheet(cam, program)).collect()
    }
}

/// The figures of a program as it was read, for the report.
fn measured(program: &MillingProgram, read: &CutterProgram) -> ProgramMeasures {
    if let (Some(path), false) = (&program.turned, read.turned.is_empty()) {
        return measured_turned(program, path);
    }
    let at_feed = || read.moves.iter().filter(|moved| moved.kind != MoveKind::Rapid);
    let along: f64 = at_feed().flat_map(CutterMove::segments).map(|segment| segment.length()).sum();
    let down: f64 = at_feed().map(|moved| (moved.to[2] - moved.from[2]).abs()).sum();
    // A ramp is run at the feed into the material.
    let ramps = at_feed().filter(|moved| !moved.is_level()).flat_map(CutterMove::segments);
    let sloping: f64 = ramps.map(|segment| segment.length()).sum();
    let (feed, plunge_feed) = (program.cutting.feed, program.cutting.plunge_feed);
    let seconds = ((along - sloping) / feed + (sloping + down) / plunge_feed) / MILLIMETRES;
    ProgramMeasures {
        controller: program.controller.word(),
        moves: read.moves.len(),
        passes: program.order.len(),
        depth_mm: program.depths.last().copied().unwrap_or(0.0),
        length_mm: along + down,
        minutes: seconds / 60.0,
    }
}

/// The figures of a program that turns the cam under its tool.
fn measured_turned(program: &MillingProgram, path: &TurnedPath) -> ProgramMeasures {
    let depths = program.depths.len();
    let around: f64 = path.rounds.iter().flat_map(|round| &round.lengths).sum();
    #[expect(clippy::cast_precision_loss, reason = "at most a thousand passes")]
    let length_mm = depths as f64 * around;
    ProgramMeasures {
        controller: program.controller.word(),
        moves: depths * path.rounds.iter().map(|round| round.rows.len()).sum::<usize>(),
        passes: depths * path.rounds.len(),
        depth_mm: program.depths.last().copied().unwrap_or(0.0),
        length_mm,
        minutes: length_mm / (MILLIMETRES * program.cutting.feed) / 60.0,
    }
}
