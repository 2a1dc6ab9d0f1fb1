//! `check` of STEP files whose walls stand on splines: judged as exactly as the SPLINEs of a DXF file, and refused where anything
//! of them is changed.

use crate::common::lines::Lines;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::profile::outline::{Fit, SegmentKind, Side};
use camgen::{Cam, Machine, Report, Request, Spec, Verdict, Writing};

const TOLERANCE: f64 = 5e-6;
/// What a control point is moved by, mm.
const MOVED: f64 = 0.02;

fn machine(overrides: &[&str]) -> Machine {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Machine::load("dpi", &overrides).expect("valid").0
}

fn rotary(overrides: &[&str]) -> Cam {
    Spec::rotary(machine(overrides), 35.0).solve().expect("a cam")
}

/// A file that camgen writes of a cam with splines.
fn written(cam: &Cam, (tolerance, side): (f64, Side), format: &str) -> String {
    let request = Request::within(Fit { side, laid: SegmentKind::Splines, ..Fit::from(tolerance) });
    let proven = cam.draw(request).expect("drawn").prove().expect("proved");
    let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(&[format]) };
    let set = proven.files(&writing).expect("files");
    String::from_utf8(set.bytes(format).expect("a file").to_vec()).expect("text")
}

fn solid(cam: &Cam) -> String {
    written(cam, (TOLERANCE, Side::Both), "step")
}

fn checked(cam: &Cam, text: &str) -> Report {
    cam.check(text.as_bytes(), TOLERANCE).expect("it can be read")
}

fn failed(report: &Report) -> Vec<&str> {
    report.checks.iter().filter(|f| f.verdict == Verdict::Fail).map(|f| &*f.check).collect()
}

fn value(report: &Report, check: &str) -> f64 {
    report.checks.iter().find(|f| f.check == check).expect(check).value
}

fn accepted(cam: &Cam, text: &str, what: &str) {
    let report = checked(cam, text);
    assert_eq!(failed(&report), Vec::<&str>::new(), "{what}: {report:?}");
}

fn refused(cam: &Cam, text: &str, what: &str) {
    assert!(!failed(&checked(cam, text)).is_empty(), "{what}");
}

/// Coordinates of a point.
fn place(line: &str) -> [f64; 3] {
    let (_, rest) = line.split_once("('', (").expect("a triple");
    let numbers: Vec<f64> = rest.trim_end_matches("));").split(", ").map(|n| n.parse().expect("a number")).collect();
    [numbers[0], numbers[1], numbers[2]]
}

/// A file with more instances.
fn with(text: &str, more: &str) -> String {
    text.replace("ENDSEC;\nEND-", &format!("{more}ENDSEC;\nEND-"))
}

/// The same distances as of the DXF file of the same outline, and the volume of its polynomials.
#[test]
fn solids_on_splines_are_judged_as_their_outlines_are() {
    let plate = Spec::translating(machine(&[]), 35.0, Solver::Ode { tolerance: 1e-12 }, ExactOn::Braking).solve();
    let keyway = ["cam.rotation=ccw", "cam.keyway.width=8mm", "cam.keyway.depth=3.3mm", "follower.roller.offset=12mm"];
    for (name, cam) in [
        ("rotary", rotary(&[])),
        ("keyway", rotary(&keyway)),
        ("corners", rotary(&["buffer.column=return", "transition.kind=none"])),
        ("plate", plate.expect("a plate")),
    ] {
        for fit in [(TOLERANCE, Side::Both), (0.1 * TOLERANCE, Side::Both), (TOLERANCE, Side::Inside)] {
            let (step, dxf) = (written(&cam, fit, "step"), written(&cam, fit, "dxf"));
            assert!(step.contains("B_SPLINE_SURFACE") && dxf.contains("SPLINE"), "{name}");
            let (of_step, of_dxf) = (checked(&cam, &step), checked(&cam, &dxf));
            // A cam that is no good one is no good one in either file.
            assert_eq!(failed(&of_step), failed(&of_dxf), "{name} {fit:?}: {of_step:?}");
            for check in ["outline", "rolling"] {
                let (a, b) = (value(&of_step, check), value(&of_dxf, check));
                assert!((a - b).abs() <= 1e-9, "{name} {fit:?} {check}: {a} {b}");
            }
            let volume = of_step.checks.iter().find(|f| f.check == "volume").expect("a volume");
            let off = volume.value / volume.limit.expect("area times thickness") - 1.0;
            assert!(off.abs() <= 1e-12, "{name} {fit:?}: {off}");
        }
    }
}

