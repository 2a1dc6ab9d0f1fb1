//! Motions that are given as a whole instead of by segments: a formula, a Fourier series, points, a table; and segments that are given by a
//! formula, points or a table.

use super::context::{FaultReported, ProgramContext};
use super::keys::{
    ACCELERATION, BETWEEN, COLUMNS, COSINES, DEGREE, END, ENDS, EXPRESSED, FORMULA, FOURIER, INNER, JERK,
    LARGEST_SWING, LIFT, MIRROR, OVER_ROWS, POINTS, RATIO_OF_ANGLES, REST, SCALE, SHAPE, SHARES, SINES, SMOOTH, SPLINE,
    START, STEP, STROKE, TABLE, TABULATED, UNIT, VELOCITY,
};
use super::rows::{self, Origin, RowFigures, RowPlace, RowWishes, Rows, SplineRows};
use super::{Program, Span};
use crate::document::range::LONGEST;
use crate::document::{Columns, Field, PointList, Reader, TableReader};
use crate::motion::Quantity;
use crate::motion::formula::{Formula, Scan};
use crate::motion::laws::{self, LawCurve};
use crate::units::{self, Dimension};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Largest distance of a formula from the position where it must end, as a share of its range.
const SAME_PLACE: f64 = 1e-9;
/// Typed angles that differ by less are equal, rad.
const SAME_ANGLE: f64 = 1e-12;
/// Positions that differ by less than this share of the largest do not move.
const NO_MOTION: f64 = 1e-12;

/// How a motion is given as a whole.
pub(super) enum MotionForm<'r> {
    Formula,
    Points,
    Table,
    Fourier(TableReader<'r>),
}

impl<'r> MotionForm<'r> {
    /// The form of a motion without segments; a second form, or segments as well, are a fault.
    pub(super) fn find(
        reader: &'r Reader<'r>,
        table: &TableReader<'_>,
        segments: bool,
    ) -> Result<Option<Self>, FaultReported> {
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
            let message = format!(
                "give the motion by one of segments, formula, points, table and fourier, not by {first} and {second}"
            );
            table.fail(&START, message, Some("remove one of them".into()));
            return Err(FaultReported);
        }
        if table.has(&DEGREE) && !table.has(&POINTS) {
            table.fail(
                &DEGREE,
                "`degree` applies only to a motion given by points".into(),
                Some("remove it, or give points".into()),
            );
            return Err(FaultReported);
        }
        refuse_keys_of_rows(table)?;
        if table.has(&STROKE)
            && let Some(closing) = names.first().filter(|name| ["points", "table", "fourier"].contains(*name))
        {
            let message = format!("`{closing}` of a whole motion closes after a turn, and a plate does not turn");
            let help = "give segments, with law = \"spline\" or \"table\" for points and rows, or a formula of x";
            table.fail(&STROKE, message, Some(help.into()));
            return Err(FaultReported);
        }
        Ok(match names.first() {
            Some(&"formula") => Some(Self::Formula),
            Some(&"points") => Some(Self::Points),
            Some(&"table") => Some(Self::Table),
            Some(&"fourier") => fourier.map(Self::Fourier),
            _ => None,
        })
    }

    /// The program from a position on, with this number of lobes.
    pub(super) fn program(
        &self,
        table: &TableReader<'_>,
        whole: ProgramContext,
        start: f64,
        lobes: u32,
    ) -> Option<Program> {
        let unit = StartUnit::read(table, whole)?;
        let (name, (curve, first), at) = match self {
            Self::Formula => ("formula", formula(table, &unit, whole)?, whole.at),
            Self::Fourier(fourier) => ("fourier", series(fourier, &unit)?, whole.at),
            Self::Points | Self::Table => {
                let rows = match self {
                    Self::Points => points(table, whole)?,
                    _ => rows::file::read(table, whole)?,
                };
                let program = rows::program(table, whole, start, lobes, rows)?;
                return within_reach(table, &unit, whole.quantity, program);
            }
        };
        let at = if at >= TAU && !whole.by_travel { at - TAU } else { at };
        let span = if whole.by_travel { Span::Stroke(whole.fill) } else { Span::Turn { at, lobes } };
        let program = Program::of_curve(whole.quantity, span, start + first, name, curve);
        within_reach(table, &unit, whole.quantity, program)
    }
}

