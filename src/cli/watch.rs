//! `--watch`: runs the command again whenever a file changes, until Ctrl-C.

use super::input_files;
use super::{Failure, Outcome, print_message};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Period between looks at the files.
const PERIOD: Duration = Duration::from_millis(300);

/// Time of the last change of a file, and its size; `None` while it is absent, for example while an editor replaces it.
type FileStamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> FileStamp {
    let data = fs::metadata(path).ok()?;
    Some((data.modified().ok()?, data.len()))
}

/// Runs a command now and after each change; its errors are printed and do not end it.
pub(super) fn run(files: &[PathBuf], command: impl Fn() -> Result<Outcome, Failure>) -> Result<Outcome, Failure> {
    if let Some(missing) = files.iter().find(|file| !file.is_file()) {
        let why = "--watch needs a file to watch";
        return Err(Failure(format!(
            "{why}, and there is no file `{}`; `camgen init FILE` writes one",
            missing.display()
        )));
    }
    let mut named: Vec<PathBuf> = Vec::new();
    loop {
        let before = stamps(files, &named);
        if let Err(failure) = command() {
            print_message(&format!("error: {failure}"));
        }
        // The tables that the machine file names are known once it has been read. One that is new is looked at from now on.
        let found: Vec<PathBuf> =
            input_files::files().named().into_iter().filter(|file| !files.contains(file)).collect();
        let seen = if found == named {
            before
        } else {
            before.into_iter().take(files.len()).chain(stamps(&[], &found)).collect()
        };
        named = found;
        let names: Vec<String> = files.iter().chain(&named).map(|file| file.display().to_string()).collect();
        print_message(&format!("── waiting for changes of {}; Ctrl-C stops", names.join(", ")));
        wait(&seen, files.len(), || stamps(files, &named));
    }
}

fn stamps(files: &[PathBuf], named: &[PathBuf]) -> Vec<FileStamp> {
    files.iter().chain(named).map(|file| stamp(file)).collect()
}

/// Waits for a change that is complete: the first of the files are there then. Others may be missing, and the command says so.
fn wait(seen: &[FileStamp], needed: usize, stamps: impl Fn() -> Vec<FileStamp>) {
    let mut last = seen.to_vec();
    loop {
        std::thread::sleep(PERIOD);
        let now = stamps();
        let at_rest = now == last && now.iter().take(needed).all(Option::is_some);
        if at_rest && now != seen {
            return;
        }
        last = now;
    }
}
