//! Whether a cam leaves less than a fixed bottom at the forme, the speed and the weather of a machine.

use crate::press::scatter::reset::ScrewRule;
use crate::press::scatter::settings::VariableRange;
use camgen_cams::check::{Check, CheckExplanation, Measure};
use camgen_cams::report::{Bound, shown};
use camgen_kernel::document::NamedChoice;

/// The check.
pub const CHECK: Check = Check::on_analysis(
    "setting",
    "1",
    "The one variable v of forme, speed and weather, against the range in which the cam has less residual force than a fixed bottom, each with its \
     screw reset by `--reset`.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "v = (n/n_c)² (m/m_c)/(p0'/p0); at the limit both have the same residual force after `--reset`",
        usual: "camgen's own rule: v within that range",
        change: "a cam that is cut for a speed nearer to this one (--rpm), or a fixed bottom",
    },
);

/// The measure of v against the bounds of its useful range, by a reset rule.
#[must_use]
pub fn measure(variable: f64, useful: VariableRange, rule: ScrewRule) -> Measure {
    let VariableRange { least, most } = useful;
    let fixed = format!("a fixed bottom with its own reset ({}) leaves less", rule.word());
    if let Some(most) = most.filter(|most| variable > *most) {
        let note = format!("above v = {} {fixed}", shown(most));
        return CHECK.measure(variable, least).kept(false).noted(note);
    }
    let below = least.filter(|least| variable < *least);
    let note = below.map(|least| format!("below v = {} {fixed}", shown(least)));
    CHECK.measure(variable, least).kept(below.is_none()).noted(note)
}
