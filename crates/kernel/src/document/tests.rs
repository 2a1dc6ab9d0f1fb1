use super::*;
use crate::units::Dimension;
use std::f64::consts::PI;

const NAME: Field<String> = Field::text("name", "what it is called", Presence::Required("lever"));
const START: Field<LengthOrAngle> =
    Field::length_or_angle("start", "where it starts", Presence::Default("0 mm"), within(-1.0, 1.0), within(-PI, PI));
const SMOOTH: Field<bool> = Field::boolean("smooth", "whether it is smooth", Presence::Default("true"));
const TERMS: Field<Vec<f64>> =
    Field::numbers("terms", "of the series", Presence::Optional("[1, 2]"), within(-9.0, 9.0));
const LAW: Field<u8> = Field::words("law", "the law", Presence::Default("dwell"), &["dwell", "rise"], &[0, 1]);
const TO: Field<f64> =
    Field::quantity("to", "where it ends", Presence::Required("30 mm"), Dimension::Length, above(0.0, 1.0));
const RATE: Field<f64> =
    Field::number("rate", "of the spring", Presence::Required("2"), above(0.0, 9.0)).only(&["disc"]);

const ROOT: KeySection = KeySection { path: "", about: "", occurs: Occurrence::Once, cams: &[], keys: &[NAME.key] };
const MOTION: KeySection = KeySection {
    path: "motion",
    about: "",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[START.key, SMOOTH.key, TERMS.key],
};
const SEGMENT: KeySection = KeySection {
    path: "motion.segment",
    about: "one after the other",
    occurs: Occurrence::Repeated,
    cams: &[],
    keys: &[LAW.key, TO.key],
};
const SPRING: KeySection =
    KeySection { path: "spring", about: "", occurs: Occurrence::Optional, cams: &[], keys: &[RATE.key] };
const SECTIONS: &[&KeySection] = &[&ROOT, &MOTION, &SEGMENT, &SPRING];

const FILE: &str =
    "name = \"lever\"\n\n[[motion.segment]]\nto = \"10 mm\"\n\n[[motion.segment]]\nlaw = \"rise\"\nto = \"20 mm\"\n";

fn texts(sets: &[&str]) -> Vec<String> {
    sets.iter().map(|&set| set.to_owned()).collect()
}

fn faults(text: &str, sets: &[&str]) -> Vec<FileFault> {
    let overrides = texts(sets);
    Reader::new("cam.toml", text, &overrides, SECTIONS).finish().err().unwrap_or_default()
}

fn messages(text: &str, sets: &[&str]) -> Vec<String> {
    faults(text, sets).into_iter().map(|fault| fault.message).collect()
}

#[test]
fn arrays_of_tables_read_and_can_be_overridden() {
    let overrides = texts(&["motion.segment[1].to=30mm", "motion.start = 90 deg", "motion.terms=[3, -1.5]"]);
    let reader = Reader::new("cam.toml", FILE, &overrides, SECTIONS);
    let ends: Vec<_> = reader.elements(&SEGMENT).map(|segment| (segment.get(&LAW), segment.get(&TO))).collect();
    assert_eq!(ends, [(Some(0), Some(0.01)), (Some(1), Some(0.03))]);
    let motion = reader.table(&MOTION);
    assert_eq!(motion.get(&START), Some(LengthOrAngle::Angle(0.5 * PI)));
    assert_eq!((motion.get(&SMOOTH), motion.get(&TERMS)), (Some(true), Some(vec![3.0, -1.5])));
    assert_eq!(reader.find(&SPRING).map(|spring| spring.get(&RATE)), None);
    assert_eq!(reader.given(false), ["motion.segment[1].to", "motion.start", "motion.terms"]);
    assert!(reader.given(true).contains(&"motion.segment[0].to".to_owned()));
    assert_eq!(reader.finish(), Ok(()));
}

#[test]
fn faults_in_an_element_name_its_index_and_its_line() {
    let file = FILE.replace("to = \"10 mm\"", "too = \"10 mm\"").replace("\"20 mm\"", "\"20 kg\"");
    let faults = faults(&file, &[]);
    let found: Vec<(String, usize)> =
        faults.iter().map(|fault| (fault.message.clone(), fault.place.as_ref().map_or(0, |p| p.line))).collect();
    let expected = [
        ("unknown key `motion.segment[0].too`", 4),
        ("`motion.segment[1].to`: `kg` is a unit of mass, not of length", 8),
    ];
    assert_eq!(found, expected.map(|(message, line)| (message.to_owned(), line)));
    assert_eq!(faults[0].help.as_deref(), Some("did you mean `motion.segment[0].to`?"));
}

