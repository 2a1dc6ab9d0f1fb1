//! Files to cut from: the outline of every part, the developed view of a cam whose flanks a roller sweeps, and the path of a cutter.
//!
//! Their bytes are read back by `reading` and judged by `verify`, which rolls the follower on them; what is read is the evidence by which the
//! other files are judged, too.

mod cuts;
mod judge;
pub mod proof;
#[cfg(feature = "second-reader")]
mod second_reader;
mod write;

pub use cuts::ProvedCuts;
pub use judge::{judge_path, judge_path_as_read, judge_swept};
pub use write::{DxfForm, Version, cutter_path, marked, write};

use super::tool_file::ProvedFile;
use crate::body::{Body, Drawn};
use crate::report::{shown, warning};
use crate::write::{FormatSelection, Rendering, endings_of_outlines, endings_of_parts};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;

/// A format of files to cut from.
#[derive(Debug)]
pub struct CutFormat {
    /// Its name on the command line.
    pub name: &'static str,
    /// When it is written.
    pub when: FormatSelection,
    /// Why a cam cannot have it, if it cannot.
    pub unfit: fn(&dyn Body) -> Option<&'static str>,
    /// The endings of its files, added to the stem of their names; empty where the drawing has nothing for the format.
    pub endings: fn(&Drawn) -> Vec<String>,
    /// The files, as they were proved.
    pub files: fn(&ProvedCuts, &Rendering<'_>) -> Result<Vec<ProvedFile>, Refusal>,
}

/// The outlines, one file for each section; the files of a cam that breaks a limit say so in their first line.
pub const OUTLINES: CutFormat = CutFormat {
    name: "dxf",
    when: FormatSelection::Usual,
    unfit: |body| {
        let hollow = body.swept().is_some_and(|flanks| flanks.developed().is_empty());
        hollow.then_some("the outside of this cam cannot be developed; its STEP file has the solid")
    },
    endings: |drawn| {
        let developed =
            drawn.swept.iter().filter(|swept| !swept.developed.is_empty()).map(|_| "-unrolled.dxf".to_owned());
        endings_of_parts(drawn, ".dxf").into_iter().chain(developed).collect()
    },
    files: |proved, cam| {
        let warning = warning(cam.findings).unwrap_or_default();
        Ok(proved.cuts_after(&(OUTLINES.endings)(cam.drawn), &warning))
    },
};

/// The paths of a cutter's centre.
pub const CUTTER_PATHS: CutFormat = CutFormat {
    name: "cutter path",
    when: FormatSelection::Drawn,
    unfit: |_| None,
    endings: |drawn| match drawn.cutter_paths().count() {
        0 => Vec::new(),
        1 => vec!["-cutter.dxf".into()],
        _ => endings_of_outlines(drawn, "-cutter.dxf"),
    },
    files: |proved, cam| {
        let units = cam.body.machine().units();
        let diameter = cam.cutter_radius.map_or(f64::NAN, |radius| units.of_mm(2.0 * MILLIMETRES * radius));
        let (mark, unit) = (cam.report.mark(), units.symbol());
        let comment = format!("{mark}; path of the centre of a cutter of diameter {} {unit}", shown(diameter));
        proved.paths_after(&(CUTTER_PATHS.endings)(cam.drawn), &comment)
    },
};
