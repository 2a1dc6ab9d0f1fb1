//! The pictures of a linkage are of its links, and its table is that of its machine.

use super::picture::{self, LinkagePicture};
use super::{ROWS, analysis, designed, moving, over_base};
use crate::linkage::MachineOfLinkage;
use crate::press::MachineOfPress;
use crate::press::bed_motion::{Branch, DragLink, Linkage, Slider};
use crate::press::machine::LinkageData;
use camgen_cams::machine::Machine;
use camgen_cams::report::mechanism::{MechanismView, RigidPart};
use camgen_cams::report::scheme::{Scheme, SchemePose, Stroke, StrokeKind};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Of a length in millimetres.
const NEAR: f64 = 1e-9;

fn machine(name: &str, sets: &[&str]) -> Machine {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    Machine::load(name, &sets).unwrap_or_else(|error| panic!("{name} {sets:?}: {error}")).0
}

/// Linkages of every kind, with and without what only pictures know.
fn machines() -> Vec<Machine> {
    let turned = ["linkage.base_angle=30 deg", "linkage.follower_angle=110 deg", "linkage.driving_crank=140 mm"];
    let other = ["linkage.base_ratio=0.2", "linkage.coupler_ratio=1.1", "linkage.follower_ratio=1.2"];
    vec![
        machine("dpi-six-bar", &[]),
        machine("dpi-six-bar", &[&turned[..], &other, &["linkage.offset_ratio=-0.4"]].concat()),
        machine("dpi-six-bar", &["linkage.base_ratio=0"]),
        machine("dpi-crank-slider", &[]),
        machine("dpi-crank-slider", &["linkage.offset_ratio=0.5", "bed.crank_radius=35 mm"]),
        machine("dpi", &["linkage.kind=yoke"]),
    ]
}

fn lying(machine: &Machine) -> LinkagePicture<'_> {
    LinkagePicture::new(machine.linkage().expect("a linkage"), machine.bed().expect("a bed"))
}

/// The lengths in a machine file, mm: O2C and CD, and O1A, AB, O2B, O1O2 of a six-bar.
fn lengths(machine: &Machine) -> Vec<(&'static str, f64)> {
    let data = machine.linkage().expect("a linkage");
    let crank = 1e3 * machine.bed().expect("a bed").crank_radius;
    let mut all = vec![("O2C", crank)];
    all.extend(data.linkage.slider().map(|slider| ("CD", slider.rod_ratio * crank)));
    if let Some(link) = data.linkage.drag_link() {
        let driving = data.driving_crank.map_or(crank, |driving| 1e3 * driving);
        let (ab, o2b) = (link.coupler * driving, link.follower * driving);
        all.extend([("O1A", driving), ("AB", ab), ("O2B", o2b), ("O1O2", link.base * driving)]);
    }
    all
}

/// The letters at the ends of a length: O1A is from O1 to A.
fn ends(length: &str) -> [&str; 2] {
    let second = length.rfind(['O', 'A', 'B', 'C', 'D']).expect("a letter");
    [&length[..second], &length[second..]]
}

fn apart(of: &SchemePose, [from, to]: [&str; 2]) -> f64 {
    let at = |letter: &str| of.joints.iter().find(|joint| joint.letter == letter).expect("a joint").at;
    (at(to) - at(from)).norm()
}

#[test]
fn joints_keep_their_lengths_wherever_they_are_drawn() {
    for machine in machines() {
        let scheme = picture::scheme(&lying(&machine));
        let yoke = machine.linkage().expect("a linkage").linkage == Linkage::Yoke;
        assert_eq!(scheme.poses.len(), if yoke { 2 } else { 3 });
        for stand in &scheme.poses {
            for (length, expected) in lengths(&machine) {
                let found = apart(stand, ends(length));
                assert!((found - expected).abs() < NEAR, "{}: {length} {found}, not {expected}", stand.name);
            }
            // Every link runs from joint to joint.
            for stroke in stand.strokes.iter().filter(|stroke| matches!(stroke.kind, StrokeKind::Link(_))) {
                let on = |point: &Vector2<f64>| stand.joints.iter().any(|joint| (joint.at - point).norm() < NEAR);
                assert!(stroke.points.iter().all(on), "{}", stroke.name);
            }
        }
    }
}

