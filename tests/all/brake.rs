//! `camgen brake`, as a command: known figures, the table, the disc as cut, designs, refusals with their places.

use crate::common::program::{Run, camgen_in, close, files, finding, number_of as number, report, run};
use serde_json::Value;
use std::fs;

fn told(code: i32, args: &[&str]) -> Value {
    report(&run(code, &[&["brake"], args, &["--dry-run", "--json"]].concat()))
}

/// Names of the columns and rows of a table that was written.
fn table(made: &Run, name: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = fs::read_to_string(made.directory.path().join("output").join(name)).expect("a table");
    let mut lines = text.lines();
    let names = lines.next().expect("names").split(',').map(str::to_owned).collect();
    let row = |line: &str| line.split(',').map(|cell| cell.parse().expect("a number")).collect();
    (names, lines.map(row).collect())
}

/// The value of a column where the roll has a radius, mm.
fn at((names, rows): &(Vec<String>, Vec<Vec<f64>>), radius: f64, name: &str) -> f64 {
    let column = names.iter().position(|other| other == name).unwrap_or_else(|| panic!("no {name}: {names:?}"));
    rows.iter().find(|row| (row[0] - radius).abs() < 1e-9).expect("a row")[column]
}

const COLUMNS: [&str; 15] = [
    "roll_radius_mm",
    "frame_deg",
    "wrap_deg",
    "k",
    "weight_arm_mm",
    "press_arm_mm",
    "tight_arm_mm",
    "slack_arm_mm",
    "tension_n",
    "tension_printed_n",
    "tension_share",
    "belt_slack_n",
    "belt_tight_n",
    "belt_speed_ratio",
    "friction_sensitivity",
];

/// brake.md, golden numbers 6 to 13 through the table: a handful of roundings over a root.
#[test]
fn the_table_tells_the_known_figures() {
    let made = run(1, &["brake", "--force"]);
    assert_eq!(files(&made.directory.path().join("output")), ["roll-brake.csv", "roll-brake.svg"]);
    let told = table(&made, "roll-brake.csv");
    assert_eq!(told.0, COLUMNS);
    assert_eq!((told.1.len(), told.1[0][0], told.1[110][0]), (111, 600.0, 50.0));
    for (radius, name, known) in [
        (600.0, "tension_n", 300.0),
        (600.0, "belt_slack_n", 901.743_102_744_314_276),
        (600.0, "friction_sensitivity", 1.034_991_157_92),
        (300.0, "frame_deg", -15.039_524_097_665_893_4),
        (300.0, "wrap_deg", 58.423_242_918_708_854_1),
        (300.0, "weight_arm_mm", 1_158.896_467_761_404_23),
        (300.0, "press_arm_mm", 1_228.918_324_923_654_15),
        (300.0, "slack_arm_mm", 858.266_003_761_705_701),
        (300.0, "tight_arm_mm", 341.248_499_378_612_196),
        (300.0, "tension_n", 267.032_457_647_984_554),
        (300.0, "tension_printed_n", 264.880_998_813_025_013),
        (50.0, "frame_deg", -27.182_125_125_436_771_1),
        (50.0, "tension_n", 243.378_703_746_757_656),
        (50.0, "tension_printed_n", 244.306_044_238_296_701),
    ] {
        close(at(&told, radius, name), known, 1e-11);
    }
    // Told without a file, and why: 18.9 % of the tension are lost, a disc or another frame keep it.
    let refused = run(1, &["brake"]);
    assert!(!refused.directory.path().join("output").exists());
    let report = told_of_roll();
    let tension = finding(&report, "tension");
    close(number(tension, "value"), 1.0 - 243.378_703_746_757_656 / 300.0, 1e-11);
    assert!(tension["note"].as_str().expect("a note").contains("--cam"), "{tension}");
}

fn told_of_roll() -> Value {
    told(1, &[])
}

