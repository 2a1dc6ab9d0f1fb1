//! Shapes of a mechanism as paths of SVG, y downwards, to a thousandth of a millimetre and less.

use super::super::number::plain;
use crate::geometry::Entity;
use crate::geometry::contour::{Contour, Edge, Segment};
use crate::report::sheet::Shape;
use nalgebra::Vector2;

/// Decimals of a coordinate, mm.
const DECIMALS: usize = 4;
/// Largest sweep of one arc, rad: the direction of a half circle is ambiguous within rounding.
const LONGEST_SWEEP: f64 = 3.0;

fn number(value: f64) -> String {
    let text = plain(value, DECIMALS);
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

fn place(point: Vector2<f64>) -> String {
    format!("{} {}", number(point.x), number(-point.y))
}

/// The path of some shapes; words have none.
pub(super) fn path(shapes: &[Shape]) -> String {
    shapes.iter().map(of).collect()
}

fn of(shape: &Shape) -> String {
    let chain = |points: &[Vector2<f64>]| {
        let all: Vec<String> = points.iter().map(|point| place(*point)).collect();
        format!("M{}", all.join("L"))
    };
    match shape {
        Shape::Entity(Entity::Polyline(contour)) => closed(contour),
        Shape::Entity(Entity::Circle(centre, radius)) => closed(&Contour::circle(*centre, *radius)),
        Shape::Line(a, b) => chain(&[*a, *b]),
        Shape::Path(points) => chain(points),
        Shape::Arc(start, end, bulge) => {
            format!("M{}{}", place(*start), arc(&Segment { start: *start, end: *end, bulge: *bulge }))
        }
        Shape::Triangle(corners) => format!("{}Z", chain(corners)),
        Shape::Text { .. } => String::new(),
    }
}

fn closed(contour: &Contour) -> String {
    let start = contour.vertices.first().map(|vertex| place(vertex.point)).unwrap_or_default();
    let edge = |edge: Edge| match edge {
        Edge::Segment(segment) => arc(&segment),
        Edge::Cubic(cubic) => {
            let [_, leaves, arrives, end] = cubic.points.map(place);
            format!("C{leaves} {arrives} {end}")
        }
    };
    format!("M{start}{}Z", contour.edges().map(edge).collect::<String>())
}

/// A line, an arc, or the two halves of a long arc.
fn arc(segment: &Segment) -> String {
    if segment.bulge == 0.0 {
        return format!("L{}", place(segment.end));
    }
    let radius = number(segment.radius().abs());
    // A left turn upwards is a right turn once y points down.
    let sweep = u8::from(segment.bulge < 0.0);
    let to = |point| format!("A{radius} {radius} 0 0 {sweep} {}", place(point));
    if segment.sweep().abs() <= LONGEST_SWEEP {
        return to(segment.end);
    }
    format!("{}{}", to(segment.middle()), to(segment.end))
}
