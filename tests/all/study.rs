//! `camgen study`: every row is the design that the command line makes, however and by how many threads it is made.

use crate::common::program::{Run, camgen_in, camgen_on, number, report};
use assert_cmd::Command;
use camgen::report::sha256;
use camgen::study::{Journal, Study, StudyFiles};
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const SWEEP: &str = r#"
name = "sweep"
base = "feeder"
kind = "sweep"
columns = ["cam.base_radius_mm", "checks.pressure_angle.value", "checks.contact_stress.value"]
[[parameter]]
key = "follower.roller.radius"
from = "14 mm"
to = "16 mm"
steps = 3
[[parameter]]
key = "cam.base_radius"
values = ["20 mm", "1 mm", "40 mm"]
"#;

/// A directory with this study as study.toml.
fn with(text: &str) -> TempDir {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("study.toml"), text).expect("written");
    directory
}

#[track_caller]
fn ran(code: i32, text: &str, args: &[&str]) -> Run {
    let run = camgen_in(with(text), &[&["study", "study.toml"], args].concat());
    assert_eq!(run.code, code, "{}{}", run.out, run.err);
    run
}

/// Runs camgen in a directory that is kept.
fn ended_in(directory: &TempDir, args: &[&str]) -> (i32, String) {
    let run = Command::cargo_bin("camgen").expect("the program").current_dir(directory.path()).args(args).output();
    let run = run.expect("it runs");
    (run.status.code().expect("a code"), String::from_utf8_lossy(&[run.stdout, run.stderr].concat()).into_owned())
}

