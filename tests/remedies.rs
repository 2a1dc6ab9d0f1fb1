//! What a refusal says would pass does pass, and `base_radius = "auto"` keeps every limit that depends on the radius.

#![allow(clippy::expect_used, clippy::panic, missing_docs, reason = "a test fails loudly")]

use camgen::machine::Machine;
use camgen::pipeline::Spec;
use camgen::report::{Finding, Verdict};

/// Numbers in [0, 1) that repeat (Knuth's MMIX generator).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let high = u32::try_from(self.0 >> 32).expect("32 bits");
        f64::from(high) / 4_294_967_296.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn one_of<'a>(&mut self, words: &[&'a str]) -> &'a str {
        let share = self.next();
        let count = u32::try_from(words.len()).expect("few");
        let at = (0..count).find(|i| share * f64::from(count) < f64::from(i + 1)).unwrap_or(0);
        words[at as usize]
    }
}

/// The findings on a rotary cam; `None` where there is no such cam.
fn findings(overrides: &[String]) -> Option<Vec<Finding>> {
    let machine = Machine::load("dpi", overrides).ok()?.0;
    let cam = Spec::rotary(machine, 35.0).solve().ok()?;
    let proven = cam.draw(5e-5).ok()?.prove().ok()?;
    Some(proven.findings().to_vec())
}

fn owned(overrides: &[&str]) -> Vec<String> {
    overrides.iter().map(|&text| text.to_owned()).collect()
}

/// The overrides that a note promises to pass with.
fn remedies(note: &str) -> Vec<String> {
    let base = note.split("a base radius of ").nth(1).and_then(|rest| rest.split(" would pass").next());
    let key = note.split("; ").find(|part| part.contains(" = \"")).map(|part| {
        let (key, rest) = part.split_once(" = \"").expect("an equation");
        format!("{key}={}", rest.split('"').next().unwrap_or_default())
    });
    base.map(|base| format!("cam.base_radius={base}"))
        .into_iter()
        .chain(key)
        .filter(|text| !text.contains("kind"))
        .collect()
}

fn refusal(random: &mut Random) -> Vec<String> {
    vec![
        format!("buffer.column={}", random.one_of(&["matched", "return", "200mm", "300mm"])),
        format!("transition.kind={}", random.one_of(&["none", "run-up", "run-up", "blend"])),
        format!("transition.width={}deg", random.between(5.0, 60.0)),
        format!("cam.base_radius={}mm", random.between(26.0, 120.0)),
        format!("cam.lever={}", random.between(0.2, 1.5)),
        format!("follower.roller.radius={}mm", random.between(5.0, 60.0)),
        format!("follower.roller.offset={}mm", random.between(-15.0, 15.0)),
        format!("cam.cam_turns_per_crank_turn={}", random.one_of(&["1", "1", "1", "0.5"])),
        format!("limits.pressure_angle={}deg", random.between(20.0, 50.0)),
        format!("limits.cutter_radius={}mm", random.between(5.0, 500.0)),
        format!("limits.contact_stress={}MPa", random.between(500.0, 3000.0)),
        format!("limits.wall={}mm", random.between(0.0, 30.0)),
        format!("follower.roller.mass={}kg", random.between(1.0, 60.0)),
        format!("follower.roller.preload={}N", random.between(0.0, 2000.0)),
    ]
}

/// Tries refusals until so many remedies were applied; returns how many refusals there were.
fn apply(seed: u64, wanted: usize) -> usize {
    let mut random = Random(seed);
    let (mut refusals, mut applied) = (0, 0);
    while applied < wanted {
        let overrides = refusal(&mut random);
        let Some(found) = findings(&overrides) else { continue };
        let failed: Vec<&Finding> = found.iter().filter(|finding| finding.verdict == Verdict::Fail).collect();
        refusals += usize::from(!failed.is_empty());
        for finding in failed {
            for remedy in remedies(finding.note.as_deref().unwrap_or_default()) {
                let with: Vec<String> = overrides.iter().cloned().chain([remedy.clone()]).collect();
                let after = findings(&with).unwrap_or_else(|| panic!("no cam with {remedy}: {overrides:?}"));
                let same = after.iter().find(|other| other.check == finding.check).expect("the same check");
                assert_ne!(same.verdict, Verdict::Fail, "{remedy} for {finding:?} gives {same:?}: {overrides:?}");
                applied += 1;
            }
        }
    }
    refusals
}

