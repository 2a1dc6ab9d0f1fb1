//! The written outline against the exact profile, both ways: no point of either lies farther than the tolerance from the other,
//! and the outline is one simple loop that runs round once. What a roller cannot feel, a slot narrower than its own sag or a
//! bump between two places where it was put, shows here.

use super::{Bound, Check, Evidence, Explained, On, WrittenOutline, place};
use crate::geometry::apart::apart;
use crate::geometry::contour::Contour;
use crate::geometry::following::{Astray, Lost, follow};
use crate::numeric::parallel;
use crate::report::{Finding, Verdict};
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "outline",
    on: On::Outline,
    about: "The largest distance between the outline as it is in the file and the exact profile, either way: of any point of one \
            from the nearest of the other. The outline must also be one simple loop that runs round once.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max over both curves of the distance to the nearest point of the other (Hausdorff distance), bounded between places",
        usual: "the tolerance",
        change: "a finer --tolerance in the program that wrote the file; where the file is another cam, the report says which",
    },
    run: check,
};

/// How far an outline lies from its profile.
struct Found {
    /// mm; infinite where there is no profile.
    distance: f64,
    /// Place of the drawing, mm.
    at: Vector2<f64>,
    /// Place along the axis, m.
    z: f64,
    /// Why it is no loop about the profile, and where.
    lost: Option<Lost>,
    /// There is no profile to compare it with, and why.
    without: Option<String>,
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let all: Vec<Found> = parallel::map(evidence.outlines, |written| of(evidence, written));
    let fails = |found: &Found| found.lost.is_some() || found.without.is_some();
    // A loop that is none is worse than any distance.
    let worst = all.into_iter().reduce(|a, b| {
        let worse = (fails(&b), b.distance) > (fails(&a), a.distance);
        if worse { b } else { a }
    })?;
    let limit = evidence.tolerance_mm;
    let kept = worst.distance <= limit && !fails(&worst);
    let found = CHECK.found(worst.distance, Some(limit), "mm", Verdict::of(kept));
    let words = [
        worst.without.clone(),
        worst.lost.map(|lost| words(evidence, &lost)),
        evidence.body.along_axis(worst.z),
        worst.without.is_none().then(|| format!("both ways, over {} segments", segments(evidence.outlines))),
    ];
    let note = words.into_iter().flatten().collect::<Vec<_>>().join("; ");
    Some(Finding { place: place(evidence.body, worst.at), note: Some(note), ..found })
}

fn segments(outlines: &[WrittenOutline]) -> usize {
    outlines.iter().map(|outline| outline.contour.vertices.len()).sum()
}

fn of(evidence: &Evidence<'_>, written: &WrittenOutline) -> Found {
    let first = written.contour.vertices.first().map_or_else(Vector2::zeros, |vertex| vertex.point);
    let nothing =
        |why: String| Found { distance: f64::INFINITY, at: first, z: written.z, lost: None, without: Some(why) };
    let boundary = match evidence.body.boundary(written.z) {
        Ok(Some(boundary)) => boundary,
        Ok(None) => return nothing("the cam has no profile here".into()),
        Err(error) => return nothing(error.to_string()),
    };
    match follow(&written.contour, &boundary) {
        Ok(worst) => Found { distance: worst.distance, at: worst.at, z: written.z, lost: None, without: None },
        Err(lost) => {
            let worst = apart(&written.contour, &boundary);
            let lost = if turns(&written.contour) { lost } else { Lost { why: Astray::Turns, ..lost } };
            Found { distance: worst.distance, at: worst.at, z: written.z, lost: Some(lost), without: None }
        }
    }
}

/// Whether it turns round once.
fn turns(contour: &Contour) -> bool {
    contour.turns() == 1.0
}

fn words(evidence: &Evidence<'_>, lost: &Lost) -> String {
    let at = place(evidence.body, lost.at);
    let what = match lost.why {
        Astray::Back => "turns back, or across the profile,",
        Astray::Away => "leaves the profile",
        Astray::Turns => "does not go round once; it departs from the profile",
    };
    format!("the outline {what} at {at}")
}