fn text_of(directory: &Path, name: &str) -> String {
    fs::read_to_string(directory.join("output").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The cells of a table without quotes.
fn rows(table: &str) -> Vec<Vec<String>> {
    table.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// The numbers of a column.
fn column(table: &str, name: &str) -> Vec<f64> {
    let all = rows(table);
    let at = all[0].iter().position(|own| own == name).unwrap_or_else(|| panic!("no {name} in {:?}", all[0]));
    all[1..].iter().map(|row| row[at].parse().unwrap_or(f64::NAN)).collect()
}

/// The number behind these words of a printed report, with all its bits, which `serde_json` reads to the last digit only.
fn printed(run: &Run, words: &[&str]) -> f64 {
    let rest = words.iter().fold(run.out.as_str(), |rest, word| {
        rest.split_once(word).unwrap_or_else(|| panic!("no {word} in {}", run.out)).1
    });
    let text = rest.trim_start().split([',', '\n', '}']).next().expect("a number");
    text.trim().parse().unwrap_or_else(|_| panic!("{text}"))
}

fn study(text: &str) -> Study {
    Study::from_toml("study.toml", text).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_row_has_the_figures_of_the_command_line() {
    let run = ran(0, SWEEP, &["--quiet"]);
    let table = text_of(run.directory.path(), "study.csv");
    let names = "row,set.follower.roller.radius_mm,set.cam.base_radius_mm,cam.base_radius_mm,checks.pressure_angle.value,checks.contact_stress.value,fault";
    assert_eq!(table.lines().next(), Some(names));
    let all = rows(&table);
    assert_eq!(all.len(), 1 + 9);
    for row in &all[1..] {
        let set = [format!("follower.roller.radius={}mm", row[1]), format!("cam.base_radius={}mm", row[2])];
        let args = ["make", "feeder", "--json", "--dry-run", "--set", &set[0], "--set", &set[1]];
        let made = camgen_in(tempfile::tempdir().expect("a directory"), &args);
        if made.code == 2 {
            assert!(row[3].is_empty() && !row.last().expect("a fault").is_empty(), "{row:?}");
            continue;
        }
        let figures = [
            printed(&made, &["\"cam\": {", "\"base_radius_mm\":"]),
            printed(&made, &["\"check\": \"pressure_angle\"", "\"value\":"]),
            printed(&made, &["\"check\": \"contact_stress\"", "\"value\":"]),
        ];
        let cells: Vec<f64> = row[3..6].iter().map(|cell| cell.parse().expect("a number")).collect();
        assert_eq!(figures[..], cells[..], "{row:?}");
    }
}

/// A figure of the outline needs the proof, and is then that of the command line as well.
#[test]
fn figures_of_the_outline_are_those_of_the_proof() {
    let text = SWEEP.replace("\"cam.base_radius_mm\"", "\"outline.arcs\", \"cam.area_mm2\", \"passed\"");
    let text = text.replace("\"1 mm\", ", "");
    let study = study(&text);
    assert!(study.proves());
    let line = String::from_utf8(study.rows(1, 2)).expect("text");
    let cells: Vec<&str> = line.trim_end().split(',').collect();
    let args = [
        "make",
        "feeder",
        "--json",
        "--dry-run",
        "--set",
        "follower.roller.radius=14mm",
        "--set",
        "cam.base_radius=40mm",
    ];
    let made = camgen_in(tempfile::tempdir().expect("a directory"), &args);
    let passed = made.code == 0;
    let (arcs, area) =
        (printed(&made, &["\"outline\": {", "\"arcs\":"]), printed(&made, &["\"cam\": {", "\"area_mm2\":"]));
    assert_eq!([cells[3], cells[4]].map(|cell| cell.parse::<f64>().expect("a number")), [arcs, area]);
    assert_eq!(cells[5], passed.to_string());
}

#[test]
fn the_bytes_do_not_depend_on_threads_or_stretches() {
    let bytes = |threads: &str| {
        let run = camgen_on(Some(threads), with(SWEEP), &["study", "study.toml", "--quiet"]);
        (text_of(run.directory.path(), "study.csv"), text_of(run.directory.path(), "study.json"))
    };
    assert_eq!(bytes("1"), bytes("3"));
    let study = study(SWEEP);
    let whole = study.rows(0, 9);
    let parts = [study.rows(0, 4), study.rows(4, 5), study.rows(5, 9)].concat();
    assert_eq!(whole, parts);
    assert_eq!(bytes("2").0, study.header() + &String::from_utf8(whole).expect("text"));
}

/// Makes the `output` of an interrupted run: the first `saved` bytes of a table, and unsaved bytes `after` them.
fn interrupted(table: &str, saved: usize, after: &[u8]) -> TempDir {
    let directory = with(SWEEP);
    let output = directory.path().join("output");
    fs::create_dir(&output).expect("made");
    let kept = &table[..saved];
    let rows = kept.lines().count().saturating_sub(1);
    let digest = study(SWEEP).digest().to_owned();
    let marker = serde_json::json!({"study": digest, "rows": rows, "bytes": saved, "sha256": sha256(kept.as_bytes())});
    fs::write(output.join("study.csv.part"), [kept.as_bytes(), after].concat()).expect("written");
    fs::write(output.join("study.csv.part.json"), marker.to_string()).expect("written");
    directory
}

/// The names in `output`.
fn outputs(run: &Run) -> Vec<String> {
    let entries = fs::read_dir(run.directory.path().join("output")).expect("a directory");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn an_interrupted_run_is_continued_with_the_same_bytes() {
    let whole = text_of(ran(0, SWEEP, &["--quiet"]).directory.path(), "study.csv");
    let ends: Vec<usize> = whole.match_indices('\n').map(|(at, _)| at + 1).collect();
    let forged = format!("4{}", &whole[ends[3] + 1..]);
    for saved in [0, ends[0], ends[4], whole.len()] {
        // Nothing, half a line, zeros as after a power failure, and rows not computed.
        for after in [b"".as_slice(), b"4,1", &[0; 30], forged.as_bytes()] {
            let run = camgen_in(interrupted(&whole, saved, after), &["study", "study.toml", "--quiet"]);
            assert_eq!(run.code, 0, "{}", run.err);
            assert_eq!(text_of(run.directory.path(), "study.csv"), whole, "{saved}");
            assert_eq!(outputs(&run), [".camgen.json", "study.csv", "study.json"]);
        }
    }
}

/// Rows are continued only if they are the saved ones.
#[test]
fn rows_that_were_changed_are_not_continued() {
    let whole = text_of(ran(0, SWEEP, &["--quiet"]).directory.path(), "study.csv");
    let part = |directory: &TempDir| directory.path().join("output/study.csv.part");
    for change in [whole.replacen(",true,", ",false,", 1).replacen('1', "7", 1), whole.replacen("\n4,", "\n5,", 1)] {
        assert_ne!(change, whole);
        let directory = interrupted(&whole, whole.len(), b"");
        fs::write(part(&directory), &change).expect("written");
        let run = camgen_in(directory, &["study", "study.toml", "--quiet"]);
        assert_eq!(run.code, 2, "{}", run.err);
        assert!(run.err.contains("was changed since camgen wrote it: give --restart"), "{}", run.err);
        assert_eq!(fs::read_to_string(part(&run.directory)).expect("a part"), change);
        let run = camgen_in(run.directory, &["study", "study.toml", "--quiet", "--restart"]);
        assert_eq!((run.code, text_of(run.directory.path(), "study.csv")), (0, whole.clone()), "{}", run.err);
    }
    // A record that states other rows than those of the bytes that it states.
    for rows in [0, 4, 8, 10, u64::MAX] {
        let directory = interrupted(&whole, whole.len(), b"");
        let path = part(&directory).with_extension("part.json");
        let record = fs::read_to_string(&path).expect("a record");
        fs::write(&path, record.replace("\"rows\":9", &format!("\"rows\":{rows}"))).expect("written");
        let run = camgen_in(directory, &["study", "study.toml", "--quiet"]);
        let told = format!("has 9 rows, but its record, which was changed, states {rows}: give --restart");
        assert!(run.code == 2 && run.err.contains(&told), "{}", run.err);
        let run = camgen_in(run.directory, &["study", "study.toml", "--quiet", "--restart"]);
        assert_eq!((run.code, text_of(run.directory.path(), "study.csv")), (0, whole.clone()), "{}", run.err);
    }
    // A part without its marker, and one with a marker that is none, is not camgen's.
    for marker in [None, Some("{\"study\": "), Some("mine")] {
        let directory = interrupted(&whole, whole.len(), b"");
        let path = part(&directory).with_extension("part.json");
        match marker {
            Some(text) => fs::write(&path, text).expect("written"),
            None => fs::remove_file(&path).expect("removed"),
        }
        for more in [&[][..], &["--restart", "--overwrite"]] {
            let (code, text) = ended_in(&directory, &[&["study", "study.toml", "--quiet"], more].concat());
            assert!(code == 2 && text.contains("was not written by camgen"), "{text}");
        }
        assert_eq!(fs::read_to_string(part(&directory)).expect("a part"), whole);
        assert_eq!(fs::read_to_string(&path).ok().as_deref(), marker);
    }
}

/// A user's file under a name of a study stays unchanged and is reported.
#[cfg(unix)]
#[test]
fn files_links_and_pipes_in_the_way_of_a_study_stay() {
    let names = ["study.csv", "study.json", "study.html", "study.csv.part", "study.csv.part.json"];
    for name in names {
        for kind in ["file", "link", "dangling", "pipe", "directory"] {
            let directory = with(SWEEP);
            let (output, victim) = (directory.path().join("output"), directory.path().join("victim"));
            fs::create_dir(&output).expect("made");
            fs::write(&victim, "mine\n").expect("written");
            let path = output.join(name);
            match kind {
                "file" => fs::write(&path, "mine\n").expect("written"),
                "link" => std::os::unix::fs::symlink(&victim, &path).expect("linked"),
                "dangling" => std::os::unix::fs::symlink(directory.path().join("none"), &path).expect("linked"),
                "pipe" => assert!(std::process::Command::new("mkfifo").arg(&path).status().expect("run").success()),
                _ => fs::create_dir(&path).expect("made"),
            }
            let before = fs::symlink_metadata(&path).expect("there").file_type();
            let (code, text) = ended_in(&directory, &["study", "study.toml", "--quiet", "--page", "--restart"]);
            assert!(code == 2 && text.contains(name), "{kind} {name}: {text}");
            assert_eq!(fs::read_to_string(&victim).expect("a file"), "mine\n", "{kind} {name}");
            assert_eq!(fs::symlink_metadata(&path).expect("there").file_type(), before, "{kind} {name}");
            assert!(!directory.path().join("none").exists(), "{kind} {name}");
            if kind == "file" {
                assert_eq!(fs::read_to_string(&path).expect("a file"), "mine\n", "{name}");
            }
        }
    }
}

/// A base, and a table set by a study, must be in the folder of the study or below it, or in a folder that the user allows.
#[test]
fn a_study_names_no_file_elsewhere() {
    let (directory, elsewhere) = (with(SWEEP), tempfile::tempdir().expect("a directory"));
    let secret = elsewhere.path().join("secret");
    fs::write(&secret, "root:x:secret:0\n").expect("written");
    fs::write(directory.path().join("own.toml"), include_str!("../../profiles/feeder.toml")).expect("written");
    let base = |name: &str| SWEEP.replace("base = \"feeder\"", &format!("base = {name:?}"));
    let path = secret.display().to_string();
    let table = base("own.toml").replace("kind =", &format!("set = [\"motion.table={path}\"]\nkind ="));
    for text in [base(&path), table] {
        fs::write(directory.path().join("study.toml"), text).expect("written");
        let (code, told) = ended_in(&directory, &["study", "study.toml", "--dry-run"]);
        assert_eq!(code, 2, "{told}");
        assert!(told.contains("lies outside of the folder") && told.contains("--allow-path"), "{told}");
        assert!(!told.contains("root:x"), "{told}");
    }
    fs::write(directory.path().join("study.toml"), base("own.toml")).expect("written");
    let (code, told) = ended_in(&directory, &["study", "study.toml", "--dry-run"]);
    assert_eq!(code, 0, "{told}");
}

/// The faults of a long study file take no more time than the reported ones.
#[test]
fn many_unknown_columns_are_refused_at_once() {
    let names = |begin: &str| (0..30_000).map(|i| format!("\"{begin}.f{i}\"")).collect::<Vec<_>>().join(", ");
    let text = SWEEP.replacen("columns = [", &format!("columns = [{}, ", names("cam")), 1);
    let begun = std::time::Instant::now();
    let run = ran(2, &text, &["--dry-run"]);
    assert!(run.err.contains("the report has no figure \"cam.f0\""), "{}", run.err);
    // Limit for a build without optimisation; before, an optimised build took 8 s.
    assert!(begun.elapsed().as_secs() < 20, "{:?}", begun.elapsed());
}

/// A study file with an odd name has files with plain names.
#[test]
fn a_study_file_with_an_odd_name_has_files_with_plain_names() {
    for (name, stem) in [(".camgen.toml", "camgen"), ("-a.toml", "a"), ("con.toml", "machine-con")] {
        let directory = with(SWEEP);
        fs::rename(directory.path().join("study.toml"), directory.path().join(name)).expect("renamed");
        let path = directory.path().join(name).display().to_string();
        let (code, told) = ended_in(&directory, &["study", &path, "--quiet"]);
        assert_eq!(code, 0, "{told}");
        assert!(directory.path().join("output").join(format!("{stem}.json")).exists(), "{name}");
    }
}

/// No other command writes files of the stem of a running study.
#[test]
fn a_stem_in_use_is_refused() {
    let directory = with(SWEEP);
    let study = study(SWEEP);
    let files = StudyFiles { page: false, parquet: false, overwrite: false, restart: false };
    let output = directory.path().join("output");
    let journal = Journal::open(&study, &output, "one", files).expect("opened");
    for args in [&["make", "feeder", "--name", "one"][..], &["study", "study.toml", "--name", "one"]] {
        let (code, told) = ended_in(&directory, args);
        assert!(code == 2 && told.contains("another run of camgen is writing"), "{told}");
    }
    let (code, told) = ended_in(&directory, &["make", "feeder", "--name", "two", "--format", "csv"]);
    assert_eq!(code, 0, "{told}");
    drop(journal);
    let (code, told) = ended_in(&directory, &["study", "study.toml", "--name", "one", "--quiet"]);
    assert_eq!(code, 0, "{told}");
}

#[test]
fn what_another_study_left_is_not_continued() {
    let directory = with(SWEEP);
    let output = directory.path().join("output");
    fs::create_dir(&output).expect("made");
    fs::write(output.join("study.csv.part"), "row,\n0,\n").expect("written");
    fs::write(output.join("study.csv.part.json"), "{\"study\": \"other\"}").expect("written");
    let run = camgen_in(directory, &["study", "study.toml"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("another study") && run.err.contains("--restart"), "{}", run.err);
    let run = camgen_in(run.directory, &["study", "study.toml", "--restart", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.err);
    // An unchanged table is replaced, a changed one is not.
    let run = camgen_in(run.directory, &["study", "study.toml", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.err);
    fs::write(run.directory.path().join("output/study.csv"), "mine\n").expect("written");
    let run = camgen_in(run.directory, &["study", "study.toml", "--quiet"]);
    assert!(run.code == 2 && run.err.contains("--overwrite"), "{}", run.err);
    assert_eq!(text_of(run.directory.path(), "study.csv"), "mine\n");
    let run = camgen_in(run.directory, &["study", "study.toml", "--quiet", "--overwrite"]);
    assert_eq!(run.code, 0, "{}", run.err);
}

const SCATTER: &str = r#"
name = "scatter"
base = "feeder"
kind = "monte-carlo"
rows = 1500
sampling = "random"
columns = ["cam.prime_radius_mm", "checks.contact_stress.value"]
[[parameter]]
key = "follower.roller.radius"
mean = "15 mm"
deviation = "0.003 mm"
[[parameter]]
key = "cam.base_radius"
mean = "60 mm"
deviation = "0.004 mm"
"#;

/// The prime radius is the sum of both radii: its deviation is the root of the sum of the squares, 5 µm, in closed form. The deviation of a
/// deviation of n numbers is 1/√(2n) of it; four times that is allowed.
#[test]
fn the_scatter_of_a_sum_is_that_of_linear_propagation() {
    for sampling in ["random", "latin-hypercube"] {
        let study = study(&SCATTER.replace("sampling = \"random\"", &format!("sampling = \"{sampling}\"")));
        let table = study.header() + &String::from_utf8(study.rows(0, 1500)).expect("text");
        let summary = study.summary(|| Ok(table.as_bytes())).expect("read");
        let prime = summary.columns.iter().find(|of| of.name == "cam.prime_radius_mm").expect("a column");
        let n = 1500_f64;
        assert!((prime.mean - 75.0).abs() < 4.0 * 0.005 / n.sqrt(), "{}", prime.mean);
        assert!((prime.deviation() / 0.005 - 1.0).abs() < 4.0 / (2.0 * n).sqrt(), "{}", prime.deviation());
        // A quantile against the normal distribution: 1.645 deviations, to four times its own scatter.
        let above = (prime.quantile(0.95) - 75.0) / 0.005;
        assert!((above - 1.645).abs() < 4.0 * (0.95 * 0.05_f64).sqrt() / 0.103 / n.sqrt() + 0.01, "{above}");
    }
}

/// Hertz: the stress of a line contact falls with the root of its width, so the deviation is half as large, relative, to first order.
#[test]
fn the_scatter_of_a_stress_is_that_of_its_derivative() {
    let text = SCATTER
        .replace("follower.roller.radius", "cam.thickness")
        .replace("\"0.003 mm\"", "\"0.015 mm\"")
        .replace("[[parameter]]\nkey = \"cam.base_radius\"\nmean = \"60 mm\"\ndeviation = \"0.004 mm\"\n", "");
    let study = study(&text);
    let table = study.header() + &String::from_utf8(study.rows(0, 1500)).expect("text");
    let summary = study.summary(|| Ok(table.as_bytes())).expect("read");
    let stress = summary.columns.iter().find(|of| of.name == "checks.contact_stress.value").expect("a column");
    let relative = stress.deviation() / stress.mean;
    assert!((relative / (0.5 * 0.001) - 1.0).abs() < 4.0 / 3000_f64.sqrt() + 1e-3, "{relative}");
}

#[test]
fn the_front_is_that_of_brute_force() {
    let run = camgen_in(tempfile::tempdir().expect("a directory"), &["study", "lever-pareto", "--quiet", "--page"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let table = text_of(run.directory.path(), "lever-pareto.csv");
    let (size, stress) = (column(&table, "cam.base_radius_mm"), column(&table, "checks.contact_stress.value"));
    let kept: Vec<bool> = table.lines().skip(1).map(|line| line.contains(",true,")).collect();
    let beats = |a: usize, b: usize| {
        kept[a] && size[a] <= size[b] && stress[a] <= stress[b] && (size[a] < size[b] || stress[a] < stress[b])
    };
    let all = 0..size.len();
    let front: Vec<&str> = table
        .lines()
        .skip(1)
        .enumerate()
        .filter(|(row, _)| kept[*row] && !all.clone().any(|other| beats(other, *row)))
        .map(|(_, line)| line)
        .collect();
    assert!(front.len() > 3 && front.len() < size.len());
    let own = text_of(run.directory.path(), "lever-pareto-front.csv");
    assert_eq!(own.lines().skip(1).collect::<Vec<_>>(), front);
    assert!(text_of(run.directory.path(), "lever-pareto.html").contains("Designs that no other beats"));
    let json: Value = serde_json::from_str(&text_of(run.directory.path(), "lever-pareto.json")).expect("JSON");
    assert_eq!(number(&json["front"]), f64::from(u32::try_from(front.len()).expect("few")));
}

#[test]
fn a_bad_study_file_is_refused_with_its_place() {
    let cases = [
        ("kind = \"sweep\"", "kind = \"swep\"", "did you mean \"sweep\""),
        ("base = \"feeder\"", "base = \"feedr\"", "did you mean `feeder`"),
        ("columns = [", "colums = [", "did you mean `columns`"),
        ("cam.base_radius_mm\"", "cam.base_radius\"", "\"cam.base_radius_mm\""),
        ("steps = 3", "", "give steps"),
        ("to = \"16 mm\"", "to = \"16 deg\"", "another unit"),
        ("to = \"16 mm\"", "to = \"14 mm\"", "must differ"),
        ("key = \"follower.roller.radius\"", "key = \"follower.roller.radios\"", "follower.roller.radius"),
        ("\"14 mm\"\nto = \"16 mm\"", "\"14 deg\"\nto = \"16 deg\"", "mm"),
        ("kind = \"sweep\"", "kind = \"sweep\"\nrows = 5", "every combination"),
        ("kind = \"sweep\"", "kind = \"monte-carlo\"", "rows = 1000"),
        ("kind = \"sweep\"", "kind = \"pareto\"", "at least two objectives"),
        ("kind = \"sweep\"", "kind = \"sweep\"\ncommand = \"mak\"", "did you mean \"make\""),
    ];
    for (right, wrong, told) in cases {
        assert!(SWEEP.contains(right), "{right}");
        let run = ran(2, &SWEEP.replacen(right, wrong, 1), &[]);
        assert!(run.err.contains(told), "{wrong}: {}", run.err);
        let placed = run.err.contains("study.toml:") || wrong.contains("feedr") || wrong.contains("colums");
        assert!(placed, "{wrong}: {}", run.err);
        assert!(!run.directory.path().join("output").exists(), "{wrong}");
    }
    let run = camgen_in(tempfile::tempdir().expect("a directory"), &["study", "lever-parito"]);
    assert!(run.code == 2 && run.err.contains("did you mean `lever-pareto`"), "{}", run.err);
}

/// A design that keeps no limit is no failure of the study; a study in which none keeps them ends with exit code 1.
/// Keys that fight are refused; `passed` is 1 or 0, and a limit holds at the number that was typed.
#[test]
fn keys_are_given_once_and_truths_have_a_size() {
    let second = "[[parameter]]\nkey = \"cam.base_radius\"\nvalues = [\"30 mm\"]\n";
    let twice = ran(2, &format!("{SWEEP}{second}"), &[]);
    assert!(twice.err.contains("cam.base_radius is another parameter already"), "{}", twice.err);
    let set = SWEEP.replace("kind =", "set = [\"cam.base_radius=50mm\"]\nkind =");
    assert!(ran(2, &set, &[]).err.contains("cam.base_radius is set for all designs already"));
    let limit = |column: &str, limit: &str| {
        let values = "values = [\"57 mm\", \"1 mm\"]";
        let base = SWEEP.replace("values = [\"20 mm\", \"1 mm\", \"40 mm\"]", values);
        format!("{base}[[constraint]]\ncolumn = \"{column}\"\n{limit}\n")
    };
    let feasible = |text: &str, code: i32| {
        let run = ran(code, text, &[]);
        rows(&text_of(run.directory.path(), "study.csv")).iter().filter(|row| row[row.len() - 2] == "true").count()
    };
    assert_eq!(feasible(&limit("passed", "at_least = 1"), 0), 3);
    assert_eq!(feasible(&limit("cam.base_radius_mm", "at_most = 57\nat_least = 57"), 0), 3);
    let word = ran(2, &limit("checks.pressure_angle.verdict", "at_least = 1"), &[]);
    assert!(word.err.contains("is a word and has no limits"), "{}", word.err);
    let parquet = ran(2, SWEEP, &["--parquet"]);
    assert!(
        parquet.err.contains("built without Parquet") && parquet.err.contains("--features parquet"),
        "{}",
        parquet.err
    );
}

/// A plate is balanced as its file says.
#[test]
fn a_plate_is_balanced_as_its_file_says() {
    let text = r#"
name = "plate"
base = "dpi"
kind = "sweep"
command = "translating"
columns = ["force.residual_max_n"]
[[parameter]]
key = "translating.balance"
values = ["braking", "level"]
"#;
    let run = ran(0, text, &[]);
    let left = column(&text_of(run.directory.path(), "study.csv"), "force.residual_max_n");
    assert!(left[0] < 20.0 && (left[1] - 3_389.722).abs() < 1.0, "{left:?}");
}

#[test]
fn exit_codes_tell_whether_a_design_keeps_the_limits() {
    let limit =
        |most: &str| format!("{SWEEP}[[constraint]]\ncolumn = \"checks.pressure_angle.value\"\nat_most = {most}\n");
    let run = ran(0, &limit("30"), &["--json"]);
    let json = report(&run);
    assert!(number(&json["feasible"]) > 0.0 && number(&json["feasible"]) < 9.0, "{json}");
    let run = ran(1, &limit("0.1"), &["--quiet"]);
    assert!(text_of(run.directory.path(), "study.csv").contains(",false,"));
}
