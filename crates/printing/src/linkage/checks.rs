//! What a linkage that moves a bed must keep.

use camgen_cams::check::{Check, CheckExplanation};
use camgen_cams::report::Bound;

/// The check.
pub const GRASHOF: Check = Check::on_analysis(
    "grashof",
    "1",
    "The margin of the worst of the inequalities by which both cranks of a drag link turn fully, in driving cranks.",
    CheckExplanation {
        bound: Bound::Above,
        formula: "the least of 1 − λ1, 1 − λ1 − |λ2 − λ3| and λ2 + λ3 − 1 − λ1",
        usual: "0: at 0 the link is stretched out and may turn over",
        change: "a shorter `linkage.base_ratio`, or coupler and follower nearer to each other",
    },
);

/// The check.
pub const LINK_RATIO: Check = Check::on_analysis(
    "link_ratio",
    "1",
    "The shorter of coupler and driven crank of the drag link over its driving crank; short links carry large forces.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "min(λ2, λ3); the base λ1 is meant to be small",
        usual: "0.5: shorter links carry more than the force of the bed",
        change: "a longer `linkage.coupler_ratio` or `linkage.follower_ratio`",
    },
);

/// The check.
pub const TRANSMISSION_ANGLE: Check = Check::on_analysis(
    "transmission_angle",
    "deg",
    "The least angle between coupler and driven crank of the drag link, at most 90°; the nearer to 0 the less of the force turns.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "cos μ = (λ2² + λ3² − d²)/(2 λ2 λ3) at d = 1 − λ1 and d = 1 + λ1, folded below 90°",
        usual: "45°; 40° for smooth loads",
        change: "a shorter `linkage.base_ratio`, or λ2 = √(1 + λ1² − λ3²), which deviates equally to both sides of 90°",
    },
);

/// The check.
pub const ROD_ANGLE: Check = Check::on_analysis(
    "rod_angle",
    "deg",
    "The largest angle of the connecting rod from the line of the slider; it presses the bed sideways.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "asin((1 + |λ6|)/λ5)",
        usual: "30°: a rod of two cranks",
        change: "a longer `linkage.rod_ratio`, or a smaller `linkage.offset_ratio`",
    },
);

/// The check.
pub const DEAD_POINTS: Check = Check::on_analysis(
    "dead_points",
    "deg",
    "The angle of the driving crank from the outer dead point of the bed to the inner one.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "sin β = λ6/(λ5 + 1) outer, β = 180° + asin(λ6/(λ5 − 1)) inner, taken back through the drag link",
        usual: "none; 180° takes as long out as back",
        change: "`linkage.follower_angle` and `linkage.offset_ratio` move it",
    },
);

/// The check.
pub const REVERSALS: Check = Check::on_analysis(
    "reversals",
    "1",
    "How often the acceleration of the bed changes its sign in a turn. A buffer at either end takes one reversal of the force each.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "the zeros of the second derivative, found between its extremes",
        usual: "2: one reversal at each end",
        change: "a longer `linkage.rod_ratio`, or a shorter `linkage.base_ratio`",
    },
);
