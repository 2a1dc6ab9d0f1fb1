//! Whether a cylindrical roller bears on its edge where the flank leans along the axis.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::machine::Crown;
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "cylinder_contact",
    on: On::Cam,
    about: "By how much the surface of a conoid departs from the contact line of a cylindrical roller over its width.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max distance of the surface from the roller's generator, over `follower.roller.width`",
        usual: "the tolerance",
        change: "a narrower roller, a longer `conoid.axial_travel`, or `follower.roller.crown = \"sphere\"`",
    },
    run: check,
};

/// Places over the width of the roller, as shares of it.
const PLACES: [f64; 5] = [-0.5, -0.25, 0.0, 0.25, 0.5];

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let conoid = evidence.body.spatial()?;
    let roller = conoid.roller();
    let width = (roller.crown == Crown::Cylinder).then_some(roller.width)??;
    let gap = conoid.worst(|conoid, place| {
        let (height, slope) = conoid.height_and_slope(&place.partials);
        let cosine = height / libm::hypot(height, slope);
        let lifts = PLACES.map(|share| conoid.lift(place.piece, place.angle, place.z + share * width)[0][0] * cosine);
        let (least, most) = lifts.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        1e3 * (most - least)
    });
    let kept = gap.value <= evidence.tolerance_mm;
    let note = (!kept).then(|| "the roller bears on an edge; follower.roller.crown = \"sphere\" would not".into());
    let found = CHECK.found(gap.value, Some(evidence.tolerance_mm), "mm", Verdict::of(kept));
    Some(at(evidence.body, &gap, found, note))
}
