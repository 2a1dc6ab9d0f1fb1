//! Bars, before light and after dark, and ranges below each other.

use super::{BarChart, BarRow, SpanChart};
use crate::report::page::{PicturePage, area, hatch};
use crate::report::sheet::{SheetShape, TextAnchor, font, words};
use crate::report::style::{NAME, PictureColour, SMALL, TEXT, figure, ticks};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Room above for names, below for round values, and for the keys of the bars, mm over the lettering.
const ABOVE: f64 = 9.0;
const BELOW: f64 = 6.0;
const KEYS: f64 = 7.0;
/// Width of the cells and of the shares at the right, of the conditions after the names, and of the text after a bar.
const CELLS: f64 = 24.0;
const SHARES: f64 = 40.0;
const NOTES: f64 = 20.0;
const AFTER: f64 = 22.0;
/// Most height of a row, and heights of the bars over that of their row.
const ROW: f64 = 11.5;
const BAR: f64 = 0.56;
const THIN: f64 = 0.34;
/// Radii of the dots of a range.
const DOT: f64 = 1.5;
const END: f64 = 0.9;
/// The colour of the bars.
const COLOUR: PictureColour = PictureColour::Line(0);

/// Width of the names and conditions of both kinds, mm.
pub(super) fn name_width(bars: Option<&BarChart>, spans: Option<&SpanChart>, k: f64) -> f64 {
    let of_bars = bars.into_iter().flat_map(|chart| &chart.rows).map(|row| (&row.name, NOTES));
    let of_spans = spans.into_iter().flat_map(|chart| &chart.rows).map(|row| (&row.name, 0.0));
    let widths = of_bars.chain(of_spans).map(|(name, note)| font::width(name, TEXT * k) + (note + 3.0) * k);
    widths.fold(0.0, f64::max)
}

/// The bars in their part of the page.
pub(super) fn draw(page: &mut PicturePage, chart: &BarChart, names: f64, part: &Extents) {
    let k = page.k;
    let (size, small) = (TEXT * k, SMALL * k);
    #[expect(clippy::cast_precision_loss, reason = "a few rows")]
    let count = chart.rows.len().max(1) as f64;
    let height = ((part.size().y - (ABOVE + BELOW + KEYS) * k) / count).min(ROW * k);
    let top = part.largest.y - ABOVE * k;
    let field = Extents {
        least: Vector2::new(part.least.x + names, top - count * height),
        largest: Vector2::new(part.largest.x - (CELLS + SHARES + 2.0) * k, top),
    };
    let most = chart.rows.iter().flat_map(|row| [row.before, row.after]).filter(|value| value.is_finite());
    let most = most.fold(0.0, f64::max).max(1e-12);
    // The longest bar has its text within the field.
    let scale = (field.size().x - AFTER * k) / most;
    let name_at = Vector2::new(part.least.x, field.largest.y + 1.2 * size);
    page.add("strong", "what is shown", None, vec![words(name_at, NAME * k, TextAnchor::Start, chart.name.as_str())]);
    let cells_at = field.largest.x + CELLS * k;
    let shares_at = cells_at + 4.0 * k;
    let [cells, shares] = &chart.heads;
    let heads = vec![
        words(Vector2::new(cells_at, name_at.y), small, TextAnchor::End, cells.as_str()),
        words(Vector2::new(shares_at, name_at.y), small, TextAnchor::Start, shares.as_str()),
    ];
    page.add("second", "heads", None, heads);
    page.add("area", "field", Some("#fafbfd"), vec![area(&field)]);
    round_values(page, (0.0, field.size().x / scale), scale, &field);
    let mut y = field.largest.y;
    let mut second = Vec::new();
    let mut facts = Vec::new();
    for row in &chart.rows {
        let middle = y - 0.5 * height;
        let bar = |length: f64, share: f64| {
            let half = 0.5 * share * height;
            area(&Extents {
                least: Vector2::new(field.least.x, middle - half),
                largest: Vector2::new(field.least.x + length.max(0.3), middle + half),
            })
        };
        page.add("area", &row.name, Some(COLOUR.tint()), vec![bar(row.before * scale, BAR)]);
        if row.after.is_finite() {
            page.add("area", &row.name, Some(COLOUR.line()), vec![bar(row.after * scale, THIN)]);
        }
        let base = middle - 0.35 * size;
        let left = field.least.x - (NOTES + 2.0) * k;
        facts.push(words(Vector2::new(left, base), size, TextAnchor::End, row.name.as_str()));
        second.push(words(Vector2::new(field.least.x - 2.0 * k, base), small, TextAnchor::End, row.note.as_str()));
        values_of_row(page, row, scale, &Extents { least: Vector2::new(field.least.x, base), largest: field.largest });
        if !row.cell.is_empty() {
            facts.push(words(Vector2::new(cells_at, base), size, TextAnchor::End, row.cell.as_str()));
        }
        if let Some((share, text)) = &row.share {
            let length = share.clamp(0.0, 1.0) * 0.5 * SHARES * k;
            let half = 0.5 * THIN * height;
            let field = Extents {
                least: Vector2::new(shares_at, middle - half),
                largest: Vector2::new(shares_at + length.max(0.3), middle + half),
            };
            page.add("area", &row.name, Some(PictureColour::Grey.line()), vec![area(&field)]);
            second.push(words(Vector2::new(field.largest.x + 1.5 * k, base), small, TextAnchor::Start, text.as_str()));
        }
        y -= height;
    }
    page.add("facts", "names", None, facts);
    page.add("second", "conditions", None, second);
    keys(page, chart, &field);
}

