//! What the follower feels: velocity and acceleration on the outline as it is in the file.

use super::{Bound, Check, Evidence, Explained, On, felt_sections};
use crate::body::Body;
use crate::geometry::MILLIMETRES;
use crate::geometry::contour::Edge;
use crate::motion::Quantity;
use crate::profile::followed::{Errors, Followed};
use crate::profile::{Curves, Worst};
use crate::report::{Felt, Finding, Place, Verdict, shown};

pub(super) const CHECK: Check = Check {
    name: "acceleration",
    on: On::Outline,
    about: "The largest error of the follower's acceleration on the outline as it is in the file, over the largest acceleration of \
            the motion. Arcs give the acceleration in steps, however small their distance from the exact curve.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max |s''(cut) − s''(motion)|/max |s''(motion)|",
        usual: "camgen's own rule: 5 % as it is drawn; it warns above 10 %",
        change: "a smaller --tolerance-acceleration, `--outline spline`, or `limits.acceleration_share`",
    },
    run: check,
};

/// A tolerance may be exceeded by the rounding of the solved error.
const ROUNDING: f64 = 1e-6;
/// Warns beyond this share when no limit is given.
const CUSTOMARY: f64 = 0.1;

/// What the follower feels on the flanks of a written outline, each a list of edges that lies as the follower meets it;
/// `None` where it is nowhere in touch.
pub(super) fn felt<'s>(body: &dyn Body, curves: Curves<'_>, flanks: impl Iterator<Item = &'s [Edge]>) -> Option<Felt> {
    let errors = flanks.map(|edges| Followed::new(curves, edges).errors());
    let errors = errors.fold(Errors::NONE, Errors::or_larger);
    if errors.acceleration == Worst::NONE {
        return None;
    }
    let swings = curves.motion.quantity() == Quantity::Angle;
    let unit = if swings { 1.0 } else { MILLIMETRES };
    let [_, acceleration] = body.largest_rates();
    let told = |worst: Worst| (unit * worst.value.max(0.0), body.place(worst.at));
    Some(Felt {
        swings,
        velocity_error: told(errors.velocity),
        acceleration_error: told(errors.acceleration),
        acceleration_step: told(errors.step),
        acceleration_of_motion: unit * acceleration,
        shaft_speed: body.shaft_speed(),
        // The mass of a plate's follower moves along another path than the bottom.
        mass: body.machine().follower.mass.filter(|_| curves.motion.period().is_some() && !swings),
    })
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let of_sections = |conoid| felt_sections::felt(conoid, evidence.outlines);
    let felt =
        evidence.rolled.and_then(|rolled| rolled.felt).or_else(|| evidence.body.spatial().and_then(of_sections))?;
    let share = felt.acceleration_share()?;
    let unit = if felt.swings { 1.0 } else { MILLIMETRES };
    let over = |(error, _): (f64, Place), asked: f64| error > unit * asked * (1.0 + ROUNDING);
    let too_fast = over(felt.velocity_error, evidence.motion.velocity);
    let too_much = over(felt.acceleration_error, evidence.motion.acceleration);
    let given = evidence.body.machine().limits.acceleration_share;
    let asked = unit * evidence.motion.acceleration / felt.acceleration_of_motion;
    let limit = given.unwrap_or(CUSTOMARY).min(asked);
    let verdict = match given {
        Some(limit) if share > limit => Verdict::Fail,
        _ if (too_fast && evidence.strict[0]) || (too_much && evidence.strict[1]) => Verdict::Fail,
        _ if too_fast || too_much => Verdict::Warn,
        None if share > CUSTOMARY => Verdict::Warn,
        _ => Verdict::Pass,
    };
    let found = CHECK.found(share, Some(limit), "1", verdict);
    let mut note = words(&felt);
    if evidence.body.spatial().is_some() {
        note = format!("sections, to first order: {note}");
    }
    if too_fast {
        let [velocity, _] = felt.units();
        note =
            format!("the velocity exceeds the {} {velocity} asked for; {note}", shown(unit * evidence.motion.velocity));
    }
    Some(Finding { place: felt.acceleration_error.1, note: Some(note), ..found })
}

fn words(felt: &Felt) -> String {
    let [velocity, acceleration] = felt.units();
    let mut words = format!(
        "off by {} {acceleration} of the motion's {}, in steps of up to {} at {}; the velocity by {} {velocity} at {}",
        shown(felt.acceleration_error.0),
        shown(felt.acceleration_of_motion),
        shown(felt.acceleration_step.0),
        felt.acceleration_step.1,
        shown(felt.velocity_error.0),
        felt.velocity_error.1,
    );
    let unit = if felt.swings { "rad/s²" } else { "m/s²" };
    if let (Some(error), Some(motion)) =
        (felt.acceleration(felt.acceleration_error.0), felt.acceleration(felt.acceleration_of_motion))
    {
        words += &format!("; at this speed {} of {} {unit}", shown(error), shown(motion));
    }
    if let Some(force) = felt.force() {
        words += &format!(", {} N of the follower's own mass", shown(force));
    }
    words
}
