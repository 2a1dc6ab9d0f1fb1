//! A disc that is ground in polar coordinates: the axis C turns it, the wheel's centre moves along X, and a control goes straight in both from row
//! to row.
//!
//! The rows are the fewest with which the interpolated path keeps what the rounding of its numbers leaves of the tolerance, as a table of points
//! for a control has them (`points`).

use super::milling::{MillingError, MillingProgram, TurnedPath, TurnedRound, depths, smoothing};
use crate::body::{Body, Cut, Milling, PointCurve, Request};
use crate::machine::{Controller, CuttingData, MillingDirection, Rotation};
use crate::report::shown;
use crate::tool_files::points::{TableError, traced};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::blocks::Grid;
use camgen_kernel::geometry::points::{PointCoordinates, PointInterpolation, PointStep, PointTableSpec, place};
use camgen_kernel::refusal::Refusal;

/// Least share of the tolerance that rounding must leave to the rows.
pub(super) const LEAST_SHARE: f64 = 0.2;
/// How far the wheel stands off the cam before and behind a pass, mm.
const AWAY: f64 = 5.0;
/// Most rows of a program.
pub(super) const MOST_ROWS: usize = 200_000;

/// The program for a disc; C is counted from its angle 0 on.
///
/// # Errors
/// [`MillingError`] when the control has no feed by the time, no wheel is given, the cam has no such path, or its numbers are too coarse.
pub(super) fn program(body: &dyn Body, request: &Request, asked: Milling) -> Result<Vec<MillingProgram>, MillingError> {
    let cutting = body.machine().cutting();
    let controller = asked.controller.unwrap_or(cutting.controller);
    without_stock(&cutting)?;
    let units = body.machine().units();
    let decimals = cutting.decimals.unwrap_or(controller.decimals(units));
    if controller == Controller::Grbl {
        let remedy = "give another --controller, or cut.form = \"milling\"";
        return Err(three_axes("cut.form \"polar\"").remedy(remedy).into());
    }
    if controller == Controller::Heidenhain {
        return Err(without_time("cut.form \"polar\"")
            .remedy("give another --controller, or cut.form = \"milling\"")
            .into());
    }
    let disc = &disc_of(body)?;
    let wheel = request.cutter_radius.ok_or_else(|| {
        let refusal = Refusal::new("cut.form \"polar\" moves the centre of a wheel whose size is not given");
        refusal.remedy("give --cutter-diameter")
    })?;
    let grid = Grid::of_lengths(decimals, units);
    let smoothing = smoothing(controller, request);
    let mut rows = rows((body, disc), request, (wheel, grid, decimals, smoothing))?;
    let climbs = cutting.direction == MillingDirection::Climb;
    if climbs == (sense(body) < 0.0) {
        rows.reverse();
    }
    let away = rows.iter().map(|row| row[1]).fold(0.0, f64::max) + AWAY;
    let depths = depths(body, &cutting, grid)?;
    if depths.len() * rows.len() > MOST_ROWS {
        let what = format!("the program would have {} rows, more than {MOST_ROWS}", depths.len() * rows.len());
        return Err(Refusal::new(what).remedy("give a larger cut.depth_per_pass, or a coarser --tolerance").into());
    }
    let lengths = rows.windows(2).map(|pair| length(pair[0], pair[1])).collect();
    let rows = rows.into_iter().map(|[angle, x]| [angle, x, 0.0]).collect();
    let round = TurnedRound { words: "profile".into(), rows, lengths, away: [grid.nearest(away), 0.0] };
    let turned = Some(TurnedPath { axis: 'C', rounds: vec![round] });
    let cutter = Some(wheel);
    Ok(vec![MillingProgram {
        part: 0,
        cuts: vec![0],
        controller,
        decimals,
        units,
        cutting,
        cutter,
        passes: Vec::new(),
        depths,
        order: Vec::new(),
        blank: None,
        smoothing,
        turned,
    }])
}

/// The length of the path between two rows on the disc, mm: on a spiral, with its mean radius.
fn length([from, near]: [f64; 2], [to, far]: [f64; 2]) -> f64 {
    libm::hypot(0.5 * (near + far) * (to - from).to_radians(), far - near)
}

