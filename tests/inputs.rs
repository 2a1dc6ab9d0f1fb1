//! The hash of the inputs: every value that has an effect changes it, nothing else does.

#![allow(clippy::expect_used, clippy::panic, missing_docs, reason = "a test fails loudly")]

#[path = "common/program.rs"]
mod program;

use camgen::analysis;
use camgen::body::KINDS;
use camgen::document::Presence::Required;
use camgen::document::{Form, Key, Occurs, Section};
use camgen::machine::{Machine, sections};
use camgen::motion::EccentricCircle;
use camgen::motion::laws::LAWS;
use camgen::pipeline::Spec;
use camgen::report::Inputs;
use camgen::units::Dimension;
use program::{camgen, files, report};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestRunner};
use std::fs;

const LIFTER: &str = include_str!("common/lifter.toml");

/// A key that means something only beside another.
const BESIDE: [(&str, &str); 1] = [("follower.roller.crown", "follower.roller.width=20mm")];

/// The lifter, with what a key of a segment asks for beside itself.
fn lifter_for(sets: &[String]) -> String {
    let key =
        sets.last().and_then(|set| set.split_once('=')).map_or("", |(path, _)| path.rsplit('.').next().unwrap_or(""));
    let of_law = |law: &str| LIFTER.replacen("3-4-5", law, 1);
    let path = sets.last().map_or("", String::as_str);
    if path.starts_with("motion.polydyne") {
        let (head, _) = LIFTER.split_once("[[motion.segment]]").expect("segments");
        let (_, follower) = LIFTER.split_once("[follower.roller]").expect("a follower");
        let load = "formula = \"9*(1-cos(th))\"\npolydyne = { natural_frequency = \"40 Hz\" }\n";
        return format!("{head}{load}[follower.roller]{follower}");
    }
    if !path.starts_with("motion.segment")
        && ["formula=", "points=", "degree=", "table=", "cos=", "sin="].iter().any(|key| path.contains(key))
    {
        let (head, _) = LIFTER.split_once("[[motion.segment]]").expect("segments");
        let (_, follower) = LIFTER.split_once("[follower.roller]").expect("a follower");
        let points = "points = [[\"0 deg\", \"0 mm\"], [\"90 deg\", \"9 mm\"], [\"180 deg\", \"3 mm\"]]\n";
        return format!("{head}{}[follower.roller]{follower}", if key == "degree" { points } else { "" });
    }
    match key {
        "formula" => of_law("formula"),
        "points" => of_law("spline"),
        "minimise" => LIFTER.replacen("\"3-4-5\"", "\"polynomial\"\ndegree = 9", 1),
        "degree" => of_law("polynomial\"\nminimise = \"peak-acceleration"),
        "ratio" | "robust" => of_law("polynomial\"\ndegree = 11\nratio = 2.5\nminimise = \"residual"),
        "table" => of_law("table"),
        "ends" => of_law("table\"\ntable = \"law0.csv"),
        "until" => LIFTER.replacen("over =", "until =", 1),
        "by" => LIFTER.replacen("to =", "by =", 1),
        "acceleration" | "jerk" => {
            of_law("polynomial").replacen("law = \"dwell\"", "law = \"polynomial\"\nto = \"21 mm\"", 1)
        }
        "velocity" | "end" | "inflection" => of_law("cycloidal").replacen("law = \"dwell\"", "to = \"21 mm\"", 1),
        "fractions" => of_law("scca"),
        "line" => of_law("sine-line"),
        "amplitudes" => of_law("triple-harmonic"),
        "ramp" => of_law("s-curve"),
        "repeat" => LIFTER.replace("120 deg", "30 deg").replace("60 deg", "20 deg"),
        _ => LIFTER.to_owned(),
    }
}

