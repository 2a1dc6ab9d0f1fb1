//! The summary of a report on a terminal: the verdict first, then what is asked next, on one screen.

use super::{Page, painted_word, wrapped};
use camgen::document::plain;
use camgen::report::{
    Bound, CUT_BESIDE, Fact, FileVerdict, Finding, NOT_JUDGED, Report, Summary, SummaryTable, Topic, Verdict,
};
use camgen::text::{KeyChange, Length, Text, significant};
use camgen::units::LengthUnit;

/// Width of a summary where the page does not say how wide it is.
const WIDTH: usize = 80;
/// Lines of a summary: a screen has 25, and a message may stand above.
const HEIGHT: usize = 24;
/// Where the text of a line with a label begins.
const TEXT: usize = 15;
/// Cells of the bar of a margin.
const BAR: u8 = 10;
/// A pass never reads as the whole of its limit.
const FULLEST_PASS: f64 = 0.999;
/// Lines of a note that is shown before facts are left out.
const SHORT_NOTE: usize = 2;
/// The section with the design that an analysis found.
const DESIGN: &str = "design";
/// Notes and missing data that are named one by one.
const MOST_NOTES: usize = 2;

/// What was done with the files of a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Written {
    /// Those that the report lists.
    Listed,
    /// None, because of --dry-run.
    DryRun,
}

/// A change of a machine file that was tried, with what it costs.
#[derive(Debug, Clone)]
pub(in crate::cli) struct TriedRemedy {
    /// The changes, each with the value that it replaces.
    pub(in crate::cli) changes: Vec<(KeyChange, Option<String>)>,
    /// How many checks the changed cam passes: all of them.
    pub(in crate::cli) judged: usize,
    /// The facts that the changes alter.
    pub(in crate::cli) costs: Vec<Fact>,
}

/// What a summary says beside its report.
#[derive(Debug, Clone, Copy)]
pub(in crate::cli) struct Beside<'a> {
    pub(in crate::cli) written: Written,
    pub(in crate::cli) remedy: Option<&'a TriedRemedy>,
}

/// Lines that stay or go together.
struct Block {
    /// The blocks with the smallest number go first where the page is too short; 9 stays.
    keep: u8,
    lines: Vec<String>,
}

/// The summary of the report of a cam or an analysis.
pub(in crate::cli) fn summary(report: &Report, beside: Beside<'_>, page: Page) -> String {
    summary_within(report, beside, page, HEIGHT)
}

/// The summary of one of two reports on a page.
pub(in crate::cli) fn half_summary(report: &Report, beside: Beside<'_>, page: Page) -> String {
    summary_within(report, beside, page, HEIGHT / 2)
}

fn summary_within(report: &Report, beside: Beside<'_>, page: Page, height: usize) -> String {
    let summary = Summary::of(report);
    let units = report.units;
    let verdict = verdict(report, &summary);
    let mut blocks = vec![
        Block { keep: 9, lines: title(report, page) },
        Block { keep: 9, lines: headline(&verdict, report, &summary, page) },
        blank(),
    ];
    blocks.extend(causes(report, &summary, beside.remedy, page));
    blocks.extend(facts(&summary.facts, units, page));
    blocks.extend(report.sections.iter().filter_map(|section| section.table.as_ref()).map(|table| Block {
        keep: 9,
        lines: std::iter::once(String::new()).chain(table_lines(table, units, page)).collect(),
    }));
    if summary.facts.is_empty() && report.sections.iter().all(|section| section.table.is_none()) {
        blocks.extend(words_of_sections(report, page));
    }
    blocks.extend(design(report));
    blocks.extend(margins(&summary, units, page));
    blocks.extend(notes(report, page));
    blocks.extend(files(report, page));
    blocks.push(Block { keep: 9, lines: last(&verdict, report, beside.written, page) });
    let lines = fitted(blocks, height);
    lines.into_iter().map(|line| line + "\n").collect()
}

