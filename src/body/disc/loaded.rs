//! A disc under load.

use super::Disc;
use crate::body::loaded::{Lowered, Pressed, Yielding};
use crate::motion::Quantity;
use crate::profile::Worst;

impl Disc {
    /// The follower at a place of the motion, the cam on a shaft; `None` where no force is known, and of a follower that swings.
    #[must_use]
    pub fn lowered(&self, piece: usize, angle: f64, shaft: &Yielding) -> Option<Lowered> {
        if self.motion.quantity() == Quantity::Angle {
            return None;
        }
        let (rigid, spring_rate) = (self.path_force(piece, angle)?, self.pressing()?.rate);
        let pressed = Pressed { curves: self.curves(), load: self.load.as_deref(), spring_rate };
        Some(pressed.lowered((piece, angle), rigid, shaft))
    }

    /// The largest of what is lowered, and where.
    #[must_use]
    pub fn largest_lowered(&self, shaft: &Yielding, of: impl Fn(&Lowered) -> f64) -> Worst {
        self.largest_force(|piece, angle| self.lowered(piece, angle, shaft).map_or(0.0, |lowered| of(&lowered)))
    }
}
