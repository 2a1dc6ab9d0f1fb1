//! Where the outline of a turning cam starts, and the path of the tool to there.

use super::{Body, Cut, Drawn, Part, Request};
use crate::report::shown;
use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::{MILLIMETRES, lead_in};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::outline::Outline;
use camgen_kernel::profile::{Curves, lifts};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// A dwell this near to the lowest lift, as a share of all the lift, is the lowest.
const LOWEST: f64 = 1e-9;
/// Depth below which a lead-in only touches the outline, as a share of the tolerance.
const TOUCHES: f64 = 0.1;

/// The middle of the longest dwell at the lowest lift, rad; `None` of a motion that does not rest there, or never moves.
fn longest_lowest_dwell(motion: &dyn Motion) -> Option<f64> {
    let period = motion.period()?;
    let (low, high) = lifts(motion);
    let pieces = motion.pieces();
    let rests = |index: usize| {
        pieces
            .get(index)
            .is_some_and(|piece| piece.dwell && motion.jet(index, piece.start).s <= low + LOWEST * (high - low))
    };
    let moves = (0..pieces.len()).find(|index| !rests(*index))?;
    let (mut longest, mut rest) = (None, None);
    for (index, piece) in pieces.iter().enumerate().cycle().skip(moves).take(pieces.len()) {
        let length = piece.end - piece.start;
        rest = match (rests(index), rest) {
            (true, Some((start, so_far))) => Some((start, so_far + length)),
            (true, None) => Some((piece.start, length)),
            (false, _) => None,
        };
        let length_of = |rest: Option<(f64, f64)>| rest.map_or(0.0, |(_, length)| length);
        if length_of(rest) > (1.0 + LOWEST) * length_of(longest) {
            longest = rest;
        }
    }
    longest.map(|(start, length)| (start + 0.5 * length).rem_euclid(period))
}

/// The point of the parallel of the follower's curve at a distance inwards (m) at a cam angle, as it lies in the drawing, mm.
fn place(curves: Curves<'_>, distance: f64, at: f64, mirrored: bool) -> Vector2<f64> {
    let (piece, angle) = curves.motion.locate(at);
    let point = curves.touch(piece, angle).curve.offset_inward(distance).point * MILLIMETRES;
    if mirrored { Vector2::new(point.x, -point.y) } else { point }
}

/// Calls a function with the curves of a cut.
fn with_curves(body: &dyn Body, cut: &Cut<'_>, with: &mut dyn FnMut(Curves<'_>)) {
    match (cut.curves, body.surface()) {
        (Some(curves), _) => with(curves),
        (None, Some(surface)) => surface.in_plane(cut.z, with),
        (None, None) => {}
    }
}

