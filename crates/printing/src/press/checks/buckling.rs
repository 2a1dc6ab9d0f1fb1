//! Whether a spring buckles between its plates.

use camgen_cams::check::{Check, CheckExplanation, Measure};
use camgen_cams::report::{Bound, Verdict};

/// The check.
pub const CHECK: Check = Check::on_analysis(
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

/// The measure of the largest share.
#[must_use]
pub fn measure(share: f64) -> Measure {
    let keeps = share <= 1.0;
    let note = (!keeps).then_some("give the spring a guide in its coils or around them");
    CHECK
        .measure(share, Some(1.0))
        .judged(if keeps { Verdict::Pass } else { Verdict::Warn })
        .noted(note.map(str::to_owned))
}
