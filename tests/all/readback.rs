//! Files of other programs as they come back from a shop: in inches, rounded, with bulges written wrongly, on other layers, as the path of a
//! cutter or a table of points, placed elsewhere. A file that is this cam is told from one that is not, with the true reason.

use crate::common::program::{camgen, camgen_in, make, report};
use camgen::body::Layer;
use camgen::domains::press::SpecOfPress;
use camgen::geometry::Entity;
use camgen::geometry::contour::{Contour, Vertex};
use camgen::machine::Machine;
use camgen::report::Verdict;
use camgen::tool_files::dxf::{self, Version};
use camgen::{Cam, ExpectedFile, Report, Spec};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A change of the lines of a file.
type Edit<'a> = dyn Fn(&mut Vec<String>) + 'a;

/// Tolerance of the checks, m.
const TOLERANCE: f64 = 5e-6;

fn of_design(name: &str, text: &str) -> Cam {
    let machine = Machine::from_toml(name, text, &[]).expect("a machine");
    Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
}

fn disc() -> Cam {
    of_design("disc.toml", include_str!("../cases/disc.toml"))
}

fn failed(report: &Report) -> Vec<&str> {
    report.checks.iter().filter(|found| found.verdict == Verdict::Fail).map(|found| &*found.check).collect()
}

fn note(report: &Report, check: &str) -> String {
    let found = report.checks.iter().find(|found| found.check == check).unwrap_or_else(|| panic!("no {check}"));
    found.note_words()
}

fn causes(report: &Report) -> Vec<String> {
    let all = report.section("diagnosis").and_then(Value::as_array).cloned().unwrap_or_default();
    all.iter().filter_map(|found| Some(found["cause"].as_str()?.to_owned())).collect()
}

/// The text of the cut file of a cam.
fn own_file(cam: &Cam) -> String {
    let proven = cam.draw(1e-6).expect("drawn").prove().expect("proved");
    String::from_utf8(proven.cut_files()[0].clone()).expect("ASCII")
}

#[test]
fn a_right_file_in_inches_or_centimetres_passes_with_a_note() {
    let cam = disc();
    let found = cam.check(include_bytes!("../cases/inches-right-units.dxf"), TOLERANCE).expect("a DXF file");
    assert_eq!(failed(&found), [""; 0], "{found:?}");
    assert!(note(&found, "units").contains("inches"), "{found:?}");
    let own = cam.draw(1e-7).expect("drawn");
    let part = &own.drawn().expect("an outline").parts[0];
    let entities: Vec<(Layer, Entity)> =
        std::iter::once((Layer::CamProfile, Entity::Polyline(part.outline.contour.clone())))
            .chain(part.holes().into_iter().map(|hole| (Layer::Bore, hole)))
            .collect();
    let scaled = |factor: f64| -> Vec<u8> {
        let small = |contour: &Contour| Contour {
            vertices: contour.vertices.iter().map(|v| Vertex { point: v.point * factor, ..*v }).collect(),
        };
        let all: Vec<(Layer, Entity)> = entities
            .iter()
            .map(|(layer, entity)| {
                let entity = match entity {
                    Entity::Polyline(contour) => Entity::Polyline(small(contour)),
                    Entity::Circle(centre, radius) => Entity::Circle(centre * factor, radius * factor),
                    Entity::Segment(_) => panic!("no lead-in was asked for"),
                };
                (*layer, entity)
            })
            .collect();
        dxf::write(&all, Version::R2000)
    };
    let stated = |factor: f64, unit: u32| {
        let text = String::from_utf8(scaled(factor)).expect("ASCII");
        assert_eq!(text.matches("$INSUNITS\n 70\n4\n").count(), 1, "{}", &text[..900]);
        let bytes = text.replace("$INSUNITS\n 70\n4\n", &format!("$INSUNITS\n 70\n{unit}\n"));
        cam.check(bytes.as_bytes(), TOLERANCE).expect("a DXF file")
    };
    for (unit, millimetres) in [(1, 25.4), (5, 10.0), (6, 1e3), (14, 100.0), (13, 1e-3)] {
        let right = stated(1.0 / millimetres, unit);
        assert_eq!(failed(&right), [""; 0], "{unit}: {right:?}");
        let units = right.checks.iter().find(|check| check.check == "units").expect("judged");
        assert_eq!(units.verdict, Verdict::Warn);
        // Millimetres that are called inches are cut at the wrong size.
        let wrong = stated(1.0, unit);
        assert!(failed(&wrong).len() > 2 && failed(&wrong).contains(&"outline"), "{unit}: {wrong:?}");
    }
    let inches = stated(1.0, 1);
    assert!(causes(&inches).contains(&"scaled".to_owned()), "{inches:?}");
}