#[test]
fn a_missing_key_of_an_element_is_told_at_its_header() {
    let found = faults(&FILE.replace("to = \"20 mm\"\n", ""), &[]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].message.contains("missing key `motion.segment[1].to`"), "{}", found[0]);
    assert_eq!(found[0].place.as_ref().map(|place| (place.line, place.width)), Some((6, 18)), "{}", found[0]);
}

#[test]
fn an_override_beyond_the_last_element_is_told() {
    let found = faults(FILE, &["motion.segment[2].to=3mm"]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].message.contains("the file has 2 of [[motion.segment]]"), "{}", found[0]);
}

#[test]
fn a_wrong_shape_is_one_fault() {
    let tail = FILE.strip_prefix("name = \"lever\"\n").expect("it begins so");
    for (text, message) in [
        ("name = \"x\"\nmotion = 5\n".to_owned(), "`motion` must be a table"),
        ("name = \"x\"\n[motion.segment]\nto = 5\n".to_owned(), "`motion.segment` must be an array of tables"),
        ("name = \"x\"\n[[spring]]\nrate = 1\n[[spring]]\n".to_owned(), "`spring` must be a table"),
        (format!("{FILE}[name.x]\ny = 1\n"), "not TOML"),
        (format!("{tail}[name]\ny = 1\n"), "`name` must be text"),
        ("name = \"x\"\n[motion]\nsmooth = 1\n".to_owned(), "`motion.smooth` must be true or false"),
        ("name = \"x\"\n[motion]\nterms = [1, 99]\n".to_owned(), "`motion.terms` must be at most 9: 99"),
        ("name = \"x\"\n[motion]\nstart = 1\n".to_owned(), "`motion.start`: `1` has no unit"),
        ("name = \"x\"\n[motion]\nstart = \"4 rad\"\n".to_owned(), "`motion.start` must be at most 3.14159"),
        ("name = \"x\"\n\"motion.start\" = 1\n".to_owned(), "unknown key `\"motion.start\"`"),
        ("name = \"x\"\n\"spring[0]\" = 1\n".to_owned(), "unknown key `\"spring[0]\"`"),
        ("name = \"x\"\n[[extra]]\n".to_owned(), "unknown table `extra[0]`"),
    ] {
        let found = messages(&text, &[]);
        assert!(found.len() == 1 && found[0].contains(message), "{text}\n{found:?}");
    }
    assert_eq!(messages("name = \"x\"\n[motion]\nsegment = []\n", &[]), Vec::<String>::new());
}

#[test]
fn the_same_fault_is_told_once() {
    let found = messages(FILE, &["nothing", "nothing"]);
    assert_eq!(found, ["--set nothing: `=` is missing"]);
}

#[test]
fn a_key_is_found_at_its_path_alone() {
    let found = |path: &str| key::key_at(SECTIONS, path).map(|(section, key)| (section.path, key.name));
    for section in SECTIONS {
        for key in section.keys {
            assert_eq!(found(&section.path_of(key)), Some((section.path, key.name)));
            assert!(!key.name.contains('.'), "{} would not be found", key.name);
        }
    }
    for path in ["", ".name", "motion.name", "motion[].start", "motion.segment.to", "motion.segment[1].to", "rate"] {
        assert_eq!(found(path), None, "{path}");
    }
}

fn tables() -> Tables {
    Tables {
        sections: SECTIONS.to_vec(),
        kinds: vec![cams::CamKind::cam("round", &["disc"]), cams::CamKind::analysis("sum")],
    }
}

/// A key that names a class has an effect on its members; one of every cam has none on an analysis.
#[test]
fn kinds_are_named_by_their_classes() {
    assert_eq!(tables().listed(&["disc", "wedge"]), ["round", "wedge"]);
    let given = texts(&["name", "spring.rate"]);
    assert_eq!(tables().without_effect(&given, "round"), Vec::<String>::new());
    assert_eq!(tables().without_effect(&given, "sum"), given);
}

#[test]
fn keys_without_effect_come_from_the_table() {
    let given = texts(&["name", "spring.rate", "motion.segment[1].to"]);
    assert_eq!(tables().without_effect(&given, "round"), Vec::<String>::new());
    assert_eq!(tables().without_effect(&given, "wedge"), ["spring.rate"]);
}

