//! The report for a person at a terminal: it walks the sections that the parts of the cam contribute.

use camgen::report::{Finding, Place, Report, Section, Verdict, shown};
use std::fmt::Write;

const GREEN: &str = "\u{1b}[32m";
const RED: &str = "\u{1b}[1;31m";
const YELLOW: &str = "\u{1b}[1;33m";
const PLAIN: &str = "\u{1b}[0m";

pub(super) fn report(report: &Report, colour: bool) -> String {
    let mut lines = vec![format!("{} · {}{}", report.machine, report.noun, report.rpm)];
    lines.extend(report.sections.iter().flat_map(section));
    ended(lines, report, colour)
}

/// The report of a checked file: one plain sentence, then the checks.
pub(super) fn check_report(file: &str, report: &Report, colour: bool) -> String {
    let verdict = if report.passed() { "is this cam" } else { "is NOT this cam" };
    let mut lines = vec![format!("{file} {verdict}: {} · {}{}", report.machine, report.noun, report.rpm)];
    lines.extend(report.sections.iter().flat_map(section));
    ended(lines, report, colour)
}

/// The lines of a section, the first with its name.
fn section(section: &Section) -> Vec<String> {
    let label = |index: usize| if index == 0 { &*section.key } else { "" };
    section.words.iter().enumerate().map(|(index, words)| format!("  {:<8} {words}", label(index))).collect()
}

/// Checks, notes and files, after the lines a report begins with.
fn ended(mut lines: Vec<String>, report: &Report, colour: bool) -> String {
    lines.push("  checks".into());
    lines.extend(report.checks.iter().map(|finding| check(finding, colour)));
    for (name, entries) in [("notes", &report.notes), ("files", &report.files)] {
        if !entries.is_empty() {
            lines.push(format!("  {name}"));
            lines.extend(entries.iter().map(|entry| format!("    {entry}")));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

fn check(finding: &Finding, colour: bool) -> String {
    let paint = match finding.verdict {
        Verdict::Pass => GREEN,
        Verdict::Fail => RED,
        Verdict::Warn => YELLOW,
        _ => PLAIN,
    };
    let word = finding.verdict.word();
    let verdict = if colour { format!("{paint}{word}{PLAIN}") } else { word.into() };
    let value = if finding.value.is_finite() { shown(finding.value) } else { "–".into() };
    let with_unit =
        |value: String| if ["", "1"].contains(&&*finding.unit) { value } else { format!("{value} {}", finding.unit) };
    let mut line = format!("    {verdict}  {:<18} {}", finding.check, with_unit(value));
    if let Some(limit) = finding.limit {
        let _ = write!(line, ", limit {}", with_unit(shown(limit)));
    }
    if finding.place != Place::default() {
        let _ = write!(line, ", at {}", finding.place);
    }
    if let Some(note) = &finding.note {
        let _ = write!(line, "; {note}");
    }
    line
}
