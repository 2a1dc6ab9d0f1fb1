//! What camgen has written into a directory, so that it replaces its own files and no others.
//!
//! A record next to the files holds a digest of each as it was written, and the inputs of the last run under each stem. A file
//! that is as recorded, or as it would be written now, is replaced; any other only with --overwrite. A record that is
//! missing or damaged knows nothing: then no file counts as camgen's. The record is one of the files that are written all or none.

pub use super::error::ProtectedFile;

pub use super::known::RECORD;

use super::directory::{Directory, NameState};
use super::error::{FilesError, Output};
use super::files::{Content, NewFile, OutputDirectory, StagedFiles, after};
use super::finite;
use super::growing::{GrowingFile, refuse_growing};
use super::known::{DirectoryRecord, LARGEST, digest_of, file_digest, is_record, record_name};
use super::one_file::target;
use crate::report::sha256;
use camgen_kernel::document::file::bytes_of;
use camgen_kernel::document::{Input, shown};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// With more changes than these, the rest is only counted.
const MOST_SHOWN: usize = 8;
/// Ending of the name of a stem's table.
const TABLE: &str = ".csv";
/// Most records of a folder that are read; a folder that users share has one of each.
const MOST_RECORDS: usize = 20;
/// Characters of a name or a value that are shown: a record may have been made by anybody.
const LONGEST_SHOWN: usize = 80;

/// From what files are made, and which existing files may be replaced.
#[derive(Debug, Clone, Copy)]
pub struct WriteInputs<'a> {
    /// What the names of the files begin with.
    pub stem: &'a str,
    /// The name of the machine, which may be any text.
    pub machine: &'a str,
    /// Everything that determines the part.
    pub inputs: &'a [Input],
    /// Whether files that were edited or not written by camgen are replaced, too.
    pub overwrite: bool,
}

/// A run as it was recorded: what the names of its files begin with, and what they were made from.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedRun {
    /// What the names of its files begin with.
    pub stem: String,
    /// Everything that determines the part.
    pub inputs: Vec<Input>,
}

/// The runs in the records of a folder, by their stems; none where there is no record, or none that can be read.
#[must_use]
pub fn runs(folder: &Path) -> Vec<RecordedRun> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.retain(|name| is_record(name));
    names.sort();
    names.truncate(MOST_RECORDS);
    let read = |name: &String| bytes_of(&folder.join(name), LARGEST).ok();
    let records = names.iter().filter_map(read);
    let records = records.filter_map(|bytes| serde_json::from_slice::<DirectoryRecord>(&bytes).ok());
    let input = |(key, (value, typed)): (String, (String, String))| Input { key, value, typed };
    let run = |(stem, inputs): (String, BTreeMap<String, (String, String)>)| RecordedRun {
        stem,
        inputs: inputs.into_iter().map(input).collect(),
    };
    records.flat_map(|record| record.inputs).map(run).collect()
}

/// Digest of the inputs of a run.
fn digest(inputs: &[Input]) -> String {
    let words = inputs.iter().flat_map(|input| [input.key.as_str(), " = ", &input.value, "\n"]);
    sha256(words.collect::<String>().as_bytes())
}

/// A file to be written, as recorded.
struct RecordedFile {
    name: String,
    /// `None` until its content is written.
    digest: Option<String>,
}

impl RecordedFile {
    fn of(file: &NewFile<'_>) -> Result<Self, FilesError> {
        let digest = match &file.content {
            Content::Bytes(bytes) => Some(file_digest(bytes)),
            Content::Stream(_) => None,
            Content::Grown(grown) => Some(grown.file_digest()?),
        };
        Ok(Self { name: file.name.clone(), digest })
    }

    /// The name of an existing file with other content; `None` if there is no file, or it already has the same content.
    fn other(&self, directory: &Directory) -> std::io::Result<Option<&str>> {
        if !matches!(directory.state_of(&self.name)?, NameState::File(_)) {
            return Ok(None);
        }
        let same = self.digest.is_some() && Some(digest_of(directory.file(&self.name)?)?) == self.digest;
        Ok((!same).then_some(&self.name))
    }
}

impl DirectoryRecord {
    /// Of the files that would be replaced, those that are not as camgen wrote them. What is not a regular file is refused later, when it
    /// would be replaced.
    fn kept(&self, directory: &Directory, files: &[RecordedFile]) -> Result<Vec<ProtectedFile>, FilesError> {
        let mut kept = Vec::new();
        for file in files {
            let path = directory.path_of(&file.name);
            let failed = |source| FilesError::File { path: path.clone(), source };
            if let Some(name) = file.other(directory).map_err(failed)? {
                let known = self.knows(directory, name, name).map_err(failed)?;
                if known != Some(true) {
                    kept.push(ProtectedFile { path, changed: known.is_some() });
                }
            }
        }
        Ok(kept)
    }

