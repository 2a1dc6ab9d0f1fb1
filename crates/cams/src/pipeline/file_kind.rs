//! What a file is, by its content: every kind that camgen writes is known, with what can be judged of it.

use crate::body::Body;
use crate::reading::{self, step};
use crate::tool_files::{ToolFile, recognised};
use camgen_kernel::refusal::Refusal;
use std::borrow::Cow;

/// The kinds of files.
#[derive(Debug, Clone, Copy)]
pub enum FileKind {
    /// A drawing as DXF: what is none of the others.
    Dxf,
    /// A solid.
    Step,
    /// Another file that a machine runs.
    Tool(&'static dyn ToolFile),
    /// A file for readers or for other programs, from which nothing is cut, measured or moved: what it is.
    Shown(&'static str),
}

/// How files begin from which nothing is cut.
const SHOWN: [(&str, &str); 7] = [
    ("%pdf", "a sheet (PDF)"),
    ("<svg", "a sheet or a plot (SVG)"),
    ("<!doctype html", "a page (HTML)"),
    ("<html", "a page (HTML)"),
    ("{", "a report (JSON)"),
    ("solid ", "a mesh (STL)"),
    ("par1", "a table of a study (Parquet)"),
];
/// Bytes at the beginning of a file in which it is recognised.
const HEAD: usize = 4096;
/// A mesh in binary begins with so many bytes, then the number of its triangles, of so many bytes each.
const MESH_HEAD: usize = 84;
const TRIANGLE: usize = 50;
/// Ends that are joined where it only matters whether a file can be read, mm.
const JOINED: f64 = 1e-3;

/// A table of numbers that camgen does not know.
const TABLE: &str = "a table of numbers (CSV) whose first line does not name the columns of a table that camgen writes";
/// Rows of numbers by which a table is recognised.
const TABLE_ROWS: usize = 3;

/// The bytes of a file as camgen would have written them: a text without a byte order mark, and a table of a program that separates its
/// cells with semicolons (and writes numbers with a decimal comma) with commas.
pub(super) fn plain(bytes: &[u8]) -> Cow<'_, [u8]> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let head = bytes.split(|byte| *byte == b'\n').find(|line| !line.starts_with(b"#")).unwrap_or_default();
    let has = |mark: u8| head.contains(&mark);
    let is_of_name = |byte: &u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"_;".contains(byte);
    // A program has no such line: its words have no underscores.
    if !has(b';') || !has(b'_') || !head.trim_ascii().iter().all(is_of_name) {
        return Cow::Borrowed(bytes);
    }
    let mut is_comment = false;
    let mut at_start = true;
    let with_commas = bytes.iter().map(|byte| {
        is_comment = if at_start { *byte == b'#' } else { is_comment };
        at_start = *byte == b'\n';
        match byte {
            b',' if !is_comment => b'.',
            b';' if !is_comment => b',',
            other => *other,
        }
    });
    Cow::Owned(with_commas.collect())
}

/// Whether a text is a table of numbers, whatever its columns: several lines of numbers, all with as many cells.
fn is_table(head: &str) -> bool {
    let cells = |line: &str| -> Option<usize> {
        let separator = [';', '\t', ','].into_iter().find(|separator| line.contains(*separator))?;
        let cells: Vec<&str> = line.trim_end_matches(separator).split(separator).collect();
        let numbers = cells.iter().all(|cell| cell.trim().trim_matches('"').replace(',', ".").parse::<f64>().is_ok());
        (numbers && cells.len() > 1).then_some(cells.len())
    };
    let rows: Vec<Option<usize>> = head.lines().skip(1).take(TABLE_ROWS).map(cells).collect();
    rows.len() == TABLE_ROWS && rows.iter().all(|row| row.is_some() && rows.first() == Some(row))
}

impl FileKind {
    /// The kind of a file.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let plain = plain(bytes);
        let bytes = &*plain;
        if step::is_step(bytes) {
            return Self::Step;
        }
        if let Some(file) = recognised(bytes) {
            return Self::Tool(file);
        }
        shown(bytes).map_or(Self::Dxf, Self::Shown)
    }

    /// Refuses a file from which nothing is cut, or of which there is none for a body.
    ///
    /// # Errors
    /// [`Refusal`] with what the file is.
    pub(super) fn of_body(self, body: &dyn Body) -> Result<(), Refusal> {
        let (what, unfit) = match self {
            Self::Dxf | Self::Step => return Ok(()),
            Self::Shown(what) => return Err(not_cut(what)),
            Self::Tool(file) => (file.facts().described, file.unfit(body)),
        };
        unfit.map_or(Ok(()), |why| Err(Refusal::new(format!("{what}, and a {} has none: {why}", body.kind().noun))))
    }

