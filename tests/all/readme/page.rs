//! A page of Markdown: its text, its blocks of code, and its lists of the source.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// Before a list of the source, with its name behind it; and after one.
const LIST: &str = "<!-- list: ";
const END: &str = "<!-- end of the list -->";
const FENCE: &str = "```";

/// A part of a page, in lines.
#[derive(Debug)]
pub(super) enum Part {
    Text(Vec<String>),
    /// The language of a block of code, and the lines in it.
    Block(String, Vec<String>),
    /// The name of a list, and its lines.
    List(String, Vec<String>),
}

#[derive(Debug)]
pub(super) struct Page {
    /// Its path from the root.
    pub(super) name: String,
    pub(super) text: String,
    pub(super) parts: Vec<Part>,
}

impl Page {
    pub(super) fn read(root: &Path, name: &Path) -> Self {
        let text = fs::read_to_string(root.join(name)).unwrap_or_else(|error| panic!("{}: {error}", name.display()));
        Self { name: name.to_str().expect("text").to_owned(), parts: parts(&text), text }
    }

    /// The files that it shows: a block behind a line that ends with the name of the file, `` Save this as `lifter.toml`: ``.
    pub(super) fn files(&self) -> Vec<(&str, String)> {
        let mut found = Vec::new();
        for pair in self.parts.windows(2) {
            let [Part::Text(before), Part::Block(_, lines)] = pair else { continue };
            let last = before.iter().rev().find(|line| !line.is_empty()).map_or("", String::as_str);
            let name = last.strip_suffix("`:").and_then(|line| line.rsplit('`').next());
            found.extend(name.filter(|name| name.contains('.')).map(|name| (name, lines.join("\n") + "\n")));
        }
        found
    }
}

impl Part {
    /// As it is written in the page.
    pub(super) fn written(&self) -> String {
        let (before, lines, after) = match self {
            Part::Text(lines) => (None, lines, None),
            Part::Block(language, lines) => (Some(format!("{FENCE}{language}")), lines, Some(FENCE)),
            Part::List(name, lines) => (Some(format!("{LIST}{name} -->")), lines, Some(END)),
        };
        let all = before.iter().map(String::as_str).chain(lines.iter().map(String::as_str)).chain(after);
        all.fold(String::new(), |mut text, line| {
            writeln!(text, "{line}").expect("a text grows");
            text
        })
    }

    /// The links of a text.
    pub(super) fn links(&self) -> Vec<String> {
        let Part::Text(lines) = self else { return Vec::new() };
        super::links(&lines.join("\n")).into_iter().map(str::to_owned).collect()
    }
}

fn parts(text: &str) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let mut inside = |end: &str| lines.by_ref().take_while(|line| *line != end).map(str::to_owned).collect();
        if let Some(language) = line.strip_prefix(FENCE) {
            parts.push(Part::Block(language.to_owned(), inside(FENCE)));
        } else if let Some(name) = line.strip_prefix(LIST).and_then(|name| name.strip_suffix(" -->")) {
            parts.push(Part::List(name.to_owned(), inside(END)));
        } else if let Some(Part::Text(before)) = parts.last_mut() {
            before.push(line.to_owned());
        } else {
            parts.push(Part::Text(vec![line.to_owned()]));
        }
    }
    parts
}

/// The anchor of a heading, as code hosts and mdBook make it.
pub(super) fn anchor(line: &str) -> Option<String> {
    let heading = line.strip_prefix('#')?.trim_start_matches('#').strip_prefix(' ')?;
    let kept = heading.chars().filter(|letter| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_'));
    Some(kept.map(|letter| if letter == ' ' { '-' } else { letter.to_ascii_lowercase() }).collect())
}
