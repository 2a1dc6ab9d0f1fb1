//! Faults planted in a written DXF: each must be caught, with the right check and at the right angle.

use assert_cmd::Command;
use camgen::body::Layer;
use camgen::geometry::Entity;
use camgen::geometry::contour::{Contour, Vertex};
use camgen::tool_files::dxf::{self, Version};
use nalgebra::Vector2;
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

struct Bench {
    directory: TempDir,
}

impl Bench {
    fn new() -> Self {
        Self { directory: tempfile::tempdir().expect("a directory") }
    }

    fn camgen(&self, args: &[&str]) -> (i32, String) {
        let output = Command::cargo_bin("camgen")
            .expect("the program")
            .current_dir(self.directory.path())
            .args(args)
            .output()
            .expect("it runs");
        (output.status.code().expect("a code"), String::from_utf8(output.stdout).expect("UTF-8"))
    }

    /// Writes the default cam and returns its DXF and its table.
    fn cam(&self, args: &[&str]) -> (String, Vec<Vec<f64>>) {
        let all = [&["rotary", "--quiet", "--name", "cam", "--out", ".", "--format", "dxf,csv"], args].concat();
        assert_eq!(self.camgen(&all).0, 0);
        let text = |name: &str| fs::read_to_string(self.path(name)).expect("a file");
        let rows = text("cam.csv")
            .lines()
            .skip(1)
            .map(|l| l.split(',').map(|c| c.parse().expect("a number")).collect())
            .collect();
        (text("cam.dxf"), rows)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// The verdict of `camgen check` on a text: exit code and report.
    fn check(&self, text: &[u8], args: &[&str]) -> (i32, Value) {
        fs::write(self.path("edited.dxf"), text).expect("written");
        // Without a machine the record beside the file would tell the design.
        let named = args.first().is_some_and(|arg| !arg.starts_with("--"));
        let machine: &[&str] = if named { &[] } else { &["dpi"] };
        let (code, out) = self.camgen(&[&["check", "edited.dxf", "--json"], machine, args].concat());
        (code, serde_json::from_str(&out).unwrap_or(Value::Null))
    }
}

fn failed(report: &Value) -> Vec<String> {
    let checks = report["checks"].as_array().expect("checks");
    checks.iter().filter(|c| c["verdict"] == "fail").map(|c| c["check"].as_str().expect("a name").to_owned()).collect()
}

fn angle(report: &Value, check: &str) -> f64 {
    let checks = report["checks"].as_array().expect("checks");
    let finding = checks.iter().find(|c| c["check"] == check).unwrap_or_else(|| panic!("no {check}: {report}"));
    finding["cam_deg"].as_f64().unwrap_or_else(|| panic!("no angle: {finding}"))
}

/// The vertices of the only polyline of a file of ours.
fn vertices(dxf: &str) -> Vec<Vertex> {
    let drawing = ::dxf::Drawing::load(&mut dxf.as_bytes()).expect("read");
    let found = drawing.entities().find_map(|entity| match &entity.specific {
        ::dxf::entities::EntityType::LwPolyline(line) => Some(line.vertices.clone()),
        _ => None,
    });
    let vertex = |v: &::dxf::LwPolylineVertex| Vertex::new(Vector2::new(v.x, v.y), v.bulge);
    found.expect("a polyline").iter().map(vertex).collect()
}

/// The bore of the default cam.
fn bulge(vertex: &Vertex) -> f64 {
    vertex.bulge().expect("an arc or a line")
}

fn bore() -> (Layer, Entity) {
    (Layer::Bore, Entity::Circle(Vector2::zeros(), 25.0))
}

fn file(vertices: Vec<Vertex>) -> Vec<u8> {
    dxf::write(&[(Layer::CamProfile, Entity::Polyline(Contour { vertices })), bore()], Version::R2000)
}

fn polar(point: Vector2<f64>) -> f64 {
    point.y.atan2(point.x).to_degrees().rem_euclid(360.0)
}

fn apart(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(360.0);
    d.min(360.0 - d)
}

#[test]
fn the_file_as_written_passes_and_so_do_harmless_edits() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    let (code, report) = bench.check(dxf.as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (0, vec![]));

