//! A file of two columns of numbers beside the file that names it.

use super::fault::{Excerpt, LONGEST_LINE};
use super::file;
use super::value::Misfit;
use crate::units;
use std::path::Path;

/// Largest file, bytes.
const LARGEST: u64 = 1 << 20;
/// Most rows.
const MOST_ROWS: usize = 20_000;

/// Rows of two numbers, each with its line.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// The file as it was named.
    name: String,
    /// The rows in the order of the file, at least one.
    pub rows: Vec<Row>,
}

/// Two numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// As they stand.
    pub values: [f64; 2],
    line: usize,
    text: String,
}

/// What is wrong with a file, and the line where.
pub(super) type Refused = (Misfit, Option<Box<Excerpt>>);

fn refused<T>(message: String, help: &str, place: Option<Excerpt>) -> Result<T, Refused> {
    Err((Misfit { message, help: Some(help.to_owned()) }, place.map(Box::new)))
}

impl Columns {
    /// A row as the place of a fault.
    pub(super) fn excerpt(&self, row: usize) -> Option<Excerpt> {
        self.rows.get(row).map(|row| excerpt(&self.name, row.line, &row.text))
    }

    /// Reads a file by its path from a folder; `key` names the key in messages.
    pub(super) fn read(folder: Option<&Path>, name: &str, key: &str) -> Result<Self, Refused> {
        let Some(folder) = folder else {
            let help = "put this machine into a file of its own, beside the table";
            return refused(format!("`{key}`: only a machine file in a folder can name another file"), help, None);
        };
        let text = file::text_of(&folder.join(name), LARGEST).or_else(|why| {
            let help = "give its path from the folder of the machine file";
            refused(format!("`{key}`: cannot read `{name}`: {why}"), help, None)
        })?;
        Self::parse(name, &text)
    }

    fn parse(name: &str, text: &str) -> Result<Self, Refused> {
        let mut rows = Vec::new();
        let mut header = true;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        for (index, whole) in text.lines().enumerate() {
            let line = whole.split('#').next().unwrap_or_default().trim();
            if line.is_empty() {
                continue;
            }
            let cells: Vec<&str> = line
                .split(|c: char| matches!(c, ',' | ';') || c.is_whitespace())
                .filter(|cell| !cell.is_empty())
                .collect();
            let numbers: Vec<Option<f64>> = cells.iter().map(|cell| units::parse_bare(cell).ok()).collect();
            if std::mem::take(&mut header) && numbers.iter().all(Option::is_none) {
                continue;
            }
            let place = Some(excerpt(name, index + 1, whole));
            let [Some(first), Some(second)] = numbers.as_slice() else {
                let help = "each row is two numbers with `,`, `;`, a tab or blanks between them, decimals with a point";
                return refused(format!("a row of {} is not two numbers", quoted(name)), help, place);
            };
            if rows.len() >= MOST_ROWS {
                return refused(format!("more than {MOST_ROWS} rows"), "leave some out", place);
            }
            let text = whole.chars().take(LONGEST_LINE).collect();
            rows.push(Row { values: [*first, *second], line: index + 1, text });
        }
        if rows.is_empty() {
            return refused(format!("{} has no rows", quoted(name)), "each row is two numbers", None);
        }
        Ok(Self { name: name.to_owned(), rows })
    }
}

fn quoted(name: &str) -> String {
    format!("`{name}`")
}

fn excerpt(name: &str, line: usize, text: &str) -> Excerpt {
    let marked = text.trim_end().chars().count();
    Excerpt::of(name, line, text, (1, marked))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<[f64; 2]> {
        Columns::parse("lift.csv", text).expect(text).rows.iter().map(|row| row.values).collect()
    }

    #[test]
    fn rows_are_read_whatever_separates_them() {
        let wanted = [[0.0, 1.5], [10.0, -2e-3]];
        for text in [
            "0,1.5\n10,-2e-3\n",
            "0;1.5\r\n10;-2e-3",
            "\u{feff}angle, lift\n0\t1.5\n# a remark\n\n10  -2e-3 # the last\n",
            "  0 , 1.5\n10 ; -2e-3",
        ] {
            assert_eq!(rows(text), wanted, "{text:?}");
        }
    }

    #[test]
    fn what_is_no_row_is_told_with_its_line() {
        for (text, line, part) in [
            ("0,1\n1;2;3\n", 2, "not two numbers"),
            ("angle,lift\nangle,lift\n", 2, "not two numbers"),
            ("0,x\n", 1, "not two numbers"),
            ("# nothing\n", 0, "no rows"),
            ("0 nan\n", 1, "not two numbers"),
        ] {
            let (misfit, place) = Columns::parse("lift.csv", text).expect_err(text);
            assert!(misfit.message.contains(part), "{text}: {misfit:?}");
            assert_eq!(place.map_or(0, |place| place.line), line, "{text}");
        }
        let many = "1 2\n".repeat(20_001);
        assert!(Columns::parse("lift.csv", &many).expect_err("too many").0.message.contains("more than 20000 rows"));
    }
}
