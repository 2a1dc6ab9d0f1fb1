//! Tables of points for the control of a grinder or an old mill: a description in lines that begin with `#`, the columns, then
//! plain decimals that read back as the same numbers.

use super::plan::{PointErrors, PointTable, by_travel, swings};
use super::read::{COLUMNS, CUBIC, LINEAR};
use crate::body::{Body, PointCurve};
use crate::machine::Rotation;
use crate::report::AsCutError;
use crate::write::number::{plain, shortest};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::points::{PointCoordinates, PointInterpolation, PointStep};
use camgen_kernel::units::LengthUnit;
use std::borrow::Cow;

/// Decimals of a number, as in a DXF file.
const DECIMALS: usize = 12;
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
pub(super) fn statements(body: &dyn Body, table: &PointTable, units: LengthUnit) -> Vec<String> {
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
