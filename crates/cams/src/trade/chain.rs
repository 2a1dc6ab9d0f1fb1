//! What is left of the balance of the whole machine, from the law to presses that differ: the outline is one link of it.

use super::measure::TradeRow;
use crate::report::shown;
use camgen_kernel::text::{Length, LengthKind, Text, text};
use serde::Serialize;

/// What a part of the machine leaves of the balance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOver {
    /// The part: `law`, `outline`, `shaft`, `scatter`.
    pub part: &'static str,
    /// Largest force that it leaves, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_n: Option<f64>,
    /// Largest error of the acceleration that it leaves, m/s², where the speed is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration_m_per_s2: Option<f64>,
    /// Largest error of the torque of the camshaft that it leaves, N·m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_nm: Option<f64>,
    /// What it is, in words.
    pub about: String,
}

impl LeftOver {
    /// A part that leaves a force, N.
    #[must_use]
    pub fn of_force(part: &'static str, residual_n: f64, about: impl Into<String>) -> Self {
        let about = about.into();
        Self { part, residual_n: Some(residual_n), acceleration_m_per_s2: None, torque_nm: None, about }
    }

    pub(super) fn words(&self) -> Text {
        let figures = [
            self.residual_n.map(|force| text!("{} N", shown(force))),
            self.acceleration_m_per_s2.map(|error| text!("{}", Length::new(error, &LengthKind::M_PER_S2))),
            self.torque_nm.map(|error| text!("{} N·m", shown(error))),
        ];
        let figures = Text::joined(figures.into_iter().flatten(), ", ");
        text!("{} {}: {}", format_args!("{:<8}", self.part), figures, &self.about)
    }
}

/// The parts in their order, the outline of the advised setting among them.
pub(super) fn left_over(chosen: Option<&TradeRow>, others: &[LeftOver]) -> Vec<LeftOver> {
    let outline = chosen.map(|row| LeftOver {
        part: "outline",
        residual_n: Some(row.residual_n).filter(|force| *force > 0.0),
        acceleration_m_per_s2: row.acceleration_error_m_per_s2,
        torque_nm: row.torque_error_nm,
        about: format!("force by its distance, acceleration by its curvature, torque by its heading ({})", row.setting),
    });
    let (law, rest): (Vec<&LeftOver>, Vec<&LeftOver>) = others.iter().partition(|other| other.part == "law");
    law.into_iter().cloned().chain(outline).chain(rest.into_iter().cloned()).collect()
}

/// Where another part leaves more force than the outline, that; a finer outline would not help there.
pub(super) fn not_the_outline(chain: &[LeftOver]) -> Option<String> {
    let forces = chain.iter().map(|part| (part, part.residual_n.unwrap_or(0.0)));
    let (_, of_outline) = forces.clone().find(|(part, _)| part.part == "outline")?;
    let others = forces.filter(|(part, _)| part.part != "outline");
    let (largest, force) = others.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    (force > of_outline).then(|| {
        format!(
            "the outline is not what limits: the part `{}` leaves {} N, and no finer outline changes that",
            largest.part,
            shown(force)
        )
    })
}
