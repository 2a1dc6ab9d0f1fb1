//! Files of a command: written beside their places, told, then put there. What cannot be told is not written, and exit code 0 means that
//! both were done.

use super::Failure;
use super::signals::Signals;
use camgen::write::files::Staged;

/// Stages files, shows what came with them, and puts them in their places. A signal to end that comes before the last step takes
/// everything back; during it it waits until all is in place.
pub(super) fn put<T>(
    stage: impl FnOnce() -> Result<(T, Staged), Failure>,
    show: impl FnOnce(&T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let signals = Signals::held();
    let done = || {
        let (told, staged) = stage()?;
        show(&told)?;
        if signals.raised() {
            return Err(Failure("interrupted; nothing was changed".into()));
        }
        staged.commit().map_err(Failure::new)
    };
    let done = done();
    signals.released();
    done
}
