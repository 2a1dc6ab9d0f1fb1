//! The summaries that commands print: the verdict first, on one screen, with every assumption that it rests on.

use crate::common::program::{Run, camgen_in, report, summary_of};
use std::fs;

/// Commands that print a report, with embedded machines; that of `laws` has a line for each law.
const COMMANDS: [&[&str]; 24] = [
    &["rotary"],
    &["translating"],
    &["conoid", "--rpm", "20,25,30,35"],
    &["make", "lever"],
    &["make", "feeder"],
    &["make", "valve"],
    &["make", "groove"],
    &["make", "conjugate"],
    &["make", "yoke"],
    &["make", "wedge"],
    &["make", "barrel"],
    &["make", "indexer"],
    &["rotary", "dpi-six-bar"],
    &["regimes"],
    &["regimes", "--without-cam"],
    &["scatter", "--samples", "1000"],
    &["spring"],
    &["drive"],
    &["linkage"],
    &["shaft"],
    &["shaft", "dpi-shaft", "--rpm", "35"],
    &["brake"],
    &["size", "lever"],
    &["side-by-side", "lever", "feeder"],
];
const LINES: usize = 25;
const COLUMNS: usize = 80;

fn told(run: &Run) -> String {
    format!("{}{}", run.err, run.out)
}

#[test]
fn every_summary_fits_a_screen() {
    for args in COMMANDS {
        let run = summary_of(args);
        let told = told(&run);
        assert!(run.code <= 1, "{args:?}: {told}");
        assert!(told.lines().count() <= LINES, "{args:?}: {} lines\n{told}", told.lines().count());
        let too_long: Vec<&str> = run.out.lines().filter(|line| line.chars().count() > COLUMNS).collect();
        assert!(too_long.is_empty(), "{args:?}: {too_long:?}");
        assert!(!told.contains("NaN") && !run.out.contains("inputs   "), "{args:?}: {told}");
    }
    let laws = summary_of(&["laws", "lever"]).out;
    assert!(laws.lines().all(|line| line.chars().count() <= COLUMNS), "{laws}");
    assert!(laws.contains("▶ modified-sine"), "{laws}");
}

/// The verdict is in the second line, with the tightest margin, and again in the last one.
#[test]
fn the_verdict_stands_first_and_last() {
    let run = summary_of(&["rotary", "--rpm", "35"]);
    let lines: Vec<&str> = run.out.lines().collect();
    assert_eq!(lines[1], "PASS 17 of 17 · tightest: pressure angle 29.996° of at most 30° at 45.8°");
    assert_eq!(lines.last().copied(), Some("PASS 17 of 17 · may be cut · 5 files in output/"));
    for fact in
        ["base R69 mm", "21.29 kN on the roller", "1186 N·m", "hardened steel is assumed", "1.773 N of 21.29 kN"]
    {
        assert!(run.out.contains(fact), "{fact}: {}", run.out);
    }
    assert!(run.out.contains("output/dpi-rotary-35rpm .dxf .svg -review.svg .step .csv"), "{}", run.out);
}

/// A pass never reads as the whole of its limit, and what is filled on purpose does not hide the margins of the design.
#[test]
fn margins_are_those_of_the_design() {
    let out = summary_of(&["make", "lever", "--dry-run"]).out;
    let rows: Vec<&str> = out.lines().filter(|line| line.contains('█')).collect();
    assert!(rows.len() >= 3 && rows[0].contains("pressure angle") && rows[0].contains("98.3 %"), "{out}");
    assert!(!out.contains(" 100 %") && rows.iter().all(|row| !row.contains("outline")), "{out}");
    assert!(out.contains("as cut") && out.contains("filled on purpose"), "{out}");
}

/// Two changes that contradict each other become one that passes every check, and says what it costs.
#[test]
fn remedies_are_tried_together() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("two.toml"), include_str!("../cases/two-remedies.toml")).expect("written");
    let run = camgen_in(directory, &["make", "two.toml", "--rpm", "500", "--dry-run", "--json"]);
    let failed = report(&run)["checks"].as_array().expect("checks").iter().filter(|c| c["verdict"] == "fail").count();
    assert_eq!(failed, 2);
    let path = run.directory.path().join("two.toml").display().to_string();
    let out = summary_of(&["make", &path, "--rpm", "500", "--dry-run"]).out;
    assert!(out.contains("FAIL 2 of 18") && out.contains("tried together: PASS 18 of 18"), "{out}");
    let keys = ["spring.preload = \"", "bearing.dynamic_rating = \""];
    let values = keys.map(|key| out.split_once(key).and_then(|(_, rest)| rest.split_once('"')).expect("a value").0);
    let sets = [
        format!("spring.preload={}", values[0]),
        format!("follower.swinging-roller.bearing.dynamic_rating={}", values[1]),
    ];
    let again = summary_of(&["make", &path, "--rpm", "500", "--dry-run", "--set", &sets[0], "--set", &sets[1]]);
    assert!(again.code == 0 && again.out.contains("PASS 18 of 18"), "{}", again.out);
    assert!(out.contains("it costs"), "{out}");
}

/// The report for programs has margins, assumptions and remedies as data.
#[test]
fn findings_have_margins_and_remedies_as_data() {
    let run = camgen_in(tempfile::tempdir().expect("a directory"), &["rotary", "--json", "--dry-run"]);
    let report = report(&run);
    let check = |name: &str| report["checks"].as_array().expect("checks").iter().find(|c| c["check"] == name).cloned();
    let angle = check("pressure_angle").expect("a check");
    let (value, limit) = (angle["value"].as_f64().expect("a value"), angle["limit"].as_f64().expect("a limit"));
    assert!((angle["margin"].as_f64().expect("a margin") - value / limit).abs() < 1e-12);
    assert_eq!(check("contact_stress").expect("a check")["assumes"], "hardened steel");
    let small = ["rotary", "dpi-paper", "--set", "cam.base_radius=200mm", "--json", "--dry-run"];
    let run = camgen_in(tempfile::tempdir().expect("a directory"), &small);
    let report = crate::common::program::report(&run);
    let checks = report["checks"].as_array().expect("checks");
    let angle = checks.iter().find(|c| c["check"] == "pressure_angle").expect("a check");
    assert_eq!(angle["remedies"][0]["key"], "cam.base_radius");
}

/// Whether a file is the cam is its first word.
#[test]
fn a_checked_file_has_one_of_three_verdicts() {
    let made = summary_of(&["rotary", "--format", "dxf", "--name", "cam"]);
    let file = made.directory.path().join("output/cam.dxf");
    let own = summary_of(&["check", &file.display().to_string(), "dpi", "--rpm", "35"]);
    assert!(own.code == 0 && own.out.lines().nth(1).is_some_and(|line| line.starts_with("THIS CAM · ")), "{}", own.out);
    let other = summary_of(&["check", &file.display().to_string(), "dpi", "--rpm", "30"]);
    assert!(other.code == 1 && other.out.contains("\nNOT THIS CAM · "), "{}", other.out);
    let text = fs::read_to_string(&file).expect("a file");
    let hole = "  0\nCIRCLE\n  8\n0\n 10\n80.0\n 20\n-60.0\n 30\n0.0\n 40\n5.0\n";
    let holed = text.replacen("ENTITIES\n", &format!("ENTITIES\n{hole}"), 1);
    fs::write(&file, holed).expect("written");
    let more = summary_of(&["check", &file.display().to_string(), "dpi", "--rpm", "35"]);
    assert!(more.code == 1 && more.out.contains("\nTHIS CAM, BUT · "), "{}", more.out);
}
