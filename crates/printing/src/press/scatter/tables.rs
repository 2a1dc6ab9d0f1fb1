//! The tables of the scatter of a press.

use super::bed_path::BedPath;
use super::error::ScatterError;
use super::fault::{FrozenBuffer, STEPS};
use super::losses::LossyReversal;
use super::monte_carlo::{Samples, has_percentile, percentile};
use super::parameter::{HalfWidths, Parameter};
use super::propagation::{Corners, ParameterBand};
use super::reset::ScrewRule;
use super::settings::{FixedBottom, Setting};
use crate::press::buffer::Cylinder;
use crate::press::columns::CUBIC;
use camgen_cams::analysis::Listing;
use camgen_cams::report::shown;
use camgen_cams::table::{ListedColumn, Table, WordColumn};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::MILLIMETRES;
use serde::Serialize;
use std::f64::consts::PI;

/// What a parameter leaves.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ParameterRow {
    pub parameter: &'static str,
    pub half_width: f64,
    pub unit: &'static str,
    /// h S.
    pub sensitivity_n: f64,
    pub residual_n: f64,
    pub residual_at_mm: f64,
    /// ΔL.
    pub column_end_mm: f64,
    pub residual_end_n: f64,
    pub residual_end_at_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column_level_mm: Option<f64>,
    /// Its size: the largest and the least force are equal and opposite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_level_n: Option<f64>,
    pub share_of_variance: f64,
}

impl ParameterRow {
    /// The half width as a person would type it.
    #[must_use]
    pub fn half_width_words(&self) -> String {
        match self.unit {
            "1" if self.parameter == Parameter::Exponent.name() => shown(self.half_width),
            "1" => format!("{} %", shown(100.0 * self.half_width)),
            unit => format!("{} {unit}", shown(self.half_width)),
        }
    }
}

impl From<&ParameterBand> for ParameterRow {
    fn from(band: &ParameterBand) -> Self {
        let (unit, per_si) = band.parameter.unit().shown();
        Self {
            parameter: band.parameter.name(),
            half_width: band.half_width * per_si,
            unit,
            sensitivity_n: band.sensitivity,
            residual_n: band.residual.value,
            residual_at_mm: MILLIMETRES * band.residual.at,
            column_end_mm: MILLIMETRES * band.end.0,
            residual_end_n: band.end.1.value,
            residual_end_at_mm: MILLIMETRES * band.end.1.at,
            column_level_mm: band.level.map(|(column, _)| MILLIMETRES * column),
            residual_level_n: band.level.map(|(_, left)| left.value.abs()),
            share_of_variance: band.share_of_variance,
        }
    }
}

const PARAMETERS: &[ListedColumn<ParameterRow>] = &[
    ("half_width", |row| row.half_width),
    ("sensitivity_n", |row| row.sensitivity_n),
    ("residual_n", |row| row.residual_n),
    ("residual_at_mm", |row| row.residual_at_mm),
    ("column_end_mm", |row| row.column_end_mm),
    ("residual_end_n", |row| row.residual_end_n),
    ("residual_end_at_mm", |row| row.residual_end_at_mm),
    ("column_level_mm", |row| row.column_level_mm.unwrap_or(f64::NAN)),
    ("residual_level_n", |row| row.residual_level_n.unwrap_or(f64::NAN)),
    ("share_of_variance", |row| row.share_of_variance),
];

/// The table of the parameters.
#[must_use]
pub fn of_parameters(rows: &[ParameterRow]) -> Listing {
    let words = Some(("parameter", rows.iter().map(|row| row.parameter.to_owned()).collect()));
    let units = rows.iter().map(|row| row.unit.to_owned()).collect();
    let more_words = vec![WordColumn { name: "unit", before: "sensitivity_n", words: units }];
    ("", Table { words, more_words, ..Table::listed(PARAMETERS, rows) })
}

/// What a share of all presses stays below.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct PercentileRow {
    pub body: &'static str,
    pub reset: &'static str,
    pub percentile: f64,
    pub residual_n: f64,
    /// The 95 % interval of the percentile.
    pub low_n: f64,
    pub high_n: f64,
}

