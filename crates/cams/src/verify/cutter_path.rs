//! What a cutter leaves along the written path, compared with the exact profile.
//!
//! The path is read back from its bytes and moved inwards by the cutter's radius: arcs and lines become arcs and lines, exactly;
//! about a concave kink the cutter sweeps an arc of its own radius, and a convex arc of its own radius shrinks to the edge it
//! was fitted about. The chain that is left is followed along the exact profile like an outline, in both directions.
//!
//! A band on one side: the cut moved by half the tolerance lies within half the tolerance of the profile. As parallel curves keep
//! their order, the cut itself then lies between the profile and its parallel at the tolerance.

use super::check::{Evidence, FileCheck, WrittenPath, place};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::contour::{Contour, Segment, Vertex};
use camgen_kernel::geometry::following::follow;
use camgen_kernel::geometry::two_sided_distance::two_sided_distance;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "cutter_path",
        on: CheckScope::ToolFile,
        unit: "mm",
        about: "The largest distance between the exact profile and what a cutter leaves along its path as it is in the file, in both \
                directions; on one side only where --side requests one.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "max distance between the parallel of the path at the cutter's radius and the exact profile",
            usual: "the tolerance, on the side of --side",
            change: "a finer --tolerance, or a smaller cutter",
        },
    },
    run: check,
};

/// A right turn of the path beyond this is a concave kink, in which the cutter turns on the spot, rad: far above the rounding of a file.
const LEAST_KINK: f64 = 1e-9;
/// An arc of the path whose radius is this near to that of the cutter leaves a point, mm.
const A_POINT: f64 = 1e-8;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let judged = evidence.cutter_paths.iter().filter_map(|path| along(evidence, path));
    judged.reduce(|worst, next| {
        let worse = (next.verdict.rank(), worst.value) < (worst.verdict.rank(), next.value);
        if worse { next } else { worst }
    })
}

/// Along one flank.
fn along(evidence: &Evidence<'_>, path: &WrittenPath) -> Option<Finding> {
    let limit = evidence.tolerance_mm;
    let none = |why: String| {
        let found = CHECK.found(f64::INFINITY, Some(limit), Verdict::Fail);
        Some(Finding { note: Some(why.into()), ..found })
    };
    let contour = match &path.contour {
        Ok(contour) => contour,
        Err(why) => return none(why.clone()),
    };
    let left = match left_behind(evidence, path.cut, (path.radius, path.middle), contour) {
        Ok(Some(left)) => left,
        Ok(None) => return None,
        Err(why) => return none(why),
    };
    let side = match path.middle {
        middle if middle > 0.0 => "never outside it",
        middle if middle < 0.0 => "never inside it",
        _ => "on either side",
    };
    let cutter = text!(
        "cutter Ø{} along {} segments as read from the file, in both directions, {}",
        Length::mm(2.0 * path.radius),
        contour.vertices.len(),
        side
    );
    let note = Text::from(left.fault).and("; ", cutter);
    let found = CHECK.found(left.distance, Some(limit), Verdict::of(left.kept));
    Some(Finding { place: place(evidence.body, left.at), note: Some(note), ..found })
}

/// What a cutter leaves along a path.
pub(crate) struct LeftBehind {
    /// Largest distance from the exact profile, mm, in both directions.
    pub(crate) distance: f64,
    /// Where, mm.
    pub(crate) at: Vector2<f64>,
    /// Whether it keeps the tolerance, on its side.
    pub(crate) kept: bool,
    /// That it does not go round the profile, and where.
    pub(crate) fault: Option<String>,
}

/// What a cutter of a radius leaves along a counter-clockwise path about a cut; `middle` is how far the middle of the tolerance band lies
/// inwards of the exact profile, all in mm. `None` where the cut has no exact profile.
pub(crate) fn left_behind(
    evidence: &Evidence<'_>,
    cut: usize,
    (radius, middle): (f64, f64),
    contour: &Contour,
) -> Result<Option<LeftBehind>, String> {
    let cuts = evidence.body.cuts();
    let Some(of) = cuts.get(cut) else { return Ok(None) };
    let Some(profile) = evidence.body.boundary(of).map_err(|error| error.to_string())? else { return Ok(None) };
    let inwards = |contour: &Contour| moved_inwards(contour, radius - middle);
    let moved = if of.is_hollow() { inwards(&contour.reversed()).map(|cut| cut.reversed()) } else { inwards(contour) };
    let moved = moved.ok_or("the path has cubic curves, whose parallels are not cubic curves")?;
    let room = evidence.tolerance_mm - middle.abs();
    let (worst, kept, fault) = match follow(&moved, &profile) {
        Ok(worst) => (worst, worst.distance <= room, None),
        Err(lost) => {
            let at = place(evidence.body, lost.at);
            (
                two_sided_distance(&moved, &profile),
                false,
                Some(format!("the cut departs from the profile at {}", at.text())),
            )
        }
    };
    Ok(Some(LeftBehind { distance: worst.distance + middle.abs(), at: worst.at, kept, fault }))
}

