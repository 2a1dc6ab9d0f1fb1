//! Check for a row off the curve through its neighbours.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject, position};
use crate::report::{Bound, Place};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::program::rows::{RowFigures, RowOutlier};
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::text::{Text, text};

/// The check.
pub const CHECK: Check = of_unit("mm");

/// The check for swings.
pub const OF_SWING: Check = of_unit("deg");

const fn of_unit(unit: &'static str) -> Check {
    Check {
        name: "outlier",
        on: CheckScope::Cam,
        unit,
        about: "Distance of a table row, a point or a sample from the curve through its neighbours: one wrong digit makes a bump on the cam.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "|position − polynomial through four or six neighbours| of the row with the largest ratio to its limit; at least 20 rows",
            usual: "the largest of 3 times the bend shown by the divided differences of its neighbours alone, 3.5 rounding steps and 12 standard \
                    deviations of the scatter; correct rows of laws with acceleration steps stay below. 18 instead of 3 times for fewer than 72 \
                    rows, for uneven rows and next to a velocity step",
            change: "correct the row, or leave it out; for an intended bump give more rows around it",
        },
    }
}

/// Measure of a motion through rows; `None` for other motions and for too few rows.
#[must_use]
pub fn measure(subject: &Subject<'_>) -> Option<Measure> {
    of_motion(subject.curves?.motion)
}

/// Measure of a motion through rows.
#[must_use]
pub fn of_motion(motion: &dyn Motion) -> Option<Measure> {
    let swings = motion.quantity() == Quantity::Angle;
    let (check, size) = if swings { (&OF_SWING, 1.0_f64.to_degrees()) } else { (&CHECK, MILLIMETRES) };
    let all = motion.program()?.rows().iter().filter_map(|rows| Some((rows, rows.outlier?)));
    let share = |(_, outlier): &(_, RowOutlier)| outlier.off.abs() / outlier.allowed;
    let (rows, outlier) = all.reduce(|a, b| if share(&b) > share(&a) { b } else { a })?;
    let (value, limit) = (size * outlier.off.abs(), size * outlier.allowed);
    let note = (value > limit).then(|| note(rows, outlier, swings));
    let place = if motion.is_by_travel() { Place::at_overrun(outlier.at) } else { Place::at_angle(outlier.at) };
    Some(check.measure(value, Some(limit)).noted(note).placed(place))
}

fn note(rows: &RowFigures, outlier: RowOutlier, swings: bool) -> Text {
    let segment = rows.segment.map_or(String::new(), |index| format!(" of segment {}", index + 1));
    let line = outlier.line.map_or(String::new(), |line| format!(" (line {line} of the file)"));
    let side = if outlier.off > 0.0 { "above" } else { "below" };
    text!(
        "row {}{}{} is {} {} the curve through its neighbours: correct it, or leave it out",
        outlier.row,
        segment,
        line,
        position(outlier.off.abs(), swings),
        side
    )
}