/// Name, kind and speed; without the speed of the camshaft where the line is full.
fn title(report: &Report, page: Page) -> Vec<String> {
    let whole = format!("{} · {}{}", report.machine, report.noun, report.speeds());
    let is_full = whole.chars().count() > width_of(page);
    let title = if is_full { format!("{} · {}{}", report.machine, report.noun, report.rpm) } else { whole };
    lines_in(&plain(&title), 2, page)
}

fn blank() -> Block {
    Block { keep: 9, lines: vec![String::new()] }
}

/// "PASS 17 of 17", "FAIL 2 of 18"; empty where nothing was judged.
fn verdict(report: &Report, summary: &Summary<'_>) -> String {
    let Summary { judged, failed, warnings, .. } = summary;
    let warned = if warnings.len() == 1 { "warning" } else { "warnings" };
    match (report.passed(), *judged, warnings.len()) {
        (_, 0, _) => String::new(),
        (true, all, 0) => format!("PASS {all} of {all}"),
        (true, all, some) => format!("PASS {all} of {all}, {some} {warned}"),
        (false, all, _) => format!("FAIL {} of {all}", failed.len()),
    }
}

/// The verdict and what decides it.
fn headline(verdict: &str, report: &Report, summary: &Summary<'_>, page: Page) -> Vec<String> {
    let units = report.units;
    let told = match (summary.failed.first(), summary.answer, summary.tightest) {
        (Some(failed), ..) => asked(failed, units),
        (None, Some(answer), _) => answer.in_unit(units),
        (None, None, Some(tightest)) => format!("tightest: {}", sentence(tightest, units)),
        (None, None, None) => String::new(),
    };
    joined_line(&[verdict, &told], page)
}

/// The parts of a line of the verdict, those that are empty left out.
fn joined_line(parts: &[&str], page: Page) -> Vec<String> {
    let parts: Vec<&str> = parts.iter().copied().filter(|part| !part.is_empty()).collect();
    if parts.is_empty() {
        return Vec::new();
    }
    let lines = lines_in(&plain(&parts.join(" · ")), 2, page);
    lines.iter().map(|line| painted_word(line, page)).collect()
}

/// "pressure angle 29.996° of at most 30° at 45.8°".
fn sentence(finding: &Finding, units: LengthUnit) -> String {
    let limit = limit_words(finding, units).map_or_else(String::new, |limit| format!(" of {limit}"));
    let place = place(finding, units);
    let place = if place.is_empty() { place } else { format!(" at {place}") };
    format!("{} {}{limit}{place}", finding.title(), finding.brief_value(units))
}

/// "jump speed 343.9 rpm, at least 650 rpm is asked, at 299.2°"; the note of a check that fails although its figure keeps the limit.
fn asked(finding: &Finding, units: LengthUnit) -> String {
    let keeps = finding.margin().is_some_and(|used| used <= 1.0);
    if let Some(note) = finding.note.as_ref().filter(|_| finding.verdict == Verdict::Fail && keeps) {
        return format!("{}: {}", finding.title(), note.in_unit(units));
    }
    let limit = limit_words(finding, units).map_or_else(String::new, |limit| format!(", {limit} is asked"));
    let place = place(finding, units);
    let place = if place.is_empty() { place } else { format!(", at {place}") };
    format!("{} {}{limit}{place}", finding.title(), finding.brief_value(units))
}

fn limit_words(finding: &Finding, units: LengthUnit) -> Option<String> {
    let limit = finding.brief_limit(units)?;
    let side = finding.bound.map_or("", Bound::words);
    Some(format!("{side} {limit}").trim_start().to_owned())
}

/// "45.8°", or "x 180.0 mm" of a plate.
fn place(finding: &Finding, units: LengthUnit) -> String {
    match (finding.place.cam_deg, finding.place.x_mm) {
        (Some(angle), _) => format!("{:.1}°", if angle < 359.95 { angle } else { 0.0 }),
        (None, Some(x)) => format!("x = {}", Length::mm(x).decimals(1).in_unit(units)),
        (None, None) => String::new(),
    }
}

