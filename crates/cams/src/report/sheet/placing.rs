//! The free parts of the paper: a map of cells, so that a place for a text is found in a few microseconds.

use super::{SheetShape, TextAnchor, font, words};
use camgen_kernel::geometry::contour::{Edge, Extents, Segment};
use nalgebra::Vector2;

/// Side of a cell, mm.
const CELL: f64 = 0.8;
/// Distance of the points of a line by which its cells are found, mm.
const NEAR: f64 = 0.5 * CELL;
/// Most points of a curve: a curve far larger than any paper is followed coarsely.
const MOST: f64 = 4000.0;

/// Free paper between a text and the edge of the region, mm.
const MARGIN: f64 = 0.7;

/// How soon the corner of a text, not its side, is nearest to its place.
const LEAN: f64 = 1.6;

/// The field of a text of these half sides, so far from a place in a direction (a unit vector).
pub(in crate::report) fn field_near(
    at: Vector2<f64>,
    along: Vector2<f64>,
    distance: f64,
    half: Vector2<f64>,
) -> Extents {
    let lean = (along * LEAN).map(|part| part.clamp(-1.0, 1.0)).component_mul(&half);
    let middle = at + along * distance + lean;
    Extents { least: middle - half, largest: middle + half }
}

/// Half the sides of the field of a text.
pub(in crate::report) fn half_field(text: &str, size: f64) -> Vector2<f64> {
    0.5 * Vector2::new(font::width(text, size), (font::ASCENT + font::DESCENT) * size)
}

/// A text that fills a field.
pub(in crate::report) fn filling(field: &Extents, size: f64, text: &str) -> SheetShape {
    let base = Vector2::new(0.5 * (field.least.x + field.largest.x), field.least.y + font::DESCENT * size);
    words(base, size, TextAnchor::Middle, text)
}

/// The occupied cells of a region of the paper.
#[derive(Debug)]
pub(in crate::report) struct OccupiedPaper {
    region: Extents,
    across: usize,
    rows: usize,
    lines: Vec<bool>,
    texts: Vec<bool>,
}

