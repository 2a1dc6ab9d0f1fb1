//! The house stands as ARCHITECTURE.md draws it: a room knows only the rooms before it.

#![allow(clippy::expect_used, clippy::panic, missing_docs, reason = "a test fails loudly")]

#[path = "common/source.rs"]
mod source;

use source::{Token, closing, code, sources, src, tokens};
use std::path::{Path, PathBuf};

const ROOMS: [&str; 21] = [
    "units", "numeric", "document", "geometry", "linkage", "shaft", "brake", "buffer", "motion", "follower", "machine",
    "profile", "report", "table", "load", "body", "analysis", "reading", "verify", "write", "pipeline",
];

/// Longest function, in lines from its name to its closing brace.
const LONGEST_FUNCTION: usize = 60;

fn files_of(room: &str) -> Vec<PathBuf> {
    let file = src().join(format!("{room}.rs"));
    sources(&if file.exists() { file } else { src().join(room) })
}

/// Its path below src, for a message.
fn name(path: &Path) -> String {
    path.strip_prefix(src()).expect("below src").display().to_string()
}

/// The modules a file is in: `body/disc/sheet.rs` is body, disc, sheet.
fn module_of(path: &str) -> Vec<String> {
    let path = path.trim_end_matches(".rs").trim_end_matches("/mod");
    path.split('/').map(str::to_owned).collect()
}

/// The paths of a use tree that begins at `at`, each behind `before`.
fn use_tree(all: &[Token], at: usize, before: &[String], found: &mut Vec<(Vec<String>, usize)>) {
    let (mut at, mut path) = (at, before.to_vec());
    let text = |at: usize| all.get(at).map_or(";", |token| token.text.as_str());
    loop {
        match text(at) {
            "{" => {
                let end = closing(all, at);
                let mut item = at + 1;
                while item < end {
                    use_tree(all, item, &path, found);
                    // To the comma behind this item, past the braces in it.
                    while item < end && text(item) != "," {
                        item = if text(item) == "{" { closing(all, item) + 1 } else { item + 1 };
                    }
                    item += 1;
                }
                return;
            }
            ":" => at += 1,
            "," | ";" | "}" | "as" => {
                found.push((path, all[at.min(all.len() - 1)].line));
                return;
            }
            word => {
                path.push(word.to_owned());
                at += 1;
            }
        }
    }
}

/// Every path from the root of the library that the code of a module names, by `use` or in place, with its line.
fn paths(all: &[Token], module: &[String]) -> Vec<(Vec<String>, usize)> {
    let mut found = Vec::new();
    for (at, token) in all.iter().enumerate() {
        let follows = |text: &str| all.get(at + 1).is_some_and(|next| next.text == text);
        if token.text == "use" {
            use_tree(all, at + 1, &[], &mut found);
        } else if matches!(token.text.as_str(), "crate" | "super" | "self") && follows(":") {
            // The head of a path in place; a path inside one that has begun is not a head.
            if at > 1 && all[at - 1].text == ":" && all[at - 2].text == ":" {
                continue;
            }
            let mut path = vec![token.text.clone()];
            let mut next = at + 1;
            while all.len() > next + 2 && all[next].text == ":" && all[next + 1].text == ":" {
                path.push(all[next + 2].text.clone());
                next += 3;
            }
            found.push((path, token.line));
        }
    }
    found.into_iter().filter_map(|(path, line)| Some((from_root(&path, module)?, line))).collect()
}

/// A path from the root of the library; `None` for one into another library or to something in scope.
fn from_root(path: &[String], module: &[String]) -> Option<Vec<String>> {
    let mut base = match path.first()?.as_str() {
        "crate" => Vec::new(),
        "self" | "super" => module.to_vec(),
        _ => return None,
    };
    let mut rest = path;
    while let [head, tail @ ..] = rest {
        match head.as_str() {
            "super" => drop(base.pop()),
            "self" | "crate" => {}
            _ => break,
        }
        rest = tail;
    }
    base.extend(rest.iter().cloned());
    Some(base)
}

