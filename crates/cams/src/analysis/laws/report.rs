//! The report on every law: columns, text and picture.

use super::{LawRow, Rise, mm};
use crate::report::ReportLine;
use crate::report::plot::{Plot, PlotCurve, PlotPanel};
use crate::report::{Section, shown};
use crate::table::Table;
use camgen_kernel::motion::Quantity;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, text};
use camgen_kernel::units;
use serde::Serialize;

type LawColumn = (&'static str, fn(&LawRow) -> f64);

/// The order of a derivative at the segment's numbers, by the cam angle: its coefficient times lift over angle to the power.
fn by_angle(row: &LawRow, order: usize) -> f64 {
    let coefficient = row.coefficients.get(order - 1).copied().unwrap_or(f64::NAN);
    let power = i32::try_from(order).unwrap_or(0);
    coefficient * row.rise.lift / row.rise.over.powi(power)
}

/// The order of a derivative at the numbers of the segment, by time.
fn by_time(row: &LawRow, order: usize) -> f64 {
    let power = i32::try_from(order).unwrap_or(0);
    row.rise.speed.map_or(f64::NAN, |speed| by_angle(row, order) * speed.powi(power))
}

fn coefficient(row: &LawRow, index: usize) -> f64 {
    row.coefficients.get(index).copied().unwrap_or(f64::NAN)
}

/// The root of the mean square of the acceleration, by the time.
fn rms(row: &LawRow) -> f64 {
    let scale = row.rise.speed.map_or(f64::NAN, |speed| speed * speed / (row.rise.over * row.rise.over));
    coefficient(row, 4).sqrt() * row.rise.lift * scale
}

/// Of a lift in metres, in millimetres; of a swing, as it is.
fn in_mm(row: &LawRow, value: f64) -> f64 {
    if row.rise.quantity == Quantity::Length { mm(value) } else { value }
}

fn of_cam(row: &LawRow, value: fn(&super::LawCamFigures) -> f64) -> f64 {
    row.cam.as_ref().map_or(f64::NAN, value)
}

fn harmonic(row: &LawRow, order: usize) -> f64 {
    let wave = row.cam.as_ref().and_then(|cam| cam.harmonics.get(order - 1)).copied().unwrap_or(f64::NAN);
    if row.rise.quantity == Quantity::Length { mm(wave) } else { wave.to_degrees() }
}

const SHAPE: [LawColumn; 7] = [
    ("continuity", |row| f64::from(row.law.continuity)),
    ("cv", |row| coefficient(row, 0)),
    ("ca", |row| coefficient(row, 1)),
    ("cj", |row| coefficient(row, 2)),
    ("c_va", |row| coefficient(row, 3)),
    ("mean_square_acceleration", |row| coefficient(row, 4)),
    ("efficiency", |row| row.efficiency),
];
const OF_LENGTH: [LawColumn; 7] = [
    ("velocity_mm_per_rad", |row| in_mm(row, by_angle(row, 1))),
    ("acceleration_mm_per_rad2", |row| in_mm(row, by_angle(row, 2))),
    ("jerk_mm_per_rad3", |row| in_mm(row, by_angle(row, 3))),
    ("velocity_m_per_s", |row| by_time(row, 1)),
    ("acceleration_m_per_s2", |row| by_time(row, 2)),
    ("jerk_m_per_s3", |row| by_time(row, 3)),
    ("rms_acceleration_m_per_s2", rms),
];
const OF_ANGLE: [LawColumn; 7] = [
    ("velocity_rad_per_rad", |row| by_angle(row, 1)),
    ("acceleration_rad_per_rad2", |row| by_angle(row, 2)),
    ("jerk_rad_per_rad3", |row| by_angle(row, 3)),
    ("velocity_rad_per_s", |row| by_time(row, 1)),
    ("acceleration_rad_per_s2", |row| by_time(row, 2)),
    ("jerk_rad_per_s3", |row| by_time(row, 3)),
    ("rms_acceleration_rad_per_s2", rms),
];
const OF_CAM: [LawColumn; 9] = [
    ("pressure_angle_deg", |row| of_cam(row, |cam| cam.pressure_angle.to_degrees())),
    ("min_convex_radius_mm", |row| of_cam(row, |cam| mm(cam.convex_radius))),
    ("prime_radius_mm", |row| of_cam(row, |cam| mm(cam.prime_radius))),
    ("smallest_prime_radius_mm", |row| of_cam(row, |cam| mm(cam.smallest_prime_radius))),
    ("contact_force_n", |row| of_cam(row, |cam| cam.contact_force)),
    ("torque_nm", |row| of_cam(row, |cam| cam.torque)),
    ("jump_rpm", |row| of_cam(row, |cam| units::rpm(cam.jump))),
    ("residual", |row| row.residual[0]),
    ("residual_worst", |row| row.residual[1]),
];
const HARMONICS_MM: [LawColumn; 8] = [
    ("harmonic_1_mm", |row| harmonic(row, 1)),
    ("harmonic_2_mm", |row| harmonic(row, 2)),
    ("harmonic_3_mm", |row| harmonic(row, 3)),
    ("harmonic_4_mm", |row| harmonic(row, 4)),
    ("harmonic_5_mm", |row| harmonic(row, 5)),
    ("harmonic_6_mm", |row| harmonic(row, 6)),
    ("harmonic_7_mm", |row| harmonic(row, 7)),
    ("harmonic_8_mm", |row| harmonic(row, 8)),
];
const HARMONICS_DEG: [LawColumn; 8] = [
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
fn columns(rows: &[LawRow]) -> Vec<LawColumn> {
    let swings = rows.first().is_some_and(|row| row.rise.quantity == Quantity::Angle);
    let (rates, waves) = if swings { (&OF_ANGLE, &HARMONICS_DEG) } else { (&OF_LENGTH, &HARMONICS_MM) };
    let all = SHAPE.iter().chain(rates).chain(&OF_CAM).chain(waves);
    all.filter(|(_, value)| rows.iter().any(|row| !value(row).is_nan())).copied().collect()
}

/// Sorts by a column, the least value first and what is not known last; by the peak acceleration when none is named, laws whose
/// acceleration jumps after the others. Returns its name.
pub(super) fn sort(rows: &mut [LawRow], by: Option<&str>) -> Result<&'static str, Refusal> {
    const USUAL: &str = "ca";
    let columns = columns(rows);
    let wanted = by.unwrap_or(USUAL);
    let exact = columns.iter().find(|(name, _)| name.eq_ignore_ascii_case(wanted));
    let begins = || columns.iter().find(|(name, _)| name.starts_with(&wanted.to_ascii_lowercase()));
    let Some((name, value)) = exact.or_else(begins) else {
        let known: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
        let known = known.join(", ");
        return Err(
            Refusal::new(format!("there is no column `{wanted}` to sort by")).remedy(format!("use one of {known}"))
        );
    };
    let key = |row: &LawRow| {
        let value = value(row);
        let jumps = by.is_none() && coefficient(row, 2).is_infinite();
        if value.is_nan() { (true, jumps, 0.0) } else { (false, jumps, value) }
    };
    rows.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
    });
    Ok(name)
}

