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
    // Read up to the size: files in /proc may never end and have size 0. They are not opened either, because opening some of them blocks.
    if data.len() > 0 {
        let read = File::open(path).and_then(|file| file.take(data.len()).read_to_end(&mut bytes));
        read.map_err(Refusal::of)?;
    }
    Ok(bytes)
}

/// The text of a file of limited size.
///
/// # Errors
/// [`Refusal`] as [`bytes_of`], or where it is not text.
pub fn text_of(path: &Path, largest: u64) -> Result<String, Refusal> {
    text_in(bytes_of(path, largest)?)
}

/// Bytes as UTF-8 text.
pub(super) fn text_in(bytes: Vec<u8>) -> Result<String, Refusal> {
    String::from_utf8(bytes).map_err(|_| Refusal::new("it is not UTF-8 text").remedy("save it as UTF-8"))
}

/// The bytes of a table as text: UTF-8, UTF-16 behind its mark, or else Windows-1252, as spreadsheets save it. The signs in which that
/// differs from Latin-1 are quotes and dashes of headings.
pub(super) fn table_text_in(bytes: Vec<u8>) -> Result<String, Refusal> {
    let no_text = || Refusal::new("it is not text").remedy("save the table as CSV");
    let wide = |units: &dyn Fn([u8; 2]) -> u16| {
        let units = bytes.chunks_exact(2).skip(1).filter_map(|pair| Some(units(pair.try_into().ok()?)));
        char::decode_utf16(units).collect::<Result<String, _>>().map_err(|_| no_text())
    };
    match bytes.as_slice() {
        [0xff, 0xfe, ..] => wide(&u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(&u16::from_be_bytes),
        _ if bytes.contains(&0) => Err(no_text()),
        _ => Ok(String::from_utf8(bytes).unwrap_or_else(|other| {
            let letter =
                |byte: u8| if (0x80..0xa0).contains(&byte) { char::REPLACEMENT_CHARACTER } else { char::from(byte) };
            other.into_bytes().into_iter().map(letter).collect()
        })),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_as_spreadsheets_save_them() {
        let wanted = "Winkel [°];Höhe\r\n0;1,5";
        let latin: Vec<u8> =
            wanted.chars().map(|letter| u8::try_from(u32::from(letter)).expect("a letter of Latin-1")).collect();
        let wide: Vec<u16> = std::iter::once(0xfeff).chain(wanted.encode_utf16()).collect();
        let little: Vec<u8> = wide.iter().flat_map(|unit| unit.to_le_bytes()).collect();
        let big: Vec<u8> = wide.iter().flat_map(|unit| unit.to_be_bytes()).collect();
        for bytes in [wanted.as_bytes(), &latin, &little, &big] {
            assert_eq!(table_text_in(bytes.to_vec()).expect("text"), wanted);
        }
        assert_eq!(table_text_in(b"0;1\x00".to_vec()).expect_err("no text").what, "it is not text");
    }

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

    /// Reading the kernel log blocks until its next line; files of a process hold more bytes than their size.
    #[cfg(target_os = "linux")]
    #[test]
    fn files_that_the_system_makes_up_are_empty() {
        for path in ["/proc/kmsg", "/proc/self/maps", "/proc/self/cmdline"] {
            assert_eq!(bytes_of(Path::new(path), 4).unwrap_or_default(), b"", "{path}");
        }
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
