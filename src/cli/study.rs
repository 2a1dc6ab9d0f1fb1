//! `camgen study`: a row of figures for each of many designs.

use super::args::StudyArgs;
use super::input_files::files;
use super::progress::Progress;
use super::put::{refuse_inputs, stage_and_commit};
use super::{Failure, Outcome, print, print_message};
use camgen::report::{listed_path, shown};
use camgen::study::{CompleteStudy, Journal, Study, StudyError, StudyFiles, StudyKind, Summary, embedded};
use std::io::IsTerminal;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Interval between saves of finished rows; a killed run loses no more than that.
const SAVED_EVERY: Duration = Duration::from_secs(1);

pub(super) fn run(args: &StudyArgs) -> Result<Outcome, Failure> {
    if args.show {
        return show(&args.study);
    }
    let study = Study::load_with(&args.study, files()).map_err(Failure::new)?;
    let needs = if study.proves() { "solved, drawn and proved" } else { "solved, not drawn" };
    if args.dry_run {
        let text = format!("{}: {} designs, each {needs}\n{}", study.name(), study.count(), study.header());
        return if args.quiet { Ok(Outcome::Fine) } else { print(&text).map(|()| Outcome::Fine) };
    }
    let stem = args.name.as_deref().unwrap_or(study.stem());
    let files = StudyFiles { page: args.page, parquet: args.parquet, overwrite: args.overwrite, restart: args.restart };
    // Now, and not after hours.
    let targets: Vec<PathBuf> = files.names(&study, stem).iter().map(|name| args.out.join(name)).collect();
    refuse_inputs(&targets)?;
    let mut journal = Journal::open(&study, &args.out, stem, files).map_err(Failure::new)?;
    let first = journal.done();
    if first > 0 && !args.quiet {
        print_message(&format!("continues an interrupted run with row {first} of {}", study.count()));
    }
    let start = Instant::now();
    make_rows(args, &study, &mut journal).map_err(Failure::new)?;
    let seconds = start.elapsed().as_secs_f64();
    let summary = journal.summary(&study).map_err(Failure::new)?;
    let feasible = summary.feasible;
    let place = journal.reopened().map_err(Failure::new)?;
    stage_and_commit(
        place,
        |place| journal.stage(place, &study, summary).map_err(Failure::new),
        |complete| show_complete(args, &study, needs, complete),
    )?;
    if !args.quiet && study.count() > first {
        print_message(&rate(study.count() - first, seconds));
    }
    Ok(if feasible == 0 { Outcome::CheckFailed } else { Outcome::Fine })
}

/// Makes the missing rows.
fn make_rows(args: &StudyArgs, study: &Study, journal: &mut Journal) -> Result<(), StudyError> {
    let first = journal.done();
    let progress = Progress::of_rows(!args.quiet && std::io::stderr().is_terminal(), study.count(), first);
    let mut saved = Instant::now();
    study.each(first, |done, lines| {
        progress.reached(done);
        journal.add(done, lines)?;
        if saved.elapsed() >= SAVED_EVERY {
            journal.save()?;
            saved = Instant::now();
        }
        Ok(())
    })
}

/// Prints the results of a complete study.
fn show_complete(args: &StudyArgs, study: &Study, needs: &str, complete: &CompleteStudy) -> Result<(), Failure> {
    if args.json {
        return print(&format!("{:#}\n", complete.json));
    }
    if args.quiet {
        return Ok(());
    }
    for note in &complete.notes {
        print_message(&format!("note: {note}"));
    }
    let names: Vec<String> = complete.written.iter().map(|path| format!("  {}\n", listed_path(path))).collect();
    print(&format!("{}files\n{}", text(study, needs, &complete.summary), names.concat()))
}

/// The rate at which rows were made, as text.
fn rate(count: u64, seconds: f64) -> String {
    #[expect(clippy::cast_precision_loss, reason = "a count for people")]
    let rows = count as f64;
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    format!(
        "{count} rows in {} s: {} rows a second, {} ms a row, on {threads} processors",
        shown(seconds),
        shown(rows / seconds),
        shown(1e3 * seconds / rows)
    )
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
