//! A table of a cam that somebody else may have changed, compared with the numbers of the cam, row by row and column by column.

use super::read::NumberTable;
use crate::body::Body;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Place, Verdict, shown};
use crate::table::Table;
use crate::verify::Evidence;

pub(super) const CHECK: Check = Check {
    name: "table",
    on: CheckScope::ToolFile,
    unit: "",
    about: "The largest difference between the numbers of a table of --format csv that is checked and those of the cam, over what is allowed: the \
            tolerance for lengths, a millionth of the largest number of the column for others.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |number of the table − number of the cam| / allowed",
        usual: "1: within what is allowed",
        change: "write the table anew: camgen make FILE --format csv",
    },
};

/// Share of the largest number of a column by which its numbers may differ, where they are not lengths.
const SHARE: f64 = 1e-6;
/// What the names of columns have that depend on the outline as it was cut, or on another cam.
const NOT_COMPARED: [&str; 3] = ["_cut", "compensator_torque_nm", "torque_left_nm"];
/// Numbers of samples of which the tables of a body are made to see how many rows a sample gives, and how far the number of a table may be off what follows.
const TRIED: [u32; 2] = [8, 80];
const OFF: i32 = 4;

/// The finding on a table as it was read.
pub(super) fn judge(evidence: &Evidence<'_>, table: Result<NumberTable, String>) -> Finding {
    match table.and_then(|table| judged(evidence, &table)) {
        Err(why) => Finding { note: Some(why.into()), ..CHECK.found(f64::INFINITY, Some(1.0), Verdict::Fail) },
        Ok((value, words, place)) => {
            let found = CHECK.found(value, Some(1.0), Verdict::of(value <= 1.0));
            Finding { note: Some(words.into()), place, ..found }
        }
    }
}

/// The tables of a body with so many rows over a turn, a tool of a radius, m, in the further ones.
fn tables(body: &dyn Body, samples: u32, tool: Option<f64>) -> Vec<Table> {
    let mut all = vec![Table::from_rows(&body.rows(samples))];
    all.extend(body.further_tables(samples, tool));
    all
}

/// The table of the cam with the columns and as many rows as one that was read; a sentence where there is none.
fn table_of(evidence: &Evidence<'_>, read: &NumberTable) -> Result<Table, String> {
    let body = evidence.body;
    let known = |table: &Table| table.columns.iter().filter(|own| read.columns.iter().any(|name| name == *own)).count();
    // A smaller tool has a pass along either flank.
    let column = read.columns.iter().position(|name| name == "tool_mm");
    let tool = column.and_then(|column| read.rows.first()?.get(column)).map(|diameter| 0.5e-3 * diameter);
    let [few, more] = TRIED.map(|samples| tables(body, samples, tool));
    let most = few.iter().map(known).max().unwrap_or(0);
    let which = few.iter().position(|table| known(table) == most && most > 1);
    let which =
        which.ok_or_else(|| format!("a {} has no table with the column {}", body.kind().noun, read.columns[0]))?;
    let rows = [&few, &more].map(|all| all.get(which).map_or(0, |table| table.rows.len()));
    let samples = samples_of(read.rows.len(), rows).into_iter();
    let mut made = samples.filter_map(|samples| tables(body, samples, tool).into_iter().nth(which));
    let fitting = made.find(|table| table.rows.len() == read.rows.len());
    fitting.ok_or_else(|| format!("it has {} rows, and no table of this cam has so many", read.rows.len()))
}

/// With how many samples a table may have so many rows, the likeliest first, by the rows that it has with [`TRIED`].
fn samples_of(rows: usize, [few, more]: [usize; 2]) -> Vec<u32> {
    #[expect(clippy::cast_precision_loss, reason = "a table has fewer rows")]
    let [rows, few, more] = [rows, few, more].map(|count| count as f64);
    let [first, second] = TRIED.map(f64::from);
    let guess = first + ((rows - few) * (second - first) / (more - few).max(1.0)).round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of samples")]
    let at = |off: i32| (guess + f64::from(off)) as u32;
    (0..=OFF).flat_map(|off| [at(off), at(-off)]).filter(|samples| *samples > 0).collect()
}

/// The largest difference over what is allowed, in words, and where.
fn judged(evidence: &Evidence<'_>, read: &NumberTable) -> Result<(f64, String, Place), String> {
    let own = table_of(evidence, read)?;
    let mut worst = (0.0, String::new(), 0);
    let mut left_out = Vec::new();
    for (at, name) in read.columns.iter().enumerate() {
        let compared = !NOT_COMPARED.iter().any(|part| name.contains(part));
        let Some(column) = own.columns.iter().position(|own| own == name).filter(|_| compared) else {
            if compared {
                return Err(format!("the table of this cam has no column {name}"));
            }
            left_out.push(name.as_str());
            continue;
        };
        let of = |rows: &[Vec<f64>], row: usize, column: usize| rows.get(row).and_then(|row| row.get(column)).copied();
        let finite = own.rows.iter().filter_map(|row| row.get(column)).filter(|value| value.is_finite());
        let largest = finite.fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let length = name.ends_with("_mm") && !name.contains("curvature");
        let allowed = if length { evidence.tolerance_mm } else { SHARE * largest.max(SHARE) };
        for row in 0..read.rows.len() {
            let (found, due) = (of(&read.rows, row, at), of(&own.rows, row, column));
            let (Some(found), Some(due)) = (found, due) else { continue };
            let same = found == due || (found.is_nan() && due.is_nan());
            // A radius is compared as a curvature: where a curve is nearly straight it is of any size.
            let off = if name.contains("curvature_radius") {
                (1.0 / found - 1.0 / due).abs() / SHARE
            } else {
                (found - due).abs() / allowed
            };
            if !same && !(off <= worst.0) {
                let words = format!("row {}: {name} is {}, of the cam {}", row + 1, shown(found), shown(due));
                worst = (if off.is_nan() { f64::INFINITY } else { off }, words, row);
            }
        }
    }
    let mut words =
        format!("{} rows of {} columns, as the cam has them", read.rows.len(), read.columns.len() - left_out.len());
    if worst.0 > 1.0 {
        words = worst.1;
    }
    if !left_out.is_empty() {
        words.push_str(&format!(
            "; not compared, as they are of the outline as cut or of another cam: {}",
            left_out.join(", ")
        ));
    }
    let angle = read.columns.iter().position(|name| name == "cam_deg" || name == "a_deg");
    let angle = angle.filter(|_| worst.0 > 1.0).and_then(|column| read.rows.get(worst.2)?.get(column));
    Ok((worst.0, words, angle.map_or_else(Place::default, |deg| evidence.body.place(deg.to_radians()))))
}
