//! Files of a command: staged next to their targets, reported, then moved into place. Files whose report cannot be printed are not
//! written, and exit code 0 means that both were done.

use super::input_files::files;
use super::signals::Signals;
use super::{Failure, print_message};
use camgen::FileSet;
use camgen::report::LazyReport;
use camgen::write::files::{OutputDirectory, StagedFiles};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// Period of the checks for signals while the report is printed.
const PERIOD: Duration = Duration::from_millis(20);

/// Stages the files of a cam or an analysis, shows their report, and moves them into place.
pub(super) fn put_set(files: FileSet, show: impl FnOnce(&LazyReport) -> Result<(), Failure>) -> Result<(), Failure> {
    // Before it is said that --overwrite would replace them.
    let targets: Vec<PathBuf> = files.outputs().iter().map(|output| files.directory().join(&output.name)).collect();
    refuse_inputs(&targets)?;
    let place = files.open().map_err(Failure::new)?;
    stage_and_commit(place, |place| files.stage(place).map_err(Failure::new), show)
}

/// Opens a directory, stages files there, shows what came with them, and moves them into place.
pub(super) fn put<T>(
    directory: &Path,
    stage: impl FnOnce(OutputDirectory) -> Result<(T, StagedFiles), Failure>,
    show: impl FnOnce(&T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    stage_and_commit(OutputDirectory::open(directory).map_err(Failure::new)?, stage, show)
}

/// Stages files in an open directory, shows their notes, and moves the files into place. A signal to end before the last step undoes
/// everything; during that step it waits until all files are in place.
pub(super) fn stage_and_commit<T>(
    place: OutputDirectory,
    stage: impl FnOnce(OutputDirectory) -> Result<(T, StagedFiles), Failure>,
    show: impl FnOnce(&T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    // Also where the report is not printed: another user may have made them.
    for sentence in place.left() {
        print_message(&format!("warning: {sentence}"));
    }
    let signals = Signals::hold();
    let done = stage_and_commit_held(place, &signals, stage, show);
    signals.release();
    done
}

/// The same while signals are held.
fn stage_and_commit_held<T>(
    place: OutputDirectory,
    signals: &Signals,
    stage: impl FnOnce(OutputDirectory) -> Result<(T, StagedFiles), Failure>,
    show: impl FnOnce(&T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let (report, staged) = stage(place)?;
    refuse_inputs(&staged.targets())?;
    show_until_signal(&staged, signals, || show(&report))?;
    if signals.raised() {
        return Err(Failure("interrupted; nothing was changed".into()));
    }
    staged.commit().map_err(Failure::new)
}

/// Refuses to replace a file that was read, whatever flags say: it is an input, of which there may be no other copy.
pub(super) fn refuse_inputs(targets: &[PathBuf]) -> Result<(), Failure> {
    match targets.iter().find(|target| files().was_read(target)) {
        None => Ok(()),
        Some(input) => Err(Failure(format!(
            "`{}` was read as an input and is not replaced; nothing was written; choose another --name or --out",
            input.display()
        ))),
    }
}

/// Shows something, for as long as its reader takes: meanwhile a signal removes what is staged and ends the program.
fn show_until_signal(
    staged: &StagedFiles,
    signals: &Signals,
    show: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    let done = AtomicBool::new(false);
    let watch = || {
        while !done.load(Ordering::SeqCst) {
            if signals.raised() {
                staged.discard();
                signals.end();
            }
            thread::park_timeout(PERIOD);
        }
    };
    thread::scope(|scope| {
        // Without a thread the signal waits.
        let watching = thread::Builder::new().spawn_scoped(scope, watch);
        let shown = show();
        done.store(true, Ordering::SeqCst);
        if let Ok(watching) = watching {
            watching.thread().unpark();
        }
        shown
    })
}
