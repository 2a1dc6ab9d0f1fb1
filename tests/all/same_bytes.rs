//! The bytes of the files of every embedded design are those of `tests/golden/files.txt`: of every release, on every machine.
//! So are the drawings of the README and the book, and the templates. `tests/run --renew` stores them anew (`common::stored`).

use crate::common::program::{camgen, camgen_in};
use crate::common::stored::assert_stored;
use crate::readme::example;
use assert_cmd::Command;
use sha2::{Digest, Sha256};
use std::fs;
use std::path::Path;

/// A command for every embedded design, with every format that it can have.
const COMMANDS: [&str; 25] = [
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
    "make valve --format diagram,pdf",
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
    assert_stored("tests/golden/files.txt", &hashes());
}

/// The drawings in the README and the book are those that the program makes.
#[test]
fn the_pictures_in_the_readme_are_current() {
    for (command, name) in [
        ("rotary --rpm 35", "dpi-rotary-35rpm.svg"),
        ("translating --rpm 35", "dpi-translating-35rpm.svg"),
        ("conoid --rpm 20,25,30,35", "dpi-conoid-20-25-30-35rpm.svg"),
        ("make lifter.toml", "lifter-make-120rpm.svg"),
    ] {
        let directory = tempfile::tempdir().expect("a directory");
        fs::write(directory.path().join("lifter.toml"), example("lifter.toml")).expect("written");
        let words: Vec<&str> = command.split(' ').chain(["--format", "svg"]).collect();
        let run = camgen_in(directory, &words);
        let made = fs::read_to_string(run.directory.path().join("output").join(name)).expect("the file");
        assert_stored(&format!("docs/pictures/{name}"), &made);
    }
}

#[test]
fn the_templates_are_what_the_program_prints() {
    assert_stored("templates/machine.toml", &camgen(&["init"]).out);
    assert_stored("templates/machine.schema.json", &camgen(&["schema"]).out);
}
