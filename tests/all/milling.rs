//! How a program mills: heights, entry, roughing and finishing, own lines, coolant, chords, and the controls without tool change or with their own words.

use camgen::body::Milling;
use camgen::geometry::MILLIMETRES;
use camgen::machine::Controller;
use camgen::tool_files::gcode::{CutterMove, CutterProgram, MoveKind, read};
use camgen::{Cam, ExpectedFile, Machine, Request, Spec, Verdict, Writing};

const TOLERANCE: f64 = 5e-6;
const ALL: [Controller; 6] = [
    Controller::LinuxCnc,
    Controller::Fanuc,
    Controller::Sinumerik,
    Controller::Heidenhain,
    Controller::Grbl,
    Controller::Mach3,
];

fn cam(name: &str, overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let (machine, _) = Machine::load(name, &overrides).expect("a machine");
    Spec::of_program(machine, None).expect("a motion").solve().expect("a cam")
}

fn request(controller: Controller, cutter: Option<f64>) -> Request {
    let milling = Some(Milling { controller: Some(controller) });
    Request { milling, cutter_radius: cutter, ..Request::within(TOLERANCE) }
}

/// The text of a program that its check passes.
fn program(cam: &Cam, (controller, cutter): (Controller, Option<f64>)) -> String {
    let proven = cam.draw(request(controller, cutter)).expect("drawn").prove().expect("proved");
    let found = proven.findings().iter().find(|finding| finding.check == "program").expect("checked");
    assert_eq!(found.verdict, Verdict::Pass, "{controller:?}: {found:?}");
    let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(&["gcode"]) };
    let set = proven.files(&writing).expect("files");
    String::from_utf8(set.bytes(controller.ending()).expect("a program").to_vec()).expect("text")
}

/// What the check of a changed program says: its note, or its refusal.
fn verdict(cam: &Cam, text: &str, cutter: Option<f64>) -> (bool, String) {
    let expected = ExpectedFile { cutter, ..ExpectedFile::default() };
    match cam.check_file(text.as_bytes(), &expected, TOLERANCE) {
        Ok(report) => {
            let found = report.checks.iter().find(|finding| finding.check == "program").expect("checked").clone();
            (found.verdict == Verdict::Pass, found.note_words())
        }
        Err(error) => (false, error.to_string()),
    }
}

fn refused(name: &str, overrides: &[&str], asked: (Controller, Option<f64>)) -> String {
    cam(name, overrides).draw(request(asked.0, asked.1)).expect_err("refused").to_string()
}

fn moves(text: &str) -> CutterProgram {
    read(text.as_bytes()).expect("a program")
}

/// Moves straight down at a feed to below the upper face.
fn plunges(program: &CutterProgram) -> Vec<CutterMove> {
    let down = |moved: &&CutterMove| {
        moved.kind != MoveKind::Rapid && moved.is_upright() && moved.to[2] < moved.from[2].min(0.0)
    };
    program.moves.iter().filter(down).copied().collect()
}

#[test]
fn rapid_moves_across_are_at_the_safe_height_and_come_down_to_the_clearance() {
    let sets = ["cut.depth=8mm", "cut.depth_per_pass=4mm", "cut.safe_height=60mm", "cut.clearance=2mm", "cut.tool=1"];
    let cam = cam("feeder", &sets);
    for controller in ALL {
        let program = moves(&program(&cam, (controller, Some(4e-3))));
        let rapid = || program.moves.iter().filter(|moved| moved.kind == MoveKind::Rapid);
        let across: Vec<f64> = rapid().filter(|moved| !moved.is_upright()).map(|moved| moved.to[2]).collect();
        assert!(!across.is_empty() && across.iter().all(|z| (z - 60.0).abs() < 1e-9), "{controller:?}: {across:?}");
        let lowest = rapid().filter(|moved| moved.to[2] < moved.from[2]).map(|moved| moved.to[2]).fold(60.0, f64::min);
        assert!((lowest - 2.0).abs() < 1e-9, "{controller:?}: {lowest}");
        assert!((program.moves.last().expect("an end").to[2] - 60.0).abs() < 1e-9, "{controller:?}");
    }
}