/// The place in a column of seven characters.
fn short_place(finding: &Finding, units: LengthUnit) -> String {
    match (finding.place.cam_deg, finding.place.x_mm) {
        (None, Some(x)) => format!("x {}", Length::mm(x).decimals(0).bare().in_unit(units)),
        _ => place(finding, units),
    }
}

/// Why it failed and what was tried against it, or what whoever cuts the cam should know first.
fn causes(report: &Report, summary: &Summary<'_>, remedy: Option<&TriedRemedy>, page: Page) -> Vec<Block> {
    let units = report.units;
    let mut blocks = Vec::new();
    let why = |finding: &Finding| {
        let without = finding.note.as_ref().filter(|_| remedy.is_some()).map(Text::without_remedies);
        without.or_else(|| finding.note.clone()).filter(|note| !note.is_empty())
    };
    for (index, failed) in summary.failed.iter().enumerate() {
        // The first is in the headline.
        let name = if index == 0 { Text::default() } else { Text::from(failed.title()) };
        if let Some(why) = why(failed) {
            let label = if blocks.is_empty() { "cause" } else { "" };
            let lines = labelled(label, &name.and(": ", why).in_unit(units), page);
            blocks.push(Block { keep: if index == 0 { 9 } else { 4 }, lines });
        }
    }
    if let Some(remedy) = remedy {
        let typed = |(change, now): &(KeyChange, Option<String>)| {
            let now = now.as_ref().map_or_else(String::new, |now| format!("  (now {now})"));
            format!("{}{now}", change.in_unit(units))
        };
        let mut lines: Vec<String> = Vec::new();
        for (index, change) in remedy.changes.iter().enumerate() {
            lines.extend(labelled(if index == 0 { "remedy" } else { "" }, &typed(change), page));
        }
        let together = if remedy.changes.len() > 1 { "tried together" } else { "tried" };
        lines.extend(labelled("", &format!("{together}: PASS {0} of {0}", remedy.judged), page));
        let costs: Vec<String> =
            remedy.costs.iter().map(|cost| format!("{} {}", cost.topic.label, cost.text.in_unit(units))).collect();
        if !costs.is_empty() {
            lines.extend(labelled("it costs", &costs.join("; "), page));
        }
        blocks.push(Block { keep: 9, lines });
    }
    for (index, warning) in summary.warnings.iter().enumerate() {
        let label = if index == 0 { "warning" } else { "" };
        let note = warning.note.as_ref().map(|note| note.in_unit(units));
        let note = note.map_or_else(String::new, |note| format!(": {note}"));
        let lines = labelled(label, &format!("{}{note}", sentence(warning, units)), page);
        blocks.push(Block { keep: if index == 0 { 9 } else { 7 }, lines });
    }
    if !blocks.is_empty() {
        blocks.push(blank());
    }
    blocks
}

/// The facts, a line or two each.
fn facts(facts: &[Fact], units: LengthUnit, page: Page) -> Vec<Block> {
    let keep = |fact: &Fact| match fact.topic {
        Topic::SIZE | Topic::STRESS | Topic::FORCE | Topic::TORQUE => 8,
        Topic::PEAKS | Topic::ROLLER => 3,
        _ => 6,
    };
    facts
        .iter()
        .map(|fact| Block {
            keep: keep(fact),
            lines: labelled(fact.topic.label, &plain(&fact.text.in_unit(units)), page),
        })
        .collect()
}

/// The words of the sections of a report that has neither facts nor a table.
fn words_of_sections(report: &Report, page: Page) -> Vec<Block> {
    let words_of = |section: &camgen::report::Section| -> Vec<Block> {
        let lines = section.words.iter().enumerate().map(|(index, words)| {
            let label = if index == 0 { &*section.key } else { "" };
            labelled(label, &plain(&words.text.in_unit(report.units)), page)
        });
        lines.enumerate().map(|(index, lines)| Block { keep: if index < 3 { 8 } else { 2 }, lines }).collect()
    };
    report.sections.iter().flat_map(words_of).collect()
}

