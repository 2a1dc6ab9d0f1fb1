//! The checks of a conoid: force and reach along its axis, the contact of a cylindrical roller, and the speeds between its sections.

use super::{Conoid, ROUNDING, between};
use crate::press::MachineOfPress;
use crate::press::motion::Transition;
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::machine::Crown;
use camgen_cams::report::{Bound, Place, Verdict, shown, to_type};
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

/// Whether a cylindrical roller touches with its edge where the flank leans along the axis.
pub const CYLINDER_CONTACT: Check = Check {
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

/// The residual force of a cam for many speeds at the speeds between its sections.
pub const BETWEEN_SECTIONS: Check = Check {
    name: "between_sections",
    on: CheckScope::Cam,
    unit: "N",
    about: "The largest residual force, inertia less air, at any speed between the sections of a conoid.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |inertia − air| over the speeds between the sections",
        usual: "--residual, or what straight strips between the sections leave",
        change: "more speeds in --rpm, or `--rpm A..B --residual FORCE`, which chooses them",
    },
};

/// Points over the width of the roller, as shares of it.
const POINTS: [f64; 5] = [-0.5, -0.25, 0.0, 0.25, 0.5];

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
            Remedy::new([KeyChange::new("conoid.overhang", "auto")]).in_words("\"auto\"")
        )
    };
    AXIAL_REACH.measure(1e3 * beyond, Some(0.0)).kept(kept).noted(note).at(subject, &reach)
}

/// Measure of the largest departure; `None` of a roller that is not a cylinder, or has no width.
pub(super) fn cylinder_contact(conoid: &Conoid, tolerance_mm: f64, subject: &Subject<'_>) -> Option<Measure> {
    let roller = conoid.roller();
    let width = (roller.crown == Crown::Cylinder).then_some(roller.width)??;
    let gap = conoid.worst(|conoid, place| {
        let (height, slope) = conoid.height_and_slope(&place.partials);
        let cosine = height / libm::hypot(height, slope);
        let lifts = POINTS.map(|share| conoid.lift(place.piece, place.angle, place.z + share * width)[0][0] * cosine);
        let (least, most) = lifts.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        1e3 * (most - least)
    });
    let kept = gap.value <= tolerance_mm;
    let note = (!kept).then(|| {
        let remedy = Remedy::new([KeyChange::new("follower.roller.crown", "sphere")]);
        text!("the roller touches with its edge; {} would avoid that", remedy)
    });
    Some(CYLINDER_CONTACT.measure(gap.value, Some(tolerance_mm)).kept(kept).noted(note).at(subject, &gap))
}

/// Measure of the largest residual force between two sections.
pub(super) fn between_sections(conoid: &Conoid) -> Measure {
    let (left, limit) = (conoid.residual_between(), conoid.residual_limit());
    let worse = conoid.is_worse_than_strips();
    let verdict = match limit {
        Some(limit) => Verdict::of(left.force <= limit),
        None if worse => Verdict::Warn,
        None => Verdict::Info,
    };
    let mut note = format!("at {:.3} rpm, of {} sections", left.rpm, conoid.section_count());
    if worse {
        note += &format!("; straight strips would leave {} N", shown(conoid.residual_of_strips().force));
    }
    if matches!(verdict, Verdict::Fail | Verdict::Warn) {
        let wanted = limit.unwrap_or(conoid.residual_of_strips().force);
        note += &if let Some(speeds) = conoid.speeds_within(wanted) {
            let list: Vec<String> = speeds.iter().map(f64::to_string).collect();
            format!("; --rpm {} would leave no more than {} N", list.join(","), shown(wanted))
        } else {
            let most = between::MOST_SECTIONS;
            let blend = matches!(conoid.machine.transition(), Transition::Blend { .. });
            let why = if blend { ": the blend itself leaves a residual force, a run-up leaves none" } else { "" };
            format!("; no {most} sections evenly spaced in speed leave as little as {} N{why}", shown(wanted))
        };
    }
    BETWEEN_SECTIONS.measure(left.force, limit).judged(verdict).noted(note).placed(Place::at_angle(left.angle))
}