/// What a file of a room knows of later rooms, a line each.
fn knows_later(path: &str, text: &str) -> Vec<String> {
    let (all, module) = (tokens(text), module_of(path));
    let own = ROOMS.iter().position(|room| *room == module[0]).expect("a file of a room");
    let mut told = Vec::new();
    for (found, line) in paths(&all, &module) {
        match found.first().map(String::as_str) {
            None | Some("*") => told.push(format!("{path}:{line} names the whole library")),
            Some(room) if ROOMS.iter().position(|other| *other == room).is_some_and(|index| index > own) => {
                told.push(format!("{path}:{line} knows {}", found.join("::")));
            }
            Some(_) => {}
        }
    }
    told.sort();
    told.dedup();
    told
}

/// Where a struct is made by a literal: not where it is declared or named as a type.
fn made(all: &[Token], what: &str) -> Vec<usize> {
    let is_made = |(at, token): (usize, &Token)| {
        let before = at.checked_sub(1).map_or("", |before| all[before].text.as_str());
        let opens = all.get(at + 1).is_some_and(|next| next.text == "{");
        // `-> Check {`, `-> &Check {` and `-> &'static Check {` begin the body of a function.
        let as_type = ["struct", "impl", "for", "enum", "union", ">", "&", "static", "dyn"].contains(&before);
        (token.text == what && opens && !as_type).then_some(token.line)
    };
    all.iter().enumerate().filter_map(is_made).collect()
}

/// Functions longer than they may be, each with its line and length.
fn long_functions(text: &str) -> Vec<(String, usize, usize)> {
    let all = tokens(text);
    let mut found = Vec::new();
    for at in (0..all.len()).filter(|at| all[*at].text == "fn") {
        // `fn(f64) -> f64` is a type.
        let Some(name) = all.get(at + 1).filter(|next| next.text != "(") else { continue };
        let mut open = at;
        while all.get(open).is_some_and(|token| !["{", ";"].contains(&token.text.as_str())) {
            open = if ["(", "["].contains(&all[open].text.as_str()) { closing(&all, open) + 1 } else { open + 1 };
        }
        if all.get(open).is_some_and(|token| token.text == "{") {
            let lines = all[closing(&all, open)].line - all[at].line + 1;
            if lines > LONGEST_FUNCTION {
                found.push((name.text.clone(), all[at].line, lines));
            }
        }
    }
    found
}

#[test]
fn the_rooms_are_those_of_the_library_in_its_order() {
    let lib = tokens(&code(&src().join("lib.rs")));
    let declared: Vec<&str> =
        lib.windows(2).filter(|pair| pair[0].text == "mod").map(|pair| pair[1].text.as_str()).collect();
    assert_eq!(declared, ROOMS);
    for room in ROOMS {
        assert!(!files_of(room).is_empty(), "{room} has no files");
    }
}

#[test]
fn a_room_knows_only_the_rooms_before_it() {
    let told: Vec<String> =
        ROOMS.iter().flat_map(|room| files_of(room)).flat_map(|path| knows_later(&name(&path), &code(&path))).collect();
    assert!(told.is_empty(), "\n{}\n", told.join("\n"));
}

/// Imports in every dress are seen, and what only looks like one is not.
#[test]
fn planted_imports_are_seen() {
    for planted in [
        "use crate::verify;",
        "use crate::verify::rolling;",
        "use crate::{units, verify::{self, rolling}};",
        "use crate::{\n    units::{self, Dimension},\n    pipeline::Spec,\n};",
        "use super::super::write::json;",
        "use super::super::{verify, write};",
        "use self::super::super::pipeline;",
        "pub use crate::write as out;",
        "fn f() { crate::pipeline::Spec::builder(\"x\"); }",
        "fn f(found: super::super::verify::Check) {}",
        "use crate as camgen;",
        "use crate::*;",
    ] {
        assert!(!knows_later("body/disc/mod.rs", planted).is_empty(), "{planted}");
    }
    for harmless in [
        "use crate::profile::Curves;",
        "use super::super::part::Part;",
        "use super::{verify, write};",
        "use std::fmt::{self, Write as _};",
        "// use crate::verify;\nfn f() -> &'static str { \"crate::verify::x\" }",
        "/// [`crate::verify::run`]\npub(super) fn verify() {}",
        "fn f(self: &Self) { self::verify::x(); }",
    ] {
        assert_eq!(knows_later("body/disc/mod.rs", harmless), Vec::<String>::new(), "{harmless}");
    }
}

