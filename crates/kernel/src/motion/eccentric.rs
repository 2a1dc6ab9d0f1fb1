//! The eccentric circle: the motion whose disc cam is a circle, so that every result is known in closed form.

use super::{Jet, Motion, Piece};
use std::f64::consts::TAU;

/// Lift of a centred follower on a pitch circle whose centre lies off the shaft: R(θ) = e cos θ + √(ρ² − e² sin² θ),
/// counted from its lowest point R(π) = ρ − e.
#[derive(Debug, Clone, Copy)]
pub struct EccentricCircle {
    eccentricity: f64,
    pitch_radius: f64,
    piece: [Piece; 1],
}

impl EccentricCircle {
    /// Eccentricity e and radius ρ of the pitch circle, m; e < ρ.
    #[must_use]
    pub fn new(eccentricity: f64, pitch_radius: f64) -> Self {
        Self { eccentricity, pitch_radius, piece: [Piece { start: 0.0, end: TAU, dwell: false }] }
    }
}

impl Motion for EccentricCircle {
    fn pieces(&self) -> &[Piece] {
        &self.piece
    }

    fn jet(&self, _piece: usize, angle: f64) -> Jet {
        let (e, rho) = (self.eccentricity, self.pitch_radius);
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        // w² = ρ² − e² sin²; w w' = −e² sin cos; w w'' = −e² cos 2θ − w'²; w w''' = 2 e² sin 2θ − 3 w' w''.
        let w = (rho * rho - e * e * sin * sin).sqrt();
        let (sin2, cos2) = (2.0 * sin * cos, cos * cos - sin * sin);
        let w1 = -0.5 * e * e * sin2 / w;
        let w2 = (-e * e * cos2 - w1 * w1) / w;
        let w3 = (2.0 * e * e * sin2 - 3.0 * w1 * w2) / w;
        Jet { s: e * cos + w - (rho - e), ds: -e * sin + w1, dds: -e * cos + w2, ddds: e * sin + w3 }
    }
}
