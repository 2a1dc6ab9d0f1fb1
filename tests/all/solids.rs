//! `check` of STEP files: our own solids are accepted, and no solid that is another one is.

use crate::common::lines::Lines;
use crate::common::program::{Run, camgen, camgen_in, report};
use crate::common::random::Random;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::profile::outline::{Fit, SegmentKind};
use camgen::reading::step;
use camgen::{Cam, Error, Finding, Machine, Report, Request, Spec, Verdict, Writing};

const TOLERANCE: f64 = 5e-6;
/// Twice the tolerance, mm.
const TWICE: f64 = 0.01;

fn machine(overrides: &[&str]) -> Machine {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Machine::load("dpi", &overrides).expect("valid").0
}

fn rotary(overrides: &[&str]) -> Cam {
    Spec::rotary(machine(overrides), 35.0).solve().expect("a cam")
}

fn conoid(speeds: &[f64], overrides: &[&str]) -> Cam {
    Spec::conoid(machine(overrides), speeds.to_vec(), None).solve().expect("a cam")
}

/// The solid of a conoid is its flank: without it one section would take its place.
#[test]
fn a_conoid_whose_flank_was_not_drawn_has_no_solid() {
    let cam = conoid(&[20.0, 35.0], &[]);
    let files = |request: Request, formats: &[&str]| {
        let proven = cam.draw(request).expect("drawn").prove().expect("proved");
        proven.files(&Writing { force: true, ..Writing::to("output", "conoid").formats(formats) })
    };
    let sections = Request::within(50e-6);
    assert!(files(sections, &["dxf", "csv"]).is_ok());
    assert!(matches!(files(sections, &["dxf", "step"]), Err(Error::Unfit { format: "step", .. })));
    assert!(files(Request { flank: true, ..sections }, &["dxf", "step"]).is_ok());
}

/// The STEP file that camgen writes of a cam.
fn written(cam: &Cam) -> String {
    file(cam, Request { flank: true, ..Request::within(TOLERANCE) }, "step")
}

/// The same with an outline of splines.
fn splines(cam: &Cam) -> String {
    file(cam, with_splines(), "step")
}

fn with_splines() -> Request {
    Request::within(Fit { laid: SegmentKind::Splines, ..Fit::from(TOLERANCE) })
}

fn file(cam: &Cam, request: Request, format: &str) -> String {
    let proven = cam.draw(request).expect("drawn").prove().expect("proved");
    let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(&[format]) };
    let set = proven.files(&writing).expect("files");
    String::from_utf8(set.bytes(format).expect("a file").to_vec()).expect("text")
}

fn checked(cam: &Cam, text: &str) -> Report {
    cam.check(text.as_bytes(), TOLERANCE).expect("it can be read")
}

fn failed(report: &Report) -> Vec<&str> {
    report.checks.iter().filter(|f| f.verdict == Verdict::Fail).map(|f: &Finding| &*f.check).collect()
}

/// Some of many, spread evenly.
fn some(all: &[usize], count: usize) -> Vec<usize> {
    all.iter().copied().step_by(all.len().div_ceil(count)).collect()
}

const KEYWAY: [&str; 3] = ["cam.keyway.width=8mm", "cam.keyway.depth=3.3mm", "cam.keyway.angle=90deg"];

