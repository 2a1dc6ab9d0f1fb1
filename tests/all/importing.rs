//! `camgen import`: what is found of lift tables, outlines and points, and what is refused, with its row and what would be right.

use crate::common::program::{Run, camgen_in, files, number, report};
use std::f64::consts::{PI, TAU};
use std::fs;

const ROLLER: [&str; 2] = ["--follower", "roller,diameter=24mm"];
const LEVER: [&str; 2] = ["--follower", "swinging-roller,diameter=24mm,arm=100mm,pivot_distance=130mm"];

/// Runs import on a file with this content.
fn import(content: &[u8], args: &[&str]) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("old.csv"), content).expect("written");
    camgen_in(directory, &[&["import", "old.csv"], args].concat())
}

/// A cycloidal lift of 20 mm at a share of the rise, or after it at a share of the remaining return.
fn cycloid(up: f64, left: f64) -> f64 {
    let share = if up < 1.0 { up } else { left.clamp(0.0, 1.0) };
    20.0 * (share - (TAU * share).sin() / TAU)
}

/// A lift of 20 mm up by a cycloid, a dwell, down, a dwell.
fn lift(degree: u32) -> f64 {
    let degree = f64::from(degree % 360);
    cycloid(degree / 120.0, (280.0 - degree) / 120.0)
}

fn table(head: &str, row: impl Fn(u32) -> String) -> String {
    let rows: Vec<String> = (0..360).map(row).collect();
    format!("{head}\n{}\n", rows.join("\n"))
}

fn usual(degree: u32) -> String {
    format!("{degree},{:.4}", lift(degree))
}

fn at(wrong: u32, text: &str) -> impl Fn(u32) -> String {
    let text = text.to_owned();
    move |degree| if degree == wrong { text.clone() } else { usual(degree) }
}

/// Points of a profile under a knife edge.
fn points(head: &str, point: impl Fn(u32, f64, f64) -> String) -> String {
    table(head, |degree| {
        let (angle, radius) = (f64::from(degree).to_radians(), 45.0 + lift(degree));
        point(degree, radius * angle.cos(), radius * angle.sin())
    })
}

fn plain(_: u32, x: f64, y: f64) -> String {
    format!("{x:.5},{y:.5}")
}

