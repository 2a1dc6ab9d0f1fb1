//! A motion through rows of a table or points: what the rows cover of the turn, where they rest, the curve through or near them, and how
//! far it leaves them.

mod curve;
pub(super) mod file;
mod nodes;
pub mod rounding;
pub(super) mod segment;
mod turn;

use super::Program;
use super::context::ProgramContext;
use super::fault_reported::FaultReported;
use super::keys::{BETWEEN, DEGREE, MIRROR, POINTS, REST, SMOOTH, TABLE};
use crate::document::{Field, TableReader};
use crate::motion::Quantity;
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
    /// Its place in the file, or among the points.
    pub(super) row: usize,
}

/// Where rows come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Origin {
    /// A file; its angles count as degrees unless it is said otherwise, and cover this span as they are written.
    File { in_degrees: bool, span: f64 },
    /// Points of the machine file.
    Points,
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
    /// Reports a fault at a row.
    pub(super) fn fail(&self, table: &TableReader<'_>, row: usize, message: String, help: String) {
        match self.origin {
            Origin::File { .. } => table.fail_in(&TABLE, row, message, Some(help)),
            Origin::Points => table.fail(&POINTS, message, Some(help)),
        }
    }

    /// What they are together, and several of them.
    fn words(&self) -> (&'static str, &'static str) {
        if self.origin == Origin::Points { ("`points`", "points") } else { ("a table", "rows") }
    }

    fn name(&self) -> &'static str {
        if self.origin == Origin::Points { "points" } else { "table" }
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
    /// What was read otherwise than as it stands, in words.
    pub told: Vec<String>,
}

/// The rows of the file of `table`, as they are.
pub(super) fn table_rows(table: &TableReader<'_>, whole: ProgramContext) -> Option<TableRows> {
    let mut rows = file::read(table, whole)?;
    let mirrored = table.has(&MIRROR) && table.get(&MIRROR)?;
    let rest = if table.has(&REST) { Some(table.get(&REST)?) } else { None };
    let turn = turn::Turn::of(table, whole, &mut rows, (mirrored, rest))?;
    let count = turn.dwells.len();
    Some(TableRows {
        quantity: whole.quantity,
        fill: whole.fill,
        angles: turn.knots.iter().take(count).map(|knot| turn.at + whole.fill * knot).collect(),
        positions: turn.values.iter().take(count).copied().collect(),
        rounding: rows.rounding,
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
    /// What was read otherwise than as it stands, in words.
    pub told: Vec<String>,
}

/// Degrees without the rounding of the conversion.
pub(super) fn degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e6).round() / 1e6 + 0.0
}

impl RowFigures {
    /// Figures in shares of a segment that begins at an angle and has a width (rad) and a travel.
    pub(super) fn of_segment(self, index: usize, range: (f64, f64), travel: f64) -> Self {
        Self { segment: Some(index), ..self.placed(range, travel) }
    }

    /// Figures by shares at an angle and over a width, rad, with positions in a size.
    fn placed(self, (at, width): (f64, f64), size: f64) -> Self {
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

    fn of(table: &TableReader<'_>, rows: &Rows, (quantity, arc): (Quantity, f64)) -> Option<Self> {
        let shape = if table.has(&BETWEEN) { table.get(&BETWEEN)? } else { RowShape::Natural };
        let degree = table.get(&DEGREE)?;
        if degree != 3.0 && degree != 5.0 {
            table.fail(&DEGREE, format!("`degree` cannot be {degree}"), Some("use 5 or 3".into()));
            return None;
        }
        let one = if quantity == Quantity::Angle { (Dimension::Angle, 1.0) } else { (Dimension::Length, arc) };
        let smooth = smoothing(table, &SMOOTH, rows.rounding, &[one]).ok()?;
        let cubic = degree == 3.0;
        if cubic && (smooth.is_some() || shape == RowShape::Monotonic) {
            let other = if smooth.is_some() { "smooth" } else { "shape = \"monotonic\"" };
            let message = format!("degree = 3 and {other} cannot both be given: that curve is of degree 5");
            table.fail(&DEGREE, message, Some("remove `degree`".into()));
            return None;
        }
        Some(Self { shape, cubic, smooth })
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
    (start, lobes): (f64, u32),
    mut rows: Rows,
) -> Option<Program> {
    let wishes = RowWishes::of(table, &rows, whole.typed(table))?;
    let mirrored = table.has(&MIRROR) && table.get(&MIRROR)?;
    let rest = if table.has(&REST) { Some(table.get(&REST)?) } else { None };
    let turn = turn::Turn::of(table, whole, &mut rows, (mirrored, rest))?;
    Some(curve::program(&turn, (start, lobes), whole, &rows, wishes))
}
