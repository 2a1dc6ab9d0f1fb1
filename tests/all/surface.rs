//! The library's public surface: every type has a page, and everything that a machine file describes can be put together in code.

use crate::common::source::{CRATES, all_sources, code, root, src, tokens};
use camgen::domains::press::BufferData;
use camgen::domains::press::BuilderOfPress;
use camgen::domains::press::buffer::{Bed, bottom_law::ColumnRule};
use camgen::domains::press::machine::{
    AirColumn, CompensatorData, ConoidData, ConoidMode, PressCams, Shift, TranslatingData,
};
use camgen::domains::press::motion::Transition;
use camgen::domains::press::motion::equation_18::EfficiencyModel;
use camgen::units::TECHNICAL_ATMOSPHERE;
use camgen::{
    ArmSide, Builder, Error, FlatFaceFollower, GuideData, Keyway, KnifeEdgeFollower, Machine, Material, PlaceChoice,
    Program, Quantity, RollerFollower, Spec, SpringData, SwingingFaceFollower, SwingingRollerFollower, Title,
    VibrationData, law,
};
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fs;
use std::path::Path;

/// As a machine file turns degrees into radians.
fn degrees(angle: f64) -> f64 {
    angle * PI / 180.0
}

/// Every pub item of the names that a file exports with `pub use`, from modules whose path begins with `room`.
fn exported(file: &Path, room: Option<&str>) -> BTreeSet<String> {
    let all = tokens(&code(file));
    let mut names = BTreeSet::new();
    let mut at = 0;
    while at + 1 < all.len() {
        if all[at].text == "pub" && all[at + 1].text == "use" {
            let end = (at..all.len()).find(|end| all[*end].text == ";").expect("an end");
            if room.is_none_or(|room| all[at + 2].text == room) {
                let is_name = |next: usize| [",", "}", ";"].contains(&all[next + 1].text.as_str());
                let named =
                    (at + 2..end).filter(|next| is_name(*next) && all[*next].text != "}" && all[*next].text != ",");
                names.extend(named.map(|next| all[next].text.clone()));
            }
            at = end;
        }
        at += 1;
    }
    names
}

/// A hidden module would hide its types. That every type of a public signature has a name is what the lint `unnameable_types` looks for,
/// and that it is described `missing_docs`; the workspace compiles without warnings.
#[test]
fn every_public_type_has_a_page() {
    for path in all_sources() {
        let text: String = code(&path).split_whitespace().collect();
        assert!(!text.contains("doc(hidden)"), "{} hides something from the documentation", path.display());
    }
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("a manifest");
    for lint in ["missing_docs", "unnameable_types", "broken_intra_doc_links"] {
        assert!(manifest.contains(&format!("{lint} = \"warn\"")), "{lint}");
    }
    for name in CRATES {
        let lib = tokens(&code(&src(name).join("lib.rs")));
        let private = lib.windows(2).filter(|pair| pair[1].text == "mod" && pair[0].text != "pub");
        assert_eq!(private.map(|pair| pair[0].line).collect::<Vec<_>>(), Vec::<usize>::new(), "rooms without a page");
        let own = fs::read_to_string(src(name).with_file_name("Cargo.toml")).expect("a manifest");
        assert!(own.ends_with("[lints]\nworkspace = true\n"), "{name} has lints of its own");
    }
}

/// What the pipeline has for the crates of domains, which make specifications of their own.
const FOR_DOMAINS: [&str; 4] = ["Alternative", "OF_BUILDER", "SolvedBodies", "WantedCams"];

/// What the pipeline is made of is on the first page.
#[test]
fn the_first_page_has_the_whole_pipeline() {
    let all = exported(&src("cams").join("pipeline/mod.rs"), None);
    assert!(all.len() > 15 && all.contains("Proven"), "{all:?}");
    for (page, from) in [(root().join("src/lib.rs"), "camgen_cams"), (src("cams").join("lib.rs"), "pipeline")] {
        let first = exported(&page, Some(from));
        let missing: Vec<&String> =
            all.difference(&first).filter(|name| !FOR_DOMAINS.contains(&name.as_str())).collect();
        assert!(missing.is_empty(), "not on the first page {}: {missing:?}", page.display());
    }
}

/// Up and down with rests.
fn motion(quantity: Quantity, travel: f64) -> Program {
    let up = law("modified-sine").ok();
    let (third, sixth) = (2.0 * PI / 3.0, PI / 3.0);
    Program::new(quantity, 0.0, &[(up, third, travel), (None, sixth, travel), (up, third, 0.0), (None, sixth, 0.0)])
        .expect("a program")
}