/// Refuses keys of rows beside another form of a motion.
fn refuse_keys_of_rows(table: &TableReader<'_>) -> Result<(), FaultReported> {
    fn refused<T>(table: &TableReader<'_>, key: &Field<T>, what: &str, kept: bool) -> bool {
        let refused = table.has(key) && !kept;
        if refused {
            let message = format!("`{}` applies only to a motion given by {what}", key.key.name);
            table.fail(key, message, Some(format!("remove it, or give {what}")));
        }
        refused
    }
    let (of_table, of_rows) = (table.has(&TABLE), table.has(&TABLE) || table.has(&POINTS));
    let (one, both) = ("a table", "a table or points");
    let all = [
        refused(table, &COLUMNS, one, of_table),
        refused(table, &UNIT, one, of_table),
        refused(table, &SCALE, one, of_table),
        refused(table, &RATIO_OF_ANGLES, one, of_table),
        refused(table, &STEP, one, of_table),
        refused(table, &LIFT, one, of_table),
        refused(table, &OVER_ROWS, one, of_table),
        refused(table, &MIRROR, both, of_rows),
        refused(table, &REST, both, of_rows),
        refused(table, &BETWEEN, both, of_rows),
        refused(table, &SMOOTH, both, of_rows),
    ];
    if all.contains(&true) { Err(FaultReported) } else { Ok(()) }
}

/// The program, if its positions are possible.
fn within_reach(table: &TableReader<'_>, unit: &StartUnit, quantity: Quantity, program: Program) -> Option<Program> {
    let ranges = program.segments().iter().map(|segment| segment.range);
    let (low, high) = ranges.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (l, h)| (low.min(l), high.max(h)));
    let reach = if quantity == Quantity::Angle { LARGEST_SWING } else { LONGEST };
    let size = low.abs().max(high.abs());
    if size > reach {
        let message =
            format!("the position reaches {}; the largest possible is {}", unit.shown(size), unit.shown(reach));
        table.fail(&START, message, Some("positions are in the unit of motion.start".into()));
        return None;
    }
    if !(high - low > NO_MOTION * size) {
        table.fail(&START, "the position never changes".into(), Some("give a motion that moves".into()));
        return None;
    }
    Some(program)
}

/// The unit of `motion.start`.
struct StartUnit {
    symbol: &'static str,
    size: f64,
}

impl StartUnit {
    fn read(table: &TableReader<'_>, whole: ProgramContext) -> Option<Self> {
        let typed = table.typed(&START);
        if let Some((arc, quantity)) = whole.arc.zip(units::parse(&typed, Dimension::Length).ok()) {
            let (symbol, size) = quantity.unit();
            return Some(Self { symbol, size: size / arc });
        }
        let dimension = if whole.quantity == Quantity::Angle { Dimension::Angle } else { Dimension::Length };
        let (symbol, size) = units::parse(&typed, dimension).ok()?.unit();
        Some(Self { symbol, size })
    }

    /// A value in SI units, in this one.
    fn shown(&self, value: f64) -> String {
        format!("{:.6e} {}", value / self.size, self.symbol)
    }
}

/// A curve of positions above its first one, and that first position.
type OffsetCurve = (LawCurve, f64);

/// The curve of a formula of th over a turn or lobe, or of x over the stroke of a plate.
fn formula(table: &TableReader<'_>, unit: &StartUnit, whole: ProgramContext) -> Option<OffsetCurve> {
    let (variable, fill) = if whole.by_travel { ("x", whole.fill / unit.size) } else { ("th", whole.fill) };
    let (formula, scan) = parse_formula(table, &FORMULA, variable, fill)?;
    let (first, last) = (formula.values_at(0.0)[0], formula.values_at(fill)[0]);
    if !whole.by_travel && (last - first).abs() > SAME_PLACE * (scan.range.1 - scan.range.0) {
        let (off, turn) = (unit.shown((last - first) * unit.size), whole.fill.to_degrees());
        let message = format!("the formula does not end where it begins: over {turn} deg the position grows by {off}");
        let help = "make it periodic: sin and cos of whole multiples of th (of repeat times th with lobes)";
        table.fail(&FORMULA, message, Some(help.into()));
        return None;
    }
    Some((laws::from_formula(formula, fill, unit.size, first, &scan), first * unit.size))
}

