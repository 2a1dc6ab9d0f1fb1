//! A program that turns the cam under its tool, compared with the exact path of the tool's centre or axis.
//!
//! Of a disc that is ground, what the control makes of its rows, going straight in C and X at once, is bounded between the rows as a table of points is. Of a
//! barrel the tool is compared at places between the rows, across the groove on its floor and on its outside; moves to a pass and away from it must stay between the
//! flanks.

use super::super::plan::four_axes::rounds;
use super::super::read::{CutterProgram, StandingMove, TurnedPass};
use super::cutting::{SAME_DEPTH, not_too_deep_at_once};
use super::program::{JudgedProgram, ProgramFault, WrittenProgram, remarks};
use crate::body::swept::{FlankSide, TurnedCam};
use crate::body::{Body, PointCurve};
use crate::machine::Rotation;
use crate::report::shown;
use crate::tool_files::points::traced;
use crate::verify::Evidence;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::points::{Interpolant, PointCoordinates, PointInterpolation, deviations};
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;

/// Places between two rows of a barrel at which the tool is compared, at least, and the angle between two of them at most, degrees.
const COMPARED: f64 = 8.0;
const APART: f64 = 0.5;

/// The result for a program.
pub(super) fn judged(
    evidence: &Evidence<'_>,
    written: &WrittenProgram,
    program: &CutterProgram,
) -> Result<JudgedProgram, ProgramFault> {
    let axis = program.turned.first().map_or('C', |pass| pass.axis);
    match (evidence.body.swept().and_then(|swept| swept.turned().ok()), axis) {
        (Some(cam), 'A') => Barrel { cam, evidence, written }.judged(program),
        (Some(_), _) => Err(ProgramFault::new("a program for a barrel turns it about A")),
        (None, 'A') => Err(ProgramFault::new("the program turns the cam about A, which only a barrel is milled so")),
        (None, _) => ground(evidence, written, &program.turned, &program.standing),
    }
}

/// What is common to the verdict on every turned program: its depth, and the note.
fn concluded(
    worst: (f64, Vector2<f64>),
    (passes, tool): (&[TurnedPass], &Text),
    (body, written): (&dyn Body, &WrittenProgram),
) -> Result<JudgedProgram, ProgramFault> {
    let deepest = passes.iter().map(|pass| pass.depth).fold(0.0, f64::max);
    if let Some(depth) = written.depth.filter(|depth| (deepest - depth).abs() > SAME_DEPTH) {
        let (deepest, depth) = (shown(deepest), shown(depth));
        return Err(ProgramFault::new(format!("the cam is cut {deepest} mm deep, and must be cut {depth} mm deep")));
    }
    let (rows, count) = (passes.iter().map(|pass| pass.rows.len()).sum::<usize>(), passes.len());
    let noun = if count == 1 { "pass" } else { "passes" };
    let unknown = remarks(body, written);
    let note = text!(
        "{}, {} rows in {} {} to {}, as the control reads them{}",
        tool,
        rows,
        count,
        noun,
        Length::mm(deepest),
        unknown
    );
    Ok(JudgedProgram { value: worst.0, at: worst.1, note })
}

/// A barrel that is milled.
struct Barrel<'a> {
    cam: &'a dyn TurnedCam,
    evidence: &'a Evidence<'a>,
    written: &'a WrittenProgram,
}

impl Barrel<'_> {
    fn judged(&self, program: &CutterProgram) -> Result<JudgedProgram, ProgramFault> {
        let tool = self.written.cutter.ok_or_else(|| ProgramFault::new("the radius of the tool is not known"))?;
        let flanks = rounds(self.cam, tool / MILLIMETRES).map_err(|why| ProgramFault::new(why.to_string()))?;
        let limit = self.evidence.tolerance_mm;
        let mut worst = (0.0, 0.0);
        let mut deepest = vec![0.0_f64; flanks.len()];
        for pass in &program.turned {
            let off = |flank: &Option<FlankSide>| self.off(pass, *flank, tool / MILLIMETRES);
            let found = flanks.iter().map(off).enumerate().min_by(|a, b| a.1.0.total_cmp(&b.1.0));
            let Some((flank, (value, at))) = found else { continue };
            if !(value <= limit) {
                let why =
                    format!("the tool on the pass from line {} on is off its path by {} mm", pass.line, shown(value));
                return Err(ProgramFault { why, value, at: Some(self.place(at)) });
            }
            if value > worst.0 {
                worst = (value, at);
            }
            if let Some(deep) = deepest.get_mut(flank) {
                not_too_deep_at_once(self.evidence, pass.line, (*deep, pass.depth))?;
                *deep = deep.max(pass.depth);
            }
        }
        let shallow = deepest.iter().copied().fold(f64::INFINITY, f64::min);
        if self.written.depth.is_some_and(|depth| shallow < depth - SAME_DEPTH) {
            let why = format!("a flank is cut {} mm deep only", shown(shallow));
            return Err(ProgramFault::new(why));
        }
        program.standing.iter().try_for_each(|moved| self.stays_between(moved, tool / MILLIMETRES))?;
        let words = text!("the axis of a tool Ø{} under A, X and Y", Length::mm(2.0 * tool));
        concluded((worst.0, self.place(worst.1)), (&program.turned, &words), (self.evidence.body, self.written))
    }

    /// By how much the tool is off its path along a flank at most, mm, and at which angle of A, degrees.
    fn off(&self, pass: &TurnedPass, flank: Option<FlankSide>, tool: f64) -> (f64, f64) {
        let mut worst = (0.0, 0.0);
        for pair in pass.rows.windows(2) {
            let &[from, to] = pair else { continue };
            let count = COMPARED.max(((to[0] - from[0]).abs() / APART).ceil());
            let mut share = 0.0;
            while share <= 1.0 {
                let [a, x, y] = [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
                let exact = self.cam.tool_place(flank, tool, a);
                let off = self.cam.across(a, [x - exact[0], y - exact[1]]).abs();
                if !(off <= worst.0) {
                    worst = (off, a);
                }
                share += 1.0 / count;
            }
        }
        worst
    }

    /// Whether a tool that moves while the cam stands still stays between the flanks: beside the path its axis is no longer that of the roller, so that it must
    /// stay as near to the middle in every direction.
    fn stays_between(&self, moved: &StandingMove, tool: f64) -> Result<(), ProgramFault> {
        let room = MILLIMETRES * (self.cam.widest_tool() - tool);
        let middle = self.cam.tool_place(None, tool, moved.angle);
        for [x, y] in moved.ends {
            let off = libm::hypot(x - middle[0], y - middle[1]) - room;
            if !(off <= self.evidence.tolerance_mm) {
                let why = format!("the tool cuts {} mm into a flank in line {}", shown(off), moved.line);
                return Err(ProgramFault { why, value: off, at: Some(self.place(moved.angle)) });
            }
        }
        Ok(())
    }

    /// The place of the drawing at an angle of A, in the plane of the developed view.
    fn place(&self, a_deg: f64) -> Vector2<f64> {
        Vector2::new(MILLIMETRES * self.cam.outside() * a_deg.to_radians(), 0.0)
    }
}

