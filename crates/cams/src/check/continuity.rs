//! How smooth a motion is as a whole.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::Bound;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::jump::{self, Jump};
use camgen_kernel::motion::program::SegmentSummary;
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Text, Value, text};
use std::f64::consts::TAU;

/// The check.
pub const CHECK: Check = Check {
    name: "continuity",
    on: CheckScope::Cam,
    unit: "1",
    about: "The order of the highest derivative of the motion that is continuous wherever the follower runs: 0 is a jump of the velocity, an impact; 1 \
            a jump of the acceleration; 2 a jump of the jerk; 3 means that all of these are continuous.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "the order of the lowest of velocity, acceleration and jerk that differs on the two sides of a joint of the motion, less 1",
        usual: "1, `limits.continuity`: no impact; 2 from a few hundred revolutions per minute",
        change: "in a motion program another law, or the states (`velocity`, `acceleration`, `end`) of the segment that ends there; \
                 in a press `transition.kind`, `buffer.lead` or `buffer.column`",
    },
};

/// The value where velocity, acceleration and jerk are continuous.
const SMOOTH: f64 = 3.0;

/// A motion that a follower runs on, at a place along the axis, m, with the angular speed of its shaft, rad/s, where that is known.
#[derive(Debug, Clone, Copy)]
pub struct RunMotion<'a> {
    /// The motion.
    pub motion: &'a dyn Motion,
    /// Place along the axis.
    pub z: f64,
    /// Angular speed.
    pub speed: Option<f64>,
}

/// Measure of the motions that a follower runs on, by the lowest jump of any of them; `None` without a motion. With a change that would keep
/// the limit.
#[must_use]
pub fn measure(
    motions: &[RunMotion<'_>],
    remedy: impl FnOnce() -> Option<Text>,
    subject: &Subject<'_>,
) -> Option<Measure> {
    motions.first()?;
    let limit = subject.machine.limits.continuity;
    let jumps = motions.iter().filter_map(|run| jump::largest(run.motion).map(|jump| (jump, run)));
    let lowest = |(a, _): &(Jump, _), (b, _): &(Jump, _)| a.order.cmp(&b.order).then(b.by.total_cmp(&a.by));
    let Some((jump, run)) = jumps.min_by(lowest) else { return Some(CHECK.measure(SMOOTH, Some(limit))) };
    let value = f64::from(jump.order) - 1.0;
    let change = if begins_in_a_table(run.motion, &jump) {
        Some("ends = \"rest\" lets the table begin and end at rest".into())
    } else if value < limit {
        remedy()
    } else {
        None
    };
    let note = words(&jump, run).and("; ", change.unwrap_or_default());
    let measure = CHECK.measure(value, Some(limit)).noted(note);
    Some(measure.at(subject, &Worst { value, at: jump.at, z: run.z }))
}

/// Whether a jump below the jerk is at an end of a segment that is given by a table.
fn begins_in_a_table(motion: &dyn Motion, jump: &Jump) -> bool {
    let near = |angle: f64| libm::fmod((angle - jump.at).abs() + 1e-9, TAU) < 2e-9;
    let of_table = |segment: &SegmentSummary| {
        segment.law == "table" && !segment.whole && (near(segment.angles.0) || near(segment.angles.1))
    };
    jump.order < 3 && motion.program().is_some_and(|program| program.segments().iter().any(of_table))
}

fn words(jump: &Jump, run: &RunMotion<'_>) -> Text {
    let (what, power) = match jump.order {
        1 => ("velocity", ""),
        2 => ("acceleration", "²"),
        _ => ("jerk", "³"),
    };
    let (unit, size) = if run.motion.quantity() == Quantity::Angle { ("rad", 1.0) } else { ("mm", MILLIMETRES) };
    // The parameter of what is run over once and back is a length.
    let Some(_) = run.motion.period() else {
        let order = i32::try_from(jump.order).unwrap_or(1);
        let by = Value::with_unit(size * jump.by / MILLIMETRES.powi(order), &format!("{unit}/mm{power}"));
        return text!("the {} jumps by {}", what, by);
    };
    let by_time = run.speed.map(|speed| {
        let unit = if run.motion.quantity() == Quantity::Angle { "rad" } else { "m" };
        let value = jump.by * libm::pow(speed, f64::from(jump.order));
        text!(", {} at this speed", Value::with_unit(value, &format!("{unit}/s{power}")))
    });
    text!("the {} jumps by {}{}", what, Value::with_unit(size * jump.by, &format!("{unit}/rad{power}")), by_time)
}
