//! What is told of every law: columns, words, the picture.

use super::{LawsError, Rise, Row, mm};
use crate::motion::Quantity;
use crate::report::plot::{Curve, Panel, Plot};
use crate::report::{Section, shown};
use crate::table::Table;
use serde::Serialize;
use std::f64::consts::TAU;

type Column = (&'static str, fn(&Row) -> f64);

/// The order of a derivative at the segment's numbers, by the cam angle: its coefficient times lift over angle to the power.
fn by_angle(row: &Row, order: usize) -> f64 {
    let coefficient = row.coefficients.get(order - 1).copied().unwrap_or(f64::NAN);
    let power = i32::try_from(order).unwrap_or(0);
    coefficient * row.rise.lift / row.rise.over.powi(power)
}

/// The same by the time.
fn by_time(row: &Row, order: usize) -> f64 {
    let power = i32::try_from(order).unwrap_or(0);
    row.rise.speed.map_or(f64::NAN, |speed| by_angle(row, order) * speed.powi(power))
}

fn coefficient(row: &Row, index: usize) -> f64 {
    row.coefficients.get(index).copied().unwrap_or(f64::NAN)
}

/// The root of the mean square of the acceleration, by the time.
fn rms(row: &Row) -> f64 {
    let scale = row.rise.speed.map_or(f64::NAN, |speed| speed * speed / (row.rise.over * row.rise.over));
    coefficient(row, 4).sqrt() * row.rise.lift * scale
}

/// Of a lift in metres, in millimetres; of a swing, as it is.
fn in_mm(row: &Row, value: f64) -> f64 {
    if row.rise.quantity == Quantity::Length { mm(value) } else { value }
}

fn of_cam(row: &Row, value: fn(&super::OfCam) -> f64) -> f64 {
    row.cam.as_ref().map_or(f64::NAN, value)
}

fn harmonic(row: &Row, order: usize) -> f64 {
    let wave = row.cam.as_ref().and_then(|cam| cam.harmonics.get(order - 1)).copied().unwrap_or(f64::NAN);
    if row.rise.quantity == Quantity::Length { mm(wave) } else { wave.to_degrees() }
}

const SHAPE: [Column; 7] = [
    ("continuity", |row| f64::from(row.law.continuity)),
    ("cv", |row| coefficient(row, 0)),
    ("ca", |row| coefficient(row, 1)),
    ("cj", |row| coefficient(row, 2)),
    ("c_va", |row| coefficient(row, 3)),
    ("mean_square_acceleration", |row| coefficient(row, 4)),
    ("efficiency", |row| row.efficiency),
];
const OF_LENGTH: [Column; 7] = [
    ("velocity_mm_per_rad", |row| in_mm(row, by_angle(row, 1))),
    ("acceleration_mm_per_rad2", |row| in_mm(row, by_angle(row, 2))),
    ("jerk_mm_per_rad3", |row| in_mm(row, by_angle(row, 3))),
    ("velocity_m_per_s", |row| by_time(row, 1)),
    ("acceleration_m_per_s2", |row| by_time(row, 2)),
    ("jerk_m_per_s3", |row| by_time(row, 3)),
    ("rms_acceleration_m_per_s2", rms),
];
const OF_ANGLE: [Column; 7] = [
    ("velocity_rad_per_rad", |row| by_angle(row, 1)),
    ("acceleration_rad_per_rad2", |row| by_angle(row, 2)),
    ("jerk_rad_per_rad3", |row| by_angle(row, 3)),
    ("velocity_rad_per_s", |row| by_time(row, 1)),
    ("acceleration_rad_per_s2", |row| by_time(row, 2)),
    ("jerk_rad_per_s3", |row| by_time(row, 3)),
    ("rms_acceleration_rad_per_s2", rms),
];
const OF_CAM: [Column; 9] = [
    ("pressure_angle_deg", |row| of_cam(row, |cam| cam.pressure_angle.to_degrees())),
    ("min_convex_radius_mm", |row| of_cam(row, |cam| mm(cam.convex_radius))),
    ("prime_radius_mm", |row| of_cam(row, |cam| mm(cam.prime_radius))),
    ("smallest_prime_radius_mm", |row| of_cam(row, |cam| mm(cam.smallest_prime_radius))),
    ("contact_force_n", |row| of_cam(row, |cam| cam.contact_force)),
    ("torque_nm", |row| of_cam(row, |cam| cam.torque)),
    ("jump_rpm", |row| of_cam(row, |cam| 60.0 * cam.jump / TAU)),
    ("residual", |row| row.residual[0]),
    ("residual_worst", |row| row.residual[1]),
];
const HARMONICS_MM: [Column; 8] = [
    ("harmonic_1_mm", |row| harmonic(row, 1)),
    ("harmonic_2_mm", |row| harmonic(row, 2)),
    ("harmonic_3_mm", |row| harmonic(row, 3)),
    ("harmonic_4_mm", |row| harmonic(row, 4)),
    ("harmonic_5_mm", |row| harmonic(row, 5)),
    ("harmonic_6_mm", |row| harmonic(row, 6)),
    ("harmonic_7_mm", |row| harmonic(row, 7)),
    ("harmonic_8_mm", |row| harmonic(row, 8)),
];
const HARMONICS_DEG: [Column; 8] = [
    ("harmonic_1_deg", |row| harmonic(row, 1)),
    ("harmonic_2_deg", |row| harmonic(row, 2)),
    ("harmonic_3_deg", |row| harmonic(row, 3)),
    ("harmonic_4_deg", |row| harmonic(row, 4)),
    ("harmonic_5_deg", |row| harmonic(row, 5)),
    ("harmonic_6_deg", |row| harmonic(row, 6)),
    ("harmonic_7_deg", |row| harmonic(row, 7)),
    ("harmonic_8_deg", |row| harmonic(row, 8)),
];

/// The columns of which some law knows a value.
fn columns(rows: &[Row]) -> Vec<Column> {
    let swings = rows.first().is_some_and(|row| row.rise.quantity == Quantity::Angle);
    let (rates, waves) = if swings { (&OF_ANGLE, &HARMONICS_DEG) } else { (&OF_LENGTH, &HARMONICS_MM) };
    let all = SHAPE.iter().chain(rates).chain(&OF_CAM).chain(waves);
    all.filter(|(_, value)| rows.iter().any(|row| !value(row).is_nan())).copied().collect()
}

/// Sorts by a column, the least value first and what is not known last; by the peak acceleration when none is named. Returns its name.
pub(super) fn sort(rows: &mut [Row], by: Option<&str>) -> Result<&'static str, LawsError> {
    const USUAL: &str = "ca";
    let columns = columns(rows);
    let wanted = by.unwrap_or(USUAL);
    let exact = columns.iter().find(|(name, _)| name.eq_ignore_ascii_case(wanted));
    let begins = || columns.iter().find(|(name, _)| name.starts_with(&wanted.to_ascii_lowercase()));
    let Some((name, value)) = exact.or_else(begins) else {
        let known: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
        return Err(LawsError::NoColumn { found: wanted.to_owned(), known: known.join(", ") });
    };
    let key = |row: &Row| {
        let value = value(row);
        if value.is_nan() { (true, 0.0) } else { (false, value) }
    };
    rows.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Ok(name)
}

