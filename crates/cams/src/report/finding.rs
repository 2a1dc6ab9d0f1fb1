//! The result of a check, and where.

use super::figures::shown;
use camgen_kernel::units::LengthUnit;
use serde::ser::Serializer;
use serde::{Deserialize, Deserializer, Serialize};
use std::borrow::Cow;

/// The verdict of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Verdict {
    /// The limit is kept.
    Pass,
    /// The limit is broken.
    Fail,
    /// No limit is broken, but whoever cuts this cam should know this first.
    Warn,
    /// There is no limit.
    Info,
}

impl Verdict {
    /// Pass or fail.
    #[must_use]
    pub fn of(kept: bool) -> Self {
        if kept { Verdict::Pass } else { Verdict::Fail }
    }

    /// As reports and sheets write it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "FAIL",
            Verdict::Warn => "WARN",
            Verdict::Info => "info",
        }
    }

    /// Its order in a report: failures first, then warnings, then the rest.
    #[must_use]
    pub fn rank(self) -> u8 {
        match self {
            Verdict::Fail => 0,
            Verdict::Warn => 1,
            Verdict::Pass | Verdict::Info => 2,
        }
    }
}

/// On which side of its limit a value must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// The limit is the largest value.
    AtMost,
    /// The limit is the smallest value.
    AtLeast,
    /// The value is larger than the limit.
    Above,
    /// The value is the limit.
    Exactly,
}

impl Bound {
    /// As reports write it before the limit.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Bound::AtMost => "at most",
            Bound::AtLeast => "at least",
            Bound::Above => "above",
            Bound::Exactly => "exactly",
        }
    }
}

/// A place on a cam, as in reports.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Place {
    /// Cam angle, degrees in [0, 360).
    pub cam_deg: Option<f64>,
    /// Overrun of the bed, or travel of a plate, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_mm: Option<f64>,
}

impl Place {
    /// At a cam angle in rad.
    #[must_use]
    pub fn at_angle(angle: f64) -> Self {
        Self { cam_deg: Some(degrees(angle)), x_mm: None }
    }

    /// At an overrun, or a travel, in m.
    #[must_use]
    pub fn at_overrun(x: f64) -> Self {
        Self { cam_deg: None, x_mm: Some(1e3 * x + 0.0) }
    }
}

/// A cam angle (rad) in degrees in [0, 360).
#[must_use]
pub fn degrees(angle: f64) -> f64 {
    let degrees = angle.to_degrees() % 360.0;
    let positive = if degrees < 0.0 { degrees + 360.0 } else { degrees };
    // A hair below zero rounds up to a whole turn.
    if positive >= 360.0 { 0.0 } else { positive + 0.0 }
}

impl Place {
    /// As a person reads it, a travel in this unit.
    #[must_use]
    pub fn words(&self, units: LengthUnit) -> String {
        match (self.cam_deg, self.x_mm) {
            (None, Some(x)) if units == LengthUnit::Inch => format!("x = {:.4} in", units.of_mm(x)),
            _ => self.to_string(),
        }
    }
}

/// In degrees or millimetres, as a person reads it.
impl std::fmt::Display for Place {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.cam_deg, self.x_mm) {
            (Some(degrees), _) => write!(formatter, "{degrees:.3}°"),
            (None, Some(x)) => write!(formatter, "x = {x:.3} mm"),
            (None, None) => formatter.write_str("–"),
        }
    }
}

/// A value below this share of its limit is shown as 0.
const ROUNDING: f64 = 1e-6;

/// The result of a check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Name of the check.
    pub check: Cow<'static, str>,
    /// The value that was found; not finite when there is nothing to measure (no concave part, for example), which JSON writes as null.
    #[serde(serialize_with = "finite", deserialize_with = "or_nan")]
    pub value: f64,
    /// Its limit, if it has one.
    pub limit: Option<f64>,
    /// On which side of it the value must be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<Bound>,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// The worst place.
    #[serde(flatten)]
    pub place: Place,
    /// The verdict.
    pub verdict: Verdict,
    /// What the check means, where the finding was not read from a report.
    #[serde(skip)]
    pub about: Option<&'static str>,
    /// A remedy, or what the figure means.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

