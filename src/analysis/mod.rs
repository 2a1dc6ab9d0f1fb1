//! Analyses: what a machine does, in figures, tables and curves, without a part that is cut.
//!
//! An analysis is plain data, made by one function from a machine. Checks judge its measures, formats write its tables and its
//! plot. A new one is a file here, one line in [`KINDS`] and its command.

pub mod brake;
pub mod drive;
pub mod laws;
pub mod linkage;
pub mod regimes;
pub mod shaft;
pub mod size;
pub mod spring;

use crate::body::Kind;
use crate::document::Input;
use crate::report::mechanism::Mechanism;
use crate::report::plot::Plot;
use crate::report::{Section, Speeds};
use crate::table::Table;

/// Every kind of analysis.
pub const KINDS: &[&Kind] = &[
    &regimes::KIND,
    &spring::KIND,
    &drive::KIND,
    &linkage::KIND,
    &shaft::KIND,
    &brake::KIND,
    &size::KIND,
    &laws::KIND,
];

/// A figure that a check judges.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// The check.
    pub check: &'static str,
    /// The figure.
    pub value: f64,
    /// What it is held against, where it has a limit.
    pub limit: Option<f64>,
    /// Unit of both.
    pub unit: &'static str,
    /// Where it is, and what would keep the limit.
    pub note: Option<String>,
}

/// What the names of the files of a table end with, before the ending of their format.
pub type Listing = (&'static str, Table);

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// Its kind.
    pub kind: &'static Kind,
    /// Name of the machine.
    pub machine: String,
    /// For which speeds of the main shaft.
    pub speeds: Speeds,
    /// Everything that determines it.
    pub inputs: Vec<Input>,
    /// What the report tells.
    pub sections: Vec<Section>,
    /// What checks judge.
    pub measures: Vec<Measure>,
    /// What the report notes.
    pub notes: Vec<String>,
    /// Its tables: the figures, then the curves.
    pub tables: Vec<Listing>,
    /// The first values of a place of a curve, by which curves are told apart, as `rpm`; none where there is one curve of each kind.
    pub by: &'static [&'static str],
    /// The value along which the curves run.
    pub along: &'static str,
    /// The curves on paper.
    pub plot: Plot,
    /// The mechanism as it moves, with a sample at each row of the last table; none where nothing moves.
    pub mechanism: Option<Mechanism>,
    /// A table of a machine file that describes what was analysed; none where there is nothing to paste.
    pub document: Option<String>,
    /// What is not modelled of the machine, a sentence each.
    pub not_modelled: Vec<&'static str>,
}

/// Places along a stroke or an angle at which curves are told.
const PLACES: u32 = 180;

/// Equal places from 0 to an end, both ends included.
fn places(end: f64) -> impl Iterator<Item = f64> + Clone {
    (0..=PLACES).map(move |i| if i == PLACES { end } else { end * f64::from(i) / f64::from(PLACES) })
}
