//! Files of a command: written beside their places, told, then put there. What cannot be told is not written, and exit code 0 means that
//! both were done.

use super::Failure;
use super::signals::Signals;
use camgen::FileSet;
use camgen::report::Told;
use camgen::write::files::{Place, Staged};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// While the report is told, signals are looked for so often.
const PERIOD: Duration = Duration::from_millis(20);

/// The same for the files of a cam or an analysis.
pub(super) fn put_set(files: FileSet<'_>, show: impl FnOnce(&Told<'_>) -> Result<(), Failure>) -> Result<(), Failure> {
    let place = files.open().map_err(Failure::new)?;
    placed(place, |place| files.stage(place).map_err(Failure::new), show)
}

/// Opens a directory, stages files there, shows what came with them, and puts them in their places.
pub(super) fn put<T>(
    directory: &Path,
    stage: impl FnOnce(Place) -> Result<(T, Staged), Failure>,
    show: impl FnOnce(&T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    placed(Place::open(directory).map_err(Failure::new)?, stage, show)
}

/// A signal to end that comes before the last step takes everything back; during it it waits until all is in place.
fn placed<T>(
    place: Place,
    stage: impl FnOnce(Place) -> Result<(T, Staged), Failure>,
    show: impl FnOnce(&T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let signals = Signals::held();
    let done = || {
        let (told, staged) = stage(place)?;
        shown(&staged, &signals, || show(&told))?;
        if signals.raised() {
            return Err(Failure("interrupted; nothing was changed".into()));
        }
        staged.commit().map_err(Failure::new)
    };
    let done = done();
    signals.released();
    done
}

/// Shows something, which may take as long as its reader wants: meanwhile a signal removes what is staged and ends the program.
fn shown(staged: &Staged, signals: &Signals, show: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
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
        // Where no thread is to be had the signal waits.
        let watching = thread::Builder::new().spawn_scoped(scope, watch);
        let shown = show();
        done.store(true, Ordering::SeqCst);
        if let Ok(watching) = watching {
            watching.thread().unpark();
        }
        shown
    })
}