/// The table of a machine file that an analysis found, to be pasted there.
fn design(report: &Report) -> Option<Block> {
    let section = report.sections.iter().find(|section| section.key == DESIGN && section.facts.is_empty())?;
    let line = |(index, words): (usize, &camgen::report::ReportLine)| {
        let label = if index == 0 { DESIGN } else { "" };
        format!("  {label:<width$}{}", plain(&words.text.in_unit(report.units)), width = TEXT - 2)
    };
    let lines = std::iter::once(String::new()).chain(section.words.iter().enumerate().map(line)).collect();
    Some(Block { keep: 9, lines })
}

/// The checks that use most of their limits, those with room in a line, and those of what was written.
fn margins(summary: &Summary<'_>, units: LengthUnit, page: Page) -> Vec<Block> {
    let mut blocks = Vec::new();
    if !summary.margins.is_empty() {
        let (tightest, more) = summary.margins.split_at(summary.margins.len().min(3.max(summary.failed.len())));
        let head = format!("  {:<20}{:>13}  {:<17}{:>7}{:>19}", "margins", "value", "limit", "used", "at");
        let rows = tightest.iter().map(|finding| margin(finding, units, page));
        blocks.push(Block { keep: 7, lines: [String::new(), head].into_iter().chain(rows).collect() });
        blocks.extend(more.iter().map(|finding| Block { keep: 3, lines: vec![margin(finding, units, page)] }));
    }
    if summary.roomy > 0 {
        let have = if summary.roomy == 1 { "has" } else { "have" };
        blocks.push(Block { keep: 5, lines: vec![format!("    {} more {have} room (-v)", summary.roomy)] });
    }
    for (index, finding) in summary.not_run.iter().take(MOST_NOTES).enumerate() {
        let label = if index == 0 { "not run" } else { "" };
        let why = finding.missing.as_deref().unwrap_or_default();
        let lines = labelled(label, &plain(&format!("{}: {why}", finding.title())), page);
        blocks.push(Block { keep: 6, lines });
    }
    if summary.not_run.len() > MOST_NOTES {
        let lines = labelled("", &format!("and {} more (-v)", summary.not_run.len() - MOST_NOTES), page);
        blocks.push(Block { keep: 6, lines });
    }
    let filled = |finding: &&Finding| {
        let value = finding.brief_value(units);
        finding.brief_limit(units).map(|limit| format!("{} {} of {limit}", finding.title(), value.number))
    };
    let as_cut: Vec<String> = summary.as_cut.iter().filter_map(filled).collect();
    if !as_cut.is_empty() {
        let words = format!("{}: the tolerance is filled on purpose", as_cut.join(", "));
        blocks.push(Block { keep: 5, lines: labelled("as cut", &words, page) });
    }
    blocks
}

/// A row of the margins: name, value, limit, what is used of it, a bar or FAIL, and the place.
fn margin(finding: &Finding, units: LengthUnit, page: Page) -> String {
    let passed = finding.verdict == Verdict::Pass;
    let used = finding.margin().map(|used| if passed { used.min(FULLEST_PASS) } else { used });
    let share = used.map_or_else(String::new, |used| format!("{} %", significant(100.0 * used, 3)));
    let bar = match used {
        _ if !passed => finding.verdict.word().to_owned(),
        Some(used) => {
            let filled = (1..=BAR).filter(|cell| f64::from(*cell) <= used * f64::from(BAR)).count();
            "█".repeat(filled) + &"░".repeat(usize::from(BAR) - filled)
        }
        None => String::new(),
    };
    let limit = limit_words(finding, units).unwrap_or_default();
    let (title, value, place) = (finding.title(), finding.brief_value(units).to_string(), short_place(finding, units));
    // What is wide takes the blanks of its neighbour.
    let rest = 31_usize.saturating_sub(title.chars().count()).max(value.chars().count() + 1);
    let name = format!("    {title}{value:>rest$}");
    let row = format!("{name}  {limit:<17}{share:>7}  {bar:<10} {place:>6}");
    painted_word(row.trim_end(), page)
}

