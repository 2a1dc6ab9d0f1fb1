//! The curve that a control makes of the written table of points, compared with the exact curve.
//!
//! The rows are read back from the bytes of the file and interpolated as its head says; how far that curve lies from the exact one
//! is bounded between the rows, in both directions (`geometry::points`). The motion of the follower on that curve is computed from its
//! own headings and curvatures (`profile::interpolated`).

use super::plan::{PointErrors, PointTable, by_travel, largest_errors, motion_errors, swings, traced};
use crate::body::PointCurve;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{AsCutError, Bound, Finding, Place, Verdict};
use crate::verify::{Evidence, place};
use camgen_kernel::geometry::points::{Interpolant, PointCoordinates, PointInterpolation, PointStep, deviations};
use camgen_kernel::text::{Text, Value, text};
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "points",
    on: CheckScope::ToolFile,
    unit: "mm",
    about: "The largest distance between the exact curve and the curve that the control makes of the table of points as it is in the file, \
            in both directions, bounded between the rows; and the errors of velocity and acceleration on this curve.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max distance between the control's curve through the table and the exact curve",
        usual: "the tolerance",
        change: "a coarser --tolerance, `--points-step chord`, or `--points-between cubic`",
    },
};

/// The solved error may exceed the tolerance by its rounding.
const ROUNDING: f64 = 1e-6;

/// A table of points as a control would read it from the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenPoints {
    /// The table it was made from: which curve it gives, and approximately where its rows lie on it.
    pub table: PointTable,
    /// Radius of the cutter, m, where a cutter is given.
    pub cutter: Option<f64>,
    /// The curve through the rows as read, by the interpolation that the file states; or why there is no such curve.
    pub curve: Result<Interpolant, String>,
}

/// The result for a table.
struct TableDeviation<'w> {
    written: &'w WrittenPoints,
    /// The largest distance, mm, and where.
    worst: f64,
    at: Place,
    /// Errors of velocity and acceleration, or why they are not known.
    motion: Option<[f64; 2]>,
}

/// The finding on tables of a cam.
pub(super) fn judge(evidence: &Evidence<'_>, tables: &[WrittenPoints]) -> Option<Finding> {
    let found: Result<Vec<TableDeviation<'_>>, String> =
        tables.iter().map(|written| found(evidence, written)).collect();
    let found = match found {
        Ok(found) => found,
        Err(why) => return Some(no_table(evidence.tolerance_mm, why)),
    };
    let mut worst = found.first()?;
    for next in &found {
        worst = if next.worst > worst.worst { next } else { worst };
    }
    let limit = worst.written.table.wish.tolerance;
    let too_much: Vec<[bool; 2]> = found.iter().map(TableDeviation::exceeds).collect();
    let refused = too_much.iter().any(|own| own.iter().zip(evidence.strict).any(|(over, strict)| *over && strict));
    let verdict = if worst.worst <= limit && !refused {
        if too_much.iter().any(|own| *own != [false; 2]) { Verdict::Warn } else { Verdict::Pass }
    } else {
        Verdict::Fail
    };
    let mut finding = CHECK.found(worst.worst, Some(limit), verdict);
    let motion = motion_words(evidence, &found);
    finding.note = Some(text!("{}{}", words(&worst.written.table, tables.len()), motion));
    finding.place = worst.at;
    Some(finding)
}

impl TableDeviation<'_> {
    /// Which of velocity and acceleration exceed what was requested. A control that moves straight from row to row keeps no acceleration:
    /// this is reported, but is not a fault of the table.
    fn exceeds(&self) -> [bool; 2] {
        let table = &self.written.table;
        let Some(errors) = self.motion else { return [false; 2] };
        let over = |index: usize| {
            let of = |values: [f64; 2]| values.get(index).copied().unwrap_or(f64::INFINITY);
            of(errors) > of(table.allowed) * (1.0 + ROUNDING)
        };
        [over(0), table.wish.between == PointInterpolation::Cubic && over(1)]
    }
}

