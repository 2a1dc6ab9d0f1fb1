//! The title block, with the data fields of ISO 7200.

use super::paper::{PaperSize, rectangle};
use super::{ShapeGroup, SheetShape, TextAnchor, TitleFacts, font, words};
use crate::report::sheet::Dimensions;
use crate::report::{Report, Verdict};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Width and height over the lettering of an A4, mm (ISO 7200: 180 mm).
pub(in crate::report) const WIDTH: f64 = 180.0;
pub(in crate::report) const HEIGHT: f64 = 63.5;
/// Sizes of the names of the fields, of values and of the title.
const NAME: f64 = 2.1;
const VALUE: f64 = 3.2;
const TITLE: f64 = 4.5;
/// Room between a text and the lines of its field.
const INSET: f64 = 1.1;

/// A field: its name, its value, and its share of the row.
struct TitleField {
    name: &'static str,
    value: String,
    width: f64,
    size: f64,
}

fn cell(name: &'static str, value: impl Into<String>, width: f64) -> TitleField {
    TitleField { name, value: value.into(), width, size: VALUE }
}

/// Name and width of the field of the projection symbol.
const THIRD_ANGLE: &str = "Third angle";
const SYMBOL: f64 = 24.0;

/// The symbol of third-angle projection (ASME Y14.3, ISO 5456-2) about a place: a frustum, and at its left the view of its small end.
fn third_angle(at: Vector2<f64>, k: f64) -> Vec<SheetShape> {
    let place = |x: f64, y: f64| at + Vector2::new(x, y) * k;
    let circle = |radius: f64| SheetShape::Entity(Entity::Circle(place(-4.5, 0.0), radius * k));
    let line = |from: (f64, f64), to: (f64, f64)| SheetShape::Line(place(from.0, from.1), place(to.0, to.1));
    let (small, large) = (1.25, 2.5);
    vec![
        circle(small),
        circle(large),
        line((1.0, -small), (1.0, small)),
        line((6.0, -large), (6.0, large)),
        line((1.0, small), (6.0, large)),
        line((1.0, -small), (6.0, -large)),
        line((-7.8, 0.0), (-1.2, 0.0)),
        line((-4.5, -3.2), (-4.5, 3.2)),
        line((0.0, 0.0), (7.0, 0.0)),
    ]
}

fn given(text: Option<&String>) -> String {
    text.cloned().unwrap_or_default()
}

/// The contents of the block.
pub(in crate::report) struct TitleBlock<'a> {
    pub(in crate::report) facts: &'a TitleFacts,
    pub(in crate::report) report: &'a Report,
    pub(in crate::report) paper: &'a PaperSize,
    /// "1:2".
    pub(in crate::report) scale: String,
    /// What the sheet is: "review sheet".
    pub(in crate::report) document: &'static str,
    /// Which sheet of how many it is: "1/1".
    pub(in crate::report) number: &'static str,
    /// How far the profile of the file lies from the exact one, in words.
    pub(in crate::report) file_deviates: String,
}

