//! The width of a groove as it is in the file: the room that the roller has between the two flanks, wherever the motion puts it.
//!
//! With the roller's centre where the motion wants it, its distances from the two flanks add up to the width across the groove there. Between the
//! places that are looked at the width changes by what the arcs of the flanks are off, which `rolling` finds exactly on each.

use super::check::{Evidence, FileCheck};
use super::swept;
use crate::body::Layer;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::numeric::extremum;
use camgen_kernel::profile::{Curves, Worst};
use camgen_kernel::text::{Length, text};

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "groove_width",
        on: CheckScope::Outline,
        unit: "mm",
        about: "The least width of a groove as it is in the file, across the roller: at least the diameter of the roller and its clearance. Between \
                the diameter less two tolerances and the diameter it is a warning.",
        explained: CheckExplanation {
            bound: Bound::AtLeast,
            formula: "min over the turn of the distances of the roller's centre from the two flanks, added up",
            usual: "the diameter of the roller with cam.clearance, less two tolerances",
            change: "a larger `cam.clearance`, `--side inside`, or a finer --tolerance",
        },
    },
    run: check,
};

/// Places of a piece between which the narrow ones are found, a few to an arc of either flank, how many of these are followed, and golden sections.
const PLACES: u32 = 240;
const NARROW: usize = 4;
const SECTIONS: u32 = 40;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    if let Some(found) = swept::least_width(evidence) {
        return Some(of_swept(evidence, found));
    }
    let cuts = evidence.body.cuts();
    let written = |hollow: bool| {
        let outline = evidence.outlines.iter().find(|outline| {
            cuts.get(outline.cut).is_some_and(|cut| cut.is_hollow() == hollow && cut.curves.is_some())
        })?;
        let cut = cuts.get(outline.cut)?;
        let mirrored = cut.mirrored == [true];
        let contour = if mirrored { outline.contour.mirrored_about_x() } else { outline.contour.clone() };
        Some((cut.curves?, contour))
    };
    if !cuts.iter().any(|cut| cut.layer == Layer::GrooveOuter) {
        return None;
    }
    let ((inner, inside), (outer, outside)) = (written(false)?, written(true)?);
    let least = least(inner, [&inside, &outside]);
    let roller = 2e3 * evidence.body.machine().follower.shape.element().offset();
    let nominal = 1e3 * (inner.offset() - outer.offset());
    let slack = 2.0 * evidence.tolerance_mm;
    let verdict = match least.value {
        width if !(width >= nominal - slack) => Verdict::Fail,
        width if width < roller => Verdict::Warn,
        _ => Verdict::Pass,
    };
    let note = match verdict {
        Verdict::Fail => {
            text!("{}, and {} is the width of the design", Length::mm(least.value), Length::mm(nominal))
        }
        Verdict::Warn => text!(
            "within the tolerance the roller is pinched by up to {}: give cam.clearance, or --side inside, with which no flank is nearer \
             than it should be",
            Length::um_of_mm(roller - least.value)
        ),
        _ => text!("the roller has {} of room", Length::mm(least.value - roller)),
    };
    let found = CHECK.found(least.value, Some(nominal - slack), verdict);
    Some(Finding { place: evidence.body.place(least.at), note: Some(note), ..found })
}

/// The finding on a groove in space, whose flanks stand out by at most so much (mm) from where they should be.
fn of_swept(evidence: &Evidence<'_>, (out, at): (f64, f64)) -> Finding {
    let machine = evidence.body.machine();
    let roller = 2e3 * machine.follower.shape.element().offset();
    let nominal = roller + 1e3 * machine.cam.track.clearance;
    let (least, slack) = (nominal - out, 2.0 * evidence.tolerance_mm);
    let verdict = match least {
        width if !(width >= nominal - slack) => Verdict::Fail,
        width if width < roller => Verdict::Warn,
        _ => Verdict::Pass,
    };
    let note = match verdict {
        Verdict::Pass => text!("the roller has at least {} of room", Length::mm(least - roller)),
        _ => text!(
            "within the tolerance the roller may be pinched by {}: give cam.clearance",
            Length::mm(roller - least)
        ),
    };
    Finding { place: evidence.body.place(at), note: Some(note), ..CHECK.found(least, Some(nominal - slack), verdict) }
}

/// The least width between the inner and the outer flank, mm, and where.
fn least(curves: Curves<'_>, flanks: [&Contour; 2]) -> Worst {
    let [inner, outer] = flanks.map(EdgeTree::new);
    let left = |tree: &EdgeTree, at| tree.nearest(at).map_or(f64::NAN, |nearest| nearest.left);
    let width = |piece: usize, at: f64| {
        let centre = curves.touch(piece, at).curve.point * 1e3;
        left(&outer, centre) - left(&inner, centre)
    };
    let pieces = curves.motion.pieces().iter().enumerate();
    let of_piece = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
        extremum::largest_of_hills(|at| -width(index, at), (piece.start, piece.end), PLACES, NARROW, SECTIONS)
    };
    let nothing = Worst { value: f64::INFINITY, at: 0.0, z: 0.0 };
    pieces.map(of_piece).fold(nothing, |least, next| {
        // Where it is not a number, it is least.
        if -next.value >= least.value { least } else { Worst { value: -next.value, at: next.at, z: 0.0 } }
    })
}