/// An outline along the parallel of the follower's curve at a distance inwards (m) with its start, and its lead-in where one is asked for.
fn outline_started(
    outline: &mut Outline,
    (curves, distance, mirrored): (Curves<'_>, f64, bool),
    request: &Request,
) -> Result<(), Refusal> {
    let at = request.start.or_else(|| longest_lowest_dwell(curves.motion));
    outline.contour = match at {
        Some(at) => outline.contour.started_near(place(curves, distance, at, mirrored)),
        None => outline.contour.started_where_flattest(),
    };
    let Some(asked) = request.lead_in else { return Ok(()) };
    let size = MILLIMETRES * asked.size;
    let Some(segment) = lead_in::segment(&outline.contour, asked.form, size) else { return Ok(()) };
    let tolerance = request.fit.tolerance_mm();
    let depth = lead_in::depth(&EdgeTree::new(&outline.contour), &Edge::Segment(segment), TOUCHES * tolerance);
    if depth > tolerance {
        let (size, depth) = (shown(size), shown(depth));
        let what = format!("the lead-in of {size} mm would cut {depth} mm into the cam on its way to the start");
        return Err(Refusal::new(what).remedy("give a smaller one, an arc, or another --start"));
    }
    outline.lead_in = Some(segment);
    Ok(())
}

/// Why a cut takes no start, or no lead-in, that was asked for.
fn refused(cut: &Cut<'_>, curves: Curves<'_>, request: &Request) -> Option<Refusal> {
    let plate = curves.motion.period().is_none();
    if plate && (request.start.is_some() || request.lead_in.is_some()) {
        let refusal = Refusal::new("a plate has no cam angle at which its cut could start");
        return Some(refusal.remedy("leave --start and --lead-in out"));
    }
    let inside = request.lead_in.is_some() && (cut.is_hollow() || cut.depth.is_some());
    inside.then(|| {
        let refusal =
            Refusal::new("a lead-in is drawn to an outline that is cut from outside, not to a groove or a ring");
        refusal.remedy("leave --lead-in out")
    })
}

/// A drawing whose outlines start where the request asks, else in the middle of the longest dwell at the lowest lift, or where the outline is
/// flattest; with the lead-ins.
///
/// # Errors
/// [`Refusal`] when a start or a lead-in is asked for a plate, which has no cam angle, a lead-in for a flank that is not cut from outside, or it
/// would cut into the cam.
pub(crate) fn started(body: &dyn Body, request: &Request, mut drawn: Drawn) -> Result<Drawn, Refusal> {
    let cuts = body.cuts();
    let outlines = drawn.parts.iter_mut().flat_map(Part::outlines_mut).map(|outline| (outline, 0.0));
    let paths = drawn.cutter_path.iter_mut().chain(&mut drawn.other_cutter_paths).flatten();
    let paths = paths.map(|path| (path, request.cutter_radius.unwrap_or(0.0)));
    let mut failed = None;
    for ((outline, cutter), cut) in outlines.zip(&cuts).chain(paths.zip(&cuts)) {
        with_curves(body, cut, &mut |curves| {
            let distance = curves.offset() - curves.metal_side() * cutter;
            let found = match refused(cut, curves, request) {
                Some(why) => Err(why),
                None if curves.motion.period().is_none() => Ok(()),
                None => outline_started(outline, (curves, distance, cut.mirrored == [true]), request),
            };
            failed = failed.take().or(found.err());
        });
    }
    failed.map_or(Ok(drawn), Err)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Machine;
    use crate::pipeline::Spec;

    /// The middle of the longest of the lowest dwells, degrees, of a program with these segments: law, extent and end.
    fn middle(segments: &[(&str, f64, f64)]) -> Option<f64> {
        let mut text = String::from("name = \"start\"\n[motion]\nstart = \"0 mm\"\n");
        for (law, over, to) in segments {
            text += &format!("[[motion.segment]]\nlaw = \"{law}\"\nover = \"{over} deg\"\n");
            if *law != "dwell" {
                text += &format!("to = \"{to} mm\"\n");
            }
        }
        text += "[follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"60 mm\"\n";
        let machine = Machine::from_toml("start.toml", &text, &[]).expect("a machine");
        let cam = Spec::of_program(machine, None).expect("a motion").solve().expect("a cam");
        let curves = crate::body::curves(cam.body()).expect("a disc");
        longest_lowest_dwell(curves.motion).map(f64::to_degrees)
    }

    #[test]
    fn a_cut_starts_in_the_middle_of_the_longest_lowest_dwell() {
        let law = "cycloidal";
        let of = |segments: &[(&str, f64, f64)], expected: Option<f64>| match (middle(segments), expected) {
            (Some(found), Some(expected)) => assert!((found - expected).abs() < 1e-9, "{found} for {expected}"),
            (found, expected) => assert_eq!(found, expected),
        };
        of(&[(law, 100.0, 20.0), ("dwell", 160.0, 0.0), (law, 80.0, 0.0), ("dwell", 20.0, 0.0)], Some(350.0));
        // The one that runs through the end of the turn is the longest.
        of(
            &[
                ("dwell", 30.0, 0.0),
                (law, 100.0, 20.0),
                (law, 90.0, 0.0),
                ("dwell", 40.0, 0.0),
                (law, 30.0, 5.0),
                (law, 40.0, 0.0),
                ("dwell", 30.0, 0.0),
            ],
            Some(0.0),
        );
        // Only the lowest counts, wherever the motion starts.
        of(&[("dwell", 90.0, 0.0), (law, 90.0, -10.0), ("dwell", 20.0, 0.0), (law, 160.0, 0.0)], Some(190.0));
        of(&[(law, 180.0, 20.0), (law, 180.0, 0.0)], None);
        of(&[("dwell", 360.0, 0.0)], None);
    }
}
