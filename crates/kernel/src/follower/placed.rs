//! The follower at a chosen place.

use super::{Follower, FollowerPlacement, SwingingRoller, TranslatingRoller};
use std::sync::Arc;

impl FollowerPlacement {
    /// The same choice for a roller inside of its cam.
    pub(super) fn inside(self) -> Self {
        match self {
            FollowerPlacement::Offset { radius } => FollowerPlacement::Offset { radius: -radius },
            FollowerPlacement::Pivot { arm, radius, side } => FollowerPlacement::Pivot { arm, radius: -radius, side },
        }
    }

    /// The follower with a choice, m, not yet sized.
    #[must_use]
    pub fn follower(self, chosen: f64) -> Arc<dyn Follower> {
        match self {
            FollowerPlacement::Offset { radius } => {
                Arc::new(TranslatingRoller::new(1.0 + chosen.abs(), chosen, radius))
            }
            FollowerPlacement::Pivot { arm, radius, side } => Arc::new(SwingingRoller::new(arm, chosen, radius, side)),
        }
    }
}
