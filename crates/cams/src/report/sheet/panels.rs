//! The panels next to the drawing: verdicts, figures, legend, tables. Each panel is laid out in a width and reports its height.

use super::{PlaceTable, ShapeGroup, SheetShape, SheetView, TextAnchor, font, words};
use crate::report::{Finding, Place, Report, Verdict};
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Over the lettering of an A4, mm: size of texts, of headings, distance of lines, room between two panels.
const TEXT: f64 = 2.8;
const HEADING: f64 = 3.2;
const LINE: f64 = 4.0;
const GAP: f64 = 3.2;
/// Length of a sample of the legend, and the columns it is set in, at most.
const SAMPLE: f64 = 12.0;
/// A panel narrower than this shows fewer columns of the checks.
const NARROW: f64 = 120.0;
/// Width of a column of a table of places.
const PLACE_COLUMN: f64 = 13.0;
/// Most rows of notes.
const MOST_NOTES: usize = 12;

/// A panel, its upper left corner at the origin, downwards.
#[derive(Debug, Clone)]
pub(super) struct SheetPanel {
    pub(super) height: f64,
    pub(super) groups: Vec<ShapeGroup>,
}

impl SheetPanel {
    /// Its groups with the corner at a place.
    pub(super) fn at(self, corner: Vector2<f64>) -> impl Iterator<Item = ShapeGroup> {
        let moved = move |shape: SheetShape| match shape {
            SheetShape::Text { at, height, anchor, text } => SheetShape::Text { at: at + corner, height, anchor, text },
            SheetShape::Line(a, b) => SheetShape::Line(a + corner, b + corner),
            other => other,
        };
        self.groups.into_iter().map(move |group| {
            let shapes = group.shapes.into_iter().map(&moved).collect();
            ShapeGroup { shapes, ..group }
        })
    }
}

/// A pen that writes a panel from its top to its bottom.
pub(super) struct PanelWriter {
    k: f64,
    width: f64,
    down: f64,
    groups: Vec<ShapeGroup>,
}

impl PanelWriter {
    pub(super) fn new(lettering: f64, width: f64) -> Self {
        Self { k: lettering, width: width / lettering, down: 0.0, groups: Vec::new() }
    }

    fn push(&mut self, class: &'static str, shape: SheetShape) {
        match self.groups.iter_mut().find(|group| group.class == class) {
            Some(group) => group.shapes.push(shape),
            None => self.groups.push(ShapeGroup::new(class, class, vec![shape])),
        }
    }

    fn text(&mut self, class: &'static str, x: f64, size: f64, anchor: TextAnchor, text: impl Into<String>) {
        let at = Vector2::new(x * self.k, -self.down * self.k);
        self.push(class, words(at, size * self.k, anchor, text));
    }

    /// A text in its column, smaller where it would not fit.
    fn cell(&mut self, class: &'static str, x: f64, room: f64, text: &str) {
        if text.is_empty() {
            return;
        }
        let (_, size) = font::fitted_in_one(text, TEXT, room);
        self.text(class, x, size, TextAnchor::Start, text);
    }

    fn heading(&mut self, text: &str) {
        for line in font::wrapped(text, HEADING, self.width) {
            self.down += HEADING;
            self.text("facts", 0.0, HEADING, TextAnchor::Start, line);
            self.down += 0.2 * HEADING;
        }
        self.down -= 0.2 * HEADING;
        self.down += 0.35 * HEADING;
        let (y, width) = (-self.down * self.k, self.width * self.k);
        self.push("rule", SheetShape::Line(Vector2::new(0.0, y), Vector2::new(width, y)));
        self.down += 0.3 * HEADING;
    }

    fn paragraph(&mut self, class: &'static str, text: &str) {
        for line in font::wrapped(text, TEXT, self.width) {
            self.down += LINE;
            self.text(class, 0.0, TEXT, TextAnchor::Start, line);
        }
    }

    fn done(self) -> SheetPanel {
        SheetPanel { height: (self.down + GAP) * self.k, groups: self.groups }
    }
}

fn class_of(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Fail => "fail",
        Verdict::Warn => "warn",
        Verdict::Pass => "pass",
        Verdict::Info => "facts",
    }
}

/// The checks, a row each, and how many others passed.
pub(super) fn checks(
    mut writer: PanelWriter,
    checks: &[Finding],
    passed_otherwise: usize,
    units: LengthUnit,
) -> SheetPanel {
    writer.heading("Checks");
    let wide = writer.width >= NARROW;
    let columns: &[f64] = if wide { &[0.0, 11.0, 52.0, 96.0, 146.0] } else { &[0.0, 9.0, 39.0, 65.0] };
    let ends = columns.iter().skip(1).chain([&writer.width]).copied();
    let rooms: Vec<(f64, f64)> = columns.iter().copied().zip(ends).map(|(x, end)| (x, end - x - 1.5)).collect();
    for finding in checks {
        writer.down += LINE;
        let class = class_of(finding.verdict);
        for (index, ((x, room), text)) in rooms.iter().zip(cells(finding, units)).enumerate() {
            writer.cell(if index == 0 { class } else { "facts" }, *x, *room, &text);
        }
    }
    if passed_otherwise > 0 {
        writer.paragraph("facts", &format!("and {passed_otherwise} checks of the written files, all passed"));
    }
    writer.done()
}