/// Where the bed turns round the crank of the slider and the rod lie on one line.
#[test]
fn the_dead_points_are_drawn_as_such() {
    for machine in machines() {
        let (crank, data) = (lying(&machine).crank, machine.linkage().expect("a linkage"));
        let scheme = picture::scheme(&lying(&machine));
        let Some(slider) = data.linkage.slider() else { continue };
        let far = |stand: &SchemePose| apart(stand, ["O2", "D"]);
        assert!((far(&scheme.poses[0]) - (slider.rod_ratio + 1.0) * crank).abs() < 1e-9);
        assert!((far(&scheme.poses[1]) - (slider.rod_ratio - 1.0) * crank).abs() < 1e-9);
    }
}

fn strokes(scheme: &Scheme) -> impl Iterator<Item = &Stroke> {
    scheme.poses.iter().flat_map(|stand| &stand.strokes)
}

#[test]
fn the_paths_are_circles_about_their_shafts() {
    for machine in machines() {
        let scheme = picture::scheme(&lying(&machine));
        let o1 = scheme.poses[0].joints.iter().find(|joint| joint.letter == "O1").map(|joint| joint.at);
        let mut seen = 0;
        for path in strokes(&scheme).filter(|stroke| stroke.kind == StrokeKind::Path) {
            let (centre, length) = match path.name {
                "path of A" => (o1.expect("O1"), "O1A"),
                "path of B" => (Vector2::zeros(), "O2B"),
                _ => (Vector2::zeros(), "O2C"),
            };
            let (_, radius) = lengths(&machine).into_iter().find(|(name, _)| *name == length).expect("a length");
            for point in &path.points {
                assert!(((point - centre).norm() - radius).abs() < NEAR, "{}", path.name);
            }
            let [first, .., last] = path.points[..] else { panic!("a path") };
            assert_eq!(first, last, "closed");
            seen += 1;
        }
        assert_eq!(seen, scheme.poses.len() * if o1.is_some() { 3 } else { 1 });
    }
}

/// Where a place of a part's own frame is at a sample.
fn seen(part: &RigidPart, own: Vector2<f64>, sample: usize) -> Vector2<f64> {
    let turn = part.turn_deg.at(sample).to_radians();
    let (cos, sin) = (libm::cos(turn), libm::sin(turn));
    Vector2::new(part.x.at(sample), part.y.at(sample))
        + Vector2::new(cos * own.x - sin * own.y, sin * own.x + cos * own.y)
}

fn named<'a>(view: &'a MechanismView, letter: &str) -> &'a RigidPart {
    let is = |part: &&RigidPart| part.name.as_ref().is_some_and(|(name, _)| name == letter);
    view.parts.iter().find(is).unwrap_or_else(|| panic!("no {letter}"))
}

/// Every link has its ends at its joints at every sample, and no part ever jumps.
#[test]
fn the_moving_links_end_at_their_joints() {
    for machine in machines() {
        let lying = lying(&machine);
        let mechanism = moving::mechanism(&lying, ROWS, 1.0);
        let view = &mechanism.views[0];
        let links: Vec<&RigidPart> = view
            .parts
            .iter()
            .filter(|part| part.name.is_none() && ["crank", "follower"].contains(&part.role))
            .collect();
        let known = lengths(&machine);
        let length = |name: &str| known.iter().find(|(other, _)| *other == name).map(|(_, length)| *length);
        let data = machine.linkage().expect("a linkage");
        let along = |length: f64| Vector2::new(length, 0.0);
        for sample in 0..=ROWS as usize {
            let pin = |letter: &str| seen(named(view, letter), Vector2::zeros(), sample);
            let at = |link: usize, own: Vector2<f64>, joint: Vector2<f64>| {
                let off = (seen(links[link], own, sample) - joint).norm();
                assert!(off < NEAR, "{:?} link {link} at sample {sample} is {off} mm off", data.linkage);
            };
            if let Some(rod) = length("CD") {
                at(0, Vector2::zeros(), pin("C"));
                at(0, along(rod), pin("D"));
            }
            match data.linkage.drag_link() {
                Some(link) => {
                    let [ab, o1a, o2b] = ["AB", "O1A", "O2B"].map(|name| length(name).expect("a length"));
                    at(1, Vector2::zeros(), pin("A"));
                    at(1, along(ab), pin("B"));
                    let back = data.base_angle - link.turn;
                    at(2, along(lying.crank), pin("C"));
                    at(2, o2b * Vector2::new(libm::cos(back), libm::sin(back)), pin("B"));
                    at(3, along(o1a), pin("A"));
                }
                None => at(links.len() - 1, along(lying.crank), pin("C")),
            }
            for part in &view.parts {
                let step = if sample == 0 { 0.0 } else { part.turn_deg.at(sample) - part.turn_deg.at(sample - 1) };
                assert!(step.abs() < 3.0, "{} jumps by {step}° at sample {sample}", part.role);
            }
        }
        for link in links {
            let turned = link.turn_deg.at(ROWS as usize) - link.turn_deg.at(0);
            assert!(turned.abs() < 1e-9 || (turned - 360.0).abs() < 1e-9, "{} turns by {turned}°", link.role);
        }
    }
}

