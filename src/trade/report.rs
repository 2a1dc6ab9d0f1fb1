//! The report on the measured settings: advice, table, words, picture.

use super::measure::{TradeLimits, TradeMeasurement, TradeRow, ranking};
use crate::report::chart::{self, Chart, ChartPanel, ChartPoint};
use crate::report::shown;
use crate::table::{ListedColumn, Table};

/// Which setting to take. Where the times of several cannot be distinguished, it is the one that leaves least.
pub(super) fn advice(rows: &[TradeRow], limits: TradeLimits, stable: bool) -> String {
    let order = ranking(rows, limits);
    let ranked: Vec<&TradeRow> = order.iter().filter_map(|index| rows.get(*index)).collect();
    let words = |row: &TradeRow| {
        format!(
            "{} is the cheapest setting that leaves no more than {}: it leaves {} and takes {:.2} ms{}",
            row.setting,
            limits.words(),
            limits.left_words(row),
            1e-3 * row.total_us,
            row.acceleration_share.filter(|_| limits.residual.is_some()).map_or(String::new(), |share| format!(
                "; the error of its acceleration is {} %",
                shown(100.0 * share)
            ))
        )
    };
    match ranked.as_slice() {
        [] => nothing_keeps(rows, limits),
        [first, ..] if stable => words(first),
        [first, ..] => {
            let alike: Vec<&&TradeRow> = ranked.iter().filter(|row| row.total_low_us <= first.total_high_us).collect();
            let names: Vec<&str> = alike.iter().map(|row| &*row.setting).collect();
            let least = alike.iter().min_by(|a, b| limits.left(a).total_cmp(&limits.left(b)));
            let best: &TradeRow = least.map_or(first, |row| row);
            if alike.len() > 1 {
                let names = names.join(", ");
                let why = format!("the times of {names} cannot be distinguished on this computer now");
                format!("{}; {why}: of these it leaves least", words(best))
            } else {
                format!("{}; the order of the slower settings did not become stable", words(best))
            }
        }
    }
}

/// No setting keeps the limit: which comes nearest, and whether a finer one could.
fn nothing_keeps(rows: &[TradeRow], limits: TradeLimits) -> String {
    let Some(least) = rows.iter().min_by(|a, b| limits.left(a).total_cmp(&limits.left(b))) else {
        return "nothing was measured".into();
    };
    format!(
        "every setting leaves more than {}; {} leaves least, {} in {:.2} ms",
        limits.words(),
        least.setting,
        limits.left_words(least),
        1e-3 * least.total_us
    )
}

fn number(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

#[expect(clippy::cast_precision_loss, reason = "arcs and bytes of a file")]
fn count(number: usize) -> f64 {
    number as f64
}

const COLUMNS: [ListedColumn<TradeRow>; 21] = [
    ("law_us", |row| row.law_us),
    ("outline_us", |row| row.outline_us),
    ("checks_us", |row| row.checks_us),
    ("dxf_us", |row| row.dxf_us),
    ("svg_us", |row| row.svg_us),
    ("step_us", |row| number(row.step_us)),
    ("csv_us", |row| row.csv_us),
    ("total_us", |row| row.total_us),
    ("arcs", |row| count(row.arcs)),
    ("bytes", |row| count(row.bytes)),
    ("law_error_mm", |row| row.law_error_mm),
    ("deviation_mm", |row| row.deviation_mm),
    ("residual_n", |row| row.residual_n),
    ("total_low_us", |row| row.total_low_us),
    ("total_high_us", |row| row.total_high_us),
    ("pieces", |row| count(row.pieces)),
    ("rolled_mm", |row| number(row.rolled_mm)),
    ("velocity_error_mm_per_rad", |row| number(row.velocity_error_mm_per_rad)),
    ("acceleration_error_mm_per_rad2", |row| number(row.acceleration_error_mm_per_rad2)),
    ("acceleration_share", |row| number(row.acceleration_share)),
    ("torque_error_nm", |row| number(row.torque_error_nm)),
];

pub(super) fn table(rows: &[TradeRow]) -> Table {
    let names = rows.iter().map(|row| row.setting.clone()).collect();
    Table { words: Some(("setting", names)), ..Table::listed(&COLUMNS, rows) }
}

/// Width of the names of settings.
const NAME: usize = 26;

/// The settings, a line each, and the advice.
pub(super) fn words(measured: &TradeMeasurement, advice: &str) -> Vec<String> {
    let head = [
        ("law", 8),
        ("outline", 9),
        ("checks", 8),
        ("dxf", 7),
        ("svg", 7),
        ("step", 7),
        ("csv", 7),
        ("total", 8),
        ("spread", 14),
        ("pieces", 7),
        ("bytes", 8),
        ("law err/mm", 11),
        ("off/mm", 10),
        ("left/N", 10),
        ("v mm/rad", 9),
        ("acc/%", 8),
        ("torque/Nm", 10),
    ];
    let line = |name: &str, cells: [String; 17]| {
        let cells = cells.iter().zip(head).map(|(cell, (_, width))| format!(" {cell:>width$}"));
        format!("{name:<NAME$}{}", cells.collect::<String>())
    };
    let time = |micros: f64| format!("{micros:.0}");
    let row = |row: &TradeRow| {
        let or_dash = |value: Option<f64>| value.map_or("–".to_owned(), shown);
        line(
            &row.setting,
            [
                time(row.law_us),
                time(row.outline_us),
                time(row.checks_us),
                time(row.dxf_us),
                time(row.svg_us),
                row.step_us.map_or("–".to_owned(), time),
                time(row.csv_us),
                time(row.total_us),
                format!("{:.0}…{:.0}", row.total_low_us, row.total_high_us),
                row.pieces.to_string(),
                row.bytes.to_string(),
                shown(row.law_error_mm),
                shown(row.deviation_mm),
                shown(row.residual_n),
                or_dash(row.velocity_error_mm_per_rad),
                or_dash(row.acceleration_share.map(|share| 100.0 * share)),
                or_dash(row.torque_error_nm),
            ],
        )
    };
    let first =
        format!("time by stage, µs, median of {} rounds; half of the totals are within the spread", measured.rounds);
    let names = line("setting", head.map(|(name, _)| name.to_owned()));
    [first, names].into_iter().chain(measured.rows.iter().map(row)).chain([advice.to_owned()]).collect()
}

/// Total time against residual force, or the gap where there is no force to balance, and against the acceleration error, each with its Pareto
/// front.
pub(super) fn chart_of(rows: &[TradeRow], limits: TradeLimits, title: String) -> Chart {
    let points = |value: fn(&TradeRow) -> Option<f64>| {
        let point = |row: &TradeRow| {
            Some(ChartPoint { x: row.total_us, y: value(row)?, label: row.setting.clone(), best: false })
        };
        let mut points: Vec<ChartPoint> = rows.iter().filter_map(point).collect();
        chart::mark_front(&mut points);
        points
    };
    let panels = vec![
        if limits.residual.is_some() {
            ChartPanel { y_name: "residual force, N", points: points(|row| Some(row.residual_n)) }
        } else {
            ChartPanel { y_name: "largest gap, mm", points: points(|row| row.rolled_mm) }
        },
        ChartPanel { y_name: "acceleration error over the largest", points: points(|row| row.acceleration_share) },
    ];
    Chart { title, x_name: "total time, µs", panels }
}
