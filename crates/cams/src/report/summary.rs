//! The summary of a report: what its reader came for, in the order in which it is asked.

use super::{Bound, Fact, Finding, Report, Verdict};
use camgen_kernel::text::{Length, LengthKind, Text, Value};

/// From this share of its limit on, a figure is listed.
const LISTED_FROM: f64 = 0.5;
/// The figures nearest to their limits are listed whatever they use.
const LISTED: usize = 3;

/// What a summary shows of a report.
#[derive(Debug, Clone)]
pub struct Summary<'a> {
    /// How many checks were judged: those that passed, failed or warn.
    pub judged: usize,
    /// The checks that failed, in the order of the report.
    pub failed: Vec<&'a Finding>,
    /// The checks that warn.
    pub warnings: Vec<&'a Finding>,
    /// The check of the cam that uses most of its limit; `None` where none has a margin.
    pub tightest: Option<&'a Finding>,
    /// What is listed: what failed, then what uses most of its limit.
    pub margins: Vec<&'a Finding>,
    /// How many checks passed with room and are not listed, those of what was written not among them.
    pub roomy: usize,
    /// The checks of what was written that have a margin, the fullest first; their tolerances are filled on purpose.
    pub as_cut: Vec<&'a Finding>,
    /// Checks that could not be run because data are missing.
    pub not_run: Vec<&'a Finding>,
    /// The facts in the order in which a designer asks, one for each topic.
    pub facts: Vec<Fact>,
    /// The answer of an analysis.
    pub answer: Option<&'a Text>,
}

impl<'a> Summary<'a> {
    /// The summary of a report.
    #[must_use]
    pub fn of(report: &'a Report) -> Self {
        let with = |verdict: Verdict| report.all_checks().filter(move |finding| finding.verdict == verdict);
        let (failed, warnings): (Vec<_>, Vec<_>) = (with(Verdict::Fail).collect(), with(Verdict::Warn).collect());
        let passed: Vec<&Finding> = with(Verdict::Pass).collect();
        let margins_of = |as_cut: bool| {
            let mut with_margin: Vec<(f64, &Finding)> = passed
                .iter()
                .chain(&warnings)
                .filter(|finding| finding.is_as_cut == as_cut)
                .filter_map(|finding| Some((finding.margin()?, *finding)))
                .collect();
            with_margin.sort_by(|one, other| other.0.total_cmp(&one.0));
            with_margin
        };
        let (of_cam, as_cut) = (margins_of(false), margins_of(true));
        let tightest = of_cam.iter().map(|(_, finding)| *finding).find(|finding| finding.verdict == Verdict::Pass);
        let listed = of_cam.iter().enumerate().filter(|(place, (used, _))| *place < LISTED || *used >= LISTED_FROM);
        let margins: Vec<&Finding> = failed.iter().copied().chain(listed.map(|(_, (_, finding))| *finding)).collect();
        let is_listed = |finding: &&Finding| margins.iter().any(|listed| std::ptr::eq(*listed, *finding));
        let roomy = passed.iter().filter(|finding| !finding.is_as_cut && !is_listed(finding)).count();
        let as_cut: Vec<&Finding> = as_cut
            .into_iter()
            .filter(|(used, found)| *used >= LISTED_FROM && found.bound == Some(Bound::AtMost))
            .map(|(_, finding)| finding)
            .collect();
        Self {
            judged: failed.len() + warnings.len() + passed.len(),
            failed,
            warnings,
            tightest,
            margins,
            roomy,
            as_cut,
            not_run: report.checks.iter().filter(|finding| finding.missing.is_some()).collect(),
            facts: facts(report),
            answer: report.sections.iter().find_map(|section| section.answer.as_ref()),
        }
    }

    /// How many checks passed: those that warn break no limit.
    #[must_use]
    pub fn passed(&self) -> usize {
        self.judged - self.failed.len()
    }
}

/// What a file is that was checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileVerdict {
    /// The cam, also where only its form differs: another unit, start or direction, doubled entities, rounded vertices.
    ThisCam,
    /// The outline of the cam, but more or less than the part would be cut.
    ThisCamBut,
    /// A solid of splines that cannot be judged exactly.
    NotJudged,
    /// Another outline, or none.
    NotThisCam,
}

/// Checks of a file that fail although the outline is that of the cam.
const BESIDE_THE_OUTLINE: [&str; 6] = ["layer", "units", "readable", "duplicates", "contours", "bore"];
/// Checks of a solid that fail as well where its bore is not that of the cam.
const OF_A_WRONG_BORE: [&str; 2] = ["holes", "volume"];

