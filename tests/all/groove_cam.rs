//! Grooves and rings as `camgen make` cuts them: the values of a reference with forty digits, the layers of their file, and what is refused.

use crate::common::program::{camgen_in, report};
use camgen::body::groove::Groove;
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec, Writing};
use camgen::reading;
use camgen::report::Verdict;
use std::fs;

const TOLERANCE: f64 = 5e-6;

const HEAD: &str = r#"
name = "groove"
[motion]
rpm = 200
start = "0 UNIT"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "TO"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "3-4-5"
over = "150 deg"
to = "0 UNIT"
[[motion.segment]]
law = "dwell"
"#;
const ROLLER: &str = "[follower.roller]\nradius = \"15 mm\"\noffset = \"12 mm\"\nmass = \"3 kg\"\n";
const ARM: &str = "[follower.swinging-roller]\nradius = \"16 mm\"\narm = \"110 mm\"\npivot_distance = \"140 mm\"\n";
const SIZE: &str =
    "[cam]\nbody = \"groove\"\nbase_radius = \"BASE\"\nthickness = \"24 mm\"\ngroove_depth = \"14 mm\"\n";

fn translating() -> String {
    HEAD.replace("UNIT", "mm").replace("TO", "30 mm") + ROLLER + &SIZE.replace("BASE", "55 mm")
}

fn swinging() -> String {
    HEAD.replace("UNIT", "deg").replace("TO", "20 deg") + ARM + &SIZE.replace("BASE", "64 mm")
}

fn machine(text: &str, sets: &[&str]) -> Machine {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    Machine::from_toml("groove.toml", text, &sets).unwrap_or_else(|error| panic!("{error}"))
}

fn cam(text: &str, sets: &[&str]) -> Cam {
    Spec::of_program(machine(text, sets), None).expect("a motion").solve().unwrap_or_else(|error| panic!("{error}"))
}

/// Columns of the table of a cam at cam angles in whole degrees, with what they should be.
fn has(cam: &Cam, values: &[(&str, usize, f64)]) {
    let table = cam.draw(TOLERANCE).expect("drawn").prove().expect("proved").table(360);
    for (name, degrees, expected) in values {
        let column = table.columns.iter().position(|column| column == name).unwrap_or_else(|| panic!("{name}"));
        near(table.rows[*degrees][column], *expected);
    }
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-11 * (1.0 + expected.abs()), "{found} {expected}");
}

/// The points of mpmath with forty digits, by differentiating one point of the motion.
#[test]
fn flanks_of_a_groove_are_those_of_the_reference() {
    let straight = [
        ("lift_mm", 50, 10.667_585_255_943_62),
        ("pitch_x_mm", 50, 41.993_507_854_746_99),
        ("pitch_y_mm", 50, 68.714_599_773_852_85),
        ("profile_x_mm", 50, 30.739_243_155_658_68),
        ("profile_y_mm", 50, 58.797_870_167_634_14),
        ("outer_x_mm", 50, 53.247_772_553_835_3),
        ("outer_y_mm", 50, 78.631_329_380_071_56),
        ("pressure_angle_deg", 50, 8.615_011_986_549_948),
        ("pitch_curvature_radius_mm", 50, 90.901_056_241_369_35),
        ("profile_x_mm", 230, -38.960_396_518_116_96),
        ("profile_y_mm", 230, -56.329_337_542_731_17),
    ];
    has(&cam(&translating(), &[]), &straight);
    let of = |side: &str| cam(&swinging(), &[&format!("follower.swinging-roller.side={side}")]);
    has(&of("trailing"), &[("profile_x_mm", 75, 82.022_122_709_903_49), ("profile_y_mm", 75, 41.293_825_874_150_99)]);
    has(
        &of("leading"),
        &[("profile_x_mm", 215, -9.888_444_372_619_773), ("profile_y_mm", 215, -87.856_547_366_525_53)],
    );
}

