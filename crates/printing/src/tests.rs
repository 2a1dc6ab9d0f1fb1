//! What is read from machine files, over the tables of the core and of every domain.

use super::DOMAINS;
use crate::press::MachineOfPress;
use crate::press::SpecOfPress;
use crate::press::buffer::bottom_law::ColumnRule;
use crate::press::cams::{CONOID, ROTARY, TRANSLATING};
use crate::press::machine::{AirColumn, ConoidMode, DriveMachine, PressCams, Shift};
use crate::press::motion::Transition;
use crate::press::motion::equation_18::EfficiencyModel;
use crate::press::template;
use crate::shaft::ShaftMachine;
use camgen_cams::catalogue::{analyses, catalogue, checks, kinds};
use camgen_cams::domain::registered;
use camgen_cams::machine::Catalogue;
use camgen_cams::machine::{CamData, Limits, Machine, MachineError, MachineSource, Rotation, schema};
use camgen_cams::pipeline::Spec;
use camgen_kernel::document::Presence::Required;
use camgen_kernel::document::cams::MAKE;
use camgen_kernel::document::{Key, KeyForm, KeySection, Reader};
use camgen_kernel::follower::{Crown, FOLLOWERS, FollowerKind, RollerData};

mod keys;

/// A motion program behind a press, so that a file has every table that can stand in it.
const MOTION: &str = "\n[motion]\nstart = \"0 mm\"\n[[motion.segment]]\nover = \"180 deg\"\nto = \"20 mm\"\n\
                      [[motion.segment]]\nto = \"0 mm\"\n";

/// What is linked with the crate has its domains, in their order, as a catalogue has that is put together by hand.
#[test]
fn the_domains_are_registered() {
    assert_eq!(registered().len(), DOMAINS.len());
    let by_hand = Catalogue::builder().with(DOMAINS).build();
    assert_eq!(by_hand.names(), catalogue().names());
    assert_eq!(by_hand.checks, catalogue().checks);
    let paths = |catalogue: &Catalogue| catalogue.keys.sections.iter().map(|section| section.path).collect::<Vec<_>>();
    assert_eq!(paths(&by_hand), paths(catalogue()));
}

fn dpi(overrides: &[&str]) -> Result<Machine, MachineError> {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Machine::load("dpi", &overrides).map(|(machine, _)| machine)
}

fn message(overrides: &[&str]) -> String {
    dpi(overrides).expect_err("a fault").to_string()
}

/// `keyway = "auto"` is the keyway of DIN 6885-1 for the bore, as a word in the place of the table or for each key; fits are those of holes.
#[test]
fn keyways_and_fits_are_standard() {
    let load = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        Machine::load("feeder", &overrides).map(|(machine, _)| machine.cam)
    };
    let keyway = |cam: CamData| cam.keyway.map(|keyway| [1e3 * keyway.width, 1e3 * keyway.depth, keyway.angle]);
    let near = |found: Option<[f64; 3]>, known: [f64; 3]| {
        let found = found.expect("a keyway");
        assert!(found.iter().zip(known).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {known:?}");
    };
    near(keyway(load(&["cam.keyway=auto"]).expect("a bore of 24 mm")), [8.0, 3.3, 0.0]);
    let turned = ["cam.keyway=auto", "cam.keyway.angle=90deg", "cam.bore_diameter=16mm"];
    near(keyway(load(&turned).expect("a bore of 16 mm")), [5.0, 2.3, std::f64::consts::FRAC_PI_2]);
    near(keyway(load(&["cam.keyway.width=auto", "cam.keyway.depth=4mm"]).expect("own depth")), [8.0, 4.0, 0.0]);
    let cam = load(&["cam.bore_fit=H7", "cam.keyway=auto", "cam.keyway.fit=P9"]).expect("fits");
    assert_eq!(cam.bore_fit.map(|fit| fit.to_string()).as_deref(), Some("H7"));
    assert_eq!(cam.keyway_fit.map(|fit| fit.to_string()).as_deref(), Some("P9"));
    for (wrong, wanted) in [
        (&["cam.keyway=auto", "cam.bore_diameter=5mm"][..], "DIN 6885-1 has no keyway for a bore of Ø5.000 mm"),
        (&["cam.keyway=standard"], "or cam.keyway = \"auto\""),
        (&["cam.bore_fit=h7"], "class of a shaft"),
        (&["cam.bore_fit=H77"], "give D, E, F, G, H or JS"),
        (&["cam.keyway=auto", "cam.keyway.fit=K9"], "not a known tolerance class"),
    ] {
        let message = load(wrong).expect_err("refused").to_string();
        assert!(message.contains(wanted), "{wrong:?}: {message}");
    }
}

