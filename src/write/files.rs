//! All files of a run or none: written beside their targets, synced, then renamed.
//!
//! Every file is written whole under a temporary name in its own directory. Only when all are on the disk are they
//! renamed, each over its predecessor, which is kept under another name until the last rename has succeeded; a failure
//! in between puts the old files back.

use super::record::Kept;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, TempPath};

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Its name in the directory.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Why nothing was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FilesError {
    /// The directory cannot be made.
    #[error("cannot make the directory `{}`: {source}; choose another with --out", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Files stand in the places that camgen has not written, or that were changed since.
    #[error(
        "{}; nothing was written: choose another --name or --out, or replace with --overwrite",
        .0.iter().map(Kept::to_string).collect::<Vec<_>>().join(", ")
    )]
    Kept(Vec<Kept>),
    /// A file cannot be written or put in its place.
    #[error("cannot write `{}`: {source}; nothing was changed", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file cannot be put in its place, and neither can what stood in the places of the files before it.
    #[error(
        "cannot write `{}`: {source}; not everything could be put back: {}",
        path.display(),
        left.iter().map(Left::to_string).collect::<Vec<_>>().join(", ")
    )]
    NotPutBack {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
        /// What is not as it was before.
        left: Vec<Left>,
    },
}

/// A file that is not as it was before.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Left {
    /// The file.
    pub target: PathBuf,
    /// Where its old content is; `None` where there was none and the new one could not be removed.
    pub old: Option<PathBuf>,
}

impl fmt::Display for Left {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let target = self.target.display();
        match &self.old {
            Some(old) => write!(f, "the old `{target}` is kept as `{}`", old.display()),
            None => write!(f, "the new `{target}` is still there"),
        }
    }
}

/// Writes all outputs into a directory, which is made when missing, and returns their paths.
///
/// # Errors
/// [`FilesError`]; then every file is as it was before, or, where the system refuses that too, the error names where it is.
pub fn write_all(directory: &Path, outputs: &[Output]) -> Result<Vec<PathBuf>, FilesError> {
    fs::create_dir_all(directory).map_err(|source| FilesError::Directory { path: directory.to_owned(), source })?;
    let mut staged: Vec<(TempPath, PathBuf)> = Vec::new();
    for output in outputs {
        let target = directory.join(&output.name);
        let temporary = stage(directory, &target, &output.bytes)
            .map_err(|source| FilesError::File { path: target.clone(), source })?;
        staged.push((temporary, target));
    }
    let mut placed: Vec<(PathBuf, Option<TempPath>)> = Vec::new();
    for (temporary, target) in staged {
        if let Err(source) = place(directory, temporary, &target, &mut placed) {
            let left = put_back(placed);
            return Err(match left.as_slice() {
                [] => FilesError::File { path: target, source },
                _ => FilesError::NotPutBack { path: target, source, left },
            });
        }
    }
    sync_directory(directory);
    Ok(placed.into_iter().map(|(target, _)| target).collect())
}

fn stage(directory: &Path, target: &Path, bytes: &[u8]) -> io::Result<TempPath> {
    if target.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "a directory of that name is in the way"));
    }
    let mut file = NamedTempFile::with_prefix_in(".camgen-", directory)?;
    file.write_all(bytes)?;
    make_readable(file.as_file())?;
    file.as_file().sync_all()?;
    Ok(file.into_temp_path())
}

/// A temporary file is private; an output is as readable as any new file of the user: owner writes, all read.
#[cfg(unix)]
fn make_readable(file: &File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &File) -> io::Result<()> {
    Ok(())
}

/// Renames over the target; what stood there is kept in `placed` under its other name.
fn place(
    directory: &Path,
    temporary: TempPath,
    target: &Path,
    placed: &mut Vec<(PathBuf, Option<TempPath>)>,
) -> io::Result<()> {
    let old = if target.exists() {
        let keep = NamedTempFile::with_prefix_in(".camgen-old-", directory)?.into_temp_path();
        fs::rename(target, &keep)?;
        Some(keep)
    } else {
        None
    };
    // Noted before the rename, so that a failure of it is undone as well.
    placed.push((target.to_owned(), old));
    temporary.persist(target).map_err(|error| error.error)
}