    /// What differs from the last run under this stem: `rpm 35 → 34`.
    fn changes(&self, run: &WriteInputs<'_>) -> Vec<String> {
        let Some(last) = self.inputs.get(run.stem) else { return Vec::new() };
        let now: BTreeMap<&str, &Input> = run.inputs.iter().map(|input| (&*input.key, input)).collect();
        let changed = now.iter().filter_map(|(key, input)| match last.get(*key) {
            Some((value, _)) if *value == input.value => None,
            Some((_, typed)) => Some(format!("{key} {} → {}", plain(typed), input.typed)),
            None => Some(format!("{key} {}, not given before", input.typed)),
        });
        let gone = last.iter().filter(|(key, _)| !now.contains_key(key.as_str()));
        changed
            .chain(gone.map(|(key, (_, typed))| format!("{} {}, no longer given", plain(key), plain(typed))))
            .collect()
    }

    fn add(&mut self, directory: &Directory, added: Vec<RecordedFile>, run: &WriteInputs<'_>, made_from: &str) {
        self.files.retain(|name, _| !matches!(directory.state_of(name), Ok(NameState::Nothing)));
        self.made_from.extend(added.iter().map(|file| (file.name.clone(), made_from.to_owned())));
        self.files.extend(added.into_iter().filter_map(|file| Some((file.name, file.digest?))));
        let files = &self.files;
        self.made_from.retain(|name, _| files.contains_key(name));
        self.inputs.retain(|stem, _| files.keys().any(|name| name.starts_with(stem.as_str())));
        let inputs = run.inputs.iter().map(|input| (input.key.clone(), (input.value.clone(), input.typed.clone())));
        self.inputs.insert(run.stem.to_owned(), inputs.collect());
    }

    /// Files of a stem that were made from other inputs than these.
    fn of_other_inputs(&self, stem: &str, made_from: &str) -> Vec<String> {
        let of_stem = |name: &str| name.strip_prefix(stem).is_some_and(|rest| rest.starts_with(['.', '-']));
        let other = self.made_from.iter().filter(|(name, from)| of_stem(name) && *from != made_from);
        other.map(|(name, _)| plain(name)).collect()
    }
}

/// A name or a value of a record for a message: in one line, without what a terminal obeys.
fn plain(text: &str) -> String {
    shown(text, LONGEST_SHOWN)
}

/// Refuses files that must not be replaced, before work is done for them.
///
/// # Errors
/// [`FilesError::Kept`], as [`stage_recorded`] would.
pub fn refuse_protected(directory: &Path, outputs: &[Output]) -> Result<(), FilesError> {
    let Some(OutputDirectory { directory, finished, .. }) = OutputDirectory::found(directory)? else { return Ok(()) };
    let digest = |output: &Output| Some(file_digest(&output.bytes));
    let files: Vec<_> =
        outputs.iter().map(|output| RecordedFile { name: output.name.clone(), digest: digest(output) }).collect();
    refuse(&directory, &files).map_err(after(finished))
}

/// Options to open a growing file.
#[derive(Debug, Clone, Copy)]
pub struct GrowingOptions<'a> {
    /// The names of all files written with it.
    pub others: &'a [String],
    /// Also replace files that camgen has not written or that were changed since.
    pub overwrite: bool,
    /// Begin anew instead of continuing.
    pub restart: bool,
}

/// Opens the growing file `name` of a work in a directory, and continues an interrupted run of it.
///
/// # Errors
/// [`FilesError`] if a file to be replaced was not written by camgen, or the interrupted run was of another work.
pub fn open_growing(
    place: OutputDirectory,
    name: &str,
    of: &str,
    GrowingOptions { others, overwrite, restart }: GrowingOptions<'_>,
) -> Result<GrowingFile, FilesError> {
    let OutputDirectory { directory, finished, .. } = place;
    let files: Vec<_> = others.iter().map(|name| RecordedFile { name: name.clone(), digest: None }).collect();
    // A link or pipe of that name is refused now, not after hours.
    let mut free = others.iter().try_for_each(|name| refuse_odd(&directory, name));
    if free.is_ok() && !overwrite {
        free = refuse(&directory, &files);
    }
    free.and_then(|()| GrowingFile::open(directory, name, of, restart)).map_err(after(finished))
}

