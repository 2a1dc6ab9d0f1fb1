//! What the rounding and the scatter of rows do to the acceleration.

use super::{Check, CheckExplanation, CheckScope, Measure, Subject, position};
use crate::report::{Bound, Verdict, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use camgen_kernel::motion::program::rows::{RowFigures, RowNoise};
use camgen_kernel::text::{Length, LengthKind, Text, Value, text};

/// The check.
pub const CHECK: Check = Check {
    name: "noise",
    on: CheckScope::Cam,
    unit: "1",
    about: "The largest acceleration of the curve through rounded or measured rows over that of the smoothest curve near them: the errors of \
            lift tables are small, but their second derivatives are not. Scatter is looked for in 90 rows or more; it is what a row differs from the \
            polynomial through its six neighbours.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max|s''| through the rows over max|s''| of the curve of least jerk within half of their rounding, or within 3.5 standard \
                  deviations of their scatter",
        usual: "1.1: rounding to a hundredth of a millimetre or a thousandth of an inch at each degree makes several times the acceleration, and so \
                does a scatter of 3 um",
        change: "`smooth = \"auto\"` for rounded rows, the `smooth` that the warning names for measured ones; or `camgen import` finds the laws \
                 that the rows follow",
    },
};

/// How many times larger the acceleration may be by errors of the rows before the check warns.
const LIMIT: f64 = 1.1;

/// Measure of a motion through rows that look rounded or scatter; `None` of another motion, and where enough smoothing is asked for.
#[must_use]
pub fn measure(subject: &Subject<'_>) -> Option<Measure> {
    let motion = subject.curves?.motion;
    let all = motion.program()?.rows().iter().filter_map(|rows| Some((rows, rows.noise?)));
    let share = |(_, noise): &(_, RowNoise)| noise.largest / noise.smoothed;
    let (rows, noise) = all.reduce(|a, b| if share(&b) > share(&a) { b } else { a })?;
    let value = noise.largest / noise.smoothed;
    let note = (value > LIMIT).then(|| note(rows, noise, motion.quantity() == Quantity::Angle));
    let verdict = if value > LIMIT { Verdict::Warn } else { Verdict::Pass };
    Some(CHECK.measure(value, Some(LIMIT)).judged(verdict).noted(note))
}

/// What is seen in the rows, and what smoothing would change.
fn note(rows: &RowFigures, noise: RowNoise, swings: bool) -> Text {
    let (unit, size) = if swings { ("deg", 1.0_f64.to_degrees()) } else { ("mm", MILLIMETRES) };
    let of = rows.segment.map_or(String::new(), |index| format!(" of segment {}", index + 1));
    let (seen, smooth) = match noise.scatter {
        Some(scatter) => (
            text!("scatter about a smooth curve with a standard deviation of {}", position(scatter, swings)),
            format!("smooth = \"{} {unit}\"", rounded_up(size * noise.smooth)),
        ),
        None => (text!("look rounded to {}", position(rows.rounding, swings)), "smooth = \"auto\"".to_owned()),
    };
    let [from, to]: [Value; 2] = if swings {
        [shown(size * noise.largest).into(), format!("{} deg/rad²", shown(size * noise.smoothed)).into()]
    } else {
        let acceleration = |value: f64| Length::new(size * value, &LengthKind::MM_PER_RAD2);
        [acceleration(noise.largest).bare().into(), acceleration(noise.smoothed).into()]
    };
    text!("the rows{} {}: {} would change the largest acceleration from {} to {}", of, seen, smooth, from, to)
}

/// A number of two digits, not below it.
fn rounded_up(value: f64) -> f64 {
    let step = libm::pow(10.0, libm::floor(libm::log10(value)) - 1.0);
    // What division and product add beyond two digits is taken away.
    let up = libm::ceil(value / step - 1e-9) * step;
    (up * 1e12).round() / 1e12
}
