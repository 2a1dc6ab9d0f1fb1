//! What camgen has written into a directory, so that it replaces its own files and nobody else's.
//!
//! A record beside the files holds a digest of each as it was written, and the inputs of the last run under each stem. A file
//! that is as recorded, or as it would be written now, is replaced; any other is not, unless that is asked for. A record that is
//! missing or damaged knows nothing: then every file is somebody else's. The record is one of the files that are written all or none.

use super::directory::{Directory, Standing};
use super::files::{FilesError, Output, Place, Staged, after, stage};
use super::finite;
use crate::document::Input;
use crate::report::sha256;
use serde::{Deserialize, Serialize};
use siphasher::sip128::SipHasher13;
use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Name of the record in the directory of the files.
pub const RECORD: &str = ".camgen.json";
/// Largest record that is read, bytes: far above that of ten thousand cams.
const LARGEST: u64 = 1 << 26;
/// Hexadecimal digits of SHA-256.
const SHA256_DIGITS: usize = 64;
/// More changes than these are counted.
const MOST_TOLD: usize = 8;

/// From what files are made, and which of those that stand in their places may be replaced.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// What the names of the files begin with.
    pub stem: &'a str,
    /// Everything that determines the part.
    pub inputs: &'a [Input],
    /// Replace files that were edited or not written by camgen, too.
    pub overwrite: bool,
}

/// A file that camgen does not replace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kept {
    /// The file.
    pub path: PathBuf,
    /// camgen wrote it, and it was changed since.
    pub changed: bool,
}

impl fmt::Display for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let why = if self.changed { "was changed since camgen wrote it" } else { "was not written by camgen" };
        write!(f, "`{}` {why}", self.path.display())
    }
}

/// The record of a directory.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Record {
    /// Digest of each file.
    files: BTreeMap<String, String>,
    /// By stem and key, the value as it is compared and as it was typed.
    inputs: BTreeMap<String, BTreeMap<String, (String, String)>>,
    /// Digest of the inputs that each file was made from.
    #[serde(default)]
    made_from: BTreeMap<String, String>,
}

/// Digest of a file: SipHash-1-3 of 128 bits. It finds what was edited by anybody but an attacker, who could write the record as well.
fn file_digest(bytes: &[u8]) -> String {
    format!("{:032x}", SipHasher13::new().hash(bytes).as_u128())
}

/// Whether a file is as recorded; by an earlier version its SHA-256 was.
fn is_as_recorded(bytes: &[u8], recorded: &str) -> bool {
    recorded == if recorded.len() == SHA256_DIGITS { sha256(bytes) } else { file_digest(bytes) }
}

/// Digest of the inputs of a run.
fn digest(inputs: &[Input]) -> String {
    let words = inputs.iter().flat_map(|input| [input.key.as_str(), " = ", &input.value, "\n"]);
    sha256(words.collect::<String>().as_bytes())
}

impl Record {
    /// `None` where what stands in its place is no record; an empty one where nothing does.
    fn read(directory: &Directory) -> io::Result<Option<Self>> {
        match directory.standing(RECORD)? {
            Standing::Nothing => Ok(Some(Self::default())),
            Standing::File(_) => Ok(serde_json::from_slice(&directory.read(RECORD, LARGEST)?).ok()),
            _ => Ok(None),
        }
    }

    /// Of the files that would be replaced, those that are not as camgen wrote them. What is no file is refused when it would be replaced.
    fn kept(&self, directory: &Directory, outputs: &[Output]) -> Result<Vec<Kept>, FilesError> {
        let mut kept = Vec::new();
        for output in outputs {
            let path = directory.path_of(&output.name);
            let failed = |source| FilesError::File { path: path.clone(), source };
            if matches!(directory.standing(&output.name).map_err(failed)?, Standing::File(_)) {
                let found = directory.read(&output.name, u64::MAX).map_err(failed)?;
                let recorded = self.files.get(&output.name);
                if found != output.bytes && recorded.is_none_or(|digest| !is_as_recorded(&found, digest)) {
                    kept.push(Kept { path, changed: recorded.is_some() });
                }
            }
        }
        Ok(kept)
    }

