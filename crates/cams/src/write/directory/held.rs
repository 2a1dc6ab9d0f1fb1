//! A directory by its handle: every name is looked up in the directory that was opened.

use super::{FileStamp, NameState};
use rustix::fs::{AtFlags, Dir, FileType, Gid, Mode, OFlags, Stat, Uid};
use rustix::io::Errno;
use std::fs::{self, File, TryLockError};
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

/// Permissions of a file until it gets those of the file it replaces.
const PRIVATE: Mode = Mode::RUSR.union(Mode::WUSR);
/// Permissions of a new file, before the user's mask is applied.
const NEW: Mode = Mode::RUSR.union(Mode::WUSR).union(Mode::RGRP).union(Mode::WGRP).union(Mode::ROTH).union(Mode::WOTH);
/// The permission bits of a mode.
const PERMISSIONS: Mode = Mode::RWXU.union(Mode::RWXG).union(Mode::RWXO);

/// The owner of a file, and its permissions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::write) struct FileOwner {
    mode: Mode,
    user: Uid,
    group: Gid,
    stamp: FileStamp,
}

impl FileOwner {
    fn of(stat: &Stat) -> Self {
        Self {
            mode: Mode::from_raw_mode(stat.st_mode) & PERMISSIONS,
            user: Uid::from_raw(stat.st_uid),
            group: Gid::from_raw(stat.st_gid),
            stamp: FileStamp(format!("{} {}.{}", stat.st_size, stat.st_mtime, stat.st_mtime_nsec)),
        }
    }

    pub(in crate::write) fn stamp(&self) -> &FileStamp {
        &self.stamp
    }

    /// Whether it belongs to the user who runs.
    pub(in crate::write) fn is_own(&self) -> bool {
        self.user == rustix::process::geteuid()
    }
}

#[derive(Debug)]
pub(super) struct DirectoryHandle(File);

impl DirectoryHandle {
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
        Ok(Self(File::from(rustix::fs::open(path, flags, Mode::empty())?)))
    }

    pub(super) fn try_lock(&self) -> Result<(), TryLockError> {
        self.0.try_lock()
    }

    pub(super) fn unlock(&self) {
        // Closing the handle also unlocks the directory.
        let _ = self.0.unlock();
    }

    /// Another handle of the same directory, with a lock of its own.
    pub(super) fn again(&self) -> io::Result<Self> {
        let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
        Ok(Self(File::from(rustix::fs::openat(&self.0, ".", flags, Mode::empty())?)))
    }

    pub(super) fn is_at(&self, path: &Path) -> io::Result<bool> {
        let own = self.0.metadata()?;
        match fs::metadata(path) {
            Ok(there) => Ok((there.dev(), there.ino()) == (own.dev(), own.ino())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
            Err(error) => Err(error),
        }
    }

    pub(super) fn state_of(&self, name: &str) -> io::Result<NameState> {
        let stat = match rustix::fs::statat(&self.0, name, AtFlags::SYMLINK_NOFOLLOW) {
            Err(Errno::NOENT) => return Ok(NameState::Nothing),
            stat => stat?,
        };
        Ok(match FileType::from_raw_mode(stat.st_mode) {
            FileType::RegularFile => NameState::File(FileOwner::of(&stat)),
            FileType::Directory => NameState::Directory,
            FileType::Symlink => NameState::Link(FileOwner::of(&stat)),
            _ => NameState::Other,
        })
    }

    pub(super) fn create(&self, name: &str, private: bool) -> io::Result<File> {
        let mode = if private { PRIVATE } else { NEW };
        let flags = OFlags::WRONLY | OFlags::CREATE | OFlags::EXCL | OFlags::NOFOLLOW | OFlags::CLOEXEC;
        Ok(File::from(rustix::fs::openat(&self.0, name, flags, mode)?))
    }

    pub(super) fn file(&self, name: &str) -> io::Result<File> {
        // Opening does not wait for a pipe that was put there in the meantime.
        let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
        Ok(File::from(rustix::fs::openat(&self.0, name, flags, Mode::empty())?))
    }

    pub(super) fn create_to_extend(&self, name: &str) -> io::Result<File> {
        let flags = OFlags::RDWR | OFlags::CREATE | OFlags::EXCL | OFlags::NOFOLLOW | OFlags::CLOEXEC;
        Ok(File::from(rustix::fs::openat(&self.0, name, flags, NEW)?))
    }

    pub(super) fn file_to_extend(&self, name: &str) -> io::Result<File> {
        let flags = OFlags::RDWR | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
        Ok(File::from(rustix::fs::openat(&self.0, name, flags, Mode::empty())?))
    }

    pub(super) fn has_only_name(&self, file: &File, name: &str) -> io::Result<bool> {
        let (open, there) = (file.metadata()?, rustix::fs::statat(&self.0, name, AtFlags::SYMLINK_NOFOLLOW)?);
        Ok((open.dev(), open.ino(), open.nlink()) == (there.st_dev, there.st_ino, 1))
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

    /// Whether a file cannot be replaced by a user who may write here: because of the sticky bit, or because the system protects it.
    pub(super) fn is_protected(&self, name: &str, owned: &FileOwner) -> io::Result<bool> {
        let own = rustix::fs::fstat(&self.0)?;
        let user = rustix::process::geteuid();
        let may = user == Uid::ROOT || user == owned.user || user == Uid::from_raw(own.st_uid);
        Ok(!may && Mode::from_raw_mode(own.st_mode).contains(Mode::SVTX) || is_kept(&self.0, name))
    }

    pub(super) fn is_sticky(&self) -> io::Result<bool> {
        Ok(Mode::from_raw_mode(rustix::fs::fstat(&self.0)?.st_mode).contains(Mode::SVTX))
    }

    pub(super) fn sync(&self) -> io::Result<()> {
        self.0.sync_all()
    }
}

/// Whether the system lets nobody replace a file: it is immutable, or a mount point.
#[cfg(target_os = "linux")]
fn is_kept(directory: &File, name: &str) -> bool {
    use rustix::fs::{StatxAttributes, StatxFlags, statx};
    let kept = StatxAttributes::IMMUTABLE | StatxAttributes::APPEND | StatxAttributes::MOUNT_ROOT;
    // Where the system cannot say, the replacement is tried.
    let stat = statx(directory, name, AtFlags::SYMLINK_NOFOLLOW, StatxFlags::empty());
    stat.is_ok_and(|stat| stat.stx_attributes.intersects(kept))
}

#[cfg(not(target_os = "linux"))]
fn is_kept(_: &File, _: &str) -> bool {
    false
}

/// Whether an error says that the file system has no locks, or no locks on directories.
pub(super) fn has_no_locks(error: &io::Error) -> bool {
    let none = [Errno::NOLCK, Errno::NOSYS, Errno::OPNOTSUPP, Errno::BADF, Errno::INVAL];
    none.iter().any(|errno| error.raw_os_error() == Some(errno.raw_os_error()))
}

/// Gives a file the owner and the permissions of another. Only the superuser can give files away: where that is refused the
/// file is the user's own.
pub(in crate::write) fn give(file: &File, owned: &FileOwner) -> io::Result<()> {
    let own = FileOwner::of(&rustix::fs::fstat(file)?);
    if (own.user, own.group) != (owned.user, owned.group) {
        let _ = rustix::fs::fchown(file, Some(owned.user), Some(owned.group));
    }
    if own.mode != owned.mode {
        rustix::fs::fchmod(file, owned.mode)?;
    }
    Ok(())
}
