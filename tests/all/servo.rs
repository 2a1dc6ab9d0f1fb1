//! Tables for servo drives and lists of places for measuring machines, as they are in their files.

use crate::common::program::camgen_in;
use camgen::body::Inspection;
use camgen::tool_files::{inspection, requested, servo};
use camgen::{Cam, Machine, Request, Spec, Verdict, Writing};

const TOLERANCE: f64 = 5e-6;
const LIFTER: &str = include_str!("common/lifter.toml");
const FORMATS: [(&str, &str); 3] =
    [("servo-csv", "-servo.csv"), ("servo-xyva", "-xyva.st"), ("servo-twincat", "-twincat.st")];

fn cam(name: &str, overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let (machine, _) = Machine::load(name, &overrides).expect("a machine");
    Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
}

/// The files of these formats, which pass their check.
fn files(cam: &Cam, request: Request, check: &str, formats: &[&str]) -> Vec<(String, Vec<u8>)> {
    let proven = cam.draw(request).expect("drawn").prove().expect("proved");
    let found = proven.findings().iter().find(|finding| finding.check == check).expect("checked");
    assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
    let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(formats) };
    let set = proven.files(&writing).expect("files");
    set.outputs().iter().map(|output| (output.name.clone(), output.bytes.clone())).collect()
}

#[test]
fn every_table_moves_a_drive_as_the_cam_moves_its_follower() {
    for (name, sets) in [
        ("feeder", &[][..]),
        ("lever", &[]),
        ("valve", &[]),
        ("groove", &[]),
        ("yoke", &[]),
        ("barrel", &[]),
        ("indexer", &[]),
        ("indexer", &["motion.at=17 deg"]),
        // A law whose acceleration jumps at both ends.
        ("feeder", &["motion.segment[0].law=harmonic", "motion.segment[4].law=harmonic", "limits.continuity=1"]),
    ] {
        let cam = cam(name, sets);
        let request = Request { formats: requested(&servo::NAMES), ..Request::within(TOLERANCE) };
        let names = FORMATS.map(|(format, _)| format);
        let mut files = files(&cam, request, "servo", &names);
        // A cam that is not cut in a plane also has the tables of its flanks.
        files.retain(|(file, _)| FORMATS.iter().any(|(_, ending)| file.ends_with(ending)));
        let read = files.iter().map(|(_, bytes)| servo::read(bytes).expect("a table"));
        let tables: Vec<servo::ServoRows> = read.collect();
        assert!(tables.iter().all(|table| *table == tables[0]), "{name}");
        assert!(tables[0].rows.len() < 400, "{name}: {} rows", tables[0].rows.len());
        for ((_, ending), (file, bytes)) in FORMATS.iter().zip(&files) {
            assert!(file.ends_with(ending), "{file}");
            let report = cam.check(bytes, TOLERANCE).expect("a table");
            assert!(report.passed(), "{name} {file}: {report:?}");
        }
    }
}

/// The turret of an indexer goes on by one roller in each turn: the table ends so much behind its beginning, and says so.
#[test]
fn a_table_of_an_indexer_goes_on() {
    let cam = cam("indexer", &[]);
    let request = Request { formats: requested(&servo::NAMES), ..Request::within(TOLERANCE) };
    let files = files(&cam, request, "servo", &["servo-csv"]);
    let (_, bytes) = files.iter().find(|(file, _)| file.ends_with("-servo.csv")).expect("a table");
    let text = String::from_utf8(bytes.clone()).expect("text");
    let rows = servo::read(text.as_bytes()).expect("a table").rows;
    let ends = rows.first().zip(rows.last()).map(|(first, last)| last[1] - first[1]).expect("rows");
    // Eight rollers, of which a turn moves the turret on by one.
    let pitch = 45.0;
    assert!((ends - pitch).abs() < 1e-9, "{ends} {pitch}");
    assert!(text.contains(&format!("goes on by {pitch} deg in each turn")), "{text}");
    // A table that comes back, as that of another cam does, is refused.
    let back: String = text
        .lines()
        .map(|line| match line.split_once(',') {
            Some((master, rest)) if master.parse::<f64>().is_ok_and(|master| master > 359.0) => {
                let (_, rates) = rest.split_once(',').expect("rates");
                format!("{master},0,{rates}\n")
            }
            _ => format!("{line}\n"),
        })
        .collect();
    assert!(back != text && !cam.check(back.as_bytes(), TOLERANCE).expect("a table").passed());
    let run = camgen_in(tempfile::tempdir().expect("a folder"), &["make", "indexer", "--format", "servo-isg"]);
    assert!(run.code == 2 && run.err.contains("goes on in each turn"), "{} {}", run.code, run.err);
}

