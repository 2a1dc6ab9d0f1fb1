//! README.md and the book in docs/: each command in them runs, and what they show of the output of a command, and of the lists in
//! the source, is what is printed and listed now.
//!
//! How a page is written is described in docs/developing.md.

mod flags;
mod lists;
mod page;
mod runs;

use crate::common::stored::assert_stored;
use page::{Page, Part};
use rayon::prelude::*;
use runs::{Scope, as_printed, walk};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Most lines of the README: one page.
const LONGEST_README: usize = 150;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Pages that the summary of the book does not name in the way of mdBook.
const OTHERS: [&str; 3] = ["README.md", "ARCHITECTURE.md", "docs/SUMMARY.md"];

/// The README first, and every page of the book.
fn pages() -> Vec<Page> {
    let summary = fs::read_to_string(root().join("docs/SUMMARY.md")).expect("a summary");
    let linked = links(&summary).into_iter().map(|link| Path::new("docs").join(link));
    OTHERS.iter().map(PathBuf::from).chain(linked).map(|name| Page::read(root(), &name)).collect()
}

/// A file that a page shows.
pub(crate) fn example(name: &str) -> String {
    let pages = pages();
    let found = pages.iter().flat_map(Page::files).find(|(file, _)| *file == name);
    found.unwrap_or_else(|| panic!("no page shows {name}")).1
}

/// What links lead to: the text in brackets behind each `](`, without pictures and addresses of the web.
fn links(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.contains("://")).collect()
}

/// Walks all pages, each in a directory of its own which holds the files that the pages show. Returns what the pages should be, and
/// the columns of all tables that were written.
fn walk_all(scope: Scope) -> (Vec<(String, String)>, BTreeSet<String>) {
    let pages = pages();
    let walked: Vec<_> = pages
        .par_iter()
        .map(|page| {
            let directory = tempfile::tempdir().expect("a directory");
            for (file, text) in pages.iter().flat_map(Page::files).chain(page.files()) {
                fs::write(directory.path().join(file), text).expect("written");
            }
            (page, walk(page, scope, directory.path()), runs::columns(directory.path()))
        })
        .collect();
    let faults: Vec<&str> = walked.iter().flat_map(|(_, walked, _)| &walked.faults).map(String::as_str).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
    let columns = walked.iter().flat_map(|(.., columns)| columns).cloned().collect();
    (walked.into_iter().map(|(page, walked, _)| (page.name.clone(), walked.text)).collect(), columns)
}

/// Each command runs with exit code 0, or with the code that its comment names; and files.md describes each column that is written.
#[test]
fn every_command_of_the_readme_and_the_book_runs() {
    let (_, columns) = walk_all(Scope::Everything);
    let described = fs::read_to_string(root().join("docs/files.md")).expect("a page");
    let lacking: Vec<&String> = columns.iter().filter(|column| !described.contains(&format!("`{column}`"))).collect();
    assert!(columns.len() > 100 && lacking.is_empty(), "not described in docs/files.md: {lacking:?}");
}

/// Each line that a page shows of what a command prints is printed, up to where the page leaves something out, and each list is that
/// of the source; `tests/run --renew` puts in those of now.
#[test]
fn what_the_readme_shows_is_what_is_printed() {
    for (name, text) in walk_all(Scope::Shown).0 {
        assert_stored(&name, &text);
    }
}

#[test]
fn the_readme_is_one_page_and_every_link_leads_to_a_file() {
    let pages = pages();
    let lines = pages[0].text.lines().count();
    assert!(lines <= LONGEST_README, "README.md has {lines} lines");
    for page in &pages {
        let folder = root().join(&page.name).parent().expect("a folder").to_owned();
        for link in page.parts.iter().flat_map(Part::links) {
            let (file, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let target = if file.is_empty() { root().join(&page.name) } else { folder.join(file) };
            assert!(target.exists(), "{}: no file {link}", page.name);
            let text = if anchor.is_empty() { String::new() } else { fs::read_to_string(&target).expect("a page") };
            let anchors: Vec<String> = text.lines().filter_map(page::anchor).collect();
            assert!(anchor.is_empty() || anchors.iter().any(|own| own == anchor), "{}: no heading {link}", page.name);
        }
    }
}

/// Every entry of a list of the source that a page describes by hand is on it.
#[test]
fn the_book_names_every_format_column_and_follower() {
    let text = |page: &str| fs::read_to_string(root().join("docs").join(page)).expect("a page");
    let (files, followers) = (text("files.md"), text("followers.md"));
    for format in camgen::tool_files::formats_by_name() {
        assert!(files.contains(&format!("`{}`", format.name)), "docs/files.md lacks the format {}", format.name);
    }
    for (column, _) in camgen::table::COLUMNS {
        assert!(files.contains(&format!("`{column}`")), "docs/files.md lacks the column {column}");
    }
    for follower in camgen::follower::FOLLOWERS {
        let path = follower.section.path;
        assert!(followers.contains(&format!("[{path}]")), "docs/followers.md lacks {path}");
    }
}

#[test]
fn a_shown_line_follows_what_is_printed() {
    let printed = "cam  radius 70 mm, lift 8 mm, area 5 mm²\n  pass  wall  3 mm\n";
    assert_eq!(as_printed("    pass  wall  3 mm", printed), "    pass  wall  3 mm");
    assert_eq!(as_printed("      pass  wall  2 mm", printed), "      pass  wall  3 mm");
    assert_eq!(as_printed("    cam  radius 69 mm, lift 8 mm, …", printed), "    cam  radius 70 mm, lift 8 mm, …");
    assert_eq!(as_printed("    …", printed), "    …");
}
