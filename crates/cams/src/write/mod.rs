//! Drawing to bytes, bytes to files. Writers only format: no trigonometry, no offsets, no clock.
//!
//! A view is one file here, and a line in the list of all formats ([`LISTED`](crate::tool_files::LISTED)).

pub mod csv;
pub mod diagram;
mod directory;
mod error;
pub mod files;
mod finite;
pub mod growing;
#[cfg(feature = "html")]
pub mod html;
mod interrupted;
pub mod json;
mod known;
pub mod number;
mod one_file;
mod part;
mod path_data;
#[cfg(feature = "pdf")]
pub mod pdf;
pub mod record;
pub mod step;
pub mod step_assembly;
pub mod stl;
pub mod svg;
mod template;
pub mod toml;

use crate::analysis::Analysis;
use crate::body::{Body, Drawn, Part};
use crate::report::{Finding, Report};
use crate::verify::WrittenOutline;
use camgen_kernel::profile::outline::Fit;
use camgen_kernel::refusal::Refusal;
use std::ops::Deref;

/// A proven cam, as the formats receive it.
#[derive(Clone, Copy)]
pub struct Rendering<'a> {
    /// The solved cam.
    pub body: &'a dyn Body,
    /// The other cams on the same shaft, and their outlines as read back.
    pub other_cams: &'a [(&'a dyn Body, &'a [WrittenOutline])],
    /// Its drawing.
    pub drawn: &'a Drawn,
    /// Its outlines as read back.
    pub outlines: &'a [WrittenOutline],
    /// The tolerance of the outlines, and on which side of the exact curves they lie.
    pub fit: Fit,
    /// Radius of the cutter whose path was drawn, m.
    pub cutter_radius: Option<f64>,
    /// The findings of every check.
    pub findings: &'a [Finding],
    /// Its report, the names of the files in it.
    pub report: &'a (dyn Deref<Target = Report> + Sync),
    /// Rows of the table over a turn or a stroke.
    pub samples: u32,
    /// The template of the sheets.
    pub template: &'a str,
    /// The files from which the part is made, that the drawing names.
    pub part_files: &'a [PartFile],
    /// The design with which the moving report is made live.
    #[cfg(feature = "live")]
    pub live: Option<&'a html::live::LiveDesign>,
    /// The time stamp of the files, seconds since 1970 UTC.
    pub created: Option<u64>,
}

/// A file from which a part is made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PartFile {
    /// What it has of the part: "Profile".
    pub role: &'static str,
    /// Its name.
    pub name: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
}

/// Digits of a hash that a drawing has.
const HASH_DIGITS: usize = 12;

impl PartFile {
    /// The line of the drawing that names it.
    #[must_use]
    pub fn words(&self) -> String {
        let Self { role, name, sha256 } = self;
        format!("{role}: {name}, sha256 {}…", sha256.get(..HASH_DIGITS).unwrap_or(sha256))
    }
}

/// An analysis, as the formats receive it.
#[derive(Debug, Clone, Copy)]
pub struct AnalysisRendering<'a> {
    /// The analysis.
    pub analysis: &'a Analysis,
    /// Its report, the names of the files in it.
    pub report: &'a Report,
    /// The template of the plot.
    pub template: &'a str,
}

/// How a format is made of an analysis.
#[derive(Debug, Clone, Copy)]
pub struct AnalysisFormat {
    /// The endings of its files, added to the stem of their names; empty where the analysis has nothing for the format.
    pub endings: fn(&Analysis) -> Vec<String>,
    /// The files, in the same order.
    pub write: fn(&AnalysisRendering<'_>) -> Result<Vec<Vec<u8>>, Refusal>,
}

/// When a format is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FormatSelection {
    /// By default, and when it is requested.
    Usual,
    /// When it is requested.
    Asked,
    /// Whenever the drawing has something for it; it cannot be requested by name.
    Drawn,
}

/// A view: a file that is looked at or read by other programs, and from which nothing is cut, measured or moved. Each computes only what it shows.
#[derive(Debug)]
pub struct View {
    /// Its name on the command line.
    pub name: &'static str,
    /// When it is written.
    pub when: FormatSelection,
    /// Whether it shows the flank of a body whose sections differ, which then has to be drawn.
    pub flank: bool,
    /// Why a cam cannot have it, if it cannot.
    pub unfit: fn(&dyn Body) -> Option<&'static str>,
    /// The endings of its files, added to the stem of their names; empty where the drawing has nothing for the format.
    pub endings: fn(&Drawn) -> Vec<String>,
    /// The files, in the same order.
    pub write: fn(&Rendering<'_>) -> Result<Vec<Vec<u8>>, Refusal>,
    /// How it is made of an analysis, where that is possible.
    pub of_analysis: Option<AnalysisFormat>,
}

/// The endings of the files of every part: a section has the speed it is for before the ending, one of several outlines its
/// name.
pub(crate) fn endings_of_parts(drawn: &Drawn, ending: &str) -> Vec<String> {
    let speeds: Vec<f64> = drawn.parts.iter().filter_map(|part| part.rpm).collect();
    let mut speeds = number::names(&speeds).into_iter();
    let mut of_part = |part: &Part| match part.rpm.and_then(|_| speeds.next()) {
        Some(rpm) => format!("-{rpm}rpm{ending}"),
        None if part.name.is_empty() => ending.to_owned(),
        None => format!("-{}{ending}", part.name),
    };
    drawn.parts.iter().map(&mut of_part).collect()
}

/// The endings of files of every outline: of several of a part each has its name before the ending.
pub(crate) fn endings_of_outlines(drawn: &Drawn, ending: &str) -> Vec<String> {
    if drawn.parts.iter().all(|part| part.track.as_ref().is_none_or(|track| track.others.is_empty())) {
        return endings_of_parts(drawn, ending);
    }
    drawn.outlines().map(|(_, layer, _)| format!("-{}{ending}", layer.word())).collect()
}

/// Any cam.
fn fits_all(_: &dyn Body) -> Option<&'static str> {
    None
}
