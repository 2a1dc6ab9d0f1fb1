//! Files that keep what an earlier version made: digests, pictures, templates, what the README and the book show.
//!
//! `tests/run --renew` stores all of them anew (each is written where `CAMGEN_RENEW` is set). Look at what has changed before it is kept:
//! a change of bytes is one that shops see, and belongs in CHANGELOG.md.

use std::fs;
use std::path::Path;

/// Lines that a failure shows, and how much of each.
const SHOWN: usize = 20;
const WIDTH: usize = 160;

/// Holds a text against the file that keeps it, or keeps it.
#[track_caller]
pub(crate) fn assert_stored(path: &str, made: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("CAMGEN_RENEW").is_some() {
        fs::write(&file, made).expect("written");
    }
    let stored = fs::read_to_string(&file).expect("a stored file");
    assert!(
        stored == made,
        "{path} is not what is made now; where that is right, `tests/run --renew` stores it.{}",
        changed(&stored, made)
    );
}

/// The first lines that differ.
fn changed(stored: &str, made: &str) -> String {
    let clip = |line: &str| line.chars().take(WIDTH).collect::<String>();
    let pairs = stored.lines().zip(made.lines()).enumerate().filter(|(_, (stored, made))| stored != made);
    let shown = pairs
        .take(SHOWN)
        .map(|(index, (stored, made))| format!("\nline {}: {}\n  →  {}", index + 1, clip(stored), clip(made)));
    let lengths = format!("\n{} lines are stored, {} are made", stored.lines().count(), made.lines().count());
    shown.collect::<String>() + &lengths
}
