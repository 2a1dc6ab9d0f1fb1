use super::*;
use crate::write::interrupted::COMMIT;
use crate::write::known::{RECORD, file_digest};
use std::fs;

fn output(name: &str, text: &str) -> Output {
    Output { name: name.into(), bytes: text.into() }
}

fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(directory)
        .expect("a directory")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).expect("a file")
}

fn staged(path: &Path, outputs: &[Output]) -> StagedFiles {
    stage(OutputDirectory::open(path).expect("opened").directory, outputs).expect("staged")
}

#[test]
fn writes_all_and_replaces() {
    let directory = tempfile::tempdir().expect("a directory");
    let inner = directory.path().join("a/b");
    write_all(&inner, &[output("x", "1"), output("y", "2")]).expect("written");
    write_all(&inner, &[output("x", "3")]).expect("replaced");
    assert_eq!((text(&inner.join("x")), text(&inner.join("y"))), ("3".into(), "2".into()));
    assert_eq!(names(&inner), ["x", "y"]);
}

#[test]
fn a_failure_leaves_every_file_as_it_was_and_no_directory() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    write_all(path, &[output("x", "old")]).expect("written");
    fs::create_dir(path.join("y")).expect("in the way");
    let error = write_all(path, &[output("x", "new"), output("y", "2")]).expect_err("y is a directory");
    assert!(error.to_string().contains("there is a directory of that name"), "{error}");
    assert_eq!((text(&path.join("x")), names(path)), ("old".into(), vec!["x".into(), "y".into()]));
    for name in ["", ".", "..", "../z", "a/b", "a\\b", "\0"] {
        assert!(write_all(&path.join("made/for/it"), &[output(name, "")]).is_err(), "{name:?}");
        assert_eq!(names(path), ["x", "y"], "{name:?}");
    }
}

#[test]
fn a_file_in_place_of_the_directory_is_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("out");
    fs::write(&file, "x").expect("written");
    assert!(matches!(write_all(&file, &[output("x", "1")]), Err(FilesError::Directory { .. })));
}

/// Files that are not committed leave nothing.
#[test]
fn staged_files_are_gone_when_they_are_dropped() {
    let directory = tempfile::tempdir().expect("a directory");
    let inner = directory.path().join("inner");
    drop(staged(&inner, &[output("x", "1")]));
    assert_eq!(names(directory.path()), Vec::<String>::new());
}

