//! Tables of points for the control of a grinder or an old mill: a description in lines that begin with `#`, the columns, then
//! plain decimals that read back as the same numbers.

use super::number::{plain, shortest};
use super::{Format, FormatSelection, fits_all, of_outlines};
use crate::analysis::compare::measured::stated_radius;
use crate::body::Body;
use crate::body::points::{PointCurve, PointErrors, PointTable, by_travel, swings};
use crate::machine::Rotation;
use crate::report::AsCutError;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::points::{PointCoordinates, PointInterpolation, PointStep};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use std::borrow::Cow;

/// The points of every section, as they were proved.
pub const FORMAT: Format = Format {
    name: "points",
    when: FormatSelection::Asked,
    flank: false,
    unfit: fits_all,
    endings: |drawn| of_outlines(drawn, "-points.csv"),
    write: |cam| match cam.points {
        [] => Err(Refusal::new("no table of points was requested with the drawing, or the cutter has no path")),
        points => Ok(points.to_vec()),
    },
    of_analysis: None,
};

/// Angles that differ by less are equal, degrees.
const SAME_ANGLE: f64 = 1e-9;
/// Decimals of a number, as in a DXF file.
const DECIMALS: usize = 12;
/// The columns of either form in either unit.
const COLUMNS: [(&str, PointCoordinates, LengthUnit); 4] = [
    ("cam_deg,radius_mm", PointCoordinates::Polar, LengthUnit::Millimetre),
    ("x_mm,y_mm", PointCoordinates::Plane, LengthUnit::Millimetre),
    ("cam_deg,radius_in", PointCoordinates::Polar, LengthUnit::Inch),
    ("x_in,y_in", PointCoordinates::Plane, LengthUnit::Inch),
];
/// Words that the reader looks for.
const INTERPOLATION: &str = "# interpolation: ";
const LINEAR: &str = "linear";
const CUBIC: &str = "cubic";
const CLOSED: &str = "# closed: yes";

/// A table as its file.
#[must_use]
pub fn write(body: &dyn Body, table: &PointTable) -> Vec<u8> {
    let mut text = String::new();
    let (form, units) = (table.wish.form, body.machine().units());
    for statement in statements(body, table, units) {
        text.push_str(&format!("# {statement}\n"));
    }
    let columns = COLUMNS.iter().find(|(_, of_form, of_unit)| (*of_form, *of_unit) == (form, units));
    text.push_str(columns.map_or("", |(columns, _, _)| columns));
    text.push('\n');
    for [first, second] in table.turned(&table.rows.rows) {
        let first = if form == PointCoordinates::Polar { first } else { units.of_mm(first) };
        text.push_str(&format!("{},{}\n", plain(first, DECIMALS), plain(units.of_mm(second), DECIMALS)));
    }
    text.into_bytes()
}

/// The statements in the head of a table in a unit.
#[must_use]
pub fn statements(body: &dyn Body, table: &PointTable, units: LengthUnit) -> Vec<String> {
    head(body, table, units).into_iter().map(|(key, value)| format!("{key}: {value}")).collect()
}

