//! Ribs and yokes as `camgen make` cuts them, and the bearing of a roller: closed forms, what is refused and why.

use crate::common::program::{Run, camgen_in};
use camgen::body::disc::Disc;
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec, Writing};
use camgen::report::Verdict;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use tempfile::TempDir;

const TOLERANCE: f64 = 5e-6;

const YOKE: &str = include_str!("../../profiles/yoke.toml");
const RIB: &str = r#"
name = "Rib"
[motion]
rpm = 200
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "30 mm"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "3-4-5"
over = "150 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "15 mm"
offset = "12 mm"
mass = "3 kg"
[cam]
body = "rib"
base_radius = "75 mm"
roller_distance = "45 mm"
thickness = "20 mm"
"#;

fn machine(text: &str, sets: &[&str]) -> Machine {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    Machine::from_toml("cam.toml", text, &sets).unwrap_or_else(|error| panic!("{error}"))
}

fn cam(text: &str, sets: &[&str]) -> Cam {
    Spec::of_program(machine(text, sets), None).expect("a motion").solve().unwrap_or_else(|error| panic!("{error}"))
}

/// A folder in which commands run one after the other.
struct Folder(Option<TempDir>);

impl Folder {
    fn with(files: &[(&str, &str)]) -> Self {
        let folder = Self(Some(tempfile::tempdir().expect("a folder")));
        for (name, text) in files {
            fs::write(folder.path(name), text).expect("written");
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.as_ref().expect("a folder").path().join(name)
    }

    /// Exit code, output and errors of a command.
    fn run(&mut self, words: &[&str]) -> (i32, String, String) {
        let Run { code, out, err, directory } = camgen_in(self.0.take().expect("a folder"), words);
        self.0 = Some(directory);
        (code, out, err)
    }
}

/// The table of a cam in whole degrees, a column of it.
fn column(cam: &Cam, name: &str) -> Vec<f64> {
    let table = cam.draw(TOLERANCE).expect("drawn").prove().expect("proved").table(360);
    let index = table.columns.iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name}"));
    table.rows.iter().map(|row| row[index]).collect()
}

/// The outer roller is on the rib where the roller of a disc is whose base radius is larger by what the prime circle grows.
#[test]
fn the_flanks_of_a_rib_are_those_of_a_disc_and_of_a_ring() {
    let rib = cam(RIB, &[]);
    // √(90² − 12²) ± 22.5, with the offset.
    let height = (90.0_f64 * 90.0 - 144.0).sqrt();
    let prime = |by: f64| (height + by).hypot(12.0);
    let outer = format!("cam.base_radius={} mm", prime(22.5) - 15.0);
    let inner = format!("cam.base_radius={} mm", prime(-22.5) + 15.0);
    let alone = ["cam.body=disc", "limits.pressure_angle=60deg"];
    let text = RIB.replace("roller_distance = \"45 mm\"\n", "");
    let disc = cam(&text, &[&alone[..], &[&outer]].concat());
    let ring = cam(&text, &["cam.body=ring", "follower.roller.preload=1000 N", &inner]);
    for (of_rib, other, name) in [("profile_x_mm", &disc, "profile_x_mm"), ("inner_y_mm", &ring, "profile_y_mm")] {
        for (degrees, (found, expected)) in column(&rib, of_rib).iter().zip(column(other, name)).enumerate() {
            assert!((found - expected).abs() < 1e-10, "{of_rib} at {degrees} deg: {found} {expected}");
        }
    }
}

#[test]
fn a_rib_has_its_layers_and_each_file_is_recognised() {
    let mut folder = Folder::with(&[("rib.toml", RIB)]);
    for sets in [vec![], vec!["--set", "cam.rotation=ccw"]] {
        let words = [&["make", "rib.toml", "--out", "out", "--name", "rib", "--overwrite"], &sets[..]].concat();
        let (code, out, err) = folder.run(&words);
        assert_eq!(code, 0, "{sets:?}: {out}{err}");
        let text = fs::read_to_string(folder.path("out/rib.dxf")).expect("written");
        for layer in ["RIB_OUTER", "RIB_INNER"] {
            // Once in the table of layers, once for the outline.
            assert_eq!(text.lines().filter(|line| line.trim() == layer).count(), 2, "{layer}");
        }
        for file in ["out/rib.dxf", "out/rib.step"] {
            let (code, out, err) = folder.run(&[&["check", file, "--design", "rib.toml"], &sets[..]].concat());
            assert_eq!(code, 0, "{file} {sets:?}: {out}{err}");
        }
    }
}

