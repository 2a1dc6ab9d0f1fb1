//! What the cam is for: how much of the bed's inertia the air leaves.

use super::{Bound, Check, Evidence, Explained, On};
use crate::body::{Balance, USEFUL};
use crate::profile::Worst;
use crate::report::{Finding, Place, Verdict, shown};

pub(super) const CHECK: Check = Check {
    name: "residual",
    on: On::Motion,
    about: "The largest residual force, inertia less air, over the largest inertia, with the lift as rolled where an outline was \
            rolled on. It must be below what a buffer with a fixed bottom leaves, or no cam is better; a useful cam stays below \
            half of that.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max |inertia − air|/max |inertia|",
        usual: "camgen's own rule: below what a buffer with a fixed bottom leaves; it warns above half of that",
        change: "`transition.kind = \"run-up\"`, `buffer.column = \"matched\"`, a finer --tolerance, or `limits.residual_share`",
    },
    run: check,
};

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let balance = body.balance()?;
    let (force, place, z) = if let Some(rolled) = evidence.rolled {
        (rolled.residual_max_n, rolled.residual_at, 0.0)
    } else {
        let Worst { value, at, z } = body.residual_of_motion();
        (value, body.place(at), z)
    };
    let (share, without_cam) = (force / balance.inertia, balance.without_cam / balance.inertia);
    let given = body.machine().limits.residual_share;
    let verdict = match given {
        _ if !share.is_finite() => Verdict::Fail,
        Some(limit) => Verdict::of(share <= limit),
        None if balance.mean => {
            if share > USEFUL * without_cam {
                Verdict::Warn
            } else {
                Verdict::Pass
            }
        }
        None if share >= without_cam => Verdict::Fail,
        None if share > USEFUL * without_cam => Verdict::Warn,
        None => Verdict::Pass,
    };
    let found = CHECK.found(share, Some(given.unwrap_or(without_cam)), "1", verdict);
    let note = match verdict {
        _ if !share.is_finite() => Some(hits(evidence)),
        Verdict::Fail | Verdict::Warn => Some(left(evidence, force, balance)),
        _ => None,
    };
    let finding =
        Finding { place, note: joined(body.along_axis(z).filter(|_| evidence.rolled.is_none()), note), ..found };
    Some(with_way_back(evidence, finding, balance))
}

fn joined(first: Option<String>, second: Option<String>) -> Option<String> {
    let words: Vec<String> = first.into_iter().chain(second).collect();
    (!words.is_empty()).then(|| words.join("; "))
}

/// How much is left, and with what.
fn left(evidence: &Evidence<'_>, force: f64, balance: Balance) -> String {
    let without = format!("{} N are left, {} N without a cam", shown(force), shown(balance.without_cam));
    let body = evidence.body;
    let motion = body.residual_of_motion().value;
    if evidence.rolled.is_none() || evidence.foreign.is_some() || motion >= USEFUL * balance.without_cam {
        return if balance.mean { format!("{without}; balanced in neither direction of the bed") } else { without };
    }
    // The motion itself is better: the rest is what the outline misses.
    format!("{without}; the exact profile leaves {} N, and a finer tolerance comes nearer to it", shown(motion))
}

/// The bottom hits the piston: why, and what keeps them apart.
fn hits(evidence: &Evidence<'_>) -> String {
    let body = evidence.body;
    let astray = evidence.rolled.is_some_and(|rolled| !(rolled.gap_mm.abs() <= evidence.tolerance_mm));
    if astray {
        return "the bottom hits the piston with this outline".into();
    }
    let air = body.least_air().map_or(0.0, |air| 1e3 * air.value);
    let hits =
        format!("the bottom hits the piston: the balance leaves {} mm of air, and the outline may miss it", shown(air));
    match body.as_cut(1e-3 * evidence.tolerance_mm) {
        Some(fits) => {
            let speed = fits.speed.map(|rpm| format!("at {rpm} rpm and less"));
            let tolerance = format!("with a tolerance of {} um", shown(1e6 * fits.tolerance));
            let both: Vec<String> = speed.into_iter().chain([tolerance]).collect();
            format!("{hits}; {} it fits", both.join(", or "))
        }
        None => hits,
    }
}

/// A plate balances in one direction of the bed: in the other more may be left than without a cam.
fn with_way_back(evidence: &Evidence<'_>, finding: Finding, balance: Balance) -> Finding {
    let body = evidence.body;
    if evidence.foreign.is_some() || body.machine().limits.residual_share.is_some() {
        return finding;
    }
    let Some(back) = body.residual_unbalanced_way().filter(|back| back.value >= balance.without_cam) else {
        return finding;
    };
    let way = format!(
        "{} N are left in the other direction of the bed, {} N without a cam",
        shown(back.value),
        shown(balance.without_cam)
    );
    let remedies = body.remedies_unbalanced_way();
    let remedy = if remedies.is_empty() {
        "neither friction angle nor efficiency nor a longer roller arm alone brings it below".to_owned()
    } else {
        format!("{} would bring it below", remedies.join(" or "))
    };
    let verdict = if finding.verdict == Verdict::Fail { Verdict::Fail } else { Verdict::Warn };
    let place = if finding.verdict == Verdict::Pass { body.place(back.at) } else { finding.place };
    let note = joined(finding.note, Some(format!("{way}; {remedy}")));
    Finding { verdict, place: Place { ..place }, note, ..finding }
}
