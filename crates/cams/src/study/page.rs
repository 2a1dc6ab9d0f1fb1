//! The page of a study: a histogram of each column, the scatter of each against each, and the front.

use super::specification::Study;
use super::summary::Summary;
use super::table::cells;
use crate::write::html;
use camgen_kernel::refusal::Refusal;
use serde_json::{Value, json};

/// Most columns whose scatter is shown.
const MOST_COLUMNS: usize = 8;

/// The page as a file.
///
/// # Errors
/// Only what `serde_json` cannot write, which a study is not.
pub(super) fn of(study: &Study, summary: &Summary) -> Result<Vec<u8>, Refusal> {
    let names = cells(study.header().trim_end());
    let place = |name: &str| names.iter().position(|other| other == name);
    let numbers = |at: Option<usize>, rows: &[Vec<String>]| -> Vec<Option<f64>> {
        rows.iter().map(|row| row.get(at?)?.parse().ok()).collect()
    };
    let front: Vec<Vec<String>> = summary.front.iter().map(|line| cells(line)).collect();
    let column = |of: &super::summary::Distribution| {
        let at = place(&of.name);
        json!({
            "name": of.name, "least": of.range.0, "largest": of.range.1, "mean": of.mean, "deviation": of.deviation(),
            "bars": of.bars(), "shown": numbers(at, &summary.shown), "front": numbers(at, &front),
        })
    };
    let columns = summary.columns.iter().filter(|of| of.name != super::row::FEASIBLE);
    let columns: Vec<Value> = columns.take(MOST_COLUMNS).map(column).collect();
    let feasible = place(super::row::FEASIBLE);
    let kept: Vec<bool> = summary
        .shown
        .iter()
        .map(|row| feasible.is_none_or(|at| row.get(at).is_some_and(|cell| cell == "true")))
        .collect();
    let objectives: Vec<&String> = study.objectives().iter().filter_map(|of| study.columns().get(of.column)).collect();
    let reasons: Vec<Value> = summary.reasons.iter().map(|(fault, rows)| json!([fault, rows])).collect();
    html::of_study(
        study.name(),
        &json!({
            "study": study.name(), "kind": study.kind().word(), "rows": study.count(), "faults": summary.faults,
            "feasible": summary.feasible, "columns": columns, "kept": kept, "objectives": objectives, "reasons": reasons,
            "digest": study.digest(),
        }),
    )
}
