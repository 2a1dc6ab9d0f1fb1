//! The moving report: one file that needs nothing else, whose data are the table's and whose roller is where the pitch curve is.

use crate::common::program::{camgen, camgen_in, files, report};
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::domains::press::wedge::LAW_TOLERANCE;
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec, Writing};
use camgen::report::mechanism::ROLES;
use camgen::table::Table;
use serde_json::Value;
use std::fs;

const LIFTER: &str = include_str!("common/lifter.toml");
const STYLE: &str = include_str!("../../templates/report.css");
const TOLERANCE: f64 = 5e-6;
/// Addresses that may stand in the page, none of which is loaded: the home of the charts in their licence, and the name of SVG.
const ADDRESSES: [&str; 2] = ["https://github.com/leeoniya/uPlot", "http://www.w3.org/2000/svg"];

fn press(overrides: &[&str]) -> Machine {
    let overrides: Vec<String> = overrides.iter().map(|&set| set.to_owned()).collect();
    Machine::load("dpi", &overrides).unwrap_or_else(|error| panic!("{error}")).0
}

fn make(text: &str) -> Cam {
    let machine = Machine::from_toml("lifter.toml", text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let (motion, rpm) = machine.motion().expect("a motion");
    Spec::of_motion(machine, motion, rpm).solve().expect("a cam")
}

/// The lifter under another follower.
fn under(follower: &str, swings: bool) -> Cam {
    let (head, _) = LIFTER.split_once("[follower.roller]").expect("a follower");
    let head = if swings { head.replace(" mm", " deg") } else { head.to_owned() };
    make(&format!("{head}\n{follower}"))
}

const SWINGING: &str =
    "[follower.swinging-roller]\nradius = \"16 mm\"\narm = \"110 mm\"\npivot_distance = \"140 mm\"\n";

const SWINGING_FACE: &str = "[follower.swinging-flat]\npivot_distance = \"150 mm\"\n";

/// A cam of every kind and follower, in both rotations.
fn cams() -> Vec<(&'static str, Cam)> {
    let rotary = |overrides: &[&str]| Spec::rotary(press(overrides), 35.0).solve().expect("a cam");
    let solver = Solver::Ode { tolerance: LAW_TOLERANCE };
    let plate = Spec::translating(press(&[]), 35.0, solver, ExactOn::Braking).solve().expect("a plate");
    let conoid = Spec::conoid(press(&[]), vec![20.0, 25.0, 30.0, 35.0], None).solve().expect("a conoid");
    vec![
        ("rotary", rotary(&[])),
        ("counter-clockwise", rotary(&["cam.rotation=ccw", "follower.roller.offset=20mm"])),
        ("offset", rotary(&["follower.roller.offset=20mm"])),
        ("lever", rotary(&["cam.lever=0.5"])),
        ("lobes", rotary(&["cam.cam_turns_per_crank_turn=0.5"])),
        ("translating", plate),
        ("conoid", conoid),
        ("make", make(LIFTER)),
        ("flat", under("[follower.flat]\n", false)),
        ("tilted", under("[follower.flat]\ntilt = \"15 deg\"\noffset = \"6 mm\"\n[cam]\nrotation = \"ccw\"\n", false)),
        ("knife", under("[follower.knife]\noffset = \"-4 mm\"\n", false)),
        ("swinging face", under(&format!("{SWINGING_FACE}face_offset = \"9 mm\"\n"), true)),
        ("leading face", under(&format!("{SWINGING_FACE}side = \"leading\"\n[cam]\nrotation = \"ccw\"\n"), true)),
        ("swinging", under(SWINGING, true)),
        ("leading", under(&format!("{SWINGING}side = \"leading\"\n[cam]\nrotation = \"ccw\"\n"), true)),
    ]
}

/// The page of a cam, and its table with as many rows as the page has.
fn page(cam: &Cam, rows: u32) -> (String, Table) {
    let proven = cam.draw(TOLERANCE).expect("an outline").prove().expect("a proof");
    let writing = Writing { force: true, ..Writing::to("out", "cam").formats(&["html"]) };
    let set = proven.files(&writing).expect("files");
    let bytes = set.bytes(".html").expect("a page").to_vec();
    (String::from_utf8(bytes).expect("UTF-8"), proven.table(rows))
}

/// What the page shows of its cams.
fn data(page: &str) -> Vec<Value> {
    let (_, behind) = page.split_once("<script id=\"data\" type=\"application/json\">").expect("data");
    let (json, _) = behind.split_once("</script>").expect("an end");
    let data: Value = serde_json::from_str(json).expect("JSON");
    assert_eq!(data["schema"], 1);
    data["cams"].as_array().expect("cams").clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|value| value.as_f64().unwrap_or(f64::NAN)).collect()
}