const PERCENTILES: &[ListedColumn<PercentileRow>] = &[
    ("percentile", |row| row.percentile),
    ("residual_n", |row| row.residual_n),
    ("low_n", |row| row.low_n),
    ("high_n", |row| row.high_n),
];

/// The bodies that are compared.
pub const CAM: &str = "cam";
/// See [`CAM`].
pub const FIXED: &str = "fixed-bottom";

/// The percentiles of drawn presses.
#[must_use]
pub fn percentiles(samples: &Samples, rule: ScrewRule) -> Vec<PercentileRow> {
    let of_fixed = if rule == ScrewRule::None { "none" } else { "end" };
    let mut lists = vec![(CAM, "none", &samples.as_built)];
    if rule != ScrewRule::None {
        lists.push((CAM, rule.word(), &samples.reset));
    }
    lists.push((FIXED, of_fixed, &samples.fixed));
    let rows = lists.into_iter().flat_map(|(body, reset, sorted)| {
        [50.0, 95.0, 99.0].into_iter().filter_map(move |share| {
            if !has_percentile(sorted.len(), share / 100.0) {
                return None;
            }
            let [residual_n, low_n, high_n] = percentile(sorted, share / 100.0)?;
            Some(PercentileRow { body, reset, percentile: share, residual_n, low_n, high_n })
        })
    });
    rows.collect()
}

/// The table of the percentiles.
#[must_use]
pub fn of_percentiles(rows: &[PercentileRow]) -> Listing {
    let words = Some(("body", rows.iter().map(|row| row.body.to_owned()).collect()));
    let resets = rows.iter().map(|row| row.reset.to_owned()).collect();
    let more_words = vec![WordColumn { name: "reset", before: "percentile", words: resets }];
    ("-percentiles", Table { words, more_words, ..Table::listed(PERCENTILES, rows) })
}

/// A setting of the screw.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct SettingRow {
    pub v: f64,
    pub rpm: f64,
    /// L.
    pub column_mm: f64,
    /// For all cylinders.
    pub added_volume_mm3: f64,
    pub residual_n: f64,
    pub residual_at_mm: f64,
    pub fixed_column_mm: f64,
    pub fixed_residual_n: f64,
    pub added_volume_each_mm3: f64,
}

const SETTINGS: &[ListedColumn<SettingRow>] = &[
    ("v", |row| row.v),
    ("rpm", |row| row.rpm),
    ("column_mm", |row| row.column_mm),
    ("added_volume_mm3", |row| row.added_volume_mm3),
    ("residual_n", |row| row.residual_n),
    ("residual_at_mm", |row| row.residual_at_mm),
    ("fixed_column_mm", |row| row.fixed_column_mm),
    ("fixed_residual_n", |row| row.fixed_residual_n),
    ("added_volume_each_mm3", |row| row.added_volume_each_mm3),
];

/// Variables of the table: 0.2, 0.25 … 1.3.
fn variables() -> impl Iterator<Item = f64> {
    (4..=26).map(|twentieths| f64::from(twentieths) / 20.0)
}

/// The settings by a rule for the values of v; `rpm` is the main-shaft speed for which the cam was cut.
///
/// # Errors
/// When no column balances an end.
pub fn settings(
    cam: &FrozenBuffer,
    cylinder: &Cylinder,
    rpm: f64,
    rule: ScrewRule,
) -> Result<Vec<SettingRow>, ScatterError> {
    let fixed = FixedBottom::new(cam);
    variables().map(|variable| Ok(row_of(&fixed.setting(variable, rule)?, cam, cylinder, rpm))).collect()
}

fn row_of(setting: &Setting, cam: &FrozenBuffer, cylinder: &Cylinder, rpm: f64) -> SettingRow {
    SettingRow {
        v: setting.variable,
        rpm: rpm * libm::sqrt(setting.variable),
        column_mm: MILLIMETRES * (cam.column + setting.column),
        added_volume_mm3: CUBIC * cylinder.volume(setting.column),
        residual_n: setting.residual.value.abs(),
        residual_at_mm: MILLIMETRES * setting.residual.at,
        fixed_column_mm: MILLIMETRES * setting.fixed_column,
        fixed_residual_n: setting.fixed_residual,
        added_volume_each_mm3: CUBIC * cylinder.piston_area * setting.column,
    }
}

