//! The metal between what is cut, as it is written: outline, bore with its keyway, holes.

use super::check::{Evidence, WrittenOutline, place};
use crate::body::Cut;
use crate::check::{Wall, Walls};
use crate::reading::Chain;
use camgen_kernel::geometry::clearance::{self, Clearance};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::section::crossings;
use nalgebra::Vector2;

/// The thinnest places of all outlines.
pub(super) fn of(evidence: &Evidence<'_>) -> Walls {
    let wall = |clearance: Option<Clearance>| {
        clearance.map(|found| Wall { distance: found.distance, place: place(evidence.body, found.at) })
    };
    let (mut bores, mut others) = (None, None);
    let within = evidence.body.cuts().iter().any(Cut::is_hollow);
    for outline in evidence.outlines {
        let [bore, holes] = of_outline(outline, within);
        bores = thinner(bores, bore);
        others = thinner(others, holes);
    }
    Walls { about_bore: wall(thinner(bores, between_flanks(evidence))), about_holes: wall(others) }
}

/// Between the two flanks of a wall that goes through.
fn between_flanks(evidence: &Evidence<'_>) -> Option<Clearance> {
    let cuts = evidence.body.cuts();
    let flank = |hollow: bool| {
        let is = |outline: &&WrittenOutline| cuts.get(outline.cut).is_some_and(|cut| cut.is_hollow() == hollow);
        evidence.outlines.iter().find(is).map(|outline| &outline.contour)
    };
    let (outer, inner) = flank(false).zip(flank(true))?;
    // Of a groove the hollow flank is the outer one, and there is no metal between them.
    let is_wall = outer.area_and_centroid().0 > inner.area_and_centroid().0;
    if is_wall { clearance::around(outer, inner) } else { None }
}

fn thinner(one: Option<Clearance>, other: Option<Clearance>) -> Option<Clearance> {
    one.into_iter().chain(other).min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Whether a contour goes round the shaft.
fn is_round_the_axis(contour: &Contour) -> bool {
    EdgeTree::new(contour).nearest(Vector2::zeros()).is_some_and(|axis| axis.left > 0.0)
}

/// Whether a contour lies inside another, by its first point.
fn is_inside(outline: &Contour, contour: &Contour) -> bool {
    let Some(first) = contour.edges().next() else { return false };
    let beyond = crossings(outline, first.start(), Vector2::x()).into_iter().filter(|distance| *distance > 0.0);
    beyond.count() % 2 == 1
}

/// Of one outline: about the hole that the shaft goes through, and about the others.
fn of_outline(outline: &WrittenOutline, within: bool) -> [Option<Clearance>; 2] {
    let closed = outline.others.iter().filter(|chain| chain.closed);
    let all: Vec<Contour> = closed.map(Chain::counter_clockwise).collect();
    // Where a roller runs within the part, what goes round an outline bounds the metal outside of it.
    let own = outline.contour.area_and_centroid().0;
    let (round, holes): (Vec<Contour>, Vec<Contour>) = all
        .into_iter()
        .partition(|contour| within && is_round_the_axis(contour) && contour.area_and_centroid().0 > own);
    let outside = round.iter().filter_map(|blank| clearance::around(blank, &outline.contour));
    let mut found = [outside.reduce(|a, b| if b.distance < a.distance { b } else { a }), None];
    for (index, hole) in holes.iter().enumerate() {
        let bore = is_round_the_axis(hole);
        let [about_bore, about_holes] = &mut found;
        let slot = if bore { about_bore } else { &mut *about_holes };
        // Of a groove a hole may lie outside of a flank, between the groove and the edge of the blank.
        let from_outline = if within && !is_inside(&outline.contour, hole) {
            clearance::between(&outline.contour, hole)
        } else {
            clearance::around(&outline.contour, hole)
        };
        *slot = thinner(*slot, from_outline);
        *slot = round.iter().fold(*slot, |thin, blank| thinner(thin, clearance::around(blank, hole)));
        for other in holes.iter().skip(index + 1) {
            *about_holes = thinner(*about_holes, clearance::between(hole, other));
        }
    }
    found
}
