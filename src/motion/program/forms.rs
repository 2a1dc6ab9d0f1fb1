//! Motions that are given in one instead of by segments: a formula, a Fourier series, points, a table; and the segments that are given by a
//! formula, points or a table.

use super::Program;
use super::keys::{
    ACCELERATION, COSINES, DEGREE, END, ENDS, EXPRESSED, FORMULA, FOURIER, INNER, JERK, LARGEST_SWING, POINTS, SHAPE,
    SHARES, SINES, SPLINE, START, TABLE, TABULATED, VELOCITY,
};
use super::read::{Whole, value_of};
use crate::document::range::LONGEST;
use crate::document::{Columns, Field, LengthOrAngle, Reader, Table};
use crate::motion::Quantity;
use crate::motion::formula::{Formula, Scan};
use crate::motion::laws::{self, Curve, spline};
use crate::units::{self, Dimension};
use std::f64::consts::TAU;
use std::sync::Arc;

/// By how much a formula may miss the place where it must end, as a share of its range.
const SAME_PLACE: f64 = 1e-9;
/// By how much a typed angle may differ from another, rad.
const SAME_ANGLE: f64 = 1e-12;
/// Fewest points of a spline round a turn.
const FEWEST: usize = 3;
/// A motion whose positions differ by less than this share of the largest is none.
const NO_MOTION: f64 = 1e-12;

/// A fault that the user has been told.
pub(super) struct Told;

/// How a motion is given in one.
pub(super) enum Form<'r> {
    Formula,
    Points,
    Table,
    Fourier(Table<'r>),
}

impl<'r> Form<'r> {
    /// The form of a motion that has none but it, and no segments.
    pub(super) fn find(reader: &'r Reader<'r>, table: &Table<'_>, segments: bool) -> Result<Option<Self>, Told> {
        let fourier = reader.find(&FOURIER);
        let given = [
            ("formula", table.has(&FORMULA)),
            ("points", table.has(&POINTS)),
            ("table", table.has(&TABLE)),
            ("fourier", fourier.is_some()),
            ("segments", segments),
        ];
        let names: Vec<&str> = given.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
        if let [first, second, ..] = names.as_slice() {
            let message =
                format!("a motion has one of segments, formula, points, table and fourier, not {first} and {second}");
            table.fail(&START, message, Some("leave one of them out".into()));
            return Err(Told);
        }
        if table.has(&DEGREE) && !table.has(&POINTS) {
            table.fail(
                &DEGREE,
                "`degree` is of a motion by points".into(),
                Some("leave it out, or give points".into()),
            );
            return Err(Told);
        }
        Ok(match names.first() {
            Some(&"formula") => Some(Self::Formula),
            Some(&"points") => Some(Self::Points),
            Some(&"table") => Some(Self::Table),
            Some(&"fourier") => fourier.map(Self::Fourier),
            _ => None,
        })
    }

    /// The program from a position on, in so many lobes.
    pub(super) fn program(&self, table: &Table<'_>, whole: Whole, (start, lobes): (f64, u32)) -> Option<Program> {
        let unit = Unit::of(table, whole.quantity)?;
        let (name, (curve, first), at) = match self {
            Self::Formula => ("formula", formula(table, &unit, whole)?, whole.at),
            Self::Fourier(fourier) => ("fourier", series(fourier, &unit)?, whole.at),
            Self::Points => {
                let (curve, first, at) = points(table, whole)?;
                ("points", (curve, first), at)
            }
            Self::Table => ("table", tabulated(table, &unit, whole)?, whole.at),
        };
        let at = if at >= TAU { at - TAU } else { at };
        let program = Program::of_curve(whole.quantity, (at, lobes), start + first, (name, curve));
        let (low, high) = program.segments().first()?.range;
        let reach = if whole.quantity == Quantity::Angle { LARGEST_SWING } else { LONGEST };
        let size = low.abs().max(high.abs());
        if size > reach {
            let message = format!("the position reaches {}, beyond {}", unit.shown(size), unit.shown(reach));
            table.fail(&START, message, Some("positions are in the unit of motion.start".into()));
            return None;
        }
        if high - low <= NO_MOTION * size {
            table.fail(&START, "the position never changes".into(), Some("give a motion that moves".into()));
            return None;
        }
        Some(program)
    }
}

/// The unit of motion.start.
struct Unit {
    symbol: &'static str,
    size: f64,
}

