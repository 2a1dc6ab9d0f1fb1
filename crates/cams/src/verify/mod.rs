//! Findings: of the written outline, of files that another program may have written, and of the figures that bodies and analyses measure.
//!
//! A check gives value, limit and place, also when it passes. A check of what was written is a [`FileCheck`] in a file here, and a line in
//! [`CHECKS`]; a check of a figure is a [`Check`], a measure in a body, and a line there for its place in reports.

mod balance;
mod bore;
mod check;
mod cutter_path;
mod felt;
mod felt_sections;
mod file;
mod flank;
mod groove_width;
mod lead_in;
mod list;
mod outline;
mod patches;
mod plate_ends;
pub mod rolling;
mod solid;
mod sphere;
mod swept;
mod swept_files;
mod tangency;
mod walls;

pub(crate) use bore::counted as counted_beside;
pub(crate) use check::place;
pub use check::{CheckEntry, Evidence, FileCheck, WrittenOutline, WrittenPath, WrittenSolid};
pub(crate) use cutter_path::{left_behind, moved_inwards};
pub use file::join_reach;
pub(crate) use lead_in::is_lead_in;
pub use list::CHECKS;
pub use solid::shell_reach;
pub use swept_files::WrittenSwept;

use crate::check::{AsWritten, Check, CheckScope, Measure, Measures, Walls, wall};
use crate::report::{Finding, worst_first};
use camgen_kernel::geometry::contour::Contour;

/// Runs every check that applies: failures first, then warnings, then the rest, each in the order of the catalogue. Checks that are not in
/// it stand behind them.
#[must_use]
pub fn run(evidence: &Evidence<'_>) -> Vec<Finding> {
    let applies = |check: &Check| match check.on {
        CheckScope::Cam => evidence.foreign.is_empty() && evidence.solid.is_none(),
        CheckScope::Outline => !evidence.outlines.is_empty() || evidence.swept.is_some(),
        CheckScope::Motion => evidence.foreign.is_empty() || !evidence.rolled.is_empty(),
        CheckScope::File => !evidence.foreign.is_empty() || evidence.solid.is_some(),
        CheckScope::ToolFile => true,
        CheckScope::Analysis => false,
    };
    let foreign = !evidence.foreign.is_empty();
    let outlines: Vec<&Contour> = evidence.outlines.iter().map(|outline| &outline.contour).collect();
    let walls = if applies(&wall::CHECK) { walls::of(evidence) } else { Walls::default() };
    let sizes = evidence.outlines.iter().map(|outline| outline.contour.extents().size().max());
    let written = AsWritten {
        rolled: evidence.rolled.first(),
        outlines: &outlines,
        foreign,
        tolerance_mm: evidence.tolerance_mm,
        walls,
        size_mm: sizes.reduce(f64::max),
    };
    let mut measures = Measures::new(&applies, written);
    evidence.body.measures(&mut measures);
    let rule = |listed: &CheckEntry| match listed {
        CheckEntry::File(rule) if applies(&rule.check) => (rule.run)(evidence),
        CheckEntry::File(_) | CheckEntry::Figure(_) => None,
    };
    let of_others = evidence.of_others.iter().filter(|measure| applies(measure.check));
    let figures = measures.found();
    let mut findings: Vec<Finding> = CHECKS.iter().filter_map(rule).collect();
    findings.extend(figures.iter().chain(of_others).map(Measure::finding));
    findings.extend(evidence.of_tool_files.iter().cloned());
    let order = &evidence.body.machine().catalogue().checks;
    findings.sort_by_key(|finding| order.iter().position(|name| *name == finding.check).unwrap_or(order.len()));
    worst_first(findings)
}

/// Judges the measures of an analysis, each by its check: failures first.
#[must_use]
pub fn judge(measures: &[Measure]) -> Vec<Finding> {
    worst_first(measures.iter().map(Measure::finding).collect())
}
