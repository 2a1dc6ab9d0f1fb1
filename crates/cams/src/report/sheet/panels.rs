//! The panels next to the drawing: verdicts, figures, legend, tables. Each panel is laid out in a width and reports its height.

use super::font::SMALLEST as TEXT;
use super::{PlaceRow, PlaceTable, ShapeGroup, SheetShape, SheetView, TextAnchor, font, words};
use crate::report::{Bound, Finding, Place, Report, Verdict};
use camgen_kernel::text::Text;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Size of headings, distance of lines and of the rows of a table, room between two panels, mm.
const HEADING: f64 = 5.1;
const LINE: f64 = 4.8;
const ROW: f64 = 4.0;
const GAP: f64 = 3.6;
/// Length of a sample of the legend.
const SAMPLE: f64 = 12.0;
/// Columns of the checks: verdict, name, value, limit, bar, place.
const COLUMNS: [f64; 6] = [0.0, 14.0, 55.0, 81.0, 114.0, 142.0];
/// Height of a bar, and the colours of those that pass and fail.
const BAR: f64 = 2.4;
const BAR_COLOURS: [&str; 2] = ["#8a949e", "#c00000"];
/// Least room between two columns of a table of places, and that for the name of a place of inspection before them.
const BETWEEN: f64 = 1.5;
const FLAG: f64 = 6.0;
/// Behind rows at a change of the motion.
const TINT: &str = "#dcdcdc";
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
            SheetShape::Area(corners) => SheetShape::Area(corners.iter().map(|place| place + corner).collect()),
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
    width: f64,
    down: f64,
    groups: Vec<ShapeGroup>,
}

impl PanelWriter {
    pub(super) fn new(width: f64) -> Self {
        Self { width, down: 0.0, groups: Vec::new() }
    }

    /// A filled rectangle from a place, downwards, behind what is written.
    fn area(&mut self, colour: &'static str, [left, right]: [f64; 2], [top, bottom]: [f64; 2]) {
        let corner = |x: f64, y: f64| Vector2::new(x, -y);
        let shape =
            SheetShape::Area(vec![corner(left, top), corner(right, top), corner(right, bottom), corner(left, bottom)]);
        if let Some(group) = self.groups.iter_mut().find(|group| group.colour.as_deref() == Some(colour)) {
            group.shapes.push(shape);
        } else {
            let group = ShapeGroup::new("area", "areas", vec![shape]);
            self.groups.insert(0, ShapeGroup { colour: Some(colour.to_owned()), ..group });
        }
    }

    fn push(&mut self, class: &'static str, shape: SheetShape) {
        match self.groups.iter_mut().find(|group| group.class == class) {
            Some(group) => group.shapes.push(shape),
            None => self.groups.push(ShapeGroup::new(class, class, vec![shape])),
        }
    }

    fn text(&mut self, class: &'static str, x: f64, size: f64, anchor: TextAnchor, text: impl Into<String>) {
        self.push(class, words(Vector2::new(x, -self.down), size, anchor, text));
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
        let y = -self.down;
        self.push("rule", SheetShape::Line(Vector2::new(0.0, y), Vector2::new(self.width, y)));
        self.down += 0.2 * HEADING;
    }

    fn paragraph(&mut self, class: &'static str, text: &str) {
        for line in font::wrapped(text, TEXT, self.width) {
            self.down += LINE;
            self.text(class, 0.0, TEXT, TextAnchor::Start, line);
        }
    }

