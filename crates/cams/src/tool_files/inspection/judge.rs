//! The places of a written list for a measuring machine, compared with the outline as it is in the cut file.
//!
//! The places are those that are read back from the bytes. Each must lie on the outline as it was read from the cut file, its normal must be
//! perpendicular to the exact profile, whose direction is found from two places close to each other, and its ball must touch there. Of a list
//! that is checked without a cut file every place must be that of the exact profile.

use super::super::head::{self, HeadLine, lines_after};
use super::read::{PLAIN_INCHES, ReadPlace, read};
use super::write::{program_statements, statements};
use crate::body::part_tolerance::PartTolerance;
use crate::body::{Body, Cut};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::machine::Rotation;
use crate::report::{Bound, Finding, Verdict, shown};
use crate::verify::{Evidence, place};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::profile::Curves;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "inspection",
    on: CheckScope::ToolFile,
    unit: "mm",
    about: "The largest distance of the places of --format inspect, as they are in each of its files, from the outline in the cut file, or, of a \
            list that is checked, from the exact profile. Each normal must be perpendicular to the profile, and each ball must touch it at its \
            place.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max distance of a place from the outline as written",
        usual: "the tolerance",
        change: "write the list anew; where camgen itself refuses what it wrote, please report this",
    },
};

/// Half of the angle between the places from which the direction of the profile is found, rad.
const STEP: f64 = 1e-6;
/// Largest sine between a normal and that of the profile, and the largest error of a length of 1 mm.
const UPRIGHT: f64 = 1e-5;
const EXACT: f64 = 1e-6;
/// The largest error of the length of a normal, of components of six decimals.
const NORMAL: f64 = 2e-6;
/// Share of a curvature, 1/mm, by which two of them may differ: far above the rounding of a file.
const SAME_BEND: f64 = 1e-4;
/// Angles that differ by less are equal, degrees.
const SAME_ANGLE: f64 = 1e-6;

/// The cam angle of a place among so many, degrees.
#[expect(clippy::cast_precision_loss, reason = "numbers of places")]
pub(in super::super) fn angle_of_place(index: usize, count: usize) -> f64 {
    360.0 * index as f64 / count as f64
}

/// A list as it was read.
pub(super) struct WrittenInspection {
    /// On which of the cuts of its body the places are.
    pub(super) cut: usize,
    /// Radius of the ball, mm; 0 in a form without it.
    pub(super) ball_radius: f64,
    /// The places, or why there are none.
    pub(super) places: Result<Vec<ReadPlace>, String>,
}

impl WrittenInspection {
    /// Reads a file in any of the forms, of a cut.
    pub(super) fn read(cut: usize, bytes: &[u8]) -> Self {
        let places = read(bytes);
        let first = places.as_ref().ok().and_then(|places| places.first());
        let ball_radius = first.map_or(0.0, |place| (place.ball - place.point).norm());
        Self { cut, ball_radius, places }
    }
}

/// The finding on lists of a cam; none where there are none.
pub(super) fn judge(evidence: &Evidence<'_>, lists: &[WrittenInspection]) -> Option<Finding> {
    let limit = evidence.tolerance_mm;
    let mut worst = (0.0, Vector2::zeros());
    let mut count = 0;
    for list in lists {
        match compare(evidence, list) {
            Err(why) => {
                let found = CHECK.found(f64::INFINITY, Some(limit), Verdict::Fail);
                return Some(Finding { note: Some(why.into()), ..found });
            }
            Ok((distance, at, places)) => {
                count += places;
                if distance >= worst.0 {
                    worst = (distance, at);
                }
            }
        }
    }
    if lists.is_empty() {
        return None;
    }
    let on = if evidence.outlines.is_empty() { "the exact profile" } else { "the outline as read from the cut file" };
    let note = format!("{count} places as read, on {on}");
    let found = CHECK.found(worst.0, Some(limit), Verdict::of(worst.0 <= limit));
    Some(Finding { place: place(evidence.body, worst.1), note: Some(note.into()), ..found })
}

