//! What would be cut must be the part: files that hold more, less or something else, and files that hold it in another form.

use camgen::body::Layer;
use camgen::domains::press::SpecOfPress;
use camgen::geometry::Entity;
use camgen::geometry::contour::{Contour, Segment, Vertex};
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Error, Spec};
use camgen::report::{Report, Verdict};
use camgen::tool_files::dxf::{self, Version};
use nalgebra::Vector2;
use std::fmt::Write as _;
use std::sync::OnceLock;

const TOLERANCE: f64 = 5e-6;

/// The default cam, and one with a keyway.
fn cams() -> &'static [Cam; 2] {
    static CAMS: OnceLock<[Cam; 2]> = OnceLock::new();
    CAMS.get_or_init(|| {
        let keyway = ["cam.keyway.width=8mm", "cam.keyway.depth=3.3mm", "cam.keyway.angle=30deg"].map(str::to_owned);
        [&[][..], &keyway].map(|overrides| {
            let machine = Machine::load("dpi", overrides).expect("valid").0;
            Spec::rotary(machine, 35.0).solve().expect("a cam")
        })
    })
}

/// What the default cam and the one with a keyway cut.
fn parts() -> &'static [Vec<(Layer, Entity)>; 2] {
    static PARTS: OnceLock<[Vec<(Layer, Entity)>; 2]> = OnceLock::new();
    PARTS.get_or_init(|| {
        [0, 1]
            .map(|index| cams()[index].draw(TOLERANCE).expect("drawn").drawn().expect("an outline").parts[0].entities())
    })
}

fn outline() -> Contour {
    parts()[0][0].1.contour()
}

