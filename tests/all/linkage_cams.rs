//! Cams and resets of a press whose bed is moved by a linkage, as commands: known figures, files, refusals.

use crate::common::program::{camgen, camgen_in, files, report, run};
use std::path::Path;

/// linkage.md, A6: the table of drives, to the digits it prints.
#[test]
fn drives_of_the_bed_have_the_known_cylinders_and_lifts() {
    for (machine, end, force, bore, column, lift) in [
        ("dpi-crank-slider", "outer", 28_384.0, 429.3, 248.2, 56.5),
        ("dpi-crank-slider", "inner", 14_849.0, 310.5, 129.8, 153.0),
        ("dpi-six-bar", "outer", 19_827.0, 358.8, 178.5, 113.3),
        ("dpi-six-bar", "inner", 19_498.0, 355.8, 174.9, 111.8),
    ] {
        let told = report(&run(0, &["rotary", machine, "--end", end, "--dry-run", "--json"]));
        let number = |section: &str, name: &str| told[section][name].as_f64().unwrap_or_else(|| panic!("{name}"));
        assert!((number("force", "inertia_max_n") - force).abs() < 0.6, "{machine} {end}");
        assert!((number("law", "bore_mm") - bore).abs() < 0.051, "{machine} {end}");
        assert!((number("law", "column_length_mm") - column).abs() < 0.051, "{machine} {end}");
        // The law alone: the run-up adds to the lift of the cam.
        assert!((number("law", "dx_max_mm") + lift).abs() < 0.051, "{machine} {end}");
        assert_eq!(told["reversal"]["end"].as_str(), Some(end));
    }
    let reversal = report(&run(0, &["rotary", "dpi-crank-slider", "--dry-run", "--json"]))["reversal"].clone();
    assert!((reversal["angle_deg"].as_f64().expect("a number") - 146.4).abs() < 0.06, "{reversal}");
}

/// The residual force of a reset column is the same share for every drive, end and column: 0.0544271 of the design's largest inertia at
/// 5 at and 25 of 35 rpm.
#[test]
fn the_residual_of_a_reset_does_not_depend_on_the_linkage() {
    for (machine, end) in [("dpi-six-bar", "outer"), ("dpi-six-bar", "inner"), ("dpi-crank-slider", "inner")] {
        for column in ["matched", "return", "400mm"] {
            let column = format!("buffer.column={column}");
            let set = ["--set", "buffer.end_pressure=5at", "--set", &column];
            let args =
                [&["regimes", machine, "--end", end, "--rpm", "25,35", "--dry-run", "--json"][..], &set].concat();
            let told = report(&run(0, &args))["regimes"]["speeds"].clone();
            let number = |index: usize, name: &str| told[index][name].as_f64().expect("a number");
            // Of the inertia at 25 rpm; that of the design is (35/25)² times as large.
            let of_design = number(0, "residual_share") * 625.0 / 1225.0;
            assert!((of_design - 0.054_427_1).abs() < 1e-7, "{machine} {end}: {of_design}");
            assert_eq!(number(1, "residual_max_n"), 0.0);
        }
    }
}

/// The files of both ends have names of their own, and each is told from the other.
#[test]
fn each_end_has_its_own_files() {
    let made = run(0, &["rotary", "dpi-six-bar", "--end", "inner", "--format", "dxf"]);
    let file = "output/dpi-six-bar-inner-rotary-35rpm.dxf";
    let own = camgen_in(made.directory, &["check", file, "dpi-six-bar", "--end", "inner"]);
    assert_eq!(own.code, 0, "{}", own.out);
    let other = camgen_in(own.directory, &["check", file, "dpi-six-bar"]);
    assert!(other.code == 1 && other.out.contains("for the inner end of the stroke (--end inner)"), "{}", other.out);
    let outer = camgen_in(other.directory, &["rotary", "dpi-six-bar", "--format", "dxf", "--quiet"]);
    assert_eq!(outer.code, 0, "{}", outer.err);
    let directory = outer.directory.path();
    assert!(directory.join("output/dpi-six-bar-rotary-35rpm.dxf").exists() && directory.join(file).exists());
}

#[test]
fn what_has_no_end_or_no_room_is_refused() {
    let locks =
        ["base_ratio=0.9", "coupler_ratio=1.05", "follower_ratio=1.02", "follower_angle=90deg", "rod_ratio=1.5"];
    let locks: Vec<String> = locks.iter().map(|set| format!("--set=linkage.{set}")).collect();
    let locks: Vec<&str> = locks.iter().map(String::as_str).collect();
    let reversed_often = [&["rotary", "dpi-six-bar"][..], &locks].concat();
    for (args, why) in [
        (&["rotary", "--end", "inner"][..], "under a yoke both ends are alike"),
        (&["regimes", "--end", "outer"], "under a yoke both ends are alike"),
        (
            &["rotary", "dpi-crank-slider", "--end", "inner", "--set", "transition.width=100deg"],
            "413.649 deg of the crank",
        ),
        (
            &["rotary", "dpi-crank-slider", "--set", "buffer.lead=400mm"],
            "a lead of 400 mm is longer than the bed moves",
        ),
        (
            &["rotary", "dpi-six-bar", "--set", "transition.kind=blend", "--set", "buffer.lead=5mm"],
            "a lead needs the bottom",
        ),
        (
            &["rotary", "dpi-crank-slider", "--set", "transition.kind=blend", "--set", "transition.width=150deg"],
            "146.35 deg at most",
        ),
        (&reversed_often, "more than twice in a turn"),
    ] {
        let refused = run(2, args);
        assert!(refused.err.contains(why), "{args:?}: {}", refused.err);
        assert!(!refused.directory.path().join("output").exists(), "{args:?}");
    }
}

/// With a lead the bottom retreats before the piston on either side: nothing is compressed outside the reversal, and the motion has no
/// jump but those that the retreat has under a yoke too.
#[test]
fn a_lead_retreats_as_the_linkage_moves_the_bed() {
    for (machine, end) in [("dpi-six-bar", "outer"), ("dpi-crank-slider", "inner")] {
        let args = ["rotary", machine, "--end", end, "--set", "buffer.lead=12mm", "--format", "csv", "--force"];
        let made = camgen(&args);
        let output = made.directory.path().join("output");
        let table = |name: &String| Path::new(name).extension().is_some_and(|ending| ending == "csv");
        let name = files(&output).into_iter().find(table).expect("a table");
        let text = std::fs::read_to_string(output.join(name)).expect("a table");
        let names: Vec<&str> = text.lines().next().expect("a head").split(',').collect();
        let column = |name: &str| names.iter().position(|other| *other == name).expect("a column");
        let (x, dx, air) = (column("x_mm"), column("dx_mm"), column("air_n"));
        let mut ahead = 0;
        for line in text.lines().skip(1) {
            let row: Vec<f64> = line.split(',').map(|value| value.parse().expect("a number")).collect();
            if row[air] == 0.0 && row[x] < 0.0 && row[x] > -12.0 {
                assert!((row[dx] + 12.0 + row[x]).abs() < 1e-9, "{machine} {end}: {} {}", row[x], row[dx]);
                ahead += 1;
            }
        }
        assert!(ahead >= 4, "{machine} {end}: {ahead} rows on the retreats");
    }
}
