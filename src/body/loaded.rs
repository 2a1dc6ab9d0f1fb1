//! What a follower really does on a turning cam whose shaft bends and twists under its force.
//!
//! The force Φ along the follower's path, with the pressure angle α across it as well, moves a cam on a shaft of compliance C by
//! C Φ along the path and C Φ tan α across it; the torque Φ s' turns a shaft of torsional stiffness k_t back by Φ s'/k_t. So the
//! follower stands lower than the law by
//!
//! ```text
//! Δs = Φ(Δs) [C (1 + tan² α) + s'²/k_t]
//! ```
//!
//! where the force is that of the place at which it then stands: the air is less compressed, and a spring is longer. Φ falls as Δs
//! grows, so that there is one root between 0 and what the force of a rigid shaft gives.

use crate::load::Load;
use crate::numeric::root;
use crate::profile::Curves;

/// How a shaft gives way at its cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Yielding {
    /// Deflection of the shaft at the cam under a force there, m/N.
    pub compliance: f64,
    /// Twist from the drive to the cam under a torque, rad/(N·m); 0 where twist is not modelled.
    pub twist: f64,
}

/// The follower at a place, under load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lowered {
    /// Force along its path, N.
    pub force: f64,
    /// Pressure angle, rad.
    pub pressure_angle: f64,
    /// What bending takes off the lift, m.
    pub bending: f64,
    /// What twist takes off it, m.
    pub twist: f64,
    /// What the cam is cut higher for that, m.
    pub raised: f64,
    /// What the force balance then leaves, inertia less air, N; 0 where nothing is to balance.
    pub residual: f64,
}

impl Lowered {
    /// By how much it stands lower than the law, m; with a cam that is cut for its shaft of either sign.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.bending + self.twist - self.raised
    }
}

/// A follower on a turning cam, and what presses it on.
pub(super) struct Pressed<'a> {
    /// Motion and follower.
    pub(super) curves: Curves<'a>,
    /// The load.
    pub(super) load: Option<&'a dyn Load>,
    /// Rate of a spring on it, N/m.
    pub(super) spring_rate: f64,
}

impl Pressed<'_> {
    /// Force along the path with the follower this much (m) below the cam as it is cut, N, from that by the law; not below 0, where it would
    /// lift off.
    fn force_below(&self, (piece, angle): (usize, f64), by_law: f64, below: f64) -> f64 {
        let above = self.load.map_or(0.0, |load| load.raised(piece, angle)) - below;
        let gone = |load: &dyn Load| load.pressing(piece, angle) - load.pressing_when(piece, angle, above);
        (by_law - self.load.map_or(0.0, gone) + self.spring_rate * above).max(0.0)
    }

    /// The follower at a place where the law has this force along its path, N.
    pub(super) fn lowered(&self, (piece, angle): (usize, f64), by_law: f64, shaft: &Yielding) -> Lowered {
        let rigid = self.force_below((piece, angle), by_law.max(0.0), 0.0);
        let contact = self.curves.contact(piece, angle);
        let (lean, velocity) = (libm::tan(contact.pressure_angle), contact.lift.ds);
        let (bending, twist) = (shaft.compliance * (1.0 + lean * lean), shaft.twist * velocity * velocity);
        let give = bending + twist;
        let missing = |below: f64| below - give * self.force_below((piece, angle), by_law.max(0.0), below);
        let below = root::bracketed(missing, 0.0, give * rigid, 0.0).unwrap_or(give * rigid);
        let force = if give == 0.0 { rigid } else { below / give };
        let raised = self.load.map_or(0.0, |load| load.raised(piece, angle));
        let residual = |load: &dyn Load| load.residual(piece, angle, raised - below);
        Lowered {
            force,
            pressure_angle: contact.pressure_angle,
            bending: force * bending,
            twist: force * twist,
            raised,
            residual: self.load.map_or(0.0, residual),
        }
    }
}
