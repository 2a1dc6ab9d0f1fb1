//! Pairs of conjugate discs as `camgen make` cuts them: the values of a reference with forty digits, how the pair closes, and what is refused.

use crate::common::program::{camgen_in, files, make, report};
use camgen::machine::Machine;
use camgen::pipeline::{Assembly, Spec, Writing};
use camgen::report::Verdict;
use serde_json::Value;

const TOLERANCE: f64 = 5e-6;

const TRANSLATING: &str = include_str!("../../profiles/conjugate.toml");
const SWINGING: &str = r#"
name = "lever"
[motion]
rpm = 200
start = "0 deg"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "20 deg"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "3-4-5"
over = "150 deg"
to = "0 deg"
[[motion.segment]]
law = "dwell"
[follower.swinging-roller]
radius = "16 mm"
arm = "110 mm"
pivot_distance = "140 mm"
inertia = "0.02 kg*m2"
[cam]
body = "conjugate"
base_radius = "64 mm"
thickness = "12 mm"
[cam.counter]
radius = "14 mm"
arm = "100 mm"
included_angle = "85 deg"
"#;

fn pair(text: &str, sets: &[&str]) -> Assembly {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let machine = Machine::from_toml("pair.toml", text, &sets).unwrap_or_else(|error| panic!("{error}"));
    Spec::of_program(machine, None).expect("a motion").assemble().unwrap_or_else(|error| panic!("{error}"))
}

/// Columns of the table of the counter disc at its own cam angles in whole degrees, with what they should be.
fn has(pair: &Assembly, degrees: usize, values: &[(&str, f64)]) {
    let (_, counter) = &pair.others()[0];
    let table = counter.draw(TOLERANCE).expect("drawn").prove().expect("proved").table(360);
    for (name, expected) in values {
        let column = table.columns.iter().position(|column| column == name).unwrap_or_else(|| panic!("{name}"));
        let found = table.rows[degrees][column];
        assert!((found - expected).abs() < 1e-11 * (1.0 + expected.abs()), "{name}: {found} {expected}");
    }
}

/// The points of mpmath with forty digits, by differentiating one point of the motion.
#[test]
fn counter_discs_are_those_of_the_reference() {
    let straight = pair(TRANSLATING, &[]);
    let prime = |pair: &Assembly| {
        let curves = camgen::body::curves(pair.others()[0].1.body()).expect("plane");
        1e3 * curves.follower.prime_radius().expect("a disc")
    };
    assert!((prime(&straight) - 81.919_914_675_980_95).abs() < 1e-12);
    let values = [
        ("pitch_x_mm", -73.708_261_888_830_09),
        ("pitch_y_mm", -69.173_399_987_563_2),
        ("profile_x_mm", -63.866_362_379_202_69),
        ("profile_y_mm", -54.102_334_529_461_17),
        ("pressure_angle_deg", -6.854_147_376_213_141),
        ("pitch_curvature_radius_mm", 87.494_057_512_021),
    ];
    has(&straight, 230, &values);
    let lever = pair(SWINGING, &[]);
    assert!((prime(&lever) - 73.533_701_240_951_46).abs() < 1e-11);
    let values = [
        ("pitch_x_mm", -41.455_480_939_896_47),
        ("pitch_y_mm", 72.267_396_694_691_69),
        ("profile_x_mm", -31.041_250_912_894_21),
        ("profile_y_mm", 62.910_911_620_440_54),
        ("pressure_angle_deg", -9.040_184_549_860_656),
        ("pitch_curvature_radius_mm", 103.831_356_361_549_9),
    ];
    has(&lever, 75, &values);
}

