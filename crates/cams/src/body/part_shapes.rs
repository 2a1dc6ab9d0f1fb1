//! The hub of a part and the notch in its rim.

use camgen_kernel::geometry::contour::{Contour, Vertex};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// The hub of a part, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartHub {
    /// Its radius.
    pub radius: f64,
    /// How far it stands out behind the part, below z = 0.
    pub behind: f64,
    /// How far it stands out in front of the part, above its upper face.
    pub in_front: f64,
}

/// A notch of 90° in the rim of a blank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RimNotch {
    /// The direction from the axis, a unit vector.
    pub towards: Vector2<f64>,
    /// Its depth, mm.
    pub depth: f64,
}

impl PartHub {
    /// Its length on both sides together.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.behind + self.in_front
    }

    /// Its circle.
    #[must_use]
    pub fn contour(&self) -> Contour {
        Contour::circle(Vector2::zeros(), self.radius)
    }
}

impl RimNotch {
    /// The edge of a blank of a radius, mm, with the notch, counter-clockwise.
    #[must_use]
    pub fn in_rim(&self, radius: f64) -> Contour {
        // Its sides run at 45° from the apex, which lies `apex` from the axis: (apex + q)² + q² = R².
        let apex = radius - self.depth;
        let side = 0.5 * ((2.0 * radius * radius - apex * apex).sqrt() - apex);
        let across = Vector2::new(-self.towards.y, self.towards.x);
        let out = self.towards * (apex + side);
        // Half of the arc from one side of the notch round to the other.
        let half = PI - libm::atan2(side, apex + side);
        let bulge = libm::tan(0.25 * half);
        Contour {
            vertices: vec![
                Vertex::new(out + across * side, bulge),
                Vertex::new(-self.towards * radius, bulge),
                Vertex::new(out - across * side, 0.0),
                Vertex::new(self.towards * apex, 0.0),
            ],
        }
    }
}
