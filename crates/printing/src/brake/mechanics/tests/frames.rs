//! Frames that need no disc: those of the specification, and those found.

use super::synthesis::{FrameAim, FrameTask, synthesise};
use super::*;

/// 1e-3 × mm.
fn frame_mm(pivot: [f64; 2], right: [f64; 2], left: [f64; 2], centre: [f64; 2]) -> BrakeFrame {
    let metres = |[x, y]: [f64; 2]| [1e-3 * x, 1e-3 * y];
    BrakeFrame {
        pivot: metres(pivot),
        right_pulley: metres(right),
        left_pulley: metres(left),
        centre_of_gravity: metres(centre),
        pulley_radius: 0.06,
    }
}

/// Least and largest over the roll.
fn range(brake: &Brake, of: impl Fn(&FramePose) -> f64) -> (f64, f64) {
    let radius = |step: u32| 0.6 - 0.55 * f64::from(step) / 550.0;
    let values = (0..=550).map(|step| of(&at(brake, radius(step).max(0.05))));
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| (least.min(value), most.max(value)))
}

#[test]
fn the_level_frame_holds_the_tension_within_a_thousandth() {
    let frame = frame_mm([-1580.0, 1180.0], [850.0, 100.0], [-900.0, 670.0], [-130.0, 1560.0]);
    let brake = Brake::new(frame, ROLL, 0.25, RollRotation::Clockwise).expect("reaches");
    let weight = brake.weight_for(300.0, &at(&brake, 0.6));
    close(weight, 1_518.389_302_530_3, 1e-13);
    let (least, most) = range(&brake, |pose| brake.tension(weight, pose));
    assert!((least - 299.68).abs() < 5e-3 && (most - 300.0).abs() < 5e-3, "{least} {most}");
    let (least, most) = range(&brake, |pose| pose.wrap.to_degrees());
    assert!((least - 40.3).abs() < 0.05 && (most - 43.1).abs() < 0.05, "{least} {most}");
    assert!((at(&brake, 0.05).theta.to_degrees() + 16.48).abs() < 5e-3);
    let full = at(&brake, 0.6);
    let with = |friction| brake.tension_with(weight, &full, friction).expect("slips");
    assert!((with(0.2) - 239.0).abs() < 1.0 && (with(0.3) - 361.0).abs() < 1.0, "{} {}", with(0.2), with(0.3));
    // By the printed moment alone.
    let frame = frame_mm([-1540.0, 830.0], [860.0, 130.0], [-820.0, 610.0], [-60.0, 1100.0]);
    let brake = Brake::new(frame, ROLL, 0.25, RollRotation::Clockwise).expect("reaches");
    let weight = brake.weight_for_printed(300.0, &at(&brake, 0.6));
    let (least, most) = range(&brake, |pose| brake.tension_printed(weight, pose));
    assert!((least - 299.77).abs() < 5e-3 && (most - 300.08).abs() < 5e-3, "{least} {most}");
}

#[test]
fn the_robust_frame_jams_the_other_way_round() {
    let frame = frame_mm([-1600.0, -340.0], [700.0, 10.0], [-1000.0, 800.0], [-100.0, -420.0]);
    let brake = Brake::new(frame, ROLL, 0.25, RollRotation::CounterClockwise).expect("reaches");
    let weight = brake.weight_for(300.0, &at(&brake, 0.6));
    assert!((weight - 1131.0).abs() < 0.5, "{weight}");
    let (least, most) = range(&brake, |pose| brake.tension(weight, pose));
    assert!((least - 293.8).abs() < 0.05 && (most - 301.5).abs() < 0.05, "{least} {most}");
    let (least, most) = range(&brake, |pose| pose.sensitivity(0.25));
    assert!((least - 0.69).abs() < 6e-3 && (most - 0.72).abs() < 6e-3, "{least} {most}");
    assert_eq!(at(&brake, 0.3).locking_friction(), None);
    let other = Brake::new(frame, ROLL, 0.25, RollRotation::Clockwise).expect("reaches");
    let (least, most) = range(&other, |pose| pose.sensitivity(0.25));
    assert!((least - 1.6).abs() < 0.06 && (most - 1.7).abs() < 0.06, "{least} {most}");
    let (lock, _) = range(&other, |pose| pose.locking_friction().unwrap_or(f64::INFINITY));
    assert!((lock - 0.607).abs() < 5e-4, "{lock}");
    let pose = at(&other, 0.3);
    let jams = pose.locking_friction().expect("self-locking");
    assert!(other.tension_with(weight, &pose, jams * (1.0 + 1e-9)).is_err());
    assert!(other.tension_with(weight, &pose, jams * (1.0 - 1e-9)).expect("slips") > 1e8);
}

