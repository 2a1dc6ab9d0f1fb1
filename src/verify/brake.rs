//! What a belt brake must keep, and the tension that its disc holds as cut.

use super::{Bound, Check, Evidence, Explained, On};
use crate::analysis::brake;
use crate::geometry::MILLIMETRES;
use crate::report::{Finding, Verdict, shown};

pub(super) const TENSION: Check = Check {
    name: brake::TENSION,
    on: On::Motion,
    about: "By how much the web tension changes from the full roll to the roll run down, over the largest; with a disc on the frame's \
            shaft as cut, on the outline as written.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "(P_max − P_min)/P_max, P = (G h1 + i F s')/(q_t + (q_t + q_s)/ε1), ε1 = e^(af) − 1; F s' of a disc as cut",
        usual: "0.05; the paper regulates 15 % of the starting slip away",
        change: "a disc on the frame's shaft (`[brake.cam]`, --cam), a frame that keeps wrap and arms (--synthesize), a finer \
                 tolerance of the disc",
    },
    run: tension_as_cut,
};

pub(super) const SELF_LOCKING: Check = Check::on_analysis(
    brake::SELF_LOCKING,
    "The friction over that at which the brake jams: there friction alone presses the belt on, and the web tears.",
    Explained {
        bound: Bound::AtMost,
        formula: "f/f_lock, f_lock = ln(−q_s/q_t)/a where the tight span's arm q_t is negative, the largest over the roll; else 0",
        usual: "0.667: friction may rise by half",
        change: "`brake.rotation`, or a pivot on the other side of the tight span",
    },
);

pub(super) const BELT_RANGE: Check = Check::on_analysis(
    brake::BELT_RANGE,
    "The least speed of the belt over that of the web that equation (9) asks for: below 0 it would have to run backwards.",
    Explained {
        bound: Bound::AtLeast,
        formula: "V_z/V = 1 − P/(K N), N = G h1/h2 (printed model only: in truth the speed of a slipping belt regulates nothing)",
        usual: "0 to 1 at both ends of the roll",
        change: "`brake.belt_speed_ratio`, `brake.weight`, or model = \"consistent\"",
    },
);

pub(super) const GRIP: Check = Check::on_analysis(
    brake::GRIP,
    "What a belt without slip could hold over the wanted tension, where that is least over the roll.",
    Explained {
        bound: Bound::AtLeast,
        formula: "P_slip/P_n, P_slip = G h1/(q_t + (q_t + q_s)/ε1), ε1 = e^(af) − 1",
        usual: "1.5 (`brake.grip`)",
        change: "`brake.weight`; the note tells the one that keeps it",
    },
);

pub(super) const WEB_STRESS: Check = Check::on_analysis(
    brake::WEB_STRESS,
    "The largest stress in the web over the roll.",
    Explained {
        bound: Bound::AtMost,
        formula: "σ = P/(δ b)",
        usual: "none; without a limit it is told",
        change: "`brake.tension`, or a tension that changes less",
    },
);

pub(super) const FRAME_REACH: Check = Check::on_analysis(
    brake::FRAME_REACH,
    "The radius down to which the frame would follow the roll; a file whose frame does not reach its smallest radius is refused.",
    Explained {
        bound: Bound::AtMost,
        formula: "the radius at which a pulley meets the roll, the frame comes to a dead point or jams, or its weight lifts",
        usual: "the smallest radius of the roll",
        change: "what the note says; mostly pulleys further out, or another pivot",
    },
);

fn tension_as_cut(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let holding = body.brake_disc()?.holding();
    let limit = body.machine().limits.brake.tension_spread;
    let rolled = evidence.rolled?;
    let Some(cut) = &rolled.tension else {
        let note = Some("the follower leaves this outline: no tension is known".into());
        return Some(Finding { note, ..TENSION.found(f64::NAN, Some(limit), "1", Verdict::Fail) });
    };
    let ([at_least, least], [at_largest, largest], wanted) = (cut.least, cut.largest, holding.tension());
    let worst = if largest - wanted > wanted - least { at_largest } else { at_least };
    let note = format!(
        "as cut {least:.4} N at {} mm of the roll, {largest:.4} N at {} mm",
        shown(MILLIMETRES * at_least),
        shown(MILLIMETRES * at_largest)
    );
    let spread = (largest - least) / largest;
    let found = TENSION.found(spread, Some(limit), "1", Verdict::of(spread <= limit));
    let place = holding.angle_at(worst).map_or(found.place, |angle| body.place(angle));
    Some(Finding { place, note: Some(note), ..found })
}
