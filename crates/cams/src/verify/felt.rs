//! The motion as cut: velocity and acceleration of the follower on the outline as it is in the file.

use super::check::{Evidence, FileCheck};
use super::felt_sections;
use crate::body::{Body, curves_of};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{AsCutError, Bound, Finding, Place, Verdict, shown};
use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::followed::{ErrorsOnChain, FollowerOnChain};
use camgen_kernel::profile::outline::too_many_arcs;
use camgen_kernel::profile::{Curves, Worst};
use camgen_kernel::text::{Text, Value, text};

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "acceleration",
        on: CheckScope::Outline,
        unit: "1",
        about: "The largest error of the follower's acceleration on the outline as it is in the file, over the largest acceleration of \
                the motion. On arcs the acceleration changes in steps, however close they are to the exact curve.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "max |s''(cut) − s''(motion)|/max |s''(motion)|",
            usual: "camgen's own rule: outlines are drawn to 5 %, the check warns above 10 %",
            change: "a smaller --tolerance-acceleration, `--outline spline`, or `limits.acceleration_share`",
        },
    },
    run: check,
};

/// The solved error may exceed the tolerance by its rounding.
const ROUNDING: f64 = 1e-6;
/// A step of the velocity below this share of its largest value is the rounding of a file.
const FELT: f64 = 1e-6;
/// Without a limit, the check warns beyond this share.
const CUSTOMARY: f64 = 0.1;

/// The motion of the follower on the flanks of a written outline, each a list of edges in the order in which the follower meets them;
/// `None` where it touches nowhere.
pub(super) fn of_flanks<'s>(
    body: &dyn Body,
    curves: Curves<'_>,
    flanks: impl Iterator<Item = &'s [Edge]>,
) -> Option<AsCutError> {
    let errors = flanks.map(|edges| FollowerOnChain::new(curves, edges).errors());
    let errors = errors.fold(ErrorsOnChain::NONE, ErrorsOnChain::or_larger);
    if errors.acceleration == Worst::NONE {
        return None;
    }
    let swings = curves.motion.quantity() == Quantity::Angle;
    let by_travel = curves.motion.is_by_travel();
    let [of_velocity, of_acceleration] = AsCutError::sizes(swings, by_travel);
    let [velocity, acceleration] = body.largest_rates();
    let kink = errors.velocity_step;
    let placed = |worst: Worst, unit: f64| (unit * worst.value.max(0.0), body.place(worst.at));
    Some(AsCutError {
        swings,
        by_travel,
        velocity_error: placed(errors.velocity, of_velocity),
        acceleration_error: placed(errors.acceleration, of_acceleration),
        acceleration_step: placed(errors.step, of_acceleration),
        velocity_step: (kink.value > FELT * velocity).then(|| placed(kink, of_velocity)),
        acceleration_of_motion: of_acceleration * acceleration,
        shaft_speed: body.shaft_speed(),
        // The mass of a plate's follower moves along another path than the bottom.
        mass: body.machine().follower.mass.filter(|_| curves.motion.period().is_some() && !swings),
    })
}

/// The motion on the outlines that a follower rolls on, for the outline with the largest error of the acceleration.
fn of_outlines(evidence: &Evidence<'_>) -> Option<AsCutError> {
    let all = evidence.rolled.iter().filter_map(|rolled| rolled.as_cut);
    all.reduce(|worst, next| if next.acceleration_error.0 > worst.acceleration_error.0 { next } else { worst })
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let motion = match evidence.body.surface() {
        Some(surface) => felt_sections::of_sections(evidence, surface),
        None => of_outlines(evidence),
    }?;
    let share = motion.acceleration_share()?;
    let [of_velocity, of_acceleration] = AsCutError::sizes(motion.swings, motion.by_travel);
    let over = |(error, _): (f64, Place), requested: f64| error > requested * (1.0 + ROUNDING);
    let too_fast = over(motion.velocity_error, of_velocity * evidence.motion.velocity);
    let too_much = over(motion.acceleration_error, of_acceleration * evidence.motion.acceleration);
    let given = evidence.body.machine().limits.acceleration_share;
    let requested = of_acceleration * evidence.motion.acceleration / motion.acceleration_of_motion;
    let limit = given.unwrap_or(CUSTOMARY).min(requested);
    let verdict = match given {
        Some(limit) if share > limit => Verdict::Fail,
        _ if (too_fast && evidence.strict[0]) || (too_much && evidence.strict[1]) => Verdict::Fail,
        _ if too_fast || too_much => Verdict::Warn,
        None if share > CUSTOMARY => Verdict::Warn,
        _ => Verdict::Pass,
    };
    let found = CHECK.found(share, Some(limit), verdict);
    let mut note = words(&motion);
    let needed = curves_of(evidence.body).and_then(|curves| too_many_arcs(curves, evidence.motion));
    if let (true, Some(arcs)) = (too_much, needed) {
        note =
            text!("the acceleration requested needs {} arcs or more, too many for a control; {}", arcs.round(), note);
    }
    if evidence.body.surface().is_some() {
        note = text!("sections, to first order: {}", note);
    }
    if too_fast {
        let [velocity, _] = motion.units();
        let requested = Value::with_unit(of_velocity * evidence.motion.velocity, velocity);
        note = text!("the velocity exceeds the {} requested; {}", requested, note);
    }
    Some(Finding { place: motion.acceleration_error.1, note: Some(note), ..found })
}

fn words(motion: &AsCutError) -> Text {
    let [velocity, acceleration] = motion.units();
    let mut words = text!(
        "off by {} of the motion's {}, in steps of up to {} at {}; the velocity by {} at {}",
        Value::with_unit(motion.acceleration_error.0, acceleration),
        Value::before_unit(motion.acceleration_of_motion, acceleration),
        Value::before_unit(motion.acceleration_step.0, acceleration),
        motion.acceleration_step.1.text(),
        Value::with_unit(motion.velocity_error.0, velocity),
        motion.velocity_error.1.text(),
    );
    if let Some((step, place)) = motion.velocity_step {
        words += text!(
            "; at the kinks the velocity steps by up to {}, at {}",
            Value::with_unit(step, velocity),
            place.text()
        );
    }
    let unit = if motion.swings { "rad/s²" } else { "m/s²" };
    if let (Some(error), Some(motion)) =
        (motion.acceleration(motion.acceleration_error.0), motion.acceleration(motion.acceleration_of_motion))
    {
        words += text!("; at this speed {} of {}", Value::before_unit(error, unit), Value::with_unit(motion, unit));
    }
    if let Some(force) = motion.force() {
        words += text!(", {} N of the follower's own mass", shown(force));
    }
    words
}
