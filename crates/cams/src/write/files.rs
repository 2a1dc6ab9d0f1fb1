//! All files of a run or no file, whatever fails and whenever the run is interrupted.
//!
//! Every file is written whole and synced under a temporary name next to its target. Then one record that lists them, `.camgen-commit`,
//! is put in place by a rename: before it nothing has changed, after it the set counts as written. Each file is renamed over its
//! target, so that a reader finds the old file or the new one at any time, and the record is removed. A run that opens a directory with
//! such a record of its user finishes it first (`interrupted`); temporary files of that user without a record are left over, and are removed.
//! A single file needs no record: its rename is all.

pub use super::error::{FilesError, Output};

use super::directory::{Directory, NameState};
use super::growing::GrowingFile;
use super::interrupted::{self, LeftRecord, StagedFile, create, free_commit};
use super::known::digest_of;
use super::one_file::{stage_one, target, write_one};
use super::part::part_of;
use std::fmt;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A directory to write into, in which no other run is active.
#[derive(Debug)]
pub struct OutputDirectory {
    pub(super) directory: Directory,
    /// The files of an interrupted earlier run that were put in place now.
    pub(super) finished: Vec<String>,
    /// The records of interrupted runs that are left as they are.
    pub(super) left: Vec<LeftRecord>,
}

impl OutputDirectory {
    /// Opens a directory, made when missing; waits until no other run is in it, and finishes an interrupted run.
    ///
    /// # Errors
    /// [`FilesError`]; then nothing of this run was written.
    pub fn open(path: &Path) -> Result<Self, FilesError> {
        Self::finishing(Directory::open(path)?)
    }

    /// Saves a growing file, and opens its directory again for the files that are put in place with it.
    ///
    /// # Errors
    /// As [`OutputDirectory::open`].
    pub fn of_grown(grown: &GrowingFile) -> Result<Self, FilesError> {
        Self::finishing(grown.saved()?)
    }

    fn finishing(directory: Directory) -> Result<Self, FilesError> {
        let interrupted::Found { finished, left } = interrupted::finish(&directory)?;
        Ok(Self { directory, finished, left })
    }

    /// The records of interrupted runs that are left as they are, a sentence each.
    #[must_use]
    pub fn left(&self) -> Vec<String> {
        self.left.iter().map(|record| record.sentence(&self.directory)).collect()
    }

    /// Opens a directory where it exists already; `None` where it does not.
    pub(super) fn found(path: &Path) -> Result<Option<Self>, FilesError> {
        Directory::found(path)?.map(Self::finishing).transpose()
    }
}

/// Files that are written next to their targets. Dropped, they are removed, and everything is as it was.
#[derive(Debug)]
pub struct StagedFiles {
    directory: Directory,
    entries: Vec<StagedFile>,
    /// The number of the next temporary name.
    number: usize,
    /// The name of the record of the set while it is in place: then nothing of the set is removed any more.
    recorded: Option<String>,
    /// Records of interrupted runs that were left.
    left: Vec<LeftRecord>,
}

/// A file to be written; its content need not be in memory.
#[derive(Debug)]
pub struct NewFile<'a> {
    /// Its name in the directory.
    pub name: String,
    /// Its content.
    pub content: Content<'a>,
}

/// Writes the content of a file.
pub type WriteContent<'a> = Box<dyn FnMut(&mut File) -> io::Result<()> + 'a>;

/// The content of a file to be written.
pub enum Content<'a> {
    /// In memory.
    Bytes(Vec<u8>),
    /// Produced during writing.
    Stream(WriteContent<'a>),
    /// Already on disk, as a growing file.
    Grown(&'a GrowingFile),
}

impl fmt::Debug for Content<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Content::Bytes(_) => "Bytes",
            Content::Stream(_) => "Stream",
            Content::Grown(_) => "Grown",
        })
    }
}

impl From<Output> for NewFile<'_> {
    fn from(Output { name, bytes }: Output) -> Self {
        Self { name, content: Content::Bytes(bytes) }
    }
}

/// Writes all outputs into a directory, made when missing.
///
/// # Errors
/// [`FilesError`]; then every file is as it was before, unless the error says that the set is kept.
pub fn write_all(directory: &Path, outputs: &[Output]) -> Result<(), FilesError> {
    stage(OutputDirectory::open(directory)?.directory, outputs)?.commit()
}