impl TitleBlock<'_> {
    /// Heights of the rows and their fields.
    fn rows(&self) -> Vec<(f64, Vec<TitleField>)> {
        let [of_drawing, of_part] = [self.of_drawing(), self.of_part()];
        let inches = self.report.units == LengthUnit::Inch;
        let [verdict, inputs, maker] = if inches { [26.0, 42.0, 28.0] } else { [30.0, 52.0, 38.0] };
        let mut last = vec![
            cell("Scale", self.scale.clone(), 24.0),
            cell("Size", self.paper.name, 18.0),
            cell("Sheet", self.number, 18.0),
            cell("Checks", self.verdict(), verdict),
            cell("Inputs", self.report.inputs_hash(), inputs),
            cell("Made by camgen", env!("CARGO_PKG_VERSION"), maker),
        ];
        last.extend(inches.then(|| cell(THIRD_ANGLE, "", SYMBOL)));
        of_drawing.into_iter().chain(of_part).chain([(10.0, last)]).collect()
    }

    fn of_drawing(&self) -> Vec<(f64, Vec<TitleField>)> {
        let title = &self.facts.title;
        let document = format!("{}, {}", self.report.noun, self.document);
        vec![
            (
                10.0,
                vec![
                    cell("Legal owner", given(title.owner.as_ref()), 60.0),
                    cell("Document type", document, 60.0),
                    cell("Identification number", given(title.part_number.as_ref()), 60.0),
                ],
            ),
            (
                15.0,
                vec![
                    TitleField { size: TITLE, ..cell("Title", self.report.title(), 125.0) },
                    cell("Rev.", given(title.revision.as_ref()), 20.0),
                    cell("Date of issue", given(title.date.as_ref()), 35.0),
                ],
            ),
        ]
    }

    fn of_part(&self) -> Vec<(f64, Vec<TitleField>)> {
        let title = &self.facts.title;
        let units = self.report.units;
        let length = |value: Option<f64>| {
            value.map_or(String::new(), |value| format!("{} {}", units.dimension(value), units.symbol()))
        };
        let mass = self.facts.mass_kg.map_or(String::new(), |mass| format!("{mass:.3} kg"));
        vec![
            (
                9.5,
                vec![
                    cell("Creator", given(title.designer.as_ref()), 50.0),
                    cell("Approval person", given(title.approved.as_ref()), 50.0),
                    cell("Material", self.facts.material.clone().unwrap_or_default(), 40.0),
                    cell("Thickness", length(self.facts.thickness_mm), 40.0),
                ],
            ),
            (
                9.5,
                vec![
                    cell("File deviates from the exact profile", self.file_deviates.clone(), 62.0),
                    cell("General tolerance", given(title.general_tolerance.as_ref()), 48.0),
                    cell("Surface roughness of the profile", given(title.surface_roughness.as_ref()), 40.0),
                    cell("Mass", mass, 30.0),
                ],
            ),
            (
                9.5,
                vec![
                    cell("Hardness", given(title.hardness.as_ref()), 40.0),
                    cell("Depth of case", given(title.case_depth.as_ref()), 40.0),
                    cell("Heat treatment", given(title.heat_treatment.as_ref()), 65.0),
                    cell("Edges", given(title.edges.as_ref()), 35.0),
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
    pub(in crate::report) fn groups(&self, corner: Vector2<f64>, k: f64) -> Vec<ShapeGroup> {
        let field =
            Extents { least: corner - Vector2::new(WIDTH * k, 0.0), largest: corner + Vector2::new(0.0, HEIGHT * k) };
        let (mut lines, mut names, mut values) = (rectangle(&field), Vec::new(), Vec::new());
        let mut top = field.largest.y;
        for (height, cells) in self.rows() {
            let bottom = top - height * k;
            lines.push(SheetShape::Line(Vector2::new(field.least.x, bottom), Vector2::new(field.largest.x, bottom)));
            let mut left = field.least.x;
            for cell in cells {
                let right = left + cell.width * k;
                if left > field.least.x {
                    lines.push(SheetShape::Line(Vector2::new(left, bottom), Vector2::new(left, top)));
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
        let middle = Vector2::new(field.largest.x - 0.5 * SYMBOL * k, field.least.y + 3.6 * k);
        let symbol = (self.report.units == LengthUnit::Inch).then(|| third_angle(middle, k));
        let symbol = symbol.map(|shapes| ShapeGroup {
            id: "projection".into(),
            ..ShapeGroup::new("dimension", "third-angle projection", shapes)
        });
        let mut groups = vec![
            ShapeGroup::new("title-block", "title block", lines),
            ShapeGroup::new("title-names", "names of the title block", names),
            ShapeGroup::new("title-values", "title block", values),
        ];
        groups.extend(symbol);
        groups
    }
}
