//! The written outline compared with the exact profile, in both directions: no point of either lies farther than the tolerance from
//! the other, and the outline is one simple loop that runs round once. A slot narrower than the sag of the roller, or a bump between
//! two places at which the roller was put, is invisible to rolling; it shows here.

use super::check::{Evidence, FileCheck, WrittenOutline, place};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict, to_type};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::following::{FollowingError, FollowingFault, follow};
use camgen_kernel::geometry::two_sided_distance::two_sided_distance;
use camgen_kernel::numeric::parallel;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "outline",
        on: CheckScope::Outline,
        unit: "mm",
        about: "The largest distance between the outline as it is in the file and the exact profile, in both directions: of any point of one \
                from the nearest point of the other. The outline must also be one simple loop that runs round once.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "max over both curves of the distance to the nearest point of the other (Hausdorff distance), bounded between places",
            usual: "the tolerance; half of cam.profile_tolerance where that is less",
            change: "a finer --tolerance in the program that wrote the file; where the file is another cam, the report says how it differs",
        },
    },
    run: check,
};

/// How far an outline lies from its profile.
struct OutlineDistance {
    /// Distance, mm; infinite where there is no profile.
    distance: f64,
    /// Place in the drawing, mm.
    at: Vector2<f64>,
    /// Place along the axis, m.
    z: f64,
    /// Why it is not a loop about the profile, and where.
    lost: Option<FollowingError>,
    /// Why there is no profile to compare it with.
    without: Option<String>,
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let all: Vec<OutlineDistance> = parallel::map(evidence.outlines, |written| of(evidence, written));
    let fails = |found: &OutlineDistance| found.lost.is_some() || found.without.is_some();
    // An outline that is not a loop is worse than any distance.
    let worst = all.into_iter().reduce(|a, b| {
        let worse = (fails(&b), b.distance) > (fails(&a), a.distance);
        if worse { b } else { a }
    })?;
    // Half of the zone for manufacture lies on either side of the drawn profile: a file must not leave it by itself.
    let zone = evidence.body.machine().title.profile_tolerance.map(|width| 0.5 * MILLIMETRES * width);
    let limit = zone.map_or(evidence.tolerance_mm, |zone| zone.min(evidence.tolerance_mm));
    let kept = worst.distance <= limit && !fails(&worst);
    let found = CHECK.found(worst.distance, Some(limit), Verdict::of(kept));
    let words = [
        worst.without.clone().map(Text::from),
        worst.lost.map(|lost| words(evidence, &lost)),
        evidence.body.along_axis(worst.z),
        zone.filter(|zone| !kept && worst.distance > *zone && worst.without.is_none()).map(|zone| {
            let finer = to_type(1e3 * 0.5 * zone);
            text!(
                "cam.profile_tolerance permits {}; --tolerance {}um leaves half of it to manufacture",
                Length::mm(zone),
                finer
            )
        }),
        worst.without.is_none().then(|| text!("in both directions, over {} segments", segments(evidence.outlines))),
    ];
    let note = Text::joined(words.into_iter().flatten(), "; ");
    Some(Finding { place: place(evidence.body, worst.at), note: Some(note), ..found })
}

fn segments(outlines: &[WrittenOutline]) -> usize {
    outlines.iter().map(|outline| outline.contour.vertices.len()).sum()
}

fn of(evidence: &Evidence<'_>, written: &WrittenOutline) -> OutlineDistance {
    let first = written.contour.vertices.first().map_or_else(Vector2::zeros, |vertex| vertex.point);
    let nothing = |why: String| OutlineDistance {
        distance: f64::INFINITY,
        at: first,
        z: written.z,
        lost: None,
        without: Some(why),
    };
    let Some(cut) = evidence.cut_of(written) else { return nothing("the cam has no profile here".into()) };
    let boundary = match evidence.body.boundary(&cut) {
        Ok(Some(boundary)) => boundary,
        Ok(None) => return nothing("the cam has no profile here".into()),
        Err(error) => return nothing(error.to_string()),
    };
    match follow(&written.contour, &boundary) {
        Ok(worst) => {
            OutlineDistance { distance: worst.distance, at: worst.at, z: written.z, lost: None, without: None }
        }
        Err(lost) => {
            let worst = two_sided_distance(&written.contour, &boundary);
            let lost =
                if turns(&written.contour) { lost } else { FollowingError { why: FollowingFault::Turns, ..lost } };
            OutlineDistance { distance: worst.distance, at: worst.at, z: written.z, lost: Some(lost), without: None }
        }
    }
}

/// Whether the contour turns round once.
fn turns(contour: &Contour) -> bool {
    contour.turns() == 1.0
}

fn words(evidence: &Evidence<'_>, lost: &FollowingError) -> Text {
    let at = place(evidence.body, lost.at);
    let what = match lost.why {
        FollowingFault::Back => "turns back, or runs across the profile,",
        FollowingFault::Away => "leaves the profile",
        FollowingFault::Turns => "does not go round once: it departs from the profile",
    };
    text!("the outline {} at {}", what, at.text())
}
