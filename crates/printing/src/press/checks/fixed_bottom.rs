//! Whether a cam leaves less residual force than a fixed bottom: at other speeds, in presses that lose, in presses that scatter, and at a setting.

use crate::press::load::USEFUL;
use crate::press::scatter::reset::ScrewRule;
use crate::press::scatter::settings::VariableRange;
use crate::press::scatter::tables::{CAM, FIXED, PercentileRow};
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure};
use camgen_cams::report::{Bound, Verdict, shown};
use camgen_kernel::document::NamedChoice;

/// At every speed of `camgen regimes`, both with their columns reset.
pub const FIXED_BOTTOM: Check = Check::on_analysis(
    "fixed_bottom",
    "1",
    "Largest residual force of the cam / that of a fixed bottom, at another speed and with both columns reset by `--reset`. Above 1 the press runs \
     more smoothly without a cam at that speed.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "|P − P_am| of the cam / |P − P_am| of a fixed bottom with its own column; the largest over the speeds",
        usual: "camgen's own rule: 1; it warns above",
        change: "a cam that is cut for a speed nearer to this one (--cut-for), a three-dimensional cam, or a fixed bottom",
    },
);

/// What a cam leaves in a press that loses, against a fixed bottom in the same press.
pub const LOSSES: Check = Check {
    name: "losses",
    on: CheckScope::Cam,
    unit: "1",
    about: "What is left with the losses of the machine file, in the worse direction of the bed, over what a fixed bottom leaves with the same losses.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |r| of both ways with expansion, leak, friction, train and play, over that of a fixed bottom with its column by (7) and no train",
        usual: "camgen's own rule: below 1, from where on a press without a cam is better; it warns above ½",
        change: "a stiffer `cam.train_stiffness` or `cam.compensate_train = true`, less `cam.play`, `buffer.balance = \"level\"` against the expansion, less leak or friction",
    },
};

/// What neither cam nor screw can cure: the force that differs between the ways in and back.
pub const HALF_LOOP: Check = Check::on_analysis(
    "half_loop",
    "1",
    "Half of the largest difference of the residual forces on the ways in and back, over what a buffer with a fixed bottom leaves with the same losses: expansion of the air, leak \
     and friction leave it whatever the cam is.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |r_back − r_in|/2 at the same overrun, over the largest residual force of a fixed bottom with the same losses",
        usual: "camgen's own rule: below 1; it warns above ½",
        change: "less leak or friction (`buffer.leak`, `buffer.piston_friction`, `bed.friction`); against the loop of the expansion a smaller bore: a higher `buffer.end_pressure`",
    },
);

/// Whether a cam is worth its steel in presses that scatter.
pub const SCATTER: Check = Check::on_analysis(
    "scatter",
    "1",
    "What 95 % of all presses stay below after the reset of their screws, over what 95 % of presses with a fixed bottom stay below: what the cam \
     has to beat.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "P95 of the largest residual force of the cam over that of a fixed bottom in the same draws",
        usual: "camgen's own rule: below 1; it warns above ½",
        change: "narrower bands of what is largest in the list (`[scatter]`, --vary), a reset of the screw (--reset end), or no cam",
    },
);

/// Whether a cam leaves less at the forme, the speed and the weather of a machine.
pub const SETTING: Check = Check::on_analysis(
    "setting",
    "1",
    "The one variable v of forme, speed and weather, against the range in which the cam has less residual force than a fixed bottom, each with its \
     screw reset by `--reset`.",
    CheckExplanation {
        bound: Bound::AtLeast,
        formula: "v = (n/n_c)² (m/m_c)/(p0'/p0); at the limit both have the same residual force after `--reset`",
        usual: "camgen's own rule: v within that range",
        change: "a cam that is cut for a speed nearer to this one (--rpm), or a fixed bottom",
    },
);

/// Residual forces at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rivals {
    /// Speed of the main shaft.
    pub rpm: f64,
    /// Of the cam, N.
    pub cam: f64,
    /// Of the fixed bottom, N.
    pub fixed: f64,
}

impl Rivals {
    fn share(&self) -> f64 {
        self.cam / self.fixed
    }
}

/// The measure of [`FIXED_BOTTOM`] over all speeds.
#[must_use]
pub fn over_speeds(speeds: &[Rivals]) -> Measure {
    let largest = speeds.iter().map(Rivals::share).fold(0.0, f64::max);
    let worse: Vec<String> = speeds
        .iter()
        .filter(|at| at.share() > 1.0)
        .map(|at| format!("at {} rpm {} N instead of {} N", shown(at.rpm), shown(at.fixed), shown(at.cam)))
        .collect();
    let verdict = if worse.is_empty() { Verdict::Pass } else { Verdict::Warn };
    let note = format!("a fixed bottom with its own reset has less residual force: {}", worse.join(", "));
    FIXED_BOTTOM.measure(largest, Some(1.0)).judged(verdict).noted((!worse.is_empty()).then_some(note))
}

/// The measure of [`LOSSES`]: the largest force with the cam and with fixed bottoms, N.
#[must_use]
pub fn with_losses(cam: f64, fixed: f64) -> Measure {
    let share = cam / fixed;
    let note = format!("{} N are left, {} N with a fixed bottom", shown(cam), shown(fixed));
    judged(&LOSSES, share, note)
}

/// The measure of [`HALF_LOOP`]: the largest half of the difference, and what a fixed bottom leaves in the same losses, N.
#[must_use]
pub fn half_of_loop(half_loop: f64, fixed: f64) -> Measure {
    let share = half_loop.abs() / fixed;
    let note = format!(
        "half of the loop is {} N, a fixed bottom with the same losses leaves {} N",
        shown(half_loop.abs()),
        shown(fixed)
    );
    judged(&HALF_LOOP, share, note)
}

/// The measure of [`SCATTER`] by the percentiles.
#[must_use]
pub fn over_draws(percentiles: &[PercentileRow]) -> Measure {
    let [cam, fixed] =
        [CAM, FIXED].map(|body| percentiles.iter().rev().find(|row| row.body == body && row.percentile == 95.0));
    let (Some(cam), Some(fixed)) = (cam, fixed) else {
        return SCATTER.unknown("no presses are drawn (--samples 0), or too few: P95 needs 20");
    };
    let share = cam.residual_n / fixed.residual_n;
    let note = format!("P95 is {} N, that of a fixed bottom {} N", shown(cam.residual_n), shown(fixed.residual_n));
    judged(&SCATTER, share, note)
}

/// The measure of [`SETTING`]: v against the bounds of its useful range, by a reset rule.
#[must_use]
pub fn at_setting(variable: f64, useful: VariableRange, rule: ScrewRule) -> Measure {
    let VariableRange { least, most } = useful;
    let fixed = format!("a fixed bottom with its own reset ({}) leaves less", rule.word());
    if let Some(most) = most.filter(|most| variable > *most) {
        let note = format!("above v = {} {fixed}", shown(most));
        return SETTING.measure(variable, least).kept(false).noted(note);
    }
    let below = least.filter(|least| variable < *least);
    let note = below.map(|least| format!("below v = {} {fixed}", shown(least)));
    SETTING.measure(variable, least).kept(below.is_none()).noted(note)
}

/// A share of what a fixed bottom leaves: from 1 on a press without a cam is better, and above ½ a cam is hardly worth it.
fn judged(check: &'static Check, share: f64, note: String) -> Measure {
    let verdict = match share {
        share if !(share < 1.0) => Verdict::Fail,
        share if share > USEFUL => Verdict::Warn,
        _ => Verdict::Pass,
    };
    check.measure(share, Some(1.0)).judged(verdict).noted(note)
}
