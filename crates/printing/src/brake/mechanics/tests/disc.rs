//! The disc that holds the tension: golden numbers, derivatives, and the tension it leaves.

use super::*;

/// i = 10, 300 N.
fn holding() -> TensionHolding {
    let brake = brake();
    let weight = brake.weight_for(300.0, &at(&brake, 0.6));
    TensionHolding::new(brake, weight, 300.0, 10.0).expect("less than a turn")
}

#[test]
fn golden_moments_and_energy() {
    let holding = holding();
    close(holding.total_angle().to_degrees(), 271.821_251_254_367_711, 1e-14);
    close(holding.at(holding.total_angle()).expect("a place").energy, 63.727_962_816_779_037_0, 2e-14);
    for (radius, moment) in [(0.3, 147.444_348_237_193_964), (0.05, 255.925_862_925_341_622)] {
        let pose = at(holding.brake(), radius);
        // A difference of numbers of a thousand.
        close(holding.moment(&pose), moment, 2e-13);
        let angle = holding.angle_at(radius).expect("a place");
        close(10.0 * holding.at(angle).expect("a place").torque, moment, 2e-13);
        close(holding.radius_at(angle).expect("a place"), radius, 1e-14);
    }
    let start = holding.at(0.0).expect("a place");
    assert!(start.energy == 0.0 && start.torque.abs() < 1e-13, "{start:?}");
}

#[test]
fn its_derivatives_belong_to_their_values() {
    let holding = holding();
    let at = |angle: f64| holding.at(angle).expect("a place");
    let h = 2e-3;
    for step in 1..40 {
        let angle = holding.total_angle() * f64::from(step) / 40.0;
        let difference = |f: fn(DiscWork) -> f64| {
            let g = |n: f64| f(at(angle + n * h));
            (8.0 * (g(1.0) - g(-1.0)) - (g(2.0) - g(-2.0))) / (12.0 * h)
        };
        let hold = at(angle);
        for (exact, by_difference) in [
            (hold.torque, difference(|hold| hold.energy)),
            (hold.torque_slope, difference(|hold| hold.torque)),
            (hold.torque_second, difference(|hold| hold.torque_slope)),
        ] {
            assert!((exact - by_difference).abs() < 1e-9, "at {angle}: {exact} {by_difference}");
        }
    }
}

#[test]
fn it_holds_the_tension_and_leaves_the_friction() {
    let holding = holding();
    for radius in [0.6, 0.5, 0.3, 0.1, 0.05] {
        let pose = at(holding.brake(), radius);
        let torque = holding.at(holding.angle_at(radius).expect("a place")).expect("a place").torque;
        close(holding.tension_with(torque, &pose, 0.25).expect("slips"), 300.0, 1e-12);
        let other = holding.tension_with(torque, &pose, 0.30).expect("slips");
        // 362.4 N at the one end, 362.6 at the other, and a little more between them.
        assert!((362.3..363.5).contains(&other), "{other}");
    }
}

#[test]
fn a_disc_of_more_than_a_turn_names_the_largest_ratio() {
    let brake = brake();
    let error = TensionHolding::new(brake.clone(), 1000.0, 300.0, 13.3).expect_err("more than a turn");
    let BrakeError::Refused(refusal) = error else { panic!("{error}") };
    assert_eq!(
        refusal.remedy.as_ref().map(ToString::to_string).as_deref(),
        Some("give a turns_per_frame_turn of 13.2 at most")
    );
    assert!(TensionHolding::new(brake, 1000.0, 300.0, 13.2).is_ok());
}
