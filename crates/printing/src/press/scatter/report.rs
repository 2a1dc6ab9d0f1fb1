//! The section `scatter` of a report.

use super::propagation::ParameterBand;
use super::reset::ScrewRule;
use super::settings::VariableRange;
use super::tables::{ParameterRow, PercentileRow, SettingRow};
use crate::press::report::{CylinderMeasures, OTHER_SPEEDS};
use camgen_cams::report::ReportLine;
use camgen_cams::report::{Fact, Section, SummaryColumn, SummaryTable, Topic, length_cell, number_cell, shown};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::text::{Length, LengthKind, Text, Value, text};
use serde::Serialize;

/// One machine that differs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct FaultReport {
    /// v = M/π.
    pub v: f64,
    /// Of largest size, signed.
    pub residual_n: f64,
    pub residual_at_mm: f64,
    pub residual_at_end_n: f64,
    pub end_pressure_pa: f64,
    /// ΔL of the rules, from the column of the cam; the screw is turned by `screw_end_mm`, from where it is.
    pub column_end_mm: f64,
    pub screw_end_mm: f64,
    /// For all cylinders.
    pub added_volume_end_mm3: f64,
    pub added_volume_end_each_mm3: f64,
    pub residual_end_n: f64,
    pub residual_end_at_mm: f64,
    pub column_level_mm: f64,
    pub screw_level_mm: f64,
    pub residual_level_n: f64,
    /// ΔL and Δe of screw and port together, what they are changed by, and what they leave.
    pub column_with_port_mm: f64,
    pub lead_with_port_mm: f64,
    pub screw_with_port_mm: f64,
    pub port_mm: f64,
    pub residual_with_port_n: f64,
}

/// Residual forces of a reversal with losses, and where they are largest.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct LossReport {
    pub residual_in_n: f64,
    pub residual_in_at_mm: f64,
    pub residual_back_n: f64,
    pub residual_back_at_mm: f64,
    /// What fixed bottoms leave in the same losses, their column by (7).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_in_fixed_bottom_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_back_fixed_bottom_n: Option<f64>,
    /// Half of what the way back leaves more.
    pub half_loop_n: f64,
    pub half_loop_at_mm: f64,
    /// In a reversal.
    pub work_lost_j: f64,
    /// Share of the air at its end.
    pub air_left: f64,
}

impl LossReport {
    /// What fixed bottoms leave in the same losses in the worse direction, N, at least 0.
    #[must_use]
    pub fn residual_fixed_bottom_n(&self) -> Option<f64> {
        let both = self.residual_in_fixed_bottom_n.zip(self.residual_back_fixed_bottom_n);
        both.map(|(on_way_in, back)| on_way_in.abs().max(back.abs()))
    }

    /// What is left in the worse direction, N, at least 0.
    #[must_use]
    pub fn residual_n(&self) -> f64 {
        self.residual_in_n.abs().max(self.residual_back_n.abs())
    }

    /// The values in words.
    #[must_use]
    pub fn describe(&self) -> Vec<Text> {
        let fixed = self.residual_in_fixed_bottom_n.zip(self.residual_back_fixed_bottom_n).map(|(on_way_in, back)| {
            text!("a fixed bottom with these losses: {} N on the way in, {} N back", shown(on_way_in), shown(back))
        });
        let cam = [
            text!(
                "with its losses {} N at x = {} on the way in, {} N at x = {} back",
                shown(self.residual_in_n),
                Length::mm(self.residual_in_at_mm),
                shown(self.residual_back_n),
                Length::mm(self.residual_back_at_mm)
            ),
            text!(
                "half of the loop {} N at x = {}, which neither cam nor screw takes out; the air loses {} J in a reversal, which bed and camshaft give; {} % of the air is still in the cylinder at its end",
                shown(self.half_loop_n),
                Length::mm(self.half_loop_at_mm),
                shown(self.work_lost_j),
                shown(100.0 * self.air_left)
            ),
        ];
        cam.into_iter().chain(fixed).collect()
    }
}

