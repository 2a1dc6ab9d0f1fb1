//! The live page and its engine: the engine's files are the command line's, changes keep comments, and `--live` refuses what the page would
//! make otherwise.

use crate::common::program::{camgen_in, files};
use camgen::catalogue::catalogue;
use camgen::engine::{self, EngineRequest, Task, TextChange};
use camgen::machine::Machine;
use camgen::write::html::live::ENGINE;
use std::fs;

fn toml(name: &str) -> String {
    catalogue().embedded.iter().find(|file| file.name == name).expect("an embedded file").toml.to_owned()
}

fn set(key: &str, to: &str) -> TextChange {
    TextChange::Set { key: key.to_owned(), to: to.to_owned() }
}

fn in_folder(name: &str) -> tempfile::TempDir {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("own.toml"), toml(name)).expect("written");
    directory
}

#[test]
fn the_engine_makes_the_files_of_the_command_line() {
    for (name, command) in [("feeder", "make"), ("lever", "make"), ("conjugate", "make"), ("dpi", "rotary")] {
        let formats = ["dxf", "svg", "step", "csv", "json", "html"];
        let words = [command, "own.toml", "--name", "own", "--quiet", "--format", "dxf,svg,step,csv,json,html"];
        let run = camgen_in(in_folder(name), &words);
        assert_eq!(run.code, 0, "{name}: {}", run.err);
        let request = EngineRequest {
            name: "own".into(),
            toml: toml(name),
            command: command.into(),
            formats: formats.map(str::to_owned).to_vec(),
            ..EngineRequest::default()
        };
        let answer = engine::answer(&request);
        assert_eq!(answer.found["passed"], true, "{name}");
        let written = files(&run.directory.path().join("output"));
        assert_eq!(answer.files.len(), written.len(), "{name}: {written:?}");
        for file in &answer.files {
            let expected = fs::read(run.directory.path().join("output").join(&file.name)).expect(&file.name);
            assert!(expected == file.bytes, "{name}: {}", file.name);
        }
    }
}

#[test]
fn a_changed_text_is_the_machine_with_overrides() {
    let mut tried = 0;
    for embedded in &catalogue().embedded {
        let Ok((machine, _)) = Machine::load(embedded.name, &[]) else { continue };
        for input in machine.inputs(machine.body()) {
            if !input.typed.ends_with(" mm") || input.typed.starts_with('Ø') || input.typed.starts_with('0') {
                continue;
            }
            let to = "11 mm";
            let by_override = Machine::load(embedded.name, &[format!("{}={to}", input.key)]);
            let text = engine::changed_text(embedded.toml, &[set(&input.key, to)]).expect("changed");
            let by_text = Machine::from_toml("own.toml", &text, &[]);
            let inputs = |machine: &Machine| machine.inputs(machine.body());
            match (by_override, by_text) {
                (Ok((one, _)), Ok(two)) => assert_eq!(inputs(&one), inputs(&two), "{} {}", embedded.name, input.key),
                (Err(_), Err(_)) => {}
                (one, two) => panic!("{} {}: {one:?} {two:?}", embedded.name, input.key),
            }
            tried += 1;
        }
    }
    assert!(tried > 30, "{tried}");
}

#[test]
fn every_design_of_the_gallery_can_be_made() {
    let answer = engine::answer(&EngineRequest { task: Task::Designs, ..EngineRequest::default() });
    let designs = answer.found["designs"].as_array().expect("a list");
    assert!(designs.len() > 10, "{}", designs.len());
    for design in designs {
        assert!(design["commands"].as_array().is_some_and(|commands| !commands.is_empty()), "{}", design["name"]);
    }
}

