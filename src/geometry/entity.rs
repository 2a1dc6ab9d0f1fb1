//! What a drawing is made of, in millimetres.

use super::contour::{Contour, Extents};
use nalgebra::Vector2;

/// Something closed that is cut.
#[derive(Debug, Clone, PartialEq)]
pub enum Entity {
    /// A closed chain of arcs and lines.
    Polyline(Contour),
    /// A full circle: centre and radius, mm.
    Circle(Vector2<f64>, f64),
}

impl Entity {
    /// The entity as a contour, a circle counter-clockwise.
    #[must_use]
    pub fn contour(&self) -> Contour {
        match self {
            Entity::Polyline(contour) => contour.clone(),
            Entity::Circle(centre, radius) => Contour::circle(*centre, *radius),
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
        }
    }
}