#[test]
fn our_own_solids_are_accepted() {
    let keyway_ccw = [&KEYWAY[..], &["cam.rotation=ccw"]].concat();
    let holes = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.balance=40mm .. 85mm"];
    for overrides in [&[][..], &KEYWAY, &keyway_ccw, &holes, &["cam.bore_radius=40mm"]] {
        let cam = rotary(overrides);
        let report = checked(&cam, &written(&cam));
        assert_eq!(failed(&report), Vec::<&str>::new(), "{overrides:?}: {report:?}");
    }
    let solver = || Solver::Ode { tolerance: 1e-12 };
    let plate = Spec::translating(machine(&[]), 35.0, solver(), ExactOn::Braking).solve().expect("a plate");
    let report = checked(&plate, &written(&plate));
    assert_eq!(failed(&report), Vec::<&str>::new(), "{report:?}");
    for overrides in
        [&[][..], &["cam.rotation=ccw"], &["conoid.mode=fixed", "cam.keyway.width=8mm", "cam.keyway.depth=3mm"]]
    {
        let cam = conoid(&[20.0, 27.5, 35.0], overrides);
        let report = checked(&cam, &written(&cam));
        assert_eq!(failed(&report), Vec::<&str>::new(), "{overrides:?}: {report:?}");
        assert!(report.checks.iter().any(|f| f.check == "flank" && f.verdict == Verdict::Pass), "{report:?}");
    }
}

/// Each is a good solid of another cam.
#[test]
fn the_solid_of_another_cam_is_refused() {
    let text = written(&rotary(&KEYWAY));
    for (overrides, check) in [
        (vec!["cam.thickness=30.1mm"], "thickness"),
        (vec!["cam.thickness=29.9mm"], "thickness"),
        (vec!["cam.rotation=ccw"], "rolling"),
        (vec!["cam.bore_radius=25.02mm"], "holes"),
        (vec!["cam.keyway.depth=3.4mm"], "holes"),
        (vec!["cam.keyway.angle=91deg"], "holes"),
        (vec!["buffer.end_pressure=2.1at"], "rolling"),
        (vec!["follower.roller.radius=31mm"], "rolling"),
    ] {
        let report = checked(&rotary(&[&KEYWAY[..], &overrides[..]].concat()), &text);
        assert!(failed(&report).contains(&check), "{overrides:?}: {report:?}");
    }
    assert!(failed(&checked(&rotary(&[]), &text)).contains(&"holes"), "a keyway where there should be none");
    let plain = written(&rotary(&[]));
    assert!(failed(&checked(&rotary(&KEYWAY), &plain)).contains(&"holes"), "no keyway");

    let of = written(&conoid(&[20.0, 35.0], &[]));
    for (speeds, overrides, check) in [
        ([20.0, 34.0], vec![], "flank"),
        ([20.0, 35.0], vec!["cam.rotation=ccw"], "flank"),
        ([20.0, 35.0], vec!["conoid.mode=fixed"], "flank"),
        ([20.0, 35.0], vec!["cam.bore_radius=26mm"], "holes"),
        ([20.0, 35.0], vec!["conoid.axial_travel=119.9mm"], "thickness"),
    ] {
        let report = checked(&conoid(&speeds, &overrides), &of);
        assert!(failed(&report).contains(&check), "{speeds:?} {overrides:?}: {report:?}");
    }
}

