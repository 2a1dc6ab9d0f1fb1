//! A program for grinding in polar coordinates, compared with the exact path of the wheel's centre: what the control makes of its rows, going straight
//! in C and X at once, is bounded between the rows as a table of points is.

use super::check::{Evidence, WrittenProgram};
use super::program::{JudgedProgram, ProgramFault};
use crate::body::points::{PointCurve, traced};
use crate::geometry::MILLIMETRES;
use crate::geometry::points::{Interpolant, PointCoordinates, PointInterpolation, deviations};
use crate::machine::Rotation;
use crate::reading::gcode::PolarPass;
use crate::report::shown;
use nalgebra::Vector2;

/// Depths that differ by less are equal, mm: numbers of three decimals are off by half of it.
const SAME_DEPTH: f64 = 1e-3;

/// The result for the passes of a program.
pub(super) fn judged(
    evidence: &Evidence<'_>,
    written: &WrittenProgram,
    passes: &[PolarPass],
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
        let errors =
            deviations(&path, &curve, &places, (0.0, f64::INFINITY)).map_err(|why| refused(why.to_string()))?;
        for (index, error) in errors.into_iter().enumerate() {
            if !(error <= worst.0) {
                let (from, to) = curve.range(index).unwrap_or((0.0, 0.0));
                let at = curve.at(index, 0.5 * (from + to)).map_or_else(Vector2::zeros, |at| at.point);
                let flipped = evidence.body.machine().cam.rotation == Rotation::CounterClockwise;
                worst = (error, if flipped { Vector2::new(at.x, -at.y) } else { at });
            }
        }
    }
    if !(worst.0 <= half) {
        let why = format!("the wheel's centre is off its path by {} mm", shown(worst.0));
        return Err(ProgramFault { why, value: worst.0, at: Some(worst.1) });
    }
    let deepest = passes.iter().map(|pass| pass.depth).fold(0.0, f64::max);
    if let Some(depth) = written.depth.filter(|depth| (deepest - depth).abs() > SAME_DEPTH) {
        let (deepest, depth) = (shown(deepest), shown(depth));
        return Err(ProgramFault::new(format!("the profile is cut {deepest} mm deep, and must be {depth} mm deep")));
    }
    let (rows, count) = (passes.first().map_or(0, |pass| pass.rows.len()), passes.len());
    let noun = if count == 1 { "pass" } else { "passes" };
    let note = format!(
        "the centre of a wheel Ø{} mm in C and X, {rows} rows in {count} {noun} to {} mm, as the control reads them",
        shown(2.0 * wheel),
        shown(deepest)
    );
    Ok(JudgedProgram { value: worst.0, at: worst.1, note })
}

/// The rows of a pass as angles of the cam, ascending, and distances.
fn as_on_the_cam(evidence: &Evidence<'_>, pass: &PolarPass) -> Vec<[f64; 2]> {
    let sense = if evidence.body.machine().cam.rotation == Rotation::Clockwise { -1.0 } else { 1.0 };
    let mut rows: Vec<[f64; 2]> = pass.rows.iter().map(|[c, x]| [sense * c, *x]).collect();
    if rows.first().zip(rows.last()).is_some_and(|(first, last)| last[0] < first[0]) {
        rows.reverse();
    }
    rows
}