/// The sense of C by the cam angle. About +Z the disc turns to bring a place of the drawing to the wheel at +X: C is its angle, reversed; the angles
/// of a cam that turns the other way are those of the mirrored drawing.
fn sense(body: &dyn Body) -> f64 {
    if body.machine().cam.rotation == Rotation::Clockwise { -1.0 } else { 1.0 }
}

/// The one profile of a disc.
fn disc_of(body: &dyn Body) -> Result<Cut<'_>, Refusal> {
    let mut cuts = body.cuts();
    let turns = |cut: &Cut<'_>| !cut.is_hollow() && cut.curves.is_some_and(|curves| curves.motion.period().is_some());
    cuts.pop().filter(|cut| cuts.is_empty() && turns(cut)).ok_or_else(|| {
        let what = format!("cut.form \"polar\" grinds the outside of a disc, and this is a {}", body.kind().noun);
        Refusal::new(what).remedy("give cut.form = \"milling\"")
    })
}

/// C and X by ascending cam angle, on the grid of the control, for a wheel of a radius, m.
fn rows(
    (body, disc): (&dyn Body, &Cut<'_>),
    request: &Request,
    (wheel, grid, decimals, smoothing): (f64, Grid, u32, f64),
) -> Result<Vec<[f64; 2]>, MillingError> {
    let (middle, band) = request.fit.band();
    let half = band - smoothing;
    let path = traced(body, disc, PointCurve::Cutter, Some(wheel - middle)).map_err(|error| match error {
        TableError::Cutter(error) => MillingError::Cutter(error),
        TableError::Refused(why) => MillingError::Refused(why),
    })?;
    let (form, step, between) = (PointCoordinates::Polar, PointStep::Chord, PointInterpolation::Linear);
    let within =
        |tolerance: f64| place(&path, &PointTableSpec { form, step, between, tolerance }, None).map_err(Refusal::from);
    // Half a step of X, and half a step of C at the largest distance.
    let farthest = within(MILLIMETRES * half)?.rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let angles = Grid::of_decimals(decimals);
    let rounding = 0.5 * (grid.step() + angles.step() * farthest.to_radians());
    let tolerance = MILLIMETRES * half - rounding;
    if tolerance < LEAST_SHARE * MILLIMETRES * half {
        let asked = shown(1e6 * request.fit.tolerance);
        let what = format!("numbers of {decimals} decimals keep no tolerance of {asked} um");
        let remedy = "give a coarser --tolerance, or cut.decimals that the control takes";
        return Err(Refusal::new(what).remedy(remedy).into());
    }
    let sense = sense(body);
    let on_grid = |[angle, radius]: &[f64; 2]| [angles.nearest(sense * angle), grid.nearest(*radius)];
    let mut rows: Vec<[f64; 2]> = within(tolerance)?.rows.iter().map(on_grid).collect();
    // A full turn, whatever the rounding of its ends.
    if let [first, .., last] = rows.as_mut_slice() {
        *last = [first[0] + sense * 360.0, first[1]];
    }
    Ok(rows)
}

/// The refusal of a control that does not know how long a block takes.
pub(super) fn without_time(what: &str) -> Refusal {
    Refusal::new(format!("{what} needs a feed by the time (G93), which the dialogue of HEIDENHAIN does not have"))
}

/// The refusal of a control that has no rotary axis.
pub(super) fn three_axes(what: &str) -> Refusal {
    Refusal::new(format!("{what} needs a rotary axis, and grbl has X, Y and Z alone"))
}

/// Refuses stock and spring passes where a cam is turned under its tool: its passes are all at size.
pub(super) fn without_stock(cutting: &CuttingData) -> Result<(), Refusal> {
    let asked = [(cutting.allowance > 0.0, "allowance"), (cutting.finish_passes > 1, "finish_passes")];
    match asked.iter().find(|(is_asked, _)| *is_asked) {
        None => Ok(()),
        Some((_, key)) => {
            let what = format!(
                "cut.{key} is for outlines that are milled in X and Y: a cam that is turned under its tool is cut at size"
            );
            Err(Refusal::new(what).remedy(format!("leave cut.{key} out")))
        }
    }
}