/// The largest distance of the places of a list, where, and how many there are.
fn compare(evidence: &Evidence<'_>, list: &WrittenInspection) -> Result<(f64, Vector2<f64>, usize), String> {
    let places = list.places.as_ref().map_err(Clone::clone)?;
    let cuts = evidence.body.cuts();
    let curves = cuts.get(list.cut).and_then(|cut| cut.curves).ok_or("the cam has no such cut")?;
    let outline = evidence.outlines.iter().find(|outline| outline.cut == list.cut);
    let tree = outline.map(|outline| EdgeTree::new(&outline.contour));
    let tolerance = PartTolerance::of(evidence.body);
    let (zone, from) = (tolerance.half_mm(), tolerance.proposed_from.unwrap_or("cam.profile_tolerance"));
    let flipped = evidence.body.machine().cam.rotation == Rotation::CounterClockwise;
    let turned = |v: Vector2<f64>| if flipped { Vector2::new(v.x, -v.y) } else { v };
    let mut worst = (0.0, Vector2::zeros());
    for (index, read) in places.iter().enumerate() {
        let ReadPlace { cam_deg, point, normal, ball, .. } = read;
        let at = |by: f64| {
            let (piece, angle) = curves.motion.locate(cam_deg.to_radians() + by);
            turned(curves.profile(piece, angle).point * MILLIMETRES)
        };
        if (cam_deg - angle_of_place(index, places.len())).abs() > SAME_ANGLE {
            return Err(format!("place {} is not at equal parts of a turn: the list is not complete", index + 1));
        }
        let along = at(STEP) - at(-STEP);
        let upright = along.norm() < EXACT * STEP || (along.normalize().dot(normal)).abs() < UPRIGHT;
        let touches = (ball - point - normal * list.ball_radius).norm() < EXACT * list.ball_radius.max(1.0);
        if !((normal.norm() - 1.0).abs() < NORMAL && upright && touches) {
            return Err(format!("at {} deg normal and ball do not fit the profile", shown(*cam_deg)));
        }
        as_the_drawing_says((read, curves), (zone, from))?;
        // Out of the metal: a step along the normal leaves it, or, in a ring, enters the space of the roller.
        let hollow = cuts.get(list.cut).is_some_and(Cut::is_hollow);
        let (piece, angle) = curves.motion.locate(cam_deg.to_radians());
        let out = turned(curves.profile(piece, angle).outward() * curves.metal_side()).dot(normal);
        let (distance, leaves) = match &tree {
            None => ((point - at(0.0)).norm(), out > 0.0),
            Some(tree) => {
                let nearest = tree.nearest(point + normal * EXACT.sqrt()).ok_or("the outline is empty")?;
                let distance = tree.nearest(*point).map_or(f64::INFINITY, |nearest| nearest.left.abs());
                let left = if hollow { nearest.left } else { -nearest.left };
                (distance, left >= -2.0 * evidence.tolerance_mm)
            }
        };
        if !leaves {
            return Err(format!("at {} deg the normal points into the metal", shown(*cam_deg)));
        }
        if !(distance <= worst.0) {
            worst = (distance, *point);
        }
    }
    Ok((worst.0, worst.1, places.len()))
}

/// Whether zone (mm) and curvature of a place are those that are due, where its form has them.
fn as_the_drawing_says((read, curves): (&ReadPlace, Curves<'_>), (zone, from): (f64, &str)) -> Result<(), String> {
    let at = shown(read.cam_deg);
    if let Some([lower, upper]) = read.zone
        && (lower + zone).abs().max((upper - zone).abs()) > EXACT
    {
        return Err(format!("at {at} deg the zone is not ±{} mm, which is that of {from}", shown(zone)));
    }
    let (piece, angle) = curves.motion.locate(read.cam_deg.to_radians());
    let due = curves.metal_side() * curves.profile(piece, angle).curvature / MILLIMETRES;
    let differs = |radius: f64| (radius.recip() - due).abs() > SAME_BEND * (due.abs() + SAME_BEND);
    if read.curvature_radius.is_some_and(differs) {
        return Err(format!("at {at} deg the radius of curvature is not that of the profile"));
    }
    Ok(())
}

/// The contradiction between the head of an inspection list, with its ball radius, mm, and the cam, if any.
pub(super) fn contradiction(body: &dyn Body, text: &str, ball_radius: f64) -> Option<String> {
    if text.trim_start().starts_with("DMISMN/") {
        let mut found = lines_after(text, "$$");
        let mark = text.lines().next().and_then(|line| line.split('\'').nth(1)).unwrap_or_default();
        found.insert(0, HeadLine { line: 1, text: mark });
        return head::contradiction(&found, &program_statements(body));
    }
    let found = lines_after(text, "#");
    if !text.lines().any(|line| line.starts_with("no,")) {
        // Plain lines of numbers state at most their unit.
        let inches = text.lines().any(|line| line.trim_end() == PLAIN_INCHES);
        return head::contradiction(&found, &[format!("units: {}, degrees", if inches { "inches" } else { "mm" })]);
    }
    let units = if text.contains("x_in,y_in") { LengthUnit::Inch } else { LengthUnit::Millimetre };
    head::contradiction(&found, &statements(body, units, units.of_mm(ball_radius)))
}