/// The largest errors of the follower's motion over all tables, in words.
fn motion_words(evidence: &Evidence<'_>, found: &[TableDeviation<'_>]) -> Text {
    let swings = swings(evidence.body);
    let by_travel = by_travel(evidence.body);
    let (sizes, units) = (AsCutError::sizes(swings, by_travel), AsCutError::units_of(swings, by_travel));
    let largest = |index: usize| {
        let errors = found.iter().filter_map(|found| found.motion?.get(index).copied());
        sizes.get(index).copied().unwrap_or(1.0) * errors.fold(0.0, f64::max)
    };
    if let Some(PointErrors::Unknown(why)) = found.first().map(|found| found.written.table.errors) {
        return text!("; velocity and acceleration are not known: {}", why.to_string());
    }
    let mut words = text!("; the velocity off by {}", Value::with_unit(largest(0), units[0]));
    words += match largest(1) {
        error if error.is_finite() => text!(", the acceleration by {}", Value::with_unit(error, units[1])),
        _ => ", the acceleration is not kept where the control moves in straight lines".into(),
    };
    let over = |index: usize, name: &str| {
        let is_over = found.iter().any(|found| found.exceeds().get(index) == Some(&true));
        let size = sizes.get(index).copied().unwrap_or(1.0);
        let requested =
            found.first().and_then(|found| found.written.table.allowed.get(index).map(|allowed| size * allowed));
        if is_over {
            requested.map(|requested| {
                let unit = units.get(index).copied().unwrap_or_default();
                text!("; {} of {} were requested", Value::before_unit(requested, unit), name)
            })
        } else {
            None
        }
    };
    let over = [over(0, "velocity"), over(1, "acceleration")].into_iter().flatten();
    over.for_each(|next| words += next);
    words
}

/// The finding on a table that there is not, or that is none of the cam.
pub(super) fn no_table(limit: f64, why: String) -> Finding {
    Finding { note: Some(why.into()), ..CHECK.found(f64::INFINITY, Some(limit), Verdict::Fail) }
}

/// The largest distance of a table, and the errors of the follower's motion on it.
fn found<'w>(evidence: &Evidence<'_>, written: &'w WrittenPoints) -> Result<TableDeviation<'w>, String> {
    let (table, curve) = (&written.table, written.curve.as_ref().map_err(Clone::clone)?);
    let cut = *evidence.body.cuts().get(table.cut).ok_or("the cam has no such cut")?;
    let path = traced(evidence.body, &cut, table.curve, written.cutter).map_err(|error| error.to_string())?;
    if curve.count() + 1 != table.rows.places.len() {
        return Err(format!("{} rows are read of {} written", curve.count() + 1, table.rows.places.len()));
    }
    let errors = deviations(&path, curve, &table.rows.places, 0.0, f64::INFINITY).map_err(|error| error.to_string())?;
    let larger = |best: (usize, f64), (index, error): (usize, f64)| if error > best.1 { (index, error) } else { best };
    let (interval, worst) = errors.into_iter().enumerate().fold((0, 0.0), larger);
    let (from, to) = curve.range(interval).unwrap_or((0.0, 0.0));
    let point = curve.point_at(interval, 0.5 * (from + to)).map_or_else(Vector2::zeros, |point| point.point);
    let drawn = if table.flipped { Vector2::new(point.x, -point.y) } else { point };
    let feel = motion_errors(evidence.body, &cut, table.curve, written.cutter).ok();
    let motion = feel.map(|feel| largest_errors(&*feel, curve, table.wish.between));
    Ok(TableDeviation { written, worst, at: place(evidence.body, drawn), motion })
}

fn words(table: &PointTable, files: usize) -> String {
    let curve = match table.curve {
        PointCurve::Profile => "profile",
        PointCurve::Centre => "path of the roller's centre",
        PointCurve::Cutter => "path of the cutter's centre",
    };
    let wish = &table.wish;
    let form = if wish.form == PointCoordinates::Polar { "polar" } else { "x and y" };
    let between = if wish.between == PointInterpolation::Linear { "linear" } else { "cubic" };
    let step = if wish.step == PointStep::Angle { "equal angles" } else { "equal chord error" };
    let of = if files > 1 { format!(", the worst of {files} files") } else { String::new() };
    format!(
        "{curve}, {} rows, {form}, {step}, {between} between them, as read from the file{of}",
        table.rows.rows.len()
    )
}
