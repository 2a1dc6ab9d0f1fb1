//! All files of a run or none, whatever fails and whenever the run is cut off.
//!
//! Every file is written whole and synced under a name of its own beside its target. Then one record that lists them, `.camgen-commit`,
//! is put in place by a rename: before it nothing has changed, from it on the set counts as written. Each file is renamed over its
//! target, so that a reader finds the old one or the new one at any time, and the record is removed. A run that opens a directory with
//! such a record finishes it first; files without one are what is left of a run that was cut off before, and are removed.

use super::directory::{Directory, Owned, Stamp, Standing, give};
use super::record::Kept;
use serde::{Deserialize, Serialize};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Its name in the directory.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Why not everything was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FilesError {
    /// The directory cannot be made, opened or locked.
    #[error("cannot make the directory `{}`, or write into it: {source}; choose another with --out", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Another run writes into the directory.
    #[error(
        "another run of camgen has been writing into `{}` for {seconds} s; nothing was changed: wait for it, or choose another --out",
        path.display()
    )]
    Busy {
        /// The directory.
        path: PathBuf,
        /// So long it was waited for.
        seconds: u64,
    },
    /// Files stand in the places that camgen has not written, or that were changed since.
    #[error(
        "{}; nothing was written: choose another --name or --out, or replace with --overwrite",
        .0.iter().map(Kept::to_string).collect::<Vec<_>>().join(", ")
    )]
    Kept(Vec<Kept>),
    /// A file cannot be written.
    #[error("cannot write `{}`: {source}; nothing was changed", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A number in a file is none: a fault of camgen.
    #[error("line {line} of `{name}` would hold a number that is not finite; nothing was written; please report this")]
    NotFinite {
        /// The file.
        name: String,
        /// The line, from 1.
        line: usize,
    },
    /// The directory was renamed or replaced while files were made for it.
    #[error("the directory `{}` was moved or replaced meanwhile; nothing was changed", .0.display())]
    Moved(PathBuf),
    /// The set is written, and not every file of it is in its place.
    #[error(
        "cannot put `{}` in its place: {source}; the set is kept, and the next run that writes into this directory puts it in place, as \
         soon as nothing stands in its way",
        path.display()
    )]
    Unfinished {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The set of an earlier run was put in its place, and then this one was refused.
    #[error("an earlier run was cut off, and its files were put in place: {}; then: {source}", finished.join(", "))]
    Finished {
        /// The files of the earlier run.
        finished: Vec<String>,
        /// Why this one was refused.
        source: Box<FilesError>,
    },
    /// The set of an earlier run cannot be put in its place.
    #[error("an earlier run was cut off, and cannot be finished at `{}`: {source}; nothing else was changed", path.display())]
    Left {
        /// The file that it failed at.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// The record of a set that is written, while it is put in place.
const COMMIT: &str = ".camgen-commit";
/// What the name of the same begins with until it is whole.
const COMMIT_NEW: &str = ".camgen-commit-new-";
/// What the names of files begin with that are not in their places yet.
const STAGED: &str = ".camgen-new-";
/// The largest record of a set that is read, bytes.
const LARGEST: u64 = 1 << 26;

/// A file that is written and not in its place yet.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Entry {
    staged: String,
    target: String,
    /// What stood in the place of the target.
    replaces: Option<Stamp>,
}

/// A directory to write into, in which no other run is.
#[derive(Debug)]
pub struct Place {
    pub(super) directory: Directory,
    /// The files that were put in place of an earlier run that was cut off.
    pub(super) finished: Vec<String>,
}

impl Place {
    /// Opens a directory, which is made when missing; waits until no other run is in it, and finishes one that was cut off.
    ///
    /// # Errors
    /// [`FilesError`]; then nothing of this run was written.
    pub fn open(path: &Path) -> Result<Self, FilesError> {
        let directory = Directory::open(path)?;
        let finished = finish(&directory)?;
        Ok(Self { directory, finished })
    }

    /// The same where it is there already.
    pub(super) fn found(path: &Path) -> Result<Option<Self>, FilesError> {
        let Some(directory) = Directory::found(path)? else { return Ok(None) };
        let finished = finish(&directory)?;
        Ok(Some(Self { directory, finished }))
    }
}

/// Files that are written beside their targets. Dropped, they are removed, and everything is as it was.
#[derive(Debug)]
pub struct Staged {
    directory: Directory,
    entries: Vec<Entry>,
    /// The record of the set stands: nothing of it is removed any more.
    recorded: bool,
}

/// Writes all outputs into a directory, which is made when missing.
///
/// # Errors
/// [`FilesError`]; then every file is as it was before, unless the error says that the set is kept.
pub fn write_all(directory: &Path, outputs: &[Output]) -> Result<(), FilesError> {
    stage(Place::open(directory)?.directory, outputs)?.commit()
}

/// An error of a run that has first finished another.
pub(super) fn after(finished: Vec<String>) -> impl FnOnce(FilesError) -> FilesError {
    move |source| if finished.is_empty() { source } else { FilesError::Finished { finished, source: Box::new(source) } }
}

/// Writes files beside their targets.
pub(super) fn stage(directory: Directory, outputs: &[Output]) -> Result<Staged, FilesError> {
    let mut staged = Staged { directory, entries: Vec::new(), recorded: false };
    for (index, output) in outputs.iter().enumerate() {
        let name = format!("{STAGED}{}-{index}", std::process::id());
        let failed = |source| FilesError::File { path: staged.directory.path_of(&output.name), source };
        let owned = target(&staged.directory, &output.name).map_err(failed)?;
        let mut file = staged.directory.create(&name, owned.is_some()).map_err(failed)?;
        // From here on it is removed with the others.
        let replaces = owned.as_ref().map(|owned| owned.stamp().clone());
        staged.entries.push(Entry { staged: name, target: output.name.clone(), replaces });
        let written = file.write_all(&output.bytes);
        let given = written.and_then(|()| owned.map_or(Ok(()), |owned| give(&file, &owned)));
        let path = || staged.directory.path_of(&output.name);
        given.and_then(|()| file.sync_all()).map_err(|source| FilesError::File { path: path(), source })?;
    }
    Ok(staged)
}

/// Whose the file is that a new one replaces; `None` where there is none.
fn target(directory: &Directory, name: &str) -> io::Result<Option<Owned>> {
    if !is_plain(name) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no name of a file in this directory"));
    }
    let why = match directory.standing(name)? {
        Standing::Nothing => return Ok(None),
        Standing::File(owned) if directory.guards(name, &owned)? => {
            "it cannot be replaced: it is somebody else's under a sticky bit, immutable, or a mount point"
        }
        Standing::File(owned) => return Ok(Some(owned)),
        Standing::Directory => "a directory of that name is in the way",
        Standing::Link => {
            "a symbolic link of that name is in the way, and is not followed: remove it, or give its target as --out"
        }
        Standing::Other => "what has that name is no file",
    };
    Err(io::Error::new(io::ErrorKind::AlreadyExists, why))
}

