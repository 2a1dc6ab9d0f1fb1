//! The names of a growing file, and its marker.

use super::directory::{Directory, NameState};
use super::error::FilesError;
use serde::{Deserialize, Serialize};

/// Endings of the names of a growing file and of its marker.
const PART: &str = ".part";
const MARKER: &str = ".json";
/// Largest marker file, bytes.
const LARGEST: u64 = 4096;

/// The temporary name of the file `name` while it grows.
pub(super) fn part_of(name: &str) -> String {
    format!("{name}{PART}")
}

/// The name of the marker of a growing file.
pub(super) fn marker_of(name: &str) -> String {
    format!("{name}{PART}{MARKER}")
}

/// The saved state of a growing file.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Marker {
    /// The digest of its study.
    pub(super) study: String,
    /// Rows written.
    #[serde(default)]
    pub(super) rows: u64,
    /// Bytes of these rows.
    #[serde(default)]
    pub(super) bytes: u64,
    /// SHA-256 of these bytes.
    #[serde(default)]
    pub(super) sha256: String,
}

impl Marker {
    /// `None` if there is no marker; an error if the file of that name is not a marker of the user.
    pub(super) fn read(directory: &Directory, name: &str) -> Result<Option<Self>, FilesError> {
        let failed = |source| FilesError::File { path: directory.path_of(name), source };
        let foreign = |why: &str| FilesError::Part { path: directory.path_of(name), why: why.to_owned() };
        match directory.state_of(name).map_err(failed)? {
            NameState::Nothing => return Ok(None),
            NameState::File(owned) if owned.is_own() => {}
            NameState::File(_) => return Err(foreign("belongs to another user: move it away, or give another --name")),
            _ => return Err(foreign("is not a regular file: move it away, or give another --name")),
        }
        let bytes = directory.read(name, LARGEST).map_err(failed)?;
        serde_json::from_slice(&bytes).map(Some).map_err(|_| {
            foreign("is damaged, or was not written by camgen: move it and the file next to it away, or give another --name")
        })
    }
}

/// Whether the file of this name is a marker of the user.
pub(super) fn is_marker(directory: &Directory, name: &str) -> bool {
    matches!(Marker::read(directory, name), Ok(Some(_)))
}
