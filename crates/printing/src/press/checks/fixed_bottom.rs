//! Check that the cam has less residual force than a fixed bottom at every speed of `camgen regimes`.

use camgen_cams::check::{Check, CheckExplanation, Measure};
use camgen_cams::report::{Bound, Verdict, shown};

/// The check.
pub const CHECK: Check = Check::on_analysis(
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

/// The measure over all speeds.
#[must_use]
pub fn measure(speeds: &[Rivals]) -> Measure {
    let largest = speeds.iter().map(Rivals::share).fold(0.0, f64::max);
    let worse: Vec<String> = speeds
        .iter()
        .filter(|at| at.share() > 1.0)
        .map(|at| format!("at {} rpm {} N instead of {} N", shown(at.rpm), shown(at.fixed), shown(at.cam)))
        .collect();
    let verdict = if worse.is_empty() { Verdict::Pass } else { Verdict::Warn };
    let note = format!("a fixed bottom with its own reset has less residual force: {}", worse.join(", "));
    CHECK.measure(largest, Some(1.0)).judged(verdict).noted((!worse.is_empty()).then_some(note))
}