/// Rounding to six decimals leaves kinks of 2e-4°, which no shop sees: steps of the velocity by 1e-4 of its largest value.
#[test]
fn the_kinks_of_rounded_coordinates_are_steps_of_the_velocity() {
    let cam = disc();
    let file = include_bytes!("../cases/rounded-6-decimals.dxf");
    let found = cam.check(file, TOLERANCE).expect("a DXF file");
    assert_eq!(failed(&found), [""; 0], "{found:?}");
    let acceleration = found.checks.iter().find(|check| check.check == "acceleration").expect("judged");
    assert!(acceleration.value < 0.06 && acceleration.verdict == Verdict::Pass, "{acceleration:?}");
    assert!(note(&found, "acceleration").contains("at the kinks the velocity steps by up to "), "{acceleration:?}");
    let rolling = serde_json::to_value(found.section("rolling")).expect("JSON");
    let step = rolling["velocity_step_max_mm_per_rad"].as_f64().expect("a step");
    let velocity = cam.body().largest_rates()[0] * 1e3;
    assert!(step > 1e-6 * velocity && step < 3e-4 * velocity, "{step} of {velocity}");
    // A kink that a shop sees is a corner about which the roller turns.
    let text = std::str::from_utf8(file).expect("ASCII");
    let first = text.find("LWPOLYLINE").expect("a polyline");
    let bulge = first + text[first..].find("\n 42\n").expect("a bulge") + 5;
    let end = bulge + text[bulge..].find('\n').expect("a line");
    let more = text[bulge..end].trim().parse::<f64>().expect("a number") + 4e-3;
    let kinked = format!("{}{more:.6}{}", &text[..bulge], &text[end..]);
    let kinked = cam.check(kinked.as_bytes(), TOLERANCE).expect("a DXF file");
    assert!(failed(&kinked).contains(&"tangency"), "{kinked:?}");
}

fn as_file(vertices: Vec<Vertex>) -> Vec<u8> {
    dxf::write(&[(Layer::CamProfile, Entity::Polyline(Contour { vertices }))], Version::R2000)
}

#[test]
fn bulges_that_a_program_wrote_wrongly_are_named() {
    let cam = disc();
    let found = cam.check(include_bytes!("../cases/bulges-inverted.dxf"), TOLERANCE).expect("a DXF file");
    assert_eq!(causes(&found).first().map(String::as_str), Some("bulges inverted"), "{found:?}");
    let own = cam.draw(1e-6).expect("drawn").drawn().expect("an outline").parts[0].outline.contour.clone();
    let count = own.vertices.len();
    let of = |index: usize| own.vertices[index % count].bulge().expect("arcs and lines");
    let check = |vertices: Vec<Vertex>| cam.check(&as_file(vertices), TOLERANCE).expect("a DXF file");
    // The closing segment is the sharpest arc here.
    let sharpest = (0..count).max_by(|a, b| of(*a).abs().total_cmp(&of(*b).abs())).expect("arcs");
    let turned = (0..count).map(|i| (sharpest + 1 + i) % count);
    let lost: Vec<Vertex> =
        turned.map(|i| Vertex::new(own.vertices[i].point, if i == sharpest { 0.0 } else { of(i) })).collect();
    let found = check(lost);
    assert_eq!(causes(&found).first().map(String::as_str), Some("bulge lost"), "{found:?}");
    // Reversed vertices, each with the bulge that it had, with or without the other sign, or those of the segments unchanged.
    for (shift, sign) in [(0, 1.0), (0, -1.0), (count - 1, 1.0)] {
        let reversed: Vec<Vertex> =
            (0..count).rev().map(|i| Vertex::new(own.vertices[i].point, sign * of(i + shift))).collect();
        let found = check(reversed);
        let named = causes(&found);
        let wanted = if shift == 0 { "polyline reversed" } else { "bulges inverted" };
        assert_eq!(named.first().map(String::as_str), Some(wanted), "{shift} {sign}: {found:?}");
    }
    // Reversed with everything that belongs to it, it is this cam.
    let right: Vec<Vertex> = (0..count).rev().map(|i| Vertex::new(own.vertices[i].point, -of(i + count - 1))).collect();
    assert!(!failed(&check(right)).contains(&"outline"));
}

