//! Whether the rollers of the two flanks of a plate keep apart.

use super::Wedge;
use camgen_cams::body::largest;
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::report::Bound;
use camgen_kernel::profile::Worst;

/// The check.
pub const CHECK: Check = Check {
    name: "roller_clearance",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The gap between the rollers of the two flanks of a plate where they come closest to each other.",
    explained: CheckExplanation {
        bound: Bound::Above,
        formula: "the distance of the rollers' centres less the diameter",
        usual: "above 0",
        change: "a larger distance of the flanks `translating.plate_height`, or a smaller `translating.roller_radius`",
    },
};

impl Wedge {
    /// Room between the two rollers, m, and where it is least.
    fn roller_clearance(&self) -> Worst {
        let nearest = largest(self.curves(), |piece, x| self.curves().contact(piece, x).curve.point.y);
        Worst { value: 2.0 * (-nearest.value - self.data.roller_radius), ..nearest }
    }
}

/// Measure of the gap between the rollers.
pub(super) fn measure(plate: &Wedge, subject: &Subject<'_>) -> Measure {
    let room = plate.roller_clearance();
    let kept = room.value > 0.0;
    let note = (!kept).then(|| "the rollers of the two flanks meet; a higher plate keeps them apart".to_owned());
    CHECK.measure(1e3 * room.value, Some(0.0)).kept(kept).noted(note).at(subject, &room)
}
