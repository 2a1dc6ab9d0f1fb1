//! A directory that files are written into: held open, so that all of them go into this one even where another takes its name,
//! and locked, so that one run writes at a time.

#[cfg(not(unix))]
#[path = "by_path.rs"]
mod held;
#[cfg(unix)]
mod held;

use super::error::FilesError;
use held::DirectoryHandle;
pub(super) use held::{FileOwner, give};
use serde::{Deserialize, Serialize};
use std::fs::{self, File, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

/// How long another run that writes into the directory is waited for, and how often the lock is tried.
const PATIENCE: Duration = Duration::from_secs(10);
const PERIOD: Duration = Duration::from_millis(5);
/// How often a directory that is gone when its lock is obtained is made again.
const MOST_TIMES: usize = 8;

/// Identifies a file, also in a copy of its directory: its size and the time of its last change.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct FileStamp(String);

/// What exists under a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum NameState {
    Nothing,
    File(FileOwner),
    Directory,
    /// A symbolic link is not followed: its target may be anywhere.
    Link(FileOwner),
    /// A pipe, a socket, a device.
    Other,
}

/// The directory, until it is dropped; then the directories that were made for it are removed, unless something is in them.
#[derive(Debug)]
pub(super) struct Directory {
    held: DirectoryHandle,
    path: PathBuf,
    /// The directories that were made for it, the outermost first.
    made: Vec<PathBuf>,
    /// Whether the lock is held. Some file systems have no locks.
    locked: bool,
}

impl Directory {
    /// Opens a directory, made where it is missing, and waits until no other run writes into it.
    pub(super) fn open(path: &Path) -> Result<Self, FilesError> {
        let made = missing(path);
        let mut opened = Self::made(path, &made);
        // Another run that failed may have removed the directory that it had made while this one waited for it.
        for _ in 0..MOST_TIMES {
            match &opened {
                Ok(directory) if !directory.is_unmoved().unwrap_or(true) => opened = Self::made(path, &made),
                _ => break,
            }
        }
        opened
    }

    fn made(path: &Path, made: &[PathBuf]) -> Result<Self, FilesError> {
        let opened = fs::create_dir_all(path).and_then(|()| DirectoryHandle::open(path));
        let opened = opened.map_err(|source| FilesError::Directory { path: path.to_owned(), source });
        match opened.and_then(|held| lock(&held, path, PATIENCE).map(|locked| (held, locked))) {
            Ok((held, locked)) => Ok(Self { held, path: path.to_owned(), made: made.to_vec(), locked }),
            Err(error) => {
                remove_empty(made);
                Err(error)
            }
        }
    }

