//! Shapes as path data of SVG: arcs are arcs, y is flipped once, in the coordinates.

use super::number::plain;
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
        let text = plain(value, self.decimals);
        text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
    }

    pub(super) fn place(self, point: Vector2<f64>) -> String {
        format!("{},{}", self.number(point.x), self.number(-point.y))
    }

    /// A shape; nothing of a text.
    pub(super) fn shape(self, shape: &Shape) -> String {
        match shape {
            Shape::Entity(Entity::Polyline(contour)) => self.contour(contour),
            Shape::Entity(Entity::Circle(centre, radius)) => self.contour(&Contour::circle(*centre, *radius)),
            Shape::Line(a, b) => self.chain(&[*a, *b]),
            Shape::Path(points) => self.chain(points),
            Shape::Arc(start, end, bulge) => self.open_arc(&Segment { start: *start, end: *end, bulge: *bulge }),
            Shape::Triangle(corners) => format!("{}Z", self.chain(corners)),
            Shape::Text { .. } => String::new(),
        }
    }

    pub(super) fn contour(self, contour: &Contour) -> String {
        let start = contour.vertices.first().map(|vertex| self.place(vertex.point)).unwrap_or_default();
        let edges: Vec<String> = contour.edges().map(|edge| self.edge(&edge)).collect();
        format!("M{start} {} Z", edges.join(" "))
    }

    pub(super) fn open_arc(self, segment: &Segment) -> String {
        format!("M{} {}", self.place(segment.start), self.arc(segment))
    }

    fn chain(self, points: &[Vector2<f64>]) -> String {
        let places: Vec<String> = points.iter().map(|point| self.place(*point)).collect();
        format!("M{}", places.join("L"))
    }

    fn edge(self, edge: &Edge) -> String {
        match edge {
            Edge::Segment(segment) => self.arc(segment),
            Edge::Cubic(cubic) => {
                let [_, leaves, arrives, end] = cubic.points.map(|point| self.place(point));
                format!("C{leaves} {arrives} {end}")
            }
        }
    }

    /// A line, an arc, or the two halves of a long arc.
    fn arc(self, segment: &Segment) -> String {
        if segment.bulge == 0.0 {
            return format!("L{}", self.place(segment.end));
        }
        let radius = self.number(segment.radius().abs());
        // A left turn upwards is a right turn (sweep flag 0) once y points down.
        let sweep = u8::from(segment.bulge < 0.0);
        let to = |point| format!("A{radius},{radius} 0 0 {sweep} {}", self.place(point));
        if segment.sweep().abs() <= LONGEST_SWEEP {
            return to(segment.end);
        }
        format!("{} {}", to(segment.middle()), to(segment.end))
    }
}
