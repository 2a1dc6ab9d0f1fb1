//! What a shop's programs and a build see of the files: their names, dates and forms.

use crate::common::program::{camgen, files, report};
use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::process::Output;

#[test]
fn names_of_files_have_six_digits_and_differ() {
    let third = "13.333333333333332";
    let both = format!("{third},35");
    for (args, names) in [
        (&["conoid", "--rpm", &both, "--name", "many"][..], &["many-13.3333rpm.dxf", "many-35rpm.dxf"][..]),
        (
            &["conoid", "--rpm", "13.33331,13.33334", "--name", "near"],
            &["near-13.33331rpm.dxf", "near-13.33334rpm.dxf"],
        ),
        (
            &["conoid", "--rpm", &both],
            &["dpi-conoid-13.3333-35rpm-13.3333rpm.dxf", "dpi-conoid-13.3333-35rpm-35rpm.dxf"],
        ),
        (&["rotary", "--rpm", third, "--dxf-version", "R12"], &["dpi-rotary-13.3333rpm.dxf"]),
    ] {
        let run = camgen(&[args, &["--format", "DXF", "--json", "--force"]].concat());
        assert_eq!(files(run.directory.path()), names, "{} {}", run.code, run.err);
        let told: Vec<String> = names.iter().map(|name| format!("output/{name}")).collect();
        assert_eq!(report(&run)["files"], Value::from(told));
    }
}

/// The header of a STEP file written with SOURCE_DATE_EPOCH as it is given.
fn dated(date: Option<&str>) -> (Output, Option<Vec<u8>>) {
    let directory = tempfile::tempdir().expect("a directory");
    let mut command = Command::cargo_bin("camgen").expect("the program");
    command.env_remove("SOURCE_DATE_EPOCH").envs(date.map(|date| ("SOURCE_DATE_EPOCH", date)));
    command.current_dir(directory.path()).args(["rotary", "--quiet", "--format", "step", "--name", "cam"]);
    let output = command.output().expect("it runs");
    (output, fs::read(directory.path().join("output/cam.step")).ok())
}

/// The second text of FILE_NAME.
fn time_stamp(step: &[u8]) -> &str {
    let text = std::str::from_utf8(step).expect("ASCII");
    let (_, header) = text.split_once("FILE_NAME('").expect("a header");
    header.split('\'').nth(2).expect("a time stamp")
}

#[test]
fn a_solid_bears_the_date_it_is_given_or_none() {
    let (_, without) = dated(None);
    let (_, again) = dated(None);
    assert_eq!(without, again);
    assert_eq!(time_stamp(&without.expect("a file")), "");
    let (_, given) = dated(Some("1795309323"));
    assert_eq!(time_stamp(&given.expect("a file")), "2026-11-22T01:02:03+00:00");
    for wrong in ["yesterday", "-1", "1e9", "253402300800"] {
        let (output, none) = dated(Some(wrong));
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), none), (Some(2), None), "{wrong}: {told}");
        assert!(told.contains("SOURCE_DATE_EPOCH") && told.contains(wrong), "{told}");
    }
}

/// A file that lies farther from the exact profile than the zone on its sheet permits is refused; the remedy that is named passes.
#[test]
fn a_file_keeps_the_zone_that_its_sheet_states() {
    let make = |more: &[&str]| {
        camgen(
            &[&["make", "feeder", "--set", "title.profile_tolerance=0.004mm", "--format", "dxf", "--json"], more]
                .concat(),
        )
    };
    let refused = make(&[]);
    let report = report(&refused);
    let outline =
        report["checks"].as_array().expect("checks").iter().find(|check| check["check"] == "outline").expect("outline");
    let note = outline["note"].as_str().expect("a note");
    assert_eq!((refused.code, outline["limit"].as_f64()), (1, Some(0.002)), "{note}");
    assert!(note.contains("cam.profile_tolerance permits 0.002 mm; --tolerance 1um"), "{note}");
    assert_eq!(files(refused.directory.path()), Vec::<String>::new());
    assert_eq!(make(&["--tolerance", "1um"]).code, 0);
}