/// The value of a track at a sample.
fn track(part: &Value, name: &str, sample: usize) -> f64 {
    let value = &part[name];
    if value.is_array() { numbers(value)[sample] } else { value.as_f64().expect("a number") }
}

fn part<'a>(view: &'a Value, role: &str) -> &'a Value {
    let mut parts = view["parts"].as_array().expect("parts").iter();
    parts.rfind(|part| part["role"] == role).unwrap_or_else(|| panic!("no {role}"))
}

#[test]
fn a_page_needs_nothing_else_and_is_small() {
    for (name, cam) in cams() {
        let (page, _) = page(&cam, 1);
        for scheme in ["http://", "https://"] {
            for (at, _) in page.match_indices(scheme) {
                let known = ADDRESSES.iter().any(|address| page[at..].starts_with(address));
                assert!(known, "{name}: {}", &page[at..(at + 60).min(page.len())]);
            }
        }
        for loads in [" src=", "@import", "url(", "<link", "fetch(", "XMLHttpRequest", "innerHTML ="] {
            let own = page.replace("innerHTML=", "");
            assert!(!own.contains(loads), "{name}: {loads}");
        }
        assert!(page.contains("default-src 'none'") && page.contains("The MIT License (MIT)"), "{name}");
        let most = if name == "conoid" { 1_000_000 } else { 450_000 };
        assert!(page.len() < most, "{name}: {} bytes", page.len());
        assert!(!page.contains("{{"), "{name}: a placeholder is left");
    }
}

#[test]
fn the_same_cam_gives_the_same_page() {
    for (name, cam) in cams().into_iter().take(2) {
        assert!(page(&cam, 1).0 == page(&cam, 1).0, "{name}");
    }
}

/// Seven digits of every number of the table.
#[test]
fn the_data_are_the_table_s() {
    for (name, cam) in cams() {
        let (page, _) = page(&cam, 1);
        let cam_data = data(&page).remove(0);
        let views = cam_data["views"].as_array().expect("views").clone();
        let place = views[0]["place"].as_str().expect("a column");
        let plate = cam.body().kind().command == "translating";
        let each = views[0]["columns"][place].as_array().expect("a column").len();
        let rows = u32::try_from(each).expect("few rows") - u32::from(plate);
        let proven = cam.draw(TOLERANCE).expect("an outline").prove().expect("a proof");
        let table = proven.table(rows);
        assert_eq!(table.rows.len(), each * views.len(), "{name}");
        for (view, rows) in views.iter().zip(table.rows.chunks(each)) {
            for (column, title) in table.columns.iter().enumerate() {
                let shown = numbers(&view["columns"][*title]);
                for (row, value) in rows.iter().zip(shown) {
                    let exact = row[column];
                    let same = (value - exact).abs() <= 1e-6 * exact.abs() || !exact.is_finite() && value.is_nan();
                    assert!(same, "{name}: {title} {value} {exact}");
                }
            }
        }
    }
}

/// Seen from the cam, the roller of the picture runs on the pitch curve of the table, at every sample.
#[test]
fn the_roller_is_where_the_pitch_curve_is() {
    for (name, cam) in cams() {
        let (page, _) = page(&cam, 1);
        let cam_data = data(&page).remove(0);
        for view in cam_data["views"].as_array().expect("views") {
            let (metal, touching) = (part(view, "cam"), part(view, "normal"));
            let columns = &view["columns"];
            let (xs, ys) = (numbers(&columns["pitch_x_mm"]), numbers(&columns["pitch_y_mm"]));
            let at = numbers(&view["at"]);
            if view["returns"] == true {
                let last = at.len() - 1;
                let x = track(touching, "x", last) - track(metal, "x", last);
                let y = -track(touching, "y", last);
                let (wanted_x, wanted_y) = (xs[xs.len() - 1], ys[ys.len() - 1]);
                assert!((x - wanted_x).abs() < 3e-4 && (y - wanted_y).abs() < 3e-4, "{name}: {x} {y}");
                continue;
            }
            assert_eq!(at.len(), xs.len() + 1, "{name}: closed");
            for sample in 0..xs.len() {
                let turn = -track(metal, "turn", sample).to_radians();
                let (x, y) = (track(touching, "x", sample), track(touching, "y", sample));
                let (sin, cos) = (libm::sin(turn), libm::cos(turn));
                let seen = (x * cos - y * sin, x * sin + y * cos);
                let off = libm::hypot(seen.0 - xs[sample], seen.1 - ys[sample]);
                assert!(off < 3e-4, "{name} at {}: {seen:?}, not {} {}", at[sample], xs[sample], ys[sample]);
            }
        }
    }
}

