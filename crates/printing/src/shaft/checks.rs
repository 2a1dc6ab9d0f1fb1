//! What a shaft under a cam must keep.

use camgen_cams::check::{Check, CheckExplanation};
use camgen_cams::report::Bound;

/// The check.
pub const CRITICAL_SPEED: Check = Check::on_analysis(
    "critical_speed",
    "1",
    "The speed of the shaft over its first critical speed, at which unbalance bends it without bound.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "n/n_1, 1/ω_1² the largest eigenvalue of Birger's equation as one of forces (shaft, discs and cam; supports elastic)",
        usual: "0.7: below it the shaft is rigid enough to be balanced as a rigid one",
        change: "a thicker shaft, supports nearer to the cam, or a lower speed",
    },
);

/// The check.
pub const LIFT_ERROR: Check = Check::on_analysis(
    "lift_error",
    "mm",
    "How far the follower is below its law while shaft and supports bend and twist under its force.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "Δs = Φ(Δs) [C (1 + tan² α) + s'²/k_t], C the compliance at the cam, k_t the torsional stiffness from drive to cam",
        usual: "none; without a limit it is only reported. A cam is cut to 5 µm",
        change: "a thicker shaft (C falls with the fourth power of its diameter), stiffer supports, the drive nearer to the cam",
    },
);

/// The check.
pub const SUPPORT_SLOPE: Check = Check::on_analysis(
    "support_slope",
    "rad",
    "The largest slope of the shaft in one of its bearings under the largest force of the cam.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the slope at each support under 1 N at the cam, times the largest Φ/cos α",
        usual: "0.001 rad for deep-groove ball bearings, 0.0005 rad for cylindrical roller bearings",
        change: "a thicker shaft, supports nearer to the cam, or self-aligning bearings",
    },
);

/// The check.
pub const UNBALANCE: Check = Check::on_analysis(
    "unbalance",
    "g mm",
    "The unbalance of all that turns with the shaft, as vectors; of the cam after the holes that balance it.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "U = |Σ U_i|, permissible U_per = G m/ω (ISO 21940-11), for a rigid rotor",
        usual: "G 16 for drive shafts, G 6.3 for general machinery; without a grade it is only reported",
        change: "`cam.balance`, a weight opposite to it, or a lower speed",
    },
);
