//! The library as a program uses it: a cam of one's own, from a specification put together in code to its files.

use camgen::domains::press::SpecOfPress;
use camgen::machine::Machine;
use camgen::motion::{Jet, Motion, Piece};
use camgen::pipeline::{
    Assembly, Builder, Cam, Drawing, Error, FileSet, Judged, Proven, ProvenAssembly, Spec, Writing,
};
use std::f64::consts::TAU;
use std::fs;

const TOLERANCE: f64 = 5e-6;

/// Twice up and down in a turn, by 8 mm.
#[derive(Debug)]
struct Wave;

impl Motion for Wave {
    fn pieces(&self) -> &[Piece] {
        &[Piece { start: 0.0, end: TAU, dwell: false }]
    }

    fn jet(&self, _: usize, angle: f64) -> Jet {
        let (sin, cos) = (libm::sin(2.0 * angle), libm::cos(2.0 * angle));
        Jet { s: 0.004 * (1.0 - cos), ds: 0.008 * sin, dds: 0.016 * cos, ddds: -0.032 * sin }
    }
}

fn roller() -> Builder {
    Spec::builder("a \"wave\"").roller(0.01).offset(0.002).thickness(0.012).counter_clockwise()
}

#[test]
fn a_motion_of_one_s_own_becomes_files() {
    let cam = roller().bore_radius(0.008).cutter_radius(0.005).motion(Wave).expect("in range").solve().expect("a cam");
    let proven = cam.draw(TOLERANCE).expect("an outline").prove().expect("a proof");
    assert!(proven.passed(), "{:?}", proven.findings());
    let directory = tempfile::tempdir().expect("a directory");
    let out = directory.path().join("new/out");
    let set = proven.files(&Writing::to(&out, "wave")).expect("files");
    assert!(!out.exists(), "nothing is written before it is committed");
    let names: Vec<&str> = set.outputs().iter().map(|output| output.name.as_str()).collect();
    assert_eq!(names, ["wave.dxf", "wave.svg", "wave-review.svg", "wave.step", "wave.csv"]);
    assert_eq!(set.bytes(".dxf"), Some(&proven.cut_files()[0][..]), "what is written is what was proved");
    assert_eq!(set.directory(), out);
    let outputs = set.outputs().to_vec();
    let report = set.commit().expect("written");
    assert_eq!(report.machine, "a \"wave\"");
    assert_eq!(report.files.len(), 5);
    for output in outputs {
        assert!(fs::read(out.join(&output.name)).expect("a file") == output.bytes, "{}", output.name);
    }
    let checked = cam.check(&proven.cut_files()[0], TOLERANCE).expect("a DXF file");
    assert!(checked.passed(), "{checked:?}");
}

/// A pressure angle that no cam of this size keeps: refused by name, made when somebody insists.
#[test]
fn a_cam_that_breaks_a_limit_is_refused_unless_forced() {
    let spec = roller().base_radius(0.012).pressure_angle(0.1).motion(Wave).expect("in range");
    let cam = spec.solve().expect("a cam");
    let proven = cam.draw(TOLERANCE).expect("a drawing").prove().expect("a proof");
    assert!(!proven.passed() && proven.no_outline().is_none(), "{:?}", proven.findings());
    let writing = Writing::to("never", "wave");
    match proven.files(&writing) {
        Err(Error::Refused(checks)) => assert!(checks.contains("pressure_angle"), "{checks}"),
        other => panic!("{other:?}"),
    }
    let forced = proven.files(&Writing { force: true, ..writing }).expect("files");
    assert!(!forced.report().passed() && forced.outputs().len() == 5);
}

#[test]
fn what_cannot_be_is_told_by_its_kind() {
    let faults = roller().set("cam.thicknes", "3 mm").set("cam.material", "steal").machine().expect_err("two faults");
    match &faults {
        Error::Machine(error) => assert_eq!(error.faults.len(), 2, "{error}"),
        other => panic!("{other:?}"),
    }
    let cam = roller().motion(Wave).expect("in range").solve().expect("a cam");
    let drawing = cam.draw(TOLERANCE).expect("an outline");
    let proven = drawing.prove().expect("a proof");
    let asked = |names: &[&str]| proven.files(&Writing::to("never", "wave").formats(names));
    assert!(matches!(asked(&["stl"]), Err(Error::Unfit { format: "stl", .. })), "{:?}", asked(&["stl"]));
    assert!(matches!(asked(&["dwg"]), Err(Error::NoSuchFormat { .. })), "{:?}", asked(&["dwg"]));
    assert!(matches!(cam.draw(1e-16), Err(Error::Draw(_))), "no double keeps a tenth of a femtometre");
    assert!(matches!(cam.check(b"hello", TOLERANCE), Err(Error::Read(_))));
    let in_the_way = tempfile::NamedTempFile::new().expect("a file");
    let set = proven.files(&Writing::to(in_the_way.path(), "wave")).expect("files");
    assert!(matches!(set.commit(), Err(Error::Files(_))));
    let press = Spec::rotary(roller().machine().expect("no press is needed"), 35.0).solve().expect_err("no press");
    assert!(matches!(press, Error::Solve(_)) && press.to_string().contains("describes no press"), "{press}");
}