    let original = vertices(&dxf);
    let mut turned = original.clone();
    turned.rotate_left(7);
    // The other way round: segment i runs from vertex i + 1 to vertex i.
    let n = original.len();
    let clockwise: Vec<Vertex> =
        (0..n).rev().map(|i| Vertex::new(original[(i + 1) % n].point, -bulge(&original[i]))).collect();
    for edited in [turned, clockwise] {
        let (code, report) = bench.check(&file(edited), &[]);
        assert_eq!((code, failed(&report)), (0, vec![]), "{report}");
    }
    for version in ["r12", "r2010", "r2013"] {
        let (dxf, _) = bench.cam(&["--dxf-version", version]);
        assert_eq!(bench.check(dxf.as_bytes(), &[]).0, 0, "{version}");
    }
    // Exploded into loose arcs and written by another program's writer.
    let mut drawing = ::dxf::Drawing::new();
    drawing.header.version = ::dxf::enums::AcadVersion::R2000;
    drawing.header.default_drawing_units = ::dxf::enums::Units::Millimeters;
    for segment in (Contour { vertices: original }).segments().expect("arcs") {
        let (centre, radius) = (segment.centre(), segment.radius().abs());
        let (from, to) = if segment.bulge > 0.0 { (segment.start, segment.end) } else { (segment.end, segment.start) };
        let centre_3d = ::dxf::Point::new(centre.x, centre.y, 0.0);
        let arc = ::dxf::entities::Arc::new(centre_3d, radius, polar(from - centre), polar(to - centre));
        let mut entity = ::dxf::entities::Entity::new(::dxf::entities::EntityType::Arc(arc));
        entity.common.layer = "CAM_PROFILE".into();
        drawing.add_entity(entity);
    }
    let circle = ::dxf::entities::Circle::new(::dxf::Point::origin(), 25.0);
    drawing.add_entity(::dxf::entities::Entity::new(::dxf::entities::EntityType::Circle(circle)));
    let mut bytes = Vec::new();
    drawing.save(&mut bytes).expect("saved");
    let (code, report) = bench.check(&bytes, &[]);
    assert_eq!((code, failed(&report)), (0, vec![]), "{report}");
}

#[test]
fn a_vertex_moved_by_20_micrometres() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    for (index, by) in [(9, 0.02), (20, -0.02)] {
        let mut edited = vertices(&dxf);
        let point = edited[index].point;
        edited[index].point += point.normalize() * by;
        let (code, report) = bench.check(&file(edited), &[]);
        assert_eq!(code, 1);
        assert!(failed(&report).contains(&"rolling".to_owned()), "{report}");
        // The contact lies off the roller's path by the pressure angle: 20° of the cam at the most here.
        assert!(apart(angle(&report, "rolling"), polar(point)) < 20.0, "{report}");
        let missing = report["rolling"]["gap_mm"].as_f64().expect("a gap") > 0.0;
        assert_eq!(missing, by < 0.0, "metal is missing where the vertex went inwards");
    }
}

#[test]
fn a_flipped_bulge() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    let original = vertices(&dxf);
    let contour = Contour { vertices: original.clone() };
    let mut tried = 0;
    for (index, segment) in contour.segments().expect("arcs").into_iter().enumerate() {
        let sagitta = 0.5 * (segment.end - segment.start).norm() * segment.bulge.abs();
        if sagitta <= 0.05 {
            continue;
        }
        tried += 1;
        let mut edited = original.clone();
        edited[index] = Vertex::new(edited[index].point, -bulge(&edited[index]));
        let (code, report) = bench.check(&file(edited), &[]);
        assert_eq!(
            (code, failed(&report)),
            (1, vec!["tangency".into(), "outline".into(), "rolling".into()]),
            "segment {index}"
        );
        // The dwell is a long arc; elsewhere the place is told.
        if segment.sweep() < 1.0 {
            assert!(apart(angle(&report, "rolling"), polar(segment.middle())) < 25.0, "segment {index}: {report}");
        }
    }
    assert!(tried > 20, "{tried}");
}

#[test]
fn another_roller_another_speed_and_another_machine() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&["--set", "follower.roller.radius=30.1mm"]);
    let (code, report) = bench.check(dxf.as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (1, vec!["outline".to_owned(), "rolling".to_owned()]));
    // What the shape hides at the dwell shows on the flanks, where the pressure angle is large.
    let at = angle(&report, "rolling");
    assert!((30.0..70.0).contains(&at) || (110.0..150.0).contains(&at), "{at}");
    assert_eq!(bench.check(dxf.as_bytes(), &["--set", "follower.roller.radius=30.1mm"]).0, 0);
    let (dxf, _) = bench.cam(&[]);
    assert_eq!(bench.check(dxf.as_bytes(), &["--rpm", "34"]).0, 1);
    assert_eq!(bench.check(dxf.as_bytes(), &["dpi-paper"]).0, 1);
    assert_eq!(bench.check(dxf.as_bytes(), &["--tolerance", "1um"]).0, 1, "it was written to 5 um");
}