/// The formula of a key by a variable that runs from 0 to an end, which must have values and derivatives everywhere.
fn parse_formula(table: &TableReader<'_>, key: &Field<String>, variable: &str, end: f64) -> Option<(Formula, Scan)> {
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

fn amplitudes(fourier: &TableReader<'_>, key: &Field<Vec<f64>>, unit: &StartUnit) -> Option<Vec<f64>> {
    if !fourier.has(key) {
        return Some(Vec::new());
    }
    Some(fourier.get(key)?.iter().map(|amplitude| amplitude * unit.size).collect())
}

/// A Fourier series.
fn series(fourier: &TableReader<'_>, unit: &StartUnit) -> Option<OffsetCurve> {
    let (cosines, sines) = (amplitudes(fourier, &COSINES, unit)?, amplitudes(fourier, &SINES, unit)?);
    for (key, list) in [(&COSINES, &cosines), (&SINES, &sines)] {
        if list.len() > MOST_HARMONICS {
            fourier.fail(key, format!("more than {MOST_HARMONICS} harmonics"), Some("remove the highest".into()));
            return None;
        }
    }
    Some(laws::from_harmonics(&cosines, &sines))
}

/// More would be waves of less than a degree.
const MOST_HARMONICS: usize = 360;

/// The points of a turn or lobe.
fn points(table: &TableReader<'_>, whole: ProgramContext) -> Option<Rows> {
    let points = typed_points(table, &POINTS, whole)?;
    let unit = TYPED / whole.typed(table).1;
    let positions: Vec<f64> = points.iter().map(|[_, position]| position / unit).collect();
    let rounding = unit * rows::rounding::step(&positions);
    let places =
        (0..).zip(&points).map(|(row, [at, position])| RowPlace { at: *at, position: *position, row, line: None });
    let (points, told) = (places.collect(), Vec::new());
    Some(Rows { points, rounding, rounding_of_angles: 0.0, origin: Origin::Points, told })
}

/// In which unit typed positions are looked at for their last digits: millimetres of a length.
const TYPED: f64 = 1e-3;

/// The points of a key, of the right kind: angle and position.
fn typed_points(table: &TableReader<'_>, key: &Field<PointList>, whole: ProgramContext) -> Option<Vec<[f64; 2]>> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (number, (place, position)) in (1..).zip(table.get(key)?) {
        let place = match whole.along(place) {
            Ok(place) => place,
            Err(found) => {
                let (message, help) = whole.wrong_place(key.key.name, found);
                table.fail(key, format!("{message}, at point {number}"), Some(help));
                return None;
            }
        };
        let (found, position) = whole.value_of(position);
        if found != whole.quantity {
            let message =
                format!("point {number} is {}, but motion.start is {}", found.words(), whole.quantity.words());
            table.fail(key, message, Some(whole.remedy(position)));
            return None;
        }
        points.push([place, position]);
    }
    Some(points)
}

/// The points of a key, in order.
fn increasing_points(table: &TableReader<'_>, key: &Field<PointList>, whole: ProgramContext) -> Option<Vec<[f64; 2]>> {
    let points = typed_points(table, key, whole)?;
    let pairs = points.iter().zip(points.iter().skip(1));
    match (1..).zip(pairs).find(|(_, (a, b))| b[0] - a[0] <= SAME_ANGLE) {
        None => Some(points),
        Some((number, (before, here))) => {
            let (here, before) = (whole.shown(here[0]), whole.shown(before[0]));
            let message = format!("point {} at {here} does not come after point {number} at {before}", number + 1);
            let what = if whole.by_travel { "place" } else { "angle" };
            let help = format!("give the points in order of increasing {what}, each {what} once");
            table.fail(key, message, Some(help));
            None
        }
    }
}

/// The rows of a file, which must have increasing first numbers.
fn increasing_rows(table: &TableReader<'_>, key: &Field<Arc<Columns>>, file: &Columns) -> Option<Vec<[f64; 2]>> {
    let rows = rows::file::pairs(table, key, file)?;
    let pairs = rows.iter().zip(rows.iter().skip(1));
    match (1..).zip(pairs).find(|(_, (a, b))| b[0] - a[0] <= SAME_ANGLE) {
        None => Some(rows),
        Some((row, (a, b))) => {
            let message = format!("{} does not come after {}", b[0], a[0]);
            table.fail_in(key, row, message, Some("sort the rows by their first number, each value once".into()));
            None
        }
    }
}

/// Refuses states of a segment whose law determines them.
pub(super) fn refuse_states(segment: &TableReader<'_>, law: &str) -> Option<()> {
    let message = format!("law = \"{law}\" determines velocity and acceleration itself");
    let help = Some("remove this key".into());
    if let Some(key) = [&VELOCITY, &ACCELERATION, &JERK].into_iter().find(|key| segment.has(key)) {
        segment.fail(key, message, help);
        return None;
    }
    if segment.has(&END) {
        segment.fail(&END, message, help);
        return None;
    }
    Some(())
}

/// A fault of a law without its key.
fn report_absent<T>(segment: &TableReader<'_>, key: &Field<T>, law: &str, example: &str) {
    let name = key.key.name;
    segment.fail(key, format!("law = \"{law}\" needs `{name}`"), Some(format!("e.g. {name} = {example}")));
}

