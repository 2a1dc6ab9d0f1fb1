//! The translating roller, centred or offset.

use super::{Element, Follower, Touch};
use crate::geometry::CurvePoint;
use crate::motion::Jet;
use nalgebra::Vector2;

/// By how much the prime radius must exceed the offset, as a share of it: at the offset itself the roller would stand beside
/// the cam, with a pressure angle of 90°.
const OFFSET_MARGIN: f64 = 1e-6;

/// A roller on a straight path at distance `offset` from the shaft.
///
/// Its centre is u·û(θ) + ε·n̂(θ), u = √(R_p² − ε²) + s, û the direction of the path and n̂ = û turned by +90°; ε > 0
/// lies along the follower's apparent motion, against the rotation of the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TranslatingRoller {
    prime_radius: f64,
    offset: f64,
    roller_radius: f64,
    /// √(R_p² − ε²), m.
    height: f64,
}

impl TranslatingRoller {
    /// Prime radius, offset and roller radius in m; |offset| < prime radius.
    #[must_use]
    pub fn new(prime_radius: f64, offset: f64, roller_radius: f64) -> Self {
        let height = ((prime_radius - offset) * (prime_radius + offset)).sqrt();
        Self { prime_radius, offset, roller_radius, height }
    }
}

impl Follower for TranslatingRoller {
    fn element(&self) -> Element {
        Element::Roller { radius: self.roller_radius }
    }

    fn touch(&self, angle: f64, lift: &Jet) -> Touch {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let along = Vector2::new(cos, sin);
        let across = Vector2::new(-sin, cos);
        let (offset, u) = (self.offset, self.height + lift.s);
        // û' = n̂ and n̂' = −û.
        let curve = CurvePoint::from_derivatives(
            along * u + across * offset,
            along * (lift.ds - offset) + across * u,
            along * (lift.dds - u) + across * (2.0 * lift.ds - offset),
            along * (lift.ddds - 3.0 * lift.ds + offset) + across * (3.0 * lift.dds - u),
        );
        Touch { curve, drive: along, drive_turn: 1.0 }
    }

    fn parameter_of(&self, centre: Vector2<f64>) -> f64 {
        let height = ((centre.norm() - self.offset) * (centre.norm() + self.offset)).max(0.0).sqrt();
        libm::atan2(centre.y, centre.x) - libm::atan2(self.offset, height)
    }

    fn prime_radius(&self) -> Option<f64> {
        Some(self.prime_radius)
    }

    fn sized(&self, prime_radius: f64) -> Option<Box<dyn Follower>> {
        (self.offset.abs() < prime_radius)
            .then(|| Box::new(Self::new(prime_radius, self.offset, self.roller_radius)) as Box<dyn Follower>)
    }

    fn least_prime_radius(&self) -> f64 {
        self.offset.abs() * (1.0 + OFFSET_MARGIN)
    }
}
