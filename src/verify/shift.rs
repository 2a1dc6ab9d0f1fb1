//! What the shift of a conoid along its axis needs: force, and length of the body.

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::body::conoid::ROUNDING;
use crate::report::{Finding, Verdict, shown};

pub(super) const AXIAL_FORCE: Check = Check {
    name: "axial_force",
    on: On::Cam,
    about: "The largest component of the contact force along the axis of a conoid, which the drive of the shift must resist.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "F nᶻ/(n·d), of the unit normal n and the direction d of the roller's path",
        usual: "none; it is for whoever builds the drive of the shift",
        change: "a longer `conoid.axial_travel` between the same speeds",
    },
    run: axial_force,
};

pub(super) const AXIAL_REACH: Check = Check {
    name: "axial_reach",
    on: On::Cam,
    about: "How far the contact of the roller runs beyond the ends of a conoid.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max z of the point of contact, less the end of the cam",
        usual: "0: the roller rests on metal",
        change: "`conoid.overhang = \"auto\"`, or a longer one",
    },
    run: axial_reach,
};

fn axial_force(evidence: &Evidence<'_>) -> Option<Finding> {
    let conoid = evidence.body.spatial()?;
    let force = conoid.axial_force();
    let lean = conoid.largest_lean().to_degrees();
    let note = format!("the normal leans {lean:.3}° along the axis at the most");
    Some(at(evidence.body, &force, AXIAL_FORCE.found(force.value, None, "N", Verdict::Info), Some(note)))
}

fn axial_reach(evidence: &Evidence<'_>) -> Option<Finding> {
    let conoid = evidence.body.spatial()?;
    let reach = conoid.reach();
    let beyond = (reach.value - conoid.overhang()).max(0.0);
    let kept = beyond <= ROUNDING;
    let beyond = if kept { 0.0 } else { beyond };
    let note = if kept {
        format!("the cam is longer than its travel by {} mm at either end", shown(1e3 * conoid.overhang()))
    } else {
        let needed = shown(1e3 * conoid.needed_overhang());
        format!("the roller rides on the edge of the cam; conoid.overhang = \"{needed} mm\" or \"auto\" would carry it")
    };
    let found = AXIAL_REACH.found(1e3 * beyond, Some(0.0), "mm", Verdict::of(kept));
    Some(at(evidence.body, &reach, found, Some(note)))
}