/// A flank of another rib does not close with the other one.
#[test]
fn a_wrong_flank_of_a_rib_does_not_close() {
    let (right, wrong) = (cam(RIB, &[]), cam(RIB, &["cam.roller_distance=45.03 mm"]));
    let drawn = wrong.draw(TOLERANCE).expect("drawn").prove().expect("proved");
    let report = right.check(&drawn.cut_files()[0], TOLERANCE).expect("a DXF file");
    let failed: Vec<_> = report.checks.iter().filter(|check| check.verdict == Verdict::Fail).collect();
    assert!(failed.iter().any(|check| check.check == "closure"), "{failed:?}");
    // Either flank is 15 µm farther out: a difference of 30 µm, with the tolerance of the fit.
    let closure = failed.iter().find(|check| check.check == "closure").expect("failed");
    assert!((closure.value - 0.030).abs() < 0.012, "{closure:?}");
}

#[test]
fn a_yoke_has_one_breadth_and_mirrors_its_first_half() {
    let yoke = cam(YOKE, &[]);
    let positions = column(&yoke, "position_mm");
    for degrees in 0..180 {
        assert!((positions[degrees] + positions[degrees + 180] - 40.0).abs() < 1e-12, "{degrees}");
    }
    let proven = yoke.draw(TOLERANCE).expect("drawn").prove().expect("proved");
    assert!(proven.passed(), "{:#?}", proven.findings());
    let section = proven.report().section("yoke").cloned().expect("a section");
    assert!((section["breadth_mm"].as_f64().expect("a number") - 140.0).abs() < 1e-9);
    // The same cam by its base radius: R_b = (B − h)/2.
    let by_radius = cam(&YOKE.replace("breadth = \"140 mm\"", "base_radius = \"50 mm\""), &[]);
    assert_eq!(column(&yoke, "profile_x_mm"), column(&by_radius, "profile_x_mm"));
    // Tilted faces move along their normals by h cos δ.
    let tilted = cam(YOKE, &["follower.flat.tilt=10 deg"]);
    let curves = camgen::body::curves(tilted.body()).expect("plane");
    let base = curves.follower.prime_radius().expect("a disc");
    assert!((2.0 * base + 0.040 * libm::cos(10.0_f64.to_radians()) - 0.140).abs() < 1e-12);
}

#[test]
fn what_is_no_rib_and_no_yoke_is_refused_with_its_cause() {
    let mut folder = Folder::with(&[("rib.toml", RIB), ("yoke.toml", YOKE)]);
    let refused = [
        ("rib.toml", "cam.roller_distance=25 mm", "leave no wall"),
        ("rib.toml", "cam.bore_radius=10 mm", "a rib has no bore"),
        ("rib.toml", "cam.roller_distance=240 mm", "behind the shaft"),
        ("yoke.toml", "cam.base_radius=60 mm", "leaves 50 mm"),
        ("yoke.toml", "cam.breadth=30 mm", "leaves no cam"),
        ("yoke.toml", "motion.repeat=2", "odd number of lobes"),
    ];
    for (file, set, what) in refused {
        let (code, out, err) = folder.run(&["make", file, "--set", set, "--out", "out"]);
        assert_eq!(code, 2, "{set}: {out}{err}");
        assert!(err.contains(what), "{set}: {err}");
    }
    let others = [
        (RIB, "roller_distance = \"45 mm\"\n", "", "needs the distance of its two rollers"),
        (RIB, "[follower.roller]\nradius = \"15 mm\"", "[follower.flat]", "a rib needs a roller"),
        (YOKE, "[follower.flat]", "[follower.roller]\nradius = \"10 mm\"\noffset = \"5 mm\"", "has no offset"),
        (
            YOKE,
            "law = \"dwell\"                         # the rest of the half turn",
            "law = \"cycloidal\"\nover = \"210 deg\"\nto = \"0 mm\"",
            "half a turn apart",
        ),
    ];
    for (text, from, to, what) in others {
        assert!(text.contains(from), "{from}");
        fs::write(folder.path("other.toml"), text.replace(from, to)).expect("written");
        let (code, out, err) = folder.run(&["make", "other.toml", "--out", "out"]);
        assert_eq!(code, 2, "{to}: {out}{err}");
        assert!(err.contains(what), "{to}: {err}");
    }
    assert!(!folder.path("out").exists());
}

