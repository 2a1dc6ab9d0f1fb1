//! Kinks between the segments of the outline. The corners of a plate's ends do not count: joints within a few tolerances of where
//! they are meant to be.

use super::{Bound, Check, Evidence, Explained, On, WrittenOutline, place};
use crate::body::CORNER_REACH;
use crate::geometry::contour::Vertex;
use crate::report::{Finding, Place, Verdict};

pub(super) const CHECK: Check = Check {
    name: "tangency",
    on: On::Outline,
    about: "The largest kink between neighbouring arcs and lines of the outline. Controls and shops take up to 0.05° for smooth; \
            more is a mark on the metal and a knock in the follower.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "the angle between the tangents on both sides of a joint",
        usual: "0.05°, camgen's own rule",
        change: "write the file with more decimals, or let camgen write it again; splines and chords from other programs have such kinks",
    },
    run: check,
};

/// Largest kink, degrees, that controllers and shops treat as smooth.
const LIMIT: f64 = 0.05;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let reach = CORNER_REACH * 1e-3 * evidence.tolerance_mm;
    let of = |written: &WrittenOutline| -> Option<(f64, Vertex, f64)> {
        let breaks = written.contour.tangent_breaks();
        let smooth = |(_, vertex): &(&f64, &Vertex)| !body.corner_within(vertex.point * 1e-3, reach);
        let joints = breaks.iter().zip(&written.contour.vertices).filter(smooth);
        let (turn, vertex) = joints.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        Some((*turn, *vertex, written.z))
    };
    let all = evidence.outlines.iter().filter_map(of);
    let (turn, vertex, z) = all.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let value = turn.abs().to_degrees();
    let found = CHECK.found(value, Some(LIMIT), "deg", Verdict::of(value <= LIMIT));
    Some(match body.spatial() {
        Some(_) => Finding { place: Place::default(), note: Some(format!("at z = {:.3} mm", 1e3 * z)), ..found },
        None => Finding { place: place(body, vertex.point), ..found },
    })
}