#[test]
fn a_pair_closes_within_both_tolerances_as_it_is_written() {
    for (text, sets) in [(TRANSLATING, vec![]), (TRANSLATING, vec!["cam.rotation=ccw"]), (SWINGING, vec![])] {
        for side in [camgen::Side::Both, camgen::Side::Inside] {
            let fit = camgen::Fit { side, ..camgen::Fit::from(TOLERANCE) };
            let proven = pair(text, &sets).draw(camgen::Request::within(fit)).expect("drawn").prove().expect("proved");
            assert!(proven.passed(), "{sets:?} {:#?}", proven.findings());
            let found = proven.findings().iter().find(|found| found.check == "closure").expect("checked");
            assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
            let section = proven.report().section("conjugate").cloned().expect("a section");
            let [pinch, play] = ["pinch_mm", "play_mm"].map(|key| section["closure"][key].as_f64().expect("a number"));
            // Each lift is off by as much as its own rolling shows.
            let rolled =
                |cam: &camgen::Proven| cam.rolled().and_then(|rolled| rolled.lift_error_max_mm).expect("rolled");
            let both = rolled(proven.first()) + 1.1 * rolled(&proven.others()[0].1);
            assert!(pinch <= both && -play <= both && pinch - play > 1e-4, "{pinch} {play} {both}");
            assert!(side == camgen::Side::Both || pinch < 1e-6, "{pinch}");
        }
    }
}

/// A counter disc that belongs to another distance of the rollers does not close with the main one.
#[test]
fn a_wrong_counter_disc_does_not_close() {
    use camgen::body::closure::{Closure, Pairing};
    let (right, wrong) = (pair(TRANSLATING, &[]), pair(TRANSLATING, &["cam.counter.distance=180.02 mm"]));
    let proven = |pair: &Assembly| pair.draw(TOLERANCE).expect("drawn").prove().expect("proved");
    let (right, wrong) = (proven(&right), proven(&wrong));
    let outline = |cam: &camgen::Proven| cam.outlines()[0].contour.clone();
    let (main, counter) = (right.first(), &right.others()[0].1);
    let of = |written| {
        let paired = (Pairing::Opposite, 5e-3);
        Closure::of((main.body(), &outline(main)), (counter.body(), &written), paired).expect("touching")
    };
    assert!(Closure::measure(Some(&of(outline(counter))), main.body()).finding().verdict == Verdict::Pass);
    let found = Closure::measure(Some(&of(outline(&wrong.others()[0].1))), main.body()).finding();
    assert!(found.verdict == Verdict::Fail && (found.value - 0.02).abs() < 0.012, "{found:?}");
}

/// Without a spring the force goes from one disc to the other; a preload loads both.
#[test]
fn a_preload_loads_both_discs() {
    let stress = |sets: &[&str]| {
        let pair = pair(TRANSLATING, sets);
        let of = |cam: &camgen::Cam| {
            let proven = cam.draw(TOLERANCE).expect("drawn").prove().expect("proved");
            proven
                .findings()
                .iter()
                .find(|found| found.check == "contact_stress")
                .map(|found| found.value)
                .expect("a stress")
        };
        [of(pair.first()), of(&pair.others()[0].1)]
    };
    let (without, with) = (stress(&["cam.counter.preload=0 N"]), stress(&["cam.counter.preload=400 N"]));
    assert!(without.iter().zip(with).all(|(without, with)| *without > 0.0 && with > *without), "{without:?} {with:?}");
}

#[test]
fn a_pair_is_two_sets_of_files_and_one_solid_of_both() {
    let pair = pair(TRANSLATING, &[]).draw(TOLERANCE).expect("drawn").prove().expect("proved");
    let set = pair.files(&Writing::to("out", "cam").formats(&["dxf", "step"])).expect("files");
    let names: Vec<&str> = set.outputs().iter().map(|output| &*output.name).collect();
    let expected = ["cam-main.dxf", "cam-main.step", "cam-counter.dxf", "cam-counter.step", "cam-pair.step"];
    assert_eq!(names, expected);
    let listed: Vec<String> =
        set.report().files.iter().map(|file| file.rsplit('/').next().unwrap_or("").to_owned()).collect();
    assert_eq!(listed, expected);
    let text = String::from_utf8(set.bytes("-pair.step").expect("a file").to_vec()).expect("ASCII");
    assert_eq!(text.matches("MANIFOLD_SOLID_BREP").count(), 2);
    assert_eq!(text.matches("NEXT_ASSEMBLY_USAGE_OCCURRENCE").count(), 2);
    for name in ["main'", "counter'"] {
        assert!(text.lines().any(|line| line.contains(" = PRODUCT('") && line.contains(name)), "{name}");
    }
    let mut numbers: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix('#')?.split(' ').next()).collect();
    let all = numbers.len();
    numbers.sort_unstable();
    numbers.dedup();
    assert_eq!(numbers.len(), all, "a number occurs twice");
    // One keyway for both discs.
    let keyway = |name: &str| {
        let reading = camgen::reading::read(set.bytes(name).expect("a file"), 1e-9).expect("read");
        reading.others.iter().map(|chain| chain.contour().extents()).next().expect("a bore")
    };
    assert_eq!(keyway("-main.dxf"), keyway("-counter.dxf"));
}

