//! Programs for milling machines as their controls read them: every body and control, and planted faults.

use crate::common::program::camgen_in;
use camgen::body::Milling;
use camgen::geometry::lead_in::{LeadIn, LeadInForm};
use camgen::machine::Controller;
use camgen::tool_files::gcode::{CutterMove, CutterSide, MoveKind, read};
use camgen::{Cam, Error, ExpectedFile, Machine, Proven, Request, Spec, Verdict, Writing};

const TOLERANCE: f64 = 5e-6;
const CONTROLLERS: [Controller; 4] =
    [Controller::LinuxCnc, Controller::Fanuc, Controller::Sinumerik, Controller::Heidenhain];

fn cam(name: &str, overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let (machine, _) = Machine::load(name, &overrides).expect("a machine");
    Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
}

fn request(controller: Controller, cutter: Option<f64>) -> Request {
    let milling = Some(Milling { controller: Some(controller) });
    Request { milling, cutter_radius: cutter, ..Request::within(TOLERANCE) }
}

fn proven(cam: &Cam, request: Request) -> Proven {
    cam.draw(request).expect("drawn").prove().expect("proved")
}

/// The text of a program that was proved.
fn program(cam: &Cam, request: Request) -> String {
    let proven = proven(cam, request);
    let found = proven.findings().iter().find(|finding| finding.check == "program").expect("checked");
    assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
    let controller = request.milling.and_then(|milling| milling.controller).unwrap_or_default();
    let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(&["gcode"]) };
    let set = proven.files(&writing).expect("files");
    String::from_utf8(set.bytes(controller.ending()).expect("a program").to_vec()).expect("text")
}

/// What the check of a program says: whether it passes, its value and its note.
fn checked(cam: &Cam, text: &str, cutter: Option<f64>) -> Result<(bool, f64, String), Error> {
    let expected = ExpectedFile { cutter, ..ExpectedFile::default() };
    let report = cam.check_file(text.as_bytes(), &expected, TOLERANCE)?;
    let found = report.checks.iter().find(|finding| finding.check == "program").expect("checked").clone();
    Ok((found.verdict == Verdict::Pass, found.value, found.note_words()))
}

#[test]
fn every_body_has_a_program_for_every_control() {
    // grbl has no G41, by which a program without a cutter keeps it on the profile.
    let kept = |cutter: Option<f64>, name: &str| cutter.is_none() && name != "groove";
    for (name, cutter) in [
        ("feeder", Some(4e-3)),
        ("feeder", None),
        ("lever", Some(3e-3)),
        ("groove", Some(10e-3)),
        ("groove", None),
        ("conjugate", Some(6e-3)),
        ("yoke", None),
        ("valve", None),
    ] {
        let cam = cam(name, &["cut.depth=8mm"]);
        for controller in CONTROLLERS.into_iter().chain([Controller::Mach3, Controller::Grbl]) {
            if controller == Controller::Grbl && kept(cutter, name) {
                assert!(cam.draw(request(controller, cutter)).is_err_and(|why| why.to_string().contains("G41")));
                continue;
            }
            let text = program(&cam, request(controller, cutter));
            let (passes, value, note) = checked(&cam, &text, cutter).expect("a program");
            assert!(passes && value <= 0.005, "{name} {controller:?}: {value} {note}");
        }
    }
}

#[test]
fn passes_sense_and_side_are_those_that_were_asked_for() {
    let sets = ["cut.depth=10mm", "cut.depth_per_pass=4mm", "cut.spindle=3000", "cut.tool=3"];
    let more = ["cut.preamble=[\"G54\", \"M8\"]", "cut.postamble=[\"M9\"]", "cut.feed=450mm/min"];
    for direction in ["climb", "conventional"] {
        let direction_set = format!("cut.direction={direction}");
        let all: Vec<&str> = sets.iter().chain(&more).copied().chain([direction_set.as_str()]).collect();
        let cam = cam("feeder", &all);
        let text = program(&cam, request(Controller::LinuxCnc, None));
        let head = "G21\nG17 G90 G94\nG91.1 G40 G49 G80\nG92.2\nG61\nG53 G0 Z0.0\nT3 M6\nG54\nS3000 M3\nG54\nM8\nG17 G90 G94 G40\n";
        let tail = "G0 Z50.0\nM9\nM5\nG53 G0 Z0.0\nM9\nM30\n";
        for words in [head, "F450", "D3", "G0 G43 H3 Z50.0\nG0 Z5.0\nG1 Z", tail] {
            assert!(text.contains(words), "{words}\n{text}");
        }
        let side = if direction == "climb" { CutterSide::Left } else { CutterSide::Right };
        let read = read(text.as_bytes()).expect("a program");
        let depths: Vec<f64> = read.moves.iter().filter(|moved| moved.is_upright()).map(|moved| moved.to[2]).collect();
        assert!(depths.contains(&-3.3333) && depths.contains(&-6.6667) && depths.contains(&-10.0), "{depths:?}");
        let arcs = || read.moves.iter().filter(|moved| matches!(moved.kind, MoveKind::Arc { .. }));
        assert!(arcs().all(|moved| moved.side == side), "{direction}");
        // About the shaft a disc is climbed clockwise.
        let turned: f64 = arcs().flat_map(CutterMove::segments).map(|arc| arc.sweep()).sum();
        assert_eq!(turned < 0.0, direction == "climb");
    }
}

#[test]
fn a_planted_fault_is_refused_for_its_own_reason() {
    let (cam, cutter) = (cam("feeder", &[]), Some(4e-3));
    let text = program(&cam, request(Controller::LinuxCnc, cutter));
    let lines: Vec<&str> = text.lines().collect();
    let arcs: Vec<usize> =
        (0..lines.len()).filter(|at| lines[*at].starts_with("G2 ") || lines[*at].starts_with("G3 ")).collect();
    let middle = arcs[arcs.len() / 2];
    // In the last quarter: a program with compensation on half of its moves is read as a program of the profile.
    let late = arcs[3 * arcs.len() / 4];
    let with = |at: usize, line: Option<String>| {
        let kept = lines
            .iter()
            .enumerate()
            .filter_map(|(own, old)| if own == at { line.clone() } else { Some((*old).to_owned()) });
        kept.collect::<Vec<_>>().join("\n") + "\n"
    };
    let old = lines[middle];
    let other_way = if old.starts_with("G2 ") { old.replace("G2 ", "G3 ") } else { old.replace("G3 ", "G2 ") };
    let moved = |letter: char, by: f64, line: &str| {
        let word = line.split(' ').find(|word| word.starts_with(letter)).expect("a word");
        let number: f64 = word[1..].parse().expect("a number");
        line.replace(word, &format!("{letter}{:.4}", number + by))
    };
    let plunge = lines.iter().position(|line| line.starts_with("G1 Z-")).expect("a plunge");
    let faults = [
        ("an arc turned over", with(middle, Some(other_way)), "another cam"),
        ("a block lost", with(middle, None), "another cam|off its circle"),
        ("a centre moved", with(middle, Some(moved('J', 1.3, old))), "off its circle"),
        ("G91", with(middle, Some(format!("G91\n{old}"))), "G91"),
        ("inches", with(plunge, Some(format!("G20\n{}", lines[plunge]))), "inch"),
        ("another plane", with(plunge, Some(format!("G18\n{}", lines[plunge]))), "plane"),
        // The cutter may not go home with compensation on.
        (
            "kept on a side to the end",
            with(middle, Some(format!("G41 D1\n{old}"))),
            "leaves for a place of the machine while it is kept beside its path",
        ),
        (
            "kept on a side",
            with(late, Some(format!("G41 D1\n{}", lines[late]))).replace("M9", "G40\nM9"),
            "must be on its path",
        ),
        ("a hole in the cam", text.replace("M9", "G0 X-30 Y0\nG1 Z-500 F100\nG0 Z5\nM9"), "no pass begins there"),
        ("an end in the middle", with(middle, Some(format!("%\n{old}"))), "ends the program"),
        ("another datum", with(middle, Some(format!("G55\n{old}"))), "datum"),
        ("not deep enough", with(plunge, Some("G1 Z-7.5 F100".to_owned())), "7.5 mm deep"),
        ("a rapid plunge", with(plunge, Some(lines[plunge].replace("G1", "G0"))), "rapid"),
        ("a way in through the cam", with(arcs[0] - 3, Some("G0 X0 Y0".to_owned())), "into the cam|off its circle"),
    ];
    for (name, text, expected) in faults {
        let why = match checked(&cam, &text, cutter) {
            Ok((false, _, note)) => note,
            Ok(found) => panic!("{name} passes: {found:?}"),
            Err(error) => error.to_string(),
        };
        assert!(expected.split('|').any(|part| why.contains(part)), "{name}: {why}");
    }
    // All moved by 1.3 tolerances, by 0.5 tolerances, and a cutter that is 1.3 tolerances smaller.
    let shifted = |by: f64| {
        let line = |line: &&str| {
            if line.contains(" X") && !line.starts_with('(') { moved('X', by, line) } else { (*line).to_owned() }
        };
        lines.iter().map(line).collect::<Vec<_>>().join("\n") + "\n"
    };
    let (passes, value, _) = checked(&cam, &shifted(0.0065), cutter).expect("a program");
    assert!(!passes && value > 0.0065 && value < 0.0115, "{value}");
    let (passes, value, note) = checked(&cam, &text, Some(4e-3 - 6.5e-6)).expect("a program");
    assert!(!passes && value > 0.0065, "{value} {note}");
    assert!(matches!(checked(&cam, &text, None), Err(Error::Cutter(_))));
}

