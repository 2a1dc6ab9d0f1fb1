//! The short section `scatter` in the report of a cam of a press: what is left of its balance in practice, without draws.

use super::analysis::{bands_of, cam_of};
use super::propagation::{self, Estimate};
use super::report::{BandsReport, UsefulRange};
use super::settings;
use crate::domains::press::machine::PressCams;
use crate::machine::Machine;
use crate::refusal::Refusal;
use crate::report::{Section, shown};
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
    /// To first order.
    p95_as_built_n: f64,
    p95_reset_n: f64,
    p95_fixed_bottom_n: f64,
    useful: UsefulRange,
}

/// The section for a cam that is cut for a speed, rpm; `None` where a band reaches a press that cannot be: `camgen scatter` says
/// why.
#[must_use]
pub fn of_cam(machine: &Machine, rpm: f64) -> Option<Section> {
    let values = values(machine, rpm).ok()?;
    let words = values.words();
    Some(Section::new("scatter", &values).with_words(words))
}

fn values(machine: &Machine, rpm: f64) -> Result<CamScatter, Refusal> {
    let (cam, _) = cam_of(machine, rpm)?;
    let sampling = PressCams::of(machine).scatter;
    let Estimate { as_built, reset, fixed } = propagation::estimate(&cam, &sampling.half_widths, sampling.distribution);
    Ok(CamScatter {
        bands: bands_of(&cam, &sampling, false)?,
        p95_as_built_n: as_built,
        p95_reset_n: reset,
        p95_fixed_bottom_n: fixed,
        useful: UsefulRange::of([settings::least_useful(&cam, TOLERANCE)?, None], rpm),
    })
}

impl CamScatter {
    fn words(&self) -> Vec<String> {
        let ranked = self.bands.ranked();
        let named = ranked.iter().take(NAMED).map(|row| {
            format!(
                "a band of {} of {} leaves {} N, {} N with the screw reset",
                row.half_width_words(),
                row.parameter.replace('_', " "),
                shown(row.residual_n.abs().round()),
                shown(row.residual_end_n.abs().round())
            )
        });
        let named: Vec<String> = named.collect();
        let rounded = |force: f64| shown(force.round());
        let together = [
            format!(
                "all bands at once leave {} to {} N; P95 about {} N as built, {} N with the screw reset, {} N with a fixed bottom",
                rounded(self.bands.worst_strong_n),
                rounded(self.bands.worst_weak_n),
                rounded(self.p95_as_built_n),
                rounded(self.p95_reset_n),
                rounded(self.p95_fixed_bottom_n)
            ),
            format!("{}; `camgen scatter` reports the rest", self.useful.words()),
        ];
        named.into_iter().chain(together).collect()
    }
}
