//! Labels of a panel, where they touch no curve, no mark and no other label, and grid lines that leave them out.

use crate::report::sheet::SheetShape;
use crate::report::sheet::placing::{OccupiedPaper, field_near, filling, half_field};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Radius of the mark of an extreme, mm.
pub(super) const MARK: f64 = 0.7;
/// Height of a label, mm.
pub(super) const SIZE: f64 = crate::report::sheet::font::SMALLEST;
/// Distances of a label from its place that are tried, mm, the nearest first; only a label that must be seen is put far away.
const NEAR: [f64; 5] = [1.3, 2.0, 3.0, 4.5, 6.5];
const FAR: [f64; 8] = [9.0, 12.0, 16.0, 22.0, 30.0, 40.0, 55.0, 75.0];
/// A label farther away is tied to its place with a line.
const TIED: f64 = 2.6;
/// Directions that are tried.
const DIRECTIONS: u32 = 24;
/// Room between a label and a line of the grid that is cut for it, mm.
const CLEAR: f64 = 0.5;

/// A label near a place, above or below it where there is room, with the line that ties it; nothing where there is no room.
pub(super) fn label(
    taken: &mut OccupiedPaper,
    at: Vector2<f64>,
    upwards: bool,
    text: &str,
    must_be_seen: bool,
) -> Vec<SheetShape> {
    let half = half_field(text, SIZE);
    let first = if upwards { 0.25 * TAU } else { -0.25 * TAU };
    let far = if must_be_seen { &FAR[..] } else { &[] };
    for distance in NEAR.iter().chain(far) {
        for index in 0..DIRECTIONS {
            let step = f64::from(index.div_ceil(2)) * if index % 2 == 0 { -1.0 } else { 1.0 };
            let angle = first + step * TAU / f64::from(DIRECTIONS);
            let along = Vector2::new(libm::cos(angle), libm::sin(angle));
            let field = field_near(at, along, *distance, half);
            let nearest = at.sup(&field.least).inf(&field.largest);
            let apart = (nearest - at).norm();
            let tied = apart > TIED;
            if apart < 0.5 * MARK || !taken.free(&field) || (tied && !taken.clear(at, nearest)) {
                continue;
            }
            let mut shapes = vec![filling(&field, SIZE, text)];
            if tied {
                let back = (at - nearest) / apart;
                shapes.push(SheetShape::Line(at - back * MARK, nearest + back * 0.5));
            }
            for shape in &shapes {
                taken.put(shape);
            }
            return shapes;
        }
    }
    Vec::new()
}

/// What is left of an upright or level line where it does not meet these fields.
pub(super) fn around(from: Vector2<f64>, to: Vector2<f64>, fields: &[Extents]) -> Vec<SheetShape> {
    let length = (to - from).norm();
    if !(length > 0.0) {
        return Vec::new();
    }
    let along = (to - from) / length;
    let across = Vector2::new(-along.y, along.x);
    let gap = |field: &Extents| {
        let corners = [field.least.add_scalar(-CLEAR) - from, field.largest.add_scalar(CLEAR) - from];
        let [a, b] = corners.map(|corner| corner.dot(&across));
        let [start, end] = corners.map(|corner| corner.dot(&along));
        (a * b < 0.0).then(|| (start.min(end), start.max(end)))
    };
    let mut gaps: Vec<(f64, f64)> = fields.iter().filter_map(gap).collect();
    gaps.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = Vec::new();
    let mut at = 0.0;
    for (start, end) in gaps.into_iter().chain([(length, length)]) {
        let until = start.min(length);
        if until > at {
            left.push(SheetShape::Line(from + along * at, from + along * until));
        }
        at = at.max(end);
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_cut_around_labels() {
        let field = |x: f64| Extents { least: Vector2::new(x, -1.0), largest: Vector2::new(x + 2.0, 1.0) };
        let ends = |shapes: Vec<SheetShape>| -> Vec<[f64; 2]> {
            let of = |shape| if let SheetShape::Line(a, b) = shape { Some([a.x, b.x]) } else { None };
            shapes.into_iter().filter_map(of).collect()
        };
        let (from, to) = (Vector2::zeros(), Vector2::new(10.0, 0.0));
        assert_eq!(ends(around(from, to, &[field(6.0), field(2.0)])), [[0.0, 1.5], [4.5, 5.5], [8.5, 10.0]]);
        let above = Vector2::new(0.0, 2.0);
        assert_eq!(ends(around(from + above, to + above, &[field(2.0)])), [[0.0, 10.0]]);
        assert_eq!(ends(around(from, to, &[field(-1.0), field(9.0)])), [[1.5, 8.5]]);
    }
}