#[test]
fn sides_and_tolerances_that_no_program_keeps_are_refused_with_a_remedy() {
    use camgen::{Fit, Side};
    let sided = |side: Side| Fit { side, ..Fit::from(TOLERANCE) };
    for side in [Side::Inside, Side::Outside] {
        let cam = cam("feeder", &[]);
        let one = Request { fit: sided(side), ..request(Controller::Sinumerik, Some(4e-3)) };
        let found = proven(&cam, one);
        let found = found.findings().iter().find(|finding| finding.check == "program").expect("checked").clone();
        assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
        let kept = Request { fit: sided(side), ..request(Controller::Sinumerik, None) };
        assert!(cam.draw(kept).is_err_and(|error| error.to_string().contains("--side")));
    }
    let fine = Request { fit: Fit::from(1e-6), ..request(Controller::Fanuc, None) };
    let error = cam("feeder", &[]).draw(fine).expect_err("too fine").to_string();
    assert!(error.contains("3 decimals") && error.contains("cut.decimals"), "{error}");
    assert!(cam("feeder", &["cut.decimals=5"]).draw(fine).is_ok());
    let wide = cam("groove", &[]).draw(request(Controller::Fanuc, Some(20e-3))).expect_err("too wide").to_string();
    assert!(wide.contains("does not fit") && wide.contains("--cutter-diameter"), "{wide}");
}

#[test]
fn a_program_that_a_control_reads_otherwise_is_refused() {
    let cam = cam("feeder", &["cut.safe_height=5mm"]);
    let why = |text: &str, cutter: Option<f64>| match checked(&cam, text, cutter) {
        Ok((false, _, note)) => note,
        Ok(found) => panic!("passes: {found:?}"),
        Err(error) => error.to_string(),
    };
    let fanuc = program(&cam, request(Controller::Fanuc, Some(4e-3)));
    assert!(fanuc.contains("G1 Z-15.0 F100.\n") && fanuc.contains(" F300.\n"), "{fanuc}");
    let start = fanuc.lines().find(|line| line.starts_with("G0 X")).expect("a start");
    let whole = fanuc.replace("Z-15.0", "Z-15");
    assert!(why(&whole, Some(4e-3)).contains("Z-15 has no decimal point"), "{start}");
    // A head without blanks between its words.
    let dense = fanuc.replace("G17 G90 G94 G40 G49", "G17G90G94G40G49");
    assert!(checked(&cam, &dense, Some(4e-3)).is_ok_and(|(passes, ..)| passes));
    for controller in [Controller::Fanuc, Controller::LinuxCnc, Controller::Sinumerik] {
        let text = program(&cam, request(controller, None));
        let word = if controller == Controller::Fanuc { "G41 D01" } else { "G41 D1" };
        // On SINUMERIK D1 gives both length and radius.
        let without = text.replace(word, "G41").replace("G0 D1 Z5.0", "G0 Z5.0");
        assert!(why(&without, None).contains("without a number of its radius"), "{controller:?}");
        for line in ["G68 X0 Y0 R10", "G92 X1 Y0", "G51 X0 Y0 P2", "TRANS X10"] {
            let found = why(&text.replacen("G17", &format!("{line}\nG17"), 1), None);
            assert!(found.contains("not the profile that it says"), "{line}: {found}");
        }
    }
    let text = program(&cam, request(Controller::Heidenhain, None));
    for line in [
        "TOOL CALL 1 Z S3000 DR+0.05",
        "CYCL DEF 7.1 X+60",
        "CYCL DEF 10.1 ROT+35",
        "CYCL DEF 11.1 SCL 0.9",
        "CYCL DEF 8.1 X",
    ] {
        let found = why(&with_lines(&text, "L X", line), None);
        assert!(found.contains("DR") || found.contains("not the profile that it says"), "{line}: {found}");
    }
}

/// The line of a program that has these words, with them replaced.
fn with_line(text: &str, of: impl Fn(&str) -> bool, by: impl Fn(&str) -> String) -> String {
    let at = text.lines().position(of).expect("such a line");
    text.lines().enumerate().map(|(line, own)| if line == at { by(own) } else { own.to_owned() } + "\n").collect()
}

#[test]
fn a_barrel_is_milled_on_four_axes() {
    for (overrides, cutter, rounds) in [
        (&[][..], None, 1),
        (&["cam.rotation=ccw", "cut.depth_per_pass=5mm"], Some(6e-3), 2),
        (&["follower.roller.offset=4mm", "cam.clearance_share=0.5", "cut.direction=conventional"], Some(8e-3), 2),
    ] {
        let cam = cam("barrel", overrides);
        for controller in [Controller::LinuxCnc, Controller::Fanuc, Controller::Sinumerik] {
            let text = program(&cam, request(controller, cutter));
            let (passes, value, note) = checked(&cam, &text, cutter).expect("a program");
            assert!(passes && value <= 0.005, "{overrides:?} {controller:?}: {value} {note}");
            let found = read(text.as_bytes()).expect("a program");
            let deep = found.turned.iter().filter(|pass| pass.depth == 12.0).count();
            assert_eq!(deep, rounds, "{overrides:?}");
            // Under the upper flank a tool that climbs goes against A, along the lower one with it.
            if let [first, second, ..] = found.turned.as_slice() {
                let rises = |pass: &camgen::tool_files::gcode::TurnedPass| pass.rows[1][0] > pass.rows[0][0];
                let conventional = overrides.contains(&"cut.direction=conventional");
                assert_eq!([rises(first), rises(second)], [conventional, !conventional], "{overrides:?}");
            }
        }
        assert!(cam.draw(request(Controller::Heidenhain, cutter)).is_err_and(|why| why.to_string().contains("G93")));
    }
    let too_wide = cam("barrel", &[]).draw(request(Controller::LinuxCnc, Some(12e-3)));
    assert!(too_wide.is_err_and(|why| why.to_string().contains("does not fit")));
}

