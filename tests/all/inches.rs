//! `--units inch`: every file says its unit, holds the same cam, and is refused where its unit alone is changed.

use crate::common::program::{camgen, camgen_in, files, report};
use std::fs;

/// Designs of every body, with the formats that only some of them have.
const DESIGNS: [(&str, &str); 8] = [
    ("feeder", ",points,gcode,inspect,gauge,servo-csv,servo-xyva,servo-twincat"),
    ("lever", ",points,gcode,inspect,gauge,servo-csv"),
    ("groove", ",points,gcode,inspect,servo-csv"),
    ("conjugate", ",points,gcode,inspect"),
    ("yoke", ",points,gcode,inspect"),
    ("wedge", ",points,gcode"),
    ("barrel", ",gcode"),
    ("indexer", ""),
];

/// A design in a unit, its files in a folder of the run.
fn made(design: &str, more: &str, units: &[&str]) -> crate::common::program::Run {
    let dxf = if design == "indexer" { "svg,step,csv" } else { "dxf,svg,step,csv,diagram" };
    let dxf = if ["barrel", "indexer"].contains(&design) { dxf.replace(",diagram", "") } else { dxf.to_owned() };
    let formats = format!("{dxf}{more}");
    let args = ["make", design, "--format", &formats, "--out", ".", "--name", "cam"];
    camgen(&[&args[..], units].concat())
}

#[test]
fn every_file_that_is_cut_or_measured_is_the_same_cam_in_inches() {
    for (design, more) in DESIGNS {
        let mut run = made(design, more, &["--units", "inch"]);
        assert_eq!(run.code, 0, "{design}: {} {}", run.out, run.err);
        // Words for people have inches; a remedy has the unit of its key.
        let shown = run.out.lines().take_while(|line| !line.starts_with("  files") && !line.starts_with("  notes"));
        for line in shown.filter(|line| !line.starts_with("          ")) {
            assert!(!line.contains(" mm") && !line.contains(" µm"), "{design}: {line}");
        }
        for name in files(run.directory.path()) {
            let judged = ["svg", "step"].iter().all(|ending| !name.ends_with(ending)) && name != ".camgen.json";
            if !judged {
                continue;
            }
            run = camgen_in(run.directory, &["check", &name, design, "--json"]);
            assert_eq!(run.code, 0, "{design} {name}: {} {}", run.out, run.err);
        }
    }
}

#[test]
fn a_file_whose_unit_is_changed_is_refused() {
    let (design, more) = DESIGNS[0];
    let made = made(design, &format!("{more},servo-isg"), &["--units", "inch", "--cutter-diameter", "0.25in"]);
    assert_eq!(made.code, 0, "{}", made.err);
    let changes: [(&str, &[(&str, &str)]); 12] = [
        ("cam.dxf", &[("$INSUNITS\n 70\n1\n", "$INSUNITS\n 70\n4\n")]),
        ("cam.dxf", &[("$INSUNITS\n 70\n1\n", "$INSUNITS\n 70\n0\n")]),
        (
            "cam.dxf",
            &[("$INSUNITS\n 70\n1\n", "$INSUNITS\n 70\n4\n"), ("$MEASUREMENT\n 70\n0\n", "$MEASUREMENT\n 70\n1\n")],
        ),
        ("cam.csv", &[("_in", "_mm")]),
        ("cam-points.csv", &[("_in", "_mm")]),
        ("cam-inspect.csv", &[("_in", "_mm")]),
        ("cam-inspect.txt", &[("# units: inches\n", "")]),
        ("cam-inspect.dmi", &[("UNITS/INCH", "UNITS/MM")]),
        ("cam-gauge.csv", &[("_in", "_mm")]),
        ("cam-servo.csv", &[("_in", "_mm")]),
        ("cam-xyva.st", &[("slave: in", "slave: mm")]),
        ("cam.ngc", &[("G20", "G21")]),
    ];
    let mut directory = made.directory;
    for (name, changed) in changes {
        let path = directory.path().join(name);
        let text = fs::read_to_string(&path).expect(name);
        let other = changed.iter().fold(text.clone(), |text, (from, to)| text.replace(from, to));
        assert_ne!(text, other, "{name}");
        fs::write(directory.path().join("changed"), other).expect("written");
        for (file, code) in [(name, 0), ("changed", 1)] {
            let run = camgen_in(directory, &["check", file, design, "--cutter-diameter", "0.25in", "--json"]);
            // A file that states no unit, or two, may be one that cannot be read.
            assert!(run.code == code || code == 1 && run.code == 2, "{name} {file}: {} {}", run.out, run.err);
            directory = run.directory;
        }
    }
}

