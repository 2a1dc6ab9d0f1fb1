//! Tables as CSV: a header line, then numbers, the shortest that round-trip, unquoted.

use super::number::shortest;
use crate::drawing::Table;

/// The table as text with line feeds.
#[must_use]
pub fn write(table: &Table) -> Vec<u8> {
    let mut text = table.columns.join(",");
    text.push('\n');
    for row in &table.rows {
        let cells: Vec<String> = row.iter().map(|value| shortest(*value)).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text.into_bytes()
}
