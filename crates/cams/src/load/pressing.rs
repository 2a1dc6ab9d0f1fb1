//! The forces that press a follower on in addition to a load of its own: spring, weight, damping and inertia.

use camgen_kernel::motion::Jet;

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
    pub fn force_at(&self, lift: &Jet) -> f64 {
        self.still(lift) + self.moving(lift)
    }

    /// Its derivative by the cam angle at a lift, N/rad or N·m/rad.
    #[must_use]
    pub fn rate_at(&self, lift: &Jet) -> f64 {
        let moving = self.damping * self.speed * lift.dds + self.mass * self.speed * self.speed * lift.ddds;
        self.rate * lift.ds + moving
    }

    /// Whether it is constant at every lift.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.rate == 0.0 && (self.speed == 0.0 || (self.mass == 0.0 && self.damping == 0.0))
    }

    /// The force on a follower at rest at a lift.
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

    /// These forces at another speed of the cam, rad/s.
    #[must_use]
    pub fn at_speed(self, speed: f64) -> Self {
        Self { speed, ..self }
    }
}