/// A machine with a table, all of whose keys are given that must be.
fn machine(section: &Section, sets: &[String]) -> Option<Machine> {
    let keys = section.keys.iter().filter(|key| matches!(key.presence, Required(_)));
    let examples = keys.clone().map(|key| format!("{}={}", section.path_of(key), key.presence.text()));
    if section.path == "linkage" {
        // A rod is given as a ratio or as a length.
        let by_length = sets.iter().any(|set| set.starts_with("linkage.rod="));
        let rod = if by_length { "" } else { "rod_ratio = 3\n" };
        let text = include_str!("../profiles/dpi-six-bar.toml").replace("rod_ratio = 3 ", &format!("{rod}# "));
        return Machine::from_toml("six-bar.toml", &text, sets).ok();
    }
    if section.path.starts_with("shaft") {
        let by_size = sets.iter().any(|set| {
            ["diameter", "bore", "width", "material"].iter().any(|key| set.contains(&format!("disc[0].{key}")))
        });
        let disc = if by_size {
            "diameter = \"120 mm\"\nwidth = \"20 mm\""
        } else {
            "mass = \"2 kg\"\ndiametral_inertia = \"1 kg*m2\""
        };
        let text = format!(
            "{}\n[[shaft.disc]]\nat = \"290 mm\"\n{disc}\n",
            include_str!("../profiles/dpi-shaft.toml").replace("bore_radius = \"25 mm\"", "")
        );
        return Machine::from_toml("shaft.toml", &text, sets).ok();
    }
    if section.path.starts_with("brake") {
        let roll = include_str!("../profiles/roll.toml");
        let text = if section.path == "brake.ends" {
            let (head, _) = roll.split_once("[brake.roll]").expect("a roll");
            let (_, tail) = roll.split_once("[follower.roller]").expect("a follower");
            format!("{head}[brake.ends]\nwrap = [\"90 deg\", \"45 deg\"]\n[follower.roller]{tail}")
        } else {
            roll.to_owned()
        };
        return Machine::from_toml("roll.toml", &text, sets).ok();
    }
    if section.path.starts_with("motion") {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
        for index in 0..8 {
            write(&format!("turn{index}.csv"), &format!("0,0\n120,2{index}\n240,3\n"));
            write(&format!("law{index}.csv"), &format!("0,0\n0.5,0.4{index}\n1,1\n"));
        }
        write("lifter.toml", &lifter_for(sets));
        return Machine::load(&folder.path().join("lifter.toml").display().to_string(), sets)
            .ok()
            .map(|(machine, _)| machine);
    }
    if section.path.starts_with("follower.") && section.path != "follower.roller" {
        let (head, _) = LIFTER.split_once("[follower.roller]").expect("a follower");
        let keys: Vec<String> =
            keys.map(|key| format!("{} = {}", key.name, key.in_toml(key.presence.text()))).collect();
        let keys = keys.join("\n");
        let tables = [head.to_owned(), head.replace(" mm", " deg")]
            .map(|motion| Machine::from_toml("x", &format!("{motion}[{}]\n{keys}", section.path), sets).ok());
        return tables.into_iter().flatten().next();
    }
    let examples = examples.filter(|_| {
        section.occurs != Occurs::Once
            && (section.path.contains("keyway")
                || ["compensator", "guide", "vibration", "flywheel"].contains(&section.path))
    });
    Machine::load("dpi", &examples.chain(sets.iter().cloned()).collect::<Vec<_>>()).ok().map(|(machine, _)| machine)
}

fn hash(machine: &Machine, command: &str) -> String {
    Inputs::of(&machine.inputs(command)).hash
}