#[test]
fn a_fault_names_its_key_and_a_failed_check_what_would_pass() {
    let request = EngineRequest { name: "own".into(), toml: toml("feeder"), ..EngineRequest::default() };
    let changes = vec![set("cam.thickness", "-3 mm")];
    let answer = engine::answer(&EngineRequest { changes, ..request.clone() });
    assert_eq!(answer.found["faults"][0]["key"], "cam.thickness", "{:?}", answer.found);
    assert!(answer.found["toml"].as_str().is_some_and(|toml| toml.contains("\"-3 mm\"")));

    let changes = vec![set("cam.base_radius", "40 mm"), set("limits.pressure_angle", "20 deg")];
    let failed =
        engine::answer(&EngineRequest { changes: changes.clone(), formats: vec!["dxf".into()], ..request.clone() });
    assert_eq!(failed.found["passed"], false);
    assert!(failed.files.is_empty(), "nothing of a cam that breaks a limit");
    let remedies = failed.found["remedies"]["pressure_angle"][0].clone();
    let remedy: Vec<TextChange> = serde_json::from_value(remedies).expect("changes");
    let changes = changes.into_iter().chain(remedy).collect();
    assert_eq!(engine::answer(&EngineRequest { changes, ..request }).found["passed"], true);
}

#[test]
fn bytes_that_are_no_request_are_refused() {
    for bytes in [&b""[..], b"{", b"3", b"{\"toml\": 3}", b"{\"unknown\": 1}", b"\xff"] {
        let answer = engine::answer_bytes(bytes);
        let length = u32::from_le_bytes(answer[..4].try_into().expect("four bytes")) as usize;
        let found: serde_json::Value = serde_json::from_slice(&answer[4..4 + length]).expect("JSON");
        assert!(found["faults"][0]["message"].as_str().is_some_and(|why| why.starts_with("not a request")), "{found}");
    }
}

#[test]
fn a_text_names_no_file() {
    let text = toml("feeder").replace("[motion]\n", "[motion]\ntable = \"Cargo.toml\"\n");
    let answer = engine::answer(&EngineRequest { name: "own".into(), toml: text.clone(), ..EngineRequest::default() });
    let faults = answer.found["faults"].to_string();
    assert!(!faults.contains("[package]") && !faults.is_empty(), "{faults}");
}

/// A rise and a return of 20 mm, by 3-4-5.
fn lift_table() -> String {
    let rise = |x: f64| x.powi(3) * (10.0 - 15.0 * x + 6.0 * x * x);
    let lift = |at: f64| 20.0 * if at < 150.0 { rise(at / 150.0) } else { rise((360.0 - at) / 210.0) };
    let rows = (0..360).map(|at| format!("{at};{:.9}\n", lift(f64::from(at))));
    std::iter::once("deg;mm\n".to_owned()).chain(rows).collect()
}

fn with_table() -> String {
    let text = toml("feeder");
    let (head, rest) = text.split_once("[motion]").expect("a motion");
    let follower = rest.find("[follower").expect("a follower");
    format!("{head}[motion]\nrpm = 120\nstart = \"0 mm\"\ntable = \"lift.csv\"\n\n{}", &rest[follower..])
}

#[test]
fn a_request_brings_the_files_that_its_text_names() {
    let request = EngineRequest { name: "own".into(), toml: with_table(), ..EngineRequest::default() };
    let files = [("lift.csv".to_owned(), lift_table())].into();
    let answer = engine::answer(&EngineRequest { files, ..request.clone() });
    assert_eq!(answer.found["passed"], true, "{:?}", answer.found.get("faults"));
    let without = engine::answer(&request);
    let why = without.found["faults"][0]["message"].as_str().unwrap_or_default();
    assert!(why.contains("`motion.table`: there is no file `lift.csv` here"), "{why}");
}

