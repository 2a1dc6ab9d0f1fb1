//! `--watch`: the command again whenever a file changes, until Ctrl-C.

use super::{Failure, Outcome, tell};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Files are looked at so often.
const PERIOD: Duration = Duration::from_millis(300);

/// When a file was changed, and its size; `None` while it is not there, as between the two steps of an editor that replaces it.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let data = fs::metadata(path).ok()?;
    Some((data.modified().ok()?, data.len()))
}

/// Runs a command now and after each change; its errors are told and do not end it.
pub(super) fn run(files: &[PathBuf], command: impl Fn() -> Result<Outcome, Failure>) -> Result<Outcome, Failure> {
    if let Some(missing) = files.iter().find(|file| !file.is_file()) {
        let why = "--watch needs a file to look at";
        return Err(Failure(format!(
            "{why}, and there is no file `{}`; `camgen init FILE` writes one",
            missing.display()
        )));
    }
    let stamps = || files.iter().map(|file| stamp(file)).collect::<Vec<Stamp>>();
    loop {
        let seen = stamps();
        if let Err(failure) = command() {
            tell(&format!("error: {failure}"));
        }
        let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
        tell(&format!("── waiting for changes of {}; Ctrl-C ends", names.join(", ")));
        wait(&seen, stamps);
    }
}

/// Waits for a change that has come to rest.
fn wait(seen: &[Stamp], stamps: impl Fn() -> Vec<Stamp>) {
    let mut last = seen.to_vec();
    loop {
        std::thread::sleep(PERIOD);
        let now = stamps();
        let at_rest = now == last && now.iter().all(Option::is_some);
        if at_rest && now != seen {
            return;
        }
        last = now;
    }
}
