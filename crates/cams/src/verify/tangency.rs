//! Kinks between the segments of the outline. The corners at the ends of a plate do not count: joints within a few tolerances of
//! their intended place.

use super::check::{Evidence, FileCheck, WrittenOutline, place};
use crate::body::CORNER_REACH;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Place, Verdict};
use camgen_kernel::geometry::contour::Vertex;
use camgen_kernel::profile::followed::LARGEST_SMOOTH_KINK;
use camgen_kernel::text::{Length, text};

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "tangency",
        on: CheckScope::Outline,
        unit: "deg",
        about: "The largest kink between neighbouring arcs and lines of the outline. Controls and shops treat up to 0.05° as smooth; \
                more leaves a mark on the metal and knocks the follower.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "the angle between the tangents on both sides of a joint",
            usual: "0.05°, camgen's own rule",
            change: "write the file with more decimals, or write it with camgen again; splines and chords of other programs often have such kinks",
        },
    },
    run: check,
};

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
    let found = CHECK.found(value, Some(LARGEST_SMOOTH_KINK), Verdict::of(value <= LARGEST_SMOOTH_KINK));
    Some(match body.surface() {
        Some(_) => Finding {
            place: Place::default(),
            note: Some(text!("at z = {}", Length::mm(1e3 * z).decimals(3))),
            ..found
        },
        None => Finding { place: place(body, vertex.point), ..found },
    })
}