#[test]
fn coolant_and_own_lines_are_in_their_order() {
    let lines =
        ["cut.header=[\"G55\"]", "cut.after_tool=[\"M1\"]", "cut.preamble=[\"G4 P1\"]", "cut.footer=[\"G4 P2\"]"];
    let sets = ["cut.depth=8mm", "cut.tool=3", "cut.spindle=2000", "cut.coolant=flood", "cut.postamble=[\"G4 P3\"]"];
    let cam = cam("feeder", &[&sets[..], &lines[..]].concat());
    let text = program(&cam, (Controller::LinuxCnc, Some(4e-3)));
    let order = [
        "\nG61\n",
        "\nG55\n",
        "\nG53 G0 Z0.0\n",
        "\nT3 M6\n",
        "\nM1\n",
        "\nS2000 M3\n",
        "\nM8\n",
        "\nG4 P1\n",
        "\nG1 ",
        "\nG4 P2\n",
        "\nM9\n",
        "\nM5\n",
        "\nG53 G0 Z0.0\n",
        "\nG4 P3\n",
        "\nM30\n",
    ];
    let mut at = 0;
    for words in order {
        at += text[at..].find(words).unwrap_or_else(|| panic!("{words:?} is missing behind {at}:\n{text}"));
    }
    let mist = self::cam("feeder", &["cut.depth=8mm", "cut.coolant=mist", "cut.tool=1", "cut.spindle=2000"]);
    for controller in ALL {
        let text = program(&mist, (controller, Some(4e-3)));
        let is = if controller == Controller::Heidenhain { "FMAX M7\n" } else { "\nM7\n" };
        assert!(text.contains(is) && text.contains("M9\n"), "{controller:?}: {text}");
        assert!(!program(&self::cam("feeder", &[]), (controller, Some(4e-3))).contains("M8"), "{controller:?}");
    }
}

#[test]
fn cutter_comes_down_beside_the_blank_or_on_a_ramp() {
    let cutter = 4e-3;
    for margin in [1.0, 3.0, 20.0] {
        let set = format!("cut.blank_margin={margin}mm");
        let feeder = cam("feeder", &["cut.depth=8mm", "cut.depth_per_pass=4mm", &set]);
        let found = moves(&program(&feeder, (Controller::LinuxCnc, Some(cutter))));
        let largest = found.moves.iter().filter(|moved| matches!(moved.kind, MoveKind::Arc { .. }));
        let profile = largest.map(|moved| moved.end().norm()).fold(0.0, f64::max) - MILLIMETRES * cutter;
        let down = plunges(&found);
        assert_eq!(down.len(), 2);
        let least = profile + margin + MILLIMETRES * cutter;
        assert!(down.iter().all(|moved| moved.end().norm() > least), "{margin}: {down:?} {least}");
    }
    for (name, sets, cutter) in [
        ("groove", &["cut.depth=8mm", "cut.depth_per_pass=4mm"][..], None),
        ("groove", &["cut.depth=8mm", "cut.depth_per_pass=4mm", "cut.finish_passes=2"], Some(6e-3)),
        ("groove", &["cut.depth=8mm", "cut.compensation=control"], None),
    ] {
        let cam = cam(name, sets);
        for controller in ALL {
            let keeps = sets.contains(&"cut.compensation=control");
            if controller == Controller::Grbl && keeps {
                continue;
            }
            let found = moves(&program(&cam, (controller, cutter)));
            let sloping: Vec<&CutterMove> =
                found.moves.iter().filter(|moved| !moved.is_level() && !moved.is_upright()).collect();
            assert!(!sloping.is_empty(), "{name} {controller:?}");
            for moved in sloping {
                let slope = (moved.from[2] - moved.to[2]) / (moved.end() - moved.start()).norm();
                assert!(slope < 5_f64.to_radians().tan() && moved.kind == MoveKind::Line, "{name}: {moved:?}");
            }
            // Straight down it goes at the most to what was cut before.
            assert!(plunges(&found).iter().all(|moved| moved.to[2] > -8.0), "{name} {controller:?}");
        }
    }
}

