//! A motion through rows of a table or points: what the rows cover of the turn, where they rest, the curve through or near them, and how
//! far it leaves them.

mod curve;
pub(super) mod file;
mod nodes;
pub mod rounding;
pub mod samples;
pub(super) mod segment;
mod turn;

use super::Program;
use super::context::{FaultReported, ProgramContext};
use super::keys::{BETWEEN, DEGREE, MIRROR, POINTS, REST, SMOOTH, TABLE};
use crate::document::{Columns, Field, FileRow, TableReader};
use crate::motion::Quantity;
use crate::numeric::scatter::range;
use crate::refusal::Refusal;
use crate::units::{self, Dimension};

pub use super::keys::{RestOfTurn, RowShape};
pub use segment::SplineRows;

/// Equal rows more than this many usual spacings apart are a dwell.
const OF_DWELL: f64 = 1.5;

/// A row: cam angle, rad, and position above start, m or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RowPlace {
    pub(super) at: f64,
    pub(super) position: f64,
    /// Its index in the file, or among the points.
    pub(super) row: usize,
    /// Its line in the file.
    pub(super) line: Option<usize>,
}

/// Where rows come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Origin {
    /// A file; its angles count as degrees unless it is said otherwise, and cover this span as they are written. Its positions are lifts by a key
    /// or a heading, or may be anything.
    File { in_degrees: bool, span: f64, has_lifts: bool },
    /// Points of the machine file.
    Points,
    /// Samples of a program.
    Samples,
}

/// A fault of rows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RowsFault {
    /// It is a fault of `mirror`, not of a row.
    of_mirror: bool,
    /// The index of the row.
    row: usize,
    message: String,
    help: String,
}

impl RowsFault {
    fn new(row: usize, message: String, help: String) -> Self {
        Self { of_mirror: false, row, message, help }
    }
}

impl From<RowsFault> for Refusal {
    fn from(fault: RowsFault) -> Self {
        Self::new(fault.message).remedy(fault.help)
    }
}

/// Rows as they were read.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub(super) points: Vec<RowPlace>,
    /// Step to which the positions are rounded, m or rad.
    pub(super) rounding: f64,
    /// Step to which the angles are rounded, rad.
    pub(super) rounding_of_angles: f64,
    pub(super) origin: Origin,
    /// How they were read, where that does not go without saying.
    pub(super) told: Vec<String>,
}

impl Rows {
    /// Reports a fault at the key `mirror`, or at its row.
    fn report(&self, table: &TableReader<'_>, RowsFault { of_mirror, row, message, help }: RowsFault) {
        match self.origin {
            _ if of_mirror => table.fail(&MIRROR, message, Some(help)),
            Origin::File { .. } => table.fail_in(&TABLE, row, message, Some(help)),
            Origin::Points | Origin::Samples => table.fail(&POINTS, message, Some(help)),
        }
    }

    /// The turn that they cover; else reports why they cover none.
    fn turn(&mut self, table: &TableReader<'_>, fill: f64) -> Option<turn::Turn> {
        let mirrored = table.has(&MIRROR) && table.get(&MIRROR)?;
        let rest = if table.has(&REST) { Some(table.get(&REST)?) } else { None };
        turn::Turn::new(fill, self, mirrored, rest).map_err(|fault| self.report(table, fault)).ok()
    }

    /// The first and the last row.
    fn ends(&self) -> (RowPlace, RowPlace) {
        let none = RowPlace { at: 0.0, position: 0.0, row: 0, line: None };
        (self.points.first().copied().unwrap_or(none), self.points.last().copied().unwrap_or(none))
    }

    /// What they are together, and several of them.
    fn words(&self) -> (&'static str, &'static str) {
        match self.origin {
            Origin::File { .. } => ("a table", "rows"),
            Origin::Points => ("`points`", "points"),
            Origin::Samples => ("a motion of samples", "samples"),
        }
    }

    fn name(&self) -> &'static str {
        match self.origin {
            Origin::File { .. } => "table",
            Origin::Points => "points",
            Origin::Samples => "samples",
        }
    }
}

/// Rows of a lift table over a turn or lobe: in order, without the one that closes it.
#[derive(Debug, Clone, PartialEq)]
pub struct TableRows {
    /// Whether the positions are lengths or angles.
    pub quantity: Quantity,
    /// What the rows fill: a turn or a lobe, rad.
    pub fill: f64,
    /// Cam angles, rad, growing, all of them within one filling.
    pub angles: Vec<f64>,
    /// Positions, m or rad, as many.
    pub positions: Vec<f64>,
    /// The step to which the positions are rounded; 0 where none is seen.
    pub rounding: f64,
    /// Whether a key or a heading says that the positions are lifts.
    pub has_lifts: bool,
    /// What was read otherwise than as it stands, in words.
    pub told: Vec<String>,
}