#[test]
fn an_outline_on_another_layer_is_found_by_its_name_or_alone() {
    let cam = disc();
    let text = own_file(&cam);
    let renamed = text.replace("CAM_PROFILE", "CONTOUR 1");
    let on = |text: &str, layer: Option<&str>| {
        let expected = ExpectedFile { layer, ..ExpectedFile::default() };
        cam.check_file(text.as_bytes(), &expected, TOLERANCE).expect("a DXF file")
    };
    assert_eq!(failed(&on(&renamed, Some("contour 1"))), [""; 0]);
    // With a bore there are two closed contours, of which the outermost is the outline.
    let unnamed = on(&renamed, None);
    assert_eq!(failed(&unnamed), [""; 0], "{unnamed:?}");
    assert!(note(&unnamed, "layer").contains("the outermost closed contour, on layer CONTOUR 1,"), "{unnamed:?}");
    assert!(failed(&on(&text, Some("BORE"))).contains(&"outline"));
    assert!(failed(&on(&text, Some("NONE"))).contains(&"layer"));
    let solid = of_design(
        "d.toml",
        &include_str!("../cases/disc.toml")
            .replace("bore_radius=\"10 mm\"\n", "")
            .replace("[cam.keyway]\nwidth=\"6 mm\"\ndepth=\"2.8 mm\"\n", ""),
    );
    let alone = own_file(&solid).replace("CAM_PROFILE", "0");
    let found = solid.check(alone.as_bytes(), TOLERANCE).expect("a DXF file");
    assert_eq!(failed(&found), [""; 0], "{found:?}");
    let layer = found.checks.iter().find(|check| check.check == "layer").expect("judged");
    assert_eq!(layer.verdict, Verdict::Warn);
    // Nothing else may be cut.
    let more = alone.replacen(
        "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS",
        &format!(
            "  0\nLINE\n  8\n0\n 10\n1.0\n 20\n1.0\n 11\n2.0\n 21\n1.0\n{}",
            "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS"
        ),
        1,
    );
    assert_ne!(more, alone);
    let found = solid.check(more.as_bytes(), TOLERANCE).expect("a DXF file");
    assert!(failed(&found).contains(&"bore"), "{found:?}");
}

