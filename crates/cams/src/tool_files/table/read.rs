//! Reads tables of numbers under the names of their columns, as `--format csv` writes them.

use camgen_kernel::units::{LengthUnit, metric_column};

/// A table as it was read, its lengths in millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberTable {
    /// Names of its columns.
    pub columns: Vec<String>,
    /// Its rows, as many numbers each; not a number where a cell is `NaN`.
    pub rows: Vec<Vec<f64>>,
}

impl NumberTable {
    /// With the columns of inches as those of millimetres.
    fn in_millimetres(mut self) -> Self {
        for (at, name) in self.columns.iter_mut().enumerate() {
            let (metric, power) = metric_column(name);
            let metric = metric.into_owned();
            for value in self.rows.iter_mut().filter_map(|row| row.get_mut(at)) {
                *value = LengthUnit::Inch.of_mm_to(*value, -power);
            }
            *name = metric;
        }
        self
    }
}

/// Most rows, and most columns.
const MOST_ROWS: usize = 4_000_000;
const MOST_COLUMNS: usize = 200;

/// The names in the first line of a text; `None` where that does not name columns.
fn names(text: &str) -> Option<Vec<String>> {
    let line = text.lines().next()?.trim_end();
    let names: Vec<String> = line.split(',').take(MOST_COLUMNS).map(str::to_owned).collect();
    let is_name = |name: &String| {
        let letters = name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_');
        letters && name.starts_with(|c: char| c.is_ascii_lowercase())
    };
    (names.len() > 1 && names.iter().all(is_name)).then_some(names)
}

/// Whether bytes are such a table.
pub(super) fn is_table(bytes: &[u8]) -> bool {
    let head = bytes.get(..bytes.len().min(8192)).unwrap_or_default();
    names(&String::from_utf8_lossy(head)).is_some()
}

/// Reads a table.
///
/// # Errors
/// A sentence when it is not one, with the row.
pub fn read(bytes: &[u8]) -> Result<NumberTable, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let columns = names(text).ok_or("its first line does not name columns")?;
    let row = |(index, line): (usize, &str)| {
        let numbers: Option<Vec<f64>> = line.split(',').map(|cell| cell.trim().parse().ok()).collect();
        let numbers = numbers.filter(|numbers| numbers.len() == columns.len());
        numbers.ok_or_else(|| format!("row {} has not {} numbers", index + 1, columns.len()))
    };
    let lines = text.lines().skip(1).filter(|line| !line.trim().is_empty());
    let rows: Vec<Vec<f64>> = lines.take(MOST_ROWS).enumerate().map(row).collect::<Result<_, _>>()?;
    if rows.is_empty() { Err("it has no rows".into()) } else { Ok(NumberTable { columns, rows }.in_millimetres()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_names_and_as_many_numbers_in_each_row() {
        let table = read(b"cam_deg,lift_mm\n0,1\n0.5,NaN\n").expect("a table");
        assert_eq!((table.columns.len(), table.rows.len(), table.rows[1][0]), (2, 2, 0.5));
        assert!(is_table(b"cam_deg,lift_mm\r\n") && !is_table(b"0,1\n") && !is_table(b"  0\nSECTION\n"));
        let inches = read(b"cam_deg,lift_in\n0,1\n").expect("a table");
        assert_eq!((inches.columns[1].as_str(), inches.rows[0][1]), ("lift_mm", 25.4));
        assert!(read(b"cam_deg,lift_mm\n0,1\n0.5\n").is_err_and(|why| why.contains("row 2")));
    }
}
