//! The live page and its engine: the engine's files are the command line's, changes keep comments, and `--live` refuses what the page would
//! make otherwise.

use crate::common::program::{camgen_in, files};
use camgen::catalogue::catalogue;
use camgen::engine::{self, EngineRequest, Task, TextChange};
use camgen::machine::Machine;
use camgen::units::{self, Dimension};
use camgen::write::html::live::ENGINE;
use std::collections::BTreeMap;
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
    assert!(page.len() < 3_100_000 && page.len() > ENGINE.len(), "{}", page.len());
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
    assert_eq!((&answer["passed"], &answer["cam"]["passed"]), (&false.into(), &false.into()));
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

/// The keys of a text and their values as a person reads them.
fn keys_of(text: &str) -> BTreeMap<String, String> {
    fn walk(path: &str, item: &toml_edit::Item, found: &mut BTreeMap<String, String>) {
        if let Some(table) = item.as_table_like() {
            let join = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
            table.iter().for_each(|(name, item)| walk(&join(name), item, found));
        } else if let Some(list) = item.as_array_of_tables() {
            for (index, table) in list.iter().enumerate() {
                walk(&format!("{path}[{index}]"), &toml_edit::Item::Table(table.clone()), found);
            }
        } else if let Some(text) = item.as_str() {
            found.insert(path.to_owned(), text.to_owned());
        } else {
            let mut value = item.as_value().expect("a value").clone();
            value.decor_mut().clear();
            // A list on one line.
            let plain = value.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            found.insert(path.to_owned(), plain.replace("[ ", "[").replace(", ]", "]").replace(" ]", "]"));
        }
    }
    let mut found = BTreeMap::new();
    walk("", text.parse::<toml_edit::DocumentMut>().expect("TOML").as_item(), &mut found);
    found
}

fn answer_to(toml: &str, command: &str) -> engine::EngineAnswer {
    let request =
        EngineRequest { name: "own".into(), toml: toml.into(), command: command.into(), ..EngineRequest::default() };
    engine::answer(&request)
}

/// The values in an answer for a page; `None` if no cam can be made.
fn values(answer: &engine::EngineAnswer) -> Option<BTreeMap<String, String>> {
    serde_json::from_value(answer.found.get("values")?.clone()).ok()
}

/// The values that a page shows for a text.
fn shown(toml: &str) -> BTreeMap<String, String> {
    let answer = answer_to(toml, "");
    values(&answer).unwrap_or_else(|| panic!("{toml}: {:?}", answer.found.get("faults")))
}

/// A number one hundredth larger, with its unit.
fn stepped(typed: &str) -> Option<String> {
    let typed = typed.trim_start_matches('Ø');
    let end = typed.find(|c: char| !c.is_ascii_digit() && !"+-.e".contains(c)).unwrap_or(typed.len());
    let (number, unit) = typed.split_at(end);
    number.parse::<f64>().ok().map(|number| format!("{}{unit}", 1.01 * number))
}

/// A page shows every value of a text, and a slightly larger value is written to the same key in the same unit.
fn assert_shown(name: &str, toml: &str, of_page: &BTreeMap<String, String>) -> usize {
    let of_file = keys_of(toml);
    for (key, value) in of_file.iter().filter(|(key, _)| *key != "cam.keyway") {
        assert_eq!(of_page.get(key), Some(value), "{name}: {key}");
        let Some(next) = stepped(value) else { continue };
        let text = engine::changed_text(toml, &[set(key, &next)]).expect("changed");
        let mut expected = of_file.clone();
        expected.insert(key.clone(), next);
        assert_eq!(keys_of(&text), expected, "{name}: {key}");
    }
    of_file.len()
}

#[test]
fn the_page_shows_every_value_of_every_design() {
    let answer = engine::answer(&EngineRequest { task: Task::Designs, ..EngineRequest::default() });
    let mut tried = 0;
    for design in answer.found["designs"].as_array().expect("a list") {
        let [name, text] = ["name", "toml"].map(|key| design[key].as_str().expect("text"));
        for command in design["commands"].as_array().expect("commands") {
            let answer = answer_to(text, command.as_str().expect("a command"));
            tried += assert_shown(name, text, &values(&answer).expect("values"));
        }
    }
    assert!(tried > 300, "{tried}");
}

/// Every radius that can be given by its diameter, on two designs.
#[test]
fn a_diameter_is_shown_as_it_is() {
    let length = |text: &str| units::parse(text, Dimension::Length).ok();
    let compensator = [set("compensator.preload", "500 N"), set("compensator.spring_rate", "20 N/mm")];
    for section in &catalogue().keys.sections {
        for (key, radius) in section.keys.iter().filter_map(|key| Some((key, key.halved?))) {
            let (path, twin) = (section.path_of(key), format!("{}.{radius}", section.path));
            // No embedded design has a compensator.
            let more = if path.starts_with("compensator.") { &compensator[..] } else { &[] };
            let mut tried = 0;
            for embedded in &catalogue().embedded {
                let given = keys_of(embedded.toml).get(&twin).and_then(|typed| length(typed));
                let doubled = given.map_or_else(|| "120 mm".to_owned(), |radius| radius.in_same_unit(2.0 * radius.si));
                let text = engine::changed_text(embedded.toml, &[&[set(&path, &doubled)][..], more].concat())
                    .expect("changed");
                let answer = answer_to(&text, "");
                let Some(of_page) = values(&answer) else { continue };
                assert_eq!(
                    (of_page.get(&path), of_page.get(&twin)),
                    (Some(&doubled), None),
                    "{}: {path}",
                    embedded.name
                );
                let usual = answer.found["usual"][&twin].as_str().and_then(length).expect("a length");
                assert!((usual.si - 0.5 * length(&doubled).expect("a length").si).abs() < 1e-12, "{path}");
                assert_shown(embedded.name, &text, &of_page);
                tried += 1;
                if tried == 2 {
                    break;
                }
            }
            // A belt brake has no page.
            assert!(tried > 0 || path.starts_with("brake"), "{path}");
        }
    }
}