/// The ring around the same roller is the outer flank of the groove.
#[test]
fn a_ring_is_the_outer_flank() {
    let ring = ["cam.body=ring", "cam.base_radius=85 mm", "follower.roller.preload=80N"];
    let ring = cam(&translating().replace("groove_depth = \"14 mm\"\n", ""), &ring);
    let outer = [("profile_x_mm", 50, 53.247_772_553_835_3), ("profile_y_mm", 50, 78.631_329_380_071_56)];
    has(&ring, &outer);
    let proven = ring.draw(TOLERANCE).expect("drawn").prove().expect("proved");
    assert!(proven.passed(), "{:#?}", proven.findings());
    let found = reading::read(&proven.cut_files()[0], 1e-9).expect("read");
    // Clockwise: the metal is on the left of the profile.
    assert!(found.chains.len() == 1 && found.chains[0].contour().area_and_centroid().0 < 0.0);
    assert!(found.others.len() == 1 && found.others[0].on_layer("BLANK"));
    // A cutter of 20 mm on the inside of it.
    let with_cutter = camgen::Request { cutter_radius: Some(0.01), ..camgen::Request::within(TOLERANCE) };
    let proven = ring.draw(with_cutter).expect("drawn").prove().expect("proved");
    let path = proven.findings().iter().find(|finding| finding.check == "cutter_path").expect("checked");
    assert_eq!(path.verdict, Verdict::Pass, "{path:?}");
}

#[test]
fn a_groove_is_one_file_and_each_flank_is_proved_in_it() {
    for (text, sets) in [
        (translating(), vec!["cam.clearance=0.04mm", "cam.bore_radius=12.5mm", "cam.keyway=auto"]),
        (translating(), vec!["cam.clearance=0.04mm", "cam.clearance_share=0.5", "cam.rotation=ccw"]),
        (swinging(), vec!["cam.clearance=0.1mm", "cam.clearance_share=1"]),
    ] {
        let cam = cam(&text, &sets);
        let request = camgen::Request { cutter_radius: Some(0.01), ..camgen::Request::within(TOLERANCE) };
        let proven = cam.draw(request).expect("drawn").prove().expect("proved");
        assert!(proven.passed(), "{sets:?} {:#?}", proven.findings());
        let set = proven.files(&Writing::to("out", "cam").formats(&["dxf", "step"])).expect("files");
        let names: Vec<&str> = set.outputs().iter().map(|output| &*output.name).collect();
        assert_eq!(names, ["cam.dxf", "cam.step", "cam-inner-cutter.dxf", "cam-outer-cutter.dxf"]);
        for output in set.outputs() {
            let expected = camgen::ExpectedFile { cutter: Some(0.01), ..Default::default() };
            let report = cam.check_file(&output.bytes, &expected, TOLERANCE).expect("a file of it");
            assert!(report.passed(), "{} {sets:?} {:#?}", output.name, report.checks);
        }
        let dxf = String::from_utf8(proven.cut_files()[0].clone()).expect("text");
        for layer in ["GROOVE_INNER", "GROOVE_OUTER", "BLANK"] {
            assert!(dxf.contains(&format!("\n{layer}\n")), "{layer}");
        }
        // Without one of its flanks it is not the groove.
        for layer in ["GROOVE_INNER", "GROOVE_OUTER"] {
            let other = dxf.replace(&format!("\n{layer}\n"), "\nNOTES\n").into_bytes();
            assert!(!cam.check(&other, TOLERANCE).expect("a DXF file").passed(), "{layer}");
        }
    }
}

/// Nominally the roller has no room: written within a tolerance it may be pinched, which is told, and never where no flank is nearer than it should be.
#[test]
fn a_groove_without_clearance_is_a_warning_but_on_its_inside() {
    let cam = cam(&translating(), &[]);
    let width = |side| {
        let fit = camgen::Fit { side, ..camgen::Fit::from(TOLERANCE) };
        let proven = cam.draw(camgen::Request::within(fit)).expect("drawn").prove().expect("proved");
        let found = proven.findings().iter().find(|finding| finding.check == "groove_width").expect("checked");
        (found.verdict, found.value, proven.passed())
    };
    let (verdict, value, passed) = width(camgen::Side::Both);
    assert!(verdict == Verdict::Warn && (29.99..30.0).contains(&value) && passed, "{value}");
    let (verdict, value, passed) = width(camgen::Side::Inside);
    assert!(verdict == Verdict::Pass && value >= 30.0 && passed, "{value}");
}

