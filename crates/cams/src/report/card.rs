//! A table on a small card that hangs at a machine: A5, upright.

use super::sheet::paper::{PaperSize, SheetBorder, rectangle};
use super::sheet::{STROKE, ShapeGroup, Sheet, SheetShape, TextAnchor, font, words};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// A5, ISO 216; too small for the border of ISO 5457.
const PAPER: PaperSize = PaperSize { name: "A5", size: Vector2::new(148.0, 210.0), border: SheetBorder::Iso };
/// Margin around the frame, and within it, mm.
const MARGIN: f64 = 7.0;
const INSIDE: f64 = 4.0;
/// Height of the title, of the texts and of the figures, mm.
const TITLE: f64 = 4.2;
const TEXT: f64 = 2.6;
const FIGURE: f64 = 3.0;
/// Highest and lowest row of the table, mm.
const ROWS: (f64, f64) = (7.0, 3.0);

/// A card.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// What the names of its files have after the stem, `-card`.
    pub ending: &'static str,
    /// Its head.
    pub title: String,
    /// How it is used, a paragraph each, above the table.
    pub head: Vec<String>,
    /// Names of the columns, two lines at most each.
    pub heads: Vec<String>,
    /// Its rows, each as long as `heads`, and whether it is marked.
    pub rows: Vec<(Vec<String>, bool)>,
    /// What the marked rows mean, and the like, below the table.
    pub foot: Vec<String>,
}

/// The paragraphs below a height, broken into lines; the height that is left.
fn paragraphs(texts: &[String], (left, room, top): (f64, f64, f64), into: &mut Vec<SheetShape>) -> f64 {
    let mut y = top;
    for text in texts {
        for line in font::wrapped(text, TEXT, room) {
            y -= font::LEADING * TEXT;
            into.push(words(Vector2::new(left, y), TEXT, TextAnchor::Start, line));
        }
        y -= 0.5 * TEXT;
    }
    y
}

/// Height of paragraphs, mm.
fn height(texts: &[String], room: f64) -> f64 {
    let lines: usize = texts.iter().map(|text| font::wrapped(text, TEXT, room).len()).sum();
    #[expect(clippy::cast_precision_loss, reason = "a few lines")]
    let (lines, gaps) = (lines as f64, texts.len() as f64);
    TEXT * (font::LEADING * lines + 0.5 * gaps)
}

/// The card on its sheet, with the mark of its report.
#[must_use]
pub fn sheet(card: &Card, mark: &str) -> Sheet {
    let frame = Extents { least: Vector2::repeat(MARGIN), largest: PAPER.size.add_scalar(-MARGIN) };
    let (left, room) = (frame.least.x + INSIDE, frame.size().x - 2.0 * INSIDE);
    let mut texts = Vec::new();
    let mut top = frame.largest.y - INSIDE;
    let (lines, size) = font::fitted(&card.title, TITLE, room, 3.0 * TITLE);
    for line in lines {
        top -= font::LEADING * size;
        texts.push(words(Vector2::new(left, top), size, TextAnchor::Start, line));
    }
    top = paragraphs(&card.head, (left, room, top - TEXT), &mut texts) - TEXT;
    let (mark_text, mark_size) = font::fitted_in_one(mark, TEXT, room);
    texts.push(words(frame.least.add_scalar(INSIDE), mark_size, TextAnchor::Start, mark_text));
    let foot = frame.least.y + INSIDE + 2.0 * TEXT + height(&card.foot, room);
    paragraphs(&card.foot, (left, room, foot), &mut texts);
    let field = Extents { least: Vector2::new(left, foot + TEXT), largest: Vector2::new(left + room, top) };
    let (lines, figures) = table(card, &field);
    let mark_group = |id, label, shapes| ShapeGroup { class: "facts", ..ShapeGroup::new(id, label, shapes) };
    Sheet {
        title: card.title.clone(),
        extents: Extents { least: Vector2::zeros(), largest: PAPER.size },
        stroke: STROKE,
        scale: 1.0,
        groups: vec![
            ShapeGroup::new("frame", "frame", rectangle(&frame)),
            mark_group("title", "title", texts),
            ShapeGroup { class: "grid-reference", ..ShapeGroup::new("lines", "lines of the table", lines) },
            mark_group("figures", "figures", figures),
        ],
    }
}

/// Lines and figures of the table in its field.
fn table(card: &Card, field: &Extents) -> (Vec<SheetShape>, Vec<SheetShape>) {
    #[expect(clippy::cast_precision_loss, reason = "a few rows and columns")]
    let (columns, rows) = (card.heads.len().max(1) as f64, card.rows.len().max(1) as f64);
    let head = 2.0 * font::LEADING * TEXT + 1.0;
    let row = ((field.size().y - head) / rows).clamp(ROWS.1, ROWS.0);
    let (width, size) = (field.size().x / columns, FIGURE.min(0.7 * row));
    let mut lines = Vec::new();
    let mut figures = Vec::new();
    let across = |y: f64| SheetShape::Line(Vector2::new(field.least.x, y), Vector2::new(field.largest.x, y));
    let mut right = field.least.x;
    for name in &card.heads {
        right += width;
        let mut y = field.largest.y;
        for line in name.split('\n') {
            y -= font::LEADING * TEXT;
            let (line, size) = font::fitted_in_one(line, TEXT, width - 1.0);
            figures.push(words(Vector2::new(right - 1.0, y), size, TextAnchor::End, line));
        }
    }
    let mut y = field.largest.y - head;
    lines.push(across(y));
    for (cells, marked) in &card.rows {
        let mut right = field.least.x;
        let base = y - 0.5 * (row + font::ASCENT * size);
        for cell in cells {
            right += width;
            figures.push(words(Vector2::new(right - 1.0, base), size, TextAnchor::End, cell.clone()));
        }
        if *marked {
            let tip = Vector2::new(field.least.x, y - 0.5 * row);
            let side = |up: f64| tip + Vector2::new(2.2, up);
            figures.push(SheetShape::Triangle([side(-1.1), side(1.1), tip]));
        }
        y -= row;
        lines.push(across(y));
    }
    (lines, figures)
}
