//! Kinks between the segments of the outline. The corners of a plate's ends are none.

use super::{Finding, Subject, place, verdict};
use crate::cam::Place;
use crate::contour::Vertex;

/// Largest kink, degrees: what controllers and shops take for smooth.
const LIMIT: f64 = 0.05;

pub(super) fn check(subject: &Subject<'_>) -> Option<Finding> {
    let contour = subject.outline?;
    let breaks = contour.tangent_breaks();
    let smooth = |(_, vertex): &(&f64, &Vertex)| !subject.cam.ends_at(vertex.point * 1e-3);
    let joints = breaks.iter().zip(&contour.vertices).filter(smooth);
    let (turn, vertex) = joints.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    Some(finding(*turn, place(subject.cam, vertex.point)))
}

/// The verdict on the worst turn of the tangent, rad.
pub(super) fn finding(turn: f64, place: Place) -> Finding {
    let value = turn.abs().to_degrees();
    Finding {
        check: "tangency",
        value,
        limit: Some(LIMIT),
        unit: "deg",
        place,
        verdict: verdict(value <= LIMIT),
        note: None,
    }
}