/// A check, a format and a column each stand in one list; nobody else makes one.
#[test]
fn what_is_in_a_list_is_made_in_its_room() {
    let mut told = Vec::new();
    for path in sources(&src()) {
        let (file, all) = (name(&path), tokens(&code(&path)));
        for (room, what) in [("verify", "Check"), ("write", "Format")] {
            if !file.starts_with(room) {
                told.extend(made(&all, what).iter().map(|line| format!("{file}:{line} makes a {what}")));
            }
        }
        if !file.starts_with("table") {
            let of_table = |path: &[String]| match path {
                [room, item, ..] => room == "table" && ["Column", "COLUMNS"].contains(&item.as_str()),
                _ => false,
            };
            let module = module_of(&file);
            let columns = paths(&all, &module).into_iter().filter(|(path, _)| of_table(path));
            told.extend(columns.map(|(path, line)| format!("{file}:{line} lists columns: {}", path.join("::"))));
            // A table with columns of its own: `Table { columns: .. }`.
            let own = all.windows(3).filter(|three| {
                three[1].text == "columns" && three[2].text == ":" && ["{", ","].contains(&three[0].text.as_str())
            });
            told.extend(own.map(|three| format!("{file}:{} has columns of its own", three[1].line)));
        }
    }
    assert!(told.is_empty(), "\n{}\n", told.join("\n"));
}

#[test]
fn what_is_made_is_told_from_what_is_named() {
    let lines = |text: &str| made(&tokens(text), "Check");
    assert_eq!(lines("const A: Check = Check { name };\nlet b =\n    Check { name };"), [1, 3]);
    assert_eq!(lines("vec![Check {}, verify::Check {}]"), [1, 1]);
    let named =
        "struct Check {}\nimpl Check {}\nimpl Debug for Check {}\nfn f() -> Check {}\nfn g() -> &'static Check {}";
    assert_eq!(lines(named), Vec::<usize>::new());
}

/// Writers only format; the library neither prints nor exits nor looks at a clock.
#[test]
fn what_is_absent_stays_absent() {
    for path in files_of("write") {
        for word in ["libm::", "atan2", ".sin()", ".cos()", "offset_inward"] {
            assert!(!code(&path).contains(word), "{} has {word}", name(&path));
        }
    }
    for room in ROOMS {
        for path in files_of(room) {
            for word in
                ["println!", "eprintln!", "process::exit", "SystemTime", "Instant::now", "HashMap", ".sin()", ".powf("]
            {
                assert!(!code(&path).contains(word), "{} has {word}", name(&path));
            }
        }
    }
}

#[test]
fn no_function_is_longer_than_a_page() {
    let told: Vec<String> = sources(&src())
        .iter()
        .flat_map(|path| {
            let file = name(path);
            long_functions(&code(path))
                .into_iter()
                .map(move |(function, line, lines)| format!("{file}:{line} {function} has {lines} lines"))
        })
        .collect();
    assert!(told.is_empty(), "more than {LONGEST_FUNCTION} lines:\n{}\n", told.join("\n"));
}

#[test]
fn lines_of_a_function_are_counted_to_its_brace() {
    let of = |lines: usize| {
        format!("trait T {{ fn t(&self); }}\nfn f(g: fn() -> [u8; 2]) {{\n{}}}\n", "    '{';\n".repeat(lines))
    };
    assert_eq!(long_functions(&of(LONGEST_FUNCTION - 2)), []);
    assert_eq!(long_functions(&of(LONGEST_FUNCTION - 1)), [("f".to_owned(), 2, LONGEST_FUNCTION + 1)]);
}