/// Whether a name is that of something in a directory, and nowhere else.
fn is_plain(name: &str) -> bool {
    !name.is_empty() && name != "." && name != ".." && !name.contains(['/', '\\', '\0'])
}

impl Staged {
    /// Removes what is not in its place; nothing once the record of the set stands.
    pub fn discard(&self) {
        let entries = if self.recorded { &[] } else { self.entries.as_slice() };
        for entry in entries {
            let _ = self.directory.remove(&entry.staged);
        }
    }

    /// Puts all files in their places.
    ///
    /// # Errors
    /// [`FilesError`]: before the record of the set stands every file is as it was; after it the next run into the directory finishes.
    pub fn commit(mut self) -> Result<(), FilesError> {
        self.record()?;
        let directory = &self.directory;
        let unfinished = |name: &str| {
            let path = directory.path_of(name);
            move |source| FilesError::Unfinished { path, source }
        };
        for (index, entry) in self.entries.iter().enumerate() {
            if let Err(source) = directory.rename(&entry.staged, &entry.target) {
                // Before the first one nothing has changed, if the record can be taken back.
                let back = index == 0 && take_back(directory);
                self.recorded = !back;
                let path = self.directory.path_of(&entry.target);
                return Err(if back {
                    FilesError::File { path, source }
                } else {
                    FilesError::Unfinished { path, source }
                });
            }
        }
        directory.sync().map_err(unfinished(""))?;
        directory.remove(COMMIT).map_err(unfinished(COMMIT))?;
        self.directory.stays();
        Ok(())
    }

