//! What interrupted runs leave in a directory: the record of a set that is not in its place yet, and files without a final name.
//!
//! Such a record says which files get which names, so whoever can put one into a directory could have any file replaced. It is finished only
//! where it and the record of the directory belong to the user who runs, and each file that it replaces is camgen's own by that
//! record. Any other record is reported and left, and never blocks a run: it takes the next free name for its own.

use super::directory::{Directory, FileStamp, NameState};
use super::error::FilesError;
use super::known::{DirectoryRecord, is_record, record_name};
use super::part::{is_marker, marker_of, part_of};
use camgen_kernel::document::shown;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io;

/// The record of a set that is written, while it is put in place; where that name is taken, a number follows.
pub(super) const COMMIT: &str = ".camgen-commit";
/// What the name of this record began with in earlier versions until it was whole.
const COMMIT_NEW: &str = ".camgen-commit-new-";
/// What the names of files begin with that have not got their final name yet.
const STAGED: &str = ".camgen-new-";
/// The largest record of a set that is read, bytes.
const LARGEST: u64 = 1 << 26;
/// The ends of the names of files that camgen writes.
const ENDINGS: [&str; 10] = ["dxf", "svg", "step", "csv", "json", "html", "pdf", "stl", "toml", "parquet"];
/// Characters of a name that are shown: such a record may have been made by anybody.
const LONGEST_SHOWN: usize = 80;
/// How many names are tried until one is free.
const MOST_NAMES: usize = 100_000;

/// A file that is written under a temporary name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct StagedFile {
    pub(super) staged: String,
    pub(super) target: String,
    /// What existed under the name of the target.
    pub(super) replaces: Option<FileStamp>,
}

impl StagedFile {
    /// Whether its content is a growing file, which stays if the set is undone.
    pub(super) fn has_grown(&self) -> bool {
        self.staged == part_of(&self.target)
    }
}

/// A record that was not finished.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct LeftRecord {
    /// Its name.
    name: String,
    /// Why it is left, a sentence.
    why: String,
    /// Its files, where it is the user's own.
    entries: Vec<StagedFile>,
}

impl LeftRecord {
    /// The sentence that reports it.
    pub(super) fn sentence(&self, directory: &Directory) -> String {
        let path = directory.path_of(&self.name);
        format!("`{}`, the record of an interrupted run, is left as it is: {}", path.display(), self.why)
    }

    /// Whether a set of these names replaces all that it would.
    pub(super) fn is_replaced_by(&self, names: &[&str]) -> bool {
        !self.entries.is_empty() && self.entries.iter().all(|entry| names.contains(&entry.target.as_str()))
    }

    /// The names that it leaves in the directory, its own the first.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        let staged = self.entries.iter().filter(|entry| !entry.has_grown()).map(|entry| entry.staged.as_str());
        std::iter::once(self.name.as_str()).chain(staged)
    }
}

/// What was found when a directory was opened.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// The files of interrupted runs that were put in place, for messages.
    pub(super) finished: Vec<String>,
    /// The records that were not.
    pub(super) left: Vec<LeftRecord>,
}

/// Whether a name begins so and ends with this many numbers.
fn is_numbered(name: &str, start: &str, numbers: usize) -> bool {
    let number = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    name.strip_prefix(start).is_some_and(|rest| rest.split('-').count() == numbers && rest.split('-').all(number))
}

/// Whether a name is that of the record of a set.
fn is_commit(name: &str) -> bool {
    name == COMMIT || is_numbered(name, &format!("{COMMIT}-"), 1)
}

/// Whether a name is one that a run gives to files that have not got their final names.
fn is_temporary(name: &str) -> bool {
    is_numbered(name, STAGED, 2) || is_numbered(name, COMMIT_NEW, 1)
}

/// Whether a name ends as those of the files that camgen writes, and is not hidden.
fn is_usual(name: &str) -> bool {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    !name.starts_with('.') && ENDINGS.contains(&ending)
}

/// Whether a name is a plain name in a directory, not a path.
pub(super) fn is_plain(name: &str) -> bool {
    !name.is_empty() && name != "." && name != ".." && !name.contains(['/', '\\', '\0'])
}