pub(super) fn table(rows: &[LawRow]) -> Table {
    let words = Some(("law", rows.iter().map(|row| row.law.name.to_owned()).collect()));
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

/// Headings of the words, the columns below them, and what they mean.
const SHOWN: [(&str, &str, &str); 14] = [
    ("C", "continuity", "derivatives without a jump between rests: 1 velocity, 2 acceleration, 3 jerk"),
    ("Cv", "cv", "peak velocity over lift/angle"),
    ("Ca", "ca", "peak acceleration over lift/angle²; ∞ where the velocity jumps"),
    ("Cj", "cj", "peak jerk over lift/angle³; ∞ where the acceleration jumps"),
    ("C(va)", "c_va", "peak of velocity times acceleration over lift²/angle³: the torque of inertia"),
    ("η", "efficiency", "least peak acceleration that is possible with this peak jerk, over that of the law"),
    ("v", "velocity_", "peak velocity"),
    ("a", "acceleration_", "peak acceleration"),
    ("α/°", "pressure_angle_deg", "largest pressure angle of the cam with this law"),
    ("ρ/mm", "min_convex_radius_mm", "smallest convex radius of the follower's curve, the pitch curve of a roller"),
    ("Rp/mm", "smallest_prime_radius_mm", "smallest prime radius that keeps every limit"),
    ("N/N", "contact_force_n", "largest force along the normal"),
    ("T/N·m", "torque_nm", "largest torque of the shaft"),
    ("jump/rpm", "jump_rpm", "speed from which the follower leaves the cam"),
];

pub(super) fn section(rows: &[LawRow], rise: Rise, with_file: bool) -> Section {
    let columns = columns(rows);
    let of_law = |row: &LawRow| {
        let mut object = serde_json::Map::new();
        object.insert("law".into(), row.law.name.into());
        for (name, value) in &columns {
            // JSON has no infinity: what jumps is null.
            object.insert((*name).into(), value(row).into());
        }
        serde_json::Value::Object(object)
    };
    let length = rise.quantity == Quantity::Length;
    let laws = Laws {
        over_deg: rise.over.to_degrees(),
        lift_mm: length.then(|| mm(rise.lift)),
        lift_deg: (!length).then(|| rise.lift.to_degrees()),
        periods: rise.periods,
        laws: rows.iter().map(of_law).collect(),
    };
    Section::new("laws", &laws).with_words(words(rows, rise, with_file, &columns))
}

fn words(rows: &[LawRow], rise: Rise, with_file: bool, known: &[LawColumn]) -> Vec<ReportLine> {
    let length = rise.quantity == Quantity::Length;
    let lift: camgen_kernel::text::Value =
        if length { Length::mm(mm(rise.lift)).into() } else { format!("{}°", shown(rise.lift.to_degrees())).into() };
    let by_time = rise.speed.is_some();
    let units = match (length, by_time) {
        (true, true) => "v in m/s, a in m/s²",
        (true, false) => "v in mm/rad, a in mm/rad²",
        (false, true) => "v in rad/s, a in rad/s²",
        (false, false) => "v in rad/rad, a in rad/rad²",
    };
    let mut lines: Vec<ReportLine> =
        vec![text!("{} in {}° of the cam; {}", lift, shown(rise.over.to_degrees()), units).into()];
    // Of both units of a rate the later column, by the time, where there is a speed.
    let found = |begins: &str| known.iter().rfind(|(name, _)| name.starts_with(begins)).copied();
    let chosen: Vec<(&str, LawColumn, &str)> = SHOWN
        .iter()
        .filter_map(|(head, begins, meaning)| {
            let rate = begins.ends_with('_');
            let column = if rate || known.iter().all(|(name, _)| name != begins) {
                found(begins).filter(|_| rate)
            } else {
                known.iter().find(|(name, _)| name == begins).copied()
            };
            Some((*head, column?, *meaning))
        })
        .collect();
    let heads: Vec<String> = chosen.iter().map(|(head, ..)| format!("{head:>9}")).collect();
    lines.push(ReportLine::row(format!("{:<21}{}", "law", heads.join(""))));
    lines.extend(rows.iter().map(|row| {
        let values: Vec<String> =
            chosen.iter().map(|(_, (_, value), _)| format!("{:>9}", figure(value(row)))).collect();
        ReportLine::row(format!("{:<21}{}", row.law.name, values.join("")))
    }));
    lines.extend(chosen.iter().map(|(head, _, meaning)| ReportLine::row(format!("{head:<9}{meaning}"))));
    if !with_file {
        lines.push(
            "with the file of a motion program, pressure angle, size, forces, jump speed, vibration and harmonics are given too"
                .into(),
        );
    }
    lines
}

/// At most five digits.
fn figure(value: f64) -> String {
    if value.is_nan() {
        "–".into()
    } else if value.is_infinite() {
        "∞".into()
    } else if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        shown(value)
    } else {
        let decimals = (0..4).find(|decimals| value.abs() >= 10.0_f64.powi(3 - *decimals)).unwrap_or(4);
        let decimals = usize::try_from(decimals).unwrap_or(0);
        // A whole number but for rounding is shown as one.
        if (value - value.round()).abs() <= 1e-9 * value.abs() {
            format!("{value:.0}")
        } else {
            format!("{value:.decimals$}")
        }
    }
}