/// Least radius of a cam, as a share of its lift.
const LEAST_RADIUS: f64 = 0.1;

impl TableRows {
    /// The least and the largest position, m, where they may be radii of a cam: nothing says that they are lifts, and none is near 0.
    #[must_use]
    pub fn possible_radii(&self) -> Option<(f64, f64)> {
        let (low, high) = range(&self.positions);
        let may_be =
            self.quantity == Quantity::Length && !self.has_lifts && high > low && low > LEAST_RADIUS * (high - low);
        may_be.then_some((low, high))
    }
}

/// The rows of the file of `table`, as they are.
pub(super) fn table_rows(table: &TableReader<'_>, whole: ProgramContext) -> Option<TableRows> {
    let mut rows = file::read(table, whole)?;
    let turn = rows.turn(table, whole.fill)?;
    let count = turn.dwells.len();
    Some(TableRows {
        quantity: whole.quantity,
        fill: whole.fill,
        angles: turn.knots.iter().take(count).map(|knot| turn.at + whole.fill * knot).collect(),
        positions: turn.values.iter().take(count).copied().collect(),
        rounding: rows.rounding,
        has_lifts: matches!(rows.origin, Origin::File { has_lifts: true, .. }),
        told: rows.told,
    })
}

/// How rows were smoothed, m or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smoothing {
    /// The largest deviation that was allowed.
    pub bound: f64,
    /// The largest deviation from a row.
    pub largest: f64,
    /// The root of the mean square of all.
    pub rms: f64,
}

/// What errors of rows do to the acceleration of the curve through them; positions in m or rad, angles in rad of the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowNoise {
    /// Standard deviation of their scatter about a smooth curve, where it is more than that of their rounding.
    pub scatter: Option<f64>,
    /// The largest deviation with which smoothing takes the errors away.
    pub smooth: f64,
    /// The largest acceleration as it is.
    pub largest: f64,
    /// The largest acceleration of rows smoothed so.
    pub smoothed: f64,
}

/// The row with the largest distance from the curve of its neighbours / allowed distance; positions in m or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowOutlier {
    /// Its number, from 1 on.
    pub row: usize,
    /// Its line in a file.
    pub line: Option<usize>,
    /// Its cam angle, rad.
    pub at: f64,
    /// Its position minus the curve of its neighbours.
    pub off: f64,
    /// Allowed distance, from the scatter and rounding of the rows and the derivatives of the motion there.
    pub allowed: f64,
}

/// Figures of a curve through rows; angles in rad of the cam, positions in m or rad.
#[derive(Debug, Clone, PartialEq)]
pub struct RowFigures {
    /// The segment whose rows they are, from 0 on; `None` of the rows of the whole motion.
    pub segment: Option<usize>,
    /// How many rows there are in a turn, lobe or segment; with both ends of a segment.
    pub count: usize,
    /// The usual angle between two of them.
    pub spacing: f64,
    /// First and last angle of the widest gap that does not rest.
    pub widest: (f64, f64),
    /// First and last angle of each rest between two rows.
    pub dwells: Vec<(f64, f64)>,
    /// By how much the curve leaves the positions of the two rows between which it is, and where.
    pub overshoot: (f64, f64),
    /// The step to which the positions are rounded; 0 where none is seen.
    pub rounding: f64,
    /// How they were smoothed.
    pub smoothing: Option<Smoothing>,
    /// What errors of the rows do to the acceleration, where they are seen and not smoothed.
    pub noise: Option<RowNoise>,
    /// The row farthest off its neighbours; `None` if there are too few rows.
    pub outlier: Option<RowOutlier>,
    /// What was read otherwise than as it stands, in words.
    pub told: Vec<String>,
}

/// Degrees without the rounding of the conversion.
pub(super) fn degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e6).round() / 1e6 + 0.0
}

impl RowFigures {
    /// Figures in shares of a segment that begins at an angle and has a width (rad) and a travel.
    pub(super) fn of_segment(self, index: usize, from: f64, to: f64, travel: f64) -> Self {
        Self { segment: Some(index), ..self.placed(from, to, travel) }
    }

    /// Adds the file line of the outlier.
    pub(super) fn at_lines(self, file: &Columns) -> Self {
        Self {
            outlier: self.outlier.map(|outlier| {
                let row = outlier.row.checked_sub(1).and_then(|index| file.rows.get(index));
                RowOutlier { line: row.map(FileRow::line), ..outlier }
            }),
            ..self
        }
    }