pub(super) fn table(rows: &[Row]) -> Table {
    let words = Some(("law", rows.iter().map(|row| row.law.name).collect()));
    Table { words, ..Table::listed(&columns(rows), rows) }
}

/// The section `laws`.
#[derive(Debug, Serialize)]
struct Laws {
    over_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    lift_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lift_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    periods: Option<f64>,
    laws: Vec<serde_json::Value>,
}

/// Headings of the words and the columns below them.
const SHOWN: [(&str, &str); 14] = [
    ("C", "continuity"),
    ("Cv", "cv"),
    ("Ca", "ca"),
    ("Cj", "cj"),
    ("C(va)", "c_va"),
    ("η", "efficiency"),
    ("v", "velocity_"),
    ("a", "acceleration_"),
    ("α/°", "pressure_angle_deg"),
    ("ρ/mm", "min_convex_radius_mm"),
    ("Rp/mm", "smallest_prime_radius_mm"),
    ("N/N", "contact_force_n"),
    ("T/N·m", "torque_nm"),
    ("jump/rpm", "jump_rpm"),
];

pub(super) fn section(rows: &[Row], rise: Rise, with_file: bool) -> Section {
    let columns = columns(rows);
    let of_law = |row: &Row| {
        let mut object = serde_json::Map::new();
        object.insert("law".into(), row.law.name.into());
        for (name, value) in &columns {
            // JSON has no infinity: what jumps is null.
            object.insert((*name).into(), value(row).into());
        }
        serde_json::Value::Object(object)
    };
    let length = rise.quantity == Quantity::Length;
    let told = Laws {
        over_deg: rise.over.to_degrees(),
        lift_mm: length.then(|| mm(rise.lift)),
        lift_deg: (!length).then(|| rise.lift.to_degrees()),
        periods: rise.periods,
        laws: rows.iter().map(of_law).collect(),
    };
    Section::new("laws", &told).with_words(words(rows, rise, with_file, &columns))
}

