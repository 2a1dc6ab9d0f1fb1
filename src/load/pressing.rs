//! What presses a follower on beside a load of its own: spring, weight, damping and inertia.

use crate::motion::Jet;

/// F = m ω² s'' + c ω s' + k s + F0, by the cam angle: N and m along a straight path, N·m and rad about the pivot of a follower that
/// swings.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pressing {
    /// m or J.
    pub mass: f64,
    /// c.
    pub damping: f64,
    /// k.
    pub rate: f64,
    /// F0 with every constant load.
    pub constant: f64,
    /// ω of the cam, rad/s; 0 where it is not known, and nothing moves.
    pub speed: f64,
}

impl Pressing {
    /// The force at a lift with its derivatives.
    #[must_use]
    pub fn at(&self, lift: &Jet) -> f64 {
        self.still(lift) + self.moving(lift)
    }

    /// Whether it is the same at any lift.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.rate == 0.0 && (self.speed == 0.0 || (self.mass == 0.0 && self.damping == 0.0))
    }

    /// What presses on a follower that stands there.
    #[must_use]
    pub fn still(&self, lift: &Jet) -> f64 {
        self.constant + self.rate * lift.s
    }

    fn moving(&self, lift: &Jet) -> f64 {
        if self.speed == 0.0 {
            return 0.0;
        }
        self.damping * self.speed * lift.ds + self.mass * self.speed * self.speed * lift.dds
    }

    /// The same at another speed of the cam, rad/s.
    #[must_use]
    pub fn at_speed(self, speed: f64) -> Self {
        Self { speed, ..self }
    }
}