/// Two files and their record.
fn set(text: &str) -> Vec<Output> {
    let digest = file_digest(text.as_bytes());
    let record = format!(r#"{{"files": {{"x.dxf": "{digest}", "y.dxf": "{digest}"}}, "inputs": {{}}}}"#);
    vec![output("x.dxf", text), output("y.dxf", text), output(RECORD, &record)]
}

/// A run that ends like one that is killed: nothing of it is removed, and its lock is gone with its handle.
fn killed(mut run: StagedFiles) {
    run.recorded = Some(COMMIT.into());
}

/// A set whose record is in place, and after how many renames its run was killed.
fn interrupted_set(path: &Path, outputs: &[Output], renames: usize) {
    let mut run = staged(path, outputs);
    run.record().expect("recorded");
    for entry in run.entries.iter().take(renames) {
        run.directory.rename(&entry.staged, &entry.target).expect("renamed");
    }
    killed(run);
}

fn opened(path: &Path) -> OutputDirectory {
    OutputDirectory::open(path).expect("opened")
}

/// A run that was interrupted: before the record of its set was in place, and after each of its renames.
#[test]
fn the_next_run_finishes_or_discards() {
    let wanted: [&[&str]; 5] = [&[], &["x.dxf", "y.dxf", RECORD], &["y.dxf", RECORD], &[RECORD], &[]];
    for (cut, wanted) in wanted.into_iter().enumerate() {
        for before in [Some("old"), None] {
            let directory = tempfile::tempdir().expect("a directory");
            let path = directory.path();
            if let Some(before) = before {
                write_all(path, &set(before)).expect("written");
            }
            if cut == 0 {
                killed(staged(path, &set("new")));
            } else {
                interrupted_set(path, &set("new"), cut - 1);
            }
            let found = opened(path);
            assert_eq!(
                (found.finished.as_slice(), found.left()),
                (&wanted.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>()[..], vec![]),
                "{cut}"
            );
            drop(found);
            if cut == 0 && before.is_none() {
                assert_eq!(names(path), Vec::<String>::new());
                continue;
            }
            let now = if cut == 0 { "old" } else { "new" };
            assert_eq!((text(&path.join("x.dxf")), text(&path.join("y.dxf"))), (now.into(), now.into()), "{cut}");
            assert_eq!(names(path), [RECORD, "x.dxf", "y.dxf"], "{cut}");
        }
    }
}

/// A record that is not one of the user's own sets stays, is reported, and does not block a run.
#[test]
fn an_invalid_record_is_told_and_left() {
    for record in
        ["", "[", "{}", r#"[{"staged": "x", "target": "y"}]"#, r#"[{"staged": ".camgen-new-1-0", "target": "../y"}]"#]
    {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        fs::write(path.join(COMMIT), record).expect("written");
        let left = opened(path).left();
        assert!(left.len() == 1 && left[0].contains("is not a record of camgen; remove it"), "{record}: {left:?}");
        write_all(path, &set("1")).expect("written");
        assert_eq!(
            (names(path), text(&path.join(COMMIT))),
            (vec![COMMIT.into(), RECORD.into(), "x.dxf".into(), "y.dxf".into()], record.into())
        );
    }
}

/// A record that somebody put there, with a file that is camgen's own, one that is not, or with other bytes than its record says.
#[test]
fn a_planted_record_touches_nothing() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    write_all(path, &set("old")).expect("written");
    fs::write(path.join("thesis"), "mine").expect("written");
    let stamp = |name: &str| match opened(path).directory.state_of(name).expect("a state") {
        NameState::File(owned) => owned.stamp().clone(),
        other => panic!("{other:?}"),
    };
    let entry = |number: usize, target: &str, replaces| StagedFile {
        staged: format!(".camgen-new-1-{number}"),
        target: target.into(),
        replaces,
    };
    let thesis = stamp("thesis");
    let told = |entries: &[StagedFile], files: &[&str], word: &str| {
        for (number, bytes) in files.iter().enumerate() {
            fs::write(path.join(format!(".camgen-new-1-{number}")), bytes).expect("written");
        }
        fs::write(path.join(COMMIT), serde_json::to_vec(entries).expect("a record")).expect("written");
        let found = opened(path);
        let left = found.left();
        assert!(left.len() == 1 && left[0].contains(word), "{word}: {left:?}");
        assert!(found.finished.is_empty() && !left[0].contains(char::is_control), "{left:?}");
        assert_eq!((text(&path.join("thesis")), text(&path.join("x.dxf"))), ("mine".into(), "old".into()));
        fs::remove_file(path.join(COMMIT)).expect("removed");
    };
    let digest = file_digest(b"evil");
    let knowing =
        format!(r#"{{"files": {{"thesis": "{digest}", "x.dxf": "{digest}", "y.dxf": "{digest}"}}, "inputs": {{}}}}"#);
    told(&[entry(0, "thesis", Some(thesis.clone()))], &["evil"], "it has no `.camgen.json`");
    told(&[entry(0, "a\npass  b", None)], &["evil"], "it has no");
    let own = Some(stamp(RECORD));
    told(
        &[entry(0, "thesis", Some(thesis)), entry(1, RECORD, own.clone())],
        &["evil", &knowing],
        "was not written by camgen",
    );
    told(
        &[entry(0, "x.dxf", Some(stamp("x.dxf"))), entry(1, RECORD, own.clone())],
        &["other", &knowing],
        "is not as its own",
    );
    told(&[entry(0, "new\npass  x", None), entry(1, RECORD, own)], &["evil", &knowing], "is not as its own");
}

/// Leftovers of runs are removed, other things of similar names are not, and none of them is in the way.
#[test]
fn only_leftovers_of_runs_are_removed() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    let own = format!(".camgen-new-{}-0", std::process::id());
    let others = [
        ".camgen-new-",
        ".camgen-new-1",
        ".camgen-new-1-x",
        ".camgen-new-notes.txt",
        ".camgen-commit-new-x",
        ".camgen-commits",
    ];
    for name in others.iter().chain(&[".camgen-new-1-0", ".camgen-new-2-17", ".camgen-commit-new-3"]) {
        fs::write(path.join(name), "left").expect("written");
    }
    fs::create_dir(path.join(&own)).expect("a directory");
    fs::create_dir(path.join(COMMIT)).expect("a directory");
    write_all(path, &set("1")).expect("written");
    let mut wanted: Vec<String> = others.iter().map(|name| (*name).to_owned()).collect();
    wanted.extend([own, COMMIT.into(), RECORD.into(), "x.dxf".into(), "y.dxf".into()]);
    wanted.sort();
    assert_eq!(names(path), wanted);
}

#[cfg(unix)]
#[test]
fn a_file_keeps_who_may_use_it_and_a_link_is_not_followed() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    let mode = |name: &str| fs::metadata(path.join(name)).expect("a file").permissions().mode() & 0o777;
    fs::write(path.join("as new"), "").expect("written");
    write_all(path, &[output("x", "1")]).expect("written");
    assert_eq!(mode("x"), mode("as new"));
    fs::set_permissions(path.join("x"), fs::Permissions::from_mode(0o640)).expect("set");
    write_all(path, &[output("x", "2")]).expect("replaced");
    assert_eq!((mode("x"), text(&path.join("x"))), (0o640, "2".into()));
    symlink("x", path.join("link")).expect("linked");
    let error = write_all(path, &[output("link", "3")]).expect_err("a link");
    assert!(error.to_string().contains("symbolic link"), "{error}");
    assert_eq!(text(&path.join("x")), "2");
}

