//! Hub, timing mark, chamfers and joint of `[cam]`: in the solid, in mass and drawing, proved when the solid comes back, and refused where they cannot be made.

use crate::common::program::{Run, camgen_in, close, files, make, number, report};
use std::f64::consts::PI;
use std::fs;

const DISC: &str = r#"name = "disc with features"
[motion]
start = "0 mm"
[[motion.segment]]
law = "3-4-5"
over = "150 deg"
to = "12 mm"
[[motion.segment]]
law = "3-4-5"
over = "210 deg"
to = "0 mm"
[follower.roller]
radius = "10 mm"
[cam]
base_radius = "45 mm"
thickness = "12 mm"
bore_radius = "10 mm"
material = "steel"
"#;
const HUB: &str = "[cam.hub]\ndiameter = \"50 mm\"\nlength = \"18 mm\"\n";
const TIMING_HOLE: &str = "[cam.timing_mark]\nangle = \"75 deg\"\ncircle_diameter = \"70 mm\"\nfit = \"H7\"\n";

fn run(features: &str, args: &[&str]) -> Run {
    make(&format!("{DISC}{features}"), &[&["--json"], args].concat())
}

fn written(made: &Run, ending: &str) -> String {
    let directory = made.directory.path().join("output");
    let mut names = files(&directory).into_iter().filter(|name| name.ends_with(ending) && !name.contains("review"));
    fs::read_to_string(directory.join(names.next().expect("the file"))).expect("a text")
}

/// The mass grows by that of the cylinder less the bore; the file is the same disc.
#[test]
fn a_hub_is_weighed_and_drawn() {
    for (side, lengths) in [("back", 1.0), ("front", 1.0), ("both", 2.0)] {
        let set = format!("cam.hub.side={side}");
        let (bare, made) = (run("", &["--format", "dxf"]), run(HUB, &["--format", "dxf,step,svg", "--set", &set]));
        assert_eq!((bare.code, made.code), (0, 0), "{side}: {}{}", made.out, made.err);
        let heavier = number(&report(&made)["cam"]["mass_kg"]) - number(&report(&bare)["cam"]["mass_kg"]);
        close(heavier, 7850.0e-9 * PI * (625.0 - 100.0) * 18.0 * lengths, 1e-9);
        let contours = |made: &Run| written(made, ".dxf").lines().skip(4).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(contours(&bare), contours(&made), "{side}: a hub is turned, not cut from the plate");
        let drawing = written(&made, ".svg");
        assert!(drawing.contains("Ø50 ±0.3 *") && drawing.contains("id=\"hub\""), "{side}");
        let total = format!("{} ±0.1 *", 12.0 + 18.0 * lengths);
        assert!(drawing.contains(&total), "{side}: {total}");
    }
}

/// The solid that comes back is the cam with its hub; a solid with another hub, or without one, is not.
#[test]
fn a_hub_is_proved_in_the_solid() {
    for side in ["back", "front", "both"] {
        let set = format!("cam.hub.side={side}");
        let made = run(HUB, &["--format", "step", "--set", &set, "--name", "part"]);
        assert_eq!(made.code, 0, "{}", made.err);
        let mut directory = made.directory;
        let check = |directory, sets: &[&str]| {
            let given = [&["check", "output/part.step", "--design", "cam.toml", "--json", "--set", &set][..], sets];
            camgen_in(directory, &given.concat())
        };
        for (sets, code) in [
            (&[][..], 0),
            (&["--set", "cam.hub.length=18.02 mm"][..], 1),
            (&["--set", "cam.hub.diameter=50.02 mm"][..], 1),
        ] {
            let checked = check(directory, sets);
            assert_eq!(checked.code, code, "{side} {sets:?}: {}{}", checked.out, checked.err);
            let found = report(&checked);
            let hub = found["checks"].as_array().expect("checks").iter().find(|check| check["check"] == "hub");
            let verdict = &hub.expect("the check of the hub")["verdict"];
            assert_eq!(verdict, if code == 0 { "pass" } else { "fail" }, "{side} {sets:?}");
            directory = checked.directory;
        }
        fs::write(directory.path().join("cam.toml"), DISC).expect("written");
        let bare = camgen_in(directory, &["check", "output/part.step", "--design", "cam.toml", "--json"]);
        assert_eq!(bare.code, 1, "{side}: a hub that the design has not: {}", bare.out);
    }
}

