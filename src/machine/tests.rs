use super::*;
use crate::analysis;
use crate::body::KINDS;
use crate::buffer::bottom_law::Column;
use crate::document::cams::{CONOID, MAKE, ROTARY, TRANSLATING};
use crate::document::{Form, Key};
use crate::follower::FollowerKind;
use crate::motion::equation_18::EfficiencyModel;

fn dpi(overrides: &[&str]) -> Result<Machine, MachineError> {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Machine::load("dpi", &overrides).map(|(machine, _)| machine)
}

fn message(overrides: &[&str]) -> String {
    dpi(overrides).expect_err("a fault").to_string()
}

#[test]
fn every_embedded_machine_and_the_template_read() {
    for embedded in EMBEDDED {
        if embedded.toml.contains("\n[drive]") {
            let (drive, stem) = DriveMachine::load(embedded.name, &[]).expect("a drive");
            assert_eq!((stem.as_str(), drive.column), (embedded.name, 0.485));
            assert_eq!(drive.name(), embedded.title());
            continue;
        }
        if embedded.toml.contains("\n[brake]") {
            let (brake, stem) = BrakeMachine::load(embedded.name, &[], Wanted::Figures).expect("a brake");
            assert_eq!((stem.as_str(), brake.name()), (embedded.name, embedded.title()));
            continue;
        }
        if embedded.toml.contains("\n[shaft]") && !embedded.toml.contains("\n[bed]") {
            let (shaft, stem) = ShaftMachine::load(embedded.name, &[]).expect("a shaft");
            assert_eq!((stem.as_str(), shaft.name()), (embedded.name, embedded.title()));
            assert!(shaft.machine().is_none());
            continue;
        }
        let (machine, stem) = Machine::load(embedded.name, &[]).unwrap_or_else(|e| panic!("{}: {e}", embedded.name));
        assert_eq!((stem.as_str(), machine.name()), (embedded.name, embedded.title()));
        assert_eq!(machine.motion().is_some(), embedded.toml.contains("\n[motion]"));
        assert_eq!(machine.press().is_ok(), machine.translating.is_some() && machine.conoid.is_some());
    }
    let template = include_str!("../../templates/machine.toml");
    assert!(Machine::from_toml("template", template, &[]).is_ok());
}

#[test]
fn an_override_replaces_a_value() {
    let machine = dpi(&["follower.roller.radius=25mm", "cam.base_radius = auto", "cam.lever=2"]).expect("valid");
    assert_eq!(machine.roller().expect("a roller").radius, 0.025);
    assert_eq!(machine.cam.lever, 2.0);
}

#[test]
fn faults_name_value_place_and_remedy() {
    for (set, parts) in [
        ("bed.mass=978.2", vec!["has no unit", "kg, lb", "--set:1:"]),
        ("bed.mass=978 mm", vec!["unit of length, not of mass"]),
        ("bed.mass=-3 kg", vec!["must be above 0 kg", "-3 kg"]),
        ("bed.mass=0 kg", vec!["must be above 0 kg"]),
        ("bed.mass=nan kg", vec!["not a finite number"]),
        ("bed.mass=1e300 kg", vec!["at most 10000000 kg"]),
        ("bed.mass=heavy", vec!["does not start with a number"]),
        ("buffer.end_pressure=0.9 at", vec!["end_pressure must be above ambient_pressure: 0.9 at ≤ 1 at"]),
        ("buffer.column=long", vec!["or \"matched\" or \"return\""]),
        ("transition.kind=smooth", vec!["one of \"run-up\", \"blend\", \"none\""]),
        ("cam.thicknes=3 mm", vec!["unknown key `cam.thicknes`", "did you mean `cam.thickness`?"]),
        ("cam.bore_radius", vec!["no `=`"]),
        ("design.rpm=0", vec!["must be at least 0.001"]),
        ("cam.thickness=0.1um", vec!["must be at least 1 um"]),
        ("design.rpm=35 rpm", vec!["not a bare number"]),
        ("name=", vec!["must be a text"]),
        ("cam.keyway.width=8mm", vec!["missing key `cam.keyway.depth`"]),
        ("cam.keyway.widht=8mm", vec!["did you mean `cam.keyway.width`?"]),
        ("cam.balance=40mm", vec!["must be a band", "35 mm .. 60 mm"]),
        ("cam.balance=60mm .. 40mm", vec!["from the smaller to the larger"]),
        ("cam.balance=20mm .. 40mm", vec!["must begin outside the bore of 25 mm"]),
        ("follower.roller.mass=0kg", vec!["must be above 0 kg"]),
        ("follower.roller.preload=5kg", vec!["unit of mass, not of force"]),
        ("limits.contact_stress=5", vec!["has no unit", "MPa"]),
    ] {
        let text = message(&[set]);
        for part in parts {
            assert!(text.contains(part), "{set}: no {part:?} in\n{text}");
        }
    }
}

#[test]
fn several_faults_of_a_file_come_at_once_in_its_order() {
    let toml = "name = \"x\"\n[bed]\nmass = 5\ncrank_radius = \"180 kg\"\n[follower.roller]\nradius = true\n[camm]\nlever = 1\n";
    let error = Machine::from_toml("bad.toml", toml, &[]).expect_err("faults");
    let text = error.to_string();
    for part in [
        "bad.toml:3:8",
        "bad.toml:4:16",
        "bad.toml:6:10",
        "missing key `buffer.ambient_pressure`",
        "bad.toml:8:1",
        "^^^^^\n",
        "did you mean `cam.lever`?",
    ] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let lines: Vec<usize> = error.faults.iter().filter_map(|f| f.place.as_ref()).map(|p| p.line).collect();
    assert!(lines.is_sorted(), "{lines:?}");
    let broken = Machine::from_toml("bad.toml", "name = \n[bed\n", &[]).expect_err("not TOML").to_string();
    assert!(broken.contains("not TOML") && broken.contains("bad.toml:1:"), "{broken}");
}

