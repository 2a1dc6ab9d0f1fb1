//! Plates as `camgen make` cuts them for any motion by travel: their files, what checks them, and what does not take them for a disc.

use crate::common::program::camgen_in;
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec};
use camgen::report::Verdict;
use std::fs;

const TOLERANCE: f64 = 5e-6;
const WEDGE: &str = include_str!("../../profiles/wedge.toml");

fn cam(sets: &[&str]) -> Cam {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let machine = Machine::from_toml("wedge.toml", WEDGE, &sets).unwrap_or_else(|error| panic!("{error}"));
    Spec::of_program(machine, None).expect("a motion").solve().unwrap_or_else(|error| panic!("{error}"))
}

/// Every file of a plate is written and recognised, and its table is by the travel, with exact derivatives.
#[test]
fn the_files_of_a_plate_are_written_and_recognised() {
    let directory = tempfile::tempdir().expect("a folder");
    let words =
        ["make", "wedge", "--out", "out", "--name", "plate", "--format", "dxf,svg,step,csv,json,html,points,diagram"];
    let run = camgen_in(directory, &words);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    let text = |name: &str| fs::read_to_string(run.directory.path().join("out").join(name)).expect("written");
    let dxf = text("plate.dxf");
    assert_eq!(
        dxf.lines().filter(|line| line.trim() == "CAM_PROFILE").count(),
        2,
        "in the table of layers, and the outline"
    );
    let csv = text("plate.csv");
    let names: Vec<&str> = csv.lines().next().expect("a head").split(',').collect();
    assert_eq!(
        names[..6],
        ["x_mm", "position_mm", "lift_mm", "velocity_mm_per_mm", "acceleration_mm_per_mm2", "jerk_mm_per_mm3"]
    );
    assert!(names.contains(&"velocity_cut_mm_per_mm") && !csv.contains("per_rad"), "{names:?}");
    // 720 steps over 140 mm: the middle of the rise at 40 mm has the slope π·4/(4 + π)·22/80.
    let row: Vec<f64> = csv
        .lines()
        .nth(1 + 720 * 40 / 140)
        .expect("a row")
        .split(',')
        .map(|cell| cell.parse().expect("a number"))
        .collect();
    let peak = 4.0 * std::f64::consts::PI / (4.0 + std::f64::consts::PI) * 22.0 / 80.0;
    assert!((row[0] - 39.861_111_111_111_11).abs() < 1e-12 && (row[3] - peak).abs() < 1e-4 * peak, "{row:?}");
    assert!(text("plate-points.csv").contains("# given: flank of the plate\n"));
    for name in ["plate.html", "plate-diagram.svg", "plate.svg"] {
        assert!(!text(name).contains("mm/rad"), "{name} has rates by an angle");
    }
    let mut directory = run.directory;
    for file in ["out/plate.dxf", "out/plate.step"] {
        let checked = camgen_in(directory, &["check", file, "--design", "wedge"]);
        assert_eq!(checked.code, 0, "{file}: {}{}", checked.out, checked.err);
        directory = checked.directory;
    }
    let other =
        camgen_in(directory, &["check", "out/plate.dxf", "--design", "wedge", "--set", "cam.drive_angle=0.05 deg"]);
    assert_eq!(other.code, 1, "{}", other.out);
}

/// A plate of another size is found by its ends, one of another motion by the rolling.
#[test]
fn a_wrong_plate_is_refused_by_the_right_check() {
    let right = cam(&[]);
    for (set, check) in [
        ("cam.length=190.02 mm", "ends"),
        ("cam.height=40.02 mm", "ends"),
        ("cam.run_in=25.02 mm", "ends"),
        ("follower.roller.radius=12.01 mm", "rolling"),
        ("motion.segment[2].to=28.01 mm", "rolling"),
        ("motion.segment[0].over=80.1 mm", "rolling"),
    ] {
        let drawn = cam(&[set]).draw(TOLERANCE).expect("drawn").prove().expect("proved");
        let report = right.check(&drawn.cut_files()[0], TOLERANCE).expect("a DXF file");
        let failed: Vec<_> = report.checks.iter().filter(|found| found.verdict == Verdict::Fail).collect();
        assert!(failed.iter().any(|found| found.check == check), "{set}: {failed:?}");
    }
}

/// Commands for cams that turn refuse a plate with the reason, and nothing is written.
#[test]
fn a_plate_is_not_taken_for_a_disc() {
    for (words, why) in [
        (&["size", "wedge"][..], "no base radius"),
        (&["laws", "wedge"], "by the travel of a plate"),
        (&["trade", "make", "wedge"], "that of a plate"),
        (&["side-by-side", "wedge", "feeder"], "this one is a plate"),
        (&["make", "wedge", "--rpm", "30"], "leave --rpm out"),
        (&["make", "wedge", "--cutter-diameter", "10mm"], "not around a plate"),
        (&["make", "wedge", "--start", "20deg"], "no cam angle"),
        (&["make", "wedge", "--tolerance-velocity", "1mm/rad"], "must be a share"),
        (&["make", "feeder", "--set", "motion.stroke=90mm"], "the cam turns"),
    ] {
        let run = camgen_in(tempfile::tempdir().expect("a folder"), words);
        assert_eq!(run.code, 2, "{words:?}: {}{}", run.out, run.err);
        assert!(run.err.contains(why), "{words:?}: {}", run.err);
        assert_eq!(fs::read_dir(run.directory.path()).expect("a folder").count(), 0, "{words:?}");
    }
}

/// The plate mirrored end to end, by the motion run backwards on the opposite incline, is the same plate.
#[test]
fn a_motion_run_backwards_is_the_mirrored_plate() {
    let text = |segments: &str, drive: f64| {
        format!(
            "name = \"plate\"\n[motion]\nstroke = \"100 mm\"\n{segments}[follower.roller]\nradius = \"9 mm\"\n[cam]\nbody = \"wedge\"\n\
             run_in = \"20 mm\"\ndrive_angle = \"{drive} deg\"\n[limits]\npressure_angle = \"50 deg\"\n"
        )
    };
    let rise = "start = \"0 mm\"\n[[motion.segment]]\nlaw = \"3-4-5\"\nto = \"20 mm\"\n";
    let fall = "start = \"20 mm\"\n[[motion.segment]]\nlaw = \"3-4-5\"\nto = \"0 mm\"\n";
    let cams = [(rise, 8.0), (fall, -8.0)].map(|(segments, drive)| {
        let machine = Machine::from_toml("plate.toml", &text(segments, drive), &[]).expect("a machine");
        Spec::of_program(machine, None).expect("a motion").solve().expect("a plate")
    });
    let [one, other] = [0, 1].map(|index| camgen::body::curves(cams[index].body()).expect("plane"));
    for step in 0..=50 {
        let x = 0.002 * f64::from(step);
        let at = |curves: camgen::profile::Curves<'_>, x: f64| {
            let (piece, x) = curves.motion.locate(x);
            (curves.profile(piece, x).point, curves.contact(piece, x).pressure_angle)
        };
        let ((p, angle), (q, back)) = (at(one, x), at(other, 0.1 - x));
        assert!((p.x - (0.1 - q.x)).abs() < 1e-14 && (p.y - q.y).abs() < 1e-14, "{x}: {p} {q}");
        assert!((angle + back).abs() < 1e-12, "{x}: {angle} {back}");
    }
    assert_eq!(one.motion.period(), None);
}
