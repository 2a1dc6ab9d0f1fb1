//! The roller on a straight path under a plate that travels.

use super::{Element, Follower, Touch};
use crate::geometry::CurvePoint;
use crate::motion::Jet;
use nalgebra::Vector2;
use std::sync::Arc;

/// A roller under the lower flank of a plate, on a straight path at the angle d from the direction across the travel.
///
/// In the frame of the plate, x along its travel and the metal above the flank, the roller is at
///
/// ```text
/// C = (x + s sin d, −s cos d),   C' = (1 + s' sin d, −s' cos d),   tan α = (s' + sin d)/cos d
/// ```
///
/// after a travel x of the plate, so that the lower flank runs from left to right with the metal on its left, as in a disc cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateRoller {
    radius: f64,
    /// sin d and cos d.
    sine: f64,
    cosine: f64,
}

impl PlateRoller {
    /// A roller of a radius (m; 0 for a knife edge), on a path at an angle (rad, below a quarter turn) from the direction across the travel:
    /// positive where a growing lift moves the roller towards the far end of the plate.
    #[must_use]
    pub fn new(radius: f64, drive_angle: f64) -> Self {
        Self { radius, sine: libm::sin(drive_angle), cosine: libm::cos(drive_angle) }
    }

    /// Rate at which the roller moves along the plate while it travels: where it is not above 0, the flank would turn back.
    #[must_use]
    pub fn advance(&self, slope: f64) -> f64 {
        1.0 + slope * self.sine
    }

    /// The slopes of the lift at which the pressure angle reaches limits, rad: that of a rise, and that of a fall as a positive number.
    #[must_use]
    pub fn slopes_at(&self, [rising, falling]: [f64; 2]) -> [f64; 2] {
        [self.cosine * libm::tan(rising) - self.sine, self.cosine * libm::tan(falling) + self.sine]
    }

    fn drive(&self) -> Vector2<f64> {
        Vector2::new(self.sine, -self.cosine)
    }
}

impl Follower for PlateRoller {
    fn element(&self) -> Element {
        Element::Roller { radius: self.radius }
    }

    fn touch(&self, x: f64, lift: &Jet) -> Touch {
        let (drive, along) = (self.drive(), Vector2::x());
        let curve = CurvePoint::from_derivatives(
            along * x + drive * lift.s,
            along + drive * lift.ds,
            drive * lift.dds,
            drive * lift.ddds,
        );
        Touch { curve, drive, drive_turn: 0.0 }
    }

    fn point_turned(&self, x: f64, _: f64, _: f64, lift: &Jet) -> (Vector2<f64>, Vector2<f64>) {
        let drive = self.drive();
        (Vector2::x() * x + drive * lift.s, drive)
    }

    fn parameter_of(&self, centre: Vector2<f64>, _: Vector2<f64>) -> f64 {
        centre.x + centre.y * (self.sine / self.cosine)
    }

    /// |C'|² = 1 + 2 s' sin d + s'²; the drive does not turn.
    fn speed_slopes(&self, lift: &Jet) -> Option<[f64; 2]> {
        let speed = libm::hypot(1.0 + lift.ds * self.sine, lift.ds * self.cosine);
        Some([lift.dds * (self.sine + lift.ds) / speed, 0.0])
    }

    fn of_radius(&self, radius: f64) -> Option<Arc<dyn Follower>> {
        Some(Arc::new(Self { radius, ..*self }))
    }
}
