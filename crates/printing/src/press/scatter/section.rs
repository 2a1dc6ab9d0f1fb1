//! The short section `scatter` in the report of a press cam: residual force of presses with tolerances.

use super::analysis::{bands_of, cam_of};
use super::monte_carlo::{self, LeftInPractice};
use super::report::{BandsReport, UsefulRange};
use super::settings::{self, VariableRange};
use crate::press::machine::PressCams;
use crate::press::report::{IN_PRACTICE, OTHER_SPEEDS};
use camgen_cams::machine::Machine;
use camgen_cams::report::{Fact, Section, shown};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Text, Value, text};
use serde::Serialize;

/// Parameters that are named in words.
const NAMED: usize = 4;

/// Tolerance of the variable v at which a fixed bottom leaves less, for a report that shows four digits of it.
const TOLERANCE: f64 = 1e-6;

/// The section's values.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct CamScatter {
    #[serde(flatten)]
    bands: BandsReport,
    reset: &'static str,
    #[serde(flatten)]
    left: Percentiles,
    useful: UsefulRange,
}

/// P95 of the samples of `camgen scatter`, N; `None` if there are too few, or a sampled press is impossible.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Percentiles {
    p95_as_built_n: Option<f64>,
    p95_reset_n: Option<f64>,
    p95_fixed_bottom_n: Option<f64>,
}

impl From<Option<LeftInPractice>> for Percentiles {
    fn from(left: Option<LeftInPractice>) -> Self {
        Self {
            p95_as_built_n: left.map(|left| left.as_built),
            p95_reset_n: left.map(|left| left.reset),
            p95_fixed_bottom_n: left.map(|left| left.fixed),
        }
    }
}

/// A force in whole newtons.
pub(super) fn whole_newtons(force: f64) -> String {
    shown(force.round())
}

impl Percentiles {
    /// What is left in practice, for a summary; `None` if no press was sampled.
    pub(super) fn fact(&self, rule: &str) -> Option<Text> {
        let (built, reset) = (self.p95_as_built_n?, self.p95_reset_n?);
        let built = text!("below {} in 95 of 100 presses", Value::brief(built, "N"));
        let reset = (rule != "none").then(|| text!("{} with the screw reset", Value::brief(reset, "N")));
        Some(built.and(", ", reset))
    }

    /// The words after the bounds of all bands; empty if no press was sampled.
    pub(super) fn describe(&self, rule: &str) -> String {
        let (Some(built), Some(reset), Some(fixed)) = (self.p95_as_built_n, self.p95_reset_n, self.p95_fixed_bottom_n)
        else {
            return String::new();
        };
        let reset = match rule {
            "none" => String::new(),
            rule => format!(", {} N with the screw reset ({rule})", whole_newtons(reset)),
        };
        format!("; P95 {} N as built{reset}, {} N with a fixed bottom", whole_newtons(built), whole_newtons(fixed))
    }
}

/// The section for a cam that is cut for a speed, rpm; `None` where a band reaches a press that cannot be: `camgen scatter` says
/// why.
#[must_use]
pub fn of_cam(machine: &Machine, rpm: f64) -> Option<Section> {
    let values = values(machine, rpm).ok()?;
    let words = values.describe();
    let practice = values.left.fact(values.reset).map(|text| Fact::new(IN_PRACTICE, text));
    let slower = values.useful.fact().map(|text| Fact::new(OTHER_SPEEDS, text));
    Some(Section::new("scatter", &values).with_words(words).with_facts(practice.into_iter().chain(slower)))
}

fn values(machine: &Machine, rpm: f64) -> Result<CamScatter, Refusal> {
    let (cam, _) = cam_of(machine, rpm)?;
    let PressCams { scatter: sampling, losses, .. } = PressCams::of(machine);
    let least = settings::least_useful(&cam, sampling.rule, TOLERANCE);
    Ok(CamScatter {
        bands: bands_of(&cam, sampling, false)?,
        reset: sampling.rule.word(),
        left: monte_carlo::left_in_practice(&cam, sampling, losses.bed_friction).ok().flatten().into(),
        useful: UsefulRange::new(VariableRange { least, most: None }, rpm, sampling.rule),
    })
}

impl CamScatter {
    fn describe(&self) -> Vec<String> {
        let ranked = self.bands.ranked();
        let named = ranked.iter().take(NAMED).map(|row| {
            format!(
                "a band of {} of {} leaves {} N, {} N with the screw reset to the end",
                row.half_width_words(),
                row.parameter.replace('_', " "),
                whole_newtons(row.residual_n.abs()),
                whole_newtons(row.residual_end_n.abs())
            )
        });
        let together = [
            format!(
                "all bands at once leave {} to {} N{}",
                whole_newtons(self.bands.worst_strong_n),
                whole_newtons(self.bands.worst_weak_n),
                self.left.describe(self.reset)
            ),
            format!("{}; `camgen scatter` reports the rest", self.useful.describe()),
        ];
        named.chain(together).collect()
    }
}
