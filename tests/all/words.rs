//! Words and units as people type them: what is accepted, and that it means the same.

use crate::common::program::{Run, files, finding, make, number, report};
use camgen::Machine;
use std::fs;

const LIFTER: &str = "name = \"lifter\"\n[motion]\nrpm = 120\nstart = \"0 mm\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nover = \"120 deg\"\n\
                      to = \"20 mm\"\n[[motion.segment]]\nlaw = \"3-4-5\"\nover = \"120 deg\"\nto = \"0 mm\"\n[[motion.segment]]\n\
                      law = \"dwell\"\n[follower.roller]\nradius = \"12 mm\"\nmass = \"2 kg\"\npreload = \"400 N\"\n\
                      [cam]\nbase_radius = \"40 mm\"\nbore_radius = \"10 mm\"\nthickness = \"15 mm\"\n";
const LEVER: &str = "name = \"lever\"\n[motion]\nrpm = 120\nstart = \"0 deg\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nover = \"120 deg\"\n\
                     to = \"TO\"\n[[motion.segment]]\nlaw = \"3-4-5\"\nover = \"120 deg\"\nto = \"FROM\"\n[[motion.segment]]\n\
                     law = \"dwell\"\n[follower.swinging-roller]\nradius = \"12 mm\"\narm = \"110 mm\"\npivot_distance = \"140 mm\"\n\
                     [cam]\nbase_radius = \"50 mm\"\nbore_radius = \"10 mm\"\nthickness = \"15 mm\"\n";

const SWINGING: &str = r#"name = "random 901"
[motion]
rpm = 720
start = "0 deg"
[[motion.segment]]
over = "42.704859 deg"
to = "11.193 deg"
law = "s-curve"
inflection = 0.4665
[[motion.segment]]
over = "45.580981 deg"
law = "dwell"
[[motion.segment]]
over = "101.013776 deg"
law = "dwell"
[[motion.segment]]
over = "68.513260 deg"
law = "dwell"
[[motion.segment]]
to = "0.0 deg"
law = "modified-sine-cv20"
inflection = 0.5498
[follower.swinging-roller]
radius = "10.51 mm"
arm = "55.7987 mm"
pivot_distance = "68.0408 mm"
side = "leading"
[cam]
base_radius = "27.000 mm"
rotation = "ccw"
"#;

/// The bytes of the cut file.
#[track_caller]
fn cut(run: &Run) -> String {
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    let names = files(&run.directory.path().join("output"));
    let name = names.iter().find(|name| name.ends_with("rpm.dxf")).expect("a DXF file");
    fs::read_to_string(run.directory.path().join("output").join(name)).expect("read")
}

/// The geometry of a cut file: all but the comment with the hash of the inputs.
fn geometry(file: &str) -> &str {
    file.splitn(3, '\n').nth(2).expect("a comment")
}

#[track_caller]
fn cut_of(text: &str, set: &[&str]) -> String {
    let sets: Vec<&str> = set.iter().flat_map(|set| ["--set", set]).collect();
    cut(&make(text, &[&["--format", "dxf", "-q"][..], &sets].concat()))
}

/// A diameter in the file or after --set gives the bytes of its radius, and the last word is that of --set.
#[test]
fn a_diameter_gives_the_bytes_of_its_radius() {
    let by_radius = cut_of(LIFTER, &[]);
    let by_diameter = LIFTER
        .replace("radius = \"12 mm\"", "diameter = \"24 mm\"")
        .replace("bore_radius = \"10 mm\"", "bore_diameter = \"Ø20 mm\"")
        .replace("base_radius = \"40 mm\"", "base_diameter = \"80 mm\"");
    assert_eq!(cut_of(&by_diameter, &[]), by_radius);
    let other = LIFTER.replace("radius = \"12 mm\"", "radius = \"9 mm\"");
    assert_eq!(cut_of(&other, &["follower.roller.diameter=24mm"]), by_radius);
    let other = by_diameter.replace("diameter = \"24 mm\"", "diameter = \"9 mm\"");
    assert_eq!(cut_of(&other, &["follower.roller.radius=12mm"]), by_radius);
    let told = make(&by_diameter, &["--dry-run"]).out;
    assert!(told.contains("base radius 40 mm, roller Ø24 mm, prime radius 52 mm"), "{told}");
}