/// The section of a report on a file that cannot be judged.
pub const NOT_JUDGED: &str = "not_judged";
/// The section of a report on a drawing with how what would be cut differs from the part.
pub const CUT_BESIDE: &str = "cut_beside";
/// How the noun of a report begins on a file with the path of a cutter's centre.
pub const CUTTER_PATH_NOUN: &str = "path of a cutter";

impl FileVerdict {
    /// The verdict of the report on a file.
    #[must_use]
    pub fn of(report: &Report) -> Self {
        let failed: Vec<&str> = report
            .checks
            .iter()
            .filter(|finding| finding.verdict == Verdict::Fail)
            .map(|finding| &*finding.check)
            .collect();
        if failed.is_empty() {
            return Self::ThisCam;
        }
        if report.section(NOT_JUDGED).is_some() {
            return Self::NotJudged;
        }
        let is_outline =
            report.checks.iter().any(|finding| finding.check == "outline" && finding.verdict == Verdict::Pass);
        let of_bore = failed.contains(&"bore");
        let is_beside =
            failed.iter().all(|check| BESIDE_THE_OUTLINE.contains(check) || of_bore && OF_A_WRONG_BORE.contains(check));
        if is_outline && is_beside { Self::ThisCamBut } else { Self::NotThisCam }
    }

    /// Its key in reports for programs.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::ThisCam => "this cam",
            Self::ThisCamBut => "this cam, but",
            Self::NotJudged => "not judged",
            Self::NotThisCam => "not this cam",
        }
    }
}

/// The facts of sections and findings, those of a topic in one.
fn facts(report: &Report) -> Vec<Fact> {
    let of_sections = report.sections.iter().flat_map(|section| &section.facts);
    let of_findings = report.checks.iter().filter_map(|finding| finding.fact.as_ref());
    let mut all: Vec<Fact> = Vec::new();
    for fact in of_sections.chain(of_findings) {
        match all.iter_mut().find(|other| other.topic == fact.topic) {
            Some(same) => same.text = same.text.clone().and(", ", &fact.text),
            None => all.push(fact.clone()),
        }
    }
    all.sort_by_key(|fact| fact.topic);
    all
}

/// A table of a summary.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SummaryTable {
    /// Its columns, from the left.
    pub heads: Vec<SummaryColumn>,
    /// A cell for each column.
    pub rows: Vec<Vec<Text>>,
    /// The row that stands out, such as the law of the design.
    pub marked: Option<usize>,
    /// What is left out of the table, in a line below it.
    pub rest: Option<Text>,
}

/// A column of a table of a summary.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SummaryColumn {
    /// Its name.
    pub head: Text,
    /// The unit of its cells, below the name; empty where they have none or one each.
    pub unit: Text,
    /// Whether its cells are words, which stand at its left edge.
    pub is_words: bool,
}

impl SummaryColumn {
    /// A column of numbers in a unit.
    #[must_use]
    pub fn numbers(head: impl Into<Text>, unit: impl Into<Text>) -> Self {
        Self { head: head.into(), unit: unit.into(), is_words: false }
    }

    /// A column of lengths, or of what else has a length in its unit.
    #[must_use]
    pub fn lengths(head: impl Into<Text>, kind: &'static LengthKind) -> Self {
        Self::numbers(head, Value::from(kind))
    }

    /// A column of words.
    #[must_use]
    pub fn words(head: impl Into<Text>) -> Self {
        Self { head: head.into(), unit: Text::default(), is_words: true }
    }
}

/// A cell of a column of numbers: four digits.
#[must_use]
pub fn number_cell(value: f64) -> Text {
    Value::brief_number(value).into()
}

/// A cell of a column of lengths in mm: four digits, in the unit of the reader.
#[must_use]
pub fn length_cell(mm: f64) -> Text {
    Value::from(Length::mm(mm).brief().bare()).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Section, Topic};

    #[test]
    fn facts_of_a_topic_are_one_line_and_the_lines_are_in_order() {
        let section = |fact: Fact| Section::new("cam", &0).with_facts([fact]);
        let mass = Fact::new(Topic::SIZE, "12 kg");
        let report = Report {
            sections: vec![
                section(Fact::new(Topic::FORCE, "3 N")),
                section(Fact::new(Topic::SIZE, "base R69 mm")),
                section(mass),
            ],
            ..serde_json::from_str(
                r#"{"schema":1,"command":"make","machine":"m","rpm":null,"inputs":{"hash":"","camgen":""},"checks":[],"files":[]}"#,
            )
            .expect("a report")
        };
        let summary = Summary::of(&report);
        let told: Vec<String> =
            summary.facts.iter().map(|fact| format!("{} {}", fact.topic.label, fact.text)).collect();
        assert_eq!(told, ["size base R69 mm, 12 kg", "force 3 N"]);
    }
}