fn cells(finding: &Finding, units: LengthUnit) -> [String; 5] {
    let limit = finding.limit_words(units).unwrap_or_default();
    let place = if finding.place == Place::default() {
        String::new()
    } else {
        format!("at {}", finding.place.text().in_unit(units))
    };
    let value = if finding.missing.is_some() { "not run".to_owned() } else { finding.shown_value(units).to_string() };
    [finding.verdict.word().into(), finding.check.replace('_', " "), value, limit, place]
}

/// The main figures of the report's sections.
pub(super) fn figures(mut writer: PanelWriter, report: &Report) -> SheetPanel {
    writer.heading("Figures");
    for figure in report.figures() {
        writer.paragraph("facts", &figure.in_unit(report.units));
    }
    writer.done()
}

/// A line for each kind of line of the drawing.
pub(super) fn legend(mut writer: PanelWriter, view: &SheetView) -> SheetPanel {
    writer.heading("Lines");
    let listed: Vec<&ShapeGroup> = view.groups.iter().filter(|group| group.in_legend).collect();
    let longest = listed.iter().map(|group| font::width(&group.label.to_string(), TEXT)).fold(0.0, f64::max);
    let each = SAMPLE + 2.0 + longest + 4.0;
    let fits = (writer.width / each).floor().clamp(1.0, 3.0);
    let mut column = 0.0;
    for (index, group) in listed.iter().enumerate() {
        if column == 0.0 {
            writer.down += LINE;
        }
        let x = column * writer.width / fits;
        let y = -(writer.down - 0.35 * TEXT) * writer.k;
        let sample = SheetShape::Line(Vector2::new(x * writer.k, y), Vector2::new((x + SAMPLE) * writer.k, y));
        let colour = group.colour.clone();
        let id = format!("legend-{index}");
        writer.groups.push(ShapeGroup {
            id,
            colour,
            ..ShapeGroup::new(group.class, group.label.clone(), vec![sample])
        });
        let room = writer.width / fits - SAMPLE - 3.0;
        let label = group.label.to_string();
        let (_, size) = font::fitted_in_one(&label, TEXT, room);
        writer.text("facts", x + SAMPLE + 2.0, size, TextAnchor::Start, label);
        column = if column + 1.0 < fits { column + 1.0 } else { 0.0 };
    }
    writer.done()
}

/// The notes.
pub(super) fn notes(mut writer: PanelWriter, view: &SheetView, report: &Report) -> SheetPanel {
    writer.heading("Notes");
    for lost in &view.lost {
        writer.paragraph("fail", &lost.in_unit(report.units));
    }
    for note in view.notes.iter().chain(&report.notes).take(MOST_NOTES) {
        writer.paragraph("facts", &note.in_unit(report.units));
    }
    let more = (view.notes.len() + report.notes.len()).saturating_sub(MOST_NOTES);
    if more > 0 {
        writer.paragraph("facts", &format!("and {more} more, in the report"));
    }
    writer.done()
}

/// A table of places in as many blocks side by side as fit.
pub(super) fn places(mut writer: PanelWriter, table: &PlaceTable) -> SheetPanel {
    writer.heading(&table.title);
    #[expect(clippy::cast_precision_loss, reason = "a few columns")]
    let block = PLACE_COLUMN * table.heads.len() as f64 + 3.0;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few columns")]
    let blocks = (writer.width / block).floor().clamp(1.0, 4.0) as u32;
    let shown: Vec<&Vec<String>> = table.rows.iter().step_by(table.every.max(1)).collect();
    let rows = shown.len().div_ceil(blocks as usize).max(1);
    let step = writer.width / f64::from(blocks);
    writer.down += LINE;
    let top = writer.down;
    for (number, rows) in (0_u32..).zip(shown.chunks(rows)) {
        writer.down = top;
        let left = step * f64::from(number);
        for cells in std::iter::once(&table.heads).chain(rows.iter().copied()) {
            let column = (step - 3.0) / f64::from(u32::try_from(cells.len()).unwrap_or(1).max(1));
            let mut x = left;
            for cell in cells {
                x += column;
                let (_, size) = font::fitted_in_one(cell, TEXT, column - 2.0);
                writer.text("facts", x, size, TextAnchor::End, cell.clone());
            }
            writer.down += LINE;
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "a few rows")]
    let height = LINE * rows as f64;
    writer.down = top + height;
    writer.done()
}