impl Finding {
    /// The value for a reader, whom a remainder of rounding does not help.
    #[must_use]
    pub(crate) fn readable(&self) -> f64 {
        // What must reach a limit and is far from it is no rounding.
        let below = self.bound != Some(Bound::AtLeast);
        let is_rounding = below && self.limit.is_some_and(|limit| self.value.abs() < ROUNDING * limit.abs());
        if is_rounding { 0.0 } else { self.value }
    }

    /// The value with its unit, as reports write it.
    #[must_use]
    pub fn value_words(&self) -> String {
        let value = self.readable();
        if value.is_finite() { self.with_unit(shown(value)) } else { "–".into() }
    }

    /// The limit with its side and unit, `at most 30 deg`; `None` without a limit.
    #[must_use]
    pub fn limit_words(&self) -> Option<String> {
        let side = self.bound.map_or(String::new(), |bound| format!("{} ", bound.words()));
        Some(format!("{side}{}", self.with_unit(shown(self.limit?))))
    }

    fn with_unit(&self, value: String) -> String {
        match &*self.unit {
            "" | "1" => value,
            unit => format!("{value} {unit}"),
        }
    }
}

/// In the order in which reports show them: failures, warnings, then the rest, each in the order in which they were found.
#[must_use]
pub fn worst_first(mut findings: Vec<Finding>) -> Vec<Finding> {
    findings.sort_by_key(|finding| finding.verdict.rank());
    findings
}

/// The names of the checks that failed.
#[must_use]
pub fn failed(findings: &[Finding]) -> Vec<&str> {
    findings.iter().filter(|finding| finding.verdict == Verdict::Fail).map(|finding| &*finding.check).collect()
}

/// Whether nothing failed.
#[must_use]
pub fn passed(findings: &[Finding]) -> bool {
    findings.iter().all(|finding| finding.verdict != Verdict::Fail)
}

/// JSON has no infinity.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde requires")]
fn finite<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if value.is_finite() { serializer.serialize_f64(*value) } else { serializer.serialize_none() }
}

fn or_nan<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding(check: &'static str, verdict: Verdict) -> Finding {
        let place = Place::default();
        Finding {
            check: check.into(),
            value: 1.0,
            limit: None,
            bound: None,
            unit: "1".into(),
            place,
            verdict,
            about: None,
            note: None,
        }
    }

    /// A warning is shown before what passed and after what failed, and does not refuse the cam.
    #[test]
    fn warnings_are_shown_first_and_refuse_nothing() {
        let all = [("a", Verdict::Pass), ("b", Verdict::Warn), ("c", Verdict::Info), ("d", Verdict::Warn)];
        let findings: Vec<Finding> = all.into_iter().map(|(check, verdict)| finding(check, verdict)).collect();
        let names = |findings: Vec<Finding>| findings.iter().map(|f| f.check.to_string()).collect::<String>();
        assert!(passed(&findings));
        assert_eq!(names(worst_first(findings.clone())), "bdac");
        let refused = [findings, vec![finding("e", Verdict::Fail)]].concat();
        assert!(!passed(&refused));
        assert_eq!(names(worst_first(refused)), "ebdac");
        let written = serde_json::to_value(finding("b", Verdict::Warn)).expect("JSON");
        assert_eq!(written["verdict"], "warn");
        assert_eq!(serde_json::from_value::<Finding>(written).expect("a finding").verdict, Verdict::Warn);
    }

    #[test]
    fn angles_are_told_within_one_turn() {
        for (angle, degrees) in [(0.0, 0.0), (-std::f64::consts::FRAC_PI_2, 270.0), (7.0, 7.0_f64.to_degrees() - 360.0)]
        {
            assert!((Place::at_angle(angle).cam_deg.expect("an angle") - degrees).abs() < 1e-12);
        }
        assert_eq!(Place::at_angle(-1e-18).cam_deg.map(f64::to_bits), Some(0.0_f64.to_bits()));
    }
}
