//! Where an outline starts, and the lead-in of the tool: on the written bytes, and refused where it would cut into the cam.

use crate::common::program::{Run, camgen_in, files, finding, make, report, run};
use camgen::geometry::contour::{Contour, Edge};
use camgen::reading;
use camgen::report::Verdict;
use camgen::{Machine, Spec};
use std::fs;

/// A rise and a return with dwells of 60° above and 100° below: the lower one is from 260° to 360°.
const DISC: &str = r#"
name = "start"
[motion]
rpm = 100
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "100 deg"
to = "20 mm"
[[motion.segment]]
law = "dwell"
over = "60 deg"
[[motion.segment]]
law = "modified-sine"
over = "100 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "12 mm"
[cam]
base_radius = "50 mm"
bore_radius = "10 mm"
thickness = "12 mm"
"#;

/// The bytes of the one cut file that a run wrote.
fn dxf(run: &Run) -> Vec<u8> {
    let name = files(&run.directory.path().join("output")).into_iter().find(|name| name.ends_with("rpm.dxf"));
    fs::read(run.directory.path().join("output").join(name.expect("a cut file"))).expect("readable")
}

/// The outline as it is in the file, from its first vertex.
fn outline(bytes: &[u8]) -> Contour {
    reading::read(bytes, 1e-6).expect("a DXF file").chains[0].contour()
}

/// The polar angle of the first vertex, degrees from 0 to 360.
fn start_deg(bytes: &[u8]) -> f64 {
    let start = outline(bytes).vertices[0].point;
    start.y.atan2(start.x).to_degrees().rem_euclid(360.0)
}

#[test]
fn an_outline_starts_in_the_middle_of_the_lower_dwell_or_where_it_is_asked() {
    let text = DISC.to_owned();
    let angle = |args: &[&str]| start_deg(&dxf(&make(&text, args)));
    // The roller stands at the cam angle on a clockwise cam, and against it on one that turns the other way.
    assert!((angle(&[]) - 310.0).abs() < 1e-6);
    assert!((angle(&["--set", "cam.rotation=ccw"]) - 50.0).abs() < 1e-6);
    assert!((angle(&["--start", "130deg"]) - 130.0).abs() < 1e-6);
    for kind in ["arcs", "spline"] {
        let run = make(&text, &["--start", "40 deg", "--outline", kind, "--tolerance", "1um"]);
        let machine = Machine::from_toml("start.toml", &text, &[]).expect("a machine");
        let cam = Spec::of_program(machine, None).expect("a motion").solve().expect("a cam");
        let curves = camgen::body::curves(cam.body()).expect("a disc");
        let (piece, at) = curves.motion.locate(40_f64.to_radians());
        let exact = curves.profile(piece, at).point * 1e3;
        let away = (outline(&dxf(&run)).vertices[0].point - exact).norm();
        assert!(away < 1.1e-3, "{kind}: {away} mm");
    }
}

/// Only the start differs: the same arcs, of which the first is divided.
#[test]
fn a_start_changes_no_arc_of_an_outline() {
    let [here, there] = ["200deg", "310deg"].map(|start| outline(&dxf(&make(DISC, &["--start", start]))));
    let ((area, centroid), (other, place)) = (here.area_and_centroid(), there.area_and_centroid());
    assert!((area - other).abs() < 1e-6 && (centroid - place).norm() < 1e-9);
    for (from, to) in [(&here, &there), (&there, &here)] {
        let worst = camgen::geometry::chain_distance::farthest_place(from, to, 1e-9);
        assert!(worst.distance < 2e-9, "{worst:?}");
    }
}