fn head(body: &dyn Body, table: &PointTable, units: LengthUnit) -> Vec<(Cow<'static, str>, String)> {
    let (wish, rows) = (&table.wish, &table.rows);
    let speed =
        table.rpm.map_or_else(|| body.speeds().to_string(), |rpm| format!(", section for {} rpm", shortest(rpm)));
    let unit = if units == LengthUnit::Inch { "inches" } else { "mm" };
    let mut head: Vec<(Cow<'static, str>, String)> = vec![
        ("machine".into(), body.machine().name().to_owned()),
        ("cam".into(), format!("{}{speed}", body.kind().noun)),
        ("given".into(), given(table, units)),
        ("units".into(), format!("{unit}, degrees")),
        ("coordinates".into(), coordinates(table, units)),
    ];
    if table.closed {
        let turns = match body.machine().cam.rotation {
            Rotation::Clockwise => ("clockwise", "counter-clockwise"),
            Rotation::CounterClockwise => ("counter-clockwise", "clockwise"),
        };
        head.push(("rotation".into(), format!("the cam turns {}", turns.0)));
        head.push(("order".into(), format!("as the follower meets the points, {} round the shaft", turns.1)));
    } else {
        head.push(("order".into(), "along the stroke".to_owned()));
    }
    let closed = if table.closed { "yes, the last row is the first point again" } else { "no" };
    let corners = match (rows.corners, wish.between) {
        (0, _) => "none".to_owned(),
        (count, PointInterpolation::Linear) => format!("{count}, each at a row of its own"),
        (count, PointInterpolation::Cubic) => {
            format!("{count}, each a row that stands twice: one spline ends and the next begins")
        }
    };
    if rows.jumps > 0 {
        let words = "each a row that stands twice: one spline ends where the acceleration jumps and the next begins; the \
                     velocity steps there by at most twice its error";
        head.push(("jumps".into(), format!("{}, {words}", rows.jumps)));
    }
    head.extend([
        ("points".into(), points(table)),
        ("interpolation".into(), interpolation(table)),
        ("closed".into(), closed.to_owned()),
        ("corners".into(), corners),
        number("tolerance_mm", wish.tolerance, units),
        number("error_mm", rows.error, units),
        (
            "error".into(),
            "bound of the distance between the interpolated curve and the exact one, either way".to_owned(),
        ),
    ]);
    head.extend(motion_lines(body, table, units));
    head.push(("rows".into(), rows.rows.len().to_string()));
    head
}

/// A value under the name of its column of millimetres, in a unit.
fn number(name: &'static str, value: f64, units: LengthUnit) -> (Cow<'static, str>, String) {
    let (name, power) = units.column(name);
    (name, plain(units.of_mm_to(value, power), DECIMALS))
}

/// The errors of the follower's motion on the curve that the control makes, and which tolerances are kept.
fn motion_lines(body: &dyn Body, table: &PointTable, units: LengthUnit) -> Vec<(Cow<'static, str>, String)> {
    const KEYS: [[&str; 3]; 4] = [
        ["velocity_tolerance_mm_per_rad", "velocity_tolerance_rad_per_rad", "velocity_tolerance_mm_per_mm"],
        ["velocity_error_mm_per_rad", "velocity_error_rad_per_rad", "velocity_error_mm_per_mm"],
        [
            "acceleration_tolerance_mm_per_rad2",
            "acceleration_tolerance_rad_per_rad2",
            "acceleration_tolerance_mm_per_mm2",
        ],
        ["acceleration_error_mm_per_rad2", "acceleration_error_rad_per_rad2", "acceleration_error_mm_per_mm2"],
    ];
    let (swings, by_travel) = (swings(body), by_travel(body));
    let keys = KEYS.map(|[straight, swung, travelled]| match (swings, by_travel) {
        (true, _) => swung,
        (false, true) => travelled,
        (false, false) => straight,
    });
    let [of_velocity, of_acceleration] = AsCutError::sizes(swings, by_travel);
    let mut head = Vec::new();
    let errors = match table.errors {
        PointErrors::Known(errors) => errors,
        PointErrors::Unknown(why) => {
            head.push(("felt".into(), format!("velocity and acceleration are not known: {why}")));
            [f64::INFINITY; 2]
        }
    };
    let values = [
        of_velocity * table.allowed[0],
        of_velocity * errors[0],
        of_acceleration * table.allowed[1],
        of_acceleration * errors[1],
    ];
    let rows = keys.iter().zip(values).filter(|(_, value)| value.is_finite());
    head.extend(rows.map(|(key, value)| number(key, value, units)));
    if matches!(table.errors, PointErrors::Known(_)) {
        let how = if body.surface().is_some() && table.curve == PointCurve::Profile {
            ", to first order, at five places of every interval"
        } else {
            ""
        };
        let what = match table.wish.between {
            PointInterpolation::Linear => "largest error of the follower's velocity",
            PointInterpolation::Cubic => "largest errors of the follower's velocity and acceleration",
        };
        let by = match (table.closed, by_travel) {
            (true, _) => "angle of the cam",
            (false, true) => "travel of the plate",
            (false, false) => "angle of the crank",
        };
        head.push((
            "felt".into(),
            format!("{what} on the interpolated curve by the {by}{wheel}{how}", wheel = wheel(table)),
        ));
    }
    head.extend(kept(table, errors));
    head
}

