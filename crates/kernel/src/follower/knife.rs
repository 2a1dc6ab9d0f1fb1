//! The knife edge: a follower that touches with a point, on a straight path.
//!
//! It is a translating roller of radius 0: the path of its point is the profile. A round nose that does not turn is a roller with its
//! own radius.

use super::{Follower, FollowerData, FollowerKind, FollowerPlacement, MASS, OFFSET, PRELOAD, TranslatingRoller};
use crate::document::cams::MAKE;
use crate::document::{KeySection, Occurrence, TableReader};
use crate::motion::Quantity;
use std::sync::Arc;

/// `[follower.knife]`.
pub(super) const KIND: FollowerKind = FollowerKind { section: &SECTION, quantity: Quantity::Length, read };

const SECTION: KeySection = KeySection {
    path: "follower.knife",
    about: "the follower: a knife edge, which touches with a point, on a straight path",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[OFFSET.key, MASS.key, PRELOAD.key],
};

fn read(table: &TableReader<'_>) -> Option<FollowerData> {
    let given = table.get(&OFFSET)?;
    let (offset, place) = (given.unwrap_or(0.0), given.is_none().then_some(FollowerPlacement::Offset { radius: 0.0 }));
    // Replaced when the cam is sized; until then large enough to reach.
    let shape: Arc<dyn Follower> = Arc::new(TranslatingRoller::new(1.0 + offset.abs(), offset, 0.0));
    let (mass, preload) = (table.get(&MASS), table.get(&PRELOAD));
    Some(FollowerData { mass, preload, place, ..FollowerData::new(SECTION.path, shape) })
}
