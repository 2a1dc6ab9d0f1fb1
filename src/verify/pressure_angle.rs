//! The angle between the follower's path and the normal of the cam.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "pressure_angle",
    on: On::Cam,
    about: "The largest angle between the direction in which the follower moves and the normal of the cam. Beyond about 30° \
            (translating) or 45° (swinging) the side thrust jams the follower; a larger base radius lowers it. Under a flat face \
            it follows from how the face stands, and has no customary limit.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "tan α = (ds/dθ − e)/(s + √(Rₚ² − e²)) of a translating roller with offset e and prime radius Rₚ",
        usual: "30° translating (R. L. Norton, Design of Machinery, chapter on cams), 45° swinging, none of a flat face",
        change: "a larger `cam.base_radius`, an offset `follower.roller.offset`, a lower lift or a longer rise; or a higher `limits.pressure_angle`",
    },
    run: check,
};

/// Rounding of an angle that was solved to be the limit, as a share of it.
const ROUNDING: f64 = 1e-12;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    if body.machine().limits.pressure_angle.is_none() {
        let worst = body.pressure_angle();
        let found = CHECK.found(worst.value.to_degrees(), None, "deg", Verdict::Info);
        let told = "a flat face has no customary limit; limits.pressure_angle gives one";
        return Some(at(body, &worst, found, Some(told.into())));
    }
    let [rising, falling] = body.pressure_angles();
    let [rising_limit, falling_limit] = body.machine().limits.pressure_angles();
    // Of two limits that which is nearer, or broken more.
    let of_return = falling.value / falling_limit > rising.value / rising_limit;
    let (worst, limit) = if of_return { (falling, falling_limit) } else { (rising, rising_limit) };
    let kept = worst.value <= limit * (1.0 + ROUNDING);
    // The conversion to radians costs an ulp: what was typed as 30 is reported as 30.
    let told = (limit.to_degrees() * 1e12).round() / 1e12;
    let found = CHECK.found(worst.value.to_degrees(), Some(told), "deg", Verdict::of(kept));
    Some(at(body, &worst, found, if kept { None } else { body.remedy() }))
}
