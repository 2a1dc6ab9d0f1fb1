//! Whether a spring follows the motion of its bottom without surging.

use camgen_cams::check::{Check, CheckExplanation};
use camgen_cams::report::Bound;

/// The check.
pub const CHECK: Check = Check::on_analysis(
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

/// Least ratio.
pub const LEAST: f64 = 15.0;
