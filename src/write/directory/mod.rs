//! A directory that files are written into: held open, so that all of them go into this one even where its name is given to another,
//! and locked, so that one run writes at a time.

#[cfg(not(unix))]
#[path = "by_path.rs"]
mod held;
#[cfg(unix)]
mod held;

use super::files::FilesError;
use held::Held;
pub(super) use held::{Owned, give};
use serde::{Deserialize, Serialize};
use std::fs::{self, File, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

/// So long another run that writes into the directory is waited for, looking so often.
const PATIENCE: Duration = Duration::from_secs(10);
const PERIOD: Duration = Duration::from_millis(5);
/// A directory that is gone when its lock is had is made again so often.
const MOST_TIMES: usize = 8;

/// By what a file is known again, also in a copy of its directory: its size and the time of its last change.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Stamp(String);

/// What stands under a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Standing {
    Nothing,
    File(Owned),
    Directory,
    /// It is not followed: what is behind it may be anywhere.
    Link,
    /// A pipe, a socket, a device.
    Other,
}

/// The directory, until it is dropped; directories that were made for it go then, unless something is in them.
#[derive(Debug)]
pub(super) struct Directory {
    held: Held,
    path: PathBuf,
    /// Those that were made for it, the outermost first.
    made: Vec<PathBuf>,
    /// No other run of camgen is in it. Some file systems have no locks.
    locked: bool,
}

impl Directory {
    /// Opens a directory, which is made where it is missing, and waits until no other run writes into it.
    pub(super) fn open(path: &Path) -> Result<Self, FilesError> {
        let made = missing(path);
        let mut opened = Self::made(path, &made);
        // Another run that gave up may have removed the directory that it had made while this one waited for it.
        for _ in 0..MOST_TIMES {
            match &opened {
                Ok(directory) if !directory.is_where_it_was().unwrap_or(true) => opened = Self::made(path, &made),
                _ => break,
            }
        }
        opened
    }

    fn made(path: &Path, made: &[PathBuf]) -> Result<Self, FilesError> {
        let opened = fs::create_dir_all(path).and_then(|()| Held::open(path));
        let opened = opened.map_err(|source| FilesError::Directory { path: path.to_owned(), source });
        match opened.and_then(|held| lock(&held, path).map(|locked| (held, locked))) {
            Ok((held, locked)) => Ok(Self { held, path: path.to_owned(), made: made.to_vec(), locked }),
            Err(error) => {
                remove_empty(made);
                Err(error)
            }
        }
    }

    /// The same where it is there already.
    pub(super) fn found(path: &Path) -> Result<Option<Self>, FilesError> {
        match Held::open(path) {
            Ok(held) => {
                let locked = lock(&held, path)?;
                Ok(Some(Self { held, path: path.to_owned(), made: Vec::new(), locked }))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(source) => Err(FilesError::Directory { path: path.to_owned(), source }),
        }
    }

    pub(super) fn is_locked(&self) -> bool {
        self.locked
    }

    /// What was made for it stays, through a power cut where the system can do that.
    pub(super) fn stays(&mut self) {
        for parent in self.made.drain(..).filter_map(|made| Some(made.parent()?.to_owned())) {
            let parent = if parent.as_os_str().is_empty() { Path::new(".") } else { &parent };
            let _ = Held::open(parent).and_then(|parent| parent.sync());
        }
    }

    /// Whether a file in it cannot be replaced.
    pub(super) fn guards(&self, name: &str, owned: &Owned) -> io::Result<bool> {
        self.held.guards(name, owned)
    }

    /// The path of a file in it, for words.
    pub(super) fn path_of(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Whether its path still leads to it.
    pub(super) fn is_where_it_was(&self) -> io::Result<bool> {
        self.held.is_at(&self.path)
    }

    /// What stands under a name.
    pub(super) fn standing(&self, name: &str) -> io::Result<Standing> {
        self.held.standing(name)
    }

    /// A new file, with the permissions that the user's new files have, or readable to nobody else. One of this name that was left by a
    /// run with the same number is replaced.
    pub(super) fn create(&self, name: &str, private: bool) -> io::Result<File> {
        match self.held.create(name, private) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                self.held.remove(name)?;
                self.held.create(name, private)
            }
            created => created,
        }
    }

    /// The bytes of a file, at the most so many.
    pub(super) fn read(&self, name: &str, most: u64) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.held.file(name)?.take(most).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    /// Gives a file the name of another, which is gone then; a reader finds the one or the other at any time.
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

    /// Makes what was renamed and removed last through a power cut.
    pub(super) fn sync(&self) -> io::Result<()> {
        self.held.sync()
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        // Another that has its path by now is not its own; where nobody can tell, only what is empty goes.
        if !self.made.is_empty() && self.held.is_at(&self.path).unwrap_or(true) {
            remove_empty(&self.made);
        }
    }
}

/// Waits until no other run is in a directory; `false` where the file system has no locks.
fn lock(held: &Held, path: &Path) -> Result<bool, FilesError> {
    let mut waited = Duration::ZERO;
    loop {
        match held.try_lock() {
            Ok(()) => return Ok(true),
            Err(TryLockError::WouldBlock) if waited < PATIENCE => {
                sleep(PERIOD);
                waited += PERIOD;
            }
            Err(TryLockError::WouldBlock) => {
                return Err(FilesError::Busy { path: path.to_owned(), seconds: PATIENCE.as_secs() });
            }
            Err(TryLockError::Error(error)) if held::has_no_locks(&error) => return Ok(false),
            Err(TryLockError::Error(source)) => return Err(FilesError::Directory { path: path.to_owned(), source }),
        }
    }
}

/// The directories of a path that are not there, the outermost first.
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
