//! A directory by its path, where the system gives no handle to look names up in.

use super::{Stamp, Standing};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Whose a file is: nothing is known of that.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::write) struct Owned {
    stamp: Stamp,
}

impl Owned {
    pub(in crate::write) fn stamp(&self) -> &Stamp {
        &self.stamp
    }
}

#[derive(Debug)]
pub(super) struct Held(PathBuf);

impl Held {
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        fs::read_dir(path).map(|_| Self(path.to_owned()))
    }

    pub(super) fn try_lock(&self) -> Result<(), TryLockError> {
        Err(TryLockError::Error(io::ErrorKind::Unsupported.into()))
    }

    pub(super) fn is_at(&self, path: &Path) -> io::Result<bool> {
        Ok(self.0 == path)
    }

    pub(super) fn standing(&self, name: &str) -> io::Result<Standing> {
        let data = match fs::symlink_metadata(self.0.join(name)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Standing::Nothing),
            data => data?,
        };
        let kind = data.file_type();
        Ok(if kind.is_file() {
            Standing::File(Owned { stamp: Stamp(format!("{} {:?}", data.len(), data.modified().ok())) })
        } else if kind.is_dir() {
            Standing::Directory
        } else if kind.is_symlink() {
            Standing::Link
        } else {
            Standing::Other
        })
    }

    pub(super) fn create(&self, name: &str, _: bool) -> io::Result<File> {
        File::create_new(self.0.join(name))
    }

    pub(super) fn file(&self, name: &str) -> io::Result<File> {
        File::open(self.0.join(name))
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

    pub(super) fn guards(&self, _: &str, _: &Owned) -> io::Result<bool> {
        Ok(false)
    }

    pub(super) fn sync(&self) -> io::Result<()> {
        Ok(())
    }
}

/// There are no locks of directories.
pub(super) fn has_no_locks(_: &io::Error) -> bool {
    true
}

/// Nothing is known of owners.
pub(in crate::write) fn give(_: &File, _: &Owned) -> io::Result<()> {
    Ok(())
}