/// The air of the picture is as long as the law says: the column less overrun and Δx.
#[test]
fn the_air_is_as_long_as_the_law_says() {
    for (name, cam) in cams().into_iter().filter(|(_, cam)| cam.body().machine().press().is_ok()) {
        let (page, _) = page(&cam, 1);
        let cam_data = data(&page).remove(0);
        for view in cam_data["views"].as_array().expect("views") {
            let air = part(view, "air");
            let (lengths, pressures) = (numbers(&air["stretch"]), numbers(&air["pressure"]));
            // p L^k is the same wherever the air is closed.
            let start = pressures.iter().position(|pressure| *pressure > pressures[0] * 1.000_1).expect("pressed");
            let product = |at: usize| pressures[at] * libm::pow(lengths[at], 1.35);
            for at in start..lengths.len() {
                if pressures[at] > pressures[0] * 1.000_1 {
                    assert!((product(at) / product(start) - 1.0).abs() < 1e-4, "{name} at {at}");
                }
            }
        }
    }
}

/// A spring reaches from the stem to the frame at every sample; without one in the file there is none.
#[test]
fn a_spring_ends_in_the_frame() {
    let spring = "\n[spring]\nrate = \"5 N/mm\"\npreload = \"200 N\"\n";
    for (name, text) in [
        ("roller", LIFTER.to_owned()),
        ("face", LIFTER.replace("[follower.roller]\nradius = \"10 mm\"", "[follower.flat]")),
    ] {
        let view = data(&page(&make(&format!("{text}{spring}")), 1).0)[0]["views"][0].clone();
        let part = part(&view, "spring");
        let count = view["at"].as_array().expect("samples").len();
        let top = |sample: usize| track(part, "y", sample) + track(part, "stretch", sample);
        assert!((0..count).all(|sample| (top(sample) - top(0)).abs() < 2e-4), "{name}");
        assert!(
            (0..count).any(|sample| (track(part, "stretch", sample) - track(part, "stretch", 0)).abs() > 10.0),
            "{name}"
        );
        let plain = data(&page(&make(&text), 1).0)[0]["views"][0].clone();
        assert!(plain["parts"].as_array().expect("parts").iter().all(|part| part["role"] != "spring"), "{name}");
    }
}

#[test]
fn every_part_has_a_style() {
    for (name, cam) in cams() {
        for view in data(&page(&cam, 1).0).remove(0)["views"].as_array().expect("views") {
            for part in view["parts"].as_array().expect("parts") {
                assert!(ROLES.iter().any(|role| part["role"] == *role), "{name}: {}", part["role"]);
            }
        }
    }
    for role in ROLES {
        assert!(STYLE.contains(&format!(".part.{role} path")), "{role}");
    }
}

/// Names are text wherever they come from.
#[test]
fn hostile_names_are_inert() {
    let hostile = "</script><b>&\\\"Ролик {{data}} <!-- \u{2028}";
    let named = |name: &str| page(&make(&LIFTER.replace("\"lifter\"", &serde_json::json!(name).to_string())), 1).0;
    let (page, plain) = (named(hostile), named("plain"));
    for tag in ["<script", "</script", "<b>", "<!--"] {
        assert_eq!(page.matches(tag).count(), plain.matches(tag).count(), "{tag}");
    }
    assert_eq!(data(&page)[0]["machine"], hostile);
}

#[test]
fn two_cams_stand_beside_each_other() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("lifter.toml"), LIFTER).expect("written");
    let run = camgen_in(directory, &["side-by-side", "dpi", "lifter.toml", "--json", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert_eq!(report(&run).as_array().map(Vec::len), Some(2));
    let out = run.directory.path().join("out");
    assert_eq!(files(&out), ["dpi-lifter-side-by-side.html"]);
    let text = fs::read_to_string(out.join("dpi-lifter-side-by-side.html")).expect("a page");
    let shown = data(&text);
    assert_eq!((shown.len(), &shown[1]["machine"]), (2, &Value::from("lifter")));
    assert!(text.len() < 1_000_000, "{}", text.len());
}

/// A report of a cam that fails is written, says so, and the exit code is 1; what cannot be read is 2.
#[test]
fn a_failed_cam_beside_another_is_shown() {
    let sets = ["--set", "cam.base_radius=40mm", "--name", "both"];
    let directory = tempfile::tempdir().expect("a directory");
    let run = camgen_in(directory, &[&["side-by-side", "dpi", "dpi"][..], &sets].concat());
    assert_eq!(run.code, 1, "{}", run.err);
    let page = fs::read_to_string(run.directory.path().join("output/both.html")).expect("a page");
    assert!(data(&page).iter().all(|cam| cam["passed"] == false));
    let run = camgen(&["side-by-side", "dpi", "nowhere.toml"]);
    assert_eq!(run.code, 2, "{}", run.err);
}
