//! What is told of the measured settings: advice, table, words, picture.

use super::{Limits, Row, TradeReport, ranking};
use camgen::report::chart::{self, Panel, Point};
use camgen::report::sheet::Sheet;
use camgen::report::shown;

/// Which setting to take. Where several cannot be told apart by their times, it is the one of them that leaves least.
pub(super) fn advice(rows: &[Row], limits: Limits, stable: bool) -> String {
    let order = ranking(rows, limits);
    let ranked: Vec<&Row> = order.iter().filter_map(|index| rows.get(*index)).collect();
    let words = |row: &Row| {
        format!(
            "{} is the cheapest setting that leaves no more than {}: it leaves {} for {:.2} ms{}",
            row.setting,
            limits.words(),
            limits.left_words(row),
            1e-3 * row.total_us,
            row.acceleration_share
                .filter(|_| limits.residual.is_some())
                .map_or(String::new(), |share| format!(", its acceleration is off by {} %", shown(100.0 * share)))
        )
    };
    match ranked.as_slice() {
        [] => nothing_keeps(rows, limits),
        [first, ..] if stable => words(first),
        [first, ..] => {
            let alike: Vec<&&Row> = ranked.iter().filter(|row| row.total_low_us <= first.total_high_us).collect();
            let names: Vec<&str> = alike.iter().map(|row| &*row.setting).collect();
            let least = alike.iter().min_by(|a, b| limits.left(a).total_cmp(&limits.left(b)));
            let best: &Row = least.map_or(first, |row| row);
            if alike.len() > 1 {
                let names = names.join(", ");
                let why = format!("the times of {names} cannot be told apart on this computer now");
                format!("{}; {why}: of them it leaves least", words(best))
            } else {
                format!("{}; the order of the slower settings did not settle", words(best))
            }
        }
    }
}

/// No setting keeps the limit: which comes nearest, and whether a finer one could.
fn nothing_keeps(rows: &[Row], limits: Limits) -> String {
    let Some(least) = rows.iter().min_by(|a, b| limits.left(a).total_cmp(&limits.left(b))) else {
        return "nothing was measured".into();
    };
    format!(
        "no setting leaves no more than {}; {} leaves least, {} for {:.2} ms",
        limits.words(),
        least.setting,
        limits.left_words(least),
        1e-3 * least.total_us
    )
}

const COLUMNS: [&str; 22] = [
    "setting",
    "law_us",
    "outline_us",
    "checks_us",
    "dxf_us",
    "svg_us",
    "step_us",
    "csv_us",
    "total_us",
    "arcs",
    "bytes",
    "law_error_mm",
    "deviation_mm",
    "residual_n",
    "total_low_us",
    "total_high_us",
    "pieces",
    "rolled_mm",
    "velocity_error_mm_per_rad",
    "acceleration_error_mm_per_rad2",
    "acceleration_share",
    "torque_error_nm",
];

pub(super) fn table(rows: &[Row]) -> String {
    let mut text = COLUMNS.join(",");
    text.push('\n');
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:e}"));
    for row in rows {
        let step = row.step_us.map_or(String::new(), |time| format!("{time:.2}"));
        text.push_str(&format!(
            "\"{}\",{:.2},{:.2},{:.2},{:.2},{:.2},{step},{:.2},{:.2},{},{},{:e},{:e},{:e},{:.2},{:.2},{},{},{},{},{},{}\n",
            row.setting,
            row.law_us,
            row.outline_us,
            row.checks_us,
            row.dxf_us,
            row.svg_us,
            row.csv_us,
            row.total_us,
            row.arcs,
            row.bytes,
            row.law_error_mm,
            row.deviation_mm,
            row.residual_n,
            row.total_low_us,
            row.total_high_us,
            row.pieces,
            number(row.rolled_mm),
            number(row.velocity_error_mm_per_rad),
            number(row.acceleration_error_mm_per_rad2),
            number(row.acceleration_share),
            number(row.torque_error_nm)
        ));
    }
    text
}

/// What a kind of cam is called.
pub(super) fn noun(kind: &str) -> String {
    if kind == "make" { "disc cam".into() } else { format!("{kind} cam") }
}

pub(super) fn words(report: &TradeReport<'_>) -> String {
    let mut lines = vec![
        format!(
            "{} · {}{}: time by stage, µs, median of {} rounds; half of the totals lie in the spread",
            report.machine,
            noun(report.cam),
            report.rpm.map_or(String::new(), |rpm| format!(" at {rpm} rpm")),
            report.rounds
        ),
        format!(
            "  {:<24} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>13} {:>6} {:>8} {:>10} {:>10} {:>10} {:>9} {:>7} {:>9}",
            "setting",
            "law",
            "outline",
            "checks",
            "dxf",
            "svg",
            "step",
            "csv",
            "total",
            "spread",
            "pieces",
            "bytes",
            "law err/mm",
            "off/mm",
            "left/N",
            "v mm/rad",
            "acc/%",
            "torque/Nm"
        ),
    ];
    for row in report.rows {
        let step = row.step_us.map_or("–".to_owned(), |time| format!("{time:.0}"));
        let spread = format!("{:.0}…{:.0}", row.total_low_us, row.total_high_us);
        let or_dash = |value: Option<f64>| value.map_or("–".to_owned(), shown);
        let (velocity, torque) = (or_dash(row.velocity_error_mm_per_rad), or_dash(row.torque_error_nm));
        let share = or_dash(row.acceleration_share.map(|share| 100.0 * share));
        lines.push(format!(
            "  {:<24} {:>8.0} {:>8.0} {:>8.0} {:>7.0} {:>7.0} {step:>7} {:>7.0} {:>8.0} {spread:>13} {:>6} {:>8} {:>10.1e} {:>10.1e} {:>10.3e} {velocity:>9} {share:>7} {torque:>9}",
            row.setting, row.law_us, row.outline_us, row.checks_us, row.dxf_us, row.svg_us, row.csv_us, row.total_us,
            row.pieces, row.bytes, row.law_error_mm, row.deviation_mm, row.residual_n
        ));
    }
    lines.push(format!("  {}", report.advice));
    lines.extend(report.files.iter().map(|file| format!("    {file}")));
    lines.push(String::new());
    lines.join("\n")
}

/// Total time against residual force, or the gap where no force is to balance, and against the acceleration error, each with its Pareto
/// front.
pub(super) fn picture(rows: &[Row], limits: Limits, title: &str) -> Sheet {
    let points = |value: fn(&Row) -> Option<f64>| {
        let point =
            |row: &Row| Some(Point { x: row.total_us, y: value(row)?, label: row.setting.clone(), best: false });
        let mut points: Vec<Point> = rows.iter().filter_map(point).collect();
        chart::mark_front(&mut points);
        points
    };
    let panels = [
        if limits.residual.is_some() {
            Panel { y_name: "residual force, N", points: points(|row| Some(row.residual_n)) }
        } else {
            Panel { y_name: "largest gap, mm", points: points(|row| row.rolled_mm) }
        },
        Panel { y_name: "acceleration error over the largest", points: points(|row| row.acceleration_share) },
    ];
    chart::chart(title, "total time, µs", &panels)
}
