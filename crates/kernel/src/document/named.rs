//! Files that a machine file names: where they may lie, and which ones were read.
//!
//! A machine file may be somebody else's, and what it names is read and in part shown. So a file must lie in the folder of the machine file or
//! below it, links resolved, unless the user names another folder, or the file itself. What is allowed and what was read is one for
//! the process, as the files are.

use super::fault::{FileFault, Misfit};
use super::file;
use crate::refusal::Refusal;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError, RwLock};

static ALLOWED: RwLock<Vec<PathBuf>> = RwLock::new(Vec::new());
static READ: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Lets machine files name files in these folders and below them, from now on.
///
/// # Errors
/// [`Refusal`] where one of them is not a folder.
pub fn allow(folders: &[PathBuf]) -> Result<(), Refusal> {
    let resolved = |folder: &PathBuf| match fs::canonicalize(folder) {
        Ok(found) if found.is_dir() => Ok(found),
        Ok(_) => Err(Refusal::new(format!("`{}` is not a folder", folder.display()))),
        Err(error) => Err(Refusal::new(format!("cannot open the folder `{}`: {error}", folder.display()))),
    };
    let folders = folders.iter().map(resolved).collect::<Result<Vec<_>, _>>()?;
    ALLOWED.write().unwrap_or_else(PoisonError::into_inner).extend(folders);
    Ok(())
}

/// The files that machine files have named, whether they could be read or not.
#[must_use]
pub fn read() -> Vec<PathBuf> {
    READ.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
}

/// Where the files are that a machine file names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NamedFiles {
    /// Nowhere: the text is not in a folder.
    Nowhere,
    /// In the folder of the machine file.
    Folder(PathBuf),
    /// In that folder, also for files named by overrides, which are not the user's own.
    Confined(PathBuf),
    /// Texts that are there by the names that the machine file uses: a page has no folder.
    Texts(BTreeMap<String, String>),
}

impl NamedFiles {
    /// The text of a file of at most so many bytes that is named under a key. A path that the user gave leads to any folder.
    pub(super) fn text(&self, name: &str, key: &str, (largest, by_user): (u64, bool)) -> Result<String, Misfit> {
        let refused = |message: String, help: &str| Err(Misfit { message, help: Some(help.to_owned()) });
        let (folder, by_user) = match self {
            NamedFiles::Nowhere => {
                let help = "save this machine as a file in the folder of the table";
                return refused(format!("`{key}`: only a machine file in a folder can name another file"), help);
            }
            NamedFiles::Texts(texts) => {
                let found = texts.get(name).filter(|text| text.len() as u64 <= largest);
                return found.cloned().map_or_else(
                    || {
                        let has: Vec<&str> = texts.keys().map(String::as_str).collect();
                        let has = if has.is_empty() { "no file".to_owned() } else { has.join(", ") };
                        refused(
                            format!("`{key}`: there is no file `{name}` here, but {has}"),
                            "choose the file in the page",
                        )
                    },
                    Ok,
                );
            }
            NamedFiles::Folder(folder) => (folder, by_user),
            NamedFiles::Confined(folder) => (folder, false),
        };
        let path = path_of(folder, (name, key, "machine file"), by_user)?;
        file::table_text_of(&path, largest).map_err(|why| {
            let elsewhere = "give its path relative to the folder of the machine file";
            let help = (!path.exists()).then(|| elsewhere.to_owned());
            Misfit { message: format!("`{key}`: cannot read `{name}`: {why}"), help }
        })
    }
}

/// The fault of a file named in a study file under a key, if it is outside `folder` and the folders that the user allows.
#[must_use]
pub fn outside_fault(folder: &Path, name: &str, key: &str) -> Option<FileFault> {
    let Misfit { message, help } = path_of(folder, (name, key, "study file"), false).err()?;
    Some(FileFault { key: None, message, help, place: None })
}

/// The path of a file named under a key in a text in `folder`; `of` is the kind of the text. A path from the user may lead anywhere.
fn path_of(folder: &Path, (name, key, of): (&str, &str, &str), by_user: bool) -> Result<PathBuf, Misfit> {
    let path = folder.join(name);
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    READ.lock().unwrap_or_else(PoisonError::into_inner).insert(path.clone());
    // Where a path cannot be followed, reading it says why.
    let (false, Ok(file), Ok(root)) = (by_user, fs::canonicalize(&path), fs::canonicalize(folder)) else {
        return Ok(path);
    };
    let allowed = ALLOWED.read().unwrap_or_else(PoisonError::into_inner);
    if allowed.iter().chain([&root]).any(|folder| file.starts_with(folder)) {
        return Ok(file);
    }
    let of_file = file.parent().unwrap_or(&file);
    Err(Misfit {
        message: format!("`{key}`: `{name}` lies outside of the folder of the {of}, `{}`", root.display()),
        help: Some(format!("put it there, or allow its folder with --allow-path \"{}\"", of_file.display())),
    })
}
