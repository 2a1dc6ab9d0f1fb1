//! A machine file that a page may write: the one that had its name when the program began, links resolved. If a link, or anything else that is
//! not a file, takes its name later, it is neither read nor written.

use camgen::Machine;
use camgen::document::file;
use camgen::machine::{FileFault, MachineSource};
use camgen::write::files::{Output, write_all};
use std::fs;
use std::path::PathBuf;

/// Largest machine file, bytes.
const LARGEST: u64 = 1 << 20;
/// The mark that some editors put before UTF-8.
const MARK: char = '\u{feff}';

/// A machine file that a page may write.
#[derive(Debug, Clone)]
pub(super) struct MachineFile {
    /// As the user named it.
    name: String,
    /// Where it was when the program began.
    path: PathBuf,
}

impl MachineFile {
    pub(super) fn of(name: &str) -> std::io::Result<Self> {
        Ok(Self { name: name.to_owned(), path: fs::canonicalize(name)? })
    }

    /// Its text as it is now.
    pub(super) fn text(&self) -> Result<String, String> {
        let unread = |why: String| format!("cannot read `{}`: {why}", self.name);
        match fs::canonicalize(&self.path) {
            Ok(there) if there != self.path => {
                return Err(unread(format!(
                    "it was a file when camgen serve began, and is a link to `{}` now, which is not followed; start it again",
                    there.display()
                )));
            }
            _ => {}
        }
        file::text_of(&self.path, LARGEST).map_err(|why| unread(why.to_string()))
    }

    /// Writes another text over the one that the page has seen, with the mark and the line ends of that one.
    pub(super) fn write(&self, toml: &str, seen: &str) -> Result<(), String> {
        let raw = self.text()?;
        if plain(&raw) != seen {
            return Err("the file was changed by another program since; it is read again now".into());
        }
        let name = &self.name;
        if fs::metadata(&self.path).is_ok_and(|data| data.permissions().readonly()) {
            let help = "allow it, or download the TOML under another name";
            return Err(format!("`{name}` is protected against writing: {help}"));
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

    /// Refuses a text that would not be read as a machine file.
    fn refuse_unreadable(&self, text: &str) -> Result<(), String> {
        let refused = |why: String| format!("`{}` is not written, it could not be read again: {why}", self.name);
        if text.len() as u64 > LARGEST {
            return Err(refused(format!("it would be larger than {LARGEST} bytes")));
        }
        let source = MachineSource::of_file(&self.name, text);
        let machine = source.and_then(|source| Machine::of_source(&source, &[]));
        machine.map(|_| ()).map_err(|error| refused(error.faults.first().map_or_else(String::new, first_line)))
    }
}

/// A fault in one line.
fn first_line(fault: &FileFault) -> String {
    fault
        .place
        .as_ref()
        .map_or_else(|| fault.message.clone(), |place| format!("line {}: {}", place.line, fault.message))
}

/// A text with the line ends that a browser knows, without a mark.
pub(super) fn plain(text: &str) -> String {
    text.strip_prefix(MARK).unwrap_or(text).replace("\r\n", "\n")
}

/// A text with the mark and the line ends of the one that it replaces.
fn as_before(text: &str, before: &str) -> String {
    let ends = before.matches('\n').count();
    let of_windows = 2 * before.matches("\r\n").count() > ends;
    let text = if of_windows { text.replace('\n', "\r\n") } else { text.to_owned() };
    if before.starts_with(MARK) { format!("{MARK}{text}") } else { text }
}