#[test]
fn a_table_with_a_fault_is_refused() {
    let cam = cam("feeder", &[]);
    let request = Request { formats: requested(&servo::NAMES), ..Request::within(TOLERANCE) };
    let files = files(&cam, request, "servo", &["servo-csv"]);
    let text = String::from_utf8(files[0].1.clone()).expect("text");
    let lines: Vec<&str> = text.lines().collect();
    let row = lines.len() / 2;
    let cells: Vec<f64> = lines[row].split(',').map(|cell| cell.parse().expect("a number")).collect();
    let with = |column: usize, by: f64| {
        let mut other = cells.clone();
        other[column] += by;
        let row_text = other.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        lines
            .iter()
            .enumerate()
            .map(|(at, line)| if at == row { row_text.as_str() } else { line })
            .collect::<Vec<_>>()
            .join("\n")
    };
    let without = |at: std::ops::Range<usize>| {
        let kept = lines.iter().enumerate().filter(|(own, _)| !at.contains(own)).map(|(_, line)| *line);
        kept.collect::<Vec<_>>().join("\n")
    };
    let faults = [
        ("a position", with(1, 0.0065)),
        ("a velocity", with(2, 0.01)),
        ("an acceleration", with(3, 0.01)),
        ("rows lost", without(row..row + 5)),
        ("the end lost", without(lines.len() - 1..lines.len())),
        ("a place", with(0, 0.2)),
    ];
    for (name, text) in faults {
        let report = cam.check(text.as_bytes(), TOLERANCE).expect("a table");
        assert!(!report.passed(), "{name}: {report:?}");
    }
}

#[test]
fn a_velocity_that_jumps_is_refused() {
    let mut text = LIFTER.to_owned();
    text = text.replacen("3-4-5", "constant-velocity", 1);
    let directory = tempfile::tempdir().expect("a folder");
    std::fs::write(directory.path().join("lifter.toml"), text).expect("written");
    let run = camgen_in(directory, &["make", "lifter.toml", "--set", "limits.continuity=0", "--format", "servo-csv"]);
    assert_eq!(run.code, 2, "{} {}", run.out, run.err);
    assert!(run.err.contains("velocity") && !run.directory.path().join("output").exists(), "{}", run.err);
}

#[test]
fn places_lie_on_the_profile_and_the_ball_touches_there() {
    for (name, count) in [("feeder", 1), ("groove", 2), ("lever", 1)] {
        let cam = cam(name, &["cam.profile_tolerance=0.03 mm"]);
        let inspection = Some(Inspection { ball_radius: 2e-3 });
        let request = Request { inspection, ..Request::within(TOLERANCE) };
        let files = files(&cam, request, "inspection", &["inspect"]);
        assert_eq!(files.len(), 4 * count, "{name}");
        let sheet = String::from_utf8(files[3 * count].1.clone()).expect("text");
        assert!(files[3 * count].0.ends_with("-inspect.svg"), "{}", files[3 * count].0);
        let numbered = (1..=360).step_by(10).filter(|number| sheet.contains(&format!(">\n{number}\n<"))).count();
        assert!(numbered >= 34, "{numbered} of 36 numbers");
        for (file, bytes) in files.iter().take(3 * count) {
            let report = cam.check(bytes, TOLERANCE).expect("a list");
            assert!(report.passed(), "{name} {file}: {report:?}");
        }
        let shown = cam.check(&files[3 * count].1, TOLERANCE).expect_err("a sheet").to_string();
        assert!(shown.contains("sheet") && shown.contains("nothing to prove"), "{shown}");
        let places = inspection::read(&files[0].1).expect("a list");
        assert_eq!(places.len(), 360);
        for place in &places {
            assert!((place.ball - place.point - place.normal * 2.0).norm() < 1e-9);
            // The inner flank of a groove, too, has its metal towards the shaft.
            assert!(place.normal.dot(&place.point) > 0.0, "{name}: {place:?}");
        }
        let plain = String::from_utf8(files[count].1.clone()).expect("text");
        let first: Vec<f64> =
            plain.lines().next().expect("a line").split(' ').map(|word| word.parse().expect("a number")).collect();
        assert!(first.len() == 7 && first[0] == 1.0 && (first[1] - places[0].point.x).abs() < 1e-6, "{first:?}");
        let text = String::from_utf8(files[0].1.clone()).expect("text");
        assert!(text.contains("-0.015,0.015,"), "{text}");
        let moved = text.replacen("\n2,1,", "\n2,2,", 1);
        assert!(inspection::read(moved.as_bytes()).is_ok());
        assert!(inspection::read(text.replacen("\n2,", "\n3,", 1).as_bytes()).is_err());
        let program = String::from_utf8(files[2 * count].1.clone()).expect("text");
        assert!(program.starts_with("DMISMN/'camgen") && program.ends_with("ENDMES\nENDFIL\n"), "{program}");
        for (what, other) in [
            ("another angle", moved),
            ("a place lost", text.lines().filter(|line| !line.starts_with("360,")).collect::<Vec<_>>().join("\n")),
            ("another zone", text.replace("-0.015,0.015,", "-0.02,0.02,")),
            ("another unit", program.replace("UNITS/MM", "UNITS/INCH")),
            ("a point lost", program.replacen("ENDMES\nENDFIL", "ENDFIL", 1)),
        ] {
            let report = cam.check(other.as_bytes(), TOLERANCE).expect("a list");
            assert!(!report.passed(), "{name} {what}");
        }
    }
}

