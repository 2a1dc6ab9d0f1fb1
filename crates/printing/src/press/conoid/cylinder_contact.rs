//! Whether a cylindrical roller touches with its edge where the flank leans along the axis.

use super::Conoid;
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::machine::Crown;
use camgen_cams::report::Bound;
use camgen_kernel::text::{KeyChange, Remedy, text};

/// The check.
pub const CHECK: Check = Check {
    name: "cylinder_contact",
    on: CheckScope::Cam,
    unit: "mm",
    about: "By how much the surface of a conoid departs from the contact line of a cylindrical roller over its width.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max distance of the surface from the roller's generator, over `follower.roller.width`",
        usual: "the tolerance",
        change: "a narrower roller, a longer `conoid.axial_travel`, or `follower.roller.crown = \"sphere\"`",
    },
};

/// Places over the width of the roller, as shares of it.
const PLACES: [f64; 5] = [-0.5, -0.25, 0.0, 0.25, 0.5];

/// Measure of the largest departure; `None` of a roller that is not a cylinder, or has no width.
pub(super) fn measure(conoid: &Conoid, tolerance_mm: f64, subject: &Subject<'_>) -> Option<Measure> {
    let roller = conoid.roller();
    let width = (roller.crown == Crown::Cylinder).then_some(roller.width)??;
    let gap = conoid.worst(|conoid, place| {
        let (height, slope) = conoid.height_and_slope(&place.partials);
        let cosine = height / libm::hypot(height, slope);
        let lifts = PLACES.map(|share| conoid.lift(place.piece, place.angle, place.z + share * width)[0][0] * cosine);
        let (least, most) = lifts.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        1e3 * (most - least)
    });
    let kept = gap.value <= tolerance_mm;
    let note = (!kept)
        .then(|| Remedy::new([KeyChange::new("follower.roller.crown", "sphere")]))
        .map(|remedy| text!("the roller touches with its edge; {} would avoid that", remedy));
    Some(CHECK.measure(gap.value, Some(tolerance_mm)).kept(kept).noted(note).at(subject, &gap))
}