    /// Refuses what cannot be read, whatever the design.
    ///
    /// # Errors
    /// [`Refusal`] with the cause.
    pub fn readable(bytes: &[u8]) -> Result<(), Refusal> {
        let plain = plain(bytes);
        let bytes = &*plain;
        match Self::of(bytes) {
            Self::Dxf => reading::read(bytes, JOINED).map(drop),
            Self::Step => step::read(bytes).map(drop),
            Self::Tool(file) => file.read(bytes),
            Self::Shown(what) => Err(not_cut(what)),
        }
    }
}

/// That nothing is cut, measured or moved by a file.
fn not_cut(what: &str) -> Refusal {
    if what == TABLE {
        let refusal = Refusal::new(what);
        return refusal.remedy("name its columns as camgen does, or compare measured points with camgen compare");
    }
    let refusal =
        Refusal::new(format!("{what}, from which nothing is cut, measured or moved: there is nothing to prove"));
    refusal.remedy("check the DXF, the STEP file, a program or a table of the same run")
}

/// What a file for readers is; `None` where it is not known as one.
fn shown(bytes: &[u8]) -> Option<&'static str> {
    let count = bytes.get(MESH_HEAD - 4..MESH_HEAD).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    let mesh = count.and_then(|count| usize::try_from(count).ok()).filter(|count| *count > 0);
    if mesh.and_then(|count| count.checked_mul(TRIANGLE)).is_some_and(|size| size + MESH_HEAD == bytes.len()) {
        return Some("a mesh (STL)");
    }
    let head = String::from_utf8_lossy(bytes.get(..bytes.len().min(HEAD)).unwrap_or_default()).to_ascii_lowercase();
    let head = head.trim_start_matches('\u{feff}').trim_start();
    if let Some((_, what)) = SHOWN.iter().find(|(start, _)| head.starts_with(start)) {
        return Some(what);
    }
    if head.starts_with("<?xml") && head.contains("<svg") || head.starts_with("<!--") && head.contains("<svg") {
        return Some("a sheet or a plot (SVG)");
    }
    let tables = head.lines().filter(|line| line.starts_with('[') && line.trim_end().ends_with(']')).count();
    let keys = head.lines().filter(|line| line.contains(" = ")).count();
    if tables > 0 && keys > 1 {
        return Some("a design file (TOML)");
    }
    is_table(head).then_some(TABLE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a file is in a word: its check, or what else it is.
    fn known_as(bytes: &[u8]) -> &'static str {
        match FileKind::of(bytes) {
            FileKind::Dxf => "dxf",
            FileKind::Step => "step",
            FileKind::Tool(file) => file.facts().check.name,
            FileKind::Shown(what) => what,
        }
    }

    #[test]
    fn every_kind_is_known_by_its_beginning() {
        for (text, kind) in [
            ("ISO-10303-21;\n", "step"),
            ("%\nO1\nG21G17G90G40\n", "program"),
            ("G90 G1 X1 F2\n", "program"),
            ("0 BEGIN PGM A MM\n", "program"),
            ("cam_deg,lift_mm\n0,1\n", "table"),
            ("pass,tool_mm,a_deg\n1,2,3\n", "table"),
            ("# units: mm\ncam_deg,radius_mm\n0,1\n", "points"),
            ("DMISMN/'A',05.2\n", "inspection"),
            ("1 10 0 0 1 0 0\n", "inspection"),
            ("# a\ncam_deg,distance_mm,lift_mm\n", "gauge"),
            ("Tabletype = 3\nBegintable\n", "servo"),
            ("# G17 G90 G21\ncam_deg,distance_mm,lift_mm\n", "gauge"),
            ("%PDF-1.7\n", "a sheet (PDF)"),
            ("<?xml version=\"1.0\"?>\n<svg>", "a sheet or a plot (SVG)"),
            ("<!doctype html>", "a page (HTML)"),
            ("{\"schema\": 1}", "a report (JSON)"),
            ("name = \"A\"\n[motion]\nrpm = 3\n", "a design file (TOML)"),
            ("  0\nSECTION\n  2\nENTITIES\n", "dxf"),
            ("\u{feff}cam_deg,lift_mm\n0,1\n", "table"),
            ("cam_deg;lift_mm\n0;1,5\n", "table"),
            ("\u{feff}cam_deg;radius_mm\r\n0;1,5\r\n", "points"),
            ("Winkel;Hub\n0;1,5\n1;1,6\n2;1,7\n", TABLE),
            ("999\na comment\n0\nSECTION\n", "dxf"),
        ] {
            assert_eq!(known_as(text.as_bytes()), kind, "{text}");
        }
    }
}