/// The radius of the wheel for which the errors of motion hold.
fn wheel(table: &PointTable) -> &'static str {
    match table.curve {
        PointCurve::Profile => "",
        PointCurve::Centre => ", ground by a wheel as large as the roller",
        PointCurve::Cutter => ", ground by that wheel",
    }
}

/// Which tolerances are kept, and which are not.
fn kept(table: &PointTable, errors: [f64; 2]) -> Vec<(Cow<'static, str>, String)> {
    let names = ["velocity", "acceleration"];
    let limited =
        || names.iter().zip(table.allowed.iter().zip(&errors)).filter(|(_, (allowed, _))| allowed.is_finite());
    let list =
        |keeps: bool| limited().filter(move |(_, (allowed, error))| (error <= allowed) == keeps).map(|(name, _)| *name);
    let mut head = vec![("keeps".into(), std::iter::once("distance").chain(list(true)).collect::<Vec<_>>().join(", "))];
    if table.wish.between == PointInterpolation::Linear {
        let words =
            "acceleration: a control that goes straight from row to row turns at each, and the velocity jumps there";
        head.push((
            "not_kept".into(),
            list(false).filter(|name| *name == "velocity").chain([words]).collect::<Vec<_>>().join(", "),
        ));
    } else if list(false).next().is_some() {
        head.push(("not_kept".into(), list(false).collect::<Vec<_>>().join(", ")));
    }
    head
}

fn given(table: &PointTable, units: LengthUnit) -> String {
    let radius = table.radius.map_or_else(String::new, |radius| {
        format!(" of radius {} {}", plain(units.of_mm(MILLIMETRES * radius), DECIMALS), units.symbol())
    });
    // The lower flank of a plate with two is not written.
    let of_two = table.flipped;
    match (table.curve, table.closed) {
        (PointCurve::Profile, true) => "profile of the cam".to_owned(),
        (PointCurve::Profile, false) if !of_two => "flank of the plate".to_owned(),
        (PointCurve::Centre, false) if !of_two => format!("path of the centre of the roller on the plate{radius}"),
        (PointCurve::Profile, false) => "upper flank of the plate; the lower is its mirror image, y negated".to_owned(),
        (PointCurve::Centre, true) => format!("path of the centre of the roller{radius}"),
        (PointCurve::Centre, false) => {
            format!("path of the centre of the upper roller{radius}; the lower is its mirror image, y negated")
        }
        (PointCurve::Cutter, _) => format!("path of the centre of a cutter or wheel{radius}"),
    }
}

fn coordinates(table: &PointTable, units: LengthUnit) -> String {
    let words = match (table.wish.form, table.closed) {
        (PointCoordinates::Polar, _) => {
            "polar; cam_deg is the angle of the point about the shaft from the X axis of the drawing, against the rotation of the \
             cam, radius_mm its distance from the shaft"
        }
        (PointCoordinates::Plane, true) => "x and y of the drawing, the shaft at the origin",
        (PointCoordinates::Plane, false) if table.flipped => "x and y of the drawing, X the axis of the bed",
        (PointCoordinates::Plane, false) => {
            "x and y of the drawing, X along the travel of the plate, the roller's centre at the origin at travel 0 and lift 0"
        }
    };
    words.replace("radius_mm", &units.column("radius_mm").0)
}

fn points(table: &PointTable) -> String {
    let intervals = table.rows.intervals;
    match table.wish.step {
        PointStep::Angle if table.rows.corners > 0 => {
            format!("{intervals} intervals at equal angles, cut at the corners")
        }
        PointStep::Angle => format!("{intervals} intervals at equal angles about the shaft"),
        PointStep::Chord => format!("{intervals} intervals of equal error"),
    }
}

