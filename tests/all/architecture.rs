//! The house stands as ARCHITECTURE.md draws it: a room knows only the rooms before it.

use crate::common::source::{CRATES, Token, all_sources, code, root, sources, src, tokens, used};
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of the kernel and of the cams, in their order, and the domains.
const KERNEL: [&str; 9] =
    ["units", "text", "refusal", "numeric", "document", "geometry", "motion", "follower", "profile"];
const CAMS: [&str; 17] = [
    "machine",
    "report",
    "table",
    "load",
    "check",
    "body",
    "analysis",
    "reading",
    "verify",
    "write",
    "tool_files",
    "pipeline",
    "trade",
    "domain",
    "catalogue",
    "study",
    "engine",
];
const DOMAINS: [&str; 4] = ["press", "linkage", "shaft", "brake"];

/// All of them: a room knows only those before it.
fn rooms() -> impl Iterator<Item = &'static str> {
    KERNEL.iter().chain(&CAMS).chain(&DOMAINS).copied()
}

/// The place of a room among them.
fn place(room: &str) -> Option<usize> {
    rooms().position(|other| other == room)
}

fn files_of(room: &str) -> Vec<PathBuf> {
    let of_crate = |name: &str| {
        let both = [src(name).join(format!("{room}.rs")), src(name).join(room)];
        both.into_iter().filter(|path| path.exists()).flat_map(|path| sources(&path)).collect::<Vec<_>>()
    };
    CRATES.iter().flat_map(|name| of_crate(name)).collect()
}

/// Its path below the src of its crate, for a message.
fn name(path: &Path) -> String {
    let below = CRATES.iter().find_map(|name| path.strip_prefix(src(name)).ok());
    below.unwrap_or_else(|| path.strip_prefix(root()).expect("a file of the program")).display().to_string()
}

/// The modules a file is in: `body/disc/sheet.rs` is body, disc, sheet.
fn module_of(path: &str) -> Vec<String> {
    let path = path.trim_end_matches(".rs").trim_end_matches("/mod");
    path.split('/').map(str::to_owned).collect()
}

