//! The title block, with the data fields of ISO 7200.

use super::paper::{Paper, rectangle};
use super::{Facts, Group, Shape, TextAnchor, font, rounded, words};
use crate::geometry::contour::Extents;
use crate::report::{Report, Verdict};
use nalgebra::Vector2;

/// Width and height over the lettering of an A4, mm (ISO 7200: 180 mm).
pub(super) const WIDTH: f64 = 180.0;
pub(super) const HEIGHT: f64 = 54.0;
/// Sizes of the names of the fields, of values and of the title.
const NAME: f64 = 2.1;
const VALUE: f64 = 3.2;
const TITLE: f64 = 4.5;
/// Room between a text and the lines of its field.
const INSET: f64 = 1.1;

/// A field: its name, its value, and its share of the row.
struct Cell {
    name: &'static str,
    value: String,
    width: f64,
    size: f64,
}

fn cell(name: &'static str, value: impl Into<String>, width: f64) -> Cell {
    Cell { name, value: value.into(), width, size: VALUE }
}

/// What the block tells.
pub(super) struct Block<'a> {
    pub(super) facts: &'a Facts,
    pub(super) report: &'a Report,
    pub(super) paper: &'a Paper,
    /// "1:2".
    pub(super) scale: String,
    /// The tolerance of the profile, in words.
    pub(super) profile_tolerance: String,
}

impl Block<'_> {
    fn rows(&self) -> Vec<(f64, Vec<Cell>)> {
        let title = &self.facts.title;
        let given = |text: &Option<String>| text.clone().unwrap_or_default();
        let length = |value: Option<f64>| value.map_or(String::new(), |value| format!("{} mm", rounded(value)));
        let mass = self.facts.mass_kg.map_or(String::new(), |mass| format!("{mass:.3} kg"));
        let document = format!("{}, review sheet", self.report.noun);
        vec![
            (
                10.0,
                vec![
                    cell("Legal owner", given(&title.owner), 60.0),
                    cell("Document type", document, 60.0),
                    cell("Identification number", given(&title.part_number), 60.0),
                ],
            ),
            (
                15.0,
                vec![
                    Cell { size: TITLE, ..cell("Title", self.report.title(), 125.0) },
                    cell("Rev.", given(&title.revision), 20.0),
                    cell("Date of issue", given(&title.date), 35.0),
                ],
            ),
            (
                9.5,
                vec![
                    cell("Creator", given(&title.designer), 50.0),
                    cell("Approval person", given(&title.approved), 50.0),
                    cell("Material", self.facts.material.clone().unwrap_or_default(), 40.0),
                    cell("Thickness", length(self.facts.thickness_mm), 40.0),
                ],
            ),
            (
                9.5,
                vec![
                    cell("Profile tolerance", self.profile_tolerance.clone(), 62.0),
                    cell("General tolerance", given(&title.general_tolerance), 48.0),
                    cell("Surface roughness", given(&title.surface_roughness), 40.0),
                    cell("Mass", mass, 30.0),
                ],
            ),
            (
                10.0,
                vec![
                    cell("Scale", self.scale.clone(), 24.0),
                    cell("Size", self.paper.name, 18.0),
                    cell("Sheet", "1/1", 18.0),
                    cell("Checks", self.verdict(), 30.0),
                    cell("Inputs", self.report.inputs_hash(), 52.0),
                    cell("Made by camgen", env!("CARGO_PKG_VERSION"), 38.0),
                ],
            ),
        ]
    }

    fn verdict(&self) -> &'static str {
        let warned = self.report.checks.iter().any(|finding| finding.verdict == Verdict::Warn);
        match (self.report.passed(), warned) {
            (false, _) => "FAILED",
            (true, true) => "passed, with warnings",
            (true, false) => "passed",
        }
    }

    /// The block with its lower right corner at a place.
    pub(super) fn groups(&self, corner: Vector2<f64>, k: f64) -> Vec<Group> {
        let field =
            Extents { least: corner - Vector2::new(WIDTH * k, 0.0), largest: corner + Vector2::new(0.0, HEIGHT * k) };
        let (mut lines, mut names, mut values) = (rectangle(&field), Vec::new(), Vec::new());
        let mut top = field.largest.y;
        for (height, cells) in self.rows() {
            let bottom = top - height * k;
            lines.push(Shape::Line(Vector2::new(field.least.x, bottom), Vector2::new(field.largest.x, bottom)));
            let mut left = field.least.x;
            for cell in cells {
                let right = left + cell.width * k;
                if left > field.least.x {
                    lines.push(Shape::Line(Vector2::new(left, bottom), Vector2::new(left, top)));
                }
                let x = left + INSET * k;
                let room = (cell.width - 2.0 * INSET) * k;
                let name_line = top - (INSET + font::ASCENT * NAME) * k;
                names.push(words(Vector2::new(x, name_line), NAME * k, TextAnchor::Start, cell.name));
                let upper = name_line - (font::DESCENT * NAME + 0.5) * k;
                let (wrapped, size) = font::fitted(&cell.value, cell.size * k, room, upper - bottom - 0.6 * k);
                let mut line = upper - font::ASCENT * size;
                for text in wrapped.into_iter().filter(|text| !text.is_empty()) {
                    values.push(words(Vector2::new(x, line), size, TextAnchor::Start, text));
                    line -= font::LEADING * size;
                }
                left = right;
            }
            top = bottom;
        }
        vec![
            Group::new("title-block", "title block", lines),
            Group::new("title-names", "names of the title block", names),
            Group::new("title-values", "title block", values),
        ]
    }
}
