//! A barrel that is milled on four axes: A turns it, X and Y move the tool along it and across it, Z sets the depth.
//!
//! A tool as wide as the groove runs in its middle; a smaller one along either flank, which it cuts exactly in the middle of its depth. The rows are as few as keep the
//! tolerance where a control goes straight in A, X and Y at once; between two joints of the motion a stretch is halved until it does.

use super::milling::{MillingError, MillingProgram, TurnedPath, TurnedRound, depths, smoothing};
use super::polar::{LEAST_SHARE, MOST_ROWS, three_axes, without_stock, without_time};
use crate::body::swept::{FlankSide, TurnedCam};
use crate::body::{Body, Milling, Request};
use crate::machine::{Controller, MillingDirection};
use crate::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::blocks::Grid;
use camgen_kernel::refusal::Refusal;

/// Rounding of a diameter that was typed.
const ROUNDING: f64 = 1e-9;
/// Places of a stretch at which it is compared with the exact path, and how often one is halved.
const COMPARED: u32 = 8;
const MOST_HALVED: u32 = 16;

/// The rounds of a tool of a radius, m: one in the middle of the groove, or one along either flank.
///
/// # Errors
/// [`Refusal`] when the tool does not fit into the groove.
pub fn rounds(cam: &dyn TurnedCam, tool: f64) -> Result<&'static [Option<FlankSide>], Refusal> {
    let widest = cam.widest_tool();
    if tool > widest * (1.0 + ROUNDING) {
        let [tool, widest] = [tool, widest].map(|radius| shown(2.0 * MILLIMETRES * radius));
        let what = format!("a cutter of diameter {tool} mm does not fit into a groove of {widest} mm");
        return Err(Refusal::new(what).remedy("give a smaller --cutter-diameter, or leave it out"));
    }
    let fills = tool >= widest * (1.0 - ROUNDING);
    Ok(if fills { &[None] } else { &[Some(FlankSide::Upper), Some(FlankSide::Lower)] })
}

/// The program for a barrel.
///
/// # Errors
/// [`MillingError`] when the control has no feed by the time, the tool does not fit, or its numbers are too coarse.
pub(super) fn program(
    body: &dyn Body,
    request: &Request,
    (cam, asked): (&dyn TurnedCam, Milling),
) -> Result<Vec<MillingProgram>, MillingError> {
    let cutting = body.machine().cutting();
    let controller = asked.controller.unwrap_or(cutting.controller);
    without_stock(&cutting)?;
    let units = body.machine().units();
    let decimals = cutting.decimals.unwrap_or(controller.decimals(units));
    if controller == Controller::Grbl {
        return Err(three_axes("a program for a barrel").remedy("give another --controller").into());
    }
    if controller == Controller::Heidenhain {
        return Err(without_time("a program for a barrel").remedy("give another --controller").into());
    }
    let tool = request.cutter_radius.unwrap_or(cam.widest_tool());
    let (grid, angles) = (Grid::of_lengths(decimals, units), Grid::of_decimals(decimals));
    // Half a step of X and of Y, and half a step of A on the outside.
    let rounding = grid.step() + 0.5 * angles.step() * (MILLIMETRES * cam.outside()).to_radians();
    let asked_for = request.fit.tolerance_mm();
    let smoothing = smoothing(controller, request);
    let tolerance = asked_for - MILLIMETRES * smoothing - rounding;
    if tolerance < LEAST_SHARE * asked_for {
        let (asked, least) =
            (shown(1e3 * asked_for), shown(1e3 * rounding / (1.0 - LEAST_SHARE - controller.smoothing_share())));
        let what = format!("numbers of {decimals} decimals keep no tolerance of {asked} um: they need {least} um");
        let remedy = "give a coarser --tolerance, or cut.decimals that the control takes";
        return Err(Refusal::new(what).remedy(remedy).into());
    }
    let depths = depths(body, &cutting, grid)?;
    let climbs = cutting.direction == MillingDirection::Climb;
    let flanks = rounds(cam, tool)?;
    let of = |flank: &Option<FlankSide>| round(cam, (*flank, tool), (tolerance, grid, angles), climbs);
    let rounds: Vec<TurnedRound> = flanks.iter().map(of).collect();
    let rows = depths.len() * rounds.iter().map(|round| round.rows.len()).sum::<usize>();
    if rows > MOST_ROWS {
        let what = format!("the program would have {rows} rows, more than {MOST_ROWS}");
        return Err(Refusal::new(what).remedy("give a larger cut.depth_per_pass, or a coarser --tolerance").into());
    }
    Ok(vec![MillingProgram {
        part: 0,
        cuts: Vec::new(),
        controller,
        decimals,
        units,
        cutting,
        cutter: Some(tool),
        passes: Vec::new(),
        depths,
        order: Vec::new(),
        blank: None,
        turned: Some(TurnedPath { axis: 'A', rounds }),
        smoothing,
    }])
}