/// Every path from the root of the library that the code of a module names, by `use` or in place, with its line.
fn paths(all: &[Token], module: &[String]) -> Vec<(Vec<String>, usize)> {
    let mut found = Vec::new();
    for (at, token) in all.iter().enumerate() {
        let follows = |text: &str| all.get(at + 1).is_some_and(|next| next.text == text);
        if token.text == "use" {
            found.extend(used(all, at + 1).into_iter().map(|used| (used.path, token.line)));
        } else if (matches!(token.text.as_str(), "super" | "self") || is_root(&token.text)) && follows(":") {
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

/// The root of a crate: its own, or that of one before it.
fn is_root(head: &str) -> bool {
    ["crate", "camgen_kernel", "camgen_cams", "camgen_printing"].contains(&head)
}

/// A path from the root of its crate; `None` for one into another library or to something in scope.
fn from_root(path: &[String], module: &[String]) -> Option<Vec<String>> {
    let mut base = match path.first()?.as_str() {
        head if is_root(head) => Vec::new(),
        "self" | "super" => module.to_vec(),
        _ => return None,
    };
    let mut rest = path;
    while let [head, tail @ ..] = rest {
        match head.as_str() {
            "super" => drop(base.pop()),
            "self" => {}
            head if is_root(head) => {}
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
    let own = place(&module[0]).expect("a file of a room");
    let mut told = Vec::new();
    for (found, line) in paths(&all, &module) {
        match found.first().map(String::as_str) {
            None | Some("*") => told.push(format!("{path}:{line} names the whole library")),
            Some(room) if place(room).is_some_and(|index| index > own) => {
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

#[test]
fn the_rooms_are_those_of_the_crates_in_their_order() {
    let declared = |name: &str| {
        let lib = tokens(&code(&src(name).join("lib.rs")));
        let pairs = lib.windows(2).filter(|pair| pair[0].text == "mod");
        pairs.map(|pair| pair[1].text.clone()).collect::<Vec<_>>()
    };
    assert_eq!(declared("kernel"), KERNEL);
    assert_eq!(declared("cams"), CAMS);
    // Modules side by side are sorted; the list has the order.
    let listed = tokens(&code(&src("printing").join("lib.rs")));
    let listed = listed.windows(4).filter(|four| four[1].text == ":" && four[3].text == "DOMAIN");
    assert_eq!(listed.map(|four| four[0].text.clone()).collect::<Vec<_>>(), DOMAINS);
    for room in rooms() {
        assert!(!files_of(room).is_empty(), "{room} has no files");
    }
}

#[test]
fn a_room_knows_only_the_rooms_before_it() {
    let told: Vec<String> =
        rooms().flat_map(files_of).flat_map(|path| knows_later(&name(&path), &code(&path))).collect();
    assert!(told.is_empty(), "\n{}\n", told.join("\n"));
    let later = |path: &str| !knows_later(path, "use crate::brake::machine;").is_empty();
    assert!(later("press/keys.rs") && !later("brake/keys.rs"));
}

/// The core is the same whatever domains there are, and no crate needs a later one to be built.
#[test]
fn no_crate_of_the_core_names_a_domain() {
    for (at, name) in CRATES.iter().enumerate() {
        let text = fs::read_to_string(root().join("crates").join(name).join("Cargo.toml")).expect("a manifest");
        let (built, _) = text.split_once("[dev-dependencies]").expect("what tests need");
        for later in &CRATES[at + 1..] {
            assert!(!built.contains(&format!("camgen-{later}")), "{name} needs {later}");
        }
    }
    for path in KERNEL.iter().chain(&CAMS).flat_map(|room| files_of(room)) {
        let code = code(&path);
        assert!(!code.contains("camgen_printing"), "{} names a domain", path.display());
        for line in code.lines().filter(|line| DOMAINS.iter().any(|domain| line.contains(&format!("\"{domain}\"")))) {
            assert!(!line.contains("feature = "), "{} asks for a domain: {line}", path.display());
        }
    }
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
        "use camgen_kernel::*;",
        "use camgen_cams::verify::rolling;",
    ] {
        assert!(!knows_later("body/disc/mod.rs", planted).is_empty(), "{planted}");
    }
    for harmless in [
        "use crate::profile::Curves;",
        "use camgen_kernel::profile::{self, Curves};",
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

/// A format and a column each stand in one list; nobody else makes one. A body may bring checks of its own.
#[test]
fn what_is_in_a_list_is_made_in_its_room() {
    let mut told = Vec::new();
    for path in all_sources() {
        let (file, all) = (name(&path), tokens(&code(&path)));
        for (room, what) in [("verify", "FileCheck"), ("write", "View"), ("tool_files", "CutFormat")] {
            // One of the same name that a file keeps for itself is another.
            let has_own = all.windows(2).any(|pair| pair[0].text == "struct" && pair[1].text == what);
            if !file.starts_with(room) && !has_own {
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
    let writers = |path: &PathBuf| path.iter().any(|part| part == "write" || part == "write.rs");
    for path in files_of("write").into_iter().chain(files_of("tool_files").into_iter().filter(writers)) {
        for word in ["libm::", "atan2", ".sin()", ".cos()", "offset_inward"] {
            assert!(!code(&path).contains(word), "{} has {word}", name(&path));
        }
    }
    for room in rooms() {
        for path in files_of(room) {
            let program = without_comments(&code(&path));
            for word in
                ["println!", "eprintln!", "process::exit", "SystemTime", "Instant::now", "HashMap", ".sin()", ".powf("]
            {
                assert!(!program.contains(word), "{} has {word}", name(&path));
            }
        }
    }
}

/// An example in a comment may print.
fn without_comments(text: &str) -> String {
    text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// What holds a sentence that this program wrote.
const SENTENCES: [&str; 7] = ["note", "notes", "message", "help", "remedy", "note_words", "sentence"];
/// What takes a text apart, or looks for something in it.
const READERS: [&str; 9] =
    ["contains", "starts_with", "ends_with", "split", "split_once", "find", "strip_prefix", "strip_suffix", "matches"];

/// Where a sentence is taken apart: `note.contains("…")`, `finding.note.as_deref()….split(…)`; the lines.
fn sentences_that_are_read(text: &str) -> Vec<usize> {
    let all = tokens(text);
    let is = |at: usize, wanted: &str| all.get(at).is_some_and(|token| token.text == wanted);
    let mut lines = Vec::new();
    for at in (0..all.len()).filter(|at| SENTENCES.contains(&all[*at].text.as_str())) {
        // Further calls on it without arguments, such as as_ref(), then the one that reads; what iter() finds is an item.
        let mut next = at + 1;
        if is(next, "(") && is(next + 1, ")") {
            next += 2;
        }
        let reads = |at: usize| all.get(at).is_some_and(|call| READERS.contains(&call.text.as_str()));
        while is(next, ".") && !reads(next + 1) && !is(next + 1, "iter") && is(next + 2, "(") && is(next + 3, ")") {
            next += 4;
        }
        if is(next, ".") && reads(next + 1) && is(next + 2, "(") {
            lines.push(all[at].line);
        }
    }
    lines
}

/// Sentences are for people: what a program needs of them is data beside them.
#[test]
fn no_code_reads_a_sentence_that_code_wrote() {
    let found: Vec<String> = all_sources()
        .iter()
        .flat_map(|path| {
            let file = name(path);
            sentences_that_are_read(&code(path)).into_iter().map(move |line| format!("{file}:{line}"))
        })
        .filter(|found| !READ_ELSEWHERE.iter().any(|(file, _)| found.contains(file)))
        .collect();
    assert!(found.is_empty(), "a sentence is read:\n{}\n", found.join("\n"));
}

/// Where a sentence is still read, and why.
const READ_ELSEWHERE: [(&str, &str); 1] =
    [("cli/import.rs", "which keys of [motion] a message names, to say that they are flags here")];

#[test]
fn a_sentence_that_is_read_is_seen() {
    for planted in [
        "fn f() { note.contains(\"would\") }",
        "fn f() { finding.note.as_ref().as_deref().split(\"; \") }",
        "fn f() { found.note_words().contains(\"x\") }",
        "fn f() { fault.message.starts_with(\"unknown\") }",
    ] {
        assert_eq!(sentences_that_are_read(planted), [1], "{planted}");
    }
    for fine in
        ["fn f() { note.to_string() }", "fn f() { notes.iter().find(is_first) }", "fn f() { head.contains(\"x\") }"]
    {
        assert!(sentences_that_are_read(fine).is_empty(), "{fine}");
    }
}

/// A file that no `mod` names, or that stands beside the one program of tests, would never run.
#[test]
fn every_file_of_tests_is_a_module() {
    let folder = root().join("tests");
    for path in sources(&folder).iter().filter(|path| path.extension().is_some_and(|end| end == "rs")) {
        let root = path.with_file_name("main.rs");
        let root = if root.exists() { root } else { path.with_file_name("mod.rs") };
        let stem = path.file_stem().expect("a name").to_string_lossy();
        let all = if root.exists() { tokens(&code(&root)) } else { Vec::new() };
        let is_named = all.windows(2).any(|pair| pair[0].text == "mod" && pair[1].text == stem);
        assert!(is_named || *path == root, "{} is in no module", path.display());
    }
}