/// Most laws that are drawn, and places of each of their parts.
const DRAWN: usize = 8;
const PLACES: u32 = 72;

pub(super) fn plot(name: &str, rows: &[LawRow], rise: Rise) -> Plot {
    let over = rise.over.to_degrees();
    let curve = |colour: usize, row: &LawRow, order: usize| {
        let points = (0..row.curve.parts()).flat_map(|part| {
            let (low, high) = row.curve.range_of(part);
            (0..=PLACES).map(move |place| {
                let x = low + (high - low) * f64::from(place) / f64::from(PLACES);
                let value = row.curve.values_at(part, x).get(order).copied().unwrap_or(0.0);
                [over * x, value]
            })
        });
        PlotCurve { name: row.law.name.into(), colour, bold: false, points: points.collect() }
    };
    let panel = |name: &str, order: usize| PlotPanel {
        name: name.into(),
        curves: rows.iter().take(DRAWN).enumerate().map(|(colour, row)| curve(colour, row, order)).collect(),
    };
    let which = match rows.len() {
        1 => "one law".to_owned(),
        all if all > DRAWN => format!("the first {DRAWN} of {all} laws"),
        all => format!("{all} laws"),
    };
    Plot {
        title: format!("{name}: {which}"),
        places: "cam angle, degrees".into(),
        panels: vec![
            panel("Lift over the travel h", 0),
            panel("Velocity over h/β, β the angle of the segment: its peak is Cv", 1),
            panel("Acceleration over h/β²: its peak is Ca", 2),
            panel("Jerk over h/β³: its peak is Cj", 3),
        ],
        ..Plot::default()
    }
}
