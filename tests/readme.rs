//! Every command of the README runs, in its order, and prints what the README shows of it.

#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, missing_docs, reason = "a test fails loudly")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const README: &str = include_str!("../README.md");

/// The commands that end with 1: a check fails, as the README says.
const FAILING: [&str; 2] = ["camgen rotary dpi-paper --set cam.base_radius=200mm", "camgen brake"];

fn run(line: &str, directory: &Path) -> Output {
    let words: Vec<&str> = line.split_whitespace().skip(1).collect();
    // Nothing of a table or a text needs quoting but `--set "cam.balance=30mm .. 217mm"`.
    let mut arguments: Vec<String> = Vec::new();
    let mut quoted: Option<String> = None;
    for word in words {
        match quoted.take() {
            Some(before) if word.ends_with('"') => arguments.push(format!("{before} {}", word.trim_matches('"'))),
            Some(before) => quoted = Some(format!("{before} {word}")),
            None if word.starts_with('"') && !word.ends_with('"') => quoted = Some(word.trim_matches('"').into()),
            None => arguments.push(word.trim_matches('"').into()),
        }
    }
    let output = Command::new(env!("CARGO_BIN_EXE_camgen")).args(arguments).current_dir(directory).output();
    output.expect("camgen starts")
}

/// A command without its comment.
fn command(line: &str) -> Option<String> {
    let code = line.strip_prefix("    ")?;
    let code = code.strip_prefix("$ ").unwrap_or(code);
    let code = code.replace("cargo run --release --", "camgen");
    code.starts_with("camgen ").then(|| code.split('#').next().unwrap_or("").trim().to_owned())
}

/// The block of a file that the README shows.
fn lifter() -> String {
    let lines = README.lines().skip_while(|line| *line != "`lifter.toml`:").skip(2);
    let block = lines.take_while(|line| line.is_empty() || line.starts_with("    "));
    block.map(|line| line.trim_start().to_owned() + "\n").collect()
}

#[test]
fn every_command_of_the_readme_runs() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    fs::write(path.join("lifter.toml"), lifter()).expect("written");
    for (line, files) in [
        ("camgen rotary --rpm 35 --name part --out .", ["part.dxf", "part.step"]),
        ("camgen conoid --rpm 20,25,30,35 --name s --out . --format dxf", ["s-25rpm.dxf", "s-35rpm.dxf"]),
    ] {
        assert!(run(line, path).status.success(), "{line}");
        assert!(files.iter().all(|file| path.join(file).exists()));
    }
    fs::rename(path.join("s-25rpm.dxf"), path.join("s.dxf")).expect("renamed");
    // Of the commands in the text those without a placeholder in capitals or a choice in brackets.
    let inline = README.split('`').skip(1).step_by(2).filter(|code| code.starts_with("camgen ") && !code.contains('['));
    let inline = inline.filter(|code| {
        let capital = |word: &str| word.len() > 1 && word.chars().all(|letter| letter.is_ascii_uppercase());
        let words = || code.split_whitespace();
        // `camgen check` alone names the command.
        words().count() > 2 && !words().any(|word| capital(word) || word == "A")
    });
    let commands: Vec<String> =
        README.lines().filter_map(command).chain(inline.map(|code| code.replace('\n', " "))).collect();
    assert!(commands.len() > 20, "{commands:#?}");
    for line in &commands {
        let output = run(line, path);
        let wanted = i32::from(FAILING.contains(&line.as_str()));
        assert_eq!(output.status.code(), Some(wanted), "{line}\n{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// Each line shown of what a command prints is printed, up to where the README leaves something out.
#[test]
fn what_the_readme_shows_is_printed() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("lifter.toml"), lifter()).expect("written");
    let shown = |from: &str| -> Vec<String> {
        let lines = README.lines().skip_while(|line| !line.contains(from)).skip(1).skip_while(|line| line.is_empty());
        let block = lines.take_while(|line| line.starts_with("    "));
        block.map(|line| line.trim().split('…').next().unwrap_or("").trim().to_owned()).collect()
    };
    for (from, line) in [
        ("The first command prints", "camgen rotary --rpm 35"),
        ("`camgen make lifter.toml` writes", "camgen make lifter.toml"),
        ("$ camgen rotary dpi-paper", FAILING[0]),
        ("$ camgen rotary --set translating.delta", "camgen rotary --set translating.delta=50deg"),
    ] {
        let printed = String::from_utf8(run(line, directory.path()).stdout).expect("UTF-8");
        let told = shown(from);
        assert!(!told.is_empty(), "{from}");
        for text in told.iter().filter(|text| !text.is_empty()) {
            assert!(printed.contains(text.as_str()), "{line}: `{text}` is not in\n{printed}");
        }
    }
}