/// Points, radii and directions of every class off by two tolerances, one at a time.
#[test]
fn nothing_of_a_solid_may_be_moved() {
    let cam = rotary(&KEYWAY);
    let text = written(&cam);
    let lines = Lines::of(&text);
    assert_eq!(failed(&checked(&cam, &lines.text())), Vec::<&str>::new());
    let refused = |edited: &str, what: &str| {
        assert_ne!(edited, text, "{what}");
        let report = checked(&cam, edited);
        assert!(!failed(&report).is_empty(), "{what}: {report:?}");
    };
    for vertex in some(&lines.all("VERTEX_POINT"), 8) {
        let place = lines.line_of(&lines.references(vertex)[0]);
        for axis in 0..3 {
            refused(&lines.moved(place, axis, TWICE), &format!("{} along {axis}", lines.0[place]));
        }
    }
    for (keyword, axes) in [("CIRCLE", 0..3), ("CYLINDRICAL_SURFACE", 0..2)] {
        for round in some(&lines.all(keyword), 6) {
            let frame = lines.line_of(&lines.references(round)[0]);
            let parts = lines.references(frame);
            for axis in axes.clone() {
                refused(&lines.moved(lines.line_of(&parts[0]), axis, TWICE), &lines.0[round]);
            }
            // The axis leant over by a milliradian.
            refused(&lines.moved(lines.line_of(&parts[1]), 0, 1e-3), &lines.0[round]);
            let (head, radius) = lines.0[round].trim_end_matches(");").rsplit_once(", ").expect("a radius");
            let radius: f64 = radius.parse().expect("a number");
            refused(&lines.with(round, format!("{head}, {:?});", radius + TWICE)), &lines.0[round]);
        }
    }
    for plane in lines.all("PLANE") {
        let parts = lines.references(lines.line_of(&lines.references(plane)[0]));
        let normal = &lines.0[lines.line_of(&parts[1])];
        let normal: Vec<f64> = normal
            .split_once("('', (")
            .expect("a triple")
            .1
            .trim_end_matches("));")
            .split(", ")
            .map(|n| n.parse().expect("a number"))
            .collect();
        let axis = (0..3).max_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs())).expect("three");
        refused(&lines.moved(lines.line_of(&parts[0]), axis, TWICE), &lines.0[plane]);
        refused(&lines.moved(lines.line_of(&parts[1]), (axis + 1) % 3, 1e-3), &lines.0[plane]);
    }
    for line in some(&lines.all("LINE"), 6) {
        let parts = lines.references(line);
        // A line upright moves across z, a level one up.
        let along = &lines.0[lines.line_of(&lines.references(lines.line_of(&parts[1]))[0])];
        let axis = if along.contains("(0., 0., 1.)") { 0 } else { 2 };
        refused(&lines.moved(lines.line_of(&parts[0]), axis, TWICE), &lines.0[line]);
    }
}

/// Senses turned round, faces left out or given twice, edges swapped.
#[test]
fn a_shell_that_does_not_close_or_is_inside_out_is_refused() {
    let (disc, conoid) = (rotary(&KEYWAY), conoid(&[20.0, 35.0], &[]));
    for (cam, text) in [(&disc, written(&disc)), (&disc, splines(&disc)), (&conoid, written(&conoid))] {
        let lines = Lines::of(&text);
        let refused = |edited: &str, what: &str| {
            let report = checked(cam, edited);
            assert!(!failed(&report).is_empty(), "{what}: {report:?}");
        };
        for keyword in ["ADVANCED_FACE", "FACE_BOUND", "ORIENTED_EDGE", "EDGE_CURVE"] {
            for index in some(&lines.all(keyword), 12) {
                let line = &lines.0[index];
                let turned = if line.ends_with(".T.);") {
                    line.replace(".T.);", ".F.);")
                } else {
                    line.replace(".F.);", ".T.);")
                };
                // A circle that is run the other way round, or a line against itself.
                refused(&lines.with(index, turned), line);
            }
        }
        let shell = lines.all("CLOSED_SHELL")[0];
        let faces = lines.references(shell);
        for face in &faces {
            let without: Vec<String> =
                faces.iter().filter(|other| *other != face).map(|face| format!("#{face}")).collect();
            let head = lines.0[shell].split_once(" = ").expect("an instance").0;
            refused(&lines.with(shell, format!("{head} = CLOSED_SHELL('', ({}));", without.join(", "))), face);
        }
        let edges = lines.all("ORIENTED_EDGE");
        for pair in edges.windows(2).step_by(edges.len().div_ceil(8)) {
            let swap = |from: usize, to: usize| {
                let head = lines.0[from].split_once(" = ").expect("an instance").0.to_owned();
                format!("{head} = {}", lines.0[to].split_once(" = ").expect("an instance").1)
            };
            let mut swapped = Lines(lines.0.clone());
            swapped.0[pair[0]] = swap(pair[0], pair[1]);
            swapped.0[pair[1]] = swap(pair[1], pair[0]);
            refused(&swapped.text(), &lines.0[pair[0]]);
        }
    }
}