/// A new file without a final name. `number` is that of the next name of this run: what has it already is not of this run, and stays.
pub(super) fn create(directory: &Directory, number: &mut usize, private: bool) -> io::Result<(String, File)> {
    loop {
        let name = format!("{STAGED}{}-{number}", std::process::id());
        *number += 1;
        match directory.create(&name, private) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && *number < MOST_NAMES => {}
            created => return created.map(|file| (name, file)),
        }
    }
}

/// A name for the record of a set that nothing in the directory has.
pub(super) fn free_commit(directory: &Directory) -> io::Result<String> {
    let numbered = (1..MOST_NAMES).map(|number| format!("{COMMIT}-{number}"));
    for name in std::iter::once(COMMIT.to_owned()).chain(numbered) {
        if directory.state_of(&name)? == NameState::Nothing {
            return Ok(name);
        }
    }
    Err(io::Error::new(io::ErrorKind::AlreadyExists, "too many files of such names are in the directory"))
}

/// Puts the sets in place that runs of the user have recorded, and removes what they left without a record.
pub(super) fn finish(directory: &Directory) -> Result<Found, FilesError> {
    let failed = |name: &str| {
        let path = directory.path_of(&shown(name, LONGEST_SHOWN));
        move |source| FilesError::Left { path, source }
    };
    let mut found = Found::default();
    let mut names = directory.names().map_err(failed(""))?;
    names.sort();
    for name in names.iter().filter(|name| is_commit(name)) {
        finish_one(directory, name, &mut found)?;
    }
    // What another run writes just now must stay; without locks another run cannot be excluded.
    if !directory.is_locked() {
        return Ok(found);
    }
    let kept: Vec<&str> = found.left.iter().flat_map(LeftRecord::names).collect();
    for name in names.iter().filter(|name| is_temporary(name) && !kept.contains(&name.as_str())) {
        // Those of others may be of runs that they will finish.
        let is_own = match directory.state_of(name).map_err(failed(name))? {
            NameState::File(owned) | NameState::Link(owned) => owned.is_own(),
            _ => false,
        };
        if is_own {
            directory.remove(name).map_err(failed(name))?;
        }
    }
    Ok(found)
}

/// Finishes one record, or notes why not.
fn finish_one(directory: &Directory, name: &str, found: &mut Found) -> Result<(), FilesError> {
    let failed = |source| FilesError::Left { path: directory.path_of(name), source };
    let mut leave = |why: String, entries: Vec<StagedFile>| {
        found.left.push(LeftRecord { name: name.to_owned(), why, entries });
    };
    match directory.state_of(name).map_err(failed)? {
        NameState::File(owned) if owned.is_own() => {}
        // It was removed meanwhile.
        NameState::Nothing => return Ok(()),
        NameState::File(_) => {
            leave("it belongs to another user, whose next run into this directory finishes it".into(), Vec::new());
            return Ok(());
        }
        _ => {
            leave("it is not a file".into(), Vec::new());
            return Ok(());
        }
    }
    let bytes = directory.read(name, LARGEST).map_err(failed)?;
    let names_are_own = |entry: &StagedFile| {
        let is_staged = is_numbered(&entry.staged, STAGED, 2) || entry.has_grown();
        is_staged && is_plain(&entry.target) && !is_commit(&entry.target)
    };
    let entries = match serde_json::from_slice::<Vec<StagedFile>>(&bytes) {
        Ok(entries) if entries.iter().all(names_are_own) => entries,
        _ => {
            leave("it is not a record of camgen; remove it".into(), Vec::new());
            return Ok(());
        }
    };
    let pending = pending(directory, &entries)?;
    if let Some(why) = unsafe_entry(directory, &pending).map_err(failed)? {
        leave(why, entries);
        return Ok(());
    }
    for StagedFile { staged, target, .. } in pending {
        let failed = |source| FilesError::Left { path: directory.path_of(&target), source };
        directory.rename(&staged, &target).map_err(failed)?;
        found.finished.push(shown(&target, LONGEST_SHOWN));
    }
    directory.sync().map_err(failed)?;
    remove_markers(directory, &entries);
    directory.remove(name).map_err(failed)
}

