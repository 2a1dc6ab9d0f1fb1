//! Whether a follower jams in its guide.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::Bound;
use camgen_kernel::profile::Worst;

/// The check.
pub const CHECK: Check = Check {
    name: "guide",
    on: CheckScope::Cam,
    unit: "1",
    about: "The smallest share of the force along the normal that moves the follower along its path, after the friction of its \
            guide. Where it is not above 0 the follower jams.",
    explained: CheckExplanation {
        bound: Bound::Above,
        formula: "cos α − μ sin |α| (1 + 2 q/b) with the friction μ, the span b and the overhang q of the guide, while the follower is \
                  lifted; under a face with the moment of a contact that is off the axis of the stem",
        usual: "above 0; 0.5 is well clear of jamming",
        change: "a longer `guide.span`, a shorter `guide.overhang`, less `guide.friction`, or a smaller pressure angle: a larger \
                 `cam.base_radius`",
    },
};

/// Measure of the least share.
#[must_use]
pub fn measure(least: &Worst, subject: &Subject<'_>) -> Measure {
    let kept = least.value > 0.0;
    let note = (!kept).then_some(
        "the follower jams in its guide; a longer guide.span, a shorter guide.overhang or less guide.friction would free it",
    );
    CHECK.measure(least.value, Some(0.0)).kept(kept).noted(note).at(subject, least)
}
