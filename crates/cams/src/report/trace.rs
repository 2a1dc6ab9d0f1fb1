//! A curve as cut together with that of the law, as a diagram of a sheet.

use super::sheet::{ShapeGroup, SheetShape, TextAnchor, font, rounded, words};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Most lines across for the values of a diagram.
const LINES: f64 = 6.0;
/// Room to the left of the field, above and below it, mm.
const LEFT: f64 = 18.0;
const ABOVE: f64 = 12.0;
const BELOW: f64 = 13.0;
const RIGHT: f64 = 6.0;

/// A curve over another: a place, and two values there.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// What the values are, with their unit, and what the thin and the bold line are.
    pub head: String,
    /// What the places are, with their unit.
    pub places: &'static str,
    /// Distance of the lines along, in the unit of the places.
    pub step: f64,
    /// The period after which the places start again, as angles do.
    pub period: Option<f64>,
    /// Place, value of the motion and value as cut, in the order of the places; two at one place where a value jumps.
    pub points: Vec<[f64; 3]>,
}

/// The largest of 1, 2 and 5 times a power of ten of which at most a given number fit into a range.
#[must_use]
pub fn round_step(range: f64, most: f64) -> f64 {
    let decade = libm::pow(10.0, libm::log10(range / most).floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|n| n * decade).find(|step| range / step <= most).unwrap_or(10.0 * decade)
}

/// The points of a whole period from its start on: a curve over angles may start anywhere.
fn from_start(points: &[[f64; 3]], period: Option<f64>) -> Vec<[f64; 3]> {
    let Some(period) = period else { return points.to_vec() };
    let turns = points.first().map_or(0.0, |[first, ..]| (first / period).floor());
    let moved = |[place, motion, cut]: [f64; 3], by: f64| [place - by, motion, cut];
    let end = period * (turns + 1.0);
    let Some(split) = points.iter().position(|[place, ..]| *place >= end) else {
        return points.iter().map(|point| moved(*point, period * turns)).collect();
    };
    let (before, behind) = points.split_at(split);
    let between = before.last().zip(behind.first()).map(|(a, b)| {
        let share = if b[0] > a[0] { (end - a[0]) / (b[0] - a[0]) } else { 0.0 };
        [end, a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])]
    });
    let start = between.map(|point| moved(point, end));
    let behind = behind.iter().map(|point| moved(*point, end));
    let before = before.iter().chain(&between).map(|point| moved(*point, period * turns));
    start.into_iter().chain(behind).chain(before).collect()
}

/// The diagram within a field of paper; nothing where there is no value.
#[must_use]
pub(crate) fn within(field: &Extents, trace: &Trace) -> Vec<ShapeGroup> {
    let trace = &Trace { points: from_start(&trace.points, trace.period), ..trace.clone() };
    let values = trace.points.iter().flat_map(|[_, motion, cut]| [*motion, *cut]);
    let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let (Some([first, ..]), Some([last, ..])) = (trace.points.first(), trace.points.last()) else { return Vec::new() };
    if !(high > low && last > first && (high - low).is_finite()) {
        return Vec::new();
    }
    let size = font::SMALLEST;
    let step = round_step(high - low, LINES);
    let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
    let inner =
        Extents { least: field.least + Vector2::new(LEFT, BELOW), largest: field.largest - Vector2::new(RIGHT, ABOVE) };
    let (width, height) = (inner.size().x, inner.size().y);
    let at = |place: f64, value: f64| {
        let share = Vector2::new((place - first) / (last - first), (value - low) / (high - low));
        inner.least + Vector2::new(width * share.x, height * share.y)
    };
    let mut grid = Vec::new();
    let mut value = low;
    while value <= high + 0.5 * step {
        grid.push(SheetShape::Line(at(*first, value), at(*last, value)));
        let place = at(*first, value) - Vector2::new(0.5, 0.35) * size;
        let text = rounded((value / step).round() * step);
        let (text, size) = font::fitted_in_one(&text, size, LEFT - 2.0);
        grid.push(words(place, size, TextAnchor::End, text));
        value += step;
    }
    grid.extend(along(trace, (*first, *last), size, width, |place, up| at(place, if up { high } else { low })));
    let curve = |index: usize| {
        let point = |values: &[f64; 3]| {
            let [place, ..] = values;
            values.get(index).map(|value| at(*place, *value))
        };
        vec![SheetShape::Path(trace.points.iter().filter_map(point).collect())]
    };
    let heads = font::wrapped(&trace.head, size, width);
    let head = heads.iter().rev().zip(0_u32..).map(|(line, above)| {
        let up = (0.8 + font::LEADING * f64::from(above)) * size;
        words(Vector2::new(inner.least.x, inner.largest.y + up), size, TextAnchor::Start, line.clone())
    });
    let below = Vector2::new(0.5 * (inner.least.x + inner.largest.x), inner.least.y - 2.7 * size);
    let names = head.chain([words(below, size, TextAnchor::Middle, trace.places)]).collect();
    vec![
        ShapeGroup::new("trace-grid", "lines of the diagram", grid),
        ShapeGroup::new("trace-cut", "as cut", curve(2)),
        ShapeGroup::new("trace-motion", "by the law", curve(1)),
        ShapeGroup { class: "facts", ..ShapeGroup::new("trace-names", "names of the diagram", names) },
    ]
}

/// The lines along with as many names as there is room for; `at` is a place at the foot or at the head of the field.
fn along(
    trace: &Trace,
    (first, last): (f64, f64),
    size: f64,
    width: f64,
    at: impl Fn(f64, bool) -> Vector2<f64>,
) -> Vec<SheetShape> {
    let mut lines = Vec::new();
    let named = (font::width("0000", size) * (last - first) / (width * trace.step)).ceil().max(1.0) * trace.step;
    let mut place = (first / trace.step).ceil() * trace.step;
    while place <= last {
        lines.push(SheetShape::Line(at(place, false), at(place, true)));
        // The end of a whole turn is 360°, not 0.
        let shown =
            trace.period.filter(|period| place > *period).map_or(place, |period| place.rem_euclid(period)) + 0.0;
        if (place / named - (place / named).round()).abs() < 1e-9 {
            let below = at(place, false) - Vector2::new(0.0, 1.3 * size);
            lines.push(words(below, size, TextAnchor::Middle, rounded(shown)));
        }
        place += trace.step;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turn that begins at 300° is shown from 0, cut where it passes 360°, and ends there.
    #[test]
    fn a_turn_is_shown_from_its_start() {
        let points: Vec<[f64; 3]> = [300.0, 340.0, 380.0, 500.0, 660.0].map(|at| [at, 2.0 * at, -at]).to_vec();
        let shown = from_start(&points, Some(360.0));
        let places: Vec<f64> = shown.iter().map(|[at, ..]| *at).collect();
        assert_eq!(places, [0.0, 20.0, 140.0, 300.0, 300.0, 340.0, 360.0]);
        assert_eq!(shown.first(), Some(&[0.0, 720.0, -360.0]));
        assert_eq!(shown.last(), Some(&[360.0, 720.0, -360.0]));
        assert_eq!(from_start(&points, None), points);
    }
}
