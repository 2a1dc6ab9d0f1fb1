//! The commands of a page, run in its order.

use super::lists::list;
use super::page::{Page, Part};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Commands that measure times, and so take long: only their flags are tried.
const LONG: [&str; 1] = ["camgen trade"];

/// What is run of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scope {
    /// Blocks that show what a command prints.
    Shown,
    /// These, blocks of commands, and commands in the text.
    Everything,
}

/// A page after its commands have run.
pub(super) struct Walked {
    /// What it should be.
    pub(super) text: String,
    /// The commands that ended otherwise than the page says.
    pub(super) faults: Vec<String>,
}

/// A command line, and how it ended.
struct Ran {
    printed: String,
    fault: Option<String>,
}

pub(super) fn walk(page: &Page, scope: Scope, directory: &Path) -> Walked {
    let mut walked = Walked { text: String::new(), faults: Vec::new() };
    for part in &page.parts {
        let now = match part {
            Part::List(name, _) => Part::List(name.clone(), list(name).lines().map(str::to_owned).collect()),
            Part::Block(language, lines) if language == "console" => {
                Part::Block(language.clone(), shown(lines, directory, &mut walked.faults))
            }
            other => {
                if scope == Scope::Everything {
                    walked.faults.extend(faults(other, directory));
                }
                walked.text += &other.written();
                continue;
            }
        };
        walked.text += &now.written();
    }
    walked.faults.iter_mut().for_each(|fault| *fault = format!("{}: {fault}", page.name));
    walked
}

/// The commands of a part that end otherwise than it says, or do not print what it says.
fn faults(part: &Part, directory: &Path) -> Vec<String> {
    match part {
        Part::Block(language, lines) if language == "sh" => {
            let lines = lines.iter().map(|line| line.replace("cargo run --release --", "camgen"));
            lines.filter(|line| line.starts_with("camgen ")).filter_map(|line| run(&line, directory).fault).collect()
        }
        Part::Text(lines) => {
            let (rows, text): (Vec<&str>, Vec<&str>) =
                lines.iter().map(String::as_str).partition(|line| figures(line).is_some());
            let of_rows = rows.iter().filter_map(|line| figures(line)).flat_map(|(figures, command)| {
                let ran = run(command, directory);
                let lacking = figures.into_iter().filter(|figure| !agrees(figure, &ran.printed));
                let lacking: Vec<String> =
                    lacking.map(|figure| format!("`{command}` does not print {figure}")).collect();
                ran.fault.into_iter().chain(lacking).collect::<Vec<_>>()
            });
            let text = text.join(" ");
            let whole = spans(&text).into_iter().filter(|code| code.starts_with("camgen ") && is_whole(code));
            of_rows.chain(whole.filter_map(|code| run(code, directory).fault)).collect()
        }
        _ => Vec::new(),
    }
}

