//! The report on every law: columns, text and picture.

use super::{LawRow, Rise, mm};
use crate::report::ReportLine;
use crate::report::plot::{Plot, PlotCurve, PlotPanel, PlotPoint, SmallPlot, SmallPlots, figure};
use crate::report::{Section, SummaryColumn, SummaryTable, length_cell, number_cell, shown};
use crate::table::Table;
use camgen_kernel::motion::Quantity;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{DIGITS, Length, LengthKind, Text, Value, nominal, text};
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

pub(super) fn section(rows: &[LawRow], rise: Rise, with_file: bool, own: Option<&str>) -> Section {
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
    let section = Section::new("laws", &laws).with_words(words(rows, rise, with_file, &columns));
    section.with_answer(answer(rows, rise, own)).with_table(summary_table(rows, &columns, own))
}

/// The law of the design, or that with the least acceleration, and which has the least torque.
fn answer(rows: &[LawRow], rise: Rise, own: Option<&str>) -> Text {
    let lift: Value = if rise.quantity == Quantity::Length {
        Length::mm(mm(rise.lift)).nominal().into()
    } else {
        format!("{}°", nominal(rise.lift.to_degrees(), DIGITS)).into()
    };
    let smooth = || rows.iter().filter(|row| coefficient(row, 2).is_finite());
    let least = |value: fn(&LawRow) -> f64| {
        smooth().filter(|row| value(row).is_finite()).min_by(|one, other| value(one).total_cmp(&value(other)))
    };
    let mut words = text!("{} laws for a rise of {} in {}°", rows.len(), lift, nominal(rise.over.to_degrees(), DIGITS));
    if let Some(own) = own {
        words = words.and("; ", text!("the design has {}", own));
    }
    if let Some(gentle) = least(|row| coefficient(row, 1)) {
        words = words.and("; ", text!("least acceleration: {}", gentle.law.name));
    }
    if let Some(easy) = least(|row| of_cam(row, |cam| cam.torque)) {
        words = words.and("; ", text!("least torque: {}", easy.law.name));
    }
    words
}

/// Laws of a summary whose acceleration jumps are named in a line.
fn summary_table(rows: &[LawRow], known: &[LawColumn], own: Option<&str>) -> SummaryTable {
    let (smooth, stepped): (Vec<&LawRow>, Vec<&LawRow>) =
        rows.iter().partition(|row| coefficient(row, 2).is_finite() || own == Some(row.law.name));
    let shown = if smooth.is_empty() { rows.iter().collect() } else { smooth };
    let found: Vec<(&(&str, &str, &str), LawColumn)> = SUMMARISED
        .iter()
        .filter_map(|column| Some((column, *known.iter().rfind(|(name, _)| name.starts_with(column.0))?)))
        .collect();
    let mut columns = vec![SummaryColumn::words("law")];
    columns.extend(found.iter().map(|((_, head, unit), (name, _))| {
        let is_length = name.ends_with("_mm");
        let unit = if unit.is_empty() { unit_of_rate(name) } else { unit };
        match LengthKind::of_symbol(unit).filter(|_| is_length) {
            Some(kind) => SummaryColumn::lengths(*head, kind),
            None => SummaryColumn::numbers(*head, unit),
        }
    }));
    let row = |row: &&LawRow| {
        let cells =
            found.iter().map(
                |(_, (name, value))| {
                    if name.ends_with("_mm") { length_cell(value(row)) } else { number_cell(value(row)) }
                },
            );
        std::iter::once(Text::from(row.law.name)).chain(cells).collect()
    };
    let marked = shown.iter().position(|row| own == Some(row.law.name));
    let names: Vec<&str> = stepped.iter().map(|row| row.law.name).collect();
    let rest = if shown.len() == rows.len() || names.is_empty() {
        None
    } else {
        let few = names.iter().take(3).copied().collect::<Vec<_>>().join(", ");
        Some(text!("{} more have a step of acceleration: {} … (-v)", names.len(), few))
    };
    SummaryTable { heads: columns, rows: shown.iter().map(row).collect(), marked, rest }
}

/// The columns of a summary by the beginnings of their names, with their heads and units; the unit of a rate is that of its column.
const SUMMARISED: [(&str, &str, &str); 6] = [
    ("acceleration_", "peak accel.", ""),
    ("torque_nm", "torque", "N·m"),
    ("contact_force_n", "force", "N"),
    ("velocity_", "speed", ""),
    ("smallest_prime_radius_mm", "prime R", "mm"),
    ("jump_rpm", "lifts off", "from rpm"),
];