fn interpolation(table: &PointTable) -> String {
    let ends = match (table.closed, table.rows.corners + table.rows.jumps) {
        (true, 0) => "periodic, continuous in its second derivative",
        (true, _) => "not-a-knot at both ends and at rows that stand twice",
        (false, _) => "not-a-knot at its ends and at rows that stand twice",
    };
    match (table.wish.between, table.wish.form) {
        (PointInterpolation::Linear, PointCoordinates::Polar) => {
            format!("{LINEAR}, radius linear in the angle between two rows")
        }
        (PointInterpolation::Linear, PointCoordinates::Plane) => format!("{LINEAR}, a straight line between two rows"),
        (PointInterpolation::Cubic, PointCoordinates::Polar) => {
            format!("{CUBIC}, the cubic spline of the radius over the angle, {ends}")
        }
        (PointInterpolation::Cubic, PointCoordinates::Plane) => {
            format!(
                "{CUBIC}, the cubic splines of x and of y over the sum of the chord lengths from row to row, {ends}"
            )
        }
    }
}

/// What the head of a file says of the curve and its places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedCurve {
    /// The curve.
    pub curve: PointCurve,
    /// Radius of the cutter whose centre it gives, m, where it is stated.
    pub cutter: Option<f64>,
    /// How its places were chosen.
    pub step: PointStep,
}

/// Whether bytes are those of a table of points, by the line that names its columns.
#[must_use]
pub fn is_points(bytes: &[u8]) -> bool {
    let columns = |line: &[u8]| COLUMNS.iter().any(|(columns, _, _)| columns.as_bytes() == line.trim_ascii_end());
    let mut lines = bytes.split(|byte| *byte == b'\n').skip_while(|line| line.starts_with(b"#"));
    lines.next().is_some_and(columns)
}

/// What the head of a file says; without a word it is the profile at equal angles.
#[must_use]
pub fn stated(bytes: &[u8]) -> StatedCurve {
    let text = String::from_utf8_lossy(bytes);
    let line = |key: &str| {
        let mut lines = text.lines().take_while(|line| line.starts_with('#'));
        lines.find_map(|line| line.strip_prefix("# ")?.strip_prefix(key)?.strip_prefix(": ")).unwrap_or_default()
    };
    let given = line("given");
    let curve = match given {
        _ if given.contains("cutter") => PointCurve::Cutter,
        _ if given.contains("roller") => PointCurve::Centre,
        _ => PointCurve::Profile,
    };
    let radius = stated_radius(given);
    let cutter = radius.filter(|_| curve == PointCurve::Cutter).map(|radius| radius / MILLIMETRES);
    let step = if line("points").contains("equal error") { PointStep::Chord } else { PointStep::Angle };
    StatedCurve { curve, cutter, step }
}

/// A table as a control reads it from a file, in millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadPoints {
    /// Its coordinates, by the names of its columns.
    pub form: PointCoordinates,
    /// The unit of the file, from its column names; the rows are in millimetres.
    pub units: LengthUnit,
    /// Its interpolation, by its head.
    pub between: PointInterpolation,
    /// Whether it closes, by its head.
    pub closed: bool,
    /// Its rows.
    pub rows: Vec<[f64; 2]>,
}

