//! Kinks between the segments of the outline.

use super::{Finding, Subject, place, verdict};

/// Largest kink, degrees: what controllers and shops take for smooth.
const LIMIT: f64 = 0.05;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let contour = subject.outline?;
    let breaks = contour.tangent_breaks();
    let (turn, vertex) = breaks.iter().zip(&contour.vertices).max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let value = turn.abs().to_degrees();
    Some(Finding {
        check: "tangency",
        value,
        limit: Some(LIMIT),
        unit: "deg",
        cam_deg: Some(place(subject.rotary, vertex.point)),
        verdict: verdict(value <= LIMIT),
        note: None,
    })
}
