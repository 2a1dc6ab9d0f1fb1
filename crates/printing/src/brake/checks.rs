//! The checks of a belt brake, and the tension that its disc holds as cut.

use super::BrakeDisc;
use super::tension::{as_cut, is_mirrored};
use camgen_cams::check::{AsWritten, Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::report::Bound;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Length, text};

/// The check.
pub const TENSION: Check = Check {
    name: "tension",
    on: CheckScope::Motion,
    unit: "1",
    about: "Change of the web tension from the full roll to the run-down roll, as a share of the largest tension; with a disc on the \
            frame's shaft, that of the outline as written.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "(P_max − P_min)/P_max, P = (G h1 + i F s')/(q_t + (q_t + q_s)/ε1), ε1 = e^(af) − 1; F s' of a disc as cut",
        usual: "0.05; in the paper regulation compensates 15 % of the starting slip",
        change: "a disc on the frame's shaft (`[brake.cam]`, --cam), a frame that keeps wrap and arms (--synthesize), a finer \
                 tolerance of the disc",
    },
};

/// The check.
pub const SELF_LOCKING: Check = Check::on_analysis(
    "self_locking",
    "1",
    "The friction coefficient, divided by that at which the brake jams: there friction alone presses the belt on, and the web tears.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "f/f_lock, f_lock = ln(−q_s/q_t)/a where the tight span's arm q_t is negative, the largest over the roll; else 0",
        usual: "0.667: friction may rise by half",
        change: "`brake.rotation`, or a pivot on the other side of the tight span",
    },
);

/// The check.
pub const BELT_RANGE: Check = Check::on_analysis(
    "belt_range",
    "1",
    "The smallest belt speed, divided by the web speed, that equation (9) requires: below 0 the belt would have to run backwards.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "V_z/V = 1 − P/(K N), N = G h1/h2 (printed model only: in fact the speed of a slipping belt regulates nothing)",
        usual: "0 to 1 at both ends of the roll",
        change: "`brake.belt_speed_ratio`, `brake.weight`, or model = \"consistent\"",
    },
);

/// The check.
pub const GRIP: Check = Check::on_analysis(
    "grip",
    "1",
    "The tension that a belt without slip can hold, divided by the wanted tension, at the radius where this is smallest.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "P_slip/P_n, P_slip = G h1/(q_t + (q_t + q_s)/ε1), ε1 = e^(af) − 1",
        usual: "1.5 (`brake.grip`)",
        change: "`brake.weight`; the note gives the weight that would pass",
    },
);

/// The check.
pub const WEB_STRESS: Check = Check::on_analysis(
    "web_stress",
    "MPa",
    "The largest stress in the web over the roll.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "σ = P/(δ b)",
        usual: "none; without a limit the stress is only reported",
        change: "`brake.tension`, or a tension that changes less",
    },
);

/// The check.
pub const FRAME_REACH: Check = Check::on_analysis(
    "frame_reach",
    "mm",
    "The radius down to which the frame would follow the roll; a file whose frame does not reach its smallest radius is refused.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the radius at which a pulley meets the roll, the frame comes to a dead point or jams, or the weight lifts the belt",
        usual: "the smallest radius of the roll",
        change: "the change that the note names; mostly pulleys further out, or another pivot",
    },
);

/// The change of the tension that a disc holds as cut, against its limit; `None` where nothing was rolled.
#[must_use]
pub fn tension_as_cut(
    disc: &BrakeDisc,
    spread: f64,
    written: &AsWritten<'_>,
    subject: &Subject<'_>,
) -> Option<Measure> {
    written.rolled?;
    let mirrored = is_mirrored(subject.machine);
    let (holding, limit) = (disc.holding(), Some(spread));
    let Some(cut) = subject
        .curves
        .zip(written.outlines.first())
        .and_then(|(curves, outline)| as_cut(disc, curves, mirrored, outline))
    else {
        let note = "the follower leaves this outline: the tension is not known".to_owned();
        return Some(TENSION.measure(f64::NAN, limit).noted(note));
    };
    let (least, largest, wanted) = (cut.least.tension, cut.largest.tension, holding.tension());
    let worst = if largest - wanted > wanted - least { cut.largest.radius } else { cut.least.radius };
    let note = text!(
        "as cut {} N at {} of the roll, {} N at {}",
        format_args!("{:.3}", least),
        Length::mm(MILLIMETRES * cut.least.radius),
        format_args!("{:.3}", largest),
        Length::mm(MILLIMETRES * cut.largest.radius)
    );
    let measure = TENSION.measure((largest - least) / largest, limit).noted(note);
    let place = match holding.angle_at(worst) {
        Ok(angle) => (subject.at)(&Worst { value: measure.value, at: angle, z: 0.0 }).0,
        Err(_) => measure.place,
    };
    Some(measure.placed(place))
}