/// The table of a file.
///
/// # Errors
/// A sentence when the file is not a table of points.
pub fn read(bytes: &[u8]) -> Result<ReadPoints, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let (mut between, mut closed, mut head, mut rows) = (None, false, None, Vec::new());
    for line in text.lines() {
        if let Some(words) = line.strip_prefix(INTERPOLATION) {
            between = match words.split(',').next() {
                Some(LINEAR) => Some(PointInterpolation::Linear),
                Some(CUBIC) => Some(PointInterpolation::Cubic),
                _ => None,
            };
        }
        closed |= line.starts_with(CLOSED);
        match line {
            _ if line.starts_with('#') => {}
            line if COLUMNS.iter().any(|(columns, _, _)| *columns == line) => {
                head = COLUMNS.iter().find(|(columns, _, _)| *columns == line).map(|(_, form, unit)| (*form, *unit));
            }
            row => {
                let numbers = row.split_once(',').map(|(first, second)| (first.parse(), second.parse()));
                let Some((Ok(first), Ok(second))) = numbers else {
                    return Err(format!("`{row}` is not a row of two numbers"));
                };
                rows.push([first, second]);
            }
        }
    }
    match (head, between) {
        (Some((form, unit)), Some(between)) => {
            let first = if form == PointCoordinates::Polar { 1.0 } else { unit.millimetres() };
            let rows = rows.into_iter().map(|[a, b]: [f64; 2]| [first * a, unit.millimetres() * b]).collect();
            Ok(ReadPoints { form, units: unit, between, closed, rows })
        }
        (None, _) => Err("the line that names the columns is missing".into()),
        (_, None) => Err("the interpolation is not stated".into()),
    }
}

impl ReadPoints {
    /// Whether the angles of a polar table grow from row to row, and go once round where it is closed.
    ///
    /// # Errors
    /// A sentence with the row or the range of angles, degrees.
    pub fn goes_round(&self) -> Result<(), String> {
        if self.form != PointCoordinates::Polar {
            return Ok(());
        }
        let falls = self.rows.windows(2).position(|pair| matches!(pair, [[before, _], [next, _]] if !(next >= before)));
        if let Some((at, [angle, _])) = falls.and_then(|at| Some((at, self.rows.get(at + 1)?))) {
            return Err(format!("row {} is at {angle} degrees, which is less than that of the row before it", at + 2));
        }
        let (Some([first, _]), Some([last, _])) = (self.rows.first(), self.rows.last()) else { return Ok(()) };
        if self.closed && (last - first - 360.0).abs() > SAME_ANGLE {
            return Err(format!("the rows go from {first} to {last} degrees, which is not once round the shaft"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_table_is_refused() {
        let good = "# interpolation: cubic, whatever\n# closed: yes, so\nx_mm,y_mm\n1.0,-2.5\n";
        let table = ReadPoints {
            form: PointCoordinates::Plane,
            units: LengthUnit::Millimetre,
            between: PointInterpolation::Cubic,
            closed: true,
            rows: vec![[1.0, -2.5]],
        };
        assert_eq!(read(good.as_bytes()), Ok(table));
        let inches = read(good.replace("_mm", "_in").as_bytes()).expect("a table in inches");
        assert_eq!((inches.form, inches.rows), (PointCoordinates::Plane, vec![[25.4, -63.5]]));
        assert!(read(good.replace("y_mm", "y_in").as_bytes()).is_err(), "two units");
        assert!(read(good.replace("cubic", "quintic").as_bytes()).is_err_and(|why| why.contains("interpolation")));
        assert!(read(good.replace("x_mm", "u_mm").as_bytes()).is_err_and(|why| why.contains("is not a row")));
        assert!(read(good.replace("-2.5", "").as_bytes()).is_err_and(|why| why.contains("1.0,")));
        assert!(read(b"# interpolation: linear, x\n").is_err_and(|why| why.contains("columns")));
        assert!(read(&[0xff, 0xfe]).is_err());
    }

    #[test]
    fn polar_angles_grow_over_the_whole_turn() {
        let read_turn = |last: &str| {
            let head = "# interpolation: linear, so\n# closed: yes, so\ncam_deg,radius_mm\n";
            let table = format!("{head}12.0,17.0\n130.0,18.0\n130.0,18.0\n250.0,17.0\n{last},17.0\n");
            read(table.as_bytes()).and_then(|read| read.goes_round())
        };
        assert!(read_turn("372.0").is_ok());
        for (last, part) in
            [("12.0", "row 5 is at 12"), ("-348.0", "row 5 is at -348"), ("360.0", "12 to 360"), ("732.0", "12 to 732")]
        {
            assert!(read_turn(last).is_err_and(|why| why.contains(part)), "{last}: {:?}", read_turn(last));
        }
    }
}