#[test]
fn a_table_of_straight_lines_keeps_the_velocity() {
    for name in ["feeder", "lever"] {
        let cam = cam(name, &[]);
        let request = Request { formats: requested(&servo::NAMES), ..Request::within(TOLERANCE) };
        let files = files(&cam, request, "servo", &["servo-isg"]);
        assert!(files[0].0.ends_with("-isg.txt"), "{}", files[0].0);
        let text = String::from_utf8(files[0].1.clone()).expect("text");
        let report = cam.check(text.as_bytes(), TOLERANCE).expect("a table");
        assert!(report.passed(), "{name}: {report:?}");
        for (from, to) in
            [("Functiontype = 1", "Functiontype = 5"), ("Begintable\n", "Begintable\n7\n"), ("EndTable", "")]
        {
            let report = cam.check(text.replacen(from, to, 1).as_bytes(), TOLERANCE).expect("a table");
            assert!(!report.passed(), "{name}: {to}");
        }
    }
}

#[test]
fn a_gauge_follower_rests_on_the_cam_and_its_table_is_checked() {
    use camgen::body::Gauge;
    use camgen::tool_files::gauge;
    for (name, follower) in [
        ("feeder", Gauge::Round(1.5e-3)),
        ("feeder", Gauge::Flat),
        ("lever", Gauge::Round(30e-3)),
        ("valve", Gauge::Round(10e-3)),
    ] {
        let cam = cam(name, &[]);
        let request = Request { gauge: Some(follower), ..Request::within(TOLERANCE) };
        let files = files(&cam, request, "gauge", &["gauge"]);
        let rows = gauge::read(&files[0].1).expect("a table").rows;
        assert!(rows.len() == 360 && rows.iter().any(|row| row[2] == 0.0) && rows.iter().all(|row| row[2] >= 0.0));
        let report = cam.check(&files[0].1, TOLERANCE).expect("a table");
        assert!(report.passed(), "{name}: {report:?}");
        let text = String::from_utf8(files[0].1.clone()).expect("text");
        let lines: Vec<&str> = text.lines().collect();
        let row = lines.len() - 100;
        let cells: Vec<f64> = lines[row].split(',').map(|cell| cell.parse().expect("a number")).collect();
        let other = format!("{},{},{}", cells[0], cells[1] + 0.0065, cells[2] + 0.0065);
        for (what, changed) in [
            ("a row moved", text.replace(lines[row], &other)),
            ("a row lost", text.replace(&format!("{}\n", lines[row]), "")),
            ("a lift alone", text.replace(lines[row], &format!("{},{},{}", cells[0], cells[1], cells[2] + 0.0065))),
        ] {
            let report = cam.check(changed.as_bytes(), TOLERANCE).expect("a table");
            assert!(!report.passed(), "{name}: {what}");
        }
    }
    // Where the follower is the gauge, the lift is that of the motion.
    let own = cam("feeder", &["follower.roller.offset=0mm"]);
    let radius = camgen::body::radius_of_roller(own.body()).expect("a roller");
    let request = Request { gauge: Some(Gauge::Round(radius)), ..Request::within(TOLERANCE) };
    let table = gauge::table(own.body(), &request).expect("a table");
    let lowest = table.rows.iter().map(|row| row[1]).fold(f64::INFINITY, f64::min);
    let curves = camgen::body::curves(own.body()).expect("a motion");
    for [cam_deg, distance] in table.rows {
        let (piece, angle) = curves.motion.locate(cam_deg.to_radians());
        let lift = 1e3 * curves.motion.jet(piece, angle).s;
        assert!((distance - lowest - lift).abs() < 1e-9, "{cam_deg}: {} {lift}", distance - lowest);
    }
}

