//! The report for a person, from the sections that the parts of the cam contribute. The text is the same in every run, plain
//! and as wide as its lines; colour and wrapped lines are for a terminal.

mod glossary;
mod summary;

pub(super) use summary::{Beside, TriedRemedy, Written, check_summary, half_summary, summary};

use camgen::document::plain;
use camgen::report::{Finding, Place, Report, Section, Verdict};
use camgen::units::LengthUnit;
use std::io::IsTerminal;

const GREEN: &str = "\u{1b}[32m";
const RED: &str = "\u{1b}[1;31m";
const YELLOW: &str = "\u{1b}[1;33m";
const PLAIN: &str = "\u{1b}[0m";

/// Narrower terminals are treated as having this width.
const NARROWEST: usize = 40;

/// Width of the names of sections.
const LABEL: usize = 8;

/// The layout of the text.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Page {
    /// Verdicts are coloured.
    pub(super) colour: bool,
    /// Characters in a line; `None` where lines are not wrapped.
    pub(super) width: Option<usize>,
}

impl Page {
    /// For standard output as it is, without colours.
    pub(super) fn here() -> Self {
        let terminal = std::io::stdout().is_terminal();
        let width = terminal.then(terminal_size::terminal_size).flatten().map(|(width, _)| usize::from(width.0));
        Self { colour: false, width }
    }
}

pub(super) fn report(report: &Report, page: Page) -> String {
    let first = format!("{} · {}{}", report.machine, report.noun, report.speeds());
    written(&first, report, page)
}

/// The report of a checked file: one plain sentence, then the checks.
pub(super) fn check_report(file: &str, report: &Report, page: Page) -> String {
    let verdict = if report.passed() { "is this cam" } else { "is NOT this cam" };
    let first = format!("{file} {verdict}: {} · {}{}", report.machine, report.noun, report.speeds());
    written(&first, report, page)
}

fn written(first: &str, report: &Report, page: Page) -> String {
    let mut lines = vec![plain(first).into_owned()];
    lines.extend(
        report.sections.iter().flat_map(|of| section(of, report.units, page)).map(|line| plain(&line).into_owned()),
    );
    if !report.checks.is_empty() {
        lines.push("  checks".into());
    }
    lines.extend(checks(&report.checks, report.units, page));
    let failed = report.other_checks.iter().filter(|finding| finding.verdict == Verdict::Fail);
    lines.extend(checks(&failed.cloned().collect::<Vec<_>>(), report.units, page));
    let terms = glossary::terms_in(&lines.join("\n"));
    let notes: Vec<String> = report.notes.iter().map(|note| note.in_unit(report.units)).collect();
    let lists =
        [("notes", &notes), ("files", &report.files), ("terms", &terms), ("not modelled", &report.not_modelled)];
    for (name, entries) in lists {
        if !entries.is_empty() {
            lines.push(format!("  {name}"));
            lines.extend(entries.iter().map(|entry| wrapped(&format!("    {}", plain(entry)), 6, page)));
        }
    }
    lines.push(format!("  inputs   {}, camgen {}", report.inputs.hash, report.inputs.camgen));
    lines.push(String::new());
    lines.join("\n")
}

/// The lines of a section, the first with its name.
fn section(section: &Section, units: LengthUnit, page: Page) -> Vec<String> {
    // A long name gets a line of its own.
    let alone = section.key.chars().count() > LABEL;
    let head = (alone && !section.words.is_empty()).then(|| format!("  {}", section.key));
    let lines = section.words.iter().enumerate().map(|(index, words)| {
        let label = if index == 0 && !alone { &*section.key } else { "" };
        wrapped(&format!("  {label:<LABEL$} {}", words.text.in_unit(units)), LABEL + 3, page)
    });
    head.into_iter().chain(lines).collect()
}

/// The cells of a check: its name, the value without and the unit with its sign, the limit, the place.
fn cells(finding: &Finding, units: LengthUnit) -> [String; 5] {
    let value = finding.shown_value(units);
    let place = if finding.place == Place::default() { String::new() } else { finding.place.text().in_unit(units) };
    let limit = finding.limit_words(units).unwrap_or_default();
    let check =
        finding.part.as_ref().map_or_else(|| finding.check.to_string(), |part| format!("{part}: {}", finding.check));
    [check, value.number, value.unit.into_owned(), limit, place]
}

/// A line for each check, in columns, and one below where there is more to say.
fn checks(findings: &[Finding], units: LengthUnit, page: Page) -> Vec<String> {
    let rows: Vec<[String; 5]> = findings.iter().map(|finding| cells(finding, units)).collect();
    let [name, number, unit, limit] =
        [0, 1, 2, 3].map(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let mut lines = Vec::new();
    for (finding, row) in findings.iter().zip(&rows) {
        let verdict = painted(finding.verdict, page);
        let [check, value, of, bound, place] = row;
        let line = format!("{check:<name$}  {value:>number$} {of:<unit$}  {bound:<limit$}  {place}");
        lines.push(format!("    {verdict}  {}", plain(line.trim_end())));
        lines.extend(
            finding.note.iter().map(|note| wrapped(&format!("          {}", plain(&note.in_unit(units))), 10, page)),
        );
    }
    lines
}

/// A line of a summary with the words of a verdict in colour.
fn painted_word(line: &str, page: Page) -> String {
    if !page.colour {
        return line.to_owned();
    }
    for (word, paint) in [
        ("FAIL", RED),
        ("NOT THIS CAM", RED),
        ("NOT JUDGED", RED),
        ("THIS CAM, BUT", YELLOW),
        ("PASS", GREEN),
        ("THIS CAM", GREEN),
    ] {
        if let Some((before, behind)) = line.split_once(word) {
            return format!("{before}{paint}{word}{PLAIN}{behind}");
        }
    }
    line.to_owned()
}

fn painted(verdict: Verdict, page: Page) -> String {
    let word = verdict.word();
    let paint = match verdict {
        _ if !page.colour => return word.into(),
        Verdict::Pass => GREEN,
        Verdict::Fail => RED,
        Verdict::Warn => YELLOW,
        _ => PLAIN,
    };
    format!("{paint}{word}{PLAIN}")
}

/// A line broken at blanks where it is wider than the page; the lines after the first are indented.
pub(super) fn wrapped(line: &str, indent: usize, page: Page) -> String {
    let Some(width) = page.width.map(|width| width.max(NARROWEST)) else { return line.to_owned() };
    let mut text = String::new();
    let mut column = 0;
    for (index, word) in line.trim_end().split(' ').enumerate() {
        let length = word.chars().count();
        if index > 0 && column + 1 + length > width && column > indent {
            text.push_str(&format!("\n{}", " ".repeat(indent)));
            column = indent;
        } else if index > 0 {
            text.push(' ');
            column += 1;
        }
        text.push_str(word);
        column += length;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_wrapped_on_a_terminal_only() {
        let line = format!("  cam      {}", "word ".repeat(20).trim_end());
        assert_eq!(wrapped(&line, 11, Page::default()), line);
        let narrow = wrapped(&line, 11, Page { colour: false, width: Some(50) });
        assert!(narrow.lines().all(|line| line.chars().count() <= 50), "{narrow}");
        assert!(narrow.lines().skip(1).all(|line| line.starts_with("           word")), "{narrow}");
        assert_eq!(narrow.split_whitespace().collect::<Vec<_>>(), line.split_whitespace().collect::<Vec<_>>());
        let long = "x".repeat(200);
        assert_eq!(wrapped(&long, 4, Page { colour: false, width: Some(10) }), long, "a word is never broken");
    }
}