/// What is wrong with a diameter is shown where it was typed.
#[test]
fn a_fault_of_a_diameter_is_at_its_place() {
    let text = LIFTER.replace("bore_radius = \"10 mm\"", "bore_diameter = \"90 mm\"");
    let error = Machine::from_toml("cam.toml", &text, &[]).expect_err("too large").to_string();
    assert!(error.contains("bore_radius must be below base_radius: Ø90 mm ≥ 40 mm"), "{error}");
    assert!(error.contains("bore_diameter = \"90 mm\""), "{error}");
    let error = Machine::from_toml("cam.toml", &LIFTER.replace("radius = \"12 mm\"", "diameter = \"0 mm\""), &[]);
    assert!(error.expect_err("no roller").to_string().contains("`follower.roller.diameter` must be above 0 mm"));
}

#[test]
fn units_are_read_as_they_are_typed() {
    let plain = cut_of(LIFTER, &[]);
    for (from, to) in [
        ("120 deg", "120°"),
        ("120 deg", "120 DEG"),
        ("12 mm", "12 MM"),
        ("12 mm", "1.2cm"),
        ("2 kg", "2000 g"),
        ("2 kg", "2 KG"),
        ("400 N", "0.4kN"),
        ("400 N", "40 daN"),
    ] {
        assert_eq!(cut_of(&LIFTER.replace(from, to), &[]), plain, "{from} as {to}");
    }
    let spring = LIFTER.replace("preload = \"400 N\"", "") + "[spring]\nrate = \"8 N/mm\"\npreload = \"400 N\"\n";
    let other = spring.replace("8 N/mm", "8 kN/m");
    assert_eq!(cut_of(&spring, &[]), cut_of(&other, &[]));
}

/// Where a word or a number is taken, a number needs no quotes.
#[test]
fn numbers_are_numbers() {
    let with = |value: &str| LIFTER.replacen("over = ", &format!("inflection = {value}\nover = "), 1);
    let given = cut_of(&with("0.4665"), &[]);
    assert_eq!(given, cut_of(&with("\"0.4665\""), &[]));
    assert_ne!(given, cut_of(LIFTER, &[]), "the inflection has an effect");
    // A design of a user whose segments have numbers for words.
    let reported = |text: &str| {
        let run = make(text, &["--json", "--dry-run"]);
        assert!(run.code < 2, "{}", run.err);
        run.out
    };
    let swinging = reported(SWINGING);
    let quoted = SWINGING.replace("inflection = 0.4665", "inflection = \"0.4665\"");
    assert_eq!(swinging, reported(&quoted.replace("inflection = 0.5498", "inflection = \"0.5498\"")));
    let title = format!("{LIFTER}[title]\npart_number = 417\nrevision = 2\ndate = 2026-11-22\n");
    let machine = Machine::from_toml("cam.toml", &title, &[]).expect("numbers and a date");
    let typed = |key: &str| machine.inputs("make").into_iter().find(|input| input.key == key).map(|input| input.typed);
    assert_eq!(typed("title.part_number").as_deref(), Some("417"));
    assert_eq!(typed("title.date").as_deref(), Some("2026-11-22"));
    // A number that has no unit is answered with the unit.
    let error = Machine::from_toml("cam.toml", &LIFTER.replacen("over = ", "velocity = 2\nover = ", 1), &[]);
    let error = error.expect_err("no unit").to_string();
    assert!(error.contains("`velocity`: `2` has no unit") && error.contains("mm/deg"), "{error}");
}

