//! Pressure in the contact of roller and cam, after Hertz.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::follower::Element;
use crate::machine::{Material, Touching, customary_stress};
use crate::report::{Finding, Verdict};

pub(super) const CHECK: Check = Check {
    name: "contact_stress",
    on: On::Cam,
    about: "The largest pressure between roller and cam after Hertz: in a line under a straight roller or a face, in an ellipse under a \
            crowned roller and under the sphere of a three-dimensional cam. Without limits.contact_stress the customary limit of the material holds.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "p² = F E*/(π b R) in a line of length b, with 1/R of both curvatures; Hertz's ellipse under a crown or a sphere (K. L. Johnson, Contact Mechanics)",
        usual: "that of the material; steel 1500 MPa in a line, hardened, by custom",
        change: "a wider or larger roller, a larger `follower.*.crown_radius`, a larger `cam.base_radius`, a harder `cam.material`, or `limits.contact_stress`",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let Some(worst) = body.contact_stress() else {
        let cam = &body.machine().cam;
        let is_edge = body.plane().is_some_and(|curves| curves.element() == (Element::Roller { radius: 0.0 }));
        if is_edge {
            return Some(
                CHECK.not_run("MPa", "a knife edge has no radius; give a roller of the radius that it is worn to"),
            );
        }
        let at_a_point = body.spatial().is_some() || body.crown_radius().is_some();
        let needs = match (at_a_point, cam.thickness.is_some(), cam.material.is_some()) {
            (true, ..) | (false, true, false) => "cam.material is not given",
            (false, false, true) => "cam.thickness is not given",
            (false, false, false) => "cam.thickness and cam.material are not both given",
            (false, true, true) => "no force on the follower is known",
        };
        return Some(CHECK.not_run("MPa", needs));
    };
    let touching =
        if body.spatial().is_some() || body.crown_radius().is_some() { Touching::Point } else { Touching::Line };
    let machine = body.machine();
    let customary = machine.cam.material.map(|material| customary_stress(material, touching));
    let Some(limit) = machine.limits.contact_stress.or(customary) else {
        return Some(CHECK.not_run("MPa", "cam.material is not given"));
    };
    let kept = worst.value <= limit;
    let told = match (machine.limits.contact_stress, machine.cam.material) {
        (None, Some(material)) => {
            Some(format!("the limit is customary of {}", words(material, touching, body.crown_radius().is_some())))
        }
        _ => None,
    };
    let remedies = if kept { Vec::new() } else { body.stress_remedies(worst.value, limit) };
    let remedy = (!remedies.is_empty()).then(|| format!("{} would keep it", remedies.join(" or ")));
    let standing = kept && body.lacks_inertia();
    let at_rest = standing.then(|| super::force_closure::WITHOUT_INERTIA.to_owned());
    let notes: Vec<String> = told.into_iter().chain(remedy).chain(at_rest).collect();
    let note = (!notes.is_empty()).then(|| notes.join("; "));
    let verdict = if standing { Verdict::Info } else { Verdict::of(kept) };
    Some(at(body, &worst, CHECK.found(1e-6 * worst.value, Some(1e-6 * limit), "MPa", verdict), note))
}

/// What a customary limit is for.
fn words(material: Material, touching: Touching, crowned: bool) -> String {
    let name = match material {
        Material::Steel => "hardened steel",
        Material::CastIron => "cast iron",
        Material::Bronze => "bronze",
        Material::Aluminium => "aluminium",
    };
    match touching {
        Touching::Line => format!("{name} along a line"),
        Touching::Point if crowned => format!("{name} under a crowned roller"),
        Touching::Point => format!("{name} under a sphere"),
    }
}