impl Unit {
    fn of(table: &Table<'_>, quantity: Quantity) -> Option<Self> {
        let dimension = if quantity == Quantity::Angle { Dimension::Angle } else { Dimension::Length };
        let (symbol, size) = units::parse(&table.typed(&START), dimension).ok()?.unit();
        Some(Self { symbol, size })
    }

    /// A value in SI units, in this one.
    fn shown(&self, value: f64) -> String {
        format!("{:.6e} {}", value / self.size, self.symbol)
    }
}

/// A curve of positions above its first one, and that.
type From = (Curve, f64);

/// The curve of a formula of th over a turn or lobe.
fn formula(table: &Table<'_>, unit: &Unit, whole: Whole) -> Option<From> {
    let (formula, scan) = parsed(table, &FORMULA, "th", whole.fill)?;
    let (first, last) = (formula.at(0.0)[0], formula.at(whole.fill)[0]);
    if (last - first).abs() > SAME_PLACE * (scan.range.1 - scan.range.0) {
        let (off, turn) = (unit.shown((last - first) * unit.size), whole.fill.to_degrees());
        let message = format!("the formula does not end where it begins: over {turn} deg the position grows by {off}");
        let help = "make it periodic: sin and cos of whole multiples of th (of repeat times th with lobes)";
        table.fail(&FORMULA, message, Some(help.into()));
        return None;
    }
    Some((laws::expressed(formula, whole.fill, (unit.size, first), &scan), first * unit.size))
}

/// The formula of a key by a variable that runs from 0 to an end, which has values and derivatives all the way.
fn parsed(table: &Table<'_>, key: &Field<String>, variable: &str, end: f64) -> Option<(Formula, Scan)> {
    let text = table.get(key)?;
    let formula = Formula::parse(&text, variable)
        .map_err(|error| table.fail_at(key, error.at, format!("`formula`: {error}"), error.help.clone()))
        .ok()?;
    match formula.scanned(0.0, end) {
        Ok(scan) => Some((formula, scan)),
        Err(singular) => {
            let place = if variable == "x" {
                format!("x = {:.9}", singular.place)
            } else {
                format!("th = {:.9} rad ({:.6} deg)", singular.place, singular.place.to_degrees())
            };
            let message = format!("`formula`: character {}: at {place} {}", singular.at, singular.what);
            let help = "position, velocity, acceleration and jerk must be finite everywhere";
            table.fail_at(key, singular.at, message, Some(help.into()));
            None
        }
    }
}

/// A Fourier series.
fn series(fourier: &Table<'_>, unit: &Unit) -> Option<From> {
    let list = |key: &Field<Vec<f64>>| {
        if !fourier.has(key) {
            return Some(Vec::new());
        }
        Some(fourier.get(key)?.iter().map(|amplitude| amplitude * unit.size).collect::<Vec<f64>>())
    };
    let (cosines, sines) = (list(&COSINES)?, list(&SINES)?);
    for (key, list) in [(&COSINES, &cosines), (&SINES, &sines)] {
        if list.len() > MOST_HARMONICS {
            fourier.fail(key, format!("more than {MOST_HARMONICS} harmonics"), Some("leave the highest out".into()));
            return None;
        }
    }
    Some(laws::series(&cosines, &sines))
}

/// More are waves of half a degree.
const MOST_HARMONICS: usize = 360;

/// The spline through the points of a turn or lobe, its first position, and the cam angle of its first point.
fn points(table: &Table<'_>, whole: Whole) -> Option<(Curve, f64, f64)> {
    let points = checked(table, &POINTS, whole.quantity)?;
    let fail = |message: String, help: &str| {
        table.fail(&POINTS, message, Some(help.into()));
        None
    };
    if points.len() < FEWEST {
        return fail(format!("`points` needs {FEWEST} points or more, not {}", points.len()), "add points");
    }
    for (number, [angle, _]) in (1..).zip(&points) {
        let behind = angle - whole.at;
        if !(-SAME_ANGLE..whole.fill - SAME_ANGLE).contains(&behind) {
            let (low, high) = (whole.at.to_degrees(), (whole.at + whole.fill).to_degrees());
            let message = format!("point {number} is at {:.6} deg, not in the turn or lobe", angle.to_degrees());
            return fail(
                message,
                &format!("angles are from {low:.6} deg to below {high:.6} deg; the spline closes by itself"),
            );
        }
    }
    let degree = table.get(&DEGREE)?;
    if degree != 3.0 && degree != 5.0 {
        table.fail(&DEGREE, format!("`degree` cannot be {degree}"), Some("it is 5 or 3".into()));
        return None;
    }
    let at = points.first().map_or(0.0, |[angle, _]| *angle);
    let rows: Vec<[f64; 2]> = points.iter().map(|[angle, position]| [(angle - at) / whole.fill, *position]).collect();
    let (curve, first) = closed(&rows, degree == 3.0);
    Some((curve, first, at))
}