#[test]
fn keys_in_disguise_and_empty_tables_are_unknown() {
    let dpi = EMBEDDED[0].toml;
    for (toml, part) in [
        (format!("\"bed.mass\" = \"1 kg\"\n{dpi}"), "unknown key `\"bed.mass\"`"),
        (format!("{dpi}\n[foo]\n"), "unknown table `foo`"),
        (format!("{dpi}\n[limits.zzz]\n"), "unknown table `limits.zzz`"),
        (format!("{dpi}\n[cam.keyway]\n"), "missing key `cam.keyway.width`"),
    ] {
        let text = Machine::from_toml("press.toml", &toml, &[]).expect_err(part).to_string();
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let broken = Machine::from_toml("bad.toml", "name=\"a\"\n[bed\n", &[]).expect_err("not TOML");
    assert_eq!(broken.faults.len(), 1, "only what is wrong with the text: {broken}");
}

#[test]
fn files_that_cannot_be_read_are_told() {
    for (path, part) in [("no-such.toml", "cannot read"), ("src", "directory"), ("/dev/zero", "a pipe or a device")] {
        let text = Machine::load(path, &[]).expect_err(path).to_string();
        assert!(text.contains(part) && text.contains("dpi-paper"), "{text}");
    }
}

#[test]
fn a_bad_word_is_one_fault() {
    let error = dpi(&["cam.material=wood"]).expect_err("no such material");
    assert_eq!(error.faults.len(), 1, "{error}");
    assert!(error.to_string().contains("`cam.material` cannot be \"wood\""), "{error}");
}

/// Faults of every sort in one file: each is told once, and nothing that only follows from another.
#[test]
fn faults_of_every_sort_come_at_once() {
    let file = [
        "name = 7",
        "\"bed.mass\" = \"1 kg\"",
        "colour = \"red\"",
        "[bed]",
        "mass = \"978.2\"",
        "crank_radius = \"180 kg\"",
        "crank_turns_per_main_shaft_turn = \"three\"",
        "[buffer]",
        "ambient_pressure = \"1 at\"",
        "end_pressure = \"0.9 at\"",
        "column = \"long\"",
        "lead = [1]",
        "[follower.roller]",
        "radius = \"0 mm\"",
        "crown = \"cylinder\"",
        "[cam]",
        "bore_radius = \"25 furlongs\"",
        "base_radius = \"20 mm\"",
        "material = \"wood\"",
        "balance = \"60 mm .. 40 mm\"",
        "rotation = true",
        "[cam.keyway]",
        "width = \"80 mm\"",
        "[limits]",
        "pressure_angle = \"91 deg\"",
        "[foo]",
    ]
    .join("\n");
    let overrides = ["cam.lever".to_owned(), "transition.kind=smooth".to_owned()];
    let error = Machine::from_toml("press.toml", &file, &overrides).expect_err("faults");
    let told: Vec<(usize, &str)> = error
        .faults
        .iter()
        .map(|fault| (fault.place.as_ref().map_or(0, |place| place.line), fault.message.as_str()))
        .collect();
    let expected = [
        (0, "--set cam.lever: no `=`"),
        (0, "missing key `cam.keyway.depth` in press.toml"),
        (1, "`name` must be a text"),
        (2, "unknown key `\"bed.mass\"`"),
        (3, "unknown key `colour`"),
        (5, "`bed.mass`: `978.2` has no unit"),
        (6, "`bed.crank_radius`: `kg` is a unit of mass, not of length"),
        (7, "`bed.crank_turns_per_main_shaft_turn`: `three` does not start with a number"),
        (10, "end_pressure must be above ambient_pressure: 0.9 at ≤ 1 at"),
        (11, "`buffer.column`: `long` does not start with a number"),
        (12, "`buffer.lead` must be a quantity of length, not array"),
        (14, "`follower.roller.radius` must be above 0 mm: 0 mm"),
        (15, "a cylindrical roller needs a width"),
        (17, "`cam.bore_radius`: unknown unit `furlongs`"),
        (19, "`cam.material` cannot be \"wood\""),
        (20, "`cam.balance` must go from the smaller to the larger: 60 mm .. 40 mm"),
        (21, "`cam.rotation` must be a word"),
        (25, "`limits.pressure_angle` must be at most 90 deg: 91 deg"),
        (26, "unknown table `foo`"),
        (1, "`transition.kind` cannot be \"smooth\""),
    ];
    assert_eq!(told, expected);
}

/// Every key with a value that is not the one it has in the profile, default or absence.
const OTHERS: &[(&str, &str)] = &[
    ("name", "another"),
    ("bed.mass", "900 kg"),
    ("bed.crank_radius", "170 mm"),
    ("bed.crank_turns_per_main_shaft_turn", "2"),
    ("linkage.kind", "crank-slider"),
    ("linkage.rod_ratio", "4"),
    ("linkage.rod", "600 mm"),
    ("linkage.offset_ratio", "0.1"),
    ("linkage.offset", "10 mm"),
    ("linkage.base_ratio", "0.2"),
    ("linkage.coupler_ratio", "0.9"),
    ("linkage.follower_ratio", "0.7"),
    ("linkage.follower_angle", "170 deg"),
    ("linkage.base_angle", "10 deg"),
    ("linkage.driving_crank", "200 mm"),
    ("buffer.polytropic_exponent", "1.4"),
    ("buffer.ambient_pressure", "1.1 at"),
    ("buffer.end_pressure", "3 at"),
    ("buffer.column", "200 mm"),
    ("buffer.lead", "1 mm"),
    ("design.rpm", "30"),
    ("motion.rpm", "120"),
    ("motion.start", "5 mm"),
    ("motion.at", "10 deg"),
    ("motion.repeat", "2"),
    ("motion.formula", "9*(1-cos(th))"),
    ("motion.points", "[[0 deg, 0 mm], [120 deg, 21 mm], [240 deg, 5 mm]]"),
    ("motion.degree", "3"),
    ("motion.table", "other.csv"),
    ("motion.fourier.cos", "[-9]"),
    ("motion.fourier.sin", "[2]"),
    ("motion.polydyne.natural_frequency", "50 Hz"),
    ("motion.polydyne.damping", "0.1"),
    ("motion.polydyne.rpm", "130"),
    ("motion.segment[0].law", "harmonic"),
    ("motion.segment[0].over", "170 deg"),
    ("motion.segment[0].until", "170 deg"),
    ("motion.segment[0].to", "10 mm"),
    ("motion.segment[0].by", "10 mm"),
    ("motion.segment[0].velocity", "1 mm/deg"),
    ("motion.segment[0].acceleration", "2 mm/rad2"),
    ("motion.segment[0].jerk", "3 mm/rad3"),
    ("motion.segment[0].end", "turn"),
    ("motion.segment[0].inflection", "0.4"),
    ("motion.segment[0].fractions", "[0.3, 0.2, 0.3, 0.2]"),
    ("motion.segment[0].line", "0.4"),
    ("motion.segment[0].amplitudes", "[7, 1, -2]"),
    ("motion.segment[0].ramp", "0.2"),
    ("motion.segment[0].formula", "x^4"),
    ("motion.segment[0].points", "[[30 deg, 4 mm], [60 deg, 16 mm]]"),
    ("motion.segment[0].table", "other-law.csv"),
    ("motion.segment[0].ends", "rest"),
    ("motion.segment[0].minimise", "peak-jerk"),
    ("motion.segment[0].degree", "11"),
    ("motion.segment[0].ratio", "3.7"),
    ("motion.segment[0].robust", "true"),
    ("follower.roller.radius", "25 mm"),
    ("follower.roller.offset", "5 mm"),
    ("follower.roller.mass", "40 kg"),
    ("follower.roller.preload", "1600 N"),
    ("follower.roller.crown", "cylinder"),
    ("follower.roller.width", "20 mm"),
    ("follower.roller.crown_radius", "400 mm"),
    ("follower.swinging-roller.radius", "20 mm"),
    ("follower.swinging-roller.arm", "100 mm"),
    ("follower.swinging-roller.pivot_distance", "150 mm"),
    ("follower.swinging-roller.side", "leading"),
    ("follower.swinging-roller.inertia", "0.03 kg*m2"),
    ("follower.swinging-roller.crown_radius", "400 mm"),
    ("follower.flat.tilt", "10 deg"),
    ("follower.flat.offset", "5 mm"),
    ("follower.flat.width", "50 mm"),
    ("follower.flat.mass", "40 kg"),
    ("follower.flat.preload", "1600 N"),
    ("follower.swinging-flat.pivot_distance", "160 mm"),
    ("follower.swinging-flat.face_offset", "5 mm"),
    ("follower.swinging-flat.side", "leading"),
    ("follower.swinging-flat.width", "50 mm"),
    ("follower.swinging-flat.inertia", "0.03 kg*m2"),
    ("follower.knife.offset", "5 mm"),
    ("follower.knife.mass", "40 kg"),
    ("follower.knife.preload", "1600 N"),
    ("spring.rate", "9 N/mm"),
    ("spring.preload", "130 N"),
    ("spring.damping", "30 N*s/m"),
    ("spring.load", "-20 N"),
    ("guide.friction", "0.2"),
    ("guide.span", "70 mm"),
    ("guide.overhang", "20 mm"),
    ("vibration.natural_frequency", "50 Hz"),
    ("vibration.damping", "0.05"),
    ("flywheel.fluctuation", "0.01"),
    ("cam.cam_turns_per_crank_turn", "0.5"),
    ("cam.lever", "2"),
    ("cam.base_radius", "90 mm"),
    ("cam.thickness", "20 mm"),
    ("cam.bore_radius", "20 mm"),
    ("cam.material", "bronze"),
    ("cam.balance", "40 mm .. 85 mm"),
    ("cam.rotation", "ccw"),
    ("cam.keyway.width", "9 mm"),
    ("cam.keyway.depth", "4 mm"),
    ("cam.keyway.angle", "90 deg"),
    ("transition.kind", "blend"),
    ("transition.width", "10 deg"),
    ("translating.roller_arm", "200 mm"),
    ("translating.bottom_arm", "200 mm"),
    ("translating.delta", "80 deg"),
    ("translating.friction_angle", "2 deg"),
    ("translating.efficiency", "0.9"),
    ("translating.efficiency_model", "printed"),
    ("translating.roller_radius", "20 mm"),
    ("translating.plate_height", "130 mm"),
    ("conoid.axial_travel", "100 mm"),
    ("conoid.mode", "fixed"),
    ("conoid.shift", "square"),
    ("conoid.overhang", "3 mm"),
    ("compensator.spring_rate", "90 N/mm"),
    ("compensator.preload", "9 kN"),
    ("compensator.roller_radius", "20 mm"),
    ("compensator.base_radius", "90 mm"),
    ("compensator.angle", "90 deg"),
    ("compensator.mass", "40 kg"),
    ("shaft.beam", "euler"),
    ("shaft.cam_at", "140 mm"),
    ("shaft.drive_at", "10 mm"),
    ("shaft.compensate", "true"),
    ("shaft.segment[0].length", "310 mm"),
    ("shaft.segment[0].diameter", "60 mm"),
    ("shaft.segment[0].bore", "10 mm"),
    ("shaft.segment[0].material", "bronze"),
    ("shaft.segment[0].modulus", "200 GPa"),
    ("shaft.segment[0].density", "7800 kg/m3"),
    ("shaft.segment[0].poisson", "0.31"),
    ("shaft.support[0].at", "30 mm"),
    ("shaft.support[0].stiffness", "rigid"),
    ("shaft.disc[0].at", "100 mm"),
    ("shaft.disc[0].mass", "3 kg"),
    ("shaft.disc[1].diameter", "130 mm"),
    ("shaft.disc[1].bore", "20 mm"),
    ("shaft.disc[1].width", "30 mm"),
    ("shaft.disc[1].material", "bronze"),
    ("shaft.disc[0].diametral_inertia", "0.003 kg*m2"),
    ("shaft.disc[0].polar_inertia", "0.003 kg*m2"),
    ("shaft.disc[0].unbalance", "10 g*mm"),
    ("shaft.disc[2].angle", "10 deg"),
    ("regimes.rpm", "[20, 25]"),
    ("regimes.reset", "half"),
    ("spring_buffer.stiffness", "100 N/mm"),
    ("limits.pressure_angle", "29 deg"),
    ("limits.pressure_angle_return", "40 deg"),
    ("limits.min_convex_pitch_radius_over_roller", "3"),
    ("limits.min_convex_radius", "5 mm"),
    ("limits.cutter_radius", "9 mm"),
    ("limits.wall", "4 mm"),
    ("limits.contact_stress", "1200 MPa"),
    ("limits.residual_share", "0.02"),
    ("limits.acceleration_share", "0.02"),
    ("limits.continuity", "2"),
    ("limits.jump_margin", "1.5"),
    ("limits.residual", "0.005"),
    ("limits.transmission_angle", "40 deg"),
    ("limits.rod_angle", "25 deg"),
    ("limits.link_ratio", "0.6"),
    ("limits.critical_speed_ratio", "0.6"),
    ("limits.lift_error", "0.2 mm"),
    ("limits.support_slope", "0.002 rad"),
    ("limits.balance_grade", "6.3"),
    ("limits.tension_spread", "0.04"),
    ("limits.web_stress", "11 MPa"),
    ("title.owner", "Works"),
    ("title.part_number", "7"),
    ("title.revision", "B"),
    ("title.date", "2026-01-02"),
    ("title.designer", "A. B."),
    ("title.approved", "C. D."),
    ("title.general_tolerance", "ISO 2768-fH"),
    ("title.surface_roughness", "Ra 1.6"),
];

/// A motion program behind a press, so that a file has every table that can stand in it.
const MOTION: &str = "\n[motion]\nstart = \"0 mm\"\n[[motion.segment]]\nover = \"180 deg\"\nto = \"20 mm\"\n\
                      [[motion.segment]]\nto = \"0 mm\"\n";

/// A shaft with every part, behind a press.
const SHAFT: &str = "\n[shaft]\ncam_at = \"150 mm\"\n[[shaft.segment]]\nlength = \"300 mm\"\ndiameter = \"50 mm\"\n\
                     [[shaft.support]]\nat = \"20 mm\"\nstiffness = \"5e8 N/m\"\n\
                     [[shaft.support]]\nat = \"280 mm\"\nstiffness = \"5e8 N/m\"\n\
                     [[shaft.disc]]\nat = \"290 mm\"\nmass = \"2 kg\"\ndiametral_inertia = \"0.002 kg*m2\"\npolar_inertia = \"0.002 kg*m2\"\n\
                     [[shaft.disc]]\nat = \"290 mm\"\ndiameter = \"120 mm\"\nwidth = \"20 mm\"\n\
                     [[shaft.disc]]\nat = \"290 mm\"\nmass = \"2 kg\"\nunbalance = \"9 g*mm\"\n";

/// What moves behind a follower on a straight path.
const DYNAMICS: &str = "\n[guide]\nfriction = 0.1\nspan = \"60 mm\"\n[vibration]\nnatural_frequency = \"40 Hz\"\n\
                        [flywheel]\nfluctuation = 0.02\n";

fn every_key() -> Vec<String> {
    sections().iter().flat_map(|section| section.keys.iter().map(|key| section.path_of(key))).collect()
}

/// All of a machine but the list of keys that were given. What the follower and the motion are, only their text tells.
fn alike(machine: Machine) -> String {
    format!("{:#?}", Machine { given: Vec::new(), overridden: Vec::new(), inputs: Vec::new(), ..machine })
}

/// A file of a press and a motion program, with the follower that a key belongs to, or a roller.
fn file_for(path: &str) -> String {
    let of = |kind: &&FollowerKind| path.strip_prefix(kind.section.path).is_some_and(|rest| rest.starts_with('.'));
    let section = FOLLOWERS.iter().find(of).unwrap_or(&FOLLOWERS[0]).section;
    let required = |key: &Key| match key.presence {
        Required(example) => format!("{} = {}\n", key.name, key.in_toml(example)),
        _ => String::new(),
    };
    let keys: String = section.keys.iter().map(required).collect();
    let press = without(EMBEDDED[0].toml, "follower.roller");
    // A cylindrical crown asks for a width.
    let width = if section.path == "follower.roller" { "width = \"10 mm\"\n" } else { "" };
    // A rod and an offset as lengths take the place of the ratios.
    let rod = if path == "linkage.rod" { "rod = \"540 mm\"\n" } else { "rod_ratio = 3\n" };
    let drag_link = "base_ratio = 0.1\ncoupler_ratio = 0.8\nfollower_ratio = 0.6\n";
    let six_bar = format!("[linkage]\nkind = \"six-bar\"\n{rod}{drag_link}");
    let linkage = if path.starts_with("linkage.") { six_bar } else { String::new() };
    let compensator = "[compensator]\nspring_rate = \"100 N/mm\"\npreload = \"10 kN\"\n";
    let keyway = "[cam.keyway]\nwidth = \"8 mm\"\ndepth = \"3 mm\"\n";
    // The cam sits on the shaft with its own bore only.
    let press = if path == "shaft.segment[0].diameter" {
        press.replace("bore_radius = \"25 mm\"", "bore_radius = \"30 mm\"")
    } else {
        press
    };
    let shaft = if path.starts_with("shaft.") { SHAFT } else { "" };
    let dynamics = if path.starts_with("follower.") { "" } else { DYNAMICS };
    let motion = motion_for(path);
    format!("{press}\n{keyway}{linkage}{compensator}[{}]\n{keys}{width}{motion}{dynamics}{shaft}", section.path)
}

/// A motion program in which a key of a segment means something.
fn motion_for(path: &str) -> String {
    let key = path.rsplit('.').next().unwrap_or_default();
    let form = |keys: &str| format!("\n[motion]\nstart = \"0 mm\"\n{keys}\n");
    let of_law = |law: &str| MOTION.replace("[[motion.segment]]\n", &format!("[[motion.segment]]\nlaw = \"{law}\"\n"));
    match key {
        _ if !path.starts_with("motion") => MOTION.to_owned(),
        "until" => MOTION.replace("over =", "until ="),
        "by" => MOTION.replacen("to =", "by =", 1),
        "repeat" => MOTION.replace("180 deg", "90 deg"),
        "acceleration" | "jerk" => of_law("polynomial"),
        "fractions" => of_law("scca"),
        "line" => of_law("sine-line"),
        "amplitudes" => of_law("triple-harmonic"),
        "ramp" => of_law("s-curve"),
        "formula" if path.starts_with("motion.segment") => of_law("formula\"\nformula = \"x^2"),
        "formula" => form("formula = \"10*(1-cos(th))\""),
        "points" if path.starts_with("motion.segment") => {
            MOTION.replacen("over", "law = \"spline\"\npoints = [[\"50 deg\", \"5 mm\"]]\nover", 1)
        }
        "minimise" | "degree" if path.starts_with("motion.segment") => {
            of_law("polynomial\"\ndegree = 9\nminimise = \"peak-acceleration")
        }
        "points" | "degree" => {
            form("points = [[\"0 deg\", \"0 mm\"], [\"90 deg\", \"9 mm\"], [\"180 deg\", \"3 mm\"]]")
        }
        "ratio" | "robust" => of_law("polynomial\"\ndegree = 9\nratio = 2.5\nminimise = \"residual"),
        "table" | "ends" if path.starts_with("motion.segment") => of_law("table\"\ntable = \"law.csv"),
        "table" => form("table = \"lift.csv\""),
        "natural_frequency" | "damping" | "rpm" if path.starts_with("motion.polydyne") => {
            form("formula = \"10*(1-cos(th))\"\npolydyne = { natural_frequency = \"40 Hz\", rpm = 120 }")
        }
        "cos" | "sin" => form("fourier = { cos = [-10], sin = [1] }"),
        _ => MOTION.to_owned(),
    }
}

/// A text as a machine; one that names tables as a file beside them.
fn read(text: &str, sets: &[String]) -> Result<Machine, MachineError> {
    if !text.contains(".csv\"") {
        return Machine::from_toml("press.toml", text, sets);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let turns = [("lift.csv", "0,0\n90,9\n200,3\n"), ("other.csv", "0,0\n90,8\n200,3\n360,0\n")];
    let laws = [("law.csv", "0 0\n0.4 0.5\n1 1\n"), ("other-law.csv", "0 0\n0.4 0.6\n1 1\n")];
    for (name, rows) in turns.into_iter().chain(laws).chain([("press.toml", text)]) {
        std::fs::write(folder.path().join(name), rows).expect("written");
    }
    Machine::load(&folder.path().join("press.toml").display().to_string(), sets).map(|(machine, _)| machine)
}

/// A file without one of its tables.
fn without(text: &str, table: &str) -> String {
    let header = format!("[{table}]");
    let mut inside = false;
    let kept = text.lines().filter(|line| {
        if line.starts_with('[') {
            inside = line.starts_with(&header);
        }
        !inside
    });
    kept.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_key_of_the_table_reaches_the_machine() {
    let open = |key: &str| ["[0]", "[1]", "[2]"].iter().fold(key.to_owned(), |key, index| key.replace(index, "[]"));
    let keys: Vec<String> = OTHERS.iter().map(|(key, _)| open(key)).collect();
    // A drive and a brake are read by themselves.
    let apart = |key: &String| key.starts_with("drive.") || key.starts_with("brake.");
    let all: Vec<String> = every_key().into_iter().filter(|key| !apart(key)).collect();
    assert_eq!(keys, all);
    for (key, value) in OTHERS {
        let text = file_for(key);
        let with = |sets: &[String]| {
            let text = if sets.is_empty() {
                text.replace("bore_radius = \"30 mm\"", "bore_radius = \"25 mm\"")
            } else {
                text.clone()
            };
            read(&text, sets).unwrap_or_else(|error| panic!("{sets:?}: {error}"))
        };
        let mut sets = vec![format!("{key}={value}")];
        if *key == "motion.start" {
            // A motion ends where it starts.
            sets.push("motion.segment[1].to=5 mm".into());
        }
        let other = with(&sets);
        assert!(other.given().contains(&(*key).to_owned()), "{key}");
        assert_ne!(alike(other), alike(with(&[])), "{key}");
    }
}

#[test]
fn every_word_of_a_key_reads() {
    for section in sections() {
        for key in section.keys {
            let (Form::Words(words) | Form::WordsOrQuantity(words, ..)) = key.form else { continue };
            for word in words {
                let path = section.path_of(key);
                // The first disc has a mass, the second a size.
                let index = if path == "shaft.disc[].material" { "[1]" } else { "[0]" };
                let set = format!("{}={word}", path.replace("[]", index));
                // A yoke has no links.
                let text = match *word {
                    "yoke" => without(&file_for(&path), "linkage"),
                    "residual" => file_for(&path).replace("over =", "ratio = 2.5\nover ="),
                    "moving" => file_for(&path).replace("over =", "velocity = \"1 mm/deg\"\nover ="),
                    _ => file_for(&path),
                };
                let read = read(&text, std::slice::from_ref(&set));
                assert!(read.is_ok(), "{set}: {}", read.expect_err("a fault"));
            }
        }
    }
}

#[test]
fn every_key_tells_what_it_is_and_for_which_cams() {
    for section in sections() {
        assert!(section.path.is_empty() || !section.about.is_empty(), "{}", section.path);
        for key in section.keys {
            assert!(!key.about.is_empty() && !key.presence.text().is_empty(), "{}", section.path_of(key));
            for cam in section.cams_of(key) {
                let known = KINDS.iter().chain(analysis::KINDS).any(|kind| kind.command == *cam);
                assert!(known, "{}: {cam}", section.path_of(key));
            }
        }
    }
}

#[test]
fn defaults_are_what_they_were() {
    let toml = "name = \"x\"\n[bed]\nmass = \"1 kg\"\ncrank_radius = \"1 m\"\n[buffer]\nambient_pressure = \"1 at\"\n\
                end_pressure = \"2 at\"\n[follower.roller]\nradius = \"30 mm\"\n[translating]\nroller_arm = \"1 m\"\n\
                bottom_arm = \"1 m\"\ndelta = \"90 deg\"\n[conoid]\naxial_travel = \"1 m\"\n";
    let machine = Machine::from_toml("least.toml", toml, &[]).expect("valid");
    let press = machine.press().expect("a press");
    assert_eq!((press.polytropic_exponent, press.column, press.lead), (1.35, AirColumn::Of(Column::Matched), 0.0));
    assert_eq!((press.bed.crank_turns_per_main_shaft_turn, press.design_rpm), (3.0, 35.0));
    let roller = RollerData { radius: 0.03, offset: 0.0, crown: Crown::Sphere, width: None };
    assert_eq!(machine.roller().expect("a roller"), &roller);
    assert_eq!((machine.follower.mass, machine.follower.preload), (None, None));
    assert_eq!((machine.cam.lobes, machine.cam.lever, machine.cam.base_radius), (1, 1.0, None));
    assert_eq!((machine.cam.thickness, machine.cam.material, machine.cam.rotation), (None, None, Rotation::Clockwise));
    assert_eq!(machine.transition, Transition::RunUp { width: std::f64::consts::PI / 9.0 });
    let plate = machine.translating.expect("a plate");
    assert_eq!((plate.friction_angle, plate.efficiency, plate.roller_radius), (0.0, 1.0, 0.03));
    assert_eq!((plate.efficiency_model, plate.plate_height), (EfficiencyModel::Consistent, None));
    let conoid = machine.conoid.expect("a conoid");
    assert_eq!((conoid.mode, conoid.shift, conoid.overhang), (ConoidMode::Adjusted, Shift::Linear, None));
    let limits = machine.limits;
    assert_eq!(limits.pressure_angle, Some(std::f64::consts::PI / 6.0));
    assert_eq!((limits.min_convex_pitch_radius_over_roller, limits.wall), (2.0, 0.0));
    assert_eq!((limits.cutter_radius, limits.contact_stress), (None, None));
}

/// A text with its commented keys and tables live.
fn with_everything(text: &str) -> String {
    let live = |line: &str| {
        let code = line.strip_prefix("# ").unwrap_or(line);
        let table = code.starts_with('[') && code.contains(']');
        let key = code.split_once(" = ").is_some_and(|(name, _)| !name.is_empty() && !name.contains(' '));
        if table || key { code.to_owned() } else { line.to_owned() }
    };
    text.lines().map(live).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_template_is_written_from_the_table() {
    let stored = include_str!("../../templates/machine.toml");
    assert!(stored == template(), "templates/machine.toml should be:\n{}", template());
    let machine = Machine::from_toml("template", stored, &[]).expect("it reads");
    let dpi = dpi(&[]).expect("valid");
    let expected = Machine {
        name: "my press".into(),
        cam: CamData { thickness: None, bore_radius: None, material: None, ..dpi.cam },
        translating: None,
        conoid: None,
        limits: Limits { cutter_radius: None, wall: 0.0, ..dpi.limits },
        ..dpi
    };
    assert_eq!(alike(machine), alike(expected));
}

#[test]
fn template_and_profiles_have_every_key() {
    let keys_of = |wanted: fn(&Section) -> bool| {
        let all = sections().into_iter().filter(|section| wanted(section));
        let mut keys: Vec<String> =
            all.flat_map(|section| section.keys.iter().map(|key| section.path_of(key))).collect();
        keys.sort();
        keys
    };
    // A profile is a press; the template has motion programs and their followers too.
    let (all, of_a_press) = (
        keys_of(|_| true),
        keys_of(|section| section.cams != [MAKE] && section.path != "drive" && !section.path.starts_with("brake")),
    );
    let template = template();
    let presses = EMBEDDED.iter().filter(|machine| {
        !["\n[drive]", "\n[shaft]", "\n[brake]", "\n[motion]"].iter().any(|table| machine.toml.contains(table))
    });
    let profiles = presses.map(|machine| (machine.name, machine.toml, &of_a_press));
    for (name, text, keys) in profiles.chain([("template", template.as_str(), &all)]) {
        let text = with_everything(text);
        // Of a linkage, a shaft and a motion not all keys go together; spring and guide are of a straight path.
        let apart = [
            "spring",
            "guide",
            "linkage",
            "shaft",
            "[shaft.segment]",
            "[shaft.support]",
            "[shaft.disc]",
            "motion",
            "motion.fourier",
            "motion.polydyne",
            "[motion.segment]",
        ];
        let read_with = |text: &str| {
            let text = apart.iter().fold(text.to_owned(), |text, table| without(&text, table));
            Machine::from_toml(name, &text, &[])
        };
        let sections: Vec<Section> = sections().iter().map(|section| Section { cams: &[], ..**section }).collect();
        let sections: Vec<&Section> = sections.iter().collect();
        let given = Reader::new(name, &text, &[], &sections).given(true);
        let given: Vec<String> = given.iter().map(|key| key.replace("[0]", "[]")).collect();
        assert_eq!(&given, keys, "{name}");
        // It reads with any one of its followers.
        let stands = |kind: &&FollowerKind| text.contains(&format!("[{}]", kind.section.path));
        for kind in FOLLOWERS.iter().filter(stands) {
            let others = FOLLOWERS.iter().filter(|other| other.section.path != kind.section.path);
            let text = others.fold(text.clone(), |text, other| without(&text, other.section.path));
            read_with(&text).unwrap_or_else(|error| panic!("[{}]: {error}", kind.section.path));
        }
    }
}

#[test]
fn the_schema_has_every_key() {
    let schema = schema();
    for path in every_key() {
        let key = path.split('.').fold(&schema, |table, name| match name.strip_suffix("[]") {
            Some(name) => &table["properties"][name]["items"],
            None => &table["properties"][name],
        });
        assert!(key["description"].is_string(), "{path}: {key}");
    }
    // A press is described as a whole or not at all, and a follower by one table of several.
    assert_eq!(schema["required"], serde_json::json!(["name", "follower"]));
    let follower = &schema["properties"]["follower"];
    assert_eq!((&follower["minProperties"], &follower["maxProperties"]), (&1.into(), &1.into()));
    assert_eq!(schema["properties"]["bed"]["required"], serde_json::json!(["mass", "crank_radius"]));
    assert_eq!(schema["properties"]["follower"]["properties"]["roller"]["required"], serde_json::json!(["radius"]));
    assert_eq!(schema["properties"]["cam"]["additionalProperties"], false);
}

#[test]
fn keys_without_effect_are_told_for_each_kind() {
    let sets = ["cam.balance=40mm .. 85mm", "cam.rotation=ccw", "conoid.overhang=3mm", "limits.contact_stress=1000MPa"];
    let machine = dpi(&sets).expect("valid");
    for (cam, idle) in [
        (ROTARY, &["conoid.overhang"][..]),
        (TRANSLATING, &["cam.balance", "cam.rotation", "conoid.overhang"]),
        (CONOID, &["cam.balance"]),
        (MAKE, &["conoid.overhang"]),
    ] {
        assert_eq!(machine.without_effect(cam), idle, "{cam}");
    }
    assert!(dpi(&[]).expect("valid").given().is_empty(), "nobody gave the keys of an embedded machine");
    let own = Machine::from_toml("dpi.toml", &format!("{}{MOTION}", EMBEDDED[0].toml), &[]).expect("valid");
    assert!(own.without_effect(ROTARY).is_empty(), "a file may describe all kinds");
    let shared = ["cam.cam_turns_per_crank_turn", "cam.lever", "cam.base_radius", "cam.bore_radius", "cam.rotation"];
    for key in shared {
        assert!(own.without_effect(TRANSLATING).contains(&key.to_owned()), "{key}");
    }
}

/// Bed, buffer and design speed are one press: any of them asks for the others.
#[test]
fn a_press_is_described_as_a_whole_or_not_at_all() {
    let roller = "name = \"x\"\n[follower.roller]\nradius = \"30 mm\"\n";
    let machine = Machine::from_toml("roller.toml", roller, &[]).expect("no press is needed");
    assert!(machine.press().is_err() && machine.motion().is_none());
    let why = machine.press().expect_err("no press").to_string();
    assert!(why.contains("[bed], [buffer] and [design]") && why.contains("camgen make"), "{why}");
    for table in ["[bed]", "[buffer]", "[design]"] {
        let text = Machine::from_toml("part.toml", &format!("{roller}{table}\n"), &[]).expect_err(table).to_string();
        for key in ["bed.mass", "bed.crank_radius", "buffer.ambient_pressure", "buffer.end_pressure"] {
            assert!(text.contains(&format!("missing key `{key}`")), "{table}: no {key} in\n{text}");
        }
    }
}

#[test]
fn a_base_radius_out_of_the_follower_s_reach_is_told_at_its_place() {
    let sets = ["follower.roller.offset=200mm", "cam.base_radius=40mm", "cam.bore_radius=10mm"];
    let error = dpi(&sets).expect_err("out of reach");
    assert_eq!(error.faults.len(), 1, "{error}");
    let fault = &error.faults[0];
    assert!(fault.message.contains("does not reach a cam of this base radius"), "{error}");
    assert!(fault.place.is_some() && fault.help.is_some(), "{error}");
}

/// Every follower has its table; a file without one is told which there are, and one with two that they are two.
#[test]
fn the_follower_is_one_of_the_list() {
    let told = Machine::from_toml("none.toml", "name = \"x\"\n", &[]).expect_err("no follower").to_string();
    for kind in FOLLOWERS {
        let path = kind.section.path;
        assert!(told.contains(&format!("[{path}]")), "{told}");
        assert!(sections().iter().any(|section| section.path == path), "{path}");
    }
    let tables: Vec<String> = FOLLOWERS.iter().map(|kind| format!("[{}]", kind.section.path)).collect();
    let told = Machine::from_toml("all.toml", &format!("name = \"x\"\n{}\n", tables.join("\n")), &[])
        .expect_err("one too many");
    let two = format!("two followers: [{}] and [{}]", FOLLOWERS[0].section.path, FOLLOWERS[1].section.path);
    assert!(told.to_string().contains(&two), "{told}");
}

/// A motion program with a fault gives that fault, at its place, and none that follows from it.
#[test]
fn a_fault_of_a_motion_program_is_told_once() {
    let whole = "name = \"cam\"\n[follower.roller]\nradius = \"10 mm\"\n[motion]\nstart = \"0 mm\"\n";
    let segments = |over: &str| {
        format!("{whole}[[motion.segment]]\nover = \"{over}\"\nto = \"9 mm\"\n[[motion.segment]]\nto = \"0 mm\"\n")
    };
    for (toml, part, line) in [
        (segments("360 deg"), "already cover 360.000000 deg", 9),
        (segments("90 deg").replace("over = \"90 deg\"\n", ""), "a segment has no `over`", 6),
        (segments("90 deg").replace("follower.roller", "follower.rollr"), "did you mean `follower.roller.radius`", 3),
        (format!("{whole}[motion.segment]\nover = \"90 deg\"\n"), "must be an array of tables", 6),
        (whole.to_owned(), "a motion needs segments", 5),
        (
            segments("90 deg").replace("start = ", "start = = ").replace("[follower.roller]", "[follower.roller"),
            "not TOML",
            2,
        ),
    ] {
        let error = Machine::from_toml("cam.toml", &toml, &[]).expect_err(part);
        assert_eq!(error.faults.len(), 1, "{error}");
        assert!(error.to_string().contains(part), "no {part:?} in\n{error}");
        assert_eq!(error.faults[0].place.as_ref().map(|place| place.line), Some(line), "{error}");
    }
}

/// What holds where a file gives no limit of the pressure angle is by the follower, and an input; a limit that is given always holds.
#[test]
fn the_limit_of_the_pressure_angle_is_by_the_follower() {
    let arm = "pivot_distance = \"150 mm\"\n";
    let lever = format!("[follower.swinging-roller]\nradius = \"10 mm\"\narm = \"100 mm\"\n{arm}");
    for (follower, limit) in [
        ("[follower.roller]\nradius = \"10 mm\"\n".to_owned(), Some(30.0)),
        ("[follower.knife]\n".to_owned(), Some(30.0)),
        (lever, Some(45.0)),
        ("[follower.flat]\n".to_owned(), None),
        (format!("[follower.swinging-flat]\n{arm}"), None),
    ] {
        let read = |sets: &[String]| {
            let machine = Machine::from_toml("cam.toml", &format!("name = \"cam\"\n{follower}"), sets).expect("valid");
            let input = machine.inputs(MAKE).into_iter().find(|input| input.key == "limits.pressure_angle");
            (machine.limits.pressure_angle.map(|limit| limit.to_degrees().round()), input.map(|input| input.typed))
        };
        assert_eq!(read(&[]), (limit, limit.map(|limit| format!("{limit} deg"))), "{follower}");
        let given = read(&["limits.pressure_angle=20 deg".to_owned()]);
        assert_eq!(given, (Some(20.0), Some("20 deg".to_owned())), "{follower}");
    }
}

#[test]
fn a_face_on_an_arm_lies_on_this_side_of_the_shaft() {
    let text = "name = \"cam\"\n[follower.swinging-flat]\npivot_distance = \"50 mm\"\nface_offset = \"50 mm\"\n";
    let error = Machine::from_toml("cam.toml", text, &[]).expect_err("beyond the shaft");
    assert!(error.to_string().contains("face_offset must be below pivot_distance: 50 mm ≥ 50 mm"), "{error}");
    let out_of_reach =
        format!("{}[cam]\nbase_radius = \"41 mm\"\n", text.replace("= \"50 mm\"\nface", "= \"90 mm\"\nface"));
    let error = Machine::from_toml("cam.toml", &out_of_reach, &[]).expect_err("out of reach");
    assert!(error.to_string().contains("between 0.000 mm and 40.000 mm"), "{error}");
}

/// What a lever can reach is told when the cam is out of it.
#[test]
fn a_cam_out_of_reach_is_told_the_reach() {
    let lever = "name = \"cam\"\n[follower.swinging-roller]\nradius = \"10 mm\"\narm = \"100 mm\"\npivot_distance = \"150 mm\"\n";
    for base in ["30 mm", "300 mm"] {
        let error = Machine::from_toml("cam.toml", &format!("{lever}[cam]\nbase_radius = \"{base}\"\n"), &[]);
        let text = error.expect_err("out of reach").to_string();
        assert!(text.contains("between 40.000 mm and 240.000 mm"), "{text}");
    }
}
