//! A follower on a turning cam whose shaft bends and twists under its force.
//!
//! The force Φ along the follower's path, with the pressure angle α across it as well, moves a cam on a shaft of compliance C by
//! C Φ along the path and C Φ tan α across it; the torque Φ s' turns a shaft of torsional stiffness k_t back by Φ s'/k_t. So the
//! follower is below the law by
//!
//! ```text
//! Δs = Φ(Δs) [C (1 + tan² α) + s'²/k_t]
//! ```
//!
//! where the force is that of its actual place: the air is less compressed, and a spring is longer. Φ falls as Δs
//! grows, so that there is one root between 0 and the value for the force on a rigid shaft.

use crate::load::Load;
use camgen_kernel::numeric::root;
use camgen_kernel::profile::Curves;

/// Compliance of a shaft at its cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftCompliance {
    /// Deflection of the shaft at the cam under a force there, m/N.
    pub compliance: f64,
    /// Twist from the drive to the cam under a torque, rad/(N·m); 0 where twist is not modelled.
    pub twist: f64,
}

/// The follower at a place, under load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedFollower {
    /// Force along its path, N.
    pub force: f64,
    /// Pressure angle, rad.
    pub pressure_angle: f64,
    /// Loss of lift by bending, m.
    pub bending: f64,
    /// Loss of lift by twist, m.
    pub twist: f64,
    /// By how much the cam is cut higher for that, m.
    pub added_lift: f64,
    /// Residual force there, inertia less air, N; 0 where no forces are to balance.
    pub residual: f64,
}

impl LoadedFollower {
    /// How far it is below the law, m; with a cam that is cut for its shaft of either sign.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.bending + self.twist - self.added_lift
    }
}

/// A follower on a turning cam, and what presses it on.
pub struct PressedFollower<'a> {
    /// Motion and follower.
    pub curves: Curves<'a>,
    /// The load.
    pub load: Option<&'a dyn Load>,
    /// Rate of a spring on it, N/m.
    pub spring_rate: f64,
}

impl PressedFollower<'_> {
    /// Force along the path with the follower this much (m) below the cam as it is cut, N, from that by the law; not below 0, where it would
    /// lift off.
    fn force_below(&self, (piece, angle): (usize, f64), by_law: f64, below: f64) -> f64 {
        let above = self.load.map_or(0.0, |load| load.added_lift(piece, angle)) - below;
        let gone = |load: &dyn Load| load.pressing(piece, angle) - load.pressing_when(piece, angle, above);
        (by_law - self.load.map_or(0.0, gone) + self.spring_rate * above).max(0.0)
    }

    /// The follower at a place where the law has this force along its path, N.
    #[must_use]
    pub fn loaded_follower(
        &self,
        (piece, angle): (usize, f64),
        by_law: f64,
        shaft: &ShaftCompliance,
    ) -> LoadedFollower {
        let rigid = self.force_below((piece, angle), by_law.max(0.0), 0.0);
        let contact = self.curves.contact(piece, angle);
        let (lean, velocity) = (libm::tan(contact.pressure_angle), contact.lift.ds);
        let (bending, twist) = (shaft.compliance * (1.0 + lean * lean), shaft.twist * velocity * velocity);
        let give = bending + twist;
        let missing = |below: f64| below - give * self.force_below((piece, angle), by_law.max(0.0), below);
        let below = root::bracketed(missing, 0.0, give * rigid, 0.0).unwrap_or(give * rigid);
        let force = if give == 0.0 { rigid } else { below / give };
        let added_lift = self.load.map_or(0.0, |load| load.added_lift(piece, angle));
        let residual = |load: &dyn Load| load.residual(piece, angle, added_lift - below);
        LoadedFollower {
            force,
            pressure_angle: contact.pressure_angle,
            bending: force * bending,
            twist: force * twist,
            added_lift,
            residual: self.load.map_or(0.0, residual),
        }
    }
}