#[test]
fn a_wrong_program_of_a_barrel_is_refused_for_its_own_reason() {
    let cutter = Some(6e-3);
    let cam = cam("barrel", &[]);
    let text = program(&cam, request(Controller::LinuxCnc, cutter));
    let turning = |line: &str| line.starts_with("G1 X20.") && line.contains('A');
    let shifted = |line: &str| line.replacen("X20.", "X20.1", 1);
    let to_flank = |line: &str| line.starts_with("G1 X4.") && !line.contains('A');
    assert!(text.lines().any(to_flank), "{text}");
    for (wrong, why) in [
        (with_line(&text, turning, shifted), "off its path"),
        (text.replace("G1 Z-12.0", "G1 Z-11.0"), "11 mm deep"),
        (with_line(&text, to_flank, |line| format!("G1 X9.0 Y0.0 F300\n{line}")), "into a flank"),
        (with_line(&text, |line| line == "G93", |_| String::new()), "G93"),
    ] {
        let found = checked(&cam, &wrong, cutter);
        let found = found.map_or_else(|why| why.to_string(), |(passes, _, note)| format!("{passes} {note}"));
        assert!(found.contains(why) && !found.starts_with("true"), "{why}: {found}");
    }
    let found = checked(&cam, &text, Some(6.1e-3)).expect("a program");
    assert!(!found.0 && found.2.contains("off its path"), "{found:?}");
    // The program of another body.
    let groove = program(&self::cam("groove", &["cut.depth=8mm"]), request(Controller::LinuxCnc, None));
    assert!(checked(&cam, &groove, None).is_ok_and(|(passes, ..)| !passes));
}

/// A wheel that is fed into a disc before its pass leaves a mark there.
#[test]
fn a_wheel_that_goes_too_deep_before_its_pass_is_refused() {
    let cam = cam("feeder", &["cut.depth=8mm", "cut.form=polar"]);
    let text = program(&cam, request(Controller::LinuxCnc, Some(0.03)));
    let comes = |line: &str| line.starts_with("G1 X") && !line.contains('C');
    let wrong = with_line(&text, comes, |line| format!("G1 X20.0 F100\n{line}"));
    let (passes, value, note) = checked(&cam, &wrong, Some(0.03)).expect("a program");
    assert!(!passes && value > 1.0 && note.contains("into the cam"), "{value} {note}");
}

/// What a control would do beside the passes: a hole, a place of the machine, another datum, a tool that changes in the metal, words hidden in a shop's own line.
#[test]
fn what_a_program_of_a_turned_cam_does_beside_its_passes_is_refused() {
    let cutter = Some(6e-3);
    let cam = cam("barrel", &[]);
    let text = program(&cam, request(Controller::LinuxCnc, cutter));
    let behind = |line: &str, more: &str| with_line(&text, |own| own.starts_with(line), |own| format!("{own}\n{more}"));
    let instead = |line: &str, new: &str| with_line(&text, |own| own.starts_with(line), |own| format!("{new}{own}"));
    for (wrong, why) in [
        (behind("G0 Z5", "G0 X0 Y0 A90\nG1 Z-100 F100\nG0 Z5"), "no pass begins there"),
        (instead("(lower flank)", "G0 X0 Y0 A90\nG1 Z-40 F100\nG0 Z5\n"), "no pass begins there"),
        (instead("(lower flank)", "G55\n"), "datum"),
        (instead("G1 X4.", "G53 "), "place of the machine"),
        (instead("G93", "G1 Y-30 F300\nG1 Y0.0\n"), "into a flank"),
        (instead("G93", "M5\n"), "spindle"),
        (instead("G93", "T2 M6\n"), "tool changes"),
        (behind("G17", "G91 G64 M13"), "not known"),
        (behind("G17", "G91 G64 P0.1"), "incremental"),
        (behind("G17", "G20 G64 P0.1"), "inch"),
        (text.replace("F120.887", "F1000000"), "F1000000"),
    ] {
        let found = checked(&cam, &wrong, cutter);
        let found = found.map_or_else(|why| why.to_string(), |(passes, _, note)| format!("{passes} {note}"));
        assert!(found.contains(why) && !found.starts_with("true"), "{why}: {found}");
    }
    // What a shop adds, and a pause, changes nothing.
    for right in [
        behind("G17", "CYCLE832(0.01)\nG64 P0.01\nG91 G28 Z0\nG90"),
        instead("M30", "G91 G28 Z0\nG90\n"),
        behind("G1 Z-12", "G4 P1"),
    ] {
        let found = checked(&cam, &right, cutter).expect("a program");
        assert!(found.0, "{found:?}");
    }
    let narrow = program(&cam, request(Controller::LinuxCnc, Some(4.5e-3)));
    assert!(narrow.contains("a rib of 2.03 mm"), "{narrow}");
}

#[test]
fn words_beside_unknown_ones_are_not_passed_over() {
    let cam = cam("feeder", &["cut.depth=8mm"]);
    let text = program(&cam, request(Controller::LinuxCnc, Some(4e-3)));
    for line in ["G91 M13", "G0 X10 M13", "M98 P1000", "O<hole> call", "G1 X10 Y=5 F100"] {
        let wrong = with_line(&text, |own| own.starts_with("G17"), |own| format!("{own}\n{line}"));
        let why = checked(&cam, &wrong, Some(4e-3)).expect_err("refused").to_string();
        assert!(why.contains("not known") && why.contains("of their own"), "{line}: {why}");
    }
    for (line, passes) in [("/G91", false), ("/ G54", false), ("/M8", true), ("/2 M1", true)] {
        let other = with_line(&text, |own| own.starts_with("G17"), |own| format!("{own}\n{line}"));
        let found = checked(&cam, &other, Some(4e-3));
        assert_eq!(found.as_ref().is_ok_and(|(passes, ..)| *passes), passes, "{line}: {found:?}");
        assert!(passes || found.is_err_and(|why| why.to_string().contains("can be skipped (/)")), "{line}");
    }
    let own = with_line(&text, |own| own.starts_with("G17"), |own| format!("M13\n{own} G98 G64 P0.01"));
    assert!(checked(&cam, &own, Some(4e-3)).is_ok_and(|(passes, ..)| passes));
}