/// The text of a file with entities, blocks and layers given as groups: each line a code and a value.
fn text(layers: &str, blocks: &str, entities: &str) -> Vec<u8> {
    let section = |name: &str, groups: &str| format!("0 SECTION\n2 {name}\n{groups}\n0 ENDSEC\n");
    let table = format!("0 TABLE\n2 LAYER\n{layers}\n0 ENDTAB");
    let all = [
        section("HEADER", "9 $INSUNITS\n70 4"),
        section("TABLES", &table),
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

fn polyline(contour: &Contour, layer: &str, more: &str) -> String {
    let mut groups = format!("0 LWPOLYLINE\n8 {layer}\n90 {}\n70 1\n{more}\n", contour.vertices.len());
    for vertex in &contour.vertices {
        let (point, bulge) = (vertex.point, vertex.bulge().expect("an arc or a line"));
        writeln!(groups, "10 {:?}\n20 {:?}\n42 {bulge:?}", point.x, point.y).expect("written");
    }
    groups
}

const BORE: &str = "0 CIRCLE\n8 BORE\n10 0\n20 0\n40 25";

/// The default cam as an outline with whatever else.
fn with(entities: &str) -> Vec<u8> {
    text("", "", &format!("{}\n{entities}", polyline(&outline(), "CAM_PROFILE", "")))
}

fn check_of(index: usize, bytes: &[u8]) -> Result<Report, Error> {
    cams()[index].check(bytes, TOLERANCE)
}

fn check(bytes: &[u8]) -> Report {
    check_of(0, bytes).unwrap_or_else(|error| panic!("{error}"))
}

fn failed(report: &Report) -> Vec<String> {
    report.checks.iter().filter(|c| c.verdict == Verdict::Fail).map(|c| c.check.to_string()).collect()
}

fn note(report: &Report, check: &str) -> String {
    let finding = report.checks.iter().find(|c| c.check == check).unwrap_or_else(|| panic!("no {check}"));
    finding.note_words()
}

/// It fails in that check only, and the note says so in these words.
fn fails(bytes: &[u8], in_check: &str, words: &[&str]) {
    let report = check(bytes);
    assert_eq!(failed(&report), [in_check], "{report:?}");
    for word in words {
        assert!(note(&report, in_check).contains(word), "{word}: {}", note(&report, in_check));
    }
}

fn passes(bytes: &[u8], what: &str) {
    let report = check(bytes);
    assert!(report.passed(), "{what}: {:?}", report.checks);
}

#[test]
fn the_part_passes_in_either_form() {
    passes(&with(BORE), "as it is");
    for (index, part) in parts().iter().enumerate() {
        for (name, version) in Version::ALL {
            let report = check_of(index, &dxf::write(part, version)).expect("read");
            assert!(report.passed(), "{name}: {:?}", report.checks);
        }
    }
}

#[test]
fn a_wrong_bore_is_told() {
    fails(&with(""), "bore", &["the bore is missing"]);
    for (circle, words) in [
        ("10 1\n20 0\n40 25", "CIRCLE on layer BORE at (1.000, 0.000) mm: the bore is moved by (1.0000, 0.0000) mm"),
        ("10 0\n20 -5\n40 25", "the bore is moved by (0.0000, -5.0000) mm"),
        ("10 0\n20 0\n40 60", "the bore has a radius of 60.0000 mm, not 25.0000 mm"),
        ("10 0\n20 0\n40 10", "the bore has a radius of 10.0000 mm"),
        ("10 0.0051\n20 0\n40 25", "is moved by (0.0051, 0.0000) mm"),
    ] {
        fails(&with(&format!("0 CIRCLE\n8 BORE\n{circle}")), "bore", &[words]);
    }
    passes(&with("0 CIRCLE\n8 HOLES\n10 0.0049\n20 0\n40 25"), "within the tolerance, on any layer");
    let report = check_of(0, &dxf::write(&parts()[1], Version::R2000)).expect("read");
    assert_eq!(failed(&report), ["bore"], "a keyway where none belongs");
}

#[test]
fn a_wrong_keyway_is_told() {
    let check = |entities: &[(Layer, Entity)]| check_of(1, &dxf::write(entities, Version::R2000)).expect("read");
    let [plain, keyed] = parts();
    assert!(check(keyed).passed());
    let report = check(plain);
    assert_eq!((failed(&report), note(&report, "bore").contains("has no keyway")), (vec!["bore".to_owned()], true));
    let bore = keyed[1].1.contour();
    let turned = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let turn = |p: Vector2<f64>| Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
        Contour { vertices: bore.vertices.iter().map(|v| Vertex { point: turn(v.point), ..*v }).collect() }
    };
    let mut wide = bore.clone();
    wide.vertices[2].point *= 1.001;
    for wrong in [turned(1e-3), turned(std::f64::consts::PI), bore.mirrored_about_x(), wide] {
        let file = [plain[0].clone(), (Layer::Bore, Entity::Polyline(wrong))];
        assert_eq!(failed(&check(&file)), ["bore"]);
    }
}

#[test]
fn what_else_would_be_cut_is_named_with_its_layer_and_place() {
    for (more, words) in [
        ("0 CIRCLE\n8 BORE\n10 150\n20 0\n40 30", "CIRCLE on layer BORE at (150.000, 0.000) mm would be cut"),
        ("0 CIRCLE\n8 NOTES\n10 150\n20 0\n40 30", "CIRCLE on layer NOTES at (150.000, 0.000) mm"),
        ("0 LINE\n8 0\n10 -100\n20 300\n11 100\n21 300", "LINE on layer 0 at (0.000, 300.000) mm (open) would be cut"),
        (
            "0 ELLIPSE\n8 0\n10 80\n20 0\n11 9\n21 0\n40 0.5\n41 0\n42 6.283185307179586",
            "ELLIPSE on layer 0 at (80.000",
        ),
        (
            "0 SPLINE\n8 0\n70 8\n71 1\n40 0\n40 0\n40 1\n40 1\n10 0\n20 0\n10 9\n20 9",
            "SPLINE on layer 0 at (4.500, 4.500)",
        ),
    ] {
        fails(&with(&format!("{BORE}\n{more}")), "bore", &[words]);
    }
    // An exact second copy is the same part.
    passes(&with(&format!("{BORE}\n{BORE}")), "a bore twice");
    passes(&with(&format!("{BORE}\n{}", polyline(&outline(), "0", ""))), "an outline twice");
}

#[test]
fn a_block_is_cut_where_it_is_inserted() {
    let block =
        |name: &str, entities: &str| format!("0 BLOCK\n8 0\n2 {name}\n70 0\n10 0\n20 0\n{entities}\n0 ENDBLK\n");
    let file = |blocks: &str, entities: &str| text("", blocks, entities);
    let part = format!("{}\n{BORE}", polyline(&outline(), "0", ""));
    // The outline takes the layer it is inserted on.
    passes(&file(&block("CAM", &part), "0 INSERT\n8 CAM_PROFILE\n2 CAM\n10 0\n20 0"), "an inserted cam");
    let nested = block("A", &part) + &block("B", "0 INSERT\n8 0\n2 a\n10 7\n20 3\n50 90");
    passes(
        &file(&nested, "0 INSERT\n8 CAM_PROFILE\n2 B\n10 -3\n20 7\n50 -90\n"),
        "a block within a block, turned back",
    );
    let moved = format!("0 BLOCK\n8 0\n2 C\n10 40\n20 50\n{part}\n0 ENDBLK\n");
    passes(&file(&moved, "0 INSERT\n8 CAM_PROFILE\n2 C\n10 40\n20 50"), "a base point");
    let half = format!("{}\n{BORE}", polyline(&scaled(0.5), "0", "")).replace("40 25", "40 12.5");
    passes(&file(&block("H", &half), "0 INSERT\n8 CAM_PROFILE\n2 H\n10 0\n20 0\n41 2\n42 2\n43 2"), "scaled");
    let mirrored = format!("{}\n{BORE}", polyline(&outline().mirrored_about_x(), "0", ""));
    passes(&file(&block("M", &mirrored), "0 INSERT\n8 CAM_PROFILE\n2 M\n10 0\n20 0\n42 -1"), "mirrored");
    // From behind x is reversed: turned by half a turn that is the mirror about X.
    passes(
        &file(&block("M", &mirrored), "0 INSERT\n8 CAM_PROFILE\n2 M\n10 0\n20 0\n50 180\n230 -1\n210 0\n220 0"),
        "from behind",
    );

    let second = block("TWICE", &polyline(&scaled(1.1), "0", ""));
    let outline = format!("{}\n{BORE}", polyline(&outline(), "CAM_PROFILE", ""));
    let report = check(&file(&second, &format!("{outline}\n0 INSERT\n8 0\n2 TWICE\n10 0\n20 0")));
    assert_eq!(failed(&report), ["bore"]);
    assert!(note(&report, "bore").contains("LWPOLYLINE on layer 0"), "{}", note(&report, "bore"));
    // An array that is inserted: six holes.
    let hole = block("HOLE", "0 CIRCLE\n8 0\n10 0\n20 0\n40 4");
    let array = "0 INSERT\n8 HOLES\n2 HOLE\n10 50\n20 60\n70 3\n71 2\n44 20\n45 15";
    let report = check(&file(&hole, &format!("{outline}\n{array}")));
    assert!(note(&report, "bore").contains("CIRCLE on layer HOLES at (90.000, 60.000)"), "{}", note(&report, "bore"));
    assert!(note(&report, "bore").contains("and 1 more"), "{}", note(&report, "bore"));

    // What cannot be resolved is told; it neither hangs nor fills the memory.
    let round = block("X", "0 INSERT\n8 0\n2 Y\n10 0\n20 0") + &block("Y", "0 INSERT\n8 0\n2 X\n10 0\n20 0");
    let bomb = (0..12).fold(block("B0", "0 POINT\n8 0\n10 0\n20 0"), |blocks, level| {
        let inside = format!("0 INSERT\n8 0\n2 B{level}\n10 0\n20 0\n70 30000\n71 30000");
        blocks + &block(&format!("B{}", level + 1), &inside)
    });
    for (blocks, insert, words) in [
        (round, "2 X", "contains itself"),
        (String::new(), "2 NONE", "which the file does not contain"),
        (block("Z", BORE), "2 Z\n41 0", "scaled by 0"),
        (block("Z", BORE) + &block("z", BORE), "2 Z", "which the file contains twice"),
        (block("XREF", "").replace("70 0", "70 4"), "2 XREF", "in another file"),
    ] {
        fails(&file(&blocks, &format!("{outline}\n0 INSERT\n8 0\n10 0\n20 0\n{insert}")), "readable", &[words]);
    }
    let many = file(&bomb, &format!("{outline}\n0 INSERT\n8 0\n10 0\n20 0\n2 B12"));
    let refused = check_of(0, &many).expect_err("too many").to_string();
    assert!(refused.contains("more than 1000000 entities"), "{refused}");
}

fn scaled(by: f64) -> Contour {
    Contour { vertices: outline().vertices.iter().map(|v| Vertex { point: v.point * by, ..*v }).collect() }
}

#[test]
fn what_is_not_seen_is_not_cut() {
    let layers = "0 LAYER\n2 OFF\n70 0\n62 -7\n0 LAYER\n2 FROZEN\n70 1\n62 7\n0 LAYER\n2 ON\n70 0\n62 7";
    let line = |layer: &str| format!("0 LINE\n8 {layer}\n10 0\n20 0\n11 9\n21 0");
    let both = format!(
        "0 BLOCK\n8 0\n2 ON\n10 0\n20 0\n{}\n0 ENDBLK\n0 BLOCK\n8 0\n2 NIL\n10 0\n20 0\n{}\n0 ENDBLK",
        line("ON"),
        line("0")
    );
    let file =
        |more: &str| text(layers, &both, &format!("{}\n{BORE}\n{more}", polyline(&outline(), "CAM_PROFILE", "")));
    let insert = |block: &str, layer: &str| format!("0 INSERT\n8 {layer}\n2 {block}\n10 0\n20 0");
    for (more, seen) in [
        (line("off"), false),
        (line("Frozen"), false),
        (line("ON"), true),
        (line("ON\n60 1"), false),
        (line("ON\n67 1"), false),
        // A block on a layer that is off shows what it has on layers that are on; on a frozen one nothing is seen.
        (insert("ON", "OFF"), true),
        (insert("NIL", "OFF"), false),
        (insert("ON", "FROZEN"), false),
        (insert("NIL", "ON"), true),
        (insert("ON", "ON\n60 1"), false),
    ] {
        let report = check(&file(&more));
        assert_eq!(failed(&report), if seen { vec!["bore"] } else { vec![] }, "{more}");
    }
    assert!(note(&check(&file(&line("OFF"))), "readable").contains("hidden, so not cut: the entities on layer OFF"));
}

#[test]
fn heights_widths_and_planes_are_told() {
    let arcs = |height: &dyn Fn(usize) -> f64| {
        let arc = |(index, s): (usize, Segment)| {
            let (centre, z) = (s.centre(), height(index));
            let angle = |p: Vector2<f64>| (p - centre).y.atan2((p - centre).x).to_degrees();
            let (from, to) = if s.bulge > 0.0 { (s.start, s.end) } else { (s.end, s.start) };
            format!(
                "0 ARC\n8 CAM_PROFILE\n10 {:?}\n20 {:?}\n30 {z}\n40 {:?}\n50 {:?}\n51 {:?}\n",
                centre.x,
                centre.y,
                s.radius().abs(),
                angle(from),
                angle(to)
            )
        };
        outline().segments().expect("arcs").into_iter().enumerate().map(arc).collect::<String>()
    };
    let file = |entities: &str, bore: &str| text("", "", &format!("{entities}\n{bore}"));
    passes(&file(&arcs(&|_| 0.0), BORE), "arcs");
    fails(
        &file(&arcs(&|i| if i == 3 { 7.0 } else { 0.0 }), BORE),
        "readable",
        &["ARC on layer CAM_PROFILE", "7 mm above the rest"],
    );
    fails(&file(&arcs(&|_| 7.0), BORE), "readable", &["CIRCLE on layer BORE", "-7 mm above"]);
    let raised = file(&arcs(&|_| 7.0), &BORE.replace("40 25", "30 7\n40 25"));
    passes(&raised, "all at one height");
    assert!(note(&check(&raised), "readable").contains("a height of 7 mm"));

    let whole = |more: &str| text("", "", &format!("{}\n{BORE}", polyline(&outline(), "CAM_PROFILE", more)));
    fails(&whole("43 3"), "readable", &["LWPOLYLINE on layer CAM_PROFILE", "3 mm wide"]);
    fails(&whole("38 7"), "readable", &["CIRCLE on layer BORE"]);
    passes(&whole("39 30"), "a thickness stands on the same line");
    assert!(note(&check(&whole("39 30")), "readable").contains("thickness"));
    for (extrusion, words) in
        [("210 0\n220 0\n230 0", "without a direction"), ("210 0\n220 0.6\n230 0.8", "does not lie in the plane")]
    {
        let report = check(&whole(extrusion));
        assert_eq!(failed(&report), ["readable", "contours"], "{report:?}");
        assert!(note(&report, "readable").contains(words), "{}", note(&report, "readable"));
    }
    let report = check(&with(&format!("{BORE}\n0 LINE\n8 0\n10 0\n20 0\n30 0\n11 9\n21 0\n31 9")));
    assert!(note(&report, "readable").contains("from 0 to 9 mm above the rest"), "{report:?}");
}

/// Kinds that are nothing known: a shop's program may cut them, or not.
#[test]
fn unknown_kinds_are_told_and_information_is_not() {
    for kind in [
        "REGION", "MLINE", "3DFACE", "SOLID", "TRACE", "HELIX", "RAY", "XLINE", "BODY", "3DSOLID", "MESH", "MPOLYGON",
        "ACME_CUT", "VERTEX",
    ] {
        let more = format!("{BORE}\n0 {kind}\n8 NOTES\n10 1\n20 2");
        fails(&with(&more), "readable", &[&format!("{kind} on layer NOTES at (1.000, 2.000) mm")]);
    }
    for kind in ["TEXT", "MTEXT", "DIMENSION", "LEADER", "POINT", "ATTDEF", "HATCH", "VIEWPORT", "IMAGE"] {
        let entity = |layer: &str| format!("{BORE}\n0 {kind}\n8 {layer}\n10 1\n20 2");
        passes(&with(&entity("NOTES")), kind);
        let report = check(&with(&entity("CAM_PROFILE")));
        let readable = report.checks.iter().find(|c| c.check == "readable").expect("readable");
        assert!(report.passed() && readable.verdict == Verdict::Warn, "{kind}: {readable:?}");
        assert!(note(&report, "readable").contains(kind));
    }
}

#[test]
fn other_ways_to_write_the_outline_are_read() {
    let contour = outline();
    // The first vertex once more at the end of a closed polyline.
    let mut repeated = contour.clone();
    repeated.vertices.push(Vertex::new(contour.vertices[0].point, 0.0));
    passes(&text("", "", &format!("{}\n{BORE}", polyline(&repeated, "CAM_PROFILE", ""))), "LWPOLYLINE");
    let old = |vertices: &[Vertex], flags: i32, each: &str, end: &str| {
        let mut groups = format!("0 POLYLINE\n8 CAM_PROFILE\n66 1\n70 {flags}\n10 0\n20 0\n30 0\n");
        for vertex in vertices {
            let (point, bulge) = (vertex.point, vertex.bulge().expect("an arc or a line"));
            writeln!(groups, "0 VERTEX\n8 CAM_PROFILE\n10 {:?}\n20 {:?}\n42 {bulge:?}\n{each}", point.x, point.y)
                .expect("written");
        }
        text("", "", &format!("{groups}\n{end}\n{BORE}"))
    };
    let end = "0 SEQEND\n8 CAM_PROFILE";
    passes(&old(&repeated.vertices, 1, "", end), "POLYLINE");
    passes(&old(&contour.vertices, 3, "70 1", end), "a fitted curve");
    for (bytes, words) in [
        (old(&contour.vertices, 1, "70 16", end), "not lie on the curve"),
        (old(&contour.vertices, 5, "70 16", end), "not lie on the curve"),
        (old(&contour.vertices, 1, "70 64", end), "mesh"),
        (old(&contour.vertices, 17, "", end), "mesh"),
        (old(&contour.vertices, 1, "", ""), "does not end with SEQEND"),
    ] {
        let report = check(&bytes);
        assert_eq!(failed(&report), ["readable", "contours"], "{words}");
        assert!(note(&report, "readable").contains(words), "{}", note(&report, "readable"));
    }
    // A bulge before the first vertex belongs to none.
    passes(&text("", "", &format!("{}\n{BORE}", polyline(&contour, "CAM_PROFILE", "42 0.5"))), "42 before 10");
    // A group told twice is read one way here and another way there.
    let twice = check(&with(&BORE.replace("40 25", "40 25\n40 60")));
    assert_eq!(failed(&twice), ["readable", "bore"]);
}

/// Points on the exact profile at even angles, closed by the first.
fn profile(count: u32) -> Vec<Vector2<f64>> {
    let curves = camgen::body::curves(cams()[0].body()).expect("plane");
    let (first, last) = curves.motion.range();
    (0..=count)
        .map(|i| {
            let (piece, at) = curves.motion.locate(first + (last - first) * f64::from(i % count) / f64::from(count));
            curves.profile(piece, at).point * 1e3
        })
        .collect()
}

fn fit_points(points: &[Vector2<f64>]) -> String {
    let mut groups = String::new();
    for point in points {
        writeln!(groups, "11 {:?}\n21 {:?}\n31 0", point.x, point.y).expect("written");
    }
    groups
}

/// A SPLINE through fit points, as programs leave it that think the control points follow from them.
#[test]
fn a_spline_with_fit_points_only_is_read() {
    let spline = |count: u32, more: &str| {
        let points = fit_points(&profile(count));
        text("", "", &format!("0 SPLINE\n8 CAM_PROFILE\n71 3\n{more}\n{points}{BORE}"))
    };
    passes(&spline(1800, "70 9"), "closed: smooth all round");
    // Without curvature at its ends it is off by half a degree over their distance: fewer points would leave a kink.
    passes(&spline(14_400, "70 8"), "open");
    let [.., before, _] = profile(100_000)[..] else { panic!("many") };
    let heading = profile(100_000)[1] - before;
    let tangents = |x: f64, y: f64| format!("12 {x:?}\n22 {y:?}\n32 0\n13 {x:?}\n23 {y:?}\n33 0");
    passes(&spline(1800, &format!("70 8\n{}", tangents(heading.x, heading.y))), "open, with tangents");
    let report = check(&spline(1800, &format!("70 8\n{}", tangents(heading.y, -heading.x))));
    assert!(!report.passed(), "tangents that are not those of the profile");
    // The tolerance is kept: points 6 µm too far out fail.
    let out: Vec<Vector2<f64>> = profile(3600).iter().map(|p| p + p.normalize() * 0.006).collect();
    let out = fit_points(&out);
    let report = check(&text("", "", &format!("0 SPLINE\n8 CAM_PROFILE\n70 9\n71 3\n{out}{BORE}")));
    assert!(failed(&report).contains(&"rolling".to_owned()), "{report:?}");
}

/// An oblong scale makes ellipses of arcs: the cam squeezed in its block and stretched by its insertion is the cam.
#[test]
fn an_outline_of_ellipses_is_read_as_finely_as_the_tolerance_asks() {
    let contour = outline();
    let mut ellipses = String::new();
    for s in contour.segments().expect("arcs") {
        let (centre, radius) = (s.centre(), s.radius().abs());
        let (from, to) = if s.bulge > 0.0 { (s.start, s.end) } else { (s.end, s.start) };
        let angle = |p: Vector2<f64>| (p - centre).y.atan2((p - centre).x);
        // Half as high: the major axis along x.
        writeln!(
            ellipses,
            "0 ELLIPSE\n8 0\n10 {:?}\n20 {:?}\n11 {radius:?}\n21 0\n40 0.5\n41 {:?}\n42 {:?}",
            centre.x,
            0.5 * centre.y,
            angle(from),
            angle(to)
        )
        .expect("written");
    }
    ellipses += "0 ELLIPSE\n8 0\n10 0\n20 0\n11 25\n21 0\n40 0.5\n41 0\n42 6.283185307179586\n";
    let halves = ellipses.rsplit_once("0 ELLIPSE").expect("the bore");
    let block = format!(
        "0 BLOCK\n8 0\n2 A\n10 0\n20 0\n{}0 ENDBLK\n0 BLOCK\n8 0\n2 B\n10 0\n20 0\n0 ELLIPSE{}0 ENDBLK",
        halves.0, halves.1
    );
    let insert = |name: &str, layer: &str| format!("0 INSERT\n8 {layer}\n2 {name}\n10 0\n20 0\n41 1\n42 2\n");
    let bytes = text("", &block, &(insert("A", "CAM_PROFILE") + &insert("B", "BORE")));
    passes(&bytes, "stretched");
    // Drawn to 0.05 µm it passes at 0.05 µm.
    let fine = cams()[0].check(&bytes, 5e-8).expect("read");
    let bore = fine.checks.iter().find(|c| c.check == "bore").expect("bore");
    assert!(bore.verdict == Verdict::Pass && bore.value < 5e-6, "{bore:?}");
}

/// Balance holes are proved as the bore is: at the tolerance of the file and at another.
#[test]
fn balance_holes_are_proved() {
    let overrides = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.balance=40mm .. 85mm"].map(str::to_owned);
    let machine = Machine::load("dpi", &overrides).expect("valid").0;
    let cam = Spec::rotary(machine, 35.0).solve().expect("a cam");
    let drawing = cam.draw(TOLERANCE).expect("drawn");
    let part = drawing.drawn().expect("an outline").parts[0].clone();
    let check = |entities: &[(Layer, Entity)], tolerance: f64| {
        failed(&cam.check(&dxf::write(entities, Version::R2000), tolerance).expect("read"))
    };
    let right = part.entities();
    assert!(right.len() > 2, "there are holes");
    assert_eq!(check(&right, TOLERANCE), Vec::<String>::new());
    assert_eq!(check(&right, 2e-5), Vec::<String>::new());
    let mut moved = right.clone();
    if let Some((_, Entity::Circle(centre, _))) = moved.last_mut() {
        centre.x += 0.02;
    }
    assert_eq!(check(&moved, TOLERANCE), ["bore"]);
    assert_eq!(check(&right[..right.len() - 1], TOLERANCE), ["bore"]);
}
