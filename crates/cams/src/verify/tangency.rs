//! Kinks between the segments of the outline. The corners at the ends of a plate do not count: joints within a few tolerances of
//! their intended place.
//!
//! A file that was saved with few decimals has its vertices on a grid, and rounding turns the chords of short segments: by up to √2 of the
//! grid's width over the length of the segment. Kinks up to the limit and this are explained by the rounding and no fault of the cam: the
//! outline and the rolling are within the tolerance nevertheless, or their checks fail.

use super::check::{Evidence, FileCheck, WrittenOutline, place};
use crate::body::CORNER_REACH;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::reading::Reading;
use crate::report::{Bound, Finding, Place, Verdict};
use camgen_kernel::geometry::contour::{Contour, Vertex};
use camgen_kernel::profile::followed::LARGEST_SMOOTH_KINK;
use camgen_kernel::text::{Length, text};
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "tangency",
        on: CheckScope::Outline,
        unit: "deg",
        about: "The largest kink between neighbouring arcs and lines of the outline. Controls and shops treat up to 0.05° as smooth; \
                more leaves a mark on the metal and knocks the follower. Of a checked file whose vertices are rounded to a few decimals, \
                kinks up to 0.5° are a warning where the rounding explains them.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "the angle between the tangents on both sides of a joint",
            usual: "0.05°, camgen's own rule",
            change: "write the file with more decimals, or write it with camgen again; splines and chords of other programs often have such kinks",
        },
    },
    run: check,
};

/// Grids that are looked for: so many decimals in the unit of the file.
const DECIMALS: [i32; 4] = [3, 4, 5, 6];
/// A coordinate is on a grid within this share of its width.
const ON_GRID: f64 = 1e-3;
/// Rounding explains no larger kink than this, degrees.
const MOST_ROUNDED: f64 = 0.5;
/// An outline of fewer vertices may be on a grid by design.
const ENOUGH: usize = 8;

/// A kink of an outline.
struct Kink {
    /// Its angle, rad.
    turn: f64,
    vertex: Vertex,
    z: f64,
    /// What rounding may have added, rad.
    rounding: f64,
}

impl Kink {
    /// What is left of it without the rounding, rad.
    fn without_rounding(&self) -> f64 {
        self.turn.abs() - self.rounding
    }
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let reach = CORNER_REACH * 1e-3 * evidence.tolerance_mm;
    let kinks = |written: &WrittenOutline| -> Vec<Kink> {
        let grid = grid_of(&written.contour, evidence.foreign, evidence.tolerance_mm);
        let lengths: Vec<f64> = written.contour.edges().map(|edge| (edge.end() - edge.start()).norm()).collect();
        let before = lengths.iter().cycle().skip(lengths.len().saturating_sub(1));
        let around = before.zip(&lengths).map(|(before, after)| (*before, *after));
        let joints = written.contour.tangent_breaks().into_iter().zip(&written.contour.vertices).zip(around);
        let smooth = joints.filter(|((_, vertex), _)| !body.corner_within(vertex.point * 1e-3, reach));
        let kink = |((turn, vertex), (before, after)): ((f64, &Vertex), (f64, f64))| {
            let rounding = grid.map_or(0.0, |width| SQRT_2 * width * (1.0 / before + 1.0 / after));
            Kink { turn, vertex: *vertex, z: written.z, rounding }
        };
        smooth.map(kink).collect()
    };
    let all: Vec<Kink> = evidence.outlines.iter().flat_map(kinks).collect();
    let largest = all.iter().max_by(|a, b| a.turn.abs().total_cmp(&b.turn.abs()))?;
    let unexplained = all.iter().max_by(|a, b| a.without_rounding().total_cmp(&b.without_rounding()))?;
    let value = largest.turn.abs().to_degrees();
    let rounded = value > LARGEST_SMOOTH_KINK
        && value <= MOST_ROUNDED
        && unexplained.without_rounding().to_degrees() <= LARGEST_SMOOTH_KINK;
    let verdict = if rounded { Verdict::Warn } else { Verdict::of(value <= LARGEST_SMOOTH_KINK) };
    let found = CHECK.found(value, Some(LARGEST_SMOOTH_KINK), verdict);
    let grid = evidence.outlines.iter().find_map(|of| grid_of(&of.contour, evidence.foreign, evidence.tolerance_mm));
    let why = grid.filter(|_| rounded).map(|width| {
        text!(
            "the vertices are rounded to {}, which explains the kinks; a file with more decimals has none",
            Length::mm(width)
        )
    });
    Some(match body.surface() {
        Some(_) => {
            let at = text!("at z = {}", Length::mm(1e3 * largest.z).decimals(3));
            Finding { place: Place::default(), note: Some(at.and("; ", why)), ..found }
        }
        None => Finding { place: place(body, largest.vertex.point), note: why, ..found },
    })
}

/// The width of the grid, mm, on which all vertices of a file's outline lie: the coarsest of those that move no vertex by more than the
/// tolerance. `None` for an outline that is not of a file, or not on a grid.
fn grid_of(contour: &Contour, foreign: &[Reading], tolerance_mm: f64) -> Option<f64> {
    let unit = foreign.first()?.unit_mm;
    let is_on = |coordinate: f64, width: f64| {
        let steps = coordinate / width;
        (steps - steps.round()).abs() <= ON_GRID
    };
    DECIMALS
        .into_iter()
        .map(|decimals| unit * libm::exp10(-f64::from(decimals)))
        .filter(|width| width * FRAC_1_SQRT_2 <= tolerance_mm && contour.vertices.len() >= ENOUGH)
        .find(|width| contour.vertices.iter().all(|at| is_on(at.point.x, *width) && is_on(at.point.y, *width)))
}
