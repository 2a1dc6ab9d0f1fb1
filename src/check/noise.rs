//! What the rounding of rows does to the acceleration.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::geometry::MILLIMETRES;
use crate::motion::Quantity;
use crate::report::{Bound, Verdict, shown};

/// The check.
pub const CHECK: Check = Check {
    name: "noise",
    on: CheckScope::Cam,
    unit: "1",
    about: "The largest acceleration of the curve through rounded rows over that of the smoothest curve which every row allows: the rounding of \
            lift tables is small, but its second derivative is not.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max|s''| through the rows over max|s''| of the curve of least jerk within half of their rounding",
        usual: "1.1: rounding to a hundredth of a millimetre or a thousandth of an inch at each degree makes several times the acceleration",
        change: "`smooth = \"auto\"`, or rows with more digits",
    },
};

/// How many times larger the acceleration may be by rounding before the check warns.
const LIMIT: f64 = 1.1;

/// Measure of a motion through rows that look rounded; `None` of another motion, and where smoothing is asked for.
#[must_use]
pub fn measure(subject: &Subject<'_>) -> Option<Measure> {
    let motion = subject.curves?.motion;
    let all = motion.program()?.rows().iter().filter_map(|rows| Some((rows, rows.noise?)));
    let share = |(_, (now, smooth)): &(_, (f64, f64))| now / smooth;
    let (rows, (now, smooth)) = all.reduce(|a, b| if share(&b) > share(&a) { b } else { a })?;
    let value = now / smooth;
    let swings = motion.quantity() == Quantity::Angle;
    let (unit, size) = if swings { ("deg", 1.0_f64.to_degrees()) } else { ("mm", MILLIMETRES) };
    let note = (value > LIMIT).then(|| {
        format!(
            "the rows{} look rounded to {} {unit}: smooth = \"auto\" would change the largest acceleration from {} to {} {unit}/rad²",
            rows.segment.map_or(String::new(), |index| format!(" of segment {}", index + 1)),
            shown(size * rows.rounding),
            shown(size * now),
            shown(size * smooth)
        )
    });
    let verdict = if value > LIMIT { Verdict::Warn } else { Verdict::Pass };
    Some(CHECK.measure(value, Some(LIMIT)).judged(verdict).noted(note))
}
