//! What the shift of a conoid along its axis needs: force, and length of the body.

use super::{Check, Evidence, On, at};
use crate::report::{Finding, Verdict};

pub(super) const AXIAL_FORCE: Check = Check {
    name: "axial_force",
    on: On::Cam,
    about: "The largest component of the contact force along the axis of a conoid, which the drive of the shift must resist.",
    run: axial_force,
};

pub(super) const AXIAL_REACH: Check = Check {
    name: "axial_reach",
    on: On::Cam,
    about: "How far the contact of the roller runs beyond the ends of a conoid.",
    run: axial_reach,
};

/// Rounding of a place along the axis, m.
const ROUNDING: f64 = 1e-12;

fn axial_force(evidence: &Evidence<'_>) -> Option<Finding> {
    let conoid = evidence.body.spatial()?;
    let force = conoid.axial_force();
    let lean = conoid.worst(|conoid, piece, angle, z| conoid.contact(piece, angle, z).normal.z.abs());
    let note = format!("the normal leans {:.3}° along the axis at the most", libm::asin(lean.value).to_degrees());
    Some(at(evidence.body, &force, AXIAL_FORCE.found(force.value, None, "N", Verdict::Info), Some(note)))
}

/// Without an overhang in the machine file it is only reported, with one it can fail.
fn axial_reach(evidence: &Evidence<'_>) -> Option<Finding> {
    let conoid = evidence.body.spatial()?;
    let (low, high) = conoid.ends();
    let beyond = conoid.worst(|conoid, piece, angle, z| {
        let contact = conoid.contact(piece, angle, z).point.z;
        (contact - high).max(low - contact)
    });
    let reach = beyond.value.max(0.0);
    let overhang = conoid.data().overhang;
    let kept = reach <= ROUNDING;
    let verdict = if overhang > 0.0 || kept { Verdict::of(kept) } else { Verdict::Info };
    let needed = (1e3 * (overhang + reach)).ceil();
    let note = (!kept).then(|| {
        format!("the roller touches beyond the end of the cam; conoid.overhang = \"{needed} mm\" would carry it")
    });
    Some(at(evidence.body, &beyond, AXIAL_REACH.found(1e3 * reach, Some(0.0), "mm", verdict), note))
}