impl OccupiedPaper {
    /// A region that is free.
    pub(in crate::report) fn none(region: Extents) -> Self {
        let count = |length: f64| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a sheet of paper")]
            let count = (length / CELL).ceil().clamp(1.0, 4000.0) as usize;
            count
        };
        let size = region.size();
        let (across, rows) = (count(size.x), count(size.y));
        Self { region, across, rows, lines: vec![false; across * rows], texts: vec![false; across * rows] }
    }

    fn cell(&self, point: Vector2<f64>) -> Option<usize> {
        let place = (point - self.region.least) / CELL;
        if !(place.x >= 0.0 && place.y >= 0.0) {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative; saturates")]
        let (column, row) = (place.x as u32 as usize, place.y as u32 as usize);
        (column < self.across && row < self.rows).then_some(row * self.across + column)
    }

    /// The points of a straight line, half a cell apart.
    fn along(from: Vector2<f64>, to: Vector2<f64>) -> impl Iterator<Item = Vector2<f64>> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most ten thousand")]
        let steps = ((to - from).norm() / NEAR).ceil().clamp(1.0, 1e4) as u32;
        (0..=steps).map(move |step| from + (to - from) * (f64::from(step) / f64::from(steps)))
    }

    /// Whether a line is clear of texts.
    pub(in crate::report) fn clear(&self, from: Vector2<f64>, to: Vector2<f64>) -> bool {
        Self::along(from, to)
            .all(|point| self.cell(point).is_none_or(|cell| !self.texts.get(cell).copied().unwrap_or(false)))
    }

    /// Marks the cells of a shape as occupied.
    pub(in crate::report) fn put(&mut self, shape: &SheetShape) {
        if let Some(field) = shape.text_field() {
            self.fill(&field);
        }
        match shape {
            SheetShape::Entity(entity) => entity.contour().edges().for_each(|edge| self.put_edge(&edge)),
            SheetShape::Line(a, b) => self.put_line(*a, *b),
            SheetShape::Path(points) => {
                points.iter().zip(points.iter().skip(1)).for_each(|(a, b)| self.put_line(*a, *b));
            }
            SheetShape::Arc(start, end, bulge) => {
                self.put_edge(&Edge::Segment(Segment { start: *start, end: *end, bulge: *bulge }));
            }
            SheetShape::Triangle([a, b, c]) => {
                for (start, end) in [(a, b), (b, c), (c, a)] {
                    self.put_line(*start, *end);
                }
                // A leader through the head of an arrow looks like that of the arrow.
                self.fill(&Extents { least: a.inf(b).inf(c), largest: a.sup(b).sup(c) });
            }
            // Lines and texts lie on an area.
            SheetShape::Area(_) | SheetShape::Text { .. } => {}
        }
    }

    fn put_line(&mut self, from: Vector2<f64>, to: Vector2<f64>) {
        Self::along(from, to).for_each(|point| self.put_point(point));
    }

    /// The points of an edge, so near that there is no cell between two of them.
    fn put_edge(&mut self, edge: &Edge) {
        if edge.segment().is_some_and(|segment| segment.bulge == 0.0) {
            return self.put_line(edge.start(), edge.end());
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a few thousand")]
        let pieces = (edge.length() / NEAR).ceil().clamp(1.0, MOST) as u32;
        let share = 1.0 / f64::from(pieces);
        let Edge::Segment(arc) = edge else {
            return (0..=pieces).for_each(|index| self.put_point(edge.point_and_tangent(f64::from(index) * share).0));
        };
        // Each chord is the one before, turned by the same angle: rounding adds up to far less than the finest line.
        let (sin, cos) = libm::sincos(arc.sweep() * share);
        let (mut point, mut chord) = (arc.start, arc.point_and_tangent(share).0 - arc.start);
        for _ in 0..pieces {
            self.put_point(point);
            point += chord;
            chord = Vector2::new(cos * chord.x - sin * chord.y, sin * chord.x + cos * chord.y);
        }
        self.put_point(arc.end);
    }

    fn put_point(&mut self, point: Vector2<f64>) {
        if let Some(taken) = self.cell(point).and_then(|cell| self.lines.get_mut(cell)) {
            *taken = true;
        }
    }

    /// The cells that a field touches, slightly widened on every side.
    fn cells(&self, field: &Extents) -> impl Iterator<Item = usize> + use<> {
        let at = |value: f64, most: usize| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
            let index = (value / CELL).floor().clamp(0.0, 4000.0) as usize;
            index.min(most.saturating_sub(1))
        };
        let (least, largest) = (field.least - self.region.least, field.largest - self.region.least);
        let across = self.across;
        let (left, right) = (at(least.x, across), at(largest.x, across));
        let (low, high) = (at(least.y, self.rows), at(largest.y, self.rows));
        (low..=high).flat_map(move |row| (left..=right).map(move |column| row * across + column))
    }

    fn fill(&mut self, field: &Extents) {
        let cells: Vec<usize> = self.cells(field).collect();
        for cell in cells {
            if let Some(taken) = self.texts.get_mut(cell) {
                *taken = true;
            }
        }
    }

    /// Whether a field lies in the region and is free.
    pub(in crate::report) fn free(&self, field: &Extents) -> bool {
        let taken = |cells: &[bool], cell: usize| cells.get(cell).copied().unwrap_or(true);
        self.contains(field) && self.cells(field).all(|cell| !taken(&self.lines, cell) && !taken(&self.texts, cell))
    }

    /// Whether a field lies in the region and has no text.
    pub(in crate::report) fn free_of_texts(&self, field: &Extents) -> bool {
        self.contains(field) && self.cells(field).all(|cell| !self.texts.get(cell).copied().unwrap_or(true))
    }

    /// Whether a field lies in the region.
    pub(in crate::report) fn contains(&self, field: &Extents) -> bool {
        let field = Extents { least: field.least.add_scalar(-MARGIN), largest: field.largest.add_scalar(MARGIN) };
        field.least.x >= self.region.least.x
            && field.least.y >= self.region.least.y
            && field.largest.x <= self.region.largest.x
            && field.largest.y <= self.region.largest.y
    }
}