/// Another value of a key than its example, by a share of it.
fn another(key: &Key, share: f64, index: u32) -> String {
    let scaled = |text: &str| {
        let end = text.find(|c: char| c.is_alphabetic() || c == '%').unwrap_or(text.len());
        let (number, unit) = text.split_at(end);
        let number: f64 = number.trim().parse().unwrap_or(1.0);
        let changed = if number == 0.0 { share } else { number * share };
        format!("{changed} {unit}").trim().to_owned()
    };
    let example = key.presence.text();
    match key.form {
        Form::Text if key.name == "law" => LAWS[index as usize % LAWS.len()].name.to_owned(),
        Form::Text if ["velocity", "acceleration", "jerk"].contains(&key.name) => scaled(example),
        Form::Text if key.name == "formula" && example.contains("th") => format!("{}*(1-cos(th))", index + 1),
        Form::Text if key.name == "formula" => format!("x^{}", index + 1),
        Form::Points(..) => {
            example.replace("\"4 mm", &format!("\"{share} mm")).replace("\"20 mm", &format!("\"{share} mm"))
        }
        Form::Columns if example.contains("lift") => format!("turn{index}.csv"),
        Form::Columns => format!("law{index}.csv"),
        Form::Number(_) if key.name == "degree" && key.presence.text() == "5" => "3".to_owned(),
        Form::Number(_) if key.name == "degree" => (8 + index).to_string(),
        Form::Number(_) if key.name == "ratio" => (2.0 + share).to_string(),
        Form::Text if key.name == "inflection" => share.min(0.9).to_string(),
        Form::Numbers(_) if key.name == "fractions" => format!("[{0}, {0}, {0}, {1}]", 0.1 * share, 1.0 - 0.3 * share),
        Form::Numbers(_) if key.name == "amplitudes" => format!("[7, {share}, -2]"),
        Form::Number(_) if key.name == "repeat" => (index + 1).to_string(),
        Form::Text => format!("text {index}"),
        Form::Boolean => index.is_multiple_of(2).to_string(),
        Form::Words(words) => words[index as usize % words.len()].to_owned(),
        Form::WordsOrQuantity(words, ..) if index > 4 => words[index as usize % words.len()].to_owned(),
        Form::WordsOrQuantity(words, dimension, _) if words.contains(&example) => {
            let unit = if dimension == Dimension::Force { "N" } else { "mm" };
            format!("{} {unit}", 100.0 * share)
        }
        Form::Numbers(_) => format!("[{share}]"),
        Form::Band(..) => {
            example.split_once("..").map_or_else(String::new, |(a, b)| format!("{} .. {}", a.trim(), scaled(b.trim())))
        }
        Form::Pair(..) => {
            let bare = example.replace(['[', ']', '"'], "");
            bare.split_once(',').map_or_else(String::new, |(a, b)| format!("[{}, {}]", scaled(a.trim()), b.trim()))
        }
        Form::Number(_) if index < 4 => (1.0 / f64::from(index + 2)).to_string(),
        _ => scaled(example),
    }
}

/// Every key of the table, on every kind of cam: another value changes the hash exactly where the key has an effect.
#[test]
fn every_key_that_has_an_effect_changes_the_hash() {
    let draws = (0.3..1.7_f64, 0..8_u32);
    let mut runner = TestRunner::new(Config { cases: 24, ..Config::default() });
    // A drive is read by itself.
    for section in sections().into_iter().filter(|section| section.path != "drive") {
        for key in section.keys {
            let path = section.path_of(key).replace("[]", "[0]");
            let mut changed = 0;
            for _ in 0..24 {
                let (share, index) = draws.new_tree(&mut runner).expect("a draw").current();
                let beside: Vec<String> =
                    BESIDE.iter().filter(|(of, _)| *of == path).map(|(_, set)| (*set).into()).collect();
                let sets = [&beside[..], &[format!("{path}={}", another(key, share, index))]].concat();
                let before = machine(section, &beside).expect("a machine with this table");
                let Some(after) = machine(section, &sets) else { continue };
                for kind in KINDS.iter().chain(analysis::KINDS) {
                    let cams = section.cams_of(key);
                    let idle = !cams.is_empty() && !cams.contains(&kind.keys);
                    let same_value = before.inputs(kind.keys) == after.inputs(kind.keys);
                    let same_hash = hash(&before, kind.keys) == hash(&after, kind.keys);
                    assert_eq!(same_value, same_hash, "{sets:?} on a {}", kind.noun);
                    assert!(!idle || same_hash, "{sets:?} on a {}", kind.noun);
                    changed += usize::from(!same_hash);
                }
            }
            // A start is also where the last segment ends: neither can be changed alone.
            assert!(changed > 0 || path == "motion.start", "no value of {path} changed the hash");
        }
    }
}

#[test]
fn the_start_of_a_motion_changes_the_hash() {
    let moved = LIFTER.replace("\"0 mm\"", "\"2 mm\"");
    let of = |text: &str| hash(&Machine::from_toml("lifter.toml", text, &[]).expect("in range"), "make");
    assert_ne!(of(LIFTER), of(&moved));
}

/// Two sets of values have the same hash only where they are the same values.
#[test]
fn hashes_agree_where_the_values_do() {
    let value = (1..4_u32, 0..3_usize);
    let strategy = prop::collection::vec(value, 2);
    let set = |draws: &[(u32, usize)]| {
        let (a, unit) = draws[0];
        let radius = match unit {
            0 => format!("{}mm", 10 * a + 10),
            1 => format!("{}cm", a + 1),
            _ => format!("0.0{}m", a + 1),
        };
        let thickness = 10 * draws[1].0;
        let overrides = [format!("follower.roller.radius={radius}"), format!("cam.thickness={thickness}mm")];
        let (machine, _) = Machine::load("dpi", &overrides).expect("in range");
        ((a, thickness), hash(&machine, "rotary"))
    };
    let mut runner = TestRunner::new(Config { cases: 200, ..Config::default() });
    runner
        .run(&(strategy.clone(), strategy), |(a, b)| {
            let ((values_a, hash_a), (values_b, hash_b)) = (set(&a), set(&b));
            prop_assert_eq!(values_a == values_b, hash_a == hash_b, "{:?} {:?}", a, b);
            Ok(())
        })
        .expect("for all");
}