/// What a cutter of this radius (mm) leaves on the left of its path; `None` where the path is not of arcs and lines.
pub(crate) fn moved_inwards(path: &Contour, radius: f64) -> Option<Contour> {
    let segments: Vec<Segment> = path.segments()?;
    let before = segments.iter().cycle().skip(segments.len().saturating_sub(1));
    let left = |tangent: Vector2<f64>| Vector2::new(-tangent.y, tangent.x) * radius;
    let mut vertices = Vec::new();
    for ((segment, before), turn) in segments.iter().zip(before).zip(path.tangent_breaks()) {
        if turn < -LEAST_KINK {
            let point = segment.start + left(before.end_tangent());
            vertices.push(Vertex::new(point, libm::tan(0.25 * turn)));
        }
        if segment.bulge == 0.0 || (segment.radius() - radius).abs() > A_POINT {
            vertices.push(Vertex::new(segment.start + left(segment.start_tangent()), segment.bulge));
        }
    }
    Some(Contour { vertices })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Request;
    use crate::machine::Machine;
    use crate::pipeline::Spec;
    use camgen_kernel::profile::outline::MotionTolerance;
    use camgen_kernel::profile::outline::{Fit, Side};

    fn cam() -> crate::pipeline::Cam {
        let machine = Machine::load("feeder", &[]).expect("valid").0;
        Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
    }

    /// A wide band has room for arcs that are smaller than the cutter, along which the cut runs backwards: the path is drawn without them.
    /// Earlier, cutters of 40 mm to 200 mm were refused on this cam at 50 µm.
    #[test]
    fn a_path_within_a_wide_band_has_no_arc_smaller_than_the_cutter() {
        let cam = cam();
        for cutter in [20.0, 30.0, 40.0] {
            for side in [Side::Both, Side::Outside, Side::Inside] {
                let fit = Fit { side, ..Fit::from(50e-6) };
                let request = Request { cutter_radius: Some(1e-3 * cutter), ..Request::within(fit) };
                let proven = cam.draw(request).expect("drawn").prove().expect("proved");
                let found = proven.findings().iter().find(|f| f.check == "cutter_path").expect("checked");
                assert_eq!(found.verdict, Verdict::Pass, "{cutter} {side:?}: {found:?}");
            }
        }
    }

    /// A path that is slightly off, or of another cutter, fails; so does a missing path.
    #[test]
    fn a_wrong_path_fails() {
        let cam = cam();
        let request = Request { cutter_radius: Some(0.01), ..Request::within(5e-6) };
        let proven = cam.draw(request).expect("drawn").prove().expect("proved");
        let drawn = proven.drawn().and_then(|drawn| drawn.cutter_path.as_ref()).expect("requested");
        let contour = drawn.as_ref().expect("a path").contour.clone();
        let verdict = |path: WrittenPath| {
            let evidence = Evidence {
                cutter_paths: std::slice::from_ref(&path),
                ..Evidence::without_files(cam.body(), 5e-3, MotionTolerance::ANY)
            };
            check(&evidence).expect("checked").verdict
        };
        let right =
            WrittenPath { cut: 0, radius: 10.0, middle: 0.0, contour: Ok(contour.clone()), lead_ins: Vec::new() };
        assert_eq!(verdict(right.clone()), Verdict::Pass);
        assert_eq!(verdict(WrittenPath { radius: 10.02, ..right.clone() }), Verdict::Fail);
        assert_eq!(verdict(WrittenPath { middle: 2.5e-3, ..right.clone() }), Verdict::Fail);
        let mut moved = contour;
        moved.vertices[7].point.x += 0.02;
        assert_eq!(verdict(WrittenPath { contour: Ok(moved), ..right.clone() }), Verdict::Fail);
        assert_eq!(verdict(WrittenPath { contour: Err("no path".into()), ..right }), Verdict::Fail);
    }
}
