//! The numbers of the specification, checked there a second way by contact forces integrated over the wrap.

use super::ends::{RollEnds, euler_coefficient};
use super::*;
use std::f64::consts::FRAC_PI_2;

/// A handful of roundings.
const ROUNDINGS: f64 = 4e-15;

/// The turn is the root of a length of four terms: a rounding of 1.15 m over q1 + q2 > 0.9 m, taken on by every arm.
const SOLVED: f64 = 2e-14;

#[test]
fn the_papers_coefficients_and_ranges() {
    let wraps = [FRAC_PI_2, 0.5 * FRAC_PI_2];
    let table = [
        (0.25, [0.274_165_887_366_796_260, 0.255_721_991_805_072_814], 0.152_822_357_380_115_603),
        (0.30, [0.327_183_808_926_815_271, 0.306_435_270_802_648_008], 0.148_074_587_862_013_791),
    ];
    for (friction, coefficients, range) in table {
        for (wrap, want) in wraps.into_iter().zip(coefficients) {
            close(euler_coefficient(wrap, friction), want, ROUNDINGS);
        }
        let ends = RollEnds::new(wraps, friction, 0.93).expect("in range");
        // A difference of two numbers of 1.15.
        close(ends.range_of_slip(), range, 10.0 * ROUNDINGS);
    }
    let regulation = RollEnds::new(wraps, 0.25, 0.93).and_then(|ends| ends.regulation(300.0, 0.2)).expect("in range");
    close(regulation.press_full, 5_471.140_171_399_975_26, ROUNDINGS);
    close(regulation.belt_speed_empty, 0.769_435_528_523_976_879, ROUNDINGS);
    close(regulation.belt_speed_empty - regulation.belt_speed_full, regulation.range, 1e-13);
    assert!((regulation.range + 0.030_6).abs() < 5e-5, "3.06 % of V");
}

#[test]
fn the_frame_at_three_radii() {
    let brake = brake();
    close(brake.belt_length(), 1.151_643_355_955_263_98, ROUNDINGS);
    for (radius, theta, wrap) in [
        (0.3, -15.039_524_097_665_893_4, 58.423_242_918_708_854_1),
        (0.05, -27.182_125_125_436_771_1, 52.156_677_793_501_447_6),
    ] {
        let pose = at(&brake, radius);
        close(pose.theta.to_degrees(), theta, SOLVED);
        close(pose.wrap.to_degrees(), wrap, SOLVED);
    }
    let pose = at(&brake, 0.3);
    close(pose.h1, 1.158_896_467_761_404_23, SOLVED);
    close(pose.h2, 1.228_918_324_923_654_15, SOLVED);
    close(pose.q1, 0.858_266_003_761_705_701, SOLVED);
    close(pose.q2, 0.341_248_499_378_612_196, SOLVED);
    assert_eq!((pose.q_tight, pose.q_slack), (pose.q2, pose.q1));
    let full = at(&brake, 0.6);
    assert_eq!(full.theta, 0.0);
}

#[test]
fn weight_and_tension() {
    let brake = brake();
    let [full, half, empty] = [0.6, 0.3, 0.05].map(|radius| at(&brake, radius));
    let (weight, printed) = (brake.weight_for(300.0, &full), brake.weight_for_printed(300.0, &full));
    close(weight, 1_030.530_787_281_170_09, ROUNDINGS);
    close(printed, 1_081.313_452_753_553_76, ROUNDINGS);
    close(brake.tension(weight, &full), 300.0, ROUNDINGS);
    close(brake.tension(weight, &half), 267.032_457_647_984_554, SOLVED);
    close(brake.tension(weight, &empty), 243.378_703_746_757_656, SOLVED);
    close(brake.tension_printed(printed, &half), 264.880_998_813_025_013, SOLVED);
    close(brake.tension_printed(printed, &empty), 244.306_044_238_296_701, SOLVED);
    let with = |pose| brake.tension_with(weight, pose, 0.30).expect("does not jam");
    close(with(&full), 362.433_518_205_482_607, SOLVED);
    close(with(&empty), 294.138_923_378_757_070, SOLVED);
    close(full.sensitivity(0.25), 1.034_991_157_92, 1e-11);
    let (slack, tight) = brake.belt_tensions(300.0, &full);
    close(slack, 901.743_102_744_314_276, ROUNDINGS);
    assert_eq!(tight, slack + 300.0);
    // The weight for 1.5 times the grip at the worst radius.
    close(1.5 * brake.weight_for(300.0, &empty), 1905.42, 5e-6);
}

