//! The hash of the inputs: every value that has an effect changes it, nothing else does.

use crate::common::program::{camgen, camgen_in, files, report, run};
use camgen::catalogue::{analyses, catalogue, kinds};
use camgen::document::Presence::Required;
use camgen::document::{Key, KeyForm, KeySection, Occurrence};
use camgen::machine::Machine;
use camgen::motion::EccentricCircle;
use camgen::motion::laws::LAWS;
use camgen::pipeline::Spec;
use camgen::report::Inputs;
use camgen::units::Dimension;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestRunner};
use std::fs;

const LIFTER: &str = include_str!("common/lifter.toml");

/// With this the machine is one whose follower swings.
const OF_ARMS: &str = "cam.counter.preload=0N";

/// With this it is a plate.
const OF_A_PLATE: &str = "cam.run_in=20mm";
const PLATE: &str = "name = \"plate\"\n[motion]\nstroke = \"200 mm\"\nstart = \"0 mm\"\n[[motion.segment]]\nover = \"20 mm\"\n\
                     to = \"5 mm\"\n[[motion.segment]]\nlaw = \"dwell\"\n[follower.roller]\nradius = \"10 mm\"\n\
                     [cam]\nbody = \"wedge\"\n";

/// A key that means something only beside another.
const BESIDE: [(&str, &str); 8] = [
    ("cam.compensate_train", "cam.train_stiffness=1e8 N/m"),
    ("motion.stroke", OF_A_PLATE),
    // Of a follower that swings.
    ("cam.counter.arm", OF_ARMS),
    ("cam.counter.included_angle", OF_ARMS),
    ("cam.bore_fit", "cam.bore_radius=20mm"),
    ("follower.roller.crown", "follower.roller.width=20mm"),
    ("motion.measured_at", "motion.output_arm=150mm"),
    ("motion.output_arm", "motion.measured_at=output"),
];

const POINTS: &str =
    "points = [[\"0 deg\", \"0 mm\"], [\"90 deg\", \"9 mm\"], [\"180 deg\", \"5 mm\"], [\"270 deg\", \"0 mm\"]]\n";

/// The motion through rows in which a key of `[motion]` means something.
fn form_for(key: &str) -> Option<String> {
    let half = "points = [[\"0 deg\", \"0 mm\"], [\"40 deg\", \"4 mm\"], [\"80 deg\", \"9 mm\"], [\"120 deg\", \"5 mm\"], [\"160 deg\", \"0 mm\"]]";
    Some(match key {
        "rest" | "shape" | "smooth" => POINTS.to_owned(),
        "mirror" => format!("{half}\nrest = \"dwell\""),
        "columns" => "table = \"wide.csv\"\ncolumns = [1, 2]".to_owned(),
        "unit" | "scale" | "ratio" => "table = \"turn0.csv\"".to_owned(),
        "step" => "table = \"list.csv\"\nstep = \"60 deg\"\nrest = \"dwell\"".to_owned(),
        "lift" => "table = \"shares.csv\"\nlift = \"8 mm\"".to_owned(),
        "over" => "table = \"turns.csv\"\nover = \"360 deg\"\nrest = \"dwell\"".to_owned(),
        _ => return None,
    })
}

