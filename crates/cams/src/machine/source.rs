//! Machine files and those in the binary, read against a catalogue of tables.

use super::embedded::Embedded;
use super::other_files::instead_of_machine;
use super::{CamData, FollowerData, MachineError, MachineParts, stem};
use camgen_kernel::document::{
    FileFault, FlatText, InputFiles, KnownValues, NamedFiles, NamedFolder, Reader, Tables, similar,
};
use camgen_kernel::motion::program::{self, FollowerMovement, Program, ProgramSpan};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// Largest machine file, bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// What machine files may contain, and those in the binary.
#[derive(Debug)]
pub struct Catalogue {
    /// Their tables.
    pub keys: Tables,
    /// The machine files in the binary; the first is the default.
    pub embedded: Vec<Embedded>,
    /// How each domain reads its part of a machine.
    pub parts: Vec<ReadParts>,
    /// The names of all checks, in the order of reports.
    pub checks: Vec<&'static str>,
    /// The names of those that read what was written.
    pub file_checks: Vec<&'static str>,
}

/// Reads what a domain finds in a machine file, with the cam and the follower where they have no fault.
pub type ReadParts = fn(&Reader<'_>, (Option<&CamData>, Option<&FollowerData>), &mut MachineParts);

/// A motion program as it was read, and what it was read for.
type ReadMotion = (Option<FollowerMovement>, Option<ProgramSpan>, Arc<Program>);

/// The text of a machine file, read once: machines of it with other values are made without reading the text again.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::machine::MachineSource;
/// use camgen::{Machine, Spec};
///
/// let source = MachineSource::load("feeder")?;
/// for radius in [12, 14, 16] {
///     let machine = Machine::of_source(&source, &[format!("follower.roller.radius={radius}mm")])?;
///     let cam = Spec::of_program(machine, None).ok_or("the file has no motion")?.solve()?;
///     assert_eq!(cam.body().machine().name(), "Feeder");
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct MachineSource {
    /// What it is read against.
    pub catalogue: &'static Catalogue,
    /// What messages call it.
    name: String,
    /// What the names of its files begin with.
    stem: String,
    text: FlatText,
    /// What it has without overrides, where that is without a fault.
    known: Arc<OnceLock<Option<KnownValues>>>,
    /// Its motion without overrides of a key of it, and for what follower and cam it was read.
    motion: Arc<OnceLock<ReadMotion>>,
    /// The user wrote it.
    pub(super) by_user: bool,
    /// Where the files are that it names.
    files: NamedFiles,
}

impl MachineSource {
    /// A text of the user that is not in a folder.
    #[must_use]
    pub fn of_user(catalogue: &'static Catalogue, name: &str, text: &str) -> Self {
        let (stem, text) = (stem::fitting(name), FlatText::new(text, &catalogue.keys.sections));
        let (known, motion) = (Arc::default(), Arc::default());
        Self { catalogue, name: name.to_owned(), stem, text, known, motion, by_user: true, files: NamedFiles::Nowhere }
    }

    /// The text.
    #[must_use]
    pub fn text(&self) -> &str {
        self.text.text()
    }

    /// What the names of its files begin with.
    #[must_use]
    pub fn stem(&self) -> &str {
        &self.stem
    }

    /// The text as of a file in the working folder: other files that its overrides name are found from there.
    pub(crate) fn in_working_folder(self, files: &InputFiles) -> Self {
        let folder = NamedFolder { path: PathBuf::new(), confines_overrides: false, files: files.clone() };
        Self { files: NamedFiles::Folder(folder), ..self }
    }

    /// The text with overrides that are not the user's own: files named in them must be in the folder of the text.
    #[must_use]
    pub fn with_confined_overrides(self) -> Self {
        let files = match self.files {
            NamedFiles::Folder(folder) => NamedFiles::Folder(NamedFolder { confines_overrides: true, ..folder }),
            other => other,
        };
        Self { files, ..self }
    }

    /// With the texts of the files that it names, by these names: in the place of a folder.
    #[must_use]
    pub fn with_texts(self, texts: BTreeMap<String, String>) -> Self {
        Self { files: NamedFiles::Texts(texts), ..self }
    }

    /// The texts of the files that it and its overrides name, by these names; one that has a fault is missing.
    #[must_use]
    pub fn named_texts(&self, overrides: &[String]) -> BTreeMap<String, String> {
        self.reader(overrides).named_texts()
    }

    /// Reads everything.
    fn reader(&self, overrides: &[String]) -> Reader<'_> {
        let place = (&self.files, self.name.as_str());
        Reader::of_flat(place, self.text.clone(), overrides, &self.catalogue.keys.sections)
    }

    /// Reads what overrides set.
    fn reader_of_known<'s>(&'s self, overrides: &[String], known: &'s KnownValues) -> Option<Reader<'s>> {
        let place = (&self.files, self.name.as_str());
        Reader::of_known(place, &self.text, overrides, &self.catalogue.keys.sections, known)
    }

    fn known(&self) -> Option<&KnownValues> {
        self.known.get_or_init(|| self.reader(&[]).known()).as_ref()
    }

    /// The motion; it is read once for all machines that have the same one.
    pub(super) fn motion(
        &self,
        reader: &Reader<'_>,
        follower: Option<FollowerMovement>,
        span: Option<ProgramSpan>,
    ) -> Option<Arc<Program>> {
        let read = || program::read::read(reader, follower, span).map(Arc::new);
        if !reader.is_known(&program::keys::SECTION) {
            return read();
        }
        if let Some((of_follower, of_span, motion)) = self.motion.get() {
            return if (*of_follower, *of_span) == (follower, span) { Some(Arc::clone(motion)) } else { read() };
        }
        let motion = read()?;
        if reader.is_faultless() {
            // Another thread may have been first, with the same.
            _ = self.motion.set((follower, span, Arc::clone(&motion)));
        }
        Some(motion)
    }

    /// The result of `parts` for this text.
    ///
    /// # Errors
    /// All faults found.
    pub fn read<T>(
        &self,
        overrides: &[String],
        parts: impl FnOnce(&Reader<'_>) -> Option<T>,
    ) -> Result<T, MachineError> {
        let known = if overrides.is_empty() { None } else { self.known() };
        let reader = known.and_then(|known| self.reader_of_known(overrides, known));
        let reader = reader.unwrap_or_else(|| self.reader(overrides));
        let made = parts(&reader);
        reader.finish().map_err(|faults| MachineError { faults })?;
        // A part is missing only after a fault, so `finish` has returned before.
        made.ok_or(MachineError { faults: Vec::new() })
    }
}

impl Catalogue {
    /// Whether a check of this name reads what was written.
    #[must_use]
    pub fn reads_files(&self, check: &str) -> bool {
        self.file_checks.contains(&check)
    }

    /// The text of an embedded machine by its name, or of a file; `files` reads it and the files that it names.
    ///
    /// # Errors
    /// A file that cannot be read, or is not a machine file; what is wrong in it shows when a machine is made of it.
    pub fn source(&'static self, name_or_path: &str, files: &InputFiles) -> Result<MachineSource, MachineError> {
        let path = Path::new(name_or_path);
        let named = self.embedded.iter().find(|machine| machine.name == name_or_path).or_else(|| {
            self.embedded.iter().find(|machine| machine.name.eq_ignore_ascii_case(name_or_path) && !path.exists())
        });
        if let Some(embedded) = named {
            let of_embedded = MachineSource::of_user(self, &format!("{} (embedded)", embedded.name), embedded.toml);
            return Ok(MachineSource { stem: embedded.name.to_owned(), by_user: false, ..of_embedded });
        }
        let text = files.text_of(path, LARGEST_FILE).map_err(|why| MachineError {
            faults: vec![FileFault {
                key: None,
                message: format!("cannot read the machine file `{name_or_path}`: {why}"),
                help: Some(format!(
                    "{}give a path to a TOML file or an embedded machine: {}",
                    self.meant(path)
                        .filter(|near| near != name_or_path)
                        .map_or(String::new(), |near| format!("did you mean `{near}`? Else ")),
                    self.names().join(", ")
                )),
                place: None,
            }],
        })?;
        self.of_file(name_or_path, &text, files)
    }

    /// Reads `text` as the content of the machine file `file`, which need not have it yet; `files` reads the files that it names.
    ///
    /// # Errors
    /// If `text` is no machine file; its faults show when a machine is made of it.
    pub fn of_file(&'static self, file: &str, text: &str, files: &InputFiles) -> Result<MachineSource, MachineError> {
        if let Some((kind, help)) = instead_of_machine(file, text.as_bytes()) {
            let message = format!("`{file}` is {kind}, not a machine file");
            return Err(MachineError { faults: vec![FileFault { key: None, message, help: Some(help), place: None }] });
        }
        let path = Path::new(file);
        let stem = stem::fitting(&path.file_stem().unwrap_or_default().to_string_lossy());
        let path = path.parent().map(Path::to_owned).unwrap_or_default();
        let folder = NamedFolder { path, confines_overrides: false, files: files.clone() };
        Ok(MachineSource { stem, files: NamedFiles::Folder(folder), ..MachineSource::of_user(self, file, text) })
    }

    /// The names of the machine files in the binary.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        self.embedded.iter().map(|machine| machine.name).collect()
    }

    /// The embedded machine, or the TOML file in the same directory, whose name is nearest to that of a file that cannot be read.
    fn meant(&self, path: &Path) -> Option<String> {
        let name = path.file_name()?.to_str()?;
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let nearby = std::fs::read_dir(parent.unwrap_or(Path::new("."))).into_iter().flatten().flatten();
        let mut files: Vec<String> = nearby.filter_map(|entry| entry.file_name().into_string().ok()).collect();
        files.retain(|file| Path::new(file).extension().is_some_and(|ending| ending == "toml"));
        files.sort();
        let embedded = self.names().into_iter().filter(|_| parent.is_none());
        let near = similar(name, embedded.chain(files.iter().map(String::as_str)))?;
        Some(
            parent
                .filter(|_| files.iter().any(|file| file == near))
                .map_or_else(|| near.to_owned(), |parent| parent.join(near).display().to_string()),
        )
    }
}
