//! The list of all formats: of files that machines run, and of views.

use super::dxf::{self, CutFormat};
use super::gauge::GaugeFile;
use super::gcode::ProgramFile;
use super::inspection::InspectionFile;
use super::points::PointFile;
use super::servo::ServoFile;
use super::table::TableFile;
use super::tool_file::ToolFile;
use crate::body::{Body, FormatSet};
use crate::write::{self, AnalysisFormat, FormatSelection, View};

/// An entry of the list.
#[derive(Debug, Clone, Copy)]
pub enum Listed {
    /// A view, which has its own writer.
    View(&'static View),
    /// Files to cut from, which are proved by rolling the follower on them.
    Cut(&'static CutFormat),
    /// Another file that a machine runs, with a judge of its own.
    Tool(&'static dyn ToolFile),
}

use Listed::{Cut, Tool, View as Shown};

/// Every kind of file, in the order in which files are listed.
pub const LISTED: &[Listed] = &[
    Cut(&dxf::OUTLINES),
    Shown(&write::svg::FORMAT),
    Shown(&write::step::FORMAT),
    Shown(&write::csv::FORMAT),
    Shown(&write::json::FORMAT),
    #[cfg(feature = "html")]
    Shown(&write::html::FORMAT),
    #[cfg(feature = "pdf")]
    Shown(&write::pdf::FORMAT),
    Shown(&write::stl::FORMAT),
    Tool(&PointFile),
    Shown(&write::diagram::FORMAT),
    Tool(&ProgramFile),
    Tool(&ServoFile),
    Tool(&InspectionFile),
    Tool(&GaugeFile),
    Tool(&TableFile),
    Shown(&write::toml::FORMAT),
    Cut(&dxf::CUTTER_PATHS),
    Shown(&write::csv::FURTHER),
];

/// The files that machines run.
pub fn tool_files() -> impl Iterator<Item = &'static dyn ToolFile> {
    LISTED.iter().filter_map(|listed| match listed {
        Tool(file) => Some(*file),
        Shown(_) | Cut(_) => None,
    })
}

/// Which of them a file is, by its content.
#[must_use]
pub fn recognised(bytes: &[u8]) -> Option<&'static dyn ToolFile> {
    tool_files().filter(|file| file.recognises(bytes)).min_by_key(|file| !file.is_certain())
}

/// A format that can be written: its name, and the cams that it fits.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// Its name on the command line.
    pub name: &'static str,
    /// When it is written.
    pub when: FormatSelection,
    /// Where its files come from.
    pub source: Listed,
}

impl Format {
    /// Why a cam cannot have it, if it cannot.
    #[must_use]
    pub fn unfit(&self, body: &dyn Body) -> Option<&'static str> {
        match self.source {
            Shown(view) => (view.unfit)(body),
            Cut(cut) => (cut.unfit)(body),
            Tool(file) => file.unfit(body),
        }
    }

    /// Whether it shows the flank of a body whose sections differ, which then has to be drawn.
    #[must_use]
    pub fn shows_flank(&self) -> bool {
        matches!(self.source, Shown(view) if view.flank)
    }

    /// How it is made of an analysis, where that is possible.
    #[must_use]
    pub fn of_analysis(&self) -> Option<AnalysisFormat> {
        match self.source {
            Shown(view) => view.of_analysis,
            Cut(_) | Tool(_) => None,
        }
    }
}

/// Every format, in the order in which files are listed.
pub fn formats() -> impl Iterator<Item = Format> {
    let mut all = Vec::new();
    for &source in LISTED {
        match source {
            Shown(view) => all.push(Format { name: view.name, when: view.when, source }),
            Cut(cut) => all.push(Format { name: cut.name, when: cut.when, source }),
            Tool(file) => {
                all.extend(file.facts().formats.iter().map(|&name| Format {
                    name,
                    when: FormatSelection::Asked,
                    source,
                }));
            }
        }
    }
    all.into_iter()
}

/// The names of the formats that machines run.
fn tool_formats() -> impl Iterator<Item = &'static str> {
    tool_files().flat_map(|file| file.facts().formats).copied()
}

/// Those of the named formats that a machine runs, for a request.
#[must_use]
pub fn requested(names: &[impl AsRef<str>]) -> FormatSet {
    let named = |format: &str| names.iter().any(|name| name.as_ref() == format);
    let places = tool_formats().enumerate().filter(|(_, format)| named(format));
    places.fold(FormatSet::default(), |all, (place, _)| all.with(place))
}

/// Whether a format of a file is one of a set.
pub(super) fn is_named(file: &dyn ToolFile, formats: FormatSet) -> bool {
    tool_formats().enumerate().any(|(place, format)| formats.contains(place) && file.facts().formats.contains(&format))
}

/// The formats that can be requested.
pub fn formats_by_name() -> impl Iterator<Item = Format> {
    formats().filter(|format| format.when != FormatSelection::Drawn)
}
