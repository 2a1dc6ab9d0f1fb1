//! The bytes of the files of every embedded design are those of `tests/golden/files.txt`: of every release, on every machine.
//!
//! With CAMGEN_WRITE_HASHES set the list is written anew. A change of it is one that shops see, and belongs in CHANGELOG.md.

#![allow(clippy::expect_used, clippy::panic, missing_docs, reason = "a test fails loudly")]

use assert_cmd::Command;
use sha2::{Digest, Sha256};
use std::fs;
use std::path::Path;

/// A command for every embedded design, with every format that it can have.
const COMMANDS: [&str; 24] = [
    "rotary --rpm 35",
    "rotary --rpm 35 --format dxf,svg,step,csv,json,html,pdf,points",
    "rotary --rpm 35 --outline spline",
    "rotary dpi-paper",
    "rotary dpi-crank-slider",
    "rotary dpi-six-bar",
    "rotary dpi-shaft",
    "translating --rpm 35",
    "conoid",
    "make feeder",
    "make lever",
    "make valve",
    "regimes",
    "spring",
    "drive",
    "linkage dpi-six-bar",
    "shaft press-cylinder",
    "shaft dpi-shaft",
    "brake roll",
    "brake roll-level",
    "brake roll --cam",
    "size feeder",
    "laws lever",
    "laws",
];

fn hashes() -> String {
    let mut lines = Vec::new();
    for command in COMMANDS {
        let directory = tempfile::tempdir().expect("a directory");
        let mut program = Command::cargo_bin("camgen").expect("the program");
        let ran = program.args(command.split(' ')).args(["-q", "--force", "--out", "."]).current_dir(directory.path());
        let ran = ran.output().expect("it runs");
        assert_ne!(ran.status.code(), Some(2), "{command}: {}", String::from_utf8_lossy(&ran.stderr));
        lines.extend(of(directory.path()).into_iter().map(|line| format!("{command}: {line}")));
    }
    lines.join("\n") + "\n"
}

fn of(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).expect("a directory").map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> = entries.filter(|path| path.is_file()).collect();
    paths.sort();
    let line = |path: &std::path::PathBuf| {
        let digest = Sha256::digest(fs::read(path).expect("a file"));
        // Half of it tells any two files apart.
        let start = digest.first_chunk().map_or(0, |start| u128::from_be_bytes(*start));
        format!("{} {start:032x}", path.file_name().expect("a name").to_string_lossy())
    };
    paths.iter().map(line).collect()
}

#[test]
fn every_embedded_design_has_the_bytes_it_had() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/files.txt");
    let now = hashes();
    if std::env::var_os("CAMGEN_WRITE_HASHES").is_some() {
        fs::write(&path, &now).expect("written");
    }
    let before = fs::read_to_string(&path).expect("a list");
    let changed: Vec<(&str, &str)> = before.lines().zip(now.lines()).filter(|(before, now)| before != now).collect();
    assert!(changed.is_empty() && before == now, "{changed:#?}");
}