/// Values in all forms allowed in a file.
#[test]
fn a_page_shows_values_in_the_form_of_the_file() {
    let design = |cam: &str, segments: &str| {
        format!(
            "name = \"a \\\"b\\\"\"\n[motion]\nrpm = 1_20\nstart = \"0 in\"\nsegment = [{segments}]\n[follower.roller]\ndiameter = \"Ø 0.5 in\"\n[cam]\nthickness = \"0.5\\\"\"\n{cam}"
        )
    };
    let segments = "{ law = \"cycloidal\", over = \"90°\", to = \"0.4 in\" }, { law = \"Dwell\", over = \"90 deg\" }, { law = \"3-4-5\", to = \"0 in\" }";
    let text = design(
        "body = \"Disc\"\nbore_diameter = \"20 mm\"\nkeyway = \"auto\"\n[limits]\novershoot = \"1%\"\n",
        segments,
    );
    let of_page = shown(&text);
    let expected = [
        ("name", "a \"b\""),
        ("motion.rpm", "120"),
        ("motion.segment[0].over", "90°"),
        ("motion.segment[1].law", "Dwell"),
        ("motion.segment[2].to", "0 in"),
        ("follower.roller.diameter", "Ø 0.5 in"),
        ("cam.body", "Disc"),
        ("cam.thickness", "0.5\""),
        ("cam.bore_diameter", "20 mm"),
        ("cam.keyway.width", "auto"),
        ("cam.keyway.depth", "auto"),
        ("cam.base_radius", "auto"),
        ("limits.overshoot", "1%"),
    ];
    for (key, value) in expected {
        assert_eq!(of_page.get(key).map(String::as_str), Some(value), "{key}");
    }
    assert!(!of_page.contains_key("cam.bore_radius") && !of_page.contains_key("follower.roller.radius"), "{of_page:?}");
    assert_eq!(shown(&design("", segments)).get("cam.body").map(String::as_str), Some("disc"));
    // A word given instead of a table stays in the table's other key, and a list of inline tables can grow.
    let text = engine::changed_text(&text, &[set("cam.keyway.width", "6 mm")]).expect("changed");
    let keys = keys_of(&text);
    let of = |key: &str| keys.get(key).map(String::as_str);
    assert_eq!((of("cam.keyway.width"), of("cam.keyway.depth")), (Some("6 mm"), Some("auto")));
    let inserted = [
        TextChange::Insert("motion.segment[1]".into()),
        set("motion.segment[1].law", "dwell"),
        set("motion.segment[1].over", "10 deg"),
    ];
    let text = engine::changed_text(&text, &inserted).expect("changed");
    let of_page = shown(&text);
    assert_eq!(of_page.get("motion.segment[3].law").map(String::as_str), Some("3-4-5"), "{text}");
}

/// An empty limit shows the limit of the check.
#[test]
fn usual_limits_are_those_of_the_checks() {
    for (name, keys) in [("feeder", 3), ("lever", 3), ("conjugate", 3)] {
        let text = toml(name).split("[limits]").next().unwrap_or_default().to_owned();
        let request = EngineRequest { name: "own".into(), toml: text, page: Some(10), ..EngineRequest::default() };
        let answer = engine::answer(&request);
        let usual = |key: &str, dimension: Dimension| {
            let typed = answer.found["usual"][format!("limits.{key}")].as_str().map(str::to_owned);
            typed.map(|typed| units::parse(&typed, dimension).expect("a quantity").si)
        };
        let usual = [
            ("pressure_angle", usual("pressure_angle", Dimension::Angle), 1.0_f64.to_radians()),
            ("wall", usual("wall", Dimension::Length), 1e-3),
            ("size", usual("size", Dimension::Length), 1e-3),
            ("contact_stress", usual("contact_stress", Dimension::Pressure), 1e6),
        ];
        let checks = answer.found["cam"]["checks"].as_array().expect("checks");
        let mut compared = 0;
        for (check, limit, unit) in usual {
            let Some(found) = checks.iter().find(|found| found["check"] == check) else { continue };
            let Some(of_check) = found["limit"].as_f64() else { continue };
            assert!(limit.is_some_and(|limit| (limit / unit - of_check).abs() < 1e-9 * of_check), "{name}: {check}");
            compared += 1;
        }
        assert!(compared >= keys, "{name}: {compared}");
    }
}
