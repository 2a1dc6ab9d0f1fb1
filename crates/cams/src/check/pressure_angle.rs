//! The angle between the follower's path and the normal of the cam.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::Bound;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::Text;

/// The check.
pub const CHECK: Check = Check {
    name: "pressure_angle",
    on: CheckScope::Cam,
    unit: "deg",
    about: "The largest angle between the direction in which the follower moves and the normal of the cam. Beyond about 30° \
            (translating) or 45° (swinging) the side thrust jams the follower; a larger base radius lowers it. Under a flat face there is no customary limit: on a straight path \
            the angle is the tilt of the face, on an arm it follows from the offset of the face from its pivot.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "tan α = (ds/dθ − e)/(s + √(Rₚ² − e²)) of a translating roller with offset e and prime radius Rₚ; of a face on an arm \
                  tan α = f/ℓ with its offset f from the pivot and the distance ℓ of the contact along the face",
        usual: "30° translating (R. L. Norton, Design of Machinery, chapter on cams), 45° swinging, none for a flat face",
        change: "a larger `cam.base_radius`, an offset `follower.roller.offset`, a lower lift or a longer rise; or a higher `limits.pressure_angle`; for a barrel a larger \
                 `cam.outer_radius`, for a globoid a larger `cam.turret_distance`",
    },
};

/// Rounding of an angle that was solved to be the limit, as a share of it.
const ROUNDING: f64 = 1e-12;

/// Measure of the largest positive angle and the largest size of a negative one, rad. Of a roller on a straight path through the shaft the
/// angle is positive where the lift grows; a face on an arm has one sign all round, so that one of two limits binds only.
#[must_use]
pub fn measure([positive, negative]: [Worst; 2], subject: &Subject<'_>) -> Measure {
    let limits = subject.machine.limits;
    if limits.pressure_angle.is_none() {
        let worst = positive.or_larger(negative);
        let note = Text::from("a flat face has no customary limit; limits.pressure_angle gives one");
        return CHECK.measure(worst.value.to_degrees(), None).noted(note).at(subject, &worst);
    }
    let [positive_limit, negative_limit] = limits.pressure_angles();
    // Of two limits that which is nearer, or broken more.
    let of_return = negative.value / negative_limit > positive.value / positive_limit;
    let (worst, limit) = if of_return { (negative, negative_limit) } else { (positive, positive_limit) };
    let kept = worst.value <= limit * (1.0 + ROUNDING);
    // The conversion to radians costs an ulp: what was typed as 30 is reported as 30.
    let shown_limit = (limit.to_degrees() * 1e12).round() / 1e12;
    let note = if kept { None } else { (subject.remedy)() };
    CHECK.measure(worst.value.to_degrees(), Some(shown_limit)).kept(kept).noted(note).at(subject, &worst)
}