/// The range in which the cam has less residual force than a fixed bottom, each reset by the same rule.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct UsefulRange {
    pub reset: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub v_min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rpm_min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub v_max: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rpm_max: Option<f64>,
}

impl UsefulRange {
    /// For the bounds of v of a cam that is cut for a speed, rpm.
    #[must_use]
    pub fn new(range: VariableRange, rpm: f64, rule: ScrewRule) -> Self {
        let [rpm_min, rpm_max] = [range.least, range.most].map(|v| v.map(|v| rpm * libm::sqrt(v)));
        Self { reset: rule.word(), v_min: range.least, rpm_min, v_max: range.most, rpm_max }
    }

    /// Whether v is outside the range.
    pub(super) fn excludes(&self, v: f64) -> bool {
        self.v_min.is_some_and(|least| v < least) || self.v_max.is_some_and(|most| v > most)
    }

    /// Where a fixed bottom leaves less than the cam, for a summary; `None` where it does so at no speed.
    #[must_use]
    pub fn fact(&self) -> Option<Text> {
        let bounds = [self.rpm_min.map(|rpm| ("below", rpm)), self.rpm_max.map(|rpm| ("above", rpm))];
        let bounds = bounds.into_iter().flatten().map(|(side, rpm)| text!("{} {}", side, Value::brief(rpm, "rpm")));
        let bounds = Text::joined(bounds, " and ");
        (!bounds.is_empty()).then(|| text!("{} a fixed bottom leaves less: camgen regimes", bounds))
    }

    /// A sentence.
    #[must_use]
    pub fn describe(&self) -> String {
        let bounds = [self.v_min.zip(self.rpm_min), self.v_max.zip(self.rpm_max)];
        let [least, most] = bounds.map(|bound| bound.map(|(v, rpm)| format!("v = {v:.2} ({rpm:.1} rpm)")));
        let rule = format!("than the cam, the screws of both reset by the rule {}", self.reset);
        match (least, most) {
            (Some(least), Some(most)) => {
                format!("below {least} and above {most} a fixed bottom has less residual force {rule}")
            }
            (Some(least), None) => format!("below {least} a fixed bottom has less residual force {rule}"),
            (None, Some(most)) => format!("above {most} a fixed bottom has less residual force {rule}"),
            (None, None) => format!("at no speed a fixed bottom has less residual force {rule}"),
        }
    }
}

/// Share of the variance below which a band is not in a summary.
const SMALL_SHARE: f64 = 0.01;

/// Residual force with all parameters varying: each alone, the worst cases, the deviation.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct BandsReport {
    pub parameters: Vec<ParameterRow>,
    pub worst_weak_n: f64,
    pub worst_weak_at_mm: f64,
    pub worst_strong_n: f64,
    pub worst_strong_at_mm: f64,
    pub linear_bound_n: f64,
    /// Standard deviation at the end of the stroke as built, to first order.
    pub sigma_n: f64,
}

impl BandsReport {
    /// The rows of the parameters, that which leaves most as built first.
    #[must_use]
    pub fn ranked(&self) -> Vec<&ParameterRow> {
        let mut ranked: Vec<&ParameterRow> = self.parameters.iter().collect();
        ranked.sort_by(|a, b| {
            let [a, b] = [a, b].map(|row| row.residual_n.abs().max(row.residual_end_n.abs() * 1e-9));
            b.total_cmp(&a)
        });
        ranked
    }

    /// The parameters in words, that which leaves most as built first.
    #[must_use]
    pub fn describe(&self) -> Vec<ReportLine> {
        let mut lines = vec![ReportLine::row(format!(
            "{:<20} {:>10} {:>11} {:>10} {:>10} {:>10} {:>10}",
            "band of", "half width", "as built/N", "screw/mm", "then/N", "level/N", "variance/%"
        ))];
        lines.extend(self.ranked().into_iter().map(|row| {
            ReportLine::row(format!(
                "{:<20} {:>10} {:>11.2} {:>10.3} {:>10.2} {:>10.2} {:>10.2}",
                row.parameter,
                row.half_width_words(),
                row.residual_n,
                row.column_end_mm,
                row.residual_end_n.abs(),
                row.residual_level_n.unwrap_or(f64::NAN),
                100.0 * row.share_of_variance
            ))
        }));
        lines.push(
            text!(
                "all at once as built: {} to {} N, standard deviation {} N",
                shown(self.worst_strong_n),
                shown(self.worst_weak_n),
                shown(self.sigma_n)
            )
            .into(),
        );
        lines
    }
}