/// Under a face ρ = R_b + s + s'' = R_b + 4 mm + 12 mm cos 2θ: −3 mm at 90° on a base radius of 5 mm.
#[test]
fn a_profile_that_turns_back_under_a_face_is_told_by_how_much() {
    let face = Spec::builder("face").set("follower.flat.preload", "100 N").base_radius(0.005);
    let cam = face.motion(Wave).expect("in range").solve().expect("a cam");
    let proven = cam.draw(TOLERANCE).expect("a drawing").prove().expect("a proof");
    let undercut = proven.findings().iter().find(|finding| &*finding.check == "undercut").expect("the check");
    // Solved by an exact derivative; the report rounds nothing.
    assert!((undercut.value + 3.0).abs() < 1e-9, "{undercut:?}");
    assert!(!proven.passed());
}

/// Lifts of 300 mm within a few degrees under a face on a disc of 20 mm: the profile folds without a crossing to cut at.
#[test]
fn a_cam_without_outline_is_never_passed() {
    let segments = [
        ("3-4-5", 46, 300),
        ("cubic", 53, -100),
        ("cubic", 105, 300),
        ("cycloidal", 104, 133),
        ("cycloidal", 35, 300),
        ("cubic", 17, 100),
    ];
    let mut toml =
        "name = \"x\"\n[cam]\nbase_radius = \"20 mm\"\n[follower.flat]\n[motion]\nstart = \"100 mm\"\n".to_owned();
    for (law, over, to) in segments {
        toml += &format!("[[motion.segment]]\nlaw = \"{law}\"\nover = \"{over} deg\"\nto = \"{to} mm\"\n");
    }
    let machine = Machine::from_toml("x.toml", &toml, &[]).expect("in range");
    let (motion, rpm) = machine.motion().expect("a program");
    let cam = Spec::of_motion(machine, motion, rpm).solve().expect("a cam");
    let proven = cam.draw(TOLERANCE).expect("a drawing").prove().expect("a proof");
    let why = proven.no_outline().expect("no outline").to_owned();
    assert!(!proven.passed());
    assert!(proven.report().notes.iter().any(|note| note.to_string().contains(&why)), "{:?}", proven.report().notes);
    let forced = proven.files(&Writing { force: true, ..Writing::to("never", "wave") });
    assert!(matches!(forced, Err(Error::NoOutline(_))), "{forced:?}");
}

/// Every step owns what it needs: it outlives the steps before it, and goes on in another thread.
#[test]
fn every_step_is_kept_and_sent_to_another_thread() {
    fn is_sent<T: Send + Sync + 'static>() {}
    is_sent::<Cam>();
    is_sent::<Assembly>();
    is_sent::<Drawing>();
    is_sent::<Proven>();
    is_sent::<ProvenAssembly>();
    is_sent::<FileSet>();
    is_sent::<Judged>();
    let drawn = || -> Drawing {
        roller().base_radius(0.06).motion(Wave).expect("in range").solve().expect("a cam").draw(5e-6).expect("drawn")
    };
    let drawing = drawn();
    let proving = std::thread::spawn(move || drawing.prove().expect("a proof"));
    let made = |proven: Proven| -> FileSet { proven.files(&Writing::to("nowhere", "cam")).expect("files") };
    let files = made(proving.join().expect("no panic"));
    let told = std::thread::spawn(move || (files.report().clone(), files.bytes(".dxf").map(<[u8]>::to_vec)));
    let (report, dxf) = told.join().expect("no panic");
    let here = drawn().prove().expect("a proof");
    assert_eq!(dxf.as_deref(), here.cut_files().first().map(Vec::as_slice));
    let plain = |report: &camgen::Report| serde_json::to_string(&report.checks).expect("JSON");
    assert_eq!(plain(&report), plain(&here.report()));
}

/// The names of the files of two cams that belong together begin alike, and one that fails holds both back.
#[test]
fn cams_of_an_assembly_are_written_together_or_not_at_all() {
    let small = |radius: f64| roller().base_radius(radius).motion(Wave).expect("in range").solve().expect("a cam");
    let together = |radius: f64| {
        let cams = Assembly::from(small(0.06)).with("other", small(radius));
        cams.draw(5e-6).expect("drawn").prove().expect("a proof")
    };
    let writing = Writing::to("nowhere", "cam").formats(&["dxf"]);
    let good = together(0.06).files(&writing).expect("both pass");
    let names: Vec<&str> = good.outputs().iter().map(|output| output.name.as_str()).collect();
    assert_eq!(names, ["cam.dxf", "cam-other.dxf"]);
    let broken = together(0.012);
    assert!(broken.first().passed() && !broken.passed());
    assert!(matches!(broken.files(&writing), Err(Error::Refused(_))));
}
