//! Analyses: figures, tables and curves of a machine, without a part that is cut.
//!
//! An analysis is plain data, made by one function from a machine. Checks judge its measures, formats write its tables and its
//! plot. A new one is a file here, a line in the catalogue and its command.

pub mod compare;
pub mod import;
pub mod laws;
pub mod size;

use crate::body::Kind;
use crate::check::Measure;
use crate::report::card::{self, Card};
use crate::report::chart::{self, Chart};
use crate::report::diagram::Diagram;
use crate::report::mechanism::MovingMechanism;
use crate::report::plot::{self, Plot};
use crate::report::sheet::Sheet;
use crate::report::{Section, Speeds};
use crate::table::Table;
use camgen_kernel::document::Input;

/// What the names of the files of a table end with, before the ending of their format.
pub type Listing = (&'static str, Table);

/// The results of an analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// Its kind.
    pub kind: &'static Kind,
    /// What distinguishes it from another run of the same command in the names of its files, such as `fixed`; empty for the usual one.
    pub variant: &'static str,
    /// Name of the machine.
    pub machine: String,
    /// For which speeds of the main shaft.
    pub speeds: Speeds,
    /// Everything that determines it.
    pub inputs: Vec<Input>,
    /// The sections of the report.
    pub sections: Vec<Section>,
    /// What checks judge.
    pub measures: Vec<Measure>,
    /// What the report notes.
    pub notes: Vec<String>,
    /// Its tables: the figures, then the curves.
    pub tables: Vec<Listing>,
    /// The first values of a place of a curve, which distinguish the curves, such as `rpm`; empty where there is one curve of each kind.
    pub by: &'static [&'static str],
    /// The value along which the curves run.
    pub along: &'static str,
    /// The picture on paper.
    pub picture: Picture,
    /// The mechanism as it moves, with a sample at each row of the last table; none where nothing moves.
    pub mechanism: Option<MovingMechanism>,
    /// A table of a machine file that describes what was analysed; none where there is nothing to paste.
    pub document: Option<String>,
    /// Which of its columns are drawn together, before what is drawn of every analysis.
    pub diagrams: &'static [Diagram],
    /// What is not modelled of the machine, a sentence each.
    pub not_modelled: Vec<&'static str>,
}

/// A picture on paper.
#[derive(Debug, Clone, PartialEq)]
pub enum Picture {
    /// Curves over a quantity that they share.
    Curves(Plot),
    /// Points by two quantities, in decades.
    Chart(Chart),
    /// Curves, and a card with a sheet of its own.
    CurvesWithCard(Plot, Card),
}

impl Picture {
    /// The picture on a sheet, with the mark of its report.
    #[must_use]
    pub fn sheet(&self, mark: &str) -> Sheet {
        match self {
            Self::Curves(curves) | Self::CurvesWithCard(curves, _) => plot::sheet(curves, mark),
            Self::Chart(points) => chart::sheet(points, mark),
        }
    }

    /// The sheets, each with what the names of its files have after the stem.
    #[must_use]
    pub fn sheets(&self, mark: &str) -> Vec<(&'static str, Sheet)> {
        let card =
            if let Self::CurvesWithCard(_, card) = self { Some((card.ending, card::sheet(card, mark))) } else { None };
        std::iter::once(("", self.sheet(mark))).chain(card).collect()
    }

    /// What the names of the files of its sheets have after the stem.
    #[must_use]
    pub fn endings(&self) -> Vec<&'static str> {
        let card = if let Self::CurvesWithCard(_, card) = self { Some(card.ending) } else { None };
        std::iter::once("").chain(card).collect()
    }
}

impl Analysis {
    /// The sheets of its picture, with the command in their foot before the mark of the report.
    #[must_use]
    pub fn sheets(&self, mark: &str) -> Vec<(&'static str, Sheet)> {
        self.picture.sheets(&format!("camgen {} · {mark}", self.kind.command))
    }
}

/// Number of equal steps along a stroke or an angle at which curves are tabulated.
pub const PLACES: u32 = 180;

/// Equal places from 0 to an end, both ends included.
pub fn places(end: f64) -> impl Iterator<Item = f64> + Clone {
    (0..=PLACES).map(move |i| if i == PLACES { end } else { end * f64::from(i) / f64::from(PLACES) })
}
