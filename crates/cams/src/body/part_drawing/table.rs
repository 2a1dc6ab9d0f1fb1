//! The table of the profiles of a plane part, with the points at which it is inspected.

use crate::body::part::point_as_turned;
use crate::body::part_tolerance::PartTolerance;
use crate::body::sheet::{length_cell, rays_of, tables_of, touched};
use crate::body::{Body, Layer, Part};
use crate::machine::Machine;
use crate::report::sheet::{Dimensions, Mark, PlaceRow, PlaceTable};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::{MILLIMETRES, polar};
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::Curves;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Points of a turn at which the motion is looked at for the points of inspection.
const PLACES: u32 = 720;
/// A lift within this share of the largest is at its end.
const LEVEL: f64 = 1e-6;

/// The table of a part's profiles, with the places of inspection.
pub(super) struct ProfileTable {
    heads: Vec<String>,
    remarks: Vec<String>,
    rows: Vec<PlaceRow>,
    /// Names of the places of inspection, where they lie on the first profile, and the directions out of the metal.
    inspected: Vec<(String, Vector2<f64>, Vector2<f64>)>,
}

impl ProfileTable {
    pub(super) fn new(body: &dyn Body, part: &Part, curves: Curves<'_>) -> Self {
        let machine = body.machine();
        let units = machine.units();
        let unit = units.symbol();
        let flanks: Vec<(Layer, &Contour)> =
            part.outlines().map(|(layer, outline)| (layer, &outline.contour)).collect();
        let (degrees, rays) = rays_of();
        let (on_rows, changes): (Vec<MotionChange>, Vec<MotionChange>) =
            changes(machine, curves).into_iter().partition(MotionChange::is_on_row);
        let all: Vec<Vector2<f64>> = rays.iter().copied().chain(changes.iter().map(|change| change.ray)).collect();
        let radii: Vec<Vec<Option<f64>>> = flanks.iter().map(|(_, contour)| polar::outermost(contour, &all)).collect();
        let first = radii.first().cloned().unwrap_or_default();
        let touches = touched(machine, curves, &rays, first.get(..rays.len()).unwrap_or_default());
        let with_lift = flanks.len() == 1;
        let swings = curves.motion.quantity() == Quantity::Angle;
        let lift = |at: Option<f64>| {
            let lift = at.map(|at| {
                let (piece, angle) = curves.motion.locate(at);
                curves.motion.jet(piece, angle).s
            });
            match lift {
                Some(lift) if swings => format!("{:.3}", lift.to_degrees() + 0.0),
                lift => length_cell(lift.map(|lift| MILLIMETRES * lift), units),
            }
        };
        let row = |index: usize, psi: String, at: Option<f64>| {
            let of_flanks = radii.iter().map(|radii| length_cell(radii.get(index).copied().flatten(), units));
            let theta = at.map_or_else(|| "–".into(), |at| format!("{:.1}", tenths(at.to_degrees())));
            let cells = std::iter::once(psi).chain(of_flanks).chain([theta]).chain(with_lift.then(|| lift(at)));
            cells.collect::<Vec<String>>()
        };
        let mut rows: Vec<(f64, PlaceRow)> = degrees
            .iter()
            .enumerate()
            .map(|(index, psi)| {
                let at = touches.get(index).copied().flatten();
                (*psi, PlaceRow::regular(index, row(index, format!("{psi:.0}"), at)))
            })
            .collect();
        for change in &on_rows {
            if let Some(index) = nearest_free(&rows, change.psi, degrees.len())
                && let Some((_, row)) = rows.get_mut(index)
            {
                row.is_change = true;
            }
        }
        let mut inspected = Vec::new();
        for (number, place) in inspection_places(machine, curves).into_iter().enumerate() {
            let Some(index) = nearest_free(&rows, place, degrees.len()) else { continue };
            let name = format!("P{}", number + 1);
            if let (Some((_, row)), Some(ray)) = (rows.get_mut(index), rays.get(index)) {
                row.flag = Some(name.clone());
                let radius = first.get(index).copied().flatten().unwrap_or(0.0);
                let is_inner =
                    flanks.first().is_some_and(|(layer, _)| matches!(layer, Layer::GrooveInner | Layer::RibInner));
                inspected.push((name, ray * radius, if is_inner { -ray } else { *ray }));
            }
        }
        for (index, change) in changes.iter().enumerate() {
            // Of an undercut profile the place may lie off the outline that is left.
            let radius = first.get(rays.len() + index).copied().flatten();
            if radius.is_none_or(|radius| (radius - change.radius).abs() > OFF_OUTLINE) {
                continue;
            }
            let cells = row(rays.len() + index, format!("{:.2}", change.psi), Some(change.at));
            rows.push((change.psi, PlaceRow { cells, number: None, flag: None, is_change: true }));
        }
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let of_flank = |(layer, _): &(Layer, &Contour)| match (flanks.len(), layer.word()) {
            (1, _) => format!("R {unit}"),
            (_, word) => format!("R {word}"),
        };
        let heads = std::iter::once("ψ °".to_owned()).chain(flanks.iter().map(of_flank)).chain(["θ °".to_owned()]);
        let heads =
            heads.chain(with_lift.then(|| if swings { "s °".to_owned() } else { format!("s {unit}") })).collect();
        let lift = if with_lift { ", s lift" } else { "" };
        let half = units.zone(PartTolerance::of(body).half_mm());
        let remarks = vec![
            format!("θ cam angle of contact{lift}. Grey: change of segment."),
            format!("P1 to P5: inspect there, R within ±{half} {unit}."),
        ];
        Self { heads, remarks, rows: rows.into_iter().map(|(_, row)| row).collect(), inspected }
    }

