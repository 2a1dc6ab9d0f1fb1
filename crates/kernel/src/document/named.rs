//! Files that a machine file names: where they may lie, and which ones were read.
//!
//! A machine file may be somebody else's, and what it names is read and in part shown. So a file must lie in the folder of the machine file or
//! below it, links resolved, unless the user names another folder, or the file itself.

use super::fault::{FileFault, Misfit};
use super::file;
use crate::refusal::Refusal;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The files that a program reads for its user: in which folders machine files may name further ones, and which files were read. Clones
/// share the record of what was read.
///
/// ```
/// # use camgen_kernel as camgen;
/// use camgen::document::InputFiles;
///
/// let files = InputFiles::default();
/// let file = std::env::temp_dir().join("input-files-doc.txt");
/// std::fs::write(&file, "lift")?;
/// assert!(!files.was_read(&file));
/// assert_eq!(files.text_of(&file, 16)?, "lift");
/// assert!(files.was_read(&file));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct InputFiles {
    /// Folders, links resolved.
    allowed: Arc<[PathBuf]>,
    record: Arc<Mutex<InputRecord>>,
}

#[derive(Debug, Default)]
struct InputRecord {
    /// Files that were read, links resolved.
    read: BTreeSet<PathBuf>,
    /// Files that machine files have named, whether they could be read or not.
    named: BTreeSet<PathBuf>,
}

impl InputFiles {
    /// Lets machine files name files in these folders and below them.
    ///
    /// # Errors
    /// [`Refusal`] where one of them is not a folder.
    pub fn allowing(folders: &[PathBuf]) -> Result<Self, Refusal> {
        let allowed = folders.iter().map(|folder| resolved_folder(folder)).collect::<Result<_, _>>()?;
        Ok(Self { allowed, record: Arc::default() })
    }

    /// The bytes of a file of limited size, as [`file::bytes_of`].
    ///
    /// # Errors
    /// [`Refusal`] where it is not a file, cannot be opened, or is larger.
    pub fn bytes_of(&self, path: &Path, largest: u64) -> Result<Vec<u8>, Refusal> {
        let bytes = file::bytes_of(path, largest)?;
        if let Ok(found) = fs::canonicalize(path) {
            self.with_record(|record| record.read.insert(found));
        }
        Ok(bytes)
    }

    /// The text of a file of limited size, as [`file::text_of`].
    ///
    /// # Errors
    /// [`Refusal`] as [`InputFiles::bytes_of`], or where it is not text.
    pub fn text_of(&self, path: &Path, largest: u64) -> Result<String, Refusal> {
        file::text_in(self.bytes_of(path, largest)?)
    }

    /// The text of a table of limited size, in the encodings in which spreadsheets save tables.
    ///
    /// # Errors
    /// [`Refusal`] as [`InputFiles::bytes_of`], or where it is not text.
    pub fn table_text_of(&self, path: &Path, largest: u64) -> Result<String, Refusal> {
        file::table_text_in(self.bytes_of(path, largest)?)
    }

    /// Whether a file was read.
    #[must_use]
    pub fn was_read(&self, path: &Path) -> bool {
        fs::canonicalize(path).is_ok_and(|path| self.with_record(|record| record.read.contains(&path)))
    }

    /// The files that machine files have named, whether they could be read or not.
    #[must_use]
    pub fn named(&self) -> Vec<PathBuf> {
        self.with_record(|record| record.named.iter().cloned().collect())
    }

    /// The fault of a file named in a study file under a key, if it is outside `folder` and the folders that are allowed.
    #[must_use]
    pub fn outside_fault(&self, folder: &Path, name: &str, key: &str) -> Option<FileFault> {
        let Misfit { message, help } = self.path_of(folder, NamedFile { name, key, in_kind: "study file" }).err()?;
        Some(FileFault { key: None, message, help, place: None })
    }

