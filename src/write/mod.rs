//! Drawing to bytes, bytes to files. Writers only format: no trigonometry, no offsets, no clock.
//!
//! One table of formats, walked for every kind of cam: a new format is one file and one line in [`FORMATS`].

pub mod csv;
mod directory;
pub mod dxf;
pub mod files;
mod finite;
pub mod html;
pub mod json;
pub mod number;
mod path_data;
pub mod pdf;
pub mod points;
pub mod proof;
pub mod record;
pub mod step;
pub mod stl;
pub mod svg;
pub mod toml;

use crate::analysis::Analysis;
use crate::body::{Body, Drawn, Part};
use crate::geometry::solid::SolidError;
use crate::profile::outline::{Fit, OutlineError};
use crate::report::{Finding, Report};
use crate::verify::WrittenOutline;
use std::ops::Deref;

/// A proven cam as the formats see it.
#[derive(Clone, Copy)]
pub struct Rendering<'a> {
    /// The solved cam.
    pub body: &'a dyn Body,
    /// The disc on the same shaft that takes its torque, and its outlines as read back.
    pub second: Option<(&'a dyn Body, &'a [WrittenOutline])>,
    /// Its drawing.
    pub drawn: &'a Drawn,
    /// The outlines as read back from them.
    pub outlines: &'a [WrittenOutline],
    /// The cut files, written and proved, one for each part of the drawing.
    pub cut_files: &'a [Vec<u8>],
    /// The tables of points, written and proved, one for each part of the drawing; none when they were not requested.
    pub points: &'a [Vec<u8>],
    /// How near the outlines keep to the exact curves, and on which side.
    pub fit: Fit,
    /// Version of the cut files.
    pub dxf_version: dxf::Version,
    /// What every check found.
    pub findings: &'a [Finding],
    /// Its report, the names of the files in it.
    pub report: &'a (dyn Deref<Target = Report> + Sync),
    /// Rows of the table over a turn or a stroke.
    pub samples: u32,
    /// The template of the review sheet.
    pub template: &'a str,
    /// The time that the files bear, seconds since 1970 UTC.
    pub created: Option<u64>,
}

/// An analysis as the formats see it.
#[derive(Debug, Clone, Copy)]
pub struct Account<'a> {
    /// The analysis.
    pub analysis: &'a Analysis,
    /// Its report, the names of the files in it.
    pub report: &'a Report,
    /// The template of the plot.
    pub template: &'a str,
}

/// How an analysis has a format.
#[derive(Debug, Clone, Copy)]
pub struct OfAnalysis {
    /// What its files add to the stem of their names; none where the analysis has nothing for it.
    pub endings: fn(&Analysis) -> Vec<String>,
    /// The files, in the same order.
    pub write: fn(&Account<'_>) -> Result<Vec<Vec<u8>>, FormatError>,
}

/// Why a format could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The preview has a curve that cannot be drawn.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// The template is not valid.
    #[error(transparent)]
    Template(#[from] svg::TemplateError),
    /// The solid is not valid.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// There is no PDF.
    #[error(transparent)]
    Pdf(#[from] pdf::PdfError),
    /// Points are drawn and proved with the cam.
    #[error("no table of points was requested with the drawing, or the cutter has no path")]
    NoPoints,
    /// A value of the table is none: a fault of camgen.
    #[error("row {row} of the table would hold no number in {column}; nothing was written; please report this")]
    NotFinite {
        /// The column.
        column: &'static str,
        /// The row, from 1.
        row: usize,
    },
    /// The report could not be serialised.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

/// When a format is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    /// By default, and when it is requested.
    Usual,
    /// When it is requested.
    Asked,
    /// Whenever the drawing has something for it; it cannot be requested by name.
    Drawn,
}

/// A format: what it is called, which cams it fits, and its files. Each computes only what it shows.
#[derive(Debug)]
pub struct Format {
    /// Its name on the command line.
    pub name: &'static str,
    /// When it is written.
    pub when: When,
    /// Whether it shows the flank of a body whose sections differ, which then has to be drawn.
    pub flank: bool,
    /// Why a cam cannot have it, if so.
    pub unfit: fn(&dyn Body) -> Option<&'static str>,
    /// What its files add to the stem of their names; none where the drawing has nothing for it.
    pub endings: fn(&Drawn) -> Vec<String>,
    /// The files, in the same order.
    pub write: fn(&Rendering<'_>) -> Result<Vec<Vec<u8>>, FormatError>,
    /// How an analysis has it, where it can.
    pub of_analysis: Option<OfAnalysis>,
}

/// Every format, in the order in which files are listed.
pub const FORMATS: &[Format] = &[
    dxf::FORMAT,
    svg::FORMAT,
    step::FORMAT,
    csv::FORMAT,
    json::FORMAT,
    html::FORMAT,
    pdf::FORMAT,
    stl::FORMAT,
    points::FORMAT,
    toml::FORMAT,
    dxf::CUTTER_PATH,
];

/// The formats that can be requested.
pub fn by_name() -> impl Iterator<Item = &'static Format> {
    FORMATS.iter().filter(|format| format.when != When::Drawn)
}

/// What the names of the files of every part end with: a section has the speed it is for before the ending.
fn of_parts(drawn: &Drawn, ending: &str) -> Vec<String> {
    let speeds: Vec<f64> = drawn.parts.iter().filter_map(|part| part.rpm).collect();
    let mut speeds = number::names(&speeds).into_iter();
    let mut of_part = |part: &Part| match part.rpm.and_then(|_| speeds.next()) {
        Some(rpm) => format!("-{rpm}rpm{ending}"),
        None => ending.to_owned(),
    };
    drawn.parts.iter().map(&mut of_part).collect()
}

/// Any cam.
fn fits_all(_: &dyn Body) -> Option<&'static str> {
    None
}