/// Writes a file into a directory, made if missing, without waiting for other processes, which may write files of other names at the same time.
///
/// # Errors
/// [`FilesError`]; then the file is as it was before.
pub fn write_beside_others(directory: &Path, output: &Output) -> Result<(), FilesError> {
    write_one(&Directory::unlocked(directory)?, &output.name, &output.bytes)
}

/// An error of a run that has finished another one first.
pub(super) fn after(finished: Vec<String>) -> impl FnOnce(FilesError) -> FilesError {
    move |source| if finished.is_empty() { source } else { FilesError::Finished { finished, source: Box::new(source) } }
}

/// Writes files next to their targets.
pub(super) fn stage(directory: Directory, outputs: &[Output]) -> Result<StagedFiles, FilesError> {
    let mut staged = StagedFiles::of(directory);
    for output in outputs {
        staged.write(&output.name, &mut |file| file.write_all(&output.bytes))?;
    }
    Ok(staged)
}

/// Writes files next to their targets, none of which exists yet.
///
/// # Errors
/// [`FilesError`]; then nothing of this run was written.
pub fn stage_new(place: OutputDirectory, outputs: &[Output]) -> Result<StagedFiles, FilesError> {
    let OutputDirectory { directory, finished, .. } = place;
    let free = outputs.iter().try_for_each(|output| {
        let failed = |source| FilesError::File { path: directory.path_of(&output.name), source };
        match directory.state_of(&output.name).map_err(failed)? {
            NameState::Nothing => Ok(()),
            _ => Err(failed(io::Error::new(io::ErrorKind::AlreadyExists, "it already exists and is not replaced"))),
        }
    });
    free.and_then(|()| stage(directory, outputs)).map_err(after(finished))
}

impl StagedFiles {
    /// No files yet.
    pub(super) fn of(directory: Directory) -> Self {
        Self { directory, entries: Vec::new(), number: 0, recorded: None, left: Vec::new() }
    }

    pub(super) fn directory(&self) -> &Directory {
        &self.directory
    }

    /// The paths that the files will have.
    #[must_use]
    pub fn targets(&self) -> Vec<PathBuf> {
        self.entries.iter().map(|entry| self.directory.path_of(&entry.target)).collect()
    }

    /// Writes a file next to its target.
    fn write(&mut self, name: &str, write: &mut dyn FnMut(&mut File) -> io::Result<()>) -> Result<(), FilesError> {
        let file = stage_one(&self.directory, &mut self.number, name, write)?;
        self.entries.push(file);
        Ok(())
    }

    /// Adds a file; returns its digest if its content was not in memory.
    pub(super) fn add(&mut self, file: NewFile<'_>) -> Result<Option<String>, FilesError> {
        let name = file.name;
        match file.content {
            Content::Bytes(bytes) => self.write(&name, &mut |file| file.write_all(&bytes))?,
            Content::Grown(grown) => self.add_grown(&name, grown)?,
            Content::Stream(mut write) => {
                self.write(&name, &mut write)?;
                let staged = self.entries.last().map_or("", |entry| &entry.staged);
                let digest = self.directory.file(staged).and_then(digest_of);
                return digest.map(Some).map_err(|source| self.failed(&name, source));
            }
        }
        Ok(None)
    }

    /// Adds a growing file, already under its own temporary name.
    fn add_grown(&mut self, name: &str, grown: &GrowingFile) -> Result<(), FilesError> {
        let owned = target(&self.directory, name).map_err(|source| self.failed(name, source))?;
        grown.is_still_in(&self.directory)?;
        let given = owned.as_ref().map_or(Ok(()), |owned| grown.give(owned));
        given.map_err(|source| self.failed(name, source))?;
        let replaces = owned.map(|owned| owned.stamp().clone());
        self.entries.push(StagedFile { staged: part_of(name), target: name.to_owned(), replaces });
        Ok(())
    }

    /// These files, which may be newer ones of interrupted runs.
    pub(super) fn in_place_of(mut self, left: Vec<LeftRecord>) -> Self {
        self.left = left;
        self
    }