    fn with_record<T>(&self, use_record: impl FnOnce(&mut InputRecord) -> T) -> T {
        use_record(&mut self.record.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// The path of a file that a text in `folder` names, if it is in that folder or in one that is allowed.
    fn path_of(&self, folder: &Path, named: NamedFile<'_>) -> Result<PathBuf, Misfit> {
        let path = self.noted(folder.join(named.name));
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        // Where a path cannot be followed, reading it says why.
        let (Ok(file), Ok(root)) = (fs::canonicalize(&path), fs::canonicalize(folder)) else { return Ok(path) };
        if self.allowed.iter().chain([&root]).any(|folder| file.starts_with(folder)) {
            return Ok(file);
        }
        let NamedFile { name, key, in_kind } = named;
        let folder_of_file = file.parent().unwrap_or(&file);
        Err(Misfit {
            message: format!("`{key}`: `{name}` lies outside of the folder of the {in_kind}, `{}`", root.display()),
            help: Some(format!("put it there, or allow its folder with --allow-path \"{}\"", folder_of_file.display())),
        })
    }

    /// The path, which is recorded as named.
    fn noted(&self, path: PathBuf) -> PathBuf {
        self.with_record(|record| record.named.insert(path.clone()));
        path
    }
}

/// A file as a text names it.
#[derive(Debug, Clone, Copy)]
struct NamedFile<'a> {
    name: &'a str,
    key: &'a str,
    /// The kind of the text: "machine file".
    in_kind: &'a str,
}

fn resolved_folder(folder: &Path) -> Result<PathBuf, Refusal> {
    match fs::canonicalize(folder) {
        Ok(found) if found.is_dir() => Ok(found),
        Ok(_) => Err(Refusal::new(format!("`{}` is not a folder", folder.display()))),
        Err(error) => Err(Refusal::new(format!("cannot open the folder `{}`: {error}", folder.display()))),
    }
}

/// Where the files are that a machine file names.
#[derive(Debug, Clone)]
pub enum NamedFiles {
    /// Nowhere: the text is not in a folder.
    Nowhere,
    /// In a folder.
    Folder(NamedFolder),
    /// Texts that are there by the names that the machine file uses: a page has no folder.
    Texts(BTreeMap<String, String>),
}

/// The folder of a machine file.
#[derive(Debug, Clone)]
pub struct NamedFolder {
    /// Its path; empty for the working folder.
    pub path: PathBuf,
    /// Also files that overrides name must be in it: the overrides are not the user's own.
    pub confines_overrides: bool,
    /// By what the files are read.
    pub files: InputFiles,
}

impl NamedFiles {
    /// The text of a file of at most `largest` bytes that is named under a key. A path that the user gave leads to any folder.
    pub(super) fn text(&self, name: &str, key: &str, largest: u64, by_user: bool) -> Result<String, Misfit> {
        match self {
            NamedFiles::Nowhere => Err(Misfit {
                message: format!("`{key}`: only a machine file in a folder can name another file"),
                help: Some("save this machine as a file in the folder of the table".to_owned()),
            }),
            NamedFiles::Folder(folder) => folder.text(name, key, largest, by_user),
            NamedFiles::Texts(texts) => match texts.get(name).filter(|text| text.len() as u64 <= largest) {
                Some(text) => Ok(text.clone()),
                None => Err(missing_text(texts, name, key)),
            },
        }
    }
}

fn missing_text(texts: &BTreeMap<String, String>, name: &str, key: &str) -> Misfit {
    let names: Vec<&str> = texts.keys().map(String::as_str).collect();
    let found = if names.is_empty() { "no file".to_owned() } else { names.join(", ") };
    Misfit {
        message: format!("`{key}`: there is no file `{name}` here, but {found}"),
        help: Some("choose the file in the page".to_owned()),
    }
}

impl NamedFolder {
    fn text(&self, name: &str, key: &str, largest: u64, by_user: bool) -> Result<String, Misfit> {
        let path = if by_user && !self.confines_overrides {
            self.files.noted(self.path.join(name))
        } else {
            self.files.path_of(&self.path, NamedFile { name, key, in_kind: "machine file" })?
        };
        self.files.table_text_of(&path, largest).map_err(|why| Misfit {
            message: format!("`{key}`: cannot read `{name}`: {why}"),
            help: (!path.exists()).then(|| "give its path relative to the folder of the machine file".to_owned()),
        })
    }
}