/// The first notes of the report.
fn notes(report: &Report, page: Page) -> Vec<Block> {
    let mut blocks: Vec<Block> = report
        .notes
        .iter()
        .take(MOST_NOTES)
        .enumerate()
        .map(|(index, note)| {
            let lines = labelled(if index == 0 { "note" } else { "" }, &plain(&note.in_unit(report.units)), page);
            let is_short = lines.len() <= SHORT_NOTE;
            Block { keep: if index == 0 && is_short { 7 } else { 2 }, lines }
        })
        .collect();
    if report.notes.len() > MOST_NOTES {
        let more = format!("and {} more (-v)", report.notes.len() - MOST_NOTES);
        blocks.push(Block { keep: 1, lines: labelled("", &more, page) });
    }
    blocks
}

/// The files by what their names share.
fn files(report: &Report, page: Page) -> Vec<Block> {
    if report.files.is_empty() {
        return Vec::new();
    }
    let stem = shared_stem(&report.files);
    let endings: Vec<&str> = report.files.iter().filter_map(|file| file.get(stem.len()..)).collect();
    let words = if endings.iter().any(|ending| ending.is_empty()) || endings.len() == 1 {
        report.files.join(" ")
    } else {
        format!("{stem} {}", endings.join(" "))
    };
    vec![
        // Goes before a fact does.
        Block { keep: 4, lines: vec![String::new()] },
        Block { keep: 9, lines: labelled("files", &plain(&words), page) },
    ]
}

/// What the names of all files begin with, up to a mark behind which an ending begins.
fn shared_stem(files: &[String]) -> &str {
    let Some(first) = files.first() else { return "" };
    let shared = files.iter().fold(first.len(), |shared, file| {
        let same = first.bytes().zip(file.bytes()).take_while(|(one, other)| one == other).count();
        shared.min(same)
    });
    let ends = first.char_indices().filter(|(at, mark)| *at <= shared && matches!(mark, '.' | '-')).map(|(at, _)| at);
    ends.max().and_then(|end| first.get(..end)).unwrap_or_default()
}

/// The verdict again, and what became of the files.
fn last(verdict: &str, report: &Report, written: Written, page: Page) -> Vec<String> {
    let count = report.files.len();
    let folder = report.files.first().and_then(|file| file.rsplit_once('/')).map_or(".", |(folder, _)| folder);
    let files = format!("{count} {} in {folder}/", if count == 1 { "file" } else { "files" });
    let told = match (report.passed(), count, written) {
        (true, 0, Written::DryRun) => "nothing was written (--dry-run)".into(),
        (true, 0, Written::Listed) => String::new(),
        (true, ..) => files,
        (false, 0, Written::DryRun) => "without --dry-run nothing would be written (--force would write)".into(),
        (false, 0, Written::Listed) => "nothing was written (--force writes, marked NOT FOR MANUFACTURE)".into(),
        (false, ..) => format!("{files}, marked NOT FOR MANUFACTURE"),
    };
    let cut = report.passed() && report.checks.iter().any(|finding| finding.is_as_cut);
    let may_be_cut = if cut { "may be cut" } else { "" };
    joined_line(&[verdict, may_be_cut, &told], page)
}

