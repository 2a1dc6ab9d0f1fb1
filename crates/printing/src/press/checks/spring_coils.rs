//! Whether a spring can be coiled: its coils, its wire and its index.

use camgen_cams::check::{Check, CheckExplanation, Measure};
use camgen_cams::report::{Bound, Verdict};

/// Coils that give way.
pub const COILS: Check = Check::on_analysis(
    "spring_coils",
    "1",
    "The smallest number of active coils of the springs under the bottoms: of those that give way.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "n = G d/(8 c i³), c the stiffness of a spring",
        usual: "2 (EN 13906-1: its formulas hold from there on)",
        change: "a smaller `spring_buffer.body.index`, a thicker wire or a lower `spring_buffer.body.stress`, or softer springs",
    },
);

/// Thickness of the wire.
pub const WIRE: Check = Check::on_analysis(
    "spring_wire",
    "mm",
    "The thickest wire of the springs under the bottoms.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "d = √(8 F i K/(π stress)), or that of the machine file",
        usual: "100 mm: no thicker bar is coiled to a spring",
        change: "a higher `spring_buffer.body.stress`, a smaller `spring_buffer.body.index`, or several springs for each bottom",
    },
);

/// Index of the coils.
pub const INDEX: Check = Check::on_analysis(
    "spring_index",
    "1",
    "The smallest index of the springs under the bottoms: mean diameter of the coils over that of the wire.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "i = D/d",
        usual: "4, below which it warns: tighter coils crack when they are coiled (EN 13906-1: 4 to 20)",
        change: "a larger `spring_buffer.body.index`, or a larger `spring_buffer.body.coil`",
    },
);

/// The measures of the springs of a call: fewest coils, thickest wire (mm), smallest index.
#[must_use]
pub fn measures(coils: f64, wire: f64, index: f64) -> [Measure; 3] {
    const ROUNDING: f64 = 1e-12;
    let index = INDEX.measure(index, Some(4.0)).judged(if index >= 4.0 * (1.0 - ROUNDING) {
        Verdict::Pass
    } else {
        Verdict::Warn
    });
    [COILS.measure(coils, Some(2.0)), WIRE.measure(wire, Some(100.0)), index]
}
