//! A file with columns of numbers, which another file names.

use super::fault::{Excerpt, LONGEST_LINE, Misfit};
use super::heading::HeadingUnit;
use super::input::exact;
use super::named::NamedFiles;
use crate::units;

/// Largest file, bytes.
const LARGEST: u64 = 1 << 20;
/// Most rows.
const MOST_ROWS: usize = 20_000;

/// Rows of cells, each with its line, and the headings above them.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// The file as it was named.
    name: String,
    /// The heading of each column, where the file has one for each.
    headings: Vec<String>,
    /// The rows in the order of the file, at least one.
    pub rows: Vec<FileRow>,
}

/// A row of cells.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRow {
    cells: Vec<String>,
    line: usize,
    text: String,
}

impl FileRow {
    /// How many cells it has.
    #[must_use]
    pub fn width(&self) -> usize {
        self.cells.len()
    }

    /// Its line in the file, from 1 on.
    #[must_use]
    pub fn line(&self) -> usize {
        self.line
    }

    /// A cell as it was written, counted from 0; empty where the row ends before it.
    #[must_use]
    pub fn cell(&self, column: usize) -> &str {
        self.cells.get(column).map_or("", String::as_str)
    }

    /// A cell for a message: what is no number is cut to a few characters, because a machine file of somebody else may name any file.
    #[must_use]
    pub fn shown(&self, column: usize) -> String {
        few(self.cell(column))
    }

    /// The number of a cell, with a decimal point or a decimal comma.
    #[must_use]
    pub fn number(&self, column: usize) -> Option<f64> {
        number(self.cell(column))
    }

    /// The number of a row with one decimal comma and nothing else, which reads like two cells too.
    #[must_use]
    pub fn with_decimal_comma(&self) -> Option<f64> {
        let text = self.text.split('#').next().unwrap_or_default().trim();
        (!text.contains(';') && self.width() == 2).then(|| number(text)).flatten()
    }

    /// The two numbers of a row that has no other cells.
    fn pair(&self) -> Option<[f64; 2]> {
        if self.width() == 2 { self.number(0).zip(self.number(1)).map(|(a, b)| [a, b]) } else { None }
    }

    /// A comma-separated heading with its decimal commas rejoined if it has more than `width` cells: `deg,lift 0,01 mm`.
    fn with_decimals_joined(&self, width: usize) -> Self {
        let mut cells: Vec<String> = Vec::new();
        for cell in &self.cells {
            let begins_with_digit = cell.starts_with(|c: char| c.is_ascii_digit());
            let before = cells.last_mut().filter(|before| before.ends_with(|c: char| c.is_ascii_digit()));
            match before.filter(|_| begins_with_digit) {
                Some(before) if self.width() > width => *before = format!("{before},{cell}"),
                _ => cells.push(cell.clone()),
            }
        }
        Self { cells, ..self.clone() }
    }

    fn canonical(&self) -> String {
        (0..self.width())
            .map(|at| self.number(at).map_or_else(|| self.cell(at).to_owned(), exact))
            .collect::<Vec<_>>()
            .join(" ")
    }
}

/// A cell as a number. One comma and no point is a decimal comma.
fn number(cell: &str) -> Option<f64> {
    units::parse_bare(cell).ok().or_else(|| {
        let comma = cell.matches(',').count() == 1 && !cell.contains('.');
        if comma { units::parse_bare(&cell.replace(',', ".")).ok() } else { None }
    })
}

/// What is wrong with a file, and the line where.
pub(super) type ColumnsFault = (Misfit, Option<Box<Excerpt>>);

fn refused<T>(message: String, help: &str, place: Option<Excerpt>) -> Result<T, ColumnsFault> {
    Err((Misfit { message, help: Some(help.to_owned()) }, place.map(Box::new)))
}

impl Columns {
    /// The name of the file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The headings, empty where the file has none that fit its columns.
    #[must_use]
    pub fn headings(&self) -> &[String] {
        &self.headings
    }

    /// A row as the place of a fault.
    pub(super) fn excerpt(&self, row: usize) -> Option<Excerpt> {
        self.rows.get(row).map(|row| excerpt(&self.name, row.line, &row.text))
    }

    /// The one text of its data. Headings count where they name another unit than degrees and millimetres, or choose among columns.
    pub(super) fn canonical(&self) -> String {
        let plain = |heading: &String| {
            HeadingUnit::in_heading(heading).is_none_or(|unit| ["deg", "mm"].contains(&unit.symbol()))
        };
        let of_pairs = self.rows.iter().all(|row| row.pair().is_some());
        let headings: &[String] = if of_pairs && self.headings.iter().all(plain) { &[] } else { &self.headings };
        let rows = self.rows.iter().map(FileRow::canonical);
        headings.iter().cloned().chain(rows).collect::<Vec<_>>().join(", ")
    }

    /// Reads a file by its name; `key` names the key in messages. A path that the user gave leads to any folder.
    pub(super) fn read(files: &NamedFiles, name: &str, key: &str, by_user: bool) -> Result<Self, ColumnsFault> {
        let text = files.text(name, key, LARGEST, by_user).map_err(|misfit| (misfit, None))?;
        Self::parse(name, &text)
    }