/// Golden numbers 9, 12, 18 to 20, and what (8) would do in truth.
#[test]
fn the_report_tells_the_known_figures() {
    let report = told(1, &["--set", "brake.acceleration=0.3 m/s2", "--set", "brake.belt_speed_ratio=0.8"]);
    let (brake, web, printed) = (&report["brake"], &report["web"], &report["printed"]);
    close(number(brake, "weight_n"), 1_030.530_787_281_170_09, 1e-12);
    close(number(brake, "weight_printed_n"), 1_081.313_452_753_553_76, 1e-12);
    close(number(brake, "belt_length_mm"), 1_151.643_355_955_263_98, 1e-13);
    let day = &brake["other_friction"][1];
    close(number(day, "tension_full_n"), 362.433_518_205_482_607, 1e-12);
    close(number(day, "tension_run_down_n"), 294.138_923_378_757_070, 1e-12);
    close(number(web, "belt_speed_ratio_printed"), 0.998_866_213_151_927_438, 1e-15);
    close(number(web, "belt_speed_ratio_exact"), 0.998_867_497_168_742_922, 1e-15);
    close(number(web, "stretch_mm"), 6.802_721_088_435_374_15, 1e-14);
    close(number(web, "speed_sensitivity"), 882.0, 1e-12);
    close(number(web, "roll_inertia_kg_m2"), 119.696_447_247_638_767, 1e-13);
    close(number(web, "acceleration_tension_n"), 99.747_039_373_032_305_5, 1e-13);
    // The belt's drive takes four fifths of 3 kW.
    close(number(web, "belt_power_w"), 2400.0, 1e-12);
    // (8) at V_z/V = 0.8 brakes five times as hard, by its own moment; by the exact one 5 × 1081.3/1030.5.
    close(number(printed, "tension_in_truth_n"), 1500.0 * 1_081.313_452_753_553_76 / 1_030.530_787_281_170_09, 1e-12);
    assert!(report["notes"].to_string().contains("changes the power of the belt drive"), "{}", report["notes"]);
}

