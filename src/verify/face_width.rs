//! Whether the contact stays on a flat face.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::follower::{Carrier, Middle};
use crate::profile::{Worst, extremes};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "face_width",
    on: On::Cam,
    about: "The least width of a flat face on which the cam touches it everywhere: with the stem in its middle on a straight path, \
            from the nearest to the farthest contact on an arm. A narrower face touches with its edge and does not keep the motion.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "2 max |s' cos δ + s sin δ + (R_b sin δ − e)/cos δ| with tilt δ and stem offset e; on an arm max ℓ − min ℓ of \
                  ℓ = a cos ψ/(1 ± ψ')",
        usual: "the width of the face, `follower.flat.width` or `follower.swinging-flat.width`; what the contact itself is wide comes on top",
        change: "a wider face, an offset of its stem (`follower.flat.offset`), a smoother law of motion or a longer rise",
    },
    run: check,
};

/// Rounding of a width that was typed from the least that was told, m.
const ROUNDING: f64 = 1e-9;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let (curves, face) = (body.plane()?, body.machine().follower.face?);
    let [least, most] = extremes::places_on_face(curves)?;
    let farther = if most.value >= -least.value { most } else { least };
    let (needed, place, from) = match face.middle {
        Middle::Stem => (2.0 * farther.value.abs(), farther, "stem"),
        Middle::Anywhere => (most.value - least.value, most, "pivot"),
    };
    let kept = face.width.is_none_or(|width| needed <= width + ROUNDING);
    let verdict = face.width.map_or(Verdict::Info, |_| Verdict::of(kept));
    let found = CHECK.found(1e3 * needed, face.width.map(|width| 1e3 * width), "mm", verdict);
    let told = format!("contact from {:.3} to {:.3} mm from the {from}", 1e3 * least.value, 1e3 * most.value);
    let path = body.machine().follower.path;
    let remedy = match (face.width, curves.follower.carrier()) {
        (None, _) => Some(format!("{path}.width gives a limit")),
        (Some(_), _) if kept => None,
        // Contacts come nearer to the stem by e/cos δ.
        (Some(_), Carrier::Stem { offset, tilt }) => {
            let middle = offset + 0.5 * (least.value + most.value) * libm::cos(tilt);
            let narrowest = 1e3 * (most.value - least.value);
            Some(format!("with {path}.offset = \"{:.3} mm\" it needs {narrowest:.3} mm", 1e3 * middle))
        }
        (Some(_), _) => Some("a face as wide as this, from the contact nearest to the pivot on, would pass".into()),
    };
    let worst = Worst { value: place.value, at: place.at, z: 0.0 };
    Some(at(body, &worst, found, Some(std::iter::once(told).chain(remedy).collect::<Vec<_>>().join("; "))))
}