fn words(rows: &[Row], rise: Rise, with_file: bool, known: &[Column]) -> Vec<String> {
    let length = rise.quantity == Quantity::Length;
    let lift =
        if length { format!("{} mm", shown(mm(rise.lift))) } else { format!("{}°", shown(rise.lift.to_degrees())) };
    let by_time = rise.speed.is_some();
    let units = match (length, by_time) {
        (true, true) => "v in m/s, a in m/s²",
        (true, false) => "v in mm/rad, a in mm/rad²",
        (false, true) => "v in rad/s, a in rad/s²",
        (false, false) => "v in rad/rad, a in rad/rad²",
    };
    let mut lines = vec![format!("{lift} in {}° of the cam; {units}", shown(rise.over.to_degrees()))];
    // Of both units of a rate the later column, by the time, where there is a speed.
    let found = |begins: &str| known.iter().rfind(|(name, _)| name.starts_with(begins)).copied();
    let chosen: Vec<(&str, Column)> = SHOWN
        .iter()
        .filter_map(|(head, begins)| {
            let rate = begins.ends_with('_');
            let column = if rate || known.iter().all(|(name, _)| name != begins) {
                found(begins).filter(|_| rate)
            } else {
                known.iter().find(|(name, _)| name == begins).copied()
            };
            Some((*head, column?))
        })
        .collect();
    let heads: Vec<String> = chosen.iter().map(|(head, _)| format!("{head:>9}")).collect();
    lines.push(format!("{:<21}{}", "law", heads.join("")));
    lines.extend(rows.iter().map(|row| {
        let values: Vec<String> = chosen.iter().map(|(_, (_, value))| format!("{:>9}", figure(value(row)))).collect();
        format!("{:<21}{}", row.law.name, values.join(""))
    }));
    if !with_file {
        lines.push(
            "with the file of a motion program also pressure angle, size, forces, jump speed, vibration and harmonics"
                .into(),
        );
    }
    lines
}

/// Five digits at the most.
fn figure(value: f64) -> String {
    if value.is_nan() {
        "–".into()
    } else if value.is_infinite() {
        "∞".into()
    } else if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        format!("{value:.2e}")
    } else {
        let decimals = (0..4).find(|decimals| value.abs() >= 10.0_f64.powi(3 - *decimals)).unwrap_or(4);
        let decimals = usize::try_from(decimals).unwrap_or(0);
        // A whole number but for rounding is told as one.
        if (value - value.round()).abs() < 1e-9 * value.abs() {
            format!("{value:.0}")
        } else {
            format!("{value:.decimals$}")
        }
    }
}

/// Laws that are drawn, and places of each of their parts.
const DRAWN: usize = 8;
const PLACES: u32 = 72;

pub(super) fn plot(name: &str, rows: &[Row], rise: Rise) -> Plot {
    let over = rise.over.to_degrees();
    let unit = if rise.quantity == Quantity::Length { ("mm", mm(1.0)) } else { ("°", 1.0_f64.to_degrees()) };
    let curve = |colour: usize, row: &Row, order: usize| {
        let scale = rise.lift * unit.1 / rise.over.powi(i32::try_from(order).unwrap_or(0));
        let points = (0..row.curve.parts()).flat_map(|part| {
            let (low, high) = row.curve.range_of(part);
            (0..=PLACES).map(move |place| {
                let x = low + (high - low) * f64::from(place) / f64::from(PLACES);
                let value = row.curve.at(part, x).get(order).copied().unwrap_or(0.0);
                [over * x, scale * value]
            })
        });
        Curve { name: row.law.name.into(), colour, bold: false, points: points.collect() }
    };
    let panel = |name: String, order: usize| Panel {
        name,
        curves: rows.iter().take(DRAWN).enumerate().map(|(colour, row)| curve(colour, row, order)).collect(),
    };
    Plot {
        title: format!("{name}: the first {} of {} laws", rows.len().min(DRAWN), rows.len()),
        places: "cam angle, degrees".into(),
        panels: vec![
            panel(format!("Velocity, {}/rad", unit.0), 1),
            panel(format!("Acceleration, {}/rad²", unit.0), 2),
            panel(format!("Jerk, {}/rad³", unit.0), 3),
        ],
        ..Plot::default()
    }
}