/// The values of mpmath with forty digits: a disc of base radius 55 mm under a roller of 15 mm, 2.5 kg, 8 N/mm and 600 N at 300 rpm.
#[test]
fn the_life_of_a_roller_is_that_of_the_reference() {
    let text = RIB.replace("body = \"rib\"\n", "").replace("roller_distance = \"45 mm\"\n", "");
    let sets = [
        "motion.rpm=300",
        "follower.roller.mass=2.5 kg",
        "spring.rate=8 N/mm",
        "spring.preload=600 N",
        "cam.base_radius=55 mm",
        "follower.roller.bearing.dynamic_rating=20 kN",
    ];
    let machine = machine(&text, &sets);
    let (motion, rpm) = machine.motion().expect("a motion");
    let disc = Disc::of_motion(&machine, Arc::clone(&motion), rpm).expect("a disc");
    let duty = disc.roller_duty().expect("forces");
    for (found, expected) in [
        (duty.mean_turns, 4.639_175_794_751_565),
        (duty.equivalent_load, 745.243_879_086_817_1),
        (duty.life.expect("a speed"), 692_987.272_282_589_5),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
}

/// A longer life than the bearing has is refused, and the rating that is named keeps it.
#[test]
fn the_rating_that_a_refused_bearing_names_is_enough() {
    let text = RIB.replace("body = \"rib\"\n", "").replace("roller_distance = \"45 mm\"\n", "");
    let more = "[follower.roller.bearing]\ndynamic_rating = \"RATING kN\"\n[spring]\nrate = \"8 N/mm\"\n\
                preload = \"900 N\"\n[limits]\nroller_life = 30000\n";
    let mut folder = Folder::with(&[]);
    let mut made = |rating: &str| {
        fs::write(folder.path("cam.toml"), text.clone() + &more.replace("RATING", rating)).expect("written");
        folder.run(&["make", "cam.toml", "--out", "out", "--overwrite", "--json"])
    };
    let (code, out, err) = made("4");
    assert_eq!(code, 1, "{err}");
    let report: serde_json::Value = serde_json::from_str(&out).expect("a report");
    let checks = report["checks"].as_array().expect("checks");
    let life = checks.iter().find(|check| check["check"] == "roller_life").expect("judged");
    let remedy = &life["remedies"][0];
    assert_eq!(remedy["key"], "follower.roller.bearing.dynamic_rating");
    let rating = remedy["value"].as_str().and_then(|value| value.strip_suffix(" kN")).expect("a rating in kN");
    let (code, out, _) = made(rating);
    assert_eq!(code, 0, "{rating}: {out}");
}

/// The exact slope of the spin, against the difference of the spin at two places.
#[test]
fn slopes_of_the_spin_are_those_of_the_spin() {
    let swinging = RIB
        .replace(
            "[follower.roller]\nradius = \"15 mm\"\noffset = \"12 mm\"\nmass = \"3 kg\"",
            "[follower.swinging-roller]\nradius = \"16 mm\"\narm = \"110 mm\"\npivot_distance = \"140 mm\"",
        )
        .replace(" mm\"\n[[motion", " deg\"\n[[motion")
        .replace("roller_distance = \"45 mm\"\n", "")
        .replace("body = \"rib\"\n", "");
    let straight = RIB.replace("body = \"rib\"\n", "").replace("roller_distance = \"45 mm\"\n", "");
    for text in [straight, swinging] {
        let cam = cam(&text, &[]);
        let curves = camgen::body::curves(cam.body()).expect("plane");
        for degrees in [20.0_f64, 70.0, 200.0, 260.0] {
            let (piece, at) = curves.motion.locate(degrees.to_radians());
            let spin = |at: f64| {
                let touch = curves.touch(piece, at);
                [touch.curve.speed, touch.drive_turn]
            };
            let step = 1e-5;
            let (after, before) = (spin(at + step), spin(at - step));
            let slopes = curves.follower.speed_slopes(&curves.motion.jet(piece, at)).expect("a roller");
            for (index, slope) in slopes.into_iter().enumerate() {
                let difference = (after[index] - before[index]) / (2.0 * step);
                assert!((slope - difference).abs() < 1e-6 * (1.0 + slope.abs()), "{degrees}: {slope} {difference}");
            }
        }
    }
}

#[test]
fn a_report_of_a_rib_is_written_for_every_format() {
    let rib = cam(RIB, &[]);
    let proven = rib.draw(TOLERANCE).expect("drawn").prove().expect("proved");
    let set = proven.files(&Writing::to("nowhere", "rib")).expect("files");
    assert!(set.outputs().len() >= 4);
    let mut folder = Folder::with(&[("rib.toml", RIB)]);
    let (_, out, err) = folder.run(&["make", "rib.toml", "--out", "out", "--json"]);
    let report: serde_json::Value = serde_json::from_str(&out).unwrap_or_else(|error| panic!("{error}: {err}"));
    // Along the path it is 45 − 30 mm thick.
    assert!(report["rib"]["wall_mm"].as_f64().expect("a wall") < 15.0, "{}", report["rib"]);
}
