//! The way of a file that a machine runs: planned with the drawing, written to memory, read back and judged. Only then is it a [`ProvedFile`].

use super::list::{is_named, tool_files};
use super::tool_file::{DrawnCam, JudgedFile, Plan, ProvedFile, ToolFile, WrittenFile};
use crate::report::{Finding, Section, passed};
use crate::verify::Evidence;
use crate::write::Rendering;
use camgen_kernel::refusal::Refusal;
use std::sync::Arc;

/// What is to be written of a cam, as one of the kinds of file.
#[derive(Debug, Clone)]
pub struct PlannedFile {
    file: &'static dyn ToolFile,
    plan: Arc<dyn Plan>,
}

/// The files of a plan, written to memory and judged.
#[derive(Debug)]
pub struct ProvedToolFile {
    planned: PlannedFile,
    written: Vec<WrittenFile>,
    judged: JudgedFile,
}

/// Plans every file that was requested with a drawing.
///
/// # Errors
/// [`Refusal`] of the one whose check stands first in reports.
pub fn plan(cam: &DrawnCam<'_>) -> Result<Vec<PlannedFile>, Refusal> {
    let order = &cam.body.machine().catalogue().checks;
    let mut files: Vec<&'static dyn ToolFile> = tool_files().collect();
    files.sort_by_key(|file| order.iter().position(|name| *name == file.facts().check.name).unwrap_or(order.len()));
    let mut planned = Vec::new();
    for file in files {
        if let Some(plan) = file.plan(cam, is_named(file, cam.request.formats))? {
            planned.push(PlannedFile { file, plan: Arc::from(plan) });
        }
    }
    Ok(planned)
}

/// Writes what was planned under a mark, and judges the bytes.
#[must_use]
pub fn prove(
    planned: Vec<PlannedFile>,
    cam: &DrawnCam<'_>,
    evidence: &Evidence<'_>,
    mark: &str,
) -> Vec<ProvedToolFile> {
    let mut proved = Vec::with_capacity(planned.len());
    for planned in planned {
        let written = planned.plan.write(cam, mark);
        let judged = planned.plan.judge(evidence, cam.request, &written);
        proved.push(ProvedToolFile { planned, written, judged });
    }
    proved
}

/// The files of a format that were judged.
fn proved(written: &[WrittenFile], format: &str) -> Result<Vec<ProvedFile>, Refusal> {
    let own = written.iter().filter(|written| written.format == format);
    own.map(|written| Ok(ProvedFile::read_back(written.ending.clone(), written.bytes.clone()?))).collect()
}

impl ProvedToolFile {
    /// What its check found.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        &self.judged.findings
    }

    /// Its figures for the report.
    #[must_use]
    pub fn section(&self) -> Option<&Section> {
        self.judged.section.as_ref()
    }

    /// Which kind of file it is.
    #[must_use]
    pub fn file(&self) -> &'static dyn ToolFile {
        self.planned.file
    }

    /// The endings of the files of a format, and of its sheets.
    #[must_use]
    pub fn endings(&self, format: &str, cam: &DrawnCam<'_>) -> Vec<String> {
        let own = self.written.iter().filter(|written| written.format == format);
        let own: Vec<String> = own.map(|written| written.ending.clone()).collect();
        let sheets = if own.is_empty() { Vec::new() } else { self.planned.plan.sheet_endings(cam) };
        [own, sheets].concat()
    }

    /// The files of a format.
    ///
    /// # Errors
    /// [`Refusal`] when one of them cannot be written.
    pub fn files(&self, format: &str) -> Result<Vec<ProvedFile>, Refusal> {
        proved(&self.written, format)
    }

    /// The files of a format of a cam that breaks a limit: under a mark that says so where they have it, written and judged once more.
    ///
    /// # Errors
    /// As [`ProvedToolFile::files`], and when the judge finds another verdict than before.
    pub fn files_under(
        &self,
        mark: &str,
        format: &str,
        cam: &DrawnCam<'_>,
        evidence: &Evidence<'_>,
    ) -> Result<Vec<ProvedFile>, Refusal> {
        let plan = &self.planned.plan;
        if !plan.warns() {
            return self.files(format);
        }
        let written = plan.write(cam, mark);
        let again = plan.judge(evidence, cam.request, &written);
        if passed(&again.findings) != passed(self.findings()) {
            return Err(
                Refusal::new("the file under its warning is another than was proved").remedy("please report this")
            );
        }
        proved(&written, format)
    }

    /// The sheets for people that are written with the files.
    ///
    /// # Errors
    /// [`Refusal`] when one cannot be drawn.
    pub fn sheets(&self, cam: &Rendering<'_>) -> Result<Vec<Vec<u8>>, Refusal> {
        self.planned.plan.sheets(cam)
    }
}