/// Without a spring the force changes flank where the acceleration changes sign: amid the rise and amid the return.
#[test]
fn the_force_changes_flank_where_the_acceleration_changes_sign() {
    let machine = machine(&translating(), &["cam.clearance=0.04mm"]);
    let (motion, rpm) = machine.motion().expect("a motion");
    let groove = Groove::between_flanks(&machine, &motion, rpm).expect("a groove");
    let found = groove.flank_switches().expect("a mass and a speed");
    let degrees: Vec<f64> = found.iter().map(|switch| switch.at.to_degrees()).collect();
    assert!((degrees[0] - 60.0).abs() < 1e-6 && (degrees[1] - 225.0).abs() < 1e-6 && degrees.len() == 2, "{degrees:?}");
    assert!(!found[0].to_lifting && found[1].to_lifting);
    for switch in &found {
        let curves = camgen::body::curves(&groove).expect("plane");
        let (piece, angle) = curves.motion.locate(switch.at);
        let jump = 2.0 * curves.contact(piece, angle).curve.speed / 0.015;
        near((switch.spin[1] - switch.spin[0]).abs(), jump);
    }
    // Without a spring the free follower keeps its velocity until its distance from the motion equals the play k/cos α.
    let curves = camgen::body::curves(&groove).expect("plane");
    let at = |angle: f64| {
        let (piece, inside) = curves.motion.locate(angle);
        curves.contact(piece, inside)
    };
    let (start, left) = (found[0].at, at(found[0].at).lift);
    let room = |angle: f64| {
        let contact = at(angle);
        let apart = contact.lift.s - left.s - (angle - start) * left.ds;
        0.04e-3 / contact.pressure_angle.cos() - apart.abs()
    };
    let (mut low, mut high) = (start, start + 0.5);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if room(middle) > 0.0 { &mut low } else { &mut high }) = middle;
    }
    let speed = 200.0 * std::f64::consts::TAU / 60.0;
    let hit = speed * (room(low - 1e-5) - room(low + 1e-5)) / 2e-5;
    assert!((found[0].impact.expect("known") / hit - 1.0).abs() < 1e-4, "{:?} {hit}", found[0].impact);
    // A spring that outweighs the inertia holds the roller on one flank.
    let held = cam(&translating(), &["spring.preload=200N"]);
    let proven = held.draw(TOLERANCE).expect("drawn").prove().expect("proved");
    let found = proven.findings().iter().find(|finding| finding.check == "flank_switch").expect("checked");
    assert_eq!((found.value, found.verdict), (0.0, Verdict::Info));
}

#[test]
fn what_makes_no_groove_is_refused_with_the_reason() {
    let error = |text: &str, sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Machine::from_toml("groove.toml", text, &sets).expect_err("a fault").to_string()
    };
    let flat = translating().replace(ROLLER, "[follower.flat]\n");
    assert!(error(&flat, &[]).contains("a groove needs a roller"), "{}", error(&flat, &[]));
    let deep = error(&translating(), &["cam.groove_depth=24mm"]);
    assert!(deep.contains("goes through the disc"), "{deep}");
    let without = error(&translating().replace("groove_depth = \"14 mm\"\n", ""), &[]);
    assert!(without.contains("needs a depth"), "{without}");
    let bored = error(&translating(), &["cam.body=ring", "cam.bore_radius=10mm"]);
    assert!(bored.contains("a ring has no bore"), "{bored}");
    assert!(error(&translating(), &["cam.body=bucket"]).contains("ring"), "the bodies are named");
    let jump = machine(&translating(), &["motion.segment[0].law=line", "limits.continuity=0"]);
    let refused = Spec::of_program(jump, None).expect("a motion").solve().expect_err("a corner").to_string();
    assert!(refused.contains("the velocity of the follower jumps"), "{refused}");
    // A flank that folds over itself: no outline, and the check says which.
    let sharp = cam(&translating(), &["motion.segment[0].over=25deg"]);
    let proven = sharp.draw(TOLERANCE).expect("a drawing without an outline").prove().expect("nothing to prove");
    assert!(proven.no_outline().is_some_and(|why| why.contains("folds over itself")), "{:?}", proven.no_outline());
    let of_outer = |found: &&camgen::Finding| {
        let note = found.note_words();
        found.check == "undercut" && found.verdict == Verdict::Fail && note.contains("the outer flank")
    };
    assert_eq!(proven.findings().iter().filter(of_outer).count(), 1, "{:#?}", proven.findings());
}

