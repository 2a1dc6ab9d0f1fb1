//! Files that a person names: read whole, where they are files and not too large.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// Why a file is not read, in words that follow "cannot read".
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// A directory.
    #[error("it is a directory")]
    Directory,
    /// A pipe, a device, a socket: it may never end, or never begin.
    #[error("it is not a file but a pipe or a device: save what it gives to a file first")]
    NotAFile,
    /// Beyond the limit.
    #[error("it is larger than {largest} bytes")]
    TooLarge {
        /// The limit.
        largest: u64,
    },
    /// Bytes where a text belongs.
    #[error("it is not UTF-8 text")]
    NotText,
    /// The system's word.
    #[error(transparent)]
    System(#[from] io::Error),
}

/// The bytes of a file, at most so many.
///
/// # Errors
/// [`FileError`] where it is no file, cannot be opened, or is larger.
pub fn bytes_of(path: &Path, largest: u64) -> Result<Vec<u8>, FileError> {
    // Asked before it is opened: opening a pipe waits for whoever writes to it.
    let data = fs::metadata(path)?;
    if data.is_dir() {
        return Err(FileError::Directory);
    }
    if !data.is_file() {
        return Err(FileError::NotAFile);
    }
    if data.len() > largest {
        return Err(FileError::TooLarge { largest });
    }
    let mut bytes = Vec::with_capacity(usize::try_from(data.len()).unwrap_or(0));
    // Some files are longer than they say, those of /proc for one.
    File::open(path)?.take(largest + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > largest { Err(FileError::TooLarge { largest }) } else { Ok(bytes) }
}

/// The text of a file, at most so many bytes.
///
/// # Errors
/// [`FileError`] as [`bytes_of`], or where it is not text.
pub fn text_of(path: &Path, largest: u64) -> Result<String, FileError> {
    String::from_utf8(bytes_of(path, largest)?).map_err(|_| FileError::NotText)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_that_are_not_too_large_are_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("text");
        fs::write(&path, "four").expect("written");
        assert_eq!(text_of(&path, 4).expect("read"), "four");
        assert!(matches!(bytes_of(&path, 3), Err(FileError::TooLarge { largest: 3 })));
        assert!(matches!(bytes_of(folder.path(), 4), Err(FileError::Directory)));
        assert!(matches!(bytes_of(&folder.path().join("none"), 4), Err(FileError::System(_))));
        fs::write(&path, [0xff]).expect("written");
        assert!(matches!(text_of(&path, 4), Err(FileError::NotText)));
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_refused() {
        for device in ["/dev/zero", "/dev/null"] {
            assert!(matches!(bytes_of(Path::new(device), 4), Err(FileError::NotAFile)), "{device}");
        }
    }
}