    fn done(self) -> SheetPanel {
        SheetPanel { height: self.down + GAP, groups: self.groups }
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

/// The checks, a row each with a bar of what is used of its limit, the tightest first, and how many others passed.
pub(super) fn checks(
    mut writer: PanelWriter,
    checks: &[Finding],
    passed_otherwise: usize,
    units: LengthUnit,
) -> SheetPanel {
    writer.heading("Checks: value of limit");
    let mut ordered: Vec<&Finding> = checks.iter().collect();
    let used = |finding: &Finding| finding.margin().unwrap_or(0.0);
    let rank = |finding: &Finding| (finding.verdict != Verdict::Fail, finding.verdict != Verdict::Warn);
    ordered.sort_by(|a, b| rank(a).cmp(&rank(b)).then(used(b).total_cmp(&used(a))));
    let ends = COLUMNS.iter().skip(1).chain([&writer.width]).copied();
    let rooms: Vec<(f64, f64)> = COLUMNS.iter().copied().zip(ends).map(|(x, end)| (x, end - x - 1.5)).collect();
    for finding in ordered {
        writer.down += LINE;
        let class = class_of(finding.verdict);
        for (index, ((x, room), text)) in rooms.iter().zip(cells(finding, units)).enumerate() {
            writer.cell(if index == 0 { class } else { "facts" }, *x, *room, &text);
        }
        if let (Some(used), [.., (left, room), _]) = (finding.margin(), rooms.as_slice()) {
            let colour = if finding.verdict == Verdict::Fail { BAR_COLOURS[1] } else { BAR_COLOURS[0] };
            let right = left + room * used.clamp(0.0, 1.0);
            let bottom = writer.down;
            writer.area(colour, [*left, right], [bottom - BAR, bottom]);
            let end = Vector2::new(left + room, -bottom);
            writer.push("rule", SheetShape::Line(end, end + Vector2::new(0.0, BAR)));
        }
        if let Some(note) = finding.note.as_ref().filter(|_| finding.verdict == Verdict::Warn) {
            writer.paragraph("warn", &note.in_unit(units));
        }
    }
    if passed_otherwise > 0 {
        writer.paragraph("facts", &format!("and {passed_otherwise} checks of the written files, all passed"));
    }
    writer.done()
}

fn cells(finding: &Finding, units: LengthUnit) -> [String; 6] {
    let limit = finding.brief_limit(units).map(|limit| {
        let side = finding.bound.map_or("", Bound::words);
        format!("{side} {limit}").trim_start().to_owned()
    });
    let place = if finding.place == Place::default() { String::new() } else { finding.place.text().in_unit(units) };
    let value = if finding.missing.is_some() { "not run".to_owned() } else { finding.brief_value(units).to_string() };
    [finding.verdict.word().into(), finding.title(), value, limit.unwrap_or_default(), String::new(), place]
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
        let y = -(writer.down - 0.35 * TEXT);
        let sample = SheetShape::Line(Vector2::new(x, y), Vector2::new(x + SAMPLE, y));
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
pub(super) fn notes(mut writer: PanelWriter, view: &SheetView, report: &Report, of_report: &[Text]) -> SheetPanel {
    writer.heading("Notes");
    for lost in &view.lost {
        writer.paragraph("fail", &lost.in_unit(report.units));
    }
    for note in view.notes.iter().chain(of_report).take(MOST_NOTES) {
        writer.paragraph("facts", &note.in_unit(report.units));
    }
    let more = (view.notes.len() + of_report.len()).saturating_sub(MOST_NOTES);
    if more > 0 {
        writer.paragraph("facts", &format!("and {more} more, in the report"));
    }
    writer.done()
}

/// What an associated file is, a line or two each.
pub(super) fn files(mut writer: PanelWriter, files: &[String]) -> SheetPanel {
    writer.heading("Files of this part");
    for file in files {
        writer.paragraph("facts", file);
    }
    writer.done()
}

/// The widths that the columns of a table need, with the room between them.
fn needed_widths<'r>(rows: impl Iterator<Item = &'r PlaceRow>) -> Vec<f64> {
    let mut needed: Vec<f64> = Vec::new();
    for row in rows {
        needed.resize(needed.len().max(row.cells.len()), 0.0);
        for (needed, cell) in needed.iter_mut().zip(&row.cells) {
            *needed = needed.max(font::width(cell, TEXT) + BETWEEN);
        }
    }
    needed
}

/// The widths of columns in a room: what each needs and an equal share of what is left, or each less by the same share.
fn column_widths(needed: &[f64], room: f64) -> Vec<f64> {
    let sum: f64 = needed.iter().sum();
    #[expect(clippy::cast_precision_loss, reason = "a few columns")]
    let more = (room - sum) / needed.len().max(1) as f64;
    needed.iter().map(|width| if more < 0.0 { width * room / sum } else { width + more }).collect()
}

/// A table of places in as many blocks side by side as fit.
pub(super) fn places(mut writer: PanelWriter, table: &PlaceTable) -> SheetPanel {
    writer.heading(&table.title);
    for remark in &table.remarks {
        writer.paragraph("facts", remark);
    }
    let shown: Vec<&PlaceRow> = table.shown().collect();
    let heads = PlaceRow { cells: table.heads.clone(), number: Some(0), flag: None, is_change: false };
    let needed = needed_widths(std::iter::once(&heads).chain(shown.iter().copied()));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few columns")]
    let blocks = (writer.width / (needed.iter().sum::<f64>() + FLAG)).floor().clamp(1.0, 4.0) as u32;
    let rows = shown.len().div_ceil(blocks as usize).max(1);
    let step = writer.width / f64::from(blocks);
    let columns = column_widths(&needed, step - FLAG - 1.0);
    writer.down += LINE;
    let top = writer.down;
    for (number, rows) in (0_u32..).zip(shown.chunks(rows)) {
        writer.down = top;
        let left = step * f64::from(number) + FLAG;
        for row in std::iter::once(&heads).chain(rows.iter().copied()) {
            if row.is_change {
                let high = 0.25 * ROW;
                writer.area(TINT, [left, left + step - FLAG - 1.0], [writer.down + high - ROW, writer.down + high]);
            }
            if let Some(flag) = &row.flag {
                writer.text("strong", left, TEXT, TextAnchor::End, flag.clone());
            }
            let mut x = left;
            for (cell, column) in row.cells.iter().zip(&columns) {
                x += column;
                let (_, size) = font::fitted_in_one(cell, TEXT, column - 0.3);
                writer.text("facts", x, size, TextAnchor::End, cell.clone());
            }
            writer.down += ROW;
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "a few rows")]
    let height = ROW * rows as f64;
    writer.down = top + height;
    writer.done()
}