    /// The text of the file that was read, where it is still there.
    pub(super) fn text(&self, files: &NamedFiles, by_user: bool) -> Option<String> {
        files.text(&self.name, "", LARGEST, by_user).ok()
    }

    fn parse(name: &str, text: &str) -> Result<Self, ColumnsFault> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut rows: Vec<FileRow> = Vec::new();
        // Lines above the first row: their cells, and the line as it is.
        let mut above: Vec<(FileRow, bool)> = Vec::new();
        for (index, whole) in text.lines().enumerate() {
            let line = whole.split('#').next().unwrap_or_default().trim();
            if line.is_empty() {
                continue;
            }
            let text = whole.chars().take(LONGEST_LINE).collect();
            let row = FileRow { cells: cells(line), line: index + 1, text };
            let numbers = (0..row.width()).filter(|at| row.number(*at).is_some()).count();
            // The first row of data begins with a number.
            if rows.is_empty() && row.number(0).is_none() && above.len() < MOST_ABOVE {
                above.push((row, numbers > 0));
                continue;
            }
            if rows.len() >= MOST_ROWS {
                let place = Some(excerpt(name, index + 1, whole));
                return refused(format!("more than {MOST_ROWS} rows"), "remove some rows", place);
            }
            rows.push(row);
        }
        let Some(first) = rows.first() else {
            return refused(format!("{} has no rows", quoted(name)), "each row is two numbers", None);
        };
        // A row whose first number is misspelt is no heading.
        if let Some((row, _)) = above.iter().find(|(row, numbers)| *numbers && row.width() == first.width()) {
            let message = format!("a row of {} is not two numbers: `{}` is not a number", quoted(name), row.shown(0));
            let help = "write a number, or remove the line";
            return refused(message, help, Some(excerpt(name, row.line, &row.text)));
        }
        let above: Vec<FileRow> = above.into_iter().map(|(row, _)| row).collect();
        let headings = headings(&above, &rows);
        Ok(Self { name: name.to_owned(), headings, rows })
    }
}

/// Most lines above the first row.
const MOST_ABOVE: usize = 50;

/// Cells without quotes, and without empty ones at the end.
fn kept(cells: &[&str]) -> Vec<String> {
    let mut cells: Vec<String> = cells.iter().map(|cell| unquoted(cell.trim()).trim().to_owned()).collect();
    while cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    cells
}

/// The cells of a line: between semicolons, tabulators or commas, or else between blanks. Commas are decimal where blanks, tabulators or
/// semicolons separate the cells.
fn cells(line: &str) -> Vec<String> {
    if line.contains(';') {
        return kept(&parts(line, ';'));
    }
    if line.contains('\t') {
        let cells = parts(line, '\t').into_iter().map(|cell| cell.trim().trim_end_matches(','));
        return kept(&cells.collect::<Vec<_>>());
    }
    let blanks: Vec<&str> = line.split_whitespace().collect();
    if line.contains(',') {
        let any = blanks.iter().any(|cell| cell.contains(','));
        if !(blanks.len() > 1 && any && blanks.iter().all(|cell| number(cell).is_some())) {
            return kept(&parts(line, ','));
        }
    }
    // What stands in brackets belongs to the word before it.
    let mut joined: Vec<String> = Vec::new();
    for cell in blanks {
        match joined.last_mut().filter(|_| cell.starts_with(['(', '['])) {
            Some(before) => *before = format!("{before} {cell}"),
            None => joined.push(unquoted(cell)),
        }
    }
    joined
}

/// The parts of a line between signs, but for those inside of a part in quotes.
#[must_use]
pub fn parts(line: &str, sign: char) -> Vec<&str> {
    let (mut found, mut from, mut quoted, mut fresh) = (Vec::new(), 0, false, true);
    for (at, letter) in line.char_indices() {
        if letter == '"' {
            quoted = fresh;
        } else if letter == sign && !quoted {
            found.extend(line.get(from..at));
            (from, fresh) = (at + letter.len_utf8(), true);
            continue;
        }
        fresh &= letter.is_whitespace();
    }
    found.extend(line.get(from..));
    // A quote that nothing ends is a sign like others.
    if quoted { line.split(sign).collect() } else { found }
}

/// A cell without the quotes around it, those within it once. A quote that stands only behind a cell is an inch mark, which it does not lose.
fn unquoted(cell: &str) -> String {
    let inner = cell.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    inner.map_or_else(|| cell.to_owned(), |inner| inner.replace("\"\"", "\""))
}

