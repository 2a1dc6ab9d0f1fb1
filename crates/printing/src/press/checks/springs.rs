//! The springs under the bottoms: whether they withstand their force, can be coiled, follow the crank and stand.

use camgen_cams::check::{Check, CheckExplanation, Measure};
use camgen_cams::report::{Bound, Verdict};

/// Whether a spring under a bottom withstands its force.
pub const STRESS: Check = Check::on_analysis(
    "spring_stress",
    "MPa",
    "The largest shear stress in the wire of the springs under the bottoms, at the end of the stroke.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "8 F D K/(π d³), K = (4i − 1)/(4i − 4) + 0.615/i (Wahl), i = D/d, F = P_max/2",
        usual: "`spring_buffer.body.stress`: the allowable stress of the wire is an input",
        change: "a thicker `spring_buffer.body.wire`, a smaller `spring_buffer.body.coil`, or leave both out: `spring_buffer.body.index` finds the wire",
    },
);

/// The coils that give way.
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

/// The thickness of the wire.
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

/// The index of the coils.
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

/// Whether a spring follows the motion of its bottom without surging.
pub const SURGE: Check = Check::on_analysis(
    "surge",
    "1",
    "The first natural frequency of the springs under the bottoms over that of the crank.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "d/(2π n D²) √(G/(2ρ)) for ends on plates, over the frequency of the crank at the fastest speed",
        usual: "15: the critical frequency is 15 to 20 times that of the force (Shigley's Mechanical Engineering Design, 9th ed., §10–8)",
        change: "a smaller `spring_buffer.body.index`, a higher `spring_buffer.body.stress`, or softer springs",
    },
);

/// Least ratio of the frequencies.
pub const LEAST_SURGE: f64 = 15.0;

/// Whether a spring buckles between its plates.
pub const BUCKLING: Check = Check::on_analysis(
    "buckling",
    "1",
    "The largest deflection of the springs under the bottoms over that at which they buckle; 0 where they never do. A guide in or around the coils keeps them straight too.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "y/(L0 C1 [1 − √(1 − C2 (2 D/L0)²)]), C1 = E/(2 (E − G)), C2 = 2π² (E − G)/(2 G + E), the ends on parallel plates, L0 = (n + 2) d + 1.15 y",
        usual: "1, beyond which it warns: a guide holds the spring (Shigley's Mechanical Engineering Design, 9th ed., §10–5; EN 13906-1)",
        change: "a larger `spring_buffer.body.index`, a stiffer spring, or a guide, with which the check does not matter",
    },
);

/// Whether springs can be coiled: fewest coils, thickest wire (mm), smallest index.
#[must_use]
pub fn of_coils(coils: f64, wire: f64, index: f64) -> [Measure; 3] {
    const ROUNDING: f64 = 1e-12;
    let index = INDEX.measure(index, Some(4.0)).judged(if index >= 4.0 * (1.0 - ROUNDING) {
        Verdict::Pass
    } else {
        Verdict::Warn
    });
    [COILS.measure(coils, Some(2.0)), WIRE.measure(wire, Some(100.0)), index]
}

/// Whether springs buckle, by the largest share of their deflection.
#[must_use]
pub fn of_buckling(share: f64) -> Measure {
    let keeps = share <= 1.0;
    let note = (!keeps).then_some("give the spring a guide in its coils or around them");
    BUCKLING.measure(share, Some(1.0)).judged(if keeps { Verdict::Pass } else { Verdict::Warn }).noted(note)
}