/// Checks whose figure is a count of one or nothing: their note is the finding.
const TOLD_BY_NOTE: [&str; 2] = ["layer", "units"];
/// What only changes the form of a file.
const OF_ITS_FORM: [&str; 4] = ["layer", "units", "duplicates", "tangency"];
/// A finding in words; its note alone where the figure is a count of one or nothing, or there is none.
fn told(finding: &Finding, units: LengthUnit) -> String {
    let note = finding.note.as_ref().map(|note| note.in_unit(units)).filter(|note| !note.is_empty());
    let by_note = TOLD_BY_NOTE.contains(&&*finding.check) || finding.check == "bore" && !finding.value.is_finite();
    match note {
        Some(note) if by_note => note,
        Some(note) => format!("{}: {note}", asked(finding, units)),
        None => asked(finding, units),
    }
}

/// In a few words why the outline is that of the cam but the file is not, and what to do.
fn but(finding: &Finding, report: &Report) -> (String, &'static str) {
    let beside = report.section(CUT_BESIDE);
    let count = |key: &str| beside.and_then(|beside| beside.get(key)?.as_u64()).unwrap_or(0);
    let is_hidden = beside.and_then(|beside| beside.get("hidden")?.as_bool()).unwrap_or(false);
    match &*finding.check {
        "bore" => match (count("more"), count("missing")) {
            (0, 0) => (
                "its bore is another one".into(),
                "correct the bore of the file; if the file is right: set cam.bore_radius, cam.keyway and cam.balance as in it",
            ),
            (0, _) => ("its bore would not be cut".into(), "add the bore to the file, or bore it in another operation"),
            (more, 0) => {
                let things = if more == 1 { "thing" } else { "things" };
                (
                    format!("{more} {things} more would be cut"),
                    "if wanted: draw it on a layer that is not cut, or cut layers CAM_PROFILE and BORE only",
                )
            }
            _ => ("more and less would be cut".into(), "correct the file: its bore is missing, and more would be cut"),
        },
        "layer" if is_hidden => {
            ("its outline lies on a layer that is off".into(), "switch the layer on, and save the file")
        }
        "layer" => (
            "its outline lies on another layer".into(),
            "put the outline on CAM_PROFILE and delete the rest of that layer, or give --layer",
        ),
        "units" => ("its unit is not known".into(), "save the file in millimetres"),
        "readable" => {
            ("it has more than curves".into(), "delete or explode the entities that are named, and save the file")
        }
        "duplicates" => {
            ("some of it would be cut twice".into(), "delete the segments that are named (OVERKILL in AutoCAD)")
        }
        _ => (asked(finding, report.units), "correct the file"),
    }
}