    /// Figures by shares at an angle and over a width, rad, with positions in a size.
    fn placed(self, at: f64, width: f64, size: f64) -> Self {
        let angle = |share: f64| at + width * share;
        Self {
            spacing: width * self.spacing,
            widest: (angle(self.widest.0), angle(self.widest.1)),
            dwells: self.dwells.iter().map(|(from, to)| (angle(*from), angle(*to))).collect(),
            overshoot: (size * self.overshoot.0, angle(self.overshoot.1)),
            rounding: size * self.rounding,
            smoothing: self.smoothing.map(|Smoothing { bound, largest, rms }| Smoothing {
                bound: size * bound,
                largest: size * largest,
                rms: size * rms,
            }),
            noise: self.noise.map(|noise| RowNoise {
                scatter: noise.scatter.map(|scatter| size * scatter),
                smooth: size * noise.smooth,
                largest: size * noise.largest / width / width,
                smoothed: size * noise.smoothed / width / width,
            }),
            outlier: self.outlier.map(|outlier| RowOutlier {
                at: angle(outlier.at),
                off: size * outlier.off,
                allowed: size * outlier.allowed,
                ..outlier
            }),
            ..self
        }
    }
}

/// How the curve through rows is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowWishes {
    /// How it goes from row to row.
    pub shape: RowShape,
    /// A spline of degree 3.
    pub cubic: bool,
    /// Largest deviation from a row, where smoothing is asked for; 0 where no rounding is seen that could be smoothed.
    pub smooth: Option<f64>,
}

impl RowWishes {
    /// The curve of least jerk through the rows.
    pub const NATURAL: Self = Self { shape: RowShape::Natural, cubic: false, smooth: None };

    fn read(table: &TableReader<'_>, rows: &Rows, quantity: Quantity, arc: f64) -> Option<Self> {
        let shape = if table.has(&BETWEEN) { table.get(&BETWEEN)? } else { RowShape::Natural };
        let degree = table.get(&DEGREE)?;
        if degree != 3.0 && degree != 5.0 {
            table.fail(&DEGREE, format!("`degree` cannot be {degree}"), Some("use 5 or 3".into()));
            return None;
        }
        let one = if quantity == Quantity::Angle { (Dimension::Angle, 1.0) } else { (Dimension::Length, arc) };
        let smooth = smoothing(table, &SMOOTH, rows.rounding, &[one]).ok()?;
        let wishes = Self { shape, cubic: degree == 3.0, smooth };
        wishes.checked().map_err(|(message, help)| table.fail(&DEGREE, message, Some(help.into()))).ok()
    }

    /// These wishes; if they contradict each other, the message and remedy.
    fn checked(self) -> Result<Self, (String, &'static str)> {
        if self.cubic && (self.smooth.is_some() || self.shape == RowShape::Monotonic) {
            let other = if self.smooth.is_some() { "smooth" } else { "shape = \"monotonic\"" };
            let message = format!("degree = 3 and {other} cannot both be given: that curve is of degree 5");
            return Err((message, "remove `degree`"));
        }
        Ok(self)
    }
}

/// The largest deviation that a key asks for, in the unit of the rows and their rounding; `None` where it is not given. It may be typed
/// as one of some dimensions, each with the size of the unit of the rows.
fn smoothing(
    table: &TableReader<'_>,
    key: &Field<String>,
    rounding: f64,
    dimensions: &[(Dimension, f64)],
) -> Result<Option<f64>, FaultReported> {
    if !table.has(key) {
        return Ok(None);
    }
    let typed = table.get(key).ok_or(FaultReported)?;
    if typed.trim().eq_ignore_ascii_case("auto") {
        return Ok(Some(0.5 * rounding));
    }
    let mut fault = None;
    for (dimension, size) in dimensions {
        match units::parse(&typed, *dimension) {
            Ok(quantity) if quantity.si > 0.0 => return Ok(Some(quantity.si / size)),
            Ok(_) => fault = Some("`smooth` must be above 0".to_owned()),
            Err(error) => fault = fault.or_else(|| Some(format!("`smooth`: {error}"))),
        }
    }
    let of_angle = dimensions.iter().all(|(dimension, _)| *dimension == Dimension::Angle);
    let example = if of_angle { "0.01 deg" } else { "3 um" };
    let help = format!("\"auto\", or the largest deviation from a row, e.g. \"{example}\"");
    table.fail(key, fault.unwrap_or_default(), Some(help));
    Err(FaultReported)
}

/// The program through rows, from a position on, in a number of lobes.
pub(super) fn program(
    table: &TableReader<'_>,
    whole: ProgramContext,
    start: f64,
    lobes: u32,
    mut rows: Rows,
) -> Option<Program> {
    let (quantity, arc) = whole.typed(table);
    let wishes = RowWishes::read(table, &rows, quantity, arc)?;
    let turn = rows.turn(table, whole.fill)?.moved(whole.at);
    Some(curve::program(&turn, start, lobes, whole, &rows, wishes))
}
