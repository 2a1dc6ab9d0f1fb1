//! Tables as CSV: a header line, then numbers, the shortest that round-trip, unquoted.

use super::number::shortest;
use super::{Format, When, fits_all};
use crate::table::Table;

/// The point table.
pub const FORMAT: Format = Format {
    name: "csv",
    when: When::Usual,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".csv".into()],
    write: |cam| Ok(vec![write(&Table::of(&cam.body.rows(cam.samples)))]),
};

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
