//! What the rows of a study show: the distribution of each column, the reasons of faults, and the front of a Pareto study. Everything is
//! read from the table, in two passes, and what is in memory does not grow with the number of rows.

use super::kind::{Goal, StudyKind};
use super::specification::Study;
use super::table::each_row;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, BufRead};

/// Version of the form of a summary.
const SCHEMA: u32 = 1;
/// Cells of the distribution of a column: a quantile is right to this part of the range.
const CELLS: usize = 4096;
/// Bars of a histogram.
#[cfg(feature = "html")]
pub(super) const BARS: usize = 64;
/// The quantiles told.
const QUANTILES: [f64; 7] = [0.001, 0.01, 0.05, 0.5, 0.95, 0.99, 0.999];
/// Most reasons of faults that are told, and most rows that a page shows.
const REASONS: usize = 20;
const SHOWN: u64 = 3000;

/// The distribution of the numbers of a column.
#[derive(Debug, Clone)]
pub struct Distribution {
    /// The name of the column.
    pub name: String,
    /// How many numbers there are.
    pub count: u64,
    /// The least and the largest.
    pub range: (f64, f64),
    /// The mean.
    pub mean: f64,
    /// The sum of the squares about the mean (Welford).
    squares: f64,
    cells: Vec<u64>,
}

impl Distribution {
    fn new(name: &str) -> Self {
        let range = (f64::INFINITY, f64::NEG_INFINITY);
        Self { name: name.to_owned(), count: 0, range, mean: 0.0, squares: 0.0, cells: vec![0; CELLS] }
    }

    #[expect(clippy::cast_precision_loss, reason = "a count")]
    fn add(&mut self, value: f64) {
        self.count += 1;
        self.range = (self.range.0.min(value), self.range.1.max(value));
        let from = value - self.mean;
        self.mean += from / self.count as f64;
        self.squares += from * (value - self.mean);
    }

    #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cell")]
    fn place(&mut self, value: f64) {
        let (low, high) = self.range;
        let share = if high > low { (value - low) / (high - low) } else { 0.0 };
        let cell = ((share * CELLS as f64) as usize).min(CELLS - 1);
        if let Some(count) = self.cells.get_mut(cell) {
            *count += 1;
        }
    }

    /// The standard deviation; 0 of one number.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a count")]
    pub fn deviation(&self) -> f64 {
        if self.count < 2 { 0.0 } else { (self.squares / (self.count - 1) as f64).sqrt() }
    }

    /// The number below which a share of all lies, to 1/4096 of the range.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "counts")]
    pub fn quantile(&self, share: f64) -> f64 {
        let (low, high) = self.range;
        let wanted = share * self.count as f64;
        let mut below = 0.0;
        for (cell, count) in self.cells.iter().enumerate() {
            let count = *count as f64;
            if count > 0.0 && below + count >= wanted {
                let inside = ((wanted - below) / count).clamp(0.0, 1.0);
                return low + (high - low) * (cell as f64 + inside) / CELLS as f64;
            }
            below += count;
        }
        high
    }

    /// The bars of a histogram from the least number to the largest.
    #[cfg(feature = "html")]
    pub(super) fn bars(&self) -> Vec<u64> {
        self.cells.chunks(CELLS / BARS).map(|cells| cells.iter().sum()).collect()
    }

    fn json(&self) -> Value {
        let quantiles: serde_json::Map<String, Value> =
            QUANTILES.iter().map(|share| (share.to_string(), json!(self.quantile(*share)))).collect();
        json!({
            "count": self.count, "least": self.range.0, "largest": self.range.1, "mean": self.mean,
            "deviation": self.deviation(), "quantiles": quantiles,
        })
    }
}

/// A row of the front: its objectives, each better where it is smaller, and its line.
type FrontRow = (Vec<f64>, String);

/// What the rows of a study show.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Rows without figures, or without some of them.
    pub faults: u64,
    /// Rows that keep every constraint; all without a fault where there is none.
    pub feasible: u64,
    /// The columns with numbers.
    pub columns: Vec<Distribution>,
    /// The reasons of faults, the most frequent first, with the numbers of their rows.
    pub reasons: Vec<(String, u64)>,
    /// The lines of the designs that no other beats, in the order of their rows.
    pub front: Vec<String>,
    /// Rows for a page, evenly from all.
    #[cfg_attr(not(feature = "html"), expect(dead_code, reason = "shown on the page alone"))]
    pub(super) shown: Vec<Vec<String>>,
}

