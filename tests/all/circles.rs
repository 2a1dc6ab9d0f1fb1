//! No files of the sources need each other: a circle of imports is a knot that nobody can read, test or take out alone.
//!
//! What counts is where an item is defined. A name that a file takes by `use`, or by a path in place, is followed through the `use`
//! and `pub use` of modules to the file that defines it. `mod x;`, `pub use` and the import of a module are not needs, and a
//! module may use those in its own folder, which it declares; what they need of it counts.

use crate::common::source::{CRATES, Token, Used, code, sources, src, tokens, used};
use std::collections::{BTreeMap, BTreeSet};

/// Words behind which an item of a module stands.
const ITEMS: [&str; 9] = ["fn", "struct", "enum", "trait", "type", "const", "static", "union", "macro_rules"];

/// Modules deep at the most that a name is followed.
const DEPTH: usize = 16;

type Path = Vec<String>;

/// A module in a file of its own.
#[derive(Default)]
struct Module {
    file: String,
    items: BTreeSet<String>,
    used: Vec<Used>,
    /// Brought in for others, by `pub use`.
    handed_on: Vec<Used>,
    /// Paths in place, as they are written.
    named: Vec<Path>,
}

fn text(all: &[Token], at: usize) -> &str {
    all.get(at).map_or("", |token| &token.text)
}

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// What a file defines at its top, brings in and names.
fn module(file: String, source: &str) -> Module {
    let all = tokens(source);
    let mut module = Module { file, ..Module::default() };
    let (mut at, mut depth) = (0, 0_i32);
    while at < all.len() {
        let before = at.checked_sub(1).map_or("", |before| text(&all, before));
        match text(&all, at) {
            "{" => depth += 1,
            "}" => depth -= 1,
            "use" => {
                let list = if ["pub", ")"].contains(&before) { &mut module.handed_on } else { &mut module.used };
                list.extend(used(&all, at + 1));
                while text(&all, at) != ";" {
                    at += 1;
                }
            }
            word if depth == 0 && ITEMS.contains(&word) => {
                let name =
                    (at + 1..all.len()).map(|next| text(&all, next)).find(|next| is_word(next) && *next != "mut");
                module.items.extend(name.map(str::to_owned));
            }
            word if is_word(word) && before != "." && !(before == ":" && text(&all, at.saturating_sub(2)) == ":") => {
                let mut path = vec![word.to_owned()];
                while text(&all, at + 1) == ":" && text(&all, at + 2) == ":" && is_word(text(&all, at + 3)) {
                    path.push(text(&all, at + 3).to_owned());
                    at += 3;
                }
                module.named.extend((path.len() > 1).then_some(path));
            }
            _ => {}
        }
        at += 1;
    }
    module
}

/// The modules by their paths.
struct Modules(BTreeMap<Path, Module>);

impl Modules {
    /// Of files by their names below src, with their texts.
    fn of(files: impl IntoIterator<Item = (String, String)>) -> Self {
        let modules = files.into_iter().map(|(name, text)| {
            let path = name.trim_end_matches(".rs").trim_end_matches("/mod");
            // The library's root is the root of every path; nothing names the program's.
            let path = if path == "lib" { Vec::new() } else { path.split('/').map(str::to_owned).collect() };
            (path, module(name, &text))
        });
        Self(modules.collect())
    }

    /// The module that defines what a path written in a module means, and its name there; `None` for a module and for what is not ours.
    fn resolve(&self, own: &[String], path: &[String], depth: usize) -> Option<(Path, String)> {
        let (head, mut rest) = path.split_first()?;
        let mut place = match head.as_str() {
            "crate" => Vec::new(),
            "self" => own.to_vec(),
            "super" => own[..own.len().saturating_sub(1)].to_vec(),
            _ => {
                rest = path;
                own.to_vec()
            }
        };
        while let Some((word, tail)) = rest.split_first() {
            let inner = [&place[..], std::slice::from_ref(word)].concat();
            if word == "super" {
                place.pop();
            } else if self.0.contains_key(&inner) {
                place = inner;
            } else {
                let module = self.0.get(&place)?;
                if module.items.contains(word) {
                    return Some((place, word.clone()));
                }
                // A name that the module has from elsewhere; one of its own name, as `use tables` in `mod tables`, is not.
                let known =
                    module.used.iter().chain(&module.handed_on).find(|used| used.name == *word && used.path != path);
                let further = [&known?.path[..], tail].concat();
                return (depth < DEPTH).then(|| self.resolve(&place, &further, depth + 1)).flatten();
            }
            rest = tail;
        }
        None
    }

    /// What each file needs of which other files.
    fn needs(&self) -> BTreeMap<&str, BTreeMap<&str, BTreeSet<String>>> {
        let mut needs: BTreeMap<&str, BTreeMap<&str, BTreeSet<String>>> = BTreeMap::new();
        for (own, module) in &self.0 {
            for path in module.used.iter().map(|used| &used.path).chain(&module.named) {
                if let Some((other, name)) = self.resolve(own, path, 0).filter(|(other, _)| !other.starts_with(own)) {
                    needs.entry(&module.file).or_default().entry(&self.0[&other].file).or_default().insert(name);
                }
            }
        }
        needs
    }
}

