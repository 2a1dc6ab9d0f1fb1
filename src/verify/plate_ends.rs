//! Checks of a plate on the bed: the two rollers that face each other, and the edges that no roller touches.

use super::{Bound, Check, Evidence, Explained, On, at, place};
use crate::geometry::track::Track;
use crate::report::{Finding, Verdict};

pub(super) const ROLLER_CLEARANCE: Check = Check {
    name: "roller_clearance",
    on: On::Cam,
    about: "The gap between the rollers of the two flanks of a plate where they come closest to each other.",
    explained: Explained {
        bound: Bound::Above,
        formula: "the distance of the rollers' centres less the diameter",
        usual: "above 0",
        change: "a larger distance of the flanks `translating.plate_height`, or a smaller `translating.roller_radius`",
    },
    run: roller_clearance,
};

pub(super) const ENDS: Check = Check {
    name: "ends",
    on: On::Outline,
    about: "The distance of the straight ends and run-outs of a plate from where they should be.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max distance of the straight edges from where they should be",
        usual: "the tolerance",
        change: "restore the ends of the plate in the file",
    },
    run: ends,
};

/// Points of an edge at which the outline is looked for.
const POINTS: u32 = 32;

fn roller_clearance(evidence: &Evidence<'_>) -> Option<Finding> {
    let room = evidence.body.roller_clearance()?;
    let kept = room.value > 0.0;
    let note = (!kept).then(|| "the rollers of the two flanks meet; a higher plate keeps them apart".into());
    let found = ROLLER_CLEARANCE.found(1e3 * room.value, Some(0.0), "mm", Verdict::of(kept));
    Some(at(evidence.body, &room, found, note))
}

fn ends(evidence: &Evidence<'_>) -> Option<Finding> {
    let (outline, edges) = (evidence.outlines.first()?, evidence.body.edges());
    if edges.is_empty() {
        return None;
    }
    let track = Track::new(&outline.contour);
    let points = edges
        .iter()
        .flat_map(|[a, b]| (0..=POINTS).map(move |i| (a + (b - a) * (f64::from(i) / f64::from(POINTS))) * 1e3));
    let off = points.map(|point| (track.nearest(point).map_or(f64::INFINITY, |nearest| nearest.left.abs()), point));
    let (value, point) = off.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let limit = evidence.tolerance_mm;
    let found = ENDS.found(value, Some(limit), "mm", Verdict::of(value <= limit));
    Some(Finding { place: place(evidence.body, point), ..found })
}