#[test]
fn an_outline_offset_radially() {
    let bench = Bench::new();
    let (_, rows) = bench.cam(&["--samples", "7200"]);
    let radially = |row: &Vec<f64>| {
        let centre = Vector2::new(row[8], row[9]);
        Vertex::new(centre * (1.0 - 30.0 / centre.norm()), 0.0)
    };
    let (code, report) = bench.check(&file(rows.iter().map(radially).collect()), &[]);
    assert_eq!(code, 1);
    assert!(failed(&report).contains(&"rolling".to_owned()), "{report}");
    let at = angle(&report, "rolling");
    assert!((30.0..70.0).contains(&at) || (110.0..150.0).contains(&at), "where the pressure angle is large: {at}");
    // The same number of chords through the true profile gives the law, but has kinks.
    let truly = |row: &Vec<f64>| Vertex::new(Vector2::new(row[10], row[11]), 0.0);
    let (code, report) = bench.check(&file(rows.iter().map(truly).collect()), &[]);
    assert_eq!((code, failed(&report)), (1, vec!["tangency".to_owned()]), "{report}");
}

#[test]
fn mirrored_rotated_and_scaled() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    let original = vertices(&dxf);
    let mapped = |f: &dyn Fn(Vector2<f64>) -> Vector2<f64>| -> Vec<Vertex> {
        original.iter().map(|v| Vertex { point: f(v.point), ..*v }).collect()
    };
    let (sin, cos) = 0.05_f64.to_radians().sin_cos();
    for (what, edited) in [
        ("mirrored", Contour { vertices: original.clone() }.mirrored_about_x().vertices),
        ("rotated", mapped(&|p| Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y))),
        ("scaled", mapped(&|p| p * 25.4)),
        ("in inches by mistake", mapped(&|p| p / 25.4)),
    ] {
        let (code, report) = bench.check(&file(edited), &[]);
        // So far off, the force is not balanced either.
        let beside: Vec<String> = failed(&report).into_iter().filter(|check| check != "residual").collect();
        assert_eq!((code, beside), (1, vec!["outline".to_owned(), "rolling".to_owned()]), "{what}: {report}");
    }
    // The default cam is symmetric about Y, so that mirror image is the cam itself.
    let n = original.len();
    let about_y: Vec<Vertex> = (0..n)
        .rev()
        .map(|i| {
            let start = original[(i + 1) % n].point;
            Vertex { point: Vector2::new(-start.x, start.y), ..original[i] }
        })
        .collect();
    assert_eq!(bench.check(&file(about_y), &[]).0, 0);
}

#[test]
fn opened_doubled_and_misplaced() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    let (head, polyline) = dxf.split_once("AcDbPolyline\n").expect("one polyline");
    let opened = format!("{head}AcDbPolyline\n{}", polyline.replacen("\n 70\n1\n", "\n 70\n0\n", 1));
    assert_ne!(opened, dxf);
    let (code, report) = bench.check(opened.as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (1, vec!["closed".to_owned()]), "{report}");
    let last = vertices(&dxf).last().expect("vertices").point;
    assert!(apart(angle(&report, "closed"), polar(last)) < 1e-6, "{report}");

    // One arc of the outline a second time, as a polyline of its own.
    let v = vertices(&dxf);
    let arc = Contour { vertices: vec![v[5], Vertex::new(v[6].point, 0.0)] };
    let twice = dxf::write(
        &[
            (Layer::CamProfile, Entity::Polyline(Contour { vertices: v.clone() })),
            (Layer::CamProfile, Entity::Polyline(arc)),
            bore(),
        ],
        Version::R2000,
    );
    let text = String::from_utf8(twice).expect("ASCII").replacen(" 90\n2\n 70\n1\n", " 90\n2\n 70\n0\n", 1);
    let (code, report) = bench.check(text.as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (0, Vec::new()), "{report}");
    assert!(apart(angle(&report, "duplicates"), polar(v[5].point)) < 10.0, "{report}");

    let edited = dxf.replacen("BORE\n100\nAcDbCircle", "CAM_PROFILE\n100\nAcDbCircle", 1);
    assert_ne!(edited, dxf);
    let (code, report) = bench.check(edited.as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (0, Vec::new()), "{report}");
    // Millimetres that are called inches would be cut 25.4 times too large.
    let inches = dxf.replacen("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n1\n", 1);
    let (code, report) = bench.check(inches.as_bytes(), &[]);
    let found = failed(&report);
    assert!(code == 1 && ["outline", "rolling"].iter().all(|check| found.contains(&(*check).to_owned())), "{report}");
    let (code, report) = bench.check(dxf.replace("CAM_PROFILE", "PROFILE").as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (0, Vec::new()), "{report}");
}

