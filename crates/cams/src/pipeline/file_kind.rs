//! What a file is, by its content: every kind that camgen writes is known, with what can be judged of it.

use crate::body::{Body, gauge, inspection, milling, servo};
use crate::reading::{
    self, gauge as read_gauge, gcode, inspection as read_inspection, servo as read_servo, step, table,
};
use crate::write::points;
use camgen_kernel::refusal::Refusal;

/// The kinds of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A drawing as DXF: what is none of the others.
    Dxf,
    /// A solid.
    Step,
    /// A program for a milling machine.
    Program,
    /// A table for a servo drive.
    Servo,
    /// A table of points for a control.
    Points,
    /// A list of places for a measuring machine.
    Places,
    /// The lift table of a gauge follower.
    Gauge,
    /// A table of numbers.
    Table,
    /// A file for readers or for other programs, from which nothing is cut, measured or moved: what it is.
    Shown(&'static str),
}

/// Whether bytes are those of a kind of file.
type Recognises = fn(&[u8]) -> bool;

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

impl FileKind {
    /// The kind of a file.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let known: [(Recognises, Self); 7] = [
            (step::is_step, Self::Step),
            (read_servo::is_servo, Self::Servo),
            (points::is_points, Self::Points),
            (read_inspection::is_inspection, Self::Places),
            (read_gauge::is_gauge, Self::Gauge),
            (table::is_table, Self::Table),
            (gcode::is_program, Self::Program),
        ];
        let found = known.iter().find(|(is_one, _)| is_one(bytes)).map(|(_, kind)| *kind);
        found.or_else(|| shown(bytes).map(Self::Shown)).unwrap_or(Self::Dxf)
    }

    /// Refuses a file from which nothing is cut, or of which there is none for a body.
    ///
    /// # Errors
    /// [`Refusal`] with what the file is.
    pub(super) fn of_body(self, body: &dyn Body) -> Result<(), Refusal> {
        let (what, unfit) = match self {
            Self::Dxf | Self::Step | Self::Points | Self::Table => return Ok(()),
            Self::Shown(what) => return Err(not_cut(what)),
            Self::Program => ("a program for a milling machine", milling::unfit(body)),
            Self::Servo => ("a table for a servo drive", servo::unfit(body)),
            Self::Places => ("a list of places for a measuring machine", inspection::unfit(body)),
            Self::Gauge => ("the lift table of a gauge follower", gauge::unfit(body)),
        };
        unfit.map_or(Ok(()), |why| Err(Refusal::new(format!("{what}, and a {} has none: {why}", body.kind().noun))))
    }

    /// Refuses what cannot be read, whatever the design.
    ///
    /// # Errors
    /// [`Refusal`] with the cause.
    pub fn readable(bytes: &[u8]) -> Result<(), Refusal> {
        match Self::of(bytes) {
            Self::Dxf => reading::read(bytes, JOINED).map(drop),
            Self::Step => step::read(bytes).map(drop),
            Self::Program => gcode::read(bytes).map(drop),
            Self::Servo => read_servo::read(bytes).map(drop).map_err(Refusal::new),
            Self::Points => points::read(bytes).map(drop).map_err(Refusal::new),
            Self::Places => read_inspection::read(bytes).map(drop).map_err(Refusal::new),
            Self::Gauge => read_gauge::read(bytes).map(drop).map_err(Refusal::new),
            Self::Table => table::read(bytes).map(drop).map_err(Refusal::new),
            Self::Shown(what) => Err(not_cut(what)),
        }
    }
}

/// That nothing is cut, measured or moved by a file.
fn not_cut(what: &str) -> Refusal {
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
    (tables > 0 && keys > 1).then_some("a design file (TOML)")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_known_by_its_beginning() {
        for (text, kind) in [
            ("ISO-10303-21;\n", FileKind::Step),
            ("%\nO1\nG21G17G90G40\n", FileKind::Program),
            ("G90 G1 X1 F2\n", FileKind::Program),
            ("0 BEGIN PGM A MM\n", FileKind::Program),
            ("cam_deg,lift_mm\n0,1\n", FileKind::Table),
            ("pass,tool_mm,a_deg\n1,2,3\n", FileKind::Table),
            ("# units: mm\ncam_deg,radius_mm\n0,1\n", FileKind::Points),
            ("DMISMN/'A',05.2\n", FileKind::Places),
            ("1 10 0 0 1 0 0\n", FileKind::Places),
            ("# a\ncam_deg,distance_mm,lift_mm\n", FileKind::Gauge),
            ("Tabletype = 3\nBegintable\n", FileKind::Servo),
            ("%PDF-1.7\n", FileKind::Shown("a sheet (PDF)")),
            ("<?xml version=\"1.0\"?>\n<svg>", FileKind::Shown("a sheet or a plot (SVG)")),
            ("<!doctype html>", FileKind::Shown("a page (HTML)")),
            ("{\"schema\": 1}", FileKind::Shown("a report (JSON)")),
            ("name = \"A\"\n[motion]\nrpm = 3\n", FileKind::Shown("a design file (TOML)")),
            ("  0\nSECTION\n  2\nENTITIES\n", FileKind::Dxf),
            ("999\na comment\n0\nSECTION\n", FileKind::Dxf),
        ] {
            assert_eq!(FileKind::of(text.as_bytes()), kind, "{text}");
        }
    }
}
