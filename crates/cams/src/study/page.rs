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
pub(super) fn write(study: &Study, summary: &Summary) -> Result<Vec<u8>, Refusal> {
    let names = cells(study.header().trim_end());
    let front: Vec<Vec<String>> = summary.front.iter().map(|line| cells(line)).collect();
    let columns = summary.columns.iter().filter(|of| of.name != super::row::FEASIBLE);
    let columns = columns.take(MOST_COLUMNS).map(|of| {
        let at = names.iter().position(|name| *name == of.name);
        json!({
            "name": of.name, "least": of.range.0, "largest": of.range.1, "mean": of.mean, "deviation": of.deviation(),
            "bars": of.bars(), "shown": numbers(at, &summary.shown), "front": numbers(at, &front),
        })
    });
    let columns: Vec<Value> = columns.collect();
    let feasible = names.iter().position(|name| name == super::row::FEASIBLE);
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

/// The numbers of a column in some rows; none where the column is missing or the cell is no number.
fn numbers(column: Option<usize>, rows: &[Vec<String>]) -> Vec<Option<f64>> {
    rows.iter().map(|row| row.get(column?)?.parse().ok()).collect()
}
