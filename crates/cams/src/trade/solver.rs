//! Speed against accuracy of a computation: sections of a cam, steps or stations of a solver, each with the error that it leaves.

use super::COMMAND;
use super::measure::{TradeClock, timed};
use crate::analysis::{Analysis, Picture};
use crate::body::Kind;
use crate::report::ReportLine;
use crate::report::chart::{self, Chart, ChartPanel, ChartPoint};
use crate::report::{Section, Speeds, shown};
use crate::table::{ListedColumn, Table};
use camgen_kernel::document::Input;
use camgen_kernel::refusal::Refusal;
use serde_json::{Value, json};

/// A setting is computed so often; the least time counts.
const ROUNDS: usize = 5;

/// A setting and the error that it leaves.
#[derive(Debug, Clone)]
pub struct SolverRow {
    pub(crate) setting: String,
    /// The flags of the command that ask for it.
    pub(crate) flags: String,
    /// Sections, steps or stations.
    pub(crate) pieces: usize,
    pub(crate) error: f64,
    /// The least of the rounds.
    pub(crate) time_us: f64,
}

impl SolverRow {
    /// Computes a setting, which gives its error.
    ///
    /// # Errors
    /// That of the computation.
    pub fn measured(
        (setting, flags, pieces): (String, String, usize),
        clock: TradeClock<'_>,
        compute: impl Fn() -> Result<f64, Refusal>,
    ) -> Result<Self, Refusal> {
        let (mut time_us, mut error) = (f64::INFINITY, f64::NAN);
        for _ in 0..ROUNDS {
            let (time, found) = timed(clock, &compute)?;
            (time_us, error) = (time_us.min(time), found);
        }
        Ok(Self { setting, flags, pieces, error, time_us })
    }
}

/// What the settings are of.
pub struct SolverTask<'a> {
    /// The kind of the analysis.
    pub kind: &'static Kind,
    /// The name of the machine.
    pub machine: &'a str,
    /// After `trade`.
    pub word: &'static str,
    /// The speeds for which it is solved.
    pub speeds: Speeds,
    /// What has an effect besides the machine.
    pub inputs: Vec<Input>,
    /// The column of the error, its unit in words (empty of a share), and what it is.
    pub error: (&'static str, &'static str, &'static str),
    /// The largest error that the advice allows.
    pub limit: f64,
}

#[expect(clippy::cast_precision_loss, reason = "sections and steps")]
fn count(row: &SolverRow) -> f64 {
    row.pieces as f64
}

const OF_SHARE: [ListedColumn<SolverRow>; 3] =
    [("pieces", count), ("error", |row| row.error), ("time_us", |row| row.time_us)];
const OF_FORCE: [ListedColumn<SolverRow>; 3] =
    [("pieces", count), ("residual_n", |row| row.error), ("time_us", |row| row.time_us)];

/// The settings as an analysis. Advised is the one with the fewest pieces that leaves no more than the limit.
///
/// # Errors
/// Where the checks of the advised setting, which `failing` names by its pieces, cannot be made.
pub fn analysis(
    task: SolverTask<'_>,
    rows: &[SolverRow],
    failing: impl Fn(usize) -> Result<Vec<String>, Refusal>,
) -> Result<Analysis, Refusal> {
    let (column, unit, about) = task.error;
    let told = |error: f64| {
        if unit.is_empty() { format!("{} %", shown(100.0 * error)) } else { format!("{} {unit}", shown(error)) }
    };
    let chosen = rows.iter().filter(|row| row.error <= task.limit).min_by_key(|row| row.pieces);
    let failed = chosen.map_or_else(|| Ok(Vec::new()), |row| failing(row.pieces))?;
    let advice = advice(rows, chosen, &told(task.limit), told);
    let advice =
        if failed.is_empty() { advice } else { format!("{advice}; but its check {} fails", failed.join(", ")) };
    let chosen = chosen.filter(|_| failed.is_empty());
    let flags = chosen.map(|row| Section::new("flags", &row.flags));
    let values = rows.iter().map(|row| {
        json!({"setting": row.setting, "flags": row.flags, "pieces": row.pieces, column: row.error, "time_us": row.time_us})
    });
    let values: Vec<Value> = values.collect();
    let head = ReportLine::row(format!("{:<16} {:>8} {:>12} {:>10}", "setting", "pieces", "error", "time/ms"));
    let mut words = vec![format!("{about}; time of this computer, the least of {ROUNDS} rounds").into(), head];
    words.extend(rows.iter().map(|row| {
        ReportLine::row(format!(
            "{:<16} {:>8} {:>12} {:>10.2}",
            row.setting,
            row.pieces,
            told(row.error),
            1e-3 * row.time_us
        ))
    }));
    let mut inputs = task.inputs;
    inputs.push(Input::word("command", format!("{COMMAND} {}", task.word)));
    let names = rows.iter().map(|row| row.setting.clone()).collect();
    let columns = if unit.is_empty() { &OF_SHARE } else { &OF_FORCE };
    let told_flags = chosen.map(|row| format!("flags: {}", row.flags));
    Ok(Analysis {
        kind: task.kind,
        variant: "",
        machine: task.machine.to_owned(),
        speeds: task.speeds,
        inputs,
        sections: [
            Section::new("rows", &values).with_words(words),
            Section::new("advice", &advice).with_words(std::iter::once(advice.clone()).chain(told_flags).collect()),
        ]
        .into_iter()
        .chain(flags)
        .collect(),
        measures: Vec::new(),
        notes: Vec::new(),
        tables: vec![("", Table { words: Some(("setting", names)), ..Table::listed(columns, rows) })],
        by: &[],
        along: "pieces",
        picture: Picture::Chart(chart_of(rows, advice.clone(), format!("{}: {about}", task.machine), about)),
        mechanism: None,
        document: None,
        diagrams: &[],
        not_modelled: Vec::new(),
    })
}

/// Which setting to take.
fn advice(rows: &[SolverRow], chosen: Option<&SolverRow>, limit: &str, told: impl Fn(f64) -> String) -> String {
    let least = rows.iter().min_by(|a, b| a.error.total_cmp(&b.error));
    match (chosen, least) {
        (Some(row), _) => {
            let left = told(row.error);
            format!("{} is the cheapest setting that leaves no more than {limit}: it leaves {left}", row.setting)
        }
        (None, Some(row)) => {
            let before = rows.iter().rev().nth(1).map_or(f64::INFINITY, |row| row.error);
            let same = (before - row.error).abs() < 0.01 * row.error;
            let end = if same { "; more pieces do not help: the method itself is off" } else { "" };
            format!("every setting leaves more than {limit}; {} leaves least, {}{end}", row.setting, told(row.error))
        }
        (None, None) => "nothing was measured".to_owned(),
    }
}

fn chart_of(rows: &[SolverRow], title: String, subtitle: String, about: &'static str) -> Chart {
    let mut points: Vec<ChartPoint> = rows
        .iter()
        .map(|row| ChartPoint { x: count(row), y: row.error, label: row.setting.clone(), best: false })
        .collect();
    chart::mark_front(&mut points);
    Chart { title, subtitle, x_name: "pieces", panels: vec![ChartPanel { y_name: about, points }] }
}