#[test]
fn what_a_refusal_says_passes() {
    // The long run: REMEDIES=2000 cargo test --release --test remedies -- --nocapture.
    let count = std::env::var("REMEDIES").map_or(120, |count| count.parse().expect("a number of remedies"));
    let refusals = apply(13, count);
    println!("{count} remedies of {refusals} refusals work");
}

/// A corner of the motion stays a corner on any cam.
#[test]
fn no_radius_is_promised_where_none_passes() {
    for base in ["auto", "40mm", "82mm"] {
        let base = format!("cam.base_radius={base}");
        let found = findings(&owned(&["buffer.column=200mm", "transition.kind=none", &base])).expect("a cam");
        let failed = found.iter().find(|finding| finding.check == "undercut").expect("the check");
        let note = failed.note.as_deref().expect("a note");
        assert!(failed.verdict == Verdict::Fail && note.contains("no base radius would pass"), "{note}");
        assert!(found.iter().all(|f| !f.note.as_deref().unwrap_or_default().contains("mm would pass")), "{found:?}");
    }
}

/// A velocity that grows at once leaves a place as hollow as the roller on any cam, though on a large one it is too small to be seen;
/// one of 135 mm was promised.
#[test]
fn no_radius_is_promised_where_a_corner_is_only_too_small_to_be_seen() {
    let text = r#"name = "a corner"
[motion]
rpm = 60
start = "-16.6559 deg"
at = "7.692597632670461 deg"
[[motion.segment]]
law = "line"
velocity = "117.17189922738055 deg/s"
to = "12.918095050202488 deg"
[[motion.segment]]
law = "modified-trapezoid"
over = "2.13001 rad"
to = "-0.158 rad"
[[motion.segment]]
law = "modified-sine-cv66"
over = "1.382 rad"
by = "0.205116301105386 rad"
[[motion.segment]]
law = "cubic"
over = "1.1853096482690058 rad"
to = "-16.6559 deg"
velocity = "0.3254771894126496 rad/rad"
[follower.swinging-roller]
radius = "15.4108 mm"
arm = "147.6 mm"
pivot_distance = "85.1 mm"
side = "trailing"
[cam]
base_radius = "60 mm"
bore_radius = "19.5 mm"
[limits]
pressure_angle = "75 deg"
min_convex_pitch_radius_over_roller = 0.5
cutter_radius = "33.8 mm"
"#;
    let machine = Machine::from_toml("corner.toml", text, &[]).expect("valid");
    let (motion, rpm) = machine.motion().expect("a motion");
    let cam = Spec::of_motion(machine.clone(), motion, rpm).solve().expect("a cam");
    let drawing = cam.draw(5e-6).expect("a drawing");
    let proven = drawing.prove().expect("proven");
    let found = proven.findings().iter().find(|finding| finding.check == "cutter_radius").expect("the check");
    assert!(found.verdict == Verdict::Fail && (found.value - 15.4108).abs() < 1e-9, "{found:?}");
    let note = found.note.as_deref().expect("a note");
    assert!(note.contains("no base radius that would pass was found"), "{note}");
}

#[test]
fn an_automatic_radius_keeps_every_limit_that_depends_on_it() {
    for limit in ["limits.cutter_radius=900mm", "limits.contact_stress=1040MPa", "limits.wall=80mm"] {
        let column = owned(&["buffer.column=return", limit]);
        let found = findings(&column).expect("a cam");
        let fails: Vec<&Finding> = found.iter().filter(|finding| finding.verdict == Verdict::Fail).collect();
        assert!(fails.is_empty(), "{limit}: {fails:?}");
    }
    let machine = Machine::load("dpi", &[]).expect("valid").0;
    let cam = camgen::body::disc::Disc::solve(&machine, 35.0).expect("a cam");
    assert_eq!(cam.base_radius(), 0.069, "the default cam stays");
}
