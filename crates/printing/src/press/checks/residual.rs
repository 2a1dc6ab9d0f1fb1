//! What the cam is for: how much of the bed's inertia the air leaves.

use crate::press::load::{ForceBalanced, USEFUL};
use crate::press::machine::PressCams;
use camgen_cams::check::{AsWritten, Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::report::{Bound, Verdict, shown, to_type};
use camgen_kernel::text::{Length, Text, text};

/// The check.
pub const CHECK: Check = Check {
    name: "residual",
    on: CheckScope::Motion,
    unit: "1",
    about: "The largest residual force, inertia less air, over the largest inertia, with the lift as rolled where an outline was \
            rolled on. It must be below what a buffer with a fixed bottom leaves: otherwise a press without a cam is better; a useful cam stays below \
            half of that.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |inertia − air|/max |inertia|",
        usual: "camgen's own rule: below what a buffer with a fixed bottom leaves; it warns above half of that, and where a plate leaves more in one direction of the bed",
        change: "`transition.kind = \"run-up\"`, `buffer.column = \"matched\"`, a finer --tolerance, or `limits.residual_share`",
    },
};

/// Measure of the residual force of a cam with a force balance: as rolled, or of the motion itself.
#[must_use]
pub fn measure(of: &dyn ForceBalanced, written: &AsWritten<'_>, subject: &Subject<'_>) -> Measure {
    let balance = of.balance();
    let (force, place, along) = if let Some(rolled) = written.rolled {
        (rolled.residual_max_n, rolled.residual_at, None)
    } else {
        let worst = of.residual_of_motion();
        let (place, along) = (subject.at)(&worst);
        (worst.value, place, along)
    };
    let (share, without_cam) = (force / balance.inertia, balance.without_cam / balance.inertia);
    let given = PressCams::of(subject.machine).residual_share;
    let verdict = verdict(share, without_cam, given);
    let note = match verdict {
        _ if !share.is_finite() => Some(hits(of, written)),
        Verdict::Fail | Verdict::Warn => Some(residual_note(of, written, force, given).into()),
        _ => None,
    };
    let measure = CHECK.measure(share, Some(given.unwrap_or(without_cam))).judged(verdict).placed(place);
    let measure = measure.noted(Text::from(along).and("; ", note));
    if written.foreign || given.is_some() { measure } else { with_other_way(of, measure, subject) }
}

/// Whether the share of the inertia that is left is little enough.
fn verdict(share: f64, without_cam: f64, given: Option<f64>) -> Verdict {
    let useful = share <= USEFUL * without_cam;
    match given {
        _ if !share.is_finite() => Verdict::Fail,
        Some(limit) => Verdict::of(share <= limit),
        None if share >= without_cam => Verdict::Fail,
        None if !useful => Verdict::Warn,
        None => Verdict::Pass,
    }
}

/// The residual force with and without the cam, and a remedy.
fn residual_note(of: &dyn ForceBalanced, written: &AsWritten<'_>, force: f64, given: Option<f64>) -> String {
    let balance = of.balance();
    let without = format!("{} N are left, {} N without a cam", shown(force), shown(balance.without_cam));
    let motion = of.residual_of_motion().value;
    let permitted = given.map_or(USEFUL * balance.without_cam, |given| given * balance.inertia);
    if written.rolled.is_none() || written.foreign || motion >= permitted {
        return if balance.mean {
            let longer = of.remedy_of_mean().map_or_else(String::new, |remedy| format!("{remedy} in both; "));
            format!(
                "{without}; balanced in neither direction of the bed; {longer}--balance braking balances one and leaves more in the other"
            )
        } else {
            without
        };
    }
    // The motion itself is better: the rest is what the outline misses.
    format!("{without}; the exact profile leaves {} N, and a finer tolerance comes nearer to it", shown(motion))
}

/// The bottom hits the piston: why, and what keeps them apart.
fn hits(of: &dyn ForceBalanced, written: &AsWritten<'_>) -> Text {
    let astray = written.rolled.is_some_and(|rolled| !(rolled.gap_mm.abs() <= written.tolerance_mm));
    if astray {
        return "the bottom hits the piston with this outline".into();
    }
    let air = of.least_air().map_or(0.0, |air| 1e3 * air.value);
    let hits =
        text!("the bottom hits the piston: the balance leaves {} of air, and the outline may miss it", Length::mm(air));
    match of.as_cut(1e-3 * written.tolerance_mm) {
        Some(fits) => {
            let speed = fits.speed.map(|rpm| format!("at {rpm} rpm and less"));
            let tolerance = format!("with a tolerance of {} um", to_type(1e6 * fits.tolerance));
            let both: Vec<String> = speed.into_iter().chain([tolerance]).collect();
            hits.and("; ", text!("{} it fits", both.join(", or ")))
        }
        None => hits,
    }
}

/// A plate balances in one direction of the bed: in the other more may be left than without a cam.
fn with_other_way(of: &dyn ForceBalanced, measure: Measure, subject: &Subject<'_>) -> Measure {
    let balance = of.balance();
    let Some(back) = of.residual_of_other_direction().filter(|back| back.value >= balance.without_cam) else {
        return measure;
    };
    let way = format!(
        "{} N are left in the other direction of the bed, {} N without a cam",
        shown(back.value),
        shown(balance.without_cam)
    );
    let remedies = of.remedies_of_other_way();
    let remedy = if remedies.is_empty() {
        Text::from("neither friction angle nor efficiency nor a longer roller arm alone brings it below")
    } else {
        text!("{} would bring it below", Text::joined(remedies.into_iter().map(Text::from), " or "))
    };
    let verdict = if measure.verdict == Some(Verdict::Fail) { Verdict::Fail } else { Verdict::Warn };
    let place = if measure.verdict == Some(Verdict::Pass) { (subject.at)(&back).0 } else { measure.place };
    let note = Text::from(measure.note.clone()).and("; ", way).and("; ", remedy);
    measure.judged(verdict).placed(place).noted(note)
}