#[test]
fn a_lead_in_comes_to_the_start_from_outside_and_is_proved() {
    for (form, size) in [("tangent", "8mm"), ("arc", "4mm")] {
        for rotation in ["cw", "ccw"] {
            let rotation = format!("cam.rotation={rotation}");
            let args =
                ["--lead-in", form, size, "--set", &rotation, "--cutter-diameter", "6mm", "--format", "dxf,svg,json"];
            let run = make(DISC, &args);
            assert_eq!(run.code, 0, "{}", run.err);
            let written = dxf(&run);
            let reading = reading::read(&written, 1e-6).expect("a DXF file");
            let lead_ins: Vec<_> = reading
                .others
                .iter()
                .filter(|chain| chain.sources.iter().all(|source| source.on_layer("LEAD_IN")))
                .collect();
            assert_eq!(lead_ins.len(), 1, "{form}");
            let start = reading.chains[0].contour().edges().next().expect("an edge");
            let way: &Edge = &lead_ins[0].edges[0];
            let ends = [(way.start(), way.start_tangent()), (way.end(), way.end_tangent())];
            let touching =
                ends.iter().find(|(end, _)| (end - start.start()).norm() < 1e-9).expect("it ends at the start");
            assert!(touching.1.perp(&start.start_tangent()).abs() < 1e-9, "{form}");
            let other =
                ends.iter().find(|(end, _)| (end - start.start()).norm() > 1e-3).expect("it comes from elsewhere");
            assert!(other.0.norm() > start.start().norm() + 0.3, "{form}: from outside");
            // Each file is this cam by itself, too, and so is the path of the cutter.
            let mut directory = run.directory;
            for name in files(&directory.path().join("output")).iter().filter(|name| name.contains(".dxf")) {
                let file = format!("output/{name}");
                let mut words = vec!["check", &file, "--design", "cam.toml", "--set", &rotation, "--json"];
                words.extend(["--cutter-diameter", "6mm"].iter().filter(|_| name.contains("cutter")));
                let checked = camgen_in(directory, &words);
                assert_eq!(checked.code, 0, "{name}: {}{}", checked.out, checked.err);
                assert_eq!(finding(&report(&checked), "lead_in")["verdict"], "pass", "{name}");
                directory = checked.directory;
            }
        }
    }
}

/// In a hollow flank a straight line lies in the metal, and an arc that is smaller than the hollow does not.
#[test]
fn a_lead_in_through_the_metal_is_refused() {
    let text = DISC.replace("\"20 mm\"", "\"40 mm\"").replace("\"12 mm\"\n[cam]", "\"3 mm\"\n[cam]");
    let text = text.replace("\"50 mm\"", "\"25 mm\"") + "[limits]\npressure_angle = \"70 deg\"\n";
    let with = |form: &str, size: &str| make(&text, &["--start", "20deg", "--lead-in", form, size]);
    assert_eq!(with("arc", "3mm").code, 0);
    let through = with("tangent", "20mm");
    assert_eq!(through.code, 2, "{}", through.err);
    assert!(through.err.contains("would cut") && through.err.contains("--start"), "{}", through.err);
    assert_eq!(files(through.directory.path()), ["cam.toml"]);
}

#[test]
fn what_no_start_or_lead_in_is_asked_for_by_is_told() {
    for (args, words) in [
        (["--start", "400deg"].as_slice(), "below 360 deg"),
        (&["--start", "40"], "unit"),
        (&["--lead-in", "radial", "5mm"], "tangent or arc"),
        (&["--lead-in", "arc", "cam.toml"], "--lead-in arc 5mm"),
        (&["--lead-in", "arc", "0mm"], "above 0"),
    ] {
        let run = make(DISC, args);
        assert!(run.code == 2 && run.err.contains(words), "{args:?}: {}", run.err);
    }
    let plate = run(2, &["translating", "--rpm", "35", "--start", "10deg"]);
    assert!(plate.err.contains("no cam angle"), "{}", plate.err);
}

/// A lead-in that was moved in the file, or drawn by another program across the cam, is not passed over.
#[test]
fn a_changed_lead_in_fails() {
    let made = make(DISC, &["--lead-in", "tangent", "8mm"]);
    let text = String::from_utf8(dxf(&made)).expect("ASCII");
    let machine = Machine::from_toml("start.toml", DISC, &[]).expect("a machine");
    let cam = Spec::of_program(machine, None).expect("a motion").solve().expect("a cam");
    let (before, line) = text.rsplit_once("\nLINE\n").expect("a line");
    let verdict = |from: (f64, f64), to: (f64, f64)| {
        let mut lines: Vec<String> = line.lines().map(str::to_owned).collect();
        for (code, value) in [(" 10", from.0), (" 20", from.1), (" 11", to.0), (" 21", to.1)] {
            let at = lines.iter().position(|line| line == code).expect("a coordinate");
            lines[at + 1] = format!("{value:.12}");
        }
        let file = format!("{before}\nLINE\n{}\n", lines.join("\n"));
        let checks = cam.check(file.as_bytes(), 5e-6).expect("a DXF file").checks;
        let found = checks.into_iter().find(|found| found.check == "lead_in").expect("checked");
        (found.verdict, found.note_words())
    };
    let start = outline(text.as_bytes()).vertices[0].point;
    let (end, out) = ((start.x, start.y), start * 1.2);
    assert_eq!(verdict((out.x, out.y), end).0, Verdict::Warn);
    let (found, note) = verdict((out.x, out.y), (start.x * 1.01, start.y * 1.01));
    assert!(found == Verdict::Fail && note.contains("reach"), "{note}");
    let (found, note) = verdict((-start.x, -start.y), end);
    assert!(found == Verdict::Fail && note.contains("into the cam"), "{note}");
}