/// The summary of a checked file: whether it is the cam, and why not.
pub(in crate::cli) fn check_summary(file: &str, report: &Report, page: Page) -> String {
    let summary = Summary::of(report);
    let units = report.units;
    let verdict = FileVerdict::of(report);
    let (word, last) = match verdict {
        FileVerdict::ThisCam => ("THIS CAM", "may be cut"),
        FileVerdict::ThisCamBut => ("THIS CAM, BUT", "not as it is · exit code 1"),
        FileVerdict::NotJudged => ("NOT JUDGED", "do not cut it unseen · exit code 1"),
        FileVerdict::NotThisCam => ("NOT THIS CAM", "do not cut"),
    };
    let is_outline = |finding: &&Finding| matches!(&*finding.check, "outline" | "cutter_path");
    let outline = report.checks.iter().filter(is_outline).find(|finding| finding.verdict == Verdict::Pass);
    let within = outline.map(|outline| {
        let limit = outline.brief_limit(units).map_or_else(String::new, |limit| format!(" ({limit} allowed)"));
        format!("outline within {} of the exact cam{limit}", outline.brief_value(units))
    });
    let diagnosis = report.sections.iter().find(|section| section.key == "diagnosis");
    let explained = diagnosis.and_then(|section| named_cause(&section.value));
    let (head, told_in_head) = match (verdict, summary.failed.first(), within) {
        (FileVerdict::ThisCamBut, Some(failed), within) => {
            // What a shop would cut is asked first.
            let named = |check: &str| summary.failed.iter().find(|finding| finding.check == check);
            let first = named("layer").or_else(|| named("bore")).unwrap_or(failed);
            (format!("{word} {}", but(first, report).0), within.unwrap_or_default())
        }
        (FileVerdict::NotThisCam, Some(failed), _) => {
            (word.to_owned(), explained.unwrap_or_else(|| asked_or_told(failed, units)))
        }
        (_, Some(failed), _) => (word.to_owned(), asked_or_told(failed, units)),
        (_, None, Some(within)) => (word.to_owned(), within),
        (_, None, None) => (word.to_owned(), format!("{} checks pass", summary.judged)),
    };
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let first = format!("{name} · against {}, {}{}", report.machine, report.noun, report.rpm);
    let lines = [lines_in(&plain(&first), 2, page), joined_line(&[&head, &told_in_head], page), vec![String::new()]];
    let mut blocks = vec![Block { keep: 9, lines: lines.concat() }];
    for section in report.sections.iter().filter(|section| ["diagnosis", "design", NOT_JUDGED].contains(&&*section.key))
    {
        let label = if section.key == "design" { "design" } else { "evidence" };
        for (index, words) in section.words.iter().enumerate() {
            let text = plain(&words.text.in_unit(units)).into_owned();
            blocks.push(Block { keep: 8, lines: labelled(if index == 0 { label } else { "" }, &text, page) });
        }
    }
    for (index, finding) in summary.failed.iter().chain(&summary.warnings).enumerate() {
        let text = plain(&told(finding, units)).into_owned();
        let label = match finding.verdict {
            Verdict::Fail => "wrong",
            _ if OF_ITS_FORM.contains(&&*finding.check) => "note",
            _ => "warning",
        };
        blocks.push(Block { keep: if index < 2 { 8 } else { 6 }, lines: labelled(label, &text, page) });
        // Its bore makes them fail.
        let follows = matches!(&*finding.check, "holes" | "volume");
        if verdict == FileVerdict::ThisCamBut && finding.verdict == Verdict::Fail && !follows {
            blocks.push(Block { keep: 7, lines: labelled("remedy", but(finding, report).1, page) });
        }
    }
    let judged_right = |finding: &&Finding| matches!(finding.verdict, Verdict::Pass | Verdict::Info);
    for finding in report.checks.iter().filter(judged_right).filter(|finding| OF_ITS_FORM.contains(&&*finding.check)) {
        if let Some(note) = finding.note.as_ref().map(|note| note.in_unit(units)).filter(|note| !note.is_empty()) {
            blocks.push(Block { keep: 6, lines: labelled("note", &plain(&note), page) });
        }
    }
    if let Some(radius) = diagnosis.and_then(|section| offset_outward(&section.value)) {
        let radius = significant(radius, 4);
        let words = format!("the path of the centre of a cutter: then check it with --cutter-radius {radius}mm");
        blocks.push(Block { keep: 8, lines: labelled("likely", &words, page) });
    }
    let passed: Vec<String> =
        report.checks.iter().filter(|finding| finding.verdict == Verdict::Pass).map(Finding::title).collect();
    if !passed.is_empty() {
        blocks.push(Block { keep: 7, lines: labelled("passed", &passed.join(", "), page) });
    }
    blocks.extend(notes(report, page));
    blocks.push(blank());
    blocks.push(Block { keep: 9, lines: joined_line(&[word, last], page) });
    fitted(blocks, HEIGHT).into_iter().map(|line| line + "\n").collect()
}

/// "cause: offset, 8.000 mm", the first one of a diagnosis.
fn named_cause(diagnosis: &serde_json::Value) -> Option<String> {
    let first = diagnosis.get(0)?;
    let cause = first.get("cause")?.as_str()?;
    let unit = first.get("unit").and_then(serde_json::Value::as_str).filter(|unit| *unit != "1").unwrap_or_default();
    let value = first.get("value").and_then(serde_json::Value::as_f64);
    let value = value.map_or_else(String::new, |value| format!(", {} {unit}", significant(value, 4)));
    Some(format!("cause: {cause}{}", value.trim_end()))
}

