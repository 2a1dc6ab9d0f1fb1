//! Files that a person names: read whole, where they are files and not too large.

use crate::refusal::Refusal;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// The bytes of a file of limited size; a refusal completes "cannot read".
///
/// # Errors
/// [`Refusal`] where it is not a file, cannot be opened, or is larger.
pub fn bytes_of(path: &Path, largest: u64) -> Result<Vec<u8>, Refusal> {
    let too_large = || Refusal::new(format!("it is larger than {largest} bytes"));
    // Before it is opened: opening a pipe waits for a writer.
    let data = fs::metadata(path).map_err(Refusal::of)?;
    if data.is_dir() {
        return Err(Refusal::new("it is a directory"));
    }
    if !data.is_file() {
        // It may never end, or never begin.
        return Err(Refusal::new("it is a pipe or a device, not a file").remedy("save its output to a file first"));
    }
    if data.len() > largest {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(data.len()).unwrap_or(0));
    // Some files, those of /proc for example, are longer than their size says.
    let read = File::open(path).and_then(|file| file.take(largest + 1).read_to_end(&mut bytes));
    read.map_err(Refusal::of)?;
    if bytes.len() as u64 > largest { Err(too_large()) } else { Ok(bytes) }
}

/// The text of a file of limited size.
///
/// # Errors
/// [`Refusal`] as [`bytes_of`], or where it is not text.
pub fn text_of(path: &Path, largest: u64) -> Result<String, Refusal> {
    String::from_utf8(bytes_of(path, largest)?)
        .map_err(|_| Refusal::new("it is not UTF-8 text").remedy("save it as UTF-8"))
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
        let what = |path: &Path, largest: u64| text_of(path, largest).expect_err("refused").what;
        assert_eq!(what(&path, 3), "it is larger than 3 bytes");
        assert_eq!(what(folder.path(), 4), "it is a directory");
        let none = folder.path().join("none");
        let system = fs::metadata(&none).expect_err("there is none").to_string();
        assert_eq!(what(&none, 4), system);
        fs::write(&path, [0xff]).expect("written");
        assert_eq!(what(&path, 4), "it is not UTF-8 text");
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_refused() {
        for device in ["/dev/zero", "/dev/null"] {
            let error = bytes_of(Path::new(device), 4).expect_err(device);
            assert_eq!(error.what, "it is a pipe or a device, not a file", "{device}");
        }
    }
}
