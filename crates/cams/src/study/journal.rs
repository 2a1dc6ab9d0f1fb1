//! The table of a study while it is made: it grows under a temporary name, can be continued after a kill, and gets its final
//! name together with the summary (`write::growing`).

use super::specification::{Study, StudyError};
use super::summary::Summary;
use crate::write::files::{Content, FilesError, NewFile, OutputDirectory, StagedFiles};
use crate::write::growing::GrowingFile;
use crate::write::record::{GrowingOptions, WriteInputs, open_growing, stage_files};
use camgen_kernel::document::Input;
use camgen_kernel::refusal::Refusal;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Digits of the study digest in messages.
const SHOWN_DIGITS: usize = 12;

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

impl StudyFiles {
    /// The names of the files of a study.
    #[must_use]
    pub fn names(self, study: &Study, stem: &str) -> Vec<String> {
        let is_pareto = study.kind() == super::StudyKind::Pareto;
        let all = [
            (".csv", true),
            (".json", true),
            ("-front.csv", is_pareto),
            (".html", self.page),
            (".parquet", self.parquet),
        ];
        all.into_iter().filter(|(_, wanted)| *wanted).map(|(end, _)| format!("{stem}{end}")).collect()
    }
}

/// The growing table of a study.
#[derive(Debug)]
pub struct Journal {
    table: GrowingFile,
    directory: PathBuf,
    stem: String,
    files: StudyFiles,
}

/// A complete study.
#[derive(Debug)]
pub struct CompleteStudy {
    /// The results of its rows.
    pub summary: Summary,
    /// The summary as JSON.
    pub json: Value,
    /// The files.
    pub written: Vec<PathBuf>,
    /// Differences from earlier files of this name, a sentence each.
    pub notes: Vec<String>,
}

impl From<FilesError> for StudyError {
    fn from(error: FilesError) -> Self {
        Self::Refused(Refusal::new(error.to_string()))
    }
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
        let names = files.names(study, stem);
        let StudyFiles { overwrite, restart, .. } = files;
        let options = GrowingOptions { others: &names, overwrite, restart };
        let place = OutputDirectory::open(directory)?;
        let table = open_growing(place, &format!("{stem}.csv"), study.digest(), options)?;
        let mut journal = Self { table, directory: directory.to_owned(), stem: stem.to_owned(), files };
        if journal.table.is_empty() {
            journal.add(0, study.header().as_bytes())?;
        }
        Ok(journal)
    }

    /// Rows that are in the table already.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.table.rows()
    }

    /// Adds the lines of rows up to a number.
    ///
    /// # Errors
    /// [`Refusal`] if they cannot be written; saved rows are kept for the next run.
    pub fn add(&mut self, done: u64, lines: &[u8]) -> Result<(), StudyError> {
        self.table.add(done, lines).map_err(continued)
    }

    /// Saves the rows added so far for a next run. It waits for the disk, so the caller decides how often.
    ///
    /// # Errors
    /// As [`Journal::add`].
    pub fn save(&self) -> Result<(), StudyError> {
        self.table.save().map_err(continued)
    }

    /// Saves the rows and returns their results.
    ///
    /// # Errors
    /// [`Refusal`] if they cannot be saved or read; saved rows are kept for the next run.
    pub fn summary(&self, study: &Study) -> Result<Summary, StudyError> {
        self.save()?;
        Ok(study
            .summary(|| self.table.reader())
            .map_err(|error| Refusal::new(format!("cannot read the table of {}: {error}", self.stem)))?)
    }

    /// The directory, opened again for the files of the complete study.
    ///
    /// # Errors
    /// [`Refusal`] if the directory cannot be opened; the rows are kept for the next run.
    pub fn reopened(&self) -> Result<OutputDirectory, StudyError> {
        Ok(OutputDirectory::of_grown(&self.table)?)
    }

    /// Writes the summary and the other wanted files under temporary names, to be put in place with the table.
    ///
    /// # Errors
    /// [`Refusal`] if a file cannot be written or would be replaced; the rows are kept for the next run.
    pub fn stage(
        &self,
        place: OutputDirectory,
        study: &Study,
        summary: Summary,
    ) -> Result<(CompleteStudy, StagedFiles), StudyError> {
        let json = study.summary_json(&summary, &self.table.sha256());
        let files = self.new_files(study, &summary, &json)?;
        let written = files.iter().map(|file| self.directory.join(&file.name)).collect();
        let inputs = inputs(study);
        let run =
            WriteInputs { stem: &self.stem, machine: study.name(), inputs: &inputs, overwrite: self.files.overwrite };
        let (staged, notes) = stage_files(place, files, &run)?;
        Ok((CompleteStudy { summary, json, written, notes }, staged))
    }

    fn new_files(&self, study: &Study, summary: &Summary, json: &Value) -> Result<Vec<NewFile<'_>>, StudyError> {
        let mut files = Vec::new();
        for name in self.files.names(study, &self.stem) {
            let content = match name.strip_prefix(&self.stem).unwrap_or_default() {
                ".csv" => Content::Grown(&self.table),
                "-front.csv" => {
                    let lines: Vec<String> = summary.front.iter().map(|line| format!("{line}\n")).collect();
                    Content::Bytes((study.header() + &lines.concat()).into_bytes())
                }
                #[cfg(feature = "html")]
                ".html" => Content::Bytes(super::page::write(study, summary).map_err(StudyError::Refused)?),
                #[cfg(feature = "parquet")]
                ".parquet" => {
                    let header = study.header();
                    Content::Stream(Box::new(move |file| super::parquet::write(&header, || self.table.reader(), file)))
                }
                ".json" => {
                    let bytes = serde_json::to_vec_pretty(json).unwrap_or_default();
                    Content::Bytes([bytes.as_slice(), b"\n"].concat())
                }
                _ => continue,
            };
            files.push(NewFile { name, content });
        }
        Ok(files)
    }
}

/// The inputs of the files of a study, for their record.
fn inputs(study: &Study) -> Vec<Input> {
    let digest = study.digest();
    let shown = digest.get(..SHOWN_DIGITS).unwrap_or(digest);
    let input =
        |key: &str, value: &str, typed: &str| Input { key: key.into(), value: value.into(), typed: typed.into() };
    vec![input("command", "study", "study"), input("study", digest, shown)]
}

/// An error after which saved rows are kept.
fn continued(error: FilesError) -> StudyError {
    let FilesError::File { path, source } = error else { return error.into() };
    let what = format!("cannot write {}: {source}", path.display());
    Refusal::new(what).remedy("run the same command again: it continues after the last saved rows").into()
}