/// The lifter, with what a key of a segment asks for beside itself.
fn lifter_for(sets: &[String]) -> String {
    let key =
        sets.last().and_then(|set| set.split_once('=')).map_or("", |(path, _)| path.rsplit('.').next().unwrap_or(""));
    if sets.iter().any(|set| set == OF_A_PLATE) {
        return PLATE.to_owned();
    }
    let of_law = |law: &str| LIFTER.replacen("3-4-5", law, 1);
    if ["motion.measured_at", "motion.output_arm"].iter().any(|key| sets.iter().any(|set| set.starts_with(key))) {
        let swinging = "[follower.swinging-roller]\narm = \"90 mm\"\npivot_distance = \"120 mm\"\nside = \"trailing\"";
        return LIFTER.replacen("[motion]", "[motion]\noutput_arm = \"140 mm\"", 1).replacen(
            "[follower.roller]",
            swinging,
            1,
        );
    }
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
        return format!("{head}{}[follower.roller]{follower}", if key == "degree" { POINTS } else { "" });
    }
    if let Some(form) = form_for(key).filter(|_| !path.starts_with("motion.segment") && path.starts_with("motion.")) {
        let (head, _) = LIFTER.split_once("[[motion.segment]]").expect("segments");
        let (_, follower) = LIFTER.split_once("[follower.roller]").expect("a follower");
        return format!("{head}{form}\n[follower.roller]{follower}");
    }
    match key {
        "formula" => of_law("formula"),
        "points" => of_law("spline"),
        "minimise" => LIFTER.replacen("\"3-4-5\"", "\"polynomial\"\ndegree = 9", 1),
        "degree" => of_law("polynomial\"\nminimise = \"peak-acceleration"),
        "ratio" | "robust" => of_law("polynomial\"\ndegree = 11\nratio = 2.5\nminimise = \"residual"),
        "table" => of_law("table"),
        "ends" | "shape" | "smooth" => of_law("table\"\ntable = \"law0.csv"),
        "until" => LIFTER.replacen("over =", "until =", 1),
        "by" => LIFTER.replacen("to =", "by =", 1),
        "start" if path.starts_with("motion.segment") => of_law("polynomial"),
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
fn machine(section: &KeySection, sets: &[String]) -> Option<Machine> {
    let keys = section.keys.iter().filter(|key| matches!(key.presence, Required(_)));
    let examples = keys.clone().map(|key| format!("{}={}", section.path_of(key), key.presence.text()));
    if sets.iter().any(|set| set == OF_ARMS) {
        return Machine::load("lever", sets).ok().map(|(machine, _)| machine);
    }
    if section.path == "linkage" {
        // A rod is given as a ratio or as a length.
        let by_length = sets.iter().any(|set| set.starts_with("linkage.rod="));
        let rod = if by_length { "" } else { "rod_ratio = 3\n" };
        let text = include_str!("../../profiles/dpi-six-bar.toml").replace("rod_ratio = 3 ", &format!("{rod}# "));
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
            include_str!("../../profiles/dpi-shaft.toml").replace("bore_radius = \"25 mm\"", "")
        );
        return Machine::from_toml("shaft.toml", &text, sets).ok();
    }
    if section.path == "spring_buffer.body" {
        // Wire and coils are given together, in the place of the index.
        let by_wire = sets.iter().any(|set| set.contains("body.wire") || set.contains("body.coil"));
        let shape = if by_wire { "wire = \"18 mm\"\ncoil = \"108 mm\"\n" } else { "" };
        let press = include_str!("../../profiles/dpi.toml");
        let text = format!("{press}\n[spring_buffer.body]\nstress = \"700 MPa\"\n{shape}");
        return Machine::from_toml("springs.toml", &text, sets).ok();
    }
    if ["cam.hub", "cam.timing_mark"].contains(&section.path) {
        let press = include_str!("../../profiles/dpi.toml");
        let table = match section.path {
            "cam.hub" => "[cam.hub]\ndiameter = \"60 mm\"\nlength = \"20 mm\"\n",
            _ => "[cam.timing_mark]\ncircle_diameter = \"100 mm\"\n",
        };
        return Machine::from_toml("features.toml", &format!("{press}\n{table}"), sets).ok();
    }
    if section.path == "cam.holes" {
        let press = include_str!("../../profiles/dpi.toml");
        let text = format!("{press}\n[[cam.holes]]\ndiameter = \"6 mm\"\ncircle_diameter = \"80 mm\"\n");
        return Machine::from_toml("holes.toml", &text, sets).ok();
    }
    if section.path.starts_with("brake") {
        let roll = include_str!("../../profiles/roll.toml");
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
        write("wide.csv", "0,0,1\n90,9,8\n200,3,4\n");
        write("list.csv", "0\n4\n9\n3\n0\n");
        write("shares.csv", "0,0\n90,1\n200,0.3\n");
        write("turns.csv", "0,0\n0.2,3\n0.5,9\n0.8,4\n1,0\n");
        write("lifter.toml", &lifter_for(sets));
        return Machine::load(&folder.path().join("lifter.toml").display().to_string(), sets)
            .ok()
            .map(|(machine, _)| machine);
    }
    if let Some(own) = section.path.strip_suffix(".bearing") {
        let of = if own == "follower.roller" { "feeder" } else { "lever" };
        let all: Vec<String> = examples.chain(sets.iter().cloned()).collect();
        return Machine::load(of, &all).ok().map(|(machine, _)| machine);
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
        section.occurs != Occurrence::Once
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
        let unit_at = || text.find(|c: char| c.is_alphabetic() || c == '%');
        let is_bare = text.trim().parse::<f64>().is_ok();
        let (number, unit) = text.split_at(if is_bare { None } else { unit_at() }.unwrap_or(text.len()));
        let number: f64 = number.trim().parse().unwrap_or(1.0);
        let changed = if number == 0.0 { share } else { number * share };
        format!("{changed} {unit}").trim().to_owned()
    };
    let example = key.presence.text();
    match key.form {
        KeyForm::Text if key.name == "law" => LAWS[index as usize % LAWS.len()].name.to_owned(),
        KeyForm::Text if ["velocity", "acceleration", "jerk"].contains(&key.name) => scaled(example),
        KeyForm::Text if key.name == "formula" && example.contains("th") => format!("{}*(1-cos(th))", index + 1),
        KeyForm::Text if key.name == "formula" => format!("x^{}", index + 1),
        KeyForm::Points(..) => {
            example.replace("\"4 mm", &format!("\"{share} mm")).replace("\"20 mm", &format!("\"{share} mm"))
        }
        KeyForm::Columns if example.contains("lift") => format!("turn{index}.csv"),
        KeyForm::Columns => format!("law{index}.csv"),
        KeyForm::Number(_) if key.name == "degree" && key.presence.text() == "5" => "3".to_owned(),
        KeyForm::Number(_) if key.name == "degree" => (8 + index).to_string(),
        KeyForm::Number(_) if key.name == "ratio" && key.about.contains("shaft") => (0.95 - 0.01 * share).to_string(),
        KeyForm::Number(_) if key.name == "ratio" => (2.0 + share).to_string(),
        _ if key.name == "inflection" => share.min(0.9).to_string(),
        KeyForm::Numbers(_) if key.name == "fractions" => {
            format!("[{0}, {0}, {0}, {1}]", 0.1 * share, 1.0 - 0.3 * share)
        }
        KeyForm::Numbers(_) if key.name == "amplitudes" => format!("[7, {share}, -2]"),
        KeyForm::Number(_)
            if ["tool", "program", "decimals", "finish_passes", "samples", "seed", "count"].contains(&key.name) =>
        {
            (3 + index % 4).to_string()
        }
        KeyForm::Number(_) if key.name.starts_with("waves_") => (20 + index).to_string(),
        KeyForm::Number(_) if key.name == "repeat" => (index + 1).to_string(),
        KeyForm::Texts => format!("[1, {}]", 2 + index % 2),
        KeyForm::Text if key.name == "unit" => ["in", "cm", "um"][index as usize % 3].to_owned(),
        KeyForm::Text if key.name == "smooth" => scaled(example),
        KeyForm::Text if ["bore_fit", "fit"].contains(&key.name) => format!("F{}", 6 + index % 4),
        KeyForm::Quantity(..) if key.name == "step" => format!("{} deg", 40.0 * share),
        KeyForm::Text => format!("text {index}"),
        KeyForm::Boolean => index.is_multiple_of(2).to_string(),
        KeyForm::Words(words) => words[index as usize % words.len()].to_owned(),
        KeyForm::WordsOrQuantity(words, ..) if index > 4 => words[index as usize % words.len()].to_owned(),
        KeyForm::WordsOrQuantity(words, Dimension::Angle, _) if words.contains(&example) => {
            format!("{} deg", 50.0 * share)
        }
        KeyForm::WordsOrQuantity(words, dimension, _) if words.contains(&example) => {
            let unit = if dimension == Dimension::Force { "N" } else { "mm" };
            format!("{} {unit}", 100.0 * share)
        }
        KeyForm::Numbers(_) => format!("[{share}]"),
        KeyForm::Band(..) => {
            example.split_once("..").map_or_else(String::new, |(a, b)| format!("{} .. {}", a.trim(), scaled(b.trim())))
        }
        KeyForm::Pair(..) => {
            let bare = example.replace(['[', ']', '"'], "");
            bare.split_once(',').map_or_else(String::new, |(a, b)| format!("[{}, {}]", scaled(a.trim()), b.trim()))
        }
        KeyForm::Number(_) if index < 4 => (1.0 / f64::from(index + 2)).to_string(),
        _ => scaled(example),
    }
}