#[test]
fn units_and_other_bodies_are_told() {
    let cam = rotary(&[]);
    let text = written(&cam);
    for (unit, told) in [
        ("SI_UNIT($, .METRE.)", "metres"),
        ("SI_UNIT(.CENTI., .METRE.)", "centimetres"),
        ("SI_UNIT(.MICRO., .METRE.)", "another unit"),
    ] {
        let report = checked(&cam, &text.replace("SI_UNIT(.MILLI., .METRE.)", unit));
        let units = report.checks.iter().find(|f| f.check == "units").expect("units");
        assert!(!report.passed() && units.verdict == Verdict::Warn && units.note_words().contains(told), "{report:?}");
    }
    // As OpenCASCADE writes inches, and as the standard's examples do.
    for factor in ["25.4", "LENGTH_MEASURE(25.4)"] {
        let inch = format!(
            "(CONVERSION_BASED_UNIT('INCH', #90001) LENGTH_UNIT() NAMED_UNIT(*));\n\
             #90001 = LENGTH_MEASURE_WITH_UNIT({factor}, #90002);\n#90002 = (LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.));"
        );
        let edited = text.replace("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.));", &inch);
        let report = checked(&cam, &edited);
        let units = report.checks.iter().find(|f| f.check == "units").expect("units");
        assert!(!report.passed() && units.verdict == Verdict::Warn, "{report:?}");
        assert!(units.note_words().contains("inches"), "{report:?}");
    }
    for (edited, check) in [
        (text.replace("ENDSEC;\nEND-", "#90001 = MANIFOLD_SOLID_BREP('', #17);\nENDSEC;\nEND-"), "solids"),
        (text.replace("ENDSEC;\nEND-", "#90001 = SHELL_BASED_SURFACE_MODEL('', (#17));\nENDSEC;\nEND-"), "solids"),
        (text.replace("MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS"), "solids"),
        (text.replace("= CLOSED_SHELL", "= OPEN_SHELL"), "shell"),
        (text.replace("(#16), #11", "($), #11"), "shell"),
        (text.replace("= PLANE(", "= CONICAL_SURFACE("), "walls"),
        (text.replace("= CIRCLE(", "= ELLIPSE("), "shell"),
    ] {
        assert_ne!(edited, text, "{check}");
        let report = checked(&cam, &edited);
        assert!(failed(&report).contains(&check), "{check}: {report:?}");
    }
}

/// A bump of two tolerances on any patch, wherever it is: an interior control point moved as far as that takes.
#[test]
fn a_bump_on_a_flank_is_found_wherever_it_is() {
    let cam = conoid(&[20.0, 35.0], &[]);
    let lines = Lines::of(&written(&cam));
    let mut random = Random(13);
    for patch in lines.all("B_SPLINE_SURFACE_WITH_KNOTS") {
        let points = lines.references(patch);
        let columns = lines.0[patch].split("), (").next().expect("a row").matches('#').count() - 1;
        let rows = points.len() / columns;
        for _ in 0..3 {
            let (row, column) = (1 + random.below(rows - 2), 1 + random.below(columns - 2));
            let place = lines.line_of(&points[row * columns + column]);
            let line = &lines.0[place];
            let at: Vec<f64> = line
                .split_once("('', (")
                .expect("a triple")
                .1
                .trim_end_matches("));")
                .split(", ")
                .map(|n| n.parse().expect("a number"))
                .collect();
            let radius = at[0].hypot(at[1]);
            // The largest value of a pair of cubic B-splines is at least 0.44 within, more beside the ends.
            let far = 2.0 * 1e3 * TOLERANCE / 0.44;
            let head = line.split_once("('', (").expect("a triple").0;
            let grown = 1.0 + far / radius;
            let moved =
                lines.with(place, format!("{head}('', ({:?}, {:?}, {:?}));", at[0] * grown, at[1] * grown, at[2]));
            let report = checked(&cam, &moved);
            assert!(failed(&report).contains(&"flank"), "{line}: {report:?}");
        }
    }
}

