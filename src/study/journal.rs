//! The table of a study on disk while it is made: it grows under a temporary name, can be continued after the program was killed, and is
//! renamed when it is complete.
//!
//! `STEM.csv.part` holds the rows done, `STEM.csv.part.json` the digest of their study. A line that was cut off, and everything after a line
//! whose number is not the next one, is made again. So the table of an interrupted run has the bytes of one that was not.

use super::specification::{Study, StudyError};
use super::summary::Summary;
use super::table::cells;
use crate::refusal::Refusal;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Bytes read at a time.
const BUFFER: usize = 1 << 16;

/// What is written beside the table and its summary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StudyFiles {
    /// The page with charts, which the feature `html` makes.
    pub page: bool,
    /// The table as Parquet too, which the feature `parquet` writes.
    pub parquet: bool,
    /// Replace a table that camgen has not written, or that was changed.
    pub overwrite: bool,
    /// Begin anew where an interrupted run could be continued.
    pub restart: bool,
}

/// The growing table of a study.
#[derive(Debug)]
pub struct Journal {
    table: PathBuf,
    part: PathBuf,
    marker: PathBuf,
    file: File,
    done: u64,
}

fn failed(path: &Path, what: &str) -> impl Fn(io::Error) -> StudyError {
    let path = path.display().to_string();
    let what = what.to_owned();
    move |error| StudyError::Refused(Refusal::new(format!("cannot {what} {path}: {error}")))
}

/// A path with more after its name.
fn with(path: &Path, end: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(end);
    name.into()
}

/// Writes a file whole: under a temporary name, synced and renamed.
fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
    place_whole(path, |file| file.write_all(bytes))
}

/// Puts what `write` writes into a file whole.
fn place_whole(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> Result<(), StudyError> {
    let temporary = with(path, ".tmp");
    let place = || {
        let mut file = File::create(&temporary)?;
        write(&mut file)?;
        file.sync_all()?;
        fs::rename(&temporary, path)
    };
    place().map_err(|error| {
        _ = fs::remove_file(&temporary);
        failed(path, "write")(error)
    })
}

/// The SHA-256 of a file.
fn digest_of(path: &Path) -> io::Result<String> {
    let (mut file, mut hash, mut buffer) = (File::open(path)?, Sha256::new(), vec![0; BUFFER]);
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(hash.finalize().iter().fold(String::new(), |text, byte| text + &format!("{byte:02x}"))),
            count => hash.update(buffer.get(..count).unwrap_or_default()),
        }
    }
}

/// A JSON file, where it is one.
fn json_of(path: &Path) -> Option<Value> {
    serde_json::from_slice(&fs::read(path).ok()?).ok()
}

/// Whether camgen wrote the table, and nobody has changed it since.
fn is_own(table: &Path, summary: &Path) -> bool {
    let recorded = json_of(summary).and_then(|summary| Some(summary.get("csv_sha256")?.as_str()?.to_owned()));
    recorded.is_some() && recorded == digest_of(table).ok()
}