/// The result for the passes that grind a disc.
fn ground(
    evidence: &Evidence<'_>,
    written: &WrittenProgram,
    passes: &[TurnedPass],
    standing: &[StandingMove],
) -> Result<JudgedProgram, ProgramFault> {
    let cuts = evidence.body.cuts();
    let [cut] = cuts.as_slice() else {
        return Err(ProgramFault::new("a program in polar coordinates grinds the outside of a disc"));
    };
    let wheel = written.cutter.ok_or_else(|| ProgramFault::new("the radius of the wheel is not known"))?;
    let radius = (wheel - written.middle) / MILLIMETRES;
    let path = traced(evidence.body, cut, PointCurve::Cutter, Some(radius))
        .map_err(|why| ProgramFault::new(why.to_string()))?;
    let mut worst = (0.0, Vector2::zeros());
    let half = if written.middle == 0.0 { evidence.tolerance_mm } else { 0.5 * evidence.tolerance_mm };
    for pass in passes {
        let rows = as_on_the_cam(evidence, pass);
        let curve = Interpolant::new(&rows, PointCoordinates::Polar, PointInterpolation::Linear, true);
        let refused = |why: String| ProgramFault::new(format!("the pass from line {} on: {why}", pass.line));
        let places = path.places_of(&curve).map_err(|why| refused(why.to_string()))?;
        let errors = deviations(&path, &curve, &places, 0.0, f64::INFINITY).map_err(|why| refused(why.to_string()))?;
        for (index, error) in errors.into_iter().enumerate() {
            if !(error <= worst.0) {
                let (from, to) = curve.range(index).unwrap_or((0.0, 0.0));
                let at = curve.point_at(index, 0.5 * (from + to)).map_or_else(Vector2::zeros, |at| at.point);
                let flipped = evidence.body.machine().cam.rotation == Rotation::CounterClockwise;
                worst = (error, if flipped { Vector2::new(at.x, -at.y) } else { at });
            }
        }
    }
    if !(worst.0 <= half) {
        let why = format!("the wheel's centre is off its path by {} mm", shown(worst.0));
        return Err(ProgramFault { why, value: worst.0, at: Some(worst.1) });
    }
    for moved in standing {
        let nearest = passes.first().map_or(f64::INFINITY, |pass| distance_at(pass, moved.angle));
        let deep = nearest - moved.ends.iter().map(|end| end[0]).fold(f64::INFINITY, f64::min);
        if !(deep <= evidence.tolerance_mm) {
            let why = format!("the wheel cuts {} mm into the cam in line {}", shown(deep), moved.line);
            return Err(ProgramFault { why, value: deep, at: None });
        }
    }
    let mut deepest = 0.0_f64;
    for pass in passes {
        not_too_deep_at_once(evidence, pass.line, (deepest, pass.depth))?;
        deepest = deepest.max(pass.depth);
    }
    let words = text!("the centre of a wheel Ø{} in C and X", Length::mm(2.0 * wheel));
    concluded(worst, (passes, &words), (evidence.body, written))
}

/// X of the wheel on a pass at an angle of C, degrees, mm.
fn distance_at(pass: &TurnedPass, angle: f64) -> f64 {
    let between = |pair: &&[[f64; 3]]| {
        let (low, high) = (pair[0][0].min(pair[1][0]), pair[0][0].max(pair[1][0]));
        (low..=high).contains(&angle)
    };
    let found = pass.rows.windows(2).find(between);
    found.map_or(f64::INFINITY, |pair| {
        let share = if pair[1][0] == pair[0][0] { 0.0 } else { (angle - pair[0][0]) / (pair[1][0] - pair[0][0]) };
        pair[0][1] + (pair[1][1] - pair[0][1]) * share
    })
}

/// The rows of a pass as angles of the cam, ascending, and distances.
fn as_on_the_cam(evidence: &Evidence<'_>, pass: &TurnedPass) -> Vec<[f64; 2]> {
    let sense = if evidence.body.machine().cam.rotation == Rotation::Clockwise { -1.0 } else { 1.0 };
    let mut rows: Vec<[f64; 2]> = pass.rows.iter().map(|[c, x, _]| [sense * c, *x]).collect();
    if rows.first().zip(rows.last()).is_some_and(|(first, last)| last[0] < first[0]) {
        rows.reverse();
    }
    rows
}