/// The points of a key, of the right kind and in order: angle and position.
fn checked(table: &Table<'_>, key: &Field<Vec<(f64, LengthOrAngle)>>, quantity: Quantity) -> Option<Vec<[f64; 2]>> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (number, (angle, position)) in (1..).zip(table.get(key)?) {
        let (found, position) = value_of(position);
        if found != quantity {
            let message = format!("point {number} is {}, but motion.start is {}", found.words(), quantity.words());
            table.fail(key, message, Some("give both in the same kind of unit".into()));
            return None;
        }
        if let Some([before, _]) = points.last().filter(|[before, _]| angle - before <= SAME_ANGLE) {
            let (here, before) = (angle.to_degrees(), before.to_degrees());
            let message =
                format!("point {number} at {here:.6} deg is not behind point {} at {before:.6} deg", number - 1);
            table.fail(key, message, Some("give the points by growing angle, each once".into()));
            return None;
        }
        points.push([angle, position]);
    }
    Some(points)
}

/// The periodic spline through rows of share and position, from the first row on, and its position there.
fn closed(rows: &[[f64; 2]], cubic: bool) -> From {
    let first = rows.first().map_or(0.0, |[_, position]| *position);
    let knots: Vec<f64> = rows.iter().map(|[share, _]| *share).chain([1.0]).collect();
    let values: Vec<f64> = rows.iter().map(|[_, position]| position - first).chain([0.0]).collect();
    let curve =
        if cubic { spline::cubic(&knots, &values) } else { spline::quintic(&knots, &values, spline::Ends::Periodic) };
    (curve, first)
}

/// The spline through the rows of a table.
fn tabulated(table: &Table<'_>, unit: &Unit, whole: Whole) -> Option<From> {
    let columns = table.get(&TABLE)?;
    let fill = whole.fill.to_degrees();
    let mut rows: Vec<[f64; 2]> = ordered(table, &TABLE, &columns)?;
    let fail = |row: usize, message: String, help: String| {
        table.fail_in(&TABLE, row, message, Some(help));
        None
    };
    let (count, first) = (rows.len(), rows.first().map_or(0.0, |row| row[0]));
    let last = rows.last().copied().unwrap_or_default();
    if first < 0.0 || last[0] > fill + SAME_ANGLE {
        let (row, angle) = if first < 0.0 { (0, first) } else { (count - 1, last[0]) };
        return fail(
            row,
            format!("the angle {angle} deg is not in the turn or lobe"),
            format!("angles are from 0 to {fill} deg"),
        );
    }
    // A row at the end of the turn closes it.
    if (last[0] - first - fill).abs() <= SAME_ANGLE.to_degrees() {
        let size = rows.iter().map(|row| row[1].abs()).fold(0.0, f64::max);
        let opening = rows.first().map_or(0.0, |row| row[1]);
        if (last[1] - opening).abs() > SAME_PLACE * size {
            let message = format!("the table does not end where it begins: {} and {opening} {}", last[1], unit.symbol);
            return fail(count - 1, message, "make both rows equal, or leave the last out".into());
        }
        rows.pop();
    }
    if rows.len() < FEWEST {
        return fail(count - 1, format!("a table needs {FEWEST} rows or more"), "add rows".into());
    }
    if first > SAME_ANGLE {
        let help = "let it begin at 0; motion.at says at which cam angle that is".to_owned();
        return fail(0, format!("the table begins at {first} deg"), help);
    }
    let rows: Vec<[f64; 2]> = rows.iter().map(|[angle, value]| [(angle - first) / fill, value * unit.size]).collect();
    Some(closed(&rows, false))
}

/// The rows of a file, by growing first number.
fn ordered(table: &Table<'_>, key: &Field<Arc<Columns>>, file: &Columns) -> Option<Vec<[f64; 2]>> {
    let rows: Vec<[f64; 2]> = file.rows.iter().map(|row| row.values).collect();
    let pairs = rows.iter().zip(rows.iter().skip(1));
    match (1..).zip(pairs).find(|(_, (a, b))| b[0] - a[0] <= SAME_ANGLE) {
        None => Some(rows),
        Some((row, (a, b))) => {
            let message = format!("{} is not behind {}", b[0], a[0]);
            table.fail_in(key, row, message, Some("rows are by growing first number, each once".into()));
            None
        }
    }
}

