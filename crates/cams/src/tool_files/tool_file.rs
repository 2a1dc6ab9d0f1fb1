//! What a file that a machine runs is to the rest of the program.

use crate::body::{Body, Drawn, Request};
use crate::check::Check;
use crate::report::{Finding, Section, passed};
use crate::verify::Evidence;
use crate::write::Rendering;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::refusal::Refusal;
use std::fmt::Debug;

/// What a kind of file is called, and where it stands in lists.
#[derive(Debug)]
pub struct ToolFileFacts {
    /// What a report on one calls it: "table for a servo drive".
    pub noun: &'static str,
    /// What a refusal calls one: "a table for a servo drive".
    pub described: &'static str,
    /// The names of the formats that it is written in when they are requested; none of a file that is only read. They have no writer: their files
    /// are those that were proved.
    pub formats: &'static [&'static str],
    /// Why a file of them cannot be written that was not planned.
    pub not_planned: &'static str,
    /// Its check.
    pub check: &'static Check,
    /// The name of the check behind which its own stands in reports.
    pub stands_after: &'static str,
}

/// A kind of file that a machine runs.
pub trait ToolFile: Debug + Sync {
    /// What it is called and where it stands.
    fn facts(&self) -> &'static ToolFileFacts;

    /// Why a cam has none, if it has none.
    fn unfit(&self, _body: &dyn Body) -> Option<&'static str> {
        None
    }

    /// Whether bytes are such a file, by what stands in them.
    fn recognises(&self, bytes: &[u8]) -> bool;

    /// Whether what it is recognised by stands in no other file.
    fn is_certain(&self) -> bool {
        true
    }

    /// Reads a file, whatever the cam.
    ///
    /// # Errors
    /// [`Refusal`] when it cannot be read.
    fn read(&self, bytes: &[u8]) -> Result<(), Refusal>;

    /// What is to be written of a cam; `None` where it was not requested. A file without options is requested by the name of a format; one with
    /// options has them in the request.
    ///
    /// # Errors
    /// [`Refusal`] when it was requested and the cam has no such file.
    fn plan(&self, _cam: &DrawnCam<'_>, _named: bool) -> Result<Option<Box<dyn Plan>>, Refusal> {
        Ok(None)
    }

    /// Judges a file that somebody else may have written.
    ///
    /// # Errors
    /// [`FileError`] when it cannot be compared with the cam at all.
    fn judge(&self, cam: &SolvedCam<'_>, file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError>;
}

/// What is to be written of a cam, before it has a mark.
pub trait Plan: Debug + Send + Sync {
    /// The files of all formats, in the order in which they are listed.
    fn write(&self, cam: &DrawnCam<'_>, mark: &str) -> Vec<WrittenFile>;

    /// Reads the written files again and judges them.
    fn judge(&self, evidence: &Evidence<'_>, request: &Request, files: &[WrittenFile]) -> JudgedFile;

    /// Whether the mark in the file of a cam that breaks a limit says so.
    fn warns(&self) -> bool {
        false
    }

    /// The endings of the names of sheets for people that are written with the files.
    fn sheet_endings(&self, _cam: &DrawnCam<'_>) -> Vec<String> {
        Vec::new()
    }

    /// Those sheets.
    ///
    /// # Errors
    /// [`Refusal`] when one cannot be drawn.
    fn sheets(&self, _cam: &Rendering<'_>) -> Result<Vec<Vec<u8>>, Refusal> {
        Ok(Vec::new())
    }
}

/// A file in memory, not yet proved.
#[derive(Debug, Clone)]
pub struct WrittenFile {
    /// The name of its format.
    pub format: &'static str,
    /// What is added to the stem of its name.
    pub ending: String,
    /// Its bytes, or why there is none.
    pub bytes: Result<Vec<u8>, Refusal>,
}

/// A file as its judge has read it: only what is proved in `proof.rs` and in `dxf` becomes one.
#[derive(Debug, Clone)]
pub struct ProvedFile {
    ending: String,
    bytes: Vec<u8>,
}

impl ProvedFile {
    /// A file whose bytes were read back by the caller.
    pub(super) fn read_back(ending: String, bytes: Vec<u8>) -> Self {
        Self { ending, bytes }
    }

    /// What is added to the stem of its name.
    #[must_use]
    pub fn ending(&self) -> &str {
        &self.ending
    }

    /// Its bytes.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

/// A cam with its drawing, of which files are planned and written.
#[derive(Clone, Copy)]
pub struct DrawnCam<'a> {
    /// The solved cam.
    pub body: &'a dyn Body,
    /// What was requested of it.
    pub request: &'a Request,
    /// What was drawn; `None` of a cam without an outline.
    pub drawn: Option<&'a Drawn>,
}

/// A solved cam with which a file is compared that somebody else may have written.
#[derive(Clone, Copy)]
pub struct SolvedCam<'a> {
    /// The cam.
    pub body: &'a dyn Body,
    /// How exactly the file must be of it.
    pub request: &'a Request,
}

impl<'a> SolvedCam<'a> {
    /// The tolerance of its outlines, mm.
    #[must_use]
    pub fn tolerance_mm(&self) -> f64 {
        MILLIMETRES * self.request.fit.tolerance
    }