/// The table of the settings, with their rule.
#[must_use]
pub fn of_settings(rows: &[SettingRow], rule: ScrewRule) -> Listing {
    let words = rows.iter().map(|_| rule.word().to_owned()).collect();
    let more_words = vec![WordColumn { name: "reset", before: "added_volume_each_mm3", words }];
    ("-settings", Table { more_words, ..Table::listed(SETTINGS, rows) })
}

/// One crank angle of the reversal.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceRow {
    /// Crank angle from the start of the reversal, rad.
    pub angle: f64,
    /// The bed is on its way back.
    pub back: bool,
    /// Overrun, m.
    pub x: f64,
    /// Residual force of the true machine: the mean of both ways, N.
    pub mean: f64,
    /// Half of what it is larger on the way back, N.
    pub half_loop: f64,
    /// Largest and least force of the bands, N.
    pub weak: f64,
    /// See `weak`.
    pub strong: f64,
    /// h r_i of every parameter, N.
    pub effects: [f64; Parameter::ALL.len()],
}

const CURVES: &[ListedColumn<PlaceRow>] = &[
    ("x_mm", |row| MILLIMETRES * row.x),
    ("mean_n", |row| row.mean),
    ("half_loop_n", |row| row.half_loop),
    ("weak_n", |row| row.weak),
    ("strong_n", |row| row.strong),
    ("polytropic_exponent_n", |row| row.effects[0]),
    ("ambient_pressure_n", |row| row.effects[1]),
    ("mass_n", |row| row.effects[2]),
    ("speed_n", |row| row.effects[3]),
    ("column_n", |row| row.effects[4]),
    ("lead_n", |row| row.effects[5]),
    ("air_lost_n", |row| row.effects[6]),
    ("closing_pressure_n", |row| row.effects[7]),
    ("phase_n", |row| row.effects[8]),
    ("screw_n", |row| row.effects[9]),
    ("crank_deg", |row| row.angle.to_degrees()),
];

/// The whole reversal, every half degree of the crank.
#[must_use]
pub fn places(cam: &FrozenBuffer, reversal: &LossyReversal, half_widths: &HalfWidths) -> Vec<PlaceRow> {
    let corners = Corners::new(cam, half_widths);
    let mut rows = Vec::new();
    for step in 0..=2 * STEPS {
        let angle = 0.5 * cam.path.whole() * f64::from(step) / f64::from(STEPS);
        let back = angle > cam.path.dead();
        let (braking, way) = match cam.path {
            BedPath::Yoke { .. } if back => (PI - angle, -1.0),
            _ => (angle, 1.0),
        };
        let [strong, weak] = corners.extremes_at(cam, braking);
        let [mean, half_loop] = reversal.mean_and_half_loop(if back { cam.path.outgoing(angle) } else { angle });
        let mut effects = [0.0; Parameter::ALL.len()];
        for ((effect, parameter), half_width) in effects.iter_mut().zip(Parameter::ALL).zip(half_widths) {
            let sign = if parameter == Parameter::Phase { way } else { 1.0 };
            *effect = sign * half_width * parameter.first_order(cam, braking);
        }
        let x = cam.path.overrun_at(braking);
        rows.push(PlaceRow { angle, back, x, mean, half_loop, weak, strong, effects });
    }
    rows
}

/// The table of the reversal, in the order of the crank.
#[must_use]
pub fn of_places(rows: &[PlaceRow]) -> Listing {
    let ways = rows.iter().map(|row| if row.back { "back" } else { "in" }.to_owned()).collect();
    let more_words = vec![WordColumn { name: "way", before: "mean_n", words: ways }];
    ("-curves", Table { more_words, ..Table::listed(CURVES, rows) })
}
