//! A file to be written, and why files were not written.

use std::path::PathBuf;
use std::{fmt, io};

/// A file that camgen does not replace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProtectedFile {
    /// The file.
    pub path: PathBuf,
    /// camgen wrote it, and it was changed since then.
    pub changed: bool,
}

impl fmt::Display for ProtectedFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let why = if self.changed { "was changed since camgen wrote it" } else { "was not written by camgen" };
        write!(f, "`{}` {why}", self.path.display())
    }
}

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Its name in the directory.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Why not every file was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FilesError {
    /// The directory cannot be made, opened or locked.
    #[error("cannot create or write the directory `{}`: {source}; choose another directory with --out", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Another run writes into the directory.
    #[error(
        "another run of camgen has been writing into `{}` for {seconds} s; nothing was changed: wait until it ends, or choose \
         another directory with --out",
        path.display()
    )]
    Busy {
        /// The directory.
        path: PathBuf,
        /// How long it was waited for.
        seconds: u64,
    },
    /// Files of these names exist that camgen did not write, or that were changed since then.
    #[error(
        "{}; nothing was written; choose another --name or --out, or replace the files with --overwrite",
        .0.iter().map(ProtectedFile::to_string).collect::<Vec<_>>().join(", ")
    )]
    Kept(Vec<ProtectedFile>),
    /// A growing file was not written by camgen, or belongs to another run.
    #[error("`{}` {why}; nothing was changed", path.display())]
    Part {
        /// The file.
        path: PathBuf,
        /// The fault and its remedy.
        why: String,
    },
    /// Another run is writing a growing file of this stem.
    #[error("another run of camgen is writing `{}`; nothing was changed: wait until it ends, or give another --name or --out", .0.display())]
    InUse(PathBuf),
    /// A file cannot be written.
    #[error("cannot write `{}`: {source}; nothing was changed", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A number in a file is not finite: a fault of camgen.
    #[error("line {line} of `{name}` would hold a number that is not finite; nothing was written; please report this")]
    NotFinite {
        /// The file.
        name: String,
        /// The line, from 1.
        line: usize,
    },
    /// The directory was renamed or replaced while files were made for it.
    #[error("the directory `{}` was moved or replaced while camgen was writing; nothing was changed", .0.display())]
    Moved(PathBuf),
    /// All files are written, but not every file has got its final name.
    #[error(
        "cannot replace `{}`: {source}; the new files are kept in this directory, and the next run that writes into it puts them in \
         place once that is possible",
        path.display()
    )]
    Unfinished {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The files of an earlier run were put in place, and then this run was refused.
    #[error("an earlier run was interrupted, and its files were put in place now: {}; then this run failed: {source}", finished.join(", "))]
    Finished {
        /// The files of the earlier run.
        finished: Vec<String>,
        /// Why this one was refused.
        source: Box<FilesError>,
    },
    /// The files of an earlier run cannot be put in place.
    #[error("an earlier run was interrupted, and its file `{}` cannot be put in place: {source}; nothing else was changed", path.display())]
    Left {
        /// The file that it failed at.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}