#[test]
fn no_control_point_may_be_moved() {
    let cam = rotary(&[]);
    let text = solid(&cam);
    let lines = Lines::of(&text);
    let (edges, surfaces) = (lines.all("B_SPLINE_CURVE_WITH_KNOTS"), lines.all("B_SPLINE_SURFACE_WITH_KNOTS"));
    assert!(surfaces.len() > 10 && edges.len() == 2 * surfaces.len());
    for (index, carrier) in edges.iter().chain(&surfaces).enumerate() {
        // Of each carrier one, so that all places are tried.
        let points = lines.references(*carrier);
        let at = lines.line_of(&points[(7 * index) % points.len()]);
        for axis in 0..3 {
            refused(&cam, &lines.moved(at, axis, MOVED), &format!("{} along {axis}", lines.0[at]));
        }
    }
    // All that stand above one another: a good solid, on another outline.
    let middle = lines.line_of(&lines.references(surfaces[3])[5]);
    let [x, y, _] = place(&lines.0[middle]);
    let grown = 1.0 + MOVED / x.hypot(y);
    let above = |line: &String| {
        let at = line.contains("CARTESIAN_POINT('', (") && place(line)[..2] == [x, y];
        let head = line.split_once("('', (").map_or("", |(head, _)| head);
        if at { format!("{head}('', ({:?}, {:?}, {:?}));", x * grown, y * grown, place(line)[2]) } else { line.clone() }
    };
    let moved = Lines(lines.0.iter().map(above).collect());
    let report = checked(&cam, &moved.text());
    let failed = failed(&report);
    assert!(failed.contains(&"outline") && failed.contains(&"rolling"), "{report:?}");
    assert!(!failed.contains(&"shell") && !failed.contains(&"volume"), "{report:?}");
    // Those of one end only: the wall leans.
    let lower = |(old, new): (&String, &String)| {
        if old != new && place(old)[2] == 0.0 { new.clone() } else { old.clone() }
    };
    let leaning = Lines(lines.0.iter().zip(&moved.0).map(lower).collect());
    let report = checked(&cam, &leaning.text());
    assert!(report.checks.iter().any(|f| f.check == "walls" && f.verdict == Verdict::Fail), "{report:?}");
}

/// Knots inserted without a change of the curve, and then one of them changed; weights that are all one, and then one changed.
#[test]
fn knots_and_weights_count() {
    let cam = rotary(&[]);
    let lines = Lines::of(&solid(&cam));
    let edge = lines.all("B_SPLINE_CURVE_WITH_KNOTS")[4];
    let head = lines.0[edge].split_once(" = ").expect("an instance").0;
    let points = lines.references(edge);
    let place = |index: usize| place(&lines.0[lines.line_of(&points[index])]);
    let middle = |i: usize| -> [f64; 3] { std::array::from_fn(|k| 0.5 * (place(i)[k] + place(i + 1)[k])) };
    let inserted: Vec<String> = (0..3)
        .map(|i| {
            let [x, y, z] = middle(i);
            format!("#9000{i} = CARTESIAN_POINT('', ({x:?}, {y:?}, {z:?}));\n")
        })
        .collect();
    let inserted = inserted.concat();
    for (knot, multiplicity, same) in [("0.5", "1", true), ("0.52", "1", false), ("0.5", "2", false)] {
        let changed = format!(
            "{head} = B_SPLINE_CURVE_WITH_KNOTS('', 3, (#{}, #90000, #90001, #90002, #{}), .UNSPECIFIED., .F., .F., \
             (4, {multiplicity}, 4), (0., {knot}, 1.), .UNSPECIFIED.);",
            points[0], points[3]
        );
        let text = with(&lines.with(edge, changed), &inserted);
        if same { accepted(&cam, &text, knot) } else { refused(&cam, &text, knot) }
    }
    let plain = &lines.0[edge];
    accepted(&cam, &lines.with(edge, plain.replace("(0., 1.)", "(-3., 11.)")), "another parameter");
    refused(&cam, &lines.with(edge, plain.replace("(4, 4)", "(5, 3)")), "no curve");
    let all: Vec<String> = points.iter().map(|number| format!("#{number}")).collect();
    for (weight, same) in [("1.", true), ("1.01", false), ("0.", false), ("-1.", false)] {
        let rational = format!(
            "{head} = (BOUNDED_CURVE() B_SPLINE_CURVE(3, ({}), .UNSPECIFIED., .F., .F.) B_SPLINE_CURVE_WITH_KNOTS((4, 4), (0., \
             1.), .UNSPECIFIED.) CURVE() GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE((1., {weight}, 1., 1.)) \
             REPRESENTATION_ITEM(''));",
            all.join(", ")
        );
        let text = lines.with(edge, rational);
        if same { accepted(&cam, &text, weight) } else { refused(&cam, &text, weight) }
    }
    let surface = lines.all("B_SPLINE_SURFACE_WITH_KNOTS")[4];
    let head = lines.0[surface].split_once(" = ").expect("an instance").0;
    let net = lines.0[surface].split_once("3, 3, ").expect("a net").1.split_once(", .UNSPECIFIED.").expect("its end").0;
    for (weight, same) in [("1.", true), ("0.99", false)] {
        let row = "(1., 1., 1., 1.)";
        let rational = format!(
            "{head} = (BOUNDED_SURFACE() B_SPLINE_SURFACE(3, 3, {net}, .UNSPECIFIED., .F., .F., .F.) \
             B_SPLINE_SURFACE_WITH_KNOTS((4, 4), (4, 4), (0., 1.), (0., 1.), .UNSPECIFIED.) \
             GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_SURFACE(({row}, (1., {weight}, 1., 1.), {row}, {row})) \
             REPRESENTATION_ITEM('') SURFACE());"
        );
        let text = lines.with(surface, rational);
        if same { accepted(&cam, &text, weight) } else { refused(&cam, &text, weight) }
    }
}