#[test]
fn the_web_without_slip() {
    let web =
        Web { thickness: 0.07e-3, width: 0.84, modulus: 4.5e9, speed: 10.0, wound_strain: 0.0, length: Some(6.0) };
    let web = web.checked().expect("in range");
    close(web.belt_speed_printed(300.0), 0.998_866_213_151_927_438, ROUNDINGS);
    close(web.belt_speed(300.0), 0.998_867_497_168_742_922, ROUNDINGS);
    close(web.stretch(300.0).expect("a length"), 6.802_721_088_435_374_15e-3, ROUNDINGS);
    assert!((web.sensitivity(300.0) - 882.0).abs() < 1e-9);
    // 1 − 0.9985 has three digits less than 0.9985.
    close(web.tension(0.9985), 397.496_244_366_549_825, 1e-12);
    close(Web { wound_strain: 2e-4, ..web }.tension(0.9985), 450.495_743_615_423_135, 1e-12);
    close(web.inertia(700.0, 0.6, 0.05), 119.696_447_247_638_767, ROUNDINGS);
    close(web.acceleration_tension(119.696_447_247_638_767, 0.6, 0.3), 99.747_039_373_032_305_5, ROUNDINGS);
    assert_eq!(web.tension_within(300.0, 0.0), 300.0);
    assert_eq!(web.tension_within(300.0, 0.9985), 300.0);
    close(web.tension_within(300.0, 0.9995), 132.366, 1e-5);
    let (drive, heat) = web.powers(300.0, 0.2);
    close(drive, 600.0, ROUNDINGS);
    close(heat, 2400.0, ROUNDINGS);
}

/// What the paper claims, and how far it holds.
#[test]
fn the_papers_claims() {
    // K changes within 7 % of its mean from 45° to 90°, and rises with the wrap all the way.
    for (friction, of_start) in [(0.25, 0.0673), (0.30, 0.0634)] {
        let k = |degrees: f64| euler_coefficient(degrees.to_radians(), friction);
        assert!((1.0 - k(45.0) / k(90.0) - of_start).abs() < 5e-5);
        assert!(2.0 * (k(90.0) - k(45.0)) / (k(90.0) + k(45.0)) < 0.07);
        assert!((1..180).all(|degree| k(f64::from(degree)) < k(f64::from(degree + 1))));
        close(k(1e-9), friction, 1e-14);
    }
    // Friction outweighs it: d ln K/d ln f = af/sinh(af), where the wrap costs 7 %.
    for degrees in [45.0_f64, 90.0] {
        let wrap = degrees.to_radians();
        let grip = 0.25 * wrap;
        let by_friction = grip / libm::sinh(grip);
        assert!((0.96..=0.99 + 5e-3).contains(&by_friction), "{by_friction}");
        let h = 1e-5;
        let log = |share: f64| libm::log(euler_coefficient(wrap, 0.25 * share));
        close((log(1.0 + h) - log(1.0 - h)) / (2.0 * h), by_friction, 1e-9);
        let more = euler_coefficient(wrap, 0.30) / euler_coefficient(wrap, 0.25);
        assert!((1.19..1.20).contains(&more), "{more}");
    }
    // A hinge with round numbers, never regulated: by the printed moment 18.6 %, of which K is 1.8 % and the arms 17.1 %.
    let brake = brake();
    let [full, empty] = [0.6, 0.05].map(|radius| at(&brake, radius));
    let falls = |of: &dyn Fn(&FramePose) -> f64| 1.0 - of(&empty) / of(&full);
    assert!((falls(&|pose| brake.tension_printed(1.0, pose)) - 0.186).abs() < 5e-4);
    assert!((falls(&|pose| pose.k) - 0.018).abs() < 5e-4);
    assert!((falls(&|pose| pose.h1 / pose.h2) - 0.171).abs() < 5e-4);
    // By the exact moment it is a little more.
    assert!((falls(&|pose| brake.tension(1.0, pose)) - 0.189).abs() < 5e-4);
    close(brake.weight_for_printed(300.0, &full) / brake.weight_for(300.0, &full), 1.049, 5e-4);
    // What (3) leaves out: h1 G/P = h2/K ± h3 cos(a/2).
    for pose in [full, empty] {
        let h3_cos = 0.5 * (pose.q_tight - pose.q_slack);
        close(brake.moment_for(1.0, &pose), pose.h2 / pose.k + h3_cos, ROUNDINGS);
    }
}

/// S_f against the tension itself: a difference of second order.
#[test]
fn the_sensitivity_is_that_of_the_tension() {
    let brake = brake();
    for radius in [0.6, 0.3, 0.05] {
        let pose = at(&brake, radius);
        let log = |friction: f64| libm::log(brake.tension_with(1000.0, &pose, friction).expect("slips"));
        let h = 1e-5;
        let difference = (log(0.25 * (1.0 + h)) - log(0.25 * (1.0 - h))) / (2.0 * h);
        close(pose.sensitivity(0.25), difference, 1e-9);
    }
}
