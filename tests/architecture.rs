//! The house stands as ARCHITECTURE.md draws it: a room knows only the rooms before it.

#![allow(clippy::expect_used, clippy::panic, missing_docs, reason = "a test fails loudly")]

use std::fs;
use std::path::{Path, PathBuf};

const ROOMS: [&str; 12] = [
    "units", "numeric", "buffer", "law", "follower", "machine", "cam", "contour", "reading", "checks", "drawing",
    "output",
];

fn sources(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    fs::read_dir(path).expect("a directory").flat_map(|entry| sources(&entry.expect("an entry").path())).collect()
}

/// The text of a file without its tests, which may look anywhere.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a source file");
    text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default().to_owned()
}

fn files_of(room: &str) -> Vec<PathBuf> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let file = src.join(format!("{room}.rs"));
    sources(&if file.exists() { file } else { src.join(room) })
}

#[test]
fn a_room_knows_only_the_rooms_before_it() {
    for (index, room) in ROOMS.iter().enumerate() {
        let files = files_of(room);
        assert!(!files.is_empty(), "{room}");
        for path in files {
            for later in &ROOMS[index + 1..] {
                let import = format!("crate::{later}::");
                assert!(!code(&path).contains(&import), "{} knows {later}", path.display());
            }
        }
    }
}

/// Writers only format; the library neither prints nor exits nor looks at a clock.
#[test]
fn what_is_absent_stays_absent() {
    for path in files_of("output") {
        for word in ["libm::", "atan2", ".sin()", ".cos()", "offset_inward"] {
            assert!(!code(&path).contains(word), "{} has {word}", path.display());
        }
    }
    for room in ROOMS {
        for path in files_of(room) {
            for word in
                ["println!", "eprintln!", "process::exit", "SystemTime", "Instant::now", "HashMap", ".sin()", ".powf("]
            {
                assert!(!code(&path).contains(word), "{} has {word}", path.display());
            }
        }
    }
}
