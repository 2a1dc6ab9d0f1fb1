//! Whether a follower jams in its guide.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "guide",
    on: On::Cam,
    about: "What of the force along the normal moves the follower along its path beside the friction of its guide, at the least, as a \
            share. Where it is not above 0 the follower jams.",
    explained: Explained {
        bound: Bound::Above,
        formula: "cos α − μ sin |α| (1 + 2 q/b) with the friction μ, the span b and the overhang q of the guide, while the follower is \
                  lifted; under a face with the moment of a contact beside the stem",
        usual: "above 0; a half keeps well clear of it",
        change: "a longer `guide.span`, a shorter `guide.overhang`, less `guide.friction`, or a smaller pressure angle: a larger \
                 `cam.base_radius`",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let least = evidence.body.guide_share()?;
    let kept = least.value > 0.0;
    let note = (!kept).then(|| {
        "the follower jams in its guide; a longer guide.span, a shorter guide.overhang or less guide.friction would free it".into()
    });
    Some(at(evidence.body, &least, CHECK.found(least.value, Some(0.0), "1", Verdict::of(kept)), note))
}