fn task() -> FrameTask {
    FrameTask {
        roll: ROLL,
        friction: 0.25,
        rotation: RollRotation::Clockwise,
        pulley_radius: 0.06,
        reach: 1.6,
        clearance: 0.02,
        aim: FrameAim::Level,
        generations: 300,
        seed: 1,
    }
}

/// Half a second for the eight. The spread at the stations of the search is that of a fine sweep.
#[test]
fn a_random_start_finds_a_level_frame() {
    for seed in 1..=4 {
        let found = synthesise(&FrameTask { seed, ..task() }).expect("a frame");
        assert!(found.spread < 5e-4, "seed {seed}: {}", found.spread);
        let (least, most) = range(&found.brake, |pose| found.brake.tension(1000.0, pose));
        assert!((1.0 - least / most - found.spread).abs() < 2e-6, "seed {seed}: {}", found.spread);
        let frame = found.brake.frame();
        let all = [frame.pivot, frame.right_pulley, frame.left_pulley, frame.centre_of_gravity];
        assert!(all.iter().flatten().all(|value| value.abs() <= 1.6), "{frame:?}");
        let again = synthesise(&FrameTask { seed, ..task() }).expect("a frame");
        assert_eq!(again.brake, found.brake, "the same seed, the same frame");
    }
}

/// The frame of the specification is rounded to 10 mm; over radii and frictions together the search is no worse.
#[test]
fn a_robust_frame_is_found_on_either_side() {
    let known = frame_mm([-1600.0, -340.0], [700.0, 10.0], [-1000.0, 800.0], [-100.0, -420.0]);
    let known = Brake::new(known, ROLL, 0.25, RollRotation::CounterClockwise).expect("reaches");
    let with = |friction: f64| range(&known, |pose| known.tension_with(1000.0, pose, friction).expect("slips"));
    let known = 1.0 - with(0.2).0 / with(0.3).1;
    for rotation in [RollRotation::Clockwise, RollRotation::CounterClockwise] {
        let aim = FrameAim::Robust { from: 0.2, to: 0.3 };
        let found = synthesise(&FrameTask { rotation, aim, ..task() }).expect("a frame");
        assert!(found.spread < known + 0.005, "{} {known}", found.spread);
        let pose = at(&found.brake, 0.6);
        assert!(pose.q_slack < 0.0 && pose.sensitivity(0.25) < 0.75, "{pose:?}");
    }
}

#[test]
fn a_task_that_cannot_be_done_is_told() {
    let none = synthesise(&FrameTask { reach: 0.3, generations: 5, ..task() }).expect_err("no room");
    assert_eq!(none.what, "no frame within 300 mm of the axis of the roll brakes the whole roll");
    let what = |task: FrameTask| synthesise(&task).expect_err("refused").what;
    assert_eq!(what(FrameTask { reach: f64::NAN, ..task() }), "the reach is NaN");
    let roll = PaperRoll { largest_radius: 0.1, smallest_radius: 0.2 };
    assert_eq!(what(FrameTask { roll, ..task() }), "the smallest radius of the roll is 200 mm");
}