#[test]
fn a_live_report_has_the_files_that_its_design_names() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("own.toml"), with_table()).expect("written");
    fs::write(directory.path().join("lift.csv"), lift_table()).expect("written");
    let run = camgen_in(directory, &["make", "own.toml", "--format", "html", "--live", "--name", "own", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let page = fs::read_to_string(run.directory.path().join("output/own.html")).expect("a page");
    assert!(page.contains("\"files\":{\"lift.csv\":\"deg;mm\\n0;0.000000000"));
}

#[test]
fn a_live_report_is_one_file_with_its_engine() {
    let words =
        ["make", "own.toml", "--format", "html", "--live", "--name", "own", "--set", "cam.thickness=17 mm", "--quiet"];
    let run = camgen_in(in_folder("feeder"), &words);
    assert_eq!(run.code, 0, "{}", run.err);
    let page = fs::read_to_string(run.directory.path().join("output/own.html")).expect("a page");
    assert!(page.len() < 3_000_000 && page.len() > ENGINE.len(), "{}", page.len());
    // The override is in the text of the page.
    assert!(page.contains("thickness = \\\"17 mm\\\"") && !page.contains("{{"));
    let plain = camgen_in(run.directory, &["make", "own.toml", "--format", "html", "--name", "plain", "--quiet"]);
    let plain = fs::read_to_string(plain.directory.path().join("output/plain.html")).expect("a page");
    assert!(plain.len() < 1_000_000 && !plain.contains("WebAssembly"), "the plain report has no engine");
}

#[test]
fn what_the_page_would_make_otherwise_is_refused() {
    for words in [
        &["--format", "dxf", "--live"][..],
        &["--format", "html", "--live", "--side", "inside"],
        &["--format", "html", "--live", "--outline", "spline"],
        &["--format", "html", "--live", "--cutter-diameter", "8mm"],
        &["--format", "html", "--live", "--accuracy", "fine"],
        &["--format", "html", "--live", "--start", "20deg"],
        &["--format", "html", "--live", "--dxf-version", "r12"],
        &["--format", "html", "--live", "--free", "offset"],
    ] {
        let run = camgen_in(in_folder("feeder"), &[&["make", "own.toml"], words].concat());
        assert_eq!(run.code, 2, "{words:?}: {}", run.out);
        assert!(run.err.contains("--live"), "{words:?}: {}", run.err);
        assert!(!run.directory.path().join("output").exists(), "{words:?}");
    }
}

#[test]
fn serve_prints_its_address_and_ends() {
    let run = camgen_in(in_folder("feeder"), &["serve", "own.toml", "--for", "0"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.starts_with("http://127.0.0.1:") && run.out.trim().len() > 60, "{}", run.out);
    let other = camgen_in(run.directory, &["serve", "own.toml", "--for", "0"]);
    let token = |text: &str| text.split("token=").nth(1).map(str::to_owned);
    assert!(token(&run.out).is_some() && token(&run.out) != token(&other.out), "a token for each run");
    let two = camgen_in(other.directory, &["serve", "own.toml", "groove", "--for", "0"]);
    assert_eq!(two.code, 0, "{}", two.err);
    let same = camgen_in(two.directory, &["serve", "own.toml", "./own.toml", "--for", "0"]);
    assert_eq!(same.code, 2, "{}", same.out);
    assert!(same.err.contains("two designs are called `own`"), "{}", same.err);
    let missing = camgen_in(same.directory, &["serve", "missing.toml", "--for", "0"]);
    assert_eq!(missing.code, 2, "{}", missing.out);
}

#[test]
fn a_disc_that_fails_is_named() {
    let toml = toml("conjugate").replace("radius = \"18 mm\"", "radius = \"45 mm\"");
    let request = EngineRequest { name: "own".into(), toml: toml.clone(), page: Some(24), ..EngineRequest::default() };
    let answer = engine::answer(&request).found;
    assert_eq!((&answer["passed"], &answer["cam"]["passed"]), (&false.into(), &true.into()));
    let [counter] = answer["others"].as_array().expect("a list").as_slice() else { panic!("{}", answer["others"]) };
    let failed: Vec<&str> =
        counter["checks"].as_array().expect("a list").iter().filter_map(|check| check["check"].as_str()).collect();
    assert_eq!((&counter["name"], failed.is_empty()), (&"counter".into(), false));
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("own.toml"), toml).expect("written");
    let run = camgen_in(directory, &["make", "own.toml", "--quiet"]);
    assert_eq!(run.code, 1, "{}", run.err);
    for check in failed {
        assert!(run.err.contains(&format!("the counter disc fails {check}: ")), "{}", run.err);
    }
}