impl Journal {
    /// Opens the table of a study in a directory, which is made when missing, and continues what an interrupted run has left.
    ///
    /// # Errors
    /// [`Refusal`] where a file cannot be made or would be replaced, or where the interrupted run was of another study.
    pub fn open(study: &Study, directory: &Path, stem: &str, files: StudyFiles) -> Result<Self, StudyError> {
        if files.parquet && !cfg!(feature = "parquet") {
            let what = "this program is built without Parquet";
            return Err(Refusal::new(what).remedy("build it with cargo build --release --features parquet").into());
        }
        fs::create_dir_all(directory).map_err(failed(directory, "make the directory"))?;
        let table = directory.join(format!("{stem}.csv"));
        if table.exists() && !files.overwrite && !is_own(&table, &table.with_extension("json")) {
            let what = format!("{} was changed, or is not a table of camgen: it is not replaced", table.display());
            return Err(Refusal::new(what).remedy("give --overwrite or another --name").into());
        }
        let (part, marker) = (with(&table, ".part"), with(&table, ".part.json"));
        let options = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&part);
        let mut file = options.map_err(failed(&part, "write"))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let what = format!("another camgen is writing {}", part.display());
                return Err(Refusal::new(what).remedy("wait for its end, or give another --name").into());
            }
            // The other: a file system without locks.
            Ok(()) | Err(TryLockError::Error(_)) => {}
        }
        let known = json_of(&marker).and_then(|marker| Some(marker.get("study")?.as_str()?.to_owned()));
        let length = file.metadata().map_err(failed(&part, "read"))?.len();
        if length > 0 && !files.restart && known.as_deref() != Some(study.digest()) {
            let what =
                format!("{} is of an interrupted run of another study, base or version of camgen", part.display());
            return Err(Refusal::new(what).remedy("give --restart to begin anew, or another --name").into());
        }
        let kept = if files.restart { None } else { kept(study, &mut file).map_err(failed(&part, "read"))? };
        let marked = serde_json::to_vec(&json!({"study": study.digest()})).unwrap_or_default();
        write_whole(&marker, &marked)?;
        let header = study.header();
        let (length, done) = kept.unwrap_or((0, 0));
        let mut start = || {
            file.set_len(length)?;
            file.seek(SeekFrom::End(0))?;
            if length == 0 { file.write_all(header.as_bytes()) } else { Ok(()) }
        };
        start().map_err(failed(&part, "write"))?;
        Ok(Self { table, part, marker, file, done })
    }

    /// Rows that are in the table already.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.done
    }

    /// Adds the lines of rows up to a number.
    ///
    /// # Errors
    /// [`Refusal`] where they cannot be written; the rows before them are kept for the next run.
    pub fn add(&mut self, done: u64, lines: &[u8]) -> Result<(), StudyError> {
        self.file.write_all(lines).map_err(|error| {
            let what = format!("cannot write {}: {error}", self.part.display());
            Refusal::new(what).remedy("the same command continues with the row after the last one that was written")
        })?;
        self.done = done;
        Ok(())
    }

    /// Completes the files: the summary, what else is wanted, and last the table. Returns the summary, its JSON, and the files.
    ///
    /// # Errors
    /// [`Refusal`] where a file cannot be written; the table then keeps its temporary name.
    #[cfg_attr(
        not(feature = "html"),
        expect(unused_variables, reason = "which files are wanted matters to the page alone")
    )]
    pub fn finish(self, study: &Study, files: StudyFiles) -> Result<(Summary, Value, Vec<PathBuf>), StudyError> {
        self.file.sync_all().map_err(failed(&self.part, "write"))?;
        let open = || File::open(&self.part).map(|file| BufReader::with_capacity(BUFFER, file));
        let summary = study.summary(open).map_err(failed(&self.part, "read"))?;
        let csv = digest_of(&self.part).map_err(failed(&self.part, "read"))?;
        let json = study.summary_json(&summary, &csv);
        let mut written = vec![self.table.clone(), self.table.with_extension("json")];
        let side = |end: &str| {
            let stem = self.table.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            self.table.with_file_name(format!("{stem}{end}"))
        };
        if study.kind() == super::StudyKind::Pareto {
            let front = side("-front.csv");
            let lines: Vec<String> = summary.front.iter().map(|line| format!("{line}\n")).collect();
            write_whole(&front, (study.header() + &lines.concat()).as_bytes())?;
            written.push(front);
        }
        #[cfg(feature = "html")]
        if files.page {
            let path = side(".html");
            write_whole(&path, &super::page::of(study, &summary).map_err(StudyError::Refused)?)?;
            written.push(path);
        }
        #[cfg(feature = "parquet")]
        if files.parquet {
            let path = side(".parquet");
            let header = study.header();
            place_whole(&path, |file| super::parquet::write(&header, open, file))?;
            written.push(path);
        }
        let bytes = serde_json::to_vec_pretty(&json).unwrap_or_default();
        write_whole(&self.table.with_extension("json"), &[bytes.as_slice(), b"\n"].concat())?;
        fs::rename(&self.part, &self.table).map_err(failed(&self.table, "write"))?;
        fs::remove_file(&self.marker).map_err(failed(&self.marker, "remove"))?;
        Ok((summary, json, written))
    }
}

/// The length of what is whole of an interrupted table, and the number of its rows; `None` where that is nothing.
fn kept(study: &Study, file: &mut File) -> io::Result<Option<(u64, u64)>> {
    file.seek(SeekFrom::Start(0))?;
    let mut lines = BufReader::with_capacity(BUFFER, &mut *file);
    let header = study.header();
    let columns = cells(header.trim_end()).len();
    let (mut length, mut rows, mut line) = (0_u64, 0_u64, Vec::new());
    loop {
        line.clear();
        if lines.read_until(b'\n', &mut line)? == 0 || line.last() != Some(&b'\n') {
            break;
        }
        let text = String::from_utf8_lossy(&line);
        let whole = if length == 0 {
            text == header
        } else {
            let found = cells(text.trim_end());
            found.len() == columns
                && found.first().is_some_and(|first| *first == rows.to_string())
                && rows < study.count()
        };
        if !whole {
            break;
        }
        rows += u64::from(length > 0);
        length += line.len() as u64;
    }
    Ok((length > 0).then_some((length, rows)))
}
