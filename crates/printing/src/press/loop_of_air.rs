//! The section of the report on a rotary cam whose press loses: what both directions of the bed leave, and where the port shuts.

use super::buffer::Cylinder;
use super::buffer::crank_law::CrankLaw;
use super::checks::fixed_bottom;
use super::machine::PressCams;
use super::scatter::analysis::lost_in;
use super::scatter::fault::{Fault, FrozenBuffer};
use super::scatter::losses::LossyReversal;
use super::scatter::report::LossReport;
use camgen_cams::check::Measure;
use camgen_cams::machine::Machine;
use camgen_cams::report::{Section, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{Length, Text, text};
use serde::Serialize;

/// The section's values.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct LoopOfAir {
    /// `braking` or `level`.
    balance: &'static str,
    /// How early the port shuts before the reversal.
    #[serde(skip_serializing_if = "Option::is_none")]
    lead_mm: Option<f64>,
    /// What the air leaves on the way back outside the reversal, until the port opens.
    #[serde(skip_serializing_if = "Option::is_none")]
    residual_at_port_n: Option<f64>,
    /// Largest force with which the air pulls at the bottom on the way back: the follower needs at least this preload.
    #[serde(skip_serializing_if = "Option::is_none")]
    pull_n: Option<f64>,
    #[serde(flatten)]
    losses: LossReport,
}

/// The check of both directions; `None` where the machine file gives no losses.
pub(super) fn measure(machine: &Machine, cylinder: &Cylinder, law: &CrankLaw) -> Option<Measure> {
    let lost = lost_in(&reversal(machine, cylinder, law)?);
    Some(fixed_bottom::with_losses(lost.residual_n(), lost.residual_fixed_bottom_n()?))
}

/// The reversal with the losses of the machine file; `None` where it gives none.
pub(super) fn reversal(machine: &Machine, cylinder: &Cylinder, law: &CrankLaw) -> Option<LossyReversal> {
    let losses = PressCams::of(machine).losses;
    let cam = losses.is_any().then(|| FrozenBuffer::of_law(law, cylinder))?;
    LossyReversal::new(&cam, &Fault::none(law.exponent()), &losses).ok()
}

/// The section for a cam with this law; `None` where the machine file gives no losses.
pub(super) fn section(machine: &Machine, cylinder: &Cylinder, law: &CrankLaw) -> Option<Section> {
    let reversal = reversal(machine, cylinder, law)?;
    let air = law.of_yoke().and_then(|law| law.level.as_ref());
    let at_port = air.map(|air| cylinder.unit_force() * (1.0 - air.pressures(1.0)[1]));
    let values = LoopOfAir {
        balance: if air.is_some() { "level" } else { "braking" },
        lead_mm: air.map(|_| MILLIMETRES * law.lead()),
        residual_at_port_n: at_port,
        pull_n: at_port.map(|pull| pull.max(0.0)),
        losses: lost_in(&reversal),
    };
    let words = values.describe();
    Some(Section::new("losses", &values).with_words(words))
}

impl LoopOfAir {
    fn describe(&self) -> Vec<Text> {
        let port = self.lead_mm.zip(self.residual_at_port_n).map(|(lead, left)| {
            text!("half of the loop is left in each direction (buffer.balance); the port shuts {} before the reversal, and until it opens again \
                 the air pulls with up to {} N, which takes a preload or a valve that lets air in", Length::mm(lead), shown(left))
        });
        self.losses.describe().into_iter().chain(port).collect()
    }
}