fn hash_of(args: &[&str]) -> String {
    let run = camgen(&[args, &["--json"]].concat());
    assert!(run.code < 2, "{args:?}: {}", run.err);
    report(&run)["inputs"]["hash"].as_str().expect("a hash").to_owned()
}

#[test]
fn flags_that_change_the_part_change_the_hash_and_no_others() {
    let plain = hash_of(&["rotary"]);
    for same in [
        vec!["--name", "x"],
        vec!["--out", "elsewhere"],
        vec!["--format", "dxf,json"],
        vec!["--samples", "36"],
        vec!["--dxf-version", "r12"],
        vec!["--tolerance", "0.005mm"],
        vec!["--accuracy", "standard"],
        vec!["--rpm", "35"],
        vec!["--set", "follower.roller.radius=3cm"],
        vec!["--set", "translating.delta=50deg"],
    ] {
        assert_eq!(hash_of(&[&["rotary"][..], &same].concat()), plain, "{same:?}");
    }
    let mut hashes = vec![plain, hash_of(&["translating"]), hash_of(&["conoid", "--rpm", "35"])];
    for other in [
        vec!["--rpm", "34"],
        vec!["--tolerance", "6um"],
        vec!["--side", "inside"],
        vec!["--side", "outside"],
        vec!["--outline", "spline"],
        vec!["--cutter", "5mm"],
        vec!["--tolerance-velocity", "2%"],
        vec!["--tolerance-acceleration", "4%"],
        vec!["--tolerance-acceleration", "none"],
        vec!["--set", "follower.roller.radius=29mm"],
        vec!["--set", "name=another press"],
    ] {
        hashes.push(hash_of(&[&["rotary"][..], &other].concat()));
    }
    for other in [vec!["--solver", "paper"], vec!["--solver", "paper", "--stations", "900"], vec!["--balance", "mean"]]
    {
        hashes.push(hash_of(&[&["translating"][..], &other].concat()));
    }
    hashes.push(hash_of(&["conoid", "--rpm", "20,35"]));
    hashes.push(hash_of(&["conoid", "--rpm", "20..35", "--residual", "2N"]));
    hashes.push(hash_of(&["conoid", "--rpm", "20..35", "--residual", "3N"]));
    let all = hashes.len();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), all, "{hashes:?}");
}

/// Every file that can carry it does.
#[test]
fn files_carry_the_hash() {
    for (version, command) in [("r12", "rotary"), ("r2000", "rotary"), ("r2013", "translating")] {
        let formats = "dxf,svg,step,json";
        let run = camgen(&[command, "--dxf-version", version, "--format", formats, "--name", "cam", "--json"]);
        let hash = report(&run)["inputs"]["hash"].as_str().expect("a hash").to_owned();
        let mark = format!("camgen {}, inputs {hash}", env!("CARGO_PKG_VERSION"));
        let read = |ending: &str| {
            fs::read_to_string(run.directory.path().join("output").join(format!("cam.{ending}"))).expect("a file")
        };
        assert_eq!(files(run.directory.path()).len(), 4);
        assert!(read("dxf").starts_with(&format!("999\n{mark}\n  0\nSECTION\n")));
        assert!(read("svg").contains(&format!("<!-- {mark} -->")));
        assert!(read("step").contains(&format!("'{mark}'")));
        assert!(read("json").contains(&format!("\"hash\": \"{hash}\"")));
    }
}

/// Of a motion of one's own the hash knows samples.
#[test]
fn a_motion_of_ones_own_is_known_by_samples() {
    let hash = |eccentricity: f64| {
        let spec =
            Spec::builder("eccentric").roller(0.01).base_radius(0.04).motion(EccentricCircle::new(eccentricity, 0.05));
        let cam = spec.expect("in range").solve().expect("a cam");
        cam.draw(5e-6).expect("drawn").prove().expect("proved").report().inputs_hash().to_owned()
    };
    assert_eq!(hash(0.003), hash(0.003));
    assert_ne!(hash(0.003), hash(0.003_000_1));
}