#[test]
fn every_embedded_machine_and_the_template_read() {
    for embedded in &catalogue().embedded {
        if embedded.toml.contains("\n[drive]") {
            let (drive, stem) = DriveMachine::load(embedded.name, &[]).expect("a drive");
            assert_eq!((stem.as_str(), drive.column), (embedded.name, 0.485));
            assert_eq!(drive.name(), embedded.title());
            continue;
        }
        if embedded.toml.contains("\n[shaft]") && !embedded.toml.contains("\n[bed]") {
            let (shaft, stem) = ShaftMachine::load(embedded.name, &[]).expect("a shaft");
            assert_eq!((stem.as_str(), shaft.name()), (embedded.name, embedded.title()));
            assert!(shaft.machine().is_none());
            continue;
        }
        if embedded.toml.contains("\n[brake]") {
            continue;
        }
        let (machine, stem) = Machine::load(embedded.name, &[]).unwrap_or_else(|e| panic!("{}: {e}", embedded.name));
        assert_eq!((stem.as_str(), machine.name()), (embedded.name, embedded.title()));
        assert_eq!(machine.motion().is_some(), embedded.toml.contains("\n[motion]"));
        let cams = PressCams::of(&machine);
        assert_eq!(machine.press().is_ok(), cams.translating.is_some() && cams.conoid.is_some());
    }
    let template = include_str!("../../../templates/machine.toml");
    assert!(Machine::from_toml("template", template, &[]).is_ok());
}

#[test]
fn an_override_replaces_a_value() {
    let machine = dpi(&["follower.roller.radius=25mm", "cam.base_radius = auto", "cam.lever=2"]).expect("valid");
    assert_eq!(machine.roller().expect("a roller").radius, 0.025);
    assert_eq!(PressCams::of(&machine).lever, 2.0);
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
        ("cam.bore_radius", vec!["`=` is missing"]),
        ("design.rpm=0", vec!["must be at least 0.001"]),
        ("cam.thickness=0.1um", vec!["must be at least 1 um"]),
        ("design.rpm=35 rpm", vec!["not a bare number"]),
        ("name=", vec!["must be text"]),
        ("cam.keyway.width=8mm", vec!["missing key `cam.keyway.depth`"]),
        ("cam.keyway.widht=8mm", vec!["did you mean `cam.keyway.width`?"]),
        ("cam.balance=40mm", vec!["must be a range", "35 mm .. 60 mm"]),
        ("cam.balance=60mm .. 40mm", vec!["from the smaller to the larger value"]),
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
    let dpi = catalogue().embedded[0].toml;
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
    let error = dpi(&["cam.material=steal"]).expect_err("no such material");
    assert_eq!(error.faults.len(), 1, "{error}");
    let told = error.to_string();
    assert!(told.contains("`cam.material` cannot be \"steal\"") && told.contains("did you mean \"steel\"?"), "{error}");
}

/// Faults of every sort in one file: each is reported once, and nothing that only follows from another.
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
        "material = \"steal\"",
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
        (0, "--set cam.lever: `=` is missing"),
        (0, "missing key `cam.keyway.depth` in press.toml"),
        (1, "`name` must be text"),
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
        (19, "`cam.material` cannot be \"steal\""),
        (20, "`cam.balance` must go from the smaller to the larger value: 60 mm .. 40 mm"),
        (21, "`cam.rotation` must be a word"),
        (25, "`limits.pressure_angle` must be at most 90 deg: 91 deg"),
        (26, "unknown table `foo`"),
        (1, "`transition.kind` cannot be \"smooth\""),
    ];
    assert_eq!(told, expected);
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
    let own = Machine::from_toml("dpi.toml", &format!("{}{MOTION}", catalogue().embedded[0].toml), &[]).expect("valid");
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

