//! A file that grows for hours and survives a kill of its program: `NAME.part`. `NAME.part.json` identifies its work, and the part that camgen
//! has written by length and SHA-256.
//!
//! A run that continues keeps only these bytes: later ones may be incomplete, and are made again. If these bytes have changed, nothing is
//! continued. Both files belong to the user of the run, are regular files and have no other name; any other file of these names is
//! refused and not touched. The directory is locked only while a name is made, so that other runs may write into it meanwhile; the growing file
//! itself is locked all the time.

use super::directory::{Directory, FileOwner, NameState, give};
use super::error::FilesError;
use super::known::{digest_of, each_block};
use super::one_file::write_one;
use super::part::{Marker, marker_of, part_of};
use crate::report::hexadecimal;
use sha2::{Digest, Sha256};
use std::fs::{File, TryLockError};
use std::io::{self, BufReader, Seek, SeekFrom, Write};

/// Lines above the rows.
const HEADER: u64 = 1;
/// Bytes read at a time.
const BUFFER: usize = 1 << 16;

/// A growing file.
#[derive(Debug)]
pub struct GrowingFile {
    directory: Directory,
    name: String,
    /// The digest of its work.
    of: String,
    file: File,
    hash: Sha256,
    rows: u64,
    bytes: u64,
}

impl GrowingFile {
    /// Opens the growing file `name` of a work in a locked directory, and continues an interrupted run of it unless `restart`.
    pub(super) fn open(mut directory: Directory, name: &str, of: &str, restart: bool) -> Result<Self, FilesError> {
        let Some((file, marker, hash)) = Self::kept(&directory, name, of, restart)? else {
            return Self::new(directory, name, of);
        };
        directory.keep();
        directory.unlock();
        let (name, of) = (name.to_owned(), of.to_owned());
        Ok(Self { directory, name, of, file, hash, rows: marker.rows, bytes: marker.bytes })
    }

    /// The file to continue, positioned after the bytes that camgen wrote. A file that is not continued is removed.
    fn kept(
        directory: &Directory,
        name: &str,
        of: &str,
        restart: bool,
    ) -> Result<Option<(File, Marker, Sha256)>, FilesError> {
        let part = part_of(name);
        let failed = |source| FilesError::File { path: directory.path_of(&part), source };
        let refused = |why: &str| Err(FilesError::Part { path: directory.path_of(&part), why: why.to_owned() });
        let marker = Marker::read(directory, &marker_of(name))?;
        let marker = match (directory.state_of(&part).map_err(failed)?, marker) {
            (NameState::Nothing, _) => return Ok(None),
            (NameState::File(owned), Some(marker)) if owned.is_own() => marker,
            _ => return refused("was not written by camgen: move it away, or give another --name"),
        };
        let mut file = directory.file_to_extend(&part).map_err(failed)?;
        if !directory.has_only_name(&file, &part).map_err(failed)? {
            return refused("has a second name (a hard link): remove one of the two, or give another --name");
        }
        lock(directory, &part, &file)?;
        if !restart && marker.study != of {
            let why = "is from an interrupted run of another study, base or version of camgen: give --restart to begin anew, or another --name";
            return refused(why);
        }
        if restart || marker.bytes == 0 {
            directory.remove(&part).map_err(failed)?;
            return Ok(None);
        }
        let (mut hash, mut lines) = (Sha256::new(), LineCount::default());
        let take = |block: &[u8]| {
            hash.update(block);
            lines.add(block);
        };
        let read = each_block(&file, marker.bytes, take).map_err(failed)?;
        if read != marker.bytes || hexadecimal(&hash.clone().finalize()) != marker.sha256 {
            return refused("was changed since camgen wrote it: give --restart to begin anew, or another --name");
        }
        if lines.complete.checked_sub(HEADER) != Some(marker.rows) {
            return refused(&format!(
                "has {} rows, but its record, which was changed, states {}: give --restart to begin anew, or another --name",
                lines.complete.saturating_sub(HEADER),
                marker.rows
            ));
        }
        let at_end = file.set_len(marker.bytes).and_then(|()| file.seek(SeekFrom::End(0)));
        at_end.map_err(failed)?;
        Ok(Some((file, marker, hash)))
    }

    /// Creates a growing file. Its marker is written first: a file without a marker is not camgen's.
    fn new(mut directory: Directory, name: &str, of: &str) -> Result<Self, FilesError> {
        let part = part_of(name);
        let marker = Marker { study: of.to_owned(), rows: 0, bytes: 0, sha256: hexadecimal(&Sha256::digest([])) };
        write_marker(&directory, name, &marker)?;
        let file = directory.create_to_extend(&part);
        let file = file.map_err(|source| FilesError::File { path: directory.path_of(&part), source })?;
        lock(&directory, &part, &file)?;
        directory.keep();
        directory.unlock();
        let (name, of) = (name.to_owned(), of.to_owned());
        Ok(Self { directory, name, of, file, hash: Sha256::new(), rows: 0, bytes: 0 })
    }