    /// What differs from the last run under this stem: `rpm 35 → 34`.
    fn changes(&self, run: &Run<'_>) -> Vec<String> {
        let Some(last) = self.inputs.get(run.stem) else { return Vec::new() };
        let now: BTreeMap<&str, &Input> = run.inputs.iter().map(|input| (&*input.key, input)).collect();
        let changed = now.iter().filter_map(|(key, input)| match last.get(*key) {
            Some((value, _)) if *value == input.value => None,
            Some((_, typed)) => Some(format!("{key} {typed} → {}", input.typed)),
            None => Some(format!("{key} {}, not given before", input.typed)),
        });
        let gone = last.iter().filter(|(key, _)| !now.contains_key(key.as_str()));
        changed.chain(gone.map(|(key, (_, typed))| format!("{key} {typed}, no longer given"))).collect()
    }

    fn add(&mut self, directory: &Directory, outputs: &[Output], run: &Run<'_>, made_from: &str) {
        self.files.retain(|name, _| !matches!(directory.standing(name), Ok(Standing::Nothing)));
        self.files.extend(outputs.iter().map(|output| (output.name.clone(), file_digest(&output.bytes))));
        self.made_from.extend(outputs.iter().map(|output| (output.name.clone(), made_from.to_owned())));
        let files = &self.files;
        self.made_from.retain(|name, _| files.contains_key(name));
        self.inputs.retain(|stem, _| files.keys().any(|name| name.starts_with(stem.as_str())));
        let inputs = run.inputs.iter().map(|input| (input.key.clone(), (input.value.clone(), input.typed.clone())));
        self.inputs.insert(run.stem.to_owned(), inputs.collect());
    }

    /// Files of a stem that other inputs than these have made.
    fn of_other_inputs(&self, stem: &str, made_from: &str) -> Vec<String> {
        let of_stem = |name: &str| name.strip_prefix(stem).is_some_and(|rest| rest.starts_with(['.', '-']));
        let other = self.made_from.iter().filter(|(name, from)| of_stem(name) && *from != made_from);
        other.map(|(name, _)| name.clone()).collect()
    }
}

/// Refuses files that must not be replaced, before work is done for them.
///
/// # Errors
/// [`FilesError::Kept`], as [`stage_recorded`] would.
pub fn refuse_kept(directory: &Path, outputs: &[Output]) -> Result<(), FilesError> {
    match Place::found(directory)? {
        Some(Place { directory, finished }) => refuse(&directory, outputs).map_err(after(finished)),
        None => Ok(()),
    }
}

fn refuse(directory: &Directory, outputs: &[Output]) -> Result<(), FilesError> {
    let record = read(directory)?;
    let unknown = record.is_none().then(|| Kept { path: directory.path_of(RECORD), changed: false });
    let mut kept = record.unwrap_or_default().kept(directory, outputs)?;
    kept.extend(unknown);
    if kept.is_empty() { Ok(()) } else { Err(FilesError::Kept(kept)) }
}

fn read(directory: &Directory) -> Result<Option<Record>, FilesError> {
    Record::read(directory).map_err(|source| FilesError::File { path: directory.path_of(RECORD), source })
}

/// Writes all outputs of a run beside their places in a directory; gives them with what differs from the last run under its stem, and which
/// of its files are still of other inputs, a sentence each.
///
/// # Errors
/// [`FilesError::Kept`] when a file stands in a place that camgen has not written, or that was changed since; else as
/// [`write_all`](super::files::write_all). Every file then is as it was.
pub fn stage_recorded(place: Place, outputs: Vec<Output>, run: &Run<'_>) -> Result<(Staged, Vec<String>), FilesError> {
    let words: Vec<&str> = run.inputs.iter().map(|input| &*input.typed).chain([run.stem]).collect();
    finite::all(&outputs, &words)?;
    let Place { directory, finished } = place;
    let (staged, mut notes) = staged(directory, outputs, run).map_err(after(finished.clone()))?;
    if !finished.is_empty() {
        notes.push(format!("an earlier run was cut off; put in place of it first: {}", finished.join(", ")));
    }
    Ok((staged, notes))
}