#[test]
fn the_design_of_a_file_is_found_or_asked_for() {
    // By the record beside it, whatever the name of the copy, and by the hash where the record is gone.
    let mut run = camgen(&["make", "lever", "--out", "out", "--format", "dxf,step", "-q", "--tolerance", "2um"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let folder = run.directory.path().join("out");
    let name = fs::read_dir(&folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"))
        .find(|name| Path::new(name).extension().is_some_and(|ending| ending == "dxf"))
        .expect("a DXF file");
    let text = fs::read_to_string(folder.join(&name)).expect("a file");
    let bare: String = text.split_once('\n').expect("lines").1.split_once('\n').expect("lines").1.to_owned();
    fs::write(folder.join("copy.dxf"), &bare).expect("written");
    for file in [format!("out/{name}"), "out/copy.dxf".to_owned(), format!("out/{}", name.replace(".dxf", ".step"))] {
        run = camgen_in(run.directory, &["check", &file, "--json"]);
        let found = report(&run);
        assert_eq!(run.code, 0, "{file}: {found} {}", run.err);
        assert!(found["design"].as_str().is_some_and(|told| told.contains(".camgen.json")), "{file}: {found}");
    }
    // What is edited is not this cam, nor is it that of another speed or radius.
    let edited = bare.replacen("\n 42\n0.", "\n 42\n0.9", 1);
    fs::write(folder.join("copy.dxf"), edited).expect("written");
    run = camgen_in(run.directory, &["check", "out/copy.dxf"]);
    assert_eq!(run.code, 1, "{} {}", run.out, run.err);
    let other = ["check", &format!("out/{name}"), "--set", "follower.swinging.radius=12.1mm"];
    run = camgen_in(run.directory, &other);
    assert!(run.code == 1 || run.err.contains("unknown key"), "{} {}", run.out, run.err);
    // Without a record: by the hash, and where there is none it asks.
    let default = camgen(&["make", "feeder", "--out", ".", "--format", "dxf", "-q", "--name", "f"]);
    let path = default.directory.path().to_owned();
    fs::remove_file(path.join(".camgen.json")).expect("removed");
    let by_hash = camgen_in(default.directory, &["check", "f.dxf"]);
    assert_eq!(by_hash.code, 0, "{} {}", by_hash.out, by_hash.err);
    assert!(by_hash.out.contains("found by the hash in the file: make of feeder"), "{}", by_hash.out);
    let text = fs::read_to_string(path.join("f.dxf")).expect("a file");
    fs::write(path.join("f.dxf"), text.replace(", inputs ", ", made from ")).expect("written");
    let asked = camgen_in(by_hash.directory, &["check", "f.dxf"]);
    assert_eq!(asked.code, 2, "{} {}", asked.out, asked.err);
    assert!(asked.err.contains("which cam should `f.dxf` be?") && asked.err.contains("--design FILE"), "{}", asked.err);
    // The remedies of the message.
    let given = camgen_in(asked.directory, &["check", "f.dxf", "feeder"]);
    assert_eq!(given.code, 0, "{} {}", given.out, given.err);
    let press = camgen_in(given.directory, &["check", "f.dxf", "dpi", "--rpm", "35"]);
    assert_eq!(press.code, 1, "{} {}", press.out, press.err);
}

/// The hash of a design file beside the cut file finds it.
#[test]
fn a_design_file_beside_the_cut_file_is_found_by_the_hash() {
    let run =
        make(include_str!("../cases/disc.toml"), &["--out", "cut", "--format", "dxf", "-q", "--accuracy", "fine"]);
    assert_eq!(run.code, 0, "{}", run.err);
    fs::remove_file(run.directory.path().join("cut/.camgen.json")).expect("removed");
    let file = "cut/cam-make-200rpm.dxf";
    let found = camgen_in(run.directory, &["check", file]);
    assert_eq!(found.code, 0, "{} {}", found.out, found.err);
    assert!(found.out.contains("cam.toml"), "{}", found.out);
    // Of an edited design it is not the cam.
    let path = found.directory.path().join("cam.toml");
    fs::write(&path, include_str!("../cases/disc.toml").replace("14 mm", "14.1 mm")).expect("written");
    let other = camgen_in(found.directory, &["check", file]);
    assert_eq!(other.code, 2, "{} {}", other.out, other.err);
}

#[test]
fn the_path_of_a_cutter_is_recognised_and_checked() {
    let arguments = ["make", "feeder", "--out", ".", "--name", "f", "--format", "dxf", "-q"];
    let mut run = camgen(&[&arguments[..], &["--cutter-radius", "8mm"]].concat());
    assert_eq!(run.code, 0, "{}", run.err);
    let path = run.directory.path().to_owned();
    let text = fs::read_to_string(path.join("f-cutter.dxf")).expect("a path");
    fs::create_dir(path.join("elsewhere")).expect("made");
    fs::write(path.join("elsewhere/f-cutter.dxf"), &text).expect("written");
    let (head, entity) = text.split_once("LWPOLYLINE").expect("a polyline");
    let moved = format!("{head}LWPOLYLINE{}", entity.replacen("\n 20\n-", "\n 20\n-1", 1));
    assert_ne!(moved, text, "its first place lies below the shaft");
    fs::write(path.join("moved.dxf"), moved).expect("written");
    let bore = "  0\nCIRCLE\n  8\nCUTTER_PATH\n 10\n0.0\n 20\n0.0\n 40\n4.0\n  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS";
    let more = text.replacen("  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS", bore, 1);
    assert_ne!(more, text);
    fs::write(path.join("more.dxf"), &more).expect("written");
    fs::write(path.join("other.dxf"), more.replace("  8\nCUTTER_PATH\n 10\n0.0", "  8\nBORE\n 10\n0.0"))
        .expect("written");
    let away = "elsewhere/f-cutter.dxf";
    for (args, code) in [
        (&["f-cutter.dxf"][..], 0),
        (&["f-cutter.dxf", "--cutter-diameter", "16mm"], 0),
        (&["f-cutter.dxf", "--cutter-radius", "8mm"], 0),
        // An Ø8 cutter along the path of an Ø16 one cuts 4 mm wrong.
        (&["f-cutter.dxf", "--cutter-diameter", "8mm"], 1),
        (&["f-cutter.dxf", "--cutter-radius", "8.01mm"], 1),
        (&[away, "feeder"], 2),
        (&[away, "feeder", "--cutter-radius", "8mm"], 0),
        (&[away, "feeder", "--cutter-radius", "8mm", "--set", "motion.segment[0].to=30.1mm"], 1),
        (&["moved.dxf", "feeder", "--cutter-radius", "8mm"], 1),
        (&["more.dxf", "feeder", "--cutter-radius", "8mm"], 1),
        (&["other.dxf", "feeder", "--cutter-radius", "8mm"], 1),
    ] {
        run = camgen_in(run.directory, &[&["check"], args].concat());
        assert_eq!(run.code, code, "{args:?}: {} {}", run.out, run.err);
        let named = if code == 2 { run.err.contains("--cutter-radius") } else { run.out.contains("cutter_path") };
        assert!(named || args[0] == "other.dxf", "{args:?}: {} {}", run.out, run.err);
    }
}

#[test]
fn a_table_of_points_is_recognised_and_checked() {
    let of = |more: &[&str]| {
        let arguments = ["make", "feeder", "--out", ".", "--name", "f", "--format", "points", "-q", "--tolerance"];
        camgen(&[&arguments[..], &["20um"], more].concat())
    };
    let ways: [&[&str]; 5] = [
        &[],
        &["--points-as", "xy", "--points-between", "cubic"],
        &["--points-step", "chord", "--points-as", "xy"],
        &["--points-of", "centre", "--points-between", "cubic"],
        &["--points-of", "cutter", "--cutter-radius", "6mm"],
    ];
    for way in ways {
        let mut run = of(way);
        assert_eq!(run.code, 0, "{way:?}: {}", run.err);
        let path = run.directory.path().to_owned();
        let text = fs::read_to_string(path.join("f-points.csv")).expect("a table");
        run = camgen_in(run.directory, &["check", "f-points.csv"]);
        assert_eq!(run.code, 0, "{way:?}: {} {}", run.out, run.err);
        assert!(run.out.contains("points"), "{}", run.out);
        run = camgen_in(run.directory, &["check", "f-points.csv", "feeder", "--tolerance", "20um"]);
        assert_eq!(run.code, 0, "{way:?}: {} {}", run.out, run.err);
        // Finer than it was made, of another cam, and edited it is not the table.
        let rows: Vec<&str> = text.lines().collect();
        let head = rows.iter().position(|row| !row.starts_with('#')).expect("columns") + 1;
        let edited = |edit: &dyn Fn(&mut Vec<String>)| {
            let mut all: Vec<String> = rows.iter().map(|&row| row.to_owned()).collect();
            edit(&mut all);
            fs::write(path.join("edited.csv"), all.join("\n") + "\n").expect("written");
        };
        run = camgen_in(run.directory, &["check", "f-points.csv", "feeder", "--tolerance", "0.01um"]);
        assert_eq!(run.code, 1, "{way:?}: {} {}", run.out, run.err);
        let other = ["check", "f-points.csv", "feeder", "--tolerance", "20um", "--set", "motion.segment[0].to=30.1mm"];
        run = camgen_in(run.directory, &other);
        assert_eq!(run.code, 1, "{way:?}: {} {}", run.out, run.err);
        // A row less may still keep the tolerance; half of them, two that are swapped, one that is moved, or the last one do not.
        let edits: [&Edit<'_>; 4] = [
            &|all| all.truncate(head + (all.len() - head) / 2),
            &|all| all.swap(head + 20, head + 21),
            &|all| {
                let (first, second) = all[head + 40].split_once(',').expect("two numbers");
                all[head + 40] = format!("{first},{}", second.parse::<f64>().expect("a number") + 0.05);
            },
            &|all| _ = all.swap_remove(head),
        ];
        for (index, edit) in edits.into_iter().enumerate() {
            edited(edit);
            run = camgen_in(run.directory, &["check", "edited.csv", "feeder", "--tolerance", "20um"]);
            assert_eq!(run.code, 1, "{way:?} {index}: {} {}", run.out, run.err);
        }
    }
}

#[test]
fn an_edge_on_a_slant_is_told_as_that() {
    let machine = Machine::load("dpi", &[]).expect("a machine").0;
    let cam = Spec::rotary(machine, 35.0).solve().expect("a cam");
    let found = cam.check(include_bytes!("../cases/spline-edge-off-level.step"), TOLERANCE).expect("a STEP file");
    assert!(!found.passed());
    assert!(note(&found, "shell").contains("the spline edge of line 100 is not level"), "{found:?}");
    assert!(!note(&found, "walls").contains("inside out"), "{found:?}");
    for check in &found.checks {
        let words = format!("{check:?}");
        assert!(!words.contains(" inf mm") && !words.contains("misses its vertices"), "{words}");
    }
    let volume = found.checks.iter().find(|check| check.check == "volume").expect("listed");
    assert!(!volume.value.is_finite() && volume.limit.is_none(), "{volume:?}");
}

/// The numbers of arcs over the tolerance: fewer or as many at a coarser one.
#[test]
fn a_flat_face_takes_no_more_arcs_at_a_coarser_tolerance() {
    let cam = of_design("flat.toml", include_str!("../cases/flat-face.toml"));
    let (valve, _) = Machine::load("valve", &[]).expect("a machine");
    let valve = Spec::of_program(valve, None).expect("a motion").solve().expect("a cam");
    for (name, cam, most) in [("flat face", cam, 100), ("valve", valve, 107)] {
        let counts: Vec<usize> = [50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1]
            .into_iter()
            .map(|micrometres| {
                let rates = [None, Some(camgen::body::RateTolerance::Share(0.05))];
                let request = camgen::Request { rates, ..camgen::Request::within(1e-6 * micrometres) };
                let proven = cam.draw(request).expect("drawn").prove().expect("proved");
                let failed: Vec<&str> =
                    proven.findings().iter().filter(|f| f.verdict == Verdict::Fail).map(|f| &*f.check).collect();
                assert!(!failed.contains(&"acceleration") && !failed.contains(&"rolling"), "{name} {failed:?}");
                proven.drawn().expect("an outline").parts[0].outline.contour.arcs()
            })
            .collect();
        println!("{name}: {counts:?}");
        assert!(counts.is_sorted(), "{name}: {counts:?}");
        assert!(counts[3] <= most, "{name}: {counts:?}");
    }
}

#[test]
fn straight_flanks_are_lines() {
    let cam = of_design("tangent.toml", include_str!("../cases/tangent-cam.toml"));
    let proven = cam.draw(TOLERANCE).expect("drawn").prove().expect("proved");
    let contour = &proven.drawn().expect("an outline").parts[0].outline.contour;
    assert_eq!(contour.vertices.len() - contour.arcs(), 2, "{contour:?}");
    let largest =
        contour.edges().filter_map(|edge| edge.segment()).filter(|s| s.bulge != 0.0).map(|s| s.radius().abs());
    assert!(largest.fold(0.0, f64::max) < 1e6);
    let found = proven.report();
    assert_eq!(note(&found, "cutter_radius"), "nothing is concave");
    let run = make(include_str!("../cases/tangent-cam.toml"), &["--out", ".", "--format", "csv,svg,points,inspect"]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    // Arcs and lines are the exact outline, so there is no best possible number of tangent arcs.
    assert!(
        run.out.contains("2 lines (those of the exact outline)") && !run.out.contains("best possible"),
        "{}",
        run.out
    );
    // In every table the radius of curvature of a straight flank is `inf`, whatever the sign of the rounding error.
    for ending in [".csv", "-inspect.csv"] {
        let table = fs::read_to_string(run.directory.path().join(format!("cam-make-600rpm{ending}"))).expect("a table");
        let mut rows = table.lines().filter(|line| !line.starts_with('#'));
        let heads: Vec<&str> = rows.next().expect("a head").split(',').collect();
        let columns = (0..heads.len()).filter(|column| heads[*column].contains("curvature_radius"));
        let columns: Vec<usize> = columns.collect();
        let radii: Vec<&str> =
            rows.flat_map(|row| columns.iter().filter_map(move |column| row.split(',').nth(*column))).collect();
        assert!(radii.contains(&"inf") && !radii.contains(&"-inf"), "{ending}: {radii:?}");
        let largest = radii.iter().filter_map(|radius| radius.parse::<f64>().ok()).filter(|radius| radius.is_finite());
        assert!(largest.fold(0.0_f64, |largest, radius| largest.max(radius.abs())) < 1e9, "{ending}: {radii:?}");
    }
    let name = run.directory.path().join("cam-make-600rpm.svg");
    let sheet = fs::read_to_string(name).expect("a sheet");
    for text in [&run.out, &sheet] {
        let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
        let large: Vec<&str> = words.filter(|word| word.parse::<f64>().is_ok_and(|value| value > 1e9)).collect();
        // A hash may consist of digits.
        assert!(large.iter().all(|word| word.len() <= 12 && !word.contains('.')), "{large:?}");
    }
}

/// The solid of a cam with a placement beside it in its representation, which OpenCASCADE applies.
#[test]
fn a_solid_that_lies_elsewhere_is_judged_where_it_lies() {
    let cam = disc();
    let run = make(include_str!("../cases/disc.toml"), &["--out", ".", "--format", "step", "-q"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let text = fs::read_to_string(run.directory.path().join("cam-make-200rpm.step")).expect("a solid");
    let placed = |place: &str, axis: &str, along: &str, more: &str| {
        let held = text.find("ADVANCED_BREP_SHAPE_REPRESENTATION").expect("a representation");
        let (before, after) = text.split_at(held);
        let after = after.replacen("(#", "(#900001, #", 1);
        let points = format!(
            "#900001 = AXIS2_PLACEMENT_3D('', #900002, #900003, #900004);\n#900002 = CARTESIAN_POINT('', ({place}));\n\
             #900003 = DIRECTION('', ({axis}));\n#900004 = DIRECTION('', ({along}));\n{more}ENDSEC;\nEND-ISO"
        );
        let whole = format!("{before}{after}").replace("ENDSEC;\nEND-ISO", &points);
        assert!(whole.contains("#900003"), "{}", &whole[whole.len() - 200..]);
        cam.check(whole.as_bytes(), TOLERANCE).expect("a STEP file")
    };
    let words = |found: &Report| found.section("diagnosis").map(Value::to_string).unwrap_or_default();
    let (x, z) = ("1., 0., 0.", "0., 0., 1.");
    let home = placed("0., 0., 0.", z, x, "");
    assert_eq!(failed(&home), [""; 0], "{home:?}");
    for (place, axis, along, told) in [
        ("500., 0., 0.", z, x, "moved by (500.000, 0.000, 0.000) mm"),
        ("0., 0., 0.", "0., 0., -1.", x, "turned over"),
        ("0., 0., 10.", "0., 0., -1.", x, "turned over, and moved by (0.000, 0.000, 10.000) mm"),
        ("0., 0., 0.", x, z, "out of the upright"),
        ("0., 0., 0.", z, "0., 1., 0.", "turned by 90.000° about its axis"),
        ("0., 0.01, 0.", z, x, "moved by (0.000, 0.010, 0.000) mm"),
    ] {
        let found = placed(place, axis, along, "");
        assert!(!found.passed(), "{place} {axis} {along}: {found:?}");
        assert!(words(&found).contains(told), "{told}: {} {found:?}", words(&found));
    }
    // Parallel directions are no placement, and what lies beyond every drawing may be read by other programs.
    assert!(failed(&placed("0., 0., 0.", z, z, "")).contains(&"shell"));
    let far = placed("0., 0., 0.", z, x, "#900005 = CARTESIAN_POINT('', (1.E+100, 0.));\n");
    assert!(failed(&far).contains(&"shell"), "{far:?}");
    let second = placed("0., 0., 0.", z, x, "#900005 = SPHERE('', 10., #900002);\n");
    assert!(failed(&second).contains(&"solids"), "{second:?}");
}
