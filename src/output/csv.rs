//! Tables as CSV: a header line, then numbers, the shortest that round-trip, unquoted.

use super::number::shortest;
use crate::drawing::Table;

/// The table as text with line feeds.
#[must_use]
pub fn write(table: &Table) -> Vec<u8> {
    let mut text = table.columns.join(",");
    text.push('\n');
    for row in &table.rows {
        for (index, value) in row.iter().enumerate() {
            if index > 0 {
                text.push(',');
            }
            text.push_str(&shortest(*value));
        }
        text.push('\n');
    }
    text.into_bytes()
}
