//! What a drawing is made of, in millimetres.

use super::contour::{Contour, Extents, Segment, Vertex};
use nalgebra::Vector2;

/// Something that is cut.
#[derive(Debug, Clone, PartialEq)]
pub enum Entity {
    /// A closed chain of arcs and lines.
    Polyline(Contour),
    /// A full circle: centre and radius, mm.
    Circle(Vector2<f64>, f64),
    /// An arc or a line alone.
    Segment(Segment),
}

impl Entity {
    /// The entity as a contour, a circle counter-clockwise, a segment there and back.
    #[must_use]
    pub fn contour(&self) -> Contour {
        match self {
            Entity::Polyline(contour) => contour.clone(),
            Entity::Circle(centre, radius) => Contour::circle(*centre, *radius),
            Entity::Segment(Segment { start, end, bulge }) => {
                Contour { vertices: vec![Vertex::new(*start, *bulge), Vertex::new(*end, -bulge)] }
            }
        }
    }

    /// The entity with all of its lengths multiplied, about the origin.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        match self {
            Entity::Polyline(contour) => Entity::Polyline(contour.scaled(scale)),
            Entity::Circle(centre, radius) => Entity::Circle(centre * scale, radius * scale),
            Entity::Segment(Segment { start, end, bulge }) => {
                Entity::Segment(Segment { start: start * scale, end: end * scale, bulge: *bulge })
            }
        }
    }

    /// The entity at another place, mm.
    #[must_use]
    pub fn moved(&self, by: Vector2<f64>) -> Self {
        match self {
            Entity::Polyline(contour) => Entity::Polyline(contour.moved(by)),
            Entity::Circle(centre, radius) => Entity::Circle(centre + by, *radius),
            Entity::Segment(Segment { start, end, bulge }) => {
                Entity::Segment(Segment { start: start + by, end: end + by, bulge: *bulge })
            }
        }
    }

    /// Extents, mm.
    #[must_use]
    pub fn extents(&self) -> Extents {
        match self {
            Entity::Polyline(contour) => contour.extents(),
            Entity::Circle(centre, radius) => {
                let reach = Vector2::new(*radius, *radius);
                Extents { least: centre - reach, largest: centre + reach }
            }
            Entity::Segment(segment) => segment.extents(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_reaches_as_far_as_its_contour() {
        let circle = Entity::Circle(Vector2::new(3.0, -4.0), 5.0);
        let extents = circle.extents();
        assert_eq!((extents.least, extents.largest), (Vector2::new(-2.0, -9.0), Vector2::new(8.0, 1.0)));
        let contour = Entity::Polyline(circle.contour()).extents();
        assert!((contour.least - extents.least).norm() + (contour.largest - extents.largest).norm() < 1e-14);
    }
}
