//! The result of a check, and where.

use super::shown;
use camgen_kernel::text::{Length, LengthKind, Text, Value, text};
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
    /// As a person reads it.
    #[must_use]
    pub fn text(&self) -> Text {
        match (self.cam_deg, self.x_mm) {
            (Some(degrees), _) => format!("{degrees:.3}°").into(),
            (None, Some(x)) => text!("x = {}", Length::mm(x).decimals(3)),
            (None, None) => "–".into(),
        }
    }
}

/// In degrees or millimetres.
impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Display::fmt(&self.text(), f)
    }
}

/// A value and its unit as a report shows them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShownValue {
    /// The number.
    pub number: String,
    /// Its unit; empty where it has none.
    pub unit: Cow<'static, str>,
}

impl std::fmt::Display for ShownValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.number)?;
        if self.unit.is_empty() { Ok(()) } else { write!(f, " {}", self.unit) }
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
    /// Whether data are missing that the check needs, where the finding was not read from a report.
    #[serde(skip)]
    pub is_unknown: bool,
    /// What the check means, where the finding was not read from a report.
    #[serde(skip)]
    pub about: Option<&'static str>,
    /// A remedy, or what the figure means.
    #[serde(default, skip_serializing_if = "Option::is_none", serialize_with = "words", deserialize_with = "as_words")]
    pub note: Option<Text>,
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

    /// The value as a report with lengths in `units` shows it.
    #[must_use]
    pub fn shown_value(&self, units: LengthUnit) -> ShownValue {
        let value = self.readable();
        if value.is_finite() { self.shown(value, units) } else { ShownValue { number: "–".into(), unit: "".into() } }
    }

    /// The limit with its side and unit, `at most 30 deg`, as a report with lengths in `units` shows it; `None` without a limit.
    #[must_use]
    pub fn limit_words(&self, units: LengthUnit) -> Option<String> {
        let side = self.bound.map_or(String::new(), |bound| format!("{} ", bound.words()));
        Some(format!("{side}{}", self.shown(self.limit?, units)))
    }

    fn shown(&self, value: f64, units: LengthUnit) -> ShownValue {
        match (&*self.unit, LengthKind::of_symbol(&self.unit)) {
            ("" | "1", _) => ShownValue { number: shown(value), unit: "".into() },
            (_, Some(kind)) if units == LengthUnit::Inch => {
                ShownValue { number: Length::new(value, kind).bare().in_unit(units), unit: kind.symbol(units).into() }
            }
            _ => ShownValue { number: shown(value), unit: self.unit.clone() },
        }
    }

    /// The note in millimetres; empty where there is none.
    #[must_use]
    pub fn note_words(&self) -> String {
        self.note.as_ref().map_or_else(String::new, Text::to_string)
    }

    /// The value with its unit in a sentence.
    #[must_use]
    pub fn value_text(&self) -> Text {
        let value = self.readable();
        match LengthKind::of_symbol(&self.unit).filter(|_| value.is_finite()) {
            Some(kind) => Value::from(Length::new(value, kind)).into(),
            None => self.shown_value(LengthUnit::Millimetre).to_string().into(),
        }
    }

    /// The limit with its side and unit in a sentence; `None` without a limit.
    #[must_use]
    pub fn limit_text(&self) -> Option<Text> {
        let side = self.bound.map_or(String::new(), |bound| format!("{} ", bound.words()));
        match LengthKind::of_symbol(&self.unit) {
            Some(kind) => Some(text!("{}{}", side, Length::new(self.limit?, kind))),
            None => self.limit_words(LengthUnit::Millimetre).map(Text::from),
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

/// A text for programs, in millimetres.
#[expect(clippy::ref_option, reason = "the signature that serde requires")]
fn words<S: Serializer>(text: &Option<Text>, serializer: S) -> Result<S::Ok, S::Error> {
    text.as_ref().map(Text::to_string).serialize(serializer)
}

fn as_words<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Text>, D::Error> {
    Ok(Option::<String>::deserialize(deserializer)?.map(Text::from))
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
            is_unknown: false,
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
