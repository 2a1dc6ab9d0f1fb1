//! The title block, with the data fields of ISO 7200.

use super::paper::{PaperSize, rectangle};
use super::{ShapeGroup, SheetKind, SheetShape, TextAnchor, TitleFacts, font, words};
use crate::report::{Report, Verdict};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Width, mm (ISO 7200).
pub(in crate::report) const WIDTH: f64 = 180.0;
/// Height of the block of a drawing and of other sheets, mm.
const HEIGHT_OF_DRAWING: f64 = 60.0;
const HEIGHT: f64 = 34.0;
/// Sizes of the names of the fields and their values, and of the title, mm.
const VALUE: f64 = font::SMALLEST;
const TITLE: f64 = 5.0 / font::CAPITAL;
/// Room between a text and the lines of its field.
const INSET: f64 = 1.0;
/// Behind a value that nobody has given.
const PROPOSED: &str = " *";

/// Height of the block, mm.
pub(in crate::report) fn height(kind: SheetKind) -> f64 {
    if kind.is_drawing() { HEIGHT_OF_DRAWING } else { HEIGHT }
}

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

/// Width of the field of the projection symbol.
const SYMBOL: f64 = 24.0;

/// The symbol of a projection (ISO 5456-2, ASME Y14.3) about a place: a frustum and the view of its small end, at the left of it where the third
/// angle is used and at the right where the first is.
fn projection_symbol(at: Vector2<f64>, is_third_angle: bool) -> Vec<SheetShape> {
    let side = if is_third_angle { -1.0 } else { 1.0 };
    let place = |x: f64, y: f64| at + Vector2::new(x, y);
    let circle = |radius: f64| SheetShape::Entity(Entity::Circle(place(side * 5.0, 0.0), radius));
    let line = |from: (f64, f64), to: (f64, f64)| SheetShape::Line(place(from.0, from.1), place(to.0, to.1));
    let (small, large) = (1.25, 2.5);
    // The frustum tapers to the left, so that its small end is seen from there.
    let (left, right) = (-side * 3.5 - 2.5, -side * 3.5 + 2.5);
    vec![
        circle(small),
        circle(large),
        line((left, -small), (left, small)),
        line((right, -large), (right, large)),
        line((left, small), (right, large)),
        line((left, -small), (right, -large)),
        line((side * 5.0 - 3.3, 0.0), (side * 5.0 + 3.3, 0.0)),
        line((side * 5.0, -3.3), (side * 5.0, 3.3)),
        line((left - 1.0, 0.0), (right + 1.0, 0.0)),
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
    /// What the sheet is for.
    pub(in crate::report) kind: SheetKind,
    /// What the sheet is: "review sheet".
    pub(in crate::report) document: &'static str,
    /// Which sheet of how many it is: "1/1".
    pub(in crate::report) number: &'a str,
    /// How far the profile of the file lies from the exact one, in words.
    pub(in crate::report) file_deviates: String,
}

/// A mass, kg, in grams below a tenth of a kilogram.
fn mass_words(mass: f64) -> String {
    if mass < 0.1 { format!("{:.1} g", 1e3 * mass) } else { format!("{mass:.2} kg") }
}

impl TitleBlock<'_> {
    /// Heights of the rows and their fields.
    fn rows(&self) -> Vec<(f64, Vec<TitleField>)> {
        if self.kind.is_drawing() { self.of_drawing() } else { self.of_other_sheet() }
    }

    /// What a shop needs to make the part: a value that nobody has given is proposed, with a mark.
    fn of_drawing(&self) -> Vec<(f64, Vec<TitleField>)> {
        let title = &self.facts.title;
        let is_inch = self.report.units == LengthUnit::Inch;
        let of = |given: Option<&String>, proposed: &str| match given {
            Some(given) => given.clone(),
            None if proposed.is_empty() => String::new(),
            None => format!("{proposed}{PROPOSED}"),
        };
        let tolerances = if is_inch { "DECIMALS .xx ±.01 .xxx ±.005" } else { "ISO 2768-mK" };
        let principle = if is_inch { "ASME Y14.5" } else { "ISO 8015, size ISO 14405" };
        let edges = if is_inch { "BREAK EDGES .010 MAX" } else { "−0.3 outside, +0.3 inside" };
        let treatment = [&title.heat_treatment, &title.hardness, &title.case_depth];
        let treatment: Vec<&str> = treatment.into_iter().filter_map(|text| text.as_deref()).collect();
        let treatment = (!treatment.is_empty()).then(|| treatment.join(", "));
        let presumed = self.facts.presumed_treatment.as_deref().unwrap_or_default();
        let roughness = of(title.surface_roughness.as_ref(), PROPOSED_ROUGHNESS);
        let mass = self.facts.mass_kg.map_or(String::new(), mass_words);
        vec![
            (
                10.0,
                vec![
                    cell("General tolerances", of(title.general_tolerance.as_ref(), tolerances), 60.0),
                    cell("Tolerancing", principle, 60.0),
                    cell("Edges, ISO 13715", of(title.edges.as_ref(), edges), 60.0),
                ],
            ),
            (
                10.0,
                vec![
                    cell("Material", of(self.facts.material.as_ref(), "steel"), 45.0),
                    cell("Heat treatment, hardness", of(treatment.as_ref(), presumed), 75.0),
                    cell("Surface of the profile", roughness, 60.0),
                ],
            ),
            (
                10.0,
                vec![
                    cell("Legal owner", given(title.owner.as_ref()), 45.0),
                    cell("Creator", given(title.designer.as_ref()), 40.0),
                    cell("Approval person", given(title.approved.as_ref()), 40.0),
                    cell("Document type", self.document, 30.0),
                    cell("Status", if title.approved.is_some() { "released" } else { "draft" }, 25.0),
                ],
            ),
            (
                17.0,
                vec![
                    TitleField { size: TITLE, ..cell("Title", self.report.title(), 110.0) },
                    cell("Drawing number", given(title.part_number.as_ref()), 45.0),
                    cell("Mass", mass, 25.0),
                ],
            ),
            (
                13.0,
                vec![
                    cell("Scale", self.scale.clone(), 20.0),
                    cell("Size", self.paper.name, 16.0),
                    cell("Sheet", self.number, 18.0),
                    cell("Rev.", given(title.revision.as_ref()), 16.0),
                    cell("Date of issue", given(title.date.as_ref()), 34.0),
                    cell("Inputs", self.report.inputs_hash(), 52.0),
                    cell("", "", SYMBOL),
                ],
            ),
        ]
    }

    /// What a review needs: which design it is, how near its file is to it, and the verdict.
    fn of_other_sheet(&self) -> Vec<(f64, Vec<TitleField>)> {
        let title = &self.facts.title;
        vec![
            (
                14.0,
                vec![
                    TitleField { size: TITLE, ..cell("Title", self.report.title(), 120.0) },
                    cell("Document type", format!("{}, {}", self.report.noun, self.document), 60.0),
                ],
            ),
            (
                10.0,
                vec![
                    cell("Drawing number", given(title.part_number.as_ref()), 50.0),
                    cell("Rev.", given(title.revision.as_ref()), 16.0),
                    cell("Scale", self.scale.clone(), 18.0),
                    cell("Size", self.paper.name, 16.0),
                    cell("Sheet", self.number, 20.0),
                    cell("Checks", self.verdict(), 60.0),
                ],
            ),
            (
                10.0,
                vec![
                    cell("File deviates from the exact profile", self.file_deviates.clone(), 84.0),
                    cell("Inputs", self.report.inputs_hash(), 56.0),
                    cell("Made by camgen", env!("CARGO_PKG_VERSION"), 40.0),
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
    pub(in crate::report) fn groups(&self, corner: Vector2<f64>) -> Vec<ShapeGroup> {
        let field = Extents {
            least: corner - Vector2::new(WIDTH, 0.0),
            largest: corner + Vector2::new(0.0, height(self.kind)),
        };
        let (mut lines, mut names, mut values) = (rectangle(&field), Vec::new(), Vec::new());
        let mut top = field.largest.y;
        for (height, cells) in self.rows() {
            let bottom = top - height;
            lines.push(SheetShape::Line(Vector2::new(field.least.x, bottom), Vector2::new(field.largest.x, bottom)));
            let mut left = field.least.x;
            for cell in cells {
                let right = left + cell.width;
                if left > field.least.x {
                    lines.push(SheetShape::Line(Vector2::new(left, bottom), Vector2::new(left, top)));
                }
                let x = left + INSET;
                let room = cell.width - 2.0 * INSET;
                let name_line = top - (INSET + font::CAPITAL * VALUE);
                names.push(words(Vector2::new(x, name_line), VALUE, TextAnchor::Start, cell.name));
                let upper = name_line - font::DESCENT * VALUE - 0.2;
                let (wrapped, size) = font::fitted(&cell.value, cell.size, room, upper - bottom - 0.2);
                let mut line = upper - font::ASCENT * size;
                for text in wrapped.into_iter().filter(|text| !text.is_empty()) {
                    values.push(words(Vector2::new(x, line), size, TextAnchor::Start, text));
                    line -= font::LEADING * size;
                }
                left = right;
            }
            top = bottom;
        }
        names.retain(|name| !matches!(name, SheetShape::Text { text, .. } if text.is_empty()));
        let mut groups = vec![
            ShapeGroup::new("title-block", "title block", lines),
            ShapeGroup::new("title-names", "names of the title block", names),
            ShapeGroup::new("title-values", "title block", values),
        ];
        if self.kind.is_drawing() {
            let is_third_angle = self.report.units == LengthUnit::Inch;
            let name = if is_third_angle { "third-angle projection" } else { "first-angle projection" };
            let middle = Vector2::new(field.largest.x - 0.5 * SYMBOL, field.least.y + 6.5);
            let symbol = ShapeGroup::new("dimension", name, projection_symbol(middle, is_third_angle));
            groups.push(ShapeGroup { id: "projection".into(), ..symbol });
        }
        groups
    }
}

/// Roughness of a profile that is proposed: usual for a roller on it.
pub(crate) const PROPOSED_ROUGHNESS: &str = "Ra 0.8";