/// The files of a run are in one directory, whatever its name is by then.
#[cfg(unix)]
#[test]
fn a_directory_that_is_moved_is_reported() {
    let directory = tempfile::tempdir().expect("a directory");
    let (path, away) = (directory.path().join("o"), directory.path().join("away"));
    let run = staged(&path, &[output("x", "1")]);
    fs::rename(&path, &away).expect("moved");
    fs::create_dir(&path).expect("another");
    assert!(matches!(run.commit(), Err(FilesError::Moved(_))));
    assert_eq!((names(&path), names(&away)), (vec![], vec![]));
}

#[test]
fn two_runs_write_one_after_the_other() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    let set = |run: usize| ["x", "y", "z"].map(|name| output(name, &format!("{run}")));
    std::thread::scope(|scope| {
        for run in 0..4 {
            scope.spawn(move || (0..8).for_each(|_| write_all(path, &set(run)).expect("written")));
        }
        let torn = |_| {
            let all: Vec<String> =
                ["x", "y", "z"].iter().filter_map(|name| fs::read_to_string(path.join(name)).ok()).collect();
            all.iter().any(|text| text.len() != 1)
        };
        assert!(!(0..2000).any(torn), "a reader finds a whole file");
    });
    let [x, y, z] = ["x", "y", "z"].map(|name| text(&path.join(name)));
    assert!(x == y && y == z, "{x} {y} {z}");
    assert_eq!(names(path), ["x", "y", "z"]);
}

/// A file that was edited after a run was interrupted is not replaced when that run is finished; a newer set takes its place.
#[test]
fn an_edit_after_a_cut_is_kept() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    let begin = || {
        write_all(path, &set("old")).expect("written");
        interrupted_set(path, &set("new"), 0);
        fs::write(path.join("x.dxf"), "an edit").expect("written");
        let found = opened(path);
        assert!(found.left()[0].contains("`x.dxf` was not written by camgen, or was changed"), "{:?}", found.left());
        assert!(found.finished.is_empty() && text(&path.join("x.dxf")) == "an edit");
        found
    };
    drop(begin());
    fs::rename(path.join("x.dxf"), path.join("mine")).expect("moved away");
    assert_eq!(opened(path).finished, ["x.dxf", "y.dxf", RECORD]);
    assert_eq!((text(&path.join("x.dxf")), text(&path.join("mine"))), ("new".into(), "an edit".into()));

    let OutputDirectory { directory, left, .. } = begin();
    stage(directory, &set("newest")).expect("staged").in_place_of(left).commit().expect("written");
    assert_eq!(
        (names(path), text(&path.join("x.dxf"))),
        (vec![RECORD.into(), "mine".into(), "x.dxf".into(), "y.dxf".into()], "newest".into())
    );
}