    /// Rows in it.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Whether it is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bytes == 0
    }

    /// Adds bytes, with which it has so many rows below a line of headings.
    ///
    /// # Errors
    /// An error of writing; saved bytes are kept for the next run.
    pub fn add(&mut self, rows: u64, bytes: &[u8]) -> Result<(), FilesError> {
        self.file.write_all(bytes).map_err(|source| self.failed(source))?;
        self.hash.update(bytes);
        self.bytes += bytes.len() as u64;
        self.rows = rows;
        Ok(())
    }

    /// Saves the bytes added so far for a next run. Does nothing while another run has the directory.
    ///
    /// # Errors
    /// [`FilesError`] if the disk refuses it.
    pub fn save(&self) -> Result<(), FilesError> {
        match self.directory.locked_if_free()? {
            Some(directory) => self.saved_in(&directory),
            None => Ok(()),
        }
    }

    fn saved_in(&self, directory: &Directory) -> Result<(), FilesError> {
        self.file.sync_all().map_err(|source| self.failed(source))?;
        let marker = Marker { study: self.of.clone(), rows: self.rows, bytes: self.bytes, sha256: self.sha256() };
        write_marker(directory, &self.name, &marker)
    }

    /// Saves it, and returns its locked directory for the files that are put in place with it.
    pub(super) fn saved(&self) -> Result<Directory, FilesError> {
        let directory = self.directory.locked()?;
        self.saved_in(&directory)?;
        Ok(directory)
    }

    /// The SHA-256 of its content.
    #[must_use]
    pub fn sha256(&self) -> String {
        hexadecimal(&self.hash.clone().finalize())
    }

    /// Reads it from its beginning; one reader at a time.
    ///
    /// # Errors
    /// An error of reading.
    pub fn reader(&self) -> io::Result<BufReader<File>> {
        let mut file = self.file.try_clone()?;
        file.seek(SeekFrom::Start(0))?;
        Ok(BufReader::with_capacity(BUFFER, file))
    }

    pub(super) fn file_digest(&self) -> Result<String, FilesError> {
        self.reader().and_then(digest_of).map_err(|source| self.failed(source))
    }

    /// Refuses if its name now belongs to another file.
    pub(super) fn is_still_in(&self, directory: &Directory) -> Result<(), FilesError> {
        let path = self.directory.path_of(&part_of(&self.name));
        match directory.has_only_name(&self.file, &part_of(&self.name)) {
            Ok(true) => Ok(()),
            Ok(false) => {
                Err(FilesError::Part { path, why: "was moved or replaced while camgen was writing it".into() })
            }
            Err(source) => Err(FilesError::File { path, source }),
        }
    }

    pub(super) fn give(&self, owned: &FileOwner) -> io::Result<()> {
        give(&self.file, owned)
    }

    fn failed(&self, source: io::Error) -> FilesError {
        FilesError::File { path: self.directory.path_of(&part_of(&self.name)), source }
    }
}

/// Lines of a table in blocks of bytes; a cell in quotes may have several.
#[derive(Debug, Default)]
struct LineCount {
    complete: u64,
    is_quoted: bool,
}

impl LineCount {
    fn add(&mut self, block: &[u8]) {
        for byte in block {
            match byte {
                b'"' => self.is_quoted = !self.is_quoted,
                b'\n' if !self.is_quoted => self.complete += 1,
                _ => {}
            }
        }
    }
}

fn write_marker(directory: &Directory, name: &str, marker: &Marker) -> Result<(), FilesError> {
    // A marker is a map of texts and numbers; writing it cannot fail.
    write_one(directory, &marker_of(name), &serde_json::to_vec(marker).unwrap_or_default())
}

/// Locks a growing file against other runs until it is closed.
fn lock(directory: &Directory, part: &str, file: &File) -> Result<(), FilesError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(FilesError::InUse(directory.path_of(part))),
        // Other errors: a file system without locks.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// Refuses a name under which another run is writing a growing file.
pub(super) fn refuse_growing(directory: &Directory, name: &str) -> Result<(), FilesError> {
    let part = part_of(name);
    let failed = |source| FilesError::File { path: directory.path_of(&part), source };
    if !matches!(directory.state_of(&part).map_err(failed)?, NameState::File(_)) {
        return Ok(());
    }
    match directory.file(&part).map(|file| file.try_lock_shared()) {
        Ok(Err(TryLockError::WouldBlock)) => Err(FilesError::InUse(directory.path_of(&part))),
        // A file that cannot be opened belongs to another user.
        _ => Ok(()),
    }
}