/// A law that brings its own states has none given.
pub(super) fn without_state(segment: &Table<'_>, law: &str) -> Option<()> {
    let fail = |key: &Field<String>| {
        segment.fail(
            key,
            format!("law = \"{law}\" has its own velocity and acceleration"),
            Some("leave it out".into()),
        );
    };
    if let Some(key) = [&VELOCITY, &ACCELERATION, &JERK].into_iter().find(|key| segment.has(key)) {
        fail(key);
        return None;
    }
    if segment.has(&END) {
        let message = format!("law = \"{law}\" has its own velocity and acceleration");
        segment.fail(&END, message, Some("leave it out".into()));
        return None;
    }
    Some(())
}

/// A fault of a law without its key.
fn absent<T>(segment: &Table<'_>, key: &Field<T>, law: &str, example: &str) {
    let name = key.key.name;
    segment.fail(key, format!("law = \"{law}\" needs `{name}`"), Some(format!("e.g. {name} = {example}")));
}

/// The curve of a formula of x.
pub(super) fn shape(segment: &Table<'_>) -> Option<Curve> {
    if !segment.has(&SHAPE) {
        absent(segment, &SHAPE, EXPRESSED, "\"x^3*(10-15*x+6*x^2)\"");
        return None;
    }
    let (formula, scan) = parsed(segment, &SHAPE, "x", 1.0)?;
    let ends = [formula.at(0.0)[0], formula.at(1.0)[0]];
    for (end, (found, wanted)) in ends.into_iter().zip([0.0, 1.0]).enumerate() {
        if (found - wanted).abs() > SAME_PLACE {
            let message = format!("the formula is {found} at x = {end}, not {wanted}");
            let help = "it is the share of the travel: 0 at x = 0 and 1 at x = 1";
            segment.fail(&SHAPE, message, Some(help.into()));
            return None;
        }
    }
    Some(laws::expressed(formula, 1.0, (1.0, 0.0), &scan))
}

/// The curve of a table of shares.
pub(super) fn shares(segment: &Table<'_>) -> Option<Curve> {
    if !segment.has(&SHARES) {
        absent(segment, &SHARES, TABULATED, "\"law.csv\"");
        return None;
    }
    let columns = segment.get(&SHARES)?;
    let rows = ordered(segment, &SHARES, &columns)?;
    let last = rows.len().saturating_sub(1);
    for (row, wanted) in [(0, 0.0), (last, 1.0)] {
        let found = rows.get(row).copied().unwrap_or_default();
        if last == 0 || found.iter().any(|value| (value - wanted).abs() > SAME_PLACE) {
            let message = format!("the table runs from 0, 0 to 1, 1; this row should be {wanted}, {wanted}");
            segment.fail_in(
                &SHARES,
                row,
                message,
                Some("both columns are shares: of the angle and of the travel".into()),
            );
            return None;
        }
    }
    let (mut knots, mut values): (Vec<f64>, Vec<f64>) = rows.iter().map(|row| (row[0], row[1])).unzip();
    for list in [&mut knots, &mut values] {
        for (end, value) in [(0, 0.0), (last, 1.0)] {
            if let Some(slot) = list.get_mut(end) {
                *slot = value;
            }
        }
    }
    Some(spline::quintic(&knots, &values, segment.get(&ENDS)?))
}

/// The inner points of a spline: cam angle and position.
pub(super) fn inner(segment: &Table<'_>, quantity: Quantity) -> Option<Vec<[f64; 2]>> {
    if !segment.has(&INNER) {
        absent(segment, &INNER, SPLINE, "[[\"30 deg\", \"4 mm\"], [\"60 deg\", \"15 mm\"]]");
        return None;
    }
    checked(segment, &INNER, quantity)
}

/// Counts the angles of inner points from the start of their segment, in which they must lie.
pub(super) fn behind(segment: &Table<'_>, points: &mut [[f64; 2]], (start, over): (f64, f64)) -> Option<()> {
    for (number, point) in (1..).zip(points) {
        let angle = point[0];
        point[0] -= start;
        if !(point[0] > SAME_ANGLE && point[0] < over - SAME_ANGLE) {
            let message = format!("point {number} at {:.6} deg is not inside the segment", angle.to_degrees());
            let (low, high) = (start.to_degrees(), (start + over).to_degrees());
            segment.fail(&INNER, message, Some(format!("it runs from {low:.6} deg to {high:.6} deg")));
            return None;
        }
    }
    Some(())
}