#[test]
fn plunge_into_the_blank_is_refused_and_told_of_a_foreign_program() {
    let cutter = Some(4e-3);
    let sets = ["cut.depth=8mm", "cut.blank_margin=3mm"];
    let stated = cam("feeder", &sets);
    let unstated = cam("feeder", &["cut.depth=8mm"]);
    let straight = cam("feeder", &["cut.depth=8mm", "cut.entry=plunge"]);
    let text = program(&straight, (Controller::LinuxCnc, cutter));
    let (passes, note) = verdict(&stated, &text, cutter);
    assert!(!passes && note.contains("straight down into the metal of the blank"), "{note}");
    let (passes, note) = verdict(&unstated, &text, cutter);
    assert!(passes && note.contains("goes straight down into metal, unless"), "{note}");
    let (passes, note) = verdict(&straight, &text, cutter);
    assert!(passes && !note.contains("straight down"), "{note}");
    let text = program(&stated, (Controller::LinuxCnc, cutter));
    assert!(!verdict(&stated, &text, cutter).1.contains("straight down"));
    // A groove is metal wherever it was not cut.
    let groove = cam("groove", &["cut.depth=8mm", "cut.blank_margin=3mm"]);
    let ramped = program(&groove, (Controller::LinuxCnc, None));
    let lines: Vec<&str> = ramped.lines().collect();
    let flat: Vec<String> = lines
        .iter()
        .filter(|line| !(line.starts_with("G1 X") && line.contains(" Z")))
        .map(|line| (*line).to_owned())
        .collect();
    let last = lines.iter().rposition(|line| line.starts_with("G1 X") && line.contains(" Z-8")).expect("a ramp");
    let place: Vec<&str> = lines[last].split(' ').filter(|word| word.starts_with(['X', 'Y'])).collect();
    let plunged = flat.join("\n").replace("G1 Z0.5", &format!("G0 {}\nG1 Z-8.0", place.join(" "))) + "\n";
    let (passes, note) = verdict(&groove, &plunged, None);
    assert!(!passes && note.contains("into the metal of the blank"), "{note}\n{plunged}");
    let first = lines.iter().position(|line| line.starts_with("G1 X") && line.contains(" Z-")).expect("a ramp");
    let (across, _) = lines[first].rsplit_once(" Z").expect("a depth");
    let steep = ramped.replacen(lines[first], &format!("{across} Z-7.9"), 1);
    let (passes, note) = verdict(&groove, &steep, None);
    assert!(!passes && note.contains("the ramp in line") && note.contains("goes down by"), "{note}");
}

#[test]
fn roughing_keeps_the_allowance_and_finishing_goes_to_full_depth() {
    let sets = ["cut.depth=8mm", "cut.depth_per_pass=4mm", "cut.allowance=0.3mm", "cut.finish_passes=2"];
    for (name, cutter) in [("feeder", Some(4e-3)), ("feeder", None), ("groove", Some(10e-3)), ("conjugate", Some(6e-3))]
    {
        let cam = cam(name, &sets);
        for controller in ALL {
            if controller == Controller::Grbl && cutter.is_none() {
                continue;
            }
            let text = program(&cam, (controller, cutter));
            let found = moves(&text);
            // Two roughing depths and two finishing passes for each flank of the part.
            let flanks = if name == "groove" { 2 } else { 1 };
            let words = if controller == Controller::Fanuc { "ROUGHING" } else { "roughing" };
            assert_eq!(text.matches(words).count(), 2 * flanks, "{name} {controller:?}");
            let of_depth = |depth: f64| {
                let level =
                    |moved: &&CutterMove| moved.is_level() && !moved.is_upright() && moved.kind != MoveKind::Rapid;
                let at: Vec<f64> = found
                    .moves
                    .iter()
                    .filter(level)
                    .filter(|moved| (moved.to[2] + depth).abs() < 1e-6)
                    .map(|moved| (moved.end() - moved.start()).norm())
                    .collect();
                at.iter().sum::<f64>()
            };
            // At the full depth a flank is roughed once and finished twice.
            let share = of_depth(8.0) / of_depth(4.0);
            assert!((2.7..3.3).contains(&share), "{name} {controller:?}: {share}");
        }
    }
    let feeder = cam("feeder", &sets);
    let text = program(&feeder, (Controller::LinuxCnc, Some(4e-3)));
    // Without its finishing passes the cam keeps its stock.
    let rough = text.split("(profile)\n").next().expect("a head").to_owned() + "M9\nM5\nG53 G0 Z0.0\nM30\n";
    let (passes, note) = verdict(&feeder, &rough, Some(4e-3));
    assert!(!passes && note.contains("0 mm deep"), "{note}");
    // Finishing at once is too deep for a design that roughs.
    let head = text.find("(profile, roughing)").expect("a roughing pass");
    let finish = text.find("(profile)\n").expect("a finishing pass");
    let (passes, note) = verdict(&feeder, &format!("{}{}", &text[..head], &text[finish..]), Some(4e-3));
    assert!(!passes, "{note}");
}

#[test]
fn chords_keep_the_tolerance_and_no_arc_is_written() {
    for (name, cutter) in [("feeder", Some(4e-3)), ("groove", None), ("groove", Some(6e-3)), ("conjugate", Some(6e-3))]
    {
        let cam = cam(name, &["cut.depth=8mm", "cut.arcs=false"]);
        for controller in ALL {
            let found = moves(&program(&cam, (controller, cutter)));
            assert!(
                !found.moves.iter().any(|moved| matches!(moved.kind, MoveKind::Arc { .. })),
                "{name} {controller:?}"
            );
        }
    }
}