/// Once round along a flank, or in the middle of the groove.
fn round(
    cam: &dyn TurnedCam,
    (flank, tool): (Option<FlankSide>, f64),
    (tolerance, grid, angles): (f64, Grid, Grid),
    climbs: bool,
) -> TurnedRound {
    let path = ToolPath { cam, flank, tool, tolerance };
    let joints = cam.joints();
    let mut rows: Vec<[f64; 3]> = joints.first().map(|at| path.row(*at)).into_iter().collect();
    for pair in joints.windows(2) {
        path.add(path.row(pair[0]), path.row(pair[1]), MOST_HALVED, &mut rows);
    }
    let rows = rows.into_iter().map(|[angle, x, y]| [angles.nearest(angle), grid.nearest(x), grid.nearest(y)]);
    let mut rows: Vec<[f64; 3]> = rows.collect();
    if let [first, .., last] = rows.as_mut_slice() {
        *last = [last[0], first[1], first[2]];
    }
    // Seen from outside, X upwards, a tool that climbs has the metal on its right: it goes against A under the upper flank.
    let rises = rows.first().zip(rows.last()).is_some_and(|(first, last)| last[0] > first[0]);
    let wanted = flank.is_none_or(|flank| (flank == FlankSide::Lower) == climbs);
    if rises != wanted {
        rows.reverse();
    }
    let around = MILLIMETRES * cam.outside();
    let length = |from: &[f64; 3], to: &[f64; 3]| {
        let turned = around * (to[0] - from[0]).to_radians();
        (turned * turned + (to[1] - from[1]) * (to[1] - from[1]) + (to[2] - from[2]) * (to[2] - from[2])).sqrt()
    };
    let lengths = rows.windows(2).map(|pair| length(&pair[0], &pair[1])).collect();
    let start = rows.first().map_or(0.0, |row| row[0]);
    let away = match flank {
        None => rows.first().map_or([0.0; 2], |row| [row[1], row[2]]),
        Some(_) => cam.tool_place(None, tool, start).map(|place| grid.nearest(place)),
    };
    let words = match flank {
        None => "both flanks of the groove",
        Some(FlankSide::Upper) => "upper flank",
        Some(FlankSide::Lower) => "lower flank",
    };
    TurnedRound { words: words.into(), rows, lengths, away }
}

/// The path of a tool.
struct ToolPath<'a> {
    cam: &'a dyn TurnedCam,
    flank: Option<FlankSide>,
    tool: f64,
    /// mm.
    tolerance: f64,
}

impl ToolPath<'_> {
    fn row(&self, a_deg: f64) -> [f64; 3] {
        let [x, y] = self.cam.tool_place(self.flank, self.tool, a_deg);
        [a_deg, x, y]
    }

    /// Adds the rows after the first of a stretch to its end.
    fn add(&self, from: [f64; 3], to: [f64; 3], halvings: u32, rows: &mut Vec<[f64; 3]>) {
        if halvings == 0 || self.is_kept(from, to) {
            rows.push(to);
            return;
        }
        let middle = self.row(0.5 * (from[0] + to[0]));
        self.add(from, middle, halvings - 1, rows);
        self.add(middle, to, halvings - 1, rows);
    }

    /// Whether a straight move keeps the tolerance.
    fn is_kept(&self, from: [f64; 3], to: [f64; 3]) -> bool {
        (1..COMPARED).all(|place| {
            let share = f64::from(place) / f64::from(COMPARED);
            let [a, x, y] = [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
            let [_, exact_x, exact_y] = self.row(a);
            self.cam.across(a, [x - exact_x, y - exact_y]).abs() <= self.tolerance
        })
    }
}
