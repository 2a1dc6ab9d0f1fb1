//! What only a plate has: two rollers that face each other, and edges no roller touches.

use super::surface::Surface;
use super::{Finding, Subject, place, verdict};

/// Points of an edge at which the outline is looked for.
const POINTS: u32 = 32;

/// The rollers of the two flanks stay clear of each other.
pub(super) fn roller_clearance(subject: &Subject<'_>) -> Option<Finding> {
    let (room, place) = subject.cam.roller_clearance()?;
    let kept = room > 0.0;
    Some(Finding {
        check: "roller_clearance",
        value: 1e3 * room,
        limit: Some(0.0),
        unit: "mm",
        place,
        verdict: verdict(kept),
        note: (!kept).then(|| "the rollers of the two flanks meet; a higher plate keeps them apart".into()),
    })
}

/// Ends and run-outs are where they belong.
pub(super) fn ends(subject: &Subject<'_>) -> Option<Finding> {
    let (outline, edges) = (subject.outline?, subject.cam.edges());
    if edges.is_empty() {
        return None;
    }
    let surface = Surface::new(outline);
    let points = edges
        .iter()
        .flat_map(|[a, b]| (0..=POINTS).map(move |i| (a + (b - a) * (f64::from(i) / f64::from(POINTS))) * 1e3));
    let off = points.map(|point| (surface.nearest(point).map_or(f64::INFINITY, |nearest| nearest.left.abs()), point));
    let (value, point) = off.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Finding {
        check: "ends",
        value,
        limit: Some(subject.tolerance_mm),
        unit: "mm",
        place: place(subject.cam, point),
        verdict: verdict(value <= subject.tolerance_mm),
        note: None,
    })
}