fn refuse_odd(directory: &Directory, name: &str) -> Result<(), FilesError> {
    let failed = |source| FilesError::File { path: directory.path_of(name), source };
    target(directory, name).map(|_| ()).map_err(failed)
}

fn refuse(directory: &Directory, files: &[RecordedFile]) -> Result<(), FilesError> {
    let (name, record) = read(directory)?;
    let unknown = record.is_none().then(|| ProtectedFile { path: directory.path_of(&name), changed: false });
    let mut kept = record.unwrap_or_default().kept(directory, files)?;
    kept.extend(unknown);
    if kept.is_empty() { Ok(()) } else { Err(FilesError::Kept(kept)) }
}

/// The user's record, and its name.
fn read(directory: &Directory) -> Result<(String, Option<DirectoryRecord>), FilesError> {
    let failed = |source| FilesError::File { path: directory.path_of(RECORD), source };
    let name = record_name(directory).map_err(failed)?;
    let record = DirectoryRecord::read(directory, &name).map_err(failed)?;
    Ok((name, record))
}

/// Writes all outputs of a run next to their targets in a directory; returns them with what differs from the last run under its stem, and
/// which of its files are still from other inputs, a sentence each.
///
/// # Errors
/// [`FilesError::Kept`] when a target exists that camgen did not write, or that was changed since then; else as
/// [`write_all`](super::files::write_all). Every file then is as it was.
pub fn stage_recorded(
    place: OutputDirectory,
    outputs: Vec<Output>,
    run: &WriteInputs<'_>,
) -> Result<(StagedFiles, Vec<String>), FilesError> {
    let words: Vec<&str> = run.inputs.iter().map(|input| &*input.typed).chain([run.stem, run.machine]).collect();
    finite::all(&outputs, &words)?;
    stage_files(place, outputs.into_iter().map(NewFile::from).collect(), run)
}

/// As [`stage_recorded`], for files whose content need not be in memory.
///
/// # Errors
/// As [`stage_recorded`], except that numbers are not checked to be finite.
pub fn stage_files(
    place: OutputDirectory,
    files: Vec<NewFile<'_>>,
    run: &WriteInputs<'_>,
) -> Result<(StagedFiles, Vec<String>), FilesError> {
    let OutputDirectory { directory, finished, left } = place;
    let (staged, mut notes) = staged(directory, files, run).map_err(after(finished.clone()))?;
    if !finished.is_empty() {
        notes.push(format!(
            "an earlier run was interrupted; its files were put in place first: {}",
            finished.join(", ")
        ));
    }
    Ok((staged.in_place_of(left), notes))
}

fn staged(
    directory: Directory,
    files: Vec<NewFile<'_>>,
    run: &WriteInputs<'_>,
) -> Result<(StagedFiles, Vec<String>), FilesError> {
    refuse_names_in_use(&directory, &files, run.stem)?;
    let mut recorded = files.iter().map(RecordedFile::of).collect::<Result<Vec<_>, _>>()?;
    if !run.overwrite {
        refuse(&directory, &recorded)?;
    }
    let (name, record) = read(&directory)?;
    let mut record = record.unwrap_or_default();
    let mut notes: Vec<String> = changes_note(&record.changes(run)).into_iter().collect();
    let made_from = digest(run.inputs);
    let mut staged = StagedFiles::of(directory);
    for (file, recorded) in files.into_iter().zip(&mut recorded) {
        let digest = staged.add(file)?;
        recorded.digest = recorded.digest.take().or(digest);
    }
    record.add(staged.directory(), recorded, run, &made_from);
    let other = record.of_other_inputs(run.stem, &made_from);
    if !other.is_empty() {
        notes.push(format!("still here, made from other inputs: {}", other.join(", ")));
    }
    // A record is a map of texts; writing it cannot fail.
    let bytes = serde_json::to_vec(&record).unwrap_or_default();
    staged.add(NewFile::from(Output { name, bytes }))?;
    Ok((staged, notes))
}

