//! A table next to plots: what to set.

use super::SideTable;
use crate::report::page::{PicturePage, area};
use crate::report::sheet::paper::rectangle;
use crate::report::sheet::{SheetShape, TextAnchor, font, words};
use crate::report::style::{NAME, SMALL, TEXT};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Room within its frame, and height of a row over its text.
const INSIDE: f64 = 4.0;
const ROW: f64 = 2.1;

/// The table at the head of its field, as high as it needs.
pub(super) fn draw(page: &mut PicturePage, table: &SideTable, field: &Extents) {
    let k = page.k;
    let (left, right) = (field.least.x + INSIDE * k, field.largest.x - INSIDE * k);
    let room = right - left;
    let mut y = field.largest.y - INSIDE * k;
    let mut strong = Vec::new();
    for line in font::wrapped(&table.title, NAME * k, room) {
        y -= font::LEADING * NAME * k;
        strong.push(words(Vector2::new(left, y), NAME * k, TextAnchor::Start, line));
    }
    #[expect(clippy::cast_precision_loss, reason = "a few columns")]
    let columns = table.heads.len().max(2) as f64;
    let edge = |index: usize| {
        #[expect(clippy::cast_precision_loss, reason = "a few columns")]
        let index = index as f64;
        // The first column is the narrowest: a speed, or a letter.
        if index == 0.0 { left } else { left + room * (0.12 + 0.88 * index / (columns - 1.0)) }
    };
    let cell = |index: usize, y: f64, size: f64, text: &str| {
        let (text, size) = font::fitted_in_one(text, size, 0.95 * room / (columns - 1.0).max(1.0));
        let anchor = if index == 0 { TextAnchor::Start } else { TextAnchor::End };
        words(Vector2::new(edge(index).min(right), y), size, anchor, text)
    };
    y -= 0.6 * TEXT * k;
    let mut second = Vec::new();
    y -= font::LEADING * SMALL * k;
    second.extend(table.heads.iter().enumerate().map(|(index, head)| cell(index, y, SMALL * k, head)));
    y -= 0.5 * TEXT * k;
    let (mut tints, mut cells): (Vec<(&str, SheetShape)>, Vec<SheetShape>) = (Vec::new(), Vec::new());
    for row in &table.rows {
        let below = y - ROW * TEXT * k;
        let base = 0.5 * (y + below) - 0.35 * TEXT * k;
        if let Some(tint) = row.tint {
            let inset = 0.5 * INSIDE * k;
            let field = Extents {
                least: Vector2::new(left - inset, below + 0.15 * TEXT * k),
                largest: Vector2::new(right + inset, y - 0.15 * TEXT * k),
            };
            tints.push((tint.tint(), area(&field)));
        }
        for (index, text) in row.cells.iter().enumerate() {
            let shape = cell(index, base, TEXT * k, text);
            if index == 0 { strong.push(shape) } else { cells.push(shape) }
        }
        y = below;
    }
    y -= 0.4 * TEXT * k;
    for note in &table.notes {
        y -= 0.4 * SMALL * k;
        for line in font::wrapped(note, SMALL * k, room) {
            y -= font::LEADING * SMALL * k;
            second.push(words(Vector2::new(left, y), SMALL * k, TextAnchor::Start, line));
        }
    }
    let frame = Extents { least: Vector2::new(field.least.x, y - INSIDE * k), largest: field.largest };
    page.add("edge", "frame of the table", None, rectangle(&frame));
    for (tint, shape) in tints {
        page.add("area", "row", Some(tint), vec![shape]);
    }
    page.add("strong", "names of the table", None, strong);
    page.add("facts", "figures of the table", None, cells);
    page.add("second", "notes of the table", None, second);
}
