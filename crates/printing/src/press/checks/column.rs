//! The length of the air column, against what a press has room for.

use crate::press::load::ColumnAtSpeed;
use crate::press::machine::{Press, PressCams};
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure};
use camgen_cams::machine::Machine;
use camgen_cams::report::{Bound, Verdict};
use camgen_kernel::numeric::digits::three_digits_up;
use camgen_kernel::numeric::root;

/// The check.
pub const CHECK: Check = Check {
    name: "column",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The length of the air column between piston and bottom where the reversal begins. It grows with the inverse square of the speed: at a few \
            revolutions a minute no press has room for it.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "L = k/A of the matched column, or by (14); the longest over the speeds",
        usual: "2 m: the room behind the bed of a flat-bed press; `limits.column` where it is given",
        change: "a higher --rpm, a given `buffer.column`, or `limits.column` for a press with more room",
    },
};

/// Customary largest column, m.
pub const CUSTOMARY: f64 = 2.0;
/// Highest trial speed / speed of the longest column.
const FASTEST: f64 = 1e4;

/// Measure of the longest of the columns of an analysis, of which nothing is cut: beyond the customary limit it warns; `None` without one.
#[must_use]
pub fn measure_of_analysis(columns: &[ColumnAtSpeed], machine: &Machine) -> Option<Measure> {
    let measure = measure(columns, machine, |_, _| None)?;
    let is_customary = PressCams::of(machine).largest_column.is_none();
    let beyond = measure.limit.is_some_and(|limit| measure.value > limit);
    Some(if is_customary && beyond { measure.judged(Verdict::Warn) } else { measure })
}

/// Measure of the longest of some columns; `column_at` is the column at any speed, m. `None` without one.
#[must_use]
pub fn measure(
    columns: &[ColumnAtSpeed],
    machine: &Machine,
    column_at: impl Fn(&Press, f64) -> Option<f64>,
) -> Option<Measure> {
    let longest = columns.iter().copied().reduce(|best, next| if next.length > best.length { next } else { best })?;
    let given = PressCams::of(machine).largest_column;
    let limit = given.unwrap_or(CUSTOMARY);
    let customary = given.is_none().then(|| "the customary limit".to_owned());
    let press = machine.part::<Press>().filter(|_| longest.length > limit);
    let fast_enough = press.and_then(|press| {
        let (slowest, fastest) = (longest.rpm, FASTEST * longest.rpm);
        let enough = root::bracketed(|rpm| beyond(column_at(press, rpm), limit), slowest, fastest, 0.0);
        let found = three_digits_up(enough.ok()?);
        (beyond(column_at(press, found), limit) <= 0.0).then_some(found)
    });
    let remedy = fast_enough.map(|rpm| format!("at {rpm} rpm and more it is within the limit"));
    let note: Vec<String> = customary.into_iter().chain(remedy).collect();
    let measure = CHECK.measure(1e3 * longest.length, Some(1e3 * limit));
    Some(measure.noted((!note.is_empty()).then(|| note.join("; "))))
}

/// How far a column is beyond a limit, m; NaN where there is none.
fn beyond(column: Option<f64>, limit: f64) -> f64 {
    column.map_or(f64::NAN, |column| column - limit)
}
