//! `camgen shaft`, as a command: known figures, tables, refusals with their places.

use crate::common::program::{camgen_in, close, files, number_of as number, report, run};
use serde_json::Value;
use std::fs;

fn shaft(args: &[&str]) -> Value {
    report(&run(0, &[&["shaft"], args, &["--dry-run", "--json"]].concat()))["shaft"].clone()
}

/// shaft.md, golden numbers 11, 12, 14 and 16 through the program.
#[test]
fn the_program_tells_the_known_figures() {
    let rigid = ["--set", "shaft.support.1.stiffness=rigid", "--set", "shaft.support.2.stiffness=rigid"];
    let list = |args: &[&str]| -> Vec<f64> {
        let told = shaft(args);
        told["critical_rpm"].as_array().expect("a list").iter().map(|n| n.as_f64().expect("a number")).collect()
    };
    for (args, known) in [
        (&["--whirl", "planar", "--set", "shaft.beam=euler"][..], &[9_618.040_174_964_64, 25_152.413_948_500_9][..]),
        (&[&["--whirl", "planar", "--set", "shaft.beam=euler"][..], &rigid].concat(), &[13_585.076_737_683_1]),
        (&[], &[9_213.269_309_052_77]),
        (&["--whirl", "planar"], &[9_207.225_635_194_39]),
        (&rigid, &[12_509.278_239_698_3]),
    ] {
        for (found, known) in list(args).into_iter().zip(known) {
            close(found, *known, 1e-11);
        }
    }
    let paper = shaft(&["--solver", "paper", "--stations", "36"]);
    close(paper["critical_rpm"][0].as_f64().expect("a number"), 9_629.206_696_326, 1e-9);
    close(number(&paper, "exact_rpm"), 9_213.269_309_052_77, 1e-11);

    let press = shaft(&["dpi-shaft"]);
    close(number(&press, "lift_error_max_mm"), 0.451_425_296_233_18, 1e-10);
    close(number(&press, "residual_max_n"), 143.688_934_088_6, 1e-9);
    close(number(&press, "compliance_um_per_kn"), 7.173_360_879_693_742, 1e-11);
    close(number(&press, "speed_rpm"), 105.0, 1e-12);
    // Golden number 17: U_per of G 16 for the mass that turns, here that of all of it.
    let graded = report(&run(1, &["shaft", "dpi-shaft", "--set", "limits.balance_grade=16", "--dry-run", "--json"]));
    let told = &graded["shaft"];
    let omega = 105.0 * std::f64::consts::PI / 30.0;
    close(number(told, "permissible_g_mm"), 16_000.0 * number(told, "mass_kg") / omega, 1e-12);
}

/// The tables: both sides of a step, the asymptote of a stiff support, the lift over a turn.
/// A massless shaft with a thin disc has one forward critical speed; it is reported with a note if more are requested.
#[test]
fn fewer_critical_speeds_than_asked_are_given_with_a_note() {
    let directory = tempfile::tempdir().expect("a directory");
    let text = "name = \"one\"\n[shaft]\nbeam = \"euler\"\n[[shaft.segment]]\nlength = \"600 mm\"\ndiameter = \"50 mm\"\ndensity = \"0 kg/m3\"\n\
                modulus = \"210 GPa\"\npoisson = 0.3\n[[shaft.support]]\nat = \"0 mm\"\nstiffness = \"rigid\"\n[[shaft.support]]\nat = \"400 mm\"\n\
                stiffness = \"rigid\"\n[[shaft.disc]]\nat = \"550 mm\"\nmass = \"20 kg\"\ndiametral_inertia = \"0.15 kg*m2\"\npolar_inertia = \"0.28 kg*m2\"\n";
    fs::write(directory.path().join("one.toml"), text).expect("written");
    let ran = camgen_in(directory, &["shaft", "one.toml", "--modes", "2", "--dry-run"]);
    assert!(
        ran.code == 0 && ran.out.contains("the shaft has 1 critical speed: number 2 does not exist"),
        "{}{}",
        ran.out,
        ran.err
    );
    let ran =
        camgen_in(ran.directory, &["shaft", "one.toml", "--whirl", "planar", "--modes", "2", "--dry-run", "--json"]);
    assert_eq!(report(&ran)["shaft"]["critical_rpm"].as_array().map(Vec::len), Some(2));
}