/// The distance by which a diagnosis finds an outline offset outward and nothing else, mm.
fn offset_outward(diagnosis: &serde_json::Value) -> Option<f64> {
    let first = diagnosis.get(0)?;
    let value = first.get("value")?.as_f64().filter(|value| *value > 0.0)?;
    (first.get("cause")?.as_str()? == "offset").then_some(value)
}

/// A finding in a line: its note where the figure is a count of one or nothing.
fn asked_or_told(finding: &Finding, units: LengthUnit) -> String {
    if TOLD_BY_NOTE.contains(&&*finding.check) { told(finding, units) } else { asked(finding, units) }
}

/// A table under its heads, words at the left and numbers at the right of their columns.
fn table_lines(table: &SummaryTable, units: LengthUnit, page: Page) -> Vec<String> {
    let texts = |row: &[Text]| row.iter().map(|cell| plain(&cell.in_unit(units)).into_owned()).collect::<Vec<String>>();
    let heads = texts(&table.heads.iter().map(|column| column.head.clone()).collect::<Vec<_>>());
    let units_row = texts(&table.heads.iter().map(|column| column.unit.clone()).collect::<Vec<_>>());
    let rows: Vec<Vec<String>> = table.rows.iter().map(|row| texts(row)).collect();
    let all: Vec<&Vec<String>> = [&heads, &units_row].into_iter().chain(&rows).collect();
    let widths: Vec<usize> = (0..table.heads.len())
        .map(|column| all.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0))
        .collect();
    let line = |row: &[String]| {
        let cells = row.iter().zip(&widths).zip(&table.heads).map(|((cell, width), column)| {
            if column.is_words { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
        });
        cells.collect::<Vec<String>>().join("  ").trim_end().to_owned()
    };
    let mut lines = vec![format!("    {}", line(&heads))];
    if units_row.iter().any(|unit| !unit.is_empty()) {
        lines.push(format!("    {}", line(&units_row)));
    }
    for (index, row) in rows.iter().enumerate() {
        let mark = if table.marked == Some(index) { "  ▶ " } else { "    " };
        lines.push(format!("{mark}{}", line(row)));
    }
    let rest = table.rest.iter().flat_map(|rest| lines_in(&format!("    {}", plain(&rest.in_unit(units))), 4, page));
    lines.extend(rest);
    lines
}

/// A text behind a label, its further lines below its beginning.
fn labelled(label: &str, text: &str, page: Page) -> Vec<String> {
    let indent = TEXT - 2;
    let line =
        if label.chars().count() < indent { format!("  {label:<indent$}{text}") } else { format!("  {label} {text}") };
    lines_in(&line, TEXT, page)
}

fn width_of(page: Page) -> usize {
    page.width.unwrap_or(WIDTH).max(WIDTH)
}

/// A line broken where it is wider than a summary.
fn lines_in(line: &str, indent: usize, page: Page) -> Vec<String> {
    let whole = wrapped(line, indent, Page { width: Some(width_of(page)), ..page });
    whole.lines().map(str::to_owned).collect()
}

/// The lines of blocks, without those that a short page has no room for.
fn fitted(mut blocks: Vec<Block>, height: usize) -> Vec<String> {
    let count = |blocks: &[Block]| blocks.iter().map(|block| block.lines.len()).sum::<usize>();
    while count(&blocks) > height {
        let least = blocks.iter().map(|block| block.keep).min().unwrap_or(9);
        let Some(last) = blocks.iter().rposition(|block| block.keep == least && least < 9) else { break };
        blocks.remove(last);
    }
    let mut lines: Vec<String> = blocks.into_iter().flat_map(|block| block.lines).collect();
    lines.dedup_by(|next, before| next.is_empty() && before.is_empty());
    lines
}