#[test]
fn grbl_and_mach3_have_their_own_words() {
    let cam = cam("feeder", &["cut.depth=8mm", "cut.tool=3", "cut.spindle=2000", "cut.coolant=flood"]);
    let grbl = program(&cam, (Controller::Grbl, Some(4e-3)));
    for word in ["M6", "G43", "G41", "%", "M0\n", "G64"] {
        assert!(!grbl.lines().any(|line| !line.starts_with('(') && line.contains(word.trim())), "{word}: {grbl}");
    }
    for words in ["(control: grbl)", "\nG92.1\n", "\nG53 G0 Z-1.0\n", "\nG54\n", "S2000 M3\nM8\n", "load the tool"] {
        assert!(grbl.contains(words), "{words}: {grbl}");
    }
    assert!(grbl.lines().all(|line| line.len() < 80));
    for (line, why) in
        [("G43 H3", "no G43"), ("T3 M6", "no tool change"), ("G41 D1", "no G41"), ("G64 P0.01", "no G64")]
    {
        let (passes, found) = verdict(&cam, &grbl.replacen("G54\n", &format!("G54\n{line}\n"), 1), Some(4e-3));
        assert!(!passes && found.contains(why), "{line}: {found}");
    }
    let mach3 = program(&cam, (Controller::Mach3, Some(4e-3)));
    for words in ["(control: mach3)", "G91.1 ", "\nG61\n", "T3 M6\n", "G0 G43 H3 Z50.0\n"] {
        assert!(mach3.contains(words), "{words}: {mach3}");
    }
    for (from, to, why) in [
        ("G61", "G64", "without a bound"),
        ("G91.1 ", "", "write G91.1"),
        ("G43 H3 ", "", "write G43"),
        ("G54\n", "", "write G54"),
    ] {
        let (passes, found) = verdict(&cam, &mach3.replacen(from, to, 1), Some(4e-3));
        assert!(!passes && found.contains(why), "{from}: {found}");
    }
}

#[test]
fn a_setup_sheet_is_written_with_each_program() {
    for name in ["feeder", "conjugate"] {
        let sets = ["cut.depth=8mm", "cut.depth_per_pass=4mm", "cut.allowance=0.2mm", "cut.tool=3", "cut.spindle=2000"];
        let request = request(Controller::LinuxCnc, Some(3e-3));
        let proven = cam(name, &sets).draw(request).expect("drawn").prove().expect("proved");
        let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(&["gcode"]) };
        let set = proven.files(&writing).expect("files");
        let sheet = String::from_utf8(set.bytes("-setup.svg").expect("a sheet").to_vec()).expect("text");
        for words in
            ["setup sheet", "X0 Y0 Z0 on the upper face", "profile, roughing", "beside the blank", "T3", "clamp inside"]
        {
            assert!(sheet.contains(words), "{name}: {words}");
        }
    }
}

#[test]
fn impossible_keys_are_refused_with_their_remedy() {
    use Controller::{Grbl, LinuxCnc};
    let machine = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Machine::load("feeder", &sets).expect_err("refused").to_string()
    };
    let low = machine(&["cut.safe_height=1mm"]);
    assert!(low.contains("cut.safe_height of 1 mm is below cut.clearance of 5 mm"), "{low}");
    let kept = machine(&["cut.controller=grbl", "cut.compensation=control"]);
    assert!(kept.contains("grbl has no compensation"), "{kept}");
    assert!(machine(&["cut.finish_passes=1.5"]).contains("whole number"));
    for (name, sets, asked, why) in [
        ("groove", &["cut.allowance=30mm"][..], (LinuxCnc, Some(5e-3)), "no room for it"),
        ("groove", &["cut.allowance=0.1mm"], (LinuxCnc, None), "at most 0 mm"),
        ("feeder", &["cut.compensation=control"], (Grbl, None), "grbl has no compensation"),
        ("feeder", &[], (Grbl, None), "give --cutter-diameter"),
        ("feeder", &["cut.arcs=false"], (LinuxCnc, None), "cut.arcs = false"),
        ("barrel", &[], (Grbl, None), "needs a rotary axis"),
        ("feeder", &["cut.form=polar"], (Grbl, Some(0.03)), "needs a rotary axis"),
        ("barrel", &["cut.allowance=0.2mm"], (LinuxCnc, None), "leave cut.allowance out"),
        ("feeder", &["cut.form=polar", "cut.finish_passes=2"], (LinuxCnc, Some(0.03)), "leave cut.finish_passes out"),
    ] {
        let found = refused(name, sets, asked);
        assert!(found.contains(why), "{name} {sets:?}: {found}");
    }
    let fine = Request { fit: camgen::Fit::from(1e-8), ..request(LinuxCnc, Some(4e-3)) };
    let sets = ["cut.arcs=false", "cut.decimals=6", "cut.depth_per_pass=0.02mm"];
    let many = cam("feeder", &sets).draw(fine).expect_err("too many blocks").to_string();
    assert!(many.contains("blocks, more than") && many.contains("cut.arcs = true"), "{many}");
}
