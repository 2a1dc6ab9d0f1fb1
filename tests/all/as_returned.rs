//! The verdict on files as shops return them: this cam in another form, this cam with more or less that would be cut, or not this cam.

use crate::common::program::{camgen, camgen_in, run, summary_of};
use camgen::geometry::contour::{Contour, Segment, Vertex};
use camgen::machine::Machine;
use camgen::report::{FileVerdict, Verdict};
use camgen::tool_files::dxf::{self, Version};
use camgen::{Cam, ExpectedFile, Report, Request, Spec};
use nalgebra::Vector2;
use serde_json::Value;
use std::fmt::Write as _;
use std::fs;
use std::sync::OnceLock;

const TOLERANCE: f64 = 5e-6;
const BORE: &str = "0 CIRCLE\n8 BORE\n10 0\n20 0\n40 12";

fn feeder(overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load("feeder", &overrides).expect("valid").0;
    Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
}

fn cam() -> &'static Cam {
    static CAM: OnceLock<Cam> = OnceLock::new();
    CAM.get_or_init(|| feeder(&[]))
}

fn outline() -> &'static Contour {
    static OUTLINE: OnceLock<Contour> = OnceLock::new();
    OUTLINE.get_or_init(|| {
        cam().draw(TOLERANCE).expect("drawn").drawn().expect("an outline").parts[0].outline.contour.clone()
    })
}

/// A file of groups: each line a code and a value.
fn text(unit: u32, layers: &str, blocks: &str, entities: &str) -> Vec<u8> {
    let section = |name: &str, groups: &str| format!("0 SECTION\n2 {name}\n{groups}\n0 ENDSEC\n");
    let all = [
        section("HEADER", &format!("9 $INSUNITS\n70 {unit}")),
        section("TABLES", &format!("0 TABLE\n2 LAYER\n{layers}\n0 ENDTAB")),
        section("BLOCKS", blocks),
        section("ENTITIES", entities),
        "0 EOF\n".into(),
    ];
    let pair = |line: &str| {
        let (code, value) = line.trim().split_once(' ').unwrap_or((line.trim(), ""));
        format!("{code:>3}\n{value}\n")
    };
    all.concat().lines().filter(|line| !line.trim().is_empty()).map(pair).collect::<String>().into_bytes()
}

fn polyline(contour: &Contour, layer: &str) -> String {
    let mut groups = format!("0 LWPOLYLINE\n8 {layer}\n90 {}\n70 1\n", contour.vertices.len());
    for vertex in &contour.vertices {
        let (point, bulge) = (vertex.point, vertex.bulge().expect("an arc or a line"));
        writeln!(groups, "10 {:?}\n20 {:?}\n42 {bulge:?}", point.x, point.y).expect("written");
    }
    groups
}