#[test]
fn what_makes_no_pair_is_refused_with_the_reason() {
    let machine = |text: &str, sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Machine::from_toml("pair.toml", text, &sets)
    };
    let error = |text: &str, sets: &[&str]| machine(text, sets).expect_err("a fault").to_string();
    let arm = error(TRANSLATING, &["cam.counter.arm=100mm"]);
    assert!(arm.contains("straight path") && arm.contains("arm"), "{arm}");
    assert!(error(SWINGING, &["cam.counter.distance=100mm"]).contains("swings on an arm"));
    for (text, set, key) in [
        (TRANSLATING, "cam.counter.distance=98mm", "cam.counter.distance"),
        (TRANSLATING, "cam.counter.distance=101mm", "cam.counter.distance"),
        (SWINGING, "cam.counter.included_angle=50deg", "cam.counter.included_angle"),
    ] {
        let machine = machine(text, &[set]).expect("in range");
        let refused =
            Spec::of_program(machine, None).expect("a motion").assemble().expect_err("no counter").to_string();
        // The named change passes.
        let (_, rest) = refused.split_once(&format!("{key} = \"")).unwrap_or_else(|| panic!("{set}: {refused}"));
        let (value, _) = rest.split_once('"').expect("a value");
        pair(text, &[&format!("{key}={value}")]);
    }
}

/// A pair whose counter disc folds on the smallest main disc.
const FOLDS: &str = include_str!("conjugate/folds.toml");

/// `make` and `size` consider both discs; every change named for a counter disc passes.
#[test]
fn auto_and_size_consider_both_discs() {
    let base = |report: &Value, section: &str| report[section]["base_radius_mm"].as_f64();
    let made = make(FOLDS, &["--dry-run", "--json"]);
    assert_eq!((base(&report(&made), "cam"), made.code), (Some(15.0), 0), "{}{}", made.out, made.err);
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("cam.toml"), FOLDS).expect("written");
    let sized = report(&camgen_in(directory, &["size", "cam.toml", "--json", "--dry-run"]));
    assert_eq!(base(&sized, "size"), Some(15.0), "{sized}");
    for sets in [vec!["cam.base_radius=9mm"], vec!["cam.base_radius=9mm", "cam.counter.distance=40mm"]] {
        let with = |more: &[String]| {
            let all = sets.iter().map(|set| (*set).to_owned()).chain(more.iter().cloned());
            let words: Vec<String> = all.flat_map(|set| ["--set".to_owned(), set]).collect();
            let words: Vec<&str> = ["--dry-run"].into_iter().chain(words.iter().map(String::as_str)).collect();
            make(FOLDS, &words)
        };
        let failed = with(&[]);
        let said = failed.out.clone() + &failed.err;
        let changes: Vec<String> = if let Some((_, rest)) = said.split_once("a base radius of ") {
            vec![format!("cam.base_radius={}", rest.split_once(" would").expect("a size").0)]
        } else {
            let (_, rest) = said.split_once("cam.counter.distance = \"").unwrap_or_else(|| panic!("{said}"));
            vec![format!("cam.counter.distance={}", rest.split_once('"').expect("a value").0)]
        };
        let done = with(&changes);
        assert_eq!((failed.code, done.code), (1, 0), "{sets:?} {changes:?}: {}{}", done.out, done.err);
    }
}

