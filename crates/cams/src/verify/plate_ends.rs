//! The edges of a plate on the bed that no roller touches.

use super::check::{Evidence, FileCheck, place};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::edge_tree::EdgeTree;

pub(super) const ENDS: FileCheck = FileCheck {
    check: Check {
        name: "ends",
        on: CheckScope::Outline,
        unit: "mm",
        about: "The distance of the straight ends and run-outs of a plate from where they should be.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "max distance of the straight edges from where they should be",
            usual: "the tolerance",
            change: "restore the ends of the plate in the file",
        },
    },
    run: ends,
};

/// Points of an edge whose distance from the outline is measured.
const POINTS: u32 = 32;

fn ends(evidence: &Evidence<'_>) -> Option<Finding> {
    let (outline, edges) = (evidence.outlines.first()?, evidence.body.edges());
    if edges.is_empty() {
        return None;
    }
    let tree = EdgeTree::new(&outline.contour);
    let points = edges
        .iter()
        .flat_map(|[a, b]| (0..=POINTS).map(move |i| (a + (b - a) * (f64::from(i) / f64::from(POINTS))) * 1e3));
    let off = points.map(|point| (tree.nearest(point).map_or(f64::INFINITY, |nearest| nearest.left.abs()), point));
    let (value, point) = off.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let limit = evidence.tolerance_mm;
    let found = ENDS.found(value, Some(limit), Verdict::of(value <= limit));
    Some(Finding { place: place(evidence.body, point), ..found })
}
