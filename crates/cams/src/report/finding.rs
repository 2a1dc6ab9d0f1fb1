//! The result of a check, and where.

use super::fact::Fact;
use super::shown;
use camgen_kernel::text::{DIGITS, Length, LengthKind, Remedy, Text, Value, nominal, significant_beside, text};
use camgen_kernel::units::LengthUnit;
use serde::ser::{SerializeMap, Serializer};
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
        match &*self.unit {
            "" => Ok(()),
            "°" => f.write_str("°"),
            unit => write!(f, " {unit}"),
        }
    }
}

/// A value below this share of its limit is shown as 0.
const ROUNDING: f64 = 1e-6;

/// The result of a check.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Finding {
    /// Name of the check.
    pub check: Cow<'static, str>,
    /// The cam of several that it is about, by its name: "counter"; `None` of the first.
    #[serde(default)]
    pub part: Option<String>,
    /// The value that was found; not finite when there is nothing to measure (no concave part, for example), which JSON writes as null.
    #[serde(deserialize_with = "or_nan")]
    pub value: f64,
    /// Its limit, if it has one.
    pub limit: Option<f64>,
    /// On which side of it the value must be.
    #[serde(default)]
    pub bound: Option<Bound>,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// The worst place.
    #[serde(flatten)]
    pub place: Place,
    /// The verdict.
    pub verdict: Verdict,
    /// The data that the check needs and that are missing, where the finding was not read from a report: why it was not run.
    #[serde(skip)]
    pub missing: Option<String>,
    /// What the check means, where the finding was not read from a report.
    #[serde(skip)]
    pub about: Option<&'static str>,
    /// Whether it is about the outline as it was written, whose tolerance is filled on purpose, and not about the cam that was designed.
    #[serde(skip)]
    pub is_as_cut: bool,
    /// Its name for people, where it is another than that of the check.
    #[serde(skip)]
    pub named: Option<&'static str>,
    /// What a summary says of it among its facts, where the finding was not read from a report.
    #[serde(skip)]
    pub fact: Option<Fact>,
    /// What the verdict rests on without having been given.
    #[serde(default, deserialize_with = "as_words")]
    pub assumes: Option<Text>,
    /// A remedy, or what the figure means.
    #[serde(default, deserialize_with = "as_words")]
    pub note: Option<Text>,
}

/// For programs: texts in millimetres, and what follows from the figures.
impl Serialize for Finding {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("check", &self.check)?;
        if let Some(part) = &self.part {
            map.serialize_entry("part", part)?;
        }
        // JSON has no infinity.
        map.serialize_entry("value", &Some(self.value).filter(|value| value.is_finite()))?;
        map.serialize_entry("limit", &self.limit)?;
        if let Some(bound) = &self.bound {
            map.serialize_entry("bound", bound)?;
        }
        map.serialize_entry("unit", &self.unit)?;
        map.serialize_entry("cam_deg", &self.place.cam_deg)?;
        if let Some(x) = &self.place.x_mm {
            map.serialize_entry("x_mm", x)?;
        }
        map.serialize_entry("verdict", &self.verdict)?;
        if let Some(note) = &self.note {
            map.serialize_entry("note", &note.to_string())?;
        }
        if let Some(margin) = self.margin() {
            map.serialize_entry("margin", &margin)?;
        }
        if let Some(assumed) = &self.assumes {
            map.serialize_entry("assumes", &assumed.to_string())?;
        }
        let remedies: Vec<RemedyWritten> = self.remedies().into_iter().filter_map(RemedyWritten::of).collect();
        if !remedies.is_empty() {
            map.serialize_entry("remedies", &remedies)?;
        }
        map.end()
    }
}

/// A remedy for programs: a key and its value, and further ones where all of them are needed.
#[derive(Serialize)]
struct RemedyWritten<'a> {
    key: &'a str,
    value: &'a str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    with: Vec<RemedyWritten<'a>>,
}

impl<'a> RemedyWritten<'a> {
    fn of(remedy: &'a Remedy) -> Option<Self> {
        let mut changes =
            remedy.changes.iter().map(|change| Self { key: &change.key, value: &change.value, with: Vec::new() });
        let first = changes.next()?;
        Some(Self { with: changes.collect(), ..first })
    }
}

impl Finding {
    /// The share of its limit that the value uses: value over limit where the limit is the largest value, limit over value where it is the
    /// smallest. `None` where such a share says nothing: without a limit, beside a limit of 0, for what must be exact, and for counts.
    #[must_use]
    pub fn margin(&self) -> Option<f64> {
        let limit = self.limit.filter(|limit| *limit > 0.0 && self.value.is_finite() && !self.is_count())?;
        match self.bound? {
            Bound::AtMost => Some(self.value.max(0.0) / limit),
            Bound::AtLeast if self.value > 0.0 => Some(limit / self.value),
            Bound::AtLeast | Bound::Above | Bound::Exactly => None,
        }
    }

