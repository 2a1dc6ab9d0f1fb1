//! Shapes as path data of SVG: arcs are arcs, y is flipped once, in the coordinates.

use super::number::push_short;
use crate::geometry::Entity;
use crate::geometry::contour::{Contour, Edge, Segment};
use crate::report::sheet::Shape;
use nalgebra::Vector2;

/// Largest sweep of one arc, rad: the direction of a half circle is ambiguous within rounding.
const LONGEST_SWEEP: f64 = 3.0;

/// Path data with so many decimals of a millimetre.
#[derive(Debug, Clone, Copy)]
pub(super) struct PathData {
    pub(super) decimals: usize,
}

impl PathData {
    pub(super) fn number(self, value: f64) -> String {
        let mut text = Vec::with_capacity(16);
        self.push_number(&mut text, value);
        String::from_utf8(text).unwrap_or_default()
    }

    pub(super) fn push_number(self, text: &mut Vec<u8>, value: f64) {
        push_short(text, value, self.decimals);
    }

    fn push_place(self, text: &mut Vec<u8>, point: Vector2<f64>) {
        self.push_number(text, point.x);
        text.push(b',');
        self.push_number(text, -point.y);
    }

    /// Places with a sign between two.
    pub(super) fn push_places(self, text: &mut Vec<u8>, points: &[Vector2<f64>], between: u8) {
        for (index, point) in points.iter().enumerate() {
            if index > 0 {
                text.push(between);
            }
            self.push_place(text, *point);
        }
    }

    /// A shape; nothing of a text.
    pub(super) fn shape(self, shape: &Shape) -> String {
        let mut text = Vec::new();
        match shape {
            Shape::Entity(Entity::Polyline(contour)) => self.push_contour(&mut text, contour),
            Shape::Entity(Entity::Circle(centre, radius)) => {
                self.push_contour(&mut text, &Contour::circle(*centre, *radius));
            }
            Shape::Line(a, b) => self.push_chain(&mut text, &[*a, *b]),
            Shape::Path(points) => self.push_chain(&mut text, points),
            Shape::Arc(start, end, bulge) => {
                self.push_open_arc(&mut text, &Segment { start: *start, end: *end, bulge: *bulge });
            }
            Shape::Triangle(corners) => {
                self.push_chain(&mut text, corners);
                text.push(b'Z');
            }
            Shape::Text { .. } => {}
        }
        String::from_utf8(text).unwrap_or_default()
    }

    pub(super) fn push_contour(self, text: &mut Vec<u8>, contour: &Contour) {
        text.push(b'M');
        if let Some(first) = contour.vertices.first() {
            self.push_place(text, first.point);
        }
        for edge in contour.edges() {
            text.push(b' ');
            self.push_edge(text, &edge);
        }
        text.extend_from_slice(b" Z");
    }

    pub(super) fn push_open_arc(self, text: &mut Vec<u8>, segment: &Segment) {
        text.push(b'M');
        self.push_place(text, segment.start);
        text.push(b' ');
        self.push_arc(text, segment);
    }

    fn push_chain(self, text: &mut Vec<u8>, points: &[Vector2<f64>]) {
        text.push(b'M');
        self.push_places(text, points, b'L');
    }

    fn push_edge(self, text: &mut Vec<u8>, edge: &Edge) {
        match edge {
            Edge::Segment(segment) => self.push_arc(text, segment),
            Edge::Cubic(cubic) => {
                let [_, rest @ ..] = &cubic.points;
                text.push(b'C');
                self.push_places(text, rest, b' ');
            }
        }
    }

    /// A line, an arc, or the two halves of a long arc.
    fn push_arc(self, text: &mut Vec<u8>, segment: &Segment) {
        if segment.bulge == 0.0 {
            text.push(b'L');
            self.push_place(text, segment.end);
            return;
        }
        // A left turn upwards is a right turn (sweep flag 0) once y points down.
        let sweep = if segment.bulge < 0.0 { b" 0 0 1 " } else { b" 0 0 0 " };
        let middle = (segment.sweep().abs() > LONGEST_SWEEP).then(|| segment.middle());
        for (index, point) in middle.into_iter().chain([segment.end]).enumerate() {
            text.extend_from_slice(if index > 0 { b" A" } else { b"A" });
            let from = text.len();
            self.push_number(text, segment.radius().abs());
            let radius = from..text.len();
            text.push(b',');
            text.extend_from_within(radius);
            text.extend_from_slice(sweep);
            self.push_place(text, point);
        }
    }
}
