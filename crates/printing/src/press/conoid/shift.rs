//! What the shift of a conoid along its axis needs: force, and length of the body.

use super::{Conoid, ROUNDING};
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::report::{Bound, to_type};
use camgen_kernel::text::{KeyChange, Length, Remedy, text};

/// The check of the axial force, for the drive of the shift.
pub const AXIAL_FORCE: Check = Check {
    name: "axial_force",
    on: CheckScope::Cam,
    unit: "N",
    about: "The largest component of the contact force along the axis of a conoid, which the drive of the shift must resist.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "F nᶻ/(n·d), of the unit normal n and the direction d of the roller's path",
        usual: "none; it is a figure for the design of the shift drive",
        change: "a longer `conoid.axial_travel` between the same speeds",
    },
};

/// The check of the length of the body.
pub const AXIAL_REACH: Check = Check {
    name: "axial_reach",
    on: CheckScope::Cam,
    unit: "mm",
    about: "How far the contact of the roller runs beyond the ends of a conoid.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max z of the point of contact, less the end of the cam",
        usual: "0: the roller rests on metal",
        change: "`conoid.overhang = \"auto\"`, or a longer one",
    },
};

/// Measure of the largest force along the axis.
pub(super) fn axial_force(conoid: &Conoid, subject: &Subject<'_>) -> Measure {
    let force = conoid.axial_force();
    let lean = conoid.largest_lean().to_degrees();
    let note = format!("the normal leans at most {lean:.3}° along the axis");
    AXIAL_FORCE.measure(force.value, None).noted(note).at(subject, &force)
}

/// Measure of the contact beyond the ends.
pub(super) fn axial_reach(conoid: &Conoid, subject: &Subject<'_>) -> Measure {
    let reach = conoid.reach();
    let beyond = (reach.value - conoid.overhang()).max(0.0);
    let kept = beyond <= ROUNDING;
    let beyond = if kept { 0.0 } else { beyond };
    let note = if kept {
        text!("the cam is longer than its travel by {} at either end", Length::mm(1e3 * conoid.overhang()))
    } else {
        let needed = format!("{} mm", to_type(1e3 * conoid.needed_overhang()));
        text!(
            "the roller rides on the edge of the cam; {} or {} would carry it",
            Remedy::new([KeyChange::new("conoid.overhang", needed)]),
            Remedy::new([KeyChange::new("conoid.overhang", "auto")]).named("\"auto\"")
        )
    };
    AXIAL_REACH.measure(1e3 * beyond, Some(0.0)).kept(kept).noted(note).at(subject, &reach)
}