/// The unit at the end of the name of a column of rates.
fn unit_of_rate(name: &str) -> &'static str {
    const UNITS: [(&str, &str); 8] = [
        ("_m_per_s2", "m/s²"),
        ("_m_per_s", "m/s"),
        ("_rad_per_s2", "rad/s²"),
        ("_rad_per_s", "rad/s"),
        ("_mm_per_rad2", "mm/rad²"),
        ("_mm_per_rad", "mm/rad"),
        ("_rad_per_rad2", "rad/rad²"),
        ("_rad_per_rad", "rad/rad"),
    ];
    UNITS.iter().find(|(ending, _)| name.ends_with(ending)).map_or("", |(_, unit)| unit)
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
        let values: Vec<String> = chosen.iter().map(|(_, (_, value), _)| format!("{:>9}", cell(value(row)))).collect();
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
fn cell(value: f64) -> String {
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

/// Most laws whose curves are drawn in common plots, most small plots, and places of each part of a law.
const IN_COMMON: usize = 4;
const DRAWN: usize = 18;
const PLACES: u32 = 72;

/// The order of a derivative of a law over the segment, over the angle in degrees, times a factor.
fn points(row: &LawRow, over: f64, order: usize, factor: f64) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for part in 0..row.curve.parts() {
        let (low, high) = row.curve.range_of(part);
        for place in 0..=PLACES {
            let x = low + (high - low) * f64::from(place) / f64::from(PLACES);
            let value = row.curve.values_at(part, x).get(order).copied().unwrap_or(0.0);
            points.push([over * x, factor * value]);
        }
    }
    points
}

/// The acceleration in a unit for people: its factor and unit.
fn acceleration(rise: Rise) -> (f64, &'static str) {
    let by_angle = rise.lift / (rise.over * rise.over);
    match (rise.speed, rise.quantity) {
        (Some(speed), Quantity::Length) => (by_angle * speed * speed, "m/s²"),
        (Some(speed), Quantity::Angle) => (by_angle * speed * speed, "rad/s²"),
        (None, _) => (1.0, "h/β²"),
    }
}

fn torque(row: &LawRow) -> f64 {
    of_cam(row, |cam| cam.torque)
}

/// Which law has what a designer looks for, with its figures; `own` is the law of the design.
fn headline(rows: &[LawRow], own: Option<&LawRow>, (factor, unit): (f64, &str)) -> String {
    let peak = |row: &LawRow| factor * coefficient(row, 1);
    let smooth = || rows.iter().filter(|row| coefficient(row, 2).is_finite());
    let Some(own) = own else {
        let best = smooth().min_by(|a, b| peak(a).total_cmp(&peak(b))).or(rows.first());
        return best.map_or_else(String::new, |row| {
            let peak = figure(peak(row));
            format!("{} has the least peak acceleration: {peak} {unit}", row.law.name)
        });
    };
    let lower = || smooth().filter(|row| peak(row) < peak(own) * (1.0 - 1e-9));
    let share =
        |row: &LawRow, value: &dyn Fn(&LawRow) -> f64| figure((100.0 * (1.0 - value(row) / value(own))).round());
    if !torque(own).is_finite() {
        return match lower().min_by(|a, b| peak(a).total_cmp(&peak(b))) {
            Some(row) => {
                format!("{}: {} % less peak acceleration than {}", row.law.name, share(row, &peak), own.law.name)
            }
            None => format!("{}: no smooth law has a lower peak acceleration", own.law.name),
        };
    }
    match lower().filter(|row| torque(row) < torque(own)).min_by(|a, b| torque(a).total_cmp(&torque(b))) {
        Some(row) => format!(
            "{}: {} % less torque and {} % less peak acceleration than {}",
            row.law.name,
            share(row, &torque),
            share(row, &peak),
            own.law.name
        ),
        None => format!(
            "{}: of the laws up to its {} {unit} it needs the least torque, {} N·m",
            own.law.name,
            figure(peak(own)),
            figure(torque(own))
        ),
    }
}

