//! The flags of all commands, from their help.

use super::lists::cell;
use super::runs::start;
use crate::common::program::commands;

/// A flag as the help of a command gives it.
struct Flag {
    /// Its name and value.
    code: String,
    about: String,
    commands: Vec<String>,
}

/// A table of every flag: those with the same meaning in several commands once.
pub(super) fn flags() -> String {
    let mut all: Vec<Flag> = Vec::new();
    for command in commands() {
        for (code, about) in flags_of(&help(&[&command])) {
            match all.iter_mut().find(|flag| flag.code == code && flag.about == about) {
                Some(flag) => flag.commands.push(command.clone()),
                None => all.push(Flag { code, about, commands: vec![command.clone()] }),
            }
        }
    }
    // What several commands share first, then by name.
    all.sort_by(|a, b| b.commands.len().min(2).cmp(&a.commands.len().min(2)).then_with(|| a.code.cmp(&b.code)));
    let row = |flag: Flag| format!("| `{}` | {} | {} |\n", flag.code, cell(&flag.about), flag.commands.join(", "));
    all.into_iter().map(row).fold("| flag | meaning | commands |\n|---|---|---|\n".to_owned(), |all, row| all + &row)
}

fn help(words: &[&str]) -> String {
    let words = words.iter().copied().chain(["--help"]).map(str::to_owned).collect();
    String::from_utf8(start(words, std::path::Path::new(".")).stdout).expect("UTF-8")
}

/// The flags of a help, with what they mean; its own flag is left out.
fn flags_of(help: &str) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    let mut listing = false;
    for line in help.lines() {
        let indent = line.len() - line.trim_start().len();
        let text = line.trim();
        if indent == 0 && !text.is_empty() {
            listing = text == "Options:" || text == "Points:";
        } else if listing && text.starts_with('-') && indent < 8 {
            let (code, about) = text.split_once("  ").unwrap_or((text, ""));
            found.push((code.to_owned(), about.trim().to_owned()));
        } else if let Some((_, about)) = found.last_mut().filter(|_| listing && !text.is_empty()) {
            about.push_str(if about.is_empty() { "" } else { " " });
            about.push_str(text);
        }
    }
    found.retain(|(code, _)| !code.contains("--help"));
    for (_, about) in &mut found {
        // The named values of a flag are described in its text as well.
        *about = about.split(" Possible values:").next().unwrap_or_default().to_owned();
    }
    found
}