/// Cut short, with bytes changed, left out and doubled: told or judged, never a panic.
#[test]
fn no_bytes_end_the_reader() {
    let disc = rotary(&KEYWAY);
    let texts = [written(&disc), splines(&disc), written(&conoid(&[20.0, 35.0], &[]))];
    let mut random = Random(7);
    let signs = b"()#',.;=$*/E-+0123456789TF\\\n\"&\xff\0";
    for text in &texts {
        for _ in 0..400 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..=random.below(4) {
                let at = random.below(bytes.len());
                match random.below(4) {
                    0 => bytes.truncate(at),
                    1 => bytes[at] = signs[random.below(signs.len())],
                    2 => drop(bytes.drain(at..(at + 1 + random.below(40)).min(text.len().min(bytes.len())).max(at))),
                    _ => {
                        let piece = bytes[at..(at + random.below(300)).min(bytes.len())].to_vec();
                        bytes.splice(at..at, piece);
                    }
                }
                if bytes.is_empty() {
                    break;
                }
            }
            if let Ok(file) = step::read(&bytes) {
                for flank in [step::FlankShape::Upright, step::FlankShape::Patches] {
                    let form = step::form(&file.boundary, flank, 1e-6);
                    assert!(form.low.len() <= file.boundary.faces.len());
                }
            }
        }
    }
    for odd in ["", "ISO-10303-21;", "ISO-10303-21;DATA;#1=A("] {
        assert!(step::read(odd.as_bytes()).is_err(), "{odd}");
    }
    assert!(step::read(with_data("#1=(;").as_bytes()).is_err());
    let deep = with_data(&format!("#1=A({}{});", "(".repeat(100_000), ")".repeat(100_000)));
    assert!(step::read(deep.as_bytes()).expect_err("deep").to_string().contains("nested deeper"));
    let own = with_data("#1=MANIFOLD_SOLID_BREP('',#1);");
    assert!(!step::read(own.as_bytes()).expect("an exchange structure").faults.is_empty());
}

/// A STEP file with these instances.
fn with_data(instances: &str) -> String {
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n{instances}\nENDSEC;\nEND-ISO-10303-21;\n"
    )
}

/// What others do not read, or take for something else, is refused with its line and a reason.
#[test]
fn faults_of_the_syntax_are_named() {
    let long = format!("#1=A('{}');", "x".repeat(16_001));
    let comment = format!("/*{}*/", "x".repeat(16_001));
    for (instances, told) in [
        ("#1=A();#1=A();", "#1 is defined twice at line 6"),
        ("#1=plane('',#2);", "`plane` has small letters; the words of a STEP file are in capitals at line 6"),
        ("#1=A(.milli.);", "`milli` has small letters"),
        ("#1=A(25E0);", "`25E0` is not a number"),
        ("#1\n=A();", "`=` is missing behind `#1` on the same line"),
        ("#3000000000=A();", "`#3000000000` is not between #1 and #2147483647"),
        ("#0=A();", "`#0` is not between"),
        (&long, "a text of more than 16000 characters"),
        (&comment, "a line of a comment has more than 16000 characters"),
        ("ENDSEC;HEADER;ENDSEC;DATA;", "found `HEADER`, expected a section"),
        ("ENDSEC;END-ISO-10303-21;ISO-10303-21;", "found `ISO-10303-21` after the end of the file"),
    ] {
        let refusal = step::read(with_data(instances).as_bytes()).expect_err(told).to_string();
        assert!(refusal.contains(told), "{told}: {refusal}");
    }
    for (schema, told) in [("IFC4", "its schema is `IFC4`"), ("", "its schema is ``"), ("\u{1b}[31m", "`\\u001b[31M`")]
    {
        let text = with_data("").replace("AUTOMOTIVE_DESIGN", schema);
        let refusal = step::read(text.as_bytes()).expect_err(told).to_string();
        assert!(refusal.contains(told) && refusal.contains("AP203, AP214 or AP242"), "{told}: {refusal}");
    }
    let text = with_data("").replace("FILE_SCHEMA", "FILE_SCHEME");
    assert!(step::read(text.as_bytes()).expect_err("no schema").to_string().contains("its schema is none"));
}

