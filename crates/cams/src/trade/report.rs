//! The report on the measured settings: advice, table, words, picture.

use super::measure::{TradeLimits, TradeMeasurement, TradeRow};
use crate::report::ReportLine;
use crate::report::chart::{self, Chart, ChartPanel, ChartPoint};
use crate::report::plot::figure;
use crate::report::{SummaryColumn, SummaryTable, length_cell, number_cell, shown};
use crate::table::{ListedColumn, Table};
use camgen_kernel::text::{LengthKind, Text, text};

/// The setting that is advised, where one keeps the limits.
pub(super) fn chosen(rows: &[TradeRow]) -> Option<&TradeRow> {
    rows.iter().find(|row| row.rank == Some(1))
}

/// Which setting to take.
pub(super) fn advice(rows: &[TradeRow], limits: TradeLimits) -> String {
    let Some(row) = chosen(rows) else { return nothing_keeps(rows, limits) };
    let acceleration = row.acceleration_share.filter(|_| limits.residual.is_some());
    format!(
        "{} is the cheapest setting that leaves no more than {}: {} {}, and it leaves {}{}",
        row.setting,
        limits.words(),
        row.pieces,
        row.entity.word(),
        limits.left_words(row),
        acceleration
            .map_or(String::new(), |share| format!("; the error of its acceleration is {} %", shown(100.0 * share)))
    )
}

/// The advice with the flags that ask for it.
pub(super) fn advice_words(advice: &str, chosen: Option<&TradeRow>) -> Vec<String> {
    let flags = chosen.and_then(|row| row.flags.as_ref()).map(|flags| format!("flags: {flags}"));
    std::iter::once(advice.to_owned()).chain(flags).collect()
}

/// No setting keeps the limit: which comes nearest, and whether a finer one could.
fn nothing_keeps(rows: &[TradeRow], limits: TradeLimits) -> String {
    let Some(least) = rows.iter().min_by(|a, b| limits.left(a).total_cmp(&limits.left(b))) else {
        return "nothing was measured".into();
    };
    if !limits.left(least).is_finite() {
        return format!("no setting leaves a finite force: limit {}", limits.words());
    }
    let checks = match least.failed.as_slice() {
        [] => String::new(),
        failed => format!("; its check {} fails", failed.join(", ")),
    };
    format!(
        "no setting passes its checks and leaves no more than {}; {} leaves least, {}{checks}",
        limits.words(),
        least.setting,
        limits.left_words(least)
    )
}