/// Lengths along an arc are the angles arc / arm, to the last digit of the arithmetic.
#[test]
fn positions_of_a_swinging_follower_may_be_lengths() {
    let angles = |length: f64, arm: f64| {
        let text = LEVER.replace("TO", &format!("{} rad", length / arm)).replace("FROM", "0 deg");
        geometry(&cut_of(&text, &[])).to_owned()
    };
    let lengths = LEVER.replace("start = \"0 deg\"", "start = \"0 mm\"").replace("TO", "30 mm").replace("FROM", "0 mm");
    let at = |keys: &str| lengths.replace("rpm = 120\n", &format!("rpm = 120\n{keys}\n"));
    let cut_at = |keys: &str| geometry(&cut_of(&at(keys), &[])).to_owned();
    let by_roller = cut_at("measured_at = \"roller\"");
    assert_eq!(by_roller, angles(0.03, 0.11));
    assert_eq!(cut_at("output_arm = \"150 mm\""), angles(0.03, 0.15));
    assert_eq!(cut_at("measured_at = \"output\"\noutput_arm = \"150 mm\""), angles(0.03, 0.15));
    assert_eq!(cut_at("measured_at = \"roller\"\noutput_arm = \"150 mm\""), by_roller);
    // A formula in the unit of start, and a velocity at the end of a segment.
    let formula = |start: &str, keys: &str, amplitude: f64| {
        let (_, rest) = LEVER.split_once("[follower").expect("a follower");
        format!(
            "name = \"x\"\n[motion]\nrpm = 120\nstart = \"{start}\"\n{keys}\nformula = \"{amplitude}*(1-cos(th))\"\n[follower{rest}"
        )
    };
    let reach = |text: &str| {
        let report = report(&make(text, &["--json", "--dry-run"]));
        number(&report["cam"]["max_lift_deg"])
    };
    let found = reach(&formula("0 mm", "measured_at = \"roller\"", 15.0));
    assert!((found - (0.03_f64 / 0.11).to_degrees()).abs() < 1e-9, "{found}");
    // The message of lengths without an arc gives the angles that are right.
    let error = Machine::from_toml("cam.toml", &lengths, &[]).expect_err("lengths").to_string();
    assert!(error.contains("30 mm along the arc of the roller (arm 110 mm) is \"15.6261 deg\""), "{error}");
    let told = LEVER.replace("TO", "15.6261 deg").replace("FROM", "0 deg");
    assert!((reach(&told) - found).abs() < 5e-5);
}

/// Every material has the limit that the report names, with where it is from.
#[test]
fn materials_are_named_as_shops_write_them() {
    for (material, limit, words) in [
        ("\"42CrMo4\"", Some(760.0), "ISO 6336-5"),
        ("1.7225", Some(760.0), "42CrMo4"),
        ("\"GG 25\"", Some(330.0), "EN-GJL-250"),
        ("\"16MnCr5\"", Some(1500.0), "58 HRC"),
        ("\"POM-C\"", None, "give cam.contact_limit"),
        ("\"POM-C\"\ncontact_limit = \"60 MPa\"", Some(60.0), "cam.contact_limit"),
        ("\"C45\"\ncontact_limit = \"1100 MPa\"", Some(1100.0), "cam.contact_limit"),
    ] {
        let text = LIFTER.replace("[cam]\n", &format!("[cam]\nmaterial = {material}\n"));
        let run = make(&text, &["--json", "--dry-run"]);
        let report = report(&run);
        let found = finding(&report, "contact_stress");
        assert_eq!(found["limit"].as_f64().map(f64::round), limit, "{material}: {found}");
        let notes = report["notes"].to_string();
        assert!(notes.contains(words), "{material}: {notes}");
    }
}

/// Faults of every table come in one go, each with its line, also one between motion and follower.
#[test]
fn every_fault_comes_at_once() {
    let text = LEVER
        .replace("start = \"0 deg\"", "start = \"0 mm\"")
        .replace("TO", "30 mm")
        .replace("FROM", "0 mm")
        .replace("law = \"3-4-5\"", "law = \"345x\"")
        .replace("rpm = 120", "rpm = -120")
        .replace("thickness = \"15 mm\"", "thickness = \"1,5 mm\"\nwidth = \"3 mm\"");
    let error = Machine::from_toml("cam.toml", &text, &[]).expect_err("five faults");
    let lines: Vec<usize> =
        error.faults.iter().map(|fault| fault.place.as_ref().map_or(0, |place| place.line)).collect();
    assert_eq!(lines, [3, 4, 10, 22, 23], "{error}");
}
