//! Pressure in the contact of roller and cam, after Hertz.

use super::force_closure::WITHOUT_INERTIA;
use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::machine::{CamMaterial, Machine, customary_stress_of, stress_at_rest};
use crate::report::{Bound, Topic, Verdict, shown};
use camgen_kernel::document::cams::GROOVE;
use camgen_kernel::follower::Element;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{DIGITS, Remedy, Text, Value, nominal, text};

/// The check.
pub const CHECK: Check = Check {
    name: "contact_stress",
    on: CheckScope::Cam,
    unit: "MPa",
    about: "The largest pressure between roller and cam after Hertz: in a line under a straight roller or a face, in an ellipse under a \
            crowned roller and under the sphere of a three-dimensional cam. Without limits.contact_stress the customary limit of the material for running \
            contact holds; in a point of contact it warns up to the limit at rest.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "p² = F E*/(π b R) in a line whose length b is the thickness of the cam, or in a groove the reach of the roller, 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, 1/R = 1/ρ + 1/r with ρ below 0 where the profile is concave; Hertz's ellipse under a crown or a sphere \
                  (K. L. Johnson, Contact Mechanics)",
        usual: "depends on the material; of hardened steel 1500 MPa in running contact, the fatigue limit of ISO 281, and in a point at rest 4200 MPa (ISO 76)",
        change: "a thicker cam or a deeper groove with a roller of that width, a larger roller, a larger `follower.*.crown_radius`, a larger `cam.base_radius`, a harder `cam.material`, or `limits.contact_stress`",
    },
};

/// How a roller touches its cam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactKind {
    /// Along a line.
    Line,
    /// In an ellipse under a crowned roller.
    Crown,
    /// In an ellipse under a sphere.
    Sphere,
}

/// Measure of the largest pressure, Pa, `None` without contact length, material or forces; with changes, each of which alone keeps a limit
/// that it exceeds.
#[must_use]
pub fn measure(
    largest: Option<Worst>,
    contact: ContactKind,
    remedies: impl FnOnce(f64, f64) -> Vec<Remedy>,
    subject: &Subject<'_>,
) -> Measure {
    let machine = subject.machine;
    let Some(worst) = largest else { return CHECK.unknown(missing(contact, subject)) };
    let customary = machine.cam.material.and_then(|material| customary_stress_of(&material));
    let Some(limit) = machine.limits.contact_stress.or(customary) else {
        let why = if machine.cam.material.is_some() {
            "no limit is known for this material; give cam.contact_limit"
        } else {
            "cam.material is not given"
        };
        return CHECK.unknown(why);
    };
    let kept = worst.value <= limit;
    let customary_note = match (machine.limits.contact_stress, machine.cam.material) {
        (None, Some(material)) => Some(words(&material, contact)),
        _ => None,
    };
    let allowed = largest_allowed(machine, contact).is_some_and(|allowed| worst.value <= allowed);
    let remedies = if kept { Vec::new() } else { remedies(worst.value, limit) };
    let remedy = (!remedies.is_empty())
        .then(|| text!("{} would keep it", Text::joined(remedies.into_iter().map(Text::from), " or ")));
    let without_inertia = kept && subject.lacks_inertia();
    let at_rest = without_inertia.then(|| Text::from(WITHOUT_INERTIA));
    let customary_note = customary_note.map(Text::from);
    let notes = Text::joined(customary_note.into_iter().chain(remedy).chain(at_rest), "; ");
    let verdict = match (without_inertia, kept, allowed) {
        (true, ..) => Verdict::Info,
        (_, false, true) => Verdict::Warn,
        _ => Verdict::of(kept),
    };
    let assumed = match (machine.limits.contact_stress, machine.cam.material) {
        (None, Some(material)) => material.assumed_state(),
        _ => None,
    };
    let of_limit = Value::from(nominal(1e-6 * limit, DIGITS));
    let fact = text!("{} of {}", Value::brief(1e-6 * worst.value, "MPa"), of_limit)
        .and(": ", assumed.as_ref().map(|state| text!("{} is assumed", state)));
    let measure = CHECK.measure(1e-6 * worst.value, Some(1e-6 * limit)).judged(verdict);
    let assumed = assumed.map_or_else(Text::default, Text::from);
    measure.noted(notes).at(subject, &worst).with_fact(Topic::STRESS, fact).assuming(assumed)
}

/// The largest pressure with which the check does not fail, Pa; `None` where neither a limit nor a material is given.
#[must_use]
pub fn largest_allowed(machine: &Machine, contact: ContactKind) -> Option<f64> {
    let of_material = |material: CamMaterial| {
        if contact == ContactKind::Line { customary_stress_of(&material) } else { stress_at_rest(&material) }
    };
    machine.limits.contact_stress.or_else(|| machine.cam.material.and_then(of_material))
}

/// What is not given.
fn missing(contact: ContactKind, subject: &Subject<'_>) -> &'static str {
    let cam = &subject.machine.cam;
    if subject.curves.is_some_and(|curves| curves.element() == (Element::Roller { radius: 0.0 })) {
        return "a knife edge has no radius; give a roller with the radius that the edge has when worn";
    }
    let in_groove = cam.track.body == GROOVE;
    match (contact != ContactKind::Line, cam.contact_length().is_some(), cam.material.is_some()) {
        (true, ..) | (false, true, false) => "cam.material is not given",
        (false, false, true) if in_groove => "cam.groove_depth is not given",
        (false, false, false) if in_groove => "cam.groove_depth and cam.material are not both given",
        (false, false, true) => "cam.thickness is not given",
        (false, false, false) => "cam.thickness and cam.material are not both given",
        (false, true, true) => "no force on the follower is known",
    }
}

/// The customary limit of a material in a kind of contact.
fn words(material: &CamMaterial, contact: ContactKind) -> String {
    let name = material.class.customary_state();
    let limit = material.limit_words().unwrap_or_else(|| format!("the customary limit of {name}"));
    let under = match contact {
        ContactKind::Line => return format!("{limit} along a line"),
        ContactKind::Crown => "a crowned roller",
        ContactKind::Sphere => "a sphere",
    };
    let at_rest = stress_at_rest(material)
        .map_or(String::new(), |stress| format!("; at rest under {under} it is {} MPa", shown(1e-6 * stress)));
    format!("{limit} in running contact{at_rest}")
}