fn drawing(entities: &str, head: &str) -> String {
    format!("0\nSECTION\n2\nHEADER\n{head}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

fn circle(x: f64, y: f64, radius: f64, layer: &str) -> String {
    format!("0\nCIRCLE\n8\n{layer}\n10\n{x}\n20\n{y}\n40\n{radius}\n")
}

const MM: &str = "9\n$INSUNITS\n70\n4\n";

/// Content, arguments, and what the message must tell.
type Refused = (String, Vec<&'static str>, &'static [&'static str]);

fn tables() -> Vec<Refused> {
    let head = "deg,mm";
    vec![
        (String::new(), vec![], &["is an empty file", "give a lift table"]),
        ("deg,mm\n".into(), vec![], &["has no rows", "two numbers"]),
        ("deg,mm\n0,0\n120,5\n240,2\n".into(), vec![], &["3 rows", "at least 8"]),
        (table(head, at(17, "17,O.1")), vec![], &["old.csv:19", "`O.1`", "write a number"]),
        (table(head, at(17, "17,")), vec![], &["old.csv:19", "1 cells", "two numbers"]),
        (table(head, at(17, "17,nan")), vec![], &["old.csv:19", "`nan`"]),
        (table(head, at(17, "16,0.36")), vec![], &["old.csv:19", "16 does not come after 16", "each angle once"]),
        (table(head, at(17, "22,0.36")), vec![], &["old.csv:20", "18 does not come after 22", "sort the rows"]),
        (
            table(head, usual) + "360,1.0\n",
            vec![],
            &["old.csv:362", "does not end where it begins", "remove the last row"],
        ),
        (
            table(head, |d| if d < 200 { usual(d) } else { "#".into() }),
            vec![],
            &["old.csv:201", "without rows", "add rows"],
        ),
        (table("", |d| format!("{:.5},{:.4}", f64::from(d).to_radians(), lift(d))), vec![], &["radians?", "--unit"]),
        (
            table("", |d| format!("{:.5},{:.4}", f64::from(d) / 360.0, lift(d))),
            vec![],
            &["shares of the turn?", "--over"],
        ),
        (table("t (ms),mm", usual), vec![], &["in ms", "columns"]),
        (table("deg,lift %", usual), vec![], &["shares of a lift", "--lift"]),
        (table("angle (deg),swing (deg)", usual), vec![], &["positions are in deg", "--follower swinging-roller"]),
        (table("deg,lift mm", usual), LEVER.to_vec(), &["positions are in mm", "is an angle"]),
        (table(head, usual), vec!["--unit", "banana"], &["\"banana\" is not a unit", "one of um, mm"]),
        (table(head, usual), vec!["--columns", "angle,hub"], &["no single column", "\"deg\", \"mm\""]),
        (table(head, usual), vec!["--columns", "2"], &["two different columns", "--columns"]),
        (table(head, usual), vec!["--ratio", "0"], &["must be above 0"]),
        (table(head, usual), vec!["--lift", "20"], &["has no unit"]),
        (
            table(head, at(61, "61,9.9")),
            vec![],
            &["row 62", "61 deg", "off the motion of its neighbours", "correct it"],
        ),
        (table(head, |d| format!("{d},7.0")), vec![], &["does not move", "give rows of a lift"]),
        (table(head, |d| format!("{d},{:.1}", 1e9 * lift(d))), vec![], &["farthest possible", "--unit"]),
        (table(head, usual), vec!["--fit", "centre"], &["has no centre", "leave --fit centre out"]),
        (table(head, usual), vec!["--deviation", "0.1deg"], &["the deviation is an angle", "--deviation 3um"]),
        (table(head, usual), vec!["--ball", "3mm"], &["--ball belongs to measured points", "--from points"]),
        (table(head, usual), vec!["--layer", "A"], &["--layer belongs to the outline", "--from outline"]),
        (table(head, usual), vec!["--set", "motion.start=5mm"], &["is a key of the motion", "--rpm"]),
        (table(head, usual), vec!["--set", "cam.banana=1"], &["unknown key `cam.banana`"]),
        (table(head, usual), vec!["--format", "dxf"], &["no such format `dxf`", "toml"]),
        ("%PDF-1.7\n".into(), vec![], &["a PDF document", "as text (CSV)"]),
        ("PK\u{3}\u{4}x".into(), vec![], &["spreadsheets", "as text (CSV)"]),
        ("{\"schema\": 1}".into(), vec![], &["a JSON file"]),
        ("<svg/>".into(), vec![], &["an XML, SVG or HTML file"]),
    ]
}

fn others() -> Vec<Refused> {
    let rolled = ROLLER.to_vec();
    let with = |more: &[&'static str]| [&ROLLER[..], more].concat();
    let flower = table("x,y", |d| {
        let angle = PI / 180.0 * f64::from(d);
        let radius = 50.0 + 3.0 * angle.cos() + 2.0 * (5.0 * angle).cos();
        format!("{},{}", radius * angle.cos(), radius * angle.sin())
    });
    let open = "0\nLINE\n8\nCAM_PROFILE\n10\n0\n20\n-9\n11\n50\n21\n0\n0\nLINE\n8\nCAM_PROFILE\n10\n50\n20\n0\n11\n-40\n21\n30\n";
    vec![
        ("x,y\n1,2\n3,4\n".into(), rolled.clone(), &["2 points", "at least 8"]),
        (points("a,b", plain), with(&["--from", "points"]), &["no columns of points", "x and y"]),
        (points("x_um,y_um", plain), with(&["--from", "points"]), &["`x_um`", "mm"]),
        (
            points("x,y", |d, x, y| if d == 17 { "x1,5".into() } else { plain(d, x, y) }),
            rolled.clone(),
            &["line 19", "`x1`"],
        ),
        (
            points("x,y", |d, x, y| if (40..80).contains(&d) { "#".into() } else { plain(d, x, y) }),
            rolled.clone(),
            &["leave out 41.0 deg", "point 40", "all round"],
        ),
        (
            points("x,y", |d, x, y| if d == 61 { plain(d, 1.01 * x, 1.01 * y) } else { plain(d, x, y) }),
            rolled.clone(),
            &["point 62", "off the motion", "correct it"],
        ),
        (points("x,y", |d, x, y| plain(d, x + 500.0, y)), rolled.clone(), &["leave out", "about its shaft"]),
        (flower, with(&["--fit", "centre"]), &["no dwell", "--fit angle"]),
        (points("x,y", plain), vec![], &["needs the follower", "--follower roller"]),
        (points("x,y", plain), vec!["--follower", "rolller,diameter=24mm"], &["did you mean roller?"]),
        (
            points("x,y", plain),
            vec!["--follower", "roller,dimeter=24mm"],
            &["did you mean `follower.roller.diameter`?"],
        ),
        (points("x,y", plain), vec!["--follower", "roller,diameter=24"], &["has no unit"]),
        (points("x,y", plain), vec!["--follower", "roller,24mm"], &["is not KEY=VALUE", "diameter=24mm"]),
        (
            points("x,y", plain),
            vec!["--follower", "swinging-roller,diameter=24mm"],
            &["follower.swinging-roller.arm", "add it"],
        ),
        (
            points("x,y", plain),
            vec!["--follower", "swinging-roller,diameter=24mm,arm=20mm,pivot_distance=130mm"],
            &["point", "dimensions of the follower"],
        ),
        (points("x,y", plain), with(&["--ball", "-1mm"]), &["must be at least 0.005 mm"]),
        (points("x,y", plain), with(&["--from", "points", "--columns", "1,2"]), &["--columns belongs to a lift table"]),
        (drawing(open, MM), rolled.clone(), &["not closed", "gap", "close it"]),
        (
            drawing(&(circle(0.0, 0.0, 50.0, "CAM_PROFILE") + &circle(200.0, 0.0, 10.0, "CAM_PROFILE")), MM),
            rolled.clone(),
            &["2 closed curves", "--layer"],
        ),
        (
            drawing(&circle(5.0, 0.0, 50.0, "CAM_PROFILE"), "9\n$MEASUREMENT\n70\n0\n"),
            rolled.clone(),
            &["inches", "$INSUNITS"],
        ),
        (
            drawing(&(circle(5.0, 0.0, 50.0, "A") + &circle(0.0, 0.0, 10.0, "B")), MM),
            rolled.clone(),
            &["layers A, B", "--layer"],
        ),
        (
            drawing(&circle(500.0, 0.0, 50.0, "CAM_PROFILE"), MM),
            rolled.clone(),
            &["does not lie within the outline", "origin"],
        ),
        (drawing(&circle(0.0, 0.0, 50.0, "CAM_PROFILE"), MM), rolled.clone(), &["does not move"]),
        (drawing(&circle(5.0, 0.0, 50.0, "CAM_PROFILE"), MM), vec![], &["needs the follower"]),
        ("0\nSECTION\n".into(), rolled.clone(), &["EOF"]),
        ("ISO-10303-21;\nHEADER;\n".into(), rolled, &["line 3"]),
    ]
}

/// Each kind of bad input ends with exit code 2, is told with its place and what would be right, and leaves no file.
#[test]
fn what_cannot_be_imported_is_told_with_its_row_and_a_remedy() {
    let all: Vec<Refused> = tables().into_iter().chain(others()).collect();
    assert!(all.len() >= 40, "{}", all.len());
    let mut wrong = Vec::new();
    for (content, args, told) in all {
        let run = import(content.as_bytes(), &args);
        let untold: Vec<&&str> = told.iter().filter(|part| !run.err.contains(**part)).collect();
        if run.code != 2 || !untold.is_empty() || files(run.directory.path()) != ["old.csv"] {
            wrong.push(format!("{args:?}: exit {}, not told {untold:?}: {}{}", run.code, run.err, run.out));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let run = import(b"deg,mm\n0,1\0\n", &[]);
    assert!(run.code == 2 && run.err.contains("it is not text"), "{}", run.err);
}

/// A design is found with its laws and round numbers, and `make` takes it as it is.
#[test]
fn a_lift_table_becomes_a_design() {
    let run =
        import(table("deg,mm", usual).as_bytes(), &["--follower", "roller,diameter=20mm", "--json", "--out", "."]);
    assert_eq!(run.code, 0, "{}", run.err);
    let found = report(&run);
    let segments = found["import"]["segments"].as_array().expect("segments");
    let laws: Vec<&str> = segments.iter().filter_map(|segment| segment["law"].as_str()).collect();
    assert_eq!(laws, ["cycloidal", "dwell", "cycloidal", "dwell"]);
    assert!((number(&segments[0]["to_deg"]) - 120.0).abs() < 1e-9 && (number(&segments[0]["to"]) - 20.0).abs() < 1e-9);
    let design = fs::read_to_string(run.directory.path().join("old-import.toml")).expect("a design");
    assert!(design.contains("over = \"120 deg\"\nto = \"20 mm\""), "{design}");
    let made = camgen_in(run.directory, &["make", "old-import.toml", "--format", "dxf"]);
    assert_eq!(made.code, 0, "{}{}", made.out, made.err);
}

/// Points about another centre than that of the dwells: the report names `--fit centre`, which finds it; and how the cam is assumed to turn.
#[test]
fn points_off_the_centre_name_what_finds_it() {
    let moved = |by: (f64, f64)| points("x,y", |_, x, y| format!("{:.5},{:.5}", x + by.0, y + by.1));
    // Centres of a ball as large as the roller are those of the roller.
    let args = [&ROLLER[..], &["--ball", "12mm", "--json", "--out", "."]].concat();
    let notes = |points: &str, more: &[&str]| {
        let run = import(points.as_bytes(), &[&args[..], more].concat());
        assert_eq!(run.code, 0, "{}{}", run.err, run.out);
        let design = fs::read_to_string(run.directory.path().join("old-import.toml")).expect("a design");
        (report(&run)["notes"].to_string(), design)
    };
    let (off, design) = notes(&moved((0.3, -0.2)), &[]);
    assert!(off.contains("about (0.3000, -0.2000) mm") && off.contains("--fit centre"), "{off}");
    assert!(off.contains("assumed to turn clockwise") && design.contains("rotation = \"cw\""), "{off}{design}");
    let (found, design) = notes(&moved((0.3, -0.2)), &["--fit", "centre"]);
    assert!(!found.contains("--fit centre") && design.contains("cycloidal"), "{found}{design}");
    let (right, design) = notes(&moved((0.0, 0.0)), &["--set", "cam.rotation=ccw"]);
    assert!(!right.contains("--fit") && !right.contains("assumed") && design.contains("rotation = \"ccw\""), "{right}");
}

/// A law that is demanded and leaves too much is not written.
#[test]
fn a_law_that_does_not_keep_the_deviation_is_refused() {
    let run = import(table("deg,mm", usual).as_bytes(), &["--law", "parabola"]);
    assert_eq!(run.code, 1, "{}", run.err);
    assert_eq!(files(run.directory.path()), ["old.csv"]);
    let run = import(table("deg,mm", usual).as_bytes(), &["--law", "spline", "--dry-run"]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
}

/// A lift by the cam angle.
type Lift = fn(f64) -> f64;

/// An eccentric circle under a flat face and a roller, in closed form.
#[test]
fn the_lift_on_an_outline_is_exact() {
    let outline = drawing(&circle(5.0, 0.0, 50.0, "CAM_PROFILE"), MM);
    let exact: [(&str, Lift); 2] = [
        ("flat", |at| 50.0 + 5.0 * at.cos() - 45.0),
        ("roller,radius=10mm", |at| 5.0 * at.cos() + (3600.0 - 25.0 * at.sin().powi(2)).sqrt() - 55.0),
    ];
    for (follower, lift) in exact {
        let run =
            import(outline.as_bytes(), &["--follower", follower, "--law", "spline", "--format", "csv", "--out", "."]);
        assert_eq!(run.code, 0, "{}{}", run.out, run.err);
        let rows = fs::read_to_string(run.directory.path().join("old-import.csv")).expect("a table");
        for row in rows.lines().skip(1) {
            let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().expect("a number")).collect();
            let wanted = lift(cells[0].to_radians());
            assert!((cells[1] - wanted).abs() < 1e-8, "{follower} at {}: {} instead of {wanted}", cells[0], cells[1]);
        }
    }
}

/// Positions with more reversals than a cam has.
#[test]
fn no_law_is_looked_for_in_noise() {
    let noisy =
        |degree: u32| format!("{degree},{:.4}", lift(degree) + if degree.is_multiple_of(2) { 0.1 } else { -0.1 });
    let rows = table("deg,mm", noisy);
    let words =
        |more: &[&'static str]| [&ROLLER[..], &["--from", "table", "--deviation", "0.1um", "--dry-run"], more].concat();
    let run = import(rows.as_bytes(), &words(&[]));
    assert!(run.code == 0 && run.out.contains("laws are fitted to at most 100"), "{}{}", run.out, run.err);
    let run = import(rows.as_bytes(), &words(&["--law", "cycloidal"]));
    assert!(run.code == 2 && run.err.contains("rises and returns: laws are fitted to at most 100"), "{}", run.err);
}

/// A harmonic cam by angle and radius, degrees and mm, with its first rise from 30 degrees: the profile under a knife edge, or the pitch curve of a
/// roller of 20 mm.
fn polar(head: &str, base: f64) -> String {
    let row = |degree: u32| {
        let angle = f64::from(degree);
        let up = |share: f64| share - (std::f64::consts::TAU * share).sin() / std::f64::consts::TAU;
        let lift = 20.0
            * if angle < 150.0 {
                up(((angle - 30.0) / 120.0).clamp(0.0, 1.0))
            } else {
                up(((330.0 - angle) / 120.0).clamp(0.0, 1.0))
            };
        format!("{angle},{:.5}\n", base + lift)
    };
    std::iter::once(head.to_owned()).chain((0..360).map(row)).collect()
}

fn base_radius(run: &Run) -> f64 {
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    number(&report(run)["import"]["base_radius_mm"])
}

#[test]
fn radii_are_asked_for_and_give_the_base_radius() {
    let roller = ["--follower", "roller,diameter=40mm", "--json", "--dry-run"];
    let of = |text: &str, more: &[&str]| import(text.as_bytes(), &[&roller[..], more].concat());
    let pitch = polar("angle,radius\n", 80.0);
    let asked = of(&pitch, &[]);
    assert!(asked.code == 2 && asked.err.contains("--as profile or --as pitch"), "{}", asked.err);
    let table = of(&pitch, &["--from", "table"]);
    assert!(table.code == 2 && table.err.contains("has radii"), "{}", table.err);
    for more in [&["--as", "pitch"][..], &["--points-of", "centre"]] {
        let run = of(&pitch, more);
        assert!((base_radius(&run) - 60.0).abs() < 1e-3, "{}", run.out);
        assert_eq!(number(&report(&run)["import"]["turn_deg"]), 0.0);
    }
    assert!((base_radius(&of(&polar("angle,pitch radius\n", 80.0), &[])) - 60.0).abs() < 1e-3);
    assert!((base_radius(&of(&polar("", 80.0), &["--as", "pitch"])) - 60.0).abs() < 1e-3);
    let head = "# given: path of the centre of the roller, radius 20 mm\ncam_deg,radius_mm\n";
    assert!((base_radius(&of(&polar(head, 80.0), &[])) - 60.0).abs() < 1e-3);
    let knife = ["--follower", "knife", "--json", "--dry-run", "--as", "profile"];
    assert!((base_radius(&import(pitch.as_bytes(), &knife)) - 80.0).abs() < 1e-3);
    let lift = of(&pitch, &["--as", "lift"]);
    assert!(lift.code == 0 && lift.out.contains("80"), "{}{}", lift.out, lift.err);
    for more in [
        &["--as", "lift", "--points-of", "centre"][..],
        &["--as", "pitch", "--from", "table"],
        &["--as", "pitch", "--ball", "1mm"],
    ] {
        assert_eq!(of(&pitch, more).code, 2, "{more:?}");
    }
}

/// What `make` writes of a cam, imported again, gives its base radius, whichever curve the file has.
#[test]
fn files_of_a_cam_give_its_base_radius() {
    let made = |words: &str| {
        let words = format!("make feeder --out . --name cam --quiet {words}");
        let directory = tempfile::tempdir().expect("a directory");
        camgen_in(directory, &words.split(' ').collect::<Vec<_>>())
    };
    let roller = "--follower roller,radius=15mm --json --dry-run --out o";
    for (make, file, import) in [
        ("--format csv,dxf", "cam.csv", "--from points"),
        ("--format csv,dxf --units inch", "cam.csv", "--from points"),
        ("--format csv,dxf", "cam.dxf", "--from outline"),
        ("--format points", "cam-points.csv", ""),
        ("--format points --points-as xy", "cam-points.csv", ""),
        ("--format points --points-of centre", "cam-points.csv", ""),
        ("--format points --points-of centre --points-as xy", "cam-points.csv", ""),
        ("--format points --points-of cutter --cutter-diameter 20mm", "cam-points.csv", ""),
        ("--format points --points-of cutter --cutter-diameter 20mm --points-as xy", "cam-points.csv", ""),
        ("--format points --points-of cutter --cutter-diameter 20mm --units inch", "cam-points.csv", "--ball 10mm"),
        ("--format points --points-of cutter --cutter-diameter 20mm --set cam.rotation=ccw", "cam-points.csv", ""),
        ("--format gauge", "cam-gauge.csv", ""),
        ("--format gauge --units inch", "cam-gauge.csv", ""),
        ("--format gauge --set cam.rotation=ccw", "cam-gauge.csv", "--set cam.rotation=ccw"),
    ] {
        let run = made(make);
        assert_eq!(run.code, 0, "{make}: {}", run.err);
        let words = format!("import {file} {roller} {import}");
        let run = camgen_in(run.directory, &words.split_whitespace().collect::<Vec<_>>());
        let imported = report(&run)["import"].clone();
        assert!(run.code == 0 && (base_radius(&run) - 17.0).abs() < 0.02, "{make}: {imported}{}", run.err);
        // The rise of the feeder is quicker than its return.
        let law = &imported["segments"][0];
        assert_eq!(number(&law["to_deg"]).round(), 120.0, "{make}: {imported}");
    }
    let told = |make: &str, words: &str, part: &str| {
        let run = camgen_in(made(make).directory, &words.split_whitespace().collect::<Vec<_>>());
        assert!(run.code == 2 && run.err.contains(part), "{words}: {}{}", run.out, run.err);
    };
    let cutter = "--format points --points-of cutter --cutter-diameter 20mm";
    let words = |file: &str, more: &str| format!("import {file} {roller} {more}");
    told(cutter, &words("cam-points.csv", "--as profile"), "leave --as and --points-of out");
    told(cutter, &words("cam-points.csv", "--ball 5mm"), "leave --ball out");
    told("--format gauge", "import cam-gauge.csv --dry-run", "has radii, diameters or distances");
    told("--format gauge --gauge flat", &words("cam-gauge.csv", ""), "--columns cam_deg,lift_mm --follower flat");
}

/// Only the columns that are read say on which curve their points are.
#[test]
fn a_column_beside_the_points_does_not_name_their_curve() {
    let knife = ["--follower", "roller,diameter=20mm", "--json", "--dry-run"];
    let of = |head: &str| {
        let run = import(points(head, |d, x, y| format!("{},0", plain(d, x, y))).as_bytes(), &knife);
        base_radius(&run)
    };
    for head in ["x_mm,y_mm,dev", "x_mm,y_mm,roller_radius_mm", "x_mm,y_mm,pitch_curvature_radius_mm"] {
        assert!((of(head) - of("x,y,")).abs() < 1e-9, "{head}");
    }
}

/// What may be radii, and no heading says that they are lifts, is asked for.
#[test]
fn possible_radii_are_asked_for() {
    let roller = ["--follower", "roller,diameter=40mm", "--dry-run"];
    let of = |text: &str, more: &[&str]| import(text.as_bytes(), &[&roller[..], more].concat());
    for head in ["", "deg;mm\n", "cam angle;cam profile mm\n", "angle,y\n"] {
        let text = polar(head, 60.0);
        let text = if head.contains(';') { text.replace(',', ";") } else { text };
        let run = of(&text, &[]);
        assert!(run.code == 2 && run.err.contains("positions of 60 to 80 mm may be radii"), "{head}: {}", run.err);
        assert_eq!(of(&text, &["--as", "lift"]).code, 0, "{head}");
        assert!((base_radius(&of(&text, &["--as", "profile", "--json"])) - 60.0).abs() < 1e-3, "{head}");
    }
    for head in ["deg,lift mm\n", "cam_deg,position\n", "Winkel,Hub\n"] {
        assert_eq!(of(&polar(head, 60.0), &[]).code, 0, "{head}");
    }
    assert_eq!(of(&polar("", 0.5), &[]).code, 0, "lifts with a clearance");
    for head in ["angle deg,diameter mm\n", "deg,distance from centre mm\n", "deg,Durchmesser\n"] {
        let text = polar(head, 60.0);
        let run = of(&text, &[]);
        assert!(run.code == 2 && run.err.contains("has radii, diameters or distances"), "{head}: {}", run.err);
        let run = of(&text, &["--as", "profile"]);
        let code = if head.contains("distance") { 0 } else { 2 };
        assert!(run.code == code && (code == 0 || run.err.contains("no columns of points")), "{head}: {}", run.err);
    }
}

/// What lies at an angle of its own stays there; of other points the design states by how much they were turned.
#[test]
fn the_design_states_by_how_much_it_was_turned() {
    let plane = points("x,y", plain);
    let knife = ["--follower", "knife", "--json", "--dry-run"];
    let turned = report(&import(plane.as_bytes(), &knife));
    let turn = number(&turned["import"]["turn_deg"]);
    let design = turned["import"]["design"].as_str().expect("a design").to_owned();
    assert_eq!(turn.abs() > 1e-4, design.contains("# turned by"), "{design}");
    let late = points("x,y", |_, x, y| format!("{:.5},{:.5}", 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y));
    let design = report(&import(late.as_bytes(), &knife))["import"]["design"].as_str().expect("a design").to_owned();
    assert!(design.contains("# turned by -36.8"), "{design}");
    let keyed = [
        &knife[..],
        &["--set", "cam.bore_diameter=20mm", "--set", "cam.keyway.width=6mm", "--set", "cam.keyway.depth=2.8mm"],
    ]
    .concat();
    assert_eq!(number(&report(&import(plane.as_bytes(), &keyed))["import"]["turn_deg"]), 0.0);
}

/// A head and a transformation of the points.
type Placed<'a> = (&'a str, &'a dyn Fn(f64, f64) -> (f64, f64));

/// Points of the mirror image or in another unit do not measure this cam; turned points do.
#[test]
fn compare_refuses_points_in_another_frame() {
    // The mirror image of a symmetric cam is the same cam, turned; the mirror image of one that rises faster than it falls is another cam.
    let even: Lift = |degree| 45.0 + cycloid(degree / 120.0, (280.0 - degree) / 120.0);
    let uneven: Lift = |degree| 45.0 + cycloid(degree / 90.0, (280.0 - degree) / 150.0);
    let place = |radius: Lift, head: &str, of: &dyn Fn(f64, f64) -> (f64, f64)| {
        let row = |degree: u32| {
            let degree = f64::from(degree);
            let (sin, cos) = degree.to_radians().sin_cos();
            let (x, y) = of(radius(degree) * cos, radius(degree) * sin);
            format!("{x},{y}\n")
        };
        std::iter::once(head.to_owned()).chain((0..360).map(row)).collect::<String>()
    };
    let design = |radius: Lift| {
        let as_is = place(radius, "x,y\n", &|x, y| (x, y));
        let run = import(as_is.as_bytes(), &["--follower", "knife", "--fit", "none", "--json", "--dry-run"]);
        (radius, report(&run)["import"]["design"].as_str().expect("a design").to_owned())
    };
    let (even, uneven) = (design(even), design(uneven));
    let compared = |(radius, design): &(Lift, String), (head, of): Placed<'_>, fit: &str| {
        let directory = tempfile::tempdir().expect("a directory");
        fs::write(directory.path().join("cam.toml"), design).expect("written");
        fs::write(directory.path().join("points.csv"), place(*radius, head, of)).expect("written");
        camgen_in(directory, &["compare", "points.csv", "cam.toml", "--dry-run", "--fit", fit])
    };
    let (sin, cos) = 0.1_f64.sin_cos();
    let turned = |x: f64, y: f64| (cos * x - sin * y, sin * x + cos * y);
    let mirrored = |x: f64, y: f64| (x, -y);
    let placed: [(&(Lift, String), Placed<'_>, &str); 9] = [
        (&uneven, ("x,y\n", &|x, y| (x, y)), ""),
        (&uneven, ("x,y\n", &turned), ""),
        (&even, ("x,y\n", &turned), ""),
        (&even, ("x,y\n", &mirrored), ""),
        (&uneven, ("x,y\n", &mirrored), "the mirror image of this cam"),
        (&uneven, ("x,y\n", &|x, y| (x / 25.4, y / 25.4)), "this cam in inches"),
        (&uneven, ("x_in,y_in\n", &|x, y| (x, y)), "this cam in millimetres, read as inches"),
        (&uneven, ("x,y\n", &|x, y| (x / 25.4, -y / 25.4)), "the mirror image of this cam in inches"),
        (&uneven, ("x_in,y_in\n", &|x, y| (-x, y)), "the mirror image of this cam in millimetres"),
    ];
    for fit in ["angle", "none", "centre"] {
        for (of, points, part) in &placed {
            let run = compared(of, *points, fit);
            // A cam that is turned and not fitted is another one.
            let is_judged = part.is_empty() && run.code < 2;
            let is_refused = !part.is_empty() && run.code == 2 && run.err.contains(part);
            assert!(is_judged || is_refused, "{fit} {part}: {}{}", run.out, run.err);
        }
    }
}