#[test]
fn the_tables_tell_the_shaft_and_the_lift() {
    let made = run(
        0,
        &["shaft", "dpi-shaft", "--sweep", "1e8N/m .. 1e12N/m", "--steps", "4", "--samples", "90", "--format", "csv"],
    );
    let output = made.directory.path().join("output");
    let names = files(&output);
    assert_eq!(names.len(), 3, "{names:?}");
    let read = |ending: &str| -> (Vec<String>, Vec<Vec<f64>>) {
        let name = names.iter().find(|name| name.ends_with(ending)).expect("a table");
        let text = fs::read_to_string(output.join(name)).expect("a table");
        let mut lines = text.lines();
        let head = lines.next().expect("a head").split(',').map(str::to_owned).collect();
        (head, lines.map(|line| line.split(',').map(|value| value.parse().expect("a number")).collect()).collect())
    };
    let (head, along) = read("35rpm.csv");
    let expected = "x_mm,diameter_mm,bore_mm,mode1,mode2,mode3,deflection_um_per_kn,slope_urad_per_kn"
        .split(',')
        .collect::<Vec<_>>();
    assert_eq!(head, expected);
    let steps: Vec<&Vec<f64>> = along.iter().filter(|row| (row[0] - 40.0).abs() < 1e-9).collect();
    assert_eq!(steps.iter().map(|row| row[1]).collect::<Vec<_>>(), [45.0, 50.0], "both sides of a step");
    assert!(along.windows(2).all(|pair| pair[0][0] <= pair[1][0]), "from left to right");
    let (head, sweep) = read("-sweep.csv");
    assert_eq!(head, ["stiffness_n_per_m", "n1_rpm", "n2_rpm", "n3_rpm"]);
    assert_eq!((sweep.len(), sweep[0][0], sweep[4][0]), (5, 1e8, 1e12));
    assert!(sweep.windows(2).all(|pair| pair[0][1] < pair[1][1]), "stiffer supports, higher speeds");
    let (head, lift) = read("-lift.csv");
    let expected = "cam_deg,force_n,pressure_angle_deg,bending_mm,twist_mm,lift_error_mm,residual_n"
        .split(',')
        .collect::<Vec<_>>();
    assert_eq!((head, lift.len()), (expected.into_iter().map(str::to_owned).collect(), 90));
    for row in &lift {
        assert!((row[3] + row[4] - row[5]).abs() < 1e-12 && row[5] >= 0.0 && row[5] < 0.4515, "{row:?}");
    }
}

/// Nothing of the shaft is made by other commands: the cam is the same, and so are its bytes but for the names.
#[test]
fn a_shaft_changes_no_cam() {
    let cut = |machine: &str| {
        let made = run(0, &["rotary", machine, "--format", "csv", "--name", "cam"]);
        fs::read(made.directory.path().join("output/cam.csv")).expect("a table")
    };
    assert_eq!(cut("dpi"), cut("dpi-shaft"));
}

#[test]
fn faults_of_a_shaft_have_a_place_and_a_remedy() {
    for (set, told) in [
        ("shaft.support.2.at=20mm", "two supports are at 20mm"),
        ("shaft.support.2.at=400mm", "beyond the end of the shaft"),
        ("shaft.cam_at=1m", "beyond the end of the shaft"),
        ("shaft.segment.1.bore=45mm", "bore must be below diameter"),
        ("shaft.segment.2.diameter=60mm", "the bore of the cam, 50 mm, is not the diameter of the shaft"),
        ("shaft.segment.1.density=-1kg/m3", "must be at least 0"),
        ("shaft.support.1.stiffness=0 N/m", "must be above 0"),
        ("shaft.segment.9.length=1mm", "the file has 3 of [[shaft.segment]]"),
    ] {
        let refused = run(2, &["shaft", "dpi-shaft", "--set", set]);
        assert!(refused.err.contains(told) && refused.err.contains("-->"), "{set}: {}", refused.err);
        assert!(!refused.directory.path().join("output").exists());
    }
    for (args, told) in [
        (&["shaft", "dpi"][..], "the file describes no shaft"),
        (&["shaft", "--solver", "paper", "--modes", "2"], "first critical speed only"),
        (&["shaft", "--stations", "9"], "--stations belongs to --solver paper"),
        (&["shaft", "--sweep", "1e9 N/m .. 1e8 N/m"], "from the smaller to the larger"),
        (
            &[
                "shaft",
                "--set",
                "shaft.support.1.stiffness=rigid",
                "--set",
                "shaft.support.2.stiffness=rigid",
                "--sweep",
                "1e8N/m..1e9N/m",
            ],
            "every support of this shaft is rigid",
        ),
        (
            &[
                "shaft",
                "--set",
                "shaft.segment.1.density=0kg/m3",
                "--set",
                "shaft.segment.2.density=0kg/m3",
                "--set",
                "shaft.segment.3.density=0kg/m3",
            ],
            "no mass that can move",
        ),
    ] {
        let refused = run(2, args);
        assert!(refused.err.contains(told), "{args:?}: {}", refused.err);
    }
    let text = fs::read_to_string("profiles/press-cylinder.toml").expect("a profile");
    let disc = "[[shaft.disc]]\nat = \"500 mm\"\n";
    for (more, told) in [
        (disc.to_owned(), "neither a mass nor a size"),
        (format!("{disc}mass = \"2 kg\"\nwidth = \"20 mm\"\n"), "a mass or a size, not both"),
        (
            format!("{disc}mass = \"2 kg\"\ndiametral_inertia = \"1 kg*m2\"\npolar_inertia = \"3 kg*m2\"\n"),
            "no body has that",
        ),
    ] {
        let directory = tempfile::tempdir().expect("a directory");
        fs::write(directory.path().join("own.toml"), format!("{text}\n{more}")).expect("a file");
        let refused = camgen_in(directory, &["shaft", "own.toml"]);
        assert!(
            refused.code == 2 && refused.err.contains(told) && refused.err.contains("own.toml:"),
            "{}",
            refused.err
        );
    }
    let one = text.replacen("[[shaft.support]]", "# [[shaft.support]]", 1).replacen(
        "at = \"0 mm\"\nstiffness",
        "# at\n# stiffness",
        1,
    );
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("own.toml"), one).expect("a file");
    let refused = camgen_in(directory, &["shaft", "own.toml"]);
    assert!(refused.code == 2 && refused.err.contains("two supports at least"), "{}", refused.err);
}
