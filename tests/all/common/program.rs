//! The program, run in an empty directory.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// How a run of the program ended.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
    pub(crate) directory: TempDir,
}

/// Runs camgen in an empty directory.
pub(crate) fn camgen(args: &[&str]) -> Run {
    camgen_in(tempfile::tempdir().expect("a directory"), args)
}

pub(crate) fn camgen_in(directory: TempDir, args: &[&str]) -> Run {
    camgen_on(None, directory, args)
}

/// Commands that print a report.
const REPORTING: [&str; 18] = [
    "rotary",
    "translating",
    "conoid",
    "make",
    "regimes",
    "spring",
    "scatter",
    "drive",
    "linkage",
    "shaft",
    "brake",
    "size",
    "laws",
    "import",
    "compare",
    "check",
    "trade",
    "side-by-side",
];
/// Flags with which no report for people is printed, or another text.
const WITHOUT_REPORT: [&str; 8] = ["--json", "--quiet", "-q", "--help", "-h", "--csv", "--svg", "--verbose"];

/// On a number of threads. A report is printed in full: tests look at all of it.
pub(crate) fn camgen_on(threads: Option<&str>, directory: TempDir, args: &[&str]) -> Run {
    let reports = args.first().is_some_and(|command| REPORTING.contains(command));
    let in_full = reports && !args.iter().any(|arg| WITHOUT_REPORT.contains(arg));
    run_as_given(threads, directory, &[args, if in_full { &["--verbose"] } else { &[] }].concat())
}

/// The commands, by the manual page of camgen.
pub(crate) fn commands() -> Vec<String> {
    let page = run_as_given(None, tempfile::tempdir().expect("a directory"), &["man"]).out;
    let named = page.lines().filter_map(|line| line.strip_prefix("camgen\\-")?.strip_suffix("(1)"));
    named.map(|name| name.replace('\\', "")).filter(|name| name != "help").collect()
}

/// Runs camgen in an empty directory and nothing added: reports are summaries.
pub(crate) fn summary_of(args: &[&str]) -> Run {
    run_as_given(None, tempfile::tempdir().expect("a directory"), args)
}

fn run_as_given(threads: Option<&str>, directory: TempDir, args: &[&str]) -> Run {
    let output = Command::cargo_bin("camgen")
        .expect("the program")
        .envs(threads.map(|threads| ("RAYON_NUM_THREADS", threads)))
        .current_dir(directory.path())
        .args(args)
        .output()
        .expect("it runs");
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("UTF-8");
    Run { code: output.status.code().expect("a code"), out: text(&output.stdout), err: text(&output.stderr), directory }
}

/// A run that ends with this code.
#[track_caller]
pub(crate) fn run(code: i32, args: &[&str]) -> Run {
    let run = camgen(args);
    assert_eq!(run.code, code, "{args:?}: {}{}", run.out, run.err);
    run
}

/// `camgen make` of a design file with this text.
pub(crate) fn make(text: &str, args: &[&str]) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("cam.toml"), text).expect("written");
    camgen_in(directory, &[&["make", "cam.toml"], args].concat())
}

/// Every file below a directory, without the record of what was written.
pub(crate) fn files(directory: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).expect("a directory") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.file_name().is_some_and(|name| name != ".camgen.json") {
            found.push(path.file_name().expect("a name").to_string_lossy().into_owned());
        }
    }
    found.sort();
    found
}

pub(crate) fn report(run: &Run) -> Value {
    serde_json::from_str(&run.out).unwrap_or_else(|e| panic!("{e}: {}", run.out))
}

/// A check of a report, by its name.
pub(crate) fn finding<'a>(report: &'a Value, check: &str) -> &'a Value {
    let checks = report["checks"].as_array().expect("checks");
    checks.iter().find(|found| found["check"] == check).unwrap_or_else(|| panic!("no {check}: {checks:?}"))
}

#[track_caller]
pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

#[track_caller]
pub(crate) fn number_of(table: &Value, key: &str) -> f64 {
    table[key].as_f64().unwrap_or_else(|| panic!("{key}: {table}"))
}

/// Equal up to a relative tolerance.
#[track_caller]
pub(crate) fn close(found: f64, known: f64, tolerance: f64) {
    assert!((found / known - 1.0).abs() < tolerance, "{found} is not {known}");
}