#[test]
fn a_timing_hole_is_a_hole_with_a_class() {
    let mark = run(TIMING_HOLE, &["--format", "dxf,svg"]);
    let hole = run(
        "[[cam.holes]]\ndiameter = \"6 mm\"\ncircle_diameter = \"70 mm\"\nangle = \"75 deg\"\nfit = \"H7\"\npurpose = \"timing\"\n",
        &["--format", "dxf"],
    );
    assert_eq!((mark.code, hole.code), (0, 0), "{}{}", mark.err, hole.err);
    let contours = |made: &Run| written(made, ".dxf").lines().skip(4).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(contours(&mark), contours(&hole));
    let drawing = written(&mark, ".svg");
    assert!(drawing.contains("Ø6 H7 +0.012/0 through, timing, circle Ø70, ψ 75° (TED)"), "{drawing}");
}

#[test]
fn a_line_a_chamfer_and_a_joint_are_drawn_and_not_cut() {
    let features = "[cam.timing_mark]\nform = \"line\"\nangle = \"30 deg\"\ncircle_diameter = \"60 mm\"\n";
    let bare = run("", &["--format", "dxf"]);
    let made = run(features, &["--format", "dxf,svg", "--set", "cam.chamfer=1 mm", "--set", "cam.split=100 deg"]);
    assert_eq!(made.code, 0, "{}", made.err);
    let contours = |made: &Run| written(made, ".dxf").lines().skip(4).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(contours(&bare), contours(&made));
    let drawing = written(&made, ".svg");
    for words in ["timing mark, engraved on this face, ψ 30°", "2 × 1 × 45°", "joint of the two halves, ψ 100°"]
    {
        assert!(drawing.contains(words), "{words}");
    }
}

/// A notch of 90° and 2 mm in the rim of a groove's blank: its apex lies at R − 2.
#[test]
fn a_notch_is_cut_into_the_blank() {
    let directory = tempfile::tempdir().expect("a directory");
    let sets = ["--set", "cam.timing_mark.form=notch", "--set", "cam.timing_mark.angle=90 deg", "--name", "part"];
    let made = camgen_in(directory, &[&["make", "groove", "--json", "--format", "dxf,step"][..], &sets].concat());
    assert_eq!(made.code, 0, "{}{}", made.out, made.err);
    let found = report(&made);
    let blank = number(&found["groove"]["blank_radius_mm"]);
    let dxf = fs::read_to_string(made.directory.path().join("output/part.dxf")).expect("the file");
    let lines: Vec<&str> = dxf.lines().map(str::trim).collect();
    let apex = lines.windows(4).any(|four| {
        let value = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        four[0] == "10" && value(four[1]).abs() < 1e-9 && (value(four[3]) - (blank - 2.0)).abs() < 1e-9
    });
    assert!(apex, "the apex at (0, {})", blank - 2.0);
    let mut directory = made.directory;
    for file in ["output/part.dxf", "output/part.step"] {
        let checked = camgen_in(directory, &[&["check", file, "--design", "groove"][..], &sets[..4]].concat());
        assert_eq!(checked.code, 0, "{file}: {}{}", checked.out, checked.err);
        directory = checked.directory;
    }
}

