//! The page of a study: a histogram of each column, the scatter of each against each, and the front.

use super::specification::Study;
use super::summary::Summary;
use super::table::cells;
use crate::catalogue::checks;
use crate::report::shown;
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
        let limit = limit_of(study, &of.name);
        json!({
            "name": of.name, "label": label(&of.name), "limit": limit, "least": of.range.0, "largest": of.range.1, "mean": of.mean, "deviation": of.deviation(),
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
            "digest": study.digest(), "ends": front_at_ends(study, summary, &names, &front),
        }),
    )
}

/// The numbers of a column in some rows; none where the column is missing or the cell is no number.
fn numbers(column: Option<usize>, rows: &[Vec<String>]) -> Vec<Option<f64>> {
    rows.iter().map(|row| row.get(column?)?.parse().ok()).collect()
}

/// Units as the names of columns end, and as a person writes them; longer endings first.
const UNITS: [(&str, &str); 27] = [
    ("_mm_per_rad2", "mm/rad²"),
    ("_rad_per_rad2", "rad/rad²"),
    ("_mm_per_rad", "mm/rad"),
    ("_rad_per_s2", "rad/s²"),
    ("_rad_per_s", "rad/s"),
    ("_m_per_s2", "m/s²"),
    ("_m_per_s", "m/s"),
    ("_n_per_mm", "N/mm"),
    ("_N_per_mm", "N/mm"),
    ("_percent", "%"),
    ("_mm2", "mm²"),
    ("_mm3", "mm³"),
    ("_deg", "°"),
    ("_mpa", "MPa"),
    ("_MPa", "MPa"),
    ("_rpm", "rpm"),
    ("_rad", "rad"),
    ("_bar", "bar"),
    ("_mm", "mm"),
    ("_um", "µm"),
    ("_kg", "kg"),
    ("_nm", "N·m"),
    ("_at", "at"),
    ("_in", "in"),
    ("_pa", "Pa"),
    ("_n", "N"),
    ("_s", "s"),
];

/// Names that say little without the table that they are in.
const PLAIN: [&str; 12] = [
    "radius",
    "diameter",
    "distance",
    "mass",
    "width",
    "thickness",
    "offset",
    "length",
    "height",
    "speed",
    "stiffness",
    "preload",
];

/// A column for a person: what it is, and its unit, without the path of its key. A parameter is told from the figure of the same name.
fn label(column: &str) -> String {
    let (path, is_set) = column.strip_prefix("set.").map_or((column, false), |path| (path, true));
    let parts: Vec<&str> = path.split('.').collect();
    if let ["checks", check, figure, ..] = parts.as_slice() {
        let unit = checks().find(|known| known.name == *check).map_or("", |known| known.unit);
        let unit = if unit == "deg" { "°" } else { unit };
        let unit =
            if *figure == "value" && unit != "1" && !unit.is_empty() { format!(", {unit}") } else { String::new() };
        let figure = if *figure == "value" { String::new() } else { format!(", {}", figure.replace('_', " ")) };
        return capitalised(&format!("{}{figure}{unit}", check.replace('_', " ")));
    }
    let last = parts.last().copied().unwrap_or(path);
    let ending = UNITS.iter().find(|(ending, _)| last.len() > ending.len() && last.ends_with(ending));
    let (name, unit) = ending.map_or((last, String::new()), |(ending, unit)| {
        (last.strip_suffix(ending).unwrap_or(last), format!(", {unit}"))
    });
    let table = parts.len().checked_sub(2).and_then(|at| parts.get(at)).filter(|_| PLAIN.contains(&name));
    let table = table.map_or_else(String::new, |table| format!("{table} ").replace(['_', '-'], " "));
    let set = if is_set { " (varied)" } else { "" };
    capitalised(&format!("{table}{}{set}{unit}", name.replace('_', " ")))
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// The limits of a column by the constraints, least and largest; `None` for a side without one.
fn limit_of(study: &Study, column: &str) -> [Option<f64>; 2] {
    let mut limits =
        study.constraints().iter().filter(|limit| study.columns().get(limit.column).is_some_and(|name| name == column));
    let finite = |limit: f64| Some(limit).filter(|limit| limit.is_finite());
    limits.next().map_or([None; 2], |limit| [finite(limit.within.0), finite(limit.within.1)])
}

/// A value this near to an end of its range, over the range, lies at the end; and the share of the front from which on it is told.
const AT_END: f64 = 0.05;
const MOST_OF_FRONT: f64 = 0.6;

/// Where most of the front lies at an end of a range that was searched: a better design may lie beyond.
fn front_at_ends(study: &Study, summary: &Summary, names: &[String], front: &[Vec<String>]) -> Vec<String> {
    let mut told = Vec::new();
    for parameter in study.parameters() {
        let column = parameter.column();
        let Some(of) = summary.columns.iter().find(|of| of.name == column) else { continue };
        let (low, high) = of.range;
        let values: Vec<f64> =
            numbers(names.iter().position(|name| *name == column), front).into_iter().flatten().collect();
        for (end, word) in [(low, "least"), (high, "largest")] {
            let near = values.iter().filter(|value| (*value - end).abs() <= AT_END * (high - low)).count();
            #[expect(clippy::cast_precision_loss, reason = "a few designs")]
            let share = near as f64 / values.len().max(1) as f64;
            if high > low && values.len() > 1 && share >= MOST_OF_FRONT {
                let name = label(&column).replace(" (varied)", "");
                told.push(format!(
                    "{near} of {} designs of the front lie at the {word} value searched of {name}: about {}. Widen its range.",
                    values.len(),
                    shown(end)
                ));
            }
        }
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_have_names_with_units() {
        for (column, name) in [
            ("set.cam.base_radius_mm", "Base radius (varied), mm"),
            ("cam.base_radius_mm", "Base radius, mm"),
            ("set.follower.swinging-roller.radius_mm", "Swinging roller radius (varied), mm"),
            ("checks.pressure_angle.value", "Pressure angle, °"),
            ("checks.contact_stress.value", "Contact stress, MPa"),
            ("checks.contact_stress.verdict", "Contact stress, verdict"),
            ("passed", "Passed"),
        ] {
            assert_eq!(label(column), name);
        }
    }
}
