//! shaft.md, golden number 14, and what a shaft does to any cam.

use super::*;
use crate::press::SpecOfPress;
use crate::press::rotary;
use camgen_cams::body::disc::Disc;
use camgen_cams::machine::Machine;

fn machine(sets: &[&str]) -> ShaftMachine {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    ShaftMachine::load("dpi-shaft", &sets).expect("valid").0
}

fn dpi() -> Disc {
    rotary::disc(&Machine::load("dpi", &[]).expect("valid").0, 35.0).expect("a cam")
}

/// Figures known to eleven digits or more; places of flat tops to half as many.
#[test]
fn the_lift_of_the_press_on_a_shaft_has_the_known_errors() {
    let disc = dpi();
    assert_eq!(disc.prime_radius(), 0.099);
    let known = |yielding: &ShaftCompliance, error: (f64, f64), residual: (f64, f64)| {
        let found = disc.largest_loaded(yielding, error_of);
        assert!((1e3 * found.value / error.0 - 1.0).abs() < 1e-11, "{}", 1e3 * found.value);
        // The mirror of the place is as good.
        let place = found.at.to_degrees().min(180.0 - found.at.to_degrees());
        assert!((place - error.1).abs() < 1e-3, "{place}");
        let found = disc.largest_loaded(yielding, |lowered| lowered.residual.abs());
        assert!((found.value / residual.0 - 1.0).abs() < 1e-9, "{}", found.value);
        let place = found.at.to_degrees().min(180.0 - found.at.to_degrees());
        assert!((place - residual.1).abs() < 1e-3, "{place}");
    };
    known(
        &ShaftCompliance { compliance: 1e-8, twist: 0.0 },
        (0.233_646_436_876_14, 63.5184),
        (86.267_032_177_423, 71.9165),
    );
    // Shaft A with its drive.
    let told = machine(&[]);
    let shaft = &told.data.shaft;
    let statics = Statics::new(shaft, 0.15).expect("a place on it");
    assert!((statics.own_compliance() / 7.173_360_879_693_742e-9 - 1.0).abs() < 1e-11);
    let twist = shaft.twist_compliance(0.0, 0.15);
    assert!((twist / 3.449_726_742_384_2e-6 - 1.0).abs() < 1e-11);
    known(
        &ShaftCompliance { compliance: statics.own_compliance(), twist },
        (0.451_425_296_233_18, 47.5089),
        (143.688_934_088_6, 52.9460),
    );
}

/// To first order the force is that of a rigid shaft: with a thousandth of the compliance the error is a thousandth, but for the
/// square of the travel of the air.
#[test]
fn a_stiff_shaft_takes_the_force_of_a_rigid_one() {
    let disc = dpi();
    for (piece, angle) in [0.3, 0.9, 1.5, 2.2].map(|angle| disc.curves().motion.locate(angle)) {
        let soft =
            disc.loaded_follower(piece, angle, &ShaftCompliance { compliance: 1e-8, twist: 3e-6 }).expect("a force");
        let stiff =
            disc.loaded_follower(piece, angle, &ShaftCompliance { compliance: 1e-13, twist: 3e-11 }).expect("a force");
        let ratio = soft.error() / (1e5 * stiff.error());
        assert!((0.985..1.0).contains(&ratio), "{ratio}");
        assert!((stiff.force / disc.path_force(piece, angle).expect("a force") - 1.0).abs() < 1e-6);
        // Where it stands lower the fixed point holds: the bottom that follows it has that force.
        assert!(soft.force < stiff.force && soft.residual > 0.0);
    }
}

