//! A directory by its handle: every name is looked up in the directory that was opened.

use super::{Stamp, Standing};
use rustix::fs::{AtFlags, Dir, FileType, Gid, Mode, OFlags, Stat, Uid};
use rustix::io::Errno;
use std::fs::{self, File, TryLockError};
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

/// Who may read and write a file that gets its permissions from the one it replaces, until it has them.
const PRIVATE: Mode = Mode::RUSR.union(Mode::WUSR);
/// Who may read and write a new file, less what the user's mask takes.
const NEW: Mode = Mode::RUSR.union(Mode::WUSR).union(Mode::RGRP).union(Mode::WGRP).union(Mode::ROTH).union(Mode::WOTH);
/// Of a mode, what says who may read, write and execute.
const PERMISSIONS: Mode = Mode::RWXU.union(Mode::RWXG).union(Mode::RWXO);

/// Whose a file is, and who may do what with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::write) struct Owned {
    mode: Mode,
    user: Uid,
    group: Gid,
    stamp: Stamp,
}

impl Owned {
    fn of(stat: &Stat) -> Self {
        Self {
            mode: Mode::from_raw_mode(stat.st_mode) & PERMISSIONS,
            user: Uid::from_raw(stat.st_uid),
            group: Gid::from_raw(stat.st_gid),
            stamp: Stamp(format!("{} {}.{}", stat.st_size, stat.st_mtime, stat.st_mtime_nsec)),
        }
    }

    pub(in crate::write) fn stamp(&self) -> &Stamp {
        &self.stamp
    }
}

#[derive(Debug)]
pub(super) struct Held(File);

impl Held {
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
        Ok(Self(File::from(rustix::fs::open(path, flags, Mode::empty())?)))
    }

    pub(super) fn try_lock(&self) -> Result<(), TryLockError> {
        self.0.try_lock()
    }

    pub(super) fn is_at(&self, path: &Path) -> io::Result<bool> {
        let own = self.0.metadata()?;
        match fs::metadata(path) {
            Ok(there) => Ok((there.dev(), there.ino()) == (own.dev(), own.ino())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
            Err(error) => Err(error),
        }
    }

    pub(super) fn standing(&self, name: &str) -> io::Result<Standing> {
        let stat = match rustix::fs::statat(&self.0, name, AtFlags::SYMLINK_NOFOLLOW) {
            Err(Errno::NOENT) => return Ok(Standing::Nothing),
            stat => stat?,
        };
        Ok(match FileType::from_raw_mode(stat.st_mode) {
            FileType::RegularFile => Standing::File(Owned::of(&stat)),
            FileType::Directory => Standing::Directory,
            FileType::Symlink => Standing::Link,
            _ => Standing::Other,
        })
    }

    pub(super) fn create(&self, name: &str, private: bool) -> io::Result<File> {
        let mode = if private { PRIVATE } else { NEW };
        let flags = OFlags::WRONLY | OFlags::CREATE | OFlags::EXCL | OFlags::NOFOLLOW | OFlags::CLOEXEC;
        Ok(File::from(rustix::fs::openat(&self.0, name, flags, mode)?))
    }

    pub(super) fn file(&self, name: &str) -> io::Result<File> {
        // A pipe that was put there in the meantime is not waited for.
        let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
        Ok(File::from(rustix::fs::openat(&self.0, name, flags, Mode::empty())?))
    }

    pub(super) fn rename(&self, from: &str, to: &str) -> io::Result<()> {
        Ok(rustix::fs::renameat(&self.0, from, &self.0, to)?)
    }

    pub(super) fn remove(&self, name: &str) -> io::Result<()> {
        Ok(rustix::fs::unlinkat(&self.0, name, AtFlags::empty())?)
    }

    pub(super) fn names(&self) -> io::Result<Vec<String>> {
        let names = Dir::read_from(&self.0)?.map(|entry| Ok(entry?.file_name().to_str().map(str::to_owned).ok()));
        names.filter_map(Result::transpose).collect()
    }

    /// Whether a file cannot be replaced by one who may write here: the sticky bit, or a file that the system keeps.
    pub(super) fn guards(&self, name: &str, owned: &Owned) -> io::Result<bool> {
        let own = rustix::fs::fstat(&self.0)?;
        let user = rustix::process::geteuid();
        let may = user == Uid::ROOT || user == owned.user || user == Uid::from_raw(own.st_uid);
        Ok(!may && Mode::from_raw_mode(own.st_mode).contains(Mode::SVTX) || is_kept(&self.0, name))
    }

    pub(super) fn sync(&self) -> io::Result<()> {
        self.0.sync_all()
    }
}

/// Whether the system lets nobody replace a file: it is immutable, or something is mounted on it.
#[cfg(target_os = "linux")]
fn is_kept(directory: &File, name: &str) -> bool {
    use rustix::fs::{StatxAttributes, StatxFlags, statx};
    let kept = StatxAttributes::IMMUTABLE | StatxAttributes::APPEND | StatxAttributes::MOUNT_ROOT;
    // What cannot be asked is tried.
    let stat = statx(directory, name, AtFlags::SYMLINK_NOFOLLOW, StatxFlags::empty());
    stat.is_ok_and(|stat| stat.stx_attributes.intersects(kept))
}

#[cfg(not(target_os = "linux"))]
fn is_kept(_: &File, _: &str) -> bool {
    false
}

/// Whether an error says that the file system has no locks, or none of directories.
pub(super) fn has_no_locks(error: &io::Error) -> bool {
    let none = [Errno::NOLCK, Errno::NOSYS, Errno::OPNOTSUPP, Errno::BADF, Errno::INVAL];
    none.iter().any(|errno| error.raw_os_error() == Some(errno.raw_os_error()))
}

/// Makes a file belong to whom another belonged, with its permissions. Only the superuser can give files away: where that is refused the
/// file is the user's own.
pub(in crate::write) fn give(file: &File, owned: &Owned) -> io::Result<()> {
    let own = Owned::of(&rustix::fs::fstat(file)?);
    if (own.user, own.group) != (owned.user, owned.group) {
        let _ = rustix::fs::fchown(file, Some(owned.user), Some(owned.group));
    }
    if own.mode != owned.mode {
        rustix::fs::fchmod(file, owned.mode)?;
    }
    Ok(())
}
