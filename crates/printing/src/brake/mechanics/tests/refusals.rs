//! Every refusal, with one case that produces it and what its message names.

use super::ends::RollEnds;
use super::*;

#[track_caller]
fn refused(frame: BrakeFrame, roll: PaperRoll, friction: f64, rotation: RollRotation) -> BrakeError {
    Brake::new(frame, roll, friction, rotation).expect_err("refused")
}

#[test]
fn numbers_out_of_range() {
    let cw = RollRotation::Clockwise;
    let error = refused(BrakeFrame { pivot: [f64::NAN, 0.0], ..frame() }, ROLL, 0.25, cw);
    assert_eq!(error.to_string(), "the pivot is NaN; it must be a finite number");
    let error = refused(BrakeFrame { pulley_radius: 0.0, ..frame() }, ROLL, 0.25, cw);
    assert_eq!(error.to_string(), "the pulley radius is 0; it must be a number above 0");
    for friction in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(frame(), ROLL, friction, cw);
        assert_eq!(error.to_string(), format!("the friction is {friction}; it must be a number above 0"));
    }
    let error = refused(frame(), PaperRoll { smallest_radius: 0.6, ..ROLL }, 0.25, cw);
    assert_eq!(error.to_string(), "the smallest radius of the roll is 600 mm; it must be below the largest, 600 mm");
    for wrap in [0.0, std::f64::consts::TAU, f64::NAN] {
        let error = RollEnds::new([1.0, wrap], 0.25, 0.93).expect_err("no wrap");
        assert_eq!(
            error.remedy.as_ref().map(ToString::to_string).as_deref(),
            Some("it must be above 0 and below 360 deg"),
            "{error}"
        );
    }
    assert!(RollEnds::new([1.0, 0.8], 0.25, 0.0).is_err());
    let ends = RollEnds::new([1.0, 0.8], 0.25, 0.93).expect("in range");
    assert!(ends.regulation(300.0, 0.0).is_err());
    let web = Web { thickness: 0.07e-3, width: 0.84, modulus: 4.5e9, speed: 10.0, wound_strain: 0.0, length: None };
    assert!(web.checked().is_ok() && web.stretch(300.0).is_none());
    for wrong in [
        Web { thickness: 0.0, ..web },
        Web { wound_strain: -1.0, ..web },
        Web { wound_strain: f64::NAN, ..web },
        Web { length: Some(0.0), ..web },
        Web { modulus: 1e308, width: 1e308, ..web },
    ] {
        assert!(wrong.checked().is_err(), "{wrong:?}");
    }
    let brake = brake();
    for radius in [0.61, 0.04, f64::NAN] {
        let error = brake.at(radius).expect_err("outside").to_string();
        assert!(error.ends_with("is outside the roll; it must be within 50…600 mm"), "{error}");
    }
    let weight = brake.weight_for(300.0, &at(&brake, 0.6));
    assert!(TensionHolding::new(brake.clone(), f64::NAN, 300.0, 10.0).is_err());
    assert!(TensionHolding::new(brake.clone(), weight, 0.0, 10.0).is_err());
    assert!(brake.tension_with(weight, &at(&brake, 0.6), 0.0).is_err());
}

/// The others are found among random frames (`properties`).
#[test]
fn walls_at_the_full_roll() {
    let cw = RollRotation::Clockwise;
    let near = BrakeFrame { left_pulley: [-0.4, 0.5], ..frame() };
    let error = refused(near, ROLL, 0.25, cw);
    assert_eq!(error, BrakeError::PulleyMeetsRoll { pulley: Pulley::Left, radius: 0.6 });
    let error = refused(BrakeFrame { right_pulley: [0.66, 0.7], left_pulley: [-0.66, 0.7], ..frame() }, ROLL, 0.25, cw);
    assert_eq!(error, BrakeError::BeltLeavesRoll { radius: 0.6 });
}

/// Sizes whose squares are no numbers, and a friction that outgrows them.
#[test]
fn extremes_are_refused_without_a_panic() {
    for pivot in [[-1e200, 1e200], [-1e9, 1e9]] {
        let far = refused(BrakeFrame { pivot, ..frame() }, ROLL, 0.25, RollRotation::Clockwise);
        assert!(matches!(far, BrakeError::PulleyMeetsRoll { .. } | BrakeError::Jams { .. }), "{far}");
    }
    let wide = BrakeFrame { right_pulley: [1e200, 1e200], left_pulley: [-1e200, 1e200], ..frame() };
    let error = refused(wide, ROLL, 0.25, RollRotation::Clockwise);
    assert_eq!(error, BrakeError::NotReached { radius: 0.6, smallest: 0.05 });
    for friction in [1e-300, 1e-9, 100.0, 1e300] {
        let brake = Brake::new(frame(), ROLL, friction, RollRotation::Clockwise).expect("reaches");
        let pose = at(&brake, 0.3);
        let tension = brake.tension(1000.0, &pose);
        assert!(tension > 0.0 && tension.is_finite(), "{friction}: {tension}");
        close(brake.weight_for(tension, &pose), 1000.0, 1e-14);
        let sensitivity = pose.sensitivity(friction);
        assert!((0.0..=1.1).contains(&sensitivity), "{friction}: {sensitivity}");
    }
}

/// The angle between the pulleys passes a whole turn: no other wall, and no radius beyond the roll, is reported for it.
#[test]
fn pulleys_that_pass_each_other_are_named() {
    let frame = BrakeFrame {
        pivot: [-6.088_185, 3.273_645],
        right_pulley: [1.270_838, -2.445_626],
        left_pulley: [2.269_592, -4.784_96],
        centre_of_gravity: [-2.281_302, 1.853_899],
        pulley_radius: 0.385_236_5,
    };
    let roll = PaperRoll { largest_radius: 2.273_041, smallest_radius: 1.354_104 };
    let wall = Brake::new(frame, roll, 0.133_451_551_212_171_67, RollRotation::Clockwise).expect_err("a wall");
    assert!(matches!(wall, BrakeError::PulleysPass { radius } if (radius - 2.214_473).abs() < 1e-6), "{wall}");
}
