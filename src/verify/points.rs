//! What a control makes of the written table of points, against the exact curve.
//!
//! The rows are read back from the bytes of the file and interpolated as its head says; how far that curve lies from the exact one
//! is bounded between the rows, both ways (`geometry::points`).

use super::{Bound, Check, Evidence, Explained, On, place};
use crate::body::points::{Given, PointTable, traced};
use crate::geometry::points::{Between, Form, Interpolant, Step, deviations};
use crate::report::{Finding, Place, Verdict};
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "points",
    on: On::Cam,
    about: "The largest distance between the exact curve and what the control makes of the table of points as it is in the file, \
            either way, bounded between the rows.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max distance between the control's curve through the table and the exact curve",
        usual: "the tolerance",
        change: "a coarser --tolerance, `--points-step chord`, or `--points-between cubic`",
    },
    run: check,
};

/// A table of points as a control would find it in the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenPoints {
    /// The table it was made from: which curve it gives, and about where its rows lie on it.
    pub table: PointTable,
    /// Radius of the cutter, m, where there is one.
    pub cutter: Option<f64>,
    /// The curve through the rows as read, by the interpolation that the file tells; or why there is none.
    pub curve: Result<Interpolant, String>,
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let tables = match evidence.points? {
        Ok(tables) => tables,
        Err(why) => return Some(none(evidence.tolerance_mm, why.clone())),
    };
    let mut found: Option<(f64, &WrittenPoints, Place)> = None;
    for written in tables {
        let (worst, at) = match worst_of(evidence, written) {
            Ok(worst) => worst,
            Err(why) => return Some(none(evidence.tolerance_mm, why)),
        };
        if found.as_ref().is_none_or(|(most, ..)| worst > *most) {
            found = Some((worst, written, at));
        }
    }
    let (worst, written, at) = found?;
    let limit = written.table.wish.tolerance;
    let mut finding = CHECK.found(worst, Some(limit), "mm", Verdict::of(worst <= limit));
    (finding.place, finding.note) = (at, Some(words(&written.table, tables.len())));
    Some(finding)
}

fn none(limit: f64, why: String) -> Finding {
    Finding { note: Some(why), ..CHECK.found(f64::INFINITY, Some(limit), "mm", Verdict::Fail) }
}

/// The largest distance of a table, mm, and where.
fn worst_of(evidence: &Evidence<'_>, written: &WrittenPoints) -> Result<(f64, Place), String> {
    let (table, curve) = (&written.table, written.curve.as_ref().map_err(Clone::clone)?);
    let path = traced(evidence.body, table.z, table.given, written.cutter).map_err(|error| error.to_string())?;
    if curve.count() + 1 != table.rows.places.len() {
        return Err(format!("{} rows are read of {} written", curve.count() + 1, table.rows.places.len()));
    }
    let errors =
        deviations(&path, curve, &table.rows.places, (0.0, f64::INFINITY)).map_err(|error| error.to_string())?;
    let larger = |best: (usize, f64), (index, error): (usize, f64)| if error > best.1 { (index, error) } else { best };
    let (interval, worst) = errors.into_iter().enumerate().fold((0, 0.0), larger);
    let (from, to) = curve.range(interval).unwrap_or((0.0, 0.0));
    let point = curve.at(interval, 0.5 * (from + to)).map_or_else(Vector2::zeros, |point| point.point);
    let drawn = if table.flipped { Vector2::new(point.x, -point.y) } else { point };
    Ok((worst, place(evidence.body, drawn)))
}

fn words(table: &PointTable, files: usize) -> String {
    let curve = match table.given {
        Given::Profile => "profile",
        Given::Centre => "path of the roller's centre",
        Given::Cutter => "path of the cutter's centre",
    };
    let wish = &table.wish;
    let form = if wish.form == Form::Polar { "polar" } else { "x and y" };
    let between = if wish.between == Between::Linear { "linear" } else { "cubic" };
    let step = if wish.step == Step::Angle { "equal angles" } else { "equal chord error" };
    let of = if files > 1 { format!(", the worst of {files} files") } else { String::new() };
    format!(
        "{curve}, {} rows, {form}, {step}, {between} between them, as read from the file{of}",
        table.rows.rows.len()
    )
}
