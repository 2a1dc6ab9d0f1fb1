//! What a control makes of the written table of points, against the exact curve.
//!
//! The rows are read back from the bytes of the file and interpolated as its head says; how far that curve lies from the exact one
//! is bounded between the rows, both ways (`geometry::points`). What the follower feels of that curve is told by the curve's own
//! headings and curvatures (`profile::interpolated`).

use super::{Check, Evidence, On, place};
use crate::body::points::{Given, Judged, PointTable, feeling, felt_on, swings, traced};
use crate::geometry::MILLIMETRES;
use crate::geometry::points::{Between, Form, Interpolant, Step, deviations};
use crate::report::{Finding, Place, Verdict, shown};
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "points",
    on: On::Cam,
    about: "The largest distance between the exact curve and what the control makes of the table of points as it is in the file, \
            either way, bounded between the rows; and the errors of velocity and acceleration that this curve leaves.",
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

/// A tolerance may be exceeded by the rounding of the solved error.
const ROUNDING: f64 = 1e-6;

/// What was found of a table.
struct Found<'w> {
    written: &'w WrittenPoints,
    /// The largest distance, mm, and where.
    worst: f64,
    at: Place,
    /// Errors of velocity and acceleration, where they can be told.
    felt: Option<[f64; 2]>,
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let tables = match evidence.points? {
        Ok(tables) => tables,
        Err(why) => return Some(none(evidence.tolerance_mm, why.clone())),
    };
    let found: Result<Vec<Found<'_>>, String> = tables.iter().map(|written| found(evidence, written)).collect();
    let found = match found {
        Ok(found) => found,
        Err(why) => return Some(none(evidence.tolerance_mm, why)),
    };
    let mut worst = found.first()?;
    for next in &found {
        worst = if next.worst > worst.worst { next } else { worst };
    }
    let limit = worst.written.table.wish.tolerance;
    let too_much: Vec<[bool; 2]> = found.iter().map(Found::exceeds).collect();
    let refused = too_much.iter().any(|own| own.iter().zip(evidence.strict).any(|(over, strict)| *over && strict));
    let verdict = if worst.worst <= limit && !refused {
        if too_much.iter().any(|own| *own != [false; 2]) { Verdict::Warn } else { Verdict::Pass }
    } else {
        Verdict::Fail
    };
    let mut finding = CHECK.found(worst.worst, Some(limit), "mm", verdict);
    let felt = felt_words(evidence, &found);
    finding.note = Some(format!("{}{felt}", words(&worst.written.table, tables.len())));
    finding.place = worst.at;
    Some(finding)
}

impl Found<'_> {
    /// Which of velocity and acceleration exceed what was asked for. That a control which goes straight keeps no acceleration is
    /// said, and no fault of the table.
    fn exceeds(&self) -> [bool; 2] {
        let table = &self.written.table;
        let Some(felt) = self.felt else { return [false; 2] };
        let over = |index: usize| {
            let of = |values: [f64; 2]| values.get(index).copied().unwrap_or(f64::INFINITY);
            of(felt) > of(table.allowed) * (1.0 + ROUNDING)
        };
        [over(0), table.wish.between == Between::Cubic && over(1)]
    }
}

/// What the follower feels at the most of all tables, in words.
fn felt_words(evidence: &Evidence<'_>, found: &[Found<'_>]) -> String {
    let swings = swings(evidence.body);
    let (unit, of) = if swings { (1.0, "rad") } else { (MILLIMETRES, "mm") };
    let largest = |index: usize| {
        let errors = found.iter().filter_map(|found| found.felt?.get(index).copied());
        errors.fold(0.0, f64::max)
    };
    if let Some(Judged::Not(why)) = found.first().map(|found| found.written.table.felt) {
        return format!("; velocity and acceleration are not told: {why}");
    }
    let velocity = format!("; the velocity off by {} {of}/rad", shown(unit * largest(0)));
    let acceleration = match largest(1) {
        error if error.is_finite() => format!(", the acceleration by {} {of}/rad²", shown(unit * error)),
        _ => ", no acceleration is kept where the control goes straight".to_owned(),
    };
    let over = |index: usize, name: &str| {
        let is_over = found.iter().any(|found| found.exceeds().get(index) == Some(&true));
        let asked = found.first().and_then(|found| found.written.table.allowed.get(index).copied());
        if is_over { asked.map(|asked| format!("; {} of {name} were asked for", shown(unit * asked))) } else { None }
    };
    let over = [over(0, "velocity"), over(1, "acceleration")].into_iter().flatten();
    over.fold(velocity + &acceleration, |words, next| words + &next)
}

fn none(limit: f64, why: String) -> Finding {
    Finding { note: Some(why), ..CHECK.found(f64::INFINITY, Some(limit), "mm", Verdict::Fail) }
}

/// The largest distance of a table, and what the follower feels of it.
fn found<'w>(evidence: &Evidence<'_>, written: &'w WrittenPoints) -> Result<Found<'w>, String> {
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
    let feel = feeling(evidence.body, table.z, table.given, written.cutter).ok();
    let felt = feel.map(|feel| felt_on(&*feel, curve, table.wish.between));
    Ok(Found { written, worst, at: place(evidence.body, drawn), felt })
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