/// The circles, each by its files.
fn circles<'a>(needs: &BTreeMap<&'a str, BTreeMap<&'a str, BTreeSet<String>>>) -> BTreeSet<Vec<&'a str>> {
    let reached = |from: &'a str| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(file) = open.pop() {
            open.extend(needs.get(file).into_iter().flat_map(BTreeMap::keys).filter(|next| seen.insert(**next)));
        }
        seen
    };
    let all: BTreeMap<&str, BTreeSet<&str>> = needs.keys().map(|file| (*file, reached(file))).collect();
    let circle = |file: &&'a str| {
        let back = all[file].iter().filter(|other| all.get(*other).is_some_and(|there| there.contains(file)));
        back.copied().collect::<Vec<_>>()
    };
    all.keys().map(circle).filter(|circle| !circle.is_empty()).collect()
}

fn library(name: &str) -> Modules {
    let root = src(name);
    let files = sources(&root).into_iter().map(|path| {
        let name = path.strip_prefix(&root).expect("below src").display().to_string();
        (name, code(&path))
    });
    Modules::of(files.filter(|(name, _)| !name.contains("tests/")))
}

#[test]
fn no_files_need_each_other() {
    let mut told = Vec::new();
    // No crate needs a later one, so that a circle is within one of them.
    for modules in CRATES.map(library) {
        told.extend(circles_of(&modules));
    }
    assert!(told.is_empty(), "\n{}\n", told.join("\n"));
}

/// The circles of a crate, in lines.
fn circles_of(modules: &Modules) -> Vec<String> {
    let needs = modules.needs();
    let mut told = Vec::new();
    for circle in circles(&needs) {
        told.push("a circle:".to_owned());
        for file in &circle {
            for (other, names) in needs[file].iter().filter(|(other, _)| circle.contains(other)) {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                told.push(format!("  {file} needs {other}: {}", names.join(", ")));
            }
        }
    }
    told
}

/// Circles in every dress are seen, and what only looks like one is not.
#[test]
fn planted_circles_are_seen() {
    let found = |files: &[(&str, &str)]| {
        let modules = Modules::of(files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())));
        circles(&modules.needs()).into_iter().map(|circle| circle.join(" ")).collect::<Vec<_>>()
    };
    let b = "use crate::a::A;\npub struct B(A);";
    for a in [
        "use crate::b::B;\npub struct A;",
        "use super::b::{self, B as Other};\npub struct A;",
        "pub struct A;\nfn f() -> crate::b::B {}",
        "use crate::b;\npub struct A;\nfn f(b: &b::B) {}",
        "use crate::{b as other};\npub struct A;\nfn f(b: &other::B) {}",
        "pub struct A;\nfn f() { use super::b::B; }",
        "pub struct A { b: crate::b::B }",
    ] {
        assert_eq!(found(&[("a.rs", a), ("b.rs", b)]), ["a.rs b.rs"], "{a}");
    }
    for a in [
        "pub use crate::b::B;\npub struct A;",
        "use crate::b;\npub struct A;",
        "/// [`crate::b::B`]\npub struct A;\nconst TEXT: &str = \"crate::b::B\";",
        "pub struct A;\nfn f(b: u8) -> u8 { b.b::<B>() }",
        "use camgen::b::B;\npub struct A;",
    ] {
        assert_eq!(found(&[("a.rs", a), ("b.rs", b)]), Vec::<String>::new(), "{a}");
    }
    let parent = "mod child;\npub use child::Child;\nuse child::help;\npub struct Parent;\nfn f() { help(); }";
    let of_child =
        |child: &str| found(&[("p/mod.rs", parent), ("p/child.rs", child), ("q.rs", "use crate::p::Child;")]);
    assert_eq!(of_child("use super::Parent;\npub fn help() {}\npub struct Child;"), Vec::<String>::new());
    // The parent needs a file that needs the child, which needs the parent.
    let around = |child: &str| {
        found(&[
            ("p/mod.rs", "mod child;\nuse crate::q::Q;\npub struct Parent;\npub use child::Child;"),
            ("p/child.rs", child),
            ("q.rs", "use crate::p::Child;\npub struct Q;"),
        ])
    };
    assert_eq!(around("use super::Parent;\npub struct Child;"), ["p/child.rs p/mod.rs q.rs"]);
    assert_eq!(around("use super::Q;\npub struct Child;"), ["p/child.rs q.rs"]);
    // A name that is handed on ties to where it is defined.
    let handed = found(&[
        ("p/mod.rs", "pub use child::Child;"),
        ("p/child.rs", "use crate::q::Q;\npub struct Child;"),
        ("q.rs", "use crate::p::Child;\npub struct Q;"),
    ]);
    assert_eq!(handed, ["p/child.rs q.rs"]);
}