    /// Puts the record of the set in place.
    fn record(&mut self) -> Result<(), FilesError> {
        let directory = &self.directory;
        let failed = |source| FilesError::File { path: directory.path_of(COMMIT), source };
        if !directory.is_where_it_was().map_err(failed)? {
            return Err(FilesError::Moved(directory.path_of("")));
        }
        let bytes = serde_json::to_vec(&self.entries).map_err(|error| failed(error.into()))?;
        let new = commit_new();
        let mut file = directory.create(&new, false).map_err(failed)?;
        let written = file.write_all(&bytes).and_then(|()| file.sync_all());
        if let Err(source) = written.and_then(|()| directory.rename(&new, COMMIT)) {
            let _ = directory.remove(&new);
            return Err(failed(source));
        }
        if let Err(source) = directory.sync() {
            // Where it can be taken back nothing has happened.
            self.recorded = !take_back(directory);
            let path = directory.path_of(COMMIT);
            return Err(if self.recorded {
                FilesError::Unfinished { path, source }
            } else {
                FilesError::File { path, source }
            });
        }
        self.recorded = true;
        Ok(())
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        self.discard();
    }
}

/// The name of the record of this run until it is whole.
fn commit_new() -> String {
    format!("{COMMIT_NEW}{}", std::process::id())
}

/// Removes the record of a set of which nothing is in its place yet; whether that was possible.
fn take_back(directory: &Directory) -> bool {
    let removed = directory.remove(COMMIT).is_ok();
    let _ = directory.sync();
    removed
}

/// Puts the set in place that a run has recorded, and removes what another has left without a record; the names of the files put in place.
fn finish(directory: &Directory) -> Result<Vec<String>, FilesError> {
    let failed = |name: &str| {
        let path = directory.path_of(name);
        move |source| FilesError::Left { path, source }
    };
    let finished = match directory.standing(COMMIT).map_err(failed(COMMIT))? {
        Standing::File(_) => recorded(directory)?,
        _ => Vec::new(),
    };
    // What another run writes just now must stay; where there are no locks nobody knows.
    if directory.is_locked() {
        let names = directory.names().map_err(failed(""))?;
        for name in names.iter().filter(|name| name.starts_with(STAGED) || name.starts_with(COMMIT_NEW)) {
            directory.remove(name).map_err(failed(name))?;
        }
    }
    Ok(finished)
}

/// Puts the recorded set in place.
fn recorded(directory: &Directory) -> Result<Vec<String>, FilesError> {
    let failed = |name: &str| {
        let path = directory.path_of(name);
        move |source| FilesError::Left { path, source }
    };
    let bytes = directory.read(COMMIT, LARGEST).map_err(failed(COMMIT))?;
    let own = |entry: &Entry| entry.staged.starts_with(STAGED) && is_plain(&entry.staged) && is_plain(&entry.target);
    let entries: Vec<Entry> = match serde_json::from_slice::<Vec<Entry>>(&bytes) {
        Ok(entries) if entries.iter().all(own) => entries,
        _ => {
            let why = "it is no record of camgen: remove it";
            return Err(failed(COMMIT)(io::Error::new(io::ErrorKind::InvalidData, why)));
        }
    };
    let mut finished = Vec::new();
    for Entry { staged, target, replaces } in entries {
        if !matches!(directory.standing(&staged).map_err(failed(&staged))?, Standing::File(_)) {
            continue;
        }
        let there = match directory.standing(&target).map_err(failed(&target))? {
            Standing::Nothing => None,
            Standing::File(owned) => Some(owned.stamp().clone()),
            _ => Some(Stamp::default()),
        };
        // One that was removed since is no loss.
        if there.is_some() && there != replaces {
            let why = "it was changed or put there since: move it away, then run again";
            return Err(failed(&target)(io::Error::new(io::ErrorKind::AlreadyExists, why)));
        }
        directory.rename(&staged, &target).map_err(failed(&target))?;
        finished.push(target);
    }
    directory.sync().map_err(failed(""))?;
    directory.remove(COMMIT).map_err(failed(COMMIT))?;
    Ok(finished)
}

#[cfg(test)]
mod tests;