/// Every key of the table, on every kind of cam: another value changes the hash exactly where the key has an effect.
#[test]
fn every_key_that_has_an_effect_changes_the_hash() {
    let draws = (0.3..1.7_f64, 0..8_u32);
    let mut runner = TestRunner::new(Config { cases: 24, ..Config::default() });
    // A drive is read by itself.
    for section in catalogue().keys.sections.iter().filter(|section| section.path != "drive") {
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
                for kind in kinds().chain(analyses()) {
                    let named = !section.cams_of(key).is_empty();
                    let idle = named && !catalogue().keys.has_effect(section, key, kind.keys);
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
        vec!["--cutter-radius", "5mm"],
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
        assert_eq!(files(run.directory.path()).len(), 5);
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

/// A machine may be called by the word for a number that is none.
#[test]
fn a_machine_may_be_called_inf() {
    for command in ["linkage dpi-six-bar", "rotary dpi", "regimes dpi", "make feeder"] {
        let args: Vec<&str> =
            command.split(' ').chain(["--set", "name=inf", "--name", "x", "--format", "svg"]).collect();
        run(0, &args);
    }
}

/// A machine file of somebody else may name any file as a table: messages show its numbers, and of other text a few characters.
#[test]
fn a_table_is_not_read_out() {
    let secret = "root:$6$pYq8Zk3V$9eTq0bW7wNfQ:19000:0:99999:7:::\ndaemon:*:19000:0:99999:7:::\n";
    let text = "name = \"t\"\n[motion]\nstart = \"0 mm\"\ntable = \"secret\"\n[follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"auto\"\n";
    for table in [format!("0 0\n{secret}"), secret.to_owned(), format!("1,2\n3,4\n{secret}")] {
        let directory = tempfile::tempdir().expect("a directory");
        fs::write(directory.path().join("secret"), table).expect("written");
        fs::write(directory.path().join("cam.toml"), text).expect("written");
        let refused = camgen_in(directory, &["make", "cam.toml"]);
        assert_eq!(refused.code, 2, "{}", refused.err);
        assert!(!refused.err.contains("pYq8") && !refused.err.contains("99999"), "{}", refused.err);
    }
}

/// A design whose motion is a table, and a table of a rise and a return.
fn with_table(table: &str) -> (String, String) {
    let text = format!(
        "name = \"t\"\n[motion]\nstart = \"0 mm\"\ntable = {table:?}\n[follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"auto\"\n"
    );
    let row = |angle: i32| format!("{angle}, {:.6}\n", 5.0 - 5.0 * f64::from(angle).to_radians().cos());
    (text, (0..360).step_by(5).map(row).collect())
}

/// A table is read from the folder of the machine file and below it, links resolved; elsewhere where the user says so, by a flag or
/// by naming the file.
#[test]
fn tables_lie_in_the_folder_of_their_machine() {
    let directory = tempfile::tempdir().expect("a directory");
    let (inside, outside) = (directory.path().join("own/sub"), directory.path().join("other"));
    fs::create_dir_all(&inside).expect("made");
    fs::create_dir_all(&outside).expect("made");
    let rows = with_table("").1;
    for file in [directory.path().join("own/rows.csv"), inside.join("rows.csv"), outside.join("rows.csv")] {
        fs::write(file, &rows).expect("written");
    }
    #[cfg(unix)]
    std::os::unix::fs::symlink("../other/rows.csv", directory.path().join("own/link.csv")).expect("linked");
    let absolute = outside.join("rows.csv").display().to_string();
    let mut run = camgen_in(directory, &["--version"]);
    let mut tried = |table: &str, args: &[&str], code: i32| {
        fs::write(run.directory.path().join("own/cam.toml"), with_table(table).0).expect("written");
        let directory = std::mem::replace(&mut run.directory, tempfile::tempdir().expect("a directory"));
        run = camgen_in(directory, &[&["make", "own/cam.toml", "--rpm", "60", "--dry-run", "--force"], args].concat());
        assert!((run.code == 2) == (code == 2), "{table} {args:?}: {}{}", run.out, run.err);
        if code == 2 {
            for told in [table, "own`", "--allow-path", "outside of the folder of the machine file"] {
                assert!(run.err.contains(told), "{table}: {told}: {}", run.err);
            }
        }
    };
    for table in ["rows.csv", "sub/rows.csv", "./rows.csv", "sub/../rows.csv"] {
        tried(table, &[], 0);
    }
    let links: &[&str] = if cfg!(unix) { &["link.csv"] } else { &[] };
    for table in ["../other/rows.csv", &absolute].into_iter().chain(links.iter().copied()) {
        tried(table, &[], 2);
        tried(table, &["--allow-path", "other"], 0);
        tried(table, &["--allow-path", "own", "--allow-path", "other"], 0);
        tried(table, &["--allow-path", "own/sub"], 2);
        // What the user types is the user's own.
        tried("rows.csv", &["--set", &format!("motion.table={table}")], 0);
    }
    let run = camgen(&["rotary", "--allow-path", "none"]);
    assert!(run.code == 2 && run.err.contains("--allow-path: cannot open the folder `none`"), "{}", run.err);
}

/// Every command that reads a machine file takes the flag.
#[test]
fn every_command_takes_the_folder_of_tables() {
    let directory = tempfile::tempdir().expect("a directory");
    let mut run = camgen_in(directory, &["--allow-path", ".", "machines"]);
    for command in ["rotary", "translating", "conoid", "regimes", "spring", "drive", "check", "make", "laws", "size"] {
        run = camgen_in(run.directory, &[command, "--allow-path", ".", "--help"]);
        assert!(run.code == 0 && run.out.contains("--allow-path"), "{command}: {}{}", run.out, run.err);
    }
}