/// Removes the markers of the growing files of a set once these are in place.
pub(super) fn remove_markers(directory: &Directory, entries: &[StagedFile]) {
    for entry in entries.iter().filter(|entry| entry.has_grown()) {
        let marker = marker_of(&entry.target);
        let is_gone = matches!(directory.state_of(&entry.staged), Ok(NameState::Nothing));
        if is_gone && is_marker(directory, &marker) {
            let _ = directory.remove(&marker);
        }
    }
}

/// The files of a record that have not got their final names.
fn pending(directory: &Directory, entries: &[StagedFile]) -> Result<Vec<StagedFile>, FilesError> {
    let mut pending = Vec::new();
    for entry in entries {
        let failed = |source| FilesError::Left { path: directory.path_of(&entry.staged), source };
        if let NameState::File(_) = directory.state_of(&entry.staged).map_err(failed)? {
            pending.push(entry.clone());
        }
    }
    Ok(pending)
}

/// Why a set is not put in place; `None` where it is the user's own, replaces nothing but what camgen wrote, and is what its own record says.
fn unsafe_entry(directory: &Directory, pending: &[StagedFile]) -> io::Result<Option<String>> {
    if pending.is_empty() {
        return Ok(None);
    }
    let record = record_name(directory)?;
    let Some(own) = own_record(directory, &record)? else {
        return Ok(Some(format!("`{record}` is not a record of this user; write its files again, or remove it")));
    };
    let Some(known) = pending.iter().find(|entry| entry.target == record) else {
        return Ok(Some(format!("it has no `{record}` that says what its files are; write them again, or remove it")));
    };
    let is_known = |record: &DirectoryRecord, name: &str, target: &str| -> io::Result<bool> {
        Ok(record.knows(directory, target, name)? == Some(true))
    };
    let Ok(made) = serde_json::from_slice::<DirectoryRecord>(&directory.read(&known.staged, LARGEST)?) else {
        return Ok(Some(format!("its `{record}` is not a record; remove it")));
    };
    for name in own.files.keys().filter(|name| !made.files.contains_key(*name)) {
        if directory.state_of(name)? != NameState::Nothing {
            let name = shown(name, LONGEST_SHOWN);
            return Ok(Some(format!("its `{record}` does not know `{name}`, which camgen wrote; remove it")));
        }
    }
    for entry in pending {
        let target = shown(&entry.target, LONGEST_SHOWN);
        let is_own = |owner: NameState| matches!(owner, NameState::File(owned) if owned.is_own());
        if !is_own(directory.state_of(&entry.staged)?) {
            return Ok(Some(format!("its file for `{target}` is not one of this user")));
        }
        let there = match directory.state_of(&entry.target)? {
            NameState::Nothing => None,
            NameState::File(owned) => Some(owned.stamp().clone()),
            _ => return Ok(Some(format!("`{target}` is not a file"))),
        };
        let is_record_of_set = entry.target == record;
        if !is_record_of_set && (is_record(&entry.target) || !is_known(&made, &entry.staged, &entry.target)?) {
            return Ok(Some(format!("its file for `{target}` is not as its own `{record}` says")));
        }
        if there.is_none() && !is_record_of_set && !is_usual(&entry.target) {
            return Ok(Some(format!("`{target}` is not the name of a file that camgen writes")));
        }
        // A file that was removed since then is not a loss.
        let is_free = there.is_none();
        if !is_free && (there != entry.replaces || !is_record_of_set && !is_known(&own, &entry.target, &entry.target)?)
        {
            let why = "was not written by camgen, or was changed or created since then: move it away, then run again";
            return Ok(Some(format!("`{target}` {why}")));
        }
    }
    Ok(None)
}

/// The record of a directory where it belongs to the user; an empty one where there is none.
fn own_record(directory: &Directory, name: &str) -> io::Result<Option<DirectoryRecord>> {
    match directory.state_of(name)? {
        NameState::File(owned) if !owned.is_own() => Ok(None),
        _ => DirectoryRecord::read(directory, name),
    }
}

/// Removes what a record leaves that this user's newer files have replaced.
pub(super) fn remove_left(directory: &Directory, record: &LeftRecord) {
    for name in record.names() {
        if matches!(directory.state_of(name), Ok(NameState::File(owned)) if owned.is_own()) {
            let _ = directory.remove(name);
        }
    }
}