fn staged(directory: Directory, outputs: Vec<Output>, run: &Run<'_>) -> Result<(Staged, Vec<String>), FilesError> {
    if !run.overwrite {
        refuse(&directory, &outputs)?;
    }
    let mut record = read(&directory)?.unwrap_or_default();
    let mut notes: Vec<String> = told(&record.changes(run)).into_iter().collect();
    let made_from = digest(run.inputs);
    record.add(&directory, &outputs, run, &made_from);
    let other = record.of_other_inputs(run.stem, &made_from);
    if !other.is_empty() {
        notes.push(format!("still here, and made from other inputs: {}", other.join(", ")));
    }
    // A record is a map of texts, which cannot fail to be written.
    let bytes = serde_json::to_vec(&record).unwrap_or_default();
    let mut all = outputs;
    all.push(Output { name: RECORD.into(), bytes });
    Ok((stage(directory, &all)?, notes))
}

fn told(changes: &[String]) -> Option<String> {
    let shown = changes.get(..MOST_TOLD).unwrap_or(changes).join(", ");
    let more = match changes.len().saturating_sub(MOST_TOLD) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    (!changes.is_empty()).then(|| format!("changed since the last files of this name: {shown}{more}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn output(text: &str) -> Vec<Output> {
        vec![Output { name: "cam.dxf".into(), bytes: text.into() }]
    }

    fn write_recorded(directory: &Path, outputs: Vec<Output>, run: &Run<'_>) -> Result<Vec<String>, FilesError> {
        let (staged, notes) = stage_recorded(Place::open(directory)?, outputs, run)?;
        staged.commit().map(|()| notes)
    }

    fn written(directory: &Path, text: &str, rpm: f64, overwrite: bool) -> Result<Vec<String>, FilesError> {
        let inputs = [Input::number("rpm", rpm), Input::quantity("follower.roller.radius", 0.03, ("mm", 1e-3))];
        write_recorded(directory, output(text), &Run { stem: "cam", inputs: &inputs, overwrite })
    }

    #[test]
    fn own_files_are_replaced_and_the_change_is_told() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        assert!(written(path, "1", 35.0, false).expect("new").is_empty());
        assert!(written(path, "1", 35.0, false).expect("the same").is_empty());
        let told = written(path, "2", 34.0, false).expect("own");
        assert_eq!(told, ["changed since the last files of this name: rpm 35 → 34"]);
        assert_eq!(fs::read_to_string(path.join("cam.dxf")).expect("a file"), "2");
    }

    /// A file that an earlier run left under the same name is not taken for one of this run.
    #[test]
    fn files_of_other_inputs_are_told() {
        let directory = tempfile::tempdir().expect("a directory");
        let write = |name: &str, rpm: f64| {
            let inputs = [Input::number("rpm", rpm)];
            let outputs = vec![Output { name: name.into(), bytes: name.into() }];
            write_recorded(directory.path(), outputs, &Run { stem: "cam", inputs: &inputs, overwrite: false })
        };
        assert!(write("cam.step", 35.0).expect("new").is_empty());
        assert!(write("camera.dxf", 35.0).expect("another stem").is_empty());
        let changed = "changed since the last files of this name: rpm 35 → 34";
        let other = "still here, and made from other inputs: cam.step";
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
            let own = |kept: &[Kept]| kept.iter().any(|one| one.path == file);
            assert!(matches!(&error, FilesError::Kept(kept) if own(kept)), "{damage}: {error}");
        }
        fs::remove_file(path.join(RECORD)).expect("removed");
        assert!(written(path, "2", 35.0, false).is_err());
        assert!(written(path, "2", 35.0, true).is_ok());
        assert!(written(path, "3", 35.0, false).is_ok(), "it is known again");
    }

    /// Runs at the same time neither lose files nor what was recorded of them.
    #[test]
    fn many_at_once_know_all_their_files() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        let write = |name: usize, text: &str| {
            let outputs = vec![Output { name: format!("{name}.dxf"), bytes: text.into() }];
            let stem = name.to_string();
            write_recorded(path, outputs, &Run { stem: &stem, inputs: &[], overwrite: false })
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
