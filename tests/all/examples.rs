//! The examples run, and end well.

use std::path::PathBuf;
use std::process::Command;

/// `cargo test` builds the examples beside the tests.
fn example(name: &str) -> Command {
    let own = std::env::current_exe().expect("the test itself");
    let built = own.parent().and_then(|deps| deps.parent()).expect("target/debug");
    let path: PathBuf = built.join("examples").join(name);
    assert!(path.exists(), "{} is not built; run `cargo build --examples`", path.display());
    Command::new(path)
}

#[test]
fn every_example_ends_well() {
    let examples = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/examples")).expect("the examples");
    let mut count = 0;
    for entry in examples {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let mut command = example(&name);
        if name == "thousand_cams" {
            // Ten show that it runs.
            command.arg("10");
        }
        let output = command.output().expect("it runs");
        let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && !output.stdout.is_empty(), "{name}: {text}");
        count += 1;
    }
    assert!(count >= 4, "one cam, a law of one's own, a check, a thousand cams");
}