/// The figures of both bars after the longer one, or the one of the dark bar on the light one where it has room there.
fn values_of_row(page: &mut PicturePage, row: &BarRow, scale: f64, line: &Extents) {
    let (k, size) = (page.k, TEXT * page.k);
    if !row.after.is_finite() {
        let at = Vector2::new(line.least.x + scale * row.before + 1.5 * k, line.least.y);
        let text = words(at, size, TextAnchor::Start, figure(row.before));
        return page.add("second", &row.name, None, vec![text]);
    }
    let (before, after) = (figure(row.before), figure(row.after));
    let ends = [row.before, row.after].map(|value| line.least.x + scale * value);
    let room = ends[0] - ends[1] - 3.0 * k;
    let at = |x: f64| Vector2::new(x + 1.5 * k, line.least.y);
    if room > font::width(&after, size) {
        page.add("second", &row.name, None, vec![words(at(ends[0]), size, TextAnchor::Start, before)]);
        let text = words(at(ends[1]), size, TextAnchor::Start, after);
        page.add("strong", &row.name, None, vec![text]);
    } else {
        let text = words(at(ends[0].max(ends[1])), size, TextAnchor::Start, format!("{before} → {after}"));
        page.add("second", &row.name, None, vec![text]);
    }
}

/// What the light and the dark bars are.
fn keys(page: &mut PicturePage, chart: &BarChart, field: &Extents) {
    let (k, size) = (page.k, SMALL * page.k);
    let y = field.least.y - (BELOW + 3.5) * k;
    let mut x = field.least.x;
    for (key, colour) in chart.keys.iter().zip([COLOUR.tint(), COLOUR.line()]) {
        let swatch = Extents { least: Vector2::new(x, y), largest: Vector2::new(x + 5.0 * k, y + 0.8 * size) };
        page.add("area", key, Some(colour), vec![area(&swatch)]);
        let at = Vector2::new(x + 6.5 * k, y + 0.1 * size);
        page.add("second", key, None, vec![words(at, size, TextAnchor::Start, key.as_str())]);
        x += 6.5 * k + font::width(key, size) + 8.0 * k;
    }
}