    /// Removes the files without a final name; does nothing once the record of the set is in place.
    pub fn discard(&self) {
        let entries = if self.recorded.is_some() { &[] } else { self.entries.as_slice() };
        for entry in entries.iter().filter(|entry| !entry.has_grown()) {
            let _ = self.directory.remove(&entry.staged);
        }
    }

    /// Gives all files their final names.
    ///
    /// # Errors
    /// [`FilesError`]: before the record of the set is in place every file is as it was; after it the next run into the directory finishes.
    pub fn commit(mut self) -> Result<(), FilesError> {
        if !self.directory.is_unmoved().map_err(|source| self.failed("", source))? {
            return Err(FilesError::Moved(self.directory.path_of("")));
        }
        if let [only] = self.entries.as_slice() {
            let only = only.clone();
            return self.place_only(&only);
        }
        let commit = self.record()?;
        let directory = &self.directory;
        let unfinished = |name: &str| {
            let path = directory.path_of(name);
            move |source| FilesError::Unfinished { path, source }
        };
        for (index, entry) in self.entries.iter().enumerate() {
            if let Err(source) = directory.rename(&entry.staged, &entry.target) {
                // Before the first rename nothing has changed, provided that the record can be taken back.
                if index == 0 && take_back(directory, &commit) {
                    self.recorded = None;
                    return Err(self.failed(&entry.target.clone(), source));
                }
                return Err(unfinished(&entry.target)(source));
            }
        }
        directory.sync().map_err(unfinished(""))?;
        interrupted::remove_markers(directory, &self.entries);
        directory.remove(&commit).map_err(unfinished(&commit))?;
        let names: Vec<&str> = self.entries.iter().map(|entry| entry.target.as_str()).collect();
        for left in self.left.iter().filter(|left| left.is_replaced_by(&names)) {
            interrupted::remove_left(directory, left);
        }
        self.directory.keep();
        Ok(())
    }

    fn failed(&self, name: &str, source: io::Error) -> FilesError {
        FilesError::File { path: self.directory.path_of(name), source }
    }

    /// Gives the only file its name. A rename that cannot be synced is undone where nothing was replaced.
    fn place_only(mut self, entry: &StagedFile) -> Result<(), FilesError> {
        let directory = &self.directory;
        directory.rename(&entry.staged, &entry.target).map_err(|source| self.failed(&entry.target, source))?;
        if let Err(source) = directory.sync() {
            let path = directory.path_of(&entry.target);
            if entry.replaces.is_none() && directory.remove(&entry.target).is_ok() {
                return Err(FilesError::File { path, source });
            }
            return Err(FilesError::Unfinished { path, source });
        }
        self.directory.keep();
        Ok(())
    }

    /// Puts the record of the set in place; its name.
    fn record(&mut self) -> Result<String, FilesError> {
        let directory = &self.directory;
        let free = free_commit(directory).map_err(|source| self.failed("", source))?;
        let failed = |source| FilesError::File { path: directory.path_of(&free), source };
        let bytes = serde_json::to_vec(&self.entries).map_err(|error| failed(error.into()))?;
        let (new, mut file) = create(directory, &mut self.number, false).map_err(failed)?;
        let written = file.write_all(&bytes).and_then(|()| file.sync_all());
        if let Err(source) = written.and_then(|()| directory.rename(&new, &free)) {
            let _ = directory.remove(&new);
            return Err(failed(source));
        }
        if let Err(source) = directory.sync() {
            // Where it can be taken back, nothing has happened.
            let path = directory.path_of(&free);
            if take_back(directory, &free) {
                return Err(FilesError::File { path, source });
            }
            self.recorded = Some(free);
            return Err(FilesError::Unfinished { path, source });
        }
        self.recorded = Some(free.clone());
        Ok(free)
    }
}

impl Drop for StagedFiles {
    fn drop(&mut self) {
        self.discard();
    }
}

/// Removes the record of a set of which no file is in place yet; whether that was possible.
fn take_back(directory: &Directory, commit: &str) -> bool {
    let removed = directory.remove(commit).is_ok();
    let _ = directory.sync();
    removed
}

#[cfg(test)]
mod tests;