/// The design is found by the record and by the hash, and the default size leaves the wall.
#[test]
fn the_embedded_groove_is_made_and_found_again() {
    let directory = tempfile::tempdir().expect("a directory");
    let made = camgen_in(directory, &["make", "groove", "--json", "--out", "out"]);
    assert_eq!(made.code, 0, "{}", made.err);
    let found = report(&made);
    assert_eq!(found["groove"]["flanks"].as_array().map(Vec::len), Some(2), "{}", found["groove"]);
    let checked = camgen_in(made.directory, &["check", "out/groove-make-200rpm.dxf", "--json"]);
    assert_eq!(checked.code, 0, "{}", checked.out);
    fs::remove_file(checked.directory.path().join("out/.camgen.json")).expect("a record");
    let by_hash = camgen_in(checked.directory, &["check", "out/groove-make-200rpm.step", "--json"]);
    assert_eq!(by_hash.code, 0, "{} {}", by_hash.out, by_hash.err);
    let _ = fs::metadata(by_hash.directory.path()).expect("still there");
}

/// What a machine tool must take is the blank, not the outer flank.
#[test]
fn the_size_of_a_groove_is_that_of_its_blank() {
    for (body, text) in [("groove", translating()), ("ring", translating().replace("\"groove\"", "\"ring\""))] {
        let directory = tempfile::tempdir().expect("a directory");
        fs::write(directory.path().join("cam.toml"), text).expect("written");
        let run = camgen_in(directory, &["make", "cam.toml", "--dry-run", "--json"]);
        let report = report(&run);
        let blank = report["groove"]["blank_radius_mm"].as_f64().or(report["ring"]["blank_radius_mm"].as_f64());
        let blank = 2.0 * blank.unwrap_or_else(|| panic!("{body}: {}", run.out));
        let checks = report["checks"].as_array().expect("checks");
        let size = checks.iter().find(|check| check["check"] == "size").expect("a size");
        assert!((size["value"].as_f64().expect("a number") - blank).abs() < 1e-9, "{body}: {size} {blank}");
    }
}

/// The contact length is the reach of the roller into the groove, whatever the thickness of the disc; the named remedy passes.
#[test]
fn the_contact_is_as_long_as_the_roller_reaches() {
    let stress = |sets: &[&str]| {
        let words: Vec<&str> = sets.iter().flat_map(|set| ["--set", *set]).collect();
        let run = camgen_in(
            tempfile::tempdir().expect("a directory"),
            &[&["make", "groove", "--json", "--dry-run"], &*words].concat(),
        );
        let report = report(&run);
        let found = report["checks"]
            .as_array()
            .expect("checks")
            .iter()
            .find(|found| found["check"] == "contact_stress")
            .cloned();
        let found = found.expect("checked");
        (found["value"].as_f64().expect("a number"), found["verdict"] == "pass", found["note"].to_string())
    };
    for (depth, expected) in [("14 mm", 98.3), ("7 mm", 139.1), ("1 mm", 368.0)] {
        for thickness in ["24 mm", "60 mm"] {
            let (found, ..) = stress(&[&format!("cam.groove_depth={depth}"), &format!("cam.thickness={thickness}")]);
            assert!((found - expected).abs() < 0.05, "{depth} {thickness}: {found}");
        }
    }
    let (found, ..) = stress(&["cam.roller_height=7 mm"]);
    assert!((found - 139.1).abs() < 0.05, "{found}");
    for (speed, keys) in [("1800", 1), ("2600", 2)] {
        let speed = format!("motion.rpm={speed}");
        let (_, passed, note) = stress(&[&speed]);
        let note = note.replace('\\', "");
        let (_, rest) = note.split_once("cam.groove_depth = \"").unwrap_or_else(|| panic!("{note}"));
        let mut sets = vec![format!("cam.groove_depth={}", rest.split_once('"').expect("a value").0)];
        let thicker = rest.split_once(" with cam.thickness = \"").filter(|_| keys == 2);
        sets.extend(thicker.map(|(_, rest)| format!("cam.thickness={}", rest.split_once('"').expect("a value").0)));
        assert!(!passed && sets.len() == keys, "{speed}: {note}");
        let all: Vec<&str> = [speed.as_str()].into_iter().chain(sets.iter().map(String::as_str)).collect();
        assert!(stress(&all).1, "{all:?}");
    }
}