/// The same wall with its parameters exchanged, or as what its lower edge sweeps upwards or downwards.
#[test]
fn a_wall_may_be_written_in_other_words() {
    let cam = rotary(&[]);
    let lines = Lines::of(&solid(&cam));
    let surface = lines.all("B_SPLINE_SURFACE_WITH_KNOTS")[2];
    let number = lines.0[surface].split_once(" = ").expect("an instance").0.to_owned();
    let points = lines.references(surface);
    let face = (0..lines.0.len())
        .find(|i| lines.0[*i].contains("ADVANCED_FACE") && lines.0[*i].contains(&format!("{number},")))
        .expect("its face");
    let turned = |text: &str| Lines::of(text).with(face, lines.0[face].replace(".T.);", ".F.);"));
    let column = |j: usize| -> String {
        let row: Vec<String> = (0..4).map(|i| format!("#{}", points[4 * i + j])).collect();
        format!("({})", row.join(", "))
    };
    let net = (0..4).map(column).collect::<Vec<_>>().join(", ");
    let exchanged = lines.with(
        surface,
        format!(
            "{number} = B_SPLINE_SURFACE_WITH_KNOTS('', 3, 3, ({net}), .UNSPECIFIED., .F., .F., .F., (4, 4), (4, 4), \
             (0., 1.), (0., 1.), .UNSPECIFIED.);"
        ),
    );
    refused(&cam, &exchanged, "inside out");
    accepted(&cam, &turned(&exchanged), "exchanged");
    // The edge over the same control points at z = 0.
    let edge = lines.all("B_SPLINE_CURVE_WITH_KNOTS").into_iter().find(|edge| {
        let at = |number: &String| place(&lines.0[lines.line_of(number)]);
        let own = lines.references(*edge);
        (0..4).all(|i| at(&own[i]) == at(&points[4 * i]))
    });
    let edge = lines.0[edge.expect("its lower edge")].split_once(" = ").expect("an instance").0.to_owned();
    for (along, up, upright) in [
        ("(0., 0., 1.)", true, true),
        ("(0., 0., -1.)", false, true),
        ("(0.001, 0., 1.)", true, false),
        ("(1., 0., 0.)", true, false),
    ] {
        let swept = lines.with(surface, format!("{number} = SURFACE_OF_LINEAR_EXTRUSION('', {edge}, #90000);"));
        let text = with(&swept, &format!("#90000 = VECTOR('', #90001, 1.);\n#90001 = DIRECTION('', {along});\n"));
        let (right, wrong) = if up { (text.clone(), turned(&text)) } else { (turned(&text), text.clone()) };
        refused(&cam, &wrong, along);
        if upright { accepted(&cam, &right, along) } else { refused(&cam, &right, along) }
    }
}

/// A file that has its one curve compared with a wall of many a time, and one that would fill the memory: told, and soon.
#[test]
fn hostile_walls_end() {
    let cam = rotary(&[]);
    let lines = Lines::of(&solid(&cam));
    let surface = lines.all("B_SPLINE_SURFACE_WITH_KNOTS")[2];
    let number = lines.0[surface].split_once(" = ").expect("an instance").0.to_owned();
    let points = lines.references(surface);
    let count = 20_000;
    // Forth and back over the same place, so that every part of it is the nearest.
    let controls: Vec<String> =
        (0..=3 * count).map(|i| format!("#{}", points[4 * [0, 1, 2, 3, 2, 1][i % 6]])).collect();
    let controls = controls.join(", ");
    let inner = ", 3".repeat(count - 1);
    let knots: Vec<String> = (0..=count).map(|i| format!("{i}.")).collect();
    let knots = knots.join(", ");
    let more = format!(
        "#90000 = VECTOR('', #90001, 1.);\n#90001 = DIRECTION('', (0., 0., 1.));\n#90002 = B_SPLINE_CURVE_WITH_KNOTS('', 3, \
         ({controls}), .UNSPECIFIED., .F., .F., (4{inner}, 4), ({knots}), .UNSPECIFIED.);\n"
    );
    let swept = lines.with(surface, format!("{number} = SURFACE_OF_LINEAR_EXTRUSION('', #90002, #90000);"));
    let _ = checked(&cam, &with(&swept, &more));
    let mut all = lines.0.clone();
    for line in &mut all {
        if line.contains("SPLINE_CURVE_WITH_KNOTS") {
            let head = line.split_once(" = ").expect("an instance").0;
            *line = format!(
                "{head} = B_SPLINE_CURVE_WITH_KNOTS('', 3, ({controls}), .UNSPECIFIED., .F., .F., (4{inner}, 4), ({knots}), \
                 .UNSPECIFIED.);"
            );
        }
    }
    refused(&cam, &with(&Lines(all).text(), &more), "one curve for all edges");
}