#[test]
fn the_unit_is_that_of_the_flag_or_of_the_file_and_changes_nothing_else() {
    let flag = made("feeder", "", &["--units", "inch", "--json"]);
    let key = made("feeder", "", &["--set", "output.units=inch", "--json"]);
    let back = made("feeder", "", &["--set", "output.units=inch", "--units", "mm", "--json"]);
    let none = made("feeder", "", &["--json"]);
    for name in files(none.directory.path()).iter().filter(|name| *name != ".camgen.json") {
        let read = |run: &crate::common::program::Run| fs::read(run.directory.path().join(name)).expect("a file");
        assert_eq!(read(&flag), read(&key), "{name}");
        assert_eq!(read(&back), read(&none), "{name}");
        if name.rsplit_once('.').is_some_and(|(_, end)| end == "step") {
            let solid =
                |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).split_once("DATA;").map(|(_, data)| data.to_owned());
            assert_eq!(solid(read(&flag)), solid(read(&none)), "a STEP file has millimetres");
        } else {
            assert_ne!(read(&flag), read(&none), "{name}");
        }
    }
    let (inch, metric) = (report(&flag), report(&none));
    assert_eq!(inch["cam"], metric["cam"], "values for programs name their unit");
    let wrong = made("feeder", "", &["--units", "ell"]);
    assert_eq!(wrong.code, 2);
    assert!(wrong.err.contains("inch"), "{}", wrong.err);
}

#[test]
fn analyses_have_tables_and_reports_in_inches() {
    for (command, column) in [
        (vec!["spring"], "spring_travel_in"),
        (vec!["regimes"], "column_length_in"),
        (vec!["size", "feeder"], "prime_radius_in"),
        (vec!["linkage"], "x_in"),
        (vec!["shaft"], "diameter_in"),
        (vec!["drive"], "x_in"),
    ] {
        let args = [&command[..], &["--units", "inch", "--format", "csv", "--out", ".", "--name", "a"]].concat();
        let run = camgen(&args);
        assert_eq!(run.code, 0, "{command:?}: {}", run.err);
        let names = files(run.directory.path());
        let tables: Vec<String> = names
            .iter()
            .filter(|name| name.rsplit_once('.').is_some_and(|(_, end)| end == "csv"))
            .map(|name| fs::read_to_string(run.directory.path().join(name)).expect("a table"))
            .collect();
        let heads: Vec<&str> = tables.iter().filter_map(|table| table.lines().next()).collect();
        assert!(heads.iter().any(|head| head.split(',').any(|name| name == column)), "{command:?}: {heads:?}");
        let metric = |name: &str| name.ends_with("_mm") && !name.contains("_n_per_") || name.contains("_mm_per_");
        assert!(!heads.iter().any(|head| head.split(',').any(metric)), "{command:?}: {heads:?}");
    }
}

#[test]
fn a_tolerance_that_the_numbers_of_a_control_cannot_keep_is_refused() {
    let of = |more: &[&str]| {
        let args = [
            "make",
            "feeder",
            "--units",
            "inch",
            "--format",
            "gcode",
            "--controller",
            "fanuc",
            "--out",
            ".",
            "--cutter-diameter",
            "0.5in",
        ];
        camgen(&[&args[..], more].concat())
    };
    let refused = of(&[]);
    assert_eq!(refused.code, 2, "{}", refused.out);
    assert!(refused.err.contains("4 decimals") && refused.err.contains("cut.decimals"), "{}", refused.err);
    assert_eq!(of(&["--set", "cut.decimals=5"]).code, 0);
}
