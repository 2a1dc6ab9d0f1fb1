//! A disc under load.

use super::Disc;
use crate::body::loaded::{LoadedFollower, PressedFollower, ShaftCompliance};
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::Worst;

impl Disc {
    /// The follower at a place of the motion, the cam on a shaft; `None` where no force is known, and of a follower that swings.
    #[must_use]
    pub fn loaded_follower(&self, piece: usize, angle: f64, shaft: &ShaftCompliance) -> Option<LoadedFollower> {
        if self.motion.quantity() == Quantity::Angle {
            return None;
        }
        let (rigid, spring_rate) = (self.path_force(piece, angle)?, self.pressing()?.rate);
        let pressed = PressedFollower { curves: self.curves(), load: self.load.as_deref(), spring_rate };
        Some(pressed.loaded_follower((piece, angle), rigid, shaft))
    }

    /// The largest value over all places of the loaded follower, and where.
    #[must_use]
    pub fn largest_loaded(&self, shaft: &ShaftCompliance, of: impl Fn(&LoadedFollower) -> f64) -> Worst {
        self.largest_force(|piece, angle| self.loaded_follower(piece, angle, shaft).map_or(0.0, |lowered| of(&lowered)))
    }
}
