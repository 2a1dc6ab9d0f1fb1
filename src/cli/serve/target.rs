//! A machine file that a page may write: the file that its name, with links resolved, meant when the program began. If a link or anything
//! but a file takes that name later, it is neither read nor written.

use super::super::input_files::files;
use camgen::Machine;
use camgen::machine::{FileFault, MachineSource};
use camgen::write::files::{Output, write_all};
use std::fs;
use std::path::PathBuf;

/// Largest machine file, bytes.
const LARGEST: u64 = 1 << 20;
/// Byte order mark that some editors put before UTF-8.
const MARK: char = '\u{feff}';

/// A machine file that a page may write.
#[derive(Debug, Clone)]
pub(super) struct MachineFile {
    /// The user's name for it.
    name: String,
    /// Its path, resolved when the program began.
    path: PathBuf,
}

impl MachineFile {
    pub(super) fn new(name: &str) -> std::io::Result<Self> {
        Ok(Self { name: name.to_owned(), path: fs::canonicalize(name)? })
    }

    /// Its current text.
    pub(super) fn text(&self) -> Result<String, String> {
        let unread = |why: String| format!("cannot read `{}`: {why}", self.name);
        match fs::canonicalize(&self.path) {
            Ok(there) if there != self.path => {
                return Err(unread(format!(
                    "it was a file when camgen serve began and now is a link to `{}`, which is not followed; restart camgen serve",
                    there.display()
                )));
            }
            _ => {}
        }
        files().text_of(&self.path, LARGEST).map_err(|why| unread(why.to_string()))
    }

    /// Replaces the text that the page has seen, keeping its byte order mark and line ends.
    pub(super) fn write(&self, toml: &str, seen: &str) -> Result<(), String> {
        let raw = self.text()?;
        if plain(&raw) != seen {
            return Err("another program has changed the file; it is read again now".into());
        }
        let name = &self.name;
        if fs::metadata(&self.path).is_ok_and(|data| data.permissions().readonly()) {
            let help = "make it writable, or download the TOML under another name";
            return Err(format!("`{name}` is write-protected: {help}"));
        }
        let written = as_before(&plain(toml), &raw);
        self.refuse_unreadable(&written)?;
        let file = self.path.file_name().and_then(|file| file.to_str());
        let (Some(folder), Some(file)) = (self.path.parent(), file) else {
            return Err(format!("cannot write `{name}`: its name is not UTF-8"));
        };
        write_all(folder, &[Output { name: file.to_owned(), bytes: written.into_bytes() }])
            .map_err(|why| why.to_string())
    }

    /// Refuses a text that could not be read back as a machine file.
    fn refuse_unreadable(&self, text: &str) -> Result<(), String> {
        let refused =
            |why: String| format!("`{}` was not written, because it could not be read again: {why}", self.name);
        if text.len() as u64 > LARGEST {
            return Err(refused(format!("it would be larger than {LARGEST} bytes")));
        }
        let source = MachineSource::of_file(&self.name, text, files());
        let machine = source.and_then(|source| Machine::of_source(&source, &[]));
        machine.map(|_| ()).map_err(|error| refused(error.faults.first().map_or_else(String::new, first_line)))
    }
}

/// A fault as one line.
fn first_line(fault: &FileFault) -> String {
    fault
        .place
        .as_ref()
        .map_or_else(|| fault.message.clone(), |place| format!("line {}: {}", place.line, fault.message))
}

/// `text` with the line ends of a browser, without the byte order mark.
pub(super) fn plain(text: &str) -> String {
    text.strip_prefix(MARK).unwrap_or(text).replace("\r\n", "\n")
}

/// `text` with the byte order mark and line ends of `before`.
fn as_before(text: &str, before: &str) -> String {
    let ends = before.matches('\n').count();
    let of_windows = 2 * before.matches("\r\n").count() > ends;
    let text = if of_windows { text.replace('\n', "\r\n") } else { text.to_owned() };
    if before.starts_with(MARK) { format!("{MARK}{text}") } else { text }
}
