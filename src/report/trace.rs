//! The acceleration as cut beside that of the motion, as a diagram below a sheet.

use super::sheet::{Group, LINE_SPACING, Pen, STROKE_OVER_TEXT, Shape, Sheet, TextAnchor, rounded};
use nalgebra::Vector2;

/// Height of the diagram over its width.
const HEIGHT_OVER_WIDTH: f64 = 0.22;
/// Most lines across for the values of a diagram.
const LINES: f64 = 6.0;

/// A curve over another: a place, and two values there.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// What the values are, with their unit.
    pub title: String,
    /// What the places are, with their unit.
    pub places: &'static str,
    /// Distance of the lines along, in the unit of the places.
    pub step: f64,
    /// After so much the places begin again, as angles do.
    pub period: Option<f64>,
    /// Place, value of the motion and value as cut, in the order of the places; two at one place where a value jumps.
    pub points: Vec<[f64; 3]>,
}

/// The largest of 1, 2 and 5 times a power of ten of which no more than so many fit into a range.
fn round_step(range: f64, most: f64) -> f64 {
    let decade = libm::pow(10.0, libm::log10(range / most).floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|n| n * decade).find(|step| range / step <= most).unwrap_or(10.0 * decade)
}

/// The sheet with a diagram below all that is on it.
#[must_use]
pub(crate) fn below(mut sheet: Sheet, trace: &Trace) -> Sheet {
    let values = trace.points.iter().flat_map(|[_, motion, cut]| [*motion, *cut]);
    let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let (Some([first, ..]), Some([last, ..])) = (trace.points.first(), trace.points.last()) else { return sheet };
    if !(high > low && last > first && (high - low).is_finite()) {
        return sheet;
    }
    let pen = Pen { text: sheet.stroke / STROKE_OVER_TEXT };
    let (margin, line) = (2.0 * pen.text, LINE_SPACING * pen.text);
    let step = round_step(high - low, LINES);
    let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
    let left = sheet.extents.least.x + margin + 5.0 * pen.text;
    let width = sheet.extents.largest.x - margin - left;
    let height = HEIGHT_OVER_WIDTH * width;
    let top = sheet.extents.least.y - 2.0 * line;
    let at = |place: f64, value: f64| {
        Vector2::new(left + width * (place - first) / (last - first), top - height * (high - value) / (high - low))
    };
    let mut grid = Vec::new();
    let mut value = low;
    while value <= high + 0.5 * step {
        grid.push(Shape::Line(at(*first, value), at(*last, value)));
        let place = at(*first, value) - Vector2::new(0.5, 0.35) * pen.text;
        let text = rounded((value / step).round() * step);
        grid.push(Shape::Text { at: place, height: pen.text, anchor: TextAnchor::End, text });
        value += step;
    }
    let mut place = (first / trace.step).ceil() * trace.step;
    while place <= *last {
        grid.push(Shape::Line(at(place, low), at(place, high)));
        let shown = trace.period.map_or(place, |period| place.rem_euclid(period));
        grid.push(pen.middle(at(place, low) - Vector2::new(0.0, 1.4 * pen.text), rounded(shown)));
        place += trace.step;
    }
    let curve = |index: usize| {
        let point = |values: &[f64; 3]| {
            let [place, ..] = values;
            values.get(index).map(|value| at(*place, *value))
        };
        vec![Shape::Path(trace.points.iter().filter_map(point).collect())]
    };
    let words = vec![
        pen.words(left, top + 0.8 * pen.text, format!("{}: motion (thin), as cut (bold)", trace.title)),
        pen.middle(at(0.5 * (first + last), low) - Vector2::new(0.0, 1.4 * pen.text + line), trace.places),
    ];
    sheet.groups.push(Group::new("trace-grid", "lines of the diagram", grid));
    sheet.groups.push(Group::new("trace-cut", "acceleration as cut", curve(2)));
    sheet.groups.push(Group::new("trace-motion", "acceleration of the motion", curve(1)));
    sheet.groups.push(Group::new("facts", "names of the diagram", words));
    sheet.extents.least.y = top - height - 2.0 * line - margin;
    sheet
}
