//! The report on a cam: findings, sections of a report, the review sheet.
//!
//! A report is a list of sections that the parts of a cam contribute (motion, follower, body, load, outline). Each section
//! has its values for programs and its words for people; JSON, text and sheet use the same list. Nothing here depends
//! on a kind of cam.

mod as_cut_error;
pub mod card;
pub mod chart;
pub mod diagram;
mod fact;
mod finding;
mod inputs;
pub mod mechanism;
pub mod motion_diagram;
mod page;
pub mod plot;
mod point_measures;
mod program_measures;
mod rolled;
pub mod scheme;
pub mod sheet;
pub mod style;
mod summary;
pub mod trace;
mod values;

pub use as_cut_error::AsCutError;
pub use camgen_kernel::text::{shown, to_type};
pub use fact::{Fact, Topic};
pub use finding::{Bound, Finding, Place, ShownValue, Verdict, degrees, failed, passed, worst_first};
pub use inputs::{Inputs, hexadecimal, sha256};
pub use point_measures::PointMeasures;
pub use program_measures::ProgramMeasures;
pub use rolled::Rolled;
pub use summary::{
    CUT_BESIDE, CUTTER_PATH_NOUN, FileVerdict, NOT_JUDGED, Summary, SummaryColumn, SummaryTable, length_cell,
    number_cell,
};
pub use values::{CamMeasures, OutlineMeasures, Weight, lobes_words};

use camgen_kernel::text::Text;
use camgen_kernel::units::LengthUnit;
use serde::de::{Error, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;
use std::borrow::Cow;
use std::fmt;
use std::sync::LazyLock;

/// Version of the form of a report.
pub const SCHEMA: u32 = 1;

/// For which speeds of the main shaft a cam is made, rpm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Speeds {
    /// A single one.
    One(f64),
    /// One for each section.
    Several(Vec<f64>),
    /// The speed does not matter.
    Any(()),
}

/// The shaft that gives the time, where it does not turn as fast as the main shaft.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shaft {
    /// "camshaft".
    pub name: Cow<'static, str>,
    /// Its turns for each turn of the main shaft.
    pub turns_per_main_shaft_turn: f64,
}

/// More speeds than this are shown as the first and the last.
const MOST_NAMED: usize = 8;

impl fmt::Display for Speeds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Speeds::One(rpm) => write!(f, " for {rpm} rpm"),
            Speeds::Any(()) => Ok(()),
            Speeds::Several(speeds) => {
                let all: Vec<String> = speeds.iter().map(|rpm| sheet::rounded(*rpm)).collect();
                match all.as_slice() {
                    [first, .., last] if all.len() > MOST_NAMED => {
                        write!(f, " for {first} to {last} rpm, {} speeds", all.len())
                    }
                    _ => write!(f, " for {} rpm", all.join(", ")),
                }
            }
        }
    }
}

/// A line of a section for people.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportLine {
    /// Its words.
    pub text: Text,
    /// Whether it is a row of a table in columns of a fixed width, which the values of the section have as well.
    pub is_row: bool,
}

impl ReportLine {
    /// A row of a table in columns of a fixed width.
    #[must_use]
    pub fn row(text: impl Into<Text>) -> Self {
        Self { text: text.into(), is_row: true }
    }
}

impl<T: Into<Text>> From<T> for ReportLine {
    fn from(text: T) -> Self {
        Self { text: text.into(), is_row: false }
    }
}

/// One section of a report, contributed by a part of the cam.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Its key in JSON, and its label in the text.
    pub key: Cow<'static, str>,
    /// Values with their units in their names.
    pub value: Value,
    /// The values in words for people, a line each.
    pub words: Vec<ReportLine>,
    /// The few figures for the review sheet.
    pub figures: Vec<Text>,
    /// What a summary says of it.
    pub facts: Vec<Fact>,
    /// The answer of an analysis, for the verdict of a summary.
    pub answer: Option<Text>,
    /// A table of a summary.
    pub table: Option<SummaryTable>,
}

impl Section {
    /// A section of values for programs only.
    #[must_use]
    pub fn new(key: &'static str, value: &impl Serialize) -> Self {
        // Only maps with keys that are not text fail, and a report has no such map.
        let value = serde_json::to_value(value).unwrap_or(Value::Null);
        Self {
            key: key.into(),
            value,
            words: Vec::new(),
            figures: Vec::new(),
            facts: Vec::new(),
            answer: None,
            table: None,
        }
    }

    /// With words for people.
    #[must_use]
    pub fn with_words<T: Into<ReportLine>>(self, words: Vec<T>) -> Self {
        Self { words: words.into_iter().map(Into::into).collect(), ..self }
    }

    /// With figures for the sheet.
    #[must_use]
    pub fn with_figures<T: Into<Text>>(self, figures: Vec<T>) -> Self {
        Self { figures: figures.into_iter().map(Into::into).collect(), ..self }
    }
}