#[test]
fn samples_of_a_table_that_is_not_counted_by_them_are_refused() {
    for format in ["points", "servo-csv", "servo-isg", "inspect", "gauge"] {
        let run = camgen_in(
            tempfile::tempdir().expect("a folder"),
            &["make", "feeder", "--format", format, "--samples", "1"],
        );
        assert_eq!(run.code, 2, "{format} {} {}", run.out, run.err);
        assert!(run.err.contains("--samples") && run.err.contains("csv"), "{}", run.err);
    }
    for (args, part) in [
        (["--format", "gauge", "--gauge", "cone"], "flat"),
        (["--format", "gcode", "--cutter-diameter", "1um"], "10 um"),
        (["--format", "gcode", "--set", "cut.feed=1e-9 mm/min"], "cut.feed"),
        (["--format", "gcode", "--set", "cut.depth_per_pass=11 um"], "at least 0.015"),
        (["--format", "dxf", "--gauge", "flat"], "belongs to --format gauge"),
    ] {
        let all: Vec<&str> = ["make", "feeder"].into_iter().chain(args).collect();
        let run = camgen_in(tempfile::tempdir().expect("a folder"), &all);
        assert!(run.code == 2 && run.err.contains(part), "{args:?}: {} {}", run.code, run.err);
        assert!(!run.directory.path().join("output").exists());
    }
}

#[test]
fn the_files_of_a_pair_and_of_a_plate_are_told_for_what_they_are() {
    let run = camgen_in(
        tempfile::tempdir().expect("a folder"),
        &["make", "conjugate", "--format", "dxf,step,csv,points,svg", "--name", "c"],
    );
    assert_eq!(run.code, 0, "{}", run.err);
    let check = |directory, file: &str, design: &str| camgen_in(directory, &["check", file, "--design", design]);
    let mut directory = run.directory;
    for (file, code, part) in [
        ("output/c-counter.dxf", 0, "is this cam"),
        ("output/c-counter.csv", 0, "is this cam"),
        ("output/c-counter-points.csv", 0, "is this cam"),
        ("output/c-main.csv", 0, "is this cam"),
        ("output/c-pair.step", 2, "-main.step"),
        ("output/c-main.svg", 2, "sheet"),
    ] {
        let run = check(directory, file, "conjugate");
        assert!(
            run.code == code && format!("{}{}", run.out, run.err).contains(part),
            "{file}: {} {} {}",
            run.code,
            run.out,
            run.err
        );
        directory = run.directory;
    }
    let run = camgen_in(directory, &["make", "wedge", "--format", "points", "--name", "w"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let run = check(run.directory, "output/w-points.csv", "wedge");
    assert!(run.code == 0 && run.out.contains("is this cam"), "{} {}", run.out, run.err);
    let path = run.directory.path().join("output/w-points.csv");
    let text = std::fs::read_to_string(&path).expect("read");
    let lines: Vec<&str> = text.lines().collect();
    for at in [lines.len() - 1, lines.len() - 30] {
        let kept: Vec<&str> = lines.iter().enumerate().filter(|(own, _)| *own != at).map(|(_, line)| *line).collect();
        std::fs::write(&path, kept.join("\n") + "\n").expect("written");
        let run = camgen_in(
            tempfile::tempdir().expect("a folder"),
            &["check", &path.display().to_string(), "--design", "wedge"],
        );
        assert_eq!(run.code, 1, "{at}: {} {}", run.out, run.err);
    }
}