    /// Whether value and limit are numbers of things, such as derivatives without a jump.
    fn is_count(&self) -> bool {
        let is_whole = |value: f64| value.fract() == 0.0;
        matches!(&*self.unit, "" | "1") && is_whole(self.value) && self.limit.is_none_or(is_whole)
    }

    /// The changes of a machine file in its note.
    #[must_use]
    pub fn remedies(&self) -> Vec<&Remedy> {
        self.note.as_ref().map_or_else(Vec::new, Text::remedies)
    }

    /// The name of the check in words: "pressure angle", "convex radius".
    #[must_use]
    pub fn title(&self) -> String {
        let words = self.check.replace('_', " ");
        let title = self.named.unwrap_or_else(|| words.strip_prefix("min ").unwrap_or(&words)).to_owned();
        self.part.as_ref().map_or_else(|| title.clone(), |part| format!("{part}: {title}"))
    }

    /// The value as a summary shows it: four significant digits, and more where they would read as the limit; shares in percent.
    #[must_use]
    pub fn brief_value(&self, units: LengthUnit) -> ShownValue {
        let value = self.readable();
        if !value.is_finite() {
            return ShownValue { number: "–".into(), unit: "".into() };
        }
        let (scale, unit) = self.brief_unit(units);
        let limit = self.limit.filter(|limit| limit.is_finite());
        let number = match limit {
            _ if self.is_count() => nominal(value, DIGITS),
            Some(limit) => significant_beside(scale * value, scale * limit, DIGITS),
            None => significant_beside(scale * value, f64::NAN, DIGITS),
        };
        ShownValue { number, unit }
    }

    /// The limit as a summary shows it beside the value, without its side; `None` without a limit.
    #[must_use]
    pub fn brief_limit(&self, units: LengthUnit) -> Option<ShownValue> {
        let (scale, unit) = self.brief_unit(units);
        Some(ShownValue { number: nominal(scale * self.limit?, DIGITS), unit })
    }

    /// What a summary multiplies value and limit by, and the unit that they then have.
    fn brief_unit(&self, units: LengthUnit) -> (f64, Cow<'static, str>) {
        const SMALL_MM: f64 = 0.1;
        let is_small = self.limit.unwrap_or(self.value).abs() < SMALL_MM && self.value.abs() < SMALL_MM;
        match &*self.unit {
            "" | "1" if self.is_as_cut && !self.is_count() => (100.0, "%".into()),
            "" | "1" => (1.0, "".into()),
            "deg" => (1.0, "°".into()),
            "mm" if units == LengthUnit::Millimetre && is_small && self.limit != Some(0.0) => (1e3, "µm".into()),
            unit => match LengthKind::of_symbol(unit) {
                Some(kind) => (kind.scale(units), kind.symbol(units).into()),
                None => (1.0, self.unit.clone()),
            },
        }
    }

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
            part: None,
            value: 1.0,
            limit: None,
            bound: None,
            unit: "1".into(),
            place,
            verdict,
            missing: None,
            about: None,
            is_as_cut: false,
            named: None,
            fact: None,
            assumes: None,
            note: None,
        }
    }

    /// The margin is the used share of a limit, and 0 or a count has none.
    #[test]
    fn margins_are_the_share_of_the_limit_that_is_used() {
        let of = |value: f64, limit: f64, bound, unit: &'static str| {
            let unit = unit.into();
            Finding { value, limit: Some(limit), bound: Some(bound), unit, ..finding("pressure_angle", Verdict::Pass) }
        };
        assert_eq!(of(27.0, 30.0, Bound::AtMost, "deg").margin(), Some(0.9));
        assert_eq!(of(80.0, 60.0, Bound::AtLeast, "mm").margin(), Some(0.75));
        assert_eq!(of(3.0, 0.0, Bound::Above, "N").margin(), None);
        assert_eq!(of(2.0, 1.0, Bound::AtLeast, "1").margin(), None);
        assert_eq!(of(-2.0, 1.0, Bound::AtLeast, "mm").margin(), None);
        let near = of(29.995_7, 30.0, Bound::AtMost, "deg");
        let mm = LengthUnit::Millimetre;
        assert_eq!(near.brief_value(mm).to_string(), "29.996°");
        assert_eq!(near.brief_limit(mm).expect("a limit").to_string(), "30°");
        let outline = of(0.004_873, 0.005, Bound::AtMost, "mm");
        assert_eq!(outline.brief_value(mm).to_string(), "4.873 µm");
        assert_eq!(outline.brief_limit(LengthUnit::Inch).expect("a limit").to_string(), "0.0001969 in");
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
