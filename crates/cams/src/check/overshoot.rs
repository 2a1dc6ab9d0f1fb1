//! How far a curve through rows leaves them.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject, position};
use crate::machine::OvershootLimit;
use crate::report::{Bound, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use camgen_kernel::motion::program::rows::RowFigures;
use camgen_kernel::profile::{Worst, lifts};
use camgen_kernel::text::{Text, text};

/// The check.
pub const CHECK: Check = of_unit("mm");

/// The check of a swing.
pub const OF_SWING: Check = of_unit("deg");

const fn of_unit(unit: &'static str) -> Check {
    Check {
        name: "overshoot",
        on: CheckScope::Cam,
        unit,
        about: "How far the curve through the rows of a table, through points or along a spline rises above or sinks below the two rows between which it runs: in a \
                gap between rows a spline can swing far beyond them.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "the largest distance of the position from the range of two neighbouring rows, between them; of smoothed rows where \
                      `smooth` is given",
            usual: "1 % of the lift, at least the tolerance of the outline, or `limits.overshoot`, a length, an angle of a swing or a share of the lift",
            change: "more rows in the gap, equal rows at both ends of a dwell, or `shape = \"monotonic\"`",
        },
    }
}

/// Share of the lift that is allowed where no limit is given.
const SHARE: f64 = 0.01;

/// Measure of a motion through rows; `None` of another motion.
#[must_use]
pub fn measure(tolerance_mm: f64, subject: &Subject<'_>) -> Option<Measure> {
    let motion = subject.curves?.motion;
    let swings = motion.quantity() == Quantity::Angle;
    let (check, size) = if swings { (&OF_SWING, 1.0_f64.to_degrees()) } else { (&CHECK, MILLIMETRES) };
    let lift = size * lifts(motion).1;
    // The tolerance of the outline is a length.
    let least = if swings { 0.0 } else { tolerance_mm };
    let limit = match subject.machine.limits.overshoot {
        None => least.max(SHARE * lift),
        Some(OvershootLimit::By(limit)) => size * limit,
        Some(OvershootLimit::OfLift(share)) => share * lift,
    };
    let rows = motion.program()?.rows().iter().reduce(|a, b| if b.overshoot.0 > a.overshoot.0 { b } else { a })?;
    let (by, at) = rows.overshoot;
    let value = size * by;
    let note = (value > limit).then(|| words(rows, (by, at), swings));
    let (place, _) = (subject.at)(&Worst { value, at, z: 0.0 });
    Some(check.measure(value, Some(limit)).noted(note).placed(place))
}

fn words(rows: &RowFigures, (by, at): (f64, f64), swings: bool) -> Text {
    let deg = |angle: f64| shown((angle.to_degrees() * 1e6).round() / 1e6 + 0.0);
    let (from, to) = rows.widest;
    let gap = if to - from > 1.5 * rows.spacing {
        format!("; the widest gap is from {} to {} deg", deg(from), deg(to))
    } else {
        String::new()
    };
    let segment = rows.segment.map_or(String::new(), |index| format!("in segment {} ", index + 1));
    text!(
        "{}at {} deg the curve leaves the two rows around it by {}{}: add rows there, or use shape = \"monotonic\"",
        segment,
        deg(at),
        position(by, swings),
        gap
    )
}