#[test]
fn the_template_reads_as_it_stands_and_with_everything_in_it() {
    let text =
        template("A cam.", &tables(), SECTIONS, &TemplateOptions { tables: &[], keys: &[], cam: "", only: false });
    assert_eq!(messages(&text, &[]), Vec::<String>::new(), "{text}");
    let is_code = |line: &str| line.starts_with("# [") || line.split('#').nth(1).is_some_and(|c| c.contains(" = "));
    let all: Vec<&str> =
        text.lines().map(|line| if is_code(line) { line.strip_prefix("# ").unwrap_or(line) } else { line }).collect();
    let all = all.join("\n");
    let reader = Reader::new("template", &all, &[], SECTIONS);
    assert_eq!(reader.given(true).len(), 7, "{all}");
    assert_eq!(reader.finish(), Ok(()), "{all}");
}

#[test]
fn the_schema_follows_the_tables() {
    let schema = schema("A cam", SECTIONS);
    let segment = &schema["properties"]["motion"]["properties"]["segment"];
    assert_eq!(segment["type"], "array");
    assert_eq!(segment["items"]["required"], serde_json::json!(["to"]));
    assert_eq!(schema["required"], serde_json::json!(["name"]));
    assert_eq!(schema["properties"]["motion"]["properties"]["smooth"]["default"], true);
}

#[test]
fn hostile_inputs_end_in_faults() {
    let deep = |open: &str, close: &str, n: usize| format!("a = {}{}", open.repeat(n), close.repeat(n));
    let wide = (0..20_000).map(|i| format!("k{i}=1,")).collect::<Vec<_>>().concat();
    for text in [
        String::new(),
        "\u{feff}".into(),
        "\0".into(),
        "=".into(),
        "[".repeat(100_000),
        deep("[", "]", 100_000),
        deep("{a=", "1}", 100_000),
        format!("{}=1", "a.".repeat(400_000)),
        format!("[{}a]", "a.".repeat(400_000)),
        format!("[{}a]", "é . ".repeat(100_000)),
        format!("[{}a]", "\"#\".".repeat(100_000)),
        format!("[{}a]", "\"=\".".repeat(100_000)),
        format!("x = {{ {}a = 1 }}", "'{'.".repeat(100_000)),
        format!("[{}a]", "\"\\u0041\".".repeat(100_000)),
        format!("x = {{ {wide}z = 1 }}"),
        "é = 1\n\"\u{1F600}\" = 2\n[\"ключ\"]\n".into(),
        "name = 99999999999999999999999999999999999\n[motion]\nstart = 1e999\nterms = [1e999, nan]\n".into(),
        "name = \"a\\u0007b\"".into(),
        "\r\n\r\r\n[motion]\r\nx = 1\r".into(),
        "a".repeat(1_000_000) + " = 1",
        format!("[{}]\n{}", "a".repeat(100_000), wide.replace(',', "\n")),
        format!("[{}]\n{}", "motion.".repeat(12) + "x", wide.replace(',', "\n")),
        format!(
            "[{0}b]\n{0}c = {1}1{2}",
            "a.".repeat(78),
            format!("{{ {}a = ", "a.".repeat(78)).repeat(79),
            "}".repeat(79)
        ),
    ] {
        let found = faults(&text, &[]);
        assert!(
            !found.is_empty() && found.len() <= 101,
            "{}: {}",
            text.chars().take(40).collect::<String>(),
            found.len()
        );
        assert!(found.iter().all(|fault| !fault.to_string().is_empty()));
    }
    for set in [
        "=",
        "==",
        "[=1",
        "]=1",
        "[]=1",
        "[0]=1",
        "a[=1",
        "a]=1",
        "motion.segment=1",
        "motion.segment[=1",
        "motion.segment[]=1",
        "motion.segment[].to=1mm",
        "motion.segment[-1].to=1mm",
        "motion.segment[01].to=1mm",
        "motion.segment[99999999999999999999999].to=1mm",
        "motion.segment[9].to=1mm",
        "motion.segment[0]=1",
        "motion.segment[0].to[0]=1mm",
        "motion.segment[0]].to=1mm",
        "motion.segment[[0].to=1mm",
        "motion[0].start=1mm",
        "motion.=1",
        ".motion=1",
        "..=1",
        "\u{1F600}=é",
        "motion.terms=[",
        "motion.terms=]",
        "motion.terms=[[1]]",
        "name=\u{7}",
        "motion=1",
        "name.x=1",
    ] {
        let found = faults(FILE, &[set]);
        assert_eq!(found.len(), 1, "--set {set}: {found:?}");
    }
}
