//! `camgen study`: a row of figures for each of many designs.

use super::args::StudyArgs;
use super::progress::Progress;
use super::{Failure, Outcome, print, print_message};
use camgen::report::shown;
use camgen::study::{Journal, Study, StudyFiles, StudyKind, Summary, embedded};
use std::io::IsTerminal;
use std::time::Instant;

pub(super) fn run(args: &StudyArgs) -> Result<Outcome, Failure> {
    if args.show {
        return show(&args.study);
    }
    let study = Study::load(&args.study).map_err(Failure::new)?;
    let needs = if study.proves() { "solved, drawn and proved" } else { "solved, not drawn" };
    if args.dry_run {
        let text = format!("{}: {} designs, each {needs}\n{}", study.name(), study.count(), study.header());
        return if args.quiet { Ok(Outcome::Fine) } else { print(&text).map(|()| Outcome::Fine) };
    }
    let stem = args.name.as_deref().unwrap_or(study.stem());
    let files = StudyFiles { page: args.page, parquet: args.parquet, overwrite: args.overwrite, restart: args.restart };
    let mut journal = Journal::open(&study, &args.out, stem, files).map_err(Failure::new)?;
    let first = journal.done();
    if first > 0 && !args.quiet {
        print_message(&format!("continues an interrupted run with row {first} of {}", study.count()));
    }
    let progress = Progress::of_rows(!args.quiet && std::io::stderr().is_terminal(), study.count(), first);
    let start = Instant::now();
    study
        .each(first, |done, lines| {
            progress.reached(done);
            journal.add(done, lines)
        })
        .map_err(Failure::new)?;
    let seconds = start.elapsed().as_secs_f64();
    drop(progress);
    let (summary, json, written) = journal.finish(&study, files).map_err(Failure::new)?;
    if args.json {
        print(&format!("{json:#}\n"))?;
    } else if !args.quiet {
        print(&text(&study, needs, &summary))?;
        let names: Vec<String> =
            written.iter().map(|path| format!("  {}\n", camgen::report::listed_path(path))).collect();
        print(&format!("files\n{}", names.concat()))?;
    }
    if !args.quiet && study.count() > first {
        #[expect(clippy::cast_precision_loss, reason = "a count for people")]
        let rows = (study.count() - first) as f64;
        let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        print_message(&format!(
            "{} rows in {} s: {} rows a second, {} ms a row, on {threads} processors",
            study.count() - first,
            shown(seconds),
            shown(rows / seconds),
            shown(1e3 * seconds / rows)
        ));
    }
    Ok(if summary.feasible == 0 { Outcome::CheckFailed } else { Outcome::Fine })
}

/// Prints the text of an embedded study.
fn show(name: &str) -> Result<Outcome, Failure> {
    let found = embedded().iter().find(|(other, _)| *other == name);
    let names: Vec<&str> = embedded().iter().map(|(name, _)| *name).collect();
    let (_, text) =
        found.ok_or_else(|| Failure(format!("no embedded study is called `{name}`; one of {}", names.join(", "))))?;
    print(text).map(|()| Outcome::Fine)
}

/// The summary for people.
fn text(study: &Study, needs: &str, summary: &Summary) -> String {
    let mut text = format!("{}, {}\n", study.name(), study.kind().word());
    text.push_str(&format!("designs {}, each {needs}; {} with a fault\n", study.count(), summary.faults));
    if !study.constraints().is_empty() {
        text.push_str(&format!("within every limit {}\n", summary.feasible));
    }
    if study.kind() == StudyKind::Pareto {
        text.push_str(&format!("beaten by no other {}\n", summary.front.len()));
    }
    let width = summary.columns.iter().map(|of| of.name.len()).max().unwrap_or(0);
    text.push_str(&format!(
        "{:width$} {:>12} {:>12} {:>12} {:>12}\n",
        "figure", "least", "mean", "deviation", "largest"
    ));
    for of in &summary.columns {
        let numbers = [of.range.0, of.mean, of.deviation(), of.range.1].map(|value| format!("{:>12}", shown(value)));
        text.push_str(&format!("{:width$} {}\n", of.name, numbers.join(" ")));
    }
    for (reason, rows) in &summary.reasons {
        text.push_str(&format!("fault of {rows} designs: {reason}\n"));
    }
    text
}
