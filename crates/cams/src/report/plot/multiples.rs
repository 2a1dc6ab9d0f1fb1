//! Small plots on one scale, with the design's own curve in grey behind each.

use super::{SmallPlot, SmallPlots, finite, range};
use crate::report::page::{PicturePage, area};
use crate::report::sheet::paper::rectangle;
use crate::report::sheet::{SheetShape, TextAnchor, font, words};
use crate::report::style::{NAME, PictureColour, SMALL, TEXT, figure, ticks};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Most plots in a row, and the number up to which they are in rows of three.
const MOST: usize = 6;
const FEW: usize = 9;
/// Room above a plot for its name, below it for its figures, and between two, mm over the lettering.
const ABOVE: f64 = 5.0;
const BELOW: f64 = 6.5;
const APART: f64 = 3.0;
/// Room above all for what is shown, and below all for what was left out.
const HEAD: f64 = 6.0;
const FOOT: f64 = 5.0;
/// Room above and below the curves over their range.
const HEADROOM: f64 = 0.16;
/// Ground of the design's own.
const OWN: &str = "#edecf9";
/// Radius of a peak's dot.
const DOT: f64 = 0.9;

/// How many stand in a row.
fn columns(chart: &SmallPlots) -> usize {
    let most = match chart.in_a_row {
        0 if chart.plots.len() <= FEW => 3,
        0 => MOST,
        given => given,
    };
    most.min(chart.plots.len().max(1))
}

/// How many rows there are.
#[expect(clippy::cast_precision_loss, reason = "a few rows")]
pub(super) fn rows(chart: &SmallPlots) -> f64 {
    chart.plots.len().div_ceil(columns(chart)).max(1) as f64
}

/// The plots in their part of the page.
pub(super) fn draw(page: &mut PicturePage, chart: &SmallPlots, part: &Extents) {
    let k = page.k;
    let (Some(along), Some((low, high))) = (
        range(chart.plots.iter().flat_map(|plot| finite(&plot.points)).map(|[place, _]| place)),
        range(chart.plots.iter().flat_map(|plot| finite(&plot.points)).map(|[_, value]| value).chain([0.0])),
    ) else {
        return;
    };
    let room = HEADROOM * (high - low);
    let across = (if low < 0.0 { low - room } else { 0.0 }, if high > 0.0 { high + room } else { 0.0 });
    let columns = columns(chart);
    let values = ticks(across, 6.0);
    let left = values.iter().map(|value| font::width(&figure(*value), SMALL * k)).fold(0.0, f64::max) + 2.5 * k;
    let head = Vector2::new(part.least.x, part.largest.y - 0.9 * NAME * k);
    let (name, size) = font::fitted_in_one(&chart.name, NAME * k, part.size().x);
    page.add("strong", "what is shown", None, vec![words(head, size, TextAnchor::Start, name)]);
    let foot = if chart.left_out.is_empty() { 0.0 } else { FOOT * k };
    #[expect(clippy::cast_precision_loss, reason = "a few rows and columns")]
    let across_count = columns as f64;
    let width = (part.size().x - left - APART * k * (across_count - 1.0)) / across_count;
    let height = (part.size().y - HEAD * k - foot) / rows(chart);
    let own = chart.plots.iter().find(|plot| plot.is_own);
    for (index, plot) in chart.plots.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "a few rows and columns")]
        let (column, row) = ((index % columns) as f64, (index / columns) as f64);
        let x = part.least.x + left + column * (width + APART * k);
        let top = part.largest.y - HEAD * k - row * height;
        let field = Extents {
            least: Vector2::new(x, top - height + BELOW * k),
            largest: Vector2::new(x + width, top - ABOVE * k),
        };
        let at = |[place, value]: [f64; 2]| {
            let share = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
            field.least + field.size().component_mul(&Vector2::new(share(place, along), share(value, across)))
        };
        let tint = if plot.is_own { OWN } else { "#fafbfd" };
        page.add("area", &plot.name, Some(tint), vec![area(&field)]);
        let lines = values.iter().map(|value| SheetShape::Line(at([along.0, *value]), at([along.1, *value])));
        page.add("tick", "round values", None, lines.collect());
        page.add("edge", "zero", None, vec![SheetShape::Line(at([along.0, 0.0]), at([along.1, 0.0]))]);
        page.add("edge", &plot.name, None, rectangle(&field));
        if column == 0.0 {
            let texts = values.iter().map(|value| {
                let place = at([along.0, *value]) - Vector2::new(1.2 * k, 0.35 * SMALL * k);
                words(place, SMALL * k, TextAnchor::End, figure(*value))
            });
            page.add("tick", "round values", None, texts.collect());
        }
        let path = |plot: &SmallPlot| SheetShape::Path(finite(&plot.points).map(&at).collect());
        if let Some(own) = own.filter(|_| !plot.is_own) {
            page.add("curve", &own.name, Some(PictureColour::Grey.line()), vec![path(own)]);
        }
        page.add("curve-bold", &plot.name, Some(PictureColour::Line(0).line()), vec![path(plot)]);
        texts(page, plot, &field, at);
    }
    if !chart.left_out.is_empty() {
        let (text, size) = font::fitted_in_one(&chart.left_out, SMALL * k, part.size().x);
        let at = Vector2::new(part.least.x, part.least.y + 0.5 * k);
        page.add("second", "left out", None, vec![words(at, size, TextAnchor::Start, text)]);
    }
}

/// Name, peak and figures of a plot.
fn texts(page: &mut PicturePage, plot: &SmallPlot, field: &Extents, at: impl Fn([f64; 2]) -> Vector2<f64>) {
    let (k, size, small) = (page.k, TEXT * page.k, SMALL * page.k);
    let beside = plot.peak.as_ref().map_or(0.0, |peak| font::width(&peak.text, size) + k);
    let (name, name_size) = font::fitted_in_one(&plot.name, size, field.size().x - beside);
    let above = Vector2::new(field.least.x, field.largest.y + 0.45 * size);
    page.add("strong", &plot.name, None, vec![words(above, name_size, TextAnchor::Start, name)]);
    let base = field.least.y - 1.35 * size;
    let (figure, is_better) = &plot.figure;
    let text = words(Vector2::new(field.least.x, base), small, TextAnchor::Start, figure.as_str());
    if !figure.is_empty() {
        if *is_better {
            page.label(PictureColour::Line(0), &plot.name, vec![text]);
        } else {
            page.add("facts", &plot.name, None, vec![text]);
        }
    }
    if !plot.note.is_empty() {
        let room = field.size().x - font::width(figure, small) - 2.0 * k;
        let (note, note_size) = font::fitted_in_one(&plot.note, small, room);
        let at = Vector2::new(field.largest.x, base);
        page.add("second", &plot.name, None, vec![words(at, note_size, TextAnchor::End, note)]);
    }
    let Some(peak) = plot.peak.as_ref().filter(|peak| peak.at.iter().all(|value| value.is_finite())) else { return };
    let place = at(peak.at);
    let dot = SheetShape::Entity(Entity::Circle(place, DOT * k));
    page.add("dot", &plot.name, Some(peak.colour.line()), vec![dot]);
    // Above the plot at its right, where no curve is.
    let at = Vector2::new(field.largest.x, field.largest.y + 0.45 * size);
    page.label(peak.colour, &plot.name, vec![words(at, size, TextAnchor::End, peak.text.as_str())]);
}
