//! One file: written whole and synced under a temporary name next to its target, and renamed over it.

use super::directory::{Directory, FileOwner, NameState, give};
use super::error::FilesError;
use super::interrupted::{StagedFile, create, is_plain};
use std::fs::File;
use std::io::{self, Write};

/// Writes one file with a single rename.
pub(super) fn write_one(directory: &Directory, name: &str, bytes: &[u8]) -> Result<(), FilesError> {
    let file = stage_one(directory, &mut 0, name, &mut |file| file.write_all(bytes))?;
    let renamed = directory.rename(&file.staged, name).inspect_err(|_| {
        let _ = directory.remove(&file.staged);
    });
    let placed = renamed.and_then(|()| directory.sync());
    placed.map_err(|source| FilesError::File { path: directory.path_of(name), source })
}

/// Writes a file next to its target. `number` is the number of the next temporary name of this run.
pub(super) fn stage_one(
    directory: &Directory,
    number: &mut usize,
    name: &str,
    write: &mut dyn FnMut(&mut File) -> io::Result<()>,
) -> Result<StagedFile, FilesError> {
    let failed = |source| FilesError::File { path: directory.path_of(name), source };
    let owned = target(directory, name).map_err(failed)?;
    let (staged, mut file) = create(directory, number, owned.is_some()).map_err(failed)?;
    let written = write(&mut file).and_then(|()| owned.as_ref().map_or(Ok(()), |owned| give(&file, owned)));
    if let Err(source) = written.and_then(|()| file.sync_all()) {
        let _ = directory.remove(&staged);
        return Err(failed(source));
    }
    Ok(StagedFile { staged, target: name.to_owned(), replaces: owned.map(|owned| owned.stamp().clone()) })
}

/// The owner of the file to be replaced; `None` if there is none.
pub(super) fn target(directory: &Directory, name: &str) -> io::Result<Option<FileOwner>> {
    if !is_plain(name) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a plain file name"));
    }
    let why = match directory.state_of(name)? {
        NameState::Nothing => return Ok(None),
        NameState::File(owned) if directory.is_protected(name, &owned)? => {
            "it cannot be replaced: it belongs to another user in a directory with the sticky bit, is immutable, or is a mount point"
        }
        NameState::File(owned) => return Ok(Some(owned)),
        NameState::Directory => "there is a directory of that name",
        NameState::Link(_) => {
            "there is a symbolic link of that name, which is not followed: remove it, or give its target as --out"
        }
        NameState::Other => "it exists and is not a regular file",
    };
    Err(io::Error::new(io::ErrorKind::AlreadyExists, why))
}
