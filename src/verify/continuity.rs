//! How smooth a motion program is as a whole.

use super::{Bound, Check, Evidence, Explained, On};
use crate::geometry::MILLIMETRES;
use crate::motion::Quantity;
use crate::motion::program::Jump;
use crate::report::{Finding, Verdict, shown};

pub(super) const CHECK: Check = Check {
    name: "continuity",
    on: On::Cam,
    about: "The order of the last derivative of a motion program that is continuous all round: 0 is a jump of the velocity, an impact; 1 \
            a jump of the acceleration; 2 of the jerk; 3 none of these.",
    explained: Explained {
        bound: Bound::AtLeast,
        formula: "the order of the lowest of velocity, acceleration and jerk that differs on the two sides of a joint of the program, less 1",
        usual: "1, `limits.continuity`: no impact; 2 from some hundred revolutions a minute on",
        change: "another law, or the states (`velocity`, `acceleration`, `end`) of the segment that ends there",
    },
    run: check,
};

/// What no derivative that is looked at breaks.
const SMOOTH: f64 = 3.0;

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let motion = body.plane()?.motion;
    let program = motion.program()?;
    let limit = body.machine().limits.continuity;
    let Some(jump) = program.jump() else {
        return Some(CHECK.found(SMOOTH, Some(limit), "1", Verdict::of(SMOOTH >= limit)));
    };
    let value = f64::from(jump.order) - 1.0;
    let found = CHECK.found(value, Some(limit), "1", Verdict::of(value >= limit));
    let note = Some(words(&jump, motion.quantity(), body.shaft_speed()));
    Some(Finding { place: body.place(jump.at), note, ..found })
}

fn words(jump: &Jump, quantity: Quantity, speed: Option<f64>) -> String {
    let (what, power) = match jump.order {
        1 => ("velocity", ""),
        2 => ("acceleration", "²"),
        _ => ("jerk", "³"),
    };
    let (unit, size) = if quantity == Quantity::Angle { ("rad", 1.0) } else { ("mm", MILLIMETRES) };
    let by_time = speed.map_or(String::new(), |speed| {
        let (unit, value) =
            (if quantity == Quantity::Angle { "rad" } else { "m" }, jump.by * libm::pow(speed, f64::from(jump.order)));
        format!(", {} {unit}/s{power} at this speed", shown(value))
    });
    format!("the {what} jumps by {} {unit}/rad{power}{by_time}", shown(size * jump.by))
}