/// Entities with more or fewer parameters than they have, or in the place of parts, are faults.
#[test]
fn faults_of_parameters_are_named() {
    for (instance, told) in [
        ("#1=PLANE('',#2,3.);", "line 6: PLANE has 3 parameters in PLANE, which has 2"),
        ("#1=EDGE_LOOP('');", "line 6: EDGE_LOOP has 1 parameters in EDGE_LOOP, which has 2"),
        ("#1=(NAMED_UNIT(*,*) SI_UNIT($,.METRE.));", "has 2 parameters in NAMED_UNIT, which has 1"),
        ("#1=(LENGTH_UNIT() SI_UNIT(.KILO.,$,.METRE.));", "has 3 parameters in SI_UNIT, which has 2"),
        ("#1=(FOO() PLANE('',#2));", "has PLANE as a part, which stands alone"),
    ] {
        let file = step::read(with_data(instance).as_bytes()).expect("an exchange structure");
        assert!(file.faults.iter().any(|fault| fault.contains(told)), "{told}: {:?}", file.faults);
    }
}

fn check(run: Run, args: &[&str]) -> Run {
    camgen_in(run.directory, &[&["check"], args].concat())
}

#[test]
fn the_command_takes_solids_by_what_they_hold() {
    let made = camgen(&["rotary", "--out", ".", "--name", "cam", "--format", "step"]);
    assert_eq!(made.code, 0, "{}", made.err);
    let path = made.directory.path().join("cam.step");
    let text = std::fs::read_to_string(&path).expect("a file");
    std::fs::write(made.directory.path().join("cam.any"), &text).expect("written");
    std::fs::write(made.directory.path().join("cut.step"), &text[..text.len() / 2]).expect("written");
    std::fs::write(made.directory.path().join("metre.step"), text.replace(".MILLI.", "$")).expect("written");
    let mut run = made;
    for (args, code, told) in [
        (vec!["cam.any"], 0, "is this cam"),
        (vec!["cam.any", "--tolerance", "1um"], 1, "rolling"),
        (vec!["cam.any", "--rpm", "34"], 1, "is NOT this cam"),
        (vec!["cam.any", "--set", "cam.thickness=30.1mm"], 1, "thickness"),
        (vec!["cam.any", "--cam", "translating"], 1, "is NOT this cam"),
        (vec!["cam.any", "--cam", "conoid", "--rpm", "20,35"], 1, "is NOT this cam"),
        (vec!["metre.step"], 1, "the file is in metres"),
    ] {
        run = check(run, &args);
        assert_eq!(run.code, code, "{args:?}: {} {}", run.out, run.err);
        assert!(run.out.contains(told), "{args:?}: {}", run.out);
    }
    for (args, told) in [
        (vec!["cut.step"], &["not a STEP file: ", " at line "][..]),
        (vec!["cam.any", "--cam", "conoid", "--rpm", "20,35", "--section", "20"], &["holds the solid of all sections"]),
    ] {
        run = check(run, &args);
        assert_eq!(run.code, 2, "{args:?}: {} {}", run.out, run.err);
        assert!(told.iter().all(|told| run.err.contains(told)), "{args:?}: {}", run.err);
    }
    let run = check(run, &["cam.any", "--json"]);
    let names = report(&run);
    let names: Vec<&str> =
        names["checks"].as_array().expect("checks").iter().map(|c| c["check"].as_str().expect("a name")).collect();
    for name in ["units", "solids", "shell", "walls", "thickness", "volume", "bore", "tangency", "outline", "rolling"] {
        assert!(names.contains(&name), "{name}: {names:?}");
    }
}