/// The curve of a formula of x.
pub(super) fn formula_curve(segment: &TableReader<'_>) -> Option<LawCurve> {
    if !segment.has(&SHAPE) {
        report_absent(segment, &SHAPE, EXPRESSED, "\"x^3*(10-15*x+6*x^2)\"");
        return None;
    }
    let (formula, scan) = parse_formula(segment, &SHAPE, "x", 1.0)?;
    let ends = [formula.values_at(0.0)[0], formula.values_at(1.0)[0]];
    for (end, (found, wanted)) in ends.into_iter().zip([0.0, 1.0]).enumerate() {
        if (found - wanted).abs() > SAME_PLACE {
            let message = format!("the formula gives {found} at x = {end} instead of {wanted}");
            let help = "it must give the share of the travel: 0 at x = 0 and 1 at x = 1";
            segment.fail(&SHAPE, message, Some(help.into()));
            return None;
        }
    }
    Some(laws::from_formula(formula, 1.0, 1.0, 0.0, &scan))
}

/// The curve of a table of shares, for a segment of a travel where that is known, and its figures in shares.
pub(super) fn table_curve(
    segment: &TableReader<'_>,
    whole: ProgramContext,
    travel: Option<f64>,
) -> Option<(LawCurve, RowFigures)> {
    if !segment.has(&SHARES) {
        report_absent(segment, &SHARES, TABULATED, "\"law.csv\"");
        return None;
    }
    let columns = segment.get(&SHARES)?;
    let rows = increasing_rows(segment, &SHARES, &columns)?;
    let last = rows.len().saturating_sub(1);
    for (row, wanted) in [(0, 0.0), (last, 1.0)] {
        let found = rows.get(row).copied().unwrap_or_default();
        if last == 0 || found.iter().any(|value| (value - wanted).abs() > SAME_PLACE) {
            let message = format!("the table must run from 0, 0 to 1, 1: this row should be {wanted}, {wanted}");
            segment.fail_in(
                &SHARES,
                row,
                message,
                Some("the columns are shares of the angle and of the travel".into()),
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
    let ends = segment.get(&ENDS)?;
    // A segment without travel is refused elsewhere.
    let size = travel.map(f64::abs).filter(|size| *size > 0.0).unwrap_or(1.0);
    let wishes = RowWishes::of_segment(segment, rows::rounding::step(&values), &dimensions(whole, size))?;
    let (curve, figures) = rows::segment::tabulated(&knots, &values, ends, wishes);
    Some((curve, figures.at_lines(&columns)))
}

/// As what a deviation from rows in a unit of this size (m or rad) may be typed, each with the size of that unit.
fn dimensions(whole: ProgramContext, size: f64) -> Vec<(Dimension, f64)> {
    if whole.quantity == Quantity::Length {
        return vec![(Dimension::Length, size)];
    }
    let along = whole.arc.map(|arc| (Dimension::Length, size * arc));
    std::iter::once((Dimension::Angle, size)).chain(along).collect()
}

/// The inner points of a spline: cam angle and position, and how the curve goes through them or near them.
pub(super) fn inner_points(segment: &TableReader<'_>, whole: ProgramContext) -> Option<SplineRows> {
    if !segment.has(&INNER) {
        report_absent(segment, &INNER, SPLINE, "[[\"30 deg\", \"4 mm\"], [\"60 deg\", \"15 mm\"]]");
        return None;
    }
    let points = increasing_points(segment, &INNER, whole)?;
    let unit = TYPED / whole.arc.unwrap_or(1.0);
    let positions: Vec<f64> = points.iter().map(|[_, position]| position / unit).collect();
    let rounding = unit * rows::rounding::step(&positions);
    let wishes = RowWishes::of_segment(segment, rounding, &dimensions(whole, 1.0))?;
    Some(SplineRows { points, rounding, wishes })
}

/// Measures the angles of inner points from the start of their segment, which must contain them.
pub(super) fn measure_from_start(
    segment: &TableReader<'_>,
    whole: ProgramContext,
    points: &mut [[f64; 2]],
    start: f64,
    over: f64,
) -> Option<()> {
    for (number, point) in (1..).zip(points) {
        let place = point[0];
        point[0] -= start;
        if !(point[0] > SAME_ANGLE && point[0] < over - SAME_ANGLE) {
            let message = format!("point {number} at {} is not inside the segment", whole.shown(place));
            let (low, high) = (whole.shown(start), whole.shown(start + over));
            segment.fail(&INNER, message, Some(format!("it runs from {low} to {high}")));
            return None;
        }
    }
    Some(())
}