/// The size of a cell by which designs are ordered: a truth is 1 or 0.
fn order(cell: &str, value: Option<f64>) -> Option<f64> {
    match cell {
        "true" => Some(1.0),
        "false" => Some(0.0),
        _ => value,
    }
}

impl Study {
    /// Reads the table twice.
    ///
    /// # Errors
    /// What reading it gives.
    pub fn summary<T: BufRead>(&self, open: impl Fn() -> io::Result<T>) -> io::Result<Summary> {
        let header = self.header();
        let names = super::table::cells(header.trim_end());
        let mut all: Vec<Distribution> = names.iter().map(|name| Distribution::new(name)).collect();
        let (last, first) = (names.len() - 1, 1);
        let (mut faults, mut feasible) = (0, 0);
        let mut reasons: BTreeMap<String, u64> = BTreeMap::new();
        let (mut front, mut shown): (Vec<FrontRow>, Vec<Vec<String>>) = (Vec::new(), Vec::new());
        let (step, mut number) = (self.count().div_ceil(SHOWN).max(1), 0);
        each_row(&mut open()?, |line, row| {
            let values = numbers(row);
            all.iter_mut().zip(&values).for_each(|(of, value)| value.iter().for_each(|value| of.add(*value)));
            let fault = row.get(last).map_or("", String::as_str);
            if !fault.is_empty() {
                faults += 1;
                if reasons.len() < REASONS || reasons.contains_key(fault) {
                    *reasons.entry(fault.to_owned()).or_insert(0) += 1;
                }
            }
            let kept = if self.constraints.is_empty() {
                fault.is_empty()
            } else {
                row.get(last - 1).is_some_and(|cell| cell == "true")
            };
            feasible += u64::from(kept);
            if kept && self.kind == StudyKind::Pareto {
                let ordered: Vec<Option<f64>> =
                    row.iter().zip(&values).map(|(cell, value)| order(cell, *value)).collect();
                self.enter(&mut front, &ordered, line);
            }
            if number % step == 0 {
                shown.push(row.to_vec());
            }
            number += 1;
        })?;
        each_row(&mut open()?, |_, row| {
            for (of, value) in all.iter_mut().zip(numbers(row)) {
                if let Some(value) = value {
                    of.place(value);
                }
            }
        })?;
        let mut reasons: Vec<(String, u64)> = reasons.into_iter().collect();
        reasons.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let columns = all.into_iter().skip(first).filter(|of| of.count > 0).collect();
        Ok(Summary {
            faults,
            feasible,
            columns,
            reasons,
            front: front.into_iter().map(|(_, line)| line).collect(),
            shown,
        })
    }

    /// The row joins the front where no row of it beats it, and removes those that it beats. Equal rows stay together.
    fn enter(&self, front: &mut Vec<FrontRow>, values: &[Option<f64>], line: &str) {
        let first = 1 + self.parameters.len();
        let own = self.objectives.iter().map(|objective| {
            let value = values.get(first + objective.column).copied().flatten()?;
            Some(if objective.goal == Goal::Least { value } else { -value })
        });
        let Some(own) = own.collect::<Option<Vec<f64>>>() else { return };
        if front.iter().any(|(other, _)| beats(other, &own)) {
            return;
        }
        front.retain(|(other, _)| !beats(&own, other));
        front.push((own, line.to_owned()));
    }

    /// The summary for programs; `csv` is the hash of the table.
    #[must_use]
    pub fn summary_json(&self, summary: &Summary, csv: &str) -> Value {
        let columns: serde_json::Map<String, Value> =
            summary.columns.iter().map(|of| (of.name.clone(), of.json())).collect();
        let reasons: Vec<Value> =
            summary.reasons.iter().map(|(fault, rows)| json!({"fault": fault, "rows": rows})).collect();
        json!({
            "schema": SCHEMA, "command": "study", "study": self.name, "kind": self.kind.word(), "base": self.base.stem(),
            "cam": self.command.word, "camgen": env!("CARGO_PKG_VERSION"), "digest": self.digest, "rows": self.count(),
            "proved": self.proves(), "faults": summary.faults, "feasible": summary.feasible, "front": summary.front.len(),
            "columns": columns, "reasons": reasons, "csv_sha256": csv,
        })
    }
}

/// The finite numbers of a row.
fn numbers(row: &[String]) -> Vec<Option<f64>> {
    row.iter().map(|cell| cell.parse().ok().filter(|number: &f64| number.is_finite())).collect()
}

/// Whether a row is at least as good in every objective as another one that differs from it.
fn beats(a: &[f64], b: &[f64]) -> bool {
    a != b && a.iter().zip(b).all(|(a, b)| a <= b)
}