/// The texts in code type.
fn spans(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// The figures in code type in a row of a table whose last cell is a command, and the command.
fn figures(line: &str) -> Option<(Vec<&str>, &str)> {
    let mut cells = line.strip_suffix('|')?.rsplit('|').map(str::trim);
    let command = cells.next()?.strip_prefix('`')?.strip_suffix('`')?;
    let figures = spans(cells.next()?);
    (command.starts_with("camgen ") && is_whole(command) && !figures.is_empty()).then_some((figures, command))
}

/// Whether each number of a text is printed, to the digits that both have.
fn agrees(figure: &str, printed: &str) -> bool {
    let printed = numbers(printed);
    let same = |(value, decimals): (f64, i32)| {
        printed.iter().filter(|(_, of)| *of > 0 || decimals == 0).any(|(other, of)| {
            let last = 10.0_f64.powi(-decimals.min(*of));
            (value - other).abs() <= 0.501 * last
        })
    };
    numbers(figure).into_iter().all(same)
}

/// The numbers of a text, with their digits behind the point.
fn numbers(text: &str) -> Vec<(f64, i32)> {
    let text = text.replace('−', "-");
    let words = text.split(|letter: char| !letter.is_ascii_digit() && !matches!(letter, '.' | '-'));
    let number = |word: &str| {
        let word = word.trim_end_matches(['.', '-']);
        let decimals = word.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        Some((word.parse().ok()?, i32::try_from(decimals).ok()?))
    };
    words.filter_map(number).collect()
}

/// Whether a command in a text can be run as it is: it has no placeholder in capitals and no choice; `camgen check` alone only
/// names the command.
fn is_whole(code: &str) -> bool {
    let words: Vec<&str> = code.split_whitespace().collect();
    let open = |word: &&str| word.starts_with('[') || word.chars().all(|letter| letter.is_ascii_uppercase());
    words.len() > 2 && !code.contains(['|', '…']) && !words.iter().any(open)
}

/// A block of commands, each behind `$ `, with what they print now.
fn shown(lines: &[String], directory: &Path, faults: &mut Vec<String>) -> Vec<String> {
    let mut printed = String::new();
    let mut now = Vec::new();
    for line in lines {
        if let Some(command) = line.strip_prefix("$ ") {
            let ran = run(command, directory);
            faults.extend(ran.fault);
            printed = ran.printed;
            now.push(line.clone());
        } else {
            now.push(as_printed(line, &printed));
        }
    }
    now
}

/// Runs a line: a command, `> FILE` where its output is kept, and a comment, which may name its exit code.
fn run(line: &str, directory: &Path) -> Ran {
    let (command, comment) = line.split_once(" #").unwrap_or((line, ""));
    let (command, file) = command.split_once(" > ").unwrap_or((command, ""));
    let command = command.trim();
    let wanted = i32::from(comment.contains("exit code 1"));
    let help = LONG.iter().any(|long| command.starts_with(long)).then(|| "--help".to_owned());
    let output = start(words(command).into_iter().skip(1).chain(help).collect(), directory);
    let printed = String::from_utf8(output.stdout).expect("UTF-8");
    if !file.is_empty() {
        fs::write(directory.join(file.trim()), &printed).expect("written");
    }
    let fault = (output.status.code() != Some(wanted)).then(|| {
        format!("`{command}` ends with {}, not {wanted}\n{}", output.status, String::from_utf8_lossy(&output.stderr))
    });
    Ran { printed, fault }
}

/// The program with these arguments.
pub(super) fn start(arguments: Vec<String>, directory: &Path) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_camgen"));
    program.args(arguments).current_dir(directory).output().expect("camgen starts")
}

/// The words of a command line, those in quotes together.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for letter in command.chars() {
        match letter {
            '"' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().expect("a word").push(letter),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// A shown line as it is printed now: itself, or else the line that begins like it, up to the comma where the page leaves
/// something out.
pub(super) fn as_printed(line: &str, printed: &str) -> String {
    let (text, left_out) = line.split_once('…').map_or((line, false), |(text, _)| (text, true));
    if printed.contains(text.trim()) {
        return line.to_owned();
    }
    let alike = |other: &&str| text.trim().chars().zip(other.trim().chars()).take_while(|(a, b)| a == b).count();
    let new = printed.lines().max_by_key(alike).unwrap_or_default().trim();
    let indent = &line[..line.len() - line.trim_start().len()];
    let commas = text.matches(", ").count();
    let end = new.match_indices(", ").nth(commas.saturating_sub(1)).map_or(new.len(), |(at, _)| at);
    if left_out { format!("{indent}{}, …", &new[..end]) } else { format!("{indent}{new}") }
}

/// The columns of every table that was written into a directory or the folder `output` in it.
pub(super) fn columns(directory: &Path) -> BTreeSet<String> {
    let folders = [directory.to_owned(), directory.join("output")];
    let entries = folders.iter().filter_map(|folder| fs::read_dir(folder).ok()).flatten();
    let tables = entries.map(|entry| entry.expect("an entry").path()).filter(|path| {
        let name = path.file_name().expect("a name").to_string_lossy();
        // The tables of points have a head of their own, those that a page shows are not camgen's.
        name.ends_with(".csv") && !name.ends_with("-points.csv") && path.starts_with(&folders[1])
    });
    let heads = tables.map(|path| fs::read_to_string(path).expect("a table"));
    let of = |text: String| {
        let head = text.lines().find(|line| !line.starts_with('#')).unwrap_or_default().to_owned();
        // The table of a study has the columns that its file names.
        let of_study = head.starts_with("row,");
        head.split(',').filter(|_| !of_study).map(str::to_owned).collect::<Vec<_>>()
    };
    heads.flat_map(of).collect()
}

#[test]
fn figures_agree_to_the_digits_that_both_have() {
    let printed = "residual 810.278 N at 65.237 mm, C -23.75 %, 66 arcs";
    assert!(agrees("810.28", printed) && agrees("C −23.75 %", printed) && agrees("66", printed));
    assert!(!agrees("810.30", printed) && !agrees("23.75", printed) && !agrees("65", "65.9"));
}
