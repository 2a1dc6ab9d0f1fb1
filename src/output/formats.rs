//! The table of formats: a new one is one file and one line here.

use super::{csv, json, step, svg};
use crate::drawing::outline::{MILLIMETRES, OutlineError};
use crate::drawing::solid::{SolidError, solid};
use crate::drawing::{Part, Report, Sheet, Table, sheet};

/// A cam ready to be written, with what the formats want to know. What only one of them shows is made when it asks.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// Its cut drawing.
    pub part: &'a Part,
    /// Its report.
    pub report: &'a Report,
    /// The cut file, written and proved.
    pub dxf: &'a [u8],
    /// Thickness of the part, m, when it has one.
    pub thickness: Option<f64>,
    /// Makes the review sheet.
    pub sheet: &'a dyn Fn() -> Result<Sheet, OutlineError>,
    /// Makes the point table.
    pub table: &'a dyn Fn() -> Table,
    /// The sheet the preview is put into.
    pub template: &'a str,
}

/// Why a format could not be made.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// The preview has a curve that cannot be drawn.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// The template is not one.
    #[error(transparent)]
    Template(#[from] svg::TemplateError),
    /// A solid needs a thickness.
    #[error("a STEP file needs cam.thickness; give it, or leave step out of --format")]
    NoThickness,
    /// The solid is not one.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// The report could not be serialised.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

/// A format: its name, which is its extension too, and its writer. Each computes only what it shows.
pub type Format = (&'static str, fn(&Job<'_>) -> Result<Vec<u8>, FormatError>);

/// Every format.
pub const FORMATS: &[Format] = &[
    ("dxf", |job| Ok(job.dxf.to_vec())),
    ("svg", |job| Ok(svg::write(&(job.sheet)()?, job.template)?)),
    ("step", |job| {
        let thickness = job.thickness.ok_or(FormatError::NoThickness)?;
        Ok(step::write(&solid(job.part, MILLIMETRES * thickness)?, &sheet::title(job.report)))
    }),
    ("csv", |job| Ok(csv::write(&(job.table)()))),
    ("json", |job| Ok(json::write(job.report)?)),
];

/// What is written when nothing is asked for.
pub const DEFAULT_FORMATS: &[&str] = &["dxf", "svg", "step", "csv"];