/// Puts back what stood in the places; returns what could not be.
fn put_back(placed: Vec<(PathBuf, Option<TempPath>)>) -> Vec<Left> {
    let mut left = Vec::new();
    for (target, old) in placed {
        let old = match old {
            Some(old) => match old.persist(&target) {
                Ok(()) => continue,
                Err(mut error) => {
                    // Dropped, it would be deleted: the only copy there is.
                    error.path.disable_cleanup(true);
                    Some(error.path.to_path_buf())
                }
            },
            None => match fs::remove_file(&target) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => None,
                _ => continue,
            },
        };
        left.push(Left { target, old });
    }
    left
}

/// Makes the renames last through a power cut, where the system can.
fn sync_directory(directory: &Path) {
    if let Ok(handle) = File::open(directory) {
        let _ = handle.sync_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output(name: &str, text: &str) -> Output {
        Output { name: name.into(), bytes: text.into() }
    }

    fn names(directory: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(directory)
            .expect("a directory")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn writes_all_and_replaces() {
        let directory = tempfile::tempdir().expect("a directory");
        let inner = directory.path().join("a/b");
        write_all(&inner, &[output("x", "1"), output("y", "2")]).expect("written");
        write_all(&inner, &[output("x", "3")]).expect("replaced");
        assert_eq!(fs::read_to_string(inner.join("x")).expect("x"), "3");
        assert_eq!(names(&inner), ["x", "y"]);
    }

    #[test]
    fn a_failure_leaves_every_file_as_it_was() {
        let directory = tempfile::tempdir().expect("a directory");
        write_all(directory.path(), &[output("x", "old")]).expect("written");
        fs::create_dir(directory.path().join("y")).expect("in the way");
        let error = write_all(directory.path(), &[output("x", "new"), output("y", "2")]).expect_err("y is a directory");
        assert!(error.to_string().contains("in the way"), "{error}");
        assert_eq!(fs::read_to_string(directory.path().join("x")).expect("x"), "old");
        assert_eq!(names(directory.path()), ["x", "y"]);
    }

    #[test]
    fn a_file_in_place_of_the_directory_is_told() {
        let directory = tempfile::tempdir().expect("a directory");
        let file = directory.path().join("out");
        fs::write(&file, "x").expect("written");
        assert!(matches!(write_all(&file, &[output("x", "1")]), Err(FilesError::Directory { .. })));
    }

    #[test]
    fn what_was_placed_is_put_back() {
        let directory = tempfile::tempdir().expect("a directory");
        let (kept, fresh) = (directory.path().join("kept"), directory.path().join("fresh"));
        fs::write(&kept, "old").expect("written");
        let stage = |target: &Path| stage(directory.path(), target, b"new").expect("staged");
        let mut placed = Vec::new();
        for target in [&kept, &fresh] {
            place(directory.path(), stage(target), target, &mut placed).expect("placed");
        }
        assert_eq!(fs::read_to_string(&kept).expect("kept"), "new");
        assert_eq!(put_back(placed), []);
        assert_eq!(fs::read_to_string(&kept).expect("kept"), "old");
        assert_eq!(names(directory.path()), ["kept"]);
    }

    /// Where the system does not let the old file back into its place it is kept, and the error says where.
    #[test]
    fn an_old_file_is_never_lost() {
        let directory = tempfile::tempdir().expect("a directory");
        let target = directory.path().join("x");
        fs::write(&target, "old").expect("written");
        let mut placed = Vec::new();
        let staged = stage(directory.path(), &target, b"new").expect("staged");
        place(directory.path(), staged, &target, &mut placed).expect("placed");
        fs::remove_file(&target).expect("removed");
        fs::create_dir(&target).expect("a directory in the way, over which no file can be renamed");
        let left = put_back(placed);
        let old = left.first().and_then(|left| left.old.clone()).expect("kept");
        assert_eq!(fs::read_to_string(&old).expect("the old file"), "old");
        let source = io::Error::from(io::ErrorKind::PermissionDenied);
        let told = FilesError::NotPutBack { path: target, source, left }.to_string();
        assert!(told.contains(&old.display().to_string()), "{told}");
    }
}
