//! The list of all formats: of files that machines run, and of views.

use super::gauge::GaugeFile;
use super::gcode::ProgramFile;
use super::inspection::InspectionFile;
use super::points::PointFile;
use super::servo::ServoFile;
use super::table::TableFile;
use super::tool_file::{ToolFile, ToolFormat};
use crate::body::{Body, FormatNames};
use crate::write::{self, AnalysisFormat, FormatSelection, View};

/// An entry of the list.
#[derive(Debug, Clone, Copy)]
pub enum Listed {
    /// A view, which has its own writer.
    View(&'static View),
    /// A file that a machine runs, which is proved before it is written.
    Tool(&'static dyn ToolFile),
}

use Listed::{Tool, View as Shown};

/// Every kind of file, in the order in which files are listed.
pub const LISTED: &[Listed] = &[
    Shown(&write::dxf::FORMAT),
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
    Shown(&write::dxf::CUTTER_PATH),
    Shown(&write::csv::FURTHER),
];

/// The files that machines run.
pub fn tool_files() -> impl Iterator<Item = &'static dyn ToolFile> {
    LISTED.iter().filter_map(|listed| match listed {
        Tool(file) => Some(*file),
        Shown(_) => None,
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
            Tool(_) => None,
        }
    }
}

/// Every format, in the order in which files are listed.
pub fn formats() -> impl Iterator<Item = Format> {
    LISTED.iter().flat_map(|&source| {
        let (view, tool): (Option<&View>, &[ToolFormat]) = match source {
            Shown(view) => (Some(view), &[]),
            Tool(file) => (None, file.formats()),
        };
        let of_view = view.map(|view| Format { name: view.name, when: view.when, source });
        of_view.into_iter().chain(tool.iter().map(move |format| Format { name: format.name, when: format.when, source }))
    })
}

/// Those of the named formats that a machine runs, for a request.
#[must_use]
pub fn requested(names: &[String]) -> FormatNames {
    let run = tool_files().flat_map(ToolFile::formats).map(|format| format.name);
    run.filter(|name| names.iter().any(|asked| asked == name)).collect()
}

/// The formats that can be requested.
pub fn formats_by_name() -> impl Iterator<Item = Format> {
    formats().filter(|format| format.when != FormatSelection::Drawn)
}