#[test]
fn features_that_cannot_be_made_are_refused() {
    let joint = "cam.split: the joint runs through";
    for (features, sets, words) in [
        (HUB, &["cam.hub.diameter=18 mm"][..], "is not wider than the bore with its keyway, Ø20 mm"),
        (HUB, &["cam.hub.diameter=92 mm"], "reaches the profile"),
        (HUB, &["cam.balance=20 mm .. 40 mm"], "begins within the hub"),
        (TIMING_HOLE, &["cam.timing_mark.circle_diameter=100 mm"], "overlaps the profile by"),
        (TIMING_HOLE, &["cam.timing_mark.circle_diameter=24 mm"], "overlaps the bore with its keyway by"),
        (TIMING_HOLE, &["cam.timing_mark.form=notch"], "the rim of this cam is its profile"),
        (TIMING_HOLE, &["cam.split=75 deg"], joint),
        ("", &["cam.split=0 deg", "cam.keyway=auto"], joint),
        ("[cam.timing_mark]\nform = \"line\"\n", &[], "needs the circle on which it lies"),
        ("[cam.timing_mark]\nform = \"line\"\ncircle_diameter = \"88 mm\"\n", &[], "does not lie on the front face"),
        (
            "[[cam.holes]]\ndiameter = \"4 mm\"\ncircle_diameter = \"50 mm\"\n[cam.hub]\ndiameter = \"50 mm\"\nlength = \"9 mm\"\n",
            &[],
            "overlaps the rim of the hub by 2 mm",
        ),
    ] {
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", *set]).collect();
        let made = run(features, &sets);
        assert_eq!(made.code, 2, "{features}{sets:?}: {}{}", made.out, made.err);
        assert!(made.err.contains(words), "{features}{sets:?}: {}", made.err);
        assert_eq!(files(made.directory.path()), ["cam.toml"], "{sets:?}");
    }
    // A hub in front of a groove must not hide it; holes lie in the land of a groove; a barrel has neither.
    for (design, set, words) in [
        ("groove", "cam.hub={diameter=\"130 mm\", length=\"9 mm\", side=\"front\"}", "reaches the profile"),
        ("barrel", "cam.hub={diameter=\"60 mm\", length=\"9 mm\"}", "camgen does not make cam.hub in a barrel cam"),
        ("conjugate", "cam.hub={diameter=\"40 mm\", length=\"9 mm\"}", "lie on each other"),
    ] {
        let sets: Vec<String> = set
            .trim_start_matches("cam.hub={")
            .trim_end_matches('}')
            .split(", ")
            .map(|pair| format!("cam.hub.{}", pair.replace('"', "")))
            .collect();
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", set.as_str()]).collect();
        let directory = tempfile::tempdir().expect("a directory");
        let made = camgen_in(directory, &[&["make", design, "--dry-run"][..], &sets].concat());
        assert_eq!(made.code, 2, "{design}: {}{}", made.out, made.err);
        assert!(made.err.contains(words), "{design}: {}", made.err);
    }
}

/// Holes on both lands of a groove: within its inner flank and outside its outer one.
#[test]
fn holes_lie_on_both_lands_of_a_groove() {
    let text = fs::read_to_string("profiles/groove.toml").expect("the design");
    let hole = |circle: &str, angle: &str| {
        format!("[[cam.holes]]\ndiameter = \"6 mm\"\ncircle_diameter = \"{circle}\"\nangle = \"{angle}\"\n")
    };
    for (circle, angle) in [("70 mm", "90 deg"), ("210 mm", "300 deg")] {
        let made = make(&format!("{text}\n{}", hole(circle, angle)), &["--json", "--format", "dxf,step"]);
        assert_eq!(made.code, 0, "{circle}: {}{}", made.out, made.err);
    }
    let made = make(&format!("{text}\n{}", hole("140 mm", "0 deg")), &["--json"]);
    assert_eq!(made.code, 2, "{}", made.out);
    assert!(made.err.contains("does not lie in the metal") || made.err.contains("overlaps the groove"), "{}", made.err);
}
