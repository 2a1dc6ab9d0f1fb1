//! The rows of a study read back from its CSV.

use std::io::{self, BufRead};

/// The cells of a line.
#[must_use]
pub(super) fn cells(line: &str) -> Vec<String> {
    let (mut all, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '"' if quoted && rest.peek() == Some(&'"') => {
                rest.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => all.push(std::mem::take(&mut cell)),
            other => cell.push(other),
        }
    }
    all.push(cell);
    all
}

/// Hands on every row of a table but its header, with its line; `take` stops nothing.
pub(super) fn each_row(table: &mut dyn BufRead, mut take: impl FnMut(&str, &[String])) -> io::Result<()> {
    for line in table.lines().skip(1) {
        let line = line?;
        take(&line, &cells(&line));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_in_quotes_are_one() {
        assert_eq!(cells("1,\"a, \"\"b\"\"\",,2"), ["1", "a, \"b\"", "", "2"]);
    }
}