/// Golden numbers 1 to 4.
#[test]
fn the_papers_own_ends() {
    let toml = "name = \"paper\"\n[brake]\ntension = \"300 N\"\nfriction = 0.25\nbelt_speed_ratio = 0.8\nmodel = \"printed\"\n\
                [brake.ends]\nwrap = [\"90 deg\", \"45 deg\"]\npress_ratio = 0.93\n";
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("paper.toml"), toml).expect("written");
    let run = camgen_in(directory, &["brake", "paper.toml", "--json"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let report = report(&run);
    let ends = &report["ends"];
    close(number(ends, "k_full"), 0.274_165_887_366_796_260, 1e-14);
    close(number(ends, "k_run_down"), 0.255_721_991_805_072_814, 1e-14);
    close(number(ends, "press_full_n"), 5_471.140_171_399_975_26, 1e-14);
    close(number(ends, "belt_speed_ratio_run_down"), 0.769_435_528_523_976_879, 1e-14);
    close(number(ends, "belt_speed_range_of_slip"), 0.152_822_357_380_115_603, 1e-13);
    close(number(ends, "tension_in_truth_n"), 1500.0, 1e-13);
    assert_eq!(finding(&report, "belt_range")["verdict"], "pass");
    let (names, rows) = table(&run, "paper-brake.csv");
    assert_eq!((names[0].as_str(), rows.len()), ("wrap_deg", 2));
}

/// Golden numbers 14 to 17, and the disc as it is written: no more than what the slope of arcs within the tolerance costs.
#[test]
fn the_disc_holds_the_tension() {
    for (more, most) in [(&[][..], 1.5), (&["--tolerance", "0.05um"], 0.08), (&["--tolerance-velocity", "0.05%"], 0.1)]
    {
        let made = run(0, &[&["brake", "--cam"], more].concat());
        let names = files(&made.directory.path().join("output"));
        let cam = [
            "roll-brake-cam-review.svg",
            "roll-brake-cam.csv",
            "roll-brake-cam.dxf",
            "roll-brake-cam.step",
            "roll-brake-cam.svg",
        ];
        assert_eq!(names, [&cam[..], &["roll-brake.csv", "roll-brake.svg"]].concat());
        let told = table(&made, "roll-brake.csv");
        assert_eq!(told.0, [&COLUMNS[..], &["cam_deg", "cam_moment_nm", "lift_mm"]].concat());
        for row in &told.1 {
            assert!((row[8] - 300.0).abs() < 300.0 * 1e-9, "{row:?}");
        }
        for (radius, name, known) in [
            (50.0, "cam_deg", 271.821_251_254_367_711),
            (600.0, "lift_mm", 44.195_521_558_500_347_3),
            (500.0, "lift_mm", 42.565_064_291_569_122_9),
            (300.0, "lift_mm", 32.204_779_577_963_880_1),
            (100.0, "lift_mm", 9.485_016_589_868_837_78),
            (300.0, "cam_moment_nm", 147.444_348_237_193_964),
            (50.0, "cam_moment_nm", 255.925_862_925_341_622),
        ] {
            close(at(&told, radius, name), known, 1e-11);
        }
        let report = told_json(&[&["--cam"], more].concat());
        let disc = &report["disc"];
        close(number(disc, "work_j"), 63.727_962_816_779_037_0, 1e-12);
        let error = number(disc, "tension_as_cut_error_max_n");
        assert!(error < most && error > 1e-4 * most, "{more:?}: {error} N");
        assert_eq!(finding(&report, "tension")["verdict"], "pass");
        assert_eq!(finding(&report, "rolling")["verdict"], "pass");
    }
}

fn told_json(args: &[&str]) -> Value {
    told(0, args)
}

/// The written disc is this disc, and none of another brake.
#[test]
fn the_file_is_checked_against_the_brake() {
    let made = run(0, &["brake", "--cam", "--name", "disc", "--format", "dxf,step"]);
    let directory = made.directory;
    let code = |directory, args: &[&str]| {
        let run = camgen_in(
            directory,
            &[&["check", "output/disc-cam.dxf", "roll", "--cam", "brake", "--json"], args].concat(),
        );
        (run.code, report(&run), run.directory)
    };
    let (fine, told, directory) = code(directory, &[]);
    assert_eq!((fine, &finding(&told, "tension")["verdict"]), (0, &Value::from("pass")), "{told}");
    // Another friction asks for another lift.
    let (other, told, directory) = code(directory, &["--set", "brake.friction=0.3"]);
    assert_eq!((other, &finding(&told, "rolling")["verdict"]), (1, &Value::from("fail")), "{told}");
    // Turned the other way the disc is its mirror image.
    let (mirrored, _, directory) = code(directory, &["--set", "cam.rotation=ccw"]);
    assert_eq!(mirrored, 1);
    let solid = camgen_in(directory, &["check", "output/disc-cam.step", "roll", "--cam", "brake"]);
    assert_eq!(solid.code, 0, "{}{}", solid.out, solid.err);
}

/// Frames from random starts, as good as asked, whose table brakes as told.
#[test]
fn a_frame_is_designed_that_holds_the_tension() {
    for seed in ["1", "2", "3"] {
        let made = run(0, &["brake", "--synthesize", "--seed", seed, "--format", "toml", "--json"]);
        let design = &report(&made)["design"];
        assert!(number(design, "spread") < 0.002, "{design}");
        let output = made.directory.path().join("output");
        let frame = fs::read_to_string(output.join("roll-brake.toml")).expect("a table");
        let (head, tail) = include_str!("../../profiles/roll.toml").split_once("[brake.frame]").expect("a frame");
        let (_, tail) = tail.split_once("[brake.cam]").expect("a disc");
        let directory = made.directory;
        fs::write(directory.path().join("own.toml"), format!("{head}{frame}\n[brake.cam]{tail}")).expect("written");
        let again = camgen_in(directory, &["brake", "own.toml", "--json"]);
        assert_eq!(again.code, 0, "{}{}", again.out, again.err);
        close(number(&report(&again)["brake"], "tension_spread"), number(design, "spread"), 0.02);
    }
    let robust = told(0, &["--synthesize=robust", "--set", "brake.rotation=ccw"]);
    assert!(number(&robust["design"], "spread") < 0.29, "{}", robust["design"]);
    let level = told(0, &["roll-level"]);
    close(number(&level["brake"], "tension_spread"), 0.00106, 0.01);
    close(number(&level["brake"], "weight_n"), 1_518.389_302_530_3, 1e-12);
}

#[test]
fn a_belt_without_slip_must_grip() {
    let no_slip = ["--set", "brake.mode=no-slip"];
    let report = told(1, &no_slip);
    let grip = finding(&report, "grip");
    close(number(grip, "value"), 243.378_703_746_757_656 / 300.0, 1e-11);
    assert!(grip["note"].as_str().expect("a note").contains("1905.42 N"), "{grip}");
    let heavy = told(0, &[&no_slip[..], &["--set", "brake.weight=1905.43 N"]].concat());
    assert_eq!(finding(&heavy, "grip")["verdict"], "pass");
    close(number(&heavy["brake"], "tension_least_n"), 300.0, 1e-12);
}

#[test]
fn checks_of_a_brake_fail_where_they_should() {
    // The robust frame of the specification, turned the other way: it jams at 0.607.
    let frame = [
        "pivot=[-1600 mm, -340 mm]",
        "right_pulley=[700 mm, 10 mm]",
        "left_pulley=[-1000 mm, 800 mm]",
        "centre_of_gravity=[-100 mm, -420 mm]",
    ];
    let sets: Vec<String> = frame.iter().map(|key| format!("brake.frame.{key}")).collect();
    let with = |more: &[&'static str]| -> Vec<String> {
        let own = sets.iter().cloned().chain(more.iter().map(|&set| set.to_owned()));
        own.flat_map(|set| ["--set".to_owned(), set]).collect()
    };
    let told_with = |code, more: &[&'static str]| {
        let args = with(more);
        told(code, &args.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let locking = told_with(1, &["brake.friction=0.45"]);
    let found = finding(&locking, "self_locking");
    assert_eq!(found["verdict"], "fail");
    close(number(found, "value"), 0.45 / 0.607, 1e-3);
    let other = told_with(0, &["brake.rotation=ccw"]);
    assert_eq!(number(finding(&other, "self_locking"), "value"), 0.0);
    let stress = told_with(1, &["brake.rotation=ccw", "limits.web_stress=5 MPa"]);
    assert_eq!(finding(&stress, "web_stress")["verdict"], "fail");
    let range = told(1, &["--set", "brake.model=printed"]);
    assert_eq!(finding(&range, "belt_range")["verdict"], "fail");
}

#[test]
fn bad_input_is_told_with_its_place_and_a_remedy() {
    for (args, parts) in [
        (&["--set", "brake.roll.smallest_radius=600 mm"][..], &["must be below largest_radius: 600 mm ≥ 600 mm"][..]),
        (&["--set", "brake.friction=0"], &["must be above 0"]),
        (&["--cam", "--set", "brake.cam.turns_per_frame_turn=13.3"], &["361.5 deg", "13.2 at most"]),
        (
            &["--set", "brake.frame.left_pulley=[-600 mm, 200 mm]"],
            &["left pulley meets the roll", "600 mm", "left_pulley=["],
        ),
        (&["--set", "brake.frame.pivot=[-1100 mm]"], &["must be a list of two quantities of length", "[\"-1100 mm\""]),
        (&["--set", "brake.frame.pivot=[-1100, 2 mm]"], &["has no unit"]),
        (&["--set", "brake.frame.pivot=[-1100 mm, 2 kg]"], &["a unit of mass, not of length"]),
        (&["--set", "brake.belt_speed_ratio=1"], &["must be at most 0.999999"]),
        (&["--set", "brake.acceleration=3 m/s"], &["a unit of speed, not of acceleration"]),
        (&["--set", "brake.ends.wrap=[90 deg, 45 deg]"], &["give [brake.frame] or [brake.ends], not both"]),
        (&["--cam", "--set", "brake.mode=no-slip"], &["a slipping belt", "omit --cam"]),
        (&["--cam", "--set", "brake.model=printed"], &["exact moments"]),
        (&["roll-level", "--cam"], &["describes no disc", "[brake.cam]"]),
        (&["dpi"], &["describes no brake", "roll-level"]),
        (&["--cam", "--synthesize"], &["cannot be used with"]),
        (&["--seed", "3"], &["--synthesize"]),
    ] {
        let run = run(2, &[&["brake"], args].concat());
        for part in parts {
            assert!(run.err.contains(part), "{args:?}: no {part:?} in\n{}", run.err);
        }
        assert!(run.out.is_empty() && !run.directory.path().join("output").exists(), "{args:?}");
    }
}