/// Each file of a run is found as what it is, by the record and by the hash alone.
#[test]
fn the_embedded_pair_is_made_and_each_file_is_found_again() {
    let directory = tempfile::tempdir().expect("a directory");
    let mut run = camgen_in(directory, &["make", "conjugate", "--json", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert_eq!(
        report(&run)["checks"].as_array().map(|checks| checks.iter().any(|check| check["check"] == "closure")),
        Some(true)
    );
    assert_eq!(files(&run.directory.path().join("out")).len(), 12);
    for forgotten in [false, true] {
        if forgotten {
            std::fs::remove_file(run.directory.path().join("out/.camgen.json")).expect("a record");
        }
        for (file, noun) in
            [("main.dxf", "conjugate cam"), ("counter.dxf", "counter cam"), ("counter.step", "counter cam")]
        {
            let path = format!("out/conjugate-make-240rpm-{file}");
            run = camgen_in(run.directory, &["check", &path]);
            assert!(run.code == 0 && run.out.contains(noun), "{file} {forgotten}: {}{}", run.out, run.err);
        }
    }
}

/// Both discs have one bore and keyway: a file whose name gives the other disc would be cut twice without notice. A disc that fails under any
/// other name is compared with the disc that it comes nearest to.
#[test]
fn a_disc_under_the_name_of_the_other_is_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let run = camgen_in(directory, &["make", "conjugate", "--name", "p", "--format", "dxf", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let out = run.directory.path().join("out");
    let text = |name: &str| std::fs::read_to_string(out.join(name)).expect("a file");
    let (main, counter) = (text("p-main.dxf"), text("p-counter.dxf"));
    for (name, bytes) in [
        ("p-main", &counter),
        ("p-counter", &main),
        ("right", &counter),
        ("counterweight", &counter),
        ("coarse", &counter),
    ] {
        std::fs::write(out.join(format!("{name}.dxf")), bytes).expect("written");
    }
    let mut run = run;
    for (file, code, says) in [
        ("p-main", 1, "It is the counter disc of this pair: the name of the file says main"),
        ("p-counter", 1, "It is the main disc of this pair: the name of the file says counter"),
        ("right", 0, "counter cam"),
        ("counterweight", 0, "counter cam"),
        ("coarse", 1, "counter cam"),
    ] {
        for design in [&[][..], &["--design", "conjugate"]] {
            let path = format!("out/{file}.dxf");
            let finer: &[&str] = if file == "coarse" { &["--tolerance", "2um"] } else { &[] };
            let words: Vec<&str> = ["check", &path].into_iter().chain(design.iter().chain(finer).copied()).collect();
            run = camgen_in(run.directory, &words);
            assert!(run.code == code && run.out.contains(says), "{words:?}: {}{}", run.out, run.err);
        }
    }
}

/// The counter disc moves no follower of its own: the torque of the table and of the sheet is that of the pair, once.
#[test]
fn the_torque_of_a_pair_is_told_once() {
    let directory = tempfile::tempdir().expect("a directory");
    let run = camgen_in(directory, &["make", "conjugate", "--name", "p", "--format", "csv,svg", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let text = |name: &str| std::fs::read_to_string(run.directory.path().join("out").join(name)).expect("a file");
    assert!(!text("p-main.csv").contains("torque_left_nm"));
    let sheet = text("p-main-review.svg");
    assert!(sheet.contains("Torque on the shaft") && !sheet.contains("compensating cam"));
    assert!(sheet.contains("mm apart along the path") && run.out.contains("mm apart along the path"), "{}", run.out);
    assert!(run.out.contains("checks of the counter disc"), "{}", run.out);
}

/// A control keeps one program of a number, and a drive one table of a name.
#[test]
fn programs_and_tables_of_both_discs_have_names_of_their_own() {
    let directory = tempfile::tempdir().expect("a directory");
    let words =
        ["make", "conjugate", "--name", "p", "--format", "gcode,servo-xyva", "--controller", "fanuc", "--out", "out"];
    let run = camgen_in(directory, &words);
    assert_eq!(run.code, 0, "{}", run.err);
    let text = |name: &str| std::fs::read_to_string(run.directory.path().join("out").join(name)).expect("a file");
    assert!(text("p-main.nc").contains("O0001 ") && text("p-counter.nc").contains("O0002 "));
    assert!(text("p-main-xyva.st").contains(" Cam_Conjugate : "));
    assert!(text("p-counter-xyva.st").contains(" Cam_Conjugate_counter : "));
}