/// The heading of each column: the cells of the lines above the rows that have as many; of a list with one column the whole lines.
fn headings(above: &[FileRow], rows: &[FileRow]) -> Vec<String> {
    let width = rows.iter().map(FileRow::width).max().unwrap_or(0);
    let mut headings = vec![String::new(); width];
    for row in above {
        let row = &row.with_decimals_joined(width);
        if row.width() == width {
            for (heading, at) in headings.iter_mut().zip(0..) {
                let joined = format!("{heading} {}", row.cell(at));
                joined.trim().clone_into(heading);
            }
        } else if width == 1 {
            headings = vec![row.text.trim().to_owned()];
        } else {
            // As many units as columns, in words that cannot be told apart.
            let text = row.text.split('#').next().unwrap_or_default();
            let words = text.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';'));
            let units: Vec<&str> = words.filter(|word| HeadingUnit::in_heading(word).is_some()).collect();
            if units.len() == width {
                headings = units.into_iter().map(str::to_owned).collect();
            }
        }
    }
    if headings.iter().all(String::is_empty) { Vec::new() } else { headings }
}

fn quoted(name: &str) -> String {
    format!("`{name}`")
}

/// Characters of a text without meaning that a message shows.
const FEW: usize = 8;

/// A text as it is where it consists of numbers, otherwise its first characters.
fn few(text: &str) -> String {
    if text.chars().count() <= FEW
        || text.chars().all(|c| c.is_ascii_digit() || c.is_whitespace() || "+-.,;eE".contains(c))
    {
        return text.to_owned();
    }
    text.chars().take(FEW).chain(['…']).collect()
}

fn excerpt(name: &str, line: usize, text: &str) -> Excerpt {
    let text = few(text.trim_end());
    Excerpt::new(name, line, &text, (1, text.chars().count()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<[f64; 2]> {
        let columns = Columns::parse("lift.csv", text).expect(text);
        columns.rows.iter().map(|row| row.pair().expect(text)).collect()
    }

    #[test]
    fn rows_are_read_whatever_separates_them() {
        let wanted = [[0.0, 1.5], [10.0, -2e-3]];
        for text in [
            "0,1.5\n10,-2e-3\n",
            "0;1.5\r\n10;-2e-3",
            "\u{feff}angle, lift\n0\t1.5\n# a remark\n\n10  -2e-3 # the last\n",
            "  0 , 1.5\n10 ; -2e-3",
            "0;1,5\n10;-2e-3",
            "0\t1,5\n10\t-0,002",
            "0 1,5\n10,0 -0,002",
            "\"0\",\"1.5\"\n\"10\",\"-2e-3\",\n",
            "\"0\",\"1,5\"\n\"10,0\", \"-0,002\"\n",
            "\"angle; cam\";\"lift\"\n\"0\";\"1,5\"\n\"10,0\";\"-0,002\"\n",
            "Cam of 1998\nangle;lift\ndeg;mm\n0;1,5;\n10;-0,002;\n",
        ] {
            assert_eq!(rows(text), wanted, "{text:?}");
        }
    }

    #[test]
    fn signs_within_quotes_part_nothing() {
        for (line, wanted) in [
            ("\"0,5\",1", &["\"0,5\"", "1"][..]),
            ("a \"b, c\",1", &["a \"b", " c\"", "1"]),
            ("\"0.5, 1", &["\"0.5", " 1"]),
            ("0.5\", 1\"", &["0.5\"", " 1\""]),
            ("", &[""]),
        ] {
            assert_eq!(parts(line, ','), wanted, "{line}");
        }
    }

    #[test]
    fn headings_are_those_of_the_columns() {
        for (text, wanted) in [
            ("angle (rad),lift (mm)\n0,1\n", &["angle (rad)", "lift (mm)"][..]),
            ("angle;lift\ndeg;in\n0;1\n", &["angle deg", "lift in"]),
            ("Angle (deg)  Lift (mm)\n0 1\n", &["Angle (deg)", "Lift (mm)"]),
            ("cam angle deg, lift of valve mm, remark\n0 1\n", &["deg", "mm"]),
            ("LOBE 7  0.31496\n0.0\n0.1\n", &["LOBE 7  0.31496"]),
            ("a,b,c\n0,1,2\n1,2\n", &["a", "b", "c"]),
            ("angle;lift \"\n0;1\n", &["angle", "lift \""]),
            ("\"angle\",\"lift (\"\")\"\n0,1\n", &["angle", "lift (\")"]),
            ("0,1\n", &[]),
        ] {
            let columns = Columns::parse("lift.csv", text).expect(text);
            let found: Vec<&str> = columns.headings().iter().map(String::as_str).collect();
            assert_eq!(found, wanted, "{text}");
        }
    }

    #[test]
    fn what_is_no_row_is_told_with_its_line() {
        for (text, line, part) in [
            ("O,1\n1,2\n", 1, "not two numbers"),
            ("angle,lift\nangle,lift\n", 0, "no rows"),
            ("# nothing\n", 0, "no rows"),
            ("nan 0\n1 2\n", 1, "not two numbers"),
        ] {
            let (misfit, place) = Columns::parse("lift.csv", text).expect_err(text);
            assert!(misfit.message.contains(part), "{text}: {misfit:?}");
            assert_eq!(place.map_or(0, |place| place.line), line, "{text}");
        }
        let many = "1 2\n".repeat(20_001);
        assert!(Columns::parse("lift.csv", &many).expect_err("too many").0.message.contains("more than 20000 rows"));
    }
}