/// Every follower has its table; the error for a file without one lists them, and the error for two says that there are two.
#[test]
fn the_follower_is_one_of_the_list() {
    let told = Machine::from_toml("none.toml", "name = \"x\"\n", &[]).expect_err("no follower").to_string();
    for kind in FOLLOWERS {
        let path = kind.section.path;
        assert!(told.contains(&format!("[{path}]")), "{told}");
        assert!(catalogue().keys.sections.iter().any(|section| section.path == path), "{path}");
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

/// The error for a cam out of reach of its lever gives what the lever can reach.
#[test]
fn a_cam_out_of_reach_is_told_the_reach() {
    let lever = "name = \"cam\"\n[follower.swinging-roller]\nradius = \"10 mm\"\narm = \"100 mm\"\npivot_distance = \"150 mm\"\n";
    for base in ["30 mm", "300 mm"] {
        let error = Machine::from_toml("cam.toml", &format!("{lever}[cam]\nbase_radius = \"{base}\"\n"), &[]);
        let text = error.expect_err("out of reach").to_string();
        assert!(text.contains("between 40.000 mm and 240.000 mm"), "{text}");
    }
}

/// What a domain adds stands behind an entry that is there, so that a name that changes is noticed.
#[test]
fn what_domains_add_stands_behind_what_is_there() {
    for domain in DOMAINS {
        for added in domain.sections {
            let known = catalogue().keys.sections.iter().any(|section| section.path == added.after);
            assert!(known, "no table {}", added.after);
        }
        for added in domain.checks {
            assert!(added.after.is_empty() || catalogue().checks.contains(&added.after), "no check {}", added.after);
        }
    }
}

/// Every check has a name of its own and says what it means; what is found is found by one of them.
#[test]
fn the_list_of_checks_is_the_only_one() {
    let all: Vec<_> = checks().collect();
    let mut names: Vec<&str> = all.iter().map(|check| check.name).collect();
    let machine = dpi(&["cam.balance=40mm .. 85mm"]).expect("valid");
    let cam = Spec::rotary(machine, 35.0).solve().expect("a cam");
    for finding in cam.draw(5e-6).expect("drawn").prove().expect("proved").findings() {
        assert!(names.contains(&&*finding.check), "{finding:?}");
    }
    assert!(all.iter().all(|check| check.about.len() > 20 && check.about.ends_with('.')));
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), all.len());
}

/// With overrides a machine is made of what is known of its text, where they change nothing else, and of the whole text otherwise. Both are the same
/// machine. A key of a table whose header is not in the file makes the second, the header alone the first.
#[test]
fn a_machine_of_what_is_known_is_that_of_the_whole_text() {
    let (mut made, mut refused) = (0, 0);
    for embedded in &catalogue().embedded {
        let (known, whole) = (format!("{}\n[title]\n", embedded.toml), embedded.toml);
        let Ok(base) = Machine::from_toml("whole", whole, &[]) else { continue };
        if whole.contains("[title]") {
            continue;
        }
        let sources = [MachineSource::from_toml("x", &known), MachineSource::from_toml("x", whole)];
        for input in [base.inputs("make"), base.inputs("rotary")].concat() {
            for typed in
                [input.typed.trim_start_matches('Ø'), "12 mm", "0.01 mm", "3 deg", "40", "auto", "cycloidal", "nothing"]
            {
                let set = ["title.owner=me".to_owned(), format!("{}={typed}", input.key)];
                let [a, b] = sources.each_ref().map(|source| {
                    Machine::of_source(source, &set).map_err(|error| error.to_string()).map(|machine| {
                        let own = (machine.given().to_vec(), &machine.cam, &machine.follower, &machine.limits);
                        format!(
                            "{own:?} {:?} {:?}",
                            [machine.inputs("make"), machine.inputs("rotary")],
                            machine.motion()
                        )
                    })
                });
                made += usize::from(a.is_ok());
                refused += usize::from(a.is_err());
                assert_eq!(a, b, "{}: {set:?}", embedded.name);
            }
        }
    }
    assert!(made > 1000 && refused > 1000, "{made} {refused}");
}