fn moved(contour: &Contour, to: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Contour {
    Contour { vertices: contour.vertices.iter().map(|at| Vertex { point: to(at.point), ..*at }).collect() }
}

fn plain(entities: &str) -> Vec<u8> {
    text(4, "", "", entities)
}

#[track_caller]
fn judged(verdict: FileVerdict, bytes: &[u8]) -> Report {
    let report = cam().check(bytes, TOLERANCE).expect("a file that can be read");
    assert_eq!(FileVerdict::of(&report), verdict, "{report:?}");
    assert_eq!(report.passed(), verdict == FileVerdict::ThisCam);
    report
}

fn note(report: &Report, check: &str) -> String {
    report.checks.iter().find(|found| found.check == check).expect("judged").note_words()
}

fn verdict_of(report: &Report, check: &str) -> Verdict {
    report.checks.iter().find(|found| found.check == check).expect("judged").verdict
}

fn diagnosis(report: &Report) -> Vec<Value> {
    report.section("diagnosis").and_then(Value::as_array).cloned().unwrap_or_default()
}

/// Every layer has another name, or there is one layer; entities are exploded and shuffled, or in a block.
#[test]
fn the_outermost_contour_is_the_outline_whatever_its_layer() {
    for (layer, bore) in [("TOOLPATH", "0"), ("0", "BORE"), ("0", "0"), ("cam_profile", "bore")] {
        let bytes = plain(&(polyline(outline(), layer) + &BORE.replace("BORE", bore)));
        let report = judged(FileVerdict::ThisCam, &bytes);
        let told = note(&report, "layer");
        let is_named = layer == "cam_profile";
        assert!(
            is_named || told.contains(&format!("the outermost closed contour, on layer {layer}, is taken")),
            "{told}"
        );
    }
    let one_layer = plain(&(polyline(outline(), "CAM_PROFILE") + &BORE.replace("BORE", "CAM_PROFILE")));
    let report = judged(FileVerdict::ThisCam, &one_layer);
    assert!(note(&report, "layer").contains("the outermost closed contour on layer CAM_PROFILE"), "{report:?}");
    let segments = outline().segments().expect("arcs and lines");
    let count = segments.len();
    // 31 has no factor in common with the number of segments.
    assert_ne!(count % 31, 0);
    let exploded: String = (0..count).map(|i| entity(&segments[i * 31 % count])).collect();
    judged(FileVerdict::ThisCam, &plain(&(exploded + BORE)));
    let shifted = moved(outline(), |point| point + Vector2::new(5.0, -3.0));
    let block = format!(
        "0 BLOCK\n8 0\n2 PART\n70 0\n10 0\n20 0\n{}{}\n0 ENDBLK",
        polyline(&shifted, "0"),
        BORE.replace("10 0\n20 0", "10 5\n20 -3")
    );
    judged(FileVerdict::ThisCam, &text(4, "", &block, "0 INSERT\n8 0\n2 PART\n10 -5\n20 3"));
}

/// A segment as an entity of its own on layer 0.
fn entity(segment: &Segment) -> String {
    let (a, b) = (segment.start, segment.end);
    if segment.bulge == 0.0 {
        return format!("0 LINE\n8 0\n10 {:?}\n20 {:?}\n11 {:?}\n21 {:?}\n", a.x, a.y, b.x, b.y);
    }
    let (centre, (from, to)) = (segment.centre(), segment.angles());
    let radius = segment.radius().abs();
    format!("0 ARC\n8 0\n10 {:?}\n20 {:?}\n40 {radius:?}\n50 {from:?}\n51 {to:?}\n", centre.x, centre.y)
}

#[test]
fn a_unit_that_is_stated_rightly_is_a_note() {
    for (unit, millimetres, name) in [(1, 25.4, "inches"), (5, 10.0, "centimetres"), (6, 1e3, "metres")] {
        let small = moved(outline(), |point| point / millimetres);
        let bore = BORE.replace("40 12", &format!("40 {:?}", 12.0 / millimetres));
        let report = judged(FileVerdict::ThisCam, &text(unit, "", "", &(polyline(&small, "CAM_PROFILE") + &bore)));
        assert_eq!(verdict_of(&report, "units"), Verdict::Warn);
        assert!(note(&report, "units").starts_with(&format!("the file is in {name}")), "{report:?}");
        let called = text(unit, "", "", &(polyline(outline(), "CAM_PROFILE") + BORE));
        judged(FileVerdict::NotThisCam, &called);
    }
    // A unit whose size camgen does not know.
    judged(FileVerdict::ThisCamBut, &text(17, "", "", &(polyline(outline(), "CAM_PROFILE") + BORE)));
}

/// Doubles are harmless where they coincide, and nothing else is.
#[test]
fn exact_doubles_are_a_note() {
    let twice = |by: f64, layer: &str| {
        let other = moved(outline(), |point| point + Vector2::new(by, 0.0));
        plain(&(polyline(outline(), "CAM_PROFILE") + &polyline(&other, layer) + BORE))
    };
    for layer in ["CAM_PROFILE", "0"] {
        let report = judged(FileVerdict::ThisCam, &twice(0.0, layer));
        assert_eq!(verdict_of(&report, "duplicates"), Verdict::Warn);
        for by in [1e-5, 4e-4, 4e-3] {
            let report = judged(FileVerdict::ThisCamBut, &twice(by, layer));
            let failed = ["duplicates", "bore"].iter().any(|check| verdict_of(&report, check) == Verdict::Fail);
            assert!(failed, "{by}: {report:?}");
        }
    }
    judged(FileVerdict::ThisCam, &plain(&format!("{}{BORE}\n{BORE}", polyline(outline(), "CAM_PROFILE"))));
}

#[test]
fn more_or_less_than_the_part_is_this_cam_but() {
    let with = |more: &str| plain(&(polyline(outline(), "CAM_PROFILE") + more));
    judged(FileVerdict::ThisCam, &with(BORE));
    let hole = "0 CIRCLE\n8 0\n10 20\n20 0\n40 1.5";
    for (more, told) in [
        ("", "the bore is missing"),
        (&*BORE.replace("40 12", "40 11.9"), "the bore has a radius of 11.9000 mm, not 12.0000 mm"),
        (&*format!("{BORE}\n{hole}"), "CIRCLE on layer 0 at (20.000, 0.000) mm would be cut"),
        (&*format!("{BORE}\n{}", hole.replace("8 0", "8 CAM_PROFILE")), "CIRCLE on layer CAM_PROFILE"),
        (&*format!("{BORE}\n{}", hole.replace("10 20", "10 200").replace("8 0", "8 CAM_PROFILE")), "at (200.000"),
        (
            &*format!("{BORE}\n0 LINE\n8 AXES\n10 -9\n20 0\n11 9\n21 0"),
            "LINE on layer AXES at (0.000, 0.000) mm (open)",
        ),
    ] {
        let report = judged(FileVerdict::ThisCamBut, &with(more));
        assert!(note(&report, "bore").contains(told), "{told}: {}", note(&report, "bore"));
    }
    // A frame around the part would be cut too.
    let frame = Contour { vertices: [(-99.0, -99.0), (99.0, -99.0), (99.0, 99.0), (-99.0, 99.0)].map(corner).to_vec() };
    for layer in ["CAM_PROFILE", "0"] {
        let bytes = plain(&(polyline(outline(), layer) + &polyline(&frame, "FRAME") + BORE));
        judged(FileVerdict::ThisCamBut, &bytes);
    }
}

fn corner((x, y): (f64, f64)) -> Vertex {
    Vertex::new(Vector2::new(x, y), 0.0)
}

/// A shop does not cut a layer that is off or frozen.
#[test]
fn an_outline_that_is_hidden_or_elsewhere_is_compared() {
    for (flags, colour) in [(1, 7), (0, -7)] {
        for layer in ["CAM_PROFILE", "PART"] {
            let layers = format!("0 LAYER\n2 {layer}\n70 {flags}\n62 {colour}");
            let hidden = |contour: &Contour| text(4, &layers, "", &(polyline(contour, layer) + BORE));
            let report = judged(FileVerdict::ThisCamBut, &hidden(outline()));
            assert!(note(&report, "layer").contains("on a layer that is off or frozen"), "{report:?}");
            judged(FileVerdict::NotThisCam, &hidden(&outline().mirrored_about_x()));
            // Something else that would be cut as the outline makes it another cam.
            let other = moved(outline(), |point| point * 0.9);
            let both = polyline(outline(), layer) + &polyline(&other, "0") + BORE;
            judged(FileVerdict::NotThisCam, &text(4, &layers, "", &both));
        }
    }
    let construction = "0 CIRCLE\n8 CAM_PROFILE\n10 0\n20 0\n40 20\n";
    let report = judged(FileVerdict::ThisCamBut, &plain(&(polyline(outline(), "CONTOUR") + construction + BORE)));
    assert!(note(&report, "layer").contains("lies on layer CONTOUR"), "{report:?}");
}

/// Vertices of three decimals kink short segments by up to 0.07°; a vertex that is off is no rounding.
#[test]
fn kinks_of_rounded_vertices_are_a_note() {
    let cam = cam();
    let own = cam.draw(2e-6).expect("drawn").drawn().expect("an outline").parts[0].outline.contour.clone();
    let rounded = |digits: f64, contour: &Contour| moved(contour, |at| at.map(|x| (x * digits).round() / digits));
    let check = |contour: &Contour| {
        cam.check(&plain(&(polyline(contour, "CAM_PROFILE") + BORE)), TOLERANCE).expect("a DXF file")
    };
    let report = check(&rounded(1e3, &own));
    assert!(report.passed(), "{report:?}");
    let tangency = report.checks.iter().find(|found| found.check == "tangency").expect("judged");
    if tangency.value > 0.05 {
        assert_eq!(tangency.verdict, Verdict::Warn);
        assert!(note(&report, "tangency").contains("rounded to 0.001 mm"), "{report:?}");
    }
    // The same kinks off the grid are not explained.
    let turned = moved(&rounded(1e3, &own), |point| point + Vector2::new(3.3e-4, 0.0));
    assert_eq!(check(&turned).passed(), tangency.value <= 0.05);
    let mut off = rounded(1e3, &own);
    let away = off.vertices[9].point.normalize() * 0.011;
    off.vertices[9].point += away;
    assert_eq!(FileVerdict::of(&check(&rounded(1e3, &off))), FileVerdict::NotThisCam);
    assert!(!check(&rounded(1e1, &own)).passed());
}

/// The radius of a cutter acts on the outermost contour, alone or with the bore.
#[test]
fn a_cutter_makes_the_outermost_contour_a_path() {
    let request = Request { cutter_radius: Some(3e-3), ..Request::within(TOLERANCE) };
    let drawing = cam().draw(request).expect("drawn");
    let path = drawing.drawn().and_then(|drawn| drawn.cutter_path.as_ref()).expect("a path").clone().expect("a path");
    let own = String::from_utf8(dxf::cutter_path(&path, Version::R2000)).expect("ASCII");
    let with_bore = plain(&(polyline(&path.contour, "CAM_PROFILE") + BORE));
    let alone = plain(&polyline(&path.contour, "CUTTER"));
    let expected = |cutter: Option<f64>| ExpectedFile { cutter, ..ExpectedFile::default() };
    let check = |bytes: &[u8], expected: &ExpectedFile<'_>| cam().check_file(bytes, expected, TOLERANCE).expect("read");
    for bytes in [&with_bore, &alone, &own.into_bytes()] {
        assert!(check(bytes, &expected(Some(3e-3))).passed(), "{:?}", check(bytes, &expected(Some(3e-3))));
        assert!(!check(bytes, &expected(Some(3.1e-3))).passed());
    }
    // The path of a run that is recorded makes no path of another file.
    let recorded = ExpectedFile { cutter_is_recorded: true, ..expected(Some(3e-3)) };
    assert!(!check(&with_bore, &recorded).passed());
    let report = check(&with_bore, &expected(None));
    assert_eq!(diagnosis(&report).first().map(|found| &found["cause"]), Some(&Value::from("offset")), "{report:?}");
    let wrong = moved(&path.contour, |point| Vector2::new(point.x, point.y + 0.02));
    assert!(!check(&plain(&(polyline(&wrong, "CAM_PROFILE") + BORE)), &expected(Some(3e-3))).passed());
    let no_bore = plain(&(polyline(&path.contour, "CAM_PROFILE") + &BORE.replace("40 12", "40 9")));
    assert_eq!(FileVerdict::of(&check(&no_bore, &expected(Some(3e-3)))), FileVerdict::ThisCamBut);
}

/// A cause leaves no more than the tolerance, or there is none.
#[test]
fn pairs_of_causes_are_named_and_others_are_not() {
    let check = |contour: &Contour| cam().check(&plain(&polyline(contour, "CAM_PROFILE")), TOLERANCE).expect("read");
    let mirrored = moved(&outline().mirrored_about_x(), |point| -point);
    let about_y = diagnosis(&check(&mirrored));
    assert_eq!(about_y[0]["cause"], "mirrored about Y", "{about_y:?}");
    let request = Request { cutter_radius: Some(2e-3), ..Request::within(TOLERANCE) };
    let drawing = cam().draw(request).expect("drawn");
    let path = drawing.drawn().and_then(|drawn| drawn.cutter_path.as_ref()).expect("a path").clone().expect("a path");
    let both = moved(&path.contour.mirrored_about_x(), |point| -point);
    let causes = diagnosis(&check(&both));
    assert_eq!(causes[0]["cause"], "mirrored about Y and offset", "{causes:?}");
    assert!((causes[0]["value"].as_f64().expect("a value") - 2.0).abs() < 2e-3, "{causes:?}");
    let inches = moved(&mirrored, |point| point / 25.4 + Vector2::new(1.0, 2.0));
    let causes = diagnosis(&check(&inches));
    assert_eq!(causes[0]["cause"], "mirrored about Y and scaled and shifted", "{causes:?}");
    for cause in [about_y, causes].concat() {
        assert!(cause["remaining_mm"].as_f64().expect("a number") <= 1.25 * 1e3 * TOLERANCE, "{cause}");
    }
    // Bent: nothing explains it.
    let bent = moved(outline(), |point| Vector2::new(point.x * 1.01, point.y));
    assert!(diagnosis(&check(&bent)).is_empty());
}

/// The STEP file of a cam with these changes.
fn solid(overrides: &[&str]) -> String {
    let set: Vec<&str> = overrides.iter().flat_map(|change| ["--set", *change]).collect();
    let made =
        run(0, &[&["make", "feeder", "--out", ".", "--name", "s", "--format", "step", "--quiet"], &set[..]].concat());
    fs::read_to_string(made.directory.path().join("s.step")).expect("a file")
}

/// Every point and direction of a STEP file, changed.
fn placed(text: &str, to: impl Fn([f64; 3]) -> [f64; 3]) -> String {
    let line = |line: &str| {
        let is_vector = ["= CARTESIAN_POINT(", "= DIRECTION("].iter().any(|of| line.contains(of));
        let Some((head, rest)) = line.rsplit_once('(').filter(|_| is_vector) else { return line.to_owned() };
        let (numbers, tail) = rest.split_once(')').expect("a list");
        let values: Vec<f64> = numbers.split(", ").map(|number| number.parse().expect("a number")).collect();
        let Ok(values) = <[f64; 3]>::try_from(values) else { return line.to_owned() };
        let [x, y, z] = to(values).map(|value| format!("{value:?}"));
        format!("{head}({x}, {y}, {z}){tail}")
    };
    text.lines().map(|of| line(of) + "\n").collect()
}

#[test]
fn solids_have_the_verdicts_of_drawings() {
    let own = solid(&[]);
    judged(FileVerdict::ThisCam, own.as_bytes());
    // The same bore is wrong in both files.
    let narrow = solid(&["cam.bore_radius=11.9mm"]);
    let report = judged(FileVerdict::ThisCamBut, narrow.as_bytes());
    assert!(note(&report, "bore").contains("the bore has a radius of 11.9000 mm, not 12.0000 mm"), "{report:?}");
    judged(FileVerdict::ThisCamBut, &plain(&(polyline(outline(), "CAM_PROFILE") + &BORE.replace("40 12", "40 11.9"))));
    let told = |report: &Report| diagnosis(report).first().map(ToString::to_string).unwrap_or_default();
    for (to, words) in [
        ((|[x, y, z]| [x, -z, y]) as fn([f64; 3]) -> [f64; 3], "turned by 90° about X"),
        (|[x, y, z]| [z, y, -x], "turned by 90° about Y"),
        (|[x, y, z]| [x, -y, -z], "turned over about X"),
    ] {
        let report = judged(FileVerdict::NotThisCam, placed(&own, to).as_bytes());
        assert!(told(&report).contains(words), "{words}: {}", told(&report));
    }
    let inch = "(CONVERSION_BASED_UNIT('INCH', #90001) LENGTH_UNIT() NAMED_UNIT(*));\n\
        #90001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4), #90002);\n\
        #90002 = (LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.));";
    let called = own.replace("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.));", inch);
    assert_ne!(called, own);
    let report = judged(FileVerdict::NotThisCam, called.as_bytes());
    assert!(told(&report).contains("scaled"), "{}", told(&report));
    // Another cam lying down is another cam.
    let other = solid(&["cam.base_radius=24mm"]);
    let report = judged(FileVerdict::NotThisCam, placed(&other, |[x, y, z]| [x, -z, y]).as_bytes());
    assert!(!told(&report).contains("the rest of the solid is right"), "{}", told(&report));
}

/// A table with a byte order mark, or with semicolons and decimal commas, is the table; one of other columns is no DXF file.
#[test]
fn tables_of_other_programs_are_no_drawings() {
    let mut made = run(0, &["make", "feeder", "--out", ".", "--name", "t", "--format", "csv,dxf", "--quiet"]);
    let path = made.directory.path().to_owned();
    let table = fs::read_to_string(path.join("t.csv")).expect("a table");
    fs::write(path.join("bom.csv"), format!("\u{feff}{table}")).expect("written");
    fs::write(path.join("semicolons.csv"), format!("\u{feff}{}", table.replace(',', ";").replace('.', ",")))
        .expect("written");
    fs::write(path.join("other.csv"), "Winkel;Hub\n0;0,1\n1;0,2\n2;0,3\n3;0,4\n").expect("written");
    for (name, code) in [("bom.csv", 0), ("semicolons.csv", 0), ("other.csv", 2)] {
        made = camgen_in(made.directory, &["check", name, "--design", "feeder"]);
        assert_eq!(made.code, code, "{name}: {} {}", made.out, made.err);
        assert!(!made.err.contains("DXF"), "{name}: {}", made.err);
    }
    assert!(made.err.contains("a table of numbers (CSV)"), "{}", made.err);
}

/// A cutter that changes nothing is a mistake of whoever gives it.
#[test]
fn a_cutter_without_an_effect_is_refused() {
    let fixed = ["--set", "cam.base_radius=40mm"];
    let name = ["make", "feeder", "--out", ".", "--name", "c", "--format", "dxf,step", "--quiet"];
    let mut made = camgen(&[&name, &fixed[..]].concat());
    for file in ["c.dxf", "c.step"] {
        let args = ["check", file, "--design", "feeder", "--cutter-radius", "3mm"];
        made = camgen_in(made.directory, &[&args, &fixed[..]].concat());
        assert_eq!(made.code, 2, "{file}: {} {}", made.out, made.err);
        assert!(made.err.contains("have no effect; leave them out"), "{file}: {}", made.err);
    }
    // A base radius that is chosen depends on the cutter.
    let auto = ["check", "c.dxf", "--design", "feeder", "--cutter-radius", "3mm"];
    made = camgen_in(made.directory, &auto);
    assert!(made.code != 2, "{} {}", made.out, made.err);
}

/// The summary names the reason and what to do, and JSON has the verdict.
#[test]
fn the_verdict_is_in_the_summary_and_in_json() {
    let mut made = camgen(&["make", "feeder", "--out", ".", "--name", "c", "--format", "dxf", "--quiet"]);
    let path = made.directory.path().to_owned();
    let own = fs::read_to_string(path.join("c.dxf")).expect("a file");
    let hole = "  0\nCIRCLE\n  8\n0\n 10\n20.0\n 20\n0.0\n 30\n0.0\n 40\n1.5\n";
    fs::write(path.join("holed.dxf"), own.replacen("ENTITIES\n", &format!("ENTITIES\n{hole}"), 1)).expect("written");
    fs::write(path.join("layer.dxf"), own.replace("CAM_PROFILE", "PART")).expect("written");
    fs::write(path.join("unit.dxf"), own.replacen("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n17\n", 1)).expect("written");
    for (name, key, words) in [
        ("c.dxf", "this cam", &["THIS CAM · outline within"][..]),
        ("layer.dxf", "this cam", &["THIS CAM · outline within", "note         layer CAM_PROFILE is empty or missing"]),
        (
            "holed.dxf",
            "this cam, but",
            &["THIS CAM, BUT 1 thing more would be cut · outline", "remedy       if wanted"],
        ),
        (
            "unit.dxf",
            "this cam, but",
            &["THIS CAM, BUT its unit is not known", "remedy       save the file in millimetres"],
        ),
    ] {
        let summary = summary_of(&["check", &path.join(name).display().to_string(), "--design", "feeder"]);
        assert_eq!(summary.code, i32::from(key != "this cam"), "{name}: {}", summary.out);
        assert!(words.iter().all(|words| summary.out.contains(words)), "{name}: {}", summary.out);
        assert!(!summary.out.contains("units 1.000 mm"), "{}", summary.out);
        made = camgen_in(made.directory, &["check", name, "--design", "feeder", "--json"]);
        let report: Value = serde_json::from_str(&made.out).expect("JSON");
        assert_eq!(report["verdict"], key, "{name}");
    }
}
