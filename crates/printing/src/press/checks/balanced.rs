//! The checks of every disc that balances the inertia force of the bed by the air.

use super::{air, column, residual, run_up};
use crate::press::load::ForceBalanced;
use camgen_cams::check::{Measures, Subject};

/// The measures of a force balance.
pub(in crate::press) fn of_balance(balanced: &dyn ForceBalanced, of: &mut Measures<'_>, subject: &Subject<'_>) {
    of.add(&residual::CHECK, |written| residual::measure(balanced, written, subject));
    of.add(&air::CHECK, |_| balanced.least_air().map(|least| air::measure(&least, subject)));
    of.add(&column::CHECK, |_| {
        column::measure(&balanced.columns(), subject.machine, |press, rpm| Some(press.rotary_law(rpm).ok()?.column()))
    });
    of.add(&run_up::CHECK, |_| balanced.run_up().map(|run_up| run_up::measure(&run_up)));
}