fn proved(builder: Builder, motion: Program) {
    let name = format!("{builder:?}");
    let cam = builder.bore_radius(0.006).motion(motion).expect("in range").solve().expect("a cam");
    let proven = cam.draw(20e-6).expect("an outline").prove().expect("a proof");
    assert!(proven.passed(), "{name}: {:?}", proven.findings());
}

#[test]
fn every_follower_is_built_and_proved() {
    let roller = RollerFollower { radius: 0.010, offset: PlaceChoice::SmallestCam, ..Default::default() };
    proved(Spec::builder("roller").roller(roller), motion(Quantity::Length, 0.012));
    let offset = KnifeEdgeFollower { offset: 0.002.into(), ..Default::default() };
    for edge in [offset, KnifeEdgeFollower::default()] {
        proved(Spec::builder("knife edge").knife_edge(edge), motion(Quantity::Length, 0.012));
    }
    let face = FlatFaceFollower { tilt: degrees(5.0), offset: 0.001, ..Default::default() };
    proved(Spec::builder("flat face").flat_face(face), motion(Quantity::Length, 0.012));
    let roller = SwingingRollerFollower {
        radius: 0.012,
        arm: 0.090,
        pivot_distance: 0.120.into(),
        side: ArmSide::Leading,
        ..Default::default()
    };
    proved(Spec::builder("swinging roller").swinging_roller(roller), motion(Quantity::Angle, degrees(12.0)));
    let face = SwingingFaceFollower { pivot_distance: 0.120, face_offset: 0.004, ..Default::default() };
    proved(Spec::builder("swinging face").swinging_flat_face(face), motion(Quantity::Angle, degrees(8.0)));
}

/// A machine from code has the inputs of the file with the same numbers, and so the same hash.
fn has_the_inputs_of(built: Builder, name: &str, command: &str) {
    let file = Machine::load(name, &[]).expect("valid").0;
    let built = built.machine().expect("valid");
    let of = |machine: &Machine| {
        let mut inputs = machine.inputs(command);
        inputs.retain(|input| !input.key.starts_with("motion"));
        inputs.sort_by(|one, other| one.key.cmp(&other.key));
        inputs
    };
    assert_eq!(of(&built), of(&file), "{name}");
}

fn disc(builder: Builder, thickness: f64, bore: f64) -> Builder {
    builder.thickness(thickness).bore_radius(bore).material(Material::Steel)
}

#[test]
fn a_builder_gives_the_inputs_of_a_file() {
    let roller = RollerFollower { radius: 0.015, mass: Some(2.5), preload: Some(250.0), ..Default::default() };
    let feeder = Spec::builder("Feeder").roller(roller).pressure_angle(degrees(30.0));
    has_the_inputs_of(disc(feeder, 0.015, 0.012), "feeder", "make");
    let roller = SwingingRollerFollower {
        radius: 0.016,
        arm: 0.110,
        pivot_distance: 0.140.into(),
        inertia: Some(0.012),
        ..Default::default()
    };
    let lever = Spec::builder("Lever of a packaging machine")
        .spring(SpringData { rate: 40.0, preload: 16.0, ..Default::default() })
        .swinging_roller(roller)
        .pressure_angle(degrees(45.0));
    has_the_inputs_of(disc(lever, 0.015, 0.012), "lever", "make");
}

fn press() -> Builder {
    disc(Spec::builder("DPI flat-bed press, 2 at"), 0.030, 0.025)
        .bed(Bed { mass: 978.2, crank_radius: 0.180, crank_turns_per_main_shaft_turn: 3.0 })
        .buffer(BufferData {
            polytropic_exponent: 1.35,
            ambient_pressure: TECHNICAL_ATMOSPHERE,
            end_pressure: 2.0 * TECHNICAL_ATMOSPHERE,
            column: AirColumn::Of(ColumnRule::Matched),
            lead: 0.0,
        })
        .design_speed(35.0)
        .transition(Transition::RunUp { width: degrees(20.0) })
        .roller(0.030)
        .lobes(1)
        .lever(1.0)
        .pressure_angle(degrees(30.0))
        .min_convex_pitch_radius_over_roller(2.0)
        .cutter_radius(0.010)
        .wall(0.005)
        .wedge(WEDGE)
        .conoid(CONOID)
}