    pub(super) fn tables(&self) -> Vec<PlaceTable> {
        tables_of("Profile R at polar angle ψ (TED)", &self.heads, &self.remarks, self.rows.clone())
    }

    pub(super) fn flags(&self) -> Vec<Mark> {
        let flag = |(name, at, outward): &(String, Vector2<f64>, Vector2<f64>)| Mark::Flag {
            at: *at,
            outward: *outward,
            name: name.clone(),
        };
        self.inspected.iter().map(flag).collect()
    }
}

/// An angle, degrees, that is written with one decimal: 359.96 is 0.
fn tenths(degrees: f64) -> f64 {
    ((10.0 * degrees).round() / 10.0).rem_euclid(360.0)
}

/// The row at an equal distance that is nearest to a polar angle, degrees, and has no flag.
fn nearest_free(rows: &[(f64, PlaceRow)], psi: f64, count: usize) -> Option<usize> {
    let apart = |other: f64| ((psi - other + 180.0).rem_euclid(360.0) - 180.0).abs();
    let free = rows.iter().take(count).enumerate().filter(|(_, (_, row))| row.flag.is_none());
    free.min_by(|(_, a), (_, b)| apart(a.0).total_cmp(&apart(b.0))).map(|(index, _)| index)
}

/// A change of segment: the cam angle, rad, and the polar angle of the place that is touched there, degrees.
struct MotionChange {
    at: f64,
    psi: f64,
    /// Its distance from the shaft, mm.
    radius: f64,
    ray: Vector2<f64>,
}

impl MotionChange {
    /// Whether it lies on one of the rows at equal distances.
    fn is_on_row(&self) -> bool {
        (self.psi / 5.0 - (self.psi / 5.0).round()).abs() <= 2e-3
    }
}

/// A place of the profile farther from the outline than this, mm, is not on it.
const OFF_OUTLINE: f64 = 0.1;
/// Most changes of segment that a table shows.
const MOST_CHANGES: usize = 12;

/// The changes of segment of a motion; none of one with more than a table has room for.
fn changes(machine: &Machine, curves: Curves<'_>) -> Vec<MotionChange> {
    let stretches = curves.motion.named_stretches();
    if stretches.len() < 2 || stretches.len() > MOST_CHANGES {
        return Vec::new();
    }
    let change = |at: f64| {
        let (psi, ray) = polar_place(machine, curves, at)?;
        let (piece, angle) = curves.motion.locate(at);
        let radius = MILLIMETRES * curves.profile(piece, angle).point.norm();
        Some(MotionChange { at, psi, radius, ray })
    };
    stretches.iter().filter_map(|stretch| change(stretch.from)).collect()
}

/// The polar angle of the place of the profile that is touched at a cam angle, degrees, and its direction.
fn polar_place(machine: &Machine, curves: Curves<'_>, at: f64) -> Option<(f64, Vector2<f64>)> {
    let (piece, angle) = curves.motion.locate(at);
    let ray = point_as_turned(machine, curves.profile(piece, angle).point).try_normalize(0.0)?;
    Some((libm::atan2(ray.y, ray.x).to_degrees().rem_euclid(360.0), ray))
}

/// The polar angles, degrees, at which a part is inspected, in their order about the axis: where the rise and the return are fastest, on the upper dwell and
/// at its end, and on the lower dwell.
fn inspection_places(machine: &Machine, curves: Curves<'_>) -> Vec<f64> {
    let angles: Vec<f64> = (0..PLACES).map(|index| TAU * f64::from(index) / f64::from(PLACES)).collect();
    let contacts = angles.iter().map(|at| {
        let (piece, angle) = curves.motion.locate(*at);
        curves.contact(piece, angle)
    });
    let contacts: Vec<(f64, f64)> = contacts.map(|found| (found.lift.s, found.lift.ds)).collect();
    let greatest = |value: fn(&(f64, f64)) -> f64| {
        let found = contacts.iter().enumerate().max_by(|a, b| value(a.1).total_cmp(&value(b.1)));
        found.map_or(0, |(index, _)| index)
    };
    let (lowest, highest) = contacts
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (lift, _)| (low.min(*lift), high.max(*lift)));
    let near = LEVEL * (highest - lowest);
    let is_high = |index: usize| contacts.get(index).is_some_and(|(lift, _)| *lift >= highest - near);
    let is_low = |index: usize| contacts.get(index).is_some_and(|(lift, _)| *lift <= lowest + near);
    let [upper_start, upper_end] = run_around(greatest(|found| found.0), contacts.len(), is_high);
    let [lower_start, lower_end] = run_around(greatest(|found| -found.0), contacts.len(), is_low);
    let middle = |[from, to]: [usize; 2]| from + (to - from) / 2;
    let places = [
        greatest(|found| found.1),
        middle([upper_start, upper_end]),
        upper_end,
        greatest(|found| -found.1),
        middle([lower_start, lower_end]),
    ];
    let psi = |index: usize| {
        let at = angles.get(index % angles.len()).copied()?;
        Some(polar_place(machine, curves, at)?.0)
    };
    let mut found: Vec<f64> = places.into_iter().filter_map(psi).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// The first and the last index of the run of places, all alike, that a place lies in; the last may be beyond the turn.
fn run_around(at: usize, count: usize, is_alike: impl Fn(usize) -> bool) -> [usize; 2] {
    let back = (1..count).take_while(|step| is_alike((at + count - step) % count)).count();
    let forth = (1..count).take_while(|step| is_alike((at + step) % count)).count();
    let first = (at + count - back) % count;
    [first, first + (back + forth).min(count - 1)]
}