impl Section {
    /// With a line of a summary.
    #[must_use]
    pub fn with_fact(mut self, topic: Topic, text: impl Into<Text>) -> Self {
        self.facts.push(Fact::new(topic, text));
        self
    }

    /// With the answer of an analysis.
    #[must_use]
    pub fn with_answer(self, answer: impl Into<Text>) -> Self {
        Self { answer: Some(answer.into()), ..self }
    }

    /// With a table of a summary.
    #[must_use]
    pub fn with_table(self, table: SummaryTable) -> Self {
        Self { table: Some(table), ..self }
    }

    /// With lines of a summary.
    #[must_use]
    pub fn with_facts(mut self, facts: impl IntoIterator<Item = Fact>) -> Self {
        self.facts.extend(facts);
        self
    }
}

/// Everything that was solved, checked and written.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The command that made it.
    pub command: Cow<'static, str>,
    /// What kind of cam it is: "rotary cam".
    pub noun: Cow<'static, str>,
    /// Name of the machine.
    pub machine: String,
    /// Speeds of the main shaft.
    pub rpm: Speeds,
    /// The shaft of the cam, where it has another speed.
    pub shaft: Option<Shaft>,
    /// The hash of its inputs.
    pub inputs: Inputs,
    /// What the parts contribute, in their order.
    pub sections: Vec<Section>,
    /// Every check.
    pub checks: Vec<Finding>,
    /// The checks of the other cams that are made with it, such as the counter disc of a pair.
    pub other_checks: Vec<Finding>,
    /// What else the user should know, such as keys that have no effect.
    pub notes: Vec<Text>,
    /// What the model leaves out, a sentence each.
    pub not_modelled: Vec<String>,
    /// Files written.
    pub files: Vec<String>,
    /// The unit of lengths for people; values for programs are in millimetres, as their names say.
    pub units: LengthUnit,
}

impl Report {
    /// "DPI flat-bed press, 2 at, rotary cam for 35 rpm, camshaft 105 rpm".
    #[must_use]
    pub fn title(&self) -> String {
        format!("{}, {}{}", self.machine, self.noun, self.speeds())
    }

    /// " for 35 rpm, camshaft 105 rpm"; nothing where the speed does not matter.
    #[must_use]
    pub fn speeds(&self) -> String {
        let shaft = self.shaft.as_ref().map(|shaft| match self.rpm {
            Speeds::One(rpm) => {
                format!(", {} {} rpm", shaft.name, sheet::rounded(rpm * shaft.turns_per_main_shaft_turn))
            }
            _ => format!(", {} {} times as fast", shaft.name, sheet::rounded(shaft.turns_per_main_shaft_turn)),
        });
        format!("{}{}", self.rpm, shaft.unwrap_or_default())
    }

    /// The hash of the inputs, twelve hexadecimal digits: two different cams have different ones.
    #[must_use]
    pub fn inputs_hash(&self) -> &str {
        &self.inputs.hash
    }

    /// The mark in a file: version, hash of the inputs, and the checks that failed, if any.
    #[must_use]
    pub fn mark(&self) -> String {
        self.warning().map_or_else(|| self.inputs.to_string(), |warning| format!("{}; {warning}", self.inputs))
    }

    /// The warning for a cam that breaks a limit.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        warning(&self.all_checks().cloned().collect::<Vec<_>>())
    }

    /// The values of a section.
    #[must_use]
    pub fn section(&self, key: &str) -> Option<&Value> {
        self.sections.iter().find(|section| section.key == key).map(|section| &section.value)
    }

    /// Whether no check failed.
    #[must_use]
    pub fn passed(&self) -> bool {
        passed(&self.checks) && passed(&self.other_checks)
    }

    /// The checks of the cam and of the others that are made with it.
    pub fn all_checks(&self) -> impl Iterator<Item = &Finding> {
        self.checks.iter().chain(&self.other_checks)
    }

    /// The figures for the review sheet.
    pub fn figures(&self) -> impl Iterator<Item = &Text> {
        self.sections.iter().flat_map(|section| &section.figures)
    }
}

/// A report that is made when it is first read: its sections measure the cam again, and not every file shows them.
pub type LazyReport = LazyLock<Report, Box<dyn FnOnce() -> Report + Send>>;

/// A path as a report lists it: with the same separators on every system.
#[must_use]
pub fn listed_path(path: &std::path::Path) -> String {
    let path = path.display().to_string();
    if std::path::MAIN_SEPARATOR == '/' { path } else { path.replace(std::path::MAIN_SEPARATOR, "/") }
}

