//! Tables for servo drives and lists of places for measuring machines, as they are in their files.

use crate::common::program::camgen_in;
use camgen::body::inspection::Inspection;
use camgen::reading::{inspection, servo};
use camgen::{Cam, Machine, Request, Spec, Verdict, Writing};

const TOLERANCE: f64 = 5e-6;
const LIFTER: &str = include_str!("common/lifter.toml");
const FORMATS: [(&str, &str); 3] =
    [("servo-csv", "-servo.csv"), ("servo-xyva", "-xyva.st"), ("servo-twincat", "-twincat.st")];

fn cam(name: &str, overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let (machine, _) = Machine::load(name, &overrides).expect("a machine");
    Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
}

/// The files of these formats, which pass their check.
fn files(cam: &Cam, request: Request, check: &str, formats: &[&str]) -> Vec<(String, Vec<u8>)> {
    let proven = cam.draw(request).expect("drawn").prove().expect("proved");
    let found = proven.findings().iter().find(|finding| finding.check == check).expect("checked");
    assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
    let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(formats) };
    let set = proven.files(&writing).expect("files");
    set.outputs().iter().map(|output| (output.name.clone(), output.bytes.clone())).collect()
}

#[test]
fn every_table_moves_a_drive_as_the_cam_moves_its_follower() {
    for (name, sets) in [
        ("feeder", &[][..]),
        ("lever", &[]),
        ("valve", &[]),
        ("groove", &[]),
        ("yoke", &[]),
        // A law whose acceleration jumps at both ends.
        ("feeder", &["motion.segment[0].law=harmonic", "motion.segment[4].law=harmonic", "limits.continuity=1"]),
    ] {
        let cam = cam(name, sets);
        let request = Request { servo: true, ..Request::within(TOLERANCE) };
        let names = FORMATS.map(|(format, _)| format);
        let files = files(&cam, request, "servo", &names);
        let read = files.iter().map(|(_, bytes)| servo::read(bytes).expect("a table"));
        let tables: Vec<servo::ServoRows> = read.collect();
        assert!(tables.iter().all(|table| *table == tables[0]), "{name}");
        assert!(tables[0].rows.len() < 400, "{name}: {} rows", tables[0].rows.len());
        for ((_, ending), (file, bytes)) in FORMATS.iter().zip(&files) {
            assert!(file.ends_with(ending), "{file}");
            let report = cam.check(bytes, TOLERANCE).expect("a table");
            assert!(report.passed(), "{name} {file}: {report:?}");
        }
    }
}

#[test]
fn a_table_with_a_fault_is_refused() {
    let cam = cam("feeder", &[]);
    let request = Request { servo: true, ..Request::within(TOLERANCE) };
    let files = files(&cam, request, "servo", &["servo-csv"]);
    let text = String::from_utf8(files[0].1.clone()).expect("text");
    let lines: Vec<&str> = text.lines().collect();
    let row = lines.len() / 2;
    let cells: Vec<f64> = lines[row].split(',').map(|cell| cell.parse().expect("a number")).collect();
    let with = |column: usize, by: f64| {
        let mut other = cells.clone();
        other[column] += by;
        let row_text = other.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        lines
            .iter()
            .enumerate()
            .map(|(at, line)| if at == row { row_text.as_str() } else { line })
            .collect::<Vec<_>>()
            .join("\n")
    };
    let without = |at: std::ops::Range<usize>| {
        let kept = lines.iter().enumerate().filter(|(own, _)| !at.contains(own)).map(|(_, line)| *line);
        kept.collect::<Vec<_>>().join("\n")
    };
    let faults = [
        ("a position", with(1, 0.0065)),
        ("a velocity", with(2, 0.01)),
        ("an acceleration", with(3, 0.01)),
        ("rows lost", without(row..row + 5)),
        ("the end lost", without(lines.len() - 1..lines.len())),
        ("a place", with(0, 0.2)),
    ];
    for (name, text) in faults {
        let report = cam.check(text.as_bytes(), TOLERANCE).expect("a table");
        assert!(!report.passed(), "{name}: {report:?}");
    }
}

#[test]
fn a_velocity_that_jumps_is_refused() {
    let mut text = LIFTER.to_owned();
    text = text.replacen("3-4-5", "constant-velocity", 1);
    let directory = tempfile::tempdir().expect("a folder");
    std::fs::write(directory.path().join("lifter.toml"), text).expect("written");
    let run = camgen_in(directory, &["make", "lifter.toml", "--set", "limits.continuity=0", "--format", "servo-csv"]);
    assert_eq!(run.code, 2, "{} {}", run.out, run.err);
    assert!(run.err.contains("velocity") && !run.directory.path().join("output").exists(), "{}", run.err);
}

#[test]
fn places_lie_on_the_profile_and_the_ball_touches_there() {
    for (name, count) in [("feeder", 1), ("groove", 2), ("lever", 1)] {
        let cam = cam(name, &["title.profile_tolerance=0.03 mm"]);
        let inspection = Some(Inspection { ball_radius: 2e-3 });
        let request = Request { inspection, ..Request::within(TOLERANCE) };
        let files = files(&cam, request, "inspection", &["inspect"]);
        assert_eq!(files.len(), 2 * count, "{name}");
        let places = inspection::read(&files[0].1).expect("a list");
        assert_eq!(places.len(), 360);
        for place in &places {
            assert!((place.ball - place.point - place.normal * 2.0).norm() < 1e-9);
            // The inner flank of a groove, too, has its metal towards the shaft.
            assert!(place.normal.dot(&place.point) > 0.0, "{name}: {place:?}");
        }
        let plain = String::from_utf8(files[count].1.clone()).expect("text");
        let first: Vec<f64> =
            plain.lines().next().expect("a line").split(' ').map(|word| word.parse().expect("a number")).collect();
        assert!(first.len() == 7 && first[0] == 1.0 && (first[1] - places[0].point.x).abs() < 1e-6, "{first:?}");
        let text = String::from_utf8(files[0].1.clone()).expect("text");
        assert!(text.contains("-0.015,0.015,"), "{text}");
        let moved = text.replacen("\n2,1,", "\n2,2,", 1);
        assert!(inspection::read(moved.as_bytes()).is_ok());
        assert!(inspection::read(text.replacen("\n2,", "\n3,", 1).as_bytes()).is_err());
    }
}
