//! Whether the contact stays on a flat face.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::{Bound, Verdict};
use camgen_kernel::follower::{Carrier, FaceMiddle};
use camgen_kernel::profile::{Worst, extremes};
use camgen_kernel::text::{KeyChange, Length, Remedy, Text, text};

/// The check.
pub const CHECK: Check = Check {
    name: "face_width",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The least width of a flat face on which the cam touches it everywhere: with the stem in its middle on a straight path, \
            from the nearest to the farthest contact on an arm. A narrower face touches with its edge and does not keep the motion.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "2 max |s' cos δ + s sin δ + (R_b sin δ − e)/cos δ| with tilt δ and stem offset e; on an arm max ℓ − min ℓ of \
                  ℓ = a cos ψ/(1 ± ψ')",
        usual: "the width of the face, `follower.flat.width` or `follower.swinging-flat.width`; the width of the contact itself must be added",
        change: "a wider face, an offset of its stem (`follower.flat.offset`), a smoother law of motion or a longer rise",
    },
};

/// Rounding of a width that was typed from the reported least width, m.
const ROUNDING: f64 = 1e-9;

/// Measure of the face of a machine; `None` under a roller.
#[must_use]
pub fn measure(subject: &Subject<'_>) -> Option<Measure> {
    let (curves, face) = (subject.curves?, subject.machine.follower.face?);
    let [least, most] = extremes::places_on_face(curves)?;
    let farther = if most.value >= -least.value { most } else { least };
    let (needed, place, from) = match face.middle {
        FaceMiddle::Stem => (2.0 * farther.value.abs(), farther, "stem"),
        FaceMiddle::Anywhere => (most.value - least.value, most, "pivot"),
    };
    let kept = face.width.is_none_or(|width| needed <= width + ROUNDING);
    let verdict = face.width.map_or(Verdict::Info, |_| Verdict::of(kept));
    let contacts = text!(
        "contact from {} to {} from the {}",
        Length::mm(1e3 * least.value).decimals(3).bare(),
        Length::mm(1e3 * most.value).decimals(3),
        from
    );
    let path = subject.machine.follower.path;
    let remedy = match (face.width, curves.follower.carrier()) {
        (None, _) => Some(text!("{}.width gives a limit", path)),
        (Some(_), _) if kept => None,
        // Contacts come nearer to the stem by e/cos δ.
        (Some(_), Carrier::Stem { offset, tilt }) => {
            let middle = offset + 0.5 * (least.value + most.value) * libm::cos(tilt);
            let narrowest = 1e3 * (most.value - least.value);
            let moved = (middle - offset).abs() > ROUNDING;
            let change = KeyChange::new(format!("{path}.offset"), format!("{:.3} mm", 1e3 * middle));
            let narrower =
                moved.then(|| text!("with {} it needs {}", change.to_string(), Length::mm(narrowest).decimals(3)));
            Some(wider(path, needed).and("; ", narrower))
        }
        (Some(_), _) => Some(wider(path, needed).and("", ", from the contact nearest to the pivot on")),
    };
    let worst = Worst { value: place.value, at: place.at, z: 0.0 };
    let note = contacts.and("; ", remedy.unwrap_or_default());
    let measure = CHECK.measure(1e3 * needed, face.width.map(|width| 1e3 * width)).judged(verdict).noted(note);
    Some(measure.at(subject, &worst))
}

/// The change to a face that is as wide as it must be, m, in whole millimetres.
fn wider(path: &str, needed: f64) -> Text {
    let width = KeyChange::new(format!("{path}.width"), format!("{} mm", (1e3 * needed - 1e-6).ceil()));
    text!("{} would pass", Remedy::new([width]))
}