fn number(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

#[expect(clippy::cast_precision_loss, reason = "arcs and bytes of a file")]
fn count(number: usize) -> f64 {
    number as f64
}

const COLUMNS: [ListedColumn<TradeRow>; 24] = [
    ("rank", |row| number(row.rank.map(count))),
    ("machining_s", |row| row.machining_s),
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
    ("acceleration_error_m_per_s2", |row| number(row.acceleration_error_m_per_s2)),
    ("acceleration_share", |row| number(row.acceleration_share)),
    ("torque_error_nm", |row| number(row.torque_error_nm)),
];

pub(super) fn table(rows: &[TradeRow]) -> Table {
    let names = rows.iter().map(|row| row.setting.clone()).collect();
    Table { words: Some(("setting", names)), ..Table::listed(&COLUMNS, rows) }
}

/// Settings of a summary.
const MOST_SUMMARISED: usize = 12;

/// What each setting costs and leaves, for a summary.
pub(super) fn summary_table(rows: &[TradeRow]) -> SummaryTable {
    let cell = |value: Option<f64>| value.filter(|value| value.is_finite()).map_or("–".into(), number_cell);
    let row = |row: &TradeRow| {
        vec![
            Text::from(row.setting.clone()),
            text!("{} {}", row.pieces, row.entity.word()),
            length_cell(row.deviation_mm),
            cell(Some(row.residual_n)),
            cell(row.acceleration_share.map(|share| 100.0 * share)),
            number_cell(1e-3 * row.total_us),
        ]
    };
    // Those that keep the limits, and those with a name: a screen has no room for all.
    let listed: Vec<&TradeRow> = rows.iter().filter(|row| row.rank.is_some() || row.setting.ends_with(')')).collect();
    let shown: Vec<&TradeRow> = listed.into_iter().take(MOST_SUMMARISED).collect();
    let more = rows.len() - shown.len();
    SummaryTable {
        heads: vec![
            SummaryColumn::words("setting"),
            SummaryColumn::words("pieces"),
            SummaryColumn::lengths("off", &LengthKind::MM),
            SummaryColumn::numbers("left over", "N"),
            SummaryColumn::numbers("accel.", "% off"),
            SummaryColumn::numbers("time", "ms"),
        ],
        rows: shown.iter().map(|shown| row(shown)).collect(),
        marked: shown.iter().position(|row| row.rank == Some(1)),
        rest: Some(text!("{} more (-v); time of this computer", more)),
    }
}

/// Width of the names of settings.
const NAME: usize = 26;

/// The settings, a line each.
pub(super) fn words(measured: &TradeMeasurement) -> Vec<ReportLine> {
    let head = [
        ("rank", 4),
        ("pieces", 12),
        ("bytes", 8),
        ("cut/s", 6),
        ("law err/mm", 11),
        ("off/mm", 10),
        ("left/N", 10),
        ("v mm/rad", 9),
        ("acc/%", 8),
        ("a/(m/s²)", 9),
        ("torque/Nm", 10),
        ("time/ms", 8),
    ];
    let line = |name: &str, cells: [String; 12]| {
        let cells = cells.iter().zip(head).map(|(cell, (_, width))| format!(" {cell:>width$}"));
        ReportLine::row(format!("{name:<NAME$}{}", cells.collect::<String>()))
    };
    let rows = measured.rows.iter().map(|row| {
        line(
            &row.setting,
            [
                row.rank.map_or("–".to_owned(), |rank| rank.to_string()),
                format!("{} {}", row.pieces, row.entity.word()),
                row.bytes.to_string(),
                format!("{:.0}", row.machining_s),
                shown(row.law_error_mm),
                shown(row.deviation_mm),
                or_dash(Some(row.residual_n).filter(|force| force.is_finite())),
                or_dash(row.velocity_error_mm_per_rad),
                or_dash(row.acceleration_share.map(|share| 100.0 * share)),
                or_dash(row.acceleration_error_m_per_s2),
                or_dash(row.torque_error_nm),
                format!("{:.1}", 1e-3 * row.total_us),
            ],
        )
    });
    let first = format!(
        "rank: what costs the shop least among the settings that keep the limits; time of this computer, the least of {} rounds",
        measured.rounds
    );
    let names = line("setting", head.map(|(name, _)| name.to_owned()));
    [first.into(), names].into_iter().chain(rows).collect()
}

fn or_dash(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), shown)
}

/// The advice in a line, without its flags.
pub(super) fn headline(rows: &[TradeRow], limits: TradeLimits) -> String {
    match chosen(rows) {
        Some(row) => {
            let left = match (limits.residual, row.acceleration_share) {
                (None, Some(share)) => format!("{} % error of the acceleration", figure(100.0 * share)),
                _ => format!("{} N are left", figure(row.residual_n)),
            };
            format!("{} is enough: {} {}, {left}", row.setting, row.pieces, row.entity.word())
        }
        None => format!("No setting leaves at most {}", limits.words()),
    }
}

/// Pieces against residual force, or the gap where there is no force to balance, and against the acceleration error, each with its Pareto
/// front.
pub(super) fn chart_of(rows: &[TradeRow], limits: TradeLimits, title: String, subtitle: String) -> Chart {
    let points = |value: fn(&TradeRow) -> Option<f64>| {
        let points = rows.iter().filter_map(|row| {
            Some(ChartPoint { x: count(row.pieces), y: value(row)?, label: row.setting.clone(), best: false })
        });
        let mut points: Vec<ChartPoint> = points.collect();
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
    Chart { title, subtitle, x_name: "pieces", panels }
}