/// The mechanism has a sample at each row of the table, and its slider is where the table has it.
#[test]
fn the_moving_bed_is_where_the_table_has_it() {
    for machine in machines() {
        let found = analysis(&machine, 35.0, None).expect("a linkage");
        let view = &found.mechanism.as_ref().expect("a mechanism").views[0];
        let (_, table) = found.tables.last().expect("a table");
        let column = |name: &str| table.columns.iter().position(|column| *column == name).expect("a column");
        let (crank, x) = (column("crank_deg"), column("x_mm"));
        assert_eq!(view.at.len(), table.rows.len() + 1);
        let bed = view.parts.iter().find(|part| part.role == "bed").expect("a bed");
        for (sample, row) in table.rows.iter().enumerate() {
            assert!((view.at[sample] - row[crank]).abs() < 1e-12);
            assert!((bed.x.at(sample) - row[x]).abs() < NEAR, "at {}", row[crank]);
        }
    }
}

/// Figure 2 of the paper, by its exact values.
#[test]
fn the_ratio_of_accelerations_falls_with_the_base() {
    let link = DragLink { base: 0.1, coupler: 1.0, follower: 1.1, turn: PI, branch: Branch::Leading };
    let curve = over_base::curve(link, Slider { rod_ratio: 3.0, offset_ratio: 0.0 });
    let golden = [(0.0, 1.911_519), (0.05, 1.568_521), (0.10, 1.279_756), (0.15, 1.047_955), (0.20, 0.879_799)];
    for (base, expected) in golden {
        let [_, found] = curve.iter().find(|[at, _]| (at - base).abs() < 1e-12).expect("a round base");
        assert!((found - expected).abs() < 1e-6, "at {base} K_c is {found}, not {expected}");
    }
    let [last, _] = curve.last().expect("an end");
    assert!((last - 0.95 * link.remedies().base.below).abs() < 1e-12);
    assert!(curve.iter().all(|[_, ratio]| ratio.is_finite()));
}

/// What is written is read as the same linkage.
#[test]
fn a_table_is_read_back() {
    let own = include_str!("../../../profiles/dpi-six-bar.toml");
    let (head, rest) = own.split_once("[linkage]").expect("a table");
    let (_, behind) = rest.split_once("\n[").expect("another table");
    let mut all: Vec<LinkageData> = machines().iter().map(|machine| *machine.linkage().expect("a linkage")).collect();
    let plain = machine("dpi-crank-slider", &["linkage.offset_ratio=0.1"]);
    let least = super::DragLinkGoal::Least { symmetric: false, power: None };
    all.extend(
        [super::DragLinkGoal::Equal, super::DragLinkGoal::Symmetric, least]
            .map(|goal| designed(&plain, goal).expect("a design")),
    );
    for data in all {
        let table = super::described::lines(&data).expect("a table").join("\n");
        let text = format!("{head}{table}\n[{behind}");
        let read = Machine::from_toml("read.toml", &text, &[]).unwrap_or_else(|error| panic!("{error}\n{table}"));
        let read = read.linkage().expect("a linkage");
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14 * a.abs().max(1.0);
        assert!(near(read.base_angle, data.base_angle), "{table}");
        assert!(near(read.driving_crank.unwrap_or(0.0), data.driving_crank.unwrap_or(0.0)), "{table}");
        assert_eq!(read.linkage.slider(), data.linkage.slider(), "{table}");
        match (read.linkage.drag_link(), data.linkage.drag_link()) {
            (Some(a), Some(b)) => {
                assert_eq!((a.base, a.coupler, a.follower, a.branch), (b.base, b.coupler, b.follower, b.branch));
                assert!(near(a.turn, b.turn), "{table}");
            }
            (a, b) => assert_eq!(a, b),
        }
    }
    let behind = DragLink { base: 0.1, coupler: 0.8, follower: 0.6, turn: PI, branch: Branch::Trailing };
    let linkage = Linkage::SixBar(behind, Slider { rod_ratio: 3.0, offset_ratio: 0.0 });
    let data = LinkageData { linkage, driving_crank: None, base_angle: 0.0 };
    assert_eq!(super::described::lines(&data), None, "there is no key for it");
}
