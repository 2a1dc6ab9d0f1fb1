use super::*;
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

fn staged(path: &Path, outputs: &[Output]) -> Staged {
    stage(Place::open(path).expect("opened").directory, outputs).expect("staged")
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
    assert!(error.to_string().contains("in the way"), "{error}");
    assert_eq!((text(&path.join("x")), names(path)), ("old".into(), vec!["x".into(), "y".into()]));
    for name in ["", ".", "..", "../z", "a/b", "a\\b", "\0"] {
        assert!(write_all(&path.join("made/for/it"), &[output(name, "")]).is_err(), "{name:?}");
        assert_eq!(names(path), ["x", "y"], "{name:?}");
    }
}

#[test]
fn a_file_in_place_of_the_directory_is_told() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("out");
    fs::write(&file, "x").expect("written");
    assert!(matches!(write_all(&file, &[output("x", "1")]), Err(FilesError::Directory { .. })));
}

/// What is not committed was never there.
#[test]
fn staged_files_are_gone_when_they_are_dropped() {
    let directory = tempfile::tempdir().expect("a directory");
    let inner = directory.path().join("inner");
    drop(staged(&inner, &[output("x", "1")]));
    assert_eq!(names(directory.path()), Vec::<String>::new());
}

/// A run that was cut off: before the record of its set stood, and after each of its renames.
#[test]
fn the_next_run_finishes_or_discards() {
    for cut in 0..=3 {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        write_all(path, &[output("x", "old"), output("y", "old")]).expect("written");
        let mut run = staged(path, &[output("x", "new"), output("y", "new")]);
        if cut > 0 {
            run.record().expect("recorded");
        }
        for entry in run.entries.iter().take(usize::max(cut, 1) - 1) {
            run.directory.rename(&entry.staged, &entry.target).expect("renamed");
        }
        // Nothing is removed any more, as after a kill; the handle closes, and with it goes the lock.
        run.recorded = true;
        drop(run);
        let finished = Place::open(path).expect("opened").finished;
        let told: &[&str] = [&[][..], &["x", "y"], &["y"], &[]][cut];
        assert_eq!(finished, told, "{cut}");
        let now = if cut == 0 { "old" } else { "new" };
        assert_eq!((text(&path.join("x")), text(&path.join("y"))), (now.into(), now.into()), "{cut}");
        assert_eq!(names(path), ["x", "y"], "{cut}");
    }
}

#[test]
fn a_record_that_is_none_is_told_and_kept() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    for record in
        ["", "[", "{}", r#"[{"staged": "x", "target": "y"}]"#, r#"[{"staged": ".camgen-new-1", "target": "../y"}]"#]
    {
        fs::write(path.join(COMMIT), record).expect("written");
        let error = write_all(path, &[output("x", "1")]).expect_err(record);
        assert!(matches!(&error, FilesError::Left { .. }), "{error}");
        assert_eq!(names(path), [COMMIT], "{record}");
    }
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

/// The files of a run lie in one directory, whatever its name is by then.
#[cfg(unix)]
#[test]
fn a_directory_that_is_moved_is_told() {
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
        for run in 0..8 {
            scope.spawn(move || (0..16).for_each(|_| write_all(path, &set(run)).expect("written")));
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

/// What somebody made of a file after a run was cut off is not replaced when that run is finished.
#[test]
fn an_edit_after_a_cut_is_kept() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path();
    write_all(path, &[output("x", "old")]).expect("written");
    let mut run = staged(path, &[output("x", "new"), output("y", "new")]);
    run.record().expect("recorded");
    drop(run);
    fs::write(path.join("x"), "an edit").expect("written");
    let error = write_all(path, &[output("x", "newer")]).expect_err("an edit");
    assert!(error.to_string().contains("move it away"), "{error}");
    assert_eq!(text(&path.join("x")), "an edit");
    fs::rename(path.join("x"), path.join("mine")).expect("moved away");
    let finished = Place::open(path).expect("finished").finished;
    assert_eq!(finished, ["x", "y"]);
    assert_eq!((text(&path.join("x")), text(&path.join("mine"))), ("new".into(), "an edit".into()));
}
