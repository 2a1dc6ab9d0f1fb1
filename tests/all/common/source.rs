//! Source files of the library as tokens, for the tests that look at how it is built.

use std::fs;
use std::path::{Path, PathBuf};

/// A word, a number or a sign of a source file, with its line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Token {
    pub(crate) text: String,
    pub(crate) line: usize,
}

/// The crates below the program, each knowing those before it.
pub(crate) const CRATES: [&str; 3] = ["kernel", "cams", "printing"];

/// The folder of the package of the program.
pub(crate) fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Where the sources of a crate stand.
pub(crate) fn src(name: &str) -> PathBuf {
    root().join("crates").join(name).join("src")
}

/// Every source file of every crate, those of the program last, without files of tests.
pub(crate) fn all_sources() -> Vec<PathBuf> {
    CRATES.iter().map(|name| src(name)).chain([root().join("src")]).flat_map(|path| sources(&path)).collect()
}

/// Every source file below a path, without files of tests, which may look anywhere.
pub(crate) fn sources(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        let is_tests = path.file_name().is_some_and(|name| name == "tests.rs");
        return if is_tests { Vec::new() } else { vec![path.to_owned()] };
    }
    let inside = fs::read_dir(path).expect("a directory").map(|entry| entry.expect("an entry").path());
    let mut found: Vec<PathBuf> = inside
        .filter(|path| path.file_name().is_none_or(|name| name != "tests"))
        .flat_map(|path| sources(&path))
        .collect();
    found.sort();
    found
}

/// The text of a file without its tests.
pub(crate) fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a source file");
    text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default().to_owned()
}

/// How many characters a text or character literal or a comment takes at the start of `rest`; 0 when there is none.
fn skipped(rest: &[char], before: Option<char>) -> usize {
    let begins = |word: &str| rest.iter().zip(word.chars()).filter(|(a, b)| **a == *b).count() == word.len();
    let until = |from: usize, end: &str| {
        let end: Vec<char> = end.chars().collect();
        let found = rest.get(from..).and_then(|tail| tail.windows(end.len()).position(|window| window == end));
        found.map_or(rest.len(), |at| from + at + end.len())
    };
    // Up to a sign that no backslash stands before.
    let closed = |from: usize, end: char| {
        let mut at = from;
        while at < rest.len() && rest[at] != end {
            at += if rest[at] == '\\' { 2 } else { 1 };
        }
        (at + 1).min(rest.len())
    };
    if begins("//") {
        return rest.iter().position(|c| *c == '\n').unwrap_or(rest.len());
    }
    if begins("/*") {
        return until(2, "*/");
    }
    let in_word = before.is_some_and(|c| c.is_alphanumeric() || c == '_');
    if !in_word && rest[0] == 'r' {
        let hashes = rest[1..].iter().take_while(|c| **c == '#').count();
        if rest.get(1 + hashes) == Some(&'"') {
            return until(2 + hashes, &format!("\"{}", "#".repeat(hashes)));
        }
    }
    match rest[0] {
        '"' => closed(1, '"'),
        // A lifetime is a quote without a second one two or so further on.
        '\'' if rest.get(1) == Some(&'\\') => closed(1, '\''),
        '\'' if rest.get(2) == Some(&'\'') => 3,
        _ => 0,
    }
}

/// The tokens of a text; comments, texts and characters are left out.
pub(crate) fn tokens(text: &str) -> Vec<Token> {
    let all: Vec<char> = text.chars().collect();
    let (mut found, mut at, mut line) = (Vec::new(), 0, 1);
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    while at < all.len() {
        let skip = skipped(&all[at..], at.checked_sub(1).map(|before| all[before]));
        let length = if skip > 0 { skip } else { all[at..].iter().take_while(|c| is_word(**c)).count().max(1) };
        let text: String = all[at..at + length].iter().collect();
        let lines = text.matches('\n').count();
        if skip == 0 && !all[at].is_whitespace() {
            found.push(Token { text, line });
        }
        line += lines;
        at += length;
    }
    found
}

/// Where the sign that closes the one at `open` stands.
pub(crate) fn closing(tokens: &[Token], open: usize) -> usize {
    let mut depth = 0_i32;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at;
        }
    }
    panic!("line {}: `{}` is not closed", tokens[open].line, tokens[open].text)
}

/// What a file brings in by `use`: a path, and the name it has here.
pub(crate) struct Used {
    pub(crate) path: Vec<String>,
    pub(crate) name: String,
}

/// What the use tree that begins at `at` brings in.
pub(crate) fn used(all: &[Token], at: usize) -> Vec<Used> {
    let mut found = Vec::new();
    use_tree(all, at, &[], &mut found);
    found
}

/// Adds what a part of a use tree brings in, behind `before`.
fn use_tree(all: &[Token], mut at: usize, before: &[String], found: &mut Vec<Used>) {
    let mut path = before.to_vec();
    let text = |at: usize| all.get(at).map_or(";", |token| token.text.as_str());
    loop {
        match text(at) {
            "{" => {
                let end = closing(all, at);
                at += 1;
                while at < end {
                    use_tree(all, at, &path, found);
                    // To the comma behind this item, past the braces in it.
                    while at < end && text(at) != "," {
                        at = if text(at) == "{" { closing(all, at) + 1 } else { at + 1 };
                    }
                    at += 1;
                }
                return;
            }
            ":" => at += 1,
            "as" | "," | ";" | "}" => {
                // `{self}` brings in the module itself.
                if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
                    path.pop();
                }
                let own = path.last().cloned().unwrap_or_default();
                let name = if text(at) == "as" { text(at + 1).to_owned() } else { own };
                found.push(Used { path, name });
                return;
            }
            word => {
                path.push(word.to_owned());
                at += 1;
            }
        }
    }
}