    /// Opens a directory where it exists already; `None` where it does not.
    pub(super) fn found(path: &Path) -> Result<Option<Self>, FilesError> {
        match DirectoryHandle::open(path) {
            Ok(held) => {
                let locked = lock(&held, path, PATIENCE)?;
                Ok(Some(Self { held, path: path.to_owned(), made: Vec::new(), locked }))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(source) => Err(FilesError::Directory { path: path.to_owned(), source }),
        }
    }

    /// Opens a directory, made if missing, without waiting for other runs: for files that no other run writes.
    pub(super) fn unlocked(path: &Path) -> Result<Self, FilesError> {
        let opened = fs::create_dir_all(path).and_then(|()| DirectoryHandle::open(path));
        let held = opened.map_err(|source| FilesError::Directory { path: path.to_owned(), source })?;
        Ok(Self { held, path: path.to_owned(), made: Vec::new(), locked: false })
    }

    /// A locked handle of this directory. Waits for other runs.
    pub(super) fn locked(&self) -> Result<Self, FilesError> {
        self.locked_within(PATIENCE)
    }

    /// A locked handle of this directory; `None` while another run has the lock.
    pub(super) fn locked_if_free(&self) -> Result<Option<Self>, FilesError> {
        match self.locked_within(Duration::ZERO) {
            Err(FilesError::Busy { .. }) => Ok(None),
            locked => locked.map(Some),
        }
    }

    fn locked_within(&self, patience: Duration) -> Result<Self, FilesError> {
        let failed = |source| FilesError::Directory { path: self.path.clone(), source };
        let held = self.held.again().map_err(failed)?;
        let locked = lock(&held, &self.path, patience)?;
        Ok(Self { held, path: self.path.clone(), made: Vec::new(), locked })
    }

    /// Releases the lock; the directory stays open.
    pub(super) fn unlock(&mut self) {
        if self.locked {
            self.held.unlock();
            self.locked = false;
        }
    }

    pub(super) fn is_locked(&self) -> bool {
        self.locked
    }

    /// Keeps the directories that were made for it, also through a power cut where the system can do that.
    pub(super) fn keep(&mut self) {
        for parent in self.made.drain(..).filter_map(|made| Some(made.parent()?.to_owned())) {
            let parent = if parent.as_os_str().is_empty() { Path::new(".") } else { &parent };
            let _ = DirectoryHandle::open(parent).and_then(|parent| parent.sync());
        }
    }

    /// Whether a file in it cannot be replaced.
    pub(super) fn is_protected(&self, name: &str, owned: &FileOwner) -> io::Result<bool> {
        self.held.is_protected(name, owned)
    }

    /// The path of a file in it, for messages.
    pub(super) fn path_of(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Whether its path still leads to it.
    pub(super) fn is_unmoved(&self) -> io::Result<bool> {
        self.held.is_at(&self.path)
    }

    /// What exists under a name.
    pub(super) fn state_of(&self, name: &str) -> io::Result<NameState> {
        self.held.state_of(name)
    }

    /// A new file, with the permissions that the user's new files have, or readable to nobody else.
    pub(super) fn create(&self, name: &str, private: bool) -> io::Result<File> {
        self.held.create(name, private)
    }

    /// Whether a user can only replace files of his own in it.
    pub(super) fn is_sticky(&self) -> io::Result<bool> {
        self.held.is_sticky()
    }

    /// The bytes of a file, up to this many.
    pub(super) fn read(&self, name: &str, most: u64) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.held.file(name)?.take(most).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    /// Opens a file to read.
    pub(super) fn file(&self, name: &str) -> io::Result<File> {
        self.held.file(name)
    }

    /// Creates a file to write and read.
    pub(super) fn create_to_extend(&self, name: &str) -> io::Result<File> {
        self.held.create_to_extend(name)
    }

    /// Opens an existing file to read and extend.
    pub(super) fn file_to_extend(&self, name: &str) -> io::Result<File> {
        self.held.file_to_extend(name)
    }

    /// Whether an open file has this name and no other (hard link).
    pub(super) fn has_only_name(&self, file: &File, name: &str) -> io::Result<bool> {
        self.held.has_only_name(file, name)
    }

    /// Gives a file the name of another, which is then gone; a reader finds the one or the other at any time.
    pub(super) fn rename(&self, from: &str, to: &str) -> io::Result<()> {
        self.held.rename(from, to)
    }

    pub(super) fn remove(&self, name: &str) -> io::Result<()> {
        self.held.remove(name)
    }

    /// The names in it.
    pub(super) fn names(&self) -> io::Result<Vec<String>> {
        self.held.names()
    }

    /// Makes sure that what was renamed and removed last survives a power cut.
    pub(super) fn sync(&self) -> io::Result<()> {
        self.held.sync()
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        // Another directory may have its path by now; where that cannot be known, only empty directories are removed.
        if !self.made.is_empty() && self.held.is_at(&self.path).unwrap_or(true) {
            remove_empty(&self.made);
        }
    }
}

/// Waits until no other run is in a directory; `false` where the file system has no locks.
fn lock(held: &DirectoryHandle, path: &Path, patience: Duration) -> Result<bool, FilesError> {
    let mut waited = Duration::ZERO;
    loop {
        match held.try_lock() {
            Ok(()) => return Ok(true),
            Err(TryLockError::WouldBlock) if waited < patience => {
                sleep(PERIOD);
                waited += PERIOD;
            }
            Err(TryLockError::WouldBlock) => {
                return Err(FilesError::Busy { path: path.to_owned(), seconds: patience.as_secs() });
            }
            Err(TryLockError::Error(error)) if held::has_no_locks(&error) => return Ok(false),
            Err(TryLockError::Error(source)) => return Err(FilesError::Directory { path: path.to_owned(), source }),
        }
    }
}

/// The missing directories of a path, the outermost first.
fn missing(path: &Path) -> Vec<PathBuf> {
    let outwards = path.ancestors().filter(|path| !path.as_os_str().is_empty());
    let mut missing: Vec<PathBuf> =
        outwards.take_while(|path| fs::symlink_metadata(path).is_err()).map(Path::to_owned).collect();
    missing.reverse();
    missing
}

/// Removes directories, the innermost first, where nothing is in them.
fn remove_empty(directories: &[PathBuf]) {
    for directory in directories.iter().rev() {
        let _ = fs::remove_dir(directory);
    }
}