/// The rows of bands.
#[must_use]
pub fn rows(bands: &[ParameterBand]) -> Vec<ParameterRow> {
    bands.iter().map(ParameterRow::from).collect()
}

/// The section of the analysis.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ScatterReport<'a> {
    pub cam_rpm: f64,
    pub column_length_mm: f64,
    #[serde(flatten)]
    pub cylinders: CylinderMeasures,
    pub reset: &'static str,
    pub distribution: &'static str,
    pub samples: u32,
    pub seed: u64,
    pub residual_fixed_bottom_max_n: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<FaultReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub losses: Option<LossReport>,
    #[serde(flatten)]
    pub bands: BandsReport,
    pub percentiles: &'a [PercentileRow],
    pub useful: UsefulRange,
    pub settings: &'a [SettingRow],
}

impl ScatterReport<'_> {
    /// The section.
    #[must_use]
    pub fn section(&self) -> Section {
        let mut words: Vec<ReportLine> = vec![
            text!(
                "cam for {} rpm, column {}, {}; a fixed bottom leaves {} N",
                shown(self.cam_rpm),
                Length::mm(self.column_length_mm),
                self.cylinders.bore_words(),
                shown(self.residual_fixed_bottom_max_n)
            )
            .into(),
        ];
        words.extend(self.fault.iter().flat_map(FaultReport::describe).map(ReportLine::from));
        words.extend(self.losses.iter().flat_map(LossReport::describe).map(ReportLine::from));
        words.extend(self.bands.describe());
        words.extend(self.drawn().into_iter().map(ReportLine::from));
        words.push(self.useful.describe().into());
        words.push(text!("settings by the rule {}:", self.reset).into());
        words.push(ReportLine::row(format!(
            "{:>6} {:>9} {:>10} {:>12} {:>12} {:>9} {:>11} {:>9}",
            "v", "rpm", "column/mm", "V each/cm³", "V all/cm³", "left/N", "fixed/mm", "left/N"
        )));
        words.extend(self.settings.iter().filter(|row| (20.0 * row.v).round() % 2.0 == 0.0).map(|row| {
            ReportLine::row(format!(
                "{:>6} {:>9.3} {:>10.2} {:>12.0} {:>12.0} {:>9.1} {:>11.2} {:>9.1}",
                shown(row.v),
                row.rpm,
                row.column_mm,
                1e-3 * row.added_volume_each_mm3,
                1e-3 * row.added_volume_mm3,
                row.residual_n,
                row.fixed_column_mm,
                row.fixed_residual_n
            ))
        }));
        Section::new("scatter", self)
            .with_words(words)
            .with_answer(self.answer())
            .with_facts(self.facts())
            .with_table(self.table())
    }

    /// The percentile of a body in a state: "cam" or "fixed-bottom", reset by a rule or "none".
    fn percentile_95(&self, body: &str, reset: &str) -> Option<f64> {
        let found =
            self.percentiles.iter().find(|row| row.body == body && row.reset == reset && row.percentile == 95.0);
        found.map(|row| row.residual_n)
    }

    fn answer(&self) -> Text {
        match self.percentile_95("cam", self.reset).or_else(|| self.percentile_95("cam", "none")) {
            Some(left) if self.reset != "none" => {
                text!("reset the screw: 95 of 100 presses leave less than {}", Value::brief(left, "N"))
            }
            Some(left) => text!("95 of 100 presses leave less than {} as built", Value::brief(left, "N")),
            None => text!("all bands at once leave up to {}", Value::brief(self.worst(), "N")),
        }
    }

    fn worst(&self) -> f64 {
        self.bands.worst_weak_n.abs().max(self.bands.worst_strong_n.abs())
    }

    fn facts(&self) -> Vec<Fact> {
        let left = |body: &str, reset: &str, words: &'static str| {
            self.percentile_95(body, reset).map(|force| text!("{} {}", words, Value::brief(force, "N")))
        };
        let reset = (self.reset != "none").then(|| left("cam", self.reset, "screw reset")).flatten();
        let fixed = left("fixed-bottom", self.reset, "fixed bottom");
        let all = [left("cam", "none", "below, as built:"), reset, fixed].into_iter().flatten();
        let of_95 = Text::joined(all, ", ");
        let mut facts = Vec::new();
        if !of_95.is_empty() {
            facts.push(Fact::new(Topic::new(10, "95 of 100"), of_95));
        }
        let drawn = text!(
            "{} presses drawn, {}, seed {}; rule \"{}\" for the screw (--reset)",
            self.samples,
            self.distribution,
            self.seed,
            self.reset
        );
        facts.push(Fact::new(Topic::new(20, "drawn"), drawn));
        facts.extend(self.useful.fact().map(|text| Fact::new(OTHER_SPEEDS, text)));
        facts
    }

    /// The bands one by one.
    fn table(&self) -> SummaryTable {
        let row = |row: &&ParameterRow| {
            vec![
                Text::from(row.parameter.replace('_', " ")),
                Text::from(row.half_width_words()),
                number_cell(row.residual_n.abs()),
                number_cell(row.residual_end_n.abs()),
                length_cell(row.column_end_mm),
                number_cell(100.0 * row.share_of_variance),
            ]
        };
        let ranked = self.bands.ranked();
        let is_small = |row: &&ParameterRow| row.share_of_variance < SMALL_SHARE;
        let small: Vec<&str> = ranked.iter().filter(|row| is_small(row)).map(|row| row.parameter).collect();
        let rest = (!small.is_empty()).then(|| text!("below 1 % each: {} (-v)", small.join(", ").replace('_', " ")));
        SummaryTable {
            heads: vec![
                SummaryColumn::words("one band alone"),
                SummaryColumn::numbers("±", ""),
                SummaryColumn::numbers("as built", "N"),
                SummaryColumn::numbers("reset", "N"),
                SummaryColumn::lengths("screw", &LengthKind::MM),
                SummaryColumn::numbers("share", "% of σ²"),
            ],
            rows: ranked.iter().filter(|row| !is_small(row)).map(row).collect(),
            marked: None,
            rest,
        }
    }

    /// The percentiles in words.
    fn drawn(&self) -> Vec<Text> {
        if self.percentiles.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![text!("{} presses drawn, {}, seed {}", self.samples, self.distribution, self.seed)];
        for row in self.percentiles {
            let body = row.body.replace('-', " ");
            let state = match row.reset {
                "none" => "as built".to_owned(),
                rule => format!("reset to {rule}"),
            };
            lines.push(text!(
                "P{} of a {}, {}: {} N ({} to {})",
                format_args!("{:.0}", row.percentile),
                body,
                state,
                shown(row.residual_n),
                shown(row.low_n),
                shown(row.high_n)
            ));
        }
        lines
    }
}

impl FaultReport {
    fn describe(&self) -> Vec<Text> {
        vec![
            text!(
                "this machine leaves {} N at x = {}, {} N at the end of the stroke; v = {}",
                shown(self.residual_n),
                Length::mm(self.residual_at_mm),
                shown(self.residual_at_end_n),
                shown(self.v)
            ),
            text!(
                "turn the screw by {} and {} N are left, by {} (level) {} N; the screw by {} and the port by {}: {} N",
                Length::mm(self.screw_end_mm).signed(3),
                shown(self.residual_end_n.abs()),
                Length::mm(self.screw_level_mm).signed(3),
                shown(self.residual_level_n.abs()),
                Length::mm(self.screw_with_port_mm).signed(3),
                Length::mm(self.port_mm).signed(3),
                shown(self.residual_with_port_n.abs())
            ),
        ]
    }
}