    /// The evidence of a cam of which nothing was written.
    ///
    /// # Errors
    /// [`FileError::Request`] when the tolerances do not fit its follower.
    pub fn evidence(&self) -> Result<Evidence<'a>, FileError> {
        let motion = self.request.resolved(self.body).map_err(FileError::Request)?.fit.motion;
        let evidence = Evidence::without_files(self.body, self.tolerance_mm(), motion);
        Ok(Evidence { strict: self.request.strict, ..evidence })
    }
}

/// What a file that is checked should hold, where a cam has more than one file, and how it is read.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ExpectedFile<'a> {
    /// Layer of the outline in a DXF file; `None` for `CAM_PROFILE`, or the outermost closed contour of a file without that layer.
    pub layer: Option<&'a str>,
    /// Speed of the section of a conoid, rpm, one of those it was solved for.
    pub section: Option<f64>,
    /// Name of the outline, of a cam that has several at one place.
    pub cut: Option<&'a str>,
    /// Radius of the cutter whose path the file holds, m. A DXF file whose outline is not that of the cam is also read as the path of its
    /// centre.
    pub cutter: Option<f64>,
    /// Whether that radius is only of the run that wrote the file: it makes no path of an outline.
    pub cutter_is_recorded: bool,
}

/// What was found of a file, or of the files that were planned together.
#[derive(Debug, Clone, Default)]
pub struct JudgedFile {
    /// What its checks found.
    pub findings: Vec<Finding>,
    /// The figures of the file for the report.
    pub section: Option<Section>,
    /// The outline that it cuts, where a diagnosis may explain what is wrong with it.
    pub outline: Option<Contour>,
}

impl From<Option<Finding>> for JudgedFile {
    fn from(finding: Option<Finding>) -> Self {
        Self { findings: finding.into_iter().collect(), ..Self::default() }
    }
}

/// Why a file cannot be compared with a cam.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// It cannot be read.
    #[error(transparent)]
    Read(Refusal),
    /// The section that it should hold is not given, or there is no such section.
    #[error(transparent)]
    Section(Refusal),
    /// The radius of its cutter is not given.
    #[error(transparent)]
    Cutter(Refusal),
    /// The requested tolerances do not fit the cam.
    #[error(transparent)]
    Request(Refusal),
}

/// What is found of a file that belongs to one of the cuts of a cam: of the cut that is named, or of the first that it fits; where it fits none,
/// of the first.
///
/// # Errors
/// As `judge`.
pub(super) fn best_of_cuts(
    cam: &SolvedCam<'_>,
    file: &ExpectedFile<'_>,
    judge: impl Fn(usize) -> Result<JudgedFile, FileError>,
) -> Result<JudgedFile, FileError> {
    let cuts = cam.body.cuts();
    let named = file.cut.and_then(|name| cuts.iter().position(|cut| cut.name == name));
    let wanted = named.map_or(0..cuts.len(), |named| named..named + 1);
    let first = judge(wanted.start)?;
    for cut in wanted.skip(1).filter(|_| !passed(&first.findings)) {
        let next = judge(cut)?;
        if passed(&next.findings) {
            return Ok(next);
        }
    }
    Ok(first)
}
