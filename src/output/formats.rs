//! The table of formats: a new one is one file and one line here.

use super::{csv, json, svg};
use crate::cam::rotary::Rotary;
use crate::drawing::{self, Part, Report};

/// A cam ready to be written, with what the formats want to know.
#[derive(Debug, Clone, Copy)]
pub struct Job<'a> {
    /// The cam.
    pub rotary: &'a Rotary,
    /// Its cut drawing.
    pub part: &'a Part,
    /// Its report.
    pub report: &'a Report,
    /// The cut file, written and proved.
    pub dxf: &'a [u8],
    /// Rows of the table.
    pub samples: u32,
    /// The sheet the preview is put into.
    pub template: &'a str,
}

/// Why a format could not be made.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// The preview has a curve that cannot be drawn.
    #[error(transparent)]
    Outline(#[from] drawing::outline::OutlineError),
    /// The template is not one.
    #[error(transparent)]
    Template(#[from] svg::TemplateError),
    /// The report could not be serialised.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

/// A format: its name, which is its extension too, and its writer. Each computes only what it shows.
pub type Format = (&'static str, fn(&Job<'_>) -> Result<Vec<u8>, FormatError>);

/// Every format.
pub const FORMATS: &[Format] = &[
    ("dxf", |job| Ok(job.dxf.to_vec())),
    ("svg", |job| Ok(svg::write(&drawing::sheet(job.rotary, job.part, job.report)?, job.template)?)),
    ("csv", |job| Ok(csv::write(&drawing::table(job.rotary, job.samples)))),
    ("json", |job| Ok(json::write(job.report)?)),
];

/// What is written when nothing is asked for.
pub const DEFAULT_FORMATS: &[&str] = &["dxf", "svg", "csv"];