/// Refuses files that another run is writing as growing files, and files of a stem whose table is growing.
fn refuse_names_in_use(directory: &Directory, files: &[NewFile<'_>], stem: &str) -> Result<(), FilesError> {
    let others = files.iter().filter(|file| !matches!(file.content, Content::Grown(_)));
    others.clone().try_for_each(|file| refuse_growing(directory, &file.name))?;
    if others.count() < files.len() { Ok(()) } else { refuse_growing(directory, &format!("{stem}{TABLE}")) }
}

fn changes_note(changes: &[String]) -> Option<String> {
    let shown = changes.get(..MOST_SHOWN).unwrap_or(changes).join(", ");
    let more = match changes.len().saturating_sub(MOST_SHOWN) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    (!changes.is_empty()).then(|| format!("changed since the last files of this name: {shown}{more}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output(text: &str) -> Vec<Output> {
        vec![Output { name: "cam.dxf".into(), bytes: text.into() }]
    }

    fn write_recorded(
        directory: &Path,
        outputs: Vec<Output>,
        run: &WriteInputs<'_>,
    ) -> Result<Vec<String>, FilesError> {
        let (staged, notes) = stage_recorded(OutputDirectory::open(directory)?, outputs, run)?;
        staged.commit().map(|()| notes)
    }

    fn written(directory: &Path, text: &str, rpm: f64, overwrite: bool) -> Result<Vec<String>, FilesError> {
        let inputs = [Input::number("rpm", rpm), Input::quantity("follower.roller.radius", 0.03, ("mm", 1e-3))];
        write_recorded(directory, output(text), &WriteInputs { stem: "cam", machine: "", inputs: &inputs, overwrite })
    }

    #[test]
    fn own_files_are_replaced_and_the_change_is_reported() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        assert!(written(path, "1", 35.0, false).expect("new").is_empty());
        assert!(written(path, "1", 35.0, false).expect("the same").is_empty());
        let notes = written(path, "2", 34.0, false).expect("own");
        assert_eq!(notes, ["changed since the last files of this name: rpm 35 → 34"]);
        assert_eq!(fs::read_to_string(path.join("cam.dxf")).expect("a file"), "2");
    }

    /// A file that an earlier run left under this name is not taken for one of this run.
    #[test]
    fn files_of_other_inputs_are_reported() {
        let directory = tempfile::tempdir().expect("a directory");
        let write = |name: &str, rpm: f64| {
            let inputs = [Input::number("rpm", rpm)];
            let outputs = vec![Output { name: name.into(), bytes: name.into() }];
            write_recorded(
                directory.path(),
                outputs,
                &WriteInputs { stem: "cam", machine: "", inputs: &inputs, overwrite: false },
            )
        };
        assert!(write("cam.step", 35.0).expect("new").is_empty());
        assert!(write("camera.dxf", 35.0).expect("another stem").is_empty());
        let changed = "changed since the last files of this name: rpm 35 → 34";
        let other = "still here, made from other inputs: cam.step";
        assert_eq!(write("cam.dxf", 34.0).expect("new"), [changed, other]);
        assert_eq!(write("cam.svg", 34.0).expect("new"), [other]);
        assert!(write("cam.step", 34.0).expect("own").is_empty());
    }

    #[test]
    fn files_that_were_edited_or_are_not_known_are_kept() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        let file = path.join("cam.dxf");
        written(path, "1", 35.0, false).expect("new");
        fs::write(&file, "edited").expect("edited");
        let error = written(path, "2", 35.0, false).expect_err("edited");
        assert!(error.to_string().contains("was changed since camgen wrote it"), "{error}");
        assert_eq!(fs::read_to_string(&file).expect("a file"), "edited");
        assert!(written(path, "edited", 35.0, false).is_ok(), "as it would be written");

        for damage in
            ["", "{", "[]", "{\"files\": 1}", "\u{0}\u{1}", "{\"files\": {\"cam.dxf\": \"00\"}, \"inputs\": {}}"]
        {
            fs::write(path.join(RECORD), damage).expect("damaged");
            let error = written(path, "2", 35.0, false).expect_err(damage);
            let own = |kept: &[ProtectedFile]| kept.iter().any(|one| one.path == file);
            assert!(matches!(&error, FilesError::Kept(kept) if own(kept)), "{damage}: {error}");
        }
        fs::remove_file(path.join(RECORD)).expect("removed");
        assert!(written(path, "2", 35.0, false).is_err());
        assert!(written(path, "2", 35.0, true).is_ok());
        assert!(written(path, "3", 35.0, false).is_ok(), "it is known again");
    }

    /// Simultaneous runs lose neither files nor records of them.
    #[test]
    fn many_at_once_know_all_their_files() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        let write = |name: usize, text: &str| {
            let outputs = vec![Output { name: format!("{name}.dxf"), bytes: text.into() }];
            let stem = name.to_string();
            write_recorded(path, outputs, &WriteInputs { stem: &stem, machine: "", inputs: &[], overwrite: false })
        };
        std::thread::scope(|scope| {
            for name in 0..8 {
                scope.spawn(move || write(name, "first").expect("written"));
            }
        });
        for name in 0..8 {
            write(name, "second").expect("its own");
        }
        assert_eq!(fs::read_dir(path).expect("a directory").count(), 9, "nothing is left behind");
    }
}