/// The warning for a cam with these findings, if any failed.
#[must_use]
pub fn warning(findings: &[Finding]) -> Option<String> {
    let failed = failed(findings);
    (!failed.is_empty()).then(|| format!("NOT FOR MANUFACTURE, failed: {}", failed.join(", ")))
}

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("schema", &SCHEMA)?;
        map.serialize_entry("command", &self.command)?;
        map.serialize_entry("machine", &self.machine)?;
        map.serialize_entry("rpm", &self.rpm)?;
        if let Some(shaft) = &self.shaft {
            map.serialize_entry("shaft_of_cam", shaft)?;
        }
        map.serialize_entry("inputs", &self.inputs)?;
        for section in &self.sections {
            map.serialize_entry(&section.key, &section.value)?;
        }
        map.serialize_entry("checks", &self.checks)?;
        if !self.other_checks.is_empty() {
            map.serialize_entry("other_checks", &self.other_checks)?;
        }
        if !self.notes.is_empty() {
            map.serialize_entry("notes", &self.notes.iter().map(Text::to_string).collect::<Vec<_>>())?;
        }
        if !self.not_modelled.is_empty() {
            map.serialize_entry("not_modelled", &self.not_modelled)?;
        }
        map.serialize_entry("files", &self.files)?;
        map.end()
    }
}

/// Reads the values; words and figures are derived from values and are not read.
impl<'de> Deserialize<'de> for Report {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ReportVisitor)
    }
}

struct ReportVisitor;

impl<'de> Visitor<'de> for ReportVisitor {
    type Value = Report;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a report of camgen, schema {SCHEMA}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Report, A::Error> {
        let mut report = Report {
            command: "".into(),
            noun: "".into(),
            machine: String::new(),
            rpm: Speeds::Any(()),
            shaft: None,
            inputs: Inputs::default(),
            sections: Vec::new(),
            checks: Vec::new(),
            other_checks: Vec::new(),
            notes: Vec::new(),
            not_modelled: Vec::new(),
            files: Vec::new(),
            units: LengthUnit::default(),
        };
        let mut schema = None;
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "schema" => schema = Some(map.next_value::<u32>()?),
                "command" => report.command = map.next_value::<String>()?.into(),
                "machine" => report.machine = map.next_value()?,
                "rpm" => report.rpm = map.next_value()?,
                "shaft_of_cam" => report.shaft = Some(map.next_value()?),
                "inputs" => report.inputs = map.next_value()?,
                "checks" => report.checks = map.next_value()?,
                "other_checks" => report.other_checks = map.next_value()?,
                "notes" => report.notes = map.next_value::<Vec<String>>()?.into_iter().map(Text::from).collect(),
                "not_modelled" => report.not_modelled = map.next_value()?,
                "files" => report.files = map.next_value()?,
                _ => {
                    let value = map.next_value()?;
                    report.sections.push(Section {
                        key: key.into(),
                        value,
                        words: Vec::new(),
                        figures: Vec::new(),
                        facts: Vec::new(),
                        answer: None,
                        table: None,
                    });
                }
            }
        }
        match schema {
            Some(SCHEMA) => Ok(report),
            Some(other) => Err(A::Error::custom(format!("schema {other}; this camgen reads schema {SCHEMA}"))),
            None => Err(A::Error::missing_field("schema")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_comes_back_from_its_json() {
        let report = Report {
            command: "rotary".into(),
            noun: "".into(),
            machine: "press".into(),
            rpm: Speeds::One(35.0),
            shaft: Some(Shaft { name: "camshaft".into(), turns_per_main_shaft_turn: 3.0 }),
            inputs: Inputs::of(&[]),
            sections: vec![Section::new("cam", &serde_json::json!({"base_radius_mm": 69.0, "area_mm2": null}))],
            checks: vec![Finding {
                check: "wall".into(),
                part: None,
                value: 44.0,
                limit: Some(5.0),
                bound: Some(Bound::AtLeast),
                unit: "mm".into(),
                place: Place::default(),
                verdict: Verdict::Pass,
                missing: None,
                about: None,
                is_as_cut: false,
                named: None,
                fact: None,
                assumes: None,
                note: None,
            }],
            other_checks: Vec::new(),
            notes: vec!["`cam.balance` has no effect on a conoid".into()],
            not_modelled: vec!["Temperature: all sizes are those of the drawing.".into()],
            files: vec!["a.dxf".into()],
            units: LengthUnit::default(),
        };
        let text = serde_json::to_string(&report).expect("JSON");
        assert_eq!(serde_json::from_str::<Report>(&text).expect("a report"), report);
        let several = Report { rpm: Speeds::Several(vec![20.0, 35.0]), ..report };
        let text = serde_json::to_string(&several).expect("JSON");
        assert_eq!(serde_json::from_str::<Report>(&text).expect("a report"), several);
        assert!(serde_json::from_str::<Report>(&text.replace("\"schema\":1", "\"schema\":9")).is_err());
        assert!(serde_json::from_str::<Report>("{}").is_err());
    }

    #[test]
    fn speeds_are_told_in_words() {
        assert_eq!(Speeds::One(35.0).to_string(), " for 35 rpm");
        assert_eq!(Speeds::Several(vec![20.0, 35.0]).to_string(), " for 20, 35 rpm");
        assert_eq!(Speeds::Several((0..9).map(f64::from).collect()).to_string(), " for 0 to 8 rpm, 9 speeds");
    }
}