/// What the check says of a program that is wrong.
fn why_refused(cam: &Cam, text: &str, cutter: Option<f64>) -> String {
    match checked(cam, text, cutter) {
        Ok((false, _, note)) => note,
        Ok(found) => panic!("passes: {found:?}\n{text}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn the_radius_is_that_of_the_tool_of_the_design() {
    let cam = cam("feeder", &["cut.depth=8mm", "cut.tool=3"]);
    for controller in CONTROLLERS {
        let text = program(&cam, request(controller, None));
        let number = match controller {
            Controller::LinuxCnc => "D3",
            Controller::Fanuc => "D03",
            _ => "D1",
        };
        let tool = if controller == Controller::Heidenhain { "TOOL CALL 3 Z" } else { "T3 M6" };
        assert!(text.contains(tool), "{text}");
        let other = text.replace(tool, &tool.replace('3', "5"));
        assert!(why_refused(&cam, &other, None).contains("tool 5 cuts; it must be tool 3"), "{controller:?}");
        let lost: String =
            text.lines().filter(|line| !line.contains(tool)).map(|line| line.to_owned() + "\n").collect();
        assert!(why_refused(&cam, &lost, None).contains("tool 3 was not changed in"), "{controller:?}");
        if controller == Controller::Heidenhain {
            continue;
        }
        let other = text.replace(&format!("G41 {number}"), "G41 D05");
        assert!(why_refused(&cam, &other, None).contains("takes the radius D5; it must be D"), "{controller:?}");
        let arc = |line: &str| line.starts_with("G2 ");
        for word in ["D05", "D2", "G41 D5"] {
            let changed = with_line(&text, arc, |line| format!("{word}\n{line}"));
            let found = why_refused(&cam, &changed, None);
            assert!(found.contains("changes while the cutter is kept") && found.contains("line "), "{word}: {found}");
        }
    }
}

#[test]
fn a_spindle_that_does_not_turn_or_a_wrong_depth_sense_or_tolerance_is_refused() {
    let sets = ["cut.depth=8mm", "cut.depth_per_pass=4mm", "cut.spindle=3000", "cut.tool=3", "cut.safe_height=5mm"];
    let (cam, cutter) = (cam("feeder", &sets), Some(4e-3));
    let text = program(&cam, request(Controller::LinuxCnc, cutter));
    let first = text.replacen("G1 Z-4.0", "G1 Z-7.9", 1);
    for (wrong, why) in [
        (text.replace("S3000 M3\n", ""), "was not started"),
        (text.replace("S3000 M3", "M3"), "was not started"),
        (text.replace("S3000 M3", "S3000 M4"), "counter-clockwise"),
        (text.replace("S3000 M3", "S0 M3"), "stands"),
        (text.replacen("G1 Z-4.0", "M5\nG1 Z-4.0", 1), "stands"),
        (text.replace("T3 M6\nG54\nS3000 M3", "S3000 M3\nT3 M6\nG54"), "stands"),
        (first, "7.9 mm at once"),
        (text.replacen("F300", "F900", 1), "as fast as cut.feed"),
        (text.replace("F100", "F300"), "as fast as cut.plunge_feed"),
        (text.replacen("G0 Z5", "G64 P0.5\nG0 Z5", 1), "leave its path by 0.5 mm"),
    ] {
        assert_ne!(wrong, text, "{why}");
        let found = why_refused(&cam, &wrong, cutter);
        assert!(found.contains(why), "{why}: {found}");
    }
    let dialogue = program(&cam, request(Controller::Heidenhain, cutter));
    let last = dialogue.rfind("L Z+5.0").and_then(|at| dialogue[..at].rfind('\n')).expect("a retract");
    let end = dialogue[last + 1..].find('\n').expect("a line") + last + 1;
    let lost = format!("{}{}", &dialogue[..last], &dialogue[end..]);
    assert!(why_refused(&cam, &lost, cutter).contains("below the upper face"));
    let loose = with_lines(&dialogue, "L X", "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.5");
    assert_ne!(loose, dialogue);
    assert!(why_refused(&cam, &loose, cutter).contains("leave its path by 0.5 mm"));
    let up = self::cam("feeder", &[&sets[..], &["cut.direction=conventional"]].concat());
    assert!(why_refused(&up, &text, cutter).contains("cut.direction is conventional"));
}

#[test]
fn a_block_by_its_time_is_no_faster_than_the_feed_of_the_design() {
    for (name, sets, cutter) in
        [("barrel", &[][..], Some(6e-3)), ("feeder", &["cut.depth=8mm", "cut.form=polar"][..], Some(0.03))]
    {
        let cam = cam(name, sets);
        let text = program(&cam, request(Controller::LinuxCnc, cutter));
        let lost = with_line(&text, |line| line == "G94", |_| String::new());
        let found = why_refused(&cam, &lost, cutter);
        assert!(found.contains("as fast as cut.") && found.contains("line "), "{name}: {found}");
        let turns = |line: &str| line.starts_with("G1 X") && (line.contains(" A") || line.contains(" C"));
        let quick = |line: &str| {
            let (words, rate) = line.rsplit_once('F').expect("a feed");
            format!("{words}F{}", 10.0 * rate.parse::<f64>().expect("a number"))
        };
        let found = why_refused(&cam, &with_line(&text, turns, quick), cutter);
        assert!(found.contains("as fast as cut.feed") && found.contains("line "), "{name}: {found}");
    }
}

/// The report names how the cut of an edited program differs, as for an outline; a fault that is not in the path has no such diagnosis.
#[test]
fn a_shifted_program_is_told_as_shifted() {
    let directory = tempfile::tempdir().expect("a directory");
    let run = camgen_in(directory, &["make", "feeder", "--format", "gcode", "--name", "p", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let path = run.directory.path().join("out/p.ngc");
    let text = std::fs::read_to_string(&path).expect("a program");
    let moved = |word: &str| match word.strip_prefix('X').and_then(|number| number.parse::<f64>().ok()) {
        Some(x) => format!("X{:.4}", x + 12.5),
        None => word.to_owned(),
    };
    let shifted: Vec<String> =
        text.lines()
            .map(|line| {
                if line.starts_with('(') {
                    line.into()
                } else {
                    line.split(' ').map(moved).collect::<Vec<_>>().join(" ")
                }
            })
            .collect();
    std::fs::write(&path, shifted.join("\n") + "\n").expect("written");
    let run = camgen_in(run.directory, &["check", "out/p.ngc", "feeder"]);
    assert!(run.code == 1 && run.out.contains("shifted by 12.50"), "{}{}", run.out, run.err);
    std::fs::write(&path, text.replace("G1 Z-15.0", "G1 Z-14.0")).expect("written");
    let run = camgen_in(run.directory, &["check", "out/p.ngc", "feeder"]);
    assert!(run.code == 1 && !run.out.contains("diagnosis"), "{}{}", run.out, run.err);
}

#[test]
fn the_length_is_that_of_the_tool() {
    let sets = ["cut.depth=8mm", "cut.depth_per_pass=4mm", "cut.tool=1", "cut.safe_height=5mm"];
    let (cam, cutter) = (cam("feeder", &sets), Some(4e-3));
    let passes = |text: &str| checked(&cam, text, cutter).expect("a program");
    for (controller, number) in [(Controller::LinuxCnc, "H1"), (Controller::Fanuc, "H01")] {
        let text = program(&cam, request(controller, cutter));
        let takes = format!("G0 G43 {number} Z5.0");
        assert_eq!(text.matches(&takes).count(), 1, "{text}");
        let second = |words: &str| {
            let at = text.rfind("G1 Z-8.0").expect("a second pass");
            format!("{}{words}\n{}", &text[..at], &text[at..])
        };
        for (wrong, why) in [
            (text.replace(&takes, "G0 G43 H2 Z5.0"), "the length H2 of the tool; it must be H1"),
            (second("G43 H2"), "the length H2"),
            (second("G49"), "without the length"),
            (second("G43 H0"), "without the length"),
            (text.replace(&takes, "G43 H00\nG0 Z5.0"), "without the length"),
            (text.replace(&takes, "G0 Z5.0").replace("G1 Z-8.0", "G43 H1\nG1 Z-8.0"), "did not for the cuts before"),
            (text.replace(&takes, "G0 Z5.0").replace("G1 Z-8.0", "G49\nG1 Z-8.0"), "without the length"),
            (text.replace("G43", "G44"), "G44"),
            (text.replace("G43", "G43.2"), "G43.2"),
        ] {
            assert_ne!(wrong, text);
            let found = why_refused(&cam, &wrong, cutter);
            assert!(found.contains(why), "{controller:?} {why}: {found}");
        }
        assert!(why_refused(&cam, &text.replace(&takes, "G0 Z5.0"), cutter).contains("write G43"), "{controller:?}");
        for right in [
            text.replace("G17", "G40 G49 G80\nG49\nG17"),
            text.replace("M30", "G49\nG91 G28 Z0 M5\nG49\nM30"),
            text.replace(&takes, "G0 Z5.0 G43 H001"),
            second("G43 H1"),
            text.replace("T1 M6", "G91 G28 Z0 G49\nG90\nT1 M6"),
            text.replace("T1 M6", "G91 G28 Z0 T1 M6\nG90"),
        ] {
            let found = passes(&right);
            assert!(found.0, "{controller:?}: {found:?}\n{right}");
        }
    }
    let text = program(&cam, request(Controller::Sinumerik, cutter));
    for (words, why) in [("D0", "without the length"), ("D2", "the length D2 of the tool; it must be D1")] {
        let found = why_refused(&cam, &text.replacen("G0 Z5.0", &format!("{words}\nG0 Z5.0"), 1), cutter);
        assert!(found.contains(why), "{words}: {found}");
    }
    for right in [text.replace("T1 M6", "G0 G53 Z300 D0\nT1 M6"), text.replace("T1 M6", "T1 M6\nD1")] {
        assert!(passes(&right).0, "{right}");
    }
}

#[test]
fn the_speed_of_the_spindle_is_that_of_the_design() {
    let (cam, cutter) = (cam("feeder", &["cut.depth=8mm", "cut.spindle=2000", "cut.tool=1"]), Some(4e-3));
    for controller in CONTROLLERS {
        let text = program(&cam, request(controller, cutter));
        for speed in ["S20", "S990", "S4010", "S20000"] {
            let found = why_refused(&cam, &text.replace("S2000", speed), cutter);
            assert!(found.contains("cut.spindle is 2000 1/min"), "{controller:?} {speed}: {found}");
        }
        for speed in ["S1000", "S4000"] {
            assert!(checked(&cam, &text.replace("S2000", speed), cutter).is_ok_and(|found| found.0), "{controller:?}");
        }
        if controller != Controller::Heidenhain {
            let before = text.replace("T1 M6\nG54\nS2000 M3", "G54\nS2000 M3\nT1 M6");
            assert!(why_refused(&cam, &before, cutter).contains("M6 after M3"), "{controller:?}");
            assert!(why_refused(&cam, &text.replace("S2000", "G96 S2000"), cutter).contains("G96"), "{controller:?}");
        }
    }
}

#[test]
fn letters_beyond_ascii_may_stand_in_comments_alone() {
    let cam = cam("feeder", &["cut.depth=8mm"]);
    let passes = |bytes: &[u8]| {
        let report = cam.check_file(bytes, &ExpectedFile { cutter: Some(4e-3), ..ExpectedFile::default() }, TOLERANCE);
        report.is_ok_and(|report| {
            report.checks.iter().all(|finding| finding.check != "program" || finding.verdict == Verdict::Pass)
        })
    };
    let latin =
        |text: &str| text.chars().map(|letter| u8::try_from(u32::from(letter)).expect("Latin-1")).collect::<Vec<u8>>();
    for controller in CONTROLLERS {
        let text = program(&cam, request(controller, Some(4e-3)));
        let comment = match controller {
            Controller::Heidenhain => "1 ; Fr\u{e4}ser",
            Controller::Sinumerik => "; Fr\u{e4}ser",
            _ => "(Fr\u{e4}ser)",
        };
        let commented =
            with_line(&text, |line| line.contains("camgen") || line.contains("CAMGEN"), |_| comment.to_owned());
        assert!(passes(commented.as_bytes()) && passes(&latin(&commented)), "{controller:?}");
        let rapid = if controller == Controller::Heidenhain { "FMAX" } else { "G0 X" };
        let inside = text.replacen(rapid, &format!("\u{e4}{rapid}"), 1);
        assert!(!passes(inside.as_bytes()) && !passes(&latin(&inside)), "{controller:?}");
    }
}

#[test]
fn a_path_that_linuxcnc_may_leave_as_far_as_it_likes_is_refused() {
    let (cam, cutter) = (cam("feeder", &["cut.depth=8mm"]), Some(4e-3));
    let text = program(&cam, request(Controller::LinuxCnc, cutter));
    let with = |words: &str| with_lines(&text, "(profile)", words);
    for words in ["G64", "G64 P0.005\nG64", "G61\nG64"] {
        let found = why_refused(&cam, &with(words), cutter);
        assert!(found.contains("G64 P with a value"), "{words}: {found}");
    }
    for words in ["G64 P0.005", "G64\nG64 P0.005", "G64\nG61"] {
        assert!(checked(&cam, &with(words), cutter).is_ok_and(|found| found.0), "{words}");
    }
    let fanuc = program(&cam, request(Controller::Fanuc, cutter));
    assert!(checked(&cam, &fanuc.replacen("G17", "G64\nG17", 1), cutter).is_ok_and(|found| found.0));
}

/// A program with lines before the one that begins with these words; those of a dialogue get their number.
fn with_lines(text: &str, before: &str, lines: &str) -> String {
    let dialogue = text.starts_with("0 BEGIN PGM");
    let lines = lines.lines().map(|line| if dialogue { format!("0 {line}\n") } else { format!("{line}\n") });
    let lines: String = lines.collect();
    let begins = |line: &str| {
        line.trim_start_matches(|c: char| dialogue && (c.is_ascii_digit() || c == ' ')).starts_with(before)
    };
    with_line(text, begins, |line| format!("{lines}{line}"))
}

const SHOP: [&str; 4] = ["cut.depth=8mm", "cut.spindle=2000", "cut.tool=1", "cut.safe_height=5mm"];

#[test]
fn allowances_and_written_variables_are_refused_and_those_of_zero_are_not() {
    use Controller::{Fanuc, Heidenhain, LinuxCnc, Sinumerik};
    let cam = cam("feeder", &SHOP);
    for (controller, before, wrong, right) in [
        (
            Sinumerik,
            "G0 X",
            &[
                "OFFN=0.3",
                "TOFFR=0.3",
                "TOFFL=1",
                "TOFF[3]=1",
                "DL=1",
                "$TC_DP6[1,1]=10",
                "GEOAX(1,Y,2,X)",
                "TOROT",
                "TCARR=1",
                "CYCLE800(1)",
                "CYCLE832(0.5,1,1)",
            ][..],
            &["OFFN=0", "TOFFL=0", "GEOAX()", "TOROTOF", "CYCLE832(0.005,1,1)", "MSG(\"G1 X9\")", "SOFT", "CYCLE800()"]
                [..],
        ),
        (LinuxCnc, "G17", &["M61 Q2", "G92.3", "#5221=100"], &["G92.1", "#1=5"]),
        (Fanuc, "G17", &["#13001=5.", "#5221=100.", "G45 D05"], &["#100=5."]),
        (Heidenhain, "L X", &["M136", "FN 17: SYSWRITE ID10 NR1 IDX1 = +5"], &["FN 0: Q1 =+300"]),
    ] {
        let text = program(&cam, request(controller, None));
        for line in wrong {
            let found = why_refused(&cam, &with_lines(&text, before, line), None);
            assert!(found.contains("line") && !found.contains("not known"), "{controller:?} {line}: {found}");
        }
        for line in right {
            let found = checked(&cam, &with_lines(&text, before, line), None);
            assert!(found.as_ref().is_ok_and(|found| found.0), "{controller:?} {line}: {found:?}");
        }
    }
}

#[test]
fn calls_and_jumps_are_refused_in_every_dialect() {
    use Controller::{Fanuc, Heidenhain, LinuxCnc, Sinumerik};
    let cam = cam("feeder", &SHOP);
    for (controller, before, wrong, right) in [
        (
            Heidenhain,
            "L X",
            &[
                "CALL PGM ROUGH.H",
                "CALL LBL 1 REP2",
                "CYCL CALL",
                "CYCL DEF 12.1 PGM X.H",
                "FN 9: IF +1 EQU +1 GOTO LBL 9",
                "FN12: IF +Q1 LT +1 GOTO LBL 9",
                "M99",
                "L M99",
            ][..],
            &["LBL 1"][..],
        ),
        (Fanuc, "G17", &["GOTO100", "GOTO 100", "IF[1EQ1]GOTO100", "M198 P5", "M98 P5", "G65 P9811"], &["M19"]),
        (
            Sinumerik,
            "G17",
            &["ROUGH_SUB", "ROUGH_SUB(1)", "L100", "GOTOF ENDE", "N10 EXTCALL(\"X\")"],
            &["FFWON", "ENDE:", "R1=5"],
        ),
        (LinuxCnc, "G17", &["o100 call", "M98 P100"], &["M19"]),
    ] {
        let text = program(&cam, request(controller, None));
        for line in wrong {
            let found = why_refused(&cam, &with_lines(&text, before, line), None);
            assert!(found.contains("line "), "{controller:?} {line}: {found}");
        }
        // The end of a subprogram is an end: what follows is not cut.
        for line in ["RET", "M17"].iter().filter(|_| controller == Sinumerik) {
            let found = why_refused(&cam, &with_lines(&text, before, line), None);
            assert!(found.contains("cuts nothing"), "{line}: {found}");
            let ended = text.replace("M30", line);
            assert!(checked(&cam, &ended, None).is_ok_and(|found| found.0), "{line}");
        }
        for line in right {
            let found = checked(&cam, &with_lines(&text, before, line), None);
            assert!(found.as_ref().is_ok_and(|found| found.0), "{controller:?} {line}: {found:?}");
        }
    }
}

#[test]
fn everyday_words_of_controls_are_read() {
    let cam = cam("feeder", &SHOP);
    let text = program(&cam, request(Controller::Heidenhain, None));
    let comma =
        |line: &str| if line.contains(';') { format!("{line}\n") } else { format!("{}\n", line.replace('.', ",")) };
    let passes = |text: &str, note: &str| {
        let found = checked(&cam, text, None).expect("a program");
        assert!(found.0 && found.2.contains(note), "{found:?}\n{text}");
    };
    passes(&text.replace("FMAX M3", "FMAX M13"), "");
    passes(&text.lines().map(comma).collect::<String>(), "");
    passes(&text.replace("TOOL CALL 1 Z", "TOOL CALL \"MILL 8\" Z"), "not compared with cut.tool = 1");
    passes(&text.replace("S2000", "S2000 F300").replace("R0 F300", "R0 F AUTO"), "");
    for line in ["L Z-1 R0 FMAX M91", "L M140 MB MAX", "L Z-1 R0 FMAX M92"] {
        passes(&with_lines(&text, "TOOL CALL", line), "");
        passes(&with_lines(&text, "M30", line), "");
        // From the depth they retract.
        let last = text.rfind("L Z+5.0").expect("a retract");
        let end = last + text[last..].find('\n').expect("a line");
        passes(&format!("{}{line}{}", &text[..last], &text[end..]), "");
    }
    for (wrong, why) in [
        (text.replace("FMAX M3", "FMAX M14"), "counter-clockwise"),
        (text.replace("R0 F300", "R0 F AUTO"), "gives none"),
        (text.replace("S2000", "S2000 F3000").replace("R0 F300", "R0 F AUTO"), "as fast as cut.feed"),
        (text.replacen("L Z-8.0 R0 F100", "L X+0 Y+0 R0 FMAX M91\n0 L Z-8.0 R0 F100", 1), "not known"),
        (text.replace(" R0\n", " R0 M91\n"), "kept beside its path"),
        (text.replace("TOOL CALL 1 Z", "TOOL CALL 0 Z"), "TOOL CALL 0"),
    ] {
        assert_ne!(wrong, text, "{why}");
        let found = why_refused(&cam, &wrong, None);
        assert!(found.contains(why), "{why}: {found}");
    }
    let text = program(&cam, request(Controller::Sinumerik, None));
    passes(&text.replace("T1 M6", "T=\"MILL8\" M6"), "not compared with cut.tool = 1");
    passes(&with_lines(&text, "T1 M6", "SUPA G0 Z300 D0"), "");
    passes(&with_lines(&text, "M30", "G0 SUPA Z300 D0"), "");
    passes(&with_lines(&text, "S2000", "SUPA G0 Z300 D0"), "");
    let fanuc = program(&cam, request(Controller::Fanuc, None)).replace("T1 M6", "T=\"MILL8\" M6");
    assert!(why_refused(&cam, &fanuc, None).contains("not by a name"));
}

/// Words of the head that moves rely on: without one of them the program is refused, and the message names the word to write.
#[test]
fn a_move_before_what_it_relies_on_is_refused() {
    use Controller::{Fanuc, Heidenhain, LinuxCnc, Sinumerik};
    let (cam, cutter) = (cam("feeder", &SHOP), Some(4e-3));
    for (controller, faults) in [
        (
            LinuxCnc,
            &[
                (" G40 G49", " G49", "write G40"),
                ("G90 G94", "G90", "write G94"),
                ("G91.1 ", "", "write G91.1"),
                ("G61\n", "", "write G61"),
                ("G54\n", "", "write G54"),
                ("G53 G0 Z0.0\nT1", "T1", "at a height that is not known"),
                ("G53 G0 Z0.0\nT1", "G28\nT1", "in all axes"),
                ("G53 G0 Z0.0\nT1", "G0 G28 Z0\nT1", "by coordinates of the part"),
                ("G0 G43 H1 Z5.0", "G0 Z5.0", "write G43"),
                // Its position is then another one.
                ("G0 G43 H1 Z5.0", "G0 G43 H1 Z5.0\nG55", "datum changes"),
            ][..],
        ),
        (
            Fanuc,
            &[
                ("G40 G49", "G49", "write G40"),
                ("G94 ", "", "write G94"),
                ("G0 G43 H01 Z5.0", "G0 Z5.0", "write G43"),
                ("G0 G43 H01 Z5.0", "G43 H01 Z5.0\nG91 G28 Z0.\nG90\nG0 Z5.0", "write G43"),
                ("G91 G28 Z0.\nG90\nT1", "G90\nT1", "at a height that is not known"),
                ("G91 G28 Z0.\nG90\nT1", "G91 G53 G0 Z0.\nG90\nT1", "leaves out unless in G90"),
            ][..],
        ),
        (
            Sinumerik,
            &[
                (" G40", "", "write G40"),
                ("G642 CTOL=0.001", "G642", "without a bound"),
                ("G642 CTOL=0.001", "G64", "without a bound"),
                ("G642 CTOL=0.001", "G645", "without a bound"),
                ("G642 CTOL=0.001", "COMPCAD", "without a bound"),
                ("G642 CTOL=0.001\n", "", "path mode"),
                ("G0 D1 Z5.0", "G0 Z5.0", "write D1"),
                (" D0\nT1", "\nT1", "write D0"),
            ][..],
        ),
        (
            Heidenhain,
            &[
                (" R0", "", "write R0"),
                ("L Z-1.0 R0 FMAX M91\n", "M9\n", "at a height that is not known"),
                ("FMAX M3\n", "FMAX\n", "was not started"),
            ][..],
        ),
    ] {
        let text = program(&cam, request(controller, cutter));
        assert!(checked(&cam, &text, cutter).is_ok_and(|found| found.0), "{controller:?}");
        for (from, to, why) in faults {
            // In the head only, except R0.
            let wrong = if *from == " R0" { text.replace(from, to) } else { text.replacen(from, to, 1) };
            assert_ne!(wrong, text, "{controller:?} {from}");
            let found = why_refused(&cam, &wrong, cutter);
            assert!(found.contains(why), "{controller:?} {from}: {found}");
        }
        // Across and down at once, and down before across.
        let (across, down) = if controller == Heidenhain { ("L X", "L Z+5") } else { ("G0 X", "G0 ") };
        let lines: Vec<&str> = text.lines().collect();
        let at = lines.iter().position(|line| line.contains(across)).expect("a first move");
        assert!(lines[at + 1].contains(down), "{text}");
        let mut swapped = lines.clone();
        swapped.swap(at, at + 1);
        let found = why_refused(&cam, &(swapped.join("\n") + "\n"), cutter);
        assert!(found.contains("before X and Y are known"), "{controller:?}: {found}");
        // With the tool length of the move down.
        let slanted = match lines[at + 1].strip_prefix("G0") {
            Some(lowered) => lines[at].to_owned() + lowered,
            None => lines[at].replacen(" R0", " Z+5.0 R0", 1),
        };
        let mut both = lines.clone();
        both[at] = &slanted;
        let found = why_refused(&cam, &(both.join("\n") + "\n"), cutter);
        assert!(found.contains("goes down as it does"), "{controller:?}: {found}");
    }
}

/// Without tool or spindle in the machine file the program stops for the operator and lists the settings; without its stop it is refused.
#[test]
fn a_program_without_a_tool_stops_for_it() {
    for controller in CONTROLLERS {
        let cam = cam("feeder", &["cut.depth=8mm"]);
        let text = program(&cam, request(controller, Some(4e-3)));
        let stop = if controller == Controller::Heidenhain { " STOP\n" } else { "\nM0\n" };
        let lower = text.to_ascii_lowercase();
        for words in ["load the cutter", "start the spindle", "cut.tool", "cut.spindle"] {
            assert!(lower.contains(words), "{controller:?} {words}: {text}");
        }
        let line = |line: &str| format!("\n{line}").ends_with(stop.trim_end());
        let without: String = text.lines().filter(|own| !line(own)).map(|own| own.to_owned() + "\n").collect();
        assert_ne!(without, text, "{controller:?}");
        let found = why_refused(&cam, &without, Some(4e-3));
        assert!(found.contains("M0") || found.contains("STOP"), "{controller:?}: {found}");
        let whole = self::cam("feeder", &SHOP);
        let text = program(&whole, request(controller, Some(4e-3)));
        assert!(!text.contains(stop) && !text.to_ascii_lowercase().contains("load the cutter"), "{text}");
    }
}

/// Words without effect, or that cancel a shift of the profile, pass; so does a program that leaves the whole set-up to the operator.
#[test]
fn harmless_words_and_a_bare_path_are_taken() {
    use Controller::{Fanuc, Heidenhain, LinuxCnc, Sinumerik};
    let (cam, cutter) = (cam("feeder", &SHOP), Some(4e-3));
    for (controller, before, lines) in [
        (LinuxCnc, "G0 X", &["G54 G92.1", "G90 G92.2 G80", "G64 P0.004", "G91 G28 Z0\nG90"][..]),
        (Fanuc, "G0 X", &["G61", "G91 G28 Z0.\nG90"]),
        (
            Sinumerik,
            "G0 X",
            &["G60", "G641 ADIS=0.004", "TRANS", "CYCLE832(0.004,1,1)", "COMPCAD\nCOMPOF", "G0 SUPA Z0 D0"],
        ),
        (Heidenhain, "L X", &["L Z-1 R0 FMAX M91", "L M140 MB MAX"]),
    ] {
        let text = program(&cam, request(controller, cutter));
        for line in lines {
            let found = checked(&cam, &with_lines(&text, before, line), cutter);
            assert!(found.as_ref().is_ok_and(|found| found.0), "{controller:?} {line}: {found:?}");
        }
    }
    // A program that loses its bound in the middle is refused.
    let exact = program(&cam, request(Sinumerik, cutter)).replace("G642 CTOL=0.001", "G60");
    assert!(checked(&cam, &exact, cutter).is_ok_and(|found| found.0));
    for (words, why) in
        [("G64", "without a bound"), ("G642", "without a bound"), ("G645", "without a bound"), ("COMPON", "not known")]
    {
        let wrong = with_line(&exact, |line| line.starts_with("G2 "), |line| format!("{words}\n{line}"));
        assert!(why_refused(&cam, &wrong, cutter).contains(why), "{words}");
    }
    let compressed = exact.replace("G60\n", "G60\nCOMPON\n");
    assert!(why_refused(&cam, &compressed, cutter).contains("without a bound"));
    let kept = program(&cam, request(Heidenhain, None)).replacen(" RL\n", " RL M120 LA10\n", 1);
    assert!(checked(&cam, &kept, None).is_ok_and(|found| found.0 && found.2.contains("M120")));
    let bare = self::cam("feeder", &["cut.depth=8mm"]);
    let text = program(&bare, request(LinuxCnc, cutter));
    let path = text.find("G1 Z-").expect("a pass");
    let start = text.lines().find(|line| line.starts_with("G0 X")).expect("a start");
    let end = text.find("M9").expect("a tail");
    let alone = format!("G17 G21 G40 G90 G91.1 G94\nG0 Z5.0\n{start}\n{}M30\n", &text[path..end]);
    let found = checked(&bare, &alone, cutter).expect("a program");
    assert!(found.0 && found.2.contains("not stated, as set before the program: datum, tool length"), "{found:?}");
    let across = alone.replacen(&format!("G0 Z5.0\n{start}\n"), &format!("{start}\nG0 Z5.0\n"), 1);
    assert_ne!(across, alone);
    assert!(why_refused(&bare, &across, cutter).contains("at a height that is not known"));
    let never = alone.replacen("G0 Z5.0\n", "", 1);
    assert!(why_refused(&bare, &never, cutter).contains("place that is not known"));
}

/// A path of lines only, without compensation, is a cutter-centre path.
#[test]
fn a_program_without_arcs_takes_the_diameter_of_the_cutter() {
    let (cam, cutter) = (cam("feeder", &SHOP), Some(4e-3));
    let text = program(&cam, request(Controller::LinuxCnc, cutter));
    let read = read(text.as_bytes()).expect("a program");
    let mut moves = read.moves.iter();
    let lines = text.lines().map(|line| {
        if !line.starts_with("G2 ") && !line.starts_with("G3 ") {
            return format!("{line}\n");
        }
        let arc = moves.find(|moved| matches!(moved.kind, MoveKind::Arc { .. })).expect("an arc");
        arc.segments().iter().map(as_lines).collect()
    });
    let text: String = lines.collect();
    assert!(!text.contains("G2 ") && !text.contains("G3 "));
    let (passes, value, note) = checked(&cam, &text, cutter).expect("a program");
    assert!(passes && value < 0.005 && note.contains("cutter Ø8 mm"), "{value} {note}");
    assert!(matches!(checked(&cam, &text, None), Err(Error::Cutter(_))));
}

/// An arc in straight lines within 0.2 µm.
fn as_lines(arc: &camgen::geometry::contour::Segment) -> String {
    let (chord, sweep) = (arc.end - arc.start, arc.sweep());
    let centre = arc.start + 0.5 * chord + 0.5 / (0.5 * sweep).tan() * nalgebra::Vector2::new(-chord.y, chord.x);
    let from = arc.start - centre;
    let count = (sweep.abs() / (8.0 * 2e-4 / from.norm()).sqrt()).ceil().max(1.0);
    let mut text = String::new();
    let mut step = 1.0;
    while step <= count {
        let (sin, cos) = (sweep * step / count).sin_cos();
        let to = centre + nalgebra::Vector2::new(cos * from.x - sin * from.y, sin * from.x + cos * from.y);
        text += &format!("G1 X{:.5} Y{:.5} F300\n", to.x, to.y);
        step += 1.0;
    }
    text
}

/// Least distance of a point from the outlines of a cam, mm.
fn room(proven: &Proven, point: [f64; 2]) -> f64 {
    let edges = proven.outlines().iter().flat_map(|outline| outline.contour.edges());
    let points = edges.flat_map(|edge| (0..=500).map(move |step| edge.point_and_tangent(f64::from(step) / 500.0).0));
    points.map(|on| (on.x - point[0]).hypot(on.y - point[1])).fold(f64::INFINITY, f64::min)
}

/// A cutter that the control keeps on the profile goes down before its radius is taken up: it must be clear of the metal there with its whole radius.
#[test]
fn a_compensated_cutter_goes_down_clear_of_the_cam() {
    let mut programs = 0;
    for (name, radius) in
        [("groove", 3e-3), ("groove", 6e-3), ("groove", 10e-3), ("feeder", 2e-3), ("feeder", 8e-3), ("lever", 5e-3)]
    {
        let cam = cam(name, &["cut.compensation=control", "cut.depth=8mm"]);
        for lead_in in [None, Some(LeadIn { form: LeadInForm::Tangent, size: 1.5 * radius })] {
            let wanted = Request { lead_in, ..request(Controller::LinuxCnc, Some(radius)) };
            let Ok(drawing) = cam.draw(wanted) else { continue };
            let proven = drawing.prove().expect("proved");
            let found = proven.findings().iter().find(|finding| finding.check == "program").expect("checked").clone();
            if found.verdict != Verdict::Pass {
                let why = found.note_words();
                assert!(why.contains("free for the cutter"), "{name} {radius}: {why}");
                continue;
            }
            let text = program(&cam, wanted);
            let moves = read(text.as_bytes()).expect("a program").moves;
            for down in moves.iter().filter(|moved| moved.is_upright() && moved.to[2] < -1.0) {
                let room = room(&proven, [down.to[0], down.to[1]]);
                assert!(room > 1e3 * radius - 0.01, "{name} {radius}: {room} mm at {:?}", down.to);
            }
            programs += 1;
        }
    }
    assert!(programs > 5, "{programs}");
    let feeder = cam("feeder", &["cut.compensation=control"]);
    let text = program(&feeder, request(Controller::LinuxCnc, Some(8e-3)));
    assert!(checked(&feeder, &text, Some(8e-3)).expect("a program").0);
    // The last move before the cutter rises, on which the compensation ends.
    let last = text.lines().skip_while(|line| *line != "G40").nth(1).expect("the way out");
    for (to, depth) in [("G1 X25.0888 Y34.1061", 3.69), ("G1 X22 Y0", 0.0)] {
        let (passes, value, why) = checked(&feeder, &text.replace(last, to), Some(8e-3)).expect("a program");
        assert!(!passes && why.contains("as the control takes up its radius or ends it"), "{to}: {why}");
        assert!(depth == 0.0 || (value - depth).abs() < 0.3, "{to}: {value}");
    }
}

/// Words that make the path, the tool or its length another one, in each control's own form; inserted before the first move across.
#[test]
fn what_changes_path_tool_or_length_unseen_is_refused() {
    use Controller::{Fanuc, Heidenhain, LinuxCnc, Sinumerik};
    let (cam, cutter) = (cam("feeder", &SHOP), Some(4e-3));
    for (controller, before, wrong) in [
        (
            LinuxCnc,
            "G0 X",
            &[
                "G64 P0.005 Q0.5",
                "G43 H4 Z9\nH1",
                "G43 H4.5",
                "D-3",
                "g 9 1",
                "G 9 1",
                "G53 G0 Z-400",
                "(abort, no blank)",
                "G43 H4 Z60",
                "G064 P1",
                "G64.0 P1",
                "G 64",
                "G64 P0",
                "G64 P-1",
                "G61 G64 P1",
                "G64 P0.003 P1",
                "G62",
                "G9",
                "m061 q2",
                "S10 M64 P0",
                "G4",
            ][..],
        ),
        (Fanuc, "G0 X", &["G43 H04 Z60.", "G43 H1.5", "T1 M61", "N10GOTO10", "G642"]),
        (
            Sinumerik,
            "G0 X",
            &[
                "CTOL=0.5",
                "G64",
                "G641",
                "G642 ADIS=1",
                "CYCLE832()",
                "CYCLE832(0.004,0,1)",
                "D2\nG0 Z60",
                "Z=AC(-30)",
                "Z=IC(2)",
                "POSA[Z]=3",
                "G[14]=2",
                "G 64",
                "G0641",
                "G644.",
                "CTOL=-1",
                "G642\tCTOL = 0.001+1",
                "MSG(\"a\") Z=AC(-30)",
                "MSG(\"a\") POCKET3(1)",
                "G61",
                "LAB: MYPROG",
                "G500",
                "G0 SUPA Z-400 D0",
            ],
        ),
        (
            Heidenhain,
            "L X",
            &[
                "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1",
                "TOOL CALL Q5 Z S2000",
                "/ L Z-30 R0 FMAX",
                "LP PR+10 PA+20",
                "CT X+1 Y+2",
                "APPR LT X+1 Y+2",
                "TCH PROBE 400.0",
                "CYCL DEF 220 PATTERN",
                "L Z-400 R0 FMAX M91",
                "L Z-400 R0 FMAX M92",
                "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T-1",
                "CYCL DEF 32.0 TOLERANCE",
                "CYCL DEF 32.1T5",
                "L M140 MB50",
                "PLANE RESET TURN",
            ],
        ),
    ] {
        let home = if controller == Heidenhain { "cut.home=-1mm" } else { "cut.home=0mm" };
        let homed = self::cam("feeder", &[SHOP[0], SHOP[1], SHOP[2], home]);
        let text = program(&homed, request(controller, cutter));
        assert!(checked(&homed, &text, cutter).is_ok_and(|found| found.0), "{controller:?}");
        for line in wrong {
            let found = why_refused(&homed, &with_lines(&text, before, line), cutter);
            assert!(found.contains("line"), "{controller:?} {line}: {found}");
        }
    }
    // A place of the machine that nothing is known of is told.
    let text = program(&cam, request(LinuxCnc, cutter)).replace("G53 G0 Z0.0", "G53 G0 Z-400");
    let found = checked(&cam, &text, cutter).expect("a program");
    assert!(found.0 && found.2.contains("Z -400 mm of the machine"), "{found:?}");
}

/// Heads and tails of shops that move nothing, or only far above the part.
#[test]
fn heads_and_tails_of_shops_are_taken() {
    use Controller::{Fanuc, Heidenhain, LinuxCnc, Sinumerik};
    let (cam, cutter) = (cam("feeder", &SHOP), Some(4e-3));
    for (controller, before, line) in [
        (Heidenhain, "L X", "L Z+100 R0 FMAX M3"),
        (Heidenhain, "L X", "L M3"),
        (Heidenhain, "L X", "FUNCTION RESET TCPM"),
        (Heidenhain, "L X", "L Z+100 R0 F MAX"),
        (Heidenhain, "L X", "L M140 MB MAX"),
        (Fanuc, "G0 X", "G05.1 Q1 R5"),
        (Fanuc, "M9", "M88"),
        (Fanuc, "M30", "M88"),
        (Sinumerik, "M30", "SOFT"),
        (Heidenhain, "L Z-1", "BLK FORM 0.1 Z X-60 Y-60 Z-20"),
        (Heidenhain, "L Z-1", "CYCL DEF 247 DATUM SETTING Q339=+1"),
        (Fanuc, "G0 X", "G0 G43 H01 Z100."),
        (LinuxCnc, "G0 X", "G64 P0.004 Q0.004"),
        (Sinumerik, "M9", "CYCLE832()"),
        (Sinumerik, "G0 X", "CYCLE832(0.004,_FINISH,1)"),
    ] {
        let text = program(&cam, request(controller, cutter));
        let other = with_lines(&text, before, line);
        assert_ne!(other, text, "{controller:?} {line}");
        let found = checked(&cam, &other, cutter);
        assert!(found.as_ref().is_ok_and(|found| found.0), "{controller:?} {line}: {found:?}");
    }
}

/// The radius and the path mode stay what they are while the control keeps the cutter beside its path, and the spindle turns in the cut.
#[test]
fn nothing_changes_under_compensation_or_in_the_cut() {
    use Controller::{Heidenhain, LinuxCnc};
    let cam = cam("feeder", &SHOP);
    let behind_arc = |text: &str, words: &str| {
        let dialogue = text.starts_with("0 BEGIN PGM");
        let at = text.match_indices(if dialogue { " DR" } else { "\nG3 X" }).nth(1).expect("an arc").0;
        let end = at + 1 + text[at + 1..].find('\n').expect("a line");
        format!("{}\n{}{words}{}", &text[..end], if dialogue { "0 " } else { "" }, &text[end..])
    };
    for (controller, words) in [
        (Heidenhain, "TOOL CALL DR+0.5"),
        (Heidenhain, "M6"),
        (Heidenhain, "M0"),
        (LinuxCnc, "G61"),
        (LinuxCnc, "G64 P0.003"),
        (LinuxCnc, "G41 D1"),
    ] {
        let text = program(&cam, request(controller, None));
        assert!(checked(&cam, &text, None).is_ok_and(|found| found.0), "{controller:?}");
        let found = why_refused(&cam, &behind_arc(&text, words), None);
        assert!(found.contains("line"), "{controller:?} {words}: {found}");
    }
}