const WEDGE: TranslatingData = TranslatingData {
    roller_arm: 0.300,
    bottom_arm: 0.300,
    delta: PI / 2.0,
    friction_angle: 3.0 * PI / 180.0,
    efficiency: 0.95,
    efficiency_model: EfficiencyModel::Consistent,
    balance: None,
    roller_radius: 0.030,
    plate_height: Some(0.120),
};

const CONOID: ConoidData =
    ConoidData { axial_travel: 0.120, mode: ConoidMode::Adjusted, shift: Shift::Linear, overhang: None };

#[test]
fn a_press_from_code_is_that_of_its_file() {
    for command in ["rotary", "translating", "conoid"] {
        has_the_inputs_of(press(), "dpi", command);
    }
    let compensator = CompensatorData {
        spring_rate: 1e5,
        preload: 1e4,
        roller_radius: 0.025,
        base_radius: None,
        angle: PI,
        mass: Some(40.0),
    };
    let machine = press().compensator(compensator).residual_share(0.02).machine().expect("valid");
    let cams = PressCams::of(&machine);
    assert_eq!((cams.translating, cams.conoid, cams.compensator), (Some(WEDGE), Some(CONOID), Some(compensator)));
    assert_eq!(cams.residual_share, Some(0.02));
}

/// Every value arrives at the machine, in its own unit.
#[test]
fn forces_and_limits_arrive_as_they_were_given() {
    let spring = SpringData { rate: 8e3, preload: 120.0, damping: 20.0, load: -15.0 };
    let guide = GuideData { friction: 0.1, span: 0.060, overhang: 0.010 };
    let vibration = VibrationData { natural_frequency: 40.0, damping: 0.02 };
    let title = Title { owner: Some("Works = \"North\"".into()), revision: Some("B".into()), ..Title::default() };
    let machine = Spec::builder("all")
        .roller(RollerFollower { radius: 0.01, crown_radius: Some(0.5), rim_width: Some(0.02), ..Default::default() })
        .offset(0.002)
        .spring(spring)
        .guide(guide)
        .vibration(vibration)
        .flywheel(0.02)
        .bore_radius(0.012)
        .keyway(Keyway { width: 0.004, depth: 0.0018, angle: degrees(30.0) })
        .balancing_holes(0.015, 0.025)
        .counter_clockwise()
        .title(&title)
        .pressure_angle_return(degrees(40.0))
        .min_convex_radius(0.005)
        .contact_stress(1.2e9)
        .acceleration_share(0.05)
        .continuity(2)
        .jump_margin(1.5)
        .residual_vibration(0.01)
        .machine()
        .expect("in range");
    assert_eq!((machine.spring(), machine.guide()), (Some(spring), Some(guide)));
    assert_eq!((machine.vibration(), machine.fluctuation()), (Some(vibration), Some(0.02)));
    let roller = machine.roller().expect("a roller");
    assert_eq!((roller.radius, roller.offset, roller.width), (0.01, 0.002, Some(0.02)));
    let inputs = machine.inputs("make");
    let value = |key: &str| inputs.iter().find(|input| input.key == key).map_or("absent", |input| input.value.as_str());
    for (key, wanted) in [
        ("title.owner", "Works = \"North\""),
        ("cam.rotation", "ccw"),
        ("limits.min_convex_radius", "0.005"),
        ("limits.contact_stress", "1200000000"),
        ("limits.acceleration_share", "0.05"),
        ("limits.continuity", "2"),
        ("limits.jump_margin", "1.5"),
        ("limits.residual", "0.01"),
    ] {
        assert_eq!(value(key), wanted, "{key}");
    }
}

#[test]
fn what_is_out_of_range_is_reported_by_its_key() {
    let faults = |builder: Builder| match builder.machine() {
        Err(Error::Machine(error)) => error.faults.into_iter().map(|fault| fault.message).collect::<Vec<_>>(),
        other => panic!("{other:?}"),
    };
    let told = faults(Spec::builder("none").swinging_roller(SwingingRollerFollower::default()).thickness(-1.0));
    for key in ["swinging-roller.radius", "swinging-roller.arm", "swinging-roller.pivot_distance", "cam.thickness"] {
        assert!(told.iter().any(|message| message.contains(key)), "{key}: {told:?}");
    }
    let no_speed = Spec::builder("still").roller(0.01).rpm(-1.0).motion(motion(Quantity::Length, 0.01));
    assert!(matches!(no_speed, Err(Error::Machine(_))));
}