#[test]
fn cut_twice() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    let original = vertices(&dxf);
    // Once round with the arcs of the file and once with their halves: no segment lies on another, but the tool goes twice.
    let halves = Contour { vertices: original.clone() };
    let halves = halves.segments().expect("arcs").into_iter().flat_map(|s| {
        let bulge = (s.bulge.atan() / 2.0).tan();
        [Vertex::new(s.start, bulge), Vertex::new(s.middle(), bulge)]
    });
    let (code, report) = bench.check(&file(original.iter().copied().chain(halves).collect()), &[]);
    assert_eq!((code, failed(&report)), (1, vec!["contours".to_owned(), "outline".to_owned()]), "{report}");

    let again = |layer| {
        let line = || Entity::Polyline(Contour { vertices: original.clone() });
        dxf::write(&[(Layer::CamProfile, line()), (layer, line()), bore()], Version::R2000)
    };
    // An exact repetition is the same part.
    let (code, report) = bench.check(&again(Layer::Bore), &[]);
    assert_eq!((code, failed(&report)), (0, Vec::new()), "{report}");
}

#[test]
fn what_lies_in_paper_space_or_across_the_plane_is_not_cut() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    let paper = dxf.replacen("AcDbEntity\n  8\nCAM_PROFILE", "AcDbEntity\n 67\n1\n  8\nCAM_PROFILE", 1);
    assert_ne!(paper, dxf);
    let (code, report) = bench.check(paper.as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (1, vec!["layer".to_owned(), "contours".to_owned()]), "{report}");
    let tilted = dxf.replacen("AcDbPolyline\n", "AcDbPolyline\n210\n0.0\n220\n0.6\n230\n0.8\n", 1);
    let (code, report) = bench.check(tilted.as_bytes(), &[]);
    assert_eq!((code, failed(&report)), (1, vec!["readable".to_owned(), "contours".to_owned()]), "{report}");
    let lower = dxf.replace("CAM_PROFILE", "cam_profile");
    assert_eq!(bench.check(lower.as_bytes(), &[]).0, 0, "names of layers are alike in either case");
}

#[test]
fn what_cannot_be_read_is_exit_2() {
    let bench = Bench::new();
    let (dxf, _) = bench.cam(&[]);
    for bytes in [&b""[..], b"hello", b"hello\nEOF\n", &dxf.as_bytes()[..dxf.len() / 2], &[0xff; 99]] {
        assert_eq!(bench.check(bytes, &[]).0, 2);
    }
    for args in [&["check"][..], &["check", "no.dxf"], &["check", "."], &["check", "cam.dxf", "--rpm", "0"]] {
        assert_eq!(bench.camgen(args).0, 2, "{args:?}");
    }
    let nan = dxf.replacen(" 42\n0.", " 42\nnan", 1);
    assert_eq!(bench.check(nan.as_bytes(), &[]).0, 2);
}

/// Segments shorter than the reach within which loose ends are joined are still segments.
#[test]
fn a_transition_of_a_fraction_of_a_micrometre() {
    let bench = Bench::new();
    let narrow = ["--set", "transition.width=0.0001deg"];
    let (dxf, _) = bench.cam(&narrow);
    let (code, report) = bench.check(dxf.as_bytes(), &narrow);
    assert_eq!((code, failed(&report)), (0, vec![]), "{report}");
}

/// A chain of ten thousand segments is checked too; how long it takes is a benchmark.
#[test]
fn ten_thousand_segments() {
    let bench = Bench::new();
    let (_, rows) = bench.cam(&["--samples", "10000"]);
    let vertices = rows.iter().map(|row| Vertex::new(Vector2::new(row[10], row[11]), 0.0)).collect();
    let (code, report) = bench.check(&file(vertices), &[]);
    assert_eq!((code, failed(&report)), (1, vec!["tangency".to_owned()]), "{report}");
    assert_eq!(report["rolling"]["segments"], 10_000);
}
