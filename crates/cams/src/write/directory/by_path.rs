//! A directory by its path, on systems without a handle to look names up in.

use super::{FileStamp, NameState};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// The owner of a file, which is unknown here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::write) struct FileOwner {
    stamp: FileStamp,
}

impl FileOwner {
    pub(in crate::write) fn stamp(&self) -> &FileStamp {
        &self.stamp
    }

    /// Owners are not known: whoever may write here may replace every file.
    pub(in crate::write) fn is_own(&self) -> bool {
        true
    }
}

#[derive(Debug)]
pub(super) struct DirectoryHandle(PathBuf);

impl DirectoryHandle {
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        fs::read_dir(path).map(|_| Self(path.to_owned()))
    }

    pub(super) fn try_lock(&self) -> Result<(), TryLockError> {
        Err(TryLockError::Error(io::ErrorKind::Unsupported.into()))
    }

    pub(super) fn unlock(&self) {}

    pub(super) fn again(&self) -> io::Result<Self> {
        Ok(Self(self.0.clone()))
    }

    pub(super) fn is_at(&self, path: &Path) -> io::Result<bool> {
        Ok(self.0 == path)
    }

    pub(super) fn state_of(&self, name: &str) -> io::Result<NameState> {
        let data = match fs::symlink_metadata(self.0.join(name)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(NameState::Nothing),
            data => data?,
        };
        let kind = data.file_type();
        let owner = || FileOwner { stamp: FileStamp(format!("{} {:?}", data.len(), data.modified().ok())) };
        Ok(if kind.is_file() {
            NameState::File(owner())
        } else if kind.is_dir() {
            NameState::Directory
        } else if kind.is_symlink() {
            NameState::Link(owner())
        } else {
            NameState::Other
        })
    }

    pub(super) fn create(&self, name: &str, _: bool) -> io::Result<File> {
        File::create_new(self.0.join(name))
    }

    pub(super) fn file(&self, name: &str) -> io::Result<File> {
        File::open(self.0.join(name))
    }

    pub(super) fn create_to_extend(&self, name: &str) -> io::Result<File> {
        File::options().read(true).write(true).create_new(true).open(self.0.join(name))
    }

    pub(super) fn file_to_extend(&self, name: &str) -> io::Result<File> {
        File::options().read(true).write(true).open(self.0.join(name))
    }

    pub(super) fn has_only_name(&self, _: &File, name: &str) -> io::Result<bool> {
        fs::symlink_metadata(self.0.join(name)).map(|data| data.is_file())
    }

    pub(super) fn rename(&self, from: &str, to: &str) -> io::Result<()> {
        fs::rename(self.0.join(from), self.0.join(to))
    }

    pub(super) fn remove(&self, name: &str) -> io::Result<()> {
        fs::remove_file(self.0.join(name))
    }

    pub(super) fn names(&self) -> io::Result<Vec<String>> {
        fs::read_dir(&self.0)?
            .map(|entry| Ok(entry?.file_name().into_string().ok()))
            .filter_map(Result::transpose)
            .collect()
    }

    pub(super) fn is_protected(&self, _: &str, _: &FileOwner) -> io::Result<bool> {
        Ok(false)
    }

    pub(super) fn is_sticky(&self) -> io::Result<bool> {
        Ok(false)
    }

    pub(super) fn sync(&self) -> io::Result<()> {
        Ok(())
    }
}

/// There are no locks on directories.
pub(super) fn has_no_locks(_: &io::Error) -> bool {
    true
}

/// Nothing is known about owners.
pub(in crate::write) fn give(_: &File, _: &FileOwner) -> io::Result<()> {
    Ok(())
}