/// Cut for its shaft, the cam leaves nothing of the force balance and keeps the law at the design speed, under either kind of drive
/// and offset; at half the speed it stands too high.
#[test]
fn a_cam_cut_for_its_shaft_keeps_the_law_under_load() {
    let told =
        |sets: &[&str]| analysis(&machine(sets), &ShaftOptions::default()).expect("a shaft").sections[0].value.clone();
    for sets in [
        &["shaft.compensate=true"][..],
        &["shaft.compensate=true", "follower.roller.offset=8 mm", "cam.lever=1.3"],
        &["shaft.compensate=true", "buffer.column=return", "follower.roller.preload=900 N"],
    ] {
        let figures = told(sets);
        let number = |value: &serde_json::Value, name: &str| value[name].as_f64().unwrap_or_else(|| panic!("{name}"));
        // A hundredth of a nanometre agrees between rounds; the largest inertia is 21288 N.
        // A preload works on the transitions too, whose place is of no account and is left as it is.
        let preloaded = sets.iter().any(|set| set.contains("preload"));
        assert!(preloaded || number(&figures, "lift_error_max_mm") < 1e-7, "{sets:?}: {figures}");
        assert!(number(&figures, "residual_max_n") < 1e-4, "{sets:?}: {figures}");
        let without = &figures["without_compensation"];
        assert!(number(without, "lift_error_max_mm") > 0.1, "{sets:?}: {figures}");
    }
    let rigid =
        told(&["shaft.compensate=true"])["without_compensation"]["lift_error_max_mm"].as_f64().expect("a number");
    assert!((rigid / 0.451_425_296_233_18 - 1.0).abs() < 1e-10, "{rigid}");
}

/// As cut at 5 µm the bent shaft leaves less than 0.05 % of the largest inertia, where it left 0.68 %.
#[test]
fn as_cut_it_leaves_less_than_a_twentieth_of_a_percent() {
    let sets = ["shaft.compensate=true".to_owned()];
    let machine = Machine::load("dpi-shaft", &sets).expect("valid").0;
    let cam = camgen_cams::pipeline::Spec::rotary(machine, 35.0).solve().expect("a cam");
    let proven = cam
        .draw(camgen_cams::body::Request::within(5e-6))
        .and_then(camgen_cams::pipeline::Drawing::prove)
        .expect("proved");
    let force = proven.report().sections.iter().find(|section| section.key == "force").expect("told").value.clone();
    assert!(force["residual_share"].as_f64().expect("a number") < 5e-4, "{force}");
}

/// What a failing check says would pass does.
#[test]
fn remedies_pass() {
    for (set, check) in [
        ("limits.lift_error=0.1mm", LIFT_ERROR.name),
        ("limits.support_slope=0.0005 rad", SUPPORT_SLOPE.name),
        ("limits.critical_speed_ratio=0.003", CRITICAL_SPEED.name),
    ] {
        let failing = analysis(&machine(&[set]), &ShaftOptions::default()).expect("a shaft");
        let of = |analysis: &Analysis| analysis.measures.iter().find(|m| m.check.name == check).cloned().expect("told");
        let measure = of(&failing);
        let limit = measure.limit.expect("a limit");
        assert!(measure.value > limit, "{check}");
        let note = measure.note.as_ref().map(ToString::to_string).expect("a note");
        let factor = note.split("times ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a factor");
        let factor: f64 = factor.parse().expect("a number");
        let thicker = |factor: f64| {
            let diameters = [45.0, 50.0, 45.0].map(|diameter| diameter * factor);
            let mut sets: Vec<String> =
                (0..3).map(|i| format!("shaft.segment[{i}].diameter={} mm", diameters[i])).collect();
            sets.push(format!("cam.bore_radius={} mm", 0.5 * diameters[1]));
            sets.push(set.to_owned());
            let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
            of(&analysis(&machine(&sets), &ShaftOptions::default()).expect("a shaft")).value
        };
        // The cam on the thicker shaft has a larger bore and less mass, which changes only the critical speed.
        let slack = if check == CRITICAL_SPEED.name { 1.02 } else { 1.0 };
        assert!(thicker(factor) <= limit * slack, "{check}: {factor}");
        assert!(thicker(0.97 * factor) > limit, "{check}: {factor}");
    }
}

/// The mass and the inertia of the default cam are those of its outline.
#[test]
fn the_cam_is_a_disc_on_its_shaft() {
    let told = machine(&[]);
    let carried = CamOnShaft::solve(&told, &[]).expect("a cam").expect("a press");
    let disc = carried.disc.expect("a thickness");
    for (got, want) in [(disc.mass, 12.0794), (disc.polar_inertia, 0.111_68), (disc.diametral_inertia, 0.056_74)] {
        assert!((got / want - 1.0).abs() < 1e-4, "{got} is not {want}");
    }
    let unbalance = 1e6 * libm::hypot(disc.unbalance[0], disc.unbalance[1]);
    assert!((unbalance / 389_828.0 - 1.0).abs() < 1e-5, "{unbalance}");
    assert!((rpm(carried.speed.expect("a speed")) - 105.0).abs() < 1e-12);
}