/// What the laws move, and how their plots differ.
fn conditions(name: &str, rise: Rise) -> String {
    let lift = if rise.quantity == Quantity::Length {
        format!("{} mm", figure(mm(rise.lift)))
    } else {
        format!("{}°", figure(rise.lift.to_degrees()))
    };
    let speed = rise.speed.map_or_else(String::new, |speed| format!(" at {} rpm", figure(units::rpm(speed))));
    format!("{name}: {lift} in {}° of the cam{speed}", figure(rise.over.to_degrees()))
}

/// A law among others.
fn small_plot(row: &LawRow, rise: Rise, own: Option<&LawRow>, factor: f64) -> SmallPlot {
    let points = points(row, rise.over.to_degrees(), 2, factor);
    let largest = |best: [f64; 2], next: [f64; 2]| if next[1] > best[1] * (1.0 + 1e-9) { next } else { best };
    // The place is that of a drawn point, the figure that of the law.
    let exact = figure(factor * coefficient(row, 1));
    let peak = points.iter().copied().reduce(largest).map(|at| PlotPoint::dot(at, 0, exact.clone()));
    let cam = row.cam.as_ref();
    let torque_text = cam.filter(|cam| cam.torque.is_finite()).map(|cam| format!("{} N·m", figure(cam.torque)));
    let is_better = own.is_some_and(|own| torque(row) < torque(own) * (1.0 - 1e-9));
    let jump = cam.filter(|cam| cam.jump.is_finite());
    let note = match jump {
        Some(cam) => format!("lifts off at {} rpm", figure(units::rpm(cam.jump).round())),
        None => format!("Cv {}, Cj {}", figure(coefficient(row, 0)), figure(coefficient(row, 2))),
    };
    SmallPlot {
        name: row.law.name.into(),
        points,
        peak,
        figure: (torque_text.unwrap_or_default(), is_better),
        note,
        is_own: own.is_some_and(|own| own.law.name == row.law.name),
    }
}

/// The laws in their order, `own` is the law of the design: up to four in common plots, more as small plots of the acceleration on one scale.
pub(super) fn plot(name: &str, rows: &[LawRow], rise: Rise, own: Option<&str>) -> Plot {
    let over = rise.over.to_degrees();
    let own = own.and_then(|own| rows.iter().find(|row| row.law.name == own));
    let (factor, unit) = acceleration(rise);
    let title = headline(rows, own, (factor, unit));
    let conditions = conditions(name, rise);
    if rows.len() <= IN_COMMON {
        let panel = |name: &str, order: usize| {
            let curves = rows
                .iter()
                .enumerate()
                .map(|(colour, row)| PlotCurve::new(row.law.name, colour, points(row, over, order, 1.0)));
            PlotPanel::new(name, curves.collect())
        };
        return Plot {
            title,
            subtitle: format!("{conditions}; h the travel, β the angle of the segment"),
            places: "cam angle, degrees".into(),
            panels: vec![
                panel("Lift over h", 0),
                panel("Velocity over h/β: its peak is Cv", 1),
                panel("Acceleration over h/β²: its peak is Ca", 2),
                panel("Jerk over h/β³: its peak is Cj", 3),
            ],
            ..Plot::default()
        };
    }
    let is_smooth = |row: &&LawRow| coefficient(row, 2).is_finite();
    let smooth: Vec<&LawRow> = rows.iter().filter(is_smooth).collect();
    let drawn = smooth.iter().take(DRAWN);
    let stepped: Vec<&str> = rows.iter().filter(|row| !is_smooth(row)).map(|row| row.law.name).collect();
    let more: Vec<&str> = smooth.iter().skip(DRAWN).map(|row| row.law.name).collect();
    let mut left_out = Vec::new();
    if !stepped.is_empty() {
        left_out.push(format!("left out, with a step of acceleration or velocity: {}", stepped.join(", ")));
    }
    if !more.is_empty() {
        left_out.push(format!("no room: {}", more.join(", ")));
    }
    let grey = own.map_or_else(String::new, |own| format!("; grey: {}, the design's own", own.law.name));
    let blue =
        own.filter(|own| torque(own).is_finite()).map_or("", |_| "; torque in blue where it is below the design's");
    Plot {
        title,
        subtitle: format!("{conditions}{grey}{blue}"),
        small: Some(SmallPlots {
            name: format!("Acceleration over the segment, {unit}"),
            plots: drawn.map(|row| small_plot(row, rise, own, factor)).collect(),
            in_a_row: 0,
            left_out: left_out.join("; "),
        }),
        ..Plot::default()
    }
}