/// Round values below a field, with their lines.
fn round_values(page: &mut PicturePage, along: (f64, f64), scale: f64, field: &Extents) {
    let (k, size) = (page.k, SMALL * page.k);
    let mut lines = Vec::new();
    let mut texts = Vec::new();
    for value in ticks(along, (field.size().x / (22.0 * k)).clamp(2.0, 8.0)) {
        let x = field.least.x + scale * (value - along.0);
        lines.push(SheetShape::Line(Vector2::new(x, field.least.y), Vector2::new(x, field.largest.y)));
        texts.push(words(Vector2::new(x, field.least.y - 1.3 * size), size, TextAnchor::Middle, figure(value)));
    }
    page.add("tick", "lines of round values", None, lines);
    page.add("tick", "round values", None, texts);
}

/// Ranges in their part of the page.
pub(super) fn draw_spans(page: &mut PicturePage, chart: &SpanChart, names: f64, part: &Extents) {
    let (k, size) = (page.k, TEXT * page.k);
    #[expect(clippy::cast_precision_loss, reason = "a few rows")]
    let count = chart.rows.len().max(1) as f64;
    let height = ((part.size().y - (ABOVE + BELOW) * k) / count).min(ROW * k);
    let top = part.largest.y - ABOVE * k;
    let field = Extents {
        least: Vector2::new(part.least.x + names, top - count * height),
        largest: Vector2::new(part.largest.x, top),
    };
    let most = chart.rows.iter().flat_map(|row| row.values).filter(|value| value.is_finite()).fold(0.0, f64::max);
    let high = 1.25 * most.max(1e-12);
    let scale = field.size().x / high;
    let at = Vector2::new(part.least.x, field.largest.y + 1.0 * size);
    page.add("strong", "what is shown", None, vec![words(at, NAME * k, TextAnchor::Start, chart.name.as_str())]);
    page.add("area", "field", Some("#fafbfd"), vec![area(&field)]);
    if let Some((limit, reason)) = chart.limit.as_ref().filter(|(limit, _)| *limit < high) {
        let x = field.least.x + scale * limit;
        let beyond = Extents { least: Vector2::new(x, field.least.y), largest: field.largest };
        page.add("area", reason, Some(PictureColour::Limit.tint()), vec![area(&beyond)]);
        page.add("hatch", reason, None, hatch(&beyond));
        page.add("limit-line", reason, None, vec![SheetShape::Line(beyond.least, Vector2::new(x, field.largest.y))]);
        let at = Vector2::new(field.largest.x - 1.5 * k, field.largest.y - 1.2 * size);
        let (text, size) = font::fitted_in_one(reason, size, beyond.size().x - 3.0 * k);
        page.label(PictureColour::Limit, reason, vec![words(at, size, TextAnchor::End, text)]);
    }
    round_values(page, (0.0, high), scale, &field);
    let mut facts = Vec::new();
    for (index, row) in chart.rows.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "a few rows")]
        let y = field.largest.y - (index as f64 + 0.5) * height;
        let on = |value: f64| Vector2::new(field.least.x + scale * value, y);
        let [low, middle, last] = row.values;
        facts.push(words(
            Vector2::new(field.least.x - 2.0 * k, y - 0.35 * size),
            size,
            TextAnchor::End,
            row.name.as_str(),
        ));
        if !(low + middle + last).is_finite() {
            continue;
        }
        let half = Vector2::new(0.0, 0.45 * k);
        let bar = Extents { least: on(low) - half, largest: on(last) + half };
        page.add("area", &row.name, Some(row.colour.line()), vec![area(&bar)]);
        let ends = [low, last].map(|value| SheetShape::Entity(Entity::Circle(on(value), END * k)));
        page.add("curve-mark", &row.name, Some(row.colour.line()), ends.to_vec());
        page.add(
            "dot",
            &row.name,
            Some(row.colour.line()),
            vec![SheetShape::Entity(Entity::Circle(on(middle), DOT * k))],
        );
        let text = words(on(last) + Vector2::new(2.5 * k, -0.35 * size), size, TextAnchor::Start, row.text.as_str());
        page.label(row.colour, &row.name, vec![text]);
    }
    page.add("facts", "names", None, facts);
}
